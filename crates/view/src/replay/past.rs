//! What is read of a recording once: marks, statistics, wind, and what vehicles published.

use super::faults::Faults;
use super::rates::{self, Rates, steps};
use super::vehicle_of;
use crate::series::{History, Series};
use crate::wire::{Mark, seconds};
use simbeeotic_record::{Metrics, Recording, Wind};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

/// Marks that a page is told.
const MARKS_MAX: usize = 5000;

/// Winds that a page is told: 10 kB each.
const WINDS_MAX: usize = 120;

/// Bytes of columns that are kept to colour vehicles by.
const COLUMNS_BYTES: usize = 32 << 20;

/// Columns of one series that are kept at most.
const COLUMNS_MAX: usize = 2000;

/// One number of each vehicle at some times, s.
type Columns = Vec<(f64, Arc<[f32]>)>;

/// What is known of the whole recording.
pub(super) struct Past {
    pub(super) marks: Vec<Mark>,
    pub(super) marks_dropped: u64,
    pub(super) series: Series,
    /// In the order of their times: each holds until the next one.
    pub(super) wind: Vec<Wind>,
    /// What vehicles published, at some times: by the name of the series.
    columns: BTreeMap<String, Columns>,
    /// What could not be read, for people.
    pub(super) faults: Vec<String>,
}

impl Past {
    /// What `read` returns; if it panics, nothing but the word that it did, so that nobody waits for what never comes.
    pub(super) fn or_empty(places: &BTreeMap<String, u32>, read: impl FnOnce() -> Self) -> Self {
        catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
            let text = text.or_else(|| panic.downcast_ref::<String>().cloned());
            let why = text.unwrap_or_else(|| "no reason is known".to_owned());
            let mut past = Self::empty(places);
            past.faults = vec![format!(
                "marks, statistics and wind of the recording could not be read: {why}"
            )];
            past
        })
    }

    fn empty(places: &BTreeMap<String, u32>) -> Self {
        Self {
            marks: Vec::new(),
            marks_dropped: 0,
            series: Series::new(places.len()),
            wind: Vec::new(),
            columns: BTreeMap::new(),
            faults: Vec::new(),
        }
    }

    pub(super) fn read(recording: &Recording, places: &BTreeMap<String, u32>) -> Self {
        let faults = Faults::default();
        let mut past = Self::empty(places);
        (past.marks, past.marks_dropped) = marks(recording, places, &faults);
        let mut wind = Thin::new(WINDS_MAX);
        faults
            .good(recording.wind_in(0..=u64::MAX))
            .for_each(|it| wind.push(it));
        past.wind = wind.list;
        past.read_series(recording, places, &faults);
        past.faults = faults.into_list();
        past
    }

    /// Walks along the numbers of the recording, each kind in the order of its times.
    fn read_series(
        &mut self,
        recording: &Recording,
        places: &BTreeMap<String, u32>,
        faults: &Faults,
    ) {
        let end_s = seconds(recording.end_ns());
        // A thousand values, or one a second, whichever is more.
        let period_s = (end_s / 1000.0).clamp(0.001, 1.0);
        let mut rates = Rates::start(recording, faults, &mut self.series);
        let mut metrics = faults.good(recording.metrics()).peekable();
        let count = places.len().max(1);
        let most = (COLUMNS_BYTES / (4 * count * 4)).clamp(10, COLUMNS_MAX);
        let (mut next_s, every_s) = (0.0, end_s / most as f64);
        for (from_s, time_s) in steps(period_s, end_s) {
            rates.set(from_s, time_s, &mut self.series);
            while let Some(list) = metrics.next_if(|list| seconds(list.time_ns) <= time_s) {
                self.publish(&list, places);
            }
            self.series.sampled(time_s);
            if time_s >= next_s {
                next_s = time_s + every_s;
                for name in self.series.names() {
                    let Some(column) = self.series.column(&name) else {
                        continue;
                    };
                    let column = column.into();
                    self.columns.entry(name).or_default().push((time_s, column));
                }
            }
        }
    }

    fn publish(&mut self, list: &Metrics, places: &BTreeMap<String, u32>) {
        for metric in &list.values {
            let unit = match metric.unit.as_str() {
                "" => "1",
                unit => unit,
            };
            match vehicle_of(places, &metric.name) {
                Some((vehicle, name)) if !name.is_empty() => {
                    self.series.publish(name, unit, vehicle, metric.value);
                }
                _ if rates::NAMES.contains(&metric.name.as_str()) => {}
                _ => {
                    let at = self.series.statistic(&metric.name, unit);
                    self.series.set(at, metric.value);
                }
            }
        }
    }

    /// What all vehicles had last published at a time.
    pub(super) fn column(&self, name: &str, time_s: f64) -> Option<Arc<[f32]>> {
        let list = self.columns.get(name)?;
        let after = list.partition_point(|(t, _)| *t <= time_s);
        // What was sampled a little later is better than nothing.
        let (_, column) = list.get(after.saturating_sub(1))?;
        Some(Arc::clone(column))
    }
}

