//! Mazes: cells between walls, floor upon floor.
//!
//! Each floor is a spanning tree of its cells, by Kruskal's algorithm with random weights: all inner
//! walls in random order, each taken out if the cells beside it are not connected yet. So every
//! cell is reached from every other, by one way only unless `sparseness` opens more. Between two
//! floors lies a slab with a trap over one cell. Walls in one line are one wall.

use super::check::{GenerateError, at_least, metres, not_too_many, share, within};
use super::draft::{Draft, Finish, Line, Rect, boxed};
use crate::look::{Color, Meta};
use crate::world::World;
use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::rng::Stream;
use simbeeotic_units::Length;

/// Parameters of [`maze`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MazeParams {
    /// The seed: another seed, another maze.
    pub seed: i64,
    /// Cells from west to east, 1 to 1,000.
    pub columns: u32,
    /// Cells from south to north, 1 to 1,000.
    pub rows: u32,
    /// Floors, one upon another, 1 to 100. All floors together have a million cells at most.
    pub floors: u32,
    /// From the middle of a wall to the middle of the next, 0.1 m to 100 m.
    pub cell: Length,
    /// How high the walls are, 0.1 m to 100 m.
    pub wall_height: Length,
    /// How thick the walls are, 1 mm to 10 m.
    pub wall_thickness: Length,
    /// How thick the slab between two floors is, 1 mm to 10 m.
    pub slab_thickness: Length,
    /// The chance of each inner wall that the maze would keep to be left out, 0 to 1.
    pub sparseness: f64,
    /// Whether there is a way in: a wall missing in the south of the lowest floor.
    pub entrance: bool,
    /// Whether there is a way out: a wall missing in the north of the highest floor.
    pub exit: bool,
    /// Whether a slab closes the highest floor. Without it one looks in, and vehicles fly over the
    /// walls.
    pub roof: bool,
    /// Every way is at least as wide and as high as this: a vehicle of this diameter gets
    /// everywhere. Above 0.
    pub clearance: Length,
}

impl Default for MazeParams {
    /// The original's maze, which was open above.
    fn default() -> Self {
        Self {
            seed: 1,
            columns: 10,
            rows: 10,
            floors: 1,
            cell: Length::si(1.0),
            wall_height: Length::si(1.0),
            wall_thickness: Length::si(0.1),
            slab_thickness: Length::si(0.1),
            sparseness: 0.0,
            entrance: true,
            exit: true,
            roof: false,
            clearance: Length::si(0.5),
        }
    }
}

impl MazeParams {
    fn check(&self) -> Result<(), GenerateError> {
        within("columns", self.columns, 1..=1_000)?;
        within("rows", self.rows, 1..=1_000)?;
        within("floors", self.floors, 1..=100)?;
        let cells = f64::from(self.columns) * f64::from(self.rows) * f64::from(self.floors);
        not_too_many("columns", "cells on all floors", cells)?;
        metres("cell", self.cell, 0.1..=100.0)?;
        metres("wall_height", self.wall_height, 0.1..=100.0)?;
        metres("wall_thickness", self.wall_thickness, 1e-3..=10.0)?;
        metres("slab_thickness", self.slab_thickness, 1e-3..=10.0)?;
        share("sparseness", self.sparseness)?;
        metres("clearance", self.clearance, 1e-3..=100.0)?;
        let why = format!(
            "a vehicle of {} has to pass between the walls",
            self.clearance
        );
        at_least(
            "cell",
            self.cell,
            self.clearance + self.wall_thickness,
            &why,
        )?;
        let why = format!("a vehicle of {} has to pass under the slab", self.clearance);
        at_least("wall_height", self.wall_height, self.clearance, &why)
    }
}

const OUTER: Color = Color::rgb(78, 88, 104);
const INNER: [Color; 4] = [
    Color::rgb(214, 202, 178),
    Color::rgb(186, 204, 190),
    Color::rgb(188, 198, 216),
    Color::rgb(216, 190, 190),
];
const WAY_IN: Color = Color::rgb(72, 160, 84);
const WAY_OUT: Color = Color::rgb(190, 70, 60);
/// How thick the mats at entrance and exit are, in metres.
const MAT_M: f64 = 0.01;

