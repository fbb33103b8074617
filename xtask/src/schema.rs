//! The scenario schema that editors use is the one that the program would write now.

use anyhow::Result;

use crate::program::{Profile, Program};
use crate::repo::Repo;
use crate::report::Report;

/// Beside the scenarios, so that their `#:schema` line finds it: of the parts on the shelf.
const SHELF: &str = "scenarios/scenario.schema.json";
/// Beside the examples: of their parts, too.
const EXAMPLES: &str = "examples/scenario.schema.json";

/// Compares, or with `accept` rewrites, the schemas.
pub(crate) fn check(repo: &Repo, accept: bool) -> Result<Report> {
    let mut report = Report::default();
    let mut lines = 0;
    for (file, program) in [
        (SHELF, Program::build(repo, Profile::Dev)?),
        (EXAMPLES, Program::with_examples(repo, Profile::Dev)?),
    ] {
        let fresh = program.stdout(&["schema"])?;
        lines += fresh.lines().count();
        if accept {
            std::fs::write(repo.path(file), format!("{}\n", fresh.trim_end()))?;
        } else {
            let stored = std::fs::read_to_string(repo.path(file)).ok();
            report.faults.extend(stale(file, stored.as_deref(), &fresh));
        }
    }
    report.summary = match accept {
        true => format!("{SHELF} and {EXAMPLES} written"),
        false => format!("{lines} lines"),
    };
    Ok(report)
}

/// What is wrong with a stored schema.
fn stale(file: &str, stored: Option<&str>, fresh: &str) -> Option<String> {
    let Some(stored) = stored else {
        return Some(format!(
            "{file}: missing; `cargo xtask schema --accept` writes it"
        ));
    };
    let (line, stored, fresh) = first_difference(stored, fresh)?;
    Some(format!(
        "{file}:{line}: stale; stored `{stored}`, now `{fresh}`; `cargo xtask schema --accept` writes it anew"
    ))
}

/// The first line that differs, counted from 1, in both texts. How a line ends does not matter.
fn first_difference<'a>(stored: &'a str, fresh: &'a str) -> Option<(usize, &'a str, &'a str)> {
    let mut left = stored.trim_end().lines();
    let mut right = fresh.trim_end().lines();
    let mut line = 0;
    loop {
        line += 1;
        match (left.next(), right.next()) {
            (None, None) => return None,
            (a, b) if a != b => {
                let text = |side: Option<&'a str>| side.map_or("(end of file)", str::trim);
                return Some((line, text(a), text(b)));
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_differing_line_is_named() {
        assert_eq!(
            first_difference("{\n  a\n}\n", "{\n  b\n}\n"),
            Some((2, "a", "b"))
        );
        assert_eq!(
            first_difference("{\n", "{\n}\n"),
            Some((2, "(end of file)", "}"))
        );
    }

    #[test]
    fn line_ends_do_not_matter() {
        assert_eq!(first_difference("{\r\n}\r\n", "{\n}"), None);
    }
}
