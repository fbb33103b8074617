//! What every quantity is: a name, a list of units, an `f64` in the first of them.

use super::QuantityError;
use std::fmt::{Debug, Display};
use std::str::FromStr;

/// A physical quantity: an `f64` in its SI unit, with a type.
///
/// Implemented by every quantity of this crate; generic code (vectors, readers of parameters,
/// tables) is written against it. Methods that users need are inherent to each type.
pub trait Quantity:
    Copy + PartialOrd + Debug + Display + FromStr<Err = QuantityError> + Send + Sync + 'static
{
    /// The name as prose with its article, for messages: `"an angle"`.
    const NOUN: &'static str;

    /// The units that text may use; the first is the one that the number inside counts, and the
    /// one that text is printed in.
    const UNITS: &'static [Unit];

    /// From a number of the first unit.
    fn from_si(value: f64) -> Self;

    /// As a number of the first unit.
    fn to_si(self) -> f64;
}

/// A quantity that vectors may be made of: it has a direction in space.
///
/// See [`V3`](crate::V3).
pub trait VectorQuantity: Quantity {}

/// A unit: how it is written and what it is worth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// The spelling in text, for example `"km/h"`.
    pub name: &'static str,
    /// The worth of one such unit.
    pub scale: Scale,
}

/// The step from a number of some unit to the number of the SI unit:
/// `si = value * times / over + plus`.
///
/// Multiplier and divisor are kept apart because `7.0 / 1000.0` is the `f64` nearest to 0.007 and
/// `7.0 * 0.001` need not be: so `"7 ms"`, `"0.007 s"` and `Time::from_millis(7.0)` are equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    times: f64,
    over: f64,
    plus: f64,
}

impl Scale {
    /// The SI unit itself.
    pub const ONE: Self = Self::ratio(1.0, 1.0);

    /// A unit worth `factor` SI units: kilometre is `times(1000.0)`.
    pub const fn times(factor: f64) -> Self {
        Self::ratio(factor, 1.0)
    }

    /// A unit of which `count` make one SI unit: millimetre is `over(1000.0)`.
    pub const fn over(count: f64) -> Self {
        Self::ratio(1.0, count)
    }

    /// A unit worth `times / over` SI units: km/h is `ratio(1000.0, 3600.0)`.
    pub const fn ratio(times: f64, over: f64) -> Self {
        Self {
            times,
            over,
            plus: 0.0,
        }
    }

    /// A unit as large as the SI unit whose zero lies elsewhere: degree Celsius is
    /// `shifted(273.15)`.
    pub const fn shifted(plus: f64) -> Self {
        Self {
            times: 1.0,
            over: 1.0,
            plus,
        }
    }

    /// The SI number of `value` such units.
    pub const fn to_si(self, value: f64) -> f64 {
        if self.plus == 0.0 {
            value * self.times / self.over // keeps the sign of zero
        } else {
            value * self.times / self.over + self.plus
        }
    }

    /// The number of such units in `si` SI units.
    pub const fn of_si(self, si: f64) -> f64 {
        (si - self.plus) * self.over / self.times
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_goes_both_ways() {
        for scale in [
            Scale::ONE,
            Scale::times(1e3),
            Scale::over(1e3),
            Scale::ratio(1000.0, 3600.0),
            Scale::shifted(273.15),
        ] {
            assert!(
                (scale.of_si(scale.to_si(12.5)) - 12.5).abs() < 1e-12,
                "{scale:?}"
            );
        }
    }

    #[test]
    fn small_units_are_rounded_once() {
        for n in 0..10_000 {
            let text: f64 = format!("{n}e-3").parse().unwrap();
            assert_eq!(Scale::over(1e3).to_si(f64::from(n)), text);
        }
    }
}
