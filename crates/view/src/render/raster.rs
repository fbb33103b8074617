//! Triangles to pixels: tiles, four samples a pixel, the nearest wins.
//!
//! Corners lie on a grid of 1/256 pixel and edges are decided in whole numbers, so that two triangles
//! with a common edge leave no gap and cover no sample twice. A tile is drawn by one thread, its
//! triangles in the order of their list: the picture does not depend on how many threads there are.

/// Edge of a tile, pixels.
pub(super) const TILE: usize = 64;
/// Steps of the grid of corners, a pixel.
pub(super) const GRID: i32 = 256;
/// Where a pixel is sampled, from its upper left corner, on that grid: each at a column and a row of its
/// own, so that steep and flat edges have four steps.
pub(super) const SAMPLES: [[i64; 2]; 4] = [[96, 32], [224, 96], [32, 160], [160, 224]];

/// A sample's place from the middle of its pixel, pixels.
pub(super) fn middle_of(sample: [i64; 2]) -> [f32; 2] {
    sample.map(|steps| (steps - i64::from(GRID / 2)) as f32 / GRID as f32)
}

/// A triangle on the screen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Corners, right and down from the upper left corner of the picture, 1/256 pixel.
    pub(super) x: [i32; 3],
    pub(super) y: [i32; 3],
    /// How near each corner is; linear on the screen: the inverse of the distance, or its negative
    /// where there is no perspective.
    pub(super) near: [f32; 3],
    /// Red, green, blue, opacity of each corner.
    pub(super) rgba: [[u8; 4]; 3],
}

/// The triangles of a picture, by how they are drawn.
#[derive(Debug, Default)]
pub(super) struct Batch {
    /// What darkens the ground: once, however many lie on each other.
    pub(super) shadows: Vec<Triangle>,
    pub(super) solid: Vec<Triangle>,
    /// What lets through: drawn from back to front.
    pub(super) glass: Vec<Triangle>,
    /// What lets through, drawn last and in the order of the list.
    pub(super) lines: Vec<Triangle>,
}

impl Batch {
    /// Puts another batch behind this one.
    pub(super) fn append(&mut self, mut other: Self) {
        self.shadows.append(&mut other.shadows);
        self.solid.append(&mut other.solid);
        self.glass.append(&mut other.glass);
        self.lines.append(&mut other.lines);
    }

    /// Brings what lets through into its order.
    pub(super) fn sort(&mut self) {
        let depth = |t: &Triangle| t.near.iter().sum::<f32>();
        self.glass.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
    }
}

/// Which triangles touch which tile.
pub(super) struct Bins {
    lists: Vec<Vec<u32>>,
}

impl Bins {
    /// `size`: of the picture, pixels.
    pub(super) fn new(triangles: &[Triangle], size: [usize; 2]) -> Self {
        let [across, down] = tiles(size);
        let mut lists = vec![Vec::new(); across * down];
        let span = |v: &[i32; 3], end: usize| {
            let (low, high) = (v[0].min(v[1]).min(v[2]), v[0].max(v[1]).max(v[2]));
            let edge = GRID * TILE as i32;
            let (low, high) = (low.div_euclid(edge), high.div_euclid(edge));
            (high >= 0 && low < end as i32)
                .then(|| low.max(0) as usize..=(high as usize).min(end - 1))
        };
        for (at, triangle) in triangles.iter().enumerate() {
            let (Some(columns), Some(rows)) = (span(&triangle.x, across), span(&triangle.y, down))
            else {
                continue;
            };
            for row in rows {
                for column in columns.clone() {
                    lists[row * across + column].push(at as u32);
                }
            }
        }
        Self { lists }
    }

    /// The triangles of one tile, in their order.
    pub(super) fn of<'a>(
        &'a self,
        tile: usize,
        triangles: &'a [Triangle],
    ) -> impl Iterator<Item = &'a Triangle> {
        self.places(tile).map(|at| &triangles[at])
    }

    /// Their places in the list.
    pub(super) fn places(&self, tile: usize) -> impl Iterator<Item = usize> + '_ {
        self.lists[tile].iter().map(|at| *at as usize)
    }
}

