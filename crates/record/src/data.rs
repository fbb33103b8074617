//! What is recorded and read back: the same plain types in both directions.

use crate::stage::Piece;
use simbeeotic_model::Image;
use std::sync::Arc;

/// One vehicle of a recording. Its place in the list is its place in every [`Tick`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Vehicle {
    /// Path of the model, for example `bee-17`. Unique within a recording.
    pub path: String,
    /// Kind of the model, for example `instrument-bee`.
    pub kind: String,
    /// Radius of the smallest sphere around the body's origin that holds its shape, m.
    pub radius_m: f64,
    /// What its body counts as: `vehicle`, `station`, `ghost`; empty if that was not recorded.
    pub role: String,
    /// Red, green, blue, opacity of its body, 0 to 255 each; all 0 if that was not recorded.
    pub color: [u8; 4],
    /// Its shape, in its body frame (FLU); empty if that was not recorded. Shared by all that look alike.
    pub pieces: Arc<[Piece]>,
}

/// Where one vehicle is and how it moves, at one instant.
///
/// Nothing is checked: a NaN is recorded as a NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Position in the world frame (east, north, up), m.
    pub position_m: [f64; 3],
    /// Attitude: the unit quaternion `w, x, y, z` that turns body vectors into world vectors.
    pub world_from_body: [f64; 4],
    /// Linear velocity in the world frame (east, north, up), m/s. Recorded as `f32`.
    pub velocity_m_s: [f64; 3],
    /// Angular velocity in the body frame (forward, left, up), rad/s. Recorded as `f32`.
    pub rate_rad_s: [f64; 3],
}

impl Default for Sample {
    /// At rest in the origin, nose to the east.
    fn default() -> Self {
        Sample {
            position_m: [0.0; 3],
            world_from_body: [1.0, 0.0, 0.0, 0.0],
            velocity_m_s: [0.0; 3],
            rate_rad_s: [0.0; 3],
        }
    }
}

/// All vehicles at one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tick {
    /// Virtual time since the start of the run, ns.
    pub time_ns: u64,
    /// One sample a vehicle, in the order of the recording's vehicles.
    ///
    /// Velocities and rates are NaN where the recording has none.
    pub samples: Vec<Sample>,
}

/// Something that happened between models, for marks on a time line: a contact, for example.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Event {
    /// Virtual time since the start of the run, ns.
    pub time_ns: u64,
    /// What kind of thing happened, as one word: `contact`.
    pub kind: String,
    /// Paths of the models it happened to; may be empty.
    pub paths: Vec<String>,
    /// The rest, for people.
    pub text: String,
}

/// How much a [`LogEntry`] matters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum LogLevel {
    /// For the author of the model.
    Debug,
    /// Worth knowing.
    #[default]
    Info,
    /// Not as it should be; the run goes on as asked.
    Warning,
    /// A model could not do what it was asked to.
    Error,
    /// The reason why the run ended.
    Fatal,
}

impl LogLevel {
    /// The number of `foxglove.Log.Level`.
    pub(crate) fn number(self) -> i32 {
        match self {
            LogLevel::Debug => 1,
            LogLevel::Info => 2,
            LogLevel::Warning => 3,
            LogLevel::Error => 4,
            LogLevel::Fatal => 5,
        }
    }

    /// The level of a `foxglove.Log.Level` number; unknown ones count as [`LogLevel::Info`].
    pub(crate) fn from_number(number: i32) -> Self {
        match number {
            1 => LogLevel::Debug,
            3 => LogLevel::Warning,
            4 => LogLevel::Error,
            5 => LogLevel::Fatal,
            _ => LogLevel::Info,
        }
    }
}

/// A line that a model or the program said.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LogEntry {
    /// Virtual time since the start of the run, ns.
    pub time_ns: u64,
    /// How much it matters.
    pub level: LogLevel,
    /// Path of the model that said it; empty for the program itself.
    pub path: String,
    /// What was said.
    pub text: String,
}

/// One named number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metric {
    /// Name, for example `pollen` or `bee-3/battery`.
    pub name: String,
    /// SI unit, for example `J`; empty for a plain number.
    pub unit: String,
    /// The number.
    pub value: f64,
}

/// Named numbers of one instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Metrics {
    /// Virtual time since the start of the run, ns.
    pub time_ns: u64,
    /// The numbers.
    pub values: Vec<Metric>,
}

/// What a sensor read, and what was true.
///
/// A reading of several rows (the points of a scan) has its columns as often as it has rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// Virtual time of the measurement since the start of the run, ns. It arrives the sensor's delay
    /// later.
    pub time_ns: u64,
    /// Path of the sensor: `bee-17/imu`.
    pub sensor: String,
    /// Names of the columns; empty for a single number.
    pub names: Vec<String>,
    /// SI unit of each column; `1` for counts.
    pub units: Vec<String>,
    /// What a perfect sensor would have read, row by row. NaN where there was nothing to read.
    pub truth: Vec<f64>,
    /// What it read: what the behaviour gets, after the sensor's delay. Empty if it gets nothing.
    pub reading: Vec<f64>,
    /// Whether this measurement was lost by drop-out. `reading` is then empty, or, of a sensor that is
    /// read on demand, the last one again.
    pub lost: bool,
    /// Whether the rows of truth and reading are of different things, row by row: lists of what was
    /// found.
    pub unpaired: bool,
}

/// A picture that a sensor took.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Virtual time since the start of the run, ns.
    pub time_ns: u64,
    /// Path of the picture: the sensor's, `bee-17/camera`, or one below it,
    /// `bee-17/camera/depth`, if it takes several.
    pub path: String,
    /// The picture.
    pub image: Image,
}

/// A file kept inside a recording as it was written: the scenario, the world.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Attachment {
    /// File name without folders, for example `scenario.toml`.
    pub name: String,
    /// Media type, for example `application/toml`.
    pub media_type: String,
    /// The bytes.
    pub bytes: Vec<u8>,
}
