//! A radio of no make: every number by a parameter.

use simbeeotic_model::check::{at_least_zero, in_range, positive};
use simbeeotic_model::radio::{
    Access, BitErrors, Bitwise, Bpsk, Cc2420Curve, Cca, Channel, Currents, ErrorModel, Gfsk,
    Logistic, Phy, RadioSpec, Step, Threshold, TossimCurve,
};
use simbeeotic_model::units::{Current, DataRate, Decibels, Frequency, PowerLevel};
use simbeeotic_model::{BuildError, Radio, choice, params, radio};
use std::sync::{Arc, Mutex, PoisonError};

/// A radio of no make, every number of which may be set. As it comes it is the original's: it hears
/// whatever is 7 dB above the noise.
///
/// Radios hear each other on equal channels: frequency and bandwidth both. The original's kept to 85 MHz
/// around 2442.5 MHz and heard all that was sent within; here it hears its like.
#[radio(
    "default-radio",
    java = "harvard.robobees.simbeeotic.model.comms.DefaultRadio"
)]
pub struct GenericRadio;

/// How a radio tells frames from noise.
#[choice]
#[derive(Default)]
pub enum ErrorCurve {
    /// All frames from `snr_margin` on, none below.
    #[default]
    Threshold,
    /// The CC2420's as the original had it; for 46 symbols, whatever the frame's length.
    Cc2420,
    /// TOSSIM's main line, the same with its own numbers.
    Tossim,
    /// A logistic curve: half of all frames at `snr_margin`, 1.5 per dB steep.
    Logistic,
    /// IEEE 802.15.4 at 2.4 GHz, bit by bit.
    Oqpsk,
    /// Frequency shift keying without phase, bit by bit.
    Gfsk,
    /// Binary phase shift keying, bit by bit.
    Bpsk,
}

/// When a radio sends.
#[choice]
#[derive(Default)]
pub enum AccessRule {
    /// When the channel is free, after a random wait, as IEEE 802.15.4.
    #[default]
    Csma,
    /// At once.
    Aloha,
}

/// Parameters of [`GenericRadio`].
#[params]
pub struct GenericRadioParams {
    /// Middle of the channel, 1 kHz to 10 THz.
    pub center_frequency: Frequency,
    /// Width of the channel.
    pub channel_bandwidth: Frequency,
    /// Power into the antenna.
    pub tx_power: PowerLevel,
    /// The weakest signal it notices, -150 dBm or more; as it stands the noise alone decides.
    pub sensitivity: PowerLevel,
    /// Noise above the channel's floor; with media that have air time: above -100 dBm.
    pub noise_figure: Decibels,
    /// Which frames survive the noise.
    pub error: ErrorCurve,
    /// Ratio of signal to noise of the `threshold` and `logistic` curves.
    pub snr_margin: Decibels,
    /// Hertz of noise bandwidth per bit a second, of `gfsk` and `bpsk`.
    pub bandwidth_per_bit: f64,
    /// Bits on the air per second.
    pub data_rate: DataRate,
    /// Bytes on the air besides the payload: preamble, headers, checksum.
    pub overhead_bytes: u16,
    /// The longest payload, bytes.
    pub payload_max: u16,
    /// What it draws while sending.
    pub tx_current: Current,
    /// While taking in a frame, or listening for one.
    pub rx_current: Current,
    /// While on and doing neither.
    pub idle_current: Current,
    /// While asleep.
    pub sleep_current: Current,
    /// When it sends, with media that have air time.
    pub access: AccessRule,
    /// The energy from which on a channel is busy, with media that have air time.
    pub cca_threshold: PowerLevel,
}

impl Default for GenericRadioParams {
    fn default() -> Self {
        Self {
            center_frequency: Frequency::si(2442.5e6),
            channel_bandwidth: Frequency::si(85e6),
            tx_power: PowerLevel::from_dbm(0.0),
            sensitivity: PowerLevel::from_dbm(-150.0),
            noise_figure: Decibels::ZERO,
            error: ErrorCurve::default(),
            snr_margin: Decibels::from_db(7.0),
            bandwidth_per_bit: 1.0,
            data_rate: DataRate::from_kilobits_per_second(250.0),
            overhead_bytes: 17,
            payload_max: 1000,
            tx_current: Current::from_milliamperes(12.0),
            rx_current: Current::from_milliamperes(15.0),
            idle_current: Current::from_milliamperes(0.5),
            sleep_current: Current::ZERO,
            access: AccessRule::default(),
            cca_threshold: PowerLevel::from_dbm(-77.0),
        }
    }
}

/// A curve for whole frames, and that for bits.
type Models = (Arc<dyn ErrorModel>, Arc<dyn BitErrors>);

