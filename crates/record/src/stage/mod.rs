//! What stands in the world, as something to be drawn: the same for a page, a plot, a picture and a recording.
//!
//! A [`World`](simbeeotic_model::world::World) says what things are; a [`Stage`] says what they look like: primitives and triangles with
//! colours. Recordings carry it (`/world`), so a replay needs no world file.

mod bounds;
mod of;
mod points;
mod textures;
mod thin;
mod triangles;

pub use of::pieces_of;
pub use textures::{TEXTURE_BYTES_MAX, TEXTURES, textures};
pub use triangles::Triangles;

use simbeeotic_model::units::glam::{DQuat, DVec3};
use std::sync::Arc;

/// Everything that stands still in a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stage {
    /// The colour of the plane `z = 0`: red, green, blue, opacity, 0 to 255 each.
    pub ground: [u8; 4],
    /// The picture on that plane: the name of a texture as in [`Prop::texture`]; empty for none.
    pub texture: String,
    /// How far the world reaches from the origin, m. It bounds views, not flight.
    pub radius_m: f64,
    /// Whether `z = 0` is solid ground, as it is where there is no terrain.
    pub plane: bool,
    /// The things, in the order of [`World::objects`](simbeeotic_model::world::World::objects), then lamps and sources of gas.
    pub props: Vec<Prop>,
}

/// One thing of a [`Stage`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prop {
    /// What it is: `obstacle`, `structure`, `flower`, `person`, `terrain`, `light`, `source`.
    pub kind: String,
    /// What it is called; may be empty.
    pub label: String,
    /// Red, green, blue, opacity, 0 to 255 each.
    pub color: [u8; 4],
    /// The texture: the name of a built-in one (`brick`), or the path of a file as the world has it; empty for none.
    /// The file's bytes are those of [`textures`], or the attachment `textures/` and this name.
    pub texture: String,
    /// What it is made of.
    pub pieces: Vec<Piece>,
    /// What is written on it.
    pub meta: Vec<(String, String)>,
}

/// One primitive, standing somewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its outline, in its own frame.
    pub form: Form,
    /// Where its origin is: in the world (ENU) for a [`Prop`], in the body (FLU) for a vehicle, m.
    pub position_m: [f64; 3],
    /// The unit quaternion `w, x, y, z` that turns vectors of its frame into those of world or body.
    pub attitude: [f64; 4],
}

/// The outline of a [`Piece`]: `z` up, the middle at the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum Form {
    /// A box.
    Box {
        /// Half the size along `x`, `y`, `z`, m.
        half_m: [f64; 3],
    },
    /// A ball.
    Sphere {
        /// Its radius, m.
        radius_m: f64,
    },
    /// An upright cylinder, or a cone.
    Cylinder {
        /// The radius at its foot, m.
        radius_m: f64,
        /// The radius at its top, m: 0 for a cone.
        top_m: f64,
        /// Half its height, m.
        half_height_m: f64,
    },
    /// An upright cylinder with a half ball at each end.
    Capsule {
        /// Its radius, m.
        radius_m: f64,
        /// Half the height of the cylinder alone, m.
        half_height_m: f64,
    },
    /// Triangles.
    Mesh {
        /// Corners, m.
        points_m: Arc<[[f32; 3]]>,
        /// Three corners each, counter-clockwise seen from outside, as places in `points_m`.
        triangles: Arc<[[u32; 3]]>,
    },
}

impl Piece {
    /// A form at the origin, not turned.
    pub fn at_origin(form: Form) -> Self {
        Self::new(form, [0.0; 3], DQuat::IDENTITY)
    }

    /// A form somewhere; `turn` takes vectors of its frame to those of world or body.
    pub(crate) fn new(form: Form, position_m: [f64; 3], turn: DQuat) -> Self {
        Self {
            form,
            position_m,
            attitude: [turn.w, turn.x, turn.y, turn.z],
        }
    }

    pub(crate) fn origin(&self) -> DVec3 {
        DVec3::from_array(self.position_m)
    }

    /// Its attitude as a rotation; none if it is no unit quaternion.
    pub(crate) fn turn(&self) -> DQuat {
        let [w, x, y, z] = self.attitude;
        let turn = DQuat::from_xyzw(x, y, z, w);
        let unit = (turn.length_squared() - 1.0).abs() < 1e-3;
        if unit { turn } else { DQuat::IDENTITY }
    }
}

impl From<Triangles> for Form {
    fn from(surface: Triangles) -> Self {
        Form::Mesh {
            points_m: surface.points_m,
            triangles: surface.triangles,
        }
    }
}
