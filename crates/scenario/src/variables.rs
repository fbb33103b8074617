//! Variables of a scenario, and the placeholders that stand for them in it and in its world.
//!
//! ```toml
//! [variables]
//! wall = "3 m"
//! trees = 40
//! ```
//! `"${wall}"` as a whole text becomes the variable's value, number or text; inside of a text,
//! `"${trees} m"`, it becomes a piece of it. `"${wall}:2 m"` has a default for scenarios that do not
//! set it. `--set variables.wall="4 m"` changes one, `[sweep.vary]` gives one several values. A variable
//! may be made of others. An XML scenario's variables (`looping`) are the variables of its world, too.

use simbeeotic_model::config::{Fault, Node, SourceId, Span, Value};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Arc, Mutex, PoisonError};

/// The key of the table.
pub(crate) const KEY: &str = "variables";

/// What the variables of a scenario are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variables {
    known: BTreeMap<String, Value>,
    asked: Asked,
}

/// The names that placeholders have asked for, of a set of variables and all its copies together.
#[derive(Clone, Debug, Default)]
struct Asked(Arc<Mutex<BTreeSet<String>>>);

impl Asked {
    fn note(&self, name: &str) {
        let mut names = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if !names.contains(name) {
            names.insert(name.to_owned());
        }
    }

    fn names(&self) -> BTreeSet<String> {
        let names = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        names.clone()
    }
}

/// Who has asked is no part of what the variables are.
impl PartialEq for Asked {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Variables {
    /// The variables that a scenario sets in its table.
    pub(crate) fn of(root: &Node, faults: &mut Vec<Fault>) -> Self {
        let mut variables = Self::default();
        let Some(node) = root.as_table().and_then(|table| table.get(KEY)) else {
            return variables;
        };
        let Some(table) = node.as_table() else {
            let message = format!("{} where `[variables]` is wanted", node.value.kind());
            faults.push(Fault::error(node.span, message));
            return variables;
        };
        let mut made: Vec<(&str, &Node)> = Vec::new();
        for (key, node) in &table.entries {
            if !is_name(&key.text) {
                let message = format!("`{}` is no name for a variable", key.text);
                faults.push(Fault::error(key.span, message).help(NAME_HELP));
            }
            match &node.value {
                Value::Table(_) | Value::Array(_) => {
                    let message = format!("{} where one value is wanted", node.value.kind());
                    faults.push(Fault::error(node.span, message));
                }
                Value::String(text) if text.contains("${") => made.push((&key.text, node)),
                value => {
                    variables.known.insert(key.text.clone(), value.clone());
                }
            }
        }
        variables.make(made, faults);
        variables
    }

    /// Adds variables whose values name others, each after those that it names.
    fn make(&mut self, mut made: Vec<(&str, &Node)>, faults: &mut Vec<Fault>) {
        let text = |node: &Node| node.as_str().unwrap_or_default().to_owned();
        while !made.is_empty() {
            let waits = |node: &Node| {
                named(&text(node)).any(|name| made.iter().any(|(other, _)| *other == name))
            };
            let (waiting, ready): (Vec<_>, Vec<_>) =
                made.iter().copied().partition(|(_, node)| waits(node));
            if ready.is_empty() {
                for (name, node) in waiting {
                    let message = format!("variable `{name}` depends on itself");
                    faults.push(Fault::error(node.span, message));
                }
                return;
            }
            for (name, node) in ready {
                if let Some(value) = self.value(&text(node), node.span, faults) {
                    self.known.insert(name.to_owned(), value);
                }
            }
            made = waiting;
        }
    }

    /// Takes over the variables of another, which count more.
    pub(crate) fn extend(&mut self, other: Self) {
        self.known.extend(other.known);
    }

    /// Sets a variable to what an XML file says: text that may be a number.
    pub(crate) fn set(&mut self, name: &str, text: &str) {
        self.known.insert(name.to_owned(), typed(text));
    }

    /// The names, in order.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.known.keys().map(String::as_str)
    }

    /// Names and values, a line each, for a hash; nobody has asked for them by that.
    pub(crate) fn lines(&self) -> String {
        let line = |(name, value): (&String, &Value)| format!("{name} = {value:?}\n");
        self.known.iter().map(line).collect()
    }

