//! Errors that sensors have in common.
//!
//! A [`Channel`] turns what is true into what a real sensor says, in this order:
//!
//! ```text
//! y = (1 + s) x + B + b + d(t) + sigma n    scale, biases, drift, white noise   (1)
//! y = clamp(y, -limit, limit)               saturation                          (2)
//! y = step round(y / step)                  quantisation                        (3)
//! ```
//! Where the limit is no multiple of the step, readings end at the last multiple within it.
//! `B` is a bias that is known. `s` and `b` are drawn once, when the sensor is first read: N(0, scale_sigma), N(0, bias_sigma).
//! `n` is N(0, 1), new at each reading. The drift `d` is a random walk of density `K`, or, with a
//! correlation time `T`, a Gauss-Markov process of standard deviation `D`:
//!
//! ```text
//! d(t + dt) = d(t) + K sqrt(dt) n                                               (4)
//! d(t + dt) = exp(-dt / T) d(t) + D sqrt(1 - exp(-2 dt / T)) n                  (5)
//! ```
//! A datasheet's noise density `N` (in units per sqrt(Hz)) is a sigma of `N sqrt(B)` in the noise
//! bandwidth `B`; samples at a rate `f` without other filter have `B = f / 2`. In Allan deviation
//! white noise at `f` shows as `sigma / sqrt(f tau)`, the walk as `K sqrt(tau / 3)`, and the process
//! as a hump of about `0.6 D` near `1.9 T` (IEEE Std 952-1997, annex C).

use simbeeotic_model::kernel::{SimTime, Stream};
use simbeeotic_model::units::math;

/// The errors of one axis, in the unit of what is measured. The default has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Standard deviation of the white noise of each reading. 0 or more.
    pub sigma: f64,
    /// A constant bias that is known.
    pub bias: f64,
    /// Standard deviation of the constant bias that each sensor has besides. 0 or more.
    pub bias_sigma: f64,
    /// Standard deviation of the scale factor's error, a fraction. 0 or more.
    pub scale_sigma: f64,
    /// How the bias drifts.
    pub drift: Drift,
    /// Readings end here, on both sides of 0. Above 0.
    pub limit: f64,
    /// Readings are multiples of this; 0: they are not. 0 or more.
    pub step: f64,
}

/// How a bias drifts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drift {
    /// It does not.
    None,
    /// A random walk of this density, in units per sqrt(s): equation 4.
    Walk(f64),
    /// A Gauss-Markov process of this standard deviation and correlation time, s: equation 5.
    Markov {
        /// Standard deviation in the long run, which it starts with.
        sigma: f64,
        /// Correlation time, s. Above 0.
        time_s: f64,
    },
}

impl Default for Errors {
    fn default() -> Self {
        Self {
            sigma: 0.0,
            bias: 0.0,
            bias_sigma: 0.0,
            scale_sigma: 0.0,
            drift: Drift::None,
            limit: f64::INFINITY,
            step: 0.0,
        }
    }
}

impl Errors {
    /// White noise alone.
    pub fn white(sigma: f64) -> Self {
        Self {
            sigma,
            ..Self::default()
        }
    }
}

/// One axis of one sensor, with the errors it has got.
#[derive(Clone, Debug)]
pub struct Channel {
    errors: Errors,
    /// What was drawn at the first reading.
    own: Option<Own>,
}

#[derive(Clone, Copy, Debug)]
struct Own {
    scale: f64,
    bias: f64,
    drift: f64,
    last: SimTime,
}

impl Channel {
    /// A channel with these errors.
    pub fn new(errors: Errors) -> Self {
        Self { errors, own: None }
    }

