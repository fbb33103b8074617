//! Laser scanners in a plane.
//!
//! | preset | source |
//! |---|---|
//! | `laser-range-sensor` | the original's `LaserRangeSensor`: 181 rays from -90 to 90 degrees, 0.2 to 20 m, sigma 5 cm |
//! | `urg-04lx` | Hokuyo URG-04LX: 1024 steps a turn, of which 44 to 725 about 384 are measured (communication protocol C-42-03320B, p. 21); 20 to 4095 mm, +-10 mm to 1 m, +-1 % beyond, 1 mm, 10 scans a second, 500 mA (specification C-42-3389, quoted from memory) |
//! | `rplidar-a1` | Slamtec RPLIDAR A1M8 (LD108 datasheet, p. 7): 0.15 to 12 m, 360 degrees, 1 degree at 5.5 scans a second, less than 1 % of the distance; 0.4 A with its motor (from memory) |
//!
//! A +- is read as two sigma. The URG-04LX's two are the greater of 5 mm and 0.5 %; here both add in squares:
//! 1.4 times the sheet's at 1 m, less elsewhere.

use super::echo::{Ranger, Ranging, TooNear};
use super::scan::{FULL_TURN, Scan, ScanGrid, Scanner};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Current, Length};
use simbeeotic_model::{Beams, BuildError, SeesWhat, Sensor, Truth, choice, params, sensor};

/// A laser scanner: measures the distances in its own horizontal plane, from `start` to `end` in azimuth.
/// The reading is a [`Scan`] of one row.
///
/// All rays are those of one instant; that a real one turns during its scan is not modelled. Rain shortens
/// its range and adds to its errors (equations 1 to 3 of the module `echo`).
#[sensor(
    "lidar",
    java = "harvard.robobees.simbeeotic.model.sensor.LaserRangeSensor",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultLaserRangeSensor"
)]
pub struct Lidar {
    scanner: Scanner,
    current: Current,
}

