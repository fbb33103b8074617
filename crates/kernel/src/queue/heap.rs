//! The reference: a binary heap.

use super::PendingEvents;
use crate::{Event, SimTime};
use std::{cmp::Reverse, collections::BinaryHeap};

/// A binary heap of events: nothing to get wrong, `log n` for each event.
#[derive(Clone, Debug, Default)]
pub struct Heap(BinaryHeap<Reverse<Event>>);

impl PendingEvents for Heap {
    fn push(&mut self, event: Event) {
        self.0.push(Reverse(event));
    }

    fn next_time(&mut self) -> Option<SimTime> {
        self.0.peek().map(|event| event.0.time)
    }

    fn pop_instant(&mut self, batch: &mut Vec<Event>) -> Option<SimTime> {
        let time = self.next_time()?;
        while self.next_time() == Some(time) {
            batch.extend(self.0.pop().map(|event| event.0));
        }
        Some(time)
    }

    fn len(&self) -> usize {
        self.0.len()
    }
}
