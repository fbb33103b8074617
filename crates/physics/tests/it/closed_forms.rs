//! Free motion, impacts and lasting contact against formulas, for bodies of any shape. (Balls in free
//! flight, bouncing and sliding have files of their own.)

use crate::shapes::attitude;
use crate::worlds::{
    G, as_seconds, ball, floating, in_space, kinetic_energy, on_ground, run, seconds, stream,
    surface,
};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{
    BodyId, BodySpec, Config, Contact, Material, Mobility, Physics, Shape, Support, limits,
};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{Angle, Attitude};

/// The arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// Landau and Lifshitz, Mechanics (3rd ed.), section 37: with `I1 < I2 < I3` and `M^2 > 2 E I2` the body
/// rate has the period `4 K(k) / tau'`, and `K(k) = pi / (2 agm(1, sqrt(1 - k^2)))`.
#[test]
fn a_body_thrown_about_its_middle_axis_flips_with_the_elliptic_period() {
    let [i1, i2, i3] = [0.125, 0.25, 0.3125];
    for slight in [0.1, 0.5, 1.5] {
        let w = DVec3::new(0.0, 5.0, slight);
        let momentum_2 = i2 * i2 * w.y * w.y + i3 * i3 * w.z * w.z;
        let energy_2 = i2 * w.y * w.y + i3 * w.z * w.z;
        let rate = ((i3 - i2) * (momentum_2 - energy_2 * i1) / (i1 * i2 * i3)).sqrt();
        let k_2 =
            (i2 - i1) * (energy_2 * i3 - momentum_2) / ((i3 - i2) * (momentum_2 - energy_2 * i1));
        let quarter = std::f64::consts::FRAC_PI_2 / agm(1.0, (1.0 - k_2).sqrt()) / rate;

        let mut physics = in_space();
        let spec = BodySpec {
            inertia_kg_m2: DVec3::new(i1, i2, i3),
            w_flu: w,
            ..floating(DVec3::ZERO, DVec3::ZERO)
        };
        let id = physics.add(spec).unwrap();
        for flips in 1..=10 {
            // It starts with the body rate in the plane of the middle and the greatest axis, and is
            // back in it, the other way round, after half a period.
            let t = seconds(2.0 * quarter * f64::from(flips));
            run(&mut physics, t);
            let sign = if flips % 2 == 0 { 1.0 } else { -1.0 };
            let expected = DVec3::new(0.0, sign * w.y, w.z);
            let error = physics.motion(id).rate(t).distance(expected);
            assert!(
                error < 1e-5,
                "flip {flips} with {slight}: {error} rad/s off"
            );
        }
    }
}

#[test]
fn an_asymmetric_top_keeps_energy_and_momentum_to_a_millionth_for_100_s() {
    let mut stream = stream("tops");
    for case in 0..12 {
        let mut physics = in_space();
        let half_m = DVec3::new(0.1, 0.17, 0.29) + stream.in_ball(0.08);
        let spec = BodySpec {
            gravity: false,
            attitude: attitude(&mut stream),
            w_flu: stream.unit_vector() * stream.uniform_in(1.0..20.0),
            ..BodySpec::new(Shape::Box { half_m }, 0.7)
        };
        let id = physics.add(spec).unwrap();
        let start = quantities(&physics, DVec3::ZERO, SimTime::ZERO);
        for ten in 1..=10 {
            let t = SimTime::from_secs(10 * ten);
            run(&mut physics, t);
            let now = quantities(&physics, DVec3::ZERO, t);
            assert!((now.energy / start.energy - 1.0).abs() < 1e-6, "{case}");
            let drift = now.angular.distance(start.angular) / start.angular.length();
            assert!(drift < 1e-6, "top {case}: {drift}");
            assert!((physics.motion(id).attitude(t).length() - 1.0).abs() < 1e-12);
        }
    }
}

