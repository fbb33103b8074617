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

#[test]
fn a_part_of_another_kind_says_so() {
    let text = "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"compass\"\n";
    let said = bad("swarm.toml", text);
    assert!(said.contains("`compass` is a sensor"), "{said}");
}
