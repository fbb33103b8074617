//! `[sweep]`: what runs, in which order, and what is told of one that cannot.

use crate::{bad, good};
use simbeeotic_scenario::{Loaded, Request, load_text, render};

const BEES: &str = r#"
[run]
end_time = "1 s"
seed = 4

[variables]
far = 10
twice = "${far}"

[[model]]
use = "inert-bee"
name = "bee"
count = 3
start = ["${far} m", "${twice} m", "1 m"]
"#;

fn with(sweep: &str) -> String {
    format!("{BEES}\n{sweep}")
}

fn loaded(sweep: &str, sets: &[&str]) -> Loaded {
    let request = Request {
        sets: sets.iter().map(|set| (*set).to_owned()).collect(),
        ..Request::default()
    };
    load_text("bees.toml", &with(sweep), &request)
        .unwrap_or_else(|r| panic!("{}", render::faults(&r.faults, &r.sources, false)))
}

/// Seed and values of each run.
fn runs(loaded: &Loaded) -> Vec<String> {
    let sweep = loaded.sweep().expect("a sweep");
    let run = |at| {
        let seed = sweep
            .seed(at)
            .map_or("-".to_owned(), |seed| seed.to_string());
        format!("{seed} {}", sweep.values(at).join(" "))
    };
    (0..sweep.len()).map(run).collect()
}

fn said(sweep: &str) -> String {
    bad("bees.toml", &with(sweep))
}

#[test]
fn all_combinations_run_the_last_key_first_and_the_seeds_last() {
    let loaded = loaded(
        "[sweep]\nseeds = [7, 5]\n[sweep.vary]\n\"model.bee.count\" = { from = 1, to = 3, step = 2 }\n\
         \"variables.far\" = [5, 6]",
        &[],
    );
    let wanted = [
        "7 1 5", "7 1 6", "7 3 5", "7 3 6", "5 1 5", "5 1 6", "5 3 5", "5 3 6",
    ];
    assert_eq!(runs(&loaded), wanted);
    let sweep = loaded.sweep().expect("a sweep");
    assert_eq!(
        sweep.keys().collect::<Vec<_>>(),
        ["model.bee.count", "variables.far"]
    );
    let last = sweep.load(7).unwrap_or_else(|_| panic!("good"));
    let setup = last.setup().expect("a set-up");
    assert_eq!((setup.origin.seed, setup.models.len()), (5, 3));
    let start = setup.models[0].start.position.si().to_array();
    assert_eq!(
        start,
        [6.0, 6.0, 1.0],
        "a variable made of the other varies with it"
    );
    assert!(
        !last.toml().contains("sweep"),
        "the scenario of one run: {}",
        last.toml()
    );
    assert!(sweep.load(8).is_err(), "there is no such run");
}

#[test]
fn alone_a_scenario_is_what_stands_in_it() {
    let text =
        with("[sweep]\nseeds = 3\n[sweep.vary]\nmodel.bee.count = [5, 6]\nvariables.far = [1, 2]");
    let loaded = good("bees.toml", &text);
    let setup = loaded.setup().expect("a set-up");
    assert_eq!((setup.models.len(), loaded.plan().run.seed), (3, 4));
    let start = setup.models[0].start.position.si().to_array();
    assert_eq!(start, [10.0, 10.0, 1.0]);
    assert!(!loaded.is_first_of_sweep());
    assert!(!loaded.toml().contains("sweep"), "{}", loaded.toml());
    let seeds = loaded.sweep().and_then(|sweep| sweep.seeds());
    assert_eq!(
        seeds,
        Some([4, 5, 6].as_slice()),
        "the scenario's own and what follows"
    );
}

#[test]
fn a_scenario_that_lacks_a_value_of_its_sweep_is_the_first_of_its_runs() {
    let text = with("[sweep.vary]\n\"run.end_time\" = [\"7 s\", \"8 s\"]");
    let text = text.replace("end_time = \"1 s\"\n", "");
    let loaded = good("bees.toml", &text);
    assert!(loaded.is_first_of_sweep());
    assert!(
        loaded.toml().contains("end_time = \"7 s\""),
        "{}",
        loaded.toml()
    );
    let same = with("[sweep.vary]\nmodel.bee.count = [3, 9]");
    assert!(good("bees.toml", &same).is_first_of_sweep());
    // Of what is wrong without the sweep and with it, both are told.
    let wrong = text.replace("[\"7 s\", \"8 s\"]", "[\"7 m\", \"8 kg\"]");
    let said = bad("bees.toml", &wrong);
    assert_eq!(said.matches("error: unknown unit").count(), 2, "{said}");
}

