//! Light and colours: the sun, the air, light and dark pictures. They are those of the page.
//!
//! What is computed is light, 0 to 1 a channel; bytes are its square root, which is near to sRGB and cheap.

use super::scales::Scale;
use simbeeotic_units::glam::Vec3;

/// Towards the sun: from the south-west, high. A unit vector.
pub(super) const SUN: Vec3 = Vec3::new(-0.521_856, -0.361_285, 0.772_748);

/// A colour of bytes as light.
pub(super) fn light_of([r, g, b]: [u8; 3]) -> Vec3 {
    let part = Vec3::new(f32::from(r), f32::from(g), f32::from(b)) / 255.0;
    part * part
}

/// Light as bytes.
pub(super) fn bytes_of(light: Vec3) -> [u8; 3] {
    let part = |x: f32| (x.clamp(0.0, 1.0).sqrt() * 255.0 + 0.5) as u8;
    [part(light.x), part(light.y), part(light.z)]
}

/// Between 0 and 1, smoothly, from one number to another.
pub(super) fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A colour between two.
pub(super) fn mix(a: [u8; 3], b: [u8; 3], share: f32) -> [u8; 3] {
    let share = share.clamp(0.0, 1.0);
    std::array::from_fn(|k| {
        let (a, b) = (f32::from(a[k]), f32::from(b[k]));
        (a + share * (b - a) + 0.5) as u8
    })
}

/// How far one sees: between these two distances from the eye everything fades into the horizon, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Haze {
    pub(super) from_m: f32,
    pub(super) to_m: f32,
    pub(super) light: Vec3,
}

impl Haze {
    /// The air's share of what is seen so far away.
    pub(super) fn share(&self, away_m: f32) -> f32 {
        smooth(self.from_m, self.to_m, away_m)
    }

    /// Light from so far away.
    pub(super) fn over(&self, light: Vec3, away_m: f32) -> Vec3 {
        light.lerp(self.light, self.share(away_m))
    }
}

/// The colours around the things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Theme {
    /// Light of the sun, of the sky, and of the ground from below.
    sun: Vec3,
    sky: Vec3,
    earth: Vec3,
    /// The light of the sky above, and at the horizon.
    pub(super) zenith: Vec3,
    pub(super) horizon: Vec3,
    /// The colour of the ground.
    pub(super) ground: [u8; 3],
    /// The light of the lines on the ground, and of the ground cut through.
    pub(super) grid: Vec3,
    pub(super) cut: Vec3,
    /// What a ground of middle grey becomes, 0 to 1; how much stays of what is lighter or darker, and of the hue.
    level: Vec3,
    keep: [f32; 2],
    /// What of their colour the things of the world keep, so that vehicles stand out.
    pub(super) tone: f32,
    /// What vehicles shine by themselves.
    pub(super) glow: f32,
    /// Words, and what keeps them apart from what is below.
    pub(super) ink: [u8; 3],
    pub(super) paper: [u8; 3],
    /// The rim of small things.
    pub(super) rim: [u8; 3],
    /// The colours of radio links, from weak to strong.
    pub(super) signal: Scale,
    /// Arrows of the wind.
    pub(super) wind: [u8; 3],
}

impl Theme {
    /// `ground`: the world's own colour of the ground.
    pub(super) fn new(dark: bool, ground: [u8; 4]) -> Self {
        let [r, g, b, _] = ground;
        if dark {
            Self {
                sun: Vec3::new(0.36, 0.4, 0.5),
                sky: Vec3::new(0.28, 0.33, 0.44),
                earth: Vec3::new(0.16, 0.17, 0.2),
                zenith: light_of([0x0a, 0x0f, 0x18]),
                horizon: light_of([0x2a, 0x36, 0x44]),
                ground: [r, g, b],
                grid: light_of([0x7d, 0x90, 0xa6]),
                cut: light_of([0x0f, 0x14, 0x1b]),
                level: Vec3::new(0.15, 0.17, 0.2),
                keep: [0.12, 0.24],
                tone: 0.9,
                glow: 0.5,
                ink: [0xe8, 0xec, 0xf2],
                paper: [0x14, 0x18, 0x1f],
                rim: [0x06, 0x08, 0x0b],
                signal: Scale::SignalDark,
                wind: [0x7f, 0xc9, 0xf9],
            }
        } else {
            Self {
                sun: Vec3::new(0.86, 0.8, 0.69),
                sky: Vec3::new(0.46, 0.52, 0.6),
                earth: Vec3::new(0.27, 0.26, 0.24),
                zenith: light_of([0x7f, 0xab, 0xd6]),
                horizon: light_of([0xdb, 0xe6, 0xee]),
                ground: [r, g, b],
                grid: light_of([0x3c, 0x4a, 0x46]),
                cut: light_of([0xb3, 0xb9, 0xae]),
                level: Vec3::new(0.765, 0.77, 0.75),
                keep: [0.26, 0.8],
                tone: 1.0,
                glow: 0.16,
                ink: [0x22, 0x27, 0x2e],
                paper: [0xff, 0xff, 0xff],
                rim: [0x2b, 0x24, 0x16],
                signal: Scale::Signal,
                wind: [0x33, 0x82, 0xc9],
            }
        }
    }

