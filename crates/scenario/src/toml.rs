//! TOML text to a tree of nodes that know their place.
//!
//! The tree keeps the order of the text and has a span at every key and value. The span of a
//! table reaches from its header (or brace) to the last of its values, so that it holds all that
//! stands in it.
//!
//! What TOML allows and a scenario does not: dates (a time is a quantity, `"8 h"`), `nan` and `inf`,
//! integers beyond 64 bits, nesting deeper than [`DEPTH_MAX`].

use crate::limit::{DEPTH_MAX, KEY_DOTS_MAX};
use ::toml::Spanned;
use ::toml::de::{DeTable, DeValue};
use simbeeotic_model::config::{Fault, Key, Node, SourceId, Span, Table, Value};
use std::ops::Range;

/// Reads a TOML document.
///
/// # Errors
/// Every fault of syntax; if there is none, every value that a scenario cannot hold.
pub fn parse(text: &str, source: SourceId) -> Result<Node, Vec<Fault>> {
    read(text, source, |reader| {
        let (document, errors) = DeTable::parse_recoverable(text);
        let root = reader.table(document.into_inner(), 0..text.len(), 0);
        (Some(root), errors)
    })
}

/// Reads one TOML value, as it may stand behind a `=`.
///
/// # Errors
/// As for [`parse`].
pub fn parse_value(text: &str, source: SourceId) -> Result<Node, Vec<Fault>> {
    read(text, source, |reader| {
        let (value, errors) = DeValue::parse_recoverable(text);
        let span = value.span();
        (reader.value(value.into_inner(), span, 0), errors)
    })
}

/// What `build` makes of a text, with what is wrong with its syntax.
fn read(
    text: &str,
    source: SourceId,
    build: impl FnOnce(&mut Reader) -> (Option<Node>, Vec<::toml::de::Error>),
) -> Result<Node, Vec<Fault>> {
    let mut reader = Reader {
        source,
        faults: Vec::new(),
    };
    if let Some(at) = too_many_dots(text) {
        reader.fault(at, "a key of so many parts is nested too deeply");
        return Err(reader.faults);
    }
    let (node, errors) = build(&mut reader);
    if !errors.is_empty() {
        reader.faults = errors.iter().map(|e| reader.syntax(text, e)).collect();
    }
    match node {
        Some(node) if reader.faults.is_empty() => Ok(node),
        _ => {
            reader.faults.sort_by_key(|f| f.span);
            Err(reader.faults)
        }
    }
}

struct Reader {
    source: SourceId,
    faults: Vec<Fault>,
}

impl Reader {
    fn span(&self, range: Range<usize>) -> Span {
        Span::new(self.source, range.start, range.end.max(range.start))
    }

    fn fault(&mut self, range: Range<usize>, message: impl Into<String>) {
        let span = self.span(range);
        self.faults.push(Fault::error(span, message));
    }

    fn syntax(&self, text: &str, error: &::toml::de::Error) -> Fault {
        let range = error.span().unwrap_or(text.len()..text.len());
        Fault::error(self.span(range), error.message())
    }

    fn table(&mut self, map: DeTable<'_>, own: Range<usize>, depth: usize) -> Node {
        let mut span = self.span(own);
        let mut entries = Vec::with_capacity(map.len());
        for (key, value) in map {
            let key_span = self.span(key.span());
            let value_span = value.span();
            if let Some(node) = self.value(value.into_inner(), value_span, depth + 1) {
                widen(&mut span, key_span);
                widen(&mut span, node.span);
                let key = Key {
                    text: key.into_inner().into_owned(),
                    span: key_span,
                };
                entries.push((key, node));
            }
        }
        entries.sort_by_key(|(key, _)| key.span);
        Node::new(span, Value::Table(Table { entries }))
    }

