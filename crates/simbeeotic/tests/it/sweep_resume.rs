//! Sweeps that were broken off, or had runs that failed, and go on.

use crate::program::{Call, Program};
use crate::sweep::{BEES, good, program, table};

/// Runs of five bees fail, as they have too many events; those of two do not.
const SOME_FAIL: [&str; 6] = [
    "sweep",
    "bees.toml",
    "--set",
    "run.pending_events=4",
    "--vary",
    "model.bee.count=5,2",
];

#[test]
fn after_runs_that_failed_only_they_are_flown_again() {
    let program = program();
    let call = program.call(&SOME_FAIL);
    assert_eq!(call.code, Some(1), "{}", call.err);
    let said =
        "4 of 8 runs failed; their rows say why; the same command with --resume flies them again";
    assert!(call.err.contains(said), "{}", call.err);
    let before = std::fs::read(program.path("bees-runs.csv")).expect("a table");
    let call = program.call(&[&SOME_FAIL[..], &["--resume"]].concat());
    assert_eq!(call.code, Some(1), "{}", call.err);
    assert!(call.err.contains("4 of 8 runs are done"), "{}", call.err);
    let after = std::fs::read(program.path("bees-runs.csv")).expect("a table");
    assert!(before == after, "the same table");
}

#[test]
fn rows_that_a_resumed_sweep_has_no_use_for_are_kept() {
    let program = program();
    assert_eq!(program.call(&SOME_FAIL).code, Some(1));
    // One seed was forgotten.
    let call = program.call(&[&SOME_FAIL[..], &["--resume", "--seeds", "1"]].concat());
    assert!(call.err.contains("2 of 4 runs are done"), "{}", call.err);
    let kept = "kept as bees-runs.csv.unfinished.old";
    assert!(call.err.contains(kept), "{}", call.err);
    let (old, now) = (
        program.path("bees-runs.csv.unfinished.old"),
        program.path("bees-runs.csv.unfinished"),
    );
    std::fs::rename(old, now).expect("it is there");
    let call = program.call(&[&SOME_FAIL[..], &["--resume"]].concat());
    assert!(call.err.contains("4 of 8 runs are done"), "{}", call.err);
}

#[test]
fn a_recording_of_another_run_under_the_same_number_is_not_taken_for_it() {
    let program = program();
    let sweep = |seeds, more: &[&str]| {
        let record = ["--record", "runs", "--seeds", seeds];
        let call = program.call(&[&SOME_FAIL[..], &record, more].concat());
        assert_eq!(call.code, Some(1), "{}", call.err);
        call
    };
    let flown = |run: usize| {
        let file = format!("runs/run-000{run}.mcap");
        good(program.call(&["export", &file, "--csv"])).out
    };
    sweep("4,5", &[]);
    let (first, second) = (flown(3), flown(7));
    assert_ne!(first, second, "two seeds");
    let call = sweep("4,5", &["--resume"]);
    assert!(call.err.contains("4 of 8 runs are done"), "{}", call.err);
    // The runs that were the third and fourth are the seventh and eighth now.
    let call = sweep("5,4", &["--resume"]);
    assert!(!call.err.contains("runs are done"), "{}", call.err);
    assert!(call.err.contains("4 runs in"), "{}", call.err);
    assert!(flown(3) == second && flown(7) == first);
}

/// Starts a sweep, and sends Ctrl-C when so many rows are beside its table; no machine is so slow that it does not
/// come to that.
#[cfg(unix)]
fn interrupted(program: &Program, arguments: &[&str], rows: usize) -> Call {
    program.interrupted(arguments, "bees-runs.csv.unfinished", rows + 1)
}

