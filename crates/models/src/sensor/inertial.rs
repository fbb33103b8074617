//! What data sheets say of inertial sensors.
//!
//! A zero offset and a sensitivity tolerance are given as typical values; they are taken as one
//! standard deviation from one device to another. The data sheets say nothing of how biases drift:
//! set `walk`, or `drift` and `drift_time`.

use super::errors::{Sheet, Step, White};
use simbeeotic_model::choice;
use simbeeotic_model::units::{Acceleration, AngularRate, Current};

/// A device whose data sheet gives the errors that a scenario does not.
///
/// | device | accelerometer | gyroscope | current |
/// |---|---|---|---|
/// | `ideal` | no errors | no errors | |
/// | `plain` | 0.005 m/s² of white noise | 0.0085 rad/s of white noise | |
/// | `bmi088` | 160, 160, 190 ug/sqrt(Hz) in 40 Hz; ±20 mg; 0.5 %; ±6 g, 16 bits | 0.014 deg/s/sqrt(Hz) in 32 Hz; ±1 deg/s; 1 %; ±2000 deg/s, 16 bits | 0.15 mA, 5 mA |
/// | `mpu6050` | 400 ug/sqrt(Hz) in 44 Hz; ±50 mg; 3 %; ±2 g, 16 bits | 0.005 deg/s/sqrt(Hz) in 42 Hz; ±20 deg/s; 3 %; ±250 deg/s, 16 bits | 0.5 mA, 3.6 mA |
///
/// `plain` is what the original's sensors have. BMI088: Bosch Sensortec, BST-BMI088-DS001, section 1.2
/// (noise at ±3 g; other ranges are noisier, by how much it does not say), bandwidths of section 5.3 for
/// 100 readings a second; ranges ±3, 6, 12, 24 g and ±125 to 2000 deg/s, 1600 and 2000 readings a second at
/// most. MPU-6050: InvenSense, PS-MPU-6000A-00 rev. 3.4, sections 6.1 and 6.2 (its z axis is offset by
/// ±80 mg, taken as ±50 mg here), bandwidths of the low-pass filter's setting 3. The ranges are those at
/// power-on; `range` sets another, and the resolution follows. The data sheets themselves were not at
/// hand: the figures are as drivers and papers quote them.
#[choice]
pub enum InertialDevice {
    /// No errors at all.
    Ideal,
    /// White noise alone, as in the original.
    Plain,
    /// Bosch BMI088.
    Bmi088,
    /// InvenSense MPU-6050.
    Mpu6050,
}

impl InertialDevice {
    pub(super) fn accelerometer(self) -> Sheet {
        let g = |g: f64| Acceleration::from_g(g).get();
        match self {
            Self::Ideal => Sheet::IDEAL,
            Self::Plain => Sheet::white(0.005),
            Self::Bmi088 => Sheet {
                white: White::Density([160e-6, 160e-6, 190e-6].map(g), 40.0),
                bias_sigma: g(20e-3),
                scale_sigma: 0.005,
                range: [g(6.0); 3],
                step: Step::Bits(16),
            },
            Self::Mpu6050 => Sheet {
                white: White::Density([g(400e-6); 3], 44.0),
                bias_sigma: g(50e-3),
                scale_sigma: 0.03,
                range: [g(2.0); 3],
                step: Step::Bits(16),
            },
        }
    }

    pub(super) fn gyroscope(self) -> Sheet {
        let degrees = |degrees| AngularRate::from_degrees_per_second(degrees).get();
        match self {
            Self::Ideal => Sheet::IDEAL,
            Self::Plain => Sheet::white(0.0085),
            Self::Bmi088 => Sheet {
                white: White::Density([degrees(0.014); 3], 32.0),
                bias_sigma: degrees(1.0),
                scale_sigma: 0.01,
                range: [degrees(2000.0); 3],
                step: Step::Bits(16),
            },
            Self::Mpu6050 => Sheet {
                white: White::Density([degrees(0.005); 3], 42.0),
                bias_sigma: degrees(20.0),
                scale_sigma: 0.03,
                range: [degrees(250.0); 3],
                step: Step::Bits(16),
            },
        }
    }

    pub(super) fn accelerometer_current(self) -> Current {
        match self {
            Self::Ideal | Self::Plain => Current::ZERO,
            Self::Bmi088 => Current::si(0.15e-3),
            Self::Mpu6050 => Current::si(0.5e-3),
        }
    }

    pub(super) fn gyroscope_current(self) -> Current {
        match self {
            Self::Ideal | Self::Plain => Current::ZERO,
            Self::Bmi088 => Current::si(5e-3),
            Self::Mpu6050 => Current::si(3.6e-3),
        }
    }
}
