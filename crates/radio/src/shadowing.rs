//! Shadowing: what is in the way and nobody drew into the map, as chance.
//!
//! A link loses `X` dB more than the path loss says, with `X` normal, of mean 0 and standard deviation
//! `sigma`; it is the same in both directions, and stays while nobody moves. There are two kinds.
//!
//! # A field over both ends
//!
//! ```text
//! W(a, b) = sqrt(2 / N) sum_i cos(k_i a + l_i b + phi_i)                                   (1)
//! X(a, b) = sigma (W(a, b) + W(b, a)) / sqrt(2 + 2 exp(-2 |a - b| / dc))                   (2)
//! ```
//! The phases `phi` are even on the circle, the wave vectors `k` and `l` independent, from the
//! three-dimensional Cauchy distribution of scale `1 / dc`, whose characteristic function is
//! `exp(-|r| / dc)`. So over all seeds, without approximation:
//!
//! ```text
//! E W(a, b) W(a', b') = exp(-|a - a'| / dc) exp(-|b - b'| / dc)                            (3)
//! ```
//! - the mean of `X` is 0 and its variance `sigma^2`, at every place and distance;
//! - `X(a, b) = X(b, a)`, to the last bit;
//! - if one end moves by `s` and the other stays, two readings are correlated by `exp(-s / dc)`, which is
//!   Gudmundson's law; if both move, by the product. That is (3) alone: exact where the ends are far apart,
//!   and off by the other two of (2)'s products, `exp(-2 |a - b| / dc)` and less, where they come close.
//!
//! With `N = 16` waves, each for two ends, `X` is nearly normal: its excess kurtosis is -0.05, and it stays
//! within 8 sigma. In one run the correlation over distance is that of the 16 waves drawn, which scatters by
//! about 0.15 around the law. The field has no period and no edge.
//!
//! Sources: Gudmundson 1991, Electronics Letters 27(23) (the law); Wang, Tameh, Nix 2008, IEEE Trans.
//! Vehicular Technology 57(1) (both ends moving, as a sum of sinusoids). Both from memory.
//!
//! # A draw for each pair of radios
//!
//! `X` hangs on the two radios and not on where they are: frozen. Right for a network that does not move,
//! or where each link shall be a draw of its own.

use crate::fast::{self, shares};
use crate::propagation::{Link, Links};
use glam::DVec3;
use simbeeotic_kernel::rng::{Stream, draw_u64, path_key};
use simbeeotic_units::{Decibels, Length, math};
use std::f64::consts::{LOG2_10, PI, TAU};
use std::fmt;

/// Waves of a field, for each of the two orders of the ends.
const WAVES: usize = 16;
/// No wave is shorter than the correlation distance by more than this, over `2 pi`: a share of 0.6 % of
/// the distribution is held here. Beyond, the phases of far places would lose their digits.
const WAVE_NUMBER_MAX: f64 = 200.0;
/// How many links are worked on at a time.
const CHUNK: usize = 64;

/// Log-normal shadowing of all links of a run: see the [module](self).
pub struct Shadowing {
    sigma_db: f64,
    kind: Kind,
}

enum Kind {
    Field(Box<Field>),
    /// The key that the draws hang on.
    Links(u64),
}

/// Equation 1, in turns.
struct Field {
    /// Of the first end, then of the second: turns for each metre along each axis.
    waves: [[[f32; WAVES]; 3]; 2],
    phases: [f32; WAVES],
    /// Correlation distance, metres.
    distance_m: f64,
}

impl Shadowing {
    /// A field of standard deviation `sigma` (0 or more) with this correlation distance (1 m or more).
    #[must_use]
    pub fn field(seed: u64, sigma: Decibels, distance: Length) -> Self {
        Self {
            sigma_db: sigma.db(),
            kind: Kind::Field(Box::new(Field::new(seed, distance.metres()))),
        }
    }

    /// A draw for each pair of radios, of standard deviation `sigma` (0 or more).
    #[must_use]
    pub fn links(seed: u64, sigma: Decibels) -> Self {
        let key = draw_u64(seed, path_key("radio"), path_key("shadowing"));
        Self {
            sigma_db: sigma.db(),
            kind: Kind::Links(key),
        }
    }

    /// What a link loses more than its path loss; negative where it loses less.
    #[must_use]
    pub fn loss(&self, link: &Link) -> Decibels {
        let normal = match &self.kind {
            Kind::Field(field) => {
                let place = |position: DVec3| position.as_vec3().to_array();
                let (tx, rx) = (link.tx.position.si(), link.rx.position.si());
                let near = field.near(place(tx));
                let sum = f64::from(near.sum(place(rx)));
                let apart = math::exp(-2.0 * link.distance_m / field.distance_m);
                sum / (WAVES as f64 * (1.0 + apart)).sqrt()
            }
            Kind::Links(key) => {
                let [a, b] = shares(pair(*key, link.tx.key, link.rx.key)).map(f64::from);
                (-2.0 * math::ln(a)).sqrt() * math::cos(TAU * b)
            }
        };
        Decibels::from_db(self.sigma_db * normal)
    }

