//! Times of impact against closed forms, bracketing searches, and dense samples of random meetings.

use super::{Side, meets};
use crate::body::BodySpec;
use crate::motion::Motion;
use crate::shape::form::{Form, Place};
use crate::shape::{HeightField, Hull, Mesh, Part, Shape};
use glam::{DVec2, DVec3};
use simbeeotic_kernel::{SimTime, Stream};
use simbeeotic_units::Attitude;
use std::sync::Arc;

const GRAVITY: f64 = 9.80665;
const SPEEDS: [f64; 5] = [0.1, 1.0, 10.0, 100.0, 300.0];

struct Body {
    motion: Motion,
    form: Form,
}

impl Body {
    fn new(spec: &BodySpec) -> Self {
        let gravity = if spec.gravity { GRAVITY } else { 0.0 };
        Self {
            motion: Motion::new(spec, gravity, 0.5),
            form: Form::new(&spec.shape, false).unwrap(),
        }
    }

    fn side(&self) -> Side<'_> {
        Side {
            motion: &self.motion,
            form: &self.form,
        }
    }

    fn place(&self, t: SimTime) -> Place {
        Place {
            p: self.motion.position(t),
            q: self.motion.attitude(t),
        }
    }

    fn meets(&self, other: Option<&Self>, span_s: f64) -> Option<f64> {
        let to = SimTime::from_nanos((span_s * 1e9) as u64);
        let side = other.map(Self::side);
        meets(self.side(), side, SimTime::ZERO, to).map(|t| t.as_secs_f64())
    }
}

fn still(shape: Shape, p_enu: DVec3) -> BodySpec {
    BodySpec {
        p_enu,
        gravity: false,
        inertia_kg_m2: DVec3::ONE,
        ..BodySpec::new(shape, 1.0)
    }
}

fn close(found: Option<f64>, exact: f64) {
    let found = found.expect("they meet");
    assert!((found - exact).abs() < 1e-6, "{found} instead of {exact}");
    assert!(found <= exact + 1e-9, "{found} after {exact}");
}

#[test]
fn a_ball_meets_faces_edges_and_corners_of_a_box_in_time() {
    let half_m = DVec3::new(0.5, 0.7, 0.9);
    let block = Body::new(&still(
        Shape::Box { half_m },
        DVec3::new(100.0, -50.0, 20.0),
    ));
    let radius_m = 0.1;
    for speed in SPEEDS {
        for towards in [
            DVec3::X,
            DVec3::NEG_Z,
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::new(0.3, 0.0, -1.0),
            DVec3::new(1.0, 2.0, 3.0),
            DVec3::new(-1.0, 0.5, -0.7),
        ] {
            // Straight at the middle of a face or an edge, or at a corner, from 3 m.
            let towards = towards.normalize();
            let sign = |c: f64| if c == 0.0 { 0.0 } else { c.signum() };
            let target = half_m * towards.map(sign);
            let p_enu = block.motion.p + target + towards * 3.0;
            let ball = Body::new(&BodySpec {
                v_enu: -towards * speed,
                ..still(Shape::Sphere { radius_m }, p_enu)
            });
            let exact = (3.0 - radius_m) / speed;
            close(ball.meets(Some(&block), 40.0), exact);
            close(block.meets(Some(&ball), 40.0), exact);
        }
    }
}

#[test]
fn under_gravity_too() {
    let half_m = DVec3::new(0.5, 0.7, 0.9);
    let block = Body::new(&still(Shape::Box { half_m }, DVec3::ZERO));
    for speed in SPEEDS {
        let ball = Body::new(&BodySpec {
            v_enu: DVec3::new(0.0, 0.0, speed),
            gravity: true,
            ..still(
                Shape::Sphere { radius_m: 0.1 },
                DVec3::new(0.2, 0.3, 0.9 + 0.1 + 2.0),
            )
        });
        let exact = (speed + (speed * speed + 4.0 * GRAVITY).sqrt()) / GRAVITY;
        close(ball.meets(Some(&block), 100.0), exact);
        let drop = 0.9 + 2.0;
        let exact = (speed + (speed * speed + 2.0 * (drop) * GRAVITY).sqrt()) / GRAVITY;
        close(ball.meets(None, 100.0), exact);
    }
}

