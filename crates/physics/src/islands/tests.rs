//! Islands, driven without the queue of `events`.

#![expect(
    clippy::disallowed_methods,
    reason = "what is expected of a slope; compared with a tolerance"
)]

use crate::body::{BodyId, BodySpec, Material, Mobility};
use crate::config::Config;
use crate::contact::Contact;
use crate::motion::Motion;
use crate::physics::Physics;
use crate::queue::GROUND;
use crate::shape::Shape;
use crate::support::Support;
use glam::{DQuat, DVec3};
use simbeeotic_kernel::SimTime;
use simbeeotic_units::Attitude;
use std::collections::BTreeSet;

const G: f64 = 9.80665;

/// A world of islands, and the steps to come.
struct Rig {
    physics: Physics,
    queue: BTreeSet<(SimTime, u32)>,
    now: SimTime,
    contacts: Vec<Contact>,
    steps: u32,
}

fn seconds(s: f64) -> SimTime {
    SimTime::from_nanos((s * 1e9).round() as u64)
}

fn cube(half: f64, p: [f64; 3]) -> BodySpec {
    BodySpec {
        p_enu: DVec3::from_array(p),
        ..BodySpec::new(
            Shape::Box {
                half_m: DVec3::splat(half),
            },
            1.0,
        )
    }
}

fn ball(radius_m: f64, p: [f64; 3]) -> BodySpec {
    BodySpec {
        p_enu: DVec3::from_array(p),
        rolls: true,
        ..BodySpec::new(Shape::Sphere { radius_m }, 0.5)
    }
}

fn fixed(spec: BodySpec) -> BodySpec {
    BodySpec {
        mobility: Mobility::Fixed,
        ..spec
    }
}

impl Rig {
    fn new() -> Self {
        Self::with(Config::default())
    }

    fn with(config: Config) -> Self {
        Self {
            physics: Physics::new(config),
            queue: BTreeSet::new(),
            now: SimTime::ZERO,
            contacts: Vec::new(),
            steps: 0,
        }
    }

    fn add(&mut self, spec: BodySpec) -> u32 {
        let id = self.physics.add(spec).expect("a body").0;
        self.physics.classify();
        id
    }

    fn join(&mut self, a: u32, b: u32) {
        self.physics.join(a, b, self.now);
        self.queue.extend(self.physics.islands.take_due());
    }

    fn motion(&self, id: u32) -> &Motion {
        self.physics.motion(BodyId(id))
    }

    fn command(&mut self, id: u32, change: impl FnOnce(&mut Motion, SimTime)) {
        let mut motion = *self.motion(id);
        change(&mut motion, self.now);
        self.physics.commit(BodyId(id), self.now, motion);
        self.physics.member_changed(id, self.now);
        self.physics.wake_overloaded(self.now);
        self.queue.extend(self.physics.islands.take_due());
    }

    /// Works off all steps until `s`, and sees to it that nobody jumps.
    fn run(&mut self, s: f64) {
        let until = seconds(s);
        while let Some((t, key)) = self.queue.first().copied().filter(|(t, _)| *t <= until) {
            self.queue.pop_first();
            if !self.physics.islands.due(key, t) {
                continue;
            }
            let before = self.physics.motions.clone();
            let mut changed = Vec::new();
            self.physics
                .step_island(key, t, &mut self.contacts, &mut changed);
            self.steps += 1;
            self.queue.extend(self.physics.islands.take_due());
            for (before, after) in before.iter().zip(&self.physics.motions) {
                assert!(before.position(t).distance(after.position(t)) < 1e-12);
                let turned = before.attitude(t).conjugate() * after.attitude(t);
                assert!(turned.w.abs() > 1.0 - 1e-12);
            }
        }
        self.now = until;
    }

    fn asleep(&mut self) -> bool {
        let now = self.now;
        self.queue
            .retain(|(t, key)| self.physics.islands.due(*key, *t));
        self.queue.is_empty()
            && self
                .physics
                .motions
                .iter()
                .all(|m| m.velocity(now) == DVec3::ZERO)
    }

    fn p(&self, id: u32) -> DVec3 {
        self.motion(id).position(self.now)
    }

