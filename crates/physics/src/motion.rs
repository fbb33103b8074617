//! The trajectory segment: all that is needed to say where a body is from its last change on.
//!
//! Between two changes the force on a body is constant, so with `s` the time since the last change
//!
//! ```text
//! p(s) = p + v s + a s^2 / 2        v(s) = v + a s                                        (1)
//! ```
//!
//! is exact for any `s`, and asking costs a dozen multiplications; nothing is ever stepped for a body
//! that nobody asks about. The attitude is in `rotation`, ground support in `support`, and the
//! commands that begin a new segment in `command`.

use crate::body::Mobility;
use crate::error::BodyError;
use crate::shape::form::Place;
use crate::support::Support;
use glam::{DQuat, DVec3};
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Accel, Attitude, Enu, Pose, Position, Rate, Twist, V3};

/// One body's trajectory from its last change on.
///
/// A value: evaluating it changes nothing, copying it costs three cache lines, and a changed copy
/// takes effect with [`Physics::commit`](crate::Physics::commit). It holds good until the body's next
/// change, which may be a contact.
///
/// Frames: positions, velocities, accelerations and forces ENU; body rates and torques FLU.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub struct Motion {
    // The first line: all that the sweep of a free body needs, but for its acceleration.
    pub(crate) t0: SimTime,
    pub(crate) p: DVec3,
    pub(crate) v: DVec3,
    pub(crate) radius: f32,
    pub(crate) stamp: u32,
    // The second line. `a` is what the body would do if no ground held it.
    pub(crate) a: DVec3,
    pub(crate) q: DQuat,
    pub(crate) friction: f32,
    pub(crate) support: Support,
    pub(crate) spin: Spin,
    pub(crate) step_log2: u8,
    pub(crate) mobility: Mobility,
    // The third line.
    pub(crate) w: DVec3,
    pub(crate) gravity: f64,
    pub(crate) inverse_mass: f64,
    pub(crate) torque: [f32; 3],
    pub(crate) inverse_inertia: [f32; 3],
}

const _: () = assert!(size_of::<Motion>() == 192);

/// How the attitude changes along a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(crate) enum Spin {
    /// The body rate is constant.
    Steady,
    /// The body rate changes along its own, principal axis.
    Axis,
    /// Torque and gyroscopic term turn the body rate: there is no closed form.
    Tumbling,
}

/// Where a body is and how it moves, at one instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// The instant.
    pub time: SimTime,
    /// Position of the centre of mass, ENU, m.
    pub p_enu: DVec3,
    /// Velocity, ENU, m/s.
    pub v_enu: DVec3,
    /// Acceleration, ENU, m/s^2: that of the path, so -g in free fall and 0 at rest on the ground.
    pub a_enu: DVec3,
    /// Attitude: turns vectors of the body frame into the world frame.
    pub world_from_body: DQuat,
    /// Body rate, FLU, rad/s.
    pub w_flu: DVec3,
}

impl State {
    /// Position and attitude.
    #[must_use]
    pub fn pose(&self) -> Pose {
        Pose {
            position: Position::from_si(self.p_enu),
            attitude: Attitude::from_unit_quat(self.world_from_body),
        }
    }

    /// Velocity in the world frame and body rate in the body frame.
    #[must_use]
    pub fn twist(&self) -> Twist {
        Twist {
            linear: V3::from_si(self.v_enu),
            angular: Rate::from_si(self.w_flu),
        }
    }

    /// Acceleration of the path.
    #[must_use]
    pub fn accel(&self) -> Accel<Enu> {
        V3::from_si(self.a_enu)
    }
}

/// The span from `from` to `to` in seconds, rounded once; negative if `to` comes first.
pub(crate) fn seconds_between(from: SimTime, to: SimTime) -> f64 {
    to.nanos().wrapping_sub(from.nanos()).cast_signed() as f64 / 1e9
}

impl Motion {
    /// When this segment begins: the body's last change.
    #[must_use]
    pub const fn start(&self) -> SimTime {
        self.t0
    }

    /// Radius of the body's bounding ball, m.
    #[must_use]
    pub fn radius_m(&self) -> f64 {
        f64::from(self.radius)
    }

    /// Mass, kg; infinite if nothing can push the body.
    #[must_use]
    pub fn mass_kg(&self) -> f64 {
        1.0 / self.inverse_mass
    }

    /// Moments of inertia about the body axes, kg m^2; infinite if nothing can push the body.
    #[must_use]
    pub fn inertia_kg_m2(&self) -> DVec3 {
        self.inverse_inertia().recip()
    }

    /// Who moves this body.
    #[must_use]
    pub const fn mobility(&self) -> Mobility {
        self.mobility
    }

    /// Whether the ground carries the body.
    #[must_use]
    pub const fn support(&self) -> Support {
        self.support
    }

    /// The force that was set, without weight, ENU, N; exact to the rounding of `F / m`.
    #[must_use]
    pub fn force(&self) -> DVec3 {
        if self.inverse_mass > 0.0 {
            (self.a + DVec3::new(0.0, 0.0, self.gravity)) / self.inverse_mass
        } else {
            DVec3::ZERO
        }
    }

    /// The torque that was set, FLU, N m, to 24 bits.
    #[must_use]
    pub fn torque(&self) -> DVec3 {
        DVec3::from_array(self.torque.map(f64::from))
    }

