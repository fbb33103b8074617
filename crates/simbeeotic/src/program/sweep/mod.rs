//! `sweep`: one scenario, many runs, one table.
//!
//! What varies stands in the scenario's `[sweep]`, or is said by `--vary` and `--seeds`. Each run is put
//! together from the scenario as it would be alone, so its trace is that of `run` with the same values;
//! neither the other runs nor the number of jobs show in it.
//!
//! Reading order: `runs` (running them), `rows` (what a run comes to, as a row), `unfinished` (rows as they come,
//! and going on), `report` (means over seeds), `paired` (differences
//! to a baseline), `bar` (how far it is).

mod bar;
mod paired;
mod report;
mod rows;
mod runs;
mod unfinished;

use super::arguments::ScenarioOptions;
use super::outputs;
use super::table::TableFile;
use super::{Failure, input, remark, say};
use clap::Args;
use paired::Baseline;
use rows::Rows;
use simbeeotic_scenario::{Sweep, set};
use std::path::{Path, PathBuf};
use unfinished::Unfinished;

pub(super) const SWEEP_EXAMPLES: &str = "\
Examples:
  simbeeotic sweep scenarios/first-swarm.toml --seeds 10 -o bees.csv
  simbeeotic sweep scenarios/first-swarm.toml --seeds 1..5 --vary \"model.bee.count=50,100,200\"
  simbeeotic sweep scenarios/broadcast.toml --vary \"channel.range_limit=10 m..50 m step 10 m\"
  simbeeotic sweep scenarios/first-swarm.toml --seeds 3 --record runs --dry-run
  simbeeotic sweep scenarios/first-swarm.toml --seeds 200 --resume
  simbeeotic sweep scenarios/talk.toml --seeds 10 --vary model.bee.count=10,20 --baseline count=10
  simbeeotic plot sweep first-swarm-runs.csv --x model.bee.count --metric contacts -o contacts.svg

The table has one row a run: run, seed, the values that vary, trace_hash, ended, error, virtual_s,
contacts, packets/sent, packets/received, energy/spent, and for each number that models publish NAME
(the sum of their last values) and NAME/mean, with [units]. Until it is whole, rows are in
TABLE.unfinished as soon as their runs are done; after Ctrl-C or a crash --resume flies only the others.";

/// Letters of a scenario's name that name its table, at most.
const NAME_LETTERS: usize = 60;

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
    /// The table to write: .csv, .parquet or .json [default: NAME-runs.csv, after
    /// the scenario's `name`, or its file if it has none]
    #[arg(long, short, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Record each run into this folder: run-0001.mcap, ... [default: nothing is recorded]
    #[arg(long, value_name = "FOLDER")]
    record: Option<PathBuf>,
    /// Metric whose means are printed, as columns of the table are called; may be given many times [default:
    /// the first of all]
    #[arg(long, value_name = "NAME")]
    metric: Vec<String>,
    /// Print differences to the runs that have this value, pair by pair of equal seeds, with their 95 % interval: a
    /// key that varies, or the end of it, and one of its values
    #[arg(long, value_name = "KEY=VALUE")]
    baseline: Option<String>,
    /// Go on with a sweep that was broken off: runs whose rows are there are not flown again. The program and
    /// the scenario must be the same; seeds and values may be more
    #[arg(long, conflicts_with = "restart")]
    resume: bool,
    /// Fly all runs, although there are rows of a sweep that was broken off
    #[arg(long)]
    restart: bool,
    /// List the runs, and say how long they may take, judged by a second of the first and one of the last;
    /// nothing is written
    #[arg(long)]
    dry_run: bool,
    /// No progress bar, no table of means: errors only
    #[arg(long, short)]
    quiet: bool,
}

