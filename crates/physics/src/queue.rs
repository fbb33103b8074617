//! What is going to happen, in order of time.

use crate::motion::Motion;
use simbeeotic_kernel::SimTime;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Stands for the ground where a body's index is expected; sorts after all bodies.
pub(crate) const GROUND: u32 = u32::MAX;

/// The kinds of things that happen. At one instant they happen in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Kind {
    /// A body may leave the ball that its neighbour list assumes.
    Leave,
    /// A body's segment begins anew: it has stopped sliding, or tumbles.
    Review,
    /// An island takes a step.
    Step,
    /// Two bodies, or a body and the ground, meet.
    Meet,
    /// Two that only detect each other part again.
    Part,
}

/// One thing that is going to happen, unless a body's stamp changes before.
///
/// `Ord` is the order of events; no two that matter are equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Due {
    pub(crate) time: SimTime,
    pub(crate) kind: Kind,
    pub(crate) a: u32,
    pub(crate) b: u32,
    pub(crate) stamps: [u32; 2],
}

impl Due {
    /// Whether both bodies still follow the segments that this was computed from.
    fn holds(&self, motions: &[Motion]) -> bool {
        let same = |i: u32, stamp: u32| i == GROUND || motions[i as usize].stamp == stamp;
        matches!(self.kind, Kind::Review | Kind::Step)
            || same(self.a, self.stamps[0]) && same(self.b, self.stamps[1])
    }
}

/// A binary heap of what is due. Voided entries leave it when they come to its top.
#[derive(Debug, Default)]
pub(crate) struct Queue {
    heap: BinaryHeap<Reverse<Due>>,
}

impl Queue {
    #[inline]
    pub(crate) fn push(&mut self, due: Due) {
        self.heap.push(Reverse(due));
    }

    /// The next thing that still holds.
    pub(crate) fn peek(&mut self, motions: &[Motion]) -> Option<Due> {
        while let Some(Reverse(due)) = self.heap.peek() {
            if due.holds(motions) {
                return Some(*due);
            }
            self.heap.pop();
        }
        None
    }

    pub(crate) fn pop(&mut self) {
        self.heap.pop();
    }

    /// Forgets everything but reviews and steps, which nobody computes again.
    pub(crate) fn forget_predictions(&mut self) {
        let stays = |kind: Kind| matches!(kind, Kind::Review | Kind::Step);
        self.heap.retain(|Reverse(due)| stays(due.kind));
    }
}
