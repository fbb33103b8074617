//! A tree as TOML text that a person would have written.
//!
//! Plain values come first, then tables as sections, in the order of the tree. A small table of
//! plain values stands on one line; the sections of a model never do.
//!
//! Reading the text gives the same tree again, apart from places and from the order of values and
//! sections in a table.

use simbeeotic_model::config::{Node, Table, Value};
use std::fmt::Write;

/// Inline tables and lists that fit into this many characters stand on one line.
const LINE_MAX: usize = 88;
/// An inline table has no more entries than this, outside of lists.
const INLINE_MAX: usize = 4;
/// Tables that stand as sections however small they are.
const SECTIONS: [&str; 21] = [
    "run",
    "channel",
    "weather",
    "world",
    "physics",
    "record",
    "model",
    "component",
    "params",
    "vehicle",
    "sensor",
    "radio",
    "battery",
    "sweep",
    "vary",
    "variables",
    "ground",
    "obstacle",
    "structure",
    "patch",
    "person",
];
/// Tables that may hold others by names of the user's own, and those of their keys that are none.
const NAMED: [&str; 2] = ["sensor", "radio"];
const NO_NAMES: [&str; 2] = ["antenna", "mount"];

/// The tree as TOML text. A tree that is no table gives the text of its value.
pub fn to_toml(node: &Node) -> String {
    let mut text = String::new();
    match &node.value {
        Value::Table(table) => section(&mut text, &[], table),
        _ => list_or_inline(&mut text, node),
    }
    text
}

/// A value on one line, as it stands behind a `=`.
pub fn value(node: &Node) -> String {
    let mut text = String::new();
    inline(&mut text, node);
    text
}

/// Writes the entries of a table whose header, if it has one, is written.
fn section(text: &mut String, path: &[&str], table: &Table) {
    let named = path.last().is_some_and(|last| NAMED.contains(last));
    for (key, node) in &table.entries {
        if !stands_alone(&key.text, node, named) {
            text.push_str(&quoted_key(&key.text));
            text.push_str(" = ");
            list_or_inline(text, node);
            text.push('\n');
        }
    }
    for (key, node) in &table.entries {
        if !stands_alone(&key.text, node, named) {
            continue;
        }
        let inner: Vec<&str> = path.iter().copied().chain([key.text.as_str()]).collect();
        match &node.value {
            Value::Table(table) => header(text, &inner, "[", "]", table),
            Value::Array(items) => {
                for table in items.iter().filter_map(Node::as_table) {
                    header(text, &inner, "[[", "]]", table);
                }
            }
            _ => {}
        }
    }
}

fn header(text: &mut String, path: &[&str], open: &str, close: &str, table: &Table) {
    // A table of nothing but sections needs no header of its own.
    let named = path.last().is_some_and(|last| NAMED.contains(last));
    let only_sections = !table.is_empty()
        && table
            .entries
            .iter()
            .all(|(k, n)| stands_alone(&k.text, n, named));
    if open == "[[" || !only_sections {
        if !text.is_empty() {
            text.push('\n');
        }
        let keys: Vec<String> = path.iter().map(|key| quoted_key(key)).collect();
        let _ = writeln!(text, "{open}{}{close}", keys.join("."));
    }
    section(text, path, table);
}

/// Whether an entry is written as a section, or several, below the plain values.
fn stands_alone(key: &str, node: &Node, named: bool) -> bool {
    match &node.value {
        Value::Table(table) => {
            named && !NO_NAMES.contains(&key) || SECTIONS.contains(&key) || !is_small(table)
        }
        Value::Array(items) => {
            let tables = !items.is_empty() && items.iter().all(|n| n.as_table().is_some());
            tables && (SECTIONS.contains(&key) || !fits(node))
        }
        _ => false,
    }
}

fn is_small(table: &Table) -> bool {
    table.entries.len() <= INLINE_MAX
        && table.entries.iter().all(|(_, node)| match &node.value {
            Value::Table(inner) => is_small(inner),
            Value::Array(items) => items.iter().all(|n| n.as_table().is_none()),
            _ => true,
        })
        && fits_table(table)
}

fn fits_table(table: &Table) -> bool {
    let mut text = String::new();
    inline_table(&mut text, table);
    text.chars().count() <= LINE_MAX && !text.contains('\n')
}

fn fits(node: &Node) -> bool {
    let mut text = String::new();
    inline(&mut text, node);
    text.chars().count() <= LINE_MAX
}

/// A value behind `key = `, on several lines if it is a long list.
fn list_or_inline(text: &mut String, node: &Node) {
    match &node.value {
        Value::Array(items) if !fits(node) => {
            text.push_str("[\n");
            for item in items {
                text.push_str("    ");
                inline(text, item);
                text.push_str(",\n");
            }
            text.push(']');
        }
        _ => inline(text, node),
    }
}

fn inline(text: &mut String, node: &Node) {
    match &node.value {
        Value::Table(table) => inline_table(text, table),
        Value::Array(items) => {
            text.push('[');
            for (at, item) in items.iter().enumerate() {
                text.push_str(if at == 0 { "" } else { ", " });
                inline(text, item);
            }
            text.push(']');
        }
        Value::String(word) => text.push_str(&quoted(word)),
        Value::Integer(number) => {
            let _ = write!(text, "{number}");
        }
        // Debug writes 1.0 and 1e300, where Display would write an integer.
        Value::Float(number) => {
            let _ = write!(text, "{number:?}");
        }
        Value::Bool(flag) => {
            let _ = write!(text, "{flag}");
        }
    }
}

