//! Lasting contact, through the public API: what falls, lies, slides, rolls, stacks and is pushed.

#![expect(
    clippy::disallowed_methods,
    reason = "what is expected of a slope; compared with a tolerance"
)]

use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{
    BodyId, BodySpec, Config, Contact, ContactModel, Material, Mobility, Motion, Physics, Shape,
    Support,
};
use simbeeotic_units::Attitude;
use simbeeotic_units::glam::{DQuat, DVec3};

const G: f64 = 9.80665;

fn seconds(s: f64) -> SimTime {
    SimTime::from_nanos((s * 1e9).round() as u64)
}

fn cube(half: f64, p: [f64; 3]) -> BodySpec {
    let half_m = DVec3::splat(half);
    BodySpec {
        p_enu: DVec3::from_array(p),
        ..BodySpec::new(Shape::Box { half_m }, 1.0)
    }
}

fn ball(radius_m: f64, p: [f64; 3]) -> BodySpec {
    BodySpec {
        p_enu: DVec3::from_array(p),
        rolls: true,
        ..BodySpec::new(Shape::Sphere { radius_m }, 0.5)
    }
}

/// Lets time pass until `s`; gives what touched.
fn run(physics: &mut Physics, s: f64) -> Vec<Contact> {
    let until = seconds(s);
    let mut contacts = Vec::new();
    while let Some(t) = physics.next_time().filter(|t| *t <= until) {
        physics.advance(t, &mut contacts);
        physics.settle(t);
    }
    physics.advance(until, &mut contacts);
    physics.settle(until);
    contacts
}

fn command(physics: &mut Physics, id: BodyId, s: f64, change: impl FnOnce(&mut Motion, SimTime)) {
    let t = seconds(s);
    let mut motion = *physics.motion(id);
    change(&mut motion, t);
    physics.commit(id, t, motion);
    physics.settle(t);
}

#[test]
fn a_box_that_falls_comes_to_rest_and_nothing_happens_any_more() {
    let mut physics = Physics::new(Config::default());
    let tilt = DQuat::from_rotation_x(0.3) * DQuat::from_rotation_y(0.2);
    let id = physics
        .add(BodySpec {
            attitude: Attitude::from_unit_quat(tilt),
            v_enu: DVec3::new(0.5, 0.0, 0.0),
            ..cube(0.1, [0.0, 0.0, 1.0])
        })
        .expect("a body");
    let contacts = run(&mut physics, 5.0);
    assert!(!contacts.is_empty());
    assert_eq!(physics.next_time(), None);
    let motion = physics.motion(id);
    assert_eq!(motion.support(), Support::Island);
    assert!((motion.position(seconds(5.0)).z - 0.1).abs() < 1e-3);
    assert_eq!(motion.velocity(seconds(5.0)), DVec3::ZERO);
    let steps = physics.tally().steps;
    run(&mut physics, 100.0);
    assert_eq!(physics.tally().steps, steps);
}

#[test]
fn a_stack_that_falls_stands() {
    let mut physics = Physics::new(Config::default());
    let ids: Vec<BodyId> = (0..5)
        .map(|i| physics.add(cube(0.1, [0.0, 0.0, 0.11 + 0.21 * f64::from(i)])))
        .collect::<Result<_, _>>()
        .expect("bodies");
    run(&mut physics, 10.0);
    for (i, id) in ids.iter().enumerate() {
        let p = physics.motion(*id).position(seconds(10.0));
        let expected = DVec3::new(0.0, 0.0, 0.1 + 0.2 * i as f64);
        assert!(p.distance(expected) < 5e-3, "{i}: {}", p - expected);
    }
    assert_eq!(physics.next_time(), None);
}

