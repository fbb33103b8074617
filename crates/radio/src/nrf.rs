//! Nordic's 2.4 GHz radios with ShockBurst frames: the nRF24L01+, and the nRF51822 as on the Crazyflie.
//!
//! | number | nRF24L01+ | nRF51822 | source |
//! |---|---|---|---|
//! | data rates | 250 kbit/s, 1 and 2 Mbit/s | the same | datasheets |
//! | channels | 2400 MHz and up, 1 MHz apart, 0 to 125 | 0 to 100 | datasheets |
//! | width of a channel | 1 MHz, at 2 Mbit/s 2 MHz | the same | datasheets |
//! | frame | preamble 1, address 3 to 5, control 9 bits, payload, CRC 0 to 2 | address 5, CRC 2 | datasheets |
//! | longest payload | 32 bytes | 60 bytes after a header of 2 | datasheet; Crazyflie P2P |
//! | power levels, transmit | [`NRF24_LEVELS`] | [`NRF51_LEVELS`] | datasheets |
//! | receive | 12.6, 13.1, 13.5 mA (250k, 1M, 2M) | 12.6, 13.0, 13.4 mA | datasheets |
//! | idle | 26 uA (standby I) | 2.6 uA | datasheets |
//! | sleep | 0.9 uA | 0.6 uA | datasheets |
//! | sensitivity, one bit in a thousand wrong | -94, -85, -82 dBm | -96, -90, -85 dBm | datasheets |
//! | noise | 10.94 dB below the sensitivity | the same | from the sensitivity, with [`Gfsk`] |
//! | turnaround | 130 us | 130 us | datasheets |
//! | medium access | none: sends at once | none | Enhanced ShockBurst |
//! | amplifier | no | optional: 20 dBm, 90 mA more | Crazyflie 2.x carries an RFX2411N |
//!
//! Datasheets: nRF24L01+ product specification v1.0, nRF51822 product specification v3.1; neither was at
//! hand, nor that of the RFX2411N or the Crazyflie's firmware: the numbers are those commonly quoted. Currents of the nRF51
//! are those without its DC/DC converter, and without its processor. The amplifier's draw is a guess from others of its family; what
//! its receive side improves is not modelled.
//!
//! Broadcasts are not acknowledged; automatic acknowledgement and retransmission of addressed frames is
//! not modelled here. The `simple` medium does not tell 250 kbit/s from 1 Mbit/s on one channel; media
//! with air time do.

use crate::bit_errors::{Bitwise, Gfsk};
use crate::channel::Channel;
use crate::error_model::ErrorModel;
use crate::phy::{Access, BitErrors, LinkQuality, Phy, Spacing};
use crate::radio::{Currents, Framing, RadioSpec};
use simbeeotic_units::{Current, DataRate, Decibels, Frequency, PowerLevel, Time};
use std::sync::{Arc, LazyLock};

/// Output power of the nRF24L01+ in dBm, and its current in mA.
pub const NRF24_LEVELS: [(f64, f64); 4] = [(0.0, 11.3), (-6.0, 9.0), (-12.0, 7.5), (-18.0, 7.0)];

/// Output power of the nRF51822 in dBm, and its current in mA.
pub const NRF51_LEVELS: [(f64, f64); 8] = [
    (4.0, 16.0),
    (0.0, 10.5),
    (-4.0, 8.0),
    (-8.0, 7.0),
    (-12.0, 6.5),
    (-16.0, 6.0),
    (-20.0, 5.5),
    (-30.0, 5.5),
];

/// Bits of the packet control field: length 6, identity 2, no-acknowledgement 1.
pub const CONTROL_BITS: u32 = 9;

/// Bytes in front of a peer-to-peer payload of the Crazyflie: 0xff, port.
pub const P2P_HEADER_BYTES: usize = 2;

/// The longest peer-to-peer payload of the Crazyflie.
pub const P2P_BYTES_MAX: usize = 60;

/// What the amplifier on a Crazyflie makes of 0 dBm or more.
pub const AMPLIFIED_DBM: f64 = 20.0;

