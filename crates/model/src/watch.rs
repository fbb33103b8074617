//! The wall clock, for figures of where the time went. It never reaches the trace.

use std::time::Instant;

/// A point of wall-clock time.
#[allow(
    clippy::disallowed_methods,
    reason = "measures the simulator, not the simulation"
)]
pub(crate) fn now() -> Instant {
    Instant::now()
}

/// Wall-clock nanoseconds since `start`.
pub(crate) fn nanos_since(start: Instant) -> u64 {
    start.elapsed().as_nanos() as u64
}
