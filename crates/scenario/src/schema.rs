//! The JSON schema of scenario files, made from the parts on the shelf.
//!
//! Editors complete and check with it: the first line of a scenario says
//! `#:schema ./scenario.schema.json`. A section whose `use` names a part has that part's
//! parameters.

use crate::limit::QUEUE_FRAMES_MAX;
use crate::plan::{DEFAULT_VEHICLE, PhysicsParams};
use schemars::{SchemaGenerator, generate::SchemaSettings};
use serde_json::{Map, Value, json};
use simbeeotic_model::ShadowingParams;
use simbeeotic_model::energy::BatteryParams;
use simbeeotic_model::registry::{Kind, Part, of_kind};
use simbeeotic_units::{
    Attitude, Current, Decibels, Frequency, Heading, Length, Offset, Position, PowerLevel, Time,
    Yaw,
};
use simbeeotic_world::World;

/// The schema of scenario files, with all parts that this program knows.
pub fn schema() -> Value {
    let mut all = Definitions {
        generator: SchemaSettings::draft2020_12().into_generator(),
        parts: Map::new(),
    };
    let properties = json!({
        "name": { "type": "string", "description": "What people call it." },
        "description": { "type": "string", "description": "What it is for, and what one should see." },
        "run": run(&mut all),
        "channel": channel(&mut all),
        "weather": one_of(&mut all, Kind::Weather, &Map::new(), "The wind, and the air."),
        "world": world(&mut all),
        "variables": {
            "type": "object",
            "description": "What placeholders `${name}` stand for, here and in the world.",
            "additionalProperties": { "type": ["string", "number", "boolean"] },
        },
        "physics": physics(&mut all),
        "record": record(&mut all),
        "model": { "type": "array", "description": "The models.", "items": { "$ref": "#/$defs/model" } },
        "component": component(&mut all),
        "sweep": sweep(),
    });
    let model = model(&mut all);
    let start = start(&mut all);
    let mut definitions = all.generator.take_definitions(true);
    definitions.append(&mut all.parts);
    definitions.insert("model".into(), model);
    definitions.insert("start".into(), start);
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Simbeeotic scenario",
        "description": "What flies, where, for how long, and who watches.",
        "type": "object",
        "properties": properties,
        "required": ["run"],
        "additionalProperties": false,
        "$defs": definitions,
    })
}

/// The schema of world files.
pub fn world_schema() -> Value {
    let mut schema = schemars::schema_for!(World);
    schema.insert("title".into(), "Simbeeotic world".into());
    schema.to_value()
}

struct Definitions {
    generator: SchemaGenerator,
    parts: Map<String, Value>,
}

impl Definitions {
    /// The schema of a value, with words about it.
    fn of<T: schemars::JsonSchema>(&mut self, description: &str) -> Value {
        let mut schema = self.generator.subschema_for::<T>().to_value();
        if let Some(object) = schema.as_object_mut() {
            object.insert("description".into(), description.into());
        }
        schema
    }

    /// A part's parameters in a table with `use` and other `common` keys; the name of the definition.
    fn part(&mut self, part: &Part, common: &Map<String, Value>) -> String {
        let name = format!("{}.{}", part.kind.name(), part.label.name);
        let mut schema = self.own(part, &name);
        if let Some(properties) = schema.get_mut("properties").and_then(Value::as_object_mut) {
            properties.insert("use".into(), used(part));
            for (key, value) in common {
                properties.insert(key.clone(), value.clone());
            }
        }
        if let Some(object) = schema.as_object_mut() {
            object.insert("required".into(), json!(["use"]));
            object.insert("description".into(), part.label.docs.into());
        }
        self.parts.insert(name.clone(), schema);
        name
    }

