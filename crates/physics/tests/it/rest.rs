//! Rest under changing forces: a gust that moves nothing costs nothing, and one that does moves at once.

#![expect(
    clippy::disallowed_methods,
    reason = "a slope to lie on; compared with a tolerance"
)]

use crate::worlds::{G, ball, on_ground, run, seconds, stream, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Mobility, Motion, Physics, Shape};
use simbeeotic_units::Attitude;
use simbeeotic_units::glam::{DQuat, DVec3};

const FRICTION: f64 = 0.5;
/// The upper side of the deck, m.
const DECK_M: f64 = 1.0;

fn cube(half: f64, p_enu: DVec3) -> BodySpec {
    BodySpec {
        p_enu,
        material: surface(FRICTION, 0.0),
        ..BodySpec::new(
            Shape::Box {
                half_m: DVec3::splat(half),
            },
            1.0,
        )
    }
}

/// A deck of 4 m by 4 m, on the ground or held in the air by somebody.
fn deck(mobility: Mobility) -> BodySpec {
    let half_m = DVec3::new(2.0, 2.0, 0.5);
    BodySpec {
        p_enu: DVec3::Z * (DECK_M - 0.5),
        mobility,
        material: surface(FRICTION, 0.0),
        ..BodySpec::new(Shape::Box { half_m }, 1.0)
    }
}

/// A world with a deck, and what is dropped on it.
fn dropped(
    mobility: Mobility,
    specs: impl IntoIterator<Item = BodySpec>,
) -> (Physics, Vec<BodyId>) {
    let mut physics = on_ground(surface(FRICTION, 0.0));
    physics.add(deck(mobility)).unwrap();
    let ids = specs
        .into_iter()
        .map(|spec| physics.add(spec).unwrap())
        .collect();
    (physics, ids)
}

fn command(physics: &mut Physics, id: BodyId, t: SimTime, change: impl FnOnce(&mut Motion)) {
    let mut motion = *physics.motion(id);
    change(&mut motion);
    physics.commit(id, t, motion);
    physics.settle(t);
}

fn push(physics: &mut Physics, id: BodyId, t: SimTime, force: DVec3) {
    command(physics, id, t, |motion| motion.set_force(t, force).unwrap());
}

fn place(physics: &Physics, id: BodyId, t: SimTime) -> DVec3 {
    physics.motion(id).position(t)
}

/// Balls as on landing gear, boxes, and stacks of boxes: all that a gust of up to 2 m/s^2 does not move.
fn guests() -> Vec<BodySpec> {
    let mut guests = Vec::new();
    for i in 0..4 {
        let x = -1.5 + f64::from(i);
        let place = |y: f64, height: f64| DVec3::new(x, y, DECK_M + height);
        guests.push(BodySpec {
            material: surface(FRICTION, 0.0),
            ..ball(place(-1.0, 0.2))
        });
        guests.push(cube(0.05, place(0.0, 0.1)));
        guests.push(cube(0.1, place(1.0, 0.15)));
        guests.push(cube(0.1, place(1.0, 0.37)));
    }
    guests
}

/// Lets gusts blow from `from` to `to`, each on its own body at its own times.
fn gusts(physics: &mut Physics, ids: &[BodyId], [from, to]: [f64; 2], most: f64) {
    let mut stream = stream("gusts");
    let mut s = from;
    while s < to {
        for id in ids {
            s += 0.1 / ids.len() as f64;
            run(physics, seconds(s));
            let mass = physics.motion(*id).mass_kg();
            push(physics, *id, seconds(s), stream.in_ball(most) * mass);
        }
    }
}

#[test]
fn gusts_that_move_nothing_wake_nobody() {
    for (threads, mobility) in [(1, Mobility::Fixed), (2, Mobility::Driven)] {
        let (mut physics, ids) = dropped(mobility, guests());
        physics.set_threads(threads).unwrap();
        gusts(&mut physics, &ids, [0.0, 3.0], 2.0);
        let before = physics.tally();
        let t = seconds(3.0);
        let places: Vec<DVec3> = ids.iter().map(|id| place(&physics, *id, t)).collect();
        gusts(&mut physics, &ids, [3.0, 20.0], 2.0);
        let t = seconds(20.0);
        assert_eq!(physics.tally().steps, before.steps);
        assert_eq!(physics.tally().contacts, before.contacts);
        for (id, at) in ids.iter().zip(places) {
            assert_eq!(place(&physics, *id, t), at);
            assert!(
                physics.motion(*id).force() != DVec3::ZERO,
                "what acts is known"
            );
        }
    }
}

