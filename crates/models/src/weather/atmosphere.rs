//! The whole atmosphere: terms that add up, each optional.

use super::air::AirParams;
use super::dryden::{Turbulence, TurbulenceParams};
use super::grid::{Grid, GridParams};
use super::gust::{Gust, GustParams};
use super::mean::{MeanWind, Profile};
use super::showers::{RainParams, Shower, showers};
use super::sky::SkyParams;
use super::vortex::{Vortex, VortexParams};
use glam::DVec3;
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::units::{
    Density, Enu, Heading, Illuminance, Position, Pressure, RainRate, Speed, Temperature, Velocity,
};
use simbeeotic_model::world::Weather;
use simbeeotic_model::world::weather::{Sun, isa};
use simbeeotic_model::{BuildError, FromParams, Site, params, weather};

/// Wind, air, light and rain. The wind is the sum of what is given: mean wind, turbulence, gusts,
/// vortices, a recorded wind.
#[weather("atmosphere")]
#[derive(Debug)]
pub struct Atmosphere {
    mean: MeanWind,
    turbulence: Option<Turbulence>,
    /// Velocity of the frozen turbulence.
    carried: DVec3,
    gusts: Vec<Gust>,
    vortices: Vec<Vortex>,
    grid: Option<Grid>,
    air: AirParams,
    sky: Option<SkyParams>,
    rain_mm_h: f64,
    showers: Vec<Shower>,
}

/// Parameters of [`Atmosphere`].
#[params]
#[derive(Default)]
pub struct AtmosphereParams {
    /// Mean wind as a velocity: east, north, up. Either this, or `speed` and `from`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wind: Option<Velocity<Enu>>,
    /// Speed of the mean wind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<Speed>,
    /// Where the mean wind comes from: 270 deg is a west wind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<Heading>,
    /// How the mean wind grows with height.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// Turbulence, carried by the mean wind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turbulence: Option<TurbulenceParams>,
    /// Gusts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub gust: Vec<GustParams>,
    /// Vortices.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub vortex: Vec<VortexParams>,
    /// A recorded wind.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub grid: Option<GridParams>,
    /// Temperature, pressure and humidity.
    pub air: AirParams,
    /// Daylight; dark without.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sky: Option<SkyParams>,
    /// Rain.
    pub rain: RainParams,
}

impl FromParams for Atmosphere {
    type Params = AtmosphereParams;

    fn from_params(params: AtmosphereParams) -> Result<Self, BuildError> {
        Self::for_run(params, &Site::default())
    }

    fn for_run(params: AtmosphereParams, site: &Site<'_>) -> Result<Self, BuildError> {
        let wind = mean_wind(&params)?;
        let mean = MeanWind::new(wind, params.profile.as_ref())?;
        let at = |height_m: f64| mean.at(height_m);
        let turbulence = params.turbulence.as_ref().map(|t| Turbulence::new(t, site));
        let turbulence = turbulence.transpose()?;
        params.air.check()?;
        if let Some(sky) = &params.sky {
            sky.check()?;
        }
        Ok(Self {
            carried: match turbulence.as_ref().and_then(Turbulence::height_m) {
                Some(height_m) => mean.at(height_m),
                None => mean.reference(),
            },
            turbulence,
            gusts: params
                .gust
                .iter()
                .map(|g| Gust::new(g, at))
                .collect::<Result<_, _>>()?,
            vortices: params
                .vortex
                .iter()
                .map(|v| Vortex::new(v, at))
                .collect::<Result<_, _>>()?,
            grid: params
                .grid
                .as_ref()
                .map(|g| Grid::new(g, site))
                .transpose()?,
            air: params.air,
            sky: params.sky,
            rain_mm_h: params.rain.rate.get(),
            showers: showers(&params.rain, at)?,
            mean,
        })
    }
}

fn mean_wind(params: &AtmosphereParams) -> Result<Velocity<Enu>, BuildError> {
    match (params.wind, params.speed, params.from) {
        (Some(wind), None, None) if wind.is_finite() => Ok(wind),
        (Some(wind), None, None) => Err(BuildError::parameter(
            "wind",
            format!("must be finite, and is {wind}"),
        )),
        (Some(_), _, _) => Err(BuildError::parameter(
            "wind",
            "and `speed` with `from` say the same; leave one out",
        )),
        (None, Some(speed), Some(from)) if speed >= Speed::ZERO && speed.is_finite() => {
            Ok(from.along(speed) * -1.0)
        }
        (None, Some(speed), Some(_)) => Err(BuildError::parameter(
            "speed",
            format!("must be zero or more, and is {speed}"),
        )),
        (None, Some(_), None) => Err(BuildError::parameter(
            "speed",
            "needs `from`, where the wind comes from: from = \"270 deg\"",
        )),
        (None, None, Some(_)) => Err(BuildError::parameter(
            "from",
            "needs `speed`: speed = \"3 m/s\"",
        )),
        (None, None, None) => Ok(Velocity::ZERO),
    }
}

