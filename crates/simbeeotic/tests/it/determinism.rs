//! Same scenario, same seed: the same run, whatever else is different.

use crate::program::{Program, shipped};
use simbeeotic::Error;
use simbeeotic::prelude::*;
use simbeeotic::scenario::{Request, load_text};
use simbeeotic_model::Simulation;

const INSTRUMENT: &str = "scenarios/instrument.toml";

#[test]
fn threads_recording_and_repetition_do_not_show() {
    let program = Program::new();
    let scenario = shipped(INSTRUMENT);
    let run =
        |more: &[&str]| program.trace(&[&[scenario.as_str(), "--end-time", "2 s"], more].concat());
    let first = run(&["--no-record", "--threads", "1"]);
    assert_eq!(first, run(&["--no-record", "--threads", "1"]), "again");
    assert_eq!(
        first,
        run(&["--no-record", "--threads", "2"]),
        "two threads"
    );
    assert_eq!(
        first,
        run(&["--no-record", "--threads", "3"]),
        "three threads"
    );
    assert_eq!(first, run(&["--record", "run.mcap"]), "recorded");
    assert_eq!(first, run(&["--no-record", "--real-time", "1000"]), "paced");
    let readings = [
        "--record",
        "run.mcap",
        "--set",
        "component.recorder.readings=[\"*\"]",
    ];
    assert_eq!(first, run(&readings), "with all readings");
    let air = [
        "--record",
        "run.mcap",
        "--set",
        "component.recorder.packets=[\"*\"]",
        "--set",
        "component.recorder.radios=[\"*\"]",
        "--set",
        "component.recorder.radio_period=70 ms",
    ];
    assert_eq!(first, run(&air), "with all packets, links and counters");
    assert_ne!(
        first,
        run(&["--no-record", "--seed", "2"]),
        "another seed is another run"
    );
}

#[test]
fn threads_do_not_show_where_packets_take_time_fade_and_hop() {
    let program = Program::new();
    for (name, end) in [("talk", "3 s"), ("flood", "4 s"), ("testbed", "5 s")] {
        let scenario = shipped(&format!("scenarios/{name}.toml"));
        let run = |threads: &str, seed: &str| {
            let end = ["--no-record", "--end-time", end];
            let rest = ["--threads", threads, "--seed", seed];
            program.trace(&[&[scenario.as_str()], &end[..], &rest].concat())
        };
        let one = run("1", "1");
        assert_eq!(one, run("2", "1"), "{name}, two threads");
        assert_eq!(one, run("3", "1"), "{name}, three threads");
        assert_ne!(one, run("1", "2"), "{name}, another seed");
    }
}

#[test]
fn the_hash_can_tell_a_change_of_one_parameter() {
    let program = Program::new();
    let scenario = shipped("scenarios/first-swarm.toml");
    let run =
        |set: &str| program.trace(&[&scenario, "--no-record", "--end-time", "2 s", "--set", set]);
    let as_written = run("run.seed=1");
    assert_ne!(as_written, run("model.bee.params.max_speed=1.99 m/s"));
    assert_ne!(as_written, run("model.bee.vehicle.mass=129 g"));
}

/// Twenty bees in a cube, and more if asked for, before or after them.
fn bees(before: &str, after: &str) -> Result<Simulation, Error> {
    let text = format!(
        r#"
        [run]
        seed = 5
        end_time = "5 s"
        [channel]
        use = "free-space"
        range_limit = "30 m"
        {before}
        [[model]]
        use = "instrument-bee"
        name = "bee"
        count = 20
        start = {{ box = ["3 m", "3 m", "3 m"] }}
        vehicle = {{ use = "simple-bee", bee_collisions = true }}
        sensor.compass = {{ use = "compass" }}
        radio = {{ use = "cc2420" }}
        {after}
        "#
    );
    let loaded = load_text("bees", &text, &Request::default()).map_err(|r| {
        Error::Scenario(simbeeotic::scenario::render::faults(
            &r.faults, &r.sources, false,
        ))
    })?;
    let setup = loaded
        .setup()
        .map_err(|f| Error::Scenario(format!("{f:?}")))?;
    Simulation::new(setup).map_err(|e| Error::Scenario(e.to_string()))
}

fn traces(mut run: Simulation) -> Vec<Option<u64>> {
    run.run_until(SimTime::from_secs(5)).expect("it runs");
    (0..20)
        .map(|i| run.model_trace(&format!("bee-{i}")))
        .collect()
}

const FAR_AWAY: &str = r#"
        [[model]]
        use = "instrument-bee"
        name = "hermit"
        start = ["10 km", "0 m", "3 m"]
        sensor.compass = { use = "compass" }
        radio = { use = "cc2420" }
