//! Habits that a machine can hold, over every file that git knows or would add.
//!
//! Faults: a to-do mark without a name; `ignore` on a test; a Rust file that does not open with `//!`;
//! a path in Markdown that leads nowhere; an absolute path of somebody's machine; trailing white space;
//! a file over 1 MiB; an example that is not whole. Noted only: Rust files over 600 lines, which may hold more than one idea.
//!
//! Files whose first line says `@generated` are held to none of the rules of style.

mod examples;
mod paths;

use anyhow::Result;

use crate::repo::{BYTES_MAX, File, Repo};
use crate::report::Report;

/// A Rust file beyond this is listed: does it still hold one idea?
const LINES_MAX: usize = 600;

/// Texts that people write, held to the rules of style.
const PROSE_AND_CODE: &[&str] = &[
    ".rs", ".toml", ".md", ".sh", ".py", ".js", ".ts", ".css", ".html", ".yml", ".trace", ".ci/run",
];

/// Of these, the ones in which a to-do mark is one (prose may speak about it).
const CODE: &[&str] = &[".rs", ".toml", ".sh", ".py", ".js", ".ts", ".ci/run"];

/// Checks the tree.
pub(crate) fn check(repo: &Repo) -> Result<Report> {
    Ok(judge(&repo.files()?))
}

/// Looks at the files given. Pure: the tests hand it files of their own.
fn judge(files: &[File]) -> Report {
    let mut report = Report::of(format!("{} files", files.len()));
    let tree = paths::Tree::of(files);

    for file in files {
        let path = &file.path;
        if file.bytes > BYTES_MAX {
            report.faults.push(format!(
                "{path}: {} KiB; a repository is no place for blobs over {} KiB",
                file.bytes >> 10,
                BYTES_MAX >> 10
            ));
        }
        let Some(text) = &file.text else { continue };

        for (number, line) in numbered(text) {
            if let Some(found) = machine_path(line) {
                report.faults.push(format!(
                    "{path}:{number}: `{found}` is a path of one machine"
                ));
            }
        }
        if text
            .lines()
            .next()
            .is_some_and(|line| line.contains("@generated"))
        {
            continue;
        }
        style(file, text, &mut report);
        if path.ends_with(".md") && !path.ends_with("CHANGELOG.md") {
            for (number, what) in paths::dangling(path, text, &tree) {
                report
                    .faults
                    .push(format!("{path}:{number}: `{what}` leads nowhere"));
            }
        }
    }
    report.faults.extend(examples::faults(files));
    report
}

fn style(file: &File, text: &str, report: &mut Report) {
    let path = &file.path;
    let is = |endings: &[&str]| endings.iter().any(|ending| path.ends_with(ending));
    let rust = path.ends_with(".rs");

    if is(PROSE_AND_CODE) {
        for (number, line) in numbered(text) {
            if line.ends_with([' ', '\t']) {
                report
                    .faults
                    .push(format!("{path}:{number}: trailing white space"));
            }
        }
    }
    if is(CODE) {
        for (number, line) in numbered(text) {
            if nameless_todo(line) {
                report.faults.push(format!(
                    "{path}:{number}: a {TO_DO} belongs to somebody: write {TO_DO}(name)"
                ));
            }
        }
    }
    if rust {
        for (number, line) in numbered(text) {
            if ignores_a_test(line) {
                report.faults.push(format!(
                    "{path}:{number}: a test that is ignored is a test that fails: mend it or remove it"
                ));
            }
        }
        if !opens_with_an_essay(text) {
            report.faults.push(format!(
                "{path}:1: open with `//!`: what is in this file, and why"
            ));
        }
        let lines = text.lines().count();
        if lines > LINES_MAX {
            report
                .notes
                .push(format!("{path}: {lines} lines; is it still one idea?"));
        }
    }
}

