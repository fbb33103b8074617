//! A body on the ground: it slides until friction has stopped it, then it rests.
//!
//! A body that meets the ground too slowly to bounce, and that the net force presses down, is carried:
//! its vertical velocity is 0 and its vertical acceleration is taken up by the ground. What remains is
//! motion in the plane under a constant tangential acceleration `f` and Coulomb friction,
//!
//! ```text
//! v' = f - mu N v / |v|        N = -a_up                                                    (1)
//! ```
//!
//! If `f` lies along `v` (or is zero) this is uniform deceleration, and the time of the stop,
//! `|v| / (mu N - f)`, is exact. Otherwise the direction of friction turns with the velocity; it is
//! held while the velocity turns by 0.02 rad, then the segment begins anew.
//!
//! The ground holds a body as by its landing gear: it slides, it does not roll, and when it has stopped
//! it no longer spins. A command that lifts it, or gives it an upward velocity, ends the support;
//! commands that press it down are taken up. Rolling, toppling and stacking are not done yet.

use crate::limits::{LIFT_M_S2, STANDING_SPEED_M_S};
use crate::motion::Motion;
use glam::{DVec2, DVec3};
use simbeeotic_kernel::SimTime;

/// Whether the ground carries a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Support {
    /// It does not: the body flies, or falls.
    #[default]
    None,
    /// It does, and the body slides over it.
    Sliding,
    /// It does, and the body stands still.
    Resting,
    /// The body is in lasting contact, with other bodies, or with the ground in a way that no formula
    /// describes (rolling, toppling), and is stepped together with those it touches. Between two steps it
    /// moves at constant velocity and body rate; at rest both are zero.
    Island,
}

/// Tangent of the angle by which a sliding body may turn before the direction of friction follows.
const TURN_TAN: f64 = 0.02;

impl Motion {
    /// Friction at most, as an acceleration.
    fn grip(&self) -> f64 {
        f64::from(self.friction) * (-self.a.z).max(0.0)
    }

    /// Equation (1) with the direction at the start of the segment; a body that still stands slides
    /// where it is pushed.
    pub(crate) fn sliding_acceleration(&self) -> DVec3 {
        let push = self.a.truncate();
        let velocity = self.v.truncate();
        let direction = if velocity == DVec2::ZERO {
            push
        } else {
            velocity
        };
        let length = direction.length();
        if length > 0.0 {
            (push - direction * (self.grip() / length)).extend(0.0)
        } else {
            DVec3::ZERO
        }
    }

    /// Begins support: called when the body has met the ground.
    pub(crate) fn land(&mut self) {
        self.support = Support::Sliding;
        self.stand();
    }

    /// What becomes of a supported body after its velocity or the force on it has changed.
    pub(crate) fn stand(&mut self) {
        if matches!(self.support, Support::None | Support::Island) {
            return;
        }
        if self.v.z > 0.0 || self.a.z > LIFT_M_S2 {
            self.support = Support::None;
            return;
        }
        self.v.z = 0.0;
        let speed = self.v.truncate().length();
        if speed < STANDING_SPEED_M_S && self.a.truncate().length() <= self.grip() {
            self.v = DVec3::ZERO;
            if self.support == Support::Sliding {
                self.w = DVec3::ZERO;
                self.respin();
            }
            self.support = Support::Resting;
        } else {
            self.support = Support::Sliding;
        }
    }

    /// When a sliding body stops, or has turned so far that the direction of friction has to follow.
    pub(crate) fn slide_due(&self) -> Option<SimTime> {
        if self.support != Support::Sliding || self.grip() == 0.0 {
            return None;
        }
        let velocity = self.v.truncate();
        let speed = velocity.length();
        if speed == 0.0 {
            return None;
        }
        let forward = velocity / speed;
        let acceleration = self.sliding_acceleration().truncate();
        let along = acceleration.dot(forward);
        let across = (acceleration - forward * along).length();
        let stop_s = if along < 0.0 {
            speed / -along
        } else {
            f64::INFINITY
        };
        let turning = across - TURN_TAN * along;
        let turn_s = if turning > 0.0 {
            TURN_TAN * speed / turning
        } else {
            f64::INFINITY
        };
        let due_s = stop_s.min(turn_s);
        due_s.is_finite().then(|| {
            self.t0
                .saturating_add_nanos(((due_s * 1e9).round() as u64).max(1))
        })
    }

    /// Brings a sliding body to its stop, or lets friction follow its turn.
    pub(crate) fn slide(&mut self, t: SimTime) {
        let before = self.v.truncate();
        self.carry(t);
        let after = self.v.truncate();
        // Rounding the stop to a nanosecond leaves a remainder of either sign.
        if after.dot(before) <= 0.0 || after.length() < STANDING_SPEED_M_S {
            self.v = DVec3::ZERO;
        }
        self.stand();
    }
}
