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

use super::check::{GenerateError, at_least, metres, not_too_many, share, within};
use super::draft::{Draft, Finish, Line, Opening, Rect};
use super::furniture::furnish;
use crate::look::{Color, Meta};
use crate::world::World;
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
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
pub(super) const HEAD_M: f64 = 1.95;
/// Of wall beside a door.
const JAMB_M: f64 = 0.1;
const SILL_M: f64 = 0.9;
const PANE_M: f64 = 0.02;
const WINDOW_M: [f64; 2] = [1.6, 1.3];
const OUTER: Color = Color::rgb(176, 110, 84);
const CORRIDOR: Color = Color::rgb(236, 230, 214);
const INNER: Color = Color::rgb(222, 226, 230);

/// One room.
pub(super) struct Room {
    pub(super) floor: usize,
    /// Its number: `2.14` is room 14 of floor 2.
    pub(super) number: String,
    /// From the middle of its walls to the middle of its walls.
    pub(super) rect: Rect,
    pub(super) foot: f64,
    /// Whether the corridor is in its north.
    pub(super) corridor_north: bool,
    /// Where its door is: from this x on.
    pub(super) door: f64,
    /// Whether it has a door to the room west of it.
    pub(super) west_door: bool,
    /// Whether the room east of it has a door to it.
    pub(super) east_door: bool,
    /// Whether its wall opposite the corridor is an outer one.
    pub(super) outer: bool,
}

impl Room {
    pub(super) fn meta(&self) -> Meta {
        Meta::from([
            ("floor".to_owned(), self.floor.to_string()),
            ("room".to_owned(), self.number.clone()),
        ])
    }

    /// The stream of this room for a purpose.
    pub(super) fn chance(&self, seed: i64, purpose: &str) -> Stream {
        let path = format!("office/{}", self.number);
        Stream::new(seed.cast_unsigned(), &path, purpose)
    }

    fn finish(&self, material: &'static str, color: Color) -> Finish {
        Finish {
            meta: self.meta(),
            ..Finish::new(material, color, "")
        }
    }

    /// At the height that a vehicle is told to go to.
    fn place(&self, p: &OfficeParams) -> DVec3 {
        let clear = 0.5 * (HEAD_M + p.storey_height.get());
        self.rect.middle().extend(self.foot + clear)
    }
}

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

