//! From a typed value to a node: defaults as they would be written in a file.

use super::node::{Node, Span, Table, Value};
use serde::Serialize;

/// `value` as a tree without places. Values that no file can hold (null, bytes) become absent.
pub fn to_node<T: Serialize>(value: &T) -> Node {
    let json = serde_json::to_value(value).unwrap_or(serde_json::Value::Null);
    from_json(json).unwrap_or_else(|| Node::table(Span::default()))
}

fn from_json(json: serde_json::Value) -> Option<Node> {
    let value = match json {
        serde_json::Value::Null => return None,
        serde_json::Value::Bool(flag) => Value::Bool(flag),
        serde_json::Value::Number(n) => match n.as_i64() {
            Some(whole) => Value::Integer(whole),
            None => Value::Float(n.as_f64()?),
        },
        serde_json::Value::String(text) => Value::String(text),
        serde_json::Value::Array(items) => {
            Value::Array(items.into_iter().filter_map(from_json).collect())
        }
        serde_json::Value::Object(entries) => {
            let mut table = Table::default();
            for (key, item) in entries {
                if let Some(node) = from_json(item) {
                    table.set(&key, node);
                }
            }
            Value::Table(table)
        }
    };
    Some(Node::new(Span::default(), value))
}
