//! From files and arguments to a run: the one place where the program meets the scenario crate.

use super::arguments::ScenarioOptions;
use super::{Failure, colour, run};
use crate::library;
use simbeeotic_kernel::SimTime;
use simbeeotic_model::{Setup, SetupError};
use simbeeotic_scenario::{Checked, Loaded, Rejected, Request, check_file, load_file, render, set};
use simbeeotic_units::Time;

/// Reads and checks a scenario; shows warnings and notes unless `quiet`.
pub(super) fn load(options: &ScenarioOptions, quiet: bool) -> Result<Loaded, Failure> {
    match load_file(&options.scenario, &request(options)) {
        Ok(loaded) => {
            if !quiet {
                run::warn(&render::faults(loaded.faults(), loaded.sources(), colour()));
            }
            Ok(loaded)
        }
        Err(rejected) => Err(Failure::input(text_of(&rejected))),
    }
}

/// Reads and checks a scenario, or a world alone; shows warnings and notes.
pub(super) fn check(options: &ScenarioOptions) -> Result<Checked, Failure> {
    let checked = check_file(&options.scenario, &request(options));
    let checked = checked.map_err(|rejected| Failure::input(text_of(&rejected)))?;
    let (faults, sources) = match &checked {
        Checked::Scenario(loaded) => (loaded.faults(), loaded.sources()),
        Checked::World {
            faults, sources, ..
        } => (faults.as_slice(), sources),
    };
    run::warn(&render::faults(faults, sources, colour()));
    Ok(checked)
}

fn request(options: &ScenarioOptions) -> Request {
    let mut sets = options.sets.clone();
    if let Some(seed) = options.seed {
        sets.push(format!("{}{seed}", set::SEED));
    }
    if let Some(end) = &options.end_time {
        sets.push(format!("{}{end}", set::END_TIME));
    }
    Request {
        world: options.world.clone(),
        sets,
    }
}

/// All faults of a rejected scenario, as text.
pub(super) fn text_of(rejected: &Rejected) -> String {
    library::faults_text(&rejected.faults, &rejected.sources, colour())
}

/// The run that a checked scenario describes.
pub(super) fn setup(loaded: &Loaded) -> Result<Setup, Failure> {
    loaded
        .setup()
        .map_err(|faults| Failure::input(library::faults_text(&faults, loaded.sources(), colour())))
}

/// Models that cannot be built, at their places in the scenario.
pub(super) fn setup_failure(loaded: &Loaded, error: SetupError) -> Failure {
    Failure::input(library::setup_text(loaded, error, colour()))
}

/// A span of time in an argument.
pub(super) fn time(option: &str, text: &str) -> Result<Time, Failure> {
    match text.parse::<Time>() {
        Ok(time) if time > Time::ZERO => Ok(time),
        Ok(time) => Err(Failure::input(format!(
            "{option} {time}: it must be more than zero"
        ))),
        Err(e) => Err(Failure::input(format!("{option}: {e}"))),
    }
}

/// A point of time in an argument: zero is allowed.
pub(super) fn span(option: &str, text: &str) -> Result<Time, Failure> {
    text.parse::<Time>()
        .map_err(|e| Failure::input(format!("{option}: {e}")))
}

/// A point of time in an argument, ns.
pub(super) fn nanos(option: &str, text: Option<&str>) -> Result<Option<u64>, Failure> {
    let read = |text| {
        SimTime::from_time(span(option, text)?)
            .map(SimTime::nanos)
            .map_err(|e| Failure::input(format!("{option}: {e}")))
    };
    text.map(read).transpose()
}

/// A part of a recording: it must not begin after its end, which is that of the recording unless `said`.
pub(super) fn in_order(from_ns: u64, to_ns: u64, said: bool) -> Result<(), Failure> {
    if from_ns <= to_ns {
        return Ok(());
    }
    let (from, to) = (SimTime::from_nanos(from_ns), SimTime::from_nanos(to_ns));
    Err(Failure::input(match said {
        true => format!("--from {from} is after --to {to}: there is nothing between them"),
        false => format!("--from {from} is after the end of the recording, {to}"),
    }))
}
