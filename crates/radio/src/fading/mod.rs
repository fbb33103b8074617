//! Fading: echoes that add up differently for each frame and receiver.
//!
//! A link gains a factor `g` more than path loss and shadowing say, drawn for each frame and receiver, with
//! mean 1: fading takes as much power as it gives, on the average. Draws are named by (frame, receiver), so
//! that they hang on no order and no thread. They are independent of each other: two frames a millisecond
//! apart on one link, too, which is right if the vehicles move by half a wavelength (6 cm at 2.4 GHz) in
//! between, and hard on retries if they do not.
//!
//! | model | density of `g` | stands for |
//! |---|---|---|
//! | [`Rayleigh`] | `exp(-g)` | echoes only, no line of sight |
//! | [`Rician`] | `(1 + K) exp(-K - (1 + K) g) I0(2 sqrt(K (1 + K) g))` | a line of sight, `K` times as strong as the echoes |
//! | [`Nakagami`] | `m^m g^(m - 1) exp(-m g) / Gamma(m)` | a fit: `m = 1` is Rayleigh, less is worse, more is milder |

mod nakagami;
mod rayleigh;
mod rician;

pub use nakagami::Nakagami;
pub use rayleigh::Rayleigh;
pub use rician::Rician;

use crate::propagation::{FrameKeys, Link, Links, Role};
use simbeeotic_kernel::rng::{draw_u64, path_key};
use std::fmt;

/// What echoes do to the power of one frame at one receiver.
///
/// Whoever writes a new one starts with `gain` alone and gets `fade` for free, slowly.
pub trait Fading: Send + Sync + fmt::Debug {
    /// The power gain of a draw of 64 even bits over a distance in metres: linear, not negative, of mean 1
    /// over the draws.
    fn gain(&self, draw: u64, distance_m: f64) -> f64;

    /// Multiplies `gains[j]` by the gain of `draws[j]` over the distance whose square is
    /// `distances_squared_m2[j]`. The slices have the same length. May be off by 0.001 dB, but where the
    /// gain is below 1e-6; must not depend on what else is in the row.
    fn fade(&self, draws: &[u64], distances_squared_m2: &[f32], gains: &mut [f32]) {
        for ((gain, &draw), &square) in gains.iter_mut().zip(draws).zip(distances_squared_m2) {
            *gain *= self.gain(draw, f64::from(square).sqrt()) as f32;
        }
    }
}

/// How many links are worked on at a time.
const CHUNK: usize = 64;

/// What fading's draws are named after, besides frame and receiver.
const PURPOSE: u64 = path_key("radio/fading");

/// The draw of a frame at a receiver. The frame's key has the seed in it.
fn draw(frame: u64, receiver: u64) -> u64 {
    draw_u64(frame, receiver, PURPOSE)
}

/// The gain of one link.
pub(crate) fn gain(fading: &dyn Fading, link: &Link) -> f64 {
    fading.gain(draw(link.frame, link.rx.key), link.distance_m)
}

/// Multiplies the gains of a row of links.
pub(crate) fn fade(fading: &dyn Fading, links: &Links<'_>, gains: &mut [f32]) {
    let mut draws = [0; CHUNK];
    for first in (0..gains.len()).step_by(CHUNK) {
        let range = first..gains.len().min(first + CHUNK);
        let draws = &mut draws[..range.len()];
        for (to, j) in draws.iter_mut().zip(range.clone()) {
            let frame = match links.frames {
                FrameKeys::One(key) => key,
                FrameKeys::Each(keys) => keys[j],
            };
            let receiver = match links.near_is {
                Role::Receiver => links.near_key,
                Role::Transmitter => links.far_keys[j],
            };
            *to = draw(frame, receiver);
        }
        let squares = &links.distances_squared_m2[range.clone()];
        fading.fade(draws, squares, &mut gains[range]);
    }
}

#[cfg(test)]
pub(crate) mod testing {
    use super::*;
    use simbeeotic_kernel::rng::mix;
    use simbeeotic_units::math;

    /// Gains of many draws over a distance, the fast way, after checking them against the exact one.
    pub(crate) fn sample(fading: &dyn Fading, n: usize, distance_m: f32) -> Vec<f64> {
        let draws: Vec<u64> = (0..n as u64).map(|i| mix(i + 17)).collect();
        let mut gains = vec![1.0f32; n];
        fading.fade(&draws, &vec![distance_m * distance_m; n], &mut gains);
        for (&gain, &draw) in gains.iter().zip(&draws).step_by(97) {
            let exact = fading.gain(draw, distance_m.into());
            let error_db = 10.0 * math::log10(f64::from(gain) / exact);
            assert!(
                error_db.abs() < 1e-3 || exact < 1e-6,
                "{gain} for {exact} of {fading:?}"
            );
        }
        gains.into_iter().map(f64::from).collect()
    }

    pub(crate) fn mean(values: &[f64]) -> f64 {
        values.iter().sum::<f64>() / values.len() as f64
    }

    /// The largest difference between the distribution of a sample and a cumulative one (Kolmogorov, Smirnov),
    /// times the root of their number: above 1.95 once in a thousand.
    pub(crate) fn distance(mut values: Vec<f64>, below: impl Fn(f64) -> f64) -> f64 {
        values.sort_by(f64::total_cmp);
        let n = values.len() as f64;
        let each = values.iter().enumerate().map(|(i, &value)| {
            let expected = below(value);
            (expected - i as f64 / n)
                .abs()
                .max((expected - (i + 1) as f64 / n).abs())
        });
        each.fold(0.0, f64::max) * n.sqrt()
    }
}