    /// What is read at `now` where `ideal` is true.
    pub fn read(&mut self, ideal: f64, now: SimTime, rng: &mut Stream) -> f64 {
        let Errors {
            sigma,
            bias,
            limit,
            step,
            ..
        } = self.errors;
        let own = self.drifted(now, rng);
        let noise = if sigma > 0.0 {
            sigma * rng.normal()
        } else {
            0.0
        };
        let read = (1.0 + own.scale) * ideal + bias + own.bias + own.drift + noise;
        if step > 0.0 {
            // As many whole steps as the limit holds; a step that is lost to rounding counts.
            let most = (limit / step * (1.0 + 1e-12)).floor();
            step * (read / step).round().clamp(-most, most)
        } else {
            read.clamp(-limit, limit)
        }
    }

    /// Equations 4 and 5, from the last reading to this one.
    fn drifted(&mut self, now: SimTime, rng: &mut Stream) -> Own {
        let errors = self.errors;
        let mut draw = |sigma: f64| {
            if sigma > 0.0 {
                sigma * rng.normal()
            } else {
                0.0
            }
        };
        let Some(mut own) = self.own else {
            let first = Own {
                scale: draw(errors.scale_sigma),
                bias: draw(errors.bias_sigma),
                drift: match errors.drift {
                    Drift::Markov { sigma, .. } => draw(sigma),
                    _ => 0.0,
                },
                last: now,
            };
            self.own = Some(first);
            return first;
        };
        let dt = now.nanos().saturating_sub(own.last.nanos()) as f64 * 1e-9;
        if dt > 0.0 {
            match errors.drift {
                Drift::None => {}
                Drift::Walk(density) => own.drift += draw(density * dt.sqrt()),
                Drift::Markov { sigma, time_s } => {
                    let kept = math::exp(-dt / time_s);
                    own.drift = kept * own.drift + draw(sigma * (1.0 - kept * kept).sqrt());
                }
            }
            own.last = now;
            self.own = Some(own);
        }
        own
    }
}

/// Three axes, each with errors of its own.
#[derive(Clone, Debug)]
pub struct Axes([Channel; 3]);

impl Axes {
    /// Three channels with these errors.
    pub fn new(errors: Errors) -> Self {
        Self::each([errors; 3])
    }

    /// Three channels, each with its own errors.
    pub fn each(errors: [Errors; 3]) -> Self {
        Self(errors.map(Channel::new))
    }