/// What one vehicle published, by the name of the series: read from the file.
pub(super) fn of_vehicle(recording: &Recording, path: &str) -> BTreeMap<String, History> {
    let mut all: BTreeMap<String, History> = BTreeMap::new();
    for list in recording.metrics().flatten() {
        let time_s = seconds(list.time_ns);
        for metric in &list.values {
            let rest = metric.name.strip_prefix(path);
            if let Some(name) = rest.and_then(|rest| rest.strip_prefix('/')) {
                all.entry(name.to_owned())
                    .or_default()
                    .push(time_s, metric.value);
            }
        }
    }
    all
}

/// Events and log lines in the order of their times, thinned if they are too many.
fn marks(
    recording: &Recording,
    places: &BTreeMap<String, u32>,
    faults: &Faults,
) -> (Vec<Mark>, u64) {
    let who = |path: &str| vehicle_of(places, path).map(|(vehicle, _)| vehicle);
    let events = faults.good(recording.events()).map(|event| {
        let who = event.paths.iter().filter_map(|path| who(path)).collect();
        (seconds(event.time_ns), event.kind, who, event.text)
    });
    let lines = faults.good(recording.log()).map(|line| {
        let who = who(&line.path).into_iter().collect();
        (seconds(line.time_ns), "log".to_owned(), who, line.text)
    });
    let mut thin = Thin::new(MARKS_MAX);
    let mark = |(t, kind, who, text): (f64, String, Vec<u32>, String)| Mark {
        t,
        kind: kind.into(),
        who,
        text,
    };
    events
        .chain(lines)
        .map(mark)
        .for_each(|mark| thin.push(mark));
    let mut list = thin.list;
    list.sort_by(|a, b| a.t.total_cmp(&b.t));
    let dropped = thin.seen - list.len() as u64;
    (list, dropped)
}

/// Every n-th of a list whose length is not known before.
struct Thin<T> {
    list: Vec<T>,
    most: usize,
    every: u64,
    seen: u64,
}

impl<T> Thin<T> {
    fn new(most: usize) -> Self {
        Self {
            list: Vec::new(),
            most,
            every: 1,
            seen: 0,
        }
    }

    fn push(&mut self, item: T) {
        if self.seen.is_multiple_of(self.every) {
            if self.list.len() >= self.most {
                let mut keep = false;
                self.list.retain(|_| {
                    keep = !keep;
                    keep
                });
                self.every *= 2;
            }
            self.list.push(item);
        }
        self.seen += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_thinned_evenly() {
        let mut thin = Thin::new(MARKS_MAX);
        for t in 0..100_000 {
            thin.push(Mark {
                t: f64::from(t),
                kind: "contact".into(),
                who: Vec::new(),
                text: String::new(),
            });
        }
        assert!((MARKS_MAX / 2..=MARKS_MAX).contains(&thin.list.len()));
        assert_eq!(thin.list[0].t, 0.0);
        assert!(thin.list[thin.list.len() - 1].t > 99_900.0);
    }
}
