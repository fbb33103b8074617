//! How near a point is to a solid: what the search for ways asks.

use crate::solid::{Solid, SolidShape};
use glam::{DQuat, DVec3};
use std::sync::Arc;

/// Something solid, ready to be asked how near it is.
pub(super) struct Piece {
    center: DVec3,
    /// From the world's frame to its own.
    own_from_world: DQuat,
    body: Body,
}

enum Body {
    Box(DVec3),
    Cylinder { radius: f64, half_height: f64 },
    Cone { radius: f64, half_height: f64 },
    Capsule { radius: f64, half_height: f64 },
    Hull(Arc<[DVec3]>),
    Triangle([DVec3; 3]),
}

/// The pieces of a solid: itself, or the triangles of its surface. A height field has both pairs of
/// triangles that a cell may be cut into.
pub(super) fn pieces(solid: &Solid) -> Vec<Piece> {
    let turn = solid.attitude.quat();
    let whole = |body| {
        vec![Piece {
            center: solid.center.si(),
            own_from_world: turn.inverse(),
            body,
        }]
    };
    let place = |p: DVec3| solid.center.si() + turn * p;
    match &solid.shape {
        SolidShape::Box {
            half_length,
            half_width,
            half_height,
        } => whole(Body::Box(DVec3::new(
            half_length.get(),
            half_width.get(),
            half_height.get(),
        ))),
        SolidShape::Cylinder {
            radius,
            half_height,
        } => whole(Body::Cylinder {
            radius: radius.get(),
            half_height: half_height.get(),
        }),
        SolidShape::Sphere { radius } => whole(Body::Capsule {
            radius: radius.get(),
            half_height: 0.0,
        }),
        SolidShape::Cone {
            radius,
            half_height,
        } => whole(Body::Cone {
            radius: radius.get(),
            half_height: half_height.get(),
        }),
        SolidShape::Capsule {
            radius,
            half_height,
        } => whole(Body::Capsule {
            radius: radius.get(),
            half_height: half_height.get(),
        }),
        SolidShape::Hull { points } => whole(Body::Hull(points.iter().map(|p| p.si()).collect())),
        SolidShape::Mesh { points, triangles } => triangles
            .iter()
            .filter_map(|corners| {
                let [a, b, c] = corners.map(|at| points.get(at as usize));
                Some(triangle([a?, b?, c?].map(|p| place(p.si()))))
            })
            .collect(),
        SolidShape::HeightField {
            length,
            width,
            columns,
            heights,
        } => {
            let columns = (*columns).max(1);
            let rows = heights.len() / columns;
            let corner = |row: usize, column: usize| {
                let share = |at: usize, of: usize| at as f64 / (of - 1) as f64 - 0.5;
                place(DVec3::new(
                    length.get() * share(column, columns),
                    width.get() * share(row, rows),
                    heights[row * columns + column].get(),
                ))
            };
            let mut all = Vec::new();
            for row in 1..rows {
                for column in 1..columns {
                    let [a, b, c, d] = [
                        corner(row - 1, column - 1),
                        corner(row - 1, column),
                        corner(row, column),
                        corner(row, column - 1),
                    ];
                    all.extend([[a, b, c], [a, c, d], [a, b, d], [b, c, d]].map(triangle));
                }
            }
            all
        }
    }
}

fn triangle(corners: [DVec3; 3]) -> Piece {
    Piece {
        center: DVec3::ZERO,
        own_from_world: DQuat::IDENTITY,
        body: Body::Triangle(corners),
    }
}

impl Piece {
    /// The corners of the smallest box along the axes that holds it.
    pub(super) fn bounds(&self) -> [DVec3; 2] {
        let world_from_own = self.own_from_world.inverse();
        let around = |half: DVec3| {
            let m = glam::DMat3::from_quat(world_from_own);
            let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
            [self.center - reach, self.center + reach]
        };
        let over = |points: &[DVec3]| {
            let placed = points.iter().map(|p| self.center + world_from_own * *p);
            placed.fold([DVec3::INFINITY, DVec3::NEG_INFINITY], |[low, high], p| {
                [low.min(p), high.max(p)]
            })
        };
        match &self.body {
            Body::Box(half) => around(*half),
            &Body::Cylinder {
                radius,
                half_height,
            }
            | &Body::Cone {
                radius,
                half_height,
            } => around(DVec3::new(radius, radius, half_height)),
            &Body::Capsule {
                radius,
                half_height,
            } => around(DVec3::new(radius, radius, half_height + radius)),
            Body::Hull(points) => over(points),
            Body::Triangle(corners) => over(corners),
        }
    }

