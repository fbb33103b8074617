//! Numbers over time: statistics of the run, and what vehicles publish.

use crate::wire::SeriesInfo;
use std::collections::{BTreeMap, VecDeque};

/// Points that a history has at most.
const POINTS_MAX: usize = 2000;

/// Histories of single vehicles' numbers at most.
const VEHICLES_MAX: usize = 1024;

/// The newest samples of the run's statistics, for pages that were slow.
const SAMPLES_KEPT: usize = 512;

/// One sample: its time, s, and values by the ids of their series.
pub(crate) type Sample = (f64, Vec<(u32, f64)>);

/// Ids of vehicles' series are their number beyond so many for each column.
const COLUMN: u32 = 1 << 20;

/// Columns at most: a model may make names up as it goes.
const COLUMNS_MAX: usize = 256;

/// A number over time, bounded: when it is full, every second point goes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct History {
    pub(crate) times_s: Vec<f64>,
    pub(crate) values: Vec<f64>,
    /// Points come no closer than this, s.
    every_s: f64,
}

impl History {
    /// The value at a time: that of the last point not after it.
    pub(crate) fn at(&self, time_s: f64) -> f64 {
        let after = self.times_s.partition_point(|t| *t <= time_s);
        let before = after.checked_sub(1);
        before.map_or(f64::NAN, |at| self.values[at])
    }

    /// Adds a point, unless the last one is too near.
    pub(crate) fn push(&mut self, time_s: f64, value: f64) {
        if let Some(last) = self.times_s.last()
            && time_s < last + self.every_s
        {
            return;
        }
        if self.times_s.len() >= POINTS_MAX {
            let thin = |list: &mut Vec<f64>| {
                let mut keep = false;
                list.retain(|_| {
                    keep = !keep;
                    keep
                });
            };
            thin(&mut self.times_s);
            thin(&mut self.values);
            let span_s = time_s - self.times_s.first().copied().unwrap_or(time_s);
            self.every_s = span_s / (POINTS_MAX / 2) as f64;
        }
        self.times_s.push(time_s);
        self.values.push(value);
    }
}

/// A statistic of the run.
#[derive(Clone, Debug)]
struct OfRun {
    name: String,
    unit: String,
    value: f64,
    history: History,
}

/// A number that vehicles publish.
#[derive(Clone, Debug)]
struct Column {
    name: String,
    unit: String,
    /// NaN: none yet.
    values: Vec<f32>,
    sum: f64,
    count: usize,
    /// Where its sum and its mean stand among the statistics.
    sum_at: usize,
    mean_at: usize,
}

/// All series of a run.
#[derive(Debug, Default)]
pub(crate) struct Series {
    run: Vec<OfRun>,
    columns: Vec<Column>,
    vehicles: usize,
    of_vehicles: BTreeMap<u32, History>,
    time_s: f64,
    /// Counts samples.
    number: u64,
    /// The newest of them.
    past: VecDeque<Sample>,
}

impl Series {
    pub(crate) fn new(vehicles: usize) -> Self {
        Self {
            vehicles,
            ..Self::default()
        }
    }

    /// The place of a statistic, which is its id; made if it is new.
    pub(crate) fn statistic(&mut self, name: &str, unit: &str) -> usize {
        let known = self.run.iter().position(|series| series.name == name);
        known.unwrap_or_else(|| {
            self.run.push(OfRun {
                name: name.to_owned(),
                unit: unit.to_owned(),
                value: f64::NAN,
                history: History::default(),
            });
            self.run.len() - 1
        })
    }

    /// Sets a statistic.
    pub(crate) fn set(&mut self, at: usize, value: f64) {
        if let Some(series) = self.run.get_mut(at) {
            series.value = value;
        }
    }

    /// Sets what a vehicle publishes.
    pub(crate) fn publish(&mut self, name: &str, unit: &str, vehicle: u32, value: f64) {
        let known = self.columns.iter().position(|column| column.name == name);
        let at = match known {
            Some(at) => at,
            None if self.columns.len() < COLUMNS_MAX => {
                let sum_at = self.statistic(&format!("{name}/sum"), unit);
                let mean_at = self.statistic(&format!("{name}/mean"), unit);
                self.columns.push(Column {
                    name: name.to_owned(),
                    unit: unit.to_owned(),
                    values: vec![f32::NAN; self.vehicles],
                    sum: 0.0,
                    count: 0,
                    sum_at,
                    mean_at,
                });
                self.columns.len() - 1
            }
            None => return,
        };
        let column = &mut self.columns[at];
        let Some(old) = column.values.get_mut(vehicle as usize) else {
            return;
        };
        // What is summed is what is kept, so that sums do not drift.
        let new = value as f32;
        for (number, sign) in [(*old, -1.0), (new, 1.0)] {
            if number.is_finite() {
                column.sum += sign * f64::from(number);
                column.count = column.count.wrapping_add_signed(sign as isize);
            }
        }
        *old = new;
    }

