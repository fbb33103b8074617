//! What stands in a world file of ours and was not in the original's: windows, several openings,
//! attitudes, materials, meshes and heights from files, areas to start in, places.

use crate::shown;
use simbeeotic_scenario::{Checked, Loaded, Request, check_file, load_file};
use simbeeotic_units::{Frequency, Length, Position};
use simbeeotic_world::{Color, ObjectId, ObjectKind, SolidShape, StructureShape, World};
use std::fs;
use tempfile::TempDir;

const WORLD: &str = r##"
[[material]]
name = "felt"
color = "#334455"
friction = 0.9
loss = "2 dB"
loss_per_metre = "10 dB"

[[structure]]
material = "brick"
position = ["0 m", "0 m", "1 m"]
attitude = { roll = "90 deg" }
shape.wall = { length = "6 m", width = "0.2 m", height = "3 m", doors = [{ width = "0.9 m", height = "2 m" }, { position = "4 m", width = "0.9 m", height = "2 m" }], window = { position = "2.5 m", sill = "1 m", width = "1 m", height = "1 m" } }

[[structure]]
material = "felt"
shape.surface = { length = "6 m", width = "4 m", height = "0.1 m", traps = [{ x = "1 m", y = "1 m", length = "2 m", width = "1 m" }, { x = "4 m", y = "2 m" }] }

[[obstacle]]
shape.mesh = { file = "tent.stl", scale = 0.1 }
[[obstacle]]
shape.hull = { file = "tent.obj" }
color = "#ffffff"
material = "felt"

[terrain]
material = "concrete"
height_field = { file = "hills.asc", min_height = "0 m", max_height = "3 m" }

[[spawn]]
name = "roof"
shape.disc = { center = ["0 m", "0 m", "9 m"], radius = "2 m" }
[[spawn]]
name = "pads"
shape.poses = [{ position = ["1 m", "0 m", "0 m"], yaw = "90 deg" }, { position = ["2 m", "0 m", "0 m"] }]

[[place]]
name = "dock"
position = ["3 m", "4 m", "0 m"]
radius = "50 cm"
meta = { charger = "yes" }
"##;

const SCENARIO: &str = r#"
world = "w.toml"
[run]
end_time = "1 s"
[[model]]
use = "inert-bee"
name = "a"
count = 50
start = { area = "roof" }
[[model]]
use = "inert-bee"
name = "b"
count = 2
start = { area = "pads", yaw = "180 deg" }
"#;

const STL: &str = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 10 0 0\nvertex 0 10 0\nendloop\nendfacet\nendsolid\n";
const OBJ: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\n";
const ASC: &str = "ncols 3\nnrows 2\ncellsize 5\n10 20 30\n40 50 60\n";

fn folder(world: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in [
        ("w.toml", world),
        ("s.toml", SCENARIO),
        ("tent.stl", STL),
        ("tent.obj", OBJ),
        ("hills.asc", ASC),
    ] {
        fs::write(folder.path().join(name), text).expect("written");
    }
    folder
}

fn load(world: &str) -> Result<Loaded, String> {
    let folder = folder(world);
    let loaded = load_file(&folder.path().join("s.toml"), &Request::default());
    loaded.map_err(|rejected| shown(&rejected))
}

fn good(world: &str) -> Loaded {
    load(world).unwrap_or_else(|said| panic!("{said}"))
}

fn world() -> World {
    (*good(WORLD).plan().world).clone()
}

#[test]
fn walls_and_slabs_have_several_openings() {
    let world = world();
    let StructureShape::Wall(wall) = &world.structures[0].shape else {
        panic!("a wall");
    };
    assert_eq!((wall.doors.len(), wall.windows.len()), (2, 1));
    let solids: Vec<usize> = world.structures.iter().map(|s| s.solids().len()).collect();
    // Four pillars, a lintel over each door, and a piece below and above the window; two whole strips,
    // and two pieces beside each trap.
    assert_eq!(solids, [4 + 2 + 2, 2 + 2 + 2]);
    // Rolled by a quarter turn, what was up points to -y.
    let middle = world.structures[0].middle().si() - Position::from_xyz(3.0, -1.5, 1.1).si();
    assert!(middle.length() < 1e-12, "{middle}");
}

