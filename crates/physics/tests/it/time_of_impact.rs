//! When two bodies of any shape first touch: to the microsecond where a formula knows, and never missed.
//!
//! The trials at the end are judged by another measure of distance than the engine's (see `shapes`): until
//! the time that is reported nothing overlaps, and then the two touch. A pair for which nothing is
//! reported must never overlap.

use crate::shapes::{self, BOUNDED, FREE, Kind, Solid, attitude, place};
use crate::worlds::{G, as_seconds, floating, in_space, on_ground, run, seconds, stream, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_physics::{
    BodyId, BodySpec, Config, Contact, Contacts, Mobility, Motion, Physics, Shape, group,
};
use simbeeotic_units::glam::{DQuat, DVec3};
use simbeeotic_units::{Acceleration, Time};
use std::collections::BTreeMap;

const SPEEDS: [f64; 5] = [0.1, 1.0, 10.0, 100.0, 300.0];
const RADIUS: f64 = 0.1_f32 as f64;

/// A contact no farther than a microsecond from `expected`, and nothing else.
fn on_time(contacts: &[Contact], expected: f64, what: &str) {
    assert_eq!(contacts.len(), 1, "{what}: {contacts:?}");
    let error = as_seconds(contacts[0].time) - expected;
    assert!(error.abs() < 1e-6, "{what}: {error} s");
}

/// A ball that arrives with `v` at `centre`, where it touches the `target`, after `lead` seconds.
fn arrive(target: BodySpec, centre: DVec3, v: DVec3, lead: f64) -> Vec<Contact> {
    let mut physics = in_space();
    physics.add(target).unwrap();
    physics.add(floating(centre - v * lead, v)).unwrap();
    run(
        &mut physics,
        seconds(lead + 0.01_f64.min(0.05 / v.length())),
    )
}

/// A direction within the cone of `normals` (positive combinations of them).
fn between(normals: &[DVec3], stream: &mut Stream) -> DVec3 {
    let sum: DVec3 = normals
        .iter()
        .map(|n| *n * stream.uniform_in(0.1..1.0))
        .sum();
    sum.normalize()
}

/// A velocity into the surface, not grazing.
fn into(normal: DVec3, speed: f64, stream: &mut Stream) -> DVec3 {
    loop {
        let v = stream.unit_vector() * speed;
        if v.dot(normal) < -0.1 * speed {
            return v;
        }
    }
}

#[test]
fn a_ball_meets_a_tilted_plane_on_time() {
    let mut stream = stream("plane");
    for speed in SPEEDS {
        for _ in 0..40 {
            let tilt = attitude(&mut stream);
            let normal = tilt.quat() * DVec3::Z;
            let origin = stream.in_ball(3.0);
            let plane = BodySpec {
                p_enu: origin,
                attitude: tilt,
                mobility: Mobility::Fixed,
                ..BodySpec::new(Shape::Plane, 1.0)
            };
            let across = tilt.quat() * DVec3::new(stream.uniform(), stream.uniform(), 0.0) * 5.0;
            let v = into(normal, speed, &mut stream);
            let lead = stream.uniform_in(0.01..1.0);
            let contacts = arrive(plane, origin + across + normal * RADIUS, v, lead);
            on_time(&contacts, lead, &format!("{speed} m/s"));
            assert!(contacts[0].normal_enu.distance(normal) < 1e-6);
            assert!(contacts[0].point_enu.distance(origin + across) < 1e-5);
        }
    }
}

/// Which of the box's coordinates the point of contact has in common with its corner: one for a face, two
/// for an edge, three for a corner.
#[test]
fn a_ball_meets_a_box_on_face_edge_and_corner_on_time() {
    let mut stream = stream("box");
    for speed in SPEEDS {
        for bound in 1..=3 {
            for mobility in [Mobility::Fixed, Mobility::Free] {
                for _ in 0..25 {
                    let half = DVec3::new(0.2, 0.3, 0.4);
                    let turned = attitude(&mut stream);
                    let sign = DVec3::from_array(std::array::from_fn(|_| {
                        if stream.bernoulli(0.5) { 1.0 } else { -1.0 }
                    }));
                    let first = stream.below(3) as usize;
                    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
                    let mut corner = half * sign;
                    let mut normals = Vec::new();
                    for k in 0..3 {
                        let axis = (first + k) % 3;
                        if k < bound {
                            normals.push(axes[axis] * sign[axis]);
                        } else {
                            corner[axis] *= stream.uniform_in(-0.9..0.9);
                        }
                    }
                    let normal = turned.quat() * between(&normals, &mut stream);
                    let origin = stream.in_ball(2.0);
                    let target = BodySpec {
                        p_enu: origin,
                        attitude: turned,
                        mobility,
                        gravity: false,
                        ..BodySpec::new(Shape::Box { half_m: half }, 1.0)
                    };
                    let v = into(normal, speed, &mut stream);
                    let lead = stream.uniform_in(0.01..1.0);
                    let point = origin + turned.quat() * corner;
                    let contacts = arrive(target, point + normal * RADIUS, v, lead);
                    on_time(&contacts, lead, &format!("{bound} at {speed} m/s"));
                    // From the box, which was added first, to the ball.
                    assert!(contacts[0].normal_enu.distance(normal) < 1e-5);
                    assert!(contacts[0].point_enu.distance(point) < 1e-5);
                }
            }
        }
    }
}

/// A body's attitude as rotation about a fixed axis of the world gives it.
fn turned(start: DQuat, axis: DVec3, angle: f64) -> DQuat {
    let (sin, cos) = libm::sincos(0.5 * angle);
    let v = axis * sin;
    DQuat::from_xyzw(v.x, v.y, v.z, cos) * start
}

/// When the lowest corner of a turning box comes to the ground, by a search over its height in steps fine
/// enough to see every swing of a corner, and by bisection.
fn lowest_corner_lands(
    half: DVec3,
    start: DQuat,
    axis: DVec3,
    rate: f64,
    height: impl Fn(f64) -> f64,
    end: f64,
) -> Option<f64> {
    let lowest = |s: f64| {
        let q = turned(start, axis, rate * s);
        let up = DVec3::new(
            (q * DVec3::X).z.abs(),
            (q * DVec3::Y).z.abs(),
            (q * DVec3::Z).z.abs(),
        );
        height(s) - up.dot(half)
    };
    let steps = 20_000;
    let step = end / f64::from(steps);
    let after = (0..=steps)
        .map(|k| f64::from(k) * step)
        .find(|s| lowest(*s) <= 0.0)?;
    let (mut above, mut below) = ((after - step).max(0.0), after);
    while below - above > 1e-12 {
        let middle = 0.5 * (above + below);
        if lowest(middle) > 0.0 {
            above = middle;
        } else {
            below = middle;
        }
    }
    // A corner that only grazes lands at no definite time.
    let slope = (lowest(below + 1e-7) - lowest(below - 1e-7)) / 2e-7;
    (slope < -1e-2).then_some(below)
}

#[test]
fn a_turning_box_lands_on_its_lowest_corner_on_time() {
    let mut stream = stream("turning box");
    let mut landed = 0;
    for speed in SPEEDS {
        for case in 0..60 {
            // A cube turns about any axis as this says, a block about its own axes.
            let (half, axis) = if case % 2 == 0 {
                (DVec3::splat(0.2), stream.unit_vector())
            } else {
                (DVec3::new(0.1, 0.2, 0.3), DVec3::AXES[case / 2 % 3])
            };
            let start = attitude(&mut stream);
            // The body rate of an even turn is the same in both frames but for the attitude.
            let rate = [0.0, 3.0, 30.0, 300.0][case % 4] * stream.uniform_in(0.5..1.0);
            let gravity = case % 3 == 0;
            let clearance = stream.uniform_in(0.01..1.0) * speed.min(2.0);
            let from = half.length() + clearance;
            let fall = if gravity { G } else { 0.0 };
            let height = |s: f64| from - speed * s - 0.5 * fall * s * s;
            let end = (clearance + half.length()) / speed;
            let world_axis = start.quat() * axis;
            let expected = lowest_corner_lands(half, start.quat(), world_axis, rate, height, end);
            let Some(expected) = expected else { continue };

            let mut physics = on_ground(surface(0.5, 0.5));
            let spec = BodySpec {
                p_enu: DVec3::new(3.0, -7.0, from),
                v_enu: DVec3::new(2.0, 1.0, -speed),
                attitude: start,
                w_flu: axis * rate,
                gravity,
                contacts: Contacts::Detect,
                ..BodySpec::new(Shape::Box { half_m: half }, 1.0)
            };
            let id = physics.add(spec).unwrap();
            let contacts = run(&mut physics, seconds(expected + 1e-5));
            on_time(
                &contacts,
                expected,
                &format!("{speed} m/s, {rate} rad/s, case {case}"),
            );
            assert_eq!((contacts[0].a, contacts[0].b), (id, None));
            landed += 1;
        }
    }
    assert!(landed > 250, "{landed}");
}

/// One pair of a trial.
struct Pair {
    motions: [Motion; 2],
    solids: [Solid; 2],
    end: f64,
    speed: f64,
    kinds: [Kind; 2],
}

/// What a set of trials is about.
#[derive(Clone, Copy)]
struct Trials {
    purpose: &'static str,
    count: usize,
    /// The first of each pair.
    targets: &'static [Kind],
    target: Mobility,
    /// Greatest number of turns, more or less, of each body before they meet.
    turns: f64,
    contacts: Contacts,
}

/// Two bodies about `origin`, the second aimed at the first, more or less.
fn aim(
    physics: &mut Physics,
    origin: DVec3,
    trials: &Trials,
    speed: f64,
    k: usize,
    stream: &mut Stream,
) -> Pair {
    let kinds = [
        trials.targets[k % trials.targets.len()],
        FREE[stream.below(7) as usize],
    ];
    let sizes = [(); 2].map(|()| stream.uniform_in(0.1..0.5));
    let moving = trials.target != Mobility::Fixed;
    let [target, bullet] = [0, 1].map(|i| {
        let shape = shapes::shape(kinds[i], sizes[i], stream);
        if i == 1 || moving {
            shape.centred().0
        } else {
            shape
        }
    });
    // A plane has no size; it is met somewhere near its origin.
    let reach = target.bounding_radius_m().min(1.0) + bullet.bounding_radius_m();
    let offset = stream.in_ball(reach);
    let tilt = attitude(stream);
    let direction = loop {
        let direction = stream.unit_vector();
        let steep = direction.dot(tilt.quat() * DVec3::Z) < -0.4;
        if steep || kinds[0] != Kind::Plane {
            break direction;
        }
    };
    // Far enough to begin outside.
    let steep = if kinds[0] == Kind::Plane { 0.4 } else { 1.0 };
    let way = stream.uniform_in(1.3..2.2) * (reach + offset.length()) / steep;
    let lead = way / speed;
    let a = if stream.bernoulli(0.5) && kinds[0] != Kind::Plane {
        stream.in_ball(0.3 * speed / lead)
    } else {
        DVec3::ZERO
    };
    let common = if moving {
        stream.in_ball(0.5 * speed)
    } else {
        DVec3::ZERO
    };
    let rate = |stream: &mut Stream| stream.in_ball((trials.turns * 6.3 / lead).min(5e3));
    let first = BodySpec {
        p_enu: origin,
        v_enu: common,
        w_flu: rate(stream),
        attitude: tilt,
        mobility: trials.target,
        contacts: trials.contacts,
        material: surface(0.3, 0.9),
        gravity: false,
        group: group::TERRAIN,
        mask: group::BEE,
        ..BodySpec::new(target.clone(), 1.0)
    };
    let v = direction * speed;
    let second = BodySpec {
        p_enu: origin + offset - v * lead + a * (0.5 * lead * lead),
        v_enu: common + v - a * lead,
        w_flu: rate(stream),
        attitude: attitude(stream),
        contacts: trials.contacts,
        material: surface(0.3, 0.9),
        gravity: false,
        group: group::BEE,
        mask: group::TERRAIN,
        ..BodySpec::new(bullet.clone(), 1.0)
    };
    let first = physics.add(first).unwrap();
    let second = physics.add(second).unwrap();
    let mut motion = *physics.motion(second);
    motion.set_force(SimTime::ZERO, a).unwrap();
    physics.commit(second, SimTime::ZERO, motion);
    Pair {
        motions: [first, second].map(|id| *physics.motion(id)),
        solids: [Solid::new(&target, moving), Solid::new(&bullet, true)],
        end: lead + 1.5 * reach / speed,
        // Of any point of one as seen from the other.
        speed: 2.0 * speed + trials.turns * 6.3 / lead * reach,
        kinds,
    }
}

impl Pair {
    /// Since when both follow their segments.
    fn begun(&self) -> SimTime {
        self.motions[0].start().max(self.motions[1].start())
    }
}

/// The gap between the two of a pair, both of which begin their segments anew at `t`.
fn gap(pair: &mut Pair, t: SimTime) -> f64 {
    let [a, b] = &mut pair.motions;
    a.advance(t).unwrap();
    b.advance(t).unwrap();
    pair.solids[0].gap(place(a, t), &pair.solids[1], place(b, t))
}

/// The deepest overlap before the reported time, if any.
fn judge(mut pair: Pair, contact: Option<&Contact>, name: &str) {
    let until = contact.map_or(pair.end, |contact| as_seconds(contact.time));
    let samples = 24;
    let about = format!("{name} {:?} at up to {} m/s", pair.kinds, pair.speed);
    for k in 0..=samples {
        let s = pair.end * f64::from(k) / f64::from(samples);
        if s >= until {
            break;
        }
        let gap = gap(&mut pair, seconds(s));
        assert!(
            gap > -1e-6,
            "{about}: {gap} m inside at {s} s, contact {contact:?}"
        );
    }
    if let Some(contact) = contact {
        // A moment earlier, in which nothing moves by more than a micrometre (but a nanosecond at
        // least), they are apart; parry tells that more surely than how deep two overlap that just
        // touch. What touches at a nanosecond's fraction touches at the nanosecond before.
        let moment = (1e-6 / pair.speed).max(1e-9);
        let before =
            SimTime::from_nanos(contact.time.nanos().saturating_sub((moment * 1e9) as u64));
        let before = before.max(pair.begun());
        let apart = gap(&mut pair, before);
        let touch = gap(&mut pair, contact.time);
        assert!(
            apart > -1e-7 && touch.min(apart) < 1e-5,
            "{about}: {apart} m apart before, {touch} m at contact"
        );
    }
}

/// Mostly fast: what is slow takes long.
fn speed_of(world: usize) -> f64 {
    match world % 50 {
        7 => 0.1,
        27 | 37 => 1.0,
        k => [10.0, 100.0, 300.0][k % 3],
    }
}

/// A world without ground and weight, for a run that takes about so long.
fn space(seconds: f64) -> Physics {
    Physics::new(Config {
        ground: None,
        gravity: Acceleration::si(0.0),
        list_period: Time::from_secs((0.2 * seconds).max(0.1)),
        ..Config::default()
    })
}

/// Many pairs to a world, each far from all others; tells how many met.
fn trials(trials: Trials) -> usize {
    const SHARED: usize = 50;
    let mut met = 0;
    let mut stream = stream(trials.purpose);
    for world in 0..trials.count / SHARED {
        let speed = speed_of(world);
        let mut physics = space(2.0 / speed);
        let mut pairs = Vec::new();
        for k in 0..SHARED {
            let cell = [k % 16, k / 16, 0].map(|c| 40.0 * c as f64);
            let origin = DVec3::from_array(cell);
            pairs.push(aim(&mut physics, origin, &trials, speed, k, &mut stream));
        }
        let end = pairs.iter().map(|pair| pair.end).fold(0.0, f64::max);
        let mut first = BTreeMap::new();
        for contact in run(&mut physics, seconds(end)) {
            first.entry(contact.a).or_insert(contact);
        }
        for (k, pair) in pairs.into_iter().enumerate() {
            let id = BodyId(2 * k as u32);
            let contact = first
                .get(&id)
                .filter(|contact| as_seconds(contact.time) <= pair.end);
            if let Some(contact) = contact {
                assert_eq!(contact.b, Some(BodyId(id.0 + 1)));
                met += 1;
            }
            judge(pair, contact, &format!("{} {world}/{k}", trials.purpose));
        }
    }
    met
}

#[test]
fn nothing_tunnels_in_60_000_trials_of_moving_bodies() {
    let met = trials(Trials {
        purpose: "moving",
        count: 60_000,
        targets: &FREE,
        target: Mobility::Free,
        turns: 0.5,
        contacts: Contacts::Detect,
    });
    assert!(met > 20_000, "{met}");
}

#[test]
fn nothing_tunnels_in_30_000_trials_against_fixed_bodies() {
    let met = trials(Trials {
        purpose: "fixed",
        count: 30_000,
        targets: &BOUNDED,
        target: Mobility::Fixed,
        turns: 0.5,
        contacts: Contacts::Detect,
    });
    assert!(met > 8_000, "{met}");
}

#[test]
fn nothing_tunnels_in_5_000_trials_of_bodies_that_respond() {
    let met = trials(Trials {
        purpose: "responding",
        count: 5_000,
        targets: &FREE,
        target: Mobility::Free,
        turns: 1.0,
        contacts: Contacts::Respond,
    });
    assert!(met > 1_500, "{met}");
}

#[test]
fn nothing_tunnels_in_2_500_trials_of_bodies_that_spin_fast() {
    let met = trials(Trials {
        purpose: "spinning",
        count: 2_500,
        targets: &FREE,
        target: Mobility::Free,
        turns: 10.0,
        contacts: Contacts::Detect,
    });
    assert!(met > 800, "{met}");
}

/// A plane is near everybody, so each has a world of its own.
#[test]
fn nothing_tunnels_in_5_000_trials_against_planes() {
    let mut stream = stream("planes");
    let plan = Trials {
        purpose: "planes",
        count: 5_000,
        targets: &[Kind::Plane],
        target: Mobility::Fixed,
        turns: 0.5,
        contacts: Contacts::Respond,
    };
    let mut met = 0;
    for world in 0..plan.count {
        let speed = speed_of(world);
        let mut physics = space(2.0 / speed);
        let pair = aim(&mut physics, DVec3::ZERO, &plan, speed, 0, &mut stream);
        let contacts = run(&mut physics, seconds(pair.end));
        met += usize::from(!contacts.is_empty());
        judge(pair, contacts.first(), &format!("planes {world}"));
    }
    assert!(met > 3_000, "{met}");
}