/// The fixed point of the drag law is the terminal speed, however coarsely it is set.
#[test]
fn terminal_speed_is_reached_under_a_drag_wrench_set_100_times_a_second() {
    let mut physics = Physics::new(Config {
        ground: None,
        ..Config::default()
    });
    let spec = ball(DVec3::ZERO);
    let (mass, drag) = (spec.mass_kg, 0.02);
    let id = physics.add(spec).unwrap();
    let terminal = (mass * G / drag).sqrt();
    for centi in 0..1000_u64 {
        let t = SimTime::from_millis(10 * centi);
        run(&mut physics, t);
        let mut motion = *physics.motion(id);
        let v = motion.velocity(t);
        let expected = terminal * libm::tanh(as_seconds(t) * G / terminal);
        assert!(
            (v.length() - expected).abs() < 0.01 * terminal,
            "{v} at {t}"
        );
        motion
            .set_wrench(t, v * (-drag * v.length()), DVec3::ZERO)
            .unwrap();
        physics.commit(id, t, motion);
        physics.settle(t);
    }
    let speed = physics.motion(id).velocity(seconds(10.0)).length();
    assert!((speed / terminal - 1.0).abs() < 1e-9, "{speed} {terminal}");
}

/// What contact keeps.
struct Quantities {
    momentum: DVec3,
    angular: DVec3,
    energy: f64,
}

/// Of all bodies; the angular momentum about `pivot`.
fn quantities(physics: &Physics, pivot: DVec3, t: SimTime) -> Quantities {
    let bodies = (0..physics.len() as u32).map(|id| physics.motion(BodyId(id)));
    let mut sum = Quantities {
        momentum: DVec3::ZERO,
        angular: DVec3::ZERO,
        energy: kinetic_energy(physics, t),
    };
    for motion in bodies {
        let s = motion.at(t);
        let momentum = s.v_enu * motion.mass_kg();
        sum.momentum += momentum;
        sum.angular += (s.p_enu - pivot).cross(momentum)
            + s.world_from_body * (motion.inertia_kg_m2() * s.w_flu);
    }
    sum
}

/// Runs to the first contact, and returns it.
fn first_contact(physics: &mut Physics, until: SimTime) -> Option<Contact> {
    let mut contacts = Vec::new();
    while let Some(next) = physics.next_time().filter(|next| *next <= until) {
        physics.advance(next, &mut contacts);
        if let Some(first) = contacts.first() {
            return Some(*first);
        }
        physics.settle(next);
    }
    None
}

/// Velocity of a body's material at `point`.
fn velocity_at(physics: &Physics, id: BodyId, point: DVec3, t: SimTime) -> DVec3 {
    let s = physics.motion(id).at(t);
    s.v_enu + (s.world_from_body * s.w_flu).cross(point - s.p_enu)
}

/// Two bodies of these shapes, thrown at each other off centre.
fn thrown(shapes: [Shape; 2], purpose: &str, material: Material) -> Physics {
    let mut stream = stream(purpose);
    let mut physics = in_space();
    let drift = stream.in_ball(3.0);
    let toward = stream.unit_vector();
    let offset = stream.in_ball(0.12);
    let speed = stream.uniform_in(1.0..20.0);
    for (side, shape) in [-1.0, 1.0].into_iter().zip(shapes) {
        let spec = BodySpec {
            p_enu: DVec3::new(1.0, -2.0, 3.0) + (toward + offset) * side,
            v_enu: drift - toward * (side * speed),
            attitude: attitude(&mut stream),
            w_flu: stream.in_ball(10.0),
            material,
            gravity: false,
            ..BodySpec::new(shape, stream.uniform_in(0.2..2.0))
        };
        physics.add(spec).unwrap();
    }
    physics
}

fn pairs_of_shapes() -> Vec<[Shape; 2]> {
    let sphere = || Shape::Sphere { radius_m: 0.2 };
    let block = || Shape::Box {
        half_m: DVec3::new(0.1, 0.2, 0.3),
    };
    let capsule = || Shape::Capsule {
        radius_m: 0.1,
        half_height_m: 0.2,
    };
    vec![
        [sphere(), sphere()],
        [sphere(), block()],
        [capsule(), sphere()],
        [block(), block()],
        [block(), capsule()],
        [capsule(), capsule()],
    ]
}

