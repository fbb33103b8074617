//! A bee on a random walk.

use super::walk::Walk;
use simbeeotic_model::check::at_least_zero;
use simbeeotic_model::units::{Angle, Speed};
use simbeeotic_model::{Bee, Behavior, BuildError, Kit, behavior, params};

/// A bee on a random walk: at each step of its vehicle's control law it turns at random and
/// changes its velocity, forward and up, at random.
#[behavior(
    "random-walk-bee",
    java = "harvard.robobees.simbeeotic.example.RandomWalkBee"
)]
pub struct RandomWalkBee {
    walk: Walk,
}

/// Parameters of [`RandomWalkBee`].
#[params]
pub struct RandomWalkBeeParams {
    /// Top speed of the walk.
    pub max_speed: Speed,
    /// Standard deviation of each change of the velocity, forward and up.
    pub velocity_sigma: Speed,
    /// Standard deviation of each turn.
    pub heading_sigma: Angle,
}

impl Default for RandomWalkBeeParams {
    fn default() -> Self {
        Self {
            max_speed: Speed::si(2.0),
            velocity_sigma: Speed::si(0.2),
            heading_sigma: Angle::si(std::f64::consts::PI / 16.0),
        }
    }
}

impl Behavior for RandomWalkBee {
    type Params = RandomWalkBeeParams;

    fn build(params: RandomWalkBeeParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("max_speed", params.max_speed)?;
        at_least_zero("velocity_sigma", params.velocity_sigma)?;
        at_least_zero("heading_sigma", params.heading_sigma)?;
        let walk = Walk {
            heading_sigma: params.heading_sigma,
            velocity_sigma: params.velocity_sigma,
            max_speed: params.max_speed,
        };
        Ok(Self { walk })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        self.walk.step(bee);
    }
}

#[cfg(test)]
mod tests {
    use crate::trial::{bee, run};
    use simbeeotic_model::kernel::SimTime;

    #[test]
    fn the_walk_never_exceeds_its_top_speed() {
        let params = [("max_speed", "0.5 m/s"), ("velocity_sigma", "3 m/s")];
        let plan = bee("bee", "random-walk-bee", &params, [0.0, 0.0, 500.0]);
        let mut run = run(vec![plan], 60);
        let mut fastest = 0.0_f64;
        for step in 1..=600 {
            run.run_until(SimTime::from_millis(100 * step))
                .expect("it runs");
            let velocity = run.twist("bee").expect("a body").linear;
            fastest = fastest.max(velocity.length().metres_per_second());
        }
        assert!((0.2..0.5 + 1e-9).contains(&fastest), "{fastest} m/s");
    }
}
