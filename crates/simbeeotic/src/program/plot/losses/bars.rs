//! Counters of radios put together: of one run its numbers, of several their means and where these are.

use super::super::band::{half_width, mean, units};
use simbeeotic_record::{Tallies, Traffic};

/// Narrower bars are not told apart: periods are put together.
const BARS_MAX: usize = 200;

/// The counters of a run, period by period.
pub(super) struct Run {
    pub(super) seed: Option<u64>,
    pub(super) periods: Vec<Traffic>,
}

/// A number of frames: of one run, or the mean of several.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Amount {
    pub(super) mean: f64,
    /// Half of its 95 % interval; none of one run.
    pub(super) half: Option<f64>,
}

impl Amount {
    /// Of the numbers of runs, with their seeds. None of no run.
    fn of(runs: &[(Option<u64>, f64)]) -> Self {
        let values = units(runs);
        Self {
            mean: mean(&values).unwrap_or(0.0),
            half: half_width(&values),
        }
    }

    /// The ends of its interval, not below none.
    pub(super) fn ends(self) -> Option<[f64; 2]> {
        let half = self.half?;
        Some([(self.mean - half).max(0.0), self.mean + half])
    }

    /// As far up as it is drawn.
    pub(super) fn top(self) -> f64 {
        self.mean + self.half.unwrap_or(0.0)
    }
}

/// Some periods, one after the other.
#[derive(Clone, Debug)]
pub(super) struct Bar {
    /// 0: an instant.
    pub(super) length_s: f64,
    pub(super) end_s: f64,
    pub(super) sent: Amount,
    /// By the reasons that are drawn, and all of these together.
    pub(super) lost: Vec<Amount>,
    pub(super) total: Amount,
}

/// Where bars begin and how wide they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Slots {
    start_ns: u64,
    width_ns: u64,
}

impl Slots {
    /// For some runs: periods are put together until they are few.
    pub(super) fn of<'a>(runs: impl Iterator<Item = &'a Run> + Clone) -> Self {
        let periods = runs.flat_map(|run| &run.periods);
        let period_ns = periods.clone().map(length_ns).max().unwrap_or(0);
        let period_ns = if period_ns > 0 {
            period_ns
        } else {
            1_000_000_000
        };
        let starts = periods
            .clone()
            .map(|t| t.time_ns.saturating_sub(length_ns(t)));
        let start_ns = starts.min().unwrap_or(0);
        let end_ns = periods.map(|t| t.time_ns).max().unwrap_or(0);
        let count = (end_ns - start_ns).div_ceil(period_ns);
        Self {
            start_ns,
            width_ns: period_ns * count.div_ceil(BARS_MAX as u64).max(1),
        }
    }

    /// How wide a bar is, s.
    pub(super) fn width_s(self) -> f64 {
        self.width_ns as f64 * 1e-9
    }

    /// Which bar a period is part of; `None` of an instant, which is a bar by itself.
    fn place(self, traffic: &Traffic) -> Option<u64> {
        (traffic.period_s > 0.0)
            .then(|| (traffic.time_ns - self.start_ns).saturating_sub(1) / self.width_ns)
    }

    /// The bars of runs: a run counts where it is for as long as any.
    pub(super) fn bars(self, runs: &[&Run], reasons: &[String]) -> Vec<Bar> {
        let mut parts: Vec<Vec<Part>> = runs.iter().map(|run| self.parts(run)).collect();
        let mut places: Vec<_> = parts.iter().flatten().map(|part| part.place).collect();
        places.sort_unstable();
        places.dedup();
        let bars = places.into_iter().map(|place| {
            let here: Vec<(Option<u64>, Part)> = (runs.iter().zip(&mut parts))
                .filter_map(|(run, parts)| {
                    let at = parts.iter().position(|part| part.place == place)?;
                    Some((run.seed, parts.swap_remove(at)))
                })
                .collect();
            let lengths = here.iter().map(|(_, part)| part.length_s);
            let length_s = lengths.fold(0.0, f64::max);
            let ends = here.iter().map(|(_, part)| part.end_s);
            let end_s = ends.fold(0.0, f64::max);
            let whole: Vec<_> = (here.iter())
                .filter(|(_, part)| part.length_s >= 0.999 * length_s)
                .collect();
            let amount = |of: &dyn Fn(&Tallies) -> u64| {
                let values = whole
                    .iter()
                    .map(|(seed, part)| (*seed, of(&part.sum) as f64));
                Amount::of(&values.collect::<Vec<_>>())
            };
            Bar {
                length_s,
                end_s,
                sent: amount(&|sum| sum.sent),
                lost: (reasons.iter())
                    .map(|why| amount(&|sum| sum.lost(why)))
                    .collect(),
                total: amount(&|sum| reasons.iter().map(|why| sum.lost(why)).sum()),
            }
        });
        // A start at which nothing happens is no bar.
        bars.filter(|bar| bar.end_s > 0.0 || bar.sent.mean + bar.total.mean > 0.0)
            .collect()
    }

    /// The periods of a run by the bars that they are part of.
    fn parts(self, run: &Run) -> Vec<Part> {
        let mut parts: Vec<Part> = Vec::new();
        for traffic in &run.periods {
            let place = self.place(traffic);
            match parts.last_mut().filter(|part| part.place == place) {
                Some(part) => part.add(traffic),
                None => {
                    let mut part = Part {
                        place,
                        length_s: 0.0,
                        end_s: 0.0,
                        sum: Tallies::default(),
                    };
                    part.add(traffic);
                    parts.push(part);
                }
            }
        }
        parts
    }
}

