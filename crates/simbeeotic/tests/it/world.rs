//! `simbeeotic world`: worlds that are written, read again, and flown in.

use crate::program::Program;
use simbeeotic::model::registry::{Kind, of_kind};

/// The names of all generators.
fn kinds() -> Vec<&'static str> {
    of_kind(Kind::Generator)
        .map(|part| part.label.name)
        .collect()
}

const SWARM: &str = r#"
[run]
end_time = "3 s"
[[model]]
use = "random-walk-bee"
count = 5
start = { box = ["1 m", "1 m", "0.5 m"], from = ["-0.5 m", "-0.5 m", "30 m"] }
"#;

#[test]
fn bees_fly_in_every_world_from_a_file_and_from_a_rule_alike() {
    let program = Program::new();
    for kind in kinds() {
        let file = format!("{kind}.toml");
        let call = program.call(&["world", kind, "--seed", "5", "-o", &file]);
        assert_eq!(call.code, Some(0), "{kind}: {}", call.err);
        let text = std::fs::read_to_string(program.path(&file)).expect("it was written");
        let command =
            format!("# simbeeotic world {kind} --seed 5 -o {file}\n# seed 5, Simbeeotic ");
        assert!(text.starts_with(&command), "{text:.200}");

        program.write("from-file.toml", &format!("world = \"{file}\"\n{SWARM}"));
        let rule = format!("{SWARM}[world]\ngenerate = {{ use = \"{kind}\", seed = 5 }}\n");
        program.write("from-rule.toml", &rule);
        let call = program.call(&["check", "from-file.toml"]);
        assert_eq!((call.code, call.err.as_str()), (Some(0), ""), "{kind}");
        let trace = program.trace(&["from-file.toml"]);
        assert_eq!(trace, program.trace(&["from-rule.toml"]), "{kind}");
    }
}

#[test]
fn a_scenario_varies_its_world_by_one_value() {
    let program = Program::new();
    let swarm = SWARM.replace("30 m", "0.2 m");
    program.write(
        "x.toml",
        &format!("{swarm}[world]\ngenerate = {{ use = \"maze\", roof = true }}\n"),
    );
    let trace = |set: &str| program.trace(&["x.toml", "--end-time", "30 s", "--set", set]);
    let one = trace("world.generate.seed=1");
    assert_eq!(one, program.trace(&["x.toml", "--end-time", "30 s"]));
    assert_ne!(one, trace("world.generate.seed=2"), "bees meet other walls");
}

#[test]
fn a_file_that_is_there_is_replaced_by_force_only() {
    let program = Program::new();
    program.write("x.toml", "precious");
    let call = program.call(&["world", "maze", "-o", "x.toml"]);
    assert_eq!(call.code, Some(2), "{}", call.err);
    assert!(call.err.contains("there already") && call.err.contains("--force"));
    let text = || std::fs::read_to_string(program.path("x.toml")).expect("it is there");
    assert_eq!(text(), "precious");
    let call = program.call(&["world", "maze", "-o", "x.toml", "--force"]);
    assert_eq!(call.code, Some(0), "{}", call.err);
    assert!(text().contains("[[structure]]"));
}

#[test]
fn a_world_goes_to_standard_output_and_nothing_else_does() {
    let program = Program::new();
    let plain = program.call(&["world", "maze"]);
    let dash = program.call(&["world", "maze", "-o", "-"]);
    let body = |text: &str| text.split_once("\n\n").expect("a header").1.to_owned();
    assert_eq!(body(&plain.out), body(&dash.out));
    program.write("x.toml", &plain.out);
    program.write("run.toml", &format!("world = \"x.toml\"\n{SWARM}"));
    assert_eq!(program.call(&["check", "run.toml"]).code, Some(0));
}

#[test]
fn every_kind_shows_its_parameters_with_units_and_defaults() {
    let program = Program::new();
    let list = program.call(&["world", "list"]);
    for kind in kinds() {
        assert!(list.out.contains(kind), "{}", list.out);
        let help = program.call(&["world", kind, "--help"]);
        for words in ["seed = 1", "clearance = \"", "unit: m", "simbeeotic world"] {
            assert!(help.out.contains(words), "{kind}: {words}: {}", help.out);
        }
        let page = program.call(&["world", "describe", kind]);
        assert!(help.out.starts_with(page.out.trim_end()), "{}", page.out);
    }
    let help = program.call(&["world", "--help"]);
    assert!(help.out.contains("Usage: simbeeotic world"), "{}", help.out);
}

#[test]
fn mistakes_are_shown_where_they_were_made() {
    let program = Program::new();
    for (arguments, words) in [
        (vec!["world"], "simbeeotic world list"),
        (vec!["world", "mazes"], "did you mean `maze`?"),
        (vec!["world", "describe", "mazes"], "did you mean `maze`?"),
        (vec!["world", "describe"], "describe what?"),
        (vec!["world", "maze", "big"], "what is `big`?"),
        (
            vec!["world", "maze", "--set", "colums=3"],
            "did you mean `columns`?",
        ),
        (vec!["world", "maze", "--set", "columns"], "there is no `=`"),
        (
            vec!["world", "maze", "--set", "columns=0"],
            "--set columns=0",
        ),
        (
            vec!["world", "maze", "--set", "columns=0"],
            "must lie between 1 and 1000, and is 0",
        ),
        (vec!["world", "maze", "--set", "columns=-1"], "not negative"),
        (vec!["world", "maze", "--set", "cell=2"], "give a unit"),
        (vec!["world", "maze", "--set", "cell=2 s"], "unknown unit"),
        (vec!["world", "maze", "--seed", "x"], "--seed"),
        (vec!["world", "maze", "--set", "seed=1.5"], "whole number"),
    ] {
        let call = program.call(&arguments);
        assert_eq!(call.code, Some(2), "{arguments:?}: {}", call.out);
        assert!(call.err.contains(words), "{arguments:?}: {}", call.err);
    }
}

/// The words of a command line; `"5 m"` is one, or the end of one.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            _ => words.last_mut().expect("there is one").push(letter),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

#[test]
fn the_commands_of_the_chapter_run_and_so_does_its_scenario() {
    let chapter = include_str!("../../../../docs/book/src/generators.md");
    let program = Program::new();
    let mut written = 0;
    for line in chapter
        .lines()
        .filter(|l| l.starts_with("simbeeotic world "))
    {
        let command = line.split('#').next().unwrap_or(line);
        let words = words(command);
        let mut arguments: Vec<&str> = words[1..].iter().map(String::as_str).collect();
        if let Some(at) = words.iter().position(|w| w == "-o") {
            written += 1;
            // The first example and the chapter's picture of an office have one name.
            if program.path(&words[at + 1]).exists() {
                arguments.push("--force");
            }
        }
        let call = program.call(&arguments);
        assert_eq!(call.code, Some(0), "{line}: {}", call.err);
    }
    assert_eq!(written, 1 + kinds().len());
    let mut blocks = chapter.split("```toml").skip(1);
    let block = blocks.next().and_then(|b| b.split("```").next());
    program.write("swarm.toml", block.expect("the chapter shows a scenario"));
    let one = program.trace(&["swarm.toml"]);
    let other = program.trace(&["swarm.toml", "--set", "world.generate.seed=4"]);
    assert_ne!(one, other);
    assert!(
        chapter.contains(
            &program
                .call(&["world", "maze", "--set", "columns=0"])
                .err
                .lines()
                .next()
                .expect("an error")[..40]
        )
    );
}
