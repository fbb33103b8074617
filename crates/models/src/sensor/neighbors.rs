//! Who is near, and in which direction.

use super::bounds::{at_least_zero, positive, reach};
use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::{ModelId, Stream};
use simbeeotic_model::physics::Kind;
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{Angle, Flu, Length, Offset, Speed, Velocity, math};
use simbeeotic_model::{
    Beams, BuildError, Column, Reading, SeesWhat, Sensor, Truth, params, sensor,
};

/// Measures where other vehicles are, seen from its own place: bearing, elevation and distance, the nearest
/// first.
///
/// Bearing is the angle to the left of the sensor's forward axis, elevation the angle above its
/// forward-left plane. Each has a normal error; so has the velocity relative to the sensor, if it is asked
/// for. What counts are the middles of bodies. It is an ideal of what cameras, microphones or infrared rings
/// do: a swarm model's sense of its neighbours, with no hardware behind it.
#[sensor("neighbors")]
pub struct Neighbors {
    params: NeighborsParams,
}

/// One neighbour that a [`Neighbors`] sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Neighbor {
    /// Who it is, if the sensor tells.
    pub id: Option<ModelId>,
    /// To the left of the forward axis, -180 to 180 degrees.
    pub bearing: Angle,
    /// Above the forward-left plane, -90 to 90 degrees.
    pub elevation: Angle,
    /// How far.
    pub distance: Length,
    /// How it moves relative to the sensor, along the sensor's axes, if the sensor tells.
    pub velocity: Option<Velocity<Flu>>,
}

impl Neighbor {
    /// Where it is, along the sensor's axes.
    pub fn offset(&self) -> Offset {
        let (up, level) = self.elevation.sin_cos();
        let (left, forward) = self.bearing.sin_cos();
        Offset::along(DVec3::new(level * forward, level * left, up), self.distance)
    }
}

impl Reading for Neighbor {
    const COLUMNS: &'static [Column] = &[
        Column::new("model", "1"),
        Column::new("bearing", "rad"),
        Column::new("elevation", "rad"),
        Column::new("distance", "m"),
        Column::new("vx", "m/s"),
        Column::new("vy", "m/s"),
        Column::new("vz", "m/s"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        to.push(self.id.map_or(f64::NAN, |id| f64::from(id.0)));
        to.extend([
            self.bearing.get(),
            self.elevation.get(),
            self.distance.get(),
        ]);
        self.velocity.numbers(to);
    }
}

/// Parameters of [`Neighbors`].
#[params]
pub struct NeighborsParams {
    /// Who is farther is not seen. Above 0.
    pub max_range: Length,
    /// How wide it sees, from left to right. Above 0, at most 360 degrees.
    pub width: Angle,
    /// How high it sees, from below to above. Above 0, at most 180 degrees.
    pub height: Angle,
    /// At most so many are read, the nearest; 0: all of them.
    pub max_count: usize,
    /// Standard deviation of bearing and elevation. 0 or more.
    pub angle_sigma: Angle,
    /// Standard deviation of the distance, as a fraction of it. 0 or more.
    pub distance_sigma: f64,
    /// Whether it tells who they are.
    pub ids: bool,
    /// Whether it tells how they move.
    pub velocities: bool,
    /// Standard deviation of the velocity, on each axis. 0 or more.
    pub velocity_sigma: Speed,
    /// Whether something in between hides them.
    pub occlusion: bool,
    /// What hides them, with `occlusion`.
    pub hidden_by: SeesWhat,
    /// Who counts as a neighbour: models, that is `vehicles`, `stations`, `ghosts`.
    pub sees: SeesWhat,
}

impl Default for NeighborsParams {
    fn default() -> Self {
        Self {
            max_range: Length::si(10.0),
            width: Angle::TURN,
            height: Angle::HALF_TURN,
            max_count: 0,
            angle_sigma: Angle::from_degrees(2.0),
            distance_sigma: 0.05,
            ids: true,
            velocities: false,
            velocity_sigma: Speed::si(0.1),
            occlusion: false,
            hidden_by: SeesWhat::EVERYTHING,
            sees: SeesWhat::only(&[Kind::Vehicle, Kind::Ghost]),
        }
    }
}

impl Sensor for Neighbors {
    type Params = NeighborsParams;
    type Reading = Vec<Neighbor>;

    fn build(params: NeighborsParams) -> Result<Self, BuildError> {
        reach("max_range", params.max_range)?;
        positive("width", params.width)?;
        in_range("width", params.width, Angle::ZERO..=Angle::TURN)?;
        positive("height", params.height)?;
        in_range("height", params.height, Angle::ZERO..=Angle::HALF_TURN)?;
        at_least_zero("angle_sigma", params.angle_sigma)?;
        at_least_zero("distance_sigma", params.distance_sigma)?;
        at_least_zero("velocity_sigma", params.velocity_sigma)?;
        let models = [Kind::Vehicle, Kind::Station, Kind::Ghost];
        let mut others = params.sees.kinds().iter();
        if let Some(kind) = others.find(|kind| !models.contains(kind)) {
            let message = format!(
                "has `{kind:?}`, and no model is one: `vehicles`, `stations` and `ghosts` can be neighbours"
            );
            return Err(BuildError::parameter("sees", message));
        }
        Ok(Self { params })
    }

