//! A part of the picture with all its samples: the nearest wins, and what lets through is put over it.

use super::cover::{cover, slope};
use super::triangle::{GRID, Triangle};

/// A part of the picture, with all its samples.
#[derive(Clone)]
pub(super) struct Tile {
    /// Its upper left corner, and its size, pixels.
    pub(super) left: usize,
    pub(super) top: usize,
    pub(super) width: usize,
    pub(super) height: usize,
    near: Vec<[f32; 4]>,
    colour: Vec<[[u8; 3]; 4]>,
    /// The samples in shadow.
    shade: Vec<u8>,
    /// The samples that the sun does not reach in any case.
    sunless: Vec<u8>,
}

impl Tile {
    /// A tile at a place (left, top, width, height) with what is known of its samples: how near they are, their
    /// colours, and which of them the sun does not reach.
    pub(super) fn of(
        [left, top, width, height]: [usize; 4],
        near: Vec<[f32; 4]>,
        colour: Vec<[[u8; 3]; 4]>,
        sunless: Vec<u8>,
    ) -> Self {
        Self {
            left,
            top,
            width,
            height,
            near,
            colour,
            shade: vec![0; width * height],
            sunless,
        }
    }

    /// Draws one that hides what is behind it.
    pub(super) fn solid(&mut self, triangle: &Triangle) {
        let (near, colour) = (&mut self.near, &mut self.colour);
        let ink = Ink::new(triangle);
        let place = [self.left, self.top, self.width, self.height];
        cover(place, triangle, |at, mask, nearness, x, y| {
            let mut rgb = None;
            for sample in 0..4 {
                if mask >> sample & 1 == 1 && nearness[sample] > near[at][sample] {
                    near[at][sample] = nearness[sample];
                    let [r, g, b, _] = *rgb.get_or_insert_with(|| ink.at(x, y));
                    colour[at][sample] = [r, g, b];
                }
            }
        });
    }

    /// Draws one that lets through what is behind it.
    pub(super) fn glass(&mut self, triangle: &Triangle) {
        let (near, colour) = (&self.near, &mut self.colour);
        let ink = Ink::new(triangle);
        let place = [self.left, self.top, self.width, self.height];
        cover(place, triangle, |at, mask, nearness, x, y| {
            let mut rgba = None;
            for sample in 0..4 {
                if mask >> sample & 1 == 1 && nearness[sample] >= near[at][sample] {
                    let rgba = *rgba.get_or_insert_with(|| ink.at(x, y));
                    blend(&mut colour[at][sample], rgba);
                }
            }
        });
    }

    /// Marks what lies in the shadow of one.
    pub(super) fn shadow(&mut self, triangle: &Triangle) {
        let (near, shade) = (&self.near, &mut self.shade);
        let place = [self.left, self.top, self.width, self.height];
        cover(place, triangle, |at, mask, nearness, _, _| {
            for sample in 0..4 {
                if mask >> sample & 1 == 1 && nearness[sample] >= near[at][sample] {
                    shade[at] |= 1 << sample;
                }
            }
        });
    }

    /// Darkens what was marked and was in the sun, by a share of its colour in 256ths.
    pub(super) fn darken(&mut self, keep: [u16; 3]) {
        let samples = self.shade.iter_mut().zip(&self.sunless);
        for ((marks, sunless), colours) in samples.zip(&mut self.colour) {
            let dark = *marks & !sunless;
            *marks = 0;
            if dark == 0 {
                continue;
            }
            for (sample, colour) in colours.iter_mut().enumerate() {
                if dark >> sample & 1 == 1 {
                    for (part, keep) in colour.iter_mut().zip(keep) {
                        *part = (u16::from(*part) * keep / 256) as u8;
                    }
                }
            }
        }
    }

    /// The colours of its pixels, row by row.
    pub(super) fn pixels(&self) -> impl Iterator<Item = [u8; 3]> + '_ {
        self.colour.iter().map(|samples| {
            std::array::from_fn(|part| {
                let sum: u16 = samples.iter().map(|rgb| u16::from(rgb[part])).sum();
                ((sum + 2) / 4) as u8
            })
        })
    }
}

/// Puts a colour over another.
fn blend(below: &mut [u8; 3], [r, g, b, alpha]: [u8; 4]) {
    let alpha = u32::from(alpha);
    for (under, over) in below.iter_mut().zip([r, g, b]) {
        let mixed = u32::from(over) * alpha + u32::from(*under) * (255 - alpha);
        *under = ((mixed + 127) / 255) as u8;
    }
}

/// The colour of a triangle from place to place.
enum Ink {
    Plain([u8; 4]),
    /// At the first corner, and how it grows to the right and down, a pixel.
    Mixed {
        at: [f32; 2],
        start: [f32; 4],
        right: [f32; 4],
        down: [f32; 4],
    },
}

