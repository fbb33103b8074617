//! A person detector.

use super::sighting::{Detector, Sighting, USUAL_CONE, sort};
use glam::DVec3;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::{Angle, Length, Offset};
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Truth, params, sensor};

/// Finds the people in a cone about its forward axis, the nearest first.
///
/// A person is found by what of it is seen: by those of its seven parts (legs, torso, arms, neck, head)
/// whose middle is in the cone, in range, and not hidden by anything. The position of the
/// [`Sighting`] is the mean of their middles.
#[sensor(
    "person",
    java = "harvard.robobees.simbeeotic.model.sensor.PersonSensor"
)]
pub struct PersonDetector {
    detector: Detector,
}

/// Parameters of [`PersonDetector`].
#[params]
pub struct PersonDetectorParams {
    /// How far it sees.
    pub max_range: Length,
    /// Half the width of its cone, 0 to 180 degrees.
    pub half_angle: Angle,
    /// Standard deviation of each of the two angles of a bearing.
    pub bearing_sigma: Angle,
    /// Standard deviation of a distance.
    pub range_sigma: Length,
    /// Probability that a person in sight is noticed, 0 to 1.
    pub detection: f64,
    /// How many people it finds in a reading, on average, that are not there, 0 to 10,000.
    pub false_alarms: f64,
    /// What can be in the way: kinds of things; none hides itself.
    pub hidden_by: SeesWhat,
}

