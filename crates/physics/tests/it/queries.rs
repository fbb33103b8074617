//! Rays, moving shapes, overlaps and neighbours: closed forms, and all bodies one by one.

use crate::worlds::{ball, floating, in_space, on_ground, run, seconds, stream, surface};
use simbeeotic_kernel::{SimTime, rng::Stream};
use simbeeotic_physics::{
    BodyError, BodyId, BodySpec, Contacts, HeightField, Hit, Hull, Kind, Kinds, Mesh, Mobility,
    Part, Physics, Ray, Sees, Shape, group,
};
use simbeeotic_units::glam::{DQuat, DVec2, DVec3};
use simbeeotic_units::{Attitude, Pose, Position};
use std::sync::Arc;

const NOW: SimTime = SimTime::ZERO;

fn ray(origin_enu: DVec3, direction_enu: DVec3, range_m: f64) -> Ray {
    Ray {
        origin_enu,
        direction_enu,
        range_m,
    }
}

fn pose(p: DVec3, q: DQuat) -> Pose {
    Pose {
        position: Position::from_si(p),
        attitude: Attitude::from_unit_quat(q),
    }
}

fn fixed(shape: Shape, p: DVec3, q: DQuat) -> BodySpec {
    BodySpec {
        p_enu: p,
        attitude: Attitude::from_unit_quat(q),
        mobility: Mobility::Fixed,
        inertia_kg_m2: DVec3::ONE,
        ..BodySpec::new(shape, 1.0)
    }
}

/// Distance, point and normal of a hit on body 0.
fn on(shape: Shape, from: DVec3, direction: DVec3) -> Option<(f64, DVec3, DVec3)> {
    // The same at home, a thousand kilometres away, and turned.
    let turn = DQuat::from_xyzw(0.5, -0.5, 0.5, 0.5);
    let homes = [
        (DVec3::ZERO, DQuat::IDENTITY),
        (DVec3::new(1e6, -1e6, 1e3), DQuat::IDENTITY),
        (DVec3::new(3.0, 4.0, 5.0), turn),
    ];
    let hits = homes.map(|(home, turn)| {
        let mut physics = in_space();
        physics.add(fixed(shape.clone(), home, turn)).unwrap();
        run(&mut physics, seconds(0.01));
        let ray = ray(home + turn * from, turn * direction, 100.0);
        let hit = physics
            .cast_ray(&ray, seconds(0.01), &Sees::default())
            .unwrap();
        hit.map(|hit| {
            assert_eq!(hit.body, Some(BodyId(0)));
            let back = turn.conjugate();
            let point = back * (hit.point_enu - home);
            (hit.distance_m, point, back * hit.normal_enu)
        })
    });
    for other in &hits[1..] {
        match (hits[0], other) {
            (None, None) => {}
            (Some(a), Some(b)) => {
                assert!((a.0 - b.0).abs() < 2e-9, "{shape:?}: {a:?} {b:?}");
                assert!(a.1.distance(b.1) < 2e-9 && a.2.distance(b.2) < 2e-9);
            }
            differs => panic!("{shape:?}: {differs:?}"),
        }
    }
    hits[0]
}

fn meets(shape: &Shape, from: DVec3, direction: DVec3, distance: f64, normal: DVec3) {
    let (found, point, n) = on(shape.clone(), from, direction).expect("it is in the way");
    assert!((found - distance).abs() < 1e-12, "{shape:?}: {found}");
    let expected = from + direction.normalize() * distance;
    assert!(point.distance(expected) < 1e-12, "{shape:?}: {point}");
    assert!(n.distance(normal) < 1e-12, "{shape:?}: {n}");
}

