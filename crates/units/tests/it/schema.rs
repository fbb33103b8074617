//! The JSON schema: what editors and `describe` show.

use schemars::{JsonSchema, schema_for};
use serde::{Deserialize, Serialize};
use serde_json::json;
use simbeeotic_units::*;

/// Parameters of a test.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
struct Params {
    /// Top speed of the walk.
    max_speed: Speed,
    place: Position,
    /// Where it looks first.
    look: Option<Heading>,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            max_speed: Speed::si(2.0),
            place: Position::ZERO,
            look: None,
        }
    }
}

#[test]
fn a_field_has_its_unit_its_default_and_its_words() {
    let schema = schema_for!(Params);
    let properties = &schema.as_value()["properties"];
    assert_eq!(
        properties["max_speed"],
        json!({
            "type": "string",
            "description": "Top speed of the walk.",
            "x-si-unit": "m/s",
            "x-units": ["m/s", "cm/s", "mm/s", "km/h"],
            "default": "2 m/s",
        })
    );
    assert_eq!(
        properties["place"],
        json!({
            "type": "array",
            "description": "[east, north, up], each a length with a unit",
            "items": {
                "type": "string",
                "description": "a length with a unit: m, km, cm, mm, um",
                "x-si-unit": "m",
                "x-units": ["m", "km", "cm", "mm", "um"],
            },
            "minItems": 3,
            "maxItems": 3,
            "x-frame": "ENU",
            "default": ["0 m", "0 m", "0 m"],
        })
    );
    assert_eq!(properties["look"]["type"], json!(["string", "null"]));
    assert_eq!(properties["look"]["x-si-unit"], "rad");
    assert_eq!(properties["look"]["description"], "Where it looks first.");
}

#[test]
fn a_direction_says_how_it_counts() {
    let description = |schema: schemars::Schema| schema.as_value()["description"].clone();
    assert_eq!(
        description(schema_for!(Heading)),
        "a direction as an angle clockwise from north, 0 to 1 turn"
    );
    assert_eq!(
        description(schema_for!(Yaw)),
        "a direction as an angle counter-clockwise from east, -0.5 to 0.5 turn"
    );
}

#[test]
fn a_pose_has_the_three_forms_of_an_attitude() {
    let schema = schema_for!(Pose);
    let schema = schema.as_value();
    assert_eq!(schema["additionalProperties"], json!(false));
    let forms = schema["$defs"]["Attitude"]["anyOf"].as_array().unwrap();
    assert_eq!(forms.len(), 3);
    assert_eq!(forms[0]["properties"]["heading"]["x-si-unit"], "rad");
}
