//! The CC2420: the radio of the paper.

use simbeeotic_model::radio::{RadioSpec, cc2420};
use simbeeotic_model::{BuildError, Radio, params, radio};

/// Texas Instruments CC2420: 2.4 GHz, IEEE 802.15.4, 250 kbit/s.
///
/// Numbers and sources: `simbeeotic_radio::cc2420`.
#[radio("cc2420", java = "harvard.robobees.simbeeotic.model.comms.CC2420")]
pub struct Cc2420;

/// Parameters of [`Cc2420`].
#[params]
pub struct Cc2420Params {
    /// IEEE 802.15.4 channel, 11 to 26: 2405 MHz and up, 5 MHz apart.
    pub channel: u8,
    /// `PA_LEVEL`, 3 to 31: -25 dBm to 0 dBm; levels between those of the datasheet's table are
    /// interpolated.
    pub tx_level: u8,
}

impl Default for Cc2420Params {
    fn default() -> Self {
        Self {
            channel: 11,
            tx_level: 31,
        }
    }
}

impl Radio for Cc2420 {
    type Params = Cc2420Params;

    fn spec(params: Cc2420Params) -> Result<RadioSpec, BuildError> {
        if !(11..=26).contains(&params.channel) {
            return Err(BuildError::parameter(
                "channel",
                "must be a channel from 11 to 26",
            ));
        }
        cc2420::spec(params.channel, params.tx_level)
            .ok_or_else(|| BuildError::parameter("tx_level", "must be a level from 3 to 31"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with(channel: u8, tx_level: u8) -> Result<RadioSpec, BuildError> {
        Cc2420::spec(Cc2420Params { channel, tx_level })
    }

    #[test]
    fn channels_and_levels_of_the_datasheet_are_taken() {
        for (channel, level) in [(11, 31), (26, 3), (18, 17)] {
            assert!(with(channel, level).is_ok(), "{channel} {level}");
        }
    }

    #[test]
    fn others_are_refused_by_name() {
        for channel in [0, 10, 27, 255] {
            let fault = with(channel, 31).expect_err("no such channel");
            assert!(fault.to_string().contains("11 to 26"), "{fault}");
        }
        for level in [0, 2, 32, 255] {
            let fault = with(11, level).expect_err("no such level");
            assert!(fault.to_string().contains("3 to 31"), "{fault}");
        }
    }
}
