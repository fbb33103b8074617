//! The cosine pattern of ns-3.
//!
//! ```text
//! G = Gmax cos^2m(az / 2) cos^2n(el / 2),   m = log(1/2) / (2 log cos(width / 4))
//! ```
//! az is counted around z from the boresight, el from the xy plane; a width of 360 degrees is no
//! dependence on that angle. Half an angle's cosine needs no trigonometry:
//! `cos^2(az / 2) = (1 + cos az) / 2`, and `cos az = x / sqrt(x^2 + y^2)`.
//!
//! Source: ns-3's `CosineAntennaModel` (facts only). There -3 dB stands
//! for one half, a difference of 0.01 dB at the beam's edge, and `Gmax` is 0 dBi unless set: that
//! antenna radiates less than it is fed. Here `Gmax` is such that the mean over the sphere is 1.

use super::{Antenna, kept};
use crate::fast;
use crate::radio::RadioError;
use glam::{DVec3, Vec3};
use simbeeotic_units::{Angle, Decibels, math};
use std::f64::consts::PI;

/// An antenna with a main lobe of two beamwidths and nothing at its back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cosine {
    /// m and n.
    exponents: [f64; 2],
    /// Greatest gain, as a factor.
    peak: f64,
    /// The least gain, as a factor: cosines have true zeros.
    floor: f64,
}

/// How far below its peak the pattern ends, dB.
const FLOOR_DB: f64 = 60.0;

impl Cosine {
    /// With these widths between the half-power points (more than 1, up to 360 degrees) in azimuth and
    /// elevation, and a loss of 0 dB to 60 dB. Lossless, its mean over the sphere is 1.
    ///
    /// # Errors
    /// A number is out of range.
    pub fn new(azimuth: Angle, elevation: Angle, loss: Decibels) -> Result<Self, RadioError> {
        super::check_loss(loss)?;
        let exponents = exponents(azimuth, elevation)?;
        Ok(Self::shaped(exponents, kept(loss) / mean(exponents)))
    }

    /// The same shape with a greatest gain as given (-60 dBi to 60 dBi), whatever its mean.
    ///
    /// # Errors
    /// A number is out of range.
    pub fn with_peak(azimuth: Angle, elevation: Angle, peak: Decibels) -> Result<Self, RadioError> {
        if !(-60.0..=60.0).contains(&peak.db()) {
            return Err(RadioError::OutOfRange {
                what: "greatest gain",
                got: peak.to_string(),
                expected: "from -60 dB to 60 dB",
            });
        }
        Ok(Self::shaped(exponents(azimuth, elevation)?, peak.ratio()))
    }

    fn shaped(exponents: [f64; 2], peak: f64) -> Self {
        let floor = peak * kept(Decibels::from_db(FLOOR_DB));
        Self {
            exponents,
            peak,
            floor,
        }
    }
}

fn exponents(azimuth: Angle, elevation: Angle) -> Result<[f64; 2], RadioError> {
    let exponent = |what, width: Angle| {
        // Room for what a unit's factor rounds.
        if !(1.0..=360.000_001).contains(&width.degrees()) {
            return Err(RadioError::OutOfRange {
                what,
                got: super::in_degrees(width),
                expected: "from 1 deg to 360 deg",
            });
        }
        let edge = (width * 0.25).cos();
        Ok(if width.degrees() >= 359.999 {
            0.0
        } else {
            math::ln(0.5) / (2.0 * math::ln(edge))
        })
    };
    Ok([
        exponent("beamwidth in azimuth", azimuth)?,
        exponent("beamwidth in elevation", elevation)?,
    ])
}

/// The mean of the shape over the sphere, without its floor: azimuth and elevation apart, each by the
/// trapezoid rule.
fn mean([m, n]: [f64; 2]) -> f64 {
    const STEPS: u32 = 4000;
    let trapezoid = |from: f64, to: f64, f: &dyn Fn(f64) -> f64| {
        let step = (to - from) / f64::from(STEPS);
        let inner: f64 = (1..STEPS).map(|i| f(from + step * f64::from(i))).sum();
        step * (inner + 0.5 * (f(from) + f(to)))
    };
    let half_cos2 = |angle: f64| 0.5 * (1.0 + math::cos(angle));
    let around = trapezoid(-PI, PI, &|az| math::pow(half_cos2(az), m));
    let up = trapezoid(-PI / 2.0, PI / 2.0, &|el| {
        math::pow(half_cos2(el), n) * math::cos(el)
    });
    around * up / (4.0 * PI)
}

