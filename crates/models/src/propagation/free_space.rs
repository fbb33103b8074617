//! Free space: nothing but distance.

use simbeeotic_model::radio::{FreeSpace, Link, Links, Propagation};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{BuildError, FromParams, params, propagation};

/// Free space: `20 log10(4 pi d / lambda)` of path loss, never below 0 dB (Friis 1946).
#[propagation(
    "free-space",
    java = "harvard.robobees.simbeeotic.model.comms.FreeSpacePropagationModel"
)]
#[derive(Debug)]
pub struct FreeSpacePropagation;

/// Free space has no parameters of its own.
#[params]
#[derive(Default)]
pub struct FreeSpaceParams {}

impl FromParams for FreeSpacePropagation {
    type Params = FreeSpaceParams;

    fn from_params(_params: FreeSpaceParams) -> Result<Self, BuildError> {
        Ok(Self)
    }
}

impl Propagation for FreeSpacePropagation {
    fn loss(&self, link: &Link) -> Decibels {
        FreeSpace.loss(link)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        FreeSpace.gains(links, gains);
    }
}
