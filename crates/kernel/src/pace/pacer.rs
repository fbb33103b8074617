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
    /// Time may come to here, which is earlier; then ask again.
    Come(SimTime),
    /// It is held, and whoever runs it wants to know.
    Held,
    Stop(String),
    WallTime,
}

/// What a held run may do.
enum Step {
    /// Run the instant.
    Go,
    /// Let time pass up to here, where a step of simulated time ends.
    Come(SimTime),
    /// Look anew: the wishes have changed.
    Again,
    /// Stand.
    Stand,
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
    /// Simulated time at which a pause or a change of pace began, if one did.
    held_at: Option<SimTime>,
    /// Whether a held run is handed back, and not waited for here.
    hands_back: bool,
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
            held_at: None,
            hands_back: false,
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

    pub(crate) fn set_hands_back(&mut self, hands_back: bool) {
        self.hands_back = hands_back;
    }

    /// Waits until the control is used after it was last looked at, or the time is over.
    pub(crate) fn wait_held(&mut self, at_most: Duration) {
        self.until_wall_check = 0;
        if *self.control.wishes() == self.seen {
            self.wait(Some(at_most));
        }
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
        loop {
            self.version = self.control.version();
            self.seen = self.control.wishes().clone();
            if let Some(reason) = &self.seen.stop {
                return Gate::Stop(reason.clone());
            }

            let pace_changed = self.anchor.map(|anchor| anchor.factor) != self.seen.factor;
            if self.held_at.is_none() && (pace_changed || self.seen.paused) {
                // What the wall clock says now, between the last instant and this one. A run that was
                // late begins anew here: it has nothing to catch up with.
                self.held_at = Some(match self.anchor {
                    Some(anchor) => anchor.sim_at(self.clock.now()).clamp(self.last, next),
                    None => self.last,
                });
            }
            if self.seen.paused {
                self.anchor = None;
                match self.take_step(next, idle) {
                    Step::Go => return self.go(next),
                    Step::Come(time) => {
                        self.go(time);
                        return Gate::Come(time);
                    }
                    Step::Again => {}
                    Step::Stand if self.hands_back => return Gate::Held,
                    Step::Stand => self.wait(None),
                }
                continue;
            }
            let Some(factor) = self.seen.factor else {
                self.anchor = None;
                return self.go(next);
            };
            let now = self.clock.now();
            if let Some(sim) = self.held_at.take() {
                self.anchor = Some(Anchor {
                    sim: sim.min(next),
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
                return self.go(next);
            }
            self.wait(Some(target - now));
        }
    }

    /// Lets the run come to a time.
    fn go(&mut self, time: SimTime) -> Gate {
        self.last = time;
        self.held_at = None;
        Gate::Go
    }

    fn take_step(&mut self, next: SimTime, idle: bool) -> Step {
        let mut wishes = self.control.wishes();
        if !wishes.paused {
            return Step::Again;
        }
        if wishes.steps > 0 {
            wishes.steps -= u64::from(!idle);
            return Step::Go;
        }
        let more_ns = std::mem::take(&mut wishes.more_ns);
        if more_ns > 0 {
            let from = wishes.until.unwrap_or(self.last).max(self.last);
            wishes.until = Some(from.saturating_add_nanos(more_ns));
        }
        match wishes.until {
            None => Step::Stand,
            Some(until) if next <= until => Step::Go,
            Some(until) => {
                wishes.until = None;
                match until > self.last {
                    true => Step::Come(until),
                    false => Step::Again,
                }
            }
        }
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
