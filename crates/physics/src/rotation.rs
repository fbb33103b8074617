//! How attitude and body rate change along a segment.
//!
//! With `q` the attitude (`world_from_body`), `w` the body rate, `I` the principal moments and `T` the
//! torque, all but `q` in the body frame:
//!
//! ```text
//! q' = q w / 2        I w' = T - w x I w                                                   (1)
//! ```
//!
//! Three cases, chosen once when a segment begins:
//!
//! - **Steady**: no torque, and the gyroscopic term `w x I w` vanishes. Then `q(s) = q exp(w s)`, exact.
//! - **Axis**: torque and rate lie along one principal axis (any axis, if all moments are equal). Then
//!   the angle is `w s + I^-1 T s^2 / 2` about that axis, exact.
//! - **Tumbling**: the rest, in steps that are counted from the start of the segment, so that asking
//!   at one time never changes the answer at another. One step takes `w` by two classical
//!   Runge-Kutta half steps and `q` by the exponential of the fourth order Magnus series,
//!
//!   ```text
//!   q(h) = q exp( (h/6) (w0 + 4 w1/2 + w1) + (h^2/12) w0 x w1 )                            (2)
//!   ```
//!
//!   (Iserles, Munthe-Kaas, Norsett, Zanna 2000, Acta Numerica 9, section 5; the sign of the last term
//!   follows from `q` standing left of `w`.) The step is the power of two of nanoseconds in which the
//!   body turns less than 0.02 rad, and in which the torque turns it less than 4e-5 rad.

use crate::limits::RATE_RAD_S_MAX;
use crate::motion::{Motion, Spin, seconds_between};
use crate::support::Support;
use crate::tumbling;
use glam::{DQuat, DVec3};
use simbeeotic_kernel::SimTime;

/// Turn of the body in one step, rad.
const STEP_TURN_RAD: f64 = 0.02;
/// Product of angular acceleration and step squared, rad.
const STEP_SPIN_UP_RAD: f64 = 4e-5;
/// Shortest and longest step, as powers of two of nanoseconds: 2 us and 134 ms.
const STEP_LOG2_RANGE: (u8, u8) = (11, 27);
/// A tumbling segment begins anew after this many steps, so that asking stays cheap.
const STEPS_PER_SEGMENT: u64 = 256;

/// `(-1)^k / (2k + 1)!` and `(-1)^k / (2k)!`: the power series of `sin(x) / x` and `cos(x)` in `x^2`.
const SINC: [f64; 6] = [
    1.0,
    -1.0 / 6.0,
    1.0 / 120.0,
    -1.0 / 5040.0,
    1.0 / 362_880.0,
    -1.0 / 39_916_800.0,
];
const COS: [f64; 7] = [
    1.0,
    -1.0 / 2.0,
    1.0 / 24.0,
    -1.0 / 720.0,
    1.0 / 40_320.0,
    -1.0 / 3_628_800.0,
    1.0 / 479_001_600.0,
];

#[inline]
fn series<const N: usize>(coefficients: [f64; N], x: f64) -> f64 {
    coefficients
        .into_iter()
        .rev()
        .fold(0.0, |sum, coefficient| coefficient + x * sum)
}

/// The unit quaternion that turns by the vector `turn`, rad: `exp(turn / 2)`.
///
/// Below half a radian by its power series, whose first term left out is below 1e-17; beyond by `libm`.
pub(crate) fn turn_by(turn: DVec3) -> DQuat {
    let square = 0.25 * turn.length_squared();
    let (sinc, cos) = if square < 0.0625 {
        (series(SINC, square), series(COS, square))
    } else {
        let half = square.sqrt();
        let (sin, cos) = libm::sincos(half);
        (sin / half, cos)
    };
    let axis = turn * (0.5 * sinc);
    DQuat::from_xyzw(axis.x, axis.y, axis.z, cos)
}

