//! Which shapes there can be, and which bodies can have them.

use super::{HeightField, Mesh, Part, Shape};
use crate::body::Mobility;
use crate::error::{self, BodyError};
use crate::limits;
use crate::shape::form::Form;
use glam::{DMat3, DVec3};

/// How far a free body's centre of mass may lie from its origin, over its bounding radius, and a
/// principal axis from x, y or z, rad.
const CENTRED: f64 = 1e-6;
/// How deep compounds may lie in compounds.
const DEPTH_MAX: usize = 8;

fn extent(what: &'static str, value: f64) -> Result<(), BodyError> {
    error::positive(what, value, limits::EXTENT_M_MAX)
}

fn points(what: &'static str, points: &[DVec3]) -> Result<(), BodyError> {
    let check = |point: &DVec3| error::bounded(what, *point, limits::EXTENT_M_MAX);
    points.iter().try_for_each(check)
}

fn count(what: &'static str, count: usize, min: usize) -> Result<(), BodyError> {
    let max = limits::PIECES_MAX;
    if (min..=max).contains(&count) {
        Ok(())
    } else {
        Err(BodyError::Count {
            what,
            count,
            min,
            max,
        })
    }
}

impl Mesh {
    fn check(&self) -> Result<(), BodyError> {
        points("point of the mesh [m]", &self.points_m)?;
        count("triangles of the mesh", self.triangles.len(), 1)?;
        count("points of the mesh", self.points_m.len(), 1)?;
        let past = |corner: &&u32| **corner as usize >= self.points_m.len();
        match self.triangles.iter().flatten().find(past) {
            Some(corner) => Err(BodyError::Corner {
                corner: *corner,
                points: self.points_m.len(),
            }),
            None => Ok(()),
        }
    }
}

impl HeightField {
    fn check(&self) -> Result<(), BodyError> {
        extent("extent of the height field [m]", self.size_m.x)?;
        extent("extent of the height field [m]", self.size_m.y)?;
        count("columns of the height field", self.columns, 2)?;
        count("rows of the height field", self.rows(), 2)?;
        if self.rows() * self.columns != self.heights_m.len() {
            return Err(BodyError::Rows {
                heights: self.heights_m.len(),
                columns: self.columns,
            });
        }
        let high = |height: &f64| {
            let most = limits::EXTENT_M_MAX;
            error::ranged("height of the height field [m]", *height, -most, most)
        };
        self.heights_m.iter().try_for_each(high)
    }
}

impl Shape {
    /// Whether there can be such a shape.
    ///
    /// # Errors
    /// A number that is not finite or out of its range, corners that do not exist, points without
    /// volume between them, a compound of nothing or with a plane in it.
    pub fn check(&self) -> Result<(), BodyError> {
        self.check_numbers(DEPTH_MAX)?;
        match self {
            Self::Hull(_) | Self::Compound(_) => Form::new(self, false).map(drop),
            _ => Ok(()),
        }
    }

    fn check_numbers(&self, depth: usize) -> Result<(), BodyError> {
        match self {
            Self::Sphere { radius_m } => extent("radius [m]", *radius_m),
            Self::Box { half_m } => {
                let half = |half| extent("half extent [m]", half);
                half_m.to_array().into_iter().try_for_each(half)
            }
            Self::Cylinder {
                radius_m,
                half_height_m,
            }
            | Self::Cone {
                radius_m,
                half_height_m,
            }
            | Self::Capsule {
                radius_m,
                half_height_m,
            } => {
                extent("radius [m]", *radius_m)?;
                extent("half height [m]", *half_height_m)
            }
            Self::Plane => Ok(()),
            Self::Hull(hull) => points("point of the hull [m]", &hull.points_m),
            Self::Mesh(mesh) => mesh.check(),
            Self::HeightField(field) => field.check(),
            Self::Compound(parts) => {
                if parts.is_empty() || depth == 0 {
                    return Err(BodyError::Part {
                        part: if depth == 0 { "a compound within so many" } else { "nothing" },
                    });
                }
                parts.iter().try_for_each(|part| part.check(depth - 1))
            }
        }
    }

    /// Whether a body of this mobility can have this shape.
    pub(crate) fn suits(&self, mobility: Mobility) -> Result<(), BodyError> {
        let fixed_only = matches!(self, Self::Plane) && mobility != Mobility::Fixed;
        let free = mobility == Mobility::Free;
        if fixed_only || free && matches!(self, Self::HeightField(_)) {
            return Err(BodyError::ShapeMoves { shape: self.name() });
        }
        if !free {
            return Ok(());
        }
        if let Self::Compound(parts) = self {
            let simple = |part: &Part| match &part.shape {
                Self::Mesh(_) | Self::HeightField(_) | Self::Compound(_) => {
                    Err(BodyError::PartMoves {
                        part: part.shape.name(),
                    })
                }
                _ => Ok(()),
            };
            parts.iter().try_for_each(simple)?;
        }
        if let Self::Mesh(_) = self {
            Form::new(self, true)?;
        }
        self.check_centred()
    }

    /// Whether the origin is the centre of mass, and x, y and z are principal axes.
    fn check_centred(&self) -> Result<(), BodyError> {
        if matches!(
            self,
            Self::Sphere { .. } | Self::Box { .. } | Self::Cylinder { .. } | Self::Capsule { .. }
        ) {
            return Ok(());
        }
        let Some(mass) = self.mass_properties(1.0) else {
            return Ok(());
        };
        let turn = DMat3::from_quat(mass.axes.quat());
        let inertia = turn * DMat3::from_diagonal(mass.moments_kg_m2) * turn.transpose();
        let off = DVec3::new(inertia.y_axis.z, inertia.z_axis.x, inertia.x_axis.y);
        let most = mass.moments_kg_m2.max_element();
        let size = self.bounding_radius_m();
        if mass.centre_m.length() <= CENTRED * size && off.abs().max_element() <= CENTRED * most {
            Ok(())
        } else {
            Err(BodyError::OffCentre {
                shape: self.name(),
                centre: mass.centre_m.to_array(),
            })
        }
    }
}

impl Part {
    fn check(&self, depth: usize) -> Result<(), BodyError> {
        error::bounded("offset of a part [m]", self.offset_m, limits::EXTENT_M_MAX)?;
        error::attitude(self.attitude)?;
        if matches!(self.shape, Shape::Plane) {
            return Err(BodyError::Part { part: "a plane" });
        }
        self.shape.check_numbers(depth)
    }
}
