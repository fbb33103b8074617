//! Vehicles: what turns set points into wrenches.

pub mod outline;
pub mod simple_bee;
