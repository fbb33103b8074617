//! Sensors: what turns truth into readings.

pub mod accelerometer;
pub mod compass;
pub mod contact;
mod echo;
pub mod errors;
pub mod flower;
pub mod gyroscope;
pub mod imu;
pub mod inertial;
pub mod lidar;
pub mod lidar_3d;
pub mod multi_ranger;
pub mod noise;
pub mod person;
pub mod position;
pub mod range;
pub mod ring;
pub mod scan;
#[cfg(test)]
mod scene;
pub mod sighting;
pub mod velocity;
pub mod vl53l1x;
pub mod wall;