    /// Multiplies the gains of a row by `10^(-loss / 10)`, off by 0.001 dB at most.
    pub fn shade(&self, links: &Links<'_>, gains: &mut [f32]) {
        let per_sigma = (-0.1 * LOG2_10 * self.sigma_db) as f32;
        match &self.kind {
            Kind::Field(field) => field.shade(links, per_sigma, gains),
            Kind::Links(key) => {
                for (gain, &far) in gains.iter_mut().zip(links.far_keys) {
                    let [a, b] = shares(pair(*key, links.near_key, far));
                    let normal = (-2.0 * fast::ln(a)).sqrt() * fast::sin_cos_turns_f32(b)[1];
                    *gain *= fast::exp2(per_sigma * normal);
                }
            }
        }
    }
}

impl fmt::Debug for Shadowing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "shadowing of {} dB", self.sigma_db)
    }
}

/// The draw of a pair, whichever is which.
fn pair(key: u64, a: u64, b: u64) -> u64 {
    draw_u64(key, a.min(b), a.max(b))
}

impl Field {
    fn new(seed: u64, distance_m: f64) -> Self {
        let mut stream = Stream::new(seed, "radio", "shadowing");
        let mut waves = [[[0.0; WAVES]; 3]; 2];
        for end in &mut waves {
            // Sizes in even shares of their distribution, in a random order: the mean over the waves is
            // that of the distribution as before, with less scatter.
            let mut sizes: [f64; WAVES] =
                std::array::from_fn(|i| cauchy_size((i as f64 + stream.uniform()) / WAVES as f64));
            stream.shuffle(&mut sizes);
            for (i, size) in sizes.into_iter().enumerate() {
                let vector = stream.unit_vector() * (size / (distance_m * TAU));
                for (axis, turns) in vector.to_array().into_iter().enumerate() {
                    end[axis][i] = turns as f32;
                }
            }
        }
        Self {
            waves,
            phases: std::array::from_fn(|_| stream.uniform() as f32),
            distance_m,
        }
    }

    fn near(&self, place: [f32; 3]) -> Near<'_> {
        Near {
            field: self,
            turns: [self.turns(0, place), self.turns(1, place)],
        }
    }

    fn turns(&self, order: usize, [x, y, z]: [f32; 3]) -> [f32; WAVES] {
        let [kx, ky, kz] = &self.waves[order];
        std::array::from_fn(|i| kx[i] * x + ky[i] * y + kz[i] * z)
    }

    fn shade(&self, links: &Links<'_>, per_sigma: f32, gains: &mut [f32]) {
        let near = self.near(links.near_enu_m);
        let per_root_m = (-2.0 * std::f64::consts::LOG2_E / self.distance_m) as f32;
        let scale = 1.0 / WAVES as f32;
        let mut first = 0;
        while first < gains.len() {
            let n = CHUNK.min(gains.len() - first);
            let [x, y, z] = links.far_enu_m.map(|axis| &axis[first..][..n]);
            let squares = &links.distances_squared_m2[first..][..n];
            let mut sums = [0.0; CHUNK];
            near.sums([x, y, z], &mut sums[..n]);
            let gains = &mut gains[first..][..n];
            for j in 0..n {
                let apart = fast::exp2(per_root_m * squares[j].sqrt());
                let normal = sums[j] * (scale / (1.0 + apart)).sqrt();
                gains[j] *= fast::exp2(per_sigma * normal);
            }
            first += n;
        }
    }
}

/// A field with one end in its place.
struct Near<'a> {
    field: &'a Field,
    /// What this end adds to the phases, as the first end of a wave and as the second.
    turns: [[f32; WAVES]; 2],
}

