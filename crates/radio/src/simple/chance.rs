//! Loss by chance alone: by distance, or by the state that a link happens to be in.

use super::success::{SLOTS, Table, middle};
use crate::radio::RadioError;
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::{draw_f64, draw_u64};
use simbeeotic_units::{Length, Time};

/// What decides whether a frame within range is received.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Delivery {
    /// The receiver's sensitivity and error model, and noise.
    #[default]
    Noise,
    /// A chance that hangs on the distance, each frame and receiver by itself: Bernoulli trials.
    Chance(DeliveryCurve),
    /// A chance that hangs on the distance and on the state of the link.
    Switching(GilbertElliott),
}

/// A chance of delivery over distance: linear between points, level before the first and after the
/// last.
#[derive(Clone, Debug, PartialEq)]
pub struct DeliveryCurve {
    /// Distance, m, and chance.
    points: Vec<[f64; 2]>,
}

impl DeliveryCurve {
    /// A curve through `points`.
    ///
    /// # Errors
    /// No point; distances that are negative, infinite or do not rise; chances that are not from 0 to 1.
    pub fn new(points: &[(Length, f64)]) -> Result<Self, RadioError> {
        let refuse = |what, got: String, expected| {
            Err(RadioError::OutOfRange {
                what,
                got,
                expected,
            })
        };
        if points.is_empty() {
            return refuse(
                "delivery curve",
                "no points".to_owned(),
                "one point or more",
            );
        }
        for (distance, chance) in points {
            if !(0.0..=1.0).contains(chance) {
                return refuse("delivery", chance.to_string(), "from 0 to 1");
            }
            if !(distance.is_finite() && *distance >= Length::ZERO) {
                return refuse(
                    "delivery curve distance",
                    distance.to_string(),
                    "0 m or more, finite",
                );
            }
        }
        for pair in points.windows(2) {
            if pair[1].0 <= pair[0].0 {
                let got = format!("{} after {}", pair[1].0, pair[0].0);
                return refuse("delivery curve distance", got, "distances that rise");
            }
        }
        Ok(Self {
            points: points
                .iter()
                .map(|(distance, chance)| [distance.metres(), *chance])
                .collect(),
        })
    }

    /// The same chance at any distance.
    ///
    /// # Errors
    /// Not from 0 to 1.
    pub fn level(chance: f64) -> Result<Self, RadioError> {
        Self::new(&[(Length::ZERO, chance)])
    }

    /// The chance at a distance, m.
    #[must_use]
    pub fn at(&self, distance_m: f64) -> f64 {
        let above = self.points.partition_point(|p| p[0] <= distance_m);
        match (
            above.checked_sub(1).map(|at| self.points[at]),
            self.points.get(above).copied(),
        ) {
            (Some([d0, c0]), Some([d1, c1])) => c0 + (c1 - c0) * ((distance_m - d0) / (d1 - d0)),
            (Some([_, chance]), None) | (None, Some([_, chance])) => chance,
            (None, None) => 0.0,
        }
    }

    fn last_m(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p[0])
    }

    /// The chance by slots of the square of the distance times `per_m2`.
    fn tabulate(&self, per_m2: f32) -> Box<Table> {
        let chance = |slot| self.at((middle(slot) / f64::from(per_m2)).sqrt());
        let table: Vec<u32> = (0..SLOTS)
            .map(|slot| (chance(slot) * 4_294_967_296.0) as u32)
            .collect();
        table
            .into_boxed_slice()
            .try_into()
            .expect("a table has SLOTS slots")
    }
}

