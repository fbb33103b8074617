//! What each message means, told to readers that have never heard of this program.
//!
//! An MCAP schema with encoding `protobuf` is a serialized `google.protobuf.FileDescriptorSet`:
//! the file that defines the message and all files it imports. The `foxglove.*` messages here are
//! Foxglove's own (same file names, field names and numbers), so that Foxglove and Rerun draw
//! them; the `simbeeotic.*` ones are ours, and any protobuf reader can print them.

mod scene;

pub(crate) use scene::{ABOUT, POINT_CLOUD, SCENE_UPDATE, VEHICLES};

use prost::Message;

/// One message type, in a `.proto` file of its own.
pub(crate) struct Type {
    package: &'static str,
    name: &'static str,
    file: &'static str,
    imports: &'static [&'static Type],
    fields: &'static [Field],
    enums: &'static [Enum],
}

impl Type {
    /// The name by which MCAP readers know the type, for example `foxglove.Log`.
    pub(crate) fn full_name(&self) -> String {
        format!("{}.{}", self.package, self.name)
    }

    /// The serialized descriptor set: this type's file after all that it imports.
    pub(crate) fn descriptor_set(&self) -> Vec<u8> {
        let mut set = wire::FileDescriptorSet::default();
        self.collect(&mut set.file);
        set.encode_to_vec()
    }

    fn collect(&self, files: &mut Vec<wire::FileDescriptor>) {
        for import in self.imports {
            import.collect(files);
        }
        if files.iter().all(|known| known.name != self.file) {
            files.push(self.describe());
        }
    }

    fn describe(&self) -> wire::FileDescriptor {
        let message = wire::Descriptor {
            name: self.name.into(),
            field: self.fields.iter().map(Field::describe).collect(),
            enum_type: self.enums.iter().map(Enum::describe).collect(),
        };
        wire::FileDescriptor {
            name: self.file.into(),
            package: self.package.into(),
            dependency: self.imports.iter().map(|t| t.file.into()).collect(),
            message_type: vec![message],
            syntax: "proto3".into(),
        }
    }
}

struct Field {
    name: &'static str,
    number: i32,
    kind: Kind,
    repeated: bool,
}

impl Field {
    fn describe(&self) -> wire::FieldDescriptor {
        let (code, type_name) = match self.kind {
            Kind::Double => (1, None),
            Kind::Float => (2, None),
            Kind::Int64 => (3, None),
            Kind::Int32 => (5, None),
            Kind::Fixed32 => (7, None),
            Kind::Bool => (8, None),
            Kind::Text => (9, None),
            Kind::Bytes => (12, None),
            Kind::Message(name) => (11, Some(name.into())),
            Kind::Enum(name) => (14, Some(name.into())),
        };
        wire::FieldDescriptor {
            name: self.name.into(),
            number: self.number,
            label: if self.repeated { 3 } else { 1 },
            r#type: code,
            type_name,
        }
    }
}

/// The protobuf types in use; messages and enums by their full name with a leading dot.
#[derive(Clone, Copy)]
enum Kind {
    Double,
    Float,
    Int64,
    Int32,
    Fixed32,
    Bool,
    Text,
    Bytes,
    Message(&'static str),
    Enum(&'static str),
}

struct Enum {
    name: &'static str,
    /// Numbered from 0 on.
    values: &'static [&'static str],
}

impl Enum {
    fn describe(&self) -> wire::EnumDescriptor {
        let value = |(number, name): (i32, &&str)| wire::EnumValue {
            name: (*name).into(),
            number: Some(number),
        };
        wire::EnumDescriptor {
            name: self.name.into(),
            value: (0..).zip(self.values).map(value).collect(),
        }
    }
}

const fn one(name: &'static str, number: i32, kind: Kind) -> Field {
    Field {
        name,
        number,
        kind,
        repeated: false,
    }
}

const fn many(name: &'static str, number: i32, kind: Kind) -> Field {
    Field {
        name,
        number,
        kind,
        repeated: true,
    }
}

const TIME: Kind = Kind::Message(".google.protobuf.Timestamp");

static TIMESTAMP: Type = Type {
    package: "google.protobuf",
    name: "Timestamp",
    file: "google/protobuf/timestamp.proto",
    imports: &[],
    fields: &[one("seconds", 1, Kind::Int64), one("nanos", 2, Kind::Int32)],
    enums: &[],
};

static VECTOR3: Type = Type {
    package: "foxglove",
    name: "Vector3",
    file: "foxglove/Vector3.proto",
    imports: &[],
    fields: &[
        one("x", 1, Kind::Double),
        one("y", 2, Kind::Double),
        one("z", 3, Kind::Double),
    ],
    enums: &[],
};

static QUATERNION: Type = Type {
    package: "foxglove",
    name: "Quaternion",
    file: "foxglove/Quaternion.proto",
    imports: &[],
    fields: &[
        one("x", 1, Kind::Double),
        one("y", 2, Kind::Double),
        one("z", 3, Kind::Double),
        one("w", 4, Kind::Double),
    ],
    enums: &[],
};

static POSE: Type = Type {
    package: "foxglove",
    name: "Pose",
    file: "foxglove/Pose.proto",
    imports: &[&QUATERNION, &VECTOR3],
    fields: &[
        one("position", 1, Kind::Message(".foxglove.Vector3")),
        one("orientation", 2, Kind::Message(".foxglove.Quaternion")),
    ],
    enums: &[],
};

pub(crate) static POSES_IN_FRAME: Type = Type {
    package: "foxglove",
    name: "PosesInFrame",
    file: "foxglove/PosesInFrame.proto",
    imports: &[&POSE, &TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        one("frame_id", 2, Kind::Text),
        many("poses", 3, Kind::Message(".foxglove.Pose")),
    ],
    enums: &[],
};

pub(crate) static LOG: Type = Type {
    package: "foxglove",
    name: "Log",
    file: "foxglove/Log.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        one("level", 2, Kind::Enum(".foxglove.Log.Level")),
        one("message", 3, Kind::Text),
        one("name", 4, Kind::Text),
        one("file", 5, Kind::Text),
        one("line", 6, Kind::Fixed32),
    ],
    enums: &[Enum {
        name: "Level",
        values: &["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"],
    }],
};

