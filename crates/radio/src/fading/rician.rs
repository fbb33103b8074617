//! A line of sight, and echoes.

use super::Fading;
use crate::fast::{self, shares};
use simbeeotic_units::{Decibels, math};
use std::f64::consts::TAU;

/// A line of sight, and echoes: `g = |sqrt(K / (K + 1)) + z|^2` with `z` complex normal of power
/// `1 / (K + 1)`.
///
/// `K` is what the line of sight brings over what all echoes bring. Between vehicles in the air, 6 to 15 dB
/// are usual; minus infinity is [`Rayleigh`](super::Rayleigh).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rician {
    /// Amplitude of the line of sight.
    steady: f64,
    /// Power of the echoes.
    echoes: f64,
}

impl Rician {
    /// With this Rician factor `K`.
    #[must_use]
    pub fn new(k: Decibels) -> Self {
        let k = k.ratio();
        Self {
            steady: (k / (k + 1.0)).sqrt(),
            echoes: 1.0 / (k + 1.0),
        }
    }
}

impl Fading for Rician {
    fn gain(&self, draw: u64, _distance_m: f64) -> f64 {
        let [u, v] = shares(draw).map(f64::from);
        let size = (-self.echoes * math::ln(u)).sqrt();
        let (sin, cos) = math::sin_cos(TAU * v);
        let real = self.steady + size * cos;
        real * real + size * sin * size * sin
    }

    fn fade(&self, draws: &[u64], _distances_squared_m2: &[f32], gains: &mut [f32]) {
        let (steady, echoes) = (self.steady as f32, self.echoes as f32);
        for (gain, &draw) in gains.iter_mut().zip(draws) {
            let [u, v] = shares(draw);
            let size = (-echoes * fast::ln(u)).sqrt();
            let [sin, cos] = fast::sin_cos_turns_f32(v);
            let (real, imaginary) = (steady + size * cos, size * sin);
            *gain *= real * real + imaginary * imaginary;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{distance, mean, sample};
    use super::*;

    /// Of the density by its series: Poisson many (mean K) more halves of a gamma distribution.
    fn below(k: f64, g: f64) -> f64 {
        let x = (1.0 + k) * g;
        let (mut weight, mut total) = (math::exp(-k), 0.0);
        // Gamma(n + 1, x) distribution: 1 - exp(-x) sum x^i / i!.
        let (mut term, mut tail) = (math::exp(-x), math::exp(-x));
        for n in 0..400 {
            total += weight * (1.0 - tail);
            weight *= k / f64::from(n + 1);
            term *= x / f64::from(n + 1);
            tail += term;
        }
        total
    }

    #[test]
    fn gains_have_rices_distribution_and_mean_1() {
        for k_db in [-10.0, 0.0, 6.0, 12.0] {
            let fading = Rician::new(Decibels::from_db(k_db));
            let gains = sample(&fading, 100_000, 10.0);
            assert!((mean(&gains) - 1.0).abs() < 0.015, "K = {k_db} dB");
            let k = Decibels::from_db(k_db).ratio();
            let apart = distance(gains, |g| below(k, g));
            assert!(apart < 1.95, "K = {k_db} dB: {apart}");
        }
    }

    #[test]
    fn without_a_line_of_sight_it_is_rayleighs_and_with_nothing_else_it_is_1() {
        let none = Rician::new(Decibels::from_db(f64::NEG_INFINITY));
        let apart = distance(sample(&none, 50_000, 1.0), |g| 1.0 - math::exp(-g));
        assert!(apart < 1.95, "{apart}");
        let only = Rician::new(Decibels::from_db(90.0));
        assert!(
            sample(&only, 1000, 1.0)
                .iter()
                .all(|g| (g - 1.0).abs() < 1e-3)
        );
    }
}
