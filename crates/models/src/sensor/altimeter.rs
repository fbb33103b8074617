//! An altimeter.

use super::bounds::{at_least_zero, reach, step};
use super::noise::{Channel, Errors};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::Length;
use simbeeotic_model::{BuildError, Ray, SeesWhat, Sensor, Truth, choice, params, sensor};

/// Measures how high it is: above what is below it, or above the sea.
///
/// Above ground it is the length of a ray straight down, whatever its attitude, to the first of what it
/// `sees`, with `None` if there is nothing within `max_range`. Above the sea it is the height over the plane
/// `z = 0` plus `ground_elevation`. A barometer is another sensor.
#[sensor("altimeter")]
pub struct Altimeter {
    params: AltimeterParams,
    channel: Channel,
}

/// Above what an [`Altimeter`] measures.
#[choice]
pub enum Above {
    /// The first thing below that it sees.
    Ground,
    /// The level of the sea.
    SeaLevel,
}

/// Parameters of [`Altimeter`].
#[params]
pub struct AltimeterParams {
    /// Above what: `ground` or `sea-level`.
    pub above: Above,
    /// Standard deviation of each reading. 0 or more.
    pub sigma: Length,
    /// Standard deviation of the constant error that each sensor has. 0 or more.
    pub bias_sigma: Length,
    /// Readings are multiples of this; 0: of nothing.
    pub resolution: Length,
    /// What is farther below is not seen. Above 0, to 100 km.
    pub max_range: Length,
    /// Where the plane `z = 0` is above the level of the sea. -100 to 100 km.
    pub ground_elevation: Length,
    /// What counts as ground.
    pub sees: SeesWhat,
}

impl Default for AltimeterParams {
    fn default() -> Self {
        Self {
            above: Above::Ground,
            sigma: Length::from_centimetres(5.0),
            bias_sigma: Length::ZERO,
            resolution: Length::ZERO,
            max_range: Length::si(100.0),
            ground_elevation: Length::ZERO,
            sees: SeesWhat::only(&[Kind::Ground, Kind::Terrain, Kind::Obstacle, Kind::Structure]),
        }
    }
}

impl Sensor for Altimeter {
    type Params = AltimeterParams;
    type Reading = Option<Length>;

    fn build(params: AltimeterParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        at_least_zero("bias_sigma", params.bias_sigma)?;
        step("resolution", params.resolution)?;
        reach("max_range", params.max_range)?;
        let highest = Length::si(1e5);
        in_range(
            "ground_elevation",
            params.ground_elevation,
            -highest..=highest,
        )?;
        let channel = Channel::new(Errors {
            sigma: params.sigma.get(),
            bias_sigma: params.bias_sigma.get(),
            step: params.resolution.get(),
            ..Errors::default()
        });
        Ok(Self { params, channel })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Option<Length> {
        let place = truth.sensor_pose().position;
        match self.params.above {
            Above::SeaLevel => Some(place.up() + self.params.ground_elevation),
            Above::Ground => {
                let down = Ray {
                    origin: place,
                    direction: [0.0, 0.0, -1.0],
                    range: self.params.max_range,
                };
                let hits = truth.cast_rays(&[down], self.params.sees).ok()?;
                hits.first()?.map(|seen| seen.distance)
            }
        }
    }

    fn measure(
        &mut self,
        ideal: Option<Length>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Option<Length> {
        let read = |height: Length| self.channel.read(height.get(), truth.now(), rng);
        ideal.map(read).map(Length::si)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::scene::block;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Angle, Attitude, Position, Time, Velocity, Yaw};
    use simbeeotic_model::world::World;

    type Reader = Handle<Option<Length>>;

    #[test]
    fn above_ground_it_follows_what_is_below_in_any_attitude() {
        let mut trial = Trial::of("altimeter", &[("sigma", "0 m")]);
        trial.world = World {
            obstacles: vec![block([5.0, 0.0, 0.0], [2.0, 2.0, 3.0])],
            ..World::default()
        };
        (trial.every, trial.seconds) = (Time::from_secs(1.0), 6);
        trial.run(|bee, sensor: Reader| {
            bee.set_velocity(Velocity::from_xyz(1.0, 0.0, 0.0));
            let tilt = Angle::from_degrees(50.0);
            for roll in [Angle::ZERO, tilt] {
                bee.set_attitude(Attitude::from_rpy(roll, tilt, Yaw::new(tilt)));
                let place = bee.position();
                let over = (4.0..6.0).contains(&place.east().get());
                let want = place.up().get() - if over { 3.0 } else { 0.0 };
                let read = bee.read(sensor).expect("ground").get();
                assert!((read - want).abs() < 1e-9, "{read} for {want}");
            }
        });
    }

    #[test]
    fn above_the_sea_it_does_not() {
        let params = [
            ("above", "sea-level"),
            ("sigma", "0 m"),
            ("ground_elevation", "519 m"),
        ];
        let mut trial = Trial::of("altimeter", &params);
        trial.world = World {
            obstacles: vec![block([0.0, 0.0, 0.0], [2.0, 2.0, 3.0])],
            ..World::default()
        };
        trial.run(|bee, sensor: Reader| {
            for up in [10.0, 300.0] {
                bee.set_position(Position::from_xyz(0.0, 0.0, up));
                let read = bee.read(sensor).expect("always").get();
                assert!((read - up - 519.0).abs() < 1e-9, "{read}");
            }
        });
    }

    #[test]
    fn too_high_above_ground_there_is_none() {
        Trial::of("altimeter", &[("max_range", "9 m")]).run(|bee, sensor: Reader| {
            assert_eq!(bee.read(sensor), None);
            bee.set_position(Position::from_xyz(0.0, 0.0, 8.0));
            assert!(bee.read(sensor).is_some());
        });
    }

    #[test]
    fn the_noise_is_as_large_as_it_says() {
        Trial::of("altimeter", &[("sigma", "20 cm")]).run(|bee, sensor: Reader| {
            let height = bee.position().up().get();
            let read = |_| bee.read(sensor).expect("ground").get();
            let read: Vec<f64> = (0..100_000).map(read).collect();
            assert_normal(&read, height, 0.2);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [
            ("sigma", "-1 m"),
            ("bias_sigma", "-1 m"),
            ("resolution", "-1 m"),
            ("max_range", "0 m"),
            ("above", "moon"),
        ] {
            let refusal = refusal("altimeter", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key) || refusal.contains(text), "{refusal}");
        }
    }
}
