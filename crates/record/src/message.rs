//! The messages of a recording as they stand on the wire.
//!
//! Written by hand, since there are few of them and a build that needs no `protoc` is worth more
//! than generated code. [`crate::schema`] describes the same messages to readers; its tests hold
//! the two together.

mod scene;

pub(crate) use scene::{
    About, AboutBeams, AboutPart, AboutSensor, Color, Cube, Cylinder, KeyValue, PackedField,
    PointCloud, SceneEntity, SceneUpdate, TriangleList, Vehicles,
};

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

/// `simbeeotic.Packet`: one transmission; the last five lists are equally long.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Packet {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(string, tag = "2")]
    pub(crate) sender: String,
    #[prost(string, tag = "3")]
    pub(crate) radio: String,
    #[prost(int32, tag = "4")]
    pub(crate) channel: i32,
    #[prost(double, tag = "5")]
    pub(crate) frequency_hz: f64,
    #[prost(string, tag = "6")]
    pub(crate) destination: String,
    #[prost(int32, tag = "7")]
    pub(crate) bytes: i32,
    #[prost(int32, tag = "8")]
    pub(crate) payload_bytes: i32,
    #[prost(int64, tag = "9")]
    pub(crate) airtime_ns: i64,
    #[prost(double, tag = "10")]
    pub(crate) power_dbm: f64,
    #[prost(message, optional, tag = "11")]
    pub(crate) position: Option<Vector3>,
    #[prost(string, repeated, tag = "12")]
    pub(crate) receivers: Vec<String>,
    #[prost(float, repeated, tag = "13")]
    pub(crate) rssi_dbm: Vec<f32>,
    #[prost(float, repeated, tag = "14")]
    pub(crate) snr_db: Vec<f32>,
    #[prost(int32, repeated, tag = "15")]
    pub(crate) lqi: Vec<i32>,
    #[prost(int64, repeated, tag = "16")]
    pub(crate) delay_ns: Vec<i64>,
}

/// `simbeeotic.Radio`: `lost` and `lost_total` are as long as `reasons`.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Radio {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(double, tag = "2")]
    pub(crate) period_s: f64,
    #[prost(string, tag = "3")]
    pub(crate) radio: String,
    #[prost(int64, tag = "4")]
    pub(crate) sent: i64,
    #[prost(int64, tag = "5")]
    pub(crate) received: i64,
    #[prost(int64, tag = "6")]
    pub(crate) overheard: i64,
    #[prost(string, repeated, tag = "7")]
    pub(crate) reasons: Vec<String>,
    #[prost(int64, repeated, tag = "8")]
    pub(crate) lost: Vec<i64>,
    #[prost(int64, tag = "9")]
    pub(crate) sent_total: i64,
    #[prost(int64, tag = "10")]
    pub(crate) received_total: i64,
    #[prost(int64, tag = "11")]
    pub(crate) overheard_total: i64,
    #[prost(int64, repeated, tag = "12")]
    pub(crate) lost_total: Vec<i64>,
}

/// `simbeeotic.Links`: the lists behind `radios` are equally long.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Links {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(double, tag = "2")]
    pub(crate) period_s: f64,
    #[prost(string, repeated, tag = "3")]
    pub(crate) radios: Vec<String>,
    #[prost(int32, repeated, tag = "4")]
    pub(crate) from: Vec<i32>,
    #[prost(int32, repeated, tag = "5")]
    pub(crate) to: Vec<i32>,
    #[prost(int32, repeated, tag = "6")]
    pub(crate) sent: Vec<i32>,
    #[prost(int32, repeated, tag = "7")]
    pub(crate) received: Vec<i32>,
    #[prost(float, repeated, tag = "8")]
    pub(crate) rssi_dbm: Vec<f32>,
    #[prost(float, repeated, tag = "9")]
    pub(crate) distance_m: Vec<f32>,
}

/// `simbeeotic.Wind`: three numbers a point of the grid in each list.
#[derive(Clone, PartialEq, Message)]
pub(crate) struct Wind {
    #[prost(message, optional, tag = "1")]
    pub(crate) timestamp: Option<Timestamp>,
    #[prost(float, repeated, tag = "2")]
    pub(crate) position_enu_m: Vec<f32>,
    #[prost(float, repeated, tag = "3")]
    pub(crate) velocity_enu_m_s: Vec<f32>,
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
