//! The table of an experiment: its rows are run round by round, checked, and printed.

use super::alone::Run;
use super::measure::Row;
use super::workload::Cost;
use super::{Failure, remark, say};
use serde::Serialize;

/// Goes on with the runs of each row until there are `repeat` of them, one of each row in turn. Between rounds
/// `again` says whether there is time for the next; `run` makes a run of a row, or none if the row is left out. Gives
/// the runs of each row, and why that are not all.
///
/// # Errors
/// Beside what was run: a run that fails, or whose trace hash differs from that of the row's first run.
pub(super) fn rounds(
    mut all: Vec<Vec<Run>>,
    repeat: u32,
    again: impl Fn(&[Vec<Run>]) -> bool,
    mut run: impl FnMut(usize, &[Vec<Run>]) -> Result<Option<Run>, Failure>,
) -> (Vec<Vec<Run>>, Option<Failure>) {
    // Those that were made before, too: runs that differ are no less so when a bench goes on with them.
    if let Some(failure) = all.iter().find_map(|runs| alike(runs).err()) {
        return (all, Some(failure));
    }
    for round in 0..repeat as usize {
        if round > 0 && all.iter().any(|runs| runs.len() == round) && !again(&all) {
            break;
        }
        for row in 0..all.len() {
            // One that was left out in the first round stays out.
            if all[row].len() > round || (round > 0 && all[row].is_empty()) {
                continue;
            }
            match run(row, &all) {
                Ok(None) => {}
                Ok(Some(run)) => {
                    all[row].push(run);
                    if let Err(failure) = alike(&all[row]) {
                        return (all, Some(failure));
                    }
                }
                Err(failure) => return (all, Some(failure)),
            }
        }
    }
    (all, None)
}

/// Runs of a row differ in nothing.
fn alike(runs: &[Run]) -> Result<(), Failure> {
    let hash = |run: &Run| run.cost.trace_hash.clone();
    let mut hashes = runs.iter().map(hash);
    let Some(first) = hashes.next() else {
        return Ok(());
    };
    match hashes.find(|other| *other != first) {
        None => Ok(()),
        Some(other) => Err(Failure::run(format!(
            "two runs of one scenario differ: trace hashes {first} and {other}"
        ))),
    }
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
pub(super) const SHARES: [&str; 7] = [
    "start s",
    "events s",
    "physics s",
    "radio s",
    "other s",
    "wall s",
    "speed",
];

/// The figures for [`SHARES`].
pub(super) fn shares(cost: &Cost) -> [String; 7] {
    let seconds = |s: f64| format!("{s:.3}");
    [
        seconds(cost.start_s),
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

    fn same(wall_s: f64) -> Run {
        Run::of(cost(wall_s, "same"))
    }

    #[test]
    fn rows_are_run_in_turn_and_keep_all_their_runs() {
        let mut order = Vec::new();
        let (runs, failure) = rounds(
            vec![Vec::new(); 2],
            3,
            |_| true,
            |row, _| {
                order.push(row);
                Ok(Some(same(5.0 + order.len() as f64)))
            },
        );
        assert!(failure.is_none());
        assert_eq!(order, [0, 1, 0, 1, 0, 1]);
        let walls = |row: usize| -> Vec<f64> { runs[row].iter().map(|r| r.cost.wall_s).collect() };
        assert_eq!(
            (walls(0), walls(1)),
            (vec![6.0, 8.0, 10.0], vec![7.0, 9.0, 11.0])
        );
    }

    #[test]
    fn what_is_there_is_not_run_again_and_what_is_left_out_stays_out() {
        let mut order = Vec::new();
        let there = vec![vec![same(1.0), same(1.0)], vec![same(1.0)], Vec::new()];
        let (runs, failure) = rounds(
            there,
            3,
            |_| true,
            |row, _| {
                order.push(row);
                Ok((row != 2).then(|| same(2.0)))
            },
        );
        assert!(failure.is_none());
        assert_eq!(order, [2, 1, 0, 1]);
        assert_eq!(runs.iter().map(Vec::len).collect::<Vec<_>>(), [3, 3, 0]);
    }

    #[test]
    fn there_is_one_round_and_more_only_if_there_is_time() {
        for (time_for, rounds_run) in [(0, 1), (2, 2), (9, 4)] {
            let again = |runs: &[Vec<Run>]| runs[0].len() < time_for;
            let (runs, _) = rounds(vec![Vec::new()], 4, again, |_, _| Ok(Some(same(1.0))));
            assert_eq!(runs[0].len(), rounds_run);
        }
    }

    #[test]
    fn runs_that_differ_are_an_error_and_kept() {
        let mut hashes = ["a", "b", "a", "c"].into_iter();
        let run = |_, _: &[Vec<Run>]| Ok(Some(Run::of(cost(1.0, hashes.next().expect("a run")))));
        let (runs, failure) = rounds(vec![Vec::new(); 2], 2, |_| true, run);
        let failure = failure.expect("b is not c");
        assert!(failure.message.contains("b and c"), "{}", failure.message);
        assert_eq!((runs[0].len(), runs[1].len()), (2, 2));
        // They are so, too, when they are taken up again and nothing is left to run.
        let (runs, failure) = rounds(runs, 2, |_| true, |_, _| unreachable!("all runs are there"));
        assert!(failure.expect("still").message.contains("b and c"));
        assert_eq!(runs.len(), 2);
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
