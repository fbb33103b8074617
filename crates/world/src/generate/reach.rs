//! Where a vehicle can get: a search over a grid of cells.
//!
//! Space is cut into cubes of side `c`. A cube is *free* if its middle is at least `r + c/2` away
//! from everything solid and from the ground, `r` being the vehicle's radius. A vehicle that flies
//! from the middle of a free cube to that of its neighbour is never more than `c/2` from one of the
//! two, so it touches nothing: **what is called reachable is reachable**. The other way round holds
//! where there is room: a way along which everything solid is at least `r + c/2 + c sqrt(3)/2`
//! away is found. A gap that fits the vehicle with less air than that on each side may be missed;
//! choose smaller cubes. Only the middle of a cube is proven: `contains` answers for the whole cube that
//! a point lies in, and a vehicle at its corner may touch.
//!
//! ```
//! use simbeeotic_units::{Length, Position};
//! use simbeeotic_world::generate::{self, MazeParams, reachable};
//!
//! let maze = generate::maze(&MazeParams { columns: 3, rows: 3, ..MazeParams::default() })?;
//! let from = Position::from_xyz(0.0, 0.0, 0.5);
//! let reach = reachable(&maze, from, Length::si(0.1), Length::si(0.1))?;
//! let corner = Position::from_xyz(1.0, 1.0, 0.5);
//! assert!(reach.contains(corner));
//! let way = reach.path(corner).expect("there is one");
//! assert!(way.len() > 20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use super::distance::{Piece, pieces};
use crate::solid::{ObjectId, SolidShape};
use crate::world::World;
use glam::DVec3;
use simbeeotic_units::{Length, Position};
use std::collections::VecDeque;

/// Most cubes of a search.
const CELLS_MAX: f64 = 64e6;
/// A cube that is not free.
const SOLID: u32 = u32::MAX;
/// A free cube that no way leads to, so far.
const UNSEEN: u32 = u32::MAX - 1;

/// What is searched, and for whom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// The radius of the vehicle, a ball. Zero or more.
    pub vehicle_radius: Length,
    /// The side of a cube. Above 0.
    pub cell: Length,
    /// Two opposite corners of the space that the vehicle keeps to. If left out: all objects and
    /// the start, with room to fly around them.
    pub within: Option<[Position; 2]>,
    /// The seed of the flowers of patches.
    pub seed: u64,
}

/// Why there is nothing to search.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReachError {
    /// The radius is negative or no number.
    #[error("the radius of a vehicle is zero or more, not {0}")]
    Radius(Length),
    /// The side of a cube is not above zero, or no number.
    #[error("a cell of the search is larger than zero, not {0}")]
    Cell(Length),
    /// The space is no space, or too large.
    #[error("{count:.0} cells of {cell} are too many: 64 million are possible; take larger ones")]
    TooMany {
        /// How many cubes there would be.
        count: f64,
        /// Their side.
        cell: Length,
    },
    /// The vehicle cannot be where it starts.
    #[error("the vehicle cannot start there: {}", match .0 {
        Some(object) => format!("{object} is too near"),
        None => "the ground or the end of the searched space is too near".to_owned(),
    })]
    Start(Option<ObjectId>),
}

/// Where a vehicle gets from where it started: the cubes that a way leads to.
#[derive(Clone, Debug)]
pub struct Reach {
    low_m: DVec3,
    cell_m: f64,
    size: [usize; 3],
    /// Steps from the start, or why there are none.
    steps: Vec<u32>,
}

/// Where a vehicle of this radius gets from `from`, by cubes of side `cell`: see [`Search::run`].
///
/// # Errors
/// Sizes that make no sense, more than 64 million cubes, a start where the vehicle does not fit.
pub fn reachable(
    world: &World,
    from: Position,
    vehicle_radius: Length,
    cell: Length,
) -> Result<Reach, ReachError> {
    let search = Search {
        vehicle_radius,
        cell,
        within: None,
        seed: 0,
    };
    search.run(world, from)
}

