//! Grids of rays that see how the picture moves: the theory is in [`flow`](super::flow).

use super::bounds::{at_least_zero, positive, reach};
use super::flow::{FlowPoint, OpticalFlow, flow};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{
    Angle, AngularRate, Attitude, Enu, Flu, Length, Pose, Rate, V3, Velocity,
};
use simbeeotic_model::{
    Beams, BuildError, Ray, Seen, SeesWhat, Sensor, Thing, Truth, params, sensor,
};

/// The depth and relative velocity of what the sensor sees along one ray of its picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight {
    pub(super) depth: Length,
    /// In the sensor's axes.
    pub(super) velocity: Velocity<Flu>,
}

/// What a camera at `pose` sees along rays of its picture, none farther than `range` (along the ray).
pub(super) fn look(
    truth: &Truth<'_>,
    pose: Pose,
    places: &[[f64; 2]],
    range: Length,
    sees: SeesWhat,
) -> Vec<Option<(Sight, Length)>> {
    let rays: Vec<Ray> = places
        .iter()
        .map(|[x, y]| Ray {
            origin: pose.position,
            direction: (pose.attitude.quat() * DVec3::new(1.0, -x, -y)).to_array(),
            range,
        })
        .collect();
    // A pose that is not finite ends the run elsewhere; here it sees nothing.
    let hits = truth.cast_rays(&rays, sees).unwrap_or_default();
    let seen = |([x, y], hit): (&[f64; 2], Option<Seen>)| {
        let hit = hit?;
        let velocity = truth.sensor_velocity() - velocity_of(truth, &hit);
        let sight = Sight {
            depth: hit.distance / (1.0 + x * x + y * y).sqrt(),
            velocity: pose.attitude.unrotate(velocity),
        };
        Some((sight, hit.distance))
    };
    places.iter().zip(hits).map(seen).collect()
}

/// How the surface that was hit moves.
fn velocity_of(truth: &Truth<'_>, hit: &Seen) -> Velocity<Enu> {
    let Thing::Model(id) = hit.thing else {
        return Velocity::ZERO;
    };
    match (truth.pose_of(id), truth.twist_of(id)) {
        (Some(pose), Some(twist)) => twist.velocity_at(pose.to_body(hit.point), pose.attitude),
        _ => Velocity::ZERO,
    }
}

/// The body rate in the axes of a camera that is turned against the sensor's mount.
fn turned(rate: Rate<Flu>, camera: Attitude) -> Rate<Flu> {
    camera.unrotate(Rate::from_si(rate.si()))
}

/// Where a grid looks, and what it makes of it.
struct Grid {
    places: Vec<[f64; 2]>,
    sigma: AngularRate,
    ranges: (Length, Length),
    sees: SeesWhat,
    /// Mount from camera.
    camera: Attitude,
}

impl Grid {
    fn new(params: &OpticalFlowParams, camera: Attitude) -> Result<Self, BuildError> {
        at_least_zero("sigma", params.sigma)?;
        at_least_zero("min_range", params.min_range)?;
        reach("max_range", params.max_range)?;
        if params.min_range >= params.max_range {
            let message = format!("must be less than `max_range`, and is {}", params.min_range);
            return Err(BuildError::parameter("min_range", message));
        }
        in_range("rays", params.rays, 1..=101)?;
        let widest = Angle::from_degrees(80.0);
        positive("half_angle", params.half_angle)?;
        in_range("half_angle", params.half_angle, Angle::ZERO..=widest)?;
        let tangent = |step: u32| {
            // From -1 to 1 in equal angles; a single ray looks straight ahead.
            let share = f64::from(2 * step) / f64::from((params.rays - 1).max(1)) - 1.0;
            let share = if params.rays == 1 { 0.0 } else { share };
            (params.half_angle * share).tan()
        };
        let rows = 0..params.rays;
        let row = |y: u32| (0..params.rays).map(move |x| [tangent(x), tangent(y)]);
        Ok(Self {
            places: rows.flat_map(row).collect(),
            sigma: params.sigma,
            ranges: (params.min_range, params.max_range),
            sees: params.sees,
            camera,
        })
    }

    /// The rays of its grid; of a fine one only some.
    fn beams(&self) -> Beams {
        let direction = |[x, y]: &[f64; 2]| {
            let ahead = DVec3::new(1.0, -x, -y).normalize();
            (self.camera.quat() * ahead).to_array()
        };
        let step = self.places.len().div_ceil(Beams::RAYS_MAX);
        let places = self.places.iter().step_by(step);
        Beams::Rays {
            directions: places.map(direction).collect(),
            range_m: self.ranges.1.get(),
        }
    }

