//! When something periodic first happens.

use simbeeotic_model::choice;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::Time;

/// When something periodic first happens.
#[choice]
pub enum Phase {
    /// At the start of the run: all vehicles at once.
    Aligned,
    /// At a random time of the first period, each vehicle its own.
    Random,
}

impl Phase {
    /// The first time of something that happens every `period`.
    pub fn first(self, period: Time, rng: &mut Stream) -> Time {
        match self {
            Self::Aligned => Time::ZERO,
            Self::Random => period * rng.uniform(),
        }
    }
}
