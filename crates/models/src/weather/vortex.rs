//! Vortices: Rankine's, Lamb and Oseen's, Burgers'.
//!
//! Around the axis, at a distance `r` from it, the air turns with
//!
//! ```text
//! Rankine       v = G r / (2 pi c^2)  for r < c,   G / (2 pi r)  beyond          (1)
//! Lamb-Oseen    v = G / (2 pi r) (1 - exp(-r^2 / c^2))                           (2)
//! Burgers       equation 2, and  v_r = -a r,  v_z = 2 a z                        (3)
//! ```
//! `G` is the circulation, `c` the radius of the core. Burgers' vortex is steady: the air that flows
//! in along the radius, at the strain rate `a`, holds together what viscosity spreads. Inflow and
//! outflow grow without end; here they are held at the values of `reach` beyond it.
//! Source: P. Saffman, *Vortex Dynamics*, 1992, sec. 13.1 to 13.3.

use glam::DVec3;
use simbeeotic_model::schemars::JsonSchema;
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::{Circulation, Enu, Length, Position, Speed, Velocity, math};
use simbeeotic_model::{BuildError, choice};
use std::f64::consts::TAU;

/// A vortex: air that turns about an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(crate = "simbeeotic_model::serde", deny_unknown_fields)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub struct VortexParams {
    /// How its speed falls with the distance.
    #[serde(default = "lamb_oseen")]
    pub kind: VortexKind,
    /// A point of its axis, at the start of the run.
    #[serde(default)]
    pub position: Position,
    /// Direction of its axis: east, north, up, of any length but 0.
    #[serde(default = "upright")]
    pub axis: [f64; 3],
    /// Circulation: counter-clockwise seen against the axis if above 0.
    pub circulation: Circulation,
    /// Radius of its core, above 0.
    pub core_radius: Length,
    /// Of Burgers' vortex: how fast air flows in at the radius of the core.
    #[serde(default)]
    pub inflow: Speed,
    /// Of Burgers' vortex: the distance from `position`, along the axis and away from it, beyond which
    /// inflow and outflow grow no more. Ten radii of the core unless said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reach: Option<Length>,
    /// Velocity of its axis.
    #[serde(default)]
    pub velocity: Velocity<Enu>,
    /// Whether the mean wind at `position` carries it, besides its own velocity.
    #[serde(default)]
    pub with_wind: bool,
}

fn lamb_oseen() -> VortexKind {
    VortexKind::LambOseen
}

fn upright() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

/// How the speed of a vortex falls with the distance from its axis.
#[choice]
#[derive(Default)]
pub enum VortexKind {
    /// A core that turns as one, and nothing but circulation outside.
    Rankine,
    /// The same, smoothly.
    #[default]
    LambOseen,
    /// The same, with air that flows in from the sides and out along the axis.
    Burgers,
}

/// A vortex, checked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vortex {
    kind: VortexKind,
    position: DVec3,
    axis: DVec3,
    per_turn: f64,
    core: f64,
    strain: f64,
    reach: f64,
    velocity: DVec3,
}