#[test]
fn what_says_the_same_runs_once() {
    let text = said("[sweep.vary]\nmodel.bee.count = [2, 5, 2]");
    assert!(text.contains("2 stands here twice"), "{text}");
    let of = |sweep: &str| runs(&loaded(sweep, &[])).len();
    assert_eq!(
        of("[sweep.vary]\nmodel.bee.count = { uniform = [1, 3], draws = 40 }"),
        3
    );
    // 5 and 6; 6 alone, since the placeholder says the same.
    assert_eq!(
        of("[sweep.vary]\nvariables.far = [5, 6]\nmodel.bee.count = [\"${far}\", 6]"),
        3
    );
}

#[test]
fn two_names_of_one_value_are_one_key() {
    let text = said("[sweep.vary]\nmodel.bee.count = [1]\n\"model.0.count\" = [2]");
    assert!(
        text.contains("`model.0.count` is `model.bee.count`, which varies already"),
        "{text}"
    );
    let swept = "[sweep.vary]\nmodel.bee.count = [1, 2]";
    let replaced = loaded(swept, &["--vary model.0.count=7,8"]);
    assert_eq!(runs(&replaced), ["4 7", "4 8"]);
}

#[test]
fn a_table_is_put_in_before_what_varies_in_it() {
    let loaded = loaded(
        "[sweep.vary]\n\"run.end_time\" = [\"7 s\"]\nrun = [{ end_time = \"1 s\", seed = 9 }]",
        &[],
    );
    let sweep = loaded.sweep().expect("a sweep");
    let toml = sweep.load(0).unwrap_or_else(|_| panic!("good")).toml();
    assert!(
        toml.contains("end_time = \"7 s\"") && toml.contains("seed = 9"),
        "{toml}"
    );
}

#[test]
fn a_range_may_hang_on_a_variable_that_varies() {
    let loaded = loaded(
        "[sweep.vary]\n\"model.bee.count\" = { from = 1, to = \"${far}\" }\n\"variables.far\" = [3, 1, 2]",
        &[],
    );
    // The key behind the variable that it names.
    assert_eq!(
        runs(&loaded),
        ["4 3 1", "4 3 2", "4 3 3", "4 1 1", "4 2 1", "4 2 2"]
    );
}

#[test]
fn the_command_line_adds_replaces_and_fixes() {
    let sweep = "[sweep]\nseeds = [7, 5]\n[sweep.vary]\nmodel.bee.count = [1, 2]";
    let first = |sets: &[&str]| runs(&loaded(sweep, sets));
    assert_eq!(first(&[]), ["7 1", "7 2", "5 1", "5 2"]);
    assert_eq!(first(&["--vary model.bee.count=8,9"])[1], "7 9");
    assert_eq!(first(&["--vary variables.far=8,9"]).len(), 8);
    assert_eq!(
        first(&["--seeds 3"]),
        ["4 1", "4 2", "5 1", "5 2", "6 1", "6 2"]
    );
    assert_eq!(first(&["--seeds 1..2"]), ["1 1", "1 2", "2 1", "2 2"]);
    assert_eq!(first(&["model.bee.count=3"]), ["7 ", "5 "]);
    assert_eq!(first(&["run.seed=3"]), ["3 1", "3 2"]);
    assert_eq!(loaded(sweep, &["run.seed=3"]).plan().run.seed, 3);
    let both = ["model.bee.count=3", "--vary model.bee.count=8,9"];
    let request = Request {
        sets: both.map(str::to_owned).to_vec(),
        ..Request::default()
    };
    let rejected = load_text("bees.toml", &with(""), &request)
        .err()
        .expect("both");
    let text = render::faults(&rejected.faults, &rejected.sources, false);
    assert!(text.contains("is set here, and varied too"), "{text}");
}

