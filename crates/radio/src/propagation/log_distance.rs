//! Log-distance: a power law with an exponent from measurements.

use super::{Link, Links, Propagation, least_loss};
use crate::fast;
use simbeeotic_units::{Decibels, Frequency, Length};

/// A power law: `loss = L0 + 10 n log10(d / d0)`, and `L0` below `d0`. Never below 0 dB.
///
/// The exponent sums up what a place does: 2 in free space, 1.6 to 1.8 along corridors, 2.7 to 3.5 in
/// towns, 3 to 5 in the open near the ground and through buildings. It is a fit, and means little
/// without shadowing.
///
/// Source: Rappaport, Wireless Communications, 2nd ed., eq. 4.68 and table 4.2 (from memory). Golden: 100 m
/// with the defaults at 2405 MHz is 100.07 dB. ns-3's default reference, 46.6777 dB, is free space at
/// 5.15 GHz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LogDistance {
    /// Path loss exponent `n`. 0 or more.
    pub exponent: f64,
    /// Reference distance `d0`. Above 0.
    pub reference_distance: Length,
    /// Loss at the reference distance, `L0`; `None`: that of free space at the frequency of the channel.
    pub reference_loss: Option<Decibels>,
}

impl Default for LogDistance {
    fn default() -> Self {
        Self {
            exponent: 3.0,
            reference_distance: Length::from_metres(1.0),
            reference_loss: None,
        }
    }
}

impl LogDistance {
    /// What ns-3 takes unless told otherwise: exponent 3, and 46.6777 dB at 1 m, which is free space at
    /// 5.15 GHz. For comparisons.
    #[must_use]
    pub fn ns3() -> Self {
        Self {
            reference_loss: Some(Decibels::from_db(46.6777)),
            ..Self::default()
        }
    }

    fn reference_loss(&self, frequency: Frequency) -> Decibels {
        self.reference_loss.unwrap_or_else(|| {
            super::free_space::FreeSpace::loss_at(self.reference_distance.metres(), frequency)
        })
    }
}

impl Propagation for LogDistance {
    fn loss(&self, link: &Link) -> Decibels {
        let ratio = (link.distance_m / self.reference_distance.metres()).max(1.0);
        let more = Decibels::from_ratio(ratio) * self.exponent;
        least_loss(self.reference_loss(link.frequency) + more)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        let reference_m = self.reference_distance.metres();
        let law = Law {
            reference_m2: (reference_m * reference_m) as f32,
            gain: (-self.reference_loss(links.frequency)).ratio() as f32,
        };
        let squares = links.distances_squared_m2;
        // A function for each exponent: the loop is chosen once, not the power for each link.
        let quarters = self.exponent * 2.0;
        match quarters {
            4.0 => law.fill(squares, gains, |x| x),
            5.0 => law.fill(squares, gains, |x| x * x.sqrt().sqrt()),
            6.0 => law.fill(squares, gains, |x| x * x.sqrt()),
            7.0 => law.fill(squares, gains, |x| {
                let root = x.sqrt();
                x * root * root.sqrt()
            }),
            8.0 => law.fill(squares, gains, |x| x * x),
            _ => {
                let half = (0.5 * self.exponent) as f32;
                law.fill(squares, gains, |x| fast::exp2(half * fast::log2(x)));
            }
        }
    }
}

/// The power law of one frequency, in squares.
struct Law {
    reference_m2: f32,
    gain: f32,
}

impl Law {
    /// `power` gives `x^(n/2)`.
    #[inline(always)]
    fn fill(&self, squares_m2: &[f32], gains: &mut [f32], power: impl Fn(f32) -> f32) {
        let per_m2 = 1.0 / self.reference_m2;
        for (gain, &square) in gains.iter_mut().zip(squares_m2) {
            let ratio = square * per_m2;
            let held = if ratio > 1.0 { ratio } else { 1.0 };
            let value = self.gain / power(held);
            *gain = if value < 1.0 { value } else { 1.0 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagation::testing::{along, assert_rows_agree, link};
    use simbeeotic_units::math;

    #[test]
    fn losses_are_those_of_the_formula() {
        let model = LogDistance::default();
        let loss = |d: f64| model.loss(&link(d, 1.0, 1.0)).db();
        assert!((loss(1.0) - 40.0701).abs() < 1e-4);
        assert!((loss(100.0) - 100.0701).abs() < 1e-4);
        assert!((loss(20.0) - loss(10.0) - 30.0 * math::log10(2.0)).abs() < 1e-9);
        assert_eq!(loss(0.0), loss(1.0), "below the reference it stays");
        let indoors = LogDistance {
            reference_loss: Some(Decibels::from_db(55.0)),
            reference_distance: Length::from_metres(8.0),
            exponent: 4.2,
        };
        let far = indoors.loss(&link(80.0, 1.0, 1.0)).db();
        assert!((far - 97.0).abs() < 1e-9);
    }

    #[test]
    fn it_never_amplifies() {
        let model = LogDistance {
            reference_loss: Some(Decibels::from_db(-20.0)),
            ..LogDistance::default()
        };
        assert_eq!(model.loss(&link(1.0, 1.0, 1.0)), Decibels::ZERO);
        assert_rows_agree(&model, &along(200, 2.0), 1e-3);
    }

    #[test]
    fn rows_of_links_agree_with_single_ones_for_any_exponent() {
        for exponent in [0.0, 1.7, 2.0, 2.5, 2.72, 3.0, 3.3, 3.5, 4.0, 5.5] {
            let model = LogDistance {
                exponent,
                ..LogDistance::default()
            };
            assert_rows_agree(&model, &along(600, 3.0), 1e-3);
        }
    }
}
