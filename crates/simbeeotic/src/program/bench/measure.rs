//! An experiment is measured: its rows round by round, then the limit of each of its curves.

use super::alone::{self, Case, Order, Run};
use super::arguments::{Clock, Common};
use super::limit::{Limit, Search, count};
use super::workload::Cost;
use super::{Failure, process, remark, table};
use std::time::{Duration, Instant};

/// What can be measured: curves over a size.
pub(super) trait Experiment {
    fn common(&self) -> &Common;
    /// Virtual time of each run, s.
    fn duration_s(&self) -> f64;
    /// The sizes of the rows, from small to large.
    fn sizes(&self) -> &[u32];
    /// What sets the curves apart, in words.
    fn lines(&self) -> Vec<String>;
    /// The largest size that is tried when the limit is searched.
    fn ceiling(&self) -> u32;
    /// How many runs of a row are enough.
    fn repeats(&self) -> u32;
    /// Makes a run in this process before the measured one, which then finds code and caches warm.
    fn warm_up(&self) -> Result<(), Failure>;
    /// Makes a run in this process; it ends after so much wall time.
    fn run(&self, case: Case, wall: Option<Duration>) -> Result<Cost, Failure>;
}

/// A size on a curve, and its runs.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub(super) case: Case,
    pub(super) runs: Vec<Run>,
    /// The least of each figure.
    pub(super) least: Cost,
}

impl Row {
    pub(super) fn new(case: Case, runs: Vec<Run>) -> Option<Self> {
        let mut costs = runs.iter().map(|run| &run.cost);
        let mut least = costs.next()?.clone();
        costs.for_each(|cost| least.least(cost));
        Some(Self { case, runs, least })
    }

    /// Median of time by this clock over virtual time.
    pub(super) fn ratio(&self, clock: Clock) -> f64 {
        median(self.runs.iter().map(|run| run.ratio(clock)).collect())
    }
}

/// What came of an experiment.
pub(super) struct Measured {
    /// By size, then by curve.
    pub(super) rows: Vec<Row>,
    /// What was run to find the limits.
    pub(super) probes: Vec<Row>,
    /// One for each curve, if they were searched.
    pub(super) limits: Vec<Limit>,
}

/// The bracket of a limit is narrow enough at 5 %.
const TOLERANCE: f64 = 0.05;

/// A probe that takes so many times its virtual time of wall time need not go on: it has failed, or, by the
/// processor's clock, has shown enough.
fn hopeless(clock: Clock) -> f64 {
    match clock {
        Clock::Wall => 1.25,
        Clock::Processor => 4.0,
    }
}

/// A single run decides if it is so many times faster or slower than real time.
const CLEAR: f64 = 4.0;

/// Measures; or, if this is a process for one run, makes that: then there is nothing more to do.
pub(super) fn measure(experiment: &impl Experiment) -> Result<Option<Measured>, Failure> {
    let common = experiment.common();
    if let Some(order) = &common.alone {
        let order = Order::parse(order)?;
        if order.case.line >= experiment.lines().len() {
            return Err(Failure::input(format!(
                "--alone: there are {} lines",
                experiment.lines().len()
            )));
        }
        alone::tell(
            || experiment.warm_up(),
            || experiment.run(order.case, order.wall),
        )?;
        return Ok(None);
    }
    if let Some(folder) = common.output.as_ref().filter(|_| !common.no_files) {
        // Found before minutes are spent.
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::run(format!("cannot make {}: {e}", folder.display())))?;
    }
    let budget = Budget::start(common.within_s()?);
    let rows = rows(experiment, &budget)?;
    let (mut probes, mut limits) = (Vec::new(), Vec::new());
    let lines = experiment.lines().len();
    for line in (0..lines).filter(|_| !common.no_limit) {
        // What the first curves leave is for the others.
        let part = budget.left_s() / (lines - line) as f64;
        let limit = limit(experiment, line, &rows, &Budget::start(part), &mut probes)?;
        limits.push(limit);
    }
    Ok(Some(Measured {
        rows,
        probes,
        limits,
    }))
}

