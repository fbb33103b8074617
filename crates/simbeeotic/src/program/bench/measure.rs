//! An experiment is measured: its rows round by round, then the limit of each of its curves.

use super::alone::{self, Case, Order, Run, Runner};
use super::arguments::{Clock, Common};
use super::limit::{Limit, Search, TIME_UP, count};
use super::unfinished::{Before, Unfinished};
use super::workload::{Cost, Most};
use super::{Failure, process, remark, table};
use simbeeotic_units::math;
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
/// By the processor's clock a probe ends by that, and by wall time only if that is many times as long.
const HOPELESS_WALL: f64 = 8.0;

/// Rows of which more than so many times real time is to be expected are left to the search of the limit.
const BEYOND: f64 = 1.25;

/// Without anything known of the disturbances, a single run decides if it is so many times faster or slower than
/// real time; if something is known, this or a lesser number.
const CLEAR: [f64; 2] = [1.1, 4.0];

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

/// Whether a size is far beyond real time, judged by the smaller ones that are known, each with its ratio: one of them
/// is beyond it, or the power law through the two largest gets there.
fn is_beyond(size: u32, known: &[(u32, f64)]) -> bool {
    let smaller = known
        .iter()
        .filter(|(n, ratio)| *n < size && *n > 0 && *ratio > 0.0);
    let smaller: Vec<_> = smaller.copied().collect();
    let ln = |(n, ratio): (u32, f64)| [math::ln(f64::from(n)), math::ln(ratio)];
    match smaller[..] {
        [.., (_, ratio)] if ratio > 1.0 => true,
        [.., a, b] => {
            let ([x0, y0], [x1, y1]) = (ln(a), ln(b));
            let slope = ((y1 - y0) / (x1 - x0)).clamp(0.0, 3.0);
            y1 + slope * (math::ln(f64::from(size)) - x1) > math::ln(BEYOND)
        }
        _ => false,
    }
}

/// How many times faster or slower than real time a single run must be to decide: more than the runs of the two
/// largest rows that were run several times differ.
fn clear(rows: &[Row], clock: Clock) -> f64 {
    let apart = |row: &Row| {
        let ratios = row.runs.iter().map(|run| run.ratio(clock));
        let [low, high] = ratios.fold([f64::INFINITY, 0.0_f64], |[low, high], ratio| {
            [low.min(ratio), high.max(ratio)]
        });
        (row.runs.len() > 1).then_some(high / low)
    };
    let apart = rows.iter().rev().filter_map(apart).take(2);
    let most = apart.reduce(f64::max).unwrap_or(CLEAR[1]);
    most.clamp(CLEAR[0], CLEAR[1])
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
/// One that is `clear` times faster or slower than real time is enough: so far no disturbance leads.
fn decided(runs: &[Run], repeat: u32, clear: f64, clock: Clock) -> bool {
    let is_clear = |run: &Run| !(1.0 / clear..=clear).contains(&run.ratio(clock));
    let real_time = runs.iter().filter(|run| run.ratio(clock) <= 1.0).count();
    let most = repeat as usize / 2;
    runs.iter().any(is_clear) || real_time > most || runs.len() - real_time > most
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
        let decided = |runs: &[Run], repeat| decided(runs, repeat, 4.0, Clock::Wall);
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
    #[test]
    fn what_is_far_beyond_real_time_is_left_to_the_search() {
        assert!(!is_beyond(1_000, &[]));
        assert!(!is_beyond(1_000, &[(10, 0.9)]));
        assert!(is_beyond(1_000, &[(10, 1.1)]));
        // Twice as many take four times as long: 0.9 at 2,000 is 1.4 at 2,500.
        let curve = [(0, 0.0), (1_000, 0.225), (2_000, 0.9)];
        assert!(!is_beyond(2_200, &curve) && is_beyond(2_500, &curve));
        assert!(!is_beyond(1_500, &curve));
    }

    #[test]
    fn one_run_decides_beyond_what_the_runs_of_a_row_differ() {
        let row = |size, walls: &[f64]| {
            let runs = walls.iter().map(|wall_s| Run::of(cost(*wall_s, "a")));
            Row::new(Case { line: 0, size }, runs.collect()).expect("runs")
        };
        let clear = |rows: &[Row]| clear(rows, Clock::Wall);
        assert_eq!(clear(&[row(9, &[5.0])]), 4.0);
        assert_eq!(clear(&[row(9, &[5.0, 5.1])]), 1.1);
        let rows = [
            row(1, &[1.0, 9.0]),
            row(2, &[4.0, 6.0]),
            row(3, &[8.0, 8.0]),
        ];
        assert_eq!(clear(&rows), 1.5);
        assert_eq!(clear(&rows[..2]), 4.0);
    }
}
