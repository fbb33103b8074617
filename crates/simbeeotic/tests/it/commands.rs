//! Each command once, and what it says to input that is wrong.

use crate::program::{Call, Program, shipped};
use simbeeotic::record::Recording;

#[test]
fn every_shipped_scenario_is_fine() {
    let program = Program::new();
    for entry in std::fs::read_dir(shipped("scenarios")).expect("scenarios are shipped") {
        let path = entry.expect("it can be listed").path();
        if path.extension().is_some_and(|e| e == "toml" || e == "xml") {
            let call = program.call(&["check", &path.display().to_string()]);
            assert_eq!(call.code, Some(0), "{}: {}", path.display(), call.err);
            assert!(call.out.contains("is fine"), "{}", call.out);
        }
    }
}

#[test]
fn all_errors_of_a_scenario_are_shown_at_their_lines() {
    let program = Program::new();
    program.write(
        "bad.toml",
        r#"[run]
seed = 1
end_tim = "10 s"

[[model]]
use = "random-walk-be"

[[model]]
use = "random-walk-bee"
count = -3
params = { max_speed = "2 m", headng_sigma = "0.1 rad" }
vehicle = { use = "simple-bee", mass = 0.128 }
"#,
    );
    for command in ["check", "run"] {
        let call = program.call(&[command, "bad.toml"]);
        assert_eq!(call.code, Some(2), "{}", call.err);
        for place in [
            "bad.toml:3:1",
            "bad.toml:6:7",
            "bad.toml:10:9",
            "bad.toml:11:",
            "bad.toml:12:",
        ] {
            assert!(call.err.contains(place), "{place} is not in:\n{}", call.err);
        }
        assert!(
            call.err.contains("did you mean `random-walk-bee`?"),
            "{}",
            call.err
        );
        assert!(
            call.err.contains("did you mean `heading_sigma`?"),
            "{}",
            call.err
        );
        assert!(
            call.err.contains("needs a unit") || call.err.contains("bare number"),
            "{}",
            call.err
        );
    }
}

