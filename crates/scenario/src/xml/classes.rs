//! What the original's Java classes and their properties are called here, and in which units they
//! were counted.
//!
//! A row is a class, its kind, the part that does its work here, and its properties. Whether that
//! part exists yet is the shelf's to say, not this table's.

use simbeeotic_model::registry::{self, Kind, Part};

/// Where all of the original's classes lived.
pub(super) const PACKAGE: &str = "harvard.robobees.simbeeotic.";

/// One class.
pub(super) struct Class {
    /// Its name below [`PACKAGE`].
    pub(super) java: &'static str,
    /// What it was used as. Propagation and weather stood among the models.
    pub(super) kind: Kind,
    /// The part that does its work here.
    pub(super) part: &'static str,
    /// The vehicle that it was as well, if it was one.
    pub(super) vehicle: Option<&'static str>,
    /// Its properties, inherited ones in groups of their own.
    pub(super) properties: &'static [&'static [Property]],
    /// What the original did wrong and is right here.
    pub(super) note: Option<&'static str>,
}

/// One property of a class.
pub(super) struct Property {
    /// Its name.
    pub(super) name: &'static str,
    /// What becomes of it.
    pub(super) to: To,
}

/// What becomes of a property.
pub(super) enum To {
    /// It is a parameter of the part: key, and how to read the value.
    Param(&'static str, As),
    /// It is a parameter of the vehicle.
    Vehicle(&'static str, As),
    /// It is one of three components of a parameter of the part.
    Component(&'static str, usize, &'static str),
    /// Whether the start is random.
    RandomStart,
    /// How far the random start reaches.
    RandomStartBound,
    /// It has no counterpart; why.
    Gone(&'static str),
}

/// How the text of a property becomes a value.
pub(super) enum As {
    /// A number, counted in this unit.
    Unit(&'static str),
    /// A whole number.
    Whole,
    /// A number without a unit.
    Number,
    /// `true` or `false`.
    Flag,
    /// Text.
    Text,
}

impl Class {
    /// The property called `name`.
    pub(super) fn property(&self, name: &str) -> Option<&'static Property> {
        self.properties
            .iter()
            .flat_map(|group| group.iter())
            .find(|p| p.name == name)
    }

    /// The names of all its properties.
    pub(super) fn property_names(&self) -> Vec<&'static str> {
        self.properties
            .iter()
            .flat_map(|group| group.iter())
            .map(|p| p.name)
            .collect()
    }
}

/// The class of this full name.
pub(super) fn find(java: &str) -> Option<&'static Class> {
    let name = java.strip_prefix(PACKAGE)?;
    CLASSES.iter().find(|c| c.java == name)
}

/// The part that does a class's work, if there is one yet.
pub(super) fn find_part(class: &Class) -> Option<&'static Part> {
    registry::find(class.kind, &format!("{PACKAGE}{}", class.java))
        .or_else(|| registry::find(class.kind, class.part))
}

/// The full names of all classes of these kinds.
pub(super) fn names(kinds: &[Kind]) -> Vec<String> {
    let of = CLASSES.iter().filter(|c| kinds.contains(&c.kind));
    of.map(|c| format!("{PACKAGE}{}", c.java)).collect()
}

const fn set(name: &'static str, key: &'static str, unit: &'static str) -> Property {
    Property {
        name,
        to: To::Param(key, As::Unit(unit)),
    }
}

const fn param(name: &'static str, key: &'static str, how: As) -> Property {
    Property {
        name,
        to: To::Param(key, how),
    }
}

const fn vehicle(name: &'static str, key: &'static str, unit: &'static str) -> Property {
    Property {
        name,
        to: To::Vehicle(key, As::Unit(unit)),
    }
}

const fn gone(name: &'static str, why: &'static str) -> Property {
    Property {
        name,
        to: To::Gone(why),
    }
}

