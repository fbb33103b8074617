//! Files of the same structure as the ten worlds and the scenarios that the original shipped. The
//! originals are not at hand: what is known of them is how many of which things they hold.

use crate::shown;
use simbeeotic_scenario::{Checked, Loaded, Request, check_file, load_text, render};
use simbeeotic_world::World;
use std::fmt::Write as _;
use std::fs;

/// A world of the original: text, and how many structures, obstacles, patches and people it has.
fn worlds() -> Vec<(&'static str, String, [usize; 4])> {
    let wall = |x: f64, y: f64, z: f64, length: f64, rotation: f64| {
        format!(
            r#"<structure><wall length="{length}" width="0.1" height="1" rotation="{rotation}"><position x="{x}" y="{y}" z="{z}"/></wall></structure>"#
        )
    };
    let half_pi = std::f64::consts::FRAC_PI_2;
    let maze = |count: usize, z: f64| -> String {
        let at = |i: usize| (f64::from(i as u32 % 8), f64::from(i as u32 / 8));
        let walls = (0..count).map(|i| wall(at(i).0, at(i).1, z, 1.0, half_pi * (i % 2) as f64));
        walls.collect()
    };
    let slab = |i: usize, z: f64| {
        format!(
            r#"<structure><surface length="4" width="2" height="0.1" trap="{}" trapX="0.5" trapY="0.5" trapLength="1" trapWidth="0.5"><position x="{}" y="0" z="{z}"/></surface></structure>"#,
            i.is_multiple_of(3),
            4 * i
        )
    };
    let man = |i: usize| {
        format!(
            r#"<person><man width="0.5" height="0.5"><position x="{i}" y="1" z="{}"/><meta><prop name="person-id" value="{}"/></meta></man></person>"#,
            i % 3,
            10 * (i % 3) + i
        )
    };
    let structures = |inner: String| format!("<structures>{inner}</structures>");
    let boxes = |count: usize| -> String {
        let one = |i: usize| {
            format!(
                r#"<obstacle><box length="1" width="2" height="3" rotation="0.3"><position x="{i}" y="0" z="0"/></box><color red="{i}"/></obstacle>"#
            )
        };
        format!(
            "<obstacles>{}</obstacles>",
            (0..count).map(one).collect::<String>()
        )
    };
    let meadow = r#"<flowers><patch><center x="5" y="5" z="0"/><radius>12</radius><density>0.5</density></patch></flowers>"#;
    let levels: String = (0..4).map(|z| maze(35, f64::from(z))).collect();
    let slabs: String = (0..56).map(|i| slab(i, (i / 14) as f64)).collect();
    let men: String = (0..17).map(man).collect();
    let room = [wall(0.0, 0.0, 0.0, 6.0, 0.0), wall(0.0, 5.2, 0.0, 6.0, 0.0)].concat()
        + &[0.0, 6.0].map(|x| wall(x, 0.0, 0.0, 5.2, half_pi)).concat();
    vec![
        ("Empty", String::new(), [0, 0, 0, 0]),
        ("Simple", boxes(4) + meadow, [0, 4, 1, 0]),
        ("Corner", structures(maze(2, 0.0)), [2, 0, 0, 0]),
        ("Snake", structures(maze(9, 0.0)), [9, 0, 0, 0]),
        ("Hovering", boxes(1), [0, 1, 0, 0]),
        ("Maze", structures(maze(40, 0.0)), [40, 0, 0, 0]),
        ("Maze2", structures(maze(62, 0.0)), [62, 0, 0, 0]),
        ("Maze3D", structures(levels + &slabs), [140 + 56, 0, 0, 0]),
        (
            "Mine",
            format!("<people>{men}</people>{}", structures(maze(224, 0.0))),
            [224, 0, 0, 17],
        ),
        ("MD209", structures(room), [4, 0, 0, 0]),
    ]
}

fn read(name: &str, inner: &str) -> (World, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join(format!("{name}.xml"));
    let text = format!("<?xml version=\"1.0\"?>\n<world>\n{inner}\n</world>\n");
    fs::write(&path, text).expect("written");
    match check_file(&path, &Request::default()) {
        Ok(Checked::World {
            world,
            faults,
            sources,
            ..
        }) => (*world, render::faults(&faults, &sources, false)),
        Ok(Checked::Scenario(_)) => panic!("{name} is no scenario"),
        Err(rejected) => panic!("{name}:\n{}", shown(&rejected)),
    }
}

#[test]
fn worlds_like_the_ten_of_the_original_are_read() {
    for (name, inner, [structures, obstacles, patches, people]) in worlds() {
        let (world, said) = read(name, &inner);
        let found = [
            world.structures.len(),
            world.obstacles.len(),
            world.patches.len(),
            world.people.len(),
        ];
        assert_eq!(found, [structures, obstacles, patches, people], "{name}");
        assert!(!said.contains("unknown"), "{name}: {said}");
        // Notes on what is better here, and the people of mines, whose words stand in the wrong place.
        assert_eq!(said.contains("warning:"), name == "Mine", "{name}: {said}");
    }
}

