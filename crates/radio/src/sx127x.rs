//! The SX1276 to SX1279, Semtech's LoRa transceivers below 1 GHz.
//!
//! | number | value | source |
//! |---|---|---|
//! | symbol | `2^SF / BW` | datasheet, 4.1.1 |
//! | air time | [`Lora::airtime`] | datasheet, 4.1.1.7 |
//! | least ratio of signal to noise | -7.5 dB at SF 7, 2.5 dB less for each step, -20 dB at SF 12 | datasheet, table 13 |
//! | noise | `-174 dBm + 10 log10 BW + 6 dB` | Semtech's formula of sensitivity with a noise figure of 6 dB: -124.5 dBm at SF 7, -137 dBm at SF 12 with 125 kHz; the datasheet's table is quoted with -123 and -136 dBm, 1.5 and 1 dB worse |
//! | signal to interference of the same spreading factor | 6 dB | Goursaud and Gorce 2015, table of co-channel rejection, not at hand; Croce et al. 2018 measure about 1 dB |
//! | transmit | 20, 29, 87, 120 mA at 7, 13, 17, 20 dBm | datasheet, 2.5.1 |
//! | receive | 10.8, 11.5, 12.0 mA (125, 250, 500 kHz) | datasheet, 2.5.5 |
//! | idle (standby) | 1.6 mA | datasheet, 2.5.1 |
//! | sleep | 0.2 uA | datasheet, 2.5.1 |
//! | longest payload | 255 bytes | datasheet |
//! | error model | all frames above the least ratio, none below | the same |
//!
//! The datasheet was not at hand: the numbers are those commonly quoted from it. The `simple` medium does
//! not tell spreading factors apart: there, radios of different ones need different channels. With air
//! time, radios of different ones do not understand each other, but disturb each other as if their
//! signals were noise: a frame survives others of another factor that are stronger by its least ratio
//! (measured: 8 dB to 25 dB). A frame of the same factor must be [`CO_CHANNEL_DB`] stronger than the other
//! to survive it; where neither is, both are lost.

use crate::bit_errors::Step;
use crate::channel::Channel;
use crate::error_model::{ErrorModel, Threshold};
use crate::phy::{Access, BitErrors, LinkQuality, Phy, Spacing};
use crate::radio::{Currents, Framing, RadioSpec};
use simbeeotic_units::{Current, DataRate, Decibels, Frequency, PowerLevel, Time, math};
use std::sync::{Arc, LazyLock};

/// Output power in dBm and current in mA; between them the current is interpolated.
pub const LEVELS: [(f64, f64); 4] = [(7.0, 20.0), (13.0, 29.0), (17.0, 87.0), (20.0, 120.0)];

/// The weakest output, dBm; below [`LEVELS`] the current stays.
pub const POWER_DBM_MIN: f64 = 2.0;

/// By how much a frame must be stronger than others of its spreading factor, dB.
pub const CO_CHANNEL_DB: f64 = 6.0;

/// How LoRa spreads its symbols.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lora {
    /// Spreading factor, 7 to 12: bits a symbol.
    pub spreading_factor: u8,
    /// Bandwidth, hertz.
    pub bandwidth: Frequency,
    /// Code rate 4/5 to 4/8, as 5 to 8.
    pub code_rate: u8,
    /// Symbols of the preamble, without the 4.25 that the radio adds.
    pub preamble_symbols: u16,
}

impl Default for Lora {
    fn default() -> Self {
        Self {
            spreading_factor: 7,
            bandwidth: Frequency::si(125e3),
            code_rate: 5,
            preamble_symbols: 8,
        }
    }
}

impl Lora {
    /// How long a symbol is.
    #[must_use]
    pub fn symbol(&self) -> Time {
        Time::from_secs(f64::from(1u32 << self.spreading_factor) / self.bandwidth.get())
    }

    /// How long a payload of so many bytes is on the air, with explicit header and checksum:
    ///
    /// ```text
    /// n = 8 + max(0, ceil((8 PL - 4 SF + 28 + 16) / (4 (SF - 2 DE))) CR)
    /// T = (preamble + 4.25 + n) symbols
    /// ```
    /// DE is 1 (low data rate optimisation) for symbols longer than 16 ms, else 0.
    #[must_use]
    pub fn airtime(&self, payload_bytes: usize) -> Time {
        let factor = f64::from(self.spreading_factor);
        let slow = if self.symbol().secs() > 0.016 {
            1.0
        } else {
            0.0
        };
        let bits = 8.0 * payload_bytes as f64 - 4.0 * factor + 28.0 + 16.0;
        let blocks = (bits / (4.0 * (factor - 2.0 * slow))).ceil().max(0.0);
        let symbols = 8.0 + blocks * f64::from(self.code_rate);
        self.symbol() * (f64::from(self.preamble_symbols) + 4.25 + symbols)
    }

