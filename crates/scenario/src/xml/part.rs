//! A class of the original with its properties, as a part of ours with its parameters.

use super::classes::{self, As, Class, To};
use super::read::{Translation, number, put, whole};
use super::tree::{Element, Text};
use simbeeotic_model::config::{Fault, Node, Span, Table, Value};
use simbeeotic_model::registry::{self, Kind, Part};

/// The parts that stand for a class, and what is known of the class.
pub(super) struct Found {
    pub(super) kind: Kind,
    pub(super) class: Option<&'static Class>,
    pub(super) part: &'static Part,
    /// Where the class was named.
    pub(super) span: Span,
}

/// What the properties of an element say.
#[derive(Default)]
pub(super) struct Settings {
    /// Parameters of the part itself.
    pub(super) params: Table,
    /// Parameters of the vehicle it is as well.
    pub(super) vehicle: Table,
    /// Whether the start is random, and where that was said.
    pub(super) random_start: Option<(bool, Span)>,
    /// How far a random start reaches.
    pub(super) random_start_bound: Option<(f64, Span)>,
}

impl Translation {
    /// The class of an element, if it is known and simulated. Says what is wrong if it is not.
    pub(super) fn class(&mut self, element: &Element, kinds: &[Kind]) -> Option<Found> {
        let Some(child) = element.child("java-class") else {
            let message = format!("`{}` has no `java-class`", element.name.text);
            self.error(element.name.span, message);
            return None;
        };
        let java = self.content(child)?;
        let class = classes::find(&java.text).filter(|c| kinds.contains(&c.kind));
        let aliased = kinds
            .iter()
            .find_map(|kind| registry::find(*kind, &java.text));
        let part = aliased.or_else(|| class.and_then(classes::find_part));
        match (part, class) {
            (Some(part), _) => {
                if let Some(note) = class.and_then(|c| c.note) {
                    self.note_once(java.span, note);
                }
                Some(Found {
                    kind: part.kind,
                    class,
                    part,
                    span: java.span,
                })
            }
            (None, Some(class)) => {
                let short = class.java.rsplit('.').next().unwrap_or(class.java);
                let message = format!("`{short}` is known, not simulated yet, and left out");
                self.warn(java.span, message);
                None
            }
            (None, None) => {
                self.unknown_class(&java, kinds);
                None
            }
        }
    }

    fn unknown_class(&mut self, java: &Text, kinds: &[Kind]) {
        let message = format!("unknown class `{}`", java.text);
        let mut fault = Fault::error(java.span, message);
        let mut names = classes::names(kinds);
        for kind in kinds {
            names.extend(
                registry::of_kind(*kind)
                    .flat_map(|p| p.label.java)
                    .map(|j| (*j).to_owned()),
            );
        }
        let known = names.iter().map(String::as_str);
        fault = match simbeeotic_units::did_you_mean(&java.text, known) {
            Some(guess) => fault.help(format!("did you mean `{guess}`?")),
            None => match classes::find(&java.text) {
                Some(class) => fault.help(format!("this is a {}", class.kind.name())),
                None => fault.help("no part here has this class for its Java name"),
            },
        };
        self.faults.push(fault);
    }

    /// The properties of an element, translated.
    pub(super) fn properties(&mut self, element: &Element, found: &Found) -> Settings {
        let mut settings = Settings::default();
        if let Some(config) = element.child("custom-config") {
            self.warn(config.name.span, "`custom-config` is not read");
        }
        let Some(properties) = element.child("properties") else {
            return settings;
        };
        self.check(properties, &[], &[], &["prop"]);
        let mut seen: Vec<&str> = Vec::new();
        for prop in properties.children("prop") {
            self.check(prop, &["name", "value"], &[], &[]);
            let written = prop.attribute("value").cloned();
            let value = match &written {
                Some(text) => Some(self.replace(text)),
                None => self.required(prop, "value"),
            };
            let name = prop.attribute("name");
            let Some(name) = name else {
                self.required(prop, "name");
                continue;
            };
            let Some(value) = value else { continue };
            if seen.contains(&name.text.as_str()) {
                let message = format!("a second `{}`: a property is set once", name.text);
                self.error(name.span, message);
                continue;
            }
            seen.push(&name.text);
            self.written = written;
            match found.class {
                Some(class) => self.property(class, name, &value, &mut settings),
                None => self.foreign_property(found.part, name, &value, &mut settings),
            }
            self.written = None;
        }
        settings
    }

