//! Forces, torques and pushes at points, in both frames; ghosts that are driven from outside.

use crate::swarm::{model, run, setup};
use simbeeotic_model::host::{Platform, Ray, Station};
use simbeeotic_model::kernel::{ModelId, SimTime};
use simbeeotic_model::physics::{BodySpec, Mobility, Shape};
use simbeeotic_model::units::glam::DVec3;
use simbeeotic_model::units::{
    Attitude, ForceVec, ImpulseVec, Length, Offset, Pose, Position, Time, TorqueVec, Twist, V3,
    Velocity, Wrench, Yaw,
};
use simbeeotic_model::{
    Behavior, BuildError, Kit, ModelPlan, Simulation, Thing, Touch, behavior, params,
};

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

const MASS_KG: f64 = 0.5;
const RADIUS_M: f64 = 0.2;
/// Of a solid ball.
const MOMENT_KG_M2: f64 = 0.4 * MASS_KG * RADIUS_M * RADIUS_M;

fn ball() -> BodySpec {
    BodySpec {
        gravity: false,
        ..BodySpec::new(Shape::Sphere { radius_m: RADIUS_M }, MASS_KG)
    }
}

fn at(name: &str, kind: &str, [x, y, z]: [f64; 3]) -> ModelPlan {
    ModelPlan {
        start: Pose::new(Position::from_xyz(x, y, z), Attitude::IDENTITY),
        ..model(name, kind)
    }
}

/// Looks to the north and is pushed in every way, for a second each.
#[behavior("test-pushed", host = Station)]
struct Pushed {
    step: usize,
}

impl Behavior<Station> for Pushed {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.every(Time::from_secs(1.0), Self::next);
        Ok(Self { step: 0 })
    }

    fn body(_: &NoParams) -> Option<BodySpec> {
        Some(ball())
    }
}

