//! Nonsense is refused, and nothing becomes infinite.

use crate::worlds::{ball, in_space, on_ground, run, stream, surface};
use simbeeotic_kernel::{SimTime, rng::Stream};
use simbeeotic_physics::{
    BodyError, BodyId, BodySpec, Config, Contacts, Material, Mobility, Motion, Shape,
};
use simbeeotic_units::{
    Acceleration, Attitude, Time,
    glam::{DQuat, DVec3},
};

fn nonsense(stream: &mut Stream) -> DVec3 {
    let mut v = stream.in_ball(10.0);
    let place = stream.below(3) as usize;
    v[place] = match stream.below(5) {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => f64::NEG_INFINITY,
        3 => 1e300,
        _ => -1e12,
    };
    v
}

fn bits(motion: &Motion) -> [u64; 13] {
    let s = motion.at(SimTime::from_secs(7));
    let q = s.world_from_body;
    let words = [s.p_enu, s.v_enu, s.w_flu, s.a_enu].map(|v| v.to_array());
    let mut all = [0; 13];
    for (place, word) in words.iter().flatten().chain([&q.w]).enumerate() {
        all[place] = word.to_bits();
    }
    all
}

#[test]
fn ten_thousand_invalid_calls_are_refused_and_change_nothing() {
    let mut physics = on_ground(surface(0.5, 0.5));
    let id = physics.add(ball(DVec3::new(1.0, 2.0, 3.0))).unwrap();
    let mut motion = *physics.motion(id);
    motion
        .set_force(SimTime::from_secs(1), DVec3::new(0.1, 0.2, 0.3))
        .unwrap();
    motion
        .set_rate(SimTime::from_secs(1), DVec3::new(0.1, 0.2, 0.3))
        .unwrap();
    let before = bits(&motion);
    let t = SimTime::from_secs(2);
    let ok = DVec3::ONE;
    let broken = Attitude::from_unit_quat(DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0));
    let mut stream = stream("nonsense");
    for call in 0..10_000 {
        let x = nonsense(&mut stream);
        let refused = match call % 17 {
            0 => motion.set_force(t, x),
            1 => motion.add_force(t, x),
            2 => motion.add_force_at(t, x, ok),
            3 => motion.add_force_at(t, ok, x),
            4 => motion.set_torque(t, x),
            5 => motion.add_torque(t, x),
            6 => motion.add_impulse(t, x),
            7 => motion.add_impulse_at(t, x, ok),
            8 => motion.add_impulse_at(t, ok, x),
            9 => motion.add_angular_impulse(t, x),
            10 => motion.set_velocity(t, x),
            11 => motion.set_rate(t, x),
            12 => motion.set_position(t, x),
            13 => motion.set_pose(t, ok, broken),
            14 => motion.set_twist(t, x, ok),
            15 => motion.set_wrench(t, ok, x),
            _ => motion.set_force(SimTime::from_millis(stream.below(1000)), ok),
        };
        assert!(refused.is_err(), "call {call} with {x} was not refused");
        assert_eq!(
            bits(&motion),
            before,
            "call {call} with {x} changed something: {refused:?}"
        );
    }
}

#[test]
fn the_message_says_what_was_wrong() {
    let mut physics = in_space();
    let id = physics.add(ball(DVec3::ZERO)).unwrap();
    let mut motion = *physics.motion(id);
    let nan = motion
        .set_force(SimTime::ZERO, DVec3::new(0.0, f64::NAN, 1.0))
        .unwrap_err();
    assert_eq!(nan.to_string(), "force [N] is not finite: [0.0, NaN, 1.0]");
    let much = motion
        .set_velocity(SimTime::ZERO, DVec3::new(0.0, 2e5, 0.0))
        .unwrap_err();
    assert_eq!(
        much.to_string(),
        "velocity [m/s] has to lie between 0 and 100000, not at 200000"
    );
    motion.advance(SimTime::from_secs(2)).unwrap();
    let past = motion
        .set_velocity(SimTime::from_secs(1), DVec3::X)
        .unwrap_err();
    assert!(matches!(past, BodyError::Backwards { .. }));
}

