//! What range sensors have in common: which rays stand for a beam, and what a real sensor makes of a
//! distance.
//!
//! ```text
//! y = x + b + s n,   s^2 = sigma^2 + (f x)^2 + rain(x)^2       bias, noise          (1)
//! y = step round(y / step)                                     quantisation         (2)
//! nothing, if y is beyond the greatest range, or the echo is lost by chance         (3)
//! ```
//! `x` is the true distance, `b` is drawn once for each sensor, N(0, bias_sigma), and `n` is N(0, 1), new
//! for each echo; `f` is the part of the noise that grows with the distance. Rain brings the greatest
//! range down and adds to the noise, as [`rain`] says. What is nearer than the least range is no
//! echo, or reads as the least range.
//!
//! A beam of some width is a bundle of `N` rays that share its solid angle evenly, in a spiral about its
//! axis; the first is the axis, the last is on the rim:
//!
//! ```text
//! cos t_i = 1 - (1 - cos h) i / (N - 1),   phi_i = i pi (3 - sqrt 5),   i = 0 ... N - 1   (4)
//! ```
//! with `h` half the field of view. What the beam reads is the nearest of its echoes, or their mean
//! weighted by the light that comes back, `w = cos(incidence) / x^2`.

use super::bounds::{at_least_zero, positive, reach, step};
use glam::{DQuat, DVec3};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Length, RainRate, math};
use simbeeotic_model::world::weather::rain;
use simbeeotic_model::{Beams, BuildError, Echo, SeesWhat, Truth, choice};
use std::f64::consts::{FRAC_PI_2, PI};

/// Most rays of one reading.
pub(super) const RAYS_MAX: u32 = 1_000_000;

/// What becomes of an echo from nearer than the least range.
#[choice]
pub enum TooNear {
    /// It is none.
    Nothing,
    /// It reads as the least range.
    Clamp,
}

/// Which of the echoes of a beam counts.
#[choice]
pub enum WhichEcho {
    /// The nearest.
    Nearest,
    /// All: their mean, weighted by the light that comes back from each.
    Mean,
}

/// The errors of a range sensor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ranging {
    pub(super) min_range: Length,
    pub(super) max_range: Length,
    pub(super) sigma: Length,
    pub(super) sigma_fraction: f64,
    pub(super) bias_sigma: Length,
    pub(super) step: Length,
    pub(super) lost: f64,
    pub(super) too_near: TooNear,
}

/// One range sensor, with the bias it has got.
#[derive(Clone, Debug)]
pub(super) struct Ranger {
    errors: Ranging,
    bias_m: Option<f64>,
}

/// The air during one reading.
pub(super) struct Clarity {
    rain: RainRate,
    max_m: f64,
}

impl Ranger {
    /// # Errors
    /// Numbers out of range.
    pub(super) fn new(errors: Ranging) -> Result<Self, BuildError> {
        reach("max_range", errors.max_range)?;
        in_range(
            "min_range",
            errors.min_range,
            Length::ZERO..=errors.max_range,
        )?;
        at_least_zero("sigma", errors.sigma)?;
        at_least_zero("sigma_fraction", errors.sigma_fraction)?;
        at_least_zero("bias_sigma", errors.bias_sigma)?;
        step("step", errors.step)?;
        in_range("lost", errors.lost, 0.0..=1.0)?;
        Ok(Self {
            errors,
            bias_m: None,
        })
    }

    /// How far it looks in clear air.
    pub(super) fn max_range(&self) -> Length {
        self.errors.max_range
    }

    /// How clear the air is where the sensor is.
    pub(super) fn clarity(&self, truth: &Truth<'_>) -> Clarity {
        let rain = truth
            .weather()
            .rain(truth.sensor_pose().position, truth.now());
        let max = self.errors.max_range;
        let max = if rain > RainRate::ZERO {
            rain::visible_range(rain, max)
        } else {
            max
        };
        Clarity {
            rain,
            max_m: max.get(),
        }
    }

