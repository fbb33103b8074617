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
//! | `bees`, `obstacles` | 1 | how many; at a limit the one that was searched is the limit, or the bound that is known of it |
//! | `limit_low`, `limit_high` | 1 | of a limit: largest size that kept real time, smallest that did not |
//! | `repeat` | 1 | which run of this size: 1, 2, ... |
//! | `threads` | 1 | threads that ran models |
//! | `seed` | 1 | of all random streams |
//! | `duration_s` | s | virtual time that was asked for |
//! | `start`, `phase`, `contacts`, `medium`, `reach` | | how the experiment was set up; empty: does not apply |
//! | `spacing_m`, `range_m` | m | from obstacle to obstacle; as far as a radio reaches |
//! | `virtual_s`, `wall_s`, `cpu_s`, `busiest_thread_s` | s | virtual, wall and processor time; the processor time of the busiest thread |
//! | `start_s`, `start_busiest_thread_s` | s | of them the start, which a run has once |
//! | `events_s`, `physics_s`, `radio_s`, `other_s` | s | where the rest of the wall time went |
//! | `wall_s_per_100s`, `processor_s_per_100s` | s | for 100 virtual seconds: the start once, and the rest as often as it fits |
//! | `ratio` | 1 | the first of them over 100 s: at most 1 in real time |
//! | `clock` | | what a limit is of: `wall time`, or `processor time` of the busiest thread |
//! | `events`, `touches`, `sent`, `received` | 1 | events, contacts that began, packets sent and received |
//! | `memory_bytes` | B | growth of the process's greatest memory by this run |
//! | `trace_hash` | | of the run |
//! | `load` | 1 | threads of the whole machine that wanted a processor in the minute before the run, in the mean |
//! | `cores`, `cpu`, `os`, `version` | | the machine, and the program |
//! | `command` | | what was called |
//! | `note` | | what else there is to know |
//!
//! A number that there is none of is `NaN` in Parquet and empty in CSV. A probe that could no longer keep
//! real time was cut off: its `virtual_s` is what it had reached.

use super::alone::{Case, Run};
use super::arguments::Clock;
use super::limit::Limit;
use super::machine::Machine;
use super::measure::Row;
use super::paper::{self, Paper};
use super::workload::SEED;
use super::{Failure, remark};
use crate::program::plot::sheet::Sheet;
use crate::program::plot::{self, Format};
use crate::program::table;
use simbeeotic_record::{Column, publish, write_table};
use std::io::BufWriter;
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
    pub(super) spacing_m: Option<f64>,
    pub(super) range_m: Option<f64>,
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
    duration_s: Option<f64>,
    /// Virtual and wall time, where there is no run that says them, s.
    times_s: Option<[f64; 2]>,
    machine: Option<Machine>,
    command: String,
    note: String,
}

/// The names of the files, without their endings, and what is in them.
pub(super) struct Files<'a> {
    pub(super) figure: &'static str,
    pub(super) paper: Paper,
    pub(super) rows: &'a [Row],
    pub(super) probes: &'a [Row],
    pub(super) limits: &'a [Limit],
    pub(super) machine: &'a Machine,
    pub(super) facts: &'a dyn Fn(Case) -> Facts,
    /// What is searched: sets the number in the facts of a limit.
    pub(super) searched: fn(&mut Facts, Option<u32>),
    pub(super) clock: Clock,
    /// Virtual time of each run, s.
    pub(super) duration_s: f64,
}

