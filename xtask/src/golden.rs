//! Golden traces: each `scenarios/NAME.trace` is compared with a fresh run of `scenarios/NAME.toml`.
//!
//! The run is the release program's own (`simbeeotic run ... --quiet --json`), and of its summary the keys
//! `trace_seconds` (hexadecimal strings, the hash at the end of each virtual second), `trace_hash` and
//! `seed` are read. The comparison itself is [`crate::trace`].

use anyhow::{Context, Result, bail};
use serde_json::Value;

use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;
use crate::trace::{Trace, parse_hash};

/// Where the scenarios and their traces lie.
const FOLDER: &str = "scenarios";

/// Compares, or with `accept` rewrites, the traces of the scenarios named; of all that have one if none is
/// named. Accepting a scenario by name makes its first trace.
pub(crate) fn check(repo: &Repo, names: &[String], accept: bool) -> Result<Report> {
    let names = if names.is_empty() {
        traced(repo)?
    } else {
        names.iter().map(|name| stem(name).to_owned()).collect()
    };
    if names.is_empty() {
        return Ok(Report::fault(format!(
            "no {FOLDER}/*.trace: make the first with `cargo xtask golden --accept NAME`"
        )));
    }

    let program = Program::build(repo, Profile::Release)?;
    let mut report = Report::default();
    for name in &names {
        match one(repo, &program, name, accept) {
            Ok(Outcome::Agrees { whole_seconds }) => {
                println!("   {name}: agrees over {whole_seconds} s");
            }
            Ok(Outcome::Accepted(change)) => {
                println!("   {name}: {change}");
            }
            Ok(Outcome::Differs(difference)) => report
                .faults
                .push(format!("{FOLDER}/{name}.trace: {difference}")),
            Err(error) => report
                .faults
                .push(format!("{FOLDER}/{name}.toml: {error:#}")),
        }
    }
    report.summary = format!("{} scenarios", names.len());
    Ok(report)
}

enum Outcome {
    Agrees { whole_seconds: usize },
    Accepted(String),
    Differs(String),
}

fn one(repo: &Repo, program: &Program<'_>, name: &str, accept: bool) -> Result<Outcome> {
    let scenario = format!("{FOLDER}/{name}.toml");
    let path = repo.path(&format!("{FOLDER}/{name}.trace"));
    if !repo.path(&scenario).is_file() {
        bail!("there is no such scenario");
    }

    let golden = match std::fs::read_to_string(&path) {
        Ok(text) => Some(text.parse::<Trace>().context("its trace cannot be read")),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => None,
        Err(error) => return Err(error).context("its trace cannot be read"),
    };
    let summary = program.stdout(&["run", &scenario, "--quiet", "--json", "--no-record"])?;
    let run = from_summary(&format!("{name}.toml"), &summary)?;

    if accept {
        let change = match golden {
            None => "first trace written".to_owned(),
            Some(Err(error)) => format!("rewritten; {error:#}"),
            Some(Ok(golden)) => golden
                .difference(&run)
                .map_or("unchanged".to_owned(), |change| {
                    format!("rewritten; it {change}")
                }),
        };
        std::fs::write(&path, run.to_string())?;
        return Ok(Outcome::Accepted(change));
    }

    let golden =
        golden.context("it has no trace; `cargo xtask golden --accept NAME` makes it")??;
    if golden.scenario() != run.scenario() {
        bail!("its trace is that of {}", golden.scenario());
    }
    Ok(match golden.difference(&run) {
        None => Outcome::Agrees {
            whole_seconds: run.whole_seconds(),
        },
        Some(difference) => Outcome::Differs(difference.to_string()),
    })
}

/// Names of the scenarios that have a trace, sorted.
fn traced(repo: &Repo) -> Result<Vec<String>> {
    let mut names = Vec::new();
    let entries = std::fs::read_dir(repo.path(FOLDER));
    let Ok(entries) = entries else {
        return Ok(names);
    };
    for entry in entries {
        let file = entry?.file_name();
        if let Some(name) = file.to_string_lossy().strip_suffix(".trace") {
            names.push(name.to_owned());
        }
    }
    names.sort();
    Ok(names)
}

