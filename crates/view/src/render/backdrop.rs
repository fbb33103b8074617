//! What is behind all things: the sky, the ground and a grid of metres on it.

use super::camera::{Camera, Lens};
use super::ground;
use super::light::{Haze, Theme, light_of, smooth};
use super::skins::Skin;
use super::visible::{CUT, GROUND, SKY};
use simbeeotic_units::glam::{DVec3, Vec3};

/// How strong the lines of the grid are at most: of one cell, of ten, of a hundred.
const STRONG: [f64; 3] = [0.17, 0.34, 0.42];
/// How wide they are, pixels.
const WIDTH: f64 = 1.1;
/// Cells of the grid that are narrower than this fade, pixels.
const CELL_LEAST: f64 = 5.0;
const CELL_FULL: f64 = 24.0;
/// How strong the lines to the east and to the north through the origin are, and their colours.
const AXIS_STRONG: f64 = 0.5;
const AXES: [Vec3; 2] = [Vec3::new(0.62, 0.11, 0.09), Vec3::new(0.06, 0.34, 0.14)];
/// How strong the picture of the ground is once more, so many times as large: the eye finds no tiles.
const AGAIN: (f32, f32) = (0.35, 7.3);

/// What there is to know of the ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground {
    /// Whether the plane `z = 0` is ground.
    pub(super) plane: bool,
    /// How far the world reaches, m.
    pub(super) radius_m: f64,
    /// Edge of the grid's cells, m; none: there is no grid.
    pub(super) cell_m: Option<f64>,
}

/// Sky and ground as one camera sees them.
pub(super) struct Backdrop {
    camera: Camera,
    theme: Theme,
    haze: Option<Haze>,
    middle: [f64; 2],
    ground: Ground,
    /// Pixels of this picture for each of the finished one.
    times: f64,
}

impl Backdrop {
    pub(super) fn new(
        camera: Camera,
        theme: Theme,
        haze: Option<Haze>,
        size: [usize; 2],
        ground: Ground,
        times: f64,
    ) -> Self {
        Self {
            camera,
            theme,
            haze: haze.filter(|_| matches!(camera.lens, Lens::Perspective { .. })),
            middle: size.map(|side| 0.5 * side as f64),
            ground,
            times,
        }
    }

    /// What is behind everything at a place of the picture, and how near it is, with how that grows to the right
    /// and down, a pixel.
    pub(super) fn behind(&self, place: [f64; 2]) -> (u32, [f32; 3]) {
        const FAR: [f32; 3] = [f32::NEG_INFINITY, 0.0, 0.0];
        if !self.ground.plane {
            return (SKY, FAR);
        }
        let from = self.from(place);
        let Camera {
            eye_m,
            right,
            down,
            forward,
            lens,
        } = self.camera;
        match lens {
            Lens::Flat { .. } if forward.z.abs() < 1e-6 => {
                // From the side, all below zero is ground.
                let (start, _) = self.sight(from);
                (if start.z < 0.0 { CUT } else { SKY }, FAR)
            }
            // A little lower than it is, so that what lies on it is seen.
            Lens::Flat { scale } => {
                let [x, y] = [right, down].map(|axis| axis.z / forward.z / scale);
                let near = eye_m.z / forward.z - 1e-3 + x * from[0] + y * from[1];
                (GROUND, [near, x, y].map(|part| part as f32))
            }
            Lens::Perspective { focal } => {
                let above = -eye_m.z * 1.000_5;
                let [x, y] = [right, down].map(|axis| axis.z / above / focal);
                let near = forward.z / above + x * from[0] + y * from[1];
                // From below, the ground is not seen.
                match near > 0.0 && eye_m.z > 0.0 {
                    true => (GROUND, [near, x, y].map(|part| part as f32)),
                    false => (SKY, FAR),
                }
            }
        }
    }

    /// A place from the middle of the picture.
    fn from(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [x - self.middle[0], y - self.middle[1]]
    }

    /// The line of sight through a place of the picture: where it begins, and its direction.
    fn sight(&self, [x, y]: [f64; 2]) -> (DVec3, DVec3) {
        let Camera {
            eye_m,
            right,
            down,
            forward,
            lens,
        } = self.camera;
        match lens {
            Lens::Flat { scale } => (eye_m + (right * x + down * y) / scale, forward),
            Lens::Perspective { focal } => (eye_m, forward + (right * x + down * y) / focal),
        }
    }