    fn ideal(&self, truth: &Truth<'_>) -> OpticalFlow {
        let mounted = truth.sensor_pose();
        let pose = Pose::new(mounted.position, mounted.attitude * self.camera);
        let rate = turned(truth.sensor_rate(), self.camera);
        let (nearest, farthest) = self.ranges;
        let seen = look(truth, pose, &self.places, farthest, self.sees);
        let point = |(at, seen): (&[f64; 2], Option<(Sight, Length)>)| FlowPoint {
            at: *at,
            flow: seen
                .filter(|(_, distance)| *distance >= nearest)
                .map(|(sight, _)| flow(*at, sight.depth, sight.velocity, rate).sum())
                .map(|flow| flow.map(AngularRate::si)),
        };
        OpticalFlow {
            points: self.places.iter().zip(seen).map(point).collect(),
        }
    }

    fn measure(&self, mut ideal: OpticalFlow, rng: &mut Stream) -> OpticalFlow {
        for part in ideal
            .points
            .iter_mut()
            .filter_map(|p| p.flow.as_mut())
            .flatten()
        {
            *part += self.sigma * rng.normal();
        }
        ideal
    }
}

/// Measures how the picture ahead moves, at each place of a grid of rays.
///
/// By default five by five rays, 15 degrees apart, about the forward axis of its mount. What is nearer
/// than `min_range` or farther than `max_range` gives no flow. The reading has both components at each
/// place, each with a normal error; with a gyroscope and a velocity it tells depths
/// ([`OpticalFlow::depths`]). The original took velocities times their own length, so that its depths were
/// right at 1 m/s alone.
#[sensor(
    "optical-flow",
    java = "harvard.robobees.simbeeotic.model.sensor.DefaultOpticalMotionSensor"
)]
pub struct OpticalFlowSensor(Grid);

/// Parameters of [`OpticalFlowSensor`].
#[params]
pub struct OpticalFlowParams {
    /// Standard deviation of each component of the flow. 0 or more.
    pub sigma: AngularRate,
    /// What is nearer gives no flow. 0 or more.
    pub min_range: Length,
    /// What is farther gives no flow. Above `min_range`.
    pub max_range: Length,
    /// Rays in each row and in each column. 1 to 101.
    pub rays: u32,
    /// How far the grid reaches from its middle, to each side. Above 0, at most 80 degrees.
    pub half_angle: Angle,
    /// What has a picture; the rest is looked through.
    pub sees: SeesWhat,
}

impl Default for OpticalFlowParams {
    fn default() -> Self {
        Self {
            sigma: AngularRate::si(0.05),
            min_range: Length::si(0.1),
            max_range: Length::si(20.0),
            rays: 5,
            half_angle: Angle::from_degrees(30.0),
            sees: SeesWhat::EVERYTHING,
        }
    }
}

impl Sensor for OpticalFlowSensor {
    type Params = OpticalFlowParams;
    type Reading = OpticalFlow;

    fn build(params: OpticalFlowParams) -> Result<Self, BuildError> {
        Grid::new(&params, Attitude::IDENTITY).map(Self)
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> OpticalFlow {
        self.0.ideal(truth)
    }

    fn measure(&mut self, ideal: OpticalFlow, _: &Truth<'_>, rng: &mut Stream) -> OpticalFlow {
        self.0.measure(ideal, rng)
    }

    fn beams(&self) -> Option<Beams> {
        Some(self.0.beams())
    }
}

/// Measures how the picture below moves, as `optical-flow` does ahead.
///
/// By default three by three rays, 30 degrees apart, about the downward axis of its mount. The upper edge
/// of its picture is to the front, its right to the right. In the original the mean depth of this one was
/// always 0.
#[sensor(
    "optical-flow-down",
    java = "harvard.robobees.simbeeotic.model.sensor.BottomOpticalMotionSensor"
)]
pub struct OpticalFlowDown(Grid);

/// Parameters of [`OpticalFlowDown`].
#[params]
pub struct OpticalFlowDownParams {
    /// Standard deviation of each component of the flow. 0 or more.
    pub sigma: AngularRate,
    /// What is nearer gives no flow. 0 or more.
    pub min_range: Length,
    /// What is farther gives no flow. Above `min_range`.
    pub max_range: Length,
    /// Rays in each row and in each column. 1 to 101.
    pub rays: u32,
    /// How far the grid reaches from its middle, to each side. Above 0, at most 80 degrees.
    pub half_angle: Angle,
    /// What has a picture; the rest is looked through.
    pub sees: SeesWhat,
}