    fn ideal(&mut self, truth: &Truth<'_>) -> Vec<Neighbor> {
        let p = &self.params;
        // A little farther: the distance counts from the sensor and not from the host's middle.
        let reach = p.max_range + truth.mount().position.length();
        let others = truth.neighbors(reach).into_iter();
        let others = others.filter(|id| truth.kind_of(*id).is_some_and(|kind| p.sees.sees(kind)));
        let mut seen: Vec<Neighbor> = others.filter_map(|id| self.seen(truth, id)).collect();
        // By id already: the sort is stable.
        seen.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        if p.occlusion {
            let mut left = if p.max_count == 0 {
                usize::MAX
            } else {
                p.max_count
            };
            seen.retain(|other| {
                let is_free = left > 0 && self.is_in_sight(truth, other);
                left -= usize::from(is_free);
                is_free
            });
        } else if p.max_count > 0 {
            seen.truncate(p.max_count);
        }
        seen
    }

    fn measure(
        &mut self,
        mut ideal: Vec<Neighbor>,
        _truth: &Truth<'_>,
        rng: &mut Stream,
    ) -> Vec<Neighbor> {
        let p = &self.params;
        for other in &mut ideal {
            other.bearing = (other.bearing + p.angle_sigma * rng.normal()).wrapped();
            let elevation = other.elevation + p.angle_sigma * rng.normal();
            other.elevation = elevation.clamp(-Angle::QUARTER_TURN, Angle::QUARTER_TURN);
            let distance = other.distance * (1.0 + p.distance_sigma * rng.normal());
            other.distance = distance.max(Length::ZERO);
            if let Some(velocity) = &mut other.velocity {
                let error = DVec3::new(rng.normal(), rng.normal(), rng.normal());
                *velocity += Velocity::from_si(error * p.velocity_sigma.get());
            }
            if !p.ids {
                other.id = None;
            }
        }
        ideal
    }

    fn beams(&self) -> Option<Beams> {
        let p = &self.params;
        Some(Beams::window(p.width, p.height, p.max_range))
    }
}

impl Neighbors {
    /// As it is seen without errors, if it is in range and in view.
    fn seen(&self, truth: &Truth<'_>, id: ModelId) -> Option<Neighbor> {
        let (p, pose) = (&self.params, truth.sensor_pose());
        let offset = pose.to_body(truth.pose_of(id)?.position).si();
        let level = math::hypot(offset.x, offset.y);
        let bearing = Angle::si(math::atan2(offset.y, offset.x));
        let elevation = Angle::si(math::atan2(offset.z, level));
        let velocity = match p.velocities {
            true => {
                let apart = truth.twist_of(id)?.linear - truth.sensor_velocity();
                Some(pose.attitude.unrotate(apart))
            }
            false => None,
        };
        let other = Neighbor {
            id: Some(id),
            bearing,
            elevation,
            distance: Length::si(offset.length()),
            velocity,
        };
        let in_view = bearing.abs() <= p.width / 2.0 && elevation.abs() <= p.height / 2.0;
        (in_view && other.distance <= p.max_range).then_some(other)
    }

