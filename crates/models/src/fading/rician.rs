//! A line of sight, and echoes.

use simbeeotic_model::check::in_range;
use simbeeotic_model::radio::{Fading, Rician};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{BuildError, FromParams, fading, params};

/// A line of sight, and echoes: the power gain has Rice's distribution with mean 1, for each frame and
/// receiver anew.
#[fading("rician")]
#[derive(Debug)]
pub struct RicianFading(Rician);

/// Parameters of [`RicianFading`].
#[params]
pub struct RicianParams {
    /// What the line of sight brings over what all echoes bring. -40 dB (as good as none) to 60 dB.
    pub k: Decibels,
}

impl Default for RicianParams {
    fn default() -> Self {
        Self {
            k: Decibels::from_db(6.0),
        }
    }
}

impl FromParams for RicianFading {
    type Params = RicianParams;

    fn from_params(params: RicianParams) -> Result<Self, BuildError> {
        let (least, most) = (Decibels::from_db(-40.0), Decibels::from_db(60.0));
        in_range("k", params.k, least..=most)?;
        Ok(Self(Rician::new(params.k)))
    }
}

impl Fading for RicianFading {
    fn gain(&self, draw: u64, distance_m: f64) -> f64 {
        self.0.gain(draw, distance_m)
    }

    fn fade(&self, draws: &[u64], distances_squared_m2: &[f32], gains: &mut [f32]) {
        self.0.fade(draws, distances_squared_m2, gains);
    }
}
