//! The chance of reception as a table over received power.
//!
//! The exact chance that a frame of power P survives noise N, drawn for each reception from a normal
//! distribution in dB, is the mean of the receiver's curve over the noise:
//!
//! ```text
//! success(P) = E[ curve(P - N) ],   N ~ Normal(mean, sigma)
//! ```
//!
//! Drawing N, then the survival, or drawing the survival from this mean, gives the same distribution
//! of receptions: draws of different receptions are independent, and N is seen by nobody else. So one
//! table replaces a logarithm, a normal draw and an error function for each pair.
//!
//! The table is indexed by the top bits of the power's own f32 representation: exponent and 7 bits
//! of mantissa, which is 128 steps an octave, 0.012 to 0.034 dB wide. Each slot holds the chance at
//! its middle, at most 0.017 dB off.

use crate::error_model::ErrorModel;
use crate::inbox::Receiver;
use simbeeotic_units::{Decibels, PowerLevel};
use std::sync::Arc;

/// Slots in a table: 64 octaves of 128 slots, 2^-52 mW to 2^12 mW (-156 to 36 dBm).
pub(super) const SLOTS: usize = 64 << STEP_BITS;

const STEP_BITS: u32 = 7;

/// Bits of an f32 below the step.
const REST_BITS: u32 = f32::MANTISSA_DIGITS - 1 - STEP_BITS;

/// The number of the first slot among all f32: biased exponent of 2^-52, mantissa 0.
const FIRST: u32 = (127 - 52) << STEP_BITS;

/// The least number that has a slot.
pub(super) const LEAST: f32 = f32::from_bits(FIRST << REST_BITS);

/// The largest f32 below 2^12.
const MOST_MW: f32 = 4096.0f32.next_down();

/// Chances of reception, as a draw of 32 bits must be below them.
pub(super) type Table = [u32; SLOTS];

/// The slot of a power. Below 2^-52 mW any slot; above 2^12 mW the last.
#[inline(always)]
pub(super) fn slot(power_mw: f32) -> u32 {
    let held = if power_mw < MOST_MW {
        power_mw
    } else {
        MOST_MW
    };
    (held.to_bits() >> REST_BITS).wrapping_sub(FIRST) & (SLOTS as u32 - 1)
}

/// The power in the middle of a slot, milliwatts.
pub(super) fn middle(slot: usize) -> f64 {
    let bits = (FIRST + slot as u32) << REST_BITS | 1 << (REST_BITS - 1);
    f64::from(f32::from_bits(bits))
}

/// The noise that each reception meets: normal in dB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Noise {
    pub(super) mean: PowerLevel,
    pub(super) sigma: Decibels,
}

/// One kind of receiver: an error model and its noise, with tables for the lengths that came up.
#[derive(Debug)]
pub(super) struct Curve {
    error: Arc<dyn ErrorModel>,
    noise: Noise,
    /// By index of length; a single one if the length does not matter.
    tables: Vec<Box<Table>>,
}

impl Curve {
    pub(super) fn new(error: Arc<dyn ErrorModel>, noise: Noise) -> Self {
        Self {
            error,
            noise,
            tables: Vec::new(),
        }
    }

    /// Whether this is the curve of that receiver.
    pub(super) fn is(&self, error: &Arc<dyn ErrorModel>, noise: Noise) -> bool {
        Arc::ptr_eq(&self.error, error) && self.noise == noise
    }

    /// What its owners measure packets against.
    pub(super) fn receiver(&self) -> Receiver<'_> {
        Receiver {
            noise: self.noise.mean,
            error: self.error.as_ref(),
        }
    }

    /// Makes the missing tables for frames of these lengths.
    pub(super) fn prepare(&mut self, frame_bytes: &[usize]) {
        let wanted = if self.error.depends_on_length() {
            frame_bytes.len()
        } else {
            1
        };
        for &bytes in frame_bytes.iter().take(wanted).skip(self.tables.len()) {
            self.tables
                .push(tabulate(self.error.as_ref(), self.noise, bytes));
        }
    }

    /// The table for frames of the length with this index. Prepared before.
    #[inline]
    pub(super) fn table(&self, length: u32) -> &Table {
        let index = if self.tables.len() == 1 {
            0
        } else {
            length as usize
        };
        &self.tables[index]
    }
}

