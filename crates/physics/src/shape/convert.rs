//! Between our vectors and those of parry and rapier, which stand on another release of glam.

use super::form::Place;
use glam::{DQuat, DVec3};
use parry3d_f64::math::{Pose, Rotation, Vector};

/// A vector, for parry.
#[inline]
pub(crate) fn to_parry(v: DVec3) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

/// A vector, from parry.
#[inline]
pub(crate) fn from_parry(v: Vector) -> DVec3 {
    DVec3::new(v.x, v.y, v.z)
}

/// A rotation, for parry.
#[inline]
pub(crate) fn to_rotation(q: DQuat) -> Rotation {
    Rotation::from_xyzw(q.x, q.y, q.z, q.w)
}

/// A rotation, from parry.
#[inline]
pub(crate) fn from_rotation(q: Rotation) -> DQuat {
    DQuat::from_xyzw(q.x, q.y, q.z, q.w)
}

/// A place, for parry.
#[inline]
pub(crate) fn to_pose(place: Place) -> Pose {
    Pose::from_parts(to_parry(place.p), to_rotation(place.q))
}

/// A place, from parry.
#[inline]
pub(crate) fn from_pose(pose: Pose) -> Place {
    Place {
        p: from_parry(pose.translation),
        q: from_rotation(pose.rotation),
    }
}
