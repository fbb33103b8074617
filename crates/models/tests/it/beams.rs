//! Where sensors look is what their parameters say.

use simbeeotic_model::Beams;
use simbeeotic_model::config::{Node, Span, Value};
use simbeeotic_model::registry::{self, Kind, Make};
use simbeeotic_models as _;

/// What a sensor with these parameters looks along.
fn beams(kind: &str, params: &[(&str, Value)]) -> Option<Beams> {
    let mut section = Node::table(Span::default());
    for (key, value) in params {
        let table = section.as_table_mut().expect("it is one");
        table.set(key, Node::new(Span::default(), value.clone()));
    }
    let part = registry::find(Kind::Sensor, kind).expect("a sensor");
    let Make::Sensor(make) = part.make else {
        panic!("{kind} is no sensor")
    };
    make(&section).expect("good parameters").beams()
}

fn text(value: &str) -> Value {
    Value::String(value.to_owned())
}

fn cone(kind: &str, params: &[(&str, Value)]) -> (f64, f64) {
    match beams(kind, params) {
        Some(Beams::Cone {
            half_angle_rad,
            range_m,
        }) => ((half_angle_rad.to_degrees() * 1e9).round() / 1e9, range_m),
        other => panic!("{kind}: {other:?}"),
    }
}

fn rays(kind: &str, params: &[(&str, Value)]) -> (Vec<[f64; 3]>, f64) {
    match beams(kind, params) {
        Some(Beams::Rays {
            directions,
            range_m,
        }) => {
            for [x, y, z] in &directions {
                assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12, "{kind}");
            }
            (directions, range_m)
        }
        other => panic!("{kind}: {other:?}"),
    }
}

/// The direction at so many degrees of azimuth.
fn level(degrees: f64) -> [f64; 3] {
    let (sin, cos) = simbeeotic_model::units::math::sin_cos(degrees.to_radians());
    [cos, sin, 0.0]
}

