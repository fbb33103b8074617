//! An inertial measurement unit: accelerometer and gyroscope in one case.

use super::accelerometer::AccelerometerParams;
use super::gyroscope::GyroscopeParams;
use super::inertial::InertialDevice;
use super::noise::Axes;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Accel, Current, Flu, Rate};
use simbeeotic_model::{BuildError, Column, Reading, Sensor, Truth, params, sensor};

/// Measures specific force and body rate at once, as `accelerometer` and `gyroscope` do.
///
/// On a `simple-bee`, which turns in no time, the body rate is 0.
///
/// By default a Bosch BMI088.
#[sensor("imu")]
pub struct Imu {
    accelerometer: Axes,
    gyroscope: Axes,
    current: Current,
}

/// What an [`Imu`] reads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertial {
    /// Specific force, along the sensor's axes.
    pub specific_force: Accel<Flu>,
    /// Body rate, about the sensor's axes.
    pub rate: Rate<Flu>,
}

impl Reading for Inertial {
    const COLUMNS: &'static [Column] = &[
        Column::new("fx", "m/s^2"),
        Column::new("fy", "m/s^2"),
        Column::new("fz", "m/s^2"),
        Column::new("wx", "rad/s"),
        Column::new("wy", "rad/s"),
        Column::new("wz", "rad/s"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        self.specific_force.numbers(to);
        self.rate.numbers(to);
    }
}

/// Parameters of [`Imu`].
#[params]
pub struct ImuParams {
    /// The device whose data sheet says what is not said here: `ideal`, `plain`, `bmi088`, `mpu6050`.
    pub preset: InertialDevice,
    /// Errors of the accelerometer that differ: `{ range = "24 g" }`.
    pub accelerometer: AccelerometerParams,
    /// Errors of the gyroscope that differ: `{ bias_sigma = "0 rad/s" }`.
    pub gyroscope: GyroscopeParams,
}

impl Default for ImuParams {
    fn default() -> Self {
        Self {
            preset: InertialDevice::Bmi088,
            accelerometer: AccelerometerParams::default(),
            gyroscope: GyroscopeParams::default(),
        }
    }
}

impl Sensor for Imu {
    type Params = ImuParams;
    type Reading = Inertial;