#[test]
fn a_ray_meets_each_shape_where_geometry_says() {
    let (x, z) = (DVec3::X, DVec3::Z);
    let sphere = Shape::Sphere { radius_m: 0.5 };
    meets(&sphere, -3.0 * x, 7.0 * x, 2.5, -x);
    meets(
        &sphere,
        DVec3::new(-3.0, 0.3, 0.0),
        x,
        2.6,
        DVec3::new(-0.8, 0.6, 0.0),
    );
    assert_eq!(on(sphere, DVec3::new(-3.0, 0.51, 0.0), x), None);

    let half_m = DVec3::new(1.0, 2.0, 3.0);
    let block = Shape::Box { half_m };
    meets(&block, DVec3::new(-5.0, 1.5, -2.5), x, 4.0, -x);
    meets(&block, DVec3::new(0.5, 1.5, 9.0), -z, 6.0, z);
    let slanted = DVec3::new(3.0, 4.0, 0.0);
    meets(&block, DVec3::new(-4.0, -4.0, 1.0), slanted, 5.0, -x);

    let cylinder = Shape::Cylinder {
        radius_m: 0.5,
        half_height_m: 1.0,
    };
    meets(
        &cylinder,
        DVec3::new(-3.0, 0.3, 0.9),
        x,
        2.6,
        DVec3::new(-0.8, 0.6, 0.0),
    );
    meets(&cylinder, DVec3::new(0.3, 0.3, 4.0), -z, 3.0, z);
    assert_eq!(on(cylinder, DVec3::new(-3.0, 0.0, 1.1), x), None);

    // Base of 0.5 m at z = -1, tip at z = 1: at z = 0 it is 0.25 m wide.
    let cone = Shape::Cone {
        radius_m: 0.5,
        half_height_m: 1.0,
    };
    let flank = DVec3::new(-2.0, 0.0, 0.5).normalize();
    meets(&cone, -3.0 * x, x, 2.75, flank);
    meets(&cone, DVec3::new(0.2, 0.0, -4.0), z, 3.0, -z);

    let capsule = Shape::Capsule {
        radius_m: 0.5,
        half_height_m: 1.0,
    };
    meets(&capsule, DVec3::new(-3.0, 0.0, 0.9), x, 2.5, -x);
    meets(&capsule, 4.0 * z, -z, 2.5, z);
    meets(
        &capsule,
        DVec3::new(-3.0, 0.0, 1.3),
        x,
        2.6,
        DVec3::new(-0.8, 0.0, 0.6),
    );

    meets(
        &Shape::Plane,
        DVec3::new(1.0, 2.0, 3.0),
        DVec3::new(0.0, 0.8, -0.6),
        5.0,
        z,
    );
    assert_eq!(on(Shape::Plane, 3.0 * z, x), None);
}

#[test]
fn a_ray_meets_shapes_of_many_faces_where_geometry_says() {
    let z = DVec3::Z;
    let corners = [
        DVec3::ZERO,
        DVec3::new(2.0, 0.0, 0.0),
        DVec3::new(0.0, 2.0, 0.0),
        DVec3::new(0.0, 0.0, 2.0),
    ];
    let hull = Shape::Hull(Arc::new(Hull {
        points_m: corners.to_vec(),
    }));
    let slope = DVec3::ONE.normalize();
    meets(&hull, DVec3::new(0.5, 0.5, 5.0), -z, 4.0, slope);
    meets(&hull, DVec3::new(0.5, 0.5, -5.0), z, 5.0, -z);

    let mesh = Shape::Mesh(Arc::new(Mesh {
        points_m: corners.to_vec(),
        triangles: vec![[1, 2, 3]],
    }));
    meets(&mesh, DVec3::new(0.5, 0.5, 5.0), -z, 4.0, slope);
    assert_eq!(on(mesh, DVec3::new(1.5, 1.5, 5.0), -z), None);

    // A ridge along north: 1 m high in the middle, flat at both edges.
    let field = Shape::HeightField(Arc::new(HeightField {
        size_m: DVec2::new(4.0, 6.0),
        columns: 3,
        heights_m: [0.0, 1.0, 0.0].repeat(4),
    }));
    let east = DVec3::new(0.5, 0.0, 1.0).normalize();
    meets(&field, DVec3::new(1.0, 0.7, 5.0), -z, 4.5, east);
    meets(&field, DVec3::new(1.0, -2.9, 5.0), -z, 4.5, east);
    assert_eq!(on(field, DVec3::new(2.1, 0.0, 5.0), -z), None);

    let part = |x: f64, shape: Shape| Part {
        offset_m: DVec3::new(x, 0.0, 0.0),
        attitude: Attitude::default(),
        shape,
    };
    let pair = Shape::Compound(Arc::from([
        part(-2.0, Shape::Sphere { radius_m: 0.5 }),
        part(2.0, Shape::Sphere { radius_m: 0.5 }),
    ]));
    meets(&pair, DVec3::new(-2.0, 0.0, 5.0), -z, 4.5, z);
    meets(&pair, 9.0 * DVec3::X, -DVec3::X, 6.5, DVec3::X);
    assert_eq!(on(pair, 5.0 * z, -z), None);
}

