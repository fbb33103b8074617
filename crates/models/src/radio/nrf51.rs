//! The nRF51822 as on the Crazyflie 2.x.

use super::nrf24::{NrfRate, level};
use simbeeotic_model::radio::RadioSpec;
use simbeeotic_model::radio::nrf::{self, Nrf51 as Settings};
use simbeeotic_model::units::PowerLevel;
use simbeeotic_model::{BuildError, Radio, params, radio};

/// Nordic nRF51822 as on the Crazyflie 2.x: 2.4 GHz, peer-to-peer broadcasts of up to 60 bytes at 2 Mbit/s,
/// no listening before it sends; with its amplifier 20 dBm.
///
/// Numbers and sources: `simbeeotic_radio::nrf`.
#[radio("nrf51")]
pub struct Nrf51;

/// Parameters of [`Nrf51`].
#[params]
pub struct Nrf51Params {
    /// Channel, 0 to 100: 2400 MHz and up, 1 MHz apart.
    pub channel: u8,
    /// Output power: -30, -20, -16, -12, -8, -4, 0 or 4 dBm.
    pub tx_power: PowerLevel,
    /// Bit rate: `250k`, `1M` or `2M`.
    pub rate: NrfRate,
    /// Whether the amplifier (RFX2411N) is on: 20 dBm instead of `tx_power`, which must be 0 dBm or 4 dBm.
    pub amplifier: bool,
}

impl Default for Nrf51Params {
    fn default() -> Self {
        Self {
            channel: 80,
            tx_power: PowerLevel::from_dbm(4.0),
            rate: NrfRate::default(),
            amplifier: false,
        }
    }
}

impl Radio for Nrf51 {
    type Params = Nrf51Params;

    fn spec(params: Nrf51Params) -> Result<RadioSpec, BuildError> {
        let power_dbm = level(&nrf::NRF51_LEVELS, params.tx_power)?;
        if params.channel > 100 {
            let message = "must be a channel from 0 to 100";
            return Err(BuildError::parameter("channel", message));
        }
        let settings = Settings {
            channel: params.channel,
            power_dbm,
            rate: params.rate.rate(),
            amplifier: params.amplifier,
        };
        nrf::nrf51(settings).ok_or_else(|| {
            let message = "takes a `tx_power` of 0 dBm or 4 dBm to drive";
            BuildError::parameter("amplifier", message)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_that_it_does_not_have_are_refused_by_name() {
        let good = Nrf51Params::default;
        assert!(Nrf51::spec(good()).is_ok());
        let weak = PowerLevel::from_dbm(-8.0);
        for (key, params) in [
            (
                "channel",
                Nrf51Params {
                    channel: 101,
                    ..good()
                },
            ),
            (
                "tx_power",
                Nrf51Params {
                    tx_power: PowerLevel::from_dbm(20.0),
                    ..good()
                },
            ),
            (
                "amplifier",
                Nrf51Params {
                    amplifier: true,
                    tx_power: weak,
                    ..good()
                },
            ),
        ] {
            let fault = Nrf51::spec(params).expect_err(key).to_string();
            assert!(fault.contains(key), "{fault}");
        }
        let loud = Nrf51Params {
            amplifier: true,
            ..good()
        };
        assert_eq!(Nrf51::spec(loud).unwrap().tx_power.dbm(), 20.0);
    }
}
