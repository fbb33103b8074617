//! What it costs to look: rays and neighbours among bodies that move, one in 8 m^3, whatever their number.
//!
//! criterion's `elem/s` counts rays (of 20 m, anywhere among the bodies, in any direction) or questions
//! who is within 5 m.
//!
//! - `balls`, `boxes`: radius 0.1 m, half edges of 0.1 m; they fly at up to 2 m/s, the boxes turn.
//! - `first`: 10,000 rays right after a listing, with what the first of them has to prepare.
//! - `build`: the first ray alone; here `elem/s` counts bodies.

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::{SimTime, rng::Stream};
use simbeeotic_physics::{BodySpec, Config, Hit, Physics, Ray, Sees, Shape};
use simbeeotic_units::glam::DVec3;
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
        let rays = rays.collect();
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

criterion_group!(benches, rays, near);
criterion_main!(benches);
