//! The nRF24L01+.

use simbeeotic_model::radio::RadioSpec;
use simbeeotic_model::radio::nrf::{self, Nrf24 as Settings, Rate};
use simbeeotic_model::units::PowerLevel;
use simbeeotic_model::{BuildError, Radio, choice, params, radio};

/// Nordic nRF24L01+: 2.4 GHz, 250 kbit/s to 2 Mbit/s, payloads of up to 32 bytes, no listening before it
/// sends.
///
/// Numbers and sources: `simbeeotic_radio::nrf`.
#[radio("nrf24")]
pub struct Nrf24;

/// The bit rates of Nordic's radios.
#[choice]
#[derive(Default)]
pub enum NrfRate {
    /// 250 kbit/s: the farthest.
    #[serde(rename = "250k")]
    Kbps250,
    /// 1 Mbit/s.
    #[serde(rename = "1M")]
    Mbps1,
    /// 2 Mbit/s: the shortest on the air.
    #[default]
    #[serde(rename = "2M")]
    Mbps2,
}

impl NrfRate {
    pub(super) fn rate(self) -> Rate {
        match self {
            Self::Kbps250 => Rate::Kbps250,
            Self::Mbps1 => Rate::Mbps1,
            Self::Mbps2 => Rate::Mbps2,
        }
    }
}

/// Parameters of [`Nrf24`].
#[params]
pub struct Nrf24Params {
    /// Channel, 0 to 125: 2400 MHz and up, 1 MHz apart.
    pub channel: u8,
    /// Output power: -18, -12, -6 or 0 dBm.
    pub tx_power: PowerLevel,
    /// Bit rate: `250k`, `1M` or `2M`.
    pub rate: NrfRate,
    /// Bytes of an address, 3 to 5.
    pub address_bytes: u8,
    /// Bytes of the checksum, 0 to 2.
    pub crc_bytes: u8,
}

impl Default for Nrf24Params {
    fn default() -> Self {
        Self {
            channel: 2,
            tx_power: PowerLevel::from_dbm(0.0),
            rate: NrfRate::default(),
            address_bytes: 5,
            crc_bytes: 2,
        }
    }
}

/// One of these output powers, or which there are.
pub(super) fn level(levels: &[(f64, f64)], power: PowerLevel) -> Result<f64, BuildError> {
    match levels.iter().find(|(dbm, _)| *dbm == power.dbm()) {
        Some((dbm, _)) => Ok(*dbm),
        None => {
            let known: Vec<String> = levels
                .iter()
                .rev()
                .map(|(dbm, _)| dbm.to_string())
                .collect();
            let message = format!("must be one of {} dBm, and is {power}", known.join(", "));
            Err(BuildError::parameter("tx_power", message))
        }
    }
}

impl Radio for Nrf24 {
    type Params = Nrf24Params;

    fn spec(params: Nrf24Params) -> Result<RadioSpec, BuildError> {
        let power_dbm = level(&nrf::NRF24_LEVELS, params.tx_power)?;
        for (key, ok, message) in [
            (
                "channel",
                params.channel <= 125,
                "must be a channel from 0 to 125",
            ),
            (
                "address_bytes",
                (3..=5).contains(&params.address_bytes),
                "must be 3, 4 or 5",
            ),
            ("crc_bytes", params.crc_bytes <= 2, "must be 0, 1 or 2"),
        ] {
            if !ok {
                return Err(BuildError::parameter(key, message));
            }
        }
        let settings = Settings {
            channel: params.channel,
            power_dbm,
            rate: params.rate.rate(),
            address_bytes: params.address_bytes,
            crc_bytes: params.crc_bytes,
        };
        nrf::nrf24(settings)
            .ok_or_else(|| BuildError::parameter("tx_power", "must be one that the radio has"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_it_comes_it_sends_two_megabits() {
        let spec = Nrf24::spec(Nrf24Params::default()).unwrap();
        assert_eq!((spec.data_rate.get(), spec.payload_bytes_max), (2e6, 32));
    }

    #[test]
    fn settings_that_it_does_not_have_are_refused_by_name() {
        let good = Nrf24Params::default;
        for (key, params) in [
            (
                "channel",
                Nrf24Params {
                    channel: 126,
                    ..good()
                },
            ),
            (
                "tx_power",
                Nrf24Params {
                    tx_power: PowerLevel::from_dbm(1.0),
                    ..good()
                },
            ),
            (
                "address_bytes",
                Nrf24Params {
                    address_bytes: 2,
                    ..good()
                },
            ),
            (
                "crc_bytes",
                Nrf24Params {
                    crc_bytes: 3,
                    ..good()
                },
            ),
        ] {
            let fault = Nrf24::spec(params).expect_err(key).to_string();
            assert!(fault.contains(key), "{fault}");
        }
        let odd = Nrf24Params {
            tx_power: PowerLevel::from_dbm(-7.0),
            ..good()
        };
        let fault = Nrf24::spec(odd).unwrap_err().to_string();
        assert!(
            fault.contains("-18, -12, -6, 0 dBm, and is -7 dBm"),
            "{fault}"
        );
    }
}
