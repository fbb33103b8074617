//! A body in the world.

use super::Cx;
use crate::swarm::Own;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_physics::{BodyError, BodyId, Motion};
use simbeeotic_units::{
    Accel, Acceleration, Attitude, Density, Enu, Flu, ForceVec, Heading, ImpulseVec, Length,
    Offset, Pose, Position, Rate, Time, TorqueVec, Twist, Velocity, Wrench,
};
use std::ops::{Deref, DerefMut};

/// A body as its own model sees it: where it is, how it moves, and what pushes it.
///
/// Readings are the truth at this instant, with what this call has changed already in them.
/// Sensors give what the vehicle would know.
///
/// What pushes a body takes typed vectors: world frame unless the name ends in `_flu`, at the centre
/// of mass unless it ends in `_at`. Forces and torques hold until they are set again. What physics
/// refuses (a number that is not finite, a push that would make a million g, a force on a body that is
/// fixed or driven) ends the run with an error that names this model and the time, and changes nothing.
///
/// A body with [`Mobility::Driven`](simbeeotic_physics::Mobility) is a ghost: it goes where
/// [`set_pose`](Self::set_pose) and [`set_twist`](Self::set_twist) say, others bounce off it, and
/// nothing pushes it.
pub struct Entity<'a> {
    cx: Cx<'a>,
    body: BodyId,
}

impl<'a> Entity<'a> {
    #[inline]
    pub(crate) fn new(cx: Cx<'a>) -> Self {
        let body = cx.core.body.unwrap_or(BodyId(u32::MAX));
        Self { cx, body }
    }

    #[inline]
    pub(crate) fn motion(&self) -> &Motion {
        match &*self.cx.own {
            Some(own) => &own.motion,
            None => self.cx.swarm.physics.motion(self.body),
        }
    }

