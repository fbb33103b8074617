//! A wall detector.

use super::echo::{Ranger, Ranging, TooNear, some};
use super::sighting::and;
use glam::DVec3;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::Length;
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Truth, params, sensor};

/// Tells whether a wall is ahead, and how far it is: `None` if there is none within `max_range` along its
/// forward axis.
///
/// A wall is a structure of the world, slabs included. Whatever else is nearer hides it. The reading is
/// exact unless `sigma` says otherwise.
#[sensor("wall", java = "harvard.robobees.simbeeotic.model.sensor.WallSensor")]
pub struct WallDetector {
    ranger: Ranger,
    sees: SeesWhat,
}

/// Parameters of [`WallDetector`].
#[params]
pub struct WallDetectorParams {
    /// The greatest range.
    pub max_range: Length,
    /// Standard deviation of the distance.
    pub sigma: Length,
    /// Probability that a wall goes unnoticed, 0 to 1.
    pub lost: f64,
    /// What can be in the way: kinds of things; none hides itself.
    pub hidden_by: SeesWhat,
}

impl Default for WallDetectorParams {
    fn default() -> Self {
        Self {
            max_range: Length::si(1.0),
            sigma: Length::ZERO,
            lost: 0.0,
            hidden_by: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for WallDetector {
    type Params = WallDetectorParams;
    type Reading = Option<Length>;

    fn build(params: WallDetectorParams) -> Result<Self, BuildError> {
        let ranger = Ranger::new(Ranging {
            min_range: Length::ZERO,
            max_range: params.max_range,
            sigma: params.sigma,
            sigma_fraction: 0.0,
            bias_sigma: Length::ZERO,
            step: Length::ZERO,
            lost: params.lost,
            too_near: TooNear::Clamp,
        })?;
        let sees = and(params.hidden_by, Kind::Structure);
        Ok(Self { ranger, sees })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Option<Length> {
        let (mut distance_m, range) = (f64::NAN, self.ranger.max_range());
        truth.look([DVec3::X], range, self.sees, |_, echo| {
            if let Some(echo) = echo.filter(|echo| echo.kind == Kind::Structure) {
                distance_m = echo.distance.get();
            }
        });
        some(distance_m)
    }

    fn measure(
        &mut self,
        ideal: Option<Length>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Option<Length> {
        self.ranger.read(ideal, truth, rng)
    }

    fn beams(&self) -> Option<Beams> {
        Some(Beams::ahead(self.ranger.max_range()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Angle, Attitude, Position, Time, Velocity, Yaw, math};
    use simbeeotic_model::world::{Obstacle, ObstacleShape, Structure, StructureShape, Wall};

    type Range = Handle<Option<Length>>;

    /// Across the way at `x`, 20 m high.
    fn wall(x: f64) -> Structure {
        Structure {
            position: Position::from_xyz(x, -5.0, 0.0),
            shape: StructureShape::Wall(Wall {
                length: Length::si(0.2),
                width: Length::si(10.0),
                height: Length::si(20.0),
                ..Wall::default()
            }),
            ..Structure::default()
        }
    }

    fn pillar(x: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz(x, 0.0, 0.0),
            shape: ObstacleShape::Cylinder {
                diameter: Length::si(0.2),
                height: Length::si(20.0),
            },
            ..Obstacle::default()
        }
    }

    fn head(yaw_deg: f64) -> Attitude {
        Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw_deg)))
    }

    /// In the original the range of 2 m was one of 4 m: it was scaled twice.
    #[test]
    fn its_range_is_what_it_says_in_any_attitude() {
        for (max_range, x, seen) in [
            ("2 m", 1.9, true),
            ("2 m", 2.1, false),
            ("0.5 m", 0.4, true),
            ("0.5 m", 0.6, false),
        ] {
            let mut trial = Trial::of("wall", &[("max_range", max_range)]);
            trial.world.structures = vec![wall(x)];
            trial.run(move |bee, sensor: Range| {
                for yaw in [0.0, 10.0, -10.0] {
                    bee.set_attitude(head(yaw));
                    let slanted = x / math::cos(yaw.to_radians());
                    let read = bee.read(sensor).map(Length::get);
                    assert_eq!(read.is_some(), seen, "{x} {yaw}");
                    assert!(read.is_none_or(|read| (read - slanted).abs() < 1e-9));
                }
                bee.set_attitude(head(180.0));
                assert_eq!(bee.read(sensor), None);
            });
        }
    }

    /// The original's took anything for a wall.
    #[test]
    fn nothing_but_a_wall_is_one_and_what_is_nearer_hides_it() {
        let mut trial = Trial::of("wall", &[("max_range", "5 m")]);
        trial.world.obstacles = vec![pillar(1.0)];
        trial.run(|bee, sensor: Range| assert_eq!(bee.read(sensor), None));
        for (x, seen) in [(2.0, true), (0.5, false)] {
            let mut trial = Trial::of("wall", &[("max_range", "5 m")]);
            trial.world.structures = vec![wall(1.5)];
            trial.world.obstacles = vec![pillar(x)];
            trial.run(move |bee, sensor: Range| assert_eq!(bee.read(sensor).is_some(), seen));
        }
    }

    #[test]
    fn what_it_looks_through_does_not_hide_a_wall() {
        let mut trial = Trial::of("wall", &[("max_range", "5 m"), ("hidden_by", "[vehicles]")]);
        trial.world.structures = vec![wall(1.5)];
        trial.world.obstacles = vec![pillar(0.5)];
        trial.run(|bee, sensor: Range| {
            let read = bee.read(sensor).expect("the wall");
            assert!((read.get() - 1.5).abs() < 1e-9, "{read}");
        });
    }

    #[test]
    fn in_motion_it_notices_the_wall_when_it_comes_into_range() {
        let mut trial = Trial::of("wall", &[("max_range", "2 m")]);
        trial.world.structures = vec![wall(6.0)];
        (trial.every, trial.seconds) = (Time::from_millis(73.0), 4);
        trial.run(|bee, sensor: Range| {
            bee.set_velocity(Velocity::from_xyz(1.7, 0.0, 0.0));
            let gap = 6.0 - bee.position().si().x;
            let read = bee.read(sensor).map(Length::get);
            assert_eq!(read.is_some(), gap <= 2.0, "{gap}");
            assert!(read.is_none_or(|read| (read - gap).abs() < 1e-9));
        });
    }

    #[test]
    fn its_error_is_what_it_says() {
        let mut trial = Trial::of("wall", &[("max_range", "3 m"), ("sigma", "2 cm")]);
        trial.world.structures = vec![wall(1.5)];
        trial.run(|bee, sensor: Range| {
            let read = |_| bee.read(sensor).expect("it is there").get();
            assert_normal(&(0..100_000).map(read).collect::<Vec<_>>(), 1.5, 0.02);
        });
        let mut trial = Trial::of("wall", &[("lost", "0.3")]);
        trial.world.structures = vec![wall(0.7)];
        trial.run(|bee, sensor: Range| {
            let seen = (0..100_000).filter(|_| bee.read(sensor).is_some()).count() as f64;
            assert!((seen - 7e4).abs() < 4.0 * (1e5_f64 * 0.21).sqrt(), "{seen}");
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [("max_range", "0 m"), ("sigma", "-1 m"), ("lost", "-0.1")] {
            let refusal = refusal("wall", &[(key, value)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}
