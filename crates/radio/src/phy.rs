//! What a medium with air time asks of a radio: its receiver bit by bit, and its medium access.
//!
//! Media without air time and interference do not look at it. The presets are those of IEEE 802.15.4
//! in the 2.4 GHz band; a radio of another kind replaces what differs.
//!
//! | number | 802.15.4, 2.4 GHz | source |
//! |---|---|---|
//! | physical header | 6 bytes: preamble 4, start 1, length 1 | IEEE 802.15.4-2006, 6.3 |
//! | turnaround | 192 us, 12 symbols | `aTurnaroundTime` |
//! | clear channel assessment | 128 us, 8 symbols | IEEE 802.15.4-2006, 6.9.9 |
//! | unit of backoff | 320 us, 20 symbols | `aUnitBackoffPeriod` |
//! | exponents of backoff, number of backoffs | 3 to 5, 4 | `macMinBE`, `macMaxBE`, `macMaxCSMABackoffs` |
//! | retries, wait for the acknowledgement | 3, 864 us (54 symbols) | `macMaxFrameRetries`, `macAckWaitDuration` |
//! | spacing of frames | 192 us up to 18 bytes of MPDU, else 640 us | `macMinSIFSPeriod`, `macMinLIFSPeriod` |

use crate::radio::RadioError;
use simbeeotic_units::{Decibels, PowerLevel, Time, math};
use std::fmt;
use std::sync::{Arc, LazyLock};

/// How well a receiver tells bits from noise and interference.
pub trait BitErrors: Send + Sync + fmt::Debug {
    /// Probability, 0 to 1, that one bit is wrong at this linear ratio of signal to noise plus
    /// interference (0 or more). Must not grow with the ratio.
    fn bit_error(&self, sinr: f64) -> f64;

    /// Probability that `bits` bits in a row survive; need not be a whole number.
    fn success(&self, sinr: f64, bits: f64) -> f64 {
        math::exp(bits * math::ln_1p(-self.bit_error(sinr)))
    }

    /// What it is, numbers included: radios whose keys and data rates are equal understand each other.
    /// As given, what `Debug` writes.
    fn key(&self) -> String {
        format!("{self:?}")
    }
}

/// IEEE 802.15.4 at 2.4 GHz: offset QPSK, each 4 bits spread to one of 16 sequences of 32 chips.
///
/// ```text
/// BER = 8/15 * 1/16 * sum over k = 2..16 of (-1)^k C(16, k) exp(20 SINR (1/k - 1))
/// ```
///
/// Source: IEEE 802.15.4-2006, annex E.4.1.8; ns-3 3.37 takes the same. Golden: 37 bytes survive with
/// a chance of one half at -1.44 dB, with 0.99 at 0.65 dB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OqpskDsss;

impl BitErrors for OqpskDsss {
    fn bit_error(&self, sinr: f64) -> f64 {
        const BINOMIAL_16: [f64; 15] = [
            120.0, 560.0, 1820.0, 4368.0, 8008.0, 11440.0, 12870.0, 11440.0, 8008.0, 4368.0,
            1820.0, 560.0, 120.0, 16.0, 1.0,
        ];
        let terms = BINOMIAL_16.iter().zip(2u8..).map(|(binomial, k)| {
            let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
            sign * binomial * math::exp(20.0 * sinr * (1.0 / f64::from(k) - 1.0))
        });
        (8.0 / 15.0 / 16.0 * terms.sum::<f64>()).clamp(0.0, 1.0)
    }
}

