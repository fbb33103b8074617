//! Which samples a triangle covers: four a pixel.
//!
//! Edges are decided in whole numbers, so that two triangles with a common edge leave no gap and cover no sample twice.

use super::triangle::{GRID, Triangle};

/// Where a pixel is sampled, from its upper left corner, on that grid: each at a column and a row of its
/// own, so that steep and flat edges have four steps.
pub(super) const SAMPLES: [[i64; 2]; 4] = [[96, 32], [224, 96], [32, 160], [160, 224]];

/// A sample's place from the middle of its pixel, pixels.
pub(super) fn middle_of(sample: [i64; 2]) -> [f32; 2] {
    sample.map(|steps| (steps - i64::from(GRID / 2)) as f32 / GRID as f32)
}

/// How a number that is known at the corners grows to the right and down, a pixel.
pub(super) fn slope(triangle: &Triangle, [a, b, c]: [f32; 3]) -> [f32; 2] {
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
    use super::super::triangle::TILE;
    use super::*;

    fn triangle(corners: [[f64; 2]; 3]) -> Triangle {
        let grid = |value: f64| (value * f64::from(GRID)).round() as i32;
        Triangle {
            x: corners.map(|c| grid(c[0])),
            y: corners.map(|c| grid(c[1])),
            near: [1.0; 3],
            rgba: [[255; 4]; 3],
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
        let t = triangle([[3.3, 2.1], [60.7, 20.4], [22.9, 61.5]]);
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
            fan.push(triangle(corners));
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
}
