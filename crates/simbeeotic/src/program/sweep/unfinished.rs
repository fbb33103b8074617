//! The rows of a sweep that is not at its end, beside its table: written as they come, and taken up again by
//! `--resume`.
//!
//! `TABLE.unfinished` has lines of JSON: first what the rows hang on (the program, the scenario, the files that it
//! names), then a row for each run that came to its end, in the order in which they did. Numbers are text, as in
//! the table, so that they come back to the last bit. With `--record` a row says which file holds its run: what
//! is called so may be of another run, if there are more seeds or values now. A line that a crash cut off is no
//! row. The file goes when the table is whole, and stays while runs of it have failed.

use super::rows::Row;
use super::{SweepOptions, recording};
use crate::program::journal::{self, Journal};
use crate::program::{Failure, remark};
use serde::{Deserialize, Serialize};
use simbeeotic_scenario::Sweep;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// What the file is, in its first line.
const WHAT: &str = "rows of a sweep of simbeeotic";

/// What rows hang on: those of another are not taken up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Head {
    what: String,
    version: String,
    /// The hash of the program's own file.
    program: String,
    /// Scenario and files, each with its hash.
    made_of: Vec<(String, String)>,
    /// What varies.
    keys: Vec<String>,
}

impl Head {
    fn of(sweep: &Sweep) -> Self {
        let made_of = sweep.made_of().into_iter();
        Self {
            what: WHAT.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            program: journal::program(),
            made_of: made_of
                .map(|(name, hash)| (name, format!("{hash:016x}")))
                .collect(),
            keys: sweep.keys().map(str::to_owned).collect(),
        }
    }

    /// What is another now; `None` if nothing is.
    fn changed(&self, now: &Self) -> Option<String> {
        if self.version != now.version {
            return Some(format!(
                "the program was of version {}, and is of {}",
                self.version, now.version
            ));
        }
        if self.program != now.program {
            return Some("the program was built anew".to_owned());
        }
        if self.keys != now.keys {
            let keys = |head: &Self| match head.keys.as_slice() {
                [] => "nothing but the seed".to_owned(),
                keys => keys.join(", "),
            };
            return Some(format!(
                "what varied was {}, and is {}",
                keys(self),
                keys(now)
            ));
        }
        let other = |(name, hash): &&(String, String)| {
            let was = self.made_of.iter().find(|(known, _)| known == name);
            was.is_none_or(|(_, was)| was != hash)
        };
        let new = now.made_of.iter().find(other);
        let gone = || {
            let is_there = |name: &String| now.made_of.iter().any(|(known, _)| known == name);
            self.made_of.iter().find(|(name, _)| !is_there(name))
        };
        let (name, _) = new.or_else(gone)?;
        Some(format!("{name} has changed"))
    }
}

/// A row, and the run that it is of.
#[derive(Serialize, Deserialize)]
struct Line {
    run: String,
    seed: i64,
    trace_hash: String,
    ended: String,
    numbers: Vec<(String, String)>,
    recorded: Option<Recorded>,
}

/// The file that a run was recorded to, as it was when the run was done.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Recorded {
    /// From the root of the file system on.
    path: PathBuf,
    /// Its length.
    bytes: u64,
}

impl Recorded {
    /// The recording of a run in a folder, if it is there.
    fn of(folder: &Path, run: usize) -> Option<Self> {
        let path = recording(folder, run).canonicalize().ok()?;
        let there = fs::metadata(&path).ok().filter(fs::Metadata::is_file)?;
        let bytes = there.len();
        // A path that is no text cannot stand in JSON.
        path.to_str()?;
        Some(Self { path, bytes })
    }
}

/// The file, and what is in it.
pub(super) struct Unfinished {
    /// `None` if the table is no file, and so nothing stays of it.
    journal: Option<Journal>,
    /// Where runs are recorded, if they are.
    record: Option<PathBuf>,
}

