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

    fn ideal(&mut self, truth: &Truth<'_>) -> Heading {
        truth.sensor_pose().attitude.heading()
    }

    fn measure(&mut self, ideal: Heading, _truth: &Truth<'_>, rng: &mut Stream) -> Heading {
        Heading::new(ideal.angle() + self.sigma * rng.normal())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{NoParams, assert_normal, bee, run, with_sensor_of};
    use simbeeotic_model::units::{Attitude, Time, Yaw};
    use simbeeotic_model::{Bee, Behavior, Handle, Kit, behavior};

    /// Holds a compass with an error of one degree against the truth.
    #[behavior("test-compass")]
    struct Navigator {
        compass: Handle<Heading>,
    }

    impl Behavior for Navigator {
        type Params = NoParams;

        fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            kit.once(Time::from_secs(1.0), Self::compare);
            Ok(Self {
                compass: kit.sensor("compass")?,
            })
        }
    }

    impl Navigator {
        fn compare(&mut self, bee: &mut Bee<'_>) {
            let degrees = Angle::from_degrees;
            // Yaw is counter-clockwise from east. The second bee is tilted, which is no turn.
            let level = Attitude::from_yaw(Yaw::new(degrees(30.0)));
            let tilted =
                Attitude::from_rpy(degrees(20.0), degrees(-10.0), Yaw::new(degrees(200.0)));
            for (attitude, heading) in [(level, 60.0), (tilted, 250.0)] {
                bee.set_attitude(attitude);
                let readings: Vec<f64> = (0..10_000)
                    .map(|_| bee.read(self.compass).angle().degrees())
                    .collect();
                assert_normal(&readings, heading, 1.0);
            }
        }
    }

    #[test]
    fn it_reads_clockwise_from_north_with_the_error_it_says() {
        let plan = bee("bee", "test-compass", &[], [0.0, 0.0, 10.0]);
        let plan = with_sensor_of(plan, "compass", "compass", &[("sigma", "1 deg")]);
        let outcome = run(vec![plan], 2).run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
    }

    #[test]
    fn a_negative_error_is_refused() {
        for sigma in [-1.0, f64::NAN] {
            let sigma = Angle::from_degrees(sigma);
            assert!(Compass::build(CompassParams { sigma }).is_err(), "{sigma}");
        }
    }
}
