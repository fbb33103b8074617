//! What a radio is: the numbers of its datasheet and its place on a platform.

use crate::antenna::{Antenna, Isotropic};
use crate::channel::Channel;
use crate::error_model::ErrorModel;
use crate::phy::Phy;
use crate::sx127x::Lora;
use simbeeotic_kernel::ModelId;
use simbeeotic_units::{Current, DataRate, Decibels, Mount, PowerLevel, Time};
use std::fmt;
use std::sync::Arc;

/// A radio's place in its medium: 0, 1, 2 ... in the order of adding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct RadioId(pub u32);

impl RadioId {
    /// This id as an index.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// Everything a medium must know of a radio.
///
/// A kind of radio (`cc2420::spec`, say) fills in its datasheet; whoever puts it on a platform sets
/// `owner`, `key`, `antenna` and `mount` on each copy.
#[derive(Clone, Debug)]
pub struct RadioSpec {
    /// The platform that carries it. Also its address, see [`Request::destination`](crate::Request).
    pub owner: ModelId,
    /// Its identity, independent of numbering: the `path_key` of its path. Random draws hang on it,
    /// so no two radios of a run may share it.
    pub key: u64,
    /// Where it sends and listens.
    pub channel: Channel,
    /// Power that it feeds into its antenna when it sends.
    pub tx_power: PowerLevel,
    /// The weakest signal it notices, -150 dBm or more.
    pub sensitivity: PowerLevel,
    /// Its own share of the noise, above the medium's noise floor; negative for a receiver that is
    /// narrower or better than the one that the floor is meant for. The radios here, but for the
    /// CC2420 and the generic one, take it from [`phy`](Self::phy): their noise above -100 dBm.
    pub noise_figure: Decibels,
    /// Bits on the air per second.
    pub data_rate: DataRate,
    /// Bytes on the air for each frame besides its payload: preamble, headers, checksum.
    pub overhead_bytes: usize,
    /// How bytes become air time.
    pub framing: Framing,
    /// The longest payload that fits into a frame, bytes.
    pub payload_bytes_max: usize,
    /// How many frames may wait to be sent, where the medium makes them wait.
    pub queue_frames: usize,
    /// What it draws.
    pub currents: Currents,
    /// How well it copes with noise. Radios of one kind should share one model: a medium keeps
    /// tables for each.
    pub error: Arc<dyn ErrorModel>,
    /// What media with air time ask of it besides: its receiver bit by bit, and its medium access.
    pub phy: Phy,
    /// Its antenna.
    pub antenna: Arc<dyn Antenna>,
    /// Where its antenna sits on the platform, and which way its boresight points.
    pub mount: Mount,
}

impl RadioSpec {
    /// A radio with these essentials; the rest as a simple 2.4 GHz transceiver:
    /// 0 dBm, -90 dBm sensitivity, 250 kbit/s, no overhead, no limit of payload, a queue of 100
    /// frames, no currents, IEEE 802.15.4 where air time matters, an isotropic antenna at the
    /// platform's centre.
    #[must_use]
    pub fn new(channel: Channel, error: Arc<dyn ErrorModel>) -> Self {
        Self {
            owner: ModelId::default(),
            key: 0,
            channel,
            tx_power: PowerLevel::from_dbm(0.0),
            sensitivity: PowerLevel::from_dbm(-90.0),
            noise_figure: Decibels::ZERO,
            data_rate: DataRate::from_kilobits_per_second(250.0),
            overhead_bytes: 0,
            framing: Framing::Bytes,
            payload_bytes_max: usize::MAX,
            queue_frames: 100,
            currents: Currents::default(),
            error,
            phy: Phy::default(),
            antenna: Arc::new(Isotropic::default()),
            mount: Mount::default(),
        }
    }

    /// Bytes on the air for a payload of this length.
    #[must_use]
    pub fn frame_bytes(&self, payload_bytes: usize) -> usize {
        self.overhead_bytes.saturating_add(payload_bytes)
    }

    /// How long a payload of this length is on the air.
    #[must_use]
    pub fn airtime(&self, payload_bytes: usize) -> Time {
        self.frame_airtime(self.frame_bytes(payload_bytes))
    }

    /// How long a frame of this many bytes, overhead included, is on the air.
    #[must_use]
    pub fn frame_airtime(&self, frame_bytes: usize) -> Time {
        let bytes = self.data_rate.airtime(frame_bytes);
        match self.framing {
            Framing::Bytes => bytes,
            Framing::Bits { beyond } => {
                bytes + Time::from_secs(f64::from(beyond) / self.data_rate.get())
            }
            Framing::Lora(lora) => lora.airtime(frame_bytes),
        }
    }

