//! Rigid bodies on their own clocks, wrenches, contacts at computed times.

mod body;
mod command;
mod contact;
mod encounters;
mod error;
mod events;
mod grid;
pub mod limits;
mod lists;
mod motion;
mod physics;
mod predict;
mod queue;
mod response;
mod root;
mod rotation;
mod support;

pub use body::{BodyId, BodySpec, Contacts, Material, Mobility, Shape, group};
pub use contact::Contact;
pub use error::BodyError;
pub use motion::{Motion, State};
pub use physics::{Config, Physics, Tally};
pub use support::Support;
