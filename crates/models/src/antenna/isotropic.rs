//! An antenna that radiates alike in every direction.

use glam::{DVec3, Vec3};
use simbeeotic_model::radio::{Antenna, Isotropic};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{BuildError, FromParams, antenna, params};

/// An antenna that radiates alike in every direction. No real one does; many come near enough.
#[antenna(
    "isotropic",
    java = "harvard.robobees.simbeeotic.model.comms.IsotropicAntenna"
)]
#[derive(Debug)]
pub struct IsotropicAntenna(Isotropic);

/// Parameters of [`IsotropicAntenna`].
#[params]
pub struct IsotropicAntennaParams {
    /// Gain in every direction: 0 dB is lossless, negative for losses of cable and matching.
    pub gain: Decibels,
}

impl Default for IsotropicAntennaParams {
    fn default() -> Self {
        Self {
            gain: Decibels::ZERO,
        }
    }
}

impl FromParams for IsotropicAntenna {
    type Params = IsotropicAntennaParams;

    fn from_params(params: IsotropicAntennaParams) -> Result<Self, BuildError> {
        Ok(Self(Isotropic { gain: params.gain }))
    }
}

impl Antenna for IsotropicAntenna {
    fn gain(&self, direction: DVec3) -> Decibels {
        self.0.gain(direction)
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        self.0.gain_linear(direction)
    }

    fn uniform_gain(&self) -> Option<Decibels> {
        self.0.uniform_gain()
    }
}
