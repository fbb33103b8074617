//! The table of an experiment: its rows are run round by round, checked, and printed.

use super::alone::Run;
use super::measure::Row;
use super::workload::Cost;
use super::{Failure, remark, say};
use serde::Serialize;

/// Runs `run(row)` for `rows` rows, `repeat` times in turn, and gives the runs of each row. After so many
/// whole rounds `again` says whether there is time for one more.
///
/// # Errors
/// A run that fails, or whose trace hash differs from that of the row's first run.
pub(super) fn rounds(
    rows: usize,
    repeat: u32,
    again: impl Fn(u32) -> bool,
    mut run: impl FnMut(usize) -> Result<Run, Failure>,
) -> Result<Vec<Vec<Run>>, Failure> {
    let mut all: Vec<Vec<Run>> = vec![Vec::new(); rows];
    for round in 0..repeat {
        if round > 0 && !again(round) {
            break;
        }
        for (row, runs) in all.iter_mut().enumerate() {
            let run = run(row)?;
            if let Some(first) = runs.first()
                && first.cost.trace_hash != run.cost.trace_hash
            {
                return Err(Failure::run(format!(
                    "two runs of one scenario differ: trace hashes {} and {}",
                    first.cost.trace_hash, run.cost.trace_hash
                )));
            }
            runs.push(run);
        }
    }
    Ok(all)
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
pub(super) fn method(rows: &[Row]) {
    let repeat = rows.iter().map(|row| row.runs.len()).min().unwrap_or(0);
    if repeat > 1 {
        remark(format!(
            "each figure is the least of {repeat} interleaved runs, which had equal trace hashes; each run \
             had a process of its own"
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::super::workload::tests::cost;
    use super::*;

    #[test]
    fn rows_are_run_in_turn_and_keep_all_their_runs() {
        let mut order = Vec::new();
        let runs = rounds(
            2,
            3,
            |_| true,
            |row| {
                order.push(row);
                Ok(Run::of(cost(5.0 + order.len() as f64, "same")))
            },
        );
        let Ok(runs) = runs else {
            panic!("all runs are alike")
        };
        assert_eq!(order, [0, 1, 0, 1, 0, 1]);
        let walls = |row: usize| -> Vec<f64> { runs[row].iter().map(|r| r.cost.wall_s).collect() };
        assert_eq!(
            (walls(0), walls(1)),
            (vec![6.0, 8.0, 10.0], vec![7.0, 9.0, 11.0])
        );
    }

    #[test]
    fn there_is_one_round_and_more_only_if_there_is_time() {
        for (time_for, rounds_run) in [(0, 1), (2, 2), (9, 4)] {
            let again = |done| done < time_for;
            let runs = rounds(1, 4, again, |_| Ok(Run::of(cost(1.0, "same"))));
            let runs = runs.map(|runs| runs[0].len());
            assert_eq!(runs.ok(), Some(rounds_run));
        }
    }

    #[test]
    fn runs_that_differ_are_an_error() {
        let mut hashes = ["a", "b", "a", "c"].into_iter();
        let run = |_| Ok(Run::of(cost(1.0, hashes.next().expect("a run"))));
        let failure = rounds(2, 2, |_| true, run).err();
        let failure = failure.expect("b is not c");
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