/// How many tiles a picture has, across and down.
pub(super) fn tiles([width, height]: [usize; 2]) -> [usize; 2] {
    [width.div_ceil(TILE), height.div_ceil(TILE)]
}

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

/// How a number that is known at the corners grows to the right and down, a pixel.
fn slope(triangle: &Triangle, [a, b, c]: [f32; 3]) -> [f32; 2] {
    let Triangle { x, y, .. } = triangle;
    let side = |v: &[i32; 3], k: usize| f64::from(v[k] - v[0]);
    let (x1, y1, x2, y2) = (side(x, 1), side(y, 1), side(x, 2), side(y, 2));
    let area = x1 * y2 - x2 * y1;
    if area == 0.0 {
        return [0.0; 2];
    }
    let (first, second) = (f64::from(b - a), f64::from(c - a));
    let unit = f64::from(GRID) / area;
    [
        ((first * y2 - second * y1) * unit) as f32,
        ((second * x1 - first * x2) * unit) as f32,
    ]
}

/// Finds the samples of a tile that a triangle covers. `hit` gets the pixel's place in the tile, a bit for
/// each sample, how near each is, and the pixel's column and row in the picture.
#[inline]
pub(super) fn cover(
    [left, top, width, height]: [usize; 4],
    triangle: &Triangle,
    mut hit: impl FnMut(usize, u8, [f32; 4], usize, usize),
) {
    let corner = |k: usize| [i64::from(triangle.x[k]), i64::from(triangle.y[k])];
    let [a, mut b, mut c] = [corner(0), corner(1), corner(2)];
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    if area == 0 {
        return;
    }
    if area < 0 {
        std::mem::swap(&mut b, &mut c);
    }
    let grid = i64::from(GRID);
    let range = |part: usize, low: usize, size: usize| {
        let least = a[part].min(b[part]).min(c[part]).div_euclid(grid);
        let most = a[part].max(b[part]).max(c[part]).div_euclid(grid);
        (least.max(low as i64), most.min((low + size) as i64 - 1))
    };
    let ((x0, x1), (y0, y1)) = (range(0, left, width), range(1, top, height));
    if x0 > x1 || y0 > y1 {
        return;
    }
    let edges = [[a, b], [b, c], [c, a]].map(|[from, to]| Edge::new(from, to));
    let slope = slope(triangle, triangle.near);
    let low = triangle.near[0].min(triangle.near[1]).min(triangle.near[2]);
    let high = triangle.near[0].max(triangle.near[1]).max(triangle.near[2]);
    let first = [
        triangle.x[0] as f32 / GRID as f32,
        triangle.y[0] as f32 / GRID as f32,
    ];
    let offsets = SAMPLES
        .map(|[x, y]| slope[0] * (x as f32 / GRID as f32) + slope[1] * (y as f32 / GRID as f32));

    for y in y0..=y1 {
        let (mut from, mut to) = (x0, x1);
        if x1 - x0 > 6 {
            for edge in &edges {
                edge.narrow(y, &mut from, &mut to);
            }
        }
        if from > to {
            continue;
        }
        let mut sides = edges.each_ref().map(|edge| edge.at(from, y));
        let near_row = triangle.near[0] + slope[1] * (y as f32 - first[1]);
        for x in from..=to {
            let mut mask = 0_u8;
            for sample in 0..4 {
                let inside = (sides[0] + edges[0].samples[sample])
                    | (sides[1] + edges[1].samples[sample])
                    | (sides[2] + edges[2].samples[sample]);
                mask |= u8::from(inside >= 0) << sample;
            }
            if mask != 0 {
                let near = near_row + slope[0] * (x as f32 - first[0]);
                let nearness = offsets.map(|offset| (near + offset).clamp(low, high));
                let at = (y as usize - top) * width + (x as usize - left);
                hit(at, mask, nearness, x as usize, y as usize);
            }
            for (side, edge) in sides.iter_mut().zip(&edges) {
                *side += edge.right;
            }
        }
    }
}

