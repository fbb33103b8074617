//! The same bits for any number of threads and any build; for any order of insertion the same contacts.

use crate::shapes::{self, BOUNDED, FREE, attitude};
use crate::worlds::{direction, run, seconds, stream, surface};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Config, Contact, Mobility, Physics, Shape};
use simbeeotic_units::glam::DVec3;

/// Bodies of all shapes in a hall with obstacles, two metres apart; some lie on the ground, some in
/// heaps, the rest fly.
fn hall(side: u32, layers: u32) -> Vec<BodySpec> {
    let mut stream = stream("hall");
    let mut specs = Vec::new();
    for cell in 0..side * side * layers {
        let [x, y, z] = [cell % side, cell / side % side, cell / side / side].map(f64::from);
        let p_enu = DVec3::new(x, y, z) * 1.5 + DVec3::Z * 0.6 + stream.in_ball(0.3);
        if cell % 10 == 3 {
            let kind = BOUNDED[stream.below(BOUNDED.len() as u64) as usize];
            specs.push(BodySpec {
                p_enu,
                attitude: attitude(&mut stream),
                mobility: Mobility::Fixed,
                material: surface(0.5, 0.5),
                ..BodySpec::new(shapes::shape(kind, 0.4, &mut stream), 1.0)
            });
        } else {
            // Mostly bees.
            let shape = if stream.bernoulli(0.5) {
                Shape::Sphere { radius_m: 0.1 }
            } else {
                let kind = FREE[stream.below(FREE.len() as u64) as usize];
                shapes::shape(kind, 0.3, &mut stream).centred().0
            };
            specs.push(BodySpec {
                p_enu,
                attitude: attitude(&mut stream),
                v_enu: direction(&mut stream) * 4.0,
                w_flu: stream.in_ball(5.0),
                material: surface(stream.uniform(), stream.uniform_in(0.0..0.7)),
                rolls: stream.bernoulli(0.5),
                gravity: stream.bernoulli(0.7),
                ..BodySpec::new(shape, stream.uniform_in(0.1..1.0))
            });
        }
    }
    specs
}

/// All that a body's state says at `t`, to the last bit.
fn bits(physics: &Physics, id: BodyId, t: SimTime) -> [u64; 13] {
    let s = physics.motion(id).at(t);
    let q = s.world_from_body;
    let vectors = [s.p_enu, s.v_enu, s.w_flu].map(|v| v.to_array());
    let mut words = [0; 13];
    for (word, number) in words
        .iter_mut()
        .zip(vectors.iter().flatten().chain(&[q.x, q.y, q.z, q.w]))
    {
        *word = number.to_bits();
    }
    words
}

/// What came of the bodies of `specs`, added in the order of `order`: contacts and states, by their place
/// in `specs`.
#[derive(PartialEq)]
struct Outcome {
    contacts: Vec<(SimTime, usize, Option<usize>, [u64; 3])>,
    states: Vec<[u64; 13]>,
}

impl Outcome {
    fn word(&self) -> u64 {
        let numbers = self.contacts.iter().flat_map(|(time, a, b, impulse)| {
            [time.nanos(), *a as u64, b.map_or(u64::MAX, |b| b as u64)]
                .into_iter()
                .chain(*impulse)
        });
        numbers.chain(self.states.iter().flatten().copied()).fold(
            0xcbf2_9ce4_8422_2325,
            |word: u64, number| {
                (word ^ number)
                    .wrapping_mul(0x0000_0100_0000_01b3)
                    .rotate_left(29)
            },
        )
    }
}

