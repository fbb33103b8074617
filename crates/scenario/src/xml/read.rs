//! What every translation of an element does: look for what is known, say what is not.

use super::tree::{Element, Text};
use super::variables::Variables;
use simbeeotic_model::config::{Fault, Key, Node, Span, Table, Value};
use std::collections::BTreeSet;

/// A document being translated: its faults so far, its variables.
pub(crate) struct Translation {
    pub(crate) faults: Vec<Fault>,
    pub(crate) variables: Variables,
    /// The text of the property that is being read, before its placeholder was replaced.
    pub(crate) written: Option<Text>,
    said: BTreeSet<&'static str>,
}

impl Translation {
    pub(crate) fn new(variables: Variables) -> Self {
        Self {
            faults: Vec::new(),
            variables,
            written: None,
            said: BTreeSet::new(),
        }
    }

    pub(crate) fn error(&mut self, span: Span, message: impl Into<String>) {
        self.faults.push(Fault::error(span, message));
    }

    pub(crate) fn warn(&mut self, span: Span, message: impl Into<String>) {
        self.faults.push(Fault::warning(span, message));
    }

    /// A note that a document needs only once, whatever the number of places it applies to.
    pub(crate) fn note_once(&mut self, span: Span, message: &'static str) {
        if self.said.insert(message) {
            self.faults.push(Fault::note(span, message));
        }
    }

    /// Warns of attributes and elements in `element` that nobody will look at. Text where elements
    /// belong is an error, and so are elements that stand there twice.
    pub(crate) fn check(
        &mut self,
        element: &Element,
        attributes: &[&str],
        once: &[&str],
        many: &[&str],
    ) {
        for attribute in &element.attributes {
            let name = &attribute.name;
            if !attributes.contains(&name.text.as_str()) {
                self.unknown(name, "attribute", &element.name.text, attributes);
            }
        }
        for (at, child) in element.children.iter().enumerate() {
            let name = child.name.text.as_str();
            if once.contains(&name) {
                if element.children[..at].iter().any(|c| c.name.text == name) {
                    self.error(
                        child.name.span,
                        format!("a second `{name}`: there is one at most"),
                    );
                }
            } else if !many.contains(&name) {
                let known: Vec<&str> = once.iter().chain(many).copied().collect();
                self.unknown(&child.name, "element", &element.name.text, &known);
            }
        }
        let wants_elements = !once.is_empty() || !many.is_empty();
        if wants_elements && !element.text.text.trim().is_empty() {
            let message = format!(
                "text in `{}` means nothing: is a `<` missing?",
                element.name.text
            );
            self.error(element.text.span, message);
        }
    }

    /// A warning about something that is not known and is left out: `what` it is, and `of` what.
    pub(crate) fn unknown(&mut self, name: &Text, what: &str, of: &str, known: &[&str]) {
        let message = format!(
            "unknown {what} `{}` of `{of}`, which is left out",
            name.text
        );
        let fault = Fault::warning(name.span, message);
        let guess = Fault::unknown(name.span, what, &name.text, known.iter().copied()).help;
        self.faults.push(match guess {
            Some(guess) if !known.is_empty() => fault.help(guess),
            _ => fault,
        });
    }

    /// The text of a place that does not vary, as [`Self::replace`] gives it; a warning if its variable does.
    pub(crate) fn resolve(&mut self, text: &Text) -> Text {
        let value = self.replace(text);
        if let Some(name) = self.variables.varying(&text.text) {
            let message = format!("`{name}` does not vary here: its first value counts");
            self.warn(text.span, message);
        }
        value
    }

    /// The text with its placeholder, if it is one, replaced by its variable's value.
    pub(crate) fn replace(&mut self, text: &Text) -> Text {
        match self.variables.resolve(text, &mut self.faults) {
            Some(value) => Text {
                text: value,
                span: text.span,
            },
            None => text.clone(),
        }
    }

    /// The text in an element, or an error that it is missing.
    pub(crate) fn content(&mut self, element: &Element) -> Option<Text> {
        self.check(element, &[], &[], &[]);
        if element.text.text.trim().is_empty() {
            let message = format!("`{}` is empty", element.name.text);
            self.error(element.name.span, message);
            return None;
        }
        let text = self.resolve(&element.text);
        Some(Text {
            text: text.text.trim().to_owned(),
            span: text.span,
        })
    }

    /// An attribute that must be there.
    pub(crate) fn required(&mut self, element: &Element, name: &str) -> Option<Text> {
        match element.attribute(name) {
            Some(text) => Some(self.resolve(text)),
            None => {
                let message = format!("`{}` has no `{name}`", element.name.text);
                self.error(element.name.span, message);
                None
            }
        }
    }

    /// An attribute that may be there.
    pub(crate) fn optional(&mut self, element: &Element, name: &str) -> Option<Text> {
        let text = element.attribute(name)?.clone();
        Some(self.resolve(&text))
    }

