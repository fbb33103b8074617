//! Two rays by crossover: free space near by, the fourth power of the distance far away.

use super::{HEIGHT_MIN, Link, Links, Propagation, held_gain, reference_m};
use crate::fast::sin_cos_turns;
use simbeeotic_units::{Decibels, Frequency, Length};
use std::f64::consts::PI;

/// Two rays by crossover: near by one law, beyond the crossover distance `dc = 4 pi h1 h2 / lambda` the
/// other.
///
/// ```text
/// d <= dc    gain = (lambda / 4 pi d)^2                                 form ns-3
///            gain = (lambda / 4 pi d)^2  4 sin^2(2 pi h1 h2 / lambda d) form original
/// d > dc     gain = (h1 h2)^2 / d^4
/// ```
/// The heights are those above `up = 0`, at least [`HEIGHT_MIN`]; the distance is the one in space. The loss
/// is 0 to [`LOSS_DB_MAX`](super::LOSS_DB_MAX).
///
/// This is the two-ray model of packet simulators, made for masts far apart. For vehicles that fly as high as
/// they are apart it is wrong: take [`TwoRayExact`](super::TwoRayExact).
///
/// Sources: ns-3 3.37, `TwoRayGroundPropagationLossModel` (ns-2's form); the original's
/// `TwoRayPropagationModel`, whose wavelength was ten times too short, which this one's is not. At the
/// crossover the form `Ns3` does not jump, the form `Original` by 0.37 dB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoRay {
    /// The law near by.
    pub form: TwoRayForm,
    /// Up to this distance nothing is lost. 0 or more; 0.5 m in ns-3, where the loss jumps there by 34 dB.
    pub minimum_distance: Length,
    /// How high an antenna at `up = 0` is above the ground.
    pub height: Length,
}

/// What [`TwoRay`] does up to the crossover.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TwoRayForm {
    /// Free space: ns-2's and ns-3's.
    #[default]
    Ns3,
    /// Free space with the interference of a perfect reflection: the original's.
    Original,
}

impl Default for TwoRay {
    fn default() -> Self {
        Self {
            form: TwoRayForm::Ns3,
            minimum_distance: Length::ZERO,
            height: Length::ZERO,
        }
    }
}

/// The numbers of one frequency.
#[derive(Clone, Copy)]
struct Law {
    form: TwoRayForm,
    /// `(lambda / 4 pi)²`.
    near_m2: f64,
    /// `lambda`.
    wave_m: f64,
    least_m2: f64,
}

impl Law {
    /// `product_m2` is that of the heights.
    #[inline(always)]
    fn gain(self, square_m2: f64, product_m2: f64) -> f64 {
        let crossover_m = 4.0 * PI * product_m2 / self.wave_m;
        let near = self.near_m2 / square_m2
            * match self.form {
                TwoRayForm::Ns3 => 1.0,
                TwoRayForm::Original => {
                    let turns = product_m2 / (self.wave_m * square_m2.sqrt());
                    let (sin, _) = sin_cos_turns(turns);
                    4.0 * sin * sin
                }
            };
        let far = product_m2 * product_m2 / (square_m2 * square_m2);
        let gain = if square_m2 <= crossover_m * crossover_m {
            near
        } else {
            far
        };
        let held = held_gain(gain);
        // Not above: at no distance at all nothing is lost, either.
        if square_m2 > self.least_m2 { held } else { 1.0 }
    }
}

impl TwoRay {
    fn law(&self, frequency: Frequency) -> Law {
        let near_m = reference_m(frequency);
        let least_m = self.minimum_distance.metres().max(0.0);
        Law {
            form: self.form,
            near_m2: near_m * near_m,
            wave_m: near_m * 4.0 * PI,
            least_m2: least_m * least_m,
        }
    }

    #[inline(always)]
    fn height_m(&self, up_m: f64) -> f64 {
        (up_m + self.height.metres()).max(HEIGHT_MIN.metres())
    }
}

