//! The air that radios share, as a scenario sets it, and the levels of fidelity to choose from.

use crate::behavior::BuildError;
use crate::config::{Fault, Node, Params};

use simbeeotic_radio::{Medium, Propagation};
use simbeeotic_units::{Decibels, Length, PowerLevel};
use std::sync::Arc;

/// What `[channel]` says, whatever the level of fidelity: each takes from it what it models.
#[derive(Clone, Debug)]
pub struct Air {
    /// The master seed of the run.
    pub seed: u64,
    /// What the space between two antennas does to the power.
    pub propagation: Arc<dyn Propagation>,
    /// Frames reach no further than this; `None`: the scenario does not say.
    pub range_limit: Option<Length>,
    /// The noise at every receiver; `None`: the scenario does not say.
    pub noise_floor: Option<NoiseFloor>,
    /// Whether walls and bodies in the line of sight take their share of the power.
    pub walls: bool,
}

/// Mean and spread of the noise at a receiver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoiseFloor {
    /// Its mean level.
    pub mean: PowerLevel,
    /// Its standard deviation.
    pub sigma: Decibels,
}

/// A level of fidelity of the air: a function from settings to a [`Medium`]. Register it with
/// `#[medium("name")]`.
pub trait Fidelity: Sized + 'static {
    /// What the scenario may set: `medium = { use = "name", ... }`.
    type Params: Params;

    /// The medium of one run; `None`: no packet goes anywhere.
    ///
    /// # Errors
    /// Settings that make no sense, by [`BuildError::parameter`].
    fn medium(params: Self::Params, air: &Air) -> Result<Option<Box<dyn Medium>>, BuildError>;

    /// The keys of `[channel]` that this level leaves aside, and what it does instead. Where the
    /// scenario has such a key, it is warned of it there. None unless said.
    fn leaves_aside(_air: &Air) -> Vec<Aside> {
        Vec::new()
    }
}

/// A key of `[channel]` that a level of fidelity leaves aside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Aside {
    /// The key: `noise_floor`, `shadowing`, ...
    pub key: &'static str,
    /// What becomes of it: a clause that goes on after "`noise_floor` ".
    pub message: &'static str,
}

/// A medium as its maker hands it over.
pub struct MadeAir {
    /// The medium; `None`: no packet goes anywhere.
    pub medium: Option<Box<dyn Medium>>,
    /// What it leaves aside of `[channel]`.
    pub aside: Vec<Aside>,
}

/// Makes a medium from its checked section.
pub type AirMaker = fn(&Node, &Air) -> Result<MadeAir, Vec<Fault>>;
