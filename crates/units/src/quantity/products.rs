//! The products of physics: which quantity times which is which.

use super::{
    Acceleration, Angle, AngularRate, Area, Charge, Current, DataRate, Energy, Force, Frequency,
    Impulse, Length, Mass, Power, Pressure, Resistance, Speed, Time, Torque, Voltage,
};
use std::ops::{Div, Mul};

/// One operator between two quantities, on their SI numbers.
macro_rules! operator {
    ($Trait:ident $method:ident, $A:ty, $B:ty => $C:ty, $op:tt) => {
        impl $Trait<$B> for $A {
            type Output = $C;
            #[inline]
            fn $method(self, other: $B) -> $C {
                <$C>::si(self.get() $op other.get())
            }
        }
    };
}

/// `product!(A * B = C)` gives `A * B`, `B * A`, `C / A` and `C / B`.
macro_rules! product {
    ($A:ident * $B:ident = $C:ident) => {
        operator!(Mul mul, $A, $B => $C, *);
        operator!(Mul mul, $B, $A => $C, *);
        operator!(Div div, $C, $A => $B, /);
        operator!(Div div, $C, $B => $A, /);
    };
}

product!(Speed * Time = Length);
product!(Acceleration * Time = Speed);
product!(AngularRate * Time = Angle);
product!(Mass * Acceleration = Force);
product!(Force * Time = Impulse);
product!(Mass * Speed = Impulse);
product!(Force * Length = Energy);
product!(Force * Speed = Power);
product!(Torque * AngularRate = Power);
product!(Power * Time = Energy);
product!(Current * Time = Charge);
product!(Voltage * Current = Power);
product!(Voltage * Charge = Energy);
product!(Resistance * Current = Voltage);
product!(Pressure * Area = Force);
// Wavelength times frequency is the speed of the wave.
product!(Length * Frequency = Speed);

operator!(Mul mul, Length, Length => Area, *);
operator!(Div div, Area, Length => Length, /);

/// `inverse!(A * B)`: the product is a bare number, so that a number divided by one is the other.
macro_rules! inverse {
    ($A:ident * $B:ident) => {
        inverse!(@one $A * $B);
        inverse!(@one $B * $A);
    };
    (@one $A:ident * $B:ident) => {
        impl Mul<$B> for $A {
            type Output = f64;
            #[inline]
            fn mul(self, other: $B) -> f64 {
                self.get() * other.get()
            }
        }

        impl Div<$A> for f64 {
            type Output = $B;
            #[inline]
            fn div(self, divisor: $A) -> $B {
                <$B>::si(self / divisor.get())
            }
        }
    };
}

inverse!(Frequency * Time);

/// A number of bits.
impl Mul<Time> for DataRate {
    type Output = f64;
    #[inline]
    fn mul(self, time: Time) -> f64 {
        self.get() * time.get()
    }
}

/// The time that a number of bits takes.
impl Div<DataRate> for f64 {
    type Output = Time;
    #[inline]
    fn div(self, rate: DataRate) -> Time {
        Time::si(self / rate.get())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::constants::SPEED_OF_LIGHT;

    #[test]
    fn products_are_those_of_physics() {
        let way: Length = Speed::si(3.0) * Time::si(2.0);
        assert_eq!(way, Length::si(6.0));
        let speed: Speed = way / Time::si(2.0);
        assert_eq!(speed, Speed::si(3.0));
        let time: Time = way / speed;
        assert_eq!(time, Time::si(2.0));
        let weight: Force = Mass::from_grams(100.0) * Acceleration::si(9.8);
        assert!((weight.newtons() - 0.98).abs() < 1e-15);
        let work: Energy = weight * way;
        let push: Impulse = weight * time;
        let gained: Speed = push / Mass::from_grams(100.0);
        assert!((gained / (Acceleration::si(9.8) * time) - 1.0).abs() < 1e-15);
        let power: Power = work / time;
        assert!((power / (weight * speed) - 1.0).abs() < 1e-15);
        let area: Area = way * way;
        assert_eq!((area, area / way, area.sqrt()), (Area::si(36.0), way, way));
        assert_eq!(Force::si(2.0).torque(Length::si(3.0)), Torque::si(6.0));
        assert_eq!(Angle::TURN / Time::si(2.0) * Time::si(2.0), Angle::TURN);
    }

    #[test]
    fn a_battery_is_charge_times_voltage() {
        let charge = Current::from_milliamperes(500.0) * Time::from_hours(1.0);
        assert_eq!(charge, Charge::from_milliampere_hours(500.0));
        let energy: Energy = charge * Voltage::si(3.7);
        assert!((energy.watt_hours() - 1.85).abs() < 1e-12);
        let lasts: Time = charge / Current::si(0.25);
        assert_eq!(lasts, Time::from_hours(2.0));
    }

    #[test]
    fn a_wave_of_a_frequency_has_a_length() {
        let wavelength: Length = SPEED_OF_LIGHT / Frequency::from_megahertz(2450.0);
        assert!((wavelength.metres() - 0.122_364_268_6).abs() < 1e-9);
    }

    #[test]
    fn period_and_frequency_are_inverse() {
        let rate = Frequency::si(4.0);
        let period: Time = 1.0 / rate;
        assert_eq!(period, Time::from_millis(250.0));
        assert_eq!((rate.period(), period.frequency()), (period, rate));
        assert_eq!(1.0 / period, rate);
        let count: f64 = rate * Time::si(3.0);
        assert_eq!(count, 12.0);
    }

    #[test]
    fn bytes_take_time_to_send() {
        let rate = DataRate::from_kilobits_per_second(250.0);
        assert_eq!(rate.airtime(125), Time::from_millis(4.0));
        assert_eq!(1000.0 / rate, Time::from_millis(4.0));
        assert_eq!(rate * Time::si(1.0), 250_000.0);
    }

    #[test]
    fn noise_on_a_parameter_needs_no_conversion() {
        let (heading_sigma, gauss) = (Angle::from_degrees(10.0), -0.5);
        let turn = heading_sigma * gauss;
        assert!((turn.degrees() + 5.0).abs() < 1e-12);
        assert_eq!(gauss * heading_sigma, turn);
    }
}