    /// The state at `t`. Pure, and exact for every `t` from [`start`](Self::start) to the body's next
    /// change; before the start, the state at the start.
    #[inline]
    #[must_use]
    pub fn at(&self, t: SimTime) -> State {
        let t = t.max(self.t0);
        let (p_enu, v_enu, a_enu) = self.kinematics(t);
        let (world_from_body, w_flu) = self.rotation(t);
        State {
            time: t,
            p_enu,
            v_enu,
            a_enu,
            world_from_body,
            w_flu,
        }
    }

    /// All that changes from segment to segment but the start time, as numbers: two segments of one
    /// body that begin at one time are the same if these are. Nothing is evaluated.
    #[inline]
    #[must_use]
    pub fn numbers(&self) -> [f64; 20] {
        let (p, v, a, q, w) = (self.p, self.v, self.a, self.q, self.w);
        let [tx, ty, tz] = self.torque.map(f64::from);
        let support = f64::from(self.support as u8);
        [
            p.x, p.y, p.z, v.x, v.y, v.z, a.x, a.y, a.z, q.x, q.y, q.z, q.w, w.x, w.y, w.z, tx, ty,
            tz, support,
        ]
    }

    /// Position at `t`, ENU, m.
    #[inline]
    #[must_use]
    pub fn position(&self, t: SimTime) -> DVec3 {
        self.kinematics(t.max(self.t0)).0
    }

    /// Velocity at `t`, ENU, m/s.
    #[inline]
    #[must_use]
    pub fn velocity(&self, t: SimTime) -> DVec3 {
        self.kinematics(t.max(self.t0)).1
    }

    /// Acceleration of the path along this segment, ENU, m/s^2: -g in free fall, 0 at rest on the
    /// ground.
    #[inline]
    #[must_use]
    pub fn acceleration(&self) -> DVec3 {
        match self.support {
            Support::None => self.a,
            Support::Sliding => self.sliding_acceleration(),
            Support::Resting | Support::Island => DVec3::ZERO,
        }
    }

    /// Attitude at `t`: turns vectors of the body frame into the world frame.
    #[must_use]
    pub fn attitude(&self, t: SimTime) -> DQuat {
        self.rotation(t.max(self.t0)).0
    }

    /// Body rate at `t`, FLU, rad/s.
    #[must_use]
    pub fn rate(&self, t: SimTime) -> DVec3 {
        self.rotation(t.max(self.t0)).1
    }

    /// Angular acceleration at `t`: how the body rate changes, FLU, rad/s^2.
    #[must_use]
    pub fn angular_acceleration(&self, t: SimTime) -> DVec3 {
        match self.spin {
            Spin::Steady => DVec3::ZERO,
            Spin::Axis => self.spin_up(),
            Spin::Tumbling => self.euler().acceleration(self.rate(t)),
        }
    }

    /// Position, velocity and acceleration at `t`, equation (1). `t` may lie before the start.
    #[inline]
    pub(crate) fn kinematics(&self, t: SimTime) -> (DVec3, DVec3, DVec3) {
        let a = self.acceleration();
        let s = seconds_between(self.t0, t);
        (self.p + self.v * s + a * (0.5 * s * s), self.v + a * s, a)
    }

    /// Where the body stands at `t`.
    pub(crate) fn place(&self, t: SimTime) -> Place {
        Place {
            p: self.position(t),
            q: self.attitude(t),
        }
    }

    pub(crate) fn inverse_inertia(&self) -> DVec3 {
        DVec3::from_array(self.inverse_inertia.map(f64::from))
    }

    /// Whether the centre of mass stands still, and will until someone changes that.
    pub(crate) fn stands(&self) -> bool {
        self.v == DVec3::ZERO && self.acceleration() == DVec3::ZERO
    }

    /// Begins the segment anew at `t`, on the same path. Does nothing at its own start.
    ///
    /// # Errors
    /// [`BodyError::Backwards`] if `t` lies before the start.
    pub fn advance(&mut self, t: SimTime) -> Result<(), BodyError> {
        if t < self.t0 {
            return Err(BodyError::Backwards {
                asked: t,
                last: self.t0,
            });
        }
        self.carry(t);
        Ok(())
    }

    /// Begins a segment at `t` that an island leads: at constant velocity [ENU] and body rate [FLU]. What
    /// acts on the body stays known.
    pub(crate) fn lead(&mut self, t: SimTime, v: DVec3, w: DVec3) {
        self.carry(t);
        self.support = Support::Island;
        self.spin = Spin::Steady;
        (self.v, self.w) = (v, w);
    }

    /// Begins a free segment at `t`, with velocity and rate of turn in ENU.
    pub(crate) fn release(&mut self, t: SimTime, v: DVec3, w_enu: DVec3) {
        self.carry(t);
        self.support = Support::None;
        (self.v, self.w) = (v, self.q.conjugate() * w_enu);
        self.respin();
    }

    /// [`advance`](Self::advance) to a time that is not before the start.
    pub(crate) fn carry(&mut self, t: SimTime) {
        if t == self.t0 {
            return;
        }
        let (p, v, _) = self.kinematics(t);
        let (q, w) = self.rotation(t);
        (self.p, self.v, self.q) = (p, v, q);
        if self.spin != Spin::Steady {
            self.w = w;
            self.respin();
        }
        self.t0 = t;
    }
}
