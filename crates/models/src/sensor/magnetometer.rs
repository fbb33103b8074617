//! A magnetometer in the field of the Earth.

use super::bounds::{MOST, at_least_zero};
use super::errors::{Sheet, Step, White, error_params};
use super::noise::Axes;
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::glam::{DMat3, DVec3};
use simbeeotic_model::units::{Angle, Current, Enu, Flu, MagneticField, V3};
use simbeeotic_model::{BuildError, Sensor, Truth, choice, sensor};

/// Measures the magnetic field of the Earth along its own axes.
///
/// The field is the same everywhere: of `strength` S, `inclination` I below the horizon, `declination` D
/// east of true north, `S (cos I sin D, cos I cos D, -sin I)` to the east, to the north and up. Nothing
/// disturbs it but the sensor's own surroundings: `y = A R^-1 B + bias`, with `soft_iron` A and the hard iron
/// as `bias`; then come the errors of `noise`.
#[sensor("magnetometer")]
pub struct Magnetometer {
    field: V3<MagneticField, Enu>,
    soft_iron: DMat3,
    axes: Axes,
    current: Current,
}

/// A device whose data sheet gives the errors that a scenario does not.
#[choice]
pub enum MagnetometerDevice {
    /// No errors.
    Ideal,
    /// Bosch BMM150 in its regular preset: 0.6 uT of noise, ±1300 uT (x, y) and ±2500 uT (z), 0.3 uT of
    /// resolution, an offset of ±2 uT after compensation taken as one standard deviation, 0.5 mA
    /// (BST-BMM150-DS001, rev. 1.0, page 2 for ranges and resolution; noise, offset and current as drivers
    /// quote section 1).
    Bmm150,
}

impl MagnetometerDevice {
    fn sheet(self) -> Sheet {
        let tesla = |microteslas| MagneticField::from_microteslas(microteslas).get();
        match self {
            Self::Ideal => Sheet::IDEAL,
            Self::Bmm150 => Sheet {
                white: White::Sigma([tesla(0.6); 3]),
                bias_sigma: tesla(2.0),
                scale_sigma: 0.0,
                range: [1300.0, 1300.0, 2500.0].map(tesla),
                step: Step::Of(tesla(0.3)),
            },
        }
    }

    fn current(self) -> Current {
        match self {
            Self::Ideal => Current::ZERO,
            Self::Bmm150 => Current::si(0.5e-3),
        }
    }
}

const NO_IRON: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

error_params! {
    /// Parameters of [`Magnetometer`]. The hard iron is `bias`. The field's defaults are about those of
    /// southern Germany in 2020 (IGRF-13).
    MagnetometerParams of MagneticField {
        /// The device whose data sheet says what is not said here: `ideal`, `bmm150`.
        preset: MagnetometerDevice = MagnetometerDevice::Bmm150,
        /// Strength of the field. 0 or more; 25 to 65 uT on Earth.
        strength: MagneticField = MagneticField::from_microteslas(48.0),
        /// How steeply it points down. -90 to 90 degrees; below 0 in the south.
        inclination: Angle = Angle::from_degrees(64.0),
        /// How far east of true north it points. -180 to 180 degrees.
        declination: Angle = Angle::from_degrees(3.5),
        /// What iron nearby makes of the field, in the sensor's axes: a matrix, row by row.
        soft_iron: [[f64; 3]; 3] = NO_IRON,
    }
}

impl Sensor for Magnetometer {
    type Params = MagnetometerParams;
    type Reading = V3<MagneticField, Flu>;

