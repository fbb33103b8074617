//! What holds for all bodies: gravity, the ground, how contact is worked out.

use crate::body::Material;
use crate::error::{self, BodyError};
use crate::limits;
use simbeeotic_units::{Acceleration, Time};

/// What holds for the whole world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Free fall, downwards, 0 to 1e6 m/s^2; standard gravity unless said otherwise.
    pub gravity: Acceleration,
    /// The surface of the ground, the plane at up = 0; `None`: there is no ground.
    pub ground: Option<Material>,
    /// Time between two listings of who may meet whom, 1 ms to 1000 s. Changes the cost, never a result.
    pub list_period: Time,
    /// What becomes of bodies that stay in touch.
    pub contact_model: ContactModel,
    /// Time between two steps of bodies in lasting contact, 0.1 ms to 20 ms.
    pub island_step: Time,
    /// How often a step goes over the contacts of an island, 1 to 64: more for higher stacks, and for
    /// heavy bodies upon light ones. The cost grows in proportion.
    pub solver_iterations: usize,
    /// Whether bodies that touch nobody are listed too, so that [`Physics::near`](crate::Physics::near) is quick for them.
    /// Costs one pass over all bodies each `list_period`.
    pub list_all: bool,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            gravity: simbeeotic_units::constants::STANDARD_GRAVITY,
            ground: Some(Material::default()),
            list_period: Time::from_millis(100.0),
            contact_model: ContactModel::default(),
            island_step: Time::si(1.0 / 240.0),
            solver_iterations: 4,
            list_all: false,
        }
    }
}

/// What becomes of bodies that stay in touch.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContactModel {
    /// They are handed to an island: a small world that is stepped, in which they slide, stack, push one
    /// another and come to rest.
    #[default]
    Islands,
    /// Balls bounce on in small impulses: cheaper for swarms whose bodies touch often and briefly, wrong
    /// for balls that lie upon one another. Other shapes are handed to islands all the same: on corners
    /// and edges there is no end of small impulses.
    Impulses,
}

impl Config {
    /// Whether a world can be like this.
    ///
    /// # Errors
    /// A value that is not finite or out of its range.
    pub fn check(&self) -> Result<(), BodyError> {
        error::ranged(
            "gravity [m/s^2]",
            self.gravity.get(),
            0.0,
            limits::ACCELERATION_M_S2_MAX,
        )?;
        error::ranged("list_period [s]", self.list_period.get(), 1e-3, 1e3)?;
        error::ranged("island_step [s]", self.island_step.get(), 1e-4, 2e-2)?;
        error::ranged(
            "solver_iterations",
            self.solver_iterations as f64,
            1.0,
            64.0,
        )?;
        self.ground.as_ref().map_or(Ok(()), Material::check)
    }
}
