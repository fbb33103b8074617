//! The primitives that every object is made of.

use crate::look::{Color, Meta, Texture};
use crate::material::Material;
use crate::surface::Surface;
use simbeeotic_units::{Attitude, Length, Offset, Pose, Position};
use std::fmt;
use std::sync::Arc;

/// One primitive, standing somewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Solid {
    /// What it is.
    pub shape: SolidShape,
    /// Where its middle is. For a cone: half way between base and tip; for a hull, a mesh and a
    /// height field: the origin of their points.
    pub center: Position,
    /// How it is turned: from its own frame to the world's.
    pub attitude: Attitude,
}

/// The shape of a [`Solid`], in its own frame: `z` up, the middle at the origin.
#[derive(Clone, Debug, PartialEq)]
pub enum SolidShape {
    /// A box: half its size along `x`, `y` and `z`.
    Box {
        /// Half the size along `x`.
        half_length: Length,
        /// Half the size along `y`.
        half_width: Length,
        /// Half the size along `z`.
        half_height: Length,
    },
    /// An upright cylinder.
    Cylinder {
        /// Its radius.
        radius: Length,
        /// Half its height.
        half_height: Length,
    },
    /// A sphere.
    Sphere {
        /// Its radius.
        radius: Length,
    },
    /// An upright cone, tip up.
    Cone {
        /// The radius of its base.
        radius: Length,
        /// Half its height.
        half_height: Length,
    },
    /// An upright cylinder with a half ball at each end.
    Capsule {
        /// Its radius.
        radius: Length,
        /// Half the height of the cylinder alone.
        half_height: Length,
    },
    /// The smallest convex body that holds some points.
    Hull {
        /// The points.
        points: Arc<[Offset]>,
    },
    /// A surface of triangles.
    Mesh {
        /// Their corners.
        points: Arc<[Offset]>,
        /// Three corners each, counter-clockwise seen from outside, as indices of `points`.
        triangles: Arc<[[u32; 3]]>,
    },
    /// A surface of heights over a regular grid around the origin.
    HeightField {
        /// How far it reaches along `x`.
        length: Length,
        /// How far it reaches along `y`.
        width: Length,
        /// How many heights stand in one row, from west to east.
        columns: usize,
        /// The heights, row after row from south to north.
        heights: Arc<[Length]>,
    },
}

impl Solid {
    /// Its pose: where its own frame stands in the world.
    pub fn pose(&self) -> Pose {
        Pose::new(self.center, self.attitude)
    }

    /// A box that is turned about `pivot`; `low` and `high` are two opposite corners before the turn,
    /// relative to the pivot, in metres.
    pub(crate) fn boxed(
        pivot: Position,
        attitude: Attitude,
        low_m: [f64; 3],
        high_m: [f64; 3],
    ) -> Self {
        let middle = |i: usize| 0.5 * (low_m[i] + high_m[i]);
        let half = |i: usize| Length::si(0.5 * (high_m[i] - low_m[i]));
        let middle = Offset::from_xyz(middle(0), middle(1), middle(2));
        let shape = SolidShape::Box {
            half_length: half(0),
            half_width: half(1),
            half_height: half(2),
        };
        Self {
            shape,
            center: pivot + attitude.rotate(middle),
            attitude,
        }
    }
}

/// What an [`Object`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum ObjectKind {
    /// Something in the way.
    Obstacle,
    /// A wall or a slab.
    Structure,
    /// A flower, or a patch of them.
    Flower,
    /// A person.
    Person,
    /// The uneven ground.
    Terrain,
}

impl ObjectKind {
    /// Its name, as world files have it: `obstacle`, `structure`, `flower`, `person`, `terrain`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Obstacle => "obstacle",
            Self::Structure => "structure",
            Self::Flower => "flower",
            Self::Person => "person",
            Self::Terrain => "terrain",
        }
    }
}

/// Which object of a world it is. It stays the same when objects of other kinds come and go.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectId {
    /// What it is.
    pub kind: ObjectKind,
    /// Which one of its kind, from 0 in the order of the file; for a flower, the index of its patch.
    pub index: u32,
    /// Which flower of its patch; 0 for all else.
    pub item: u32,
}

impl ObjectId {
    /// The object of this kind with this index.
    pub const fn new(kind: ObjectKind, index: u32) -> Self {
        Self {
            kind,
            index,
            item: 0,
        }
    }

    /// Kind, index and item in one number, for traces.
    pub const fn key(self) -> u64 {
        (self.kind as u64 + 1) << 60 ^ (self.index as u64) << 28 ^ self.item as u64
    }
}

/// `obstacle.3`, `flower.0.17`: the path in a world file, as its errors have it.
impl fmt::Display for ObjectId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}", self.kind.name(), self.index)?;
        match self.kind {
            ObjectKind::Flower => write!(f, ".{}", self.item),
            _ => Ok(()),
        }
    }
}

/// One object of the world as primitives, with what is known about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Object<'w> {
    /// Which it is.
    pub id: ObjectId,
    /// What it is called; empty if nothing.
    pub label: &'w str,
    /// Its colour.
    pub color: Color,
    /// Its texture, if it has one.
    pub texture: Option<&'w Texture>,
    /// What is attached to it.
    pub meta: &'w Meta,
    /// How it feels.
    pub surface: Surface,
    /// What it is made of, if that is known.
    pub material: Option<&'w Material>,
    /// What it is made of.
    pub solids: Vec<Solid>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::{Angle, Yaw};

    #[test]
    fn a_box_turns_about_its_pivot_and_not_about_its_middle() {
        let pivot = Position::from_xyz(10.0, 20.0, 0.0);
        let quarter = Attitude::from_yaw(Yaw::new(Angle::from_turns(0.25)));
        let solid = Solid::boxed(pivot, quarter, [0.0, 0.0, 0.0], [4.0, 2.0, 3.0]);
        let center = solid.center.si();
        assert!(
            (center - glam::DVec3::new(9.0, 22.0, 1.5)).length() < 1e-12,
            "{center}"
        );
    }

    #[test]
    fn every_object_has_a_key_of_its_own() {
        let kinds = [
            ObjectKind::Obstacle,
            ObjectKind::Structure,
            ObjectKind::Flower,
            ObjectKind::Person,
            ObjectKind::Terrain,
        ];
        let ids = kinds
            .into_iter()
            .flat_map(|kind| [0, 1, 200_000].map(|index| ObjectId::new(kind, index)))
            .flat_map(|id| [0, 1, 9_000_000].map(|item| ObjectId { item, ..id }));
        let mut keys: Vec<u64> = ids.map(ObjectId::key).collect();
        keys.sort_unstable();
        keys.dedup();
        assert_eq!(keys.len(), 5 * 9);
        assert!(keys[0] != 0, "0 is the ground");
    }
}
