//! The files that a run writes: none of them may be one that it reads, or another that it writes.

use super::arguments::{RunOptions, ScenarioOptions};
use super::table::{Format, TableFile};
use super::{Failure, same_file};
use simbeeotic_scenario::Loaded;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// The recorder's name on the shelf.
pub(super) const RECORDER: &str = "recorder";

/// What an MCAP file begins with.
const MCAP: &[u8] = b"\x89MCAP0\r\n";
/// What a summary as CSV begins with.
const CSV: &[u8] = b"run,seed,scenario,trace_hash,";
/// What a table of runs as CSV begins with, and columns that it has.
const RUNS: &[u8] = b"run,seed,";
const RUNS_COLUMNS: &[u8] = b",trace_hash,ended,error,";
/// A name that stands in every summary as Parquet or JSON.
const COLUMN: &[u8] = b"trace_hash";
/// So many bytes of a file's beginning or end are looked at.
const LOOKED_AT: usize = 65_536;

/// Looks at all files of a run before it begins: what is lost then is lost.
pub(super) fn check(loaded: &Loaded, options: &RunOptions) -> Result<(), Failure> {
    let recordings = recordings(loaded, options);
    for (flag, path) in &recordings {
        refuse_input(flag, path, &options.scenario)?;
        if !replaceable(path, |bytes| bytes.starts_with(MCAP)) {
            return Err(refused(flag, path, "no recording"));
        }
    }
    let Some(path) = &options.summary else {
        return Ok(());
    };
    refuse_input("--summary", path, &options.scenario)?;
    if recordings.iter().any(|(_, other)| same_target(path, other)) {
        return Err(Failure::input(format!(
            "--summary {}: the recording of the run goes into this file",
            path.display()
        )));
    }
    let ending = path.extension().and_then(|ending| ending.to_str());
    let ours = |bytes: &[u8]| match ending {
        Some("csv") => bytes.starts_with(CSV),
        Some("json") => bytes.starts_with(b"[") && holds(bytes, COLUMN),
        _ => bytes.starts_with(b"PAR1") && holds(bytes, COLUMN),
    };
    match replaceable(path, ours) {
        true => Ok(()),
        false => Err(refused("--summary", path, "no summary of a run")),
    }
}

/// Looks at all files of a sweep before it begins.
pub(super) fn check_runs(
    scenario: &ScenarioOptions,
    table: &TableFile,
    record: Option<&Path>,
    runs: usize,
) -> Result<(), Failure> {
    let ours = |bytes: &[u8]| match table.format {
        Format::Csv => bytes.starts_with(RUNS) && holds(bytes, RUNS_COLUMNS),
        Format::Json => bytes.starts_with(b"[") && holds(bytes, COLUMN),
        Format::Parquet => bytes.starts_with(b"PAR1") && holds(bytes, COLUMN),
    };
    refuse_input("--output", &table.path, scenario)?;
    if !replaceable(&table.path, ours) {
        return Err(refused("--output", &table.path, "no table of runs"));
    }
    table.probe()?;
    let Some(folder) = record else { return Ok(()) };
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::input(format!(
            "--record {}: this is a file, and a folder is wanted",
            folder.display()
        )));
    }
    for run in 0..runs {
        let path = super::sweep::recording(folder, run);
        if !replaceable(&path, |bytes| bytes.starts_with(MCAP)) {
            return Err(refused("--record", &path, "no recording"));
        }
    }
    // Whoever draws all recordings of the folder would draw those of two sweeps.
    match super::sweep::beyond(folder, runs) {
        Some(path) => Err(Failure::input(format!(
            "--record {}: {} is of a longer sweep: remove what is in this folder, or choose another",
            folder.display(),
            path.display()
        ))),
        None => Ok(()),
    }
}

/// The files that are recorded into, and who says so.
fn recordings(loaded: &Loaded, options: &RunOptions) -> Vec<(&'static str, PathBuf)> {
    if let Some(path) = &options.record {
        return vec![("--record", path.clone())];
    }
    if options.no_record {
        return Vec::new();
    }
    let choices = loaded.plan().components.iter();
    let recorders = choices.filter(|choice| choice.part.label.name == RECORDER);
    let path = recorders.map(|choice| {
        let said = choice.params.as_table().and_then(|table| table.get("path"));
        let path = said.and_then(|node| node.as_str()).unwrap_or("run.mcap");
        ("the recorder's `path`:", PathBuf::from(path))
    });
    path.collect()
}

