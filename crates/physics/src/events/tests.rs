//! However bodies are put into one another, so many things happen in a given time, and no more.
//!
//! What loops without end within one instant never comes back from `advance`: here things happen one at a
//! time, and are counted.

use crate::body::{BodyId, BodySpec, Material, Mobility};
use crate::config::Config;
use crate::motion::Motion;
use crate::physics::Physics;
use crate::shape::{Part, Shape};
use glam::{DQuat, DVec3};
use proptest::prelude::*;
use simbeeotic_kernel::{SimTime, Stream};
use simbeeotic_units::Attitude;
use std::sync::Arc;

const STEP_MS: u64 = 20;

fn surface(friction: f64, restitution: f64) -> Material {
    Material {
        friction,
        restitution,
    }
}

fn on_ground(ground: Material) -> Physics {
    Physics::new(Config {
        ground: Some(ground),
        ..Config::default()
    })
}

/// [`Physics::advance`] and [`Physics::settle`], but for the end: after `most` things it gives up. Returns
/// how many happened.
fn advance(physics: &mut Physics, now: SimTime, most: u64) -> u64 {
    physics.settle_if_dirty();
    let mut contacts = Vec::new();
    let mut count = 0;
    while count < most && physics.happens_by(now, &mut contacts) {
        count += 1;
    }
    assert!(count < most, "no end of it at {now}: {:?}", contacts.last());
    physics.settle(now);
    count
}

fn dumbbell(length_m: f64, radius_m: f64) -> Shape {
    let part = |x: f64| Part {
        offset_m: DVec3::new(x, 0.0, 0.0),
        attitude: Attitude::IDENTITY,
        shape: Shape::Sphere { radius_m },
    };
    Shape::Compound(Arc::new([part(-0.5 * length_m), part(0.5 * length_m)]))
}

#[test]
fn a_box_put_deep_into_the_ground_is_pushed_out_once_and_not_for_ever() {
    let mut physics = on_ground(surface(0.5, 0.6));
    let half_m = DVec3::new(0.094_94, 0.179_09, 0.183_81);
    let attitude = DQuat::from_xyzw(0.697_028, 0.116_873, -0.698_721, 0.110_819).normalize();
    let id = physics
        .add(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, -1.922_667),
            v_enu: DVec3::new(0.493_522, 0.939_509, 0.304_060),
            w_flu: DVec3::new(0.739_040, -1.137_247, -0.957_234),
            attitude: Attitude::from_unit_quat(attitude),
            material: surface(0.767, 0.9),
            ..BodySpec::new(Shape::Box { half_m }, 0.692)
        })
        .unwrap();
    physics.settle(SimTime::ZERO);
    advance(&mut physics, SimTime::ZERO, 50);
    let lowest = |physics: &Physics, ms| physics.bounds(id, SimTime::from_millis(ms))[0].z;
    assert!(physics.tally().contacts > 0, "no use: it does not meet it");
    let before = lowest(&physics, 0);
    assert!(lowest(&physics, 1) > before, "it goes on down");
}

#[test]
fn of_two_pieces_in_the_ground_one_may_go_down_while_the_deeper_comes_up() {
    let mut physics = on_ground(surface(0.5, 0.5));
    // Tilted by 0.2 rad, east end low, and turning so that this end rises; it hovers.
    let id = physics
        .add(BodySpec {
            p_enu: DVec3::new(0.0, 0.0, -1.0),
            attitude: Attitude::from_unit_quat(DQuat::from_xyzw(0.0, 0.1, 0.0, 0.99_f64.sqrt())),
            w_flu: DVec3::new(0.0, -0.5, 0.0),
            gravity: false,
            ..BodySpec::new(dumbbell(1.0, 0.1), 1.0)
        })
        .unwrap();
    let mut motion = *physics.motion(id);
    let up = DVec3::new(0.0, 0.0, 0.1);
    motion.set_force(SimTime::ZERO, up).unwrap();
    physics.commit(id, SimTime::ZERO, motion);
    let mut count = 0;
    for step in 0..50 {
        count += advance(&mut physics, SimTime::from_millis(STEP_MS * step), 5_000);
    }
    assert!(physics.tally().contacts > 0, "no use: it does not meet it");
    assert!(count < 5_000, "{count} things in a second");
}

/// A heap of all sorts, some of it hovering, one of it driven.
fn heap(stream: &mut Stream) -> Physics {
    let mut physics = on_ground(surface(stream.uniform(), stream.uniform()));
    for k in 0..8_u32 {
        let mut some = || stream.uniform_in(0.05..0.25);
        let shape = match k % 4 {
            0 => Shape::Sphere { radius_m: some() },
            1 => Shape::Box {
                half_m: DVec3::new(some(), some(), some()),
            },
            2 => Shape::Capsule {
                radius_m: some(),
                half_height_m: some(),
            },
            _ => dumbbell(2.0 * some(), some()),
        };
        let [x, y, z] = [k % 2, k / 2 % 2, k / 4].map(f64::from);
        let spec = BodySpec {
            p_enu: 0.4 * DVec3::new(x, y, 1.0 + z),
            v_enu: stream.in_ball(1.0),
            material: surface(stream.uniform(), stream.uniform()),
            mobility: if k == 5 {
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

/// Puts a body somewhere, often into another or into the ground, on some way, turning, under some force.
fn upset(motion: &mut Motion, now: SimTime, stream: &mut Stream) {
    motion.advance(now).unwrap();
    let place = 0.5 * DVec3::Z + stream.in_ball(1.5);
    // Whatever is refused changes nothing.
    let _ = motion.set_position(now, place);
    let _ = motion.set_twist(now, stream.in_ball(3.0), stream.in_ball(5.0));
    let _ = motion.set_force(now, stream.in_ball(30.0));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn so_many_things_happen_in_a_given_time_and_no_more(seed: u64) {
        let mut stream = Stream::new(seed, "events", "test");
        let mut physics = heap(&mut stream);
        for step in 0..25 {
            let now = SimTime::from_millis(STEP_MS * step);
            // A pair that is held meets once a millisecond, and there are 36.
            advance(&mut physics, now, 2_000);
            let id = BodyId(stream.below(8) as u32);
            let mut motion = *physics.motion(id);
            upset(&mut motion, now, &mut stream);
            physics.commit(id, now, motion);
            physics.settle(now);
        }
    }
}
