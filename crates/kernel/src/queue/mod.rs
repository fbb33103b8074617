//! Pending event sets: where events wait for their time.
//!
//! Both sets here give the same events in the same order, the order of [`Event`]; a run cannot tell
//! them apart. [`Wheel`] is the fast one, [`Heap`] the plain one it is tested against.
//!
//! Nothing is ever taken out of the middle. A model that no longer wants a wake-up lets it come and
//! ignores it (see [`Timers`](crate::Timers), which does this by generation): cancelling costs one
//! increment, where the original searched its whole queue.

mod heap;
mod wheel;

pub use heap::Heap;
pub use wheel::Wheel;

use crate::{Event, SimTime};

/// A set of events that gives back the earliest instant, whole and in order.
pub trait PendingEvents: Send {
    /// Adds an event.
    ///
    /// It may be due at the instant popped last, which then comes up again; the engine never adds one
    /// due before that.
    fn push(&mut self, event: Event);

    /// When the earliest event is due; `None` if there is none. Takes nothing out.
    fn next_time(&mut self) -> Option<SimTime>;

    /// Appends all events of the earliest instant to `batch`, in order, and returns that instant.
    fn pop_instant(&mut self, batch: &mut Vec<Event>) -> Option<SimTime>;

    /// Some of the events that come next, if they are at hand: a hint for fetching memory early.
    fn upcoming(&self) -> &[Event] {
        &[]
    }

    /// How many events wait.
    fn len(&self) -> usize;

    /// Whether no event waits.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Which pending event set an engine uses. Never shows in results.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum QueueKind {
    /// The timing wheel: about 25 ns for a pop and a push, whatever the number of events.
    #[default]
    Wheel,
    /// The binary heap: the reference.
    Heap,
}

/// The engine's set: a choice made once, without a virtual call at each event.
#[derive(Debug)]
pub(crate) enum Queue {
    Wheel(Box<Wheel>),
    Heap(Heap),
}

impl Queue {
    pub(crate) fn new(kind: QueueKind) -> Self {
        match kind {
            QueueKind::Wheel => Self::Wheel(Box::default()),
            QueueKind::Heap => Self::Heap(Heap::default()),
        }
    }
}

impl PendingEvents for Queue {
    #[inline]
    fn push(&mut self, event: Event) {
        match self {
            Self::Wheel(wheel) => wheel.push(event),
            Self::Heap(heap) => heap.push(event),
        }
    }

    #[inline]
    fn next_time(&mut self) -> Option<SimTime> {
        match self {
            Self::Wheel(wheel) => wheel.next_time(),
            Self::Heap(heap) => heap.next_time(),
        }
    }

    #[inline]
    fn pop_instant(&mut self, batch: &mut Vec<Event>) -> Option<SimTime> {
        match self {
            Self::Wheel(wheel) => wheel.pop_instant(batch),
            Self::Heap(heap) => heap.pop_instant(batch),
        }
    }

    #[inline]
    fn upcoming(&self) -> &[Event] {
        match self {
            Self::Wheel(wheel) => wheel.upcoming(),
            Self::Heap(heap) => heap.upcoming(),
        }
    }

    #[inline]
    fn len(&self) -> usize {
        match self {
            Self::Wheel(wheel) => wheel.len(),
            Self::Heap(heap) => heap.len(),
        }
    }
}
