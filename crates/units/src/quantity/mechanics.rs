//! Space, time, motion and what causes it.

use super::define::{linear_quantity, quantity, vector_quantity};
use super::{Quantity, Scale};
use crate::math;
use std::f64::consts::{PI, TAU};
use std::time::Duration;

vector_quantity! {
    /// A length or a distance, inside in metres.
    Length = "a length" {
        "m": Scale::ONE => from_metres, metres;
        "km": Scale::times(1e3) => from_kilometres, kilometres;
        "cm": Scale::over(1e2) => from_centimetres, centimetres;
        "mm": Scale::over(1e3) => from_millimetres, millimetres;
        "um": Scale::over(1e6);
    }
}

linear_quantity! {
    /// An area, inside in square metres.
    Area = "an area" {
        "m^2": Scale::ONE => from_square_metres, square_metres;
        "cm^2": Scale::over(1e4);
        "mm^2": Scale::over(1e6);
        "km^2": Scale::times(1e6);
    }
}

vector_quantity! {
    /// A speed or one component of a velocity, inside in metres per second.
    Speed = "a speed" {
        "m/s": Scale::ONE => from_metres_per_second, metres_per_second;
        "cm/s": Scale::over(1e2);
        "mm/s": Scale::over(1e3);
        "km/h": Scale::ratio(1e3, 3600.0) => from_kilometres_per_hour, kilometres_per_hour;
    }
}

vector_quantity! {
    /// An acceleration, inside in metres per second squared.
    ///
    /// `g` is the standard acceleration of gravity, 9.80665 m/s² (ISO 80000-3), wherever the run takes
    /// place; `mg` and `ug` are its thousandth and millionth, as data sheets use them.
    Acceleration = "an acceleration" {
        "m/s^2": Scale::ONE => from_metres_per_second_squared, metres_per_second_squared;
        "cm/s^2": Scale::over(1e2);
        "g": Scale::times(9.80665) => from_g, g;
        "mg": Scale::ratio(9.80665, 1e3);
        "ug": Scale::ratio(9.80665, 1e6);
    }
}

vector_quantity! {
    /// A plane angle, inside in radians, of any size and sign.
    ///
    /// Positive is counter-clockwise seen against the axis (right-hand rule) unless the place that
    /// uses it says otherwise. Directions in the horizontal plane have types of their own,
    /// [`Heading`](crate::Heading) and [`Yaw`](crate::Yaw).
    Angle = "an angle" {
        "rad": Scale::ONE => from_radians, radians;
        "deg": Scale::ratio(PI, 180.0) => from_degrees, degrees;
        "turn": Scale::times(TAU) => from_turns, turns;
    }
}

vector_quantity! {
    /// An angular rate, inside in radians per second.
    AngularRate = "an angular rate" {
        "rad/s": Scale::ONE => from_radians_per_second, radians_per_second;
        "deg/s": Scale::ratio(PI, 180.0) => from_degrees_per_second, degrees_per_second;
        "rpm": Scale::ratio(TAU, 60.0) => from_rpm, rpm;
    }
}

linear_quantity! {
    /// A mass, inside in kilograms.
    Mass = "a mass" {
        "kg": Scale::ONE => from_kilograms, kilograms;
        "g": Scale::over(1e3) => from_grams, grams;
        "mg": Scale::over(1e6) => from_milligrams, milligrams;
    }
}

vector_quantity! {
    /// A force, inside in newtons.
    Force = "a force" {
        "N": Scale::ONE => from_newtons, newtons;
        "kN": Scale::times(1e3);
        "mN": Scale::over(1e3) => from_millinewtons, millinewtons;
        "uN": Scale::over(1e6);
    }
}

vector_quantity! {
    /// An impulse, inside in newton seconds: a force times the time it acts, or the change of a
    /// mass's velocity times the mass.
    Impulse = "an impulse" {
        "N s": Scale::ONE => from_newton_seconds, newton_seconds;
        "mN s": Scale::over(1e3);
        "uN s": Scale::over(1e6);
    }
}

vector_quantity! {
    /// A torque, inside in newton metres.
    ///
    /// It has the dimension of an energy and is none: make one with [`Force::torque`].
    Torque = "a torque" {
        "N m": Scale::ONE => from_newton_metres, newton_metres;
        "mN m": Scale::over(1e3);
        "uN m": Scale::over(1e6);
    }
}

linear_quantity! {
    /// A span of time, inside in seconds; may be negative.
    ///
    /// Instants of simulated time are whole nanoseconds and another type (the kernel's `SimTime`).
    Time = "a time" {
        "s": Scale::ONE => from_secs, secs;
        "ms": Scale::over(1e3) => from_millis, millis;
        "us": Scale::over(1e6) => from_micros, micros;
        "ns": Scale::over(1e9) => from_nanos, nanos;
        "min": Scale::times(60.0) => from_minutes, minutes;
        "h": Scale::times(3600.0) => from_hours, hours;
    }
}

impl Angle {
    /// One whole turn, 2π.
    pub const TURN: Self = Self(TAU);
    /// Half a turn, π.
    pub const HALF_TURN: Self = Self(PI);
    /// A right angle, π/2.
    pub const QUARTER_TURN: Self = Self(PI / 2.0);

    /// The sine.
    pub fn sin(self) -> f64 {
        math::sin(self.0)
    }

    /// The cosine.
    pub fn cos(self) -> f64 {
        math::cos(self.0)
    }

