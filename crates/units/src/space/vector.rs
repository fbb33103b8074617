//! Vectors of a quantity in a frame.

use super::{Enu, Flu, Frame};
use crate::quantity::print::Number;
use crate::quantity::{
    Acceleration, AngularRate, Force, Impulse, Length, Quantity, Speed, Torque, VectorQuantity,
    serial,
};
use glam::DVec3;
use serde::de::{self, SeqAccess};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A place in the world, from the world's origin.
pub type Position = V3<Length, Enu>;
/// A place on a body, from its centre of mass.
pub type Offset = V3<Length, Flu>;
/// A velocity relative to the ground, written in the axes of `F`.
pub type Velocity<F> = V3<Speed, F>;
/// An acceleration relative to the ground, written in the axes of `F`.
pub type Accel<F> = V3<Acceleration, F>;
/// An angular velocity relative to the world, written in the axes of `F`.
pub type Rate<F> = V3<AngularRate, F>;
/// A force, written in the axes of `F`.
pub type ForceVec<F> = V3<Force, F>;
/// An impulse, written in the axes of `F`.
pub type ImpulseVec<F> = V3<Impulse, F>;
/// A torque about the centre of mass, written in the axes of `F`.
pub type TorqueVec<F> = V3<Torque, F>;

/// Three components of the quantity `Q` along the axes of the frame `F`.
///
/// Inside are three `f64` in SI; [`V3::from_si`] and [`V3::si`] are free. Vectors of one quantity
/// and frame add up; a vector times a quantity is a vector of the product, as `velocity * time` is
/// a vector of lengths. Between frames goes [`Attitude`](super::Attitude).
///
/// In serde it is an array of three quantities: `["1 m", "-2 m", "30 cm"]`.
///
/// ```
/// use simbeeotic_units::{Enu, Position, Speed, Time, Velocity};
///
/// let wind = Velocity::<Enu>::from_xyz(3.0, 4.0, 0.0);
/// assert_eq!(wind.length(), Speed::si(5.0));
/// assert_eq!((wind * Time::from_secs(2.0)), Position::from_xyz(6.0, 8.0, 0.0));
/// assert_eq!(wind.to_string(), "(3, 4, 0) m/s ENU");
/// ```
///
/// ```compile_fail
/// use simbeeotic_units::{Enu, Flu, Velocity};
/// let sum = Velocity::<Enu>::ZERO + Velocity::<Flu>::ZERO; // two frames
/// ```
pub struct V3<Q, F> {
    si: DVec3,
    marker: PhantomData<fn() -> (Q, F)>,
}

impl<Q, F> V3<Q, F> {
    /// Three times nothing.
    pub const ZERO: Self = Self::from_si(DVec3::ZERO);

    /// From SI numbers.
    #[inline]
    pub const fn from_si(si: DVec3) -> Self {
        Self {
            si,
            marker: PhantomData,
        }
    }

    /// As SI numbers.
    #[inline]
    pub const fn si(self) -> DVec3 {
        self.si
    }

    /// From three SI numbers along the axes of the frame.
    #[inline]
    pub const fn from_xyz(x: f64, y: f64, z: f64) -> Self {
        Self::from_si(DVec3::new(x, y, z))
    }

    /// Whether no component is infinite or NaN.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.si.is_finite()
    }

    /// The direction, a bare unit vector; `None` for a vector without one (zero, not finite).
    pub fn direction(self) -> Option<DVec3> {
        self.si.try_normalize()
    }

    /// The scalar product, in the product of the two SI units.
    #[inline]
    pub fn dot<R>(self, other: V3<R, F>) -> f64 {
        self.si.dot(other.si)
    }
}

impl<Q: VectorQuantity, F> V3<Q, F> {
    /// From the components along the first, second and third axis of the frame.
    #[inline]
    pub fn new(first: Q, second: Q, third: Q) -> Self {
        Self::from_xyz(first.to_si(), second.to_si(), third.to_si())
    }

    /// The vector of a given length in a direction; `direction` should have length 1.
    #[inline]
    pub fn along(direction: DVec3, length: Q) -> Self {
        Self::from_si(direction * length.to_si())
    }

    /// The components along the axes of the frame, in order.
    #[inline]
    pub fn components(self) -> [Q; 3] {
        self.si.to_array().map(Q::from_si)
    }