    /// What is read at `now` where `ideal` is true.
    pub fn read(&mut self, ideal: glam::DVec3, now: SimTime, rng: &mut Stream) -> glam::DVec3 {
        let [x, y, z] = &mut self.0;
        glam::DVec3::new(
            x.read(ideal.x, now, rng),
            y.read(ideal.y, now, rng),
            z.read(ideal.z, now, rng),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{allan_deviation, assert_normal};

    /// `n` readings of zero, `dt_ms` apart.
    fn readings(errors: Errors, n: u64, dt_ms: u64) -> Vec<f64> {
        let mut channel = Channel::new(errors);
        let mut rng = Stream::new(3, "bee/imu", "noise");
        let at = |step| SimTime::from_millis(step * dt_ms);
        (0..n)
            .map(|step| channel.read(0.0, at(step), &mut rng))
            .collect()
    }

    #[test]
    fn white_noise_has_the_sigma_it_says_and_falls_with_the_root_of_the_time() {
        let read = readings(Errors::white(0.02), 100_000, 10);
        assert_normal(&read, 0.0, 0.02);
        for tau in [1, 10, 100] {
            let found = allan_deviation(&read, tau);
            let want = 0.02 / (tau as f64).sqrt();
            assert!(
                (found / want - 1.0).abs() < 0.05,
                "{tau}: {found} for {want}"
            );
        }
    }

    #[test]
    fn a_walk_grows_with_the_root_of_the_time() {
        let errors = Errors {
            drift: Drift::Walk(0.5),
            ..Errors::default()
        };
        let read = readings(errors, 100_000, 10);
        for tau in [10, 100] {
            // K sqrt(tau / 3), tau in seconds.
            let want = 0.5 * (tau as f64 * 0.01 / 3.0).sqrt();
            let found = allan_deviation(&read, tau);
            assert!(
                (found / want - 1.0).abs() < 0.1,
                "{tau}: {found} for {want}"
            );
        }
    }

    #[test]
    fn a_process_keeps_its_sigma_and_forgets_in_its_time() {
        let errors = Errors {
            drift: Drift::Markov {
                sigma: 2.0,
                time_s: 0.5,
            },
            ..Errors::default()
        };
        let read = readings(errors, 100_000, 10);
        let mean = |products: &mut dyn Iterator<Item = f64>| {
            let (sum, n) = products.fold((0.0, 0), |(sum, n), p| (sum + p, n + 1));
            sum / f64::from(n)
        };
        let variance = mean(&mut read.iter().map(|r| r * r));
        // 1,000 s hold 1,000 correlation times of 2 x 0.5 s: 4 sigma are 4 sqrt(2 / 1000).
        assert!((variance / 4.0 - 1.0).abs() < 0.18, "{variance}");
        let lagged = mean(&mut read.iter().zip(&read[50..]).map(|(a, b)| a * b));
        assert!(
            (lagged / variance - math::exp(-1.0)).abs() < 0.12,
            "{lagged}"
        );
    }

    #[test]
    fn a_bias_is_drawn_once_for_each_sensor() {
        let errors = Errors {
            bias_sigma: 0.3,
            ..Errors::default()
        };
        let mut rng = Stream::new(4, "bee/imu", "noise");
        let biases: Vec<f64> = (0..100_000)
            .map(|_| {
                let mut channel = Channel::new(errors);
                let first = channel.read(0.0, SimTime::ZERO, &mut rng);
                assert_eq!(channel.read(0.0, SimTime::from_secs(9), &mut rng), first);
                first
            })
            .collect();
        assert_normal(&biases, 0.0, 0.3);
    }

    #[test]
    fn readings_saturate_and_come_in_steps() {
        let errors = Errors {
            limit: 2.0,
            step: 0.25,
            ..Errors::default()
        };
        let mut channel = Channel::new(errors);
        let mut rng = Stream::new(5, "bee/imu", "noise");
        for (ideal, want) in [
            (0.3, 0.25),
            (-0.4, -0.5),
            (5.0, 2.0),
            (-5.0, -2.0),
            (0.0, 0.0),
        ] {
            assert_eq!(
                channel.read(ideal, SimTime::ZERO, &mut rng),
                want,
                "{ideal}"
            );
        }
    }

    #[test]
    fn no_step_lies_beyond_the_limit() {
        let mut rng = Stream::new(5, "bee/imu", "noise");
        for (limit, step, want) in [
            (2.0, 0.75, 1.5),
            (1.9, 0.75, 1.5),
            (0.3, 1.0, 0.0),
            // 32,000 steps of a shunt monitor, of which rounding must not take the last.
            (3.2, 1e-4, 3.2),
            (f64::INFINITY, 0.5, 1e6),
        ] {
            let errors = Errors {
                limit,
                step,
                ..Errors::default()
            };
            let mut channel = Channel::new(errors);
            for sign in [1.0, -1.0] {
                let read = channel.read(sign * 1e6, SimTime::ZERO, &mut rng);
                assert!((read - sign * want).abs() < 1e-9, "{limit}, {step}: {read}");
            }
        }
    }

    #[test]
    fn a_scale_error_is_a_fraction_of_what_is_measured() {
        let errors = Errors {
            scale_sigma: 0.01,
            ..Errors::default()
        };
        let mut rng = Stream::new(6, "bee/imu", "noise");
        let scales: Vec<f64> = (0..100_000)
            .map(|_| Channel::new(errors).read(200.0, SimTime::ZERO, &mut rng))
            .collect();
        assert_normal(&scales, 200.0, 2.0);
    }
}
