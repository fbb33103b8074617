//! Propagation: what the space between two antennas does to the power.
//!
//! A [`Propagation`] answers twice: exactly and one by one ([`Propagation::loss`], f64, decibels; the
//! definition and the oracle of tests), and for a whole row of links at once
//! ([`Propagation::gains`], f32, linear; what a medium asks millions of times a second). Whoever
//! writes a new one starts with `loss` alone and gets `gains` for free, slowly.

use glam::DVec3;
use simbeeotic_kernel::SimTime;
use simbeeotic_units::constants::SPEED_OF_LIGHT;
use simbeeotic_units::{Decibels, Frequency, Position};
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
}

/// Free space: nothing but distance. `loss = 20 log10(4 pi d / lambda)`, never below 0 dB.
///
/// Friis' formula is one of the far field; below `lambda / 4 pi` (1 cm at 2.4 GHz) it would turn into
/// a gain, so the loss stays at 0 dB there: continuous, monotone, and what ns-3 does.
///
/// Source: Friis 1946, Proc. IRE 34(5), eq. 1. Golden: 10 m at 2405 MHz is 60.07 dB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FreeSpace;

impl FreeSpace {
    /// `(lambda / 4 pi)²`, m²: the square of the distance at which the loss is 0 dB.
    fn reference_m2(frequency: Frequency) -> f64 {
        let reference_m = (SPEED_OF_LIGHT / frequency).metres() / (4.0 * std::f64::consts::PI);
        reference_m * reference_m
    }
}

impl Propagation for FreeSpace {
    fn loss(&self, link: &Link) -> Decibels {
        let squared = link.distance_m * link.distance_m;
        Decibels::from_ratio((squared / Self::reference_m2(link.frequency)).max(1.0))
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        let reference_m2 = Self::reference_m2(links.frequency) as f32;
        for (gain, &squared) in gains.iter_mut().zip(links.distances_squared_m2) {
            let held = if squared > reference_m2 {
                squared
            } else {
                reference_m2
            };
            *gain = reference_m2 / held;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link(distance_m: f64) -> Link {
        let end = |east_m| End {
            position: Position::from_si(DVec3::new(east_m, 0.0, 0.0)),
            key: 1,
        };
        Link {
            tx: end(0.0),
            rx: end(distance_m),
            distance_m,
            frequency: Frequency::si(2.405e9),
            frame: 0,
            time: SimTime::ZERO,
        }
    }

    fn loss_db(distance_m: f64) -> f64 {
        FreeSpace.loss(&link(distance_m)).get()
    }

    #[test]
    fn free_space_agrees_with_ns3() {
        // ns-3 3.37, FriisPropagationLossModel at 2405 MHz, 0 dBm sent.
        let table = [
            (0.01, 0.070_084_836),
            (0.1, 20.070_084_836),
            (1.0, 40.070_084_836),
            (10.0, 60.070_084_836),
            (12.5, 62.008_285_096),
            (30.0, 69.612_509_930),
        ];
        for (distance_m, expected_db) in table {
            assert!(
                (loss_db(distance_m) - expected_db).abs() < 1e-6,
                "{distance_m} m"
            );
        }
    }

    #[test]
    fn near_field_never_amplifies() {
        // The original's loss below 1 cm was (d + 1)², a gain.
        let losses: Vec<f64> = (0..2000).map(|i| loss_db(f64::from(i) * 1e-5)).collect();
        assert!(losses.iter().all(|&loss| loss >= 0.0));
        assert!(losses.is_sorted(), "more distance, more loss");
        assert_eq!(losses[0], 0.0);
    }

    #[test]
    fn rows_of_links_agree_with_single_ones() {
        let east: Vec<f32> = (0..500).map(|i| 0.003 * (i * i) as f32).collect();
        let zero = vec![0.0; east.len()];
        let keys = vec![7; east.len()];
        let squares: Vec<f32> = east.iter().map(|x| x * x).collect();
        let links = Links {
            frequency: Frequency::si(2.48e9),
            time: SimTime::ZERO,
            near_is: Role::Receiver,
            near_enu_m: [0.0; 3],
            near_key: 1,
            far_enu_m: [&east, &zero, &zero],
            far_keys: &keys,
            distances_squared_m2: &squares,
            frames: FrameKeys::One(3),
        };
        let mut gains = vec![0.0; links.len()];
        FreeSpace.gains(&links, &mut gains);
        for (j, &gain) in gains.iter().enumerate() {
            let exact = FreeSpace.loss(&links.link(j)).get();
            let fast = -Decibels::from_ratio(f64::from(gain)).get();
            assert!(
                (exact - fast).abs() < 1e-4,
                "{} m: {exact} and {fast} dB",
                east[j]
            );
        }
        assert_eq!(links.link(3).rx.key, 1, "the near end listens");
    }
}
