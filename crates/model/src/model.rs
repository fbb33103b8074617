//! The lowest layer: a thing that is woken by events.

use crate::host::Cx;
use crate::message::{Message, Touch};
use crate::timer::TimerHandle;
use simbeeotic_radio::Inbox;

/// A thing that is woken by events. Few implement it directly: a [`Behavior`](crate::Behavior) on
/// a [`Host`](crate::host::Host) becomes one.
pub trait Model: Send {
    /// Called once, at time zero, before any other event.
    fn start(&mut self, cx: &mut Cx<'_>);

    /// Called for each event addressed to this model.
    fn wake(&mut self, wake: Wake<'_>, cx: &mut Cx<'_>);

    /// Reads a few words of the model's own memory, so that it is at hand when the model runs. A hint:
    /// what it returns does not matter.
    fn touch(&self) -> u64 {
        0
    }

    /// Called once, after the last event of the run.
    fn finish(&mut self, _cx: &mut Cx<'_>) {}
}

/// Why a model is woken.
#[derive(Debug)]
#[non_exhaustive]
pub enum Wake<'a> {
    /// One of its own timers fired.
    Timer(TimerHandle),
    /// Another model (or itself, earlier) sent a message.
    Message(&'a Message),
    /// Its radios heard packets.
    Packets(Inbox<'a>),
    /// Its body touched something.
    Touch(&'a Touch),
}