impl Files<'_> {
    fn entries(&self) -> Vec<Entry> {
        let entry = |source, kind| Entry {
            figure: self.figure,
            source,
            kind,
            ..Entry::default()
        };
        let ours = |kind| Entry {
            duration_s: Some(self.duration_s),
            machine: Some(self.machine.clone()),
            command: command(std::env::args()),
            ..entry("measured", kind)
        };
        let mut entries = Vec::new();
        for (kind, rows) in [("row", self.rows), ("probe", self.probes)] {
            for row in rows {
                for (at, run) in row.runs.iter().enumerate() {
                    entries.push(Entry {
                        facts: (self.facts)(row.case),
                        repeat: at + 1,
                        run: Some(run.clone()),
                        ..ours(kind)
                    });
                }
            }
        }
        for (line, limit) in self.limits.iter().enumerate() {
            let mut facts = (self.facts)(Case { line, size: 0 });
            let Limit { low, high, .. } = *limit;
            // Where there is no more than a bound, the bound: the note says that it is one.
            (self.searched)(&mut facts, limit.estimate.or(low).or(high));
            entries.push(Entry {
                facts,
                bracket: [low, high],
                clock: self.clock.name(),
                note: limit.text.clone(),
                ..ours("limit")
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
                duration_s: Some(paper::DURATION_S),
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
        let csv = self.write_csv(folder)?;
        remark(format!("wrote {}", csv.display()));
        let parquet = folder.join(format!("{}.parquet", self.figure));
        write_table(&parquet, &columns(&self.entries())).map_err(Failure::run)?;
        remark(format!("wrote {}", parquet.display()));
        let mut files = vec![csv, parquet];
        for (sheet, name) in [(even, ""), (log, "-log")] {
            for (ending, format) in [("svg", Format::Svg), ("png", Format::Png)] {
                let path = folder.join(format!("{}{name}.{ending}", self.figure));
                plot::save(sheet, &path, format)?;
                files.push(path);
            }
        }
        Ok(files)
    }

    /// Writes the table as CSV into a folder that is there; gives its name.
    pub(super) fn write_csv(&self, folder: &Path) -> Result<PathBuf, Failure> {
        let path = folder.join(format!("{}.csv", self.figure));
        let columns = columns(&self.entries());
        publish(&path, |file| table::csv(BufWriter::new(file), &columns))
            .map_err(|e| Failure::run(format!("cannot write {}: {e}", path.display())))?;
        Ok(path)
    }
}

/// A call of the program, as a shell takes it.
fn command(arguments: impl Iterator<Item = String>) -> String {
    let plain = |letter: char| letter.is_alphanumeric() || "-_=./,:".contains(letter);
    let word = |(at, word): (usize, String)| match word {
        // Where the program stands is of no use to others.
        path if at == 0 => {
            let name = Path::new(&path).file_stem().unwrap_or_default();
            name.to_string_lossy().into_owned()
        }
        word if !word.is_empty() && word.chars().all(plain) => word,
        word => format!("'{}'", word.replace('\'', "'\\''")),
    };
    let words: Vec<String> = arguments.enumerate().map(word).collect();
    words.join(" ")
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
    // Of 100 virtual seconds; the paper's have that many.
    let stretched = |e: &Entry, clock: Clock| match (&e.run, clock) {
        (Some(run), Clock::Processor) if run.cost.busiest_thread_s.is_none() => f64::NAN,
        (Some(run), clock) => clock.stretched(&run.cost),
        (None, Clock::Wall) => time(e, 1),
        (None, Clock::Processor) => f64::NAN,
    };
    let per = |clock| -> Vec<f64> { entries.iter().map(|e| stretched(e, clock)).collect() };
    let ratios = per(Clock::Wall).into_iter();
    let ours = |e: &Entry| e.run.is_some() || e.source == "measured";
    vec![
        text("figure", |e| e.figure),
        text("source", |e| e.source),
        text("kind", |e| e.kind),
        number("bees", |e| e.facts.n.map(f64::from)),
        number("obstacles", |e| e.facts.obstacles.map(f64::from)),
        number("limit_low", |e| e.bracket[0].map(f64::from)),
        number("limit_high", |e| e.bracket[1].map(f64::from)),
        number("repeat", |e| (e.repeat > 0).then_some(e.repeat as f64)),
        number("threads", |e| e.facts.threads.map(|n| n as f64)),
        Column::floats(
            "seed",
            entries
                .iter()
                .map(|e| if ours(e) { SEED as f64 } else { f64::NAN })
                .collect(),
        ),
        number("duration_s", |e| e.duration_s),
        text("start", |e| &e.facts.start),
        text("phase", |e| &e.facts.phase),
        text("contacts", |e| &e.facts.contacts),
        text("medium", |e| &e.facts.medium),
        text("reach", |e| &e.facts.reach),
        number("spacing_m", |e| e.facts.spacing_m),
        number("range_m", |e| e.facts.range_m),
        Column::floats("virtual_s", times(0)),
        Column::floats("wall_s", times(1)),
        run("cpu_s", |run| run.cost.cpu_s),
        run("busiest_thread_s", |run| run.cost.busiest_thread_s),
        run("start_s", |run| Some(run.cost.start_s)),
        run("start_busiest_thread_s", |run| run.cost.start_busiest_s),
        run("events_s", |run| Some(run.cost.events_s)),
        run("physics_s", |run| Some(run.cost.physics_s)),
        run("radio_s", |run| Some(run.cost.radio_s)),
        run("other_s", |run| Some(run.cost.other_s)),
        Column::floats("wall_s_per_100s", per(Clock::Wall)),
        Column::floats("processor_s_per_100s", per(Clock::Processor)),
        Column::floats("ratio", ratios.map(|s| s / paper::DURATION_S).collect()),
        text("clock", |e| e.clock),
        run("events", |run| Some(run.cost.events as f64)),
        run("touches", |run| Some(run.cost.touches as f64)),
        run("sent", |run| Some(run.cost.packets[0] as f64)),
        run("received", |run| Some(run.cost.packets[1] as f64)),
        run("memory_bytes", |run| run.memory_bytes),
        text("trace_hash", |e| {
            e.run.as_ref().map_or("", |run| &run.cost.trace_hash)
        }),
        run("load", |run| run.load),
        number("cores", |e| e.machine.as_ref().map(|m| m.cores as f64)),
        machine("cpu", |machine| machine.cpu.clone()),
        machine("os", |machine| machine.os.clone()),
        machine("version", |machine| machine.version.clone()),
        text("command", |e| &e.command),
        text("note", |e| &e.note),
    ]
}

#[cfg(test)]
mod tests {
    use super::command;

    #[test]
    fn a_call_is_told_as_a_shell_takes_it() {
        let words = [
            "/far/away/simbeeotic",
            "bench",
            "--n",
            "1,2",
            "--duration",
            "5 s",
            "it's",
        ];
        assert_eq!(
            command(words.into_iter().map(str::to_owned)),
            r"simbeeotic bench --n 1,2 --duration '5 s' 'it'\''s'"
        );
    }
}
