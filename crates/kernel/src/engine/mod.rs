//! The engine: what happens at an instant, and in which order.
mod domain;
mod drive;
mod error;
mod outbox;
mod round;
mod settings;

pub use domain::{Committing, Domain, Opening, Visit};
pub use error::{EngineError, RunError};
pub use outbox::Outbox;
pub use settings::{Limits, Settings, Status};

use crate::{
    Event, ModelId, PendingEvents, Progress, SimTime, Stats, Trace, TraceLog, Wake,
    pace::{Clock, Control, Lateness, Pacer},
    queue::Queue,
};
use drive::Phase;
use error::Failure;
use round::Call;
use std::{fmt, sync::Arc};

/// What the engine keeps about an agent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Book {
    /// Events scheduled by the agent so far.
    seq: u64,
    /// Everything the agent did.
    trace: Trace,
    /// The key of its path.
    key: u64,
}

impl Book {
    /// The number of the agent's next event.
    #[inline]
    fn take_number(&mut self) -> u64 {
        let seq = self.seq;
        self.seq += 1;
        seq
    }
}

/// Runs a [`Domain`] from instant to instant. The page [`engine`](crate::engine) says how.
pub struct Engine<D: Domain> {
    domain: D,
    agents: Vec<D::Agent>,
    books: Vec<Book>,
    keys: Vec<u64>,
    settings: Settings,
    pool: Option<Arc<rayon::ThreadPool>>,

    queue: Queue,
    trace: TraceLog,
    stats: Stats,
    progress: Arc<Progress>,
    pacer: Pacer,

    /// How far the run has come.
    now: SimTime,
    /// The time that pacing has let the run come to, if it has begun.
    reached: Option<SimTime>,
    /// The last instant in which a round was run.
    instant: Option<SimTime>,
    /// Rounds of this instant before the one under way.
    round: u32,
    /// Events of this instant so far.
    instant_events: u64,
    /// The shared state wants another round.
    again: bool,
    phase: Phase,
    stopped: Option<String>,
    failed: Option<RunError>,
    /// Models awake in the last rounds before the limit on rounds.
    awake: Vec<ModelId>,

    // Buffers, reused from round to round.
    batch: Vec<Event>,
    extra: Vec<ModelId>,
    calls: Vec<Call>,
    boxes: Vec<Outbox<D::Effect>>,
    committed: Vec<Event>,
    last_big: bool,
}

impl<D: Domain> Engine<D> {
    /// An engine at time zero. Agent `i` has the id `i`.
    ///
    /// # Errors
    ///
    /// More than 2^32 - 1 agents, or no threads to be had.
    pub fn new(domain: D, agents: Vec<D::Agent>, settings: Settings) -> Result<Self, EngineError> {
        let count =
            u32::try_from(agents.len()).map_err(|_| EngineError::TooManyAgents(agents.len()))?;
        let threads = match settings.threads {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            threads => threads,
        };
        let pool = if threads > 1 {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .thread_name(|i| format!("simbeeotic-{i}"))
                .build()
                .map_err(|source| EngineError::Threads { threads, source })?;
            Some(Arc::new(pool))
        } else {
            None
        };
        let keys: Vec<u64> = (0..count).map(|id| domain.key(ModelId(id))).collect();
        let books = keys
            .iter()
            .map(|&key| Book {
                seq: 0,
                trace: Trace::START,
                key,
            })
            .collect();
        Ok(Self {
            queue: Queue::new(settings.queue),
            pacer: Pacer::default(),
            boxes: vec![Outbox::new(count)],
            domain,
            agents,
            books,
            keys,
            settings,
            pool,
            trace: TraceLog::default(),
            stats: Stats::default(),
            progress: Arc::default(),
            now: SimTime::ZERO,
            reached: None,
            instant: None,
            round: 0,
            instant_events: 0,
            again: false,
            phase: Phase::Open,
            stopped: None,
            failed: None,
            awake: Vec::new(),
            batch: Vec::new(),
            extra: Vec::new(),
            calls: Vec::new(),
            committed: Vec::new(),
            last_big: false,
        })
    }

