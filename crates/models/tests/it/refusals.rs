//! Whatever a model asks of its body that makes no sense ends the run with its name and the time.

use crate::swarm::{bee, model, section, setup};
use simbeeotic_model::host::{Platform, Station};
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::physics::{BodySpec, Mobility, Shape};
use simbeeotic_model::registry::{self, Kind, Make};
use simbeeotic_model::units::glam::{DQuat, DVec3};
use simbeeotic_model::units::{Attitude, Pose, Time, Twist, V3, Wrench};
use simbeeotic_model::{Behavior, BuildError, Kit, ModelPlan, Simulation, behavior, params};

/// A body that asks for something impossible, half a second after the start.
#[behavior("test-impossible", host = Station)]
struct Impossible {
    params: ImpossibleParams,
}

/// Which impossible thing.
#[params]
#[derive(Default)]
struct ImpossibleParams {
    /// Everything is drawn from this.
    draw: u64,
    /// Whether its body is fixed, and what would be possible is not.
    fixed: bool,
}

impl Behavior<Station> for Impossible {
    type Params = ImpossibleParams;

    fn build(params: ImpossibleParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
        kit.once(Time::from_millis(500.0), Self::ask);
        Ok(Self { params })
    }

    fn body(params: &ImpossibleParams) -> Option<BodySpec> {
        let mobility = match params.fixed {
            true => Mobility::Fixed,
            false => Mobility::Free,
        };
        Some(BodySpec {
            mobility,
            ..BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 0.1)
        })
    }
}

/// Ways to ask.
const WAYS: u64 = 22;

impl Impossible {
    fn ask(&mut self, body: &mut Platform<'_>) {
        let mut rng = Stream::new(self.params.draw, "impossible", "call");
        let way = rng.next_u64() % WAYS;
        let wrong = match self.params.fixed {
            true => DVec3::new(rng.normal(), rng.normal(), rng.normal()),
            false => impossible(&mut rng),
        };
        let good = DVec3::new(0.1, 0.2, 0.3);
        call(body, way, wrong, good);
    }
}

/// A vector that is no number somewhere, infinite, or beyond every limit of physics.
fn impossible(rng: &mut Stream) -> DVec3 {
    let mut v = DVec3::new(rng.normal(), rng.normal(), rng.normal());
    let axis = (rng.next_u64() % 3) as usize;
    v[axis] = match rng.next_u64() % 5 {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => f64::NEG_INFINITY,
        3 => 1e12 * (1.0 + rng.uniform()),
        _ => -1e200 * (1.0 + rng.uniform()),
    };
    v
}

/// One call of the easy layer's; `way` says which.
fn call(body: &mut Platform<'_>, way: u64, wrong: DVec3, good: DVec3) {
    let at = body.position();
    match way {
        0 => body.set_force(V3::from_si(wrong)),
        1 => body.set_force_flu(V3::from_si(wrong)),
        2 => body.add_force(V3::from_si(wrong)),
        3 => body.add_force_flu(V3::from_si(wrong)),
        4 => body.add_force_at(V3::from_si(wrong), at),
        5 => body.add_force_at(V3::from_si(good), at + V3::from_si(wrong * 1e7)),
        6 => body.add_force_at_flu(V3::from_si(wrong), V3::from_si(good)),
        7 => body.set_torque(V3::from_si(wrong)),
        8 => body.add_torque(V3::from_si(wrong)),
        9 => body.add_torque_enu(V3::from_si(wrong)),
        10 => body.push(V3::from_si(wrong)),
        11 => body.push_flu(V3::from_si(wrong)),
        12 => body.push_at(V3::from_si(wrong), at),
        13 => body.push_at_flu(V3::from_si(wrong), V3::from_si(good)),
        14 => body.spin(V3::from_si(wrong), Time::si(1.0)),
        15 => body.set_velocity(V3::from_si(wrong)),
        16 => body.set_velocity_flu(V3::from_si(wrong)),
        17 => body.set_rate(V3::from_si(wrong)),
        18 => body.set_position(V3::from_si(wrong)),
        19 => body.set_pose(Pose::new(V3::from_si(wrong), Attitude::IDENTITY)),
        20 => body.set_twist(Twist {
            linear: V3::from_si(good),
            angular: V3::from_si(wrong),
        }),
        _ => body.set_wrench(Wrench {
            force: V3::from_si(good),
            torque: V3::from_si(wrong),
        }),
    }
}

fn culprit(draw: u64, fixed: bool) -> ModelPlan {
    let part = registry::find(Kind::Model, "test-impossible").expect("it is registered");
    let Make::Model(make) = part.make else {
        unreachable!("its kind is model")
    };
    let draw = draw.to_string();
    let fixed = fixed.to_string();
    let factory = make(&section(&[("draw", &draw), ("fixed", &fixed)])).expect("good parameters");
    ModelPlan {
        factory,
        ..model("culprit", "test-impossible")
    }
}

fn error(draw: u64, fixed: bool) -> String {
    let setup = setup(vec![culprit(draw, fixed)], 1);
    let outcome = Simulation::new(setup)
        .expect("it can be put together")
        .run();
    match outcome.error {
        Some(error) => error.to_string(),
        None => panic!("draw {draw} was not refused"),
    }
}

#[test]
fn a_hundred_thousand_impossible_calls_are_refused_with_name_and_time() {
    for draw in 0..100_000 {
        let error = error(draw, false);
        assert!(error.starts_with("culprit, at 0.5"), "draw {draw}: {error}");
        assert!(
            ["not finite", "has to lie between"]
                .iter()
                .any(|words| error.contains(words)),
            "draw {draw}: {error}"
        );
    }
}

#[test]
fn nothing_moves_what_is_fixed() {
    for draw in 0..1000 {
        let error = error(draw, true);
        assert!(
            error.starts_with("culprit, at 0.5") && error.contains("fixed"),
            "draw {draw}: {error}"
        );
    }
}

#[test]
fn an_attitude_that_is_none_is_refused() {
    #[behavior("test-no-attitude", host = Station)]
    struct NoAttitude;

    impl Behavior<Station> for NoAttitude {
        type Params = ImpossibleParams;

        fn build(_: ImpossibleParams, kit: &mut Kit<Self, Station>) -> Result<Self, BuildError> {
            kit.once(Time::ZERO, |_, body| {
                let nan = DQuat::from_xyzw(0.0, 0.0, f64::NAN, 1.0);
                body.set_attitude(Attitude::from_unit_quat(nan));
            });
            Ok(Self)
        }

        fn body(params: &ImpossibleParams) -> Option<BodySpec> {
            Impossible::body(params)
        }
    }

    let innocent = bee("innocent", "inert-bee", &[], [0.0, 0.0, 5.0]);
    let setup = setup(vec![innocent, model("culprit", "test-no-attitude")], 1);
    let outcome = Simulation::new(setup)
        .expect("it can be put together")
        .run();
    let error = outcome.error.expect("it is refused").to_string();
    assert!(
        error.starts_with("culprit, at 0 s: attitude is not finite"),
        "{error}"
    );
}
