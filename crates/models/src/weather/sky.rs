//! Daylight: steady, of a sun that stands still, or by the time of day.
//!
//! The sun stands at the elevation `h`, seen from the latitude `phi` at the hour angle `H` (15 degrees
//! for each hour after noon):
//!
//! ```text
//! delta = 23.45 deg sin(360 deg (284 + n) / 365)                                   (1)
//! sin h = sin phi sin delta + cos phi cos delta cos H                              (2)
//! E_n   = 127.5 klx (1 + 0.034 cos(360 deg (n - 2) / 365)) exp(-c / sin h)         (3)
//! E_sky = A + B (sin h)^C                                                          (4)
//! ```
//! `n` is the day of the year, `E_n` falls on a surface that faces the sun, `E_sky` on level ground
//! from all the sky. Level ground has `E_n sin h + E_sky`.
//!
//! | sky | c | A, klx | B, klx | C |
//! |---|---|---|---|---|
//! | clear | 0.21 | 0.8 | 15.5 | 0.5 |
//! | partly cloudy | 0.80 | 0.3 | 45.0 | 1 |
//! | cloudy | no sun | 0.3 | 21.0 | 1 |
//!
//! Equation 1 is P. Cooper's (Solar Energy 12, 333, 1969), 3 and 4 are the daylight availability of
//! the Illuminating Engineering Society (IES Lighting Handbook, 9th ed., 2000, ch. 8, after RP-21);
//! the handbook was not at hand, the constants are those quoted from it. Time is solar time: noon is
//! when the sun stands highest. Below the horizon equation 4's `A` fades by half for each 0.76 degrees
//! (3.4 lx at -6 degrees under a clear sky, the end of civil twilight). There is no moon.

use glam::DVec3;
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::schemars::JsonSchema;
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::{Angle, Heading, Illuminance, Time, math};
use simbeeotic_model::world::weather::Sun;
use simbeeotic_model::{BuildError, choice};
use std::f64::consts::TAU;

/// Daylight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    crate = "simbeeotic_model::serde",
    rename_all = "snake_case",
    deny_unknown_fields
)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub enum SkyParams {
    /// The same everywhere and always, from all sides: indoors, or under a thick fog.
    Steady {
        /// On level ground.
        illuminance: Illuminance,
    },
    /// A sun that stands still.
    Sun {
        /// Its height above the horizon, -90 to 90 degrees.
        elevation: Angle,
        /// Where it stands: clockwise from north.
        #[serde(default = "south")]
        azimuth: Heading,
        /// Clouds.
        #[serde(default)]
        cover: Cover,
        /// Day of the year, 1 to 366.
        #[serde(default = "summer")]
        day: u16,
    },
    /// A sun that follows its way through the day.
    Clock {
        /// Latitude, -90 to 90 degrees, north above zero.
        latitude: Angle,
        /// Day of the year, 1 to 366; 172 is the longest of the northern half.
        #[serde(default = "summer")]
        day: u16,
        /// Time of day when the run starts, since midnight, in solar time.
        #[serde(default = "noon")]
        start: Time,
        /// Clouds.
        #[serde(default)]
        cover: Cover,
    },
}

fn south() -> Heading {
    Heading::new(Angle::HALF_TURN)
}

fn summer() -> u16 {
    172
}

fn noon() -> Time {
    Time::from_hours(12.0)
}

/// How much of the sky is covered by clouds.
#[choice]
#[derive(Default)]
pub enum Cover {
    /// None of it.
    #[default]
    Clear,
    /// Half of it.
    PartlyCloudy,
    /// All of it.
    Cloudy,
}

impl Cover {
    /// c, A, B, C of the table; lx.
    fn constants(self) -> (Option<f64>, f64, f64, f64) {
        match self {
            Self::Clear => (Some(0.21), 800.0, 15_500.0, 0.5),
            Self::PartlyCloudy => (Some(0.80), 300.0, 45_000.0, 1.0),
            Self::Cloudy => (None, 300.0, 21_000.0, 1.0),
        }
    }
}