impl Search {
    /// Searches from `from`.
    ///
    /// # Errors
    /// Sizes that make no sense, more than 64 million cubes, a start where the vehicle does not fit.
    pub fn run(&self, world: &World, from: Position) -> Result<Reach, ReachError> {
        let (radius_m, cell_m) = (self.vehicle_radius.get(), self.cell.get());
        if !(radius_m >= 0.0 && radius_m.is_finite()) {
            return Err(ReachError::Radius(self.vehicle_radius));
        }
        if !(cell_m > 0.0 && cell_m.is_finite()) {
            return Err(ReachError::Cell(self.cell));
        }
        let distance_m = radius_m + 0.5 * cell_m;
        let objects = world.objects(self.seed);
        let solid: Vec<(ObjectId, Vec<Piece>)> = objects
            .iter()
            .map(|object| (object.id, object.solids.iter().flat_map(pieces).collect()))
            .collect();
        let [low_m, high_m] = self.space(&solid, from.si(), distance_m);
        let mut reach =
            Reach::empty(low_m, high_m, cell_m).map_err(|count| ReachError::TooMany {
                count,
                cell: self.cell,
            })?;
        reach.fill_ground(distance_m);
        for object in &objects {
            for one in &object.solids {
                if let SolidShape::HeightField { .. } = one.shape {
                    reach.fill_below(&pieces(one));
                }
            }
        }
        for piece in solid.iter().flat_map(|(_, pieces)| pieces) {
            reach.fill(piece, distance_m);
        }
        let start = reach.index(from.si());
        match start.filter(|at| reach.steps[*at] == UNSEEN) {
            Some(start) => reach.flood(start),
            None => {
                let near = |(id, pieces): &(ObjectId, Vec<Piece>)| {
                    let near = pieces
                        .iter()
                        .any(|p| p.is_closer(from.si(), 2.0 * distance_m));
                    near.then_some(*id)
                };
                return Err(ReachError::Start(solid.iter().find_map(near)));
            }
        }
        Ok(reach)
    }

    fn space(
        &self,
        solid: &[(ObjectId, Vec<Piece>)],
        from_m: DVec3,
        distance_m: f64,
    ) -> [DVec3; 2] {
        if let Some([a, b]) = self.within {
            return [a.si().min(b.si()), a.si().max(b.si())];
        }
        let [mut low, mut high] = [from_m, from_m];
        for piece in solid.iter().flat_map(|(_, pieces)| pieces) {
            let [least, most] = piece.bounds();
            (low, high) = (low.min(least), high.max(most));
        }
        let room = DVec3::splat(2.0 * distance_m + 2.0 * self.cell.get());
        let (low, high) = (low - room, high + room);
        // Nothing flies below the ground.
        [
            low.max(DVec3::new(f64::NEG_INFINITY, f64::NEG_INFINITY, 0.0)),
            high,
        ]
    }
}

impl Reach {
    /// All free; or how many cubes there would be, if that is too many.
    fn empty(low_m: DVec3, high_m: DVec3, cell_m: f64) -> Result<Self, f64> {
        let size = ((high_m - low_m) / cell_m).ceil().max(DVec3::ONE);
        let count = size.x * size.y * size.z;
        // False for what is no number, too.
        if count.is_nan() || count > CELLS_MAX {
            return Err(count);
        }
        let size = size.to_array().map(|n| n as usize);
        Ok(Self {
            low_m,
            cell_m,
            size,
            steps: vec![UNSEEN; size[0] * size[1] * size[2]],
        })
    }

