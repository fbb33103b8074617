//! A position sensor with Gaussian error.

use glam::DVec3;
use simbeeotic_model::check::at_least_zero;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Length, Position};
use simbeeotic_model::{BuildError, Sensor, Truth, params, sensor};

/// Measures its own position in the world: the truth plus an independent normal error on each
/// axis.
#[sensor(
    "position",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultPositionSensor"
)]
pub struct PositionSensor {
    sigma: Length,
}

/// Parameters of [`PositionSensor`].
#[params]
pub struct PositionSensorParams {
    /// Standard deviation on each axis.
    pub sigma: Length,
}

impl Default for PositionSensorParams {
    fn default() -> Self {
        Self {
            sigma: Length::si(0.5),
        }
    }
}

impl Sensor for PositionSensor {
    type Params = PositionSensorParams;
    type Reading = Position;

    fn build(params: PositionSensorParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        Ok(Self {
            sigma: params.sigma,
        })
    }

    fn read(&mut self, truth: &Truth<'_>, rng: &mut Stream) -> Position {
        let error = DVec3::new(rng.normal(), rng.normal(), rng.normal());
        truth.sensor_pose().position + Position::from_si(error * self.sigma.metres())
    }
}