impl Weather for Atmosphere {
    fn wind(&self, at: Position, time: SimTime) -> Velocity<Enu> {
        let (place, t_s) = (at.si(), time.as_secs_f64());
        let mut wind = self.mean.at(place.z);
        if let Some(turbulence) = &self.turbulence {
            wind += turbulence.at(place - self.carried * t_s, place.z);
        }
        for gust in &self.gusts {
            wind += gust.at(place, t_s);
        }
        for vortex in &self.vortices {
            wind += vortex.at(place, t_s);
        }
        if let Some(grid) = &self.grid {
            wind += grid.at(place, t_s);
        }
        Velocity::from_si(wind)
    }

    fn mean_wind(&self, at: Position, time: SimTime) -> Velocity<Enu> {
        let mut wind = self.mean.at(at.si().z);
        if let Some(grid) = &self.grid {
            wind += grid.at(at.si(), time.as_secs_f64());
        }
        Velocity::from_si(wind)
    }

    fn is_calm(&self) -> bool {
        let moved = !self.gusts.is_empty() || !self.vortices.is_empty() || self.grid.is_some();
        !moved && self.turbulence.is_none() && self.mean.reference() == DVec3::ZERO
    }

    fn temperature(&self, at: Position, _time: SimTime) -> Temperature {
        self.air.at(at.up()).0
    }

    fn pressure(&self, at: Position, _time: SimTime) -> Pressure {
        self.air.at(at.up()).1
    }

    fn density(&self, at: Position, _time: SimTime) -> Density {
        let (temperature, pressure) = self.air.at(at.up());
        isa::damp_density(temperature, pressure, self.air.humidity)
    }

    fn humidity(&self, _at: Position, _time: SimTime) -> f64 {
        self.air.humidity
    }

    fn light(&self, _at: Position, time: SimTime) -> Illuminance {
        let Some(sky) = &self.sky else {
            return Illuminance::ZERO;
        };
        match sky.light(time) {
            (diffuse, Some(sun)) => diffuse + sun.illuminance * sun.toward.z.max(0.0),
            (diffuse, None) => diffuse,
        }
    }

    fn sun(&self, _at: Position, time: SimTime) -> Option<Sun> {
        self.sky.as_ref().and_then(|sky| sky.light(time).1)
    }

