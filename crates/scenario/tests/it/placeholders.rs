//! Placeholders of scenario variables, in scenarios and in their worlds. The original replaced none in
//! world files.

use crate::shown;
use simbeeotic_scenario::{
    Checked, Request, check_file, convert_file, convert_world, load_file, load_text, render,
};
use simbeeotic_units::Length;
use simbeeotic_world::{ObstacleShape, World};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const TOML_WORLD: &str = r#"
[[obstacle]]
position = ["${far} m", "0 m", "0 m"]
label = "rock ${far}"
shape = { sphere = { radius = "${rock}" } }
[[patch]]
center = ["0 m", "0 m", "0 m"]
radius = "${meadow}:2 m"
flowers_per_m2 = "${density}:3"
"#;

const XML_WORLD: &str = r#"<world>
  <obstacles><obstacle><sphere radius="${rock}"><position x="${far}" y="0"/></sphere>
    <label>rock ${far}</label></obstacle></obstacles>
  <flowers><patch><center x="0" y="0"/><radius>${meadow}:2</radius><density>${density}:3</density></patch></flowers>
</world>"#;

const TOML_SCENARIO: &str = "[run]\nend_time = \"1 s\"\n[variables]\nrock = \"1.5 m\"\nfar = 7\n";

const XML_SCENARIO: &str = r#"<scenario><master-seed><constant value="1"/></master-seed>
  <simulation><end-time>1</end-time></simulation><models/>
  <looping><variables>
    <variable name="rock"><constant value="1.5"/></variable>
    <variable name="far"><for from="7" to="9"/></variable>
  </variables></looping></scenario>"#;

fn folder(files: &[(&str, &str)]) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        fs::write(folder.path().join(name), text).expect("written");
    }
    folder
}

fn world(folder: &Path, scenario: &str, world: &str, sets: &[&str]) -> Result<World, String> {
    let request = Request {
        world: Some(folder.join(world)),
        sets: sets.iter().map(|set| (*set).to_owned()).collect(),
    };
    match load_file(&folder.join(scenario), &request) {
        Ok(loaded) => Ok((*loaded.plan().world).clone()),
        Err(rejected) => Err(shown(&rejected)),
    }
}

fn radius_m(world: &World) -> f64 {
    match world.obstacles[0].shape {
        ObstacleShape::Sphere { radius } => radius.get(),
        _ => f64::NAN,
    }
}

#[test]
fn a_world_has_the_values_of_its_scenario_in_both_languages() {
    let folder = folder(&[
        ("s.toml", TOML_SCENARIO),
        ("s.xml", XML_SCENARIO),
        ("w.toml", TOML_WORLD),
        ("w.xml", XML_WORLD),
    ]);
    let read = |scenario, name| {
        let read = world(folder.path(), scenario, name, &[]);
        read.unwrap_or_else(|said| panic!("{scenario} {name}:\n{said}"))
    };
    for (scenario, name) in [
        ("s.toml", "w.toml"),
        ("s.toml", "w.xml"),
        ("s.xml", "w.xml"),
    ] {
        let world = read(scenario, name);
        assert_eq!(radius_m(&world), 1.5, "{scenario} {name}");
        assert_eq!(world.obstacles[0].position.si().x, 7.0);
        assert_eq!(world.patches[0].radius, Length::si(2.0));
        assert_eq!(world.patches[0].flowers_per_m2, 3.0);
    }
    assert_eq!(read("s.toml", "w.toml").obstacles[0].label, "rock 7");
    // An XML scenario's variables have no units: a TOML world says them.
    let with_unit = TOML_WORLD.replace("\"${rock}\"", "\"${rock} m\"");
    fs::write(folder.path().join("w.toml"), with_unit).expect("written");
    assert_eq!(radius_m(&read("s.xml", "w.toml")), 1.5);
}

#[test]
fn variables_are_set_from_the_command_line_and_misspelt_ones_are_guessed() {
    let folder = folder(&[("s.toml", TOML_SCENARIO), ("w.toml", TOML_WORLD)]);
    let sets = ["variables.rock=2 m", "variables.density=5"];
    let changed = world(folder.path(), "s.toml", "w.toml", &sets).expect("good");
    assert_eq!(
        (radius_m(&changed), changed.patches[0].flowers_per_m2),
        (2.0, 5.0)
    );
    let misspelt = TOML_WORLD.replace("${rock}", "${rocks}");
    fs::write(folder.path().join("w.toml"), misspelt).expect("written");
    let said = world(folder.path(), "s.toml", "w.toml", &[]).expect_err("unknown");
    assert!(said.contains("unknown variable `rocks`"), "{said}");
    assert!(said.contains("w.toml:5:"), "{said}");
    assert!(said.contains("did you mean `rock`?"), "{said}");
}

