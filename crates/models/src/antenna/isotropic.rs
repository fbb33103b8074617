//! An antenna that radiates alike in every direction.

use glam::{DVec3, Vec3};
use simbeeotic_model::check::in_range;
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
    /// Gain in every direction: 0 dB is lossless, negative for losses of cable and matching;
    /// -100 dB to 60 dB.
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
        let db = Decibels::from_db;
        in_range("gain", params.gain, db(-100.0)..=db(60.0))?;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gains_that_no_antenna_has_are_refused() {
        let made = |db| {
            let gain = Decibels::from_db(db);
            IsotropicAntenna::from_params(IsotropicAntennaParams { gain })
        };
        for good in [-100.0, 0.0, 60.0] {
            assert_eq!(
                made(good).unwrap().uniform_gain(),
                Some(Decibels::from_db(good))
            );
        }
        for bad in [-100.1, 60.1, 500.0, f64::INFINITY, f64::NAN] {
            assert!(made(bad).is_err(), "{bad}");
        }
    }
}