    fn property(&mut self, class: &Class, name: &Text, value: &Text, settings: &mut Settings) {
        let Some(property) = class.property(&name.text) else {
            self.unknown(name, "property", class.part, &class.property_names());
            return;
        };
        match &property.to {
            To::Param(key, how) => {
                if let Some(node) = self.value(value, how) {
                    put(&mut settings.params, key, name.span, node);
                }
            }
            To::Vehicle(key, how) => {
                if let Some(node) = self.value(value, how) {
                    put(&mut settings.vehicle, key, name.span, node);
                }
            }
            To::Component(key, at, unit) => {
                if let Some(node) = self.quantity(value, unit) {
                    let node = self.property_varied(node, unit);
                    put_component(&mut settings.params, key, *at, unit, name.span, node);
                }
            }
            To::RandomStart => {
                self.cannot_vary(name);
                settings.random_start = self.flag(value).map(|flag| (flag, name.span));
            }
            To::RandomStartBound => {
                self.cannot_vary(name);
                let bound = self.number(value);
                if bound.is_some_and(|b| b < 0.0) {
                    self.error(value.span, "a bound is not negative");
                }
                settings.random_start_bound = bound.map(|b| (b, value.span));
            }
            To::Gone(why) => {
                self.warn(
                    name.span,
                    format!("`{}` does nothing here: {why}", name.text),
                );
            }
        }
    }

    fn value(&mut self, text: &Text, how: &As) -> Option<Node> {
        let value = match how {
            As::Unit(unit) => {
                let node = self.quantity(text, unit)?;
                return Some(self.property_varied(node, unit));
            }
            As::Whole => Value::Integer(self.whole(text)?),
            As::Number => Value::Float(self.number(text)?),
            As::Flag => Value::Bool(self.flag(text)?),
            As::Text => Value::String(text.text.clone()),
        };
        Some(self.property_varied(Node::new(text.span, value), ""))
    }

    /// The value, or the placeholder of the variable that varies it.
    fn property_varied(&self, node: Node, unit: &str) -> Node {
        match &self.written {
            Some(written) => self.varied(written, node, unit),
            None => node,
        }
    }

    fn cannot_vary(&mut self, name: &Text) {
        let varies = |text: &Text| self.variables.varying(&text.text).is_some();
        if self.written.as_ref().is_some_and(varies) {
            let message = format!("`{}` does not vary here: its first value counts", name.text);
            self.warn(name.span, message);
        }
    }

    /// A property of a class that only its own crate knows: its name in snake case, its value as the
    /// part's schema wants it, bare numbers in SI.
    fn foreign_property(
        &mut self,
        part: &Part,
        name: &Text,
        value: &Text,
        settings: &mut Settings,
    ) {
        let key = name.text.replace('-', "_").to_lowercase();
        let schema = (part.schema)();
        let known = schema.get("properties").and_then(|p| p.as_object());
        let Some(property) = known.and_then(|known| known.get(&key)) else {
            let keys: Vec<&str> = known
                .iter()
                .flat_map(|k| k.keys())
                .map(String::as_str)
                .collect();
            self.unknown(name, "property", part.label.name, &keys);
            return;
        };
        let unit = find_key(schema.as_value(), property, "x-si-unit");
        let kind = find_key(schema.as_value(), property, "type");
        let value_node = match (unit.as_deref(), kind.as_deref()) {
            (Some(unit), _) if number(&value.text).is_some() => {
                let node = self.quantity(value, unit);
                node.map(|node| self.property_varied(node, unit))
            }
            (None, Some("boolean")) => self.value(value, &As::Flag),
            (None, Some("integer")) => self.value(value, &As::Whole),
            (None, Some("number")) => self.value(value, &As::Number),
            (None, None) if whole(&value.text).is_some() => self.value(value, &As::Whole),
            _ => self.value(value, &As::Text),
        };
        if let Some(node) = value_node {
            put(&mut settings.params, &key, name.span, node);
        }
    }
}

/// A text in a property's schema, or in the definition that the schema refers to.
fn find_key(schema: &serde_json::Value, property: &serde_json::Value, key: &str) -> Option<String> {
    if let Some(text) = property.get(key).and_then(|v| v.as_str()) {
        return Some(text.to_owned());
    }
    let pointer = property.get("$ref")?.as_str()?.strip_prefix('#')?;
    let definition = schema.pointer(pointer)?;
    definition.get(key)?.as_str().map(str::to_owned)
}

/// Sets one of three components of `key`; the others are zero until they are set.
fn put_component(table: &mut Table, key: &str, at: usize, unit: &str, name: Span, node: Node) {
    let zero = || Node::string(node.span, format!("0 {unit}"));
    if table.get(key).is_none() {
        let zeros = Node::new(node.span, Value::Array(vec![zero(), zero(), zero()]));
        put(table, key, name, zeros);
    }
    if let Some(Node {
        value: Value::Array(items),
        span,
    }) = table.get_mut(key)
        && let Some(item) = items.get_mut(at)
    {
        super::read::widen(span, node.span);
        *item = node;
    }
}