    fn build(params: ImuParams) -> Result<Self, BuildError> {
        let within = |part: &'static str| {
            move |error: BuildError| BuildError::parameter(part, format!("is wrong: {error}"))
        };
        let accelerometer = params.accelerometer.axes(params.preset);
        let gyroscope = params.gyroscope.axes(params.preset);
        let (accelerometer, one) = accelerometer.map_err(within("accelerometer"))?;
        let (gyroscope, other) = gyroscope.map_err(within("gyroscope"))?;
        Ok(Self {
            accelerometer,
            gyroscope,
            current: one + other,
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Inertial {
        Inertial {
            specific_force: truth.sensor_specific_force(),
            rate: truth.sensor_rate(),
        }
    }

    fn measure(&mut self, ideal: Inertial, truth: &Truth<'_>, rng: &mut Stream) -> Inertial {
        let (force, rate, now) = (ideal.specific_force.si(), ideal.rate.si(), truth.now());
        Inertial {
            specific_force: Accel::from_si(self.accelerometer.read(force, now, rng)),
            rate: Rate::from_si(self.gyroscope.read(rate, now, rng)),
        }
    }

    fn current(&self) -> Current {
        self.current
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, allan_deviation, assert_normal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::glam::DVec3;
    use simbeeotic_model::units::{
        Acceleration, Angle, AngularRate, Attitude, Mount, Offset, Time, Yaw, math,
    };

    type Reader = Handle<Inertial>;

    const G: f64 = 9.80665;

    fn params(accelerometer: &str, gyroscope: &str) -> ImuParams {
        ImuParams {
            accelerometer: AccelerometerParams {
                bias_sigma: Some(accelerometer.parse().expect("a bias")),
                scale_sigma: Some(0.0),
                resolution: Some(Acceleration::ZERO),
                ..AccelerometerParams::default()
            },
            gyroscope: GyroscopeParams {
                bias_sigma: Some(gyroscope.parse().expect("a bias")),
                scale_sigma: Some(0.0),
                resolution: Some(AngularRate::ZERO),
                ..GyroscopeParams::default()
            },
            ..ImuParams::default()
        }
    }

    #[test]
    fn both_parts_read_the_same_motion_in_the_same_frame() {
        let mut trial = Trial::of("imu", &[("preset", "ideal")]);
        let left = Attitude::from_yaw(Yaw::new(Angle::from_degrees(90.0)));
        trial.mount = Mount::new(Offset::from_xyz(0.0, 0.0, 0.05), left);
        trial.run(|bee, sensor: Reader| {
            for pitch in [0.0, 35.0] {
                let pitch = Angle::from_degrees(pitch);
                bee.set_attitude(Attitude::from_rpy(
                    Angle::ZERO,
                    pitch,
                    Yaw::new(Angle::ZERO),
                ));
                bee.set_rate(Rate::from_xyz(0.0, 4.0, 0.0));
                let read = bee.read(sensor);
                assert!((read.rate.si() - DVec3::new(4.0, 0.0, 0.0)).length() < 1e-12);
                // One g, seen nose down; and w^2 r = 0.8 m/s² downwards from the arm above. The
                // sensor's forward is the body's left, its right the body's nose.
                let (sin, cos) = pitch.sin_cos();
                let want = DVec3::new(0.0, G * sin, G * cos - 0.8);
                let off = (read.specific_force.si() - want).length();
                assert!(off < 1e-9, "{read:?} for {want}");
            }
        });
    }

    /// What a device that is at rest reads, `dt_ms` apart.
    fn at_rest(params: ImuParams, n: u64, dt_ms: u64) -> Vec<Inertial> {
        let (mut accelerometer, _) = params.accelerometer.axes(params.preset).expect("good");
        let (mut gyroscope, _) = params.gyroscope.axes(params.preset).expect("good");
        let mut rng = Stream::new(5, "bee/imu", "noise");
        let mut read = |step| {
            let now = simbeeotic_model::kernel::SimTime::from_millis(step * dt_ms);
            let force = accelerometer.read(DVec3::Z * G, now, &mut rng);
            let rate = gyroscope.read(DVec3::ZERO, now, &mut rng);
            Inertial {
                specific_force: Accel::from_si(force),
                rate: Rate::from_si(rate),
            }
        };
        (0..n).map(&mut read).collect()
    }

    #[test]
    fn the_noise_of_the_bmi088_is_that_of_its_data_sheet() {
        let read = at_rest(params("0 g", "0 rad/s"), 100_000, 10);
        // Density times the root of the bandwidth.
        for (axis, density_ug) in [(0, 160.0), (1, 160.0), (2, 190.0)] {
            let along: Vec<f64> = read.iter().map(|r| r.specific_force.si()[axis]).collect();
            let sigma = density_ug * 1e-6 * G * 40.0_f64.sqrt();
            assert_normal(&along, if axis == 2 { G } else { 0.0 }, sigma);
            // White: in Allan deviation sigma / sqrt(f tau).
            for tau in [1, 10, 100] {
                let want = sigma / (tau as f64).sqrt();
                let found = allan_deviation(&along, tau);
                assert!(
                    (found / want - 1.0).abs() < 0.06,
                    "{tau}: {found} for {want}"
                );
            }
        }
        let about: Vec<f64> = read.iter().map(|r| r.rate.si().y).collect();
        let sigma = 0.014_f64.to_radians() * 32.0_f64.sqrt();
        assert_normal(&about, 0.0, sigma);
    }

    #[test]
    fn the_noise_of_the_mpu6050_is_that_of_its_data_sheet() {
        let params = ImuParams {
            preset: InertialDevice::Mpu6050,
            ..params("0 g", "0 rad/s")
        };
        let read = at_rest(params, 100_000, 10);
        let along: Vec<f64> = read.iter().map(|r| r.specific_force.si().z).collect();
        assert_normal(&along, G, 400e-6 * G * 44.0_f64.sqrt());
        let about: Vec<f64> = read.iter().map(|r| r.rate.si().z).collect();
        assert_normal(&about, 0.0, 0.005_f64.to_radians() * 42.0_f64.sqrt());
    }

    #[test]
    fn a_drift_shows_as_a_hump_in_allan_deviation() {
        let mut params = params("0 g", "0 rad/s");
        let drift = AngularRate::from_degrees_per_second(0.05);
        params.gyroscope.sigma = Some(AngularRate::from_degrees_per_second(0.01));
        params.gyroscope.drift = Some(drift);
        params.gyroscope.drift_time = Some(Time::from_secs(2.0));
        let read = at_rest(params, 400_000, 10);
        let about: Vec<f64> = read.iter().map(|r| r.rate.si().x).collect();
        // A Gauss-Markov process of D and T has its most, 0.617 D, at 1.89 T (IEEE Std 952-1997, annex
        // C): 378 readings. White noise adds 0.01 deg/s / sqrt(378).
        let most = allan_deviation(&about, 378);
        let want = 0.617 * drift.get();
        assert!((most / want - 1.0).abs() < 0.08, "{most} for {want}");
        for elsewhere in [20, 6000] {
            assert!(
                allan_deviation(&about, elsewhere) < 0.75 * most,
                "{elsewhere}"
            );
        }
    }

    #[test]
    fn each_device_has_its_own_offset_and_sensitivity() {
        let mut rng = Stream::new(6, "bee/imu", "noise");
        let now = simbeeotic_model::kernel::SimTime::ZERO;
        let quiet = ImuParams {
            accelerometer: AccelerometerParams {
                sigma: Some(Acceleration::ZERO),
                resolution: Some(Acceleration::ZERO),
                ..AccelerometerParams::default()
            },
            gyroscope: GyroscopeParams {
                sigma: Some(AngularRate::ZERO),
                resolution: Some(AngularRate::ZERO),
                ..GyroscopeParams::default()
            },
            ..ImuParams::default()
        };
        let (mut offsets, mut rates) = (Vec::new(), Vec::new());
        for _ in 0..100_000 {
            let (mut force, _) = quiet.accelerometer.axes(quiet.preset).expect("good");
            let (mut rate, _) = quiet.gyroscope.axes(quiet.preset).expect("good");
            offsets.push(force.read(DVec3::ZERO, now, &mut rng).x / G);
            rates.push(rate.read(DVec3::X * 10.0, now, &mut rng).x);
        }
        assert_normal(&offsets, 0.0, 0.020);
        // 1 deg/s of offset, and 1 % of 10 rad/s.
        assert_normal(&rates, 10.0, math::hypot(1.0_f64.to_radians(), 0.1));
    }

    #[test]
    fn the_steps_of_the_bmi088_are_those_of_its_data_sheet() {
        // 0.09 mg at ±3 g, 0.004 deg/s at ±125 deg/s, to the digits it gives.
        let params = ImuParams {
            accelerometer: AccelerometerParams {
                range: Some(Acceleration::from_g(3.0)),
                ..AccelerometerParams::default()
            },
            gyroscope: GyroscopeParams {
                range: Some(AngularRate::from_degrees_per_second(125.0)),
                ..GyroscopeParams::default()
            },
            ..ImuParams::default()
        };
        let read = at_rest(params, 1000, 10);
        let step = |numbers: Vec<f64>| {
            let mut gaps: Vec<f64> = numbers.windows(2).map(|w| (w[1] - w[0]).abs()).collect();
            gaps.retain(|gap| *gap > 1e-9);
            gaps.iter().copied().fold(f64::INFINITY, f64::min)
        };
        let mg = step(
            read.iter()
                .map(|r| r.specific_force.si().x / G * 1e3)
                .collect(),
        );
        assert!((mg - 0.09).abs() < 0.005, "{mg} mg");
        let degrees = step(read.iter().map(|r| r.rate.si().x.to_degrees()).collect());
        assert!((degrees - 0.004).abs() < 0.0005, "{degrees} deg/s");
    }

    #[test]
    fn it_draws_what_the_data_sheet_says() {
        let imu = Imu::build(ImuParams::default()).expect("good");
        assert!((imu.current().get() - 5.15e-3).abs() < 1e-12);
    }

    #[test]
    fn a_fault_names_the_part_that_has_it() {
        let mut params = ImuParams::default();
        params.gyroscope.range = Some(AngularRate::ZERO);
        let fault = Imu::build(params)
            .map(drop)
            .expect_err("no range")
            .to_string();
        assert!(
            fault.contains("gyroscope") && fault.contains("range"),
            "{fault}"
        );
    }
}
