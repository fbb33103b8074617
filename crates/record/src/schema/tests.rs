//! The schemas against the messages that are written.

use super::known::{POSE, QUATERNION, TIMESTAMP, VECTOR3};
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
        (Kind::Text | Kind::Bytes | Kind::Message(_), _) | (_, true) => WireType::LengthDelimited,
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
    let set = descriptor::FileDescriptorSet::decode(&bytes[..]).expect("valid");
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