fn inline_table(text: &mut String, table: &Table) {
    if table.is_empty() {
        text.push_str("{}");
        return;
    }
    text.push_str("{ ");
    for (at, (key, node)) in table.entries.iter().enumerate() {
        text.push_str(if at == 0 { "" } else { ", " });
        text.push_str(&quoted_key(&key.text));
        text.push_str(" = ");
        inline(text, node);
    }
    text.push_str(" }");
}

fn quoted_key(key: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
    if !key.is_empty() && key.chars().all(bare) {
        key.to_owned()
    } else {
        quoted(key)
    }
}

fn quoted(word: &str) -> String {
    let mut text = String::from("\"");
    for letter in word.chars() {
        match letter {
            '"' => text.push_str("\\\""),
            '\\' => text.push_str("\\\\"),
            '\n' => text.push_str("\\n"),
            '\t' => text.push_str("\\t"),
            '\r' => text.push_str("\\r"),
            c if (c as u32) < 0x20 || c as u32 == 0x7f => {
                let _ = write!(text, "\\u{:04X}", c as u32);
            }
            c => text.push(c),
        }
    }
    text.push('"');
    text
}

/// Whether two trees say the same: places and the order of keys do not count.
pub fn same(a: &Node, b: &Node) -> bool {
    match (&a.value, &b.value) {
        (Value::Table(a), Value::Table(b)) => {
            a.entries.len() == b.entries.len()
                && a.entries
                    .iter()
                    .all(|(key, node)| b.get(&key.text).is_some_and(|other| same(node, other)))
        }
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (a, b) => a == b,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use simbeeotic_model::config::{Key, SourceId, Span};

    fn read(text: &str) -> Node {
        match crate::toml::parse(text, SourceId(0)) {
            Ok(node) => node,
            Err(faults) => panic!("{faults:?} in\n{text}"),
        }
    }

    fn node() -> impl Strategy<Value = Node> {
        let plain = prop_oneof![
            ".{0,12}".prop_map(Value::String),
            "[a-z0-9 ./%]{30,80}".prop_map(Value::String),
            any::<i64>().prop_map(Value::Integer),
            prop::num::f64::NORMAL.prop_map(Value::Float),
            Just(Value::Float(0.0)),
            any::<bool>().prop_map(Value::Bool),
        ];
        let key = prop_oneof![
            "[a-z_]{1,6}",
            ".{0,4}",
            prop::sample::select(SECTIONS.to_vec()).prop_map(str::to_owned),
        ];
        let tree = plain.prop_recursive(5, 60, 6, move |inner| {
            let entry = (key.clone(), inner.clone());
            let table = prop::collection::vec(entry, 0..6).prop_map(|entries| {
                let mut table = Table::default();
                for (key, value) in entries {
                    let key = Key {
                        text: key,
                        span: Span::default(),
                    };
                    table.insert(key, Node::new(Span::default(), value));
                }
                Value::Table(table)
            });
            let list = prop::collection::vec(inner, 0..5).prop_map(|items| {
                let nodes = items.into_iter().map(|v| Node::new(Span::default(), v));
                Value::Array(nodes.collect())
            });
            prop_oneof![table, list]
        });
        tree.prop_map(|value| {
            let mut table = Table::default();
            table.set("root", Node::new(Span::default(), value));
            Node::new(Span::default(), Value::Table(table))
        })
    }

    proptest! {
        #[test]
        fn what_is_printed_reads_as_the_same_tree(node in node()) {
            let text = to_toml(&node);
            let back = read(&text);
            prop_assert!(same(&node, &back), "{text}");
            prop_assert!(same(&read(&to_toml(&back)), &back));
        }
    }

    #[test]
    fn a_scenario_looks_as_if_a_person_had_written_it() {
        let text = r#"run = { seed = 1, end_time = "1 s" }
model = [{ use = "inert-bee", start = ["0 m", "0 m", "1 m"], params = { hover = true }, sensor = { compass = { use = "compass" }, "odd name" = { use = "position", mount = { pointing = [1.0, 0.0, 0.0] } } }, model = [{ use = "inert-bee" }] }]
channel = { use = "free-space", noise_floor = { mean = "-100 dBm", sigma = "10 dB" } }
"#;
        insta::assert_snapshot!(to_toml(&read(text)), @r#"
        [run]
        seed = 1
        end_time = "1 s"

        [[model]]
        use = "inert-bee"
        start = ["0 m", "0 m", "1 m"]

        [model.params]
        hover = true

        [model.sensor.compass]
        use = "compass"

        [model.sensor."odd name"]
        use = "position"
        mount = { pointing = [1.0, 0.0, 0.0] }

        [[model.model]]
        use = "inert-bee"

        [channel]
        use = "free-space"
        noise_floor = { mean = "-100 dBm", sigma = "10 dB" }
        "#);
    }
}
