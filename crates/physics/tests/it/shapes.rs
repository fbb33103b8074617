//! Shapes drawn at random, and a measure of their distance that owes nothing to the engine's own: parry's,
//! piece by piece.

use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query;
use parry3d_f64::shape::SharedShape;
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_physics::{HeightField, Hull, Mesh, Motion, Part, Shape};
use simbeeotic_units::Attitude;
use simbeeotic_units::glam::{DQuat, DVec2, DVec3};
use std::sync::Arc;

/// Kinds of shapes: those of bodies that may move freely, and those of fixed ones alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    Sphere,
    Box,
    Cylinder,
    Cone,
    Capsule,
    Hull,
    Compound,
    Mesh,
    HeightField,
    Plane,
}

pub(crate) const FREE: [Kind; 7] = [
    Kind::Sphere,
    Kind::Box,
    Kind::Cylinder,
    Kind::Cone,
    Kind::Capsule,
    Kind::Hull,
    Kind::Compound,
];

/// All but the plane, which has no place of its own.
pub(crate) const BOUNDED: [Kind; 9] = [
    Kind::Sphere,
    Kind::Box,
    Kind::Cylinder,
    Kind::Cone,
    Kind::Capsule,
    Kind::Hull,
    Kind::Compound,
    Kind::Mesh,
    Kind::HeightField,
];

pub(crate) fn attitude(stream: &mut Stream) -> Attitude {
    let axis = stream.unit_vector();
    let (sin, cos) = libm::sincos(stream.uniform_in(0.0..std::f64::consts::PI));
    let v = axis * sin;
    Attitude::from_unit_quat(DQuat::from_xyzw(v.x, v.y, v.z, cos))
}

/// Twelve points about the origin: no four in one plane, but for accidents that do not happen.
fn cloud(stream: &mut Stream, size: f64) -> Vec<DVec3> {
    (0..12)
        .map(|_| stream.unit_vector() * stream.uniform_in(0.5 * size..size))
        .collect()
}

fn octahedron(size: f64) -> Mesh {
    let points_m = [DVec3::X, DVec3::Y, DVec3::Z]
        .into_iter()
        .flat_map(|axis| [axis * size, axis * -size])
        .collect();
    let mut triangles = Vec::new();
    for (x, y, z) in (0..8).map(|k| (k & 1, k >> 1 & 1, k >> 2)) {
        let corner = [x, 2 + y, 4 + z];
        let outward = (x + y + z) % 2 == 0;
        triangles.push(if outward {
            corner
        } else {
            [corner[0], corner[2], corner[1]]
        });
    }
    Mesh {
        points_m,
        triangles,
    }
}

/// A shape of this kind, of about `size` from its middle to its edge.
pub(crate) fn shape(kind: Kind, size: f64, stream: &mut Stream) -> Shape {
    let mut some = || size * stream.uniform_in(0.3..0.7);
    match kind {
        Kind::Sphere => Shape::Sphere { radius_m: some() },
        Kind::Box => Shape::Box {
            half_m: DVec3::new(some(), some(), some()),
        },
        Kind::Cylinder => Shape::Cylinder {
            radius_m: some(),
            half_height_m: some(),
        },
        Kind::Cone => Shape::Cone {
            radius_m: some(),
            half_height_m: some(),
        },
        Kind::Capsule => Shape::Capsule {
            radius_m: some(),
            half_height_m: some(),
        },
        Kind::Hull => Shape::Hull(Arc::new(Hull {
            points_m: cloud(stream, 0.8 * size),
        })),
        Kind::Compound => {
            let part = |x: f64, shape| Part {
                offset_m: DVec3::new(x, 0.0, 0.0),
                attitude: Attitude::IDENTITY,
                shape,
            };
            let (left, right) = (some(), some());
            Shape::Compound(Arc::new([
                part(
                    -0.5 * size,
                    Shape::Sphere {
                        radius_m: 0.6 * left,
                    },
                ),
                part(
                    0.4 * size,
                    Shape::Box {
                        half_m: DVec3::new(0.5 * right, right, 0.4 * left),
                    },
                ),
            ]))
        }
        Kind::Mesh => Shape::Mesh(Arc::new(octahedron(size))),
        Kind::HeightField => Shape::HeightField(Arc::new(HeightField {
            size_m: DVec2::new(1.4, 1.2) * size,
            columns: 6,
            heights_m: (0..30)
                .map(|_| stream.uniform_in(0.0..0.3 * size))
                .collect(),
        })),
        Kind::Plane => Shape::Plane,
    }
}

