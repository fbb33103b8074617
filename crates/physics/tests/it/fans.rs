//! Many rays at once find what each finds alone, to the last bit.

use crate::worlds::{floating, in_space, on_ground, run, seconds, stream, surface};
use simbeeotic_kernel::{SimTime, rng::Stream};
use simbeeotic_physics::{
    BodyId, BodySpec, Contacts, Fan, HeightField, Hit, Hull, Kind, Kinds, Mesh, Mobility, Part,
    Physics, Ray, Sees, Shape,
};
use simbeeotic_units::Attitude;
use simbeeotic_units::glam::{DQuat, DVec2, DVec3};
use std::sync::Arc;

fn turn(stream: &mut Stream) -> DQuat {
    let axis = stream.unit_vector();
    DQuat::from_xyzw(axis.x, axis.y, axis.z, stream.uniform()).normalize()
}

fn shape(which: u32, stream: &mut Stream) -> Shape {
    let radius_m = stream.uniform_in(0.05..0.6);
    let half_height_m = stream.uniform_in(0.1..0.9);
    let half_m = DVec3::new(radius_m, half_height_m, stream.uniform_in(0.05..1.5));
    let corners = |stream: &mut Stream, n: usize| (0..n).map(|_| stream.in_ball(0.8)).collect();
    match which % 9 {
        0 => Shape::Sphere { radius_m },
        1 | 2 => Shape::Box { half_m },
        3 => Shape::Cylinder {
            radius_m,
            half_height_m,
        },
        4 => Shape::Cone {
            radius_m,
            half_height_m,
        },
        5 => Shape::Capsule {
            radius_m,
            half_height_m,
        },
        6 => Shape::Hull(Arc::new(Hull {
            points_m: corners(stream, 9),
        })),
        7 => Shape::Mesh(Arc::new(Mesh {
            points_m: corners(stream, 6),
            triangles: vec![[0, 1, 2], [2, 3, 4], [4, 5, 0], [1, 3, 5]],
        })),
        _ => {
            let part = |stream: &mut Stream| Part {
                offset_m: stream.in_ball(0.5),
                attitude: Attitude::from_unit_quat(turn(stream)),
                shape: Shape::Box {
                    half_m: half_m * 0.5,
                },
            };
            Shape::Compound([part(stream), part(stream)].into())
        }
    }
}

/// Fixed, driven and free bodies of every shape in a cube of 20 m about `centre`.
fn crowd(stream: &mut Stream, count: u32, centre: DVec3, ground: bool) -> Physics {
    let mut physics = if ground {
        on_ground(surface(0.3, 0.7))
    } else {
        in_space()
    };
    for id in 0..count {
        let mobility = match id % 3 {
            0 => Mobility::Free,
            1 => Mobility::Driven,
            _ => Mobility::Fixed,
        };
        let shape = match mobility {
            // Those of many points would have to be centred.
            Mobility::Free => shape(if id % 2 == 0 { 0 } else { 1 + id % 3 }, stream),
            _ => shape(id / 3, stream),
        };
        let place = DVec3::from_array([(); 3].map(|()| stream.uniform_in(-10.0..10.0)));
        let spec = BodySpec {
            p_enu: centre + place,
            attitude: Attitude::from_unit_quat(turn(stream)),
            v_enu: stream.in_ball(3.0),
            w_flu: stream.in_ball(5.0),
            gravity: false,
            mobility,
            contacts: if id % 20 == 0 {
                Contacts::Respond
            } else {
                Contacts::None
            },
            inertia_kg_m2: DVec3::ONE,
            kind: Some(Kind::ALL[1 + id as usize % 8]),
            ..BodySpec::new(shape, 0.1)
        };
        physics.add(spec).unwrap();
    }
    if ground {
        let field = Shape::HeightField(Arc::new(HeightField {
            size_m: DVec2::splat(12.0),
            columns: 7,
            heights_m: (0..49).map(|_| stream.uniform()).collect(),
        }));
        let below = BodySpec {
            p_enu: centre - DVec3::Z * 8.0,
            inertia_kg_m2: DVec3::ONE,
            mobility: Mobility::Fixed,
            ..BodySpec::new(field, 1.0)
        };
        physics.add(below).unwrap();
        let slope = BodySpec {
            shape: Shape::Plane,
            attitude: Attitude::from_unit_quat(DQuat::from_xyzw(0.15, 0.0, 0.0, 1.0).normalize()),
            p_enu: centre - DVec3::Z * 12.0,
            inertia_kg_m2: DVec3::ONE,
            mobility: Mobility::Fixed,
            ..BodySpec::new(Shape::Sphere { radius_m: 1.0 }, 1.0)
        };
        physics.add(slope).unwrap();
    }
    physics
}

/// A pinhole's grid of rays: `half` is the tangent of half its width. Not all are of unit length.
fn grid(axes: DQuat, columns: usize, rows: usize, half: f64) -> Vec<DVec3> {
    let pixel = |k: usize| {
        let [column, row] = [k % columns, k / columns].map(|n| n as f64 + 0.5);
        let right = half * (2.0 * column / columns as f64 - 1.0);
        let down = half * (2.0 * row - rows as f64) / columns as f64;
        axes * DVec3::new(1.0, -right, -down)
    };
    (0..columns * rows).map(pixel).collect()
}

fn bits(hit: Option<Hit>) -> Option<[u64; 8]> {
    hit.map(|hit| {
        let [p, n] = [hit.point_enu, hit.normal_enu];
        let body = hit.body.map_or(-1.0, |body| f64::from(body.0));
        [body, hit.distance_m, p.x, p.y, p.z, n.x, n.y, n.z].map(f64::to_bits)
    })
}