    fn build(params: MagnetometerParams) -> Result<Self, BuildError> {
        at_least_zero("strength", params.strength)?;
        let (right, half) = (Angle::QUARTER_TURN, Angle::HALF_TURN);
        in_range("inclination", params.inclination, -right..=right)?;
        in_range("declination", params.declination, -half..=half)?;
        let soft_iron = DMat3::from_cols_array_2d(&params.soft_iron).transpose();
        if !params.soft_iron.iter().flatten().all(|s| s.abs() <= MOST) {
            let message = "must be nine numbers of -1e9 to 1e9";
            return Err(BuildError::parameter("soft_iron", message));
        }
        let (down, level) = params.inclination.sin_cos();
        let (east, north) = params.declination.sin_cos();
        let direction = DVec3::new(level * east, level * north, -down);
        Ok(Self {
            field: V3::along(direction, params.strength),
            soft_iron,
            axes: params.given().over(params.preset.sheet())?,
            current: params.preset.current(),
        })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> V3<MagneticField, Flu> {
        truth.sensor_pose().attitude.unrotate(self.field)
    }

    fn measure(
        &mut self,
        ideal: V3<MagneticField, Flu>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> V3<MagneticField, Flu> {
        let felt = self.soft_iron * ideal.si();
        V3::from_si(self.axes.read(felt, truth.now(), rng))
    }

    fn current(&self) -> Current {
        self.current
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Heading, Mount, Offset, Rate, Yaw, math};

    type Reader = Handle<V3<MagneticField, Flu>>;

    fn degrees(degrees: f64) -> Angle {
        Angle::from_degrees(degrees)
    }

    #[test]
    fn the_field_points_to_magnetic_north_and_into_the_ground() {
        let params = [
            ("preset", "ideal"),
            ("strength", "50 uT"),
            ("inclination", "60 deg"),
            ("declination", "10 deg"),
        ];
        Trial::of("magnetometer", &params).run(|bee, sensor: Reader| {
            // Level, nose to magnetic north: 25 uT ahead, 43.3 uT down, none to the side.
            bee.set_attitude(Attitude::from_heading(Heading::new(degrees(10.0))));
            bee.set_rate(Rate::from_xyz(0.0, 0.0, 3.0));
            let read = bee.read(sensor).si() * 1e6;
            let want = DVec3::new(25.0, 0.0, -50.0 * 3.0_f64.sqrt() / 2.0);
            assert!((read - want).length() < 1e-9, "{read}");
            // Nose down into the field: all of it is ahead.
            let yaw = Yaw::from(Heading::new(degrees(10.0)));
            bee.set_attitude(Attitude::from_rpy(Angle::ZERO, degrees(60.0), yaw));
            let read = bee.read(sensor).si() * 1e6;
            assert!((read - DVec3::X * 50.0).length() < 1e-9, "{read}");
        });
    }

    #[test]
    fn a_level_heading_from_it_is_the_true_one_less_the_declination() {
        let params = [("preset", "ideal"), ("declination", "-8 deg")];
        let mut trial = Trial::of("magnetometer", &params);
        let back = Attitude::from_yaw(Yaw::new(degrees(180.0)));
        trial.mount = Mount::new(Offset::from_xyz(0.1, 0.0, 0.0), back);
        trial.run(|bee, sensor: Reader| {
            for heading in [0.0, 77.0, 200.0] {
                bee.set_attitude(Attitude::from_heading(Heading::new(degrees(heading))));
                let field = bee.read(sensor).si();
                // What is to the left of north is seen to the left by a nose that is on it.
                let magnetic = math::atan2(field.y, field.x).to_degrees();
                let want = heading + 180.0 + 8.0;
                let off = math::wrap_signed((magnetic - want).to_radians());
                assert!(off.abs() < 1e-12, "{magnetic} for {want}");
            }
        });
    }

    #[test]
    fn soft_iron_is_a_matrix_and_hard_iron_a_bias() {
        let params = MagnetometerParams {
            preset: MagnetometerDevice::Ideal,
            soft_iron: [[1.0, 0.2, 0.0], [0.0, 0.9, 0.0], [0.0, 0.0, 1.1]],
            bias: Some([10.0, 0.0, -5.0].map(MagneticField::from_microteslas)),
            ..MagnetometerParams::default()
        };
        let mut sensor = Magnetometer::build(params).expect("good");
        let mut rng = Stream::new(1, "bee/magnetometer", "noise");
        let felt = sensor.soft_iron * (DVec3::new(20.0, 5.0, -40.0) * 1e-6);
        let now = simbeeotic_model::kernel::SimTime::ZERO;
        let read = sensor.axes.read(felt, now, &mut rng) * 1e6;
        assert!(
            (read - DVec3::new(31.0, 4.5, -49.0)).length() < 1e-9,
            "{read}"
        );
    }

    #[test]
    fn the_noise_of_the_bmm150_is_that_of_its_data_sheet() {
        let params = [("bias_sigma", "0 T"), ("resolution", "0 T")];
        Trial::of("magnetometer", &params).run(|bee, sensor: Reader| {
            let (down, level) = degrees(64.0).sin_cos();
            let (east, north) = degrees(3.5).sin_cos();
            let want = DVec3::new(level * east, level * north, -down) * 48.0;
            let readings: Vec<DVec3> = (0..100_000).map(|_| bee.read(sensor).si() * 1e6).collect();
            for axis in 0..3 {
                let along: Vec<f64> = readings.iter().map(|r| r[axis]).collect();
                assert_normal(&along, want[axis], 0.6);
            }
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [
            ("strength", "-1 uT"),
            ("inclination", "91 deg"),
            ("declination", "181 deg"),
            ("sigma", "-1 uT"),
            ("range", "0 uT"),
        ] {
            let refusal = refusal("magnetometer", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
        let params = MagnetometerParams {
            soft_iron: [[f64::NAN; 3]; 3],
            ..MagnetometerParams::default()
        };
        assert!(Magnetometer::build(params).is_err());
    }
}
