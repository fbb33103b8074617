//! Office buildings: floors of corridors with rooms on both sides.
//!
//! ```text
//!   +---+------+-------+-----+----+     north rooms
//!   | L |      |       |     |    |
//!   | o +-- ---+--- ---+- ---+- --+
//!     b          corridor         W     entrance in the west, a window at each corridor's end
//!   | b +- ----+-- ----+-- --+-- -+
//!   | y |      |       |     |    |
//!   +---+------+-------+-----+----+     south rooms
//! ```
//! Further corridors stand north of the first, back to back. The lobby joins them; over it, each
//! slab has an opening, so that a vehicle changes floors. Each room has a door to its corridor, and
//! some have one to the room west of them. Furniture stays below head height and out of the way.

mod furniture;
mod room;
#[cfg(test)]
mod tests;

use super::check::{GenerateError, at_least, metres, not_too_many, share, within};
use super::draft::{Draft, Finish, Line, Opening, Rect};
use crate::look::{Color, Meta};
use crate::world::World;
use furniture::furnish;
use glam::{DVec2, DVec3};
use room::{Room, row};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_units::Length;

/// Parameters of [`office`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct OfficeParams {
    /// The seed: another seed, another building.
    pub seed: i64,
    /// Floors, one upon another, 1 to 100.
    pub floors: u32,
    /// Corridors on each floor, side by side, 1 to 50.
    pub corridors: u32,
    /// Rooms on each side of a corridor, 1 to 200.
    pub rooms: u32,
    /// How wide a room is along the corridor, on average, 1.5 m to 50 m.
    pub room_width: Length,
    /// How far rooms reach from the corridor, 2 m to 50 m.
    pub room_depth: Length,
    /// How much widths of rooms differ: each is drawn within this share of the average, 0 to 0.5.
    pub room_variation: f64,
    /// How wide corridors are between their walls, 0.5 m to 20 m.
    pub corridor_width: Length,
    /// How wide the lobby in the west is, 2 m to 50 m.
    pub lobby_width: Length,
    /// From floor to ceiling, 2.2 m to 20 m.
    pub storey_height: Length,
    /// How thick walls are, 5 cm to 1 m.
    pub wall_thickness: Length,
    /// How thick the slab between two floors is, 5 cm to 2 m.
    pub slab_thickness: Length,
    /// How wide doors are, 0.4 m to 5 m. The entrance is twice as wide.
    pub door_width: Length,
    /// How high doors are, 0.5 m to 10 m.
    pub door_height: Length,
    /// The chance of a room to have a door to its western neighbour too, 0 to 1.
    pub extra_doors: f64,
    /// Whether outer walls have windows.
    pub windows: bool,
    /// Whether windows are closed by glass.
    pub glass: bool,
    /// The side of the square opening between two floors, 0.5 m to 20 m.
    pub shaft: Length,
    /// The chance of each piece of furniture to be there, 0 to 1.
    pub furniture: f64,
    /// Whether a slab closes the highest floor. Without it one looks in, and vehicles fly out.
    pub roof: bool,
    /// Every way is at least as wide and as high as this: a vehicle of this diameter gets
    /// everywhere. 1 cm to 20 m.
    pub clearance: Length,
}

impl Default for OfficeParams {
    fn default() -> Self {
        Self {
            seed: 1,
            floors: 2,
            corridors: 1,
            rooms: 5,
            room_width: Length::si(4.0),
            room_depth: Length::si(5.0),
            room_variation: 0.25,
            corridor_width: Length::si(2.0),
            lobby_width: Length::si(5.0),
            storey_height: Length::si(3.0),
            wall_thickness: Length::si(0.15),
            slab_thickness: Length::si(0.3),
            door_width: Length::si(0.9),
            door_height: Length::si(2.1),
            extra_doors: 0.15,
            windows: true,
            glass: true,
            shaft: Length::si(2.0),
            furniture: 0.8,
            roof: false,
            clearance: Length::si(0.6),
        }
    }
}