const BEE: &[Property] = &[
    vehicle("length", "length", "m"),
    vehicle("mass", "mass", "kg"),
    vehicle("max-acceleration", "max_acceleration", "m/s^2"),
    vehicle("kinematic-update-rate", "control_period", "ms"),
    vehicle("hover-energy", "hover_current", "mA"),
    vehicle("actuation-energy", "actuation_current", "mA"),
    vehicle("actuation-error-turn-var", "turn_sigma", "rad"),
    vehicle("actuation-error-dir-var", "direction_sigma", "rad"),
    Property {
        name: "actuation-error-vel-var",
        to: To::Vehicle("speed_sigma", As::Number),
    },
    Property {
        name: "use-wind",
        to: To::Vehicle("use_wind", As::Flag),
    },
    Property {
        name: "allow-bee-collisions",
        to: To::Vehicle("bee_collisions", As::Flag),
    },
    Property {
        name: "use-random-start",
        to: To::RandomStart,
    },
    Property {
        name: "random-start-bound",
        to: To::RandomStartBound,
    },
];

const WALK: &[Property] = &[
    set("max-vel", "max_speed", "m/s"),
    set("vel-sigma", "velocity_sigma", "m/s"),
    set("heading-sigma", "heading_sigma", "rad"),
];

const INSTRUMENT: &[Property] = &[
    set("sensor-timeout", "sensor_period", "ms"),
    set("radio-timeout", "radio_period", "ms"),
    param("use-radio", "use_radio", As::Flag),
];

const PROPAGATION: &[Property] = &[
    set("noise-floor-mean", "noise_floor.mean", "dBm"),
    set("noise-floor-sigma", "noise_floor.sigma", "dB"),
    set("range-thresh", "range_limit", "m"),
];

const WIND: &[Property] = &[
    Property {
        name: "wind-x",
        to: To::Component("wind", 0, "m/s"),
    },
    Property {
        name: "wind-y",
        to: To::Component("wind", 1, "m/s"),
    },
    Property {
        name: "wind-z",
        to: To::Component("wind", 2, "m/s"),
    },
];

/// What stands beside a radio's own parameters. The original's antennas stood along the body's z axis,
/// and `rotation` turned them about it.
const RADIO: &[Property] = &[
    set("rotation", "mount.attitude.yaw", "rad"),
    param("send-queue-size", "queue_frames", As::Whole),
];

const ZIGBEE: &[Property] = &[
    param("channel", "channel", As::Whole),
    param("tx-power-level", "tx_level", As::Whole),
];

const PLAIN_RADIO: &[Property] = &[
    set("center-frequency", "center_frequency", "MHz"),
    set("channel-bandwidth", "channel_bandwidth", "MHz"),
    set("max-power", "tx_power", "dBm"),
    set("snr-margin", "snr_margin", "dB"),
    set("tx-energy", "tx_current", "mA"),
    set("rx-energy", "rx_current", "mA"),
    set("idle-energy", "idle_current", "mA"),
    set("bandwidth", "data_rate", "kbit/s"),
];

const FLOW: &[Property] = &[
    set("sigma", "sigma", "rad/s"),
    set("min-range", "min_range", "m"),
    set("max-range", "max_range", "m"),
];

const CONE: &[Property] = &[
    set("max-range", "max_range", "m"),
    set("half-angle", "half_angle", "rad"),
];

const VIEWER: &[Property] = &[
    gone(
        "use-background",
        "the page has a sky that goes with its theme",
    ),
    gone("show-controls", "the page has its own controls"),
    gone("testbed-overhead-view", "views are chosen in the page"),
    gone("testbed-angle-view", "views are chosen in the page"),
    gone("second-screen", "the page opens where you open it"),
];

const WAVELENGTH: &str = "the original's wavelength was ten times too short, 20 dB too much loss at \
                          every distance; here it is right";
const COMPASS: &str = "the original's compass took east for north; here a heading is clockwise from \
                       north";
const RANGE: &str = "the original's range sensor did not see hives and measured short when \
                     `pointing` was not of length 1; here it sees all bodies";
const ACCELEROMETER: &str = "the original's accelerometer read -1 g lying on the ground; here it \
                             reads specific force, +1 g up";
const GYROSCOPE: &str = "the original's gyroscope read in the world's frame; here in the body's";
const BANDWIDTH: &str = "the original took this radio's rate for 125 times what it is; here airtime \
                         and charge are right";

const fn class(
    java: &'static str,
    kind: Kind,
    part: &'static str,
    properties: &'static [&'static [Property]],
) -> Class {
    Class {
        java,
        kind,
        part,
        vehicle: None,
        properties,
        note: None,
    }
}

const fn bee(
    java: &'static str,
    part: &'static str,
    properties: &'static [&'static [Property]],
) -> Class {
    Class {
        vehicle: Some("simple-bee"),
        ..class(java, Kind::Model, part, properties)
    }
}