    /// The least ratio of signal to noise at which frames are received.
    #[must_use]
    pub fn least_snr(&self) -> Decibels {
        Decibels::from_db(-7.5 - 2.5 * (f64::from(self.spreading_factor) - 7.0))
    }

    /// Bits of payload a second: `SF (4 / CR) / symbol`.
    #[must_use]
    pub fn data_rate(&self) -> DataRate {
        let bits = f64::from(self.spreading_factor) * 4.0 / f64::from(self.code_rate);
        DataRate::si(bits / self.symbol().secs())
    }
}

/// An SX1276 at this centre frequency (137 MHz to 1020 MHz) and power (2 dBm to 20 dBm). `None` if it
/// does not have such a setting: SF 7 to 12, bandwidths of 125, 250 and 500 kHz, code rates 5 to 8,
/// preambles of 6 symbols or more.
#[must_use]
pub fn spec(centre: Frequency, power: PowerLevel, lora: Lora) -> Option<RadioSpec> {
    let rx_ma = match lora.bandwidth.get() {
        125e3 => 10.8,
        250e3 => 11.5,
        500e3 => 12.0,
        _ => return None,
    };
    let within = (7..=12).contains(&lora.spreading_factor)
        && (5..=8).contains(&lora.code_rate)
        && lora.preamble_symbols >= 6
        && (137e6..=1020e6).contains(&centre.get())
        && (POWER_DBM_MIN..=20.0).contains(&power.dbm());
    if !within {
        return None;
    }
    let noise = PowerLevel::from_dbm(-168.0 + 10.0 * math::log10(lora.bandwidth.get()));
    let (sensitivity, margin) = (noise + lora.least_snr(), lora.least_snr());
    let (error, bits) = models(lora.spreading_factor);
    let channel = Channel {
        centre,
        width: lora.bandwidth,
    };
    Some(RadioSpec {
        tx_power: power,
        sensitivity,
        noise_figure: noise - PowerLevel::from_dbm(-100.0),
        data_rate: lora.data_rate(),
        framing: Framing::Lora(lora),
        payload_bytes_max: 255,
        currents: Currents {
            tx: current(power.dbm()),
            rx: Current::from_milliamperes(rx_ma),
            idle: Current::from_milliamperes(1.6),
            sleep: Current::from_microamperes(0.2),
        },
        phy: Phy {
            noise,
            sensitivity: Some(sensitivity),
            lock: margin,
            co_channel: Decibels::from_db(CO_CHANNEL_DB) - margin,
            bits,
            quality: LinkQuality::Success,
            header_bytes: 0,
            access: Access::Aloha,
            acks: None,
            spacing: Spacing {
                short: Time::ZERO,
                long: Time::ZERO,
                short_bytes_max: 0,
            },
            ..Phy::ieee802154()
        },
        ..RadioSpec::new(channel, error)
    })
}

/// The error models of a spreading factor, 7 to 12: the same for all, so that radios understand each
/// other and media keep one table.
fn models(spreading_factor: u8) -> (Arc<dyn ErrorModel>, Arc<dyn BitErrors>) {
    type Models = (Arc<dyn ErrorModel>, Arc<dyn BitErrors>);
    static ALL: LazyLock<Vec<Models>> = LazyLock::new(|| {
        let models = |spreading_factor| {
            let lora = Lora {
                spreading_factor,
                ..Lora::default()
            };
            let margin = lora.least_snr();
            let error: Arc<dyn ErrorModel> = Arc::new(Threshold { margin });
            let bits: Arc<dyn BitErrors> = Arc::new(Step { margin });
            (error, bits)
        };
        (7..=12).map(models).collect()
    });
    ALL[usize::from(spreading_factor - 7)].clone()
}

