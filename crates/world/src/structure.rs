//! Structures: walls with doors, slabs with traps.
//!
//! Both are a box of `length` along `x`, `width` along `y` and `height` along `z` that stands on
//! its lower left corner and turns about a vertical axis through that corner. An opening cuts it
//! into pieces:
//!
//! ```text
//!   a wall from the side             a slab from above
//!   +------+======+-------+          +---------------------+
//!   |      |      |       |          |         D           |
//!   |  A   +------+   B   |          +-----+------+--------+
//!   |      | door |       |          |  A  | trap |   B    |
//!   |      |      |       |          +-----+------+--------+
//!   +------+      +-------+          |         C           |
//!   ^ position       A, B, top       ^ position, A B C D
//! ```

use crate::look::{Color, Meta, Texture};
use crate::obstacle::metre;
use crate::solid::Solid;
use crate::surface::{Surface, friction};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Angle, Length, Position};

/// A wall or a slab.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Structure {
    /// Its lower left corner: the least `x`, `y` and `z` before it is turned.
    pub position: Position,
    /// What it is.
    pub shape: StructureShape,
    /// Coulomb friction of its surface, 0 to 1000.
    pub friction: f64,
    /// Restitution of its surface: how much of a speed is left after a bounce, 0 to 1.
    pub restitution: f64,
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

impl Default for Structure {
    fn default() -> Self {
        Self {
            position: Position::ZERO,
            shape: StructureShape::default(),
            friction: friction(),
            restitution: Surface::USUAL.restitution,
            color: Color::rgb(77, 77, 77),
            texture: None,
            label: String::new(),
            meta: Meta::new(),
        }
    }
}

/// The shape of a structure. Sizes are above 0; 1 m where a file leaves them out.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum StructureShape {
    /// An upright wall.
    Wall {
        /// Size along `x`.
        #[serde(default = "metre")]
        length: Length,
        /// How thick it is: size along `y`.
        #[serde(default = "metre")]
        width: Length,
        /// Size along `z`.
        #[serde(default = "metre")]
        height: Length,
        /// Turned about the lower left corner, counter-clockwise.
        #[serde(default)]
        rotation: Angle,
        /// A way through, if there is one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        door: Option<Door>,
    },
    /// A floor or a ceiling.
    Surface {
        /// Size along `x`.
        #[serde(default = "metre")]
        length: Length,
        /// Size along `y`.
        #[serde(default = "metre")]
        width: Length,
        /// How thick it is: size along `z`.
        #[serde(default = "metre")]
        height: Length,
        /// Turned about the lower left corner, counter-clockwise.
        #[serde(default)]
        rotation: Angle,
        /// A hole, if there is one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        trap: Option<Trap>,
    },
}

impl Default for StructureShape {
    fn default() -> Self {
        Self::Wall {
            length: metre(),
            width: metre(),
            height: metre(),
            rotation: Angle::ZERO,
            door: None,
        }
    }
}

/// A door in a wall, open, from the floor up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Door {
    /// From the wall's left end to the door's left side, along the wall.
    pub position: Length,
    /// Along the wall.
    pub width: Length,
    /// From the foot of the wall.
    pub height: Length,
}

impl Default for Door {
    fn default() -> Self {
        Self {
            position: metre(),
            width: metre(),
            height: metre(),
        }
    }
}

/// A rectangular hole through a slab.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Trap {
    /// From the slab's corner to the hole, along the slab's length.
    pub x: Length,
    /// From the slab's corner to the hole, along the slab's width.
    pub y: Length,
    /// Along the slab's length.
    pub length: Length,
    /// Along the slab's width.
    pub width: Length,
}

impl Default for Trap {
    fn default() -> Self {
        Self {
            x: metre(),
            y: metre(),
            length: metre(),
            width: metre(),
        }
    }
}

/// Thinner pieces than this are left out, in metres.
const THINNEST_M: f64 = 1e-9;

impl Structure {
    /// The boxes it is made of: one without an opening, up to three with a door, up to four with a
    /// trap. Pieces that an opening at the edge leaves no room for are left out.
    pub fn solids(&self) -> Vec<Solid> {
        let (pieces, rotation) = match self.shape {
            StructureShape::Wall {
                length,
                width,
                height,
                rotation,
                door,
            } => (
                wall([length, width, height].map(Length::get), door),
                rotation,
            ),
            StructureShape::Surface {
                length,
                width,
                height,
                rotation,
                trap,
            } => (
                slab([length, width, height].map(Length::get), trap),
                rotation,
            ),
        };
        let thick = |(low, high): &([f64; 3], [f64; 3])| {
            low.iter()
                .zip(high)
                .all(|(low, high)| high - low > THINNEST_M)
        };
        pieces
            .into_iter()
            .filter(thick)
            .map(|(low, high)| Solid::turned_box(self.position, rotation, low, high))
            .collect()
    }
}

/// Opposite corners of the pieces, relative to the lower left corner, in metres.
type Pieces = Vec<([f64; 3], [f64; 3])>;