/// Asks a fan, a list and ray by ray, and compares all bits; tells how many were met.
fn compare(physics: &Physics, fan: &Fan<'_>, t: SimTime, sees: &Sees) -> usize {
    let rays: Vec<Ray> = fan
        .directions_enu
        .iter()
        .map(|direction| Ray {
            origin_enu: fan.origin_enu,
            direction_enu: *direction,
            range_m: fan.range_m,
        })
        .collect();
    let mut hits = vec![None];
    physics.cast_fan(fan, t, sees, &mut hits).unwrap();
    let mut listed = vec![None];
    physics.cast_rays(&rays, t, sees, &mut listed).unwrap();
    assert_eq!(hits.len(), 1 + rays.len());
    for ((ray, hit), other) in rays.iter().zip(&hits[1..]).zip(&listed[1..]) {
        let alone = physics.cast_ray(ray, t, sees).unwrap();
        assert_eq!(bits(*hit), bits(alone), "{ray:?}");
        assert_eq!(bits(*other), bits(alone), "{ray:?}");
    }
    hits.iter().flatten().count()
}

fn look_around(centre: DVec3, ground: bool) {
    let mut stream = stream("fans");
    let mut physics = crowd(&mut stream, 400, centre, ground);
    let (mut met, mut asked) = (0, 0);
    for step in 1..=12_u64 {
        let t = SimTime::from_nanos(27_000_003 * step);
        run(&mut physics, t);
        let half = [0.02, 0.3, 1.0, 4.0][step as usize % 4];
        let axes = match step % 3 {
            // Along an axis: many directions have zeros in them.
            0 => DQuat::IDENTITY,
            1 => DQuat::from_xyzw(0.0, 0.2, 0.25, 1.0).normalize(),
            _ => turn(&mut stream),
        };
        let directions = grid(axes, 37, 13, half);
        let sees = Sees {
            kinds: if step % 4 == 1 {
                Kinds::ALL.without(Kind::Ground).without(Kind::Person)
            } else {
                Kinds::ALL
            },
            but: (step % 2 == 0).then_some(BodyId(step as u32)),
        };
        // Among them, from far away, and from the middle of one of them.
        let body = physics.motion(BodyId(7)).position(t);
        for origin_enu in [
            centre + stream.in_ball(8.0),
            centre - axes * DVec3::X * 40.0,
            body,
        ] {
            let range_m = stream.uniform_in(3.0..90.0);
            for columns in [37, 5, 1000] {
                let fan = Fan {
                    origin_enu,
                    directions_enu: &directions,
                    columns,
                    range_m,
                };
                met += compare(&physics, &fan, t, &sees);
                asked += directions.len();
            }
        }
    }
    assert!(met > asked / 20 && met < asked, "{met} of {asked}");
}

#[test]
fn a_fan_finds_what_its_rays_find_one_by_one() {
    look_around(DVec3::new(0.0, 0.0, 12.5), true);
}

#[test]
fn a_fan_far_from_the_origin_is_as_good() {
    look_around(DVec3::new(1e6, -1e6, 1e6), false);
}

#[test]
fn a_fan_of_rays_that_go_anywhere_finds_the_same() {
    let mut stream = stream("fans, anywhere");
    let mut physics = crowd(&mut stream, 200, DVec3::Z * 12.0, true);
    let t = seconds(0.3);
    run(&mut physics, t);
    let directions: Vec<_> = (0..300).map(|_| stream.in_ball(3.0)).collect();
    let fan = Fan {
        origin_enu: DVec3::Z * 11.0,
        directions_enu: &directions,
        columns: 20,
        range_m: 50.0,
    };
    assert!(compare(&physics, &fan, t, &Sees::default()) > 100);
    // Nothing is known about an instant so far ahead: all bodies are looked at.
    compare(&physics, &fan, seconds(9.0), &Sees::default());
    // A body that is not listed yet.
    physics.add(floating(DVec3::Z * 9.0, DVec3::ZERO)).unwrap();
    compare(&physics, &fan, t, &Sees::default());
}

#[test]
fn a_fan_that_is_none_is_refused_and_changes_nothing() {
    let physics = on_ground(surface(0.5, 0.0));
    let good = [-DVec3::Z, DVec3::X];
    let fan = Fan {
        origin_enu: DVec3::Z,
        directions_enu: &good,
        columns: 2,
        range_m: 10.0,
    };
    let mut hits = Vec::new();
    let mut refused = |fan: Fan<'_>| {
        let answer = physics.cast_fan(&fan, seconds(0.0), &Sees::default(), &mut hits);
        assert!(hits.is_empty() || answer.is_ok());
        answer.is_err()
    };
    assert!(refused(Fan { columns: 0, ..fan }));
    for range_m in [0.0, -1.0, f64::NAN, f64::INFINITY, 2e9] {
        assert!(refused(Fan { range_m, ..fan }), "{range_m}");
    }
    for bad in [DVec3::ZERO, DVec3::NAN, DVec3::X * f64::INFINITY] {
        let directions_enu = &[DVec3::X, bad];
        assert!(refused(Fan {
            directions_enu,
            ..fan
        }));
    }
    assert!(refused(Fan {
        origin_enu: DVec3::NAN,
        ..fan
    }));
    let none = Fan {
        directions_enu: &[],
        ..fan
    };
    assert!(!refused(none));
    assert!(!refused(fan));
    assert_eq!(hits.len(), 2);
    assert!(hits[0].is_some() && hits[1].is_none());
}
