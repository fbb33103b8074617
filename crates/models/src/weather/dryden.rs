//! Dryden turbulence as a frozen field that the mean wind carries along.
//!
//! Isotropic turbulence of intensity `sigma` and scale `L` whose correlations along and across a
//! distance `r` are
//!
//! ```text
//! f(r) = exp(-r / L)        g(r) = (1 - r / 2L) exp(-r / L)                        (1)
//! E(k) = (8 / pi) sigma^2 L (L k)^4 / (1 + (L k)^2)^3                              (2)
//! ```
//! has the Dryden spectra of MIL-F-8785C (1980), sec. 3.7.1.2; equation 2 is their three-dimensional
//! form, the energy at wave number `k` (integral: 3/2 sigma^2). The field is a sum of `n` helical
//! waves of equal energy,
//!
//! ```text
//! u(x, t) = sigma sqrt(3 / n) sum_i  a_i cos(k_i . y) + b_i sin(k_i . y),   y = x - U t    (3)
//! ```
//! `a` and `b` unit vectors at right angles to each other and to `k`: no wave has divergence. The wave
//! numbers are drawn from equation 2, one from each of `n` parts of equal energy; their directions
//! cover the sphere evenly. `y` is Taylor's hypothesis: the field does not change, it moves. A sum of
//! `n` waves has no waves longer than a few `L` beyond those drawn: over a few `L` one sees this one
//! field, whose mean need not be zero; the statistics above hold over space, or over seeds.
//!
//! **Low altitude** (sec. 3.7.3.4): at a height `h` in feet, from 10 to 1000,
//!
//! ```text
//! L_w = h       L_u = L_v = h / (0.177 + 0.000823 h)^1.2                           (4)
//! sigma_w = 0.1 W_20     sigma_u = sigma_v = sigma_w / (0.177 + 0.000823 h)^0.4    (5)
//! ```
//! No isotropic field has two scales: the horizontal components come from a field of scale `L_u`, the
//! vertical one from another of scale `L_w`, each with its spectrum, and their sum has divergence. If
//! the turbulence follows the height, fields are made for eight heights; in between the two nearest
//! are mixed by cosine and sine of the logarithm of the height, which keeps sigma exact.
//!
//! **Higher up** (sec. 3.7.2.1) the field is isotropic with L = 1750 ft = 533.4 m from 2000 ft on.

use super::mean::FOOT_M;
use glam::{DQuat, DVec3};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::schemars::JsonSchema;
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::{Length, Speed, math};
use simbeeotic_model::{BuildError, Site};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Turbulence: Dryden's, frozen, carried by the mean wind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(crate = "simbeeotic_model::serde", deny_unknown_fields)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub struct TurbulenceParams {
    /// How strong and how large it is.
    pub scale: TurbulenceScale,
    /// Number of waves, 16 to 4096. Each costs about 25 ns when the wind is asked for.
    #[serde(default = "modes")]
    pub modes: usize,
    /// The same field in every run: a seed of its own. Without it the run's seed decides.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seed: Option<u64>,
}

/// How strong and how large turbulence is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    crate = "simbeeotic_model::serde",
    rename_all = "snake_case",
    deny_unknown_fields
)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub enum TurbulenceScale {
    /// The low altitude model of MIL-F-8785C.
    LowAltitude {
        /// Mean wind speed at 20 ft, 6.096 m. Light turbulence: 15 knots (7.7 m/s), moderate: 30
        /// (15.4 m/s), severe: 45 (23.2 m/s).
        wind_at_20ft: Speed,
        /// The height whose turbulence there is everywhere, 3.048 m to 304.8 m. Without it turbulence
        /// follows the height.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        height: Option<Length>,
    },
    /// The same in all directions and at all heights.
    Isotropic {
        /// Standard deviation of each component.
        sigma: Speed,
        /// The scale; 533.4 m is the specification's above 2000 ft.
        #[serde(default = "aloft")]
        length: Length,
    },
}

fn modes() -> usize {
    128
}

fn aloft() -> Length {
    Length::si(1750.0 * FOOT_M)
}

/// Heights of the low altitude model, ft.
const LOW_FT: (f64, f64) = (10.0, 1_000.0);
/// Fields of a turbulence that follows the height.
const LAYERS: usize = 8;
/// Waves of one field.
const MODES: std::ops::RangeInclusive<usize> = 16..=4_096;

