//! The soft real-time limit: the largest size whose run takes no longer than what it simulates, found
//! by bisection.
//!
//! What is searched is a ratio, wall time over virtual time, that grows with the size and is known at a
//! few sizes. A size passes if its ratio is at most 1. First the search goes up (or down) until one size
//! passes and a larger one fails; then it halves the ratio of the two again and again. Halves are taken
//! where the curve through the two ends crosses 1, as long as that gets ahead faster than the middle.
//!
//! Machines are busy with other things, too: a ratio is a median of several runs, and still not exact.
//! A size that failed once stays failed, whatever larger ones did, so that noise makes the limit smaller,
//! never larger.

use super::super::plot::axes::grouped;
use serde::Serialize;
use simbeeotic_units::math;

/// Why a search ended before its end.
pub(super) const TIME_UP: &str = "; the next run would take longer than --within leaves";

/// The limit of one curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Limit {
    /// The largest size that was measured and kept real time, below all that did not.
    pub(super) low: Option<u32>,
    /// The smallest size that was measured and fell behind.
    pub(super) high: Option<u32>,
    /// Where the ratio is 1 between the two.
    pub(super) estimate: Option<u32>,
    /// Whether the search came to its end; if not, the next run would have taken longer than there was time.
    pub(super) settled: bool,
    /// In words.
    pub(super) text: String,
}

/// How a limit is searched.
#[derive(Clone, Copy, Debug)]
pub(super) struct Search {
    /// Largest size that is tried.
    pub(super) ceiling: u32,
    /// The bracket is narrow enough when its ends differ by this share.
    pub(super) tolerance: f64,
}

impl Search {
    /// Searches from what is known, pairs of size and ratio. `probe` measures the ratio of a size;
    /// `None` says that time is up.
    ///
    /// # Errors
    /// What `probe` gives.
    pub(super) fn run<E>(
        self,
        known: &[(u32, f64)],
        mut probe: impl FnMut(u32) -> Result<Option<f64>, E>,
    ) -> Result<Limit, E> {
        let mut known = Known::new(known);
        let mut width = f64::INFINITY;
        let mut slow = false;
        while let Some(size) = self.next(&known, slow) {
            let Some(ratio) = probe(size)? else {
                return Ok(known.limit(false));
            };
            known.add(size, ratio);
            // An interpolation that does not halve the bracket is followed by a plain halving.
            let now = known.width();
            slow = now.is_finite() && now > 0.5 * width;
            width = now;
        }
        Ok(known.limit(true))
    }

    /// The size to measure next; `None` if the limit is known well enough.
    fn next(self, known: &Known, slow: bool) -> Option<u32> {
        match (known.low(), known.high()) {
            (Some((low, _)), Some((high, _))) => {
                let ratio = f64::from(high) / f64::from(low.max(1));
                if high - low <= 1 || (low > 0 && ratio <= 1.0 + self.tolerance) {
                    return None;
                }
                Some(self.between(known, slow))
            }
            (Some((low, _)), None) if low >= self.ceiling => None,
            (Some((low, _)), None) => {
                let guess = known.crossing().map_or(f64::INFINITY, |x| 1.1 * x);
                let least = 1.3 * f64::from(low.max(1));
                let next = guess.clamp(least, 4.0 * f64::from(low.max(1))).ceil();
                Some((next as u32).clamp(low + 1, self.ceiling))
            }
            (None, Some((high, _))) if high <= 1 => None,
            (None, Some((high, _))) => {
                let guess = known.crossing().map_or(0.0, |x| x / 1.1);
                let most = f64::from(high) / 1.3;
                let next = guess.clamp(0.25 * f64::from(high), most).floor();
                Some((next as u32).clamp(1, high - 1))
            }
            (None, None) => Some(1),
        }
    }

    /// A size between the ends of the bracket.
    fn between(self, known: &Known, slow: bool) -> u32 {
        let ends = known.low().zip(known.high());
        let Some(((low, _), (high, _))) = ends else {
            return 1;
        };
        let (from, to) = (f64::from(low.max(1)), f64::from(high));
        let middle = (from * to).sqrt();
        let share = math::pow(to / from, 0.1);
        let size = match known.crossing() {
            // Beside the crossing, on the side that leaves a narrow bracket if the curve is right.
            Some(crossing) if !slow => {
                let step = 1.0 + 0.45 * self.tolerance;
                let beside = match crossing / from < step {
                    true => crossing * step,
                    false => crossing / step,
                };
                beside.clamp(from * share, to / share)
            }
            _ => middle,
        };
        (size.round() as u32).clamp(low + 1, high - 1)
    }
}

/// Sizes and their ratios, by size.
struct Known(Vec<(u32, f64)>);