/// A radio as a medium with air time sees it.
#[derive(Clone, Debug)]
pub struct Phy {
    /// Noise at the receiver's input that would do as much harm as all its own: noise figure included.
    pub noise: PowerLevel,
    /// The weakest frame that is taken up. `None`: only [`lock`](Self::lock) decides.
    pub sensitivity: Option<PowerLevel>,
    /// The least ratio of signal to noise plus interference at which a frame is taken up.
    pub lock: Decibels,
    /// By how much more than noise of its power a frame of the receiver's own modulation disturbs, 0 dB
    /// to 60 dB: 0 dB where interference is like noise. LoRa frames are heard far below the
    /// noise, but not below others of their spreading factor.
    pub co_channel: Decibels,
    /// Which bits survive. Radios understand each other if this has the same [key](BitErrors::key), and
    /// their data rates are equal.
    pub bits: Arc<dyn BitErrors>,
    /// What its packets' link quality tells.
    pub quality: LinkQuality,
    /// Bytes of preamble, start and length in each frame; counted in `RadioSpec::overhead_bytes`.
    pub header_bytes: usize,
    /// How it finds out whether the channel is free.
    pub cca: Cca,
    /// Time from receiving to sending and back; it is deaf meanwhile.
    pub turnaround: Time,
    /// When it may send.
    pub access: Access,
    /// How frames to somebody in particular are acknowledged; `None`: not at all.
    pub acks: Option<Acks>,
    /// Pauses after its frames.
    pub spacing: Spacing,
}

/// What the link quality of a packet tells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LinkQuality {
    /// 255 times the chance that the frame came through, as ns-3 has it.
    Success,
    /// The correlation of chips, as the CC2420 has it: 110 for the best frame (255), 50 for the worst
    /// (0). Modelled as 110 times the mean agreement of a coherent receiver's chips at the frame's
    /// mean SINR, `1 - erfc(sqrt SINR)`.
    ///
    /// Source: CC2420 datasheet SWRS041B, p. 49, for the range and the straight line between; the
    /// agreement is our own.
    #[default]
    Correlation,
}

impl LinkQuality {
    /// The link quality of a frame with this chance of survival and this mean linear SINR.
    #[must_use]
    pub fn of(self, success: f64, sinr: f64) -> u8 {
        let quality = match self {
            Self::Success => 255.0 * success,
            Self::Correlation => {
                let correlation = 110.0 * (1.0 - math::erfc(sinr.max(0.0).sqrt()));
                (correlation - 50.0) * 4.25
            }
        };
        // ns-3 cuts off; so does the datasheet's register.
        quality.clamp(0.0, 255.0) as u8
    }
}

/// Clear channel assessment: what makes the channel busy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cca {
    /// What it looks at.
    pub mode: CcaMode,
    /// The energy, mean over the window, from which on the channel is busy.
    pub threshold: PowerLevel,
    /// The length of the window.
    pub time: Time,
}

/// What clear channel assessment looks at. The numbers are those of IEEE 802.15.4.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CcaMode {
    /// Mode 1: the energy on the channel.
    Energy,
    /// Mode 2: whether a frame is being taken in.
    Carrier,
    /// Mode 3: busy if either says so.
    #[default]
    Both,
}

/// When a radio may send.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Access {
    /// When the channel has been found free, after a random wait.
    Csma(Csma),
    /// At once, whoever else is sending.
    Aloha,
}

/// Unslotted CSMA/CA: wait for 0 to 2^BE - 1 units, assess the channel, send if it is free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Csma {
    /// The unit of waiting.
    pub unit_backoff: Time,
    /// BE of the first attempt.
    pub min_be: u8,
    /// BE grows by one with each busy channel, up to here; at most 20.
    pub max_be: u8,
    /// How many more attempts follow the first before the frame is given up.
    pub max_backoffs: u8,
}

/// Acknowledgements of frames to somebody in particular.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acks {
    /// Bytes of an acknowledgement on the air, physical header included.
    pub bytes: usize,
    /// From the frame's end to the start of the acknowledgement; no less than the turnaround.
    pub delay: Time,
    /// How long the sender waits from the frame's end to the end of the acknowledgement.
    pub wait: Time,
    /// How often a frame is sent again.
    pub retries: u8,
}

/// Pauses of a sender after its own frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spacing {
    /// After short frames.
    pub short: Time,
    /// After longer ones.
    pub long: Time,
    /// The longest short frame: bytes without the physical header.
    pub short_bytes_max: usize,
}

