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
