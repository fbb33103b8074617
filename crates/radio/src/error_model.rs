//! Error models: from signal-to-noise ratio to the chance that a frame survives.

use simbeeotic_units::{Decibels, math};
use std::fmt;

/// How well a receiver copes with noise.
pub trait ErrorModel: Send + Sync + fmt::Debug {
    /// Probability, 0 to 1, that a frame is received without error at this ratio of signal to noise
    /// (plus interference). Must not fall when `snr` grows.
    ///
    /// `frame_bytes` counts everything on the air: preamble, headers, payload, checksum.
    fn packet_success(&self, snr: Decibels, frame_bytes: usize) -> f64;

    /// Probability that one part of a frame survives, where `share` of the whole frame (0 to 1)
    /// is on the air at this ratio. Media with interference multiply the parts.
    ///
    /// As given, parts multiply to the whole: the success of the frame to the power of `share`.
    fn part_success(&self, snr: Decibels, frame_bytes: usize, share: f64) -> f64 {
        math::pow(self.packet_success(snr, frame_bytes), share)
    }

    /// Whether `frame_bytes` changes anything. A medium keeps one table for all lengths if not.
    fn depends_on_length(&self) -> bool {
        true
    }
}

/// The measured curve of the CC2420 as TOSSIM and the original Simbeeotic use it.
///
/// Symbol error `q = erfc(0.9794 (snr - 2.3851) / sqrt 2) / 2`, packet success `(1 - q)^46` with
/// `snr` in dB: a fixed 46 symbols, whatever the length of the frame.
///
/// Source: the original's CC2420 radio, which took it from TOSSIM's `CpmModelC`. Golden: 4 dB is
/// 0.068, 5 dB is 0.786, 6 dB is 0.991.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cc2420Curve;

impl ErrorModel for Cc2420Curve {
    fn packet_success(&self, snr: Decibels, _frame_bytes: usize) -> f64 {
        let x = 0.9794 * (snr.get() - 2.3851);
        let symbol_error = 0.5 * math::erfc(x * std::f64::consts::FRAC_1_SQRT_2);
        math::pow(1.0 - symbol_error, 46.0)
    }

    fn depends_on_length(&self) -> bool {
        false
    }
}

/// All or nothing: a frame is received if the signal is at least `margin` above the noise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Threshold {
    /// The least ratio at which frames are received.
    pub margin: Decibels,
}

impl ErrorModel for Threshold {
    fn packet_success(&self, snr: Decibels, _frame_bytes: usize) -> f64 {
        f64::from(u8::from(snr >= self.margin))
    }

    fn depends_on_length(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(snr_db: f64) -> f64 {
        Cc2420Curve.packet_success(Decibels::si(snr_db), 21)
    }

    #[test]
    fn cc2420_curve_has_the_values_of_the_original() {
        for (snr_db, expected) in [(3.0, 0.0), (4.0, 0.068), (5.0, 0.786), (6.0, 0.991)] {
            assert!(
                (curve(snr_db) - expected).abs() < 5e-4,
                "{snr_db} dB: {}",
                curve(snr_db)
            );
        }
        assert!((curve(7.0) - 0.9999).abs() < 5e-5, "{}", curve(7.0));
    }

    #[test]
    fn cc2420_curve_rises_from_zero_to_one() {
        let values: Vec<f64> = (-400..=600)
            .map(|tenths| curve(f64::from(tenths) / 10.0))
            .collect();
        assert!(values.is_sorted());
        assert_eq!(values[0], 0.0);
        assert_eq!(values[1000], 1.0);
    }

    #[test]
    fn parts_of_a_frame_multiply_to_the_whole() {
        let snr = Decibels::si(4.7);
        let parts: f64 = [0.2, 0.3, 0.5]
            .iter()
            .map(|&share| Cc2420Curve.part_success(snr, 21, share))
            .product();
        assert!((parts - curve(4.7)).abs() < 1e-12);
    }
}
