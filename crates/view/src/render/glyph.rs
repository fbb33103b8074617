//! What a vehicle looks like: a bee from near, a dart from far.

use super::camera::Projector;
use super::light::{self, Theme, mix};
use super::solid::{Facet, revolved};
use super::triangle::{Batch, Triangle};
use simbeeotic_units::glam::{DVec3, Vec3};
use simbeeotic_units::math;
use std::sync::OnceLock;

/// From this radius on, in pixels of the finished picture, a vehicle is drawn as a body.
const BODY_LEAST: f32 = 9.0;
/// And from this one on, with more corners.
const BODY_FINE: f32 = 26.0;
/// A bee's outline is so many times as large as the ball that its body is to physics.
const LARGER: f32 = 1.3;

/// One vehicle to be drawn.
pub(super) struct Glyph {
    /// Around the projector's origin, m.
    pub(super) place: Vec3,
    /// Body axes in the world: forward, left, up.
    pub(super) axes: [Vec3; 3],
    /// Radius of its body, m.
    pub(super) radius_m: f32,
    pub(super) rgb: [u8; 3],
    pub(super) alpha: u8,
    /// It is drawn at least so large, pixels of the finished picture.
    pub(super) least_px: f32,
    /// Drawn pixels for each of the finished picture.
    pub(super) fineness: f32,
    /// Whether it throws a shadow.
    pub(super) shadow: bool,
}

/// What a part of a bee has its colour from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Tone {
    Own,
    Dark,
    Wing,
}

/// A bee of radius 1, nose along `x`.
struct Bee {
    facets: Vec<(Facet, Tone)>,
}

impl Bee {
    fn new(around: usize, along: usize) -> Self {
        let mut facets = Vec::new();
        let mut ball = |middle: Vec3, radii: Vec3, tone: &dyn Fn(f32) -> Tone| {
            for facet in ellipsoid(middle, radii, around, along) {
                // Both halves of a patch have one colour.
                let [a, b, c] = facet.corners.map(|corner| corner.x);
                let x = 0.5 * (a.min(b).min(c) + a.max(b).max(c));
                facets.push((facet, tone((x - middle.x) / radii.x)));
            }
        };
        // The abdomen with its stripes, the thorax, the head.
        let stripes = |x: f32| match x {
            x if x < -0.72 => Tone::Dark,
            x if (-0.42..-0.12).contains(&x) => Tone::Dark,
            x if (0.2..0.5).contains(&x) => Tone::Dark,
            _ => Tone::Own,
        };
        ball(
            Vec3::new(-0.38, 0.0, -0.04),
            Vec3::new(0.62, 0.4, 0.38),
            &stripes,
        );
        ball(
            Vec3::new(0.3, 0.0, 0.04),
            Vec3::new(0.36, 0.34, 0.33),
            &|_| Tone::Own,
        );
        ball(
            Vec3::new(0.72, 0.0, 0.0),
            Vec3::new(0.25, 0.27, 0.25),
            &|_| Tone::Dark,
        );
        for side in [-1.0, 1.0_f32] {
            for (x, length, breadth, back) in [(0.2, 1.05, 0.3, 0.1), (-0.08, 0.74, 0.24, 0.45)] {
                let root = Vec3::new(x, 0.12 * side, 0.3);
                let along = Vec3::new(-back, side, 0.28).normalize() * length;
                let across = Vec3::new(1.0, side * back, 0.0).normalize() * breadth;
                facets.extend(wing(root, along, across, around).map(|f| (f, Tone::Wing)));
            }
        }
        Self { facets }
    }
}

/// A ball, stretched; its poles lie along `x`.
fn ellipsoid(
    middle: Vec3,
    radii: Vec3,
    around: usize,
    along: usize,
) -> impl Iterator<Item = Facet> {
    let outline: Vec<(Vec3, Vec3)> = (0..=along)
        .map(|step| {
            let angle = std::f64::consts::PI * (step as f64 / along as f64 - 0.5);
            let (sin, cos) = math::sin_cos(angle);
            let normal = Vec3::new(cos as f32, 0.0, sin as f32);
            (normal, normal)
        })
        .collect();
    // `z` becomes `x`: (x, y, z) to (z, x, y), which keeps the hand.
    let turned = |v: Vec3| Vec3::new(v.z, v.x, v.y);
    revolved(&outline, around)
        .into_iter()
        .map(move |facet| Facet {
            corners: facet.corners.map(|corner| middle + turned(corner) * radii),
            normals: facet.normals.map(|n| (turned(n) / radii).normalize()),
        })
}