    /// The tangent.
    pub fn tan(self) -> f64 {
        math::tan(self.0)
    }

    /// Sine and cosine together.
    pub fn sin_cos(self) -> (f64, f64) {
        math::sin_cos(self.0)
    }

    /// The angle whose sine is `ratio`, -π/2 to π/2; NaN outside [-1, 1].
    pub fn asin(ratio: f64) -> Self {
        Self(math::asin(ratio))
    }

    /// The angle whose cosine is `ratio`, 0 to π; NaN outside [-1, 1].
    pub fn acos(ratio: f64) -> Self {
        Self(math::acos(ratio))
    }

    /// The angle of the point (`x`, `y`) seen from the origin, counter-clockwise from the x axis,
    /// -π to π; 0 at the origin.
    pub fn atan2<Q: Quantity>(y: Q, x: Q) -> Self {
        Self(math::atan2(y.to_si(), x.to_si()))
    }

    /// The same direction in (-π, π].
    #[must_use]
    pub fn wrapped(self) -> Self {
        Self(math::wrap_signed(self.0))
    }

    /// The same direction in [0, 2π).
    #[must_use]
    pub fn wrapped_positive(self) -> Self {
        Self(math::wrap_positive(self.0))
    }
}

impl Area {
    /// The side of the square of this area; NaN if the area is negative.
    pub fn sqrt(self) -> Length {
        Length(self.0.sqrt())
    }
}

impl Force {
    /// The torque of this force at the end of a lever at right angles to it.
    pub const fn torque(self, lever: Length) -> Torque {
        Torque(self.0 * lever.0)
    }
}

impl Time {
    /// How often per second a thing happens that happens once in this time.
    pub const fn frequency(self) -> super::Frequency {
        super::Frequency::si(1.0 / self.0)
    }
}

/// A span of the wall clock as a span of time.
impl From<Duration> for Time {
    fn from(duration: Duration) -> Self {
        Self(duration.as_secs_f64())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_is_that_of_numbers() {
        let (a, b) = (Speed::si(3.0), Speed::si(-1.0));
        assert_eq!(a + b, Speed::si(2.0));
        assert_eq!(a - b, Speed::si(4.0));
        assert_eq!(-a, a * -1.0);
        assert_eq!(2.0 * a / 2.0, a);
        assert_eq!(a / b, -3.0);
        assert_eq!(b.abs(), Speed::si(1.0));
        assert_eq!([a, b].iter().sum::<Speed>(), a + b);
        assert_eq!([a, b].into_iter().sum::<Speed>(), a + b);
        let mut c = a;
        c += b;
        c -= a;
        c *= 4.0;
        c /= 2.0;
        assert_eq!(c, Speed::si(-2.0));
        assert_eq!(Speed::default(), Speed::ZERO);
    }

    #[test]
    fn bounds_hold_even_in_the_wrong_order() {
        let (low, high) = (Speed::ZERO, Speed::si(2.0));
        assert_eq!(Speed::si(3.0).clamp(low, high), high);
        assert_eq!(Speed::si(-3.0).clamp(low, high), low);
        assert_eq!(Speed::si(1.0).clamp(high, low), low);
        assert_eq!(low.min(high), low);
        assert_eq!(low.max(high), high);
        assert!(Speed::si(f64::NAN).max(low).get().is_nan());
        let mut speeds = [high, Speed::si(f64::NAN), low];
        speeds.sort_by(Speed::total_cmp);
        assert_eq!(speeds[..2], [low, high]);
    }

    #[test]
    fn units_are_worth_what_they_should() {
        assert_eq!(Speed::from_kilometres_per_hour(36.0), Speed::si(10.0));
        assert_eq!(Angle::from_degrees(180.0), Angle::HALF_TURN);
        assert_eq!(Angle::from_turns(1.0), Angle::TURN);
        assert!((AngularRate::from_rpm(60.0) * Time::si(1.0) / Angle::TURN - 1.0).abs() < 1e-15);
        assert_eq!(Mass::from_grams(128.0).kilograms(), 0.128);
        assert_eq!(Time::from_hours(1.0), Time::from_minutes(60.0));
        assert_eq!(
            Time::from(Duration::from_millis(100)),
            Time::from_millis(100.0)
        );
        assert_eq!("1 h".parse(), Ok(Time::si(3600.0)));
        assert_eq!("-3 g".parse(), Ok(Acceleration::si(-3.0 * 9.80665)));
        assert_eq!("500 mg".parse(), Ok(Acceleration::si(0.5 * 9.80665)));
        assert_eq!("100 ms".parse(), Ok(Time::si(0.1)));
    }

    #[test]
    fn angles_have_their_functions() {
        assert_eq!(
            Angle::atan2(Length::si(2.0), Length::ZERO),
            Angle::QUARTER_TURN
        );
        assert!((Angle::from_degrees(30.0).sin() - 0.5).abs() < 1e-15);
        assert!((Angle::from_degrees(60.0).cos() - 0.5).abs() < 1e-15);
        assert!((Angle::from_degrees(45.0).tan() - 1.0).abs() < 1e-15);
        assert!((Angle::from_degrees(-450.0).wrapped().degrees() + 90.0).abs() < 1e-12);
        assert!((Angle::from_degrees(-450.0).wrapped_positive().degrees() - 270.0).abs() < 1e-12);
    }
}
