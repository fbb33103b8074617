//! Meshes, grids and pictures: each format, and each with all its faults.

use super::*;
use simbeeotic_model::kernel::Stream;

/// A cube from the origin to (1, 2, 3), each side of two triangles that look outwards.
const CORNERS: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 2.0, 0.0],
    [0.0, 2.0, 0.0],
    [0.0, 0.0, 3.0],
    [1.0, 0.0, 3.0],
    [1.0, 2.0, 3.0],
    [0.0, 2.0, 3.0],
];
const SIDES: [[u16; 3]; 12] = [
    [0, 2, 1],
    [0, 3, 2],
    [4, 5, 6],
    [4, 6, 7],
    [0, 1, 5],
    [0, 5, 4],
    [2, 3, 7],
    [2, 7, 6],
    [1, 2, 6],
    [1, 6, 5],
    [3, 0, 4],
    [3, 4, 7],
];

/// The volume within a closed surface whose triangles look outwards.
fn volume(read: &Triangles) -> f64 {
    let corner = |i: u32| simbeeotic_units::glam::DVec3::from_array(read.points[i as usize]);
    let cone = |[a, b, c]: &[u32; 3]| corner(*a).dot(corner(*b).cross(corner(*c))) / 6.0;
    read.triangles.iter().map(cone).sum()
}

fn is_the_cube(read: &Triangles) {
    assert_eq!((read.points.len(), read.triangles.len()), (8, 12));
    assert!((volume(read) - 6.0).abs() < 1e-12, "{}", volume(read));
}

fn binary_stl() -> Vec<u8> {
    let mut bytes = b"solid in name only".to_vec();
    bytes.resize(80, 0);
    bytes.extend(12_u32.to_le_bytes());
    for side in SIDES {
        bytes.extend([0; 12]);
        for corner in side {
            let numbers = CORNERS[usize::from(corner)];
            bytes.extend(numbers.iter().flat_map(|x| x.to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn ascii_stl() -> String {
    let mut text = "solid cube\n".to_owned();
    for side in SIDES {
        text += " facet normal 0 0 0\n  outer loop\n";
        for corner in side {
            let [x, y, z] = CORNERS[usize::from(corner)];
            text += &format!("   vertex {x:e} {y} {z}\n");
        }
        text += "  endloop\n endfacet\n";
    }
    text + "endsolid cube\n"
}

/// Four-sided faces, normals, a comment, a line in two, and corners counted backwards.
fn obj() -> String {
    let mut text = "# a cube\no cube\n".to_owned();
    for [x, y, z] in CORNERS {
        text += &format!("v {x} {y} {z}\n");
    }
    text + "vn 0 0 1\nf 1//1 4//1 3//1 2//1\nf 5 6 7 8\nf 1/2/1 2/2/1 6/2/1 5/2/1\n\
            f 3 4 \\\n 8 7\nf -7 -6 -2 -3\nf 4 1 5 8\n"
}

fn gltf_bytes() -> Vec<u8> {
    let mut bytes: Vec<u8> = CORNERS
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    bytes.extend(SIDES.iter().flatten().flat_map(|i| i.to_le_bytes()));
    bytes
}

/// A cube in a node that is moved, in a node that is mirrored and half as large.
fn gltf_json(buffer: &str) -> String {
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [1]}}],
        "nodes": [{{"mesh": 0, "translation": [5, 0, 0]}},
                  {{"children": [0], "scale": [-0.5, 0.5, 0.5]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "indices": 1}}]}}],
        "accessors": [
          {{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"}},
          {{"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 96}},
                        {{"buffer": 0, "byteOffset": 96, "byteLength": 72}}],
        "buffers": [{{{buffer}"byteLength": 168}}]}}"#
    )
}

fn glb() -> Vec<u8> {
    let mut json = gltf_json("").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let inner = gltf_bytes();
    let mut bytes = b"glTF".to_vec();
    let word = |n: usize| (n as u32).to_le_bytes();
    bytes.extend([word(2), word(28 + json.len() + inner.len())].concat());
    bytes.extend(word(json.len()));
    bytes.extend(b"JSON");
    bytes.extend(json);
    bytes.extend(word(inner.len()));
    bytes.extend(b"BIN\0");
    bytes.extend(inner);
    bytes
}

