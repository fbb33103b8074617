//! The air: wind, temperature, pressure, density, humidity, light and rain, everywhere and at any
//! time.
//!
//! Without weather the air is that of the International Standard Atmosphere (ISO 2533:1975), at
//! rest. In its lowest layer, up to 11 km, the temperature falls by 6.5 K a kilometre:
//!
//! ```text
//! T = T0 - L h                                    (1)    T0 = 288.15 K, L = 0.0065 K/m
//! p = p0 (T / T0)^(g / (R L))                     (2)    p0 = 101325 Pa, g / (R L) = 5.25588
//! rho = p / (R T)                                 (3)    R = 287.05287 J/(kg K)
//! ```
//! Above, to 20 km, the temperature stays and the pressure falls as `exp(-g (h - 11 km) / (R T))`.

pub mod rain;

use simbeeotic_kernel::SimTime;
use simbeeotic_units::{
    Density, Enu, Illuminance, Position, Pressure, RainRate, Temperature, Velocity, math,
};
use std::fmt::Debug;

/// The air as a field over space and time. Pure: the same place and time give the same air.
pub trait Weather: Debug + Send + Sync {
    /// The velocity of the air.
    fn wind(&self, at: Position, time: SimTime) -> Velocity<Enu>;

    /// The temperature of the air; equation 1 unless the weather says otherwise.
    fn temperature(&self, at: Position, _time: SimTime) -> Temperature {
        Temperature::si(isa(at.up().get()).0)
    }

    /// The pressure of the air; equation 2 unless the weather says otherwise.
    fn pressure(&self, at: Position, _time: SimTime) -> Pressure {
        Pressure::si(isa(at.up().get()).1)
    }

    /// The density of the air; equation 3 with this weather's temperature and pressure.
    fn density(&self, at: Position, time: SimTime) -> Density {
        let temperature = self.temperature(at, time).get();
        Density::si(self.pressure(at, time).get() / (GAS_CONSTANT * temperature))
    }

    /// Relative humidity of the air, 0 to 1; dry unless the weather says otherwise.
    fn humidity(&self, _at: Position, _time: SimTime) -> f64 {
        0.0
    }

    /// Light of the sky on level ground, from all sides; dark unless the weather says otherwise.
    fn light(&self, _at: Position, _time: SimTime) -> Illuminance {
        Illuminance::ZERO
    }

    /// Rain; dry unless the weather says otherwise. What it does to sensors is in [`rain`].
    fn rain(&self, _at: Position, _time: SimTime) -> RainRate {
        RainRate::ZERO
    }
}

/// No wind, standard atmosphere.
#[derive(Clone, Copy, Debug, Default)]
pub struct Calm;

impl Weather for Calm {
    fn wind(&self, _at: Position, _time: SimTime) -> Velocity<Enu> {
        Velocity::ZERO
    }
}

const GAS_CONSTANT: f64 = 287.052_87; // J/(kg K), dry air
const GRAVITY: f64 = 9.806_65; // m/s^2
const SEA_LEVEL_K: f64 = 288.15;
const SEA_LEVEL_PA: f64 = 101_325.0;
const LAPSE_K_PER_M: f64 = 0.006_5;
const TROPOPAUSE_M: f64 = 11_000.0;

/// Temperature in kelvin and pressure in pascal at a height above sea level; held below -2 km and
/// above 20 km, where the standard's next layers are not ours.
fn isa(height_m: f64) -> (f64, f64) {
    let h = height_m.clamp(-2_000.0, 20_000.0);
    let low = h.min(TROPOPAUSE_M);
    let temperature = SEA_LEVEL_K - LAPSE_K_PER_M * low;
    let exponent = GRAVITY / (GAS_CONSTANT * LAPSE_K_PER_M);
    let pressure = SEA_LEVEL_PA * math::pow(temperature / SEA_LEVEL_K, exponent);
    let above = h - low;
    (
        temperature,
        pressure * math::exp(-GRAVITY * above / (GAS_CONSTANT * temperature)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::Length;

    /// Rows of ISO 2533, table 1: height, temperature, pressure, density.
    #[test]
    fn the_standard_atmosphere_is_that_of_the_tables() {
        let rows = [
            (0.0, 288.15, 101_325.0, 1.225),
            (1_000.0, 281.65, 89_874.6, 1.111_64),
            (5_000.0, 255.65, 54_019.9, 0.736_116),
            (11_000.0, 216.65, 22_632.1, 0.363_918),
            (15_000.0, 216.65, 12_044.6, 0.193_674),
        ];
        for (h, kelvin, pascal, density) in rows {
            let at = Position::new(Length::ZERO, Length::ZERO, Length::si(h));
            let time = SimTime::ZERO;
            assert!(
                (Calm.temperature(at, time).get() - kelvin).abs() < 1e-9,
                "{h}"
            );
            assert!(
                (Calm.pressure(at, time).get() / pascal - 1.0).abs() < 1e-5,
                "{h}"
            );
            assert!(
                (Calm.density(at, time).get() / density - 1.0).abs() < 1e-5,
                "{h}"
            );
        }
    }
}
