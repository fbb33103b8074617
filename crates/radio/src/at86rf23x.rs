//! The AT86RF230 and AT86RF233, Atmel's (now Microchip's) 2.4 GHz IEEE 802.15.4 transceivers.
//!
//! | number | AT86RF230 | AT86RF233 | source |
//! |---|---|---|---|
//! | data rate | 250 kbit/s | 250 kbit/s | IEEE 802.15.4 |
//! | frame overhead | 17 bytes | 17 bytes | as [`cc2420`] |
//! | power levels (`TX_PWR`) | [`RF230_LEVELS`] | [`RF233_LEVELS`] | datasheets 5131 and 8351; RF230's also the original Simbeeotic |
//! | transmit | 16.5 mA at 3 dBm, 9.5 mA at -17.2 dBm | 13.8 mA at 4 dBm, 11.8 mA at 0 dBm, 7.2 mA at -17 dBm | datasheets; the original Simbeeotic |
//! | receive | 15.5 mA | 11.8 mA | datasheets |
//! | idle (`TRX_OFF`) | 1.5 mA | 0.3 mA | datasheets |
//! | sleep | 0.02 uA | 0.02 uA (`DEEP_SLEEP`) | datasheets |
//! | sensitivity | -101 dBm | -101 dBm | datasheets: 20 bytes of PSDU, 1 % errors |
//! | noise | -101.51 dBm | -101.51 dBm | from the sensitivity, with [`OqpskDsss`] |
//! | busy channel | energy, from -77 dBm on | energy, from -80 dBm on | `CCA_ED_THRES` 7: base -91 (-94) dBm and 2 dB a step |
//! | error model | [`OqpskDsss`], bit by bit | the same | IEEE 802.15.4 |
//!
//! The datasheets were not at hand: the numbers are those commonly quoted from them. Currents between
//! the power levels that the datasheets give are interpolated linearly in dBm. The original took all
//! frames above the sensitivity for received.

use crate::bit_errors::Bitwise;
use crate::cc2420;
use crate::channel::Channel;
use crate::error_model::ErrorModel;
use crate::phy::{Cca, CcaMode, OqpskDsss, Phy};
use crate::radio::{Currents, RadioSpec};
use simbeeotic_units::{Current, PowerLevel, Time};
use std::sync::{Arc, LazyLock};

/// Output power of the AT86RF230 by `TX_PWR`, 0 to 15, dBm.
pub const RF230_LEVELS: [f64; 16] = [
    3.0, 2.6, 2.1, 1.6, 1.1, 0.5, -0.2, -1.2, -2.2, -3.2, -4.2, -5.2, -7.2, -9.2, -12.2, -17.2,
];

/// Output power of the AT86RF233 by `TX_PWR`, 0 to 15, dBm.
pub const RF233_LEVELS: [f64; 16] = [
    4.0, 3.7, 3.4, 3.0, 2.5, 2.0, 1.0, 0.0, -1.0, -2.0, -3.0, -4.0, -6.0, -8.0, -12.0, -17.0,
];

/// Transmit currents that the datasheets give: dBm, mA, falling.
const RF230_CURRENTS: [(f64, f64); 2] = [(3.0, 16.5), (-17.2, 9.5)];
const RF233_CURRENTS: [(f64, f64); 3] = [(4.0, 13.8), (0.0, 11.8), (-17.0, 7.2)];

/// How much more than the noise a frame of 26 bytes needs to be lost once in a hundred times, dB.
const SNR_AT_SENSITIVITY_DB: f64 = 0.51;

const SENSITIVITY_DBM: f64 = -101.0;

/// An AT86RF230 on an IEEE 802.15.4 channel (11 to 26) at a power level (`TX_PWR`, 0 to 15; 0 is the
/// strongest). `None` if it has no such channel or level.
#[must_use]
pub fn rf230(channel: u8, level: u8) -> Option<RadioSpec> {
    let dbm = *RF230_LEVELS.get(usize::from(level))?;
    let currents = Currents {
        tx: between(&RF230_CURRENTS, dbm),
        rx: Current::from_milliamperes(15.5),
        idle: Current::from_milliamperes(1.5),
        sleep: Current::from_microamperes(0.02),
    };
    spec(channel, dbm, currents, -77.0)
}

/// An AT86RF233 on an IEEE 802.15.4 channel (11 to 26) at a power level (`TX_PWR`, 0 to 15; 0 is the
/// strongest). `None` if it has no such channel or level.
#[must_use]
pub fn rf233(channel: u8, level: u8) -> Option<RadioSpec> {
    let dbm = *RF233_LEVELS.get(usize::from(level))?;
    let currents = Currents {
        tx: between(&RF233_CURRENTS, dbm),
        rx: Current::from_milliamperes(11.8),
        idle: Current::from_milliamperes(0.3),
        sleep: Current::from_microamperes(0.02),
    };
    spec(channel, dbm, currents, -80.0)
}

