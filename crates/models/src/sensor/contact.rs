//! A contact sensor: a bump switch, a whisker's root, a landing foot.

use super::bounds::reach;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Impulse, Length};
use simbeeotic_model::{
    BuildError, Column, Reading, SeesWhat, Sensor, Thing, Touch, Truth, params, sensor,
};

/// What a [`ContactSensor`] reads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bump {
    /// Whether something is within the sensor's radius now.
    pub touching: bool,
    /// Whether something has touched the body within the sensor's radius since the last reading, however
    /// short it was.
    pub touched: bool,
    /// The hardest of these touches: the impulse on the body. Zero if there was none.
    pub impulse: Impulse,
    /// What is touched now, or what the hardest touch was with.
    pub other: Option<Thing>,
}

impl Bump {
    /// Whether something touches now, or has since the last reading.
    pub fn tripped(&self) -> bool {
        self.touching || self.touched
    }
}

/// Of what is touched: see [`Thing`] as a reading. Nothing is NaN.
impl Reading for Bump {
    const COLUMNS: &'static [Column] = &[
        Column::new("touching", "1"),
        Column::new("touched", "1"),
        Column::new("impulse", "N s"),
        Column::new("kind", "1"),
        Column::new("index", "1"),
        Column::new("item", "1"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        let number = |is: bool| f64::from(u8::from(is));
        let impulse = self.impulse.get();
        to.extend([number(self.touching), number(self.touched), impulse]);
        self.other.numbers(to);
    }
}

/// Tells what touches the body near the sensor: within `radius` of where it sits.
///
/// A touch is an event: a bounce between two readings lasts no time, and is not missed. It is kept until
/// the next reading, and lost with it if that reading is lost by drop-out. The vehicle must notice touches
/// for that (`contacts` of `simple-bee`); what is near is noticed in any case.
#[sensor(
    "contact",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultContactSensor"
)]
pub struct ContactSensor {
    radius: Length,
    since: Bump,
}

/// Parameters of [`ContactSensor`].
#[params]
pub struct ContactSensorParams {
    /// How far from the sensor a touch counts.
    pub radius: Length,
}

impl Default for ContactSensorParams {
    fn default() -> Self {
        Self {
            radius: Length::si(0.005),
        }
    }
}

impl Sensor for ContactSensor {
    type Params = ContactSensorParams;
    type Reading = Bump;

    fn build(params: ContactSensorParams) -> Result<Self, BuildError> {
        reach("radius", params.radius)?;
        Ok(Self {
            radius: params.radius,
            since: Bump::default(),
        })
    }

    fn touched(&mut self, touch: &Touch, truth: &Truth<'_>) {
        let place = truth.sensor_pose().position;
        if place.distance(touch.point) > self.radius {
            return;
        }
        let impulse = touch.impulse.length();
        if !self.since.touched || impulse > self.since.impulse {
            self.since.impulse = impulse;
            self.since.other = Some(touch.other);
        }
        self.since.touched = true;
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Bump {
        let near = truth.touching(self.radius, SeesWhat::EVERYTHING);
        let mut bump = std::mem::take(&mut self.since);
        if let Some((thing, _)) = near {
            bump.touching = true;
            bump.other = Some(thing);
        }
        bump
    }

    fn measure(&mut self, ideal: Bump, _truth: &Truth<'_>, _rng: &mut Stream) -> Bump {
        ideal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Angle, Attitude, Mount, Offset, Position, Time, Velocity, Yaw};
    use simbeeotic_model::world::{Obstacle, ObstacleShape};

    /// A wall whose face is at `x`; it gives back all speed.
    fn wall(x: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz(x + 0.5, 0.0, 0.0),
            shape: ObstacleShape::Box {
                length: Length::si(1.0),
                width: Length::si(10.0),
                height: Length::si(20.0),
                rotation: Angle::ZERO,
            },
            restitution: Some(1.0),
            ..Obstacle::default()
        }
    }

    /// A switch on the front of a bee, a ball of 5 cm.
    fn switch() -> Trial {
        let mut trial = Trial::of("contact", &[]);
        trial.mount = Mount::new(Offset::from_xyz(0.05, 0.0, 0.0), Attitude::IDENTITY);
        trial.vehicle.push(("restitution", "1"));
        trial.world.obstacles = vec![wall(1.0)];
        trial
    }