/// Two runs of each seed end at once, the other two take for ever.
#[cfg(unix)]
fn endless() -> String {
    BEES.replace(
        "[sweep.vary]",
        "[sweep.vary]\n\"run.end_time\" = [\"1 s\", \"10000 h\"]",
    )
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_done() {
    let program = Program::new();
    program.write("bees.toml", &endless());
    let sweep = [
        "sweep",
        "bees.toml",
        "--jobs",
        "2",
        "--seeds",
        "1",
        "--vary",
        "model.bee.count=2",
        "--record",
        "runs",
    ];
    let call = interrupted(&program, &sweep, 2);
    assert_eq!(call.code, Some(130), "{}", call.err);
    let line = "interrupted: 2 of 4 runs are done; the same command with --resume goes on";
    assert!(call.err.lines().any(|l| l == line), "{}", call.err);
    let rows = table(&program, "bees-runs.csv");
    assert_eq!(rows.len(), 3);
    assert_eq!((rows[1][0].as_str(), rows[2][0].as_str()), ("1", "2"));
    for run in 1..=4 {
        let path = program.path(&format!("runs/run-000{run}.mcap"));
        assert_eq!(path.exists(), run <= 2, "{run}: no row, no recording");
    }
    // Rows that took their time are not thrown away by a command that forgets them.
    let call = program.call(&sweep);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(
        call.err
            .contains("bees-runs.csv.unfinished has 2 runs of a sweep that is not whole"),
        "{}",
        call.err
    );
}

#[cfg(unix)]
#[test]
fn a_sweep_that_was_broken_off_goes_on_to_the_same_table() {
    let program = Program::new();
    program.write("bees.toml", &endless());
    let sweep = |more: &[&str]| {
        let all = [
            "sweep",
            "bees.toml",
            "--jobs",
            "2",
            "--vary",
            "run.end_time=1 s,2 s",
        ];
        good(program.call(&[&all, more].concat()))
    };
    sweep(&["-o", "whole.csv", "-q"]);
    let whole = std::fs::read(program.path("whole.csv")).expect("a table");
    // The first four runs of either seed end, then both workers are held.
    let first = ["sweep", "bees.toml", "--jobs", "2", "--seeds", "1"];
    let call = interrupted(&program, &first, 4);
    assert_eq!(call.code, Some(130), "{}", call.err);
    // As a crash leaves it: the last row is cut off.
    let path = program.path("bees-runs.csv.unfinished");
    let rows = std::fs::read(&path).expect("rows");
    std::fs::write(&path, &rows[..rows.len() - 20]).expect("written");
    let call = sweep(&["--resume"]);
    assert!(
        call.err.lines().any(|l| l == "3 of 16 runs are done"),
        "{}",
        call.err
    );
    let resumed = std::fs::read(program.path("bees-runs.csv")).expect("a table");
    assert!(resumed == whole, "the same bytes");
    assert!(!path.exists(), "it is whole");
    let call = sweep(&["--resume", "--dry-run"]);
    assert!(call.err.contains("16 runs in its sweep"), "{}", call.err);
}

#[cfg(unix)]
#[test]
fn a_sweep_does_not_go_on_with_rows_of_another_scenario() {
    let program = Program::new();
    program.write("bees.toml", &endless());
    let sweep = ["sweep", "bees.toml", "--jobs", "2", "--seeds", "1"];
    let call = interrupted(&program, &sweep, 4);
    assert_eq!(call.code, Some(130), "{}", call.err);
    let resume = |more: &[&str]| {
        let arguments = [
            sweep.as_slice(),
            &["--vary", "run.end_time=1 s", "--resume"],
            more,
        ]
        .concat();
        program.call(&arguments)
    };
    program.write("bees.toml", &endless().replace("4 m", "5 m"));
    let call = resume(&[]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    let said = "--resume: the scenario has changed, so the 4 runs in bees-runs.csv.unfinished may be others now";
    assert!(call.err.contains(said), "{}", call.err);
    program.write("bees.toml", &endless());
    let call = resume(&["--vary", "model.0.name=bee"]);
    assert!(
        call.err.contains("--resume: what varied was"),
        "{}",
        call.err
    );
    let call = resume(&["--restart"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    // Without the runs that had no end all are there.
    let call = good(resume(&[]));
    assert!(call.err.contains("4 of 4 runs are done"), "{}", call.err);
    assert_eq!(table(&program, "bees-runs.csv").len(), 5);
    program.write("bees-runs.csv.unfinished", "my own\n");
    let call = program.call(&["sweep", "bees.toml", "--resume"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(call.err.contains("it is something else"), "{}", call.err);
}

#[test]
fn recordings_of_a_longer_sweep_are_not_mixed_with_those_of_this_one() {
    let program = program();
    let sweep = |seeds| {
        let seeds = ["--seeds", seeds];
        program.call(
            &[
                ["sweep", "bees.toml", "-q", "--record", "runs"].as_slice(),
                &seeds,
            ]
            .concat(),
        )
    };
    good(sweep("2"));
    let call = sweep("1");
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(
        call.err.contains("run-0005.mcap is of a longer sweep"),
        "{}",
        call.err
    );
    good(sweep("2"));
}
