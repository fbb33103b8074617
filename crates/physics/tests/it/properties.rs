//! What holds of all bodies whatever is asked of them: states stay finite, attitudes of unit length, and
//! nonsense is refused without a trace.

use crate::shapes::{self, FREE, Kind, attitude};
use crate::worlds::{ball, run, stream, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_physics::{
    BodyError, BodyId, BodySpec, Config, Contacts, Mobility, Motion, Physics, Shape,
};
use simbeeotic_units::Attitude;
use simbeeotic_units::glam::{DQuat, DVec3};

const SHAPES: usize = FREE.len();
/// Two of each shape that moves freely, two ghosts, and what is fixed.
const FREE_BODIES: usize = 2 * SHAPES;
const BODIES: u64 = FREE_BODIES as u64 + 2;

/// A room in which bodies of all shapes meet each other, boxes, a mesh, a height field and a plane.
fn room(stream: &mut Stream) -> Physics {
    let mut physics = Physics::new(Config {
        ground: Some(surface(0.5, 0.6)),
        ..Config::default()
    });
    for k in 0..FREE_BODIES {
        let shape = shapes::shape(FREE[k % SHAPES], 0.3, stream).centred().0;
        let [x, y] = [k % 4, k / 4].map(|c| c as f64);
        physics
            .add(BodySpec {
                p_enu: DVec3::new(x, y, 0.5),
                attitude: attitude(stream),
                contacts: [Contacts::Respond, Contacts::Respond, Contacts::Detect][k % 3],
                material: surface(stream.uniform(), stream.uniform()),
                rolls: k % 2 == 0,
                ..BodySpec::new(shape, stream.uniform_in(0.05..2.0))
            })
            .unwrap();
    }
    for k in 0..2 {
        let shape = shapes::shape([Kind::Mesh, Kind::Box][k], 0.3, stream);
        physics
            .add(BodySpec {
                p_enu: DVec3::new(k as f64, -1.0, 0.5),
                mobility: Mobility::Driven,
                ..BodySpec::new(shape, 1.0)
            })
            .unwrap();
    }
    let fixed = [
        (Kind::Box, DVec3::new(-1.0, 1.0, 0.2), Attitude::IDENTITY),
        (Kind::Mesh, DVec3::new(5.0, 1.0, 0.4), attitude(stream)),
        (
            Kind::HeightField,
            DVec3::new(2.0, -3.0, 0.1),
            Attitude::IDENTITY,
        ),
        (Kind::Cone, DVec3::new(2.0, 5.0, 0.3), attitude(stream)),
        // A wall at y = 8 that faces the room.
        (
            Kind::Plane,
            DVec3::new(0.0, 8.0, 0.0),
            Attitude::from_unit_quat(DQuat::from_rotation_arc(DVec3::Z, DVec3::NEG_Y)),
        ),
    ];
    for (kind, p_enu, attitude) in fixed {
        physics
            .add(BodySpec {
                p_enu,
                attitude,
                mobility: Mobility::Fixed,
                ..BodySpec::new(shapes::shape(kind, 0.8, stream), 1.0)
            })
            .unwrap();
    }
    physics
}

/// One command of those that there are, with values that are fine.
fn command(motion: &mut Motion, t: SimTime, stream: &mut Stream) -> Result<(), BodyError> {
    let size = [1e-3, 1.0, 20.0][stream.below(3) as usize];
    let x = stream.in_ball(size);
    let y = stream.in_ball(1.0);
    let weight = DVec3::Z * (9.80665 * motion.mass_kg());
    let place = DVec3::new(1.5 + 2.5 * y.x, 1.5 + 3.5 * y.y, 0.6 + 0.5 * y.z);
    match stream.below(30) {
        0 => motion.set_force(t, x),
        1 => motion.set_force(t, weight),
        2 => motion.add_force(t, x * 0.1),
        3 => motion.add_force_at(t, x, y * 0.1),
        4 => motion.set_torque(t, x * 1e-3),
        5 => motion.add_torque(t, x * 1e-4),
        6 => motion.set_wrench(t, DVec3::ZERO, DVec3::ZERO),
        7 => motion.set_wrench(t, weight, x * 1e-3),
        8 => motion.add_impulse(t, x * 0.1),
        9 => motion.add_impulse_at(t, x * 1e-2, y * 0.1),
        10 => motion.add_angular_impulse(t, y * 1e-3),
        11 => motion.set_velocity(t, x),
        12 => motion.set_rate(t, x),
        13 => motion.set_twist(t, y, x),
        14 => motion.set_position(t, place),
        15 => motion.set_attitude(t, attitude(stream)),
        16 => motion.set_pose(t, place, attitude(stream)),
        17 => motion.turn(t, y),
        18 => motion.set_force_flu(t, x),
        19 => motion.add_force_flu(t, x * 0.1),
        20 => motion.add_force_at_flu(t, x, y * 0.1),
        21 => motion.set_torque_enu(t, x * 1e-3),
        22 => motion.add_torque_enu(t, x * 1e-4),
        23 => motion.add_impulse_flu(t, x * 0.1),
        24 => motion.add_impulse_at_flu(t, x * 1e-2, y * 0.1),
        25 => motion.add_angular_impulse_enu(t, y * 1e-3),
        26 => motion.set_velocity_flu(t, x),
        27 => motion.set_velocity(t, DVec3::ZERO),
        28 => motion.set_rate(t, DVec3::ZERO),
        _ => motion.advance(t),
    }
}

fn assert_sound(physics: &Physics, id: BodyId, t: SimTime) {
    let s = physics.motion(id).at(t);
    let finite = s.p_enu.is_finite() && s.v_enu.is_finite() && s.a_enu.is_finite();
    assert!(finite && s.w_flu.is_finite(), "{s:?}");
    let length = s.world_from_body.length();
    assert!((length - 1.0).abs() < 1e-12, "{length} of {s:?}");
}

/// Tells how many of the calls were accepted, and how many contacts there were.
fn call_at_random(purpose: &str, calls: u32) -> (u32, usize) {
    let mut stream = stream(purpose);
    let mut physics = room(&mut stream);
    let mut t = SimTime::ZERO;
    let (mut done, mut contacts) = (0, 0);
    let mut found = Vec::new();
    let mut id = BodyId(0);
    for call in 0..calls {
        // Some calls at one instant, in bursts to one body.
        if call % 16 == 0 {
            t = t.saturating_add_nanos(stream.below(500_000));
            found.clear();
            physics.advance(t, &mut found);
            contacts += found.len();
            for contact in &found {
                assert!(contact.point_enu.is_finite() && contact.impulse_enu.is_finite());
                assert!((contact.normal_enu.length() - 1.0).abs() < 1e-9);
            }
        }
        if stream.below(8) == 0 {
            id = BodyId(stream.below(BODIES) as u32);
        }
        let mut motion = *physics.motion(id);
        done += u32::from(command(&mut motion, t, &mut stream).is_ok());
        physics.commit(id, t, motion);
        if stream.below(16) == 0 {
            physics.settle(t);
        }
        assert_sound(&physics, id, t);
        assert_sound(&physics, id, t.saturating_add_nanos(20_000_000));
        if call % 1000 == 0 {
            for id in 0..physics.len() as u32 {
                assert_sound(&physics, BodyId(id), t);
            }
        }
    }
    (done, contacts)
}

/// Ghosts refuse forces, torques and impulses: those calls count as invalid.
#[test]
fn no_state_ever_becomes_non_finite_under_half_a_million_random_calls() {
    let (done, contacts) = call_at_random("half a million calls", 500_000);
    assert!(done > 450_000, "{done}");
    assert!(contacts > 500, "{contacts}");
}

#[test]
fn nor_under_another_half_a_million() {
    let (done, contacts) = call_at_random("another half a million", 550_000);
    assert!(done > 500_000, "{done}");
    assert!(contacts > 500, "{contacts}");
}

/// A vector that no command takes: not finite, or beyond every limit.
fn nonsense(stream: &mut Stream) -> DVec3 {
    let mut v = stream.in_ball(10.0);
    let place = stream.below(3) as usize;
    v[place] = match stream.below(6) {
        0 => f64::NAN,
        1 => -f64::NAN,
        2 => f64::INFINITY,
        3 => f64::NEG_INFINITY,
        4 => 1e300,
        _ => -1e13,
    };
    v
}

fn broken(stream: &mut Stream) -> Attitude {
    let [x, y, z, w] = match stream.below(4) {
        0 => [f64::NAN, 0.0, 0.0, 1.0],
        1 => [0.0; 4],
        2 => [0.0, 0.0, 0.0, 1.1],
        _ => [f64::INFINITY, 0.0, 0.0, 1.0],
    };
    Attitude::from_unit_quat(DQuat::from_xyzw(x, y, z, w))
}

/// One command that makes no sense.
fn mistake(motion: &mut Motion, t: SimTime, stream: &mut Stream) -> Result<(), BodyError> {
    let x = nonsense(stream);
    let ok = DVec3::new(0.1, 0.2, 0.3);
    match stream.below(32) {
        0 => motion.set_force(t, x),
        1 => motion.add_force(t, x),
        2 => motion.add_force_at(t, x, ok),
        3 => motion.add_force_at(t, ok, x),
        4 => motion.set_torque(t, x),
        5 => motion.add_torque(t, x),
        6 => motion.set_wrench(t, x, ok),
        7 => motion.set_wrench(t, ok, x),
        8 => motion.add_impulse(t, x),
        9 => motion.add_impulse_at(t, x, ok),
        10 => motion.add_impulse_at(t, ok, x),
        11 => motion.add_angular_impulse(t, x),
        12 => motion.set_velocity(t, x),
        13 => motion.set_rate(t, x),
        14 => motion.set_twist(t, x, ok),
        15 => motion.set_twist(t, ok, x),
        16 => motion.set_position(t, x),
        17 => motion.set_attitude(t, broken(stream)),
        18 => motion.set_pose(t, ok, broken(stream)),
        19 => motion.set_pose(t, x, Attitude::IDENTITY),
        20 => motion.turn(t, x),
        21 => motion.set_force_flu(t, x),
        22 => motion.add_force_flu(t, x),
        23 => motion.add_force_at_flu(t, ok, x),
        24 => motion.set_torque_enu(t, x),
        25 => motion.add_torque_enu(t, x),
        26 => motion.add_impulse_flu(t, x),
        27 => motion.add_impulse_at_flu(t, x, ok),
        28 => motion.add_angular_impulse_enu(t, x),
        29 => motion.set_velocity_flu(t, x),
        30 => motion.advance(SimTime::from_nanos(t.nanos() - 1 - stream.below(1000))),
        _ => motion.set_force(SimTime::from_nanos(stream.below(t.nanos())), ok),
    }
}

fn words(motion: &Motion, t: SimTime) -> Vec<u64> {
    let s = motion.at(t.saturating_add_nanos(300_000_000));
    let q = s.world_from_body;
    let vectors = [
        s.p_enu,
        s.v_enu,
        s.a_enu,
        s.w_flu,
        motion.force(),
        motion.torque(),
    ];
    vectors
        .iter()
        .flat_map(|v| v.to_array())
        .chain([q.x, q.y, q.z, q.w])
        .map(f64::to_bits)
        .chain([motion.start().nanos(), motion.support() as u64])
        .collect()
}

#[test]
fn a_hundred_thousand_invalid_calls_are_all_refused_and_change_nothing() {
    let mut stream = stream("invalid calls");
    let mut physics = room(&mut stream);
    // Some fly, some have landed, some lie in islands.
    let t = SimTime::from_millis(700);
    run(&mut physics, t);
    for id in 0..physics.len() as u32 {
        let mut motion = *physics.motion(BodyId(id));
        if motion.advance(t).is_ok() && motion.mobility() == Mobility::Free {
            motion.add_torque(t, DVec3::new(1e-4, 2e-4, 3e-4)).unwrap();
        }
        physics.commit(BodyId(id), t, motion);
    }
    for call in 0..100_000 {
        let id = BodyId(stream.below(physics.len() as u64) as u32);
        let mut motion = *physics.motion(id);
        let before = words(&motion, t);
        let refused = mistake(&mut motion, t, &mut stream);
        let error = refused.expect_err("a mistake is accepted");
        assert!(!error.to_string().is_empty());
        assert_eq!(words(&motion, t), before, "call {call}: {error}");
    }
}

#[test]
fn invalid_bodies_are_all_refused_and_leave_the_world_as_it_was() {
    let mut stream = stream("invalid bodies");
    let mut physics = room(&mut stream);
    let count = physics.len();
    for call in 0..20_000 {
        let bad = [0.0, -1.0, f64::NAN, f64::INFINITY, 1e30][stream.below(5) as usize];
        let x = nonsense(&mut stream);
        let good = ball(DVec3::new(0.0, 0.0, 50.0));
        let box_of = |half_m| Shape::Box { half_m };
        let spec = match stream.below(16) {
            0 => BodySpec {
                mass_kg: bad,
                ..good
            },
            1 => BodySpec { p_enu: x, ..good },
            2 => BodySpec { v_enu: x, ..good },
            3 => BodySpec { w_flu: x, ..good },
            4 => BodySpec {
                attitude: broken(&mut stream),
                ..good
            },
            5 => BodySpec {
                inertia_kg_m2: DVec3::new(1.0, bad, 1.0),
                ..good
            },
            6 => BodySpec {
                inertia_kg_m2: DVec3::new(1.0, 1.0, 2.5),
                ..good
            },
            7 => BodySpec {
                material: surface(-1e-3, 0.5),
                ..good
            },
            8 => BodySpec {
                material: surface(0.5, 1.001),
                ..good
            },
            9 => BodySpec {
                material: surface(f64::NAN, 0.5),
                ..good
            },
            10 => BodySpec {
                shape: Shape::Sphere { radius_m: bad },
                ..good
            },
            11 => BodySpec {
                shape: box_of(DVec3::new(1.0, bad, 1.0)),
                ..good
            },
            12 => BodySpec {
                shape: Shape::Capsule {
                    radius_m: 0.1,
                    half_height_m: bad,
                },
                ..good
            },
            13 => BodySpec {
                shape: Shape::Cylinder {
                    radius_m: bad,
                    half_height_m: 0.1,
                },
                ..good
            },
            14 => BodySpec {
                shape: Shape::Cone {
                    radius_m: bad,
                    half_height_m: 0.1,
                },
                mobility: Mobility::Fixed,
                ..good
            },
            // What has no volume, or no end, does not move freely.
            _ => BodySpec {
                shape: shapes::shape([Kind::Plane, Kind::HeightField][call % 2], 0.5, &mut stream),
                ..good
            },
        };
        assert!(physics.add(spec.clone()).is_err(), "{spec:?}");
        assert_eq!(physics.len(), count);
    }
}