fn alone(_: &str) -> Result<Vec<u8>, String> {
    Err("there are no other files here".into())
}

#[test]
fn every_format_of_meshes_gives_the_same_cube() {
    is_the_cube(&stl::parse(&binary_stl()).expect("good"));
    is_the_cube(&stl::parse(ascii_stl().as_bytes()).expect("good"));
    is_the_cube(&obj::parse(&obj()).expect("good"));
}

#[test]
fn a_gltf_scene_puts_its_meshes_where_its_nodes_say() {
    let beside = gltf_json(r#""uri": "cube.bin", "#);
    let read = gltf::parse(beside.as_bytes(), |name| {
        assert_eq!(name, "cube.bin");
        Ok(gltf_bytes())
    });
    let in_one = gltf::parse(&glb(), alone).expect("good");
    assert_eq!(read.expect("good"), in_one);
    assert_eq!((in_one.points.len(), in_one.triangles.len()), (8, 12));
    // An eighth of six cubic metres; positive, so no triangle looks inwards.
    assert!((volume(&in_one) - 0.75).abs() < 1e-12);
    // Moved by five to the east first, then mirrored and halved.
    assert_eq!(in_one.points[6], [-3.0, 1.0, 1.5]);
}

#[test]
fn damaged_meshes_say_what_is_wrong_with_them() {
    let said = |result: Result<Triangles, String>| result.expect_err("damaged");
    let mut short = binary_stl();
    short.truncate(500);
    let wanted = "a binary STL file of 12 triangles has 684 bytes, not 500";
    assert_eq!(said(stl::parse(&short)), wanted);
    // `solid NAME` and zeros are good text.
    let wanted = "a binary STL file of 12 triangles has 684 bytes, not 84";
    assert_eq!(said(stl::parse(&binary_stl()[..84])), wanted);
    let mut odd = binary_stl();
    odd[84 + 50 + 12..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
    assert_eq!(
        said(stl::parse(&odd)),
        "triangle 1 has a corner that is no number"
    );
    let text = ascii_stl().replacen("vertex 0e0 0 0", "vertex 0e0 0 x", 1);
    assert_eq!(
        said(stl::parse(text.as_bytes())),
        "line 4: a vertex has three numbers"
    );
    for words in ["0 abc 0 0", "0 0 0 0", "0 0 1e999"] {
        let text = ascii_stl().replacen("vertex 0e0 0 0", &format!("vertex {words}"), 1);
        let wanted = "line 4: a vertex has three numbers";
        assert_eq!(said(stl::parse(text.as_bytes())), wanted, "{words}");
    }
    assert_eq!(
        said(stl::parse(b"PK")),
        "this is no STL file: it is too short"
    );
    assert_eq!(
        said(obj::parse("v 1 2 3\nf 1 2 3\n")),
        "line 2: there is no point 2: there are 1 before it"
    );
    assert_eq!(
        said(obj::parse("v 1 2\n")),
        "line 1: a point has three numbers"
    );
    let json = gltf_json("").replace("\"count\": 36", "\"count\": 37");
    let message = said(gltf::parse(json.as_bytes(), |_| Ok(gltf_bytes())));
    assert_eq!(message, "buffer 0 has no bytes");
    let json = gltf_json(r#""uri": "x", "#).replace("\"count\": 36", "\"count\": 37");
    let message = said(gltf::parse(json.as_bytes(), |_| Ok(gltf_bytes())));
    assert_eq!(
        message,
        "mesh 0: accessor 1 reaches past the end of its bytes"
    );
    let json = gltf_json(r#""uri": "x", "#).replace("[0], \"scale\"", "[1], \"scale\"");
    let message = said(gltf::parse(json.as_bytes(), |_| Ok(gltf_bytes())));
    assert_eq!(message, "its nodes are nested too deeply, or in a circle");
    let json = gltf_json("").replace(
        "\"scene\"",
        "\"extensionsRequired\": [\"EXT_odd\"], \"scene\"",
    );
    let message = said(gltf::parse(json.as_bytes(), alone));
    assert_eq!(message, "it needs the extension EXT_odd, which is not read");
}

/// Cuts a file everywhere, and changes bytes of it, and parses what comes out.
fn torture<T>(bytes: &[u8], parse: impl Fn(&[u8]) -> Result<T, String>) {
    for end in 0..bytes.len() {
        let _ = parse(&bytes[..end]);
    }
    let mut stream = Stream::new(1, "files", "torture");
    let mut failed = 0;
    for _ in 0..3_000 {
        let mut damaged = bytes.to_vec();
        for _ in 0..1 + stream.below(4) {
            let at = stream.below(bytes.len() as u64) as usize;
            damaged[at] = match stream.below(3) {
                0 => stream.next_u64() as u8,
                1 => damaged[at].wrapping_add(1),
                _ => b"0123456789-{}[]/\xff"[stream.below(17) as usize],
            };
        }
        failed += u32::from(parse(&damaged).is_err());
    }
    assert!(failed > 0, "no change was noticed");
}

#[test]
fn no_damage_makes_a_reader_panic() {
    torture(&binary_stl(), stl::parse);
    torture(ascii_stl().as_bytes(), stl::parse);
    torture(obj().as_bytes(), |b| obj::parse(text(b)?));
    torture(&glb(), |b| gltf::parse(b, alone));
    let json = gltf_json(r#""uri": "x", "#);
    torture(json.as_bytes(), |b| gltf::parse(b, |_| Ok(gltf_bytes())));
    let range = (Some(0.0), Some(8.0));
    torture(
        &png(png::ColorType::Grayscale, png::BitDepth::Sixteen),
        |b| picture::parse(b, range),
    );
    torture(ASC.as_bytes(), |b| grid::parse_asc(text(b)?));
    torture(b"1,2,3\n4,5,6\n7,8,9\n", |b| grid::parse_csv(text(b)?));
}

/// Three columns and two rows: 0, 1/2 and 1 of white, then white.
fn png(color: png::ColorType, depth: png::BitDepth) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 3, 2);
    encoder.set_color(color);
    encoder.set_depth(depth);
    let mut writer = encoder.write_header().expect("written");
    let shades: [u16; 6] = [0, 0x8080, 0xffff, 0xffff, 0xffff, 0xffff];
    let pixels: Vec<u8> = match (color, depth) {
        (png::ColorType::Rgb, _) => vec![7; 18],
        (_, png::BitDepth::Sixteen) => shades.iter().flat_map(|s| s.to_be_bytes()).collect(),
        _ => shades.iter().map(|s| (s >> 8) as u8).collect(),
    };
    writer.write_image_data(&pixels).expect("written");
    writer.finish().expect("written");
    bytes
}

#[test]
fn a_grey_picture_is_a_grid_from_black_to_white() {
    let range = (Some(-1.0), Some(9.0));
    for depth in [png::BitDepth::Eight, png::BitDepth::Sixteen] {
        let grid = picture::parse(&png(png::ColorType::Grayscale, depth), range).expect("good");
        assert_eq!((grid.rows.len(), grid.rows[0].len()), (2, 3));
        assert_eq!(
            (grid.rows[0][0], grid.rows[0][2], grid.rows[1][0]),
            (-1.0, 9.0, 9.0)
        );
        let half = -1.0 + 10.0 * f64::from(0x8080) / 65_535.0;
        assert!((grid.rows[0][1] - half).abs() < 1e-12);
    }
    let colours = png(png::ColorType::Rgb, png::BitDepth::Eight);
    let said = picture::parse(&colours, range).err();
    assert!(said.is_some_and(|m| m.contains("has colours")));
    let grey = png(png::ColorType::Grayscale, png::BitDepth::Eight);
    let said = picture::parse(&grey, (None, None)).err();
    assert!(said.is_some_and(|m| m.contains("`max_height`")));
}

const ASC: &str = "ncols 3\nnrows 2\nxllcorner 100.5\nyllcorner 200\ncellsize 5\n\
                   NODATA_value -9999\n1 2 3\n4 5 6.5\n";

#[test]
fn an_esri_grid_says_itself_how_large_it_is() {
    let grid = grid::parse_asc(ASC).expect("good");
    assert_eq!(grid.rows, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.5]]);
    assert_eq!((grid.length_m, grid.width_m), (Some(10.0), Some(5.0)));
    let said = |text: &str| grid::parse_asc(text).err().expect("damaged");
    let gap = ASC.replace("5 6.5", "-9999 6.5");
    assert_eq!(
        said(&gap),
        "line 8: a cell without data: fill the grid's gaps first"
    );
    assert_eq!(
        said(&ASC.replace("6.5", "")),
        "3 times 2 heights are announced, 5 are there"
    );
    assert!(said(&ASC.replace("ncols 3", "ncols 3.5")).contains("`ncols`"));
    assert!(said(&ASC.replace("cellsize 5", "cellsize 0")).contains("`cellsize`"));
    assert!(said(&ASC.replace("cellsize", "cellsice")).starts_with("line 5:"));
}

#[test]
fn plain_lines_are_a_grid_and_are_stretched_if_asked() {
    let grid = grid::parse_csv("# hills\n0, 1, 2\n\n3, 4, 5\n").expect("good");
    assert_eq!(grid.rows, [[0.0, 1.0, 2.0], [3.0, 4.0, 5.0]]);
    let grid = grid::stretch(grid, (Some(10.0), Some(20.0))).expect("good");
    assert_eq!(grid.rows[1], [16.0, 18.0, 20.0]);
    let said = |text: &str| grid::parse_csv(text).err().expect("damaged");
    assert_eq!(said("1,2\n3\n"), "line 2: 1 heights, in the first 2");
    assert_eq!(said("1,x\n3,4\n"), "line 1: `x` is no height");
    assert_eq!(said("1,2\n"), "a grid has two lines of heights or more");
    let flat = || grid::parse_csv("1,1\n1,1\n").expect("good");
    assert!(grid::stretch(flat(), (Some(0.0), Some(1.0))).is_err());
    assert!(grid::stretch(flat(), (Some(0.0), None)).is_err());
}

#[test]
fn a_file_that_many_name_is_read_once_and_stands_in_world_axes() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("cube.OBJ"), obj()).expect("written");
    let tree = |scale| Obstacle {
        shape: ObstacleShape::Mesh(Mesh {
            file: Some("cube.OBJ".into()),
            scale,
            ..Mesh::default()
        }),
        ..Obstacle::default()
    };
    let mut world = World {
        obstacles: vec![tree(1.0), tree(0.1)],
        ..World::default()
    };
    assert_eq!(fill(&mut world, folder.path()), Found::default());
    let ObstacleShape::Mesh(mesh) = &world.obstacles[1].shape else {
        panic!("it is a mesh");
    };
    assert_eq!(mesh.file, None);
    assert_eq!(mesh.triangles.len(), 12);
    // The file's (1, 2, 3) with y up, a tenth as large.
    let far = mesh.points[6].si() - simbeeotic_units::glam::DVec3::new(0.1, -0.3, 0.2);
    assert!(far.length() < 1e-12);
    assert!(world.check().is_empty());
}

