//! Free space: nothing but distance.

use super::{Link, Links, Propagation, reference_m};
use simbeeotic_units::{Decibels, Frequency};

/// Free space: nothing but distance. `loss = 20 log10(4 pi d / lambda)`, never below 0 dB.
///
/// Friis' formula is one of the far field; below `lambda / 4 pi` (1 cm at 2.4 GHz) it would turn into
/// a gain, so the loss stays at 0 dB there: continuous, monotone, and what ns-3 does.
///
/// Source: Friis 1946, Proc. IRE 34(5), eq. 1. Golden: 10 m at 2405 MHz is 60.07 dB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FreeSpace;

impl FreeSpace {
    /// The loss at a distance, metres.
    pub(super) fn loss_at(distance_m: f64, frequency: Frequency) -> Decibels {
        let ratio = distance_m / reference_m(frequency);
        Decibels::from_ratio((ratio * ratio).max(1.0))
    }
}

impl Propagation for FreeSpace {
    fn loss(&self, link: &Link) -> Decibels {
        Self::loss_at(link.distance_m, link.frequency)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        let reference_m = reference_m(links.frequency);
        let reference_m2 = (reference_m * reference_m) as f32;
        for (gain, &squared) in gains.iter_mut().zip(links.distances_squared_m2) {
            let held = if squared > reference_m2 {
                squared
            } else {
                reference_m2
            };
            *gain = reference_m2 / held;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagation::{End, FrameKeys, Role};
    use glam::DVec3;
    use simbeeotic_kernel::SimTime;
    use simbeeotic_units::Position;

    fn link(distance_m: f64) -> Link {
        let end = |east_m| End {
            position: Position::from_si(DVec3::new(east_m, 0.0, 0.0)),
            key: 1,
        };
        Link {
            tx: end(0.0),
            rx: end(distance_m),
            distance_m,
            frequency: Frequency::si(2.405e9),
            frame: 0,
            time: SimTime::ZERO,
        }
    }

    fn loss_db(distance_m: f64) -> f64 {
        FreeSpace.loss(&link(distance_m)).get()
    }

    #[test]
    fn free_space_agrees_with_ns3() {
        // ns-3 3.37, FriisPropagationLossModel at 2405 MHz, 0 dBm sent.
        let table = [
            (0.01, 0.070_084_836),
            (0.1, 20.070_084_836),
            (1.0, 40.070_084_836),
            (10.0, 60.070_084_836),
            (12.5, 62.008_285_096),
            (30.0, 69.612_509_930),
        ];
        for (distance_m, expected_db) in table {
            assert!(
                (loss_db(distance_m) - expected_db).abs() < 1e-6,
                "{distance_m} m"
            );
        }
    }

    #[test]
    fn near_field_never_amplifies() {
        // The original's loss below 1 cm was (d + 1)², a gain.
        let losses: Vec<f64> = (0..2000).map(|i| loss_db(f64::from(i) * 1e-5)).collect();
        assert!(losses.iter().all(|&loss| loss >= 0.0));
        assert!(losses.is_sorted(), "more distance, more loss");
        assert_eq!(losses[0], 0.0);
    }

    #[test]
    fn rows_of_links_agree_with_single_ones() {
        let east: Vec<f32> = (0..500).map(|i| 0.003 * (i * i) as f32).collect();
        let zero = vec![0.0; east.len()];
        let keys = vec![7; east.len()];
        let squares: Vec<f32> = east.iter().map(|x| x * x).collect();
        let links = Links {
            frequency: Frequency::si(2.48e9),
            time: SimTime::ZERO,
            near_is: Role::Receiver,
            near_enu_m: [0.0; 3],
            near_key: 1,
            far_enu_m: [&east, &zero, &zero],
            far_keys: &keys,
            distances_squared_m2: &squares,
            frames: FrameKeys::One(3),
        };
        let mut gains = vec![0.0; links.len()];
        FreeSpace.gains(&links, &mut gains);
        for (j, &gain) in gains.iter().enumerate() {
            let exact = FreeSpace.loss(&links.link(j)).get();
            let fast = -Decibels::from_ratio(f64::from(gain)).get();
            assert!(
                (exact - fast).abs() < 1e-4,
                "{} m: {exact} and {fast} dB",
                east[j]
            );
        }
        assert_eq!(links.link(3).rx.key, 1, "the near end listens");
    }
}
