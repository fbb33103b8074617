//! Where a picture is taken from, and what of the world falls where on it.

use super::light::{self, Haze};
use super::triangle::{GRID, Triangle};
use simbeeotic_units::glam::{DVec3, Vec3};
use simbeeotic_units::math;

/// A camera: world frame ENU, m; the picture's axes are right and down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it is. Without perspective: any point on the line through the middle of the picture.
    pub eye_m: DVec3,
    /// Unit vectors: to the right of the picture, to its foot, into it.
    pub right: DVec3,
    /// See `right`.
    pub down: DVec3,
    /// See `right`.
    pub forward: DVec3,
    /// How it makes a picture.
    pub lens: Lens,
}

/// How directions become places on the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Without perspective: all is equally large, however far it is.
    Flat {
        /// Pixels a metre.
        scale: f64,
    },
    /// With perspective.
    Perspective {
        /// Pixels for a metre at a distance of one metre.
        focal: f64,
    },
}

/// A side from which the world is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// From above, north is up.
    Top,
    /// From the north, west is right.
    North,
    /// From the south, east is right.
    South,
    /// From the east, north is right.
    East,
    /// From the west, south is right.
    West,
}

impl Side {
    /// The direction in which it looks.
    pub fn forward(self) -> DVec3 {
        match self {
            Self::Top => DVec3::NEG_Z,
            Self::North => DVec3::NEG_Y,
            Self::South => DVec3::Y,
            Self::East => DVec3::NEG_X,
            Self::West => DVec3::X,
        }
    }
}

impl Camera {
    /// A camera that looks along a direction with its picture level; straight down or up, north is up.
    pub fn along(eye_m: DVec3, forward: DVec3, lens: Lens) -> Self {
        let forward = forward.normalize_or(DVec3::NEG_Z);
        let right = forward.cross(DVec3::Z);
        let right = match right.length() {
            length if length < 1e-9 => DVec3::X,
            length => right / length,
        };
        Self {
            eye_m,
            right,
            down: forward.cross(right),
            forward,
            lens,
        }
    }

    /// Where a point is to the camera: right, down, into the picture, m.
    pub fn seen(&self, point_m: DVec3) -> DVec3 {
        let to = point_m - self.eye_m;
        DVec3::new(to.dot(self.right), to.dot(self.down), to.dot(self.forward))
    }

    /// Where a point falls on a picture of `size`: right and down from its upper left corner, pixels.
    /// `None` if it is behind the camera.
    pub fn project(&self, size: [u32; 2], point_m: DVec3) -> Option<[f64; 2]> {
        let seen = self.seen(point_m);
        let scale = match self.lens {
            Lens::Flat { scale } => scale,
            Lens::Perspective { focal } if seen.z > 1e-6 => focal / seen.z,
            Lens::Perspective { .. } => return None,
        };
        let middle = size.map(|side| 0.5 * f64::from(side));
        Some([middle[0] + scale * seen.x, middle[1] + scale * seen.y])
    }

    /// Pixels a metre at a point; across the line of sight.
    pub fn scale_at(&self, point_m: DVec3) -> f64 {
        match self.lens {
            Lens::Flat { scale } => scale,
            Lens::Perspective { focal } => focal / self.seen(point_m).z.max(1e-6),
        }
    }

    /// Pixels a metre as far away as a point is, wherever it is: also beside or behind the camera.
    pub(super) fn scale_around(&self, point_m: DVec3) -> f64 {
        match self.lens {
            Lens::Flat { scale } => scale,
            Lens::Perspective { focal } => focal / (point_m - self.eye_m).length().max(1e-3),
        }
    }

    /// The same camera for a picture that is so many times as large.
    pub(super) fn enlarged(self, times: f64) -> Self {
        let lens = match self.lens {
            Lens::Flat { scale } => Lens::Flat {
                scale: scale * times,
            },
            Lens::Perspective { focal } => Lens::Perspective {
                focal: focal * times,
            },
        };
        Self { lens, ..self }
    }

    /// A camera without perspective that shows a box, as large as can be.
    pub fn flat(side: Side, [low, high]: [DVec3; 2], size: [u32; 2], fill: f64) -> Self {
        let camera = Self::along(
            0.5 * (low + high),
            side.forward(),
            Lens::Flat { scale: 1.0 },
        );
        let half = 0.5 * (high - low);
        let extent = |axis: DVec3| axis.abs().dot(half).max(1e-6);
        let room = size.map(|pixels| 0.5 * fill * f64::from(pixels));
        let scale = (room[0] / extent(camera.right)).min(room[1] / extent(camera.down));
        Self {
            lens: Lens::Flat { scale },
            ..camera
        }
    }

