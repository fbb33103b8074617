//! Where vehicles may start, and places with a name.

use crate::look::Meta;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::{Length, Position, Yaw, math};
use std::f64::consts::TAU;

/// An area where vehicles may start: `start = { area = "NAME" }` in a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Spawn {
    /// What scenarios call it.
    pub name: String,
    /// Where it is.
    pub shape: SpawnShape,
    /// Names and values that models can read.
    #[serde(default)]
    pub meta: Meta,
}

/// Where an area is. Points are drawn evenly over it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum SpawnShape {
    /// A box, from one corner on.
    Box {
        /// The corner with the least coordinates.
        from: Position,
        /// How far it reaches from there. Not negative.
        size: Position,
    },
    /// A level disc.
    Disc {
        /// Its middle.
        center: Position,
        /// Its radius. Not negative.
        radius: Length,
    },
    /// A ball.
    Ball {
        /// Its middle.
        center: Position,
        /// Its radius. Not negative.
        radius: Length,
    },
    /// A level polygon.
    Polygon {
        /// Its corners, one after the other: east and north. Three or more, not all on one line.
        corners: Vec<[Length; 2]>,
        /// How high it lies.
        #[serde(default)]
        height: Length,
    },
    /// Single places, each for one vehicle, in order.
    Poses(Vec<SpawnPose>),
}

/// A place for one vehicle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpawnPose {
    /// Where it is.
    pub position: Position,
    /// Where its vehicle looks: counter-clockwise from east. As the scenario says if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw: Option<Yaw>,
}

/// Draws for a point of a polygon, at most; a polygon that fills less than one part in a thousand of
/// its bounding box is refused by [`World::check`](crate::World::check).
const DRAWS_MAX: usize = 100_000;

impl Spawn {
    /// How many vehicles it has places for; `None`: for any number.
    pub fn places(&self) -> Option<u64> {
        match &self.shape {
            SpawnShape::Poses(poses) => Some(poses.len() as u64),
            _ => None,
        }
    }

    /// The place of vehicle number `index`, from 0. Past the last of a list: that one.
    pub fn place(&self, index: u64, stream: &mut Stream) -> SpawnPose {
        let position = match &self.shape {
            SpawnShape::Box { from, size } => {
                let share = [stream.uniform(), stream.uniform(), stream.uniform()];
                Position::from_si(from.si() + size.si() * glam::DVec3::from_array(share))
            }
            SpawnShape::Disc { center, radius } => {
                let radius_m = radius.get() * stream.uniform().sqrt();
                let (sin, cos) = math::sin_cos(TAU * stream.uniform());
                *center + Position::from_xyz(radius_m * cos, radius_m * sin, 0.0)
            }
            SpawnShape::Ball { center, radius } => {
                *center + Position::from_si(stream.in_ball(radius.get()))
            }
            SpawnShape::Polygon { corners, height } => {
                let [x_m, y_m] = within(corners, stream);
                Position::from_xyz(x_m, y_m, height.get())
            }
            SpawnShape::Poses(poses) => {
                let last = poses.len().saturating_sub(1);
                let at = usize::try_from(index).map_or(last, |index| index.min(last));
                return poses.get(at).copied().unwrap_or(SpawnPose {
                    position: Position::ZERO,
                    yaw: None,
                });
            }
        };
        SpawnPose {
            position,
            yaw: None,
        }
    }
}

/// A point of a polygon, in metres.
fn within(corners: &[[Length; 2]], stream: &mut Stream) -> [f64; 2] {
    let corners: Vec<[f64; 2]> = corners.iter().map(|c| c.map(Length::get)).collect();
    let (low, high) = bounds(&corners);
    for _ in 0..DRAWS_MAX {
        let point = [0, 1].map(|i| low[i] + (high[i] - low[i]) * stream.uniform());
        if holds(&corners, point) {
            return point;
        }
    }
    corners.first().copied().unwrap_or_default()
}

/// The corners of the box around some points.
pub(crate) fn bounds(corners: &[[f64; 2]]) -> ([f64; 2], [f64; 2]) {
    let least = |i: usize| corners.iter().map(|c| c[i]).fold(f64::INFINITY, f64::min);
    let most = |i: usize| {
        corners
            .iter()
            .map(|c| c[i])
            .fold(f64::NEG_INFINITY, f64::max)
    };
    ([least(0), least(1)], [most(0), most(1)])
}

/// Whether a point lies in a polygon: a line from it to the east crosses an odd number of sides.
fn holds(corners: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    let crossed = sides.filter(|&(&[x0, y0], &[x1, y1])| {
        (y0 > y) != (y1 > y) && x < x0 + (x1 - x0) * (y - y0) / (y1 - y0)
    });
    crossed.count() % 2 == 1
}

/// The area of a polygon whose sides do not cross, in square metres.
pub(crate) fn area(corners: &[[f64; 2]]) -> f64 {
    let sides = corners.iter().zip(corners.iter().cycle().skip(1));
    0.5 * sides
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
        .sum::<f64>()
        .abs()
}

/// Polygons of more corners than this are not searched for sides that cross: the search takes the
/// square of their number.
const CROSSING_CORNERS_MAX: usize = 4096;

