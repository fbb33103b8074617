//! Nakagami's distribution: a fit to measured fading.

use super::Fading;
use crate::fast::shares;
use simbeeotic_units::{Length, math};
use std::fmt;

/// Nakagami-m: a gain of the gamma distribution with shape `m` and mean 1, with an `m` for each range of
/// distances.
///
/// `m = 1` is Rayleigh's, more is milder (`(K + 1)^2 / (2 K + 1)` is near Rice's), less is worse.
///
/// Source: Nakagami 1960; the default steps are those of ns-3 3.37 (m = 1.5 up to 80 m, 0.75 beyond), from
/// measurements among cars.
pub struct Nakagami {
    /// Up to which square of the distance, m², and what holds there. The last goes on.
    steps: Vec<(f32, Gamma)>,
}

impl Nakagami {
    /// One `m` for all distances. 0.5 to 100; outside it is held there.
    #[must_use]
    pub fn new(m: f64) -> Self {
        Self::with_steps(&[(Length::si(f64::INFINITY), m)])
    }

    /// An `m` for each range: the first up to its distance, and so on, distances rising. The last goes on
    /// whatever its distance. None: `m = 1`.
    #[must_use]
    pub fn with_steps(steps: &[(Length, f64)]) -> Self {
        let alone = [(Length::si(f64::INFINITY), 1.0)];
        let steps = if steps.is_empty() { &alone } else { steps };
        let step = |&(up_to, m): &(Length, f64)| {
            let up_to_m = up_to.metres() as f32;
            (up_to_m * up_to_m, Gamma::new(m.clamp(0.5, 100.0)))
        };
        Self {
            steps: steps.iter().map(step).collect(),
        }
    }

    /// That of ns-3: 1.5 below 80 m, 0.75 beyond.
    #[must_use]
    pub fn ns3() -> Self {
        Self::with_steps(&[
            (Length::from_metres(80.0), 1.5),
            (Length::si(f64::INFINITY), 0.75),
        ])
    }

    #[inline]
    fn at(&self, square_m2: f32) -> &Gamma {
        let last = self.steps.len() - 1;
        let step = self.steps[..last]
            .iter()
            .position(|step| square_m2 < step.0);
        &self.steps[step.unwrap_or(last)].1
    }
}

impl fmt::Debug for Nakagami {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ms = self.steps.iter().map(|(_, gamma)| gamma.m);
        f.debug_list().entries(ms).finish()
    }
}

impl Fading for Nakagami {
    fn gain(&self, draw: u64, distance_m: f64) -> f64 {
        let [u, _] = shares(draw);
        let square_m2 = (distance_m as f32) * (distance_m as f32);
        self.at(square_m2).quantile(u.into())
    }

    fn fade(&self, draws: &[u64], distances_squared_m2: &[f32], gains: &mut [f32]) {
        for ((gain, &draw), &square) in gains.iter_mut().zip(draws).zip(distances_squared_m2) {
            let [u, _] = shares(draw);
            *gain *= self.at(square).rough_quantile(u);
        }
    }
}

/// Octaves of a share that the tables hold: [`shares`] has no smaller one than `2^-24`.
const OCTAVES: u32 = 24;
/// Steps in each octave.
const STEP_BITS: u32 = 6;
const SLOTS: usize = (OCTAVES << STEP_BITS) as usize;

/// The gamma distribution with mean 1, and its quantiles in tables.
///
/// One table for the lower half by `u`, one for the upper by `1 - u`, both with 64 steps an octave, and
/// straight between: near 0 the quantile is a power of `u`, near 1 a logarithm of `1 - u`, and both are
/// straight enough over a step of that width.
struct Gamma {
    m: f64,
    /// `ln Gamma(m)`.
    ln_gamma: f64,
    lower: Vec<f32>,
    upper: Vec<f32>,
}

