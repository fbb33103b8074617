//! A shape made ready for queries.

use super::Shape;
use super::convert::{from_parry, to_parry, to_pose};
use crate::error::BodyError;
use glam::{DQuat, DVec3};
use parry3d_f64::math::Pose as ParryPose;
use parry3d_f64::query;
use parry3d_f64::shape::SharedShape;

/// Where a body stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Its origin, ENU, m.
    pub(crate) p: DVec3,
    /// `world_from_body`.
    pub(crate) q: DQuat,
}

/// What lies between two forms.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Gap {
    /// Least distance, m; where they overlap, the depth, negative, if the pair knows it, else 0.
    pub(crate) distance: f64,
    /// From the first to the second, unit, ENU: the normal of a plane between them.
    pub(crate) normal: DVec3,
    /// The point of the first that is nearest to the second, ENU, m.
    pub(crate) here: DVec3,
    /// The point of the second that is nearest to the first, ENU, m.
    pub(crate) there: DVec3,
}

impl Gap {
    /// The same, seen from the second.
    pub(crate) fn flipped(self) -> Self {
        Self {
            distance: self.distance,
            normal: -self.normal,
            here: self.there,
            there: self.here,
        }
    }
}

/// A shape made ready for queries: made once, shared by all bodies of that shape.
pub(crate) struct Form {
    shared: SharedShape,
    pose: ParryPose,
    ball: Option<f64>,
    radius: f64,
}

impl Form {
    /// The form of a checked shape. `free`: it belongs to a body that moves freely, so that a mesh
    /// counts as its convex hull.
    pub(crate) fn new(shape: &Shape, free: bool) -> Result<Self, BodyError> {
        let _ = free;
        let (shared, ball) = match shape {
            Shape::Sphere { radius_m } => (SharedShape::ball(*radius_m), Some(*radius_m)),
            Shape::Box { half_m } => (SharedShape::cuboid(half_m.x, half_m.y, half_m.z), None),
            shape => {
                return Err(BodyError::ShapeMoves {
                    shape: shape.name(),
                });
            }
        };
        Ok(Self {
            shared,
            pose: ParryPose::identity(),
            ball,
            radius: shape.bounding_radius_m(),
        })
    }

    /// The radius, of a ball.
    #[inline]
    pub(crate) fn ball(&self) -> Option<f64> {
        self.ball
    }

    /// Radius of the bounding ball about the origin, m.
    #[inline]
    pub(crate) fn radius(&self) -> f64 {
        self.radius
    }

    /// The least box along the world's axes that holds the form: least and greatest corner, ENU, m.
    pub(crate) fn bounds(&self, at: Place) -> [DVec3; 2] {
        let bounds = self.shared.compute_aabb(&(to_pose(at) * self.pose));
        [from_parry(bounds.mins), from_parry(bounds.maxs)]
    }

    /// What lies between this form and another.
    pub(crate) fn gap(&self, at: Place, other: &Self, other_at: Place) -> Gap {
        let here = to_pose(Place { p: DVec3::ZERO, ..at });
        let there = to_pose(Place {
            p: other_at.p - at.p,
            ..other_at
        });
        let contact = query::contact(&here, &*self.shared, &there, &*other.shared, f64::MAX)
            .ok()
            .flatten();
        contact.map_or(
            Gap {
                distance: 0.0,
                normal: DVec3::Z,
                here: at.p,
                there: other_at.p,
            },
            |contact| Gap {
                distance: contact.dist,
                normal: from_parry(contact.normal1),
                here: at.p + from_parry(contact.point1),
                there: at.p + from_parry(contact.point2),
            },
        )
    }

    /// What lies between this form and the ground, the plane at up = 0.
    pub(crate) fn gap_to_ground(&self, at: Place) -> Gap {
        let lowest = self.bounds(at)[0];
        let here = DVec3::new(at.p.x, at.p.y, lowest.z);
        Gap {
            distance: lowest.z,
            normal: -DVec3::Z,
            here,
            there: here.truncate().extend(0.0),
        }
    }

    /// Where a ray of unit direction first meets the form within `max_m`: distance, and the surface's
    /// outward normal.
    pub(crate) fn cast_ray(
        &self,
        at: Place,
        from: DVec3,
        direction: DVec3,
        max_m: f64,
    ) -> Option<(f64, DVec3)> {
        let pose = to_pose(Place { p: DVec3::ZERO, ..at });
        let ray = query::Ray::new(to_parry(from - at.p), to_parry(direction));
        let hit = self.shared.cast_ray_and_get_normal(&pose, &ray, max_m, true)?;
        Some((hit.time_of_impact, from_parry(hit.normal)))
    }

    /// Where `other`, moved from `other_at` along a unit direction, first meets this form within `max_m`:
    /// the distance, and the gap at that place.
    pub(crate) fn cast_form(
        &self,
        at: Place,
        other: &Self,
        other_at: Place,
        direction: DVec3,
        max_m: f64,
    ) -> Option<(f64, Gap)> {
        let mut way = 0.0;
        for _ in 0..200 {
            let p = other_at.p + direction * way;
            let gap = self.gap(at, other, Place { p, ..other_at });
            let closing = -direction.dot(gap.normal);
            if gap.distance <= 1e-9 {
                return Some((way, gap));
            }
            if closing <= 0.0 {
                return None;
            }
            way += gap.distance / closing;
            if way > max_m {
                return None;
            }
        }
        None
    }

    /// The collider for rapier, and its pose in the body.
    pub(crate) fn shared(&self) -> (&SharedShape, ParryPose) {
        (&self.shared, self.pose)
    }
}