/// A maze around the origin, its lowest floor on the ground.
///
/// The mats inside the way in and the way out are labelled `entrance` and `exit`, as
/// are the places there, and an area to start in at the entrance; slabs `slab 1`,
/// `slab 2`, ... and `roof`.
///
/// # Errors
/// A parameter out of its range.
pub fn maze(params: &MazeParams) -> Result<World, GenerateError> {
    params.check()?;
    Ok(Plan::new(params).build().world)
}

/// Which walls stand, before anything is measured.
struct Plan<'p> {
    params: &'p MazeParams,
    floors: Vec<Floor>,
    /// Columns of the way in and the way out.
    entrance: Option<usize>,
    exit: Option<usize>,
}

struct Floor {
    /// Walls along x: `columns` in a line, `rows + 1` lines from the south.
    along_x: Vec<bool>,
    /// Walls along y: `rows` in a line, `columns + 1` lines from the west.
    along_y: Vec<bool>,
    /// The cell with the trap to the floor below: column and row.
    trap: [usize; 2],
}

impl<'p> Plan<'p> {
    fn new(params: &'p MazeParams) -> Self {
        let seed = params.seed.cast_unsigned();
        let (columns, rows) = (params.columns as usize, params.rows as usize);
        let mut floors: Vec<Floor> = (0..params.floors as usize)
            .map(|floor| Floor::new(params, floor))
            .collect();
        let column = |purpose| {
            let mut chance = Stream::new(seed, "maze", purpose);
            chance.below(columns as u64) as usize
        };
        let entrance = params.entrance.then(|| column("entrance"));
        let exit = params.exit.then(|| column("exit"));
        if let (Some(column), Some(floor)) = (entrance, floors.first_mut()) {
            floor.along_x[column] = false;
        }
        if let (Some(column), Some(floor)) = (exit, floors.last_mut()) {
            floor.along_x[rows * columns + column] = false;
        }
        Self {
            params,
            floors,
            entrance,
            exit,
        }
    }

    fn build(&self) -> Draft {
        let p = self.params;
        let size = Measures::new(p);
        let mut draft = Draft::default();
        for (at, floor) in self.floors.iter().enumerate() {
            let foot = size.foot(at);
            if at > 0 {
                let [column, row] = floor.trap;
                let half = DVec2::splat(0.5 * size.gap());
                let middle = size.middle(column, row);
                let trap = Rect {
                    low: middle - half,
                    high: middle + half,
                };
                let finish = Finish::of("concrete", format!("slab {at}"));
                draft.slab(size.whole(), [foot - size.slab, foot], &[trap], &finish);
            }
            self.walls(&mut draft, floor, at);
        }
        if p.roof {
            let foot = size.foot(self.floors.len()) - size.slab;
            let finish = Finish::of("concrete", "roof");
            draft.slab(size.whole(), [foot, foot + size.slab], &[], &finish);
        }
        self.ends(&mut draft);
        let wall_m = 0.5 * size.whole().size().length();
        draft.world.radius = Length::si((2.0 * wall_m).ceil());
        draft
    }

    /// Mats inside the way in and the way out.
    fn ends(&self, draft: &mut Draft) {
        let size = Measures::new(self.params);
        let (last_row, last_floor) = (self.params.rows as usize - 1, self.floors.len() - 1);
        let ends = [
            (self.entrance, 0, 0, "entrance", WAY_IN),
            (self.exit, last_row, last_floor, "exit", WAY_OUT),
        ];
        for (column, row, floor, name, color) in ends {
            let Some(column) = column else { continue };
            let foot = size.middle(column, row).extend(size.foot(floor));
            // Over the trap there is nothing to lie on.
            if floor == 0 || self.floors[floor].trap != [column, row] {
                let side = 0.6 * size.gap();
                let mat = boxed(DVec3::new(side, side, MAT_M));
                draft.obstacle(foot, 0.0, mat, &Finish::new("wood", color, name));
            }
            let middle = foot + DVec3::Z * 0.5 * size.height;
            draft.place(name, middle, 0.5 * size.gap(), Meta::new());
            if name == "entrance" {
                let room = DVec3::new(0.25, 0.25, 0.25) * size.gap().min(size.height);
                draft.spawn(name, middle - room, middle + room);
            }
        }
    }

