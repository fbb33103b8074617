//! What stands in the world, as something to be drawn: the same for a page, a plot, a picture and a recording.
//!
//! A [`World`] says what things are; a [`Stage`] says what they look like: primitives and triangles with
//! colours. Recordings carry it (`/world`), so a replay needs no world file.

mod of;

pub use of::pieces_of;

use std::sync::Arc;

/// Everything that stands still in a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stage {
    /// The colour of the plane `z = 0`: red, green, blue, opacity, 0 to 255 each.
    pub ground: [u8; 4],
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
    /// The texture: the name of a built-in one (`brick`), or of an attached file; empty for none.
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
        Self {
            form,
            position_m: [0.0; 3],
            attitude: [1.0, 0.0, 0.0, 0.0],
        }
    }
}
