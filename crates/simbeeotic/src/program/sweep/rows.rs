//! What a run comes to: a row of the table.

use simbeeotic_model::Summary;
use simbeeotic_record::Column;
use simbeeotic_scenario::Sweep;
use std::collections::BTreeMap;

/// One run that ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Row {
    /// Counted from 0.
    pub(super) run: usize,
    pub(super) seed: i64,
    pub(super) trace_hash: String,
    pub(super) ended: String,
    /// Why it failed; empty if it did not.
    pub(super) error: String,
    numbers: Vec<Number>,
}

/// A number of a run.
#[derive(Clone, Debug, PartialEq)]
struct Number {
    /// With its unit: `spread/mean [m]`.
    name: String,
    value: f64,
}

/// The numbers that every run has; what follows was published by models.
const OWN: [&str; 4] = ["virtual_s", "contacts", "packets/sent", "packets/received"];
/// There if there are batteries.
const ENERGY: &str = "energy/spent [J]";
/// What the mean of a published number is called by.
const MEAN: &str = "/mean";
/// What stands behind the name of a published number that could be taken for another column.
const PUBLISHED: &str = " (published)";
/// Columns that are no numbers.
const WORDS: [&str; 5] = ["run", "seed", "trace_hash", "ended", "error"];

impl Row {
    pub(super) fn of(run: usize, summary: &Summary) -> Self {
        let s = summary;
        let own = [
            s.virtual_s,
            s.touches as f64,
            s.packets.sent as f64,
            s.packets.received as f64,
        ];
        let mut numbers: Vec<Number> = Vec::new();
        let mut add = |name: String, value: f64| numbers.push(Number { name, value });
        for (name, value) in OWN.iter().zip(own) {
            add((*name).to_owned(), value);
        }
        if let Some(all) = &s.batteries {
            add(ENERGY.to_owned(), all.spent_j);
        }
        for line in &s.metrics {
            let unit = match line.unit.as_str() {
                "1" | "" => String::new(),
                unit => format!(" [{unit}]"),
            };
            let name = published(&line.name);
            add(format!("{name}{unit}"), line.sum);
            add(format!("{name}{MEAN}{unit}"), line.mean);
        }
        Self {
            run,
            seed: s.seed.cast_signed(),
            trace_hash: s.trace_hash.clone(),
            ended: s.ended.clone(),
            error: String::new(),
            numbers,
        }
    }

    /// A run that is done already.
    pub(super) fn again(
        run: usize,
        seed: i64,
        trace_hash: &str,
        ended: &str,
        numbers: Vec<(String, f64)>,
    ) -> Self {
        let numbers = numbers.into_iter();
        Self {
            run,
            seed,
            trace_hash: trace_hash.to_owned(),
            ended: ended.to_owned(),
            error: String::new(),
            numbers: numbers
                .map(|(name, value)| Number { name, value })
                .collect(),
        }
    }

    /// Its numbers by their names.
    pub(super) fn numbers(&self) -> impl Iterator<Item = (&str, f64)> {
        self.numbers
            .iter()
            .map(|number| (number.name.as_str(), number.value))
    }

    /// A run that could not be put together.
    pub(super) fn failed(run: usize, seed: Option<i64>, error: String) -> Self {
        Self {
            run,
            seed: seed.unwrap_or_default(),
            ended: "failed".to_owned(),
            error,
            ..Self::default()
        }
    }

    /// The same run, failed.
    pub(super) fn with_error(mut self, error: String) -> Self {
        self.error = error;
        "failed".clone_into(&mut self.ended);
        self
    }

    pub(super) fn number(&self, name: &str) -> Option<f64> {
        let number = self.numbers.iter().find(|number| number.name == name);
        number.map(|number| number.value)
    }
}

/// What a published number is called here. One that has a name of ours, or one that ends as those of means do, is
/// marked, whatever else the run published: a column means the same in all runs.
fn published(name: &str) -> String {
    let mut ours = OWN.iter().chain(&WORDS).chain([&ENERGY]);
    let is_ours = ours.any(|column| column.split(" [").next() == Some(name));
    match is_ours || name.ends_with(MEAN) {
        true => format!("{name}{PUBLISHED}"),
        false => name.to_owned(),
    }
}

/// All runs that ended, with the values that set them apart.
pub(super) struct Rows {
    keys: Vec<String>,
    rows: Vec<(Vec<String>, Row)>,
    /// The names of all numbers: the runs' own first.
    names: Vec<String>,
}