    fn v(&self, id: u32) -> DVec3 {
        self.motion(id).velocity(self.now)
    }
}

#[test]
fn a_box_on_the_ground_comes_to_rest_and_sleeps() {
    let mut rig = Rig::new();
    let id = rig.add(BodySpec {
        v_enu: DVec3::new(1.0, 0.0, 0.0),
        w_flu: DVec3::new(0.0, 0.0, 3.0),
        ..cube(0.1, [0.0, 0.0, 0.1])
    });
    rig.join(id, GROUND);
    rig.run(3.0);
    assert!(rig.asleep());
    let p = rig.p(id);
    assert!((p.z - 0.1).abs() < 1e-3, "{p}");
    // v^2 / (2 mu g), give or take the turning.
    assert!((p.x - 0.102).abs() < 0.01, "{p}");
    assert_eq!(rig.motion(id).support(), Support::Island);
    assert!((rig.motion(id).force()).length() < 1e-12);
    assert!(rig.steps < 400, "{}", rig.steps);
}

#[test]
fn a_stack_of_five_stands_and_sleeps() {
    let mut rig = Rig::new();
    let ids: Vec<u32> = (0..5)
        .map(|i| rig.add(cube(0.1, [0.0, 0.0, 0.1 + 0.2 * f64::from(i)])))
        .collect();
    rig.join(ids[0], GROUND);
    for pair in ids.windows(2) {
        rig.join(pair[0], pair[1]);
    }
    rig.run(10.0);
    for (i, id) in ids.iter().enumerate() {
        let p = rig.p(*id);
        let expected = DVec3::new(0.0, 0.0, 0.1 + 0.2 * i as f64);
        assert!(p.distance(expected) < 2e-3, "{i}: {p}");
    }
    assert!(rig.asleep());
}

/// A plate tilted about y, so that it falls towards +x, and a place upon it.
fn slope(degrees: f64, friction: f64, upon: f64) -> (BodySpec, DVec3, DQuat) {
    let tilt = DQuat::from_rotation_y(degrees.to_radians());
    let centre = DVec3::new(0.0, 0.0, 10.0);
    let plate = fixed(BodySpec {
        p_enu: centre,
        attitude: Attitude::from_unit_quat(tilt),
        material: Material {
            friction,
            restitution: 0.0,
        },
        ..BodySpec::new(
            Shape::Box {
                half_m: DVec3::new(20.0, 5.0, 0.1),
            },
            1.0,
        )
    });
    (
        plate,
        centre + tilt * DVec3::new(0.0, 0.0, 0.1 + upon),
        tilt,
    )
}

fn upon_slope(rig: &mut Rig, friction: f64) -> u32 {
    let (plate, p, tilt) = slope(20.0, friction, 0.1);
    let plate = rig.add(plate);
    let id = rig.add(BodySpec {
        attitude: Attitude::from_unit_quat(tilt),
        material: Material {
            friction,
            restitution: 0.0,
        },
        ..cube(0.1, p.to_array())
    });
    rig.join(id, plate);
    id
}

#[test]
fn a_box_on_a_slope_stays_if_friction_holds_it() {
    let mut rig = Rig::new();
    let id = upon_slope(&mut rig, 0.5);
    let start = rig.p(id);
    rig.run(3.0);
    assert!(rig.asleep());
    assert!(rig.p(id).distance(start) < 2e-3, "{}", rig.p(id) - start);
}

#[test]
fn a_box_slides_down_a_slope_at_g_sin_less_mu_cos() {
    let mut rig = Rig::new();
    let id = upon_slope(&mut rig, 0.2);
    rig.run(1.0);
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    let expected = G * (sin - 0.2 * cos);
    let speed = rig.v(id).length();
    assert!((speed / expected - 1.0).abs() < 0.02, "{speed} {expected}");
}

