//! Optical flow: how the picture of the surroundings moves.
//!
//! The sensor is a pinhole camera that looks along its own forward axis. Its picture has `x` to the
//! right and `y` down, in units of the focal length, so that a ray `(x, y)` goes along
//! `(1, -x, -y)` in the sensor's axes (forward, left, up). A point that is at rest in the world, at the
//! depth `Z` along the forward axis, moves in the picture with
//!
//! ```text
//! x' = (-Tx + x Tz) / Z  +  wx x y - wy (1 + x^2) + wz y                            (1)
//! y' = (-Ty + y Tz) / Z  +  wx (1 + y^2) - wy x y - wz x                            (2)
//! ```
//! where `T` is the velocity of the sensor and `w` its body rate along the camera's axes: right, down,
//! forward. The first part is the translational flow, which tells of depths; the second, rotational
//! part does not depend on them. In the middle of the picture `x'` and `y'` are angular rates; flying at
//! a speed `v` at a height `h` above a plane and looking straight down, the flow there is `v / h`.
//! A point that itself moves counts with its velocity: `T` is the difference.
//!
//! Source: H. C. Longuet-Higgins and K. Prazdny, *The interpretation of a moving retinal image*, Proc. R.
//! Soc. B 208 (1980), equations 2.7 and 2.8 (not at hand; derived anew and tested against differences).

use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{AngularRate, Flu, Length, Rate, Velocity};
use simbeeotic_model::{Column, Reading};

/// Both parts of the flow at one place of the picture, per second: `[x', y']`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parts {
    /// What comes of moving past things: the first terms of equations 1 and 2.
    pub translational: [f64; 2],
    /// What comes of turning: the rest.
    pub rotational: [f64; 2],
}

impl Parts {
    /// What is seen: both together.
    pub fn sum(self) -> [f64; 2] {
        let ([a, b], [c, d]) = (self.translational, self.rotational);
        [a + c, b + d]
    }
}

/// Equations 1 and 2: the flow at `[x, y]` of what is at `depth` along the forward axis, for a sensor
/// that moves with `velocity` relative to it and turns with `rate`, both in the sensor's axes.
pub fn flow([x, y]: [f64; 2], depth: Length, velocity: Velocity<Flu>, rate: Rate<Flu>) -> Parts {
    let (tx, ty, tz) = camera_axes(velocity.si());
    let (wx, wy, wz) = camera_axes(rate.si());
    let z = depth.get();
    Parts {
        translational: [(x * tz - tx) / z, (y * tz - ty) / z],
        rotational: [
            wx * x * y - wy * (1.0 + x * x) + wz * y,
            wx * (1.0 + y * y) - wy * x * y - wz * x,
        ],
    }
}

/// From forward, left, up to right, down, forward.
fn camera_axes(v: DVec3) -> (f64, f64, f64) {
    (-v.y, -v.z, v.x)
}

/// What an optical flow sensor reads: the flow at each place of its grid, row by row from above, each
/// from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct OpticalFlow {
    /// The places.
    pub points: Vec<FlowPoint>,
}

/// The flow at one place of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowPoint {
    /// The place, in focal lengths: right and down of the middle.
    pub at: [f64; 2],
    /// How it moves: to the right and down. `None`: nothing is in range there.
    pub flow: Option<[AngularRate; 2]>,
}

/// A side of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The columns left of the middle.
    Left,
    /// The middle column.
    Middle,
    /// The columns right of the middle.
    Right,
}

impl Reading for OpticalFlow {
    const COLUMNS: &'static [Column] = &[
        Column::new("x", "1"),
        Column::new("y", "1"),
        Column::new("flow_x", "rad/s"),
        Column::new("flow_y", "rad/s"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        for point in &self.points {
            let flow = point.flow.map(|flow| flow.map(AngularRate::get));
            to.extend(point.at);
            to.extend(flow.unwrap_or([f64::NAN; 2]));
        }
    }
}

impl OpticalFlow {
    /// The flow that is left at each place when the part of a turn with `rate` is taken away: that of
    /// moving past things. `rate` is a gyroscope's, in the sensor's axes.
    pub fn derotated(&self, rate: Rate<Flu>) -> Vec<Option<[AngularRate; 2]>> {
        let turn = |at| flow(at, Length::si(1.0), Velocity::ZERO, rate).rotational;
        let points = self.points.iter();
        let left = points.map(|point| {
            let ([x, y], [turn_x, turn_y]) = (point.flow?, turn(point.at).map(AngularRate::si));
            Some([x - turn_x, y - turn_y])
        });
        left.collect()
    }