impl Propagation for TwoRay {
    fn loss(&self, link: &Link) -> Decibels {
        let height = |end: &super::End| self.height_m(end.position.up().metres());
        let product_m2 = height(&link.tx) * height(&link.rx);
        let law = self.law(link.frequency);
        -Decibels::from_ratio(law.gain(link.distance_m * link.distance_m, product_m2))
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        let law = self.law(links.frequency);
        let near_m = self.height_m(links.near_enu_m[2].into());
        for (j, gain) in gains.iter_mut().enumerate() {
            let product_m2 = near_m * self.height_m(links.far_enu_m[2][j].into());
            *gain = law.gain(links.square_m2(j), product_m2) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagation::FreeSpace;
    use crate::propagation::testing::{along, assert_rows_agree, link};

    const ORIGINAL: TwoRay = TwoRay {
        form: TwoRayForm::Original,
        minimum_distance: Length::ZERO,
        height: Length::ZERO,
    };

    /// `original.md` has what the original computed with a wavelength ten times too short; these are the
    /// same formulas with the right one.
    #[test]
    fn the_originals_form_has_its_shape_and_the_right_wavelength() {
        let lambda = 299_792_458.0 / 2.405e9;
        for d in [1.0, 3.0, 10.0, 30.0, 99.0] {
            let free = FreeSpace.loss(&link(d, 1.0, 1.0)).db();
            let (sin, _) = simbeeotic_units::math::sin_cos(2.0 * PI / (lambda * d));
            let want = free - Decibels::from_ratio(4.0 * sin * sin).db();
            let loss = ORIGINAL.loss(&link(d, 1.0, 1.0)).db();
            assert!((loss - want).abs() < 1e-5, "{d} m: {loss}, not {want}");
        }
        for d in [101.0, 1000.0] {
            let want = 40.0 * simbeeotic_units::math::log10(d);
            assert!((ORIGINAL.loss(&link(d, 1.0, 1.0)).db() - want).abs() < 1e-9);
        }
    }

    #[test]
    fn the_jump_at_the_crossover_is_none_or_that_of_the_original() {
        let crossover = 4.0 * PI * 2.0 * 3.0 / (299_792_458.0 / 2.405e9);
        let jump = |model: TwoRay| {
            let loss = |d| model.loss(&link(d, 2.0, 3.0)).db();
            loss(crossover * (1.0 - 1e-9)) - loss(crossover * (1.0 + 1e-9))
        };
        assert!(jump(TwoRay::default()).abs() < 1e-6);
        assert!((jump(ORIGINAL).abs() - 0.37).abs() < 0.01);
    }

    #[test]
    fn nulls_ground_and_no_distance_give_numbers() {
        for model in [TwoRay::default(), ORIGINAL] {
            for heights in [(0.0, 0.0), (-3.0, 1.0), (0.0, 5.0), (1.0, 1.0)] {
                for d in [0.0, 1e-9, 0.005, 1.0, 1e5] {
                    let loss = model.loss(&link(d, heights.0, heights.1)).db();
                    assert!(
                        (0.0..=300.0).contains(&loss),
                        "{heights:?}, {d} m: {loss} dB"
                    );
                }
            }
        }
        // A null of the original's form: h1 h2 = lambda d.
        let lambda = 299_792_458.0 / 2.405e9;
        let null = ORIGINAL.loss(&link(1.0 / lambda, 1.0, 1.0)).db();
        assert!((100.0..=300.0).contains(&null), "{null} dB");
    }

    #[test]
    fn rows_of_links_agree_with_single_ones() {
        for model in [TwoRay::default(), ORIGINAL] {
            let high = TwoRay {
                height: Length::from_metres(0.3),
                minimum_distance: Length::from_metres(0.5),
                ..model
            };
            assert_rows_agree(&model, &along(600, 3.0), 1e-3);
            assert_rows_agree(&high, &along(600, 3.0), 1e-3);
        }
    }
}
