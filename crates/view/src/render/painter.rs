//! From a stage, a camera and a swarm to a picture.

use super::backdrop::{self, Backdrop, Ground};
use super::camera::{Camera, Lens, Projector};
use super::light::{Haze, Theme};
use super::shade::Shade;
use super::shadow::Shadows;
use super::skins::Skins;
use super::solid::Face;
use super::tile::Tile;
use super::triangle::{Batch, Bins, Triangle, tiles};
use super::visible::Visible;
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

/// What stands still, and its light.
pub(super) struct Scenery {
    /// A point near to all that is seen; the corners of faces are around it.
    pub(super) origin_m: DVec3,
    /// How large is what is to be seen, m.
    pub(super) extent_m: f64,
    /// How far from there everything reaches, m: how far the air is clear.
    pub(super) reach_m: f64,
    pub(super) faces: Vec<Face>,
    pub(super) skins: Skins,
    /// The picture of the ground, by its place among them.
    pub(super) ground: Option<u16>,
    /// Whether the plane `z = 0` is ground.
    pub(super) plane: bool,
    /// How far the world reaches, m.
    pub(super) radius_m: f64,
    /// Whether there are lines on the ground.
    pub(super) grid: bool,
}

/// Draws pictures of one stage.
pub(super) struct Painter {
    pub(super) theme: Theme,
    pub(super) scenery: Scenery,
    /// Size of the finished picture.
    pub(super) size: [u32; 2],
    /// Each pixel is drawn as so many across and down.
    pub(super) fineness: usize,
    shadows: Option<Shadows>,
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
/// Shadows are drawn so far around the middle, in extents of the whole and in m.
const SHADOWS: f64 = 2.5;
const SHADOWS_LEAST_M: f64 = 20.0;
/// The air is clear up to this share of how far one sees, and hides everything from this one on.
const CLEAR: f64 = 0.35;
const GONE: f64 = 1.25;

impl Painter {
    pub(super) fn new(theme: Theme, scenery: Scenery, size: [u32; 2], fineness: usize) -> Self {
        // Farther away a shadow is smaller than its pixels.
        let around_m = SHADOWS * scenery.extent_m + SHADOWS_LEAST_M;
        Self {
            theme,
            shadows: Shadows::new(&scenery.faces, scenery.origin_m, around_m),
            scenery,
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
        let Scenery {
            origin_m, extent_m, ..
        } = self.scenery;
        let away_m = (camera.eye_m - origin_m).length();
        let far_m = (3.0 * self.scenery.reach_m).max(14.0 * away_m);
        let haze = Haze {
            from_m: (CLEAR * far_m + away_m) as f32,
            to_m: (GONE * far_m + away_m) as f32,
            light: self.theme.horizon,
        };
        let near_m = match camera.lens {
            Lens::Flat { .. } => 0.0,
            Lens::Perspective { .. } => (2e-3 * extent_m).clamp(0.02, 1.0),
        };
        let projector = Projector::new(&large, size, origin_m, near_m, Some(haze));
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
            self.still = Some((*camera, self.scene(camera, &large, &projector, size, haze)));
        }
        // What lets through has to be drawn with what moves.
        batch.glass.append(&mut self.clear(&projector));
        batch.sort();

        let shadows = Bins::new(&batch.shadows, size);
        let solid = Bins::new(&batch.solid, size);
        let glass = Bins::new(&batch.glass, size);
        let lines = Bins::new(&batch.lines, size);
        let (stills, keep) = (&self.still, self.theme.shadow());
        let drawn: Vec<([usize; 3], Vec<u8>)> = numbers
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
                Some(([tile.left, tile.top, tile.width], pixels))
            })
            .collect();
        let mut rgb = vec![0; size[0] * size[1] * 3];
        for ([left, top, width], pixels) in &drawn {
            for (row, line) in pixels.chunks_exact(3 * width).enumerate() {
                let at = 3 * ((top + row) * size[0] + left);
                rgb[at..at + line.len()].copy_from_slice(line);
            }
        }
        Picture {
            width: self.size[0],
            height: self.size[1],
            rgb: smaller(&rgb, size[0], self.fineness),
        }
    }

    /// All that stands still and lets nothing through.
    fn scene(
        &self,
        camera: &Camera,
        large: &Camera,
        projector: &Projector,
        size: [usize; 2],
        haze: Haze,
    ) -> Vec<Tile> {
        let scenery = &self.scenery;
        let ground = Ground {
            plane: scenery.plane,
            radius_m: scenery.radius_m,
            cell_m: (scenery.grid).then(|| backdrop::cell_m(camera.scale_around(scenery.origin_m))),
        };
        let times = self.fineness as f64;
        let backdrop = Backdrop::new(*large, self.theme, Some(haze), size, ground, times);
        let shares: Vec<usize> = (0..scenery.faces.len()).step_by(SHARE).collect();
        let parts: Vec<(Vec<Triangle>, Vec<u32>)> = shares
            .into_par_iter()
            .map(|first| {
                let (mut triangles, mut numbers) = (Vec::new(), Vec::new());
                let share = scenery.faces[first..].iter().take(SHARE);
                for (at, face) in share.enumerate().filter(|(_, face)| solid(face)) {
                    projector.triangle(face.corners, face.rgba, &mut triangles);
                    numbers.resize(triangles.len(), (first + at) as u32);
                }
                (triangles, numbers)
            })
            .collect();
        let (mut triangles, mut numbers) = (Vec::new(), Vec::new());
        for (mut part, mut own) in parts {
            triangles.append(&mut part);
            numbers.append(&mut own);
        }
        let bins = Bins::new(&triangles, size);
        let flat = matches!(camera.lens, Lens::Flat { .. });
        let shade = Shade {
            backdrop: &backdrop,
            faces: &scenery.faces,
            skins: &scenery.skins,
            ground: scenery.ground,
            shadows: self.shadows.as_ref(),
            theme: &self.theme,
            haze: (!flat).then_some(haze),
            origin_m: scenery.origin_m,
        };
        let [across, down] = tiles(size);
        (0..across * down)
            .into_par_iter()
            .map(|number| {
                let mut seen = Visible::new(number, size);
                seen.ground(&backdrop);
                for place in bins.places(number) {
                    seen.draw(&triangles[place], numbers[place]);
                }
                seen.shaded(|sight| shade.colour(sight))
            })
            .collect()
    }

    /// Of what stands still, what lets through.
    fn clear(&self, projector: &Projector) -> Vec<Triangle> {
        let mut out = Vec::new();
        for face in self.scenery.faces.iter().filter(|face| !solid(face)) {
            let lit = [0, 1, 2].map(|k| self.theme.lit_bytes(face.rgba[k], face.normals[k]));
            projector.triangle(face.corners, lit, &mut out);
        }
        out
    }
}

fn solid(face: &Face) -> bool {
    face.rgba.iter().all(|rgba| rgba[3] == 255)
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
            out.push(Triangle::on_screen(corners));
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
            out.push(Triangle::on_screen([corner(0), corner(k), corner(k + 1)]));
        }
    }
}
