//! Rates of the run over time: contacts and packets, in even steps, from periods of any length.
//!
//! A recording counts packets by its own periods, which are not the steps of a chart. What a period counted is spread
//! evenly over it, so that the steps' rates times their lengths come to what was counted, neither more nor less.

use super::faults::Faults;
use crate::series::Series;
use crate::wire::seconds;
use simbeeotic_record::{Event, Metrics, Recording, Traffic};
use std::iter::Peekable;

/// The numbers that are made here: what a recorder publishes under these names is the same once more.
pub(super) const NAMES: [&str; 4] = [
    "contacts",
    "packets/sent",
    "packets/received",
    "packets/delivery",
];

/// Steps of a length from 0 up to an end, s: the last one may be shorter, but is none of a rounding error.
pub(super) fn steps(length_s: f64, end_s: f64) -> impl Iterator<Item = (f64, f64)> {
    let count = (end_s / length_s - 1e-6)
        .ceil()
        .max(f64::from(u8::from(end_s > 0.0))) as u64;
    (0..count).map(move |k| {
        let to_s = match k + 1 == count {
            true => end_s,
            false => (k + 1) as f64 * length_s,
        };
        (k as f64 * length_s, to_s)
    })
}

/// What was counted in a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Counts {
    contacts: f64,
    sent: f64,
    received: f64,
    /// Frames that a radio in reach did not receive.
    missed: f64,
}

impl Counts {
    fn add(&mut self, other: &Self, share: f64) {
        self.contacts += other.contacts * share;
        self.sent += other.sent * share;
        self.received += other.received * share;
        self.missed += other.missed * share;
    }
}

/// What was counted between two times, s.
#[derive(Clone, Copy, Debug)]
struct Period {
    from_s: f64,
    to_s: f64,
    counts: Counts,
}

/// Periods in the order of time, read as far as steps ask.
struct Spread<'a> {
    periods: Peekable<Box<dyn Iterator<Item = Period> + 'a>>,
}

impl<'a> Spread<'a> {
    fn new(periods: impl Iterator<Item = Period> + 'a) -> Self {
        let periods: Box<dyn Iterator<Item = Period> + 'a> = Box::new(periods);
        Self {
            periods: periods.peekable(),
        }
    }

    /// What falls between two times, and how much of that time was counted, s. Times only grow.
    fn between(&mut self, from_s: f64, to_s: f64) -> (Counts, f64) {
        let (mut counts, mut covered_s) = (Counts::default(), 0.0);
        while let Some(period) = self.periods.peek() {
            let part_s = period.to_s.min(to_s) - period.from_s.max(from_s);
            if part_s > 0.0 {
                counts.add(&period.counts, part_s / (period.to_s - period.from_s));
                covered_s += part_s;
            }
            if period.to_s > to_s {
                break;
            }
            self.periods.next();
        }
        (counts, covered_s)
    }
}

