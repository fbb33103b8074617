//! How a body is turned.

use super::{Enu, Flu, Heading, V3, Yaw};
use crate::math;
use crate::quantity::{Angle, VectorQuantity};
use glam::{DMat3, DQuat, DVec3};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::borrow::Cow;
use std::fmt;
use std::ops::Mul;

/// The attitude of a body: a rotation that takes its axes ([`Flu`]) to those of the world
/// ([`Enu`]), held as a unit quaternion `world_from_body` (Hamilton, w first in text).
///
/// The identity looks east, upright: forward is east, left is north. `a * b` first turns by `b`,
/// seen in the body, then by `a`: names cancel as in
/// `world_from_sensor = world_from_body * body_from_sensor`.
///
/// # Text
///
/// In serde it is a table, in any one of these forms, and written in the last:
///
/// | form | meaning |
/// |---|---|
/// | `{ heading = "90 deg" }` | upright, nose in that compass direction |
/// | `{ yaw = "0 deg", pitch = "5 deg", roll = "0 deg" }` | each optional, 0 if left out |
/// | `{ w = 1.0, x = 0.0, y = 0.0, z = 0.0 }` | a quaternion; its length must be 1 to within 1 % and is made 1 |
#[derive(Clone, Copy, PartialEq)]
pub struct Attitude {
    world_from_body: DQuat,
}

impl Attitude {
    /// Upright, nose to the east.
    pub const IDENTITY: Self = Self {
        world_from_body: DQuat::IDENTITY,
    };

    /// Upright, nose in the direction of `yaw`.
    pub fn from_yaw(yaw: Yaw) -> Self {
        Self::about(DVec3::Z, yaw.angle())
    }

    /// Upright, nose in the direction of `heading`.
    pub fn from_heading(heading: Heading) -> Self {
        Self::from_yaw(heading.into())
    }

    /// From the identity: turned by `yaw` about up, then by `pitch` about the new left, then by
    /// `roll` about the new forward (intrinsic z-y-x).
    ///
    /// By the right-hand rule positive pitch is nose **down**, positive roll is right wing down.
    pub fn from_rpy(roll: Angle, pitch: Angle, yaw: Yaw) -> Self {
        Self::from_yaw(yaw) * Self::about(DVec3::Y, pitch) * Self::about(DVec3::X, roll)
    }

    /// The rotation by an angle about an axis of length 1, by the right-hand rule.
    pub fn about(axis: DVec3, angle: Angle) -> Self {
        let (sin, cos) = math::sin_cos(0.5 * angle.get());
        let v = axis * sin;
        Self {
            world_from_body: DQuat::from_xyzw(v.x, v.y, v.z, cos),
        }
    }

    /// The exponential: the rotation about the vector's direction by the vector's length.
    ///
    /// `attitude * Attitude::exp(rate * dt)` is the attitude after turning for `dt` with a
    /// constant rate in the body frame.
    pub fn exp(rotation: V3<Angle, Flu>) -> Self {
        let half = 0.5 * rotation.si();
        let angle = half.length();
        let v = half * math::sinc(angle);
        Self {
            world_from_body: DQuat::from_xyzw(v.x, v.y, v.z, math::cos(angle)),
        }
    }

    /// The logarithm: the shortest rotation vector whose [`exp`](Self::exp) this is, of length at
    /// most π.
    pub fn log(self) -> V3<Angle, Flu> {
        let q = self.world_from_body;
        let q = if q.w < 0.0 { -q } else { q };
        let v = q.xyz();
        let sin = v.length();
        let angle = 2.0 * math::atan2(sin, q.w);
        // angle/sin is 2 for small angles, where the quotient would be 0/0.
        V3::from_si(if sin < 1e-150 {
            v * 2.0
        } else {
            v * (angle / sin)
        })
    }