    /// Schedules an event from outside, in the receiver's own name: first wake-ups, and inputs between
    /// two calls of [`run_until`](Self::run_until).
    ///
    /// # Errors
    ///
    /// [`RunError::PastEvent`] if the time is over, [`RunError::UnknownReceiver`] if nobody has this id.
    pub fn schedule_initial(
        &mut self,
        time: SimTime,
        receiver: ModelId,
        wake: Wake,
    ) -> Result<(), RunError> {
        let Some(book) = self.books.get_mut(receiver.index()) else {
            return Err(RunError::UnknownReceiver {
                path: "the scenario".into(),
                time: self.now,
                receiver,
            });
        };
        if time < self.now {
            return Err(RunError::PastEvent {
                path: self.domain.path(receiver),
                time: self.now,
                due: time,
            });
        }
        let seq = book.take_number();
        self.queue.push(Event {
            time,
            receiver,
            sender: receiver,
            seq,
            wake,
        });
        Ok(())
    }

    /// The shared state.
    #[must_use]
    pub fn domain(&self) -> &D {
        &self.domain
    }

    /// The shared state, to be changed between two calls of [`run_until`](Self::run_until).
    pub fn domain_mut(&mut self) -> &mut D {
        &mut self.domain
    }

    /// The agents, by id.
    #[must_use]
    pub fn agents(&self) -> &[D::Agent] {
        &self.agents
    }

    /// The agents, by id, to be changed between two calls of [`run_until`](Self::run_until).
    pub fn agents_mut(&mut self) -> &mut [D::Agent] {
        &mut self.agents
    }

    /// The shared state and the agents at once.
    pub fn parts_mut(&mut self) -> (&mut D, &mut [D::Agent]) {
        (&mut self.domain, &mut self.agents)
    }

    /// Takes the engine apart.
    #[must_use]
    pub fn into_parts(self) -> (D, Vec<D::Agent>) {
        (self.domain, self.agents)
    }

    /// How far the run has come: everything before this time is done.
    #[must_use]
    pub fn now(&self) -> SimTime {
        self.now
    }

    /// How many events wait.
    #[must_use]
    pub fn pending(&self) -> usize {
        self.queue.len()
    }

    /// How the engine runs.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// What ends the run; may be changed between two calls of [`run_until`](Self::run_until).
    pub fn limits_mut(&mut self) -> &mut Limits {
        &mut self.settings.limits
    }

    /// Threads that run models.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.pool
            .as_ref()
            .map_or(1, |pool| pool.current_num_threads())
    }

    /// The trace of the run so far.
    #[must_use]
    pub fn trace(&self) -> &TraceLog {
        &self.trace
    }

    /// The hash of everything one agent did: its events, the words it folded, and those of its effects.
    /// Named by path keys, it stays the same when other agents are added that do not touch this one.
    #[must_use]
    pub fn agent_trace(&self, id: ModelId) -> Option<u64> {
        self.books.get(id.index()).map(|book| book.trace.hash())
    }

    /// Counts and wall times so far.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        &self.stats
    }

    /// How far the run has come, for another thread.
    #[must_use]
    pub fn progress(&self) -> Arc<Progress> {
        Arc::clone(&self.progress)
    }

    /// Pace, pause, step and stop, for another thread.
    #[must_use]
    pub fn control(&self) -> Arc<Control> {
        self.pacer.control()
    }

    /// Takes another control, so that one can be made and handed out before the engine.
    pub fn set_control(&mut self, control: Arc<Control>) {
        self.pacer.set_control(control);
    }

    /// Paces by another clock than the wall's: in tests, a [`FakeClock`](crate::pace::FakeClock).
    pub fn set_clock(&mut self, clock: impl Clock + 'static) {
        self.pacer.set_clock(Box::new(clock));
    }

    /// How late a paced run was.
    #[must_use]
    pub fn lateness(&self) -> &Lateness {
        self.pacer.lateness()
    }

    /// Looks up paths for an error.
    fn explain(&self, failure: Failure) -> RunError {
        let (path, time) = (self.domain.path(failure.id), self.now);
        match failure.what {
            error::What::Fault(message) => RunError::Fault {
                path,
                time,
                message,
            },
            error::What::Past(due) => RunError::PastEvent { path, time, due },
            error::What::Unknown(receiver) => RunError::UnknownReceiver {
                path,
                time,
                receiver,
            },
            error::What::Panic(message) => RunError::Panic {
                path,
                time,
                seed: self.settings.seed,
                message,
            },
        }
    }
}

impl<D: Domain + fmt::Debug> fmt::Debug for Engine<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Engine")
            .field("now", &self.now)
            .field("agents", &self.agents.len())
            .field("pending", &self.queue.len())
            .field("domain", &self.domain)
            .finish_non_exhaustive()
    }
}
