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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{NoParams, assert_normal, bee, run, with_sensor_of};
    use simbeeotic_model::units::{Angle, Attitude, Time, Yaw};
    use simbeeotic_model::{Bee, Behavior, Handle, Kit, behavior};

    /// Holds a position sensor with an error of 0.2 m against the truth.
    #[behavior("test-position")]
    struct Surveyor {
        position: Handle<Position>,
    }

    impl Behavior for Surveyor {
        type Params = NoParams;

        fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            kit.once(Time::from_secs(1.0), Self::compare);
            Ok(Self {
                position: kit.sensor("position")?,
            })
        }
    }

    impl Surveyor {
        fn compare(&mut self, bee: &mut Bee<'_>) {
            for yaw in [0.0, 120.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                let readings: Vec<[f64; 3]> = (0..10_000)
                    .map(|_| bee.read(self.position).si().to_array())
                    .collect();
                for (axis, truth) in bee.position().si().to_array().into_iter().enumerate() {
                    let along: Vec<f64> = readings.iter().map(|reading| reading[axis]).collect();
                    assert_normal(&along, truth, 0.2);
                }
                // The errors along the axes know nothing of each other.
                let centre = bee.position().si();
                let product: f64 = readings
                    .iter()
                    .map(|[x, y, _]| (x - centre.x) * (y - centre.y))
                    .sum();
                assert!((product / 1e4).abs() < 4.0 * 0.2 * 0.2 / 100.0, "{product}");
            }
        }
    }

    #[test]
    fn it_reads_the_truth_with_the_error_it_says_on_each_axis() {
        let plan = bee("bee", "test-position", &[], [3.0, -4.0, 10.0]);
        let plan = with_sensor_of(plan, "position", "position", &[("sigma", "0.2 m")]);
        let outcome = run(vec![plan], 2).run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
    }

    #[test]
    fn a_negative_error_is_refused() {
        for sigma in [-0.5, f64::NAN].map(Length::si) {
            let built = PositionSensor::build(PositionSensorParams { sigma });
            assert!(built.is_err(), "{sigma}");
        }
    }
}
