//! ST VL53L1X, a time-of-flight range finder of 5 mm.
//!
//! Figures of the datasheet DS12385 (DocID031281), Rev 3, November 2018. Its first page was seen (range up
//! to 4 m, up to 50 Hz, full field of view 27 degrees); the others are quoted from it by ST's manual of the
//! STEVAL-BCN002V1 (p. 21) and, for the tables of ranging performance and of current, from memory:
//!
//! | distance mode | greatest range in the dark | in strong ambient light |
//! |---|---|---|
//! | short | 1.36 m | 1.35 m |
//! | medium | 2.90 m | 0.76 m |
//! | long | 3.60 m; 4 m with a timing budget of 140 ms or more | 0.73 m |
//!
//! (white target, 88 %, timing budget 100 ms; strong light is 200 kcps/SPAD: the sun behind a window.) Least
//! range 40 mm: what is nearer is noticed, and not measured well; it reads as 40 mm here. Ranging error
//! +-20 mm in the dark, +-25 mm in strong light, the sum of accuracy and repeatability. A +- is read as two
//! sigma, half of its variance as the sensor's own constant error and half as noise; the noise goes with
//! the root of the timing budget, from 100 ms. Steps of 1 mm; 16 mA while ranging.

use super::echo::{Beam, Bundle, Ranger, Ranging, TooNear, WhichEcho, some};
use glam::DVec3;
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Current, Length, Time};
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Truth, choice, params, sensor};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// An ST VL53L1X: the nearest thing within its cone of 27 degrees, up to 4 m away. `None` is nothing in
/// range.
///
/// Ranges, errors and current are the datasheet's for the distance mode, the timing budget and the light
/// that are chosen; the module cites them. Its `rate` should leave it the timing budget and 4 ms.
#[sensor("vl53l1x")]
pub struct Vl53l1x {
    bundle: Bundle,
    ranger: Ranger,
}

/// Parameters of [`Vl53l1x`].
#[params]
pub struct Vl53l1xParams {
    /// Its distance mode: `short`, `medium`, `long`.
    pub mode: DistanceMode,
    /// Time that it takes for one measurement: 33 ms to 1 s, in short mode from 20 ms.
    pub timing_budget: Time,
    /// The light that it measures in: `dark`, `strong` (the sun behind a window).
    pub ambient: Ambient,
    /// How many rays stand for its cone, 1 to 100,000.
    pub rays: u32,
    /// Kinds of things that it sees; rays pass through the rest.
    pub sees: SeesWhat,
}

/// What a VL53L1X is set to.
#[choice]
pub enum DistanceMode {
    /// To 1.36 m, whatever the light.
    Short,
    /// To 2.9 m.
    Medium,
    /// To 4 m.
    Long,
}

/// The light that a VL53L1X measures in.
#[choice]
pub enum Ambient {
    /// Indoors, no infrared light.
    Dark,
    /// The sun behind a window.
    Strong,
}

impl Default for Vl53l1xParams {
    fn default() -> Self {
        Self {
            mode: DistanceMode::Long,
            timing_budget: Time::from_millis(100.0),
            ambient: Ambient::Dark,
            rays: 19,
            sees: SeesWhat::EVERYTHING,
        }
    }
}

/// What it draws while it measures.
pub(super) const CURRENT: Current = Current::si(0.016);
/// The timing budget that the datasheet's figures are for.
const USUAL_BUDGET: Time = Time::si(0.1);
/// From this timing budget on, long mode reaches 4 m.
const LONG_BUDGET: Time = Time::si(0.14);

impl Vl53l1xParams {
    /// Its errors, from the table above.
    pub(super) fn ranging(&self) -> Result<Ranging, BuildError> {
        let shortest = match self.mode {
            DistanceMode::Short => 20.0,
            _ => 33.0,
        };
        let budgets = Time::from_millis(shortest)..=Time::from_secs(1.0);
        in_range("timing_budget", self.timing_budget, budgets)?;
        let max_m = match (self.mode, self.ambient) {
            (DistanceMode::Short, Ambient::Dark) => 1.36,
            (DistanceMode::Short, Ambient::Strong) => 1.35,
            (DistanceMode::Medium, Ambient::Dark) => 2.90,
            (DistanceMode::Medium, Ambient::Strong) => 0.76,
            (DistanceMode::Long, Ambient::Strong) => 0.73,
            (DistanceMode::Long, Ambient::Dark) if self.timing_budget >= LONG_BUDGET => 4.0,
            (DistanceMode::Long, Ambient::Dark) => 3.60,
        };
        let sigma = Length::from_millimetres(match self.ambient {
            Ambient::Dark => 10.0,
            Ambient::Strong => 12.5,
        });
        let shorter = USUAL_BUDGET.get() / self.timing_budget.get();
        Ok(Ranging {
            min_range: Length::from_millimetres(40.0),
            max_range: Length::si(max_m),
            sigma: sigma * FRAC_1_SQRT_2 * shorter.sqrt(),
            sigma_fraction: 0.0,
            bias_sigma: sigma * FRAC_1_SQRT_2,
            step: Length::from_millimetres(1.0),
            lost: 0.0,
            too_near: TooNear::Clamp,
        })
    }

    /// Its cone.
    pub(super) fn beam(&self) -> Beam {
        Beam {
            field_of_view: Angle::from_degrees(27.0),
            rays: self.rays,
            echo: WhichEcho::Nearest,
            max_incidence: Angle::si(FRAC_PI_2),
            sees: self.sees,
        }
    }
}

impl Sensor for Vl53l1x {
    type Params = Vl53l1xParams;
    type Reading = Option<Length>;

