//! Packets with air time, medium access and interference.

use simbeeotic_model::radio::{Arithmetic as Way, Ieee802154Config, Ieee802154Medium, Medium, Phy};
use simbeeotic_model::units::Decibels;
use simbeeotic_model::{Air, Aside, BuildError, Fidelity, NoiseFloor, choice, medium, params};
use std::sync::Arc;

/// IEEE 802.15.4 without slots, and its kin: packets take their air time, radios assess the channel
/// and wait their turn, frames that overlap interfere, nobody hears while sending; frames to
/// somebody in particular are acknowledged and sent again.
///
/// Motion during a frame is not modelled; frames on different channels do not disturb each other.
/// `range_limit` cuts off signal and interference where `[channel]` has it; `noise_floor.mean` takes the
/// place of each radio's own noise if its `sigma` is zero. A noise that is drawn, with a `sigma`, is that of
/// `simple`: it is left aside with a warning, and each radio keeps its own.
#[medium("ieee802154")]
pub struct Ieee802154;

/// Parameters of [`Ieee802154`].
#[params]
pub struct Ieee802154Params {
    /// Whose receivers and medium access: each radio's own, or one kind for all.
    pub preset: Preset,
    /// How chances are worked out: fast, or by definition and a hundred times slower.
    pub arithmetic: Arithmetic,
    /// How many frames may wait in each radio, besides the one that is being sent; each radio's own
    /// number unless given.
    pub queue: Option<u32>,
}

impl Default for Ieee802154Params {
    fn default() -> Self {
        Self {
            preset: Preset::Radio,
            arithmetic: Arithmetic::Fast,
            queue: None,
        }
    }
}

/// Whose receivers and medium access.
#[choice]
pub enum Preset {
    /// Each radio's own, by its datasheet.
    Radio,
    /// A CC2420 for all: noise -95.5 dBm, channel busy from -77 dBm, sensitivity -95 dBm.
    Cc2420,
    /// ns-3 3.37 for all, with its quirks: noise -106.99 dBm, channel busy from -96.58 dBm, no
    /// sensitivity. For comparisons.
    Ns3,
}

/// How chances are worked out.
#[choice]
pub enum Arithmetic {
    /// In columns and by tables: chances right to 1e-4.
    Fast,
    /// Interval by interval in double precision.
    Exact,
}

impl Fidelity for Ieee802154 {
    type Params = Ieee802154Params;

    fn medium(params: Ieee802154Params, air: &Air) -> Result<Option<Box<dyn Medium>>, BuildError> {
        let mut config = match params.preset {
            Preset::Radio => Ieee802154Config::default(),
            Preset::Cc2420 => Ieee802154Config {
                phy: Some(Phy::cc2420()),
                ..Ieee802154Config::default()
            },
            Preset::Ns3 => Ieee802154Config::ns3(),
        };
        config.seed = air.seed;
        config.propagation = Arc::clone(&air.propagation);
        config.range_limit = air.range_limit;
        config.walls = air.walls;
        config.queue_frames = params.queue.map(|frames| frames as usize);
        config.arithmetic = match params.arithmetic {
            Arithmetic::Fast => Way::Fast,
            Arithmetic::Exact => Way::Exact,
        };
        if let Some(noise) = air.noise_floor.filter(steady) {
            config.noise = Some(noise.mean);
        }
        Ok(Some(Box::new(Ieee802154Medium::new(config)?)))
    }

    fn leaves_aside(air: &Air) -> Vec<Aside> {
        let drawn = air.noise_floor.filter(|noise| !steady(noise));
        let aside = Aside {
            key: "noise_floor",
            message: "has a `sigma`, and `ieee802154` draws no noise: each radio's own noise takes its \
                      place; with `sigma = \"0 dB\"` its mean would",
        };
        drawn.map(|_| aside).into_iter().collect()
    }
}

/// Whether a noise is the same for each packet.
fn steady(noise: &NoiseFloor) -> bool {
    noise.sigma == Decibels::ZERO
}
