//! From a stage, a camera and a swarm to a picture.

use super::backdrop::{self, Backdrop};
use super::camera::{Camera, Lens, Projector};
use super::glyph;
use super::light::Theme;
use super::raster::{Batch, Bins, GRID, Tile, Triangle, tiles};
use super::solid::Lit;
use rayon::prelude::*;
use simbeeotic_units::glam::{DVec3, Vec3};

/// A picture: red, green and blue of each pixel, row by row from the upper left corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Three bytes a pixel.
    pub rgb: Vec<u8>,
}

/// Draws pictures of one stage.
pub(super) struct Painter {
    pub(super) theme: Theme,
    /// A point near to all that is seen.
    pub(super) origin_m: DVec3,
    pub(super) plane: bool,
    /// How large the whole is, m: how far the air is clear.
    pub(super) extent_m: f64,
    pub(super) statics: Vec<Lit>,
    /// Size of the finished picture.
    pub(super) size: [u32; 2],
    /// Each pixel is drawn as so many across and down.
    pub(super) fineness: usize,
    /// What stands still, as the last camera saw it.
    still: Option<(Camera, Vec<Tile>)>,
}

/// What a painter lets others draw with.
pub(super) struct Stand<'a> {
    pub(super) projector: Projector,
    pub(super) theme: &'a Theme,
    /// Drawn pixels for each of the finished picture.
    pub(super) fineness: f32,
}

/// Triangles that are made by one thread at a time.
const SHARE: usize = 2048;

impl Painter {
    pub(super) fn new(
        theme: Theme,
        origin_m: DVec3,
        plane: bool,
        extent_m: f64,
        statics: Vec<Lit>,
        size: [u32; 2],
        fineness: usize,
    ) -> Self {
        Self {
            theme,
            origin_m,
            plane,
            extent_m,
            statics,
            size,
            fineness,
            still: None,
        }
    }

