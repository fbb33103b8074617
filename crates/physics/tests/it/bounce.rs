//! Impacts on the ground.

use crate::worlds::{G, as_seconds, ball, floating, on_ground, run, seconds, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodySpec, Contact, Contacts, Mobility, Support, limits};
use simbeeotic_units::glam::DVec3;

#[test]
fn each_bounce_rises_to_the_square_of_the_restitution_until_it_rests() {
    let e = 0.7;
    let mut physics = on_ground(surface(0.5, e));
    let spec = BodySpec {
        material: surface(0.5, e),
        ..ball(DVec3::new(0.0, 0.0, 5.1))
    };
    let id = physics.add(spec).unwrap();
    let radius = physics.motion(id).radius_m();

    let fall = (2.0 * (5.1 - radius) / G).sqrt();
    let mut time = fall;
    let mut speed = G * fall;
    let contacts = run(&mut physics, seconds(20.0));
    for contact in &contacts {
        assert_eq!((contact.a, contact.b), (id, None));
        assert!((as_seconds(contact.time) - time).abs() < 1e-6);
        assert!((contact.closing_speed_m_s() - speed).abs() < 1e-6);
        assert_eq!(contact.point_enu.z, 0.0);
        speed *= e;
        time += 2.0 * speed / G;
    }
    // The next is too slow, and too soon, to be news.
    assert!(speed <= limits::NEWS_SPEED_M_S && speed / e > limits::NEWS_SPEED_M_S);
    let motion = physics.motion(id);
    assert_eq!(motion.support(), Support::Resting);
    assert_eq!(motion.position(seconds(20.0)).z, radius);
    assert_eq!(motion.velocity(seconds(20.0)), DVec3::ZERO);
    assert_eq!(physics.next_time(), None);
}

#[test]
fn an_elastic_ball_comes_back_to_its_height_a_thousand_times() {
    let mut physics = on_ground(surface(0.0, 1.0));
    let spec = BodySpec {
        material: surface(0.0, 1.0),
        ..ball(DVec3::new(0.0, 0.0, 1.1))
    };
    let id = physics.add(spec).unwrap();
    let contacts = run(&mut physics, seconds(904.0));
    assert!(contacts.len() > 1000);
    let motion = physics.motion(id);
    let energy = |t: SimTime| G * motion.position(t).z + 0.5 * motion.velocity(t).length_squared();
    assert!((energy(seconds(904.0)) / (G * 1.1) - 1.0).abs() < 1e-6);
}

#[test]
fn time_of_impact_on_the_ground_is_within_a_microsecond_at_any_speed() {
    for speed in [0.1, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0] {
        for height in [1e-3, 0.1, 1.0, 7.3] {
            for gravity in [false, true] {
                let mut physics = on_ground(surface(0.5, 0.5));
                let spec = BodySpec {
                    gravity,
                    ..floating(DVec3::new(0.0, 0.0, 0.0), DVec3::new(3.0, 0.0, -speed))
                };
                let spec = BodySpec {
                    p_enu: DVec3::new(0.0, 0.0, f64::from(0.1_f32) + height),
                    ..spec
                };
                physics.add(spec).unwrap();
                let g = if gravity { G } else { 0.0 };
                let expected = 2.0 * height / (speed + (speed * speed + 2.0 * g * height).sqrt());
                let contacts = run(&mut physics, seconds(expected + 0.01));
                let error = as_seconds(contacts[0].time) - expected;
                assert!(error.abs() < 1e-8, "{speed} m/s from {height} m: {error} s");
            }
        }
    }
}

#[test]
fn a_bounce_with_friction_spins_the_ball_forward() {
    let mut physics = on_ground(surface(0.1, 1.0));
    let spec = BodySpec {
        v_enu: DVec3::new(2.0, 0.0, -1.0),
        material: surface(0.1, 1.0),
        ..ball(DVec3::new(0.0, 0.0, 0.2))
    };
    let id = physics.add(spec).unwrap();
    let contact = run(&mut physics, seconds(0.11))[0];
    // The full friction impulse, mu times the normal one, for it slides throughout.
    let normal = 2.0 * 0.1 * contact.closing_speed_m_s();
    assert!((contact.impulse_enu.z - normal).abs() < 1e-9);
    assert!((contact.impulse_enu.x + 0.1 * normal).abs() < 1e-6 * normal);
    let state = physics.motion(id).at(seconds(0.11));
    let slower = 0.1 * normal / 0.1;
    assert!((state.v_enu.x - (2.0 - slower)).abs() < 1e-6);
    // Rolling forward to the east is turning about the north axis; I = 2/5 m r^2.
    assert!((state.w_flu.y - slower / 0.04).abs() < 1e-4);
}

