//! A uniform grid wrapped around a torus: which places may be near another.
//!
//! Space is cut into cubes; the cube at `(x, y, z)` goes into the bucket of its coordinates modulo
//! powers of two, so the grid needs no bounds. Buckets are filled by a counting sort, and those along
//! x lie side by side: the cubes about a place are a few runs of the sorted order. Distant cubes share
//! a bucket, so whoever asks compares distances for himself.

use std::ops::Range;

/// Cells of a swarm that fills little of its width.
const CELLS_PER_PLACE: usize = 2;

/// The grid.
#[derive(Debug, Default)]
pub(crate) struct Grid {
    /// The places by bucket; within a bucket in their own order.
    order: Vec<u32>,
    /// Where each bucket begins in `order`; one more entry than buckets.
    start: Vec<u32>,
    keys: Vec<u32>,
    /// Buckets along each axis are two to these powers.
    bits: [u32; 3],
    cell_m: f64,
}

/// How wide a swarm is along each axis, m: four times the mean distance from the mean, which is the
/// width if it fills it evenly, and which few strays change little.
pub(crate) fn widths_m(places: &[Vec<f32>; 3]) -> [f64; 3] {
    places.each_ref().map(|axis| {
        let count = axis.len().max(1) as f64;
        let mean = axis.iter().map(|&x| f64::from(x)).sum::<f64>() / count;
        4.0 * axis
            .iter()
            .map(|&x| (f64::from(x) - mean).abs())
            .sum::<f64>()
            / count
    })
}

/// About which share of a swarm of these widths lies in a cube of edge `2 reach` around one of it.
pub(crate) fn share_within(reach_m: f64, widths_m: [f64; 3]) -> f64 {
    widths_m
        .iter()
        .map(|width| {
            if *width > 2.0 * reach_m {
                2.0 * reach_m / width
            } else {
                1.0
            }
        })
        .product()
}

/// The greatest integer not above `x`, without the library call that `floor` is on older processors.
#[inline]
fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole.saturating_sub(i64::from(whole as f64 > x))
}

