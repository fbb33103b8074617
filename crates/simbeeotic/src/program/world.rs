//! `world`: worlds made by rule, written as world files.

use super::arguments::WorldOptions;
use super::{Failure, colour, help, remark, say, shelf};
use crate::library;
use simbeeotic_model::config::{Node, Sources, Value};
use simbeeotic_model::registry::Kind;
use simbeeotic_scenario::generate::Order;
use std::fs::{File, OpenOptions};
use std::io::{ErrorKind, Write};
use std::path::Path;

/// Writes a world, or tells what worlds there are.
pub(super) fn world(options: &WorldOptions) -> Result<(), Failure> {
    match (options.kind.as_deref(), options.name.as_deref()) {
        (None, _) if options.help => help(),
        (Some("list"), None) => shelf::list(Some(Kind::Generator.name()), false),
        (None, _) => {
            let message = "which world? `simbeeotic world list` shows the kinds";
            Err(Failure::input(message))
        }
        (Some("describe"), Some(kind)) => shelf::describe_kind(Kind::Generator, kind),
        (Some("describe"), None) => Err(Failure::input(
            "describe what? `simbeeotic world list` shows the kinds",
        )),
        (Some(_), Some(word)) => Err(Failure::input(format!(
            "one kind of world at a time: what is `{word}`?"
        ))),
        (Some(kind), None) if options.help => {
            shelf::describe_kind(Kind::Generator, kind)?;
            say(format!(
                "Write one: simbeeotic world {kind} --seed 1 --set PARAMETER=VALUE -o {kind}.toml"
            ))
        }
        (Some(kind), None) => generate(kind, options),
    }
}

/// The help of this command alone.
fn help() -> Result<(), Failure> {
    let mut all = help::command();
    all.build();
    let page = all
        .find_subcommand_mut("world")
        .map(|command| command.render_long_help().to_string());
    say(page.unwrap_or_default().trim_end())
}

fn generate(kind: &str, options: &WorldOptions) -> Result<(), Failure> {
    let mut sets = options.sets.clone();
    if let Some(seed) = options.seed {
        sets.push(format!("seed={seed}"));
    }
    let mut sources = Sources::new();
    let order = Order::new(kind, &sets, &mut sources);
    let made = order.and_then(|order| Ok((order.toml()?, order)));
    let (body, order) =
        made.map_err(|faults| Failure::input(library::faults_text(&faults, &sources, colour())))?;
    let text = format!("{}\n{body}", header(kind, options, &order));
    match options.output.as_deref() {
        None => say(text.trim_end()),
        Some(path) if path == Path::new("-") => say(text.trim_end()),
        Some(path) => {
            write(path, &text, options.force)?;
            remark(format!("wrote {}", path.display()));
            Ok(())
        }
    }
}

/// Where the file came from: the command, the seed, the version.
fn header(kind: &str, options: &WorldOptions, order: &Order) -> String {
    let mut words = vec!["simbeeotic".to_owned(), "world".to_owned(), kind.to_owned()];
    if let Some(seed) = options.seed {
        words.extend(["--seed".to_owned(), seed.to_string()]);
    }
    for set in &options.sets {
        words.extend(["--set".to_owned(), quoted(set)]);
    }
    if let Some(path) = &options.output {
        words.extend(["-o".to_owned(), quoted(&path.display().to_string())]);
    }
    let defaults = (order.part.defaults)();
    let seed = [&order.params, &defaults]
        .into_iter()
        .find_map(|node| node.as_table()?.get("seed"))
        .map(|node: &Node| match &node.value {
            Value::Integer(seed) => format!("seed {seed}, "),
            _ => String::new(),
        })
        .unwrap_or_default();
    format!(
        "# {}\n# {seed}Simbeeotic {}\n",
        words.join(" "),
        env!("CARGO_PKG_VERSION")
    )
}

/// A word as a shell wants it, on one line.
fn quoted(word: &str) -> String {
    let word: String = word
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_=./,:+".contains(c);
    match word.chars().all(plain) {
        true => word,
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

fn write(path: &Path, text: &str, force: bool) -> Result<(), Failure> {
    let file = match force {
        true => File::create(path),
        false => OpenOptions::new().write(true).create_new(true).open(path),
    };
    let written = file.and_then(|mut file| file.write_all(text.as_bytes()));
    written.map_err(|error| match error.kind() {
        ErrorKind::AlreadyExists => Failure::input(format!(
            "{} is there already; choose another name, or --force to replace it",
            path.display()
        )),
        _ => Failure::run(format!("cannot write {}: {error}", path.display())),
    })
}

#[cfg(test)]
mod tests {
    use super::quoted;

    #[test]
    fn words_of_a_command_are_quoted_where_a_shell_would_split_them() {
        for (word, shown) in [
            ("columns=4", "columns=4"),
            ("cell=2 m", "'cell=2 m'"),
            ("it's", r"'it'\''s'"),
            ("a\nb", "'a b'"),
        ] {
            assert_eq!(quoted(word), shown);
        }
    }
}