    /// Equations 1 to 3 for a true distance, m. Nothing is NaN, before and after.
    pub(super) fn measure(&mut self, ideal_m: f64, air: &Clarity, rng: &mut Stream) -> f64 {
        let errors = self.errors;
        let bias_m = *self.bias_m.get_or_insert_with(|| {
            let sigma_m = errors.bias_sigma.get();
            if sigma_m > 0.0 {
                sigma_m * rng.normal()
            } else {
                0.0
            }
        });
        if ideal_m.is_nan() || ideal_m > air.max_m {
            return f64::NAN;
        }
        if errors.lost > 0.0 && rng.bernoulli(errors.lost) {
            return f64::NAN;
        }
        let (own, far) = (errors.sigma.get(), errors.sigma_fraction * ideal_m);
        let mut variance = own * own + far * far;
        if air.rain > RainRate::ZERO {
            let wet = rain::range_sigma(air.rain, Length::si(ideal_m)).get();
            variance += wet * wet;
        }
        let mut read_m = ideal_m + bias_m;
        if variance > 0.0 {
            read_m += variance.sqrt() * rng.normal();
        }
        if errors.step > Length::ZERO {
            let step_m = errors.step.get();
            read_m = step_m * (read_m / step_m).round();
        }
        let min_m = errors.min_range.get();
        if read_m > air.max_m {
            f64::NAN
        } else if read_m >= min_m {
            read_m
        } else {
            match errors.too_near {
                TooNear::Nothing => f64::NAN,
                TooNear::Clamp => min_m,
            }
        }
    }

    /// What is read, in the air where the sensor is, of one distance that may be nothing.
    pub(super) fn read(
        &mut self,
        ideal: Option<Length>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Option<Length> {
        let air = self.clarity(truth);
        self.measure_one(ideal, &air, rng)
    }

    /// As [`measure`](Self::measure), for a reading that may be nothing.
    pub(super) fn measure_one(
        &mut self,
        ideal: Option<Length>,
        air: &Clarity,
        rng: &mut Stream,
    ) -> Option<Length> {
        let ideal_m = ideal.map_or(f64::NAN, Length::get);
        some(self.measure(ideal_m, air, rng))
    }
}

/// A distance in metres, if it is one.
pub(super) fn some(distance_m: f64) -> Option<Length> {
    (!distance_m.is_nan()).then_some(Length::si(distance_m))
}

/// How wide a beam is, and what it makes of its echoes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Beam {
    /// From rim to rim; zero is one ray.
    pub(super) field_of_view: Angle,
    pub(super) rays: u32,
    pub(super) echo: WhichEcho,
    /// Surfaces that are met at a flatter angle send nothing back.
    pub(super) max_incidence: Angle,
    pub(super) sees: SeesWhat,
}

/// The rays of one beam, or of several that look at once.
#[derive(Clone, Debug)]
pub(super) struct Bundle {
    directions: Box<[DVec3]>,
    half_angle: Angle,
    /// Rays of one beam.
    rays: usize,
    echo: WhichEcho,
    facing_min: f64,
    sees: SeesWhat,
}

/// What turns the forward axis to `axis`. Straight back is half a turn about the vertical axis.
fn turn_to(axis: DVec3) -> DQuat {
    if axis.x < -1.0 + 1e-12 {
        return DQuat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    }
    DQuat::from_rotation_arc(DVec3::X, axis)
}

impl Bundle {
    /// One beam about each of some axes, in the sensor's frame, of unit length.
    ///
    /// # Errors
    /// Numbers out of range.
    pub(super) fn new(axes: &[DVec3], beam: Beam) -> Result<Self, BuildError> {
        let half_turn = Angle::si(PI);
        in_range("field_of_view", beam.field_of_view, Angle::ZERO..=half_turn)?;
        in_range("rays", beam.rays, 1..=RAYS_MAX / 10)?;
        positive("max_incidence", beam.max_incidence)?;
        let level = Angle::si(FRAC_PI_2);
        in_range("max_incidence", beam.max_incidence, Angle::ZERO..=level)?;
        let half = beam.field_of_view.get() * 0.5;
        let rays = if half > 0.0 { beam.rays as usize } else { 1 };
        let directions = axes.iter().flat_map(|axis| {
            let turn = turn_to(*axis);
            (0..rays)
                .map(move |at| turn * spiral(half, at, at as f64 / (rays as f64 - 1.0).max(1.0)))
        });
        Ok(Self {
            directions: directions.collect(),
            half_angle: beam.field_of_view / 2.0,
            rays,
            echo: beam.echo,
            // A cosine of pi / 2 is not quite zero.
            facing_min: if beam.max_incidence == level {
                0.0
            } else {
                math::cos(beam.max_incidence.get())
            },
            sees: beam.sees,
        })
    }