/// What makes two curves the same: kind, margin, bandwidth.
type CurveKey = (ErrorCurve, u64, u64);

impl GenericRadioParams {
    /// The curve for whole frames, and that for bits where media ask for them: curves that know no bits
    /// lend them from IEEE 802.15.4. Equal ones are the same ones: such radios understand each other.
    fn errors(&self) -> Models {
        static KNOWN: Mutex<Vec<(CurveKey, Models)>> = Mutex::new(Vec::new());
        let (margin, bandwidth) = (self.snr_margin.get(), self.bandwidth_per_bit);
        let key = (self.error, margin.to_bits(), bandwidth.to_bits());
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, models)) = known.iter().find(|(other, _)| *other == key) {
            return models.clone();
        }
        let models = self.new_errors();
        known.push((key, models.clone()));
        models
    }

    fn new_errors(&self) -> Models {
        let bandwidth_over_rate = self.bandwidth_per_bit;
        let margin = self.snr_margin;
        let oqpsk = Phy::ieee802154().bits;
        let bitwise =
            |bits: Arc<dyn BitErrors>| -> Models { (Arc::new(Bitwise(Arc::clone(&bits))), bits) };
        match self.error {
            ErrorCurve::Threshold => (Arc::new(Threshold { margin }), Arc::new(Step { margin })),
            ErrorCurve::Cc2420 => (Arc::new(Cc2420Curve), oqpsk),
            ErrorCurve::Tossim => (Arc::new(TossimCurve), oqpsk),
            ErrorCurve::Logistic => {
                let curve = Logistic {
                    middle: margin,
                    ..Logistic::default()
                };
                (Arc::new(curve), oqpsk)
            }
            ErrorCurve::Oqpsk => bitwise(oqpsk),
            ErrorCurve::Gfsk => bitwise(Arc::new(Gfsk {
                bandwidth_over_rate,
            })),
            ErrorCurve::Bpsk => bitwise(Arc::new(Bpsk {
                bandwidth_over_rate,
            })),
        }
    }
}

impl Radio for GenericRadio {
    type Params = GenericRadioParams;