    /// From a quaternion `world_from_body` of any length; `None` if it is zero or not finite.
    pub fn from_quat(world_from_body: DQuat) -> Option<Self> {
        let length = world_from_body.length();
        let usable = length.is_finite() && length > 1e-150;
        usable.then(|| Self {
            world_from_body: world_from_body * (1.0 / length),
        })
    }

    /// From a quaternion `world_from_body` that the caller knows to have length 1.
    #[inline]
    pub const fn from_unit_quat(world_from_body: DQuat) -> Self {
        Self { world_from_body }
    }

    /// From the components of a quaternion; see [`from_quat`](Self::from_quat).
    pub fn from_wxyz(w: f64, x: f64, y: f64, z: f64) -> Option<Self> {
        Self::from_quat(DQuat::from_xyzw(x, y, z, w))
    }

    /// The quaternion `world_from_body`.
    #[inline]
    pub const fn quat(self) -> DQuat {
        self.world_from_body
    }

    /// The rotation matrix `world_from_body`; its columns are forward, left and up in the world.
    pub fn matrix(self) -> DMat3 {
        DMat3::from_quat(self.world_from_body)
    }

    /// A vector written in the body's axes, written in the world's.
    #[inline]
    pub fn rotate<Q>(self, in_body: V3<Q, Flu>) -> V3<Q, Enu> {
        V3::from_si(self.world_from_body * in_body.si())
    }

    /// A vector written in the world's axes, written in the body's.
    #[inline]
    pub fn unrotate<Q>(self, in_world: V3<Q, Enu>) -> V3<Q, Flu> {
        V3::from_si(self.world_from_body.conjugate() * in_world.si())
    }

    /// The rotation back: `body_from_world`.
    #[inline]
    #[must_use]
    pub fn inverse(self) -> Self {
        Self {
            world_from_body: self.world_from_body.conjugate(),
        }
    }

    /// Where the nose points, in the world; length 1.
    pub fn forward(self) -> DVec3 {
        self.world_from_body * DVec3::X
    }

    /// Where the left side points, in the world; length 1.
    pub fn left(self) -> DVec3 {
        self.world_from_body * DVec3::Y
    }

    /// Where the top points, in the world; length 1.
    pub fn up(self) -> DVec3 {
        self.world_from_body * DVec3::Z
    }

    /// Where the nose points in the horizontal plane; east if it points straight up or down.
    pub fn yaw(self) -> Yaw {
        let forward = self.forward();
        Yaw::new(Angle::si(math::atan2(forward.y, forward.x)))
    }

    /// Where the nose points in the horizontal plane, as a compass says it.
    pub fn heading(self) -> Heading {
        self.yaw().into()
    }

    /// The nose's angle to the horizontal plane, -π/2 to π/2, positive **down**.
    pub fn pitch(self) -> Angle {
        Angle::asin((-self.forward().z).clamp(-1.0, 1.0))
    }

    /// The turn about the nose, (-π, π], positive with the left side up; 0 if upright.
    pub fn roll(self) -> Angle {
        Angle::si(math::wrap_signed(math::atan2(self.left().z, self.up().z)))
    }

    /// The angle of the rotation from this attitude to the other, 0 to π.
    pub fn angle_to(self, other: Self) -> Angle {
        self.rotation_to(other).length()
    }

    /// The shortest rotation that takes this attitude to the other, in this body's axes:
    /// `self * Attitude::exp(self.rotation_to(other))` is `other`.
    pub fn rotation_to(self, other: Self) -> V3<Angle, Flu> {
        (self.inverse() * other).log()
    }

    /// The same attitude with the quaternion's length brought back to 1, for integrators; the
    /// identity if the length is lost (zero, not finite).
    #[must_use]
    pub fn renormalized(self) -> Self {
        Self::from_quat(self.world_from_body).unwrap_or_default()
    }

    /// Whether no component is infinite or NaN.
    pub fn is_finite(self) -> bool {
        self.world_from_body.is_finite()
    }
}

