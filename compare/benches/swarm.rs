//! A swarm in free flight: balls of 0.1 m radius, one in 8 m^3, each of which gets a force and a turn
//! rate for a random walk ten times a second; collisions on. Rapier steps at 60 Hz, six times between
//! two commands, and all its bodies are commanded at once. Ours flies the same commands, at once and
//! with a phase of its own for each body.
//!
//! Told is the processor time of the engines alone, for each body and virtual second; the commands are
//! drawn beforehand. The three take turns, window by window, and the least window counts.
//!
//! `cargo bench --bench swarm -- 1000 10000` for other numbers of bodies.

use compare::{Dice, least, numbers, on_one_thread, one_per_8_m3, time_of};
use rapier3d::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, Vector};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Config, Material, Physics, Shape};
use simbeeotic_units::glam::DVec3;

const RADIUS_M: f64 = 0.1;
const MASS_KG: f64 = 0.1;
const SPEED_MAX: f64 = 2.0;
const SURFACE: Material = Material {
    friction: 0.5,
    restitution: 0.3,
};

const PERIOD_NS: u64 = 100_000_000;
const PERIOD_S: f64 = 0.1;
const STEPS: usize = 6;
/// Commands in a window, and windows.
const TICKS: usize = 5;
const WINDOWS: usize = 5;

/// What each body shall do next.
struct Commands {
    dice: Dice,
    wishes: Vec<DVec3>,
    turns: Vec<f64>,
}

impl Commands {
    fn new(count: usize) -> Self {
        Self {
            dice: Dice(2011),
            wishes: vec![DVec3::ZERO; count],
            turns: vec![0.0; count],
        }
    }

    fn draw(&mut self) {
        for (wish, turn) in self.wishes.iter_mut().zip(&mut self.turns) {
            *wish = (*wish + self.dice.vector(0.35)).clamp_length_max(SPEED_MAX);
            *turn = self.dice.within(3.0);
        }
    }
}

/// An engine with the swarm in it.
trait Engine {
    /// Gives each body its command, and lets a tenth of a second pass.
    fn tick(&mut self, commands: &Commands);
    /// What has happened, so that it is seen that something did.
    fn account(&self) -> String;
}

struct Rapier {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
}

impl Rapier {
    fn new(places: &[DVec3]) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::ZERO;
        world.integration_parameters.dt = (PERIOD_S / STEPS as f64) as f32;
        let bodies = places
            .iter()
            .map(|place| {
                let body = RigidBodyBuilder::dynamic()
                    .translation(vector(*place))
                    .can_sleep(false);
                let ball = ColliderBuilder::ball(RADIUS_M as f32)
                    .mass(MASS_KG as f32)
                    .friction(SURFACE.friction as f32)
                    .restitution(SURFACE.restitution as f32);
                world.insert(body, ball).0
            })
            .collect();
        Self { world, bodies }
    }
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

impl Engine for Rapier {
    fn tick(&mut self, commands: &Commands) {
        for (id, handle) in self.bodies.iter().enumerate() {
            let body = &mut self.world.bodies[*handle];
            let push = (vector(commands.wishes[id]) - body.linvel()) / PERIOD_S as f32;
            body.reset_forces(true);
            body.add_force(push * MASS_KG as f32, true);
            body.set_angvel(Vector::new(0.0, 0.0, commands.turns[id] as f32), true);
        }
        for _ in 0..STEPS {
            self.world.step();
        }
    }

    fn account(&self) -> String {
        let pairs = self.world.narrow_phase.contact_pairs();
        let touching = pairs.filter(|pair| pair.has_any_active_contact()).count();
        format!("{touching} pairs touch at the end")
    }
}

struct Ours {
    physics: Physics,
    /// Offsets within the period, and bodies, in order.
    phases: Vec<(u64, u32)>,
    begun: u64,
}

impl Ours {
    fn new(places: &[DVec3], aligned: bool) -> Self {
        let mut physics = Physics::new(Config {
            ground: None,
            ..Config::default()
        });
        for place in places {
            let ball = BodySpec::new(Shape::Sphere { radius_m: RADIUS_M }, MASS_KG);
            let ball = BodySpec {
                p_enu: *place,
                material: SURFACE,
                gravity: false,
                ..ball
            };
            physics.add(ball).expect("a ball is a body");
        }
        let mut dice = Dice(60);
        let phase = |dice: &mut Dice| {
            if aligned { 0 } else { dice.word() % PERIOD_NS }
        };
        let count = places.len() as u32;
        let mut phases: Vec<_> = (0..count).map(|id| (phase(&mut dice), id)).collect();
        phases.sort_unstable();
        Self {
            physics,
            phases,
            begun: 0,
        }
    }
}

impl Engine for Ours {
    fn tick(&mut self, commands: &Commands) {
        let mut contacts = Vec::new();
        for same_time in self.phases.chunk_by(|a, b| a.0 == b.0) {
            let t = SimTime::from_nanos(self.begun + same_time[0].0);
            while let Some(next) = self.physics.next_time().filter(|next| *next <= t) {
                self.physics.advance(next, &mut contacts);
                self.physics.settle(next);
            }
            for (_, id) in same_time {
                let body = BodyId(*id);
                let mut motion = *self.physics.motion(body);
                let push = (commands.wishes[body.index()] - motion.velocity(t)) / PERIOD_S;
                let turn = DVec3::new(0.0, 0.0, commands.turns[body.index()]);
                motion.set_force(t, push * MASS_KG).expect("it is finite");
                motion.set_rate(t, turn).expect("it is finite");
                self.physics.commit(body, t, motion);
            }
            self.physics.settle(t);
        }
        self.begun += PERIOD_NS;
    }

    fn account(&self) -> String {
        let per_s = 1e9 / self.begun as f64;
        let contacts = self.physics.tally().contacts as f64 * per_s;
        format!("{contacts:.0} contacts a second")
    }
}

fn main() {
    on_one_thread();
    println!(
        "free flight, us of processor time for each body and virtual second (ratio to Rapier's)"
    );
    println!(
        "{:>8} {:>14} {:>22} {:>22}",
        "bodies", "Rapier 60 Hz", "ours, aligned", "ours, random phases"
    );
    for count in numbers(&[1_000, 10_000, 100_000]) {
        let places = one_per_8_m3(count, &mut Dice(1982));
        let mut engines: [Box<dyn Engine>; 3] = [
            Box::new(Rapier::new(&places)),
            Box::new(Ours::new(&places, true)),
            Box::new(Ours::new(&places, false)),
        ];
        let mut windows = [const { Vec::new() }; 3];
        let mut commands: [Commands; 3] = std::array::from_fn(|_| Commands::new(count));
        // The first window is for the engines to find their pace.
        for window in 0..=WINDOWS {
            for ((engine, commands), times) in
                engines.iter_mut().zip(&mut commands).zip(&mut windows)
            {
                let mut spent = 0.0;
                for _ in 0..TICKS {
                    commands.draw();
                    spent += time_of(|| engine.tick(commands));
                }
                if window > 0 {
                    times.push(spent);
                }
            }
        }
        let virtual_s = TICKS as f64 * PERIOD_S;
        let [rapier, aligned, random] =
            windows.map(|times| least(&times) * 1e6 / virtual_s / count as f64);
        println!(
            "{count:>8} {rapier:>14.2} {aligned:>13.2} ({:>5.1}x) {random:>13.2} ({:>5.1}x)",
            rapier / aligned,
            rapier / random,
        );
        for (name, engine) in ["Rapier", "aligned", "random"].iter().zip(&engines) {
            println!("{:>8} {name}: {}", "", engine.account());
        }
    }
}
