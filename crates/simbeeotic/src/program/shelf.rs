//! `list`, `describe`, `schema`: what a scenario can name.

use super::{Failure, say};
use serde_json::{Value, json};
use simbeeotic_model::config::{Fault, Node, to_node};
use simbeeotic_model::registry::{self, Kind, Part};
use simbeeotic_scenario::plan::PhysicsParams;
use std::fmt::Write as _;

/// Lists parts, of one kind or of all.
pub(super) fn list(kind: Option<&str>, json: bool) -> Result<(), Failure> {
    let kinds: Vec<Kind> = match kind {
        None => Kind::ALL.to_vec(),
        Some(word) => vec![kind_called(word)?],
    };
    let parts: Vec<&Part> = kinds.iter().flat_map(|k| registry::of_kind(*k)).collect();
    if json {
        let rows: Vec<Value> = parts
            .iter()
            .map(|p| {
                json!({
                    "kind": p.kind.name(), "name": p.label.name, "module": p.label.module,
                    "summary": p.summary(), "java": p.label.java,
                })
            })
            .collect();
        return say(format!("{:#}", Value::Array(rows)));
    }
    let mut page = String::new();
    for kind in kinds {
        let mut of_kind = registry::of_kind(kind).peekable();
        if of_kind.peek().is_none() {
            continue;
        }
        let _ = writeln!(page, "{}", kind.name());
        for part in of_kind {
            let summary = part.summary().replace('\n', " ");
            let _ = writeln!(
                page,
                "  {:<18} {}",
                part.label.name,
                first_sentence(&summary)
            );
        }
        page.push('\n');
    }
    page.push_str("`simbeeotic describe NAME` shows a part's parameters; `describe physics` those of [physics].");
    say(page)
}

fn kind_called(word: &str) -> Result<Kind, Failure> {
    let word = word.strip_suffix('s').unwrap_or(word);
    Kind::ALL
        .into_iter()
        .find(|k| k.name() == word)
        .ok_or_else(|| {
            let fault = Fault::unknown(None, "kind of part", word, Kind::ALL.map(Kind::name));
            Failure::input(format!(
                "{}; {}",
                fault,
                fault.help.as_deref().unwrap_or("")
            ))
        })
}

fn first_sentence(text: &str) -> &str {
    text.find(". ")
        .map_or(text.trim_end_matches('.'), |end| &text[..end])
}

/// Describes the parts called `name`, or the section `physics`.
pub(super) fn describe(name: &str, json: bool) -> Result<(), Failure> {
    if name == PHYSICS {
        return describe_physics(json);
    }
    let found: Vec<&Part> = registry::parts()
        .iter()
        .copied()
        .filter(|p| p.label.name == name || p.label.java.contains(&name))
        .collect();
    if found.is_empty() {
        let fault = Fault::unknown(
            None,
            "part",
            name,
            registry::parts()
                .iter()
                .map(|p| p.label.name)
                .chain([PHYSICS]),
        );
        let help = fault.help.as_deref().unwrap_or("");
        return Err(Failure::input(format!("{fault}; {help}")));
    }
    for part in found {
        if json {
            say(format!("{:#}", (part.schema)().to_value()))?;
        } else {
            say(page(part))?;
        }
    }
    Ok(())
}

/// Describes the part of one kind called `name`.
pub(super) fn describe_kind(kind: Kind, name: &str) -> Result<(), Failure> {
    let named = Node::string(simbeeotic_model::config::Span::default(), name);
    match registry::find_node(kind, &named) {
        Ok(part) => say(page(part)),
        Err(fault) => {
            let help = fault.help.as_deref().unwrap_or("");
            Err(Failure::input(format!("{fault}; {help}")))
        }
    }
}

/// The section that is described as parts are.
const PHYSICS: &str = "physics";

fn describe_physics(json: bool) -> Result<(), Failure> {
    let schema = simbeeotic_model::schemars::schema_for!(PhysicsParams).to_value();
    if json {
        return say(format!("{schema:#}"));
    }
    let docs = schema["description"].as_str().unwrap_or_default();
    let mut page = format!("physics (a section of the scenario: [physics])\n\n  {docs}\n");
    parameters(&mut page, &schema, &to_node(&PhysicsParams::default()));
    say(page)
}

fn page(part: &Part) -> String {
    let mut page = format!(
        "{} ({}, in {})\n\n",
        part.label.name,
        part.kind.name(),
        part.label.module
    );
    for line in part.label.docs.lines() {
        let _ = writeln!(page, "  {line}");
    }
    parameters(&mut page, &(part.schema)().to_value(), &(part.defaults)());
    if !part.label.java.is_empty() {
        let _ = writeln!(page, "\nIn the original: {}", part.label.java.join(", "));
    }
    page
}

/// Each parameter with its default (if it has one), its words, its unit, its choices.
fn parameters(page: &mut String, schema: &Value, defaults: &Node) {
    let empty = serde_json::Map::new();
    let fields = schema["properties"].as_object().unwrap_or(&empty);
    if fields.is_empty() {
        page.push_str("\nIt has no parameters.\n");
    } else {
        page.push_str("\nParameters:\n");
    }
    for (name, field) in fields {
        let default = defaults.as_table().and_then(|t| t.get(name));
        let value = default.map(simbeeotic_scenario::print::value);
        let value = value.map(|v| format!(" = {v}")).unwrap_or_default();
        let _ = writeln!(page, "\n  {name}{value}");
        let kind = resolve(schema, field);
        let text = field["description"]
            .as_str()
            .or(kind["description"].as_str())
            .unwrap_or("");
        for line in text.lines() {
            let _ = writeln!(page, "      {line}");
        }
        if let Some(units) = units(kind).filter(|u| !u.is_empty()) {
            let _ = writeln!(page, "      unit: {units}");
        }
        let choices = choices(kind);
        if !choices.is_empty() {
            let _ = writeln!(page, "      one of: {}", choices.join(", "));
        }
    }
}

/// The type of a field: itself, or the definition that it refers to.
fn resolve<'a>(schema: &'a Value, field: &'a Value) -> &'a Value {
    let reference = field["$ref"]
        .as_str()
        .or(field["allOf"][0]["$ref"].as_str());
    let name = reference.and_then(|r| r.rsplit('/').next());
    name.and_then(|name| schema["$defs"].get(name))
        .unwrap_or(field)
}

fn units(field: &Value) -> Option<String> {
    let units = field["x-units"]
        .as_array()
        .or_else(|| field["items"]["x-units"].as_array())?;
    Some(
        units
            .iter()
            .filter_map(Value::as_str)
            .collect::<Vec<_>>()
            .join(", "),
    )
}

fn choices(field: &Value) -> Vec<&str> {
    if let Some(words) = field["enum"].as_array() {
        return words.iter().filter_map(Value::as_str).collect();
    }
    let one_of = field["oneOf"]
        .as_array()
        .map(Vec::as_slice)
        .unwrap_or_default();
    one_of.iter().filter_map(|v| v["const"].as_str()).collect()
}

/// Prints the JSON schema of scenario files.
pub(super) fn schema() -> Result<(), Failure> {
    say(format!("{:#}", simbeeotic_scenario::schema::schema()))
}