impl OfficeParams {
    fn check(&self) -> Result<(), GenerateError> {
        within("floors", self.floors, 1..=100)?;
        within("corridors", self.corridors, 1..=50)?;
        within("rooms", self.rooms, 1..=200)?;
        let rooms = [self.floors, self.corridors, self.rooms].map(f64::from);
        // Ten things in a room or so.
        let things = rooms.iter().product::<f64>() * 2.0 * 10.0;
        not_too_many("rooms", "walls and pieces of furniture", things)?;
        metres("room_width", self.room_width, 1.5..=50.0)?;
        metres("room_depth", self.room_depth, 2.0..=50.0)?;
        within("room_variation", self.room_variation, 0.0..=0.5)?;
        metres("corridor_width", self.corridor_width, 0.5..=20.0)?;
        metres("lobby_width", self.lobby_width, 2.0..=50.0)?;
        metres("storey_height", self.storey_height, 2.2..=20.0)?;
        metres("wall_thickness", self.wall_thickness, 0.05..=1.0)?;
        metres("slab_thickness", self.slab_thickness, 0.05..=2.0)?;
        metres("door_width", self.door_width, 0.4..=5.0)?;
        metres("door_height", self.door_height, 0.5..=10.0)?;
        share("extra_doors", self.extra_doors)?;
        metres("shaft", self.shaft, 0.5..=20.0)?;
        share("furniture", self.furniture)?;
        metres("clearance", self.clearance, 0.01..=20.0)?;
        self.fits()
    }

    /// What has to pass through what.
    fn fits(&self) -> Result<(), GenerateError> {
        let clear = self.clearance;
        let why = format!("a vehicle of {clear} has to pass");
        at_least("door_width", self.door_width, clear, &why)?;
        at_least("door_height", self.door_height, clear, &why)?;
        at_least("corridor_width", self.corridor_width, clear, &why)?;
        at_least("shaft", self.shaft, clear, &why)?;
        let above = Length::si(HEAD_M) + clear;
        let why = format!("a vehicle of {clear} has to pass over the furniture");
        at_least("storey_height", self.storey_height, above, &why)?;
        let why = "doors end below the ceiling";
        at_least("storey_height", self.storey_height, self.door_height, why)?;
        let narrowest = (1.0 - self.room_variation) / (1.0 + self.room_variation);
        let least = (self.door_width + self.wall_thickness + Length::si(2.0 * JAMB_M)) / narrowest;
        at_least(
            "room_width",
            self.room_width,
            least,
            "the narrowest room has to have its door",
        )?;
        let around = self.shaft + (self.wall_thickness + clear) * 2.0;
        at_least(
            "lobby_width",
            self.lobby_width,
            around,
            "the opening between floors, and a way around it, lie in it",
        )?;
        let deep = self.room_depth * 2.0 + self.corridor_width;
        let why = "the lobby is as deep as the building: the opening between floors lies in it";
        if deep < around {
            return at_least(
                "room_depth",
                self.room_depth,
                (around - self.corridor_width) * 0.5,
                why,
            );
        }
        let why = "the entrance is twice as wide as a door, and in the lobby's wall";
        at_least("room_depth", self.room_depth, self.door_width * 2.0, why)
    }
}

/// Furniture is lower than this.
const HEAD_M: f64 = 1.95;
/// Of wall beside a door.
const JAMB_M: f64 = 0.1;
const SILL_M: f64 = 0.9;
const PANE_M: f64 = 0.02;
const WINDOW_M: [f64; 2] = [1.6, 1.3];
const OUTER: Color = Color::rgb(176, 110, 84);
const CORRIDOR: Color = Color::rgb(236, 230, 214);
const INNER: Color = Color::rgb(222, 226, 230);

/// An office building around the origin, its lowest floor on the ground.
///
/// Rooms have numbers: `2.14` is room 14 of floor 2, the lowest being floor 0. Walls to corridors,
/// panes and furniture carry `room` and `floor` as metadata; places are called `room 2.14`,
/// `lobby 2` and `entrance`; the area to start in, before the entrance, `entrance` too.
///
/// # Errors
/// A parameter out of its range.
pub fn office(params: &OfficeParams) -> Result<World, GenerateError> {
    params.check()?;
    Ok(Building::new(params).build().world)
}

struct Building<'p> {
    p: &'p OfficeParams,
    /// The whole, from the middle of its outer walls.
    rect: Rect,
    rooms: Vec<Room>,
}

impl<'p> Building<'p> {
    fn new(p: &'p OfficeParams) -> Self {
        let length = p.lobby_width.get() + f64::from(p.rooms) * p.room_width.get();
        let wing = 2.0 * p.room_depth.get() + p.corridor_width.get() + p.wall_thickness.get();
        let width = f64::from(p.corridors) * wing;
        let half = 0.5 * DVec2::new(length, width);
        let rect = Rect {
            low: -half,
            high: half,
        };
        let mut rooms = Vec::new();
        for floor in 0..p.floors as usize {
            for wing_at in 0..p.corridors as usize {
                for north in [false, true] {
                    row(p, rect, [floor, wing_at], north, &mut rooms);
                }
            }
        }
        Self { p, rect, rooms }
    }

