//! Packets with air time, medium access and interference: IEEE 802.15.4 without slots, and its kin.
//!
//! # What it models
//!
//! A request waits in the radio's queue, then for the channel: unslotted CSMA/CA with the radio's
//! own backoffs and clear channel assessment, or at once ([`Access`](crate::Access)). The
//! frame then takes its air time. Each radio on the same channel that listens takes it up when it
//! begins, if the signal is above the radio's sensitivity and above noise and interference by the radio's
//! least ratio, and if the radio is not already taking in another frame. Of frames that begin at the same
//! nanosecond the strongest is taken up. While a frame lasts, all others are interference:
//!
//! ```text
//! chance of the frame = product over intervals of constant interference of (1 - BER(SINR))^bits
//! ```
//!
//! A radio hears nothing while it sends or turns around. Frames for somebody in particular are
//! acknowledged and, failing that, sent again, where the radios do so ([`Acks`](crate::Acks)); what comes
//! twice is handed over once. A radio that is awake and does not send has its receiver running, and draws
//! what that draws; no event is spent on it.
//!
//! # What it does not model
//!
//! - Motion during a frame (1 to 4 ms): powers are those at its beginning. Time of flight.
//! - Other channels: frames interfere only if their channels are equal.
//! - Errors of the preamble beyond the least ratio; a stronger frame that comes later never takes over.
//! - Slots, beacons, association, security; a frame's headers are bytes, not contents.
//! - The time that a radio takes to wake up.
//!
//! # How it works
//!
//! A state machine for each radio and events in one total order (`agenda`); the air in columns, one
//! pass when a frame begins and one when it ends (`fast`), or by definition (`exact`), which is the measure
//! of the other. Every draw is named by seed, radio and count, or by frame and receiver.

mod act;
mod agenda;
#[cfg(test)]
mod agreement;
mod air;
mod exact;
mod exchange;
mod fast;
mod mac;
mod mail;
mod medium;
mod members;

use crate::phy::Phy;
use crate::propagation::{FreeSpace, Propagation};
use crate::radio::RadioError;
use simbeeotic_units::{Length, PowerLevel, Time};
use std::sync::Arc;

pub use medium::Ieee802154Medium;

/// Settings of the [`Ieee802154Medium`].
#[derive(Clone, Debug)]
pub struct Ieee802154Config {
    /// The run's master seed.
    pub seed: u64,
    /// What the space between the antennas does.
    pub propagation: Arc<dyn Propagation>,
    /// Frames are neither heard nor felt further than this; `None`: power alone decides. Interference
    /// of many frames from beyond is lost with it: keep it where a frame is 10 dB below the noise.
    pub range_limit: Option<Length>,
    /// If given, the noise at each receiver, to which its radio's noise figure is added; else each
    /// radio's own ([`Phy::noise`]).
    pub noise: Option<PowerLevel>,
    /// If given, every radio's [`Phy`] in place of its own.
    pub phy: Option<Phy>,
    /// If given, how many frames may wait in each radio in place of its own number.
    pub queue_frames: Option<usize>,
    /// Whether walls and bodies in the line of sight take their share of the power.
    pub walls: bool,
    /// What of ns-3's behaviour is followed where it is not the standard's.
    pub quirks: Quirks,
    /// How chances are worked out.
    pub arithmetic: Arithmetic,
}

impl Default for Ieee802154Config {
    /// Free space, each radio's own numbers, no walls, no quirks, fast.
    fn default() -> Self {
        Self {
            seed: 0,
            propagation: Arc::new(FreeSpace),
            range_limit: None,
            noise: None,
            phy: None,
            queue_frames: None,
            walls: false,
            quirks: Quirks::None,
            arithmetic: Arithmetic::Fast,
        }
    }
}

impl Ieee802154Config {
    /// All radios as in ns-3 3.37, with its quirks: for comparisons.
    #[must_use]
    pub fn ns3() -> Self {
        Self {
            phy: Some(Phy::ns3()),
            quirks: Quirks::Ns3,
            ..Self::default()
        }
    }

    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// The first that does not.
    pub fn check(&self) -> Result<(), RadioError> {
        let bad = |what, got: String, expected| {
            Err(RadioError::OutOfRange {
                what,
                got,
                expected,
            })
        };
        if let Some(range) = self.range_limit
            && (range.metres().is_nan() || range <= Length::ZERO)
        {
            return bad("range limit", range.to_string(), "more than 0 m");
        }
        if let Some(noise) = self.noise
            && !(-200.0..30.0).contains(&noise.dbm())
        {
            return bad("noise floor", noise.to_string(), "from -200 dBm to 30 dBm");
        }
        self.phy.as_ref().map_or(Ok(()), Phy::check)
    }
}

/// What of ns-3's behaviour is followed where it is not the standard's.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quirks {
    /// Nothing.
    #[default]
    None,
    /// As in ns-3 3.37: interference that ends during a frame counts as if it had not been since the
    /// last frame began (what ends together with the frame does count: signals arrive in the order of
    /// distance, and so do their ends); bits are rounded up in each part of a frame; the energy of an assessment is
    /// the highest seen when a frame begins or the assessment ends, noise not included.
    ///
    /// Parts of a frame end wherever another frame begins on the channel, also one that does not reach
    /// the receiver. That is ns-3's own: with these quirks, radios out of reach do change chances
    /// and signal to noise.
    Ns3,
}

/// How the chances of frames are worked out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Arithmetic {
    /// In columns, with tables: chances are right to about 1e-4.
    #[default]
    Fast,
    /// By definition in f64, interval by interval; 100 times slower.
    Exact,
}

/// How requests fared on their way to the channel, over all radios.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccessStatistics {
    /// Requests taken into a queue.
    pub requests: u64,
    /// Frames given up because the channel stayed busy.
    pub failures: u64,
    /// Requests whose frame went on the air, at the first attempt of each.
    pub transmitted: u64,
    /// From the request to the beginning of its first frame, summed over these.
    pub delay: Time,
}
