//! The outline of a vehicle, as a scenario writes it.

use glam::DVec3;
use simbeeotic_model::physics::{Hull, Mesh, Part, Shape};
use simbeeotic_model::schemars::{JsonSchema, Schema, SchemaGenerator};
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::{Attitude, Length, Offset};
use simbeeotic_model::world::spelling::{Ball, Round, needed, needed_height};
use std::borrow::Cow;
use std::sync::Arc;

/// The outline of a vehicle. Sizes are above zero.
///
/// The body is a solid of even density. Its origin becomes its centre of mass, and its axes (forward,
/// left, up) the principal axes of its moments of inertia: for all shapes that are alike on both sides
/// of each axis, what one would draw.
///
/// Files say the width of what is round as a `diameter` or as a `radius`, as they like.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    crate = "simbeeotic_model::serde",
    rename_all = "snake_case",
    try_from = "OutlineFile"
)]
pub enum Outline {
    /// A sphere.
    Sphere {
        /// Across.
        diameter: Length,
    },
    /// A box.
    Box {
        /// Size from back to front.
        length: Length,
        /// Size from right to left.
        width: Length,
        /// Size from bottom to top.
        height: Length,
    },
    /// An upright cylinder.
    Cylinder {
        /// Across.
        diameter: Length,
        /// From bottom to top.
        height: Length,
    },
    /// An upright cone, tip up.
    Cone {
        /// Across its base.
        diameter: Length,
        /// From base to tip.
        height: Length,
    },
    /// An upright cylinder with a half ball at each end.
    Capsule {
        /// Across.
        diameter: Length,
        /// From end to end, both half balls included: more than the diameter.
        height: Length,
    },
    /// The smallest convex body that holds some points.
    Hull {
        /// Four points or more, not all in one plane: forward, left, up.
        points: Vec<Offset>,
    },
    /// A closed surface of triangles. It collides as the convex hull of its points.
    Mesh {
        /// Corners of triangles: forward, left, up.
        points: Vec<Offset>,
        /// Three corners each, counter-clockwise seen from outside, as places in `points`, from 0.
        triangles: Vec<[u32; 3]>,
    },
    /// Several shapes that fly as one. Where they overlap, the mass counts twice.
    Parts(Vec<OutlinePart>),
}

/// An outline as files spell it.
#[derive(Deserialize, JsonSchema)]
#[serde(
    crate = "simbeeotic_model::serde",
    rename_all = "snake_case",
    deny_unknown_fields
)]
#[schemars(crate = "simbeeotic_model::schemars")]
enum OutlineFile {
    /// A sphere.
    Sphere(Ball),
    /// A box.
    Box {
        /// Size from back to front.
        length: Length,
        /// Size from right to left.
        width: Length,
        /// Size from bottom to top.
        height: Length,
    },
    /// An upright cylinder.
    Cylinder(Round),
    /// An upright cone, tip up, as wide as its base.
    Cone(Round),
    /// An upright cylinder with a half ball at each end: higher than it is wide.
    Capsule(Round),
    /// The smallest convex body that holds some points.
    Hull {
        /// Four points or more, not all in one plane: forward, left, up.
        points: Vec<Offset>,
    },
    /// A closed surface of triangles. It collides as the convex hull of its points.
    Mesh {
        /// Corners of triangles: forward, left, up.
        points: Vec<Offset>,
        /// Three corners each, counter-clockwise seen from outside, as places in `points`, from 0.
        triangles: Vec<[u32; 3]>,
    },
    /// Several shapes that fly as one. Where they overlap, the mass counts twice.
    Parts(Vec<OutlinePart>),
}

impl TryFrom<OutlineFile> for Outline {
    type Error = String;

    fn try_from(file: OutlineFile) -> Result<Self, String> {
        let round = |round: Round| {
            let diameter = needed(round.radius()?)? * 2.0;
            Ok::<_, String>((diameter, needed_height(round.height)?))
        };
        Ok(match file {
            OutlineFile::Sphere(ball) => Self::Sphere {
                diameter: needed(ball.radius()?)? * 2.0,
            },
            OutlineFile::Box {
                length,
                width,
                height,
            } => Self::Box {
                length,
                width,
                height,
            },
            OutlineFile::Cylinder(file) => {
                let (diameter, height) = round(file)?;
                Self::Cylinder { diameter, height }
            }
            OutlineFile::Cone(file) => {
                let (diameter, height) = round(file)?;
                Self::Cone { diameter, height }
            }
            OutlineFile::Capsule(file) => {
                let (diameter, height) = round(file)?;
                Self::Capsule { diameter, height }
            }
            OutlineFile::Hull { points } => Self::Hull { points },
            OutlineFile::Mesh { points, triangles } => Self::Mesh { points, triangles },
            OutlineFile::Parts(parts) => Self::Parts(parts),
        })
    }
}

impl JsonSchema for Outline {
    fn schema_name() -> Cow<'static, str> {
        "Outline".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        OutlineFile::json_schema(generator)
    }
}

