//! What a command costs: swarms of bees that get a new velocity set point ten times a second.
//!
//! One iteration is a tenth of a simulated second, in which each bee is commanded once; criterion's
//! `elem/s` counts commands, prediction of contacts, lists and bounces included. 100 ns a command are
//! 0.1 s of processor time for each simulated second of 100,000 bees.
//!
//! - `dens`: one bee in 8 m^3, whatever their number; `ball20`: all start within a ball of 20 m.
//! - `random`: each bee has its own phase; `aligned`: all are commanded at the same instant.
//! - `passing`: nobody touches anybody: the floor.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Config, Contacts, Physics, Shape};
use simbeeotic_units::glam::DVec3;
use std::hint::black_box;

const PERIOD_NS: u64 = 100_000_000;
const PERIOD_S: f64 = 0.1;
const SPEED_MAX: f64 = 2.0;

/// A cheap generator, so that the bees' thoughts cost little.
struct Dice(u64);

impl Dice {
    fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }

    fn within(&mut self, most: f64) -> f64 {
        ((self.word() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0) * most
    }

    fn vector(&mut self, most: f64) -> DVec3 {
        DVec3::new(self.within(most), self.within(most), self.within(most))
    }
}

/// Bees and when each of them is next commanded.
struct Swarm {
    physics: Physics,
    dice: Dice,
    wishes: Vec<DVec3>,
    /// Offsets within the period, and bees, in order.
    phases: Vec<(u64, u32)>,
    begun: u64,
}

#[derive(Clone, Copy)]
enum Scene {
    Dens,
    Ball20,
    Passing,
}

impl Swarm {
    fn new(count: u32, scene: Scene, aligned: bool) -> Self {
        let mut dice = Dice(1982);
        let mut physics = Physics::new(Config {
            ground: None,
            ..Config::default()
        });
        let side = libm::cbrt(f64::from(count)).ceil() as u32;
        for id in 0..count {
            let p_enu = match scene {
                Scene::Ball20 => loop {
                    let p = dice.vector(20.0);
                    if p.length() <= 20.0 {
                        break p;
                    }
                },
                Scene::Dens | Scene::Passing => {
                    let cell = [id / side / side, id / side % side, id % side].map(f64::from);
                    DVec3::from_array(cell) * 2.0 + dice.vector(0.89)
                }
            };
            let contacts = if matches!(scene, Scene::Passing) {
                Contacts::None
            } else {
                Contacts::Respond
            };
            let bee = BodySpec::new(Shape::Sphere { radius_m: 0.1 }, 0.1);
            let bee = BodySpec {
                p_enu,
                contacts,
                gravity: false,
                ..bee
            };
            physics.add(bee).expect("a bee is a body");
        }
        let phase = |dice: &mut Dice| if aligned { 0 } else { dice.word() % PERIOD_NS };
        let mut phases: Vec<_> = (0..count).map(|id| (phase(&mut dice), id)).collect();
        phases.sort_unstable();
        let mut swarm = Self {
            physics,
            dice,
            wishes: vec![DVec3::ZERO; count as usize],
            phases,
            begun: 0,
        };
        for _ in 0..5 {
            swarm.tenth_of_a_second();
        }
        swarm
    }

    fn tenth_of_a_second(&mut self) {
        let mut contacts = Vec::new();
        let mut place = 0;
        while place < self.phases.len() {
            let offset = self.phases[place].0;
            let t = SimTime::from_nanos(self.begun + offset);
            while let Some(next) = self.physics.next_time().filter(|next| *next <= t) {
                self.physics.advance(next, &mut contacts);
                if next < t {
                    self.physics.settle(next);
                } else {
                    break;
                }
            }
            while let Some((_, id)) = self.phases.get(place).filter(|p| p.0 == offset) {
                let id = BodyId(*id);
                let wish = &mut self.wishes[id.index()];
                *wish = (*wish + self.dice.vector(0.35)).clamp_length_max(SPEED_MAX);
                let mut motion = *self.physics.motion(id);
                let push = (*wish - motion.velocity(t)) / PERIOD_S;
                let turn = DVec3::new(0.0, 0.0, self.dice.within(3.0));
                motion.set_force(t, push * 0.1).expect("a push is finite");
                motion.set_rate(t, turn).expect("a turn is finite");
                self.physics.commit(id, t, motion);
                place += 1;
            }
            self.physics.settle(t);
        }
        self.begun += PERIOD_NS;
        black_box(&contacts);
    }
}

fn swarms(c: &mut Criterion) {
    let mut group = c.benchmark_group("commands");
    group.sample_size(10);
    let scenes = [
        ("passing", Scene::Passing, vec![1_000, 100_000]),
        ("dens", Scene::Dens, vec![1_000, 10_000, 100_000]),
        ("ball20", Scene::Ball20, vec![3_074, 10_000, 30_000]),
    ];
    for (name, scene, counts) in scenes {
        for count in counts {
            group.throughput(Throughput::Elements(u64::from(count)));
            for (phase, aligned) in [("random", false), ("aligned", true)] {
                // Made only if the filter of the command line lets it run.
                let mut swarm = None;
                group.bench_function(BenchmarkId::new(format!("{name}/{phase}"), count), |b| {
                    let swarm = swarm.get_or_insert_with(|| Swarm::new(count, scene, aligned));
                    b.iter(|| swarm.tenth_of_a_second());
                });
                if let Some(swarm) = swarm {
                    report(&swarm);
                }
            }
        }
    }
    group.finish();
}

#[expect(
    clippy::print_stderr,
    reason = "a bench says what it did beside how long it took"
)]
fn report(swarm: &Swarm) {
    let tally = swarm.physics.tally();
    let rate = |n: u64| n as f64 * 1e9 / swarm.begun as f64;
    eprintln!(
        "  {:.1} s simulated, per second: {:.0} contacts, {:.0} searches, {:.1} listings, {:.0} relistings",
        swarm.begun as f64 / 1e9,
        rate(tally.contacts),
        rate(tally.searches),
        rate(tally.listings),
        rate(tally.relistings),
    );
}

criterion_group!(benches, swarms);
criterion_main!(benches);
