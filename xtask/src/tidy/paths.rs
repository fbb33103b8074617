//! Paths that Markdown mentions, and whether they lead somewhere.
//!
//! Looked at are words inside backticks (not inside fenced blocks, which hold other people's trees and
//! outputs) and the targets of relative links. A word counts as a path of this repository when it
//!
//! - begins with one of its top folders (`crates/...`), or
//! - has a folder and the ending of a kind of file that we keep (`tests/it/main.rs`), or
//! - is a Markdown file (`STYLE.md`), or ends with `/`.
//!
//! It leads somewhere when it is a file or folder, or the tail of one's path: "`tests/it/main.rs`" speaks
//! of that file in any crate. Left alone are folders that a build or a run makes, names that begin with
//! `my-` (the reader's own), and placeholders such as `NAME` or `<name>`.

use std::collections::BTreeSet;

use crate::repo::File;

/// Every file and folder of the repository.
#[derive(Debug, Default)]
pub(super) struct Tree {
    paths: BTreeSet<String>,
    tops: BTreeSet<String>,
}

/// Endings of files that a document may point at.
const ENDINGS: &[&str] = &[
    ".rs", ".toml", ".md", ".sh", ".py", ".js", ".ts", ".xml", ".json", ".trace", ".txt", ".csv",
    ".png", ".svg", ".proto",
];

/// Made by a build or a run: never in the repository.
const MADE: &[&str] = &["target", "out"];

/// Words that stand for a name of the reader's.
const PLACEHOLDERS: &[&str] = &["NAME", "KIND", "NNNN", "X", "N"];

impl Tree {
    /// The tree that these files make.
    pub(super) fn of(files: &[File]) -> Self {
        let mut tree = Self::default();
        for file in files {
            for (end, _) in file.path.match_indices('/') {
                tree.paths.insert(file.path[..end].to_owned());
            }
            if let Some((top, _)) = file.path.split_once('/') {
                tree.tops.insert(top.to_owned());
            }
            tree.paths.insert(file.path.clone());
        }
        tree
    }

    /// True for a file or folder of exactly this path.
    fn holds(&self, path: &str) -> bool {
        path.is_empty() || self.paths.contains(path)
    }

    /// True if some path ends with this one, whole parts only.
    fn holds_tail(&self, tail: &str) -> bool {
        self.holds(tail)
            || self.paths.iter().any(|path| {
                path.strip_suffix(tail)
                    .is_some_and(|before| before.ends_with('/'))
            })
    }
}

/// The paths of a Markdown text that lead nowhere, with their lines.
pub(super) fn dangling(document: &str, text: &str, tree: &Tree) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut fenced = false;
    for (number, line) in super::numbered(text) {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
            continue;
        }
        if fenced {
            continue;
        }

        let mut prose = String::new();
        for (index, piece) in line.split('`').enumerate() {
            if index % 2 == 0 {
                prose.push_str(piece);
                continue;
            }
            for word in piece.split_whitespace() {
                if is_path(word, tree) && !tree.holds_tail(fixed_part(word)) {
                    found.push((number, word.to_owned()));
                }
            }
        }
        for target in link_targets(&prose) {
            let resolved = resolve(document, target);
            if !resolved.is_some_and(|path| tree.holds(&path)) {
                found.push((number, target.to_owned()));
            }
        }
    }
    found
}

/// True if the word is meant as a path of this repository.
fn is_path(word: &str, tree: &Tree) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "_-./*".contains(c);
    let word = word.strip_prefix("./").unwrap_or(word);
    if word.contains("..") || word.starts_with('/') || !word.chars().all(plain) {
        return false;
    }
    let first = word.split('/').next().unwrap_or(word);
    let stand_in = |part: &str| {
        let stem = part.split('.').next().unwrap_or(part);
        PLACEHOLDERS.contains(&stem.split('-').next().unwrap_or(stem))
    };
    if MADE.contains(&first) || first.starts_with("my-") || word.split('/').any(stand_in) {
        return false;
    }

    if word.contains('/') {
        tree.tops.contains(first)
            || word.ends_with('/')
            || ENDINGS.iter().any(|ending| word.ends_with(ending))
    } else {
        word.ends_with(".md") && !word.starts_with('*')
    }
}