/// A link that is good for a while, and bad for a while: the Gilbert-Elliott channel, in continuous
/// time.
///
/// The state is a Markov chain: it stays good for an exponential time of mean `good_for`, then bad for
/// one of mean `bad_for`. With `r = 1 / good_for + 1 / bad_for`,
///
/// ```text
/// share of good time   p = good_for / (good_for + bad_for)                          (1)
/// autocorrelation      of the state over a span s:  exp(-r s)                        (2)
/// ```
///
/// Drawing the state anew from (1) at the points of a Poisson process of rate `r` gives the same chain:
/// good turns bad at the rate `r (1 - p) = 1 / good_for`. So the state at any time is that of the last
/// such point, which is found by hashing alone: time is cut into cells of length `1 / r`, each with a
/// Poisson(1) number of points in it, all named by seed, link and cell. It hangs on nobody who asked
/// before.
///
/// Sources: Gilbert 1960, "Capacity of a burst-noise channel", Bell System Technical Journal 39(5);
/// Elliott 1963, "Estimates of error rates for codes on burst-noise channels", ibid. 42(5). Theirs runs
/// in steps of one bit; the papers were not at hand.
#[derive(Clone, Debug, PartialEq)]
pub struct GilbertElliott {
    /// Mean time that a link stays good.
    pub good_for: Time,
    /// Mean time that a link stays bad.
    pub bad_for: Time,
    /// Chance of delivery while it is good.
    pub good: DeliveryCurve,
    /// Chance of delivery while it is bad.
    pub bad: DeliveryCurve,
    /// Whether both directions of a link are good and bad together; else each by itself.
    pub symmetric: bool,
}

impl GilbertElliott {
    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// Mean times that are not from 1 us to 1e9 s.
    pub fn check(&self) -> Result<(), RadioError> {
        for (what, time) in [
            ("mean good time", self.good_for),
            ("mean bad time", self.bad_for),
        ] {
            if !(1e-6..=1e9).contains(&time.secs()) {
                return Err(RadioError::OutOfRange {
                    what,
                    got: time.to_string(),
                    expected: "from 1 us to 1e9 s",
                });
            }
        }
        Ok(())
    }

    /// Share of the time that a link is good, equation 1.
    #[must_use]
    pub fn share_good(&self) -> f64 {
        self.good_for.secs() / (self.good_for.secs() + self.bad_for.secs())
    }

    /// How often the state is drawn anew, 1/s.
    fn rate(&self) -> f64 {
        1.0 / self.good_for.secs() + 1.0 / self.bad_for.secs()
    }

    /// The link from one radio to another, by their keys, in a run with this seed.
    #[must_use]
    pub fn link(&self, seed: u64, tx_key: u64, rx_key: u64) -> u64 {
        let (a, b) = if self.symmetric {
            (tx_key.min(rx_key), tx_key.max(rx_key))
        } else {
            (tx_key, rx_key)
        };
        draw_u64(seed, a, b)
    }

    /// Whether a [`link`](Self::link) is good at `t`.
    #[must_use]
    pub fn is_good(&self, link: u64, t: SimTime) -> bool {
        let cells = t.nanos() as f64 * 1e-9 * self.rate();
        let mut cell = cells as u64;
        let mut until = cells - cell as f64;
        // The chance of a cell without a point is 1/e; cells before the start are as good as others.
        loop {
            if let Some(point) = last_point(link, cell, until) {
                return draw_f64(link ^ STATE, cell, point) < self.share_good();
            }
            cell = cell.wrapping_sub(1);
            until = 1.0;
        }
    }
}

/// Names of the draws of one cell, apart from the places of its points.
const COUNT: u64 = 0x636f_756e_7473;
const STATE: u64 = 0x7374_6174_6573;

/// 1/e: the chance that a cell has no point.
const NO_POINT: f64 = 0.367_879_441_171_442_33;

/// Which point of a cell is the last before `until`, a share of the cell.
fn last_point(link: u64, cell: u64, until: f64) -> Option<u64> {
    // Inversion of the Poisson distribution with mean 1. More than 20 points: once in 5e19 cells.
    let draw = draw_f64(link ^ COUNT, cell, 0);
    let (mut count, mut term) = (0, NO_POINT);
    let mut below = term;
    while draw >= below && count < 20 {
        count += 1;
        term /= count as f64;
        below += term;
    }
    let mut last: Option<(f64, u64)> = None;
    for point in 0..count {
        let place = draw_f64(link, cell, point);
        if place <= until && last.is_none_or(|(best, _)| place > best) {
            last = Some((place, point));
        }
    }
    last.map(|(_, point)| point)
}