impl Known {
    fn new(of: &[(u32, f64)]) -> Self {
        let mut known = Self(of.to_vec());
        known.0.sort_by_key(|(size, _)| *size);
        known
    }

    fn add(&mut self, size: u32, ratio: f64) {
        let at = self.0.partition_point(|(known, _)| *known <= size);
        self.0.insert(at, (size, ratio));
    }

    /// The smallest size that failed. A ratio that is no number fails.
    fn high(&self) -> Option<(u32, f64)> {
        let mut all = self.0.iter().copied();
        all.find(|(_, ratio)| !passes(*ratio))
    }

    /// The largest that passed below it.
    fn low(&self) -> Option<(u32, f64)> {
        let end = self.high().map_or(u32::MAX, |(size, _)| size);
        let mut all = self.0.iter().rev().copied();
        all.find(|(size, ratio)| passes(*ratio) && *size < end)
    }

    /// How far the ends are apart: the logarithm of their ratio.
    fn width(&self) -> f64 {
        match (self.low(), self.high()) {
            (Some((low, _)), Some((high, _))) => math::ln(f64::from(high) / f64::from(low.max(1))),
            _ => f64::INFINITY,
        }
    }

    /// Where the ratio should be 1, on a power law through the two ends, or through the two sizes that
    /// are nearest to where it must be.
    fn crossing(&self) -> Option<f64> {
        let usable = |(size, ratio): &(u32, f64)| *size > 0 && *ratio > 0.0 && ratio.is_finite();
        let two = match (self.low(), self.high()) {
            (Some(low), Some(high)) => vec![low, high],
            (Some(_), None) => {
                let all = self.0.iter().filter(|known| usable(known));
                let last: Vec<_> = all.rev().take(2).copied().collect();
                last.into_iter().rev().collect()
            }
            _ => self
                .0
                .iter()
                .filter(|known| usable(known))
                .take(2)
                .copied()
                .collect(),
        };
        let [a, b] = two[..] else { return None };
        if !usable(&a) || !usable(&b) || a.0 >= b.0 {
            return None;
        }
        let ln = |(size, ratio): (u32, f64)| (math::ln(f64::from(size)), math::ln(ratio));
        let ((x0, y0), (x1, y1)) = (ln(a), ln(b));
        let slope = (y1 - y0) / (x1 - x0);
        let at = x0 - y0 / slope;
        (slope > 0.05 && at.is_finite() && at < 30.0).then(|| math::exp(at))
    }

    fn limit(&self, settled: bool) -> Limit {
        let [low, high] = [self.low(), self.high()].map(|end| end.map(|(size, _)| size));
        let estimate = low.zip(high).map(|(low, high)| {
            let middle = (f64::from(low.max(1)) * f64::from(high)).sqrt();
            let at = self.crossing().unwrap_or(middle);
            three_digits(at.clamp(low.into(), high.into())).clamp(low, high)
        });
        let mut text = match (low, high, estimate) {
            (Some(low), Some(high), Some(estimate)) => format!(
                "{} (bracket {} to {})",
                count(estimate),
                count(low),
                count(high)
            ),
            (Some(low), ..) => format!("above {}", count(low)),
            (None, Some(high), _) => format!("below {}", count(high)),
            _ => "not measured".to_owned(),
        };
        if !settled {
            text.push_str(TIME_UP);
        }
        Limit {
            low,
            high,
            estimate,
            settled,
            text,
        }
    }
}

fn passes(ratio: f64) -> bool {
    ratio <= 1.0
}

/// A whole number near to `x`, with no more digits than such a measurement has.
fn three_digits(x: f64) -> u32 {
    let mut step = 1.0;
    while x / step >= 1000.0 {
        step *= 10.0;
    }
    ((x / step).round() * step) as u32
}

