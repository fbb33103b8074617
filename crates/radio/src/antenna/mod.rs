//! Antennas: how much of the power goes which way.
//!
//! An [`Antenna`] answers twice: exactly ([`Antenna::gain`], f64, decibels; the definition and the
//! oracle of tests), and fast ([`Antenna::gain_linear`], f32, as a factor; what a medium asks twice
//! for each pair). Whoever writes a new one starts with `gain` alone and gets the other for free,
//! slowly.
//!
//! # Frame
//!
//! x is the boresight, y points left and z up as seen along it (FLU). A rod stands along z. The
//! antenna's frame is that of its mount (`RadioSpec::mount`), so an antenna turns with its body.
//! Azimuth is counted from x towards y, elevation from the xy plane towards z.
//!
//! # Gain and directivity
//!
//! What an antenna sends one way it does not send another: the mean of its gain over the sphere
//! ([`mean_gain`]) is the share of the power that it radiates at all, 1 for a lossless one. The
//! shapes here are directivities with mean 1, less a `loss` that says what cable, matching and the
//! antenna's own resistance take.
//!
//! | antenna | shape, lossless | greatest gain |
//! |---|---|---|
//! | [`Isotropic`] | the same everywhere | 0 dBi |
//! | [`ShortDipole`] | `sin^2` of the angle to the rod | 1.76 dBi |
//! | [`HalfWaveDipole`] | exact, nulls filled to a floor | 2.15 dBi |
//! | [`Patch`] | `cos^n` with two beamwidths and a back | 6 to 8 dBi |
//! | [`Cosine`] | ns-3's, two beamwidths | by its beamwidths |
//! | [`Pattern`] | a table, from a chamber or a field solver | by its table |
//!
//! # What is not modelled
//!
//! Polarisation: two rods at right angles to each other, broadside, hear each other here as if they were
//! parallel; in free space they would lose 20 dB or more, between walls and over ground some 5 to
//! 10 dB. Nor what the body does to the pattern (a table measured on the body has it), nor the phase.

mod cosine;
mod dipole;
mod isotropic;
mod patch;
pub mod pattern;

pub use cosine::Cosine;
pub use dipole::{HalfWaveDipole, ShortDipole};
pub use isotropic::Isotropic;
pub use patch::Patch;
pub use pattern::Pattern;

use crate::radio::RadioError;
use glam::{DVec3, Vec3};
use simbeeotic_units::{Angle, Decibels, math};
use std::f64::consts::TAU;
use std::fmt;

/// An antenna pattern. The same for sending and receiving (reciprocity).
pub trait Antenna: Send + Sync + fmt::Debug {
    /// Gain over an isotropic antenna towards `direction`.
    ///
    /// `direction` has length one and is given in the antenna's own frame: x is the boresight, y
    /// points left and z up as seen along it (FLU). A rod antenna stands along z.
    fn gain(&self, direction: DVec3) -> Decibels;

    /// The same as a factor of power, `10^(gain / 10)`, for a direction of length one to within an
    /// f32's rounding.
    ///
    /// Overwrite this where speed matters. May be off from [`gain`](Self::gain) by 0.001 dB, and by
    /// as much as the direction was rounded where the gain is steep. No platform mathematics: the
    /// same bits on every machine.
    fn gain_linear(&self, direction: Vec3) -> f32 {
        let direction = direction.as_dvec3().normalize_or(DVec3::X);
        self.gain(direction).ratio() as f32
    }

    /// The gain if it is the same in every direction, else `None`.
    ///
    /// A medium asks once and then spares itself the direction of every single link.
    fn uniform_gain(&self) -> Option<Decibels> {
        None
    }
}

/// The mean of an antenna's gain over the sphere, as a factor: the share of its power that it radiates.
/// 1 for a lossless antenna, never more for a real one.
///
/// By quadrature (400 by 400 points); good to 1e-4 for gains that do not jump.
#[must_use]
pub fn mean_gain(antenna: &dyn Antenna) -> f64 {
    const STEPS: u32 = 400;
    let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(STEPS);
    let mut sum = 0.0;
    for i in 0..STEPS {
        // Equal steps in z are equal areas of the sphere.
        let z = 2.0 * middle(i) - 1.0;
        let level = (1.0 - z * z).sqrt();
        for j in 0..STEPS {
            let (sin, cos) = math::sin_cos(TAU * middle(j));
            let direction = DVec3::new(level * cos, level * sin, z);
            sum += antenna.gain(direction).ratio();
        }
    }
    sum / f64::from(STEPS * STEPS)
}

/// Refuses a loss that is a gain, or no number.
fn check_loss(loss: Decibels) -> Result<(), RadioError> {
    if (0.0..=60.0).contains(&loss.db()) {
        return Ok(());
    }
    Err(RadioError::OutOfRange {
        what: "antenna loss",
        got: loss.to_string(),
        expected: "from 0 dB to 60 dB",
    })
}

/// An angle as people write it, to a millionth of a degree.
fn in_degrees(angle: Angle) -> String {
    format!("{} deg", (angle.degrees() * 1e6).round() / 1e6)
}

/// `loss` as a factor of power.
fn kept(loss: Decibels) -> f64 {
    (-loss).ratio()
}

#[cfg(test)]
mod testing {
    use super::*;
    use simbeeotic_kernel::Stream;

    /// Unit vectors all over, axes and near-axes included.
    pub(super) fn directions() -> Vec<DVec3> {
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let mut all: Vec<DVec3> = axes.iter().flat_map(|&axis| [axis, -axis]).collect();
        all.extend(
            axes.iter()
                .map(|&axis| (axis + DVec3::splat(1e-4)).normalize()),
        );
        let mut stream = Stream::new(1, "antenna", "directions");
        all.extend((0..3000).map(|_| stream.unit_vector()));
        all
    }

    /// Direction at these angles in degrees, towards left and up.
    pub(super) fn towards(azimuth_deg: f64, elevation_deg: f64) -> DVec3 {
        let (sin_az, cos_az) = math::sin_cos(azimuth_deg.to_radians());
        let (sin_el, cos_el) = math::sin_cos(elevation_deg.to_radians());
        DVec3::new(cos_el * cos_az, cos_el * sin_az, sin_el)
    }

    /// The fast answer is the exact one. `slack_db` is for where the gain is steep.
    #[track_caller]
    pub(super) fn assert_fast_is_exact(antenna: &dyn Antenna, slack_db: f64) {
        for direction in directions() {
            let exact = antenna.gain(direction).ratio();
            let fast = f64::from(antenna.gain_linear(direction.as_vec3()));
            let off_db = 10.0 * math::log10(fast / exact);
            assert!(
                off_db.abs() < slack_db,
                "{antenna:?} towards {direction}: {fast} for {exact}, {off_db} dB"
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::testing::assert_fast_is_exact;
    use super::*;

    /// A user's antenna, with the one method that it must have.
    #[derive(Debug)]
    struct Lopsided;

    impl Antenna for Lopsided {
        fn gain(&self, direction: DVec3) -> Decibels {
            Decibels::from_ratio(1.0 + 0.5 * direction.x)
        }
    }

    #[test]
    fn an_antenna_with_one_method_answers_all_questions() {
        assert_fast_is_exact(&Lopsided, 1e-5);
        assert!((mean_gain(&Lopsided) - 1.0).abs() < 1e-6);
        assert_eq!(Lopsided.uniform_gain(), None);
    }
}
