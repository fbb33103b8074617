//! The scenario language against the shelf: schema, defaults.

use simbeeotic_model::registry::parts;
use simbeeotic_scenario::schema;

#[test]
fn the_schema_knows_every_part_and_every_parameter() {
    let schema = schema::schema();
    let text = schema.to_string();
    for part in parts() {
        assert!(
            text.contains(&format!("\"const\":\"{}\"", part.label.name)),
            "{}",
            part.label.name
        );
        let defaults = (part.defaults)();
        for key in defaults.as_table().into_iter().flat_map(|t| t.keys()) {
            assert!(
                text.contains(&format!("\"{key}\":")),
                "{} {key}",
                part.label.name
            );
        }
    }
}

#[test]
fn every_reference_of_the_schema_leads_somewhere() {
    for schema in [schema::schema(), schema::world_schema()] {
        let mut references = Vec::new();
        collect(&schema, &mut references);
        assert!(!references.is_empty());
        for reference in references {
            let pointer = reference.strip_prefix('#').expect("in this document");
            assert!(schema.pointer(pointer).is_some(), "{reference}");
        }
    }
}

fn collect(schema: &serde_json::Value, references: &mut Vec<String>) {
    match schema {
        serde_json::Value::Object(object) => {
            for (key, value) in object {
                match value {
                    serde_json::Value::String(text) if key == "$ref" => {
                        references.push(text.clone())
                    }
                    value => collect(value, references),
                }
            }
        }
        serde_json::Value::Array(items) => items.iter().for_each(|item| collect(item, references)),
        _ => {}
    }
}

/// Defaults written out and read again make the part too.
#[test]
fn the_defaults_of_every_part_are_good_text() {
    for part in parts() {
        let text = simbeeotic_scenario::print::to_toml(&(part.defaults)());
        let mut sources = simbeeotic_model::config::Sources::new();
        let id = sources.add("defaults", text.as_str());
        let node = simbeeotic_scenario::toml::parse(&text, id).expect("valid");
        assert!(
            simbeeotic_scenario::print::same(&(part.defaults)(), &node),
            "{text}"
        );
    }
}
