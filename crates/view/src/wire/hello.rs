//! The first message: the run, who flies, and the world that stands around them.

use super::{Message, PROTOCOL};
use serde::Serialize;
use serde_json::{Map, Value, json};
use simbeeotic_record::Vehicle;
use simbeeotic_record::stage::{Form, Piece, Stage};
use std::collections::BTreeMap;

/// Whether a run is looked at, or a recording of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Mode {
    /// As it happens.
    Live,
    /// Afterwards.
    Replay,
}

/// What a recording holds.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Replayed {
    /// Its first tick, s.
    pub from_s: f64,
    /// Its end, s.
    pub to_s: f64,
    /// The times of its ticks, s.
    pub ticks_s: Vec<f64>,
    /// The least time between two of them, s; 0 if there are less than two.
    pub period_s: f64,
}

/// What a run is called, and where it comes from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facts {
    /// Its scenario's name.
    pub name: String,
    /// Its seed, as scenarios have it.
    pub seed: String,
    /// The version of the program that runs it, or ran it.
    pub version: String,
    /// When it ends, s.
    pub end_s: Option<f64>,
    /// Whether its recording was cut off.
    pub truncated: bool,
}

/// The first message to a page.
#[derive(Clone, Debug)]
pub struct Hello<'a> {
    /// What is looked at.
    pub mode: Mode,
    /// Its name and origin.
    pub facts: &'a Facts,
    /// Who flies.
    pub vehicles: &'a [Vehicle],
    /// What stands around them.
    pub stage: &'a Stage,
    /// Of a recording: its times.
    pub replay: Option<&'a Replayed>,
}

impl Hello<'_> {
    /// As it goes to the page.
    pub fn message(&self) -> Message {
        let mut forms = Forms::default();
        let looks: Vec<usize> = self
            .vehicles
            .iter()
            .map(|vehicle| forms.look(vehicle))
            .collect();
        let props: Vec<Value> = (self.stage.props.iter())
            .map(|prop| {
                let meta = prop.meta.iter();
                let meta: Map<String, Value> = meta
                    .map(|(key, value)| (key.clone(), value.clone().into()))
                    .collect();
                json!({ "kind": prop.kind, "label": prop.label, "color": colour(prop.color),
                    "texture": prop.texture, "pieces": forms.pieces(&prop.pieces), "meta": meta })
            })
            .collect();
        let of = |what: fn(&Vehicle) -> Value| self.vehicles.iter().map(what).collect::<Value>();
        let mut hello = json!({
            "type": "hello",
            "protocol": PROTOCOL,
            "mode": self.mode,
            "name": self.facts.name,
            "seed": self.facts.seed,
            "version": self.facts.version,
            "end_s": self.facts.end_s,
            "truncated": self.facts.truncated,
            "vehicles": {
                "paths": of(|v| v.path.clone().into()),
                "kinds": of(|v| v.kind.clone().into()),
                "roles": of(|v| v.role.clone().into()),
                "radii_m": of(|v| v.radius_m.into()),
                "colors": of(|v| colour(seen(v.color)).into()),
                "looks": looks,
            },
            "stage": { "ground": colour(self.stage.ground), "texture": self.stage.texture, "plane": self.stage.plane,
                "radius_m": self.stage.radius_m, "props": props },
        });
        if let Some(table) = hello.as_object_mut() {
            let look = |pieces: Value| json!({ "pieces": pieces });
            let looks: Vec<Value> = forms.looks.drain(..).map(look).collect();
            table.insert("looks".to_owned(), looks.into());
            table.insert("forms".to_owned(), forms.forms.into());
            if let Some(replay) = self.replay {
                let replay = serde_json::to_value(replay).unwrap_or_default();
                table.insert("replay".to_owned(), replay);
            }
        }
        Message::Text(hello.to_string().into())
    }
}

/// Forms and looks, each once.
#[derive(Debug, Default)]
pub struct Forms {
    forms: Vec<Value>,
    known: BTreeMap<Vec<u64>, usize>,
    looks: Vec<Value>,
    known_looks: BTreeMap<Vec<u64>, usize>,
}

impl Forms {
    /// The number of a vehicle's look. One whose shape is not known is a ball.
    fn look(&mut self, vehicle: &Vehicle) -> usize {
        let ball;
        let pieces: &[Piece] = if vehicle.pieces.is_empty() {
            let radius_m = vehicle.radius_m;
            ball = [Piece::at_origin(Form::Sphere { radius_m })];
            &ball
        } else {
            &vehicle.pieces
        };
        let key: Vec<u64> = pieces.iter().flat_map(|piece| self.key_of(piece)).collect();
        if let Some(known) = self.known_looks.get(&key) {
            return *known;
        }
        let value = self.pieces(pieces);
        self.looks.push(value);
        self.known_looks.insert(key, self.looks.len() - 1);
        self.looks.len() - 1
    }

    fn key_of(&mut self, piece: &Piece) -> Vec<u64> {
        let form = self.form(&piece.form) as u64;
        let place = piece.position_m.iter().chain(&piece.attitude);
        std::iter::once(form)
            .chain(place.map(|number| number.to_bits()))
            .collect()
    }

    fn pieces(&mut self, pieces: &[Piece]) -> Value {
        let piece = |piece: &Piece| json!({ "form": self.form(&piece.form), "at": piece.position_m, "turn": piece.attitude });
        pieces.iter().map(piece).collect()
    }

    /// The number of a form.
    fn form(&mut self, form: &Form) -> usize {
        let key = key(form);
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        self.forms.push(as_json(form));
        self.known.insert(key, self.forms.len() - 1);
        self.forms.len() - 1
    }
}