/// What a run has in a bar.
struct Part {
    place: Option<u64>,
    length_s: f64,
    end_s: f64,
    sum: Tallies,
}

impl Part {
    fn add(&mut self, traffic: &Traffic) {
        self.length_s += traffic.period_s;
        self.end_s = traffic.time_ns as f64 * 1e-9;
        add(&mut self.sum, &traffic.period);
    }
}

/// How long the period of some counters is, ns.
pub(super) fn length_ns(traffic: &Traffic) -> u64 {
    (traffic.period_s * 1e9).round() as u64
}

/// What each of some runs came to, from its start to its end.
pub(super) struct Totals(Vec<(Option<u64>, Tallies)>);

impl Totals {
    pub(super) fn of(runs: &[&Run]) -> Self {
        let sums = runs.iter().map(|run| {
            let mut sum = Tallies::default();
            run.periods
                .iter()
                .for_each(|traffic| add(&mut sum, &traffic.period));
            (run.seed, sum)
        });
        Self(sums.collect())
    }

    /// All reasons for which a frame was lost.
    pub(super) fn reasons(&self) -> impl Iterator<Item = &str> {
        let lost = self.0.iter().flat_map(|(_, sum)| &sum.lost);
        (lost.filter(|(_, n)| *n > 0)).map(|(reason, _)| reason.as_str())
    }

    /// A number of each run, put together.
    pub(super) fn amount(&self, of: impl Fn(&Tallies) -> u64) -> Amount {
        let values = self.0.iter().map(|(seed, sum)| (*seed, of(sum) as f64));
        Amount::of(&values.collect::<Vec<_>>())
    }
}

