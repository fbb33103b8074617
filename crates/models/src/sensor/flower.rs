//! A flower detector.

use super::echo::parts;
use super::sighting::{Detector, Part, Sighting, USUAL_CONE, and, poisson, sort};
use glam::DVec3;
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::{Angle, Length, Offset, math};
use simbeeotic_model::world::{ObjectId, ObjectKind};
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Thing, Truth, params, sensor};
use std::f64::consts::TAU;

/// Sees the flowers in a cone about its forward axis: where the head of each is, the nearest first. What
/// stands in between hides them, terrain as well.
///
/// `thing` of a [`Sighting`] is the flower: its `index` is the patch, whose label and metadata the world
/// knows. Of a patch that is approximated by a disc it sees how many flowers stand on the part of the disc
/// that it sees: the reading's `count` is drawn from the Poisson distribution whose mean is that area times
/// the patch's density, and the position is the middle of that area. The area is taken by `rays` rays:
///
/// ```text
/// A = sum r_i^2 |n_z| dw / cos(incidence_i),   dw = 2 pi (1 - cos half_angle) / rays
/// ```
#[sensor(
    "flower",
    java = "harvard.robobees.simbeeotic.model.sensor.FlowerSensor"
)]
pub struct FlowerDetector {
    detector: Detector,
    rays: u32,
}

/// Parameters of [`FlowerDetector`].
#[params]
pub struct FlowerDetectorParams {
    /// How far it sees.
    pub max_range: Length,
    /// Half the width of its cone, 0 to 180 degrees.
    pub half_angle: Angle,
    /// Standard deviation of each of the two angles of a bearing.
    pub bearing_sigma: Angle,
    /// Standard deviation of a distance.
    pub range_sigma: Length,
    /// Probability that a flower in sight is noticed, 0 to 1.
    pub detection: f64,
    /// How many rays look for approximate patches, 1 to 100,000. More are finer.
    pub rays: u32,
    /// What can be in the way: kinds of things; none hides itself.
    pub hidden_by: SeesWhat,
}

