//! Simbeeotic: events, instants, random streams, trace hash, pacing.

mod event;
pub mod rng;
mod time;

pub use event::{Event, ModelId, Wake};
pub use time::SimTime;
