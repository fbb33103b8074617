//! A table of runs, as `simbeeotic sweep` writes it, read.

use super::super::Failure;
use super::tables::{refused, rows};
use simbeeotic_scenario::sweep::quantity;
use simbeeotic_units::did_you_mean;
use std::path::{Path, PathBuf};

/// The column behind those that set runs apart.
const TRACE: &str = "trace_hash";
/// Columns behind it that are no numbers.
const WORDS: [&str; 2] = ["ended", "error"];

/// The table.
pub(super) struct Runs {
    path: PathBuf,
    names: Vec<String>,
    rows: Vec<Vec<String>>,
    /// The place of the column `seed`.
    seed: usize,
    /// That of `trace_hash`.
    trace: usize,
    /// That of `error`.
    error: Option<usize>,
}

/// One of its columns.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) name: String,
    pub(super) place: usize,
}

impl Column {
    /// The name without the unit.
    pub(super) fn base(&self) -> &str {
        base(&self.name)
    }

    /// The unit; empty if there is none.
    pub(super) fn unit(&self) -> &str {
        match self.name.split_once(" [") {
            Some((_, unit)) => unit.trim_end_matches(']'),
            None if self.name.ends_with("_s") => "s",
            None => "",
        }
    }
}

fn base(name: &str) -> &str {
    name.split_once(" [").map_or(name, |(base, _)| base)
}

/// What the values of a column are.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    /// Numbers of one unit, with the least and the greatest.
    Numbers { low: f64, high: f64, unit: String },
    /// Words, each once, in the order of the table.
    Words(Vec<String>),
}

impl Values {
    /// Where a value stands on an axis.
    pub(super) fn place(&self, text: &str) -> Option<f64> {
        match self {
            Self::Numbers { .. } => quantity(text).map(|(number, _)| number),
            Self::Words(names) => {
                let place = names.iter().position(|name| name == text);
                place.map(|place| place as f64)
            }
        }
    }
}

impl Runs {
    pub(super) fn open(path: &Path) -> Result<Self, Failure> {
        let refused = |what: &str| refused(path, what);
        let mut rows = rows(path)?.into_iter();
        let names = rows.next().unwrap_or_default();
        let rows: Vec<Vec<String>> = rows.collect();
        let of = |wanted: &str| names.iter().position(|name| name == wanted);
        let (Some(0), Some(seed), Some(trace)) = (of("run"), of("seed"), of(TRACE)) else {
            return Err(refused("this is no table of runs"));
        };
        if let Some(at) = rows.iter().position(|row| row.len() != names.len()) {
            return Err(refused(&format!(
                "row {} has {} fields where {} have names",
                at + 1,
                rows[at].len(),
                names.len()
            )));
        }
        let runs = Self {
            error: of("error"),
            path: path.to_path_buf(),
            names,
            rows,
            seed,
            trace,
        };
        if runs.good().next().is_none() {
            return Err(refused("no run in it came to its end"));
        }
        Ok(runs)
    }

    fn is_good(&self, row: &[String]) -> bool {
        self.error.is_none_or(|error| row[error].is_empty())
    }

