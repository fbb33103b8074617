//! Discrete gusts: one minus cosine.
//!
//! ```text
//! V(s) = 0                                 s < 0
//!      = V_m / 2 (1 - cos(pi s / d_m))     0 <= s <= d_m                       (1)
//!      = V_m                               s > d_m
//! ```
//! by MIL-F-8785C (1980), sec. 3.7.1.3; `s` is how far the gust's front has gone beyond a place. The
//! front is a plane at right angles to its way. With a plateau the gust falls again, by the same law:
//! a plateau of zero is the pulse of the airworthiness codes (CS 25.341) of length `2 d_m`.

use glam::DVec3;
use simbeeotic_model::BuildError;
use simbeeotic_model::schemars::JsonSchema;
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::{Enu, Length, Position, Time, Velocity, math};
use std::f64::consts::PI;

/// A gust: air that becomes faster along a way, and stays so or becomes slower again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(crate = "simbeeotic_model::serde", deny_unknown_fields)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub struct GustParams {
    /// What it adds to the wind where it is strongest: east, north, up.
    pub amplitude: Velocity<Enu>,
    /// The way over which it grows, `d_m`, above 0.
    pub length: Length,
    /// How far it goes on at full strength before it falls again. Without it: for ever, as in the
    /// specification.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub plateau: Option<Length>,
    /// When its front passes the place `at`.
    #[serde(default)]
    pub start: Time,
    /// A place that the front passes at `start`.
    #[serde(default)]
    pub at: Position,
    /// Velocity of the front. Without it: that of the mean wind at `at`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub travel: Option<Velocity<Enu>>,
}

/// A gust, checked.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gust {
    amplitude: DVec3,
    length: f64,
    plateau: f64,
    start: f64,
    at: DVec3,
    way: DVec3,
    speed: f64,
}

impl Gust {
    /// `mean` gives the mean wind at a height.
    pub(super) fn new(
        params: &GustParams,
        mean: impl Fn(f64) -> DVec3,
    ) -> Result<Self, BuildError> {
        let wrong = |message: String| Err(BuildError::parameter("gust", message));
        if !params.amplitude.is_finite() {
            return wrong("has an amplitude that is not finite".into());
        }
        if !(params.length > Length::ZERO && params.length.is_finite()) {
            return wrong(format!(
                "has a length of {}; it is above 0 m",
                params.length
            ));
        }
        if let Some(plateau) = params.plateau
            && !(plateau >= Length::ZERO && plateau.is_finite())
        {
            return wrong(format!("has a plateau of {plateau}; it is 0 m or more"));
        }
        if !(params.start.is_finite() && params.at.is_finite()) {
            return wrong("has a start or a place that is not finite".into());
        }
        let travel = match params.travel {
            Some(travel) => travel.si(),
            None => mean(params.at.up().get()),
        };
        let speed = travel.length();
        if !(speed > 0.0 && speed.is_finite()) {
            return wrong(
                "does not move: there is no mean wind at its place, and it has no `travel`, for example travel = [\"5 m/s\", \"0 m/s\", \"0 m/s\"]".into(),
            );
        }
        Ok(Self {
            amplitude: params.amplitude.si(),
            length: params.length.get(),
            plateau: params.plateau.map_or(f64::INFINITY, Length::get),
            start: params.start.get(),
            at: params.at.si(),
            way: travel / speed,
            speed,
        })
    }

    pub(super) fn at(&self, place: DVec3, t_s: f64) -> DVec3 {
        let gone = self.speed * (t_s - self.start) - self.way.dot(place - self.at);
        self.amplitude * self.shape(gone)
    }

    /// Equation 1, and its mirror image after the plateau; 0 to 1.
    fn shape(&self, s: f64) -> f64 {
        let rise = |s: f64| 0.5 * (1.0 - math::cos(PI * (s / self.length).clamp(0.0, 1.0)));
        if s <= self.length + self.plateau {
            rise(s)
        } else {
            rise(2.0 * self.length + self.plateau - s)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn params() -> GustParams {
        GustParams {
            amplitude: Velocity::from_xyz(0.0, 0.0, 4.0),
            length: Length::si(20.0),
            plateau: None,
            start: Time::si(3.0),
            at: Position::from_xyz(100.0, 0.0, 0.0),
            travel: Some(Velocity::from_xyz(5.0, 0.0, 0.0)),
        }
    }

    fn up(gust: &Gust, x: f64, t: f64) -> f64 {
        let v = gust.at(DVec3::new(x, 7.0, 9.0), t);
        assert_eq!((v.x, v.y), (0.0, 0.0));
        v.z
    }

    #[test]
    fn it_grows_as_one_minus_cosine_and_moves_on() {
        let gust = Gust::new(&params(), |_| DVec3::ZERO).expect("good numbers");
        assert_eq!(up(&gust, 100.0, 3.0), 0.0);
        // 10 m beyond: half. 5 m: (1 - cos 45 deg) / 2. The front needs 2 s for 10 m.
        assert!((up(&gust, 90.0, 3.0) - 2.0).abs() < 1e-12);
        assert!((up(&gust, 100.0, 5.0) - 2.0).abs() < 1e-12);
        assert!((up(&gust, 95.0, 3.0) - 2.0 * (1.0 - 0.5_f64.sqrt())).abs() < 1e-12);
        assert_eq!(up(&gust, 0.0, 3.0), 4.0);
        assert_eq!(up(&gust, 101.0, 3.0), 0.0);
        assert_eq!(up(&gust, 1e6, 1e9), 4.0);
    }

    #[test]
    fn with_a_plateau_it_falls_again() {
        let pulse = GustParams {
            plateau: Some(Length::si(10.0)),
            ..params()
        };
        let gust = Gust::new(&pulse, |_| DVec3::ZERO).expect("good numbers");
        for (gone, wanted) in [
            (10.0, 2.0),
            (20.0, 4.0),
            (30.0, 4.0),
            (40.0, 2.0),
            (50.0, 0.0),
            (60.0, 0.0),
        ] {
            let found = up(&gust, 100.0 - gone, 3.0);
            assert!((found - wanted).abs() < 1e-12, "{gone}: {found}");
        }
    }

    #[test]
    fn the_mean_wind_carries_it_and_without_one_it_is_refused() {
        let carried = GustParams {
            travel: None,
            ..params()
        };
        let gust = Gust::new(&carried, |_| DVec3::new(0.0, 2.0, 0.0)).expect("good numbers");
        let north = gust.at(DVec3::new(100.0, 10.0, 0.0), 13.0);
        assert!((north.z - 2.0).abs() < 1e-12, "{north}");
        assert!(Gust::new(&carried, |_| DVec3::ZERO).is_err());
        for bad in [
            GustParams {
                length: Length::ZERO,
                ..params()
            },
            GustParams {
                plateau: Some(Length::si(-1.0)),
                ..params()
            },
            GustParams {
                start: Time::si(f64::NAN),
                ..params()
            },
            GustParams {
                amplitude: Velocity::from_xyz(f64::INFINITY, 0.0, 0.0),
                ..params()
            },
        ] {
            assert!(Gust::new(&bad, |_| DVec3::ZERO).is_err(), "{bad:?}");
        }
    }
}