impl Near<'_> {
    /// `W(a, b) + W(b, a)`, without the factor.
    fn sum(&self, far: [f32; 3]) -> f32 {
        let mut sum = [0.0];
        self.sums([&[far[0]], &[far[1]], &[far[2]]], &mut sum);
        sum[0]
    }

    /// The same for many, added to `sums`. Wave by wave: the same order of sums for each link, in loops that
    /// become vector code. No sum hangs on which end is near: each has two terms that change places.
    fn sums(&self, far: [&[f32]; 3], sums: &mut [f32]) {
        let n = sums.len();
        let [x, y, z] = far.map(|axis| &axis[..n]);
        for wave in 0..WAVES {
            let [kx, ky, kz] = [0, 1, 2].map(|axis| self.field.waves[0][axis][wave]);
            let [lx, ly, lz] = [0, 1, 2].map(|axis| self.field.waves[1][axis][wave]);
            let (first, second) = (self.turns[0][wave], self.turns[1][wave]);
            let phase = self.field.phases[wave];
            for j in 0..n {
                let k = kx * x[j] + ky * y[j] + kz * z[j];
                let l = lx * x[j] + ly * y[j] + lz * z[j];
                sums[j] += fast::wave((first + l) + phase) + fast::wave((second + k) + phase);
            }
        }
    }
}