/// The rotation vector, rad, in the frame of `from`, that leads from `from` to `to` the shorter way:
/// `to = from * turn_by(turn)`.
pub(crate) fn turn_between(from: DQuat, to: DQuat) -> DVec3 {
    let turn = from.conjugate() * to;
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let axis = DVec3::new(turn.x, turn.y, turn.z);
    let sin = axis.length();
    if sin < 1e-9 {
        axis * 2.0
    } else {
        axis * (2.0 * libm::atan2(sin, turn.w) / sin)
    }
}

/// `q`, whose length is 1 but for the rounding of a product, brought back to length 1 against the drift
/// of many products: one step of Newton's iteration for `1 / |q|`.
#[inline]
pub(crate) fn unit(q: DQuat) -> DQuat {
    q * (1.5 - 0.5 * q.length_squared())
}

/// `w`, no faster than a body may turn.
fn hold(w: DVec3) -> DVec3 {
    w.clamp_length_max(RATE_RAD_S_MAX)
}

/// Euler's equation: what turns a free body's rate.
pub(crate) struct Euler {
    /// `I^-1 T`.
    spin_up: DVec3,
    /// `((I2 - I3) / I1, ...)`: the gyroscopic term is this times `(w2 w3, w3 w1, w1 w2)`.
    ratio: DVec3,
}

impl Euler {
    pub(crate) fn acceleration(&self, w: DVec3) -> DVec3 {
        self.spin_up + self.ratio * DVec3::new(w.y * w.z, w.z * w.x, w.x * w.y)
    }

    /// One classical Runge-Kutta step of order 4.
    fn step(&self, w: DVec3, h: f64) -> DVec3 {
        let k1 = self.acceleration(w);
        let k2 = self.acceleration(w + k1 * (0.5 * h));
        let k3 = self.acceleration(w + k2 * (0.5 * h));
        let k4 = self.acceleration(w + k3 * h);
        hold(w + (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0))
    }

    /// One step of equation (2).
    pub(crate) fn advance(&self, q: DQuat, w: DVec3, h: f64) -> (DQuat, DVec3) {
        let half = self.step(w, 0.5 * h);
        let full = self.step(half, 0.5 * h);
        let turn = (w + half * 4.0 + full) * (h / 6.0) + w.cross(full) * (h * h / 12.0);
        (unit(q * turn_by(turn)), full)
    }
}

impl Motion {
    /// Attitude and body rate at `t`, not before the start.
    pub(crate) fn rotation(&self, t: SimTime) -> (DQuat, DVec3) {
        let s = seconds_between(self.t0, t);
        match self.spin {
            Spin::Steady if self.w == DVec3::ZERO || s == 0.0 => (self.q, self.w),
            Spin::Steady => (unit(self.q * turn_by(self.w * s)), self.w),
            Spin::Axis => {
                let spin_up = self.spin_up();
                let turn = self.w * s + spin_up * (0.5 * s * s);
                (unit(self.q * turn_by(turn)), hold(self.w + spin_up * s))
            }
            Spin::Tumbling => tumbling::rotation(self, t.nanos() - self.t0.nanos()),
        }
    }

    /// `I^-1 T`: what the torque does to a body that does not turn.
    pub(crate) fn spin_up(&self) -> DVec3 {
        self.torque() * self.inverse_inertia()
    }

    pub(crate) fn euler(&self) -> Euler {
        let inverse = self.inverse_inertia();
        let moment = inverse.recip();
        let ratio = DVec3::new(
            (moment.y - moment.z) * inverse.x,
            (moment.z - moment.x) * inverse.y,
            (moment.x - moment.y) * inverse.z,
        );
        Euler {
            spin_up: self.spin_up(),
            ratio,
        }
    }