/// Scales (horizontal, vertical) in metres at a height in metres: equation 4.
pub(super) fn lengths_m(height_m: f64) -> (f64, f64) {
    let h = (height_m / FOOT_M).clamp(LOW_FT.0, LOW_FT.1);
    let across = h / math::pow(0.177 + 0.000_823 * h, 1.2);
    (across * FOOT_M, h * FOOT_M)
}

/// Intensities (horizontal, vertical) for a wind at 20 ft, at a height in metres: equation 5.
pub(super) fn sigmas(wind_at_20ft: f64, height_m: f64) -> (f64, f64) {
    let h = (height_m / FOOT_M).clamp(LOW_FT.0, LOW_FT.1);
    let up = 0.1 * wind_at_20ft;
    (up / math::pow(0.177 + 0.000_823 * h, 0.4), up)
}

/// A frozen field of turbulence.
#[derive(Debug)]
pub(super) enum Turbulence {
    Isotropic {
        field: Field,
        sigma: f64,
        per_length: f64,
    },
    Low {
        wind_at_20ft: f64,
        /// One if the height is fixed.
        layers: Vec<Layer>,
    },
}

/// The turbulence of one height.
#[derive(Debug)]
pub(super) struct Layer {
    level: Field,
    upright: Field,
    per_level: f64,
    per_upright: f64,
    height_m: f64,
}

impl Turbulence {
    pub(super) fn new(params: &TurbulenceParams, site: &Site<'_>) -> Result<Self, BuildError> {
        let wrong = |message: String| Err(BuildError::parameter("turbulence", message));
        let modes = params.modes;
        if !MODES.contains(&modes) {
            let (least, most) = (MODES.start(), MODES.end());
            return wrong(format!("has {modes} modes; possible are {least} to {most}"));
        }
        let seed = params.seed.unwrap_or(site.seed);
        let stream = |purpose: &str| Stream::new(seed, "weather/turbulence", purpose);
        match params.scale {
            TurbulenceScale::Isotropic { sigma, length } => {
                check_speed("sigma", sigma)?;
                if !(length > Length::ZERO && length.is_finite()) {
                    return wrong(format!("has a length of {length}; it is above 0 m"));
                }
                Ok(Self::Isotropic {
                    field: Field::new(stream("isotropic"), modes),
                    sigma: sigma.get(),
                    per_length: 1.0 / length.get(),
                })
            }
            TurbulenceScale::LowAltitude {
                wind_at_20ft,
                height,
            } => {
                check_speed("wind_at_20ft", wind_at_20ft)?;
                let (least, most) = (LOW_FT.0 * FOOT_M, LOW_FT.1 * FOOT_M);
                let heights: Vec<f64> = match height {
                    Some(h) if (least..=most).contains(&h.get()) => vec![h.get()],
                    Some(h) => {
                        return wrong(format!(
                            "has a height of {h}; the low altitude model reaches from {least} m to {most} m"
                        ));
                    }
                    None => {
                        let step =
                            |i: usize| math::pow(most / least, i as f64 / (LAYERS - 1) as f64);
                        (0..LAYERS).map(|i| least * step(i)).collect()
                    }
                };
                let layer = |(i, height_m): (usize, f64)| {
                    let (across, up) = lengths_m(height_m);
                    Layer {
                        level: Field::new(stream(&format!("level {i}")), modes),
                        upright: Field::new(stream(&format!("upright {i}")), modes),
                        per_level: 1.0 / across,
                        per_upright: 1.0 / up,
                        height_m,
                    }
                };
                Ok(Self::Low {
                    wind_at_20ft: wind_at_20ft.get(),
                    layers: heights.into_iter().enumerate().map(layer).collect(),
                })
            }
        }
    }

    /// The height that this turbulence is made for; 20 ft if it follows the height.
    pub(super) fn height_m(&self) -> Option<f64> {
        match self {
            Self::Isotropic { .. } => None,
            Self::Low { layers, .. } if layers.len() == 1 => Some(layers[0].height_m),
            Self::Low { .. } => Some(20.0 * FOOT_M),
        }
    }

