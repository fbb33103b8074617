//! Commands: what begins a new segment.
//!
//! Every command names its time, advances the segment to it, and changes one thing. Commands that make
//! no sense (NaN, a force that causes a million g, a time in the past, a push on a fixed body) are
//! refused, and then nothing has changed. Forces and torques hold until they are set again; weight is
//! the body's own affair and not part of them.

use crate::body::{BodySpec, Mobility};
use crate::error::{self, BodyError};
use crate::limits;
use crate::motion::{Motion, Spin};
use crate::rotation;
use crate::shape::Shape;
use crate::support::Support;
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::Attitude;

/// The bounding radius to 24 bits: a ball's to the nearest, others' rounded up, so that it still bounds.
fn bounding_radius(shape: &Shape) -> f32 {
    let exact = shape.bounding_radius_m();
    let radius = exact as f32;
    if f64::from(radius) < exact && !matches!(shape, Shape::Sphere { .. }) {
        radius.next_up()
    } else {
        radius
    }
}

impl Motion {
    /// The segment that a checked `spec` begins with. `friction` is that between body and ground.
    pub(crate) fn new(spec: &BodySpec, gravity: f64, friction: f64) -> Self {
        let free = spec.mobility == Mobility::Free;
        let gravity = if free && spec.gravity { gravity } else { 0.0 };
        let fixed = spec.mobility == Mobility::Fixed;
        let moving = |v: DVec3| if fixed { DVec3::ZERO } else { v };
        let inverse_inertia = if free {
            spec.inertia_kg_m2.recip()
        } else {
            DVec3::ZERO
        };
        let mut motion = Self {
            t0: SimTime::ZERO,
            p: spec.p_enu,
            v: moving(spec.v_enu),
            radius: bounding_radius(&spec.shape),
            stamp: 0,
            a: DVec3::new(0.0, 0.0, -gravity),
            q: rotation::unit(spec.attitude.quat()),
            friction: friction as f32,
            support: Support::None,
            spin: Spin::Steady,
            step_log2: 0,
            mobility: spec.mobility,
            w: moving(spec.w_flu),
            gravity,
            inverse_mass: if free { spec.mass_kg.recip() } else { 0.0 },
            torque: [0.0; 3],
            inverse_inertia: inverse_inertia.to_array().map(|i| i as f32),
        };
        motion.respin();
        motion
    }

    /// An error if nothing can push this body.
    fn pushed(&self, command: &'static str) -> Result<(), BodyError> {
        let mobility = match self.mobility {
            Mobility::Free => return Ok(()),
            Mobility::Driven => "driven from outside",
            Mobility::Fixed => "fixed",
        };
        Err(BodyError::Immovable { command, mobility })
    }

    /// An error if nobody may move this body.
    fn moved(&self, command: &'static str) -> Result<(), BodyError> {
        if self.mobility == Mobility::Fixed {
            Err(BodyError::Immovable {
                command,
                mobility: "fixed",
            })
        } else {
            Ok(())
        }
    }

    fn accelerate(&mut self, t: SimTime, a: DVec3) -> Result<(), BodyError> {
        error::bounded(
            "acceleration by the force [m/s^2]",
            a,
            limits::ACCELERATION_M_S2_MAX,
        )?;
        self.advance(t)?;
        self.a = a;
        self.stand();
        Ok(())
    }

    fn accelerate_with_torque(
        &mut self,
        t: SimTime,
        a: DVec3,
        torque: DVec3,
    ) -> Result<(), BodyError> {
        self.check_torque(torque)?;
        self.accelerate(t, a)?;
        self.twist(torque);
        Ok(())
    }

    fn check_torque(&self, torque: DVec3) -> Result<(), BodyError> {
        error::finite("torque [N m]", torque)?;
        let spin_up = torque * self.inverse_inertia();
        error::bounded(
            "angular acceleration by the torque [rad/s^2]",
            spin_up,
            limits::ANGULAR_ACCELERATION_RAD_S2_MAX,
        )
    }

    fn twist(&mut self, torque: DVec3) {
        self.torque = torque.to_array().map(|t| t as f32);
        self.respin();
    }

