//! A rod much shorter than the wavelength.

use glam::{DVec3, Vec3};
use simbeeotic_model::radio::{Antenna, ShortDipole};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{BuildError, FromParams, antenna, params};

/// A dipole much shorter than the wavelength, along the mount's z axis: 1.76 dBi at right angles to it.
///
/// Chip antennas on small boards come near it; they lose 1 dB to 6 dB. Polarisation is not modelled.
#[antenna("short-dipole")]
#[derive(Debug)]
pub struct ShortDipoleAntenna(ShortDipole);

/// Parameters of [`ShortDipoleAntenna`].
#[params]
pub struct ShortDipoleAntennaParams {
    /// The least gain, -200 dB to 0 dB over isotropic: what cable and body leak into the nulls.
    pub null_floor: Decibels,
    /// What cable, matching and the antenna itself take, 0 dB to 60 dB.
    pub loss: Decibels,
}

impl Default for ShortDipoleAntennaParams {
    fn default() -> Self {
        Self {
            null_floor: Decibels::from_db(-30.0),
            loss: Decibels::ZERO,
        }
    }
}

impl FromParams for ShortDipoleAntenna {
    type Params = ShortDipoleAntennaParams;

    fn from_params(params: ShortDipoleAntennaParams) -> Result<Self, BuildError> {
        Ok(Self(ShortDipole::new(params.null_floor, params.loss)?))
    }
}

impl Antenna for ShortDipoleAntenna {
    fn gain(&self, direction: DVec3) -> Decibels {
        self.0.gain(direction)
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        self.0.gain_linear(direction)
    }
}