fn tabulate(error: &dyn ErrorModel, noise: Noise, frame_bytes: usize) -> Box<Table> {
    let mean_dbm = noise.mean.dbm();
    let chance = Folded::new(error, noise.sigma.db(), frame_bytes);
    let table: Vec<u32> = (0..SLOTS)
        .map(|slot| {
            let power_dbm = PowerLevel::from_milliwatts(middle(slot)).dbm();
            // A chance of 1 becomes 1 - 2^-32.
            (chance.at(power_dbm - mean_dbm) * 4_294_967_296.0) as u32
        })
        .collect();
    table
        .into_boxed_slice()
        .try_into()
        .expect("a table has SLOTS slots")
}

/// Steps of the curve's own table, dB.
const CURVE_STEP_DB: f64 = 0.01;

/// Signal-to-noise ratios beyond which the curve is taken to be flat, dB.
const CURVE_DB: (f64, f64) = (-60.0, 80.0);

/// Half the width of the noise that is looked at, in sigmas. Beyond lie 2e-12 of all draws.
const TAIL: f64 = 7.0;

/// An error curve with the noise folded in.
struct Folded<'a> {
    error: &'a dyn ErrorModel,
    frame_bytes: usize,
    /// The curve every `CURVE_STEP_DB` from `CURVE_DB.0` on.
    curve: Vec<f64>,
    /// Deviations of the noise from its mean in dB, with weights that sum to 1. Empty: no noise.
    noise: Vec<(f64, f64)>,
    /// Ratios to the mean noise below which the chance is that of no signal, above which of all.
    low_db: f64,
    high_db: f64,
}

impl<'a> Folded<'a> {
    fn new(error: &'a dyn ErrorModel, sigma_db: f64, frame_bytes: usize) -> Self {
        let steps = ((CURVE_DB.1 - CURVE_DB.0) / CURVE_STEP_DB).round() as usize;
        let curve: Vec<f64> = (0..=steps)
            .map(|i| CURVE_DB.0 + i as f64 * CURVE_STEP_DB)
            .map(|snr_db| error.packet_success(Decibels::from_db(snr_db), frame_bytes))
            .collect();
        let noise = if sigma_db > 0.0 {
            normal_weights(sigma_db)
        } else {
            Vec::new()
        };

        // Where the curve leaves its first and reaches its last value, with room for the noise.
        let (first, last) = (curve[0], curve[steps]);
        let room_db = TAIL * sigma_db + CURVE_STEP_DB;
        let leaves = curve.iter().position(|&c| c != first).unwrap_or(0);
        let reaches = curve.iter().rposition(|&c| c != last).unwrap_or(steps);
        let at_db = |i: usize| CURVE_DB.0 + i as f64 * CURVE_STEP_DB;
        let (low_db, high_db) = (at_db(leaves) - room_db, at_db(reaches) + room_db);
        Self {
            error,
            frame_bytes,
            curve,
            noise,
            low_db,
            high_db,
        }
    }

    /// The chance at a ratio of signal to mean noise.
    fn at(&self, snr_db: f64) -> f64 {
        let chance = if self.noise.is_empty() {
            self.error
                .packet_success(Decibels::from_db(snr_db), self.frame_bytes)
        } else if snr_db <= self.low_db {
            self.curve[0]
        } else if snr_db >= self.high_db {
            self.curve[self.curve.len() - 1]
        } else {
            self.noise
                .iter()
                .map(|(above_db, weight)| weight * self.curve_at(snr_db - above_db))
                .sum()
        };
        chance.clamp(0.0, 1.0)
    }