    fn value(&mut self, value: DeValue<'_>, range: Range<usize>, depth: usize) -> Option<Node> {
        let span = self.span(range.clone());
        if depth > DEPTH_MAX {
            self.fault(range, format!("nested deeper than {DEPTH_MAX} levels"));
            dismantle(value);
            return None;
        }
        let value = match value {
            DeValue::Table(map) => return Some(self.table(map, range, depth)),
            DeValue::Array(items) => return Some(self.array(items, span, depth)),
            DeValue::String(text) => Value::String(text.into_owned()),
            DeValue::Boolean(flag) => Value::Bool(flag),
            DeValue::Integer(number) => {
                let Ok(whole) = i64::from_str_radix(number.as_str(), number.radix()) else {
                    self.fault(range, "this whole number does not fit into 64 bits");
                    return None;
                };
                Value::Integer(whole)
            }
            DeValue::Float(number) => match number.as_str().parse::<f64>() {
                Ok(number) if number.is_finite() => Value::Float(number),
                _ => {
                    self.fault(range, "a number must be finite");
                    return None;
                }
            },
            DeValue::Datetime(_) => {
                let fault = Fault::error(span, "a date or time of day has no meaning here");
                self.faults
                    .push(fault.help("a span of time is written with its unit: \"90 s\""));
                return None;
            }
        };
        Some(Node::new(span, value))
    }

    fn array<'i>(
        &mut self,
        items: impl IntoIterator<Item = Spanned<DeValue<'i>>>,
        mut span: Span,
        depth: usize,
    ) -> Node {
        let mut nodes = Vec::new();
        for item in items {
            let range = item.span();
            if let Some(node) = self.value(item.into_inner(), range, depth + 1) {
                widen(&mut span, node.span);
                nodes.push(node);
            }
        }
        Node::new(span, Value::Array(nodes))
    }
}

fn widen(span: &mut Span, inner: Span) {
    span.start = span.start.min(inner.start);
    span.end = span.end.max(inner.end);
}

/// Drops a tree that may be too deep to be dropped by recursion.
fn dismantle(value: DeValue<'_>) {
    let mut rest = vec![value];
    while let Some(value) = rest.pop() {
        match value {
            DeValue::Table(map) => rest.extend(map.into_iter().map(|(_, v)| v.into_inner())),
            DeValue::Array(items) => rest.extend(items.into_iter().map(Spanned::into_inner)),
            _ => {}
        }
    }
}

/// Where a key has more dots than any scenario needs, if it does.
///
/// The parser bounds nested brackets, not dotted keys, and works on both by recursion.
fn too_many_dots(text: &str) -> Option<Range<usize>> {
    let bytes = text.as_bytes();
    let (mut at, mut dots) = (0, 0);
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'"' | b'\'' => {
                at = after_string(bytes, at);
                continue;
            }
            b'#' => {
                at = find(bytes, at, b"\n");
                continue;
            }
            b'=' | b',' | b'[' | b']' | b'{' | b'}' | b'\n' => dots = 0,
            b'.' => {
                dots += 1;
                if dots > KEY_DOTS_MAX {
                    return Some(at..at + 1);
                }
            }
            _ => {}
        }
        at += 1;
    }
    None
}

/// The first byte after the string that begins at `at`.
fn after_string(bytes: &[u8], at: usize) -> usize {
    let quote = bytes[at];
    let triple = [quote; 3];
    if bytes[at..].starts_with(&triple) {
        return find(bytes, at + 3, &triple) + 3;
    }
    let mut at = at + 1;
    while let Some(&byte) = bytes.get(at) {
        match byte {
            b'\\' if quote == b'"' => at += 1,
            b'\n' => return at,
            _ if byte == quote => return at + 1,
            _ => {}
        }
        at += 1;
    }
    at
}

