//! The colours of kinds and of numbers: those of the page, which people with any colour vision can tell apart.

use super::light::mix;

/// Kinds, in the order of use; after M. Okabe and K. Ito, *Color universal design* (2008), made to stand out on
/// grass and at night.
const KINDS: [u32; 10] = [
    0xffb000, 0x3da5ff, 0xff5c4d, 0x00c2a0, 0xe06bd0, 0xfff27a, 0x8f7bff, 0xff9ec0, 0xa3e635,
    0xc8c8d0,
];

/// A colour for one more kind, that can be told from all that are taken; if there is none left, they repeat.
pub(super) fn kind(taken: &[[u8; 3]], place: usize) -> [u8; 3] {
    let free = |colour: &[u8; 3]| taken.iter().all(|other| apart(*colour, *other));
    let found = KINDS.into_iter().map(rgb).find(free);
    found.unwrap_or(rgb(KINDS[place % KINDS.len()]))
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
    /// Radio, from weak to strong, on light and on dark.
    Signal,
    SignalDark,
}

/// Their colours from low to high.
const VIRIDIS: [u32; 9] = [
    0x440154, 0x472d7b, 0x3b528b, 0x2c728e, 0x21918c, 0x28ae80, 0x5ec962, 0xaddc30, 0xfde725,
];
const PLASMA: [u32; 10] = [
    0x3b0f9b, 0x6a00a8, 0x900da4, 0xb12a90, 0xcc4778, 0xe16462, 0xf2844b, 0xfca636, 0xfcce25,
    0xf0f921,
];
const CHARGE: [u32; 7] = [
    0xc1121f, 0xe8590c, 0xf9a03f, 0xfde2a0, 0xa8d5e5, 0x5fa8d3, 0x1d6fb8,
];
const SIGNAL: [u32; 4] = [0x8a7f9e, 0x6a66b8, 0x3f4fd0, 0x0b2bd0];
const SIGNAL_DARK: [u32; 4] = [0x7d88a8, 0x86b4e0, 0xa5e6ff, 0xf2fdff];

/// Red, green and blue of `0xrrggbb`.
const fn rgb(colour: u32) -> [u8; 3] {
    let [_, r, g, b] = colour.to_be_bytes();
    [r, g, b]
}

impl Scale {
    /// The colour of a share, 0 to 1; grey for what is not known.
    pub(super) fn colour(self, share: f64) -> [u8; 3] {
        if share.is_nan() {
            return [148; 3];
        }
        let stops: &[u32] = match self {
            Self::Value => &VIRIDIS,
            Self::Speed => &PLASMA,
            Self::Battery => &CHARGE,
            Self::Signal => &SIGNAL,
            Self::SignalDark => &SIGNAL_DARK,
        };
        let last = stops.len() - 1;
        let at = share.clamp(0.0, 1.0) * last as f64;
        let low = (at.floor() as usize).min(last - 1);
        mix(
            rgb(stops[low]),
            rgb(stops[low + 1]),
            (at - low as f64) as f32,
        )
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
        assert_eq!(kind(&KINDS.map(rgb), 11), rgb(KINDS[1]));
    }
}