    /// Lets `force` [ENU, N] act on the centre of mass from `t` on, in place of what acted before.
    ///
    /// # Errors
    /// Not finite, more than 1e6 m/s^2 on this mass, a time in the past, a body that nothing pushes.
    pub fn set_force(&mut self, t: SimTime, force: DVec3) -> Result<(), BodyError> {
        self.pushed("a force")?;
        error::finite("force [N]", force)?;
        self.accelerate(
            t,
            force * self.inverse_mass - DVec3::new(0.0, 0.0, self.gravity),
        )
    }

    /// Lets `force` [ENU, N] act on the centre of mass from `t` on, besides what acts already.
    ///
    /// # Errors
    /// As [`set_force`](Self::set_force), of the sum.
    pub fn add_force(&mut self, t: SimTime, force: DVec3) -> Result<(), BodyError> {
        self.pushed("a force")?;
        error::finite("force [N]", force)?;
        self.accelerate(t, self.a + force * self.inverse_mass)
    }

    /// Lets `force` [ENU, N] act at `arm` [ENU, m, from the centre of mass] from `t` on, besides what
    /// acts already. Its torque about the centre of mass stays fixed in the body as it is at `t`.
    ///
    /// # Errors
    /// As [`set_force`](Self::set_force) and [`set_torque`](Self::set_torque), of the sums.
    pub fn add_force_at(&mut self, t: SimTime, force: DVec3, arm: DVec3) -> Result<(), BodyError> {
        self.pushed("a force")?;
        error::finite("force [N]", force)?;
        error::bounded("arm of the force [m]", arm, limits::EXTENT_M_MAX)?;
        let torque = self.attitude(t).conjugate() * arm.cross(force);
        self.accelerate_with_torque(
            t,
            self.a + force * self.inverse_mass,
            self.torque() + torque,
        )
    }

    /// Lets `torque` [FLU, N m] act from `t` on, in place of what acted before. It turns with the
    /// body. Kept to 24 bits (7 digits).
    ///
    /// # Errors
    /// Not finite, more than 1e7 rad/s^2 on this body, a time in the past, a body that nothing pushes.
    pub fn set_torque(&mut self, t: SimTime, torque: DVec3) -> Result<(), BodyError> {
        self.pushed("a torque")?;
        self.check_torque(torque)?;
        self.advance(t)?;
        self.twist(torque);
        Ok(())
    }

    /// Lets `torque` [FLU, N m] act from `t` on, besides what acts already.
    ///
    /// # Errors
    /// As [`set_torque`](Self::set_torque), of the sum.
    pub fn add_torque(&mut self, t: SimTime, torque: DVec3) -> Result<(), BodyError> {
        self.set_torque(t, self.torque() + torque)
    }

    /// Sets force [ENU, N] and torque [FLU, N m] at once.
    ///
    /// # Errors
    /// As [`set_force`](Self::set_force) and [`set_torque`](Self::set_torque).
    pub fn set_wrench(&mut self, t: SimTime, force: DVec3, torque: DVec3) -> Result<(), BodyError> {
        self.pushed("a force")?;
        error::finite("force [N]", force)?;
        let a = force * self.inverse_mass - DVec3::new(0.0, 0.0, self.gravity);
        self.accelerate_with_torque(t, a, torque)
    }

    /// Changes the velocity at once by `impulse` [ENU, N s] over the mass.
    ///
    /// # Errors
    /// Not finite, a resulting speed above 1e5 m/s, a time in the past, a body that nothing pushes.
    pub fn add_impulse(&mut self, t: SimTime, impulse: DVec3) -> Result<(), BodyError> {
        self.pushed("an impulse")?;
        error::finite("impulse [N s]", impulse)?;
        self.set_velocity(t, self.velocity(t) + impulse * self.inverse_mass)
    }

    /// Changes velocity and body rate at once by an `impulse` [ENU, N s] at `arm` [ENU, m, from the
    /// centre of mass].
    ///
    /// # Errors
    /// As [`add_impulse`](Self::add_impulse) and [`set_rate`](Self::set_rate), of the results.
    pub fn add_impulse_at(
        &mut self,
        t: SimTime,
        impulse: DVec3,
        arm: DVec3,
    ) -> Result<(), BodyError> {
        self.pushed("an impulse")?;
        error::finite("impulse [N s]", impulse)?;
        error::bounded("arm of the impulse [m]", arm, limits::EXTENT_M_MAX)?;
        let state = self.at(t);
        let angular = state.world_from_body.conjugate() * arm.cross(impulse);
        let v = state.v_enu + impulse * self.inverse_mass;
        self.set_twist(t, v, state.w_flu + angular * self.inverse_inertia())
    }