    /// Ends a sample: all statistics have their values.
    pub(crate) fn sampled(&mut self, time_s: f64) {
        for column in &self.columns {
            let mean = column.sum / column.count as f64;
            for (at, value) in [(column.sum_at, column.sum), (column.mean_at, mean)] {
                if let Some(series) = self.run.get_mut(at) {
                    series.value = value;
                }
            }
        }
        for series in &mut self.run {
            series.history.push(time_s, series.value);
        }
        let few = self.columns.len() * self.vehicles <= VEHICLES_MAX;
        let followed: Vec<u32> = match few {
            true => (self.columns.iter().enumerate())
                .flat_map(|(at, column)| {
                    let values = column.values.iter().enumerate();
                    let known = values.filter(|(_, value)| !value.is_nan());
                    known.map(move |(vehicle, _)| id(at, vehicle as u32))
                })
                .collect(),
            false => self.of_vehicles.keys().copied().collect(),
        };
        for id in followed {
            let value = self.value_of(id);
            self.of_vehicles.entry(id).or_default().push(time_s, value);
        }
        self.time_s = time_s;
        self.number += 1;
        if self.past.len() >= SAMPLES_KEPT {
            self.past.pop_front();
        }
        self.past.push_back(self.values(None));
    }

    fn value_of(&self, id: u32) -> f64 {
        let (column, vehicle) = (id / COLUMN, id % COLUMN);
        let column = column
            .checked_sub(1)
            .and_then(|at| self.columns.get(at as usize));
        let value = column.and_then(|column| column.values.get(vehicle as usize));
        value.map_or(f64::NAN, |value| f64::from(*value))
    }

    /// Keeps a history of a vehicle's numbers from now on.
    pub(crate) fn follow(&mut self, vehicle: u32) {
        for at in 0..self.columns.len() {
            if self.of_vehicles.len() < VEHICLES_MAX {
                self.of_vehicles.entry(id(at, vehicle)).or_default();
            }
        }
    }

    /// How many samples there were.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }

    /// How many statistics of the run there are, and how many columns.
    pub(crate) fn counts(&self) -> (usize, usize) {
        (self.run.len(), self.columns.len())
    }

    /// The statistics from one on.
    pub(crate) fn statistics_from(&self, first: usize) -> Vec<SeriesInfo> {
        let list = self.run.iter().enumerate().skip(first);
        list.map(|(at, series)| SeriesInfo {
            id: at as u32,
            name: series.name.clone(),
            unit: series.unit.clone(),
            vehicle: None,
        })
        .collect()
    }

    /// The series of a vehicle.
    pub(crate) fn of_vehicle(&self, vehicle: u32) -> Vec<SeriesInfo> {
        let list = self.columns.iter().enumerate();
        let list = list.filter(|(_, column)| (vehicle as usize) < column.values.len());
        list.map(|(at, column)| SeriesInfo {
            id: id(at, vehicle),
            name: column.name.clone(),
            unit: column.unit.clone(),
            vehicle: Some(vehicle),
        })
        .collect()
    }

    /// All there is of one series.
    pub(crate) fn history(&self, id: u32) -> Option<&History> {
        match self.run.get(id as usize) {
            Some(series) => Some(&series.history),
            None => self.of_vehicles.get(&id),
        }
    }

    /// The newest values: of the run, and of one vehicle.
    pub(crate) fn values(&self, vehicle: Option<u32>) -> (f64, Vec<(u32, f64)>) {
        let run = self.run.iter().enumerate();
        let mut list: Vec<(u32, f64)> = run.map(|(at, s)| (at as u32, s.value)).collect();
        if let Some(vehicle) = vehicle {
            let ids = (0..self.columns.len()).map(|at| id(at, vehicle));
            list.extend(ids.map(|id| (id, self.value_of(id))));
        }
        (self.time_s, list)
    }

