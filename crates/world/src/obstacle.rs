//! Obstacles: things that stand in the way.

use crate::look::{Color, Meta, Texture};
use crate::mesh::{Hull, Mesh};
use crate::solid::{Solid, SolidShape};
use crate::spelling::{Ball, Round, needed, needed_height};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Angle, Attitude, Length, Offset, Position, Yaw};
use std::sync::Arc;

/// A thing in the way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Obstacle {
    /// The middle of its lowest side: with height 0 it stands on the ground. Of a hull, a mesh or
    /// parts: the origin of their points.
    pub position: Position,
    /// How it is turned about its position; upright if left out.
    #[serde(skip_serializing_if = "is_upright")]
    pub attitude: Attitude,
    /// What it is.
    pub shape: ObstacleShape,
    /// What it is made of: a material of this world or one that is built in. Nothing known if left
    /// out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Coulomb friction of its surface, 0 to 1000. Its material's, or 0.5, if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Restitution of its surface: how much of a speed is left after a bounce, 0 to 1. Its material's,
    /// or 0, if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Its colour. Its material's, or `#8c8c8c`, if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// Its texture, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texture: Option<Texture>,
    /// What it is called; empty for nothing.
    pub label: String,
    /// Names and values that contacts and sensors can read.
    pub meta: Meta,
}

impl Obstacle {
    /// The colour of an obstacle that has neither one of its own nor a material with one.
    pub const COLOR: Color = Color::rgb(140, 140, 140);
}

pub(crate) fn is_upright(attitude: &Attitude) -> bool {
    *attitude == Attitude::IDENTITY
}

impl Default for Obstacle {
    fn default() -> Self {
        Self {
            position: Position::ZERO,
            attitude: Attitude::IDENTITY,
            shape: ObstacleShape::default(),
            material: None,
            friction: None,
            restitution: None,
            color: None,
            texture: None,
            label: String::new(),
            meta: Meta::new(),
        }
    }
}

/// The shape of an obstacle. All sizes are above 0; 1 m where a file leaves them out.
///
/// Files say the width of what is round as a `diameter` or as a `radius`, as they like.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", try_from = "ShapeFile")]
pub enum ObstacleShape {
    /// A box.
    Box {
        /// Size along `x`.
        length: Length,
        /// Size along `y`.
        width: Length,
        /// Size along `z`.
        height: Length,
        /// Turned about `z` through its middle, counter-clockwise.
        rotation: Angle,
    },
    /// An upright cylinder.
    Cylinder {
        /// Across.
        diameter: Length,
        /// Size along `z`.
        height: Length,
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
        /// From base to tip.
        height: Length,
    },
    /// An upright cylinder with a half ball at each end.
    Capsule {
        /// Its radius.
        radius: Length,
        /// From end to end, both half balls included: more than two radii.
        height: Length,
    },
    /// The smallest convex body that holds some points.
    Hull(Hull),
    /// A surface of triangles: solid where it is, hollow inside.
    Mesh(Mesh),
    /// Several shapes that are one obstacle.
    Parts(Vec<ObstaclePart>),
}

/// The shape of an obstacle as files spell it.
#[derive(Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum ShapeFile {
    /// A box.
    Box(BoxFile),
    /// An upright cylinder. 1 m across and high where they are left out.
    Cylinder(Round),
    /// A sphere. Its radius is 1 m if its width is left out.
    Sphere(Ball),
    /// An upright cone, tip up, as wide as its base. Its radius and height are 1 m where they are left
    /// out.
    Cone(Round),
    /// An upright cylinder with a half ball at each end: higher than it is wide.
    Capsule(Round),
    /// The smallest convex body that holds some points.
    Hull(Hull),
    /// A surface of triangles: solid where it is, hollow inside.
    Mesh(Mesh),
    /// Several shapes that are one obstacle.
    Parts(Vec<ObstaclePart>),
}

/// A box as files spell it. Sizes are above 0; 1 m where they are left out.
#[derive(Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
struct BoxFile {
    /// Size along `x`.
    length: Length,
    /// Size along `y`.
    width: Length,
    /// Size along `z`.
    height: Length,
    /// Turned about `z` through its middle, counter-clockwise.
    rotation: Angle,
}

impl Default for BoxFile {
    fn default() -> Self {
        Self {
            length: metre(),
            width: metre(),
            height: metre(),
            rotation: Angle::ZERO,
        }
    }
}

impl TryFrom<ShapeFile> for ObstacleShape {
    type Error = String;

