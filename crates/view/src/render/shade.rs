//! The colour of what stands still, at a place of the picture.

use super::backdrop::Backdrop;
use super::light::{Haze, Theme, bytes_of, smooth};
use super::shadow::Shadows;
use super::skins::Skins;
use super::solid::Face;
use super::visible::Sight;
use simbeeotic_units::glam::{DVec3, Vec3};

/// All that a colour depends on.
pub(super) struct Shade<'a> {
    pub(super) backdrop: &'a Backdrop,
    pub(super) faces: &'a [Face],
    pub(super) skins: &'a Skins,
    /// The picture of the ground, by its place among them.
    pub(super) ground: Option<u16>,
    pub(super) shadows: Option<&'a Shadows>,
    pub(super) theme: &'a Theme,
    pub(super) haze: Option<Haze>,
    pub(super) origin_m: DVec3,
}

impl Shade<'_> {
    /// The colour of what is seen, and whether the sun does not reach it.
    pub(super) fn colour(&self, sight: &Sight) -> ([u8; 3], bool) {
        let Some(face) = self.faces.get(sight.face as usize) else {
            let sun = |point: DVec3| self.sun((point - self.origin_m).as_vec3(), Vec3::Z);
            let (light, sun) =
                self.backdrop
                    .light(sight.face, sight.at, self.skins.get(self.ground), sun);
            return (bytes_of(light), sun < 0.5);
        };
        let (point, direction, depth, pixel_m) = self.backdrop.point(sight.at, sight.near);
        let local = (point - self.origin_m).as_vec3();
        let [a, b, c] = face.corners;
        let shares = shares([a, b, c], local);
        let mixed = |of: [Vec3; 3]| of[0] * shares[0] + of[1] * shares[1] + of[2] * shares[2];

        let mut normal = mixed(face.normals).normalize_or(Vec3::Z);
        let direction = direction.normalize().as_vec3();
        let flat = (b - a).cross(c - a).normalize_or(normal);
        // The inner side of what is open.
        if flat.dot(direction) * flat.dot(normal) > 0.0 {
            normal = -normal;
        }
        let colours = face
            .rgba
            .map(|[r, g, b, _]| Vec3::new(f32::from(r), f32::from(g), f32::from(b)) / 255.0);
        let own = mixed(colours).clamp(Vec3::ZERO, Vec3::ONE);
        let own = match self.skins.get(face.skin) {
            Some(skin) => {
                let at = |k: usize| (0..3).map(|c| shares[c] * face.at_m[c][k]).sum::<f32>();
                // Flat to the line of sight a pixel is long; what is between wide and long looks best.
                let slant = flat.dot(direction).abs().max(0.06).sqrt();
                dyed(own, skin.at([at(0), at(1)], pixel_m as f32 / slant))
            }
            None => own * own,
        };
        let sun = if face.shaded {
            self.sun(local, normal)
        } else {
            1.0
        };
        let mut light = self.theme.lit(own * self.theme.tone, normal, sun);
        if face.terrain {
            let toned = self.theme.toned(own.max(Vec3::ZERO).map(f32::sqrt));
            light = self.theme.lit_ground(toned * toned, normal, sun);
            let level = pixel_m / f64::from(flat.dot(direction).abs().max(0.05));
            light = self.backdrop.gridded(light, point, [level; 2], 1.0);
        } else {
            // Less sky is seen close to the ground.
            light *= 0.82 + 0.18 * smooth(0.0, 0.5, point.z as f32);
        }
        if let Some(haze) = self.haze {
            light = haze.over(light, depth as f32);
        }
        (bytes_of(light), sun < 0.5)
    }

    fn sun(&self, local: Vec3, normal: Vec3) -> f32 {
        self.shadows
            .map_or(1.0, |shadows| shadows.sun_at(local, normal))
    }
}

/// The light of a picture on a thing: one that is grey shows the picture as it is, one with a colour of its own is
/// dyed.
fn dyed(own: Vec3, picture: Vec3) -> Vec3 {
    let (high, low) = (own.max_element(), own.min_element());
    let colourful = if high > 0.0 { (high - low) / high } else { 0.0 };
    let dye = smooth(0.08, 0.3, colourful);
    let strong = picture.dot(Vec3::new(0.65, 1.2, 0.5));
    (picture * picture).lerp(own * own * strong, dye)
}

/// How much each corner of a triangle has of a point in its plane; together 1.
fn shares([a, b, c]: [Vec3; 3], point: Vec3) -> [f32; 3] {
    let (u, v, w) = (b - a, c - a, point - a);
    let (uu, uv, vv) = (u.dot(u), u.dot(v), v.dot(v));
    let (wu, wv) = (w.dot(u), w.dot(v));
    let whole = uu * vv - uv * uv;
    if whole.abs() < f32::MIN_POSITIVE {
        return [1.0, 0.0, 0.0];
    }
    let second = (vv * wu - uv * wv) / whole;
    let third = (uu * wv - uv * wu) / whole;
    [1.0 - second - third, second, third]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shares_of_a_point_lead_back_to_it() {
        let corners = [Vec3::X, Vec3::new(0.0, 3.0, 1.0), Vec3::new(2.0, 0.0, -1.0)];
        for wanted in [[1.0, 0.0, 0.0], [0.2, 0.3, 0.5], [0.0, 0.5, 0.5]] {
            let point = (0..3).map(|k| corners[k] * wanted[k]).sum();
            let found = shares(corners, point);
            for k in 0..3 {
                assert!((found[k] - wanted[k]).abs() < 1e-5, "{wanted:?} {found:?}");
            }
        }
        assert_eq!(shares([Vec3::ONE; 3], Vec3::ZERO), [1.0, 0.0, 0.0]);
    }

    #[test]
    fn grey_shows_the_picture_and_a_colour_dyes_it() {
        let picture = Vec3::new(0.6, 0.3, 0.2);
        assert_eq!(dyed(Vec3::splat(0.5), picture), picture * picture);
        let blue = Vec3::new(0.12, 0.24, 0.86);
        let dyed = dyed(blue, picture);
        assert!(dyed.z > 3.0 * dyed.x, "{dyed}");
    }
}
