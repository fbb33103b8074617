//! What there is to tell people about one model: for inspectors and recordings.

use crate::config::{Key, Node, Value};
use crate::energy::BatteryParams;
use crate::registry::{Part, complete};
use crate::view::View;
use serde::Serialize;
use simbeeotic_kernel::ModelId;
use simbeeotic_radio::RadioId;
use simbeeotic_units::{Angle, Length, Mount};
use std::f64::consts::PI;

/// What a model is, as far as it stays the same for the whole run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// The parts it is made of, each with its parameters: the model itself first, then its vehicle, its
    /// battery, its radios' and sensors' parts.
    pub parts: Vec<AboutPart>,
    /// Its sensors, in the scenario's order.
    pub sensors: Vec<AboutSensor>,
    /// Its radios, in the scenario's order.
    pub radios: Vec<AboutRadio>,
}

/// One part of a model, as the scenario has it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct AboutPart {
    /// What it is to the model: `model`, `vehicle`, `battery`, `sensor.compass`, `radio`.
    pub place: String,
    /// The part's name on the shelf: `random-walk-bee`.
    pub name: String,
    /// All parameters and their values as a scenario would have them, defaults included:
    /// `("max_speed", "2 m/s")`.
    pub parameters: Vec<(String, String)>,
}

/// One sensor of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AboutSensor {
    /// Its name on board: `compass`.
    pub name: String,
    /// Where it sits, and which way it looks.
    pub mount: Mount,
    /// What it looks along, if it looks anywhere.
    pub beams: Option<Beams>,
}

/// One radio of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct AboutRadio {
    /// Its name on board: `radio`.
    pub name: String,
    /// Its number in the medium; `None` if there is no medium.
    pub id: Option<RadioId>,
}

/// Where a sensor looks, in its own frame (FLU: `x` is the line of sight).
#[derive(Clone, Debug, PartialEq)]
pub enum Beams {
    /// Single rays, at most [`RAYS_MAX`](Self::RAYS_MAX). A reading with as many rows as there are rays
    /// has their lengths in its first column of metres.
    Rays {
        /// Unit vectors.
        directions: Vec<[f64; 3]>,
        /// How far they reach, m.
        range_m: f64,
    },
    /// All within an angle of the line of sight.
    Cone {
        /// The angle between axis and edge, rad.
        half_angle_rad: f64,
        /// How far it reaches, m.
        range_m: f64,
    },
    /// All that a picture shows.
    Frustum {
        /// The whole angle from left to right, rad.
        horizontal_rad: f64,
        /// The whole angle from bottom to top, rad.
        vertical_rad: f64,
        /// How far it reaches, m.
        range_m: f64,
    },
    /// All around, to a distance.
    Ball {
        /// How far it reaches, m.
        range_m: f64,
    },
}

impl Beams {
    /// What looks along more rays than this is told as the space that they fill.
    pub const RAYS_MAX: usize = 2048;

    /// One ray along the line of sight.
    pub fn ahead(range: Length) -> Self {
        Self::Rays {
            directions: vec![[1.0, 0.0, 0.0]],
            range_m: range.get(),
        }
    }

    /// All within an angle of the line of sight: one ray if that is zero, a ball from half a turn on.
    pub fn cone(half_angle: Angle, range: Length) -> Self {
        let range_m = range.get();
        match half_angle.get() {
            none if none <= 0.0 => Self::ahead(range),
            all if all >= PI => Self::Ball { range_m },
            half_angle_rad => Self::Cone {
                half_angle_rad,
                range_m,
            },
        }
    }

    /// All within so much from left to right, and from bottom to top. What is wider than a picture can
    /// show is a ball.
    pub fn window(horizontal: Angle, vertical: Angle, range: Length) -> Self {
        let range_m = range.get();
        let widest = Angle::from_degrees(170.0);
        match horizontal.max(vertical) > widest {
            true => Self::Ball { range_m },
            false => Self::Frustum {
                horizontal_rad: horizontal.get(),
                vertical_rad: vertical.get(),
                range_m,
            },
        }
    }
}

/// A part of a model as its section of the scenario has it: what an [`AboutPart`] is made from when
/// somebody asks. All models of a section share one.
#[derive(Clone, Debug)]
pub struct PlannedPart {
    place: String,
    name: String,
    /// Keys that are not the part's own: a sensor's rate, say.
    around: Vec<(Key, Node)>,
    written: Node,
    complete: fn(&Node) -> Option<Node>,
}

impl PlannedPart {
    /// The part in this place (see [`AboutPart::place`]), with its own parameters as they were written.
    pub fn new(place: impl Into<String>, part: &Part, written: &Node) -> Self {
        Self {
            place: place.into(),
            name: part.label.name.to_owned(),
            around: Vec::new(),
            written: written.clone(),
            complete: part.complete,
        }
    }

    /// The table `[model.battery]`.
    pub fn battery(written: &Node) -> Self {
        Self {
            place: "battery".to_owned(),
            name: "battery".to_owned(),
            around: Vec::new(),
            written: written.clone(),
            complete: complete::<BatteryParams>,
        }
    }

    /// With keys that stand beside its own, if they were written: a sensor's rate, say.
    #[must_use]
    pub fn with(mut self, around: impl IntoIterator<Item = (Key, Node)>) -> Self {
        self.around.extend(around);
        self
    }