#[test]
fn what_is_wrong_with_an_argument_is_shown_as_it_was_typed() {
    for (arguments, words) in [
        (
            ["--seeds 3..4", "--seed 9"],
            ["1 | --seed 9", "seeds of all runs are listed too"],
        ),
        (
            ["--seeds ", "run.end_time=1 s"],
            ["1 | --seeds ", "there is no value here"],
        ),
        (
            ["--seeds a", "run.end_time=1 s"],
            ["1 | --seeds a", "--seeds 1..20"],
        ),
        (
            ["--seeds 1..5 stepp 1", "run.end_time=1 s"],
            ["in `stepp 1`", "units must be the same"],
        ),
        (
            ["--seeds 2", "--end-time 5 m"],
            ["1 | --end-time 5 m", "unknown unit"],
        ),
    ] {
        let request = Request {
            sets: arguments.map(str::to_owned).to_vec(),
            ..Request::default()
        };
        let Err(rejected) = load_text("bees.toml", &with(""), &request) else {
            panic!("{arguments:?} are wrong");
        };
        let text = render::faults(&rejected.faults, &rejected.sources, false);
        for word in words {
            assert!(text.contains(word), "{word}: {text}");
        }
    }
}

#[test]
fn a_scenario_with_a_sweep_prints_as_it_was_written() {
    let sweep = "[sweep]\nseeds = 3\n\n[sweep.vary]\n\"model.bee.count\" = [5, 6]\n";
    let text = with(sweep);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("bees.toml");
    std::fs::write(&path, text).expect("written");
    let converted = simbeeotic_scenario::convert_file(&path, None);
    let toml = converted.unwrap_or_else(|_| panic!("good")).toml;
    assert!(toml.contains(sweep), "{toml}");
    assert!(toml.contains("\"${far} m\""), "{toml}");
}

#[test]
fn every_fault_of_a_sweep_is_told_at_its_place() {
    insta::assert_snapshot!(said(
        "[sweep]\nseeds = [1, 1, \"x\"]\nsedes = 3\n[sweep.vary]\nmodel.bea.count = [1]\n\
         \"model.bee.cuont\" = [1]\n\"model.bee.count\" = { from = 5, to = 1, step = 1 }\n\
         \"variables.fra\" = [1]\n\"run.end_time\" = { from = \"1 s\", to = \"2 min\" }\n\"sweep.seeds\" = [1]\n"
    ));
}

#[test]
fn every_value_of_a_key_is_checked_not_only_the_first() {
    let text = "[sweep.vary]\n\"model.bee.count\" = [3, -2, 4, \"many\"]\n\"run.end_time\" = [\"1 s\", \"2 m\"]";
    let loaded = good("bees.toml", &with(text));
    let rejected = loaded
        .sweep()
        .expect("a sweep")
        .check()
        .expect_err("three are wrong");
    insta::assert_snapshot!(render::faults(&rejected.faults, &rejected.sources, false));
    // The first value is one of them; the scenario as it stands is fine.
    let loaded = good("bees.toml", &with(&text.replace("[3, -2", "[-3, -2")));
    let all = loaded.sweep().expect("a sweep").check();
    assert_eq!(all.expect_err("four are wrong").faults.len(), 4);
}

#[test]
fn what_a_value_breaks_elsewhere_says_which_value_it_was() {
    let loaded = good(
        "bees.toml",
        &with("[sweep.vary]\n\"variables.far\" = [1, \"x\"]"),
    );
    let rejected = loaded
        .sweep()
        .expect("a sweep")
        .check()
        .expect_err("no position");
    let text = render::faults(&rejected.faults, &rejected.sources, false);
    assert!(text.contains("(with variables.far = x)"), "{text}");
}

