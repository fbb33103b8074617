//! What it costs to look: rays and neighbours among bodies that move, one in 8 m^3, whatever their number.
//!
//! criterion's `elem/s` counts rays (of 20 m, anywhere among the bodies, in any direction) or questions
//! who is within 5 m.
//!
//! - `balls`, `boxes`: radius 0.1 m, half edges of 0.1 m; they fly at up to 2 m/s, the boxes turn.
//! - `first`: 10,000 rays right after a listing, with what the first of them has to prepare.
//! - `build`: the first ray alone; here `elem/s` counts bodies.
//! - `camera`: one picture of 160 x 120 rays, 90 degrees wide, 100 m far, on the ground among 1,000
//!   objects: boxes, walls, cylinders, cones, capsules, balls, people of seven boxes, and bees that fly.
//! - `ring`: 10,000 bees that fly among 1,000 obstacles look around, with 8 level rays of 4 m each.

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::{SimTime, rng::Stream};
use simbeeotic_physics::{BodySpec, Config, Fan, Hit, Kind, Mobility, Physics, Ray, Sees, Shape};
use simbeeotic_units::glam::{DQuat, DVec3};
use simbeeotic_units::{Angle, Attitude, Yaw};
use std::cell::RefCell;
use std::hint::black_box;

const RAYS: u32 = 10_000;
const RANGE_M: f64 = 20.0;
const LIST_PERIOD_NS: u64 = 100_000_000;

struct Scene {
    physics: Physics,
    now: SimTime,
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
}

impl Scene {
    fn new(count: u32, shape: &Shape) -> Self {
        let mut stream = Stream::new(1982, "physics", "rays");
        let mut physics = Physics::new(Config {
            ground: None,
            ..Config::default()
        });
        let side = libm::cbrt(f64::from(count)).ceil() as u32;
        for id in 0..count {
            let cell = [id / side / side, id / side % side, id % side].map(f64::from);
            let jitter = [(); 3].map(|()| stream.uniform_in(-0.8..0.8));
            let spec = BodySpec {
                p_enu: DVec3::from_array(cell) * 2.0 + DVec3::from_array(jitter),
                v_enu: stream.in_ball(2.0),
                w_flu: stream.in_ball(3.0),
                gravity: false,
                ..BodySpec::new(shape.clone(), 0.1)
            };
            physics.add(spec).expect("a bee is a body");
        }
        let size = 2.0 * f64::from(side);
        let rays = (0..RAYS).map(|_| Ray {
            origin_enu: DVec3::from_array([(); 3].map(|()| stream.uniform_in(0.0..size))),
            direction_enu: stream.in_ball(1.0),
            range_m: RANGE_M,
        });
        Self::of(physics, rays.collect())
    }

    fn of(physics: Physics, rays: Vec<Ray>) -> Self {
        let mut scene = Self {
            physics,
            now: SimTime::ZERO,
            rays,
            hits: Vec::new(),
        };
        // Bodies that are not listed are, from the second listing on.
        scene.look();
        scene.pass(LIST_PERIOD_NS);
        scene.pass(LIST_PERIOD_NS / 2);
        scene
    }

    fn pass(&mut self, nanos: u64) {
        let until = self.now.saturating_add_nanos(nanos);
        let mut contacts = Vec::new();
        while let Some(next) = self.physics.next_time().filter(|next| *next <= until) {
            self.physics.advance(next, &mut contacts);
            self.physics.settle(next);
        }
        self.physics.advance(until, &mut contacts);
        self.physics.settle(until);
        self.now = until;
    }

    fn look(&mut self) {
        self.hits.clear();
        self.physics
            .cast_rays(&self.rays, self.now, &Sees::default(), &mut self.hits)
            .expect("the rays are finite");
        black_box(&self.hits);
    }
}

/// How many pixels stand in one row of a picture.
const COLUMNS: usize = 160;

impl Scene {
    /// So many rays at a time, as bees do that look one after the other.
    fn look_each(&mut self, count: usize) {
        for rays in self.rays.chunks(count) {
            self.hits.clear();
            self.physics
                .cast_rays(rays, self.now, &Sees::default(), &mut self.hits)
                .expect("the rays are finite");
            black_box(&self.hits);
        }
    }

    /// The rays as a picture: all from the first one's origin.
    fn look_through(&mut self, directions_enu: &[DVec3]) {
        self.hits.clear();
        let fan = Fan {
            origin_enu: self.rays[0].origin_enu,
            directions_enu,
            columns: COLUMNS,
            range_m: self.rays[0].range_m,
        };
        self.physics
            .cast_fan(&fan, self.now, &Sees::default(), &mut self.hits)
            .expect("the rays are finite");
        black_box(&self.hits);
    }
}