/// Chances as the medium looks them up.
#[derive(Debug)]
pub(super) struct Chances {
    /// What makes a slot of the square of a distance, 1/m².
    pub(super) per_m2: f32,
    pub(super) good: Box<Table>,
    switching: Option<Switching>,
}

#[derive(Debug)]
struct Switching {
    bad: Box<Table>,
    channel: GilbertElliott,
    seed: u64,
}

impl Chances {
    /// `None` if chance does not go by distance.
    pub(super) fn new(delivery: &Delivery, seed: u64) -> Option<Self> {
        let (good, channel) = match delivery {
            Delivery::Noise => return None,
            Delivery::Chance(curve) => (curve, None),
            Delivery::Switching(channel) => (&channel.good, Some(channel)),
        };
        let bad_m = channel.map_or(0.0, |channel| channel.bad.last_m());
        // The tables end at 2^12: room for twice the last distance, by a power of two.
        let last_m = good.last_m().max(bad_m).clamp(1e-3, 1e15);
        let mut per_m2 = 1.0f32;
        while f64::from(per_m2) * last_m * last_m > 1024.0 {
            per_m2 /= 2.0;
        }
        while f64::from(per_m2) * last_m * last_m <= 512.0 {
            per_m2 *= 2.0;
        }
        Some(Self {
            per_m2,
            good: good.tabulate(per_m2),
            switching: channel.map(|channel| Switching {
                bad: channel.bad.tabulate(per_m2),
                channel: channel.clone(),
                seed,
            }),
        })
    }