#[test]
fn a_sweep_of_too_many_runs_is_refused_with_their_number() {
    let many = "{ from = 1, to = 1000 }";
    let text = said(&format!(
        "[sweep]\nseeds = 2\n[sweep.vary]\n\"model.bee.count\" = {many}\n\"variables.far\" = {many}"
    ));
    assert!(text.contains("these are 2000000 runs"), "{text}");
    let text = said("[sweep.vary]\n\"variables.far\" = [\"${twice}\"]");
    assert!(text.contains("depend on themselves"), "{text}");
    let text = said("[sweep]\nseeds = 2\n[sweep.vary]\n\"run.seed\" = [1]");
    assert!(
        text.contains("says the seeds of the runs already"),
        "{text}"
    );
    for sweep in [
        "sweep = 3",
        "[sweep]\nvary = 3",
        "[sweep]\nseeds = 0",
        "[sweep]\nseeds = []",
    ] {
        let top = format!("{sweep}\n{BEES}");
        let text = if sweep.starts_with('[') {
            with(sweep)
        } else {
            top
        };
        assert!(bad("bees.toml", &text).contains("error: "), "{sweep}");
    }
    let text = bad("bees.toml", &with("[sweeep]\nseeds = 3\n"));
    assert!(text.contains("did you mean `sweep`?"), "{text}");
    let text = bad("bees.toml", &with("[looping]\n"));
    assert!(
        text.contains("what varies stands in `[sweep]` here"),
        "{text}"
    );
}

#[test]
fn draws_of_one_key_do_not_hang_on_other_keys_or_on_the_seed() {
    let drawn = "\"variables.far\" = { uniform = [1.0, 3.0], draws = 3 }";
    let alone = loaded(&format!("[sweep.vary]\n{drawn}"), &[]);
    let other = loaded(
        &format!("[sweep.vary]\n\"model.bee.count\" = [2]\n{drawn}"),
        &["run.seed=9"],
    );
    let values = |loaded: &Loaded| -> Vec<String> {
        let sweep = loaded.sweep().expect("a sweep");
        (0..sweep.len())
            .filter_map(|at| sweep.values(at).pop())
            .collect()
    };
    assert_eq!(values(&alone), values(&other));
    assert_eq!(values(&alone).len(), 3);
}

/// What the original's looping example varies: three lengths, ten masses, a speed, three numbers.
const LOOPING: &str = r#"<scenario>
  <master-seed><constant value="7"/></master-seed>
  <simulation><end-time>1</end-time></simulation>
  <models>
    <model count="2" name="bee">
      <java-class>harvard.robobees.simbeeotic.example.RandomWalkBee</java-class>
      <properties>
        <prop name="length" value="${length}"/>
        <prop name="mass" value="${mass}"/>
        <prop name="max-vel" value="${speed}"/>
        <prop name="heading-sigma" value="${sigma}"/>
      </properties>
    </model>
  </models>
  <looping><variables>
    <variable name="length"><for from="0.1" to="0.3" step="0.1"/></variable>
    <variable name="mass"><uniform-random from="0.1" to="0.2" num-draws="10"/></variable>
    <variable name="speed"><constant value="${length}"/></variable>
    <variable name="sigma"><each><value>0.1</value><value>0.5</value><value>${mass}</value></each></variable>
  </variables></looping>
</scenario>"#;

#[test]
fn the_original_looping_scenario_has_ninety_variations() {
    let loaded = good("looping.xml", LOOPING);
    let sweep = loaded.sweep().expect("a sweep");
    assert_eq!(sweep.len(), 90, "3 x 10 x 1 x 3");
    assert!(loaded.is_first_of_sweep(), "it has no other values");
    assert!(sweep.check().is_ok());
    let last = sweep.load(89).unwrap_or_else(|_| panic!("good"));
    let toml = last.toml();
    let values = sweep.values(89);
    assert_eq!((values[0].as_str(), &values[1]), ("0.3", &values[2]));
    for line in [
        "length = \"0.3 m\"".to_owned(),
        "max_speed = \"0.3 m/s\"".to_owned(),
        format!("mass = \"{} kg\"", values[1]),
    ] {
        assert!(toml.contains(&line), "{line}: {toml}");
    }
    // Its TOML is the same sweep.
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("looping.xml");
    std::fs::write(&path, LOOPING).expect("written");
    let converted = simbeeotic_scenario::convert_file(&path, None);
    let toml = converted.unwrap_or_else(|_| panic!("good")).toml;
    let again = good("looping.toml", &toml);
    let again = again.sweep().expect("a sweep");
    for run in [0, 1, 44, 89] {
        assert_eq!(sweep.values(run), again.values(run));
        let of = |sweep: &simbeeotic_scenario::Sweep| {
            let loaded = sweep.load(run).unwrap_or_else(|_| panic!("good"));
            loaded.tree().clone()
        };
        let (old, new) = (of(sweep), of(again));
        assert!(simbeeotic_scenario::print::same(&old, &new), "{run}");
    }
}