    /// The seed of a run.
    pub(super) fn seed<'r>(&self, row: &'r [String]) -> &'r str {
        row.get(self.seed).map_or("", String::as_str)
    }

    /// The runs that came to their end.
    pub(super) fn good(&self) -> impl Iterator<Item = &Vec<String>> {
        self.rows.iter().filter(|row| self.is_good(row))
    }

    /// How many did not.
    pub(super) fn failed(&self) -> usize {
        self.rows.len() - self.good().count()
    }

    fn column(&self, place: usize) -> Column {
        Column {
            name: self.names[place].clone(),
            place,
        }
    }

    /// A column that sets runs apart, by its name or by the end of it: `count` is `model.bee.count`.
    pub(super) fn key(&self, flag: &str, name: &str) -> Result<Column, Failure> {
        let keys = &self.names[1..self.trace];
        if let Some(at) = keys.iter().position(|key| key == name) {
            return Ok(self.column(at + 1));
        }
        let is_end = |key: &str| {
            key.strip_suffix(name)
                .is_some_and(|front| front.ends_with('.'))
        };
        let ends: Vec<usize> = (0..keys.len()).filter(|at| is_end(&keys[*at])).collect();
        match ends.as_slice() {
            [at] => Ok(self.column(at + 1)),
            [] => {
                let guess = did_you_mean(name, keys.iter().map(String::as_str));
                let guess =
                    guess.map_or(String::new(), |guess| format!(" did you mean `{guess}`?"));
                Err(Failure::input(format!(
                    "{flag} {name}: nothing of this name was varied in {};{guess} it has {}",
                    self.path.display(),
                    keys.join(", ")
                )))
            }
            several => {
                let names: Vec<&str> = several.iter().map(|at| keys[*at].as_str()).collect();
                Err(Failure::input(format!(
                    "{flag} {name}: that may be {}: say which",
                    names.join(" or ")
                )))
            }
        }
    }

    /// A column of numbers, by its name with or without its unit.
    pub(super) fn number(&self, name: &str) -> Result<Column, Failure> {
        let places = self.trace + 1..self.names.len();
        let mut numbers = places.filter(|at| !WORDS.contains(&self.names[*at].as_str()));
        let is = |at: &usize| self.names[*at] == name || base(&self.names[*at]) == name;
        if let Some(at) = numbers.clone().find(is) {
            return Ok(self.column(at));
        }
        let known: Vec<&str> = numbers.by_ref().map(|at| base(&self.names[at])).collect();
        let guess = did_you_mean(name, known.iter().copied());
        let guess = guess.map_or(String::new(), |guess| format!(" did you mean `{guess}`?"));
        Err(Failure::input(format!(
            "--metric {name}: {} has no such number;{guess} it has {}",
            self.path.display(),
            known.join(", ")
        )))
    }

    /// Numbers if all runs have a number of one unit there, else words.
    pub(super) fn values(&self, column: &Column) -> Values {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut unit: Option<&str> = None;
        for row in self.good() {
            match quantity(&row[column.place]) {
                Some((number, own)) if unit.is_none_or(|unit| unit == own) => {
                    unit = Some(own);
                    (low, high) = (low.min(number), high.max(number));
                }
                _ => return Values::Words(self.distinct(column)),
            }
        }
        Values::Numbers {
            low,
            high,
            unit: unit.unwrap_or_default().to_owned(),
        }
    }

    /// The values of a column, each once: numbers by their size, words in the order of the table.
    pub(super) fn distinct(&self, column: &Column) -> Vec<String> {
        let mut values: Vec<String> = Vec::new();
        for row in self.good() {
            let value = &row[column.place];
            if !values.contains(value) {
                values.push(value.clone());
            }
        }
        let parts: Option<Vec<(f64, &str)>> = values.iter().map(|text| quantity(text)).collect();
        // Of several units the bare numbers say nothing of an order.
        if parts.is_some_and(|parts| parts.windows(2).all(|two| two[0].1 == two[1].1)) {
            let number = |text: &String| quantity(text).map_or(f64::NAN, |(number, _)| number);
            values.sort_by(|a, b| number(a).total_cmp(&number(b)));
        }
        values
    }

    /// What else sets runs apart that stand at one place of a picture.
    pub(super) fn pooled(&self, x: &Column, by: Option<&Column>) -> Vec<&str> {
        let drawn = |place: &usize| *place == x.place || by.is_some_and(|by| by.place == *place);
        let others = (1..self.trace).filter(|place| !drawn(place));
        let vary = others.filter(|place| self.distinct(&self.column(*place)).len() > 1);
        vary.map(|place| self.names[place].as_str()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "run,seed,model.bee.count,model.bee.params.range,world,trace_hash,ended,error,virtual_s,spread [m]\n\
                         1,1,9,10 m,a.toml,0f,end time,,2,1.5\n\
                         2,1,10,20 m,b.toml,0e,end time,,2,2.5\n\
                         3,2,9,5 km,a.toml,0d,failed,too far,1,\n";

    fn runs(text: &str) -> Result<Runs, String> {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("runs.csv");
        std::fs::write(&path, text).expect("written");
        Runs::open(&path).map_err(|failure| failure.message)
    }

    #[test]
    fn columns_are_found_by_the_ends_of_their_names() {
        let runs = runs(TABLE).unwrap_or_else(|e| panic!("{e}"));
        let name = |found: Result<Column, Failure>| found.map(|c| c.name).map_err(|f| f.message);
        assert_eq!(
            name(runs.key("--x", "count")).as_deref(),
            Ok("model.bee.count")
        );
        assert_eq!(name(runs.key("--x", "seed")).as_deref(), Ok("seed"));
        assert_eq!(name(runs.number("spread")).as_deref(), Ok("spread [m]"));
        assert_eq!(
            runs.number("spread")
                .map(|c| c.unit().to_owned())
                .ok()
                .as_deref(),
            Some("m")
        );
        let said = name(runs.key("--x", "cuont")).expect_err("a slip");
        assert!(
            said.contains("did you mean `model.bee.count`?") || said.contains("it has seed"),
            "{said}"
        );
        let said = name(runs.number("sprad")).expect_err("a slip");
        assert!(said.contains("did you mean `spread`?"), "{said}");
    }

    #[test]
    fn numbers_of_one_unit_are_numbers_and_all_else_is_words() {
        let runs = runs(TABLE).unwrap_or_else(|e| panic!("{e}"));
        let values = |key| {
            runs.values(
                &runs
                    .key("--x", key)
                    .unwrap_or_else(|f| panic!("{}", f.message)),
            )
        };
        let range = values("range");
        let unit = "m".to_owned();
        assert_eq!(
            range,
            Values::Numbers {
                low: 10.0,
                high: 20.0,
                unit
            }
        );
        assert_eq!(range.place("20 m"), Some(20.0));
        assert_eq!(values("world").place("b.toml"), Some(1.0));
        assert_eq!((runs.good().count(), runs.failed()), (2, 1));
        let count = runs
            .key("--x", "count")
            .unwrap_or_else(|f| panic!("{}", f.message));
        assert_eq!(runs.distinct(&count), ["9", "10"]);
        let units = "run,seed,range,trace_hash\n1,1,10 m,0\n2,1,1 km,0\n3,1,500 m,0\n";
        let runs = self::runs(units).unwrap_or_else(|e| panic!("{e}"));
        let range = runs
            .key("--x", "range")
            .unwrap_or_else(|f| panic!("{}", f.message));
        assert_eq!(
            runs.distinct(&range),
            ["10 m", "1 km", "500 m"],
            "as in the table"
        );
    }

    #[test]
    fn what_is_no_table_of_runs_is_refused() {
        for text in [
            "",
            "a,b\n1,2\n",
            "run,seed,trace_hash\n1,2\n",
            "run,seed,trace_hash\n",
            "run,seed,trace_hash\n\"1,2,3\n",
        ] {
            assert!(runs(text).is_err(), "{text}");
        }
    }
}