pub(crate) static TWISTS: Type = Type {
    package: "simbeeotic",
    name: "Twists",
    file: "simbeeotic/Twists.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        many("linear_enu_m_s", 2, Kind::Float),
        many("angular_flu_rad_s", 3, Kind::Float),
    ],
    enums: &[],
};

pub(crate) static EVENT: Type = Type {
    package: "simbeeotic",
    name: "Event",
    file: "simbeeotic/Event.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        one("kind", 2, Kind::Text),
        many("paths", 3, Kind::Text),
        one("text", 4, Kind::Text),
    ],
    enums: &[],
};

pub(crate) static METRICS: Type = Type {
    package: "simbeeotic",
    name: "Metrics",
    file: "simbeeotic/Metrics.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        many("names", 2, Kind::Text),
        many("units", 3, Kind::Text),
        many("values", 4, Kind::Double),
    ],
    enums: &[],
};

pub(crate) static READING: Type = Type {
    package: "simbeeotic",
    name: "Reading",
    file: "simbeeotic/Reading.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        one("sensor", 2, Kind::Text),
        many("names", 3, Kind::Text),
        many("units", 4, Kind::Text),
        many("truth", 5, Kind::Double),
        many("reading", 6, Kind::Double),
        one("lost", 7, Kind::Bool),
        one("unpaired", 8, Kind::Bool),
    ],
    enums: &[],
};

pub(crate) static PACKET: Type = Type {
    package: "simbeeotic",
    name: "Packet",
    file: "simbeeotic/Packet.proto",
    imports: &[&TIMESTAMP, &VECTOR3],
    fields: &[
        one("timestamp", 1, TIME),
        one("sender", 2, Kind::Text),
        one("radio", 3, Kind::Text),
        one("channel", 4, Kind::Int32),
        one("frequency_hz", 5, Kind::Double),
        one("destination", 6, Kind::Text),
        one("bytes", 7, Kind::Int32),
        one("payload_bytes", 8, Kind::Int32),
        one("airtime_ns", 9, Kind::Int64),
        one("power_dbm", 10, Kind::Double),
        one("position", 11, Kind::Message(".foxglove.Vector3")),
        many("receivers", 12, Kind::Text),
        many("rssi_dbm", 13, Kind::Float),
        many("snr_db", 14, Kind::Float),
        many("lqi", 15, Kind::Int32),
        many("delay_ns", 16, Kind::Int64),
    ],
    enums: &[],
};

pub(crate) static RADIO: Type = Type {
    package: "simbeeotic",
    name: "Radio",
    file: "simbeeotic/Radio.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        one("period_s", 2, Kind::Double),
        one("radio", 3, Kind::Text),
        one("sent", 4, Kind::Int64),
        one("received", 5, Kind::Int64),
        one("overheard", 6, Kind::Int64),
        many("reasons", 7, Kind::Text),
        many("lost", 8, Kind::Int64),
        one("sent_total", 9, Kind::Int64),
        one("received_total", 10, Kind::Int64),
        one("overheard_total", 11, Kind::Int64),
        many("lost_total", 12, Kind::Int64),
    ],
    enums: &[],
};

