//! The engine: what happens at an instant, and in which order.
//!
//! An **instant** is a point of simulated time at which something is due: events, or something of the
//! shared state itself (a contact, the end of a frame). It is worked off in **rounds**, usually one.
//! This is all that happens in a round, in this order; `x` is the shared state, `a` an agent, and
//! `-`, `o`, `+` say which version of them is seen:
//!
//! ```text
//!  1  pop      all events due now, ordered by (receiver, sender, number)
//!  2  open     domain.open        x- -> xo    bodies and frames come to now; may add visits
//!  3  run      domain.run, once for each agent with events or an added visit:
//!                reads xo, changes its own a- -> a+, asks for effects and events;
//!                in parallel, in any order; nobody sees what others do in this round
//!  4  commit   domain.commit      xo -> x+    effects by agent id, each agent's in its own order
//!  5  put in   all events asked for in 3 and 4
//!  6  close    domain.close       x+ -> x-    contacts are predicted, frames are started
//!  7  if events are due now, or the shared state has something due now, or close asked for it:
//!     the next round of the same instant; else time goes on to the next instant
//! ```
//!
//! What follows from it:
//!
//! - **An agent sees the others as they were when the round began**, and itself as it has just made
//!   itself. Two agents that write to the same place in one round do so in the order of their ids.
//! - **No delay means the next round**, never the same one: an event scheduled for now in step 3 is
//!   popped in step 1 of round 1. An instant that comes to [`Limits::rounds_per_instant`] rounds is a
//!   loop, and ends the run with an error that names who is in it.
//! - **Threads cannot show.** Step 3 is the only parallel one, and what it reads does not change while
//!   it runs. Order within a round is decided by ids and by each sender's own count of events, which
//!   are the same on any number of threads; no counter is shared.
//! - **A run in pieces is the same run.** [`Engine::run_until`] returns between instants, after all
//!   rounds of the last one. Whatever is scheduled then for that very time is one more round of it.
//! - **The trace** takes in, for each visit in the order of ids: time, the agent's key, each event's
//!   sender, number and wake, and the words that the agent folded (all of this hashed in step 3), then
//!   the words of its effects (step 4). Each agent keeps a hash of its own part.
//! - **If an agent fails** (a fault, a panic, an event in the past) in step 3, the others of the round
//!   still run or not, but nothing is committed, and the error names the first one in the order of ids.
//!   If an effect fails in step 4, the effects before it stand. Steps 5 and 6 are left out. The engine
//!   is over then; shared state, agents, trace and statistics can still be read.
//! - **Stopping** ([`Outbox::stop`], [`Committing::stop`], [`Control::stop`]) never cuts an instant:
//!   its remaining rounds are run first.
//!
//! Before an instant the engine waits for the wall clock if the run is paced, and for as long as it is
//! paused ([`pace`](crate::pace)). None of that is visible in 1 to 7.
//!
//! # Cost
//!
//! A round with one visit costs 40 ns plus pop and push, and what the domain does; it allocates
//! nothing and sends nothing to other threads. Rounds with [`Settings::parallel_from`] visits or more
//! are cut into chunks of 64 for all threads. `benches/kernel.rs` measures both.

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
    rng::mix,
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
    /// The key of its path, mixed.
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
    /// Upcoming events whose agents have been warmed.
    warmed: usize,
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
        let keys: Vec<u64> = (0..count).map(|id| mix(domain.key(ModelId(id)))).collect();
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
            warmed: 0,
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

    /// The threads that run models, to be shared; `None` if it is the caller's alone.
    #[must_use]
    pub fn pool(&self) -> Option<Arc<rayon::ThreadPool>> {
        self.pool.clone()
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

    /// Whether [`run_until`](Self::run_until) returns [`Status::Held`] while the run is held, so that the
    /// caller can look at it, and does not wait inside. Default: no.
    pub fn hand_back_when_held(&mut self, hand_back: bool) {
        self.pacer.set_hands_back(hand_back);
    }

    /// Waits on the engine's clock until the control is used, or for so long; returns at once if it was
    /// used since [`run_until`](Self::run_until) returned [`Status::Held`].
    pub fn wait_while_held(&mut self, at_most: std::time::Duration) {
        self.pacer.wait_held(at_most);
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
