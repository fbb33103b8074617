//! What the runs of a sweep hang on besides the program: whether a sweep that was broken off is this one.

use super::{CHECKED_MAX, Sweep};
use crate::files::percent_decoded;
use crate::print;
use crate::variables::Variables;
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
    /// that is the path of a file counts as one. Placeholders are looked at with the values of each combination,
    /// of the first [`CHECKED_MAX`] and of each later one that has a value for the first time.
    pub fn made_of(&self) -> Vec<(String, u64)> {
        let base = &self.base;
        let text = format!("{}\n{}", print::to_toml(&base.tree), base.given.lines());
        let mut found = Found {
            folder: &base.folder,
            files: BTreeMap::new(),
            open: BTreeMap::new(),
            variables: base.given.clone(),
        };
        found
            .variables
            .extend(Variables::of(&base.tree, &mut Vec::new()));
        if let Some(world) = &base.world {
            found.file(world.clone());
        }
        found.named(&base.tree, &base.folder);
        for node in self.axes.iter().flat_map(|axis| &axis.values) {
            found.named(node, &base.folder);
        }
        for run in self.resolved() {
            // What is wrong is told by who loads it.
            let mut faults = Vec::new();
            let mut tree = self.tree(run, &mut faults);
            found.variables = base.given.clone();
            found.variables.extend(Variables::of(&tree, &mut faults));
            found.variables.apply(&mut tree, &mut faults);
            found.named(&tree, &base.folder);
            found.again();
        }
        let scenario = (SCENARIO.to_owned(), hash_of(text.as_bytes()).unwrap_or(0));
        let files = found.files.into_iter();
        let files = files.map(|(path, hash)| (path.display().to_string(), hash));
        std::iter::once(scenario).chain(files).collect()
    }

    /// The combinations whose files are looked for.
    fn resolved(&self) -> impl Iterator<Item = usize> {
        let mut seen: Vec<Vec<bool>> = (self.axes.iter())
            .map(|axis| vec![false; axis.values.len()])
            .collect();
        let combinations = self.combinations.iter().enumerate();
        combinations.filter_map(move |(run, places)| {
            let mut new = run < CHECKED_MAX;
            for (seen, place) in seen.iter_mut().zip(places) {
                new |= !std::mem::replace(&mut seen[*place as usize], true);
            }
            new.then_some(run)
        })
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
    /// Files with placeholders, which may name others with each combination.
    open: BTreeMap<PathBuf, Node>,
    /// What placeholders stand for now.
    variables: Variables,
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
        let is = |ending: &str| {
            path.extension()
                .is_some_and(|own| own.eq_ignore_ascii_case(ending))
        };
        self.files.insert(path.clone(), hash);
        if is("toml")
            && let Ok(text) = std::fs::read_to_string(&path)
            && let Ok(tree) = crate::toml::parse(&text, SourceId(0))
        {
            self.within(&path, tree.clone());
            if text.contains("${") {
                self.open.insert(path, tree);
            }
        } else if is("gltf") {
            for uri in uris(&path) {
                let file = folder_of(&path).join(uri);
                if file.is_file() {
                    self.file(file);
                }
            }
        }
    }

    /// The files that another names, with what placeholders stand for now.
    fn within(&mut self, path: &Path, mut tree: Node) {
        self.variables.apply(&mut tree, &mut Vec::new());
        self.named(&tree, &folder_of(path));
    }

    /// Looks again into the files with placeholders.
    fn again(&mut self) {
        let open: Vec<_> = (self.open.iter())
            .map(|(path, tree)| (path.clone(), tree.clone()))
            .collect();
        for (path, tree) in open {
            self.within(&path, tree);
        }
    }
}

fn folder_of(path: &Path) -> PathBuf {
    path.parent().map(Path::to_path_buf).unwrap_or_default()
}

/// The files that the buffers and images of a glTF name.
fn uris(path: &Path) -> Vec<String> {
    let bytes = std::fs::read(path).unwrap_or_default();
    let Ok(root) = serde_json::from_slice::<serde_json::Value>(&bytes) else {
        return Vec::new();
    };
    let lists = ["buffers", "images"].map(|list| root.get(list).and_then(|list| list.as_array()));
    let all = lists.into_iter().flatten().flatten();
    let uris = all.filter_map(|one| one.get("uri")?.as_str().map(str::to_owned));
    uris.filter_map(|uri| percent_decoded(&uri).ok()).collect()
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
            open: BTreeMap::new(),
            variables: Variables::default(),
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

    #[test]
    fn files_that_placeholders_name_count_for_each_combination() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let write = |name: &str, text: &str| std::fs::write(path(name), text).expect("written");
        let scenario = SCENARIO_FILE.replace("w.toml", "w-${kind}-${size}.toml");
        write(
            "x.toml",
            &format!("{scenario}[variables]\nkind = \"a\"\nsize = 1\n"),
        );
        let files = ["w-a-1.toml", "w-a-2.toml", "w-b-1.toml", "w-b-2.toml"];
        for file in files {
            write(file, "[ground]\nfriction = 0.6\n");
        }
        let made_of = || {
            let sets = ["--vary variables.kind=a,b", "--vary variables.size=1,2"];
            let request = Request {
                sets: sets.map(str::to_owned).to_vec(),
                ..Request::default()
            };
            let loaded = load_file(&path("x.toml"), &request);
            let loaded = loaded.unwrap_or_else(|rejected| panic!("{:?}", rejected.faults));
            loaded.sweep().expect("it varies").made_of()
        };
        let names = |all: Vec<(String, u64)>| -> Vec<String> {
            all.into_iter().skip(1).map(|(name, _)| name).collect()
        };
        let all = files.map(|file| path(file).display().to_string());
        assert_eq!(names(made_of()), all);
        let before = made_of();
        write("w-b-2.toml", "[ground]\nfriction = 0.7\n");
        assert_ne!(before[4], made_of()[4]);
        assert_eq!(before[..4], made_of()[..4]);
    }

    #[test]
    fn files_that_a_gltf_or_a_placeholder_in_a_world_names_count() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        let write = |name: &str, text: &str| std::fs::write(path(name), text).expect("written");
        let tree = |text: &str| crate::toml::parse(text, SourceId(0)).expect("valid");
        write("w.toml", "mesh = \"${kind}.gltf\"\n");
        let gltf =
            "{\"buffers\": [{\"uri\": \"c%20d.bin\"}, {\"uri\": \"no.bin\"}, {}], \"images\": 3}";
        write("a.gltf", gltf);
        write("b.gltf", "{");
        write("c d.bin", "points");
        let mut found = Found {
            folder: folder.path(),
            files: BTreeMap::new(),
            open: BTreeMap::new(),
            variables: Variables::default(),
        };
        for kind in ["a", "b"] {
            let all = tree(&format!("[variables]\nkind = \"{kind}\"\n"));
            found.variables = Variables::of(&all, &mut Vec::new());
            found.named(&tree("world = \"w.toml\"\n"), folder.path());
            found.again();
        }
        let files: Vec<PathBuf> = found.files.into_keys().collect();
        let all = ["a.gltf", "b.gltf", "c d.bin", "w.toml"];
        assert_eq!(files, all.map(path));
    }
}
