//! An accelerometer.

use super::errors::error_params;
use super::inertial::InertialDevice;
use super::noise::Axes;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Accel, Acceleration, Current, Flu};
use simbeeotic_model::{BuildError, Sensor, Truth, sensor};

/// Measures the specific force where it sits, along its own axes: `f = R^-1 (a - g)`.
///
/// Zero in free fall, one g upwards at rest and in hover. `R` turns the sensor's axes into the world's,
/// `a` is the acceleration of the sensor's place: that of the centre of mass, and, at an arm `r` from it,
/// `alpha x r + w x (w x r)`. The errors are those of `noise`; without other words 0.005 m/s² of white
/// noise on each axis, as in the original, which read -1 g at rest.
#[sensor(
    "accelerometer",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultAccelerometer"
)]
pub struct Accelerometer {
    axes: Axes,
    current: Current,
}

error_params! {
    /// Parameters of [`Accelerometer`].
    AccelerometerParams of Acceleration {
        /// The device whose data sheet says what is not said here: `ideal`, `plain` (unless said),
        /// `bmi088`, `mpu6050`.
        #[serde(skip_serializing_if = "Option::is_none")]
        preset: Option<InertialDevice> = None,
    }
}

impl AccelerometerParams {
    pub(super) fn axes(&self, usual: InertialDevice) -> Result<(Axes, Current), BuildError> {
        let device = self.preset.unwrap_or(usual);
        let axes = self.given().over(device.accelerometer())?;
        Ok((axes, device.accelerometer_current()))
    }
}

impl Sensor for Accelerometer {
    type Params = AccelerometerParams;
    type Reading = Accel<Flu>;