#[test]
fn a_box_dropped_on_a_slope_slides_or_stays() {
    for friction in [0.2, 0.5] {
        let mut physics = Physics::new(Config::default());
        let tilt = DQuat::from_rotation_y(20.0_f64.to_radians());
        let material = Material {
            friction,
            restitution: 0.0,
        };
        let plate = BodySpec {
            p_enu: DVec3::new(0.0, 0.0, 10.0),
            attitude: Attitude::from_unit_quat(tilt),
            mobility: Mobility::Fixed,
            material,
            ..BodySpec::new(
                Shape::Box {
                    half_m: DVec3::new(20.0, 5.0, 0.1),
                },
                1.0,
            )
        };
        physics.add(plate).expect("a plate");
        let start = DVec3::new(0.0, 0.0, 10.0) + tilt * DVec3::new(0.0, 0.0, 0.2 + 1e-4);
        let id = physics
            .add(BodySpec {
                attitude: Attitude::from_unit_quat(tilt),
                material,
                ..cube(0.1, start.to_array())
            })
            .expect("a box");
        run(&mut physics, 1.0);
        let early = physics.motion(id).velocity(seconds(1.0)).length();
        run(&mut physics, 2.0);
        let gain = physics.motion(id).velocity(seconds(2.0)).length() - early;
        let (sin, cos) = 20.0_f64.to_radians().sin_cos();
        let expected = (G * (sin - friction * cos)).max(0.0);
        assert!(
            (gain - expected).abs() <= 0.02 * expected,
            "{friction}: {gain} {expected}"
        );
    }
}

#[test]
fn a_ball_that_slides_comes_to_roll() {
    let mut physics = Physics::new(Config::default());
    let id = physics
        .add(BodySpec {
            v_enu: DVec3::new(2.0, 0.0, 0.0),
            ..ball(0.1, [0.0, 0.0, 0.1])
        })
        .expect("a ball");
    run(&mut physics, 2.0);
    let v = physics.motion(id).velocity(seconds(2.0));
    assert!((v.x / (2.0 * 5.0 / 7.0) - 1.0).abs() < 0.02, "{v}");
}

#[test]
fn a_ghost_pushes_a_box_over_the_ground() {
    let mut physics = Physics::new(Config::default());
    let id = physics.add(cube(0.1, [0.0, 0.0, 0.1])).expect("a box");
    let ram = physics
        .add(BodySpec {
            mobility: Mobility::Driven,
            v_enu: DVec3::new(0.5, 0.0, 0.0),
            ..cube(0.1, [-1.0, 0.0, 0.15])
        })
        .expect("a ghost");
    run(&mut physics, 4.0);
    let t = seconds(4.0);
    let gap = physics.motion(id).position(t).x - physics.motion(ram).position(t).x;
    assert!((0.199..0.205).contains(&gap), "{gap}");
    let steps = physics.tally();
    command(&mut physics, ram, 4.0, |motion, t| {
        motion.set_velocity(t, DVec3::ZERO).expect("a velocity");
    });
    run(&mut physics, 6.0);
    assert_eq!(physics.next_time(), None, "{steps:?}");
    command(&mut physics, ram, 6.0, |motion, t| {
        motion.set_velocity(t, DVec3::X * 0.3).expect("a velocity");
    });
    run(&mut physics, 8.0);
    let t = seconds(8.0);
    let gap = physics.motion(id).position(t).x - physics.motion(ram).position(t).x;
    assert!((0.199..0.205).contains(&gap), "{gap}");
}

#[test]
fn a_ball_that_hits_a_sleeping_stack_wakes_it() {
    let mut physics = Physics::new(Config::default());
    for i in 0..3 {
        physics
            .add(cube(0.1, [0.0, 0.0, 0.1 + 0.2 * f64::from(i)]))
            .expect("a box");
    }
    let bullet = physics
        .add(BodySpec {
            v_enu: DVec3::new(4.0, 0.0, 0.0),
            gravity: false,
            ..ball(0.05, [-10.0, 0.0, 0.5])
        })
        .expect("a ball");
    run(&mut physics, 2.0);
    assert!(physics.motion(BodyId(2)).velocity(seconds(2.0)) == DVec3::ZERO);
    let contacts = run(&mut physics, 10.0);
    assert!(contacts.iter().any(|c| c.b == Some(bullet)));
    let t = seconds(10.0);
    assert!(physics.motion(BodyId(2)).position(t).x > 0.02);
    for id in 0..3 {
        assert!(physics.motion(BodyId(id)).position(t).z > 0.09);
        assert_eq!(physics.motion(BodyId(id)).velocity(t), DVec3::ZERO);
    }
}

