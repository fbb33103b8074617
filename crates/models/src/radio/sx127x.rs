//! LoRa: the SX1276 and its kin.

use simbeeotic_model::check::in_range;
use simbeeotic_model::radio::RadioSpec;
use simbeeotic_model::radio::sx127x::{self, Lora};
use simbeeotic_model::units::{Frequency, PowerLevel};
use simbeeotic_model::{BuildError, Radio, params, radio};

/// Semtech SX1276: LoRa below 1 GHz, kilometres at some hundred to some thousand bits a second.
///
/// Numbers and sources: `simbeeotic_radio::sx127x`. Give radios of different spreading factors different
/// frequencies: the `simple` medium does not tell them apart.
#[radio("sx127x")]
pub struct Sx127x;

/// Parameters of [`Sx127x`].
#[params]
pub struct Sx127xParams {
    /// Middle of the channel, 137 MHz to 1020 MHz.
    pub frequency: Frequency,
    /// Width of the channel: 125, 250 or 500 kHz.
    pub bandwidth: Frequency,
    /// Bits a symbol, 7 to 12: each more takes twice the time and hears 2.5 dB less.
    pub spreading_factor: u8,
    /// 5 to 8: a code rate of 4/5 to 4/8.
    pub code_rate: u8,
    /// Symbols of the preamble, 6 or more.
    pub preamble_symbols: u16,
    /// Output power, 2 dBm to 20 dBm.
    pub tx_power: PowerLevel,
}

impl Default for Sx127xParams {
    fn default() -> Self {
        Self {
            frequency: Frequency::si(868.1e6),
            bandwidth: Frequency::si(125e3),
            spreading_factor: 7,
            code_rate: 5,
            preamble_symbols: 8,
            tx_power: PowerLevel::from_dbm(14.0),
        }
    }
}

impl Radio for Sx127x {
    type Params = Sx127xParams;

    fn spec(params: Sx127xParams) -> Result<RadioSpec, BuildError> {
        let (low, high) = (Frequency::si(137e6), Frequency::si(1020e6));
        in_range("frequency", params.frequency, low..=high)?;
        in_range("spreading_factor", params.spreading_factor, 7..=12)?;
        in_range("code_rate", params.code_rate, 5..=8)?;
        in_range("preamble_symbols", params.preamble_symbols, 6..=u16::MAX)?;
        let (low, high) = (PowerLevel::from_dbm(2.0), PowerLevel::from_dbm(20.0));
        in_range("tx_power", params.tx_power, low..=high)?;
        let lora = Lora {
            spreading_factor: params.spreading_factor,
            bandwidth: params.bandwidth,
            code_rate: params.code_rate,
            preamble_symbols: params.preamble_symbols,
        };
        sx127x::spec(params.frequency, params.tx_power, lora).ok_or_else(|| {
            let message = format!("must be 125, 250 or 500 kHz, and is {}", params.bandwidth);
            BuildError::parameter("bandwidth", message)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_that_it_does_not_have_are_refused_by_name() {
        let good = Sx127xParams::default;
        assert!(Sx127x::spec(good()).is_ok());
        for (key, params) in [
            (
                "frequency",
                Sx127xParams {
                    frequency: Frequency::si(2.4e9),
                    ..good()
                },
            ),
            (
                "bandwidth",
                Sx127xParams {
                    bandwidth: Frequency::si(1e5),
                    ..good()
                },
            ),
            (
                "spreading_factor",
                Sx127xParams {
                    spreading_factor: 6,
                    ..good()
                },
            ),
            (
                "code_rate",
                Sx127xParams {
                    code_rate: 4,
                    ..good()
                },
            ),
            (
                "preamble_symbols",
                Sx127xParams {
                    preamble_symbols: 5,
                    ..good()
                },
            ),
            (
                "tx_power",
                Sx127xParams {
                    tx_power: PowerLevel::from_dbm(21.0),
                    ..good()
                },
            ),
        ] {
            let fault = Sx127x::spec(params).expect_err(key).to_string();
            assert!(fault.contains(key), "{fault}");
        }
    }
}
