//! Draws without state: one number for each name, in any order, on any thread.

use super::key::mix;

/// The 64-bit draw named `(key, a, b)`, for example (radio key, frame, receiver).
///
/// Three rounds of [`mix`]: about 4 ns. The words are not interchangeable: `(k, a, b)` and
/// `(k, b, a)` are different draws. Sort them first where a draw shall be symmetric.
#[inline]
#[must_use]
pub const fn draw_u64(key: u64, a: u64, b: u64) -> u64 {
    mix(mix(mix(key) ^ a) ^ b)
}

/// The draw named `(key, a, b)` as a number in [0, 1) with 53 random bits.
#[inline]
#[must_use]
pub const fn draw_f64(key: u64, a: u64, b: u64) -> f64 {
    (draw_u64(key, a, b) >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
}

/// The 32-bit draw named `(key, a)`, made for inner loops over many `a` with one `key`.
///
/// Only 32-bit multiplies, adds, shifts and xors, without branches: compilers turn a loop over
/// receivers into vector code. `key` must be well mixed already (a [`draw_u64`] of the frame, say):
/// both of its halves are used, one before and one between the two multiplies, so that two keys do
/// not give shifted copies of one sequence. For one key, different `a` never give the same number.
/// Source of shifts and multipliers: Wellons 2018, "Prospecting for hash functions", `lowbias32`.
#[inline(always)]
#[must_use]
pub const fn draw_u32(key: u64, a: u32) -> u32 {
    let mut x = a.wrapping_mul(0x9e37_79b9) ^ key as u32;
    x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    x = (x ^ (x >> 15)).wrapping_add((key >> 32) as u32);
    x = (x ^ (x >> 16)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Chi-squared of `n` draws over 256 cells; 255 degrees of freedom, so 255 ± 23.
    fn chi_squared(draws: impl Iterator<Item = u32>) -> f64 {
        let mut cells = [0u32; 256];
        let mut n = 0u32;
        for draw in draws {
            cells[(draw >> 24) as usize] += 1;
            n += 1;
        }
        let expected = f64::from(n) / 256.0;
        cells
            .iter()
            .map(|&c| (f64::from(c) - expected) * (f64::from(c) - expected) / expected)
            .sum()
    }

    fn key(i: u64) -> u64 {
        draw_u64(7, i, 0)
    }

    #[test]
    fn draws_of_one_key_are_uniform() {
        for k in 0..8 {
            let chi = chi_squared((0..1 << 16).map(|a| draw_u32(key(k), a)));
            assert!((150.0..370.0).contains(&chi), "key {k}: chi squared {chi}");
            let low = chi_squared((0..1 << 16).map(|a| draw_u32(key(k), a) << 24));
            assert!(
                (150.0..370.0).contains(&low),
                "key {k}, low bits: chi squared {low}"
            );
            let wide = chi_squared((0..1 << 16).map(|a| (draw_u64(k, a, 3) >> 32) as u32));
            assert!(
                (150.0..370.0).contains(&wide),
                "key {k}, 64 bits: chi squared {wide}"
            );
        }
    }

    #[test]
    fn draws_of_one_receiver_over_frames_are_uniform() {
        let chi = chi_squared((0..1 << 16).map(|frame| draw_u32(key(frame), 12)));
        assert!((150.0..370.0).contains(&chi), "chi squared {chi}");
    }

    #[test]
    fn neighbouring_draws_are_independent() {
        // Pairs of (this, next) in 16 x 16 cells, along receivers and along frames.
        let pair = |x: u32, y: u32| (x >> 28 << 28) | (y >> 28 << 24);
        let along =
            chi_squared((0..1 << 16).map(|a| pair(draw_u32(key(1), a), draw_u32(key(1), a + 1))));
        assert!((150.0..370.0).contains(&along), "chi squared {along}");
        let across =
            chi_squared((0..1 << 16).map(|f| pair(draw_u32(key(f), 5), draw_u32(key(f + 1), 5))));
        assert!((150.0..370.0).contains(&across), "chi squared {across}");
    }

    #[test]
    fn no_key_gives_a_shifted_copy_of_another() {
        let one: Vec<u32> = (0..4096).map(|a| draw_u32(key(1), a)).collect();
        for k in 2..40 {
            let other: Vec<u32> = (0..4096).map(|a| draw_u32(key(k), a)).collect();
            let runs = other
                .windows(2)
                .filter(|w| one.windows(2).any(|v| v == *w))
                .count();
            assert_eq!(runs, 0, "key {k} repeats two draws in a row of key 1");
        }
    }

    #[test]
    fn each_key_bit_flips_about_half_of_the_output() {
        for bit in 0..64 {
            let flips: u32 = (0..1000u32)
                .map(|i| {
                    (draw_u32(key(u64::from(i)), i) ^ draw_u32(key(u64::from(i)) ^ (1 << bit), i))
                        .count_ones()
                })
                .sum();
            let mean = f64::from(flips) / 1000.0;
            assert!(
                (13.0..19.0).contains(&mean),
                "key bit {bit} flips {mean} of 32"
            );
        }
    }

    #[test]
    fn words_are_not_interchangeable() {
        assert_ne!(draw_u64(1, 2, 3), draw_u64(1, 3, 2));
        assert_ne!(draw_u64(1, 2, 3), draw_u64(2, 1, 3));
        assert!((0.0..1.0).contains(&draw_f64(1, 2, 3)));
    }
}
