//! A ring of range finders that look out in the horizontal plane.

use super::echo::{Ranger, Ranging, TooNear};
use super::scan::{FULL_TURN, Scan, ScanGrid, Scanner};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Length};
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Truth, params, sensor};

/// Measures the distances all around in its own horizontal plane: `rays` rays at even angles, the first
/// along the forward axis, on counter-clockwise. The reading is a [`Scan`] of one row.
///
/// Made for swarms: it costs its rays and little else.
#[sensor("ring")]
pub struct Ring {
    scanner: Scanner,
}

/// Parameters of [`Ring`].
#[params]
pub struct RingParams {
    /// How many rays it has, 1 to 1,000,000.
    pub rays: u32,
    /// The least range; what is nearer reads as this.
    pub min_range: Length,
    /// The greatest range. What is farther is not seen.
    pub max_range: Length,
    /// Standard deviation of a distance.
    pub sigma: Length,
    /// The part of the standard deviation that grows with the distance: a fraction of it.
    pub sigma_fraction: f64,
    /// Distances are multiples of this; zero: they are not.
    pub step: Length,
    /// Probability that a distance is nothing although something is there, 0 to 1.
    pub lost: f64,
    /// Kinds of things that it sees; rays pass through the rest.
    pub sees: SeesWhat,
}

