//! Piles: nobody sinks into the ground, what is pressed together is no news, and what rests costs nothing.

use crate::worlds::{G, ball, on_ground, run, seconds, stream, surface};
use proptest::prelude::*;
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Contact, Physics, Shape, limits};
use simbeeotic_units::glam::DVec3;

/// `count` bees of 0.1 m that fall within a column half a metre wide.
fn pile(count: usize, purpose: &str, restitution: f64) -> Physics {
    let mut physics = on_ground(surface(0.5, restitution));
    let mut stream = stream(purpose);
    let mut places: Vec<DVec3> = Vec::new();
    while places.len() < count {
        let top = 0.3 + 0.02 * count as f64;
        let [x, y] = [(); 2].map(|()| stream.uniform_in(0.0..0.3));
        let p = DVec3::new(x, y, stream.uniform_in(0.06..top));
        if places.iter().all(|q| q.distance(p) > 0.101) {
            places.push(p);
            let spec = BodySpec {
                p_enu: p,
                material: surface(0.5, restitution),
                ..BodySpec::new(Shape::Sphere { radius_m: 0.05 }, 0.128)
            };
            physics.add(spec).unwrap();
        }
    }
    physics
}

/// How far an island lets a body sink, m: bodies of 0.1 kg on one another, and a millimetre of slop.
const SLOP_M: f64 = 1.5e-3;

/// How far the lowest body is below its place on the ground, m.
fn sunk(physics: &Physics, t: SimTime) -> f64 {
    (0..physics.len() as u32)
        .map(|id| physics.motion(BodyId(id)))
        .map(|motion| motion.radius_m() - motion.position(t).z)
        .fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 8, ..ProptestConfig::default() })]

    #[test]
    fn no_body_of_a_pile_sinks_into_the_ground(seed in 0_u32..1000, count in 5_usize..120, bouncy in any::<bool>()) {
        let mut physics = pile(count, &format!("pile {seed}"), if bouncy { 0.6 } else { 0.0 });
        for step in 1..=6 {
            let t = seconds(0.1 * f64::from(step));
            run(&mut physics, t);
            prop_assert!(sunk(&physics, t) < SLOP_M, "{} m at {t}", sunk(&physics, t));
        }
    }
}

/// Piles in which a body that lay on the ground was once driven millimetres into it within a step: in the first
/// by a member of its island that another one hit; in the second its island went up in one whose next step
/// was later.
#[test]
fn nobody_is_driven_into_the_ground_by_who_hits_it() {
    for (seed, count, restitution) in [(654, 57, 0.0), (1390, 97, 0.6)] {
        let mut physics = pile(count, &format!("pile {seed}"), restitution);
        for step in 1..=600 {
            let t = seconds(0.001 * f64::from(step));
            run(&mut physics, t);
            let depth = sunk(&physics, t);
            assert!(depth < SLOP_M, "pile {seed}: {depth} m at {t}");
        }
    }
}

#[test]
fn a_stack_that_rests_is_no_news_and_costs_nothing() {
    let mut physics = on_ground(surface(0.5, 0.0));
    for z in [0.1, 0.301, 0.502] {
        let spec = BodySpec {
            material: surface(0.5, 0.0),
            ..ball(DVec3::new(0.0, 0.0, z))
        };
        physics.add(spec).unwrap();
    }
    run(&mut physics, seconds(2.0));
    let before = physics.tally();
    let reported = run(&mut physics, seconds(10.0));
    assert!(reported.is_empty(), "{} reported", reported.len());
    assert_eq!(physics.tally(), before);
    assert_eq!(physics.next_time(), None);
    assert!(sunk(&physics, seconds(10.0)) < SLOP_M);
}

#[test]
fn whoever_has_been_apart_or_comes_fast_is_reported() {
    let mut physics = on_ground(surface(0.0, 1.0));
    let spec = BodySpec {
        material: surface(0.0, 0.64),
        ..ball(DVec3::new(0.0, 0.0, 1.1))
    };
    let body = physics.add(spec).unwrap();
    let contacts = run(&mut physics, seconds(10.0));
    let fast = |c: &&Contact| c.closing_speed_m_s() > limits::NEWS_SPEED_M_S;
    assert_eq!(contacts.iter().filter(fast).count(), contacts.len());
    assert!(contacts.len() > 10 && physics.tally().contacts > contacts.len() as u64);
    // A jump of 0.2 s that ends slowly is one, too: it has been apart.
    let mut motion = *physics.motion(body);
    motion.set_velocity(seconds(10.0), DVec3::Z * 0.05).unwrap();
    let weightless = DVec3::Z * (0.1 * G - 0.1 * 0.5);
    motion.set_force(seconds(10.0), weightless).unwrap();
    physics.commit(body, seconds(10.0), motion);
    assert_eq!(run(&mut physics, seconds(11.0)).len(), 1);
}

#[test]
fn a_great_pile_sinks_nowhere_and_comes_to_rest() {
    let mut physics = pile(200, "great pile", 0.0);
    for step in 1..=6 {
        let t = seconds(0.5 * f64::from(step));
        run(&mut physics, t);
        assert!(sunk(&physics, t) < SLOP_M, "{} m at {t}", sunk(&physics, t));
    }
    run(&mut physics, seconds(30.0));
    let before = physics.tally();
    run(&mut physics, seconds(60.0));
    assert_eq!(physics.tally(), before);
}
