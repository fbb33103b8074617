//! Simbeeotic: events, instants, random streams, trace hash, pacing.

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