impl Vortex {
    pub(super) fn new(
        params: &VortexParams,
        mean: impl Fn(f64) -> DVec3,
    ) -> Result<Self, BuildError> {
        let wrong = |message: String| Err(BuildError::parameter("vortex", message));
        let axis = DVec3::from_array(params.axis);
        if !(axis.is_finite() && axis.length() > 0.0) {
            return wrong(format!(
                "has the axis {:?}, which has no direction",
                params.axis
            ));
        }
        let core = params.core_radius;
        if !(core > Length::ZERO && core.is_finite()) {
            return wrong(format!("has a core radius of {core}; it is above 0 m"));
        }
        let reach = params.reach.unwrap_or(core * 10.0);
        if !(reach > Length::ZERO && reach.is_finite()) {
            return wrong(format!("has a reach of {reach}; it is above 0 m"));
        }
        if !(params.inflow >= Speed::ZERO && params.inflow.is_finite()) {
            return wrong(format!(
                "has an inflow of {}; it is 0 m/s or more",
                params.inflow
            ));
        }
        if params.inflow > Speed::ZERO && params.kind != VortexKind::Burgers {
            return wrong("has an inflow, which only `burgers` has".into());
        }
        let numbers = [params.position.si(), params.velocity.si()];
        if !(params.circulation.is_finite() && numbers.iter().all(|v| v.is_finite())) {
            return wrong("has a number that is not finite".into());
        }
        let carried = if params.with_wind {
            mean(params.position.up().get())
        } else {
            DVec3::ZERO
        };
        Ok(Self {
            kind: params.kind,
            position: params.position.si(),
            axis: axis.normalize(),
            per_turn: params.circulation.get() / TAU,
            core: core.get(),
            strain: params.inflow.get() / core.get(),
            reach: reach.get(),
            velocity: params.velocity.si() + carried,
        })
    }

