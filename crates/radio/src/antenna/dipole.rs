//! Rods: the short dipole and the half-wave dipole, along z.
//!
//! With `s = sin^2 t`, t the angle between direction and rod:
//!
//! ```text
//! short      G = 3/2 s
//! half-wave  G = 1.6409 cos^2(pi/2 cos t) / s
//! ```
//! Both depend on `s = x^2 + y^2` alone. In the half-wave's, `cos(pi/2 sqrt u) / (1 - u)` with
//! `u = 1 - s` is smooth from end to end (the zero of the cosine at u = 1 divides out), so a
//! polynomial of five terms gives it to 1e-9: no trigonometry for a pair, and no trouble at the null.
//!
//! Source: Balanis, *Antenna Theory*, 4.2 and 4.6 (textbook; not at hand). Often seen instead of the
//! half-wave's is `1.64 sin^3 t`, 1.5 dB off at 30 degrees from the rod and 8.5 dB at 5 degrees.

use super::{Antenna, kept};
use crate::radio::RadioError;
use glam::{DVec3, Vec3};
use simbeeotic_units::{Decibels, math};
use std::f64::consts::FRAC_PI_2;

/// What a half-wave dipole has at right angles to its rod: `4 / Cin(2 pi)`, 2.15 dBi.
const HALF_WAVE_PEAK: f64 = 1.640_922_376_984_585;

/// A dipole much shorter than the wavelength: 1.76 dBi at right angles, nothing along the rod.
///
/// Chip antennas on small boards come near it, with losses of some dB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortDipole(Rod);

/// A half-wave dipole, or a quarter-wave rod over a good counterpoise: 2.15 dBi at right angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfWaveDipole(Rod);

/// What rods have in common.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Rod {
    /// The least directivity.
    floor: f64,
    /// What the losses leave.
    kept: f64,
}

/// How deep nulls are unless said otherwise: what leaks from cable and body fills them.
const NULL_FLOOR_DB: f64 = -30.0;

impl Default for Rod {
    fn default() -> Self {
        Self::with(Decibels::from_db(NULL_FLOOR_DB), Decibels::ZERO)
    }
}

impl Rod {
    fn with(null_floor: Decibels, loss: Decibels) -> Self {
        Self {
            floor: null_floor.ratio(),
            kept: kept(loss),
        }
    }

    fn new(null_floor: Decibels, loss: Decibels) -> Result<Self, RadioError> {
        super::check_loss(loss)?;
        if !(-200.0..=0.0).contains(&null_floor.db()) {
            return Err(RadioError::OutOfRange {
                what: "null floor",
                got: null_floor.to_string(),
                expected: "from -200 dB to 0 dB",
            });
        }
        Ok(Self::with(null_floor, loss))
    }

    fn gain(&self, directivity: f64) -> Decibels {
        Decibels::from_ratio(directivity.max(self.floor) * self.kept)
    }

    #[inline]
    fn gain_linear(&self, directivity: f32) -> f32 {
        directivity.max(self.floor as f32) * self.kept as f32
    }
}

impl Default for ShortDipole {
    /// Lossless, with nulls at -30 dBi.
    fn default() -> Self {
        Self(Rod::default())
    }
}

impl ShortDipole {
    /// With a gain never below `null_floor` (-200 dBi to 0 dBi, before losses) and a `loss` of 0 dB to
    /// 60 dB.
    ///
    /// # Errors
    /// One is out of range.
    pub fn new(null_floor: Decibels, loss: Decibels) -> Result<Self, RadioError> {
        Rod::new(null_floor, loss).map(Self)
    }
}

impl Default for HalfWaveDipole {
    /// Lossless, with nulls at -30 dBi.
    fn default() -> Self {
        Self(Rod::default())
    }
}

impl HalfWaveDipole {
    /// With a gain never below `null_floor` (-200 dBi to 0 dBi, before losses) and a `loss` of 0 dB to
    /// 60 dB.
    ///
    /// # Errors
    /// One is out of range.
    pub fn new(null_floor: Decibels, loss: Decibels) -> Result<Self, RadioError> {
        Rod::new(null_floor, loss).map(Self)
    }
}

impl Antenna for ShortDipole {
    fn gain(&self, direction: DVec3) -> Decibels {
        let s = direction.x * direction.x + direction.y * direction.y;
        self.0.gain(1.5 * s)
    }

    #[inline]
    fn gain_linear(&self, direction: Vec3) -> f32 {
        let s = direction.x * direction.x + direction.y * direction.y;
        self.0.gain_linear(1.5 * s)
    }
}

