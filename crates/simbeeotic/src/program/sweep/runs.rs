//! The runs themselves, several at a time.

use super::rows::Row;
use super::{SweepOptions, said};
use crate::program::outputs::RECORDER;
use crate::program::run::{INTERRUPTED, at_interrupt, recorder};
use crate::program::show::Steps;
use crate::program::view::VIEWER;
use crate::program::{Failure, complain, input};
use simbeeotic_kernel::pace::Control;
use simbeeotic_model::Simulation;
use simbeeotic_scenario::Sweep;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

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
    next: AtomicUsize,
    /// The runs that are going on; `None` once they shall stop.
    going: Arc<Mutex<Option<Vec<Arc<Control>>>>>,
    rows: Mutex<Vec<Row>>,
    bar: Option<Steps>,
}

/// A lock that one who panicked held is as good as any: what is behind it is whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Runs all runs. One that fails is told, and the others go on.
pub(super) fn run(sweep: &Sweep, options: &SweepOptions) -> Result<Done, Failure> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let shared = Shared {
        sweep,
        jobs: options.jobs.unwrap_or(cores).min(sweep.len()),
        record: options.record.clone(),
        next: AtomicUsize::new(0),
        going: Arc::new(Mutex::new(Some(Vec::new()))),
        rows: Mutex::new(Vec::new()),
        bar: (!options.quiet).then(|| Steps::start(sweep.len() as u64, "runs")),
    };
    let going = Arc::clone(&shared.going);
    let interrupted = at_interrupt(move || {
        for control in lock(&going).take().into_iter().flatten() {
            control.stop(INTERRUPTED);
        }
    });
    std::thread::scope(|scope| {
        for _ in 0..shared.jobs {
            scope.spawn(|| work(&shared));
        }
    });
    let mut rows = shared
        .rows
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner);
    rows.sort_by_key(|row| row.run);
    Ok(Done {
        interrupted: interrupted.load(Ordering::Relaxed) && rows.len() < sweep.len(),
        rows,
    })
}

/// Takes runs until there are no more.
fn work(shared: &Shared<'_>) {
    loop {
        let run = shared.next.fetch_add(1, Ordering::Relaxed);
        if run >= shared.sweep.len() || lock(&shared.going).is_none() {
            return;
        }
        let row = match one(shared, run) {
            Ok(Some(row)) => row,
            // Interrupted: it did not come to its end.
            Ok(None) => return,
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
        rows.push(row);
        if let Some(bar) = &shared.bar {
            bar.at(rows.len() as u64);
        }
    }
}

/// One run. `None` if it was interrupted.
fn one(shared: &Shared<'_>, run: usize) -> Result<Option<Row>, Box<Row>> {
    let failed = |error: String| Box::new(Row::failed(run, shared.sweep.seed(run), error));
    let loaded = shared.sweep.load(run);
    let loaded = loaded.map_err(|rejected| failed(input::text_of(&rejected)))?;
    let mut setup = input::setup(&loaded).map_err(|f| failed(f.message))?;
    setup
        .components
        .retain(|(name, _)| name != RECORDER && name != VIEWER);
    setup.pace = None;
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
        Some(going) => going.push(simulation.control()),
        None => return Ok(None),
    }
    let outcome = simulation.run();
    let control = simulation.control();
    if let Some(going) = lock(&shared.going).as_mut() {
        going.retain(|other| !Arc::ptr_eq(other, &control));
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