/// Equal for equal forms alone.
fn key(form: &Form) -> Vec<u64> {
    let bits = |kind: u64, numbers: &[f64]| {
        let numbers = numbers.iter().map(|number| number.to_bits());
        std::iter::once(kind).chain(numbers).collect()
    };
    match form {
        Form::Box { half_m } => bits(0, half_m),
        Form::Sphere { radius_m } => bits(1, &[*radius_m]),
        Form::Cylinder {
            radius_m,
            top_m,
            half_height_m,
        } => bits(2, &[*radius_m, *top_m, *half_height_m]),
        Form::Capsule {
            radius_m,
            half_height_m,
        } => bits(3, &[*radius_m, *half_height_m]),
        Form::Mesh {
            points_m,
            triangles,
        } => {
            let points = points_m.iter().flatten().map(|p| u64::from(p.to_bits()));
            let corners = triangles.iter().flatten().map(|corner| u64::from(*corner));
            [4, points_m.len() as u64]
                .into_iter()
                .chain(points)
                .chain(corners)
                .collect()
        }
    }
}

fn as_json(form: &Form) -> Value {
    match form {
        Form::Box { half_m } => json!({ "box": half_m }),
        Form::Sphere { radius_m } => json!({ "sphere": radius_m }),
        Form::Cylinder {
            radius_m,
            top_m,
            half_height_m,
        } => json!({ "cylinder": [radius_m, top_m, half_height_m] }),
        Form::Capsule {
            radius_m,
            half_height_m,
        } => json!({ "capsule": [radius_m, half_height_m] }),
        Form::Mesh {
            points_m,
            triangles,
        } => {
            let points: Vec<f32> = points_m.iter().flatten().copied().collect();
            let corners: Vec<u32> = triangles.iter().flatten().copied().collect();
            json!({ "mesh": { "points": points, "triangles": corners } })
        }
    }
}

/// The colour of a vehicle whose colour is not known is a bee's.
fn seen(color: [u8; 4]) -> [u8; 4] {
    match color {
        [0, 0, 0, 0] => [0xf0, 0xb2, 0x1e, 0xff],
        color => color,
    }
}

/// As CSS has it: `#rrggbb`, and two digits more for what is not opaque.
fn colour([red, green, blue, alpha]: [u8; 4]) -> String {
    match alpha {
        255 => format!("#{red:02x}{green:02x}{blue:02x}"),
        _ => format!("#{red:02x}{green:02x}{blue:02x}{alpha:02x}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::stage::Prop;

    #[test]
    fn equal_forms_and_looks_occur_once() {
        let ball = Piece::at_origin(Form::Sphere { radius_m: 0.25 });
        let mesh = || {
            Piece::at_origin(Form::Mesh {
                points_m: [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].into(),
                triangles: [[0, 1, 2]].into(),
            })
        };
        let vehicle = |path: &str, pieces: Vec<Piece>| Vehicle {
            path: path.to_owned(),
            kind: "bee".to_owned(),
            radius_m: 0.25,
            role: "vehicle".to_owned(),
            color: [255, 0, 16, 128],
            pieces: pieces.into(),
        };
        let vehicles = [
            vehicle("a", vec![ball.clone()]),
            vehicle("b", vec![ball.clone(), mesh()]),
            vehicle("c", vec![ball.clone(), mesh()]),
            vehicle("d", Vec::new()),
        ];
        let stage = Stage {
            ground: [1, 2, 3, 255],
            texture: "grass".to_owned(),
            radius_m: 100.0,
            plane: true,
            props: vec![Prop {
                kind: "obstacle".to_owned(),
                color: [0, 0, 0, 255],
                pieces: vec![mesh()],
                meta: vec![("a".to_owned(), "b".to_owned())],
                ..Prop::default()
            }],
        };
        let facts = Facts {
            name: "four".to_owned(),
            seed: "1".to_owned(),
            version: "0.1.0".to_owned(),
            end_s: None,
            truncated: false,
        };
        let hello = Hello {
            mode: Mode::Live,
            facts: &facts,
            vehicles: &vehicles,
            stage: &stage,
            replay: None,
        };
        let value: Value = serde_json::from_slice(hello.message().bytes()).expect("it is JSON");
        let at_origin = |form: u32| json!({ "form": form, "at": [0.0, 0.0, 0.0], "turn": [1.0, 0.0, 0.0, 0.0] });
        let expected = json!({
            "type": "hello", "protocol": 1, "mode": "live", "name": "four", "seed": "1",
            "version": "0.1.0", "end_s": null, "truncated": false,
            "vehicles": { "paths": ["a", "b", "c", "d"], "kinds": ["bee", "bee", "bee", "bee"],
                "roles": ["vehicle", "vehicle", "vehicle", "vehicle"],
                "radii_m": [0.25, 0.25, 0.25, 0.25],
                "colors": ["#ff001080", "#ff001080", "#ff001080", "#ff001080"],
                "looks": [0, 1, 1, 0] },
            "looks": [{ "pieces": [at_origin(0)] }, { "pieces": [at_origin(0), at_origin(1)] }],
            "forms": [{ "sphere": 0.25 },
                { "mesh": { "points": [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0],
                    "triangles": [0, 1, 2] } }],
            "stage": { "ground": "#010203", "texture": "grass", "plane": true, "radius_m": 100.0, "props": [
                { "kind": "obstacle", "label": "", "color": "#000000", "texture": "",
                    "pieces": [at_origin(1)], "meta": { "a": "b" } }] },
        });
        assert_eq!(value, expected);
    }
}