    /// A camera with perspective that looks along a direction and shows a box, as large as can be.
    pub fn framing(
        forward: DVec3,
        [low, high]: [DVec3; 2],
        size: [u32; 2],
        focal: f64,
        fill: f64,
    ) -> Self {
        let middle = 0.5 * (low + high);
        let mut camera = Self::along(middle, forward, Lens::Perspective { focal });
        let room = size.map(|pixels| 0.5 * fill * f64::from(pixels) / focal);
        let corners: [DVec3; 8] = std::array::from_fn(|k| {
            let pick = |bit: usize, low: f64, high: f64| if k >> bit & 1 == 0 { low } else { high };
            let corner = DVec3::new(
                pick(0, low.x, high.x),
                pick(1, low.y, high.y),
                pick(2, low.z, high.z),
            );
            camera.seen(corner)
        });
        // The eye, in the camera's axes from the middle: nearer until a corner leaves the picture, then
        // aside until all stand even.
        let mut eye = DVec3::ZERO;
        let back = |eye: DVec3| {
            let need = |corner: &DVec3| {
                let across = (corner.x - eye.x).abs() / room[0];
                across.max((corner.y - eye.y).abs() / room[1]) - corner.z
            };
            -corners.iter().map(need).fold(1e-3, f64::max)
        };
        for _ in 0..20 {
            eye.z = back(eye);
            let aside = |part: fn(DVec3) -> f64| {
                let slopes = corners.iter().map(|c| part(*c - eye) / (c.z - eye.z));
                let [least, most] = slopes.fold([f64::INFINITY, f64::NEG_INFINITY], |[l, m], s| {
                    [l.min(s), m.max(s)]
                });
                -0.5 * (least + most) * eye.z
            };
            eye += DVec3::new(aside(|v| v.x), aside(|v| v.y), 0.0);
        }
        eye.z = back(eye);
        camera.eye_m += camera.right * eye.x + camera.down * eye.y + camera.forward * eye.z;
        camera
    }
}

/// Pixels for a metre at a metre's distance, of a picture whose width shows an angle.
pub(super) fn focal(width: u32, angle_rad: f64) -> f64 {
    0.5 * f64::from(width) / math::tan(0.5 * angle_rad)
}

/// A direction by where it comes from: a bearing, clockwise from north, and an angle above the horizon, rad.
pub(super) fn from_bearing(bearing_rad: f64, elevation_rad: f64) -> DVec3 {
    let (sin, cos) = math::sin_cos(bearing_rad);
    let (up, level) = math::sin_cos(elevation_rad);
    -DVec3::new(sin * level, cos * level, up)
}

/// What a camera does to triangles, in single precision around a point that is near to all that is seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projector {
    pub(super) origin_m: DVec3,
    eye: Vec3,
    right: Vec3,
    down: Vec3,
    forward: Vec3,
    scale: f32,
    flat: bool,
    middle: [f32; 2],
    /// Nothing nearer is drawn, m.
    near_m: f32,
    /// What the air does; clear if there is none.
    haze: Option<Haze>,
}

/// Corners lie within so many pixels of the middle of the picture.
const GUARD: f32 = 16384.0;

impl Projector {
    pub(super) fn new(
        camera: &Camera,
        size: [usize; 2],
        origin_m: DVec3,
        near_m: f64,
        haze: Option<Haze>,
    ) -> Self {
        let (scale, flat) = match camera.lens {
            Lens::Flat { scale } => (scale, true),
            Lens::Perspective { focal } => (focal, false),
        };
        Self {
            origin_m,
            eye: (camera.eye_m - origin_m).as_vec3(),
            right: camera.right.as_vec3(),
            down: camera.down.as_vec3(),
            forward: camera.forward.as_vec3(),
            scale: scale as f32,
            flat,
            middle: size.map(|side| 0.5 * side as f32),
            near_m: near_m as f32,
            haze: haze.filter(|_| !flat),
        }
    }

    /// Whether there is no perspective.
    pub(super) fn is_flat(&self) -> bool {
        self.flat
    }

    /// A point of the world around the origin.
    pub(super) fn local(&self, point_m: DVec3) -> Vec3 {
        (point_m - self.origin_m).as_vec3()
    }

    /// Right, down and into the picture, m.
    pub(super) fn seen(&self, local: Vec3) -> Vec3 {
        let to = local - self.eye;
        Vec3::new(to.dot(self.right), to.dot(self.down), to.dot(self.forward))
    }

    /// The same without a place: of a direction.
    pub(super) fn turned(&self, direction: Vec3) -> Vec3 {
        Vec3::new(
            direction.dot(self.right),
            direction.dot(self.down),
            direction.dot(self.forward),
        )
    }