    /// The Euclidean length.
    #[inline]
    pub fn length(self) -> Q {
        Q::from_si(self.si.length())
    }

    /// How far the tip of this vector is from the tip of the other.
    #[inline]
    pub fn distance(self, other: Self) -> Q {
        Q::from_si(self.si.distance(other.si))
    }

    /// This vector, shortened to `most` if it is longer, in the same direction.
    ///
    /// Zero if `most` is negative; unchanged if a component is infinite or NaN.
    #[inline]
    #[must_use]
    pub fn limit(self, most: Q) -> Self {
        let (length, most) = (self.si.length(), most.to_si().max(0.0));
        if length <= most || !self.si.is_finite() {
            self
        } else if length.is_finite() {
            Self::from_si(self.si * (most / length))
        } else {
            // The squares overflow, and the vector does not: scaled to 1, its length is a number.
            let scaled = self.si / self.si.abs().max_element();
            let length = scaled.length();
            if length * self.si.abs().max_element() <= most {
                self
            } else {
                Self::from_si(scaled * (most / length))
            }
        }
    }
}

impl<Q: VectorQuantity> V3<Q, Enu> {
    /// The component to the east.
    #[inline]
    pub fn east(self) -> Q {
        Q::from_si(self.si.x)
    }

    /// The component to the north.
    #[inline]
    pub fn north(self) -> Q {
        Q::from_si(self.si.y)
    }

    /// The component upwards; of a position the height above the ground plane.
    #[inline]
    pub fn up(self) -> Q {
        Q::from_si(self.si.z)
    }

    /// The horizontal part: this vector with nothing upwards.
    #[inline]
    #[must_use]
    pub fn horizontal(self) -> Self {
        Self::from_xyz(self.si.x, self.si.y, 0.0)
    }
}

impl<Q: VectorQuantity> V3<Q, Flu> {
    /// The component forward.
    #[inline]
    pub fn forward(self) -> Q {
        Q::from_si(self.si.x)
    }

    /// The component to the left.
    #[inline]
    pub fn left(self) -> Q {
        Q::from_si(self.si.y)
    }

    /// The component out of the body's top.
    #[inline]
    pub fn up(self) -> Q {
        Q::from_si(self.si.z)
    }
}

// The derives would ask the same of `Q` and of `F`.

impl<Q, F> Clone for V3<Q, F> {
    #[inline]
    fn clone(&self) -> Self {
        *self
    }
}

impl<Q, F> Copy for V3<Q, F> {}

impl<Q, F> Default for V3<Q, F> {
    fn default() -> Self {
        Self::ZERO
    }
}

impl<Q, F> PartialEq for V3<Q, F> {
    fn eq(&self, other: &Self) -> bool {
        self.si == other.si
    }
}

/// `(1, 2.5, 0) m ENU`; a precision applies to each number.
impl<Q: Quantity, F: Frame> fmt::Display for V3<Q, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (component, before) in self.si.to_array().into_iter().zip(["(", ", ", ", "]) {
            f.write_str(before)?;
            fmt::Display::fmt(&Number(component), f)?;
        }
        write!(f, ") {} {}", Q::UNITS[0].name, F::NAME)
    }
}

/// As [`Display`](fmt::Display).
impl<Q: Quantity, F: Frame> fmt::Debug for V3<Q, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl<Q, F> Add for V3<Q, F> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::from_si(self.si + other.si)
    }
}

impl<Q, F> Sub for V3<Q, F> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::from_si(self.si - other.si)
    }
}

impl<Q, F> Neg for V3<Q, F> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self::from_si(-self.si)
    }
}

impl<Q, F> AddAssign for V3<Q, F> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.si += other.si;
    }
}

impl<Q, F> SubAssign for V3<Q, F> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        self.si -= other.si;
    }
}

impl<Q, F> Mul<f64> for V3<Q, F> {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self::from_si(self.si * factor)
    }
}

impl<Q, F> Mul<V3<Q, F>> for f64 {
    type Output = V3<Q, F>;
    #[inline]
    fn mul(self, vector: V3<Q, F>) -> V3<Q, F> {
        vector * self
    }
}

