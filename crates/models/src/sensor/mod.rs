//! Sensors: what turns truth into readings.

pub mod accelerometer;
pub mod compass;
mod echo;
pub mod errors;
pub mod gyroscope;
pub mod imu;
pub mod inertial;
pub mod multi_ranger;
pub mod noise;
pub mod position;
pub mod range;
mod scene;
pub mod velocity;
pub mod vl53l1x;
pub mod wall;