    /// The value of a variable as text.
    pub(crate) fn text(&self, name: &str) -> Option<String> {
        self.get(name).map(written)
    }

    /// The value for a placeholder.
    fn get(&self, name: &str) -> Option<&Value> {
        self.asked.note(name);
        self.known.get(name)
    }

    /// Variables in the table of `root` that no placeholder has asked for: a mistake where `said` (on the
    /// command line), since nothing would change, and a warning elsewhere.
    pub(crate) fn unused(&self, root: &Node, said: impl Fn(Span) -> bool, faults: &mut Vec<Fault>) {
        let table = root.as_table().and_then(|table| table.get(KEY));
        let Some(table) = table.and_then(Node::as_table) else {
            return;
        };
        let asked = self.asked.names();
        for (key, _) in &table.entries {
            let name = key.text.as_str();
            if asked.contains(name) || !self.known.contains_key(name) {
                continue;
            }
            let message = format!("variable `{name}` stands for nothing: no placeholder names it");
            let help = match simbeeotic_units::did_you_mean(name, asked.iter().map(String::as_str))
            {
                Some(guess) => format!("did you mean `{guess}`?"),
                None => format!("a scenario or its world uses it as \"${{{name}}}\""),
            };
            let fault = match said(key.span) {
                true => Fault::error(key.span, message),
                false => Fault::warning(key.span, message),
            };
            faults.push(fault.help(help));
        }
    }

    /// Puts values in the place of all placeholders of a tree, but those in `[variables]` itself.
    pub(crate) fn apply(&self, root: &mut Node, faults: &mut Vec<Fault>) {
        match &mut root.value {
            Value::Table(table) => {
                for (key, node) in &mut table.entries {
                    if key.text != KEY {
                        self.apply(node, faults);
                    }
                }
            }
            Value::Array(items) => {
                for item in items {
                    self.apply(item, faults);
                }
            }
            Value::String(text) if text.contains("${") => {
                if let Some(value) = self.value(text, root.span, faults) {
                    root.value = value;
                }
            }
            _ => {}
        }
    }

    fn value(&self, text: &str, span: Span, faults: &mut Vec<Fault>) -> Option<Value> {
        if let Some((name, default)) = placeholder(text) {
            let default = default.map(|text| typed(text.trim()));
            let value = self.get(name).cloned().or(default);
            if value.is_none() {
                faults.push(self.unknown(name, span));
            }
            return value;
        }
        let mut whole = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once("${") {
            let Some((name, behind)) = after.split_once('}').filter(|(name, _)| is_name(name))
            else {
                let fault = Fault::error(span, "`${` begins a placeholder, and this is none");
                faults.push(fault.help("a placeholder is `${name}`, or `${name}:default` alone"));
                return None;
            };
            let Some(value) = self.get(name) else {
                faults.push(self.unknown(name, span));
                return None;
            };
            whole.push_str(before);
            whole.push_str(&written(value));
            rest = behind;
        }
        whole.push_str(rest);
        Some(Value::String(whole))
    }

    fn unknown(&self, name: &str, span: Span) -> Fault {
        let fault = Fault::unknown(span, "variable", name, self.names());
        match self.known.is_empty() {
            true => fault.help(format!(
                "a scenario sets it, `[variables] {name} = \"1 m\"`, or `--set variables.{name}=\"1 m\"`, or \
                 it has a default: \"${{{name}}}:1 m\""
            )),
            false => fault,
        }
    }
}

/// What a name of a variable is made of.
pub(crate) const NAME_HELP: &str = "letters and digits, joined by `-`, `_` or `.`";

/// A number or a truth value if the text is one.
pub(crate) fn typed(text: &str) -> Value {
    let value = crate::toml::parse_value(text, SourceId(0)).map(|node| node.value);
    match value {
        Ok(value @ (Value::Integer(_) | Value::Float(_) | Value::Bool(_))) => value,
        _ => Value::String(text.to_owned()),
    }
}