    fn is_in_sight(&self, truth: &Truth<'_>, other: &Neighbor) -> bool {
        let here = truth.sensor_pose().position;
        let place = other.id.and_then(|id| truth.pose_of(id));
        place
            .is_some_and(|pose| truth.is_free(here, pose.position, other.id, self.params.hidden_by))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sensor::scene::{block, still};
    use crate::trial::{Trial, assert_normal, refusal};
    use simbeeotic_model::Handle;
    use simbeeotic_model::units::{Attitude, Mount, Yaw};
    use simbeeotic_model::world::World;

    type Reader = Handle<Vec<Neighbor>>;

    fn exact(more: &[(&'static str, &'static str)]) -> Trial {
        let quiet = [
            ("angle_sigma", "0 deg"),
            ("distance_sigma", "0"),
            ("velocity_sigma", "0 m/s"),
        ];
        let params: Vec<_> = quiet.into_iter().chain(more.iter().copied()).collect();
        let mut trial = Trial::of("neighbors", &params);
        // To the east, to the north, above, and far to the west.
        for (name, at) in [
            ("east", [6.0, 0.0, 10.0]),
            ("north", [0.0, 3.0, 10.0]),
            ("above", [0.0, 0.0, 14.0]),
            ("far", [-20.0, 0.0, 10.0]),
        ] {
            trial.others.push(still(name, at));
        }
        trial
    }

    fn degrees(angle: Angle) -> f64 {
        angle.degrees()
    }

    #[test]
    fn it_tells_bearing_elevation_and_distance_the_nearest_first() {
        exact(&[]).run(|bee, sensor: Reader| {
            for yaw in [0.0, 70.0] {
                bee.set_attitude(Attitude::from_yaw(Yaw::new(Angle::from_degrees(yaw))));
                let read = bee.read(sensor);
                let [north, above, east] = read[..] else {
                    panic!("{read:?}")
                };
                assert_eq!(north.id, bee.find("north"));
                for (other, bearing, elevation, distance) in
                    [(north, 90.0 - yaw, 0.0, 3.0), (east, -yaw, 0.0, 6.0)]
                {
                    assert!((degrees(other.bearing) - bearing).abs() < 1e-9);
                    assert!((degrees(other.elevation) - elevation).abs() < 1e-9);
                    assert!((other.distance.get() - distance).abs() < 1e-9);
                }
                assert!((degrees(above.elevation) - 90.0).abs() < 1e-6);
            }
        });
    }

    #[test]
    fn its_offset_is_where_the_other_is_from_a_tilted_mount_in_motion() {
        let mut trial = exact(&[("velocities", "true")]);
        let turn = |degrees| Angle::from_degrees(degrees);
        let tilted = Attitude::from_rpy(turn(40.0), turn(-30.0), Yaw::new(turn(150.0)));
        let mount = Mount::new(Offset::from_xyz(0.2, 0.1, 0.0), tilted);
        trial.mount = mount;
        trial.run(move |bee, sensor: Reader| {
            bee.set_attitude(tilted);
            bee.set_velocity(Velocity::from_xyz(1.0, -2.0, 0.5));
            let pose = bee.pose() * mount;
            for other in bee.read(sensor) {
                let id = other.id.expect("it tells");
                let place = bee.pose_of(id).expect("a body").position;
                let off = pose.to_world(other.offset()).distance(place);
                assert!(off.get() < 1e-9, "{off}");
                let apart = pose.attitude.rotate(other.velocity.expect("it tells")).si();
                assert!((apart - DVec3::new(-1.0, 2.0, -0.5)).length() < 1e-9);
            }
        });
    }

    #[test]
    fn out_of_view_and_beyond_the_count_nobody_is_seen() {
        for (params, want) in [
            (&[("width", "90 deg")][..], &["above", "east"][..]),
            (&[("height", "90 deg")], &["north", "east"]),
            (&[("max_count", "1")], &["north"]),
            (&[("max_range", "4.5 m")], &["north", "above"]),
            (
                &[("max_range", "30 m"), ("height", "1 deg")],
                &["north", "east", "far"],
            ),
        ] {
            exact(params).run(move |bee, sensor: Reader| {
                let read = bee.read(sensor).into_iter().filter_map(|other| other.id);
                let want: Vec<_> = want.iter().filter_map(|name| bee.find(name)).collect();
                assert_eq!(read.collect::<Vec<_>>(), want, "{params:?}");
            });
        }
    }

    #[test]
    fn a_wall_hides_them_if_it_is_asked() {
        for (occlusion, seen) in [("true", 2), ("false", 3)] {
            let mut trial = exact(&[("occlusion", occlusion), ("ids", "false")]);
            trial.world = World {
                obstacles: vec![block([3.0, 0.0, 0.0], [0.2, 2.0, 20.0])],
                ..World::default()
            };
            trial.run(move |bee, sensor: Reader| {
                let read = bee.read(sensor);
                assert_eq!(read.len(), seen);
                assert!(read.iter().all(|other| other.id.is_none()));
            });
        }
    }

    #[test]
    fn only_models_are_neighbours() {
        for sees in ["[vehicles, people]", "everything"] {
            let refusal = refusal("neighbors", &[("sees", sees)]).expect("it is refused");
            assert!(
                refusal.contains("sees") && refusal.contains("stations"),
                "{refusal}"
            );
        }
        assert_eq!(refusal("neighbors", &[("sees", "[stations]")]), None);
    }

    #[test]
    fn the_noise_is_as_large_as_it_says() {
        let params = [
            ("angle_sigma", "3 deg"),
            ("distance_sigma", "0.1"),
            ("max_count", "1"),
        ];
        let mut trial = Trial::of("neighbors", &params);
        trial.others.push(still("other", [5.0, 0.0, 10.0]));
        trial.run(|bee, sensor: Reader| {
            let read: Vec<Neighbor> = (0..100_000).map(|_| bee.read(sensor)[0]).collect();
            let of = |what: fn(&Neighbor) -> f64| read.iter().map(what).collect::<Vec<f64>>();
            assert_normal(&of(|other| other.bearing.degrees()), 0.0, 3.0);
            assert_normal(&of(|other| other.elevation.degrees()), 0.0, 3.0);
            assert_normal(&of(|other| other.distance.get()), 5.0, 0.5);
        });
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        for (key, text) in [
            ("max_range", "0 m"),
            ("width", "0 deg"),
            ("width", "361 deg"),
            ("height", "181 deg"),
            ("max_count", "-1"),
            ("angle_sigma", "-1 deg"),
            ("distance_sigma", "-0.1"),
            ("velocity_sigma", "-1 m/s"),
        ] {
            let refusal = refusal("neighbors", &[(key, text)]).expect("it is refused");
            assert!(refusal.contains(key) || refusal.contains(text), "{refusal}");
        }
    }
}
