//! The state of the air.

use super::Scale;
use super::define::{linear_quantity, quantity};

linear_quantity! {
    /// A temperature, inside in kelvins above absolute zero.
    ///
    /// A difference of two temperatures is in kelvins too; [`Temperature::celsius`] of a difference
    /// has no meaning.
    Temperature = "a temperature" {
        "K": Scale::ONE => from_kelvins, kelvins;
        "degC": Scale::shifted(273.15) => from_celsius, celsius;
    }
}

linear_quantity! {
    /// A pressure, inside in pascals.
    Pressure = "a pressure" {
        "Pa": Scale::ONE => from_pascals, pascals;
        "hPa": Scale::times(1e2) => from_hectopascals, hectopascals;
        "kPa": Scale::times(1e3);
    }
}

linear_quantity! {
    /// A mass per volume, inside in kilograms per cubic metre.
    Density = "a density" {
        "kg/m^3": Scale::ONE => from_kilograms_per_cubic_metre, kilograms_per_cubic_metre;
        "g/cm^3": Scale::times(1e3);
    }
}