/// How fast twilight fades, for each radian below the horizon: from 800 lx to 3.4 lx in 6 degrees.
const TWILIGHT_PER_RAD: f64 = 52.14;

impl SkyParams {
    pub(super) fn check(&self) -> Result<(), BuildError> {
        let wrong = |message: String| Err(BuildError::parameter("sky", message));
        let day = match self {
            Self::Steady { illuminance } => {
                if *illuminance >= Illuminance::ZERO && illuminance.is_finite() {
                    return Ok(());
                }
                return wrong(format!("has {illuminance}; it is 0 lx or more"));
            }
            Self::Sun { elevation, day, .. } => {
                if !(-90.0..=90.0).contains(&elevation.degrees()) {
                    return wrong(format!(
                        "has an elevation of {} deg; it lies between -90 and 90 deg",
                        elevation.degrees()
                    ));
                }
                day
            }
            Self::Clock {
                latitude,
                day,
                start,
                ..
            } => {
                if !(-90.0..=90.0).contains(&latitude.degrees()) {
                    return wrong(format!(
                        "has a latitude of {} deg; it lies between -90 and 90 deg",
                        latitude.degrees()
                    ));
                }
                if !start.is_finite() {
                    return wrong("has a start that is not finite".into());
                }
                day
            }
        };
        if (1..=366).contains(day) {
            Ok(())
        } else {
            wrong(format!("has the day {day}; days are 1 to 366"))
        }
    }

    /// Light from the sky alone on level ground, and the sun.
    pub(super) fn light(&self, time: SimTime) -> (Illuminance, Option<Sun>) {
        let (toward, cover, day) = match self {
            Self::Steady { illuminance } => return (*illuminance, None),
            Self::Sun {
                elevation,
                azimuth,
                cover,
                day,
            } => {
                let (up, level) = elevation.sin_cos();
                let (east, north) = azimuth.angle().sin_cos();
                (DVec3::new(level * east, level * north, up), *cover, *day)
            }
            Self::Clock {
                latitude,
                day,
                start,
                cover,
            } => {
                let hours = (start.get() + time.as_secs_f64()) / 3_600.0;
                (toward(*latitude, *day, hours), *cover, *day)
            }
        };
        daylight(toward, cover, day)
    }
}

/// Where the sun stands, seen from a latitude at a solar time: east, north, up.
fn toward(latitude: Angle, day: u16, hours: f64) -> DVec3 {
    let season = TAU * (284.0 + f64::from(day)) / 365.0;
    let declination = Angle::from_degrees(23.45 * math::sin(season));
    let hour_angle = TAU / 24.0 * (hours - 12.0);
    let ((sd, cd), (sp, cp)) = (declination.sin_cos(), latitude.sin_cos());
    let (sh, ch) = math::sin_cos(hour_angle);
    DVec3::new(-cd * sh, cp * sd - sp * cd * ch, sp * sd + cp * cd * ch)
}

