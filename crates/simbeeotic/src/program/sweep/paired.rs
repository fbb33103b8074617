//! Differences to a baseline, pair by pair: runs of one seed have their chance in common, and what they have in
//! common drops out.

use super::report::{aligned, estimate};
use super::rows::{Row, Rows};
use crate::program::Failure;
use crate::program::plot::{BandKind, band};
use simbeeotic_scenario::Sweep;
use std::collections::{BTreeMap, BTreeSet};

/// Most lines that are printed.
const LINES_MAX: usize = 60;
/// Stands behind a difference whose interval does not hold zero.
const CLEAR: &str = " *";

/// The value of a key that all others are compared with.
#[derive(Debug, PartialEq)]
pub(super) struct Baseline {
    /// The place of the key among those that vary.
    key: usize,
    name: String,
    value: String,
}

impl Baseline {
    /// From `KEY=VALUE`, the key by its name or by the end of it.
    ///
    /// # Errors
    /// The key does not vary, or does not take the value; there is nothing to compare with.
    pub(super) fn read(sweep: &Sweep, text: &str) -> Result<Self, Failure> {
        let failed = |what: String| Failure::input(format!("--baseline {text}: {what}"));
        let Some((name, value)) = text.rsplit_once('=') else {
            return Err(failed(
                "there is no `=` between a key and its value".to_owned(),
            ));
        };
        let (name, value) = (name.trim(), value.trim());
        let keys: Vec<&str> = sweep.keys().collect();
        let is = |key: &&str| {
            let front = key.strip_suffix(name);
            front.is_some_and(|front| front.is_empty() || front.ends_with('.'))
        };
        let exact = keys.iter().position(|key| *key == name);
        let ends: Vec<usize> = (0..keys.len()).filter(|at| is(&keys[*at])).collect();
        let key = match (exact, ends.as_slice()) {
            (Some(at), _) => at,
            (None, [at]) => *at,
            (None, []) => {
                return Err(failed(format!(
                    "`{name}` does not vary; what does: {}",
                    keys.join(", ")
                )));
            }
            (None, several) => {
                let names: Vec<&str> = several.iter().map(|at| keys[*at]).collect();
                return Err(failed(format!(
                    "that may be {}: say which",
                    names.join(" or ")
                )));
            }
        };
        let name = keys[key].to_owned();
        let all =
            (0..sweep.combinations()).filter_map(|run| sweep.values(run).into_iter().nth(key));
        let all: BTreeSet<String> = all.collect();
        if !all.contains(value) {
            let all: Vec<&str> = all.iter().map(String::as_str).take(20).collect();
            return Err(failed(format!(
                "`{name}` is never that, but {}",
                all.join(", ")
            )));
        }
        if all.len() < 2 {
            return Err(failed(format!(
                "`{name}` has no other value to be compared"
            )));
        }
        Ok(Self {
            key,
            name,
            value: value.to_owned(),
        })
    }
}

