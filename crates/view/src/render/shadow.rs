//! Shadows of what stands still: a picture of distances, taken once from the sun.

use super::camera::{Camera, Lens, Projector};
use super::light::SUN;
use super::solid::Face;
use super::triangle::{Bins, tiles};
use super::visible::Visible;
use rayon::prelude::*;
use simbeeotic_units::glam::{DVec3, Vec3};

/// Width and height, pixels.
const SIDE: usize = 2048;
/// Where what is lit and what throws a shadow are farther apart than so many pixels, there is a shadow.
const BIAS_PX: f32 = 2.0;
/// A surface is looked up so far in front of itself, m, and pixels.
const OFF_M: f32 = 0.02;
const OFF_PX: f32 = 1.0;

/// What the sun sees.
pub(super) struct Shadows {
    projector: Projector,
    bias_m: f32,
    off_m: f32,
    near: Vec<f32>,
}

impl Shadows {
    /// Of faces around an origin, as far as the middle of things is, m; `None` if nothing throws a shadow.
    pub(super) fn new(faces: &[Face], origin_m: DVec3, around_m: f64) -> Option<Self> {
        let around = Vec3::splat(around_m as f32);
        let corners = faces.iter().filter(|face| face.shadow);
        let corners = || corners.clone().flat_map(|face| face.corners);
        let low = corners().reduce(Vec3::min)?.max(-around);
        let high = corners().reduce(Vec3::max)?.min(around);
        if !low.is_finite() || !high.is_finite() || low.cmpgt(high).any() {
            return None;
        }
        let middle = (0.5 * (low + high)).as_dvec3();
        let flat = |scale: f64, eye: DVec3| {
            Camera::along(origin_m + eye, -SUN.as_dvec3(), Lens::Flat { scale })
        };
        // The box, and where its shadow falls on the ground.
        let camera = flat(1.0, middle);
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for k in 0..8 {
            let pick = |bit: usize, low: f32, high: f32| if k >> bit & 1 == 0 { low } else { high };
            let corner = Vec3::new(
                pick(0, low.x, high.x),
                pick(1, low.y, high.y),
                pick(2, low.z, high.z),
            );
            let world = corner.as_dvec3() + origin_m;
            let down = world - SUN.as_dvec3() * (world.z.max(0.0) / f64::from(SUN.z));
            for point in [world, down] {
                let seen = camera.seen(point);
                (least, most) = (least.min(seen), most.max(seen));
            }
        }
        let extent = (most - least).truncate().max_element().max(1e-3) * 1.02;
        let aside = 0.5 * (least + most);
        let eye = middle + camera.right * aside.x + camera.down * aside.y;
        let scale = SIDE as f64 / extent;
        let size = [SIDE; 2];
        let projector = Projector::new(&flat(scale, eye), size, origin_m, 0.0, None);

        let mut triangles = Vec::new();
        for face in faces.iter().filter(|face| face.shadow) {
            projector.triangle(face.corners, [[0; 4]; 3], &mut triangles);
        }
        let bins = Bins::new(&triangles, size);
        let [across, down] = tiles(size);
        let seen: Vec<Visible> = (0..across * down)
            .into_par_iter()
            .map(|number| {
                let mut seen = Visible::new(number, size);
                bins.of(number, &triangles).for_each(|t| seen.draw(t, 0));
                seen
            })
            .collect();
        let mut near = vec![f32::NEG_INFINITY; SIDE * SIDE];
        for tile in &seen {
            let [left, top, width, _] = tile.place();
            for (at, nearest) in tile.nearest().enumerate() {
                near[(top + at / width) * SIDE + left + at % width] = nearest;
            }
        }
        Some(Self {
            projector,
            bias_m: BIAS_PX / scale as f32,
            off_m: OFF_M + OFF_PX / scale as f32,
            near,
        })
    }

    /// How much of the sun reaches a surface at a place around the origin that faces a direction, 0 to 1.
    pub(super) fn sun_at(&self, place: Vec3, normal: Vec3) -> f32 {
        let Some(([x, y], _, near)) = self.projector.place(place + normal * self.off_m) else {
            return 1.0;
        };
        let (x, y) = (x - 0.5, y - 0.5);
        let last = (SIDE - 2) as f32;
        if !(0.0..=last).contains(&x) || !(0.0..=last).contains(&y) {
            return 1.0;
        }
        let (column, row) = (x as usize, y as usize);
        let free = |right: usize, down: usize| {
            let before = self.near[(row + down) * SIDE + column + right];
            f32::from(before <= near + self.bias_m)
        };
        let (share_x, share_y) = (x.fract(), y.fract());
        let between = |a: f32, b: f32, share: f32| a + share * (b - a);
        between(
            between(free(0, 0), free(1, 0), share_x),
            between(free(0, 1), free(1, 1), share_x),
            share_y,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::solid;
    use simbeeotic_record::Stage;
    use simbeeotic_record::stage::{Form, Piece, Prop};

    #[test]
    fn a_roof_shades_what_is_below_it_away_from_the_sun_and_nothing_else() {
        let roof = Form::Box {
            half_m: [2.0, 2.0, 0.1],
        };
        let prop = Prop {
            pieces: vec![Piece {
                position_m: [100.0, 50.0, 5.0],
                ..Piece::at_origin(roof)
            }],
            ..Prop::default()
        };
        let stage = Stage {
            props: vec![prop],
            ..Stage::default()
        };
        let origin = DVec3::new(100.0, 50.0, 0.0);
        let faces = solid::stage(&stage, origin, |_| None);
        let shadows = Shadows::new(&faces, origin, 100.0).expect("shadows");
        let sun = |x: f32, y: f32, z: f32| shadows.sun_at(Vec3::new(x, y, z), Vec3::Z);
        // The sun is in the south-west: the shadow of the middle falls to the north-east.
        let away = 5.0 / SUN.z;
        let (east, north) = (-SUN.x * away, -SUN.y * away);
        assert_eq!(sun(east, north, 0.0), 0.0);
        assert_eq!(sun(east - 1.8, north + 1.8, 0.0), 0.0);
        assert_eq!(sun(east + 2.3, north, 0.0), 1.0);
        assert_eq!(sun(-east, -north, 0.0), 1.0);
        // The roof itself is in the sun, and the world beyond the picture.
        assert_eq!(sun(0.0, 0.0, 5.1), 1.0);
        assert_eq!(sun(900.0, 0.0, 0.0), 1.0);
        assert!(Shadows::new(&[], origin, 100.0).is_none());
    }
}
