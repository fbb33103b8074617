//! Shapes of points: hulls and meshes, given point by point or by a file.
//!
//! A world that names a file holds only its name until whoever read the world reads the file too and
//! fills in points and triangles; this crate reads no files.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::Offset;
use std::sync::Arc;

/// The smallest convex body that holds some points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Hull {
    /// A file of a mesh whose points they are, instead of `points`; see [`Mesh::file`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// How many metres one unit of the file is. Above 0; 1 if left out.
    #[serde(skip_serializing_if = "is_one")]
    pub scale: f64,
    /// Which axis of the file points up; that of its format if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub up: Option<UpAxis>,
    /// Four points or more, not all in one plane.
    #[serde(with = "list", skip_serializing_if = "none_of")]
    #[schemars(with = "Vec<Offset>")]
    pub points: Arc<[Offset]>,
}

/// A surface of triangles: solid where it is, hollow inside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Mesh {
    /// A file that holds it, instead of `points` and `triangles`: STL, OBJ or glTF (`.gltf`, `.glb`),
    /// relative to the world file. `None` once it is read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// How many metres one unit of the file is. Above 0; 1 if left out.
    #[serde(skip_serializing_if = "is_one")]
    pub scale: f64,
    /// Which axis of the file points up. If left out that of its format: `z` for STL, `y` for OBJ
    /// and glTF.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub up: Option<UpAxis>,
    /// Corners of triangles.
    #[serde(with = "list", skip_serializing_if = "none_of")]
    #[schemars(with = "Vec<Offset>")]
    pub points: Arc<[Offset]>,
    /// Three corners each, counter-clockwise seen from outside, as places in `points`, from 0.
    #[serde(with = "list", skip_serializing_if = "none_of")]
    #[schemars(with = "Vec<[u32; 3]>")]
    pub triangles: Arc<[[u32; 3]]>,
}

/// An axis of a file that points up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UpAxis {
    /// The file's `y` is up, its `z` is south: `x` stays east.
    Y,
    /// The file's axes are the world's.
    Z,
}

impl UpAxis {
    /// A point of a file in our axes.
    pub fn turn(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Y => [x, -z, y],
            Self::Z => [x, y, z],
        }
    }
}

impl Default for Hull {
    fn default() -> Self {
        Self {
            file: None,
            scale: 1.0,
            up: None,
            points: Arc::new([]),
        }
    }
}

impl Default for Mesh {
    fn default() -> Self {
        Self {
            file: None,
            scale: 1.0,
            up: None,
            points: Arc::new([]),
            triangles: Arc::new([]),
        }
    }
}

fn is_one(scale: &f64) -> bool {
    *scale == 1.0
}

fn none_of<T>(list: &Arc<[T]>) -> bool {
    list.is_empty()
}

/// Shared lists in files.
mod list {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};
    use std::sync::Arc;

    pub(super) fn serialize<S: Serializer, T: Serialize>(
        list: &Arc<[T]>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        (**list).serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
        deserializer: D,
    ) -> Result<Arc<[T]>, D::Error> {
        Vec::deserialize(deserializer).map(Arc::from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_points_up_in_the_file_points_up_here_and_hands_stay_right() {
        let up = UpAxis::Y.turn([0.0, 1.0, 0.0]);
        assert_eq!(up, [0.0, 0.0, 1.0]);
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
            .map(|axis| glam::DVec3::from_array(UpAxis::Y.turn(axis)));
        assert_eq!(x.cross(y), z);
        assert_eq!(UpAxis::Z.turn([1.0, 2.0, 3.0]), [1.0, 2.0, 3.0]);
    }
}
