//! Mines: a shaft, levels, tunnels that branch, people at work.
//!
//! A mine is cut out of a grid of cells, the same on every level. The shaft takes a square of cells
//! through all levels. On each level a tunnel leaves it to the east, and others to the north, west
//! and south by chance. A tunnel runs straight, cell by cell, until it ends by chance, at the edge
//! of the grid or before another one; on its way tunnels branch off to both sides, fewer the deeper
//! in, as in the original: `branches` on the main tunnels, `branches / depth` on the others. Some
//! ends are chambers. So everything open is connected to the shaft, which is the only way in.
//!
//! Rock is what is left: it is not filled, but walls, floors and ceilings bound all that is open.

mod level;
#[cfg(test)]
mod tests;

use super::check::{GenerateError, at_least, metres, not_too_many, share, within};
use super::draft::{Draft, Finish, Line, Rect, block};
use crate::look::{Color, Meta};
use crate::obstacle::ObstacleShape;
use crate::world::World;
use glam::{DVec2, DVec3};
use level::{Level, step};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::Length;

/// Parameters of [`mine`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MineParams {
    /// The seed: another seed, another mine.
    pub seed: i64,
    /// Levels, one below the other, 1 to 50. Level 0 is the highest.
    pub levels: u32,
    /// Cells of the grid from west to east, 3 to 500.
    pub columns: u32,
    /// Cells of the grid from south to north, 3 to 500.
    pub rows: u32,
    /// How wide the shaft is, 0.5 m to 50 m: as many cells as that takes.
    pub shaft: Length,
    /// From wall to wall of a tunnel, 0.5 m to 20 m.
    pub tunnel_width: Length,
    /// From floor to ceiling of a tunnel, 0.5 m to 20 m.
    pub tunnel_height: Length,
    /// From the floor of a level to the floor of the next, up to 100 m.
    pub level_height: Length,
    /// How thick walls, floors and ceilings are, 1 cm to 2 m.
    pub wall_thickness: Length,
    /// The chance of a tunnel to leave the shaft on each of the other three sides, 0 to 1.
    pub openings: f64,
    /// The chance of a branch on each side of a cell of a main tunnel, 0 to 1.
    pub branches: f64,
    /// The chance of a branch to go on at each cell, 0 to 0.99. Main tunnels go on to the edge.
    pub advance: f64,
    /// The chance of a tunnel's end to be a chamber of 3 x 3 cells, 0 to 1.
    pub chambers: f64,
    /// The chance of a straight cell to have a timber frame, 0 to 1.
    pub frames: f64,
    /// The chance of a cell to have somebody in it, 0 to 1.
    pub people: f64,
    /// Whether tunnels have ceilings. Without them one looks into the highest level, and vehicles
    /// fly out of it.
    pub ceilings: bool,
    /// Every way is at least as wide and as high as this: a vehicle of this diameter gets
    /// everywhere. Above 0.
    pub clearance: Length,
}

impl Default for MineParams {
    /// Three levels, 75 m by 55 m.
    fn default() -> Self {
        Self {
            seed: 1,
            levels: 3,
            columns: 25,
            rows: 18,
            shaft: Length::si(4.0),
            tunnel_width: Length::si(2.5),
            tunnel_height: Length::si(2.5),
            level_height: Length::si(5.0),
            wall_thickness: Length::si(0.5),
            openings: 0.3,
            branches: 0.15,
            advance: 0.85,
            chambers: 0.3,
            frames: 0.3,
            people: 0.03,
            ceilings: true,
            clearance: Length::si(1.0),
        }
    }
}

