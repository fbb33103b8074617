//! A named stream of random numbers.

use super::{key::mix, path_key, philox::philox4x32};
use simbeeotic_units::{glam::DVec3, math};
use std::ops::Range;

/// A stream of random numbers, a function of (master seed, path of the part, purpose) alone.
///
/// 24 bytes: the key, the number of 64-bit words drawn, and the half of a Philox block that is still
/// to be given out. Plain data: a clone goes on with the same numbers.
///
/// ```
/// use simbeeotic_kernel::rng::Stream;
///
/// let mut noise = Stream::new(111_982, "bee-17/compass", "noise");
/// let mut again = Stream::new(111_982, "bee-17/compass", "noise");
/// assert_eq!(noise.next_u64(), again.next_u64());
/// assert!((0.0..1.0).contains(&noise.uniform()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stream {
    key: u64,
    n: u64,
    spare: u64,
}

const _: () = assert!(size_of::<Stream>() == 24);

impl Stream {
    /// The stream of the part at `path` for `purpose` under a master seed.
    #[must_use]
    pub const fn new(seed: u64, path: &str, purpose: &str) -> Self {
        Self::keyed(seed, path_key(path), purpose)
    }

    /// The same with the path's key at hand: `keyed(s, path_key(p), q)` equals `new(s, p, q)`.
    #[must_use]
    pub const fn keyed(seed: u64, path_key: u64, purpose: &str) -> Self {
        // The seed is scrambled first: seeds 1, 2, 3 must not give keys that differ in a pattern,
        // or their streams would be each other's shifted copies.
        let key = mix(mix(mix(seed) ^ path_key) ^ self::path_key(purpose));
        Self {
            key,
            n: 0,
            spare: 0,
        }
    }

    /// How many 64-bit words have been drawn.
    #[must_use]
    pub const fn drawn(&self) -> u64 {
        self.n
    }

    /// The next 64 random bits.
    #[inline]
    pub const fn next_u64(&mut self) -> u64 {
        let n = self.n;
        self.n = n.wrapping_add(1);
        if n & 1 == 1 {
            return self.spare;
        }
        let block = n >> 1;
        let [a, b, c, d] = philox4x32(
            [block as u32, (block >> 32) as u32, 0, 0],
            [self.key as u32, (self.key >> 32) as u32],
        );
        self.spare = (d as u64) << 32 | c as u64;
        (b as u64) << 32 | a as u64
    }

