//! Rays, moving shapes and what is refused, against closed forms.

use crate::worlds::{floating, in_space, on_ground, run, seconds, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{
    BodyError, BodyId, BodySpec, Contacts, HeightField, Hull, Kind, Kinds, Mesh, Mobility, Part,
    Ray, Sees, Shape, group,
};
use simbeeotic_units::glam::{DQuat, DVec2, DVec3};
use simbeeotic_units::{Attitude, Pose, Position};
use std::sync::Arc;

pub(crate) const NOW: SimTime = SimTime::ZERO;

pub(crate) fn ray(origin_enu: DVec3, direction_enu: DVec3, range_m: f64) -> Ray {
    Ray {
        origin_enu,
        direction_enu,
        range_m,
    }
}

pub(crate) fn pose(p: DVec3, q: DQuat) -> Pose {
    Pose {
        position: Position::from_si(p),
        attitude: Attitude::from_unit_quat(q),
    }
}

pub(crate) fn fixed(shape: Shape, p: DVec3, q: DQuat) -> BodySpec {
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