fn rows(experiment: &impl Experiment, budget: &Budget) -> Result<Vec<Row>, Failure> {
    let mut cases = Vec::new();
    for &size in experiment.sizes() {
        cases.extend((0..experiment.lines().len()).map(|line| Case { line, size }));
    }
    let common = experiment.common();
    let repeat = common.repeat.unwrap_or_else(|| experiment.repeats());
    // Half of the time is the limit's; what is asked for is done whatever it takes.
    let share = if common.no_limit { 1.0 } else { 0.5 };
    let again = |done: u32| {
        let next_s = budget.spent_s() / f64::from(done);
        common.repeat.is_some() || budget.spent_s() + next_s <= share * budget.whole_s
    };
    let runs = table::rounds(cases.len(), repeat, again, |case| {
        alone::run(cases[case], None)
    })?;
    let rows = cases.into_iter().zip(runs);
    Ok(rows
        .filter_map(|(case, runs)| Row::new(case, runs))
        .collect())
}

fn limit(
    experiment: &impl Experiment,
    line: usize,
    rows: &[Row],
    budget: &Budget,
    probes: &mut Vec<Row>,
) -> Result<Limit, Failure> {
    let common = experiment.common();
    let of_line = rows.iter().filter(|row| row.case.line == line);
    let known: Vec<_> = of_line
        .map(|row| (row.case.size, row.ratio(common.clock)))
        .collect();
    let room = room(rows, process::free_bytes());
    let search = Search {
        ceiling: experiment.ceiling().min(room),
        tolerance: TOLERANCE,
    };
    let longest_s = hopeless(common.clock) * experiment.duration_s();
    let repeat = common.repeat.unwrap_or_else(|| experiment.repeats());
    let largest = rows.iter().rfind(|row| row.case.line == line);
    let mut last = largest.map(|row| (row.case.size, whole_s(&row.runs)));
    let mut limit = search.run(&known, |size| {
        let mut runs: Vec<Run> = Vec::new();
        while (runs.len() as u32) < repeat && !decided(&runs, repeat, common.clock) {
            // One run is better than none, several are better than one: if there is time for them.
            let takes_s = match runs.last() {
                Some(run) => run.whole_s,
                None => last.map_or(0.0, |(n, s)| s * f64::from(size) / f64::from(n.max(1))),
            };
            if budget.left_s() < takes_s.min(longest_s) {
                break;
            }
            runs.push(alone::run(Case { line, size }, Some(longest_s))?);
        }
        last = (!runs.is_empty()).then(|| (size, whole_s(&runs))).or(last);
        let Some(row) = Row::new(Case { line, size }, runs) else {
            return Ok(None);
        };
        let ratio = row.ratio(common.clock);
        if !common.json {
            let name = &experiment.lines()[line];
            let count = count(size);
            let digits = if ratio < 0.1 { 4 } else { 2 };
            remark(format!(
                "limit, {name}: {count} take {ratio:.digits$} s a virtual second"
            ));
        }
        probes.push(row);
        Ok(Some(ratio))
    })?;
    if limit.settled && limit.high.is_none() {
        limit.text.push_str(match room < experiment.ceiling() {
            true => ", the most that the memory has room for",
            false => ", the most that is tried",
        });
    }
    Ok(limit)
}

/// The most that one of several runs took, all in all, s.
fn whole_s(runs: &[Run]) -> f64 {
    runs.iter().map(|run| run.whole_s).fold(0.0, f64::max)
}

/// The largest size for which half of the free memory is enough, by what the largest rows took.
fn room(rows: &[Row], free_bytes: Option<f64>) -> u32 {
    let each = |row: &Row| {
        let bytes = row.runs.iter().filter_map(|run| run.memory_bytes);
        let bytes = bytes.fold(0.0, f64::max);
        (row.case.size >= ROOM_LEAST).then(|| bytes / f64::from(row.case.size))
    };
    let each = rows.iter().filter_map(each).fold(0.0, f64::max);
    match free_bytes {
        Some(free) if each > 0.0 => (0.5 * free / each).min(f64::from(u32::MAX)) as u32,
        _ => u32::MAX,
    }
}