fn to_parry(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

pub(crate) fn to_pose(p: DVec3, q: DQuat) -> Pose {
    Pose::from_parts(to_parry(p), Rotation::from_xyzw(q.x, q.y, q.z, q.w))
}

/// A shape as parry's, in pieces.
pub(crate) struct Solid {
    pub(crate) pieces: Vec<(Pose, SharedShape)>,
    pub(crate) radius_m: f64,
    /// About each piece.
    balls: Vec<(Vector, f64)>,
}

/// Parry's axis of revolution is y, ours z.
fn upright(at: Pose) -> Pose {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    at * to_pose(DVec3::ZERO, DQuat::from_xyzw(half, 0.0, 0.0, half))
}

fn pieces(shape: &Shape, free: bool, at: Pose, found: &mut Vec<(Pose, SharedShape)>) {
    let triangle = |[a, b, c]: [DVec3; 3]| {
        (
            at,
            SharedShape::triangle(to_parry(a), to_parry(b), to_parry(c)),
        )
    };
    let hull = |points: &[DVec3]| {
        let points: Vec<_> = points.iter().copied().map(to_parry).collect();
        SharedShape::convex_hull(&points).expect("a hull")
    };
    match shape {
        Shape::Sphere { radius_m } => found.push((at, SharedShape::ball(*radius_m))),
        Shape::Box { half_m } => {
            found.push((at, SharedShape::cuboid(half_m.x, half_m.y, half_m.z)));
        }
        Shape::Cylinder {
            radius_m,
            half_height_m,
        } => found.push((
            upright(at),
            SharedShape::cylinder(*half_height_m, *radius_m),
        )),
        Shape::Cone {
            radius_m,
            half_height_m,
        } => found.push((upright(at), SharedShape::cone(*half_height_m, *radius_m))),
        Shape::Capsule {
            radius_m,
            half_height_m,
        } => found.push((at, SharedShape::capsule_z(*half_height_m, *radius_m))),
        Shape::Plane => found.push((at, SharedShape::halfspace(Vector::Z))),
        Shape::Hull(points) => found.push((at, hull(&points.points_m))),
        Shape::Mesh(mesh) if free => found.push((at, hull(&mesh.points_m))),
        Shape::Mesh(mesh) => {
            let corners = |t: &[u32; 3]| triangle(t.map(|k| mesh.points_m[k as usize]));
            found.extend(mesh.triangles.iter().map(corners));
        }
        Shape::HeightField(field) => {
            let (columns, rows) = (field.columns, field.rows());
            let point = |row: usize, column: usize| {
                let across = column as f64 / (columns - 1) as f64 - 0.5;
                let along = row as f64 / (rows - 1) as f64 - 0.5;
                (field.size_m * DVec2::new(across, along))
                    .extend(field.heights_m[row * columns + column])
            };
            for (row, column) in
                (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| (row, column)))
            {
                let (sw, ne) = (point(row, column), point(row + 1, column + 1));
                found.push(triangle([sw, ne, point(row + 1, column)]));
                found.push(triangle([sw, point(row, column + 1), ne]));
            }
        }
        Shape::Compound(parts) => {
            for part in parts.iter() {
                let place = at * to_pose(part.offset_m, part.attitude.quat());
                pieces(&part.shape, free, place, found);
            }
        }
        other => unreachable!("{other:?}"),
    }
}

impl Solid {
    /// `free`: of a body that moves freely, so that a mesh counts as its hull.
    pub(crate) fn new(shape: &Shape, free: bool) -> Self {
        let mut found = Vec::new();
        pieces(shape, free, Pose::IDENTITY, &mut found);
        let ball = |(pose, piece): &(Pose, SharedShape)| {
            if piece.as_halfspace().is_some() {
                return (Vector::ZERO, f64::INFINITY);
            }
            let ball = piece.compute_bounding_sphere(pose);
            (ball.center, ball.radius)
        };
        Self {
            balls: found.iter().map(ball).collect(),
            pieces: found,
            radius_m: shape.bounding_radius_m(),
        }
    }

    /// Distance between two solids, m; where they overlap, the depth, negative. Nothing is said of
    /// those whose bounding balls are a centimetre apart.
    pub(crate) fn gap(&self, at: (DVec3, DQuat), other: &Self, other_at: (DVec3, DQuat)) -> f64 {
        let between = other_at.0 - at.0;
        let balls = between.length() - self.radius_m - other.radius_m;
        if balls > 0.01 {
            return f64::INFINITY;
        }
        // Relative to one of the two, which may be far from the origin.
        let here = to_pose(DVec3::ZERO, at.1);
        let there = to_pose(between, other_at.1);
        let mut least = f64::INFINITY;
        for ((pose, piece), (centre, radius)) in self.pieces.iter().zip(&self.balls) {
            for ((other_pose, other_piece), ball) in other.pieces.iter().zip(&other.balls) {
                let way = (there * ball.0 - here * *centre).length();
                if way - radius - ball.1 > 0.01 {
                    continue;
                }
                least = least.min(piece_gap(
                    &(here * *pose),
                    piece,
                    &(there * *other_pose),
                    other_piece,
                ));
            }
        }
        least
    }
}

fn piece_gap(at: &Pose, piece: &SharedShape, other_at: &Pose, other: &SharedShape) -> f64 {
    let apart = query::distance(at, &**piece, other_at, &**other)
        .expect("parry knows all pairs")
        .distance;
    if apart > 0.0 {
        return apart;
    }
    let contact = query::contact(at, &**piece, other_at, &**other, 0.0);
    contact
        .expect("parry knows all pairs")
        .map_or(0.0, |contact| contact.dist.min(0.0))
}

/// Where a motion has its body at `t`.
pub(crate) fn place(motion: &Motion, t: SimTime) -> (DVec3, DQuat) {
    (motion.position(t), motion.attitude(t))
}
