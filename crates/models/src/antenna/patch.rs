//! A patch: one side of a board.

use glam::{DVec3, Vec3};
use simbeeotic_model::radio::{Antenna, Patch};
use simbeeotic_model::units::{Angle, Decibels};
use simbeeotic_model::{BuildError, FromParams, antenna, params};

/// A patch that looks along the mount's x axis: half the sphere, 6 to 7 dBi as it stands.
///
/// The gain follows from the beamwidths: what goes forward is missing elsewhere. Polarisation (along z)
/// is not modelled.
#[antenna("patch")]
#[derive(Debug)]
pub struct PatchAntenna(Patch);

/// Parameters of [`PatchAntenna`].
#[params]
pub struct PatchAntennaParams {
    /// Angle between the half-power points in the plane of polarisation (xz), 5 to 175 degrees.
    pub e_plane: Angle,
    /// The same at right angles to it (xy).
    pub h_plane: Angle,
    /// Gain ahead over gain behind, 6 dB to 60 dB; more the larger the ground plane.
    pub front_to_back: Decibels,
    /// What cable, matching and the board's material take, 0 dB to 60 dB; FR4 takes about 1 dB.
    pub loss: Decibels,
}

impl Default for PatchAntennaParams {
    fn default() -> Self {
        Self {
            e_plane: Angle::from_degrees(90.0),
            h_plane: Angle::from_degrees(80.0),
            front_to_back: Decibels::from_db(15.0),
            loss: Decibels::from_db(1.0),
        }
    }
}

impl FromParams for PatchAntenna {
    type Params = PatchAntennaParams;

    fn from_params(params: PatchAntennaParams) -> Result<Self, BuildError> {
        let PatchAntennaParams {
            e_plane,
            h_plane,
            front_to_back,
            loss,
        } = params;
        Ok(Self(Patch::new(e_plane, h_plane, front_to_back, loss)?))
    }
}

impl Antenna for PatchAntenna {
    fn gain(&self, direction: DVec3) -> Decibels {
        self.0.gain(direction)
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        self.0.gain_linear(direction)
    }
}