    fn build(params: Vl53l1xParams) -> Result<Self, BuildError> {
        Ok(Self {
            bundle: Bundle::new(&[DVec3::X], params.beam())?,
            ranger: Ranger::new(params.ranging()?)?,
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Option<Length> {
        let [distance_m] = self.bundle.distances(truth, self.ranger.max_range());
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

    fn current(&self) -> Current {
        CURRENT
    }

    fn beams(&self) -> Option<Beams> {
        self.bundle.beams(&self.ranger)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Position, Velocity, Yaw, math};
    use simbeeotic_model::world::{Obstacle, ObstacleShape};

    type Range = Handle<Option<Length>>;

    /// Across the way at `x`, wider than the cone.
    fn screen(x: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz(x + 0.005, 0.0, 0.0),
            shape: ObstacleShape::Box {
                length: Length::si(0.01),
                width: Length::si(10.0),
                height: Length::si(20.0),
                rotation: Angle::ZERO,
            },
            ..Obstacle::default()
        }
    }

    #[test]
    fn it_reaches_as_far_as_the_datasheet_says() {
        for (mode, ambient, budget, metres) in [
            ("short", "dark", "20 ms", 1.36),
            ("short", "strong", "100 ms", 1.35),
            ("medium", "dark", "100 ms", 2.9),
            ("medium", "strong", "100 ms", 0.76),
            ("long", "dark", "100 ms", 3.6),
            ("long", "dark", "140 ms", 4.0),
            ("long", "strong", "100 ms", 0.73),
        ] {
            for (x, seen) in [(metres - 0.1, true), (metres + 0.005, false)] {
                let params = [
                    ("mode", mode),
                    ("ambient", ambient),
                    ("timing_budget", budget),
                ];
                let mut trial = Trial::of("vl53l1x", &params);
                trial.world.obstacles = vec![screen(x)];
                trial.run(move |bee, sensor: Range| {
                    assert_eq!(bee.read(sensor).is_some(), seen, "{mode} {ambient} {x}");
                });
            }
        }
    }

    /// An edge 2 m away is seen 13 degrees off the axis, and not 14.
    #[test]
    fn its_cone_is_27_degrees_wide() {
        for (degrees, seen) in [(13.0_f64, true), (14.0, false)] {
            let mut trial = Trial::of("vl53l1x", &[("rays", "2000")]);
            let mut screen = screen(2.0);
            let aside = 2.0 * math::tan(degrees.to_radians());
            screen.position += Position::from_xyz(0.0, 5.0 + aside, 0.0);
            trial.world.obstacles = vec![screen];
            trial.run(move |bee, sensor: Range| {
                assert_eq!(bee.read(sensor).is_some(), seen, "{degrees}");
            });
        }
    }

    #[test]
    fn its_readings_spread_less_the_longer_it_measures_in_any_attitude() {
        for (budget, sigma) in [
            ("100 ms", 0.01 * FRAC_1_SQRT_2),
            ("400 ms", 0.005 * FRAC_1_SQRT_2),
        ] {
            let mut trial = Trial::of("vl53l1x", &[("timing_budget", budget), ("rays", "1")]);
            trial.world.obstacles = vec![screen(2.0)];
            trial.run(move |bee, sensor: Range| {
                for yaw in [0.0, 30.0] {
                    bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                    let read = |_| bee.read(sensor).expect("it is there").get();
                    let readings: Vec<f64> = (0..100_000).map(read).collect();
                    // Its own constant error is within four sigma; steps of 1 mm add their 0.29 mm.
                    let truth = 2.0 / math::cos(yaw.to_radians());
                    let mean = readings.iter().sum::<f64>() / 1e5;
                    assert!((mean - truth).abs() < 4.0 * 0.01 * FRAC_1_SQRT_2, "{mean}");
                    let rounded = (sigma * sigma + 1e-6 / 12.0_f64).sqrt();
                    assert_normal(&readings, mean, rounded);
                    let in_mm = readings[0] * 1e3;
                    assert!((in_mm - in_mm.round()).abs() < 1e-9);
                }
            });
        }
    }

    #[test]
    fn in_motion_it_follows_and_what_is_nearer_than_40_mm_reads_as_40_mm() {
        let mut trial = Trial::of("vl53l1x", &[]);
        trial.world.obstacles = vec![screen(1.0)];
        trial.every = Time::from_millis(100.0);
        trial.seconds = 4;
        trial.vehicle.push(("contacts", "none"));
        trial.run(|bee, sensor: Range| {
            bee.set_velocity(Velocity::from_xyz(0.4, 0.0, 0.0));
            let gap = 1.0 - bee.position().si().x;
            let Some(read) = bee.read(sensor).map(Length::get) else {
                return assert!(gap <= 1e-6, "{gap}");
            };
            assert!(
                (read - gap.max(0.04)).abs() < 0.06 && read >= 0.04,
                "{read} at {gap}"
            );
            assert!(gap > -0.05 || read == 0.04);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for params in [
            [("timing_budget", "32 ms"), ("mode", "long")],
            [("timing_budget", "19 ms"), ("mode", "short")],
            [("timing_budget", "1.1 s"), ("mode", "short")],
            [("rays", "0"), ("mode", "short")],
        ] {
            let refusal = refusal("vl53l1x", &params).expect("it is refused");
            assert!(refusal.contains(params[0].0), "{refusal}");
        }
        assert!(refusal("vl53l1x", &[("mode", "far")]).is_some());
        assert!(refusal("vl53l1x", &[("mode", "short"), ("timing_budget", "20 ms")]).is_none());
        let sensor = Vl53l1x::build(Vl53l1xParams::default()).expect("good");
        assert_eq!(sensor.current(), Current::from_milliamperes(16.0));
    }
}
