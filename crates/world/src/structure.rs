//! Structures: walls with doors and windows, slabs with traps.
//!
//! Both are a box of `length` along `x`, `width` along `y` and `height` along `z` whose lower left
//! corner stands at its position. `rotation` turns it about a vertical axis through that corner;
//! `attitude`, after it, turns it any way about the same corner. Openings cut it into pieces, of which
//! no two overlap:
//!
//! ```text
//!   a wall from the side                 a slab from above
//!   +------+======+---+====+----+        +---------------------+
//!   |      |      |   |    |    |        |          B          |
//!   |  A   +------+ B +----+  C |        +-----+------+--------+
//!   |      | door |   | win|    |        |  C  | trap |   D    |
//!   |      |      |   +----+    |        +-----+------+--------+
//!   +------+      +---+----+----+        |          A          |
//!   ^ position                           ^ position
//!     A, B, C, over the door, under        A, B, C, D
//!     and over the window
//! ```

use crate::cut::{Rectangle, cut};
use crate::look::{Color, Meta, Texture};
use crate::obstacle::{is_upright, metre};
use crate::solid::Solid;
use crate::spelling::one_or_more;
use schemars::{JsonSchema, Schema};
use serde::{Deserialize, Serialize};
use simbeeotic_units::{Angle, Attitude, Length, Offset, Position, Yaw};

/// A wall or a slab.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Structure {
    /// Its lower left corner: the least `x`, `y` and `z` before it is turned.
    pub position: Position,
    /// How it is turned about that corner, besides its shape's `rotation`; upright if left out.
    #[serde(skip_serializing_if = "is_upright")]
    pub attitude: Attitude,
    /// What it is.
    pub shape: StructureShape,
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
    /// Its colour. Its material's, or `#4d4d4d`, if left out.
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

impl Structure {
    /// The colour of a structure that has neither one of its own nor a material with one.
    pub const COLOR: Color = Color::rgb(77, 77, 77);
}

impl Default for Structure {
    fn default() -> Self {
        Self {
            position: Position::ZERO,
            attitude: Attitude::IDENTITY,
            shape: StructureShape::default(),
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

/// The shape of a structure. Sizes are above 0; 1 m where a file leaves them out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum StructureShape {
    /// An upright wall.
    Wall(Wall),
    /// A floor or a ceiling.
    Surface(Slab),
}

impl Default for StructureShape {
    fn default() -> Self {
        Self::Wall(Wall::default())
    }
}

/// An upright wall, with ways through it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(transform = door_too)]
pub struct Wall {
    /// Size along `x`.
    pub length: Length,
    /// How thick it is: size along `y`.
    pub width: Length,
    /// Size along `z`.
    pub height: Length,
    /// Turned about the lower left corner, counter-clockwise.
    pub rotation: Angle,
    /// Ways through it from its foot up. A file may say `door = { ... }` for one. No two openings
    /// overlap.
    #[serde(
        alias = "door",
        deserialize_with = "one_or_more",
        skip_serializing_if = "Vec::is_empty"
    )]
    pub doors: Vec<Door>,
    /// Ways through it at any height. A file may say `window = { ... }` for one.
    #[serde(
        alias = "window",
        deserialize_with = "one_or_more",
        skip_serializing_if = "Vec::is_empty"
    )]
    pub windows: Vec<Window>,
}

impl Default for Wall {
    fn default() -> Self {
        Self {
            length: metre(),
            width: metre(),
            height: metre(),
            rotation: Angle::ZERO,
            doors: Vec::new(),
            windows: Vec::new(),
        }
    }
}

/// A floor or a ceiling, with ways through it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
#[schemars(transform = trap_too)]
pub struct Slab {
    /// Size along `x`.
    pub length: Length,
    /// Size along `y`.
    pub width: Length,
    /// How thick it is: size along `z`.
    pub height: Length,
    /// Turned about the lower left corner, counter-clockwise.
    pub rotation: Angle,
    /// Holes. A file may say `trap = { ... }` for one. No two of them overlap.
    #[serde(
        alias = "trap",
        deserialize_with = "one_or_more",
        skip_serializing_if = "Vec::is_empty"
    )]
    pub traps: Vec<Trap>,
}

