//! Rain: steady, and in showers that come, move and go.
//!
//! A shower is a cell whose rate falls with the distance `d` from its centre,
//!
//! ```text
//! R(d) = R_m exp(-d / r0)                                                          (1)
//! ```
//! after C. Capsoni et al., *Data and theory for a new model of the horizontal structure of rain
//! cells*, Radio Science 22, 395 (1987). Rain is the same at all heights.

use glam::DVec3;
use simbeeotic_model::schemars::JsonSchema;
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::{Enu, Length, Position, RainRate, Time, Velocity, math};
use simbeeotic_model::{BuildError, params};

/// Rain.
#[params]
#[derive(Default)]
pub struct RainParams {
    /// What falls everywhere and always, 0 to 1000 mm/h.
    pub rate: RainRate,
    /// What falls here and there besides.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub shower: Vec<ShowerParams>,
}

/// A cell of rain.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(crate = "simbeeotic_model::serde", deny_unknown_fields)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub struct ShowerParams {
    /// Rate in its centre, 0 to 1000 mm/h.
    pub rate: RainRate,
    /// Where its centre is at the start of the run.
    #[serde(default)]
    pub center: Position,
    /// The distance in which the rate falls to 37 %, above 0.
    pub radius: Length,
    /// When it begins.
    #[serde(default)]
    pub start: Time,
    /// How long it rains. Without it: for ever.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration: Option<Time>,
    /// How long it takes to begin and to end: the rate grows and falls with the time.
    #[serde(default)]
    pub ramp: Time,
    /// Velocity of its centre; besides, the mean wind at 500 m carries it.
    #[serde(default)]
    pub velocity: Velocity<Enu>,
}

/// The height whose wind carries a shower, m.
const STEERING_M: f64 = 500.0;

/// A cell of rain, checked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shower {
    rate: f64,
    center: DVec3,
    velocity: DVec3,
    radius: f64,
    start: f64,
    end: f64,
    ramp: f64,
}

pub(super) fn showers(
    params: &RainParams,
    mean: impl Fn(f64) -> DVec3,
) -> Result<Vec<Shower>, BuildError> {
    check_rate(params.rate)?;
    params
        .shower
        .iter()
        .map(|shower| Shower::new(shower, &mean))
        .collect()
}

fn wrong<T>(message: String) -> Result<T, BuildError> {
    Err(BuildError::parameter("rain", message))
}

fn check_rate(rate: RainRate) -> Result<(), BuildError> {
    if (0.0..=1_000.0).contains(&rate.get()) {
        Ok(())
    } else {
        wrong(format!(
            "has a rate of {rate}; possible are 0 mm/h to 1000 mm/h"
        ))
    }
}

impl Shower {
    fn new(params: &ShowerParams, mean: impl Fn(f64) -> DVec3) -> Result<Self, BuildError> {
        check_rate(params.rate)?;
        if !(params.radius > Length::ZERO && params.radius.is_finite()) {
            return wrong(format!(
                "has a shower with a radius of {}; it is above 0 m",
                params.radius
            ));
        }
        if let Some(duration) = params.duration
            && !(duration >= Time::ZERO && duration.is_finite())
        {
            return wrong(format!(
                "has a shower with a duration of {duration}; it is 0 s or more"
            ));
        }
        if !(params.ramp >= Time::ZERO && params.ramp.is_finite() && params.start.is_finite()) {
            return wrong(
                "has a shower whose start or ramp is no time; a ramp is 0 s or more".into(),
            );
        }
        if !(params.center.is_finite() && params.velocity.is_finite()) {
            return wrong("has a shower whose place or velocity is not finite".into());
        }
        Ok(Self {
            rate: params.rate.get(),
            center: params.center.si(),
            velocity: params.velocity.si() + mean(STEERING_M),
            radius: params.radius.get(),
            start: params.start.get(),
            end: params
                .duration
                .map_or(f64::INFINITY, |duration| (params.start + duration).get()),
            ramp: params.ramp.get(),
        })
    }

    /// Rate at a place, mm/h.
    pub(super) fn at(&self, place: DVec3, t_s: f64) -> f64 {
        let left = (t_s - self.start).min(self.end - t_s);
        if left < 0.0 {
            return 0.0;
        }
        let share = if left < self.ramp {
            left / self.ramp
        } else {
            1.0
        };
        let away = place - (self.center + self.velocity * t_s);
        let d = (away.x * away.x + away.y * away.y).sqrt();
        self.rate * share * math::exp(-d / self.radius)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shower() -> ShowerParams {
        ShowerParams {
            rate: RainRate::si(40.0),
            center: Position::from_xyz(-100.0, 0.0, 0.0),
            radius: Length::si(50.0),
            start: Time::si(10.0),
            duration: Some(Time::si(60.0)),
            ramp: Time::si(4.0),
            velocity: Velocity::from_xyz(0.0, 1.0, 0.0),
        }
    }

    #[test]
    fn a_shower_comes_moves_and_goes() {
        let shower = Shower::new(&shower(), |_| DVec3::new(5.0, 0.0, 0.0)).expect("good numbers");
        let center = |t: f64| DVec3::new(-100.0 + 5.0 * t, t, 30.0);
        assert_eq!(shower.at(center(20.0), 20.0), 40.0);
        assert_eq!(shower.at(center(12.0), 12.0), 20.0);
        assert_eq!(shower.at(center(69.0), 69.0), 10.0);
        assert_eq!(shower.at(center(9.9), 9.9), 0.0);
        assert_eq!(shower.at(center(70.1), 70.1), 0.0);
        let beside = shower.at(center(20.0) + DVec3::new(30.0, 40.0, -20.0), 20.0);
        assert!((beside - 40.0 * math::exp(-1.0)).abs() < 1e-12);
    }

    #[test]
    fn nonsense_is_refused() {
        for bad in [
            ShowerParams {
                rate: RainRate::si(-1.0),
                ..shower()
            },
            ShowerParams {
                rate: RainRate::si(2e3),
                ..shower()
            },
            ShowerParams {
                radius: Length::ZERO,
                ..shower()
            },
            ShowerParams {
                duration: Some(Time::si(-1.0)),
                ..shower()
            },
            ShowerParams {
                ramp: Time::si(-1.0),
                ..shower()
            },
            ShowerParams {
                velocity: Velocity::from_xyz(f64::NAN, 0.0, 0.0),
                ..shower()
            },
        ] {
            let rain = RainParams {
                rate: RainRate::ZERO,
                shower: vec![bad],
            };
            assert!(showers(&rain, |_| DVec3::ZERO).is_err(), "{rain:?}");
        }
        let rain = RainParams {
            rate: RainRate::si(f64::NAN),
            shower: Vec::new(),
        };
        assert!(showers(&rain, |_| DVec3::ZERO).is_err());
    }
}
