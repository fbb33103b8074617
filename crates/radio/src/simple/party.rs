//! Receivers by place, and the frames that those in one cube may hear, for rounds in which many send.

use super::band::{Air, Members};
use super::near;
use crate::grid::{Grid, widths_m};

/// Edge of a cube of receivers over the range. Wider, more receivers share what is gathered, and each looks
/// at more frames in vain.
const CELL: f64 = 1.0;

/// The receivers of a band in a grid, and the frames near those of one cube.
#[derive(Debug, Default)]
pub(super) struct Party {
    pub(super) grid: Grid,
    /// Edge of its cubes, and a little for rounding, m.
    pub(super) width_m: f32,
    pub(super) near: NearFrames,
}

/// The frames that some receivers may hear: those columns of the band's that pairs are worked with, in the
/// order in which they were submitted.
#[derive(Debug, Default)]
pub(super) struct NearFrames {
    /// Without the frames themselves; `order` says which they are.
    pub(super) air: Air,
    /// Which frame, and its place in the band's columns, in one word to be sorted by.
    picked: Vec<u64>,
    /// Whether it matters which members the senders are: for directions and for walls.
    pub(super) senders_matter: bool,
}

impl Party {
    /// Sorts the members by place.
    pub(super) fn gather_receivers(&mut self, members: &Members, range_m: f64) {
        let widths = widths_m(&members.places);
        let edge_m = (CELL * range_m).max(near::CELL_M_MIN);
        self.width_m = (1.01 * edge_m) as f32;
        self.grid.build(&members.places, widths, edge_m);
    }
}

impl NearFrames {
    /// Gathers the frames, sorted into a grid, that the first members of `rows` may hear: as many of them as
    /// lie in a box no wider than `width_m`. Returns how many these are.
    pub(super) fn gather_frames(
        &mut self,
        air: &Air,
        members: &Members,
        rows: &[u32],
        width_m: f32,
    ) -> usize {
        let [mut low, mut high] = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
        let mut first = 0;
        for row in rows.iter().map(|&row| row as usize) {
            let place = [0, 1, 2].map(|axis| members.places[axis][row]);
            let lower = [0, 1, 2].map(|axis| low[axis].min(place[axis]));
            let upper = [0, 1, 2].map(|axis| high[axis].max(place[axis]));
            // Distant cubes may share a bucket of the grid.
            if first > 0 && (0..3).any(|axis| upper[axis] - lower[axis] > width_m) {
                break;
            }
            if members.awake[row] {
                (low, high) = (lower, upper);
            }
            first += 1;
        }
        self.air.clear();
        // Not so if all are asleep, or nowhere.
        if (0..3).all(|axis| low[axis] <= high[axis]) {
            self.gather_around(air, [low, high]);
        }
        first
    }

    fn gather_around(&mut self, air: &Air, [low, high]: [[f32; 3]; 2]) {
        let picked = &mut self.picked;
        picked.clear();
        let [x, y, z] = &air.enu_m;
        let reach_squared = (air.reach_m * air.reach_m) as f32;
        air.grid.around_box([low, high], air.reach_m, |run| {
            let (x, y, z) = (&x[run.clone()], &y[run.clone()], &z[run.clone()]);
            let order = &air.order[run.clone()];
            for (j, at) in run.enumerate() {
                let p = [x[j], y[j], z[j]];
                let square: f32 = (0..3)
                    .map(|axis| {
                        let gap = (low[axis] - p[axis]).max(p[axis] - high[axis]).max(0.0);
                        gap * gap
                    })
                    .sum();
                if square <= reach_squared {
                    picked.push(u64::from(order[j]) << 32 | at as u64);
                }
            }
        });
        picked.sort_unstable();

        let near = &mut self.air;
        near.alike = air.alike;
        near.addressed = air.addressed;
        near.order
            .extend(picked.iter().map(|word| (word >> 32) as u32));
        let of = |word: &u64| *word as u32 as usize;
        for (column, all) in near.enu_m.iter_mut().zip(&air.enu_m) {
            column.clear();
            column.extend(picked.iter().map(|word| all[of(word)]));
        }
        near.eirp_mw
            .extend(picked.iter().map(|word| air.eirp_mw[of(word)]));
        near.keys
            .extend(picked.iter().map(|word| air.keys[of(word)]));
        near.keys_low
            .extend(near.keys.iter().map(|key| *key as u32));
        near.keys_high
            .extend(near.keys.iter().map(|key| (key >> 32) as u32));
        near.radios
            .extend(picked.iter().map(|word| air.radios[of(word)]));
        near.radio_keys
            .extend(picked.iter().map(|word| air.radio_keys[of(word)]));
        if self.senders_matter {
            near.rows
                .extend(picked.iter().map(|word| air.rows[of(word)]));
        }
        // The first stands for all that are alike.
        let lengths = if air.alike { 1 } else { picked.len() };
        let lengths = picked.iter().take(lengths);
        near.lengths
            .extend(lengths.map(|word| air.lengths[of(word)]));
    }
}
