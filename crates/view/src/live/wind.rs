//! Arrows of wind, on a grid around the swarm.

use super::look::Look;
use simbeeotic_model::View;
use simbeeotic_model::units::Position;

/// Arrows along each side, and upwards: 200 at most.
const ACROSS: u32 = 8;
const UPWARDS: u32 = 3;

/// How far the grid reaches at least, m.
const LEAST_M: f32 = 5.0;

/// The wind around the swarm; no arrows where there is none.
pub(super) fn arrows(view: &View<'_>, look: &Look) -> Vec<[f32; 6]> {
    let (low, high) = bounds(&look.columns.positions);
    let place = |axis: usize, at: u32, of: u32| {
        low[axis] + (high[axis] - low[axis]) * at as f32 / (of - 1) as f32
    };
    let mut arrows = Vec::with_capacity((ACROSS * ACROSS * UPWARDS) as usize);
    for up in 0..UPWARDS {
        for north in 0..ACROSS {
            for east in 0..ACROSS {
                let [x, y, z] = [
                    place(0, east, ACROSS),
                    place(1, north, ACROSS),
                    place(2, up, UPWARDS),
                ];
                let position = Position::from_si([x, y, z].map(f64::from).into());
                let wind = view.wind(position).si().as_vec3().to_array();
                if wind != [0.0; 3] && wind.iter().all(|part| part.is_finite()) {
                    arrows.push([x, y, z, wind[0], wind[1], wind[2]]);
                }
            }
        }
    }
    arrows
}

/// The box that holds everybody, somewhat widened.
fn bounds(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    for position in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
    }
    for axis in 0..3 {
        if !(low[axis].is_finite() && high[axis].is_finite()) {
            (low[axis], high[axis]) = (0.0, 0.0);
        }
        let middle = (low[axis] + high[axis]) / 2.0;
        let half = ((high[axis] - low[axis]) * 0.6).max(LEAST_M);
        (low[axis], high[axis]) = (middle - half, middle + half);
    }
    // The wind blows above the ground.
    low[2] = low[2].max(0.5);
    high[2] = high[2].max(low[2] + 1.0);
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_holds_everybody_and_stays_above_the_ground() {
        let (low, high) = bounds(&[[0.0, 0.0, 1.0], [100.0, 1.0, 2.0]]);
        assert!(low[0] < 0.0 && high[0] > 100.0);
        assert!(low[1] <= -4.0 && high[1] >= 5.0);
        assert!(low[2] >= 0.5 && high[2] > low[2]);
        let (low, high) = bounds(&[[f32::NAN; 3]]);
        assert!((0..3).all(|axis| low[axis] < high[axis]));
    }
}