    /// Uniform in [0, 1), a multiple of 2^-53.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        (self.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in (0, 1): an odd multiple of 2^-53, never 0 and never 1. For logarithms and quantiles.
    #[inline]
    pub fn uniform_open(&mut self) -> f64 {
        ((self.next_u64() >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64)
    }

    /// Uniform in `range`, start included, end excluded. An empty range gives its start.
    ///
    /// Both ends must be finite and their difference too.
    #[inline]
    pub fn uniform_in(&mut self, range: Range<f64>) -> f64 {
        let x = range.start + (range.end - range.start) * self.uniform();
        if x < range.end {
            x
        } else {
            // Rounded up to the end (or the range is empty): the largest number below it.
            range.end.next_down().max(range.start)
        }
    }

    /// A whole number in 0..n, each equally likely (no modulo bias); 0 if `n` is 0.
    ///
    /// Source: Lemire 2019, "Fast random integer generation in an interval", ACM TOMACS 29(1).
    #[inline]
    pub fn below(&mut self, n: u64) -> u64 {
        let mut product = u128::from(self.next_u64()) * u128::from(n);
        if (product as u64) < n {
            let threshold = n.wrapping_neg() % n;
            while (product as u64) < threshold {
                product = u128::from(self.next_u64()) * u128::from(n);
            }
        }
        (product >> 64) as u64
    }

    /// True with probability `p`: never for p <= 0 or NaN, always for p >= 1.
    #[inline]
    pub fn bernoulli(&mut self, p: f64) -> bool {
        self.uniform() < p
    }

    /// Normal with mean 0 and standard deviation 1, by inversion: one draw each, |x| < 8.3.
    #[inline]
    pub fn normal(&mut self) -> f64 {
        math::normal_quantile(self.uniform_open())
    }

    /// Exponential with mean 1, always positive, by inversion: one draw each. Scale by the mean.
    #[inline]
    pub fn exponential(&mut self) -> f64 {
        -math::ln(self.uniform_open())
    }

    /// Puts `items` in an order drawn uniformly from all orders (Fisher-Yates).
    pub fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            let pick = self.below(last as u64 + 1) as usize;
            items.swap(last, pick);
        }
    }

    /// A direction drawn uniformly from the sphere, length 1 within rounding.
    ///
    /// Source: Marsaglia 1972, "Choosing a point from the surface of a sphere", Ann. Math. Stat. 43(2).
    pub fn unit_vector(&mut self) -> DVec3 {
        loop {
            let (a, b) = (2.0 * self.uniform() - 1.0, 2.0 * self.uniform() - 1.0);
            let s = a * a + b * b;
            if s < 1.0 {
                let root = 2.0 * (1.0 - s).sqrt();
                return DVec3::new(a * root, b * root, 1.0 - 2.0 * s);
            }
        }
    }

    /// A point drawn uniformly from the ball of this radius around the origin, in the unit of `radius`.
    ///
    /// Takes points of the cube until one lies in the ball: 5.7 draws on average.
    pub fn in_ball(&mut self, radius: f64) -> DVec3 {
        loop {
            let [x, y, z] = std::array::from_fn(|_| 2.0 * self.uniform() - 1.0);
            let point = DVec3::new(x, y, z);
            if point.length_squared() <= 1.0 {
                return point * radius;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stream() -> Stream {
        Stream::new(1, "bee-1", "test")
    }

    /// Mean and variance of `n` numbers.
    fn moments(n: u32, mut draw: impl FnMut() -> f64) -> (f64, f64) {
        let (mut sum, mut squares) = (0.0, 0.0);
        for _ in 0..n {
            let x = draw();
            sum += x;
            squares += x * x;
        }
        let mean = sum / f64::from(n);
        (mean, squares / f64::from(n) - mean * mean)
    }

    #[test]
    fn streams_stay_what_they_are() {
        // Recorded runs depend on these numbers: they may never change.
        let mut s = Stream::new(111_982, "bee-0", "walk");
        let words = [s.next_u64(), s.next_u64(), s.next_u64()];
        assert_eq!(words, GOLDEN, "{words:#018x?}");
    }
    const GOLDEN: [u64; 3] = [
        0xd3d5_609b_6adc_8896,
        0xc3cd_e79d_8f5f_868b,
        0xc7c9_fbf9_7f77_e8aa,
    ];

    #[test]
    fn the_first_words_are_the_philox_block_of_the_key() {
        let mut s = stream();
        let [a, b, c, d] = philox4x32([0; 4], [s.key as u32, (s.key >> 32) as u32]);
        assert_eq!(s.next_u64(), u64::from(b) << 32 | u64::from(a));
        assert_eq!(s.next_u64(), u64::from(d) << 32 | u64::from(c));
        assert_eq!(s.drawn(), 2);
    }

    #[test]
    fn every_part_of_the_name_counts() {
        let first = |seed, path, purpose| Stream::new(seed, path, purpose).next_u64();
        let all = [
            first(1, "a", "b"),
            first(2, "a", "b"),
            first(1, "b", "a"),
            first(1, "b", "b"),
            first(1, "a", "a"),
            first(1, "ab", ""),
            first(1, "", "ab"),
        ];
        for (i, x) in all.iter().enumerate() {
            assert!(
                !all[..i].contains(x),
                "streams {i} and an earlier one agree"
            );
        }
    }

    #[test]
    fn neighbouring_seeds_and_paths_are_no_shifted_copies() {
        let words = |seed, path: &str| -> Vec<u64> {
            let mut s = Stream::new(seed, path, "walk");
            (0..256).map(|_| s.next_u64()).collect()
        };
        let one = words(1, "bee-1");
        for other in [
            words(2, "bee-1"),
            words(3, "bee-1"),
            words(1, "bee-2"),
            words(0, "bee-1"),
        ] {
            assert!(other.iter().all(|w| !one.contains(w)));
        }
    }

    #[test]
    fn uniform_has_the_moments_of_the_uniform() {
        let mut s = stream();
        let (mean, variance) = moments(100_000, || s.uniform());
        assert!((mean - 0.5).abs() < 0.004, "mean {mean}");
        assert!((variance - 1.0 / 12.0).abs() < 0.002, "variance {variance}");
    }

    #[test]
    fn normal_has_the_moments_of_the_normal() {
        let mut s = stream();
        let (mean, variance) = moments(100_000, || s.normal());
        assert!(mean.abs() < 0.013, "mean {mean}");
        assert!((variance - 1.0).abs() < 0.02, "variance {variance}");
        let (skew, _) = moments(100_000, || {
            let x = s.normal();
            x * x * x
        });
        assert!(skew.abs() < 0.05, "third moment {skew}");
    }

    #[test]
    fn exponential_has_mean_and_variance_one() {
        let mut s = stream();
        let (mean, variance) = moments(100_000, || s.exponential());
        assert!((mean - 1.0).abs() < 0.013, "mean {mean}");
        assert!((variance - 1.0).abs() < 0.04, "variance {variance}");
    }

    #[test]
    fn below_is_even_and_stays_below() {
        let mut s = stream();
        let mut counts = [0u32; 7];
        for _ in 0..70_000 {
            counts[s.below(7) as usize] += 1;
        }
        assert!(
            counts.iter().all(|c| (9_600..10_400).contains(c)),
            "{counts:?}"
        );
        assert_eq!(s.below(0), 0);
        assert_eq!(s.below(1), 0);
        // Near 2^64 a modulo would favour small numbers two to one.
        let big = (1 << 63) + (1 << 62);
        let low = (0..10_000).filter(|_| s.below(big) < 1 << 62).count();
        assert!(
            (3_150..3_520).contains(&low),
            "{low} of 10,000 in the lowest third"
        );
    }

    #[test]
    fn bernoulli_keeps_its_ends() {
        let mut s = stream();
        assert!((0..1000).all(|_| !s.bernoulli(0.0) && s.bernoulli(1.0) && !s.bernoulli(f64::NAN)));
        let hits = (0..100_000).filter(|_| s.bernoulli(0.3)).count();
        assert!((29_400..30_600).contains(&hits), "{hits}");
    }

    #[test]
    fn uniform_in_never_reaches_the_end() {
        let mut s = stream();
        // Only two numbers lie in this range: rounding would give the end half of the time.
        let range = 1.0..1.0 + 2.0 * f64::EPSILON;
        assert!((0..1000).all(|_| range.contains(&s.uniform_in(range.clone()))));
        assert_eq!(s.uniform_in(3.0..3.0), 3.0);
        let (mean, _) = moments(100_000, || s.uniform_in(-2.0..4.0));
        assert!((mean - 1.0).abs() < 0.03, "mean {mean}");
    }

    #[test]
    fn uniform_open_is_open() {
        // The smallest and the largest word.
        for word in [0u64, u64::MAX] {
            let u = ((word >> 12) as f64 + 0.5) * (1.0 / (1u64 << 52) as f64);
            assert!(u > 0.0 && u < 1.0);
        }
    }

    #[test]
    fn unit_vectors_have_length_one_and_no_preferred_side() {
        let mut s = stream();
        let mut mean = DVec3::ZERO;
        for _ in 0..20_000 {
            let v = s.unit_vector();
            assert!((v.length_squared() - 1.0).abs() < 1e-14);
            mean += v / 20_000.0;
        }
        assert!(mean.abs().max_element() < 0.02, "{mean}");
    }

    #[test]
    fn points_fill_the_ball_evenly() {
        let mut s = stream();
        let radii: Vec<f64> = (0..20_000).map(|_| s.in_ball(20.0).length()).collect();
        assert!(radii.iter().all(|r| *r <= 20.0));
        // Half the radius holds an eighth of the volume.
        let inner = radii.iter().filter(|r| **r < 10.0).count();
        assert!(
            (2_300..2_700).contains(&inner),
            "{inner} of 20,000 within half the radius"
        );
    }

    #[test]
    fn shuffle_gives_every_order_alike() {
        let mut s = stream();
        let mut counts = [0u32; 6];
        for _ in 0..60_000 {
            let mut items = [0, 1, 2];
            s.shuffle(&mut items);
            counts[items[0] * 2 + usize::from(items[1] > items[2])] += 1;
        }
        assert!(
            counts.iter().all(|c| (9_600..10_400).contains(c)),
            "{counts:?}"
        );
    }
}
