//! Ranges of parameters, checked the same way everywhere.

use crate::kit::BuildError;
use std::ops::RangeInclusive;

/// `value` must be more than zero.
///
/// # Errors
/// It is not; the error points at `key`.
pub fn positive(key: &'static str, value: f64) -> Result<(), BuildError> {
    if value > 0.0 {
        Ok(())
    } else {
        Err(BuildError::parameter(key, "must be more than zero"))
    }
}

/// `value` must be zero or more.
///
/// # Errors
/// It is not; the error points at `key`.
pub fn at_least_zero(key: &'static str, value: f64) -> Result<(), BuildError> {
    if value >= 0.0 {
        Ok(())
    } else {
        Err(BuildError::parameter(key, "must be zero or more"))
    }
}

/// `value` must lie in `range`.
///
/// # Errors
/// It does not; the error points at `key`.
pub fn in_range(
    key: &'static str,
    value: f64,
    range: RangeInclusive<f64>,
) -> Result<(), BuildError> {
    if range.contains(&value) {
        Ok(())
    } else {
        let message = format!("must lie between {} and {}", range.start(), range.end());
        Err(BuildError::parameter(key, message))
    }
}
