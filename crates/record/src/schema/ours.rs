//! What our own messages mean: motion, events, measurements, traffic on the air, wind.

use super::known::{TIME, VECTOR3};
use super::{Kind, Type, many, one};

pub(crate) static TWISTS: Type = Type {
    package: "simbeeotic",
    name: "Twists",
    fields: &[
        one("timestamp", 1, TIME),
        many("linear_enu_m_s", 2, Kind::Float),
        many("angular_flu_rad_s", 3, Kind::Float),
    ],
};

pub(crate) static EVENT: Type = Type {
    package: "simbeeotic",
    name: "Event",
    fields: &[
        one("timestamp", 1, TIME),
        one("kind", 2, Kind::Text),
        many("paths", 3, Kind::Text),
        one("text", 4, Kind::Text),
    ],
};

pub(crate) static METRICS: Type = Type {
    package: "simbeeotic",
    name: "Metrics",
    fields: &[
        one("timestamp", 1, TIME),
        many("names", 2, Kind::Text),
        many("units", 3, Kind::Text),
        many("values", 4, Kind::Double),
    ],
};

pub(crate) static READING: Type = Type {
    package: "simbeeotic",
    name: "Reading",
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
};

pub(crate) static PACKET: Type = Type {
    package: "simbeeotic",
    name: "Packet",
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
        one("position", 11, Kind::Message(&VECTOR3)),
        many("receivers", 12, Kind::Text),
        many("rssi_dbm", 13, Kind::Float),
        many("snr_db", 14, Kind::Float),
        many("lqi", 15, Kind::Int32),
        many("delay_ns", 16, Kind::Int64),
    ],
};

pub(crate) static RADIO: Type = Type {
    package: "simbeeotic",
    name: "Radio",
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
};

pub(crate) static LINKS: Type = Type {
    package: "simbeeotic",
    name: "Links",
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
};

pub(crate) static WIND: Type = Type {
    package: "simbeeotic",
    name: "Wind",
    fields: &[
        one("timestamp", 1, TIME),
        many("position_enu_m", 2, Kind::Float),
        many("velocity_enu_m_s", 3, Kind::Float),
    ],
};
