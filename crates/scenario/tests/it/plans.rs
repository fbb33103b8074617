//! What a good scenario means.

use crate::{TOML, bad, good};
use simbeeotic_scenario::print::same;
use simbeeotic_scenario::{Request, load_text};

const RUN: &str = "[run]\nend_time = \"1 s\"\n";

fn paths(text: &str) -> Vec<String> {
    let setup = good("x.toml", text).setup().expect("a set-up");
    setup.models.into_iter().map(|m| m.path).collect()
}

#[test]
fn every_section_is_read() {
    let loaded = good("everything.toml", TOML);
    let plan = loaded.plan();
    assert_eq!(
        (plan.name.as_str(), plan.run.seed, plan.run.threads),
        ("everything", 7, 2)
    );
    assert_eq!(plan.run.limits.end.as_secs_f64(), 2.5);
    assert_eq!(plan.run.limits.rounds_per_instant, 100);
    assert_eq!(plan.run.pace, Some(4.0));
    assert_eq!(plan.physics.gravity.get(), 9.81);
    assert_eq!(plan.physics.ground.map(|g| g.friction), Some(0.6));
    assert!(plan.weather.is_some() && plan.channel.is_some());
    let setup = loaded.setup().expect("a set-up");
    let count = |word: &str| {
        setup
            .models
            .iter()
            .filter(|m| m.path.starts_with(word))
            .count()
    };
    assert_eq!((count("hive"), count("bee-"), count("relay-")), (3, 20, 4));
    let relay = &setup.models[setup.models.len() - 1];
    assert_eq!(relay.start.position.si().to_array(), [2.0, 2.0, 5.0]);
    assert_eq!(relay.start.attitude.yaw().angle().degrees().round(), 90.0);
    assert_eq!(
        relay
            .gear
            .radios
            .iter()
            .map(|r| r.name.as_str())
            .collect::<Vec<_>>(),
        ["short", "long"]
    );
}

#[test]
fn printed_and_read_again_it_is_the_same() {
    let loaded = good("everything.toml", TOML);
    let again = good("again.toml", &loaded.toml());
    assert!(same(loaded.tree(), again.tree()), "{}", loaded.toml());
    insta::assert_snapshot!("everything_toml_printed", loaded.toml());
}

#[test]
fn names_count_from_zero_where_there_are_several() {
    let text = format!(
        "{RUN}[[model]]\nuse = \"inert-bee\"\n[[model]]\nuse = \"inert-bee\"\nname = \"b\"\ncount = 2\n\
         [[model.model]]\nuse = \"inert-bee\"\n"
    );
    assert_eq!(
        paths(&text),
        ["inert-bee", "b-0", "b-0/inert-bee", "b-1", "b-1/inert-bee"]
    );
}

#[test]
fn a_start_with_places_needs_no_count() {
    let text = format!(
        "{RUN}[[model]]\nuse = \"inert-bee\"\nstart = {{ list = [[\"0 m\", \"0 m\", \"1 m\"], [\"0 m\", \"0 m\", \"2 m\"]] }}\n"
    );
    assert_eq!(paths(&text), ["inert-bee-0", "inert-bee-1"]);
    let said = bad("x.toml", &text.replace("use = ", "count = 3\nuse = "));
    assert!(
        said.contains("2 places to start from for 3 models"),
        "{said}"
    );
}

#[test]
fn adding_a_model_moves_no_other() {
    let bees = |n: u32| {
        let text = format!(
            "{RUN}[[model]]\nuse = \"inert-bee\"\ncount = {n}\nstart = {{ ball = \"20 m\" }}\n"
        );
        good("x.toml", &text).setup().expect("a set-up").models
    };
    let (few, many) = (bees(10), bees(11));
    assert!(
        few.iter()
            .zip(&many)
            .all(|(a, b)| a.path == b.path && a.start == b.start)
    );
}

#[test]
fn a_seed_may_be_any_of_64_bits() {
    for (seed, bits) in [
        ("0", 0),
        ("-1", u64::MAX),
        ("9223372036854775807", i64::MAX as u64),
    ] {
        let text = format!("{RUN}seed = {seed}\n[[model]]\nuse = \"inert-bee\"\n");
        assert_eq!(good("x.toml", &text).plan().run.seed, bits);
    }
}

#[test]
fn what_flies_has_a_vehicle_and_what_does_not_has_none() {
    let setup = good(
        "x.toml",
        &format!("{RUN}[[model]]\nuse = \"inert-bee\"\n[[model]]\nuse = \"simple-hive\"\n"),
    )
    .setup()
    .expect("a set-up");
    assert!(setup.models[0].vehicle.is_some() && setup.models[1].vehicle.is_none());
    let said = bad(
        "x.toml",
        &format!("{RUN}[[model]]\nuse = \"simple-hive\"\nvehicle = \"simple-bee\"\n"),
    );
    assert!(said.contains("`simple-hive` does not fly"), "{said}");
}

