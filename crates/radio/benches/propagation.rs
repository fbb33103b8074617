//! What a row of links costs, per link: each model of the path, shadowing, and fading.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::{Stream, mix};
use simbeeotic_radio::{
    Composite, Fading, FrameKeys, FreeSpace, Links, LogDistance, Nakagami, Propagation, Rayleigh,
    Rician, Role, Shadowing, TwoRay, TwoRayExact,
};
use simbeeotic_units::{Decibels, Frequency, Length};
use std::hint::black_box;
use std::sync::Arc;

const N: usize = 256;

fn rows(c: &mut Criterion) {
    let mut stream = Stream::new(1, "bench", "rows");
    let places: Vec<[f32; 3]> = (0..N)
        .map(|_| stream.in_ball(50.0).as_vec3().to_array())
        .collect();
    let axis = |i: usize| -> Vec<f32> { places.iter().map(|p| p[i] + 60.0).collect() };
    let far = [axis(0), axis(1), axis(2)];
    let near = [60.0f32; 3];
    let square = |j: usize| {
        (0..3)
            .map(|i| (far[i][j] - near[i]) * (far[i][j] - near[i]))
            .sum()
    };
    let squares: Vec<f32> = (0..N).map(square).collect();
    let keys: Vec<u64> = (0..N as u64).map(mix).collect();
    let links = Links {
        frequency: Frequency::from_megahertz(2405.0),
        time: SimTime::ZERO,
        near_is: Role::Transmitter,
        near_enu_m: near,
        near_key: 7,
        far_enu_m: [&far[0], &far[1], &far[2]],
        far_keys: &keys,
        distances_squared_m2: &squares,
        frames: FrameKeys::One(mix(9)),
    };
    let exponent = |exponent: f64| LogDistance {
        exponent,
        ..LogDistance::default()
    };
    let on = |shadowing: Option<Shadowing>, fading: Option<Arc<dyn Fading>>| Composite {
        path: Arc::new(FreeSpace),
        shadowing,
        fading,
    };
    let (sigma, distance) = (Decibels::from_db(4.0), Length::from_metres(10.0));
    let models: [(&str, Box<dyn Propagation>); 10] = [
        ("free-space", Box::new(FreeSpace)),
        ("log-distance 3", Box::new(exponent(3.0))),
        ("log-distance 2.7", Box::new(exponent(2.7))),
        ("two-ray", Box::new(TwoRay::default())),
        ("two-ray-exact", Box::new(TwoRayExact::default())),
        (
            "shadowing field",
            Box::new(on(Some(Shadowing::field(1, sigma, distance)), None)),
        ),
        (
            "shadowing links",
            Box::new(on(Some(Shadowing::links(1, sigma)), None)),
        ),
        ("rayleigh", Box::new(on(None, Some(Arc::new(Rayleigh))))),
        (
            "rician",
            Box::new(on(None, Some(Arc::new(Rician::new(sigma))))),
        ),
        (
            "nakagami",
            Box::new(on(None, Some(Arc::new(Nakagami::ns3())))),
        ),
    ];
    let mut group = c.benchmark_group("row");
    group.throughput(Throughput::Elements(N as u64));
    let mut gains = vec![0.0; N];
    for (name, model) in &models {
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| {
                model.gains(black_box(&links), &mut gains);
                gains[N - 1]
            });
        });
    }
    group.finish();
}

criterion_group!(benches, rows);
criterion_main!(benches);
