//! How often, and how much information.

use super::define::{linear_quantity, quantity};
use super::{Scale, Time};

linear_quantity! {
    /// A frequency or a rate of happening, inside in hertz. Not an
    /// [`AngularRate`](super::AngularRate): no 2π comes in.
    Frequency = "a frequency" {
        "Hz": Scale::ONE => from_hertz, hertz;
        "kHz": Scale::times(1e3) => from_kilohertz, kilohertz;
        "MHz": Scale::times(1e6) => from_megahertz, megahertz;
        "GHz": Scale::times(1e9) => from_gigahertz, gigahertz;
    }
}

linear_quantity! {
    /// An amount of information per time, inside in bits per second. Prefixes are decimal.
    DataRate = "a data rate" {
        "bit/s": Scale::ONE => from_bits_per_second, bits_per_second;
        "kbit/s": Scale::times(1e3) => from_kilobits_per_second, kilobits_per_second;
        "Mbit/s": Scale::times(1e6) => from_megabits_per_second, megabits_per_second;
        "Gbit/s": Scale::times(1e9);
    }
}

impl Frequency {
    /// The time from one to the next.
    pub const fn period(self) -> Time {
        Time::si(1.0 / self.get())
    }
}

impl DataRate {
    /// The time that a number of whole bytes takes: `8 bytes / rate`.
    pub const fn airtime(self, bytes: usize) -> Time {
        Time::si(bytes as f64 * 8.0 / self.get())
    }
}