pub(crate) static LINKS: Type = Type {
    package: "simbeeotic",
    name: "Links",
    file: "simbeeotic/Links.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        one("period_s", 2, Kind::Double),
        many("radios", 3, Kind::Text),
        many("from", 4, Kind::Int32),
        many("to", 5, Kind::Int32),
        many("sent", 6, Kind::Int32),
        many("received", 7, Kind::Int32),
        many("rssi_dbm", 8, Kind::Float),
        many("distance_m", 9, Kind::Float),
    ],
    enums: &[],
};

pub(crate) static WIND: Type = Type {
    package: "simbeeotic",
    name: "Wind",
    file: "simbeeotic/Wind.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        many("position_enu_m", 2, Kind::Float),
        many("velocity_enu_m_s", 3, Kind::Float),
    ],
    enums: &[],
};

pub(crate) static RAW_IMAGE: Type = Type {
    package: "foxglove",
    name: "RawImage",
    file: "foxglove/RawImage.proto",
    imports: &[&TIMESTAMP],
    fields: &[
        one("timestamp", 1, TIME),
        one("width", 2, Kind::Fixed32),
        one("height", 3, Kind::Fixed32),
        one("encoding", 4, Kind::Text),
        one("step", 5, Kind::Fixed32),
        one("data", 6, Kind::Bytes),
        one("frame_id", 7, Kind::Text),
    ],
    enums: &[],
};

/// The part of `google/protobuf/descriptor.proto` that these schemas need.
mod wire {
    use prost::Message;

    #[derive(Clone, PartialEq, Message)]
    pub(super) struct FileDescriptorSet {
        #[prost(message, repeated, tag = "1")]
        pub(super) file: Vec<FileDescriptor>,
    }

    #[derive(Clone, PartialEq, Message)]
    pub(super) struct FileDescriptor {
        #[prost(string, tag = "1")]
        pub(super) name: String,
        #[prost(string, tag = "2")]
        pub(super) package: String,
        #[prost(string, repeated, tag = "3")]
        pub(super) dependency: Vec<String>,
        #[prost(message, repeated, tag = "4")]
        pub(super) message_type: Vec<Descriptor>,
        #[prost(string, tag = "12")]
        pub(super) syntax: String,
    }

    #[derive(Clone, PartialEq, Message)]
    pub(super) struct Descriptor {
        #[prost(string, tag = "1")]
        pub(super) name: String,
        #[prost(message, repeated, tag = "2")]
        pub(super) field: Vec<FieldDescriptor>,
        #[prost(message, repeated, tag = "4")]
        pub(super) enum_type: Vec<EnumDescriptor>,
    }

    #[derive(Clone, PartialEq, Message)]
    pub(super) struct FieldDescriptor {
        #[prost(string, tag = "1")]
        pub(super) name: String,
        #[prost(int32, tag = "3")]
        pub(super) number: i32,
        #[prost(int32, tag = "4")]
        pub(super) label: i32,
        #[prost(int32, tag = "5")]
        pub(super) r#type: i32,
        #[prost(string, optional, tag = "6")]
        pub(super) type_name: Option<String>,
    }

    #[derive(Clone, PartialEq, Message)]
    pub(super) struct EnumDescriptor {
        #[prost(string, tag = "1")]
        pub(super) name: String,
        #[prost(message, repeated, tag = "2")]
        pub(super) value: Vec<EnumValue>,
    }

    #[derive(Clone, PartialEq, Message)]
    pub(super) struct EnumValue {
        #[prost(string, tag = "1")]
        pub(super) name: String,
        /// Present even where it is 0: this message is proto2, which tells the two apart.
        #[prost(int32, optional, tag = "2")]
        pub(super) number: Option<i32>,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::message;
    use prost::encoding::{WireType, decode_key, decode_varint};

    /// Field numbers and wire types of one encoded message, each once, in order.
    pub(super) fn keys(mut bytes: &[u8]) -> Vec<(i32, WireType)> {
        let mut keys = Vec::new();
        while !bytes.is_empty() {
            let (number, wire_type) = decode_key(&mut bytes).expect("a key");
            let length = match wire_type {
                WireType::Varint => {
                    decode_varint(&mut bytes).expect("a varint");
                    0
                }
                WireType::SixtyFourBit => 8,
                WireType::ThirtyTwoBit => 4,
                WireType::LengthDelimited => decode_varint(&mut bytes).expect("a length"),
                other => panic!("{other:?} is not in use"),
            };
            bytes = &bytes[usize::try_from(length).expect("short")..];
            keys.push((i32::try_from(number).expect("small"), wire_type));
        }
        keys.dedup();
        keys
    }

    pub(super) fn declared(ty: &Type) -> Vec<(i32, WireType)> {
        let wire_type = |field: &Field| match (field.kind, field.repeated) {
            (Kind::Text | Kind::Bytes | Kind::Message(_), _) | (_, true) => {
                WireType::LengthDelimited
            }
            (Kind::Double, _) => WireType::SixtyFourBit,
            (Kind::Float | Kind::Fixed32, _) => WireType::ThirtyTwoBit,
            (Kind::Int64 | Kind::Int32 | Kind::Bool | Kind::Enum(_), _) => WireType::Varint,
        };
        ty.fields
            .iter()
            .map(|field| (field.number, wire_type(field)))
            .collect()
    }