/// The place of a share from `2^-24` to 1 in a table: slot and how far in it.
#[inline(always)]
fn place(share: f32) -> (usize, f32) {
    let bits = share.to_bits();
    let first = (127 - OCTAVES) << STEP_BITS;
    let slot = (bits >> (23 - STEP_BITS)).wrapping_sub(first) as usize;
    let rest = bits & ((1 << (23 - STEP_BITS)) - 1);
    (
        slot,
        rest as f32 * (1.0 / (1u32 << (23 - STEP_BITS)) as f32),
    )
}

/// The share at which a slot begins.
fn start(slot: usize) -> f64 {
    let bits = (slot as u32 + ((127 - OCTAVES) << STEP_BITS)) << (23 - STEP_BITS);
    f32::from_bits(bits).into()
}

impl Gamma {
    fn new(m: f64) -> Self {
        let mut gamma = Self {
            m,
            ln_gamma: ln_gamma(m),
            lower: Vec::new(),
            upper: Vec::new(),
        };
        let half = SLOTS - (1 << STEP_BITS);
        // From the half outwards: each quantile is close to the one before.
        let middle = gamma.search(0.5, 0.5, m);
        let table = |up: bool| -> Vec<f32> {
            let mut at = middle;
            let mut values: Vec<f32> = (0..=half)
                .rev()
                .map(|slot| {
                    let tail = start(slot);
                    at = if up {
                        gamma.search(1.0 - tail, tail, at)
                    } else {
                        gamma.search(tail, 1.0 - tail, at)
                    };
                    (at / m) as f32
                })
                .collect();
            values.reverse();
            values
        };
        let (lower, upper) = (table(false), table(true));
        (gamma.lower, gamma.upper) = (lower, upper);
        gamma
    }

    /// The gain that a share of `u` lies below, exactly.
    fn quantile(&self, u: f64) -> f64 {
        let start = f64::from(self.rough_quantile(u as f32)) * self.m;
        self.search(u, 1.0 - u, start) / self.m
    }

    /// The same from the tables.
    #[inline]
    fn rough_quantile(&self, u: f32) -> f32 {
        let (table, share) = if u < 0.5 {
            (&self.lower, u)
        } else {
            (&self.upper, 1.0 - u)
        };
        let (slot, rest) = place(share);
        let slot = slot.min(table.len() - 2);
        table[slot] + rest * (table[slot + 1] - table[slot])
    }

    /// The `x` with `P(m, x) = below`, which is `Q(m, x) = above`: Newton's steps in `ln x`, within bounds
    /// that close in.
    fn search(&self, below: f64, above: f64, start: f64) -> f64 {
        let (mut low, mut high) = (0.0, f64::INFINITY);
        let mut x = start;
        for _ in 0..200 {
            let (p, q) = self.parts(x);
            // The smaller one has the digits.
            let over = if below < above { p - below } else { above - q };
            if over > 0.0 {
                high = x;
            } else {
                low = x;
            }
            // The density times x, which is the slope in ln x.
            let slope = math::exp(self.m * math::ln(x) - x - self.ln_gamma);
            let step = x * math::exp((-over / slope).clamp(-2.0, 2.0));
            let next = if step > low && step < high {
                step
            } else if high.is_finite() {
                0.5 * (low + high)
            } else {
                2.0 * x
            };
            if (next - x).abs() <= 1e-13 * x {
                return next;
            }
            x = next;
        }
        x
    }

    /// The regularised incomplete gamma functions `P(m, x)` and `Q(m, x)`: the series below `m + 1`, Lentz's
    /// continued fraction above.
    fn parts(&self, x: f64) -> (f64, f64) {
        let m = self.m;
        let scale = math::exp(m * math::ln(x) - x - self.ln_gamma);
        if x < m + 1.0 {
            let (mut term, mut sum, mut n) = (1.0 / m, 1.0 / m, m);
            while term > sum * 1e-16 {
                n += 1.0;
                term *= x / n;
                sum += term;
            }
            let p = (scale * sum).min(1.0);
            return (p, 1.0 - p);
        }
        let mut b = x + 1.0 - m;
        let mut c = 1e300;
        let mut d = 1.0 / b;
        let mut fraction = d;
        for i in 1..500 {
            let a = -f64::from(i) * (f64::from(i) - m);
            b += 2.0;
            d = 1.0 / (a * d + b);
            c = b + a / c;
            let factor = d * c;
            fraction *= factor;
            if (factor - 1.0).abs() < 1e-16 {
                break;
            }
        }
        let q = (scale * fraction).min(1.0);
        (1.0 - q, q)
    }
}

