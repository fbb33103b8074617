//! A scenario file, run again and again with other values: what tests and small programs ask.

use crate::library::{Error, Run, finish, simulation};
use rayon::prelude::*;
use simbeeotic_model::Simulation;
use simbeeotic_scenario::{Request, load_file};
use std::fmt::Display;
use std::ops::Range;
use std::path::PathBuf;

/// A scenario file, and what is changed in it for this run.
///
/// Nobody watches: the components that the scenario names (its recorder, its viewer) are left out, so
/// that no file is written.
///
/// ```no_run
/// use simbeeotic::Experiment;
///
/// let narrow = Experiment::file("scenarios/first-swarm.toml").set("model.bee.params.heading_sigma", "2 deg");
/// let runs = narrow.clone().set("run.end_time", "30 s").seeds(1..11)?;
/// assert!(runs.iter().all(|run| run.touches < 1000));
/// # Ok::<(), simbeeotic::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Experiment {
    file: PathBuf,
    request: Request,
    threads: Option<usize>,
}

impl Experiment {
    /// The scenario in a file (TOML, or the original's XML), as it stands.
    pub fn file(path: impl Into<PathBuf>) -> Self {
        Self {
            file: path.into(),
            request: Request::default(),
            threads: None,
        }
    }

    /// Changes one value: `key` is its path in the scenario (`model.bee.count`), `value` what the file
    /// would say there, as for the program's `--set`. Later changes overrule earlier ones.
    #[must_use]
    pub fn set(mut self, key: &str, value: impl Display) -> Self {
        self.request.sets.push(format!("{key}={value}"));
        self
    }

    /// Changes the master seed.
    #[must_use]
    pub fn seed(self, seed: u64) -> Self {
        self.set("run.seed", seed.cast_signed())
    }

    /// Takes another world file.
    #[must_use]
    pub fn world(mut self, path: impl Into<PathBuf>) -> Self {
        self.request.world = Some(path.into());
        self
    }

    /// Threads that run the models, 1 or more; the result is the same for any number.
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.threads = Some(threads.max(1));
        self
    }

    /// The run before its first event: to be looked at from time to time
    /// ([`run_until`](Simulation::run_until)).
    ///
    /// # Errors
    /// Faults of the scenario, and of what was set.
    pub fn simulation(&self) -> Result<Simulation, Error> {
        simulation(load_file(&self.file, &self.request), |setup| {
            setup.components.clear();
            setup.threads = self.threads.unwrap_or(setup.threads);
        })
    }

    /// Runs it to its end.
    ///
    /// # Errors
    /// Faults of the scenario, and of what was set; errors of the run.
    pub fn run(&self) -> Result<Run, Error> {
        finish(self.simulation()?)
    }

    /// Runs it once for each seed, several at a time, each on one thread. The runs are in the order of
    /// the seeds.
    ///
    /// # Errors
    /// As [`run`](Self::run): those of the first seed that has one.
    pub fn seeds(&self, seeds: Range<u64>) -> Result<Vec<Run>, Error> {
        let runs: Vec<_> = seeds
            .into_par_iter()
            .map(|seed| self.clone().seed(seed).threads(1).run())
            .collect();
        runs.into_iter().collect()
    }
}
