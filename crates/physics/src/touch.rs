//! For the innermost loop of an engine: fetching memory early, and a segment as plain numbers.

use crate::body::BodyId;
use crate::motion::Motion;
use crate::physics::{Physics, duty};

/// So many neighbours of a body are fetched with it.
const NEIGHBOURS: u32 = 4;

impl Physics {
    /// Reads a word of each cache line that reading and changing this body, and predicting what it
    /// meets then, is going to need. Called for some bodies in a row, it has their memory fetched at
    /// once instead of one after the other. What it returns does not matter.
    ///
    /// # Panics
    /// If `id` is not one of [`add`](Self::add) of this world.
    #[inline]
    #[must_use]
    pub fn touch(&self, id: BodyId) -> u64 {
        let at = id.index();
        let mut word = u64::from(self.duties[at]) ^ self.reviews[at].nanos();
        let mut read = |motion: &Motion| word ^= motion.t0.nanos() ^ motion.a.x.to_bits();
        read(&self.motions[at]);
        let listed = self.duties[at] & duty::LISTED != 0 && self.tally.listings > 0;
        if listed && !self.grown {
            for place in self.lists.range(id.0).take(NEIGHBOURS as usize) {
                read(&self.motions[self.lists.neighbour(place) as usize]);
            }
        }
        word ^ self.motions[at].gravity.to_bits()
    }
}

impl Motion {
    /// All that changes from segment to segment but the start time, as numbers: two segments of one
    /// body that begin at one time are the same if these are.
    #[inline]
    #[must_use]
    pub fn numbers(&self) -> [f64; 20] {
        let (p, v, a, q, w) = (self.p, self.v, self.a, self.q, self.w);
        let [tx, ty, tz] = self.torque.map(f64::from);
        let support = f64::from(self.support as u8);
        [
            p.x, p.y, p.z, v.x, v.y, v.z, a.x, a.y, a.z, q.x, q.y, q.z, q.w, w.x, w.y, w.z, tx, ty,
            tz, support,
        ]
    }
}
