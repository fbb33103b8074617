//! The table of all bodies, and the contacts between them.

use crate::body::{BodyId, BodySpec, Material};
use crate::contact::Contact;
use crate::error::BodyError;
use crate::motion::Motion;
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Acceleration, Time};

/// What holds for the whole world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Free fall, downwards; standard gravity unless said otherwise.
    pub gravity: Acceleration,
    /// The surface of the ground, the plane at up = 0; `None`: there is no ground.
    pub ground: Option<Material>,
    /// Time between two listings of who may meet whom. Changes the cost, never a result.
    pub list_period: Time,
    /// Whether bodies that touch nobody are kept in the grid too, so that [`Physics::near`] stays quick
    /// for them. Costs one pass over all bodies each `list_period`.
    pub grid_all: bool,
}

impl Default for Config {
    fn default() -> Self {
        Self {
            gravity: simbeeotic_units::constants::STANDARD_GRAVITY,
            ground: Some(Material::default()),
            list_period: Time::from_millis(100.0),
            grid_all: false,
        }
    }
}

/// All bodies.
pub struct Physics {
    config: Config,
    motions: Vec<Motion>,
}

impl Physics {
    /// A world without bodies.
    #[must_use]
    pub fn new(config: Config) -> Self {
        Self {
            config,
            motions: Vec::new(),
        }
    }

    /// Adds a body, as it is at the start of the run.
    ///
    /// # Errors
    /// As [`BodySpec::check`], or more than 2^32 - 2 bodies.
    pub fn add(&mut self, spec: BodySpec) -> Result<BodyId, BodyError> {
        spec.check()?;
        let friction = self
            .config
            .ground
            .map_or(0.0, |g| g.against(&spec.material).friction);
        let id = BodyId(self.motions.len() as u32);
        self.motions
            .push(Motion::new(&spec, self.config.gravity.get(), friction));
        Ok(id)
    }

    /// Number of bodies.
    #[must_use]
    pub fn len(&self) -> usize {
        self.motions.len()
    }

    /// Whether there is no body.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.motions.is_empty()
    }

    /// The trajectory segment of a body.
    #[inline]
    #[must_use]
    pub fn motion(&self, id: BodyId) -> &Motion {
        &self.motions[id.index()]
    }

    /// Lets `motion` replace the body's segment, as of `now`.
    pub fn commit(&mut self, id: BodyId, _now: SimTime, motion: Motion) {
        self.motions[id.index()] = motion;
    }

    /// Predicts the contacts of all bodies that have changed.
    pub fn settle(&mut self, _now: SimTime) {}

    /// The earliest instant at which [`advance`](Self::advance) has something to do.
    pub fn next_time(&mut self) -> Option<SimTime> {
        None
    }

    /// Resolves everything that is due up to and including `now`; appends the contacts to `contacts`.
    pub fn advance(&mut self, _now: SimTime, _contacts: &mut Vec<Contact>) {}

    /// Appends the bodies whose centres lie within `radius_m` of `p_enu` at `t`, in order of id.
    pub fn near(&self, _p_enu: DVec3, _radius_m: f64, _t: SimTime, _found: &mut Vec<BodyId>) {}
}
