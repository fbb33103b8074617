//! A run in one call, for tests and small programs.

use simbeeotic_model::config::{Fault, Sources};
use simbeeotic_model::{Setup, SetupError, Simulation, SimulationError, Summary, Tally};
use simbeeotic_scenario::{Loaded, Rejected, Request, load_file, load_text, render};
use simbeeotic_units::{Pose, Twist};
use std::ops::Deref;
use std::path::Path;

/// Why a run did not come to its end.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The scenario is wrong; the text shows every fault at its line.
    #[error("{0}")]
    Scenario(String),
    /// The run failed.
    #[error(transparent)]
    Run(#[from] SimulationError),
}

/// A run that came to its end: its summary, and where everybody is.
pub struct Run {
    simulation: Simulation,
    summary: Summary,
}

impl Run {
    /// The pose of the body of the model at `path`, at the end.
    pub fn pose(&self, path: &str) -> Option<Pose> {
        self.simulation.pose(path)
    }

    /// The twist of the body of the model at `path`, at the end.
    pub fn twist(&self, path: &str) -> Option<Twist> {
        self.simulation.twist(path)
    }

    /// What the model at `path` has published under this name. `None` if it has not.
    pub fn metric_of(&self, path: &str, name: &str) -> Option<Tally> {
        let model = self.simulation.population().find(path)?;
        let all = self.simulation.metrics();
        let line = all.iter().find(|m| m.model == model && m.name == name)?;
        Some(line.values)
    }

    /// Everything else about the run.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }
}

/// The summary's fields and methods. A clone of the summary outlives the run, and may be shared.
impl Deref for Run {
    type Target = Summary;
    fn deref(&self) -> &Summary {
        &self.summary
    }
}

/// Runs a scenario file (TOML, or the original's XML) to its end, with the components it names.
///
/// # Errors
/// Faults of the file; errors of the run.
pub fn run_file(path: impl AsRef<Path>) -> Result<Run, Error> {
    run(load_file(path.as_ref(), &Request::default()))
}

/// Runs the text of a scenario (TOML) to its end.
///
/// # Errors
/// Faults of the text; errors of the run.
pub fn run_text(text: &str) -> Result<Run, Error> {
    run(load_text("scenario", text, &Request::default()))
}

fn run(loaded: Result<Loaded, Rejected>) -> Result<Run, Error> {
    finish(simulation(loaded, |_| ())?)
}

/// From a checked scenario to a run before its first event; `change` has the last word on its set-up.
pub(crate) fn simulation(
    loaded: Result<Loaded, Rejected>,
    change: impl FnOnce(&mut Setup),
) -> Result<Simulation, Error> {
    let loaded =
        loaded.map_err(|r| Error::Scenario(render::faults(&r.faults, &r.sources, false)))?;
    let mut setup = loaded
        .setup()
        .map_err(|faults| Error::Scenario(render::faults(&faults, loaded.sources(), false)))?;
    change(&mut setup);
    Simulation::new(setup).map_err(|e| Error::Scenario(setup_text(&loaded, e, false)))
}

/// Runs to the end.
pub(crate) fn finish(mut simulation: Simulation) -> Result<Run, Error> {
    let outcome = simulation.run();
    match outcome.error {
        Some(error) => Err(error.into()),
        None => Ok(Run {
            simulation,
            summary: outcome.summary,
        }),
    }
}

/// Why a run cannot be put together, as text: each fault at its place in the scenario.
pub(crate) fn setup_text(loaded: &Loaded, error: SetupError, colour: bool) -> String {
    let SetupError::Models(faults) = error else {
        return error.to_string();
    };
    let named = faults.into_iter().map(|(path, fault)| {
        let message = format!("{path}: {}", fault.message);
        Fault { message, ..fault }
    });
    let faults: Vec<Fault> = named.collect();
    faults_text(&faults, loaded.sources(), colour)
}

/// Faults as text that ends without an empty line.
pub(crate) fn faults_text(faults: &[Fault], sources: &Sources, colour: bool) -> String {
    render::faults(faults, sources, colour)
        .trim_end()
        .to_owned()
}
