//! Clocks to pace by: the wall's, and one for tests.

use super::control::{Control, Wishes};
use std::{
    fmt,
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

/// A clock that a run is paced by.
pub trait Clock: Send {
    /// Time since some fixed moment. Never goes back.
    fn now(&self) -> Duration;

    /// Waits this long (`None`: for as long as it takes) or until the control is used; may return early.
    fn wait(&mut self, at_most: Option<Duration>, wait: Wait<'_>);
}

/// What a clock waits on while a run is held: the control, and what was known of it.
#[derive(Debug)]
pub struct Wait<'a> {
    pub(super) control: &'a Control,
    pub(super) seen: &'a Wishes,
}

impl Wait<'_> {
    /// Blocks this thread for a span of real time or until the control is used.
    pub fn block(&self, at_most: Option<Duration>) {
        self.control.wait_for_change(self.seen, at_most);
    }

    /// The control that the run is held by.
    #[must_use]
    pub fn control(&self) -> &Control {
        self.control
    }
}

/// The wall clock: monotonic, from when it was made.
#[derive(Clone, Copy, Debug)]
pub struct WallClock(Instant);

impl Default for WallClock {
    fn default() -> Self {
        #[expect(
            clippy::disallowed_methods,
            reason = "pacing: the wall clock is the subject here"
        )]
        let start = Instant::now();
        Self(start)
    }
}

impl Clock for WallClock {
    fn now(&self) -> Duration {
        self.0.elapsed()
    }

    fn wait(&mut self, at_most: Option<Duration>, wait: Wait<'_>) {
        wait.block(at_most);
    }
}

/// A clock for tests: stands still except when it is waited on or moved by hand, and does what it was
/// told to do at its times. Clones are the same clock.
///
/// A wait that would never end (a pause that no action ends) stops the run instead of hanging the test.
#[derive(Clone, Default)]
pub struct FakeClock(Arc<Mutex<Script>>);

type Action = Box<dyn FnOnce(&Control) + Send>;

#[derive(Default)]
struct Script {
    now: Duration,
    actions: Vec<(Duration, Action)>,
}

impl FakeClock {
    /// A clock at zero.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Moves the clock on, as work that takes time does.
    pub fn advance(&self, time: Duration) {
        self.script().now += time;
    }

    /// Does something to the control when a wait reaches this time.
    pub fn at(&self, time: Duration, action: impl FnOnce(&Control) + Send + 'static) {
        let mut script = self.script();
        script.actions.push((time, Box::new(action)));
        script.actions.sort_by_key(|(time, _)| *time);
    }

    fn script(&self) -> std::sync::MutexGuard<'_, Script> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Clock for FakeClock {
    fn now(&self) -> Duration {
        self.script().now
    }

    fn wait(&mut self, at_most: Option<Duration>, wait: Wait<'_>) {
        let action = {
            let mut script = self.script();
            let end = at_most.map(|time| script.now + time);
            match script.actions.first() {
                Some((time, _)) if end.is_none_or(|end| *time <= end) => {
                    script.now = script.now.max(*time);
                    script.actions.remove(0).1
                }
                _ => match end {
                    Some(end) => {
                        script.now = end;
                        return;
                    }
                    None => Box::new(|control: &Control| control.stop("nobody ends this pause")),
                },
            }
        };
        action(wait.control);
    }
}

impl fmt::Debug for FakeClock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("FakeClock")
            .field(&self.script().now)
            .finish()
    }
}
