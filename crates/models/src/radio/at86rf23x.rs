//! The AT86RF230 and the AT86RF233.

use simbeeotic_model::radio::{RadioSpec, at86rf23x};
use simbeeotic_model::{BuildError, Radio, params, radio};

/// Atmel AT86RF230: 2.4 GHz, IEEE 802.15.4, 250 kbit/s.
///
/// Numbers and sources: `simbeeotic_radio::at86rf23x`.
#[radio("rf230", java = "harvard.robobees.simbeeotic.model.comms.RF230")]
pub struct Rf230;

/// Atmel AT86RF233: 2.4 GHz, IEEE 802.15.4, 250 kbit/s, with less current and more power than the
/// AT86RF230.
///
/// Numbers and sources: `simbeeotic_radio::at86rf23x`.
#[radio("rf233")]
pub struct Rf233;

/// Parameters of [`Rf230`] and [`Rf233`].
#[params]
pub struct At86rf23xParams {
    /// IEEE 802.15.4 channel, 11 to 26: 2405 MHz and up, 5 MHz apart.
    pub channel: u8,
    /// `TX_PWR`, 0 to 15: 0 is the strongest, 3 dBm (AT86RF233: 4 dBm), 15 the weakest, -17.2 dBm (-17 dBm).
    pub tx_level: u8,
}

impl Default for At86rf23xParams {
    fn default() -> Self {
        Self {
            channel: 11,
            tx_level: 0,
        }
    }
}

fn made(
    params: &At86rf23xParams,
    make: fn(u8, u8) -> Option<RadioSpec>,
) -> Result<RadioSpec, BuildError> {
    if !(11..=26).contains(&params.channel) {
        let message = "must be a channel from 11 to 26";
        return Err(BuildError::parameter("channel", message));
    }
    make(params.channel, params.tx_level)
        .ok_or_else(|| BuildError::parameter("tx_level", "must be a level from 0 to 15"))
}

impl Radio for Rf230 {
    type Params = At86rf23xParams;

    fn spec(params: At86rf23xParams) -> Result<RadioSpec, BuildError> {
        made(&params, at86rf23x::rf230)
    }
}

impl Radio for Rf233 {
    type Params = At86rf23xParams;

    fn spec(params: At86rf23xParams) -> Result<RadioSpec, BuildError> {
        made(&params, at86rf23x::rf233)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn channels_and_levels_that_they_do_not_have_are_refused_by_name() {
        for spec in [Rf230::spec, Rf233::spec] {
            let with = |channel, tx_level| spec(At86rf23xParams { channel, tx_level });
            assert!(with(11, 0).is_ok() && with(26, 15).is_ok());
            let fault = with(27, 0).expect_err("no such channel").to_string();
            assert!(
                fault.contains("channel") && fault.contains("11 to 26"),
                "{fault}"
            );
            let fault = with(11, 16).expect_err("no such level").to_string();
            assert!(
                fault.contains("tx_level") && fault.contains("0 to 15"),
                "{fault}"
            );
        }
    }

    #[test]
    fn as_they_come_they_send_with_all_they_have() {
        let power = |spec: fn(At86rf23xParams) -> Result<RadioSpec, BuildError>| {
            spec(At86rf23xParams::default()).unwrap().tx_power.dbm()
        };
        assert_eq!((power(Rf230::spec), power(Rf233::spec)), (3.0, 4.0));
    }
}