#[test]
fn a_toml_scenario_has_placeholders_too() {
    let scenario = "[run]\nend_time = \"${end}\"\nseed = \"${seed}\"\n\
                    [variables]\nend = \"3 s\"\nseed = 5\n";
    let loaded = crate::good("x.toml", scenario);
    assert_eq!(loaded.plan().run.seed, 5);
    let said = crate::bad("x.toml", &scenario.replace("seed = 5", "sed = 5"));
    assert!(said.contains("x.toml:3:8"), "{said}");
}

#[test]
fn a_converted_world_has_the_values_of_the_first_variation() {
    let folder = folder(&[("s.xml", XML_SCENARIO), ("w.xml", XML_WORLD)]);
    let scenario = folder.path().join("s.xml");
    let converted = convert_file(&scenario, Some(&folder.path().join("w.xml")));
    let variables = converted
        .unwrap_or_else(|r| panic!("{}", shown(&r)))
        .variables;
    let world = convert_world(&folder.path().join("w.xml"), &variables);
    let toml = world.unwrap_or_else(|r| panic!("{}", shown(&r))).toml;
    assert!(
        toml.contains("position = [\"7 m\", \"0 m\", \"0 m\"]"),
        "{toml}"
    );
}

#[test]
fn a_world_alone_is_checked_as_one() {
    let check = |name: &str, text: &str, sets: &[&str]| {
        let folder = folder(&[(name, text)]);
        let request = Request {
            sets: sets.iter().map(|set| (*set).to_owned()).collect(),
            ..Request::default()
        };
        match check_file(&folder.path().join(name), &request) {
            Ok(Checked::World { world, .. }) => Ok(world.obstacles.len()),
            Ok(Checked::Scenario(_)) => panic!("this is no scenario"),
            Err(rejected) => Err(shown(&rejected)),
        }
    };
    let sets = ["variables.rock=2 m", "variables.far=1"];
    assert_eq!(check("w.toml", TOML_WORLD, &sets), Ok(1));
    let said = check("w.toml", TOML_WORLD, &[]).expect_err("no values");
    assert!(said.contains("--set variables.rock="), "{said}");
    assert_eq!(check("w.xml", "<world/>", &[]), Ok(0));
    let two = "radius = \"5\"\n[[obstacle]]\nshape = { bxo = {} }\n[[person]]\nlabel = 3\n";
    let said = check("w.toml", two, &[]).expect_err("three faults");
    for place in ["w.toml:1:10", "w.toml:3:11", "w.toml:5:9"] {
        assert!(said.contains(place), "{said}");
    }
    let said = check("w.toml", "radius = \"5 m\"\n", &["run.seed=3"]).expect_err("no run here");
    assert!(said.contains("only its variables are set"), "{said}");
}

#[test]
fn a_world_in_the_place_of_a_scenario_is_told_once() {
    for (name, text) in [
        ("w.toml", "[[obstacle]]\n[[person]]\n"),
        ("w.xml", "<world/>"),
    ] {
        let folder = folder(&[(name, text)]);
        let rejected = load_file(&folder.path().join(name), &Request::default());
        let said = shown(&rejected.err().expect("it is a world"));
        assert_eq!(said.matches("error:").count(), 1, "{said}");
        assert!(
            said.contains("this is a world, and a scenario is wanted"),
            "{said}"
        );
    }
}

/// What a mistyped name would otherwise do is nothing, in silence.
#[test]
fn a_variable_that_nothing_uses_is_an_error_on_the_command_line_and_a_warning_in_a_file() {
    let text = "[variables]\nend = \"1 s\"\nspare = 3\n\n[run]\nend_time = \"${end}\"\n";
    let request = |set: &str| Request {
        sets: vec![set.to_owned()],
        ..Request::default()
    };
    let good = load_text("x.toml", text, &request("variables.end=2 s")).expect("it is right");
    let warned: Vec<_> = good.faults().iter().map(|f| f.message.as_str()).collect();
    assert!(
        warned.contains(&"variable `spare` stands for nothing: no placeholder names it"),
        "{warned:?}"
    );
    let wrong = load_text("x.toml", text, &request("variables.ends=2 s"));
    let wrong = wrong.err().expect("nothing uses it");
    let shown = render::faults(&wrong.faults, &wrong.sources, false);
    assert!(
        shown.contains("variable `ends` stands for nothing"),
        "{shown}"
    );
    assert!(shown.contains("did you mean `end`?"), "{shown}");
    assert!(shown.contains("command line:1:"), "{shown}");
}
