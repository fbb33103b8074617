//! World files: every element of the original's, every default; the same in TOML.

use crate::{TOML, WORLD, good, shown};
use simbeeotic_scenario::{Loaded, Request, check_file, convert_world, load_file, load_text};
use simbeeotic_units::{Angle, Length, Position};
use simbeeotic_world::{
    Color, Door, Obstacle, ObstacleShape, Patch, Person, PersonShape, Slab, Structure,
    StructureShape, Texture, Trap, Wall, World,
};
use std::fs;

const RUN: &str = "[run]\nend_time = \"1 s\"\n";

fn m(metres: f64) -> Length {
    Length::si(metres)
}

fn at(x: f64, y: f64, z: f64) -> Position {
    Position::new(m(x), m(y), m(z))
}

/// A scenario of nothing but the world in `text`, from a file called `name`.
fn with_world(name: &str, text: &str) -> Result<Loaded, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let world = folder.path().join(name);
    fs::write(&world, text).expect("written");
    let request = Request {
        world: Some(world),
        ..Request::default()
    };
    let loaded = load_text("x.toml", RUN, &request);
    loaded.map_err(|r| shown(&r).replace(&folder.path().display().to_string(), ""))
}

fn world(name: &str, text: &str) -> World {
    match with_world(name, text) {
        Ok(loaded) => (*loaded.plan().world).clone(),
        Err(said) => panic!("{said}"),
    }
}

#[test]
fn every_element_of_the_original_is_read() {
    let world = world("w.xml", WORLD);
    assert_eq!(world.radius, m(2000.0));
    assert_eq!(
        (world.flower.stem_height, world.flower.stem_radius),
        (m(0.3), m(0.02))
    );
    assert_eq!(
        (world.flower.head_height, world.flower.head_radius),
        (m(0.03), m(0.2))
    );
    let tower = &world.obstacles[0];
    assert_eq!(tower.position, at(10.0, 11.0, 1.0));
    assert_eq!(
        tower.shape,
        ObstacleShape::Box {
            length: m(2.0),
            width: m(3.0),
            height: m(4.0),
            rotation: Angle::si(0.5)
        }
    );
    assert_eq!(tower.color, Some(Color::rgba(192, 65, 23, 64)));
    assert_eq!(tower.texture, Some(Texture::Builtin("brick_2".into())));
    assert_eq!(
        (tower.label.as_str(), tower.meta["foo"].as_str()),
        ("tower", "bar")
    );
    assert_eq!(
        world.obstacles[2].texture,
        Some(Texture::File("bark.png".into()))
    );
    assert_eq!(
        world.obstacles[2].shape,
        ObstacleShape::Cylinder {
            diameter: m(0.5),
            height: m(2.0)
        }
    );
    assert_eq!(
        world.obstacles[4].shape,
        ObstacleShape::Sphere { radius: m(3.0) }
    );
    assert_eq!(
        world.obstacles[6].shape,
        ObstacleShape::Cone {
            radius: m(2.0),
            height: m(5.0)
        }
    );
    assert_eq!(
        world.structures[0].shape,
        StructureShape::Wall(Wall {
            length: m(5.0),
            width: m(0.2),
            height: m(3.0),
            rotation: Angle::si(1.25),
            doors: vec![Door {
                position: m(1.5),
                width: m(0.9),
                height: m(2.0)
            }],
            windows: vec![],
        })
    );
    assert_eq!(
        world.structures[2].shape,
        StructureShape::Surface(Slab {
            length: m(6.0),
            width: m(4.0),
            height: m(0.1),
            rotation: Angle::si(0.5),
            traps: vec![Trap {
                x: m(1.0),
                y: m(2.0),
                length: m(3.0),
                width: m(0.5)
            }],
        })
    );
    assert_eq!(world.structures[3].meta["floor"], "2");
    assert_eq!(world.patches[0].center, at(3.0, -2.0, 0.0));
    assert_eq!(
        (world.patches[0].radius, world.patches[0].flowers_per_m2),
        (m(12.0), 0.5)
    );
    assert_eq!(world.patches[0].meta["pollen"], "2");
    assert_eq!(world.people[0].position, at(4.0, 5.0, 6.0));
    assert_eq!(world.people[0].label, "Ada");
}