    fn walls(&self, draft: &mut Draft, floor: &Floor, at: usize) {
        let size = Measures::new(self.params);
        let (columns, rows) = (size.columns, size.rows);
        let half = 0.5 * size.thick;
        let finish = |outer: bool| {
            let color = if outer {
                OUTER
            } else {
                INNER[at % INNER.len()]
            };
            let finish = Finish::new("plasterboard", color, "");
            match self.floors.len() {
                1 => finish,
                _ => finish.with("floor", at),
            }
        };
        let line = |from: DVec2, to: DVec2| Line {
            from,
            to,
            foot: size.foot(at),
            height: size.height,
            right: half,
            left: half,
        };
        for row in 0..=rows {
            let walls = &floor.along_x[row * columns..(row + 1) * columns];
            for [from, to] in runs(walls) {
                let finish = finish(row == 0 || row == rows);
                let (from, to) = (size.corner(from, row), size.corner(to, row));
                let end = DVec2::X * half;
                draft.wall(line(from - end, to + end), &[], &finish);
            }
        }
        // A wall along x passes a corner; one along y ends beside it.
        let crossed = |column: usize, row: usize| {
            let wall = |c: usize| floor.along_x[row * columns + c];
            column > 0 && wall(column - 1) || column < columns && wall(column)
        };
        for column in 0..=columns {
            let walls = &floor.along_y[column * rows..(column + 1) * rows];
            for [from, to] in runs(walls) {
                let finish = finish(column == 0 || column == columns);
                let end = |row| if crossed(column, row) { -half } else { half };
                let low = size.corner(column, from) - DVec2::Y * end(from);
                let high = size.corner(column, to) + DVec2::Y * end(to);
                draft.wall(line(low, high), &[], &finish);
            }
        }
    }
}

/// Beginning and end of each run of `true`.
fn runs(walls: &[bool]) -> Vec<[usize; 2]> {
    let mut all = Vec::new();
    let mut from = None;
    for at in 0..=walls.len() {
        match (walls.get(at).copied().unwrap_or(false), from) {
            (true, None) => from = Some(at),
            (false, Some(start)) => {
                all.push([start, at]);
                from = None;
            }
            _ => {}
        }
    }
    all
}

impl Floor {
    fn new(params: &MazeParams, floor: usize) -> Self {
        let (columns, rows) = (params.columns as usize, params.rows as usize);
        let seed = params.seed.cast_unsigned();
        let path = format!("maze/floor-{floor}");
        let stream = |purpose| Stream::new(seed, &path, purpose);
        let mut this = Self {
            along_x: vec![true; columns * (rows + 1)],
            along_y: vec![true; rows * (columns + 1)],
            trap: [0, 0],
        };
        // Inner walls: first those along y, then those along x; each with the cells beside it.
        let across = (1..columns).flat_map(|c| (0..rows).map(move |r| (true, c * rows + r)));
        let up = (1..rows).flat_map(|r| (0..columns).map(move |c| (false, r * columns + c)));
        let mut order: Vec<(bool, usize)> = across.chain(up).collect();
        let inner = order.clone();
        stream("walls").shuffle(&mut order);
        let mut sets = Sets::new(columns * rows);
        for (along_y, wall) in order {
            let (a, b) = if along_y {
                let (column, row) = (wall / rows, wall % rows);
                (row * columns + column - 1, row * columns + column)
            } else {
                (wall - columns, wall)
            };
            if sets.join(a, b) {
                *this.wall(along_y, wall) = false;
            }
        }
        let mut chance = stream("sparseness");
        for (along_y, wall) in inner {
            // Each wall has its own draw: a little more sparseness takes out a few walls more.
            if chance.uniform() < params.sparseness {
                *this.wall(along_y, wall) = false;
            }
        }
        let mut chance = stream("trap");
        this.trap = [columns, rows].map(|n| chance.below(n as u64) as usize);
        this
    }

    fn wall(&mut self, along_y: bool, at: usize) -> &mut bool {
        if along_y {
            &mut self.along_y[at]
        } else {
            &mut self.along_x[at]
        }
    }
}

/// Sets of connected cells, joined two by two.
struct Sets(Vec<u32>);

impl Sets {
    fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    fn root(&mut self, mut at: u32) -> u32 {
        while self.0[at as usize] != at {
            // Half way up each time, so that paths stay short.
            let above = self.0[self.0[at as usize] as usize];
            self.0[at as usize] = above;
            at = above;
        }
        at
    }

    /// Whether they were apart.
    fn join(&mut self, a: usize, b: usize) -> bool {
        let (a, b) = (self.root(a as u32), self.root(b as u32));
        self.0[a as usize] = b;
        a != b
    }
}

/// The measures of a maze, in metres.
struct Measures {
    columns: usize,
    rows: usize,
    cell: f64,
    thick: f64,
    height: f64,
    slab: f64,
}

