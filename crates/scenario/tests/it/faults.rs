//! What a wrong scenario says: as the user sees it.

use crate::{bad, shown};
use simbeeotic_scenario::{Request, load_text};

#[test]
fn several_faults_of_one_file_are_shown_together() {
    let text = r#"[run]
seed = "seven"
end_time = 10

[chanel]
use = "free-space"

[[model]]
use = "instrument-bea"

[[model]]
use = "instrument-bee"
cuont = 3
start = { ball = "20" }

[model.params]
heading_sgima = "12 deg"
max_speed = "2 m"
radio_period = "0 s"

[model.vehicle]
use = "simple-bee"
mass = "-1 kg"
phase = "sometimes"

[model.sensor.compass]
use = "compas"

[model.radio]
use = "cc2420"
tx_level = 99
antena = "isotropic"
"#;
    insta::assert_snapshot!(bad("swarm.toml", text));
}

#[test]
fn faults_of_syntax_are_shown_together() {
    insta::assert_snapshot!(bad(
        "swarm.toml",
        "[run\nseed = \nend_time = \"1 s\nx = 1\nx = 2\n"
    ));
}

#[test]
fn two_models_of_one_name_show_both_places() {
    let text = "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\nname = \"bee-1\"\n\
                [[model]]\nuse = \"inert-bee\"\nname = \"bee\"\ncount = 3\n";
    insta::assert_snapshot!(bad("swarm.toml", text));
}

#[test]
fn a_fault_of_an_override_shows_the_override() {
    let text = "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"instrument-bee\"\nname = \"bee\"\n";
    let sets = [
        "model.bee.parms.heading_sigma=0.1 rad",
        "model.bee.params.max_speed=3",
        "run.end_tme=1 s",
    ];
    let request = Request {
        sets: sets.map(str::to_owned).to_vec(),
        ..Request::default()
    };
    let rejected = load_text("swarm.toml", text, &request)
        .err()
        .expect("wrong");
    insta::assert_snapshot!(shown(&rejected));
}

#[test]
fn a_missing_section_says_what_to_add() {
    insta::assert_snapshot!(bad("swarm.toml", "[[model]]\nuse = \"inert-bee\"\n"));
}

/// The faults of a scenario with some lines more.
fn with(lines: &str) -> String {
    bad("x.toml", &format!("{lines}\n[run]\nend_time = \"1 s\"\n"))
}

#[test]
fn the_name_of_a_part_where_its_table_is_wanted_shows_the_table() {
    let model = |line: &str| with(&format!("model = [{{ use = \"instrument-bee\", {line} }}]"));
    for (said, help) in [
        (model("radio = \"cc240\""), "did you mean `cc2420`?"),
        (
            model("sensor.c = \"compas\""),
            "write: sensor.c = { use = \"compass\" }",
        ),
        (
            model("sensor = \"compass\""),
            "write: sensor.compass = { use = \"compass\" }",
        ),
        (
            with("weather = \"constant-weather\""),
            "write: weather = { use = \"constant-weather\" }",
        ),
        (
            with("channel = \"free-space\""),
            "write: channel = { use = \"free-space\" }",
        ),
    ] {
        assert!(said.contains(help) && said.contains("x.toml:1:"), "{said}");
    }
    let vehicle = "model = [{ use = \"instrument-bee\", vehicle = \"simple-bee\" }]";
    crate::good("x.toml", &format!("{vehicle}\n[run]\nend_time = \"1 s\"\n"));
}

#[test]
fn gear_that_sits_too_far_away_shows_its_place() {
    let radio = "{ use = \"cc2420\", mount = { position = [\"0 m\", \"0 m\", \"2 km\"] } }";
    let said = with(&format!(
        "model = [{{ use = \"instrument-bee\", radio = {radio} }}]"
    ));
    assert!(
        said.contains("gear sits within 1000 m") && said.contains("x.toml:1:"),
        "{said}"
    );
}

#[test]
fn a_start_of_nothing_shows_its_place() {
    let said = with("model = [{ use = \"inert-bee\", start = [] }]");
    assert!(
        said.contains("this list is empty; wanted: three quantities")
            && said.contains("x.toml:1:39"),
        "{said}"
    );
}

#[test]
fn times_of_less_than_a_nanosecond_are_refused() {
    for key in ["end_time", "wall_time"] {
        let end = if key == "end_time" {
            ""
        } else {
            "end_time = \"1 s\""
        };
        let said = bad("x.toml", &format!("[run]\n{key} = \"0.1 ns\"\n{end}\n"));
        assert!(
            said.contains("nanosecond") && said.contains("x.toml:2:"),
            "{said}"
        );
    }
    let said = with("physics = { list_period = \"0.1 ns\" }");
    assert!(said.contains("x.toml:1:27"), "{said}");
}

#[test]
fn a_seed_may_be_negative_and_keeps_its_sign_when_converted() {
    let text = "[run]\nseed = -5\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\n";
    let loaded = crate::good("x.toml", text);
    assert_eq!(loaded.plan().run.seed as i64, -5);
    assert!(loaded.faults().is_empty());
    assert!(loaded.toml().contains("seed = -5\n"));
    let said = bad("x.toml", &text.replace("-5", "18446744073709551611"));
    assert!(said.contains("x.toml:2:8"), "{said}");
}

#[test]
fn empty_files_are_called_empty() {
    for text in [
        "",
        " \n\n",
        "\u{feff}",
        "<!-- nothing -->\n",
        "<?xml version=\"1.0\"?>\n",
    ] {
        let said = bad("x.toml", text);
        assert!(
            said.contains("this file is empty") && said.contains("x.toml:1:"),
            "{said}"
        );
    }
}

#[test]
fn so_many_models_say_how_much_memory_they_take() {
    let scenario = |outer: u64, inner: u64| {
        format!(
            "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\ncount = {outer}\n\
             [[model.model]]\nuse = \"inert-bee\"\ncount = {inner}\n"
        )
    };
    for (outer, inner) in [(4_000_001, 0), (2_000, 2_000)] {
        let said = bad("x.toml", &scenario(outer, inner));
        assert!(
            said.contains("are more than 4000000") && said.contains("4.8 GB"),
            "{said}"
        );
    }
    let loaded = crate::good("x.toml", &scenario(1_000, 1_000));
    let said = simbeeotic_scenario::render::faults(loaded.faults(), loaded.sources(), false);
    assert!(
        said.contains("1001000 models take about 1.2 GB of memory"),
        "{said}"
    );
    let loaded = crate::good("x.toml", &scenario(1_000, 999));
    assert!(loaded.faults().is_empty());
}

#[test]
fn a_part_of_another_kind_says_so() {
    let text = "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"compass\"\n";
    let said = bad("swarm.toml", text);
    assert!(said.contains("`compass` is a sensor"), "{said}");
}