fn shapes() -> [(&'static str, Shape); 2] {
    let half_m = DVec3::splat(0.1);
    [
        ("balls", Shape::Sphere { radius_m: 0.1 }),
        ("boxes", Shape::Box { half_m }),
    ]
}

fn rays(c: &mut Criterion) {
    let mut group = c.benchmark_group("rays");
    group.sample_size(10);
    for (name, shape) in shapes() {
        for count in [1_000, 10_000, 100_000] {
            group.throughput(Throughput::Elements(u64::from(RAYS)));
            let mut scene = None;
            group.bench_function(BenchmarkId::new(name, count), |b| {
                let scene = scene.get_or_insert_with(|| Scene::new(count, &shape));
                b.iter(|| scene.look());
            });
            let scene = RefCell::new(scene);
            let listed = || {
                let mut scene = scene.borrow_mut();
                let scene = scene.get_or_insert_with(|| Scene::new(count, &shape));
                scene.pass(LIST_PERIOD_NS);
            };
            group.bench_function(BenchmarkId::new(format!("{name}/first"), count), |b| {
                let look = |()| scene.borrow_mut().as_mut().map(Scene::look);
                b.iter_batched(listed, look, BatchSize::PerIteration);
            });
            group.throughput(Throughput::Elements(u64::from(count)));
            group.bench_function(BenchmarkId::new(format!("{name}/build"), count), |b| {
                let look = |()| {
                    let scene = scene.borrow();
                    let scene = scene.as_ref().expect("it was made for the listing");
                    scene
                        .physics
                        .cast_ray(&scene.rays[0], scene.now, &Sees::default())
                };
                b.iter_batched(listed, look, BatchSize::PerIteration);
            });
        }
    }
    group.finish();
}

fn near(c: &mut Criterion) {
    let mut group = c.benchmark_group("near");
    group.sample_size(10);
    for count in [1_000, 10_000, 100_000] {
        group.throughput(Throughput::Elements(u64::from(RAYS)));
        let mut scene = None;
        group.bench_function(BenchmarkId::new("balls", count), |b| {
            let scene = scene.get_or_insert_with(|| Scene::new(count, &shapes()[0].1));
            let mut found = Vec::new();
            b.iter(|| {
                for ray in &scene.rays {
                    found.clear();
                    scene
                        .physics
                        .near(ray.origin_enu, 5.0, scene.now, &mut found);
                    black_box(&found);
                }
            });
        });
    }
    group.finish();
}

fn yaw(angle: f64) -> DQuat {
    Attitude::from_yaw(Yaw::new(Angle::si(angle))).quat()
}

/// A body that stands on the ground, somewhere in a square of 100 m.
fn standing(shape: Shape, height_m: f64, kind: Kind, stream: &mut Stream) -> BodySpec {
    let place = DVec3::new(
        stream.uniform_in(-50.0..50.0),
        stream.uniform_in(-50.0..50.0),
        0.5 * height_m,
    );
    let yaw = yaw(stream.uniform_in(0.0..6.0));
    BodySpec {
        p_enu: place,
        attitude: Attitude::from_unit_quat(yaw),
        inertia_kg_m2: DVec3::ONE,
        mobility: Mobility::Fixed,
        kind: Some(kind),
        ..BodySpec::new(shape, 1.0)
    }
}

/// The seven boxes of a person of 1.8 m: where, and half of how wide and high.
const PERSON: [[f64; 4]; 7] = [
    [-0.15, 0.415, 0.115, 0.415],
    [0.15, 0.415, 0.115, 0.415],
    [0.0, 1.108, 0.27, 0.277],
    [-0.42, 0.969, 0.08, 0.415],
    [0.42, 0.969, 0.08, 0.415],
    [0.0, 1.454, 0.04, 0.069],
    [0.0, 1.662, 0.115, 0.138],
];

fn person(physics: &mut Physics, stream: &mut Stream) {
    let foot = standing(Shape::Plane, 0.0, Kind::Person, stream);
    for [x, z, half_x, half_z] in PERSON {
        let shape = Shape::Box {
            half_m: DVec3::new(half_x, 0.135, half_z),
        };
        let offset = foot.attitude.quat() * DVec3::new(x, 0.0, z);
        let part = BodySpec {
            shape,
            p_enu: foot.p_enu + offset,
            ..foot.clone()
        };
        physics.add(part).expect("a person is a body");
    }
}

/// So many things of all kinds on the ground; every tenth is a person.
fn obstacles(physics: &mut Physics, count: u32, stream: &mut Stream) {
    for id in 0..count {
        let size = stream.uniform_in(0.5..2.0);
        let (shape, height_m, kind) = match id % 10 {
            0..3 => {
                let half_m = DVec3::new(size, stream.uniform_in(0.5..2.0), size) * 0.5;
                (Shape::Box { half_m }, size, Kind::Obstacle)
            }
            3 | 4 => {
                let half_m = DVec3::new(2.0 * size, 0.1, 1.25);
                (Shape::Box { half_m }, 2.5, Kind::Structure)
            }
            5 | 6 => {
                let (radius_m, half_height_m) = (0.2 * size, size);
                let shape = Shape::Cylinder {
                    radius_m,
                    half_height_m,
                };
                (shape, 2.0 * size, Kind::Obstacle)
            }
            7 => {
                let radius_m = 0.5 * size;
                (Shape::Sphere { radius_m }, size, Kind::Obstacle)
            }
            8 => {
                let (radius_m, half_height_m) = (0.3 * size, 0.5 * size);
                let shape = if id % 20 == 8 {
                    Shape::Cone {
                        radius_m,
                        half_height_m,
                    }
                } else {
                    Shape::Capsule {
                        radius_m,
                        half_height_m,
                    }
                };
                (shape, size, Kind::Obstacle)
            }
            _ => {
                person(physics, stream);
                continue;
            }
        };
        let body = standing(shape, height_m, kind, stream);
        physics.add(body).expect("an obstacle is a body");
    }
}

/// So many bees above the square, which keep their height.
fn bees(physics: &mut Physics, count: u32, shape: &Shape, stream: &mut Stream) -> Vec<DVec3> {
    (0..count)
        .map(|_| {
            let p_enu = DVec3::new(
                stream.uniform_in(-50.0..50.0),
                stream.uniform_in(-50.0..50.0),
                stream.uniform_in(0.5..5.0),
            );
            let v_enu = stream.in_ball(2.0).truncate().extend(0.0);
            let spec = BodySpec {
                p_enu,
                v_enu,
                w_flu: stream.in_ball(3.0),
                gravity: false,
                ..BodySpec::new(shape.clone(), 0.1)
            };
            physics.add(spec).expect("a bee is a body");
            p_enu
        })
        .collect()
}

/// One picture from each corner of the square towards its middle.
fn camera(c: &mut Criterion) {
    let mut group = c.benchmark_group("camera");
    group.sample_size(20);
    group.throughput(Throughput::Elements(160 * 120));
    for (name, corner) in [
        ("corner", DVec3::new(-52.0, -52.0, 2.0)),
        ("middle", DVec3::new(0.0, 0.0, 1.5)),
        ("above", DVec3::new(-60.0, -60.0, 40.0)),
    ] {
        let mut stream = Stream::new(1982, "physics", "camera");
        let mut physics = Physics::new(Config::default());
        obstacles(&mut physics, 900, &mut stream);
        let half_m = DVec3::new(0.1, 0.1, 0.05);
        bees(&mut physics, 100, &Shape::Box { half_m }, &mut stream);
        let forward = (DVec3::new(20.0, 20.0, 0.0) - corner).normalize();
        let left = DVec3::Z.cross(forward).normalize();
        let up = forward.cross(left);
        let rays = (0..120 * 160).map(|pixel| {
            let right = (f64::from(pixel % 160) + 0.5) / 80.0 - 1.0;
            let down = (f64::from(pixel / 160) + 0.5) / 80.0 - 0.75;
            Ray {
                origin_enu: corner,
                direction_enu: forward - left * right - up * down,
                range_m: 100.0,
            }
        });
        let mut scene = Scene::of(physics, rays.collect());
        let directions: Vec<_> = scene.rays.iter().map(|ray| ray.direction_enu).collect();
        group.bench_function(format!("{name}/list"), |b| b.iter(|| scene.look()));
        group.bench_function(name, |b| b.iter(|| scene.look_through(&directions)));
    }
    group.finish();
}

/// A ring of eight rays for each of 10,000 bees.
fn ring(c: &mut Criterion) {
    let mut group = c.benchmark_group("ring");
    group.sample_size(10);
    group.throughput(Throughput::Elements(80_000));
    let mut stream = Stream::new(1982, "physics", "ring");
    let mut physics = Physics::new(Config::default());
    let bees = bees(
        &mut physics,
        10_000,
        &Shape::Sphere { radius_m: 0.05 },
        &mut stream,
    );
    obstacles(&mut physics, 1_000, &mut stream);
    let rays = bees.iter().flat_map(|p| {
        (0..8).map(|k| Ray {
            origin_enu: *p,
            direction_enu: yaw(f64::from(k) * 0.785) * DVec3::X,
            range_m: 4.0,
        })
    });
    let mut scene = Scene::of(physics, rays.collect());
    group.bench_function("8", |b| b.iter(|| scene.look_each(8)));
    group.bench_function("8/alone", |b| {
        b.iter(|| {
            for ray in &scene.rays {
                let hit = scene.physics.cast_ray(ray, scene.now, &Sees::default());
                black_box(hit.expect("the rays are finite"));
            }
        });
    });
    group.finish();
}

criterion_group!(benches, camera, ring, rays, near);
criterion_main!(benches);
