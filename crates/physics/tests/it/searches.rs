//! Queries among many bodies that move, against a world that looks at all of them one by one.

use crate::queries::{NOW, fixed, pose, ray};
use crate::worlds::{ball, floating, in_space, on_ground, run, seconds, stream, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_physics::{
    BodyId, BodySpec, Contacts, Hit, Kind, Kinds, Mobility, Physics, Ray, Sees, Shape,
};
use simbeeotic_units::Attitude;
use simbeeotic_units::glam::{DQuat, DVec3};

/// Bodies of all kinds that move in a cube of 16 m about `centre`.
fn motley(stream: &mut Stream, count: u32, centre: DVec3, ground: bool) -> Physics {
    let mut physics = if ground {
        on_ground(surface(0.3, 0.7))
    } else {
        in_space()
    };
    for id in 0..count {
        let p = centre + DVec3::from_array([(); 3].map(|()| stream.uniform_in(-8.0..8.0)));
        let radius_m = stream.uniform_in(0.05..0.3);
        let half_m = DVec3::from_array([(); 3].map(|()| stream.uniform_in(0.1..0.9)));
        let (shape, mobility) = match id % 6 {
            0 => (Shape::Box { half_m }, Mobility::Fixed),
            1 => (Shape::Box { half_m }, Mobility::Driven),
            2 => (
                Shape::Cylinder {
                    radius_m,
                    half_height_m: half_m.x,
                },
                Mobility::Fixed,
            ),
            _ => (Shape::Sphere { radius_m }, Mobility::Free),
        };
        let contacts = [Contacts::None, Contacts::Detect, Contacts::Respond][(id / 6 % 3) as usize];
        let spec = BodySpec {
            p_enu: p,
            attitude: Attitude::from_unit_quat(turn(stream)),
            v_enu: stream.in_ball(3.0),
            w_flu: stream.in_ball(5.0),
            gravity: id % 5 == 0,
            contacts,
            mobility,
            inertia_kg_m2: DVec3::ONE,
            kind: Some(kind_of(id)),
            ..BodySpec::new(shape, 0.1)
        };
        physics.add(spec).unwrap();
    }
    physics
}

fn kind_of(id: u32) -> Kind {
    Kind::ALL[1 + id as usize % 7]
}

fn turn(stream: &mut Stream) -> DQuat {
    let axis = stream.unit_vector();
    let w = stream.uniform();
    DQuat::from_xyzw(axis.x, axis.y, axis.z, w).normalize()
}

/// The same bodies as they are at `t`, in a world that looks at them one by one.
fn still(physics: &Physics, t: SimTime, ground: bool) -> Physics {
    let mut copy = if ground {
        on_ground(surface(0.3, 0.7))
    } else {
        in_space()
    };
    for id in (0..physics.len() as u32).map(BodyId) {
        let state = physics.motion(id).at(t);
        let spec = fixed(
            physics.shape(id).clone(),
            state.p_enu,
            state.world_from_body,
        );
        copy.add(BodySpec {
            kind: Some(physics.kind(id)),
            ..spec
        })
        .unwrap();
    }
    copy
}

const COUNT: u32 = 300;

fn agree(a: Option<Hit>, b: Option<Hit>, tolerance: f64) -> bool {
    match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => {
            a.body == b.body
                && (a.distance_m - b.distance_m).abs() <= tolerance
                && a.point_enu.distance(b.point_enu) <= tolerance
                && a.normal_enu.distance(b.normal_enu) <= 1e3 * tolerance
        }
        _ => false,
    }
}

struct Question {
    ray: Ray,
    sees: Sees,
    shape: Shape,
}