#[test]
fn what_is_wrong_is_told_at_the_key() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("hills.csv"), "1,2\n3,4\n").expect("written");
    fs::write(folder.path().join("a.txt"), "text").expect("written");
    let mut world: World = serde_json::from_str(
        r#"{"obstacle": [
            {"shape": {"mesh": {"file": "no.stl"}}},
            {"shape": {"parts": [{"shape": {"hull": {"file": "a.txt"}}}]}},
            {"shape": {"mesh": {"scale": 2, "points": [], "triangles": []}},
             "texture": {"file": "a.txt"}}],
          "terrain": {"height_field": {"file": "hills.csv", "length": "4 m"}}}"#,
    )
    .expect("a world");
    let found = fill(&mut world, folder.path());
    assert_eq!(found.warnings.len(), 1);
    assert_eq!(found.warnings[0].path, "obstacle.2.texture.file");
    let told: Vec<(&str, &str)> = found
        .errors
        .iter()
        .map(|e| (&*e.path, &*e.message))
        .collect();
    assert!(told[0].1.starts_with("no.stl: "), "{told:?}");
    let paths: Vec<&str> = told.iter().map(|t| t.0).collect();
    assert_eq!(
        paths,
        [
            "obstacle.0.shape.mesh.file",
            "obstacle.1.shape.parts.0.shape.hull.file",
            "obstacle.2.shape.mesh.scale",
            "terrain.height_field.width",
        ]
    );
}

