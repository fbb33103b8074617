//! A range finder: how far the next thing is along a ray, or within a cone.

use super::echo::{Beam, Bundle, Ranger, Ranging, TooNear, WhichEcho, some};
use glam::DVec3;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Length};
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Truth, params, sensor};

/// Measures how far the next thing is along its forward axis, or the nearest thing in a cone about it.
/// What is beyond its range is no reading: `None`, never a number.
///
/// The beam is one ray, or with a `field_of_view` a bundle of rays (equation 4 of the module `echo`). The
/// length of the mount's `pointing` does not matter. A thing that touches the sensor is at its distance, as
/// any other; nearer than `min_range` it reads as `too_near` says. Errors are those of equations 1 to 3.
#[sensor(
    "range",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultRangeSensor"
)]
pub struct RangeFinder {
    bundle: Bundle,
    ranger: Ranger,
}

/// Parameters of [`RangeFinder`].
#[params]
pub struct RangeFinderParams {
    /// The least range: see `too_near`.
    pub min_range: Length,
    /// The greatest range. What is farther is not seen.
    pub max_range: Length,
    /// Standard deviation of a reading.
    pub sigma: Length,
    /// The part of the standard deviation that grows with the distance: a fraction of it.
    pub sigma_fraction: f64,
    /// Standard deviation of the constant error that each sensor has.
    pub bias_sigma: Length,
    /// Readings are multiples of this; zero: they are not.
    pub step: Length,
    /// Probability that a reading is nothing although something is there, 0 to 1.
    pub lost: f64,
    /// What becomes of an echo from nearer than `min_range`: `nothing`, or `clamp`: it reads as
    /// `min_range`.
    pub too_near: TooNear,
    /// How wide the beam is, from rim to rim, 0 to 180 degrees. Zero is a single ray.
    pub field_of_view: Angle,
    /// How many rays stand for a beam that has a width, 1 to 100,000.
    pub rays: u32,
    /// Which echo of a wide beam counts: the `nearest`, or the `mean` of all, weighted by the light that
    /// comes back.
    pub echo: WhichEcho,
    /// A surface sends nothing back if the ray meets it at more than this from its normal. 90 degrees: all
    /// do.
    pub max_incidence: Angle,
    /// Kinds of things that it sees; rays pass through the rest.
    pub sees: SeesWhat,
}

