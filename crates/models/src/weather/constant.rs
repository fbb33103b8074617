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

    fn is_calm(&self) -> bool {
        self.wind == Velocity::ZERO
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wind_is_the_same_everywhere_and_always() {
        let wind = Velocity::from_xyz(3.0, -1.0, 0.5);
        let weather = ConstantWeather::from_params(ConstantWeatherParams { wind }).expect("good");
        for (place, seconds) in [([0.0, 0.0, 0.0], 0), ([1e4, -1e4, 500.0], 86_400)] {
            let at = Position::from_xyz(place[0], place[1], place[2]);
            assert_eq!(weather.wind(at, SimTime::from_secs(seconds)), wind);
        }
    }

    #[test]
    fn the_air_is_still_unless_said_otherwise_and_that_of_the_standard_atmosphere() {
        let weather = ConstantWeather::from_params(ConstantWeatherParams::default()).expect("good");
        let (here, now) = (Position::ZERO, SimTime::ZERO);
        assert_eq!(weather.wind(here, now), Velocity::ZERO);
        assert!(weather.is_calm());
        let density = weather.density(here, now).kilograms_per_cubic_metre();
        assert!((density - 1.225).abs() < 1e-4, "{density} kg/m^3");
    }
}
