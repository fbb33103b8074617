//! Two balls: when they meet, and what it does to them.

use crate::worlds::{
    as_seconds, ball, direction, floating, in_space, kinetic_energy, run, seconds, stream, surface,
};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Contacts, Physics, Shape};
use simbeeotic_units::glam::DVec3;

fn momentum(physics: &Physics, t: SimTime) -> DVec3 {
    let of = |id: u32| {
        let motion = physics.motion(BodyId(id));
        motion.velocity(t) * motion.mass_kg()
    };
    (0..physics.len() as u32).map(of).sum()
}

fn angular_momentum(physics: &Physics, t: SimTime) -> DVec3 {
    let of = |id: u32| {
        let motion = physics.motion(BodyId(id));
        let s = motion.at(t);
        s.p_enu.cross(s.v_enu) * motion.mass_kg()
            + s.world_from_body * (motion.inertia_kg_m2() * s.w_flu)
    };
    (0..physics.len() as u32).map(of).sum()
}

#[test]
fn time_of_impact_is_within_a_microsecond_at_any_speed_and_angle() {
    let mut stream = stream("time of impact");
    for speed in [0.1, 0.3, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0] {
        for _ in 0..40 {
            // Place the meeting, then go back from it.
            let touch = f64::from(0.1_f32) * 2.0;
            let normal = direction(&mut stream);
            let mut v = direction(&mut stream) * speed;
            if v.dot(normal) > 0.0 {
                v = -v;
            }
            // A graze is ill-conditioned: leave out the last degrees.
            if v.dot(normal) > -0.05 * speed {
                continue;
            }
            let lead = stream.uniform_in(0.01..2.0);
            let mut physics = in_space();
            let common = direction(&mut stream) * 3.0;
            physics.add(floating(DVec3::ZERO, common)).unwrap();
            physics
                .add(floating(normal * touch - v * lead, v + common))
                .unwrap();
            let contacts = run(&mut physics, seconds(lead + 0.01));
            assert_eq!(contacts.len(), 1, "{speed} m/s");
            let error = as_seconds(contacts[0].time) - lead;
            assert!(error.abs() < 1e-8, "{speed} m/s: {error} s");
            assert!(contacts[0].normal_enu.distance(normal) < 1e-5);
        }
    }
}

#[test]
fn time_of_impact_is_right_under_different_accelerations() {
    let mut stream = stream("accelerated");
    for case in 0..300 {
        let mut physics = in_space();
        let touch = f64::from(0.1_f32) * 2.0;
        let lead = stream.uniform_in(0.05..1.5);
        let normal = direction(&mut stream);
        let a = stream.in_ball(20.0);
        // Meeting velocity: mostly inwards.
        let v = -normal * stream.uniform_in(0.5..5.0) + stream.in_ball(0.3);
        let start_v = v - a * lead;
        let start_p = normal * touch - v * lead + a * (0.5 * lead * lead);
        // Only if this meeting is the first.
        let apart = |s: f64| (start_p + start_v * s + a * (0.5 * s * s)).length() > touch;
        if (0..2000).any(|k| !apart(lead * f64::from(k) / 2000.0 - 1e-9)) {
            continue;
        }
        let one = physics.add(floating(DVec3::ZERO, DVec3::ZERO)).unwrap();
        let two = physics.add(floating(start_p, start_v)).unwrap();
        let mut motion = *physics.motion(two);
        motion.set_force(SimTime::ZERO, a * 0.1).unwrap();
        physics.commit(two, SimTime::ZERO, motion);
        let contacts = run(&mut physics, seconds(lead + 1e-3));
        assert_eq!(contacts.len(), 1, "case {case}");
        assert_eq!((contacts[0].a, contacts[0].b), (one, Some(two)));
        assert!(
            (as_seconds(contacts[0].time) - lead).abs() < 1e-8,
            "case {case}"
        );
    }
}