fn near(a: [f64; 3], b: [f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
}

const AHEAD: [f64; 3] = [1.0, 0.0, 0.0];

#[test]
fn a_range_finder_looks_ahead_along_a_ray_or_in_a_cone() {
    let far = ("max_range", text("7 m"));
    assert_eq!(
        rays("range", std::slice::from_ref(&far)),
        (vec![AHEAD], 7.0)
    );
    let wide = ("field_of_view", text("25 deg"));
    assert_eq!(cone("range", &[far, wide]), (12.5, 7.0));
    // 27 degrees; 1.36 m in short mode, 4 m in long mode with time enough.
    let short = ("mode", text("short"));
    assert_eq!(cone("vl53l1x", &[short]), (13.5, 1.36));
    let patient = ("timing_budget", text("200 ms"));
    assert_eq!(cone("vl53l1x", &[patient]), (13.5, 4.0));
}

#[test]
fn a_multi_ranger_looks_to_its_sides() {
    let (five, range_m) = rays("multi-ranger", &[]);
    assert_eq!((five.len(), range_m), (5, 3.6));
    assert_eq!(five[..2], [AHEAD, [-1.0, 0.0, 0.0]]);
    assert_eq!(five[4], [0.0, 0.0, 1.0]);
    let (six, _) = rays("multi-ranger", &[("down", Value::Bool(true))]);
    assert_eq!(six[5], [0.0, 0.0, -1.0]);
}

#[test]
fn scanners_look_along_their_rays() {
    let (ring, range_m) = rays(
        "ring",
        &[("rays", Value::Integer(4)), ("max_range", text("3 m"))],
    );
    assert_eq!((ring.len(), range_m), (4, 3.0));
    assert!((0..4).all(|at| near(ring[at], level(90.0 * at as f64))));
    let (lidar, range_m) = rays("lidar", &[]);
    assert_eq!((lidar.len(), range_m), (181, 20.0));
    assert!(near(lidar[0], level(-90.0)) && near(lidar[90], AHEAD));
    assert!(near(lidar[180], level(90.0)));
    let few = [
        ("rays", Value::Integer(3)),
        ("start", text("-10 deg")),
        ("end", text("10 deg")),
        ("rows", Value::Integer(2)),
        ("lowest", text("0 deg")),
        ("highest", text("90 deg")),
    ];
    let (rows, range_m) = rays("lidar-3d", &few);
    assert_eq!((rows.len(), range_m), (6, 100.0));
    assert!(near(rows[0], level(-10.0)) && near(rows[2], level(10.0)));
    assert!(near(rows[3], [0.0, 0.0, 1.0]));
}

#[test]
fn more_rays_than_one_can_draw_are_the_space_that_they_fill() {
    assert_eq!(beams("lidar-3d", &[]), Some(Beams::Ball { range_m: 100.0 }));
    let ahead = [("start", text("-20 deg")), ("end", text("30 deg"))];
    match beams("lidar-3d", &ahead) {
        Some(Beams::Frustum {
            horizontal_rad,
            vertical_rad,
            range_m,
        }) => {
            assert!((horizontal_rad.to_degrees() - 60.0).abs() < 1e-9);
            assert!((vertical_rad.to_degrees() - 30.0).abs() < 1e-9);
            assert_eq!(range_m, 100.0);
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_camera_looks_as_wide_as_its_picture() {
    for (params, wide, high, far) in [
        (vec![], 90.0, 73.739_795, 100.0),
        (
            vec![
                ("width", Value::Integer(100)),
                ("height", Value::Integer(100)),
                ("field_of_view", text("60 deg")),
                ("far", text("30 m")),
            ],
            60.0,
            60.0,
            30.0,
        ),
        (
            vec![
                ("width", Value::Integer(200)),
                ("height", Value::Integer(100)),
                ("focal_length_px", Value::Float(50.0)),
            ],
            126.869_898,
            90.0,
            100.0,
        ),
        // All zones of a time-of-flight sensor.
        (vec![("preset", text("vl53l5cx"))], 45.0, 45.0, 4.0),
    ] {
        match beams("camera", &params) {
            Some(Beams::Frustum {
                horizontal_rad,
                vertical_rad,
                range_m,
            }) => {
                assert!(
                    (horizontal_rad.to_degrees() - wide).abs() < 1e-6,
                    "{params:?}"
                );
                assert!(
                    (vertical_rad.to_degrees() - high).abs() < 1e-6,
                    "{params:?}"
                );
                assert_eq!(range_m, far);
            }
            other => panic!("{params:?}: {other:?}"),
        }
    }
}

#[test]
fn detectors_look_in_their_cones() {
    for kind in ["person", "flower"] {
        assert_eq!(cone(kind, &[]), (22.5, 1.0), "{kind}");
        let wide = [("half_angle", text("70 deg")), ("max_range", text("9 m"))];
        assert_eq!(cone(kind, &wide), (70.0, 9.0), "{kind}");
        let round = [("half_angle", text("180 deg"))];
        assert_eq!(beams(kind, &round), Some(Beams::Ball { range_m: 1.0 }));
    }
    assert_eq!(
        rays("wall", &[("max_range", text("2 m"))]),
        (vec![AHEAD], 2.0)
    );
    let seen = beams("neighbors", &[("max_range", text("6 m"))]);
    assert_eq!(seen, Some(Beams::Ball { range_m: 6.0 }));
    let window = [("width", text("1 rad")), ("height", text("0.5 rad"))];
    assert_eq!(
        beams("neighbors", &window),
        Some(Beams::Frustum {
            horizontal_rad: 1.0,
            vertical_rad: 0.5,
            range_m: 10.0,
        })
    );
}

#[test]
fn optical_flow_looks_along_its_grid_ahead_or_down() {
    let params = [("rays", Value::Integer(3)), ("half_angle", text("45 deg"))];
    let (ahead, range_m) = rays("optical-flow", &params);
    assert_eq!((ahead.len(), range_m), (9, 20.0));
    // The first is up and to the left: at 45 degrees in both.
    let third = (1.0_f64 / 3.0).sqrt();
    assert!(near(ahead[0], [third, third, third]), "{:?}", ahead[0]);
    assert!(near(ahead[4], AHEAD));
    let (down, _) = rays("optical-flow-down", &params);
    assert!(near(down[4], [0.0, 0.0, -1.0]));
    // The upper edge of its picture is to the front, its left to the left.
    assert!(near(down[0], [third, third, -third]), "{:?}", down[0]);
    let (fine, _) = rays("optical-flow", &[("rays", Value::Integer(101))]);
    assert!(fine.len() <= Beams::RAYS_MAX && fine.len() > 1000);
    assert_eq!(
        rays("pmw3901", &[("max_range", text("5 m"))]),
        (vec![AHEAD], 5.0)
    );
}

#[test]
fn all_others_look_nowhere() {
    let some = [
        "camera",
        "flower",
        "lidar",
        "lidar-3d",
        "multi-ranger",
        "neighbors",
        "optical-flow",
        "optical-flow-down",
        "person",
        "pmw3901",
        "range",
        "ring",
        "vl53l1x",
        "wall",
    ];
    let looking = registry::of_kind(Kind::Sensor).filter(|part| {
        let Make::Sensor(make) = part.make else {
            panic!("{} is no sensor", part.label.name)
        };
        // A few need a parameter, and look nowhere.
        make(&Node::table(Span::default())).is_ok_and(|made| made.beams().is_some())
    });
    let looking: Vec<&str> = looking.map(|part| part.label.name).collect();
    assert_eq!(looking, some);
}
