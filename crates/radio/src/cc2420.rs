//! The CC2420, Texas Instruments' 2.4 GHz IEEE 802.15.4 transceiver: the radio of the paper.
//!
//! | number | value | source |
//! |---|---|---|
//! | data rate | 250 kbit/s, 32 us per byte | IEEE 802.15.4 |
//! | frame overhead | 17 bytes: preamble 4, start 1, length 1, MAC header 9, checksum 2 | IEEE 802.15.4, short addresses |
//! | power levels | [`PA_LEVELS`] | datasheet SWRS041B, table 9 (levels as listed by Contiki) |
//! | receive | 18.8 mA | datasheet, front page |
//! | idle | 0.426 mA | datasheet; the original Simbeeotic |
//! | sleep | 0.02 uA, regulator off | datasheet |
//! | sensitivity | -90 dBm | datasheet's guaranteed value; the original Simbeeotic (typical: -95 dBm) |
//! | with air time | [`Phy::cc2420`] | there |
//! | error model | [`Cc2420Curve`] | TOSSIM; the original Simbeeotic |
//!
//! The original counted the payload alone as air time. Here the overhead is on the air as well, so a
//! packet of 4 bytes costs 672 us and not 128 us; set `overhead_bytes` to 0 for the original's energy.

use crate::channel::Channel;
use crate::error_model::{Cc2420Curve, ErrorModel};
use crate::phy::Phy;
use crate::radio::{Currents, RadioSpec};
use simbeeotic_units::{Current, DataRate, PowerLevel};
use std::sync::{Arc, LazyLock};

/// Frame bytes besides the payload: 6 of the physical layer, 11 of the MAC with short addresses.
pub const OVERHEAD_BYTES: usize = 17;

/// The longest payload: 127 bytes of PSDU less 11 of MAC header and checksum.
pub const PAYLOAD_BYTES_MAX: usize = 116;

/// `PA_LEVEL` of the datasheet's table, with output power in dBm and current in mA.
pub const PA_LEVELS: [(u8, f64, f64); 8] = [
    (3, -25.0, 8.5),
    (7, -15.0, 9.9),
    (11, -10.0, 11.0),
    (15, -7.0, 12.7),
    (19, -5.0, 14.0),
    (23, -3.0, 15.1),
    (27, -1.0, 16.5),
    (31, 0.0, 17.4),
];

/// Output power and current at a `PA_LEVEL`; `None` unless 3 ≤ level ≤ 31.
///
/// Between the levels of [`PA_LEVELS`] both are interpolated linearly, the power in dBm.
#[must_use]
pub fn pa_level(level: u8) -> Option<(PowerLevel, Current)> {
    let above = PA_LEVELS.iter().position(|&(l, ..)| l >= level)?;
    let (l1, dbm1, ma1) = PA_LEVELS[above];
    let (l0, dbm0, ma0) = PA_LEVELS[above.saturating_sub(1)];
    if level < PA_LEVELS[0].0 {
        return None;
    }
    let share = if l1 == l0 {
        1.0
    } else {
        f64::from(level - l0) / f64::from(l1 - l0)
    };
    Some((
        PowerLevel::from_dbm(dbm0 + share * (dbm1 - dbm0)),
        Current::from_milliamperes(ma0 + share * (ma1 - ma0)),
    ))
}

/// A CC2420 on an IEEE 802.15.4 channel (11 to 26) at a power level (3 to 31); 11 and 31 are what
/// the original takes. `None` if it has no such channel or level.
#[must_use]
pub fn spec(channel: u8, level: u8) -> Option<RadioSpec> {
    // One model for all, so that media keep one table.
    static ERROR: LazyLock<Arc<dyn ErrorModel>> = LazyLock::new(|| Arc::new(Cc2420Curve));

    let (tx_power, tx) = pa_level(level)?;
    Some(RadioSpec {
        tx_power,
        sensitivity: PowerLevel::from_dbm(-90.0),
        data_rate: DataRate::from_kilobits_per_second(250.0),
        overhead_bytes: OVERHEAD_BYTES,
        payload_bytes_max: PAYLOAD_BYTES_MAX,
        currents: Currents {
            tx,
            rx: Current::from_milliamperes(18.8),
            idle: Current::from_milliamperes(0.426),
            sleep: Current::from_microamperes(0.02),
        },
        phy: Phy::cc2420(),
        ..RadioSpec::new(Channel::ieee802154(channel)?, Arc::clone(&ERROR))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_levels_are_exact_and_others_lie_between() {
        for (level, dbm, ma) in PA_LEVELS {
            let (power, current) = pa_level(level).unwrap();
            assert!((power.dbm() - dbm).abs() < 1e-12, "level {level}");
            assert!((current.milliamperes() - ma).abs() < 1e-12, "level {level}");
        }
        // Seen on motes: level 5 gives about -20 dBm.
        assert!((pa_level(5).unwrap().0.dbm() + 20.0).abs() < 1e-12);
        let powers: Vec<f64> = (3..=31).map(|l| pa_level(l).unwrap().0.dbm()).collect();
        assert!(powers.is_sorted());
        assert!(pa_level(2).is_none() && pa_level(32).is_none() && pa_level(0).is_none());
    }

    #[test]
    fn full_power_draws_the_current_of_full_power() {
        // The original drew 16.5 mA at 0 dBm unless a level was given.
        let spec = spec(11, 31).unwrap();
        assert_eq!(spec.tx_power.dbm(), 0.0);
        assert!((spec.currents.tx.milliamperes() - 17.4).abs() < 1e-12);
    }

    #[test]
    fn frames_take_the_time_that_the_standard_says() {
        let spec = spec(26, 31).unwrap();
        for (payload, us) in [(0, 544.0), (4, 672.0), (20, 1184.0)] {
            assert!(
                (spec.airtime(payload).secs() * 1e6 - us).abs() < 1e-9,
                "{payload} bytes"
            );
        }
        assert_eq!(spec.check(), Ok(()));
    }

    #[test]
    fn unknown_channels_are_refused() {
        assert!(spec(10, 31).is_none() && spec(27, 31).is_none());
    }

    #[test]
    fn all_share_one_error_model() {
        let [a, b] = [11, 12].map(|channel| spec(channel, 31).unwrap().error);
        assert!(Arc::ptr_eq(&a, &b));
    }
}