/// Negative control: gusts that friction does not hold.
#[test]
fn gusts_that_move_something_are_stepped() {
    let (mut physics, ids) = dropped(Mobility::Fixed, guests());
    gusts(&mut physics, &ids, [0.0, 3.0], 2.0);
    let before = physics.tally();
    gusts(&mut physics, &ids, [3.0, 4.0], 12.0);
    assert!(physics.tally().steps > before.steps + 100);
}

#[test]
fn a_wind_that_grows_past_friction_moves_at_that_change() {
    for spec in [
        cube(0.1, DVec3::new(0.0, 0.0, DECK_M + 0.15)),
        BodySpec {
            material: surface(FRICTION, 0.0),
            ..ball(DVec3::new(0.0, 0.0, DECK_M + 0.15))
        },
    ] {
        let mass = spec.mass_kg;
        let (mut physics, ids) = dropped(Mobility::Fixed, [spec]);
        run(&mut physics, seconds(2.0));
        let start = place(&physics, ids[0], seconds(2.0));
        for percent in 1..=110_u32 {
            let t = seconds(2.0 + 0.02 * f64::from(percent));
            run(&mut physics, t);
            if percent <= 100 {
                let moved = place(&physics, ids[0], t).distance(start);
                assert!(moved < 1e-4, "{moved} m at {percent} %");
            }
            let force = FRICTION * G * mass * f64::from(percent) / 100.0;
            push(&mut physics, ids[0], t, DVec3::X * force);
        }
        // From 101 % on: the excess over 10 changes, and the last from then on.
        let t = seconds(2.0 + 0.02 * 110.0 + 0.1);
        run(&mut physics, t);
        let excess = |percent: u32| 0.01 * f64::from(percent) * FRICTION * G;
        let gain: f64 = (1..10).map(|p| 0.02 * excess(p)).sum::<f64>() + 0.1 * excess(10);
        let v = physics.motion(ids[0]).velocity(t);
        assert!((v.x / gain - 1.0).abs() < 0.1, "{v} for {gain}");
    }
}

#[test]
fn whoever_pulls_more_than_its_weight_leaves_at_that_change() {
    let (mut physics, ids) = dropped(Mobility::Fixed, [cube(0.1, DVec3::Z * (DECK_M + 0.15))]);
    run(&mut physics, seconds(2.0));
    let steps = physics.tally().steps;
    for (s, share) in [(2.0, 0.5), (3.0, 0.99), (4.0, 1.1)] {
        let t = seconds(s);
        run(&mut physics, t);
        assert_eq!(physics.tally().steps, steps);
        push(&mut physics, ids[0], t, DVec3::Z * (share * G));
    }
    let start = place(&physics, ids[0], seconds(4.0)).z;
    run(&mut physics, seconds(5.0));
    let rise = place(&physics, ids[0], seconds(5.0)).z - start;
    assert!((rise - 0.05 * G).abs() < 0.01, "{rise}");
}

#[test]
fn a_torque_that_tips_a_box_tips_it_and_a_lesser_one_does_not() {
    let (mut physics, ids) = dropped(Mobility::Fixed, [cube(0.1, DVec3::Z * (DECK_M + 0.15))]);
    run(&mut physics, seconds(2.0));
    let twist = |physics: &mut Physics, s: f64, torque: f64| {
        let t = seconds(s);
        run(physics, t);
        command(physics, ids[0], t, |motion| {
            motion.set_torque(t, DVec3::Y * torque).unwrap();
        });
    };
    let steps = physics.tally().steps;
    twist(&mut physics, 2.0, 0.9 * 0.1 * G);
    twist(&mut physics, 3.0, -0.9 * 0.1 * G);
    twist(&mut physics, 4.0, 1.1 * 0.1 * G);
    assert_eq!(physics.tally().steps, steps);
    run(&mut physics, seconds(4.5));
    let up = physics.motion(ids[0]).attitude(seconds(4.5)) * DVec3::Z;
    assert!(up.z < 0.99, "{up}");
}

#[test]
fn who_rests_on_a_slope_slides_when_the_wind_helps_and_not_before() {
    let tilt = DQuat::from_rotation_y(20.0_f64.to_radians());
    let mut physics = on_ground(surface(FRICTION, 0.0));
    let slope = BodySpec {
        p_enu: DVec3::Z * 5.0,
        attitude: Attitude::from_unit_quat(tilt),
        ..deck(Mobility::Fixed)
    };
    physics.add(slope).unwrap();
    let id = physics
        .add(BodySpec {
            attitude: Attitude::from_unit_quat(tilt),
            ..cube(0.1, DVec3::Z * 5.0 + tilt * DVec3::Z * 0.601)
        })
        .unwrap();
    run(&mut physics, seconds(2.0));
    let steps = physics.tally().steps;
    // Along the slope: weight pulls with 0.342 of itself, friction holds 0.470.
    let down = tilt * DVec3::X;
    for (s, pull) in [(2.0, -0.5), (3.0, 0.09), (4.0, 0.16)] {
        run(&mut physics, seconds(s));
        assert_eq!(physics.tally().steps, steps, "{s}");
        push(&mut physics, id, seconds(s), down * (pull * G));
    }
    run(&mut physics, seconds(5.0));
    let v = physics.motion(id).velocity(seconds(5.0));
    assert!(v.dot(down) > 0.2, "{v}");
}