#[test]
fn elastic_impacts_off_centre_keep_momentum_angular_momentum_and_energy() {
    let mut met = 0;
    for (pair, shapes) in pairs_of_shapes().into_iter().enumerate() {
        for case in 0..40 {
            let purpose = format!("elastic {pair} {case}");
            let mut physics = thrown(shapes.clone(), &purpose, surface(0.0, 1.0));
            let pivot = DVec3::new(-4.0, 5.0, 6.0);
            let before = quantities(&physics, pivot, SimTime::ZERO);
            let Some(contact) = first_contact(&mut physics, seconds(2.0)) else {
                continue;
            };
            met += 1;
            let t = contact.time;
            let after = quantities(&physics, pivot, t);
            let scale = before.energy.sqrt();
            assert!(after.momentum.distance(before.momentum) < 1e-9 * scale);
            let turned = after.angular.distance(before.angular);
            assert!(turned < 1e-9 * 10.0 * scale, "{purpose}: {turned}");
            assert!(
                (after.energy / before.energy - 1.0).abs() < 1e-9,
                "{purpose}: {} J became {} J",
                before.energy,
                after.energy
            );
            // They part as fast as they met, and only along the normal.
            let [a, b] = [0, 1].map(|id| velocity_at(&physics, BodyId(id), contact.point_enu, t));
            let parting = (b - a).dot(contact.normal_enu);
            assert!((parting - contact.closing_speed_m_s()).abs() < 1e-6 * scale);
            assert!(contact.impulse_enu.cross(contact.normal_enu).length() < 1e-9 * scale);
        }
    }
    assert!(met > 150, "{met}");
}

#[test]
fn rough_impacts_off_centre_keep_momentum_and_angular_momentum_and_lose_energy() {
    let mut met = 0;
    for (pair, shapes) in pairs_of_shapes().into_iter().enumerate() {
        for case in 0..40 {
            let purpose = format!("rough {pair} {case}");
            let mut physics = thrown(shapes.clone(), &purpose, surface(0.4, 0.6));
            let before = quantities(&physics, DVec3::ZERO, SimTime::ZERO);
            let Some(contact) = first_contact(&mut physics, seconds(2.0)) else {
                continue;
            };
            met += 1;
            let after = quantities(&physics, DVec3::ZERO, contact.time);
            let scale = before.energy.sqrt();
            assert!(after.momentum.distance(before.momentum) < 1e-9 * scale);
            // Balls are pushed each at its own surface, up to 1 ns of their way apart.
            assert!(after.angular.distance(before.angular) < 1e-7 * scale);
            assert!(after.energy < before.energy * (1.0 - 1e-9), "{purpose}");
        }
    }
    assert!(met > 150, "{met}");
}

#[test]
fn a_smooth_box_that_falls_on_a_corner_keeps_its_energy() {
    let mut stream = stream("corner");
    for case in 0..50 {
        let mut physics = on_ground(surface(0.0, 1.0));
        let spec = BodySpec {
            p_enu: DVec3::new(0.0, 0.0, 2.0),
            v_enu: stream.in_ball(3.0),
            attitude: attitude(&mut stream),
            w_flu: stream.in_ball(5.0),
            material: surface(0.0, 1.0),
            ..BodySpec::new(
                Shape::Box {
                    half_m: DVec3::new(0.1, 0.2, 0.3),
                },
                0.5,
            )
        };
        let v = spec.v_enu;
        let id = physics.add(spec).unwrap();
        let energy = |physics: &Physics, t: SimTime| {
            kinetic_energy(physics, t) + 0.5 * G * physics.motion(id).position(t).z
        };
        let before = energy(&physics, SimTime::ZERO);
        let contact = first_contact(&mut physics, seconds(3.0)).unwrap();
        assert_eq!((contact.a, contact.b), (id, None), "{case}");
        let after = energy(&physics, contact.time);
        assert!(
            (after / before - 1.0).abs() < 1e-9,
            "{case}: {before} J, {after} J"
        );
        let now = physics.motion(id).velocity(contact.time);
        assert!((now - v).truncate().length() < 1e-9);
    }
}

