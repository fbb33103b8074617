//! The handle by which other threads pace, pause, step and stop a run.

use crate::SimTime;
use std::{
    sync::{
        Condvar, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};

/// Paces, pauses, steps and stops a run, from any thread. Takes effect between two instants.
///
/// ```
/// use simbeeotic_kernel::pace::Control;
///
/// let control = Control::default();
/// control.set_factor(Some(2.0))?; // two simulated seconds a second
/// control.pause();
/// control.step(1); // one instant, then it stands again
/// control.step_by(100_000_000); // a tenth of a simulated second, then it stands again
/// control.resume();
/// control.stop("interrupted");
/// assert!(control.set_factor(Some(0.0)).is_err());
/// # Ok::<(), simbeeotic_kernel::pace::PaceError>(())
/// ```
#[derive(Debug, Default)]
pub struct Control {
    /// Counts changes, so that the engine can see at a glance that there is none.
    version: AtomicU64,
    wishes: Mutex<Wishes>,
    changed: Condvar,
}

/// What has been asked for.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Wishes {
    pub(super) factor: Option<f64>,
    pub(super) paused: bool,
    /// Instants that may be run while paused.
    pub(super) steps: u64,
    /// Simulated time up to which instants may be run while paused.
    pub(super) until: Option<SimTime>,
    /// Nanoseconds to put on top of that, or of where the run stands.
    pub(super) more_ns: u64,
    pub(super) stop: Option<String>,
}

impl Wishes {
    fn forget_steps(&mut self) {
        (self.steps, self.until, self.more_ns) = (0, None, 0);
    }
}

/// A pace that cannot be kept.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("a pace of {0} is not a positive number; use 1 for the speed of the wall clock")]
pub struct PaceError(pub f64);

impl Control {
    /// At most `factor` times as fast as the wall clock; `None` (or infinity) is as fast as possible.
    ///
    /// # Errors
    ///
    /// A factor that is not positive, or not a number. The pace stays as it was.
    pub fn set_factor(&self, factor: Option<f64>) -> Result<(), PaceError> {
        let factor = factor.filter(|f| *f != f64::INFINITY);
        if let Some(wrong) = factor.filter(|f| !(f.is_finite() && *f > 0.0)) {
            return Err(PaceError(wrong));
        }
        self.change(|wishes| wishes.factor = factor);
        Ok(())
    }

    /// The pace asked for.
    #[must_use]
    pub fn factor(&self) -> Option<f64> {
        self.wishes().factor
    }

    /// Holds the run before its next instant.
    pub fn pause(&self) {
        self.change(|wishes| {
            wishes.paused = true;
            wishes.forget_steps();
        });
    }

    /// Lets a held run go on, at the pace it had.
    pub fn resume(&self) {
        self.change(|wishes| {
            wishes.paused = false;
            wishes.forget_steps();
        });
    }

    /// Runs this many more instants, at once, and holds the run again; pauses a run that is not held.
    pub fn step(&self, instants: u64) {
        self.change(|wishes| {
            wishes.paused = true;
            let steps = wishes.steps.saturating_add(instants);
            wishes.forget_steps();
            wishes.steps = steps;
        });
    }

    /// Runs on to this simulated time, at once, all instants up to and including it, and holds the run
    /// there, also if nothing happens at that time; pauses a run that is not held. A time that is over
    /// only pauses. Takes the place of steps that are still to be run.
    pub fn step_to(&self, time: SimTime) {
        self.change(|wishes| {
            wishes.paused = true;
            wishes.forget_steps();
            wishes.until = Some(time);
        });
    }

    /// The same for a span of simulated time, from where the run stands, or from where it is going to
    /// stand: twice 0.1 s is 0.2 s, however fast one comes after the other.
    pub fn step_by(&self, nanos: u64) {
        self.change(|wishes| {
            wishes.paused = true;
            wishes.steps = 0;
            wishes.more_ns = wishes.more_ns.saturating_add(nanos);
        });
    }

    /// Whether the run is held, or about to be.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.wishes().paused
    }

    /// Ends the run, for good, even if it is held. The first reason counts.
    pub fn stop(&self, reason: impl Into<String>) {
        self.change(|wishes| {
            wishes.stop.get_or_insert_with(|| reason.into());
        });
    }

    /// Why the run was asked to stop, if it was.
    #[must_use]
    pub fn stop_reason(&self) -> Option<String> {
        self.wishes().stop.clone()
    }

    fn change(&self, change: impl FnOnce(&mut Wishes)) {
        change(&mut self.wishes());
        self.version.fetch_add(1, Ordering::Release);
        self.changed.notify_all();
    }

    /// The wishes are plain values and whole after each statement: a panic elsewhere spoils nothing.
    pub(super) fn wishes(&self) -> MutexGuard<'_, Wishes> {
        self.wishes.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes with each change.
    #[inline]
    pub(super) fn version(&self) -> u64 {
        self.version.load(Ordering::Acquire)
    }

    /// Waits until something differs from `seen`, or the time is over; `None` waits as long as it takes.
    pub(super) fn wait_for_change(&self, seen: &Wishes, at_most: Option<Duration>) {
        let wishes = self.wishes();
        let same = |wishes: &mut Wishes| wishes == seen;
        match at_most {
            Some(time) => drop(self.changed.wait_timeout_while(wishes, time, same)),
            None => drop(self.changed.wait_while(wishes, same)),
        }
    }
}
