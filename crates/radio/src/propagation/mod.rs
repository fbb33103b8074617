//! Propagation: what the space between two antennas does to the power.
//!
//! A [`Propagation`] answers twice: exactly and one by one ([`Propagation::loss`], f64, decibels; the
//! definition and the oracle of tests), and for a whole row of links at once
//! ([`Propagation::gains`], f32, linear; what a medium asks millions of times a second). Whoever
//! writes a new one starts with `loss` alone and gets `gains` for free, slowly.

mod composite;
mod free_space;
mod link_table;
mod log_distance;
#[cfg(test)]
pub(crate) mod testing;
mod two_ray;
mod two_ray_exact;

pub use composite::Composite;
pub use free_space::FreeSpace;
pub use link_table::{LinkTable, MissingLink};
pub use log_distance::LogDistance;
pub use two_ray::{TwoRay, TwoRayForm};
pub use two_ray_exact::{Ground, Polarisation, TwoRayExact};

use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::constants::SPEED_OF_LIGHT;
use simbeeotic_units::{Decibels, Frequency, Length, Position};
use std::fmt;

/// One end of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// Where its antenna is.
    pub position: Position,
    /// The radio's identity, see `RadioSpec::key`: what draws that belong to a pair hang on.
    pub key: u64,
}

/// One link at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Who sends.
    pub tx: End,
    /// Who listens.
    pub rx: End,
    /// Distance of the two antennas, metres.
    pub distance_m: f64,
    /// Centre of the channel.
    pub frequency: Frequency,
    /// Identity of the frame: what draws that belong to one transmission hang on (fading).
    pub frame: u64,
    /// When.
    pub time: SimTime,
}

/// A row of links that have one end in common: one receiver and many transmitters, or the reverse.
///
/// All slices have the same length.
#[derive(Clone, Copy, Debug)]
pub struct Links<'a> {
    /// Centre of the channel.
    pub frequency: Frequency,
    /// When.
    pub time: SimTime,
    /// Which role the common end has.
    pub near_is: Role,
    /// The common end: east, north, up, metres.
    pub near_enu_m: [f32; 3],
    /// The radio at the common end.
    pub near_key: u64,
    /// The other ends: east, north, up, metres.
    pub far_enu_m: [&'a [f32]; 3],
    /// The radios at the other ends.
    pub far_keys: &'a [u64],
    /// Squares of the distances, m². NaN where there is no link (nobody hears oneself): whatever gain
    /// is given there is not used.
    pub distances_squared_m2: &'a [f32],
    /// The frames on these links.
    pub frames: FrameKeys<'a>,
}

/// What one end of a link does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It sends.
    Transmitter,
    /// It listens.
    Receiver,
}

/// The identities of the frames on a row of links.
#[derive(Clone, Copy, Debug)]
pub enum FrameKeys<'a> {
    /// One transmitter: one frame on all links.
    One(u64),
    /// Many transmitters: a frame each.
    Each(&'a [u64]),
}

impl Links<'_> {
    /// How many links there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.distances_squared_m2.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The square of the distance of link `j` in `f64`, m², from the places: for models that see phases.
    #[inline(always)]
    fn square_m2(&self, j: usize) -> f64 {
        let axis = |i: usize| f64::from(self.far_enu_m[i][j]) - f64::from(self.near_enu_m[i]);
        let (x, y, z) = (axis(0), axis(1), axis(2));
        x * x + y * y + z * z
    }

    /// Link `j` by itself. Panics unless `j < len()`.
    #[must_use]
    pub fn link(&self, j: usize) -> Link {
        let end = |[x, y, z]: [f32; 3], key| End {
            position: Position::from_si(DVec3::new(x.into(), y.into(), z.into())),
            key,
        };
        let near = end(self.near_enu_m, self.near_key);
        let far = end(self.far_enu_m.map(|axis| axis[j]), self.far_keys[j]);
        let (tx, rx) = match self.near_is {
            Role::Transmitter => (near, far),
            Role::Receiver => (far, near),
        };
        Link {
            tx,
            rx,
            distance_m: (tx.position.si() - rx.position.si()).length(),
            frequency: self.frequency,
            frame: match self.frames {
                FrameKeys::One(key) => key,
                FrameKeys::Each(keys) => keys[j],
            },
            time: self.time,
        }
    }
}

/// What the space between two antennas does to the power.
pub trait Propagation: Send + Sync + fmt::Debug {
    /// Loss from transmitter to receiver, antennas not included. Positive is weaker.
    fn loss(&self, link: &Link) -> Decibels;

    /// The same as power gain, linear: `gains[j] = 10^(-loss / 10)` of link `j`.
    ///
    /// `gains` has the length of `links`. Overwrite this where speed matters; then the gain of a link
    /// must not depend (not in one bit) on which other links are in the row, nor on which end is near.
    /// May be off from [`loss`](Self::loss) by 0.001 dB.
    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        for (j, gain) in gains.iter_mut().enumerate() {
            *gain = (-self.loss(&links.link(j))).ratio() as f32;
        }
    }

    /// What is odd beside the radios that there are, told before a run: names in a file that no radio has.
    /// `radios` are their paths, `bee-0/radio`; they cost something only where they are asked for.
    fn remarks(&self, _radios: &mut dyn Iterator<Item = String>) -> Vec<Remark> {
        Vec::new()
    }
}

/// What is odd about a model of the path beside the radios of a scenario.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// The parameter it is about.
    pub key: &'static str,
    /// Whether the scenario must not run.
    pub fatal: bool,
    /// What is odd, and what was probably meant.
    pub message: String,
}

/// No more than this is ever lost by a model of the path, in decibels: a null is deep, and not infinite.
pub const LOSS_DB_MAX: f64 = 300.0;

/// A loss as it may be: from 0 to [`LOSS_DB_MAX`].
fn least_loss(loss: Decibels) -> Decibels {
    loss.max(Decibels::ZERO).min(Decibels::from_db(LOSS_DB_MAX))
}

/// The same for a gain.
#[inline(always)]
fn held_gain(gain: f64) -> f64 {
    let low = if gain < 1.0 { gain } else { 1.0 };
    if low > GAIN_MIN { low } else { GAIN_MIN }
}

/// [`LOSS_DB_MAX`] as a gain.
const GAIN_MIN: f64 = 1e-30;

/// The wavelength over the circle's `4 pi`, metres: where free space begins to lose.
fn reference_m(frequency: Frequency) -> f64 {
    (SPEED_OF_LIGHT / frequency).metres() / (4.0 * std::f64::consts::PI)
}

/// Antennas on the ground or below it are taken to be so high: a ray that runs along the ground meets
/// its own reflection and ends.
pub const HEIGHT_MIN: Length = Length::si(0.01);
