//! What a bee makes of the packets it heard: where it seems to be in the gradient field.

use super::packet::{Mark, Value};
use simbeeotic::prelude::*;
use simbeeotic::units::math;

/// One packet.
#[derive(Clone, Copy, Debug)]
struct Whiff {
    at: SimTime,
    beacon: ModelId,
    value: Value,
    rssi_dbm: f64,
}

/// The packets of the last second or so.
#[derive(Debug)]
pub struct Nose {
    window: Time,
    sharpness: f64,
    /// In the order in which they came.
    whiffs: Vec<Whiff>,
}

/// Where a bee seems to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smell {
    /// How far along its path.
    pub along_m: f64,
    /// How far from it.
    pub across_m: f64,
    /// What the loudest beacon marks.
    pub loudest: Mark,
    /// How loud that is.
    pub rssi_dbm: f64,
    /// How many beacons are heard.
    pub beacons: usize,
}

impl Nose {
    /// A nose that remembers packets for `window`, and weighs a beacon by its mean received power to the
    /// power of `sharpness`.
    pub fn new(window: Time, sharpness: f64) -> Self {
        Self {
            window,
            sharpness,
            whiffs: Vec::new(),
        }
    }

    /// Takes in a packet.
    pub fn hear(&mut self, at: SimTime, beacon: ModelId, value: Value, rssi: PowerLevel) {
        let rssi_dbm = rssi.dbm();
        self.whiffs.push(Whiff {
            at,
            beacon,
            value,
            rssi_dbm,
        });
    }

    /// What it smells of now; `None` if nothing was heard in the last `window`.
    ///
    /// ```text
    /// R_i = mean of the RSSI of beacon i, dBm      w_i = 10^(sharpness R_i / 10)
    /// along = sum of w_i along_i / sum of w_i      across likewise                    (1)
    /// ```
    pub fn smell(&mut self, now: SimTime) -> Option<Smell> {
        let window = self.window;
        self.whiffs.retain(|whiff| now - whiff.at <= window);
        // A stable order, whoever's packet came first.
        let mut sorted = self.whiffs.clone();
        sorted.sort_by_key(|whiff| (whiff.beacon, whiff.at));
        let heard: Vec<(Value, f64)> = sorted
            .chunk_by(|a, b| a.beacon == b.beacon)
            .map(|of_one| {
                let sum: f64 = of_one.iter().map(|whiff| whiff.rssi_dbm).sum();
                (of_one[0].value, sum / of_one.len() as f64)
            })
            .collect();
        let loudest = heard.iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let (mut weight, mut along_m, mut across_m) = (0.0, 0.0, 0.0);
        for (value, rssi_dbm) in &heard {
            // Only ratios count: relative to the loudest, no weight is too small to be a number.
            let w = math::pow(10.0, self.sharpness * (rssi_dbm - loudest.1) / 10.0);
            weight += w;
            along_m += w * value.along.metres();
            across_m += w * value.across.metres();
        }
        Some(Smell {
            along_m: along_m / weight,
            across_m: across_m / weight,
            loudest: loudest.0.mark,
            rssi_dbm: loudest.1,
            beacons: heard.len(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Time = Time::si(1.0);

    /// A nose that heard these beacons: when, which, how far along and across, how loud.
    fn nose(sharpness: f64, heard: &[(f64, u32, f64, f64, f64)]) -> Nose {
        let mut nose = Nose::new(SECOND, sharpness);
        for &(at_s, beacon, along_m, across_m, rssi_dbm) in heard {
            let value = Value {
                mark: if beacon == 0 { Mark::Hive } else { Mark::Field },
                along: Length::si(along_m),
                across: Length::si(across_m),
            };
            let at = SimTime::from_time(Time::si(at_s)).expect("a time");
            nose.hear(at, ModelId(beacon), value, PowerLevel::from_dbm(rssi_dbm));
        }
        nose
    }

    fn smell(mut nose: Nose, at_s: f64) -> Option<Smell> {
        nose.smell(SimTime::from_time(Time::si(at_s)).expect("a time"))
    }

    #[test]
    fn a_beacon_ten_times_as_strong_counts_ten_times() {
        let heard = [(0.0, 1, 11.0, 0.0, -70.0), (0.1, 2, 0.0, 22.0, -60.0)];
        let by_power = smell(nose(1.0, &heard), 0.5).expect("two");
        assert!((by_power.along_m - 1.0).abs() < 1e-9, "{by_power:?}");
        assert!((by_power.across_m - 20.0).abs() < 1e-9, "{by_power:?}");
        assert_eq!((by_power.beacons, by_power.loudest), (2, Mark::Field));
        let alike = smell(nose(0.0, &heard), 0.5).expect("two");
        assert_eq!((alike.along_m, alike.across_m), (5.5, 11.0));
    }

    #[test]
    fn a_beacon_that_is_heard_often_counts_once_by_its_mean() {
        let often = [
            (0.0, 1, 8.0, 0.0, -70.0),
            (0.1, 0, 0.0, 4.0, -65.0),
            (0.2, 1, 8.0, 0.0, -66.0),
            (0.3, 0, 0.0, 4.0, -71.0),
        ];
        let smell = smell(nose(1.0, &often), 0.5).expect("two");
        assert_eq!((smell.along_m, smell.across_m), (4.0, 2.0));
        assert_eq!((smell.beacons, smell.rssi_dbm), (2, -68.0));
    }

    #[test]
    fn what_is_older_than_the_window_is_forgotten() {
        let heard = [(0.0, 0, 0.0, 0.0, -50.0), (0.8, 1, 9.0, 1.0, -80.0)];
        let now = |at_s| smell(nose(1.0, &heard), at_s);
        assert_eq!(now(0.9).expect("both").loudest, Mark::Hive);
        let later = now(1.5).expect("one");
        assert_eq!((later.along_m, later.loudest), (9.0, Mark::Field));
        assert_eq!(now(2.0), None);
    }
}
