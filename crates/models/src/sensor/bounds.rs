//! Bounds of parameters: what is checked of every sensor's sigmas, steps and ranges.
//!
//! No number is so large, and no step so small, that what is reckoned from it leaves the numbers.

use simbeeotic_model::BuildError;
use simbeeotic_model::check::in_range;
use simbeeotic_model::units::{
    Angle, AngularRate, Concentration, Current, Decibels, Frequency, Illuminance, Length,
    MagneticField, Position, Pressure, Quantity, Speed, Time, Voltage,
};
use std::fmt::Display;

/// The most of a sigma, a bias, a limit, in SI units.
pub(super) const MOST: f64 = 1e9;
/// The least step that is not 0, in SI units.
pub(super) const LEAST_STEP: f64 = 1e-15;
/// How far a ray may reach, m.
const REACH_M: f64 = 1e5;
/// How far from the origin a fixed place may be, along each axis, m.
const PLACE_M: f64 = 1e6;

/// A number, with a unit or without.
pub(super) trait Number: Copy + PartialOrd + Display {
    fn of(si: f64) -> Self;
}

impl Number for f64 {
    fn of(si: f64) -> Self {
        si
    }
}

macro_rules! numbers {
    ($($Q:ty),*) => {
        $(impl Number for $Q {
            fn of(si: f64) -> Self {
                Quantity::from_si(si)
            }
        })*
    };
}
numbers!(
    Angle,
    AngularRate,
    Concentration,
    Current,
    Decibels,
    Frequency,
    Illuminance,
    Length,
    MagneticField,
    Pressure,
    Speed,
    Time,
    Voltage
);

fn above_zero<T: Number>(key: &'static str, value: T) -> Result<(), BuildError> {
    if value > T::of(0.0) {
        Ok(())
    } else {
        let message = format!("must be more than zero, and is {value}");
        Err(BuildError::parameter(key, message))
    }
}

/// 0 to 1e9 in SI units.
pub(super) fn at_least_zero<T: Number>(key: &'static str, value: T) -> Result<(), BuildError> {
    in_range(key, value, T::of(0.0)..=T::of(MOST))
}

/// Above 0, to 1e9 in SI units.
pub(super) fn positive<T: Number>(key: &'static str, value: T) -> Result<(), BuildError> {
    above_zero(key, value)?;
    at_least_zero(key, value)
}

/// What readings are multiples of: 0, or 1e-15 to 1e9 in SI units.
pub(super) fn step<T: Number>(key: &'static str, value: T) -> Result<(), BuildError> {
    if value == T::of(0.0) {
        return Ok(());
    }
    let (least, most) = (T::of(LEAST_STEP), T::of(MOST));
    if (least..=most).contains(&value) {
        return Ok(());
    }
    let message = format!("must be zero, or lie between {least} and {most}, and is {value}");
    Err(BuildError::parameter(key, message))
}

/// How far a sensor looks: above 0, to 100 km.
pub(super) fn reach(key: &'static str, range: Length) -> Result<(), BuildError> {
    above_zero(key, range)?;
    in_range(key, range, Length::ZERO..=Length::si(REACH_M))
}

/// Where something is fixed in the world: to 1,000 km along each axis.
pub(super) fn place(key: &'static str, place: Position) -> Result<(), BuildError> {
    if place.si().abs().max_element() <= PLACE_M && place.si().is_finite() {
        return Ok(());
    }
    let most = Length::si(PLACE_M);
    let message = format!("must lie within {most} of the origin along each axis, and is {place}");
    Err(BuildError::parameter(key, message))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::refusal;

    #[test]
    fn what_leaves_the_numbers_is_refused_by_name_whatever_the_sensor() {
        for (kind, key, text) in [
            ("position", "sigma", "1.7e308 m"),
            ("pose", "sigma", "1e300 rad"),
            ("pose", "position_sigma", "1e300 m"),
            ("compass", "sigma", "1e300 rad"),
            ("gnss", "horizontal_sigma", "1e300 m"),
            ("gnss", "correlation_time", "1e300 s"),
            ("gnss", "sky_range", "1e6 m"),
            (
                "magnetometer",
                "soft_iron",
                "[[1e308, 0, 0], [0, 1, 0], [0, 0, 1]]",
            ),
            ("magnetometer", "strength", "1e300 T"),
            ("contact", "radius", "1e300 m"),
            ("clock", "offset", "1e300 s"),
            ("clock", "jitter", "1e300 s"),
            ("clock", "resolution", "1e-310 s"),
            ("link", "window", "1e300 s"),
            ("link", "window", "3601 s"),
            ("link", "rssi_step", "1e-310 dB"),
            ("uwb", "max_range", "2e9 m"),
            ("uwb", "frequency", "1e300 Hz"),
            ("uwb", "nlos_bias", "1e300 m"),
            ("uwb", "nlos_sigma", "1e300 m"),
            ("uwb", "anchors", "[[2e6 m, 0 m, 0 m]]"),
            ("mocap", "cameras", "[[0 m, 0 m, 2e6 m], [0 m, 0 m, 1 m]]"),
            ("mocap", "sigma", "1e300 m"),
            ("pmw3901", "scale", "1e300"),
            ("pmw3901", "max_rate", "1e300 rad/s"),
            ("pmw3901", "min_light", "1e300 lx"),
            ("pmw3901", "min_range", "1e300 m"),
            ("pmw3901", "min_range", "1001 m"),
            ("pmw3901", "max_range", "2e9 m"),
            ("optical-flow", "max_range", "2e9 m"),
            ("optical-flow", "sigma", "1e300 rad/s"),
            ("altimeter", "max_range", "2e9 m"),
            ("altimeter", "ground_elevation", "1e300 m"),
            ("altimeter", "resolution", "1e-310 m"),
            ("battery", "voltage_limit", "1e300 V"),
            ("battery", "current_step", "1e-310 A"),
            ("barometer", "sigma", "1e300 Pa"),
            ("range", "sigma", "1e300 m"),
            ("range", "step", "1e-310 m"),
            ("neighbors", "max_range", "2e9 m"),
            ("neighbors", "distance_sigma", "1e300"),
            ("light", "resolution", "1e-310 lx"),
            ("smell", "resolution", "1e-310 kg/m^3"),
            ("motor", "sigma", "1e300"),
        ] {
            let refusal = refusal(kind, &[(key, text)]);
            let refusal = refusal.unwrap_or_else(|| panic!("{kind} takes {key} = {text}"));
            assert!(refusal.contains(key), "{kind}: {refusal}");
        }
    }

    #[test]
    fn the_ends_of_what_is_allowed_are_allowed() {
        assert!(reach("r", Length::si(1e5)).is_ok() && reach("r", Length::ZERO).is_err());
        assert!(step("s", 0.0).is_ok() && step("s", 1e-15).is_ok() && step("s", -1.0).is_err());
        assert!(at_least_zero("s", 1e9).is_ok() && at_least_zero("s", f64::NAN).is_err());
        assert!(positive("s", Time::si(1e9)).is_ok() && positive("s", Time::ZERO).is_err());
        assert!(place("p", Position::from_xyz(-1e6, 0.0, 1e6)).is_ok());
        assert!(place("p", Position::from_xyz(f64::NAN, 0.0, 0.0)).is_err());
    }
}
