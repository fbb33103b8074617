//! What lasting contact costs: a step of an island, and the making of one.
//!
//! `cargo bench -p simbeeotic-physics --bench islands`

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::SimTime;
use simbeeotic_physics::{BodyId, BodySpec, Config, Material, Physics, Shape};
use simbeeotic_units::glam::DVec3;
use std::hint::black_box;

const HALF_M: f64 = 0.1;
const STEPS: u64 = 24;

fn cube(p_enu: DVec3) -> BodySpec {
    let half_m = DVec3::splat(HALF_M);
    BodySpec {
        p_enu,
        material: Material {
            friction: 0.2,
            restitution: 0.0,
        },
        ..BodySpec::new(Shape::Box { half_m }, 1.0)
    }
}

fn run(physics: &mut Physics, until: SimTime) {
    let mut contacts = Vec::new();
    while let Some(t) = physics.next_time().filter(|t| *t <= until) {
        physics.advance(t, &mut contacts);
        physics.settle(t);
        contacts.clear();
    }
}

/// Boxes on the ground, side by side and drawing together, that slide as one: none of them rests.
fn sliding(count: usize, side: usize) -> Physics {
    let mut physics = Physics::new(Config::default());
    for i in 0..count {
        let place = DVec3::new(
            (i % side) as f64 * 2.001 * HALF_M,
            (i / side) as f64 * 2.001 * HALF_M,
            HALF_M,
        );
        let spec = BodySpec {
            v_enu: DVec3::X * 2.0 - place.with_z(0.0) * 0.1,
            ..cube(place)
        };
        physics.add(spec).expect("a box");
    }
    run(&mut physics, SimTime::from_millis(100));
    physics
}

fn step(c: &mut Criterion) {
    let mut group = c.benchmark_group("island step, per body");
    for (count, side) in [(1, 1), (2, 2), (100, 10), (1000, 32)] {
        group.sample_size(10);
        group.throughput(Throughput::Elements(count as u64 * STEPS));
        group.bench_function(BenchmarkId::from_parameter(count), |b| {
            b.iter_batched_ref(
                || sliding(count, side),
                |physics| {
                    run(physics, SimTime::from_millis(200));
                    black_box(physics.motion(BodyId(0)).start());
                },
                BatchSize::PerIteration,
            );
        });
    }
    group.finish();
}

/// Boxes that land one by one, far apart: each makes an island and rests.
fn landing(c: &mut Criterion) {
    const COUNT: u64 = 1000;
    let mut group = c.benchmark_group("island made, and first two steps");
    group.sample_size(10);
    group.throughput(Throughput::Elements(COUNT));
    group.bench_function("box", |b| {
        b.iter_batched_ref(
            || {
                let mut physics = Physics::new(Config::default());
                for i in 0..COUNT {
                    let place = DVec3::new(i as f64, 0.0, HALF_M + 1e-4);
                    physics.add(cube(place)).expect("a box");
                }
                physics.settle(SimTime::ZERO);
                physics
            },
            |physics| run(physics, SimTime::from_millis(8)),
            BatchSize::PerIteration,
        );
    });
    group.finish();
}

criterion_group!(benches, step, landing);
criterion_main!(benches);