#[test]
fn every_default_is_that_of_the_original() {
    let read = world("w.xml", WORLD);
    let black = Color::rgb(0, 0, 0);
    assert_eq!(
        read.obstacles[1],
        Obstacle {
            position: at(-5.0, 8.0, 0.0),
            color: Some(black),
            ..Obstacle::default()
        }
    );
    let one = m(1.0);
    assert_eq!(
        read.obstacles[3].shape,
        ObstacleShape::Cylinder {
            diameter: one,
            height: one
        }
    );
    let color = read.objects(1)[3].color;
    assert_eq!(color, Color::rgb(140, 140, 140));
    assert_eq!(
        read.obstacles[5].shape,
        ObstacleShape::Sphere { radius: one }
    );
    assert_eq!(
        read.obstacles[7].shape,
        ObstacleShape::Cone {
            radius: one,
            height: one
        }
    );
    assert_eq!(read.structures[1], Structure::default());
    assert_eq!(
        read.structures[4].shape,
        StructureShape::Wall(Wall {
            length: m(5.0),
            width: one,
            height: m(2.0),
            rotation: Angle::ZERO,
            doors: vec![Door::default()],
            windows: vec![],
        })
    );
    assert_eq!(read.patches[1].color, None);
    assert_eq!(Patch::COLOR, Color::rgb(255, 102, 151));
    assert_eq!(read.people[1], Person::default());
    assert_eq!(
        read.people[1].shape,
        PersonShape::Man {
            width: one,
            height: one
        }
    );
    assert_eq!(world("w.xml", "<world/>"), World::default());
}

#[test]
fn the_original_s_world_is_the_same_in_toml() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("w.xml");
    fs::write(&path, WORLD).expect("written");
    let converted =
        convert_world(&path, &Default::default()).unwrap_or_else(|r| panic!("{}", shown(&r)));
    insta::assert_snapshot!("world_xml_as_toml", converted.toml);
    assert_eq!(world("w.toml", &converted.toml), world("w.xml", WORLD));
    let said = simbeeotic_scenario::render::faults(&converted.faults, &converted.sources, false);
    for note in ["its `z` counts", "inside the circle", "here all are right"] {
        assert_eq!(said.matches(note).count(), 1, "{said}");
    }
}

#[test]
fn a_world_may_stand_in_the_scenario() {
    let loaded = good("everything.toml", TOML);
    let world = &loaded.plan().world;
    assert_eq!(
        (
            world.obstacles.len(),
            world.patches.len(),
            world.people.len()
        ),
        (2, 1, 1)
    );
}

#[test]
fn a_scenario_names_its_world_from_its_own_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::create_dir(folder.path().join("worlds")).expect("made");
    fs::write(folder.path().join("worlds/w.xml"), WORLD).expect("written");
    let scenario = folder.path().join("x.toml");
    fs::write(&scenario, format!("world = \"worlds/w.xml\"\n{RUN}")).expect("written");
    let loaded =
        load_file(&scenario, &Request::default()).unwrap_or_else(|r| panic!("{}", shown(&r)));
    assert_eq!(loaded.plan().world.obstacles.len(), 8);
}

#[test]
fn wrong_worlds_say_what_and_where() {
    let toml = r##"radius = "-5 m"
[[obstacle]]
shape = { bix = { length = "1 m" } }
[[obstacle]]
shape = { box = { lenght = "1 m" } }
color = "red"
[[structure]]
shape = { wall = { length = "2", door = { breadth = "3 m" } } }
[[patch]]
radius = "1 m"
"##;
    insta::assert_snapshot!("wrong_world_toml", said("w.toml", toml));
    let numbers = r##"[[structure]]
shape = { wall = { length = "2 m", height = "3 m", door = { width = "3 m" } } }
[[patch]]
center = ["0 m", "0 m", "0 m"]
radius = "0 m"
flowers_per_m2 = -1.0
"##;
    insta::assert_snapshot!("wrong_world_numbers", said("w.toml", numbers));
    let xml = r#"<world>
  <radius>far</radius>
  <obstacles>
    <obstacle><box length="x"><position x="0"/></box></obstacle>
    <obstacle><color red="300"/></obstacle>
    <obstacle><sphere/><cone><position x="0" y="0"/></cone></obstacle>
  </obstacles>
  <structures><structure><wall door="maybe"><position x="0" y="0"/></wall></structure></structures>
  <flowers><patch><center x="0" y="0"/></patch></flowers>
</world>
"#;
    insta::assert_snapshot!("wrong_world_xml", said("w.xml", xml));
}

#[track_caller]
fn said(name: &str, text: &str) -> String {
    match with_world(name, text) {
        Ok(_) => panic!("this should be wrong:\n{text}"),
        Err(said) => said,
    }
}

const SHAPES: &str = r##"
ground = { friction = 0.9 }

[[obstacle]]
label = "post"
position = ["1 m", "2 m", "0 m"]
shape = { capsule = { radius = "10 cm", height = "2 m" } }
friction = 0.2
restitution = 0.7

