//! A light sensor.

use super::bounds::{at_least_zero, positive, step};
use super::noise::{Channel, Errors};
use simbeeotic_model::check::in_range;
use simbeeotic_model::host::Ray;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{Current, Illuminance, Length};
use simbeeotic_model::{BuildError, SeesWhat, Sensor, Truth, choice, params, sensor};

/// Measures the light that falls on it: of lamps, of the sun, of the sky, from the ground.
///
/// ```text
/// E = sum E_i cos(theta_i) + E_sun cos(theta_sun) + E_sky (1 + n_z) / 2 + a E_level (1 - n_z) / 2    (1)
/// ```
/// over lamps and sun in front of it; `theta` from its forward axis `n`, `E_sky` the sky's light on level
/// ground, `E_level` all daylight there, `a` the ground's albedo: the even sky of B. Liu and R. Jordan,
/// Solar Energy 7, 53 (1963). With `response = "all-round"` there are no cosines, and sky and ground
/// count in full: what a lamp-seeker's ball of photodiodes sees. With `shadows` a lamp or sun behind
/// something is dark, by one ray to its middle.
#[sensor("light")]
pub struct LightSensor {
    params: LightSensorParams,
    channel: Channel,
}

/// Parameters of [`LightSensor`]. Unless said they are those of a ROHM BH1750FVI (rev. D, 2011, p. 2:
/// steps of 1 lx, 0.96 to 1.44 counts where 1.2 are meant, 65535 counts at most, 120 uA; p. 2 was not
/// at hand, the numbers are those quoted from it).
#[params]
pub struct LightSensorParams {
    /// How light from the side counts.
    pub response: LightResponse,
    /// Whether things throw shadows on it.
    pub shadows: bool,
    /// What throws shadows.
    pub sees: SeesWhat,
    /// How much of the daylight the ground throws back, 0 to 1.
    pub albedo: f64,
    /// Standard deviation of the white noise of each reading.
    pub sigma: Illuminance,
    /// Standard deviation of the scale factor's error, a fraction, drawn once for each sensor.
    pub scale_sigma: f64,
    /// The most that it reads. Above 0.
    pub range: Illuminance,
    /// Readings are multiples of this; 0 lx: they are not.
    pub resolution: Illuminance,
}

impl Default for LightSensorParams {
    fn default() -> Self {
        Self {
            response: LightResponse::Cosine,
            shadows: false,
            sees: SeesWhat::EVERYTHING,
            albedo: 0.2,
            sigma: Illuminance::ZERO,
            // 0.96 and 1.44 taken as two sigma from 1.2.
            scale_sigma: 0.1,
            range: Illuminance::si(65_535.0 / 1.2),
            resolution: Illuminance::si(1.0),
        }
    }
}

/// How light from the side counts.
#[choice]
pub enum LightResponse {
    /// By the cosine, as on a flat surface; nothing from behind.
    Cosine,
    /// In full, from all sides.
    AllRound,
}

/// How far away a thing may be to hide the sun.
const SUN_RANGE: Length = Length::si(1_000.0);

impl Sensor for LightSensor {
    type Params = LightSensorParams;
    type Reading = Illuminance;

