//! Vehicles: what turns set points into wrenches.

pub mod simple_bee;
