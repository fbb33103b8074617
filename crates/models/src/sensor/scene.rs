//! Things to look at, for the tests of sensors.

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
