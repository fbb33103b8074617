//! Rigid bodies on their own clocks, wrenches, contacts at computed times.

mod body;
mod command;
mod contact;
mod error;
pub mod limits;
mod motion;
mod physics;
mod root;
mod rotation;
mod support;

pub use body::{BodyId, BodySpec, Contacts, Material, Mobility, Shape, group};
pub use contact::Contact;
pub use error::BodyError;
pub use motion::{Motion, State};
pub use physics::{Config, Physics};
pub use support::Support;
