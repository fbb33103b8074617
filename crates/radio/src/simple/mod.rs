//! The medium of the paper: no air time, no interference, luck by signal over noise.
//!
//! # What it models
//!
//! A frame reaches, at the instant it is sent, every radio that is awake on the same channel within the
//! range limit, except its sender. Each of these receives it with
//!
//! ```text
//! received power = power sent + antenna gains - propagation loss
//! ```
//!
//! Below the radio's sensitivity it is lost. Else noise is drawn, normal in dB with the medium's mean
//! and sigma, independently for each frame and receiver, and the radio's error model says how likely
//! the frame survives that ratio of signal to noise.
//!
//! Instead, [`Delivery`] may say outright with which chance a frame within range gets through: over
//! distance ([`DeliveryCurve`], Bernoulli trials), or over distance and by the state that the link is in
//! ([`GilbertElliott`], losses in bursts). Sensitivity, noise and error model are not asked then, and what
//! is lost counts as lost by noise.
//!
//! # What it does not model
//!
//! Collisions, a busy channel, half duplex, delay: 550 radios that all speak at the same moment hear
//! each other; on a real IEEE 802.15.4 channel about 2 % of these frames would get through. Charge
//! is booked as if frames took their air time: to the sender for each frame, to a receiver for each that
//! gets through, and once where they overlap.
//!
//! # How it works
//!
//! One pass over columns for each frame, or, if many frames are sent in one round, one pass for each
//! receiver, in parallel. Both go through the functions of `pair`, and agree to the bit. The noise is
//! folded into a table of the chance of reception over received power (`success`); one hashed draw,
//! named by seed, frame and receiver, decides.
//!
//! In a band that is wide against the reach of its frames, most pairs are out of range. A grid (`near`)
//! finds those that may not be. By frame, it is a grid of the members as they were some time ago, searched
//! farther by what they may have travelled since ([`Poses::odometer`](crate::Poses::odometer)), so that
//! radios that each send at a time of their own do not pay for the positions of all others. By receiver, it
//! is one of the frames of this round, and what receivers in one cube may hear is gathered for all of them
//! at once (`party`). Which way is taken is a matter of cost, and changes no bit.
//!
//! Pairs are worked in f32. Within 10 km of the origin a coordinate is then right to half a millimetre,
//! and the power over 1 m or more to 0.01 dB. The reported RSSI is that power; only the chance of
//! reception goes through the table, which is at most 0.017 dB off.

mod band;
mod chance;
mod medium;
mod near;
mod pair;
mod party;
mod radio;
mod receive;
mod success;

use crate::propagation::{FreeSpace, Propagation};
use crate::radio::RadioError;
use simbeeotic_units::{Decibels, Length, PowerLevel};
use std::sync::Arc;

pub use chance::{Delivery, DeliveryCurve, GilbertElliott};
pub use medium::SimpleMedium;

/// Settings of the [`SimpleMedium`].
#[derive(Clone, Debug)]
pub struct SimpleConfig {
    /// The run's master seed.
    pub seed: u64,
    /// Frames reach no further than this. The original's default is 10 m, the paper's experiment
    /// takes 30 m. May be infinite.
    pub range_limit: Length,
    /// Mean level of the noise.
    pub noise_floor: PowerLevel,
    /// Standard deviation of the noise, drawn in dB for each reception.
    pub noise_sigma: Decibels,
    /// What the space between the antennas does.
    pub propagation: Arc<dyn Propagation>,
    /// What decides whether a frame within range is received.
    pub delivery: Delivery,
    /// Whether walls and bodies between two antennas take their share of the power, as
    /// [`Poses::obstruction`](crate::Poses::obstruction) says.
    pub walls: bool,
    /// A band is searched by grid if a frame reaches less than this share of it: 0 is never, infinity
    /// always, but for an infinite range. A matter of speed only: results are the same.
    pub grid_below: f64,
    /// From how many frames in one round on each receiver looks for itself, in parallel. A matter of
    /// speed only: results are the same.
    pub by_receiver_from: usize,
}

impl Default for SimpleConfig {
    /// The original's: 10 m, noise of -100 dBm with a sigma of 10 dB, free space.
    fn default() -> Self {
        Self {
            seed: 0,
            range_limit: Length::from_metres(10.0),
            noise_floor: PowerLevel::from_dbm(-100.0),
            noise_sigma: Decibels::from_db(10.0),
            propagation: Arc::new(FreeSpace),
            delivery: Delivery::Noise,
            walls: false,
            grid_below: 0.2,
            by_receiver_from: 16,
        }
    }
}

impl SimpleConfig {
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
        let (range, floor, sigma) = (self.range_limit, self.noise_floor, self.noise_sigma);
        if range.metres().is_nan() || range <= Length::ZERO {
            return bad("range limit", range.to_string(), "more than 0 m");
        }
        if !(-200.0..30.0).contains(&floor.dbm()) {
            return bad("noise floor", floor.to_string(), "from -200 dBm to 30 dBm");
        }
        if !(0.0..=100.0).contains(&sigma.db()) {
            return bad("noise sigma", sigma.to_string(), "from 0 dB to 100 dB");
        }
        match &self.delivery {
            Delivery::Switching(channel) => channel.check(),
            Delivery::Noise | Delivery::Chance(_) => Ok(()),
        }
    }
}