    fn foot(&self, floor: usize) -> f64 {
        floor as f64 * (self.p.storey_height + self.p.slab_thickness).get()
    }

    fn lobby_east(&self) -> f64 {
        self.rect.low.x + self.p.lobby_width.get()
    }

    /// The lines of the corridors' middles.
    fn corridors(&self) -> impl Iterator<Item = f64> {
        let wing = self.rect.size().y / f64::from(self.p.corridors);
        let south = self.rect.low.y;
        (0..self.p.corridors).map(move |at| south + wing * (f64::from(at) + 0.5))
    }

    fn build(&self) -> Draft {
        let p = self.p;
        let mut draft = Draft::default();
        for floor in 0..p.floors as usize {
            self.slab(&mut draft, floor);
            self.outer_walls(&mut draft, floor);
            self.backs(&mut draft, floor);
            let at = DVec2::new(
                0.5 * (self.rect.low.x + self.lobby_east()),
                self.rect.middle().y,
            );
            let up = 0.5 * p.storey_height.get();
            let meta = Meta::from([("floor".to_owned(), floor.to_string())]);
            let radius = 0.5 * p.lobby_width.get();
            draft.place(
                format!("lobby {floor}"),
                at.extend(self.foot(floor) + up),
                radius,
                meta,
            );
        }
        if p.roof {
            let foot = self.foot(p.floors as usize) - p.slab_thickness.get();
            let z = [foot, foot + p.slab_thickness.get()];
            draft.slab(self.around(), z, &[], &Finish::of("concrete", "roof"));
        }
        for room in &self.rooms {
            self.room(&mut draft, room);
        }
        let door = DVec3::new(self.rect.low.x, self.rect.middle().y, 0.0);
        let side = 0.5 * p.door_height.get();
        draft.place(
            "entrance",
            door + DVec3::Z * side,
            p.door_width.get(),
            Meta::new(),
        );
        let low = door + DVec3::new(-5.0, -2.0, 0.5);
        draft.spawn("entrance", low, low + DVec3::new(3.0, 4.0, 1.0));
        draft.world.radius = Length::si((self.rect.size().length() + 10.0).ceil());
        draft
    }

    /// The building with its outer walls.
    fn around(&self) -> Rect {
        let half = DVec2::splat(0.5 * self.p.wall_thickness.get());
        Rect {
            low: self.rect.low - half,
            high: self.rect.high + half,
        }
    }

    fn slab(&self, draft: &mut Draft, floor: usize) {
        if floor == 0 {
            return;
        }
        let middle = DVec2::new(
            0.5 * (self.rect.low.x + self.lobby_east()),
            self.rect.middle().y,
        );
        let half = DVec2::splat(0.5 * self.p.shaft.get());
        let hole = Rect {
            low: middle - half,
            high: middle + half,
        };
        let top = self.foot(floor);
        let z = [top - self.p.slab_thickness.get(), top];
        let finish = Finish::of("concrete", format!("slab {floor}")).with("floor", floor);
        draft.slab(self.around(), z, &[hole], &finish);
    }

    fn line(&self, floor: usize, from: DVec2, to: DVec2) -> Line {
        let half = 0.5 * self.p.wall_thickness.get();
        Line {
            from,
            to,
            foot: self.foot(floor),
            height: self.p.storey_height.get(),
            right: half,
            left: half,
        }
    }

    /// A window in the middle of a stretch of wall, if there is room for one.
    fn window(&self, from: f64, to: f64) -> Option<Opening> {
        let [width, height] = WINDOW_M;
        let width = width.min(to - from - 0.8);
        let height = height.min(self.p.storey_height.get() - SILL_M - 0.2);
        (self.p.windows && width > 0.4).then_some(Opening {
            at: 0.5 * (from + to - width),
            width,
            sill: SILL_M,
            height,
        })
    }

    /// A wall with windows, and the panes in them.
    fn glazed(&self, draft: &mut Draft, line: Line, openings: &[(Opening, Meta)], finish: &Finish) {
        let holes: Vec<Opening> = openings.iter().map(|(opening, _)| *opening).collect();
        draft.wall(line, &holes, finish);
        let along = (line.to - line.from).normalize_or_zero();
        for (window, meta) in openings.iter().filter(|(o, _)| o.sill > 0.0) {
            if !self.p.glass {
                continue;
            }
            let pane = Line {
                from: line.from + along * window.at,
                to: line.from + along * (window.at + window.width),
                foot: line.foot + window.sill,
                height: window.height,
                right: 0.5 * PANE_M,
                left: 0.5 * PANE_M,
            };
            let finish = Finish {
                meta: meta.clone(),
                ..Finish::of("glass", "pane")
            };
            draft.wall(pane, &[], &finish);
        }
    }