    /// Whether the point is closer than `distance`, or inside. Of a hull, up to a hundredth of its
    /// size; in doubt it is.
    pub(super) fn is_closer(&self, point: DVec3, distance: f64) -> bool {
        let p = self.own_from_world * (point - self.center);
        let flat = || (p.x * p.x + p.y * p.y).sqrt();
        let far2 = match &self.body {
            Body::Box(half) => (p.abs() - *half).max(DVec3::ZERO).length_squared(),
            Body::Cylinder {
                radius,
                half_height,
            } => {
                let (out, over) = (flat() - radius, p.z.abs() - half_height);
                let (out, over) = (out.max(0.0), over.max(0.0));
                out * out + over * over
            }
            Body::Capsule {
                radius,
                half_height,
            } => {
                let over = (p.z.abs() - half_height).max(0.0);
                let out = (p.x * p.x + p.y * p.y + over * over).sqrt() - radius;
                out.max(0.0) * out.max(0.0)
            }
            Body::Cone {
                radius,
                half_height,
            } => cone2(flat(), p.z, *radius, *half_height),
            Body::Hull(points) => return hull_is_closer(points, p, distance),
            Body::Triangle(corners) => triangle2(corners, p),
        };
        far2 < distance * distance
    }
}

/// The square of the distance from a cone, of a point by its distance from the axis and its height.
fn cone2(out: f64, z: f64, radius: f64, half_height: f64) -> f64 {
    if z >= -half_height && out * 2.0 * half_height <= radius * (half_height - z) {
        return 0.0;
    }
    let from = |a: [f64; 2], b: [f64; 2]| {
        let (along, to) = ([b[0] - a[0], b[1] - a[1]], [out - a[0], z - a[1]]);
        let length2 = along[0] * along[0] + along[1] * along[1];
        let share = ((to[0] * along[0] + to[1] * along[1]) / length2).clamp(0.0, 1.0);
        let (x, y) = (to[0] - share * along[0], to[1] - share * along[1]);
        x * x + y * y
    };
    let (foot, rim, tip) = (
        [0.0, -half_height],
        [radius, -half_height],
        [0.0, half_height],
    );
    from(foot, rim).min(from(rim, tip))
}

/// The square of the distance from a triangle.
///
/// Source: Ericson 2005, *Real-Time Collision Detection*, section 5.1.5, by the regions of its
/// corners, edges and face.
fn triangle2([a, b, c]: &[DVec3; 3], p: DVec3) -> f64 {
    let (ab, ac) = (*b - *a, *c - *a);
    let (ap, bp, cp) = (p - *a, p - *b, p - *c);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d1 <= 0.0 && d2 <= 0.0 {
        return ap.length_squared();
    }
    if d3 >= 0.0 && d4 <= d3 {
        return bp.length_squared();
    }
    if d6 >= 0.0 && d5 <= d6 {
        return cp.length_squared();
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (ap - ab * (d1 / (d1 - d3))).length_squared();
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (ap - ac * (d2 / (d2 - d6))).length_squared();
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        let share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (bp - (*c - *b) * share).length_squared();
    }
    let over = 1.0 / (va + vb + vc);
    (ap - ab * (vb * over) - ac * (vc * over)).length_squared()
}

/// Steps of the search for the nearest point of a hull.
const HULL_STEPS: usize = 200;

