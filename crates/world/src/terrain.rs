//! Terrain: uneven ground.

use crate::look::{Color, Meta, Texture};
use crate::solid::{Solid, SolidShape};
use crate::surface::{Surface, friction};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Attitude, Length, Position};

/// Uneven ground. The plane `z = 0` stays where it is, unless the scenario takes it away
/// (`[physics] ground = false`), and covers what lies deeper.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Terrain {
    /// Its heights.
    pub height_field: HeightField,
    /// The middle of the grid; heights count from its height.
    #[serde(default)]
    pub position: Position,
    /// Coulomb friction of its surface, 0 to 1000.
    #[serde(default = "friction")]
    pub friction: f64,
    /// Restitution of its surface: how much of a speed is left after a bounce, 0 to 1.
    #[serde(default)]
    pub restitution: f64,
    /// Its colour.
    #[serde(default = "green")]
    pub color: Color,
    /// Its texture, if it has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<Texture>,
    /// What it is called; empty for nothing.
    #[serde(default)]
    pub label: String,
    /// Names and values that contacts and sensors can read.
    #[serde(default)]
    pub meta: Meta,
}

/// Heights over a regular grid of points; between them the ground is flat triangles.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightField {
    /// How far it reaches from west to east. Above 0.
    pub length: Length,
    /// How far it reaches from south to north. Above 0.
    pub width: Length,
    /// The heights: rows from south to north, each from west to east. Two rows of two or more, all
    /// equally long.
    pub heights: Vec<Vec<Length>>,
}

/// The colour of the ground.
pub(crate) const fn green() -> Color {
    Color::rgb(20, 70, 30)
}

impl Terrain {
    /// Terrain of these heights around the origin.
    pub fn new(height_field: HeightField) -> Self {
        Self {
            height_field,
            position: Position::ZERO,
            friction: friction(),
            restitution: Surface::USUAL.restitution,
            color: green(),
            texture: None,
            label: String::new(),
            meta: Meta::new(),
        }
    }

    /// The surface that it is.
    pub fn solid(&self) -> Solid {
        let field = &self.height_field;
        Solid {
            shape: SolidShape::HeightField {
                length: field.length,
                width: field.width,
                columns: field.heights.first().map_or(0, Vec::len),
                heights: field.heights.concat().into(),
            },
            center: self.position,
            attitude: Attitude::IDENTITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_follow_each_other_from_south_to_north() {
        let m = Length::si;
        let terrain = Terrain::new(HeightField {
            length: m(10.0),
            width: m(20.0),
            heights: vec![vec![m(0.0), m(1.0), m(2.0)], vec![m(3.0), m(4.0), m(5.0)]],
        });
        let SolidShape::HeightField {
            columns, heights, ..
        } = terrain.solid().shape
        else {
            panic!("terrain is a height field");
        };
        assert_eq!((columns, heights.len()), (3, 6));
        assert_eq!(heights[3], m(3.0), "the second row begins in the west");
    }
}
