//! Motion capture: cameras on the walls that see where one is.

use super::bounds::{at_least_zero, place};
use super::pose::disturbed;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Length, Pose, Position};
use simbeeotic_model::{BuildError, SeesWhat, Sensor, Truth, params, sensor};

/// Measures its own pose as a motion capture system does: well within a millimetre, while it is seen.
///
/// It reads `None` outside of the volume between the corners `from` and `to`, and where fewer than
/// `min_cameras` of the `cameras` have a free line of sight to it. The defaults are those of a Vicon system.
/// Such a system has a `rate` of 100 to 500 Hz and a `delay` of some milliseconds; those are keys of every
/// sensor.
///
/// Source: P. Merriaux et al., *A Study of Vicon System Positioning Performance*, Sensors 17 (2017) 1591,
/// abstract: a mean error of 0.15 mm at rest, which is 0.094 mm of sigma on each axis, and less than 2 mm in
/// motion. It gives no error of attitudes; 0.1 degrees is that of markers 5 cm apart.
#[sensor("mocap")]
pub struct Mocap {
    params: MocapParams,
}

/// Parameters of [`Mocap`].
#[params]
pub struct MocapParams {
    /// Standard deviation of the position, along each axis. 0 or more.
    pub sigma: Length,
    /// Standard deviation of the attitude, about each axis. 0 or more.
    pub attitude_sigma: Angle,
    /// The corner of the volume with the least coordinates; it has no bounds there unless said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub from: Option<Position>,
    /// The corner of the volume with the greatest coordinates; it has no bounds there unless said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub to: Option<Position>,
    /// Where the cameras are. Without any, nothing is in the way of them.
    pub cameras: Vec<Position>,
    /// How many of them must see it. At most as many as there are, if there are any.
    pub min_cameras: usize,
    /// What is in their way.
    pub sees: SeesWhat,
}