/// A number with its thousands apart.
pub(super) fn count(n: u32) -> String {
    grouped(&n.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    const SEARCH: Search = Search {
        ceiling: 1_000_000,
        tolerance: 0.05,
    };

    /// The limit of a curve, and the sizes that were probed.
    fn search(known: &[u32], curve: impl Fn(u32) -> f64) -> (Limit, Vec<u32>) {
        let known: Vec<_> = known.iter().map(|n| (*n, curve(*n))).collect();
        let mut probed = Vec::new();
        let limit = SEARCH.run(&known, |n| {
            probed.push(n);
            Ok::<_, Infallible>(Some(curve(n)))
        });
        let Ok(limit) = limit;
        (limit, probed)
    }

    fn power(limit: f64, exponent: f64) -> impl Fn(u32) -> f64 {
        move |n| math::pow(f64::from(n) / limit, exponent)
    }

    #[test]
    fn a_growing_curve_is_bracketed_within_the_tolerance() {
        for exponent in [0.5, 1.0, 1.4, 2.0, 3.0] {
            for at in [7.0, 333.0, 41_234.0, 654_321.0] {
                let (limit, probed) = search(&[10, 30, 1_000, 30_000], power(at, exponent));
                let (low, high) = (limit.low.expect("a low"), limit.high.expect("a high"));
                assert!(f64::from(low) <= at && at <= f64::from(high), "{limit:?}");
                let narrow = f64::from(high) / f64::from(low) <= 1.05 || high - low == 1;
                assert!(limit.settled && narrow, "{limit:?}");
                let estimate = limit.estimate.expect("one");
                assert!((low..=high).contains(&estimate), "{limit:?}");
                assert!(probed.len() <= 14, "{exponent} {at}: {probed:?}");
            }
        }
    }

    #[test]
    fn a_curve_like_ours_takes_few_probes() {
        let (limit, probed) = search(&[1_000, 3_000, 10_000, 30_000], power(78_000.0, 1.4));
        assert!(probed.len() <= 4, "{probed:?}");
        assert_eq!(limit.estimate, Some(78_000));
    }

    #[test]
    fn a_step_is_found_by_halving() {
        let step = |n: u32| if n < 5_000 { 0.001 } else { 1e6 };
        let (limit, probed) = search(&[100, 100_000], step);
        let (low, high) = (limit.low.expect("a low"), limit.high.expect("a high"));
        assert!(low < 5_000 && 5_000 <= high && f64::from(high) <= 1.05 * f64::from(low));
        assert!(probed.len() <= 24, "{probed:?}");
    }

    #[test]
    fn noise_does_not_keep_the_search_from_ending() {
        // Up and down by a fifth, by a rule.
        let noisy = |n: u32| {
            let noise = f64::from(n.wrapping_mul(2_654_435_761) >> 16) / 65_536.0 - 0.5;
            f64::from(n) / 20_000.0 * (1.0 + 0.4 * noise)
        };
        for known in [
            vec![10, 100, 1_000],
            vec![50_000],
            vec![18_000, 20_000, 22_000],
        ] {
            let (limit, probed) = search(&known, noisy);
            let (low, high) = (limit.low.expect("a low"), limit.high.expect("a high"));
            assert!(low < high && limit.settled, "{limit:?}");
            assert!(
                f64::from(low) > 15_000.0 && f64::from(high) < 26_000.0,
                "{limit:?}"
            );
            assert!(noisy(low) <= 1.0 && noisy(high) > 1.0);
            assert!(probed.len() <= 30, "{probed:?}");
        }
    }

    #[test]
    fn a_size_that_failed_stays_failed_whatever_larger_ones_did() {
        let known = [(100, 0.5), (200, 1.1), (300, 0.9), (400, 1.2)];
        let limit = SEARCH.run(&known, |_| Ok::<_, Infallible>(None));
        let Ok(limit) = limit;
        assert_eq!((limit.low, limit.high), (Some(100), Some(200)));
    }

    #[test]
    fn what_never_fails_is_above_the_ceiling() {
        let (limit, probed) = search(&[0, 10, 1_000], |_| 0.001);
        assert_eq!((limit.low, limit.high), (Some(1_000_000), None));
        assert_eq!(limit.text, "above 1,000,000");
        assert!(limit.settled && probed.len() <= 7, "{probed:?}");
        // What has been measured up to the ceiling needs no probe.
        let (limit, probed) = search(&[0, 1_000_000], |_| 0.5);
        assert_eq!((limit.text.as_str(), probed.len()), ("above 1,000,000", 0));
    }

    #[test]
    fn what_always_fails_is_below_one() {
        for ratio in [2.0, f64::INFINITY, f64::NAN] {
            let (limit, probed) = search(&[1_000], |_| ratio);
            assert_eq!((limit.low, limit.high), (None, Some(1)), "{probed:?}");
            assert_eq!(limit.text, "below 1");
        }
    }

    #[test]
    fn when_time_is_up_the_bracket_reached_is_told() {
        let curve = power(50_000.0, 1.0);
        let mut left = 1;
        let limit = SEARCH.run(&[(1_000, curve(1_000)), (100_000, curve(100_000))], |n| {
            left -= 1;
            Ok::<_, Infallible>((left >= 0).then(|| curve(n)))
        });
        let Ok(limit) = limit;
        assert!(!limit.settled);
        assert_eq!(
            limit.text,
            "50,000 (bracket 48,900 to 100,000); the next run would take longer than --within leaves"
        );
    }

    #[test]
    fn an_error_of_a_probe_ends_the_search() {
        let failed = SEARCH.run(&[], Err::<Option<f64>, _>);
        assert_eq!(failed.err(), Some(1));
    }
}