/// What the amplifier draws besides.
pub const AMPLIFIER_MA: f64 = 90.0;

/// The bit rates of ShockBurst.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rate {
    /// 250 kbit/s.
    Kbps250,
    /// 1 Mbit/s.
    Mbps1,
    /// 2 Mbit/s.
    #[default]
    Mbps2,
}

impl Rate {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Kbps250, Self::Mbps1, Self::Mbps2];

    /// Bits a second.
    #[must_use]
    pub fn data_rate(self) -> DataRate {
        DataRate::from_kilobits_per_second(match self {
            Self::Kbps250 => 250.0,
            Self::Mbps1 => 1000.0,
            Self::Mbps2 => 2000.0,
        })
    }

    fn width(self) -> Frequency {
        Frequency::si(match self {
            Self::Kbps250 | Self::Mbps1 => 1e6,
            Self::Mbps2 => 2e6,
        })
    }
}

/// Settings of an nRF24L01+.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nrf24 {
    /// Channel, 0 to 125: 2400 MHz and up.
    pub channel: u8,
    /// Output power in dBm: one of [`NRF24_LEVELS`].
    pub power_dbm: f64,
    /// Bit rate.
    pub rate: Rate,
    /// Bytes of an address, 3 to 5.
    pub address_bytes: u8,
    /// Bytes of the checksum, 0 to 2.
    pub crc_bytes: u8,
}

impl Default for Nrf24 {
    fn default() -> Self {
        Self {
            channel: 2,
            power_dbm: 0.0,
            rate: Rate::Mbps2,
            address_bytes: 5,
            crc_bytes: 2,
        }
    }
}

/// Settings of an nRF51822 on a Crazyflie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nrf51 {
    /// Channel, 0 to 100: 2400 MHz and up. A Crazyflie comes with 80.
    pub channel: u8,
    /// Output power in dBm: one of [`NRF51_LEVELS`].
    pub power_dbm: f64,
    /// Bit rate.
    pub rate: Rate,
    /// Whether the amplifier is on: [`AMPLIFIED_DBM`], which takes 0 dBm or 4 dBm to drive.
    pub amplifier: bool,
}

impl Default for Nrf51 {
    fn default() -> Self {
        Self {
            channel: 80,
            power_dbm: 4.0,
            rate: Rate::Mbps2,
            amplifier: false,
        }
    }
}

/// An nRF24L01+ with these settings. `None` if it does not have them.
#[must_use]
pub fn nrf24(settings: Nrf24) -> Option<RadioSpec> {
    let tx = current(&NRF24_LEVELS, settings.power_dbm)?;
    let lengths = (3..=5).contains(&settings.address_bytes) && settings.crc_bytes <= 2;
    if settings.channel > 125 || !lengths {
        return None;
    }
    let (sensitivity_dbm, rx_ma) = match settings.rate {
        Rate::Kbps250 => (-94.0, 12.6),
        Rate::Mbps1 => (-85.0, 13.1),
        Rate::Mbps2 => (-82.0, 13.5),
    };
    let overhead = 1 + usize::from(settings.address_bytes) + usize::from(settings.crc_bytes);
    Some(RadioSpec {
        tx_power: PowerLevel::from_dbm(settings.power_dbm),
        overhead_bytes: overhead,
        payload_bytes_max: 32,
        currents: Currents {
            tx,
            rx: Current::from_milliamperes(rx_ma),
            idle: Current::from_microamperes(26.0),
            sleep: Current::from_microamperes(0.9),
        },
        ..shock_burst(
            settings.channel,
            settings.rate,
            sensitivity_dbm,
            usize::from(settings.address_bytes),
        )
    })
}