    /// The samples after the first `seen`, the oldest first; the newest has the values of one vehicle, too. `None`: some
    /// of them are not kept.
    pub(crate) fn since(&self, seen: u64, vehicle: Option<u32>) -> Option<Vec<Sample>> {
        let new = usize::try_from(self.number.saturating_sub(seen)).ok()?;
        let first = self.past.len().checked_sub(new)?;
        let mut list: Vec<Sample> = self.past.range(first..).cloned().collect();
        if let Some(newest) = list.last_mut() {
            *newest = self.values(vehicle);
        }
        Some(list)
    }

    /// The numbers of all vehicles.
    pub(crate) fn column(&self, name: &str) -> Option<&[f32]> {
        let column = self.columns.iter().find(|column| column.name == name)?;
        Some(&column.values)
    }

    /// What a series of a vehicle is: its column and the vehicle.
    pub(crate) fn parts_of(id: u32) -> Option<(usize, u32)> {
        Some(((id / COLUMN).checked_sub(1)? as usize, id % COLUMN))
    }

    /// The names of what vehicles publish.
    pub(crate) fn names(&self) -> Vec<String> {
        self.columns.iter().map(|c| c.name.clone()).collect()
    }
}

fn id(column: usize, vehicle: u32) -> u32 {
    (column as u32 + 1) * COLUMN + vehicle
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_history_stays_short_and_keeps_its_span() {
        let mut history = History::default();
        for tick in 0..1_000_000 {
            history.push(f64::from(tick) * 0.1, f64::from(tick));
        }
        let times = &history.times_s;
        assert!(
            (POINTS_MAX / 4..=POINTS_MAX).contains(&times.len()),
            "{}",
            times.len()
        );
        assert_eq!(times.len(), history.values.len());
        assert_eq!(times[0], 0.0);
        assert!(times[times.len() - 1] > 99_000.0);
        assert!(times.is_sorted());
    }

    #[test]
    fn sums_and_means_are_of_those_that_publish() {
        let mut series = Series::new(3);
        let speed = series.statistic("speed", "1");
        series.publish("pollen", "g", 0, 1.0);
        series.publish("pollen", "g", 2, 4.0);
        series.publish("pollen", "g", 2, 5.0);
        series.publish("pollen", "g", 1, f64::NAN);
        series.set(speed, 2.0);
        series.sampled(1.0);
        let names: Vec<String> = series
            .statistics_from(0)
            .into_iter()
            .map(|s| s.name)
            .collect();
        assert_eq!(names, ["speed", "pollen/sum", "pollen/mean"]);
        let (time_s, values) = series.values(Some(2));
        assert_eq!(time_s, 1.0);
        assert_eq!(values, [(0, 2.0), (1, 6.0), (2, 3.0), (COLUMN + 2, 5.0)]);
        let column = series.column("pollen").expect("it is there");
        assert_eq!((column[0], column[2]), (1.0, 5.0));
        let history = series.history(COLUMN + 2).expect("the swarm is small");
        assert_eq!(history.values, [5.0]);
        assert!(
            series.history(COLUMN + 1).is_none(),
            "it has published nothing"
        );
    }

    #[test]
    fn a_slow_reader_gets_every_sample_that_is_kept() {
        let mut series = Series::new(1);
        let contacts = series.statistic("contacts", "1/s");
        for second in 1..=600 {
            series.set(contacts, f64::from(second % 2));
            series.sampled(f64::from(second));
        }
        let list = series.since(597, None).expect("they are kept");
        let told = [(598.0, 0.0), (599.0, 1.0), (600.0, 0.0)];
        assert_eq!(list, told.map(|(t, value)| (t, vec![(0, value)])));
        assert_eq!(series.since(600, None), Some(Vec::new()));
        assert_eq!(series.since(3, None), None, "the history has them");
    }

    #[test]
    fn large_swarms_have_histories_of_those_looked_at_only() {
        let mut series = Series::new(10_000);
        for vehicle in 0..10_000 {
            series.publish("soc", "1", vehicle, 0.5);
        }
        series.sampled(0.0);
        assert!(series.history(COLUMN + 7).is_none());
        series.follow(7);
        series.sampled(1.0);
        assert_eq!(series.history(COLUMN + 7).map(|h| h.times_s.len()), Some(1));
        series.publish("soc", "1", 4_000_000, 1.0);
        assert!(series.history(u32::MAX).is_none());
    }
}
