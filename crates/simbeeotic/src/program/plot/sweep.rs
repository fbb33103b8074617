//! Runs of one experiment: which of them belong together.

use super::super::{Failure, remark};
use super::map::MAPS_MAX;
use super::source::{Source, Sources};
use simbeeotic_model::config::{Node, SourceId, Sources as Texts, Value};

/// Runs that were made alike.
pub(super) struct Group<'a> {
    /// What sets them apart from others; empty if nothing does.
    pub(super) name: String,
    pub(super) runs: Vec<&'a Source>,
    /// Their places among all.
    pub(super) places: Vec<usize>,
}

/// The runs by what sets them apart: `seed`, `file`, or a value of the scenario; smaller numbers first.
pub(super) fn groups<'a>(
    sources: &'a Sources,
    by: Option<&str>,
) -> Result<Vec<Group<'a>>, Failure> {
    let mut groups: Vec<Group<'a>> = Vec::new();
    for (at, source) in sources.all().iter().enumerate() {
        let name = match by {
            None => String::new(),
            Some("seed") => match source.recording.seed() {
                Some(seed) => format!("seed {}", seed.cast_signed()),
                None => "no seed".to_owned(),
            },
            Some("file") => source.stem(),
            Some(key) => format!("{} = {}", short(key), value(source, key)?),
        };
        match groups.iter_mut().find(|group| group.name == name) {
            Some(group) => {
                group.runs.push(source);
                group.places.push(at);
            }
            None => groups.push(Group {
                name,
                runs: vec![source],
                places: vec![at],
            }),
        }
    }
    groups.sort_by_key(|group| natural(&group.name));
    groups.iter().for_each(Group::doubt);
    Ok(groups)
}

/// The runs of each map: as [`groups`], but no more than fit beside each other.
pub(super) fn map_groups<'a>(
    sources: &'a Sources,
    by: Option<&str>,
) -> Result<Vec<Group<'a>>, Failure> {
    if by.is_some() && sources.all().len() == 1 {
        remark("note: --by sets several recordings apart, and there is one");
    }
    let groups = groups(sources, by)?;
    match groups.len() {
        many if many > MAPS_MAX => Err(Failure::input(format!(
            "--by {}: it has {many} values; {MAPS_MAX} maps are the most beside each other",
            by.unwrap_or_default()
        ))),
        _ => Ok(groups),
    }
}

impl Group<'_> {
    /// Says what is odd about runs that are taken together: other scenarios, or the same flights.
    fn doubt(&self) {
        let mut names: Vec<String> = self.runs.iter().map(|run| run.name()).collect();
        names.sort();
        names.dedup();
        if names.len() > 1 {
            remark(format!(
                "note: runs of {} scenarios are taken together: {}",
                names.len(),
                names.join(", ")
            ));
        }
        for (at, run) in self.runs.iter().enumerate() {
            if let Some(other) = self.runs[..at].iter().find(|other| other.flew_as(run)) {
                remark(format!(
                    "note: {} and {} flew alike to the last bit, with other scenarios: what differs changes nothing",
                    other.file(),
                    run.file()
                ));
                return;
            }
        }
    }

    /// How many seeds its runs have, if there are several runs of each.
    pub(super) fn seeds(&self) -> Option<usize> {
        let mut seeds: Vec<Option<u64>> =
            self.runs.iter().map(|run| run.recording.seed()).collect();
        seeds.sort_unstable();
        seeds.dedup();
        (seeds.len() > 1 && seeds.len() < self.runs.len()).then_some(seeds.len())
    }
}

/// The last part of a path: what a reader of a key knows it by.
pub(super) fn short(key: &str) -> &str {
    key.rsplit('.').next().unwrap_or(key)
}

/// A key that orders numbers in texts by their values.
fn natural(text: &str) -> Vec<(u64, String)> {
    let mut parts = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let word = rest
            .find(|c: char| c.is_ascii_digit())
            .unwrap_or(rest.len());
        let (letters, tail) = rest.split_at(word);
        let digits = tail
            .find(|c: char| !c.is_ascii_digit())
            .unwrap_or(tail.len());
        let (number, tail) = tail.split_at(digits);
        parts.push((0, letters.to_owned()));
        parts.push((number.parse().unwrap_or(0), String::new()));
        rest = tail;
    }
    parts
}

/// A value of the recorded scenario, as text.
fn value(source: &Source, key: &str) -> Result<String, Failure> {
    let text = source.recording.scenario().unwrap_or_default();
    let mut texts = Texts::default();
    let id: SourceId = texts.add("scenario", text);
    let root = simbeeotic_scenario::toml::parse(text, id).map_err(|_| {
        Failure::input(format!(
            "--by {key}: the scenario in {} cannot be read",
            source.file()
        ))
    })?;
    let mut node = &root;
    for (at, part) in key.split('.').enumerate() {
        node = inner(node, part).ok_or_else(|| {
            let before = key.split('.').take(at).collect::<Vec<_>>().join(".");
            let known = parts(node);
            let inside = match before.as_str() {
                "" => "the scenario".to_owned(),
                before => format!("`{before}`"),
            };
            let guess = simbeeotic_units::did_you_mean(part, known.iter().map(String::as_str));
            let guess = guess.map_or(String::new(), |guess| format!(" did you mean `{guess}`?"));
            Failure::input(format!(
                "--by {key}: {inside} in {} has no `{part}`;{guess} it has {}. Or: seed, file",
                source.file(),
                known.join(", ")
            ))
        })?;
    }
    shown(node).ok_or_else(|| {
        Failure::input(format!(
            "--by {key}: that is no single value; it has {}",
            parts(node).join(", ")
        ))
    })
}

/// The entry of a table, or of a list the one of this name or place.
fn inner<'a>(node: &'a Node, key: &str) -> Option<&'a Node> {
    match &node.value {
        Value::Table(table) => table.get(key),
        Value::Array(items) => {
            let named = items.iter().find(|item| called(item) == Some(key));
            named.or_else(|| items.get(key.parse::<usize>().ok()?))
        }
        _ => None,
    }
}

fn called(node: &Node) -> Option<&str> {
    let table = node.as_table()?;
    table.get("name").or_else(|| table.get("use"))?.as_str()
}

fn parts(node: &Node) -> Vec<String> {
    match &node.value {
        Value::Table(table) => table.keys().map(str::to_owned).collect(),
        Value::Array(items) => (items.iter().enumerate())
            .map(|(at, item)| called(item).map_or(at.to_string(), str::to_owned))
            .collect(),
        _ => Vec::new(),
    }
}

fn shown(node: &Node) -> Option<String> {
    Some(match &node.value {
        Value::String(text) => text.clone(),
        Value::Integer(n) => n.to_string(),
        Value::Float(x) => x.to_string(),
        Value::Bool(b) => b.to_string(),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_in_names_are_ordered_by_their_values() {
        let mut names = ["n = 10", "n = 9", "m = 11", "n = 100"];
        names.sort_by_key(|name| natural(name));
        assert_eq!(names, ["m = 11", "n = 9", "n = 10", "n = 100"]);
    }
}
