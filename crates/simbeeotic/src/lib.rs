//! Simbeeotic: a simulator and testbed for swarms of micro-aerial vehicles.
//!
//! This crate is what a swarm's own crate depends on. It brings the model API, the shelf of parts,
//! and the whole program: a crate whose `main` calls [`program::main`] has every command of
//! `simbeeotic`, with its own parts on the shelf beside ours.
//!
//! ```
//! use simbeeotic::prelude::*;
//!
//! /// A bee that climbs, and turns a little each second.
//! #[behavior("spiral-bee")]
//! pub struct SpiralBee {
//!     params: SpiralBeeParams,
//! }
//!
//! /// Parameters of [`SpiralBee`].
//! #[params]
//! pub struct SpiralBeeParams {
//!     /// How fast it flies.
//!     pub speed: Speed,
//!     /// How far it turns each second.
//!     pub turn: Angle,
//! }
//!
//! impl Default for SpiralBeeParams {
//!     fn default() -> Self {
//!         Self { speed: Speed::si(1.0), turn: Angle::from_degrees(30.0) }
//!     }
//! }
//!
//! impl Behavior for SpiralBee {
//!     type Params = SpiralBeeParams;
//!
//!     fn build(params: SpiralBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
//!         kit.every(Time::from_secs(1.0), Self::steer);
//!         Ok(Self { params })
//!     }
//! }
//!
//! impl SpiralBee {
//!     fn steer(&mut self, bee: &mut Bee<'_>) {
//!         bee.turn(self.params.turn);
//!         bee.fly(Velocity::new(self.params.speed, Speed::ZERO, self.params.speed * 0.1));
//!     }
//! }
//!
//! let run = simbeeotic::run_text(
//!     r#"
//!     [run]
//!     seed = 1
//!     end_time = "20 s"
//!
//!     [[model]]
//!     use = "spiral-bee"
//!     count = 3
//!     start = { ball = "10 m" }
//!     "#,
//! )?;
//! assert_eq!(run.models, 3);
//! # Ok::<(), simbeeotic::Error>(())
//! ```
//!
//! Reading order: [`model`] (what authors write against), [`units`], then [`scenario`] (from a file
//! to a run) and [`program`]. [`kernel`], [`physics`], [`radio`] and [`world`] are the floors below.

// The attribute macros say `::simbeeotic`, in this crate too.
extern crate self as simbeeotic;

pub use simbeeotic_kernel as kernel;
pub use simbeeotic_model as model;
pub use simbeeotic_models as models;
pub use simbeeotic_physics as physics;
pub use simbeeotic_radio as radio;
pub use simbeeotic_record as record;
pub use simbeeotic_scenario as scenario;
pub use simbeeotic_units as units;
pub use simbeeotic_view as view;
pub use simbeeotic_world as world;

mod experiment;
mod library;
pub mod program;

pub use experiment::Experiment;
pub use library::{Error, Run, run_file, run_text};

/// What a file with a behaviour in it wants to see.
pub mod prelude {
    pub use crate::model::prelude::*;
    pub use crate::models::sensor::contact::Bump;
    pub use crate::models::sensor::multi_ranger::Gaps;
    pub use crate::models::sensor::scan::{Scan, ScanEcho};
    pub use crate::models::sensor::sighting::Sighting;
}

// The book's code is compiled, and its tests run, with the examples of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/first-swarm.md")]
mod book {}

#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/world.md")]
mod world_in_the_book {}

#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/generators.md")]
mod generators_in_the_book {}

#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/sensors.md")]
mod sensors_in_the_book {}

#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/sensors-environment.md")]
mod surroundings_in_the_book {}

#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/radio.md")]
mod radio_in_the_book {}

#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/metrics.md")]
mod metrics_in_the_book {}

#[cfg(doctest)]
#[doc = include_str!("../../../docs/book/src/radio-hardware.md")]
mod radio_hardware_in_the_book {}