impl Ink {
    fn new(triangle: &Triangle) -> Self {
        let [a, b, c] = triangle.rgba;
        if a == b && b == c {
            return Self::Plain(a);
        }
        let part = |part: usize| slope(triangle, [a, b, c].map(|rgba| f32::from(rgba[part])));
        let parts = [part(0), part(1), part(2), part(3)];
        Self::Mixed {
            at: [
                triangle.x[0] as f32 / GRID as f32,
                triangle.y[0] as f32 / GRID as f32,
            ],
            start: a.map(f32::from),
            right: parts.map(|[right, _]| right),
            down: parts.map(|[_, down]| down),
        }
    }

    /// In the middle of a pixel.
    fn at(&self, x: usize, y: usize) -> [u8; 4] {
        match self {
            Self::Plain(rgba) => *rgba,
            Self::Mixed {
                at,
                start,
                right,
                down,
            } => {
                let (dx, dy) = (x as f32 + 0.5 - at[0], y as f32 + 0.5 - at[1]);
                std::array::from_fn(|part| {
                    (start[part] + right[part] * dx + down[part] * dy + 0.5) as u8
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::triangle::TILE;
    use super::*;

    /// A tile of one colour, so near.
    fn plain(rgb: [u8; 3], near: f32) -> Tile {
        let count = TILE * TILE;
        Tile::of(
            [0, 0, TILE, TILE],
            vec![[near; 4]; count],
            vec![[rgb; 4]; count],
            vec![0; count],
        )
    }

    fn triangle(corners: [[f64; 2]; 3], near: f32, rgba: [u8; 4]) -> Triangle {
        let grid = |value: f64| (value * f64::from(GRID)).round() as i32;
        Triangle {
            x: corners.map(|c| grid(c[0])),
            y: corners.map(|c| grid(c[1])),
            near: [near; 3],
            rgba: [rgba; 3],
        }
    }
    #[test]
    fn the_nearer_one_is_seen_in_whatever_order_they_are_drawn() {
        let far = triangle(
            [[0.0, 0.0], [128.0, 0.0], [0.0, 128.0]],
            1.0,
            [10, 0, 0, 255],
        );
        let near = triangle(
            [[0.0, 0.0], [128.0, 0.0], [0.0, 128.0]],
            2.0,
            [20, 0, 0, 255],
        );
        for order in [[far, near], [near, far]] {
            let mut tile = plain([0; 3], f32::NEG_INFINITY);
            order.iter().for_each(|t| tile.solid(t));
            assert!(tile.pixels().all(|rgb| rgb == [20, 0, 0]));
        }
    }

    #[test]
    fn two_that_cross_meet_where_they_are_equally_near() {
        let mut level = triangle(
            [[0.0, 0.0], [128.0, 0.0], [0.0, 128.0]],
            0.0,
            [10, 0, 0, 255],
        );
        level.near = [0.5; 3];
        let mut rising = triangle(
            [[0.0, 0.0], [128.0, 0.0], [0.0, 128.0]],
            0.0,
            [20, 0, 0, 255],
        );
        rising.near = [0.0, 2.0, 0.0];
        let mut tile = plain([0; 3], f32::NEG_INFINITY);
        tile.solid(&level);
        tile.solid(&rising);
        let row: Vec<u8> = tile.pixels().take(TILE).map(|rgb| rgb[0]).collect();
        assert!(row[..31].iter().all(|c| *c == 10), "{row:?}");
        assert!(row[33..].iter().all(|c| *c == 20), "{row:?}");
    }

    #[test]
    fn half_covered_and_half_clear_mix() {
        let mut tile = plain([0; 3], 0.0);
        // The left half of the columns 0..=10, and half of column 10.
        let quad = [
            [[0.0, 0.0], [10.5, 0.0], [10.5, 64.0]],
            [[0.0, 0.0], [10.5, 64.0], [0.0, 64.0]],
        ];
        quad.iter()
            .for_each(|q| tile.glass(&triangle(*q, 1.0, [200, 200, 200, 128])));
        let row: Vec<u8> = tile.pixels().take(12).map(|rgb| rgb[0]).collect();
        assert_eq!(row[..12], [[100_u8; 10].as_slice(), &[50, 0]].concat());
    }

    #[test]
    fn a_shadow_darkens_once_and_only_what_is_not_hidden() {
        let all = [[0.0, 0.0], [128.0, 0.0], [0.0, 128.0]];
        let mut tile = plain([200; 3], 1.0);
        // The last column of the tile has no sun anyway.
        for row in 0..TILE {
            tile.sunless[TILE * row + TILE - 1] = 15;
        }
        tile.solid(&triangle(
            [[32.0, 0.0], [60.0, 0.0], [32.0, 1000.0]],
            3.0,
            [90, 90, 90, 255],
        ));
        tile.shadow(&triangle(all, 2.0, [0; 4]));
        tile.shadow(&triangle(all, 2.0, [0; 4]));
        tile.darken([128; 3]);
        let row: Vec<u8> = tile.pixels().take(TILE).map(|rgb| rgb[0]).collect();
        assert_eq!((row[5], row[36], row[TILE - 1]), (100, 90, 200));
    }
}
