//! Flowers, as the page draws them: a stem with leaves, and petals around a yellow middle.

use super::solid::{Facet, turn_of};
use simbeeotic_record::stage::{Form, Piece, Prop};
use simbeeotic_units::glam::{DQuat, DVec3, Vec3};
use simbeeotic_units::math;
use std::f64::consts::{PI, TAU};
use std::sync::OnceLock;

/// From so many flowers on each has fewer triangles.
pub(super) const MANY: usize = 3000;

/// A colour over that of a thing, and how much of it there is, 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tint([f32; 3], f32);

const OWN: Tint = Tint([0.0; 3], 0.0);
const LEAF: Tint = Tint([0.34, 0.55, 0.2], 0.9);
const YOLK: Tint = Tint([0.98, 0.76, 0.1], 0.95);
const DEEP: Tint = Tint([0.25, 0.02, 0.12], 0.3);
const LIGHT: Tint = Tint([1.0; 3], 0.22);

impl Tint {
    /// This over a colour.
    pub(super) fn over(self, [r, g, b, alpha]: [u8; 4]) -> [u8; 4] {
        let Self(rgb, share) = self;
        let part = |own: u8, k: usize| {
            let own = f32::from(own);
            (own + share * (255.0 * rgb[k] - own) + 0.5).clamp(0.0, 255.0) as u8
        };
        [part(r, 0), part(g, 1), part(b, 2), alpha]
    }
}

/// Petals reach so far beyond the disc that a head is to physics, so that a field of flowers is seen from afar.
const HEAD: f32 = 1.4;

type Tinted = (Facet, [Tint; 3]);

/// A part of a flower, standing somewhere.
pub(super) struct Part {
    pub(super) facets: &'static [Tinted],
    pub(super) rgba: [u8; 4],
    place_m: DVec3,
    turn: DQuat,
    size_m: Vec3,
}

impl Part {
    /// A corner in the world around an origin.
    pub(super) fn moved(&self, corner: Vec3, origin_m: DVec3) -> Vec3 {
        let own = (corner * self.size_m).as_dvec3();
        (self.turn * own + (self.place_m - origin_m)).as_vec3()
    }

    /// A direction in the world.
    pub(super) fn turned(&self, normal: Vec3) -> Vec3 {
        let own = (normal / self.size_m).normalize_or(Vec3::Z);
        (self.turn * own.as_dvec3()).as_vec3()
    }
}

/// The parts of a flower; `None` if a thing is none, or has no stem and head. `number` is its place in the stage: no
/// two flowers look the same way.
pub(super) fn parts(prop: &Prop, number: usize, fine: bool) -> Option<Vec<Part>> {
    if prop.kind != "flower" || prop.pieces.len() < 2 {
        return None;
    }
    let height = |piece: &Piece| piece.position_m[2];
    let head = (0..prop.pieces.len())
        .max_by(|a, b| height(&prop.pieces[*a]).total_cmp(&height(&prop.pieces[*b])))?;
    let [r, g, b, alpha] = prop.color;
    let light = 0.86 + 0.14 * shade(number);
    let rgba = [r, g, b].map(|part| (f32::from(part) * light) as u8);
    let rgba = [rgba[0], rgba[1], rgba[2], alpha];
    let part = |(which, piece): (usize, &Piece)| {
        let Form::Cylinder {
            radius_m,
            top_m,
            half_height_m,
        } = piece.form
        else {
            return None;
        };
        let wide = radius_m.max(top_m).max(1e-4) as f32;
        let tall = half_height_m.max(1e-4) as f32;
        let (facets, turn, size_m) = if which == head {
            let own = turn_of(piece) * lean(number);
            let wide = HEAD * wide;
            (
                bloom(fine),
                own,
                Vec3::new(wide, wide, tall.max(0.32 * wide)),
            )
        } else {
            (stem(fine), turn_of(piece), Vec3::new(wide, wide, tall))
        };
        Some(Part {
            facets,
            rgba,
            place_m: DVec3::from(piece.position_m),
            turn,
            size_m,
        })
    };
    prop.pieces.iter().enumerate().map(part).collect()
}

/// A number from 0 to 1 that differs from flower to flower.
fn shade(number: usize) -> f32 {
    let (sin, _) = math::sin_cos(number as f64 * 12.9898);
    ((sin * 43_758.545_3) % 1.0).abs() as f32
}

/// Heads lean a little, each its own way.
fn lean(number: usize) -> DQuat {
    let way = number as f64 * 2.4;
    let (sin, cos) = math::sin_cos(way);
    let (wave, _) = math::sin_cos(number as f64 * 1.7);
    about(DVec3::new(cos, sin, 0.0), 0.25 + 0.2 * wave) * about(DVec3::Z, 3.0 * way)
}

fn about(axis: DVec3, angle: f64) -> DQuat {
    let (sin, cos) = math::sin_cos(0.5 * angle);
    let v = axis * sin;
    DQuat::from_xyzw(v.x, v.y, v.z, cos)
}

fn facet(corners: [Vec3; 3], normals: [Vec3; 3], tints: [Tint; 3]) -> Tinted {
    (Facet { corners, normals }, tints)
}

/// The stem of a flower, radius 1, half height 1; a fine one has two leaves.
fn stem(fine: bool) -> &'static [Tinted] {
    static STEMS: OnceLock<[Vec<Tinted>; 2]> = OnceLock::new();
    let [coarse, detailed] = STEMS.get_or_init(|| [made_stem(false), made_stem(true)]);
    if fine { detailed } else { coarse }
}

