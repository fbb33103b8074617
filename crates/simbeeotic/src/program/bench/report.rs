//! What is told of an experiment, besides its table: its limits, its files, all of it as JSON.

use super::alone::Case;
use super::figure::{self, Axes, Figure};
use super::files::{Facts, Files};
use super::limit::Limit;
use super::machine::Machine;
use super::measure::{Experiment, Measured, Row};
use super::paper::{self, Paper};
use super::unfinished::{runs_of, runs_said};
use super::{Failure, remark, say};
use serde::Serialize;
use std::path::PathBuf;

/// What is to be said of an experiment, whatever it is.
pub(super) struct Report<'a> {
    /// `fig7`.
    pub(super) name: &'static str,
    pub(super) title: &'a str,
    /// What was run, short.
    pub(super) setup: String,
    /// What is on the x axis.
    pub(super) x: &'a str,
    /// Whether all curves show where their time goes, or only the first one.
    pub(super) all_shares: bool,
    pub(super) paper: Paper,
    pub(super) facts: &'a dyn Fn(Case) -> Facts,
    /// Sets the number that is searched in the facts of a limit.
    pub(super) searched: fn(&mut Facts, Option<u32>),
}

/// The answer as JSON.
#[derive(Serialize)]
struct Answer<'a, R> {
    figure: &'a str,
    machine: &'a Machine,
    rows: Vec<Told<'a, R>>,
    limits: Vec<Line<'a>>,
    paper: Theirs<'a>,
    files: Vec<PathBuf>,
}

/// A row, and the wall time of each of its runs.
#[derive(Serialize)]
struct Told<'a, R> {
    #[serde(flatten)]
    row: &'a R,
    repeats: usize,
    /// Median of time over virtual time, by the clock that was asked for.
    ratio: f64,
    wall_s_of_runs: Vec<f64>,
}

#[derive(Serialize)]
struct Line<'a> {
    line: &'a str,
    #[serde(flatten)]
    limit: &'a Limit,
}

#[derive(Serialize)]
struct Theirs<'a> {
    limit: Option<u32>,
    says: &'a str,
    source: &'a str,
}

impl Report<'_> {
    /// Writes files; prints rows and limits as JSON, if that is wanted, or else the limits. Of an experiment that was
    /// broken off, what there is.
    ///
    /// # Errors
    /// Files cannot be written; why it was broken off.
    pub(super) fn finish<R: Serialize>(
        &self,
        experiment: &impl Experiment,
        measured: Measured,
        rows: &[R],
    ) -> Result<(), Failure> {
        let common = experiment.common();
        let machine = Machine::this();
        let lines = experiment.lines();
        if !common.json {
            for (limit, line) in measured.limits.iter().zip(&lines) {
                say(format!("limit: {}", figure::said(limit, line, lines.len())))?;
            }
            remark(format!(
                "the paper ({}): {}",
                paper::SOURCE,
                self.paper.says
            ));
        }
        let files = match common.no_files {
            true => Vec::new(),
            false => self.write(experiment, &measured, &machine)?,
        };
        if common.json {
            let told = |(row, of): (_, &Row)| Told {
                row,
                repeats: of.runs.len(),
                ratio: of.ratio(common.clock),
                wall_s_of_runs: of.runs.iter().map(|run| run.cost.wall_s).collect(),
            };
            let limits = measured.limits.iter().zip(&lines);
            let answer = Answer {
                figure: self.name,
                machine: &machine,
                rows: rows.iter().zip(&measured.rows).map(told).collect(),
                limits: limits.map(|(limit, line)| Line { line, limit }).collect(),
                paper: Theirs {
                    limit: self.paper.limit,
                    says: self.paper.says,
                    source: paper::SOURCE,
                },
                files,
            };
            say(serde_json::to_string_pretty(&answer).map_err(Failure::run)?)?;
        }
        let done = runs_said(runs_of(&measured.rows) + runs_of(&measured.probes));
        let go_on = match measured.unfinished.is_kept() {
            true => "; the same command with --resume goes on",
            false => "",
        };
        match measured.broken {
            None => {
                measured.unfinished.finish();
                Ok(())
            }
            Some(failure) if failure.is_interrupt() => {
                remark(format!("interrupted after {done}{go_on}"));
                Err(failure)
            }
            Some(failure) => Err(Failure {
                message: format!("{} (after {done}{go_on})", failure.message.trim_end()),
                ..failure
            }),
        }
    }

    /// Writes the table of what there is so far; that it cannot be written is said at the end.
    pub(super) fn so_far(&self, experiment: &impl Experiment, rows: &[Row], probes: &[Row]) {
        if experiment.common().no_files {
            return;
        }
        let machine = Machine::this();
        let files = self.files(experiment, [rows, probes], &[], &machine);
        let _ = files.write_csv(&experiment.common().folder(self.name));
    }

    fn files<'a>(
        &'a self,
        experiment: &impl Experiment,
        [rows, probes]: [&'a [Row]; 2],
        limits: &'a [Limit],
        machine: &'a Machine,
    ) -> Files<'a> {
        Files {
            figure: self.name,
            paper: self.paper,
            rows,
            probes,
            limits,
            machine,
            facts: self.facts,
            searched: self.searched,
            clock: experiment.common().clock,
            duration_s: experiment.duration_s(),
        }
    }

    fn write(
        &self,
        experiment: &impl Experiment,
        measured: &Measured,
        machine: &Machine,
    ) -> Result<Vec<PathBuf>, Failure> {
        let figure = Figure {
            title: self.title,
            setup: self.setup.clone(),
            x: self.x,
            lines: experiment.lines(),
            all_shares: self.all_shares,
            paper: self.paper,
            measured,
            machine,
            duration_s: experiment.duration_s(),
            clock: experiment.common().clock,
        };
        let parts = [&measured.rows[..], &measured.probes];
        let files = self.files(experiment, parts, &measured.limits, machine);
        files.write(
            &experiment.common().folder(self.name),
            [&figure.draw(Axes::Even), &figure.draw(Axes::Log)],
        )
    }
}
