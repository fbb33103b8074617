//! Sliding over the ground.

use crate::worlds::{G, ball, on_ground, run, seconds, surface};
use simbeeotic_physics::{BodyId, BodySpec, Physics, Support};
use simbeeotic_units::glam::DVec3;

/// A ball that slides at `v` over ground with the friction coefficient `mu`, from 0 s on.
fn sliding(mu: f64, v: DVec3) -> (Physics, BodyId) {
    let mut physics = on_ground(surface(mu, 0.0));
    let spec = BodySpec {
        material: surface(mu, 0.0),
        v_enu: v,
        ..ball(DVec3::new(0.0, 0.0, 0.1))
    };
    let id = physics.add(spec).unwrap();
    (physics, id)
}

#[test]
fn it_slides_v_squared_over_two_mu_g_and_stops() {
    let (mu, v) = (0.5, 3.0);
    let (mut physics, id) = sliding(mu, DVec3::new(v, 0.0, 0.0));
    let stop = v / (mu * G);
    run(&mut physics, seconds(0.5 * stop));
    assert_eq!(physics.motion(id).support(), Support::Sliding);
    let halfway = physics.motion(id).velocity(seconds(0.5 * stop)).x;
    assert!((halfway - 0.5 * v).abs() < 1e-7);

    run(&mut physics, seconds(stop + 1e-6));
    assert_eq!(physics.motion(id).support(), Support::Resting);
    run(&mut physics, seconds(10.0));
    let state = physics.motion(id).at(seconds(10.0));
    assert!((state.p_enu.x - v * v / (2.0 * mu * G)).abs() < 1e-7);
    assert_eq!(state.v_enu, DVec3::ZERO);
    assert_eq!(state.w_flu, DVec3::ZERO);
    assert_eq!(physics.next_time(), None);
}

#[test]
fn without_friction_it_slides_for_ever() {
    let (mut physics, id) = sliding(0.0, DVec3::new(1.0, 2.0, 0.0));
    run(&mut physics, seconds(50.0));
    assert!(
        physics
            .motion(id)
            .position(seconds(50.0))
            .distance(DVec3::new(50.0, 100.0, 0.1))
            < 1e-6
    );
}

#[test]
fn a_push_weaker_than_friction_moves_nothing() {
    let (mut physics, id) = sliding(0.5, DVec3::ZERO);
    run(&mut physics, seconds(0.1));
    let mut motion = *physics.motion(id);
    motion
        .set_force(seconds(0.1), DVec3::new(0.49 * 0.1 * G, 0.0, 0.0))
        .unwrap();
    assert_eq!(motion.support(), Support::Resting);
    motion
        .set_force(seconds(0.1), DVec3::new(0.6 * 0.1 * G, 0.0, 0.0))
        .unwrap();
    assert_eq!(motion.support(), Support::Sliding);
    assert!((motion.acceleration().x - 0.1 * G).abs() < 1e-6);
    assert!((motion.position(seconds(2.1)).x - 0.5 * 0.1 * G * 4.0).abs() < 1e-5);
}

#[test]
fn pressed_down_it_grips_harder() {
    let (mut physics, id) = sliding(0.5, DVec3::new(2.0, 0.0, 0.0));
    run(&mut physics, seconds(0.001));
    let mut motion = *physics.motion(id);
    let speed = motion.velocity(seconds(0.001)).x;
    motion
        .set_force(seconds(0.001), DVec3::new(0.0, 0.0, -0.1 * G))
        .unwrap();
    physics.commit(id, seconds(0.001), motion);
    run(&mut physics, seconds(1.0));
    let way = physics.motion(id).position(seconds(1.0)).x - motion.position(seconds(0.001)).x;
    assert!((way - speed * speed / (2.0 * 0.5 * 2.0 * G)).abs() < 1e-6);
}

#[test]
fn a_push_across_bends_the_slide_toward_itself() {
    // Against v' = f - mu g v/|v| integrated in fine steps.
    let (mu, f) = (0.25, 1.5);
    let (mut physics, id) = sliding(mu, DVec3::new(2.0, 0.0, 0.0));
    run(&mut physics, seconds(0.001));
    let mut motion = *physics.motion(id);
    motion
        .set_force(seconds(0.001), DVec3::new(0.0, 0.1 * f, 0.0))
        .unwrap();
    physics.commit(id, seconds(0.001), motion);

    let start = motion.at(seconds(0.001));
    let (mut p, mut v) = (start.p_enu, start.v_enu);
    let h = 1e-5;
    for _ in 0..199_900 {
        let speed = v.length();
        let friction = if speed > mu * G * h {
            v / speed * (mu * G)
        } else {
            v / h
        };
        v += (DVec3::new(0.0, f, 0.0) - friction) * h;
        p += v * h;
    }
    run(&mut physics, seconds(2.0));
    let end = physics.motion(id).at(seconds(2.0));
    assert!(end.p_enu.distance(p) < 0.01, "{} instead of {p}", end.p_enu);
    assert!(physics.tally().reviews < 200);
}

#[test]
fn it_never_gains_energy() {
    let (mut physics, id) = sliding(0.4, DVec3::new(3.0, -4.0, 0.0));
    let mut last = f64::INFINITY;
    for millis in 1..2000_u64 {
        let t = simbeeotic_kernel::SimTime::from_millis(millis);
        run(&mut physics, t);
        let speed = physics.motion(id).velocity(t).length();
        assert!(speed <= last);
        last = speed;
    }
    assert_eq!(last, 0.0);
}
