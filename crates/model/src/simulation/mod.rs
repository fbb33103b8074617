//! A run: from its parts to its summary.
//!
//! [`Setup`] says what there is; [`Simulation::new`] puts it together; [`Simulation::run`] runs it
//! to its end and tells the components what they asked to see. Scenario files become a `Setup`;
//! programs may fill one themselves.

mod run;
mod setup;

pub use run::{Outcome, Simulation, SimulationError};
pub use setup::{ModelPlan, Setup, SetupError};