    /// The schema of a part's parameters alone, its definitions moved to ours.
    fn own(&mut self, part: &Part, name: &str) -> Value {
        let mut schema = (part.schema)().to_value();
        let Some(object) = schema.as_object_mut() else {
            return json!({ "type": "object" });
        };
        object.remove("$schema");
        object.remove("title");
        if let Some(Value::Object(inner)) = object.remove("$defs") {
            for (key, definition) in inner {
                self.parts.insert(format!("{name}.{key}"), definition);
            }
        }
        object.entry("properties").or_insert_with(|| json!({}));
        object.insert("additionalProperties".into(), false.into());
        let prefix = format!("#/$defs/{name}.");
        rename(&mut schema, &prefix);
        for (key, definition) in &mut self.parts {
            if key.starts_with(&format!("{name}.")) {
                rename(definition, &prefix);
            }
        }
        schema
    }
}

/// Points references at the definitions of one part, `#/$defs/X`, to `prefix` followed by `X`.
fn rename(schema: &mut Value, prefix: &str) {
    match schema {
        Value::Object(object) => {
            for (key, value) in object.iter_mut() {
                match value {
                    Value::String(text) if key == "$ref" => {
                        if let Some(name) = text.strip_prefix("#/$defs/")
                            && !text.starts_with(prefix)
                        {
                            *text = format!("{prefix}{name}");
                        }
                    }
                    _ => rename(value, prefix),
                }
            }
        }
        Value::Array(items) => items.iter_mut().for_each(|item| rename(item, prefix)),
        _ => {}
    }
}

fn used(part: &Part) -> Value {
    json!({ "const": part.label.name, "description": part.summary() })
}

/// A table whose `use` names a part of one kind.
fn one_of(all: &mut Definitions, kind: Kind, common: &Map<String, Value>, words: &str) -> Value {
    let names: Vec<String> = of_kind(kind).map(|part| all.part(part, common)).collect();
    let choices: Vec<Value> = names
        .iter()
        .map(|name| json!({ "$ref": format!("#/$defs/{name}") }))
        .collect();
    match choices.is_empty() {
        true => json!({ "type": "object", "description": words }),
        false => json!({ "oneOf": choices, "description": words }),
    }
}

fn entries<const N: usize>(pairs: [(&str, Value); N]) -> Map<String, Value> {
    pairs
        .into_iter()
        .map(|(key, value)| (key.to_owned(), value))
        .collect()
}

fn table(properties: Map<String, Value>, words: &str) -> Value {
    json!({
        "type": "object", "description": words, "properties": properties, "additionalProperties": false,
    })
}

fn sweep() -> Value {
    let number = json!({ "type": ["number", "string"] });
    let count = json!({ "type": "integer", "minimum": 1, "description": "How many draws." });
    let seed = json!({ "type": "integer", "description": "The seed of the draws, 1 unless said." });
    let range = json!({
        "type": "object", "required": ["from", "to"], "additionalProperties": false,
        "properties": { "from": number, "to": number, "step": number },
    });
    let uniform = json!({
        "type": "object", "required": ["uniform"], "additionalProperties": false,
        "properties": {
            "uniform": { "type": "array", "items": number, "minItems": 2, "maxItems": 2 },
            "draws": count, "seed": seed,
        },
    });
    let normal = json!({
        "type": "object", "required": ["normal"], "additionalProperties": false,
        "properties": {
            "normal": {
                "type": "object", "required": ["mean", "sigma"], "additionalProperties": false,
                "properties": { "mean": number, "sigma": number },
            },
            "draws": count, "seed": seed,
        },
    });
    let seeds = json!({
        "description": "So many seeds from run.seed on, or the seeds themselves.",
        "anyOf": [
            { "type": "integer", "minimum": 1 },
            { "type": "array", "items": { "type": "integer" }, "minItems": 1 },
            range, uniform,
        ],
    });
    let vary = json!({
        "type": "object",
        "description": "Keys are paths, as for --set; one run for each combination of their values.",
        "additionalProperties": {
            "anyOf": [{ "type": "array", "minItems": 1 }, range, uniform, normal, { "type": "object" }],
        },
    });
    table(
        entries([("seeds", seeds), ("vary", vary)]),
        "One scenario, many runs: `simbeeotic sweep` runs them all.",
    )
}

