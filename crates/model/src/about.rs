//! What there is to tell people about one model: for inspectors and recordings.

use crate::view::View;
use serde::Serialize;
use simbeeotic_kernel::ModelId;
use simbeeotic_radio::RadioId;
use simbeeotic_units::Mount;

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
    /// Single rays. A reading with as many rows as there are rays has their lengths in its first column
    /// of metres.
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

impl View<'_> {
    /// What a model is, as far as it stays the same for the whole run.
    pub fn about(&self, id: ModelId) -> About {
        let Some(gear) = self.swarm.gear.get(id.index()) else {
            return About::default();
        };
        let sensors = gear.sensors.iter().map(|sensor| AboutSensor {
            name: sensor.name.clone(),
            mount: sensor.mount,
            beams: None,
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
            parts: Vec::new(),
            sensors: sensors.collect(),
            radios: radios.collect(),
        }
    }
}