    /// What a matt surface that faces a direction sends on, in the sun (1) or in the shadow (0).
    pub(super) fn lit(&self, colour: Vec3, normal: Vec3, sun: f32) -> Vec3 {
        let sky = self.earth.lerp(self.sky, 0.5 + 0.5 * normal.z);
        colour * (sky + self.sun * (normal.dot(SUN).max(0.0) * sun))
    }

    /// A thing of the world at its corner, as bytes.
    pub(super) fn lit_bytes(&self, [r, g, b, alpha]: [u8; 4], normal: Vec3) -> [u8; 4] {
        let lit = self.lit(light_of([r, g, b]) * self.tone, normal, 1.0);
        let [r, g, b] = bytes_of(lit);
        [r, g, b, alpha]
    }

    /// A vehicle at its corner, as bytes: a little brighter than the world.
    pub(super) fn body_bytes(&self, [r, g, b, alpha]: [u8; 4], normal: Vec3) -> [u8; 4] {
        let own = light_of([r, g, b]);
        let [r, g, b] = bytes_of(self.lit(own, normal, 1.0) + own * self.glow);
        [r, g, b, alpha]
    }

    /// How the ground is toned down, 0 to 1 a channel as bytes have it: it keeps its hue and its pattern, while the
    /// theme says how light it is, so that a swarm stands out on every ground.
    pub(super) fn toned(&self, colour: Vec3) -> Vec3 {
        let light = colour.dot(Vec3::new(0.3, 0.6, 0.1));
        let hue = colour - light;
        // A strong hue is held back: no ground shouts.
        let hue = hue * (self.keep[1] / (1.0 + 2.2 * hue.length()));
        let toned = self.level + (light - 0.5) * self.keep[0] + hue;
        toned.clamp(Vec3::ZERO, Vec3::ONE)
    }

    /// What a shadow leaves of the light of level ground.
    pub(super) fn shade(&self) -> Vec3 {
        self.sky / (self.sky + self.sun * SUN.z)
    }

    /// What terrain sends on: as light as the theme has it where it faces the sun.
    pub(super) fn lit_ground(&self, colour: Vec3, normal: Vec3, sun: f32) -> Vec3 {
        self.lit(colour, normal, sun) / self.lit(Vec3::ONE, SUN, 1.0)
    }

    /// What a shadow leaves of the bytes of level ground, in 256ths.
    pub(super) fn shadow(&self) -> [u16; 3] {
        let share = self.shade();
        [share.x, share.y, share.z].map(|x| (x.sqrt() * 256.0) as u16)
    }

    /// The sky in a direction, and the glow around the sun: pale at the horizon, quickly deeper above it.
    pub(super) fn sky(&self, direction: Vec3) -> Vec3 {
        let low = 1.0 - direction.z.clamp(0.0, 1.0);
        let low = low * low;
        let sky = self
            .zenith
            .lerp(self.horizon, low * low * (0.35 + 0.65 * low));
        let sky = match direction.z < 0.0 {
            true => (self.horizon).lerp(self.cut, 0.5 * smooth(0.0, 0.6, -direction.z)),
            false => sky,
        };
        let near = direction.dot(SUN).max(0.0);
        let near = near * near * near * near;
        sky + self.sun * (0.1 * near * near)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_faces_the_sun_is_lighter_than_what_faces_away() {
        for dark in [false, true] {
            let theme = Theme::new(dark, [0; 4]);
            let grey = [100, 100, 100, 255];
            assert!((SUN.length() - 1.0).abs() < 1e-5);
            let [sun, up, down] = [SUN, Vec3::Z, -SUN].map(|n| theme.lit_bytes(grey, n)[0]);
            assert!(sun > up && up > down && down > 20, "{sun} {up} {down}");
        }
    }

    #[test]
    fn a_shadow_is_what_the_sky_alone_gives() {
        let theme = Theme::new(false, [0; 4]);
        let own = light_of([120, 150, 90]);
        let [sun, shade] = [1.0, 0.0].map(|sun| bytes_of(theme.lit(own, Vec3::Z, sun)));
        for ((lit, dark), keep) in sun.into_iter().zip(shade).zip(theme.shadow()) {
            let darkened = (u16::from(lit) * keep / 256) as u8;
            assert!(darkened.abs_diff(dark) <= 1, "{darkened} {dark}");
        }
    }

    #[test]
    fn every_ground_becomes_as_light_as_the_theme_wants_and_keeps_its_hue() {
        for (dark, from, to) in [(false, 0.6, 0.92), (true, 0.08, 0.3)] {
            let theme = Theme::new(dark, [0; 4]);
            for ground in [
                Vec3::new(0.0, 0.4, 0.0),
                Vec3::ONE,
                Vec3::new(0.6, 0.5, 0.3),
            ] {
                let toned = theme.toned(ground);
                assert!((from..to).contains(&toned.y), "{ground} {toned}");
            }
            let green = theme.toned(Vec3::new(0.1, 0.5, 0.1));
            assert!(green.y > green.x && green.y > green.z, "{green}");
        }
    }

    #[test]
    fn bytes_come_back_from_light() {
        for byte in [0, 1, 17, 128, 254, 255] {
            assert_eq!(bytes_of(light_of([byte; 3])), [byte; 3]);
        }
    }
}