/// One of the shapes of an [`Outline`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(crate = "simbeeotic_model::serde", deny_unknown_fields)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub struct OutlinePart {
    /// Where its middle is; of a cone, half way between base and tip.
    #[serde(default)]
    pub position: Offset,
    /// How it is turned about its middle.
    #[serde(default)]
    pub attitude: Attitude,
    /// What it is: any shape but a mesh or parts.
    pub shape: Outline,
}

impl Outline {
    /// The shape that physics knows, its centre of mass at the origin and its principal axes along
    /// the body's.
    pub fn shape(&self) -> Shape {
        match self.as_drawn() {
            // They are centred as they are drawn, whatever rounding says.
            shape @ (Shape::Sphere { .. }
            | Shape::Box { .. }
            | Shape::Cylinder { .. }
            | Shape::Capsule { .. }) => shape,
            other => other.centred().0,
        }
    }

    fn as_drawn(&self) -> Shape {
        match self {
            Self::Sphere { diameter } => Shape::Sphere {
                radius_m: 0.5 * diameter.metres(),
            },
            Self::Box {
                length,
                width,
                height,
            } => Shape::Box {
                half_m: 0.5 * DVec3::new(length.metres(), width.metres(), height.metres()),
            },
            Self::Cylinder { diameter, height } => Shape::Cylinder {
                radius_m: 0.5 * diameter.metres(),
                half_height_m: 0.5 * height.metres(),
            },
            Self::Cone { diameter, height } => Shape::Cone {
                radius_m: 0.5 * diameter.metres(),
                half_height_m: 0.5 * height.metres(),
            },
            Self::Capsule { diameter, height } => Shape::Capsule {
                radius_m: 0.5 * diameter.metres(),
                half_height_m: 0.5 * (height.metres() - diameter.metres()),
            },
            Self::Hull { points } => Shape::Hull(Arc::new(Hull {
                points_m: metres(points),
            })),
            Self::Mesh { points, triangles } => Shape::Mesh(Arc::new(Mesh {
                points_m: metres(points),
                triangles: triangles.clone(),
            })),
            Self::Parts(parts) => Shape::Compound(
                parts
                    .iter()
                    .map(|part| Part {
                        offset_m: part.position.si(),
                        attitude: part.attitude,
                        shape: part.shape.as_drawn(),
                    })
                    .collect(),
            ),
        }
    }
}

fn metres(points: &[Offset]) -> Vec<DVec3> {
    points.iter().map(|point| point.si()).collect()
}

/// How far the lowest point of a shape is below its origin, m.
pub(super) fn depth_m(shape: &Shape) -> f64 {
    reach_m(shape, DVec3::NEG_Z)
}

/// How far a shape reaches from its origin along a unit vector, m.
fn reach_m(shape: &Shape, along: DVec3) -> f64 {
    let across = (along.x * along.x + along.y * along.y).sqrt();
    let farthest = |points: &[DVec3]| {
        let reach = points.iter().map(|point| point.dot(along));
        reach.fold(f64::NEG_INFINITY, f64::max)
    };
    match shape {
        Shape::Sphere { radius_m } => *radius_m,
        Shape::Box { half_m } => half_m.dot(along.abs()),
        Shape::Cylinder {
            radius_m,
            half_height_m,
        } => half_height_m * along.z.abs() + radius_m * across,
        Shape::Cone {
            radius_m,
            half_height_m,
        } => {
            let (tip, base) = (half_height_m * along.z, radius_m * across);
            tip.max(base - tip)
        }
        Shape::Capsule {
            radius_m,
            half_height_m,
        } => half_height_m * along.z.abs() + radius_m,
        Shape::Hull(hull) => farthest(&hull.points_m),
        Shape::Mesh(mesh) => farthest(&mesh.points_m),
        Shape::Compound(parts) => {
            let reach = parts.iter().map(|part| {
                let along_part = part.attitude.quat().conjugate() * along;
                part.offset_m.dot(along) + reach_m(&part.shape, along_part)
            });
            reach.fold(f64::NEG_INFINITY, f64::max)
        }
        other => other.bounding_radius_m(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::units::Angle;

    fn cm(length: f64) -> Length {
        Length::from_centimetres(length)
    }

    #[test]
    fn a_vehicle_reaches_as_deep_as_its_lowest_point() {
        let depth = |outline: Outline| 100.0 * depth_m(&outline.as_drawn());
        let (diameter, height) = (cm(4.0), cm(10.0));
        let close = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-12, "{found}");
        close(depth(Outline::Sphere { diameter }), 2.0);
        close(depth(Outline::Cylinder { diameter, height }), 5.0);
        close(depth(Outline::Cone { diameter, height }), 5.0);
        close(depth(Outline::Capsule { diameter, height }), 5.0);
        let plank = Outline::Box {
            length: cm(30.0),
            width: cm(20.0),
            height: cm(2.0),
        };
        close(depth(plank.clone()), 1.0);
        // Standing on its end, 3 cm up.
        let pitch = Attitude::from_rpy(
            Angle::ZERO,
            Angle::from_degrees(90.0),
            simbeeotic_model::units::Yaw::EAST,
        );
        let part = OutlinePart {
            position: Offset::from_xyz(0.0, 0.0, 0.03),
            attitude: pitch,
            shape: plank,
        };
        close(depth(Outline::Parts(vec![part])), 12.0);
    }
}