    fn outer_walls(&self, draft: &mut Draft, floor: usize) {
        let around = self.around();
        let finish = Finish::new("brick", OUTER, "outer wall").with("floor", floor);
        let here = Meta::from([("floor".to_owned(), floor.to_string())]);
        for north in [false, true] {
            let y = if north {
                self.rect.high.y
            } else {
                self.rect.low.y
            };
            let from = DVec2::new(around.low.x, y);
            let rooms = self.rooms.iter().filter(|room| {
                let side = if north {
                    room.rect.high.y
                } else {
                    room.rect.low.y
                };
                room.floor == floor && room.outer && room.corridor_north != north && side == y
            });
            let windows: Vec<(Opening, Meta)> = rooms
                .filter_map(|room| {
                    let [low, high] = [room.rect.low.x, room.rect.high.x].map(|x| x - from.x);
                    Some((self.window(low, high)?, room.meta()))
                })
                .collect();
            let line = self.line(floor, from, DVec2::new(around.high.x, y));
            self.glazed(draft, line, &windows, &finish);
        }
        // Between them, the walls in the west and in the east.
        let half = 0.5 * self.p.wall_thickness.get();
        let (south, north) = (self.rect.low.y + half, self.rect.high.y - half);
        let west = |x: f64| self.line(floor, DVec2::new(x, south), DVec2::new(x, north));
        let middle = 0.5 * (north - south);
        let door = 2.0 * self.p.door_width.get();
        let opening = match floor {
            0 => Some(Opening {
                at: middle - 0.5 * door,
                width: door,
                sill: 0.0,
                height: self.p.door_height.get(),
            }),
            _ => self.window(middle - 1.5, middle + 1.5),
        };
        let openings: Vec<_> = opening.map(|o| (o, here.clone())).into_iter().collect();
        self.glazed(draft, west(self.rect.low.x), &openings, &finish);
        let reach = 0.5 * self.p.corridor_width.get();
        let windows: Vec<_> = self
            .corridors()
            .filter_map(|y| self.window(y - reach - south, y + reach - south))
            .map(|window| (window, here.clone()))
            .collect();
        self.glazed(draft, west(self.rect.high.x), &windows, &finish);
    }

    /// Walls between rooms that stand back to back.
    fn backs(&self, draft: &mut Draft, floor: usize) {
        let half = 0.5 * self.p.wall_thickness.get();
        let wing = self.rect.size().y / f64::from(self.p.corridors);
        for at in 1..self.p.corridors {
            let y = self.rect.low.y + wing * f64::from(at);
            let from = DVec2::new(self.lobby_east() - half, y);
            let to = DVec2::new(self.rect.high.x - half, y);
            let finish = Finish::new("plasterboard", INNER, "").with("floor", floor);
            draft.wall(self.line(floor, from, to), &[], &finish);
        }
    }

    /// A room's wall to the corridor with its door, its wall to the west, what stands in it.
    fn room(&self, draft: &mut Draft, room: &Room) {
        let p = self.p;
        let half = 0.5 * p.wall_thickness.get();
        let (low, high) = (room.rect.low, room.rect.high);
        let y = if room.corridor_north { high.y } else { low.y };
        let first = low.x == self.lobby_east();
        // The last ends at the outer wall; the first covers the lobby's corner.
        let west = if first { low.x - half } else { low.x };
        let east = if high.x == self.rect.high.x {
            high.x - half
        } else {
            high.x
        };
        let door = Opening {
            at: room.door - west,
            width: p.door_width.get(),
            sill: 0.0,
            height: p.door_height.get(),
        };
        let line = self.line(room.floor, DVec2::new(west, y), DVec2::new(east, y));
        draft.wall(line, &[door], &room.finish("plasterboard", CORRIDOR));
        let from = DVec2::new(low.x, low.y + half);
        let to = DVec2::new(low.x, high.y - half);
        let between = Opening {
            at: 0.5 * (from.distance(to) - p.door_width.get()),
            ..door
        };
        let openings = if room.west_door {
            vec![between]
        } else {
            Vec::new()
        };
        let line = self.line(room.floor, from, to);
        draft.wall(line, &openings, &room.finish("plasterboard", INNER));
        furnish(draft, p, room);
        let radius = 0.5 * room.rect.size().min_element() - half;
        draft.place(
            format!("room {}", room.number),
            room.place(p),
            radius,
            room.meta(),
        );
    }
}
