//! How far bodies come, at most: one count for all of them.
//!
//! Who sorts bodies into a grid wants to use it for a while, though they move on. All it needs to know
//! is a distance that none of them exceeds. With `V` the greatest speed at which any segment began (or
//! passed the last survey), `A` the greatest acceleration of any, and `s` the time since that survey,
//!
//! ```text
//! speed of any body <= V + A s,       so the count may grow by     V s + A s^2 / 2          (1)
//! ```
//!
//! A change of a segment can only raise `V` and `A`, and adds to the count how far it put the body
//! elsewhere. A survey of all bodies, now and then, brings `V` and `A` down again.

use crate::motion::{Motion, seconds_between};
use crate::physics::Physics;
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

/// Time between two surveys, s.
const SURVEY_S: f64 = 0.25;

/// The count, and what makes it grow.
#[derive(Debug, Default)]
pub(crate) struct Odometer {
    /// Somebody asked.
    wanted: AtomicBool,
    /// Whether it counts.
    runs: bool,
    /// Time of the last survey.
    at: SimTime,
    /// The count at that time, and jumps since, m.
    metres: f64,
    /// Squares of `V` and `A`, SI.
    speed_squared: f64,
    acceleration_squared: f64,
}

impl Odometer {
    fn reading(&self, now: SimTime) -> f64 {
        let s = seconds_between(self.at, now).max(0.0);
        let (speed, acceleration) = (self.speed_squared.sqrt(), self.acceleration_squared.sqrt());
        // The factor is for rounding, here and in the positions.
        self.metres + (speed + 0.5 * acceleration * s) * s * (1.0 + 1e-9)
    }

    fn note(&mut self, v: DVec3, a: DVec3) {
        self.speed_squared = self.speed_squared.max(v.length_squared());
        self.acceleration_squared = self.acceleration_squared.max(a.length_squared());
    }

    /// A body that was at `from` moves as `motion` says from `now` on.
    #[inline]
    pub(crate) fn changed(&mut self, from: DVec3, motion: &Motion, now: SimTime) {
        if self.runs {
            let (p, v, a) = motion.kinematics(now);
            self.metres += p.distance(from);
            self.note(v, a);
        }
    }

    /// The same, for a `motion` that replaces `old`.
    #[inline]
    pub(crate) fn replaced(&mut self, old: &Motion, motion: &Motion, now: SimTime) {
        if self.runs {
            self.changed(old.position(now), motion, now);
        }
    }
}

impl Physics {
    /// A count of metres that grows at least as fast as any body moves: between two instants nobody came
    /// farther, on a straight line, than the difference of the readings. Jumps count with their width.
    ///
    /// `None` before the first [`survey`](Self::survey) after the first call of this: a world whose count
    /// nobody wants does not keep it. `now` as for [`near`](Self::near).
    #[must_use]
    pub fn odometer(&self, now: SimTime) -> Option<f64> {
        if !self.odometer.wanted.load(Relaxed) {
            self.odometer.wanted.store(true, Relaxed);
        }
        self.odometer.runs.then(|| self.odometer.reading(now))
    }

    /// Sees to it that the count of [`odometer`](Self::odometer) does not grow too fast, if anybody has
    /// asked for it: one look at all bodies, four times a second at most. Changes no result.
    pub fn survey(&mut self, now: SimTime) {
        let odometer = &mut self.odometer;
        let due = !odometer.runs || seconds_between(odometer.at, now) >= SURVEY_S;
        if !odometer.wanted.load(Relaxed) || !due {
            return;
        }
        odometer.metres = odometer.reading(now);
        odometer.at = now;
        odometer.runs = true;
        (odometer.speed_squared, odometer.acceleration_squared) = (0.0, 0.0);
        for motion in &self.motions {
            let (_, v, a) = motion.kinematics(now.max(motion.t0));
            odometer.note(v, a);
        }
    }
}
