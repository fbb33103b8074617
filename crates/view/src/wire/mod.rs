//! What goes between page and server, as `PROTOCOL.md` says: from values to messages, and back.
//!
//! Reading order: [`Hello`] (the run and its world, once), [`Said`] (all other text), [`frame`] and
//! [`values`] (binary), [`Asked`] (what a page may say).

mod asked;
mod binary;
mod hello;
mod said;

pub use asked::{Asked, BadMessage};
pub use binary::{Columns, frame, values};
pub use hello::{Facts, Forms, Hello, Mode, Replayed};
pub(crate) use said::best;
pub use said::{
    BatteryDetails, BeamsDetails, Details, Link, Mark, MountDetails, Packet, PacketDetails, Part,
    RadioDetails, Said, SensorDetails, SeriesInfo,
};

/// The version of the protocol.
pub const PROTOCOL: u32 = 1;

/// One message to a page.
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// JSON.
    Text(std::sync::Arc<str>),
    /// A frame, or values.
    Binary(Vec<u8>),
}

impl Message {
    /// Its length in bytes.
    pub fn len(&self) -> usize {
        self.bytes().len()
    }

    /// Whether it has no bytes.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Its bytes.
    pub fn bytes(&self) -> &[u8] {
        match self {
            Self::Text(text) => text.as_bytes(),
            Self::Binary(bytes) => bytes,
        }
    }
}

/// Seconds of a time in nanoseconds.
pub(crate) fn seconds(time_ns: u64) -> f64 {
    time_ns as f64 * 1e-9
}

/// Nanoseconds of a time in seconds; what is before the start is the start.
pub(crate) fn nanoseconds(time_s: f64) -> u64 {
    (time_s * 1e9).round() as u64
}
