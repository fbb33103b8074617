//! Light and colours: the sun, the air, light and dark pictures, scales.

use simbeeotic_units::glam::Vec3;

/// Towards the sun: from the south-west, high.
pub(super) const SUN: Vec3 = Vec3::new(-0.42, -0.34, 0.841_4);

/// A colour in the light, on a surface that faces a direction.
pub(super) fn lit([r, g, b, alpha]: [u8; 4], normal: Vec3) -> [u8; 4] {
    let sky = 0.5 + 0.5 * normal.z;
    let light = 0.5 + 0.18 * sky + 0.42 * normal.dot(SUN).max(0.0);
    let part = |colour: u8| (f32::from(colour) * light + 0.5).min(255.0) as u8;
    [part(r), part(g), part(b), alpha]
}

/// A colour between two.
pub(super) fn mix(a: [u8; 3], b: [u8; 3], share: f32) -> [u8; 3] {
    let share = share.clamp(0.0, 1.0);
    std::array::from_fn(|k| {
        let (a, b) = (f32::from(a[k]), f32::from(b[k]));
        (a + share * (b - a) + 0.5) as u8
    })
}

/// The colours around the things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Theme {
    /// The sky above, and at the horizon.
    pub(super) zenith: [u8; 3],
    pub(super) horizon: [u8; 3],
    pub(super) ground: [u8; 3],
    /// Lines on the ground.
    pub(super) grid: [u8; 3],
    /// Words, and what keeps them apart from what is below.
    pub(super) ink: [u8; 3],
    pub(super) paper: [u8; 3],
    /// The rim of small things.
    pub(super) rim: [u8; 3],
    /// What a shadow leaves, in 256ths.
    pub(super) shadow: u16,
}

impl Theme {
    /// `ground`: the world's own colour of the ground, which is toned down so that the swarm stands out.
    pub(super) fn new(dark: bool, ground: [u8; 4]) -> Self {
        let [r, g, b, _] = ground;
        let own = [r, g, b];
        if dark {
            Self {
                zenith: [0x0e, 0x12, 0x1a],
                horizon: [0x2a, 0x32, 0x3f],
                ground: mix(own, [0x18, 0x1d, 0x24], 0.86),
                grid: [0x6b, 0x78, 0x88],
                ink: [0xe8, 0xec, 0xf2],
                paper: [0x14, 0x18, 0x1f],
                rim: [0x06, 0x08, 0x0b],
                shadow: 150,
            }
        } else {
            Self {
                zenith: [0xa9, 0xc8, 0xe6],
                horizon: [0xf2, 0xf5, 0xf7],
                ground: mix(own, [0xf1, 0xf1, 0xea], 0.72),
                grid: [0x6c, 0x76, 0x70],
                ink: [0x22, 0x27, 0x2e],
                paper: [0xff, 0xff, 0xff],
                rim: [0x2b, 0x24, 0x16],
                shadow: 196,
            }
        }
    }
}

/// Colours that the colour-blind tell apart too, after M. Okabe and K. Ito, *Color universal design* (2008),
/// in the order of use.
const KINDS: [[u8; 3]; 8] = [
    [0xf0, 0xa5, 0x0a],
    [0x00, 0x72, 0xb2],
    [0x00, 0x9e, 0x73],
    [0xd5, 0x5e, 0x00],
    [0x56, 0xb4, 0xe9],
    [0xcc, 0x79, 0xa7],
    [0xf0, 0xe4, 0x42],
    [0x99, 0x99, 0x99],
];

/// The colour of the n-th kind; they repeat.
pub(super) fn kind(place: usize) -> [u8; 3] {
    KINDS[place % KINDS.len()]
}

/// From little to much; lightness rises all the way, so that it reads in grey. After *plasma* of
/// N. Smith and S. van der Walt (2015), public domain.
pub(super) const RAMP: [[u8; 3]; 8] = [
    [0x3a, 0x04, 0x9a],
    [0x72, 0x01, 0xa8],
    [0x9c, 0x17, 0x9e],
    [0xbd, 0x37, 0x86],
    [0xd8, 0x57, 0x6b],
    [0xed, 0x79, 0x53],
    [0xfb, 0x9f, 0x3a],
    [0xfd, 0xca, 0x26],
];

/// The colour of a share, 0 to 1; grey for what is not known.
pub(super) fn ramp(share: f64) -> [u8; 3] {
    if share.is_nan() {
        return [0x9a, 0x9a, 0x9a];
    }
    let last = RAMP.len() - 1;
    let at = share.clamp(0.0, 1.0) * last as f64;
    let low = (at.floor() as usize).min(last - 1);
    mix(RAMP[low], RAMP[low + 1], (at - low as f64) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_is_always_lighter() {
        let light = |share: f64| {
            let [r, g, b] = ramp(share).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for step in 0..50 {
            let share = f64::from(step) / 50.0;
            assert!(light(share + 0.02) > light(share), "{share}");
        }
        assert_eq!(ramp(-1.0), ramp(0.0));
        assert_eq!(ramp(f64::INFINITY), ramp(1.0));
    }

    #[test]
    fn what_faces_the_sun_is_lighter_than_what_faces_away() {
        let grey = [100, 100, 100, 255];
        assert!(SUN.is_normalized());
        let [sun, up, down] = [SUN, Vec3::Z, -SUN].map(|n| lit(grey, n)[0]);
        assert!(sun > up && up > down && down > 40, "{sun} {up} {down}");
    }
}