#[test]
fn materials_give_colour_friction_and_loss() {
    let world = world();
    let brick = ObjectId::new(ObjectKind::Structure, 0);
    let felt = ObjectId::new(ObjectKind::Structure, 1);
    let material = world.material_of(felt).expect("felt");
    let loss = material.loss(Frequency::from_gigahertz(2.4), Length::si(0.5));
    assert_eq!(loss.db(), 7.0);
    assert_eq!(world.material_of(brick).expect("brick").name, "brick");
    assert_eq!(
        world.material_of(ObjectId::new(ObjectKind::Obstacle, 0)),
        None
    );
    let objects = world.objects(1);
    let object = |id| objects.iter().find(|o| o.id == id).expect("it is there");
    assert_eq!(object(felt).color, Color::rgb(0x33, 0x44, 0x55));
    assert_eq!(object(felt).surface.friction, 0.9);
    // Its own colour counts before its material's.
    let own = ObjectId::new(ObjectKind::Obstacle, 1);
    assert_eq!(object(own).color, Color::rgb(255, 255, 255));
    assert_eq!(object(own).material.map(|m| m.name.as_str()), Some("felt"));
}

#[test]
fn meshes_and_heights_come_from_their_files() {
    let world = world();
    let SolidShape::Mesh { points, triangles } = &world.obstacles[0].solids()[0].shape else {
        panic!("a mesh");
    };
    assert_eq!((points.len(), triangles.len()), (3, 1));
    assert!((points[1].si().x - 1.0).abs() < 1e-12);
    let field = &world.terrain.as_ref().expect("terrain").height_field;
    assert_eq!(
        (field.length, field.width),
        (Length::si(10.0), Length::si(5.0))
    );
    // The file begins in the north, a world's rows in the south.
    let metres: Vec<f64> = field
        .heights
        .concat()
        .into_iter()
        .map(Length::get)
        .collect();
    let want = [1.8, 2.4, 3.0, 0.0, 0.6, 1.2];
    assert!(
        metres
            .iter()
            .zip(want)
            .all(|(found, want)| (found - want).abs() < 1e-12)
    );
}

#[test]
fn models_start_in_the_areas_of_their_world() {
    let setup = good(WORLD).setup().expect("good");
    let (roof, pads): (Vec<_>, Vec<_>) = setup.models.iter().partition(|m| m.path.starts_with('a'));
    let roof: Vec<_> = roof.iter().map(|m| m.start.position.si()).collect();
    assert_eq!(roof.len(), 50);
    let on_it = |p: &simbeeotic_units::glam::DVec3| p.truncate().length() <= 2.0 && p.z == 9.0;
    assert!(roof.iter().all(on_it));
    assert!(
        roof.iter()
            .all(|p| roof.iter().filter(|q| *q == p).count() == 1)
    );
    let x = |i: usize| pads[i].start.position.si().x;
    assert_eq!((x(0), x(1)), (1.0, 2.0));
    // The first place says where its vehicle looks, the second leaves it to the scenario.
    let yaw = |i: usize| pads[i].start.attitude.yaw().angle().degrees();
    assert!((yaw(0) - 90.0).abs() < 1e-9 && (yaw(1).abs() - 180.0).abs() < 1e-9);
    let said = load(&WORLD.replace("\"roof\"", "\"rof\""))
        .err()
        .expect("no such area");
    assert!(said.contains("unknown area to start in `roof`"), "{said}");
    assert!(said.contains("did you mean `rof`?"), "{said}");
    let few = WORLD.replace(", { position = [\"2 m\", \"0 m\", \"0 m\"] }", "");
    let said = load(&few).err().expect("one pad for two");
    assert!(
        said.contains("there are 1 places to start from for 2 models"),
        "{said}"
    );
}

#[test]
fn places_have_names_and_words() {
    let world = world();
    let dock = world.place("dock").expect("it is there");
    assert_eq!(dock.meta["charger"], "yes");
    assert!(dock.holds(Position::from_xyz(3.3, 4.0, 0.0)));
    assert_eq!(world.place("deck"), None);
}

