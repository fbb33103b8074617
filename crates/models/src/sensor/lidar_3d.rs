//! Laser scanners with several rows of rays.
//!
//! | preset | source |
//! |---|---|
//! | `vlp-16` | Velodyne VLP-16 user manual 63-9243, Rev. D: 16 rows from -15 to 15 degrees, 0.2 degrees in azimuth at 10 turns a second (1,800 columns), to 100 m, +-3 cm typical, steps of 2 mm, 8 W at 12 V; least range 1 m (figures quoted from memory) |
//! | `mid-360` | Livox Mid-360 user manual, v1.2: 360 degrees by -7 to 52, 0.1 to 40 m at 10 % reflectivity, range error 2 cm (one sigma), 200,000 points a second, 6.5 W at 12 V (from memory); its rosette of points is stood in for by a grid of 20 rows of 1,000 |
//!
//! A +- is read as two sigma.

use super::echo::{Ranger, Ranging, TooNear};
use super::scan::{FULL_TURN, Scan, ScanGrid, Scanner};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Current, Length};
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Truth, choice, params, sensor};

/// A laser scanner of several rows: `rows` of rays by elevation, `rays` in each by azimuth. The reading is a
/// [`Scan`], with its points in the sensor's frame.
///
/// All rays are those of one instant; that a real one turns during its scan is not modelled. Rain shortens
/// its range and adds to its errors (equations 1 to 3 of the module `echo`).
#[sensor("lidar-3d")]
pub struct Lidar3d {
    scanner: Scanner,
    current: Current,
}

/// Parameters of [`Lidar3d`]. What is left out is the preset's.
#[params]
pub struct Lidar3dParams {
    /// The device whose numbers hold for what is not given here: `vlp-16`, `mid-360`.
    pub preset: Lidar3dPreset,
    /// How many rays a row has; at most 1,000,000 in all rows.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rays: Option<u32>,
    /// The azimuth of the first ray of a row, counter-clockwise from the forward axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<Angle>,
    /// The azimuth of the last ray of a row, at most a full turn from `start`. After a full turn the last ray
    /// is one step short of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<Angle>,
    /// How many rows there are.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<u32>,
    /// The elevation of the first row, from the sensor's horizontal plane; negative is below it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lowest: Option<Angle>,
    /// The elevation of the last row.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub highest: Option<Angle>,
    /// The least range; what is nearer is not seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min_range: Option<Length>,
    /// The greatest range. What is farther is not seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max_range: Option<Length>,
    /// Standard deviation of a distance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma: Option<Length>,
    /// The part of the standard deviation that grows with the distance: a fraction of it.
    pub sigma_fraction: f64,
    /// Distances are multiples of this; zero: they are not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<Length>,
    /// Standard deviation of the constant error that each sensor has.
    pub bias_sigma: Length,
    /// Probability that a distance is nothing although something is there, 0 to 1.
    pub lost: f64,
    /// Kinds of things that it sees; rays pass through the rest.
    pub sees: SeesWhat,
}

/// A device of several rows.
#[choice]
pub enum Lidar3dPreset {
    /// Velodyne VLP-16.
    #[serde(rename = "vlp-16")]
    Vlp16,
    /// Livox Mid-360.
    #[serde(rename = "mid-360")]
    Mid360,
}

impl Default for Lidar3dParams {
    fn default() -> Self {
        Self {
            preset: Lidar3dPreset::Vlp16,
            rays: None,
            start: None,
            end: None,
            rows: None,
            lowest: None,
            highest: None,
            min_range: None,
            max_range: None,
            sigma: None,
            sigma_fraction: 0.0,
            step: None,
            bias_sigma: Length::ZERO,
            lost: 0.0,
            sees: SeesWhat::EVERYTHING,
        }
    }
}

/// What a device's papers say.
struct Device {
    rays: u32,
    rows: u32,
    elevations_deg: (f64, f64),
    ranges_m: (f64, f64),
    sigma_m: f64,
    step_m: f64,
    current_a: f64,
}

