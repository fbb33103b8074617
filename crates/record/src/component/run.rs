//! Numbers of the run as a whole over time, as metrics without a model's path.
//!
//! | name | unit | |
//! |---|---|---|
//! | `contacts` | 1/s | touches |
//! | `packets/sent`, `packets/received` | 1/s | if there are radios |
//! | `packets/delivery` | 1 | received over what could have been: out of range does not count |
//! | `energy` | J | what batteries gave since the start, if there are any |
//!
//! The speed of the run is not among them: it is the wall clock's.

use crate::data::{Metric, Metrics};
use simbeeotic_model::radio::{Counters, Loss};
use simbeeotic_model::{Mark, View};

/// The least time between two of them.
const PERIOD_NS: u64 = 100_000_000;

/// What was counted up to the last time.
#[derive(Default)]
pub(super) struct RunMetrics {
    touches: u64,
    last: Option<Last>,
}

struct Last {
    time_ns: u64,
    touches: u64,
    air: Counters,
}

impl RunMetrics {
    /// Counts what happened.
    pub(super) fn count(&mut self, marks: &[Mark]) {
        let touches = marks
            .iter()
            .filter(|mark| matches!(mark, Mark::Touch { .. }));
        self.touches += touches.count() as u64;
    }

    /// The numbers since the last time, if that was long enough ago. `energy_j` is what batteries gave since the
    /// start; `radios` whether there are any.
    pub(super) fn take(
        &mut self,
        view: &View<'_>,
        radios: bool,
        energy_j: Option<f64>,
    ) -> Option<Metrics> {
        let time_ns = view.now().nanos();
        let air = view.radio_counters(None);
        let now = Last {
            time_ns,
            touches: self.touches,
            air,
        };
        let Some(last) = &self.last else {
            self.last = Some(now);
            return None;
        };
        let passed_ns = time_ns.saturating_sub(last.time_ns);
        if passed_ns < PERIOD_NS {
            return None;
        }
        let values = numbers(last, &now, radios, energy_j);
        self.last = Some(now);
        Some(Metrics { time_ns, values })
    }
}

fn numbers(last: &Last, now: &Last, radios: bool, energy_j: Option<f64>) -> Vec<Metric> {
    let passed_s = (now.time_ns - last.time_ns) as f64 * 1e-9;
    let metric = |name: &str, unit: &str, value| Metric {
        name: name.to_owned(),
        unit: unit.to_owned(),
        value,
    };
    let touches = (now.touches - last.touches) as f64;
    let mut values = vec![metric("contacts", "1/s", touches / passed_s)];
    if radios {
        let since =
            |what: fn(&Counters) -> u64| what(&now.air).saturating_sub(what(&last.air)) as f64;
        let (sent, received) = (since(|c| c.sent), since(|c| c.received));
        let missed = since(|c| c.missed().saturating_sub(c.lost(Loss::OutOfRange)));
        values.push(metric("packets/sent", "1/s", sent / passed_s));
        values.push(metric("packets/received", "1/s", received / passed_s));
        if received + missed > 0.0 {
            values.push(metric(
                "packets/delivery",
                "1",
                received / (received + missed),
            ));
        }
    }
    values.extend(energy_j.map(|energy| metric("energy", "J", energy)));
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rates_are_per_second_and_delivery_leaves_out_who_is_too_far() {
        let at = |time_ns, touches, sent, received| {
            let mut air = Counters::default();
            (air.sent, air.received) = (sent, received);
            Last {
                time_ns,
                touches,
                air,
            }
        };
        let (last, now) = (at(1_000_000_000, 3, 10, 20), at(1_500_000_000, 7, 20, 50));
        let values = |radios, energy_j| -> Vec<(String, f64)> {
            (numbers(&last, &now, radios, energy_j).into_iter())
                .map(|metric| (metric.name, metric.value))
                .collect()
        };
        assert_eq!(values(false, None), [("contacts".to_owned(), 8.0)]);
        let all = values(true, Some(2.5));
        let names: Vec<&str> = all.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(
            names,
            [
                "contacts",
                "packets/sent",
                "packets/received",
                "packets/delivery",
                "energy"
            ]
        );
        assert_eq!(
            (all[1].1, all[2].1, all[3].1, all[4].1),
            (20.0, 60.0, 1.0, 2.5)
        );
        let quiet = numbers(&now, &at(2_000_000_000, 7, 20, 50), true, None);
        assert_eq!(quiet.len(), 3, "no delivery where nothing was sent");
    }
}
