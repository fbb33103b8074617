//! A heap: boxes of 0.2 m fall on the ground in layers, settle, sleep, and are hit by a ball of 5 kg at
//! 10 m/s. Rapier is stepped at 60 Hz, and, for what it is worth, at 240 Hz; ours steps bodies in
//! lasting contact at 240 Hz, within worlds of Rapier's in double precision, and nothing else.
//!
//! Told is the processor time of each part, the least of several runs in turns, and how many boxes
//! move at the end of it.
//!
//! `cargo bench --bench pile -- 125 1000` for other numbers of boxes.

use compare::{Dice, numbers, on_one_thread, time_of};
use rapier3d::prelude::{ColliderBuilder, PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, Vector};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Config, Material, Physics, Shape};
use simbeeotic_units::constants::STANDARD_GRAVITY;
use simbeeotic_units::glam::DVec3;

const HALF_M: f64 = 0.1;
const BOX_KG: f64 = 1.0;
const BALL_M: f64 = 0.2;
const BALL_KG: f64 = 5.0;
const BALL_SPEED: f64 = 10.0;
/// Where the ball waits for its time, east of the heap.
const BALL_AWAY_M: f64 = 8.0;
const SURFACE: Material = Material {
    friction: 0.5,
    restitution: 0.0,
};
const RUNS: usize = 2;
/// What is measured, and for how long.
const PARTS: [(&str, u64); 3] = [("settles", 10), ("lies", 10), ("is hit", 5)];
/// In which of them the ball is thrown.
const HIT: usize = 2;

/// Layers of boxes with a little air between them.
fn layers(count: usize) -> Vec<DVec3> {
    let side = (1..).find(|side| side * side * side >= count).unwrap_or(1);
    let mut dice = Dice(1000);
    let middle = 0.5 * (side as f64 - 1.0);
    (0..count)
        .map(|id| {
            let [x, y, layer] = [id % side, id / side % side, id / side / side].map(|c| c as f64);
            let shift = dice.vector(0.01);
            let level = DVec3::new(
                0.23 * (x - middle),
                0.23 * (y - middle),
                0.15 + 0.25 * layer,
            );
            level + shift
        })
        .collect()
}

trait Engine {
    fn throw(&mut self);
    fn run(&mut self, seconds: u64);
    /// Number of boxes that do not rest.
    fn moving(&self) -> usize;
}

struct Rapier {
    world: PhysicsWorld,
    steps_per_s: u64,
    ball: RigidBodyHandle,
}

fn vector(v: DVec3) -> Vector {
    Vector::new(v.x as f32, v.y as f32, v.z as f32)
}

impl Rapier {
    fn new(places: &[DVec3], steps_per_s: u64) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = vector(DVec3::new(0.0, 0.0, -STANDARD_GRAVITY.get()));
        world.integration_parameters.dt = 1.0 / steps_per_s as f32;
        let surface = |collider: ColliderBuilder, mass_kg: f64| {
            collider
                .mass(mass_kg as f32)
                .friction(SURFACE.friction as f32)
                .restitution(SURFACE.restitution as f32)
        };
        let ground = ColliderBuilder::cuboid(100.0, 100.0, 1.0);
        let ground = ground.translation(Vector::new(0.0, 0.0, -1.0));
        world.insert_collider(surface(ground, 0.0), None);
        for place in places {
            let half = HALF_M as f32;
            let body = RigidBodyBuilder::dynamic().translation(vector(*place));
            let cube = ColliderBuilder::cuboid(half, half, half);
            world.insert(body, surface(cube, BOX_KG));
        }
        let waiting = RigidBodyBuilder::dynamic()
            .translation(vector(DVec3::new(BALL_AWAY_M, 0.0, 0.5)))
            .gravity_scale(0.0);
        let ball = ColliderBuilder::ball(BALL_M as f32);
        let (ball, _) = world.insert(waiting, surface(ball, BALL_KG));
        Self {
            world,
            steps_per_s,
            ball,
        }
    }
}

