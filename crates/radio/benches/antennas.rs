//! What antennas with a direction cost, per pair of sender and receiver, in the simple medium, and by
//! themselves.
//!
//! `dense`: 550 radios in a ball of 20 m, in all attitudes, everybody sends and everybody collects.
//! `gain`: one antenna, many directions; `exact` is f64 and decibels, `fast` what media ask.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{DVec3, Vec3};
use simbeeotic_kernel::rng::{Stream, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Antenna, Cosine, HalfWaveDipole, Isotropic, Medium, Patch, Pattern, Poses, RadioId, RadioSpec,
    Request, Scratch, SimpleConfig, SimpleMedium, cc2420,
};
use simbeeotic_units::{Angle, Attitude, Decibels, Length, Pose, Position};
use std::hint::black_box;
use std::sync::Arc;

struct Ball(Vec<Pose>);

impl Poses for Ball {
    fn pose(&self, owner: ModelId) -> Pose {
        self.0[owner.index()]
    }
}

fn antennas() -> Vec<(&'static str, Arc<dyn Antenna>)> {
    let degrees = Angle::from_degrees;
    let cosine = Cosine::new(degrees(120.0), degrees(60.0), Decibels::ZERO);
    let mut table = String::from("azimuth,elevation,gain\n");
    for azimuth in (0..360).step_by(5) {
        for elevation in (-90..=90).step_by(5) {
            table += &format!("{azimuth},{elevation},{}\n", (azimuth + elevation) % 7);
        }
    }
    let pattern = Pattern::read(&table, Decibels::ZERO).expect("a whole grid");
    vec![
        ("isotropic", Arc::new(Isotropic::default())),
        ("half-wave-dipole", Arc::new(HalfWaveDipole::default())),
        ("patch", Arc::new(Patch::default())),
        ("cosine", Arc::new(cosine.expect("good widths"))),
        ("pattern", Arc::new(pattern)),
    ]
}

fn dense(c: &mut Criterion) {
    const N: usize = 550;
    let mut group = c.benchmark_group("dense");
    group
        .sample_size(10)
        .throughput(Throughput::Elements((N * (N - 1)) as u64));
    for (name, antenna) in antennas() {
        let mut stream = Stream::new(1, "bench", "ball");
        let poses = Ball(
            (0..N)
                .map(|_| {
                    let place = Position::from_si(stream.in_ball(20.0));
                    let turn = Attitude::about(stream.unit_vector(), Angle::si(2.0));
                    Pose::new(place, turn)
                })
                .collect(),
        );
        let config = SimpleConfig {
            range_limit: Length::from_metres(30.0),
            ..SimpleConfig::default()
        };
        let mut medium = SimpleMedium::new(config).expect("the settings make sense");
        for bee in 0..N {
            let spec = RadioSpec {
                owner: ModelId(bee as u32),
                key: path_key(&format!("bee-{bee}/radio")),
                antenna: Arc::clone(&antenna),
                ..cc2420::spec(11, 31).expect("channel and level exist")
            };
            medium.add(spec).expect("keys differ");
        }
        let payload: Arc<[u8]> = Arc::from([1, 2, 3, 4]);
        let (mut owners, mut scratch) = (Vec::new(), Scratch::new());
        let mut now = SimTime::ZERO;
        group.bench_function(BenchmarkId::new("open-collect", name), |b| {
            b.iter(|| {
                now = now.saturating_add_nanos(1_000_000_000);
                for radio in 0..N as u32 {
                    let request = Request::broadcast(RadioId(radio), Arc::clone(&payload));
                    medium.submit(now, request);
                }
                medium.open(now, &poses, &mut owners);
                let heard =
                    (0..N as u32).map(|r| medium.collect(RadioId(r), &poses, &mut scratch).len());
                heard.sum::<usize>()
            });
        });
    }
    group.finish();
}

fn gain(c: &mut Criterion) {
    let mut stream = Stream::new(1, "bench", "directions");
    let exact: Vec<DVec3> = (0..4096).map(|_| stream.unit_vector()).collect();
    let fast: Vec<Vec3> = exact.iter().map(|d| d.as_vec3()).collect();
    let mut group = c.benchmark_group("gain");
    group
        .sample_size(20)
        .throughput(Throughput::Elements(exact.len() as u64));
    for (name, antenna) in antennas() {
        group.bench_function(BenchmarkId::new("exact", name), |b| {
            b.iter(|| {
                let gains = exact.iter().map(|&d| black_box(&antenna).gain(d).ratio());
                gains.sum::<f64>()
            });
        });
        group.bench_function(BenchmarkId::new("fast", name), |b| {
            b.iter(|| {
                let gains = fast.iter().map(|&d| black_box(&antenna).gain_linear(d));
                gains.sum::<f32>()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, dense, gain);
criterion_main!(benches);