fn questions(stream: &mut Stream, centre: DVec3) -> Vec<Question> {
    (0..60)
        .map(|k| Question {
            ray: ray(
                centre + stream.in_ball(12.0) + DVec3::Z * 2.0,
                stream.in_ball(1.0),
                stream.uniform_in(0.5..40.0),
            ),
            sees: Sees {
                kinds: match (k % 3, k % 5) {
                    (0, 0) => Kinds::of(&[Kind::Terrain, Kind::Structure, Kind::Person]),
                    (0, _) => Kinds::ALL.without(Kind::Obstacle).without(Kind::Flower),
                    (_, 0) => Kinds::ALL.without(Kind::Ground),
                    _ => Kinds::ALL,
                },
                but: (k % 2 == 0).then_some(BodyId(k)),
            },
            shape: if k % 2 == 0 {
                Shape::Sphere {
                    radius_m: stream.uniform_in(0.05..1.0),
                }
            } else {
                Shape::Box {
                    half_m: stream.in_ball(1.0).abs() + 0.05,
                }
            },
        })
        .collect()
}

/// Asks everything of both worlds.
fn compare(
    physics: &Physics,
    still: &Physics,
    t: SimTime,
    stream: &mut Stream,
    centre: DVec3,
) -> u32 {
    let tolerance = 1e-9 + 4e-15 * centre.length();
    let mut hits = 0;
    for Question { ray, sees, shape } in questions(stream, centre) {
        let found = physics.cast_ray(&ray, t, &sees).unwrap();
        let expected = still.cast_ray(&ray, NOW, &sees).unwrap();
        assert!(agree(found, expected, tolerance), "{found:?} {expected:?}");
        hits += u32::from(found.is_some());

        let at = pose(ray.origin_enu, turn(stream));
        let cast = |physics: &Physics, t: SimTime| {
            physics
                .cast_shape(&shape, at, ray.direction_enu, ray.range_m, t, &sees)
                .unwrap()
        };
        let (found, expected) = (cast(physics, t), cast(still, NOW));
        let same = match (found, expected) {
            (Some(a), Some(b)) => a.body == b.body && (a.distance_m - b.distance_m).abs() < 1e-6,
            (None, None) => true,
            _ => false,
        };
        assert!(same, "{found:?} {expected:?}");

        let overlaps = |physics: &Physics, t: SimTime| {
            let mut found = vec![BodyId(7)];
            physics.overlaps(&shape, at, t, &sees, &mut found).unwrap();
            found
        };
        assert_eq!(overlaps(physics, t), overlaps(still, NOW));
        let near = |physics: &Physics, t: SimTime| {
            let mut found = Vec::new();
            physics.near(ray.origin_enu, 0.2 * ray.range_m, t, &mut found);
            found
        };
        assert_eq!(near(physics, t), near(still, NOW));
    }
    hits
}

/// Flies the bodies by commands, jumps among them, and asks at many instants between listings.
fn fly_and_ask(centre: DVec3, ground: bool) {
    let mut stream = stream("queries");
    let mut physics = motley(&mut stream, COUNT, centre, ground);
    let mut hits = 0;
    for step in 1..=60_u64 {
        let t = SimTime::from_nanos(7_000_003 * step);
        run(&mut physics, t);
        for _ in 0..step % 4 {
            let id = BodyId(stream.below(u64::from(COUNT)) as u32);
            let mut motion = *physics.motion(id);
            match (motion.mobility(), step % 5) {
                (Mobility::Fixed, _) => continue,
                (_, 0) => motion.set_position(t, centre + stream.in_ball(8.0)),
                (Mobility::Free, 1) => motion.set_force(t, stream.in_ball(3.0)),
                (_, 2) => motion.set_rate(t, stream.in_ball(9.0)),
                _ => motion.set_velocity(t, stream.in_ball(20.0)),
            }
            .unwrap();
            physics.commit(id, t, motion);
        }
        // Before the changes are settled, after, and later while nothing happens.
        hits += compare(
            &physics,
            &still(&physics, t, ground),
            t,
            &mut stream,
            centre,
        );
        physics.settle(t);
        hits += compare(
            &physics,
            &still(&physics, t, ground),
            t,
            &mut stream,
            centre,
        );
        if let Some(next) = physics.next_time() {
            let later = SimTime::from_nanos(t.nanos().midpoint(next.nanos().max(t.nanos())));
            hits += compare(
                &physics,
                &still(&physics, later, ground),
                later,
                &mut stream,
                centre,
            );
        }
    }
    assert!(hits > 1000, "{hits} hits");
    let tally = physics.tally();
    assert!(tally.listings < 20 && tally.relistings > 10, "{tally:?}");
}