fn run(all: &mut Definitions) -> Value {
    let whole = |words: &str| json!({ "type": "integer", "minimum": 1, "description": words });
    let properties = entries([
        (
            "seed",
            json!({ "type": "integer", "default": 1, "description": "The master seed: all draws hang on it. It has 64 bits, with a sign." }),
        ),
        (
            "end_time",
            all.of::<Time>("When the run ends, in virtual time."),
        ),
        (
            "wall_time",
            all.of::<Time>("The run ends after this much time on the wall clock."),
        ),
        (
            "threads",
            whole("Threads that run models; the trace is the same for any number."),
        ),
        (
            "real_time_factor",
            json!({
                "type": "number", "exclusiveMinimum": 0,
                "description": "How many times faster than the wall clock the run may be: 1 is real time.",
            }),
        ),
        (
            "epoch",
            all.of::<Time>("The time of day at the start, from midnight."),
        ),
        (
            "rounds_per_instant",
            whole("Rounds of events without delay that are taken for a loop."),
        ),
        (
            "events_per_instant",
            whole("Events at one time that end the run."),
        ),
        ("pending_events", whole("Events waiting that end the run.")),
    ]);
    let mut section = table(properties, "How long the scenario runs, and how.");
    section["required"] = json!(["end_time"]);
    section
}

fn channel(all: &mut Definitions) -> Value {
    let noise = entries([
        ("mean", all.of::<PowerLevel>("Mean level of the noise.")),
        (
            "sigma",
            all.of::<Decibels>("Its standard deviation, drawn for each reception."),
        ),
    ]);
    let names: Vec<&str> = of_kind(Kind::Medium).map(|part| part.label.name).collect();
    let medium = one_of(
        all,
        Kind::Medium,
        &Map::new(),
        "How faithfully the air is simulated.",
    );
    let fadings: Vec<&str> = of_kind(Kind::Fading).map(|part| part.label.name).collect();
    let fading = one_of(
        all,
        Kind::Fading,
        &Map::new(),
        "What echoes do, drawn for each frame and receiver.",
    );
    let common = entries([
        (
            "shadowing",
            all.of::<ShadowingParams>("What is in the way and not in the map, by chance."),
        ),
        ("fading", json!({ "anyOf": [{ "enum": fadings }, fading] })),
        ("medium", json!({ "anyOf": [{ "enum": names }, medium] })),
        ("noise_floor", table(noise, "The noise at every receiver.")),
        (
            "range_limit",
            all.of::<Length>("Frames reach no further than this."),
        ),
        (
            "walls",
            json!({ "type": "boolean", "default": false, "description": "Whether walls and bodies in the line of sight take their share of the power." }),
        ),
    ]);
    let mut section = one_of(
        all,
        Kind::Propagation,
        &common,
        "The air that radios share.",
    );
    // Without `use` it is free space, and there are the common keys alone.
    if let Some(choices) = section.get_mut("oneOf").and_then(Value::as_array_mut) {
        choices.push(table(common, "Free space."));
    }
    section
}

fn world(all: &mut Definitions) -> Value {
    let inline = all.generator.subschema_for::<World>().to_value();
    let rule = one_of(
        all,
        Kind::Generator,
        &Map::new(),
        "A rule that makes the world.",
    );
    json!({
        "description": "What stands in the world: the name of a world file, the world itself, or a rule that makes it.",
        "anyOf": [
            { "type": "string" },
            inline,
            {
                "type": "object",
                "properties": { "generate": { "anyOf": [{ "type": "string" }, rule] } },
                "required": ["generate"],
            },
        ],
    })
}

fn physics(all: &mut Definitions) -> Value {
    let mut schema = all.generator.root_schema_for::<PhysicsParams>().to_value();
    if let Some(object) = schema.as_object_mut() {
        for key in ["$schema", "$defs", "title"] {
            object.remove(key);
        }
    }
    schema
}

