//! Numbers of the run as a whole over time, and the batteries of its vehicles: sampled now and then.

use super::viewer::Cast;
use crate::series::Series;
use simbeeotic_model::View;
use simbeeotic_model::radio::{Counters, Loss};
use std::collections::VecDeque;
use std::time::Duration;

/// Virtual time between two samples, while the run is slow enough.
const SAMPLE_S: f64 = 0.1;

/// The least and the greatest wall time between two of them.
const SAMPLE_LEAST: Duration = Duration::from_millis(20);
const SAMPLE_MOST: Duration = Duration::from_millis(250);

/// Virtual time over which the delivery of packets is a mean: in a tenth of a second there is often one packet, or none.
const DELIVERY_NS: u64 = 1_000_000_000;

/// Wall time over which the speed is a mean.
const SPEED: Duration = Duration::from_secs(1);

/// Batteries that are looked at in a second of wall time, while a page is there and while none is: those of a
/// larger swarm take turns. A look at one takes half a microsecond.
const BATTERIES_WATCHED: f64 = 10_000.0;
const BATTERIES_ALONE: f64 = 2_000.0;

/// Where the statistics stand among the series, and what they were at the last sample.
#[derive(Default)]
pub(super) struct Statistics {
    speed: usize,
    contacts: usize,
    /// `None`: there are no radios.
    air: Option<Air>,
    energy: usize,
    last: Option<(u64, Duration)>,
    last_touches: u64,
    pace: Passed,
    batteries: Batteries,
}

/// Virtual time, ns, and wall time at the samples of the last second.
#[derive(Default)]
struct Passed(VecDeque<(u64, Duration)>);

impl Passed {
    /// The run stands: what was before is of no matter to the speed once it goes on.
    fn stood(&mut self, now_ns: u64, wall: Duration) {
        self.0.clear();
        self.0.push_back((now_ns, wall));
    }

    /// The mean speed of the last second of wall time, or since the run last stood.
    fn speed(&mut self, now_ns: u64, wall: Duration) -> f64 {
        self.0.push_back((now_ns, wall));
        while self.0.len() > 2 && wall.saturating_sub(self.0[1].1) >= SPEED {
            self.0.pop_front();
        }
        let (from_ns, from) = self.0[0];
        let passed_s = now_ns.saturating_sub(from_ns) as f64 * 1e-9;
        let waited_s = wall.saturating_sub(from).as_secs_f64();
        if waited_s > 0.0 {
            passed_s / waited_s
        } else {
            0.0
        }
    }
}

#[derive(Default)]
struct Air {
    sent: usize,
    received: usize,
    delivery: usize,
    last: Counters,
    lately: Delivered,
}

/// Virtual time, ns, and the frames received and missed, of the samples of the last second.
#[derive(Default)]
struct Delivered(VecDeque<(u64, f64, f64)>);

impl Delivered {
    /// Received over what could have been, in the last second; no number if there was nothing to receive.
    fn share(&mut self, now_ns: u64, received: f64, missed: f64) -> f64 {
        self.0.push_back((now_ns, received, missed));
        while let Some((then_ns, ..)) = self.0.front() {
            if now_ns.saturating_sub(*then_ns) < DELIVERY_NS {
                break;
            }
            self.0.pop_front();
        }
        let received: f64 = self.0.iter().map(|(_, received, _)| received).sum();
        let missed: f64 = self.0.iter().map(|(.., missed)| missed).sum();
        received / (received + missed)
    }
}

/// The vehicles that have batteries, and what each has spent.
#[derive(Default)]
struct Batteries {
    vehicles: Vec<u32>,
    spent_j: Vec<f64>,
    next: usize,
}

impl Statistics {
    /// Names the series that this run has.
    pub(super) fn start(view: &View<'_>, cast: &Cast, radios: bool, series: &mut Series) -> Self {
        let mut statistics = Self {
            speed: series.statistic("speed", "1"),
            contacts: series.statistic("contacts", "1/s"),
            air: radios.then(|| Air {
                sent: series.statistic("packets/sent", "1/s"),
                received: series.statistic("packets/received", "1/s"),
                delivery: series.statistic("packets/delivery", "1"),
                last: Counters::default(),
                lately: Delivered::default(),
            }),
            ..Self::default()
        };
        let batteries = &mut statistics.batteries;
        for (vehicle, id) in (0..).zip(&cast.bodies) {
            if let Some(battery) = view.battery(*id) {
                batteries.vehicles.push(vehicle);
                series.publish("battery/soc", "1", vehicle, battery.soc);
            }
        }
        batteries.spent_j = vec![0.0; batteries.vehicles.len()];
        if !batteries.vehicles.is_empty() {
            statistics.energy = series.statistic("energy", "J");
        }
        statistics
    }

    /// The run stands at this instant.
    pub(super) fn stood(&mut self, now_ns: u64, wall: Duration) {
        self.pace.stood(now_ns, wall);
    }