    /// Place on the picture, pixels, pixels a metre there, and how near it is; `None` behind the camera or
    /// far outside.
    pub(super) fn place(&self, local: Vec3) -> Option<([f32; 2], f32, f32)> {
        let seen = self.seen(local);
        if !self.flat && seen.z < self.near_m {
            return None;
        }
        let scale = self.scale_of(seen);
        let at = [
            self.middle[0] + scale * seen.x,
            self.middle[1] + scale * seen.y,
        ];
        let inside = (at[0] - self.middle[0]).abs() < 0.5 * GUARD
            && (at[1] - self.middle[1]).abs() < 0.5 * GUARD;
        inside.then(|| (at, scale, self.nearness(seen)))
    }

    fn scale_of(&self, seen: Vec3) -> f32 {
        if self.flat {
            self.scale
        } else {
            self.scale / seen.z
        }
    }

    fn nearness(&self, seen: Vec3) -> f32 {
        if self.flat { -seen.z } else { seen.z.recip() }
    }

    /// Something that lies so much nearer, m: what is drawn on something else.
    pub(super) fn nearer(&self, near: f32, by_m: f32) -> f32 {
        if self.flat {
            near + by_m
        } else {
            near / (1.0 - (by_m * near).min(0.5))
        }
    }

    /// A colour as it is seen through the air.
    fn hazy(&self, rgba: [u8; 4], seen: Vec3) -> [u8; 4] {
        let Some(haze) = self.haze else { return rgba };
        let share = haze.share(seen.z);
        if share <= 0.0 {
            return rgba;
        }
        let [r, g, b, alpha] = rgba;
        let [r, g, b] = light::mix([r, g, b], light::bytes_of(haze.light), share);
        [r, g, b, alpha]
    }

    /// Adds a triangle of the world, cut off where it leaves what can be drawn.
    pub(super) fn triangle(&self, corners: [Vec3; 3], rgba: [[u8; 4]; 3], out: &mut Vec<Triangle>) {
        let seen = corners.map(|corner| self.seen(corner));
        self.cut(seen, rgba, out);
    }

    fn cut(&self, seen: [Vec3; 3], rgba: [[u8; 4]; 3], out: &mut Vec<Triangle>) {
        let limit = |v: Vec3| GUARD / self.scale * if self.flat { 1.0 } else { v.z };
        // How far a corner is inside of each border.
        let borders: [&dyn Fn(Vec3) -> f32; 5] = [
            &|v| if self.flat { 1.0 } else { v.z - self.near_m },
            &|v| limit(v) - v.x,
            &|v| limit(v) + v.x,
            &|v| limit(v) - v.y,
            &|v| limit(v) + v.y,
        ];
        let inside = |v: &Vec3| borders.iter().all(|border| border(*v) >= 0.0);
        if seen.iter().all(inside) {
            let rgba = [0, 1, 2].map(|k| self.hazy(rgba[k], seen[k]));
            return out.push(self.on_screen(seen, rgba));
        }
        if !seen.iter().all(|v| v.is_finite()) {
            return;
        }
        let mut shape: Vec<(Vec3, [u8; 4])> = seen.into_iter().zip(rgba).collect();
        for border in borders {
            let mut kept = Vec::with_capacity(shape.len() + 1);
            for (k, (v, c)) in shape.iter().enumerate() {
                let (w, d) = &shape[(k + 1) % shape.len()];
                let (here, there) = (border(*v), border(*w));
                if here >= 0.0 {
                    kept.push((*v, *c));
                }
                if (here >= 0.0) != (there >= 0.0) {
                    let share = here / (here - there);
                    let colour = std::array::from_fn(|k| {
                        let (a, b) = (f32::from(c[k]), f32::from(d[k]));
                        (a + share * (b - a) + 0.5) as u8
                    });
                    kept.push((*v + share * (*w - *v), colour));
                }
            }
            shape = kept;
            if shape.len() < 3 {
                return;
            }
        }
        for k in 1..shape.len() - 1 {
            let corners = [shape[0], shape[k], shape[k + 1]];
            let rgba = corners.map(|(v, c)| self.hazy(c, v));
            out.push(self.on_screen(corners.map(|(v, _)| v), rgba));
        }
    }

