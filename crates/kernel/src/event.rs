//! Who is woken, when, and why: the event and its total order.

use crate::SimTime;
use std::fmt;

/// A model's place in the engine: its index among the agents.
///
/// Ids are dense and start at 0. They say nothing about identity over time: two runs with different
/// populations number the same path differently. What must not change then (random streams, trace
/// words) hangs on the key of the path, see `rng::path_key`.
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
/// Tags from [`Wake::TIMER`] up belong to `Timers`; a domain that uses them takes
/// its own tags from below.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Wake {
    /// What kind of wake-up this is.
    pub tag: u32,
    /// One word that goes with it: an index, a count.
    pub arg: u32,
}

impl Wake {
    /// The bit of `tag` that marks the wake-ups of `Timers`.
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
