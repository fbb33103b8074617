//! A body in the world.

use super::Cx;
use crate::swarm::Own;
use simbeeotic_kernel::ModelId;
use simbeeotic_physics::{BodyError, BodyId, Motion};
use simbeeotic_units::{
    Accel, Acceleration, Attitude, Density, Enu, Flu, ForceVec, Heading, ImpulseVec, Length, Pose,
    Position, Rate, TorqueVec, Twist, Velocity,
};
use std::ops::{Deref, DerefMut};

/// A body as its own model sees it: where it is, how it moves, and what pushes it.
///
/// Readings are the truth at this instant, with what this call has changed already in them.
/// Sensors give what the vehicle would know. Forces hold until they are changed. A number that is
/// not finite ends the run with an error that names this model.
pub struct Entity<'a> {
    cx: Cx<'a>,
    body: BodyId,
}

impl<'a> Entity<'a> {
    pub(crate) fn new(cx: Cx<'a>) -> Self {
        let body = cx.core.body.unwrap_or(BodyId(u32::MAX));
        Self { cx, body }
    }

    fn motion(&self) -> &Motion {
        match &*self.cx.own {
            Some(own) => &own.motion,
            None => self.cx.swarm.physics.motion(self.body),
        }
    }

    /// Changes the own motion; others see it when the instant ends.
    fn change(&mut self, change: impl FnOnce(&mut Motion) -> Result<(), BodyError>) {
        let own = match &mut *self.cx.own {
            Some(own) => own,
            none => none.insert(Own {
                motion: *self.cx.swarm.physics.motion(self.body),
                jumped: false,
            }),
        };
        if let Err(error) = change(&mut own.motion) {
            self.cx.fault(error);
        }
    }

    /// Where the body is and how it points.
    pub fn pose(&self) -> Pose {
        Pose {
            position: self.position(),
            attitude: self.attitude(),
        }
    }

    /// Where the body's centre of mass is.
    pub fn position(&self) -> Position {
        Position::from_si(self.motion().position(self.cx.now))
    }

    /// How the body points: world_from_body.
    pub fn attitude(&self) -> Attitude {
        Attitude::from_unit_quat(self.motion().attitude(self.cx.now))
    }

    /// Where the body's forward axis points, clockwise from north.
    pub fn heading(&self) -> Heading {
        self.attitude().heading()
    }

    /// Velocity in the world frame.
    pub fn velocity(&self) -> Velocity<Enu> {
        Velocity::from_si(self.motion().velocity(self.cx.now))
    }

    /// Velocity in the body frame.
    pub fn velocity_flu(&self) -> Velocity<Flu> {
        self.attitude().unrotate(self.velocity())
    }

    /// Angular rate in the body frame.
    pub fn rate(&self) -> Rate<Flu> {
        Rate::from_si(self.motion().rate(self.cx.now))
    }

    /// Linear and angular velocity.
    pub fn twist(&self) -> Twist {
        Twist {
            linear: self.velocity(),
            angular: self.rate(),
        }
    }

    /// Acceleration in the world frame, gravity included.
    pub fn acceleration(&self) -> Accel<Enu> {
        Accel::from_si(self.motion().acceleration())
    }

    /// Sets the sum of all forces but gravity, world frame.
    pub fn set_force(&mut self, force: ForceVec<Enu>) {
        let now = self.cx.now;
        self.change(|motion| motion.set_force(now, force.si()));
    }

    /// Adds to the forces, world frame, at the centre of mass.
    pub fn add_force(&mut self, force: ForceVec<Enu>) {
        let now = self.cx.now;
        self.change(|motion| motion.add_force(now, force.si()));
    }

    /// Sets the torque, body frame.
    pub fn set_torque(&mut self, torque: TorqueVec<Flu>) {
        let now = self.cx.now;
        self.change(|motion| motion.set_torque(now, torque.si()));
    }

    /// Gives a push, world frame, at the centre of mass: the velocity changes at once, by the
    /// impulse over the mass.
    pub fn push(&mut self, impulse: ImpulseVec<Enu>) {
        let now = self.cx.now;
        self.change(|motion| motion.add_impulse(now, impulse.si()));
    }

    /// Sets the velocity, world frame.
    pub fn set_velocity(&mut self, velocity: Velocity<Enu>) {
        let now = self.cx.now;
        self.change(|motion| motion.set_velocity(now, velocity.si()));
    }

    /// Sets how the body points.
    pub fn set_attitude(&mut self, attitude: Attitude) {
        let now = self.cx.now;
        self.change(|motion| motion.set_attitude(now, attitude));
    }

    /// Sets the angular rate, body frame.
    pub fn set_rate(&mut self, rate: Rate<Flu>) {
        let now = self.cx.now;
        self.change(|motion| motion.set_rate(now, rate.si()));
    }

    /// Puts the body elsewhere.
    pub fn set_position(&mut self, position: Position) {
        let now = self.cx.now;
        self.change(|motion| motion.set_position(now, position.si()));
        if let Some(own) = &mut *self.cx.own {
            own.jumped = true;
        }
    }

    /// Acceleration of free fall; positive is downwards.
    pub fn gravity(&self) -> Acceleration {
        self.cx.swarm.gravity()
    }

    /// The wind where the body is, world frame.
    pub fn wind(&self) -> Velocity<Enu> {
        self.cx.swarm.weather.wind(self.position(), self.cx.now)
    }

    /// The density of the air where the body is.
    pub fn air_density(&self) -> Density {
        self.cx.swarm.weather.density(self.position(), self.cx.now)
    }

    /// All models with a body whose centre is within `radius`, as the instant began; this one is
    /// not among them. In the order of their ids.
    pub fn neighbors(&self, radius: Length) -> Vec<ModelId> {
        self.cx
            .swarm
            .neighbors(self.position(), radius, self.cx.now, self.cx.core.id)
    }
}

impl<'a> Deref for Entity<'a> {
    type Target = Cx<'a>;
    fn deref(&self) -> &Cx<'a> {
        &self.cx
    }
}

impl DerefMut for Entity<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.cx
    }
}