    fn head(yaw_deg: f64) -> Attitude {
        Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw_deg)))
    }

    /// A bounce lasts no time: only its event tells of it. It is told once, and with its impulse,
    /// m v (1 + e).
    #[test]
    fn a_recorded_bump_says_of_what_it_is() {
        let mut row = Vec::new();
        Bump {
            touching: true,
            other: Some(Thing::Ground),
            ..Bump::default()
        }
        .numbers(&mut row);
        assert_eq!(row, [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(Bump::COLUMNS[3..], *<Thing as Reading>::COLUMNS);
    }

    #[test]
    fn a_bounce_between_two_readings_is_not_missed_and_told_once() {
        for (yaw, mine) in [(0.0, true), (180.0, false), (30.0, false)] {
            let mut trial = switch();
            (trial.seconds, trial.every) = (4, Time::from_secs(1.0));
            trial.run(move |bee, sensor: Handle<Bump>| {
                let read = bee.read(sensor);
                match bee.now().nanos() / 1_000_000_000 {
                    1 => {
                        assert_eq!(read, Bump::default());
                        // It meets the wall with 5 cm of radius at 1.95 s, and is off again at 2 s.
                        bee.set_attitude(head(yaw));
                        bee.set_velocity(Velocity::from_xyz(1.0, 0.0, 0.0));
                    }
                    2 => {
                        assert!((bee.velocity().si().x + 1.0).abs() < 1e-9);
                        assert_eq!((read.touching, read.touched), (false, mine), "{yaw}");
                        if mine {
                            assert!((read.impulse.get() - 0.128 * 2.0).abs() < 1e-9);
                            assert!(read.other.and_then(Thing::object).is_some());
                        }
                    }
                    _ => assert_eq!(read, Bump::default(), "{yaw}"),
                }
            });
        }
    }

    #[test]
    fn what_is_within_its_radius_touches_in_any_attitude() {
        let mut trial = switch();
        trial.vehicle.push(("contacts", "none"));
        trial.at = [0.9, 0.0, 10.0];
        trial.run(|bee, sensor: Handle<Bump>| {
            let z = bee.position().si().z;
            for (gap, touching) in [(0.006, false), (0.004, true), (-0.01, true)] {
                for (yaw, ahead) in [(0.0, true), (180.0, false)] {
                    let at = Position::from_xyz(0.95 - gap, 0.0, z);
                    bee.set_pose(simbeeotic_model::units::Pose::new(at, head(yaw)));
                    let read = bee.read(sensor);
                    assert_eq!(read.touching, touching && ahead, "{gap} {yaw}");
                    assert_eq!(read.tripped(), touching && ahead);
                    assert!(!read.touched && read.impulse == Impulse::ZERO);
                }
            }
            // The ground is felt, too.
            let down = Attitude::from_rpy(
                Angle::ZERO,
                Angle::from_degrees(90.0),
                Yaw::new(Angle::ZERO),
            );
            for (gap, touching) in [(0.006, false), (0.004, true)] {
                let at = Position::from_xyz(-3.0, 0.0, 0.05 + gap);
                bee.set_pose(simbeeotic_model::units::Pose::new(at, down));
                let read = bee.read(sensor);
                assert_eq!(read.touching, touching, "{gap}");
                assert_eq!(read.other, touching.then_some(Thing::Ground));
            }
        });
    }

    #[test]
    fn the_hardest_of_several_touches_counts() {
        let mut trial = switch();
        // Between two walls it bounces three times in a second, with a switch on either side by its
        // radius.
        trial.params = vec![("radius", "10 cm".into())];
        trial.mount = Mount::IDENTITY;
        trial.world.obstacles.push(wall(-1.3));
        trial.seconds = 2;
        trial.run(|bee, sensor: Handle<Bump>| {
            if bee.now().nanos() == 1_000_000_000 {
                assert!(!bee.read(sensor).tripped());
                return bee.set_velocity(Velocity::from_xyz(3.0, 0.0, 0.0));
            }
            let read = bee.read(sensor);
            assert!(read.touched && (read.impulse.get() - 0.128 * 6.0).abs() < 1e-9);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for value in ["0 m", "-1 mm"] {
            let refusal = refusal("contact", &[("radius", value)]).expect("it is refused");
            assert!(refusal.contains("radius"), "{refusal}");
        }
    }
}
