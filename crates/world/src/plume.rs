//! Sources of smell or gas, and the plume that each leaves in the wind.
//!
//! Downwind of a source of the rate `Q` at the height `H`, in a mean wind `u` along `x`:
//!
//! ```text
//! C = Q P(x) / (2 pi u sy sz) exp(-y^2 / 2 sy^2) [exp(-(z - H)^2 / 2 sz^2) + exp(-(z + H)^2 / 2 sz^2)]   (1)
//! sy^2 = s0^2 + by(x)^2     sz^2 = s0^2 + bz(x)^2                                                  (2)
//! ```
//! the Gaussian plume with reflection at the ground (Hanna, Briggs and Hosker, *Handbook on Atmospheric
//! Diffusion*, DOE/TIC-11223, 1982, eq. 4.1); the flux through each plane `x` is `Q`. `by` and `bz` are
//! Briggs' formulas for open country (same, table 4.5; G. Briggs, ATDL Report 79, 1973):
//!
//! | stability | by | bz |
//! |---|---|---|
//! | A, hot sun, weak wind | .22 x (1 + .0001 x)^-1/2 | .20 x |
//! | B | .16 x (1 + .0001 x)^-1/2 | .12 x |
//! | C | .11 x (1 + .0001 x)^-1/2 | .08 x (1 + .0002 x)^-1/2 |
//! | D, neutral: clouds or wind | .08 x (1 + .0001 x)^-1/2 | .06 x (1 + .0015 x)^-1/2 |
//! | E | .06 x (1 + .0001 x)^-1/2 | .03 x (1 + .0003 x)^-1 |
//! | F, clear night, weak wind | .04 x (1 + .0001 x)^-1/2 | .016 x (1 + .0003 x)^-1 |
//!
//! They were fitted from 100 m to 10 km, to means over ten minutes or so; nearer they are straight
//! lines through the source, which is an extrapolation. The source is a Gaussian ball of the standard
//! deviation `s0`, its radius; `P(x)` is the share of the ball that the wind has passed, the normal
//! distribution function of `x / s0`: so the concentration is finite and smooth at the source.
//!
//! **Calm.** Below `u_c = 0.5 m/s` equation 1 with `u_c` is mixed, in the proportion of the wind, with what a
//! source leaves that grows evenly to all sides at the speed `w = by'(0) u_c`,
//!
//! ```text
//! C = Q / ((2 pi)^3/2 w s0^2) [F(b1) + F(b2)],   F(b) = D(b) / b,  b = r / (s0 sqrt 2)             (3)
//! ```
//! (`D` Dawson's integral, `r` the distances from the source and from its mirror image): the sum over
//! time of the puffs of [`crate::puff`] in air at rest. Far away it falls as `1 / r^2`.

use crate::puff::{Drift, Puffs};
use crate::weather::Weather;
use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::SimTime;
use simbeeotic_units::{Length, MassRate, Position, Time, math};
use std::f64::consts::{FRAC_1_SQRT_2, PI, TAU};

/// A source of smell or gas.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Source {
    /// What it gives off; sensors ask for it by this name.
    pub gas: String,
    /// Where it is, on the ground or above it.
    pub position: Position,
    /// How much it gives off, 0 or more.
    pub rate: MassRate,
    /// How large it is: the standard deviation of a Gaussian ball, above 0.
    pub radius: Length,
    /// When it begins.
    pub start: Time,
    /// When it ends. Without it: never.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<Time>,
    /// Stability of the air: Pasquill's class.
    pub stability: Stability,
    /// Whether its gas is followed in puffs that the wind carries; so wind that turns bends the plume.
    /// Without: the straight plume of the wind that blows at the source now.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub puffs: Option<Puffs>,
    /// What it is called; empty for nothing.
    pub label: String,
}

impl Default for Source {
    fn default() -> Self {
        Self {
            gas: "gas".to_owned(),
            position: Position::ZERO,
            rate: MassRate::from_milligrams_per_second(1.0),
            radius: Length::si(0.1),
            start: Time::ZERO,
            end: None,
            stability: Stability::D,
            puffs: None,
            label: String::new(),
        }
    }
}

/// Pasquill's classes of stability, from very unstable (A) over neutral (D) to stable (F).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Stability {
    /// Very unstable: hot sun, weak wind.
    A,
    /// Unstable.
    B,
    /// Slightly unstable.
    C,
    /// Neutral: clouds, or wind.
    #[default]
    D,
    /// Slightly stable.
    E,
    /// Stable: clear night, weak wind.
    F,
}

