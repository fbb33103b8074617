//! A bee that flies straight on.

use simbeeotic_model::units::{Flu, V3, Velocity};
use simbeeotic_model::{Bee, Behavior, BuildError, Kit, behavior, params};

/// A bee that always wants one velocity, whatever it meets: for obstacles, nets and walls.
#[behavior("cruise-bee")]
pub struct CruiseBee {
    velocity: Velocity<Flu>,
}

/// Parameters of [`CruiseBee`].
#[params]
pub struct CruiseBeeParams {
    /// The velocity it wants: forward, left, up.
    pub velocity: Velocity<Flu>,
}

impl Default for CruiseBeeParams {
    fn default() -> Self {
        Self {
            velocity: V3::from_si(glam::DVec3::X),
        }
    }
}

impl Behavior for CruiseBee {
    type Params = CruiseBeeParams;

    fn build(params: CruiseBeeParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        Ok(Self {
            velocity: params.velocity,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        bee.fly(self.velocity);
    }
}

#[cfg(test)]
mod tests {
    use crate::trial::{bee, run};
    use simbeeotic_model::kernel::SimTime;

    #[test]
    fn it_comes_to_its_velocity_and_keeps_it() {
        let plan = bee("bee", "cruise-bee", &[], [0.0, 0.0, 50.0]);
        let mut run = run(vec![plan], 60);
        run.run_until(SimTime::from_secs(60)).expect("it runs");
        let velocity = run.twist("bee").expect("a body").linear.si();
        assert!(velocity.distance(glam::DVec3::X) < 0.01, "{velocity}");
    }
}
