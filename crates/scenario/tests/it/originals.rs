//! The original's scenario files: every element, every property, every variable.

use crate::{XML, bad, good};
use simbeeotic_model::units::Speed;
use simbeeotic_model::{Behavior, BuildError, Kit, behavior, params};
use simbeeotic_scenario::print::same;
use simbeeotic_scenario::{Request, load_text, render};

/// A bee that no table knows: its own crate says which Java class it stands for.
#[behavior("foreign-bee", java = "org.example.ForeignBee")]
struct ForeignBee;

/// Parameters of [`ForeignBee`].
#[params]
struct ForeignBeeParams {
    /// A quantity.
    cruise_speed: Speed,
    /// A whole number.
    laps: u32,
    /// A flag.
    loud: bool,
    /// A number.
    gain: f64,
    /// A text.
    song: String,
}

impl Default for ForeignBeeParams {
    fn default() -> Self {
        Self {
            cruise_speed: Speed::ZERO,
            laps: 0,
            loud: false,
            gain: 0.0,
            song: String::new(),
        }
    }
}

impl Behavior for ForeignBee {
    type Params = ForeignBeeParams;

    fn build(_params: ForeignBeeParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        Ok(Self)
    }
}

#[test]
fn a_class_of_a_user_s_own_is_read_by_its_schema() {
    let (toml, said) = converted(&scenario(
        r#"<model><java-class>org.example.ForeignBee</java-class>
             <properties>
               <prop name="cruise-speed" value="3"/>
               <prop name="laps" value="2"/>
               <prop name="loud" value="true"/>
               <prop name="gain" value="0.5"/>
               <prop name="song" value="la"/>
               <prop name="lapps" value="3"/>
             </properties></model>"#,
        "",
    ));
    for line in [
        "cruise_speed = \"3 m/s\"",
        "laps = 2",
        "loud = true",
        "gain = 0.5",
        "song = \"la\"",
    ] {
        assert!(toml.contains(line), "{toml}");
    }
    assert!(
        said.contains("unknown property `lapps` of `foreign-bee`"),
        "{said}"
    );
}

#[test]
fn a_value_that_the_part_refuses_is_shown_in_the_xml() {
    let text = XML.replace(
        "\"tx-power-level\" value=\"27\"",
        "\"tx-power-level\" value=\"99\"",
    );
    let said = bad("everything.xml", &text);
    assert!(said.contains("must be a level from 3 to 31"), "{said}");
    assert!(
        said.contains("<prop name=\"tx-power-level\" value=\"99\"/>"),
        "{said}"
    );
}

const PACKAGE: &str = "harvard.robobees.simbeeotic";

fn scenario(models: &str, rest: &str) -> String {
    let models = models.replace("§", PACKAGE);
    let rest = rest.replace("§", PACKAGE);
    format!(
        "<scenario>\n<master-seed><constant value=\"1\"/></master-seed>\n\
         <simulation><end-time>1</end-time></simulation>\n\
         <models>\n{models}\n</models>\n{rest}\n</scenario>\n"
    )
}

/// The TOML of a scenario, and what is said about it.
#[track_caller]
fn converted(text: &str) -> (String, String) {
    let loaded = good("old.xml", text);
    (
        loaded.toml_with_sweep(),
        render::faults(loaded.faults(), loaded.sources(), false),
    )
}

#[test]
fn every_element_and_property_is_translated() {
    let loaded = good("everything.xml", XML);
    insta::assert_snapshot!("everything_xml_as_toml", loaded.toml());
    let said = render::faults(loaded.faults(), loaded.sources(), false);
    insta::assert_snapshot!("everything_xml_notes", said);
    let toml = good("everything.toml", &loaded.toml());
    assert!(same(loaded.tree(), toml.tree()));
    assert_eq!(toml.setup().expect("a set-up").models.len(), 1 + 3 + 20);
}