#[test]
fn the_ground_is_seen_from_above_if_there_is_one() {
    let down = ray(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.8, -0.6), 5.0);
    let sees = Sees::default();
    let physics = on_ground(surface(0.5, 0.0));
    let hit = physics.cast_ray(&down, NOW, &sees).unwrap().unwrap();
    assert_eq!((hit.body, hit.normal_enu), (None, DVec3::Z));
    assert!((hit.distance_m - 5.0).abs() < 1e-15);
    assert!(hit.point_enu.distance(DVec3::new(1.0, 6.0, 0.0)) < 1e-12);
    assert_eq!(hit.point_enu.z, 0.0);

    let cases = [
        (
            Ray {
                range_m: 4.99,
                ..down
            },
            sees,
        ),
        (
            Ray {
                direction_enu: DVec3::X,
                ..down
            },
            sees,
        ),
        (
            Ray {
                origin_enu: -down.origin_enu,
                ..down
            },
            sees,
        ),
        (
            down,
            Sees {
                kinds: Kinds::ALL.without(Kind::Ground),
                ..sees
            },
        ),
    ];
    for (ray, sees) in cases {
        assert_eq!(physics.cast_ray(&ray, NOW, &sees), Ok(None), "{ray:?}");
    }
    assert_eq!(in_space().cast_ray(&down, NOW, &sees), Ok(None));
}

#[test]
fn what_a_ray_begins_in_it_does_not_see() {
    let mut physics = in_space();
    let own = physics.add(floating(DVec3::ZERO, DVec3::ZERO)).unwrap();
    let half_m = DVec3::splat(0.5);
    let inner = fixed(Shape::Box { half_m }, DVec3::ZERO, DQuat::IDENTITY);
    physics.add(inner).unwrap();
    let other = physics
        .add(floating(DVec3::new(3.0, 0.0, 0.0), DVec3::ZERO))
        .unwrap();
    run(&mut physics, seconds(0.01));
    let hit = |from: f64, but: Option<BodyId>| {
        let sees = Sees {
            but,
            ..Sees::default()
        };
        let ray = ray(DVec3::X * from, DVec3::X, 10.0);
        let hit = physics.cast_ray(&ray, seconds(0.01), &sees).unwrap();
        hit.map(|hit| (hit.body.unwrap(), (hit.distance_m * 1e6).round() as u32))
    };
    assert_eq!(hit(0.05, None), Some((other, 2_850_000)));
    assert_eq!(hit(0.3, None), Some((other, 2_600_000)));
    assert_eq!(hit(-0.3, None), Some((own, 200_000)));
    assert_eq!(hit(-0.3, Some(own)), Some((other, 3_200_000)));
    assert_eq!(hit(0.3, Some(other)), None);
}