    /// If links have states: draws for each of a row of pairs whether it is lucky, by the state that its
    /// link is in at `t`. The draw of who is not becomes the highest there is; the others stay as they
    /// are. `keys` tells the radios of a pair, sender first.
    pub(super) fn sieve(
        &self,
        (slots, draws): (&[u32], &mut [u32]),
        t: SimTime,
        keys: impl Fn(usize) -> [u64; 2],
    ) -> bool {
        let Some(Switching { bad, channel, seed }) = &self.switching else {
            return false;
        };
        for (j, (slot, draw)) in slots.iter().zip(draws).enumerate() {
            let slot = *slot as usize % SLOTS;
            let (good, bad) = (self.good[slot], bad[slot]);
            let lucky = if *draw >= good.max(bad) || *draw == u32::MAX {
                false
            } else if *draw < good.min(bad) {
                true
            } else {
                let [tx, rx] = keys(j);
                channel.is_good(channel.link(*seed, tx, rx), t) == (good > bad)
            };
            if !lucky {
                *draw = u32::MAX;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::math::exp;

    fn curve(points: &[(f64, f64)]) -> Result<DeliveryCurve, RadioError> {
        let points = points
            .iter()
            .map(|(m, chance)| (Length::from_metres(*m), *chance));
        DeliveryCurve::new(&points.collect::<Vec<_>>())
    }

    fn channel(good_s: f64, bad_s: f64) -> GilbertElliott {
        GilbertElliott {
            good_for: Time::from_secs(good_s),
            bad_for: Time::from_secs(bad_s),
            good: DeliveryCurve::level(1.0).unwrap(),
            bad: DeliveryCurve::level(0.0).unwrap(),
            symmetric: true,
        }
    }

    /// The states of some links, every `step_s` for `steps` steps.
    fn states(channel: &GilbertElliott, step_s: f64, steps: u64) -> Vec<Vec<bool>> {
        let link = |link: u64| {
            let link = channel.link(5, link, link + 1000);
            let time = |step: u64| SimTime::from_nanos((step as f64 * step_s * 1e9) as u64);
            (0..steps)
                .map(|step| channel.is_good(link, time(step)))
                .collect()
        };
        (0..50).map(link).collect()
    }

    #[test]
    fn curves_are_linear_between_points_and_level_beyond() {
        let curve = curve(&[(5.0, 1.0), (20.0, 0.9), (30.0, 0.0)]).unwrap();
        for (m, chance) in [
            (0.0, 1.0),
            (5.0, 1.0),
            (12.5, 0.95),
            (25.0, 0.45),
            (30.0, 0.0),
            (99.0, 0.0),
        ] {
            assert!((curve.at(m) - chance).abs() < 1e-12, "{m} m");
        }
    }

    #[test]
    fn curves_that_are_none_are_refused() {
        for (points, words) in [
            (&[][..], "no points"),
            (&[(0.0, 1.5)][..], "delivery of 1.5"),
            (&[(0.0, f64::NAN)][..], "delivery of NaN"),
            (&[(-1.0, 0.5)][..], "0 m or more"),
            (&[(f64::INFINITY, 0.5)][..], "finite"),
            (
                &[(0.0, 1.0), (20.0, 0.9), (20.0, 0.8)][..],
                "20 m after 20 m",
            ),
            (&[(20.0, 1.0), (10.0, 0.9)][..], "10 m after 20 m"),
        ] {
            let fault = curve(points).expect_err(words).to_string();
            assert!(fault.contains(words), "{fault}");
        }
        assert!(channel(0.0, 1.0).check().is_err() && channel(1.0, f64::NAN).check().is_err());
        assert!(channel(2.0, 0.5).check().is_ok());
    }

    #[test]
    fn tables_of_chance_are_half_a_percent_of_the_distance_off_at_most() {
        let falling = curve(&[(0.0, 1.0), (100.0, 0.0)]).unwrap();
        for scale in [1e-2, 1.0, 1e4] {
            let points: Vec<_> = falling
                .points
                .iter()
                .map(|p| (p[0] * scale, p[1]))
                .collect();
            let wanted = curve(&points).unwrap();
            let chances = Chances::new(&Delivery::Chance(wanted.clone()), 1).unwrap();
            for step in 0..2000 {
                let m = f64::from(step) * 0.0501 * scale;
                let place = ((m * m) as f32 * chances.per_m2).max(super::super::success::LEAST);
                let chance = chances.good[super::super::success::slot(place) as usize];
                let error = (f64::from(chance) / 4_294_967_296.0 - wanted.at(m)).abs();
                assert!(
                    error <= 0.005 * m / (100.0 * scale) + 1e-6,
                    "{m} m: off by {error}"
                );
            }
        }
    }

    #[test]
    fn links_are_good_for_their_share_of_the_time() {
        for (good_s, bad_s) in [(2.0, 0.5), (0.1, 0.3), (1.0, 1.0)] {
            let channel = channel(good_s, bad_s);
            // A sample each five correlation times: as good as independent.
            let step_s = 5.0 / channel.rate();
            let all = states(&channel, step_s, 2000).concat();
            let share = all.iter().filter(|good| **good).count() as f64 / all.len() as f64;
            let p = good_s / (good_s + bad_s);
            let sigma = (p * (1.0 - p) / all.len() as f64).sqrt();
            assert!((share - p).abs() < 4.0 * sigma, "{share} instead of {p}");
        }
    }

    #[test]
    fn links_stay_good_and_bad_for_exponential_times_of_their_means() {
        let channel = channel(2.0, 0.5);
        let step_s = 0.005;
        let mut dwell = [Vec::new(), Vec::new()];
        for link in states(&channel, step_s, 60_000) {
            // The first and the last run are cut off.
            let runs: Vec<&[bool]> = link.chunk_by(|a, b| a == b).collect();
            for run in &runs[1..runs.len() - 1] {
                dwell[usize::from(run[0])].push(run.len() as f64 * step_s);
            }
        }
        for (times, mean_s) in dwell.iter().zip([0.5, 2.0]) {
            let count = times.len() as f64;
            let mean = times.iter().sum::<f64>() / count;
            // Visits shorter than a step are missed at the chance of step over mean; so is the visit
            // between, and two become one.
            let tolerance = 4.0 * mean_s / count.sqrt() + 0.02 * mean_s;
            assert!(
                (mean - mean_s).abs() < tolerance,
                "{mean} s instead of {mean_s} s"
            );
            let longer = times.iter().filter(|time| **time > mean_s).count() as f64 / count;
            assert!(
                (longer - exp(-1.0)).abs() < 0.02,
                "a share of {longer} is longer than the mean"
            );
        }
    }

    #[test]
    fn states_are_correlated_over_time_as_a_markov_chain_is() {
        let channel = channel(2.0, 0.5);
        let (step_s, p) = (0.1, channel.share_good());
        let links = states(&channel, step_s, 20_000);
        for lag in [1_usize, 2, 4, 8, 16] {
            let mut sum = 0.0;
            let mut count = 0.0;
            for link in &links {
                for (a, b) in link.iter().zip(&link[lag..]) {
                    sum += (f64::from(*a) - p) * (f64::from(*b) - p);
                    count += 1.0;
                }
            }
            let correlation = sum / count / (p * (1.0 - p));
            let expected = exp(-channel.rate() * step_s * lag as f64);
            assert!(
                (correlation - expected).abs() < 0.015,
                "{lag}: {correlation}, not {expected}"
            );
        }
    }

    #[test]
    fn bursts_of_loss_at_ten_hertz_are_geometric() {
        // Sampled every T, the chain leaves bad with q = p (1 - exp(-r T)): bursts have mean 1 / q.
        let channel = channel(2.0, 0.5);
        let q = channel.share_good() * (1.0 - exp(-channel.rate() * 0.1));
        let mut bursts = Vec::new();
        for link in states(&channel, 0.1, 20_000) {
            let runs: Vec<&[bool]> = link.chunk_by(|a, b| a == b).collect();
            let inner = &runs[1..runs.len() - 1];
            bursts.extend(inner.iter().filter(|run| !run[0]).map(|run| run.len()));
        }
        let count = bursts.len() as f64;
        let mean = bursts.iter().sum::<usize>() as f64 / count;
        let sigma = (1.0 - q).sqrt() / q / count.sqrt();
        assert!(
            (mean - 1.0 / q).abs() < 4.0 * sigma,
            "{mean} instead of {}",
            1.0 / q
        );
        for length in [1, 2, 5] {
            let share = bursts.iter().filter(|burst| **burst == length).count() as f64 / count;
            let expected = (0..length - 1).fold(q, |share, _| share * (1.0 - q));
            assert!(
                (share - expected).abs() < 0.012,
                "{length}: {share}, not {expected}"
            );
        }
    }

    #[test]
    fn a_state_hangs_on_nobody_who_asked_and_on_the_direction_only_if_so_wished() {
        let both = channel(1.0, 1.0);
        let single = GilbertElliott {
            symmetric: false,
            ..both.clone()
        };
        let times: Vec<SimTime> = (0..500).map(|k| SimTime::from_millis(700 * k)).collect();
        let ask = |channel: &GilbertElliott, tx, rx, times: &[SimTime]| -> Vec<bool> {
            let link = channel.link(3, tx, rx);
            times.iter().map(|t| channel.is_good(link, *t)).collect()
        };
        let forward = ask(&both, 1, 2, &times);
        assert_eq!(ask(&both, 2, 1, &times), forward);
        assert_ne!(ask(&single, 2, 1, &times), ask(&single, 1, 2, &times));
        let backward: Vec<SimTime> = times.iter().rev().copied().collect();
        let mut reversed = ask(&both, 1, 2, &backward);
        reversed.reverse();
        assert_eq!(reversed, forward);
        let other = ask(&both, 1, 3, &times);
        let alike = other.iter().zip(&forward).filter(|(a, b)| a == b).count();
        assert!(
            (200..300).contains(&alike),
            "links are independent: {alike} of 500 alike"
        );
    }
}