impl Engine for Rapier {
    fn throw(&mut self) {
        let ball = &mut self.world.bodies[self.ball];
        ball.set_linvel(Vector::new(-BALL_SPEED as f32, 0.0, 0.0), true);
    }

    fn run(&mut self, seconds: u64) {
        for _ in 0..seconds * self.steps_per_s {
            self.world.step();
        }
    }

    fn moving(&self) -> usize {
        let awake = |handle: &RigidBodyHandle| *handle != self.ball;
        self.world.islands.active_bodies().filter(awake).count()
    }
}

struct Ours {
    physics: Physics,
    now: SimTime,
    ball: BodyId,
}

impl Ours {
    fn new(places: &[DVec3]) -> Self {
        let mut physics = Physics::new(Config {
            ground: Some(SURFACE),
            ..Config::default()
        });
        let cube = Shape::Box {
            half_m: DVec3::splat(HALF_M),
        };
        for place in places {
            let spec = BodySpec {
                p_enu: *place,
                material: SURFACE,
                ..BodySpec::new(cube.clone(), BOX_KG)
            };
            physics.add(spec).expect("a box is a body");
        }
        let ball = BodySpec {
            p_enu: DVec3::new(BALL_AWAY_M, 0.0, 0.5),
            material: SURFACE,
            gravity: false,
            ..BodySpec::new(Shape::Sphere { radius_m: BALL_M }, BALL_KG)
        };
        let ball = physics.add(ball).expect("a ball is a body");
        Self {
            physics,
            now: SimTime::ZERO,
            ball,
        }
    }
}

impl Engine for Ours {
    fn throw(&mut self) {
        let mut motion = *self.physics.motion(self.ball);
        motion
            .set_velocity(self.now, DVec3::new(-BALL_SPEED, 0.0, 0.0))
            .expect("it is finite");
        self.physics.commit(self.ball, self.now, motion);
        self.physics.settle(self.now);
    }

    fn run(&mut self, seconds: u64) {
        let mut contacts = Vec::new();
        let end = SimTime::from_nanos(self.now.nanos() + seconds * 1_000_000_000);
        while let Some(next) = self.physics.next_time().filter(|next| *next <= end) {
            self.physics.advance(next, &mut contacts);
            self.physics.settle(next);
            contacts.clear();
        }
        self.now = end;
    }

    fn moving(&self) -> usize {
        let moves = |id: &u32| self.physics.motion(BodyId(*id)).velocity(self.now) != DVec3::ZERO;
        (0..self.ball.0).filter(moves).count()
    }
}

fn main() {
    on_one_thread();
    println!("a heap of boxes, s of processor time (and boxes that move at the end)");
    let names = ["Rapier 60 Hz", "Rapier 240 Hz", "ours"];
    for count in numbers(&[1_000]) {
        let places = layers(count);
        let mut least = [[f64::INFINITY; PARTS.len()]; 3];
        let mut moving = [[0; PARTS.len()]; 3];
        for _ in 0..RUNS {
            let mut engines: [Box<dyn Engine>; 3] = [
                Box::new(Rapier::new(&places, 60)),
                Box::new(Rapier::new(&places, 240)),
                Box::new(Ours::new(&places)),
            ];
            for (part, (_, seconds)) in PARTS.into_iter().enumerate() {
                for (place, engine) in engines.iter_mut().enumerate() {
                    let spent = time_of(|| {
                        if part == HIT {
                            engine.throw();
                        }
                        engine.run(seconds);
                    });
                    least[place][part] = least[place][part].min(spent);
                    moving[place][part] = engine.moving();
                }
            }
        }
        print!("{count:>8} boxes{:>8}", "");
        for name in names {
            print!(" {name:>18}");
        }
        println!();
        for (part, (name, seconds)) in PARTS.into_iter().enumerate() {
            print!("{name:>14} {:>7}", format!("{seconds} s"));
            for place in 0..names.len() {
                let figure = format!("{:.4} ({})", least[place][part], moving[place][part]);
                print!(" {figure:>18}");
            }
            println!();
        }
    }
}
