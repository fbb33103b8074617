//! Worlds made by rule, as parts: what they do stands in [`simbeeotic_model::world::generate`].

use simbeeotic_model::world::World;
use simbeeotic_model::world::generate::{
    self, CityParams, ForestParams, MazeParams, MineParams, OfficeParams, WarehouseParams,
};
use simbeeotic_model::{BuildError, Generator, generator};

/// A maze: cells between walls, floor upon floor.
///
/// Every cell is reached from every other; by one way only, unless `sparseness` opens more. Between
/// two floors lies a slab with a trap over one cell. Mats inside the way in and the way out are
/// labelled `entrance` and `exit`.
#[generator("maze")]
pub struct Maze;

impl Generator for Maze {
    type Params = MazeParams;

    fn generate(params: &MazeParams) -> Result<World, BuildError> {
        Ok(generate::maze(params)?)
    }
}

/// A city: blocks between streets, houses on plots, parks with trees, lamps.
///
/// Every street is free from end to end. Houses are labelled `house` and `tower`, with their `block`
/// as metadata; each crossing is a place; vehicles start in the area `crossing`.
#[generator("city")]
pub struct City;

impl Generator for City {
    type Params = CityParams;

    fn generate(params: &CityParams) -> Result<World, BuildError> {
        Ok(generate::city(params)?)
    }
}

/// A warehouse: racks with boxes between aisles, in a hall with gates.
///
/// Every aisle is reached from outside. Racks and boxes have their `aisle`, `side`, `bay` and `level`
/// as metadata; each aisle is a place; vehicles start in the area `dock`, inside the gates.
#[generator("warehouse")]
pub struct Warehouse;

impl Generator for Warehouse {
    type Params = WarehouseParams;

    fn generate(params: &WarehouseParams) -> Result<World, BuildError> {
        Ok(generate::warehouse(params)?)
    }
}

/// A mine: a shaft through levels, tunnels that branch, chambers, frames, people.
///
/// Everything open is reached from the shaft, the only way in. People are labelled `miner`, with a
/// `person-id` as metadata; the ends of tunnels are places; vehicles start in the area `shaft`.
#[generator("mine")]
pub struct Mine;

impl Generator for Mine {
    type Params = MineParams;

    fn generate(params: &MineParams) -> Result<World, BuildError> {
        Ok(generate::mine(params)?)
    }
}

/// An office building: floors of corridors with rooms on both sides.
///
/// Rooms have numbers: `2.14` is room 14 of floor 2, the lowest being floor 0. Each has a door to its
/// corridor; a lobby with openings from floor to floor joins the corridors. Walls to corridors, panes
/// and furniture carry `room` and `floor` as metadata. Places are called `room 2.14`, `lobby 2` and
/// `entrance`; the area to start in, before the entrance, `entrance`.
#[generator("office")]
pub struct Office;

impl Generator for Office {
    type Params = OfficeParams;

    fn generate(params: &OfficeParams) -> Result<World, BuildError> {
        Ok(generate::office(params)?)
    }
}

/// A forest: trees that keep their distance, bushes, stones, a clearing.
///
/// Trunk and crown of a tree are two solid objects of the materials `wood` and `foliage`, labelled
/// `spruce`, `beech`, `birch` or `snag`, with the tree's number as metadata `tree`. The clearing is
/// a place and an area to start in, `clearing`.
#[generator("forest")]
pub struct Forest;

impl Generator for Forest {
    type Params = ForestParams;

    fn generate(params: &ForestParams) -> Result<World, BuildError> {
        Ok(generate::forest(params)?)
    }
}
