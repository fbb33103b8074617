//! What is behind all things: the sky, the ground and a grid of metres on it.

use super::camera::{Camera, Lens};
use super::light::{Theme, mix};
use super::raster::Tile;
use simbeeotic_units::glam::DVec3;

/// How strong the lines of the grid are at most, and how wide, pixels.
const STRONG: f64 = 0.34;
const WIDTH: f64 = 1.2;
/// Cells of the grid that are narrower than this fade, pixels.
const CELL_LEAST: f64 = 5.0;
const CELL_FULL: f64 = 24.0;

/// Sky and ground as one camera sees them.
pub(super) struct Backdrop {
    camera: Camera,
    theme: Theme,
    middle: [f64; 2],
    /// Whether the plane `z = 0` is ground.
    plane: bool,
    /// Edge of the grid's cells, m, and how many of them make a larger one.
    cell_m: f64,
    /// Pixels of this picture for each of the finished one.
    times: f64,
    /// Where the ground has half the colour of the horizon, m.
    haze_m: f64,
}

impl Backdrop {
    pub(super) fn new(
        camera: Camera,
        theme: Theme,
        size: [usize; 2],
        plane: bool,
        cell_m: f64,
        times: f64,
        haze_m: f64,
    ) -> Self {
        Self {
            camera,
            theme,
            middle: size.map(|side| 0.5 * side as f64),
            plane,
            cell_m,
            times,
            haze_m,
        }
    }