/// Runs all runs of a scenario.
pub(super) fn sweep(options: &SweepOptions) -> Result<(), Failure> {
    let said = options.output.as_deref();
    let said = said.map(|path| TableFile::new("--output", path));
    let said = said.transpose()?;
    let loaded = input::load(&scenario(options), options.quiet)?;
    let file = match said {
        Some(file) => file,
        None => {
            let path = default_output(&loaded.plan().name, &options.scenario.scenario);
            TableFile::new("--output", &path)?
        }
    };
    let Some(sweep) = loaded.sweep() else {
        return Err(Failure::input(format!(
            "{} does not say what varies: say it with --seeds 10 or --vary \"KEY=a,b,c\", or in its `[sweep]`",
            loaded.name()
        )));
    };
    sweep
        .check()
        .map_err(|rejected| Failure::input(input::text_of(&rejected)))?;
    let baseline = options.baseline.as_deref();
    let baseline = baseline
        .map(|text| Baseline::read(sweep, text))
        .transpose()?;
    if options.dry_run {
        say(report::listed(sweep).trim_end())?;
        if !options.quiet {
            remark(planned(sweep, options));
        }
        return Ok(());
    }
    outputs::check_runs(
        &options.scenario,
        &file,
        options.record.as_deref(),
        sweep.len(),
    )?;
    let (mut unfinished, before) = Unfinished::open(sweep, &file.path, options)?;
    if !before.is_empty() && !options.quiet {
        remark(format!("{} of {} runs are done", before.len(), sweep.len()));
    }
    if let Some(folder) = &options.record {
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::run(format!("--record {}: {e}", folder.display())))?;
    }
    let done = runs::run(sweep, options, before, &mut unfinished)?;
    let rows = Rows::of(sweep, done.rows);
    if done.interrupted && rows.len() == 0 {
        // What an earlier sweep wrote is worth more than a line of names.
        remark("interrupted: no run is done, and nothing is written");
        return Err(Failure::interrupted());
    }
    // A reader that has gone away must not cost the table.
    let printed = match options.quiet {
        true => Ok(()),
        false => {
            let names = report::columns(&rows, &options.metric);
            let mut text = report::means(sweep, &rows, &names);
            if let Some(baseline) = &baseline {
                text.push('\n');
                text.push_str(&paired::differences(&rows, &names, baseline));
            }
            say(text.trim_end())
        }
    };
    file.write_or_keep(&rows.columns())?;
    let kept = unfinished.is_kept() && (done.interrupted || rows.failed() > 0);
    let go_on = match kept {
        true => "; the same command with --resume goes on",
        false => "",
    };
    if done.interrupted {
        // Those of an earlier sweep would be taken for this one's.
        if let Some(folder) = &options.record {
            for run in (0..sweep.len()).filter(|run| !rows.has(*run)) {
                let _ = std::fs::remove_file(recording(folder, run));
            }
        }
    } else if !kept {
        unfinished.finish();
    }
    printed?;
    if !options.quiet {
        remark(format!("wrote {}", file.path.display()));
    }
    match (done.interrupted, rows.failed()) {
        (true, _) => {
            remark(format!(
                "interrupted: {} of {} runs are done{go_on}",
                rows.len(),
                sweep.len()
            ));
            Err(Failure::interrupted())
        }
        (false, 0) => Ok(()),
        (false, failed) => Err(Failure::run(format!(
            "{failed} of {} runs failed; their rows say why{}",
            sweep.len(),
            match kept {
                true => "; the same command with --resume flies them again, and only them",
                false => "",
            }
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

/// The table that no option names: `NAME-runs.csv`, after the scenario's name as far as it is fit for a file's,
/// or its file if it has none.
fn default_output(name: &str, scenario: &Path) -> PathBuf {
    let fit = |letter: char| letter.is_alphanumeric() || matches!(letter, '-' | '_' | '.');
    let words = name.split(|letter| !fit(letter));
    let words: Vec<&str> = words
        .filter(|word| word.contains(char::is_alphanumeric))
        .collect();
    let name: String = words.join("-").chars().take(NAME_LETTERS).collect();
    let stem = scenario.file_stem().map(|stem| stem.to_string_lossy());
    let name = match name.trim_matches('.') {
        "" => stem.as_deref().unwrap_or("scenario"),
        name => name,
    };
    PathBuf::from(format!("{name}-runs.csv"))
}

/// The recording of a run, counted from 0.
pub(super) fn recording(folder: &Path, run: usize) -> PathBuf {
    folder.join(format!("run-{:04}.mcap", run + 1))
}

/// The first recording in a folder of a run that so many do not have.
pub(super) fn beyond(folder: &Path, runs: usize) -> Option<PathBuf> {
    let is_beyond = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str());
        let number = name.and_then(|name| name.strip_prefix("run-")?.strip_suffix(".mcap"));
        number.is_some_and(|n| n.parse::<usize>().is_ok_and(|n| n > runs))
    };
    let entries = std::fs::read_dir(folder).ok()?;
    let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
    paths.filter(is_beyond).min()
}

/// So many runs.
fn runs_said(count: usize) -> String {
    match count {
        1 => "1 run".to_owned(),
        count => format!("{count} runs"),
    }
}

/// How many runs there are, and how long they may take.
fn planned(sweep: &Sweep, options: &SweepOptions) -> String {
    match runs::estimate_s(sweep, options, sweep.len()) {
        Some(wall_s) => format!(
            "{}: about {} in all, judged by a second of the first and one of the last",
            counted(sweep),
            super::show::span(wall_s)
        ),
        None => counted(sweep),
    }
}

/// How many runs there are, for a sentence.
pub(super) fn counted(sweep: &Sweep) -> String {
    let runs = runs_said;
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

/// That there are more runs than this one, in one line.
pub(super) fn beside(sweep: &Sweep, scenario: &Path) -> String {
    format!(
        "this scenario has a [sweep] of {}, and flies here as it stands; all of them: simbeeotic sweep {}",
        runs_said(sweep.len()),
        scenario.display()
    )
}

/// That this run is the first of many, in one line.
pub(super) fn first_of(sweep: &Sweep, scenario: &Path) -> String {
    format!(
        "the first of {}{}; all of them: simbeeotic sweep {}",
        runs_said(sweep.len()),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_named_after_the_scenario_and_stays_in_this_folder() {
        let file = Path::new("examples/hive/scenario.toml");
        for (name, table) in [
            ("hive", "hive-runs.csv"),
            ("", "scenario-runs.csv"),
            ("../..", "scenario-runs.csv"),
            ("a/b: the *third*", "a-b-the-third-runs.csv"),
            ("Bienenstöcke, 2", "Bienenstöcke-2-runs.csv"),
        ] {
            assert_eq!(default_output(name, file), Path::new(table), "{name}");
        }
        let long = default_output(&"é".repeat(4000), file);
        assert!(long.as_os_str().len() < 200);
    }
}
