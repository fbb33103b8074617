//! Files that are not there, not text, or named by a scenario.

use crate::{FIGURE12, WORLD, good, shown};
use simbeeotic_scenario::{Request, convert_file, load_file};
use std::fs;
use std::path::Path;

const SCENARIO: &str =
    "[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\nstart = { file = \"p.csv\" }\n";

/// Loads a scenario that stands in a folder with other files; its faults without the folder.
fn load(scenario: &[u8], others: &[(&str, &[u8])]) -> Result<usize, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("x.toml");
    fs::write(&path, scenario).expect("written");
    for (name, bytes) in others {
        fs::write(folder.path().join(name), bytes).expect("written");
    }
    match load_file(&path, &Request::default()) {
        Ok(loaded) => Ok(loaded.setup().expect("a set-up").models.len()),
        Err(r) => Err(shown(&r).replace(&format!("{}/", folder.path().display()), "")),
    }
}

#[test]
fn positions_come_from_a_file() {
    let csv = b"x_m,y_m,z_m\n# the first row\n1,2,3\n\n4.5, -5, 0\r\n";
    assert_eq!(load(SCENARIO.as_bytes(), &[("p.csv", csv)]), Ok(2));
}

#[test]
fn a_wrong_line_of_positions_is_shown() {
    let csv = b"x,y,z\n1,2,3\n1,2\nnorth,2,3\n1,2,nan\n";
    let said = load(SCENARIO.as_bytes(), &[("p.csv", csv)]).expect_err("wrong");
    insta::assert_snapshot!(said);
    let said = load(SCENARIO.as_bytes(), &[("p.csv", b"x,y,z\n")]).expect_err("empty");
    assert!(said.contains("x.toml:5:18"), "{said}");
}

#[test]
fn only_words_are_a_heading() {
    for heading in [
        "1 m,2 m,3 m\n",
        "-x,-y,-z\n",
        ".1.,.2.,.3.\n",
        "x,y,3 m\n",
        "1e3x,y,z\n",
    ] {
        let csv = format!("{heading}1,2,3\n");
        let said = load(SCENARIO.as_bytes(), &[("p.csv", csv.as_bytes())]).expect_err("wrong");
        assert!(
            said.contains("no position") && said.contains("p.csv:1:1"),
            "{heading}{said}"
        );
    }
    for heading in [
        "east,north,up\n",
        "# a comment\nx,y,z\n",
        "\u{feff}\"x\",\"y\",\"z\"\n",
        "\n",
    ] {
        let csv = format!("{heading}1,2,3\n");
        assert_eq!(
            load(SCENARIO.as_bytes(), &[("p.csv", csv.as_bytes())]),
            Ok(1),
            "{heading}"
        );
    }
    let said = load(
        SCENARIO.as_bytes(),
        &[("p.csv", b"1,2,3\nx,y,z\n4,1e300,6\n")],
    );
    let said = said.expect_err("wrong");
    assert!(
        said.contains("p.csv:2:1") && said.contains("p.csv:3:1"),
        "{said}"
    );
}

#[test]
fn an_empty_world_file_is_called_empty() {
    let scenario = b"world = \"w.toml\"\n[run]\nend_time = \"1 s\"\n";
    let said = load(scenario, &[("w.toml", b"\n")]).expect_err("empty");
    assert!(
        said.contains("this file is empty") && said.contains("w.toml:1:1"),
        "{said}"
    );
}

#[test]
fn a_file_that_is_not_there_is_named_where_it_is_asked_for() {
    let said = load(SCENARIO.as_bytes(), &[]).expect_err("missing");
    assert!(
        said.contains("cannot read p.csv") && said.contains("x.toml:5:18"),
        "{said}"
    );
    let said = load_file(Path::new("no/such.toml"), &Request::default())
        .err()
        .map(|r| shown(&r));
    assert!(said.is_some_and(|s| s.contains("cannot read no/such.toml")));
}

#[test]
fn bytes_that_are_no_text_are_refused_with_their_place() {
    let said = load(b"[run]\nseed = \xff\xfe\n", &[]).expect_err("no text");
    assert!(
        said.contains("not UTF-8") && said.contains("x.toml:2:8"),
        "{said}"
    );
    assert!(load(&[0x89, b'P', b'N', b'G', 0, 0, 0xff], &[]).is_err());
    assert!(
        load(b"\xef\xbb\xbf[run]\nend_time = \"1 s\"\n", &[]).is_ok(),
        "a byte order mark"
    );
}

#[test]
fn converted_scenario_and_world_stand_beside_each_other() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("f.xml"), FIGURE12).expect("written");
    fs::write(path("w.xml"), WORLD).expect("written");
    let world =
        simbeeotic_scenario::convert_world(&path("w.xml"), &Default::default()).expect("good");
    fs::write(path("w.toml"), world.toml).expect("written");
    let converted = convert_file(&path("f.xml"), Some(&path("w.toml"))).expect("good");
    assert!(
        converted.toml.contains("world = \"w.toml\""),
        "{}",
        converted.toml
    );
    fs::write(path("f.toml"), &converted.toml).expect("written");
    let loaded =
        load_file(&path("f.toml"), &Request::default()).unwrap_or_else(|r| panic!("{}", shown(&r)));
    assert_eq!(loaded.plan().world.obstacles.len(), 8);
    let plain = convert_file(&path("f.xml"), None).expect("good");
    assert!(!plain.toml.contains("world"));
    good("f.toml", &plain.toml);
}
