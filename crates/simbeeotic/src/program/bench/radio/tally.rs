//! What became of the broadcasts on one topology: the sum of several runs, and their mean.

use serde::Serialize;
use simbeeotic_radio::AccessStatistics;

/// The mean of some runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Tally {
    /// Independent runs; the four counts are their mean, rounded to a whole number.
    pub(super) runs: u64,
    /// Broadcasts asked for.
    pub(super) requests: u64,
    /// Given up because the channel stayed busy.
    pub(super) access_failures: u64,
    /// Put on the air.
    pub(super) transmitted: u64,
    /// Received, counted at each receiver.
    pub(super) delivered: u64,
    /// Delivered over transmitted times the number of the others, both summed over the runs; `None` if
    /// nothing was transmitted.
    pub(super) ratio: Option<f64>,
    /// From the request to the first bit on the air, over all that was transmitted, ms.
    pub(super) mean_access_delay_ms: Option<f64>,
}

/// The sum of some runs.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sum {
    runs: u64,
    requests: u64,
    transmitted: u64,
    delivered: u64,
    delay_s: f64,
}

impl Sum {
    /// Adds a run that has come to its end.
    pub(super) fn add(&mut self, access: &AccessStatistics, delivered: u64) {
        self.runs += 1;
        self.requests += access.requests;
        self.transmitted += access.transmitted;
        self.delivered += delivered;
        self.delay_s += access.delay.secs();
    }

    /// Broadcasts asked for in each run.
    pub(super) fn requests_each(&self) -> u64 {
        rounded(self.requests, self.runs)
    }

    /// The mean, of so many nodes.
    pub(super) fn mean(&self, nodes: usize) -> Tally {
        let over = |x: f64, y: f64| (y > 0.0).then(|| x / y);
        let all = self.transmitted as f64;
        let requests = self.requests_each();
        let transmitted = rounded(self.transmitted, self.runs);
        Tally {
            runs: self.runs,
            requests,
            // A request that came to its end was either put on the air or given up.
            access_failures: requests - transmitted,
            transmitted,
            delivered: rounded(self.delivered, self.runs),
            ratio: over(self.delivered as f64, all * (nodes as f64 - 1.0)),
            mean_access_delay_ms: over(self.delay_s * 1e3, all),
        }
    }
}

/// The nearest whole number to `sum / count`; 0 of none.
fn rounded(sum: u64, count: u64) -> u64 {
    (sum + count / 2).checked_div(count).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_units::Time;

    #[test]
    fn the_mean_has_rounded_counts_and_the_ratio_of_the_sums() {
        let mut sum = Sum::default();
        for (transmitted, delivered) in [(10, 20), (7, 8), (8, 9)] {
            let access = AccessStatistics {
                requests: 10,
                transmitted,
                failures: 10 - transmitted,
                delay: Time::from_millis(2.0 * transmitted as f64),
            };
            sum.add(&access, delivered);
        }
        let mean = sum.mean(4);
        assert_eq!((mean.runs, mean.requests), (3, 10));
        // 25 / 3 and 37 / 3.
        assert_eq!((mean.transmitted, mean.access_failures), (8, 2));
        assert_eq!(mean.delivered, 12);
        assert_eq!(mean.ratio, Some(37.0 / 75.0));
        let delay_ms = mean.mean_access_delay_ms.unwrap();
        assert!((delay_ms - 2.0).abs() < 1e-12, "{delay_ms}");
        assert_eq!(Sum::default().mean(2).ratio, None);
    }
}
