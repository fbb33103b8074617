//! `run` and `check`.

use super::arguments::{Factor, RunOptions, ScenarioOptions};
use super::input::{self, time};
use super::outputs::{self, RECORDER};
use super::summary::SummaryFile;
use super::{Failure, complain, remark, say, show, sweep, view};
use simbeeotic_model::config::{Node, Span};
use simbeeotic_model::registry::{self, Kind, Make};
use simbeeotic_model::{Setup, Simulation, SimulationError};
use simbeeotic_scenario::{Checked, Loaded};
use simbeeotic_world::{Patch, World};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

/// Runs a scenario.
#[allow(
    clippy::disallowed_methods,
    reason = "how long it took goes into the summary"
)]
pub(super) fn run(options: RunOptions) -> Result<(), Failure> {
    let started = Instant::now();
    let table = options.summary.as_deref().map(SummaryFile::new);
    let table = table.transpose()?;
    let loaded = input::load(&options.scenario, options.quiet)?;
    if let Some(sweep) = loaded.sweep().filter(|_| !options.quiet) {
        let file = &options.scenario.scenario;
        remark(match loaded.is_first_of_sweep() {
            true => sweep::first_of(sweep, file),
            false => sweep::beside(sweep, file),
        });
    }
    let mut setup = input::setup(&loaded)?;
    if let Some(threads) = options.threads {
        setup.threads = threads;
    }
    match options.real_time {
        Some(Factor::Times(factor)) => setup.pace = Some(factor),
        Some(Factor::Max) => setup.pace = None,
        // To be looked at.
        None if options.view => setup.pace = setup.pace.or(Some(1.0)),
        None => {}
    }
    if let Some(text) = &options.wall_time {
        let wall = time("--wall-time", text)?;
        setup.limits.wall = Duration::try_from_secs_f64(wall.get()).ok();
    }
    choose_recording(&mut setup, &loaded, &options)?;
    outputs::check(&loaded, &options)?;
    let visitors = view::choose_viewer(&mut setup, &loaded, &options)?;
    if options.log {
        setup
            .components
            .push(("log".to_owned(), Box::new(super::log::LogPrinter)));
    }
    let before_s = started.elapsed().as_secs_f64();
    let mut simulation = Simulation::new(setup).map_err(|e| input::setup_failure(&loaded, e))?;
    simulation.add_init_time(before_s);

    let bar = (!options.quiet).then(|| show::Bar::start(simulation.progress(), simulation.end()));
    let interrupted = stop_on_interrupt(&simulation);
    let outcome = simulation.run();
    drop(bar);

    let summary = &outcome.summary;
    if let Some(SimulationError::Component(error)) = &outcome.error
        && summary.events == 0
    {
        // A component did not start: there was no run, and there is nothing to sum up.
        return Err(Failure::input(error));
    }
    let written = table.map_or(Ok(()), |table| table.write(&simulation, summary));
    let ended = match &outcome.error {
        // It is shown below.
        Some(_) => "failed",
        None => &summary.ended,
    };
    let said = if options.json {
        match serde_json::to_string_pretty(summary) {
            Ok(text) => say(text),
            Err(e) => Err(Failure::run(format!("cannot write the summary: {e}"))),
        }
    } else if !options.quiet {
        say(show::summary(summary, ended).trim_end())
    } else {
        Ok(())
    };
    let mut result = match &outcome.error {
        Some(error) => Err(Failure::run(error)),
        None => said.and(written),
    };
    if let Some(visitors) = visitors
        && !interrupted.load(Ordering::Relaxed)
    {
        if let Err(failure) = &mut result {
            complain(&std::mem::take(&mut failure.message));
        }
        // Pages go on asking about the swarm; what another component says to that is nobody's business any more.
        view::linger(&visitors, &interrupted, || {
            let _ = simulation.show_held();
        });
    }
    result?;
    if summary.ended == INTERRUPTED && interrupted.load(Ordering::Relaxed) {
        return Err(Failure::interrupted());
    }
    Ok(())
}

/// Why an interrupted run ended, in its summary.
pub(super) const INTERRUPTED: &str = "interrupted";

/// Ctrl-C and SIGTERM end the run after the present instant, with its recording closed and its
/// summary shown; a second one ends the program at once. Tells whether there was one.
fn stop_on_interrupt(simulation: &Simulation) -> Arc<AtomicBool> {
    let control = simulation.control();
    at_interrupt(move || control.stop(INTERRUPTED))
}

/// Does something at the first Ctrl-C or SIGTERM, and tells whether there was one; a second one ends the
/// program at once. What comes together is one: a terminal and a batch system send several.
#[allow(
    clippy::disallowed_methods,
    reason = "interrupts come in the time of people"
)]
pub(super) fn at_interrupt(act: impl Fn() + Send + 'static) -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    let first = OnceLock::new();
    on_interrupt(move || {
        let now = Instant::now();
        if is_another(*first.get_or_init(|| now), now) {
            std::process::exit(130);
        }
        if !flag.swap(true, Ordering::Relaxed) {
            act();
        }
    });
    interrupted
}

