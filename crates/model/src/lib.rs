//! Simbeeotic: what authors write against.
pub mod config;
