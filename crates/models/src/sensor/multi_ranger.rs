//! The multi-ranger deck of the Crazyflie: five VL53L1X that look to all sides and up.
//!
//! Source: Bitcraze, *Multi-ranger deck*, product page: VL53L1X to the front, back, left, right and up, up
//! to 4 m. Where they sit on the deck (some 1 cm from its middle) is left out: all look from the mount.

use super::echo::{Bundle, Ranger, some};
use super::vl53l1x::{Ambient, CURRENT, DistanceMode, Vl53l1xParams};
use glam::DVec3;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Current, Length, Time};
use simbeeotic_model::{
    Beams, BuildError, Column, Reading, SeesWhat, Sensor, Truth, params, sensor,
};

/// The distances that a [`MultiRanger`] reads. `None` is nothing in range.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gaps {
    /// Along the forward axis.
    pub front: Option<Length>,
    /// Against it.
    pub back: Option<Length>,
    /// To the left.
    pub left: Option<Length>,
    /// To the right.
    pub right: Option<Length>,
    /// Up.
    pub up: Option<Length>,
    /// Down, if it looks there.
    pub down: Option<Length>,
}

impl Gaps {
    fn from_metres([front, back, left, right, up, down]: [f64; SIDES]) -> Self {
        Self {
            front: some(front),
            back: some(back),
            left: some(left),
            right: some(right),
            up: some(up),
            down: some(down),
        }
    }

    /// Front, back, left, right, up, down.
    pub fn all(&self) -> [Option<Length>; SIDES] {
        [
            self.front, self.back, self.left, self.right, self.up, self.down,
        ]
    }
}

impl Reading for Gaps {
    const COLUMNS: &'static [Column] = &[
        Column::new("front", "m"),
        Column::new("back", "m"),
        Column::new("left", "m"),
        Column::new("right", "m"),
        Column::new("up", "m"),
        Column::new("down", "m"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.extend(self.all().map(|gap| gap.map_or(f64::NAN, Length::get)));
    }
}

const SIDES: usize = 6;

/// The directions, in the order of [`Gaps`].
const AXES: [DVec3; SIDES] = [
    DVec3::X,
    DVec3::NEG_X,
    DVec3::Y,
    DVec3::NEG_Y,
    DVec3::Z,
    DVec3::NEG_Z,
];

/// Five VL53L1X on one deck, to the front, back, left, right and up, as on the Crazyflie's multi-ranger; a
/// sixth looks down if `down` says so.
///
/// Each is a [`Vl53l1x`](super::vl53l1x::Vl53l1x) with a constant error of its own. The down-looking one is
/// on another deck of the Crazyflie (Flow deck v2), which is why it is off unless asked for.
#[sensor("multi-ranger")]
pub struct MultiRanger {
    bundle: Bundle,
    rangers: Box<[Ranger]>,
}

/// Parameters of [`MultiRanger`].
#[params]
pub struct MultiRangerParams {
    /// The distance mode of all: `short`, `medium`, `long`.
    pub mode: DistanceMode,
    /// Time that a measurement takes: 33 ms to 1 s, in short mode from 20 ms.
    pub timing_budget: Time,
    /// The light that they measure in: `dark`, `strong` (the sun behind a window).
    pub ambient: Ambient,
    /// How many rays stand for each cone, 1 to 100,000.
    pub rays: u32,
    /// Whether one looks down.
    pub down: bool,
    /// Kinds of things that they see; rays pass through the rest.
    pub sees: SeesWhat,
}

impl Default for MultiRangerParams {
    fn default() -> Self {
        let each = Vl53l1xParams::default();
        Self {
            mode: each.mode,
            timing_budget: each.timing_budget,
            ambient: each.ambient,
            rays: each.rays,
            down: false,
            sees: each.sees,
        }
    }
}

impl Sensor for MultiRanger {
    type Params = MultiRangerParams;
    type Reading = Gaps;

