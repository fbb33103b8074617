//! How far a run has come, for a thread that shows it.

use crate::SimTime;
use std::sync::atomic::{AtomicU64, Ordering};

/// How far a run has come. Written by the engine at each round, read by anyone; never waits.
///
/// The two numbers are read one after the other and may be of neighbouring rounds.
#[derive(Debug, Default)]
pub struct Progress {
    now: AtomicU64,
    events: AtomicU64,
}

impl Progress {
    /// The instant being run.
    #[must_use]
    pub fn now(&self) -> SimTime {
        SimTime::from_nanos(self.now.load(Ordering::Relaxed))
    }

    /// Events given to agents so far.
    #[must_use]
    pub fn events(&self) -> u64 {
        self.events.load(Ordering::Relaxed)
    }

    #[inline]
    pub(crate) fn set(&self, now: SimTime, events: u64) {
        self.now.store(now.nanos(), Ordering::Relaxed);
        self.events.store(events, Ordering::Relaxed);
    }
}
