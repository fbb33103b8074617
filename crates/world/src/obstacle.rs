//! Obstacles: a primitive that stands in the way.

use crate::look::{Color, Meta, Texture};
use crate::solid::{Solid, SolidShape};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Angle, Length, Position, Yaw};

/// A thing in the way.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Obstacle {
    /// The middle of its lowest side: with height 0 it stands on the ground.
    pub position: Position,
    /// What it is.
    pub shape: ObstacleShape,
    /// Its colour.
    pub color: Color,
    /// Its texture, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub texture: Option<Texture>,
    /// What it is called; empty for nothing.
    pub label: String,
    /// Names and values that contacts and sensors can read.
    pub meta: Meta,
}

impl Default for Obstacle {
    fn default() -> Self {
        Self {
            position: Position::ZERO,
            shape: ObstacleShape::default(),
            color: Color::rgb(140, 140, 140),
            texture: None,
            label: String::new(),
            meta: Meta::new(),
        }
    }
}

/// The shape of an obstacle. All sizes are above 0; 1 m where a file leaves them out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ObstacleShape {
    /// A box.
    Box {
        /// Size along `x`.
        #[serde(default = "metre")]
        length: Length,
        /// Size along `y`.
        #[serde(default = "metre")]
        width: Length,
        /// Size along `z`.
        #[serde(default = "metre")]
        height: Length,
        /// Turned about `z` through its middle, counter-clockwise.
        #[serde(default)]
        rotation: Angle,
    },
    /// An upright cylinder.
    Cylinder {
        /// Across.
        #[serde(default = "metre")]
        diameter: Length,
        /// Size along `z`.
        #[serde(default = "metre")]
        height: Length,
    },
    /// A sphere.
    Sphere {
        /// Its radius.
        #[serde(default = "metre")]
        radius: Length,
    },
    /// An upright cone, tip up.
    Cone {
        /// The radius of its base.
        #[serde(default = "metre")]
        radius: Length,
        /// From base to tip.
        #[serde(default = "metre")]
        height: Length,
    },
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

impl Obstacle {
    /// The primitive it is, standing on [`Obstacle::position`].
    ///
    /// The height of the position counts; the original put everything on the ground.
    pub fn solid(&self) -> Solid {
        let (shape, half_height, yaw) = match self.shape {
            ObstacleShape::Box {
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
                (shape, half_height, rotation)
            }
            ObstacleShape::Cylinder { diameter, height } => {
                let half_height = height * 0.5;
                (
                    SolidShape::Cylinder {
                        radius: diameter * 0.5,
                        half_height,
                    },
                    half_height,
                    Angle::ZERO,
                )
            }
            ObstacleShape::Sphere { radius } => {
                (SolidShape::Sphere { radius }, radius, Angle::ZERO)
            }
            ObstacleShape::Cone { radius, height } => {
                let half_height = height * 0.5;
                (
                    SolidShape::Cone {
                        radius,
                        half_height,
                    },
                    half_height,
                    Angle::ZERO,
                )
            }
        };
        let up = Position::new(Length::ZERO, Length::ZERO, half_height);
        Solid {
            shape,
            center: self.position + up,
            yaw: Yaw::new(yaw),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_obstacle_stands_on_the_height_it_was_given() {
        let at = Position::new(Length::si(1.0), Length::si(2.0), Length::si(3.0));
        let shapes = [
            (
                ObstacleShape::Sphere {
                    radius: Length::si(2.0),
                },
                5.0,
            ),
            (
                ObstacleShape::Cone {
                    radius: Length::si(1.0),
                    height: Length::si(2.0),
                },
                4.0,
            ),
            (
                ObstacleShape::Cylinder {
                    diameter: Length::si(1.0),
                    height: Length::si(3.0),
                },
                4.5,
            ),
            (ObstacleShape::default(), 3.5),
        ];
        for (shape, z_m) in shapes {
            let solid = Obstacle {
                position: at,
                shape,
                ..Obstacle::default()
            }
            .solid();
            assert_eq!(solid.center.si().to_array(), [1.0, 2.0, z_m]);
        }
    }
}
