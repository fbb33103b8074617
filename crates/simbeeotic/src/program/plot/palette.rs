//! Colours that the colour-blind tell apart too.

use super::sheet::Ink;

/// Series, after M. Okabe and K. Ito, *Color universal design* (2008), in the order of use; for more
/// series than there are, grey.
const SERIES: [[u8; 3]; 7] = [
    [0x00, 0x72, 0xb2],
    [0xe6, 0x9f, 0x00],
    [0x00, 0x9e, 0x73],
    [0xd5, 0x5e, 0x00],
    [0x56, 0xb4, 0xe9],
    [0xcc, 0x79, 0xa7],
    [0xb8, 0xa9, 0x00],
];

/// The colour of a series.
pub(crate) fn series(place: usize) -> Ink {
    Ink::new(SERIES.get(place).copied().unwrap_or([0x99; 3]))
}

/// Dash and gap of means that are held against each other, in the order of use, so that they are told apart without
/// colours; none: drawn through.
const DASHES: [Option<[f64; 2]>; 4] =
    [None, Some([11.0, 4.0]), Some([3.0, 3.0]), Some([18.0, 5.0])];

/// The dashes of a series.
pub(crate) fn dashes(place: usize) -> Option<[f64; 2]> {
    DASHES[place % DASHES.len()]
}

/// From little (light orange) to all (dark blue): lightness falls all the way, so that it reads in grey.
const RAMP: [[f64; 3]; 5] = [
    [248.0, 190.0, 110.0],
    [235.0, 132.0, 92.0],
    [186.0, 88.0, 120.0],
    [104.0, 66.0, 130.0],
    [24.0, 40.0, 104.0],
];

/// The colour of a share, 0 to 1.
pub(crate) fn ramp(share: f64) -> Ink {
    let last = RAMP.len() - 1;
    let at = share.clamp(0.0, 1.0) * last as f64;
    let low = (at.floor() as usize).min(last - 1);
    let part = at - low as f64;
    let mix = |k: usize| RAMP[low][k] + part * (RAMP[low + 1][k] - RAMP[low][k]);
    Ink::new([mix(0), mix(1), mix(2)].map(|value| value.round() as u8))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_is_always_darker() {
        // Relative luminance, near enough for an order.
        let light = |share: f64| {
            let [r, g, b] = ramp(share).rgb.map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for step in 0..100 {
            let share = f64::from(step) / 100.0;
            assert!(light(share + 0.01) < light(share), "{share}");
        }
        assert_eq!(ramp(-1.0), ramp(0.0));
        assert_eq!(ramp(f64::INFINITY), ramp(1.0));
    }
}
