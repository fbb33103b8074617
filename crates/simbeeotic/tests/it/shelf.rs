//! What `list`, `describe` and `schema` say of the shelf.

use crate::program::Program;

#[test]
fn the_shelf_is_listed_by_kind() {
    let call = Program::new().call(&["list"]);
    for name in [
        "instrument-bee",
        "random-walk-bee",
        "simple-hive",
        "simple-bee",
        "compass",
        "cc2420",
        "free-space",
        "recorder",
    ] {
        assert!(call.out.contains(name), "{name} is not in:\n{}", call.out);
    }
    let sensors = Program::new().call(&["list", "sensors"]);
    assert!(
        sensors.out.contains("compass") && !sensors.out.contains("cc2420"),
        "{}",
        sensors.out
    );
    let wrong = Program::new().call(&["list", "sensros"]);
    assert_eq!(wrong.code, Some(2));
    assert!(
        wrong.err.contains("did you mean `sensor`?"),
        "{}",
        wrong.err
    );
}

#[test]
fn a_part_is_described_with_units_defaults_and_its_old_name() {
    let call = Program::new().call(&["describe", "simple-bee"]);
    for words in [
        "max_acceleration = \"1 m/s^2\"",
        "The most that the actuators accelerate",
        "unit: m/s^2",
        "one of: none, detect, respond",
    ] {
        assert!(call.out.contains(words), "{words} is not in:\n{}", call.out);
    }
    let java = Program::new().call(&["describe", "harvard.robobees.simbeeotic.model.SimpleHive"]);
    assert!(java.out.starts_with("simple-hive"), "{}", java.out);
    let wrong = Program::new().call(&["describe", "simple-be"]);
    assert_eq!(wrong.code, Some(2));
    assert!(
        wrong.err.contains("did you mean `simple-bee`?"),
        "{}",
        wrong.err
    );
}

#[test]
fn the_settings_of_physics_are_described_like_a_part() {
    let call = Program::new().call(&["describe", "physics"]);
    for words in [
        "gravity = \"9.80665 m/s^2\"",
        "list_period = \"0.1 s\"",
        "solver_iterations = 4",
        "island_step = ",
        "Coulomb friction of the ground",
        "unit: s",
    ] {
        assert!(call.out.contains(words), "{words} is not in:\n{}", call.out);
    }
}

#[test]
fn the_schema_knows_every_part() {
    let call = Program::new().call(&["schema"]);
    let schema: serde_json::Value = serde_json::from_str(&call.out).expect("JSON");
    assert!(schema["$schema"].is_string());
    for name in ["instrument-bee", "compass", "cc2420"] {
        assert!(
            call.out.contains(&format!("\"{name}\"")),
            "{name} is not in the schema"
        );
    }
}
