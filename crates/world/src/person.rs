//! People: seven boxes that stand still.

use crate::look::{Color, Meta};
use crate::obstacle::metre;
use crate::solid::Solid;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Angle, Attitude, Length, Position, Yaw};

/// A person who stands still, facing `y` unless turned.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Person {
    /// The point on the ground between the feet.
    pub position: Position,
    /// What the person is.
    pub shape: PersonShape,
    /// Turned about a vertical axis through the position, counter-clockwise.
    #[serde(skip_serializing_if = "is_zero")]
    pub rotation: Angle,
    /// What the person is made of: a material of this world or one that is built in. Nothing known if left
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
    /// The colour. The material's, or `#cdaf9580`, if left out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub color: Option<Color>,
    /// What the person is called; empty for nothing.
    pub label: String,
    /// Names and values that contacts and sensors can read.
    pub meta: Meta,
}

fn is_zero(angle: &Angle) -> bool {
    *angle == Angle::ZERO
}

impl Default for Person {
    fn default() -> Self {
        Self {
            position: Position::ZERO,
            shape: PersonShape::default(),
            rotation: Angle::ZERO,
            material: None,
            friction: None,
            restitution: None,
            color: None,
            label: String::new(),
            meta: Meta::new(),
        }
    }
}

/// The shape of a person.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[non_exhaustive]
pub enum PersonShape {
    /// Two legs, a torso, two arms, a neck and a head.
    Man {
        /// From hand to hand, along `x`. Above 0; 1 m if left out.
        #[serde(default = "metre")]
        width: Length,
        /// From sole to crown. Above 0; 1 m if left out.
        #[serde(default = "metre")]
        height: Length,
    },
}

impl Default for PersonShape {
    fn default() -> Self {
        Self::Man {
            width: metre(),
            height: metre(),
        }
    }
}

/// Cells of the grid that the figure is drawn on, across and up.
const CELLS: f64 = 13.0;
/// Half the thickness of the figure, in parts of its height.
const HALF_THICKNESS: f64 = 0.075;
/// Legs, torso, arms, neck, head: left, right, bottom and top on the grid.
const BODY: [[f64; 4]; 7] = [
    [3.0, 6.0, 0.0, 6.0],
    [7.0, 10.0, 0.0, 6.0],
    [3.0, 10.0, 6.0, 10.0],
    [0.0, 2.0, 4.0, 10.0],
    [11.0, 13.0, 4.0, 10.0],
    [6.0, 7.0, 10.0, 11.0],
    [5.0, 8.0, 11.0, 13.0],
];

impl Person {
    /// The colour of a person who has neither one of their own nor a material with one.
    pub const COLOR: Color = Color::rgba(205, 175, 149, 128);

    /// The middle between sole and crown.
    pub fn middle(&self) -> Position {
        let PersonShape::Man { height, .. } = self.shape;
        self.position + Position::new(Length::ZERO, Length::ZERO, height * 0.5)
    }

    /// The boxes the figure is made of. The arms hang one cell beside the torso.
    pub fn solids(&self) -> Vec<Solid> {
        let PersonShape::Man { width, height } = self.shape;
        let (across_m, up_m) = (width.get() / CELLS, height.get() / CELLS);
        let thick_m = HALF_THICKNESS * height.get();
        let attitude = Attitude::from_yaw(Yaw::new(self.rotation));
        let boxed = |[left, right, bottom, top]: [f64; 4]| {
            let x_m = |cell: f64| (cell - 0.5 * CELLS) * across_m;
            let low = [x_m(left), -thick_m, bottom * up_m];
            let high = [x_m(right), thick_m, top * up_m];
            Solid::boxed(self.position, attitude, low, high)
        };
        BODY.into_iter().map(boxed).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::SolidShape;

    #[test]
    fn a_man_is_seven_boxes_as_wide_and_as_high_as_he_is() {
        let shape = PersonShape::Man {
            width: Length::si(0.5),
            height: Length::si(1.8),
        };
        let solids = Person {
            shape,
            ..Person::default()
        }
        .solids();
        assert_eq!(solids.len(), 7);
        let mut reach = [0.0_f64; 2];
        for solid in &solids {
            let SolidShape::Box {
                half_length,
                half_height,
                ..
            } = solid.shape
            else {
                continue;
            };
            let center = solid.center.si();
            reach[0] = reach[0].max(center.x.abs() + half_length.get());
            reach[1] = reach[1].max(center.z + half_height.get());
        }
        assert!(
            (reach[0] - 0.25).abs() < 1e-12 && (reach[1] - 1.8).abs() < 1e-12,
            "{reach:?}"
        );
    }
}
