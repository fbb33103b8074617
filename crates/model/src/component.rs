//! Components: what watches a run without being part of it.
//!
//! A recorder, a viewer, a live plot: declared in the scenario (`[[component]] use = "recorder"`),
//! told of the run at its start, at regular virtual times and at its end. A component sees a
//! [`View`], read only, so it cannot change the trace.

use crate::summary::Summary;
use crate::view::View;
use simbeeotic_kernel::pace::Control;
use simbeeotic_kernel::{Progress, SimTime};
use simbeeotic_units::Time;
use std::sync::Arc;

/// Something that watches a run. Register it with `#[component("name")]`.
pub trait Component: Send {
    /// Virtual time between observations; `None`: only start and end.
    fn period(&self) -> Option<Time>;

    /// Whether it looks at what the sensor of this path (`bee-17/imu`) measures, as
    /// [`Mark::Sensed`](crate::Mark): nothing is noted for nobody, and what is noted for one component
    /// is seen by all. Asked before the first event, and when its [`interest`](Self::interest) changes.
    fn wants_reading(&self, _sensor: &str) -> bool {
        false
    }

    /// Whether it looks at the frames that the radio of this path (`bee-17/radio`) sends, as
    /// [`Mark::OnAir`](crate::Mark) and [`Mark::Heard`](crate::Mark): nothing is noted for nobody, and
    /// what is noted for one component is seen by all. Asked
    /// before the first event, and when its [`interest`](Self::interest) changes; `among` is the number
    /// of all radios of the run.
    fn wants_packets(&self, _radio: &str, _among: usize) -> bool {
        false
    }

    /// A number that changes whenever [`wants_reading`](Self::wants_reading) or
    /// [`wants_packets`](Self::wants_packets) would answer differently. Looked at after the start, each
    /// observation and each look at a [held](Self::held) run; the run then asks both anew. A frame whose
    /// sender was chosen while it was on the air may be [heard](crate::Mark::Heard) without having
    /// [begun](crate::Mark::OnAir), and the other way round.
    fn interest(&self) -> u64 {
        0
    }

    /// Called once, before [`start`](Self::start): the handles by which it may pace, pause and step the
    /// run, from any thread, and see how far it has come. Neither reaches the trace.
    fn attach(&mut self, _control: &Arc<Control>, _progress: &Arc<Progress>) {}

    /// Called while the run is held: at once when it comes to stand, after each step, and then some
    /// twenty times a second of wall time. What it sees is the last instant that has run, or where a
    /// step of simulated time ended; before the first event, the swarm as it was put there.
    ///
    /// # Errors
    /// The run ends.
    fn held(&mut self, _view: &View<'_>) -> Result<(), ComponentError> {
        Ok(())
    }

    /// When it wants to observe next, after an observation at `now`: a period later, unless it has a
    /// clock of its own. What is not after `now` is never.
    fn next_observation(&self, now: SimTime) -> Option<SimTime> {
        now.checked_add_nanos(SimTime::from_time(self.period()?).ok()?.nanos())
    }

    /// Called once, before the first event.
    ///
    /// # Errors
    /// The run does not start.
    fn start(&mut self, view: &View<'_>) -> Result<(), ComponentError>;

    /// Called at time zero and at each [`next_observation`](Self::next_observation), after all events of
    /// that instant.
    ///
    /// # Errors
    /// The run ends.
    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError>;

    /// Called once, after the last event; also when the run ends early or with an error, as far as
    /// the program lives. Returns lines for the printed summary.
    ///
    /// # Errors
    /// The run is reported as failed.
    fn finish(&mut self, view: &View<'_>, summary: &Summary) -> Result<Vec<Note>, ComponentError>;
}

/// A line that a component adds to the summary of a run.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Note {
    /// What it is about: `recording`.
    pub key: String,
    /// For people: `run.mcap, 12.3 MB, 101 ticks`.
    pub text: String,
}

/// A component cannot go on.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ComponentError(pub String);

impl ComponentError {
    /// With `message` as the whole of what the user sees.
    pub fn new(message: impl Into<String>) -> Self {
        Self(message.into())
    }
}