[[obstacle]]
attitude = { yaw = "90 deg", roll = "30 deg" }
[obstacle.shape.hull]
points = [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"], ["0 m", "1 m", "0 m"], ["0 m", "0 m", "1 m"]]

[[obstacle]]
[obstacle.shape.mesh]
points = [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"], ["0 m", "1 m", "0 m"]]
triangles = [[0, 1, 2]]

[[obstacle]]
[[obstacle.shape.parts]]
position = ["0 m", "0 m", "1 m"]
shape = { box = { length = "3 m" } }
[[obstacle.shape.parts]]
position = ["0 m", "0 m", "2 m"]
shape = { sphere = { radius = "50 cm" } }

[terrain]
position = ["0 m", "0 m", "-1 m"]
[terrain.height_field]
length = "100 m"
width = "50 m"
heights = [["0 m", "1 m", "0 m"], ["0 m", "2 m", "0 m"]]
"##;

#[test]
fn shapes_of_points_parts_and_terrain_are_read() {
    let world = world("w.toml", SHAPES);
    let solids: Vec<usize> = world.objects(1).iter().map(|o| o.solids.len()).collect();
    assert_eq!(solids, [1, 1, 1, 2, 1]);
    let post = &world.obstacles[0];
    assert_eq!((post.friction, post.restitution), (Some(0.2), Some(0.7)));
    assert_eq!(world.ground.friction, Some(0.9));
    let printed = format!("world = \"w.toml\"\n{RUN}");
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("w.toml"), SHAPES).expect("written");
    fs::write(folder.path().join("x.toml"), printed).expect("written");
    let loaded = load_file(&folder.path().join("x.toml"), &Request::default())
        .unwrap_or_else(|r| panic!("{}", shown(&r)));
    let ground = loaded.plan().physics.ground.expect("it is solid");
    assert_eq!((ground.friction, ground.restitution), (0.9, 0.0));
}

#[test]
fn wrong_shapes_say_what_and_where() {
    let toml = r##"[[obstacle]]
shape = { capsule = { radius = "1 m", height = "2 m" } }
restitution = 2.0
[[obstacle]]
[obstacle.shape.hull]
points = [
    ["0 m", "0 m", "0 m"],
    ["1 m", "0 m", "0 m"],
    ["300 km", "0 m", "0 m"],
]
[[obstacle]]
[obstacle.shape.mesh]
points = [["0 m", "0 m", "0 m"], ["1 m", "0 m", "0 m"], ["0 m", "1 m", "0 m"]]
triangles = [
    [0, 1, 2],
    [0, 1, 7],
]
[[obstacle]]
[[obstacle.shape.parts]]
shape = { parts = [] }
[terrain.height_field]
length = "100 m"
width = "0 m"
heights = [
    ["0 m", "1 m", "0 m"],
    ["0 m"],
]
"##;
    insta::assert_snapshot!("wrong_shapes", said("w.toml", toml));
}

#[test]
fn what_makes_no_body_is_refused_where_it_is_written() {
    let flat = r##"[[obstacle]]
[[obstacle.shape.parts]]
shape = { sphere = {} }
[[obstacle.shape.parts]]
[obstacle.shape.parts.shape.hull]
points = [
    ["0 m", "0 m", "0 m"],
    ["1 m", "0 m", "0 m"],
    ["0 m", "1 m", "0 m"],
    ["1 m", "1 m", "0 m"],
]
"##;
    let said = said("w.toml", flat);
    assert!(said.contains("w.toml:5:"), "{said}");
}

#[test]
fn one_and_a_list_of_the_same_are_told_apart_from_each_other() {
    for (shape, one, many) in [
        ("wall", "door", "doors"),
        ("wall", "window", "windows"),
        ("surface", "trap", "traps"),
    ] {
        let text = format!("[[structure]]\nshape.{shape} = {{ {one} = {{}}, {many} = [{{}}] }}\n");
        let said = said("w.toml", &text);
        let wanted = format!("`{one}` and `{many}` say the same: one will do");
        assert!(said.contains(&wanted), "{said}");
        assert!(!said.contains("duplicate"), "{said}");
    }
}

#[test]
fn a_file_of_misspelt_keys_alone_is_guessed_at_as_both() {
    let folder = tempfile::tempdir().expect("a folder");
    let said = |text: &str| {
        let file = folder.path().join("x.toml");
        fs::write(&file, text).expect("written");
        match check_file(&file, &Request::default()) {
            Ok(_) => panic!("this should be wrong:\n{text}"),
            Err(rejected) => shown(&rejected),
        }
    };
    let world = said("[[obstcle]]\nlabel = \"post\"\n");
    assert!(
        world.contains("unknown key `obstcle`: neither a world nor a scenario has it"),
        "{world}"
    );
    assert!(
        world.contains("in a world, did you mean `obstacle`?"),
        "{world}"
    );
    assert!(!world.contains("[run]"), "{world}");
    let scenario = said("[[modle]]\nuse = \"inert-bee\"\n");
    assert!(
        scenario.contains("in a scenario, did you mean `model`?"),
        "{scenario}"
    );
    let neither = said("zzzzzz = 1\n");
    assert!(
        neither.contains("a world has `") && neither.contains("a scenario has `"),
        "{neither}"
    );
    // One key of a scenario makes it one.
    let run = said("nmae = \"x\"\n[run]\n");
    assert!(!run.contains("neither"), "{run}");
}