/// An nRF51822 with these settings, sending peer-to-peer broadcasts of the Crazyflie. `None` if it does
/// not have them.
#[must_use]
pub fn nrf51(settings: Nrf51) -> Option<RadioSpec> {
    let mut tx = current(&NRF51_LEVELS, settings.power_dbm)?;
    if settings.channel > 100 || settings.amplifier && settings.power_dbm < 0.0 {
        return None;
    }
    let mut power_dbm = settings.power_dbm;
    if settings.amplifier {
        power_dbm = AMPLIFIED_DBM;
        tx += Current::from_milliamperes(AMPLIFIER_MA);
    }
    let (sensitivity_dbm, rx_ma) = match settings.rate {
        Rate::Kbps250 => (-96.0, 12.6),
        Rate::Mbps1 => (-90.0, 13.0),
        Rate::Mbps2 => (-85.0, 13.4),
    };
    Some(RadioSpec {
        tx_power: PowerLevel::from_dbm(power_dbm),
        // Preamble, address, header, checksum.
        overhead_bytes: 1 + 5 + P2P_HEADER_BYTES + 2,
        payload_bytes_max: P2P_BYTES_MAX,
        currents: Currents {
            tx,
            rx: Current::from_milliamperes(rx_ma),
            idle: Current::from_microamperes(2.6),
            sleep: Current::from_microamperes(0.6),
        },
        ..shock_burst(settings.channel, settings.rate, sensitivity_dbm, 5)
    })
}

fn current(levels: &[(f64, f64)], power_dbm: f64) -> Option<Current> {
    let (_, ma) = levels.iter().find(|(dbm, _)| *dbm == power_dbm)?;
    Some(Current::from_milliamperes(*ma))
}