#[test]
fn faults_of_old_variables_are_told_at_their_lines() {
    let broken = LOOPING
        .replace("step=\"0.1\"", "step=\"-0.1\"")
        .replace("<value>${mass}</value>", "<value>${mas}</value>")
        .replace(
            "<constant value=\"${length}\"/>",
            "<constant value=\"${speed}\"/>",
        );
    let said = bad("looping.xml", &broken);
    for place in ["looping.xml:16:", "looping.xml:18:", "looping.xml:19:"] {
        assert!(said.contains(place), "{place} {said}");
    }
    assert!(said.contains("did you mean `mass`?"), "{said}");
    assert!(
        said.contains("variable `speed` depends on itself"),
        "{said}"
    );
    // A value that the model refuses is told at the variable, too.
    let refused = LOOPING.replace("<value>0.5</value>", "<value>wide</value>");
    let loaded = good("looping.xml", &refused);
    let rejected = loaded
        .sweep()
        .expect("a sweep")
        .check()
        .expect_err("no angle");
    let text = render::faults(&rejected.faults, &rejected.sources, false);
    assert!(text.contains("looping.xml:"), "{text}");
}

#[test]
fn what_an_old_scenario_varies_outside_of_properties_varies_too() {
    let varied = LOOPING
        .replace("count=\"2\"", "count=\"${n}\"")
        .replace("<end-time>1<", "<end-time> ${t} <")
        .replace(
            "      <java-class>",
            "      <start-position x=\"${n}\" y=\"0\" z=\"${t}\"/>\n      <java-class>",
        )
        .replace(
            "<looping><variables>",
            "<looping><variables>\n<variable name=\"n\"><each><value>1</value><value>3d</value></each></variable>\
             \n<variable name=\"t\"><for from=\"1.5f\" to=\"2d\" step=\"0.5\"/></variable>",
        );
    let loaded = good("looping.xml", &varied);
    let sweep = loaded.sweep().expect("a sweep");
    assert_eq!(sweep.len(), 4 * 90);
    assert!(sweep.check().is_ok());
    let last = sweep.load(4 * 90 - 1).unwrap_or_else(|_| panic!("good"));
    assert_eq!(last.setup().expect("good").models.len(), 3);
    let toml = last.toml();
    for line in ["end_time = \"2 s\"", "start = [\"3 m\", \"0 m\", \"2 m\"]"] {
        assert!(toml.contains(line), "{line}: {toml}");
    }
}

#[test]
fn what_cannot_vary_in_an_old_scenario_says_so_at_its_place() {
    let still = LOOPING
        .replace(
            "<constant value=\"7\"/>",
            "<variable><for from=\"1\" to=\"${n}\"/></variable>",
        )
        .replace("</end-time>", "</end-time><epoch>${n}</epoch>")
        .replace(
            "<looping><variables>",
            "<looping><variables><variable name=\"n\"><each><value>2</value><value>3</value></each></variable>",
        );
    let loaded = good("looping.xml", &still);
    let said = render::faults(loaded.faults(), loaded.sources(), false);
    assert!(said.contains("these seeds hang on a variable"), "{said}");
    assert!(said.contains("`n` does not vary here"), "{said}");
    for place in ["looping.xml:2:27", "looping.xml:3:44"] {
        assert!(said.contains(place), "{place} {said}");
    }
}

#[test]
fn a_key_varies_once_on_the_command_line() {
    let twice = ["--vary model.bee.count=1,2", "--vary model.bee.count=5"];
    let request = Request {
        sets: twice.map(str::to_owned).to_vec(),
        ..Request::default()
    };
    let Err(rejected) = load_text("bees.toml", &with(""), &request) else {
        panic!("a key was varied twice");
    };
    let text = render::faults(&rejected.faults, &rejected.sources, false);
    assert!(text.contains("a second `--vary model.bee.count`"), "{text}");
    // What the file varies is replaced, as ever.
    let loaded = loaded("[sweep.vary]\n\"model.bee.count\" = [1, 2, 3]", &twice[1..]);
    assert_eq!(runs(&loaded).len(), 1);
}