    fn build(params: AccelerometerParams) -> Result<Self, BuildError> {
        let (axes, current) = params.axes(InertialDevice::Plain)?;
        Ok(Self { axes, current })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Accel<Flu> {
        truth.sensor_specific_force()
    }

    fn measure(&mut self, ideal: Accel<Flu>, truth: &Truth<'_>, rng: &mut Stream) -> Accel<Flu> {
        Accel::from_si(self.axes.read(ideal.si(), truth.now(), rng))
    }

    fn current(&self) -> Current {
        self.current
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::scene::block;
    use crate::trial::{Trial, assert_normal};
    use simbeeotic_model::units::glam::DVec3;
    use simbeeotic_model::units::{
        Angle, Attitude, Force, ForceVec, Mount, Offset, Rate, Time, Velocity, Yaw,
    };
    use simbeeotic_model::world::{Obstacle, World};
    use simbeeotic_model::{Bee, Handle};

    type Reader = Handle<Accel<Flu>>;

    const G: f64 = 9.80665;

    fn ideal() -> Trial {
        Trial::of("accelerometer", &[("preset", "ideal")])
    }

    fn tilted() -> Attitude {
        let degrees = Angle::from_degrees;
        Attitude::from_rpy(degrees(30.0), degrees(-20.0), Yaw::new(degrees(110.0)))
    }

    /// Reads along the axes of the world, m/s².
    fn felt(bee: &mut Bee<'_>, sensor: Reader) -> DVec3 {
        let read = bee.read(sensor);
        bee.attitude().rotate(read).si()
    }

    fn assert_near(read: DVec3, want: DVec3) {
        assert!((read - want).length() < 1e-9, "{read} for {want}");
    }

    #[test]
    fn in_hover_it_reads_one_g_upwards_in_any_attitude() {
        ideal().run(|bee, sensor: Reader| {
            let gravity = bee.gravity().get();
            assert_near(bee.read(sensor).si(), DVec3::Z * gravity);
            bee.set_attitude(tilted());
            // Nose up by 20 degrees: the specific force points to the nose as well.
            let read = bee.read(sensor);
            let twenty = Angle::from_degrees(20.0);
            assert!(
                (read.forward().get() - gravity * twenty.sin()).abs() < 1e-9,
                "{read}"
            );
            assert_near(felt(bee, sensor), DVec3::Z * gravity);
        });
    }

    #[test]
    fn in_free_fall_it_reads_nothing() {
        ideal().run(|bee, sensor: Reader| {
            for attitude in [Attitude::IDENTITY, tilted()] {
                bee.set_attitude(attitude);
                bee.set_force(ForceVec::ZERO);
                bee.set_velocity(Velocity::from_xyz(3.0, 0.0, -2.0));
                assert_near(bee.read(sensor).si(), DVec3::ZERO);
            }
        });
    }

    #[test]
    fn lying_on_the_ground_it_reads_one_g_upwards_and_not_downwards() {
        let mut trial = ideal();
        trial.vehicle = vec![("control_period", "1000 s"), ("rolls", "true")];
        (trial.every, trial.seconds) = (Time::from_secs(5.0), 12);
        let mut step = 0;
        trial.at = [0.0, 0.0, 0.3];
        trial.run(move |bee, sensor: Reader| {
            match step {
                // It falls the 30 cm, and lies.
                0 => bee.set_force(ForceVec::ZERO),
                _ => {
                    assert!((bee.position().up().get() - 0.05).abs() < 1e-3);
                    assert!(bee.velocity().length().get() < 1e-6);
                    assert_near(felt(bee, sensor), DVec3::Z * G);
                }
            }
            step += 1;
        });
    }

    #[test]
    fn lying_on_a_box_it_reads_one_g_upwards_awake_and_asleep() {
        let mut trial = ideal();
        trial.world = World {
            obstacles: vec![block([0.0, 0.0, 0.0], [1.0, 1.0, 1.0])],
            ..World::default()
        };
        trial.vehicle = vec![("control_period", "1000 s"), ("rolls", "true")];
        trial.at = [0.0, 0.0, 1.2];
        (trial.first, trial.every, trial.seconds) = (Time::from_secs(1.0), Time::si(0.01), 20);
        let mut step = 0;
        trial.run(move |bee, sensor: Reader| {
            if step == 0 {
                bee.set_force(ForceVec::ZERO);
            }
            // It comes down after 0.17 s, and is in an island first, asleep later.
            if step > 100 {
                assert!((bee.position().up().get() - 1.05).abs() < 5e-3);
                assert_near(felt(bee, sensor), DVec3::Z * G);
            }
            step += 1;
        });
    }

    #[test]
    fn sliding_on_the_ground_it_reads_the_friction() {
        let mut trial = ideal();
        trial.at = [0.0; 3];
        (trial.every, trial.seconds) = (Time::from_secs(0.1), 2);
        let mut step = 0;
        trial.run(move |bee, sensor: Reader| {
            if step == 0 {
                bee.set_force(ForceVec::ZERO);
                bee.set_velocity(Velocity::from_xyz(2.0, 0.0, 0.0));
            } else if step < 3 {
                // Friction 0.5 on 0.5: half of the weight holds it back, until 2 / (0.5 g) = 0.4 s.
                assert_near(felt(bee, sensor), DVec3::new(-0.5 * G, 0.0, G));
            } else if step > 5 {
                assert_near(felt(bee, sensor), DVec3::Z * G);
            }
            step += 1;
        });
    }

    #[test]
    fn sliding_down_a_ramp_it_reads_what_holds_it_up_and_back() {
        let mut trial = ideal();
        let slope = Angle::from_degrees(45.0);
        trial.world = World {
            obstacles: vec![Obstacle {
                attitude: Attitude::from_rpy(Angle::ZERO, slope, Yaw::new(Angle::ZERO)),
                ..block([0.0, 0.0, 20.0], [100.0, 10.0, 1.0])
            }],
            ..World::default()
        };
        // Its surface passes through (0, 0, 20 + sqrt(2)); the bee starts 10 cm above.
        trial.at = [0.0, 0.0, 20.0 + 2.0_f64.sqrt() + 0.1];
        (trial.every, trial.seconds) = (Time::si(0.01), 3);
        let (mut step, mut sum) = (0, DVec3::ZERO);
        trial.run(move |bee, sensor: Reader| {
            match step {
                0 => bee.set_force(ForceVec::ZERO),
                // It has come down, and slides: a second, some 7 m.
                50..150 => sum += felt(bee, sensor),
                150 => {
                    // The ramp presses with g cos 45 deg, and friction 0.5 holds back with half of it.
                    let cos = G / 2.0_f64.sqrt();
                    let (up, back) = (DVec3::new(1.0, 0.0, 1.0), DVec3::new(-1.0, 0.0, 1.0));
                    let want = (up + 0.5 * back).normalize() * cos * 1.25_f64.sqrt();
                    let off = (sum / 100.0 - want).length();
                    assert!(off < 0.02 * G, "{} for {want}", sum / 100.0);
                }
                _ => {}
            }
            step += 1;
        });
    }

    #[test]
    fn a_push_is_felt_as_what_it_is_by_mass() {
        ideal().run(|bee, sensor: Reader| {
            let force = bee.force() + ForceVec::new(Force::si(0.256), Force::ZERO, Force::ZERO);
            for attitude in [Attitude::IDENTITY, tilted()] {
                bee.set_attitude(attitude);
                bee.set_force(force);
                assert_near(felt(bee, sensor), DVec3::new(2.0, 0.0, G));
            }
        });
    }

    #[test]
    fn on_an_arm_a_turn_pulls_outwards() {
        let mut trial = ideal();
        // 10 cm ahead, looking to the left, upside down.
        let degrees = Angle::from_degrees;
        let turned = Attitude::from_rpy(degrees(180.0), Angle::ZERO, Yaw::new(degrees(90.0)));
        trial.mount = Mount::new(Offset::from_xyz(0.1, 0.0, 0.0), turned);
        trial.run(move |bee, sensor: Reader| {
            for attitude in [Attitude::IDENTITY, tilted()] {
                bee.set_attitude(attitude);
                bee.set_rate(Rate::from_xyz(0.0, 0.0, 5.0));
                // The place accelerates towards the axis by w^2 r = 2.5 m/s².
                let body = attitude.unrotate(Accel::from_xyz(0.0, 0.0, G));
                let body = body + Accel::from_xyz(-2.5, 0.0, 0.0);
                // Forward of the sensor is the body's left, its left the body's forward.
                let [x, y, z] = body.si().to_array();
                let read = bee.read(sensor).si();
                assert_near(read, DVec3::new(y, x, -z));
            }
        });
    }

    #[test]
    fn on_an_arm_a_starting_turn_is_felt_across_it() {
        let mut trial = ideal();
        trial.mount = Mount::new(Offset::from_xyz(0.0, 0.2, 0.0), Attitude::IDENTITY);
        trial.run(|bee, sensor: Reader| {
            let inertia = 0.4 * 0.128 * 0.05 * 0.05;
            bee.set_torque(simbeeotic_model::units::TorqueVec::from_xyz(
                0.0,
                0.0,
                3.0 * inertia,
            ));
            // alpha x r = 3 z x 0.2 y = -0.6 x.
            let read = bee.read(sensor).si();
            let off = (read - DVec3::new(-0.6, 0.0, G)).length();
            assert!(off < 1e-6, "{read}");
        });
    }

    #[test]
    fn the_noise_of_the_plain_one_is_the_originals() {
        Trial::of("accelerometer", &[]).run(|bee, sensor: Reader| {
            let readings: Vec<DVec3> = (0..100_000).map(|_| bee.read(sensor).si()).collect();
            for (axis, want) in [0.0, 0.0, G].into_iter().enumerate() {
                let along: Vec<f64> = readings.iter().map(|r| r[axis]).collect();
                assert_normal(&along, want, 0.005);
            }
        });
    }

    #[test]
    fn it_saturates_and_counts_in_steps() {
        let params = [
            ("preset", "ideal"),
            ("range", "0.5 g"),
            ("resolution", "10 mg"),
        ];
        Trial::of("accelerometer", &params).run(|bee, sensor: Reader| {
            let force = bee.force() + ForceVec::from_xyz(0.128 * 0.1234 * G, 0.0, 0.0);
            bee.set_force(force);
            assert_near(bee.read(sensor).si(), DVec3::new(0.12 * G, 0.0, 0.5 * G));
        });
    }

    #[test]
    fn a_known_bias_stays_along_its_own_axes() {
        let mut params = AccelerometerParams {
            preset: Some(InertialDevice::Ideal),
            ..AccelerometerParams::default()
        };
        params.bias = Some([0.1, -0.2, 0.3].map(Acceleration::si));
        let (mut axes, _) = params.axes(InertialDevice::Plain).expect("good");
        let mut rng = Stream::new(1, "bee/accelerometer", "noise");
        let now = simbeeotic_model::kernel::SimTime::ZERO;
        let read = axes.read(DVec3::new(1.0, 1.0, 1.0), now, &mut rng);
        assert_near(read, DVec3::new(1.1, 0.8, 1.3));
    }
}