impl Default for Slab {
    fn default() -> Self {
        Self {
            length: metre(),
            width: metre(),
            height: metre(),
            rotation: Angle::ZERO,
            traps: Vec::new(),
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

/// A window in a wall, open.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Window {
    /// From the wall's left end to the window's left side, along the wall.
    pub position: Length,
    /// From the foot of the wall to the window's lower side.
    pub sill: Length,
    /// Along the wall.
    pub width: Length,
    /// From its lower side to its upper side.
    pub height: Length,
}

impl Default for Window {
    fn default() -> Self {
        Self {
            position: metre(),
            sill: metre(),
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

fn door_too(schema: &mut Schema) {
    singular(schema, "doors", "door", "#/$defs/Door");
    singular(schema, "windows", "window", "#/$defs/Window");
}

fn trap_too(schema: &mut Schema) {
    singular(schema, "traps", "trap", "#/$defs/Trap");
}

/// Adds the short spelling of a list that has one entry to a schema.
fn singular(schema: &mut Schema, many: &str, one: &str, entry: &str) {
    if let Some(properties) = schema.get_mut("properties").and_then(|p| p.as_object_mut()) {
        let words = format!("One {one}, instead of `{many}`.");
        let short = serde_json::json!({ "description": words, "$ref": entry });
        properties.insert(one.to_owned(), short);
    }
}

impl Door {
    pub(crate) fn opening(&self) -> Rectangle {
        let size = [self.width.get(), self.height.get()];
        Rectangle::new([self.position.get(), 0.0], size)
    }
}

impl Window {
    pub(crate) fn opening(&self) -> Rectangle {
        let size = [self.width.get(), self.height.get()];
        Rectangle::new([self.position.get(), self.sill.get()], size)
    }
}

impl Trap {
    /// Along the slab's width and its length: strips run along the length.
    pub(crate) fn opening(&self) -> Rectangle {
        let size = [self.width.get(), self.length.get()];
        Rectangle::new([self.y.get(), self.x.get()], size)
    }
}

impl Structure {
    /// The boxes it is made of: one without an opening, three with a door, four with a window or a
    /// trap, and so on. Pieces that an opening at the edge leaves no room for are left out.
    pub fn solids(&self) -> Vec<Solid> {
        let pieces = match &self.shape {
            StructureShape::Wall(wall) => wall.pieces(),
            StructureShape::Surface(slab) => slab.pieces(),
        };
        let attitude = self.turned();
        pieces
            .into_iter()
            .map(|(low_m, high_m)| Solid::boxed(self.position, attitude, low_m, high_m))
            .collect()
    }

    /// The middle of the whole, openings or not.
    pub fn middle(&self) -> Position {
        let [length, width, height] = self.size();
        self.position
            + self
                .turned()
                .rotate(Offset::new(length, width, height) * 0.5)
    }

    /// Length, width and height of the whole.
    pub fn size(&self) -> [Length; 3] {
        match &self.shape {
            StructureShape::Wall(wall) => [wall.length, wall.width, wall.height],
            StructureShape::Surface(slab) => [slab.length, slab.width, slab.height],
        }
    }

    /// How it stands: its rotation about `z` first, then its attitude.
    fn turned(&self) -> Attitude {
        let rotation = match &self.shape {
            StructureShape::Wall(wall) => wall.rotation,
            StructureShape::Surface(slab) => slab.rotation,
        };
        self.attitude * Attitude::from_yaw(Yaw::new(rotation))
    }
}

/// Opposite corners of the pieces, relative to the lower left corner, in metres.
type Pieces = Vec<([f64; 3], [f64; 3])>;

impl Wall {
    fn pieces(&self) -> Pieces {
        let doors = self.doors.iter().map(Door::opening);
        let openings: Vec<Rectangle> = doors
            .chain(self.windows.iter().map(Window::opening))
            .collect();
        let y = self.width.get();
        cut([self.length.get(), self.height.get()], &openings)
            .into_iter()
            .map(|Rectangle { low, high }| ([low[0], 0.0, low[1]], [high[0], y, high[1]]))
            .collect()
    }
}

impl Slab {
    fn pieces(&self) -> Pieces {
        let openings: Vec<Rectangle> = self.traps.iter().map(Trap::opening).collect();
        let z = self.height.get();
        cut([self.width.get(), self.length.get()], &openings)
            .into_iter()
            .map(|Rectangle { low, high }| ([low[1], low[0], 0.0], [high[1], high[0], z]))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solid::SolidShape;
    use glam::DVec3;
    use simbeeotic_kernel::Stream;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn half_m(solid: &Solid) -> DVec3 {
        match solid.shape {
            SolidShape::Box {
                half_length,
                half_width,
                half_height,
            } => DVec3::new(half_length.get(), half_width.get(), half_height.get()),
            _ => DVec3::ZERO,
        }
    }

    fn volume_m3(solids: &[Solid]) -> f64 {
        solids
            .iter()
            .map(|s| 8.0 * half_m(s).element_product())
            .sum()
    }

    /// How many pieces hold a point of the world.
    fn pieces_at(solids: &[Solid], point_m: DVec3) -> usize {
        let holds = |solid: &&Solid| {
            let inside = solid.attitude.quat().conjugate() * (point_m - solid.center.si());
            inside.abs().cmple(half_m(solid)).all()
        };
        solids.iter().filter(holds).count()
    }

    fn wall(doors: Vec<Door>, windows: Vec<Window>) -> Wall {
        Wall {
            length: m(5.0),
            width: m(0.2),
            height: m(3.0),
            doors,
            windows,
            ..Wall::default()
        }
    }

    fn standing(shape: StructureShape) -> Structure {
        Structure {
            shape,
            ..Structure::default()
        }
    }

    const DOOR: [f64; 3] = [1.0, 0.9, 2.0];

    fn door([position, width, height]: [f64; 3]) -> Door {
        Door {
            position: m(position),
            width: m(width),
            height: m(height),
        }
    }

    fn window([position, sill, width, height]: [f64; 4]) -> Window {
        Window {
            position: m(position),
            sill: m(sill),
            width: m(width),
            height: m(height),
        }
    }

    fn trap([x, y, length, width]: [f64; 4]) -> Trap {
        Trap {
            x: m(x),
            y: m(y),
            length: m(length),
            width: m(width),
        }
    }

    #[test]
    fn a_door_leaves_the_wall_less_its_own_volume() {
        let solids = standing(StructureShape::Wall(wall(vec![door(DOOR)], vec![]))).solids();
        assert_eq!(solids.len(), 3);
        let want = 5.0 * 0.2 * 3.0 - 0.9 * 0.2 * 2.0;
        assert!((volume_m3(&solids) - want).abs() < 1e-12);
    }

    #[test]
    fn a_door_at_the_end_as_high_as_the_wall_leaves_one_piece() {
        let shape = wall(vec![door([0.0, 1.0, 3.0])], vec![]);
        assert_eq!(standing(StructureShape::Wall(shape)).solids().len(), 1);
    }

    #[test]
    fn a_file_may_say_one_door_or_a_list_of_them() {
        let one: Wall = serde_json::from_str(r#"{"door": {"width": "2 m"}}"#).expect("one door");
        let many: Wall = serde_json::from_str(r#"{"doors": [{"width": "2 m"}]}"#).expect("a list");
        assert_eq!(one, many);
        assert_eq!(one.doors[0].width, m(2.0));
        let none: Wall = serde_json::from_str(r#"{"doors": []}"#).expect("no door");
        assert_eq!(none, Wall::default());
        assert!(serde_json::from_str::<Wall>(r#"{"door": {}, "doors": []}"#).is_err());
        assert!(serde_json::from_str::<Wall>(r#"{"door": {"sill": "1 m"}}"#).is_err());
    }

    /// Three points drawn from 0 to 1, in order and apart.
    fn cuts(stream: &mut Stream) -> [f64; 4] {
        let mut at = [0; 4].map(|_| stream.uniform());
        at.sort_by(f64::total_cmp);
        at
    }

    fn any_attitude(stream: &mut Stream) -> Attitude {
        let [w, x, y, z] = [0; 4].map(|_| stream.normal());
        Attitude::from_wxyz(w, x, y, z).expect("no four zeros")
    }

    /// The original had zero-thickness pieces, a turn applied twice, and was right for square holes
    /// at rotation 0 only.
    #[test]
    fn openings_are_where_they_are_said_to_be_at_any_attitude_and_proportion() {
        let mut stream = Stream::new(1, "structure", "test");
        for round in 0..200 {
            let (x, z) = (cuts(&mut stream), cuts(&mut stream));
            let (size, thick) = ([6.0, 4.0], 0.1 + stream.uniform());
            let (x, z) = (x.map(|x| 6.0 * x), z.map(|z| 4.0 * z));
            // Two openings side by side: one from the edge, one free.
            let openings = [
                Rectangle {
                    low: [x[0], 0.0],
                    high: [x[1], z[3]],
                },
                Rectangle {
                    low: [x[2], z[1]],
                    high: [x[3], z[2]],
                },
            ];
            let lengths = |r: &Rectangle| {
                [
                    r.low[0],
                    r.low[1],
                    r.high[0] - r.low[0],
                    r.high[1] - r.low[1],
                ]
            };
            let [first, second] = [lengths(&openings[0]), lengths(&openings[1])];
            let rotation = Angle::si(7.0 * stream.normal());
            let is_wall = round % 2 == 0;
            let shape = if is_wall {
                StructureShape::Wall(Wall {
                    length: m(size[0]),
                    width: m(thick),
                    height: m(size[1]),
                    rotation,
                    doors: vec![door([first[0], first[2], first[3]])],
                    windows: vec![window(second)],
                })
            } else {
                StructureShape::Surface(Slab {
                    length: m(size[0]),
                    width: m(size[1]),
                    height: m(thick),
                    rotation,
                    traps: vec![trap(first), trap(second)],
                })
            };
            let structure = Structure {
                position: Position::from_xyz(1.0, -2.0, 3.0),
                attitude: any_attitude(&mut stream),
                shape,
                ..Structure::default()
            };
            let solids = structure.solids();
            let open: f64 = [first, second].iter().map(|o| o[2] * o[3]).sum();
            let want = thick * (size[0] * size[1] - open);
            assert!((volume_m3(&solids) - want).abs() < 1e-9, "round {round}");
            let thinnest = solids.iter().map(|s| half_m(s).min_element());
            assert!(thinnest.fold(1.0, f64::min) > 0.0);
            for _ in 0..50 {
                let at = [8.0 * stream.uniform() - 1.0, 6.0 * stream.uniform() - 1.0];
                let inside = |low: [f64; 2], high: [f64; 2]| {
                    (0..2).all(|i| low[i] < at[i] && at[i] < high[i])
                };
                let free = openings.iter().any(|o| inside(o.low, o.high));
                let wanted = usize::from(inside([0.0; 2], size) && !free);
                let flat = match is_wall {
                    true => Offset::from_xyz(at[0], 0.5 * thick, at[1]),
                    false => Offset::from_xyz(at[0], at[1], 0.5 * thick),
                };
                let yaw = Attitude::from_yaw(Yaw::new(rotation));
                let turned = yaw.quat() * flat.si();
                let point = structure.position.si() + structure.attitude.quat() * turned;
                assert_eq!(pieces_at(&solids, point), wanted, "round {round}: {at:?}");
            }
        }
    }

    #[test]
    fn its_middle_is_that_of_the_whole() {
        let mut structure = standing(StructureShape::Wall(wall(vec![door(DOOR)], vec![])));
        structure.position = Position::from_xyz(1.0, 1.0, 1.0);
        assert_eq!(structure.middle(), Position::from_xyz(3.5, 1.1, 2.5));
    }
}
