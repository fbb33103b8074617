//! Directions in the horizontal plane: what a compass says and what mathematics says.

use super::{Enu, V3};
use crate::math;
use crate::quantity::{Angle, QuantityError, VectorQuantity, serial};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::f64::consts::FRAC_PI_2;
use std::fmt;
use std::ops::{Add, AddAssign, Sub, SubAssign};
use std::str::FromStr;

/// A direction in the horizontal plane, **clockwise from north**, in [0, 2π): what a compass says.
///
/// North is 0, east is π/2. Adding an angle turns clockwise. Convert to and from [`Yaw`] with
/// `into()`. In text and serde it is an [`Angle`]; any angle is taken and wrapped.
///
/// ```
/// use simbeeotic_units::{Angle, Heading, Yaw};
///
/// let west = Heading::NORTH - Angle::QUARTER_TURN;
/// assert_eq!(west, Heading::WEST);
/// assert_eq!(west.angle().degrees(), 270.0);
/// assert_eq!(Yaw::from(west), Yaw::WEST);
/// ```
#[derive(Clone, Copy, Default, PartialEq, PartialOrd)]
pub struct Heading(Angle);

/// A direction in the horizontal plane, **counter-clockwise from east**, in (-π, π]: what
/// mathematics says.
///
/// East is 0, north is π/2. Adding an angle turns counter-clockwise. Convert to and from
/// [`Heading`] with `into()`. In text and serde it is an [`Angle`]; any angle is taken and wrapped.
#[derive(Clone, Copy, Default, PartialEq, PartialOrd)]
pub struct Yaw(Angle);

impl Heading {
    /// Along the second axis of [`Enu`].
    pub const NORTH: Self = Self(Angle::ZERO);
    /// Along the first axis of [`Enu`].
    pub const EAST: Self = Self(Angle::QUARTER_TURN);
    /// Against the second axis of [`Enu`].
    pub const SOUTH: Self = Self(Angle::HALF_TURN);
    /// Against the first axis of [`Enu`].
    pub const WEST: Self = Self(Angle::si(3.0 * FRAC_PI_2));

    /// From an angle clockwise from north, wrapped to [0, 2π); NaN if the angle is not finite.
    pub fn new(clockwise_from_north: Angle) -> Self {
        Self(clockwise_from_north.wrapped_positive())
    }

    /// The angle clockwise from north, in [0, 2π).
    #[inline]
    pub const fn angle(self) -> Angle {
        self.0
    }

    /// From a number of radians clockwise from north, as [`Heading::new`].
    pub fn si(radians: f64) -> Self {
        Self::new(Angle::si(radians))
    }

    /// As a number of radians clockwise from north, in [0, 2π).
    #[inline]
    pub const fn get(self) -> f64 {
        self.0.get()
    }

    /// The direction of the horizontal part of a vector; north if it has none.
    pub fn of<Q: VectorQuantity>(vector: V3<Q, Enu>) -> Self {
        let v = vector.si();
        Self(Angle::si(math::wrap_positive(math::atan2(v.x, v.y))))
    }

    /// The horizontal vector of a given length in this direction.
    pub fn along<Q: VectorQuantity>(self, length: Q) -> V3<Q, Enu> {
        let (sin, cos) = self.0.sin_cos();
        V3::from_xyz(sin * length.to_si(), cos * length.to_si(), 0.0)
    }
}

impl Yaw {
    /// Along the first axis of [`Enu`].
    pub const EAST: Self = Self(Angle::ZERO);
    /// Along the second axis of [`Enu`].
    pub const NORTH: Self = Self(Angle::QUARTER_TURN);
    /// Against the first axis of [`Enu`].
    pub const WEST: Self = Self(Angle::HALF_TURN);
    /// Against the second axis of [`Enu`].
    pub const SOUTH: Self = Self(Angle::si(-FRAC_PI_2));

    /// From an angle counter-clockwise from east, wrapped to (-π, π]; NaN if the angle is not
    /// finite.
    pub fn new(counter_clockwise_from_east: Angle) -> Self {
        Self(counter_clockwise_from_east.wrapped())
    }

    /// The angle counter-clockwise from east, in (-π, π].
    #[inline]
    pub const fn angle(self) -> Angle {
        self.0
    }

    /// From a number of radians counter-clockwise from east, as [`Yaw::new`].
    pub fn si(radians: f64) -> Self {
        Self::new(Angle::si(radians))
    }

    /// As a number of radians counter-clockwise from east, in (-π, π].
    #[inline]
    pub const fn get(self) -> f64 {
        self.0.get()
    }

    /// The direction of the horizontal part of a vector; east if it has none.
    pub fn of<Q: VectorQuantity>(vector: V3<Q, Enu>) -> Self {
        let v = vector.si();
        Self(Angle::si(math::wrap_signed(math::atan2(v.y, v.x))))
    }

    /// The horizontal vector of a given length in this direction.
    pub fn along<Q: VectorQuantity>(self, length: Q) -> V3<Q, Enu> {
        let (sin, cos) = self.0.sin_cos();
        V3::from_xyz(cos * length.to_si(), sin * length.to_si(), 0.0)
    }
}

impl From<Heading> for Yaw {
    fn from(heading: Heading) -> Self {
        Self::new(Angle::si(FRAC_PI_2 - heading.0.get()))
    }
}

impl From<Yaw> for Heading {
    fn from(yaw: Yaw) -> Self {
        Self::new(Angle::si(FRAC_PI_2 - yaw.0.get()))
    }
}