#[test]
fn a_query_finds_what_looking_at_all_bodies_finds() {
    fly_and_ask(DVec3::new(0.0, 0.0, 6.0), true);
}

#[test]
fn a_query_far_away_is_as_good() {
    fly_and_ask(DVec3::new(1e6, -1e6, 1e6), false);
}

#[test]
fn which_way_was_taken_does_not_show_to_the_last_bit() {
    let mut stream = stream("queries, two ways");
    let mut physics = motley(&mut stream, COUNT, DVec3::Z * 6.0, true);
    let t = seconds(0.33);
    run(&mut physics, t);
    let rays: Vec<Ray> = questions(&mut stream, DVec3::Z * 6.0)
        .iter()
        .map(|q| q.ray)
        .collect();
    let ask = |physics: &Physics| {
        let mut hits = Vec::new();
        physics
            .cast_rays(&rays, t, &Sees::default(), &mut hits)
            .unwrap();
        hits
    };
    let first = ask(&physics);
    for ray in &rays {
        let hit = physics.cast_ray(ray, t, &Sees::default()).unwrap();
        assert_eq!(hit, first[rays.iter().position(|r| r == ray).unwrap()]);
    }
    physics.settle(t);
    assert_eq!(ask(&physics), first);
    // A new body makes all lists void; far away it is not seen.
    physics.add(ball(DVec3::Z * 1e5)).unwrap();
    assert_eq!(ask(&physics), first);
    physics.settle(t);
    assert_eq!(ask(&physics), first);
}

#[test]
fn two_threads_at_once_see_the_same() {
    let mut stream = stream("queries, threads");
    let mut physics = motley(&mut stream, COUNT, DVec3::Z * 6.0, true);
    let t = seconds(0.25);
    run(&mut physics, t);
    let rays: Vec<Ray> = (0..50)
        .flat_map(|_| questions(&mut stream, DVec3::Z * 6.0))
        .map(|q| q.ray)
        .collect();
    let ask = || {
        let mut hits = Vec::new();
        physics
            .cast_rays(&rays, t, &Sees::default(), &mut hits)
            .unwrap();
        hits
    };
    let [a, b] = std::thread::scope(|scope| {
        [scope.spawn(ask), scope.spawn(ask)].map(|thread| thread.join().unwrap())
    });
    assert_eq!(a, b);
    assert_eq!(a, ask());
}

#[test]
fn bodies_that_touch_nobody_are_listed_once_somebody_looks() {
    let mut physics = in_space();
    let mut stream = stream("queries, unlisted");
    for _ in 0..200 {
        let spec = floating(stream.in_ball(10.0), stream.in_ball(1.0));
        physics
            .add(BodySpec {
                contacts: Contacts::None,
                ..spec
            })
            .unwrap();
    }
    run(&mut physics, seconds(1.0));
    let before = physics.tally().listings;
    let look = |physics: &Physics, t| {
        let ray = ray(DVec3::X * -20.0, DVec3::X, 40.0);
        physics.cast_ray(&ray, t, &Sees::default()).unwrap()
    };
    look(&physics, seconds(1.0));
    run(&mut physics, seconds(1.001));
    run(&mut physics, seconds(2.0));
    assert!(physics.tally().listings >= before + 9);
    let t = seconds(2.0);
    assert_eq!(look(&physics, t), look(&still(&physics, t, false), NOW));
}