#[test]
fn bodies_that_cannot_be_are_refused() {
    let mut physics = in_space();
    let good = ball(DVec3::ZERO);
    let inertia = |x, y, z| BodySpec {
        inertia_kg_m2: DVec3::new(x, y, z),
        ..good.clone()
    };
    let sphere = |radius_m| BodySpec {
        shape: Shape::Sphere { radius_m },
        ..good.clone()
    };
    let friction = |friction| BodySpec {
        material: Material {
            friction,
            ..Material::default()
        },
        ..good.clone()
    };
    let bounce = |restitution| BodySpec {
        material: Material {
            restitution,
            ..Material::default()
        },
        ..good.clone()
    };
    let bad = [
        BodySpec {
            mass_kg: 0.0,
            ..good.clone()
        },
        BodySpec {
            mass_kg: -1.0,
            ..good.clone()
        },
        BodySpec {
            mass_kg: f64::NAN,
            ..good.clone()
        },
        BodySpec {
            mass_kg: f64::INFINITY,
            ..good.clone()
        },
        inertia(0.0, 1.0, 1.0),
        inertia(1.0, 1.0, 3.0),
        inertia(f64::NAN, 1.0, 1.0),
        sphere(0.0),
        sphere(-1.0),
        sphere(f64::INFINITY),
        friction(-0.1),
        friction(f64::NAN),
        bounce(1.1),
        bounce(-0.1),
        BodySpec {
            p_enu: DVec3::splat(f64::NAN),
            ..good.clone()
        },
        BodySpec {
            v_enu: DVec3::splat(1e9),
            ..good.clone()
        },
        BodySpec {
            w_flu: DVec3::splat(f64::INFINITY),
            ..good.clone()
        },
        BodySpec {
            shape: Shape::Plane,
            ..good.clone()
        },
        BodySpec {
            shape: Shape::Box {
                half_m: DVec3::new(1.0, 0.0, 1.0),
            },
            mobility: Mobility::Fixed,
            ..good.clone()
        },
    ];
    for spec in bad {
        assert!(physics.add(spec.clone()).is_err(), "{spec:?}");
    }
    assert!(physics.is_empty());
    let hive = BodySpec {
        shape: Shape::Box { half_m: DVec3::ONE },
        mobility: Mobility::Fixed,
        ..good.clone()
    };
    assert!(physics.add(hive).is_ok());
}

#[test]
fn worlds_that_cannot_be_are_refused() {
    let period = |s| Config {
        list_period: Time::from_secs(s),
        ..Config::default()
    };
    let gravity = |g| Config {
        gravity: Acceleration::si(g),
        ..Config::default()
    };
    let ground = |m| Config {
        ground: Some(m),
        ..Config::default()
    };
    assert!(Config::default().check().is_ok());
    let bad = [
        period(0.0),
        period(f64::NAN),
        gravity(-1.0),
        gravity(f64::INFINITY),
        ground(surface(-1.0, 0.0)),
    ];
    assert!(bad.iter().all(|config| config.check().is_err()));
}

#[test]
fn a_fixed_body_stays_and_a_ghost_is_not_pushed() {
    let mut physics = in_space();
    let fixed = physics
        .add(BodySpec {
            mobility: Mobility::Fixed,
            v_enu: DVec3::X,
            ..ball(DVec3::ZERO)
        })
        .unwrap();
    let ghost = physics
        .add(BodySpec {
            mobility: Mobility::Driven,
            ..ball(DVec3::X)
        })
        .unwrap();
    let t = SimTime::from_secs(1);
    let mut motion = *physics.motion(fixed);
    assert_eq!(motion.velocity(t), DVec3::ZERO);
    assert!(motion.set_velocity(t, DVec3::X).is_err());
    assert!(motion.set_force(t, DVec3::X).is_err());
    let mut motion = *physics.motion(ghost);
    assert!(motion.set_force(t, DVec3::X).is_err());
    assert!(motion.add_impulse(t, DVec3::X).is_err());
    assert!(motion.set_velocity(t, DVec3::X).is_ok());
}

#[test]
fn no_state_becomes_infinite_under_a_hundred_thousand_random_calls() {
    let mut physics = on_ground(surface(0.5, 0.8));
    let mut stream = stream("random calls");
    for k in 0..20 {
        let p = DVec3::new(0.5 * k as f64, 0.0, 0.5);
        let moments = DVec3::new(1e-3, 1.5e-3, 2e-3);
        let contacts = [Contacts::Respond, Contacts::Detect][k % 2];
        physics
            .add(BodySpec {
                inertia_kg_m2: moments,
                contacts,
                ..ball(p)
            })
            .unwrap();
    }
    let mut t = SimTime::ZERO;
    let mut done = 0;
    for _ in 0..100_000 {
        t = t.saturating_add_nanos(stream.below(1_000_000));
        run(&mut physics, t);
        let id = BodyId(stream.below(20) as u32);
        let mut motion = *physics.motion(id);
        let size = [1e-3, 1.0, 30.0][stream.below(3) as usize];
        let x = stream.in_ball(size);
        let y = stream.in_ball(1.0);
        let result = match stream.below(12) {
            0 => motion.set_force(t, x),
            1 => motion.add_force(t, x * 0.1),
            2 => motion.add_force_at(t, x, y * 0.1),
            3 => motion.set_torque(t, x * 1e-3),
            4 => motion.add_impulse(t, x * 0.1),
            5 => motion.add_impulse_at(t, x * 1e-2, y * 0.1),
            6 => motion.set_velocity(t, x),
            7 => motion.set_rate(t, x),
            8 => motion.set_position(t, DVec3::new(x.x, x.y, x.z.abs() * 0.1 + 0.1)),
            9 => motion.turn(t, y),
            10 => motion.set_wrench(t, DVec3::ZERO, DVec3::ZERO),
            _ => motion.add_angular_impulse(t, y * 1e-4),
        };
        done += u32::from(result.is_ok());
        physics.commit(id, t, motion);
        physics.settle(t);
        let s = physics.motion(id).at(t.saturating_add_nanos(50_000_000));
        assert!(s.p_enu.is_finite() && s.v_enu.is_finite() && s.w_flu.is_finite());
        assert!((s.world_from_body.length() - 1.0).abs() < 1e-12);
    }
    assert!(done > 90_000);
}