impl Default for PersonDetectorParams {
    fn default() -> Self {
        let (max_range, half_angle) = USUAL_CONE;
        Self {
            max_range,
            half_angle,
            bearing_sigma: Angle::ZERO,
            range_sigma: Length::ZERO,
            detection: 1.0,
            false_alarms: 0.0,
            hidden_by: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for PersonDetector {
    type Params = PersonDetectorParams;
    type Reading = Vec<Sighting>;

    fn build(params: PersonDetectorParams) -> Result<Self, BuildError> {
        let detector = Detector {
            max_range: params.max_range,
            half_angle: params.half_angle,
            bearing_sigma: params.bearing_sigma,
            range_sigma: params.range_sigma,
            detection: params.detection,
            false_alarms: params.false_alarms,
            hidden_by: params.hidden_by,
        };
        Ok(Self {
            detector: detector.checked()?,
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Vec<Sighting> {
        let mut parts = self.detector.around(truth, Kind::Person, Length::ZERO);
        self.detector.keep_seen(truth, &mut parts);
        // The parts of one person follow each other.
        let people = parts.chunk_by(|a, b| a.thing == b.thing).map(|person| {
            let sum: DVec3 = person.iter().map(|part| part.at).sum();
            Sighting {
                thing: Some(person[0].thing),
                position: Offset::from_si(sum / person.len() as f64),
                count: 1.0,
            }
        });
        let mut people: Vec<Sighting> = people.collect();
        sort(&mut people);
        people
    }

    fn measure(
        &mut self,
        ideal: Vec<Sighting>,
        _truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Vec<Sighting> {
        self.detector.measure(ideal, rng)
    }

    fn beams(&self) -> Option<Beams> {
        Some(self.detector.beams())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::units::{Attitude, Position, Time, Velocity, Yaw};
    use simbeeotic_model::world::{Obstacle, ObstacleShape, Person, PersonShape};
    use simbeeotic_model::{Handle, Thing};

    type People = Handle<Vec<Sighting>>;

    fn man(x: f64, y: f64) -> Person {
        Person {
            position: Position::from_xyz(x, y, 0.0),
            shape: PersonShape::Man {
                width: Length::si(0.6),
                height: Length::si(1.8),
            },
            ..Person::default()
        }
    }

    /// The mean of the middles of its seven parts.
    fn middle(person: &Person) -> Position {
        let solids = person.solids();
        let sum: DVec3 = solids.iter().map(|solid| solid.center.si()).sum();
        Position::from_si(sum / solids.len() as f64)
    }

    fn trial(params: &[(&'static str, &'static str)], people: Vec<Person>) -> Trial {
        let mut trial = Trial::of("person", params);
        trial.world.people = people;
        trial.at = [0.0, 0.0, 1.0];
        trial
    }

    fn head(yaw_deg: f64) -> Attitude {
        Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw_deg)))
    }

    /// The original's cone was right at the origin only.
    #[test]
    fn it_finds_who_is_in_its_cone_wherever_it_is_in_any_attitude_and_in_motion() {
        for [x, y] in [[0.0, 0.0], [-70.0, 40.0]] {
            let people = vec![man(x + 6.0, y), man(x, y + 4.0), man(x - 5.0, y - 5.0)];
            let middles: Vec<_> = people.iter().map(middle).collect();
            let params = [("max_range", "20 m")];
            let mut trial = trial(&params, people);
            trial.at = [x, y, 1.0];
            (trial.every, trial.seconds) = (Time::from_millis(250.0), 2);
            trial.run(move |bee, sensor: People| {
                bee.set_velocity(Velocity::from_xyz(0.3, 0.2, 0.0));
                for (yaw, who) in [
                    (0.0, Some(0)),
                    (90.0, Some(1)),
                    (225.0, Some(2)),
                    (-45.0, None),
                ] {
                    bee.set_attitude(head(yaw));
                    let read = bee.read(sensor);
                    let found: Vec<_> = read
                        .iter()
                        .map(|s| s.thing.and_then(Thing::object).expect("a person").index as usize)
                        .collect();
                    assert_eq!(found, Vec::from_iter(who), "{yaw} at {x}");
                    if let Some(who) = who {
                        let want = bee.pose().to_body(middles[who]).si();
                        assert!((read[0].position.si() - want).length() < 1e-9);
                    }
                }
            });
        }
    }

    #[test]
    fn the_nearest_comes_first_and_range_and_angle_are_limits() {
        let people = vec![man(9.0, 1.0), man(5.0, 0.0), man(12.0, -1.0), man(3.0, 2.0)];
        let params = [("max_range", "10 m"), ("half_angle", "20 deg")];
        trial(&params, people).run(|bee, sensor: People| {
            let read = bee.read(sensor);
            let found: Vec<_> = read
                .iter()
                .map(|s| s.thing.and_then(Thing::object).expect("a person").index)
                .collect();
            // The third is too far away, the fourth 33 degrees aside.
            assert_eq!(found, [1, 0]);
            assert!((read[0].distance().get() - 5.0).abs() < 0.1);
            assert!(read[0].azimuth().get().abs() < 1e-9 && read[0].elevation().get() < 0.0);
        });
    }

    /// The original asked the list of bodies, and not the distance, for what hides whom.
    #[test]
    fn only_what_is_in_between_hides_a_person_and_half_a_person_is_found_by_its_upper_half() {
        let wall = |x: f64, height: f64| Obstacle {
            position: Position::from_xyz(x, 0.0, 0.0),
            shape: ObstacleShape::Box {
                length: Length::si(0.1),
                width: Length::si(4.0),
                height: Length::si(height),
                rotation: Angle::ZERO,
            },
            ..Obstacle::default()
        };
        for (x, height, seen) in [
            (3.0, 5.0, false),
            (6.0, 5.0, true),
            (-1.0, 5.0, true),
            (4.5, 1.1, true),
        ] {
            let mut trial = trial(&[("max_range", "10 m")], vec![man(5.0, 0.0)]);
            trial.world.obstacles = vec![wall(x, height)];
            trial.run(move |bee, sensor: People| {
                let read = bee.read(sensor);
                assert_eq!(read.len(), usize::from(seen), "{x}");
                if height < 5.0 {
                    let up = bee.pose().to_world(read[0].position).si().z;
                    assert!(up > 1.2, "only head, neck and torso show: {up}");
                }
            });
        }
    }

    #[test]
    fn what_it_looks_through_does_not_hide_a_person() {
        for (hidden_by, seen) in [("[obstacles]", false), ("[structures, people]", true)] {
            let params = [("max_range", "10 m"), ("hidden_by", hidden_by)];
            let mut trial = trial(&params, vec![man(5.0, 0.0)]);
            trial.world.obstacles = vec![crate::sensor::scene::block(
                [3.0, 0.0, 0.0],
                [0.1, 4.0, 5.0],
            )];
            trial.run(move |bee, sensor: People| {
                assert_eq!(bee.read(sensor).len(), usize::from(seen), "{hidden_by}");
            });
        }
    }

    #[test]
    fn it_errs_as_it_says() {
        let params = [
            ("max_range", "10 m"),
            ("range_sigma", "10 cm"),
            ("detection", "0.9"),
            ("false_alarms", "0.5"),
        ];
        let middle = middle(&man(5.0, 0.0));
        trial(&params, vec![man(5.0, 0.0)]).run(move |bee, sensor: People| {
            let (mut ranges, mut alarms) = (Vec::new(), Vec::new());
            for _ in 0..100_000 {
                let (real, false_): (Vec<_>, Vec<_>) = bee
                    .read(sensor)
                    .into_iter()
                    .partition(|s| s.thing.is_some());
                ranges.extend(real.iter().map(|s| s.distance().get()));
                alarms.push(false_.len() as f64);
            }
            let seen = ranges.len() as f64;
            assert!((seen - 9e4).abs() < 4.0 * (1e5_f64 * 0.09).sqrt(), "{seen}");
            assert_normal(&ranges, bee.position().distance(middle).get(), 0.1);
            let mean = alarms.iter().sum::<f64>() / 1e5;
            assert!((mean - 0.5).abs() < 4.0 * (0.5_f64 / 1e5).sqrt(), "{mean}");
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("max_range", "0 m"),
            ("max_range", "1e9 m"),
            ("half_angle", "-1 deg"),
            ("bearing_sigma", "-1 deg"),
            ("range_sigma", "-1 m"),
            ("detection", "-0.1"),
            ("false_alarms", "-1"),
        ] {
            let refusal = refusal("person", &[(key, value)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}