impl Antenna for HalfWaveDipole {
    fn gain(&self, direction: DVec3) -> Decibels {
        // cos(pi/2 z) is sin(pi/2 (1 - z)), and 1 - z is s / (1 + z): exact to the null.
        let s = direction.x * direction.x + direction.y * direction.y;
        let height = direction.z.abs();
        let field = math::sin(FRAC_PI_2 * s / (1.0 + height));
        let directivity = if s > 0.0 {
            HALF_WAVE_PEAK * field * field / s
        } else {
            0.0
        };
        self.0.gain(directivity)
    }

    #[inline]
    fn gain_linear(&self, direction: Vec3) -> f32 {
        let s = direction.x * direction.x + direction.y * direction.y;
        let u = 1.0 - s;
        // cos(pi/2 sqrt u) / (1 - u)
        let q = (((2.360_106_5e-5 * u - 8.935_363e-4) * u + 0.019_968_607) * u - 0.233_700_51) * u
            + 1.0;
        self.0.gain_linear(HALF_WAVE_PEAK as f32 * s * q * q)
    }
}

#[cfg(test)]
mod tests {
    use super::super::mean_gain;
    use super::super::testing::{assert_fast_is_exact, towards};
    use super::*;

    /// A gain at an angle from the rod, degrees.
    fn off_rod(antenna: &dyn Antenna, degrees: f64) -> f64 {
        antenna.gain(towards(40.0, 90.0 - degrees)).db()
    }

    #[test]
    fn half_wave_dipole_has_the_gains_of_the_textbook() {
        let dipole = HalfWaveDipole::default();
        for (degrees, dbi, tolerance) in [
            (90.0, 2.15, 0.005),
            (60.0, 0.39, 0.01),
            (30.0, -5.43, 0.01),
            (15.0, -11.5, 0.05),
            (5.0, -21.0, 0.2),
        ] {
            let gain = off_rod(&dipole, degrees);
            assert!((gain - dbi).abs() < tolerance, "{degrees} degrees: {gain}");
            assert!((gain - off_rod(&dipole, 180.0 - degrees)).abs() < 1e-9);
        }
        assert!((off_rod(&dipole, 0.0) + 30.0).abs() < 1e-9);
    }

    #[test]
    fn the_sine_cubed_shortcut_would_be_off_by_decibels() {
        let dipole = HalfWaveDipole::default();
        let shortcut = |degrees: f64| {
            let sin = math::sin(degrees.to_radians());
            10.0 * math::log10(1.64 * sin * sin * sin)
        };
        assert!((shortcut(30.0) - off_rod(&dipole, 30.0) + 1.45).abs() < 0.1);
        assert!(shortcut(5.0) - off_rod(&dipole, 5.0) < -8.0);
    }

    #[test]
    fn short_dipole_is_sine_squared() {
        let dipole = ShortDipole::default();
        assert!((off_rod(&dipole, 90.0) - 1.7609).abs() < 1e-4);
        assert!((off_rod(&dipole, 30.0) + 4.2597).abs() < 1e-4);
        assert!((off_rod(&dipole, 0.0) + 30.0).abs() < 1e-9);
    }

    #[test]
    fn without_loss_all_power_is_radiated() {
        // The floor of the null adds what it fills.
        let deep = Decibels::from_db(-200.0);
        for antenna in [
            &ShortDipole::new(deep, Decibels::ZERO).unwrap() as &dyn Antenna,
            &HalfWaveDipole::new(deep, Decibels::ZERO).unwrap(),
            &ShortDipole::default(),
            &HalfWaveDipole::default(),
        ] {
            let mean = mean_gain(antenna);
            assert!((mean - 1.0).abs() < 1e-5, "{antenna:?}: {mean}");
        }
        let half = HalfWaveDipole::new(deep, Decibels::from_db(3.0)).unwrap();
        assert!((mean_gain(&half) - 0.501_187).abs() < 1e-5);
    }

    #[test]
    fn the_polynomial_is_the_formula() {
        assert_fast_is_exact(&ShortDipole::default(), 1e-5);
        assert_fast_is_exact(&HalfWaveDipole::default(), 1e-5);
        let lossy = HalfWaveDipole::new(Decibels::from_db(-20.0), Decibels::from_db(2.0)).unwrap();
        assert_fast_is_exact(&lossy, 1e-5);
        assert!((lossy.gain(DVec3::Z).db() + 22.0).abs() < 1e-9);
    }

    #[test]
    fn losses_and_floors_out_of_range_are_refused() {
        let (ok, zero) = (Decibels::from_db(-30.0), Decibels::ZERO);
        for (floor, loss) in [
            (Decibels::from_db(1.0), zero),
            (Decibels::from_db(f64::NAN), zero),
            (ok, Decibels::from_db(-1.0)),
            (ok, Decibels::from_db(61.0)),
        ] {
            assert!(HalfWaveDipole::new(floor, loss).is_err());
            assert!(ShortDipole::new(floor, loss).is_err());
        }
    }
}