#[test]
fn an_elastic_impact_keeps_momentum_and_energy() {
    let mut stream = stream("elastic");
    let smooth = surface(0.0, 1.0);
    for _ in 0..200 {
        let mut physics = in_space();
        let (m1, m2) = (stream.uniform_in(0.1..3.0), stream.uniform_in(0.1..3.0));
        let n = direction(&mut stream);
        let v = -n * stream.uniform_in(0.5..20.0) + stream.in_ball(0.2);
        let body = |p, v, mass_kg| BodySpec {
            v_enu: v,
            p_enu: p,
            gravity: false,
            material: smooth,
            ..BodySpec::new(Shape::Sphere { radius_m: 0.125 }, mass_kg)
        };
        let drift = direction(&mut stream) * 2.0;
        physics.add(body(DVec3::ZERO, drift, m1)).unwrap();
        physics.add(body(n, v + drift, m2)).unwrap();
        let (p0, e0) = (
            momentum(&physics, SimTime::ZERO),
            kinetic_energy(&physics, SimTime::ZERO),
        );
        let l0 = angular_momentum(&physics, SimTime::ZERO);
        let end = seconds(3.0);
        assert_eq!(run(&mut physics, end).len(), 1);
        assert!(momentum(&physics, end).distance(p0) < 1e-9);
        assert!((kinetic_energy(&physics, end) / e0 - 1.0).abs() < 1e-9);
        assert!(angular_momentum(&physics, end).distance(l0) < 1e-7);

        // The closed form for the velocities.
        let normal = {
            let (a, b) = (physics.motion(BodyId(0)), physics.motion(BodyId(1)));
            let t = a.start();
            (b.position(t) - a.position(t)).normalize()
        };
        let along = v.dot(normal);
        let v1 = drift + normal * (2.0 * m2 / (m1 + m2) * along);
        let v2 = v + drift - normal * (2.0 * m1 / (m1 + m2) * along);
        assert!(physics.motion(BodyId(0)).velocity(end).distance(v1) < 1e-9);
        assert!(physics.motion(BodyId(1)).velocity(end).distance(v2) < 1e-9);
    }
}

#[test]
fn friction_and_spin_keep_momentum_and_angular_momentum_and_lose_energy() {
    let mut stream = stream("rough");
    for _ in 0..200 {
        let mut physics = in_space();
        let body = |p, v, w| BodySpec {
            material: surface(0.4, 0.6),
            w_flu: w,
            ..floating(p, v)
        };
        let n = direction(&mut stream);
        let v = -n * stream.uniform_in(1.0..5.0) + stream.in_ball(0.2);
        let (w1, w2) = (stream.in_ball(30.0), stream.in_ball(30.0));
        physics.add(body(DVec3::ZERO, DVec3::ZERO, w1)).unwrap();
        physics.add(body(n, v, w2)).unwrap();
        let (p0, e0) = (
            momentum(&physics, SimTime::ZERO),
            kinetic_energy(&physics, SimTime::ZERO),
        );
        let l0 = angular_momentum(&physics, SimTime::ZERO);
        let end = seconds(2.0);
        assert_eq!(run(&mut physics, end).len(), 1);
        assert!(momentum(&physics, end).distance(p0) < 1e-12);
        assert!(angular_momentum(&physics, end).distance(l0) < 1e-7);
        assert!(kinetic_energy(&physics, end) < e0);
    }
}

#[test]
fn a_cradle_hands_the_blow_through_within_one_instant() {
    let mut physics = in_space();
    let radius = f64::from(0.1_f32);
    for k in 0..5 {
        let spec = floating(
            DVec3::new(2.0 * radius * f64::from(k), 0.0, 0.0),
            DVec3::ZERO,
        );
        physics
            .add(BodySpec {
                material: surface(0.0, 1.0),
                ..spec
            })
            .unwrap();
    }
    let striker = floating(DVec3::new(-1.0, 0.0, 0.0), DVec3::new(2.0, 0.0, 0.0));
    physics
        .add(BodySpec {
            material: surface(0.0, 1.0),
            ..striker
        })
        .unwrap();
    let end = seconds(1.0);
    let contacts = run(&mut physics, end);
    assert_eq!(contacts.len(), 5);
    assert!((physics.motion(BodyId(4)).velocity(end).x - 2.0).abs() < 1e-4);
    for still in [5, 0, 1, 2, 3] {
        assert!(physics.motion(BodyId(still)).velocity(end).length() < 1e-4);
    }
}

#[test]
fn pushed_together_two_bodies_touch_a_bounded_number_of_times() {
    let mut physics = in_space();
    let left = physics
        .add(floating(DVec3::new(-1.0, 0.0, 0.0), DVec3::ZERO))
        .unwrap();
    let right = physics
        .add(floating(DVec3::new(1.0, 0.0, 0.0), DVec3::ZERO))
        .unwrap();
    for (id, push) in [(left, 0.1), (right, -0.1)] {
        let mut motion = *physics.motion(id);
        motion
            .set_force(SimTime::ZERO, DVec3::new(push, 0.0, 0.0))
            .unwrap();
        physics.commit(id, SimTime::ZERO, motion);
    }
    let end = seconds(11.0);
    let contacts = run(&mut physics, end);
    // They meet after 1.34 s; then 2 w / a = 0.05 s a bounce.
    assert!((190..=200).contains(&contacts.len()), "{}", contacts.len());
    let gap = physics
        .motion(left)
        .position(end)
        .distance(physics.motion(right).position(end))
        - 0.2;
    assert!((-1e-7..1e-3).contains(&gap), "{gap}");
}