#[test]
fn the_name_of_a_gltf_buffer_is_percent_decoded() {
    let asked = |uri: &str| {
        let json = gltf_json(&format!("\"uri\": \"{uri}\", "));
        let name = std::cell::RefCell::new(String::new());
        gltf::parse(json.as_bytes(), |file| {
            name.replace(file.to_owned());
            Ok(gltf_bytes())
        })
        .map(|read| {
            assert_eq!(read.triangles.len(), 12);
            name.take()
        })
    };
    assert_eq!(asked("my%20cube%C3%a9+1.bin"), Ok("my cubeé+1.bin".into()));
    for uri in ["50%", "50%2", "50%+1"] {
        let wanted = format!("{uri}: two hexadecimal digits follow a `%`");
        assert_eq!(asked(uri), Err(wanted));
    }
    assert_eq!(asked("%ff"), Err("%ff: its name is not UTF-8".into()));
}

#[cfg(unix)]
#[test]
fn devices_and_folders_are_refused_unread() {
    let mut world: World = serde_json::from_str(
        r#"{"obstacle": [
            {"shape": {"mesh": {"file": "zero.stl"}}, "texture": {"file": "zero.png"}},
            {"shape": {"hull": {"file": "folder.obj"}}}],
          "terrain": {"height_field": {"file": "zero.png", "length": "4 m", "width": "4 m",
                                       "max_height": "1 m"}}}"#,
    )
    .expect("a world");
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["zero.stl", "zero.png"] {
        std::os::unix::fs::symlink("/dev/zero", folder.path().join(name)).expect("linked");
    }
    fs::create_dir(folder.path().join("folder.obj")).expect("made");
    let found = fill(&mut world, folder.path());
    let told = |e: &[WorldError]| e.iter().map(|e| e.message.clone()).collect::<Vec<_>>();
    assert_eq!(
        told(&found.errors),
        [
            "zero.stl: this is not a plain file",
            "folder.obj: this is not a plain file",
            "zero.png: this is not a plain file",
        ]
    );
    assert_eq!(
        told(&found.warnings),
        ["zero.png: this is not a plain file"]
    );
}

