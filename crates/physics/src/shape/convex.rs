//! The convex solids of which every form consists: where they reach farthest, and where they are nearest
//! to a point.

use super::convert::{from_parry, to_parry};
use glam::{DVec2, DVec3};
use parry3d_f64::math::Vector;
use parry3d_f64::shape::SupportMap;
use std::sync::Arc;

/// A convex solid about its own origin.
#[derive(Clone, Debug)]
pub(crate) enum Convex {
    /// The origin.
    Point,
    /// From -z to +z.
    Segment { half: f64 },
    /// A block along the axes.
    Block { half: DVec3 },
    /// A cylinder along z.
    Cylinder { radius: f64, half: f64 },
    /// A cone along z, tip up, the origin half way between base and tip.
    Cone { radius: f64, half: f64 },
    /// All that lies between its corners.
    Hull(Arc<[DVec3]>),
    /// Three corners.
    Triangle([DVec3; 3]),
}

/// The farthest of some points along a direction; the origin if there are none.
fn farthest(points: &[DVec3], direction: DVec3) -> DVec3 {
    let mut best = DVec3::ZERO;
    let mut reach = f64::NEG_INFINITY;
    for point in points {
        let along = point.dot(direction);
        if along > reach {
            (best, reach) = (*point, along);
        }
    }
    best
}

/// The point of a circle about the origin that is farthest along a direction.
fn rim(direction: DVec3, radius: f64) -> DVec2 {
    let level = direction.truncate();
    let length = level.length();
    if length > 0.0 {
        level * (radius / length)
    } else {
        DVec2::ZERO
    }
}

impl Convex {
    /// The point that lies farthest along a direction of any length.
    #[inline]
    pub(crate) fn support(&self, direction: DVec3) -> DVec3 {
        match self {
            Self::Point => DVec3::ZERO,
            Self::Segment { half } => DVec3::new(0.0, 0.0, half.copysign(direction.z)),
            Self::Block { half } => DVec3::new(
                half.x.copysign(direction.x),
                half.y.copysign(direction.y),
                half.z.copysign(direction.z),
            ),
            Self::Cylinder { radius, half } => {
                rim(direction, *radius).extend(half.copysign(direction.z))
            }
            Self::Cone { radius, half } => {
                let base = rim(direction, *radius).extend(-half);
                let tip = DVec3::new(0.0, 0.0, *half);
                if base.dot(direction) > tip.dot(direction) {
                    base
                } else {
                    tip
                }
            }
            Self::Hull(points) => farthest(points, direction),
            Self::Triangle(corners) => farthest(corners, direction),
        }
    }
}

impl SupportMap for Convex {
    #[inline]
    fn local_support_point(&self, direction: Vector) -> Vector {
        to_parry(self.support(from_parry(direction)))
    }
}
