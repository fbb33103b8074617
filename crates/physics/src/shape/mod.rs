//! The outline of a body: what its user gives ([`Shape`]), and what is made of it once, for all queries
//! (`form`).

mod check;
mod collider;
pub(crate) mod convert;
mod convex;
pub(crate) mod form;
mod hull;
mod mass;
pub(crate) mod piece;
mod ray;
mod separation;
pub(crate) mod soup;

pub use mass::MassProperties;

use form::Place;
use glam::{DVec2, DVec3};
use simbeeotic_units::Attitude;
use std::sync::Arc;

/// The outline of a body, in its own frame (FLU), whose origin is where the body's position is: for a
/// body that moves, its centre of mass.
///
/// A clone is cheap: what is large is shared. The surface belongs to the solid.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shape {
    /// A ball.
    Sphere {
        /// Radius in metres, above 0.
        radius_m: f64,
    },
    /// A block along the body axes.
    Box {
        /// Half of its length, width and height in metres, each above 0.
        half_m: DVec3,
    },
    /// A cylinder along z.
    Cylinder {
        /// Radius in metres, above 0.
        radius_m: f64,
        /// Half of its height in metres, above 0.
        half_height_m: f64,
    },
    /// A cone along z, base below, tip above. The origin is half way between the two; its centre of
    /// mass lies a quarter of the height above the base, so a cone that moves freely has to be
    /// [`centred`](Self::centred).
    Cone {
        /// Radius of the base in metres, above 0.
        radius_m: f64,
        /// Half of its height in metres, above 0.
        half_height_m: f64,
    },
    /// A cylinder along z with half a ball on either end.
    Capsule {
        /// Radius in metres, above 0.
        radius_m: f64,
        /// Half of the length of the cylinder, without the half balls, in metres, above 0.
        half_height_m: f64,
    },
    /// All below the body's xy plane, without end. For fixed bodies only.
    Plane,
    /// The smallest convex solid that holds some points.
    Hull(Arc<Hull>),
    /// Triangles: a surface, with nothing inside. A body that moves freely collides as the convex hull
    /// of its triangles; one that is fixed or driven, as they are.
    Mesh(Arc<Mesh>),
    /// Heights over a level rectangle: a surface. For fixed and driven bodies only.
    HeightField(Arc<HeightField>),
    /// Several shapes that move as one. For a body that moves freely, parts may be spheres, boxes,
    /// cylinders, cones, capsules and hulls; no part is a plane.
    Compound(Arc<[Part]>),
}

/// One shape of a [`Shape::Compound`].
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Where the part's origin lies in the body, FLU, m.
    pub offset_m: DVec3,
    /// How the part is turned: from its axes to those of the body.
    pub attitude: Attitude,
    /// Its outline.
    pub shape: Shape,
}

/// The points of a [`Shape::Hull`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hull {
    /// At least four that do not lie in one plane, FLU, m. Those inside do not matter.
    pub points_m: Vec<DVec3>,
}

/// The triangles of a [`Shape::Mesh`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// The corners of all triangles, FLU, m.
    pub points_m: Vec<DVec3>,
    /// The three corners of each, as indices into the points; counter-clockwise as seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// The heights of a [`Shape::HeightField`]: samples over a rectangle around the origin, at the corners
/// of equal cells, each of which is split into two triangles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeightField {
    /// Extent of the rectangle along x (west to east, if the body is not turned) and y (south to
    /// north), m, each above 0.
    pub size_m: DVec2,
    /// Number of samples in a row, along x; at least 2.
    pub columns: usize,
    /// The heights (z), row by row from the least y to the greatest, each row from the least x to the
    /// greatest, m; at least 2 rows.
    pub heights_m: Vec<f64>,
}

impl Hull {
    /// Its faces as triangles; `None` if its points are not finite or all lie in one plane.
    #[must_use]
    pub fn surface(&self) -> Option<Mesh> {
        if !self.points_m.iter().all(|point| point.is_finite()) {
            return None;
        }
        hull::hull(&self.points_m).map(|faces| Mesh {
            points_m: faces.points,
            triangles: faces.triangles,
        })
    }
}

impl HeightField {
    /// Number of rows, along y.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.heights_m.len().checked_div(self.columns).unwrap_or(0)
    }

    /// Sample `column` of row `row`, in the body frame, m.
    fn point(&self, row: usize, column: usize) -> DVec3 {
        let across = column as f64 / (self.columns - 1) as f64 - 0.5;
        let along = row as f64 / (self.rows() - 1) as f64 - 0.5;
        let height = self.heights_m[row * self.columns + column];
        (self.size_m * DVec2::new(across, along)).extend(height)
    }

    /// All samples, in the body frame, m.
    fn points(&self) -> impl Iterator<Item = DVec3> + '_ {
        (0..self.heights_m.len()).map(|k| self.point(k / self.columns, k % self.columns))
    }
}

impl Shape {
    /// Radius of the smallest ball about the origin that holds the shape, m; infinite for a plane.
    #[must_use]
    pub fn bounding_radius_m(&self) -> f64 {
        self.reach_m(DVec3::ZERO)
    }

    /// Distance from the origin to the farthest point of the shape when it is moved by `offset`, m.
    fn reach_m(&self, offset: DVec3) -> f64 {
        let across = offset.truncate().length();
        let along = offset.z.abs();
        let farthest = |points: &[DVec3]| {
            let reach = |p: &DVec3| (*p + offset).length();
            points.iter().map(reach).fold(0.0, f64::max)
        };
        match self {
            Self::Sphere { radius_m } => offset.length() + radius_m,
            Self::Box { half_m } => (offset.abs() + *half_m).length(),
            Self::Cylinder {
                radius_m,
                half_height_m,
            } => DVec2::new(across + radius_m, along + half_height_m).length(),
            Self::Cone {
                radius_m,
                half_height_m,
            } => {
                let rim = DVec2::new(across + radius_m, offset.z - half_height_m);
                let tip = DVec2::new(across, offset.z + half_height_m);
                rim.length().max(tip.length())
            }
            Self::Capsule {
                radius_m,
                half_height_m,
            } => DVec2::new(across, along + half_height_m).length() + radius_m,
            Self::Plane => f64::INFINITY,
            Self::Hull(hull) => farthest(&hull.points_m),
            Self::Mesh(mesh) => farthest(&mesh.points_m),
            Self::HeightField(field) => {
                let reach = |p: DVec3| (p + offset).length();
                field.points().map(reach).fold(0.0, f64::max)
            }
            Self::Compound(parts) => {
                let reach = |part: &Part| {
                    let part_from_body = part.attitude.quat().inverse();
                    part.shape
                        .reach_m(part_from_body * (offset + part.offset_m))
                };
                parts.iter().map(reach).fold(0.0, f64::max)
            }
        }
    }

    /// What the shape is called in messages.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Sphere { .. } => "sphere",
            Self::Box { .. } => "box",
            Self::Cylinder { .. } => "cylinder",
            Self::Cone { .. } => "cone",
            Self::Capsule { .. } => "capsule",
            Self::Plane => "plane",
            Self::Hull(_) => "hull",
            Self::Mesh(_) => "mesh",
            Self::HeightField(_) => "height field",
            Self::Compound(_) => "compound",
        }
    }
}

impl Part {
    /// Where it stands in the body.
    fn place(&self) -> Place {
        Place {
            p: self.offset_m,
            q: self.attitude.quat().normalize(),
        }
    }
}
