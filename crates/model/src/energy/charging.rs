//! What a charger and the platform on it tell each other.

use simbeeotic_kernel::SimTime;
use simbeeotic_units::Current;

/// A charger tells a platform that it is connected: sent as a message
/// ([`Cx::tell`](crate::Cx::tell)), it never reaches the platform's behaviour. A platform with a battery
/// answers with [`Plugged`]; others do not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plug {
    /// The most that the charger gives. Above 0.
    pub current: Current,
    /// Until when it is connected, unless it says so again before.
    pub until: SimTime,
}

/// The answer to a [`Plug`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plugged {
    /// State of charge, 0 to 1.
    pub soc: f64,
    /// Whether it takes no more.
    pub full: bool,
}
