//! What must not show: list periods, split runs, bodies far away, numbering, who asks in between.

use crate::worlds::{ball, direction, fingerprint, listed_every, run, stream, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Contact, Physics};
use simbeeotic_units::glam::DVec3;

const COUNT: u32 = 120;

fn specs() -> Vec<BodySpec> {
    let mut stream = stream("invariance");
    let mut specs: Vec<BodySpec> = Vec::new();
    while specs.len() < COUNT as usize {
        let [x, y, z] = [(); 3].map(|()| stream.uniform_in(0.12..3.0));
        let p = DVec3::new(x, y, z);
        if specs.iter().all(|s| s.p_enu.distance(p) > 0.21) {
            let v = direction(&mut stream) * 2.0;
            specs.push(BodySpec {
                v_enu: v,
                material: surface(0.3, 0.7),
                ..ball(p)
            });
        }
    }
    specs
}

/// Flies the bodies `ids` by commands that depend on their place in `ids` only, from time to time.
fn fly(
    physics: &mut Physics,
    ids: &[BodyId],
    steps: u64,
    mut between: impl FnMut(&mut Physics, SimTime),
) -> Vec<Contact> {
    let mut stream = stream("invariance commands");
    let mut contacts = Vec::new();
    for step in 0..steps {
        let t = SimTime::from_nanos(7_000_003 * (step + 1));
        between(physics, t);
        contacts.extend(run(physics, t));
        let id = ids[(step * 37 % u64::from(COUNT)) as usize];
        let mut motion = *physics.motion(id);
        motion
            .set_force(t, stream.in_ball(1.0) + DVec3::Z * 0.9)
            .unwrap();
        motion.set_rate(t, stream.in_ball(3.0)).unwrap();
        physics.commit(id, t, motion);
        physics.settle(t);
    }
    contacts
}

fn end(steps: u64) -> SimTime {
    SimTime::from_nanos(7_000_003 * steps)
}

fn reference() -> (Vec<Contact>, u64) {
    let mut physics = listed_every(Some(surface(0.3, 0.7)), 0.1);
    let ids: Vec<BodyId> = specs()
        .into_iter()
        .map(|s| physics.add(s).unwrap())
        .collect();
    let contacts = fly(&mut physics, &ids, 500, |_, _| {});
    (contacts, fingerprint(&physics, 0..COUNT, end(500)))
}

#[test]
fn the_list_period_does_not_show() {
    let expected = reference();
    assert!(expected.0.len() > 300, "{} contacts", expected.0.len());
    for period in [0.003, 0.0217, 0.05, 0.7, 10.0] {
        let mut physics = listed_every(Some(surface(0.3, 0.7)), period);
        let ids: Vec<BodyId> = specs()
            .into_iter()
            .map(|s| physics.add(s).unwrap())
            .collect();
        let contacts = fly(&mut physics, &ids, 500, |_, _| {});
        assert_eq!(contacts, expected.0, "list period {period} s");
        assert_eq!(fingerprint(&physics, 0..COUNT, end(500)), expected.1);
    }
}

#[test]
fn bodies_far_away_do_not_show() {
    let expected = reference();
    let mut physics = listed_every(Some(surface(0.3, 0.7)), 0.1);
    let ids: Vec<BodyId> = specs()
        .into_iter()
        .map(|s| physics.add(s).unwrap())
        .collect();
    let mut stream = stream("far");
    for _ in 0..50 {
        let p = DVec3::new(10_000.0, 0.0, 20.0) + stream.in_ball(5.0);
        physics
            .add(BodySpec {
                v_enu: DVec3::new(50.0, 0.0, 0.0),
                ..ball(p)
            })
            .unwrap();
    }
    let contacts = fly(&mut physics, &ids, 500, |_, _| {});
    let ours: Vec<Contact> = contacts.into_iter().filter(|c| c.a.0 < COUNT).collect();
    assert_eq!(ours, expected.0);
    assert_eq!(fingerprint(&physics, 0..COUNT, end(500)), expected.1);
}