/// What is done, and the velocity [ENU] and rate [FLU] that it leaves after a second.
type Step = (fn(&mut Platform<'_>), DVec3, DVec3);

/// Forward is north, left is west.
fn steps() -> Vec<Step> {
    let v = 1.0 / MASS_KG;
    let w = 0.1 / MOMENT_KG_M2;
    let forward = DVec3::new(0.0, v, 0.0);
    vec![
        (
            |b| b.set_force(ForceVec::from_xyz(0.0, 1.0, 0.0)),
            forward,
            DVec3::ZERO,
        ),
        (
            |b| b.set_force_flu(ForceVec::from_xyz(1.0, 0.0, 0.0)),
            forward,
            DVec3::ZERO,
        ),
        (
            |b| b.add_force(ForceVec::from_xyz(0.0, 1.0, 0.0)),
            forward,
            DVec3::ZERO,
        ),
        (
            |b| b.add_force_flu(ForceVec::from_xyz(1.0, 0.0, 0.0)),
            forward,
            DVec3::ZERO,
        ),
        // To the north at 0.1 m east of the middle, which is on the right: it turns left.
        (
            |b| {
                let point = b.position() + Position::from_xyz(0.1, 0.0, 0.0);
                b.add_force_at(ForceVec::from_xyz(0.0, 1.0, 0.0), point);
            },
            forward,
            DVec3::new(0.0, 0.0, w),
        ),
        (
            |b| {
                b.add_force_at_flu(
                    ForceVec::from_xyz(1.0, 0.0, 0.0),
                    Offset::from_xyz(0.0, -0.1, 0.0),
                )
            },
            forward,
            DVec3::new(0.0, 0.0, w),
        ),
        (
            |b| b.set_torque(TorqueVec::from_xyz(0.1, 0.0, 0.0)),
            DVec3::ZERO,
            DVec3::new(w, 0.0, 0.0),
        ),
        (
            |b| b.add_torque(TorqueVec::from_xyz(0.0, 0.1, 0.0)),
            DVec3::ZERO,
            DVec3::new(0.0, w, 0.0),
        ),
        (
            |b| b.add_torque_enu(TorqueVec::from_xyz(0.0, 0.1, 0.0)),
            DVec3::ZERO,
            DVec3::new(w, 0.0, 0.0),
        ),
        (
            |b| b.push(ImpulseVec::from_xyz(0.0, 1.0, 0.0)),
            forward,
            DVec3::ZERO,
        ),
        (
            |b| b.push_flu(ImpulseVec::from_xyz(1.0, 0.0, 0.0)),
            forward,
            DVec3::ZERO,
        ),
        (
            |b| {
                let point = b.position() + Position::from_xyz(0.1, 0.0, 0.0);
                b.push_at(ImpulseVec::from_xyz(0.0, 1.0, 0.0), point);
            },
            forward,
            DVec3::new(0.0, 0.0, w),
        ),
        (
            |b| {
                b.push_at_flu(
                    ImpulseVec::from_xyz(1.0, 0.0, 0.0),
                    Offset::from_xyz(0.0, -0.1, 0.0),
                )
            },
            forward,
            DVec3::new(0.0, 0.0, w),
        ),
        (
            |b| b.spin(TorqueVec::from_xyz(0.0, 0.0, 0.2), Time::si(0.5)),
            DVec3::ZERO,
            DVec3::new(0.0, 0.0, w),
        ),
        (
            |b| b.set_velocity_flu(Velocity::from_xyz(2.0, 0.0, 0.0)),
            forward,
            DVec3::ZERO,
        ),
        (
            |b| {
                b.set_wrench(Wrench {
                    force: ForceVec::from_xyz(0.0, 1.0, 0.0),
                    torque: TorqueVec::from_xyz(0.1, 0.0, 0.0),
                });
                assert!((b.force().si() - DVec3::Y).length() < 1e-12);
                assert!((b.torque().si() - DVec3::X * 0.1).length() < 1e-7);
            },
            forward,
            DVec3::new(w, 0.0, 0.0),
        ),
    ]
}

impl Pushed {
    fn next(&mut self, body: &mut Platform<'_>) {
        let steps = steps();
        if self.step > 0 {
            let (_, velocity, rate) = steps[self.step - 1];
            let twist = body.twist();
            let wrong =
                (twist.linear.si() - velocity).length() + (twist.angular.si() - rate).length();
            assert!(wrong < 1e-5, "step {}: {twist:?}", self.step - 1);
        }
        let Some((push, ..)) = steps.get(self.step) else {
            return body.end_run("all pushed");
        };
        body.set_pose(Pose::new(
            Position::from_xyz(0.0, 0.0, 5.0),
            Attitude::from_yaw(Yaw::NORTH),
        ));
        body.set_wrench(Wrench::default());
        body.set_twist(Twist::default());
        push(body);
        self.step += 1;
    }
}

#[test]
fn pushes_act_where_and_how_they_say() {
    let outcome = run(vec![at("ball", "test-pushed", [0.0; 3])], 60).run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert_eq!(outcome.summary.ended, "all pushed");
}

/// Floats where it is until it is hit.
#[behavior("test-floating", host = Station)]
struct Floating;

impl Behavior<Station> for Floating {
    type Params = NoParams;

    fn build(_: NoParams, _: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn body(_: &NoParams) -> Option<BodySpec> {
        Some(ball())
    }
}

/// A ghost: its poses come from outside, at 100 Hz; here from a circle of 10 m, once in 20 s.
#[behavior("test-ghost", host = Station)]
struct Ghost {
    touches: u32,
}

const GHOST_RADIUS_M: f64 = 0.5;

/// Where the ghost is said to be.
fn tracked(time: SimTime) -> (Pose, Twist) {
    let turns = time.as_secs_f64() / 20.0;
    let (sin, cos) = simbeeotic_model::units::math::sin_cos(std::f64::consts::TAU * turns);
    let speed = std::f64::consts::TAU * 10.0 / 20.0;
    let pose = Pose::new(
        Position::from_xyz(10.0 * sin, -10.0 * cos, 5.0),
        Attitude::IDENTITY,
    );
    let twist = Twist {
        linear: Velocity::from_xyz(speed * cos, speed * sin, 0.0),
        ..Twist::default()
    };
    (pose, twist)
}

impl Behavior<Station> for Ghost {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.every(Time::from_millis(10.0), Self::follow);
        Ok(Self { touches: 0 })
    }

    fn body(_: &NoParams) -> Option<BodySpec> {
        Some(BodySpec {
            mobility: Mobility::Driven,
            ..BodySpec::new(
                Shape::Sphere {
                    radius_m: GHOST_RADIUS_M,
                },
                1.0,
            )
        })
    }

    fn on_contact(&mut self, _: &Touch, ghost: &mut Platform<'_>) {
        let (pose, _) = tracked(ghost.now());
        let off = ghost.position().distance(pose.position);
        assert!(off.metres() < 1e-3, "pushed off its path by {off}");
        self.touches += 1;
    }

    fn on_finish(&mut self, ghost: &mut Platform<'_>) {
        let touches = self.touches;
        ghost.log(format!("{touches} touches"));
        assert!(touches >= 20, "{touches}");
    }
}

impl Ghost {
    fn follow(&mut self, ghost: &mut Platform<'_>) {
        let (pose, twist) = tracked(ghost.now());
        ghost.set_pose(pose);
        ghost.set_twist(twist);
    }
}

#[test]
fn a_ghost_flies_through_a_cloud_and_pushes_it_aside() {
    let mut plans = vec![at("ghost", "test-ghost", [0.0, -10.0, 5.0])];
    for i in 0..20 {
        // On its way, from the side it comes from, some a little above or below.
        let (pose, _) = tracked(SimTime::from_millis(1000 + 900 * i));
        let [x, y, z] = pose.position.si().to_array();
        let above = 0.2 * (i % 3) as f64 - 0.2;
        plans.push(at(&format!("ball-{i}"), "test-floating", [x, y, z + above]));
    }
    let mut run = Simulation::new(setup(plans, 20)).expect("it can be put together");
    let outcome = run.run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    for i in 0..20 {
        let twist = run.twist(&format!("ball-{i}")).expect("a body");
        assert!(
            twist.linear.length().metres_per_second() > 1.0,
            "ball {i} was not pushed: {twist:?}"
        );
    }
    let (pose, _) = tracked(SimTime::from_secs(20));
    let ghost = run.pose("ghost").expect("a body");
    assert!(ghost.position.distance(pose.position).metres() < 1e-9);
}

/// Asks where another is, now, before and later.
#[behavior("test-asks", host = Station)]
struct Asks;

impl Behavior<Station> for Asks {
    type Params = NoParams;

    fn build(_: NoParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.once(Time::from_secs(2.0), Self::ask);
        Ok(Self)
    }

    fn body(_: &NoParams) -> Option<BodySpec> {
        Some(BodySpec {
            v_enu: DVec3::new(1.0, 0.0, 0.0),
            ..ball()
        })
    }
}

impl Asks {
    fn ask(&mut self, body: &mut Platform<'_>) {
        let other = body.find("other").expect("it is there");
        let x = |time| {
            let state = body.state_of(other, SimTime::from_secs(time));
            state.map(|s| s.p_enu.x)
        };
        assert_eq!(
            (x(0), x(1), x(2), x(10)),
            (Some(0.0), Some(1.0), Some(2.0), Some(10.0))
        );
        assert_eq!(body.pose_of(other).expect("a body").position.si().x, 2.0);
        assert_eq!(
            body.twist_of(other).expect("a body").linear,
            Velocity::from_xyz(1.0, 0.0, 0.0)
        );
        assert_eq!(body.acceleration_of(other), Some(V3::ZERO));
        assert!(body.state_of(ModelId(99), SimTime::ZERO).is_none());
        assert_eq!(
            body.neighbors_of(Position::from_xyz(2.0, 0.0, 5.0), Length::si(0.5)),
            [other]
        );
        look_around(body, other);
        body.end_run("asked");
    }
}

#[test]
fn others_are_known_at_any_time_since_their_last_change() {
    let plans = vec![
        at("asks", "test-asks", [0.0, 3.0, 5.0]),
        at("other", "test-asks-not", [0.0, 0.0, 5.0]),
    ];
    let outcome = run(plans, 3).run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert_eq!(outcome.summary.ended, "asked");
}

/// Moves on at 1 m/s.
#[behavior("test-asks-not", host = Station)]
struct AsksNot;

impl Behavior<Station> for AsksNot {
    type Params = NoParams;

    fn build(_: NoParams, _: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn body(params: &NoParams) -> Option<BodySpec> {
        Asks::body(params)
    }
}

/// Rays to the other, to the ground, past the other, through the own body.
fn look_around(body: &mut Platform<'_>, other: ModelId) {
    let ray = |direction, range| Ray {
        origin: Position::from_xyz(2.0, 3.0, 5.0),
        direction,
        range: Length::si(range),
    };
    let south = [0.0, -2.0, 0.0];
    let rays = [
        ray(south, 10.0),
        ray(south, 1.0),
        ray([0.0, 0.0, -1.0], 10.0),
        ray([0.0, 1.0, 0.0], 10.0),
    ];
    let seen = body.cast_rays(&rays);
    assert_eq!(seen.len(), 4);
    let first = seen[0].expect("the other is there");
    assert_eq!(first.thing, Thing::Model(other));
    let off = first.distance.metres() - (3.0 - RADIUS_M);
    assert!(off.abs() < 1e-9, "{first:?}");
    assert!(first.normal[1] > 0.999_999, "{first:?}");
    assert_eq!((seen[1], seen[3]), (None, None));
    let ground = seen[2].expect("the ground is there");
    assert_eq!(
        (ground.thing, ground.distance),
        (Thing::Ground, Length::si(5.0))
    );
    assert_eq!(body.cast_ray(&rays[0]), seen[0]);

    let probe = Shape::Sphere { radius_m: 0.3 };
    let here = body.pose();
    let met = body
        .cast_shape(&probe, here, south, Length::si(10.0))
        .expect("the other");
    assert_eq!(met.thing, Thing::Model(other));
    assert!(
        (met.distance.metres() - (3.0 - RADIUS_M - 0.3)).abs() < 1e-6,
        "{met:?}"
    );
    assert_eq!(body.overlapping(&probe, here), []);
    let there = body.pose_of(other).expect("a body");
    assert_eq!(body.overlapping(&probe, there), [Thing::Model(other)]);
}