    /// Looks at every battery: there is no other sample to come.
    pub(super) fn look_at_all(&mut self, view: &View<'_>, cast: &Cast, series: &mut Series) {
        if !self.batteries.vehicles.is_empty() {
            self.batteries.look(view, cast, f64::INFINITY, series);
        }
    }

    /// Whether it is time for a sample; `last`: there is no other to come.
    pub(super) fn due(&mut self, now_ns: u64, wall: Duration, last: bool) -> bool {
        if self.last.is_none() {
            self.pace.stood(now_ns, wall);
        }
        let (from_ns, from) = *self.last.get_or_insert((now_ns, wall));
        let passed_s = now_ns.saturating_sub(from_ns) as f64 * 1e-9;
        let waited = wall.saturating_sub(from);
        let due = waited >= SAMPLE_MOST || (passed_s >= SAMPLE_S && waited >= SAMPLE_LEAST);
        passed_s > 0.0 && (due || last)
    }

    /// Takes a sample. `touches`: contacts since the start.
    pub(super) fn sample(
        &mut self,
        view: &View<'_>,
        cast: &Cast,
        (wall, watched, held): (Duration, bool, bool),
        touches: u64,
        series: &mut Series,
    ) {
        let now_ns = view.now().nanos();
        let (from_ns, from) = self.last.replace((now_ns, wall)).unwrap_or((now_ns, wall));
        let passed_s = now_ns.saturating_sub(from_ns) as f64 * 1e-9;
        let waited_s = wall.saturating_sub(from).as_secs_f64();
        let speed = match held {
            true => 0.0,
            false => self.pace.speed(now_ns, wall),
        };
        series.set(self.speed, speed);
        let new = touches - std::mem::replace(&mut self.last_touches, touches);
        series.set(self.contacts, new as f64 / passed_s);
        if let Some(air) = &mut self.air {
            let now = view.radio_counters(None);
            let before = std::mem::replace(&mut air.last, now);
            let since =
                |what: fn(&Counters) -> u64| what(&now).saturating_sub(what(&before)) as f64;
            let (sent, received) = (since(|c| c.sent), since(|c| c.received));
            let missed = since(|c| c.missed().saturating_sub(c.lost(Loss::OutOfRange)));
            series.set(air.sent, sent / passed_s);
            series.set(air.received, received / passed_s);
            series.set(air.delivery, air.lately.share(now_ns, received, missed));
        }
        if !self.batteries.vehicles.is_empty() {
            let rate = if watched {
                BATTERIES_WATCHED
            } else {
                BATTERIES_ALONE
            };
            self.batteries.look(view, cast, rate * waited_s, series);
            series.set(self.energy, self.batteries.spent_j.iter().sum());
        }
        series.sampled(view.now().as_secs_f64());
    }
}

impl Batteries {
    /// Looks at the next ones, as many as that, at least at one and at none twice.
    fn look(&mut self, view: &View<'_>, cast: &Cast, count: f64, series: &mut Series) {
        let all = self.vehicles.len();
        for _ in 0..(count as usize).clamp(1, all) {
            self.next = (self.next + 1) % all;
            let vehicle = self.vehicles[self.next];
            let id = cast.bodies[vehicle as usize];
            if let Some((state, books)) = view.battery_books(id) {
                series.publish("battery/soc", "1", vehicle, state.soc);
                let spent = books.start - books.stored + books.charged;
                self.spent_j[self.next] = spent.get();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_is_a_mean_over_a_second_and_a_pause_is_no_part_of_it() {
        let mut passed = Passed::default();
        let at = Duration::from_millis;
        passed.stood(0, at(0));
        for tenth in 1..=30 {
            passed.speed(tenth * 100_000_000, at(tenth * 100));
        }
        // It catches up: a tenth of a second within ten milliseconds.
        let speed = passed.speed(3_100_000_000, at(3010));
        assert!((1.0..1.2).contains(&speed), "{speed}");
        passed.stood(3_100_000_000, at(60_000));
        let speed = passed.speed(3_300_000_000, at(60_100));
        assert!((speed - 2.0).abs() < 1e-9, "{speed}");
    }

    #[test]
    fn the_delivery_is_that_of_the_last_second_whatever_a_single_sample_has() {
        let mut lately = Delivered::default();
        let at = |tenth: u64| tenth * 100_000_000;
        assert!(lately.share(at(1), 0.0, 0.0).is_nan());
        assert_eq!(lately.share(at(2), 9.0, 0.0), 1.0);
        assert_eq!(lately.share(at(3), 0.0, 0.0), 1.0);
        assert_eq!(lately.share(at(4), 0.0, 1.0), 0.9);
        assert_eq!(lately.share(at(11), 0.0, 0.0), 0.9);
        assert_eq!(lately.share(at(12), 3.0, 0.0), 0.75);
        assert!(lately.share(at(40), 0.0, 0.0).is_nan());
        // Samples farther apart than that are of their own time.
        assert_eq!(lately.share(at(90), 1.0, 1.0), 0.5);
        assert_eq!(lately.share(at(130), 1.0, 0.0), 1.0);
    }
}