#[test]
fn a_parameter_out_of_range_is_shown_where_it_is_written() {
    let program = Program::new();
    program.write(
        "bad.toml",
        "[run]\nseed = 1\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\nvehicle = { use = \"simple-bee\", mass = \"-1 kg\" }\n",
    );
    let call = program.call(&["check", "bad.toml"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(
        call.err.contains("bad.toml:6:40") && call.err.contains("is -1 kg"),
        "{}",
        call.err
    );
}

#[test]
fn gear_that_is_missing_is_named() {
    let program = Program::new();
    program.write(
        "bad.toml",
        "[run]\nseed = 1\nend_time = \"1 s\"\n[[model]]\nuse = \"broadcast-bee\"\n",
    );
    let call = program.call(&["check", "bad.toml"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(call.err.contains("a radio is wanted"), "{}", call.err);
}

#[test]
fn a_file_that_is_not_there_is_an_error_of_input() {
    let program = Program::new();
    let call = program.call(&["run", "nowhere.toml"]);
    assert_eq!(call.code, Some(2));
    assert!(call.err.contains("nowhere.toml"), "{}", call.err);
    let call = program.call(&["export", "nowhere.mcap", "--csv"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
}

#[test]
fn overrides_that_make_no_sense_are_shown_as_they_were_given() {
    let program = Program::new();
    let scenario = shipped("scenarios/first-swarm.toml");
    for (set, words) in [
        ("run.end_tiem=1 s", "end_time"),
        ("run.end_time=1", "unit"),
        ("model.wasp.count=1", "wasp"),
        ("nonsense", "="),
    ] {
        let call = program.call(&["check", &scenario, "--set", set]);
        assert_eq!(call.code, Some(2), "{set}: {}", call.out);
        assert!(call.err.contains(words), "{set}: {}", call.err);
    }
}

#[test]
fn a_recording_becomes_a_table() {
    let program = Program::new();
    let scenario = shipped("scenarios/drop.toml");
    let call = program.call(&["run", &scenario]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    assert!(
        call.out.contains("drop.mcap"),
        "the summary says where the recording is: {}",
        call.out
    );

    let csv = program.call(&["export", "drop.mcap", "--csv", "--model", "dead"]);
    assert_eq!(csv.code, Some(0), "{}", csv.err);
    let mut lines = csv.out.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column = |name: &str| {
        header
            .iter()
            .position(|h| *h == name)
            .expect("a documented column")
    };
    let (time, z) = (column("time_s"), column("z_m"));
    let rows: Vec<Vec<&str>> = lines.map(|l| l.split(',').collect()).collect();
    assert_eq!(rows.len(), 501, "10 s at 20 ms, both ends");
    let second = rows
        .iter()
        .find(|r| r[time] == "1" || r[time] == "1.0")
        .expect("a tick at 1 s");
    let height: f64 = second[z].parse().expect("a number");
    assert!(
        (height - (20.05 - 0.5 * 9.80665)).abs() < 1e-5,
        "free fall: {height}"
    );

    // The elastic one is back near 20 m after two times the fall, 4.04 s.
    let csv = program.call(&[
        "export",
        "drop.mcap",
        "--csv",
        "--model",
        "elastic",
        "--from",
        "4.04 s",
        "--to",
        "4.06 s",
    ]);
    let row = csv
        .out
        .lines()
        .nth(1)
        .expect("a tick")
        .split(',')
        .collect::<Vec<_>>();
    let height: f64 = row[z].parse().expect("a number");
    assert!(height > 20.0, "it bounced to {height} m");

    let parquet = program.call(&["export", "drop.mcap", "--parquet"]);
    assert_eq!(parquet.code, Some(0), "{}", parquet.err);
    let bytes = std::fs::read(program.path("drop.parquet")).expect("a Parquet file");
    assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));

    let before = std::fs::read(program.path("drop.mcap")).expect("a recording");
    for format in ["--csv", "--parquet"] {
        for target in ["drop.mcap", "./drop.mcap"] {
            let call = program.call(&["export", "drop.mcap", format, target]);
            assert_eq!(call.code, Some(2), "{}", call.err);
            assert!(call.err.contains("recording itself"), "{}", call.err);
        }
    }
    let after = std::fs::read(program.path("drop.mcap")).expect("a recording");
    assert!(before == after, "the recording stays as it was");

    let call = program.call(&[
        "export",
        "drop.mcap",
        "--csv",
        "--from",
        "5 s",
        "--to",
        "1 s",
    ]);
    assert_eq!(
        (call.code, call.out.as_str()),
        (Some(2), ""),
        "{}",
        call.err
    );
    assert!(
        call.err.contains("--from") && call.err.contains("--to"),
        "{}",
        call.err
    );
}

#[test]
fn another_path_for_the_recording_keeps_the_recorder_s_settings() {
    let program = Program::new();
    program.write(
        "bees.toml",
        r#"
[run]
end_time = "1 s"

[[model]]
use = "random-walk-bee"

[[component]]
use = "recorder"
path = "one.mcap"
period = "100 ms"
twists = false
"#,
    );
    program.summary(&["bees.toml", "--record", "two.mcap"]);
    assert!(!program.path("one.mcap").exists());
    let recording = Recording::open(program.path("two.mcap")).expect("the recording reads");
    assert_eq!(recording.ticks().count(), 11);
    assert!(!recording.has_twists());
}

#[test]
fn numbers_that_make_no_sense_get_our_own_words() {
    let program = Program::new();
    let scenario = shipped("scenarios/first-swarm.toml");
    for (arguments, words) in [
        (["--threads", "0"], "between 1 and 4096"),
        (["--threads", "100000"], "between 1 and 4096"),
        (["--threads", "-1"], "between 1 and 4096"),
        (["--real-time", "-1"], "above zero"),
        (["--real-time", "NaN"], "above zero"),
        (["--end-time", "-3 s"], "-3 s"),
        (["--wall-time", "-3 s"], "more than zero"),
    ] {
        let call = program.call(&[&["run", &scenario], &arguments[..]].concat());
        assert_eq!(call.code, Some(2), "{arguments:?}: {}", call.err);
        assert!(call.err.contains(words), "{arguments:?}: {}", call.err);
        assert!(!call.err.contains("unexpected argument"), "{}", call.err);
    }
    for n in ["0", "10,0", "-4"] {
        let call = program.call(&["bench", "fig7", "--n", n]);
        assert_eq!(call.code, Some(2), "{}", call.err);
        assert!(call.err.contains("one bee or more"), "{}", call.err);
    }
}

#[test]
fn a_seed_is_shown_as_it_was_given() {
    let program = Program::new();
    let scenario = shipped("scenarios/first-swarm.toml");
    let run = ["run", &scenario, "--no-record", "--end-time", "1 s"];
    let call = program.call(&[&run[..], &["--seed", "-5"]].concat());
    assert_eq!(call.code, Some(0), "{}", call.err);
    assert!(call.out.contains("seed -5\n"), "{}", call.out);
    let call = program.call(&[&run[..], &["--seed=-5", "--json"]].concat());
    let summary: serde_json::Value = serde_json::from_str(&call.out).expect("a summary");
    assert_eq!(summary["seed"], -5);
}

#[test]
fn the_bench_tells_what_gets_through_on_a_topology() {
    let program = Program::new();
    let ball = shipped("crates/radio/tests/ns3/topologies/ball-020-1.csv");
    let line = shipped("crates/radio/tests/ns3/topologies/line-060-1.csv");
    let bench = ["bench", "radio", "--preset", "ns3", "--payload", "20"];
    let radio = |rest: &[&str]| program.call(&[&bench, rest].concat());
    let json =
        |call: &Call| -> serde_json::Value { serde_json::from_str(&call.out).expect("JSON") };

    let once = ["--duration", "10 s", "--repeat", "1", "--json"];
    let call = radio(&[&["--topology", &ball], &once[..]].concat());
    assert_eq!(call.code, Some(0), "{}", call.err);
    let object = json(&call);
    for (key, value) in [
        ("runs", 1.0),
        ("requests", 200.0),
        ("access_failures", 0.0),
        ("transmitted", 200.0),
        ("delivered", 200.0 * 19.0),
        ("ratio", 1.0),
    ] {
        assert_eq!(object[key].as_f64(), Some(value), "{key}: {object}");
    }
    let delay = object["mean_access_delay_ms"].as_f64().expect("a number");
    assert!((1.3..1.6).contains(&delay), "{delay}");

    // Synchronous, the same nodes get in each other's way; another seed, other backoffs.
    let both = ["--topology", &ball, "--topology", &line];
    let rest = ["--duration", "10 s", "--synchronous", "--json", "--seed"];
    let calls = ["-3", "4"].map(|seed| radio(&[&both[..], &rest, &[seed]].concat()));
    let rows = calls.each_ref().map(json);
    assert_eq!(rows[0][1]["topology"], "line-060-1");
    let ratio = rows[0][0]["ratio"].as_f64().expect("a number");
    // 50 runs of 200 requests; ns-3's ratio is 0.513.
    assert_eq!(
        (&rows[0][0]["runs"], &rows[0][0]["requests"]),
        (&50.into(), &200.into())
    );
    assert!((0.49..0.53).contains(&ratio), "{ratio}");
    assert_ne!(rows[0][0]["delivered"], rows[1][0]["delivered"]);

    let call = radio(&["--topology", &ball, &line, "--duration", "1 s"]);
    let lines: Vec<&str> = call.out.lines().collect();
    assert!(lines[0].starts_with("topology") && lines[0].ends_with("delay ms"));
    assert!(lines[2].starts_with("line-060-1"), "{}", call.out);
}

#[test]
fn a_topology_that_is_wrong_is_told_by_file_and_line() {
    let program = Program::new();
    let here = |name: &str, text: &str| {
        program.write(name, text);
        program.path(name).display().to_string()
    };
    let one = here(
        "one.csv",
        "node,x_m,y_m,z_m,phase_s\n0,0,0,0,0\n0,1,far,0,2\n",
    );
    let two = here("two.csv", "node,x_m,y_m,z_m\n0,0,0,0\n1,0,0,0\n");
    let none = program.path("none.csv").display().to_string();
    let call = program.call(&["bench", "radio", "--topology", &one, &two, &none]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    for words in [
        "one.csv:3: y_m of 'far' is not a number",
        "one.csv:3: phase_s of 2: from 0 to 1",
        "two.csv:1: the column phase_s is missing",
        "none.csv: No such file",
    ] {
        assert!(call.err.contains(words), "{words}: {}", call.err);
    }
    let call = program.call(&["bench", "radio", "--synchronous", "--topology", &two]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    let call = program.call(&["bench", "radio", "--topology", &two, "--payload", "117"]);
    assert!(call.err.contains("between 0 and 116 bytes"), "{}", call.err);
}

#[test]
fn a_new_crate_is_made_once() {
    let program = Program::new();
    let call = program.call(&["new", "my-swarm"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    for file in [
        "Cargo.toml",
        "src/main.rs",
        "src/lib.rs",
        "src/orbit_bee.rs",
        "tests/orbit.rs",
        "scenarios/orbit.toml",
    ] {
        let text = std::fs::read_to_string(program.path("my-swarm").join(file)).expect(file);
        assert!(!text.contains("{{"), "{file} has a gap: {text}");
    }
    assert_eq!(
        program.call(&["new", "my-swarm"]).code,
        Some(2),
        "it does not overwrite"
    );
    assert_eq!(program.call(&["new", "My Swarm"]).code, Some(2));
    for name in ["test", "std", "self", "match"] {
        let call = program.call(&["new", name]);
        assert_eq!(call.code, Some(2));
        assert!(call.err.contains("reserved"), "{}", call.err);
    }
}

#[test]
fn faults_of_building_are_all_shown_and_each_once() {
    let program = Program::new();
    program.write(
        "bad.toml",
        r#"[run]
seed = 1
end_time = "1 s"

[[model]]
use = "inert-bee"
count = 50
vehicle = { use = "simple-bee", mass = "-1 kg" }

[[model]]
use = "broadcast-bee"
count = 50
"#,
    );
    let call = program.call(&["check", "bad.toml"]);
    assert_eq!(call.code, Some(2));
    assert!(call.err.contains("bad.toml:8:40"), "{}", call.err);
    assert!(call.err.contains("a radio is wanted"), "{}", call.err);
    assert!(call.err.contains("2 errors in bad.toml"), "{}", call.err);
}

#[test]
fn a_scenario_and_its_world_are_converted_together_or_not_at_all() {
    let program = Program::new();
    let scenario = shipped("scenarios/figure12.xml");
    let world = shipped("crates/scenario/tests/fixtures/world.xml");

    program.write("bad.xml", "<scenario><nonsense></scenario>");
    let call = program.call(&["convert", "bad.xml", "--world", &world]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(!program.path("world.toml").exists(), "nothing is written");

    let call = program.call(&["convert", &scenario, "--world", &world]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    assert!(call.out.contains("world = \"world.toml\""), "{}", call.out);
    assert!(call.err.contains("wrote world.toml"), "{}", call.err);
    program.write("converted.toml", &call.out);
    let call = program.call(&["check", "converted.toml"]);
    assert_eq!(call.code, Some(0), "{}", call.err);

    for arguments in [
        &["convert", "converted.toml"][..],
        &["convert", &scenario, "--world", "world.toml"],
    ] {
        let call = program.call(arguments);
        assert_eq!(call.code, Some(2), "{}", call.err);
        assert!(call.err.contains("is TOML already"), "{}", call.err);
    }
    program.write(
        "mine.xml",
        &std::fs::read_to_string(&scenario).expect("shipped"),
    );
    let call = program.call(&["convert", "mine.xml", "-o", "./mine.xml"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
}