impl Unfinished {
    /// Looks for rows beside the table: with `--resume` they are the second value, by their runs.
    ///
    /// # Errors
    /// There are rows, and no option says what becomes of them; they hang on something else.
    pub(super) fn open(
        sweep: &Sweep,
        table: &Path,
        options: &SweepOptions,
    ) -> Result<(Self, Vec<Row>), Failure> {
        let no_file = fs::metadata(table).is_ok_and(|there| !there.is_file());
        let head = Head::of(sweep);
        let mut this = Self {
            journal: (!no_file).then(|| Journal::new(table, "sweep", &head)),
            record: options.record.clone(),
        };
        let Some(journal) = &this.journal else {
            return Ok((this, Vec::new()));
        };
        let path = journal.path().display().to_string();
        let Some((was, lines)) = journal.read::<Head, Line>(|head| head.what == WHAT)? else {
            if options.resume && !options.quiet {
                remark("there is nothing to go on with, so all runs are flown now");
            }
            return Ok((this, Vec::new()));
        };
        if options.restart || lines.is_empty() {
            return Ok((this, Vec::new()));
        }
        if !options.resume {
            return Err(Failure::input(format!(
                "{path} has {} of a sweep that is not whole: --resume goes on with it, --restart begins again",
                super::runs_said(lines.len()),
            )));
        }
        if let Some(what) = was.changed(&head) {
            return Err(Failure::input(format!(
                "--resume: {what}, so the {} in {path} may be others now: --restart flies them again",
                super::runs_said(lines.len()),
            )));
        }
        let rows = this.rows(sweep, &lines);
        if rows.len() < lines.len() {
            // A seed that was forgotten must not cost the work of days.
            let aside = journal.set_aside()?.display().to_string();
            let rest = super::runs_said(lines.len() - rows.len());
            let why = match &options.record {
                Some(_) => {
                    "of no run of this sweep, or its recording is not there under its number"
                }
                None => "of no run of this sweep",
            };
            if !options.quiet {
                remark(format!(
                    "{rest} in {path} left out: {why}; the file is kept as {aside}"
                ));
            }
        }
        let kept: Vec<Line> = rows.iter().map(|row| this.kept(sweep, row)).collect();
        if let Some(journal) = &mut this.journal {
            journal
                .rewrite(&kept)
                .map_err(|e| Failure::input(format!("{path}: {e}")))?;
        }
        Ok((this, rows))
    }

    /// The rows that are of runs of this sweep, in their order.
    fn rows(&self, sweep: &Sweep, lines: &[Line]) -> Vec<Row> {
        let runs: BTreeMap<String, usize> =
            (0..sweep.len()).map(|run| (sweep.told(run), run)).collect();
        let mut rows = BTreeMap::new();
        for line in lines {
            let Some(run) = runs.get(&line.run) else {
                continue;
            };
            if let Some(folder) = &self.record {
                let there = Recorded::of(folder, *run);
                if there.is_none() || there != line.recorded {
                    continue;
                }
            }
            let numbers = line.numbers.iter();
            let numbers = numbers.map(|(name, text)| Some((name.clone(), text.parse().ok()?)));
            let Some(numbers) = numbers.collect::<Option<Vec<_>>>() else {
                continue;
            };
            let row = Row::again(*run, line.seed, &line.trace_hash, &line.ended, numbers);
            rows.insert(*run, row);
        }
        rows.into_values().collect()
    }

    fn kept(&self, sweep: &Sweep, row: &Row) -> Line {
        let numbers = row.numbers();
        let folder = self.record.as_deref();
        Line {
            run: sweep.told(row.run),
            seed: row.seed,
            trace_hash: row.trace_hash.clone(),
            ended: row.ended.clone(),
            numbers: numbers
                .map(|(name, value)| (name.to_owned(), value.to_string()))
                .collect(),
            recorded: folder.and_then(|folder| Recorded::of(folder, row.run)),
        }
    }

    /// Adds a run that came to its end.
    pub(super) fn add(&mut self, sweep: &Sweep, row: &Row) {
        let line = self.kept(sweep, row);
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

    /// Whether there are rows in it to go on with.
    pub(super) fn is_kept(&self) -> bool {
        self.journal.as_ref().is_some_and(Journal::is_kept)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn head() -> Head {
        Head {
            what: WHAT.to_owned(),
            version: "0.1.0".to_owned(),
            program: "00".to_owned(),
            made_of: [("the scenario", "0a"), ("w.toml", "0b")]
                .map(|(name, hash)| (name.to_owned(), hash.to_owned()))
                .to_vec(),
            keys: vec!["model.bee.count".to_owned()],
        }
    }

    #[test]
    fn what_has_changed_is_said() {
        assert_eq!(head().changed(&head()), None);
        let said = |change: fn(&mut Head)| {
            let mut now = head();
            change(&mut now);
            head().changed(&now).expect("it has changed")
        };
        assert!(said(|now| now.version = "0.2.0".to_owned()).contains("and is of 0.2.0"));
        assert!(said(|now| now.program = "01".to_owned()).contains("built anew"));
        assert!(said(|now| now.keys.clear()).contains("and is nothing but the seed"));
        assert_eq!(
            said(|now| now.made_of[0].1 = "0c".to_owned()),
            "the scenario has changed"
        );
        for change in [
            (|now| now.made_of[1].1 = "0c".to_owned()) as fn(&mut Head),
            |now| now.made_of.truncate(1),
        ] {
            assert_eq!(said(change), "w.toml has changed");
        }
        assert_eq!(
            said(|now| now.made_of.push(("m.stl".to_owned(), "01".to_owned()))),
            "m.stl has changed"
        );
    }
}
