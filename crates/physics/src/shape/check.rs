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
    error::positive(what, value, limits::EXTENT_M_MAX)?;
    error::ranged(what, value, limits::EXTENT_M_MIN, limits::EXTENT_M_MAX)
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
                        part: if depth == 0 {
                            "a compound within so many"
                        } else {
                            "nothing"
                        },
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Hull;
    use glam::DVec2;
    use simbeeotic_kernel::Stream;
    use simbeeotic_units::Attitude;
    use std::sync::Arc;

    fn number(stream: &mut Stream) -> f64 {
        match stream.below(12) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => -1.0,
            3 => 0.0,
            4 => 1e-300,
            5 => 1e300,
            6 => 1e5,
            7 => f64::from_bits(stream.below(u64::MAX)),
            _ => stream.uniform(),
        }
    }

    /// Mostly usable numbers, so that deeper checks are reached.
    fn vector(stream: &mut Stream) -> DVec3 {
        match stream.below(10) {
            0 => DVec3::new(number(stream), number(stream), number(stream)),
            1 => DVec3::ZERO,
            2 => stream.in_ball(1.0).with_z(0.0),
            3 => stream.in_ball(1e5),
            4 => stream.in_ball(1e-12),
            _ => stream.in_ball(1.0),
        }
    }

    fn shape(stream: &mut Stream, depth: u32) -> Shape {
        let (radius_m, half_height_m) = (number(stream), number(stream));
        let many = stream.below(12);
        match stream.below(if depth == 0 { 9 } else { 11 }) {
            0 => Shape::Sphere { radius_m },
            1 => Shape::Box {
                half_m: vector(stream).abs(),
            },
            2 => Shape::Cylinder {
                radius_m,
                half_height_m,
            },
            3 => Shape::Cone {
                radius_m,
                half_height_m,
            },
            4 => Shape::Capsule {
                radius_m,
                half_height_m,
            },
            5 => Shape::Plane,
            6 => Shape::Hull(Arc::new(Hull {
                points_m: (0..many).map(|_| vector(stream)).collect(),
            })),
            7 => Shape::Mesh(Arc::new(Mesh {
                points_m: (0..many).map(|_| vector(stream)).collect(),
                triangles: (0..stream.below(5))
                    .map(|_| [0; 3].map(|_: u32| stream.below(many + 1) as u32))
                    .collect(),
            })),
            8 => Shape::HeightField(Arc::new(HeightField {
                size_m: DVec2::new(number(stream), number(stream)),
                columns: stream.below(5) as usize,
                heights_m: (0..many).map(|_| number(stream)).collect(),
            })),
            _ => Shape::Compound(
                (0..stream.below(4))
                    .map(|_| Part {
                        offset_m: vector(stream),
                        attitude: Attitude::IDENTITY,
                        shape: shape(stream, depth - 1),
                    })
                    .collect(),
            ),
        }
    }

    #[test]
    fn no_numbers_make_it_panic_and_what_passes_has_a_form() {
        let mut stream = Stream::new(1, "shapes", "test");
        let mut good = 0;
        for _ in 0..50_000 {
            let shape = shape(&mut stream, 2);
            let checked = shape.check();
            assert_eq!(checked.is_err(), shape.check().is_err());
            if checked.is_ok() {
                good += 1;
                let form = Form::new(&shape, false).unwrap();
                form.shared();
                assert!(
                    form.radius() > 0.0 || matches!(shape, Shape::Mesh(_) | Shape::Compound(_)),
                    "{shape:?}"
                );
                for mobility in [Mobility::Free, Mobility::Driven, Mobility::Fixed] {
                    if shape.suits(mobility).is_ok() && mobility == Mobility::Free {
                        Form::new(&shape, true).unwrap().shared();
                    }
                }
                let (centred, _) = shape.centred();
                let _ = centred.mass_properties(1.0);
            }
        }
        assert!(good > 5000, "{good}");
    }

    #[test]
    fn a_free_cone_has_to_be_centred() {
        let cone = Shape::Cone {
            radius_m: 0.2,
            half_height_m: 0.3,
        };
        assert!(cone.suits(Mobility::Fixed).is_ok());
        let error = cone.suits(Mobility::Free).unwrap_err().to_string();
        assert!(error.contains("Shape::centred"), "{error}");
        assert!(cone.centred().0.suits(Mobility::Free).is_ok());
        assert!(Shape::Plane.suits(Mobility::Driven).is_err());
    }
}