    fn about(&self) -> AboutPart {
        let mut parameters = Vec::new();
        let complete = (self.complete)(&self.written);
        let complete = complete.as_ref().and_then(Node::as_table);
        for (key, node) in complete.map_or(&[][..], |table| &table.entries) {
            let written = self.written.as_table().and_then(|t| t.get(&key.text));
            let value = match written.map(|node| &node.value) {
                // In the unit that the user has chosen.
                Some(Value::String(text)) => text.clone(),
                _ => text_of(node),
            };
            parameters.push((key.text.clone(), value));
        }
        let around = self.around.iter();
        parameters.extend(around.map(|(key, node)| (key.text.clone(), text_of(node))));
        AboutPart {
            place: self.place.clone(),
            name: self.name.clone(),
            parameters,
        }
    }
}

/// A value for people: as in a scenario, without quotes, in few digits.
fn text_of(node: &Node) -> String {
    match &node.value {
        Value::String(text) => brief(text),
        Value::Integer(number) => number.to_string(),
        Value::Float(number) => short(*number),
        Value::Bool(flag) => flag.to_string(),
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(text_of).collect();
            format!("[{}]", items.join(", "))
        }
        Value::Table(table) => {
            let entries = table.entries.iter();
            let entries: Vec<String> = entries
                .map(|(key, node)| format!("{} = {}", key.text, text_of(node)))
                .collect();
            format!("{{ {} }}", entries.join(", "))
        }
    }
}

/// A quantity in at most six digits, an angle in degrees if that is shorter; other text as it is.
fn brief(text: &str) -> String {
    let Some((number, unit)) = text.split_once(' ') else {
        return text.to_owned();
    };
    let Ok(value) = number.parse::<f64>() else {
        return text.to_owned();
    };
    let plain = format!("{} {unit}", short(value));
    let in_degrees = match unit {
        "rad" => "deg",
        "rad/s" => "deg/s",
        _ => return plain,
    };
    let degrees = format!("{} {in_degrees}", short(value.to_degrees()));
    match degrees.len() < plain.len() {
        true => degrees,
        false => plain,
    }
}

/// Six digits, fewer if they say the same; an exponent for what is very large or small.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    match rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs()) {
        true => rounded.to_string(),
        false => format!("{rounded:e}"),
    }
}

impl View<'_> {
    /// A number that models of one section of the scenario share: what they are made of is the same, so that one
    /// need be asked for all. It means nothing else, and differs from run to run.
    pub fn section(&self, id: ModelId) -> Option<usize> {
        let gear = self.swarm.gear.get(id.index())?;
        Some(std::sync::Arc::as_ptr(gear).addr())
    }

    /// What a model is, as far as it stays the same for the whole run. Worked out anew at each call, from
    /// what its section of the scenario says; a run that was put together without a scenario has no parts.
    pub fn about(&self, id: ModelId) -> About {
        let Some(gear) = self.swarm.gear.get(id.index()) else {
            return About::default();
        };
        let sensors = gear.sensors.iter().map(|sensor| AboutSensor {
            name: sensor.name.clone(),
            mount: sensor.mount,
            beams: sensor.factory.beams(),
        });
        let ids = self.agents.get(id.index()).map(|agent| &agent.core.radios);
        let radios = gear
            .radios
            .iter()
            .enumerate()
            .map(|(at, radio)| AboutRadio {
                name: radio.name.clone(),
                id: ids.and_then(|ids| ids.get(at)).copied(),
            });
        About {
            parts: gear.parts.iter().map(PlannedPart::about).collect(),
            sensors: sensors.collect(),
            radios: radios.collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_short_and_angles_in_the_shorter_unit() {
        for (text, want) in [
            ("2.0943951023931953 rad", "120 deg"),
            ("0.017453292519943295 rad/s", "1 deg/s"),
            ("1 rad", "1 rad"),
            ("0 rad", "0 rad"),
            ("2 m/s", "2 m/s"),
            ("0.30000000000000004 m", "0.3 m"),
            ("2405000000 Hz", "2.405e9 Hz"),
            ("1e-9 s", "1e-9 s"),
            ("123456.7 m", "123457 m"),
            ("nearest", "nearest"),
            ("a bee of 3 stripes", "a bee of 3 stripes"),
            ("", ""),
        ] {
            assert_eq!(brief(text), want);
        }
    }

    #[test]
    fn beams_take_the_shape_of_what_they_fill() {
        let range = Length::si(2.0);
        let cone = |degrees| Beams::cone(Angle::from_degrees(degrees), range);
        assert_eq!(cone(0.0), Beams::ahead(range));
        assert!(
            matches!(cone(30.0), Beams::Cone { half_angle_rad, range_m: 2.0 }
            if (half_angle_rad - PI / 6.0).abs() < 1e-15)
        );
        assert_eq!(cone(180.0), Beams::Ball { range_m: 2.0 });
        let window = |a, b| Beams::window(Angle::from_degrees(a), Angle::from_degrees(b), range);
        assert!(matches!(
            window(90.0, 60.0),
            Beams::Frustum { range_m: 2.0, .. }
        ));
        assert_eq!(window(360.0, 60.0), Beams::Ball { range_m: 2.0 });
    }
}
