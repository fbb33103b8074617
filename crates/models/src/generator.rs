//! Worlds made by rule, as parts: what they do stands in [`simbeeotic_model::world::generate`].

use simbeeotic_model::world::World;
use simbeeotic_model::world::generate::{self, MazeParams};
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
