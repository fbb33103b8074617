//! From worlds and bodies to what they look like.

use super::{Form, Piece, Prop, Stage};
use simbeeotic_model::physics::Shape;
use simbeeotic_model::units::Length;
use simbeeotic_model::world::{Color, SolidShape, Texture, World};

impl Stage {
    /// What a world looks like. `seed` decides where flowers stand, as in a run.
    pub fn of(world: &World, seed: u64) -> Self {
        let props = world.objects(seed).into_iter().map(|object| Prop {
            kind: object.id.kind.name().to_owned(),
            label: object.label.to_owned(),
            color: rgba(object.color),
            texture: object.texture.map(name_of).unwrap_or_default(),
            pieces: object.solids.iter().filter_map(piece).collect(),
            meta: object.meta.clone().into_iter().collect(),
        });
        Self {
            ground: rgba(world.ground.color),
            radius_m: world.radius.get(),
            plane: world.terrain.is_none(),
            props: props.collect(),
        }
    }
}

/// What a body looks like, in its own frame (FLU).
pub fn pieces_of(shape: &Shape) -> Vec<Piece> {
    let form = match shape {
        Shape::Sphere { radius_m } => Form::Sphere {
            radius_m: *radius_m,
        },
        Shape::Box { half_m } => Form::Box {
            half_m: half_m.to_array(),
        },
        Shape::Cylinder {
            radius_m,
            half_height_m,
        } => Form::Cylinder {
            radius_m: *radius_m,
            top_m: *radius_m,
            half_height_m: *half_height_m,
        },
        Shape::Cone {
            radius_m,
            half_height_m,
        } => Form::Cylinder {
            radius_m: *radius_m,
            top_m: 0.0,
            half_height_m: *half_height_m,
        },
        Shape::Capsule {
            radius_m,
            half_height_m,
        } => Form::Capsule {
            radius_m: *radius_m,
            half_height_m: *half_height_m,
        },
        _ => return Vec::new(),
    };
    vec![Piece::at_origin(form)]
}

fn piece(solid: &simbeeotic_model::world::Solid) -> Option<Piece> {
    let m = |length: &Length| length.get();
    let form = match &solid.shape {
        SolidShape::Box {
            half_length,
            half_width,
            half_height,
        } => Form::Box {
            half_m: [m(half_length), m(half_width), m(half_height)],
        },
        SolidShape::Cylinder {
            radius,
            half_height,
        } => Form::Cylinder {
            radius_m: m(radius),
            top_m: m(radius),
            half_height_m: m(half_height),
        },
        SolidShape::Sphere { radius } => Form::Sphere {
            radius_m: m(radius),
        },
        SolidShape::Cone {
            radius,
            half_height,
        } => Form::Cylinder {
            radius_m: m(radius),
            top_m: 0.0,
            half_height_m: m(half_height),
        },
        SolidShape::Capsule {
            radius,
            half_height,
        } => Form::Capsule {
            radius_m: m(radius),
            half_height_m: m(half_height),
        },
        SolidShape::Mesh { points, triangles } => Form::Mesh {
            points_m: points.iter().map(|p| p.si().as_vec3().to_array()).collect(),
            triangles: triangles.clone(),
        },
        _ => return None,
    };
    let q = solid.attitude.quat();
    Some(Piece {
        form,
        position_m: solid.center.si().to_array(),
        attitude: [q.w, q.x, q.y, q.z],
    })
}

fn rgba(color: Color) -> [u8; 4] {
    [color.red, color.green, color.blue, color.alpha]
}

fn name_of(texture: &Texture) -> String {
    match texture {
        Texture::Builtin(name) => name.clone(),
        other => format!("{other:?}"),
    }
}
