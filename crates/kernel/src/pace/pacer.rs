//! The gate before each instant.

use super::{
    clock::{Clock, Wait, WallClock},
    control::{Control, Wishes},
    lateness::Lateness,
};
use crate::SimTime;
use std::{sync::Arc, time::Duration};

/// Instants between two looks at the clock for the limit on wall time.
const WALL_EVERY: u32 = 16;

/// Whether the next instant may be run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Gate {
    Go,
    Stop(String),
    WallTime,
}

/// Holds each instant until its time has come.
pub(crate) struct Pacer {
    clock: Box<dyn Clock>,
    control: Arc<Control>,
    /// The control as last seen.
    version: u64,
    seen: Wishes,
    /// Simulated and wall time that go together, if a pace is kept.
    anchor: Option<Anchor>,
    /// The last instant let through.
    last: SimTime,
    lateness: Lateness,
    /// When the first instant asked to be let through.
    started: Option<Duration>,
    until_wall_check: u32,
}

#[derive(Clone, Copy, Debug)]
struct Anchor {
    sim: SimTime,
    wall: Duration,
    factor: f64,
}

impl Anchor {
    /// The wall time of a simulated time.
    fn wall_at(&self, sim: SimTime) -> Duration {
        let nanos = sim.nanos_since(self.sim) as f64 / self.factor;
        self.wall.saturating_add(Duration::from_nanos(nanos as u64))
    }

    /// The simulated time of a wall time.
    fn sim_at(&self, wall: Duration) -> SimTime {
        let nanos = wall.saturating_sub(self.wall).as_nanos() as f64 * self.factor;
        self.sim.saturating_add_nanos(nanos as u64)
    }
}

impl Default for Pacer {
    fn default() -> Self {
        Self {
            clock: Box::new(WallClock::default()),
            control: Arc::default(),
            version: 0,
            seen: Wishes::default(),
            anchor: None,
            last: SimTime::ZERO,
            lateness: Lateness::default(),
            started: None,
            until_wall_check: 0,
        }
    }
}

impl Pacer {
    pub(crate) fn control(&self) -> Arc<Control> {
        Arc::clone(&self.control)
    }

    pub(crate) fn set_control(&mut self, control: Arc<Control>) {
        self.version = control.version().wrapping_sub(1);
        self.control = control;
    }

    pub(crate) fn set_clock(&mut self, clock: Box<dyn Clock>) {
        self.clock = clock;
        self.anchor = None;
        self.started = None;
        self.until_wall_check = 0;
    }

    pub(crate) fn lateness(&self) -> &Lateness {
        &self.lateness
    }

    /// Has the next gate look at the clock for the limit on wall time: a lot of work was done.
    #[inline]
    pub(crate) fn check_wall_soon(&mut self) {
        self.until_wall_check = 0;
    }

    /// Returns when the instant `next` may be run, or says why it may not. `idle`: nothing will be run
    /// there, time only passes; this takes no step.
    #[inline]
    pub(crate) fn gate(&mut self, next: SimTime, idle: bool, wall_limit: Option<Duration>) -> Gate {
        if wall_limit.is_some_and(|limit| self.wall_is_over(limit)) {
            return Gate::WallTime;
        }
        if self.control.version() == self.version && self.anchor.is_none() && !self.seen.paused {
            self.last = next;
            return Gate::Go;
        }
        self.hold(next, idle)
    }

    /// Whether the limit on wall time is used up. Looks at the clock now and then.
    fn wall_is_over(&mut self, limit: Duration) -> bool {
        if self.until_wall_check > 0 {
            self.until_wall_check -= 1;
            return false;
        }
        self.until_wall_check = WALL_EVERY;
        let now = self.clock.now();
        let over = now - *self.started.get_or_insert(now) >= limit;
        if over {
            self.until_wall_check = 0;
        }
        over
    }

    fn hold(&mut self, next: SimTime, idle: bool) -> Gate {
        // Simulated time at which a pause or a change of pace began, if one did.
        let mut held_at = None;
        loop {
            self.version = self.control.version();
            self.seen = self.control.wishes().clone();
            if let Some(reason) = &self.seen.stop {
                return Gate::Stop(reason.clone());
            }

            let pace_changed = self.anchor.map(|anchor| anchor.factor) != self.seen.factor;
            if pace_changed || self.seen.paused {
                // What the wall clock says now, between the last instant and this one. A run that was
                // late begins anew here: it has nothing to catch up with.
                held_at.get_or_insert_with(|| match self.anchor {
                    Some(anchor) => anchor.sim_at(self.clock.now()).clamp(self.last, next),
                    None => self.last,
                });
            }
            if self.seen.paused {
                self.anchor = None;
                if self.take_step(idle) {
                    self.last = next;
                    return Gate::Go;
                }
                self.wait(None);
                continue;
            }
            let Some(factor) = self.seen.factor else {
                self.anchor = None;
                self.last = next;
                return Gate::Go;
            };
            let now = self.clock.now();
            if let Some(sim) = held_at.take() {
                self.anchor = Some(Anchor {
                    sim,
                    wall: now,
                    factor,
                });
            }
            let anchor = *self.anchor.get_or_insert(Anchor {
                sim: self.last,
                wall: now,
                factor,
            });
            let target = anchor.wall_at(next);
            if now >= target {
                self.lateness.add(now - target);
                self.last = next;
                return Gate::Go;
            }
            self.wait(Some(target - now));
        }
    }

    fn take_step(&mut self, idle: bool) -> bool {
        let mut wishes = self.control.wishes();
        let granted = wishes.paused && wishes.steps > 0;
        if granted && !idle {
            wishes.steps -= 1;
        }
        granted
    }

    fn wait(&mut self, at_most: Option<Duration>) {
        self.clock.wait(
            at_most,
            Wait {
                control: &self.control,
                seen: &self.seen,
            },
        );
    }
}