#[test]
fn kinds_that_are_not_looked_for_are_not_seen_whatever_their_groups_and_contacts() {
    let mut physics = in_space();
    for (k, kind) in [Kind::Vehicle, Kind::Flower, Kind::Station, Kind::Person]
        .into_iter()
        .enumerate()
    {
        let p = DVec3::X * (1.0 + k as f64);
        let body = BodySpec {
            group: group::NONE,
            mask: group::NONE,
            contacts: Contacts::None,
            kind: Some(kind),
            ..floating(p, DVec3::ZERO)
        };
        let id = physics.add(body).unwrap();
        assert_eq!(physics.kind(id), kind);
    }
    let seen = |kinds: &[Kind]| {
        let ray = ray(DVec3::ZERO, DVec3::X, 10.0);
        let sees = Sees {
            kinds: Kinds::of(kinds),
            ..Sees::default()
        };
        physics
            .cast_ray(&ray, NOW, &sees)
            .unwrap()
            .map(|hit| hit.body.unwrap().0)
    };
    assert_eq!(seen(&Kind::ALL), Some(0));
    assert_eq!(seen(&[Kind::Flower]), Some(1));
    assert_eq!(seen(&[Kind::Station, Kind::Flower]), Some(1));
    assert_eq!(seen(&[Kind::Station]), Some(2));
    assert_eq!(seen(&[Kind::Person]), Some(3));
    assert_eq!(seen(&[Kind::Terrain, Kind::Obstacle, Kind::Ghost]), None);
    assert_eq!(seen(&[]), None);
}

#[test]
fn what_is_driven_is_a_ghost_and_all_else_a_vehicle_unless_it_says_otherwise() {
    let body = |mobility: Mobility, kind: Option<Kind>| BodySpec {
        mobility,
        kind,
        ..BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 0.1)
    };
    assert_eq!(body(Mobility::Free, None).kind(), Kind::Vehicle);
    assert_eq!(body(Mobility::Fixed, None).kind(), Kind::Vehicle);
    assert_eq!(body(Mobility::Driven, None).kind(), Kind::Ghost);
    let person = body(Mobility::Driven, Some(Kind::Person));
    assert_eq!(person.kind(), Kind::Person);
}

#[test]
fn of_two_at_one_distance_the_first_counts_and_the_ground_last() {
    let mut physics = on_ground(surface(0.5, 0.0));
    let half_m = DVec3::new(1.0, 1.0, 0.5);
    for shape in [Shape::Plane, Shape::Box { half_m }, Shape::Box { half_m }] {
        let p = if shape == Shape::Plane {
            DVec3::ZERO
        } else {
            DVec3::Z * -0.5
        };
        physics.add(fixed(shape, p, DQuat::IDENTITY)).unwrap();
    }
    run(&mut physics, seconds(0.01));
    let down = ray(DVec3::Z * 2.0, -DVec3::Z, 2.0);
    for (but, body) in [(None, Some(0)), (Some(0), Some(1))] {
        let sees = Sees {
            but: but.map(BodyId),
            ..Sees::default()
        };
        let hit = physics
            .cast_ray(&down, seconds(0.01), &sees)
            .unwrap()
            .unwrap();
        assert_eq!((hit.body.map(|id| id.0), hit.distance_m), (body, 2.0));
    }
    let none = Sees {
        kinds: Kinds::of(&[Kind::Ground]),
        ..Sees::default()
    };
    assert_eq!(
        physics.cast_ray(&down, NOW, &none).unwrap().unwrap().body,
        None
    );
}