/// The current at a power, on the line between the two next in a falling table.
fn between(table: &[(f64, f64)], dbm: f64) -> Current {
    let above = table.iter().rposition(|&(at, _)| at >= dbm).unwrap_or(0);
    let (high, low) = (table[above], table[(above + 1).min(table.len() - 1)]);
    let share = if high.0 > low.0 {
        (high.0 - dbm) / (high.0 - low.0)
    } else {
        0.0
    };
    Current::from_milliamperes(high.1 + share * (low.1 - high.1))
}

fn spec(channel: u8, dbm: f64, currents: Currents, busy_dbm: f64) -> Option<RadioSpec> {
    // One model for all, so that media keep one table.
    static ERROR: LazyLock<Arc<dyn ErrorModel>> =
        LazyLock::new(|| Arc::new(Bitwise(Arc::new(OqpskDsss))));

    let noise = PowerLevel::from_dbm(SENSITIVITY_DBM - SNR_AT_SENSITIVITY_DB);
    let sensitivity = PowerLevel::from_dbm(SENSITIVITY_DBM);
    Some(RadioSpec {
        tx_power: PowerLevel::from_dbm(dbm),
        sensitivity,
        noise_figure: noise - PowerLevel::from_dbm(-100.0),
        overhead_bytes: cc2420::OVERHEAD_BYTES,
        payload_bytes_max: cc2420::PAYLOAD_BYTES_MAX,
        currents,
        phy: Phy {
            noise,
            sensitivity: Some(sensitivity),
            cca: Cca {
                mode: CcaMode::Energy,
                threshold: PowerLevel::from_dbm(busy_dbm),
                time: Time::from_micros(128.0),
            },
            ..Phy::ieee802154()
        },
        ..RadioSpec::new(Channel::ieee802154(channel)?, Arc::clone(&ERROR))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rf230_has_the_levels_and_currents_of_the_original() {
        let levels: Vec<f64> = (0..16)
            .map(|level| rf230(11, level).unwrap().tx_power.dbm())
            .collect();
        assert_eq!(levels, RF230_LEVELS);
        for (level, ma) in [(0, 16.5), (15, 9.5)] {
            let tx = rf230(11, level).unwrap().currents.tx.milliamperes();
            assert!((tx - ma).abs() < 1e-12, "level {level}: {tx} mA");
        }
        let currents = rf230(11, 0).unwrap().currents;
        assert!((currents.rx.milliamperes() - 15.5).abs() < 1e-12);
        assert!((currents.idle.milliamperes() - 1.5).abs() < 1e-12);
    }

    #[test]
    fn the_rf233_draws_what_its_datasheet_says() {
        for (level, dbm, ma) in [(0, 4.0, 13.8), (7, 0.0, 11.8), (15, -17.0, 7.2)] {
            let spec = rf233(26, level).unwrap();
            assert_eq!(spec.tx_power.dbm(), dbm);
            assert!(
                (spec.currents.tx.milliamperes() - ma).abs() < 1e-12,
                "level {level}"
            );
        }
    }

    #[test]
    fn less_power_never_draws_more() {
        for make in [rf230, rf233] {
            let specs: Vec<RadioSpec> = (0..16).map(|level| make(11, level).unwrap()).collect();
            assert!(specs.is_sorted_by(|a, b| a.tx_power > b.tx_power));
            assert!(specs.is_sorted_by(|a, b| a.currents.tx > b.currents.tx));
            assert!(specs.iter().all(|spec| spec.check().is_ok()));
        }
    }

    #[test]
    fn one_frame_in_a_hundred_is_lost_at_the_sensitivity() {
        // And not none, as in the original: 20 bytes of PSDU, 26 on the air.
        for spec in [rf230(11, 0).unwrap(), rf233(11, 0).unwrap()] {
            let snr = spec.sensitivity - spec.phy.noise;
            let chance = spec.error.packet_success(snr, 26);
            assert!((chance - 0.99).abs() < 1e-3, "{chance}");
            assert!((chance - spec.phy.bits.success(snr.ratio(), 208.0)).abs() < 1e-12);
            let floor = PowerLevel::from_dbm(-100.0) + spec.noise_figure;
            assert!((floor - spec.phy.noise).db().abs() < 1e-9);
        }
    }

    #[test]
    fn a_channel_is_busy_by_the_register_of_the_datasheet() {
        let busy = |spec: RadioSpec| (spec.phy.cca.mode, spec.phy.cca.threshold.dbm());
        assert_eq!(busy(rf230(11, 0).unwrap()), (CcaMode::Energy, -77.0));
        assert_eq!(busy(rf233(11, 0).unwrap()), (CcaMode::Energy, -80.0));
    }

    #[test]
    fn unknown_channels_and_levels_are_refused() {
        for make in [rf230, rf233] {
            assert!(make(10, 0).is_none() && make(27, 0).is_none() && make(11, 16).is_none());
        }
    }

    #[test]
    fn air_times_are_those_of_the_standard() {
        let spec = rf230(11, 0).unwrap();
        for (payload, us) in [(0, 544.0), (4, 672.0), (20, 1184.0)] {
            assert!((spec.airtime(payload).secs() * 1e6 - us).abs() < 1e-9);
        }
    }
}