#[test]
fn the_people_of_a_mine_keep_the_words_that_its_generator_put_in_the_wrong_place() {
    let (_, inner, _) = worlds()
        .into_iter()
        .find(|w| w.0 == "Mine")
        .expect("it is there");
    let (world, said) = read("Mine", &inner);
    assert_eq!(world.people[4].meta["person-id"], "14");
    assert!(
        said.contains("`meta` stands in `person`, not in `man`"),
        "{said}"
    );
}

#[test]
fn the_flowers_of_simple_world_stand_inside_their_patch() {
    let (_, inner, _) = worlds()
        .into_iter()
        .find(|w| w.0 == "Simple")
        .expect("it is there");
    let (world, _) = read("Simple", &inner);
    let flowers = world.flowers(1);
    // The original had as many, 48 of them outside.
    assert_eq!(flowers.len(), 226);
    let middle = world.patches[0].center;
    assert!(
        flowers
            .iter()
            .all(|f| f.foot.distance(middle) <= world.patches[0].radius)
    );
}

const PACKAGE: &str = "harvard.robobees.simbeeotic";

struct Part<'a> {
    class: &'a str,
    properties: &'a [(&'a str, &'a str)],
}

const fn part<'a>(class: &'a str, properties: &'a [(&'a str, &'a str)]) -> Part<'a> {
    Part { class, properties }
}

impl Part<'_> {
    fn inside(&self) -> String {
        let mut text = format!("<java-class>{PACKAGE}.{}</java-class>", self.class);
        if !self.properties.is_empty() {
            text += "<properties>";
            for (name, value) in self.properties {
                let _ = write!(text, r#"<prop name="{name}" value="{value}"/>"#);
            }
            text += "</properties>";
        }
        text
    }
}

/// A scenario of one kind of bee with its sensors, maybe with radio and channel.
fn scenario(bee: &Part<'_>, count: usize, sensors: &[(&str, Part<'_>)], rest: &str) -> String {
    let mut gear = String::new();
    for (name, sensor) in sensors {
        let _ = write!(
            gear,
            r#"<sensor name="{name}">{}<offset x="0.05" y="0" z="0"/><pointing x="1" y="0" z="0"/></sensor>"#,
            sensor.inside()
        );
    }
    format!(
        r#"<scenario><master-seed><constant value="112181"/></master-seed>
        <simulation><end-time>10.0</end-time></simulation>
        <models>{rest}<model name="bee" count="{count}">{}{gear}<start-position x="0" y="0" z="20"/></model></models>
        </scenario>"#,
        bee.inside()
    )
}

fn load(name: &str, text: &str) -> (Loaded, String) {
    match load_text(name, text, &Request::default()) {
        Ok(loaded) => {
            let said = render::faults(loaded.faults(), loaded.sources(), false);
            (loaded, said)
        }
        Err(rejected) => panic!("{name}:\n{}", shown(&rejected)),
    }
}

#[test]
fn scenarios_like_those_of_the_original_are_read_where_their_models_are_simulated() {
    let air = format!(
        "<model>{}</model>",
        part(
            "model.comms.FreeSpacePropagationModel",
            &[("range-thresh", "30")]
        )
        .inside()
    );
    let wind = format!(
        "<model>{}</model>",
        part("model.weather.ConstantWeatherModel", &[("wind-x", "3")]).inside()
    );
    let walk = part(
        "example.RandomWalkBee",
        &[("max-vel", "2.0"), ("length", "0.1")],
    );
    let gear = || {
        vec![
            (
                "range-bottom",
                part("model.sensor.DefaultRangeSensor", &[("max-range", "5")]),
            ),
            (
                "contact-bottom",
                part("model.sensor.DefaultContactSensor", &[("radius", "0.005")]),
            ),
        ]
    };
    for (name, bee, count, sensors, rest) in [
        ("Drop", part("example.InertBee", &[]), 1, vec![], ""),
        (
            "Wind",
            part("example.InertBee", &[("use-wind", "true")]),
            1,
            vec![],
            &*wind,
        ),
        ("RandomWalk", walk, 1, gear(), ""),
        (
            "Vis",
            part("example.RandomWalkBee", &[("use-random-start", "true")]),
            100,
            gear(),
            "",
        ),
        (
            "Broadcast",
            part("example.BroadcastBee", &[]),
            3,
            vec![],
            &*air,
        ),
    ] {
        let (loaded, said) = load(name, &scenario(&bee, count, &sensors, rest));
        assert!(
            !said.contains("warning:") || name == "Broadcast",
            "{name}: {said}"
        );
        assert_eq!(loaded.setup().expect(name).models.len(), count, "{name}");
    }
    // What the shipped files say and no part does: it is told, and the rest runs.
    for (name, class) in [
        ("Mine", "example.MineBee"),
        ("Auto", "example.OpticalMotionBee"),
        ("HWILSquare", "model.HWILBee"),
    ] {
        let (loaded, said) = load(name, &scenario(&part(class, &[]), 1, &[], ""));
        assert!(
            said.contains("is known, not simulated yet, and left out"),
            "{name}: {said}"
        );
        assert!(loaded.setup().expect(name).models.is_empty());
    }
    // A class that the original did not have either (HWILHover names it).
    let text = scenario(&part("example.HeliHover", &[]), 1, &[], "");
    let said = shown(
        &load_text("HWILHover", &text, &Request::default())
            .err()
            .expect("unknown"),
    );
    assert!(said.contains("unknown class"), "{said}");
}

