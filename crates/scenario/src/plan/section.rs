//! One table of a scenario being read: what is asked for is known, the rest is a fault.

use serde::de::DeserializeOwned;
use simbeeotic_model::config::{Fault, Key, Node, Table, Value, read_params};
use simbeeotic_model::registry::{Kind, Part, of_kind};
use simbeeotic_units::did_you_mean;

/// A table, and the keys that were asked for so far.
pub(super) struct Section<'n> {
    pub(super) node: &'n Node,
    table: &'n Table,
    known: Vec<&'static str>,
}

impl<'n> Section<'n> {
    /// The table in `node`, or a fault that it is none.
    pub(super) fn open(node: &'n Node, what: &str, faults: &mut Vec<Fault>) -> Option<Self> {
        match &node.value {
            Value::Table(table) => Some(Self {
                node,
                table,
                known: Vec::new(),
            }),
            other => {
                let message = format!("{} where {what} is wanted, which is a table", other.kind());
                faults.push(Fault::error(node.span, message));
                None
            }
        }
    }

    /// As [`open`](Self::open), for the table of a part: a text in its place may be the part's name.
    pub(super) fn open_part(
        node: &'n Node,
        what: &str,
        (key, kind): (&str, Kind),
        faults: &mut Vec<Fault>,
    ) -> Option<Self> {
        let before = faults.len();
        let section = Self::open(node, what, faults);
        if section.is_none()
            && let Some(fault) = faults.get_mut(before)
        {
            fault.help = table_help(node, key, kind);
        }
        section
    }

    /// The value of a key, if it is there.
    pub(super) fn get(&mut self, key: &'static str) -> Option<&'n Node> {
        self.entry(key).map(|(_, node)| node)
    }

    /// Key and value, if they are there.
    pub(super) fn entry(&mut self, key: &'static str) -> Option<&'n (Key, Node)> {
        self.known.push(key);
        self.table.entry(key)
    }

    /// The value of a key as a `T`; faults if it is there and is none.
    pub(super) fn read<T: DeserializeOwned>(
        &mut self,
        key: &'static str,
        faults: &mut Vec<Fault>,
    ) -> Option<T> {
        read(self.get(key)?, faults)
    }

    /// The value of a key that must be there.
    pub(super) fn required(
        &mut self,
        key: &'static str,
        example: &str,
        faults: &mut Vec<Fault>,
    ) -> Option<&'n Node> {
        let node = self.get(key);
        if node.is_none() {
            let fault = Fault::error(self.node.span, format!("`{key}` is missing here"));
            faults.push(fault.help(format!("for example: {example}")));
        }
        node
    }

    /// A fault for each key that nobody asked for.
    pub(super) fn finish(self, faults: &mut Vec<Fault>) {
        for (key, _) in &self.table.entries {
            if !self.known.contains(&key.text.as_str()) {
                let known = self.known.iter().copied();
                faults.push(Fault::unknown(key.span, "key", &key.text, known));
            }
        }
    }

    /// Those of these keys that are there.
    pub(super) fn entries(&self, keys: &[&str]) -> Vec<(Key, Node)> {
        let entries = self.table.entries.iter();
        let entries = entries.filter(|(key, _)| keys.contains(&key.text.as_str()));
        entries.cloned().collect()
    }

    /// The keys that nobody asked for: the parameters of `part`. What is not one of its parameters
    /// is a fault, with both kinds of keys to guess from.
    pub(super) fn rest(self, part: &Part, faults: &mut Vec<Fault>) -> Node {
        let schema = (part.schema)();
        let parameters = schema.get("properties").and_then(|p| p.as_object());
        let parameters: Vec<&str> = parameters
            .iter()
            .flat_map(|p| p.keys())
            .map(String::as_str)
            .collect();
        let mut rest = Table::default();
        for (key, node) in &self.table.entries {
            let word = key.text.as_str();
            if self.known.contains(&word) {
                continue;
            }
            if parameters.contains(&word) {
                rest.insert(key.clone(), node.clone());
            } else {
                let known = parameters.iter().chain(&self.known).copied();
                faults.push(Fault::unknown(key.span, "key", word, known));
            }
        }
        Node::new(self.node.span, Value::Table(rest))
    }
}

/// Help for a text where a table of a part is wanted: the table that was meant. `key` leads to it.
pub(super) fn table_help(node: &Node, key: &str, kind: Kind) -> Option<String> {
    let word = node.as_str()?;
    let names: Vec<&str> = of_kind(kind).map(|part| part.label.name).collect();
    let name = names
        .iter()
        .find(|name| **name == word)
        .copied()
        .or_else(|| did_you_mean(word, names.iter().copied()))
        .or_else(|| names.first().copied())?;
    Some(format!("write: {key} = {{ use = \"{name}\" }}"))
}

/// A value as a `T`, or all the faults in it.
pub(super) fn read<T: DeserializeOwned>(node: &Node, faults: &mut Vec<Fault>) -> Option<T> {
    match read_params(node) {
        Ok(value) => Some(value),
        Err(found) => {
            faults.extend(found);
            None
        }
    }
}
