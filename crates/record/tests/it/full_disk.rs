//! A disk that is full, from the start or in mid-run.

#![cfg(target_os = "linux")]
#![expect(clippy::print_stdout, reason = "the child speaks to its parent")]

use crate::{child, swarm};
use simbeeotic_record::{Header, RecordError, Recorder, Recording};

#[test]
fn a_full_disk_is_told_in_clear_words() {
    let error = Recorder::create("/dev/full", swarm::header(10)).expect_err("the disk is full");
    assert!(matches!(error, RecordError::Write { bytes: 0, .. }));
    assert_eq!(
        error.to_string(),
        "recording /dev/full: No space left on device (os error 28); \
         0 bytes are written and can be read"
    );
}

#[test]
fn a_folder_that_is_not_there_is_told_before_the_run_starts() {
    let error = Recorder::create("/no/such/run.mcap", Header::default()).expect_err("no folder");
    assert!(matches!(error, RecordError::Create { .. }));
}

/// Records until no more fits into the file, and says how that ended.
#[test]
fn starving_child() {
    let Some(path) = child::file() else { return };
    let mut recorder = Recorder::create(path, swarm::header(500)).expect("created");
    let mut tick = 0;
    let error = loop {
        if let Err(error) = recorder.tick(tick, swarm::samples(tick, 500)) {
            break error;
        }
        tick += 1;
    };
    let again = recorder
        .tick(tick, swarm::samples(tick, 500))
        .expect_err("still full");
    assert_eq!(error.to_string(), again.to_string());
    let at_end = recorder
        .finish(&serde_json::Value::Null)
        .expect_err("still full");
    assert_eq!(error.to_string(), at_end.to_string());
    println!("error: {error}");
}

/// A limit on file sizes stands for a disk that becomes full in the middle of a run.
#[test]
fn what_was_written_before_the_disk_was_full_can_be_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let child = child::start(
        "full_disk::starving_child",
        &path,
        // In blocks of 512 or 1024 bytes; without the trap the process would be killed.
        "trap '' XFSZ; ulimit -f 6000;",
    );
    let output = child.wait_with_output().expect("ends by itself");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();

    let bytes = path.metadata().expect("there").len();
    let expected = format!(
        "error: recording {}: File too large (os error 27); {bytes} bytes are written and can be read",
        path.display()
    );
    assert!(
        said.contains(&expected),
        "{said}\nshould contain\n{expected}"
    );

    let recording = Recording::open(&path).expect("opens");
    assert!(recording.truncated());
    let mut ticks = 0;
    for tick in recording.ticks() {
        let tick = tick.expect("readable");
        assert!(tick.samples.iter().copied().eq(swarm::samples(ticks, 500)));
        ticks += 1;
    }
    assert!(ticks > 20, "{ticks} ticks in {bytes} bytes");
}
