//! What an experiment leaves: a table as CSV and as Parquet; a plot with the paper's axes and one with logarithmic
//! axes, each as SVG and as PNG.
//!
//! The table has one row for each run, so that nothing is lost; one for each limit; and the paper's own
//! numbers as rows of their own.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `figure` | | `fig6`, `fig7` or `fig8` |
//! | `source` | | `measured` here, or `paper` |
//! | `kind` | | `row` of the table, `probe` of the search for the limit, `limit`, or the paper's `goal` |
//! | `n`, `obstacles` | 1 | bees, and obstacles; at a limit the one that was searched is the limit |
//! | `low`, `high` | 1 | of a limit: largest size that kept real time, smallest that did not |
//! | `threads` | 1 | threads that ran models |
//! | `repeat` | 1 | which run of this size: 1, 2, ... |
//! | `start`, `phase`, `contacts`, `medium`, `reach` | | how the experiment was set up; empty: does not apply |
//! | `virtual_s`, `wall_s`, `cpu_s`, `busiest_thread_s` | s | virtual, wall and processor time; the processor time of the busiest thread |
//! | `ratio` | 1 | wall over virtual time: at most 1 in real time |
//! | `clock` | | what a limit is of: `wall time`, or `processor time` of the busiest thread |
//! | `events_s`, `physics_s`, `radio_s`, `other_s` | s | where the wall time went |
//! | `events`, `touches`, `sent`, `received` | 1 | events, contacts that began, packets sent and received |
//! | `memory_bytes` | B | growth of the process's greatest memory by this run |
//! | `trace_hash` | | of the run |
//! | `cores`, `cpu`, `os`, `version` | | the machine, and the program |
//! | `note` | | what else there is to know |
//!
//! A number that there is none of is `NaN` in Parquet and empty in CSV. A probe that could no longer keep
//! real time was cut off: its `virtual_s` is what it had reached.

use super::alone::{Case, Run};
use super::arguments::Clock;
use super::limit::Limit;
use super::machine::Machine;
use super::measure::Measured;
use super::paper::{self, Paper};
use super::{Failure, remark};
use crate::program::plot::sheet::Sheet;
use crate::program::plot::{self, Format};
use simbeeotic_record::{Column, Values, publish, write_table};
use std::fmt::Write as _;
use std::io::Write as _;
use std::path::{Path, PathBuf};

/// How a run was set up.
#[derive(Clone, Debug, Default)]
pub(super) struct Facts {
    pub(super) n: Option<u32>,
    pub(super) obstacles: Option<u32>,
    pub(super) threads: Option<usize>,
    pub(super) start: String,
    pub(super) phase: String,
    pub(super) contacts: String,
    pub(super) medium: String,
    pub(super) reach: String,
}

/// A row of the table.
#[derive(Clone, Debug, Default)]
struct Entry {
    figure: &'static str,
    source: &'static str,
    kind: &'static str,
    facts: Facts,
    bracket: [Option<u32>; 2],
    clock: &'static str,
    repeat: usize,
    run: Option<Run>,
    /// Virtual and wall time, where there is no run that says them, s.
    times_s: Option<[f64; 2]>,
    machine: Option<Machine>,
    note: String,
}

/// The names of the files, without their endings, and what is in them.
pub(super) struct Files<'a> {
    pub(super) figure: &'static str,
    pub(super) paper: Paper,
    pub(super) measured: &'a Measured,
    pub(super) machine: &'a Machine,
    pub(super) facts: &'a dyn Fn(Case) -> Facts,
    /// What is searched: sets the number in the facts of a limit.
    pub(super) searched: fn(&mut Facts, Option<u32>),
    pub(super) clock: Clock,
}