    /// The depth at each place, along the forward axis, as `velocity` and `rate` explain the flow: the
    /// least squares of equations 1 and 2. Both are estimates, in the sensor's axes. `None` where there
    /// is no flow, or where it is against the velocity (a depth below zero), or nothing could be told
    /// from it: where one flies to, there is none.
    pub fn depths(&self, velocity: Velocity<Flu>, rate: Rate<Flu>) -> Vec<Option<Length>> {
        let flows = self.derotated(rate);
        let depth = |(point, left): (&FlowPoint, Option<[AngularRate; 2]>)| {
            let [x, y] = left?.map(AngularRate::get);
            let here = flow(point.at, Length::si(1.0), velocity, Rate::ZERO).translational;
            let [expected_x, expected_y] = here;
            let depth = (expected_x * expected_x + expected_y * expected_y)
                / (x * expected_x + y * expected_y);
            (depth > 0.0 && depth.is_finite()).then_some(Length::si(depth))
        };
        self.points.iter().zip(flows).map(depth).collect()
    }

    /// The least of the [`depths`](Self::depths).
    pub fn nearest(&self, velocity: Velocity<Flu>, rate: Rate<Flu>) -> Option<Length> {
        Some(self.nearest_point(velocity, rate)?.1)
    }

    /// The mean of the [`depths`](Self::depths).
    pub fn mean_depth(&self, velocity: Velocity<Flu>, rate: Rate<Flu>) -> Option<Length> {
        let depths = self.depths(velocity, rate);
        let known: Vec<Length> = depths.into_iter().flatten().collect();
        (!known.is_empty()).then(|| known.iter().sum::<Length>() / known.len() as f64)
    }

    /// On which side the [`nearest`](Self::nearest) is.
    pub fn side_of_nearest(&self, velocity: Velocity<Flu>, rate: Rate<Flu>) -> Option<Side> {
        let ([x, _], _) = self.nearest_point(velocity, rate)?;
        Some(match x {
            x if x < -1e-9 => Side::Left,
            x if x > 1e-9 => Side::Right,
            _ => Side::Middle,
        })
    }

    fn nearest_point(&self, v: Velocity<Flu>, rate: Rate<Flu>) -> Option<([f64; 2], Length)> {
        let depths = self.depths(v, rate);
        let known = self.points.iter().zip(depths);
        let known = known.filter_map(|(point, depth)| Some((point.at, depth?)));
        known.min_by(|(_, a), (_, b)| a.total_cmp(b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::units::{Angle, Attitude, Offset, Pose, Position, Time, Yaw};

    /// Where a point that is fixed in the world is in the picture of a camera.
    fn projected(camera: Pose, point: Position) -> [f64; 2] {
        let p = camera.to_body(point).si();
        [-p.y / p.x, -p.z / p.x]
    }

    #[test]
    fn the_equations_are_how_the_picture_of_a_fixed_point_moves() {
        let attitude = Attitude::from_rpy(
            Angle::from_degrees(20.0),
            Angle::from_degrees(-35.0),
            Yaw::new(Angle::from_degrees(100.0)),
        );
        let pose = Pose::new(Position::from_xyz(1.0, 2.0, 3.0), attitude);
        let velocity = Velocity::<Flu>::from_xyz(1.5, -0.7, 0.4);
        let rate = Rate::<Flu>::from_xyz(0.3, -0.8, 1.1);
        for (x, y, depth) in [(0.0, 0.0, 2.0), (0.5, -0.3, 4.0), (-0.4, 0.6, 1.0)] {
            let point = pose.to_world(Offset::from_xyz(depth, -x * depth, -y * depth));
            let after = |dt: f64| {
                let moved = attitude.rotate(velocity) * Time::si(dt);
                let turn = rate * Time::si(dt);
                Pose::new(pose.position + moved, attitude * Attitude::exp(turn))
            };
            let (one, other) = (
                projected(after(1e-5), point),
                projected(after(-1e-5), point),
            );
            let seen = flow([x, y], Length::si(depth), velocity, rate).sum();
            for axis in 0..2 {
                let slope = (one[axis] - other[axis]) / 2e-5;
                assert!(
                    (slope - seen[axis]).abs() < 1e-8,
                    "{slope} for {}",
                    seen[axis]
                );
            }
        }
    }
}