    fn at(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    fn middle_m(&self, cell: [usize; 3]) -> DVec3 {
        let cell = DVec3::from_array(cell.map(|n| n as f64 + 0.5));
        self.low_m + cell * self.cell_m
    }

    fn middle_of_m(&self, at: usize) -> DVec3 {
        let (row, x) = (at / self.size[0], at % self.size[0]);
        self.middle_m([x, row % self.size[1], row / self.size[1]])
    }

    /// The cube that holds a point, if one does.
    fn index(&self, p_m: DVec3) -> Option<usize> {
        let cell = ((p_m - self.low_m) / self.cell_m).floor();
        let size = DVec3::from_array(self.size.map(|n| n as f64));
        let inside = cell.cmpge(DVec3::ZERO).all() && cell.cmplt(size).all();
        inside.then(|| self.at(cell.to_array().map(|n| n as usize)))
    }

    /// First and one past the last cube along each axis whose middles lie between two corners.
    fn range(&self, low_m: DVec3, high_m: DVec3) -> [[usize; 2]; 3] {
        let low = ((low_m - self.low_m) / self.cell_m - 0.5).ceil();
        let high = ((high_m - self.low_m) / self.cell_m - 0.5).floor() + 1.0;
        std::array::from_fn(|axis| {
            let most = self.size[axis] as f64;
            let from = low[axis].clamp(0.0, most) as usize;
            [from, (high[axis].clamp(0.0, most) as usize).max(from)]
        })
    }

    fn fill(&mut self, piece: &Piece, distance_m: f64) {
        let [low, high] = piece.bounds();
        let [xs, ys, zs] = self.range(low - distance_m, high + distance_m);
        for z in zs[0]..zs[1] {
            for y in ys[0]..ys[1] {
                for x in xs[0]..xs[1] {
                    let at = self.at([x, y, z]);
                    if self.steps[at] != SOLID
                        && piece.is_closer(self.middle_m([x, y, z]), distance_m)
                    {
                        self.steps[at] = SOLID;
                    }
                }
            }
        }
    }

    fn fill_ground(&mut self, distance_m: f64) {
        for z in 0..self.size[2] {
            if self.middle_m([0, 0, z]).z < distance_m {
                let layer = self.size[0] * self.size[1];
                self.steps[z * layer..(z + 1) * layer].fill(SOLID);
            }
        }
    }

    /// What lies under the triangles of a surface, down to where the search begins.
    fn fill_below(&mut self, surface: &[Piece]) {
        for piece in surface {
            let [low, high] = piece.bounds();
            let [xs, ys, _] = self.range(low, high);
            let under = DVec3::new(high.x, high.y, low.z);
            let zs = self.range(low.with_z(f64::NEG_INFINITY), under)[2];
            for z in zs[0]..zs[1] {
                for y in ys[0]..ys[1] {
                    for x in xs[0]..xs[1] {
                        let at = self.at([x, y, z]);
                        self.steps[at] = SOLID;
                    }
                }
            }
        }
    }

    fn flood(&mut self, start: usize) {
        let mut next = VecDeque::from([start]);
        self.steps[start] = 0;
        while let Some(at) = next.pop_front() {
            let steps = self.steps[at] + 1;
            for neighbor in self.neighbors(at).into_iter().flatten() {
                if self.steps[neighbor] == UNSEEN {
                    self.steps[neighbor] = steps;
                    next.push_back(neighbor);
                }
            }
        }
    }

    /// The cubes beside one: west, east, south, north, below, above.
    fn neighbors(&self, at: usize) -> [Option<usize>; 6] {
        let [nx, ny, nz] = self.size;
        let (row, x) = (at / nx, at % nx);
        let (y, z) = (row % ny, row / ny);
        let layer = nx * ny;
        [
            (x > 0).then(|| at - 1),
            (x + 1 < nx).then(|| at + 1),
            (y > 0).then(|| at - nx),
            (y + 1 < ny).then(|| at + nx),
            (z > 0).then(|| at - layer),
            (z + 1 < nz).then(|| at + layer),
        ]
    }

    fn steps_to(&self, place: Position) -> Option<(usize, u32)> {
        let at = self.index(place.si())?;
        let steps = self.steps[at];
        (steps < UNSEEN).then_some((at, steps))
    }

    /// Whether a way leads to the cube that holds `place`. False outside of what was searched.
    pub fn contains(&self, place: Position) -> bool {
        self.steps_to(place).is_some()
    }

    /// How long the shortest way along the axes from cube to cube is. `None` if there is no way.
    pub fn distance(&self, place: Position) -> Option<Length> {
        let (_, steps) = self.steps_to(place)?;
        Some(Length::si(f64::from(steps) * self.cell_m))
    }

    /// A shortest way along the axes, by the middles of its cubes, from the start to `place`. `None`
    /// if there is no way.
    pub fn path(&self, place: Position) -> Option<Vec<Position>> {
        let (mut at, mut steps) = self.steps_to(place)?;
        let mut path = vec![at];
        while steps > 0 {
            steps -= 1;
            let before = self.neighbors(at).into_iter().flatten();
            at = before.into_iter().find(|n| self.steps[*n] == steps)?;
            path.push(at);
        }
        path.reverse();
        let place = |at: &usize| Position::from_si(self.middle_of_m(*at));
        Some(path.iter().map(place).collect())
    }

    /// How many cubes a way leads to.
    pub fn count(&self) -> usize {
        self.steps.iter().filter(|steps| **steps < UNSEEN).count()
    }

    /// The two corners of the space that was searched.
    pub fn space(&self) -> [Position; 2] {
        let size = DVec3::from_array(self.size.map(|n| n as f64));
        let high_m = self.low_m + size * self.cell_m;
        [Position::from_si(self.low_m), Position::from_si(high_m)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::{Door, Slab, Structure, StructureShape, Wall};
    use crate::{HeightField, Obstacle, ObstacleShape, Terrain};
    use simbeeotic_units::Angle;

    fn m(metres: f64) -> Length {
        Length::si(metres)
    }

    /// Two rooms of 4 m by 4 m side by side, closed above, with a door between them perhaps.
    fn rooms(door: Option<Door>) -> World {
        let wall = |x: f64, y: f64, length: f64, rotation: f64, door: Option<Door>| Structure {
            position: Position::from_xyz(x, y, 0.0),
            shape: StructureShape::Wall(Wall {
                length: m(length),
                width: m(0.1),
                height: m(3.0),
                rotation: Angle::from_turns(rotation),
                doors: door.into_iter().collect(),
                windows: Vec::new(),
            }),
            ..Structure::default()
        };
        let roof = Structure {
            position: Position::from_xyz(-0.1, -0.1, 3.0),
            shape: StructureShape::Surface(Slab {
                length: m(8.2),
                width: m(4.2),
                height: m(0.1),
                ..Slab::default()
            }),
            ..Structure::default()
        };
        World {
            structures: vec![
                wall(-0.1, -0.1, 8.2, 0.0, None),
                wall(-0.1, 4.0, 8.2, 0.0, None),
                wall(0.0, 0.0, 4.0, 0.25, None),
                wall(8.1, 0.0, 4.0, 0.25, None),
                wall(4.05, 0.0, 4.0, 0.25, door),
                roof,
            ],
            ..World::default()
        }
    }

    const WEST: [f64; 3] = [1.0, 1.0, 1.5];

    fn place([x, y, z]: [f64; 3]) -> Position {
        Position::from_xyz(x, y, z)
    }

    #[test]
    fn a_vehicle_passes_a_door_that_is_wide_enough_and_no_other() {
        let door = |width| {
            Some(Door {
                position: m(1.0),
                width: m(width),
                height: m(2.0),
            })
        };
        let east = place([6.0, 3.0, 1.0]);
        for (width, radius, passes) in [
            (0.8, 0.3, true),
            (0.8, 0.39, false), // it would fit, but with less air than the search wants
            (0.8, 0.45, false),
            (0.5, 0.3, false),
            (0.5, 0.15, true),
        ] {
            let world = rooms(door(width));
            let reach = reachable(&world, place(WEST), m(radius), m(0.1)).expect("it starts");
            assert_eq!(reach.contains(east), passes, "{width} {radius}");
            assert!(reach.contains(place([3.0, 3.0, 1.0])));
        }
        let closed = reachable(&rooms(None), place(WEST), m(0.1), m(0.1)).expect("it starts");
        assert!(!closed.contains(east) && closed.path(east).is_none());
    }

    #[test]
    fn a_path_is_free_of_touch_from_its_start_to_its_end() {
        let world = rooms(Some(Door {
            position: m(2.5),
            width: m(0.9),
            height: m(2.0),
        }));
        let east = place([7.0, 0.8, 2.4]);
        let reach = reachable(&world, place(WEST), m(0.25), m(0.1)).expect("it starts");
        let path = reach.path(east).expect("there is a way");
        let solid: Vec<Piece> = world
            .objects(0)
            .iter()
            .flat_map(|o| o.solids.iter().flat_map(pieces))
            .collect();
        assert!(path[0].distance(place(WEST)).get() < 0.1);
        assert!(path[path.len() - 1].distance(east).get() < 0.1);
        for pair in path.windows(2) {
            assert!((pair[0].distance(pair[1]).get() - 0.1).abs() < 1e-9);
            for share in [0.0, 0.25, 0.5, 0.75] {
                let p = pair[0].si().lerp(pair[1].si(), share);
                assert!(solid.iter().all(|piece| !piece.is_closer(p, 0.25 - 1e-9)));
                assert!(p.z >= 0.25);
            }
        }
        let length = reach.distance(east).expect("there is a way").get();
        assert!((length - 0.1 * (path.len() - 1) as f64).abs() < 1e-9);
    }

    #[test]
    fn outside_and_above_are_reached_around_and_over() {
        let mut world = rooms(None);
        world.structures.pop();
        let reach = reachable(&world, place(WEST), m(0.2), m(0.2)).expect("it starts");
        assert!(reach.contains(place([6.0, 1.0, 1.0])), "over the wall");
        let [low, high] = reach.space();
        assert!(low.up().get() >= 0.0 && high.up().get() > 3.4);
        // Unless the vehicle keeps below.
        let search = Search {
            vehicle_radius: m(0.2),
            cell: m(0.2),
            within: Some([place([-1.0, -1.0, 0.0]), place([9.0, 5.0, 2.9])]),
            seed: 0,
        };
        let reach = search.run(&world, place(WEST)).expect("it starts");
        assert!(!reach.contains(place([6.0, 1.0, 1.0])));
        assert!(reach.count() > 0);
    }

    #[test]
    fn nothing_is_reached_under_the_terrain_or_in_a_stone() {
        let hill = Terrain::new(HeightField {
            length: m(10.0),
            width: m(10.0),
            heights: vec![
                vec![m(0.0), m(0.0), m(0.0)],
                vec![m(0.0), m(4.0), m(0.0)],
                vec![m(0.0), m(0.0), m(0.0)],
            ],
            ..HeightField::default()
        });
        let stone = Obstacle {
            position: place([20.0, 0.0, 0.0]),
            shape: ObstacleShape::Sphere { radius: m(2.0) },
            ..Obstacle::default()
        };
        let world = World {
            terrain: Some(hill),
            obstacles: vec![stone],
            ..World::default()
        };
        let reach = reachable(&world, place([10.0, 0.0, 2.0]), m(0.2), m(0.25)).expect("it starts");
        assert!(reach.contains(place([0.0, 0.0, 5.0])));
        assert!(!reach.contains(place([0.0, 0.0, 3.0])), "in the hill");
        assert!(!reach.contains(place([20.0, 0.0, 2.0])), "in the stone");
        assert!(reach.contains(place([20.0, 0.0, 5.0])));
        assert!(!reach.contains(place([500.0, 0.0, 5.0])), "not searched");
    }

    #[test]
    fn what_cannot_be_searched_is_refused() {
        let world = rooms(None);
        let from = |p, radius, cell| reachable(&world, place(p), m(radius), m(cell)).err();
        assert!(matches!(from(WEST, -0.1, 0.1), Some(ReachError::Radius(_))));
        assert!(matches!(
            from(WEST, f64::NAN, 0.1),
            Some(ReachError::Radius(_))
        ));
        assert!(matches!(from(WEST, 0.1, 0.0), Some(ReachError::Cell(_))));
        assert!(matches!(
            from(WEST, 0.1, 1e-6),
            Some(ReachError::TooMany { .. })
        ));
        let far = [f64::NAN, 0.0, 1.0];
        assert!(from(far, 0.1, 0.1).is_some());
        let error = from([0.1, 2.0, 1.0], 0.3, 0.1).expect("in the wall");
        assert_eq!(
            error.to_string(),
            "the vehicle cannot start there: structure.2 is too near"
        );
        let error = from([1.0, 1.0, 0.05], 0.3, 0.1).expect("on the ground");
        assert_eq!(
            error.to_string(),
            "the vehicle cannot start there: the ground or the end of the searched space is too near"
        );
    }
}
