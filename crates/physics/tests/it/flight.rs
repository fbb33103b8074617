//! Free flight against its closed forms.

use crate::worlds::{G, ball, floating, in_space, on_ground, run, seconds, stream, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Config, Contacts, Mobility, Physics, Support};
use simbeeotic_units::{Attitude, Yaw, glam::DVec3};

#[test]
fn one_second_of_free_fall_is_4_903325_m() {
    let mut physics = Physics::new(Config {
        ground: None,
        ..Config::default()
    });
    let id = physics.add(ball(DVec3::ZERO)).unwrap();
    let state = physics.motion(id).at(SimTime::from_secs(1));
    assert!((state.p_enu.z + 4.903_325).abs() < 1e-12);
    assert!((state.v_enu.z + G).abs() < 1e-12);
    assert_eq!(state.a_enu, DVec3::new(0.0, 0.0, -G));
}

#[test]
fn a_throw_is_a_parabola_however_often_it_is_looked_at_or_begun_anew() {
    let mut physics = Physics::new(Config {
        ground: None,
        ..Config::default()
    });
    let (p, v) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(5.0, -4.0, 20.0));
    let id = physics
        .add(BodySpec {
            v_enu: v,
            ..ball(p)
        })
        .unwrap();
    let expected = |s: f64| p + v * s - DVec3::Z * (0.5 * G * s * s);

    let mut motion = *physics.motion(id);
    for step in 1..=100_u64 {
        let t = SimTime::from_millis(37 * step);
        let s = 0.037 * step as f64;
        assert!(physics.motion(id).position(t).distance(expected(s)) < 1e-12);
        motion.advance(t).unwrap();
        assert!(motion.position(t).distance(expected(s)) < 1e-11);
    }
}

#[test]
fn a_force_holds_until_it_is_set_again_and_weight_is_extra() {
    let mut physics = Physics::new(Config {
        ground: None,
        ..Config::default()
    });
    let id = physics.add(ball(DVec3::ZERO)).unwrap();
    let mut motion = *physics.motion(id);
    motion
        .set_force(SimTime::ZERO, DVec3::new(0.2, 0.0, 0.1 * G))
        .unwrap();
    assert!(
        motion
            .at(SimTime::from_secs(2))
            .p_enu
            .distance(DVec3::new(4.0, 0.0, 0.0))
            < 1e-12
    );
    assert!(motion.force().distance(DVec3::new(0.2, 0.0, 0.1 * G)) < 1e-15);

    motion
        .add_force(SimTime::from_secs(2), DVec3::new(-0.4, 0.0, 0.0))
        .unwrap();
    let state = motion.at(SimTime::from_secs(3));
    assert!(state.p_enu.distance(DVec3::new(7.0, 0.0, 0.0)) < 1e-12);
    assert!(state.v_enu.distance(DVec3::new(2.0, 0.0, 0.0)) < 1e-12);

    motion
        .set_force(SimTime::from_secs(3), DVec3::ZERO)
        .unwrap();
    assert!((motion.at(SimTime::from_secs(4)).v_enu.z + G).abs() < 1e-12);
}

#[test]
fn an_impulse_changes_the_velocity_by_its_share_of_the_mass() {
    let mut physics = in_space();
    let id = physics.add(floating(DVec3::ZERO, DVec3::X)).unwrap();
    let mut motion = *physics.motion(id);
    motion
        .add_impulse(SimTime::from_secs(1), DVec3::new(0.0, 0.3, 0.0))
        .unwrap();
    let state = motion.at(SimTime::from_secs(2));
    assert!(state.v_enu.distance(DVec3::new(1.0, 3.0, 0.0)) < 1e-12);
    assert!(state.p_enu.distance(DVec3::new(2.0, 3.0, 0.0)) < 1e-12);
}

#[test]
fn terminal_speed_is_reached_under_a_drag_wrench_set_every_millisecond() {
    let mut physics = Physics::new(Config {
        ground: None,
        ..Config::default()
    });
    let id = physics.add(ball(DVec3::ZERO)).unwrap();
    let (mass, drag) = (0.1, 0.02);
    let mut motion = *physics.motion(id);
    for millis in 0..3000 {
        let t = SimTime::from_millis(millis);
        let v = motion.velocity(t);
        motion.set_force(t, v * (-drag * v.length())).unwrap();
    }
    let terminal = (mass * G / drag).sqrt();
    // v(t) = v_terminal tanh(g t / v_terminal)
    let expected = terminal * libm::tanh(3.0 * G / terminal);
    let speed = -motion.velocity(SimTime::from_secs(3)).z;
    assert!(
        (speed / expected - 1.0).abs() < 1e-4,
        "{speed} m/s instead of {expected} m/s"
    );
}