    /// What is so near at a place of the picture, m; the direction in which it is seen; how far it is along the
    /// line of sight; and how wide a pixel is there, across the line of sight, m.
    pub(super) fn point(&self, place: [f32; 2], near: f32) -> (DVec3, DVec3, f64, f64) {
        let (start, sight) = self.sight(self.from(place.map(f64::from)));
        let near = f64::from(near);
        let (depth, pixel) = match self.camera.lens {
            Lens::Flat { scale } => (-near, 1.0 / scale),
            Lens::Perspective { focal } => (1.0 / near, 1.0 / near / focal),
        };
        (start + sight * depth, sight, depth, pixel)
    }

    /// The light of what is behind everything; `skin` is the picture of the ground, `sun` says how much of the sun
    /// reaches a place, 0 to 1. With the light, that share.
    pub(super) fn light(
        &self,
        what: u32,
        place: [f32; 2],
        skin: Option<&Skin>,
        sun: impl FnOnce(DVec3) -> f32,
    ) -> (Vec3, f32) {
        let from = self.from(place.map(f64::from));
        match what {
            GROUND => self.plane(from, skin, sun),
            CUT => (self.theme.cut, 1.0),
            _ => (self.sky(from), 1.0),
        }
    }

    fn plane(
        &self,
        from: [f64; 2],
        skin: Option<&Skin>,
        sun: impl FnOnce(DVec3) -> f32,
    ) -> (Vec3, f32) {
        let (start, sight) = self.sight(from);
        let depth = -start.z / sight.z;
        let point = start + sight * depth;
        let steps = match self.camera.lens {
            Lens::Flat { scale } => [1.0 / scale; 2],
            // How far a pixel to the right and one down lead on the ground.
            Lens::Perspective { focal } => {
                let step = |axis: DVec3| {
                    let other = sight + axis / focal;
                    let step = other * (-start.z / other.z) - sight * depth;
                    [step.x.abs(), step.y.abs()]
                };
                let (a, b) = (step(self.camera.right), step(self.camera.down));
                [a[0] + b[0], a[1] + b[1]]
            }
        };
        let pixel = steps[0].max(steps[1]);
        let own = match skin {
            Some(skin) => {
                let at = |times: f32| {
                    let place = [point.x, point.y].map(|x| (x / f64::from(times)) as f32);
                    skin.at(place, pixel as f32 / times)
                };
                at(1.0).lerp(at(AGAIN.1), AGAIN.0)
            }
            None => light_of(self.theme.ground).map(f32::sqrt),
        };
        let own = self.theme.toned(own);
        // Beyond the edge of the world the ground pales, and has no lines.
        let radius = self.ground.radius_m as f32;
        let beyond = match radius > 0.0 {
            true => smooth(radius, 1.15 * radius, point.truncate().length() as f32),
            false => 0.0,
        };
        let grey = own.dot(Vec3::new(0.3, 0.6, 0.1));
        let own = own * ground::uneven([point.x, point.y], pixel);
        let own = own.lerp(Vec3::splat(grey), 0.5 * beyond);
        let sun = sun(point);
        let lit = own * own * self.theme.shade().lerp(Vec3::ONE, sun);
        let lit = self.gridded(lit, point, steps, f64::from(1.0 - beyond));
        let lit = match self.haze {
            Some(haze) => haze.over(lit, depth as f32),
            None => lit,
        };
        (lit, sun)
    }

