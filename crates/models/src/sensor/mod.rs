//! Sensors: what turns truth into readings.

pub mod compass;
pub mod noise;
pub mod position;