    fn try_from(file: ShapeFile) -> Result<Self, String> {
        Ok(match file {
            ShapeFile::Box(BoxFile {
                length,
                width,
                height,
                rotation,
            }) => Self::Box {
                length,
                width,
                height,
                rotation,
            },
            ShapeFile::Cylinder(round) => Self::Cylinder {
                diameter: round.radius()?.map_or(metre(), |radius| radius * 2.0),
                height: round.height.unwrap_or(metre()),
            },
            ShapeFile::Sphere(ball) => Self::Sphere {
                radius: ball.radius()?.unwrap_or(metre()),
            },
            ShapeFile::Cone(round) => Self::Cone {
                radius: round.radius()?.unwrap_or(metre()),
                height: round.height.unwrap_or(metre()),
            },
            ShapeFile::Capsule(round) => Self::Capsule {
                radius: needed(round.radius()?)?,
                height: needed_height(round.height)?,
            },
            ShapeFile::Hull(hull) => Self::Hull(hull),
            ShapeFile::Mesh(mesh) => Self::Mesh(mesh),
            ShapeFile::Parts(parts) => Self::Parts(parts),
        })
    }
}

impl JsonSchema for ObstacleShape {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "ObstacleShape".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        ShapeFile::json_schema(generator)
    }
}

/// One of the shapes that make an obstacle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObstaclePart {
    /// Where its middle is, from the obstacle's position. Of a hull or a mesh: the origin of its
    /// points; of a cone: half way between base and tip.
    #[serde(default)]
    pub position: Offset,
    /// How it is turned about its middle.
    #[serde(default, skip_serializing_if = "is_upright")]
    pub attitude: Attitude,
    /// What it is: any shape without parts of its own.
    pub shape: ObstacleShape,
}

pub(crate) fn metre() -> Length {
    Length::si(1.0)
}

impl Default for ObstacleShape {
    fn default() -> Self {
        Self::Box {
            length: metre(),
            width: metre(),
            height: metre(),
            rotation: Angle::ZERO,
        }
    }
}

impl ObstacleShape {
    /// The primitive it is, how far its middle is above its lowest side, and how it is turned about
    /// `z`. `None` for parts.
    fn primitive(&self) -> Option<(SolidShape, Length, Angle)> {
        let upright = |shape, above| Some((shape, above, Angle::ZERO));
        match self {
            &Self::Box {
                length,
                width,
                height,
                rotation,
            } => {
                let half_height = height * 0.5;
                let shape = SolidShape::Box {
                    half_length: length * 0.5,
                    half_width: width * 0.5,
                    half_height,
                };
                Some((shape, half_height, rotation))
            }
            &Self::Cylinder { diameter, height } => {
                let (radius, half_height) = (diameter * 0.5, height * 0.5);
                let shape = SolidShape::Cylinder {
                    radius,
                    half_height,
                };
                upright(shape, half_height)
            }
            &Self::Sphere { radius } => upright(SolidShape::Sphere { radius }, radius),
            &Self::Cone { radius, height } => {
                let half_height = height * 0.5;
                let shape = SolidShape::Cone {
                    radius,
                    half_height,
                };
                upright(shape, half_height)
            }
            &Self::Capsule { radius, height } => {
                let shape = SolidShape::Capsule {
                    radius,
                    half_height: height * 0.5 - radius,
                };
                upright(shape, height * 0.5)
            }
            Self::Hull(hull) => {
                let points = Arc::clone(&hull.points);
                upright(SolidShape::Hull { points }, Length::ZERO)
            }
            Self::Mesh(mesh) => {
                let shape = SolidShape::Mesh {
                    points: Arc::clone(&mesh.points),
                    triangles: Arc::clone(&mesh.triangles),
                };
                upright(shape, Length::ZERO)
            }
            Self::Parts(_) => None,
        }
    }
}

impl Obstacle {
    /// Its middle: that of its primitive, or the mean of those of its parts; its position if it has
    /// none.
    pub fn middle(&self) -> Position {
        let solids = self.solids();
        if solids.is_empty() {
            return self.position;
        }
        let sum: glam::DVec3 = solids.iter().map(|solid| solid.center.si()).sum();
        Position::from_si(sum / solids.len() as f64)
    }