    fn spec(params: GenericRadioParams) -> Result<RadioSpec, BuildError> {
        let hz = Frequency::si;
        in_range(
            "center_frequency",
            params.center_frequency,
            hz(1e3)..=hz(1e13),
        )?;
        positive("channel_bandwidth", params.channel_bandwidth)?;
        let dbm = PowerLevel::from_dbm;
        in_range("tx_power", params.tx_power, dbm(-200.0)..=dbm(79.0))?;
        in_range("sensitivity", params.sensitivity, dbm(-150.0)..=dbm(29.0))?;
        in_range(
            "cca_threshold",
            params.cca_threshold,
            dbm(-200.0)..=dbm(29.0),
        )?;
        let db = Decibels::from_db;
        in_range("noise_figure", params.noise_figure, db(-50.0)..=db(100.0))?;
        in_range("snr_margin", params.snr_margin, db(-50.0)..=db(100.0))?;
        in_range("bandwidth_per_bit", params.bandwidth_per_bit, 0.01..=1000.0)?;
        positive("data_rate", params.data_rate)?;
        for (key, current) in [
            ("tx_current", params.tx_current),
            ("rx_current", params.rx_current),
            ("idle_current", params.idle_current),
            ("sleep_current", params.sleep_current),
        ] {
            at_least_zero(key, current)?;
        }
        let (error, bits) = params.errors();
        let channel = Channel {
            centre: params.center_frequency,
            width: params.channel_bandwidth,
        };
        let ieee = Phy::ieee802154();
        let overhead_bytes = usize::from(params.overhead_bytes);
        let phy = Phy {
            noise: dbm(-100.0) + params.noise_figure,
            sensitivity: Some(params.sensitivity),
            bits,
            header_bytes: ieee.header_bytes.min(overhead_bytes),
            cca: Cca {
                threshold: params.cca_threshold,
                ..ieee.cca
            },
            access: match (params.access, ieee.access) {
                (AccessRule::Csma, Access::Csma(csma)) => Access::Csma(csma),
                _ => Access::Aloha,
            },
            ..ieee
        };
        Ok(RadioSpec {
            tx_power: params.tx_power,
            sensitivity: params.sensitivity,
            noise_figure: params.noise_figure,
            data_rate: params.data_rate,
            overhead_bytes,
            payload_bytes_max: usize::from(params.payload_max),
            currents: Currents {
                tx: params.tx_current,
                rx: params.rx_current,
                idle: params.idle_current,
                sleep: params.sleep_current,
            },
            phy,
            ..RadioSpec::new(channel, error)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(params: GenericRadioParams) -> RadioSpec {
        let spec = GenericRadio::spec(params).unwrap();
        assert_eq!(spec.check(), Ok(()));
        spec
    }

    #[test]
    fn as_it_comes_it_is_the_original_s() {
        let radio = spec(GenericRadioParams::default());
        let received = |db| radio.error.packet_success(Decibels::from_db(db), 21);
        assert_eq!((received(7.0), received(6.9)), (1.0, 0.0));
        assert_eq!(radio.channel.centre.get(), 2442.5e6);
        assert!((radio.currents.tx.milliamperes() - 12.0).abs() < 1e-12);
    }

    #[test]
    fn its_air_time_is_not_a_hundred_and_twenty_five_times_too_short() {
        // The original took kbit/s for bytes a second, and then for kbit/s again.
        let radio = spec(GenericRadioParams {
            overhead_bytes: 0,
            ..GenericRadioParams::default()
        });
        assert!((radio.airtime(4).secs() - 128e-6).abs() < 1e-12);
        let charge_mas = radio.currents.tx.milliamperes() * radio.airtime(4).secs();
        assert!((charge_mas - 1.536e-3).abs() < 1e-9);
    }

    #[test]
    fn every_curve_can_be_chosen() {
        for (error, bytes, snr_db, chance) in [
            (ErrorCurve::Threshold, 37, 8.0, 1.0),
            (ErrorCurve::Cc2420, 37, 5.0, 0.786),
            (ErrorCurve::Tossim, 37, 5.0, 0.392),
            (ErrorCurve::Logistic, 37, 7.0, 0.5),
            (ErrorCurve::Oqpsk, 37, 0.0, 0.953),
            // (1 - 1/1000)^80.
            (ErrorCurve::Gfsk, 10, 10.944, 0.923),
            (ErrorCurve::Bpsk, 10, 6.79, 0.923),
        ] {
            let radio = spec(GenericRadioParams {
                error,
                ..GenericRadioParams::default()
            });
            let found = radio.error.packet_success(Decibels::from_db(snr_db), bytes);
            assert!((found - chance).abs() < 1e-3, "{error:?}: {found}");
        }
    }

    #[test]
    fn equal_radios_of_two_entries_understand_each_other() {
        let bits = |error, margin_db| {
            let params = GenericRadioParams {
                error,
                snr_margin: Decibels::from_db(margin_db),
                ..GenericRadioParams::default()
            };
            spec(params).phy.bits
        };
        let gfsk = bits(ErrorCurve::Gfsk, 7.0);
        assert!(Arc::ptr_eq(&gfsk, &bits(ErrorCurve::Gfsk, 7.0)));
        assert!(!Arc::ptr_eq(&gfsk, &bits(ErrorCurve::Bpsk, 7.0)));
        let oqpsk = bits(ErrorCurve::Oqpsk, 3.0);
        assert!(Arc::ptr_eq(&oqpsk, &Phy::ieee802154().bits));
    }

    #[test]
    fn numbers_that_make_no_sense_are_refused_by_name() {
        let good = GenericRadioParams::default;
        for (key, params) in [
            (
                "center_frequency",
                GenericRadioParams {
                    center_frequency: Frequency::ZERO,
                    ..good()
                },
            ),
            (
                "channel_bandwidth",
                GenericRadioParams {
                    channel_bandwidth: Frequency::ZERO,
                    ..good()
                },
            ),
            (
                "tx_power",
                GenericRadioParams {
                    tx_power: PowerLevel::from_dbm(90.0),
                    ..good()
                },
            ),
            (
                "sensitivity",
                GenericRadioParams {
                    sensitivity: PowerLevel::from_dbm(-151.0),
                    ..good()
                },
            ),
            (
                "data_rate",
                GenericRadioParams {
                    data_rate: DataRate::si(0.0),
                    ..good()
                },
            ),
            (
                "rx_current",
                GenericRadioParams {
                    rx_current: Current::si(-1.0),
                    ..good()
                },
            ),
            (
                "bandwidth_per_bit",
                GenericRadioParams {
                    bandwidth_per_bit: 0.0,
                    ..good()
                },
            ),
        ] {
            let fault = GenericRadio::spec(params).expect_err(key).to_string();
            assert!(fault.contains(key), "{fault}");
        }
    }

    #[test]
    fn it_may_send_without_listening() {
        let radio = spec(GenericRadioParams {
            access: AccessRule::Aloha,
            overhead_bytes: 2,
            ..GenericRadioParams::default()
        });
        assert_eq!(
            (radio.phy.access, radio.phy.header_bytes),
            (Access::Aloha, 2)
        );
        let polite = spec(GenericRadioParams::default());
        assert!(matches!(polite.phy.access, Access::Csma(_)));
    }
}
