//! What is said by radio: a byte that says what, then numbers, big end first.

use simbeeotic::units::glam::DVec2;

/// A packet of this example.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Word {
    /// I am the beacon at home.
    Beacon,
    /// I am a bee, and fly along this yaw, rad: sent in milliradians.
    Bee(f64),
    /// Somebody is here: east, north of the world's origin, m: sent in centimetres.
    Person(DVec2),
}

const BEACON: u8 = 1;
const BEE: u8 = 2;
const PERSON: u8 = 3;

impl Word {
    /// Its bytes.
    pub(super) fn encode(self) -> Vec<u8> {
        let number = |value: f64, per: f64| ((value * per).round() as i32).to_be_bytes();
        match self {
            Self::Beacon => vec![BEACON],
            Self::Bee(yaw) => [&[BEE][..], &number(yaw, 1e3)].concat(),
            Self::Person(at) => [&[PERSON][..], &number(at.x, 1e2), &number(at.y, 1e2)].concat(),
        }
    }

    /// The word that these bytes are; `None` if they are none.
    pub(super) fn decode(bytes: &[u8]) -> Option<Self> {
        let (&tag, rest) = bytes.split_first()?;
        let number = |at: usize, per: f64| {
            let bytes = rest.get(at..)?.first_chunk::<4>()?;
            Some(f64::from(i32::from_be_bytes(*bytes)) / per)
        };
        match (tag, rest.len()) {
            (BEACON, 0) => Some(Self::Beacon),
            (BEE, 4) => Some(Self::Bee(number(0, 1e3)?)),
            (PERSON, 8) => Some(Self::Person(DVec2::new(number(0, 1e2)?, number(4, 1e2)?))),
            _ => None,
        }
    }
}

#[cfg(test)]
mod test {
    use super::*;

    #[test]
    fn a_word_comes_out_as_it_went_in_and_what_is_none_is_refused() {
        let at = DVec2::new(-12.34, 56.78);
        for word in [Word::Beacon, Word::Bee(-1.571), Word::Person(at)] {
            assert_eq!(Word::decode(&word.encode()), Some(word));
        }
        for bytes in [&[][..], &[9], &[1, 0], &[2, 0, 0, 0], &[3, 0, 0, 0, 0]] {
            assert_eq!(Word::decode(bytes), None, "{bytes:?}");
        }
    }
}
