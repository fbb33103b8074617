//! An experiment is measured: its rows round by round, then the limit of each of its curves.

use super::alone::{self, Case, Order, Run, Runner};
use super::arguments::{Clock, Common};
use super::judge::{clear, decided, is_beyond, median, room};
use super::limit::{Limit, Search, TIME_UP, count};
use super::unfinished::{Before, Unfinished};
use super::workload::{Cost, Most};
use super::{Failure, process, remark, table};
use std::time::Instant;

/// What can be measured: curves over a size.
pub(super) trait Experiment {
    /// `fig7`.
    fn name(&self) -> &'static str;
    fn common(&self) -> &Common;
    /// What its runs hang on besides their curve and their size: options and their values.
    fn setup(&self) -> Vec<(&'static str, String)>;
    /// Virtual time of each run, s.
    fn duration_s(&self) -> f64;
    /// The sizes of the rows, from small to large.
    fn sizes(&self) -> &[u32];
    /// Whether the sizes are the experiment's own: then those far beyond real time are left out.
    fn is_ladder(&self) -> bool;
    /// What sets the curves apart, in words.
    fn lines(&self) -> Vec<String>;
    /// The largest size that is tried when the limit is searched.
    fn ceiling(&self) -> u32;
    /// How many runs of a row are enough.
    fn repeats(&self) -> u32;
    /// Makes a run in this process before the measured one, which then finds code and caches warm.
    fn warm_up(&self) -> Result<(), Failure>;
    /// Makes a run in this process; it ends when it has taken the most that it may.
    fn run(&self, case: Case, most: Most) -> Result<Cost, Failure>;
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
    /// Why it is not whole, if it is not.
    pub(super) broken: Option<Failure>,
    pub(super) unfinished: Unfinished,
}

/// What is done with the rows and the probes that there are so far.
pub(super) type SoFar<'a> = &'a dyn Fn(&[Row], &[Row]);

/// The bracket of a limit is narrow enough at 5 %.
const TOLERANCE: f64 = 0.05;

/// A probe that takes so many times its virtual time need not go on: it has failed.
const HOPELESS: f64 = 1.25;
/// By the processor's clock a probe ends by that, and by wall time only if that is so many times as long that it
/// stands still: how long others keep the processor says nothing of it.
const HOPELESS_WALL: f64 = 64.0;

/// Wall time from one writing of the table to the next, s.
const WRITTEN_S: f64 = 2.0;

/// Measures; or, if this is a process for one run, makes that: then there is nothing more to do.
pub(super) fn measure(
    experiment: &impl Experiment,
    so_far: SoFar<'_>,
) -> Result<Option<Measured>, Failure> {
    let common = experiment.common();
    if let Some(order) = &common.alone {
        let order = Order::parse(order)?;
        if order.case.line >= experiment.lines().len() {
            return Err(Failure::input(format!(
                "--alone: there are {} lines",
                experiment.lines().len()
            )));
        }
        let most = match (order.wall, common.clock) {
            (None, _) => Most::default(),
            (wall, Clock::Wall) => Most {
                wall,
                busiest_s: None,
            },
            (wall, Clock::Processor) => Most {
                wall,
                busiest_s: Some(HOPELESS * experiment.duration_s()),
            },
        };
        alone::tell(|| experiment.warm_up(), || experiment.run(order.case, most))?;
        return Ok(None);
    }
    if !common.no_files {
        // Found before minutes are spent.
        let folder = common.folder(experiment.name());
        if folder.exists() && !folder.is_dir() {
            return Err(Failure::input(format!(
                "--output {}: this is a file, and a folder is wanted",
                folder.display()
            )));
        }
        std::fs::create_dir_all(&folder)
            .map_err(|e| Failure::run(format!("cannot make {}: {e}", folder.display())))?;
    }
    let (unfinished, before) = Unfinished::open(experiment)?;
    let bench = Bench {
        experiment,
        runner: Runner::start(),
        budget: Budget::start(common.within_s()?),
        unfinished,
        so_far,
        written: None,
    };
    bench.all(before).map(Some)
}

/// An experiment that is being measured.
struct Bench<'a, E> {
    experiment: &'a E,
    runner: Runner,
    budget: Budget,
    unfinished: Unfinished,
    so_far: SoFar<'a>,
    written: Option<Stopwatch>,
}