    fn build(params: LightSensorParams) -> Result<Self, BuildError> {
        in_range("albedo", params.albedo, 0.0..=1.0)?;
        at_least_zero("sigma", params.sigma)?;
        in_range("scale_sigma", params.scale_sigma, 0.0..=1.0)?;
        positive("range", params.range)?;
        step("resolution", params.resolution)?;
        let channel = Channel::new(Errors {
            sigma: params.sigma.get(),
            scale_sigma: params.scale_sigma,
            limit: params.range.get(),
            step: params.resolution.get(),
            ..Errors::default()
        });
        Ok(Self { params, channel })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Illuminance {
        let pose = truth.sensor_pose();
        let (here, normal) = (pose.position.si(), pose.attitude.forward());
        let share = |toward: DVec3| match self.params.response {
            LightResponse::Cosine => normal.dot(toward).max(0.0),
            LightResponse::AllRound => 1.0,
        };
        let lit = |toward: DVec3, range: Length| {
            !self.params.shadows || self.is_lit(truth, toward, range)
        };
        let mut sum = 0.0;
        for lamp in &truth.world().lights {
            let way = lamp.position.si() - here;
            let toward = way.normalize_or(normal);
            let seen = share(toward);
            if seen > 0.0 && lit(toward, Length::si(way.length()) - lamp.radius) {
                sum += lamp.illuminance(pose.position).get() * seen;
            }
        }
        let level = truth.weather().light(pose.position, truth.now()).get();
        let mut sky = level;
        if let Some(sun) = truth.weather().sun(pose.position, truth.now()) {
            let beam = sun.illuminance.get();
            sky -= beam * sun.toward.z.max(0.0);
            let seen = share(sun.toward);
            if seen > 0.0 && lit(sun.toward, SUN_RANGE) {
                sum += beam * seen;
            }
        }
        let (above, below) = match self.params.response {
            LightResponse::Cosine => (0.5 * (1.0 + normal.z), 0.5 * (1.0 - normal.z)),
            LightResponse::AllRound => (1.0, 1.0),
        };
        Illuminance::si(sum + sky * above + self.params.albedo * level * below)
    }

    fn measure(&mut self, ideal: Illuminance, truth: &Truth<'_>, rng: &mut Stream) -> Illuminance {
        let read = self.channel.read(ideal.get(), truth.now(), rng);
        Illuminance::si(read.max(0.0))
    }

    fn current(&self) -> Current {
        Current::si(120e-6)
    }
}

impl LightSensor {
    fn is_lit(&self, truth: &Truth<'_>, toward: DVec3, range: Length) -> bool {
        if range <= Length::ZERO {
            return true; // within the lamp
        }
        let ray = Ray {
            origin: truth.sensor_pose().position,
            direction: toward.to_array(),
            range,
        };
        // A ray that is none meets nothing.
        match truth.cast_rays(&[ray], self.params.sees) {
            Ok(seen) => seen.iter().all(Option::is_none),
            Err(_) => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use crate::weather::atmosphere::{Atmosphere, AtmosphereParams};
    use crate::weather::sky::{Cover, SkyParams};
    use simbeeotic_model::units::{
        Angle, Attitude, Heading, LuminousIntensity, Position, Velocity, Yaw,
    };
    use simbeeotic_model::world::{Light, Obstacle, ObstacleShape, Weather};
    use simbeeotic_model::{FromParams, Handle};
    use std::sync::Arc;

    type Reader = Handle<Illuminance>;

    const PERFECT: [(&str, &str); 2] = [("scale_sigma", "0"), ("resolution", "0 lx")];

    fn lamp() -> Light {
        Light {
            position: Position::from_xyz(10.0, 0.0, 10.05),
            intensity: LuminousIntensity::si(500.0),
            ..Light::default()
        }
    }

    fn yaw(degrees: f64) -> Attitude {
        Attitude::from_yaw(Yaw::new(Angle::from_degrees(degrees)))
    }

    #[test]
    fn it_sees_a_lamp_by_the_square_of_the_distance_and_the_cosine() {
        let mut trial = Trial::of("light", &PERFECT);
        trial.world.lights = vec![lamp()];
        trial.seconds = 3;
        trial.run(|bee, sensor: Reader| {
            bee.set_velocity(Velocity::from_xyz(1.5, 0.0, 0.0));
            let d = 10.0 - bee.position().east().get();
            for (degrees, cos) in [(0.0, 1.0), (60.0, 0.5), (120.0, 0.0)] {
                bee.set_attitude(yaw(degrees));
                let found = bee.read(sensor).get();
                let wanted = 500.0 / (d * d + 0.0025) * cos;
                assert!(
                    (found - wanted).abs() < 1e-9,
                    "{degrees} deg at {d} m: {found}"
                );
            }
        });
    }

    #[test]
    fn a_wall_throws_a_shadow_if_asked_to() {
        for (shadows, lit) in [("true", false), ("false", true)] {
            let params = [PERFECT[0], PERFECT[1], ("shadows", shadows)];
            let mut trial = Trial::of("light", &params);
            trial.world.lights = vec![lamp()];
            trial.world.obstacles = vec![Obstacle {
                position: Position::from_xyz(5.0, 0.0, 0.0),
                shape: ObstacleShape::Cylinder {
                    diameter: Length::si(0.5),
                    height: Length::si(20.0),
                },
                ..Obstacle::default()
            }];
            trial.run(move |bee, sensor: Reader| {
                assert_eq!(bee.read(sensor) > Illuminance::ZERO, lit);
                // Beside the wall it is light in any case.
                bee.set_position(Position::from_xyz(0.0, 3.0, 10.05));
                assert!(bee.read(sensor) > Illuminance::si(4.0));
            });
        }
    }

    #[test]
    fn daylight_is_that_of_sun_sky_and_ground() {
        let params = AtmosphereParams {
            sky: Some(SkyParams::Sun {
                elevation: Angle::from_degrees(30.0),
                azimuth: Heading::EAST,
                cover: Cover::Clear,
                day: 93,
            }),
            ..AtmosphereParams::default()
        };
        let weather = Arc::new(Atmosphere::from_params(params).expect("good numbers"));
        let (at, now) = (Position::ZERO, simbeeotic_model::kernel::SimTime::ZERO);
        let level = weather.light(at, now).get();
        let beam = weather.sun(at, now).expect("it shines").illuminance.get();
        let sky = level - 0.5 * beam;
        let mut trial = Trial::of("light", &[PERFECT[0], PERFECT[1], ("range", "200000 lx")]);
        trial.weather = weather;
        trial.run(move |bee, sensor: Reader| {
            let pitch = |degrees: f64| {
                Attitude::from_rpy(Angle::ZERO, Angle::from_degrees(-degrees), Yaw::EAST)
            };
            for (attitude, wanted) in [
                (pitch(90.0), level),
                (pitch(-90.0), 0.2 * level),
                (pitch(30.0), beam + 0.75 * sky + 0.05 * level),
                (yaw(180.0), 0.5 * sky + 0.1 * level),
            ] {
                bee.set_attitude(attitude);
                let found = bee.read(sensor).get();
                assert!((found / wanted - 1.0).abs() < 1e-9, "{found}, {wanted}");
            }
        });
    }

    #[test]
    fn its_errors_are_those_it_says() {
        let params = [
            ("scale_sigma", "0"),
            ("sigma", "3 lx"),
            ("resolution", "0 lx"),
        ];
        let mut trial = Trial::of("light", &params);
        let bright = Light {
            intensity: LuminousIntensity::si(1e5),
            ..lamp()
        };
        trial.world.lights = vec![bright.clone()];
        trial.run(|bee, sensor: Reader| {
            let truth = 1e5 / (100.0 + 0.0025);
            let readings: Vec<f64> = (0..100_000).map(|_| bee.read(sensor).get()).collect();
            assert_normal(&readings, truth, 3.0);
        });
        // Steps of 1 lx up to 54,612 lx, and never below darkness.
        let mut trial = Trial::of("light", &[("scale_sigma", "0"), ("sigma", "2 lx")]);
        trial.world.lights = vec![bright];
        trial.run(|bee, sensor: Reader| {
            bee.set_attitude(yaw(180.0));
            assert!((0..1000).all(|_| {
                let read = bee.read(sensor).get();
                read >= 0.0 && read.fract() == 0.0
            }));
            bee.set_attitude(yaw(0.0));
            bee.set_position(Position::from_xyz(9.0, 0.0, 10.05));
            assert!((bee.read(sensor).get() - 54_612.0).abs() <= 1.0);
        });
    }

    #[test]
    fn nonsense_is_refused() {
        for (key, value) in [
            ("albedo", "1.5"),
            ("sigma", "-1 lx"),
            ("scale_sigma", "-0.1"),
            ("scale_sigma", "2.5"),
            ("range", "0 lx"),
            ("resolution", "-1 lx"),
            ("response", "sine"),
        ] {
            let said = refusal("light", &[(key, value)]).expect("it is refused");
            assert!(said.contains(key) || said.contains(value), "{said}");
        }
    }
}
