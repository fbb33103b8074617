//! Many bodies: nobody passes through anybody.

use crate::worlds::{
    ball, direction, floating, in_space, on_ground, run, seconds, stream, surface,
};
use proptest::prelude::*;
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Contacts, Physics};
use simbeeotic_units::glam::DVec3;

/// The deepest overlap of any two bodies, and of any with the ground, m.
fn deepest(physics: &Physics, ground: bool, t: SimTime) -> f64 {
    let of = |id: u32| physics.motion(BodyId(id));
    let count = physics.len() as u32;
    let mut deepest = 0.0_f64;
    for a in 0..count {
        let p = of(a).position(t);
        if ground {
            deepest = deepest.max(of(a).radius_m() - p.z);
        }
        for b in 0..a {
            let touch = of(a).radius_m() + of(b).radius_m();
            deepest = deepest.max(touch - p.distance(of(b).position(t)));
        }
    }
    deepest
}

/// `count` bees in a box of `size`, that do not overlap at the start.
fn swarm(physics: &mut Physics, count: usize, size: f64, speed: f64, purpose: &str) {
    let mut stream = stream(purpose);
    let mut places: Vec<DVec3> = Vec::new();
    while places.len() < count {
        let [x, y, z] = [(); 3].map(|()| stream.uniform_in(0.11..size));
        let p = DVec3::new(x, y, z);
        if places.iter().all(|q| q.distance(p) > 0.21) {
            places.push(p);
            let v = direction(&mut stream) * speed;
            physics
                .add(BodySpec {
                    v_enu: v,
                    material: surface(0.3, 0.6),
                    ..ball(p)
                })
                .unwrap();
        }
    }
}

/// Random commands at 10 Hz in random phases; checks overlaps at each command.
fn fly(physics: &mut Physics, ground: bool, until: SimTime, purpose: &str) -> usize {
    let mut stream = stream(purpose);
    let count = physics.len() as u32;
    let mut timers: Vec<(SimTime, u32)> = (0..count)
        .map(|id| (SimTime::from_nanos(stream.below(100_000_000)), id))
        .collect();
    let mut contacts = 0;
    let mut step = 0_u32;
    loop {
        timers.sort_unstable();
        let (t, id) = timers[0];
        if t > until {
            return contacts;
        }
        timers[0].0 = t.saturating_add_nanos(100_000_000);
        contacts += run(physics, t).len();
        let mut motion = *physics.motion(BodyId(id));
        let force = stream.in_ball(1.0) + DVec3::Z * 0.8;
        motion.set_force(t, force).unwrap();
        physics.commit(BodyId(id), t, motion);
        physics.settle(t);
        step += 1;
        if step.is_multiple_of(50) {
            let overlap = deepest(physics, ground, t);
            assert!(overlap < 1e-6, "{overlap} m at {t}");
        }
    }
}

#[test]
fn a_crowd_under_random_commands_never_overlaps() {
    let mut physics = on_ground(surface(0.3, 0.6));
    swarm(&mut physics, 150, 2.5, 1.0, "crowd");
    let contacts = fly(&mut physics, true, seconds(5.0), "crowd commands");
    assert!(contacts > 900, "{contacts}");
}

#[test]
fn a_gas_of_fast_balls_keeps_its_energy_and_never_overlaps() {
    let mut physics = in_space();
    let mut stream = stream("gas");
    let mut count = 0;
    for x in 0..6 {
        for y in 0..6 {
            for z in 0..6 {
                let p = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) * 0.4;
                let v = (DVec3::splat(1.0) - p) * 30.0 + stream.in_ball(100.0);
                let spec = BodySpec {
                    material: surface(0.0, 1.0),
                    ..floating(p, v)
                };
                physics.add(spec).unwrap();
                count += 1;
            }
        }
    }
    let energy = crate::worlds::kinetic_energy(&physics, SimTime::ZERO);
    let mut contacts = 0;
    for step in 1..=200_u64 {
        let t = SimTime::from_nanos(step * 250_000);
        contacts += run(&mut physics, t).len();
        assert!(deepest(&physics, false, t) < 1e-6);
    }
    assert!(contacts > count, "{contacts}");
    let after = crate::worlds::kinetic_energy(&physics, seconds(0.05));
    assert!((after / energy - 1.0).abs() < 1e-9);
}

#[test]
fn one_bullet_among_slow_bodies_hits_what_is_in_its_way() {
    let mut physics = in_space();
    let mut stream = stream("bullet");
    for k in 0..200 {
        let p = DVec3::new(5.0 * f64::from(k), 0.0, 0.0) + stream.in_ball(2.0);
        physics.add(floating(p, stream.in_ball(0.2))).unwrap();
    }
    // In the way of the bullet, 900 m off.
    let target = physics
        .add(floating(DVec3::new(900.0, 7.0, 0.0), DVec3::ZERO))
        .unwrap();
    let bullet = floating(DVec3::new(0.0, 7.0, 0.0), DVec3::new(300.0, 0.0, 0.0));
    let bullet = physics.add(bullet).unwrap();
    let contacts = run(&mut physics, seconds(4.0));
    let hit = contacts.iter().find(|c| c.b == Some(bullet)).unwrap();
    assert_eq!(hit.a, target);
    let expected = (900.0 - 2.0 * f64::from(0.1_f32)) / 300.0;
    assert!((hit.time.nanos() as f64 / 1e9 - expected).abs() < 1e-8);
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, ..ProptestConfig::default() })]

    /// Two bodies under random accelerations: the engine's first contact against a fine march.
    #[test]
    fn nothing_tunnels(
        p in prop::array::uniform3(-3.0_f64..3.0),
        v in prop::array::uniform3(-1.0_f64..1.0),
        a in prop::array::uniform3(-10.0_f64..10.0),
        speed in prop::sample::select(vec![0.1, 1.0, 10.0, 100.0, 300.0]),
        aim in 0.0_f64..1.0,
    ) {
        let (p, a) = (DVec3::from_array(p), DVec3::from_array(a));
        prop_assume!(p.length() > 0.21);
        // Aimed at the other, more or less.
        let v = (-p.normalize() * aim + DVec3::from_array(v) * (1.0 - aim)) * speed;
        let mut physics = in_space();
        let one = physics.add(BodySpec { contacts: Contacts::Detect, ..floating(DVec3::ZERO, DVec3::ZERO) }).unwrap();
        let two = physics.add(floating(p, v)).unwrap();
        let mut motion = *physics.motion(two);
        motion.set_force(SimTime::ZERO, a * 0.1).unwrap();
        physics.commit(two, SimTime::ZERO, motion);
        let end = 1.0;
        let contacts = run(&mut physics, seconds(end));

        let touch = physics.motion(one).radius_m() + physics.motion(two).radius_m();
        let distance = |s: f64| (p + v * s + a * (0.5 * s * s)).length() - touch;
        let first = (1..=20_000).map(|k| end * f64::from(k) / 20_000.0).find(|s| distance(*s) < 0.0);
        match (first, contacts.first()) {
            (Some(s), None) => prop_assert!(distance(s) > -1e-9, "missed a contact at {s} s"),
            (Some(s), Some(contact)) => {
                let time = contact.time.nanos() as f64 / 1e9;
                prop_assert!(time <= s && distance(time).abs() < 1e-6 * speed.max(1.0));
            }
            (None, Some(contact)) => {
                let time = contact.time.nanos() as f64 / 1e9;
                prop_assert!(distance(time).abs() < 1e-6 * speed.max(1.0), "contact at {time} s, {} m apart", distance(time));
            }
            (None, None) => {}
        }
    }
}