/// One side of a triangle: zero and above is inside.
struct Edge {
    from: [i64; 2],
    along: [i64; 2],
    /// What a pixel to the right adds.
    right: i64,
    /// What each sample adds to its pixel's corner; a sample on the edge belongs to one of its two triangles.
    samples: [i64; 4],
    most: i64,
}

impl Edge {
    fn new(from: [i64; 2], to: [i64; 2]) -> Self {
        let along = [to[0] - from[0], to[1] - from[1]];
        let takes_edge = along[1] < 0 || (along[1] == 0 && along[0] > 0);
        let samples = SAMPLES.map(|[x, y]| along[0] * y - along[1] * x - i64::from(!takes_edge));
        Self {
            from,
            along,
            right: -along[1] * i64::from(GRID),
            samples,
            most: samples.into_iter().max().unwrap_or(0),
        }
    }

    /// At the upper left corner of a pixel.
    fn at(&self, x: i64, y: i64) -> i64 {
        let grid = i64::from(GRID);
        self.along[0] * (y * grid - self.from[1]) - self.along[1] * (x * grid - self.from[0])
    }

    /// Leaves out the pixels of a row that have no sample inside.
    fn narrow(&self, y: i64, from: &mut i64, to: &mut i64) {
        let start = self.at(0, y) + self.most;
        match self.right {
            0 if start < 0 => *to = *from - 1,
            0 => {}
            right if right > 0 => *from = (*from).max((-start).div_euclid(right)),
            right => *to = (*to).min(start.div_euclid(-right)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::visible::Visible;
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

    fn covered(triangles: &[Triangle]) -> usize {
        let mut samples = 0;
        for t in triangles {
            cover([0, 0, TILE, TILE], t, |_, mask, _, _, _| {
                samples += mask.count_ones() as usize;
            });
        }
        samples
    }

    #[test]
    fn a_triangle_covers_its_area() {
        let t = triangle([[3.3, 2.1], [60.7, 20.4], [22.9, 61.5]], 1.0, [255; 4]);
        let area = 0.5 * ((60.7 - 3.3) * (61.5 - 2.1) - (22.9 - 3.3) * (20.4 - 2.1_f64));
        let samples = covered(&[t]) as f64 / 4.0;
        assert!((samples - area).abs() < 0.01 * area, "{samples} {area}");
    }

    #[test]
    fn triangles_with_common_edges_cover_each_sample_once_whichever_way_they_turn() {
        // A fan around a point that lies on a sample, with corners on samples.
        let middle = [31.375, 30.125];
        let rim = [
            [0.0, 0.0],
            [31.375, 0.0],
            [64.0, 0.0],
            [64.0, 30.125],
            [64.0, 64.0],
            [0.0, 64.0],
        ];
        let mut fan = Vec::new();
        for k in 0..rim.len() {
            let (a, b) = (rim[k], rim[(k + 1) % rim.len()]);
            let corners = if k % 2 == 0 {
                [middle, a, b]
            } else {
                [b, middle, a]
            };
            fan.push(triangle(corners, 1.0, [255; 4]));
        }
        assert_eq!(covered(&fan), TILE * TILE * 4);
        let mut seen = vec![0_u8; TILE * TILE];
        for t in &fan {
            cover([0, 0, TILE, TILE], t, |at, mask, _, _, _| {
                assert_eq!(seen[at] & mask, 0, "covered twice");
                seen[at] |= mask;
            });
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

    #[test]
    fn one_behind_another_edge_to_edge_over_tiles_is_whole() {
        let size = [150, 100];
        let corners = [[-300.0, -200.0], [700.0, -100.0], [10.0, 900.0]];
        let all = [triangle(corners, 1.0, [7; 4])];
        let bins = Bins::new(&all, size);
        let [across, down] = tiles(size);
        let mut seen = 0;
        for number in 0..across * down {
            let mut tile = Visible::new(number, size);
            bins.of(number, &all).for_each(|t| tile.draw(t, 0));
            seen += tile.nearest().filter(|near| *near == 1.0).count();
        }
        assert_eq!(seen, 150 * 100);
    }
}
