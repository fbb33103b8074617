//! Behaviours: what vehicles and stations do.

pub mod avoid;
pub mod balloon;
pub mod broadcast;
pub mod charging_hive;
pub mod cruise;
pub mod forager;
pub mod hive;
pub mod inert;
pub mod instrument;
pub mod random_walk;
pub mod scent;
mod walk;