/// Parameters of [`Lidar`]. What is left out is the preset's.
#[params]
pub struct LidarParams {
    /// The device whose numbers hold for what is not given here: `laser-range-sensor` (the original's),
    /// `urg-04lx`, `rplidar-a1`.
    pub preset: LidarPreset,
    /// How many rays a scan has, 1 to 1,000,000.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rays: Option<u32>,
    /// The azimuth of the first ray, counter-clockwise from the forward axis.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start: Option<Angle>,
    /// The azimuth of the last ray, at most a full turn from `start`. After a full turn the last ray is one
    /// step short of it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<Angle>,
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
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sigma_fraction: Option<f64>,
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

/// A device in a plane.
#[choice]
pub enum LidarPreset {
    /// The original's.
    LaserRangeSensor,
    /// Hokuyo URG-04LX.
    #[serde(rename = "urg-04lx")]
    Urg04lx,
    /// Slamtec RPLIDAR A1M8.
    RplidarA1,
}

impl Default for LidarParams {
    fn default() -> Self {
        Self {
            preset: LidarPreset::LaserRangeSensor,
            rays: None,
            start: None,
            end: None,
            min_range: None,
            max_range: None,
            sigma: None,
            sigma_fraction: None,
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
    azimuths: (Angle, Angle),
    ranges: (f64, f64),
    sigma_m: f64,
    sigma_fraction: f64,
    step_m: f64,
    current: Current,
}

impl LidarPreset {
    fn device(self) -> Device {
        let degrees = Angle::from_degrees;
        match self {
            Self::LaserRangeSensor => Device {
                rays: 181,
                azimuths: (degrees(-90.0), degrees(90.0)),
                ranges: (0.2, 20.0),
                sigma_m: 0.05,
                sigma_fraction: 0.0,
                step_m: 0.0,
                current: Current::ZERO,
            },
            Self::Urg04lx => Device {
                rays: 725 - 44 + 1,
                azimuths: (
                    degrees((44.0 - 384.0) * 360.0 / 1024.0),
                    degrees((725.0 - 384.0) * 360.0 / 1024.0),
                ),
                ranges: (0.02, 4.095),
                sigma_m: 0.005,
                sigma_fraction: 0.005,
                step_m: 0.001,
                current: Current::si(0.5),
            },
            Self::RplidarA1 => Device {
                rays: 360,
                azimuths: FULL_TURN,
                ranges: (0.15, 12.0),
                sigma_m: 0.0,
                sigma_fraction: 0.005,
                step_m: 0.0,
                current: Current::si(0.4),
            },
        }
    }
}

impl Sensor for Lidar {
    type Params = LidarParams;
    type Reading = Scan;

    fn build(params: LidarParams) -> Result<Self, BuildError> {
        let device = params.preset.device();
        let (start, end) = device.azimuths;
        let azimuths = (
            params.start.unwrap_or(start),
            params.end.unwrap_or(end),
            params.rays.unwrap_or(device.rays),
        );
        let grid = ScanGrid::new(azimuths, (Angle::ZERO, Angle::ZERO, 1))?;
        let (nearest, farthest) = device.ranges;
        let ranger = Ranger::new(Ranging {
            min_range: params.min_range.unwrap_or(Length::si(nearest)),
            max_range: params.max_range.unwrap_or(Length::si(farthest)),
            sigma: params.sigma.unwrap_or(Length::si(device.sigma_m)),
            sigma_fraction: params.sigma_fraction.unwrap_or(device.sigma_fraction),
            bias_sigma: params.bias_sigma,
            step: params.step.unwrap_or(Length::si(device.step_m)),
            lost: params.lost,
            too_near: TooNear::Nothing,
        })?;
        let sees = params.sees;
        Ok(Self {
            scanner: Scanner { grid, ranger, sees },
            current: device.current,
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
    use simbeeotic_model::kernel::SimTime;
    use simbeeotic_model::units::{Attitude, Enu, Position, RainRate, Time, Velocity, Yaw, math};
    use simbeeotic_model::world::weather::rain;
    use simbeeotic_model::world::{Obstacle, ObstacleShape, Weather};
    use std::sync::Arc;

    /// A screen across the way at `x`, endless for all that see it.
    fn screen(x: f64) -> Obstacle {
        Obstacle {
            position: Position::from_xyz(x + 0.05, 0.0, 0.0),
            shape: ObstacleShape::Box {
                length: Length::si(0.1),
                width: Length::si(1000.0),
                height: Length::si(20.0),
                rotation: Angle::ZERO,
            },
            ..Obstacle::default()
        }
    }

    /// Distance to the screen along each ray, by its azimuth.
    fn assert_screen(scan: &Scan, gap: f64, yaw_deg: f64, range: (f64, f64)) {
        for ((azimuth, elevation), read) in scan.directions().zip(scan.distances()) {
            assert_eq!(elevation, Angle::ZERO);
            let cos = math::cos(azimuth.get() + yaw_deg.to_radians());
            let want = gap / cos;
            if want > range.0 && want < range.1 - 1e-9 {
                let read = read.expect("the screen").get();
                assert!((read - want).abs() < 1e-6, "{read} for {want}");
            } else if want < 0.0 || want > range.1 + 1e-9 {
                assert_eq!(read, None, "{azimuth}");
            }
        }
    }

    #[test]
    fn it_reads_a_flat_wall_as_one_over_the_cosine_in_any_attitude_and_in_motion() {
        let mut trial = Trial::of("lidar", &[("sigma", "0 m")]);
        trial.world.obstacles = vec![screen(5.0)];
        (trial.every, trial.seconds) = (Time::from_millis(200.0), 3);
        trial.run(|bee, sensor: Handle<Scan>| {
            bee.set_velocity(Velocity::from_xyz(0.5, 0.3, 0.0));
            for yaw in [0.0, 65.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                let scan = bee.read(sensor);
                assert_eq!((scan.rows(), scan.columns()), (1, 181));
                let azimuths: Vec<_> = scan
                    .directions()
                    .map(|(a, _)| a.degrees().round())
                    .collect();
                assert_eq!(
                    (azimuths[0], azimuths[90], azimuths[180]),
                    (-90.0, 0.0, 90.0)
                );
                assert_screen(&scan, 5.0 - bee.position().si().x, yaw, (0.2, 20.0));
            }
            // On its side it scans up and down: the ground is 10 m below.
            bee.set_attitude(Attitude::from_rpy(
                Angle::from_degrees(90.0),
                Angle::ZERO,
                Yaw::new(Angle::ZERO),
            ));
            let scan = bee.read(sensor);
            let down = scan.distance(0, 0).expect("the ground").get();
            assert!((down - bee.position().si().z).abs() < 1e-9, "{down}");
        });
    }

    #[test]
    fn presets_have_the_rays_of_their_datasheets() {
        for (preset, rays, first, last, farthest) in [
            ("urg-04lx", 682, -119.531_25, 119.882_812_5, 4.095),
            ("rplidar-a1", 360, 0.0, 359.0, 12.0),
        ] {
            for (x, seen) in [(farthest - 0.2, true), (farthest + 0.01, false)] {
                let mut trial = Trial::of("lidar", &[("preset", preset)]);
                trial.world.obstacles = vec![screen(x)];
                trial.run(move |bee, sensor: Handle<Scan>| {
                    let scan = bee.read(sensor);
                    let azimuths: Vec<_> = scan.directions().map(|(a, _)| a.degrees()).collect();
                    assert_eq!(azimuths.len(), rays);
                    assert!((azimuths[0] - first).abs() < 1e-9);
                    assert!((azimuths[rays - 1] - last).abs() < 1e-9);
                    assert_eq!(scan.nearest().is_some(), seen);
                });
            }
        }
        let params = [("preset", "urg-04lx"), ("rays", "3"), ("max_range", "20 m")];
        let mut trial = Trial::of("lidar", &params);
        trial.world.obstacles = vec![screen(10.0)];
        trial.run(|bee, sensor: Handle<Scan>| {
            let scan = bee.read(sensor);
            assert_eq!(scan.columns(), 3);
            let ahead = scan.distance(0, 1).expect("the screen").get();
            assert!((ahead - 10.0).abs() < 0.25, "{ahead}");
        });
    }

    #[test]
    fn a_preset_spreads_as_its_datasheet_says() {
        for (preset, truth, sigma, step) in [
            ("laser-range-sensor", 8.0, 0.05, 0.0),
            ("urg-04lx", 2.0, (25e-6 + 1e-4_f64).sqrt(), 1e-3),
            ("rplidar-a1", 8.0, 0.04, 0.0),
        ] {
            let params = [
                ("preset", preset),
                ("rays", "1"),
                ("start", "0 deg"),
                ("end", "0 deg"),
            ];
            let mut trial = Trial::of("lidar", &params);
            trial.world.obstacles = vec![screen(truth)];
            trial.run(move |bee, sensor: Handle<Scan>| {
                let read = |_| bee.read(sensor).distance(0, 0).expect("the screen").get();
                let readings: Vec<f64> = (0..100_000).map(read).collect();
                let sigma = (sigma * sigma + step * step / 12.0_f64).sqrt();
                assert_normal(&readings, truth, sigma);
            });
        }
    }

    #[derive(Debug)]
    struct Rain;

    impl Weather for Rain {
        fn wind(&self, _at: Position, _time: SimTime) -> Velocity<Enu> {
            Velocity::ZERO
        }

        fn rain(&self, _at: Position, _time: SimTime) -> RainRate {
            RainRate::si(30.0)
        }
    }

    #[test]
    fn rain_blurs_and_shortens_a_scan() {
        let params = [
            ("sigma", "0 m"),
            ("max_range", "100 m"),
            ("rays", "1"),
            ("start", "0 deg"),
            ("end", "0 deg"),
        ];
        let visible = rain::visible_range(RainRate::si(30.0), Length::si(100.0)).get();
        for x in [10.0, visible + 1.0] {
            let mut trial = Trial::of("lidar", &params);
            trial.weather = Arc::new(Rain);
            trial.world.obstacles = vec![screen(x)];
            trial.run(move |bee, sensor: Handle<Scan>| {
                let read = |_| bee.read(sensor).distance(0, 0).map(Length::get);
                let readings: Vec<f64> = (0..100_000).filter_map(read).collect();
                if x > visible {
                    return assert!(readings.is_empty());
                }
                let sigma = rain::range_sigma(RainRate::si(30.0), Length::si(x)).get();
                assert_normal(&readings, x, sigma);
            });
        }
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, value) in [
            ("rays", "0"),
            ("start", "400 deg"),
            ("end", "-100 deg"),
            ("end", "300 deg"),
            ("max_range", "0 m"),
            ("min_range", "21 m"),
            ("sigma", "-1 m"),
            ("sigma_fraction", "-1"),
            ("step", "-1 m"),
            ("bias_sigma", "-1 m"),
            ("lost", "2"),
        ] {
            let refusal = refusal("lidar", &[(key, value)]).expect("it is refused");
            assert!(refusal.contains(key), "{key}: {refusal}");
        }
        assert!(refusal("lidar", &[("preset", "urg-04")]).is_some());
    }
}
