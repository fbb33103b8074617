//! Nobody comes farther than the count says.

use crate::shapes::{self, Kind, attitude};
use crate::worlds::surface;
use proptest::prelude::*;
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_physics::{BodyId, BodySpec, Config, Mobility, Motion, Physics};
use simbeeotic_units::glam::DVec3;

const BODIES: u32 = 12;
/// At most 20 m/s^2, so that a second of flight is no more than a few tens of metres.
const MOST_FORCE_N: f64 = 10.0;

fn direction(stream: &mut Stream) -> DVec3 {
    stream.in_ball(1.0)
}

/// Bodies of all shapes in a heap, so that they fall, bounce, slide, roll and come to rest.
fn heap(stream: &mut Stream) -> Physics {
    let mut physics = Physics::new(Config {
        ground: Some(surface(0.5, 0.6)),
        ..Config::default()
    });
    for k in 0..BODIES {
        let shape = shapes::shape(
            [Kind::Sphere, Kind::Box, Kind::Capsule][k as usize % 3],
            0.3,
            stream,
        )
        .centred()
        .0;
        let [x, y, z] = [k % 3, k / 3 % 3, k / 9].map(f64::from);
        let spec = BodySpec {
            p_enu: DVec3::new(x, y, 0.5 + z),
            v_enu: direction(stream),
            attitude: attitude(stream),
            material: surface(stream.uniform(), stream.uniform()),
            mobility: if k % 11 == 10 {
                Mobility::Driven
            } else {
                Mobility::Free
            },
            ..BodySpec::new(shape, stream.uniform_in(0.5..2.0))
        };
        physics.add(spec).unwrap();
    }
    physics
}

/// What an agent may do to its body: push it, stop it, put it elsewhere.
fn meddle(motion: &mut Motion, now: SimTime, stream: &mut Stream) {
    motion.advance(now).unwrap();
    let place = motion.position(now);
    // Whatever is refused changes nothing.
    let _ = match stream.below(4) {
        0 => motion.set_velocity(now, 5.0 * direction(stream)),
        1 => motion.set_force(now, MOST_FORCE_N * direction(stream)),
        2 => motion.set_position(now, place + 3.0 * direction(stream)),
        _ => motion.set_velocity(now, DVec3::ZERO),
    };
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(6))]

    #[test]
    fn nobody_comes_farther_than_the_odometer_counts(seed: u64) {
        let mut stream = Stream::new(seed, "odometer", "test");
        let mut physics = heap(&mut stream);
        prop_assert_eq!(physics.odometer(SimTime::ZERO), None, "nobody wanted it so far");
        physics.survey(SimTime::ZERO);
        let ids: Vec<BodyId> = (0..BODIES).map(BodyId).collect();
        let mut seen: Vec<(f64, Vec<DVec3>)> = Vec::new();
        for step in 0..50 {
            let now = SimTime::from_millis(20 * step);
            let mut contacts = Vec::new();
            physics.advance(now, &mut contacts);
            physics.survey(now);
            let places: Vec<DVec3> = ids.iter().map(|id| physics.motion(*id).position(now)).collect();
            let reading = physics.odometer(now).unwrap();
            for (earlier, were) in &seen {
                for (was, is) in were.iter().zip(&places) {
                    prop_assert!(was.distance(*is) <= reading - earlier + 1e-9);
                }
            }
            seen.push((reading, places));
            if stream.bernoulli(0.3) {
                let id = ids[stream.below(BODIES.into()) as usize];
                let mut motion = *physics.motion(id);
                meddle(&mut motion, now, &mut stream);
                physics.commit(id, now, motion);
            }
            physics.settle(now);
        }
        let travelled = seen.last().unwrap().0;
        prop_assert!(travelled < 100.0, "no use: {} m in 1 s", travelled);
    }
}
