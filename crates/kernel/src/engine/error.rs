//! Why a run ended before its time.

use crate::{ModelId, SimTime};

/// What ended a run. After any of these the engine is over: each further call gives the same error.
///
/// Everything before `time` has been done and stands, so that recordings can be closed. What stands of
/// the round that failed, the page [`engine`](crate::engine) says.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RunError {
    /// A model broke an invariant of its own.
    #[error("{path} panicked at {time} (seed {seed}): {message}")]
    Panic {
        /// The model that ran, or whose effect was being applied.
        path: String,
        /// When.
        time: SimTime,
        /// The master seed, to run it again.
        seed: u64,
        /// What the panic said.
        message: String,
    },
    /// The shared state (bodies, radio medium) broke an invariant while no model was running.
    #[error("the shared state panicked at {time} (seed {seed}): {message}")]
    SharedPanic {
        /// When.
        time: SimTime,
        /// The master seed, to run it again.
        seed: u64,
        /// What the panic said.
        message: String,
    },
    /// A model asked for something that cannot be done, such as a force that is no number.
    #[error("{path}, at {time}: {message}")]
    Fault {
        /// The model that asked.
        path: String,
        /// When.
        time: SimTime,
        /// What is wrong.
        message: String,
    },
    /// A model scheduled an event for a time that is over.
    #[error("{path} scheduled an event for {due}, but it is {time} already")]
    PastEvent {
        /// The model that scheduled it.
        path: String,
        /// When it did.
        time: SimTime,
        /// When the event was to be due.
        due: SimTime,
    },
    /// A model scheduled an event for a model that does not exist.
    #[error("{path}, at {time}, scheduled an event for model {receiver}, which does not exist")]
    UnknownReceiver {
        /// The model that scheduled it.
        path: String,
        /// When.
        time: SimTime,
        /// The id that nobody has.
        receiver: ModelId,
    },
    /// Models wake each other without letting time pass.
    #[error(
        "time stands still at {time}: after {rounds} rounds these wake each other without delay: {}",
        list(paths)
    )]
    ZeroDelayLoop {
        /// Who was awake in the last rounds, at most 16 of them; empty if it is the shared state alone.
        paths: Vec<String>,
        /// When.
        time: SimTime,
        /// How many rounds were run.
        rounds: u32,
    },
    /// More events in one instant than [`Limits::events_per_instant`](super::Limits) allows.
    #[error("{events} events at {time}, the limit is {limit}; the last went to {path}")]
    TooManyEvents {
        /// Who got the last of them.
        path: String,
        /// When.
        time: SimTime,
        /// How many.
        events: u64,
        /// How many were allowed.
        limit: u64,
    },
    /// More pending events than [`Limits::queue`](super::Limits) allows.
    #[error(
        "{pending} events are pending at {time}, the limit is {limit}; {path} scheduled the last of them"
    )]
    QueueFull {
        /// Who scheduled last.
        path: String,
        /// When.
        time: SimTime,
        /// How many wait.
        pending: usize,
        /// How many may.
        limit: usize,
    },
}

impl RunError {
    /// The instant at which the run ended.
    #[must_use]
    pub fn time(&self) -> SimTime {
        match self {
            Self::Panic { time, .. }
            | Self::SharedPanic { time, .. }
            | Self::Fault { time, .. }
            | Self::PastEvent { time, .. }
            | Self::UnknownReceiver { time, .. }
            | Self::ZeroDelayLoop { time, .. }
            | Self::TooManyEvents { time, .. }
            | Self::QueueFull { time, .. } => *time,
        }
    }
}

fn list(paths: &[String]) -> String {
    if paths.is_empty() {
        "the shared state".into()
    } else {
        paths.join(", ")
    }
}

/// Why an engine could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// More agents than ids.
    #[error("{0} models; the engine numbers them with 32 bits")]
    TooManyAgents(usize),
    /// The operating system gave no threads.
    #[error("cannot start {threads} threads")]
    Threads {
        /// How many were asked for.
        threads: usize,
        /// Why not.
        source: rayon::ThreadPoolBuildError,
    },
}

/// What a model or the shared state did wrong, before its path is looked up.
#[derive(Clone, Debug)]
pub(crate) struct Failure {
    pub(crate) id: ModelId,
    pub(crate) what: What,
}

/// The kinds of [`Failure`].
#[derive(Clone, Debug)]
pub(crate) enum What {
    Fault(String),
    Past(SimTime),
    Unknown(ModelId),
    Panic(String),
}