/// A flat leaf from its root.
fn wing(root: Vec3, along: Vec3, across: Vec3, around: usize) -> impl Iterator<Item = Facet> {
    let normal = along.cross(across).normalize();
    let normal = if normal.z < 0.0 { -normal } else { normal };
    let steps = around.max(6);
    let point = move |step: usize| {
        let angle = std::f64::consts::TAU * (step % steps) as f64 / steps as f64;
        let (sin, cos) = math::sin_cos(angle);
        // Narrow at the root, round at the tip.
        let out = 0.5 - 0.5 * cos as f32;
        root + along * out + across * (sin as f32 * (0.55 + 0.45 * out))
    };
    (1..steps - 1).map(move |step| Facet {
        corners: [point(0), point(step), point(step + 1)],
        normals: [normal; 3],
    })
}

/// Draws one.
pub(super) fn draw(glyph: &Glyph, projector: &Projector, theme: &Theme, out: &mut Batch) {
    let Some((at, scale, near)) = projector.place(glyph.place) else {
        return;
    };
    let true_px = glyph.radius_m * LARGER * scale;
    let radius_px = true_px.max(glyph.least_px * glyph.fineness);
    let radius_m = radius_px / scale;
    if glyph.shadow {
        shadow(glyph, projector, radius_m, out);
    }
    if radius_px < BODY_LEAST * glyph.fineness {
        dart(glyph, projector, theme, (at, near, radius_px), out);
    } else {
        bee(
            glyph,
            projector,
            theme,
            radius_m,
            radius_px >= BODY_FINE,
            out,
        );
    }
}

fn bee(
    glyph: &Glyph,
    projector: &Projector,
    theme: &Theme,
    radius_m: f32,
    fine: bool,
    out: &mut Batch,
) {
    static BEES: OnceLock<[Bee; 2]> = OnceLock::new();
    let [coarse, detailed] = BEES.get_or_init(|| [Bee::new(8, 8), Bee::new(18, 20)]);
    let bee = if fine { detailed } else { coarse };
    let [forward, left, up] = glyph.axes;
    let turned = |v: Vec3| forward * v.x + left * v.y + up * v.z;
    let [r, g, b] = glyph.rgb;
    let [dark_r, dark_g, dark_b] = mix(glyph.rgb, [0x1c, 0x16, 0x10], 0.86);
    for (facet, tone) in &bee.facets {
        let corners = facet
            .corners
            .map(|corner| glyph.place + turned(corner) * radius_m);
        let rgba = match tone {
            Tone::Own => [r, g, b, glyph.alpha],
            Tone::Dark => [dark_r, dark_g, dark_b, glyph.alpha],
            Tone::Wing => [0xf4, 0xf7, 0xfa, (u16::from(glyph.alpha) * 150 / 255) as u8],
        };
        let rgba = facet
            .normals
            .map(|normal| theme.body_bytes(rgba, turned(normal)));
        let into = match *tone == Tone::Wing || glyph.alpha < 255 {
            true => &mut out.glass,
            false => &mut out.solid,
        };
        projector.triangle(corners, rgba, into);
    }
}

/// A dart in the plane of the picture, its tip where the nose is; short if it flies towards the camera.
fn dart(
    glyph: &Glyph,
    projector: &Projector,
    theme: &Theme,
    ([x, y], near, radius): ([f32; 2], f32, f32),
    out: &mut Batch,
) {
    let nose = projector.turned(glyph.axes[0]);
    let length = nose.truncate().length();
    let ahead = match length {
        length if length > 1e-3 => nose.truncate() / length,
        _ => Vec3::NEG_Y.truncate(),
    };
    let long = 0.55 + 0.45 * length.min(1.0);
    let aside = ahead.perp();
    let shape = |grow: f32| {
        let point = |along: f32, across: f32| {
            let at = ahead * along + aside * across;
            [x + at.x, y + at.y]
        };
        let size = radius + grow;
        // A rim of the same width all around wants a longer tip.
        [
            point(1.35 * size * long + 0.6 * grow, 0.0),
            point(-0.95 * size * long, 0.82 * size),
            point(-0.5 * size * long - 0.3 * grow, 0.0),
            point(-0.95 * size * long, -0.82 * size),
        ]
    };
    let mut put = |points: [[f32; 2]; 3], near: f32, [r, g, b]: [u8; 3]| {
        let triangle = Triangle::on_screen(points.map(|at| (at, near, [r, g, b, glyph.alpha])));
        match glyph.alpha {
            255 => out.solid.push(triangle),
            _ => out.glass.push(triangle),
        }
    };
    // Rim, then the two halves, one in the light.
    let body = projector.nearer(near, 0.5 * glyph.radius_m);
    let [tip, left, notch, right] = shape(0.22 * radius + 0.4);
    put([tip, left, notch], near, theme.rim);
    put([tip, notch, right], near, theme.rim);
    let [tip, left, notch, right] = shape(0.0);
    put([tip, left, notch], body, glyph.rgb);
    put([tip, notch, right], body, mix(glyph.rgb, [0; 3], 0.22));
}