/// The rooms on one side of one corridor.
fn row(p: &OfficeParams, rect: Rect, [floor, wing]: [usize; 2], north: bool, all: &mut Vec<Room>) {
    let side = if north { "north" } else { "south" };
    let path = format!("office/floor-{floor}/corridor-{wing}-{side}");
    let mut chance = Stream::new(p.seed.cast_unsigned(), &path, "widths");
    let mut share = || 1.0 + p.room_variation * (2.0 * chance.uniform() - 1.0);
    let shares: Vec<f64> = (0..p.rooms).map(|_| share()).collect();
    let unit = f64::from(p.rooms) * p.room_width.get() / shares.iter().sum::<f64>();
    let wing_width = rect.size().y / f64::from(p.corridors);
    let south = rect.low.y + wing as f64 * wing_width;
    let depth = p.room_depth.get() + 0.5 * p.wall_thickness.get();
    let last_wing = wing + 1 == p.corridors as usize;
    let y = match (north, last_wing) {
        (false, _) => [south, south + depth],
        (true, true) => [south + wing_width - depth, rect.high.y],
        (true, false) => [south + wing_width - depth, south + wing_width],
    };
    let lobby = rect.low.x + p.lobby_width.get();
    let before = 2 * p.rooms as usize * wing + if north { p.rooms as usize } else { 0 };
    let per_floor = 2 * p.rooms as usize * p.corridors as usize;
    let digits = per_floor.to_string().len().max(2);
    let start = all.len();
    let mut x = lobby;
    for (at, share) in shares.iter().enumerate() {
        let last = at + 1 == shares.len();
        let end = if last { rect.high.x } else { x + unit * share };
        let mut room = Room {
            floor,
            number: format!("{floor}.{:0digits$}", before + at + 1),
            rect: Rect::new([x, end], y),
            foot: floor as f64 * (p.storey_height + p.slab_thickness).get(),
            corridor_north: !north,
            door: 0.0,
            west_door: false,
            east_door: false,
            outer: if north { last_wing } else { wing == 0 },
        };
        let margin = 0.5 * p.wall_thickness.get() + JAMB_M;
        let room_for_door = end - x - 2.0 * margin - p.door_width.get();
        let mut chance = room.chance(p.seed, "door");
        room.door = x + margin + room_for_door.max(0.0) * chance.uniform();
        let mut chance = room.chance(p.seed, "extra door");
        room.west_door = at > 0 && chance.bernoulli(p.extra_doors);
        if room.west_door
            && let Some(west) = all[start..].last_mut()
        {
            west.east_door = true;
        }
        all.push(room);
        x = end;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Search, fingerprint};
    use crate::structure::StructureShape;
    use simbeeotic_units::Position;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    fn small(seed: i64) -> OfficeParams {
        OfficeParams {
            seed,
            rooms: 2,
            room_width: m(3.0),
            room_depth: m(3.5),
            clearance: m(0.8),
            roof: true,
            ..OfficeParams::default()
        }
    }

    /// Names of rooms and lobbies that a vehicle does not reach from before the entrance.
    fn missed(params: &OfficeParams, world: &World) -> Vec<String> {
        let cell = 0.125 * params.clearance.get();
        let search = Search {
            vehicle_radius: m(0.5 * params.clearance.get() - 1.4 * cell),
            cell: m(cell),
            within: None,
            seed: 0,
        };
        let rect = Building::new(params).around();
        let start = Position::from_xyz(rect.low.x - 0.6, rect.middle().y, 1.0);
        let reach = search.run(world, start).expect("it starts outside");
        let places = world.places.iter();
        let missed = places.filter(|place| !reach.contains(place.position));
        missed.map(|place| place.name.clone()).collect()
    }

    #[test]
    fn every_room_of_every_floor_is_reached_from_the_street() {
        let none: [&str; 0] = [];
        for seed in 0..4 {
            let params = small(seed);
            let world = office(&params).expect("it can be");
            assert!(world.check().is_empty(), "{:?}", world.check());
            assert_eq!(missed(&params, &world), none, "seed {seed}");
        }
        let two_corridors = OfficeParams {
            corridors: 2,
            floors: 1,
            rooms: 3,
            ..small(9)
        };
        let world = office(&two_corridors).expect("it can be");
        assert_eq!(world.places.len(), 12 + 1 + 1);
        assert_eq!(missed(&two_corridors, &world), none);
        let narrow = OfficeParams {
            floors: 3,
            rooms: 1,
            room_variation: 0.0,
            shaft: m(0.8),
            door_width: m(0.8),
            ..small(2)
        };
        assert_eq!(missed(&narrow, &office(&narrow).expect("it can be")), none);
    }

    /// Negative control: one closed door is found.
    #[test]
    fn a_room_whose_doors_are_closed_is_missed_and_no_other() {
        let params = OfficeParams {
            extra_doors: 0.0,
            ..small(1)
        };
        let mut world = office(&params).expect("it can be");
        let closed = world.structures.iter_mut().find_map(|s| {
            let of_room = s.meta.get("room").is_some_and(|room| room == "1.03");
            match &mut s.shape {
                StructureShape::Wall(wall) if of_room && !wall.doors.is_empty() => {
                    wall.doors.clear();
                    Some(())
                }
                _ => None,
            }
        });
        assert!(closed.is_some());
        assert_eq!(missed(&params, &world), ["room 1.03"]);
    }

    #[test]
    fn every_room_has_a_door_and_each_outer_one_a_window_with_a_pane() {
        let world = office(&OfficeParams::default()).expect("it can be");
        let rooms: Vec<&str> = world
            .places
            .iter()
            .filter_map(|place| place.name.strip_prefix("room "))
            .collect();
        assert_eq!(rooms.len(), 20);
        assert_eq!((rooms[0], rooms[19]), ("0.01", "1.10"));
        for room in rooms {
            let of_room = world
                .structures
                .iter()
                .filter(|s| s.meta.get("room").is_some_and(|r| r == room));
            let doors = of_room.clone().filter(
                |s| matches!(&s.shape, StructureShape::Wall(wall) if !wall.doors.is_empty()),
            );
            assert!(doors.count() >= 1, "{room}");
            assert_eq!(of_room.filter(|s| s.label == "pane").count(), 1, "{room}");
        }
    }

    #[test]
    fn windows_do_not_move_the_furniture_and_floors_not_each_other() {
        let world = |change: fn(&mut OfficeParams)| {
            let mut params = OfficeParams::default();
            change(&mut params);
            office(&params).expect("it can be")
        };
        let usual = world(|_| ());
        assert!(usual.obstacles.len() > 40, "{}", usual.obstacles.len());
        assert_eq!(world(|p| p.windows = false).obstacles, usual.obstacles);
        let three = world(|p| p.floors = 3);
        assert_eq!(three.obstacles[..usual.obstacles.len()], usual.obstacles);
        assert_ne!(world(|p| p.seed = 2).obstacles, usual.obstacles);
        assert!(world(|p| p.furniture = 0.0).obstacles.is_empty());
    }

    #[test]
    fn an_office_stays_what_it_is() {
        let other = OfficeParams {
            seed: 4,
            corridors: 2,
            glass: false,
            ..OfficeParams::default()
        };
        let found =
            [OfficeParams::default(), other].map(|p| fingerprint(&office(&p).expect("it can be")));
        assert_eq!(found, GOLDEN, "{found:#018x?}");
    }
    const GOLDEN: [u64; 2] = [0x514f_812d_12ae_972c, 0x42c3_4229_a550_4f3c];

    #[test]
    fn nonsense_is_refused_with_what_is_allowed() {
        let with = |change: fn(&mut OfficeParams)| {
            let mut params = OfficeParams::default();
            change(&mut params);
            office(&params).expect_err("nonsense").to_string()
        };
        for (message, words) in [
            (
                with(|p| p.floors = 0),
                "`floors` must lie between 1 and 100",
            ),
            (
                with(|p| p.corridors = 51),
                "`corridors` must lie between 1 and 50",
            ),
            (with(|p| p.rooms = 0), "`rooms` must lie between 1 and 200"),
            (
                with(|p| (p.floors, p.corridors, p.rooms) = (100, 50, 200)),
                "at most 1000000",
            ),
            (
                with(|p| p.room_width = m(1.0)),
                "`room_width` must lie between",
            ),
            (
                with(|p| p.room_width = m(1.6)),
                "the narrowest room has to have its door",
            ),
            (
                with(|p| p.room_depth = m(f64::NAN)),
                "`room_depth` must lie between",
            ),
            (with(|p| p.room_variation = 0.6), "between 0 and 0.5"),
            (
                with(|p| p.corridor_width = m(0.5)),
                "a vehicle of 0.6 m has to pass",
            ),
            (
                with(|p| p.lobby_width = m(2.5)),
                "the opening between floors",
            ),
            (with(|p| p.storey_height = m(2.3)), "over the furniture"),
            (
                with(|p| p.door_height = m(3.5)),
                "doors end below the ceiling",
            ),
            (
                with(|p| p.door_width = m(0.5)),
                "`door_width` must be at least 0.600 m",
            ),
            (
                with(|p| p.extra_doors = -0.1),
                "`extra_doors` must lie between 0 and 1",
            ),
            (
                with(|p| p.furniture = 2.0),
                "`furniture` must lie between 0 and 1",
            ),
            (with(|p| p.shaft = m(0.5)), "`shaft` must be at least"),
            (
                with(|p| p.clearance = m(0.0)),
                "`clearance` must lie between",
            ),
            (
                with(|p| p.wall_thickness = m(0.0)),
                "`wall_thickness` must lie between",
            ),
            (
                with(|p| p.slab_thickness = m(9.0)),
                "`slab_thickness` must lie between",
            ),
        ] {
            assert!(message.contains(words), "{message}");
        }
    }
}
