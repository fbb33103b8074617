//! What has been done of a long work whose table is not whole: lines of JSON in a file beside the table, written
//! as they come, and taken up again by `--resume`.
//!
//! `TABLE.unfinished` begins with a line on what the others hang on, such as the program and the scenario. A line
//! that a crash cut off is none. The file goes when the table is whole.

use super::{Failure, remark};
use serde::Serialize;
use serde::de::DeserializeOwned;
use simbeeotic_scenario::sweep::hash_of;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// What the name of the table gets.
const ENDING: &str = ".unfinished";
/// Lines of no more than this time are lost if the machine stops; if only the program does, none.
const SYNCED: Duration = Duration::from_secs(1);

/// The file.
pub(super) struct Journal {
    path: PathBuf,
    /// What its lines are of: `sweep`.
    work: &'static str,
    head: String,
    /// Open once there is a line in it.
    file: Option<File>,
    synced: Instant,
    /// Whether it can be written; that it cannot is told once.
    writes: bool,
}

impl Journal {
    /// The one beside a table; nothing is written yet.
    #[allow(
        clippy::disallowed_methods,
        reason = "when the disk was last waited for"
    )]
    pub(super) fn new(table: &Path, work: &'static str, head: &impl Serialize) -> Self {
        let mut name = table.file_name().unwrap_or_default().to_os_string();
        name.push(ENDING);
        Self {
            path: table.with_file_name(name),
            work,
            head: line_of(head).unwrap_or_default(),
            file: None,
            synced: Instant::now(),
            writes: true,
        }
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// What is in the file, if there is one: its first line, and the others.
    ///
    /// # Errors
    /// It cannot be read, or its first line is none of `ours`.
    pub(super) fn read<H: DeserializeOwned, L: DeserializeOwned>(
        &self,
        ours: impl Fn(&H) -> bool,
    ) -> Result<Option<(H, Vec<L>)>, Failure> {
        let path = self.path.display();
        let bytes = match fs::read(&self.path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(e) => return Err(Failure::input(format!("{path}: {e}"))),
        };
        let found = parsed(&bytes).filter(|(head, _)| ours(head));
        found.map(Some).ok_or_else(|| {
            Failure::input(format!(
                "{path}: this file is in the way of the rows of the {}, and it is something else: remove it, or \
                 choose another --output",
                self.work
            ))
        })
    }

    /// Copies the file to a name beside it that nothing has; tells the name.
    ///
    /// # Errors
    /// It cannot be copied.
    pub(super) fn set_aside(&self) -> Result<PathBuf, Failure> {
        let mut copy = self.path.as_os_str().to_owned();
        copy.push(".old");
        let mut free = PathBuf::from(&copy);
        let mut number = 1;
        while free.exists() {
            number += 1;
            let mut name = copy.clone();
            name.push(format!("-{number}"));
            free = PathBuf::from(name);
        }
        fs::copy(&self.path, &free)
            .map_err(|e| Failure::input(format!("cannot keep {}: {e}", self.path.display())))?;
        Ok(free)
    }

    /// Writes it with these lines alone; without any, nothing is done.
    pub(super) fn rewrite(&mut self, lines: &[impl Serialize]) -> io::Result<()> {
        if lines.is_empty() {
            return Ok(());
        }
        let mut text = self.head.clone();
        for line in lines {
            text.push_str(&line_of(line)?);
        }
        simbeeotic_record::publish(&self.path, |mut file| file.write_all(text.as_bytes()))?;
        self.file = Some(File::options().append(true).open(&self.path)?);
        Ok(())
    }

    /// Adds a line. That it cannot be written is told, and no error.
    pub(super) fn add(&mut self, line: &impl Serialize) {
        if !self.writes {
            return;
        }
        if let Err(e) = self.append(line) {
            self.writes = false;
            remark(format!(
                "rows cannot be written as they come ({e}): if this {} is broken off, --resume does not know them",
                self.work
            ));
        }
    }

    #[allow(
        clippy::disallowed_methods,
        reason = "the disk is waited for once a second, not for each row"
    )]
    fn append(&mut self, line: &impl Serialize) -> io::Result<()> {
        let Some(file) = &mut self.file else {
            return self.rewrite(std::slice::from_ref(line));
        };
        // In one piece: what is cut off is a line that is none.
        file.write_all(line_of(line)?.as_bytes())?;
        let now = Instant::now();
        if now.saturating_duration_since(self.synced) > SYNCED {
            file.sync_data()?;
            self.synced = now;
        }
        Ok(())
    }

    /// The table is whole: the file goes.
    pub(super) fn finish(self) {
        let _ = fs::remove_file(&self.path);
    }

    /// Whether there are lines in it to go on with.
    pub(super) fn is_kept(&self) -> bool {
        self.file.is_some() && self.writes
    }
}

/// The hash of this program's own file: what was done by another is not gone on with.
pub(super) fn program() -> String {
    let program = std::env::current_exe().and_then(File::open);
    format!("{:016x}", program.and_then(hash_of).unwrap_or(0))
}

fn line_of(value: &impl Serialize) -> io::Result<String> {
    let mut text = serde_json::to_string(value)?;
    text.push('\n');
    Ok(text)
}

/// First line and others; one that cannot be read is none, as a crash leaves it.
fn parsed<H: DeserializeOwned, L: DeserializeOwned>(bytes: &[u8]) -> Option<(H, Vec<L>)> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.lines();
    let head = serde_json::from_str(lines.next()?).ok()?;
    let rows = lines.filter_map(|line| serde_json::from_str(line).ok());
    Some((head, rows.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_that_a_crash_cut_off_is_none_and_another_file_is_refused() {
        let mut text = line_of(&"head").expect("JSON");
        text.push_str(&line_of(&[1, 2]).expect("JSON"));
        let whole = text.len();
        text.push_str(&line_of(&[3, 4]).expect("JSON"));
        let lines = |length: usize| {
            let read = parsed::<String, [i32; 2]>(&text.as_bytes()[..length]);
            let (head, lines) = read.expect("it begins with its head");
            assert_eq!(head, "head");
            lines
        };
        assert_eq!(lines(whole), [[1, 2]]);
        assert_eq!(lines(whole + 3), [[1, 2]]);
        assert_eq!(lines(text.len()), [[1, 2], [3, 4]]);
        for other in ["", "run,seed\n", "{\"what\": 3}\n"] {
            assert!(
                parsed::<String, [i32; 2]>(other.as_bytes()).is_none(),
                "{other}"
            );
        }
    }
}
