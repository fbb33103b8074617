//! What parameters of a generator cannot be.

use simbeeotic_units::Length;
use std::fmt::Display;
use std::ops::RangeInclusive;

/// A parameter of which no world can be made.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{key}` {message}")]
pub struct GenerateError {
    /// The parameter.
    pub key: &'static str,
    /// What is wrong with it and what is allowed: "must lie between 1 and 1000, and is 0".
    pub message: String,
}

/// More objects than this are refused: a slip of the keyboard would fill the memory.
pub(super) const OBJECTS_MAX: f64 = 1e6;

pub(super) fn error<T>(key: &'static str, message: String) -> Result<T, GenerateError> {
    Err(GenerateError { key, message })
}

/// `value`, a quantity or a number, must lie in `range`. What is no number does not.
pub(super) fn within<T>(
    key: &'static str,
    value: T,
    range: RangeInclusive<T>,
) -> Result<(), GenerateError>
where
    T: PartialOrd + Display,
{
    if range.contains(&value) {
        return Ok(());
    }
    let (least, most) = range.into_inner();
    error(
        key,
        format!("must lie between {least} and {most}, and is {value}"),
    )
}

/// A length must lie between two numbers of metres.
pub(super) fn metres(
    key: &'static str,
    value: Length,
    range: RangeInclusive<f64>,
) -> Result<(), GenerateError> {
    let (least, most) = range.into_inner();
    within(key, value, Length::si(least)..=Length::si(most))
}

/// A chance or a share lies between 0 and 1.
pub(super) fn share(key: &'static str, value: f64) -> Result<(), GenerateError> {
    within(key, value, 0.0..=1.0)
}

/// `value` must be at least `least`, because of `why`: "or a vehicle of 0.5 m does not pass".
pub(super) fn at_least(
    key: &'static str,
    value: Length,
    least: Length,
    why: &str,
) -> Result<(), GenerateError> {
    // A hair of slack, for sums of decimal fractions.
    if value.get() >= least.get() - 1e-9 {
        return Ok(());
    }
    error(
        key,
        format!("must be at least {least:.3}, and is {value}: {why}"),
    )
}

/// Not more than [`OBJECTS_MAX`] of something.
pub(super) fn not_too_many(key: &'static str, what: &str, count: f64) -> Result<(), GenerateError> {
    if count <= OBJECTS_MAX {
        return Ok(());
    }
    error(
        key,
        format!("makes {count:.0} {what}; at most {OBJECTS_MAX} are possible"),
    )
}
