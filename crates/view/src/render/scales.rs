//! The colours of kinds and of numbers: those of the page, which people with any colour vision can tell apart.

use super::light::mix;

/// Kinds, in the order of use; after M. Okabe and K. Ito, *Color universal design* (2008), made to stand out on
/// grass and at night.
const KINDS: [[u8; 3]; 10] = [
    [0xff, 0xb0, 0x00],
    [0x3d, 0xa5, 0xff],
    [0xff, 0x5c, 0x4d],
    [0x00, 0xc2, 0xa0],
    [0xe0, 0x6b, 0xd0],
    [0xff, 0xf2, 0x7a],
    [0x8f, 0x7b, 0xff],
    [0xff, 0x9e, 0xc0],
    [0xa3, 0xe6, 0x35],
    [0xc8, 0xc8, 0xd0],
];

/// A colour for one more kind, that can be told from all that are taken; if there is none left, they repeat.
pub(super) fn kind(taken: &[[u8; 3]], place: usize) -> [u8; 3] {
    let free = |colour: &&[u8; 3]| taken.iter().all(|other| apart(**colour, *other));
    *KINDS
        .iter()
        .find(free)
        .unwrap_or(&KINDS[place % KINDS.len()])
}

/// Whether two colours can be told apart at a glance.
fn apart(a: [u8; 3], b: [u8; 3]) -> bool {
    let off = (0..3).map(|k| i32::from(a[k].abs_diff(b[k])).pow(2));
    off.sum::<i32>() > 70 * 70
}

/// The colours of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Scale {
    /// *viridis* of N. Smith and S. van der Walt (2015), public domain.
    #[default]
    Value,
    /// *plasma* of the same.
    Speed,
    /// From empty to full.
    Battery,
}

const VIRIDIS: [[u8; 3]; 9] = [
    [0x44, 0x01, 0x54],
    [0x47, 0x2d, 0x7b],
    [0x3b, 0x52, 0x8b],
    [0x2c, 0x72, 0x8e],
    [0x21, 0x91, 0x8c],
    [0x28, 0xae, 0x80],
    [0x5e, 0xc9, 0x62],
    [0xad, 0xdc, 0x30],
    [0xfd, 0xe7, 0x25],
];

const PLASMA: [[u8; 3]; 10] = [
    [0x3b, 0x0f, 0x9b],
    [0x6a, 0x00, 0xa8],
    [0x90, 0x0d, 0xa4],
    [0xb1, 0x2a, 0x90],
    [0xcc, 0x47, 0x78],
    [0xe1, 0x64, 0x62],
    [0xf2, 0x84, 0x4b],
    [0xfc, 0xa6, 0x36],
    [0xfc, 0xce, 0x25],
    [0xf0, 0xf9, 0x21],
];

const CHARGE: [[u8; 3]; 7] = [
    [0xc1, 0x12, 0x1f],
    [0xe8, 0x59, 0x0c],
    [0xf9, 0xa0, 0x3f],
    [0xfd, 0xe2, 0xa0],
    [0xa8, 0xd5, 0xe5],
    [0x5f, 0xa8, 0xd3],
    [0x1d, 0x6f, 0xb8],
];

impl Scale {
    /// The colour of a share, 0 to 1; grey for what is not known.
    pub(super) fn colour(self, share: f64) -> [u8; 3] {
        if share.is_nan() {
            return [148; 3];
        }
        let stops: &[[u8; 3]] = match self {
            Self::Value => &VIRIDIS,
            Self::Speed => &PLASMA,
            Self::Battery => &CHARGE,
        };
        let last = stops.len() - 1;
        let at = share.clamp(0.0, 1.0) * last as f64;
        let low = (at.floor() as usize).min(last - 1);
        mix(stops[low], stops[low + 1], (at - low as f64) as f32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_is_always_lighter() {
        for scale in [Scale::Value, Scale::Speed] {
            let light = |share: f64| {
                let [r, g, b] = scale.colour(share).map(f64::from);
                0.2126 * r + 0.7152 * g + 0.0722 * b
            };
            for step in 0..50 {
                let share = f64::from(step) / 50.0;
                // Bytes are whole numbers.
                assert!(
                    light(share + 0.02) > light(share) - 1.0,
                    "{scale:?} {share}"
                );
            }
            assert_eq!(scale.colour(-1.0), scale.colour(0.0));
            assert_eq!(scale.colour(f64::INFINITY), scale.colour(1.0));
        }
    }

    #[test]
    fn kinds_do_not_take_a_colour_that_is_taken() {
        let mut taken = vec![[0xfa, 0xb0, 0x10]];
        for place in 0..6 {
            let own = kind(&taken, place);
            assert!(taken.iter().all(|other| apart(own, *other)), "{place}");
            taken.push(own);
        }
        // When all are taken they repeat.
        assert_eq!(kind(&KINDS, 11), KINDS[1]);
    }
}