impl MineParams {
    fn check(&self) -> Result<(), GenerateError> {
        within("levels", self.levels, 1..=50)?;
        within("columns", self.columns, 3..=500)?;
        within("rows", self.rows, 3..=500)?;
        metres("shaft", self.shaft, 0.5..=50.0)?;
        metres("tunnel_width", self.tunnel_width, 0.5..=20.0)?;
        metres("tunnel_height", self.tunnel_height, 0.5..=20.0)?;
        metres("level_height", self.level_height, 0.0..=100.0)?;
        metres("wall_thickness", self.wall_thickness, 0.01..=2.0)?;
        share("openings", self.openings)?;
        share("branches", self.branches)?;
        within("advance", self.advance, 0.0..=0.99)?;
        share("chambers", self.chambers)?;
        share("frames", self.frames)?;
        share("people", self.people)?;
        metres("clearance", self.clearance, 1e-3..=50.0)?;
        let least = self.tunnel_height + self.wall_thickness * 2.0;
        let why = "between two tunnels lie a ceiling and a floor";
        at_least("level_height", self.level_height, least, why)?;
        let beside = if self.people > 0.0 {
            2.0 * PERSON_M
        } else if self.frames > 0.0 {
            2.0 * TIMBER_M
        } else {
            0.0
        };
        let why = format!(
            "a vehicle of {} has to pass people and frames",
            self.clearance
        );
        let width = self.clearance + Length::si(beside);
        at_least("tunnel_width", self.tunnel_width, width, &why)?;
        let timber = if self.frames > 0.0 { TIMBER_M } else { 0.0 };
        let height = self.clearance + Length::si(timber);
        at_least("tunnel_height", self.tunnel_height, height, &why)?;
        if self.people > 0.0 {
            let why = "people stand upright";
            at_least("tunnel_height", self.tunnel_height, Length::si(TALL_M), why)?;
        }
        let (shaft, free) = (shaft_cells(self), self.columns.min(self.rows));
        let room = Length::si(f64::from(free - 2) * pitch(self) - self.wall_thickness.get());
        if shaft + 2 > free {
            return within("shaft", self.shaft, Length::si(0.5)..=room);
        }
        let cells = f64::from(self.columns) * f64::from(self.rows) * f64::from(self.levels);
        not_too_many("columns", "cells on all levels", cells)
    }
}

fn pitch(params: &MineParams) -> f64 {
    (params.tunnel_width + params.wall_thickness).get()
}

/// Cells across the shaft.
fn shaft_cells(params: &MineParams) -> u32 {
    let width = (params.shaft + params.wall_thickness).get();
    (width / pitch(params) - 1e-9).ceil().max(1.0) as u32
}

/// Half of the space that a person beside the way takes, and a person's height.
const PERSON_M: f64 = 0.6;
const TALL_M: f64 = 1.75;
/// A timber of a frame, in the square.
const TIMBER_M: f64 = 0.2;

const ROCK: [Color; 3] = [
    Color::rgb(128, 112, 98),
    Color::rgb(112, 104, 100),
    Color::rgb(96, 92, 94),
];
const FLOOR: Color = Color::rgb(84, 76, 68);
const TIMBER: Color = Color::rgb(146, 108, 66);

/// A mine around the origin, its lowest level on the ground.
///
/// Walls, floors and ceilings have their `level` as metadata; people have `person-id`, from 0. Places
/// are the `shaft`, high up in it, and the tunnels' ends (`end 0/3`: the fourth of level 0); vehicles
/// start in the area `shaft`, on the highest level.
///
/// # Errors
/// A parameter out of its range.
pub fn mine(params: &MineParams) -> Result<World, GenerateError> {
    params.check()?;
    let plan = Plan::new(params);
    let mut draft = Draft::default();
    let mut people = 0;
    for (at, level) in plan.levels.iter().enumerate() {
        plan.walls(&mut draft, at, level);
        plan.slabs(&mut draft, at, level);
        plan.furnish(&mut draft, at, level, &mut people);
    }
    plan.places(&mut draft);
    let size = DVec2::new(f64::from(params.columns), f64::from(params.rows)) * plan.pitch;
    draft.world.radius = Length::si(size.length().ceil());
    Ok(draft.world)
}

/// What is open, and where that lies.
struct Plan<'p> {
    params: &'p MineParams,
    levels: Vec<Level>,
    pitch: f64,
    /// The first cell of the shaft, and how many it has each way.
    shaft: [i32; 2],
    across: i32,
}

impl<'p> Plan<'p> {
    fn new(params: &'p MineParams) -> Self {
        let across = shaft_cells(params) as i32;
        let (columns, rows) = (params.columns as i32, params.rows as i32);
        let shaft = [(columns - across) / 2, (rows - across) / 2];
        let levels = 0..params.levels;
        Self {
            params,
            levels: levels
                .map(|at| Level::dug(params, at, shaft, across))
                .collect(),
            pitch: pitch(params),
            shaft,
            across,
        }
    }

    fn in_shaft(&self, [x, y]: [i32; 2]) -> bool {
        let [sx, sy] = self.shaft;
        (sx..sx + self.across).contains(&x) && (sy..sy + self.across).contains(&y)
    }

