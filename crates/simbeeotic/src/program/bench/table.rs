//! The table of an experiment: its rows are run round by round, checked, and printed.

use super::workload::Cost;
use super::{Failure, remark, say};
use serde::Serialize;

/// Runs `run(row)` for `rows` rows, `repeat` times in turn, and gives the least cost of each row.
///
/// # Errors
/// A run that fails, or whose trace hash differs from that of the row's first run.
pub(super) fn rounds(
    rows: usize,
    repeat: u32,
    mut run: impl FnMut(usize) -> Result<Cost, Failure>,
) -> Result<Vec<Cost>, Failure> {
    let mut costs: Vec<Cost> = Vec::with_capacity(rows);
    for _ in 0..repeat {
        for row in 0..rows {
            let cost = run(row)?;
            match costs.get_mut(row) {
                None => costs.push(cost),
                Some(least) if least.trace_hash == cost.trace_hash => least.least(&cost),
                Some(first) => {
                    return Err(Failure::run(format!(
                        "two runs of one scenario differ: trace hashes {} and {}",
                        first.trace_hash, cost.trace_hash
                    )));
                }
            }
        }
    }
    Ok(costs)
}

/// The number of threads must not show in a run: rows of so many bees, in order, on so many threads.
///
/// # Errors
/// Two rows in a row of as many bees, with different trace hashes.
pub(super) fn agree<'a>(
    rows: impl Iterator<Item = (u32, usize, &'a Cost)> + Clone,
) -> Result<(), Failure> {
    let mut pairs = rows.clone().zip(rows.skip(1));
    match pairs.find(|(a, b)| a.0 == b.0 && a.2.trace_hash != b.2.trace_hash) {
        None => Ok(()),
        Some(((n, threads, cost), (_, others, other))) => Err(Failure::run(format!(
            "{n} bees differ: trace hash {} with {threads} threads, {} with {others}",
            cost.trace_hash, other.trace_hash
        ))),
    }
}

/// Says that these numbers of threads did not show in a run.
pub(super) fn same_for(threads: &[usize]) {
    let threads: Vec<String> = threads.iter().map(ToString::to_string).collect();
    remark(format!(
        "trace hashes are equal for {} threads",
        threads.join(", ")
    ));
}

/// Where the time goes: the columns that every experiment has.
pub(super) const SHARES: [&str; 6] = [
    "events s",
    "physics s",
    "radio s",
    "other s",
    "wall s",
    "speed",
];

/// The figures for [`SHARES`].
pub(super) fn shares(cost: &Cost) -> [String; 6] {
    let seconds = |s: f64| format!("{s:.3}");
    [
        seconds(cost.events_s),
        seconds(cost.physics_s),
        seconds(cost.radio_s),
        seconds(cost.other_s),
        seconds(cost.wall_s),
        format!("{:.1}x", cost.speed),
    ]
}

/// Prints one line of columns, all set to the right.
pub(super) fn line<'a>(columns: impl IntoIterator<Item = &'a str>) -> Result<(), Failure> {
    let mut line = String::new();
    for column in columns {
        line.push_str(&format!(" {column:>9}"));
    }
    say(&line[1..])
}

/// A figure that not every machine can tell.
pub(super) fn figure(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
}

/// Prints rows as JSON.
pub(super) fn json(rows: &[impl Serialize]) -> Result<(), Failure> {
    say(serde_json::to_string_pretty(rows).map_err(Failure::run)?)
}

/// Says how the figures were taken.
pub(super) fn method(repeat: u32) {
    if repeat > 1 {
        remark(format!(
            "each figure is the least of {repeat} interleaved runs, which had equal trace hashes"
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cost(wall_s: f64, trace_hash: &str) -> Cost {
        Cost {
            events_s: 0.0,
            physics_s: 0.0,
            radio_s: 0.0,
            other_s: 0.0,
            wall_s,
            speed: 1.0 / wall_s,
            cpu_s: None,
            busiest_thread_s: None,
            virtual_s: 1.0,
            events: 0,
            touches: 0,
            packets: [0; 2],
            trace_hash: trace_hash.to_owned(),
        }
    }

    #[test]
    fn rows_are_run_in_turn_and_keep_their_least() {
        let mut order = Vec::new();
        let costs = rounds(2, 3, |row| {
            order.push(row);
            Ok(cost(5.0 + row as f64 - order.len() as f64 / 8.0, "same"))
        });
        let Ok(costs) = costs else {
            panic!("all runs are alike")
        };
        assert_eq!(order, [0, 1, 0, 1, 0, 1]);
        assert_eq!([costs[0].wall_s, costs[1].wall_s], [4.375, 5.25]);
    }

    #[test]
    fn runs_that_differ_are_an_error() {
        let mut hashes = ["a", "b", "a", "c"].into_iter();
        let mut run = |_| Ok(cost(1.0, hashes.next().expect("a run")));
        let failure = rounds(2, 2, &mut run).err().expect("b is not c");
        assert!(failure.message.contains("b and c"), "{}", failure.message);
    }

    #[test]
    fn swarms_of_one_size_must_agree_whatever_the_threads() {
        let [a, b] = ["a", "b"].map(|hash| cost(1.0, hash));
        assert!(agree([(5, 1, &a), (5, 2, &a), (6, 1, &b)].into_iter()).is_ok());
        let failure = agree([(5, 1, &a), (5, 2, &b)].into_iter()).err();
        let message = failure.expect("a is not b").message;
        assert!(message.contains("a with 1 threads, b with 2"), "{message}");
    }
}