fn record(all: &mut Definitions) -> Value {
    match simbeeotic_model::registry::find(Kind::Component, "recorder") {
        Some(part) => {
            let mut schema = all.own(part, "record");
            schema["description"] = "The recorder, by a shorter name.".into();
            schema
        }
        None => json!({ "type": "object" }),
    }
}

fn component(all: &mut Definitions) -> Value {
    let items = one_of(all, Kind::Component, &Map::new(), "One who watches.");
    json!({ "type": "array", "description": "Who watches; nobody of them changes the run.", "items": items })
}

fn mount(all: &mut Definitions) -> Value {
    let properties = entries([
        (
            "position",
            all.of::<Offset>("From the body's centre: forward, left, up."),
        ),
        (
            "attitude",
            all.of::<Attitude>("How it is turned in the body's frame."),
        ),
        (
            "pointing",
            json!({
                "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3,
                "description": "The direction it looks in, in the body's frame, instead of an attitude.",
            }),
        ),
    ]);
    table(properties, "Where it sits on the body, and where it looks.")
}

/// The keys of every sensor that say when it is read, and what it draws.
fn sampling(all: &mut Definitions) -> Map<String, Value> {
    entries([
        (
            "rate",
            all.of::<Frequency>("How often it measures by itself; without it, when it is read."),
        ),
        (
            "phase",
            json!({
                "type": "string",
                "description": "When it measures first: `aligned` (at the start), `random` (some time in the first period), or a time."
            }),
        ),
        (
            "delay",
            all.of::<Time>("From the measurement to its arrival. 0 unless said."),
        ),
        (
            "dropout",
            json!({
                "type": "number", "minimum": 0, "maximum": 1,
                "description": "Probability that a measurement is lost. 0 unless said."
            }),
        ),
        (
            "current",
            all.of::<Current>("What it draws while it is on; unless said, what its kind does."),
        ),
        (
            "on_time",
            all.of::<Time>(
                "How long it is on for each sample; always unless said. Needs a `rate`.",
            ),
        ),
    ])
}

fn model(all: &mut Definitions) -> Value {
    let mounted = entries([("mount", mount(all))]);
    let mut sampled = mounted.clone();
    sampled.extend(sampling(all));
    let sensor = one_of(all, Kind::Sensor, &sampled, "A sensor.");
    let antenna = one_of(all, Kind::Antenna, &Map::new(), "An antenna pattern.");
    let mut aerial = mounted;
    aerial.insert(
        "antenna".into(),
        json!({ "anyOf": [{ "type": "string" }, antenna] }),
    );
    aerial.insert(
        "queue_frames".into(),
        json!({ "type": "integer", "minimum": 1, "maximum": QUEUE_FRAMES_MAX, "default": 100, "description": "How many packets may wait to be sent, where the medium makes them wait." }),
    );
    let radios: Vec<&str> = of_kind(Kind::Radio).map(|part| part.label.name).collect();
    let radio = one_of(all, Kind::Radio, &aerial, "A radio.");
    let vehicle = one_of(
        all,
        Kind::Vehicle,
        &Map::new(),
        "The vehicle that it flies.",
    );
    // The usual vehicle needs no name: its parameters may stand alone.
    let usual = format!("{}.{DEFAULT_VEHICLE}", Kind::Vehicle.name());
    if let Some(usual) = all.parts.get_mut(&usual).and_then(Value::as_object_mut) {
        usual.remove("required");
    }
    let battery = all.of::<BatteryParams>("What it runs on. Without it nothing runs out.");
    let by_name = |items: &Value| json!({ "type": "object", "additionalProperties": items });
    let common = |params: Value, used: Value| {
        let properties = entries([
            ("use", used),
            (
                "name",
                json!({ "type": "string", "description": "What it is called; the part's name if left out." }),
            ),
            (
                "count",
                json!({ "type": "integer", "minimum": 0, "default": 1, "description": "How many there are." }),
            ),
            ("start", json!({ "$ref": "#/$defs/start" })),
            ("params", params),
            (
                "vehicle",
                json!({ "anyOf": [{ "type": "string" }, vehicle] }),
            ),
            ("sensor", by_name(&sensor)),
            (
                "radio",
                json!({ "anyOf": [{ "enum": radios }, radio, by_name(&radio)] }),
            ),
            (
                "battery",
                json!({ "anyOf": [{ "type": "string" }, battery] }),
            ),
            (
                "model",
                json!({ "type": "array", "items": { "$ref": "#/$defs/model" } }),
            ),
        ]);
        let mut section = table(properties, "Models of one kind.");
        section["required"] = json!(["use"]);
        section
    };
    let parts: Vec<&Part> = of_kind(Kind::Model).collect();
    let mut choices = vec![like(&battery)];
    for part in parts {
        let params = all.own(part, &format!("model.{}", part.label.name));
        choices.push(common(params, used(part)));
    }
    json!({ "oneOf": choices })
}