    fn on_screen(&self, seen: [Vec3; 3], rgba: [[u8; 4]; 3]) -> Triangle {
        let grid = |pixels: f32| (pixels * GRID as f32).round() as i32;
        let at = |k: usize, part: f32| grid(self.middle[k] + part);
        let scales = seen.map(|v| self.scale_of(v));
        Triangle {
            x: [0, 1, 2].map(|k| at(0, scales[k] * seen[k].x)),
            y: [0, 1, 2].map(|k| at(1, scales[k] * seen[k].y)),
            near: seen.map(|v| self.nearness(v)),
            rgba,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [u32; 2] = [800, 600];

    #[test]
    fn from_above_a_metre_is_its_scale_and_north_is_up() {
        let bounds = [DVec3::new(-10.0, -5.0, 0.0), DVec3::new(10.0, 5.0, 3.0)];
        let camera = Camera::flat(Side::Top, bounds, SIZE, 1.0);
        // Twenty metres across 800 pixels.
        assert_eq!(camera.lens, Lens::Flat { scale: 40.0 });
        let at = |x, y| camera.project(SIZE, DVec3::new(x, y, 1.0)).expect("seen");
        assert_eq!(at(0.0, 0.0), [400.0, 300.0]);
        assert_eq!(at(1.0, 0.0), [440.0, 300.0]);
        assert_eq!(at(0.0, 2.0), [400.0, 220.0]);
    }

    #[test]
    fn each_side_has_its_right_hand() {
        for (side, right) in [
            (Side::South, DVec3::X),
            (Side::North, DVec3::NEG_X),
            (Side::East, DVec3::Y),
            (Side::West, DVec3::NEG_Y),
            (Side::Top, DVec3::X),
        ] {
            let camera = Camera::along(DVec3::ZERO, side.forward(), Lens::Flat { scale: 1.0 });
            assert!((camera.right - right).length() < 1e-12, "{side:?}");
            if side != Side::Top {
                assert!((camera.down - DVec3::NEG_Z).length() < 1e-12, "{side:?}");
            }
        }
    }

    #[test]
    fn a_known_point_falls_where_the_pinhole_says() {
        // 90 degrees across 800 pixels: a metre at one metre is 400 pixels.
        let focal = focal(800, std::f64::consts::FRAC_PI_2);
        assert!((focal - 400.0).abs() < 1e-9);
        let camera = Camera::along(DVec3::ZERO, DVec3::X, Lens::Perspective { focal });
        let at = camera
            .project(SIZE, DVec3::new(10.0, -5.0, 2.5))
            .expect("seen");
        assert!(
            (at[0] - 600.0).abs() < 1e-9 && (at[1] - 200.0).abs() < 1e-9,
            "{at:?}"
        );
        assert_eq!(camera.project(SIZE, DVec3::new(-10.0, 0.0, 0.0)), None);
        // The projector of triangles agrees.
        let origin = DVec3::new(9.0, 9.0, 9.0);
        let projector = Projector::new(&camera, [800, 600], origin, 0.1, None);
        let local = projector.local(DVec3::new(10.0, -5.0, 2.5));
        let ([x, y], scale, near) = projector.place(local).expect("seen");
        assert!((x - 600.0).abs() < 1e-3 && (y - 200.0).abs() < 1e-3);
        assert!((scale - 40.0).abs() < 1e-4 && (near - 0.1).abs() < 1e-6);
    }

    #[test]
    fn a_framed_box_touches_the_border_and_stays_inside() {
        let bounds = [DVec3::new(-3.0, -8.0, 0.0), DVec3::new(40.0, 2.0, 3.0)];
        for bearing in [0.0, 1.0, 2.5, 4.0] {
            let forward = from_bearing(bearing, 0.5);
            let camera = Camera::framing(forward, bounds, SIZE, 700.0, 0.9);
            let mut most = 0.0_f64;
            for k in 0..8 {
                let pick = |bit: usize| {
                    if k >> bit & 1 == 0 {
                        bounds[0]
                    } else {
                        bounds[1]
                    }
                };
                let corner = DVec3::new(pick(0).x, pick(1).y, pick(2).z);
                let [x, y] = camera.project(SIZE, corner).expect("before the camera");
                most = most
                    .max((x - 400.0).abs() / 400.0)
                    .max((y - 300.0).abs() / 300.0);
            }
            assert!((most - 0.9).abs() < 1e-6, "{bearing} {most}");
        }
    }

    #[test]
    fn what_reaches_behind_the_camera_is_cut_and_not_turned_over() {
        let camera = Camera::along(DVec3::ZERO, DVec3::X, Lens::Perspective { focal: 400.0 });
        let projector = Projector::new(&camera, [800, 600], DVec3::ZERO, 0.1, None);
        let mut out = Vec::new();
        let corners = [[5.0, 0.0, -1.0], [5.0, -1.0, -1.0], [-50.0, 0.0, -1.0]].map(Vec3::from);
        projector.triangle(corners, [[9; 4]; 3], &mut out);
        assert!(!out.is_empty());
        for triangle in &out {
            // Below the horizon, all of it.
            assert!(triangle.y.iter().all(|y| *y > 300 * GRID), "{triangle:?}");
            assert!(triangle.near.iter().all(|near| (0.0..=10.1).contains(near)));
        }
        let behind = [[-5.0, 0.0, 0.0], [-5.0, 1.0, 0.0], [-5.0, 0.0, 1.0]].map(Vec3::from);
        out.clear();
        projector.triangle(behind, [[9; 4]; 3], &mut out);
        assert!(out.is_empty());
    }
}
