//! Pacing: how fast a run goes by the wall clock, and who may hold it.
//!
//! By default a run goes as fast as it can. With a factor `f` it goes at most `f` times as fast as the
//! wall clock: 2 means that two simulated seconds take one second of wall time or more. (The original
//! documented the same and did the inverse.) This is soft real time: an instant is never run before its
//! wall time; if it comes later, because the machine was busy, the run catches up as fast as it can
//! and says how late it was ([`Lateness`]).
//!
//! A [`Control`] is shared with other threads: a viewer's buttons, a signal handler. Pausing, stepping
//! and changing the factor move the reference between simulated time and wall time, so a run goes on
//! after a pause as it went before, and does not race after the time it stood still. A held run stands
//! inside [`Engine::run_until`](crate::Engine::run_until), or is handed back to whoever wants to look at
//! it meanwhile ([`Engine::hand_back_when_held`](crate::Engine::hand_back_when_held)).
//!
//! All of this happens between instants, and none of it can be seen from inside the run.

mod clock;
mod control;
mod lateness;
mod pacer;

pub use clock::{Clock, FakeClock, WallClock};
pub use control::{Control, PaceError};
pub use lateness::Lateness;
pub(crate) use pacer::{Gate, Pacer};
