//! The runs themselves, several at a time.

use super::bar::{Bar, Counts};
use super::rows::Row;
use super::unfinished::Unfinished;
use super::{SweepOptions, report, said};
use crate::program::outputs::RECORDER;
use crate::program::run::{INTERRUPTED, at_interrupt, recorder};
use crate::program::view::VIEWER;
use crate::program::{Failure, complain, input, remark};
use simbeeotic_kernel::pace::Control;
use simbeeotic_kernel::{Progress, SimTime};
use simbeeotic_model::{Setup, Simulation};
use simbeeotic_scenario::{Loaded, Sweep};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Wall time that a run may take to tell how long the others will.
const SAMPLE: Duration = Duration::from_secs(1);

/// What became of all runs.
pub(super) struct Done {
    /// One a run that ended, by its own will or by failing, in the order of the runs.
    pub(super) rows: Vec<Row>,
    /// Whether the user ended the sweep.
    pub(super) interrupted: bool,
}

/// What the workers share.
struct Shared<'a> {
    sweep: &'a Sweep,
    jobs: usize,
    record: Option<PathBuf>,
    /// The numbers whose means are wanted.
    metrics: &'a [String],
    /// The runs that are to be flown, and the place of the next among them.
    runs: Vec<usize>,
    next: AtomicUsize,
    /// The runs that are going on; `None` once they shall stop.
    going: Arc<Mutex<Option<Vec<Going>>>>,
    rows: Mutex<(Vec<Row>, &'a mut Unfinished)>,
    done: Arc<AtomicUsize>,
    bar: Option<Bar>,
}

/// A run that is going on.
pub(super) struct Going {
    control: Arc<Control>,
    progress: Arc<Progress>,
    end: SimTime,
}

impl Going {
    /// How much of it is over.
    pub(super) fn share(&self) -> f64 {
        let (now, end) = (self.progress.now(), self.end);
        (now.as_secs_f64() / end.as_secs_f64()).clamp(0.0, 1.0)
    }
}

/// A lock that one who panicked held is as good as any: what is behind it is whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs all runs but those whose rows are `done`. One that fails is told, and the others go on.
pub(super) fn run(
    sweep: &Sweep,
    options: &SweepOptions,
    done: Vec<Row>,
    unfinished: &mut Unfinished,
) -> Result<Done, Failure> {
    let mut is_done = vec![false; sweep.len()];
    done.iter().for_each(|row| is_done[row.run] = true);
    let runs: Vec<usize> = (0..sweep.len()).filter(|run| !is_done[*run]).collect();
    let counter = Arc::new(AtomicUsize::new(done.len()));
    let going = Arc::new(Mutex::new(Some(Vec::new())));
    let counts = Counts {
        all: sweep.len(),
        before: done.len(),
        done: Arc::clone(&counter),
    };
    let bar = (!options.quiet).then(|| Bar::start(counts, Arc::clone(&going)));
    let shared = Shared {
        sweep,
        jobs: jobs(options, runs.len()),
        record: options.record.clone(),
        metrics: if options.quiet { &[] } else { &options.metric },
        runs,
        next: AtomicUsize::new(0),
        going: Arc::clone(&going),
        rows: Mutex::new((done, unfinished)),
        done: counter,
        bar,
    };
    let interrupted = at_interrupt(move || {
        for going in lock(&going).take().into_iter().flatten() {
            going.control.stop(INTERRUPTED);
        }
    });
    std::thread::scope(|scope| {
        for _ in 0..shared.jobs {
            scope.spawn(|| work(&shared));
        }
    });
    let rows = shared.rows.into_inner();
    let (mut rows, _) = rows.unwrap_or_else(PoisonError::into_inner);
    rows.sort_by_key(|row| row.run);
    Ok(Done {
        interrupted: interrupted.load(Ordering::Relaxed) && rows.len() < sweep.len(),
        rows,
    })
}

/// Runs at a time.
fn jobs(options: &SweepOptions, runs: usize) -> usize {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    options.jobs.unwrap_or(cores).min(runs)
}

