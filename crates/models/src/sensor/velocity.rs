//! Velocity sensors: in the world's axes and in one's own.

use super::errors::{Sheet, error_params};
use super::noise::Axes;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Enu, Flu, Speed, Velocity};
use simbeeotic_model::{BuildError, Sensor, Truth, sensor};

/// Measures the velocity of its own place along the axes of the world: `v + w x r`.
///
/// As navigation by satellites or beacons gives it. The errors are those of `noise`; without other
/// words 0.05 m/s of white noise on each axis.
#[sensor("velocity")]
pub struct VelocitySensor {
    axes: Axes,
}

/// Measures the velocity of its own place along its own axes: `R^-1 (v + w x r)`.
///
/// As odometry by camera or Doppler gives it. The errors are those of `noise`; without other words
/// 0.05 m/s of white noise on each axis.
#[sensor("body-velocity")]
pub struct BodyVelocitySensor {
    axes: Axes,
}

/// What both have unless said.
const USUAL: Sheet = Sheet::white(0.05);

error_params! {
    /// Parameters of [`VelocitySensor`].
    VelocitySensorParams of Speed {}
}

error_params! {
    /// Parameters of [`BodyVelocitySensor`].
    BodyVelocitySensorParams of Speed {}
}

impl Sensor for VelocitySensor {
    type Params = VelocitySensorParams;
    type Reading = Velocity<Enu>;

    fn build(params: VelocitySensorParams) -> Result<Self, BuildError> {
        let axes = params.given().over(USUAL)?;
        Ok(Self { axes })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Velocity<Enu> {
        truth.sensor_velocity()
    }

    fn measure(
        &mut self,
        ideal: Velocity<Enu>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Velocity<Enu> {
        Velocity::from_si(self.axes.read(ideal.si(), truth.now(), rng))
    }
}

impl Sensor for BodyVelocitySensor {
    type Params = BodyVelocitySensorParams;
    type Reading = Velocity<Flu>;

    fn build(params: BodyVelocitySensorParams) -> Result<Self, BuildError> {
        let axes = params.given().over(USUAL)?;
        Ok(Self { axes })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Velocity<Flu> {
        truth.sensor_velocity_flu()
    }

    fn measure(
        &mut self,
        ideal: Velocity<Flu>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Velocity<Flu> {
        Velocity::from_si(self.axes.read(ideal.si(), truth.now(), rng))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::glam::DVec3;
    use simbeeotic_model::units::{Angle, Attitude, Mount, Offset, Rate, Yaw};

    fn tilted() -> Attitude {
        let degrees = Angle::from_degrees;
        Attitude::from_rpy(degrees(30.0), degrees(-20.0), Yaw::new(degrees(110.0)))
    }

    /// 20 cm to the left, looking back.
    fn mount() -> Mount {
        let back = Attitude::from_yaw(Yaw::new(Angle::from_degrees(180.0)));
        Mount::new(Offset::from_xyz(0.0, 0.2, 0.0), back)
    }

    #[test]
    fn a_turn_moves_what_sits_on_an_arm() {
        let mut trial = Trial::of("velocity", &[("sigma", "0 m/s")]);
        trial.mount = mount();
        trial.run(|bee, sensor: Handle<Velocity<Enu>>| {
            for attitude in [Attitude::IDENTITY, tilted()] {
                bee.set_attitude(attitude);
                bee.set_velocity(Velocity::from_xyz(3.0, -1.0, 0.5));
                bee.set_rate(Rate::from_xyz(0.0, 0.0, 5.0));
                // w x r = 5 z x 0.2 y = -1 x, along the body's axes.
                let want = DVec3::new(3.0, -1.0, 0.5) - attitude.forward();
                let read = bee.read(sensor).si();
                assert!((read - want).length() < 1e-12, "{read} for {want}");
            }
        });
    }

    #[test]
    fn in_its_own_axes_forward_is_where_it_looks() {
        let mut trial = Trial::of("body-velocity", &[("sigma", "0 m/s")]);
        trial.mount = mount();
        trial.run(|bee, sensor: Handle<Velocity<Flu>>| {
            for attitude in [Attitude::IDENTITY, tilted()] {
                bee.set_attitude(attitude);
                bee.set_velocity_flu(Velocity::from_xyz(3.0, -1.0, 0.5));
                bee.set_rate(Rate::from_xyz(0.0, 0.0, 5.0));
                let read = bee.read(sensor).si();
                let off = (read - DVec3::new(-2.0, 1.0, 0.5)).length();
                assert!(off < 1e-12, "{read}");
            }
        });
    }

    #[test]
    fn the_noise_is_as_large_as_it_says() {
        let trial = Trial::of("velocity", &[("sigma", "0.2 m/s")]);
        trial.run(|bee, sensor: Handle<Velocity<Enu>>| {
            bee.set_velocity(Velocity::from_xyz(3.0, 0.0, 0.0));
            let read: Vec<f64> = (0..100_000).map(|_| bee.read(sensor).si().x).collect();
            assert_normal(&read, 3.0, 0.2);
        });
    }
}