/// `fig12`, however the user wrote it.
fn stem(name: &str) -> &str {
    let file = name.rsplit('/').next().unwrap_or(name);
    file.strip_suffix(".toml")
        .or_else(|| file.strip_suffix(".trace"))
        .unwrap_or(file)
}

/// The trace in the program's JSON summary.
///
/// # Errors
/// It is not JSON, or lacks one of the keys.
pub fn from_summary(scenario: &str, json: &str) -> Result<Trace> {
    let summary: Value = serde_json::from_str(json).context("the summary is not JSON")?;
    let key = |name: &str| -> Result<&Value> {
        summary
            .get(name)
            .with_context(|| format!("the summary has no `{name}`"))
    };
    let hash = |value: &Value| -> Result<u64> {
        let text = value.as_str().context("a hash is not a string")?;
        parse_hash(text).map_err(anyhow::Error::msg)
    };

    let seconds = key("trace_seconds")?
        .as_array()
        .context("`trace_seconds` is not an array")?
        .iter()
        .map(hash)
        .collect::<Result<Vec<u64>>>()?;
    let total = hash(key("trace_hash")?)?;
    let seed = key("seed")?.as_u64().context("`seed` is not a number")?;
    Ok(Trace::new(scenario, seed, seconds, total))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_summary_of_a_run_becomes_a_trace() {
        let json = r#"{"seed": 7, "trace_hash": "0x0c", "trace_seconds": ["0a", "000000000000000b"], "n": 1}"#;
        assert_eq!(
            from_summary("a.toml", json).unwrap(),
            Trace::new("a.toml", 7, vec![10, 11], 12)
        );
    }

    #[test]
    fn a_summary_without_its_keys_says_which() {
        let error = from_summary("a.toml", r#"{"seed": 7, "trace_hash": "0c"}"#).unwrap_err();
        assert_eq!(error.to_string(), "the summary has no `trace_seconds`");
        assert!(from_summary("a.toml", "no json").is_err());
    }

    /// Accepted, repeated, changed: with a program that prints the hashes of a file.
    #[cfg(unix)]
    #[test]
    fn a_changed_run_fails_with_its_first_second_until_it_is_accepted() {
        use std::os::unix::fs::PermissionsExt;

        let root = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(root.path().join(name), text).unwrap();
        let hashes = |second: &str| {
            let json = format!(
                r#"{{"seed": 3, "trace_hash": "ff", "trace_seconds": ["01", "{second}"]}}"#
            );
            write("summary.json", &json);
        };
        std::fs::create_dir(root.path().join(FOLDER)).unwrap();
        write("scenarios/two.toml", "");
        write("simbeeotic", "#!/bin/sh\ncat summary.json\n");
        let binary = root.path().join("simbeeotic");
        std::fs::set_permissions(&binary, std::fs::Permissions::from_mode(0o755)).unwrap();
        let repo = Repo::at(root.path());
        let program = Program::at(&repo, binary);

        hashes("02");
        assert!(traced(&repo).unwrap().is_empty());
        assert!(
            one(&repo, &program, "two", false).is_err(),
            "there is no trace yet"
        );
        one(&repo, &program, "two", true).unwrap();
        assert_eq!(traced(&repo).unwrap(), ["two"]);
        assert!(matches!(
            one(&repo, &program, "two", false).unwrap(),
            Outcome::Agrees { whole_seconds: 2 }
        ));

        hashes("22");
        let Outcome::Differs(difference) = one(&repo, &program, "two", false).unwrap() else {
            panic!("the run differs");
        };
        assert!(difference.contains("virtual second 2"), "{difference}");
        one(&repo, &program, "two", true).unwrap();
        assert!(matches!(
            one(&repo, &program, "two", false).unwrap(),
            Outcome::Agrees { .. }
        ));
    }

    #[test]
    fn a_scenario_may_be_named_by_its_path() {
        assert_eq!(stem("scenarios/fig12.toml"), "fig12");
        assert_eq!(stem("fig12.trace"), "fig12");
        assert_eq!(stem("fig12"), "fig12");
    }
}
