//! The table `[sweep]`, read: its keys, and what stands behind them.

use super::values::WORDS;
use super::{KEY, RUNS_MAX};
use crate::set;
use simbeeotic_model::config::{Fault, Key, Node, SourceId, Span, Table, Value};

/// The table that holds the keys.
pub(crate) const VARY: &str = "vary";
/// The table that holds the seeds.
pub(crate) const SEEDS: &str = "seeds";
const VARIABLES: &str = crate::variables::KEY;
/// Most keys that vary together.
const KEYS_MAX: usize = 64;

/// A sweep as it was written.
#[derive(Debug)]
pub(crate) struct Draft {
    /// The place of the table.
    pub(super) span: Span,
    pub(super) seeds: Option<Node>,
    pub(super) keys: Vec<Entry>,
}

/// A key that varies, and what stands behind it.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) path: Vec<Key>,
    pub(super) span: Span,
    pub(super) node: Node,
}

/// Which texts are arguments of the command line: what they say stands against what a file says.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fixed {
    /// The texts from here on.
    pub(crate) from: SourceId,
}

impl Fixed {
    fn is_argument(self, span: Span) -> bool {
        span.source >= self.from
    }
}

/// Takes `[sweep]` out of a scenario. `None` if there is none, or if nothing in it varies.
pub(crate) fn read(root: &mut Node, fixed: Fixed, faults: &mut Vec<Fault>) -> Option<Draft> {
    let node = root.as_table_mut()?.remove(KEY)?;
    let span = node.span;
    let Value::Table(table) = node.value else {
        let message = format!(
            "{} where `[sweep]` is wanted, which is a table",
            node.value.kind()
        );
        faults.push(Fault::error(span, message));
        return None;
    };
    let mut draft = Draft {
        span,
        seeds: None,
        keys: Vec::new(),
    };
    for (key, node) in table.entries {
        match key.text.as_str() {
            SEEDS => draft.seeds = Some(node),
            VARY => match &node.value {
                Value::Table(vary) => entries(vary, &[], &mut draft.keys, faults),
                other => {
                    let message = format!(
                        "{} where a table of keys and their values is wanted",
                        other.kind()
                    );
                    let fault = Fault::error(node.span, message);
                    faults.push(fault.help("[sweep.vary]  \"model.bee.count\" = [10, 20]"));
                }
            },
            other => {
                let mut fault = Fault::unknown(key.span, "key", other, [SEEDS, VARY]);
                if other.contains('.') || matches!(node.value, Value::Array(_)) {
                    fault.help = Some("what varies stands below `[sweep.vary]`".to_owned());
                }
                faults.push(fault);
            }
        }
    }
    one_of_each(root, &mut draft.keys, fixed, faults);
    if let Some(entry) = draft.keys.get(KEYS_MAX) {
        let message = format!("{KEYS_MAX} keys are the most that vary together");
        faults.push(Fault::error(entry.span, message));
        draft.keys.truncate(KEYS_MAX);
    }
    draft
        .keys
        .retain(|entry| may_vary(root, entry, fixed, faults));
    if let Some(node) = &draft.seeds
        && seeds_are_fixed(root, node, fixed, faults)
    {
        draft.seeds = None;
    }
    if let Some(seeds) = &draft.seeds
        && let Some(entry) = draft.keys.iter().find(|entry| is_seed(&entry.path))
    {
        let fault = Fault::error(entry.span, "`seeds` says the seeds of the runs already");
        faults.push(fault.help(format!("seeds = {}", crate::print::value(seeds))));
    }
    (draft.seeds.is_some() || !draft.keys.is_empty()).then_some(draft)
}

fn is_seed(path: &[Key]) -> bool {
    matches!(path, [run, seed] if run.text == "run" && seed.text == "seed")
}

/// The keys of a table. Without quotes a path is a table in a table: that is meant, too.
fn entries(table: &Table, before: &[Key], all: &mut Vec<Entry>, faults: &mut Vec<Fault>) {
    for (key, node) in &table.entries {
        // A key in quotes has a quote before it.
        let quote = usize::from(key.span.end - key.span.start == key.text.len() + 2);
        let keys = match set::split(&key.text, key.span.start + quote, key.span.source) {
            Ok(keys) => keys,
            Err(found) => {
                faults.extend(found);
                continue;
            }
        };
        let mut path: Vec<Key> = before.iter().cloned().chain(keys).collect();
        if let Value::Table(inner) = &node.value
            && !inner.is_empty()
            && !inner.keys().any(|key| WORDS.contains(&key))
        {
            entries(inner, &path, all, faults);
            continue;
        }
        let name = match before {
            [] => key.text.clone(),
            _ => path
                .iter()
                .map(|key| key.text.as_str())
                .collect::<Vec<_>>()
                .join("."),
        };
        join_variable(&mut path);
        all.push(Entry {
            name,
            path,
            span: key.span,
            node: node.clone(),
        });
    }
}

/// A variable's name may have dots.
fn join_variable(path: &mut Vec<Key>) {
    if path.len() > 2 && path[0].text == VARIABLES {
        let text: Vec<&str> = path[1..].iter().map(|key| key.text.as_str()).collect();
        let (text, mut span) = (text.join("."), path[1].span);
        span.end = span.end.max(path[path.len() - 1].span.end);
        path.truncate(1);
        path.push(Key { text, span });
    }
}

