//! `run` and `check`.

use super::arguments::{RunOptions, ScenarioOptions};
use super::input::{self, time};
use super::{Failure, remark, say, show};
use simbeeotic_model::registry::{self, Kind, Make};
use simbeeotic_model::{Setup, Simulation};
use simbeeotic_scenario::Loaded;
use std::path::Path;
use std::time::Instant;

/// Runs a scenario.
#[allow(
    clippy::disallowed_methods,
    reason = "how long it took goes into the summary"
)]
pub(super) fn run(options: RunOptions) -> Result<(), Failure> {
    let started = Instant::now();
    let loaded = input::load(&options.scenario, options.quiet)?;
    let mut setup = input::setup(&loaded)?;
    if let Some(threads) = options.threads {
        setup.threads = threads;
    }
    if let Some(factor) = options.real_time {
        setup.pace = Some(factor);
    }
    if let Some(text) = &options.wall_time {
        let wall = time("--wall-time", text)?;
        setup.limits.wall = std::time::Duration::try_from_secs_f64(wall.get()).ok();
    }
    choose_recording(&mut setup, &options)?;
    if options.log {
        setup
            .components
            .push(("log".to_owned(), Box::new(super::log::LogPrinter)));
    }
    let before_s = started.elapsed().as_secs_f64();
    let mut simulation = Simulation::new(setup).map_err(|e| input::setup_failure(&loaded, e))?;
    simulation.add_init_time(before_s);

    let bar = (!options.quiet).then(|| show::Bar::start(simulation.progress(), simulation.end()));
    stop_on_interrupt(&simulation);
    let outcome = simulation.run();
    drop(bar);

    if options.json {
        match serde_json::to_string_pretty(&outcome.summary) {
            Ok(text) => say(text),
            Err(e) => return Err(Failure::run(format!("cannot write the summary: {e}"))),
        }
    } else if !options.quiet {
        say(show::summary(&outcome.summary).trim_end());
    }
    match outcome.error {
        Some(error) => Err(Failure::run(error)),
        None => Ok(()),
    }
}

/// Ctrl-C ends the run after the present instant, with its recording closed and its summary shown.
fn stop_on_interrupt(simulation: &Simulation) {
    let control = simulation.control();
    // Without a handler, Ctrl-C just ends the program; the recording still reads.
    let _ = ctrlc::set_handler(move || control.stop("interrupted"));
}

/// `--record FILE` and `--no-record` overrule the scenario's recorders.
fn choose_recording(setup: &mut Setup, options: &RunOptions) -> Result<(), Failure> {
    if options.no_record {
        setup.components.retain(|(name, _)| name != "recorder");
    }
    let Some(path) = &options.record else {
        return Ok(());
    };
    let component = recorder(path)?;
    setup.components.retain(|(name, _)| name != "recorder");
    setup.components.push(("recorder".to_owned(), component));
    Ok(())
}

fn recorder(path: &Path) -> Result<Box<dyn simbeeotic_model::Component>, Failure> {
    let part = registry::find(Kind::Component, "recorder").map(|p| p.make);
    let Some(Make::Component(make)) = part else {
        return Err(Failure::run("this program has no recorder"));
    };
    make(&input::table([("path", path.display().to_string())])).map_err(|faults| {
        Failure::input(
            faults
                .iter()
                .map(ToString::to_string)
                .collect::<Vec<_>>()
                .join("\n"),
        )
    })
}

/// Checks a scenario: reads it and puts it together, and does not run it.
pub(super) fn check(options: &ScenarioOptions) -> Result<(), Failure> {
    let loaded = input::load(options, false)?;
    let setup = input::setup(&loaded)?;
    let simulation = Simulation::new(setup).map_err(|e| input::setup_failure(&loaded, e))?;
    say(describe(&loaded, &simulation));
    Ok(())
}

fn describe(loaded: &Loaded, simulation: &Simulation) -> String {
    let population = simulation.population();
    let mut kinds: Vec<(&str, usize)> = Vec::new();
    for (_, member) in population.iter() {
        match kinds.iter_mut().find(|(kind, _)| *kind == member.kind) {
            Some((_, count)) => *count += 1,
            None => kinds.push((member.kind, 1)),
        }
    }
    let kinds: Vec<String> = kinds
        .iter()
        .map(|(kind, count)| format!("{count} {kind}"))
        .collect();
    format!(
        "{} is fine: {} models ({}), until {}",
        loaded.name(),
        population.len(),
        kinds.join(", "),
        simulation.end()
    )
}

/// For a file that says more than it means: shown once, before the run.
pub(super) fn warn(text: &str) {
    if !text.is_empty() {
        remark(text.trim_end());
    }
}