    /// Changes the own motion; others see it when the instant ends.
    #[inline]
    fn change(&mut self, change: impl FnOnce(&mut Motion, SimTime) -> Result<(), BodyError>) {
        let now = self.cx.now;
        let own = match &mut *self.cx.own {
            Some(own) => own,
            none => none.insert(Own {
                motion: *self.cx.swarm.physics.motion(self.body),
                jumped: false,
            }),
        };
        if let Err(error) = change(&mut own.motion, now) {
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
    #[inline]
    pub fn position(&self) -> Position {
        Position::from_si(self.motion().position(self.cx.now))
    }

    /// How the body points: world_from_body.
    #[inline]
    pub fn attitude(&self) -> Attitude {
        Attitude::from_unit_quat(self.motion().attitude(self.cx.now))
    }

    /// Where the body's forward axis points, clockwise from north.
    pub fn heading(&self) -> Heading {
        self.attitude().heading()
    }

    /// Velocity in the world frame.
    #[inline]
    pub fn velocity(&self) -> Velocity<Enu> {
        Velocity::from_si(self.motion().velocity(self.cx.now))
    }

    /// Velocity in the body frame.
    pub fn velocity_flu(&self) -> Velocity<Flu> {
        self.attitude().unrotate(self.velocity())
    }

    /// Angular rate in the body frame.
    #[inline]
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

    /// The sum of all forces but gravity and contacts, world frame. Zero for a body that nothing
    /// pushes.
    pub fn force(&self) -> ForceVec<Enu> {
        ForceVec::from_si(self.motion().force())
    }

    /// The torque, body frame.
    pub fn torque(&self) -> TorqueVec<Flu> {
        TorqueVec::from_si(self.motion().torque())
    }

    /// Sets the sum of all forces but gravity, world frame. They act at the centre of mass, and keep
    /// their direction in the world until they are set again.
    #[inline]
    pub fn set_force(&mut self, force: ForceVec<Enu>) {
        self.change(|motion, now| motion.set_force(now, force.si()));
    }

    /// The same, given in the body frame. Turning afterwards does not turn the force.
    pub fn set_force_flu(&mut self, force: ForceVec<Flu>) {
        self.change(|motion, now| motion.set_force_flu(now, force.si()));
    }

    /// Adds to the forces, world frame, at the centre of mass.
    pub fn add_force(&mut self, force: ForceVec<Enu>) {
        self.change(|motion, now| motion.add_force(now, force.si()));
    }

    /// Adds to the forces, body frame, at the centre of mass.
    pub fn add_force_flu(&mut self, force: ForceVec<Flu>) {
        self.change(|motion, now| motion.add_force_flu(now, force.si()));
    }

    /// Adds a force, world frame, that pulls at a point of the world: it turns the body too, by a
    /// torque that stays as it is now in the body.
    pub fn add_force_at(&mut self, force: ForceVec<Enu>, point: Position) {
        let arm = point - self.position();
        self.change(|motion, now| motion.add_force_at(now, force.si(), arm.si()));
    }

    /// Adds a force, body frame, that pulls at a point of the body.
    pub fn add_force_at_flu(&mut self, force: ForceVec<Flu>, point: Offset) {
        self.change(|motion, now| motion.add_force_at_flu(now, force.si(), point.si()));
    }

    /// Sets the torque, body frame. It turns with the body, and holds until it is set again.
    pub fn set_torque(&mut self, torque: TorqueVec<Flu>) {
        self.change(|motion, now| motion.set_torque(now, torque.si()));
    }

    /// Adds to the torque, body frame.
    pub fn add_torque(&mut self, torque: TorqueVec<Flu>) {
        self.change(|motion, now| motion.add_torque(now, torque.si()));
    }

    /// Adds to the torque, world frame: from now on it turns with the body.
    pub fn add_torque_enu(&mut self, torque: TorqueVec<Enu>) {
        self.change(|motion, now| motion.add_torque_enu(now, torque.si()));
    }

    /// Sets force and torque at once. A zero wrench lets the body go.
    pub fn set_wrench(&mut self, wrench: Wrench) {
        let (force, torque) = (wrench.force.si(), wrench.torque.si());
        self.change(|motion, now| motion.set_wrench(now, force, torque));
    }

    /// Gives a push, world frame, at the centre of mass: the velocity changes at once, by the
    /// impulse over the mass.
    pub fn push(&mut self, impulse: ImpulseVec<Enu>) {
        self.change(|motion, now| motion.add_impulse(now, impulse.si()));
    }

    /// Gives a push, body frame, at the centre of mass.
    pub fn push_flu(&mut self, impulse: ImpulseVec<Flu>) {
        self.change(|motion, now| motion.add_impulse_flu(now, impulse.si()));
    }

    /// Gives a push, world frame, at a point of the world: it turns the body too.
    pub fn push_at(&mut self, impulse: ImpulseVec<Enu>, point: Position) {
        let arm = point - self.position();
        self.change(|motion, now| motion.add_impulse_at(now, impulse.si(), arm.si()));
    }

    /// Gives a push, body frame, at a point of the body.
    pub fn push_at_flu(&mut self, impulse: ImpulseVec<Flu>, point: Offset) {
        self.change(|motion, now| motion.add_impulse_at_flu(now, impulse.si(), point.si()));
    }

    /// Gives an angular push, body frame: the rate changes at once by what `torque` does to a body
    /// at rest in the time `during`.
    pub fn spin(&mut self, torque: TorqueVec<Flu>, during: Time) {
        let impulse = torque.si() * during.get();
        self.change(|motion, now| motion.add_angular_impulse(now, impulse));
    }

    /// Sets the velocity, world frame.
    pub fn set_velocity(&mut self, velocity: Velocity<Enu>) {
        self.change(|motion, now| motion.set_velocity(now, velocity.si()));
    }

    /// Sets the velocity, body frame.
    pub fn set_velocity_flu(&mut self, velocity: Velocity<Flu>) {
        self.change(|motion, now| motion.set_velocity_flu(now, velocity.si()));
    }

    /// Sets the angular rate, body frame.
    #[inline]
    pub fn set_rate(&mut self, rate: Rate<Flu>) {
        self.change(|motion, now| motion.set_rate(now, rate.si()));
    }

    /// Sets velocity and angular rate at once.
    pub fn set_twist(&mut self, twist: Twist) {
        let (linear, angular) = (twist.linear.si(), twist.angular.si());
        self.change(|motion, now| motion.set_twist(now, linear, angular));
    }

    /// Sets how the body points.
    #[inline]
    pub fn set_attitude(&mut self, attitude: Attitude) {
        self.change(|motion, now| motion.set_attitude(now, attitude));
    }

    /// Puts the body elsewhere, without a way between.
    pub fn set_position(&mut self, position: Position) {
        self.change(|motion, now| motion.set_position(now, position.si()));
        self.jumped();
    }

    /// Puts the body elsewhere, and turns it.
    pub fn set_pose(&mut self, pose: Pose) {
        let Pose { position, attitude } = pose;
        self.change(|motion, now| motion.set_pose(now, position.si(), attitude));
        self.jumped();
    }

    fn jumped(&mut self) {
        if let Some(own) = &mut *self.cx.own {
            own.jumped = true;
        }
    }

    /// Acceleration of free fall; positive is downwards.
    #[inline]
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

super::says!(Entity, cx);

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