impl Default for RangeFinderParams {
    fn default() -> Self {
        Self {
            min_range: Length::si(0.1),
            max_range: Length::si(5.0),
            sigma: Length::si(0.05),
            sigma_fraction: 0.0,
            bias_sigma: Length::ZERO,
            step: Length::ZERO,
            lost: 0.0,
            too_near: TooNear::Nothing,
            field_of_view: Angle::ZERO,
            rays: 19,
            echo: WhichEcho::Nearest,
            max_incidence: Angle::si(std::f64::consts::FRAC_PI_2),
            sees: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for RangeFinder {
    type Params = RangeFinderParams;
    type Reading = Option<Length>;

    fn build(params: RangeFinderParams) -> Result<Self, BuildError> {
        let beam = Beam {
            field_of_view: params.field_of_view,
            rays: params.rays,
            echo: params.echo,
            max_incidence: params.max_incidence,
            sees: params.sees,
        };
        let ranging = Ranging {
            min_range: params.min_range,
            max_range: params.max_range,
            sigma: params.sigma,
            sigma_fraction: params.sigma_fraction,
            bias_sigma: params.bias_sigma,
            step: params.step,
            lost: params.lost,
            too_near: params.too_near,
        };
        Ok(Self {
            bundle: Bundle::new(&[DVec3::X], beam)?,
            ranger: Ranger::new(ranging)?,
        })
    }

    /// The true distance, however near.
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

    fn beams(&self) -> Option<Beams> {
        self.bundle.beams(&self.ranger)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, model, refusal, vehicle};
    use simbeeotic_model::kernel::SimTime;
    use simbeeotic_model::units::{
        Attitude, Enu, Mount, Offset, Pose, Position, RainRate, Time, Velocity, Yaw, math,
    };
    use simbeeotic_model::world::weather::rain;
    use simbeeotic_model::world::{Obstacle, ObstacleShape, Weather};
    use simbeeotic_model::{Bee, Handle, ModelPlan};
    use std::sync::Arc;

    type Range = Handle<Option<Length>>;

    /// A box of one metre whose middle is at `x`, `y` on the ground, `height` high.
    fn block(x: f64, y: f64, height: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz(x, y, 0.0),
            shape: ObstacleShape::Box {
                length: Length::si(1.0),
                width: Length::si(1.0),
                height: Length::si(height),
                rotation: Angle::ZERO,
            },
            ..Obstacle::default()
        }
    }

    fn still(params: &[(&'static str, &'static str)]) -> Trial {
        let mut all = vec![("sigma", "0 m")];
        all.extend_from_slice(params);
        Trial::of("range", &all)
    }

    fn rpy(roll: f64, pitch: f64, yaw: f64) -> Attitude {
        let degrees = Angle::from_degrees;
        Attitude::from_rpy(degrees(roll), degrees(pitch), Yaw::new(degrees(yaw)))
    }

    /// Metres; panics on nothing.
    fn metres(reading: Option<Length>) -> f64 {
        reading.expect("something is in range").get()
    }

    #[test]
    fn it_reads_the_distance_to_the_ground_along_its_axis_in_any_attitude() {
        still(&[("max_range", "30 m")]).run(|bee, sensor: Range| {
            for (roll, pitch, yaw) in [(0.0, 90.0, 0.0), (20.0, 30.0, 77.0), (-50.0, 60.0, 200.0)] {
                bee.set_attitude(rpy(roll, pitch, yaw));
                // Height over the sine of the angle below the horizon.
                let want = bee.position().si().z / math_sin(pitch);
                assert!((metres(bee.read(sensor)) - want).abs() < 1e-9, "{pitch}");
            }
            bee.set_attitude(rpy(0.0, -10.0, 0.0));
            assert_eq!(bee.read(sensor), None);
        });
    }

    fn math_sin(degrees: f64) -> f64 {
        math::sin(degrees.to_radians())
    }

    /// The original measured short by the root of two along (1, 1, 0), whose length is no 1.
    #[test]
    fn the_length_of_its_pointing_does_not_matter() {
        let mut trial = still(&[]);
        trial.mount = Mount::new(Offset::ZERO, rpy(0.0, 0.0, 45.0));
        trial.world.obstacles = vec![block(2.0, 2.0, 20.0)];
        trial.run(|bee, sensor: Range| {
            let want = 1.5 * 2.0_f64.sqrt();
            assert!((metres(bee.read(sensor)) - want).abs() < 1e-9);
        });
    }

    #[test]
    fn in_motion_it_reads_where_things_are_now() {
        let mut trial = still(&[("max_range", "30 m")]);
        trial.world.obstacles = vec![block(10.5, 0.0, 20.0)];
        trial.mount = Mount::new(Offset::from_xyz(0.1, 0.0, 0.0), Attitude::IDENTITY);
        (trial.every, trial.seconds) = (Time::from_millis(37.0), 4);
        trial.run(|bee, sensor: Range| {
            bee.set_velocity(Velocity::from_xyz(2.0, 0.0, 0.0));
            let want = 10.0 - 0.1 - bee.position().si().x;
            assert!((metres(bee.read(sensor)) - want).abs() < 1e-9);
        });
    }

    /// The original's rays passed through the hive, and through bees without collisions.
    #[test]
    fn it_sees_hives_and_bees_unless_told_otherwise() {
        for (sees, bee_at, hive_at) in [
            ("everything", Some(2950), Some(3500)),
            ("stations", None, Some(3500)),
            ("vehicles", Some(2950), None),
        ] {
            let mut trial = still(&[("sees", sees)]);
            trial.others = vec![
                vehicle(
                    "other",
                    "inert-bee",
                    &[("hover", "true")],
                    &[("contacts", "none")],
                    [3.0, 0.0, 10.0],
                ),
                ModelPlan {
                    start: Pose::new(
                        Position::from_xyz(0.0, 4.0, 10.05 - 0.5),
                        Attitude::IDENTITY,
                    ),
                    ..model("hive", "simple-hive")
                },
            ];
            trial.run(move |bee, sensor: Range| {
                let look = |bee: &mut Bee<'_>, yaw| {
                    bee.set_attitude(rpy(0.0, 0.0, yaw));
                    bee.read(sensor)
                        .map(|read| read.millimetres().round() as i64)
                };
                assert_eq!(look(bee, 0.0), bee_at, "{sees}");
                assert_eq!(look(bee, 90.0), hive_at, "{sees}");
            });
        }
    }

    /// The original read nothing at all while its body touched something within a centimetre of it.
    #[test]
    fn what_touches_the_sensor_is_seen() {
        let mut trial = still(&[("min_range", "0 m")]);
        // The bee is a ball of 5 cm; the wall is half a millimetre from its front.
        trial.world.obstacles = vec![block(0.55, 0.0, 20.0)];
        trial.mount = Mount::new(Offset::from_xyz(0.049, 0.0, 0.0), Attitude::IDENTITY);
        trial.run(|bee, sensor: Range| {
            assert!((metres(bee.read(sensor)) - 0.001).abs() < 1e-6);
            bee.set_attitude(rpy(0.0, 0.0, 180.0));
            assert_eq!(bee.read(sensor), None);
        });
    }

    #[test]
    fn nearer_than_the_least_range_is_nothing_or_the_least_range() {
        for (too_near, want) in [("nothing", None), ("clamp", Some(Length::si(0.6)))] {
            let mut trial = still(&[("too_near", too_near), ("min_range", "0.6 m")]);
            trial.world.obstacles = vec![block(1.0, 0.0, 20.0)];
            trial.run(move |bee, sensor: Range| assert_eq!(bee.read(sensor), want));
        }
    }

    #[test]
    fn beyond_its_range_it_reads_nothing() {
        for (x, seen) in [(5.45, true), (5.55, false)] {
            let mut trial = still(&[]);
            trial.world.obstacles = vec![block(x, 0.0, 20.0)];
            trial.run(move |bee, sensor: Range| assert_eq!(bee.read(sensor).is_some(), seen));
        }
    }

    #[test]
    fn a_cone_sees_what_stands_beside_its_axis() {
        // The block's side is 0.5 m from the axis: its near edge 11.3 degrees off it, its far edge 8.1.
        for (width, seen) in [("0 deg", false), ("16 deg", false), ("27 deg", true)] {
            let mut trial = still(&[("field_of_view", width), ("rays", "400")]);
            trial.world.obstacles = vec![block(3.0, 1.0, 20.0)];
            trial.run(move |bee, sensor: Range| {
                let read = bee.read(sensor);
                assert_eq!(read.is_some(), seen, "{width}");
                if let Some(read) = read {
                    // Its nearest point in the cone is the edge.
                    let edge = (2.5_f64 * 2.5 + 0.25).sqrt();
                    assert!((read.get() - edge).abs() < 0.02, "{read}");
                }
            });
        }
    }

    #[test]
    fn the_mean_of_a_cone_weighs_the_light_that_comes_back() {
        let params = [
            ("field_of_view", "60 deg"),
            ("rays", "4000"),
            ("echo", "mean"),
            ("max_range", "50 m"),
        ];
        still(&params).run(|bee, sensor: Range| {
            bee.set_attitude(rpy(0.0, 90.0, 0.0));
            // Straight down from h: x = h / c, w = c^3 / h^2 at the cosine c, even in c from c0 to 1:
            // mean = h (1 - c0^3) / 3 / ((1 - c0^4) / 4).
            let c0 = 0.75_f64.sqrt();
            let h = bee.position().si().z;
            let want = h * 4.0 / 3.0 * (1.0 - c0 * c0 * c0) / (1.0 - c0 * c0 * c0 * c0);
            let read = metres(bee.read(sensor));
            assert!((read / want - 1.0).abs() < 1e-3, "{read} for {want}");
        });
    }

    #[test]
    fn surfaces_that_are_met_too_flat_send_nothing_back() {
        let params = [("max_incidence", "60 deg"), ("max_range", "100 m")];
        still(&params).run(|bee, sensor: Range| {
            for (pitch, seen) in [(31.0, true), (29.0, false)] {
                bee.set_attitude(rpy(0.0, pitch, 0.0));
                assert_eq!(bee.read(sensor).is_some(), seen, "{pitch}");
            }
        });
    }

    #[test]
    fn its_readings_spread_as_it_says_in_two_attitudes() {
        let params = [
            ("sigma", "3 cm"),
            ("sigma_fraction", "0.004"),
            ("max_range", "30 m"),
        ];
        Trial::of("range", &params).run(|bee, sensor: Range| {
            for pitch in [90.0, 30.0] {
                bee.set_attitude(rpy(0.0, pitch, 40.0));
                let truth = bee.position().si().z / math_sin(pitch);
                let readings: Vec<f64> = (0..100_000).map(|_| metres(bee.read(sensor))).collect();
                let far = 0.004 * truth;
                assert_normal(&readings, truth, (9e-4 + far * far).sqrt());
            }
        });
    }

    /// The same rain everywhere.
    #[derive(Debug)]
    struct Rain(f64);

    impl Weather for Rain {
        fn wind(&self, _at: Position, _time: SimTime) -> Velocity<Enu> {
            Velocity::ZERO
        }

        fn rain(&self, _at: Position, _time: SimTime) -> RainRate {
            RainRate::si(self.0)
        }
    }

    #[test]
    fn rain_shortens_its_range_and_adds_noise() {
        let visible = rain::visible_range(RainRate::si(50.0), Length::si(200.0)).get();
        assert!(visible < 190.0, "{visible}");
        for (height, seen) in [(visible - 1.0, true), (visible + 1.0, false)] {
            let mut trial = still(&[("max_range", "200 m")]);
            trial.weather = Arc::new(Rain(50.0));
            trial.at = [0.0, 0.0, height];
            trial.run(move |bee, sensor: Range| {
                bee.set_attitude(rpy(0.0, 90.0, 0.0));
                // 2 % of noise are 4 m: near the end of the range only half of the readings count.
                let readings: Vec<_> = (0..1000).filter_map(|_| bee.read(sensor)).collect();
                assert_eq!(!readings.is_empty(), seen, "{height}");
            });
        }
        let mut trial = still(&[("max_range", "200 m")]);
        trial.weather = Arc::new(Rain(2.0));
        trial.run(|bee, sensor: Range| {
            bee.set_attitude(rpy(0.0, 90.0, 0.0));
            let truth = bee.position().si().z;
            let sigma = rain::range_sigma(RainRate::si(2.0), Length::si(truth)).get();
            let readings: Vec<f64> = (0..100_000).map(|_| metres(bee.read(sensor))).collect();
            assert_normal(&readings, truth, sigma);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("max_range", "0 m"),
            ("max_range", "1e9 m"),
            ("min_range", "-1 m"),
            ("min_range", "6 m"),
            ("sigma", "-1 cm"),
            ("sigma_fraction", "-0.1"),
            ("bias_sigma", "-1 cm"),
            ("step", "-1 mm"),
            ("lost", "1.5"),
            ("too_near", "far"),
            ("field_of_view", "200 deg"),
            ("rays", "0"),
            ("echo", "last"),
            ("max_incidence", "0 deg"),
            ("max_incidence", "100 deg"),
            ("sees", "bees"),
        ] {
            let refusal = refusal("range", &[(key, value)]).expect("it is refused");
            assert!(
                refusal.contains(key) || refusal.contains("unknown choice"),
                "{key}: {refusal}"
            );
        }
        assert!(refusal("range", &[]).is_none());
    }
}