/// Every class of sensors, every property of it, offset and pointing.
const SENSORS: [Part<'static>; 12] = [
    part("model.sensor.DefaultAccelerometer", &[("sigma", "0.005")]),
    part("model.sensor.DefaultGyroscope", &[("sigma", "0.0085")]),
    part("model.sensor.DefaultCompass", &[("sigma", "0.0016")]),
    part("model.sensor.DefaultPositionSensor", &[("sigma", "0.5")]),
    part("model.sensor.DefaultPoseSensor", &[("sigma", "0.01")]),
    part(
        "model.sensor.DefaultRangeSensor",
        &[
            ("sigma", "0.05"),
            ("min-range", "0.1"),
            ("max-range", "5.0"),
        ],
    ),
    part("model.sensor.DefaultContactSensor", &[("radius", "0.005")]),
    part(
        "model.sensor.DefaultOpticalMotionSensor",
        &[("sigma", "0.05"), ("min-range", "0.1"), ("max-range", "20")],
    ),
    part(
        "model.sensor.BottomOpticalMotionSensor",
        &[("sigma", "0.05"), ("min-range", "0.1"), ("max-range", "20")],
    ),
    part(
        "model.sensor.FlowerSensor",
        &[("max-range", "1.0"), ("half-angle", "0.3926991")],
    ),
    part(
        "model.sensor.PersonSensor",
        &[("max-range", "1.0"), ("half-angle", "0.3926991")],
    ),
    part("model.sensor.WallSensor", &[("max-range", "1.0")]),
];

#[test]
fn every_sensor_of_the_original_is_read_with_its_properties_offset_and_pointing() {
    for sensor in SENSORS {
        let text = scenario(
            &part("example.InertBee", &[]),
            1,
            &[("it", part(sensor.class, sensor.properties))],
            "",
        );
        let (loaded, said) = load(sensor.class, &text);
        assert!(!said.contains("warning:"), "{}: {said}", sensor.class);
        let toml = loaded.toml();
        let mount = "mount = { position = [\"0.05 m\", \"0 m\", \"0 m\"], pointing = [1";
        assert!(toml.contains(mount), "{}: {toml}", sensor.class);
        // Properties without a counterpart would have warned; each is a key of the sensor's table.
        let table = toml.split("[model.sensor.it]").nth(1).expect("its table");
        let lines = table.lines().skip(1).take_while(|l| !l.is_empty()).count();
        assert!(
            lines >= 2 + sensor.properties.len(),
            "{}: {table}",
            sensor.class
        );
        loaded
            .setup()
            .unwrap_or_else(|f| panic!("{}: {f:?}", sensor.class));
    }
}

/// Whatever the schema of scenarios lets one leave out.
#[test]
fn every_default_of_a_scenario_is_that_of_the_original() {
    let gear = |tag: &str, class: &str| format!("<{tag}>{}</{tag}>", part(class, &[]).inside());
    let text = format!(
        "<scenario><simulation><end-time/></simulation><models>{}<model>{}{}{}</model></models></scenario>",
        gear("model", "model.comms.FreeSpacePropagationModel"),
        part("example.InstrumentBee", &[]).inside(),
        gear("sensor", "model.sensor.DefaultCompass").replacen(
            "<sensor>",
            "<sensor name=\"compass\">",
            1
        ),
        gear("radio", "model.comms.CC2420"),
    );
    let (loaded, said) = load("defaults.xml", &text);
    assert!(said.contains("there is no `master-seed`"), "{said}");
    let run = &loaded.plan().run;
    assert_eq!(run.limits.end.as_secs_f64(), 1200.0);
    assert_eq!((run.seed, run.epoch.get()), (1, 28_800.0));
    let channel = loaded.plan().channel.as_ref().expect("there is one");
    let noise = channel.noise_floor.expect("the original's");
    assert_eq!((noise.mean.dbm(), noise.sigma.db()), (-100.0, 10.0));
    assert_eq!(channel.range_limit.map(|range| range.get()), Some(10.0));
    assert_eq!(*loaded.plan().world, World::default());
    let setup = loaded.setup().expect("good");
    // One model, named after its part, at the origin; its compass looks ahead from the middle.
    let paths: Vec<&str> = setup.models.iter().map(|m| m.path.as_str()).collect();
    assert_eq!(paths, ["instrument-bee"]);
    assert_eq!(setup.models[0].start, simbeeotic_units::Pose::default());
    assert!(!loaded.toml().contains("mount"), "{}", loaded.toml());
    assert!(!loaded.toml().contains("antenna"), "{}", loaded.toml());
}