/// Whether an interrupt is not the first one once more.
fn is_another(first: Instant, now: Instant) -> bool {
    now.saturating_duration_since(first) >= TOGETHER
}

/// Interrupts within this time are one.
const TOGETHER: Duration = Duration::from_millis(500);

/// Calls `act` at each interrupt. If that cannot be had, an interrupt just ends the program, and the
/// recording still reads.
#[cfg(unix)]
pub(super) fn on_interrupt(act: impl Fn() + Send + 'static) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM]) {
        std::thread::spawn(move || signals.forever().for_each(|_| act()));
    }
}

#[cfg(not(unix))]
pub(super) fn on_interrupt(act: impl Fn() + Send + 'static) {
    let _ = ctrlc::set_handler(act);
}

/// `--record FILE` and `--no-record` overrule the scenario's recorders.
fn choose_recording(
    setup: &mut Setup,
    loaded: &Loaded,
    options: &RunOptions,
) -> Result<(), Failure> {
    if options.no_record {
        setup.components.retain(|(name, _)| name != RECORDER);
    }
    let Some(path) = &options.record else {
        return Ok(());
    };
    let component = recorder(path, loaded)?;
    setup.components.retain(|(name, _)| name != RECORDER);
    setup.components.push((RECORDER.to_owned(), component));
    Ok(())
}

/// A recorder that writes to `path`; all else is as the scenario's first recorder has it.
pub(super) fn recorder(
    path: &Path,
    loaded: &Loaded,
) -> Result<Box<dyn simbeeotic_model::Component>, Failure> {
    let part = registry::find(Kind::Component, RECORDER).map(|p| p.make);
    let Some(Make::Component(make)) = part else {
        return Err(Failure::run("this program has no recorder"));
    };
    let mut choices = loaded.plan().components.iter();
    let choice = choices.find(|choice| choice.part.label.name == RECORDER);
    let mut params = choice.map_or_else(|| Node::table(Span::default()), |c| c.params.clone());
    if let Some(table) = params.as_table_mut() {
        table.set(
            "path",
            Node::string(Span::default(), path.display().to_string()),
        );
    }
    make(&params).map_err(|faults| {
        let lines: Vec<String> = faults.iter().map(ToString::to_string).collect();
        Failure::input(lines.join("\n"))
    })
}

/// Checks a scenario: reads it and puts it together, and does not run it. A world alone is read.
pub(super) fn check(options: &ScenarioOptions) -> Result<(), Failure> {
    let loaded = match input::check(options)? {
        Checked::Scenario(loaded) => loaded,
        Checked::World { name, world, .. } => return say(describe_world(&name, &world)),
    };
    let setup = input::setup(&loaded)?;
    let simulation = Simulation::new(setup).map_err(|e| input::setup_failure(&loaded, e))?;
    let mut said = describe(&loaded, &simulation);
    if let Some(sweep) = loaded.sweep() {
        sweep
            .check()
            .map_err(|r| Failure::input(input::text_of(&r)))?;
        said = format!("{said}; {}", sweep::counted(sweep));
    }
    say(said)
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

fn describe_world(name: &str, world: &World) -> String {
    let flowers: usize = world.patches.iter().map(Patch::count).sum();
    let flowers = format!("patches of flowers ({flowers})");
    let counts = [
        ("obstacles", world.obstacles.len()),
        ("structures", world.structures.len()),
        (flowers.as_str(), world.patches.len()),
        ("people", world.people.len()),
        ("terrain", usize::from(world.terrain.is_some())),
        ("lights", world.lights.len()),
        ("sources of gas", world.sources.len()),
        ("materials", world.materials.len()),
        ("areas to start in", world.spawns.len()),
        ("places", world.places.len()),
    ];
    let there = counts.iter().filter(|(_, count)| *count > 0);
    let there: Vec<String> = there.map(|(what, n)| format!("{n} {what}")).collect();
    match there.is_empty() {
        true => format!("{name} is a fine world: an empty plane"),
        false => format!("{name} is a fine world: {}", there.join(", ")),
    }
}

/// For a file that says more than it means: shown once, before the run.
pub(super) fn warn(text: &str) {
    if !text.is_empty() {
        remark(text.trim_end());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    #[allow(clippy::disallowed_methods, reason = "two points of wall time")]
    fn interrupts_that_come_together_are_one() {
        let first = Instant::now();
        let after = |ms| first + Duration::from_millis(ms);
        assert!(!is_another(first, first) && !is_another(first, after(499)));
        assert!(is_another(first, after(500)));
    }
}
