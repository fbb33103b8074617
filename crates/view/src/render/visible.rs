//! What stands still, first without colours: which face is seen at which sample, and how near it is. Colours are
//! computed afterwards, once for each face that is seen in a pixel and not for those that are hidden.

use super::backdrop::Backdrop;
use super::cover::{SAMPLES, cover, middle_of};
use super::tile::Tile;
use super::triangle::{TILE, Triangle, tiles};
use simbeeotic_units::glam::Vec3;

/// Nothing but the sky.
pub(super) const SKY: u32 = u32::MAX;
/// The plane `z = 0`.
pub(super) const GROUND: u32 = u32::MAX - 1;
/// The same, cut through: from the side.
pub(super) const CUT: u32 = u32::MAX - 2;

/// A part of the picture: for each sample the face that is seen.
pub(super) struct Visible {
    left: usize,
    top: usize,
    width: usize,
    near: Vec<[f32; 4]>,
    face: Vec<[u32; 4]>,
}

/// What is seen at a place.
pub(super) struct Sight {
    /// The face's number, or one of the above.
    pub(super) face: u32,
    /// The place on the picture, pixels.
    pub(super) at: [f32; 2],
    /// As [`Triangle`] has it.
    pub(super) near: f32,
}

impl Visible {
    /// The tile with this number: the sky alone.
    pub(super) fn new(number: usize, size: [usize; 2]) -> Self {
        let [across, _] = tiles(size);
        let (left, top) = (number % across * TILE, number / across * TILE);
        let (width, height) = ((size[0] - left).min(TILE), (size[1] - top).min(TILE));
        Self {
            left,
            top,
            width,
            near: vec![[f32::NEG_INFINITY; 4]; width * height],
            face: vec![[SKY; 4]; width * height],
        }
    }

    /// Puts the ground in.
    pub(super) fn ground(&mut self, backdrop: &Backdrop) {
        for at in 0..self.near.len() {
            let [x, y] = self.pixel(at);
            let (face, near) = backdrop.behind([x as f64 + 0.5, y as f64 + 0.5]);
            self.face[at] = [face; 4];
            self.near[at] = SAMPLES.map(|sample| {
                let [right, down] = middle_of(sample);
                near[0] + near[1] * right + near[2] * down
            });
        }
    }

    /// Draws a face.
    pub(super) fn draw(&mut self, triangle: &Triangle, face: u32) {
        let place = [
            self.left,
            self.top,
            self.width,
            self.near.len() / self.width,
        ];
        let (near, faces) = (&mut self.near, &mut self.face);
        cover(place, triangle, |at, mask, nearness, _, _| {
            for sample in 0..4 {
                if mask >> sample & 1 == 1 && nearness[sample] > near[at][sample] {
                    near[at][sample] = nearness[sample];
                    faces[at][sample] = face;
                }
            }
        });
    }

    fn pixel(&self, at: usize) -> [usize; 2] {
        [self.left + at % self.width, self.top + at / self.width]
    }

    /// How near the nearest is, row by row.
    pub(super) fn nearest(&self) -> impl Iterator<Item = f32> + '_ {
        let most = |near: &[f32; 4]| near.iter().copied().fold(f32::NEG_INFINITY, f32::max);
        self.near.iter().map(most)
    }

    /// The tile's place and size: left, top, width, height, pixels.
    pub(super) fn place(&self) -> [usize; 4] {
        [
            self.left,
            self.top,
            self.width,
            self.near.len() / self.width,
        ]
    }

    /// With colours: `shade` gives the colour of a face at a place, and whether the sun does not reach it.
    pub(super) fn shaded(self, shade: impl Fn(&Sight) -> ([u8; 3], bool)) -> Tile {
        let mut colours = vec![[[0; 3]; 4]; self.near.len()];
        let mut sunless = vec![0_u8; self.near.len()];
        for (at, faces) in self.face.iter().enumerate() {
            let [x, y] = self.pixel(at);
            let mut done = 0_u8;
            for first in 0..4 {
                if done >> first & 1 == 1 {
                    continue;
                }
                // The middle of the samples that show the same face.
                let (mut count, mut middle) = (0.0, Vec3::ZERO);
                let mut same = 0_u8;
                for sample in first..4 {
                    if faces[sample] == faces[first] {
                        same |= 1 << sample;
                        count += 1.0;
                        let [right, down] = middle_of(SAMPLES[sample]);
                        middle += Vec3::new(right, down, self.near[at][sample]);
                    }
                }
                middle /= count;
                let (rgb, shadow) = shade(&Sight {
                    face: faces[first],
                    at: [x as f32 + 0.5 + middle.x, y as f32 + 0.5 + middle.y],
                    near: middle.z,
                });
                for sample in (0..4).filter(|sample| same >> sample & 1 == 1) {
                    colours[at][sample] = rgb;
                    sunless[at] |= u8::from(shadow) << sample;
                }
                done |= same;
            }
        }
        let [left, top, width, height] = self.place();
        Tile::of([left, top, width, height], self.near, colours, sunless)
    }
}

#[cfg(test)]
mod tests {
    use super::super::triangle::GRID;
    use super::*;

    #[test]
    fn a_face_is_shaded_once_in_a_pixel_and_only_where_it_is_seen() {
        let triangle = |corners: [[i32; 2]; 3], near: f32| Triangle {
            x: corners.map(|[x, _]| x * GRID),
            y: corners.map(|[_, y]| y * GRID),
            near: [near; 3],
            rgba: [[0; 4]; 3],
        };
        let mut seen = Visible::new(0, [64, 64]);
        // The whole tile, and before it the left half of it.
        seen.draw(&triangle([[0, 0], [200, 0], [0, 200]], 1.0), 0);
        let half = [[[0, 0], [32, 0], [32, 64]], [[0, 0], [32, 64], [0, 64]]];
        half.iter()
            .for_each(|half| seen.draw(&triangle(*half, 2.0), 1));
        let asked = std::cell::Cell::new(0);
        let tile = seen.shaded(|sight| {
            asked.set(asked.get() + 1);
            assert_eq!(sight.face, u32::from(sight.at[0] < 32.0), "{:?}", sight.at);
            assert_eq!(sight.near, 1.0 + sight.face as f32);
            ([10 * sight.face as u8; 3], false)
        });
        assert_eq!(asked.get(), 64 * 64);
        let row: Vec<u8> = tile.pixels().take(64).map(|[r, _, _]| r).collect();
        assert!(row[..32].iter().all(|c| *c == 10) && row[32..].iter().all(|c| *c == 0));
    }
}
