//! The products of physics: which quantity times which is which.

use super::{
    Acceleration, Angle, AngularRate, Area, Charge, Current, DataRate, Energy, Force, Frequency,
    Length, Mass, Power, Pressure, Speed, Time, Torque, Voltage,
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
product!(Force * Length = Energy);
product!(Force * Speed = Power);
product!(Torque * AngularRate = Power);
product!(Power * Time = Energy);
product!(Current * Time = Charge);
product!(Voltage * Current = Power);
product!(Voltage * Charge = Energy);
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