/// The identity.
impl Default for Attitude {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// Composition; see [`Attitude`].
impl Mul for Attitude {
    type Output = Self;
    #[inline]
    fn mul(self, inner: Self) -> Self {
        Self {
            world_from_body: self.world_from_body * inner.world_from_body,
        }
    }
}

/// As [`Attitude::rotate`].
impl<Q: VectorQuantity> Mul<V3<Q, Flu>> for Attitude {
    type Output = V3<Q, Enu>;
    #[inline]
    fn mul(self, in_body: V3<Q, Flu>) -> V3<Q, Enu> {
        self.rotate(in_body)
    }
}

/// `(w, x, y, z)`.
impl fmt::Display for Attitude {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let DQuat { w, x, y, z } = self.world_from_body;
        match f.precision() {
            Some(n) => write!(f, "({w:.n$}, {x:.n$}, {y:.n$}, {z:.n$})"),
            None => write!(f, "({w}, {x}, {y}, {z})"),
        }
    }
}

/// As [`Display`](fmt::Display).
impl fmt::Debug for Attitude {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The text form of an attitude; see [`Attitude`].
#[derive(Deserialize)]
#[serde(
    deny_unknown_fields,
    expecting = "a table with heading, or with yaw, pitch and roll, or with w, x, y and z"
)]
struct Text {
    heading: Option<Heading>,
    yaw: Option<Yaw>,
    pitch: Option<Angle>,
    roll: Option<Angle>,
    w: Option<f64>,
    x: Option<f64>,
    y: Option<f64>,
    z: Option<f64>,
}

impl Text {
    fn read(self) -> Result<Attitude, String> {
        let turned = self.yaw.is_some() || self.pitch.is_some() || self.roll.is_some();
        let quaternion = [self.w, self.x, self.y, self.z];
        let components = quaternion.iter().flatten().count();
        match (self.heading, turned, components) {
            (Some(heading), false, 0) => Ok(Attitude::from_heading(heading)),
            (None, _, 0) => Ok(Attitude::from_rpy(
                self.roll.unwrap_or_default(),
                self.pitch.unwrap_or_default(),
                self.yaw.unwrap_or_default(),
            )),
            (None, false, 4) => {
                let [w, x, y, z] = quaternion.map(Option::unwrap_or_default);
                Self::quaternion(DQuat::from_xyzw(x, y, z, w))
            }
            (None, false, _) => Err("a quaternion needs all of w, x, y and z".to_owned()),
            _ => Err(
                "give an attitude in one form: heading, or yaw, pitch and roll, \
                      or w, x, y and z"
                    .to_owned(),
            ),
        }
    }

    fn quaternion(q: DQuat) -> Result<Attitude, String> {
        let length = q.length();
        if (length - 1.0).abs() <= 4.0 * f64::EPSILON {
            Ok(Attitude::from_unit_quat(q)) // as we wrote it: keep the bits
        } else if (length - 1.0).abs() <= 0.01 {
            Ok(Attitude::from_unit_quat(q * (1.0 / length)))
        } else {
            Err(format!(
                "the length of the quaternion is {length}; it must be 1"
            ))
        }
    }
}

impl<'de> Deserialize<'de> for Attitude {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        Text::deserialize(d)?.read().map_err(de::Error::custom)
    }
}

impl Serialize for Attitude {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Quaternion {
            w: f64,
            x: f64,
            y: f64,
            z: f64,
        }
        if !self.is_finite() {
            return Err(serde::ser::Error::custom(format_args!(
                "{self} is not finite"
            )));
        }
        let DQuat { w, x, y, z } = self.world_from_body;
        Quaternion { w, x, y, z }.serialize(s)
    }
}