impl Antenna for Cosine {
    fn gain(&self, direction: DVec3) -> Decibels {
        let [m, n] = self.exponents;
        let level = math::hypot(direction.x, direction.y);
        let cos_azimuth = if level > 0.0 {
            direction.x / level
        } else {
            1.0
        };
        let azimuth = math::pow((0.5 * (1.0 + cos_azimuth)).max(0.0), m);
        let elevation = math::pow(0.5 * (1.0 + level), n);
        Decibels::from_ratio((self.peak * azimuth * elevation).max(self.floor))
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        let Vec3 { x, y, .. } = direction;
        let [m, n] = self.exponents.map(|exponent| exponent as f32);
        let level = (x * x + y * y).sqrt();
        // 1 + cos az, without the cancellation near the back.
        let open = if level <= f32::MIN_POSITIVE {
            2.0
        } else if x >= 0.0 {
            1.0 + x / level
        } else {
            y * y / (level * (level - x))
        };
        let gain = fast::pow(0.5 * open, m) * fast::pow(0.5 * (1.0 + level), n);
        (self.peak as f32 * gain).max(self.floor as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::super::mean_gain;
    use super::super::testing::{assert_fast_is_exact, towards};
    use super::*;

    fn widths(azimuth_deg: f64, elevation_deg: f64) -> [Angle; 2] {
        [azimuth_deg, elevation_deg].map(Angle::from_degrees)
    }

    fn lossless(azimuth_deg: f64, elevation_deg: f64) -> Cosine {
        let [azimuth, elevation] = widths(azimuth_deg, elevation_deg);
        Cosine::new(azimuth, elevation, Decibels::ZERO).unwrap()
    }

    #[test]
    fn half_the_power_is_left_at_half_the_beamwidth() {
        let antenna = lossless(65.0, 30.0);
        let peak = antenna.gain(DVec3::X);
        for (azimuth, elevation) in [(32.5, 0.0), (-32.5, 0.0), (0.0, 15.0), (0.0, -15.0)] {
            let below = peak - antenna.gain(towards(azimuth, elevation));
            assert!((below.db() - 3.0103).abs() < 1e-4, "{azimuth} {elevation}");
        }
    }

    #[test]
    fn it_has_the_values_of_the_formula() {
        // 120 degrees in azimuth, all elevations alike: ns-3's default. cos(30 deg) at the edge.
        let [azimuth, elevation] = widths(120.0, 360.0);
        let antenna = Cosine::with_peak(azimuth, elevation, Decibels::ZERO).unwrap();
        let exponent = math::ln(0.5) / (2.0 * math::ln(math::cos(PI / 6.0)));
        for degrees in [0.0, 20.0, 60.0, 90.0, 150.0] {
            let half = f64::to_radians(degrees / 2.0);
            let expected = 20.0 * exponent * math::log10(math::cos(half));
            for up in [0.0, 45.0, -80.0] {
                let gain = antenna.gain(towards(degrees, up)).db();
                assert!((gain - expected).abs() < 1e-9, "{degrees} {up}: {gain}");
            }
        }
        assert_eq!(antenna.gain(-DVec3::X).db().round(), -60.0);
    }

    #[test]
    fn without_loss_all_power_is_radiated() {
        for (azimuth, elevation) in [(120.0, 360.0), (65.0, 30.0), (360.0, 360.0), (20.0, 100.0)] {
            let mean = mean_gain(&lossless(azimuth, elevation));
            assert!((mean - 1.0).abs() < 2e-4, "{azimuth} {elevation}: {mean}");
        }
        let all_round = lossless(360.0, 360.0);
        assert!(all_round.gain(DVec3::Y).db().abs() < 1e-6);
    }

    #[test]
    fn the_fast_answer_is_the_exact_one() {
        assert_fast_is_exact(&lossless(120.0, 360.0), 2e-3);
        assert_fast_is_exact(&lossless(65.0, 30.0), 2e-3);
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        let [zero, wide] = widths(0.0, 361.0);
        let right = Angle::from_degrees(90.0);
        assert!(Cosine::new(zero, right, Decibels::ZERO).is_err());
        assert!(Cosine::new(right, wide, Decibels::ZERO).is_err());
        assert!(Cosine::new(right, right, Decibels::from_db(-1.0)).is_err());
        assert!(Cosine::with_peak(right, right, Decibels::from_db(f64::NAN)).is_err());
    }
}
