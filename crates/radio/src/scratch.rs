//! Working memory of one thread.

use crate::inbox::Hit;
use std::fmt;

/// How many pairs are worked on at a time: a row fits into the first-level cache.
pub(crate) const ROW: usize = 256;

/// Working memory for [`Medium::collect`](crate::Medium::collect), and the place where the packets of
/// an inbox lie. One for each thread, or one for each agent; make it once, use it again and again.
pub struct Scratch {
    pub(crate) row: Box<Row>,
    pub(crate) hits: Vec<Hit>,
}

/// Columns of one row of pairs.
pub(crate) struct Row {
    /// Squares of distances, m²; NaN for a radio and its own frame, which nothing is in range of.
    pub(crate) squares_m2: [f32; ROW],
    /// Gain of the space between the antennas, linear.
    pub(crate) gains: [f32; ROW],
    /// Received power, milliwatts; 0 out of range.
    pub(crate) powers_mw: [f32; ROW],
    /// Place of the power in a table of success.
    pub(crate) slots: [u32; ROW],
    /// The luck of the pair; the worst there is if the power is below the sensitivity.
    pub(crate) draws: [u32; ROW],
    /// What was received.
    pub(crate) picked: [Hit; ROW],
}

impl Scratch {
    /// Empty working memory.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }
}

impl Default for Scratch {
    fn default() -> Self {
        let row = Row {
            squares_m2: [0.0; ROW],
            gains: [0.0; ROW],
            powers_mw: [0.0; ROW],
            slots: [0; ROW],
            draws: [0; ROW],
            picked: [Hit::default(); ROW],
        };
        Self {
            row: Box::new(row),
            hits: Vec::new(),
        }
    }
}

impl fmt::Debug for Scratch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Scratch with {} packets", self.hits.len())
    }
}
