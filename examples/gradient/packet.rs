//! What a beacon says.

use simbeeotic::prelude::*;

/// What kind of place a beacon marks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A place in the field.
    Field,
    /// The hive.
    Hive,
    /// The field's edge, at a path's end.
    Edge,
}

/// A beacon's value: where it lies in the gradient field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value {
    /// What it marks.
    pub mark: Mark,
    /// How far it is from the hive to the beacon's place, along the nearest path.
    pub along: Length,
    /// How far the beacon is from that path.
    pub across: Length,
}

/// Bytes of a packet: its kind, the mark, and both lengths in centimetres.
const BYTES: usize = 6;
/// The first byte of a beacon's packet, so that others on the channel are not taken for one.
const KIND: u8 = 0xB7;

impl Value {
    /// The packet that says it. Lengths are rounded to centimetres; above 655.35 m they are that.
    pub fn to_packet(self) -> [u8; BYTES] {
        let mark = match self.mark {
            Mark::Field => 0,
            Mark::Hive => 1,
            Mark::Edge => 2,
        };
        let [along, across] = [self.along, self.across].map(|length| {
            // A number to an integer: what does not fit becomes the nearest that does.
            ((length.metres() * 100.0).round() as u16).to_be_bytes()
        });
        [KIND, mark, along[0], along[1], across[0], across[1]]
    }

    /// What a packet says; `None` if it is not a beacon's.
    pub fn from_packet(payload: &[u8]) -> Option<Self> {
        let [KIND, mark, along @ .., across_high, across_low] = payload else {
            return None;
        };
        let mark = match mark {
            0 => Mark::Field,
            1 => Mark::Hive,
            2 => Mark::Edge,
            _ => return None,
        };
        let length = |bytes| Length::from_metres(f64::from(u16::from_be_bytes(bytes)) / 100.0);
        Some(Self {
            mark,
            along: length(along.try_into().ok()?),
            across: length([*across_high, *across_low]),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_comes_back_from_its_packet() {
        for mark in [Mark::Field, Mark::Hive, Mark::Edge] {
            let value = Value {
                mark,
                along: Length::from_metres(12.34),
                across: Length::from_metres(300.01),
            };
            assert_eq!(Value::from_packet(&value.to_packet()), Some(value));
        }
    }

    #[test]
    fn other_packets_are_nobodys_value() {
        let good = Value {
            mark: Mark::Hive,
            along: Length::ZERO,
            across: Length::ZERO,
        }
        .to_packet();
        assert_eq!(Value::from_packet(&[]), None);
        assert_eq!(Value::from_packet(&good[..5]), None);
        assert_eq!(Value::from_packet(&[&good[..], &[0]].concat()), None);
        assert_eq!(Value::from_packet(&[1, 2, 3, 4, 5, 6]), None);
        assert_eq!(Value::from_packet(&[KIND, 9, 0, 0, 0, 0]), None);
    }
}