impl Grid {
    /// Sorts places (east, north, up, m) into cubes with edges of `cell_m`; of those that are not
    /// numbers it does not matter where they go.
    pub(crate) fn build(&mut self, places: &[Vec<f32>; 3], widths_m: [f64; 3], cell_m: f64) {
        let count = places[0].len();
        self.cell_m = cell_m;
        // Axis by axis twice as many, where there are too few for the width, until they are enough.
        self.bits = [0; 3];
        let most = (CELLS_PER_PLACE * count).max(1).ilog2();
        while self.bits.iter().sum::<u32>() < most {
            let lacks =
                |axis: usize| widths_m[axis] / (cell_m * f64::from(1u32 << self.bits[axis]));
            let worst = (1..3).fold(0, |worst, axis| {
                if lacks(axis) > lacks(worst) {
                    axis
                } else {
                    worst
                }
            });
            if lacks(worst).is_nan() || lacks(worst) <= 1.0 {
                break;
            }
            self.bits[worst] += 1;
        }

        let mut keys = std::mem::take(&mut self.keys);
        keys.clear();
        let [x, y, z] = places;
        keys.extend((0..count).map(|i| self.key([x[i], y[i], z[i]].map(|c| self.cube(c.into())))));
        self.start.clear();
        self.start
            .resize((1 << self.bits.iter().sum::<u32>()) + 1, 0);
        for key in &keys {
            self.start[*key as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.start {
            end += *start;
            *start = end;
        }
        self.order.clear();
        self.order.resize(count, 0);
        for (place, key) in keys.iter().enumerate().rev() {
            let start = &mut self.start[*key as usize];
            *start -= 1;
            self.order[*start as usize] = place as u32;
        }
        self.keys = keys;
    }

    /// The places in the order of their buckets.
    pub(crate) fn order(&self) -> &[u32] {
        &self.order
    }

    #[inline]
    fn cube(&self, x: f64) -> i64 {
        floor(x / self.cell_m)
    }

    #[inline]
    fn key(&self, cube: [i64; 3]) -> u32 {
        let [x, y, z] = [0, 1, 2].map(|axis| (cube[axis] & ((1 << self.bits[axis]) - 1)) as u32);
        ((z << self.bits[1] | y) << self.bits[0]) | x
    }

    /// The places of each bucket that holds any, as a run of [`order`](Self::order).
    pub(crate) fn buckets(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let ends = self.start.windows(2);
        let runs = ends.map(|ends| ends[0] as usize..ends[1] as usize);
        runs.filter(|run| !run.is_empty())
    }

    /// The cubes along an axis that come within `reach` of the stretch from `x[0]` to `x[1]`; no more than
    /// there are buckets, since from there on they repeat.
    #[inline]
    fn span(&self, axis: usize, x: [f64; 2], reach: f64) -> Range<i64> {
        let (low, high) = (self.cube(x[0] - reach), self.cube(x[1] + reach));
        low..high
            .saturating_add(1)
            .min(low.saturating_add(1 << self.bits[axis]))
    }

    /// Calls `visit` with runs of [`order`](Self::order) that together hold, each once, all places
    /// within `reach` of `p`, and others.
    #[inline]
    pub(crate) fn around(&self, p: [f32; 3], reach: f64, visit: impl FnMut(Range<usize>)) {
        self.around_box([p, p], reach, visit);
    }

    /// The same for all places within `reach` of a box, given by its least and its greatest corner.
    #[inline]
    pub(crate) fn around_box(
        &self,
        corners: [[f32; 3]; 2],
        reach: f64,
        mut visit: impl FnMut(Range<usize>),
    ) {
        let [x, y, z] = [0, 1, 2].map(|axis| corners.map(|corner| f64::from(corner[axis])));
        let side = 1_i64 << self.bits[0];
        // How far the cubes number `cube` along an axis are from a stretch, at least.
        let gap = |x: [f64; 2], cube: i64| {
            let low = cube as f64 * self.cell_m;
            (low - x[1]).max(x[0] - low - self.cell_m).max(0.0)
        };
        let (ys, zs) = (self.span(1, y, reach), self.span(2, z, reach));
        // Where cubes repeat, another one of the same bucket may be nearer than the one that is counted.
        let wraps =
            [(&ys, 1), (&zs, 2)].map(|(span, axis)| span.end - span.start == 1 << self.bits[axis]);
        for cube_z in zs.clone() {
            let gap_z = if wraps[1] { 0.0 } else { gap(z, cube_z) };
            for cube_y in ys.clone() {
                let gap_y = if wraps[0] { 0.0 } else { gap(y, cube_y) };
                let rest = reach * reach - gap_z * gap_z - gap_y * gap_y;
                if rest < 0.0 {
                    continue;
                }
                let xs = self.span(0, x, rest.sqrt());
                let row = self.key([0, cube_y, cube_z]) as usize;
                let first = (xs.start & (side - 1)) as usize;
                let last = first + (xs.end - xs.start) as usize;
                let end = side as usize;
                let run = |from: usize, to: usize| {
                    self.start[row + from] as usize..self.start[row + to] as usize
                };
                visit(run(first, last.min(end)));
                if last > end {
                    visit(run(0, last - end));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use simbeeotic_kernel::Stream;

    fn scattered(stream: &mut Stream, count: usize, size: [f64; 3]) -> [Vec<f32>; 3] {
        size.map(|size| {
            (0..count)
                .map(|_| stream.uniform_in(-size..size) as f32)
                .collect()
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn everybody_near_is_found_once(
            seed: u64, count in 1..400usize, flat: bool, size in 0.1..300.0f64, cell in 0.5..40.0f64,
            stray in 0.0..1e6f64,
        ) {
            let mut stream = Stream::new(seed, "grid", "test");
            let mut places = scattered(&mut stream, count, [size, size, if flat { 1.0 } else { size }]);
            places[0][0] = stray as f32;
            let mut grid = Grid::default();
            grid.build(&places, widths_m(&places), cell);
            for _ in 0..20 {
                let reach = stream.uniform_in(0.0..2.0 * size);
                let p = [(); 3].map(|()| stream.uniform_in(-size..size) as f32);
                let near = |&i: &u32| {
                    let d = [0, 1, 2].map(|k| f64::from(places[k][i as usize]) - f64::from(p[k]));
                    d.iter().map(|d| d * d).sum::<f64>() <= reach * reach
                };
                let mut found = Vec::new();
                grid.around(p, reach, |run| found.extend_from_slice(&grid.order()[run]));
                found.sort_unstable();
                let all = found.len();
                found.dedup();
                prop_assert_eq!(found.len(), all, "each once");
                found.retain(near);
                let expected: Vec<u32> = (0..count as u32).filter(near).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }

    #[test]
    fn a_sparse_swarm_is_not_searched_as_a_whole() {
        let mut stream = Stream::new(1, "grid", "sparse");
        let mut places = scattered(&mut stream, 10_000, [500.0, 500.0, 1.0]);
        // One far away does not spoil the cells of the others.
        places[0][77] = 1e6;
        let mut grid = Grid::default();
        grid.build(&places, widths_m(&places), 15.0);
        let mut looked_at = 0;
        for i in (0..10_000).step_by(10) {
            let p = [0, 1, 2].map(|k| places[k][i]);
            grid.around(p, 30.0, |run| looked_at += run.len());
        }
        // A disc of 30 m holds 28, the cells about it not more than twice that.
        assert!(looked_at < 1000 * 60, "{looked_at}");
    }

    #[test]
    fn the_share_within_reach_is_that_of_an_even_swarm() {
        let mut stream = Stream::new(1, "grid", "share");
        let places = scattered(&mut stream, 20_000, [100.0, 200.0, 3.0]);
        let share = share_within(30.0, widths_m(&places));
        assert!(
            (share / (60.0 / 200.0 * 60.0 / 400.0) - 1.0).abs() < 0.03,
            "{share}"
        );
    }
}