#[test]
fn a_sliding_ball_comes_to_roll_at_five_sevenths() {
    let mut rig = Rig::new();
    let id = rig.add(BodySpec {
        v_enu: DVec3::new(2.0, 0.0, 0.0),
        ..ball(0.1, [0.0, 0.0, 0.1])
    });
    rig.join(id, GROUND);
    rig.run(2.0);
    let v = rig.v(id);
    assert!((v.x / (2.0 * 5.0 / 7.0) - 1.0).abs() < 0.02, "{v}");
    let w = rig.motion(id).attitude(rig.now) * rig.motion(id).rate(rig.now);
    assert!((w.y * 0.1 / v.x - 1.0).abs() < 0.01, "{w}");
    let speed = v.x;
    rig.run(12.0);
    let v = rig.v(id);
    assert!((v.x / speed - 1.0).abs() < 0.02, "{v}");
    assert!(v.y.abs() < 0.01 && (rig.p(id).z - 0.1).abs() < 1e-3);
}

#[test]
fn a_ball_on_landing_gear_slides_to_a_stop_and_does_not_turn() {
    let mut rig = Rig::new();
    let id = rig.add(BodySpec {
        rolls: false,
        v_enu: DVec3::new(2.0, 0.0, 0.0),
        ..ball(0.1, [0.0, 0.0, 0.1])
    });
    rig.join(id, GROUND);
    rig.run(2.0);
    assert!(rig.asleep());
    let way = 4.0 / (2.0 * 0.5 * G);
    assert!((rig.p(id).x / way - 1.0).abs() < 0.02, "{}", rig.p(id));
    assert_eq!(rig.motion(id).attitude(rig.now), DQuat::IDENTITY);
}

#[test]
fn a_push_below_friction_moves_nothing_and_above_it_does() {
    let mut rig = Rig::new();
    let id = rig.add(cube(0.1, [0.0, 0.0, 0.1]));
    rig.join(id, GROUND);
    rig.run(2.0);
    assert!(rig.asleep());
    let start = rig.p(id);
    rig.command(id, |motion, t| {
        motion
            .set_force(t, DVec3::new(0.45 * G, 0.0, 0.0))
            .expect("a force");
    });
    assert!(rig.asleep());
    rig.run(6.0);
    assert!(rig.asleep());
    assert!(rig.p(id).distance(start) < 1e-3, "{}", rig.p(id) - start);
    assert!((rig.motion(id).force().x - 0.45 * G).abs() < 1e-12);
    rig.command(id, |motion, t| {
        motion
            .set_force(t, DVec3::new(0.6 * G, 0.0, 0.0))
            .expect("a force");
    });
    assert!(!rig.asleep());
    rig.run(7.0);
    let speed = rig.v(id).x;
    assert!((speed / (0.1 * G) - 1.0).abs() < 0.02, "{speed}");
}

#[test]
fn a_commit_of_the_same_wakes_nobody() {
    let mut rig = Rig::new();
    let id = rig.add(cube(0.1, [0.0, 0.0, 0.1]));
    rig.join(id, GROUND);
    rig.run(2.0);
    let steps = rig.steps;
    rig.command(id, |motion, t| {
        motion.set_force(t, DVec3::ZERO).expect("a force")
    });
    assert!(rig.asleep());
    rig.run(3.0);
    rig.command(id, |motion, t| {
        motion.set_velocity(t, DVec3::ZERO).expect("a velocity")
    });
    rig.run(4.0);
    assert_eq!(rig.steps, steps);
}

#[test]
fn a_member_thrown_up_leaves_and_flies_freely() {
    let mut rig = Rig::new();
    let low = rig.add(cube(0.1, [0.0, 0.0, 0.1]));
    let high = rig.add(cube(0.1, [0.0, 0.0, 0.3]));
    rig.join(low, GROUND);
    rig.join(low, high);
    rig.run(2.0);
    assert!(rig.asleep());
    let start = rig.p(high);
    rig.command(high, |motion, t| {
        motion
            .set_velocity(t, DVec3::new(0.5, 0.0, 3.0))
            .expect("a velocity");
    });
    rig.run(2.1);
    assert!(!rig.physics.islands.is_member(high));
    assert_eq!(rig.motion(high).support(), Support::None);
    rig.run(2.3);
    let expected = start + DVec3::new(0.15, 0.0, 0.9 - 0.5 * G * 0.09);
    assert!(
        rig.p(high).distance(expected) < 2e-3,
        "{}",
        rig.p(high) - expected
    );
    let v = rig.v(high);
    assert!(
        v.distance(DVec3::new(0.5, 0.0, 3.0 - 0.3 * G)) < 5e-3,
        "{v}"
    );
    assert!(rig.physics.islands.is_member(low));
}