    #[test]
    fn the_schemas_describe_the_messages_that_are_written() {
        let time = message::Timestamp {
            seconds: 1,
            nanos: 2,
        };
        let position = message::Vector3 {
            x: 1.0,
            y: 2.0,
            z: 3.0,
        };
        let orientation = message::Quaternion {
            x: 0.5,
            y: 0.5,
            z: 0.5,
            w: 0.5,
        };
        let pose = message::Pose {
            position: Some(position),
            orientation: Some(orientation),
        };
        let timestamp = Some(time);
        let text = || "a".to_string();

        let poses = message::PosesInFrame {
            timestamp,
            frame_id: text(),
            poses: vec![pose],
        };
        let log = message::Log {
            timestamp,
            level: 1,
            message: text(),
            name: text(),
            file: text(),
            line: 1,
        };
        let twists = message::Twists {
            timestamp,
            linear_enu_m_s: vec![1.0],
            angular_flu_rad_s: vec![1.0],
        };
        let event = message::Event {
            timestamp,
            kind: text(),
            paths: vec![text()],
            text: text(),
        };
        let metrics = message::Metrics {
            timestamp,
            names: vec![text()],
            units: vec![text()],
            values: vec![1.0],
        };

        let reading = message::Reading {
            timestamp,
            sensor: text(),
            names: vec![text()],
            units: vec![text()],
            truth: vec![1.0],
            reading: vec![1.0],
            lost: true,
            unpaired: true,
        };
        let packet = message::Packet {
            timestamp,
            sender: text(),
            radio: text(),
            channel: 11,
            frequency_hz: 1.0,
            destination: text(),
            bytes: 1,
            payload_bytes: 1,
            airtime_ns: 1,
            power_dbm: 1.0,
            position: Some(position),
            receivers: vec![text()],
            rssi_dbm: vec![1.0],
            snr_db: vec![1.0],
            lqi: vec![1],
            delay_ns: vec![1],
        };
        let radio = message::Radio {
            timestamp,
            period_s: 1.0,
            radio: text(),
            sent: 1,
            received: 1,
            overheard: 1,
            reasons: vec![text()],
            lost: vec![1],
            sent_total: 1,
            received_total: 1,
            overheard_total: 1,
            lost_total: vec![1],
        };
        let links = message::Links {
            timestamp,
            period_s: 1.0,
            radios: vec![text()],
            from: vec![1],
            to: vec![1],
            sent: vec![1],
            received: vec![1],
            rssi_dbm: vec![1.0],
            distance_m: vec![1.0],
        };
        let wind = message::Wind {
            timestamp,
            position_enu_m: vec![1.0],
            velocity_enu_m_s: vec![1.0],
        };
        let image = message::RawImage {
            timestamp,
            width: 1,
            height: 1,
            encoding: text(),
            step: 1,
            data: vec![1],
            frame_id: text(),
        };

        for (ty, bytes) in [
            (&TIMESTAMP, time.encode_to_vec()),
            (&VECTOR3, position.encode_to_vec()),
            (&QUATERNION, orientation.encode_to_vec()),
            (&POSE, pose.encode_to_vec()),
            (&POSES_IN_FRAME, poses.encode_to_vec()),
            (&LOG, log.encode_to_vec()),
            (&TWISTS, twists.encode_to_vec()),
            (&EVENT, event.encode_to_vec()),
            (&METRICS, metrics.encode_to_vec()),
            (&READING, reading.encode_to_vec()),
            (&PACKET, packet.encode_to_vec()),
            (&RADIO, radio.encode_to_vec()),
            (&LINKS, links.encode_to_vec()),
            (&WIND, wind.encode_to_vec()),
            (&RAW_IMAGE, image.encode_to_vec()),
        ] {
            assert_eq!(keys(&bytes), declared(ty), "{}", ty.full_name());
        }
    }

    #[test]
    fn a_descriptor_set_holds_every_file_once_and_after_its_imports() {
        let bytes = POSES_IN_FRAME.descriptor_set();
        let set = wire::FileDescriptorSet::decode(&bytes[..]).expect("valid");
        let names: Vec<_> = set.file.iter().map(|file| file.name.as_str()).collect();
        assert_eq!(
            names,
            [
                "foxglove/Quaternion.proto",
                "foxglove/Vector3.proto",
                "foxglove/Pose.proto",
                "google/protobuf/timestamp.proto",
                "foxglove/PosesInFrame.proto",
            ]
        );
    }
}