    /// The turbulent velocity at a place that moves with the mean wind, `height_m` above ground.
    pub(super) fn at(&self, y: DVec3, height_m: f64) -> DVec3 {
        match self {
            Self::Isotropic {
                field,
                sigma,
                per_length,
            } => field.at(y * *per_length) * *sigma,
            Self::Low {
                wind_at_20ft,
                layers,
            } => {
                let [first, .., last] = &layers[..] else {
                    let Some(only) = layers.first() else {
                        return DVec3::ZERO;
                    };
                    let (level, up) = sigmas(*wind_at_20ft, only.height_m);
                    return only.at(y) * DVec3::new(level, level, up);
                };
                let (level, up) = sigmas(*wind_at_20ft, height_m);
                let h = height_m.clamp(first.height_m, last.height_m);
                let place = math::ln(h / first.height_m) / math::ln(last.height_m / first.height_m)
                    * (layers.len() - 1) as f64;
                let below = (place as usize).min(layers.len() - 2);
                let (sin, cos) = math::sin_cos(FRAC_PI_2 * (place - below as f64));
                let mixed = layers[below].at(y) * cos + layers[below + 1].at(y) * sin;
                mixed * DVec3::new(level, level, up)
            }
        }
    }
}

impl Layer {
    /// Of unit intensity in each component.
    fn at(&self, y: DVec3) -> DVec3 {
        let level = self.level.at(y * self.per_level);
        let up = self.upright.at(y * self.per_upright);
        DVec3::new(level.x, level.y, up.z)
    }
}

fn check_speed(what: &str, speed: Speed) -> Result<(), BuildError> {
    if speed >= Speed::ZERO && speed.get() <= 1_000.0 {
        Ok(())
    } else {
        let message = format!("has a {what} of {speed}; possible are 0 m/s to 1000 m/s");
        Err(BuildError::parameter("turbulence", message))
    }
}

/// A sum of helical waves: sigma 1, scale 1.
#[derive(Debug)]
pub(super) struct Field {
    waves: Vec<Wave>,
}

#[derive(Clone, Copy, Debug)]
struct Wave {
    k: DVec3,
    cos: DVec3,
    sin: DVec3,
}

impl Field {
    pub(super) fn new(mut rng: Stream, count: usize) -> Self {
        // A spiral that covers the sphere evenly, turned at random.
        let turn = DQuat::from_xyzw(rng.normal(), rng.normal(), rng.normal(), rng.normal());
        let turn = if turn.length() > 1e-9 {
            turn.normalize()
        } else {
            DQuat::IDENTITY
        };
        let golden = PI * (3.0 - 5.0_f64.sqrt());
        let mut order: Vec<usize> = (0..count).collect();
        rng.shuffle(&mut order);
        let amplitude = (3.0 / count as f64).sqrt();
        let wave = |(i, part): (usize, usize)| {
            let z = 1.0 - (2 * i + 1) as f64 / count as f64;
            let level = (1.0 - z * z).max(0.0).sqrt();
            let (s, c) = math::sin_cos(golden * i as f64);
            let direction = turn * DVec3::new(level * c, level * s, z);
            let size = wave_number((part as f64 + rng.uniform_open()) / count as f64);
            // Two unit vectors at right angles to k, at a random angle about it; either handed.
            let (e1, e2) = direction.any_orthonormal_pair();
            let (s, c) = math::sin_cos(TAU * rng.uniform());
            let hand = if rng.bernoulli(0.5) { 1.0 } else { -1.0 };
            Wave {
                k: direction * size,
                cos: (e1 * c + e2 * s) * amplitude,
                sin: (e2 * c - e1 * s) * (amplitude * hand),
            }
        };
        Self {
            waves: order.into_iter().enumerate().map(wave).collect(),
        }
    }

    pub(super) fn at(&self, y: DVec3) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for wave in &self.waves {
            let (sin, cos) = math::sin_cos(wave.k.dot(y));
            sum += wave.cos * cos + wave.sin * sin;
        }
        sum
    }
}

/// The wave number below which a share of the energy of equation 2 lies, times L.
///
/// With `k L = tan a` the integral is `(16 / 3 pi) (3a/8 - sin(2a)/4 + sin(4a)/32)`.
fn wave_number(share: f64) -> f64 {
    let below = |a: f64| {
        16.0 / (3.0 * PI) * (0.375 * a - 0.25 * math::sin(2.0 * a) + math::sin(4.0 * a) / 32.0)
    };
    let (mut low, mut high) = (0.0, FRAC_PI_2);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if below(middle) < share {
            low = middle;
        } else {
            high = middle;
        }
    }
    math::tan(0.5 * (low + high))
}

#[cfg(test)]
mod tests;