#[test]
fn what_cannot_be_looked_for_is_refused() {
    let physics = in_space();
    let good = ray(DVec3::ZERO, DVec3::X, 1.0);
    let sees = Sees::default();
    let bad = [
        Ray {
            origin_enu: DVec3::NAN,
            ..good
        },
        Ray {
            origin_enu: DVec3::X * 2e9,
            ..good
        },
        Ray {
            direction_enu: DVec3::ZERO,
            ..good
        },
        Ray {
            direction_enu: DVec3::new(0.0, f64::INFINITY, 0.0),
            ..good
        },
        Ray {
            range_m: 0.0,
            ..good
        },
        Ray {
            range_m: f64::NAN,
            ..good
        },
        Ray {
            range_m: 1e10,
            ..good
        },
    ];
    let mut hits = vec![None; 2];
    for ray in bad {
        let error = physics
            .cast_ray(&ray, NOW, &sees)
            .expect_err("it makes no sense");
        let batch = physics.cast_rays(&[good, ray], NOW, &sees, &mut hits);
        assert_eq!(batch.unwrap_err().to_string(), error.to_string());
        assert_eq!(hits.len(), 2);
    }
    for direction_enu in [DVec3::X * 1e300, DVec3::X * 1e-300, DVec3::X * 1e-310] {
        assert_eq!(
            physics.cast_ray(
                &Ray {
                    direction_enu,
                    ..good
                },
                NOW,
                &sees
            ),
            Ok(None)
        );
    }

    let here = pose(DVec3::ZERO, DQuat::IDENTITY);
    let sphere = Shape::Sphere { radius_m: 1.0 };
    let cast = |shape: &Shape, at: Pose, range: f64| {
        physics.cast_shape(shape, at, DVec3::X, range, NOW, &sees)
    };
    assert_eq!(cast(&sphere, here, 1.0), Ok(None));
    assert!(cast(&sphere, here, -1.0).is_err());
    assert!(cast(&sphere, pose(DVec3::NAN, DQuat::IDENTITY), 1.0).is_err());
    assert!(cast(&Shape::Sphere { radius_m: -1.0 }, here, 1.0).is_err());
    let plane = cast(&Shape::Plane, here, 1.0);
    assert!(
        matches!(plane, Err(BodyError::ShapeMoves { .. })),
        "{plane:?}"
    );
    let mut found = Vec::new();
    assert!(
        physics
            .overlaps(&Shape::Plane, here, NOW, &sees, &mut found)
            .is_err()
    );
}

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

#[test]
fn a_ball_that_moves_meets_what_a_ray_meets_that_is_as_thick() {
    let mut physics = on_ground(surface(0.5, 0.0));
    physics
        .add(fixed(
            Shape::Sphere { radius_m: 0.5 },
            DVec3::Z * 5.0,
            DQuat::IDENTITY,
        ))
        .unwrap();
    let half_m = DVec3::new(0.5, 2.0, 2.0);
    physics
        .add(fixed(
            Shape::Box { half_m },
            DVec3::new(8.0, 0.0, 5.0),
            DQuat::IDENTITY,
        ))
        .unwrap();
    run(&mut physics, seconds(0.01));
    let cast = |p: DVec3, direction: DVec3| {
        let sphere = Shape::Sphere { radius_m: 0.5 };
        let at = pose(p, DQuat::IDENTITY);
        let hit = physics.cast_shape(
            &sphere,
            at,
            direction,
            20.0,
            seconds(0.01),
            &Sees::default(),
        );
        hit.unwrap().map(|hit| (hit.body.map(|id| id.0), hit))
    };
    let near = |a: DVec3, b: DVec3| a.distance(b) < 1e-6;

    let (body, hit) = cast(DVec3::new(-5.0, 0.6, 5.0), DVec3::X).unwrap();
    assert_eq!(body, Some(0));
    assert!((hit.distance_m - 4.2).abs() < 1e-6);
    assert!(near(hit.normal_enu, DVec3::new(-0.8, 0.6, 0.0)));
    assert!(near(hit.point_enu, DVec3::new(-0.4, 0.3, 5.0)));

    let (body, hit) = cast(DVec3::new(2.0, 0.0, 5.0), DVec3::X).unwrap();
    assert_eq!(body, Some(1));
    assert!((hit.distance_m - 5.0).abs() < 1e-6 && near(hit.normal_enu, -DVec3::X));

    let (body, hit) = cast(DVec3::new(20.0, 0.0, 3.5), DVec3::new(0.8, 0.0, -0.6)).unwrap();
    assert_eq!(body, None);
    assert!((hit.distance_m - 5.0).abs() < 1e-9 && hit.normal_enu == DVec3::Z);
    assert!(near(hit.point_enu, DVec3::new(24.0, 0.0, 0.0)));

    // What overlaps at the start is met at once.
    let (body, hit) = cast(DVec3::new(0.5, 0.0, 5.0), DVec3::X).unwrap();
    assert_eq!((body, hit.distance_m), (Some(0), 0.0));
    assert_eq!(cast(DVec3::new(-5.0, 1.1, 5.0), DVec3::Y), None);
}