    /// The floor of a level; level 0 is the highest.
    fn foot(&self, level: usize) -> f64 {
        (self.params.levels as usize - 1 - level) as f64 * self.params.level_height.get()
    }

    /// The south-western corner of a cell, in the middle of its walls.
    fn corner(&self, x: i32, y: i32) -> DVec2 {
        let half = |n: u32| 0.5 * f64::from(n);
        let middle = DVec2::new(half(self.params.columns), half(self.params.rows));
        (DVec2::new(f64::from(x), f64::from(y)) - middle) * self.pitch
    }

    fn middle(&self, [x, y]: [i32; 2]) -> DVec2 {
        self.corner(x, y) + DVec2::splat(0.5 * self.pitch)
    }

    fn finish(&self, level: usize, color: Color, label: &str) -> Finish {
        Finish::new("concrete", color, label).with("level", level)
    }

    /// Walls between what is open and what is not; those of the shaft go up to the next level.
    fn walls(&self, draft: &mut Draft, at: usize, level: &Level) {
        let p = self.params;
        let half = 0.5 * p.wall_thickness.get();
        let finish = self.finish(at, ROCK[at % ROCK.len()], "wall");
        let foot = self.foot(at);
        let (low, high) = (p.tunnel_height.get(), p.level_height.get());
        // How a border is closed: from where to where.
        let border = |a: [i32; 2], b: [i32; 2]| {
            let (open, shaft) = (
                [a, b].map(|c| level.is_open(c)),
                [a, b].map(|c| self.in_shaft(c)),
            );
            match (open, shaft) {
                ([true, true], [true, false] | [false, true]) => Border::Lintel,
                ([true, false] | [false, true], [false, false]) => Border::Tunnel,
                ([true, false] | [false, true], _) => Border::Shaft,
                _ => Border::None,
            }
        };
        let mut lines = |borders: Vec<Border>, end: f64, place: &dyn Fn(i32) -> DVec2| {
            for (from, to, kind) in runs(&borders) {
                let (from, to) = (place(from), place(to));
                let along = (to - from).normalize() * end;
                let [bottom, top] = match kind {
                    Border::Tunnel => [0.0, low],
                    Border::Shaft => [0.0, high],
                    Border::Lintel => [low, high],
                    Border::None => continue,
                };
                let line = Line {
                    from: from - along,
                    to: to + along,
                    foot: foot + bottom,
                    height: top - bottom,
                    right: half,
                    left: half,
                };
                draft.wall(line, &[], &finish);
            }
        };
        for y in 0..=level.rows {
            let borders = (0..level.columns).map(|x| border([x, y - 1], [x, y]));
            lines(borders.collect(), half, &|x| self.corner(x, y));
        }
        for x in 0..=level.columns {
            let borders = (0..level.rows).map(|y| border([x - 1, y], [x, y]));
            // Those along y end beside those along x, or in them.
            lines(borders.collect(), -half, &|y| self.corner(x, y));
        }
    }

    /// Floors and ceilings of what is open beside the shaft.
    fn slabs(&self, draft: &mut Draft, at: usize, level: &Level) {
        let p = self.params;
        let (foot, thick) = (self.foot(at), p.wall_thickness.get());
        let half = DVec2::splat(0.5 * thick);
        let top = foot + p.tunnel_height.get();
        for y in 0..level.rows {
            let open = |x| level.is_open([x, y]) && !self.in_shaft([x, y]);
            let cells: Vec<bool> = (0..level.columns).map(open).collect();
            for (from, to, _) in runs(&cells).into_iter().filter(|run| run.2) {
                let rect = Rect {
                    low: self.corner(from, y) - half,
                    high: self.corner(to, y + 1) + half,
                };
                // Over the shaft there is nothing.
                let rect = self.beside_shaft(rect, [from, to], y);
                if foot > 0.0 {
                    let finish = self.finish(at, FLOOR, "floor");
                    draft.slab(rect, [foot - thick, foot], &[], &finish);
                }
                if p.ceilings {
                    let finish = self.finish(at, ROCK[at % ROCK.len()], "ceiling");
                    draft.slab(rect, [top, top + thick], &[], &finish);
                }
            }
        }
    }

    /// A slab's rim does not reach into the shaft.
    fn beside_shaft(&self, mut rect: Rect, [from, to]: [i32; 2], y: i32) -> Rect {
        let half = 0.5 * self.params.wall_thickness.get();
        if self.in_shaft([from - 1, y]) {
            rect.low.x += half;
        }
        if self.in_shaft([to, y]) {
            rect.high.x -= half;
        }
        if (from..to).any(|x| self.in_shaft([x, y + 1])) {
            rect.high.y -= half;
        }
        if (from..to).any(|x| self.in_shaft([x, y - 1])) {
            rect.low.y += half;
        }
        rect
    }