impl Files<'_> {
    fn entries(&self) -> Vec<Entry> {
        let entry = |source, kind| Entry {
            figure: self.figure,
            source,
            kind,
            ..Entry::default()
        };
        let mut entries = Vec::new();
        for (kind, rows) in [
            ("row", &self.measured.rows),
            ("probe", &self.measured.probes),
        ] {
            for row in rows {
                for (at, run) in row.runs.iter().enumerate() {
                    entries.push(Entry {
                        facts: (self.facts)(row.case),
                        repeat: at + 1,
                        run: Some(run.clone()),
                        machine: Some(self.machine.clone()),
                        ..entry("measured", kind)
                    });
                }
            }
        }
        for (line, limit) in self.measured.limits.iter().enumerate() {
            let mut facts = (self.facts)(Case { line, size: 0 });
            let Limit { low, high, .. } = *limit;
            (self.searched)(&mut facts, limit.estimate);
            entries.push(Entry {
                facts,
                bracket: [low, high],
                clock: self.clock.name(),
                machine: Some(self.machine.clone()),
                note: limit.text.clone(),
                ..entry("measured", "limit")
            });
        }
        let theirs = |kind, size: Option<u32>, times_s, note: &str| {
            let mut facts = Facts::default();
            (self.searched)(&mut facts, size);
            if self.figure == "fig6" {
                facts.n = Some(super::fig6::BEES);
            }
            Entry {
                facts,
                times_s,
                machine: Some(Machine {
                    cores: 4,
                    cpu: paper::CPU.to_owned(),
                    os: String::new(),
                    version: paper::VERSION.to_owned(),
                }),
                note: format!("{note} ({})", paper::SOURCE),
                ..entry("paper", kind)
            }
        };
        let Paper { limit, goal, says } = self.paper;
        let kind = if limit.is_some() { "limit" } else { "row" };
        // At the limit the two are equal, by what soft real time is.
        let times_s = limit.map(|_| [paper::DURATION_S; 2]);
        entries.push(theirs(kind, limit, times_s, says));
        entries.extend(goal.map(|goal| {
            let note = "its goal: so many in soft real time or better";
            theirs("goal", Some(goal), None, note)
        }));
        entries
    }

    /// Writes them into a folder, which is made if need be; gives their names.
    /// `even` and `log` are the two plots.
    pub(super) fn write(
        &self,
        folder: &Path,
        [even, log]: [&Sheet; 2],
    ) -> Result<Vec<PathBuf>, Failure> {
        std::fs::create_dir_all(folder)
            .map_err(|e| Failure::run(format!("cannot make {}: {e}", folder.display())))?;
        let path = |ending: &str| folder.join(format!("{}.{ending}", self.figure));
        let columns = columns(&self.entries());

        let table = path("csv");
        let text = csv(&columns);
        publish(&table, |mut file| file.write_all(text.as_bytes()))
            .map_err(|e| Failure::run(format!("cannot write {}: {e}", table.display())))?;
        remark(format!("wrote {}", table.display()));
        let parquet = path("parquet");
        write_table(&parquet, &columns).map_err(Failure::run)?;
        remark(format!("wrote {}", parquet.display()));
        let mut files = vec![table, parquet];
        for (sheet, name) in [(even, ""), (log, "-log")] {
            for (ending, format) in [("svg", Format::Svg), ("png", Format::Png)] {
                let path = folder.join(format!("{}{name}.{ending}", self.figure));
                plot::save(sheet, &path, format)?;
                files.push(path);
            }
        }
        Ok(files)
    }
}