impl Default for OpticalFlowDownParams {
    fn default() -> Self {
        let OpticalFlowParams {
            sigma,
            min_range,
            max_range,
            half_angle,
            sees,
            ..
        } = OpticalFlowParams::default();
        Self {
            sigma,
            min_range,
            max_range,
            rays: 3,
            half_angle,
            sees,
        }
    }
}

/// From looking ahead to looking down.
pub(super) fn downwards() -> Attitude {
    Attitude::about(DVec3::Y, Angle::QUARTER_TURN)
}

/// A rate or velocity along the axes of an `optical-flow-down`'s mount, along the axes of its camera: what
/// its [`OpticalFlow::depths`] wants.
pub fn seen_from_below<Q>(in_mount: V3<Q, Flu>) -> V3<Q, Flu> {
    downwards().unrotate(V3::from_si(in_mount.si()))
}

impl Sensor for OpticalFlowDown {
    type Params = OpticalFlowDownParams;
    type Reading = OpticalFlow;

    fn build(params: OpticalFlowDownParams) -> Result<Self, BuildError> {
        let OpticalFlowDownParams {
            sigma,
            min_range,
            max_range,
            rays,
            half_angle,
            sees,
        } = params;
        let params = OpticalFlowParams {
            sigma,
            min_range,
            max_range,
            rays,
            half_angle,
            sees,
        };
        Grid::new(&params, downwards()).map(Self)
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> OpticalFlow {
        self.0.ideal(truth)
    }

    fn measure(&mut self, ideal: OpticalFlow, _: &Truth<'_>, rng: &mut Stream) -> OpticalFlow {
        self.0.measure(ideal, rng)
    }

    fn beams(&self) -> Option<Beams> {
        Some(self.0.beams())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::flow::Side;
    use crate::sensor::scene::block;
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::Yaw;
    use simbeeotic_model::world::World;

    type Reader = Handle<OpticalFlow>;

    fn flow_of(point: &FlowPoint) -> [f64; 2] {
        point
            .flow
            .expect("something in range")
            .map(AngularRate::get)
    }

    #[test]
    fn over_a_plane_the_middle_flows_by_speed_over_height() {
        let trial = Trial::of("optical-flow-down", &[("sigma", "0 rad/s")]);
        trial.run(|bee, sensor: Reader| {
            let height = bee.position().up().get();
            for yaw in [0.0, 75.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                bee.set_velocity_flu(Velocity::from_xyz(2.0, 0.5, 0.0));
                let read = bee.read(sensor);
                assert_eq!(read.points.len(), 9);
                // The ground goes to the back, which is down in the picture, and to the right.
                let [x, y] = flow_of(&read.points[4]);
                assert!((x - 0.5 / height).abs() < 1e-12, "{x}");
                assert!((y - 2.0 / height).abs() < 1e-12, "{y}");
                // A plane at right angles has one depth everywhere.
                for point in &read.points {
                    assert!((flow_of(point)[1] - 2.0 / height).abs() < 1e-12);
                }
            }
        });
    }

    #[test]
    fn climbing_spreads_the_picture_towards_its_middle() {
        let trial = Trial::of("optical-flow-down", &[("sigma", "0 rad/s")]);
        trial.run(|bee, sensor: Reader| {
            let height = bee.position().up().get();
            bee.set_velocity(Velocity::from_xyz(0.0, 0.0, 1.0));
            for point in &bee.read(sensor).points {
                let [x, y] = flow_of(point);
                assert!((x + point.at[0] / height).abs() < 1e-12);
                assert!((y + point.at[1] / height).abs() < 1e-12);
            }
        });
    }

    #[test]
    fn a_turn_about_the_view_turns_the_picture_and_a_nod_shifts_it() {
        let trial = Trial::of("optical-flow-down", &[("sigma", "0 rad/s")]);
        trial.run(|bee, sensor: Reader| {
            // Yaw to the left turns the ground clockwise seen from above, whatever the height.
            bee.set_rate(Rate::from_xyz(0.0, 0.0, 0.5));
            for point in &bee.read(sensor).points {
                let ([x, y], [at_x, at_y]) = (flow_of(point), point.at);
                assert!((x + 0.5 * at_y).abs() < 1e-12, "{x}, {y} at {at_x}, {at_y}");
                assert!((y - 0.5 * at_x).abs() < 1e-12, "{x}, {y} at {at_x}, {at_y}");
            }
            // Nose down: the camera swings to the back, and the ground goes to the front, up.
            bee.set_rate(Rate::from_xyz(0.0, 0.5, 0.0));
            let [x, y] = flow_of(&bee.read(sensor).points[4]);
            assert!(x.abs() < 1e-12 && (y + 0.5).abs() < 1e-12, "{x}, {y}");
        });
    }

    #[test]
    fn depths_do_not_depend_on_how_fast_one_flies_and_turns() {
        let trial = Trial::of("optical-flow-down", &[("sigma", "0 rad/s")]);
        trial.run(|bee, sensor: Reader| {
            let height = bee.position().up();
            for speed in [0.25, 1.0, 4.0] {
                let (v, w) = (
                    Velocity::from_xyz(speed, -0.3 * speed, 0.1 * speed),
                    Rate::from_xyz(0.4, -0.2, 0.7),
                );
                bee.set_velocity_flu(v);
                bee.set_rate(w);
                let read = bee.read(sensor);
                let (v, w) = (seen_from_below(v), seen_from_below(w));
                for depth in read.depths(v, w) {
                    let depth = depth.expect("a plane all round");
                    assert!(
                        (depth - height).get().abs() < 1e-9,
                        "{depth} at {speed} m/s"
                    );
                }
                let mean = read.mean_depth(v, w).expect("a plane all round");
                assert!((mean - height).get().abs() < 1e-9);
            }
        });
    }

    #[test]
    fn it_tells_on_which_side_the_nearest_is() {
        for (at, side) in [(1.5, Side::Left), (-1.5, Side::Right)] {
            let mut trial = Trial::of("optical-flow", &[("sigma", "0 rad/s")]);
            // A wall ahead, and a pillar on one side before it.
            trial.world = World {
                obstacles: vec![
                    block([10.0, 0.0, 0.0], [1.0, 40.0, 40.0]),
                    block([4.0, at, 0.0], [0.5, 1.0, 40.0]),
                ],
                ..World::default()
            };
            trial.run(move |bee, sensor: Reader| {
                let velocity = Velocity::from_xyz(0.0, 0.0, 1.0);
                bee.set_velocity_flu(velocity);
                let read = bee.read(sensor);
                assert_eq!(read.points.len(), 25);
                assert_eq!(read.side_of_nearest(velocity, Rate::ZERO), Some(side));
                let nearest = read.nearest(velocity, Rate::ZERO).expect("the pillar");
                assert!((nearest.get() - 3.75).abs() < 1e-9, "{nearest}");
            });
        }
    }

    #[test]
    fn out_of_range_there_is_no_flow() {
        let params = [("sigma", "0 rad/s"), ("max_range", "10.5 m")];
        Trial::of("optical-flow-down", &params).run(|bee, sensor: Reader| {
            // From 10.05 m only the middle is near enough.
            bee.set_velocity(Velocity::from_xyz(1.0, 0.0, 0.0));
            let read = bee.read(sensor);
            let seen: Vec<bool> = read.points.iter().map(|p| p.flow.is_some()).collect();
            assert_eq!(seen.iter().filter(|seen| **seen).count(), 1);
            assert!(seen[4]);
            // Flying to what one looks at tells no depth in the middle.
            assert_eq!(
                read.nearest(Velocity::from_xyz(1.0, 0.0, 0.0), Rate::ZERO),
                None
            );
        });
    }

    #[test]
    fn the_noise_is_as_large_as_it_says() {
        let trial = Trial::of(
            "optical-flow-down",
            &[("sigma", "0.3 rad/s"), ("rays", "1")],
        );
        trial.run(|bee, sensor: Reader| {
            let read: Vec<f64> = (0..100_000)
                .map(|_| flow_of(&bee.read(sensor).points[0])[0])
                .collect();
            assert_normal(&read, 0.0, 0.3);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for kind in ["optical-flow", "optical-flow-down"] {
            for (key, text) in [
                ("sigma", "-1 rad/s"),
                ("min_range", "-1 m"),
                ("min_range", "20 m"),
                ("max_range", "0 m"),
                ("rays", "0"),
                ("half_angle", "0 deg"),
                ("half_angle", "85 deg"),
            ] {
                let refusal = refusal(kind, &[(key, text)]);
                let refusal = refusal.unwrap_or_else(|| panic!("{kind} takes {key} = {text}"));
                assert!(refusal.contains(key), "{refusal}");
            }
        }
    }
}
