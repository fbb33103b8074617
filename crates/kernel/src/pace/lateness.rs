//! How late a paced run was.

use std::time::Duration;

/// Late by less than this is in time: the operating system wakes a sleeper 50 us late.
const TOLERANCE: Duration = Duration::from_millis(1);

/// How late the instants of a paced run began.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Lateness {
    /// Instants that were paced.
    pub instants: u64,
    /// Those that began more than 1 ms late.
    pub late: u64,
    /// The latest of all.
    pub max: Duration,
    /// Instants by lateness: `[0]` below 1 us, `[i]` from 2^(i-1) up to 2^i us, the last one without end.
    pub histogram: [u64; 26],
}

impl Lateness {
    /// Counts an instant.
    pub(super) fn add(&mut self, late: Duration) {
        self.instants += 1;
        self.late += u64::from(late > TOLERANCE);
        self.max = self.max.max(late);
        let micros = u64::try_from(late.as_micros()).unwrap_or(u64::MAX);
        let class = (u64::BITS - micros.leading_zeros()) as usize;
        self.histogram[class.min(self.histogram.len() - 1)] += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_are_powers_of_two_microseconds() {
        let mut lateness = Lateness::default();
        for micros in [0, 1, 2, 3, 1000, 1001] {
            lateness.add(Duration::from_micros(micros));
        }
        lateness.add(Duration::MAX);
        assert_eq!(lateness.histogram[..4], [1, 1, 2, 0]);
        assert_eq!(lateness.histogram[10], 2);
        assert_eq!(lateness.histogram[25], 1);
        assert_eq!(
            (lateness.instants, lateness.late, lateness.max),
            (7, 2, Duration::MAX)
        );
    }
}