impl schemars::JsonSchema for Attitude {
    fn schema_name() -> Cow<'static, str> {
        "Attitude".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let heading = generator.subschema_for::<Heading>();
        let yaw = generator.subschema_for::<Yaw>();
        let angle = generator.subschema_for::<Angle>();
        schemars::json_schema!({
            "description": "how a body is turned: heading; or yaw, pitch and roll; or a quaternion",
            "anyOf": [
                {
                    "type": "object",
                    "properties": { "heading": heading },
                    "required": ["heading"],
                    "additionalProperties": false,
                },
                {
                    "type": "object",
                    "properties": { "yaw": yaw, "pitch": angle.clone(), "roll": angle },
                    "additionalProperties": false,
                },
                {
                    "type": "object",
                    "properties": {
                        "w": { "type": "number" },
                        "x": { "type": "number" },
                        "y": { "type": "number" },
                        "z": { "type": "number" },
                    },
                    "required": ["w", "x", "y", "z"],
                    "additionalProperties": false,
                },
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::Speed;
    use crate::space::Rate;
    use crate::{Time, Velocity};
    use proptest::prelude::*;
    use std::f64::consts::PI;

    fn degrees(angle: f64) -> Angle {
        Angle::from_degrees(angle)
    }

    fn close(a: DVec3, b: DVec3) -> bool {
        a.abs_diff_eq(b, 1e-14)
    }

    #[test]
    fn the_identity_looks_east_upright() {
        let a = Attitude::default();
        assert_eq!(
            [a.forward(), a.left(), a.up()],
            [DVec3::X, DVec3::Y, DVec3::Z]
        );
        assert_eq!((a.yaw(), a.heading()), (Yaw::EAST, Heading::EAST));
    }

    #[test]
    fn a_body_with_heading_north_flies_north() {
        let a = Attitude::from_heading(Heading::NORTH);
        assert!(close(a.forward(), DVec3::Y));
        assert!(close(a.left(), DVec3::NEG_X));
        let forward = Velocity::<Flu>::new(Speed::si(2.0), Speed::ZERO, Speed::ZERO);
        let flown = a * forward;
        assert!((flown.north() - Speed::si(2.0)).abs() < Speed::si(1e-14));
        assert!((a.heading() - Heading::NORTH).abs() < degrees(1e-12));
    }

    #[test]
    fn positive_pitch_is_nose_down_and_positive_roll_lifts_the_left_side() {
        let down = Attitude::from_rpy(Angle::ZERO, degrees(30.0), Yaw::EAST);
        assert!((down.forward().z + 0.5).abs() < 1e-15);
        assert!((down.pitch() - degrees(30.0)).abs() < degrees(1e-12));
        let rolled = Attitude::from_rpy(degrees(30.0), Angle::ZERO, Yaw::EAST);
        assert!((rolled.left().z - 0.5).abs() < 1e-15);
        assert!((rolled.roll() - degrees(30.0)).abs() < degrees(1e-12));
    }

    #[test]
    fn straight_up_has_no_yaw_but_is_no_error() {
        let up = Attitude::from_rpy(Angle::ZERO, degrees(-90.0), Yaw::NORTH);
        assert!((up.pitch() + degrees(90.0)).abs() < degrees(1e-5));
        assert!(up.yaw().angle().is_finite());
    }

    #[test]
    fn composing_turns_first_by_the_inner() {
        // A camera that looks to the left of a body that flies north looks west.
        let world_from_body = Attitude::from_heading(Heading::NORTH);
        let body_from_camera = Attitude::from_yaw(Yaw::NORTH);
        let world_from_camera = world_from_body * body_from_camera;
        assert!(close(world_from_camera.forward(), DVec3::NEG_X));
    }

    #[test]
    fn turning_at_a_constant_rate_is_the_exponential() {
        let rate = Rate::<Flu>::from_xyz(0.0, 0.0, PI / 2.0);
        let a = Attitude::IDENTITY * Attitude::exp(rate * Time::si(1.0));
        assert!(close(a.forward(), DVec3::Y)); // counter-clockwise: from east to north
        assert_eq!(Attitude::exp(V3::ZERO), Attitude::IDENTITY);
        assert!((a.angle_to(Attitude::IDENTITY) - degrees(90.0)).abs() < degrees(1e-12));
    }

    #[test]
    fn a_quaternion_without_length_is_no_attitude() {
        assert!(Attitude::from_wxyz(0.0, 0.0, 0.0, 0.0).is_none());
        assert!(Attitude::from_wxyz(f64::NAN, 0.0, 0.0, 0.0).is_none());
        assert!(Attitude::from_wxyz(f64::INFINITY, 0.0, 0.0, 0.0).is_none());
        assert_eq!(
            Attitude::from_wxyz(2.0, 0.0, 0.0, 0.0),
            Some(Attitude::IDENTITY)
        );
        let lost = Attitude::from_unit_quat(DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0));
        assert_eq!(lost.renormalized(), Attitude::IDENTITY);
    }

    fn any_vector(size: f64) -> impl Strategy<Value = DVec3> {
        [-size..size, -size..size, -size..size].prop_map(DVec3::from_array)
    }

    proptest! {
        #[test]
        fn rotating_there_and_back_changes_nothing(r in any_vector(3.0), v in any_vector(100.0)) {
            let a = Attitude::exp(V3::from_si(r));
            let in_body = V3::<Speed, Flu>::from_si(v);
            let back = a.unrotate(a.rotate(in_body));
            prop_assert!(back.distance(in_body) < Speed::si(1e-12));
            prop_assert!((a.rotate(in_body).length() - in_body.length()).abs() < Speed::si(1e-12));
            prop_assert!((a.inverse() * a).angle_to(Attitude::IDENTITY) < Angle::si(1e-14));
        }

        #[test]
        fn the_logarithm_undoes_the_exponential(r in any_vector(1.8)) {
            let back = Attitude::exp(V3::from_si(r)).log();
            prop_assert!(back.si().abs_diff_eq(r, 1e-12), "{r} became {back}");
        }

        #[test]
        fn tiny_rotations_keep_their_digits(r in any_vector(1.0), exponent in -290..-3_i32) {
            let r = r * libm::pow(10.0, f64::from(exponent));
            let back = Attitude::exp(V3::from_si(r)).log().si();
            prop_assert!((back - r).length() <= 1e-15 * r.length() + 1e-300, "{r} became {back}");
        }

        #[test]
        fn the_rotation_to_another_attitude_leads_there(r in any_vector(3.0), s in any_vector(3.0)) {
            let (a, b) = (Attitude::exp(V3::from_si(r)), Attitude::exp(V3::from_si(s)));
            let reached = a * Attitude::exp(a.rotation_to(b));
            prop_assert!(reached.angle_to(b) < Angle::si(1e-7));
            prop_assert!(close(reached.forward(), b.forward()));
            prop_assert!(a.angle_to(b) <= Angle::si(PI));
        }

        #[test]
        fn roll_pitch_and_yaw_are_read_back(
            roll in -179.0..179.0_f64, pitch in -89.0..89.0_f64, yaw in -179.0..179.0_f64,
        ) {
            let yaw = Yaw::new(degrees(yaw));
            let a = Attitude::from_rpy(degrees(roll), degrees(pitch), yaw);
            prop_assert!((a.roll() - degrees(roll)).abs() < Angle::si(1e-12));
            prop_assert!((a.pitch() - degrees(pitch)).abs() < Angle::si(1e-12));
            prop_assert!((a.yaw() - yaw).abs() < Angle::si(1e-12));
        }

        #[test]
        fn the_matrix_is_the_same_rotation(r in any_vector(3.0), v in any_vector(10.0)) {
            let a = Attitude::exp(V3::from_si(r));
            let rotated = a.rotate(V3::<Speed, Flu>::from_si(v)).si();
            prop_assert!((a.matrix() * v).abs_diff_eq(rotated, 1e-13));
        }
    }
}