/// Flies the bodies at 10 Hz in aligned phases, and gives the outcome after `s` seconds.
fn outcome(specs: &[BodySpec], order: &[usize], threads: usize, s: f64) -> Outcome {
    let mut physics = Physics::new(Config {
        ground: Some(surface(0.5, 0.3)),
        ..Config::default()
    });
    physics.set_threads(threads).unwrap();
    let mut ids = vec![BodyId(0); specs.len()];
    let mut names = vec![0; specs.len()];
    for (id, &name) in order.iter().enumerate() {
        ids[name] = physics.add(specs[name].clone()).unwrap();
        names[id] = name;
    }
    let mut contacts: Vec<Contact> = Vec::new();
    let mut stream = stream("hall commands");
    let ticks = (s * 10.0).round() as u32;
    for tick in 0..ticks {
        let t = seconds(0.1 * f64::from(tick));
        contacts.extend(run(&mut physics, t));
        for (name, id) in ids.iter().enumerate() {
            let push = stream.in_ball(1.0);
            let mut motion = *physics.motion(*id);
            if (name as u32 + tick).is_multiple_of(3) && motion.mobility() == Mobility::Free {
                motion.set_force(t, push).unwrap();
                physics.commit(*id, t, motion);
            }
        }
        physics.settle(t);
    }
    let end = seconds(s);
    contacts.extend(run(&mut physics, end));
    let mut contacts: Vec<_> = contacts
        .iter()
        .map(|c| {
            let (a, b) = (names[c.a.index()], c.b.map(|b| names[b.index()]));
            // From the one with the lower name: which of the two comes first is a matter of numbers.
            let turned = b.is_some_and(|b| b < a);
            let impulse = if turned {
                -c.impulse_enu
            } else {
                c.impulse_enu
            };
            let (a, b) = match b {
                Some(b) if turned => (b, Some(a)),
                b => (a, b),
            };
            (
                c.time,
                a,
                b,
                impulse.to_array().map(|x| (x + 0.0).to_bits()),
            )
        })
        .collect();
    contacts.sort_unstable();
    Outcome {
        contacts,
        states: ids.iter().map(|id| bits(&physics, *id, end)).collect(),
    }
}

fn same(actual: &Outcome, expected: &Outcome, what: &str) {
    let differs = actual
        .contacts
        .iter()
        .zip(&expected.contacts)
        .find(|(actual, expected)| actual != expected);
    assert_eq!(differs, None, "{what}: the first contact that differs");
    assert_eq!(actual.contacts.len(), expected.contacts.len(), "{what}");
    let differs = (0..actual.states.len()).find(|k| actual.states[*k] != expected.states[*k]);
    assert_eq!(differs, None, "{what}: the first body that differs");
}

#[test]
fn the_number_of_threads_does_not_show() {
    let specs = hall(30, 7);
    assert!(specs.len() >= 6_000);
    let order: Vec<usize> = (0..specs.len()).collect();
    let expected = outcome(&specs, &order, 1, 1.0);
    assert!(
        expected.contacts.len() > 3_000,
        "{}",
        expected.contacts.len()
    );
    for threads in [2, 3, 8] {
        let actual = outcome(&specs, &order, threads, 1.0);
        same(&actual, &expected, &format!("{threads} threads"));
    }
}

#[test]
fn the_order_of_insertion_does_not_show() {
    let specs = hall(12, 4);
    let order: Vec<usize> = (0..specs.len()).collect();
    let expected = outcome(&specs, &order, 1, 1.0);
    let mut stream = stream("orders");
    for threads in [1, 2] {
        let mut shuffled = order.clone();
        stream.shuffle(&mut shuffled);
        let actual = outcome(&specs, &shuffled, threads, 1.0);
        same(&actual, &expected, "another order");
    }
}

/// Negative control: what is compared can differ.
#[test]
fn a_picometre_shows() {
    let mut specs = hall(12, 4);
    let order: Vec<usize> = (0..specs.len()).collect();
    let expected = outcome(&specs, &order, 1, 1.0);
    specs[100].p_enu.x += 1e-12;
    assert_ne!(outcome(&specs, &order, 1, 1.0).word(), expected.word());
}

const GOLDEN: (usize, u64) = (1162, 14_714_560_957_428_375_867);

/// Debug or release, whatever the machine: if physics is changed on purpose, so is this word.
#[test]
fn the_bits_of_all_shapes_are_the_same_in_every_build() {
    let specs = hall(12, 4);
    let order: Vec<usize> = (0..specs.len()).collect();
    let outcome = outcome(&specs, &order, 2, 1.0);
    assert_eq!((outcome.contacts.len(), outcome.word()), GOLDEN);
}