/// A wind weaker than this is no wind to a plume, m/s.
pub(crate) const CALM_M_S: f64 = 0.5;

/// Variances across and up, m^2, and how they grow with the way, m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spread {
    pub(crate) across: f64,
    pub(crate) up: f64,
    pub(crate) across_slope: f64,
    pub(crate) up_slope: f64,
}

impl Stability {
    /// Briggs' formulas as (slope, c, power): `slope x (1 + c x)^power`.
    fn briggs(self) -> [(f64, f64, f64); 2] {
        const ACROSS: f64 = 0.000_1;
        match self {
            Self::A => [(0.22, ACROSS, -0.5), (0.20, 0.0, 0.0)],
            Self::B => [(0.16, ACROSS, -0.5), (0.12, 0.0, 0.0)],
            Self::C => [(0.11, ACROSS, -0.5), (0.08, 0.000_2, -0.5)],
            Self::D => [(0.08, ACROSS, -0.5), (0.06, 0.001_5, -0.5)],
            Self::E => [(0.06, ACROSS, -0.5), (0.03, 0.000_3, -1.0)],
            Self::F => [(0.04, ACROSS, -0.5), (0.016, 0.000_3, -1.0)],
        }
    }

    /// Equation 2 after a way, which counts as none if it is below zero.
    pub(crate) fn spread(self, way_m: f64, radius_m: f64) -> Spread {
        let x = way_m.max(0.0);
        let [(ay, cy, py), (az, cz, pz)] = self.briggs();
        // b^2 = a^2 x^2 q^(2p), q = 1 + c x; its slope is 2 a^2 x q^(2p) (1 + p c x / q).
        let square = |a: f64, c: f64, p: f64| {
            let q = 1.0 + c * x;
            let fade = if p == -0.5 {
                1.0 / q
            } else if p == -1.0 {
                1.0 / (q * q)
            } else {
                1.0
            };
            let slope = 2.0 * a * a * x * fade * (1.0 + p * c * x / q);
            (a * a * x * x * fade, slope)
        };
        let ((across, across_slope), (up, up_slope)) = (square(ay, cy, py), square(az, cz, pz));
        let ball = radius_m * radius_m;
        Spread {
            across: ball + across,
            up: ball + up,
            across_slope,
            up_slope,
        }
    }

    /// How fast a cloud grows in a calm, m/s: `w` of equation 3.
    fn calm_growth(self) -> f64 {
        self.briggs()[0].0 * CALM_M_S
    }
}

impl Source {
    /// Concentration in kg/m^3, and its gradient per metre. `drift` has the puffs, if somebody keeps
    /// them.
    pub(crate) fn sample(
        &self,
        at: DVec3,
        time: SimTime,
        weather: &dyn Weather,
        drift: Option<&Drift>,
    ) -> (f64, DVec3) {
        match (&self.puffs, drift) {
            (None, _) => self.plume(at, time, weather),
            (Some(_), Some(drift)) => drift.sample(self, at, time),
            (Some(puffs), None) => {
                Drift::followed(self, puffs, time, weather).sample(self, at, time)
            }
        }
    }

    /// Whether it gives off gas at a time, s.
    pub(crate) fn gives_at(&self, t_s: f64) -> bool {
        t_s >= self.start.get() && self.end.is_none_or(|end| t_s < end.get())
    }

    /// Equations 1 and 3.
    fn plume(&self, at: DVec3, time: SimTime, weather: &dyn Weather) -> (f64, DVec3) {
        let t_s = time.as_secs_f64();
        let wind = weather.mean_wind(self.position, time).si();
        let (east, north) = (wind.x, wind.y);
        let speed = (east * east + north * north).sqrt();
        let windy = (speed / CALM_M_S).min(1.0);
        let mut sum = (0.0, DVec3::ZERO);
        if speed > 0.0 {
            let way = DVec3::new(east / speed, north / speed, 0.0);
            let (value, slope) = self.in_wind(at, t_s, way, speed.max(CALM_M_S));
            sum = (windy * value, slope * windy);
        }
        if windy < 1.0 && self.gives_at(t_s) {
            let (value, slope) = self.in_calm(at);
            sum.0 += (1.0 - windy) * value;
            sum.1 += slope * (1.0 - windy);
        }
        sum
    }

