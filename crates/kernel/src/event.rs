//! Who is woken, when, and why: the event and its total order.

use crate::SimTime;
use std::{cmp::Ordering, fmt};

/// A model's place in the engine: its index among the agents.
///
/// Ids are dense and start at 0. They say nothing about identity over time: two runs with different
/// populations number the same path differently. What must not change then (random streams, trace
/// words) hangs on the key of the path, see [`path_key`](crate::rng::path_key).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct ModelId(pub u32);

impl ModelId {
    /// This id as an index into the slice of agents.
    #[must_use]
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

impl fmt::Display for ModelId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// Why a model is woken: two words that mean something to the receiver and nothing to the kernel.
///
/// Tags from [`Wake::TIMER`] up belong to [`Timers`](crate::Timers); a domain that uses them takes
/// its own tags from below.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Wake {
    /// What kind of wake-up this is.
    pub tag: u32,
    /// One word that goes with it: an index, a count.
    pub arg: u32,
}

impl Wake {
    /// The bit of `tag` that marks the wake-ups of [`Timers`](crate::Timers).
    pub const TIMER: u32 = 1 << 31;

    /// A wake-up with these two words.
    #[must_use]
    pub const fn new(tag: u32, arg: u32) -> Self {
        Self { tag, arg }
    }
}

/// One pending wake-up, 32 bytes.
///
/// `Ord` is the total order of a run: time, then receiver, then sender, then the sender's own
/// counter. A sender never uses a number twice, so no two events are equal, and the order can be
/// computed on any thread without asking a global counter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Event {
    /// When it is due.
    pub time: SimTime,
    /// Who is woken.
    pub receiver: ModelId,
    /// Who asked for it.
    pub sender: ModelId,
    /// How many events the sender had scheduled before this one.
    pub seq: u64,
    /// Why.
    pub wake: Wake,
}

const _: () = assert!(size_of::<Event>() == 32);

impl Event {
    /// The first three words of the order as one number: time, receiver, sender.
    #[inline]
    const fn rank(&self) -> u128 {
        (self.time.nanos() as u128) << 64 | (self.receiver.0 as u128) << 32 | self.sender.0 as u128
    }
}

impl Ord for Event {
    #[inline]
    fn cmp(&self, other: &Self) -> Ordering {
        // Comparing `wake` keeps `Ord` and `Eq` of one mind; events of a run never get that far.
        self.rank()
            .cmp(&other.rank())
            .then_with(|| self.seq.cmp(&other.seq))
            .then_with(|| self.wake.cmp(&other.wake))
    }
}

impl PartialOrd for Event {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_comes_first_then_receiver_then_sender_then_number() {
        let event = |time, receiver, sender, seq| Event {
            time: SimTime::from_nanos(time),
            receiver: ModelId(receiver),
            sender: ModelId(sender),
            seq,
            wake: Wake::default(),
        };
        let sorted = [
            event(0, 9, 9, 9),
            event(1, 0, 9, 9),
            event(1, 1, 0, 9),
            event(1, 1, 1, 0),
            event(1, 1, 1, 1),
            event(u64::MAX, 0, 0, 0),
        ];
        assert!(sorted.is_sorted_by(|a, b| a < b));
    }
}