/// What the two types share; the sense in which angles count is each type's own.
macro_rules! direction {
    ($Name:ident, $sense:literal, $from:literal, $range:literal) => {
        #[doc = concat!("Turned ", $sense, " by the angle.")]
        impl Add<Angle> for $Name {
            type Output = Self;
            fn add(self, turn: Angle) -> Self {
                Self::new(self.0 + turn)
            }
        }

        #[doc = concat!("Turned against ", $sense, " by the angle.")]
        impl Sub<Angle> for $Name {
            type Output = Self;
            fn sub(self, turn: Angle) -> Self {
                Self::new(self.0 - turn)
            }
        }

        #[doc = concat!("The shortest turn from the other to this, in (-π, π], ", $sense, " positive.")]
        impl Sub for $Name {
            type Output = Angle;
            fn sub(self, other: Self) -> Angle {
                (self.0 - other.0).wrapped()
            }
        }

        impl AddAssign<Angle> for $Name {
            fn add_assign(&mut self, turn: Angle) {
                *self = *self + turn;
            }
        }

        impl SubAssign<Angle> for $Name {
            fn sub_assign(&mut self, turn: Angle) {
                *self = *self - turn;
            }
        }

        impl fmt::Display for $Name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)
            }
        }

        impl fmt::Debug for $Name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Display::fmt(&self.0, f)
            }
        }

        impl FromStr for $Name {
            type Err = QuantityError;
            fn from_str(text: &str) -> Result<Self, QuantityError> {
                text.parse().map(Self::new)
            }
        }

        impl Serialize for $Name {
            fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
                self.0.serialize(s)
            }
        }

        impl<'de> Deserialize<'de> for $Name {
            fn deserialize<D: Deserializer<'de>>(d: D) -> Result<Self, D::Error> {
                Angle::deserialize(d).map(Self::new)
            }
        }

        impl schemars::JsonSchema for $Name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($Name).into()
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                let mut schema = serial::schema::<Angle>();
                let text = concat!("a direction as an angle ", $sense, " from ", $from, ", ", $range);
                schema.insert("description".to_owned(), text.into());
                schema
            }
        }
    };
}

direction!(Heading, "clockwise", "north", "0 to 1 turn");
direction!(Yaw, "counter-clockwise", "east", "-0.5 to 0.5 turn");

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::Speed;
    use std::f64::consts::PI;

    fn heading(degrees: f64) -> Heading {
        Heading::new(Angle::from_degrees(degrees))
    }

    fn yaw(degrees: f64) -> Yaw {
        Yaw::new(Angle::from_degrees(degrees))
    }

    #[test]
    fn heading_is_clockwise_from_north() {
        assert_eq!(Heading::NORTH, heading(0.0));
        assert_eq!(Heading::EAST, heading(90.0));
        assert_eq!(Heading::SOUTH, heading(180.0));
        assert_eq!(Heading::WEST, heading(270.0));
        assert_eq!(heading(-90.0), Heading::WEST);
    }

    #[test]
    fn heading_and_yaw_name_the_same_directions() {
        for (h, y) in [
            (0.0, 90.0),
            (45.0, 45.0),
            (90.0, 0.0),
            (180.0, -90.0),
            (270.0, 180.0),
            (300.0, 150.0),
        ] {
            let back = Yaw::from(heading(h));
            assert!(
                (back - yaw(y)).abs() < Angle::si(1e-14),
                "heading {h}: {back}, not {y} deg"
            );
            let back = Heading::from(yaw(y));
            assert!(
                (back - heading(h)).abs() < Angle::si(1e-14),
                "yaw {y}: {back}, not {h} deg"
            );
        }
    }

    #[test]
    fn heading_and_yaw_of_a_vector_agree() {
        let north_east = V3::<Speed, Enu>::from_xyz(1.0, 1.0, 5.0);
        assert!((Heading::of(north_east) - heading(45.0)).abs() < Angle::si(1e-15));
        assert!((Yaw::of(north_east) - yaw(45.0)).abs() < Angle::si(1e-15));
        let west = V3::<Speed, Enu>::from_xyz(-1.0, 0.0, 0.0);
        assert_eq!(Heading::of(west), Heading::WEST);
        assert_eq!(Yaw::of(west), Yaw::new(Angle::HALF_TURN));
        // A negative zero must not bring -π in, which lies outside the range.
        let west = V3::<Speed, Enu>::from_xyz(-1.0, -0.0, 0.0);
        assert_eq!(Yaw::of(west).angle().get(), PI);
    }

    #[test]
    fn a_vector_along_a_direction_points_there() {
        let v = heading(30.0).along(Speed::si(2.0));
        assert!((v.east().get() - 1.0).abs() < 1e-15);
        assert!((v.north().get() - 3f64.sqrt()).abs() < 1e-15);
        assert!(
            (Yaw::of(heading(30.0).along(Speed::si(2.0))) - yaw(60.0)).abs() < Angle::si(1e-15)
        );
    }

    #[test]
    fn the_difference_is_the_shortest_turn() {
        assert!(((heading(10.0) - heading(350.0)).degrees() - 20.0).abs() < 1e-12);
        assert!(((heading(350.0) - heading(10.0)).degrees() + 20.0).abs() < 1e-12);
        assert!(((yaw(-170.0) - yaw(170.0)).degrees() - 20.0).abs() < 1e-12);
    }

    #[test]
    fn text_is_that_of_an_angle() {
        assert_eq!("90 deg".parse(), Ok(Heading::EAST));
        assert_eq!("450 deg".parse(), Ok(Heading::EAST));
        assert_eq!("-180 deg".parse(), Ok(yaw(180.0)));
        assert!("north".parse::<Heading>().is_err());
    }
}