/// Smaller runs say more of the program than of what they hold.
const ROOM_LEAST: u32 = 10_000;

/// Whether the runs that are still to come cannot change on which side of 1 the median is.
fn decided(runs: &[Run], repeat: u32, clock: Clock) -> bool {
    // So far from real time no disturbance leads.
    let clear = |run: &Run| !(1.0 / CLEAR..=CLEAR).contains(&run.ratio(clock));
    let real_time = runs.iter().filter(|run| run.ratio(clock) <= 1.0).count();
    let most = repeat as usize / 2;
    runs.iter().any(clear) || real_time > most || runs.len() - real_time > most
}

/// The middle one; of an even number the larger of the two in the middle.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Wall time since it was started.
pub(super) struct Stopwatch(Instant);

impl Stopwatch {
    #[expect(
        clippy::disallowed_methods,
        reason = "measures the simulator, not the simulation"
    )]
    pub(super) fn start() -> Self {
        Self(Instant::now())
    }

    pub(super) fn elapsed_s(&self) -> f64 {
        self.0.elapsed().as_secs_f64()
    }
}

/// Wall time that may be spent.
struct Budget {
    start: Stopwatch,
    whole_s: f64,
}

impl Budget {
    fn start(whole_s: f64) -> Self {
        Self {
            start: Stopwatch::start(),
            whole_s,
        }
    }

    fn spent_s(&self) -> f64 {
        self.start.elapsed_s()
    }

    fn left_s(&self) -> f64 {
        self.whole_s - self.spent_s()
    }
}

#[cfg(test)]
mod tests {
    use super::super::workload::tests::cost;
    use super::*;

    #[test]
    fn a_row_keeps_all_its_runs_their_least_and_their_median() {
        let runs = [30.0, 5.0, 20.0].map(|wall_s| Run::of(cost(wall_s, "a")));
        let case = Case { line: 0, size: 9 };
        let row = Row::new(case, runs.to_vec()).expect("three runs");
        assert_eq!((row.runs.len(), row.least.wall_s), (3, 5.0));
        assert_eq!(row.ratio(Clock::Wall), 2.0);
        assert!(Row::new(case, Vec::new()).is_none());
    }

    #[test]
    fn there_is_room_for_what_half_of_the_free_memory_holds() {
        let row = |size, bytes| {
            let mut run = Run::of(cost(1.0, "a"));
            run.memory_bytes = Some(bytes);
            Row::new(Case { line: 0, size }, vec![run]).expect("a run")
        };
        let rows = [row(10, 1e9), row(20_000, 2e7), row(100_000, 9e7)];
        assert_eq!(room(&rows, Some(8e9)), 4_000_000);
        assert_eq!(room(&rows[..1], Some(8e9)), u32::MAX, "too small to tell");
        assert_eq!(room(&rows, None), u32::MAX);
    }

    #[test]
    fn a_probe_is_decided_by_most_of_its_runs() {
        let [fast, slow] = [5.0, 20.0].map(|wall_s| Run::of(cost(wall_s, "a")));
        let decided = |runs: &[Run], repeat| decided(runs, repeat, Clock::Wall);
        assert!(!decided(&[], 3) && !decided(std::slice::from_ref(&fast), 3));
        assert!(decided(&[fast.clone(), fast.clone()], 3));
        assert!(decided(&[slow.clone(), slow.clone()], 3));
        assert!(!decided(&[fast.clone(), slow.clone()], 3));
        assert!(decided(std::slice::from_ref(&slow), 1));
        // A run that is far from real time needs no others.
        let [hurried, stuck] = [1.0, 90.0].map(|wall_s| Run::of(cost(wall_s, "a")));
        assert!(decided(std::slice::from_ref(&hurried), 7));
        assert!(decided(std::slice::from_ref(&stuck), 7));
        // Of an even number the median is the larger one: slow if half of them are.
        assert!(!decided(&[fast.clone(), fast], 4));
        assert_eq!(median(vec![0.5, 2.0]), 2.0);
    }
}