#[test]
fn what_is_wrong_is_shown_at_its_line() {
    for (old, new, place, word) in [
        (
            "material = \"brick\"",
            "material = \"brik\"",
            "10:12",
            "did you mean `brick`?",
        ),
        (
            "sill = \"1 m\"",
            "sill = \"2.5 m\"",
            "13:",
            "the window ends at 3.5 m",
        ),
        (
            "position = \"2.5 m\"",
            "position = \"1.5 m\"",
            "13:",
            "this window overlaps an opening before it",
        ),
        ("window =", "windwo =", "13:", "did you mean `window`?"),
        (
            "x = \"4 m\", y = \"2 m\"",
            "x = \"2 m\", y = \"1 m\"",
            "17:",
            "this trap overlaps",
        ),
        ("tent.stl", "tnet.stl", "20:23", "tnet.stl: "),
        (
            "tent.stl",
            "tent.obj\", up = \"x",
            "20:",
            "unknown choice `x`",
        ),
        ("scale = 0.1", "scale = -1", "20:", "must be more than 0"),
        (
            "max_height = \"3 m\"",
            "max_height = \"3 m\", length = \"3 m\"",
            "28:",
            "hills.asc says itself that this is 10 m",
        ),
        (
            "radius = \"2 m\"",
            "radius = \"-2 m\"",
            "32:",
            "must not be negative",
        ),
        (
            "name = \"dock\"",
            "name = \"\"",
            "38:8",
            "a place needs a name",
        ),
        (
            "loss = \"2 dB\"",
            "loss = \"-2 dB\"",
            "6:8",
            "a loss must not be negative",
        ),
    ] {
        assert!(WORLD.contains(old), "{old}");
        let said = load(&WORLD.replacen(old, new, 1)).err().expect(new);
        assert!(said.contains(&format!("w.toml:{place}")), "{new}: {said}");
        assert!(said.contains(word), "{new}: {said}");
        assert_eq!(said.matches("error:").count(), 1, "{new}: {said}");
    }
}

/// A picture of two by two shades.
fn hills() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 2, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().expect("written");
    writer
        .write_image_data(&[0, 90, 180, 255])
        .expect("written");
    writer.finish().expect("written");
    bytes
}

#[test]
fn the_worlds_of_the_book_are_read() {
    let chapter = include_str!("../../../../docs/book/src/worlds.md");
    let blocks = chapter.split("```toml").skip(1);
    let blocks: Vec<&str> = blocks.filter_map(|b| b.split("```").next()).collect();
    let folder = folder("");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("hills.png"), hills()).expect("written");
    // A tent of four sides: its hull has a volume.
    let corners = ["0 0 0", "10 0 0", "0 10 0", "0 0 10"];
    let side = |[a, b, c]: [usize; 3]| {
        let [a, b, c] = [corners[a], corners[b], corners[c]];
        format!("facet\nouter loop\nvertex {a}\nvertex {b}\nvertex {c}\nendloop\nendfacet\n")
    };
    let sides = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
        .map(side)
        .concat();
    fs::write(path("tent.stl"), format!("solid tent\n{sides}endsolid\n")).expect("written");
    let mut read = 0;
    for (at, block) in blocks.iter().enumerate() {
        if block.contains("[run]") {
            fs::write(path("yard.toml"), blocks[at + 1]).expect("written");
            fs::write(path("s.toml"), block).expect("written");
            let loaded = load_file(&path("s.toml"), &Request::default());
            let loaded = loaded.unwrap_or_else(|r| panic!("{}", shown(&r)));
            assert_eq!(loaded.plan().world.obstacles[0].label, "one of 40");
            assert_eq!(loaded.setup().expect("good").models.len(), 40);
            read += 1;
        } else if !block.contains("${") {
            fs::write(path("w.toml"), block).expect("written");
            match check_file(&path("w.toml"), &Request::default()) {
                Ok(Checked::World { faults, .. }) => assert_eq!(faults, [], "{block}"),
                Ok(Checked::Scenario(_)) => panic!("this is a world:\n{block}"),
                Err(rejected) => panic!("{}", shown(&rejected)),
            }
            read += 1;
        }
    }
    assert_eq!(read, 8);
}