impl Lidar3dPreset {
    const fn device(self) -> Device {
        match self {
            Self::Vlp16 => Device {
                rays: 1800,
                rows: 16,
                elevations_deg: (-15.0, 15.0),
                ranges_m: (1.0, 100.0),
                sigma_m: 0.015,
                step_m: 0.002,
                current_a: 8.0 / 12.0,
            },
            Self::Mid360 => Device {
                rays: 1000,
                rows: 20,
                elevations_deg: (-7.0, 52.0),
                ranges_m: (0.1, 40.0),
                sigma_m: 0.02,
                step_m: 0.0,
                current_a: 6.5 / 12.0,
            },
        }
    }
}

impl Sensor for Lidar3d {
    type Params = Lidar3dParams;
    type Reading = Scan;

    fn build(params: Lidar3dParams) -> Result<Self, BuildError> {
        let device = params.preset.device();
        let (start, end) = FULL_TURN;
        let azimuths = (
            params.start.unwrap_or(start),
            params.end.unwrap_or(end),
            params.rays.unwrap_or(device.rays),
        );
        let (lowest, highest) = device.elevations_deg;
        let elevations = (
            params.lowest.unwrap_or(Angle::from_degrees(lowest)),
            params.highest.unwrap_or(Angle::from_degrees(highest)),
            params.rows.unwrap_or(device.rows),
        );
        let (nearest, farthest) = device.ranges_m;
        let ranger = Ranger::new(Ranging {
            min_range: params.min_range.unwrap_or(Length::si(nearest)),
            max_range: params.max_range.unwrap_or(Length::si(farthest)),
            sigma: params.sigma.unwrap_or(Length::si(device.sigma_m)),
            sigma_fraction: params.sigma_fraction,
            bias_sigma: params.bias_sigma,
            step: params.step.unwrap_or(Length::si(device.step_m)),
            lost: params.lost,
            too_near: TooNear::Nothing,
        })?;
        let scanner = Scanner {
            grid: ScanGrid::new(azimuths, elevations)?,
            ranger,
            sees: params.sees,
        };
        Ok(Self {
            scanner,
            current: Current::si(device.current_a),
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Scan {
        self.scanner.ideal(truth)
    }

    fn measure(&mut self, ideal: Scan, truth: &Truth<'_>, rng: &mut Stream) -> Scan {
        self.scanner.measure(ideal, truth, rng)
    }

    fn current(&self) -> Current {
        self.current
    }

    fn beams(&self) -> Option<Beams> {
        Some(self.scanner.beams())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Offset, Position, Time, Velocity, Yaw, math};
    use simbeeotic_model::world::{Obstacle, ObstacleShape};

    fn ball(x: f64, y: f64, radius: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz(x, y, 0.0),
            shape: ObstacleShape::Sphere {
                radius: Length::si(radius),
            },
            ..Obstacle::default()
        }
    }

    #[test]
    fn its_rows_see_the_ground_at_height_over_sine_in_any_attitude_and_in_motion() {
        let params = [("sigma", "0 m"), ("step", "0 m"), ("rays", "36")];
        let mut trial = Trial::of("lidar-3d", &params);
        (trial.every, trial.seconds) = (Time::from_millis(300.0), 2);
        trial.run(|bee, sensor: Handle<Scan>| {
            bee.set_velocity(Velocity::from_xyz(1.0, -2.0, 0.5));
            let h = bee.position().si().z;
            for yaw in [0.0, 123.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                let scan = bee.read(sensor);
                assert_eq!((scan.rows(), scan.columns()), (16, 36));
                for (row, want_deg) in (0..16).map(|row| (row, -15.0 + 2.0 * row as f64)) {
                    let (_, elevation) = scan.directions().nth(36 * row).expect("a row");
                    assert!((elevation.degrees() - want_deg).abs() < 1e-9);
                    let far = -h / math::sin(want_deg.to_radians());
                    for column in 0..36 {
                        match scan.distance(row, column) {
                            Some(read) => assert!((read.get() - far).abs() < 1e-6),
                            None => assert!(!(0.0..=100.0).contains(&far), "{far}"),
                        }
                    }
                }
            }
            // Tilted by 90 degrees, half of each row looks down.
            bee.set_attitude(Attitude::from_rpy(
                Angle::from_degrees(90.0),
                Angle::ZERO,
                Yaw::new(Angle::ZERO),
            ));
            let scan = bee.read(sensor);
            for ((azimuth, elevation), read) in scan.directions().zip(scan.distances()) {
                // Left is up now: what looked left looks up.
                let up = math::cos(elevation.get()) * math::sin(azimuth.get());
                let far = -h / up;
                assert_eq!(read.is_some(), (1.0..=100.0).contains(&far), "{far}");
                assert!(read.is_none_or(|read| (read.get() - far).abs() < 1e-6));
            }
        });
    }

    #[test]
    fn its_points_lie_on_what_it_sees() {
        let params = [("sigma", "0 m"), ("step", "0 m"), ("sees", "obstacles")];
        let mut trial = Trial::of("lidar-3d", &params);
        trial.at = [0.0, 0.0, 0.95];
        trial.world.obstacles = vec![ball(8.0, 3.0, 1.0)];
        trial.run(|bee, sensor: Handle<Scan>| {
            bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(30.0))));
            let points: Vec<Offset> = bee.read(sensor).points().collect();
            // A disc of 6.72 degrees on a grid of 0.2 by 2 degrees holds 355.
            assert!((335..375).contains(&points.len()), "{}", points.len());
            let pose = bee.pose();
            for point in points {
                let d = pose.to_world(point).si() - glam::DVec3::new(8.0, 3.0, 1.0);
                assert!((d.length() - 1.0).abs() < 1e-6, "{d}");
            }
        });
    }

    #[test]
    fn a_vlp_16_has_the_range_and_the_errors_of_its_datasheet() {
        let params = [
            ("rays", "1"),
            ("rows", "1"),
            ("lowest", "0 deg"),
            ("highest", "0 deg"),
        ];
        for (x, seen) in [(101.0, true), (101.2, false)] {
            let mut trial = Trial::of("lidar-3d", &params);
            trial.at = [0.0, 0.0, 0.95];
            trial.world.obstacles = vec![ball(x, 0.0, 1.0)];
            trial.run(move |bee, sensor: Handle<Scan>| {
                // At the very end of the range, half of the readings are beyond it.
                let mut any = (0..50).filter_map(|_| bee.read(sensor).distance(0, 0));
                assert_eq!(any.next().is_some(), seen);
            });
        }
        let mut trial = Trial::of("lidar-3d", &params);
        trial.at = [0.0, 0.0, 0.95];
        trial.world.obstacles = vec![ball(51.0, 0.0, 1.0)];
        trial.run(|bee, sensor: Handle<Scan>| {
            let read = |_| bee.read(sensor).distance(0, 0).expect("the ball").get();
            let readings: Vec<f64> = (0..100_000).map(read).collect();
            assert_normal(&readings, 50.0, (0.015 * 0.015 + 4e-6 / 12.0_f64).sqrt());
        });
    }

    #[test]
    fn the_other_preset_looks_up_to_52_degrees() {
        let params = [("preset", "mid-360"), ("rays", "4")];
        Trial::of("lidar-3d", &params).run(|bee, sensor: Handle<Scan>| {
            let scan = bee.read(sensor);
            let (_, last) = scan.directions().last().expect("many");
            assert!(scan.rows() == 20 && (last.degrees() - 52.0).abs() < 1e-9);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("rays", "0"),
            ("rows", "0"),
            ("rows", "1000"),
            ("start", "1000 deg"),
            ("end", "-1 deg"),
            ("lowest", "-91 deg"),
            ("highest", "-16 deg"),
            ("highest", "91 deg"),
            ("max_range", "0.5 m"),
            ("min_range", "-1 m"),
            ("sigma", "-1 m"),
            ("sigma_fraction", "-1"),
            ("step", "-1 m"),
            ("bias_sigma", "-1 m"),
            ("lost", "2"),
        ] {
            let refusal = refusal("lidar-3d", &[(key, value)]).expect("it is refused");
            let ranges = key == "max_range" && refusal.contains("min_range");
            assert!(refusal.contains(key) || ranges, "{key}: {refusal}");
        }
    }
}