/// Equations 3 and 4.
fn daylight(toward: DVec3, cover: Cover, day: u16) -> (Illuminance, Option<Sun>) {
    let (extinction, a, b, c) = cover.constants();
    let up = toward.z;
    if up <= 0.0 {
        let below = math::asin(up.max(-1.0));
        return (
            Illuminance::si(a * math::exp(TWILIGHT_PER_RAD * below)),
            None,
        );
    }
    let sky = Illuminance::si(a + b * math::pow(up, c));
    let season = TAU * (f64::from(day) - 2.0) / 365.0;
    let sun = extinction.map(|per_mass| Sun {
        toward,
        illuminance: Illuminance::si(
            127_500.0 * (1.0 + 0.034 * math::cos(season)) * math::exp(-per_mass / up),
        ),
    });
    (sky, sun)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn degrees(angle: f64) -> Angle {
        Angle::from_degrees(angle)
    }

    #[test]
    fn the_sun_is_where_it_should_be() {
        // Noon at midsummer: 90 - latitude + 23.45 degrees, in the south.
        let noon = toward(degrees(50.0), 172, 12.0);
        assert!((math::asin(noon.z).to_degrees() - 63.45).abs() < 0.01);
        assert!(noon.x.abs() < 1e-12 && noon.y < 0.0);
        // In the morning it stands in the east, and it rises at 6 on the equator.
        let morning = toward(degrees(50.0), 81, 9.0);
        assert!(morning.x > 0.3 && morning.z > 0.0);
        assert!(toward(degrees(0.0), 81, 6.0).z.abs() < 1e-3);
        // At midnight under the ground; at the pole in summer all day at one height.
        assert!(toward(degrees(50.0), 172, 24.0).z < 0.0);
        let pole = |hours| toward(degrees(90.0), 172, hours).z;
        assert!((pole(3.0) - pole(15.0)).abs() < 1e-12 && pole(0.0) > 0.39);
        assert!((noon.length() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_light_is_that_of_the_tables() {
        let light = |elevation: f64, cover| {
            let sky = SkyParams::Sun {
                elevation: degrees(elevation),
                azimuth: Heading::EAST,
                cover,
                day: 93,
            };
            let (sky, sun) = sky.light(SimTime::ZERO);
            (sky.get(), sun.map(|sun| sun.illuminance.get()))
        };
        // Day 93: cos(2 pi 91 / 365) = 0.0043: 127.5 klx. exp(-0.21) = 0.810584, straight above.
        let (sky, sun) = light(90.0, Cover::Clear);
        assert!((sky - 16_300.0).abs() < 1e-6);
        assert!((sun.expect("it shines") / 127_518.7 - 0.810_584).abs() < 1e-5);
        let (sky, sun) = light(30.0, Cover::PartlyCloudy);
        assert!((sky - 22_800.0).abs() < 1e-6);
        assert!((sun.expect("it shines") / 127_518.7 - 0.201_897).abs() < 1e-5);
        assert_eq!(light(30.0, Cover::Cloudy).1, None);
        // Twilight goes on from the horizon, and ends.
        assert!((light(-1e-9, Cover::Clear).0 - 800.0).abs() < 1e-3);
        assert!(
            (light(-6.0, Cover::Clear).0 - 3.4).abs() < 0.05,
            "{}",
            light(-6.0, Cover::Clear).0
        );
        assert!(light(-40.0, Cover::Clear).0 < 1e-10);
    }

    #[test]
    fn the_day_goes_on_with_the_run() {
        let sky = SkyParams::Clock {
            latitude: degrees(0.0),
            day: 81,
            start: Time::from_hours(5.0),
            cover: Cover::Clear,
        };
        let (before, none) = sky.light(SimTime::ZERO);
        let (noon, sun) = sky.light(SimTime::from_secs(7 * 3_600));
        assert!(none.is_none() && before.get() < 1.0 && noon.get() > 16_000.0);
        assert!(sun.expect("noon").toward.z > 0.999);
    }

    #[test]
    fn nonsense_is_refused() {
        let clock = |latitude, day, start| SkyParams::Clock {
            latitude: degrees(latitude),
            day,
            start: Time::from_hours(start),
            cover: Cover::Clear,
        };
        for bad in [
            clock(91.0, 1, 0.0),
            clock(f64::NAN, 1, 0.0),
            clock(0.0, 0, 0.0),
            clock(0.0, 367, 0.0),
            clock(0.0, 1, f64::INFINITY),
            SkyParams::Steady {
                illuminance: Illuminance::si(-1.0),
            },
            SkyParams::Sun {
                elevation: degrees(100.0),
                azimuth: Heading::EAST,
                cover: Cover::Clear,
                day: 1,
            },
        ] {
            assert!(bad.check().is_err(), "{bad:?}");
        }
        assert!(clock(48.0, 366, 30.0).check().is_ok());
    }
}
