//! Two rays as they are: the direct one and the one by the ground, added with their phases.

use super::{End, HEIGHT_MIN, Link, Links, Propagation, held_gain, reference_m};
use crate::fast::sin_cos_turns;
use simbeeotic_units::constants::SPEED_OF_LIGHT;
use simbeeotic_units::{Decibels, Frequency, Length, math};

/// Two rays as they are: the direct one and the one that a flat ground reflects, added with their phases.
///
/// With the antennas `h1` and `h2` above the ground and `r` apart on the map:
///
/// ```text
/// d1 = sqrt(r^2 + (h1 - h2)^2)     d2 = sqrt(r^2 + (h1 + h2)^2)      k = 2 pi / lambda
/// gain = (lambda / 4 pi)^2 | exp(-j k d1) / d1 + G exp(-j k d2) / d2 |^2           (1)
/// G = (s sin t - q) / (s sin t + q)     q = sqrt(e - cos^2 t)                       (2)
/// sin t = (h1 + h2) / d2     s = 1 horizontal, e vertical     e = e' - j 60 sigma lambda
/// ```
/// Near by, the rays come to beat: nulls and gains of up to 6 dB that move by wavelengths. At
/// `r >> h1 h2 / lambda` the loss is that of the fourth power. Both rays are taken to have the gain of the
/// direct one's direction. Heights are those above `up = 0`, at least [`HEIGHT_MIN`]: obstacles and terrain
/// do not count. The surface wave is not modelled, which at 2.4 GHz matters below some centimetres. The loss
/// is 0 to [`LOSS_DB_MAX`](super::LOSS_DB_MAX).
///
/// Source: Rappaport, Wireless Communications, 2nd ed., sections 4.5 and 4.6 (from memory).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoRayExact {
    /// How the waves are polarised.
    pub polarisation: Polarisation,
    /// What the ground is.
    pub ground: Ground,
    /// How high an antenna at `up = 0` is above the ground.
    pub height: Length,
}

/// Which way the electric field swings.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Polarisation {
    /// In the plane of the two rays: upright antennas.
    #[default]
    Vertical,
    /// Along the ground, across the rays.
    Horizontal,
}

/// What a ground is to a wave: with the frequency `f` in GHz, relative permittivity `a f^b` and conductivity
/// `c f^d` S/m.
///
/// The dry and wet grounds and concrete are rows of ITU-R P.2040 (table 3; for 1 to 10 GHz, concrete to
/// 100 GHz), from memory. The waters are fitted from 1 to 5 GHz to Debye's formula with the constants of water
/// at 20 °C (static permittivity 80 and 70, relaxation in 9.4 ps, sea water with 5 S/m); ITU-R P.527 has curves
/// of both. No document was at hand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Relative permittivity at 1 GHz. 1 or more.
    pub a: f64,
    /// Exponent of the permittivity.
    pub b: f64,
    /// Conductivity at 1 GHz, S/m. Not negative.
    pub c: f64,
    /// Exponent of the conductivity.
    pub d: f64,
}

impl Ground {
    /// Very dry ground: sand, rock.
    pub const VERY_DRY: Self = Self::new(3.0, 0.0, 0.000_15, 2.52);
    /// Medium dry ground: a field.
    pub const MEDIUM_DRY: Self = Self::new(15.0, -0.1, 0.035, 1.63);
    /// Wet ground.
    pub const WET: Self = Self::new(30.0, -0.4, 0.15, 1.3);
    /// A floor or yard of concrete.
    pub const CONCRETE: Self = Self::new(5.24, 0.0, 0.0462, 0.7822);
    /// A lake.
    pub const FRESH_WATER: Self = Self::new(80.0, -0.02, 0.25, 1.95);
    /// The sea.
    pub const SEA_WATER: Self = Self::new(70.0, -0.02, 5.0, 0.22);
    /// What mirrors all: the limit of high conductivity.
    pub const PERFECT: Self = Self::new(1.0, 0.0, 1e9, 0.0);

    const fn new(a: f64, b: f64, c: f64, d: f64) -> Self {
        Self { a, b, c, d }
    }

