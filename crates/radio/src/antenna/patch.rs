//! A patch: one side of a board.
//!
//! ```text
//! f(t, p) = b + (1 - b) cos^n t      in front, b behind;  b = 1 / front-to-back ratio
//! n = nE cos^2 p + nH sin^2 p
//! ```
//! t is the angle to the boresight, p that around it, from the E plane (xz). `nE` and `nH` are such
//! that `f` is one half at half the beamwidth in each plane. The mean of `f` over the sphere has a
//! closed form, and the directivity at boresight is one over it:
//!
//! ```text
//! mean = b + (1 - b) / (2 sqrt((nE + 1) (nH + 1)))
//! ```
//! This is a shape with the beamwidths of a data sheet, not a field solution: no side lobes, a back
//! that is the same everywhere. With a table of the real one, use [`Pattern`](super::Pattern).

use super::{Antenna, kept};
use crate::fast;
use crate::radio::RadioError;
use glam::{DVec3, Vec3};
use simbeeotic_units::{Angle, Decibels, math};

/// A patch antenna, boresight along x, E plane (that of its polarisation) xz, H plane xy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// `nE` and `nH`.
    exponents: [f64; 2],
    /// `b`.
    back: f64,
    /// Directivity at boresight, less the losses.
    peak: f64,
}

impl Default for Patch {
    /// A patch on a small board: beamwidths of 90 and 80 degrees, 15 dB front to back, 1 dB of loss;
    /// 6.6 dBi.
    fn default() -> Self {
        let made = Self::new(
            Angle::from_degrees(90.0),
            Angle::from_degrees(80.0),
            Decibels::from_db(15.0),
            Decibels::from_db(1.0),
        );
        made.expect("these numbers are in range")
    }
}

impl Patch {
    /// A patch with these widths between the half-power points in the E and H plane (5 to 175
    /// degrees), this ratio of boresight to back (6 dB to 60 dB), and this loss (0 dB to 60 dB).
    ///
    /// # Errors
    /// A number is out of range.
    pub fn new(
        e_plane: Angle,
        h_plane: Angle,
        front_to_back: Decibels,
        loss: Decibels,
    ) -> Result<Self, RadioError> {
        super::check_loss(loss)?;
        for (what, width) in [
            ("beamwidth in the E plane", e_plane),
            ("beamwidth in the H plane", h_plane),
        ] {
            if !(5.0..=175.0).contains(&width.degrees()) {
                return Err(RadioError::OutOfRange {
                    what,
                    got: super::in_degrees(width),
                    expected: "from 5 deg to 175 deg",
                });
            }
        }
        if !(6.0..=60.0).contains(&front_to_back.db()) {
            return Err(RadioError::OutOfRange {
                what: "front-to-back ratio",
                got: front_to_back.to_string(),
                expected: "from 6 dB to 60 dB",
            });
        }
        let back = kept(front_to_back);
        // b + (1 - b) c^n = 1/2 at half the beamwidth.
        let half = math::ln((0.5 - back) / (1.0 - back));
        let exponents = [e_plane, h_plane].map(|width| half / math::ln((width * 0.5).cos()));
        let [e, h] = exponents;
        let mean = back + (1.0 - back) * 0.5 / ((e + 1.0) * (h + 1.0)).sqrt();
        Ok(Self {
            exponents,
            back,
            peak: kept(loss) / mean,
        })
    }

    /// `n` off the boresight, where the direction is `z` along the E plane and `y` along the H plane.
    fn exponent(&self, y2: f64, z2: f64) -> f64 {
        let [e, h] = self.exponents;
        let off = y2 + z2;
        if off > 0.0 {
            (e * z2 + h * y2) / off
        } else {
            e
        }
    }
}