#[test]
fn a_radio_without_a_channel_is_warned_of() {
    for radio in ["{ use = \"cc2420\" }", "\"cc2420\""] {
        let loaded = good(
            "x.toml",
            &format!("{RUN}[[model]]\nuse = \"inert-bee\"\nradio = {radio}\n"),
        );
        assert_eq!(loaded.faults().len(), 1);
        assert!(loaded.faults()[0].message.contains("heard by nobody"));
        let setup = loaded.setup().expect("a set-up");
        let [only] = &setup.models[0].gear.radios[..] else {
            panic!("one radio");
        };
        assert_eq!(only.name, "radio");
    }
}

#[test]
fn a_channel_may_be_off() {
    let loaded = good(
        "x.toml",
        &format!(
            "{RUN}[channel]\nuse = \"free-space\"\nmedium = \"off\"\n[[model]]\nuse = \"inert-bee\"\n"
        ),
    );
    assert!(loaded.setup().expect("a set-up").medium.is_none());
}

#[test]
fn a_run_can_be_set_up_many_times() {
    let loaded = good("everything.toml", TOML);
    let (a, b) = (
        loaded.setup().expect("a set-up"),
        loaded.setup().expect("a set-up"),
    );
    assert_eq!(a.models.len(), b.models.len());
}

#[test]
fn the_origin_holds_the_scenario_as_it_ran() {
    let request = Request {
        sets: vec!["run.seed=99".into()],
        ..Request::default()
    };
    let loaded = load_text("everything.toml", TOML, &request).unwrap_or_else(|_| panic!("good"));
    let origin = loaded.setup().expect("a set-up").origin;
    assert_eq!((origin.seed, origin.name.as_str()), (99, "everything"));
    assert!(origin.scenario.contains("seed = 99"));
    assert!(same(good("origin", &origin.scenario).tree(), loaded.tree()));
}

#[test]
fn paths_that_occur_twice_are_found_however_they_come_about() {
    let entry = |name: &str, count: &str| {
        format!("[[model]]\nuse = \"inert-bee\"\nname = \"{name}\"\n{count}\n")
    };
    let clash = |a: (&str, &str), b: (&str, &str)| {
        let text = format!("{RUN}{}{}", entry(a.0, a.1), entry(b.0, b.1));
        load_text("x.toml", &text, &Request::default()).is_err()
    };
    let (one, three, none) = ("", "count = 3", "count = 0");
    assert!(clash(("a", one), ("a", one)));
    assert!(clash(("a", three), ("a", three)));
    assert!(clash(("a", three), ("a-2", one)) && clash(("a-2", one), ("a", three)));
    assert!(!clash(("a", three), ("a-3", one)) && !clash(("a-3", one), ("a", three)));
    assert!(!clash(("a", three), ("a-02", one)) && !clash(("a", three), ("a", one)));
    assert!(!clash(("a", none), ("a", three)) && !clash(("a", none), ("a-0", one)));
    assert!(!clash(("a-1", three), ("a", three)));
}

#[test]
fn a_vehicle_says_how_wide_it_is_as_it_likes() {
    let scenario = |shape: &str| {
        format!(
            "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\n\
             vehicle = {{ use = \"simple-bee\", shape = {{ {shape} }} }}\n"
        )
    };
    for shape in [
        "sphere = { radius = \"5 cm\" }",
        "sphere = { diameter = \"10 cm\" }",
        "cylinder = { radius = \"5 cm\", height = \"3 cm\" }",
    ] {
        good("x.toml", &scenario(shape)).setup().expect(shape);
    }
    for (shape, word) in [
        ("sphare = { diameter = \"1 m\" }", "did you mean `sphere`?"),
        ("sphere = { diamter = \"1 m\" }", "did you mean `diameter`?"),
        ("sphere = {}", "`diameter` is missing here"),
        ("cone = { diameter = \"1 m\" }", "`height` is missing here"),
        (
            "cone = { diameter = \"1 m\", radius = \"1 m\", height = \"1 m\" }",
            "one will do",
        ),
    ] {
        let said = bad("x.toml", &scenario(shape));
        assert!(said.contains(word), "{shape}: {said}");
        // What a misspelt key leaves missing is told too.
        let errors = 1 + usize::from(shape.contains("diamter"));
        assert_eq!(said.matches("error:").count(), errors, "{shape}: {said}");
    }
}
