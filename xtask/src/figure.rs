//! The paper's Figures 9 and 10: the commands that make them anew, each from a list beside its example.
//!
//! A list holds arguments of the program, as a user would type them; `{out}` in them stands for the folder
//! that recordings and tables go to, `{docs}` for that of the book's pictures, and `*.mcap` at its end for the
//! recordings of a folder.

use std::path::PathBuf;

use anyhow::{Context, Result, bail, ensure};
use toml::{Table, Value};

use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;

/// The figures, and where their lists lie.
const FIGURES: &[(&str, &str)] = &[
    ("9", "examples/hive/figure.toml"),
    ("10", "examples/gradient/figure.toml"),
];
/// The folder of the book's pictures of figures.
const DOCS: &str = "docs/images/figures";

/// Makes the figure that is named, or both.
pub(crate) fn draw(repo: &Repo, names: &[String]) -> Result<Report> {
    let wanted: Vec<_> = FIGURES
        .iter()
        .filter(|(number, _)| names.is_empty() || names.iter().any(|name| name == number))
        .collect();
    if let Some(name) = names
        .iter()
        .find(|name| !FIGURES.iter().any(|(number, _)| number == name))
    {
        bail!("there is no figure `{name}` here: 9 and 10 are (6, 7, 8: `simbeeotic bench fig6`)");
    }
    let program = Program::with_examples(repo, Profile::Release)?;
    let mut run = 0;
    for (number, list) in wanted {
        let text = std::fs::read_to_string(repo.path(list)).with_context(|| (*list).to_owned())?;
        let out = format!("out/figure{number}");
        fresh(repo.path(&out))?;
        std::fs::create_dir_all(repo.path(DOCS))?;
        for arguments in commands(&text, &out).with_context(|| (*list).to_owned())? {
            println!("   simbeeotic {}", arguments.join(" "));
            let arguments = spread(repo, arguments)?;
            let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
            program.stdout(&arguments)?;
            run += 1;
        }
    }
    Ok(Report::of(format!("{run} commands; pictures in {DOCS}")))
}

/// As a shell does: `FOLDER/*.mcap` stands for the recordings in it, in their order.
fn spread(repo: &Repo, arguments: Vec<String>) -> Result<Vec<String>> {
    let mut all = Vec::new();
    for argument in arguments {
        let Some(folder) = argument.strip_suffix("/*.mcap") else {
            all.push(argument);
            continue;
        };
        let mut files = Vec::new();
        for entry in std::fs::read_dir(repo.path(folder)).with_context(|| argument.clone())? {
            let name = entry?.file_name().to_string_lossy().into_owned();
            if name.ends_with(".mcap") {
                files.push(format!("{folder}/{name}"));
            }
        }
        files.sort();
        all.extend(files);
    }
    Ok(all)
}

/// An empty folder: what an earlier run left would be taken for this one's.
fn fresh(folder: PathBuf) -> Result<()> {
    if folder.exists() {
        std::fs::remove_dir_all(&folder).with_context(|| folder.display().to_string())?;
    }
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())
}

/// The commands of a list, in their order.
fn commands(text: &str, out: &str) -> Result<Vec<Vec<String>>> {
    let list: Table = text.parse()?;
    let commands = list.get("commands").and_then(Value::as_array);
    let commands = commands.context("no `commands`: a list of lists of words is wanted")?;
    ensure!(!commands.is_empty(), "`commands` is empty");
    let word = |word: &Value| {
        let word = word.as_str()?;
        Some(word.replace("{out}", out).replace("{docs}", DOCS))
    };
    let command = |command: &Value| {
        let words = command.as_array()?;
        (!words.is_empty()).then_some(())?;
        words.iter().map(word).collect::<Option<Vec<_>>>()
    };
    commands
        .iter()
        .map(command)
        .collect::<Option<_>>()
        .context("`commands` is a list of lists of words")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_put_in_their_places() {
        let text = r#"commands = [["run", "a.toml", "--record", "{out}/a.mcap"], ["plot", "{docs}/a.svg"]]"#;
        let commands = commands(text, "out/figure9").expect("a list");
        assert_eq!(commands[0][3], "out/figure9/a.mcap");
        assert_eq!(commands[1], ["plot", "docs/images/figures/a.svg"]);
    }

    #[test]
    fn recordings_of_a_folder_come_in_their_order() {
        let root = tempfile::tempdir().expect("a folder");
        std::fs::create_dir(root.path().join("runs")).expect("a folder in it");
        for name in ["b.mcap", "a.mcap", "c.csv"] {
            let file = root.path().join("runs").join(name);
            std::fs::write(file, "").expect("it can be written");
        }
        let words = ["plot", "runs/*.mcap", "-o"].map(str::to_owned).to_vec();
        let spread = spread(&Repo::at(root.path()), words).expect("they are listed");
        assert_eq!(spread, ["plot", "runs/a.mcap", "runs/b.mcap", "-o"]);
    }

    #[test]
    fn a_list_of_nothing_or_of_something_else_is_refused() {
        for text in [
            "",
            "commands = []",
            "commands = [[]]",
            "commands = [\"run\"]",
            "commands = [[1]]",
        ] {
            assert!(commands(text, "out").is_err(), "{text}");
        }
    }
}
