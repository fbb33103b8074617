//! Worlds made by rule: mazes, offices, mines, forests, cities, warehouses.
//!
//! Each kind is a pure function of its parameters, the seed among them: [`maze()`], [`office()`],
//! [`mine()`], [`forest()`], [`city()`], [`warehouse()`]. The same parameters give the same world, to the
//! last bit ([`fingerprint`]). Chance comes from streams that are named by seed, place and purpose:
//! another window width does not move the furniture, and a further floor leaves those below as they
//! are.
//!
//! ```
//! use simbeeotic_world::generate::{self, MazeParams};
//!
//! let small = MazeParams { columns: 4, rows: 3, ..MazeParams::default() };
//! let world = generate::maze(&small)?;
//! assert!(world.check().is_empty());
//! assert_eq!(world, generate::maze(&small)?);
//!
//! let none = MazeParams { columns: 0, ..MazeParams::default() };
//! assert_eq!(
//!     generate::maze(&none).expect_err("no maze").to_string(),
//!     "`columns` must lie between 1 and 1000, and is 0"
//! );
//! # Ok::<(), generate::GenerateError>(())
//! ```
//!
//! Worlds stand on the ground around the origin. Every way in them is at least as wide and as high
//! as the parameter `clearance` says: a vehicle of that diameter gets everywhere, which [`reach`]
//! finds by search.

mod check;
pub mod city;
mod distance;
mod draft;
mod fingerprint;
pub mod forest;
pub mod maze;
pub mod mine;
pub mod office;
pub mod reach;
mod scatter;
pub mod warehouse;

pub use check::GenerateError;
pub use city::{CityParams, city};
pub use fingerprint::fingerprint;
pub use forest::{ForestParams, forest};
pub use maze::{MazeParams, maze};
pub use mine::{MineParams, mine};
pub use office::{OfficeParams, office};
pub use reach::{Reach, ReachError, Search, reachable};
pub use warehouse::{WarehouseParams, warehouse};
