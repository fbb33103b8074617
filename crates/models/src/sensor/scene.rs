//! Things to look at, for the tests of sensors.

use crate::trial::bee;
use simbeeotic_model::ModelPlan;
use simbeeotic_model::units::{Angle, Length, Position};
use simbeeotic_model::world::{Obstacle, ObstacleShape};

/// A box: the middle of its lowest side, and its size along the axes, m.
pub(crate) fn block(at: [f64; 3], size: [f64; 3]) -> Obstacle {
    let [length, width, height] = size.map(Length::si);
    Obstacle {
        position: Position::from_xyz(at[0], at[1], at[2]),
        shape: ObstacleShape::Box {
            length,
            width,
            height,
            rotation: Angle::ZERO,
        },
        ..Obstacle::default()
    }
}

/// A bee that hovers where it starts, its middle 5 cm above.
pub(crate) fn still(name: &str, at: [f64; 3]) -> ModelPlan {
    let nowhere = [("velocity", "[0 m/s, 0 m/s, 0 m/s]")];
    bee(name, "cruise-bee", &nowhere, at)
}
