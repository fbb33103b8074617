//! Vehicles: what turns set points into wrenches.

pub mod ghost;
pub mod outline;
pub mod simple_bee;