"#;

#[test]
fn a_bee_ten_kilometres_away_changes_no_other_bee() {
    let alone = traces(bees("", "").expect("a good scenario"));
    assert!(alone.iter().all(Option::is_some));
    assert_eq!(
        alone,
        traces(bees("", FAR_AWAY).expect("a good scenario")),
        "added last"
    );
    assert_eq!(
        alone,
        traces(bees(FAR_AWAY, "").expect("a good scenario")),
        "added first: other numbers"
    );

    let near = FAR_AWAY.replace("10 km", "1 m");
    assert_ne!(
        alone,
        traces(bees("", &near).expect("a good scenario")),
        "one in their midst does"
    );
}

/// Says one word by radio, and another to its neighbour, once a second.
#[behavior("test-speaker")]
struct Speaker {
    params: SpeakerParams,
    radio: Option<RadioHandle>,
}

/// What it says.
#[params]
#[derive(Default)]
struct SpeakerParams {
    word: String,
    to: String,
}

impl Behavior for Speaker {
    type Params = SpeakerParams;

    fn build(params: SpeakerParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.every(Time::from_secs(1.0), Self::speak);
        Ok(Self {
            params,
            radio: kit.optional_radio(),
        })
    }
}

impl Speaker {
    fn speak(&mut self, bee: &mut Bee<'_>) {
        if let Some(radio) = self.radio {
            bee.send(radio, self.params.word.as_bytes());
        }
        if let Some(to) = bee.find(&self.params.to) {
            bee.tell_after(Time::from_millis(1500.0), to, self.params.word.clone());
        }
    }
}

#[test]
fn one_byte_of_a_payload_shows_in_the_trace() {
    let run = |word: &str| {
        let speaker = format!(
            r#"
            [[model]]
            use = "test-speaker"
            start = ["1 m", "1 m", "9 m"]
            params = {{ word = "{word}" }}
            radio = {{ use = "cc2420" }}
            "#
        );
        let mut run = bees("", &speaker).expect("a good scenario");
        run.run_until(SimTime::from_secs(5)).expect("it runs");
        run.trace().total()
    };
    assert_eq!(run("hum"), run("hum"));
    assert_ne!(run("hum"), run("hun"));
}

#[test]
fn the_mail_of_others_does_not_show_in_a_model_s_trace() {
    let pair = |a: &str, b: &str, at: &str| {
        format!(
            r#"
            [[model]]
            use = "test-speaker"
            name = "{a}"
            start = ["{at}", "0 m", "3 m"]
            params = {{ word = "hum", to = "{b}" }}
            [[model]]
            use = "test-speaker"
            name = "{b}"
            start = ["{at}", "5 m", "3 m"]
            params = {{ word = "hum", to = "{a}" }}
            "#
        )
    };
    let here = pair("ann", "bob", "50 m");
    let there = pair("far-ann", "far-bob", "10 km");
    let traces = |mut run: Simulation| {
        run.run_until(SimTime::from_secs(5)).expect("it runs");
        ["ann", "bob"].map(|path| run.model_trace(path).expect("it is there"))
    };
    let alone = traces(bees("", &here).expect("a good scenario"));
    assert_eq!(alone, traces(bees(&there, &here).expect("a good scenario")));
}

#[test]
fn a_run_in_pieces_is_the_same_run() {
    let mut whole = bees("", "").expect("a good scenario");
    whole.run_until(SimTime::from_secs(5)).expect("it runs");
    let mut pieces = bees("", "").expect("a good scenario");
    for k in 1..=100 {
        pieces
            .run_until(SimTime::from_nanos(49_999_999 * k))
            .expect("it runs");
    }
    pieces.run_until(SimTime::from_secs(5)).expect("it runs");
    assert_eq!(whole.trace().total(), pieces.trace().total());
}

#[test]
fn figure_12_as_printed_and_in_toml_are_one_run() {
    let program = Program::new();
    let xml = shipped("scenarios/figure12.xml");
    let toml = shipped("scenarios/figure12.toml");
    // The whole of it takes minutes; 300 bees and two seconds tell the two files apart as well.
    let small = [
        "--no-record",
        "--end-time",
        "2 s",
        "--set",
        "model.instrument-bee.count=300",
    ];
    let from_xml = program.trace(&[&[xml.as_str()], &small[..]].concat());
    assert_eq!(
        from_xml,
        program.trace(&[&[toml.as_str()], &small[..]].concat())
    );

    let converted = program.call(&["convert", &xml, "-o", "converted.toml"]);
    assert_eq!(converted.code, Some(0), "{}", converted.err);
    assert_eq!(
        from_xml,
        program.trace(&[&["converted.toml"], &small[..]].concat())
    );
}
