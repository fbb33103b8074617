//! Behaviours: what vehicles and stations do.

pub mod avoid;
pub mod balloon;
pub mod beacon_bee;
pub mod broadcast;
pub mod charging_hive;
pub mod cruise;
pub mod flood_bee;
pub mod forager;
pub mod hive;
pub mod inert;
pub mod instrument;
pub mod random_walk;
pub mod scent;
pub mod slot_bee;
mod walk;
