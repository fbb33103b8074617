//! An example is a folder with everything in it, and the page of examples names it.

use std::collections::{BTreeMap, BTreeSet};

use crate::repo::File;

/// Where they lie.
const FOLDER: &str = "examples/";
/// Their page.
const PAGE: &str = "examples/README.md";
/// What each has.
const PARTS: &[&str] = &["README.md", "scenario.toml", "mod.rs", "test.rs"];
/// A page longer than this is no page.
const LINES_MAX: usize = 90;

/// What is missing, a line each.
pub(super) fn faults(files: &[File]) -> Vec<String> {
    let mut faults = Vec::new();
    let page = text(files, PAGE).unwrap_or_default();
    for (folder, parts) in folders(files) {
        for part in PARTS.iter().filter(|part| !parts.contains(*part)) {
            faults.push(format!("{FOLDER}{folder}: no {part}"));
        }
        if !page.contains(&format!("]({folder}/README.md)")) {
            faults.push(format!("{PAGE}: does not name {folder}/README.md"));
        }
        let readme = format!("{FOLDER}{folder}/README.md");
        let Some(text) = text(files, &readme) else {
            continue;
        };
        if !text.contains("![") {
            faults.push(format!("{readme}: no picture"));
        }
        let lines = text.lines().count();
        if lines > LINES_MAX {
            faults.push(format!("{readme}: {lines} lines; one page has {LINES_MAX}"));
        }
    }
    faults
}

/// The folders and the names of the files right in them.
fn folders(files: &[File]) -> BTreeMap<&str, BTreeSet<&str>> {
    let mut folders = BTreeMap::<_, BTreeSet<_>>::new();
    for file in files {
        let inside = file.path.strip_prefix(FOLDER);
        if let Some((folder, part)) = inside.and_then(|path| path.split_once('/')) {
            folders.entry(folder).or_default().insert(part);
        }
    }
    folders
}

fn text<'a>(files: &'a [File], path: &str) -> Option<&'a str> {
    let file = files.iter().find(|file| file.path == path);
    file.and_then(|file| file.text.as_deref())
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

    #[test]
    fn a_whole_folder_is_without_fault_and_each_missing_part_is_one() {
        let whole = [
            file("examples/README.md", "[hive](hive/README.md)"),
            file("examples/lib.rs", ""),
            file("examples/hive/README.md", "![a](picture.png)"),
            file("examples/hive/scenario.toml", ""),
            file("examples/hive/mod.rs", ""),
            file("examples/hive/test.rs", ""),
        ];
        assert_eq!(faults(&whole), [""; 0]);
        for missing in [0, 2, 3, 4, 5] {
            let mut files = whole.to_vec();
            files.remove(missing);
            assert_eq!(faults(&files).len(), 1, "without {}", whole[missing].path);
        }
        let mut files = whole.to_vec();
        files[2] = file("examples/hive/README.md", &"long\n".repeat(100));
        assert_eq!(faults(&files).len(), 2);
    }
}
