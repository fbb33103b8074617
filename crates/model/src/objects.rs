//! The objects of a world as bodies that nothing moves.

use simbeeotic_physics::{
    BodyError, BodySpec, Config, HeightField, Hull, Kind, Material, Mesh, Mobility, Physics, Shape,
    group,
};
use simbeeotic_units::{Length, Offset, glam};
use simbeeotic_world::{Object, ObjectKind, Solid, SolidShape};
use std::sync::Arc;

/// The bodies that an object is made of, one for each of its solids. They bounce off everything
/// whose mask includes their group: [`group::FLOWER`] for flowers, [`group::TERRAIN`] for the rest,
/// as in the original. For those who look, each is of its own kind.
pub fn bodies<'a>(object: &'a Object<'_>) -> impl Iterator<Item = BodySpec> + 'a {
    let group = match object.id.kind {
        ObjectKind::Flower => group::FLOWER,
        _ => group::TERRAIN,
    };
    let kind = match object.id.kind {
        ObjectKind::Structure => Kind::Structure,
        ObjectKind::Flower => Kind::Flower,
        ObjectKind::Person => Kind::Person,
        ObjectKind::Terrain => Kind::Terrain,
        _ => Kind::Obstacle,
    };
    let material = Material {
        friction: object.surface.friction,
        restitution: object.surface.restitution,
    };
    object.solids.iter().map(move |solid| BodySpec {
        p_enu: solid.center.si(),
        attitude: solid.attitude,
        // Nobody can push it: mass and moments mean nothing.
        inertia_kg_m2: glam::DVec3::ONE,
        mobility: Mobility::Fixed,
        material,
        group,
        kind: Some(kind),
        ..BodySpec::new(shape(solid), 1.0)
    })
}

/// Whether physics takes a solid that passes [`World::check`](simbeeotic_world::World::check) as the
/// shape of an object. Only shapes of points can fail.
///
/// # Errors
/// What is wrong with it: a hull without volume, say.
pub fn check(solid: &Solid) -> Result<(), BodyError> {
    match solid.shape {
        SolidShape::Hull { .. } | SolidShape::Mesh { .. } | SolidShape::HeightField { .. } => {}
        _ => return Ok(()),
    }
    let body = BodySpec {
        inertia_kg_m2: glam::DVec3::ONE,
        mobility: Mobility::Fixed,
        ..BodySpec::new(shape(solid), 1.0)
    };
    Physics::new(Config::default()).add(body).map(drop)
}

/// The shape that physics gives a solid of the world.
pub fn shape(solid: &Solid) -> Shape {
    match &solid.shape {
        SolidShape::Box {
            half_length,
            half_width,
            half_height,
        } => Shape::Box {
            half_m: glam::DVec3::new(half_length.get(), half_width.get(), half_height.get()),
        },
        SolidShape::Cylinder {
            radius,
            half_height,
        } => Shape::Cylinder {
            radius_m: radius.get(),
            half_height_m: half_height.get(),
        },
        SolidShape::Sphere { radius } => Shape::Sphere {
            radius_m: radius.get(),
        },
        SolidShape::Cone {
            radius,
            half_height,
        } => Shape::Cone {
            radius_m: radius.get(),
            half_height_m: half_height.get(),
        },
        SolidShape::Capsule {
            radius,
            half_height,
        } => Shape::Capsule {
            radius_m: radius.get(),
            half_height_m: half_height.get(),
        },
        SolidShape::Hull { points } => Shape::Hull(Arc::new(Hull {
            points_m: metres(points),
        })),
        SolidShape::Mesh { points, triangles } => Shape::Mesh(Arc::new(Mesh {
            points_m: metres(points),
            triangles: triangles.to_vec(),
        })),
        SolidShape::HeightField {
            length,
            width,
            columns,
            heights,
        } => Shape::HeightField(Arc::new(HeightField {
            size_m: glam::DVec2::new(length.get(), width.get()),
            columns: *columns,
            heights_m: heights.iter().copied().map(Length::get).collect(),
        })),
    }
}

fn metres(points: &[Offset]) -> Vec<glam::DVec3> {
    points.iter().map(|point| point.si()).collect()
}