impl Measures {
    fn new(p: &MazeParams) -> Self {
        Self {
            columns: p.columns as usize,
            rows: p.rows as usize,
            cell: p.cell.get(),
            thick: p.wall_thickness.get(),
            height: p.wall_height.get(),
            slab: p.slab_thickness.get(),
        }
    }

    /// Between two walls.
    fn gap(&self) -> f64 {
        self.cell - self.thick
    }

    fn foot(&self, floor: usize) -> f64 {
        floor as f64 * (self.height + self.slab)
    }

    fn corner(&self, column: usize, row: usize) -> DVec2 {
        let from_middle = |at: usize, of: usize| (at as f64 - 0.5 * of as f64) * self.cell;
        DVec2::new(
            from_middle(column, self.columns),
            from_middle(row, self.rows),
        )
    }

    fn middle(&self, column: usize, row: usize) -> DVec2 {
        self.corner(column, row) + DVec2::splat(0.5 * self.cell)
    }

    fn whole(&self) -> Rect {
        let half = DVec2::splat(0.5 * self.thick);
        Rect {
            low: self.corner(0, 0) - half,
            high: self.corner(self.columns, self.rows) + half,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{Search, fingerprint};
    use simbeeotic_units::Position;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    #[test]
    fn a_maze_stays_what_it_is() {
        let three = MazeParams {
            floors: 3,
            sparseness: 0.1,
            seed: 7,
            ..MazeParams::default()
        };
        let found =
            [MazeParams::default(), three].map(|p| fingerprint(&maze(&p).expect("it can be")));
        assert_eq!(found, GOLDEN, "{found:#018x?}");
    }
    const GOLDEN: [u64; 2] = [0xb479_2f51_62df_212d, 0x7733_9e0f_25fb_616f];

    /// How many cells of a maze are reached from its first, by a ball of this radius.
    fn cells_reached(params: &MazeParams, world: &World, radius: f64) -> usize {
        let size = Measures::new(params);
        let at = |column, row, floor| {
            let middle = size.middle(column, row);
            Position::from_si(middle.extend(size.foot(floor) + 0.5 * size.height))
        };
        let whole = size.whole();
        let top = size.foot(params.floors as usize) - size.slab;
        let search = Search {
            vehicle_radius: m(radius),
            cell: m(0.1 * params.clearance.get()),
            // Not over the walls, and not around them.
            within: Some([
                Position::from_si(whole.low.extend(0.0)),
                Position::from_si(whole.high.extend(top - radius)),
            ]),
            seed: 0,
        };
        let reach = search.run(world, at(0, 0, 0)).expect("it starts in a cell");
        let floors = 0..params.floors as usize;
        let cells = floors.flat_map(|f| {
            (0..size.rows).flat_map(move |r| (0..size.columns).map(move |c| (c, r, f)))
        });
        cells
            .filter(|(c, r, f)| reach.contains(at(*c, *r, *f)))
            .count()
    }

    #[test]
    fn every_cell_of_every_floor_is_reached_by_a_vehicle_of_the_clearance() {
        for (seed, columns, rows, floors, cell, clearance) in [
            (1, 10, 10, 1, 1.0, 0.5),
            (2, 1, 7, 2, 1.0, 0.9),
            (3, 6, 1, 1, 2.0, 1.9),
            (4, 5, 5, 5, 1.0, 0.5),
            (5, 1, 1, 3, 0.7, 0.4),
            (-6, 12, 9, 2, 1.5, 1.0),
            (7, 4, 11, 3, 1.0, 0.3),
        ] {
            let params = MazeParams {
                seed,
                columns,
                rows,
                floors,
                cell: m(cell),
                wall_height: m(cell),
                clearance: m(clearance),
                ..MazeParams::default()
            };
            let world = maze(&params).expect("it can be");
            assert!(world.check().is_empty(), "{:?}", world.check());
            // Cells of a tenth of the clearance want so much air beside the vehicle.
            let radius = (0.5 - 0.14) * clearance;
            let all = (columns * rows * floors) as usize;
            assert_eq!(cells_reached(&params, &world, radius), all, "{params:?}");
        }
    }

    /// Negative control: the search is no rubber stamp.
    #[test]
    fn a_maze_whose_traps_are_closed_is_not_reached_whole() {
        let params = MazeParams {
            columns: 4,
            rows: 4,
            floors: 2,
            ..MazeParams::default()
        };
        let mut world = maze(&params).expect("it can be");
        for structure in &mut world.structures {
            if let crate::StructureShape::Surface(slab) = &mut structure.shape {
                slab.traps.clear();
            }
        }
        assert_eq!(cells_reached(&params, &world, 0.15), 16);
    }

    #[test]
    fn a_maze_without_sparseness_has_one_way_only() {
        for seed in 0..20 {
            let params = MazeParams {
                seed,
                columns: 9,
                rows: 7,
                ..MazeParams::default()
            };
            let floor = &Plan::new(&params).floors[0];
            let inner = |walls: &[bool], line: usize, lines: usize| {
                let inner = &walls[line..line * lines];
                inner.iter().filter(|wall| !**wall).count()
            };
            // A tree of 63 cells has 62 ways between neighbours.
            let open = inner(&floor.along_x, 9, 7) + inner(&floor.along_y, 7, 9);
            assert_eq!(open, 62);
        }
    }

    #[test]
    fn sparseness_takes_out_its_share_of_the_walls_that_are_left() {
        let open = |sparseness| {
            let params = MazeParams {
                columns: 100,
                rows: 100,
                sparseness,
                ..MazeParams::default()
            };
            let floor = &Plan::new(&params).floors[0];
            let walls = floor.along_x.iter().chain(&floor.along_y);
            walls.filter(|wall| !**wall).count() as f64 - 2.0
        };
        let (ways, inner) = (9_999.0, 19_800.0);
        assert_eq!(open(0.0), ways);
        assert_eq!(open(1.0), inner);
        let share = (open(0.3) - ways) / (inner - ways);
        assert!((share - 0.3).abs() < 0.02, "{share}");
    }

    #[test]
    fn a_further_floor_leaves_those_below_as_they_are() {
        let floors = |floors| {
            let params = MazeParams {
                floors,
                exit: false,
                ..MazeParams::default()
            };
            let plan = Plan::new(&params);
            (
                plan.floors[0].along_x.clone(),
                plan.floors[0].along_y.clone(),
            )
        };
        assert_eq!(floors(1), floors(3));
    }

    #[test]
    fn walls_in_one_line_are_one_wall() {
        assert_eq!(runs(&[true, true, false, true]), [[0, 2], [3, 4]]);
        assert!(runs(&[false]).is_empty());
        let params = MazeParams {
            columns: 40,
            rows: 40,
            ..MazeParams::default()
        };
        let world = maze(&params).expect("it can be");
        // 1,521 of the 3,120 inner walls and 158 outer ones stand.
        assert!(world.structures.len() < 1_100, "{}", world.structures.len());
    }

    #[test]
    fn nonsense_is_refused_with_what_is_allowed() {
        let with = |change: fn(&mut MazeParams)| {
            let mut params = MazeParams::default();
            change(&mut params);
            maze(&params).expect_err("nonsense").to_string()
        };
        for (message, words) in [
            (
                with(|p| p.columns = 0),
                "`columns` must lie between 1 and 1000",
            ),
            (
                with(|p| p.rows = 4_000_000_000),
                "`rows` must lie between 1 and 1000",
            ),
            (
                with(|p| (p.columns, p.rows, p.floors) = (1000, 1000, 2)),
                "2000000 cells",
            ),
            (with(|p| p.floors = 101), "between 1 and 100"),
            (
                with(|p| p.cell = Length::si(f64::NAN)),
                "`cell` must lie between 0.1 m and 100 m",
            ),
            (
                with(|p| p.cell = Length::si(0.55)),
                "`cell` must be at least 0.600 m, and is 0.55 m",
            ),
            (
                with(|p| p.wall_height = Length::si(0.4)),
                "pass under the slab",
            ),
            (
                with(|p| p.wall_thickness = Length::ZERO),
                "`wall_thickness` must lie between",
            ),
            (
                with(|p| p.slab_thickness = Length::si(-1.0)),
                "`slab_thickness` must lie between",
            ),
            (
                with(|p| p.sparseness = 1.1),
                "`sparseness` must lie between 0 and 1",
            ),
            (
                with(|p| p.sparseness = f64::NAN),
                "`sparseness` must lie between 0 and 1",
            ),
            (
                with(|p| p.clearance = Length::ZERO),
                "`clearance` must lie between",
            ),
        ] {
            assert!(message.contains(words), "{message}");
        }
    }
}
