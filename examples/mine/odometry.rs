//! Where a vehicle believes it is: dead reckoning that walls pull back.

use super::chart::{Place, WAYS};
use simbeeotic::units::glam::{DVec2, DVec3};

/// What a vehicle knows of the plan by which the mine was dug.
#[derive(Clone, Copy, Debug)]
pub struct Plan {
    /// From the middle of a cell to the next, m.
    pub pitch_m: f64,
    /// Half the width of a tunnel, m.
    pub half_m: f64,
    /// From floor to floor, m.
    pub storey_m: f64,
    /// How high above a floor one flies, m.
    pub height_m: f64,
    /// Part of what a wall contradicts the estimate by that is believed at once.
    pub trust: f64,
}

/// The same of the floor.
const FLOOR_TRUST: f64 = 0.3;
/// A wall that contradicts it by more is another one, m.
const OTHER_M: f64 = 0.9;

impl Plan {
    /// The middle of a cell, at the height of flight.
    pub fn middle(&self, [storey, x, y]: Place) -> DVec3 {
        DVec3::new(
            f64::from(x) * self.pitch_m,
            f64::from(y) * self.pitch_m,
            f64::from(storey) * self.storey_m + self.height_m,
        )
    }

    /// The cell of a place.
    pub fn cell(&self, at: DVec3) -> Place {
        let round = |n: f64| n.round().clamp(-127.0, 127.0) as i8;
        let storey = (at.z - self.height_m) / self.storey_m;
        [
            round(storey),
            round(at.x / self.pitch_m),
            round(at.y / self.pitch_m),
        ]
    }
}

/// The estimate.
#[derive(Clone, Copy, Debug, Default)]
pub struct Odometry {
    /// East, north, up of the foot of the shaft, m.
    pub at: DVec3,
}

impl Odometry {
    /// Moves on, with a velocity in the world's axes.
    pub fn moved(&mut self, velocity_m_s: DVec3, seconds: f64) {
        self.at += velocity_m_s * seconds;
    }

    /// A wall is seen at a distance in one of the four level ways: equation 1.
    pub fn wall(&mut self, way: usize, distance_m: f64, plan: &Plan) {
        let [_, x, y] = WAYS[way % 4].map(f64::from);
        let way = DVec2::new(x, y);
        let along = self.at.truncate().dot(way);
        let steps = ((along + distance_m - plan.half_m) / plan.pitch_m).round();
        let error = steps * plan.pitch_m + plan.half_m - distance_m - along;
        if error.abs() < OTHER_M {
            self.at += (way * (plan.trust * error)).extend(0.0);
        }
    }

    /// The floor is seen below.
    pub fn floor(&mut self, distance_m: f64, plan: &Plan) {
        let storey = ((self.at.z - distance_m) / plan.storey_m).round();
        let error = storey * plan.storey_m + distance_m - self.at.z;
        if error.abs() < OTHER_M {
            self.at.z += FLOOR_TRUST * error;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_pull_an_estimate_that_has_drifted_back_to_the_truth() {
        let plan = Plan {
            pitch_m: 3.0,
            half_m: 1.25,
            storey_m: 5.0,
            height_m: 1.4,
            trust: 0.3,
        };
        let truth = DVec3::new(6.2, -0.1, 6.4);
        let mut odometry = Odometry {
            at: truth + DVec3::new(0.6, -0.4, 0.5),
        };
        for _ in 0..20 {
            // A wall ahead at the far end of the cell after the next, one to the left, the floor.
            odometry.wall(0, 9.0 + 1.25 - truth.x, &plan);
            odometry.wall(1, 1.25 - truth.y, &plan);
            odometry.floor(1.4, &plan);
        }
        assert!(odometry.at.distance(truth) < 0.01, "{}", odometry.at);
        assert_eq!(plan.cell(odometry.at), [1, 2, 0]);
    }
}