fn wall([x, y, z]: [f64; 3], door: Option<Door>) -> Pieces {
    let Some(door) = door else {
        return vec![([0.0; 3], [x, y, z])];
    };
    let left = door.position.get().clamp(0.0, x);
    let right = (door.position + door.width).get().clamp(left, x);
    let top = door.height.get().clamp(0.0, z);
    vec![
        ([0.0; 3], [left, y, z]),
        ([right, 0.0, 0.0], [x, y, z]),
        ([left, 0.0, top], [right, y, z]),
    ]
}

fn slab([x, y, z]: [f64; 3], trap: Option<Trap>) -> Pieces {
    let Some(trap) = trap else {
        return vec![([0.0; 3], [x, y, z])];
    };
    let west = trap.x.get().clamp(0.0, x);
    let east = (trap.x + trap.length).get().clamp(west, x);
    let south = trap.y.get().clamp(0.0, y);
    let north = (trap.y + trap.width).get().clamp(south, y);
    vec![
        ([0.0, south, 0.0], [west, north, z]),
        ([east, south, 0.0], [x, north, z]),
        ([0.0; 3], [x, south, z]),
        ([0.0, north, 0.0], [x, y, z]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::SolidShape;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn volume_m3(solids: &[Solid]) -> f64 {
        let volume = |s: &Solid| match s.shape {
            SolidShape::Box {
                half_length,
                half_width,
                half_height,
            } => 8.0 * half_length.get() * half_width.get() * half_height.get(),
            _ => 0.0,
        };
        solids.iter().map(volume).sum()
    }

    fn surface(trap: Trap, degrees: f64) -> Structure {
        Structure {
            position: Position::new(m(1.0), m(2.0), m(3.0)),
            shape: StructureShape::Surface {
                length: m(6.0),
                width: m(4.0),
                height: m(0.1),
                rotation: Angle::si(degrees.to_radians()),
                trap: Some(trap),
            },
            ..Structure::default()
        }
    }

    #[test]
    fn a_door_leaves_the_wall_less_its_own_volume() {
        let shape = StructureShape::Wall {
            length: m(5.0),
            width: m(0.2),
            height: m(3.0),
            rotation: Angle::ZERO,
            door: Some(Door {
                position: m(1.0),
                width: m(0.9),
                height: m(2.0),
            }),
        };
        let solids = Structure {
            shape,
            ..Structure::default()
        }
        .solids();
        assert_eq!(solids.len(), 3);
        let want = 5.0 * 0.2 * 3.0 - 0.9 * 0.2 * 2.0;
        assert!((volume_m3(&solids) - want).abs() < 1e-12);
    }

    #[test]
    fn a_door_at_the_end_as_high_as_the_wall_leaves_one_piece() {
        let shape = StructureShape::Wall {
            length: m(5.0),
            width: m(0.2),
            height: m(3.0),
            rotation: Angle::ZERO,
            door: Some(Door {
                position: m(0.0),
                width: m(1.0),
                height: m(3.0),
            }),
        };
        assert_eq!(
            Structure {
                shape,
                ..Structure::default()
            }
            .solids()
            .len(),
            1
        );
    }

    /// The original was right for square holes at rotation 0 only.
    #[test]
    fn a_trap_is_right_at_any_rotation_and_any_proportion() {
        let trap = Trap {
            x: m(1.0),
            y: m(2.0),
            length: m(3.0),
            width: m(0.5),
        };
        for degrees in [0.0, 30.0, 90.0, -120.0] {
            let solids = surface(trap, degrees).solids();
            assert_eq!(solids.len(), 4);
            assert!((volume_m3(&solids) - 0.1 * (24.0 - 1.5)).abs() < 1e-12);
            // The middle of the hole is in no piece; a point beside it is in one.
            assert_eq!(pieces_at(&solids, degrees, 2.5, 2.25), 0, "{degrees}");
            assert_eq!(pieces_at(&solids, degrees, 0.5, 2.25), 1, "{degrees}");
            assert_eq!(pieces_at(&solids, degrees, 2.5, 3.9), 1, "{degrees}");
        }
    }

    /// How many pieces hold the point at (x, y) of the unturned slab.
    fn pieces_at(solids: &[Solid], degrees: f64, x: f64, y: f64) -> usize {
        let (sin, cos) = simbeeotic_units::math::sin_cos(degrees.to_radians());
        let (px, py) = (1.0 + cos * x - sin * y, 2.0 + sin * x + cos * y);
        solids
            .iter()
            .filter(|s| {
                let SolidShape::Box {
                    half_length,
                    half_width,
                    ..
                } = s.shape
                else {
                    return false;
                };
                let (dx, dy) = (px - s.center.si().x, py - s.center.si().y);
                (cos * dx + sin * dy).abs() <= half_length.get()
                    && (cos * dy - sin * dx).abs() <= half_width.get()
            })
            .count()
    }
}