/// Takes runs until there are no more.
fn work(shared: &Shared<'_>) {
    loop {
        let next = shared.next.fetch_add(1, Ordering::Relaxed);
        let Some(run) = shared.runs.get(next).copied() else {
            return;
        };
        if lock(&shared.going).is_none() {
            return;
        }
        let row = caught(|| one(shared, run)).unwrap_or_else(|panic| {
            // It fails its own run, and not the others.
            Err(Box::new(Row::failed(run, shared.sweep.seed(run), panic)))
        });
        let row = match row {
            Ok(Some(row)) => row,
            // Interrupted: it did not come to its end, and nor did its recording.
            Ok(None) => {
                if let Some(folder) = &shared.record {
                    let _ = std::fs::remove_file(super::recording(folder, run));
                }
                return;
            }
            Err(row) => {
                let text = format!(
                    "run {}{} failed: {}",
                    run + 1,
                    said(shared.sweep, run),
                    row.error.trim_end()
                );
                match &shared.bar {
                    Some(bar) => bar.aside(|| complain(&text)),
                    None => complain(&text),
                }
                *row
            }
        };
        let mut rows = lock(&shared.rows);
        let (rows, unfinished) = &mut *rows;
        if row.error.is_empty() && rows.is_empty() && shared.sweep.len() > 1 {
            for note in report::missing(&row, shared.metrics) {
                match &shared.bar {
                    Some(bar) => bar.aside(|| remark(&note)),
                    None => remark(&note),
                }
            }
        }
        // What failed is flown again.
        if row.error.is_empty() {
            unfinished.add(shared.sweep, &row);
        }
        rows.push(row);
        shared.done.store(rows.len(), Ordering::Relaxed);
    }
}

/// What an act comes to; if it panics, with what words. A run catches its own panics, but not those of a part that
/// is being built.
fn caught<T>(act: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(act)).map_err(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
        format!("panicked: {}", text.unwrap_or("without a word"))
    })
}

/// The set-up of a run that nobody watches.
fn unwatched(loaded: &Loaded) -> Result<Setup, Failure> {
    let mut setup = input::setup(loaded)?;
    setup
        .components
        .retain(|(name, _)| name != RECORDER && name != VIEWER);
    setup.pace = None;
    Ok(setup)
}

/// Wall seconds that so many runs may take, judged by a second of the first run and one of the last.
pub(super) fn estimate_s(sweep: &Sweep, options: &SweepOptions, runs: usize) -> Option<f64> {
    let jobs = jobs(options, runs);
    let sample = |run: usize| -> Option<f64> {
        let loaded = sweep.load(run).ok()?;
        let mut setup = unwatched(&loaded).ok()?;
        setup.limits.wall = Some(SAMPLE);
        if jobs > 1 {
            setup.threads = 1;
        }
        let mut simulation = Simulation::new(setup).ok()?;
        let end = simulation.end().as_secs_f64();
        let outcome = simulation.run();
        let s = outcome.summary;
        let share = match outcome.error {
            None if s.virtual_s > 0.0 && s.wall_s >= SAMPLE.as_secs_f64() => s.virtual_s / end,
            None => 1.0,
            Some(_) => return None,
        };
        Some(s.time.init_s + s.wall_s / share)
    };
    let last = sweep.len() - 1;
    let both = caught(|| Some([sample(0)?, sample(last)?])).ok()??;
    Some(0.5 * (both[0] + both[1]) * runs as f64 / jobs.max(1) as f64)
}

/// One run. `None` if it was interrupted.
fn one(shared: &Shared<'_>, run: usize) -> Result<Option<Row>, Box<Row>> {
    let failed = |error: String| Box::new(Row::failed(run, shared.sweep.seed(run), error));
    let loaded = shared.sweep.load(run);
    let loaded = loaded.map_err(|rejected| failed(input::text_of(&rejected)))?;
    let mut setup = unwatched(&loaded).map_err(|f| failed(f.message))?;
    if shared.jobs > 1 {
        setup.threads = 1;
    }
    if let Some(folder) = &shared.record {
        let path = super::recording(folder, run);
        let component = recorder(&path, &loaded).map_err(|f| failed(f.message))?;
        setup.components.push((RECORDER.to_owned(), component));
    }
    let simulation = Simulation::new(setup);
    let mut simulation =
        simulation.map_err(|e| failed(input::setup_failure(&loaded, e).message))?;
    match lock(&shared.going).as_mut() {
        Some(going) => going.push(Going {
            control: simulation.control(),
            progress: simulation.progress(),
            end: simulation.end(),
        }),
        None => return Ok(None),
    }
    let outcome = simulation.run();
    let control = simulation.control();
    if let Some(going) = lock(&shared.going).as_mut() {
        going.retain(|other| !Arc::ptr_eq(&other.control, &control));
    }
    match outcome.error {
        Some(error) => {
            let row = Row::of(run, &outcome.summary);
            Err(Box::new(row.with_error(error.to_string())))
        }
        None if outcome.summary.ended == INTERRUPTED => Ok(None),
        None => Ok(Some(Row::of(run, &outcome.summary))),
    }
}

#[cfg(test)]
mod tests {
    use super::caught;

    #[test]
    fn a_panic_becomes_words() {
        assert_eq!(caught(|| 3), Ok(3));
        let wings = "wings";
        let said = |act: fn(&str)| caught(|| act(wings)).expect_err("it panics");
        assert_eq!(said(|part| panic!("no {part}")), "panicked: no wings");
        assert_eq!(said(|_| panic!("no wings")), "panicked: no wings");
        assert_eq!(
            said(|_| std::panic::panic_any(3)),
            "panicked: without a word"
        );
    }
}
