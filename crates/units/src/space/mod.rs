//! Frames, and what is written in them.
//!
//! # Conventions
//!
//! | | |
//! |---|---|
//! | world frame | [`Enu`]: x east, y north, z up; right-handed |
//! | body frame | [`Flu`]: x forward, y left, z up; right-handed |
//! | rotation | [`Attitude`]: unit quaternion, Hamilton, written w, x, y, z; takes body to world |
//! | yaw | counter-clockwise from east, (-π, π] |
//! | heading | clockwise from north, [0, 2π) |
//! | roll, pitch, yaw | about forward, left, up by the right-hand rule: positive pitch is **nose down** |
//!
//! These are those of ROS REP-103. Importers of NED or FRD data convert at the border.

mod attitude;
mod direction;
mod frame;
mod pose;
mod vector;

pub use attitude::Attitude;
pub use direction::{Heading, Yaw};
pub use frame::{Enu, Flu, Frame};
pub use pose::{Mount, Pose, Twist, Wrench};
pub use vector::{Accel, ForceVec, ImpulseVec, Offset, Position, Rate, TorqueVec, V3, Velocity};
