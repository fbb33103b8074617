//! What is said by radio: three words, each of one byte and, but for the last, a place.

use simbeeotic::units::glam::DVec2;

/// A packet of this example. Places are east and north of the world's origin, in metres, and travel as
/// whole centimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Word {
    /// It smells here.
    Smelled(DVec2),
    /// The leak is here.
    Declared(DVec2),
    /// The leak is known: come home.
    Found,
}

const SMELLED: u8 = 1;
const DECLARED: u8 = 2;
const FOUND: u8 = 3;

impl Word {
    /// Its bytes.
    pub(super) fn encode(self) -> Vec<u8> {
        let (tag, place) = match self {
            Self::Smelled(place) => (SMELLED, place),
            Self::Declared(place) => (DECLARED, place),
            Self::Found => return vec![FOUND],
        };
        let centimetres = |metres: f64| ((metres * 100.0).round() as i32).to_be_bytes();
        let mut bytes = vec![tag];
        bytes.extend(centimetres(place.x));
        bytes.extend(centimetres(place.y));
        bytes
    }

    /// The word that these bytes are; `None` if they are none.
    pub(super) fn decode(bytes: &[u8]) -> Option<Self> {
        let (&tag, rest) = bytes.split_first()?;
        if tag == FOUND && rest.is_empty() {
            return Some(Self::Found);
        }
        let (x, y) = (rest.first_chunk::<4>()?, rest.last_chunk::<4>()?);
        let metres = |bytes: &[u8; 4]| f64::from(i32::from_be_bytes(*bytes)) / 100.0;
        let place = DVec2::new(metres(x), metres(y));
        match (tag, rest.len()) {
            (SMELLED, 8) => Some(Self::Smelled(place)),
            (DECLARED, 8) => Some(Self::Declared(place)),
            _ => None,
        }
    }
}

#[cfg(test)]
mod test {
    use super::*;

    #[test]
    fn a_word_comes_out_as_it_went_in_and_what_is_none_is_refused() {
        let place = DVec2::new(-12.34, 56.78);
        for word in [Word::Smelled(place), Word::Declared(place), Word::Found] {
            assert_eq!(Word::decode(&word.encode()), Some(word));
        }
        let mut long = Word::Declared(place).encode();
        long.push(0);
        for bytes in [&[][..], &[9], &[1, 2, 3], &[3, 0], &long] {
            assert_eq!(Word::decode(bytes), None, "{bytes:?}");
        }
    }
}
