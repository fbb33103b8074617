//! What the motors are asked for.

use super::bounds::at_least_zero;
use super::noise::{Channel, Errors};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::Force;
use simbeeotic_model::{BuildError, Column, Needs, Reading, Sensor, Truth, params, sensor};

/// Tells the thrust that its host's motors were asked for at the last step of the control law.
///
/// The fraction is of the most that they give: weight and greatest acceleration at once. Both have the same
/// normal error, relative to that most.
#[sensor("motor")]
pub struct MotorSensor {
    error: Channel,
}

/// One reading of a [`MotorSensor`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotorReading {
    /// Thrust of all motors together.
    pub thrust: Force,
    /// The same as a fraction of the most that they give.
    pub fraction: f64,
}

impl Reading for MotorReading {
    const COLUMNS: &'static [Column] = &[Column::new("thrust", "N"), Column::new("fraction", "1")];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend([self.thrust.get(), self.fraction]);
    }
}

/// Parameters of [`MotorSensor`].
#[params]
#[derive(Default)]
pub struct MotorSensorParams {
    /// Standard deviation of the fraction.
    pub sigma: f64,
}

impl Sensor for MotorSensor {
    type Params = MotorSensorParams;
    type Reading = MotorReading;

    fn build(params: MotorSensorParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        Ok(Self {
            error: Channel::new(Errors::white(params.sigma)),
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> MotorReading {
        let effort = truth.effort();
        MotorReading {
            thrust: effort.thrust,
            fraction: effort.fraction,
        }
    }

    fn measure(
        &mut self,
        ideal: MotorReading,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> MotorReading {
        let fraction = self.error.read(ideal.fraction, truth.now(), rng);
        let most = if ideal.fraction > 0.0 {
            ideal.thrust / ideal.fraction
        } else {
            Force::ZERO
        };
        MotorReading {
            thrust: most * fraction,
            fraction,
        }
    }

    fn needs(&self) -> Needs {
        Needs::Motors
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Time, Velocity};

    #[test]
    fn it_tells_the_thrust_of_a_hover_and_of_a_climb() {
        let mut trial = Trial::of("motor", &[]);
        trial.vehicle = Vec::new();
        (trial.every, trial.seconds) = (Time::si(1.0), 3);
        trial.run(|bee, sensor: Handle<MotorReading>| {
            let read = bee.read(sensor);
            // 128 g; up to 1 m/s^2 besides its weight.
            let most = 0.128 * (9.806_65 + 1.0);
            let want = match bee.now().whole_secs() {
                1 => 0.128 * 9.806_65,
                // Asked at 1 s for 10 m/s upwards: the cap.
                _ => most,
            };
            let gravity = bee.gravity().get();
            let want = want + 0.128 * (gravity - 9.806_65);
            assert!(
                (read.thrust.get() - want).abs() < 1e-9,
                "{read:?} for {want}"
            );
            let most = most + 0.128 * (gravity - 9.806_65);
            assert!((read.fraction - want / most).abs() < 1e-9, "{read:?}");
            bee.fly(Velocity::from_xyz(0.0, 0.0, 10.0));
        });
    }

    #[test]
    fn its_error_is_the_one_it_says() {
        let mut trial = Trial::of("motor", &[("sigma", "0.01")]);
        trial.vehicle = Vec::new();
        trial.run(|bee, sensor: Handle<MotorReading>| {
            let gravity = bee.gravity().get();
            let fractions: Vec<f64> = (0..100_000).map(|_| bee.read(sensor).fraction).collect();
            assert_normal(&fractions, gravity / (gravity + 1.0), 0.01);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        let refusal = refusal("motor", &[("sigma", "-0.1")]).expect("it is refused");
        assert!(refusal.contains("sigma"), "{refusal}");
    }
}
