//! Ranges of parameters, checked the same way everywhere.
//!
//! Quantities are checked as they are (`positive("radius", params.radius)`), and messages show them
//! with their units.

use crate::kit::BuildError;
use std::fmt::Display;
use std::ops::RangeInclusive;

/// `value`, a quantity or a number, must be more than zero.
///
/// # Errors
/// It is not; the error points at `key`.
pub fn positive<T>(key: &'static str, value: T) -> Result<(), BuildError>
where
    T: PartialOrd + Default + Display,
{
    if value > T::default() {
        Ok(())
    } else {
        let message = format!("must be more than zero, and is {value}");
        Err(BuildError::parameter(key, message))
    }
}

/// `value`, a quantity or a number, must be zero or more.
///
/// # Errors
/// It is not; the error points at `key`.
pub fn at_least_zero<T>(key: &'static str, value: T) -> Result<(), BuildError>
where
    T: PartialOrd + Default + Display,
{
    if value >= T::default() {
        Ok(())
    } else {
        let message = format!("must be zero or more, and is {value}");
        Err(BuildError::parameter(key, message))
    }
}

/// `value`, a quantity or a number, must lie in `range`.
///
/// # Errors
/// It does not; the error points at `key`.
pub fn in_range<T>(key: &'static str, value: T, range: RangeInclusive<T>) -> Result<(), BuildError>
where
    T: PartialOrd + Display,
{
    if range.contains(&value) {
        Ok(())
    } else {
        let (least, most) = range.into_inner();
        let message = format!("must lie between {least} and {most}, and is {value}");
        Err(BuildError::parameter(key, message))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::{Length, Speed};

    fn message(result: Result<(), BuildError>) -> String {
        result.expect_err("it is refused").to_string()
    }

    #[test]
    fn quantities_and_numbers_are_checked_alike() {
        assert!(positive("radius", Length::si(0.1)).is_ok() && positive("share", 0.1).is_ok());
        assert!(positive("radius", Length::ZERO).is_err() && positive("share", 0.0).is_err());
        assert!(at_least_zero("speed", Speed::ZERO).is_ok() && at_least_zero("share", 0.0).is_ok());
        assert!(in_range("share", 1.0, 0.0..=1.0).is_ok());
        assert!(positive("share", f64::NAN).is_err() && at_least_zero("share", f64::NAN).is_err());
    }

    #[test]
    fn messages_show_quantities_with_their_units() {
        let fault = message(positive("radius", Length::si(-2.5)));
        assert!(fault.contains("-2.5 m"), "{fault}");
        let fault = message(in_range("v", Speed::si(3.0), Speed::ZERO..=Speed::si(2.0)));
        assert!(
            fault.contains("between 0 m/s and 2 m/s, and is 3 m/s"),
            "{fault}"
        );
    }
}
