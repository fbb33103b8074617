//! What has been measured of a bench that is not whole, beside its table: each run as soon as it is made, and taken up
//! again by `--resume`.

use super::alone::Run;
use super::arguments::{Clock, Common};
use super::machine::Machine;
use super::measure::{Experiment, Row};
use super::{Failure, remark};
use crate::program::journal::{self, Journal};
use serde::{Deserialize, Serialize};

/// What the file is, in its first line.
const WHAT: &str = "runs of a bench of simbeeotic";

/// What runs hang on: those of another are not taken up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    what: String,
    figure: String,
    version: String,
    /// The hash of the program's own file.
    program: String,
    machine: String,
    /// What is run.
    setup: Vec<(String, String)>,
}

impl Head {
    fn of(experiment: &impl Experiment, machine: &Machine) -> Self {
        let setup = experiment.setup().into_iter();
        // Probes end by the clock that judges them.
        let clock = match experiment.common().clock {
            Clock::Wall => "wall",
            Clock::Processor => "processor",
        };
        let setup = setup.chain([("clock", clock.to_owned())]);
        Self {
            what: WHAT.to_owned(),
            figure: experiment.name().to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            program: journal::program(),
            machine: machine.line(),
            setup: setup.map(|(key, value)| (key.to_owned(), value)).collect(),
        }
    }

    /// What is another now; `None` if nothing is.
    fn changed(&self, now: &Self) -> Option<String> {
        let was = |what: &str, was: &str, is: &str| format!("{what} was {was}, and is {is}");
        if self.figure != now.figure {
            return Some(was("the figure", &self.figure, &now.figure));
        }
        if self.version != now.version {
            return Some(was("the program's version", &self.version, &now.version));
        }
        if self.program != now.program {
            return Some("the program was built anew".to_owned());
        }
        if self.machine != now.machine {
            return Some(was("the machine", &self.machine, &now.machine));
        }
        let pairs = self.setup.iter().zip(&now.setup);
        let mut others = pairs.filter(|(was, is)| was != is);
        let ((key, old), (_, new)) = others.next()?;
        Some(was(&format!("--{key}"), old, new))
    }
}

/// A run, and what it was made for.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Line {
    /// Its curve, in words: curves may be more when it is taken up.
    line: String,
    size: u32,
    /// Whether it was made to find the limit, and not for a row of the table.
    probe: bool,
    run: Run,
}

/// Runs that are there already: of rows and of probes, each with its curve and its size.
#[derive(Default)]
pub(super) struct Before {
    pub(super) rows: Vec<(usize, u32, Run)>,
    pub(super) probes: Vec<(usize, u32, Run)>,
}

/// The file, and the curves of those who write it.
pub(super) struct Unfinished {
    /// `None` if no files are wanted, and so nothing stays.
    journal: Option<Journal>,
    lines: Vec<String>,
}

impl Unfinished {
    /// Looks for runs beside the table: with `--resume` they are the second value.
    ///
    /// # Errors
    /// There are runs, and no option says what becomes of them; they hang on something else.
    pub(super) fn open(experiment: &impl Experiment) -> Result<(Self, Before), Failure> {
        let common = experiment.common();
        let mut this = Self {
            journal: None,
            lines: experiment.lines(),
        };
        if common.no_files {
            return Ok((this, Before::default()));
        }
        let table = table(common, experiment.name());
        let head = Head::of(experiment, &Machine::this());
        let mut journal = Journal::new(&table, "bench", &head);
        let path = journal.path().display().to_string();
        let found = journal.read::<Head, Line>(|head| head.what == WHAT)?;
        let mut before = Before::default();
        match found.filter(|(_, lines)| !lines.is_empty()) {
            None if common.resume && !common.json => {
                remark("there is nothing to go on with, so all runs are made now");
            }
            Some((was, lines)) if !common.restart => {
                if !common.resume {
                    return Err(Failure::input(format!(
                        "{path} has {} of a bench that is not whole: --resume goes on with it, --restart begins \
                         again",
                        runs_said(lines.len()),
                    )));
                }
                if let Some(what) = was.changed(&head) {
                    return Err(Failure::input(format!(
                        "--resume: {what}, so the {} in {path} do not belong to these: --restart makes them again",
                        runs_said(lines.len()),
                    )));
                }
                before = this.before(&path, lines.clone())?;
                journal
                    .rewrite(&lines)
                    .map_err(|e| Failure::input(format!("{path}: {e}")))?;
                if !common.json {
                    let done = before.rows.len() + before.probes.len();
                    remark(format!("{} are there already", runs_said(done)));
                }
            }
            _ => {}
        }
        this.journal = Some(journal);
        Ok((this, before))
    }