impl Rows {
    pub(super) fn of(sweep: &Sweep, rows: Vec<Row>) -> Self {
        let mut published: BTreeMap<String, ()> = BTreeMap::new();
        for number in rows.iter().flat_map(|row| &row.numbers) {
            published.insert(number.name.clone(), ());
        }
        let mut names: Vec<String> = OWN.map(str::to_owned).to_vec();
        names.extend(published.remove(ENERGY).map(|()| ENERGY.to_owned()));
        for name in &names {
            published.remove(name);
        }
        names.extend(published.into_keys());
        Self {
            keys: sweep.keys().map(str::to_owned).collect(),
            rows: rows
                .into_iter()
                .map(|row| (sweep.values(row.run), row))
                .collect(),
            names,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether a run, counted from 0, has a row.
    pub(super) fn has(&self, run: usize) -> bool {
        let place = self.rows.binary_search_by_key(&run, |(_, row)| row.run);
        place.is_ok()
    }

    pub(super) fn failed(&self) -> usize {
        self.rows
            .iter()
            .filter(|(_, row)| !row.error.is_empty())
            .count()
    }

    pub(super) fn keys(&self) -> &[String] {
        &self.keys
    }

    /// The names of the numbers.
    pub(super) fn names(&self) -> &[String] {
        &self.names
    }

    /// The runs that came to their end, with their values, in order.
    pub(super) fn good(&self) -> impl Iterator<Item = &(Vec<String>, Row)> {
        self.rows.iter().filter(|(_, row)| row.error.is_empty())
    }

    /// The table: a row for each run, in their order.
    pub(super) fn columns(&self) -> Vec<Column> {
        let rows = || self.rows.iter().map(|(_, row)| row);
        let texts =
            |name: &str, of: fn(&Row) -> String| Column::texts(name, rows().map(of).collect());
        let mut columns = vec![
            Column::integers("run", rows().map(|row| row.run as i64 + 1).collect()),
            Column::integers("seed", rows().map(|row| row.seed).collect()),
        ];
        for (at, key) in self.keys.iter().enumerate() {
            let values = self.rows.iter().map(|(values, _)| values[at].clone());
            columns.push(Column::texts(key, values.collect()));
        }
        columns.push(texts("trace_hash", |row| row.trace_hash.clone()));
        columns.push(texts("ended", |row| row.ended.clone()));
        columns.push(texts("error", |row| row.error.trim_end().to_owned()));
        for name in &self.names {
            let values = rows().map(|row| row.number(name).unwrap_or(f64::NAN));
            columns.push(Column::floats(name, values.collect()));
        }
        columns
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_model::summary::MetricLine;

    #[test]
    fn numbers_of_models_have_their_units_and_do_not_hide_those_of_the_run() {
        let metric = |name: &str, unit: &str| MetricLine {
            name: name.to_owned(),
            unit: unit.to_owned(),
            models: 4,
            count: 8,
            sum: 10.0,
            mean: 2.5,
            ..MetricLine::default()
        };
        let summary = Summary {
            touches: 7,
            metrics: vec![
                metric("contacts", "1"),
                metric("spread", "m"),
                metric("drift", "m"),
                metric("drift/mean", "m"),
                metric("seed", "1"),
                metric("energy/spent", "kJ"),
            ],
            ..Summary::default()
        };
        let row = Row::of(3, &summary);
        for (name, value) in [
            ("contacts", 7.0),
            ("contacts (published)", 10.0),
            ("contacts (published)/mean", 2.5),
            ("seed (published)", 10.0),
            ("energy/spent (published) [kJ]", 10.0),
            ("drift/mean [m]", 2.5),
            ("drift/mean (published) [m]", 10.0),
            ("spread [m]", 10.0),
            ("spread/mean [m]", 2.5),
            ("virtual_s", 0.0),
        ] {
            assert_eq!(row.number(name), Some(value), "{name}");
        }
        assert_eq!(row.number(ENERGY), None, "there are no batteries");
        // Alone it has the same name, and no other number has it.
        let alone = Summary {
            metrics: vec![metric("drift/mean", "m")],
            ..Summary::default()
        };
        let alone = Row::of(0, &alone);
        assert_eq!(alone.number("drift/mean [m]"), None);
        assert_eq!(alone.number("drift/mean (published) [m]"), Some(10.0));
    }

    #[test]
    fn a_row_that_was_kept_as_text_is_the_same_to_the_last_bit() {
        let numbers = [0.1 + 0.2, -0.0, 1e300, 5e-324, f64::INFINITY, 1.0 / 3.0];
        for number in numbers {
            let again: f64 = number.to_string().parse().expect("a number");
            assert_eq!(again.to_bits(), number.to_bits(), "{number}");
        }
        let numbers = numbers.map(|number| (number.to_string(), number)).to_vec();
        let row = Row::again(3, -7, "0f", "end time", numbers.clone());
        let read: Vec<(String, f64)> = row
            .numbers()
            .map(|(name, value)| (name.to_owned(), value))
            .collect();
        assert_eq!(read, numbers);
    }
}
