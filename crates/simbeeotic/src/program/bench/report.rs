//! What is told of an experiment, besides its table: its limits, its files, all of it as JSON.

use super::alone::Case;
use super::arguments::Common;
use super::figure::{self, Axes, Figure};
use super::files::{Facts, Files};
use super::limit::Limit;
use super::machine::Machine;
use super::measure::{Experiment, Measured, Row};
use super::paper::{self, Paper};
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
    /// Writes the files; then prints rows and limits as JSON, if that is wanted, or else the limits.
    pub(super) fn finish<R: Serialize>(
        &self,
        experiment: &impl Experiment,
        measured: &Measured,
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
            false => self.write(experiment, measured, &machine)?,
        };
        if !common.json {
            return Ok(());
        }
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
        say(serde_json::to_string_pretty(&answer).map_err(Failure::run)?)
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
        let files = Files {
            figure: self.name,
            paper: self.paper,
            measured,
            machine,
            facts: self.facts,
            searched: self.searched,
            clock: experiment.common().clock,
        };
        files.write(
            &folder(experiment.common(), self.name),
            [&figure.draw(Axes::Even), &figure.draw(Axes::Log)],
        )
    }
}

/// Where the files go.
fn folder(common: &Common, name: &str) -> PathBuf {
    let chosen = common.output.clone();
    chosen.unwrap_or_else(|| PathBuf::from("out").join(name))
}