/// Heights `h e^2n`, and in all `(1 + 2 e + 2 e^2 + ...) sqrt(2 h / g)` until it rests.
#[test]
fn a_ball_bounces_in_a_geometric_series_of_heights_and_times() {
    let (height, e) = (2.0, 0.8);
    let mut physics = on_ground(surface(0.5, e));
    let spec = BodySpec {
        material: surface(0.5, e),
        ..ball(DVec3::new(0.0, 0.0, f64::from(0.1_f32) + height))
    };
    let id = physics.add(spec).unwrap();
    let fall = (2.0 * height / G).sqrt();
    let (mut landing, mut speed) = (fall, G * fall);
    while speed * e > limits::REST_SPEED_M_S {
        let radius = physics.motion(id).radius_m();
        speed *= e;
        let apex = landing + speed / G;
        run(&mut physics, seconds(apex));
        let top = physics.motion(id).position(seconds(apex)).z - radius;
        assert!(
            (top / (speed * speed / (2.0 * G)) - 1.0).abs() < 1e-5,
            "{top} m"
        );
        landing = apex + speed / G;
    }
    run(&mut physics, seconds(landing - 1e-6));
    assert_eq!(physics.motion(id).support(), Support::None);
    run(&mut physics, seconds(landing + 1e-6));
    assert_eq!(physics.motion(id).support(), Support::Resting);
}

/// A slope that falls towards +x, and a place upon it at `upon` above its face.
fn slope(degrees: f64, material: Material, upon: f64) -> (BodySpec, DVec3, Attitude, DVec3) {
    let tilt = Attitude::about(DVec3::Y, Angle::si(degrees.to_radians()));
    let centre = DVec3::new(0.0, 0.0, 30.0);
    let plate = BodySpec {
        p_enu: centre,
        attitude: tilt,
        mobility: Mobility::Fixed,
        material,
        ..BodySpec::new(
            Shape::Box {
                half_m: DVec3::new(25.0, 5.0, 0.1),
            },
            1.0,
        )
    };
    let place = centre + tilt.quat() * DVec3::new(-20.0, 0.0, 0.1 + upon);
    (plate, place, tilt, tilt.quat() * DVec3::X)
}

/// A flat box upon a slope, at rest.
fn box_on_slope(degrees: f64, friction: f64) -> (Physics, BodyId, DVec3) {
    let material = surface(friction, 0.0);
    let (plate, place, tilt, down) = slope(degrees, material, 0.05);
    let mut physics = on_ground(material);
    physics.add(plate).unwrap();
    let id = physics
        .add(BodySpec {
            p_enu: place,
            attitude: tilt,
            material,
            ..BodySpec::new(
                Shape::Box {
                    half_m: DVec3::new(0.2, 0.2, 0.05),
                },
                1.0,
            )
        })
        .unwrap();
    (physics, id, down)
}

#[test]
fn a_box_stays_on_a_slope_below_the_angle_of_friction_and_slides_above_it() {
    let mu = 0.5;
    let critical = libm::atan(mu).to_degrees();
    let way = |degrees: f64| {
        let (mut physics, id, down) = box_on_slope(degrees, mu);
        let start = physics.motion(id).position(SimTime::ZERO);
        run(&mut physics, seconds(3.0));
        (physics.motion(id).position(seconds(3.0)) - start).dot(down)
    };
    let below = way(critical - 0.5);
    assert!(below.abs() < 2e-3, "{below} m below the angle of friction");
    let above = way(critical + 1.0);
    let (sin, cos) = libm::sincos((critical + 1.0).to_radians());
    let expected = 0.5 * G * (sin - mu * cos) * 9.0;
    assert!(
        (above / expected - 1.0).abs() < 0.1,
        "{above} m, not {expected} m"
    );
}

#[test]
fn a_box_slides_down_a_slope_at_g_sin_less_mu_g_cos() {
    let (mut physics, id, down) = box_on_slope(30.0, 0.3);
    run(&mut physics, seconds(1.5));
    let (sin, cos) = libm::sincos(30.0_f64.to_radians());
    let expected = 1.5 * G * (sin - 0.3 * cos);
    let speed = physics.motion(id).velocity(seconds(1.5)).dot(down);
    assert!(
        (speed / expected - 1.0).abs() < 0.02,
        "{speed} m/s, not {expected}"
    );
}

