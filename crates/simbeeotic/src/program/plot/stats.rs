//! Numbers of many numbers: bins over distance, intervals of shares, quantiles.

use simbeeotic_record::Links;

/// The 97.5 % quantile of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// Wilson's 95 % interval of a chance that came true `hits` times of `trials`. With no trials it is all
/// from 0 to 1.
///
/// E. B. Wilson, *Probable inference, the law of succession, and statistical inference*, JASA 22 (1927).
pub(super) fn wilson(hits: u64, trials: u64) -> [f64; 2] {
    match trials {
        0 => [0.0, 1.0],
        _ => wilson_of_share(hits as f64 / trials as f64, trials as f64),
    }
}

/// The same interval of a share that was found in `n` trials, more than none; of trials that came true in part,
/// their mean.
pub(super) fn wilson_of_share(share: f64, n: f64) -> [f64; 2] {
    let middle = share + Z * Z / (2.0 * n);
    let half = Z * (share * (1.0 - share) / n + Z * Z / (4.0 * n * n)).sqrt();
    let whole = 1.0 + Z * Z / n;
    // At the ends the exact value is 0 or 1; rounding may miss it.
    let low = if share <= 0.0 {
        0.0
    } else {
        (middle - half) / whole
    };
    let high = if share >= 1.0 {
        1.0
    } else {
        (middle + half) / whole
    };
    [low, high]
}

/// The frames of all links in one range of distances.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Bin {
    /// Frames that could have been received.
    pub(super) sent: u64,
    /// Those that were.
    pub(super) received: u64,
    /// Mean RSSI of each link and period, dBm, with the frames that it is the mean of.
    pub(super) rssi_dbm: Vec<(f32, u32)>,
}

/// Frames by distance; bin `k` is from `k` to `k + 1` times `width_m`, its lower end included.
#[derive(Clone, Debug, Default)]
pub(super) struct Bins {
    pub(super) width_m: f64,
    pub(super) bins: Vec<Bin>,
    /// There are no more than so many bins.
    most: usize,
    /// Frames of links that are longer than all bins.
    pub(super) beyond: u64,
}

/// More bins than this are a slip of the keyboard.
pub(super) const BINS_MAX: usize = 1000;

impl Bins {
    /// No bins yet, and as many as it takes to reach a distance, at most [`BINS_MAX`].
    pub(super) fn new(width_m: f64, reach_m: f64) -> Self {
        let most = (reach_m / width_m).floor() as usize + 1;
        Self {
            width_m,
            bins: Vec::new(),
            most: most.min(BINS_MAX),
            beyond: 0,
        }
    }

    /// Adds the links of a period.
    pub(super) fn add(&mut self, links: &Links) {
        for link in &links.links {
            let place = (f64::from(link.distance_m) / self.width_m).floor();
            if !(0.0..self.most as f64).contains(&place) {
                self.beyond += u64::from(link.sent);
                continue;
            }
            let place = place as usize;
            if place >= self.bins.len() {
                self.bins.resize(place + 1, Bin::default());
            }
            let bin = &mut self.bins[place];
            bin.sent += u64::from(link.sent);
            bin.received += u64::from(link.received);
            if link.received > 0 && link.rssi_dbm.is_finite() {
                bin.rssi_dbm.push((link.rssi_dbm, link.received));
            }
        }
    }

    /// The middle of a bin, m.
    pub(super) fn middle_m(&self, place: usize) -> f64 {
        (place as f64 + 0.5) * self.width_m
    }

    /// The end of the last bin, m.
    pub(super) fn end_m(&self) -> f64 {
        self.bins.len() as f64 * self.width_m
    }
}

/// The value that a share of the weight lies below or at; the values must be sorted. `None` of nothing.
pub(super) fn quantile(sorted: &[(f32, u32)], share: f64) -> Option<f64> {
    let weight: u64 = sorted.iter().map(|(_, weight)| u64::from(*weight)).sum();
    let wanted = share * weight as f64;
    let mut below = 0_u64;
    for (value, weight) in sorted {
        below += u64::from(*weight);
        if below as f64 >= wanted {
            return Some(f64::from(*value));
        }
    }
    sorted.last().map(|(value, _)| f64::from(*value))
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::Link;

    #[test]
    fn wilsons_interval_solves_its_equation() {
        // Both ends p are where the distance of the share from p is Z standard deviations of p.
        for (hits, trials) in [(3, 10), (50, 100), (999, 1000), (1, 7)] {
            let share = hits as f64 / trials as f64;
            for end in wilson(hits, trials) {
                let deviation = (end * (1.0 - end) / trials as f64).sqrt();
                let distance = (share - end).abs() / deviation;
                assert!((distance - Z).abs() < 1e-9, "{hits} of {trials}: {end}");
            }
        }
    }

    #[test]
    fn wilsons_interval_has_its_known_values() {
        // With no hits of n it is 0 to Z^2 / (n + Z^2), and the other way round.
        let upper = Z * Z / (20.0 + Z * Z);
        assert_eq!(wilson(0, 20)[0], 0.0);
        assert!((wilson(0, 20)[1] - upper).abs() < 1e-15);
        assert_eq!(wilson(20, 20)[1], 1.0);
        assert!((wilson(20, 20)[0] - (1.0 - upper)).abs() < 1e-15);
        assert_eq!(wilson(0, 0), [0.0, 1.0]);
    }

    fn link(distance_m: f32, sent: u32, received: u32, rssi_dbm: f32) -> Link {
        Link {
            from: 0,
            to: 1,
            sent,
            received,
            rssi_dbm,
            distance_m,
        }
    }

    #[test]
    fn bins_hold_the_frames_of_their_distances() {
        let mut bins = Bins::new(2.0, 7.9);
        bins.add(&Links {
            links: vec![
                link(0.0, 10, 10, -40.0),
                link(1.99, 5, 4, -45.0),
                link(2.0, 8, 2, -50.0),
                link(7.5, 3, 0, f32::NAN),
                link(1e9, 9, 9, -1.0),
            ],
            ..Links::default()
        });
        let sums: Vec<_> = bins.bins.iter().map(|b| (b.sent, b.received)).collect();
        assert_eq!(sums, [(15, 14), (8, 2), (0, 0), (3, 0)]);
        assert_eq!(bins.bins[0].rssi_dbm, [(-40.0, 10), (-45.0, 4)]);
        assert!(bins.bins[3].rssi_dbm.is_empty());
        assert_eq!((bins.middle_m(1), bins.end_m()), (3.0, 8.0));
        assert_eq!(bins.beyond, 9);
    }

    #[test]
    fn quantiles_count_frames_and_not_links() {
        let values = [(-60.0, 1), (-50.0, 8), (-40.0, 1)];
        assert_eq!(quantile(&values, 0.05), Some(-60.0));
        assert_eq!(quantile(&values, 0.5), Some(-50.0));
        assert_eq!(quantile(&values, 0.95), Some(-40.0));
        assert_eq!(quantile(&[], 0.5), None);
    }
}