/// An error if a file to be written is one that the run is read from.
fn refuse_input(flag: &str, file: &Path, scenario: &ScenarioOptions) -> Result<(), Failure> {
    let mut inputs = std::iter::once(&scenario.scenario).chain(&scenario.world);
    match inputs.any(|input| same_file(input, file)) {
        true => Err(Failure::input(format!(
            "{flag} {}: this is an input of the run",
            file.display()
        ))),
        false => Ok(()),
    }
}

/// What a scenario reads is neither a recording nor a summary, so this keeps all that it names, too.
fn refused(flag: &str, file: &Path, what: &str) -> Failure {
    Failure::input(format!(
        "{flag} {}: this file is there already, and it is {what}: it is not replaced; choose another name, \
         or remove it",
        file.display()
    ))
}

/// Whether a file may be written over: it is not there, empty, no plain file (a pipe, `/dev/null`), or what it
/// begins and ends with says that it was written by a run before.
fn replaceable(path: &Path, ours: impl Fn(&[u8]) -> bool) -> bool {
    match std::fs::metadata(path) {
        Ok(there) if there.is_file() && there.len() > 0 => {}
        _ => return true,
    }
    // Who may not read it is told so when it is written.
    ends(path).is_none_or(|bytes| ours(&bytes))
}

/// The first bytes of a file, and the last if it is longer.
fn ends(path: &Path) -> Option<Vec<u8>> {
    let mut file = File::open(path).ok()?;
    let length = file.metadata().ok()?.len();
    let most = LOOKED_AT as u64;
    let mut bytes = Vec::new();
    file.by_ref().take(most).read_to_end(&mut bytes).ok()?;
    if length > most {
        file.seek(SeekFrom::Start(most.max(length - most))).ok()?;
        file.take(most).read_to_end(&mut bytes).ok()?;
    }
    Some(bytes)
}

fn holds(bytes: &[u8], word: &[u8]) -> bool {
    bytes.windows(word.len()).any(|part| part == word)
}

/// Whether two names are of one file, be it there or not.
fn same_target(a: &Path, b: &Path) -> bool {
    let whole = |path: &Path| {
        path.canonicalize().ok().or_else(|| {
            let folder = match path.parent() {
                Some(folder) if !folder.as_os_str().is_empty() => folder,
                _ => Path::new("."),
            };
            Some(folder.canonicalize().ok()?.join(path.file_name()?))
        })
    };
    match (whole(a), whole(b)) {
        (Some(a), Some(b)) => a == b,
        _ => a == b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_not_there_yet_is_known_by_all_its_names() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        std::fs::create_dir(path("inner")).expect("a folder");
        assert!(same_target(&path("x.csv"), &path("inner/../x.csv")));
        assert!(same_target(Path::new("x.csv"), Path::new("./x.csv")));
        assert!(!same_target(&path("x.csv"), &path("inner/x.csv")));
    }

    #[test]
    fn only_what_a_run_wrote_is_replaced() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("x");
        let is_recording = |bytes: &[u8]| bytes.starts_with(MCAP);
        assert!(replaceable(&path, is_recording), "it is not there");
        for (bytes, may) in [
            (b"".as_slice(), true),
            (b"\x89MCAP0\r\n and more".as_slice(), true),
            (b"from,to,loss\n".as_slice(), false),
        ] {
            std::fs::write(&path, bytes).expect("a file");
            assert_eq!(replaceable(&path, is_recording), may, "{bytes:?}");
        }
        assert!(replaceable(folder.path(), is_recording), "no plain file");
        // The names of a long table's columns stand at its end.
        let mut long = b"PAR1".to_vec();
        long.resize(3 * LOOKED_AT, 0);
        long.extend(COLUMN);
        std::fs::write(&path, long).expect("a file");
        assert!(replaceable(&path, |bytes| holds(bytes, COLUMN)));
    }
}