fn made_stem(fine: bool) -> Vec<Tinted> {
    let sides = if fine { 6 } else { 3 };
    let mut facets = Vec::new();
    let rim = |step: u32| {
        let (sin, cos) = math::sin_cos(TAU * f64::from(step % sides) / f64::from(sides));
        Vec3::new(cos as f32, sin as f32, 0.0)
    };
    for step in 0..sides {
        let (a, b) = (rim(step), rim(step + 1));
        let (low, high) = (Vec3::NEG_Z, Vec3::Z);
        facets.push(facet([a + low, b + low, b + high], [a, b, b], [LEAF; 3]));
        facets.push(facet([a + low, b + high, a + high], [a, b, a], [LEAF; 3]));
    }
    if fine {
        for turn in [0.4, 3.4] {
            let (sin, cos) = math::sin_cos(turn);
            let (sin, cos) = (sin as f32, cos as f32);
            let point = |x: f32, y: f32, z: f32| Vec3::new(x * cos - y * sin, x * sin + y * cos, z);
            let (root, tip) = (point(0.0, 0.0, -0.75), point(6.0, 0.0, -0.3));
            let (left, right) = (point(3.2, 1.6, -0.4), point(3.2, -1.6, -0.4));
            for corners in [[root, tip, left], [root, right, tip]] {
                facets.push(facet(corners, [Vec3::Z; 3], [LEAF; 3]));
            }
        }
    }
    facets
}

/// The head of a flower, radius 1, half height 1: cupped.
fn bloom(fine: bool) -> &'static [Tinted] {
    static BLOOMS: OnceLock<[Vec<Tinted>; 2]> = OnceLock::new();
    let [coarse, detailed] = BLOOMS.get_or_init(|| [made_bloom(false), made_bloom(true)]);
    if fine { detailed } else { coarse }
}

fn made_bloom(fine: bool) -> Vec<Tinted> {
    let (petals, sides) = if fine { (7, 8) } else { (5, 4) };
    let mut facets = Vec::new();
    let corner = |r: f32, phi: f64, z: f32| {
        let (sin, cos) = math::sin_cos(phi);
        let (sin, cos) = (sin as f32, cos as f32);
        (
            Vec3::new(r * cos, r * sin, z),
            Vec3::new(-0.3 * cos, -0.3 * sin, 0.95).normalize(),
        )
    };
    let mut put = |parts: [((Vec3, Vec3), Tint); 3]| {
        let [corners, normals] = [
            parts.map(|((place, _), _)| place),
            parts.map(|((_, normal), _)| normal),
        ];
        facets.push(facet(corners, normals, parts.map(|(_, tint)| tint)));
    };
    let half = PI / f64::from(petals) * 0.86;
    for petal in 0..petals {
        let phi = TAU * f64::from(petal) / f64::from(petals);
        // A kite: narrow at the middle, widest at two thirds, round enough at its tip.
        let (root, tip) = (corner(0.12, phi, 0.0), corner(1.0, phi, 1.0));
        let [left, right] = [-half, half].map(|off| corner(0.72, phi + off, 0.7));
        put([(root, DEEP), (left, OWN), (tip, LIGHT)]);
        put([(root, DEEP), (tip, LIGHT), (right, OWN)]);
        if fine {
            let [a, b] = [-0.6 * half, 0.6 * half].map(|off| corner(0.95, phi + off, 0.95));
            put([(left, OWN), (a, LIGHT), (tip, LIGHT)]);
            put([(tip, LIGHT), (b, LIGHT), (right, OWN)]);
        }
    }
    for side in 0..sides {
        let at = |step: i32| corner(0.3, TAU * f64::from(step) / f64::from(sides), 0.6);
        let top = (Vec3::new(0.0, 0.0, 1.6), Vec3::Z);
        put([(at(side), YOLK), (at(side + 1), YOLK), (top, YOLK)]);
    }
    facets
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flower() -> Prop {
        let piece = |radius_m: f64, half_height_m: f64, z: f64| {
            let form = Form::Cylinder {
                radius_m,
                top_m: radius_m,
                half_height_m,
            };
            Piece {
                position_m: [3.0, 4.0, z],
                ..Piece::at_origin(form)
            }
        };
        Prop {
            kind: "flower".to_owned(),
            color: [200, 60, 90, 255],
            pieces: vec![piece(0.01, 0.25, 0.25), piece(0.1, 0.01, 0.5)],
            ..Prop::default()
        }
    }

    #[test]
    fn a_head_is_a_little_wider_than_it_was_and_sits_on_its_stem() {
        for (number, fine) in [(0, true), (7, false), (4711, true)] {
            let parts = parts(&flower(), number, fine).expect("a flower");
            assert_eq!(parts.len(), 2);
            let far = |part: &Part| {
                let corners = part.facets.iter().flat_map(|(facet, _)| facet.corners);
                let off = corners.map(|c| part.moved(c, part.place_m).length());
                off.fold(0.0, f32::max)
            };
            assert!(
                (0.1 * HEAD..0.13 * HEAD).contains(&far(&parts[1])),
                "{}",
                far(&parts[1])
            );
            assert!((0.25..0.26).contains(&far(&parts[0])));
        }
    }

    #[test]
    fn what_is_no_flower_has_no_parts() {
        let stone = Prop {
            kind: "obstacle".to_owned(),
            ..flower()
        };
        assert!(parts(&stone, 0, true).is_none());
        let mut bare = flower();
        bare.pieces.pop();
        assert!(parts(&bare, 0, true).is_none());
    }

    #[test]
    fn a_tint_of_no_share_leaves_the_colour() {
        assert_eq!(OWN.over([1, 2, 3, 4]), [1, 2, 3, 4]);
        assert_eq!(YOLK.over([0, 0, 0, 255])[0], 237);
    }
}
