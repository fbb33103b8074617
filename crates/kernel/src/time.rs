//! Points of simulated time.
//!
//! Time is counted, never measured: an unsigned number of nanoseconds since the start of the run.
//! No sum of float steps can drift, two instants are equal or they are not, and 2^64 ns are 584
//! years. Spans come from files and models as `units::Time` (float seconds) and are rounded to
//! whole nanoseconds at this border, once.

use simbeeotic_units::Time;
use std::{
    fmt,
    ops::{Add, AddAssign, Sub},
};

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

    /// The instant this long after the start, rounded to the nearest nanosecond.
    ///
    /// # Errors
    ///
    /// A time that is negative, not a number, or beyond [`SimTime::MAX`].
    pub fn from_time(time: Time) -> Result<Self, TimeError> {
        // Seconds beyond 2^53 ns have no nanoseconds to round to; scaling them is exact enough.
        let nanos = (time.get() * 1e9).round();
        // 2^64 itself is a float, 2^64 - 1 is not.
        if (0.0..18_446_744_073_709_551_616.0).contains(&nanos) {
            Ok(Self(nanos as u64))
        } else {
            Err(TimeError(time))
        }
    }

    /// This long since the start, as a span. Exact up to 2^53 ns (104 days).
    #[must_use]
    pub fn time(self) -> Time {
        Time::si(self.as_secs_f64())
    }

    /// The instant this long after this one, the span rounded to the nearest nanosecond.
    ///
    /// # Errors
    ///
    /// A span that is negative or not a number, or an instant beyond [`SimTime::MAX`].
    pub fn after(self, span: Time) -> Result<Self, TimeError> {
        let nanos = Self::from_time(span)?.0;
        self.checked_add_nanos(nanos).ok_or(TimeError(span))
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
        self.0 as f64 / 1e9
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

/// A span that leads to no instant: negative, not a number, or past the end of time.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("a time of {0} leads to no instant of the run")]
pub struct TimeError(pub Time);

impl TryFrom<Time> for SimTime {
    type Error = TimeError;

    fn try_from(time: Time) -> Result<Self, TimeError> {
        Self::from_time(time)
    }
}

/// Later by a span, rounded to the nearest nanosecond. A negative span goes back; the result is held
/// between [`SimTime::ZERO`] and [`SimTime::MAX`], and a span that is no number changes nothing. Use
/// [`SimTime::after`] where that would be a mistake to report.
impl Add<Time> for SimTime {
    type Output = Self;

    fn add(self, span: Time) -> Self {
        // The cast holds at the ends of u64 and takes NaN to 0.
        let nanos = (span.get().abs() * 1e9).round() as u64;
        if span.get() < 0.0 {
            Self(self.0.saturating_sub(nanos))
        } else {
            Self(self.0.saturating_add(nanos))
        }
    }
}

impl AddAssign<Time> for SimTime {
    fn add_assign(&mut self, span: Time) {
        *self = *self + span;
    }
}

/// The span from one instant to another, negative if the first is the earlier one. The difference is
/// taken in nanoseconds and rounded once.
impl Sub for SimTime {
    type Output = Time;

    fn sub(self, earlier: Self) -> Time {
        let nanos = i128::from(self.0) - i128::from(earlier.0);
        Time::si(nanos as f64 / 1e9)
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
    fn spans_round_to_the_nanosecond_once() {
        let at = SimTime::from_time("100 ms".parse().unwrap()).unwrap();
        assert_eq!(at, SimTime::from_millis(100));
        assert_eq!(
            SimTime::from_time(Time::si(1.4e-9)),
            Ok(SimTime::from_nanos(1))
        );
        assert_eq!(
            SimTime::from_secs(2) + Time::from_millis(-500.0),
            SimTime::from_millis(1500)
        );
        assert_eq!(
            SimTime::from_millis(1500) - SimTime::from_secs(2),
            Time::si(-0.5)
        );
        assert_eq!(
            SimTime::from_secs(1).after(Time::from_millis(1.0)),
            Ok(SimTime::from_millis(1001))
        );
        assert_eq!(SimTime::from_millis(12_345).time(), Time::si(12.345));
    }

    #[test]
    fn a_span_that_leads_nowhere_is_an_error() {
        for wrong in [-1e-9, f64::NAN, f64::INFINITY, 18_446_744_074.0] {
            assert!(SimTime::from_time(Time::si(wrong)).is_err(), "{wrong}");
        }
        assert!(SimTime::MAX.after(Time::si(1e-9)).is_err());
        assert_eq!(
            SimTime::from_time(Time::si(-2.0)).unwrap_err().to_string(),
            "a time of -2 s leads to no instant of the run"
        );
        assert_eq!(SimTime::ZERO + Time::si(-1.0), SimTime::ZERO);
        assert_eq!(SimTime::MAX + Time::si(1.0), SimTime::MAX);
        assert_eq!(
            SimTime::from_secs(1) + Time::si(f64::NAN),
            SimTime::from_secs(1)
        );
    }

    #[test]
    fn far_times_stop_at_the_end_of_time() {
        assert_eq!(SimTime::from_secs(u64::MAX), SimTime::MAX);
        assert_eq!(SimTime::MAX.checked_add_nanos(1), None);
        assert_eq!(SimTime::MAX.saturating_add_nanos(1), SimTime::MAX);
        assert_eq!(SimTime::ZERO.nanos_since(SimTime::MAX), 0);
    }
}
