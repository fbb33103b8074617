//! Temperature, pressure and humidity of a day that is not the standard one.
//!
//! The formulas are those of [`simbeeotic_model::world::weather::isa`]: temperature and pressure at sea
//! level shift the whole atmosphere.

use simbeeotic_model::check::in_range;
use simbeeotic_model::units::{Length, Pressure, Temperature};
use simbeeotic_model::world::weather::isa;
use simbeeotic_model::{BuildError, params};

/// The state of the air.
#[params]
pub struct AirParams {
    /// Temperature at sea level, -60 to 60 degrees Celsius.
    pub temperature: Temperature,
    /// Pressure at sea level: QNH, 850 to 1100 hPa.
    pub pressure: Pressure,
    /// Relative humidity, 0 to 1, at all heights. Damp air is lighter.
    pub humidity: f64,
    /// Height of the plane `z = 0` above sea level, -500 m to 9 km.
    pub elevation: Length,
}

impl Default for AirParams {
    fn default() -> Self {
        Self {
            temperature: isa::TEMPERATURE,
            pressure: isa::PRESSURE,
            humidity: 0.0,
            elevation: Length::ZERO,
        }
    }
}

impl AirParams {
    pub(super) fn check(&self) -> Result<(), BuildError> {
        let celsius = Temperature::from_celsius;
        in_range(
            "temperature",
            self.temperature,
            celsius(-60.0)..=celsius(60.0),
        )
        .and(in_range(
            "pressure",
            self.pressure,
            Pressure::si(85_000.0)..=Pressure::si(110_000.0),
        ))
        .and(in_range("humidity", self.humidity, 0.0..=1.0))
        .and(in_range(
            "elevation",
            self.elevation,
            Length::si(-500.0)..=Length::si(9_000.0),
        ))
        .map_err(|fault| BuildError::parameter("air", format!("is no air: {fault}")))
    }

    /// Temperature and pressure at a height above the plane `z = 0`.
    pub(super) fn at(&self, up: Length) -> (Temperature, Pressure) {
        isa::air(up + self.elevation, self.temperature, self.pressure)
    }
}
