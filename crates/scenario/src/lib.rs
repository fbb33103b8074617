//! Simbeeotic: scenario and world files to a checked plan to a simulation.
pub mod limit;
pub mod render;
pub mod toml;
