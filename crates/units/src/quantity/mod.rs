//! Quantities: `f64` numbers in SI units with a type, and with their unit in text.
//!
//! Every quantity has the same face, written here for [`Length`]:
//!
//! | what | how |
//! |---|---|
//! | from and to the SI number | `Length::si(2.0)`, `length.get()` |
//! | from and to a usual unit | `Length::from_metres(2.0)`, `length.metres()`; `Time::from_millis(100.0)` |
//! | from and to text | `"2 m".parse::<Length>()`, `length.to_string()`, `format!("{length:.1}")` |
//! | arithmetic | `+`, `-`, `+=`, `-=`, `-a`, `* 2.0`, `2.0 *`, `/ 2.0`, `a / b` (a bare `f64`), `.sum()` |
//! | comparison | `<`, `==`, `min`, `max`, `clamp`, `abs`, `total_cmp`, `is_finite` |
//! | products | `speed * time` is a [`Length`], `length / time` is a [`Speed`], ... |
//!
//! The products are those of physics and are listed as trait implementations of each type.
//! [`PowerLevel`] (dBm) is the exception to the arithmetic: two levels cannot be added; their
//! difference is in [`Decibels`], and decibels are added to a level.
//!
//! # Text
//!
//! A number, a unit, and white space or nothing between them: `0.2 m/s`, `100ms`, `-1e-3 N m`.
//! Units are those of [`Quantity::UNITS`], spelled exactly so, except that `µ`, `²`, `³`, `·`, `°`
//! and `°C` may stand for `u`, `^2`, `^3`, a space, `deg` and `degC`. Text is printed in the SI
//! unit with the fewest digits that read back as the same bits. Infinity and NaN are no quantities
//! in text; in memory they are ordinary `f64` values, so that a computation can be checked once,
//! at its end, with `is_finite`.
//!
//! In serde a quantity is a string, in both directions, and may be written in another unit than SI's
//! if that is shorter and reads back as the same bits: `45 deg`. Bare numbers are refused.
//! The JSON schema of a quantity is a string with two extra keys, `x-si-unit` and `x-units`.

mod air;
mod ambient;
mod decibels;
mod define;
mod electricity;
mod kind;
mod magnetism;
mod mechanics;
mod parse;
pub(crate) mod print;
mod products;
pub(crate) mod serial;
mod signal;

pub use air::{Density, Pressure, Temperature};
pub use ambient::{Circulation, Concentration, Illuminance, LuminousIntensity, MassRate, RainRate};
pub use decibels::{Decibels, PowerLevel};
pub use electricity::{Charge, Conductivity, Current, Energy, Power, Resistance, Voltage};
pub use kind::{Quantity, Scale, Unit, VectorQuantity};
pub use magnetism::MagneticField;
pub use mechanics::{
    Acceleration, Angle, AngularRate, Area, Force, Impulse, Length, Mass, Speed, Time, Torque,
};
pub use parse::QuantityError;
pub use signal::{DataRate, Frequency};