fn columns(entries: &[Entry]) -> Vec<Column> {
    type Number = fn(&Run) -> Option<f64>;
    let text = |name: &str, of: fn(&Entry) -> &str| {
        Column::texts(name, entries.iter().map(|e| of(e).to_owned()).collect())
    };
    let number = |name: &str, of: fn(&Entry) -> Option<f64>| {
        let values = entries.iter().map(|e| of(e).unwrap_or(f64::NAN));
        Column::floats(name, values.collect())
    };
    let run = |name: &str, of: Number| {
        let value = |e: &Entry| e.run.as_ref().and_then(of).unwrap_or(f64::NAN);
        Column::floats(name, entries.iter().map(value).collect())
    };
    let machine = |name: &str, of: fn(&Machine) -> String| {
        let value = |e: &Entry| e.machine.as_ref().map(of).unwrap_or_default();
        Column::texts(name, entries.iter().map(value).collect())
    };
    let time = |e: &Entry, at: usize| match (&e.run, e.times_s) {
        (Some(run), _) => [run.cost.virtual_s, run.cost.wall_s][at],
        (None, Some(times_s)) => times_s[at],
        (None, None) => f64::NAN,
    };
    let times = |at| -> Vec<f64> { entries.iter().map(|e| time(e, at)).collect() };
    let ratios = entries.iter().map(|e| time(e, 1) / time(e, 0)).collect();
    vec![
        text("figure", |e| e.figure),
        text("source", |e| e.source),
        text("kind", |e| e.kind),
        number("n", |e| e.facts.n.map(f64::from)),
        number("obstacles", |e| e.facts.obstacles.map(f64::from)),
        number("low", |e| e.bracket[0].map(f64::from)),
        number("high", |e| e.bracket[1].map(f64::from)),
        number("threads", |e| e.facts.threads.map(|n| n as f64)),
        number("repeat", |e| (e.repeat > 0).then_some(e.repeat as f64)),
        text("start", |e| &e.facts.start),
        text("phase", |e| &e.facts.phase),
        text("contacts", |e| &e.facts.contacts),
        text("medium", |e| &e.facts.medium),
        text("reach", |e| &e.facts.reach),
        Column::floats("virtual_s", times(0)),
        Column::floats("wall_s", times(1)),
        run("cpu_s", |run| run.cost.cpu_s),
        run("busiest_thread_s", |run| run.cost.busiest_thread_s),
        Column::floats("ratio", ratios),
        text("clock", |e| e.clock),
        run("events_s", |run| Some(run.cost.events_s)),
        run("physics_s", |run| Some(run.cost.physics_s)),
        run("radio_s", |run| Some(run.cost.radio_s)),
        run("other_s", |run| Some(run.cost.other_s)),
        run("events", |run| Some(run.cost.events as f64)),
        run("touches", |run| Some(run.cost.touches as f64)),
        run("sent", |run| Some(run.cost.packets[0] as f64)),
        run("received", |run| Some(run.cost.packets[1] as f64)),
        run("memory_bytes", |run| run.memory_bytes),
        text("trace_hash", |e| {
            e.run.as_ref().map_or("", |run| &run.cost.trace_hash)
        }),
        number("cores", |e| e.machine.as_ref().map(|m| m.cores as f64)),
        machine("cpu", |machine| machine.cpu.clone()),
        machine("os", |machine| machine.os.clone()),
        machine("version", |machine| machine.version.clone()),
        text("note", |e| &e.note),
    ]
}

/// Columns as CSV (RFC 4180).
fn csv(columns: &[Column]) -> String {
    let names: Vec<&str> = columns.iter().map(|column| column.name.as_str()).collect();
    let mut text = names.join(",");
    text.push('\n');
    let rows = columns.first().map_or(0, |column| match &column.values {
        Values::Text(values) => values.len(),
        _ => 0,
    });
    for row in 0..rows {
        for (at, column) in columns.iter().enumerate() {
            if at > 0 {
                text.push(',');
            }
            match &column.values {
                Values::Float(values) if values[row].is_nan() => {}
                Values::Float(values) => {
                    let _ = write!(text, "{}", values[row]);
                }
                Values::Text(values) => text.push_str(&quoted(&values[row])),
                // There are no others.
                _ => {}
            }
        }
        text.push('\n');
    }
    text
}

fn quoted(field: &str) -> String {
    match field.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", field.replace('"', "\"\"")),
        false => field.to_owned(),
    }
}