#[test]
fn two_that_detect_pass_through_each_other_and_are_reported_when_they_begin() {
    let mut physics = in_space();
    let ghostly = |p, v| BodySpec {
        contacts: Contacts::Detect,
        ..floating(p, v)
    };
    physics.add(ghostly(DVec3::ZERO, DVec3::ZERO)).unwrap();
    let other = physics.add(ghostly(DVec3::X, -DVec3::X)).unwrap();
    let contacts = run(&mut physics, seconds(5.0));
    assert_eq!(contacts.len(), 1);
    assert_eq!(contacts[0].impulse_enu, DVec3::ZERO);
    assert!((as_seconds(contacts[0].time) - 0.8).abs() < 1e-6);

    // Back through it, with changes of course while inside.
    let mut total = 0;
    for step in 0..200_u64 {
        let t = seconds(5.0).saturating_add_nanos(step * 50_000_000);
        total += run(&mut physics, t).len();
        let mut motion = *physics.motion(other);
        motion
            .set_velocity(t, DVec3::new(1.0, 1e-3 * (step % 7) as f64, 0.0))
            .unwrap();
        physics.commit(other, t, motion);
        physics.settle(t);
    }
    assert_eq!(total, 1);
}

#[test]
fn of_many_that_detect_each_touch_is_reported_once() {
    // One passes through a row of ten; lists are made anew all the time, and it outruns them.
    let mut physics = crate::worlds::listed_every(None, 0.01);
    let ghostly = |p, v| BodySpec {
        contacts: Contacts::Detect,
        ..floating(p, v)
    };
    for k in 0..10 {
        physics
            .add(ghostly(
                DVec3::new(f64::from(k) * 0.15, 0.0, 0.0),
                DVec3::ZERO,
            ))
            .unwrap();
    }
    let passer = physics
        .add(ghostly(DVec3::new(-1.0, 0.0, 0.0), DVec3::X))
        .unwrap();
    let mut contacts = run(&mut physics, seconds(0.5));
    let mut motion = *physics.motion(passer);
    motion.set_velocity(seconds(0.5), DVec3::X * 20.0).unwrap();
    physics.commit(passer, seconds(0.5), motion);
    contacts.extend(run(&mut physics, seconds(3.0)));
    let met: Vec<u32> = contacts
        .iter()
        .filter(|c| c.b == Some(passer))
        .map(|c| c.a.0)
        .collect();
    assert_eq!(met, (0..10).collect::<Vec<u32>>());
}

#[test]
fn one_that_detects_keeps_one_that_responds_from_bouncing() {
    let mut physics = in_space();
    physics
        .add(BodySpec {
            contacts: Contacts::Detect,
            ..floating(DVec3::ZERO, DVec3::ZERO)
        })
        .unwrap();
    let id = physics.add(floating(DVec3::X, -DVec3::X)).unwrap();
    assert_eq!(run(&mut physics, seconds(3.0)).len(), 1);
    assert!((physics.motion(id).position(seconds(3.0)).x + 2.0).abs() < 1e-12);
}

#[test]
fn groups_that_do_not_agree_never_meet() {
    let mut physics = in_space();
    physics
        .add(BodySpec {
            group: 1,
            mask: 2,
            ..floating(DVec3::ZERO, DVec3::ZERO)
        })
        .unwrap();
    physics
        .add(BodySpec {
            group: 2,
            mask: 2,
            ..floating(DVec3::X, -DVec3::X)
        })
        .unwrap();
    assert!(run(&mut physics, seconds(3.0)).is_empty());
    assert_eq!(physics.tally().searches, 0);
}

#[test]
fn overlapping_starts_part_without_a_bang() {
    let mut physics = in_space();
    let mut stream = stream("overlap");
    for _ in 0..60 {
        let p = stream.in_ball(0.3);
        physics.add(floating(p, stream.in_ball(0.5))).unwrap();
    }
    let before = kinetic_energy(&physics, SimTime::ZERO);
    run(&mut physics, seconds(10.0));
    let after = kinetic_energy(&physics, seconds(10.0));
    assert!(
        after <= before * (1.0 + 1e-6),
        "{before} J became {after} J"
    );
    let at_rest = || {
        let mut physics = in_space();
        physics.add(floating(DVec3::ZERO, DVec3::ZERO)).unwrap();
        physics
            .add(floating(DVec3::new(0.05, 0.0, 0.0), DVec3::ZERO))
            .unwrap();
        physics
    };
    assert!(run(&mut at_rest(), seconds(5.0)).is_empty());
}

#[test]
fn a_stack_on_the_ground_keeps_its_contacts_bounded() {
    let mut physics = crate::worlds::on_ground(surface(0.5, 0.0));
    for k in 0..3 {
        physics
            .add(ball(DVec3::new(
                1e-3 * f64::from(k),
                0.0,
                0.1 + 0.21 * f64::from(k),
            )))
            .unwrap();
    }
    let contacts = run(&mut physics, seconds(3.0));
    assert!(contacts.len() < 5000, "{}", contacts.len());
    for id in 0..3 {
        let state = physics.motion(BodyId(id)).at(seconds(3.0));
        assert!(state.p_enu.z > 0.1 - 1.5e-3 && state.v_enu.length() < 10.0);
    }
}