/// Lines with their numbers, counted from 1. (A carriage return is not white space at the end of a line:
/// git may put it there.)
fn numbered(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines()
        .enumerate()
        .map(|(index, line)| (index + 1, line))
}

// In two halves, so that this file does not break its own rules.
const TO_DO: &str = concat!("TO", "DO");
const FIX_ME: &str = concat!("FIX", "ME");

/// True if the line has a to-do mark that names nobody.
fn nameless_todo(line: &str) -> bool {
    [TO_DO, FIX_ME].iter().any(|mark| {
        line.match_indices(mark).any(|(start, _)| {
            let word = |c: char| c.is_alphanumeric() || c == '_';
            let before = line[..start].chars().next_back();
            let after = &line[start + mark.len()..];
            if before.is_some_and(word) || after.chars().next().is_some_and(word) {
                return false; // part of a longer word
            }
            let named = after
                .strip_prefix('(')
                .and_then(|rest| rest.split_once(')'))
                .is_some_and(|(name, _)| !name.trim().is_empty());
            !named
        })
    })
}

fn ignores_a_test(line: &str) -> bool {
    let line = line.trim_start();
    line.starts_with("#[ignore") || (line.starts_with("#[cfg_attr(") && (line.contains(", ignore")))
}

/// True if documentation comes before any code. Inner attributes and plain comments may stand before it.
fn opens_with_an_essay(text: &str) -> bool {
    let first = text.lines().map(str::trim).find(|line| {
        let comment = line.starts_with("//") && !line.starts_with("//!");
        !(line.is_empty() || comment || line.starts_with("#!"))
    });
    first.is_none_or(|line| line.starts_with("//!"))
}

/// Beginnings of paths that exist on one machine only.
const MACHINE_PATHS: &[&str] = &[
    concat!("/ho", "me/"),
    concat!("/Us", "ers/"),
    concat!("/ro", "ot/"),
    concat!("/wo", "rk/"),
    concat!("/mn", "t/"),
    concat!("C:\\", "Users\\"),
];

