//! The same wind everywhere and always.

use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::units::{Enu, Position, Velocity};
use simbeeotic_model::world::Weather;
use simbeeotic_model::{BuildError, FromParams, params, weather};

/// The same wind everywhere and always, in the standard atmosphere.
#[weather(
    "constant-weather",
    java = "harvard.robobees.simbeeotic.model.weather.ConstantWeatherModel"
)]
#[derive(Debug)]
pub struct ConstantWeather {
    wind: Velocity<Enu>,
}

/// Parameters of [`ConstantWeather`].
#[params]
pub struct ConstantWeatherParams {
    /// Velocity of the air: east, north, up.
    pub wind: Velocity<Enu>,
}

impl Default for ConstantWeatherParams {
    fn default() -> Self {
        Self {
            wind: Velocity::ZERO,
        }
    }
}

impl FromParams for ConstantWeather {
    type Params = ConstantWeatherParams;

    fn from_params(params: ConstantWeatherParams) -> Result<Self, BuildError> {
        Ok(Self { wind: params.wind })
    }
}

impl Weather for ConstantWeather {
    fn wind(&self, _at: Position, _time: SimTime) -> Velocity<Enu> {
        self.wind
    }
}