/// The rates of a recording.
pub(super) struct Rates<'a> {
    contacts: Option<(usize, Contacts<'a>)>,
    packets: Option<([usize; 3], Spread<'a>)>,
}

enum Contacts<'a> {
    /// One by one, at their times.
    Counted(Peekable<Box<dyn Iterator<Item = f64> + 'a>>),
    /// Where the recording has no events.
    Told(Spread<'a>),
}

impl<'a> Rates<'a> {
    /// Names the series that the recording has rates for.
    pub(super) fn start(recording: &'a Recording, faults: &'a Faults, series: &mut Series) -> Self {
        let told = |name: &'static str| {
            let has = move |list: &Metrics| list.values.iter().any(|metric| metric.name == name);
            faults.good(recording.metrics()).any(|list| has(&list))
        };
        let of_metrics = || Spread::new(periods_of_metrics(faults.good(recording.metrics())));
        let contacts = if recording.events().next().is_some() {
            let events = faults.good(recording.events());
            let touches: Box<dyn Iterator<Item = f64> + 'a> = Box::new(
                (events.filter(|event: &Event| event.kind == "contact"))
                    .map(|event| seconds(event.time_ns)),
            );
            Some(Contacts::Counted(touches.peekable()))
        } else {
            told(NAMES[0]).then(|| Contacts::Told(of_metrics()))
        };
        let packets = if recording.traffic_in(0..=u64::MAX).next().is_some() {
            let traffic = faults.good(recording.traffic_in(0..=u64::MAX));
            Some(Spread::new(traffic.filter_map(|it| period_of_traffic(&it))))
        } else {
            told(NAMES[1]).then(of_metrics)
        };
        Self {
            contacts: contacts.map(|it| (series.statistic(NAMES[0], "1/s"), it)),
            packets: packets.map(|it| {
                let sent = series.statistic(NAMES[1], "1/s");
                let received = series.statistic(NAMES[2], "1/s");
                ([sent, received, series.statistic(NAMES[3], "1")], it)
            }),
        }
    }

    /// Sets what they are from one time to another, s. Times only grow.
    pub(super) fn set(&mut self, from_s: f64, to_s: f64, series: &mut Series) {
        match &mut self.contacts {
            Some((at, Contacts::Counted(touches))) => {
                let mut count = 0.0;
                while touches.next_if(|t| *t <= to_s).is_some() {
                    count += 1.0;
                }
                series.set(*at, count / (to_s - from_s));
            }
            Some((at, Contacts::Told(spread))) => {
                let (counts, covered_s) = spread.between(from_s, to_s);
                series.set(*at, counts.contacts / covered_s);
            }
            None => {}
        }
        if let Some(([sent, received, delivery], spread)) = &mut self.packets {
            let (counts, covered_s) = spread.between(from_s, to_s);
            series.set(*sent, counts.sent / covered_s);
            series.set(*received, counts.received / covered_s);
            let could = counts.received + counts.missed;
            series.set(*delivery, counts.received / could);
        }
    }
}

/// What all radios together did in a period; nothing for one radio, or an instant.
fn period_of_traffic(traffic: &Traffic) -> Option<Period> {
    let to_s = seconds(traffic.time_ns);
    let tallies = &traffic.period;
    (traffic.radio.is_empty() && traffic.period_s > 0.0).then(|| Period {
        from_s: to_s - traffic.period_s,
        to_s,
        counts: Counts {
            contacts: 0.0,
            sent: tallies.sent as f64,
            received: tallies.received as f64,
            missed: tallies.missed_in_reach() as f64,
        },
    })
}