/// `ln Gamma(x)` for `x >= 0.5`: Stirling's series from 10 on, and the recurrence below.
fn ln_gamma(x: f64) -> f64 {
    let (mut y, mut product) = (x, 1.0);
    while y < 10.0 {
        product *= y;
        y += 1.0;
    }
    let z = 1.0 / (y * y);
    let series = (1.0 / 12.0 - z * (1.0 / 360.0 - z * (1.0 / 1260.0 - z / 1680.0))) / y;
    (y - 0.5) * math::ln(y) - y + 0.5 * math::ln(std::f64::consts::TAU) + series - math::ln(product)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{distance, mean, sample};
    use super::*;

    #[test]
    fn gamma_functions_are_right() {
        // Gamma(1/2) = sqrt(pi), Gamma(5) = 24; P(1, x) = 1 - exp(-x), P(1/2, x) = erf(sqrt(x)).
        assert!((ln_gamma(0.5) - 0.5 * math::ln(std::f64::consts::PI)).abs() < 1e-12);
        assert!((ln_gamma(5.0) - math::ln(24.0)).abs() < 1e-12);
        for x in [1e-6, 0.3, 1.4, 1.6, 3.0, 9.0] {
            let (p, q) = Gamma::new(1.0).parts(x);
            assert!((p + math::exp_m1(-x)).abs() < 1e-11 && (q - math::exp(-x)).abs() < 1e-11);
            assert!((Gamma::new(0.5).parts(x).0 - math::erf(x.sqrt())).abs() < 1e-11);
        }
    }

    #[test]
    fn gains_have_the_gamma_distribution_and_mean_1() {
        for m in [0.5, 0.75, 1.0, 1.5, 3.0, 20.0] {
            let gains = sample(&Nakagami::new(m), 100_000, 10.0);
            assert!((mean(&gains) - 1.0).abs() < 0.015, "m = {m}");
            let gamma = Gamma::new(m);
            let apart = distance(gains, |g| gamma.parts(m * g).0);
            assert!(apart < 1.95, "m = {m}: {apart}");
        }
    }

    #[test]
    fn tables_agree_with_the_exact_quantiles_down_to_the_rarest_draws() {
        for m in [0.5, 0.75, 1.5, 5.0] {
            let gamma = Gamma::new(m);
            let tails = (1..24).flat_map(|i| {
                let tail = 1.37 / (1u32 << i) as f32;
                [tail, 1.0 - tail]
            });
            for u in tails.filter(|u| (1e-7..1.0 - 1e-7).contains(u)) {
                let (exact, rough) = (gamma.quantile(u.into()), f64::from(gamma.rough_quantile(u)));
                let error_db = 10.0 * math::log10(rough / exact);
                assert!(
                    error_db.abs() < 1e-3 || exact < 1e-6,
                    "m = {m}, u = {u}: {rough} for {exact}"
                );
            }
        }
    }

    #[test]
    fn ns3_changes_m_at_80_m() {
        let ns3 = Nakagami::ns3();
        for (distance_m, m) in [(1.0, 1.5), (79.9, 1.5), (80.1, 0.75), (5000.0, 0.75)] {
            let want = Nakagami::new(m).gain(1 << 40, distance_m);
            assert_eq!(ns3.gain(1 << 40, distance_m), want, "{distance_m} m");
        }
    }
}
