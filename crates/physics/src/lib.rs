//! Rigid bodies of any shape on their own clocks: wrenches, contacts at computed times, islands, rays.
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
//! other is found (a root of a polynomial for balls, a search over closed forms for whatever turns), and
//! waits in a queue until it comes or one of the two changes course. Nothing tunnels at any speed, and
//! [`Contact::time`] is the time of impact. Two segments meet when they do: list periods, bodies far
//! away, threads, and who asked in between never show in a result, to the last bit.
//!
//! **A bounce is an impulse, lasting contact is an island, and rest is free.** What bounces gets one
//! impulse. What does not come apart is handed to an island, a small world that is stepped: there
//! bodies slide, topple, stack and push one another, and when they have come to rest they cost nothing.
//! A ball on the ground needs none of that: it slides and rests by formula ([`Support`]).
//!
//! # What is not here
//!
//! No joints, and nothing bends. A body that moves collides as a convex solid or a compound of such.
//! Between members of one island a touch is timed to the step, 1/240 s ([`Config::island_step`]), and
//! what lies on something sinks into it by less than a millimetre or two.
//!
//! # Reading order
//!
//! 1. `motion`, `rotation`: the segment and its closed forms; `command`: what begins a new one;
//!    `support`: the ground that carries a body;
//! 2. `shape`, `body`, `kind`, `config`, `contact`, `error`, [`limits`]: what goes in, what comes out, what is
//!    refused;
//! 3. `root`, `approach`, `predict`: when two segments meet; `response`: what an impact does;
//! 4. `duties`: who may touch whom; `grid`, `lists`: who might meet whom soon; `tree`, `statics`, `walls`: what stands in the way;
//!    `encounters`: the few pairs that must be remembered;
//! 5. `island`, `islands`, `stepping`, `settling`, `rest`: lasting contact;
//! 6. `queue`, `foresee`, `events`, `physics`: all bodies, through time; `queries`: rays and neighbours, `fan`:
//!    many rays at once.

mod approach;
mod body;
mod command;
mod config;
mod contact;
mod duties;
mod encounters;
mod error;
mod events;
mod fan;
mod foresee;
mod grid;
mod island;
mod islands;
mod kind;
pub mod limits;
mod lists;
mod motion;
mod odometer;
mod physics;
mod predict;
mod queries;
mod queue;
mod response;
mod rest;
mod root;
mod rotation;
mod settling;
mod shape;
mod sight;
mod statics;
mod stepping;
mod support;
mod tree;
mod tumbling;
mod walls;

pub use body::{BodyId, BodySpec, Contacts, Material, Mobility, group};
pub use config::{Config, ContactModel};
pub use contact::Contact;
pub use error::{BodyError, ThreadsError};
pub use fan::Fan;
pub use kind::{Kind, Kinds};
pub use motion::{Motion, State};
pub use physics::{Physics, Tally};
pub use queries::{Hit, Ray, Sees};
pub use shape::{HeightField, Hull, MassProperties, Mesh, Part, Shape};
pub use support::Support;