/// A round shadow on the plane `z = 0`, where the sun puts it.
fn shadow(glyph: &Glyph, projector: &Projector, radius_m: f32, out: &mut Batch) {
    let height = f64::from(glyph.place.z) + projector.origin_m.z;
    if height <= 0.0 {
        return;
    }
    let Some(middle) = on_ground(glyph.place, projector.origin_m) else {
        return;
    };
    const CORNERS: usize = 8;
    let rim: [Vec3; CORNERS] = std::array::from_fn(|k| {
        // Corners of an octagon, without trigonometry for each of ten thousand.
        const D: f32 = std::f32::consts::FRAC_1_SQRT_2;
        let [x, y] = [
            [1.0, 0.0],
            [D, D],
            [0.0, 1.0],
            [-D, D],
            [-1.0, 0.0],
            [-D, -D],
            [0.0, -1.0],
            [D, -D],
        ][k];
        middle + 0.8 * radius_m * Vec3::new(x, y, 0.0)
    });
    for k in 1..CORNERS - 1 {
        projector.triangle([rim[0], rim[k], rim[k + 1]], [[0; 4]; 3], &mut out.shadows);
    }
}

/// Where the sun throws a point's shadow on the plane `z = 0`; both around an origin.
pub(super) fn on_ground(point: Vec3, origin_m: DVec3) -> Option<Vec3> {
    let height = point.z + origin_m.z as f32;
    (height >= -1e-3).then(|| point - light::SUN * (height.max(0.0) / light::SUN.z))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::camera::{Camera, Lens, Side};
    use crate::render::triangle::GRID;

    fn seen(radius_m: f32, nose: Vec3) -> Batch {
        let lens = Lens::Flat { scale: 10.0 };
        let camera = Camera::along(DVec3::ZERO, Side::Top.forward(), lens);
        let projector = Projector::new(&camera, [200, 200], DVec3::ZERO, 0.1, None);
        let mut batch = Batch::default();
        let glyph = Glyph {
            place: Vec3::new(1.0, 2.0, 3.0),
            axes: [nose, Vec3::Z.cross(nose), Vec3::Z],
            radius_m,
            rgb: [255, 0, 0],
            alpha: 255,
            least_px: 4.0,
            fineness: 1.0,
            shadow: true,
        };
        draw(&glyph, &projector, &Theme::new(false, [0; 4]), &mut batch);
        batch
    }

    fn width(batch: &Batch) -> f64 {
        let xs = || batch.solid.iter().flat_map(|t| t.x);
        f64::from(xs().max().unwrap_or(0) - xs().min().unwrap_or(0)) / f64::from(GRID)
    }

    #[test]
    fn the_smallest_is_some_pixels_wide_and_points_where_it_flies() {
        let tiny = seen(0.001, Vec3::X);
        assert!((7.0..14.0).contains(&width(&tiny)), "{}", width(&tiny));
        // The corner that is farthest to the right is the tip, and lies level with the place.
        let tips = tiny.solid.iter().flat_map(|t| t.x.into_iter().zip(t.y));
        let tip = tips.max_by_key(|(x, _)| *x).expect("drawn");
        assert_eq!(tip.1, 80 * GRID);
        assert_eq!(tiny.shadows.len(), 6);
    }

    #[test]
    fn a_large_one_has_its_size_and_wings() {
        let bee = seen(2.0, Vec3::X);
        let px = f64::from(2.0 * 10.0 * LARGER);
        assert!(
            (width(&bee) - 1.97 * px).abs() < 0.1 * px,
            "{}",
            width(&bee)
        );
        assert!(bee.solid.len() > 500 && bee.glass.len() > 20);
    }

    #[test]
    fn a_shadow_falls_away_from_the_sun() {
        let at = on_ground(10.0 * light::SUN, DVec3::ZERO).expect("above ground");
        assert!(at.length() < 1e-3, "{at}");
        let at = on_ground(Vec3::Z, DVec3::ZERO).expect("above ground");
        assert!(at.x > 0.5 && at.y > 0.4 && at.z == 0.0, "{at}");
        assert_eq!(on_ground(Vec3::new(0.0, 0.0, -1.0), DVec3::ZERO), None);
    }
}