    pub(super) fn at(&self, place: DVec3, t_s: f64) -> DVec3 {
        let from = place - (self.position + self.velocity * t_s);
        let along = self.axis.dot(from);
        let radial = from - self.axis * along;
        let r2 = radial.length_squared();
        // Speed over radius: finite on the axis.
        let spin = match self.kind {
            VortexKind::Rankine => self.per_turn / r2.max(self.core * self.core),
            VortexKind::LambOseen | VortexKind::Burgers => {
                let x = r2 / (self.core * self.core);
                let share = if x > 1e-12 {
                    -math::exp_m1(-x) / x
                } else {
                    1.0
                };
                self.per_turn / (self.core * self.core) * share
            }
        };
        let round = self.axis.cross(radial) * spin;
        if self.strain == 0.0 {
            return round;
        }
        let far = (r2.sqrt() / self.reach).max(1.0);
        let inflow = radial * (-self.strain / far);
        let outflow = self.axis * (2.0 * self.strain * along.clamp(-self.reach, self.reach));
        round + inflow + outflow
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn params(kind: VortexKind) -> VortexParams {
        VortexParams {
            kind,
            position: Position::from_xyz(1.0, 2.0, 0.0),
            axis: [0.0, 0.0, 2.0],
            circulation: Circulation::si(10.0),
            core_radius: Length::si(0.5),
            inflow: Speed::ZERO,
            reach: None,
            velocity: Velocity::ZERO,
            with_wind: false,
        }
    }

    fn still(params: &VortexParams) -> Vortex {
        Vortex::new(params, |_| DVec3::ZERO).expect("good numbers")
    }

    /// Speed at a distance east of the axis; it blows north there.
    fn speed(vortex: &Vortex, r: f64) -> f64 {
        let v = vortex.at(DVec3::new(1.0 + r, 2.0, 7.0), 0.0);
        assert!(v.x.abs() < 1e-12 && v.z.abs() < 1e-12, "{v}");
        v.y
    }

    #[test]
    fn rankine_turns_as_one_inside_and_falls_as_one_over_r_outside() {
        let vortex = still(&params(VortexKind::Rankine));
        let edge = 10.0 / (TAU * 0.5);
        assert!((speed(&vortex, 0.25) - 0.5 * edge).abs() < 1e-12);
        assert!((speed(&vortex, 0.5) - edge).abs() < 1e-12);
        assert!((speed(&vortex, 5.0) - 0.1 * edge).abs() < 1e-12);
        assert_eq!(speed(&vortex, 0.0), 0.0);
    }

    /// The greatest speed is 0.638173 G / (2 pi c), at 1.120906 c.
    #[test]
    fn lamb_and_oseens_is_fastest_where_the_textbook_says() {
        let vortex = still(&params(VortexKind::LambOseen));
        let unit = 10.0 / (TAU * 0.5);
        let peak = speed(&vortex, 0.5 * 1.120_906);
        assert!((peak / unit - 0.638_173).abs() < 1e-5, "{}", peak / unit);
        assert!(speed(&vortex, 0.5 * 1.11) < peak && speed(&vortex, 0.5 * 1.13) < peak);
        assert!((speed(&vortex, 50.0) * TAU * 50.0 - 10.0).abs() < 1e-9);
        assert!(speed(&vortex, 1e-9).abs() < 1e-6);
    }

    #[test]
    fn burgers_draws_air_in_and_sends_it_out_without_divergence() {
        let vortex = still(&VortexParams {
            inflow: Speed::si(0.2),
            ..params(VortexKind::Burgers)
        });
        let at = |x: f64, y: f64, z: f64| vortex.at(DVec3::new(1.0 + x, 2.0 + y, z), 0.0);
        assert!((at(0.5, 0.0, 0.0).x + 0.2).abs() < 1e-12);
        assert!((at(0.0, 0.0, 1.0).z - 0.8).abs() < 1e-12);
        let h = 1e-5;
        let divergence = (at(0.7 + h, 0.3, 0.4).x - at(0.7 - h, 0.3, 0.4).x
            + at(0.7, 0.3 + h, 0.4).y
            - at(0.7, 0.3 - h, 0.4).y
            + at(0.7, 0.3, 0.4 + h).z
            - at(0.7, 0.3, 0.4 - h).z)
            / (2.0 * h);
        assert!(divergence.abs() < 1e-8, "{divergence}");
        // Held beyond ten radii.
        assert!(
            (at(1e6, 0.0, 0.0).x + 2.0).abs() < 1e-9 && (at(0.0, 0.0, 1e6).z - 4.0).abs() < 1e-9
        );
    }

    #[test]
    fn the_circulation_around_any_axis_is_the_one_it_says_and_it_moves() {
        let moving = VortexParams {
            axis: [1.0, 1.0, 0.0],
            velocity: Velocity::from_xyz(0.0, 0.0, 3.0),
            with_wind: true,
            ..params(VortexKind::LambOseen)
        };
        let vortex = Vortex::new(&moving, |_| DVec3::new(2.0, 0.0, 0.0)).expect("good numbers");
        let center = DVec3::new(1.0, 2.0, 0.0) + DVec3::new(2.0, 0.0, 3.0) * 4.0;
        let axis = DVec3::new(1.0, 1.0, 0.0).normalize();
        let (e1, e2) = (DVec3::new(1.0, -1.0, 0.0).normalize(), DVec3::Z);
        assert!((e1.cross(e2).dot(axis).abs() - 1.0).abs() < 1e-12);
        let hand = e1.cross(e2).dot(axis);
        let steps = 1_000;
        let sum: f64 = (0..steps)
            .map(|i| {
                let (s, c) = math::sin_cos(TAU * f64::from(i) / f64::from(steps));
                let v = vortex.at(center + (e1 * c + e2 * s) * 20.0, 4.0);
                v.dot(e2 * c - e1 * s) * TAU * 20.0 / f64::from(steps)
            })
            .sum();
        assert!((sum * hand - 10.0).abs() < 1e-9, "{sum}");
    }

    #[test]
    fn nonsense_is_refused() {
        let good = params(VortexKind::LambOseen);
        for bad in [
            VortexParams {
                axis: [0.0; 3],
                ..good.clone()
            },
            VortexParams {
                axis: [f64::NAN, 0.0, 1.0],
                ..good.clone()
            },
            VortexParams {
                core_radius: Length::ZERO,
                ..good.clone()
            },
            VortexParams {
                circulation: Circulation::si(f64::NAN),
                ..good.clone()
            },
            VortexParams {
                inflow: Speed::si(1.0),
                ..good.clone()
            },
            VortexParams {
                reach: Some(Length::si(-1.0)),
                ..good.clone()
            },
        ] {
            assert!(Vortex::new(&bad, |_| DVec3::ZERO).is_err(), "{bad:?}");
        }
    }
}