/// What the recorder's own rates say: each list holds since the one before.
fn periods_of_metrics(lists: impl Iterator<Item = Metrics>) -> impl Iterator<Item = Period> {
    let mut last_s = 0.0;
    lists.filter_map(move |list| {
        let of = |name: &str| {
            let found = list.values.iter().find(|metric| metric.name == name);
            found.map(|metric| metric.value)
        };
        let contacts = of(NAMES[0])?;
        let to_s = seconds(list.time_ns);
        let from_s = std::mem::replace(&mut last_s, to_s);
        let span_s = to_s - from_s;
        let received = of(NAMES[2]).unwrap_or(0.0) * span_s;
        let missed = of(NAMES[3]).filter(|share| *share > 0.0);
        (span_s > 0.0).then(|| Period {
            from_s,
            to_s,
            counts: Counts {
                contacts: contacts * span_s,
                sent: of(NAMES[1]).unwrap_or(0.0) * span_s,
                received,
                missed: missed.map_or(0.0, |share| received / share - received),
            },
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::Metric;

    fn periods() -> Vec<Period> {
        (0..50)
            .map(|k| Period {
                from_s: f64::from(k) * 0.2,
                to_s: f64::from(k + 1) * 0.2,
                counts: Counts {
                    contacts: f64::from(k % 3),
                    sent: f64::from(k * k % 17),
                    received: f64::from(k % 11),
                    missed: 1.0,
                },
            })
            .collect()
    }

    #[test]
    fn steps_of_any_length_come_to_what_the_periods_counted() {
        let mut all = Counts::default();
        periods().iter().for_each(|it| all.add(&it.counts, 1.0));
        for length_s in [0.03, 0.2, 0.3, 0.7, 4.0, 20.0] {
            let mut spread = Spread::new(periods().into_iter());
            let (mut sum, mut time_s) = (Counts::default(), 0.0);
            for (from_s, to_s) in steps(length_s, 10.0) {
                let (counts, covered_s) = spread.between(from_s, to_s);
                sum.add(&counts, 1.0);
                time_s += covered_s;
            }
            for (a, b) in [
                (sum.contacts, all.contacts),
                (sum.sent, all.sent),
                (sum.received, all.received),
                (sum.missed, all.missed),
                (time_s, 10.0),
            ] {
                assert!((a - b).abs() < 1e-9 * b, "{length_s} s: {a} for {b}");
            }
        }
    }

    #[test]
    fn no_step_is_a_rounding_error_and_the_last_one_ends_at_the_end() {
        for end_s in (1..=600).map(f64::from).chain([1e-4, 0.35, 12.345, 1234.5]) {
            let length_s = (end_s / 1000.0).clamp(0.001, 1.0);
            let all: Vec<(f64, f64)> = steps(length_s, end_s).collect();
            assert!(all.len() <= 1300, "{end_s} s: {} steps", all.len());
            assert_eq!((all[0].0, all[all.len() - 1].1), (0.0, end_s));
            for (at, (from_s, to_s)) in all.iter().enumerate() {
                let is_last = at + 1 == all.len();
                let short = (to_s - from_s) / length_s;
                assert!(
                    short > if is_last { 1e-7 } else { 0.999 },
                    "{end_s} s: {short}"
                );
                assert!(
                    is_last || all[at + 1].0 == *to_s,
                    "{end_s} s: a gap at {to_s}"
                );
            }
        }
        assert_eq!(steps(0.001, 0.0).count(), 0);
    }

    #[test]
    fn a_step_within_a_period_has_its_rate_and_one_outside_has_none() {
        let mut spread = Spread::new(periods().into_iter().skip(10).take(1));
        assert_eq!(spread.between(0.0, 1.9), (Counts::default(), 0.0));
        let (counts, covered_s) = spread.between(2.05, 2.10);
        assert!((counts.sent / covered_s - 15.0 / 0.2).abs() < 1e-9);
        let (_, covered_s) = spread.between(2.10, 3.0);
        assert!((covered_s - 0.1).abs() < 1e-9, "{covered_s}");
        assert_eq!(spread.between(3.0, 4.0).1, 0.0);
    }

    #[test]
    fn rates_of_a_recorder_are_counts_again() {
        let list = |time_ns, values: &[(&str, f64)]| Metrics {
            time_ns,
            values: (values.iter())
                .map(|(name, value)| Metric {
                    name: (*name).to_owned(),
                    unit: String::new(),
                    value: *value,
                })
                .collect(),
        };
        let lists = vec![
            list(400_000_000, &[("bee/pollen", 3.0)]),
            list(
                500_000_000,
                &[
                    ("contacts", 8.0),
                    ("packets/sent", 20.0),
                    ("packets/received", 60.0),
                    ("packets/delivery", 0.75),
                ],
            ),
            list(700_000_000, &[("contacts", 10.0)]),
        ];
        let found: Vec<Period> = periods_of_metrics(lists.into_iter()).collect();
        assert_eq!(found.len(), 2);
        assert_eq!((found[0].from_s, found[0].to_s), (0.0, 0.5));
        let counts = Counts {
            contacts: 4.0,
            sent: 10.0,
            received: 30.0,
            missed: 10.0,
        };
        assert_eq!(found[0].counts, counts);
        assert_eq!(found[1].from_s, 0.5);
        assert!((found[1].counts.contacts - 2.0).abs() < 1e-9);
    }
}
