//! A gyroscope.

use super::errors::error_params;
use super::inertial::InertialDevice;
use super::noise::Axes;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{AngularRate, Current, Flu, Rate};
use simbeeotic_model::{BuildError, Sensor, Truth, sensor};

/// Measures how fast it turns about its own axes: the body rate `w`, in the sensor's frame.
///
/// Positive is counter-clockwise seen against the axis. The errors are those of `noise`; without other
/// words 0.0085 rad/s of white noise on each axis, as in the original, which read about the axes of the
/// world. A `simple-bee` turns in no time, so there the body rate is 0.
#[sensor(
    "gyroscope",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultGyroscope"
)]
pub struct Gyroscope {
    axes: Axes,
    current: Current,
}

error_params! {
    /// Parameters of [`Gyroscope`].
    GyroscopeParams of AngularRate {
        /// The device whose data sheet says what is not said here: `ideal`, `plain` (unless said),
        /// `bmi088`, `mpu6050`.
        #[serde(skip_serializing_if = "Option::is_none")]
        preset: Option<InertialDevice> = None,
    }
}

impl GyroscopeParams {
    pub(super) fn axes(&self, usual: InertialDevice) -> Result<(Axes, Current), BuildError> {
        let device = self.preset.unwrap_or(usual);
        let axes = self.given().over(device.gyroscope())?;
        Ok((axes, device.gyroscope_current()))
    }
}

impl Sensor for Gyroscope {
    type Params = GyroscopeParams;
    type Reading = Rate<Flu>;

    fn build(params: GyroscopeParams) -> Result<Self, BuildError> {
        let (axes, current) = params.axes(InertialDevice::Plain)?;
        Ok(Self { axes, current })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Rate<Flu> {
        truth.sensor_rate()
    }

    fn measure(&mut self, ideal: Rate<Flu>, truth: &Truth<'_>, rng: &mut Stream) -> Rate<Flu> {
        Rate::from_si(self.axes.read(ideal.si(), truth.now(), rng))
    }

    fn current(&self) -> Current {
        self.current
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::glam::DVec3;
    use simbeeotic_model::units::{Angle, Attitude, Enu, Mount, Offset, Yaw};

    type Reader = Handle<Rate<Flu>>;

    /// Nose straight up.
    fn nose_up() -> Attitude {
        Attitude::from_rpy(
            Angle::ZERO,
            Angle::from_degrees(-90.0),
            Yaw::new(Angle::from_degrees(40.0)),
        )
    }

    #[test]
    fn it_reads_about_its_own_axes_and_not_the_worlds() {
        Trial::of("gyroscope", &[("preset", "ideal")]).run(|bee, sensor: Reader| {
            // Turning about the world's up with the nose up is a turn about the nose.
            for (attitude, want) in [
                (Attitude::IDENTITY, DVec3::new(0.0, 0.0, 2.0)),
                (nose_up(), DVec3::new(2.0, 0.0, 0.0)),
            ] {
                bee.set_attitude(attitude);
                bee.set_rate(attitude.unrotate(Rate::<Enu>::from_xyz(0.0, 0.0, 2.0)));
                let read = bee.read(sensor).si();
                assert!((read - want).length() < 1e-12, "{read} for {want}");
            }
        });
    }

    #[test]
    fn its_mount_turns_what_it_reads_and_where_it_sits_does_not_matter() {
        let mut trial = Trial::of("gyroscope", &[("preset", "ideal")]);
        let left = Attitude::from_yaw(Yaw::new(Angle::from_degrees(90.0)));
        trial.mount = Mount::new(Offset::from_xyz(0.5, 0.5, 0.5), left);
        trial.run(|bee, sensor: Reader| {
            for attitude in [Attitude::IDENTITY, nose_up()] {
                bee.set_attitude(attitude);
                bee.set_rate(Rate::from_xyz(1.0, 2.0, 3.0));
                let read = bee.read(sensor).si();
                assert!(
                    (read - DVec3::new(2.0, -1.0, 3.0)).length() < 1e-12,
                    "{read}"
                );
            }
        });
    }

    #[test]
    fn the_noise_of_the_plain_one_is_the_originals() {
        Trial::of("gyroscope", &[]).run(|bee, sensor: Reader| {
            bee.set_rate(Rate::from_xyz(0.1, -0.2, 0.3));
            let readings: Vec<DVec3> = (0..100_000).map(|_| bee.read(sensor).si()).collect();
            for (axis, want) in [0.1, -0.2, 0.3].into_iter().enumerate() {
                let along: Vec<f64> = readings.iter().map(|r| r[axis]).collect();
                assert_normal(&along, want, 0.0085);
            }
        });
    }
}
