//! Rigid bodies on their own clocks, wrenches, contacts at computed times.
//!
//! ```
//! use simbeeotic_kernel::SimTime;
//! use simbeeotic_physics::{BodySpec, Config, Physics, Shape};
//! use simbeeotic_units::glam::DVec3;
//!
//! let mut physics = Physics::new(Config::default());
//! let ball = BodySpec {
//!     p_enu: DVec3::new(0.0, 0.0, 5.0),
//!     ..BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 0.128)
//! };
//! let ball = physics.add(ball)?;
//!
//! // Nothing is stepped: the state at any time is a formula.
//! let fallen = physics.motion(ball).at(SimTime::from_millis(500));
//! assert!((fallen.p_enu.z - (5.0 - 0.5 * 9.80665 * 0.25)).abs() < 1e-12);
//!
//! // The next thing that happens by itself is found, not waited for.
//! let mut contacts = Vec::new();
//! while contacts.is_empty() {
//!     let next = physics.next_time().expect("it falls, so it lands");
//!     physics.advance(next, &mut contacts);
//!     physics.settle(next);
//! }
//! let exact = (2.0 * 4.9_f64 / 9.80665).sqrt();
//! assert!((contacts[0].time.as_secs_f64() - exact).abs() < 1e-8);
//! # Ok::<(), simbeeotic_physics::BodyError>(())
//! ```
//!
//! # Three ideas
//!
//! **A body is a trajectory, not a state.** Between two changes the force on a body is constant, so its
//! path has a closed form. A [`Motion`] holds what that form needs: the state at the last change, and
//! what acts since. Reading a body at an event's time is exact, changes nothing, and costs nothing for
//! bodies that nobody asks about. A change (a force, an impulse, a contact) begins a new segment for
//! that body alone. A vehicle of higher fidelity changes its wrench more often, on its own clock.
//!
//! **A contact is a computed instant.** When a segment begins, the first time at which it meets any
//! other is found as the root of a polynomial, and waits in a queue until it comes or one of the two
//! changes course. Nothing tunnels at any speed, and [`Contact::time`] is the time of impact to the
//! nanosecond. Two segments meet when they do: list periods, bodies far away, and who asked in between
//! never show in a result, to the last bit.
//!
//! **A bounce is an impulse, and rest is a state.** An impact at more than
//! [`limits::REST_SPEED_M_S`] bounces; a slower one on the ground ends in [`Support`]: the body slides,
//! friction stops it at a computed instant, and it rests at no cost until something lifts it.
//!
//! # What is not here yet
//!
//! Only balls collide, with one another and with a level ground at up = 0: a box may stand in the world
//! but is passed through. A lasting contact between two bodies is a row of small bounces (see
//! [`limits::PARTING_SPEED_M_S`]), of which the first is reported; a body on the ground slides but does not roll.
//!
//! # Reading order
//!
//! 1. `motion`, `rotation`: the segment and its closed forms; `command`: what begins a new one;
//!    `support`: the ground that carries a body;
//! 2. `body`, `contact`, `error`, [`limits`]: what goes in, what comes out, what is refused;
//! 3. `root`, `predict`: when two segments meet; `response`: what an impact does;
//! 4. `grid`, `lists`: who might meet whom; `encounters`: the few pairs that must be remembered;
//! 5. `queue`, `events`, `physics`: all bodies, through time.

mod approach;
mod body;
mod command;
mod contact;
mod encounters;
mod error;
mod events;
mod foresee;
mod grid;
mod island;
mod islands;
pub mod limits;
mod lists;
mod motion;
mod physics;
mod predict;
mod queries;
mod queue;
mod response;
mod root;
mod rotation;
mod shape;
mod statics;
mod stepping;
mod support;
mod tree;
mod walls;

pub use body::{BodyId, BodySpec, Contacts, Material, Mobility, group};
pub use contact::Contact;
pub use error::{BodyError, ThreadsError};
pub use motion::{Motion, State};
pub use physics::{Config, ContactModel, Physics, Tally};
pub use shape::{HeightField, Hull, MassProperties, Mesh, Part, Shape};
pub use support::Support;