fn find(bytes: &[u8], from: usize, what: &[u8]) -> usize {
    let rest = bytes.get(from..).unwrap_or(&[]);
    rest.windows(what.len())
        .position(|w| w == what)
        .map_or(bytes.len(), |found| from + found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Node {
        parse(text, SourceId(0)).expect("valid TOML")
    }

    fn faults(text: &str) -> Vec<(String, usize)> {
        let faults = parse(text, SourceId(0)).expect_err("broken TOML");
        faults
            .into_iter()
            .map(|f| (f.message, f.span.map_or(0, |s| s.start)))
            .collect()
    }

    #[test]
    fn keys_keep_the_order_of_the_text() {
        let node = read("z = 1\na = 2\n[m.b]\nx = 1\n[m.a]\n[b]\n");
        let root = node.as_table().expect("a table");
        assert_eq!(root.keys().collect::<Vec<_>>(), ["z", "a", "m", "b"]);
        let m = root.get("m").and_then(Node::as_table).expect("a table");
        assert_eq!(m.keys().collect::<Vec<_>>(), ["b", "a"]);
    }

    #[test]
    fn a_table_spans_all_that_stands_in_it() {
        let text = "[[model]]\nuse = \"a\"\n[model.params]\nx = 12\n";
        let node = read(text);
        let model = node
            .as_table()
            .and_then(|t| t.get("model"))
            .expect("a list");
        assert_eq!(&text[model.span.start..model.span.end], text.trim_end());
        let x = text.find("12").expect("there");
        assert!(model.span.contains(Span::new(SourceId(0), x, x + 2)));
    }

    #[test]
    fn several_faults_of_syntax_are_found_at_once() {
        let found = faults("a = \nb = 1\nb = 2\n[x\n");
        assert!(found.len() >= 3, "{found:?}");
    }

    #[test]
    fn what_a_scenario_cannot_hold_is_refused_all_at_once() {
        let found = faults("a = nan\nb = [1, -inf]\nc = 1979-05-27\nd = 9223372036854775808\n");
        let places: Vec<_> = found.iter().map(|(_, at)| *at).collect();
        assert_eq!(places, [4, 16, 26, 41], "{found:?}");
    }

    #[test]
    fn whole_numbers_of_any_radix_are_read() {
        let node = read("a = 0xff\nb = 0o17\nc = -1_000\n");
        let values: Vec<_> = node
            .as_table()
            .into_iter()
            .flat_map(|t| &t.entries)
            .collect();
        let values: Vec<_> = values.into_iter().map(|(_, n)| n.value.clone()).collect();
        assert_eq!(
            values,
            [
                Value::Integer(255),
                Value::Integer(15),
                Value::Integer(-1000)
            ]
        );
    }

    #[test]
    fn depth_is_bounded_however_it_is_written() {
        let many = 100_000;
        let texts = [
            format!("a = {}{}", "[".repeat(many), "]".repeat(many)),
            format!("a = {}1{}", "{a=".repeat(many), "}".repeat(many)),
            format!("a{} = 1", ".a".repeat(many)),
            format!("[a{}]", ".a".repeat(many)),
            format!("a = {{ a{} = 1 }}\na = 2", ". a".repeat(many)),
            format!("a = {}1{}", "{a.b.c.d.e.f=".repeat(70), "}".repeat(70)),
            format!("a = {}1{}", "[{a=".repeat(30), "}]".repeat(30)),
        ];
        for text in texts {
            assert!(parse(&text, SourceId(0)).is_err(), "{}", &text[..60]);
        }
    }

    #[test]
    fn dots_in_strings_and_comments_are_only_dots() {
        let dots = ".".repeat(500);
        let text = format!("a = \"{dots}\" # {dots}\nb = '{dots}'\nc = \"\"\"\n{dots}\"\"\"\n");
        assert!(parse(&text, SourceId(0)).is_ok());
        let numbers = format!("a = [{}]", "1.5, ".repeat(500));
        assert!(parse(&numbers, SourceId(0)).is_ok());
    }

    #[test]
    fn one_value_is_read_as_behind_an_equals_sign() {
        let value = |text| parse_value(text, SourceId(0)).map(|n| n.value);
        assert_eq!(value("12"), Ok(Value::Integer(12)));
        assert_eq!(value("\"5 s\""), Ok(Value::String("5 s".into())));
        assert!(value("5 s").is_err());
        assert!(value("").is_err());
    }
}
