//! How far numbers may go, and the small speeds at which contact changes its nature.
//!
//! The limits keep every later evaluation finite: within them, no closed form overflows before the
//! end of simulated time. They are generous; what exceeds them is a mistake in a unit.

/// Farthest coordinate from the origin, m. One f64 step there is 0.1 um.
pub const POSITION_M_MAX: f64 = 1e9;
/// Fastest speed that a command may set, m/s.
pub const SPEED_M_S_MAX: f64 = 1e5;
/// Fastest body rate, rad/s: a command may not set more, and a torque does not reach beyond.
pub const RATE_RAD_S_MAX: f64 = 1e4;
/// Greatest acceleration that a force may cause, m/s^2.
pub const ACCELERATION_M_S2_MAX: f64 = 1e6;
/// Greatest angular acceleration that a torque may cause, rad/s^2.
pub const ANGULAR_ACCELERATION_RAD_S2_MAX: f64 = 1e7;
/// Least radius or half extent of a body, m.
pub const EXTENT_M_MIN: f64 = 1e-9;
/// Greatest radius or half extent of a body, m.
pub const EXTENT_M_MAX: f64 = 1e5;
/// Most points, triangles, or rows of one shape.
pub const PIECES_MAX: usize = 1 << 26;
/// Smallest and greatest mass of a body, kg.
pub const MASS_KG_RANGE: (f64, f64) = (1e-9, 1e9);
/// Greatest friction coefficient.
pub const FRICTION_MAX: f64 = 1e3;

/// A rebound from the ground slower than this ends in rest, if the net force presses the body down,
/// m/s. Without it, a bouncing ball bounces infinitely often within finite time. A rebound of this
/// speed rises 0.13 mm.
pub const REST_SPEED_M_S: f64 = 0.05;
/// Two bodies that net forces press together part with at least this speed, m/s: a stand-in for
/// resting contact between bodies. It keeps a pair pressed at 1 m/s^2 at ten contacts a second
/// instead of infinitely many, at the price of a little energy.
pub const PARTING_SPEED_M_S: f64 = 0.05;
/// Two bodies that no force presses together part with at least this speed, m/s: above the rounding
/// of velocities, below anything that shows.
pub const PARTING_SPEED_M_S_MIN: f64 = 1e-6;

/// Two balls that stay in touch, or a ball and a wall, are handed to an island after this many small
/// bounces.
pub const BOUNCES_OF_BALLS: u32 = 10;

/// Two that met less than this ago have not been apart: unless they meet faster than
/// [`NEWS_SPEED_M_S`], their meeting is part of a lasting contact, and not reported again, s.
pub const LASTING_S: f64 = 0.05;
/// Two that meet faster than this are reported, however short the time they were apart, m/s. Twice the
/// speed at which a pressed pair parts.
pub const NEWS_SPEED_M_S: f64 = 0.1;

/// Upward acceleration that lifts a body off the ground, m/s^2. Less is rounding of a hovering
/// body's balance of forces.
pub(crate) const LIFT_M_S2: f64 = 1e-6;
/// A body that slides slower than this, and whose tangential force friction can hold, stands, m/s.
pub(crate) const STANDING_SPEED_M_S: f64 = 1e-6;
/// A body that is no higher than this above the ground is set exactly upon it when it comes to rest
/// or bounces, m; so is one that is below. More than the 0.15 um that rounding a time of impact to 1 ns costs at 300 m/s.
pub(crate) const GROUND_SNAP_M: f64 = 1e-6;
