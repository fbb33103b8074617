//! Broken files by the hundred: each gives an error with its line and column, none panics.

use crate::{TOML, WORLD, XML};
use proptest::prelude::*;
use simbeeotic_model::config::{Fault, Sources};
use simbeeotic_scenario::xml::Document;
use simbeeotic_scenario::{Request, load_text, render, xml};

/// One broken text, and what was done to it.
struct Broken {
    what: String,
    text: String,
}

/// The lines of a text with one of them replaced.
fn with_line(text: &str, number: usize, line: &str, what: &str) -> Broken {
    let mut lines: Vec<&str> = text.lines().collect();
    let old = lines[number];
    let what = format!("line {}: {what}: {old}", number + 1);
    lines[number] = line;
    Broken {
        what,
        text: lines.join("\n") + "\n",
    }
}

/// Breaks each line of the TOML file in several ways.
fn broken_toml() -> Vec<Broken> {
    let mut all = Vec::new();
    for (number, line) in TOML.lines().enumerate() {
        let mut add = |line: String, what| all.push(with_line(TOML, number, &line, what));
        if let Some(header) = line.strip_prefix('[') {
            add(line.trim_end_matches(']').to_owned(), "the bracket is open");
            add(format!("{line} x"), "something behind the bracket");
            // Names of sensors and radios are the user's own.
            if !header.contains("sensor.") && !header.contains("radio.") {
                add(line.replacen(']', "zz]", 1), "a misspelt section");
            }
        } else if let Some((key, value)) = line.split_once(" = ") {
            // Metadata is the user's own too.
            let free = key == "meta";
            add(format!("{key}zz = {value}"), "a misspelt key");
            add(format!("{key} {value}"), "no equals sign");
            add(format!("{key} = "), "no value");
            add(format!("{key} = {{ nonsense = 1 }}"), "a table of nonsense");
            add(format!("{key} = nan"), "not a number");
            add(format!("{key} = []"), "empty array");
            add(format!("{line}\n{line}"), "twice");
            if value.contains('"') {
                add(line.replacen('"', "", 1), "a quote is missing");
                if !free && key != "name" && key != "description" && key != "label" {
                    add(line.replacen('"', "\"zz", 1), "a misspelt text");
                }
            }
            for unit in [" m/s", " m\"", " s\"", " deg\"", " dBm\"", " kg\""] {
                if value.contains(unit) {
                    let end = if unit.ends_with('"') { "\"" } else { "" };
                    add(line.replacen(unit, end, 1), "a unit is missing");
                    add(
                        line.replacen(unit, &format!(" furlong{end}"), 1),
                        "an unknown unit",
                    );
                }
            }
        }
    }
    // The name of a picture is the user's own.
    all.retain(|b| !b.what.contains("misspelt text: texture"));
    all
}

/// Breaks each line of an XML file in several ways.
fn broken_xml(text: &str) -> Vec<Broken> {
    let mut all = Vec::new();
    for (number, line) in text.lines().enumerate().skip(1) {
        let mut add = |line: String, what| all.push(with_line(text, number, &line, what));
        let bare = line.trim();
        if bare.starts_with("</") {
            add(String::new(), "an end tag is missing");
            add(line.replace("</", "</zz"), "another end tag");
        } else if bare.starts_with('<') {
            add(line.replacen('<', "", 1), "no `<`");
            add(line.replacen('<', "<<", 1), "two `<`");
            let unclosed = line.trim_end_matches('>').trim_end_matches('/');
            add(format!("{unclosed} <"), "a tag is not closed");
            if line.contains('"') {
                add(line.replacen('"', "", 1), "a quote is missing");
                add(line.replacen('=', "", 1), "no equals sign");
                add(line.replacen("=\"", "=\"&zz;", 1), "an unknown entity");
                let attribute = line.split_whitespace().nth(1).unwrap_or("");
                let attribute = attribute.trim_end_matches(['/', '>']);
                if !attribute.contains("xmlns") {
                    let doubled = format!("{attribute} {attribute}");
                    add(line.replacen(attribute, &doubled, 1), "an attribute twice");
                }
            }
            for value in numbers(line) {
                add(
                    line.replacen(&format!("\"{value}\""), "\"zz\"", 1),
                    "no number",
                );
                add(
                    line.replacen(&format!("\"{value}\""), "\"\"", 1),
                    "no value",
                );
            }
            if bare.starts_with("<java-class>") {
                add(line.replace("</java", "zz</java"), "an unknown class");
                add(String::new(), "no class");
                add(format!("{line}{line}"), "two classes");
            }
            for required in ["end-time", "simulation", "models", "density", "position"] {
                if bare.starts_with(&format!("<{required}")) {
                    add(
                        line.replace(required, "zz"),
                        "a required element is misspelt",
                    );
                }
            }
        }
    }
    // Names and texts are the user's own, whatever they are.
    all.retain(|b| {
        let free = b.what.contains("<label>") || b.what.contains("<name>");
        !(free && b.what.contains("no number"))
    });
    all
}