/// The part of a path before its first `*`, without `/` at the end.
fn fixed_part(word: &str) -> &str {
    let word = word.strip_prefix("./").unwrap_or(word);
    let fixed = match word.find('*') {
        Some(star) => word[..star].rfind('/').map_or("", |slash| &word[..slash]),
        None => word,
    };
    fixed.trim_end_matches('/')
}

/// Targets of the inline links and pictures of a line that point into the repository.
fn link_targets(prose: &str) -> impl Iterator<Item = &str> {
    prose.split("](").skip(1).filter_map(|rest| {
        let target = rest.split([')', ' ', '#']).next()?;
        let elsewhere = target.is_empty() || target.contains(':');
        (!elsewhere).then_some(target)
    })
}

/// The path from the root that a link in `document` means; `None` if it leaves the repository.
fn resolve(document: &str, target: &str) -> Option<String> {
    let mut parts: Vec<&str> = match target.strip_prefix('/') {
        Some(_) => Vec::new(),
        None => document.split('/').collect(),
    };
    parts.pop();
    for part in target.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop()?;
            }
            part => parts.push(part),
        }
    }
    Some(parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tree() -> Tree {
        let files = [
            "README.md",
            "STYLE.md",
            "crates/units/src/lib.rs",
            "crates/units/tests/it/main.rs",
            "docs/adr/0001-engine.md",
            "docs/book/src/start.md",
            "scenarios/fig12.toml",
        ];
        let files: Vec<File> = files
            .iter()
            .map(|path| File {
                path: (*path).to_owned(),
                bytes: 0,
                text: None,
            })
            .collect();
        Tree::of(&files)
    }

    fn nowhere(text: &str) -> Vec<String> {
        let found = dangling("docs/book/src/start.md", text, &tree());
        found.into_iter().map(|(_, word)| word).collect()
    }

    #[test]
    fn files_folders_and_tails_lead_somewhere() {
        let text = "`crates/units/src/lib.rs` `crates/units/` `docs/adr` `tests/it/main.rs` `STYLE.md` \
                    `cargo run -- run scenarios/fig12.toml` `./crates` `scenarios/*.toml` `units/`";
        assert_eq!(nowhere(text), Vec::<String>::new());
    }

    #[test]
    fn what_is_gone_leads_nowhere() {
        let text = "`crates/attic/` `build/` `tests/gone.rs` `DESIGN.md` `simbeeotic run scenarios/no.toml` \
                    `crates/attic/*.rs` `src/li.rs`";
        assert_eq!(
            nowhere(text),
            [
                "crates/attic/",
                "build/",
                "tests/gone.rs",
                "DESIGN.md",
                "scenarios/no.toml",
                "crates/attic/*.rs",
                "src/li.rs"
            ]
        );
    }

    #[test]
    fn units_addresses_outputs_and_placeholders_are_no_paths() {
        let text = "`0.2 m/s` `1/240` `TCP/IP` `https://example.org/a.md` `target/debug/` `run.mcap` \
                    `my-swarm/src/lib.rs` `scenarios/NAME.toml` `docs/adr/NNNN-title.md` `crates/<name>/` \
                    `scenario.toml` `/` `*.md`";
        assert_eq!(nowhere(text), Vec::<String>::new());
    }

    #[test]
    fn fenced_blocks_are_left_alone() {
        assert_eq!(nowhere("```\n`crates/attic/`\n```\n"), Vec::<String>::new());
    }

    #[test]
    fn links_are_followed_from_their_document() {
        let good =
            "[a](../../adr/0001-engine.md) [b](start.md#top) [c](https://example.org) [d](#here)";
        assert_eq!(nowhere(good), Vec::<String>::new());
        let bad = "[a](../adr/0001-engine.md) ![b](picture.png) [c](../../../../outside.md)";
        assert_eq!(
            nowhere(bad),
            [
                "../adr/0001-engine.md",
                "picture.png",
                "../../../../outside.md"
            ]
        );
    }
}