    fn curve_at(&self, snr_db: f64) -> f64 {
        let last = self.curve.len() - 1;
        let place = ((snr_db - CURVE_DB.0) / CURVE_STEP_DB).clamp(0.0, last as f64);
        let below = (place as usize).min(last - 1);
        let share = place - below as f64;
        self.curve[below] + share * (self.curve[below + 1] - self.curve[below])
    }
}

/// The normal density on an even grid: the trapezoid rule, which is as good as exact for smooth
/// curves that do not change much within a step.
fn normal_weights(sigma_db: f64) -> Vec<(f64, f64)> {
    // Curves rise over a few dB: a fifth of a dB is fine enough for them.
    let steps = (TAIL * (sigma_db / 0.2).max(8.0)).ceil() as i32;
    let z = |i: i32| TAIL * f64::from(i) / f64::from(steps);
    let density = |i: i32| simbeeotic_units::math::exp(-0.5 * z(i) * z(i));
    let sum: f64 = (-steps..=steps).map(density).sum();
    (-steps..=steps)
        .map(|i| (sigma_db * z(i), density(i) / sum))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error_model::{Cc2420Curve, Threshold};
    use simbeeotic_units::math::normal_cdf;

    fn noise(sigma_db: f64) -> Noise {
        Noise {
            mean: PowerLevel::from_dbm(-100.0),
            sigma: Decibels::from_db(sigma_db),
        }
    }

    #[test]
    fn slots_are_narrower_than_0_035_db_and_in_order() {
        let mut previous = slot(1e-15);
        for step in 1..150_000 {
            let power_dbm = -150.0 + f64::from(step) * 0.001;
            let power_mw = PowerLevel::from_dbm(power_dbm).milliwatts() as f32;
            let slot = slot(power_mw);
            assert!(slot == previous || slot == previous + 1, "{power_dbm} dBm");
            let middle = PowerLevel::from_milliwatts(middle(slot as usize));
            assert!((middle.dbm() - power_dbm).abs() < 0.0175, "{power_dbm} dBm");
            previous = slot;
        }
        assert_eq!(slot(1e9), SLOTS as u32 - 1);
    }

    #[test]
    fn without_noise_the_table_is_the_curve() {
        let table = tabulate(&Cc2420Curve, noise(0.0), 21);
        for snr_db in [3.0, 4.0, 5.0, 6.0, 7.0, 30.0] {
            let power_mw = PowerLevel::from_dbm(snr_db - 100.0).milliwatts() as f32;
            let slot = slot(power_mw) as usize;
            let middle = PowerLevel::from_milliwatts(middle(slot)) - PowerLevel::from_dbm(-100.0);
            let chance = f64::from(table[slot]) / 4_294_967_296.0;
            assert!((chance - Cc2420Curve.packet_success(middle, 21)).abs() < 1e-9);
        }
    }

    #[test]
    fn noise_turns_a_step_into_the_normal_distribution() {
        let step = Threshold {
            margin: Decibels::from_db(7.0),
        };
        let folded = Folded::new(&step, 10.0, 21);
        for snr_db in [-30.0, -10.0, 0.0, 7.0, 12.0, 25.0, 60.0] {
            let expected = normal_cdf((snr_db - 7.0) / 10.0);
            assert!((folded.at(snr_db) - expected).abs() < 5e-3, "{snr_db} dB");
        }
    }

    #[test]
    fn folding_agrees_with_a_fine_sum() {
        let folded = Folded::new(&Cc2420Curve, 10.0, 21);
        for snr_db in [-25.0, -5.0, 4.5, 10.0, 20.0, 34.0] {
            let (mut sum, mut weights) = (0.0, 0.0);
            for i in -80_000..=80_000 {
                let z = f64::from(i) * 1e-4;
                let weight = simbeeotic_units::math::exp(-0.5 * z * z);
                weights += weight;
                sum +=
                    weight * Cc2420Curve.packet_success(Decibels::from_db(snr_db - 10.0 * z), 21);
            }
            let error = (folded.at(snr_db) - sum / weights).abs();
            assert!(error < 1e-7, "{snr_db} dB: off by {error}");
        }
    }
}
