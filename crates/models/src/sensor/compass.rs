//! A compass with Gaussian error.

use super::bounds::at_least_zero;
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Heading};
use simbeeotic_model::{BuildError, Sensor, Truth, params, sensor};

/// Measures the heading of its own forward axis: clockwise from north, in [0, 360) degrees.
///
/// The reading is the truth less the `declination`, plus biases and a normal error. Pointing straight up or
/// down has no heading; the reading is then that of an axis infinitely close by. What `sigma` is without
/// other words, 0.0016 degrees, is the original's; no magnetic compass is as good as a degree.
#[sensor(
    "compass",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultCompass"
)]
pub struct Compass {
    params: CompassParams,
    /// The bias that it has drawn.
    bias: Option<Angle>,
}

/// Parameters of [`Compass`].
#[params]
pub struct CompassParams {
    /// Standard deviation of a reading. 0 or more.
    pub sigma: Angle,
    /// A constant error that is known, clockwise.
    pub bias: Angle,
    /// Standard deviation of the constant error that each compass draws once. 0 or more.
    pub bias_sigma: Angle,
    /// How far east of true north the needle points: readings are that much less. 0 reads true headings.
    pub declination: Angle,
}

impl Default for CompassParams {
    fn default() -> Self {
        Self {
            sigma: Angle::si(0.0016_f64.to_radians()),
            bias: Angle::ZERO,
            bias_sigma: Angle::ZERO,
            declination: Angle::ZERO,
        }
    }
}

impl Sensor for Compass {
    type Params = CompassParams;
    type Reading = Heading;

    fn build(params: CompassParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        at_least_zero("bias_sigma", params.bias_sigma)?;
        for (key, angle) in [("bias", params.bias), ("declination", params.declination)] {
            in_range(key, angle, -Angle::HALF_TURN..=Angle::HALF_TURN)?;
        }
        Ok(Self { params, bias: None })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Heading {
        let heading = truth.sensor_pose().attitude.heading();
        if self.params.declination == Angle::ZERO {
            return heading;
        }
        Heading::new(heading.angle() - self.params.declination)
    }

    fn measure(&mut self, ideal: Heading, _truth: &Truth<'_>, rng: &mut Stream) -> Heading {
        Heading::new(ideal.angle() + self.bias(rng) + self.params.sigma * rng.normal())
    }
}

impl Compass {
    /// Its own bias, drawn at the first reading.
    fn bias(&mut self, rng: &mut Stream) -> Angle {
        let p = &self.params;
        *self.bias.get_or_insert_with(|| match p.bias_sigma {
            Angle::ZERO => p.bias,
            sigma => p.bias + sigma * rng.normal(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{NoParams, Trial, assert_normal, bee, refusal, run, with_sensor_of};
    use simbeeotic_model::units::{Attitude, Time, Velocity, Yaw};
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
                bee.set_velocity(Velocity::from_xyz(3.0, -2.0, 0.5));
                let readings: Vec<f64> = (0..100_000)
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
            let params = CompassParams {
                sigma: Angle::from_degrees(sigma),
                ..CompassParams::default()
            };
            assert!(Compass::build(params).is_err(), "{sigma}");
        }
        for (key, text) in [
            ("bias_sigma", "-1 deg"),
            ("bias", "181 deg"),
            ("declination", "-181 deg"),
        ] {
            let refusal = refusal("compass", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }

    #[test]
    fn east_of_true_north_the_needle_reads_less_and_a_bias_stays() {
        let params = [
            ("sigma", "0 deg"),
            ("declination", "10 deg"),
            ("bias", "3 deg"),
        ];
        Trial::of("compass", &params).run(|bee, sensor: Handle<Heading>| {
            for heading in [2.0, 120.0] {
                let heading = Heading::new(Angle::from_degrees(heading));
                bee.set_attitude(Attitude::from_heading(heading));
                let off = bee.read(sensor).angle() - heading.angle();
                assert!((off.wrapped().degrees() + 7.0).abs() < 1e-9, "{off}");
            }
        });
        let params = [("sigma", "0 deg"), ("bias_sigma", "5 deg")];
        Trial::of("compass", &params).run(|bee, sensor: Handle<Heading>| {
            let first = bee.read(sensor);
            assert_ne!(first, bee.heading());
            assert_eq!(bee.read(sensor), first);
        });
    }

    #[test]
    fn the_biases_of_many_have_the_sigma_that_they_say() {
        let params = CompassParams {
            bias: Angle::si(0.2),
            bias_sigma: Angle::si(0.05),
            ..CompassParams::default()
        };
        let mut rng = Stream::new(2, "bee/compass", "noise");
        let biases: Vec<f64> = (0..100_000)
            .map(|_| {
                let mut compass = Compass::build(params.clone()).expect("good");
                compass.bias(&mut rng).get()
            })
            .collect();
        assert_normal(&biases, 0.2, 0.05);
    }
}
