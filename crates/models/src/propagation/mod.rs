//! Propagation: what is lost between two antennas.

pub mod free_space;