#[test]
fn what_only_detects_the_ground_falls_through_and_is_reported_once() {
    let mut physics = on_ground(surface(0.5, 0.5));
    let spec = BodySpec {
        contacts: Contacts::Detect,
        ..ball(DVec3::new(0.0, 0.0, 1.0))
    };
    let id = physics.add(spec).unwrap();
    assert_eq!(run(&mut physics, seconds(3.0)).len(), 1);
    assert!(physics.motion(id).position(seconds(3.0)).z < -40.0);

    // Carried out and in again, it is reported again.
    let mut motion = *physics.motion(id);
    motion
        .set_position(seconds(3.0), DVec3::new(0.0, 0.0, 1.0))
        .unwrap();
    motion.set_velocity(seconds(3.0), DVec3::ZERO).unwrap();
    physics.commit(id, seconds(3.0), motion);
    physics.settle(seconds(3.0));
    assert_eq!(run(&mut physics, seconds(4.0)).len(), 1);
}

#[test]
fn a_body_at_rest_is_lifted_and_falls_again() {
    let mut physics = on_ground(surface(0.5, 0.0));
    let id = physics.add(ball(DVec3::new(0.0, 0.0, 0.1))).unwrap();
    let contacts = run(&mut physics, seconds(1.0));
    assert_eq!(
        contacts.len(),
        1,
        "touching the ground at the start is one contact"
    );
    assert!(contacts[0].time <= SimTime::from_nanos(1));

    let mut motion = *physics.motion(id);
    motion
        .set_force(seconds(1.0), DVec3::new(0.0, 0.0, 0.1 * (G + 2.0)))
        .unwrap();
    assert_eq!(motion.support(), Support::None);
    physics.commit(id, seconds(1.0), motion);
    physics.settle(seconds(1.0));
    assert!(run(&mut physics, seconds(2.0)).is_empty());
    let risen = physics.motion(id).position(seconds(2.0)).z;
    assert!((risen - physics.motion(id).radius_m() - 1.0).abs() < 1e-9);

    let mut motion = *physics.motion(id);
    motion.set_force(seconds(2.0), DVec3::ZERO).unwrap();
    physics.commit(id, seconds(2.0), motion);
    physics.settle(seconds(2.0));
    assert_eq!(run(&mut physics, seconds(5.0)).len(), 1);
    assert_eq!(physics.motion(id).support(), Support::Resting);
}

#[test]
fn a_hovering_body_on_the_ground_does_not_chatter() {
    let mut physics = on_ground(surface(0.5, 0.0));
    let id = physics.add(ball(DVec3::new(0.0, 0.0, 0.1))).unwrap();
    let mut contacts = run(&mut physics, seconds(0.05));
    for step in 1..=100_u64 {
        let t = SimTime::from_millis(100 * step);
        contacts.extend(run(&mut physics, t));
        let mut motion = *physics.motion(id);
        // A hair above and below the weight, by turns; and a push down now and then.
        let up = 0.1 * G * (1.0 + [1e-16, -1e-16, -0.3][step as usize % 3]);
        motion.set_force(t, DVec3::new(0.0, 0.0, up)).unwrap();
        physics.commit(id, t, motion);
        physics.settle(t);
    }
    assert_eq!(contacts.len(), 1);
    assert!((physics.motion(id).position(seconds(11.0)).z - 0.1).abs() < 1e-8);
}

#[test]
fn a_ghost_that_presses_a_body_to_the_ground_does_not_stop_time() {
    let mut physics = on_ground(surface(0.5, 0.3));
    let id = physics.add(ball(DVec3::new(0.0, 0.0, 0.1))).unwrap();
    let ghost = BodySpec {
        mobility: Mobility::Driven,
        mask: simbeeotic_physics::group::BEE,
        v_enu: DVec3::new(0.0, 0.0, -0.2),
        ..ball(DVec3::new(0.0, 0.0, 0.4))
    };
    physics.add(ghost).unwrap();
    let contacts = run(&mut physics, seconds(2.0));
    assert!(contacts.len() < 5000, "{} contacts", contacts.len());
    assert!(physics.motion(id).at(seconds(2.0)).p_enu.is_finite());
}

#[test]
fn contacts_come_in_their_order() {
    let mut physics = on_ground(surface(0.5, 0.4));
    for x in [2.0, 0.0, 1.0] {
        let spec = BodySpec {
            material: surface(0.5, 0.4),
            ..ball(DVec3::new(x, 0.0, 1.0))
        };
        physics.add(spec).unwrap();
    }
    let mut contacts = Vec::new();
    physics.advance(seconds(3.0), &mut contacts);
    let key = |c: &Contact| (c.time, c.a, c.b);
    assert!(contacts.len() > 6 && contacts.is_sorted_by_key(key));
}