/// The size of a vector of the three-dimensional Cauchy distribution of scale 1, by its quantile `u`:
/// `u = (2 / pi) (atan s - s / (1 + s^2))`.
fn cauchy_size(u: f64) -> f64 {
    // In angles, s = tan t: 2 t - sin 2 t = pi u. Newton's steps from a start for small angles, where
    // the left side is 4/3 t^3; it is convex, so that they come from above after the first.
    let mut t = math::pow(0.75 * PI * u, 1.0 / 3.0).min(0.5 * PI);
    for _ in 0..10 {
        let (sin, cos) = math::sin_cos(2.0 * t);
        let slope = 2.0 - 2.0 * cos;
        if slope > 0.0 {
            t = (t - (2.0 * t - sin - u * PI) / slope).clamp(0.0, 0.5 * PI);
        }
    }
    let size = math::tan(t);
    if (0.0..WAVE_NUMBER_MAX).contains(&size) {
        size
    } else {
        WAVE_NUMBER_MAX
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagation::Role;
    use crate::propagation::testing::{along, between, with_row};

    const SIGMA_DB: f64 = 4.0;
    const DISTANCE_M: f64 = 10.0;

    fn field(seed: u64) -> Shadowing {
        Shadowing::field(
            seed,
            Decibels::from_db(SIGMA_DB),
            Length::from_metres(DISTANCE_M),
        )
    }

    fn frozen(seed: u64) -> Shadowing {
        Shadowing::links(seed, Decibels::from_db(SIGMA_DB))
    }

    /// Mean, standard deviation, excess kurtosis.
    fn moments(values: &[f64]) -> [f64; 3] {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares = || values.iter().map(|x| (x - mean) * (x - mean));
        let second = squares().sum::<f64>() / n;
        let fourth = squares().map(|square| square * square).sum::<f64>() / n;
        [mean, second.sqrt(), fourth / (second * second) - 3.0]
    }

    fn correlation(pairs: &[(f64, f64)]) -> f64 {
        // Means are 0 and variances sigma^2 by the other tests.
        let sum: f64 = pairs.iter().map(|(a, b)| a * b).sum();
        sum / pairs.len() as f64 / (SIGMA_DB * SIGMA_DB)
    }

    #[test]
    fn sizes_of_waves_are_quantiles_of_the_cauchy_distribution() {
        for size in [0.01, 0.3, 1.0, 5.0, 60.0] {
            let u = 2.0 / PI * (math::atan(size) - size / (1.0 + size * size));
            assert!((cauchy_size(u) / size - 1.0).abs() < 1e-9, "{size}");
        }
    }

    /// Equation 3 over seeds: 10,000 of them scatter by 0.01 sigma.
    #[test]
    fn over_seeds_the_field_is_normal_with_sigma_at_every_distance() {
        for apart_m in [0.5, 3.0, 200.0] {
            let link = between(
                DVec3::new(3.0, -7.0, 2.0),
                DVec3::new(3.0 + apart_m, -7.0, 2.0),
            );
            let losses: Vec<f64> = (0..10_000)
                .map(|seed| field(seed).loss(&link).db())
                .collect();
            let [mean, sigma, kurtosis] = moments(&losses);
            assert!(mean.abs() < 0.13, "mean {mean} at {apart_m} m");
            assert!(
                (sigma / SIGMA_DB - 1.0).abs() < 0.02,
                "sigma {sigma} at {apart_m} m"
            );
            assert!(
                kurtosis.abs() < 0.2,
                "excess kurtosis {kurtosis} at {apart_m} m"
            );
        }
    }

    #[test]
    fn one_moving_end_follows_gudmundson_and_two_the_product() {
        let place = |east: f64| DVec3::new(east, 40.0, 5.0);
        for (step_m, both) in [
            (1.0, false),
            (5.0, false),
            (10.0, false),
            (25.0, false),
            (5.0, true),
        ] {
            let pairs: Vec<(f64, f64)> = (0..10_000)
                .map(|seed| {
                    let field = field(seed);
                    let here = between(DVec3::ZERO, place(200.0));
                    let moved = DVec3::new(0.0, if both { step_m } else { 0.0 }, 0.0);
                    let there = between(moved, place(200.0 + step_m));
                    (field.loss(&here).db(), field.loss(&there).db())
                })
                .collect();
            let way_m = if both { 2.0 * step_m } else { step_m };
            let want = math::exp(-way_m / DISTANCE_M);
            let got = correlation(&pairs);
            assert!(
                (got - want).abs() < 0.03,
                "{step_m} m, both {both}: {got}, not {want}"
            );
        }
    }

    #[test]
    fn one_run_over_many_places_has_the_same_statistics() {
        let mut stream = Stream::new(3, "tests", "places");
        let mut place = || {
            let (east, north) = (
                stream.uniform_in(0.0..2000.0),
                stream.uniform_in(0.0..2000.0),
            );
            DVec3::new(east, north, stream.uniform_in(0.0..50.0))
        };
        for shadowing in [field(5), frozen(5)] {
            let losses: Vec<f64> = (0..20_000u64)
                .map(|i| {
                    let mut link = between(place(), place());
                    (link.tx.key, link.rx.key) = (i, i + 1_000_000);
                    shadowing.loss(&link).db()
                })
                .collect();
            let [mean, sigma, kurtosis] = moments(&losses);
            assert!(mean.abs() < 0.12, "mean {mean}");
            assert!((sigma / SIGMA_DB - 1.0).abs() < 0.03, "sigma {sigma}");
            assert!(kurtosis.abs() < 0.2, "excess kurtosis {kurtosis}");
        }
    }

    #[test]
    fn both_directions_are_one_to_the_last_bit_in_rows_and_alone() {
        for shadowing in [field(1), frozen(1)] {
            for near_is in [Role::Receiver, Role::Transmitter] {
                with_row(&along(300, 3.0), near_is, |links| {
                    let mut gains = vec![1.0; links.len()];
                    shadowing.shade(links, &mut gains);
                    for (j, &gain) in gains.iter().enumerate() {
                        let link = links.link(j);
                        let back = Link {
                            tx: link.rx,
                            rx: link.tx,
                            ..link
                        };
                        let exact = shadowing.loss(&link);
                        assert_eq!(exact, shadowing.loss(&back));
                        let fast = -Decibels::from_ratio(f64::from(gain)).db();
                        assert!((fast - exact.db()).abs() < 1e-3, "{fast} and {exact}");
                    }
                });
            }
            // The far end of one row is the near end of another.
            let (a, b) = ([0.25f32, -0.5, 1.5], [30.7f32, 11.3, 4.2]);
            let row = |near: [f32; 3], far: [f32; 3], near_key: u64, far_key: u64| {
                let square: f32 = (0..3)
                    .map(|i| (near[i] - far[i]) * (near[i] - far[i]))
                    .sum();
                let far = far.map(|x| [x]);
                let mut gain = [1.0];
                let links = Links {
                    frequency: crate::propagation::testing::CHANNEL,
                    time: simbeeotic_kernel::SimTime::ZERO,
                    near_is: Role::Transmitter,
                    near_enu_m: near,
                    near_key,
                    far_enu_m: [&far[0], &far[1], &far[2]],
                    far_keys: &[far_key],
                    distances_squared_m2: &[square],
                    frames: crate::propagation::FrameKeys::One(1),
                };
                shadowing.shade(&links, &mut gain);
                gain[0]
            };
            assert_eq!(row(a, b, 1, 2), row(b, a, 2, 1));
        }
    }

    #[test]
    fn a_frozen_link_does_not_care_where_its_ends_are() {
        let shadowing = frozen(9);
        let link = between(DVec3::ZERO, DVec3::X);
        let moved = between(DVec3::ZERO, DVec3::X * 50.0);
        assert_eq!(shadowing.loss(&link), shadowing.loss(&moved));
        let mut other = link;
        other.rx.key = 5000;
        assert_ne!(shadowing.loss(&link), shadowing.loss(&other));
        assert_ne!(frozen(10).loss(&link), shadowing.loss(&link));
    }

    #[test]
    fn seeds_give_fields_of_their_own() {
        let link = between(DVec3::ZERO, DVec3::X * 30.0);
        let pairs: Vec<(f64, f64)> = (0..20_000)
            .map(|seed| {
                (
                    field(seed).loss(&link).db(),
                    field(seed + 1).loss(&link).db(),
                )
            })
            .collect();
        assert!(correlation(&pairs).abs() < 0.03);
    }
}
