//! What the original got wrong, for ever.

use crate::worlds::{G, as_seconds, ball, on_ground, run, seconds, surface};
use simbeeotic_physics::BodySpec;
use simbeeotic_units::glam::DVec3;

/// The original looked for contacts every 0.1 s: a fall that ends at 0.9 s was reported at 0.999999999 s.
#[test]
fn a_contact_is_reported_when_it_happens_not_at_the_next_tenth_of_a_second() {
    let mut physics = on_ground(surface(0.5, 0.0));
    let height = 0.5 * G * 0.9 * 0.9;
    physics
        .add(ball(DVec3::new(0.0, 0.0, f64::from(0.1_f32) + height)))
        .unwrap();
    let contacts = run(&mut physics, seconds(2.0));
    assert_eq!(contacts.len(), 1);
    assert!((as_seconds(contacts[0].time) - 0.9).abs() < 1e-9);
}

/// In the original the same body was 0.19 m inside the ground at 0.9 s.
#[test]
fn a_body_is_never_inside_the_ground() {
    let mut physics = on_ground(surface(0.5, 0.3));
    let spec = BodySpec {
        v_enu: DVec3::new(1.0, 0.0, -5.0),
        ..ball(DVec3::new(0.0, 0.0, 4.0))
    };
    let id = physics.add(spec).unwrap();
    for step in 0..2000 {
        let t = seconds(1e-3 * f64::from(step));
        run(&mut physics, t);
        let motion = physics.motion(id);
        assert!(motion.position(t).z >= motion.radius_m() - 1e-9);
    }
}

/// In the original two fast bodies passed through each other between two steps.
#[test]
fn fast_bodies_do_not_pass_through_each_other() {
    for speed in [10.0, 30.0, 300.0] {
        let mut physics = crate::worlds::in_space();
        let flying =
            |x: f64, v: f64| crate::worlds::floating(DVec3::new(x, 0.0, 0.0), DVec3::X * v);
        let left = physics.add(flying(-20.0, speed)).unwrap();
        let right = physics.add(flying(20.0, -speed)).unwrap();
        let end = seconds(60.0 / speed);
        assert_eq!(run(&mut physics, end).len(), 1);
        assert!(physics.motion(left).position(end).x < physics.motion(right).position(end).x);
    }
}