/// A model like one before it: what it does not say hangs on that one, so that its gear needs no `use`.
fn like(battery: &Value) -> Value {
    let part = |words: &str| json!({ "type": ["string", "object"], "description": words });
    let text = |words: &str| json!({ "type": "string", "description": words });
    let properties = entries([
        (
            crate::like::KEY,
            text(
                "The name of a model before it: this one is the same, but for what it says itself.",
            ),
        ),
        ("use", text("The behaviour, if it is another.")),
        ("name", text("What it is called.")),
        (
            "count",
            json!({ "type": "integer", "minimum": 0, "default": 1, "description": "How many there are." }),
        ),
        ("start", json!({ "$ref": "#/$defs/start" })),
        ("params", json!({ "type": "object" })),
        ("vehicle", part("The vehicle, or what is other of it.")),
        (
            "sensor",
            json!({ "type": "object", "additionalProperties": { "type": "object" } }),
        ),
        ("radio", part("The radio, or what is other of it.")),
        (
            "battery",
            json!({ "anyOf": [{ "type": "string" }, battery] }),
        ),
        (
            "model",
            json!({ "type": "array", "items": { "$ref": "#/$defs/model" } }),
        ),
    ]);
    let mut section = table(properties, "Models like others.");
    section["required"] = json!([crate::like::KEY]);
    section
}

fn start(all: &mut Definitions) -> Value {
    let turned = |value: Value| json!({ "anyOf": [{ "const": "random" }, value] });
    let turns = entries([
        ("yaw", turned(all.of::<Yaw>("Counter-clockwise from east."))),
        (
            "heading",
            turned(all.of::<Heading>("Clockwise from north.")),
        ),
    ]);
    let point = all.of::<Position>("East, north, up.");
    let length = all.of::<Length>("A length.");
    let cells = json!({ "type": "array", "items": { "type": "integer", "minimum": 1 }, "minItems": 3, "maxItems": 3 });
    let form = |words: &str, first: &str, keys: Vec<(&str, Value)>| {
        let mut properties = turns.clone();
        properties.extend(keys.into_iter().map(|(key, value)| (key.to_owned(), value)));
        let mut section = table(properties, words);
        section["required"] = json!([first]);
        section
    };
    json!({
        "description": "Where they start.",
        "anyOf": [
            point.clone(),
            form("There.", "point", vec![("point", point.clone())]),
            form("Anywhere in a box.", "box", vec![("box", point.clone()), ("from", point.clone())]),
            form("Anywhere in a ball, above the ground.", "ball", vec![("ball", length.clone()), ("center", point.clone())]),
            form("On a grid, x first.", "grid", vec![
                ("grid", cells), ("spacing", json!({ "anyOf": [length, point.clone()] })), ("from", point.clone()),
            ]),
            form("Each at its own point.", "list", vec![("list", json!({ "type": "array", "items": point }))]),
            form("Each at its own line of a file: x, y, z in metres.", "file", vec![("file", json!({ "type": "string" }))]),
            form("In an area of the world, a `[[spawn]]` of this name.", "area", vec![("area", json!({ "type": "string" }))]),
        ],
    })
}
