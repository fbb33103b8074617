//! The random walk that several bees share.

use simbeeotic_model::Bee;
use simbeeotic_model::units::{Angle, Speed, Velocity};

/// One step of the paper's random walk: a random turn, a random change of the velocity forward and
/// up, and a cap on the speed.
pub(super) fn step(
    bee: &mut Bee<'_>,
    heading_sigma: Angle,
    velocity_sigma: Speed,
    max_speed: Speed,
) {
    let turn = heading_sigma * bee.gauss();
    bee.turn(turn);

    let change = Velocity::new(
        velocity_sigma * bee.gauss(),
        Speed::ZERO,
        velocity_sigma * bee.gauss(),
    );
    bee.fly((bee.velocity_setpoint() + change).limit(max_speed));
}