#[test]
fn a_box_slides_over_the_ground_v_squared_over_two_mu_g() {
    for (mu, v) in [(0.5, 3.0), (0.2, 2.0), (0.8, 6.0)] {
        let mut physics = on_ground(surface(mu, 0.0));
        let spec = BodySpec {
            p_enu: DVec3::new(0.0, 0.0, 0.05),
            v_enu: DVec3::X * v,
            material: surface(mu, 0.0),
            ..BodySpec::new(
                Shape::Box {
                    half_m: DVec3::new(0.3, 0.3, 0.05),
                },
                1.0,
            )
        };
        let id = physics.add(spec).unwrap();
        run(&mut physics, seconds(10.0));
        let state = physics.motion(id).at(seconds(10.0));
        let expected = v * v / (2.0 * mu * G);
        let p = state.p_enu;
        assert!((p.x / expected - 1.0).abs() < 0.02, "{p}, not {expected} m");
        assert!(
            p.y.abs() < 0.01 * expected && (p.z - 0.05).abs() < 1e-3,
            "{p}"
        );
        assert_eq!(state.v_enu, DVec3::ZERO);
        // At rest it costs nothing.
        let steps = physics.tally().steps;
        run(&mut physics, seconds(1000.0));
        assert_eq!(physics.tally().steps, steps);
        assert_eq!(physics.motion(id).position(seconds(1000.0)), p);
    }
}

fn rolling(p: DVec3, v: DVec3, material: Material) -> BodySpec {
    BodySpec {
        v_enu: v,
        rolls: true,
        material,
        ..ball(p)
    }
}

#[test]
fn a_sliding_ball_comes_to_roll_at_five_sevenths_of_its_speed() {
    let mut physics = on_ground(surface(0.5, 0.0));
    let v = DVec3::new(2.0, 1.0, 0.0);
    let id = physics
        .add(rolling(DVec3::new(0.0, 0.0, 0.1), v, surface(0.5, 0.0)))
        .unwrap();
    run(&mut physics, seconds(1.5));
    let s = physics.motion(id).at(seconds(1.5));
    let expected = v * (5.0 / 7.0);
    assert!(
        s.v_enu.distance(expected) < 0.02 * expected.length(),
        "{}",
        s.v_enu
    );
    // It rolls: what touches the ground stands.
    let contact = s.v_enu + (s.world_from_body * s.w_flu).cross(DVec3::Z * -0.1);
    assert!(contact.length() < 0.02 * expected.length(), "{contact}");
    assert!((s.p_enu.z - 0.1).abs() < 1e-3);
}

#[test]
fn a_ball_rolls_down_a_slope_at_five_sevenths_of_g_sin() {
    for degrees in [5.0, 15.0] {
        let material = surface(0.6, 0.0);
        let (plate, place, _, down) = slope(degrees, material, 0.1);
        let mut physics = on_ground(material);
        physics.add(plate).unwrap();
        let id = physics.add(rolling(place, DVec3::ZERO, material)).unwrap();
        run(&mut physics, seconds(1.5));
        let speed = physics.motion(id).velocity(seconds(1.5)).dot(down);
        let expected = 1.5 * 5.0 / 7.0 * G * libm::sin(degrees.to_radians());
        assert!(
            (speed / expected - 1.0).abs() < 0.02,
            "{speed} m/s, not {expected}"
        );
    }
}

/// A ball upon the same slope that does not roll slides like a box, but for what its first small bounces
/// turn it.
#[test]
fn a_ball_on_its_landing_gear_slides_down_a_slope() {
    let material = surface(0.3, 0.0);
    let (plate, place, _, down) = slope(30.0, material, 0.1);
    let mut physics = on_ground(material);
    physics.add(plate).unwrap();
    let id = physics
        .add(BodySpec {
            material,
            ..ball(place)
        })
        .unwrap();
    run(&mut physics, seconds(1.5));
    let (sin, cos) = libm::sincos(30.0_f64.to_radians());
    let expected = 1.5 * G * (sin - 0.3 * cos);
    let s = physics.motion(id).at(seconds(1.5));
    let speed = s.v_enu.dot(down);
    assert!(
        (speed / expected - 1.0).abs() < 0.05,
        "{speed} m/s, not {expected}"
    );
}
