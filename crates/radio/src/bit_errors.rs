//! Error models made of bits: modulations, and frames as many bits in a row.
//!
//! A [`BitErrors`] says how often a bit is wrong at a ratio of signal to noise; [`Bitwise`] makes an
//! [`ErrorModel`] of it, so that media without and with air time judge a radio alike.
//!
//! | modulation | bit error rate | 10^-3 at |
//! |---|---|---|
//! | [`OqpskDsss`](crate::phy::OqpskDsss) | IEEE 802.15.4, annex E | -0.9 dB |
//! | [`Gfsk`] | `exp(-x/2) / 2`, x = SNR B/R | x of 10.9 dB |
//! | [`Bpsk`] | `erfc(sqrt x) / 2` | x of 6.8 dB |
//! | [`Step`] | one half below a ratio, none from it on | there |

use crate::error_model::ErrorModel;
use crate::phy::BitErrors;
use simbeeotic_units::{Decibels, math};
use std::sync::Arc;

/// Gaussian frequency shift keying, received without knowing the phase: `exp(-x / 2) / 2` with
/// `x = Eb/N0`.
///
/// That is the textbook's orthogonal binary FSK. Real receivers (BT 0.5, index 0.32 to 0.5, a limiter)
/// need more signal; how much more is put into the receiver's noise, so that the bit error rate is the
/// data sheet's 10^-3 at the data sheet's sensitivity. The slope is that of the formula.
///
/// Source: Proakis, *Digital Communications*, 5.4 (textbook; not at hand).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gfsk {
    /// Noise bandwidth of the receiver over its bit rate: what makes Eb/N0 of a ratio of powers.
    pub bandwidth_over_rate: f64,
}

impl Gfsk {
    /// The ratio of signal to noise at which one bit in a thousand is wrong: `2 ln 500` over
    /// the bandwidth per bit, 10.94 dB for one hertz per bit a second.
    #[must_use]
    pub fn snr_at_per_mille(self) -> Decibels {
        Decibels::from_ratio(2.0 * math::ln(500.0) / self.bandwidth_over_rate)
    }
}

impl BitErrors for Gfsk {
    fn bit_error(&self, sinr: f64) -> f64 {
        0.5 * math::exp(-0.5 * sinr.max(0.0) * self.bandwidth_over_rate)
    }
}

/// Binary phase shift keying, received coherently: `erfc(sqrt x) / 2` with `x = Eb/N0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bpsk {
    /// Noise bandwidth of the receiver over its bit rate.
    pub bandwidth_over_rate: f64,
}

impl BitErrors for Bpsk {
    fn bit_error(&self, sinr: f64) -> f64 {
        0.5 * math::erfc((sinr.max(0.0) * self.bandwidth_over_rate).sqrt())
    }
}

/// All or nothing: no bit is wrong from a ratio of signal to noise on, each second one below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// The least ratio at which bits are right.
    pub margin: Decibels,
}

impl BitErrors for Step {
    fn bit_error(&self, sinr: f64) -> f64 {
        if sinr >= self.margin.ratio() {
            0.0
        } else {
            0.5
        }
    }
}

/// A frame is received if each of its bits is, one by one: no code that mends errors.
#[derive(Clone, Debug)]
pub struct Bitwise(pub Arc<dyn BitErrors>);

impl ErrorModel for Bitwise {
    fn packet_success(&self, snr: Decibels, frame_bytes: usize) -> f64 {
        let bits = 8.0 * frame_bytes as f64;
        self.0.success(snr.ratio(), bits).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::phy::OqpskDsss;

    #[test]
    fn each_modulation_has_a_bit_in_a_thousand_wrong_where_the_table_says() {
        let at = |bits: &dyn BitErrors, db: f64| bits.bit_error(Decibels::from_db(db).ratio());
        let gfsk = Gfsk {
            bandwidth_over_rate: 1.0,
        };
        let bpsk = Bpsk {
            bandwidth_over_rate: 1.0,
        };
        assert!((at(&gfsk, 10.944) - 1e-3).abs() < 1e-6);
        assert!((gfsk.snr_at_per_mille().db() - 10.944).abs() < 1e-3);
        assert!((at(&bpsk, 6.79) - 1e-3).abs() < 5e-6);
        assert!((at(&OqpskDsss, -0.92) - 1e-3).abs() < 1e-6);
    }

    #[test]
    fn twice_the_bandwidth_per_bit_is_3_db() {
        let one = Gfsk {
            bandwidth_over_rate: 1.0,
        };
        let two = Gfsk {
            bandwidth_over_rate: 2.0,
        };
        assert!((one.snr_at_per_mille() - two.snr_at_per_mille()).db() - 3.0103 < 1e-3);
        assert_eq!(one.bit_error(8.0), two.bit_error(4.0));
    }

    #[test]
    fn without_signal_a_bit_is_a_coin_toss_and_more_signal_never_hurts() {
        let models: [&dyn BitErrors; 3] = [
            &Gfsk {
                bandwidth_over_rate: 1.3,
            },
            &Bpsk {
                bandwidth_over_rate: 0.8,
            },
            &Step {
                margin: Decibels::from_db(-7.5),
            },
        ];
        for model in models {
            assert_eq!(model.bit_error(0.0), 0.5);
            let errors: Vec<f64> = (0..400)
                .map(|i| model.bit_error(f64::from(i) * 0.1))
                .collect();
            assert!(errors.is_sorted_by(|a, b| a >= b), "{model:?}");
        }
    }

    #[test]
    fn a_frame_is_its_bits() {
        // Table of packet success by ratio for 37 bytes of IEEE 802.15.4.
        let oqpsk = Bitwise(Arc::new(OqpskDsss));
        for (snr_db, chance) in [(-2.0, 0.214), (0.0, 0.953), (3.0, 1.0), (4.0, 1.0)] {
            let found = oqpsk.packet_success(Decibels::from_db(snr_db), 37);
            assert!((found - chance).abs() < 5e-4, "{snr_db} dB: {found}");
        }
        let step = Bitwise(Arc::new(Step {
            margin: Decibels::from_db(7.0),
        }));
        assert_eq!(step.packet_success(Decibels::from_db(7.1), 20), 1.0);
        assert!(step.packet_success(Decibels::from_db(6.9), 20) < 1e-40);
    }
}
