//! Position and attitude together, how they change, and what changes them.

use super::{Attitude, Enu, Flu, ForceVec, Offset, Position, Rate, TorqueVec, Velocity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// Where a body is and how it is turned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Pose {
    /// The centre of mass in the world.
    pub position: Position,
    /// The rotation from the body's axes to the world's.
    pub attitude: Attitude,
}

/// Where a part is on a body and how it is turned there: the pose of a sensor or an antenna in the
/// body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Mount {
    /// The part's origin, from the body's centre of mass.
    pub position: Offset,
    /// The rotation from the part's axes to the body's; the part's forward is the direction in
    /// which it looks.
    pub attitude: Attitude,
}

/// How fast a body moves and turns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Twist {
    /// The velocity of the centre of mass, in the world's axes.
    pub linear: Velocity<Enu>,
    /// The angular velocity, in the body's axes: what its gyroscope measures.
    pub angular: Rate<Flu>,
}

/// A force and a torque on a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Wrench {
    /// The force at the centre of mass, in the world's axes.
    pub force: ForceVec<Enu>,
    /// The torque about the centre of mass, in the body's axes.
    pub torque: TorqueVec<Flu>,
}

impl Pose {
    /// At the origin, upright, nose to the east.
    pub const IDENTITY: Self = Self::new(Position::ZERO, Attitude::IDENTITY);

    /// From its two halves.
    pub const fn new(position: Position, attitude: Attitude) -> Self {
        Self { position, attitude }
    }

    /// The place in the world of a place on the body.
    pub fn to_world(self, place: Offset) -> Position {
        self.position + self.attitude.rotate(place)
    }

    /// The place on the body of a place in the world.
    pub fn to_body(self, place: Position) -> Offset {
        self.attitude.unrotate(place - self.position)
    }

    /// Whether no number in it is infinite or NaN.
    pub fn is_finite(self) -> bool {
        self.position.is_finite() && self.attitude.is_finite()
    }
}

impl Mount {
    /// At the centre of mass, looking forward.
    pub const IDENTITY: Self = Self::new(Offset::ZERO, Attitude::IDENTITY);

    /// From its two halves.
    pub const fn new(position: Offset, attitude: Attitude) -> Self {
        Self { position, attitude }
    }
}

/// The pose in the world of what is mounted on a body:
/// `world_from_part = world_from_body * body_from_part`.
impl Mul<Mount> for Pose {
    type Output = Self;
    fn mul(self, mount: Mount) -> Self {
        Self::new(
            self.to_world(mount.position),
            self.attitude * mount.attitude,
        )
    }
}

impl Twist {
    /// At rest.
    pub const ZERO: Self = Self::new(Velocity::ZERO, Rate::ZERO);

    /// From its two halves.
    pub const fn new(linear: Velocity<Enu>, angular: Rate<Flu>) -> Self {
        Self { linear, angular }
    }

    /// The velocity of a place on the body, in the world's axes, for a body with this attitude.
    pub fn velocity_at(self, place: Offset, attitude: Attitude) -> Velocity<Enu> {
        let swing = Velocity::<Flu>::from_si(self.angular.si().cross(place.si()));
        self.linear + attitude.rotate(swing)
    }

    /// Whether no number in it is infinite or NaN.
    pub fn is_finite(self) -> bool {
        self.linear.is_finite() && self.angular.is_finite()
    }
}

impl Wrench {
    /// Neither force nor torque.
    pub const ZERO: Self = Self::new(ForceVec::ZERO, TorqueVec::ZERO);

    /// From its two halves.
    pub const fn new(force: ForceVec<Enu>, torque: TorqueVec<Flu>) -> Self {
        Self { force, torque }
    }

    /// The wrench of a force in the body's axes that acts at a place on a body with this attitude.
    pub fn from_force_at(force: ForceVec<Flu>, place: Offset, attitude: Attitude) -> Self {
        let torque = TorqueVec::from_si(place.si().cross(force.si()));
        Self::new(attitude.rotate(force), torque)
    }

    /// Whether no number in it is infinite or NaN.
    pub fn is_finite(self) -> bool {
        self.force.is_finite() && self.torque.is_finite()
    }
}

impl Add for Wrench {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.force + other.force, self.torque + other.torque)
    }
}

impl Sub for Wrench {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.force - other.force, self.torque - other.torque)
    }
}

impl Neg for Wrench {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.force, -self.torque)
    }
}

impl AddAssign for Wrench {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f64> for Wrench {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.force * factor, self.torque * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Heading, Length, Yaw};

    /// 10 m east of the origin, nose to the north.
    fn north_bound() -> Pose {
        let attitude = Attitude::from_heading(Heading::NORTH);
        Pose::new(Position::from_xyz(10.0, 0.0, 0.0), attitude)
    }

    #[test]
    fn a_place_on_the_body_is_found_in_the_world_and_back() {
        let nose = Offset::from_xyz(0.5, 0.0, 0.0);
        let in_world = north_bound().to_world(nose);
        let expected = Position::from_xyz(10.0, 0.5, 0.0);
        assert!(in_world.distance(expected) < Length::si(1e-14));
        assert!(north_bound().to_body(in_world).distance(nose) < Length::si(1e-14));
    }

    #[test]
    fn a_mounted_part_has_a_pose_in_the_world() {
        let left_eye = Mount::new(
            Offset::from_xyz(0.1, 0.1, 0.0),
            Attitude::from_yaw(Yaw::NORTH),
        );
        let eye = north_bound() * left_eye;
        assert!(eye.position.distance(Position::from_xyz(9.9, 0.1, 0.0)) < Length::si(1e-14));
        assert!((eye.attitude.heading() - Heading::WEST).abs().get() < 1e-14);
        assert_eq!(north_bound() * Mount::IDENTITY, north_bound());
    }

    #[test]
    fn a_turning_body_moves_faster_outside() {
        let twist = Twist::new(
            Velocity::from_xyz(1.0, 0.0, 0.0),
            Rate::from_xyz(0.0, 0.0, 2.0),
        );
        let right_wing = Offset::from_xyz(0.0, -0.5, 0.0);
        let v = twist.velocity_at(right_wing, Attitude::IDENTITY);
        assert_eq!(v, Velocity::from_xyz(2.0, 0.0, 0.0));
    }

    #[test]
    fn a_force_off_centre_turns() {
        // Pushing the nose to the left turns counter-clockwise.
        let push = ForceVec::from_xyz(0.0, 3.0, 0.0);
        let nose = Offset::from_xyz(0.5, 0.0, 0.0);
        let wrench = Wrench::from_force_at(push, nose, Attitude::IDENTITY);
        assert_eq!(wrench.force, ForceVec::from_xyz(0.0, 3.0, 0.0));
        assert_eq!(wrench.torque, TorqueVec::from_xyz(0.0, 0.0, 1.5));
        assert_eq!(wrench + -wrench, Wrench::ZERO);
        assert_eq!(wrench + wrench, wrench * 2.0);
    }
}