    /// Ground with its lines; `steps`: metres a pixel along east and north.
    pub(super) fn gridded(&self, own: Vec3, point: DVec3, steps: [f64; 2], strong: f64) -> Vec3 {
        let Some(cell_m) = self.ground.cell_m else {
            return own;
        };
        let mut line = 0.0_f64;
        let mut cell = cell_m;
        for weight in STRONG {
            for (at, step) in [(point.x, steps[0]), (point.y, steps[1])] {
                let step = step.max(1e-12);
                let pixels = cell / step / self.times;
                let shown = ((pixels - CELL_LEAST) / (CELL_FULL - CELL_LEAST)).clamp(0.0, 1.0);
                if shown == 0.0 {
                    continue;
                }
                let off = (at / cell - (at / cell).round()).abs() * cell / step;
                line = line.max(self.cover(off) * shown * weight);
            }
            cell *= 10.0;
        }
        let mut light = own.lerp(self.theme.grid, (line * strong) as f32);
        for (axis, (at, step)) in [(point.y, steps[1]), (point.x, steps[0])]
            .into_iter()
            .enumerate()
        {
            let cover = self.cover(at.abs() / step.max(1e-12)) * AXIS_STRONG * strong;
            light = light.lerp(AXES[axis], cover as f32);
        }
        light
    }

    /// How much of a pixel a line covers that is so far away, pixels.
    fn cover(&self, off: f64) -> f64 {
        (0.5 + 0.5 * WIDTH * self.times - off).clamp(0.0, 1.0)
    }

    /// The sky, and the same below the horizon where there is no ground.
    fn sky(&self, from: [f64; 2]) -> Vec3 {
        match self.camera.lens {
            Lens::Flat { .. } => {
                let up = (0.5 - 0.5 * from[1] / self.middle[1]).clamp(0.0, 1.0);
                (self.theme.horizon).lerp(self.theme.zenith, 0.3 * up as f32)
            }
            Lens::Perspective { .. } => {
                let (_, sight) = self.sight(from);
                self.theme.sky(sight.normalize().as_vec3())
            }
        }
    }
}

/// The edge of a cell of the grid, m: a power of ten that is at least some pixels wide.
pub(super) fn cell_m(pixels_a_metre: f64) -> f64 {
    let least = 16.0 / pixels_a_metre.max(1e-9);
    let powers = [1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3, 1e4, 1e5];
    let found = powers.into_iter().find(|power| *power >= least);
    found.unwrap_or(1e6)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::camera::Side;
    use crate::render::light::bytes_of;
    use crate::render::visible::Visible;

    fn drawn(camera: Camera, cell_m: f64) -> Vec<[u8; 3]> {
        let theme = Theme::new(false, [125, 163, 106, 255]);
        let ground = Ground {
            plane: true,
            radius_m: 1e6,
            cell_m: Some(cell_m),
        };
        let back = Backdrop::new(camera, theme, None, [64, 64], ground, 1.0);
        let mut seen = Visible::new(0, [64, 64]);
        seen.ground(&back);
        let tile = seen.shaded(|sight| {
            let (light, _) = back.light(sight.face, sight.at, None, |_| 1.0);
            (bytes_of(light), false)
        });
        tile.pixels().collect()
    }

    #[test]
    fn lines_of_the_grid_stand_a_cell_apart() {
        let bounds = [DVec3::splat(-1.0), DVec3::splat(1.0)];
        // 32 pixels a metre: lines at the columns 0, 32 and 64, half of their width on each side.
        let pixels = drawn(Camera::flat(Side::Top, bounds, [64, 64], 1.0), 1.0);
        let light = |x: usize| u32::from(pixels[64 * 16 + x][1]);
        let plain = light(16);
        let lines: Vec<usize> = (0..64).filter(|x| light(*x).abs_diff(plain) > 5).collect();
        assert_eq!(lines, [0, 31, 32, 63]);
    }

    #[test]
    fn the_horizon_is_where_the_eye_is_level() {
        let lens = Lens::Perspective { focal: 50.0 };
        let camera = Camera::along(DVec3::new(40.0, 40.0, 2.0), DVec3::X, lens);
        let pixels = drawn(camera, 1e5);
        // Just above the middle it is sky, just below it is ground.
        let green = |row: usize| {
            let [r, g, b] = pixels[64 * row + 32];
            g > r && g > b
        };
        assert!((0..32).all(|row| !green(row)));
        assert!((34..64).all(green));
    }

    #[test]
    fn cells_are_powers_of_ten_that_can_be_seen() {
        assert_eq!(cell_m(20.0), 1.0);
        assert_eq!(cell_m(15.0), 10.0);
        assert_eq!(cell_m(0.1), 1000.0);
    }
}