impl Antenna for Patch {
    fn gain(&self, direction: DVec3) -> Decibels {
        let DVec3 { x, y, z } = direction;
        let front = if x > 0.0 {
            math::pow(x, self.exponent(y * y, z * z))
        } else {
            0.0
        };
        Decibels::from_ratio(self.peak * (self.back + (1.0 - self.back) * front))
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        let Vec3 { x, y, z } = direction;
        let [e, h] = self.exponents.map(|n| n as f32);
        let (y2, z2) = (y * y, z * z);
        let off = y2 + z2;
        let n = if off > f32::MIN_POSITIVE {
            (e * z2 + h * y2) / off
        } else {
            e
        };
        let back = self.back as f32;
        self.peak as f32 * (back + (1.0 - back) * fast::pow(x, n))
    }
}

#[cfg(test)]
mod tests {
    use super::super::mean_gain;
    use super::super::testing::{assert_fast_is_exact, towards};
    use super::*;

    fn patch(e_deg: f64, h_deg: f64, front_to_back_db: f64, loss_db: f64) -> Patch {
        let degrees = Angle::from_degrees;
        Patch::new(
            degrees(e_deg),
            degrees(h_deg),
            Decibels::from_db(front_to_back_db),
            Decibels::from_db(loss_db),
        )
        .unwrap()
    }

    #[test]
    fn the_usual_patch_has_six_to_seven_dbi() {
        let peak = Patch::default().gain(DVec3::X).db();
        assert!((6.0..7.0).contains(&peak), "{peak}");
    }

    #[test]
    fn half_the_power_is_left_at_half_the_beamwidth_in_both_planes() {
        let antenna = patch(100.0, 60.0, 15.0, 0.0);
        let below = |azimuth, elevation| {
            (antenna.gain(DVec3::X) - antenna.gain(towards(azimuth, elevation))).db()
        };
        for (azimuth, elevation) in [(30.0, 0.0), (-30.0, 0.0), (0.0, 50.0), (0.0, -50.0)] {
            let db = below(azimuth, elevation);
            assert!((db - 3.0103).abs() < 1e-4, "{azimuth} {elevation}: {db}");
        }
        for back in [towards(180.0, 0.0), towards(91.0, 0.0), -DVec3::Z] {
            assert!(((antenna.gain(DVec3::X) - antenna.gain(back)).db() - 15.0).abs() < 1e-9);
        }
    }

    #[test]
    fn cosine_squared_without_a_back_is_the_closed_form() {
        // D = 2 (n + 1) for cos^n; n = 2 has half its power at 45 degrees.
        let antenna = patch(90.0, 90.0, 60.0, 0.0);
        assert!((antenna.gain(DVec3::X).ratio() - 6.0).abs() < 1e-4);
    }

    #[test]
    fn without_loss_all_power_is_radiated() {
        for antenna in [
            patch(90.0, 80.0, 15.0, 0.0),
            patch(160.0, 20.0, 6.0, 0.0),
            patch(40.0, 120.0, 30.0, 0.0),
        ] {
            let mean = mean_gain(&antenna);
            assert!((mean - 1.0).abs() < 2e-4, "{antenna:?}: {mean}");
        }
        assert!((mean_gain(&Patch::default()) - 0.794_328).abs() < 2e-4);
    }

    #[test]
    fn the_fast_answer_is_the_exact_one() {
        assert_fast_is_exact(&Patch::default(), 1e-3);
        assert_fast_is_exact(&patch(20.0, 150.0, 25.0, 0.0), 1e-3);
    }

    #[test]
    fn numbers_out_of_range_are_refused() {
        let refused = |e: f64, h: f64, fb: f64, loss: f64| {
            let degrees = Angle::from_degrees;
            let made = Patch::new(
                degrees(e),
                degrees(h),
                Decibels::from_db(fb),
                Decibels::from_db(loss),
            );
            made.unwrap_err().to_string()
        };
        assert!(refused(180.0, 80.0, 15.0, 0.0).contains("E plane"));
        assert!(refused(90.0, 4.0, 15.0, 0.0).contains("H plane"));
        assert!(refused(90.0, 80.0, 3.0, 0.0).contains("front-to-back"));
        assert!(refused(90.0, 80.0, 15.0, f64::NAN).contains("loss"));
    }
}