const fn noted(class: Class, note: &'static str) -> Class {
    Class {
        note: Some(note),
        ..class
    }
}

const fn later(java: &'static str, kind: Kind, part: &'static str) -> Class {
    class(java, kind, part, &[])
}

/// All classes that a scenario of the original could name.
pub(super) const CLASSES: &[Class] = &[
    // Models.
    class(
        "model.SimpleHive",
        Kind::Model,
        "simple-hive",
        &[&[set("size", "size", "m")]],
    ),
    class(
        "model.InertHive",
        Kind::Model,
        "simple-hive",
        &[&[set("size", "size", "m")]],
    ),
    bee("example.InertBee", "inert-bee", &[BEE]),
    bee("example.RandomWalkBee", "random-walk-bee", &[WALK, BEE]),
    bee(
        "example.InstrumentBee",
        "instrument-bee",
        &[WALK, INSTRUMENT, BEE],
    ),
    bee("example.BroadcastBee", "broadcast-bee", &[BEE]),
    bee("example.MineBee", "mine-bee", &[BEE]),
    bee("example.MineBee2", "mine-bee-2", &[BEE]),
    bee("example.OpticalMotionBee", "optical-motion-bee", &[BEE]),
    bee("example.MazeBee", "maze-bee", &[BEE]),
    bee("example.CameraBee", "camera-bee", &[BEE]),
    later("model.GenericModel", Kind::Model, "platform"),
    later("model.HeliBee", Kind::Model, "helicopter"),
    later("model.HWILBee", Kind::Model, "ghost-helicopter"),
    later("model.AutoHeliBee", Kind::Model, "ghost-helicopter"),
    later("model.ViconObject", Kind::Model, "ghost-object"),
    later("model.TrackedObject", Kind::Model, "ghost-object"),
    later("model.Boundary", Kind::Model, "bounds"),
    later("model.HeliBounds", Kind::Model, "bounds"),
    // Channel and weather, which stood among the models.
    noted(
        class(
            "model.comms.FreeSpacePropagationModel",
            Kind::Propagation,
            "free-space",
            &[PROPAGATION],
        ),
        WAVELENGTH,
    ),
    noted(
        class(
            "model.comms.TwoRayPropagationModel",
            Kind::Propagation,
            "two-ray",
            &[PROPAGATION],
        ),
        WAVELENGTH,
    ),
    class(
        "model.weather.ConstantWeatherModel",
        Kind::Weather,
        "constant-weather",
        &[WIND],
    ),
    // Sensors.
    noted(
        class(
            "model.sensor.DefaultAccelerometer",
            Kind::Sensor,
            "accelerometer",
            &[&[set("sigma", "sigma", "m/s^2")]],
        ),
        ACCELEROMETER,
    ),
    noted(
        class(
            "model.sensor.DefaultGyroscope",
            Kind::Sensor,
            "gyroscope",
            &[&[set("sigma", "sigma", "rad/s")]],
        ),
        GYROSCOPE,
    ),
    noted(
        class(
            "model.sensor.DefaultCompass",
            Kind::Sensor,
            "compass",
            &[&[set("sigma", "sigma", "deg")]],
        ),
        COMPASS,
    ),
    class(
        "model.sensor.DefaultPositionSensor",
        Kind::Sensor,
        "position",
        &[&[set("sigma", "sigma", "m")]],
    ),
    class(
        "model.sensor.DefaultPoseSensor",
        Kind::Sensor,
        "pose",
        &[&[set("sigma", "sigma", "rad")]],
    ),
    noted(
        class(
            "model.sensor.DefaultRangeSensor",
            Kind::Sensor,
            "range",
            &[&[
                set("sigma", "sigma", "m"),
                set("min-range", "min_range", "m"),
                set("max-range", "max_range", "m"),
            ]],
        ),
        RANGE,
    ),
    class(
        "model.sensor.DefaultContactSensor",
        Kind::Sensor,
        "contact",
        &[&[set("radius", "radius", "m")]],
    ),
    class(
        "model.sensor.DefaultOpticalMotionSensor",
        Kind::Sensor,
        "optical-flow",
        &[FLOW],
    ),
    class(
        "model.sensor.BottomOpticalMotionSensor",
        Kind::Sensor,
        "optical-flow-down",
        &[FLOW],
    ),
    class("model.sensor.FlowerSensor", Kind::Sensor, "flower", &[CONE]),
    class("model.sensor.PersonSensor", Kind::Sensor, "person", &[CONE]),
    class(
        "model.sensor.WallSensor",
        Kind::Sensor,
        "wall",
        &[&[set("max-range", "max_range", "m")]],
    ),
    later("model.sensor.DefaultCameraSensor", Kind::Sensor, "camera"),
    later(
        "model.sensor.DefaultLaserRangeSensor",
        Kind::Sensor,
        "lidar",
    ),
    // Radios and antennas.
    class(
        "model.comms.CC2420",
        Kind::Radio,
        "cc2420",
        &[ZIGBEE, RADIO],
    ),
    class("model.comms.RF230", Kind::Radio, "rf230", &[ZIGBEE, RADIO]),
    noted(
        class(
            "model.comms.DefaultRadio",
            Kind::Radio,
            "default-radio",
            &[PLAIN_RADIO, RADIO],
        ),
        BANDWIDTH,
    ),
    class(
        "model.comms.IsotropicAntenna",
        Kind::Antenna,
        "isotropic",
        &[],
    ),
    // Components.
    class(
        "component.VisComponent3D",
        Kind::Component,
        "viewer",
        &[VIEWER],
    ),
    later(
        "component.ViconInputComponent",
        Kind::Component,
        "motion-capture",
    ),
    later("component.KinectInputComponent", Kind::Component, "kinect"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_and_their_properties_are_named_once() {
        for (at, class) in CLASSES.iter().enumerate() {
            assert!(
                CLASSES[..at].iter().all(|c| c.java != class.java),
                "{}",
                class.java
            );
            let names = class.property_names();
            for (at, name) in names.iter().enumerate() {
                assert!(!names[..at].contains(name), "{} {name}", class.java);
            }
        }
    }

    #[test]
    fn every_unit_is_one_that_its_quantity_knows() {
        let mut units: Vec<&str> = Vec::new();
        for property in CLASSES
            .iter()
            .flat_map(|c| c.properties)
            .flat_map(|g| g.iter())
        {
            match &property.to {
                To::Param(_, As::Unit(unit)) | To::Vehicle(_, As::Unit(unit)) => units.push(unit),
                To::Component(_, _, unit) => units.push(unit),
                _ => {}
            }
        }
        use simbeeotic_units::*;
        for unit in units {
            let text = format!("1 {unit}");
            let known = text.parse::<Length>().is_ok()
                || text.parse::<Speed>().is_ok()
                || text.parse::<Acceleration>().is_ok()
                || text.parse::<Time>().is_ok()
                || text.parse::<Mass>().is_ok()
                || text.parse::<Angle>().is_ok()
                || text.parse::<AngularRate>().is_ok()
                || text.parse::<Current>().is_ok()
                || text.parse::<Frequency>().is_ok()
                || text.parse::<DataRate>().is_ok()
                || text.parse::<Decibels>().is_ok()
                || text.parse::<PowerLevel>().is_ok();
            assert!(known, "{unit}");
        }
    }

    /// Keys that the sections of a scenario know themselves.
    const COMMON: [&str; 4] = ["noise_floor", "range_limit", "mount", "queue_frames"];

    #[test]
    fn every_property_of_a_part_on_the_shelf_leads_to_a_parameter() {
        use simbeeotic_model::registry::{Part, find};
        let knows = |part: &Part, key: &str| {
            let first = key.split('.').next().unwrap_or(key);
            let schema = (part.schema)();
            let known = schema
                .get("properties")
                .and_then(|p| p.get(first))
                .is_some();
            known || COMMON.contains(&first)
        };
        let mut checked = 0;
        for class in CLASSES {
            let vehicle = class.vehicle.and_then(|name| find(Kind::Vehicle, name));
            let Some(part) = super::find_part(class) else {
                continue;
            };
            for property in class.properties.iter().flat_map(|group| group.iter()) {
                let (part, key) = match &property.to {
                    To::Param(key, _) | To::Component(key, _, _) => (Some(part), key),
                    To::Vehicle(key, _) => (vehicle, key),
                    _ => continue,
                };
                let part = part.expect("the vehicle is on the shelf");
                assert!(knows(part, key), "{} {}: {key}", class.java, property.name);
                checked += 1;
            }
        }
        assert!(checked > 50, "{checked}");
    }
}
