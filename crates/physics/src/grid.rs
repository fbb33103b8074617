//! A uniform grid wrapped around a torus: who is near a place.
//!
//! Space is cut into cubes; the cube at `(x, y, z)` goes into the bucket of its coordinates modulo a
//! power of two, so the grid needs no bounds, and a swarm far from the origin costs no more than one at
//! it. Buckets are filled by a counting sort, and a question visits only the cubes that its box
//! overlaps. Several distant cubes share a bucket; the exact distance decides.

use glam::DVec3;
use rayon::ThreadPool;
use rayon::prelude::*;

/// Items that one thread takes at a time.
const CHUNK: usize = 1024;

/// One entry, half a cache line.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(crate) struct Item {
    /// Where it was when the grid was built, m.
    pub(crate) centre: DVec3,
    /// Its own radius and how far it may go from there, m.
    pub(crate) reach: f32,
    /// The body.
    pub(crate) id: u32,
}

impl Item {
    const NONE: Self = Self {
        centre: DVec3::ZERO,
        reach: 0.0,
        id: 0,
    };

    pub(crate) fn reach(&self) -> f64 {
        f64::from(self.reach)
    }
}

/// The grid.
#[derive(Debug, Default)]
pub(crate) struct Grid {
    items: Vec<Item>,
    /// Where each bucket begins in `items`; one more entry than buckets.
    start: Vec<u32>,
    keys: Vec<u32>,
    /// Buckets along one axis are two to this power.
    bits: u32,
    per_metre: f64,
}

/// The greatest integer not above `x`, without the library call that `floor` is on older processors.
#[inline]
fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole.saturating_sub(i64::from(whole as f64 > x))
}

impl Grid {
    /// Sorts the items of `ids` into cubes with edges of `cell_m`.
    pub(crate) fn build(
        &mut self,
        cell_m: f64,
        ids: &[u32],
        item: impl Fn(u32) -> Item + Sync,
        pool: Option<&ThreadPool>,
    ) {
        self.bits = (ids.len().max(8).next_power_of_two().ilog2()).div_ceil(3);
        self.per_metre = 1.0 / cell_m;
        let mut keys = std::mem::take(&mut self.keys);
        let key = |id: &u32| self.key(self.cube(item(*id).centre));
        if let Some(pool) = pool {
            let ids = ids.par_iter().with_min_len(CHUNK);
            pool.install(|| ids.map(key).collect_into_vec(&mut keys));
        } else {
            keys.clear();
            keys.extend(ids.iter().map(key));
        }

        self.start.clear();
        self.start.resize((1 << (3 * self.bits)) + 1, 0);
        for key in &keys {
            self.start[*key as usize] += 1;
        }
        let mut end = 0;
        for start in &mut self.start {
            end += *start;
            *start = end;
        }
        self.items.resize(ids.len(), Item::NONE);
        for (id, key) in ids.iter().zip(&keys).rev() {
            let place = &mut self.start[*key as usize];
            *place -= 1;
            self.items[*place as usize] = item(*id);
        }
        self.keys = keys;
    }

    /// All items, by bucket and then in the order of their bodies.
    pub(crate) fn items(&self) -> &[Item] {
        &self.items
    }

    #[inline]
    fn cube(&self, p: DVec3) -> [i64; 3] {
        [
            floor(p.x * self.per_metre),
            floor(p.y * self.per_metre),
            floor(p.z * self.per_metre),
        ]
    }

    #[inline]
    fn key(&self, cube: [i64; 3]) -> u32 {
        let mask = (1_i64 << self.bits) - 1;
        let [x, y, z] = cube.map(|c| (c & mask) as u32);
        ((x << self.bits | y) << self.bits) | z
    }

    /// The items of the buckets `from..=to`.
    #[inline]
    fn run(&self, from: usize, to: usize) -> &[Item] {
        &self.items[self.start[from] as usize..self.start[to + 1] as usize]
    }

    /// Calls `visit` for each item whose cube comes within `radius` of `p`, and for some others.
    #[inline]
    pub(crate) fn around(&self, p: DVec3, radius: f64, mut visit: impl FnMut(&Item)) {
        let low = self.cube(p - radius);
        let high = self.cube(p + radius);
        let side = 1_i64 << self.bits;
        let wraps = |k: usize| high[k].saturating_sub(low[k]) >= side;
        if self.items.len() <= 16 || wraps(0) || wraps(1) || wraps(2) {
            self.items.iter().for_each(visit);
            return;
        }
        // Buckets along z lie side by side: a column is one run of items, or two where it wraps.
        let (bottom, top) = (
            (low[2] & (side - 1)) as usize,
            (high[2] & (side - 1)) as usize,
        );
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                let column = self.key([x, y, 0]) as usize;
                if bottom <= top {
                    self.run(column + bottom, column + top)
                        .iter()
                        .for_each(&mut visit);
                } else {
                    let last = column + side as usize - 1;
                    self.run(column + bottom, last).iter().for_each(&mut visit);
                    self.run(column, column + top).iter().for_each(&mut visit);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scattered(count: u32, size: f64) -> Grid {
        let mut grid = Grid::default();
        let mut stream = simbeeotic_kernel::rng::Stream::new(1, "grid", "test");
        let places: Vec<DVec3> = (0..count)
            .map(|_| DVec3::from_array([(); 3].map(|()| stream.uniform_in(-size..size))))
            .collect();
        let item = |id: u32| Item {
            centre: places[id as usize],
            reach: 0.1,
            id,
        };
        let ids: Vec<u32> = (0..count).collect();
        grid.build(2.0, &ids, item, None);
        grid
    }

    #[test]
    fn everybody_near_is_found_once() {
        for (count, size) in [(10, 5.0), (500, 10.0), (3000, 100.0), (3000, 5.0)] {
            let grid = scattered(count, size);
            for place in grid.items().iter().step_by(37) {
                for radius in [0.0, 0.5, 3.0, 1e3, f64::INFINITY] {
                    let near = |item: &Item| item.centre.distance(place.centre) <= radius;
                    let mut expected: Vec<u32> = grid
                        .items()
                        .iter()
                        .filter(|i| near(i))
                        .map(|i| i.id)
                        .collect();
                    let mut found = Vec::new();
                    grid.around(place.centre, radius, |item| {
                        if near(item) {
                            found.push(item.id);
                        }
                    });
                    expected.sort_unstable();
                    found.sort_unstable();
                    assert_eq!(found, expected);
                }
            }
        }
    }

    #[test]
    fn floor_rounds_down() {
        assert_eq!(
            [
                floor(-1.5),
                floor(-1.0),
                floor(-0.5),
                floor(0.0),
                floor(1.9)
            ],
            [-2, -1, -1, 0, 1]
        );
    }
}