impl Default for FlowerDetectorParams {
    fn default() -> Self {
        let (max_range, half_angle) = USUAL_CONE;
        Self {
            max_range,
            half_angle,
            bearing_sigma: Angle::ZERO,
            range_sigma: Length::ZERO,
            detection: 1.0,
            rays: 200,
            hidden_by: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for FlowerDetector {
    type Params = FlowerDetectorParams;
    type Reading = Vec<Sighting>;

    fn build(params: FlowerDetectorParams) -> Result<Self, BuildError> {
        in_range("rays", params.rays, 1..=100_000)?;
        let detector = Detector {
            max_range: params.max_range,
            half_angle: params.half_angle,
            bearing_sigma: params.bearing_sigma,
            range_sigma: params.range_sigma,
            detection: params.detection,
            false_alarms: 0.0,
            hidden_by: params.hidden_by,
        };
        Ok(Self {
            detector: detector.checked()?,
            rays: params.rays,
        })
    }

    /// Of an approximate patch the count is the mean.
    fn ideal(&mut self, truth: &Truth<'_>) -> Vec<Sighting> {
        let mut found = if truth.world().approximate_patches {
            self.patches(truth)
        } else {
            self.flowers(truth)
        };
        sort(&mut found);
        found
    }

    fn measure(
        &mut self,
        mut ideal: Vec<Sighting>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Vec<Sighting> {
        if truth.world().approximate_patches {
            // Each flower is noticed or not: that thins the mean.
            for sighting in &mut ideal {
                sighting.count = poisson(sighting.count * self.detector.detection, rng) as f64;
            }
            ideal.retain(|sighting| sighting.count > 0.0);
            let all = Detector {
                detection: 1.0,
                ..self.detector
            };
            return all.measure(ideal, rng);
        }
        self.detector.measure(ideal, rng)
    }

    fn beams(&self) -> Option<Beams> {
        Some(self.detector.beams())
    }
}

impl FlowerDetector {
    fn flowers(&self, truth: &Truth<'_>) -> Vec<Sighting> {
        let shape = &truth.world().flower;
        // So far the parts of one flower can be apart.
        let size = shape.stem_height + shape.head_height + shape.head_radius;
        let up = truth.sensor_pose().attitude.inverse().quat() * DVec3::Z;
        let mut heads: Vec<Part> = Vec::new();
        for part in self.detector.around(truth, Kind::Flower, size) {
            // A flower's parts follow each other; the head is the highest.
            match heads.last_mut() {
                Some(last) if last.thing == part.thing => {
                    if part.at.dot(up) > last.at.dot(up) {
                        *last = part;
                    }
                }
                _ => heads.push(part),
            }
        }
        self.detector.keep_seen(truth, &mut heads);
        let sightings = heads.into_iter().map(|head| Sighting {
            thing: Some(head.thing),
            position: Offset::from_si(head.at),
            count: 1.0,
        });
        sightings.collect()
    }

    fn patches(&self, truth: &Truth<'_>) -> Vec<Sighting> {
        let half = self.detector.half_angle.get();
        let sine = math::sin(0.5 * half);
        let solid_angle = TAU * 2.0 * sine * sine / f64::from(self.rays);
        let directions = || parts(half, self.rays);
        // What each ray meets of a patch: area, and distance.
        let mut met = vec![None; self.rays as usize];
        let range = self.detector.max_range;
        let sees = and(self.detector.hidden_by, Kind::Flower);
        truth.look(directions(), range, sees, |at, echo| {
            let Some(echo) = echo else { return };
            let Some(object) = echo.thing.object() else {
                return;
            };
            if object.kind == ObjectKind::Flower && echo.facing > 0.0 {
                let r = echo.distance.get();
                let area = r * r * solid_angle * echo.normal[2].abs() / echo.facing;
                met[at] = Some((object.index as usize, area, r));
            }
        });
        let world = truth.world();
        let mut sums = vec![(0.0, DVec3::ZERO); world.patches.len()];
        for (direction, met) in directions().zip(met) {
            if let Some((patch, area, r)) = met
                && let Some((areas, places)) = sums.get_mut(patch)
            {
                *areas += area;
                *places += direction * (r * area);
            }
        }
        let mut found = Vec::new();
        for (patch, (area, places)) in sums.into_iter().enumerate() {
            let density = world.patches[patch].flowers_per_m2;
            if area * density > 0.0 {
                found.push(Sighting {
                    thing: Some(Thing::Object(ObjectId::new(
                        ObjectKind::Flower,
                        patch as u32,
                    ))),
                    position: Offset::from_si(places / area),
                    count: area * density,
                });
            }
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Position, Time, Velocity, Yaw};
    use simbeeotic_model::world::{FlowerShape, Obstacle, ObstacleShape, Patch, World};

    type Flowers = Handle<Vec<Sighting>>;

    /// The seed of a trial's run.
    const SEED: u64 = 7;

    /// Flowers so thin that none hides another.
    fn meadow() -> World {
        let flower = FlowerShape {
            head_radius: Length::si(0.005),
            stem_radius: Length::si(0.001),
            ..FlowerShape::default()
        };
        World {
            flower,
            patches: vec![
                Patch {
                    radius: Length::si(3.0),
                    flowers_per_m2: 4.0,
                    label: "clover".into(),
                    ..Patch::default()
                },
                Patch {
                    center: Position::from_xyz(8.0, 0.0, 0.0),
                    radius: Length::si(2.0),
                    flowers_per_m2: 3.0,
                    ..Patch::default()
                },
            ],
            ..World::default()
        }
    }

    fn over(world: World, params: &[(&'static str, &'static str)], height: f64) -> Trial {
        let mut trial = Trial::of("flower", params);
        trial.world = world;
        trial.at = [0.0, 0.0, height];
        trial
    }

    fn down(pitch: f64, yaw: f64) -> Attitude {
        let degrees = Angle::from_degrees;
        Attitude::from_rpy(Angle::ZERO, degrees(pitch), Yaw::new(degrees(yaw)))
    }

    /// Against all flowers, one by one.
    #[test]
    fn it_sees_the_flowers_in_its_cone_and_where_they_are_in_two_attitudes_and_in_motion() {
        let params = [("max_range", "6 m"), ("half_angle", "25 deg")];
        let mut trial = over(meadow(), &params, 4.0);
        (trial.every, trial.seconds) = (Time::from_millis(500.0), 4);
        let heads: Vec<_> = meadow().flowers(SEED);
        trial.run(move |bee, sensor: Flowers| {
            bee.set_velocity(Velocity::from_xyz(0.7, 0.1, 0.0));
            for attitude in [down(90.0, 0.0), down(60.0, 35.0)] {
                bee.set_attitude(attitude);
                let pose = bee.pose();
                let mut want: Vec<_> = heads
                    .iter()
                    .map(|flower| {
                        let head = flower.foot + Position::from_xyz(0.0, 0.0, 0.21);
                        (flower.patch, pose.to_body(head).si())
                    })
                    .filter(|(_, at)| {
                        let cone = at.x >= at.length() * math::cos(25_f64.to_radians());
                        cone && at.length() <= 6.0
                    })
                    .collect();
                want.sort_by(|(_, a), (_, b)| a.length().total_cmp(&b.length()));
                let read = bee.read(sensor);
                assert!(want.len() >= 3);
                assert_eq!(read.len(), want.len());
                for (read, (patch, at)) in read.iter().zip(want) {
                    assert!((read.position.si() - at).length() < 1e-9);
                    let object = read.thing.and_then(Thing::object).expect("a flower");
                    assert_eq!((object.index as usize, read.count), (patch, 1.0));
                    let label = bee.world().label_of(object);
                    assert_eq!(label == "clover", patch == 0);
                }
            }
        });
    }

    /// In the original it saw the ground, and so the flowers, through obstacles.
    #[test]
    fn what_stands_in_between_hides_them() {
        for approximate in [false, true] {
            let mut world = meadow();
            world.approximate_patches = approximate;
            world.obstacles = vec![Obstacle {
                shape: ObstacleShape::Box {
                    length: Length::si(8.0),
                    width: Length::si(8.0),
                    height: Length::si(1.0),
                    rotation: Angle::ZERO,
                },
                ..Obstacle::default()
            }];
            over(world.clone(), &[("max_range", "6 m")], 3.0).run(|bee, sensor: Flowers| {
                bee.set_attitude(down(90.0, 0.0));
                assert_eq!(bee.read(sensor), []);
            });
            let through = [("max_range", "6 m"), ("hidden_by", "[ground]")];
            over(world, &through, 3.0).run(|bee, sensor: Flowers| {
                bee.set_attitude(down(90.0, 0.0));
                assert_ne!(bee.read(sensor), []);
            });
        }
    }

    /// Straight down the cone cuts a disc of h tan(half angle) out of the patch; askance, an ellipse.
    #[test]
    fn of_an_approximate_patch_it_sees_area_times_density() {
        let world = World {
            approximate_patches: true,
            patches: vec![Patch {
                radius: Length::si(30.0),
                flowers_per_m2: 10.0,
                ..Patch::default()
            }],
            ..World::default()
        };
        let params = [
            ("max_range", "20 m"),
            ("half_angle", "20 deg"),
            ("rays", "2000"),
        ];
        over(world, &params, 3.97).run(|bee, sensor: Flowers| {
            // The bee is a ball of 5 cm, the patch a disc of 2 cm: 4 m between them.
            let (h, half) = (4.0, 20_f64.to_radians());
            for pitch in [90.0_f64, 60.0] {
                bee.set_attitude(down(pitch, 10.0));
                let b = pitch.to_radians();
                // The ellipse that a plane at the angle b cuts out of a cone of half angle a about an
                // axis of length l = h / sin b.
                let across = math::sin(b - half) * math::sin(b + half);
                let l = h / math::sin(b);
                let major = l * math::sin(b) * math::sin(2.0 * half) / (2.0 * across);
                let minor = l * math::sin(b) * math::sin(half) / across.sqrt();
                let want = 10.0 * std::f64::consts::PI * major * minor;
                let counts: Vec<f64> = (0..2_000)
                    .map(|_| bee.read(sensor).iter().map(|s| s.count).sum())
                    .collect();
                let mean = counts.iter().sum::<f64>() / 2e3;
                assert!((mean / want - 1.0).abs() < 0.02, "{mean} for {want}");
                assert_normal(&counts, mean, mean.sqrt());
            }
            bee.set_attitude(down(90.0, 0.0));
            let at = bee.read(sensor)[0].position.si();
            assert!((at - DVec3::new(h, 0.0, 0.0)).length() < 0.02, "{at}");
        });
    }

    #[test]
    fn it_errs_as_it_says() {
        let world = World {
            patches: vec![Patch {
                radius: Length::si(0.01),
                flowers_per_m2: 4000.0,
                ..Patch::default()
            }],
            ..World::default()
        };
        let params = [
            ("max_range", "6 m"),
            ("range_sigma", "5 cm"),
            ("detection", "0.8"),
        ];
        let head = world.flowers(SEED)[0].foot + Position::from_xyz(0.0, 0.0, 0.21);
        over(world, &params, 3.0).run(move |bee, sensor: Flowers| {
            bee.set_attitude(down(90.0, 0.0));
            let read =
                (0..100_000).filter_map(|_| Some(bee.read(sensor).first()?.distance().get()));
            let read: Vec<f64> = read.collect();
            let seen = read.len() as f64;
            assert!((seen - 8e4).abs() < 4.0 * (1e5_f64 * 0.16).sqrt(), "{seen}");
            assert_normal(&read, bee.position().distance(head).get(), 0.05);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("max_range", "0 m"),
            ("half_angle", "0 deg"),
            ("half_angle", "200 deg"),
            ("bearing_sigma", "-1 deg"),
            ("range_sigma", "-1 m"),
            ("detection", "1.1"),
            ("rays", "0"),
        ] {
            let refusal = refusal("flower", &[(key, value)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}