fn add(sum: &mut Tallies, more: &Tallies) {
    sum.sent += more.sent;
    sum.received += more.received;
    for (reason, n) in &more.lost {
        match sum.lost.iter_mut().find(|(known, _)| known == reason) {
            Some((_, total)) => *total += n,
            None => sum.lost.push((reason.clone(), *n)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn second(end: u64, period_s: f64, sent: u64, noise: u64) -> Traffic {
        Traffic {
            time_ns: end * 1_000_000_000,
            period_s,
            period: Tallies {
                sent,
                lost: vec![("noise".to_owned(), noise)],
                ..Tallies::default()
            },
            ..Traffic::default()
        }
    }

    fn run(seed: u64, periods: Vec<Traffic>) -> Run {
        Run {
            seed: Some(seed),
            periods,
        }
    }

    fn bars(runs: &[Run]) -> (Vec<Bar>, f64) {
        let slots = Slots::of(runs.iter());
        let all: Vec<&Run> = runs.iter().collect();
        (slots.bars(&all, &["noise".to_owned()]), slots.width_s())
    }

    #[test]
    fn many_periods_become_few_bars_and_nothing_is_lost_of_them() {
        let mut periods = vec![second(0, 0.0, 7, 1)];
        periods.extend((1..=1199).map(|end| second(end, 1.0, 2, 3)));
        let (bars, width_s) = bars(&[run(1, periods)]);
        assert_eq!((bars.len(), width_s), (201, 6.0));
        let plain = |at: usize| (bars[at].sent.mean, bars[at].lost[0].mean);
        assert_eq!(plain(0), (7.0, 1.0), "the start alone");
        assert_eq!([bars[0].length_s, bars[1].length_s], [0.0, 6.0]);
        assert_eq!(bars[200].length_s, 5.0, "the rest");
        assert_eq!((bars[1].end_s, plain(1)), (6.0, (12.0, 18.0)));
        assert_eq!(bars.iter().map(|b| b.sent.mean).sum::<f64>(), 2405.0);
        assert_eq!(bars.iter().map(|b| b.total.mean).sum::<f64>(), 3598.0);
        assert!(bars.iter().all(|b| b.sent.half.is_none()), "of one run");
    }

    #[test]
    fn a_start_at_which_nothing_happens_has_no_bar() {
        let (bars, width_s) = bars(&[run(1, vec![second(0, 0.0, 0, 0), second(1, 1.0, 2, 0)])]);
        assert_eq!((bars.len(), width_s, bars[0].end_s), (1, 1.0, 1.0));
    }

    #[test]
    fn bars_of_several_runs_are_means_with_students_interval() {
        let (bars, _) = bars(&[
            run(1, vec![second(1, 1.0, 10, 2), second(2, 1.0, 10, 1)]),
            run(2, vec![second(1, 1.0, 10, 4), second(2, 1.0, 12, 1)]),
        ]);
        // s = 1.414, t(1) = 12.706, over the root of two.
        let half = bars[0].lost[0].half.expect("two runs");
        assert!((half - 12.706).abs() < 1e-3, "{half}");
        assert_eq!(
            (bars[0].total.mean, bars[0].sent.half),
            (3.0, Some(0.0)),
            "both sent the same"
        );
        assert_eq!((bars[1].sent.mean, bars[1].lost[0].half), (11.0, Some(0.0)));
        assert_eq!(
            bars[0].total.ends(),
            Some([0.0, 3.0 + half]),
            "no less than none"
        );
    }

    #[test]
    fn a_run_that_ends_within_a_bar_is_not_taken_for_one_that_loses_less() {
        let mut short = run(2, vec![second(1, 1.0, 10, 4), second(2, 0.5, 5, 1)]);
        short.periods[1].time_ns = 1_500_000_000;
        let (bars, _) = bars(&[
            run(1, vec![second(1, 1.0, 10, 2), second(2, 1.0, 10, 6)]),
            short,
        ]);
        assert_eq!((bars[1].total.mean, bars[1].total.half), (6.0, None));
        assert_eq!(bars[0].total.mean, 3.0);
    }

    #[test]
    fn a_reason_that_a_run_does_not_know_is_none_there() {
        let mut other = second(1, 1.0, 10, 0);
        other.period.lost = vec![("collision".to_owned(), 3)];
        let runs = [run(1, vec![second(1, 1.0, 10, 4)]), run(2, vec![other])];
        let totals = Totals::of(&runs.iter().collect::<Vec<_>>());
        assert!(totals.reasons().eq(["noise", "collision"]));
        assert_eq!(totals.amount(|sum| sum.lost("noise")).mean, 2.0);
        assert_eq!(totals.amount(|sum| sum.lost("collision")).mean, 1.5);
    }
}