    /// Equation 1 and its gradient, in a wind along a unit vector.
    fn in_wind(&self, at: DVec3, t_s: f64, way: DVec3, speed: f64) -> (f64, DVec3) {
        let none = (0.0, DVec3::ZERO);
        let from = at - self.position.si();
        let side = DVec3::new(-way.y, way.x, 0.0);
        let (x, y) = (from.dot(way), from.dot(side));
        if !self.gives_at(t_s - x.max(0.0) / speed) {
            return none;
        }
        let radius = self.radius.get();
        let s = self.stability.spread(x, radius);
        let (d1, d2) = (from.z, at.z + self.position.si().z);
        let (e1, e2) = (
            math::exp(-0.5 * d1 * d1 / s.up),
            math::exp(-0.5 * d2 * d2 / s.up),
        );
        let passed = 0.5 * math::erfc(-FRAC_1_SQRT_2 * x / radius);
        let across = math::exp(-0.5 * y * y / s.across);
        let value = self.rate.get() * passed * across * (e1 + e2)
            / (TAU * speed * (s.across * s.up).sqrt());
        if !(value > 0.0 && e1 + e2 > 0.0 && passed > 0.0) {
            return none;
        }
        let density = math::exp(-0.5 * x * x / (radius * radius)) / (radius * TAU.sqrt());
        let squares = (d1 * d1 * e1 + d2 * d2 * e2) / (e1 + e2);
        let along = density / passed
            + 0.5 * s.across_slope / s.across * (y * y / s.across - 1.0)
            + 0.5 * s.up_slope / s.up * (squares / s.up - 1.0);
        let up = -(d1 * e1 + d2 * e2) / ((e1 + e2) * s.up);
        let slope = way * along - side * (y / s.across) + DVec3::Z * up;
        (value, slope * value)
    }

    /// Equation 3 and its gradient.
    fn in_calm(&self, at: DVec3) -> (f64, DVec3) {
        let radius = self.radius.get();
        let source = self.position.si();
        let image = DVec3::new(source.x, source.y, -source.z);
        let growth = self.stability.calm_growth();
        let full = self.rate.get() / (TAU * TAU.sqrt() * growth * radius * radius);
        let per = FRAC_1_SQRT_2 / radius;
        let part = |center: DVec3| {
            let r = at - center;
            let (value, slope) = dawson_over_b(r.length() * per);
            (value, r.normalize_or_zero() * (slope * per))
        };
        let (a, b) = (part(source), part(image));
        (full * (a.0 + b.0), (a.1 + b.1) * full)
    }

    /// What cannot be: key and reason.
    pub(crate) fn faults(&self) -> Vec<(&'static str, String)> {
        let mut faults = Vec::new();
        if self.gas.trim().is_empty() {
            faults.push(("gas", "a gas has a name".to_owned()));
        }
        let (rate, start) = (self.rate, self.start);
        if !(rate >= MassRate::ZERO && rate.is_finite()) {
            faults.push(("rate", format!("`rate` must be 0 kg/s or more, not {rate}")));
        }
        if self.position.up() < Length::ZERO {
            let up = self.position.up();
            faults.push((
                "position",
                format!("a source is not {} below the ground", up * -1.0),
            ));
        }
        if !start.is_finite() {
            faults.push(("start", format!("`start` must be a time, not {start}")));
        }
        if let Some(end) = self.end
            && !(end >= start && end.is_finite())
        {
            faults.push((
                "end",
                format!("`end` must not be before `start`, as {end} is"),
            ));
        }
        if let Some(puffs) = &self.puffs {
            faults.extend(puffs.faults());
        }
        faults
    }
}

/// `D(b) / b` of Dawson's integral, and its derivative; 1 and 0 at 0.
///
/// `D(b) = exp(-b^2) int_0^b exp(t^2) dt`, by G. Rybicki's sum (Computers in Physics 3(2), 85, 1989)
/// with a step of 0.2: exact to the last digits. `D' = 1 - 2 b D`.
fn dawson_over_b(b: f64) -> (f64, f64) {
    if b < 1e-3 {
        let b2 = b * b;
        return (
            1.0 - b2 * (2.0 / 3.0 - b2 * 4.0 / 15.0),
            b * (-4.0 / 3.0 + b2 * 16.0 / 15.0),
        );
    }
    const STEP: f64 = 0.2;
    let middle = 2.0 * (0.5 * b / STEP).round();
    let off = b - middle * STEP;
    let term = |n: i32| {
        let odd = f64::from(2 * n + 1);
        let gap = off - odd * STEP;
        math::exp(-gap * gap) / (odd + middle)
    };
    let dawson = (-18..18).map(term).sum::<f64>() / PI.sqrt();
    let value = dawson / b;
    (value, (1.0 - 2.0 * b * dawson - value) / b)
}

#[cfg(test)]
pub(crate) mod tests;