fn current(dbm: f64) -> Current {
    let above = LEVELS.iter().position(|&(at, _)| at >= dbm);
    let (high, low) = match above {
        Some(0) => (LEVELS[0], LEVELS[0]),
        Some(at) => (LEVELS[at], LEVELS[at - 1]),
        None => (LEVELS[LEVELS.len() - 1], LEVELS[LEVELS.len() - 1]),
    };
    let share = if high.0 > low.0 {
        (dbm - low.0) / (high.0 - low.0)
    } else {
        0.0
    };
    Current::from_milliamperes(low.1 + share * (high.1 - low.1))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lora(spreading_factor: u8) -> Lora {
        Lora {
            spreading_factor,
            ..Lora::default()
        }
    }

    fn at(spreading_factor: u8) -> RadioSpec {
        let (centre, power) = (Frequency::si(868.1e6), PowerLevel::from_dbm(14.0));
        spec(centre, power, lora(spreading_factor)).unwrap()
    }

    #[test]
    fn air_times_are_those_of_the_formula() {
        // By hand: 125 kHz, 4/5, 8 symbols of preamble.
        let ms = |factor, bytes| lora(factor).airtime(bytes).secs() * 1e3;
        // SF 7: 8 * 20 - 28 + 44 = 176; / 28 = 6.29: 7 blocks.
        assert!((ms(7, 20) - 1.024 * (12.25 + 8.0 + 35.0)).abs() < 1e-9);
        // SF 12: 160 - 48 + 44 = 156; / (4 * 10) = 3.9: 4 blocks; symbols of 32.768 ms.
        assert!((ms(12, 20) - 32.768 * (12.25 + 8.0 + 20.0)).abs() < 1e-9);
        // SF 10 has symbols of 8.192 ms: not optimised. 160 - 40 + 44 = 164; / 40 = 4.1: 5 blocks.
        assert!((ms(10, 20) - 8.192 * (12.25 + 8.0 + 25.0)).abs() < 1e-9);
        // Nothing to send: 44 - 48 < 0.
        assert!((ms(12, 0) - 32.768 * 20.25).abs() < 1e-9);
        assert!((at(7).airtime(20).secs() * 1e3 - ms(7, 20)).abs() < 1e-12);
    }

    #[test]
    fn sensitivities_are_those_of_the_datasheet_within_a_decibel_or_two() {
        for (factor, dbm) in [
            (7, -123.0),
            (8, -126.0),
            (9, -129.0),
            (10, -132.0),
            (12, -136.0),
        ] {
            let found = at(factor).sensitivity.dbm();
            assert!((found - dbm).abs() < 2.1, "SF {factor}: {found}");
        }
    }

    #[test]
    fn a_step_of_the_spreading_factor_is_worth_two_and_a_half_decibels() {
        for factor in 7..12 {
            let step = at(factor).sensitivity - at(factor + 1).sensitivity;
            assert!((step.db() - 2.5).abs() < 1e-9);
            let error = at(factor).error;
            let least = lora(factor).least_snr();
            let (just, below) = (
                least + Decibels::from_db(0.1),
                least - Decibels::from_db(0.1),
            );
            assert_eq!(error.packet_success(just, 20), 1.0);
            assert_eq!(error.packet_success(below, 20), 0.0);
        }
    }

    #[test]
    fn radios_of_one_spreading_factor_understand_each_other() {
        assert!(Arc::ptr_eq(&at(9).phy.bits, &at(9).phy.bits));
        assert!(!Arc::ptr_eq(&at(9).phy.bits, &at(10).phy.bits));
        assert!(Arc::ptr_eq(&at(9).error, &at(9).error));
    }

    #[test]
    fn the_data_rate_is_that_of_the_datasheet() {
        // 5469 bit/s at SF 7, 293 bit/s at SF 12 with 125 kHz and 4/5.
        assert!((lora(7).data_rate().get() - 5468.75).abs() < 1e-9);
        assert!((lora(12).data_rate().get() - 292.968_75).abs() < 1e-9);
    }

    #[test]
    fn levels_draw_what_the_datasheet_says() {
        for (dbm, ma) in LEVELS {
            assert!((current(dbm).milliamperes() - ma).abs() < 1e-12);
        }
        assert!((current(15.0).milliamperes() - 58.0).abs() < 1e-12);
        assert!((current(2.0).milliamperes() - 20.0).abs() < 1e-12);
    }

    #[test]
    fn settings_that_it_does_not_have_are_refused() {
        let (centre, power) = (Frequency::si(868.1e6), PowerLevel::from_dbm(14.0));
        for bad in [
            lora(6),
            lora(13),
            Lora {
                code_rate: 4,
                ..lora(7)
            },
            Lora {
                bandwidth: Frequency::si(100e3),
                ..lora(7)
            },
            Lora {
                preamble_symbols: 5,
                ..lora(7)
            },
        ] {
            assert!(spec(centre, power, bad).is_none(), "{bad:?}");
        }
        assert!(spec(Frequency::si(2.4e9), power, lora(7)).is_none());
        assert!(spec(centre, PowerLevel::from_dbm(21.0), lora(7)).is_none());
        assert_eq!(at(9).check(), Ok(()));
    }
}