#[test]
fn what_the_original_ignored_in_silence_is_warned_of() {
    let (_, said) = converted(&scenario(
        r#"<model colour="red">
             <java-class>§.example.InertBee</java-class>
             <properties><prop name="masss" value="1"/></properties>
             <sensors/>
             <start-position x="0" y="0" z="0" w="0"/>
           </model>"#,
        "<loopings/>",
    ));
    insta::assert_snapshot!(said);
}

#[test]
fn wrong_values_are_errors_all_at_once() {
    let text = scenario(
        r#"<model count="many">
             <java-class>§.example.InertBee</java-class>
             <properties>
               <prop name="mass" value="heavy"/>
               <prop name="use-wind" value="perhaps"/>
               <prop name="length"/>
             </properties>
             <start-position x="0" y="north" z="0"/>
           </model>
           <model><java-class>§.example.InstrumentBea</java-class></model>"#,
        "",
    );
    insta::assert_snapshot!(bad("old.xml", &text));
}

#[test]
fn all_classes_are_known_and_those_without_a_part_are_left_out() {
    let (toml, said) = converted(&scenario(
        r#"<model><java-class>§.model.HWILBee</java-class>
             <custom-config><behaviors/></custom-config></model>
           <model><java-class>§.example.InertBee</java-class>
             </model>
           <model><java-class>§.example.MineBee</java-class></model>"#,
        "<components><variation><java-class>§.component.ViconInputComponent</java-class></variation></components>",
    ));
    assert!(
        !toml.contains("ghost") && !toml.contains("component"),
        "{toml}"
    );
    for class in ["HWILBee", "MineBee", "ViconInputComponent"] {
        assert!(
            said.contains(&format!("`{class}` is known, not simulated yet")),
            "{said}"
        );
    }
}

#[test]
fn two_models_of_one_name_get_names_of_their_own() {
    let bee = r#"<model><java-class>§.example.InertBee</java-class></model>"#;
    let named = r#"<model name="a"><java-class>§.example.InertBee</java-class></model>"#;
    let text = scenario(&format!("{bee}{bee}{bee}{named}{named}"), "");
    let loaded = good("old.xml", &text);
    let paths: Vec<String> = loaded
        .setup()
        .expect("a set-up")
        .models
        .into_iter()
        .map(|m| m.path)
        .collect();
    assert_eq!(
        paths,
        ["inert-bee", "inert-bee-b", "inert-bee-c", "a", "a-b"]
    );
    assert_eq!(loaded.faults().len(), 1, "the named one is warned of");
}

#[test]
fn the_variations_of_an_old_scenario_are_a_sweep() {
    let (toml, said) = converted(&scenario(
        r#"<model><java-class>§.example.RandomWalkBee</java-class>
             <properties>
               <prop name="length" value="${bee.len}"/>
               <prop name="mass" value="${bee.mass}:0.1"/>
               <prop name="max-vel" value="${speed}:1.5"/>
             </properties></model>"#,
        r#"<looping><variables>
             <variable name="bee.len"><for from="0.2" to="0.3" step="0.01"/></variable>
             <variable name="bee.mass"><normal-random mean="0.1" std-dev="0.02" seed-source="RANDOM_STREAM"/></variable>
             <variable name="unused"><each><value>1</value><value>2</value><value>3</value></each></variable>
           </variables></looping>"#,
    ));
    assert!(toml.contains("length = \"${bee.len} m\""), "{toml}");
    assert!(toml.contains("max_speed = \"1.5 m/s\""), "{toml}");
    let range = "\"variables.bee.len\" = { from = 0.2, to = 0.3, step = 0.01 }";
    assert!(toml.contains(range), "{toml}");
    assert!(toml.contains("\"variables.unused\" = [1, 2, 3]"), "{toml}");
    let loaded = good("new.toml", &toml);
    let sweep = loaded.sweep().expect("a sweep");
    assert_eq!(sweep.len(), 33);
    assert_eq!(sweep.values(32), ["0.3", "3"]);
    assert!(sweep.check().is_ok());
    let last = sweep.load(32).unwrap_or_else(|_| panic!("good"));
    assert!(
        last.toml().contains("length = \"0.3 m\""),
        "{}",
        last.toml()
    );
    assert!(said.contains("lost the last value"), "{said}");
    assert!(
        said.contains("unknown variable `speed`; its default `1.5` is used"),
        "{said}"
    );
}