impl Default for RingParams {
    fn default() -> Self {
        Self {
            rays: 8,
            min_range: Length::si(0.04),
            max_range: Length::si(4.0),
            sigma: Length::si(0.01),
            sigma_fraction: 0.0,
            step: Length::ZERO,
            lost: 0.0,
            sees: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for Ring {
    type Params = RingParams;
    type Reading = Scan;

    fn build(params: RingParams) -> Result<Self, BuildError> {
        let (start, end) = FULL_TURN;
        let grid = ScanGrid::new((start, end, params.rays), (Angle::ZERO, Angle::ZERO, 1))?;
        let ranger = Ranger::new(Ranging {
            min_range: params.min_range,
            max_range: params.max_range,
            sigma: params.sigma,
            sigma_fraction: params.sigma_fraction,
            bias_sigma: Length::ZERO,
            step: params.step,
            lost: params.lost,
            too_near: TooNear::Clamp,
        })?;
        let sees = params.sees;
        Ok(Self {
            scanner: Scanner { grid, ranger, sees },
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Scan {
        self.scanner.ideal(truth)
    }

    fn measure(&mut self, ideal: Scan, truth: &Truth<'_>, rng: &mut Stream) -> Scan {
        self.scanner.measure(ideal, truth, rng)
    }

    fn beams(&self) -> Option<Beams> {
        Some(self.scanner.beams())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::units::{Attitude, Position, Time, Velocity, Yaw, math};
    use simbeeotic_model::world::{Obstacle, ObstacleShape};
    use simbeeotic_model::{Handle, Reading};

    /// A pillar about (x, y).
    fn pillar(x: f64, y: f64, radius: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz(x, y, 0.0),
            shape: ObstacleShape::Cylinder {
                diameter: Length::si(2.0 * radius),
                height: Length::si(20.0),
            },
            ..Obstacle::default()
        }
    }

    #[test]
    fn its_rays_go_round_from_forward_and_meet_a_pillar_where_a_line_meets_a_circle() {
        let mut trial = Trial::of("ring", &[("sigma", "0 m"), ("rays", "12")]);
        trial.world.obstacles = vec![pillar(2.0, 1.0, 0.6)];
        (trial.every, trial.seconds) = (Time::from_millis(100.0), 3);
        trial.run(|bee, sensor: Handle<Scan>| {
            bee.set_velocity(Velocity::from_xyz(0.1, -0.2, 0.0));
            for degrees in [0.0, 47.0] {
                let yaw = Yaw::new(Angle::from_degrees(degrees));
                bee.set_attitude(Attitude::from_yaw(yaw));
                let scan = bee.read(sensor);
                assert_eq!((scan.rows(), scan.columns()), (1, 12));
                let p = bee.position().si();
                let (x, y) = (2.0 - p.x, 1.0 - p.y);
                for at in 0..12 {
                    let turn = (degrees + 30.0 * at as f64).to_radians();
                    let (sin, cos) = math::sin_cos(turn);
                    let (along, aside) = (x * cos + y * sin, x * sin - y * cos);
                    let want = (along > 0.0 && aside.abs() < 0.6)
                        .then(|| along - (0.36 - aside * aside).sqrt())
                        .filter(|want| *want < 4.0);
                    match (scan.distance(0, at), want) {
                        (Some(read), Some(want)) => assert!((read.get() - want).abs() < 1e-9),
                        (read, want) => {
                            assert!(read.is_none() && want.is_none(), "{read:?} {want:?}")
                        }
                    }
                }
            }
        });
    }

    #[test]
    fn a_scan_tells_the_nearest_the_points_and_the_rows_of_a_recording() {
        let mut trial = Trial::of("ring", &[("sigma", "0 m")]);
        trial.world.obstacles = vec![pillar(0.0, 2.0, 0.5), pillar(-3.0, 0.0, 0.5)];
        trial.run(|bee, sensor: Handle<Scan>| {
            let scan = bee.read(sensor);
            let nearest = scan.nearest().expect("a pillar");
            assert!((nearest.azimuth.degrees() - 90.0).abs() < 1e-9);
            assert!((nearest.distance.get() - 1.5).abs() < 1e-9);
            let points: Vec<_> = scan.points().map(|p| p.si().round().to_array()).collect();
            assert_eq!(
                points,
                [[0.0, 2.0, 0.0], [-3.0, 0.0, 0.0]].map(|p: [f64; 3]| p)
            );
            assert_eq!(scan.echoes().count(), 2);
            assert_eq!((scan.distance(0, 8), scan.distance(1, 0)), (None, None));
            let mut row = Vec::new();
            scan.numbers(&mut row);
            assert_eq!(row.len(), 8 * Scan::COLUMNS.len());
            assert!(
                (row[2].is_nan(), row[8])
                    == (
                        true,
                        scan.distances().nth(2).flatten().expect("a pillar").get()
                    )
            );
        });
    }

    #[test]
    fn each_distance_has_an_error_of_its_own() {
        let mut trial = Trial::of("ring", &[("sigma", "2 cm"), ("rays", "2")]);
        trial.world.obstacles = vec![pillar(2.0, 0.0, 0.5), pillar(-3.0, 0.0, 0.5)];
        trial.run(|bee, sensor: Handle<Scan>| {
            for degrees in [0.0, 180.0] {
                let yaw = Yaw::new(Angle::from_degrees(degrees));
                bee.set_attitude(Attitude::from_yaw(yaw));
                let scans: Vec<Scan> = (0..100_000).map(|_| bee.read(sensor)).collect();
                let truths = if degrees == 0.0 {
                    [1.5, 2.5]
                } else {
                    [2.5, 1.5]
                };
                let of = |at| move |scan: &Scan| scan.distance(0, at).expect("a pillar").get();
                let [ahead, behind] =
                    [0, 1].map(|at| scans.iter().map(of(at)).collect::<Vec<f64>>());
                assert_normal(&ahead, truths[0], 0.02);
                assert_normal(&behind, truths[1], 0.02);
                let pairs = ahead.iter().zip(&behind);
                let product: f64 = pairs.map(|(a, b)| (a - truths[0]) * (b - truths[1])).sum();
                assert!(
                    (product / 1e5).abs() < 4.0 * 4e-4 / 1e5_f64.sqrt(),
                    "{product}"
                );
            }
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("rays", "0"),
            ("max_range", "-1 m"),
            ("min_range", "5 m"),
            ("sigma", "-1 m"),
            ("sigma_fraction", "-1"),
            ("step", "-1 m"),
            ("lost", "2"),
        ] {
            let refusal = refusal("ring", &[(key, value)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}