#[test]
fn two_islands_that_touch_become_one_and_part_at_rest() {
    let mut rig = Rig::new();
    let a = rig.add(cube(0.1, [0.0, 0.0, 0.1]));
    let b = rig.add(BodySpec {
        v_enu: DVec3::new(-1.0, 0.0, 0.0),
        ..cube(0.1, [0.25, 0.0, 0.1])
    });
    rig.join(a, GROUND);
    rig.run(0.03);
    rig.join(b, GROUND);
    rig.run(0.08);
    assert!(!rig.physics.islands.together(a, b));
    rig.join(a, b);
    assert!(rig.physics.islands.together(a, b));
    rig.run(0.5);
    assert!(rig.p(b).x - rig.p(a).x > 0.199);
    assert!(rig.p(a).x < -0.01, "{}", rig.p(a));
    rig.run(3.0);
    assert!(rig.asleep());
}

#[test]
fn a_driven_body_pushes_a_resting_box() {
    let mut rig = Rig::new();
    let id = rig.add(cube(0.1, [0.0, 0.0, 0.1]));
    rig.join(id, GROUND);
    rig.run(1.0);
    assert!(rig.asleep());
    let ram = rig.add(BodySpec {
        mobility: Mobility::Driven,
        v_enu: DVec3::new(0.5, 0.0, 0.0),
        ..cube(0.1, [-0.7, 0.0, 0.1])
    });
    rig.join(ram, id);
    rig.run(3.0);
    let gap = rig.p(id).x - rig.p(ram).x;
    assert!((0.199..0.205).contains(&gap), "{gap}");
    assert!((rig.v(id).x - 0.5).abs() < 0.01);
    rig.command(ram, |motion, t| {
        motion.set_velocity(t, DVec3::ZERO).expect("a velocity")
    });
    rig.run(5.0);
    assert!(rig.asleep());
    let behind = rig.p(id) - DVec3::X * 0.2;
    rig.command(ram, |motion, t| {
        motion.set_position(t, behind).expect("a position");
        motion.set_velocity(t, DVec3::X).expect("a velocity");
    });
    rig.join(ram, id);
    rig.run(6.0);
    assert!((rig.v(id).x - 1.0).abs() < 0.01, "{}", rig.v(id));
}

/// A heap of boxes and balls about `(x, 0)`.
fn heap(rig: &mut Rig, x: f64) -> Vec<u32> {
    let mut ids = Vec::new();
    for layer in 0..4 {
        for i in 0..4 {
            let lean = 0.02 * f64::from(layer);
            let place = [
                x + 0.199 * f64::from(i % 2) + lean,
                0.199 * f64::from(i / 2) - lean,
                0.0995 + 0.199 * f64::from(layer),
            ];
            ids.push(rig.add(if (i + layer) % 3 == 0 {
                ball(0.1, place)
            } else {
                cube(0.1, place)
            }));
        }
    }
    rig.join(ids[0], GROUND);
    for pair in ids.windows(2) {
        rig.join(pair[0], pair[1]);
    }
    ids
}

fn bits(rig: &Rig, ids: &[u32]) -> Vec<[u64; 13]> {
    ids.iter()
        .map(|id| {
            let s = rig.motion(*id).at(rig.now);
            let q = s.world_from_body;
            [
                s.p_enu.x, s.p_enu.y, s.p_enu.z, s.v_enu.x, s.v_enu.y, s.v_enu.z, q.x, q.y, q.z,
                q.w, s.w_flu.x, s.w_flu.y, s.w_flu.z,
            ]
            .map(f64::to_bits)
        })
        .collect()
}

#[test]
fn islands_far_away_change_no_bit() {
    let mut alone = Rig::new();
    let only = heap(&mut alone, 0.0);
    let mut first = Rig::new();
    let mine = heap(&mut first, 0.0);
    heap(&mut first, 500.0);
    let mut last = Rig::new();
    heap(&mut last, -300.0);
    heap(&mut last, 700.0);
    let theirs = heap(&mut last, 0.0);
    for s in [0.3, 0.8, 1.7, 3.0] {
        alone.run(s);
        first.run(s);
        last.run(s);
        assert_eq!(bits(&alone, &only), bits(&first, &mine), "{s}");
        assert_eq!(bits(&alone, &only), bits(&last, &theirs), "{s}");
    }
}