    /// The beam of a sensor that has one.
    pub(super) fn beams(&self, ranger: &Ranger) -> Option<Beams> {
        Some(Beams::cone(self.half_angle, ranger.max_range()))
    }

    /// What each of the beams meets within `range`, m; NaN where there is nothing.
    pub(super) fn distances<const N: usize>(&self, truth: &Truth<'_>, range: Length) -> [f64; N] {
        let mut beams = [Echoes::NONE; N];
        let directions = self.directions.iter().copied();
        truth.look(directions, range, self.sees, |at, echo| {
            if let Some(echo) = echo.filter(|echo| echo.facing >= self.facing_min)
                && let Some(beam) = beams.get_mut(at / self.rays)
            {
                beam.add(&echo);
            }
        });
        beams.map(|beam| beam.distance_m(self.echo))
    }
}

/// The echoes of one beam.
#[derive(Clone, Copy)]
struct Echoes {
    nearest_m: f64,
    weights: f64,
    weighted_m: f64,
}

impl Echoes {
    const NONE: Self = Self {
        nearest_m: f64::INFINITY,
        weights: 0.0,
        weighted_m: 0.0,
    };

    fn add(&mut self, echo: &Echo) {
        let distance_m = echo.distance.get();
        self.nearest_m = self.nearest_m.min(distance_m);
        let weight = echo.facing / (distance_m * distance_m);
        self.weights += weight;
        self.weighted_m += weight * distance_m;
    }

    fn distance_m(self, which: WhichEcho) -> f64 {
        if self.nearest_m.is_infinite() {
            return f64::NAN;
        }
        match which {
            // Surfaces that are met edge on send nothing back and weigh nothing.
            WhichEcho::Mean if self.weights > 0.0 => self.weighted_m / self.weights,
            _ => self.nearest_m,
        }
    }
}

/// A direction about `x`, unit: at `share` of the solid angle of a cone of half width `half`, in the
/// direction `phi` from its axis; angles in rad.
pub(super) fn cone(half: f64, share: f64, phi: f64) -> DVec3 {
    // 1 - cos h without loss for small angles.
    let sine = math::sin(0.5 * half);
    let cos = 1.0 - 2.0 * sine * sine * share;
    let across = ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt();
    let (sin_phi, cos_phi) = math::sin_cos(phi);
    DVec3::new(cos, across * cos_phi, across * sin_phi)
}

/// The `at`-th direction of a spiral: each a golden angle on from the last.
fn spiral(half: f64, at: usize, share: f64) -> DVec3 {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    cone(half, share, golden * at as f64)
}