    /// The same at every frequency. Permittivity 1 or more, conductivity 0 S/m or more.
    #[must_use]
    pub const fn constant(permittivity: f64, conductivity_s_m: f64) -> Self {
        Self::new(permittivity, 0.0, conductivity_s_m, 0.0)
    }

    /// Relative permittivity at a frequency.
    #[must_use]
    pub fn permittivity(self, frequency: Frequency) -> f64 {
        self.a * math::pow(frequency.get() * 1e-9, self.b)
    }

    /// Conductivity at a frequency, S/m.
    #[must_use]
    pub fn conductivity_s_m(self, frequency: Frequency) -> f64 {
        self.c * math::pow(frequency.get() * 1e-9, self.d)
    }
}

impl Default for TwoRayExact {
    fn default() -> Self {
        Self {
            polarisation: Polarisation::Vertical,
            ground: Ground::MEDIUM_DRY,
            height: Length::ZERO,
        }
    }
}

/// `1 / (2 pi epsilon0 c)`, ohms: the 60 of `60 sigma lambda`.
const SIXTY_OHM: f64 = 59.958_491_6;

/// The numbers of one frequency and one antenna.
#[derive(Clone, Copy)]
struct Law {
    /// `lambda / 4 pi`.
    near_m: f64,
    /// `1 / lambda`.
    per_m: f64,
    /// Complex permittivity.
    e: [f64; 2],
    /// What multiplies `sin t`.
    s: [f64; 2],
    least_m: f64,
    height_m: f64,
}

impl Law {
    fn new(model: &TwoRayExact, frequency: Frequency) -> Self {
        let wave_m = (SPEED_OF_LIGHT / frequency).metres();
        let e = [
            model.ground.permittivity(frequency),
            -SIXTY_OHM * model.ground.conductivity_s_m(frequency) * wave_m,
        ];
        Self {
            near_m: reference_m(frequency),
            per_m: 1.0 / wave_m,
            e,
            s: match model.polarisation {
                Polarisation::Vertical => e,
                Polarisation::Horizontal => [1.0, 0.0],
            },
            least_m: HEIGHT_MIN.metres(),
            height_m: model.height.metres(),
        }
    }

    /// Equations 1 and 2. `level_m2` is the square of the distance on the map.
    #[inline(always)]
    fn gain(self, level_m2: f64, up_m: [f64; 2]) -> f64 {
        let height = |up_m: f64| {
            let height = up_m + self.height_m;
            if height > self.least_m {
                height
            } else {
                self.least_m
            }
        };
        let (h1, h2) = (height(up_m[0]), height(up_m[1]));
        let (rise, sum) = (h1 - h2, h1 + h2);
        let d1 = (level_m2 + rise * rise).sqrt();
        let square2 = level_m2 + sum * sum;
        let d2 = square2.sqrt();
        // d2 - d1 without cancellation.
        let longer_m = 4.0 * h1 * h2 / (d1 + d2);
        let (sin, cos) = sin_cos_turns(longer_m * self.per_m);

        let sin_t = sum / d2;
        let cos2_t = level_m2 / square2;
        // The square root with the positive real part.
        let (x, y) = (self.e[0] - cos2_t, self.e[1]);
        let size = (x * x + y * y).sqrt();
        let (qr, qi) = ((0.5 * (size + x)).sqrt(), -(0.5 * (size - x)).abs().sqrt());
        let (nr, ni) = (self.s[0] * sin_t - qr, self.s[1] * sin_t - qi);
        let (mr, mi) = (self.s[0] * sin_t + qr, self.s[1] * sin_t + qi);
        let over = 1.0 / (mr * mr + mi * mi);
        let (gr, gi) = ((nr * mr + ni * mi) * over, (ni * mr - nr * mi) * over);

        // In units of the direct ray: 1 + G (d1 / d2) exp(-j phase).
        let share = d1 / d2;
        let real = 1.0 + share * (gr * cos + gi * sin);
        let imaginary = share * (gi * cos - gr * sin);
        let direct = self.near_m / d1;
        let gain = direct * direct * (real * real + imaginary * imaginary);
        // In one place there is no field to speak of: nothing is lost.
        if d1 > 0.0 { held_gain(gain) } else { 1.0 }
    }
}