impl<Q, F> Div<f64> for V3<Q, F> {
    type Output = Self;
    #[inline]
    fn div(self, divisor: f64) -> Self {
        Self::from_si(self.si / divisor)
    }
}

impl<Q, F> MulAssign<f64> for V3<Q, F> {
    #[inline]
    fn mul_assign(&mut self, factor: f64) {
        self.si *= factor;
    }
}

impl<Q, F> DivAssign<f64> for V3<Q, F> {
    #[inline]
    fn div_assign(&mut self, divisor: f64) {
        self.si /= divisor;
    }
}

/// The vector of the products: `velocity * time` is a vector of lengths.
impl<Q, S, F> Mul<S> for V3<Q, F>
where
    Q: Mul<S>,
    Q::Output: VectorQuantity,
    S: Quantity,
{
    type Output = V3<Q::Output, F>;
    #[inline]
    fn mul(self, factor: S) -> Self::Output {
        V3::from_si(self.si * factor.to_si())
    }
}

/// The vector of the quotients: `force / mass` is a vector of accelerations.
impl<Q, S, F> Div<S> for V3<Q, F>
where
    Q: Div<S>,
    Q::Output: VectorQuantity,
    S: Quantity,
{
    type Output = V3<Q::Output, F>;
    #[inline]
    fn div(self, divisor: S) -> Self::Output {
        V3::from_si(self.si / divisor.to_si())
    }
}

impl<Q, F> std::iter::Sum for V3<Q, F> {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::ZERO, |sum, one| sum + one)
    }
}

impl<Q: VectorQuantity, F> From<[Q; 3]> for V3<Q, F> {
    fn from([first, second, third]: [Q; 3]) -> Self {
        Self::new(first, second, third)
    }
}

impl<Q: VectorQuantity + Serialize, F> Serialize for V3<Q, F> {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        let mut tuple = s.serialize_tuple(3)?;
        for component in self.components() {
            tuple.serialize_element(&component)?;
        }
        tuple.end()
    }
}

impl<'de, Q: VectorQuantity + Deserialize<'de>, F: Frame> Deserialize<'de> for V3<Q, F> {
    fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
        d.deserialize_tuple(3, VectorVisitor(PhantomData))
    }
}

struct VectorVisitor<Q, F>(PhantomData<fn() -> (Q, F)>);

impl<'de, Q: VectorQuantity + Deserialize<'de>, F: Frame> de::Visitor<'de> for VectorVisitor<Q, F> {
    type Value = V3<Q, F>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = Q::UNITS[0].name;
        write!(
            f,
            "three quantities [{}], for example [\"1 {unit}\", \"0 {unit}\", \"0.5 {unit}\"]",
            F::AXES.join(", ")
        )
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<V3<Q, F>, A::Error> {
        let mut components = [Q::from_si(0.0); 3];
        for (index, component) in components.iter_mut().enumerate() {
            *component = seq
                .next_element()?
                .ok_or_else(|| de::Error::invalid_length(index, &self))?;
        }
        // What is left over, whatever it is, makes the vector too long.
        let mut length = 3;
        while seq.next_element::<de::IgnoredAny>()?.is_some() {
            length += 1;
        }
        if length > 3 {
            return Err(de::Error::invalid_length(length, &self));
        }
        Ok(components.into())
    }
}

