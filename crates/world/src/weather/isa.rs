//! The International Standard Atmosphere (ISO 2533:1975), and altitude from pressure.
//!
//! In its lowest layer, up to 11 km, the temperature falls by 6.5 K a kilometre:
//!
//! ```text
//! T = T0 - L h                                    (1)    L = 0.0065 K/m
//! p = p0 (T / T0)^(g / (R L))                     (2)    g / (R L) = 5.25588
//! rho = p / (R T)                                 (3)    R = 287.05287 J/(kg K)
//! ```
//! Above, to 20 km, the temperature stays and the pressure falls as `exp(-g (h - 11 km) / (R T))`. At
//! sea level `T0` is 288.15 K and `p0` 101325 Pa on a standard day; other days have others (`p0` is
//! then the QNH).
//!
//! Damp air is lighter than dry air of the same pressure, by the vapour in it:
//!
//! ```text
//! e_s = 610.94 Pa exp(17.625 (T - 273.15 K) / (T - 30.11 K))                       (4)
//! rho = (p - phi e_s) / (R T) + phi e_s / (R_v T)                                  (5)
//! ```
//! with the relative humidity `phi` and R_v = 461.495 J/(kg K). Equation 4 is August, Roche and
//! Magnus' formula with the coefficients of O. Alduchov and R. Eskridge, J. Appl. Meteor. 35, 601
//! (1996), eq. 21: within 0.4 % between -40 and 50 degrees Celsius.

use simbeeotic_units::{Density, Length, Pressure, Temperature, math};

/// Temperature at sea level on a standard day.
pub const TEMPERATURE: Temperature = Temperature::si(288.15);
/// Pressure at sea level on a standard day.
pub const PRESSURE: Pressure = Pressure::si(101_325.0);

const GAS_CONSTANT: f64 = 287.052_87; // J/(kg K), dry air
const VAPOUR_CONSTANT: f64 = 461.495; // J/(kg K), water
const GRAVITY: f64 = 9.806_65; // m/s^2
const LAPSE_K_PER_M: f64 = 0.006_5;
const TROPOPAUSE_M: f64 = 11_000.0;

/// Temperature and pressure at a height above sea level, on a day with these at sea level: equations
/// 1 and 2. Held below -2 km and above 20 km, where the standard's next layers are not ours.
pub fn air(height: Length, sea_level: Temperature, pressure: Pressure) -> (Temperature, Pressure) {
    let h = height.get().clamp(-2_000.0, 20_000.0);
    let low = h.min(TROPOPAUSE_M);
    let temperature = sea_level.get() - LAPSE_K_PER_M * low;
    let exponent = GRAVITY / (GAS_CONSTANT * LAPSE_K_PER_M);
    let pressure = pressure.get() * math::pow(temperature / sea_level.get(), exponent);
    let above = h - low;
    (
        Temperature::si(temperature),
        Pressure::si(pressure * math::exp(-GRAVITY * above / (GAS_CONSTANT * temperature))),
    )
}

/// The density of dry air: equation 3.
pub fn density(temperature: Temperature, pressure: Pressure) -> Density {
    Density::si(pressure.get() / (GAS_CONSTANT * temperature.get()))
}

/// The density of air of a relative humidity, 0 to 1: equation 5.
pub fn damp_density(temperature: Temperature, pressure: Pressure, humidity: f64) -> Density {
    let vapour = humidity * vapour_pressure(temperature).get();
    let t = temperature.get();
    Density::si((pressure.get() - vapour) / (GAS_CONSTANT * t) + vapour / (VAPOUR_CONSTANT * t))
}

/// The pressure of saturated water vapour: equation 4.
pub fn vapour_pressure(temperature: Temperature) -> Pressure {
    let celsius = temperature.get() - 273.15;
    Pressure::si(610.94 * math::exp(17.625 * celsius / (celsius + 243.04)))
}

/// The height above sea level at which a standard day with this pressure at sea level (QNH) has
/// `pressure`: what an altimeter shows. Equation 2 the other way round, up to 11 km and as far beyond
/// as its logarithm goes.
pub fn altitude(pressure: Pressure, qnh: Pressure) -> Length {
    let exponent = GAS_CONSTANT * LAPSE_K_PER_M / GRAVITY;
    let share = math::pow(pressure / qnh, exponent);
    Length::si(TEMPERATURE.get() / LAPSE_K_PER_M * (1.0 - share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn altitude_is_the_inverse_of_pressure() {
        for qnh in [98_000.0, 101_325.0, 104_000.0].map(Pressure::si) {
            for h in [-100.0, 0.0, 1.0, 120.0, 3_000.0, 10_900.0].map(Length::si) {
                let (_, pressure) = air(h, TEMPERATURE, qnh);
                let back = altitude(pressure, qnh);
                assert!((back - h).get().abs() < 1e-8, "{h}: {back}");
            }
        }
        // 8.3 m a hectopascal near the ground.
        let step = altitude(Pressure::si(101_225.0), PRESSURE);
        assert!((step.get() - 8.33).abs() < 0.01, "{step}");
    }

    /// Steam tables: 611.2 Pa at 0, 2339 Pa at 20, 7384 Pa at 40 degrees Celsius.
    #[test]
    fn vapour_has_the_pressure_of_the_tables_and_makes_air_lighter() {
        for (celsius, pascal) in [(0.0, 611.2), (20.0, 2_339.0), (40.0, 7_384.0)] {
            let found = vapour_pressure(Temperature::from_celsius(celsius)).get();
            assert!((found / pascal - 1.0).abs() < 4e-3, "{celsius}: {found}");
        }
        let warm = Temperature::from_celsius(30.0);
        let dry = damp_density(warm, PRESSURE, 0.0);
        assert_eq!(dry, density(warm, PRESSURE));
        // Saturated at 30 degrees: 4245 Pa of vapour, 0.378 of it missing: 1.6 % lighter.
        let wet = damp_density(warm, PRESSURE, 1.0);
        assert!(
            (wet / dry - (1.0 - 0.378 * 4_245.0 / 101_325.0)).abs() < 2e-4,
            "{wet}"
        );
    }
}
