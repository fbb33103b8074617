//! A bee that searches for the source of a smell.

use simbeeotic_model::check::{at_least_zero, positive};
use simbeeotic_model::units::{Angle, Concentration, Flu, Speed, Time, Velocity};
use simbeeotic_model::{Bee, Behavior, BuildError, Handle, Kit, behavior, params};

/// A bee that flies straight while a smell grows, and tumbles to another direction when it does not:
/// run and tumble, as bacteria search (H. Berg and D. Brown, Nature 239, 500, 1972). It needs a sensor
/// called `smell`.
#[behavior("scent-bee")]
pub struct ScentBee {
    params: ScentBeeParams,
    smell: Handle<Concentration>,
    last: Concentration,
}

/// Parameters of [`ScentBee`].
#[params]
pub struct ScentBeeParams {
    /// How fast it flies.
    pub speed: Speed,
    /// Standard deviation of a turn when the smell does not grow.
    pub tumble_sigma: Angle,
    /// Standard deviation of a turn when it grows.
    pub run_sigma: Angle,
    /// Time between two sniffs.
    pub period: Time,
}

impl Default for ScentBeeParams {
    fn default() -> Self {
        Self {
            speed: Speed::si(1.0),
            tumble_sigma: Angle::from_degrees(70.0),
            run_sigma: Angle::from_degrees(5.0),
            period: Time::from_millis(500.0),
        }
    }
}

impl Behavior for ScentBee {
    type Params = ScentBeeParams;

    fn build(params: ScentBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        positive("speed", params.speed)?;
        at_least_zero("tumble_sigma", params.tumble_sigma)?;
        at_least_zero("run_sigma", params.run_sigma)?;
        kit.every(params.period, Self::sniff);
        let smell = kit.sensor("smell")?;
        Ok(Self {
            params,
            smell,
            last: Concentration::ZERO,
        })
    }
}

impl ScentBee {
    fn sniff(&mut self, bee: &mut Bee<'_>) {
        let smell = bee.read(self.smell);
        let sigma = if smell > self.last {
            self.params.run_sigma
        } else {
            self.params.tumble_sigma
        };
        self.last = smell;
        let turn = sigma * bee.gauss();
        bee.turn(turn);
        let ahead = Velocity::<Flu>::new(self.params.speed, Speed::ZERO, Speed::ZERO);
        bee.fly(ahead);
    }
}

#[cfg(test)]
mod tests {
    use crate::trial::{bee, setup, with_sensor_of};
    use crate::weather::constant::{ConstantWeather, ConstantWeatherParams};
    use simbeeotic_model::kernel::SimTime;
    use simbeeotic_model::units::{Position, Velocity};
    use simbeeotic_model::world::{Source, Stability, World};
    use simbeeotic_model::{FromParams, Setup, Simulation};
    use std::sync::Arc;

    /// How far from the source 40 bees are on average after 100 s, m.
    fn distance(gas: &str) -> f64 {
        let plan = |i: u32| {
            let name = format!("bee-{i}");
            let plan = bee(&name, "scent-bee", &[], [20.0, f64::from(i % 5) - 2.0, 2.0]);
            with_sensor_of(
                plan,
                "smell",
                "smell",
                &[("gas", gas), ("relative_sigma", "0")],
            )
        };
        let wind = Velocity::from_xyz(1.0, 0.0, 0.0);
        let weather = ConstantWeather::from_params(ConstantWeatherParams { wind });
        let world = World {
            sources: vec![
                Source {
                    position: Position::from_xyz(0.0, 0.0, 2.0),
                    stability: Stability::A,
                    ..Source::default()
                },
                // Too far away for anybody to smell it.
                Source {
                    position: Position::from_xyz(0.0, 50_000.0, 2.0),
                    gas: "nothing".to_owned(),
                    ..Source::default()
                },
            ],
            ..World::default()
        };
        let setup = Setup {
            weather: Arc::new(weather.expect("good numbers")),
            world: Arc::new(world),
            ..setup((0..40).map(plan).collect(), 100)
        };
        let mut run = Simulation::new(setup).expect("it can be put together");
        run.run_until(SimTime::from_secs(100)).expect("it runs");
        let from = |i: u32| {
            let at = run.pose(&format!("bee-{i}")).expect("a body").position.si();
            (at.x * at.x + at.y * at.y).sqrt()
        };
        (0..40).map(from).sum::<f64>() / 40.0
    }

    #[test]
    fn it_gets_near_the_source_and_without_a_smell_it_does_not() {
        let (led, lost) = (distance("gas"), distance("nothing"));
        assert!(
            led < 15.0 && lost > 18.0 && lost > 1.5 * led,
            "{led} m, {lost} m"
        );
    }
}