impl<E: Experiment> Bench<'_, E> {
    fn all(mut self, before: Before) -> Result<Measured, Failure> {
        let common = self.experiment.common();
        let (rows, mut broken) = self.rows(&before.rows);
        if rows.is_empty()
            && let Some(failure) = broken
        {
            // What an earlier bench wrote is worth more than a line of names.
            if failure.is_interrupt() {
                remark("interrupted: no run is done, and nothing is written");
            }
            return Err(failure);
        }
        let mut probes = gathered(&before.probes);
        let mut limits = Vec::new();
        let lines = self.experiment.lines().len();
        for line in (0..lines).filter(|_| !common.no_limit) {
            // What the first curves leave is for the others.
            let part = Budget::start(self.budget.left_s() / (lines - line) as f64);
            let (limit, failure) = self.limit(line, &rows, &part, &mut probes, broken.is_some())?;
            limits.push(limit);
            broken = broken.or(failure);
        }
        Ok(Measured {
            rows,
            probes,
            limits,
            broken,
            unfinished: self.unfinished,
        })
    }

    /// Keeps a run, and now and then writes the table of what there is.
    fn keep(&mut self, case: Case, run: &Run, rows: &[Row], probes: &[Row], probe: bool) {
        self.unfinished.add(case.line, case.size, probe, run);
        let is_time = |watch: &Stopwatch| watch.elapsed_s() > WRITTEN_S;
        if self.written.as_ref().is_none_or(is_time) {
            (self.so_far)(rows, probes);
            self.written = Some(Stopwatch::start());
        }
    }

    /// The rows of the table, and why that are not all.
    fn rows(&mut self, before: &[(usize, u32, Run)]) -> (Vec<Row>, Option<Failure>) {
        let (experiment, common) = (self.experiment, self.experiment.common());
        // What was measured once stays in the table, whatever sizes are asked for now.
        let mut sizes = experiment.sizes().to_vec();
        sizes.extend(before.iter().map(|(_, size, _)| *size));
        sizes.sort_unstable();
        sizes.dedup();
        let mut cases = Vec::new();
        for size in sizes {
            cases.extend((0..experiment.lines().len()).map(|line| Case { line, size }));
        }
        let there = |case: &Case| -> Vec<Run> {
            let own = before
                .iter()
                .filter(|(line, size, _)| (*line, *size) == (case.line, case.size));
            own.map(|(.., run)| run.clone()).collect()
        };
        let runs: Vec<Vec<Run>> = cases.iter().map(there).collect();
        let repeat = common.repeat.unwrap_or_else(|| experiment.repeats());
        // Half of the time is the limit's; what is asked for is done whatever it takes.
        let share = if common.no_limit { 1.0 } else { 0.5 };
        let (spent, whole_s) = (Stopwatch::start(), self.budget.whole_s);
        let again = |all: &[Vec<Run>]| {
            let next_s: f64 = all
                .iter()
                .filter_map(|runs| Some(runs.last()?.whole_s))
                .sum();
            common.repeat.is_some() || spent.elapsed_s() + next_s <= share * whole_s
        };
        let (runs, failure) = table::rounds(runs, repeat, again, |at, all| {
            let case = cases[at];
            let known = || -> Vec<(u32, f64)> {
                let own = cases.iter().zip(all).filter(|(c, _)| c.line == case.line);
                own.filter_map(|(c, runs)| Some((c.size, runs.first()?.ratio(common.clock))))
                    .collect()
            };
            if experiment.is_ladder() && is_beyond(case.size, &known()) {
                return Ok(None);
            }
            let run = self.runner.run(case, None)?;
            if all[at].is_empty() && run.whole_s > WRITTEN_S && !common.json {
                let name = &experiment.lines()[case.line];
                remark(told("row", name, case.size, run.ratio(common.clock)));
            }
            let rows: Vec<Row> = cases
                .iter()
                .zip(all)
                .enumerate()
                .filter_map(|(other, (case, runs))| {
                    let mut runs = runs.clone();
                    runs.extend((other == at).then(|| run.clone()));
                    Row::new(*case, runs)
                })
                .collect();
            self.keep(case, &run, &rows, &[], false);
            Ok(Some(run))
        });
        let rows = cases.into_iter().zip(runs);
        let rows = rows.filter_map(|(case, runs)| Row::new(case, runs));
        (rows.collect(), failure)
    }

    /// The limit of a curve, and why it was not searched to the end, if that was not for lack of time. `over`: it
    /// is only told from what is known.
    fn limit(
        &mut self,
        line: usize,
        rows: &[Row],
        budget: &Budget,
        probes: &mut Vec<Row>,
        over: bool,
    ) -> Result<(Limit, Option<Failure>), Failure> {
        let (experiment, common) = (self.experiment, self.experiment.common());
        let clock = common.clock;
        let repeat = common.repeat.unwrap_or_else(|| experiment.repeats());
        let of_line = |rows: &[Row]| -> Vec<Row> {
            let own = rows.iter().filter(|row| row.case.line == line);
            own.cloned().collect()
        };
        let own = of_line(rows);
        let clear = clear(&own, clock);
        let is_decided = |runs: &[Run]| decided(runs, repeat, clear, clock);
        let mut known: Vec<_> = own
            .iter()
            .map(|row| (row.case.size, row.ratio(clock)))
            .collect();
        // Those of an earlier call that are not decided are gone on with.
        let (whole, mut parts): (Vec<Row>, Vec<Row>) = of_line(probes)
            .into_iter()
            .partition(|row| row.runs.len() as u32 >= repeat || is_decided(&row.runs));
        known.extend(whole.iter().map(|row| (row.case.size, row.ratio(clock))));
        let room = room(rows, process::free_bytes());
        let search = Search {
            ceiling: experiment.ceiling().min(room),
            tolerance: TOLERANCE,
        };
        let longest_s = HOPELESS * experiment.duration_s();
        let wall_s = match clock {
            Clock::Wall => longest_s,
            Clock::Processor => HOPELESS_WALL * experiment.duration_s(),
        };
        let mut last = own.last().map(|row| (row.case.size, whole_s(&row.runs)));
        let mut broken = None;
        let mut limit = search.run::<Failure>(&known, |size| {
            let begun = parts.iter().position(|row| row.case.size == size);
            let mut runs = begun.map_or_else(Vec::new, |at| parts.swap_remove(at).runs);
            let case = Case { line, size };
            probes.retain(|row| row.case != case);
            while (runs.len() as u32) < repeat && !is_decided(&runs) {
                // One run is better than none, several are better than one: if there is time for them.
                let takes_s = match runs.last() {
                    Some(run) => run.whole_s,
                    None => last.map_or(0.0, |(n, s)| s * f64::from(size) / f64::from(n.max(1))),
                };
                if over || broken.is_some() || budget.left_s() < takes_s.min(longest_s) {
                    break;
                }
                match self.runner.run(case, Some(wall_s)) {
                    Ok(run) => {
                        runs.push(run.clone());
                        let mut all = probes.clone();
                        all.extend(Row::new(case, runs.clone()));
                        self.keep(case, &run, rows, &all, true);
                    }
                    Err(failure) => broken = Some(failure),
                }
            }
            last = (!runs.is_empty()).then(|| (size, whole_s(&runs))).or(last);
            let Some(row) = Row::new(case, runs) else {
                return Ok(None);
            };
            let ratio = row.ratio(clock);
            if !common.json {
                remark(told("limit", &experiment.lines()[line], size, ratio));
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
        if !limit.settled && (over || broken.is_some()) {
            limit.text = limit.text.replace(TIME_UP, ", when it was broken off");
        }
        Ok((limit, broken))
    }
}

/// What a size takes, in a line.
fn told(what: &str, line: &str, size: u32, ratio: f64) -> String {
    let digits = if ratio < 0.1 { 4 } else { 2 };
    let count = count(size);
    format!("{what}, {line}: {count} take {ratio:.digits$} s a virtual second")
}

/// Wall time of a row's size on the first curve over that on its own.
pub(super) fn gain(rows: &[Row], of: &Row) -> f64 {
    let mut rows = rows.iter();
    let first = rows.find(|row| row.case.size == of.case.size);
    first.map_or(1.0, |first| first.least.wall_s / of.least.wall_s)
}

/// Runs by their cases, as rows.
fn gathered(runs: &[(usize, u32, Run)]) -> Vec<Row> {
    let mut rows: Vec<(Case, Vec<Run>)> = Vec::new();
    for (line, size, run) in runs {
        let case = Case {
            line: *line,
            size: *size,
        };
        match rows.iter_mut().find(|(known, _)| *known == case) {
            Some((_, runs)) => runs.push(run.clone()),
            None => rows.push((case, vec![run.clone()])),
        }
    }
    let rows = rows.into_iter();
    rows.filter_map(|(case, runs)| Row::new(case, runs))
        .collect()
}

/// The most that one of several runs took, all in all, s.
fn whole_s(runs: &[Run]) -> f64 {
    runs.iter().map(|run| run.whole_s).fold(0.0, f64::max)
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

    fn left_s(&self) -> f64 {
        self.whole_s - self.start.elapsed_s()
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
}
