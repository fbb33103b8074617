//! Types that Google and Foxglove have defined, and that readers know: times, places, log lines, images.

use super::{Enum, Kind, Type, many, one};

pub(super) const TIME: Kind = Kind::Message(&TIMESTAMP);

pub(super) static TIMESTAMP: Type = Type {
    package: "google.protobuf",
    name: "Timestamp",
    fields: &[one("seconds", 1, Kind::Int64), one("nanos", 2, Kind::Int32)],
};

pub(super) static VECTOR3: Type = Type {
    package: "foxglove",
    name: "Vector3",
    fields: &[
        one("x", 1, Kind::Double),
        one("y", 2, Kind::Double),
        one("z", 3, Kind::Double),
    ],
};

pub(super) static QUATERNION: Type = Type {
    package: "foxglove",
    name: "Quaternion",
    fields: &[
        one("x", 1, Kind::Double),
        one("y", 2, Kind::Double),
        one("z", 3, Kind::Double),
        one("w", 4, Kind::Double),
    ],
};

pub(super) static POSE: Type = Type {
    package: "foxglove",
    name: "Pose",
    fields: &[
        one("position", 1, Kind::Message(&VECTOR3)),
        one("orientation", 2, Kind::Message(&QUATERNION)),
    ],
};

pub(crate) static POSES_IN_FRAME: Type = Type {
    package: "foxglove",
    name: "PosesInFrame",
    fields: &[
        one("timestamp", 1, TIME),
        one("frame_id", 2, Kind::Text),
        many("poses", 3, Kind::Message(&POSE)),
    ],
};

pub(crate) static LOG: Type = Type {
    package: "foxglove",
    name: "Log",
    fields: &[
        one("timestamp", 1, TIME),
        one(
            "level",
            2,
            Kind::Enum(&Enum {
                name: "Level",
                values: &["UNKNOWN", "DEBUG", "INFO", "WARNING", "ERROR", "FATAL"],
            }),
        ),
        one("message", 3, Kind::Text),
        one("name", 4, Kind::Text),
        one("file", 5, Kind::Text),
        one("line", 6, Kind::Fixed32),
    ],
};

pub(crate) static RAW_IMAGE: Type = Type {
    package: "foxglove",
    name: "RawImage",
    fields: &[
        one("timestamp", 1, TIME),
        one("width", 2, Kind::Fixed32),
        one("height", 3, Kind::Fixed32),
        one("encoding", 4, Kind::Text),
        one("step", 5, Kind::Fixed32),
        one("data", 6, Kind::Bytes),
        one("frame_id", 7, Kind::Text),
    ],
};
