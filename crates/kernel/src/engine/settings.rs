//! How an engine runs, and when it stops.

use crate::{QueueKind, SimTime};
use std::time::Duration;

/// How an engine runs. Of all this, only the seed may show in results.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Threads that run models: 1 stays on the caller's thread, 0 takes one for each core.
    pub threads: usize,
    /// The master seed, named in errors. The kernel draws nothing from it.
    pub seed: u64,
    /// What ends a run.
    pub limits: Limits,
    /// Rounds with at least this many visits are run by all threads; smaller ones are not worth waking
    /// them.
    pub parallel_from: usize,
    /// The pending event set.
    pub queue: QueueKind,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            threads: 1,
            seed: 0,
            limits: Limits::default(),
            parallel_from: 256,
            queue: QueueKind::default(),
        }
    }
}

/// What ends a run, cleanly.
#[derive(Clone, Debug)]
pub struct Limits {
    /// The last instant that is run. Default: no end.
    pub end: SimTime,
    /// Wall time for the whole run, checked between instants. Default: none.
    pub wall: Option<Duration>,
    /// Events in one instant, over all its rounds. Default 2^26.
    pub events_per_instant: u64,
    /// Rounds in one instant: more is a loop of events without delay. Default 10,000.
    pub rounds_per_instant: u32,
    /// Pending events. Default 2^26, which is 2 GB.
    pub queue: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            end: SimTime::MAX,
            wall: None,
            events_per_instant: 1 << 26,
            rounds_per_instant: 10_000,
            queue: 1 << 26,
        }
    }
}

/// How a call of [`Engine::run_until`](super::Engine::run_until) ended well.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Status {
    /// Everything up to and including the asked time (or [`Limits::end`], if earlier) is done.
    Reached,
    /// The same, and nothing is pending any more. The clock stands at the asked time, or, if that was
    /// [`SimTime::MAX`], at the last instant.
    Exhausted,
    /// A model or [`Control::stop`](crate::Control::stop) ended the run, after a whole instant.
    /// Final: what can still be run are events that are scheduled for this very time, as last words.
    Stopped(String),
    /// [`Limits::wall`] is used up. The run may go on if the limit is raised.
    WallTime,
    /// The run is held ([`Control::pause`](crate::Control::pause)), and
    /// [`Engine::hand_back_when_held`](super::Engine::hand_back_when_held) was asked for. The clock
    /// stands at the last instant that has run, or where a step of simulated time ended. The same call
    /// again goes on.
    Held,
}
