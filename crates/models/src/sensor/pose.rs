//! A sensor of position and attitude.

use super::bounds::at_least_zero;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{Angle, Length, Pose, Position, V3};
use simbeeotic_model::{BuildError, Sensor, Truth, params, sensor};

/// Measures its own pose in the world: where it is, and how its axes are turned.
///
/// The attitude read is the true one, turned by a small rotation about the sensor's own axes, normal about
/// each: `R exp(sigma n)`. The original had a sigma and never used it.
#[sensor(
    "pose",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultPoseSensor"
)]
pub struct PoseSensor {
    params: PoseSensorParams,
}

/// Parameters of [`PoseSensor`].
#[params]
pub struct PoseSensorParams {
    /// Standard deviation of the attitude, about each axis. 0 or more.
    pub sigma: Angle,
    /// Standard deviation of the position, along each axis. 0 or more.
    pub position_sigma: Length,
}

impl Default for PoseSensorParams {
    fn default() -> Self {
        Self {
            sigma: Angle::si(0.01),
            position_sigma: Length::ZERO,
        }
    }
}

/// A pose with a normal error on each axis of both its parts.
pub(super) fn disturbed(pose: Pose, position: Length, attitude: Angle, rng: &mut Stream) -> Pose {
    let mut normal = || DVec3::new(rng.normal(), rng.normal(), rng.normal());
    let turn = V3::from_si(normal() * attitude.get());
    let shift = Position::from_si(normal() * position.get());
    Pose::new(
        pose.position + shift,
        pose.attitude * simbeeotic_model::units::Attitude::exp(turn),
    )
}

impl Sensor for PoseSensor {
    type Params = PoseSensorParams;
    type Reading = Pose;

    fn build(params: PoseSensorParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        at_least_zero("position_sigma", params.position_sigma)?;
        Ok(Self { params })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Pose {
        truth.sensor_pose()
    }

    fn measure(&mut self, ideal: Pose, _truth: &Truth<'_>, rng: &mut Stream) -> Pose {
        let p = &self.params;
        disturbed(ideal, p.position_sigma, p.sigma, rng)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Mount, Offset, Velocity, Yaw};

    fn tilted() -> Attitude {
        let degrees = Angle::from_degrees;
        Attitude::from_rpy(degrees(40.0), degrees(-50.0), Yaw::new(degrees(110.0)))
    }

    #[test]
    fn its_sigma_turns_what_it_reads_about_each_axis() {
        let params = [("sigma", "0.02 rad"), ("position_sigma", "0.3 m")];
        Trial::of("pose", &params).run(|bee, sensor: Handle<Pose>| {
            for attitude in [Attitude::IDENTITY, tilted()] {
                bee.set_attitude(attitude);
                let (mut turns, mut shifts) = (Vec::new(), Vec::new());
                for _ in 0..100_000 {
                    let read = bee.read(sensor);
                    turns.push((attitude.inverse() * read.attitude).log().si());
                    shifts.push((read.position - bee.position()).si());
                }
                for axis in 0..3 {
                    let about: Vec<f64> = turns.iter().map(|turn| turn[axis]).collect();
                    assert_normal(&about, 0.0, 0.02);
                    let along: Vec<f64> = shifts.iter().map(|shift| shift[axis]).collect();
                    assert_normal(&along, 0.0, 0.3);
                }
            }
        });
    }

    #[test]
    fn it_reads_the_pose_of_its_mount_in_motion() {
        let mut trial = Trial::of("pose", &[("sigma", "0 rad")]);
        let mount = Mount::new(Offset::from_xyz(0.1, 0.0, 0.2), tilted());
        trial.mount = mount;
        (trial.every, trial.seconds) = (simbeeotic_model::units::Time::from_secs(0.5), 3);
        trial.run(move |bee, sensor: Handle<Pose>| {
            bee.set_velocity(Velocity::from_xyz(1.0, 2.0, 0.0));
            bee.set_attitude(tilted());
            let (read, want) = (bee.read(sensor), bee.pose() * mount);
            assert!(read.position.distance(want.position).get() < 1e-12);
            assert!(read.attitude.angle_to(want.attitude).get() < 1e-7);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [("sigma", "-1 deg"), ("position_sigma", "-1 m")] {
            let refusal = refusal("pose", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
    }
}