    /// The primitives it is, standing on [`Obstacle::position`].
    ///
    /// The height of the position counts; the original put everything on the ground. Parts of parts,
    /// which [`World::check`](crate::World::check) refuses, are left out.
    pub fn solids(&self) -> Vec<Solid> {
        let solid = |shape, middle: Offset, attitude: Attitude| Solid {
            shape,
            center: self.position + self.attitude.rotate(middle),
            attitude: self.attitude * attitude,
        };
        let turned = |rotation| Attitude::from_yaw(Yaw::new(rotation));
        if let ObstacleShape::Parts(parts) = &self.shape {
            let parts = parts.iter().filter_map(|part| {
                let (shape, _, rotation) = part.shape.primitive()?;
                Some(solid(
                    shape,
                    part.position,
                    part.attitude * turned(rotation),
                ))
            });
            return parts.collect();
        }
        let primitive = self.shape.primitive().into_iter();
        primitive
            .map(|(shape, above, rotation)| {
                let middle = Offset::new(Length::ZERO, Length::ZERO, above);
                solid(shape, middle, turned(rotation))
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn near(found: glam::DVec3, wanted: [f64; 3]) -> bool {
        found.abs_diff_eq(glam::DVec3::from_array(wanted), 1e-12)
    }

    #[test]
    fn an_obstacle_stands_on_the_height_it_was_given() {
        let (radius, height) = (m(1.0), m(3.0));
        let shapes = [
            (ObstacleShape::Sphere { radius: m(2.0) }, 5.0),
            (ObstacleShape::Cone { radius, height }, 4.5),
            (
                ObstacleShape::Cylinder {
                    diameter: radius,
                    height,
                },
                4.5,
            ),
            (ObstacleShape::Capsule { radius, height }, 4.5),
            (ObstacleShape::default(), 3.5),
            (ObstacleShape::Hull(Hull::default()), 3.0),
        ];
        for (shape, z_m) in shapes {
            let obstacle = Obstacle {
                position: Position::from_xyz(1.0, 2.0, 3.0),
                shape,
                ..Obstacle::default()
            };
            let solids = obstacle.solids();
            assert_eq!(solids.len(), 1);
            assert_eq!(solids[0].center.si().to_array(), [1.0, 2.0, z_m]);
        }
    }

    #[test]
    fn files_say_how_wide_a_round_thing_is_as_they_like() {
        let shape = |text: &str| serde_json::from_str::<ObstacleShape>(text);
        for (one, other) in [
            (
                r#"{"sphere": {"diameter": "3 m"}}"#,
                r#"{"sphere": {"radius": "1.5 m"}}"#,
            ),
            (
                r#"{"cylinder": {"diameter": "3 m"}}"#,
                r#"{"cylinder": {"radius": "1.5 m"}}"#,
            ),
            (
                r#"{"cone": {"diameter": "3 m"}}"#,
                r#"{"cone": {"radius": "1.5 m"}}"#,
            ),
            (
                r#"{"capsule": {"diameter": "3 m", "height": "9 m"}}"#,
                r#"{"capsule": {"radius": "1.5 m", "height": "9 m"}}"#,
            ),
        ] {
            assert_eq!(shape(one).expect("good"), shape(other).expect("good"));
        }
        let radius = m(1.0);
        let sphere = shape(r#"{"sphere": {}}"#).expect("good");
        assert_eq!(sphere, ObstacleShape::Sphere { radius });
        for text in [
            r#"{"sphere": {"radius": "1 m", "diameter": "2 m"}}"#,
            r#"{"sphere": {"height": "1 m"}}"#,
            r#"{"capsule": {"height": "1 m"}}"#,
            r#"{"capsule": {"diameter": "1 m"}}"#,
        ] {
            assert!(shape(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_capsule_is_as_high_as_it_says() {
        let shape = ObstacleShape::Capsule {
            radius: m(0.25),
            height: m(2.0),
        };
        let obstacle = Obstacle {
            shape,
            ..Obstacle::default()
        };
        let capsule = SolidShape::Capsule {
            radius: m(0.25),
            half_height: m(0.75),
        };
        assert_eq!(obstacle.solids()[0].shape, capsule);
    }

    #[test]
    fn an_obstacle_turns_about_its_position_with_all_its_parts() {
        let part = |x: f64| ObstaclePart {
            position: Offset::from_xyz(x, 0.0, 0.5),
            attitude: Attitude::IDENTITY,
            shape: ObstacleShape::default(),
        };
        let north = Attitude::from_yaw(Yaw::NORTH);
        let obstacle = Obstacle {
            position: Position::from_xyz(10.0, 0.0, 0.0),
            attitude: north,
            shape: ObstacleShape::Parts(vec![part(0.0), part(2.0)]),
            ..Obstacle::default()
        };
        let solids = obstacle.solids();
        assert!(near(solids[0].center.si(), [10.0, 0.0, 0.5]));
        assert!(near(solids[1].center.si(), [10.0, 2.0, 0.5]));
        assert_eq!(solids[1].attitude, north);
    }
}