    fn build(params: MultiRangerParams) -> Result<Self, BuildError> {
        let sides = if params.down { SIDES } else { SIDES - 1 };
        let each = Vl53l1xParams {
            mode: params.mode,
            timing_budget: params.timing_budget,
            ambient: params.ambient,
            rays: params.rays,
            sees: params.sees,
        };
        let ranger = Ranger::new(each.ranging()?)?;
        Ok(Self {
            bundle: Bundle::new(&AXES[..sides], each.beam())?,
            rangers: vec![ranger; sides].into(),
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Gaps {
        let range = self.rangers[0].max_range();
        Gaps::from_metres(self.bundle.distances(truth, range))
    }

    fn measure(&mut self, ideal: Gaps, truth: &Truth<'_>, rng: &mut Stream) -> Gaps {
        let air = self.rangers[0].clarity(truth);
        let mut read = [f64::NAN; SIDES];
        for ((read, ideal), ranger) in read.iter_mut().zip(ideal.all()).zip(&mut self.rangers) {
            *read = ranger.measure(ideal.map_or(f64::NAN, Length::get), &air, rng);
        }
        Gaps::from_metres(read)
    }

    fn current(&self) -> Current {
        CURRENT * self.rangers.len() as f64
    }

    fn beams(&self) -> Option<Beams> {
        let axes = AXES.iter().take(self.rangers.len());
        Some(Beams::Rays {
            directions: axes.map(DVec3::to_array).collect(),
            range_m: self.rangers[0].max_range().get(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Angle, Attitude, Position, Velocity, Yaw};
    use simbeeotic_model::world::{Obstacle, ObstacleShape};

    /// A box from corner to corner that stands on the ground.
    fn block(x: [f64; 2], y: [f64; 2], height: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz((x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0, 0.0),
            shape: ObstacleShape::Box {
                length: Length::si(x[1] - x[0]),
                width: Length::si(y[1] - y[0]),
                height: Length::si(height),
                rotation: Angle::ZERO,
            },
            ..Obstacle::default()
        }
    }

    /// A room about the bee: 1 m to the east, 1.5 m north, 2 m west, 2.5 m south; 1 m above the ground.
    fn room() -> Trial {
        let mut trial = Trial::of("multi-ranger", &[("rays", "1"), ("down", "true")]);
        trial.at = [0.0, 0.0, 0.95];
        trial.world.obstacles = vec![
            block([1.0, 1.2], [-5.0, 5.0], 3.0),
            block([-5.0, 5.0], [1.5, 1.7], 3.0),
            block([-2.2, -2.0], [-5.0, 5.0], 3.0),
            block([-5.0, 5.0], [-2.7, -2.5], 3.0),
        ];
        trial
    }

    /// The constant error of each is within four sigma, as is the noise.
    fn assert_gaps(gaps: &Gaps, want: [f64; 6]) {
        for (read, want) in gaps.all().into_iter().zip(want) {
            match read {
                Some(read) => assert!((read.get() - want).abs() < 0.06, "{gaps:?}"),
                None => assert!(want.is_nan(), "{gaps:?}"),
            }
        }
    }

    #[test]
    fn each_looks_to_its_own_side_in_any_attitude_and_in_motion() {
        let mut trial = room();
        (trial.every, trial.seconds) = (Time::from_millis(50.0), 2);
        trial.run(|bee, sensor: Handle<Gaps>| {
            bee.set_velocity(Velocity::from_xyz(0.3, -0.2, 0.0));
            let p = bee.position().si();
            let (east, north) = (1.0 - p.x, 1.5 - p.y);
            let (west, south) = (2.0 + p.x, 2.5 + p.y);
            for (yaw, [front, back, left, right]) in [
                (0.0, [east, west, north, south]),
                (90.0, [north, south, west, east]),
            ] {
                let yaw = Yaw::new(Angle::from_degrees(yaw));
                bee.set_attitude(Attitude::from_yaw(yaw));
                assert_gaps(&bee.read(sensor), [front, back, left, right, f64::NAN, p.z]);
            }
            bee.set_attitude(Attitude::from_rpy(
                Angle::from_degrees(180.0),
                Angle::ZERO,
                Yaw::new(Angle::ZERO),
            ));
            assert_gaps(&bee.read(sensor), [east, west, south, north, p.z, f64::NAN]);
        });
    }

    #[test]
    fn their_noise_is_that_of_a_single_one_and_their_constant_errors_are_their_own() {
        room().run(|bee, sensor: Handle<Gaps>| {
            let readings: Vec<Gaps> = (0..100_000).map(|_| bee.read(sensor)).collect();
            let mut errors = Vec::new();
            for (side, truth) in [1.0, 2.0, 1.5, 2.5].into_iter().enumerate() {
                let of_side = |gaps: &Gaps| gaps.all()[side].expect("a wall").get();
                let read: Vec<f64> = readings.iter().map(of_side).collect();
                let mean = read.iter().sum::<f64>() / 1e5;
                let sigma = 0.01 * std::f64::consts::FRAC_1_SQRT_2;
                assert_normal(&read, mean, (sigma * sigma + 1e-6 / 12.0_f64).sqrt());
                errors.push(((mean - truth) * 1e6).round() as i64);
            }
            errors.sort_unstable();
            errors.dedup();
            assert_eq!(errors.len(), 4, "{errors:?}");
        });
    }

    #[test]
    fn it_does_not_look_down_unless_asked_and_draws_for_each() {
        let mut trial = room();
        trial.params.retain(|(key, _)| *key != "down");
        trial.run(|bee, sensor: Handle<Gaps>| assert_eq!(bee.read(sensor).down, None));
        let draws = |down| {
            let params = MultiRangerParams {
                down,
                ..MultiRangerParams::default()
            };
            MultiRanger::build(params)
                .expect("good")
                .current()
                .milliamperes()
        };
        assert!((draws(false) - 80.0).abs() < 1e-9 && (draws(true) - 96.0).abs() < 1e-9);
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [("timing_budget", "10 ms"), ("rays", "0")] {
            let refusal = refusal("multi-ranger", &[(key, value)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}