/// Mean and 95 % interval of the differences of each number to the runs of the baseline that have the same seed and
/// otherwise the same values.
pub(super) fn differences(rows: &Rows, names: &[String], baseline: &Baseline) -> String {
    let is_base = |values: &[String]| values[baseline.key] == baseline.value;
    let others = |values: &[String], row: &Row| {
        let mut values = values.to_vec();
        values[baseline.key].clear();
        (values, row.seed)
    };
    let bases = rows.good().filter(|(values, _)| is_base(values));
    let bases: BTreeMap<(Vec<String>, i64), &Row> = bases
        .map(|(values, row)| (others(values, row), row))
        .collect();
    let mut groups: Vec<(&[String], Vec<Vec<f64>>)> = Vec::new();
    for (values, row) in rows.good().filter(|(values, _)| !is_base(values)) {
        let Some(base) = bases.get(&others(values, row)) else {
            continue;
        };
        let known = groups
            .iter()
            .position(|(other, _)| *other == values.as_slice());
        let at = known.unwrap_or_else(|| {
            groups.push((values, vec![Vec::new(); names.len()]));
            groups.len() - 1
        });
        for (name, all) in names.iter().zip(&mut groups[at].1) {
            if let (Some(own), Some(base)) = (row.number(name), base.number(name)) {
                all.extend(Some(own - base).filter(|difference| difference.is_finite()));
            }
        }
    }
    let keys = rows.keys().iter().cloned();
    let head = keys
        .chain(["pairs".to_owned()])
        .chain(names.iter().cloned());
    let mut lines = vec![head.collect::<Vec<_>>()];
    for (values, all) in groups.iter_mut().take(LINES_MAX) {
        let pairs = all.iter().map(Vec::len).max().unwrap_or(0);
        let mut line = values.to_vec();
        line.push(pairs.to_string());
        for differences in all {
            let mut cell = estimate(differences);
            let band = band::band(differences, BandKind::Confidence);
            if band.is_some_and(|[low, high]| low > 0.0 || high < 0.0) {
                cell.push_str(CLEAR);
            }
            if (1..pairs).contains(&differences.len()) {
                cell.push_str(&format!(" ({})", differences.len()));
            }
            line.push(cell);
        }
        lines.push(line);
    }
    let mut text = format!(
        "differences to {} = {}, run by run of equal seeds:\n{}",
        baseline.name,
        baseline.value,
        aligned(&lines)
    );
    if groups.len() > LINES_MAX {
        text.push_str(&format!(
            "... and {} combinations more\n",
            groups.len() - LINES_MAX
        ));
    }
    if lines.iter().flatten().any(|cell| cell.contains(CLEAR)) {
        text.push_str("*: zero is outside of the 95 % interval\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_scenario::{Loaded, load_text};

    fn scenario() -> Loaded {
        let text = "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\nname = \"bee\"\n[sweep]\nseeds = 3\n\
                    [sweep.vary]\nmodel.bee.count = [1, 2]\n\"run.end_time\" = [\"1 s\", \"2 s\"]\n";
        let loaded = load_text("x", text, &Default::default());
        loaded.unwrap_or_else(|rejected| panic!("{:?}", rejected.faults))
    }

    #[test]
    fn what_runs_of_one_seed_have_in_common_drops_out() {
        let loaded = scenario();
        let sweep = loaded.sweep().expect("it varies");
        let Ok(baseline) = Baseline::read(sweep, "count=1") else {
            panic!("it varies");
        };
        // Seeds differ much; two bees have 1, 2, 3 more than one bee; at 2 s there is nothing between them.
        let row = |run: usize| {
            let seed = run / 4;
            let far = match run % 4 {
                2 => 1.0 + seed as f64,
                _ => 0.0,
            };
            let numbers = vec![("far [m]".to_owned(), 100.0 * (seed * seed) as f64 + far)];
            Row::again(run, seed as i64 + 1, "0f", "end time", numbers)
        };
        let rows = Rows::of(sweep, (0..12).map(row).collect());
        let text = differences(&rows, &["far [m]".to_owned()], &baseline);
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let lines: Vec<String> = text.lines().map(words).collect();
        assert_eq!(
            lines[0],
            "differences to model.bee.count = 1, run by run of equal seeds:"
        );
        // s = 1, t(2) = 4.303, over the root of three: 2.484, so zero is inside.
        assert_eq!(lines[2], "2 1 s 3 2 ± 2.48", "{text}");
        assert_eq!(lines[3], "2 2 s 3 0 ± 0", "{text}");
        // The same, twice as far apart from zero.
        let shifted = |run: usize| {
            let row = row(run);
            let extra = if run % 4 == 2 { 2.0 } else { 0.0 };
            let numbers = row.numbers().map(|(name, x)| (name.to_owned(), x + extra));
            Row::again(run, row.seed, "0f", "end time", numbers.collect())
        };
        let rows = Rows::of(sweep, (0..12).map(shifted).collect());
        let text = differences(&rows, &["far [m]".to_owned()], &baseline);
        assert!(text.contains("4 ± 2.48 *"), "{text}");
    }

    #[test]
    fn a_baseline_that_is_none_is_refused() {
        let loaded = scenario();
        let sweep = loaded.sweep().expect("it varies");
        for (text, word) in [
            ("count", "there is no `=`"),
            ("cuont=1", "what does: model.bee.count, run.end_time"),
            ("count=3", "`model.bee.count` is never that, but 1, 2"),
        ] {
            let Err(failure) = Baseline::read(sweep, text) else {
                panic!("{text} is no baseline");
            };
            assert!(failure.message.contains(word), "{}", failure.message);
        }
        assert!(Baseline::read(sweep, "run.end_time=2 s").is_ok());
    }
}
