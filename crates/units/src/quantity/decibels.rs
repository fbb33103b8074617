//! Logarithmic quantities: ratios in dB, powers in dBm.
//!
//! A level and a ratio are different things, as a point and a step are. `PowerLevel + Decibels` is
//! a level, `PowerLevel - PowerLevel` is a ratio in decibels, and `PowerLevel + PowerLevel` does
//! not compile: to add powers, add them in watts.
//!
//! ```compile_fail
//! # use simbeeotic_units::PowerLevel;
//! let sum = PowerLevel::from_dbm(0.0) + PowerLevel::from_dbm(3.0);
//! ```

use super::define::{linear_quantity, quantity};
use super::{Power, Scale};
use crate::math;
use std::ops::{Add, AddAssign, Sub, SubAssign};

linear_quantity! {
    /// The ratio of two powers in decibels: `10 log10(ratio)`.
    ///
    /// Gains and losses are both positive numbers of decibels, in opposite directions; names say
    /// which.
    Decibels = "a ratio" {
        "dB": Scale::ONE => from_db, db;
    }
}

quantity! {
    /// A power relative to one milliwatt, in dBm: `10 log10(P / 1 mW)`.
    ///
    /// The default is 0 dBm, one milliwatt; no power at all is minus infinity.
    PowerLevel = "a power level" {
        "dBm": Scale::ONE => from_dbm, dbm;
        "dBW": Scale::shifted(30.0);
    }
}

impl Decibels {
    /// The ratio of the powers: 3 dB is about 2, 10 dB is 10.
    pub fn ratio(self) -> f64 {
        math::pow(10.0, self.get() / 10.0)
    }

    /// From a ratio of powers; minus infinity for 0, NaN for a negative ratio.
    pub fn from_ratio(ratio: f64) -> Self {
        Self::si(10.0 * math::log10(ratio))
    }
}

impl PowerLevel {
    /// The power itself.
    pub fn to_power(self) -> Power {
        Power::from_milliwatts(self.milliwatts())
    }

    /// The level of a power; minus infinity dBm for no power, NaN for a negative one.
    pub fn from_power(power: Power) -> Self {
        Self::from_milliwatts(power.milliwatts())
    }

    /// The power as a number of milliwatts.
    pub fn milliwatts(self) -> f64 {
        math::pow(10.0, self.get() / 10.0)
    }

    /// The level of a number of milliwatts; see [`PowerLevel::from_power`].
    pub fn from_milliwatts(milliwatts: f64) -> Self {
        Self::si(10.0 * math::log10(milliwatts))
    }
}

impl Add<Decibels> for PowerLevel {
    type Output = Self;
    #[inline]
    fn add(self, gain: Decibels) -> Self {
        Self(self.0 + gain.get())
    }
}

impl Sub<Decibels> for PowerLevel {
    type Output = Self;
    #[inline]
    fn sub(self, loss: Decibels) -> Self {
        Self(self.0 - loss.get())
    }
}

/// How far one level lies above the other.
impl Sub for PowerLevel {
    type Output = Decibels;
    #[inline]
    fn sub(self, other: Self) -> Decibels {
        Decibels::si(self.0 - other.0)
    }
}

impl AddAssign<Decibels> for PowerLevel {
    #[inline]
    fn add_assign(&mut self, gain: Decibels) {
        self.0 += gain.get();
    }
}

impl SubAssign<Decibels> for PowerLevel {
    #[inline]
    fn sub_assign(&mut self, loss: Decibels) {
        self.0 -= loss.get();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_and_ratios_combine() {
        let sent = PowerLevel::from_dbm(0.0);
        let received = sent - Decibels::si(60.0) + Decibels::si(2.0);
        assert_eq!(received, PowerLevel::from_dbm(-58.0));
        assert_eq!(received - sent, Decibels::si(-58.0));
        let mut level = received;
        level += Decibels::si(3.0);
        level -= Decibels::si(1.0);
        assert_eq!(level, PowerLevel::from_dbm(-56.0));
    }

    #[test]
    fn a_level_is_a_power() {
        assert_eq!(
            PowerLevel::from_dbm(0.0).to_power(),
            Power::from_milliwatts(1.0)
        );
        assert_eq!(PowerLevel::from_dbm(30.0).to_power(), Power::si(1.0));
        assert_eq!(
            PowerLevel::from_power(Power::si(0.1)),
            PowerLevel::from_dbm(20.0)
        );
        assert_eq!(PowerLevel::from_power(Power::ZERO).dbm(), f64::NEG_INFINITY);
        assert_eq!("0 dBW".parse(), Ok(PowerLevel::from_dbm(30.0)));
        assert_eq!("-100 dBm".parse(), Ok(PowerLevel::from_dbm(-100.0)));
    }

    #[test]
    fn ten_decibels_are_a_factor_of_ten() {
        assert_eq!(Decibels::si(10.0).ratio(), 10.0);
        assert_eq!(Decibels::from_ratio(0.01), Decibels::si(-20.0));
        assert!((Decibels::si(3.0).ratio() - 1.995_262_3).abs() < 1e-7);
    }
}