    /// Changes the body rate at once by `impulse` [FLU, N m s] over the moments of inertia.
    ///
    /// # Errors
    /// Not finite, a resulting rate above 1e4 rad/s, a time in the past, a body that nothing pushes.
    pub fn add_angular_impulse(&mut self, t: SimTime, impulse: DVec3) -> Result<(), BodyError> {
        self.pushed("an impulse")?;
        error::finite("angular impulse [N m s]", impulse)?;
        self.set_rate(t, self.rate(t) + impulse * self.inverse_inertia())
    }

    /// Sets the velocity [ENU, m/s]. The ground takes up the downward part for a body that it carries.
    ///
    /// # Errors
    /// Not finite, faster than 1e5 m/s, a time in the past, a fixed body.
    pub fn set_velocity(&mut self, t: SimTime, v: DVec3) -> Result<(), BodyError> {
        self.moved("a velocity")?;
        error::bounded("velocity [m/s]", v, limits::SPEED_M_S_MAX)?;
        self.advance(t)?;
        self.v = v;
        self.stand();
        Ok(())
    }

    /// Sets the body rate [FLU, rad/s].
    ///
    /// # Errors
    /// Not finite, faster than 1e4 rad/s, a time in the past, a fixed body.
    pub fn set_rate(&mut self, t: SimTime, w: DVec3) -> Result<(), BodyError> {
        self.moved("a body rate")?;
        error::bounded("body rate [rad/s]", w, limits::RATE_RAD_S_MAX)?;
        self.advance(t)?;
        self.w = w;
        self.respin();
        Ok(())
    }

    /// Sets velocity [ENU, m/s] and body rate [FLU, rad/s] at once.
    ///
    /// # Errors
    /// As [`set_velocity`](Self::set_velocity) and [`set_rate`](Self::set_rate).
    pub fn set_twist(&mut self, t: SimTime, v: DVec3, w: DVec3) -> Result<(), BodyError> {
        self.moved("a velocity")?;
        error::bounded("velocity [m/s]", v, limits::SPEED_M_S_MAX)?;
        self.set_rate(t, w)?;
        self.set_velocity(t, v)
    }

    /// Puts the centre of mass at `p` [ENU, m] without a way between; velocity and attitude stay.
    ///
    /// # Errors
    /// Not finite, farther than 1e9 m, a time in the past, a fixed body.
    pub fn set_position(&mut self, t: SimTime, p: DVec3) -> Result<(), BodyError> {
        self.moved("a position")?;
        error::bounded("position [m]", p, limits::POSITION_M_MAX)?;
        self.advance(t)?;
        if p.z != self.p.z && self.support != Support::Island {
            self.support = Support::None;
        }
        self.p = p;
        Ok(())
    }

    /// Sets the attitude; the body rate stays the same in the body frame.
    ///
    /// # Errors
    /// Not finite, not of unit length, a time in the past, a fixed body.
    pub fn set_attitude(&mut self, t: SimTime, attitude: Attitude) -> Result<(), BodyError> {
        self.moved("an attitude")?;
        error::attitude(attitude)?;
        self.advance(t)?;
        self.q = rotation::unit(attitude.quat());
        Ok(())
    }

    /// Sets position [ENU, m] and attitude at once.
    ///
    /// # Errors
    /// As [`set_position`](Self::set_position).
    pub fn set_pose(&mut self, t: SimTime, p: DVec3, attitude: Attitude) -> Result<(), BodyError> {
        error::attitude(attitude)?;
        self.set_position(t, p)?;
        self.set_attitude(t, attitude)
    }

