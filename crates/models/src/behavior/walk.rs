//! The random walk that several bees share.

use simbeeotic_model::Bee;
use simbeeotic_model::units::{Angle, Speed, Velocity};

/// The numbers of a walk.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walk {
    /// Standard deviation of each turn.
    pub(super) heading_sigma: Angle,
    /// Standard deviation of each change of the velocity, forward and up.
    pub(super) velocity_sigma: Speed,
    /// Top speed.
    pub(super) max_speed: Speed,
}

impl Walk {
    /// The usual walk with this top speed.
    pub(super) fn up_to(max_speed: Speed) -> Self {
        Self {
            heading_sigma: Angle::si(0.2),
            velocity_sigma: Speed::si(0.2),
            max_speed,
        }
    }

    /// One step of the paper's random walk: a random turn, a random change of the velocity forward
    /// and up, and a cap on the speed.
    pub(super) fn step(&self, bee: &mut Bee<'_>) {
        let turn = self.heading_sigma * bee.gauss();
        bee.turn(turn);

        let change = Velocity::new(
            self.velocity_sigma * bee.gauss(),
            Speed::ZERO,
            self.velocity_sigma * bee.gauss(),
        );
        bee.fly((bee.velocity_setpoint() + change).limit(self.max_speed));
    }
}