    /// Frames and people.
    fn furnish(&self, draft: &mut Draft, at: usize, level: &Level, people: &mut u32) {
        let p = self.params;
        let foot = self.foot(at);
        for y in 0..level.rows {
            for x in 0..level.columns {
                let cell = [x, y];
                if !level.is_open(cell) || self.in_shaft(cell) {
                    continue;
                }
                let path = format!("mine/level-{at}/cell-{x}-{y}");
                let stream = |purpose| Stream::new(p.seed.cast_unsigned(), &path, purpose);
                let open = [0, 1, 2, 3].map(|way| level.is_open(step(cell, way)));
                let along_x = open == [true, false, true, false];
                if (along_x || open == [false, true, false, true])
                    && stream("frame").bernoulli(p.frames)
                {
                    self.frame(draft, self.middle(cell).extend(foot), along_x);
                }
                let mut chance = stream("person");
                if chance.bernoulli(p.people) {
                    let corner = chance.below(4);
                    let side = |bit: u64| if corner & bit == 0 { -1.0 } else { 1.0 };
                    let aside = 0.5 * p.tunnel_width.get() - 0.5 * PERSON_M;
                    let place = self.middle(cell) + DVec2::new(side(1), side(2)) * aside;
                    let finish = Finish {
                        label: "miner".to_owned(),
                        material: Some("human-body"),
                        color: Some(Color::rgb(214, 120, 40)),
                        ..Finish::default()
                    };
                    let finish = finish.with("person-id", *people).with("level", at);
                    draft.person(place.extend(foot), 0.0, [0.5, TALL_M], &finish);
                    *people += 1;
                }
            }
        }
    }

    /// Two posts and a beam across a tunnel.
    fn frame(&self, draft: &mut Draft, foot: DVec3, along_x: bool) {
        let (side, half) = (0.5 * self.params.tunnel_width.get(), 0.5 * TIMBER_M);
        let (top, inner) = (self.params.tunnel_height.get(), side - TIMBER_M);
        let parts = vec![
            block([-half, inner, 0.0], [half, side, top]),
            block([-half, -side, 0.0], [half, -inner, top]),
            block([-half, -inner, top - TIMBER_M], [half, inner, top]),
        ];
        let yaw = if along_x {
            0.0
        } else {
            std::f64::consts::FRAC_PI_2
        };
        let finish = Finish::new("wood", TIMBER, "frame");
        draft.obstacle(foot, yaw, ObstacleShape::Parts(parts), &finish);
    }

    fn places(&self, draft: &mut Draft) {
        let [x, y] = self.shaft;
        let across = f64::from(self.across);
        let shaft = self.corner(x, y) + DVec2::splat(0.5 * across * self.pitch);
        let height = 0.5 * self.params.tunnel_height.get();
        let radius = 0.5 * (across * self.pitch - self.params.wall_thickness.get());
        let top = shaft.extend(self.foot(0) + height);
        draft.place("shaft", top, radius, Meta::new());
        let room = DVec3::new(0.5 * radius, 0.5 * radius, 0.5 * height);
        draft.spawn("shaft", top - room, top + room);
        for (at, level) in self.levels.iter().enumerate() {
            for (end, cell) in level.ends.iter().enumerate() {
                let place = self.middle(*cell).extend(self.foot(at) + height);
                let radius = 0.5 * self.params.tunnel_width.get();
                draft.place(format!("end {at}/{end}"), place, radius, Meta::new());
            }
        }
    }
}

/// What is between two cells.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Border {
    None,
    /// A wall as high as a tunnel.
    Tunnel,
    /// A wall as high as a level.
    Shaft,
    /// The wall of the shaft over a tunnel.
    Lintel,
}

/// Runs of equal things: beginning, end, what.
fn runs<T: Copy + PartialEq>(things: &[T]) -> Vec<(i32, i32, T)> {
    let mut all: Vec<(i32, i32, T)> = Vec::new();
    for (at, thing) in (0..).zip(things) {
        match all.last_mut() {
            Some((_, to, last)) if last == thing => *to = at + 1,
            _ => all.push((at, at + 1, *thing)),
        }
    }
    all
}
