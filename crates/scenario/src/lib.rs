//! Simbeeotic: scenario and world files to a checked plan to a simulation.
pub mod limit;
pub mod print;
pub mod render;
pub mod set;
pub mod toml;
pub mod xml;
