//! `like`: a model that is as one before it.

use crate::{bad, good, shown};
use simbeeotic_model::config::Node;
use simbeeotic_scenario::{Loaded, Request, load_text};

const SWARM: &str = r#"[run]
end_time = "1 s"

[variables]
other = "bee"

[[model]]
use = "simple-hive"
name = "hive"

[[model.model]]
use = "instrument-bee"
name = "bee"
count = 3
start = { point = ["1 m", "0 m", "0 m"] }
params = { max_speed = "2 m/s", use_radio = false }
vehicle = { use = "simple-bee", mass = "50 g" }
battery = "1s-170mah"

[model.model.sensor]
compass = { use = "compass", sigma = "2 deg" }

[[model.model]]
like = "${other}"
name = "wasp"
count = 2
vehicle = { mass = "70 g" }
"#;

fn loaded(sets: &[&str]) -> Loaded {
    let request = Request {
        sets: sets.iter().map(|set| (*set).to_owned()).collect(),
        ..Request::default()
    };
    match load_text("swarm.toml", SWARM, &request) {
        Ok(loaded) => loaded,
        Err(rejected) => panic!("{}", shown(&rejected)),
    }
}

/// What stands in an entry of the hive, keys with dots between them; empty if nothing does.
fn value(loaded: &Loaded, at: usize, path: &str) -> String {
    let models = |node: &Node, at: usize| {
        let list = node.as_table().and_then(|t| t.get("model")).cloned();
        list.and_then(|list| list.as_array().map(|models| models[at].clone()))
            .expect("a model")
    };
    let mut node = models(&models(loaded.tree(), 0), at);
    for key in path.split('.') {
        match node.as_table().and_then(|t| t.get(key)).cloned() {
            Some(inner) => node = inner,
            None => return String::new(),
        }
    }
    simbeeotic_scenario::print::value(&node)
}

#[test]
fn a_model_flies_what_the_one_that_it_is_like_flies() {
    let loaded = loaded(&[]);
    let nested = &loaded.plan().models[0].nested;
    let names: Vec<(&str, u64, &str)> = (nested.iter())
        .map(|g| (g.name.as_str(), g.count, g.part.label.name))
        .collect();
    let wanted = [("bee", 3, "instrument-bee"), ("wasp", 2, "instrument-bee")];
    assert_eq!(names, wanted);
    assert_eq!(value(&loaded, 1, "vehicle.use"), "\"simple-bee\"");
    assert_eq!(value(&loaded, 1, "vehicle.mass"), "\"70 g\"");
    assert_eq!(value(&loaded, 1, "sensor.compass.sigma"), "\"2 deg\"");
    assert_eq!(value(&loaded, 1, "start"), "");
    // What is printed is the same scenario, without what it is like.
    let printed = good("printed.toml", &loaded.toml());
    assert_eq!(printed.toml(), loaded.toml());
    assert!(!loaded.toml().contains("like"), "{}", loaded.toml());
}

#[test]
fn a_value_set_in_the_first_reaches_both_and_one_set_in_the_second_only_that() {
    let both = loaded(&["model.hive.model.bee.params.max_speed=3 m/s"]);
    let second = loaded(&["model.hive.model.wasp.sensor.compass.sigma=5 deg"]);
    for (loaded, path, values) in [
        (&both, "params.max_speed", ["\"3 m/s\"", "\"3 m/s\""]),
        (&second, "sensor.compass.sigma", ["\"2 deg\"", "\"5 deg\""]),
        (
            &second,
            "sensor.compass.use",
            ["\"compass\"", "\"compass\""],
        ),
    ] {
        assert_eq!([0, 1].map(|at| value(loaded, at, path)), values, "{path}");
    }
    let battery = loaded(&["model.hive.model.wasp.battery.avionics=50 mA"]);
    assert_eq!(value(&battery, 1, "battery.preset"), "\"1s-170mah\"");
    assert_eq!(value(&battery, 0, "battery"), "\"1s-170mah\"");
}

#[test]
fn another_vehicle_comes_with_its_own_parameters() {
    let text = SWARM.replace("vehicle = { mass = \"70 g\" }\n", "");
    for set in ["vehicle=ghost", "vehicle.use=ghost"] {
        let request = Request {
            sets: vec![format!("model.hive.model.wasp.{set}")],
            ..Request::default()
        };
        // `ghost` has no mass.
        match load_text("swarm.toml", &text, &request) {
            Ok(loaded) => {
                assert_eq!(value(&loaded, 1, "vehicle.mass"), "", "{set}");
                assert_eq!(value(&loaded, 0, "vehicle.mass"), "\"50 g\"", "{set}");
            }
            Err(rejected) => panic!("{set}: {}", shown(&rejected)),
        }
    }
}

#[test]
fn a_sweep_varies_what_is_only_taken_over() {
    let loaded = loaded(&[
        "--vary model.hive.model.wasp.sensor.compass.sigma=1 deg,3 deg",
        "--vary model.hive.model.bee.params.max_speed=1 m/s,4 m/s",
    ]);
    let sweep = loaded.sweep().expect("it varies");
    assert_eq!(sweep.len(), 4);
    let last = sweep.load(3).unwrap_or_else(|r| panic!("{}", shown(&r)));
    assert_eq!(value(&last, 0, "sensor.compass.sigma"), "\"2 deg\"");
    assert_eq!(value(&last, 1, "sensor.compass.sigma"), "\"3 deg\"");
    assert_eq!(value(&last, 1, "params.max_speed"), "\"4 m/s\"");
    let text = loaded.toml_with_sweep();
    assert!(text.contains("like = \"${other}\""), "{text}");
    assert_eq!(good("again.toml", &text).sweep().map(|s| s.len()), Some(4));
}

#[test]
fn a_wrong_value_is_told_once_where_it_was_written() {
    let text = SWARM.replace("\"2 m/s\"", "\"2 m\"");
    insta::assert_snapshot!(bad("swarm.toml", &text), @r#"
    error: unknown unit "m" for a speed; use one of m/s, cm/s, mm/s, km/h
      --> swarm.toml:16:24
       |
    16 | params = { max_speed = "2 m", use_radio = false }
       |                        ^^^^^

    1 error in swarm.toml
    "#);
}

#[test]
fn a_name_of_no_model_before_it_is_told_with_a_guess() {
    let text = SWARM.replace("other = \"bee\"", "other = \"bea\"");
    insta::assert_snapshot!(bad("swarm.toml", &text), @r#"
    error: unknown model `bea`
      --> swarm.toml:24:8
       |
    24 | like = "${other}"
       |        ^^^^^^^^^^
       |
       = help: did you mean `bee`?

    1 error in swarm.toml
    "#);
}

#[test]
fn two_models_without_a_name_that_are_like_one_are_told_at_the_second() {
    let text = SWARM.replace("name = \"wasp\"\n", "");
    assert!(load_text("swarm.toml", &text, &Request::default()).is_ok());
    let twice = format!("{text}\n[[model.model]]\nlike = \"bee\"\ncount = 2\n");
    insta::assert_snapshot!(bad("swarm.toml", &twice), @r#"
    error: a second model called `instrument-bee-0`
      --> swarm.toml:29:8
       |
    29 | like = "bee"
       |        ^^^^^
       |
       = help: the other one is at swarm.toml:24:8; give one of them another `name`

    1 error in swarm.toml
    "#);
}