/// The values in quotes that are numbers, of attributes that must be.
fn numbers(line: &str) -> Vec<String> {
    let mut all = Vec::new();
    for part in line.split_whitespace() {
        let Some((name, rest)) = part.split_once("=\"") else {
            continue;
        };
        let value = rest.split('"').next().unwrap_or("");
        let meta = line.contains("name=\"foo\"")
            || line.contains("name=\"pollen\"")
            || line.contains("name=\"person-id\"")
            || line.contains("name=\"floor\"");
        if name != "name" && !meta && value.parse::<f64>().is_ok() {
            all.push(value.to_owned());
        }
    }
    all
}

/// Asserts that every broken text gives an error that names a line and a column of the text.
fn refuse_all(broken: &[Broken], load: impl Fn(&str) -> Result<(), (Vec<Fault>, Sources)>) {
    let mut accepted = Vec::new();
    for Broken { what, text } in broken {
        let Err((faults, sources)) = load(text) else {
            accepted.push(what.clone());
            continue;
        };
        in_the_words_of_users(what, &faults);
        let said = render::faults(&faults, &sources, false);
        let place = said
            .split("--> broken:")
            .nth(1)
            .and_then(|rest| rest.lines().next());
        let numbers: Vec<usize> = place
            .unwrap_or("")
            .split(':')
            .filter_map(|n| n.parse().ok())
            .collect();
        let [line, column] = numbers[..] else {
            panic!("{what}: no line and column in\n{said}")
        };
        assert!(
            line >= 1 && line <= text.lines().count() + 1 && column >= 1,
            "{what}: {said}"
        );
    }
    assert!(
        accepted.is_empty(),
        "{} were accepted:\n{}",
        accepted.len(),
        accepted.join("\n")
    );
}

fn load(text: &str) -> Result<(), (Vec<Fault>, Sources)> {
    match load_text("broken", text, &Request::default()) {
        Ok(_) => Ok(()),
        Err(rejected) => Err((rejected.faults, rejected.sources)),
    }
}

fn load_world(text: &str) -> Result<(), (Vec<Fault>, Sources)> {
    let mut sources = Sources::new();
    let id = sources.add("broken", text);
    match xml::parse(text, id, Document::World, &mut Default::default()) {
        Ok(_) => Ok(()),
        Err(faults) => Err((faults, sources)),
    }
}

#[test]
fn broken_scenarios_in_toml_are_refused_with_line_and_column() {
    let broken = broken_toml();
    assert!(broken.len() >= 200, "{}", broken.len());
    refuse_all(&broken, load);
}

#[test]
fn broken_scenarios_in_xml_are_refused_with_line_and_column() {
    let broken = broken_xml(XML);
    assert!(broken.len() >= 200, "{}", broken.len());
    refuse_all(&broken, load);
}

#[test]
fn broken_worlds_in_xml_are_refused_with_line_and_column() {
    let broken = broken_xml(WORLD);
    assert!(broken.len() >= 200, "{}", broken.len());
    refuse_all(&broken, load_world);
}

/// Values of every type that TOML has, most of them wrong wherever they stand.
const VALUES: [&str; 18] = [
    "true",
    "0",
    "-1",
    "9223372036854775807",
    "-9223372036854775808",
    "0.5",
    "-1e300",
    "\"\"",
    "\"zz\"",
    "\"1 m\"",
    "\"-1e300 s\"",
    "\"0.1 ns\"",
    "[]",
    "[1]",
    "[\"1 m\", \"1 m\"]",
    "[[1, 2, 3, 4, 5, 6, 7, 8]]",
    "{}",
    "{ use = 1, 0 = [] }",
];

/// Asserts that all errors have a place, and that none speaks of the program's own types.
fn in_the_words_of_users(what: &str, faults: &[Fault]) {
    for fault in faults.iter().filter(|f| f.is_error()) {
        assert!(fault.span.is_some(), "{what}: {fault:?}");
        let words = format!("{} {}", fault.message, fault.help.as_deref().unwrap_or(""));
        for word in [
            "invalid type",
            "invalid value",
            "invalid length",
            "expected i",
            "expected u",
            "expected struct",
            "expected a ",
            "struct ",
            "enum ",
            "variant",
            "untagged",
            "tuple",
            "u64",
            "i64",
            "f64",
            "u32",
            "u8",
            "usize",
            "Some(",
            "NaN",
        ] {
            assert!(!words.contains(word), "{what}: `{word}` in {words}");
        }
    }
}

