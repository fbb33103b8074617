//! `sweep`: one scenario, many runs, one table.
//!
//! What varies stands in the scenario's `[sweep]`, or is said by `--vary` and `--seeds`. Each run is put
//! together from the scenario as it would be alone, so its trace is that of `run` with the same values;
//! neither the other runs nor the number of jobs show in it.
//!
//! Reading order: `runs` (running them), `rows` (what a run comes to, as a row), `report` (means over seeds).

mod report;
mod rows;
mod runs;

use super::arguments::ScenarioOptions;
use super::outputs;
use super::table::TableFile;
use super::{Failure, input, remark, say};
use clap::Args;
use rows::Rows;
use simbeeotic_scenario::{Sweep, set};
use std::path::{Path, PathBuf};

pub(super) const SWEEP_EXAMPLES: &str = "\
Examples:
  simbeeotic sweep scenarios/first-swarm.toml --seeds 10
  simbeeotic sweep scenarios/first-swarm.toml --seeds 1..5 --vary \"model.bee.count=50,100,200\"
  simbeeotic sweep scenarios/broadcast.toml --vary \"channel.range_limit=10 m..50 m step 10 m\" -o range.csv
  simbeeotic sweep scenarios/first-swarm.toml --seeds 3 --record runs --dry-run
  simbeeotic plot sweep first-swarm-runs.csv --x model.bee.count --metric contacts -o contacts.svg

The table has one row a run: run, seed, the values that vary, trace_hash, ended, error, virtual_s,
contacts, packets/sent, packets/received, energy/spent, and for each number that models publish NAME
(the sum of their last values) and NAME/mean, with [units].";

/// What to run, how often, and where the table goes.
#[derive(Args)]
pub(super) struct SweepOptions {
    #[command(flatten)]
    pub(super) scenario: ScenarioOptions,
    /// Seeds: 10 (so many, from the scenario's own on), 1..20, or 3,5,8 [default: the scenario's]
    #[arg(long, value_name = "SEEDS", allow_hyphen_values = true)]
    seeds: Option<String>,
    /// Vary a value, and replace what the scenario says of this key: a list "KEY=a,b,c" or a range
    /// "KEY=10 m..50 m step 10 m"; may be given many times, and all combinations are run
    #[arg(long, value_name = "KEY=VALUES")]
    vary: Vec<String>,
    /// Runs at a time, each on one thread; with 1, one run at a time on all threads. The table is the
    /// same for any number [default: one for each core]
    #[arg(long, value_name = "N", value_parser = super::arguments::threads, allow_negative_numbers = true)]
    jobs: Option<usize>,
    /// The table to write: .csv, .parquet or .json [default: the scenario's name, -runs.csv]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Record each run into this folder: run-0001.mcap, ... [default: nothing is recorded]
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// List the runs, and do nothing
    #[arg(long)]
    dry_run: bool,
    /// No progress bar, no table of means: errors only
    #[arg(long, short)]
    quiet: bool,
}

/// Runs all runs of a scenario.
pub(super) fn sweep(options: &SweepOptions) -> Result<(), Failure> {
    let path = match &options.output {
        Some(path) => path.clone(),
        None => default_output(&options.scenario.scenario),
    };
    let file = TableFile::new("--output", &path)?;
    let loaded = input::load(&scenario(options), options.quiet)?;
    let Some(sweep) = loaded.sweep() else {
        return Err(Failure::input(format!(
            "{} does not say what varies: say it with --seeds 10 or --vary \"KEY=a,b,c\", or in its `[sweep]`",
            loaded.name()
        )));
    };
    sweep
        .check()
        .map_err(|rejected| Failure::input(input::text_of(&rejected)))?;
    if options.dry_run {
        return say(report::listed(sweep).trim_end());
    }
    outputs::check_runs(
        &options.scenario,
        &file,
        options.record.as_deref(),
        sweep.len(),
    )?;
    if let Some(folder) = &options.record {
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::run(format!("--record {}: {e}", folder.display())))?;
    }
    let done = runs::run(sweep, options)?;
    let rows = Rows::of(sweep, done.rows);
    file.write(&rows.columns())?;
    if !options.quiet {
        say(report::means(sweep, &rows).trim_end())?;
        remark(format!("wrote {}", path.display()));
    }
    match (done.interrupted, rows.failed()) {
        (true, _) => {
            remark(format!(
                "interrupted: {} of {} runs are done",
                rows.len(),
                sweep.len()
            ));
            Err(Failure::interrupted())
        }
        (false, 0) => Ok(()),
        (false, failed) => Err(Failure::run(format!(
            "{failed} of {} runs failed; their rows say why",
            sweep.len()
        ))),
    }
}

/// The scenario, with what the options vary.
fn scenario(options: &SweepOptions) -> ScenarioOptions {
    let mut scenario = options.scenario.clone();
    let vary = options
        .vary
        .iter()
        .map(|text| format!("{}{text}", set::VARY));
    let seeds = options
        .seeds
        .iter()
        .map(|text| format!("{}{text}", set::SEEDS));
    scenario.sets.extend(vary.chain(seeds));
    scenario
}

fn default_output(scenario: &Path) -> PathBuf {
    let stem = scenario.file_stem().map(|stem| stem.to_string_lossy());
    PathBuf::from(format!(
        "{}-runs.csv",
        stem.as_deref().unwrap_or("scenario")
    ))
}

/// The recording of a run, counted from 0.
pub(super) fn recording(folder: &Path, run: usize) -> PathBuf {
    folder.join(format!("run-{:04}.mcap", run + 1))
}

/// How many runs there are, for a sentence.
pub(super) fn counted(sweep: &Sweep) -> String {
    let runs = |n: usize| match n {
        1 => "1 run".to_owned(),
        n => format!("{n} runs"),
    };
    let combinations = match sweep.combinations() {
        1 => "1 combination".to_owned(),
        n => format!("{n} combinations"),
    };
    match sweep.seeds().map_or(1, <[i64]>::len) {
        1 => format!("{} in its sweep", runs(sweep.len())),
        seeds => format!(
            "{} in its sweep ({combinations}, {seeds} seeds)",
            runs(sweep.len())
        ),
    }
}

/// That this run is the first of many, in one line.
pub(super) fn first_of(sweep: &Sweep, scenario: &Path) -> String {
    format!(
        "the first of {} runs{}; all of them: simbeeotic sweep {}",
        sweep.len(),
        said(sweep, 0),
        scenario.display()
    )
}

/// What sets a run apart: ` (seed 3, a = 1)`.
pub(super) fn said(sweep: &Sweep, run: usize) -> String {
    let seed = sweep.seed(run).map(|seed| format!("seed {seed}"));
    let pairs = sweep.keys().zip(sweep.values(run));
    let pairs = pairs.map(|(key, value)| format!("{key} = {value}"));
    let all: Vec<String> = seed.into_iter().chain(pairs).collect();
    match all.is_empty() {
        true => String::new(),
        false => format!(" ({})", all.join(", ")),
    }
}
