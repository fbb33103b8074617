//! Foxglove's messages of things that stand somewhere, and of points; and those of ours that use them.
//!
//! Of a `foxglove.SceneEntity` only what is written here: no arrows, lines, texts, models.

use super::{Pose, Timestamp, Vector3};
use prost::Message;

/// `foxglove.Color`: each 0 to 1.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Color {
    #[prost(double, tag = "1")]
    pub(crate) r: f64,
    #[prost(double, tag = "2")]
    pub(crate) g: f64,
    #[prost(double, tag = "3")]
    pub(crate) b: f64,
    #[prost(double, tag = "4")]
    pub(crate) a: f64,
}

/// `foxglove.KeyValuePair`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct KeyValue {
    #[prost(string, tag = "1")]
    pub(crate) key: String,
    #[prost(string, tag = "2")]
    pub(crate) value: String,
}

/// `foxglove.CubePrimitive`, and `foxglove.SpherePrimitive`, which has the same fields.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Cube {
    #[prost(message, optional, tag = "1")]
    pub(crate) pose: Option<Pose>,
    #[prost(message, optional, tag = "2")]
    pub(crate) size: Option<Vector3>,
    #[prost(message, optional, tag = "3")]
    pub(crate) color: Option<Color>,
}

/// `foxglove.CylinderPrimitive`: `size` is the box around it; the scales are the widths of its ends in it.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Cylinder {
    #[prost(message, optional, tag = "1")]
    pub(crate) pose: Option<Pose>,
    #[prost(message, optional, tag = "2")]
    pub(crate) size: Option<Vector3>,
    #[prost(double, tag = "3")]
    pub(crate) bottom_scale: f64,
    #[prost(double, tag = "4")]
    pub(crate) top_scale: f64,
    #[prost(message, optional, tag = "5")]
    pub(crate) color: Option<Color>,
}

/// `foxglove.TriangleListPrimitive`. `foxglove.Point3` has the fields of a vector.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct TriangleList {
    #[prost(message, optional, tag = "1")]
    pub(crate) pose: Option<Pose>,
    #[prost(message, repeated, tag = "2")]
    pub(crate) points: Vec<Vector3>,
    #[prost(message, optional, tag = "3")]
    pub(crate) color: Option<Color>,
    #[prost(fixed32, repeated, tag = "5")]
    pub(crate) indices: Vec<u32>,
}

/// `foxglove.SceneEntity`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct SceneEntity {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub(crate) frame_id: String,
    #[prost(string, tag = "3")]
    pub(crate) id: String,
    #[prost(message, repeated, tag = "6")]
    pub(crate) metadata: Vec<KeyValue>,
    #[prost(message, repeated, tag = "8")]
    pub(crate) cubes: Vec<Cube>,
    #[prost(message, repeated, tag = "9")]
    pub(crate) spheres: Vec<Cube>,
    #[prost(message, repeated, tag = "10")]
    pub(crate) cylinders: Vec<Cylinder>,
    #[prost(message, repeated, tag = "12")]
    pub(crate) triangles: Vec<TriangleList>,
}

/// `foxglove.SceneUpdate`, without deletions.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct SceneUpdate {
    #[prost(message, repeated, tag = "2")]
    pub(crate) entities: Vec<SceneEntity>,
}

/// `foxglove.PackedElementField`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct PackedField {
    #[prost(string, tag = "1")]
    pub(crate) name: String,
    #[prost(fixed32, tag = "2")]
    pub(crate) offset: u32,
    /// An enum in the schema: 1 is a byte, 7 a float.
    #[prost(int32, tag = "3")]
    pub(crate) r#type: i32,
}

/// `foxglove.PointCloud`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct PointCloud {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub(crate) frame_id: String,
    #[prost(message, optional, tag = "3")]
    pub(crate) pose: Option<Pose>,
    #[prost(fixed32, tag = "4")]
    pub(crate) point_stride: u32,
    #[prost(message, repeated, tag = "5")]
    pub(crate) fields: Vec<PackedField>,
    #[prost(bytes = "vec", tag = "6")]
    pub(crate) data: Vec<u8>,
}

/// `simbeeotic.Vehicles`: who flies; the order is the order of every tick. `look` are places in `looks`, whose frame
/// is the body's.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Vehicles {
    #[prost(string, repeated, tag = "1")]
    pub(crate) paths: Vec<String>,
    #[prost(string, repeated, tag = "2")]
    pub(crate) kinds: Vec<String>,
    #[prost(double, repeated, tag = "3")]
    pub(crate) radius_m: Vec<f64>,
    #[prost(string, repeated, tag = "4")]
    pub(crate) roles: Vec<String>,
    /// `0xrrggbbaa`
    #[prost(fixed32, repeated, tag = "5")]
    pub(crate) colors_rgba: Vec<u32>,
    #[prost(int32, repeated, tag = "6")]
    pub(crate) look: Vec<i32>,
    #[prost(message, repeated, tag = "7")]
    pub(crate) looks: Vec<SceneEntity>,
}

/// `simbeeotic.About`: what some models are that are alike.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct About {
    #[prost(string, repeated, tag = "1")]
    pub(crate) models: Vec<String>,
    #[prost(message, repeated, tag = "2")]
    pub(crate) parts: Vec<AboutPart>,
    #[prost(message, repeated, tag = "3")]
    pub(crate) sensors: Vec<AboutSensor>,
    #[prost(string, repeated, tag = "4")]
    pub(crate) radios: Vec<String>,
}

/// `simbeeotic.AboutPart`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct AboutPart {
    #[prost(string, tag = "1")]
    pub(crate) place: String,
    #[prost(string, tag = "2")]
    pub(crate) name: String,
    #[prost(message, repeated, tag = "3")]
    pub(crate) parameters: Vec<KeyValue>,
}

/// `simbeeotic.AboutSensor`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct AboutSensor {
    #[prost(string, tag = "1")]
    pub(crate) name: String,
    #[prost(message, optional, tag = "2")]
    pub(crate) mount: Option<Pose>,
    #[prost(message, optional, tag = "3")]
    pub(crate) beams: Option<AboutBeams>,
}

/// `simbeeotic.AboutBeams`: `kind` is `rays`, `cone`, `frustum` or `ball`, and says what else is filled.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct AboutBeams {
    #[prost(string, tag = "1")]
    pub(crate) kind: String,
    #[prost(double, tag = "2")]
    pub(crate) range_m: f64,
    /// Three numbers each.
    #[prost(double, repeated, tag = "3")]
    pub(crate) directions: Vec<f64>,
    #[prost(double, tag = "4")]
    pub(crate) half_angle_rad: f64,
    #[prost(double, tag = "5")]
    pub(crate) horizontal_rad: f64,
    #[prost(double, tag = "6")]
    pub(crate) vertical_rad: f64,
}