/// A value as it stands inside of a text.
fn written(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => number.to_string(),
        Value::Bool(flag) => flag.to_string(),
        Value::Table(_) | Value::Array(_) => String::new(),
    }
}

/// Name and default of a placeholder, `${name}` or `${name}:default`, if the whole text is one.
pub(crate) fn placeholder(text: &str) -> Option<(&str, Option<&str>)> {
    let (name, rest) = text.trim().strip_prefix("${")?.split_once('}')?;
    if !is_name(name) {
        return None;
    }
    match rest {
        "" => Some((name, None)),
        _ => rest.strip_prefix(':').map(|default| (name, Some(default))),
    }
}

/// The names of all placeholders in a text.
pub(crate) fn named(text: &str) -> impl Iterator<Item = &str> {
    let behind = text.split("${").skip(1);
    let names = behind.filter_map(|part| part.split_once('}').map(|(name, _)| name));
    names.filter(|name| is_name(name))
}

/// Letter first, then letters and digits in sections joined by `-`, `_` or `.`.
pub(crate) fn is_name(name: &str) -> bool {
    let joint = |c: char| matches!(c, '-' | '_' | '.');
    name.starts_with(|c: char| c.is_alphabetic())
        && name
            .split(joint)
            .all(|s| !s.is_empty() && s.chars().all(char::is_alphanumeric))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::print::to_toml;

    fn applied(text: &str) -> Result<String, Vec<Fault>> {
        let mut root = crate::toml::parse(text, SourceId(0))?;
        let mut faults = Vec::new();
        let variables = Variables::of(&root, &mut faults);
        variables.apply(&mut root, &mut faults);
        match faults.is_empty() {
            true => Ok(to_toml(&root)),
            false => Err(faults),
        }
    }

    #[test]
    fn a_placeholder_is_a_value_or_a_piece_of_a_text() {
        let text = applied(
            "a = [\"${w}\", \"${n}\", \"${w}:1 m\", \"${no}:1 m\", \"${no}:7\", \"${n} m\", \"x${n}-${w}\"]\n\
             [variables]\nw = \"3 m\"\nn = 40\n",
        );
        let line = "a = [\"3 m\", 40, \"3 m\", \"1 m\", 7, \"40 m\", \"x40-3 m\"]";
        let text = text.expect("good");
        assert!(text.lines().any(|l| l == line), "{text}");
    }

    #[test]
    fn a_variable_may_be_made_of_others_but_not_of_itself() {
        let text = applied(
            "x = \"${c}\"\ny = \"${b}\"\n[variables]\nc = \"${b}-${a}\"\nb = \"${a}\"\na = 4\nd = \"${e}:7\"\n",
        );
        let text = text.expect("good");
        assert!(text.contains("x = \"4-4\"\ny = 4\n"), "{text}");
        let faults = applied("[variables]\na = \"${b}\"\nb = \"${a} m\"\nc = 1\n");
        let faults = faults.expect_err("a circle");
        assert_eq!(faults.len(), 2, "{faults:?}");
        assert!(faults[0].message.contains("`a` depends on itself"));
        let faults = applied("[variables]\nwall = 1\nb = \"${wal}\"\n").expect_err("unknown");
        assert_eq!(faults[0].help.as_deref(), Some("did you mean `wall`?"));
    }

    #[test]
    fn a_placeholder_without_a_value_is_an_error_with_a_guess() {
        let faults = applied("a = \"${wal}\"\nb = \"${\"\nc = \"${1}x\"\n[variables]\nwall = 3\n");
        let faults = faults.expect_err("three");
        assert_eq!(faults.len(), 3);
        assert_eq!(faults[0].help.as_deref(), Some("did you mean `wall`?"));
        let alone = applied("a = \"${w}\"\n").expect_err("no value");
        assert!(
            alone[0]
                .help
                .as_deref()
                .is_some_and(|h| h.contains("\"${w}:1 m\""))
        );
    }

    #[test]
    fn variables_are_single_values_with_proper_names() {
        for text in [
            "variables = 3",
            "[variables]\na = [1]",
            "[variables]\n\"a b\" = 1",
        ] {
            assert!(applied(text).is_err(), "{text}");
        }
    }
}