impl<Q: VectorQuantity, F: Frame> schemars::JsonSchema for V3<Q, F> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        format!("{} vector in {}", Q::UNITS[0].name, F::NAME).into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "type": "array",
            "description": format!("[{}], each {} with a unit", F::AXES.join(", "), Q::NOUN),
            "items": serial::schema::<Q>(),
            "minItems": 3,
            "maxItems": 3,
            "x-frame": F::NAME,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{Angle, Mass, Time};

    #[test]
    fn components_are_named_by_the_frame() {
        let [one, two, three] = [1.0, 2.0, 3.0].map(Length::si);
        let p = Position::new(one, two, three);
        assert_eq!([p.east(), p.north(), p.up()], [one, two, three]);
        let o = Offset::new(one, two, three);
        assert_eq!([o.forward(), o.left(), o.up()], [one, two, three]);
        assert_eq!(Position::from([one, two, three]), p);
        assert_eq!(p.horizontal(), Position::from_xyz(1.0, 2.0, 0.0));
    }

    #[test]
    fn arithmetic_is_that_of_vectors() {
        let a = Position::from_xyz(1.0, 2.0, 3.0);
        let b = Position::from_xyz(4.0, 6.0, 3.0);
        assert_eq!(a + b, Position::from_xyz(5.0, 8.0, 6.0));
        assert_eq!(b - a, Position::from_xyz(3.0, 4.0, 0.0));
        assert_eq!(-a, a * -1.0);
        assert_eq!(2.0 * a, a + a);
        assert_eq!((a + a) / 2.0, a);
        assert_eq!(a.distance(b), Length::si(5.0));
        assert_eq!(a.dot(b), 25.0);
        assert_eq!([a, b].into_iter().sum::<Position>(), a + b);
        let mut c = a;
        c += b;
        c -= a;
        c *= 2.0;
        c /= 2.0;
        assert_eq!(c, b);
        assert_eq!(Position::default(), Position::ZERO);
    }

    #[test]
    fn a_vector_times_a_quantity_is_a_vector_of_the_product() {
        let v = Velocity::<Enu>::from_xyz(1.0, 2.0, 3.0);
        let dt = Time::si(2.0);
        let way: Position = v * dt;
        assert_eq!(way, Position::from_xyz(2.0, 4.0, 6.0));
        assert_eq!(dt * v, way);
        let back: Velocity<Enu> = way / dt;
        assert_eq!(back, v);
        let force: ForceVec<Enu> = Mass::si(0.5) * (v / dt);
        assert_eq!(force, ForceVec::from_xyz(0.25, 0.5, 0.75));
        let push: ImpulseVec<Enu> = Mass::si(0.5) * v;
        assert_eq!((push, push / dt), (force * dt, force));
        let turn: V3<Angle, Flu> = Rate::from_xyz(0.0, 0.0, 1.5) * dt;
        assert_eq!(turn.up(), Angle::si(3.0));
    }

    #[test]
    fn limit_shortens_and_keeps_the_direction() {
        let v = Velocity::<Flu>::from_xyz(3.0, 4.0, 0.0);
        assert_eq!(v.limit(Speed::si(10.0)), v);
        assert_eq!(v.limit(Speed::si(2.5)), v / 2.0);
        assert_eq!(v.limit(Speed::ZERO), Velocity::ZERO);
        assert_eq!(v.limit(Speed::si(-1.0)), Velocity::ZERO);
        assert_eq!(Velocity::<Flu>::ZERO.limit(Speed::ZERO), Velocity::ZERO);
    }

    #[test]
    fn limit_shortens_what_is_too_long_to_square() {
        let v = Velocity::<Flu>::from_xyz(3e300, -4e300, 0.0).limit(Speed::si(2.5));
        assert!(v.si().abs_diff_eq(DVec3::new(1.5, -2.0, 0.0), 1e-15), "{v}");
        let most = Velocity::<Flu>::from_xyz(f64::MAX, f64::MAX, f64::MAX).limit(Speed::si(1.0));
        assert!((most.length() - Speed::si(1.0)).abs() < Speed::si(1e-15));
        let long = Velocity::<Flu>::from_xyz(1e200, 0.0, 0.0);
        assert_eq!(long.limit(Speed::si(1e201)), long);
        assert!(
            !Velocity::<Flu>::from_xyz(f64::NAN, 0.0, 0.0)
                .limit(Speed::si(1.0))
                .is_finite()
        );
    }

    #[test]
    fn only_vectors_with_a_length_have_a_direction() {
        let direction = Position::from_xyz(0.0, 3.0, 4.0).direction().unwrap();
        assert!(direction.abs_diff_eq(DVec3::new(0.0, 0.6, 0.8), 1e-15));
        assert!(Position::ZERO.direction().is_none());
        assert!(Position::from_xyz(f64::NAN, 0.0, 0.0).direction().is_none());
        let back = Position::along(direction, Length::si(5.0));
        assert!(back.distance(Position::from_xyz(0.0, 3.0, 4.0)) < Length::si(1e-14));
    }

    #[test]
    fn a_vector_costs_three_numbers() {
        assert_eq!(size_of::<Position>(), 24);
        assert_eq!(size_of::<Option<crate::Pose>>(), 64);
    }
}