    /// Turns the body at once by the rotation vector `turn` [FLU, rad].
    ///
    /// # Errors
    /// Not finite, more than 1e4 rad, a time in the past, a fixed body.
    pub fn turn(&mut self, t: SimTime, turn: DVec3) -> Result<(), BodyError> {
        self.moved("an attitude")?;
        error::bounded("turn [rad]", turn, limits::RATE_RAD_S_MAX)?;
        self.advance(t)?;
        self.q = rotation::unit(self.q * rotation::turn_by(turn));
        Ok(())
    }
}

/// The same commands in the other frame: forces and impulses in the body's, torques and rates in the
/// world's. They are turned once, by the attitude at `t`: what acts on from then on keeps its direction
/// in the frame that its kind has (forces in the world, torques in the body).
impl Motion {
    /// Lets `force` [FLU, N] act on the centre of mass from `t` on, in place of what acted before.
    ///
    /// # Errors
    /// As [`set_force`](Self::set_force).
    pub fn set_force_flu(&mut self, t: SimTime, force: DVec3) -> Result<(), BodyError> {
        self.set_force(t, self.attitude(t) * force)
    }

    /// Lets `force` [FLU, N] act on the centre of mass from `t` on, besides what acts already.
    ///
    /// # Errors
    /// As [`add_force`](Self::add_force).
    pub fn add_force_flu(&mut self, t: SimTime, force: DVec3) -> Result<(), BodyError> {
        self.add_force(t, self.attitude(t) * force)
    }

    /// Lets `force` [FLU, N] act at `arm` [FLU, m, from the centre of mass] from `t` on, besides what
    /// acts already.
    ///
    /// # Errors
    /// As [`add_force_at`](Self::add_force_at).
    pub fn add_force_at_flu(
        &mut self,
        t: SimTime,
        force: DVec3,
        arm: DVec3,
    ) -> Result<(), BodyError> {
        let world_from_body = self.attitude(t);
        self.add_force_at(t, world_from_body * force, world_from_body * arm)
    }

    /// Lets `torque` [ENU, N m] act from `t` on, in place of what acted before.
    ///
    /// # Errors
    /// As [`set_torque`](Self::set_torque).
    pub fn set_torque_enu(&mut self, t: SimTime, torque: DVec3) -> Result<(), BodyError> {
        self.set_torque(t, self.attitude(t).conjugate() * torque)
    }

    /// Lets `torque` [ENU, N m] act from `t` on, besides what acts already.
    ///
    /// # Errors
    /// As [`set_torque`](Self::set_torque), of the sum.
    pub fn add_torque_enu(&mut self, t: SimTime, torque: DVec3) -> Result<(), BodyError> {
        self.add_torque(t, self.attitude(t).conjugate() * torque)
    }

    /// Changes the velocity at once by `impulse` [FLU, N s] over the mass.
    ///
    /// # Errors
    /// As [`add_impulse`](Self::add_impulse).
    pub fn add_impulse_flu(&mut self, t: SimTime, impulse: DVec3) -> Result<(), BodyError> {
        self.add_impulse(t, self.attitude(t) * impulse)
    }

    /// Changes velocity and body rate at once by an `impulse` [FLU, N s] at `arm` [FLU, m, from the
    /// centre of mass].
    ///
    /// # Errors
    /// As [`add_impulse_at`](Self::add_impulse_at).
    pub fn add_impulse_at_flu(
        &mut self,
        t: SimTime,
        impulse: DVec3,
        arm: DVec3,
    ) -> Result<(), BodyError> {
        let world_from_body = self.attitude(t);
        self.add_impulse_at(t, world_from_body * impulse, world_from_body * arm)
    }

    /// Changes the body rate at once by `impulse` [ENU, N m s] over the moments of inertia.
    ///
    /// # Errors
    /// As [`add_angular_impulse`](Self::add_angular_impulse).
    pub fn add_angular_impulse_enu(&mut self, t: SimTime, impulse: DVec3) -> Result<(), BodyError> {
        self.add_angular_impulse(t, self.attitude(t).conjugate() * impulse)
    }

    /// Sets the velocity [FLU, m/s].
    ///
    /// # Errors
    /// As [`set_velocity`](Self::set_velocity).
    pub fn set_velocity_flu(&mut self, t: SimTime, v: DVec3) -> Result<(), BodyError> {
        self.set_velocity(t, self.attitude(t) * v)
    }
}
