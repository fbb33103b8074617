//! Points of simulated time.
//!
//! Time is counted, never measured: an unsigned number of nanoseconds since the start of the run.
//! No sum of float steps can drift, two instants are equal or they are not, and 2^64 ns are 584
//! years. Spans come from files and models as `units::Time` (float seconds) and are rounded to
//! whole nanoseconds at this border, once.

use std::fmt;

/// Nanoseconds in one second.
pub(crate) const NANOS_PER_SEC: u64 = 1_000_000_000;

/// A point of simulated time: whole nanoseconds since the start of the run.
///
/// Range 0 to [`SimTime::MAX`] (584 years); shown in seconds, exactly: `12.345 s`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct SimTime(u64);

impl SimTime {
    /// The start of the run.
    pub const ZERO: Self = Self(0);
    /// The last instant that can be named, 584 years after the start. Stands for "never" in limits.
    pub const MAX: Self = Self(u64::MAX);

    /// The instant `nanos` nanoseconds after the start.
    #[must_use]
    pub const fn from_nanos(nanos: u64) -> Self {
        Self(nanos)
    }

    /// The instant `millis` milliseconds after the start; held at [`SimTime::MAX`] beyond it.
    #[must_use]
    pub const fn from_millis(millis: u64) -> Self {
        Self(millis.saturating_mul(1_000_000))
    }

    /// The instant `secs` seconds after the start; held at [`SimTime::MAX`] beyond it.
    #[must_use]
    pub const fn from_secs(secs: u64) -> Self {
        Self(secs.saturating_mul(NANOS_PER_SEC))
    }

    /// Nanoseconds since the start.
    #[must_use]
    pub const fn nanos(self) -> u64 {
        self.0
    }

    /// Whole seconds since the start, rounded down: the second this instant belongs to.
    #[must_use]
    pub const fn whole_secs(self) -> u64 {
        self.0 / NANOS_PER_SEC
    }

    /// Seconds since the start. Exact up to 2^53 ns (104 days), then rounded to the nearest `f64`.
    #[must_use]
    pub const fn as_secs_f64(self) -> f64 {
        self.0 as f64 * 1e-9
    }

    /// The instant `nanos` later, or `None` beyond [`SimTime::MAX`].
    #[must_use]
    pub const fn checked_add_nanos(self, nanos: u64) -> Option<Self> {
        match self.0.checked_add(nanos) {
            Some(nanos) => Some(Self(nanos)),
            None => None,
        }
    }

    /// The instant `nanos` later, held at [`SimTime::MAX`].
    #[must_use]
    pub const fn saturating_add_nanos(self, nanos: u64) -> Self {
        Self(self.0.saturating_add(nanos))
    }

    /// Nanoseconds from `earlier` to this instant; 0 if `earlier` is not earlier.
    #[must_use]
    pub const fn nanos_since(self, earlier: Self) -> u64 {
        self.0.saturating_sub(earlier.0)
    }
}

/// Exact seconds without trailing zeros: `0 s`, `12.345 s`, `0.000000001 s`.
impl fmt::Display for SimTime {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (whole, rest) = (self.0 / NANOS_PER_SEC, self.0 % NANOS_PER_SEC);
        if rest == 0 {
            return write!(f, "{whole} s");
        }
        let digits = format!("{rest:09}");
        write!(f, "{whole}.{} s", digits.trim_end_matches('0'))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shows_exact_seconds() {
        assert_eq!(SimTime::ZERO.to_string(), "0 s");
        assert_eq!(SimTime::from_millis(12_345).to_string(), "12.345 s");
        assert_eq!(SimTime::from_nanos(1).to_string(), "0.000000001 s");
        assert_eq!(SimTime::MAX.to_string(), "18446744073.709551615 s");
    }

    #[test]
    fn far_times_stop_at_the_end_of_time() {
        assert_eq!(SimTime::from_secs(u64::MAX), SimTime::MAX);
        assert_eq!(SimTime::MAX.checked_add_nanos(1), None);
        assert_eq!(SimTime::MAX.saturating_add_nanos(1), SimTime::MAX);
        assert_eq!(SimTime::ZERO.nanos_since(SimTime::MAX), 0);
    }
}
