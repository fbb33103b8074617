//! The shelf: parts that scenarios name and users start from.
//!
//! | kind | parts |
//! |---|---|
//! | vehicles | [`vehicle::simple_bee`], [`vehicle::ghost`] |
//! | behaviours | [`behavior::random_walk`], [`behavior::instrument`], [`behavior::inert`], [`behavior::cruise`], [`behavior::broadcast`], [`behavior::hive`], [`behavior::charging_hive`], [`behavior::forager`], [`behavior::balloon`], [`behavior::scent`], [`behavior::beacon_bee`], [`behavior::flood_bee`], [`behavior::slot_bee`] |
//! | sensors | [`sensor::compass`], [`sensor::position`], [`sensor::barometer`], [`sensor::light`], [`sensor::smell`], [`sensor::battery`], [`sensor::motor`], [`sensor::link`], [`sensor::clock`] |
//! | fading | [`fading::rayleigh`], [`fading::rician`], [`fading::nakagami`] |
//! | what a hive owns | [`dock`]: a deck with chargers |
//! | layers on radio | [`net`]: neighbours, flooding, time slots |
//! | generators of worlds | [`generator`] |
//! | weather | [`weather::constant`], [`weather::atmosphere`] |
//!
//! A new part is one file in the folder of its kind and one `mod` line. Nothing here has a right
//! that a user's own crate has not: each part is written against `simbeeotic-model` alone and
//! registers itself by its attribute.

pub mod aerodynamics;
pub mod antenna;
pub mod behavior;
pub mod dock;
pub mod fading;
pub mod generator;
pub mod medium;
pub mod net;
pub mod phase;
pub mod propagation;
pub mod radio;
pub mod sensor;
mod table;
#[cfg(test)]
mod trial;
pub mod vehicle;
pub mod weather;

// The tests within this crate share helpers with those beside it.
#[cfg(test)]
extern crate self as simbeeotic_models;
