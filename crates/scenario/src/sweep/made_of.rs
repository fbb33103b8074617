//! What the runs of a sweep hang on besides the program: whether a sweep that was broken off is this one.

use super::Sweep;
use crate::print;
use simbeeotic_model::config::{Node, SourceId, Value};
use simbeeotic_model::kernel::Trace;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// The table of those who watch: what they name changes no run.
const COMPONENTS: &str = "component";
/// What the scenario itself is called here.
const SCENARIO: &str = "the scenario";
/// So many bytes of a file are read at once.
const PIECE: usize = 1 << 20;

impl Sweep {
    /// What all runs hang on besides the program, each with a hash: the scenario with what the command line
    /// sets in it, but without what varies; and the files that it names, and those that they name. A text in it
    /// that is the path of a file counts as one.
    pub fn made_of(&self) -> Vec<(String, u64)> {
        let base = &self.base;
        let text = format!("{}\n{}", print::to_toml(&base.tree), base.given.lines());
        let mut found = Found {
            folder: &base.folder,
            files: BTreeMap::new(),
        };
        if let Some(world) = &base.world {
            found.file(world.clone());
        }
        found.named(&base.tree, &base.folder);
        for node in self.axes.iter().flat_map(|axis| &axis.values) {
            found.named(node, &base.folder);
        }
        let scenario = (SCENARIO.to_owned(), hash_of(text.as_bytes()).unwrap_or(0));
        let files = found.files.into_iter();
        let files = files.map(|(path, hash)| (path.display().to_string(), hash));
        std::iter::once(scenario).chain(files).collect()
    }

    /// Seed and values of a run, counted from 0, written as in TOML: runs that say the same are the same run of
    /// one scenario.
    pub fn told(&self, run: usize) -> String {
        let seed = self.seed(run).map(|seed| format!("seed = {seed}"));
        let pairs = self.nodes(run);
        let pairs = pairs.map(|(axis, node)| format!("{} = {}", axis.name, print::value(node)));
        seed.into_iter().chain(pairs).collect::<Vec<_>>().join(", ")
    }
}

struct Found<'a> {
    /// That of the scenario.
    folder: &'a Path,
    files: BTreeMap<PathBuf, u64>,
}

impl Found<'_> {
    /// The files that the texts of a tree name.
    fn named(&mut self, node: &Node, folder: &Path) {
        match &node.value {
            Value::Table(table) => {
                let entries = table.entries.iter();
                let entries = entries.filter(|(key, _)| key.text != COMPONENTS);
                entries.for_each(|(_, node)| self.named(node, folder));
            }
            Value::Array(items) => items.iter().for_each(|node| self.named(node, folder)),
            Value::String(text) if !text.is_empty() => {
                let places = [folder, self.folder].map(|folder| folder.join(text));
                if let Some(path) = places.into_iter().find(|path| path.is_file()) {
                    self.file(path);
                }
            }
            _ => {}
        }
    }

    fn file(&mut self, path: PathBuf) {
        if self.files.contains_key(&path) {
            return;
        }
        // What cannot be read now is told by who reads it.
        let hash = File::open(&path).and_then(hash_of).unwrap_or(0);
        let is_toml = path.extension().is_some_and(|ending| ending == "toml");
        self.files.insert(path.clone(), hash);
        if is_toml
            && let Ok(text) = std::fs::read_to_string(&path)
            && let Ok(tree) = crate::toml::parse(&text, SourceId(0))
        {
            let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
            self.named(&tree, &folder);
        }
    }
}