#[test]
fn a_turning_box_meets_the_ground_with_its_lowest_corner() {
    let half_m = DVec3::new(0.1, 0.2, 0.05);
    let mut stream = Stream::new(1, "corners", "test");
    for k in 0..300 {
        let speed = SPEEDS[1 + k % 4];
        let mut spec = BodySpec {
            v_enu: DVec3::new(3.0, 0.0, -speed),
            w_flu: DVec3::ZERO.with_y([0.0, 1.0, 10.0, 60.0][k % 4]),
            gravity: k % 3 == 0,
            attitude: Attitude::from_unit_quat(crate::rotation::turn_by(stream.in_ball(3.0))),
            ..still(Shape::Box { half_m }, DVec3::new(5.0, 6.0, 0.5))
        };
        if k % 7 == 0 {
            spec.w_flu = stream.in_ball(20.0);
            spec.inertia_kg_m2 = DVec3::new(1.0, 1.3, 1.7);
        }
        let body = Body::new(&spec);
        let lowest = |s: f64| {
            let nanos = (s * 1e9) as u64;
            body.form
                .gap_to_ground(body.place(SimTime::from_nanos(nanos)))
                .distance
        };
        let step = 1e-3 / speed.max(3.0);
        let mut high = 0.0;
        while lowest(high) > 0.0 {
            high += step;
        }
        let mut low = high - step;
        while high - low > 2e-9 {
            let middle = 0.5 * (low + high);
            if lowest(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let found = body.meets(None, 20.0).expect("it lands");
        assert!(
            (found - high).abs() < 1e-7,
            "{k}: {found} instead of {high}"
        );
    }
}

#[test]
fn boxes_meet_face_to_face() {
    let block = |p, v_enu| {
        let half_m = DVec3::new(0.5, 0.5, 0.5);
        Body::new(&BodySpec {
            v_enu,
            ..still(Shape::Box { half_m }, p)
        })
    };
    for speed in SPEEDS {
        for shift in [
            DVec3::ZERO,
            DVec3::new(0.0, 0.3, 0.1),
            DVec3::new(0.0, 0.999, -0.999),
        ] {
            let left = block(DVec3::ZERO, DVec3::X * (0.25 * speed));
            let right = block(DVec3::X * 2.0 + shift, -DVec3::X * (0.75 * speed));
            close(left.meets(Some(&right), 20.0), 1.0 / speed);
        }
    }
}

#[test]
fn a_spinning_rod_meets_a_ball() {
    let rod = Shape::Capsule {
        radius_m: 0.02,
        half_height_m: 1.0,
    };
    for rate in [0.1, 1.0, 10.0, 100.0] {
        for distance in [0.3, 0.8, 0.99] {
            // Along x at the start, turning about world z.
            let lying = crate::rotation::turn_by(DVec3::Y * std::f64::consts::FRAC_PI_2);
            let rod = Body::new(&BodySpec {
                attitude: Attitude::from_unit_quat(lying),
                w_flu: lying.inverse() * (DVec3::Z * rate),
                ..still(rod.clone(), DVec3::ZERO)
            });
            let ball = Body::new(&still(
                Shape::Sphere { radius_m: 0.05 },
                DVec3::Y * distance,
            ));
            let exact = (std::f64::consts::FRAC_PI_2 - libm::asin(0.07 / distance)) / rate;
            close(rod.meets(Some(&ball), 40.0), exact);
            close(ball.meets(Some(&rod), 40.0), exact);
        }
    }
}

fn size(stream: &mut Stream) -> f64 {
    0.05 + 0.3 * stream.uniform()
}

fn convex(stream: &mut Stream) -> Shape {
    let (radius_m, half_height_m) = (size(stream), size(stream));
    match stream.below(6) {
        0 => Shape::Sphere { radius_m },
        1 => Shape::Box {
            half_m: DVec3::new(size(stream), size(stream), size(stream)),
        },
        2 => Shape::Cylinder {
            radius_m,
            half_height_m,
        },
        3 => Shape::Cone {
            radius_m,
            half_height_m,
        },
        4 => Shape::Capsule {
            radius_m,
            half_height_m,
        },
        _ => Shape::Hull(Arc::new(Hull {
            points_m: (0..12).map(|_| stream.in_ball(0.3)).collect(),
        })),
    }
}

fn any(stream: &mut Stream) -> Shape {
    match stream.below(12) {
        0 => Shape::Mesh(Arc::new(Mesh {
            points_m: (0..6).map(|_| stream.in_ball(0.4)).collect(),
            triangles: vec![[0, 1, 2], [2, 3, 4], [3, 4, 5], [0, 5, 1]],
        })),
        1 => Shape::HeightField(Arc::new(HeightField {
            size_m: DVec2::new(0.8, 0.6),
            columns: 12,
            heights_m: (0..120).map(|_| 0.1 * stream.uniform()).collect(),
        })),
        2 | 3 => {
            let part = |stream: &mut Stream| Part {
                offset_m: stream.in_ball(0.4),
                attitude: Attitude::from_unit_quat(crate::rotation::turn_by(stream.in_ball(3.0))),
                shape: convex(stream),
            };
            Shape::Compound((0..3).map(|_| part(stream)).collect())
        }
        _ => convex(stream),
    }
}

/// A body somewhere within 2 m that is about to cross the middle, turning.
fn flying(stream: &mut Stream) -> BodySpec {
    let p_enu = stream.in_ball(2.0) + stream.unit_vector();
    let speed = SPEEDS[stream.below(4) as usize];
    let aim = stream.in_ball(0.5);
    let mut spec = BodySpec {
        v_enu: (aim - p_enu).normalize() * speed,
        attitude: Attitude::from_unit_quat(crate::rotation::turn_by(stream.in_ball(3.0))),
        w_flu: match stream.below(3) {
            0 => DVec3::ZERO,
            1 => stream.in_ball(10.0),
            _ => DVec3::X * 5.0,
        },
        gravity: stream.below(2) == 0,
        ..still(any(stream), p_enu)
    };
    if stream.below(4) == 0 {
        spec.inertia_kg_m2 = DVec3::new(1.0, 1.2, 1.5);
    }
    spec
}

const TRIALS: u32 = 4000;
const SAMPLES: u32 = 25;

#[test]
fn nothing_tunnels() {
    let mut stream = Stream::new(1, "tunnels", "test");
    let (mut met, mut missed) = (0, 0);
    for trial in 0..TRIALS {
        let (one, two) = (flying(&mut stream), flying(&mut stream));
        let (a, b) = (Body::new(&one), Body::new(&two));
        let gap = |t: SimTime| a.form.gap(a.place(t), &b.form, b.place(t));
        if gap(SimTime::ZERO).distance <= 0.0 {
            continue;
        }
        let speed = one.v_enu.distance(two.v_enu) + one.w_flu.length() + two.w_flu.length();
        let span = (4.0 / speed).min(0.3);
        let found = a.meets(Some(&b), span);
        let until = found.unwrap_or(span);
        // Before, there is no touch.
        for k in 0..SAMPLES {
            let part = f64::from(k) / f64::from(SAMPLES);
            let t = SimTime::from_nanos((until * part * 1e9) as u64);
            let distance = gap(t).distance;
            assert!(
                distance > -1e-6,
                "{trial}: {distance} at {t}\n{one:?}\n{two:?} {found:?}"
            );
        }
        match found {
            Some(s) => {
                met += 1;
                let distance = gap(SimTime::from_nanos((s * 1e9) as u64)).distance;
                assert!(
                    distance.abs() < 1e-6,
                    "{trial}: {distance} at {s}\n{one:?}\n{two:?}"
                );
            }
            None => missed += 1,
        }
    }
    assert!(met > 300 && missed > 300, "{met} {missed}");
}

#[test]
fn those_that_touch_and_part_do_not_meet() {
    let ball = |p, v_enu| {
        Body::new(&BodySpec {
            v_enu,
            ..still(Shape::Sphere { radius_m: 0.5 }, p)
        })
    };
    let block = Body::new(&still(Shape::Box { half_m: DVec3::ONE }, DVec3::ZERO));
    let on_top = DVec3::new(0.1, 0.2, 1.5);
    assert_eq!(ball(on_top, DVec3::Z).meets(Some(&block), 10.0), None);
    assert_eq!(ball(on_top, DVec3::X).meets(Some(&block), 10.0), None);
    assert_eq!(ball(on_top, -DVec3::Z).meets(Some(&block), 10.0), Some(0.0));
    let inside = DVec3::new(0.1, 0.2, 1.4);
    assert_eq!(ball(inside, DVec3::Z).meets(Some(&block), 10.0), None);
    assert_eq!(ball(inside, -DVec3::Z).meets(Some(&block), 10.0), Some(0.0));
}