impl Phy {
    /// A CC2420: noise of -95.5 dBm, so that 20 bytes of PSDU have 1 % errors at -95 dBm, which is
    /// its typical sensitivity; clear channel assessment by energy from -77 dBm on, or a frame.
    ///
    /// Source: datasheet SWRS041B (sensitivity; p. 50 for `CCA_THR` and mode 3), not at hand, as
    /// quoted by MansOS and Castalia; the noise follows from [`OqpskDsss`].
    #[must_use]
    pub fn cc2420() -> Self {
        Self {
            noise: PowerLevel::from_dbm(-95.5),
            sensitivity: Some(PowerLevel::from_dbm(-95.0)),
            cca: Cca {
                mode: CcaMode::Both,
                threshold: PowerLevel::from_dbm(-77.0),
                time: Time::from_micros(128.0),
            },
            ..Self::ieee802154()
        }
    }

    /// A radio as ns-3 3.37 has it in its lr-wpan module: thermal noise over 5 MHz at 290 K and no
    /// noise figure (-106.99 dBm), energy from 10 dB above -106.58 dBm on makes the channel busy, so
    /// does a frame; no sensitivity.
    #[must_use]
    pub fn ns3() -> Self {
        Self {
            noise: PowerLevel::from_dbm(-106.986_585),
            sensitivity: None,
            quality: LinkQuality::Success,
            cca: Cca {
                mode: CcaMode::Both,
                threshold: PowerLevel::from_dbm(-96.58),
                time: Time::from_micros(128.0),
            },
            ..Self::ieee802154()
        }
    }

    /// A good IEEE 802.15.4 radio of no particular make: noise of -101 dBm, 10 dB above thermal noise
    /// over 2 MHz (noise figure and losses of the demodulator), no other sensitivity; the channel
    /// is busy from -85 dBm on, the highest threshold that the standard allows for a radio with its
    /// least sensitivity of -85 dBm less 10 dB, or if a frame is being taken in.
    #[must_use]
    pub fn ieee802154() -> Self {
        // One model for all, so that they understand each other and media keep one table.
        static BITS: LazyLock<Arc<dyn BitErrors>> = LazyLock::new(|| Arc::new(OqpskDsss));

        let symbols = |count: f64| Time::from_micros(16.0 * count);
        Self {
            noise: PowerLevel::from_dbm(-101.0),
            sensitivity: None,
            lock: Decibels::from_db(-5.0),
            co_channel: Decibels::ZERO,
            bits: Arc::clone(&BITS),
            quality: LinkQuality::Correlation,
            header_bytes: 6,
            cca: Cca {
                mode: CcaMode::Both,
                threshold: PowerLevel::from_dbm(-85.0),
                time: symbols(8.0),
            },
            turnaround: symbols(12.0),
            access: Access::Csma(Csma {
                unit_backoff: symbols(20.0),
                min_be: 3,
                max_be: 5,
                max_backoffs: 4,
            }),
            acks: Some(Acks {
                bytes: 11,
                delay: symbols(12.0),
                wait: symbols(54.0),
                retries: 3,
            }),
            spacing: Spacing {
                short: symbols(12.0),
                long: symbols(40.0),
                short_bytes_max: 18,
            },
        }
    }

    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// The first that does not, see [`RadioError`].
    pub fn check(&self) -> Result<(), RadioError> {
        let number = |what, ok: bool, got: &dyn fmt::Display, expected| match ok {
            true => Ok(()),
            false => Err(RadioError::OutOfRange {
                what,
                got: got.to_string(),
                expected,
            }),
        };
        let level = |what, level: PowerLevel| {
            let ok = (-200.0..30.0).contains(&level.dbm());
            number(what, ok, &level, "from -200 dBm to 30 dBm")
        };
        level("receiver noise", self.noise)?;
        level(
            "sensitivity of the receiver",
            self.sensitivity.unwrap_or(self.noise),
        )?;
        level("threshold of a busy channel", self.cca.threshold)?;
        let lock = self.lock;
        number(
            "ratio to take up a frame",
            (-30.0..=30.0).contains(&lock.db()),
            &lock,
            "from -30 dB to 30 dB",
        )?;
        let more = self.co_channel;
        number(
            "harm of frames of one's own kind",
            (0.0..=60.0).contains(&more.db()),
            &more,
            "from 0 dB to 60 dB",
        )?;
        let mut times = vec![
            ("time of clear channel assessment", self.cca.time),
            ("turnaround", self.turnaround),
            ("spacing of short frames", self.spacing.short),
            ("spacing of long frames", self.spacing.long),
        ];
        if let Access::Csma(csma) = self.access {
            times.push(("unit of backoff", csma.unit_backoff));
            number(
                "exponent of backoff",
                csma.min_be <= csma.max_be && csma.max_be <= 20,
                &format!("{} to {}", csma.min_be, csma.max_be),
                "the least first, at most 20",
            )?;
        }
        if let Some(acks) = self.acks {
            times.push(("wait for the acknowledgement", acks.wait));
            number(
                "delay of the acknowledgement",
                acks.delay >= self.turnaround && acks.delay.secs() <= 1.0,
                &acks.delay,
                "no less than the turnaround, at most 1 s",
            )?;
        }
        for (what, time) in times {
            let ok = (0.0..=1.0).contains(&time.secs());
            number(what, ok, &time, "from 0 s to 1 s")?;
        }
        Ok(())
    }
}

