//! `java.util.Random`, so that the random variables of an old scenario have the values they had.
//!
//! A 48-bit linear congruential generator, as the documentation of that class states it:
//!
//! ```text
//! state = (state * 0x5DEECE66D + 0xB) mod 2^48,      next(k) = state >> (48 - k)      (1)
//! ```
//! `nextGaussian` is Marsaglia's polar method. Nothing in the simulator itself draws from it.

use simbeeotic_units::math;

const MULTIPLIER: u64 = 0x5_DEEC_E66D;
const MASK: u64 = (1 << 48) - 1;

/// A stream of random numbers as Java draws them.
#[derive(Clone, Debug)]
pub(crate) struct JavaRandom {
    state: u64,
    spare: Option<f64>,
}

impl JavaRandom {
    /// The stream that `new Random(seed)` starts.
    pub(crate) const fn new(seed: i64) -> Self {
        Self {
            state: (seed as u64 ^ MULTIPLIER) & MASK,
            spare: None,
        }
    }

    /// The next `bits` bits, signed, by (1).
    const fn next(&mut self, bits: u32) -> i32 {
        self.state = self.state.wrapping_mul(MULTIPLIER).wrapping_add(0xB) & MASK;
        (self.state >> (48 - bits)) as u32 as i32
    }

    /// `nextLong()`
    pub(crate) const fn long(&mut self) -> i64 {
        let high = (self.next(32) as i64) << 32;
        high.wrapping_add(self.next(32) as i64)
    }

    /// `nextDouble()`: in [0, 1).
    pub(crate) fn double(&mut self) -> f64 {
        let high = i64::from(self.next(26)) << 27;
        let bits = high + i64::from(self.next(27));
        bits as f64 / (1_i64 << 53) as f64
    }

    /// `nextGaussian()`: mean 0, standard deviation 1.
    pub(crate) fn gaussian(&mut self) -> f64 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        loop {
            let v1 = 2.0 * self.double() - 1.0;
            let v2 = 2.0 * self.double() - 1.0;
            let s = v1 * v1 + v2 * v2;
            if s < 1.0 && s != 0.0 {
                let scale = (-2.0 * math::ln(s) / s).sqrt();
                self.spare = Some(v2 * scale);
                return v1 * scale;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Printed by many a Java tutorial for `new Random(42)`.
    #[test]
    fn the_values_are_those_of_java() {
        let mut random = JavaRandom::new(42);
        assert_eq!(
            [random.next(32), random.next(32)],
            [-1_170_105_035, 234_785_527]
        );
        assert_eq!(JavaRandom::new(42).long(), -5_025_562_857_975_149_833);
        assert!((JavaRandom::new(42).double() - 0.727_563_680_032_868_1).abs() < 1e-15);
        assert!((JavaRandom::new(42).gaussian() - 1.141_905_315_473_054_7).abs() < 1e-12);
    }
}
