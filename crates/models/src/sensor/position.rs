//! A position sensor with Gaussian error.

use super::bounds::at_least_zero;
use glam::DVec3;
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

    fn ideal(&mut self, truth: &Truth<'_>) -> Position {
        truth.sensor_pose().position
    }

    fn measure(&mut self, ideal: Position, _truth: &Truth<'_>, rng: &mut Stream) -> Position {
        let error = DVec3::new(rng.normal(), rng.normal(), rng.normal());
        ideal + Position::from_si(error * self.sigma.metres())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::units::Time;
    use simbeeotic_model::units::{Angle, Attitude, Mount, Offset, Yaw};
    use simbeeotic_model::{Handle, SamplePhase, Sampling};

    #[test]
    fn it_reads_the_truth_with_the_error_it_says_on_each_axis() {
        let mut trial = Trial::of("position", &[("sigma", "0.2 m")]);
        trial.at = [3.0, -4.0, 10.0];
        trial.run(|bee, sensor: Handle<Position>| {
            for yaw in [0.0, 120.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                let readings: Vec<[f64; 3]> = (0..100_000)
                    .map(|_| bee.read(sensor).si().to_array())
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
                assert!(
                    (product / 1e5).abs() < 4.0 * 0.2 * 0.2 / 1e5_f64.sqrt(),
                    "{product}"
                );
            }
        });
    }

    #[test]
    fn it_sits_where_its_mount_says_in_any_attitude() {
        let mut trial = Trial::of("position", &[("sigma", "0 m")]);
        trial.mount = Mount::new(Offset::from_xyz(0.1, 0.0, 0.0), Attitude::IDENTITY);
        trial.run(|bee, sensor: Handle<Position>| {
            for degrees in [0.0, 90.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(degrees))));
                let ahead = bee.attitude().forward() * 0.1;
                let read = bee.read(sensor).si() - bee.position().si();
                assert!((read - ahead).length() < 1e-12, "{read}");
            }
        });
    }

    #[test]
    fn with_a_rate_and_a_delay_it_tells_where_it_was() {
        let mut trial = Trial::of("position", &[("sigma", "0 m")]);
        trial.sampling = Sampling {
            period: Some(Time::from_millis(20.0)),
            phase: SamplePhase::At(Time::from_millis(5.0)),
            delay: Time::from_millis(50.0),
            dropout: 0.0,
        };
        (trial.every, trial.seconds) = (Time::from_millis(13.0), 2);
        trial.run(|bee, sensor: Handle<Position>| {
            let velocity = DVec3::new(1.0, 0.5, 0.0);
            // It drives through the samples taken before the first act: only later ones are held.
            bee.set_velocity(simbeeotic_model::units::Velocity::from_si(velocity));
            let sample = bee.sample(sensor);
            let (now, taken) = (bee.now().nanos(), sample.taken.nanos());
            assert_eq!((taken - 5_000_000) % 20_000_000, 0);
            assert!(
                (50_000_000..70_000_000).contains(&(now - taken)),
                "{}",
                now - taken
            );
            if taken > 1_000_000_000 {
                let was = bee.position().si() - velocity * ((now - taken) as f64 * 1e-9);
                assert!(
                    (sample.reading.si() - was).length() < 1e-9,
                    "{:?}",
                    sample.reading
                );
            }
        });
    }

    #[test]
    fn a_negative_error_is_refused() {
        let refusal = refusal("position", &[("sigma", "-0.5 m")]).expect("it is refused");
        assert!(refusal.contains("sigma"), "{refusal}");
    }
}
