//! Sensors: what turns truth into readings.

pub mod accelerometer;
pub mod compass;
pub mod errors;
pub mod gyroscope;
pub mod imu;
pub mod inertial;
pub mod noise;
pub mod position;
#[cfg(test)]
mod scene;
pub mod velocity;
