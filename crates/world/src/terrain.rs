//! Terrain: uneven ground.

use crate::look::{Color, Meta, Texture};
use crate::solid::{Solid, SolidShape};
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
    /// What it is made of: a material of this world or one that is built in. Nothing known if left
    /// out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Coulomb friction of its surface, 0 to 1000. Its material's, or 0.5, if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<f64>,
    /// Restitution of its surface: how much of a speed is left after a bounce, 0 to 1. Its material's,
    /// or 0, if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub restitution: Option<f64>,
    /// Its colour. Its material's, or `#14461e`, if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
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
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct HeightField {
    /// A file of heights, instead of `heights`, relative to the world file: a grey PNG picture (8 or 16
    /// bits, north on top), an Esri ASCII grid (`.asc`), or plain numbers in metres with commas
    /// (`.csv`, the first line in the north). `None` once it is read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// How far it reaches from west to east. Above 0. An Esri grid knows it itself.
    pub length: Length,
    /// How far it reaches from south to north. Above 0. An Esri grid knows it itself.
    pub width: Length,
    /// How high black is in a picture; 0 m if left out. Another file's lowest height becomes this, and
    /// the others follow evenly, if both are given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min_height: Option<Length>,
    /// How high white is in a picture, which needs it. Another file's highest height becomes this.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_height: Option<Length>,
    /// The heights: rows from south to north, each from west to east. Two rows of two or more, all
    /// equally long.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub heights: Vec<Vec<Length>>,
}

/// The colour of the ground.
pub(crate) const fn green() -> Color {
    Color::rgb(20, 70, 30)
}

impl Terrain {
    /// The colour of terrain that has neither one of its own nor a material with one.
    pub const COLOR: Color = green();

    /// Terrain of these heights around the origin.
    pub fn new(height_field: HeightField) -> Self {
        Self {
            height_field,
            position: Position::ZERO,
            material: None,
            friction: None,
            restitution: None,
            color: None,
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
            ..HeightField::default()
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