/// What both have in common.
fn shock_burst(channel: u8, rate: Rate, sensitivity_dbm: f64, address_bytes: usize) -> RadioSpec {
    // One model for all, so that media keep one table. The noise bandwidth is taken for the bit rate;
    // a receiver that is wider or narrower has another noise, and the same sensitivity.
    const KEYING: Gfsk = Gfsk {
        bandwidth_over_rate: 1.0,
    };
    static BITS: LazyLock<Arc<dyn BitErrors>> = LazyLock::new(|| Arc::new(KEYING));
    static ERROR: LazyLock<Arc<dyn ErrorModel>> =
        LazyLock::new(|| Arc::new(Bitwise(Arc::clone(&BITS))));

    let channel = Channel {
        centre: Frequency::si(2.4e9 + 1e6 * f64::from(channel)),
        width: rate.width(),
    };
    let sensitivity = PowerLevel::from_dbm(sensitivity_dbm);
    let noise = sensitivity - KEYING.snr_at_per_mille();
    let none = Time::ZERO;
    RadioSpec {
        sensitivity,
        noise_figure: noise - PowerLevel::from_dbm(-100.0),
        data_rate: rate.data_rate(),
        framing: Framing::Bits {
            beyond: CONTROL_BITS,
        },
        phy: Phy {
            noise,
            sensitivity: Some(sensitivity),
            lock: Decibels::ZERO,
            bits: Arc::clone(&BITS),
            quality: LinkQuality::Success,
            header_bytes: 1 + address_bytes,
            turnaround: Time::from_micros(130.0),
            access: Access::Aloha,
            acks: None,
            spacing: Spacing {
                short: none,
                long: none,
                short_bytes_max: 0,
            },
            ..Phy::ieee802154()
        },
        ..RadioSpec::new(channel, Arc::clone(&ERROR))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn us(spec: &RadioSpec, payload: usize) -> f64 {
        spec.airtime(payload).secs() * 1e6
    }

    #[test]
    fn air_times_count_every_bit_of_the_frame() {
        // 8 + 40 + 9 + 8 (2 + 30) + 16 bits at 2 Mbit/s.
        let crazyflie = nrf51(Nrf51::default()).unwrap();
        assert!((us(&crazyflie, 30) - 164.5).abs() < 1e-9);
        // 8 + 40 + 9 + 256 + 16 = 329 bits.
        for (rate, expected) in [
            (Rate::Mbps2, 164.5),
            (Rate::Mbps1, 329.0),
            (Rate::Kbps250, 1316.0),
        ] {
            let spec = nrf24(Nrf24 {
                rate,
                ..Nrf24::default()
            })
            .unwrap();
            assert!((us(&spec, 32) - expected).abs() < 1e-9, "{rate:?}");
        }
        // 8 + 24 + 9 + 8 + 8 = 57 bits.
        let short = nrf24(Nrf24 {
            rate: Rate::Mbps1,
            address_bytes: 3,
            crc_bytes: 1,
            ..Nrf24::default()
        })
        .unwrap();
        assert!((us(&short, 1) - 57.0).abs() < 1e-9);
    }

    #[test]
    fn levels_draw_what_the_datasheets_say() {
        for (power_dbm, ma) in NRF24_LEVELS {
            let spec = nrf24(Nrf24 {
                power_dbm,
                ..Nrf24::default()
            })
            .unwrap();
            assert_eq!(spec.tx_power.dbm(), power_dbm);
            assert!((spec.currents.tx.milliamperes() - ma).abs() < 1e-12);
        }
        for (power_dbm, ma) in NRF51_LEVELS {
            let spec = nrf51(Nrf51 {
                power_dbm,
                ..Nrf51::default()
            })
            .unwrap();
            assert!((spec.currents.tx.milliamperes() - ma).abs() < 1e-12);
        }
        let loud = nrf51(Nrf51 {
            amplifier: true,
            ..Nrf51::default()
        })
        .unwrap();
        assert_eq!(loud.tx_power.dbm(), 20.0);
        assert!((loud.currents.tx.milliamperes() - 106.0).abs() < 1e-9);
    }

    #[test]
    fn one_bit_in_a_thousand_is_wrong_at_the_sensitivity() {
        let mut specs = Vec::new();
        for (rate, dbm_24, dbm_51) in [
            (Rate::Kbps250, -94.0, -96.0),
            (Rate::Mbps1, -85.0, -90.0),
            (Rate::Mbps2, -82.0, -85.0),
        ] {
            let a = nrf24(Nrf24 {
                rate,
                ..Nrf24::default()
            })
            .unwrap();
            let b = nrf51(Nrf51 {
                rate,
                ..Nrf51::default()
            })
            .unwrap();
            assert_eq!((a.sensitivity.dbm(), b.sensitivity.dbm()), (dbm_24, dbm_51));
            specs.extend([a, b]);
        }
        for spec in specs {
            let snr = (spec.sensitivity - spec.phy.noise).ratio();
            assert!((spec.phy.bits.bit_error(snr) - 1e-3).abs() < 1e-9);
            assert_eq!(spec.check(), Ok(()));
        }
    }

    #[test]
    fn channels_lie_one_megahertz_apart() {
        let centre = |channel| {
            let spec = nrf24(Nrf24 {
                channel,
                ..Nrf24::default()
            });
            spec.map(|spec| spec.channel.centre.get())
        };
        assert_eq!((centre(0), centre(125)), (Some(2.4e9), Some(2.525e9)));
        assert_eq!(centre(126), None);
    }

    #[test]
    fn what_they_do_not_have_is_refused() {
        let bad = [
            Nrf24 {
                power_dbm: -1.0,
                ..Nrf24::default()
            },
            Nrf24 {
                address_bytes: 2,
                ..Nrf24::default()
            },
            Nrf24 {
                address_bytes: 6,
                ..Nrf24::default()
            },
            Nrf24 {
                crc_bytes: 3,
                ..Nrf24::default()
            },
        ];
        assert!(bad.into_iter().all(|settings| nrf24(settings).is_none()));
        assert!(
            nrf51(Nrf51 {
                channel: 101,
                ..Nrf51::default()
            })
            .is_none()
        );
        let weak = Nrf51 {
            amplifier: true,
            power_dbm: -20.0,
            ..Nrf51::default()
        };
        assert!(nrf51(weak).is_none());
    }

    #[test]
    fn they_send_without_listening() {
        let spec = nrf51(Nrf51::default()).unwrap();
        assert_eq!((spec.phy.access, spec.phy.acks), (Access::Aloha, None));
    }
}