#[test]
fn of_a_texture_only_the_beginning_is_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("a.png");
    fs::write(&file, [7; 100]).expect("written");
    assert_eq!(read_start(&file, 8), Ok(vec![7; 8]));
    assert_eq!(read(&file).map(|bytes| bytes.len()), Ok(100));
}

#[test]
fn white_lies_above_black_even_if_black_is_left_out() {
    let folder = tempfile::tempdir().expect("a folder");
    let picture = png(png::ColorType::Grayscale, png::BitDepth::Eight);
    fs::write(folder.path().join("hills.png"), picture).expect("written");
    let told = |heights: &str| {
        let text = format!(
            r#"{{"terrain": {{"height_field": {{"file": "hills.png", "length": "4 m",
                "width": "4 m", {heights}}}}}}}"#
        );
        let mut world: World = serde_json::from_str(&text).expect("a world");
        fill(&mut world, folder.path()).errors
    };
    for upside_down in [
        r#""max_height": "-3 m""#,
        r#""max_height": "0 m""#,
        r#""min_height": "2 m", "max_height": "1 m""#,
    ] {
        let errors = told(upside_down);
        assert_eq!(errors[0].path, "terrain.height_field.max_height");
    }
    assert_eq!(told(r#""max_height": "3 m""#), []);
    assert_eq!(told(r#""min_height": "-5 m", "max_height": "-3 m""#), []);
}