/// A key stands once, whatever it is called (`model.0.count` may be `model.bee.count`); one of the command line
/// replaces that of the file.
fn one_of_each(root: &Node, keys: &mut Vec<Entry>, fixed: Fixed, faults: &mut Vec<Fault>) {
    let mut once: Vec<(Vec<String>, Entry)> = Vec::new();
    for entry in keys.drain(..) {
        let place = set::place_of(root, &entry.path);
        match once.iter_mut().find(|(other, _)| *other == place) {
            Some((_, first)) if fixed.is_argument(first.span) || !fixed.is_argument(entry.span) => {
                let message = match first.name == entry.name {
                    true => format!("a second `{}`: a key varies once", entry.name),
                    false => format!(
                        "`{}` is `{}`, which varies already: a key varies once",
                        entry.name, first.name
                    ),
                };
                faults.push(Fault::error(entry.span, message));
            }
            Some((_, first)) => *first = entry,
            None => once.push((place, entry)),
        }
    }
    keys.extend(once.into_iter().map(|(_, entry)| entry));
}

/// Whether a key varies: its path leads somewhere, and no argument fixes it.
fn may_vary(root: &mut Node, entry: &Entry, fixed: Fixed, faults: &mut Vec<Fault>) -> bool {
    let first = entry.path.first().map_or("", |key| key.text.as_str());
    if first == KEY {
        faults.push(Fault::error(entry.span, "a sweep does not vary itself"));
        return false;
    }
    if first == VARIABLES {
        let known = root.as_table().and_then(|table| table.get(VARIABLES));
        let known = known.and_then(Node::as_table);
        let name = entry.path.get(1);
        let there = name.is_some_and(|name| known.is_some_and(|t| t.get(&name.text).is_some()));
        if !there {
            let (text, span) = name.map_or(("", entry.span), |key| (key.text.as_str(), key.span));
            let names = known.into_iter().flat_map(Table::keys);
            let fault = Fault::unknown(span, "variable", text, names);
            faults.push(match known.is_none_or(Table::is_empty) {
                true => fault.help("what varies has a value in `[variables]` first"),
                false => fault,
            });
            return false;
        }
    }
    let there = set::find(root, &entry.path).map(|node| node.span);
    if let Some(argument) = there.filter(|span| fixed.is_argument(*span)) {
        let message = format!(
            "`{}` is fixed by the command line, and does not vary",
            entry.name
        );
        faults.push(match fixed.is_argument(entry.span) {
            true => Fault::error(
                argument,
                format!("`{}` is set here, and varied too", entry.name),
            ),
            false => Fault::note(entry.span, message),
        });
        return false;
    }
    true
}

/// Whether an argument fixes the seed that a list of the file would vary.
fn seeds_are_fixed(root: &Node, seeds: &Node, fixed: Fixed, faults: &mut Vec<Fault>) -> bool {
    let run = root.as_table().and_then(|table| table.get("run"));
    let seed = run.and_then(Node::as_table).and_then(|t| t.get("seed"));
    let Some(seed) = seed.filter(|node| fixed.is_argument(node.span)) else {
        return false;
    };
    if matches!(seeds.value, Value::Integer(_)) {
        // So many from this one on.
        return false;
    }
    match fixed.is_argument(seeds.span) {
        true => {
            let message = "the seed is set here, and the seeds of all runs are listed too";
            faults.push(Fault::error(seed.span, message));
        }
        false => {
            let message = "the seed is fixed by the command line, and does not vary";
            faults.push(Fault::note(seeds.span, message));
        }
    }
    true
}

/// The seeds that stand behind `seeds`; `first` is the scenario's own.
pub(super) fn seeds(node: &Node, first: i64, faults: &mut Vec<Fault>) -> Vec<i64> {
    const HELP: &str =
        "for example: seeds = 10, or seeds = [1, 5, 9]; --seeds 10, --seeds 1..20, --seeds 1,5,9";
    if let Value::Integer(count) = node.value {
        return match usize::try_from(count) {
            Ok(count @ 1..=RUNS_MAX) => {
                (0..count as i64).map(|at| first.wrapping_add(at)).collect()
            }
            _ => {
                let message = format!("there are 1 to {RUNS_MAX} seeds");
                faults.push(Fault::error(node.span, message).help(HELP));
                Vec::new()
            }
        };
    }
    let mut seeds: Vec<i64> = Vec::new();
    let mut seen = std::collections::BTreeSet::new();
    let values = match &node.value {
        Value::Array(items) if !items.is_empty() => items.clone(),
        Value::Array(_) | Value::Table(_) => super::values::values(SEEDS, node, faults),
        other => {
            let message = format!("{} where seeds are wanted", other.kind());
            faults.push(Fault::error(node.span, message).help(HELP));
            return Vec::new();
        }
    };
    for value in values {
        match value.value {
            Value::Integer(seed) if seen.insert(seed) => seeds.push(seed),
            Value::Integer(seed) => {
                let message = format!("seed {seed} stands here twice: both runs would be the same");
                faults.push(Fault::error(value.span, message));
            }
            other => {
                let message = format!("{} where a seed is wanted, a whole number", other.kind());
                faults.push(Fault::error(value.span, message).help(HELP));
            }
        }
    }
    seeds
}

/// Sets the seed of a scenario.
pub(super) fn put_seed(root: &mut Node, seed: i64) {
    let Some(run) = root.as_table_mut().and_then(|table| table.get_mut("run")) else {
        return;
    };
    let span = run.span;
    if let Some(table) = run.as_table_mut() {
        let node = Node::new(span, Value::Integer(seed));
        match table.get_mut("seed") {
            Some(there) => there.value = node.value,
            None => table.set("seed", node),
        }
    }
}
