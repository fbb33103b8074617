//! When something periodic first happens.

use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::Time;
use simbeeotic_model::{choice, random_phase};

/// When something periodic first happens.
#[choice]
pub enum Phase {
    /// At the start of the run: all vehicles at once.
    Aligned,
    /// At a random time of the first period, each vehicle its own. What one vehicle does with periods
    /// that are multiples of each other, it does at the same instants.
    Random,
}

impl Phase {
    /// What the stream for [`Phase::first`] is for: `kit.stream(Phase::PURPOSE)`.
    pub const PURPOSE: &str = "phase";

    /// The first time of something that happens every `period`. `rng` is a model's stream for
    /// [`Phase::PURPOSE`], newly made.
    ///
    /// All loops of one model count from one random instant, as those of an autopilot with one clock
    /// do: the first draw, in nanoseconds, modulo the period. A loop of 1 s then runs together with
    /// every tenth step of a loop of 100 ms, which is one wake-up less to fetch a bee's memory for.
    pub fn first(self, period: Time, rng: Stream) -> Time {
        let period = SimTime::from_time(period).map_or(0, SimTime::nanos);
        match self {
            Self::Aligned => Time::ZERO,
            Self::Random => Time::from_nanos(random_phase(period, rng) as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_loops_of_one_model_run_together_and_those_of_two_do_not() {
        let first = |path: &str, period_s: f64| {
            let rng = Stream::new(1, path, Phase::PURPOSE);
            let first = Phase::Random.first(Time::from_secs(period_s), rng);
            SimTime::from_time(first).expect("a time of the first period")
        };
        let (slow, fast) = (first("bee-1", 1.0), first("bee-1", 0.1));
        assert!(slow < SimTime::from_secs(1) && fast < SimTime::from_millis(100));
        assert_eq!(slow.nanos_since(fast) % 100_000_000, 0);
        assert_ne!(first("bee-2", 0.1), fast);
    }
}
