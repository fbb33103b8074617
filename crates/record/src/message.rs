//! The messages of a recording as they stand on the wire.
//!
//! Written by hand, since there are few of them and a build that needs no `protoc` is worth more
//! than generated code. [`crate::schema`] describes the same messages to readers; its tests hold
//! the two together.

use prost::Message;

/// `google.protobuf.Timestamp`: here virtual time, counted from the start of the run.
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Timestamp {
    #[prost(int64, tag = "1")]
    pub(crate) seconds: i64,
    #[prost(int32, tag = "2")]
    pub(crate) nanos: i32,
}

impl Timestamp {
    pub(crate) fn from_ns(time_ns: u64) -> Self {
        let seconds = i64::try_from(time_ns / 1_000_000_000).unwrap_or(i64::MAX);
        let nanos = (time_ns % 1_000_000_000) as i32;
        Timestamp { seconds, nanos }
    }
}

/// `foxglove.Vector3`
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Vector3 {
    #[prost(double, tag = "1")]
    pub(crate) x: f64,
    #[prost(double, tag = "2")]
    pub(crate) y: f64,
    #[prost(double, tag = "3")]
    pub(crate) z: f64,
}

/// `foxglove.Quaternion`
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Quaternion {
    #[prost(double, tag = "1")]
    pub(crate) x: f64,
    #[prost(double, tag = "2")]
    pub(crate) y: f64,
    #[prost(double, tag = "3")]
    pub(crate) z: f64,
    #[prost(double, tag = "4")]
    pub(crate) w: f64,
}

/// `foxglove.Pose`
#[derive(Clone, Copy, PartialEq, Message)]
pub(crate) struct Pose {
    #[prost(message, optional, tag = "1")]
    pub(crate) position: Option<Vector3>,
    #[prost(message, optional, tag = "2")]
    pub(crate) orientation: Option<Quaternion>,
}

/// `foxglove.PosesInFrame`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct PosesInFrame {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub(crate) frame_id: String,
    #[prost(message, repeated, tag = "3")]
    pub(crate) poses: Vec<Pose>,
}

/// `foxglove.Log`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Log {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    /// An enum in the schema; the wire does not tell it from an `int32`.
    #[prost(int32, tag = "2")]
    pub(crate) level: i32,
    #[prost(string, tag = "3")]
    pub(crate) message: String,
    #[prost(string, tag = "4")]
    pub(crate) name: String,
    #[prost(string, tag = "5")]
    pub(crate) file: String,
    #[prost(fixed32, tag = "6")]
    pub(crate) line: u32,
}

/// `simbeeotic.Vehicles`: who flies; the order is the order of every tick.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Vehicles {
    #[prost(string, repeated, tag = "1")]
    pub(crate) paths: Vec<String>,
    #[prost(string, repeated, tag = "2")]
    pub(crate) kinds: Vec<String>,
    #[prost(double, repeated, tag = "3")]
    pub(crate) radius_m: Vec<f64>,
}

/// `simbeeotic.Twists`: three numbers a vehicle in each list.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Twists {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(float, repeated, tag = "2")]
    pub(crate) linear_enu_m_s: Vec<f32>,
    #[prost(float, repeated, tag = "3")]
    pub(crate) angular_flu_rad_s: Vec<f32>,
}

/// `simbeeotic.Event`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Event {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub(crate) kind: String,
    #[prost(string, repeated, tag = "3")]
    pub(crate) paths: Vec<String>,
    #[prost(string, tag = "4")]
    pub(crate) text: String,
}

/// `simbeeotic.Metrics`: the three lists are equally long.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Metrics {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(string, repeated, tag = "2")]
    pub(crate) names: Vec<String>,
    #[prost(string, repeated, tag = "3")]
    pub(crate) units: Vec<String>,
    #[prost(double, repeated, tag = "4")]
    pub(crate) values: Vec<f64>,
}

/// `simbeeotic.Reading`: names and units are one row; truth and reading are whole rows.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Reading {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub(crate) sensor: String,
    #[prost(string, repeated, tag = "3")]
    pub(crate) names: Vec<String>,
    #[prost(string, repeated, tag = "4")]
    pub(crate) units: Vec<String>,
    #[prost(double, repeated, tag = "5")]
    pub(crate) truth: Vec<f64>,
    #[prost(double, repeated, tag = "6")]
    pub(crate) reading: Vec<f64>,
    #[prost(bool, tag = "7")]
    pub(crate) lost: bool,
    #[prost(bool, tag = "8")]
    pub(crate) unpaired: bool,
}

/// `foxglove.RawImage`
#[derive(Clone, PartialEq, Message)]
pub(crate) struct RawImage {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(fixed32, tag = "2")]
    pub(crate) width: u32,
    #[prost(fixed32, tag = "3")]
    pub(crate) height: u32,
    #[prost(string, tag = "4")]
    pub(crate) encoding: String,
    #[prost(fixed32, tag = "5")]
    pub(crate) step: u32,
    #[prost(bytes = "vec", tag = "6")]
    pub(crate) data: Vec<u8>,
    #[prost(string, tag = "7")]
    pub(crate) frame_id: String,
}