    /// Chooses the case and the step for the segment that begins now.
    pub(crate) fn respin(&mut self) {
        self.w = hold(self.w);
        if self.inverse_mass == 0.0 || self.support == Support::Island {
            self.spin = Spin::Steady;
            return;
        }
        let [x, y, z] = self.inverse_inertia;
        let principal = |v: DVec3| [v.x, v.y, v.z].iter().filter(|c| **c != 0.0).count() < 2;
        let even = x == y && y == z;
        let spin_up = self.spin_up();
        let along = self.w + spin_up;
        let fixed_axis = even && self.w.cross(spin_up) == DVec3::ZERO
            || principal(self.w) && principal(spin_up) && principal(along);
        self.spin = match (fixed_axis, spin_up == DVec3::ZERO) {
            (true, true) => Spin::Steady,
            (true, false) => Spin::Axis,
            (false, _) => Spin::Tumbling,
        };
        if self.spin == Spin::Tumbling {
            self.step_log2 = step_log2(self.w.length(), spin_up.length());
        }
    }

    /// When a tumbling segment should begin anew.
    pub(crate) fn respin_due(&self) -> Option<SimTime> {
        (self.spin == Spin::Tumbling).then(|| {
            self.t0
                .saturating_add_nanos(STEPS_PER_SEGMENT << self.step_log2)
        })
    }
}

/// The step for a body that turns at `rate` under a torque that would spin it up by `spin_up`.
fn step_log2(rate: f64, spin_up: f64) -> u8 {
    let step_s = (STEP_TURN_RAD / rate).min((STEP_SPIN_UP_RAD / spin_up).sqrt());
    let (least, most) = STEP_LOG2_RANGE;
    // Dividing by zero gives infinity, which the cast holds at the greatest integer.
    let nanos = (step_s * 1e9) as u64;
    (nanos.max(1).ilog2() as u8).clamp(least, most)
}

#[cfg(test)]
mod tests {
    use super::{Euler, step_log2, turn_between, turn_by};
    use glam::{DQuat, DVec3};

    /// A tumbling body under torque after 1 s, in `steps` steps.
    fn tumbled(steps: u32) -> (DQuat, DVec3) {
        let euler = Euler {
            spin_up: DVec3::new(0.3, -0.2, 0.5),
            ratio: DVec3::new(-0.5, 0.7, -0.4),
        };
        let h = 1.0 / f64::from(steps);
        let start = (DQuat::IDENTITY, DVec3::new(1.0, 2.0, -1.5));
        (0..steps).fold(start, |(q, w), _| euler.advance(q, w, h))
    }

    #[test]
    fn halving_the_step_divides_the_error_by_sixteen() {
        let (q, w) = tumbled(2048);
        let error = |steps| {
            let (q_coarse, w_coarse) = tumbled(steps);
            ((q_coarse - q).length(), w_coarse.distance(w))
        };
        let (coarse, fine) = (error(16), error(32));
        for ratio in [coarse.0 / fine.0, coarse.1 / fine.1] {
            assert!((13.0..20.0).contains(&ratio), "{ratio}");
        }
    }

    #[test]
    fn the_series_of_a_turn_agrees_with_sine_and_cosine() {
        for degree in 0..360 {
            let angle = f64::from(degree).to_radians();
            let turn = turn_by(DVec3::new(0.0, angle, 0.0));
            let (sin, cos) = libm::sincos(0.5 * angle);
            assert!(
                (turn.y - sin).abs() < 2e-16 && (turn.w - cos).abs() < 2e-16,
                "{degree} deg"
            );
        }
    }

    #[test]
    fn the_turn_between_two_attitudes_leads_from_one_to_the_other() {
        let from = turn_by(DVec3::new(0.3, -1.2, 0.7));
        for angle in [1e-12, 1e-6, 0.1, 3.0] {
            let turn = DVec3::new(0.6, 0.0, -0.8) * angle;
            let found = turn_between(from, -(from * turn_by(turn)));
            assert!(found.distance(turn) < 1e-15 + 1e-14 * angle, "{angle}");
        }
    }

    #[test]
    fn the_step_follows_rate_and_torque_within_its_range() {
        assert_eq!(step_log2(0.0, 0.0), 27);
        assert_eq!(step_log2(1e4, 0.0), 11);
        // 0.02 rad at 1 rad/s are 20 ms; 2^24 ns are 16.8 ms.
        assert_eq!(step_log2(1.0, 0.0), 24);
        assert_eq!(step_log2(0.0, 1e9), 11);
    }
}