    /// Lets it send with another power, and draw another current meanwhile; returns the current that it drew
    /// before. After an error it is as it was.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub(crate) fn set_power(
        &mut self,
        level: PowerLevel,
        current: Current,
    ) -> Result<Current, RadioError> {
        let mut changed = self.clone();
        changed.tx_power = level;
        changed.currents.tx = current;
        changed.check()?;
        let before = self.currents.tx;
        *self = changed;
        Ok(before)
    }

    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// The first that does not, see [`RadioError`].
    pub fn check(&self) -> Result<(), RadioError> {
        let c = &self.currents;
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let number = |what, ok: bool, got: &dyn fmt::Display, expected| match ok {
            true => Ok(()),
            false => Err(RadioError::OutOfRange {
                what,
                got: got.to_string(),
                expected,
            }),
        };
        let centre = self.channel.centre;
        number(
            "channel centre",
            positive(centre.get()),
            &centre,
            "more than 0 Hz",
        )?;
        let width = self.channel.width;
        number(
            "channel width",
            positive(width.get()),
            &width,
            "more than 0 Hz",
        )?;
        let (power, least) = (self.tx_power, self.sensitivity);
        number(
            "transmit power",
            power.is_finite() && power.dbm() < 80.0,
            &power,
            "below 80 dBm",
        )?;
        let audible = (-150.0..30.0).contains(&least.dbm());
        number("sensitivity", audible, &least, "from -150 dBm to 30 dBm")?;
        let figure = self.noise_figure;
        number(
            "noise figure",
            figure.is_finite(),
            &figure,
            "a finite ratio",
        )?;
        if let Some(gain) = self.antenna.uniform_gain() {
            number("antenna gain", gain.is_finite(), &gain, "a finite ratio")?;
        }
        let rate = self.data_rate;
        number(
            "data rate",
            positive(rate.get()),
            &rate,
            "more than 0 bit/s",
        )?;
        for (what, current) in [
            ("transmit current", c.tx),
            ("receive current", c.rx),
            ("idle current", c.idle),
            ("sleep current", c.sleep),
        ] {
            let ok = current.is_finite() && current >= Current::ZERO;
            number(what, ok, &current, "0 A or more")?;
        }
        self.phy.check()
    }
}

/// How the bytes of a frame become air time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Framing {
    /// Eight bits a byte, at the data rate.
    #[default]
    Bytes,
    /// The same and a field that is no whole number of bytes.
    Bits {
        /// Bits beyond `overhead_bytes`.
        beyond: u32,
    },
    /// Symbols of LoRa, with their own preamble and header.
    Lora(Lora),
}

/// What a radio draws in each of its states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Currents {
    /// While sending, at the radio's power level.
    pub tx: Current,
    /// While taking in a frame, or listening for one.
    pub rx: Current,
    /// While on and doing neither, with the receiver off.
    pub idle: Current,
    /// While asleep.
    pub sleep: Current,
}

/// What a radio is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RadioState {
    /// Switched off by its owner; hears and sends nothing.
    Sleep,
    /// On, neither sending nor taking in a frame, and drawing next to nothing for it: where a medium
    /// does not look at what listening costs.
    Idle,
    /// On with the receiver running and no frame to take in: draws what receiving draws.
    Listen,
    /// Taking in a frame.
    Receive,
    /// Sending.
    Transmit,
}

impl RadioState {
    /// All states, in the order of their indices.
    pub const ALL: [Self; 5] = [
        Self::Sleep,
        Self::Idle,
        Self::Listen,
        Self::Receive,
        Self::Transmit,
    ];

    /// Its name in summaries and recordings.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Sleep => "sleep",
            Self::Idle => "idle",
            Self::Listen => "listen",
            Self::Receive => "receive",
            Self::Transmit => "transmit",
        }
    }
}

/// Why a radio or a medium cannot be set up as asked. Nothing was added.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RadioError {
    /// A number is outside what makes sense.
    #[error("{what} of {got}: expected {expected}")]
    OutOfRange {
        /// Which number.
        what: &'static str,
        /// Its value.
        got: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// Another radio has the same key, and would get the same random draws.
    #[error("two radios have the key {key:#018x}: each needs a path of its own")]
    DuplicateKey {
        /// The key.
        key: u64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error_model::Cc2420Curve;
    use simbeeotic_units::Frequency;

    fn spec() -> RadioSpec {
        RadioSpec::new(Channel::ieee802154(11).unwrap(), Arc::new(Cc2420Curve))
    }

    #[test]
    fn numbers_that_make_no_sense_are_named() {
        assert_eq!(spec().check(), Ok(()));
        let bad = RadioSpec {
            tx_power: PowerLevel::from_dbm(f64::NAN),
            ..spec()
        };
        assert_eq!(
            bad.check().unwrap_err().to_string(),
            "transmit power of NaN dBm: expected below 80 dBm"
        );
        let channel = Channel {
            centre: Frequency::ZERO,
            ..spec().channel
        };
        assert!(RadioSpec { channel, ..spec() }.check().is_err());
        let sensitivity = PowerLevel::from_dbm(-200.0);
        assert!(
            RadioSpec {
                sensitivity,
                ..spec()
            }
            .check()
            .is_err()
        );
        let antenna = Arc::new(Isotropic {
            gain: Decibels::from_db(f64::INFINITY),
        });
        assert!(RadioSpec { antenna, ..spec() }.check().is_err());
        let currents = Currents {
            idle: Current::si(-1.0),
            ..Currents::default()
        };
        assert!(RadioSpec { currents, ..spec() }.check().is_err());
    }

    #[test]
    fn airtime_counts_bits_not_bytes() {
        // The original's generic radio was off by 125 here: bytes per second taken for kilobits.
        let spec = RadioSpec {
            overhead_bytes: 17,
            ..spec()
        };
        assert!((spec.airtime(4).secs() - 672e-6).abs() < 1e-15);
    }
}
