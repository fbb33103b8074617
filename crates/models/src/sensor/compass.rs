//! A compass with Gaussian error.

use simbeeotic_model::check::at_least_zero;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Heading};
use simbeeotic_model::{BuildError, Sensor, Truth, params, sensor};

/// Measures the heading of its own forward axis: clockwise from north, in [0, 360) degrees.
///
/// The reading is the truth plus a normal error. Pointing straight up or down has no heading; the
/// reading is then that of an axis infinitely close by.
#[sensor(
    "compass",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultCompass"
)]
pub struct Compass {
    sigma: Angle,
}

/// Parameters of [`Compass`].
#[params]
pub struct CompassParams {
    /// Standard deviation of a reading.
    pub sigma: Angle,
}

impl Default for CompassParams {
    fn default() -> Self {
        Self {
            sigma: Angle::si(0.0016_f64.to_radians()),
        }
    }
}

impl Sensor for Compass {
    type Params = CompassParams;
    type Reading = Heading;

    fn build(params: CompassParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        Ok(Self {
            sigma: params.sigma,
        })
    }

    fn read(&mut self, truth: &Truth<'_>, rng: &mut Stream) -> Heading {
        let heading = truth.sensor_pose().attitude.heading();
        Heading::new(heading.angle() + self.sigma * rng.normal())
    }
}
