//! The last look at a frame: who of a block of receivers it came through to.

use super::table::Table;
use crate::fast::exp2;
use crate::ieee802154::Quirks;
use crate::scratch::ROW;
use simbeeotic_kernel::rng::draw_u32;

/// Working memory for a block of rows: columns of those that were taking in the frame that ends.
pub(super) struct Room {
    /// Their rows, counted from the block's first.
    pub(super) mine: [u16; ROW],
    pub(super) own: [f32; ROW],
    pub(super) noise: [f32; ROW],
    pub(super) salts: [u32; ROW],
    pub(super) others: [f32; ROW],
    /// What they are worth as noise.
    pub(super) harms: [f32; ROW],
    /// The length of their last interval.
    pub(super) ns: [f32; ROW],
    pub(super) steps: [u32; ROW],
    pub(super) rests: [f32; ROW],
    /// At first that of what is over of the frame, then of all.
    pub(super) ln_success: [f32; ROW],
    /// Luck over chance: below 0 for those that the frame came through to.
    pub(super) over: [f32; ROW],
    pub(super) lucky: [u16; ROW],
    pub(super) lost: [u16; ROW],
}

impl Default for Room {
    fn default() -> Self {
        Self {
            mine: [0; ROW],
            own: [0.0; ROW],
            noise: [0.0; ROW],
            salts: [0; ROW],
            others: [0.0; ROW],
            harms: [0.0; ROW],
            ns: [0.0; ROW],
            steps: [0; ROW],
            rests: [0.0; ROW],
            ln_success: [0.0; ROW],
            over: [0.0; ROW],
            lucky: [0; ROW],
            lost: [0; ROW],
        }
    }
}

impl Room {
    /// Lists the rows that are taking in frame `id`: how many.
    #[inline(always)]
    pub(super) fn list(&mut self, locks: &[u32], id: u32) -> usize {
        let mut count = 0;
        for (j, &lock) in (0u16..).zip(locks) {
            // Written every time, kept only where it holds: no branch to be mispredicted.
            self.mine[count % ROW] = j;
            count += usize::from(lock == id);
        }
        count
    }

    /// Chance and luck of the first `m`.
    #[inline(always)]
    pub(super) fn reckon(&mut self, table: &Table, quirks: Quirks, key: u64, m: usize) {
        let m = m.min(ROW);
        let (own, noise, harms) = (&self.own[..m], &self.noise[..m], &self.harms[..m]);
        let (steps, rests) = (&mut self.steps[..m], &mut self.rests[..m]);
        for k in 0..m {
            (steps[k], rests[k]) = table.place(own[k] / (noise[k] + harms[k]));
        }
        let (ln_success, ns) = (&mut self.ln_success[..m], &self.ns[..m]);
        for k in 0..m {
            ln_success[k] += table.bits(ns[k], quirks) * table.between(steps[k], rests[k]);
        }
        let (over, salts) = (&mut self.over[..m], &self.salts[..m]);
        for k in 0..m {
            over[k] = luck_24(key, salts[k]);
        }
        for k in 0..m {
            over[k] -= chance(ln_success[k]);
        }
    }

    /// Sorts the first `m` into lucky and lost: how many of each.
    #[inline(always)]
    pub(super) fn sort(&mut self, m: usize) -> (usize, usize) {
        let (mut lucky, mut lost) = (0, 0);
        for (k, &over) in (0u16..).zip(&self.over[..m]) {
            self.lucky[lucky % ROW] = k;
            self.lost[lost % ROW] = k;
            lucky += usize::from(over < 0.0);
            lost += usize::from(over >= 0.0);
        }
        (lucky, lost)
    }
}

/// The luck of a frame at a receiver, to 24 bits: 0 or more, less than 1.
#[inline(always)]
pub(super) fn luck_24(key: u64, salt: u32) -> f32 {
    (draw_u32(key, salt) >> 8) as i32 as f32 * (1.0 / 16_777_216.0)
}

/// The chance with this logarithm; exactly 1 for 0, and 0 far below.
#[inline(always)]
pub(super) fn chance(ln_success: f32) -> f32 {
    let chance = exp2(ln_success * std::f32::consts::LOG2_E);
    if ln_success > -30.0 { chance } else { 0.0 }
}
