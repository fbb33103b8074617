//! A half-wave dipole.

use glam::{DVec3, Vec3};
use simbeeotic_model::radio::{Antenna, HalfWaveDipole};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{BuildError, FromParams, antenna, params};

/// A half-wave dipole along the mount's z axis: 2.15 dBi at right angles to it, nothing along it.
///
/// Also the sleeve antennas ("rubber ducks") of modules. Polarisation is not modelled.
#[antenna("half-wave-dipole")]
#[derive(Debug)]
pub struct HalfWaveDipoleAntenna(HalfWaveDipole);

/// Parameters of [`HalfWaveDipoleAntenna`].
#[params]
pub struct HalfWaveDipoleAntennaParams {
    /// The least gain, -200 dB to 0 dB over isotropic: what cable and body leak into the nulls.
    pub null_floor: Decibels,
    /// What cable, matching and the antenna itself take, 0 dB to 60 dB.
    pub loss: Decibels,
}

impl Default for HalfWaveDipoleAntennaParams {
    fn default() -> Self {
        Self {
            null_floor: Decibels::from_db(-30.0),
            loss: Decibels::ZERO,
        }
    }
}

impl FromParams for HalfWaveDipoleAntenna {
    type Params = HalfWaveDipoleAntennaParams;

    fn from_params(params: HalfWaveDipoleAntennaParams) -> Result<Self, BuildError> {
        Ok(Self(HalfWaveDipole::new(params.null_floor, params.loss)?))
    }
}

impl Antenna for HalfWaveDipoleAntenna {
    fn gain(&self, direction: DVec3) -> Decibels {
        self.0.gain(direction)
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        self.0.gain_linear(direction)
    }
}