/// A heap that falls; some ids are given to others far away.
fn heap(physics: &mut Physics, x: f64) -> Vec<BodyId> {
    (0..40)
        .map(|i| {
            let place = [
                x + 0.13 * f64::from(i % 3),
                0.11 * f64::from(i % 2),
                0.3 + 0.23 * f64::from(i),
            ];
            let spec = if i % 3 == 0 {
                ball(0.1, place)
            } else {
                cube(0.1, place)
            };
            physics.add(spec).expect("a body")
        })
        .collect()
}

#[test]
fn a_heap_comes_to_rest_and_others_far_away_change_no_bit() {
    let mut alone = Physics::new(Config::default());
    let only = heap(&mut alone, 0.0);
    let mut among = Physics::new(Config::default());
    heap(&mut among, -400.0);
    let mine = heap(&mut among, 0.0);
    heap(&mut among, 300.0);
    for s in [1.0, 2.0, 4.0, 8.0] {
        run(&mut alone, s);
        run(&mut among, s);
        let t = seconds(s);
        for (a, b) in only.iter().zip(&mine) {
            let (a, b) = (alone.motion(*a).at(t), among.motion(*b).at(t));
            assert_eq!(a, b, "{s}");
            assert!(a.p_enu.z > 0.09, "{s}: {a:?}");
        }
    }
}

#[test]
fn boxes_land_and_lie_whatever_becomes_of_balls() {
    for model in [ContactModel::Islands, ContactModel::Impulses] {
        for restitution in [0.0, 0.5] {
            let mut physics = Physics::new(Config {
                ground: Some(crate::worlds::surface(0.5, restitution)),
                contact_model: model,
                ..Config::default()
            });
            let mut stream = crate::worlds::stream("boxes land");
            for id in 0..20 {
                let [x, y] = [(); 2].map(|()| stream.uniform_in(-0.3..0.3));
                let p_enu = DVec3::new(x, y, 0.5 + 0.4 * f64::from(id));
                let spec = BodySpec {
                    p_enu,
                    w_flu: stream.in_ball(3.0),
                    material: crate::worlds::surface(0.5, restitution),
                    ..BodySpec::new(
                        Shape::Box {
                            half_m: DVec3::splat(0.1),
                        },
                        0.5,
                    )
                };
                physics.add(spec).unwrap();
            }
            crate::worlds::run(&mut physics, seconds(20.0));
            let tally = physics.tally();
            assert!(tally.contacts < 5_000, "{model:?}: {tally:?}");
            let still = |id: u32| physics.motion(BodyId(id)).velocity(seconds(20.0)) == DVec3::ZERO;
            assert!((0..20).all(still), "{model:?}, restitution {restitution}");
        }
    }
}

/// A control law that says each tenth of a second what held already must not wake who lies on a box.
#[test]
fn who_is_told_again_what_it_knows_stays_asleep() {
    let mut physics = Physics::new(Config::default());
    let table = BodySpec {
        mobility: Mobility::Fixed,
        ..cube(0.5, [0.0, 0.0, 0.5])
    };
    physics.add(table).expect("a body");
    let mut ids = Vec::new();
    for (rolls, x) in [(false, 0.1), (true, -0.2)] {
        let spec = BodySpec {
            rolls,
            ..ball(0.05, [x, 0.1, 1.2])
        };
        ids.push(physics.add(spec).expect("a body"));
    }
    ids.push(physics.add(cube(0.05, [0.3, -0.3, 1.2])).expect("a body"));
    for step in 1..=100 {
        run(&mut physics, 0.1 * f64::from(step));
        for id in &ids {
            command(&mut physics, *id, 0.1 * f64::from(step), |motion, t| {
                motion.set_force(t, DVec3::ZERO).expect("a force");
            });
        }
    }
    let next = physics.next_time();
    assert!(next.is_none_or(|next| next > seconds(10.2)), "{next:?}");
}