impl Default for Phy {
    fn default() -> Self {
        Self::ieee802154()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn success(sinr_db: f64, bytes: f64) -> f64 {
        OqpskDsss.success(Decibels::from_db(sinr_db).ratio(), 8.0 * bytes)
    }

    #[test]
    fn frames_of_ieee802154_survive_as_published() {
        // Signal to noise at which frames of 20 to 133 bytes survive with a chance of 0.99.
        let table = [
            (20.0, 0.40),
            (26.0, 0.51),
            (37.0, 0.65),
            (67.0, 0.87),
            (117.0, 1.06),
            (133.0, 1.11),
        ];
        for (bytes, snr_db) in table {
            let chance = success(snr_db, bytes);
            assert!((chance - 0.99).abs() < 6e-4, "{bytes} bytes: {chance}");
        }
        assert!((success(-1.44, 37.0) - 0.5).abs() < 5e-3);
    }

    #[test]
    fn without_signal_a_bit_is_a_coin_toss() {
        assert!((OqpskDsss.bit_error(0.0) - 0.5).abs() < 1e-12);
        let errors: Vec<f64> = (0..2000)
            .map(|i| OqpskDsss.bit_error(f64::from(i) * 1e-3))
            .collect();
        assert!(errors.is_sorted_by(|a, b| a >= b));
        assert_eq!(OqpskDsss.bit_error(1e6), 0.0);
    }

    #[test]
    fn the_cc2420_loses_one_frame_in_a_hundred_at_its_sensitivity() {
        let phy = Phy::cc2420();
        let snr = phy.sensitivity.unwrap() - phy.noise;
        assert!((success(snr.db(), 26.0) - 0.99).abs() < 1e-3);
    }

    #[test]
    fn link_quality_goes_from_the_worst_to_the_best() {
        use LinkQuality::{Correlation, Success};
        assert_eq!((Success.of(1.0, 9.0), Success.of(0.5, 9.0)), (255, 127));
        assert_eq!(
            (Correlation.of(1.0, 10.0), Correlation.of(0.0, 0.0)),
            (254, 0)
        );
        let values: Vec<u8> = (0..400)
            .map(|i| Correlation.of(1.0, f64::from(i) * 0.01))
            .collect();
        assert!(values.is_sorted() && values[100] > 150);
    }

    #[test]
    fn presets_make_sense_and_nonsense_is_named() {
        for phy in [Phy::ieee802154(), Phy::cc2420(), Phy::ns3()] {
            assert_eq!(phy.check(), Ok(()));
        }
        let phy = Phy {
            turnaround: Time::si(-1.0),
            ..Phy::default()
        };
        assert_eq!(
            phy.check().unwrap_err().to_string(),
            "turnaround of -1 s: expected from 0 s to 1 s"
        );
    }
}
