//! Metrics: what models publish is summed up, in the summary and in its table.

use crate::program::{Program, shipped};
use simbeeotic::prelude::*;
use simbeeotic::scenario::{Request, load_text};
use simbeeotic_model::{Outcome, Simulation};

/// A bee that counts: by as many a second as its number says.
#[behavior("test-counting-bee")]
struct CountingBee {
    step: f64,
    count: f64,
}

/// Parameters of [`CountingBee`].
#[params]
#[derive(Default)]
struct CountingBeeParams {
    /// How many it counts each second.
    step: f64,
}

impl Behavior for CountingBee {
    type Params = CountingBeeParams;

    fn build(params: CountingBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.every(Time::from_secs(1.0), Self::count);
        let (step, count) = (params.step, 0.0);
        Ok(Self { step, count })
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        bee.metric("done", 1.0, "1");
    }
}

impl CountingBee {
    fn count(&mut self, bee: &mut Bee<'_>) {
        self.count += self.step;
        bee.metric("pollen", self.count, "mg");
    }
}

const TEXT: &str = r#"
    [run]
    seed = 3
    end_time = "10 s"
    [[model]]
    use = "test-counting-bee"
    name = "two"
    params = { step = 2.0 }
    [[model]]
    use = "test-counting-bee"
    name = "five"
    start = ["5 m", "0 m", "0 m"]
    params = { step = 5.0 }
"#;

fn run(threads: usize) -> (Simulation, Outcome) {
    let loaded = load_text("count", TEXT, &Request::default()).expect("a good scenario");
    let mut setup = loaded.setup().expect("a good scenario");
    setup.threads = threads;
    let mut simulation = Simulation::new(setup).expect("a good scenario");
    let outcome = simulation.run();
    (simulation, outcome)
}

#[test]
fn what_models_publish_is_summed_up_though_nobody_watches() {
    let (simulation, outcome) = run(1);
    let [done, pollen] = &outcome.summary.metrics[..] else {
        panic!("{:?}", outcome.summary.metrics)
    };
    // Last words count, too.
    assert_eq!(
        (done.name.as_str(), done.models, done.sum),
        ("done", 2, 2.0)
    );
    assert_eq!(
        (pollen.name.as_str(), pollen.unit.as_str()),
        ("pollen", "mg")
    );
    let five = simulation.metrics()[3];
    let rounds = five.values.count as f64;
    assert!(rounds >= 10.0, "at least once a second");
    assert_eq!(simulation.population().path(five.model), "five");
    assert_eq!(
        (five.values.last, five.values.max),
        (5.0 * rounds, 5.0 * rounds)
    );
    assert_eq!(five.values.min, 5.0);
    assert_eq!(five.values.mean(), 5.0 * (rounds + 1.0) / 2.0);
    assert_eq!((pollen.models, pollen.count), (2, 2 * five.values.count));
    assert_eq!((pollen.sum, pollen.mean), (7.0 * rounds, 3.5 * rounds));
    assert_eq!((pollen.min, pollen.max), (2.0 * rounds, 5.0 * rounds));

    let (again, other) = run(2);
    assert_eq!(again.metrics(), simulation.metrics());
    assert_eq!(other.summary.trace_hash, outcome.summary.trace_hash);
}

#[test]
fn a_summary_goes_into_a_table() {
    let program = Program::new();
    let scenario = shipped("scenarios/flood.toml");
    let arguments = |file| {
        [
            &scenario,
            "--no-record",
            "--end-time",
            "4 s",
            "--summary",
            file,
        ]
    };
    let json = program.summary(&arguments("s.json"));
    let hash = json["trace_hash"].as_str().expect("a hash");
    let hops = json["metrics"].as_array().expect("metrics");
    let hops = hops
        .iter()
        .find(|m| m["name"] == "hops")
        .expect("flood-bee");

    let text = std::fs::read_to_string(program.path("s.json")).expect("written");
    let rows: Vec<serde_json::Value> = serde_json::from_str(&text).expect("JSON");
    let find = |metric: &str, model: &str| {
        let mut rows = rows.iter();
        rows.find(|row| row["metric"] == metric && row["model"] == model)
            .unwrap_or_else(|| panic!("no {metric} of {model:?} in {text}"))
    };
    assert!(
        rows.iter()
            .all(|row| row["trace_hash"] == hash && row["seed"] == json["seed"])
    );
    assert_eq!(
        find("packets/sent", "")["last"],
        json["packets"]["sent"].as_f64().unwrap_or(-1.0)
    );
    assert_eq!(find("time/virtual", "")["unit"], "s");
    assert_eq!(find("hops/sum", "")["last"], hops["sum"]);
    let own = rows
        .iter()
        .filter(|row| row["metric"] == "hops" && row["kind"] == "flood-bee");
    let own: Vec<f64> = own
        .map(|row| row["last"].as_f64().expect("a number"))
        .collect();
    assert_eq!(own.len() as u64, hops["models"].as_u64().expect("a count"));
    assert_eq!(
        own.iter().sum::<f64>(),
        hops["sum"].as_f64().expect("a sum")
    );

    // The same as CSV and Parquet.
    program.summary(&arguments("s.csv"));
    let csv = std::fs::read_to_string(program.path("s.csv")).expect("written");
    assert_eq!(csv.lines().count(), rows.len() + 1);
    let sent = csv
        .lines()
        .filter(|line| line.contains(",packets/sent,1,1,"));
    assert_eq!(sent.count(), 1, "{csv}");
    program.summary(&arguments("s.parquet"));
    let parquet = std::fs::read(program.path("s.parquet")).expect("written");
    assert!(parquet.starts_with(b"PAR1") && parquet.ends_with(b"PAR1"));

    let shown = program.call(&[&["run"], &arguments("s.csv")[..]].concat());
    assert!(shown.out.contains("  hops "), "{}", shown.out);
    for (file, why) in [
        ("s.txt", "must end in .parquet, .csv or .json"),
        ("no/s.csv", "there is no folder no"),
    ] {
        let refused = program.call(&[&["run"], &arguments(file)[..]].concat());
        assert_eq!(refused.code, Some(2));
        assert!(refused.err.contains(why), "{}", refused.err);
    }
}

#[test]
fn neither_a_recording_nor_what_the_scenario_reads_is_written_over() {
    let program = Program::new();
    for name in ["testbed.toml", "testbed-links.csv"] {
        let text = std::fs::read_to_string(shipped(&format!("scenarios/{name}")));
        program.write(name, &text.expect("a shipped file"));
    }
    let links = || std::fs::read(program.path("testbed-links.csv")).expect("still there");
    let before = links();
    let run = ["run", "--quiet", "testbed.toml", "--end-time", "1 s"];
    for (arguments, why) in [
        (
            ["--record", "x.csv", "--summary", "./x.csv"].as_slice(),
            "the recording of the run goes into this file",
        ),
        (
            &["--no-record", "--summary", "testbed-links.csv"],
            "no summary of a run",
        ),
        (&["--record", "testbed-links.csv"], "no recording"),
        (&["--record", "testbed.toml"], "an input of the run"),
    ] {
        let call = program.call(&[&run, arguments].concat());
        assert_eq!(call.code, Some(2), "{arguments:?}: {}", call.err);
        assert!(call.err.contains(why), "{arguments:?}: {}", call.err);
    }
    assert_eq!(links(), before);
    // What a run wrote, the next one replaces.
    let again = ["--record", "x.mcap", "--summary", "s.parquet"];
    for _ in 0..2 {
        let call = program.call(&[&run, again.as_slice()].concat());
        assert_eq!(call.code, Some(0), "{}", call.err);
    }
}
