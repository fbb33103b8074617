//! Where the time goes: counts and wall time of a run.

use crate::rng::mix;
use std::time::Instant;

/// Rounds with at least this many visits are timed one by one.
const BIG: usize = 16;
/// Of the smaller ones, one in this many: reading the clock six times costs more than the
/// round itself.
const ONE_IN: u64 = 64;

/// What a run has done so far, and where its wall time went.
///
/// Never part of results: wall times differ from run to run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stats {
    /// Events given to agents.
    pub events: u64,
    /// Times an agent was run, each with any number of events.
    pub visits: u64,
    /// Points of time at which something happened.
    pub instants: u64,
    /// Rounds, at least one an instant.
    pub rounds: u64,
    /// Events that their receiver no longer wanted.
    pub voided: u64,
    /// Wall time by kind of work.
    pub wall: WallTimes,
}

/// Wall time by kind of work, in seconds.
///
/// Rounds of 16 visits or more are timed all; of the smaller ones one in 64, counted 64-fold: these
/// are estimates, good to some percent after a hundred thousand rounds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WallTimes {
    /// Finding, taking out and putting in events.
    pub queue_s: f64,
    /// The shared state on its way to the instant: moving bodies, resolving contacts, ending frames.
    pub open_s: f64,
    /// Running agents.
    pub run_s: f64,
    /// Committing effects.
    pub commit_s: f64,
    /// Closing rounds: predicting contacts, starting frames.
    pub close_s: f64,
}

impl WallTimes {
    /// All of it.
    #[must_use]
    pub fn total_s(&self) -> f64 {
        self.queue_s + self.open_s + self.run_s + self.commit_s + self.close_s
    }
}

/// A stop watch over one round. Runs only in the rounds that are timed.
#[derive(Debug)]
pub(crate) struct Watch {
    at: Option<Instant>,
    weight: f64,
}

#[expect(
    clippy::disallowed_methods,
    reason = "the wall clock is the subject here, and stays out of results"
)]
fn now() -> Instant {
    Instant::now()
}

impl Watch {
    /// Begins a round. `big`: whether the last one was big, so that this one is likely to be.
    #[inline]
    pub(crate) fn start(round: u64, big: bool) -> Self {
        // The rounds to be timed are drawn, not every sixty-fourth: models have periods too.
        let drawn = mix(round).is_multiple_of(ONE_IN);
        if drawn || big {
            Self {
                at: Some(now()),
                weight: if drawn { ONE_IN as f64 } else { 0.0 },
            }
        } else {
            Self {
                at: None,
                weight: 0.0,
            }
        }
    }

    /// The number of events (or visits) in the round is known: big ones count once, others only if drawn.
    #[inline]
    pub(crate) fn size(&mut self, events: usize) {
        if events >= BIG {
            self.at.get_or_insert_with(now);
            self.weight = 1.0;
        } else if self.weight == 0.0 {
            self.at = None;
        }
    }

    /// Adds the time since the last call to `seconds`.
    #[inline]
    pub(crate) fn lap(&mut self, seconds: &mut f64) {
        if let Some(at) = self.at {
            let now = now();
            *seconds += (now - at).as_secs_f64() * self.weight;
            self.at = Some(now);
        }
    }
}

/// Whether a round with so many events is timed in full.
pub(crate) fn is_big(events: usize) -> bool {
    events >= BIG
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_small_round_in_sixty_four_is_timed() {
        let timed = (0..160_000)
            .filter(|&round| Watch::start(round, false).at.is_some())
            .count();
        assert!((2_300..2_700).contains(&timed), "{timed} of 160,000");
    }

    #[test]
    fn a_small_round_taken_for_a_big_one_does_not_count() {
        let round = (0..)
            .find(|&r| Watch::start(r, false).at.is_none())
            .unwrap();
        let mut watch = Watch::start(round, true);
        watch.size(1);
        let mut seconds = 0.0;
        watch.lap(&mut seconds);
        assert_eq!(seconds, 0.0);
    }
}