#[test]
fn a_ghost_moves_on_between_two_settings_and_feels_no_weight() {
    let mut physics = on_ground(surface(0.5, 0.5));
    let start = DVec3::new(0.0, 0.0, 5.0);
    let spec = BodySpec {
        mobility: Mobility::Driven,
        contacts: Contacts::Detect,
        ..ball(start)
    };
    let id = physics.add(spec).unwrap();
    let mut motion = *physics.motion(id);
    let east = Attitude::from_yaw(Yaw::default());
    motion.set_pose(SimTime::from_secs(1), start, east).unwrap();
    motion
        .set_twist(SimTime::from_secs(1), DVec3::X, DVec3::Z)
        .unwrap();
    physics.commit(id, SimTime::from_secs(1), motion);
    physics.settle(SimTime::from_secs(1));
    assert!(run(&mut physics, SimTime::from_secs(3)).is_empty());
    let state = physics.motion(id).at(SimTime::from_secs(3));
    assert!(state.p_enu.distance(DVec3::new(2.0, 0.0, 5.0)) < 1e-12);
    let yaw = state.pose().attitude.yaw();
    assert!((yaw.angle().get() - 2.0).abs() < 1e-12);
}

#[test]
fn a_world_in_which_nothing_can_touch_has_nothing_to_do() {
    let mut physics = on_ground(surface(0.5, 0.5));
    let mut stream = stream("nothing");
    for _ in 0..100 {
        let p = stream.in_ball(1.0);
        physics
            .add(BodySpec {
                contacts: Contacts::None,
                ..ball(p)
            })
            .unwrap();
    }
    assert_eq!(physics.next_time(), None);
    assert!(run(&mut physics, SimTime::from_secs(10)).is_empty());
    let tally = physics.tally();
    assert_eq!((tally.searches, tally.contacts), (0, 0));
    assert!(tally.listings <= 1);
}

#[test]
fn a_swarm_at_rest_has_nothing_to_do() {
    let mut physics = on_ground(surface(0.5, 0.0));
    for x in 0..30 {
        for y in 0..30 {
            physics
                .add(ball(DVec3::new(f64::from(x), f64::from(y), 0.3)))
                .unwrap();
        }
    }
    let contacts = run(&mut physics, SimTime::from_secs(1));
    assert_eq!(contacts.len(), 900);
    assert!((0..900).all(|id| physics.motion(BodyId(id)).support() == Support::Resting));
    assert_eq!(physics.next_time(), None);
    // Told to stay where they are, they still do.
    let listings = physics.tally().listings;
    for id in 0..900 {
        let mut motion = *physics.motion(BodyId(id));
        motion
            .set_force(seconds(1.0), DVec3::new(0.0, 0.0, 0.5))
            .unwrap();
        physics.commit(BodyId(id), seconds(1.0), motion);
    }
    physics.settle(seconds(1.0));
    assert_eq!(physics.next_time(), None);
    assert_eq!(physics.tally().listings, listings);
}

#[test]
fn near_finds_who_is_near_now() {
    for list_all in [false, true] {
        for contacts in [Contacts::None, Contacts::Detect] {
            let mut physics = Physics::new(Config {
                ground: None,
                list_all,
                ..Config::default()
            });
            let mut stream = stream("near");
            for _ in 0..500 {
                let p = stream.in_ball(10.0);
                let v = stream.in_ball(3.0);
                physics
                    .add(BodySpec {
                        contacts,
                        ..floating(p, v)
                    })
                    .unwrap();
            }
            for (millis, told) in [
                (0, true),
                (50, true),
                (130, false),
                (170, false),
                (1000, true),
            ] {
                let t = SimTime::from_millis(millis);
                // Told or not that time has passed, as long as nothing was due.
                if told {
                    run(&mut physics, t);
                } else {
                    let mut contacts = Vec::new();
                    while let Some(next) = physics.next_time().filter(|next| *next <= t) {
                        physics.advance(next, &mut contacts);
                        physics.settle(next);
                    }
                }
                for radius in [0.1, 1.0, 5.0, f64::INFINITY] {
                    let place = stream.in_ball(10.0);
                    let mut found = Vec::new();
                    physics.near(place, radius, t, &mut found);
                    let near = |id: &u32| {
                        physics.motion(BodyId(*id)).position(t).distance(place) <= radius
                    };
                    let expected: Vec<BodyId> = (0..500).filter(near).map(BodyId).collect();
                    assert_eq!(found, expected);
                }
            }
        }
    }
}