#[test]
fn values_of_a_wrong_type_are_told_in_the_words_of_users() {
    let mut refused = 0;
    for (number, line) in TOML.lines().enumerate() {
        let Some((key, _)) = line.split_once(" = ") else {
            continue;
        };
        for value in VALUES {
            let Broken { what, text } = with_line(TOML, number, &format!("{key} = {value}"), value);
            if let Err(rejected) = load_text("broken", &text, &Request::default()) {
                refused += 1;
                in_the_words_of_users(&what, &rejected.faults);
            }
        }
    }
    assert!(refused >= 1000, "{refused}");
}

#[test]
fn overrides_of_a_wrong_type_are_told_in_the_words_of_users() {
    let keys = [
        "run",
        "run.seed",
        "run.threads",
        "channel",
        "channel.medium",
        "weather",
        "weather.wind",
        "world",
        "world.radius",
        "world.obstacle",
        "world.person",
        "physics",
        "physics.ground",
        "record",
        "component",
        "model",
        "model.0",
        "model.0.start",
        "model.0.count",
        "model.0.params",
        "model.0.vehicle",
        "model.0.sensor",
        "model.0.sensor.x",
        "model.0.sensor.x.mount",
        "model.0.radio",
        "model.0.radio.antenna",
        "model.0.model",
        "model.0.start.list",
        "model.0.start.grid",
        "model.0.start.file",
        "model.0.use",
        "sweep",
    ];
    for key in keys {
        for value in VALUES {
            let argument = format!("{key}={value}");
            let request = Request {
                sets: vec![argument.clone()],
                ..Request::default()
            };
            if let Err(rejected) = load_text("broken", TOML, &request) {
                in_the_words_of_users(&argument, &rejected.faults);
            }
        }
    }
}

/// One change of a text: at a place, some characters go and others come.
fn edit() -> impl Strategy<Value = (prop::sample::Index, usize, String)> {
    let comes = prop_oneof![
        ".{0,3}",
        prop::sample::select(vec![
            "[",
            "]",
            "{",
            "}",
            "\"",
            "'",
            "\n",
            "=",
            ".",
            "<",
            ">",
            "/>",
            "&",
            "<!--",
            "-->",
            "[[",
            "]]",
            "\"\"\"",
            "-",
            "1e999",
            "nan",
            "\\",
            "\u{0}",
            "<![CDATA[",
            "<?",
            "<!DOCTYPE x>",
        ])
        .prop_map(str::to_owned),
    ];
    (any::<prop::sample::Index>(), 0..6_usize, comes)
}

fn edited(text: &str, edits: &[(prop::sample::Index, usize, String)]) -> String {
    let mut letters: Vec<char> = text.chars().collect();
    for (at, goes, comes) in edits {
        let at = at.index(letters.len() + 1);
        let end = (at + goes).min(letters.len());
        letters.splice(at..end, comes.chars());
    }
    letters.into_iter().collect()
}

/// Whatever the text, loading ends with a plan or with faults that can be shown.
fn survives(text: &str) {
    match load_text("broken", text, &Request::default()) {
        Ok(loaded) => {
            render::faults(loaded.faults(), loaded.sources(), false);
        }
        Err(rejected) => {
            assert!(rejected.faults.iter().any(Fault::is_error));
            render::faults(&rejected.faults, &rejected.sources, true);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn no_edit_of_a_toml_file_panics(edits in prop::collection::vec(edit(), 1..6)) {
        survives(&edited(TOML, &edits));
    }

    #[test]
    fn no_edit_of_an_xml_file_panics(edits in prop::collection::vec(edit(), 1..6)) {
        survives(&edited(XML, &edits));
        let _ = load_world(&edited(WORLD, &edits));
    }

    #[test]
    fn no_text_at_all_panics(text in "\\PC{0,200}") {
        survives(&text);
        survives(&format!("<{text}"));
        let _ = load_world(&text);
    }

    #[test]
    fn no_override_panics(argument in "(run|model|channel)?[.]?[a-z0-9.\"=\\[\\]{} ]{0,30}") {
        let request = Request { sets: vec![argument], ..Request::default() };
        if let Err(rejected) = load_text("x.toml", TOML, &request) {
            render::faults(&rejected.faults, &rejected.sources, false);
        }
    }
}
