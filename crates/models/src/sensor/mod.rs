//! Sensors: what turns truth into readings.

pub mod accelerometer;
pub mod altimeter;
pub mod camera;
pub mod compass;
pub mod contact;
mod echo;
pub mod errors;
pub mod flow;
pub mod flower;
pub mod gnss;
pub mod gyroscope;
pub mod imu;
pub mod inertial;
pub mod lidar;
pub mod lidar_3d;
mod line;
pub mod magnetometer;
pub mod mocap;
pub mod multi_ranger;
pub mod neighbors;
pub mod noise;
pub mod optical_flow;
pub mod person;
pub mod pmw3901;
pub mod pose;
pub mod position;
pub mod range;
pub mod ring;
pub mod scan;
#[cfg(test)]
mod scene;
pub mod sighting;
pub mod uwb;
pub mod velocity;
pub mod vl53l1x;
pub mod wall;