#[test]
fn a_master_seed_may_be_a_variable() {
    let text = scenario(r#"<model><java-class>§.example.InertBee</java-class></model>"#, "").replace(
        r#"<constant value="1"/>"#,
        r#"<variable><uniform-random from="0" to="10000000" num-draws="3" seed="112181" seed-source="USER"/></variable>"#,
    );
    let (toml, said) = converted(&text);
    // (long) floor of new java.util.Random(112181).nextDouble() * 1e7
    assert!(toml.contains("seed = "), "{toml}");
    assert!(!said.contains("error"), "{said}");
    let loaded = good("new.toml", &toml);
    let seeds = loaded.sweep().and_then(|s| s.seeds()).expect("seeds");
    assert_eq!(seeds.len(), 3);
    assert_eq!(seeds[0].cast_unsigned(), loaded.plan().run.seed);
}

#[test]
fn a_scenario_without_a_seed_is_warned_of() {
    let text = scenario(
        r#"<model><java-class>§.example.InertBee</java-class></model>"#,
        "",
    )
    .replace("<master-seed><constant value=\"1\"/></master-seed>\n", "");
    let (_, said) = converted(&text);
    assert!(said.contains("there is no `master-seed`"), "{said}");
}

#[test]
fn nested_models_start_with_their_parents() {
    let loaded = good(
        "old.xml",
        &scenario(
            r#"<model count="2"><java-class>§.model.SimpleHive</java-class>
                 <model count="2"><java-class>§.example.InertBee</java-class>
                   <start-position x="9" y="9" z="9"/></model>
                 <start-position x="1" y="2" z="3"/></model>"#,
            "",
        ),
    );
    let models = loaded.setup().expect("a set-up").models;
    let paths: Vec<&str> = models.iter().map(|m| m.path.as_str()).collect();
    assert_eq!(
        paths,
        [
            "simple-hive-0",
            "simple-hive-0/inert-bee-0",
            "simple-hive-0/inert-bee-1",
            "simple-hive-1",
            "simple-hive-1/inert-bee-0",
            "simple-hive-1/inert-bee-1"
        ]
    );
    assert!(
        models
            .iter()
            .all(|m| m.start.position.si().to_array() == [1.0, 2.0, 3.0])
    );
    assert_eq!(models[2].parent, Some(0));
    assert_eq!(models[4].parent, Some(3));
}

#[test]
fn channel_and_weather_are_one_for_all() {
    let channel = "<model><java-class>§.model.comms.FreeSpacePropagationModel</java-class></model>";
    let (toml, _) = converted(&scenario(channel, ""));
    assert!(
        toml.contains("range_limit = \"10 m\""),
        "the original's default: {toml}"
    );
    let said = bad("old.xml", &scenario(&format!("{channel}{channel}"), ""));
    assert!(
        said.contains("a second propagation: there is one at most"),
        "{said}"
    );
}

#[test]
fn what_is_no_scenario_says_so() {
    for (text, word) in [
        ("<world/>", "this is a world, and a scenario is wanted"),
        ("<swarm/>", "begins with `<scenario>`, not with `<swarm>`"),
        ("<scenario/>", "has no `simulation`"),
        ("<scenario><simulation/></scenario>", "has no `end-time`"),
        (
            "<scenario><simulation><end-time>soon</end-time></simulation></scenario>",
            "`soon` is not a number",
        ),
        ("<scenario>", "is never closed"),
    ] {
        let said = bad("old.xml", text);
        assert!(said.contains(word), "{said}");
    }
}

#[test]
fn an_override_works_on_old_files_too() {
    let request = Request {
        sets: vec!["model.bee.count=3".into()],
        ..Request::default()
    };
    let loaded = load_text("everything.xml", XML, &request).unwrap_or_else(|_| panic!("good"));
    assert_eq!(loaded.setup().expect("a set-up").models.len(), 1 + 3 + 3);
}