/// A hash of all bytes: equal bytes, equal hash. It tells changes, not forgeries.
///
/// # Errors
/// Those of reading.
pub fn hash_of(mut from: impl Read) -> io::Result<u64> {
    // Four at a time: each fold waits for the one before.
    let mut lanes = [Trace::START; 4];
    let (mut piece, mut length) = (vec![0_u8; PIECE], 0_u64);
    loop {
        let mut filled = 0;
        while filled < PIECE {
            match from.read(&mut piece[filled..]) {
                Ok(0) => break,
                Ok(more) => filled += more,
                Err(e) if e.kind() == io::ErrorKind::Interrupted => {}
                Err(e) => return Err(e),
            }
        }
        length += filled as u64;
        // Zeros to a whole number of blocks; the length is folded in, too.
        let end = filled.next_multiple_of(32);
        piece[filled..end].fill(0);
        for block in piece[..end].chunks_exact(32) {
            for (lane, word) in lanes.iter_mut().zip(block.chunks_exact(8)) {
                let mut bytes = [0; 8];
                bytes.copy_from_slice(word);
                lane.fold(u64::from_le_bytes(bytes));
            }
        }
        if filled < PIECE {
            break;
        }
    }
    let mut whole = Trace::START;
    whole.fold(length);
    lanes.iter().for_each(|lane| whole.fold(lane.hash()));
    Ok(whole.hash())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Request, load_file};

    #[test]
    fn every_byte_of_a_long_file_counts_and_so_does_their_number() {
        let mut bytes: Vec<u8> = (0..3 * PIECE + 11).map(|at| (at % 251) as u8).collect();
        let hash = |bytes: &[u8]| hash_of(bytes).expect("memory");
        let whole = hash(&bytes);
        assert_eq!(whole, hash(&bytes));
        for at in [0, 31, PIECE, 2 * PIECE + 5, 3 * PIECE + 10] {
            bytes[at] ^= 1;
            assert_ne!(whole, hash(&bytes), "{at}");
            bytes[at] ^= 1;
        }
        assert_ne!(hash(b""), hash(b"\0"));
        assert_ne!(hash(&bytes[..40]), hash(&[&bytes[..40], &[0]].concat()));
    }

    const SCENARIO_FILE: &str = "world = \"w.toml\"\n[run]\nend_time = \"1 s\"\n[[model]]\nuse = \"inert-bee\"\n\
                                 count = 2\n[sweep.vary]\nmodel.inert-bee.count = [1, 2]\n";

    #[test]
    fn what_components_write_does_not_count() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        for name in ["out.mcap", "links.csv"] {
            std::fs::write(path(name), "1").expect("written");
        }
        let text = "[[component]]\npath = \"out.mcap\"\n[channel]\nlinks = \"links.csv\"\nmissing = \"no.csv\"\n";
        let tree = crate::toml::parse(text, SourceId(0)).expect("valid");
        let mut found = Found {
            folder: folder.path(),
            files: BTreeMap::new(),
        };
        found.named(&tree, folder.path());
        let files: Vec<PathBuf> = found.files.into_keys().collect();
        assert_eq!(files, [path("links.csv")]);
    }

    #[test]
    fn a_change_of_the_scenario_or_of_a_file_shows_and_one_of_what_varies_does_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let write = |name: &str, text: &str| std::fs::write(path(name), text).expect("written");
        write("x.toml", SCENARIO_FILE);
        write("w.toml", "[ground]\nfriction = 0.6\n");
        let made_of = |sets: &[&str]| {
            let request = Request {
                sets: sets.iter().map(|set| (*set).to_owned()).collect(),
                ..Request::default()
            };
            let loaded = load_file(&path("x.toml"), &request);
            let loaded = loaded.unwrap_or_else(|rejected| panic!("{:?}", rejected.faults));
            loaded.sweep().expect("it varies").made_of()
        };
        let before = made_of(&[]);
        let names: Vec<&str> = before.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, [SCENARIO, &path("w.toml").display().to_string()]);
        assert_eq!(before, made_of(&["--vary model.inert-bee.count=4,5,6"]));
        assert_ne!(before[0], made_of(&["run.end_time=2 s"])[0]);
        write("w.toml", "[ground]\nfriction = 0.7\n");
        let after = made_of(&[]);
        assert_eq!(before[0], after[0]);
        assert_ne!(before[1], after[1]);
    }
}