#[test]
fn a_heap_loses_energy_and_comes_to_rest() {
    let mut rig = Rig::new();
    let ids = heap(&mut rig, 0.0);
    let energy = |rig: &Rig| -> f64 {
        ids.iter()
            .map(|id| {
                let (motion, s) = (rig.motion(*id), rig.motion(*id).at(rig.now));
                let spin = (s.w_flu * s.w_flu).dot(motion.inertia_kg_m2());
                motion.mass_kg() * (0.5 * s.v_enu.length_squared() + G * s.p_enu.z) + 0.5 * spin
            })
            .sum()
    };
    let mut last = energy(&rig);
    for tick in 1..=200 {
        rig.run(0.05 * f64::from(tick));
        let now = energy(&rig);
        assert!(now < last + 0.01 * last, "{tick}: {last} {now}");
        last = last.min(now);
    }
    let in_islands = |id: &u32| rig.physics.islands.is_member(*id);
    assert!(ids.iter().filter(|id| in_islands(id)).count() > 10);
    let now = rig.now;
    rig.queue
        .retain(|(t, key)| rig.physics.islands.due(*key, *t));
    assert!(rig.queue.is_empty(), "{now}: {:?}", rig.queue);
}

#[test]
fn far_from_the_origin_a_stack_stands_as_well() {
    let mut rig = Rig::new();
    let far = DVec3::new(1e8, -3e8, 0.0);
    let ids: Vec<u32> = (0..4)
        .map(|i| {
            let p = far + DVec3::new(0.0, 0.0, 0.1 + 0.2 * f64::from(i));
            rig.add(cube(0.1, p.to_array()))
        })
        .collect();
    rig.join(ids[0], GROUND);
    for pair in ids.windows(2) {
        rig.join(pair[0], pair[1]);
    }
    rig.run(4.0);
    assert!(rig.asleep());
    assert!((rig.p(ids[3]).z - 0.7).abs() < 2e-3, "{}", rig.p(ids[3]));
}

#[test]
fn what_falls_inside_an_island_is_reported() {
    let mut rig = Rig::new();
    let a = rig.add(cube(0.1, [0.0, 0.0, 0.1]));
    let b = rig.add(BodySpec {
        v_enu: DVec3::new(0.0, 0.0, -3.0),
        ..cube(0.1, [0.0, 0.0, 0.33])
    });
    rig.join(a, GROUND);
    rig.join(a, b);
    rig.run(0.5);
    let contact = rig.contacts.first().expect("a contact");
    assert_eq!((contact.a, contact.b), (BodyId(a), Some(BodyId(b))));
    assert!(contact.closing_speed_m_s() > 1.0);
    assert_eq!(rig.contacts.len(), 1);
    assert!(contact.impulse_enu.z < -2.9 && contact.normal_enu.z > 0.9);
}

#[test]
fn a_bouncy_ball_comes_to_rest() {
    let mut rig = Rig::new();
    let id = rig.add(BodySpec {
        v_enu: DVec3::new(0.0, 0.0, -0.04),
        material: Material {
            friction: 0.5,
            restitution: 0.95,
        },
        ..ball(0.1, [0.0, 0.0, 0.1])
    });
    rig.physics.ground = Some(Material {
        friction: 0.5,
        restitution: 0.95,
    });
    rig.join(id, GROUND);
    rig.run(3.0);
    assert!(rig.asleep());
}

#[test]
fn a_ball_that_spins_in_place_stops() {
    let mut rig = Rig::new();
    let id = rig.add(BodySpec {
        w_flu: DVec3::new(0.0, 0.0, 2.0),
        ..ball(0.1, [0.0, 0.0, 0.1])
    });
    rig.join(id, GROUND);
    rig.run(6.0);
    assert!(rig.asleep());
    assert!(rig.p(id).truncate().length() < 1e-3);
}
