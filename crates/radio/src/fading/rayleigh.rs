//! Echoes only.

use super::Fading;
use crate::fast::{self, shares};
use simbeeotic_units::math;

/// Echoes only, no line of sight: the gain is exponential, `g = -ln u`. One frame in ten loses more than
/// 9.8 dB, one in a hundred more than 20 dB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rayleigh;

impl Fading for Rayleigh {
    fn gain(&self, draw: u64, _distance_m: f64) -> f64 {
        -math::ln(shares(draw)[0].into())
    }

    fn fade(&self, draws: &[u64], _distances_squared_m2: &[f32], gains: &mut [f32]) {
        for (gain, &draw) in gains.iter_mut().zip(draws) {
            let [u, _] = shares(draw);
            // 1 - u has all its digits: near 1 the logarithm itself would lose them.
            let v = 1.0 - u;
            let small = v * (1.0 + v * (0.5 + v * (1.0 / 3.0 + v * 0.25)));
            *gain *= if v < 0.01 { small } else { -fast::ln(u) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{distance, mean, sample};
    use super::*;

    #[test]
    fn gains_are_exponential_with_mean_1() {
        let gains = sample(&Rayleigh, 200_000, 10.0);
        assert!((mean(&gains) - 1.0).abs() < 0.01);
        let apart = distance(gains, |g| 1.0 - math::exp(-g));
        assert!(apart < 1.95, "{apart}");
    }
}