impl Default for MocapParams {
    fn default() -> Self {
        Self {
            sigma: Length::from_millimetres(0.094),
            attitude_sigma: Angle::from_degrees(0.1),
            from: None,
            to: None,
            cameras: Vec::new(),
            min_cameras: 2,
            sees: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for Mocap {
    type Params = MocapParams;
    type Reading = Option<Pose>;

    fn build(params: MocapParams) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        at_least_zero("attitude_sigma", params.attitude_sigma)?;
        for camera in &params.cameras {
            place("cameras", *camera)?;
        }
        if let (Some(from), Some(to)) = (params.from, params.to)
            && !from.si().cmplt(to.si()).all()
        {
            let message =
                format!("must be greater than `from`, {from}, along each axis, and is {to}");
            return Err(BuildError::parameter("to", message));
        }
        if !params.cameras.is_empty() && params.min_cameras > params.cameras.len() {
            let message = format!(
                "must be at most {}, as there are cameras",
                params.cameras.len()
            );
            return Err(BuildError::parameter("min_cameras", message));
        }
        Ok(Self { params })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Option<Pose> {
        Some(truth.sensor_pose())
    }

    fn measure(
        &mut self,
        ideal: Option<Pose>,
        truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Option<Pose> {
        let p = &self.params;
        let read = ideal.map(|pose| disturbed(pose, p.sigma, p.attitude_sigma, rng));
        read.filter(|_| self.is_seen(truth))
    }
}

impl Mocap {
    fn is_seen(&self, truth: &Truth<'_>) -> bool {
        let (p, place) = (&self.params, truth.sensor_pose().position);
        let above = p.from.is_none_or(|from| place.si().cmpge(from.si()).all());
        let below = p.to.is_none_or(|to| place.si().cmple(to.si()).all());
        if !(above && below) {
            return false;
        }
        let sees = |camera: &&Position| truth.is_free(place, **camera, None, p.sees);
        p.cameras.is_empty() || p.cameras.iter().filter(sees).count() >= p.min_cameras
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::scene::block;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Mount, Offset, Velocity, Yaw};
    use simbeeotic_model::world::World;

    type Reader = Handle<Option<Pose>>;

    #[test]
    fn where_no_ray_can_be_cast_no_camera_sees() {
        let params = [
            ("cameras", "[[-1e6 m, 0 m, 10 m]]"),
            ("min_cameras", "1"),
            ("sees", "[obstacles]"),
        ];
        Trial::of("mocap", &params).run(|bee, sensor: Reader| {
            assert!(bee.read(sensor).is_some());
            bee.set_position(Position::from_xyz(9.995e8, 0.0, 10.0));
            assert_eq!(bee.read(sensor), None);
            bee.set_position(Position::from_xyz(0.0, 0.0, 10.0));
        });
    }

    #[test]
    fn it_reads_the_pose_within_a_fraction_of_a_millimetre() {
        let mut trial = Trial::of("mocap", &[]);
        let mount = Mount::new(Offset::from_xyz(0.0, 0.0, 0.05), Attitude::IDENTITY);
        trial.mount = mount;
        trial.run(move |bee, sensor: Reader| {
            bee.set_velocity(Velocity::from_xyz(5.0, 0.0, 0.0));
            for yaw in [0.0, 100.0] {
                bee.set_attitude(Attitude::from_rpy(
                    Angle::from_degrees(yaw),
                    Angle::from_degrees(30.0),
                    Yaw::new(Angle::from_degrees(yaw)),
                ));
                let truth = bee.pose() * mount;
                let (mut along, mut about, mut off_mm) = (Vec::new(), Vec::new(), 0.0);
                for _ in 0..100_000 {
                    let read = bee.read(sensor).expect("seen");
                    let off = read.position - truth.position;
                    off_mm += off.length().millimetres() / 1e5;
                    along.push(off.up().get());
                    let turn = (truth.attitude.inverse() * read.attitude).log();
                    about.push(turn.si().y);
                }
                assert_normal(&along, 0.0, 0.094e-3);
                assert_normal(&about, 0.0, 0.1_f64.to_radians());
                // The figure of the paper: the mean of the distance.
                assert!((off_mm - 0.15).abs() < 0.001, "{off_mm} mm");
            }
        });
    }

    #[test]
    fn a_volume_has_its_corners_in_order() {
        let sensor = |from: f64, to: f64| MocapParams {
            from: Some(Position::from_xyz(-5.0, -5.0, from)),
            to: Some(Position::from_xyz(5.0, 5.0, to)),
            ..MocapParams::default()
        };
        assert!(Mocap::build(sensor(0.0, 3.0)).is_ok());
        let fault = Mocap::build(sensor(3.0, 3.0)).map(drop).expect_err("flat");
        assert!(fault.to_string().contains("to"), "{fault}");
    }

    #[test]
    fn a_bee_that_leaves_the_volume_is_lost_and_found_again() {
        let params = [("from", "[-5 m, -5 m, 0 m]"), ("to", "[5 m, 5 m, 12 m]")];
        Trial::of("mocap", &params).run(|bee, sensor: Reader| {
            for (east, up, seen) in [(1.0, 11.9, true), (1.0, 12.1, false), (-6.0, 3.0, false)] {
                bee.set_position(Position::from_xyz(east, 1.0, up));
                assert_eq!(bee.read(sensor).is_some(), seen, "{east} m, {up} m");
            }
        });
    }

    #[test]
    fn behind_a_pillar_it_takes_two_cameras_that_see_it() {
        let params = [(
            "cameras",
            "[[-8 m, 0 m, 3 m], [8 m, 0 m, 3 m], [0 m, 8 m, 3 m]]",
        )];
        let mut trial = Trial::of("mocap", &params);
        // Two pillars to the west and to the north of the place.
        trial.world = World {
            obstacles: vec![
                block([-4.0, 0.0, 0.0], [1.0, 1.0, 5.0]),
                block([0.0, 4.0, 0.0], [1.0, 1.0, 5.0]),
            ],
            ..World::default()
        };
        trial.run(|bee, sensor: Reader| {
            for (north, seen) in [(0.0, false), (2.5, true)] {
                bee.set_position(Position::from_xyz(0.0, north, 3.0));
                assert_eq!(bee.read(sensor).is_some(), seen, "{north} m");
            }
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [("sigma", "-1 mm"), ("attitude_sigma", "-1 deg")] {
            let refusal = refusal("mocap", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key), "{refusal}");
        }
        let params = MocapParams {
            cameras: vec![Position::ZERO],
            ..MocapParams::default()
        };
        let fault = Mocap::build(params).map(drop).expect_err("one of two");
        assert!(fault.to_string().contains("min_cameras"), "{fault}");
    }
}
