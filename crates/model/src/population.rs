//! Who is there: queries by id, path and kind.

use simbeeotic_kernel::{ModelId, rng::path_key};
use std::collections::BTreeMap;

/// One model of the population.
#[derive(Clone, Copy, Debug)]
pub struct Member<'a> {
    /// Its path: `bee-17`, or `hive/bee-17` for a nested model.
    pub path: &'a str,
    /// The part it was made from: `instrument-bee`.
    pub kind: &'static str,
    /// The model it is nested in.
    pub parent: Option<ModelId>,
}

/// All models of a run. Fixed once the run starts; ids count from 0 in the scenario's order.
#[derive(Clone, Debug, Default)]
pub struct Population {
    entries: Vec<Entry>,
    /// The paths of all, one after the other: a string each would take 40 bytes more.
    paths: String,
    /// By the key of the path: a string twice for each of 100,000 models is 6 MB.
    by_key: BTreeMap<u64, ModelId>,
    by_kind: BTreeMap<&'static str, Vec<ModelId>>,
}

#[derive(Clone, Debug)]
struct Entry {
    kind: &'static str,
    parent: Option<ModelId>,
    /// Where its path ends.
    end: u32,
}

impl Population {
    /// No models, and room for `count`.
    pub(crate) fn with_capacity(count: usize) -> Self {
        Self {
            entries: Vec::with_capacity(count),
            ..Self::default()
        }
    }

    /// Adds a model; `None` if the path is taken.
    pub(crate) fn add(&mut self, member: Member<'_>) -> Option<ModelId> {
        let Member { path, kind, parent } = member;
        let id = ModelId(u32::try_from(self.entries.len()).ok()?);
        let end = u32::try_from(self.paths.len() + path.len()).ok()?;
        if self.find(path).is_some() {
            return None;
        }
        // Two paths of one key are refused when all are known.
        self.by_key.entry(path_key(path)).or_insert(id);
        self.by_kind.entry(kind).or_default().push(id);
        self.paths.push_str(path);
        self.entries.push(Entry { kind, parent, end });
        Some(id)
    }

    /// How many there are.
    pub const fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is none.
    pub const fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The model with this id.
    pub fn get(&self, id: ModelId) -> Option<Member<'_>> {
        let entry = self.entries.get(id.index())?;
        let before = id.index().checked_sub(1);
        let start = before.map_or(0, |before| self.entries[before].end);
        Some(Member {
            path: &self.paths[start as usize..entry.end as usize],
            kind: entry.kind,
            parent: entry.parent,
        })
    }

    /// The path of a model; empty for an id that is not one.
    pub fn path(&self, id: ModelId) -> &str {
        self.get(id).map_or("", |m| m.path)
    }

    /// The model at `path`.
    pub fn find(&self, path: &str) -> Option<ModelId> {
        let id = *self.by_key.get(&path_key(path))?;
        (self.path(id) == path).then_some(id)
    }

    /// All models made from the part called `kind`, by id. Empty if there is none.
    pub fn of_kind(&self, kind: &str) -> &[ModelId] {
        self.by_kind.get(kind).map_or(&[], Vec::as_slice)
    }

    /// The models nested in `parent`, by id.
    pub fn children(&self, parent: ModelId) -> impl Iterator<Item = ModelId> {
        self.iter()
            .filter(move |(_, m)| m.parent == Some(parent))
            .map(|(id, _)| id)
    }

    /// All models, by id.
    pub fn iter(&self) -> impl Iterator<Item = (ModelId, Member<'_>)> {
        let ids = (0..self.entries.len() as u32).map(ModelId);
        ids.filter_map(|id| Some((id, self.get(id)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn models_are_found_by_id_path_and_kind() {
        let mut all = Population::default();
        fn member<'a>(path: &'a str, kind: &'static str, parent: Option<ModelId>) -> Member<'a> {
            Member { path, kind, parent }
        }
        let hive = all
            .add(member("hive", "simple-hive", None))
            .expect("free path");
        let bee = all
            .add(member("hive/bee", "inert-bee", Some(hive)))
            .expect("free path");
        assert_eq!(all.find("hive/bee"), Some(bee));
        assert_eq!(
            all.find("unknown"),
            None,
            "the original threw a null pointer exception"
        );
        assert_eq!(all.of_kind("inert-bee"), [bee]);
        assert!(all.of_kind("unknown").is_empty());
        assert_eq!(all.children(hive).collect::<Vec<_>>(), [bee]);
        assert_eq!(all.path(bee), "hive/bee");
        assert!(
            all.add(member("hive", "inert-bee", None)).is_none(),
            "a path is taken once"
        );
    }
}
