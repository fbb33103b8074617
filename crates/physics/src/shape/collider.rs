//! A shape as a collider of rapier.

use super::convert::{to_parry, to_pose};
use super::form::Place;
use super::hull::{Polytope, hull};
use super::{HeightField, Part, Shape};
use glam::{DQuat, DVec3};
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::shape::{ConvexPolyhedron, SharedShape};
use parry3d_f64::utils::Array2;

/// Turns parry's axis of revolution, y, to ours, z.
const BODY_FROM_LATHE: DQuat = DQuat::from_xyzw(
    std::f64::consts::FRAC_1_SQRT_2,
    0.0,
    0.0,
    std::f64::consts::FRAC_1_SQRT_2,
);

fn upright() -> Pose {
    to_pose(Place {
        p: DVec3::ZERO,
        q: BODY_FROM_LATHE,
    })
}

fn vectors(points: &[DVec3]) -> Vec<Vector> {
    points.iter().copied().map(to_parry).collect()
}

/// A convex hull, for parry.
pub(super) fn polyhedron(hull: &Polytope) -> Option<ConvexPolyhedron> {
    let points = vectors(&hull.points);
    ConvexPolyhedron::from_convex_mesh(points.clone(), &hull.triangles)
        .or_else(|| ConvexPolyhedron::from_convex_hull(&points))
}

fn solid(points: &[DVec3]) -> SharedShape {
    match hull(points).as_ref().and_then(polyhedron) {
        Some(polyhedron) => SharedShape::new(polyhedron),
        // No shape that was checked gets here.
        None => SharedShape::ball(f64::MIN_POSITIVE),
    }
}

fn height_field(field: &HeightField) -> SharedShape {
    let rows = field.rows();
    let mut heights = Array2::zeros(rows, field.columns);
    for row in 0..rows {
        for column in 0..field.columns {
            // Parry's rows go along its z, which is our -y.
            heights[(rows - 1 - row, column)] = field.heights_m[row * field.columns + column];
        }
    }
    SharedShape::heightfield(heights, Vector::new(field.size_m.x, 1.0, field.size_m.y))
}

/// Appends all parts of a compound, none of which parry may find to be many itself.
fn flatten(parts: &[Part], at: Place, free: bool, found: &mut Vec<(Pose, SharedShape)>) {
    for part in parts {
        let place = at.then(part.place());
        let mut triangle = |[a, b, c]: [DVec3; 3]| {
            let [a, b, c] = [a, b, c].map(to_parry);
            found.push((to_pose(place), SharedShape::triangle(a, b, c)));
        };
        match &part.shape {
            Shape::Compound(parts) => flatten(parts, place, free, found),
            Shape::Mesh(mesh) if !free => {
                for corners in &mesh.triangles {
                    triangle(mesh.corners(*corners));
                }
            }
            Shape::HeightField(field) => field.cells().flatten().for_each(triangle),
            shape => {
                let (collider, pose) = collider(shape, free);
                found.push((to_pose(place) * pose, collider));
            }
        }
    }
}

/// The collider of a checked shape, and its pose in the body.
pub(super) fn collider(shape: &Shape, free: bool) -> (SharedShape, Pose) {
    match shape {
        Shape::Sphere { radius_m } => (SharedShape::ball(*radius_m), Pose::IDENTITY),
        Shape::Box { half_m } => {
            let half = *half_m;
            (SharedShape::cuboid(half.x, half.y, half.z), Pose::IDENTITY)
        }
        Shape::Cylinder {
            radius_m,
            half_height_m,
        } => (SharedShape::cylinder(*half_height_m, *radius_m), upright()),
        Shape::Cone {
            radius_m,
            half_height_m,
        } => (SharedShape::cone(*half_height_m, *radius_m), upright()),
        Shape::Capsule {
            radius_m,
            half_height_m,
        } => (
            SharedShape::capsule_z(*half_height_m, *radius_m),
            Pose::IDENTITY,
        ),
        Shape::Plane => (SharedShape::halfspace(Vector::Z), Pose::IDENTITY),
        Shape::Hull(hull) => (solid(&hull.points_m), Pose::IDENTITY),
        Shape::Mesh(mesh) if free => (solid(&mesh.points_m), Pose::IDENTITY),
        Shape::Mesh(mesh) => {
            let made = SharedShape::trimesh(vectors(&mesh.points_m), mesh.triangles.clone());
            (
                made.unwrap_or_else(|_| solid(&mesh.points_m)),
                Pose::IDENTITY,
            )
        }
        Shape::HeightField(field) => (height_field(field), upright()),
        Shape::Compound(parts) => {
            let mut found = Vec::new();
            flatten(parts, Place::IDENTITY, free, &mut found);
            (SharedShape::compound(found), Pose::IDENTITY)
        }
    }
}