#[test]
fn who_loses_its_support_falls_under_what_acts_on_it_by_then() {
    let (mut physics, ids) = dropped(Mobility::Driven, [cube(0.1, DVec3::Z * (DECK_M + 0.15))]);
    run(&mut physics, seconds(2.0));
    let steps = physics.tally().steps;
    push(&mut physics, ids[0], seconds(2.0), DVec3::Z * (0.5 * G));
    run(&mut physics, seconds(3.0));
    assert_eq!(physics.tally().steps, steps);
    let start = place(&physics, ids[0], seconds(3.0)).z;
    let t = seconds(3.0);
    command(&mut physics, BodyId(0), t, |motion| {
        motion.set_position(t, DVec3::new(10.0, 0.0, 0.5)).unwrap();
    });
    run(&mut physics, seconds(3.4));
    let fall = start - place(&physics, ids[0], seconds(3.4)).z;
    assert!((fall - 0.25 * G * 0.16).abs() < 0.02, "{fall}");
}

#[test]
fn who_lies_on_one_that_is_pulled_away_falls() {
    let stack = [0.15, 0.37].map(|height| cube(0.1, DVec3::Z * (DECK_M + height)));
    let (mut physics, ids) = dropped(Mobility::Fixed, stack);
    gusts(&mut physics, &ids, [0.0, 3.0], 2.0);
    let before = place(&physics, ids[1], seconds(3.0)).z;
    assert!((before - DECK_M - 0.3).abs() < 2e-3, "{before}");
    let t = seconds(3.2);
    run(&mut physics, t);
    command(&mut physics, ids[0], t, |motion| {
        motion
            .set_position(t, DVec3::new(1.0, 0.0, DECK_M + 0.1))
            .unwrap();
    });
    run(&mut physics, seconds(5.0));
    let after = place(&physics, ids[1], seconds(5.0)).z;
    assert!((after - DECK_M - 0.1).abs() < 2e-3, "{after}");
}

/// Pushes each by `share` of its weight, at rest after 3 s; tells how far it has come in the next 10 s.
fn nudged(spec: BodySpec, share: f64) -> f64 {
    let mass = spec.mass_kg;
    let (mut physics, ids) = dropped(Mobility::Fixed, [spec]);
    let t = seconds(3.0);
    run(&mut physics, t);
    let start = place(&physics, ids[0], t);
    let steps = physics.tally().steps;
    push(&mut physics, ids[0], t, DVec3::X * (share * mass * G));
    let t = seconds(13.0);
    run(&mut physics, t);
    let way = place(&physics, ids[0], t) - start;
    assert_eq!(physics.tally().steps > steps, way != DVec3::ZERO);
    assert!(way.y.abs() < 1e-3 && way.z.abs() < 1e-3, "{way}");
    way.x
}

#[test]
fn whoever_nothing_holds_moves_under_a_push_of_a_two_thousandth_of_its_weight() {
    let at = DVec3::Z * (DECK_M + 0.1);
    let rolls = || BodySpec {
        rolls: true,
        material: surface(FRICTION, 0.0),
        ..ball(at)
    };
    let free = 0.5 * 5e-4 * G * 100.0;
    // A full ball that rolls has 5/7 of the acceleration.
    let way = nudged(rolls(), 5e-4);
    assert!((way / free - 5.0 / 7.0).abs() < 0.05, "{way} of {free}");
    let way = nudged(
        BodySpec {
            material: surface(0.0, 0.0),
            ..cube(0.1, at)
        },
        5e-4,
    );
    assert!((way / free - 1.0).abs() < 0.05, "{way} of {free}");
    // Negative controls: friction holds, or nothing pushes.
    let holds = BodySpec {
        material: surface(FRICTION, 0.0),
        ..ball(at)
    };
    assert_eq!(nudged(holds, 5e-4), 0.0);
    assert_eq!(nudged(cube(0.1, at), 5e-4), 0.0);
    assert_eq!(nudged(rolls(), 0.0), 0.0);
}
