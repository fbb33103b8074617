//! What ends a run before its time: clear words, an exit code, a recording that reads.

use crate::program::Program;
use simbeeotic::prelude::*;
use simbeeotic::record::Recording;
use std::io::Read;
use std::process::Stdio;
use std::time::Duration;

const BEES: &str = r#"
[run]
seed = 1
end_time = "100000 s"

[[model]]
use = "random-walk-bee"
name = "bee"
count = 20
start = { box = ["20 m", "20 m", "20 m"] }

[[component]]
use = "recorder"
path = "run.mcap"
period = "100 ms"
"#;

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_a_recording_up_to_its_last_second() {
    let program = Program::new();
    program.write("bees.toml", BEES);
    let mut child = program
        .command()
        .args(["run", "bees.toml", "--quiet", "--real-time", "4"])
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    std::thread::sleep(Duration::from_secs(4));
    child.kill().expect("it can be killed"); // SIGKILL
    child.wait().expect("it is gone");
    let recording = Recording::open(program.path("run.mcap")).expect("the recording reads");
    assert!(recording.truncated());
    // 4 s of wall time at 4 times real time, less the start-up and at most a second (4 virtual).
    let seconds = recording.end_ns() as f64 * 1e-9;
    assert!(seconds > 8.0, "only {seconds} virtual seconds are left");
    assert!(
        recording
            .ticks()
            .all(|t| t.is_ok_and(|t| t.samples.len() == 20))
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_ends_the_run_with_a_clear_message() {
    let program = Program::new();
    program.write("bees.toml", BEES);
    let call = program.call(&[
        "run",
        "bees.toml",
        "--quiet",
        "--record",
        "/dev/full",
        "--end-time",
        "1000 s",
    ]);
    assert_eq!(call.code, Some(1), "{}", call.err);
    assert!(
        call.err.contains("/dev/full") && call.err.contains("No space left"),
        "{}",
        call.err
    );
}

#[test]
fn an_interrupted_run_shows_its_summary_and_closes_its_recording() {
    let program = Program::new();
    program.write("bees.toml", BEES);
    let child = program
        .command()
        .args([
            "run",
            "bees.toml",
            "--quiet",
            "--json",
            "--wall-time",
            "1 s",
        ])
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success());
    let summary: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a summary");
    assert_eq!(summary["ended"], "wall time");
    assert!(
        !Recording::open(program.path("run.mcap"))
            .expect("the recording reads")
            .truncated()
    );
}

/// Sends itself a message whenever it gets one.
#[behavior("test-echo", host = Bodiless)]
struct Echo;

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

impl Behavior<Bodiless> for Echo {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        kit.once(Time::from_secs(1.0), |_, cx| cx.tell(cx.id(), ()));
        Ok(Self)
    }

    fn on_message(&mut self, _message: &Message, cx: &mut Cx<'_>) {
        cx.tell(cx.id(), ());
    }
}

/// Breaks an invariant of its own.
#[behavior("test-panic", host = Bodiless)]
struct Panicky;

impl Behavior<Bodiless> for Panicky {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Bodiless>) -> Result<Self, BuildError> {
        kit.once(Time::from_secs(2.5), |_, _| panic!("the queen is missing"));
        Ok(Self)
    }
}

fn error_of(model: &str, folder: &Program) -> String {
    let text = format!(
        r#"
        [run]
        seed = 42
        end_time = "10 s"
        [[model]]
        use = "{model}"
        name = "culprit"
        [[component]]
        use = "recorder"
        path = {:?}
        "#,
        folder.path("run.mcap")
    );
    match simbeeotic::run_text(&text) {
        Ok(_) => panic!("it ran to its end"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn a_loop_without_delay_ends_the_run_and_names_its_models() {
    let folder = Program::new();
    let error = error_of("test-echo", &folder);
    assert!(
        error.contains("culprit") && error.contains("1 s") && error.contains("10000 rounds"),
        "{error}"
    );
    assert!(
        Recording::open(folder.path("run.mcap")).is_ok_and(|r| !r.truncated()),
        "closed properly"
    );
}

#[test]
fn a_panic_ends_the_run_with_path_time_and_seed() {
    let folder = Program::new();
    let error = error_of("test-panic", &folder);
    for word in ["culprit", "2.5", "42", "the queen is missing"] {
        assert!(error.contains(word), "{word} is not in: {error}");
    }
    let recording = Recording::open(folder.path("run.mcap")).expect("the recording reads");
    assert!(!recording.truncated());
    assert!(
        recording.end_ns() >= 2_000_000_000,
        "up to the last tick before the panic"
    );
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let program = Program::new();
    let mut child = program
        .command()
        .arg("list")
        .stdout(Stdio::piped())
        .spawn()
        .expect("it starts");
    let mut one = [0; 1];
    let mut out = child.stdout.take().expect("piped");
    out.read_exact(&mut one).expect("it says something");
    drop(out);
    assert!(child.wait().expect("it ends").success());
}
