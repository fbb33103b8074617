//! From a section to a typed value, with all its faults at once.

use super::de::ReadError;
use super::fault::Fault;
use super::node::{Node, Span, Table, Value};
use schemars::JsonSchema;
use serde::Serialize;
use serde::de::DeserializeOwned;

/// What a part lets a scenario set: fields with defaults, documentation and units.
///
/// Do not implement it by hand: put `#[params]` on a struct that implements [`Default`].
pub trait Params:
    DeserializeOwned + Serialize + JsonSchema + Default + Clone + Send + Sync + 'static
{
}

impl<T> Params for T where
    T: DeserializeOwned + Serialize + JsonSchema + Default + Clone + Send + Sync + 'static
{
}

/// Reads one value; the first fault ends it.
///
/// # Errors
/// A fault at the value (or key) that does not fit `T`.
pub fn read<T: DeserializeOwned>(node: &Node) -> Result<T, Fault> {
    T::deserialize(node).map_err(|error| Fault::from(error.or_at(node.span)))
}

/// Reads a whole section and reports every fault in it.
///
/// A fault's entry is set aside and the rest read again, until it reads or nothing can be set
/// aside. So three wrong keys give three faults, wherever they are nested.
///
/// # Errors
/// All faults found, in the order of the text.
pub fn read_params<T: DeserializeOwned>(node: &Node) -> Result<T, Vec<Fault>> {
    match T::deserialize(node) {
        Ok(value) => Ok(value),
        Err(first) => Err(all_faults::<T>(node, first)),
    }
}

fn all_faults<T: DeserializeOwned>(node: &Node, first: ReadError) -> Vec<Fault> {
    let mut rest = node.clone();
    let mut faults = Vec::new();
    let mut error = first;
    loop {
        let span = error.span;
        faults.push(Fault::from(error.or_at(node.span)));
        let set_aside = match (span, rest.as_table_mut()) {
            (Some(span), Some(table)) => set_aside(table, span),
            _ => false,
        };
        if !set_aside {
            break;
        }
        match T::deserialize(&rest) {
            Ok(_) => break,
            Err(next) => error = next,
        }
    }
    faults.sort_by_key(|f| f.span);
    drop_choiceless(&mut faults);
    faults
}

/// A choice that was wrong is set aside to find what else is; that the choice is missing then is no
/// news.
fn drop_choiceless(faults: &mut Vec<Fault>) {
    let places: Vec<Span> = faults.iter().filter_map(|f| f.span).collect();
    let holds_another = |outer: Span| places.iter().any(|p| *p != outer && outer.contains(*p));
    faults.retain(|f| {
        let choiceless = f.message.ends_with("where one choice is wanted");
        !(choiceless && f.span.is_some_and(holds_another))
    });
}

/// Takes out the innermost table entry that `span` belongs to, in tables of lists too.
fn set_aside(table: &mut Table, span: Span) -> bool {
    if let Some(at) = table.entries.iter().position(|(key, _)| key.span == span) {
        table.entries.remove(at);
        return true;
    }
    let Some(at) = table
        .entries
        .iter()
        .position(|(_, node)| node.span.contains(span))
    else {
        return false;
    };
    let done = match &mut table.entries[at].1.value {
        Value::Table(inner) => set_aside(inner, span),
        Value::Array(items) => items
            .iter_mut()
            .filter(|item| item.span.contains(span))
            .filter_map(Node::as_table_mut)
            .any(|inner| set_aside(inner, span)),
        _ => false,
    };
    if !done {
        table.entries.remove(at);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::super::node::SourceId;
    use super::*;
    use serde::Deserialize;

    fn at(start: usize, end: usize) -> Span {
        Span::new(SourceId(0), start, end)
    }

    #[derive(Debug, Default, Deserialize, PartialEq)]
    #[serde(default, deny_unknown_fields)]
    struct Inner {
        mean: f64,
        sigma: f64,
    }

    #[derive(Debug, Default, Deserialize, PartialEq)]
    #[serde(default, deny_unknown_fields)]
    struct Outer {
        count: u32,
        name: String,
        noise: Inner,
    }

    fn entry(table: &mut Table, key: &str, from: usize, value: Value) {
        let key = super::super::node::Key {
            text: key.into(),
            span: at(from, from + 2),
        };
        table.insert(key, Node::new(at(from + 3, from + 9), value));
    }

    #[test]
    fn all_faults_of_a_section_are_found_at_once() {
        let mut noise = Table::default();
        entry(&mut noise, "mena", 51, Value::Float(1.0));
        entry(&mut noise, "sigma", 61, Value::String("x".into()));
        let mut table = Table::default();
        entry(&mut table, "count", 0, Value::String("many".into()));
        entry(&mut table, "nmae", 10, Value::String("x".into()));
        table.set("noise", Node::new(at(50, 80), Value::Table(noise)));
        let node = Node::new(at(0, 100), Value::Table(table));
        let faults = read_params::<Outer>(&node).expect_err("four faults");
        let places: Vec<_> = faults
            .iter()
            .filter_map(|f| f.span)
            .map(|s| s.start)
            .collect();
        assert_eq!(places, [3, 10, 51, 64], "{faults:?}");
        assert_eq!(faults[1].help.as_deref(), Some("did you mean `name`?"));
    }

    #[test]
    fn one_wrong_table_of_a_list_does_not_hide_the_next() {
        #[derive(Debug, Default, Deserialize)]
        #[serde(default)]
        struct List {
            noise: Vec<Inner>,
        }
        let item = |from: usize| {
            let mut inner = Table::default();
            entry(&mut inner, "mean", from + 1, Value::String("x".into()));
            Node::new(at(from, from + 15), Value::Table(inner))
        };
        let mut table = Table::default();
        table.set(
            "noise",
            Node::new(at(5, 60), Value::Array(vec![item(10), item(30)])),
        );
        let node = Node::new(at(0, 100), Value::Table(table));
        let faults = read_params::<List>(&node).expect_err("two faults");
        assert_eq!(faults.len(), 2, "{faults:?}");
        assert_eq!(faults[0].message, "text where a number is wanted");
    }

    #[test]
    fn a_list_of_the_wrong_length_has_its_place() {
        let list = |n| {
            Node::new(
                at(7, 9),
                Value::Array(vec![Node::new(at(8, 8), Value::Integer(1)); n]),
            )
        };
        for (n, said) in [
            (0, "this list is empty; wanted: a list of length 2"),
            (1, "this list has 1 entry; wanted: a list of length 2"),
            (3, "this list has 1 entry too many"),
        ] {
            let faults = read_params::<[u64; 2]>(&list(n)).expect_err("wrong length");
            assert_eq!(
                (faults[0].span, faults[0].message.as_str()),
                (Some(at(7, 9)), said)
            );
        }
    }

    #[test]
    fn a_list_is_no_table() {
        let mut table = Table::default();
        entry(&mut table, "noise", 10, Value::Array(Vec::new()));
        let node = Node::new(at(0, 100), Value::Table(table));
        let faults = read_params::<Outer>(&node).expect_err("a list");
        assert_eq!(
            (faults[0].span, faults[0].message.as_str()),
            (Some(at(13, 19)), "a list where a table is wanted")
        );
    }

    #[test]
    fn a_good_section_reads_whole() {
        let mut table = Table::default();
        entry(&mut table, "count", 0, Value::Integer(3));
        let node = Node::new(at(0, 100), Value::Table(table));
        assert_eq!(
            read_params::<Outer>(&node),
            Ok(Outer {
                count: 3,
                ..Outer::default()
            })
        );
    }
}
