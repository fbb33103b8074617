//! Which shapes there can be.

use super::Shape;
use crate::error::{self, BodyError};
use crate::limits;

impl Shape {
    /// Whether there can be such a shape.
    ///
    /// # Errors
    /// A number that is not finite or out of its range, corners that do not exist, points without
    /// volume between them.
    pub fn check(&self) -> Result<(), BodyError> {
        match self {
            Self::Sphere { radius_m } => {
                error::positive("radius [m]", *radius_m, limits::EXTENT_M_MAX)
            }
            Self::Box { half_m } => half_m.to_array().into_iter().try_for_each(|half| {
                error::positive("half extent [m]", half, limits::EXTENT_M_MAX)
            }),
            _ => Ok(()),
        }
    }
}