/// Whether a hull is closer to `p` than `distance`.
///
/// Gilbert's algorithm: a point of the hull is drawn nearer along segments; its support gives a
/// lower bound of the distance at each step, itself an upper one. Source: Gilbert 1966, "An
/// iterative procedure for computing the minimum of a quadratic form on a convex set", SIAM J.
/// Control 4(1).
fn hull_is_closer(points: &[DVec3], p: DVec3, distance: f64) -> bool {
    let Some(first) = points.first() else {
        return false;
    };
    let mut near = *first - p;
    for _ in 0..HULL_STEPS {
        let length = near.length();
        if length < distance {
            return true;
        }
        let support = points
            .iter()
            .map(|q| *q - p)
            .min_by(|a, b| a.dot(near).total_cmp(&b.dot(near)))
            .unwrap_or(near);
        if support.dot(near) >= distance * length * (1.0 + 1e-6) {
            return false;
        }
        let along = support - near;
        let length2 = along.length_squared();
        if length2 == 0.0 {
            return false;
        }
        near += along * (-near.dot(along) / length2).clamp(0.0, 1.0);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_kernel::rng::Stream;
    use simbeeotic_units::{Attitude, Length, Offset, Position};

    /// By bisection, between 0 and 10.
    fn distance(solid: &Solid, point: [f64; 3]) -> f64 {
        let pieces = pieces(solid);
        let (mut low, mut high) = (0.0, 10.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let closer = pieces
                .iter()
                .any(|piece| piece.is_closer(DVec3::from_array(point), middle));
            if closer { high = middle } else { low = middle }
        }
        high
    }

    fn solid(shape: SolidShape) -> Solid {
        Solid {
            shape,
            center: Position::from_xyz(0.0, 0.0, 0.0),
            attitude: Attitude::IDENTITY,
        }
    }

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    #[test]
    fn distances_are_those_of_geometry() {
        let cube = solid(SolidShape::Box {
            half_length: m(1.0),
            half_width: m(2.0),
            half_height: m(3.0),
        });
        let round = solid(SolidShape::Cylinder {
            radius: m(1.0),
            half_height: m(2.0),
        });
        let cone = solid(SolidShape::Cone {
            radius: m(3.0),
            half_height: m(2.0),
        });
        let capsule = solid(SolidShape::Capsule {
            radius: m(0.5),
            half_height: m(1.0),
        });
        let ball = solid(SolidShape::Sphere { radius: m(2.0) });
        for (shape, point, want) in [
            (&cube, [0.0, 0.0, 0.0], 0.0),
            (&cube, [3.0, 0.0, 0.0], 2.0),
            (&cube, [4.0, 6.0, 3.0], 5.0),
            (&round, [0.0, 4.0, 1.0], 3.0),
            (&round, [0.0, 4.0, 6.0], 5.0),
            (&round, [0.5, 0.5, 2.5], 0.5),
            (&cone, [0.0, 0.0, 3.0], 1.0),
            (&cone, [0.0, 0.0, -3.5], 1.5),
            // The flank is the line 4 x + 3 z = 6 in the plane of x and z.
            (&cone, [5.0, 0.0, 2.0], 4.0),
            (&cone, [7.0, 0.0, -5.0], 5.0),
            (&capsule, [0.0, 3.0, 0.5], 2.5),
            (&capsule, [3.0, 0.0, 5.0], 4.5),
            (&ball, [0.0, 3.0, 4.0], 3.0),
        ] {
            let found = distance(shape, point);
            assert!((found - want).abs() < 1e-9, "{shape:?} {point:?}: {found}");
        }
    }

    #[test]
    fn a_box_is_as_far_as_the_hull_of_its_corners_and_as_its_surface() {
        let half = DVec3::new(0.5, 1.0, 1.5);
        let points: Vec<Offset> = (0..8)
            .map(|i| {
                let sign = |bit: i32| if i & bit == 0 { -1.0 } else { 1.0 };
                Offset::from_si(half * DVec3::new(sign(1), sign(2), sign(4)))
            })
            .collect();
        let faces: Vec<[u32; 3]> = vec![
            [0, 1, 3],
            [0, 3, 2],
            [4, 5, 7],
            [4, 7, 6],
            [0, 1, 5],
            [0, 5, 4],
            [2, 3, 7],
            [2, 7, 6],
            [0, 2, 6],
            [0, 6, 4],
            [1, 3, 7],
            [1, 7, 5],
        ];
        let turned = |shape| Solid {
            attitude: Attitude::from_wxyz(0.3, -0.4, 0.5, 0.6).expect("a turn"),
            center: Position::from_xyz(1.0, 2.0, 3.0),
            ..solid(shape)
        };
        let cube = turned(SolidShape::Box {
            half_length: m(half.x),
            half_width: m(half.y),
            half_height: m(half.z),
        });
        let hull = turned(SolidShape::Hull {
            points: points.clone().into(),
        });
        let mesh = turned(SolidShape::Mesh {
            points: points.into(),
            triangles: faces.into(),
        });
        let mut chance = Stream::new(1, "distance", "points");
        for _ in 0..200 {
            let point = DVec3::new(1.0, 2.0, 3.0) + chance.in_ball(5.0);
            let point = point.to_array();
            let want = distance(&cube, point);
            let of_hull = distance(&hull, point);
            assert!(
                of_hull <= want * (1.0 + 1e-5) + 1e-9
                    && of_hull >= want - 0.01 * 2.0 * half.length(),
                "{point:?}: {of_hull} {want}"
            );
            if want > 1e-9 {
                let of_mesh = distance(&mesh, point);
                assert!((of_mesh - want).abs() < 1e-9, "{point:?}: {of_mesh} {want}");
            }
        }
    }

    #[test]
    fn bounds_hold_what_is_near() {
        let shapes = [
            SolidShape::Box {
                half_length: m(1.0),
                half_width: m(0.2),
                half_height: m(0.5),
            },
            SolidShape::Capsule {
                radius: m(0.3),
                half_height: m(1.0),
            },
            SolidShape::Cone {
                radius: m(0.7),
                half_height: m(0.6),
            },
        ];
        let mut chance = Stream::new(1, "distance", "bounds");
        for shape in shapes {
            let solid = Solid {
                attitude: Attitude::from_wxyz(0.9, 0.2, -0.4, 0.1).expect("a turn"),
                ..solid(shape)
            };
            let piece = &pieces(&solid)[0];
            let [low, high] = piece.bounds();
            let mut inside = 0;
            for _ in 0..2_000 {
                let p = chance.in_ball(2.0);
                if piece.is_closer(p, 1e-9) {
                    inside += 1;
                    assert!(p.cmpge(low).all() && p.cmple(high).all(), "{p}");
                }
            }
            assert!(inside > 10);
        }
    }
}