    fn rain(&self, at: Position, time: SimTime) -> RainRate {
        let (place, t_s) = (at.si(), time.as_secs_f64());
        let mut rate = self.rain_mm_h;
        for shower in &self.showers {
            rate += shower.at(place, t_s);
        }
        RainRate::si(rate)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::weather::dryden::TurbulenceScale;
    use crate::weather::vortex::VortexKind;
    use simbeeotic_model::units::{Angle, Circulation, Length, Time};

    fn made(params: AtmosphereParams) -> Atmosphere {
        Atmosphere::from_params(params).expect("good numbers")
    }

    fn turbulence() -> TurbulenceParams {
        TurbulenceParams {
            scale: TurbulenceScale::Isotropic {
                sigma: Speed::si(1.0),
                length: Length::si(8.0),
            },
            modes: 64,
            seed: None,
        }
    }

    fn vortex() -> VortexParams {
        VortexParams {
            kind: VortexKind::Rankine,
            position: Position::ZERO,
            axis: [0.0, 0.0, 1.0],
            circulation: Circulation::si(6.0),
            core_radius: Length::si(1.0),
            inflow: Speed::ZERO,
            reach: None,
            velocity: Velocity::ZERO,
            with_wind: false,
        }
    }

    fn gust() -> GustParams {
        GustParams {
            amplitude: Velocity::from_xyz(1.0, 2.0, 3.0),
            length: Length::si(10.0),
            plateau: None,
            start: Time::ZERO,
            at: Position::ZERO,
            travel: Some(Velocity::from_xyz(2.0, 0.0, 0.0)),
        }
    }

    #[test]
    fn the_terms_add_up() {
        let wind = Some(Velocity::from_xyz(3.0, 1.0, 0.0));
        let all = made(AtmosphereParams {
            wind,
            turbulence: Some(turbulence()),
            gust: vec![gust(), gust()],
            vortex: vec![vortex(), vortex()],
            ..AtmosphereParams::default()
        });
        let single = [
            made(AtmosphereParams {
                wind,
                turbulence: Some(turbulence()),
                ..Default::default()
            }),
            made(AtmosphereParams {
                gust: vec![gust(), gust()],
                ..Default::default()
            }),
            made(AtmosphereParams {
                vortex: vec![vortex(), vortex()],
                ..Default::default()
            }),
        ];
        let (at, time) = (
            Position::from_xyz(2.0, -3.0, 5.0),
            SimTime::from_millis(4_300),
        );
        let sum: DVec3 = single.iter().map(|part| part.wind(at, time).si()).sum();
        assert!((all.wind(at, time).si() - sum).length() < 1e-12);
        assert_eq!(all.mean_wind(at, time), Velocity::from_xyz(3.0, 1.0, 0.0));
        let none = made(AtmosphereParams::default());
        assert_eq!(none.wind(at, time), Velocity::ZERO);
        assert!(none.is_calm());
        assert!(single.iter().all(|part| !part.is_calm()));
        assert_eq!(
            (none.light(at, time), none.rain(at, time)),
            (Illuminance::ZERO, RainRate::ZERO)
        );
    }

    #[test]
    fn a_west_wind_blows_east() {
        let west = made(AtmosphereParams {
            speed: Some(Speed::si(4.0)),
            from: Some(Heading::new(Angle::from_degrees(270.0))),
            ..AtmosphereParams::default()
        });
        let wind = west.wind(Position::ZERO, SimTime::ZERO).si();
        assert!(
            (wind - DVec3::new(4.0, 0.0, 0.0)).length() < 1e-12,
            "{wind}"
        );
    }

    /// Taylor's hypothesis, exact where the numbers are: what is here now is downwind later.
    #[test]
    fn turbulence_moves_with_the_mean_wind_unchanged() {
        let weather = made(AtmosphereParams {
            wind: Some(Velocity::from_xyz(4.0, -2.0, 0.0)),
            turbulence: Some(turbulence()),
            ..AtmosphereParams::default()
        });
        for (x, y, z, seconds) in [
            (0.0, 0.0, 3.0, 1),
            (16.0, -8.0, 1.5, 32),
            (-7.0, 3.25, 60.0, 1024),
        ] {
            let now = weather.wind(Position::from_xyz(x, y, z), SimTime::from_secs(5));
            let s = f64::from(seconds);
            let later = Position::from_xyz(x + 4.0 * s, y - 2.0 * s, z);
            let then = weather.wind(later, SimTime::from_secs(5 + seconds as u64));
            assert_eq!(now, then);
        }
    }

    #[test]
    fn density_falls_with_height_heat_and_humidity() {
        let air = |celsius: f64, humidity: f64, elevation: f64| {
            made(AtmosphereParams {
                air: AirParams {
                    temperature: Temperature::from_celsius(celsius),
                    humidity,
                    elevation: Length::si(elevation),
                    ..AirParams::default()
                },
                ..AtmosphereParams::default()
            })
        };
        let density = |w: &Atmosphere, z: f64| {
            w.density(Position::from_xyz(0.0, 0.0, z), SimTime::ZERO)
                .get()
        };
        let standard = air(15.0, 0.0, 0.0);
        assert!((density(&standard, 0.0) - 1.225).abs() < 1e-4);
        assert!((density(&standard, 1_000.0) - 1.111_64).abs() < 1e-4);
        assert_eq!(
            density(&air(15.0, 0.0, 400.0), 600.0),
            density(&standard, 1_000.0)
        );
        assert!((density(&air(35.0, 0.0, 0.0), 0.0) - 1.145_5).abs() < 1e-3);
        assert!(density(&air(35.0, 0.9, 0.0), 0.0) < 1.13);
    }

    #[test]
    fn nonsense_is_refused_with_its_key() {
        let refused = |params: AtmosphereParams| {
            let error = Atmosphere::from_params(params).expect_err("it is refused");
            error.to_string()
        };
        let plain = AtmosphereParams::default;
        let north = Some(Heading::NORTH);
        let speed = |v: f64| Some(Speed::si(v));
        let both = AtmosphereParams {
            wind: Some(Velocity::ZERO),
            speed: speed(1.0),
            from: north,
            ..plain()
        };
        assert!(refused(both).contains("leave one out"));
        assert!(
            refused(AtmosphereParams {
                speed: speed(1.0),
                ..plain()
            })
            .contains("needs `from`")
        );
        assert!(
            refused(AtmosphereParams {
                from: north,
                ..plain()
            })
            .contains("needs `speed`")
        );
        let negative = AtmosphereParams {
            speed: speed(-1.0),
            from: north,
            ..plain()
        };
        assert!(refused(negative).contains("`speed` must be zero or more"));
        let wind = Some(Velocity::from_xyz(f64::NAN, 0.0, 0.0));
        assert!(refused(AtmosphereParams { wind, ..plain() }).contains("`wind`"));
        for air in [
            AirParams {
                temperature: Temperature::si(0.0),
                ..AirParams::default()
            },
            AirParams {
                pressure: Pressure::si(1.0),
                ..AirParams::default()
            },
            AirParams {
                humidity: 1.1,
                ..AirParams::default()
            },
            AirParams {
                elevation: Length::si(1e5),
                ..AirParams::default()
            },
        ] {
            assert!(refused(AtmosphereParams { air, ..plain() }).contains("`air` is no air"));
        }
        // A gust without wind to carry it.
        let still = GustParams {
            travel: None,
            ..gust()
        };
        assert!(
            refused(AtmosphereParams {
                gust: vec![still],
                ..plain()
            })
            .contains("`gust`")
        );
    }
}
