//! `like = "mav"`: a model that is as one before it, but for what it says itself.
//!
//! ```toml
//! [[model]]
//! use = "search-mav"
//! name = "mav"
//! count = 45
//! vehicle = { use = "simple-bee", mass = "50 g" }
//!
//! [[model]]
//! like = "mav"                                # use, params, vehicle, sensors, radios, battery
//! name = "heli"
//! count = 5
//! ```
//! It takes over all but `name`, `count`, `start` and nested models. Tables are merged key by key. Two
//! things replace the other whole: a part's table whose `use` is another, and a name where a table was.
//! A model that uses another behaviour does not take over `params`, which are the other's.
//!
//! The model is looked for by its `name`, or by its `use` where it has none: among those that stand before
//! it in its list, then around that list, nearest first. This is done on the tree, after `--set`, a sweep's
//! values and placeholders; what is taken over keeps its place, so that faults in it point there.

use crate::limit::LIKE_BYTES_MAX;
use crate::plan::DEFAULT_VEHICLE;
use simbeeotic_model::config::{Fault, Node, Span, Table, Value};
use std::collections::BTreeSet;

/// The key.
pub(crate) const KEY: &str = "like";
const MODEL: &str = "model";
/// What is a model's own.
const OWN: [&str; 5] = [KEY, "name", "count", "start", MODEL];

/// A model that others may be like.
#[derive(Clone)]
struct Known {
    name: String,
    /// All that they take over.
    table: Table,
    /// A key `like` in it, or in what it is like, was wrong.
    broken: bool,
}

/// Models known at one level.
struct Level {
    known: Vec<Known>,
    /// Those that stand later, the model in question not among them.
    later: Vec<String>,
}

/// Puts what models take over into them. Does nothing to a scenario in which no model is like another.
pub(crate) fn apply(root: &mut Node, faults: &mut Vec<Fault>) {
    if !any(root) {
        return;
    }
    let mut merge = Merge {
        levels: Vec::new(),
        bytes: 0,
        faults: Vec::new(),
    };
    merge.list(root);
    faults.extend(merge.faults);
}

/// Leaves each fault once: what is wrong with a value is wrong with it wherever it was taken over.
pub(crate) fn once(faults: &mut Vec<Fault>) {
    let mut told = BTreeSet::new();
    faults.retain(|fault| fault.span.is_none() || told.insert((fault.span, fault.message.clone())));
}

fn any(node: &Node) -> bool {
    let models = node.as_table().and_then(|table| table.get(MODEL));
    let mut models = models.and_then(Node::as_array).into_iter().flatten();
    models.any(|model| model.as_table().is_some_and(|t| t.get(KEY).is_some()) || any(model))
}

/// What a model is called: its name, or what it uses.
fn name(node: &Node) -> Option<String> {
    let table = node.as_table()?;
    let word = |key: &str| table.get(key).and_then(Node::as_str);
    word("name").or_else(|| word("use")).map(str::to_owned)
}

struct Merge {
    /// Lists of models, the outermost first.
    levels: Vec<Level>,
    /// What was taken over, all together.
    bytes: usize,
    faults: Vec<Fault>,
}

impl Merge {
    /// The models in the list of a node.
    fn list(&mut self, node: &mut Node) {
        let models = node.as_table_mut().and_then(|table| table.get_mut(MODEL));
        let Some(Value::Array(models)) = models.map(|node| &mut node.value) else {
            return;
        };
        let later = models.iter().filter_map(name).rev().collect();
        self.levels.push(Level {
            known: Vec::new(),
            later,
        });
        models.retain_mut(|model| self.model(model));
        self.levels.pop();
    }

    /// One model. Whether it stays: not if what it uses is not known for a fault told already.
    fn model(&mut self, model: &mut Node) -> bool {
        let called = name(model);
        if called.is_some()
            && let Some(level) = self.levels.last_mut()
        {
            level.later.pop();
        }
        let mut broken = false;
        if let Some(table) = model.as_table_mut()
            && let Some(node) = table.remove(KEY)
        {
            match self.find(&node, called.as_deref()) {
                Some(known) => {
                    broken = !self.take_over(table, &known, node.span) || known.broken;
                }
                None => broken = true,
            }
        }
        if let (Some(name), Some(table)) = (name(model).or(called), model.as_table()) {
            let entries = table.entries.iter();
            let entries = entries.filter(|(key, _)| !OWN.contains(&key.text.as_str()));
            let known = Known {
                name,
                table: Table {
                    entries: entries.cloned().collect(),
                },
                broken,
            };
            if let Some(level) = self.levels.last_mut() {
                level.known.push(known);
            }
        }
        self.list(model);
        !broken || model.as_table().is_none_or(|t| t.get("use").is_some())
    }