/// The first absolute path of a developer's machine in this line.
fn machine_path(line: &str) -> Option<&str> {
    MACHINE_PATHS.iter().find_map(|beginning| {
        line.match_indices(beginning).find_map(|(start, _)| {
            let joined = |c: char| c.is_alphanumeric() || "_.-~)}".contains(c);
            if line[..start].chars().next_back().is_some_and(joined) {
                return None; // the middle of a relative path or of an address
            }
            let rest = &line[start..];
            let more = &rest[beginning.len()..];
            if !more.starts_with(|c: char| c.is_alphanumeric() || c == '.' || c == '_') {
                return None;
            }
            let end = rest
                .find(|c: char| c.is_whitespace() || "\"'`<>(),;".contains(c))
                .unwrap_or(rest.len());
            Some(&rest[..end])
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(path: &str, text: &str) -> File {
        File {
            path: path.to_owned(),
            bytes: text.len() as u64,
            text: Some(text.to_owned()),
        }
    }

    fn faults(path: &str, text: &str) -> Vec<String> {
        judge(&[file(path, text)]).faults
    }

    #[test]
    fn a_todo_needs_a_name() {
        for line in [
            "// MARK",
            "// MARK: later",
            "// MARK()",
            "let a = 1; // MARK (ann) x",
        ] {
            assert!(nameless_todo(&line.replace("MARK", TO_DO)), "{line}");
        }
        for line in [
            "// MARK(ann): later",
            "// MARKS",
            "METHODO_MARK",
            "// nothing",
        ] {
            assert!(!nameless_todo(&line.replace("MARK", TO_DO)), "{line}");
        }
        let text = format!("//! A file.\n// {TO_DO}: x\n");
        let faults = faults("crates/a/src/lib.rs", &text);
        assert_eq!(faults.len(), 1);
        assert!(
            faults[0].starts_with("crates/a/src/lib.rs:2: "),
            "{}",
            faults[0]
        );
    }

    #[test]
    fn an_ignored_test_fails() {
        let text = format!("//! Tests.\n#[test]\n#[{}]\nfn slow() {{}}\n", "ignore");
        assert!(faults("crates/a/src/lib.rs", &text)[0].contains(":3: "));
        let text = format!("//! T.\n    #[cfg_attr(miri, {})]\n", "ignore");
        assert_eq!(faults("crates/a/src/lib.rs", &text).len(), 1);
    }

    #[test]
    fn a_rust_file_opens_with_an_essay() {
        assert!(opens_with_an_essay("//! What it is.\nuse std::fmt;\n"));
        assert!(opens_with_an_essay("#![no_std]\n\n//! What it is.\n"));
        assert!(opens_with_an_essay(""));
        assert!(!opens_with_an_essay("use std::fmt;\n//! Too late.\n"));
        assert!(!opens_with_an_essay(
            "/// Of the item, not the file.\nfn f() {}\n"
        ));
        assert_eq!(faults("crates/a/build.rs", "fn main() {}\n").len(), 1);
    }

    #[test]
    fn generated_code_is_spared_the_style_but_not_the_paths() {
        let text = "// @generated by prost\nfn f() {} \n";
        assert_eq!(faults("crates/a/src/pb.rs", text), Vec::<String>::new());
        let text = format!("// @generated\n// from {}ann/x.proto\n", MACHINE_PATHS[0]);
        assert_eq!(faults("crates/a/src/pb.rs", &text).len(), 1);
    }

    #[test]
    fn trailing_white_space_fails_with_its_line() {
        let faults = faults("scenarios/a.toml", "a = 1\nb = 2 \n");
        assert_eq!(faults, ["scenarios/a.toml:2: trailing white space"]);
    }

    #[test]
    fn paths_of_one_machine_are_found_and_others_are_not() {
        for beginning in MACHINE_PATHS {
            let line = format!("see \"{beginning}ann/notes.txt\" for more");
            assert_eq!(
                machine_path(&line),
                Some(format!("{beginning}ann/notes.txt").as_str())
            );
        }
        let home = MACHINE_PATHS[0];
        for line in [
            format!("https://example.org{home}page"),
            format!("docs{home}page.md"),
            format!("{home} alone"),
            "/usr/share/doc, /tmp/x and /dev/null".to_owned(),
        ] {
            assert_eq!(machine_path(&line), None, "{line}");
        }
    }

    #[test]
    fn a_blob_fails_and_a_long_file_is_listed() {
        let blob = File {
            path: "docs/film.mp4".to_owned(),
            bytes: BYTES_MAX + 1,
            text: None,
        };
        let long = file("crates/a/src/lib.rs", &"//! Line.\n".repeat(LINES_MAX + 1));
        let report = judge(&[blob, long]);
        assert_eq!(report.faults.len(), 1);
        assert!(report.faults[0].starts_with("docs/film.mp4: 1024 KiB"));
        assert_eq!(report.notes.len(), 1);
        assert!(report.notes[0].starts_with("crates/a/src/lib.rs: 601 lines"));
    }

    #[test]
    fn a_path_in_the_docs_that_leads_nowhere_fails() {
        let files = [
            file(
                "README.md",
                "Read `docs/book/start.md`,\nthen `crates/a/gone.rs`.\n",
            ),
            file("docs/book/start.md", "Start.\n"),
            file("crates/a/src/lib.rs", "//! A.\n"),
        ];
        assert_eq!(
            judge(&files).faults,
            ["README.md:2: `crates/a/gone.rs` leads nowhere"]
        );
    }

    #[test]
    fn the_changelog_may_speak_of_what_is_gone() {
        let files = [
            file("CHANGELOG.md", "Removed `crates/attic/src/lib.rs`.\n"),
            file("crates/a/src/lib.rs", "//! A.\n"),
        ];
        assert_eq!(judge(&files).faults, Vec::<String>::new());
    }
}
