//! An antenna that radiates alike in every direction.

use super::Antenna;
use glam::{DVec3, Vec3};
use simbeeotic_units::Decibels;

/// An antenna that radiates alike in every direction. No real antenna does; many come near enough.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Isotropic {
    /// Gain in every direction. 0 dB is the lossless one; negative for matching and cable losses.
    pub gain: Decibels,
}

impl Antenna for Isotropic {
    fn gain(&self, _direction: DVec3) -> Decibels {
        self.gain
    }

    fn gain_linear(&self, _direction: Vec3) -> f32 {
        self.gain.ratio() as f32
    }

    fn uniform_gain(&self) -> Option<Decibels> {
        Some(self.gain)
    }
}

#[cfg(test)]
mod tests {
    use super::super::mean_gain;
    use super::super::testing::assert_fast_is_exact;
    use super::*;

    #[test]
    fn it_is_the_same_all_round_and_loses_nothing() {
        assert_fast_is_exact(&Isotropic::default(), 1e-6);
        assert!((mean_gain(&Isotropic::default()) - 1.0).abs() < 1e-12);
        let lossy = Isotropic {
            gain: Decibels::from_db(-3.0),
        };
        assert_eq!(lossy.uniform_gain(), Some(lossy.gain(DVec3::Y)));
        assert!((mean_gain(&lossy) - 0.501_187).abs() < 1e-6);
    }
}