    /// The model that a value names, nearest first.
    fn find(&mut self, node: &Node, own: Option<&str>) -> Option<Known> {
        let Some(wanted) = node.as_str() else {
            let message = format!("{} where the name of a model is wanted", node.value.kind());
            let fault = Fault::error(node.span, message);
            self.faults.push(fault.help("for example: like = \"bee\""));
            return None;
        };
        let known = || {
            let levels = self.levels.iter().rev();
            levels.flat_map(|level| level.known.iter().rev())
        };
        if let Some(known) = known().find(|known| known.name == wanted) {
            return Some(known.clone());
        }
        let later = |level: &Level| level.later.iter().any(|name| name == wanted);
        let fault = if own == Some(wanted) {
            let message = "a model is like one before it, and this is its own name";
            Fault::error(node.span, message)
        } else if self.levels.iter().any(later) {
            let message = format!("`{wanted}` stands later: a model is like one before it");
            Fault::error(node.span, message).help("move it behind that model")
        } else {
            let names = known().map(|known| known.name.as_str());
            let fault = Fault::unknown(node.span, MODEL, wanted, names);
            match known().next() {
                None => fault.help("a model is like one before it, and this is the first"),
                Some(_) => fault,
            }
        };
        self.faults.push(fault);
        None
    }

    /// Adds to a model's table what it does not say itself. `at`: where it says what it is like.
    /// `false`: that would be too much.
    fn take_over(&mut self, table: &mut Table, known: &Known, at: Span) -> bool {
        let size: usize = known
            .table
            .entries
            .iter()
            .map(|(_, node)| bytes(node))
            .sum();
        let before = self.bytes;
        self.bytes = self.bytes.saturating_add(size);
        if self.bytes > LIKE_BYTES_MAX {
            if before <= LIKE_BYTES_MAX {
                let message = "models take over more from others than fits into memory";
                let help = format!("{LIKE_BYTES_MAX} bytes are the most, all together");
                self.faults.push(Fault::error(at, message).help(help));
            }
            return false;
        }
        let mut under = known.table.clone();
        if let (Some(own), Some(other)) = (word(table, "use"), word(&under, "use"))
            && own != other
        {
            under.remove("params");
        }
        if table.get("name").is_none()
            && let Some(node) = under.get_mut("use")
        {
            // A second model of this name is a fault of this one.
            node.span = at;
        }
        fill(table, under);
        true
    }
}

/// About what a tree takes in memory.
fn bytes(node: &Node) -> usize {
    let inner: usize = match &node.value {
        Value::Table(table) => (table.entries.iter())
            .map(|(key, node)| 48 + key.text.len() + bytes(node))
            .sum(),
        Value::Array(items) => items.iter().map(bytes).sum(),
        Value::String(text) => text.len(),
        _ => 0,
    };
    48 + inner
}

fn word<'t>(table: &'t Table, key: &str) -> Option<&'t str> {
    table.get(key).and_then(Node::as_str)
}

/// Adds to a table what another says besides.
fn fill(table: &mut Table, under: Table) {
    for (key, mut node) in under.entries {
        match table.get_mut(&key.text) {
            None => table.insert(key, node),
            Some(over) => {
                if let Some(word) = name_key(&key.text)
                    && over.as_table().is_some()
                {
                    into_table(&mut node, word);
                }
                if let (Value::Table(over), Value::Table(under)) = (&mut over.value, node.value)
                    && !replaces(&key.text, over, &under)
                {
                    fill(over, under);
                }
            }
        }
    }
}

/// Whether the upper table is of another part than the lower one.
fn replaces(key: &str, over: &Table, under: &Table) -> bool {
    let usual = (key == "vehicle").then_some(DEFAULT_VEHICLE);
    let part = |table: &Table| word(table, "use").or(usual).map(str::to_owned);
    if key == "radio" {
        // One radio, or several by their names.
        let several = |table: &Table| {
            let mut inner = table.entries.iter();
            table.get("use").is_none()
                && inner.any(|(key, node)| {
                    let inner = node.as_table().and_then(|table| table.get("use"));
                    key.text != "antenna" && inner.is_some()
                })
        };
        if several(over) != several(under) && (several(over) || over.get("use").is_some()) {
            return true;
        }
    }
    over.get("use").is_some() && part(over) != part(under)
}

/// Of a part that may be said by a name alone, the key that the name has in its table.
pub(crate) fn name_key(key: &str) -> Option<&'static str> {
    match key {
        "vehicle" | "radio" | "antenna" | "medium" | "fading" | "generate" => Some("use"),
        "battery" => Some("preset"),
        _ => None,
    }
}

/// Makes of a part's name a table with that name in it.
pub(crate) fn into_table(node: &mut Node, key: &str) {
    if node.as_str().is_some() {
        let mut table = Table::default();
        table.set(key, node.clone());
        node.value = Value::Table(table);
    }
}

#[cfg(test)]
mod tests;
