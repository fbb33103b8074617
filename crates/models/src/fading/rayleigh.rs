//! Echoes only.

use simbeeotic_model::radio::{Fading, Rayleigh};
use simbeeotic_model::{BuildError, FromParams, fading, params};

/// Echoes only, no line of sight: the power gain is exponential with mean 1, for each frame and receiver anew.
#[fading("rayleigh")]
#[derive(Debug)]
pub struct RayleighFading;

/// Nothing to set.
#[params]
#[derive(Default)]
pub struct RayleighParams {}

impl FromParams for RayleighFading {
    type Params = RayleighParams;

    fn from_params(_params: RayleighParams) -> Result<Self, BuildError> {
        Ok(Self)
    }
}

impl Fading for RayleighFading {
    fn gain(&self, draw: u64, distance_m: f64) -> f64 {
        Rayleigh.gain(draw, distance_m)
    }

    fn fade(&self, draws: &[u64], distances_squared_m2: &[f32], gains: &mut [f32]) {
        Rayleigh.fade(draws, distances_squared_m2, gains);
    }
}
