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

/// A run that has begun: its recording has ticks in it.
#[cfg(unix)]
fn begun(program: &Program, arguments: &[&str]) -> std::process::Child {
    program.write("bees.toml", BEES);
    let mut child = program
        .command()
        .args(["run", "bees.toml", "--real-time", "1"])
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    // Ten minutes: far more than the slowest machine takes.
    for _ in 0..6000 {
        if last_tick_ns(program).is_some() {
            return child;
        }
        assert!(matches!(child.try_wait(), Ok(None)), "it ended by itself");
        std::thread::sleep(Duration::from_millis(100));
    }
    panic!("nothing is recorded");
}

/// The last tick that is in the recording by now.
#[cfg(unix)]
fn last_tick_ns(program: &Program) -> Option<u64> {
    let recording = Recording::open(program.path("run.mcap")).ok()?;
    recording.ticks().next()?.ok()?;
    Some(recording.end_ns())
}

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_a_recording_that_reads() {
    let program = Program::new();
    let mut child = begun(&program, &["--quiet"]);
    std::thread::sleep(Duration::from_secs(3));
    let seen_ns = last_tick_ns(&program).expect("still there");
    child.kill().expect("it can be killed"); // SIGKILL
    child.wait().expect("it is gone");
    let recording = Recording::open(program.path("run.mcap")).expect("the recording reads");
    assert!(recording.truncated());
    // What was in the file stays in it. How much that is at least, tests of the recorder tell.
    assert!(recording.end_ns() >= seen_ns, "{seen_ns} ns were there");
    assert!(
        recording
            .ticks()
            .all(|t| t.is_ok_and(|t| t.samples.len() == 20))
    );
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_shows_its_summary_and_closes_its_recording() {
    for signal in ["-INT", "-TERM"] {
        let program = Program::new();
        let child = begun(&program, &["--json"]);
        let sent = std::process::Command::new("kill")
            .args([signal, &child.id().to_string()])
            .status();
        assert!(sent.expect("there is a kill").success());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(130), "{signal}");
        let summary: serde_json::Value = serde_json::from_slice(&output.stdout).expect("a summary");
        assert_eq!(summary["ended"], "interrupted");
        assert!(summary["charge"]["hover"]["milliampere_seconds"].is_number());
        let recording = Recording::open(program.path("run.mcap")).expect("the recording reads");
        assert!(!recording.truncated());
        assert!(recording.ticks().next().is_some_and(|tick| tick.is_ok()));
    }
}

/// Both ways to have a page end by an interrupt while it is open, and a port that is taken is named.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_page_and_a_taken_port_is_said() {
    use std::io::{BufRead, BufReader};
    let program = Program::new();
    program.write("bees.toml", BEES);
    program.summary(&["bees.toml", "--end-time", "0.5 s"]);
    let run = [
        "run",
        "bees.toml",
        "--no-record",
        "--view",
        "--paused",
        "--port",
        "0",
    ];
    let view = ["view", "run.mcap", "--port", "0"];
    for arguments in [&run[..], &view] {
        let mut command = program.command();
        let command = command.args(arguments).stderr(std::process::Stdio::piped());
        let mut child = command.spawn().expect("the program starts");
        let mut lines = BufReader::new(child.stderr.take().expect("it is piped"));
        let mut line = String::new();
        while !line.contains("page: http://") {
            line.clear();
            assert!(lines.read_line(&mut line).expect("text") > 0, "no page");
        }
        let place = line.trim().rsplit("http://").next().expect("an address");
        let place = place.trim_end_matches('/');
        let mut open = std::net::TcpStream::connect(place).expect("it listens");
        let port = place.rsplit(':').next().expect("a port");
        let second = program.call(&["view", "run.mcap", "--port", port]);
        assert_eq!(second.code, Some(2), "{}", second.err);
        let said = format!("port {port} of 127.0.0.1 is in use");
        assert!(second.err.contains(&said), "{}", second.err);
        let sent = std::process::Command::new("kill")
            .args(["-INT", &child.id().to_string()])
            .status();
        assert!(sent.expect("there is a kill").success());
        let ended = child.wait().expect("it ends");
        let expected = if arguments[0] == "run" { 130 } else { 0 };
        assert_eq!(ended.code(), Some(expected), "{arguments:?}");
        let mut rest = Vec::new();
        let _ = open.read_to_end(&mut rest);
        assert!(
            std::net::TcpStream::connect(place).is_err(),
            "nobody listens"
        );
    }
}

#[test]
fn a_limit_of_wall_time_ends_a_run_well() {
    let program = Program::new();
    program.write("bees.toml", BEES);
    let summary = program.summary(&["bees.toml", "--wall-time", "1 s"]);
    assert_eq!(summary["ended"], "wall time");
    assert!(
        !Recording::open(program.path("run.mcap"))
            .expect("the recording reads")
            .truncated()
    );
}

#[test]
fn a_recording_that_cannot_be_made_is_said_once_and_nothing_else() {
    let program = Program::new();
    program.write("bees.toml", BEES);
    std::fs::create_dir(program.path("folder")).expect("made");
    let mut targets = vec!["folder", "nowhere/run.mcap"];
    if cfg!(target_os = "linux") {
        targets.push("/dev/full");
    }
    for target in targets {
        let call = program.call(&["run", "bees.toml", "--record", target]);
        assert_eq!(call.code, Some(2), "{target}: {}", call.err);
        assert_eq!(call.err.matches(target).count(), 1, "{}", call.err);
        assert_eq!(call.err.lines().count(), 1, "{}", call.err);
        assert_eq!(call.out, "", "no summary");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_an_error() {
    let program = Program::new();
    program.write("bees.toml", BEES);
    for arguments in [
        &["run", "bees.toml", "--json", "--end-time", "1 s"][..],
        &["list"],
        &["schema"],
    ] {
        let full = std::fs::File::create("/dev/full").expect("Linux has it");
        let output = program
            .command()
            .args(arguments)
            .stdout(full)
            .output()
            .expect("the program starts");
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        let err = String::from_utf8_lossy(&output.stderr);
        assert!(err.contains("No space left"), "{err}");
    }
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