/// Two sides of a polygon that cross, by the numbers of the corners they begin at. Sides that only
/// touch do not cross.
pub(crate) fn crossing(corners: &[[f64; 2]]) -> Option<[usize; 2]> {
    let n = corners.len();
    if n > CROSSING_CORNERS_MAX {
        return None;
    }
    // Above zero if `c` lies to the left of the way from `a` to `b`.
    let turn = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let side = |i: usize| (corners[i], corners[(i + 1) % n]);
    let apart = |x: f64, y: f64| x > 0.0 && y < 0.0 || x < 0.0 && y > 0.0;
    let cross = |i: usize, j: usize| {
        let ((a, b), (c, d)) = (side(i), side(j));
        apart(turn(a, b, c), turn(a, b, d)) && apart(turn(c, d, a), turn(c, d, b))
    };
    (0..n).find_map(|i| (i + 1..n).find(|&j| cross(i, j)).map(|j| [i, j]))
}

/// A place with a name, for models: `cx.world().place("dock")`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// What models call it.
    pub name: String,
    /// Where it is.
    pub position: Position,
    /// How far it reaches. Not negative; 0 if left out.
    #[serde(default)]
    pub radius: Length,
    /// Names and values that models can read.
    #[serde(default)]
    pub meta: Meta,
}

impl Place {
    /// Whether a point lies in it.
    pub fn holds(&self, point: Position) -> bool {
        self.position.distance(point) <= self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn area_of(shape: SpawnShape) -> Spawn {
        Spawn {
            name: "a".into(),
            shape,
            meta: Meta::new(),
        }
    }

    fn points(shape: SpawnShape) -> Vec<glam::DVec3> {
        let spawn = area_of(shape);
        let mut stream = Stream::new(7, "spawn", "test");
        let point = |_| spawn.place(0, &mut stream).position.si();
        (0..20_000).map(point).collect()
    }

    fn share(points: &[glam::DVec3], within: impl Fn(&glam::DVec3) -> bool) -> f64 {
        points.iter().filter(|p| within(p)).count() as f64 / points.len() as f64
    }

    #[test]
    fn points_fill_every_shape_evenly_and_none_lies_outside() {
        let center = Position::from_xyz(1.0, 2.0, 3.0);
        let disc = points(SpawnShape::Disc {
            center,
            radius: m(4.0),
        });
        let from_center = |p: &glam::DVec3| (*p - center.si()).length();
        assert!(disc.iter().all(|p| from_center(p) <= 4.0 && p.z == 3.0));
        assert!((share(&disc, |p| from_center(p) < 2.0) - 0.25).abs() < 0.01);
        let ball = points(SpawnShape::Ball {
            center,
            radius: m(4.0),
        });
        assert!(ball.iter().all(|p| from_center(p) <= 4.0));
        assert!((share(&ball, |p| from_center(p) < 2.0) - 0.125).abs() < 0.01);
        let boxed = points(SpawnShape::Box {
            from: center,
            size: Position::from_xyz(2.0, 0.0, 4.0),
        });
        assert!(
            boxed
                .iter()
                .all(|p| p.y == 2.0 && p.cmpge(center.si()).all())
        );
        assert!((share(&boxed, |p| p.z < 4.0) - 0.25).abs() < 0.01);
    }

    #[test]
    fn points_of_a_polygon_stay_inside_its_corners() {
        // An L: two by two without its upper right quarter.
        let corners = [
            [0.0, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.0, 1.0],
            [1.0, 2.0],
            [0.0, 2.0],
        ];
        assert_eq!(area(&corners), 3.0);
        let polygon = points(SpawnShape::Polygon {
            corners: corners.iter().map(|c| c.map(m)).collect(),
            height: m(5.0),
        });
        assert!(
            polygon
                .iter()
                .all(|p| p.z == 5.0 && (p.x <= 1.0 || p.y <= 1.0))
        );
        assert!((share(&polygon, |p| p.x < 1.0 && p.y < 1.0) - 1.0 / 3.0).abs() < 0.015);
    }

    #[test]
    fn poses_are_taken_in_order() {
        let pose = |x: f64| SpawnPose {
            position: Position::from_xyz(x, 0.0, 0.0),
            yaw: Some(Yaw::NORTH),
        };
        let spawn = area_of(SpawnShape::Poses(vec![pose(1.0), pose(2.0)]));
        let mut stream = Stream::new(7, "spawn", "test");
        assert_eq!(spawn.places(), Some(2));
        assert_eq!(spawn.place(1, &mut stream), pose(2.0));
        assert_eq!(spawn.place(9, &mut stream), pose(2.0));
        assert_eq!(stream.drawn(), 0);
    }

    #[test]
    fn a_place_holds_what_is_near() {
        let place = Place {
            name: "dock".into(),
            position: Position::from_xyz(1.0, 0.0, 0.0),
            radius: m(2.0),
            meta: Meta::new(),
        };
        assert!(place.holds(Position::from_xyz(3.0, 0.0, 0.0)));
        assert!(!place.holds(Position::from_xyz(3.1, 0.0, 0.0)));
    }
}