impl Propagation for TwoRayExact {
    fn loss(&self, link: &Link) -> Decibels {
        let law = Law::new(self, link.frequency);
        let up = |end: &End| end.position.si().z;
        let level = link.tx.position.si().truncate() - link.rx.position.si().truncate();
        let gain = law.gain(level.length_squared(), [up(&link.tx), up(&link.rx)]);
        -Decibels::from_ratio(gain)
    }

    fn gains(&self, links: &Links<'_>, gains: &mut [f32]) {
        let law = Law::new(self, links.frequency);
        let [x, y, near_up] = links.near_enu_m.map(f64::from);
        let n = gains.len();
        let [east, north, up] = links.far_enu_m.map(|axis| &axis[..n]);
        for (j, gain) in gains.iter_mut().enumerate() {
            let (dx, dy) = (f64::from(east[j]) - x, f64::from(north[j]) - y);
            *gain = law.gain(dx * dx + dy * dy, [near_up, up[j].into()]) as f32;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::propagation::FreeSpace;
    use crate::propagation::testing::{CHANNEL, along, assert_rows_agree, between, link};
    use glam::DVec3;

    fn loss(model: &TwoRayExact, level_m: f64, h1: f64, h2: f64) -> f64 {
        let (tx, rx) = (DVec3::new(0.0, 0.0, h1), DVec3::new(level_m, 0.0, h2));
        model.loss(&between(tx, rx)).db()
    }

    /// Equation 1 with complex numbers written out, and libm's sine and cosine.
    #[test]
    fn it_is_the_sum_of_two_rays() {
        let lambda = 299_792_458.0 / 2.405e9;
        let k = std::f64::consts::TAU / lambda;
        let perfect = TwoRayExact {
            polarisation: Polarisation::Horizontal,
            ground: Ground::PERFECT,
            ..TwoRayExact::default()
        };
        for (r, h1, h2) in [
            (10.0, 1.0, 1.0),
            (3.0, 5.0, 2.0),
            (200.0, 10.0, 1.5),
            (0.5, 20.0, 20.0),
        ] {
            let d1 = f64::sqrt(r * r + (h1 - h2) * (h1 - h2));
            let d2 = f64::sqrt(r * r + (h1 + h2) * (h1 + h2));
            let ((s1, c1), (s2, c2)) = (math::sin_cos(k * d1), math::sin_cos(k * d2));
            // A perfect mirror turns the horizontal field over.
            let (real, imaginary) = (c1 / d1 - c2 / d2, s1 / d1 - s2 / d2);
            let size = lambda / (4.0 * std::f64::consts::PI);
            let want =
                -Decibels::from_ratio(size * size * (real * real + imaginary * imaginary)).db();
            let got = loss(&perfect, r, h1, h2);
            assert!((got - want).abs() < 2e-3, "{r} m: {got}, not {want}");
        }
    }

    #[test]
    fn far_away_it_is_the_fourth_power() {
        for polarisation in [Polarisation::Horizontal, Polarisation::Vertical] {
            let model = TwoRayExact {
                polarisation,
                ..TwoRayExact::default()
            };
            // At grazing incidence every ground reflects with -1.
            let want = 40.0 * math::log10(20_000.0) - 20.0 * math::log10(2.0 * 1.5);
            let got = loss(&model, 20_000.0, 2.0, 1.5);
            assert!(
                (got - want).abs() < 0.1,
                "{polarisation:?}: {got}, not {want}"
            );
        }
    }

    #[test]
    fn at_brewsters_angle_an_upright_wave_is_not_reflected() {
        // tan(t) = 1 / sqrt(e): with e = 9, a third as high as wide; only the direct ray is left.
        let model = TwoRayExact {
            ground: Ground::constant(9.0, 0.0),
            ..TwoRayExact::default()
        };
        let (r, h) = (12.0, 2.0);
        let free = FreeSpace.loss(&link(r, h, h)).db();
        assert!((loss(&model, r, h, h) - free).abs() < 1e-6);
        let across = TwoRayExact {
            polarisation: Polarisation::Horizontal,
            ..model
        };
        let over = |i: i32| {
            let scale = 1.0 + 0.002 * f64::from(i);
            let free = FreeSpace.loss(&link(r * scale, h * scale, h * scale)).db();
            free - loss(&across, r * scale, h * scale, h * scale)
        };
        let most = (0..100).map(over).fold(0.0, f64::max);
        assert!((4.0..6.0).contains(&most), "{most} dB");
    }

    #[test]
    fn straight_below_both_polarisations_are_one_thing_but_for_the_sign() {
        // At normal incidence |G| = (n - 1) / (n + 1): peaks and nulls over height are those of 1 +- |G| d1/d2.
        let model = TwoRayExact {
            ground: Ground::constant(16.0, 0.0),
            ..TwoRayExact::default()
        };
        let lambda = 299_792_458.0 / 2.405e9;
        let (h1, h2) = (10.0, 2.0);
        let mut extremes = [f64::INFINITY, f64::NEG_INFINITY];
        for i in 0..400 {
            let low = h2 + lambda * f64::from(i) / 400.0;
            let free = FreeSpace.loss(&between(DVec3::Z * h1, DVec3::Z * low)).db();
            let over = free - loss(&model, 0.0, h1, low);
            extremes = [extremes[0].min(over), extremes[1].max(over)];
        }
        let share = 0.6 * 8.0 / 12.0;
        for (got, size) in extremes.into_iter().zip([1.0 - share, 1.0 + share]) {
            let want = 20.0 * math::log10(size);
            assert!((got - want).abs() < 0.2, "{got} dB, not {want} dB");
        }
    }

    #[test]
    fn antennas_on_the_ground_below_it_and_in_one_place_give_numbers() {
        for h in [(0.0, 0.0), (-1.0, 2.0), (0.0, 3.0), (5.0, 5.0)] {
            for r in [0.0, 1e-6, 0.01, 1.0, 1e5] {
                let loss = loss(&TwoRayExact::default(), r, h.0, h.1);
                assert!((0.0..=300.0).contains(&loss), "{h:?}, {r} m: {loss}");
            }
        }
        // One centimetre up or on the ground is the same, and each more helps far away.
        let far = |h| loss(&TwoRayExact::default(), 300.0, h, 1.0);
        assert_eq!(far(0.0), far(0.01));
        assert!(far(0.5) < far(0.1) && far(0.1) < far(0.01));
    }

    #[test]
    fn grounds_are_what_they_are_called() {
        let at = |ground: Ground| {
            (
                ground.permittivity(CHANNEL),
                ground.conductivity_s_m(CHANNEL),
            )
        };
        let (dry, wet) = (at(Ground::VERY_DRY), at(Ground::WET));
        assert!(dry.0 < wet.0 && dry.1 < wet.1);
        // Debye: e = 5.2 + (es - 5.2) / (1 + j w tau) - j sigma / (w e0).
        let water = |es: f64, sigma: f64| {
            let w = std::f64::consts::TAU * 2.405e9;
            let x = w * 9.4e-12;
            let step = (es - 5.2) / (1.0 + x * x);
            (5.2 + step, step * x * w * 8.854e-12 + sigma)
        };
        for (ground, (e, sigma)) in [
            (Ground::FRESH_WATER, water(80.0, 0.0)),
            (Ground::SEA_WATER, water(70.0, 5.0)),
        ] {
            let (got_e, got_sigma) = at(ground);
            assert!((got_e / e - 1.0).abs() < 0.03, "{got_e}, not {e}");
            assert!(
                (got_sigma / sigma - 1.0).abs() < 0.05,
                "{got_sigma}, not {sigma}"
            );
        }
    }

    #[test]
    fn rows_of_links_agree_with_single_ones() {
        for ground in [Ground::MEDIUM_DRY, Ground::PERFECT, Ground::VERY_DRY] {
            for polarisation in [Polarisation::Horizontal, Polarisation::Vertical] {
                let model = TwoRayExact {
                    polarisation,
                    ground,
                    height: Length::from_metres(0.1),
                };
                assert_rows_agree(&model, &along(800, 3.0), 1e-3);
            }
        }
    }
}