    /// Fills a tile.
    pub(super) fn fill(&self, tile: &mut Tile) {
        let (near, slope) = self.ground_near();
        for y in 0..tile.height {
            for x in 0..tile.width {
                let place = [(tile.left + x) as f64 + 0.5, (tile.top + y) as f64 + 0.5];
                let from = [place[0] - self.middle[0], place[1] - self.middle[1]];
                let near = near + slope[0] * from[0] + slope[1] * from[1];
                match self.ground(from, near) {
                    Some(rgb) => {
                        let slope = slope.map(|s| s as f32);
                        tile.fill(x, y, rgb, near as f32, slope);
                    }
                    None => {
                        tile.fill(x, y, self.sky(from), f32::NEG_INFINITY, [0.0; 2]);
                    }
                }
            }
        }
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

    /// How near the ground is in the middle of the picture, and how that grows to the right and down, a
    /// pixel: the inverse of the depth, or its negative. Below zero, with perspective: no ground.
    fn ground_near(&self) -> (f64, [f64; 2]) {
        let Camera {
            eye_m,
            right,
            down,
            forward,
            lens,
        } = self.camera;
        // A little lower than it is, so that what lies on it is seen.
        match lens {
            Lens::Flat { scale } if forward.z.abs() > 1e-6 => {
                let depth = |above: f64| above / forward.z - 1e-3;
                let slope = |axis: DVec3| axis.z / forward.z / scale;
                (depth(eye_m.z), [slope(right), slope(down)])
            }
            Lens::Flat { .. } => (f64::NEG_INFINITY, [0.0; 2]),
            Lens::Perspective { focal } => {
                let above = -eye_m.z * 1.000_5;
                (
                    forward.z / above,
                    [right.z / above / focal, down.z / above / focal],
                )
            }
        }
    }

    /// The ground's colour at a place of the picture; `None` where there is none.
    fn ground(&self, from: [f64; 2], near: f64) -> Option<[u8; 3]> {
        if !self.plane {
            return None;
        }
        let (start, sight) = self.sight(from);
        let Lens::Perspective { focal } = self.camera.lens else {
            if sight.z.abs() < 1e-6 {
                // From the side, all below zero is ground.
                return (start.z < 0.0).then_some(self.theme.ground);
            }
            let scale = match self.camera.lens {
                Lens::Flat { scale } => scale,
                Lens::Perspective { focal } => focal,
            };
            let point = start - sight * (start.z / sight.z);
            let step = 1.0 / scale;
            return Some(self.gridded(point, [step; 2], 1.0));
        };
        // From below, the ground is not seen.
        if near <= 0.0 || self.camera.eye_m.z <= 0.0 {
            return None;
        }
        let depth = 1.0 / near;
        let point = start + sight * depth;
        // How far a pixel to the right and one down lead on the ground.
        let step = |axis: DVec3| {
            let other = sight + axis / focal;
            let further = -start.z / other.z;
            let step = other * further - sight * depth;
            [step.x.abs(), step.y.abs()]
        };
        let (a, b) = (step(self.camera.right), step(self.camera.down));
        let steps = [a[0] + b[0], a[1] + b[1]];
        let share = depth / (depth + self.haze_m);
        let clear = 1.0 - share * share;
        let own = self.gridded(point, steps, clear);
        Some(mix(self.theme.horizon, own, clear as f32))
    }

    /// The ground with its lines; `steps`: metres a pixel along east and north.
    fn gridded(&self, point: DVec3, steps: [f64; 2], strong: f64) -> [u8; 3] {
        let mut line = 0.0_f64;
        for (cell, weight) in [(self.cell_m, 0.5), (10.0 * self.cell_m, 1.0)] {
            for (at, step) in [(point.x, steps[0]), (point.y, steps[1])] {
                let step = step.max(1e-12);
                let pixels = cell / step / self.times;
                let shown = ((pixels - CELL_LEAST) / (CELL_FULL - CELL_LEAST)).clamp(0.0, 1.0);
                if shown == 0.0 {
                    continue;
                }
                let off = (at / cell - (at / cell).round()).abs() * cell / step;
                let cover = (0.5 + 0.5 * WIDTH * self.times - off).clamp(0.0, 1.0);
                line = line.max(cover * shown * weight);
            }
        }
        mix(
            self.theme.ground,
            self.theme.grid,
            (line * STRONG * strong) as f32,
        )
    }

    /// The sky: lighter towards the horizon, and the same below it where there is no ground.
    fn sky(&self, from: [f64; 2]) -> [u8; 3] {
        let up = match self.camera.lens {
            Lens::Flat { .. } if self.camera.forward.z.abs() > 0.5 => return self.theme.ground,
            Lens::Flat { .. } => (self.middle[1] - from[1]) / (4.0 * self.middle[1]),
            Lens::Perspective { .. } => {
                let (_, sight) = self.sight(from);
                sight.z / sight.length()
            }
        };
        let share = up.clamp(0.0, 1.0);
        // Steep at the horizon, even above.
        mix(
            self.theme.horizon,
            self.theme.zenith,
            (share * (2.0 - share)).sqrt() as f32,
        )
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

    fn theme() -> Theme {
        Theme::new(false, [125, 163, 106, 255])
    }

    fn drawn(camera: Camera, cell: f64) -> Vec<[u8; 3]> {
        let mut tile = Tile::new(0, [64, 64]);
        Backdrop::new(camera, theme(), [64, 64], true, cell, 1.0, 1e9).fill(&mut tile);
        tile.pixels().collect()
    }

    #[test]
    fn lines_of_the_grid_stand_a_cell_apart() {
        let bounds = [DVec3::splat(-1.0), DVec3::splat(1.0)];
        // 32 pixels a metre: lines at the columns 0, 32 and 64, half of their width on each side.
        let pixels = drawn(Camera::flat(Side::Top, bounds, [64, 64], 1.0), 1.0);
        let row: Vec<bool> = (0..64)
            .map(|x| pixels[64 * 16 + x] != theme().ground)
            .collect();
        let lines: Vec<usize> = (0..64).filter(|x| row[*x]).collect();
        assert_eq!(lines, [0, 31, 32, 63]);
    }

    #[test]
    fn the_horizon_is_where_the_eye_is_level() {
        let lens = Lens::Perspective { focal: 50.0 };
        let camera = Camera::along(DVec3::new(40.0, 40.0, 2.0), DVec3::X, lens);
        let pixels = drawn(camera, 1e5);
        let green = |row: usize| pixels[64 * row + 32];
        assert_eq!(green(60), theme().ground);
        assert_ne!(green(4), theme().ground);
        // Just above the middle it is sky, just below it is ground.
        assert!((0..32).all(|row| green(row) != theme().ground));
        assert!((34..64).all(|row| green(row) == theme().ground));
    }

    #[test]
    fn cells_are_powers_of_ten_that_can_be_seen() {
        assert_eq!(cell_m(20.0), 1.0);
        assert_eq!(cell_m(15.0), 10.0);
        assert_eq!(cell_m(0.1), 1000.0);
    }
}