    /// Draws a picture. `things` adds what moves.
    pub(super) fn draw(
        &mut self,
        camera: &Camera,
        things: impl FnOnce(&Stand<'_>) -> Batch,
    ) -> Picture {
        let size = self.size.map(|side| side as usize * self.fineness);
        let large = camera.enlarged(self.fineness as f64);
        let haze_m = 12.0 * self.extent_m;
        let near_m = match camera.lens {
            Lens::Flat { .. } => 0.0,
            Lens::Perspective { .. } => (2e-3 * self.extent_m).clamp(0.02, 1.0),
        };
        let projector = Projector::new(
            &large,
            size,
            self.origin_m,
            near_m,
            (self.theme.horizon, haze_m),
        );
        let stand = Stand {
            projector,
            theme: &self.theme,
            fineness: self.fineness as f32,
        };
        let mut batch = things(&stand);
        let [across, down] = tiles(size);
        let numbers = 0..across * down;

        let known = self.still.as_ref().is_some_and(|(seen, _)| seen == camera);
        if !known {
            let mut statics = self.statics(&projector);
            let cell = backdrop::cell_m(camera.scale_at(self.origin_m));
            let (plane, times) = (self.plane, self.fineness as f64);
            let back = Backdrop::new(large, self.theme, size, plane, cell, times, haze_m);
            // What lets through has to be drawn with what moves.
            let shadows = Bins::new(&statics.shadows, size);
            let solid = Bins::new(&statics.solid, size);
            let drawn = numbers.clone().into_par_iter().map(|number| {
                let mut tile = Tile::new(number, size);
                back.fill(&mut tile);
                shadows
                    .of(number, &statics.shadows)
                    .for_each(|t| tile.shadow(t));
                tile.darken(self.theme.shadow);
                solid.of(number, &statics.solid).for_each(|t| tile.solid(t));
                tile
            });
            let drawn = drawn.collect();
            statics.shadows.clear();
            statics.solid.clear();
            self.still = Some((*camera, drawn));
            batch.glass.append(&mut statics.glass);
        } else {
            batch.glass.append(&mut self.clear(&projector));
        }
        batch.sort();

        let shadows = Bins::new(&batch.shadows, size);
        let solid = Bins::new(&batch.solid, size);
        let glass = Bins::new(&batch.glass, size);
        let lines = Bins::new(&batch.lines, size);
        let (stills, keep) = (&self.still, self.theme.shadow);
        let drawn: Vec<(Tile, Vec<u8>)> = numbers
            .into_par_iter()
            .filter_map(|number| {
                let mut tile = stills.as_ref()?.1.get(number)?.clone();
                shadows
                    .of(number, &batch.shadows)
                    .for_each(|t| tile.shadow(t));
                tile.darken(keep);
                solid.of(number, &batch.solid).for_each(|t| tile.solid(t));
                glass.of(number, &batch.glass).for_each(|t| tile.glass(t));
                lines.of(number, &batch.lines).for_each(|t| tile.glass(t));
                let pixels = tile.pixels().flatten().collect();
                Some((tile, pixels))
            })
            .collect();
        let mut rgb = vec![0; size[0] * size[1] * 3];
        for (tile, pixels) in &drawn {
            for (row, line) in pixels.chunks_exact(3 * tile.width).enumerate() {
                let at = 3 * ((tile.top + row) * size[0] + tile.left);
                rgb[at..at + line.len()].copy_from_slice(line);
            }
        }
        Picture {
            width: self.size[0],
            height: self.size[1],
            rgb: smaller(&rgb, size[0], self.fineness),
        }
    }

    fn statics(&self, projector: &Projector) -> Batch {
        let parts = self.statics.par_chunks(SHARE).map(|share| {
            let mut batch = Batch::default();
            for lit in share {
                if self.plane && lit.shadow {
                    let below = lit.corners.map(|c| glyph::on_ground(c, self.origin_m));
                    if let [Some(a), Some(b), Some(c)] = below {
                        projector.triangle([a, b, c], [[0; 4]; 3], &mut batch.shadows);
                    }
                }
                let into = match lit.rgba[0][3] {
                    255 => &mut batch.solid,
                    _ => &mut batch.glass,
                };
                projector.triangle(lit.corners, lit.rgba, into);
            }
            batch
        });
        joined(parts.collect())
    }

    /// Of what stands still, what lets through.
    fn clear(&self, projector: &Projector) -> Vec<Triangle> {
        let mut out = Vec::new();
        for lit in self.statics.iter().filter(|lit| lit.rgba[0][3] < 255) {
            projector.triangle(lit.corners, lit.rgba, &mut out);
        }
        out
    }
}

/// Puts batches together, in their order.
pub(super) fn joined(parts: Vec<Batch>) -> Batch {
    let mut all = Batch::default();
    for part in parts {
        all.append(part);
    }
    all
}

/// The mean of each square of pixels.
fn smaller(rgb: &[u8], width: usize, fineness: usize) -> Vec<u8> {
    if fineness == 1 {
        return rgb.to_vec();
    }
    let (across, rows) = (width / fineness, rgb.len() / (3 * width) / fineness);
    let count = (fineness * fineness) as u32;
    let mut out = Vec::with_capacity(across * rows * 3);
    for y in 0..rows {
        for x in 0..across {
            for part in 0..3 {
                let mut sum = count / 2;
                for (row, column) in (0..fineness).flat_map(|r| (0..fineness).map(move |c| (r, c)))
                {
                    let at = (y * fineness + row) * width + x * fineness + column;
                    sum += u32::from(rgb[3 * at + part]);
                }
                out.push((sum / count) as u8);
            }
        }
    }
    out
}

impl Stand<'_> {
    /// A line of a width in pixels of the finished picture.
    pub(super) fn line(
        &self,
        [from, to]: [Vec3; 2],
        rgba: [[u8; 4]; 2],
        width: f32,
        out: &mut Vec<Triangle>,
    ) {
        let (Some((a, _, near_a)), Some((b, _, near_b))) =
            (self.projector.place(from), self.projector.place(to))
        else {
            return;
        };
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = (dx * dx + dy * dy).sqrt();
        if length < 1e-3 {
            return;
        }
        let half = 0.5 * width * self.fineness / length;
        let (ax, ay) = (-dy * half, dx * half);
        let quad = [
            ([a[0] + ax, a[1] + ay], near_a, rgba[0]),
            ([a[0] - ax, a[1] - ay], near_a, rgba[0]),
            ([b[0] - ax, b[1] - ay], near_b, rgba[1]),
            ([b[0] + ax, b[1] + ay], near_b, rgba[1]),
        ];
        for corners in [[0, 1, 2], [0, 2, 3]] {
            let corners = corners.map(|k: usize| quad[k]);
            out.push(flat_triangle(corners));
        }
    }

    /// A disc of a radius in pixels of the finished picture.
    pub(super) fn disc(&self, middle: Vec3, rgba: [u8; 4], radius: f32, out: &mut Vec<Triangle>) {
        const RIM: [[f32; 2]; 8] = [
            [1.0, 0.0],
            [0.707, 0.707],
            [0.0, 1.0],
            [-0.707, 0.707],
            [-1.0, 0.0],
            [-0.707, -0.707],
            [0.0, -1.0],
            [0.707, -0.707],
        ];
        let Some(([x, y], _, near)) = self.projector.place(middle) else {
            return;
        };
        let radius = radius * self.fineness;
        let corner = |k: usize| ([x + radius * RIM[k][0], y + radius * RIM[k][1]], near, rgba);
        for k in 1..RIM.len() - 1 {
            out.push(flat_triangle([corner(0), corner(k), corner(k + 1)]));
        }
    }
}

fn flat_triangle(corners: [([f32; 2], f32, [u8; 4]); 3]) -> Triangle {
    let grid = |part: usize| corners.map(|(at, _, _)| (at[part] * GRID as f32).round() as i32);
    Triangle {
        x: grid(0),
        y: grid(1),
        near: corners.map(|(_, near, _)| near),
        rgba: corners.map(|(_, _, rgba)| rgba),
    }
}
