//! The engine below the simulator: events, instants, random streams, trace hash, pacing.
//!
//! The kernel knows nothing of bodies and radios. It runs a [`Domain`]: shared state, and agents that
//! are woken by events, read the shared state, and ask for changes to it. It promises that **one domain
//! and one seed give one run**, bit for bit, on one thread or eight, with either queue, in pieces or in
//! one go; and it is built so that a hundred thousand agents run in real time.
//!
//! ```
//! use simbeeotic_kernel::{
//!     Committing, Domain, Engine, ModelId, Opening, Outbox, Settings, SimTime, Status, Visit, Wake,
//!     rng::path_key,
//! };
//!
//! /// A hive with a pot of honey. Each bee brings a drop every second.
//! struct Hive {
//!     drops: u64,
//! }
//!
//! /// A bee counts its flights.
//! struct Bee {
//!     flights: u64,
//! }
//!
//! impl Domain for Hive {
//!     type Agent = Bee;
//!     type Effect = u64;
//!
//!     fn path(&self, id: ModelId) -> String {
//!         format!("bee-{}", id.0)
//!     }
//!     fn key(&self, id: ModelId) -> u64 {
//!         path_key(&self.path(id))
//!     }
//!     fn next_time(&mut self) -> Option<SimTime> {
//!         None // honey does nothing by itself
//!     }
//!     fn open(&mut self, _: &mut Opening<'_>) {}
//!
//!     fn run(&self, bee: &mut Bee, visit: &Visit<'_>, out: &mut Outbox<u64>) {
//!         bee.flights += 1;
//!         out.effect(1); // not in the pot before all bees of this instant have flown
//!         let again = visit.now.saturating_add_nanos(1_000_000_000);
//!         out.schedule(again, visit.id, Wake::default());
//!     }
//!     fn commit(&mut self, _: ModelId, drops: u64, cx: &mut Committing<'_>) {
//!         self.drops += drops;
//!         cx.fold(self.drops);
//!     }
//!     fn close(&mut self, _: SimTime) -> bool {
//!         false
//!     }
//! }
//!
//! let bees = (0..3).map(|_| Bee { flights: 0 }).collect();
//! let mut engine = Engine::new(Hive { drops: 0 }, bees, Settings::default())?;
//! for id in 0..3 {
//!     engine.schedule_initial(SimTime::ZERO, ModelId(id), Wake::default())?;
//! }
//! assert_eq!(engine.run_until(SimTime::from_secs(9))?, Status::Reached);
//! assert_eq!(engine.domain().drops, 30); // 0 s and 9 s included
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Reading order
//!
//! 1. [`SimTime`], [`Event`]: time is counted in nanoseconds; events have a total order that needs no
//!    global counter;
//! 2. [`engine`]: what happens in an instant, in which order, who sees what. The page to know;
//! 3. [`Domain`], [`Outbox`]: what to implement, and what an agent can ask for;
//! 4. [`rng`]: random streams that are named, not numbered;
//! 5. [`Timers`]: wake-ups that can be moved and called off;
//! 6. [`TraceLog`]: how two runs are compared;
//! 7. [`pace`]: real time, pause, step, stop;
//! 8. [`Wheel`]: where events wait, and why it is fast.
//!
//! # Invariants
//!
//! - **Thread count, queue and splitting do not show** (`tests/it/determinism.rs`; with a domain that
//!   cheats, to see that the test can fail).
//! - **An agent's trace and random numbers do not depend on who else is there**
//!   (`a_stranger_changes_no_other_models_trace`).
//! - **The wheel gives what the heap gives** (`tests/it/queues.rs`).
//! - **Wall time never reaches a result**: clocks are read in `pace` and `stats` only.
//! - **Wrong input is an error with a path and a time, never a panic**; a model's panic is such an
//!   error too (`tests/it/failures.rs`).

pub mod engine;
mod event;
pub mod pace;
mod progress;
mod queue;
pub mod rng;
mod stats;
mod time;
mod timers;
mod trace;

pub use engine::{
    Committing, Domain, Engine, EngineError, Limits, Opening, Outbox, RunError, Settings, Status,
    Visit,
};
pub use event::{Event, ModelId, Wake};
pub use pace::{Control, Lateness};
pub use progress::Progress;
pub use queue::{Heap, PendingEvents, QueueKind, Wheel};
pub use rng::Stream;
pub use stats::{Stats, WallTimes};
pub use time::{SimTime, TimeError};
pub use timers::{Fired, Timers};
pub use trace::{Mark, Trace, TraceLog, TraceParseError};