#[test]
fn numbers_do_not_show_beyond_their_order() {
    let (expected, fingerprint_expected) = reference();
    let mut physics = listed_every(Some(surface(0.3, 0.7)), 0.1);
    let mut ids = Vec::new();
    let mut place = Vec::new();
    for spec in specs() {
        // Somebody else in between, far away.
        let p = DVec3::new(0.0, -5000.0 - 3.0 * ids.len() as f64, 50.0);
        physics.add(ball(p)).unwrap();
        place.push(physics.len() as u32);
        ids.push(physics.add(spec).unwrap());
    }
    let contacts = fly(&mut physics, &ids, 500, |_, _| {});
    let renumber = |id: BodyId| {
        place
            .iter()
            .position(|p| *p == id.0)
            .map(|p| BodyId(p as u32))
    };
    let ours: Vec<Contact> = contacts
        .into_iter()
        .filter_map(|c| {
            Some(Contact {
                a: renumber(c.a)?,
                b: c.b.map(|b| renumber(b).unwrap()),
                ..c
            })
        })
        .collect();
    assert_eq!(ours, expected);
    let mut again = listed_every(None, 0.1);
    for id in ids {
        let copy = again.add(ball(DVec3::ZERO)).unwrap();
        again.commit(copy, end(500), *physics.motion(id));
    }
    assert_eq!(
        fingerprint(&again, 0..COUNT, end(500)),
        fingerprint_expected
    );
}

#[test]
fn whoever_asks_in_between_does_not_show() {
    let expected = reference();
    let mut physics = listed_every(Some(surface(0.3, 0.7)), 0.1);
    let ids: Vec<BodyId> = specs()
        .into_iter()
        .map(|s| physics.add(s).unwrap())
        .collect();
    let mut stream = stream("asking");
    let mut contacts = Vec::new();
    let more = fly(&mut physics, &ids, 500, |physics, t| {
        // Instants at which nobody commands anything, and questions.
        let before = SimTime::from_nanos(t.nanos() - stream.below(7_000_000));
        contacts.extend(run(physics, before));
        let _ = physics.motion(BodyId(3)).at(t);
        physics.near(DVec3::ONE, 1.0, before, &mut Vec::new());
    });
    contacts.extend(more);
    contacts.sort_by_key(|c| (c.time, c.a, c.b));
    let mut sorted = expected.0;
    sorted.sort_by_key(|c| (c.time, c.a, c.b));
    assert_eq!(contacts, sorted);
    assert_eq!(fingerprint(&physics, 0..COUNT, end(500)), expected.1);
}

#[test]
fn the_fingerprint_can_differ() {
    let mut physics = listed_every(Some(surface(0.3, 0.7)), 0.1);
    let ids: Vec<BodyId> = specs()
        .into_iter()
        .enumerate()
        .map(|(k, s)| {
            let nudge = DVec3::X * if k == 60 { 1e-12 } else { 0.0 };
            physics
                .add(BodySpec {
                    p_enu: s.p_enu + nudge,
                    ..s
                })
                .unwrap()
        })
        .collect();
    fly(&mut physics, &ids, 500, |_, _| {});
    assert_ne!(fingerprint(&physics, 0..COUNT, end(500)), reference().1);
}

/// Debug or release, whatever the machine: if physics is changed on purpose, so is this word.
#[test]
fn the_bits_are_the_same_in_every_build() {
    let (contacts, word) = reference();
    assert_eq!((contacts.len(), word), (406, 0x3362_e3d9_70ab_e33e));
}

#[test]
fn who_does_not_settle_gets_past_the_instants_at_which_lists_are_made_anew() {
    let world = || {
        let mut physics = crate::worlds::in_space();
        for (x, speed) in [(-2.0, 1.0), (2.0, -1.0)] {
            let (p, v) = (DVec3::new(x, 0.0, 0.0), DVec3::new(speed, 0.0, 0.0));
            physics.add(crate::worlds::floating(p, v)).unwrap();
        }
        physics
    };
    let until = crate::worlds::seconds(3.0);
    let settled = crate::worlds::run(&mut world(), until);
    let (mut physics, mut contacts) = (world(), Vec::new());
    for _ in 0..1000 {
        match physics.next_time().filter(|next| *next <= until) {
            Some(next) => physics.advance(next, &mut contacts),
            None => break,
        }
    }
    assert!(physics.next_time().is_none_or(|next| next > until));
    assert_eq!(contacts.len(), 1);
    assert_eq!(contacts[0].time, settled[0].time);
}