    /// None, for tests.
    #[cfg(test)]
    pub(super) fn none() -> Self {
        Self {
            journal: None,
            lines: Vec::new(),
        }
    }

    fn before(&self, path: &str, lines: Vec<Line>) -> Result<Before, Failure> {
        let mut before = Before::default();
        for Line {
            line,
            size,
            probe,
            run,
        } in lines
        {
            let Some(at) = self.lines.iter().position(|name| *name == line) else {
                return Err(Failure::input(format!(
                    "--resume: {path} has runs of `{line}`, which this command does not ask for: ask for it, too, \
                     or begin again with --restart"
                )));
            };
            let of_kind = match probe {
                true => &mut before.probes,
                false => &mut before.rows,
            };
            of_kind.push((at, size, run.again()));
        }
        Ok(before)
    }

    /// Adds a run.
    pub(super) fn add(&mut self, line: usize, size: u32, probe: bool, run: &Run) {
        let line = Line {
            line: self.lines[line].clone(),
            size,
            probe,
            run: run.clone(),
        };
        if let Some(journal) = &mut self.journal {
            journal.add(&line);
        }
    }

    /// The table is whole: the file goes.
    pub(super) fn finish(self) {
        if let Some(journal) = self.journal {
            journal.finish();
        }
    }

    /// Whether there are runs in it to go on with.
    pub(super) fn is_kept(&self) -> bool {
        self.journal.as_ref().is_some_and(Journal::is_kept)
    }
}

/// The table that all of it comes to.
pub(super) fn table(common: &Common, figure: &str) -> std::path::PathBuf {
    common.folder(figure).join(format!("{figure}.csv"))
}

/// So many runs.
pub(super) fn runs_said(count: usize) -> String {
    match count {
        1 => "1 run".to_owned(),
        count => format!("{count} runs"),
    }
}

/// How many runs some rows have.
pub(super) fn runs_of(rows: &[Row]) -> usize {
    rows.iter().map(|row| row.runs.len()).sum()
}

#[cfg(test)]
mod tests {
    use super::super::workload::tests::cost;
    use super::*;

    fn head() -> Head {
        Head {
            what: WHAT.to_owned(),
            figure: "fig7".to_owned(),
            version: "0.1.0".to_owned(),
            program: "00".to_owned(),
            machine: "2 cores of X".to_owned(),
            setup: vec![("duration".to_owned(), "5 s".to_owned())],
        }
    }

    #[test]
    fn what_has_changed_is_said() {
        assert_eq!(head().changed(&head()), None);
        for (change, said) in [
            (
                (|now| now.version = "0.2.0".to_owned()) as fn(&mut Head),
                "the program's version was 0.1.0, and is 0.2.0",
            ),
            (
                |now| now.program = "01".to_owned(),
                "the program was built anew",
            ),
            (
                |now| now.machine = "4 cores of Y".to_owned(),
                "the machine was 2 cores of X, and is 4 cores of Y",
            ),
            (
                |now| now.setup[0].1 = "100 s".to_owned(),
                "--duration was 5 s, and is 100 s",
            ),
        ] {
            let mut now = head();
            change(&mut now);
            assert_eq!(head().changed(&now).as_deref(), Some(said));
        }
    }

    #[test]
    fn runs_come_back_by_the_names_of_their_curves() {
        let with = |lines: &[&str]| Unfinished {
            journal: None,
            lines: lines.iter().map(|name| (*name).to_owned()).collect(),
        };
        let lines: Vec<Line> = [("1 thread", 5, false), ("2 threads", 9, true)]
            .map(|(line, size, probe)| Line {
                line: line.to_owned(),
                size,
                probe,
                run: Run::of(cost(1.0, "a")),
            })
            .to_vec();
        let more = with(&["4 threads", "2 threads", "1 thread"]);
        let Ok(before) = more.before("x", lines.clone()) else {
            panic!("all curves are there")
        };
        let of =
            |runs: &[(usize, u32, Run)]| runs.iter().map(|run| (run.0, run.1)).collect::<Vec<_>>();
        assert_eq!(
            (of(&before.rows), of(&before.probes)),
            (vec![(2, 5)], vec![(1, 9)])
        );
        let failure = with(&["1 thread"]).before("x", lines).err();
        let message = failure.expect("a curve is missing").message;
        assert!(message.contains("`2 threads`"), "{message}");
    }
}