/// The middles of `rays` equal parts of the solid angle of a cone about `x`.
pub(super) fn parts(half: f64, rays: u32) -> impl Iterator<Item = DVec3> {
    let each = f64::from(rays);
    (0..rays).map(move |at| spiral(half, at as usize, (f64::from(at) + 0.5) / each))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::assert_normal;

    const PLAIN: Ranging = Ranging {
        min_range: Length::si(0.1),
        max_range: Length::si(5.0),
        sigma: Length::ZERO,
        sigma_fraction: 0.0,
        bias_sigma: Length::ZERO,
        step: Length::ZERO,
        lost: 0.0,
        too_near: TooNear::Nothing,
    };
    const CLEAR: Clarity = Clarity {
        rain: RainRate::ZERO,
        max_m: 5.0,
    };

    fn readings(errors: Ranging, ideal_m: f64, air: &Clarity) -> Vec<f64> {
        let mut ranger = Ranger::new(errors).expect("good numbers");
        let mut rng = Stream::new(11, "bee/range", "noise");
        (0..100_000)
            .map(|_| ranger.measure(ideal_m, air, &mut rng))
            .collect()
    }

    #[test]
    fn a_bundle_is_turned_to_its_axis_even_straight_back() {
        for axis in [
            DVec3::X,
            -DVec3::X,
            DVec3::Y,
            DVec3::Z,
            DVec3::new(-0.6, 0.8, 0.0),
        ] {
            let turned = turn_to(axis) * DVec3::X;
            assert!((turned - axis).length() < 1e-12, "{axis}: {turned}");
        }
        // Up stays up.
        assert_eq!(turn_to(-DVec3::X) * DVec3::Z, DVec3::Z);
    }

    #[test]
    fn the_noise_has_a_constant_part_and_one_that_grows_with_the_distance() {
        let errors = Ranging {
            sigma: Length::si(0.03),
            sigma_fraction: 0.02,
            ..PLAIN
        };
        assert_normal(&readings(errors, 2.0, &CLEAR), 2.0, 0.05);
        assert_normal(
            &readings(errors, 1.0, &CLEAR),
            1.0,
            (9e-4 + 4e-4_f64).sqrt(),
        );
    }

    #[test]
    fn rain_adds_to_the_noise_and_takes_from_the_range() {
        let rain = RainRate::si(20.0);
        let wet = Clarity { rain, max_m: 4.9 };
        let sigma = rain::range_sigma(rain, Length::si(3.0)).get();
        assert_normal(&readings(PLAIN, 3.0, &wet), 3.0, sigma);
        assert!(readings(PLAIN, 4.95, &wet).iter().all(|read| read.is_nan()));
        assert!(!readings(PLAIN, 4.95, &CLEAR)[0].is_nan());
    }

    #[test]
    fn each_sensor_has_one_bias() {
        let errors = Ranging {
            bias_sigma: Length::si(0.1),
            ..PLAIN
        };
        let mut rng = Stream::new(11, "bee/range", "noise");
        let biases: Vec<f64> = (0..100_000)
            .map(|_| {
                let mut ranger = Ranger::new(errors).expect("good numbers");
                let read = ranger.measure(2.0, &CLEAR, &mut rng);
                assert_eq!(ranger.measure(2.0, &CLEAR, &mut rng), read);
                read
            })
            .collect();
        assert_normal(&biases, 2.0, 0.1);
    }

    #[test]
    fn lost_echoes_are_as_many_as_it_says() {
        let errors = Ranging { lost: 0.2, ..PLAIN };
        let lost = readings(errors, 2.0, &CLEAR);
        let lost = lost.iter().filter(|read| read.is_nan()).count() as f64;
        assert!(
            (lost - 2e4).abs() < 4.0 * (1e5_f64 * 0.2 * 0.8).sqrt(),
            "{lost}"
        );
    }

    #[test]
    fn readings_come_in_steps_and_end_at_the_range() {
        let errors = Ranging {
            step: Length::si(0.25),
            ..PLAIN
        };
        for (ideal, want) in [(0.3, 0.25), (1.9, 2.0), (4.99, 5.0)] {
            assert_eq!(readings(errors, ideal, &CLEAR)[0], want);
        }
        // 5 cm is nearer than 10 cm; quantisation takes 0.12 to 0.
        for (ideal, clamped) in [(0.05, 0.1), (0.12, 0.1)] {
            assert!(readings(errors, ideal, &CLEAR)[0].is_nan());
            let errors = Ranging {
                too_near: TooNear::Clamp,
                ..errors
            };
            assert_eq!(readings(errors, ideal, &CLEAR)[0], clamped);
        }
        assert!(readings(PLAIN, f64::NAN, &CLEAR)[0].is_nan());
    }

    #[test]
    fn a_beam_fills_its_cone_evenly_from_axis_to_rim() {
        let half = 0.4;
        let directions: Vec<DVec3> = (0..1000)
            .map(|at| spiral(half, at, at as f64 / 999.0))
            .collect();
        assert!(directions.iter().all(|d| d.is_normalized()));
        assert_eq!(directions[0], DVec3::X);
        assert!((math::acos(directions[999].x) - half).abs() < 1e-9);
        // Half of the solid angle holds half of the rays, and no side has more than another.
        let middle = 1.0 - 0.5 * (1.0 - math::cos(half));
        let inner = directions.iter().filter(|d| d.x > middle).count();
        assert!((499..=501).contains(&inner), "{inner}");
        let mean = directions.iter().sum::<DVec3>() / 1000.0;
        assert!(mean.y.abs() < 1e-3 && mean.z.abs() < 1e-3, "{mean}");
    }
}