    pub(crate) fn number(&mut self, text: &Text) -> Option<f64> {
        let number = number(&text.text);
        if number.is_none() {
            self.error(text.span, format!("`{}` is not a number", text.text));
        }
        number
    }

    pub(crate) fn whole(&mut self, text: &Text) -> Option<i64> {
        let whole = whole(&text.text);
        if whole.is_none() {
            self.error(text.span, format!("`{}` is not a whole number", text.text));
        }
        whole
    }

    pub(crate) fn flag(&mut self, text: &Text) -> Option<bool> {
        match text.text.trim().to_ascii_lowercase().as_str() {
            "true" | "1" => Some(true),
            "false" | "0" => Some(false),
            _ => {
                self.error(
                    text.span,
                    format!("`{}` is neither true nor false", text.text),
                );
                None
            }
        }
    }

    /// A number with the unit that the original meant, as a quantity of ours.
    pub(crate) fn quantity(&mut self, text: &Text, unit: &str) -> Option<Node> {
        // A variable of a TOML scenario says its unit itself.
        if number(&text.text).is_none() && self.variables.is_given(&text.text) {
            return Some(Node::string(text.span, text.text.clone()));
        }
        let number = self.number(text)?;
        Some(Node::string(text.span, format!("{number} {unit}")))
    }

    /// What was read of a text, or the placeholder of the variable that varies it.
    pub(crate) fn varied(&self, text: &Text, node: Node, unit: &str) -> Node {
        match (self.variables.varying(&text.text), unit) {
            (None, _) => node,
            (Some(name), "") => Node::string(node.span, format!("${{{name}}}")),
            (Some(name), unit) => Node::string(node.span, format!("${{{name}}} {unit}")),
        }
    }

    /// The attributes `x`, `y` and `z` of an element as quantities.
    pub(crate) fn vector(&mut self, element: &Element, unit: &str, need_z: bool) -> Option<Node> {
        self.check(element, &["x", "y", "z"], &[], &[]);
        let x = self.component(element, "x", unit, true);
        let y = self.component(element, "y", unit, true);
        let z = self.component(element, "z", unit, need_z);
        Some(Node::new(element.span, Value::Array(vec![x?, y?, z?])))
    }

    fn component(&mut self, element: &Element, axis: &str, unit: &str, need: bool) -> Option<Node> {
        let text = match element.attribute(axis) {
            Some(text) => text.clone(),
            None if need => return self.required(element, axis).and(None),
            None => Text {
                text: "0".into(),
                span: element.span,
            },
        };
        let value = self.replace(&text);
        let node = self.quantity(&value, unit)?;
        Some(self.varied(&text, node, unit))
    }
}

/// A number as Java writes it: a trailing `f` or `d` is allowed, `NaN` and infinities are not.
pub(crate) fn number(text: &str) -> Option<f64> {
    let text = text.trim();
    let digits = text.strip_suffix(['f', 'F', 'd', 'D']).unwrap_or(text);
    digits.parse::<f64>().ok().filter(|n| n.is_finite())
}

/// A whole number; `3.0` is one too, since variables count in fractions.
pub(crate) fn whole(text: &str) -> Option<i64> {
    let text = text.trim();
    let digits = text.strip_suffix(['l', 'L']).unwrap_or(text);
    if let Ok(whole) = digits.parse::<i64>() {
        return Some(whole);
    }
    let number = number(text)?;
    (number.fract() == 0.0 && number.abs() < 9e15).then_some(number as i64)
}

/// Puts `node` into `table` at a path of keys with dots, making the tables on the way.
pub(crate) fn put(table: &mut Table, path: &str, key_span: Span, node: Node) {
    let Some((first, rest)) = path.split_once('.') else {
        table.insert(
            Key {
                text: path.to_owned(),
                span: key_span,
            },
            node,
        );
        return;
    };
    if table.get(first).is_none() {
        let inner = Node::table(node.span);
        table.insert(
            Key {
                text: first.to_owned(),
                span: key_span,
            },
            inner,
        );
    }
    if let Some(inner) = table.get_mut(first) {
        widen(&mut inner.span, node.span);
        if let Some(inner) = inner.as_table_mut() {
            put(inner, rest, key_span, node);
        }
    }
}

pub(crate) fn widen(span: &mut Span, inner: Span) {
    if span.source == inner.source {
        span.start = span.start.min(inner.start);
        span.end = span.end.max(inner.end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_java_reads_them() {
        assert_eq!(number(" 1.5f "), Some(1.5));
        assert_eq!(number("-1e3"), Some(-1000.0));
        assert_eq!(number("20"), Some(20.0));
        for text in [
            "", "NaN", "inf", "Infinity", "1.5 m", "f", "0x10", "1,5", "1e999",
        ] {
            assert_eq!(number(text), None, "{text}");
        }
        assert_eq!(whole("8192"), Some(8192));
        assert_eq!(whole("3.0"), Some(3));
        assert_eq!(whole("3.5"), None);
    }
}
