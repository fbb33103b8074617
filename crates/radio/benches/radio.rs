//! What a round of the simple medium costs, per pair of sender and receiver.
//!
//! `dense`: everybody in a ball of 20 m sends at once, as in the paper's broadcast experiment (range
//! 30 m, so 88 % of the pairs are in range), and everybody collects. `listen`: the same, and each
//! packet is looked at. `by-frame`: one sender at a time, the rest receives.
//!
//! `sparse`: one radio in 100 m², range 30 m, so that each frame reaches 27. `aligned` is a round in which
//! all send, per radio; `random` a round in which one sends while all move at up to 3 m/s and each sends
//! once a second, per frame.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::rng::{Stream, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Medium, Poses, RadioId, RadioSpec, Request, Scratch, SimpleConfig, SimpleMedium, cc2420,
};
use simbeeotic_units::{Attitude, Length, Pose, Position};
use std::hint::black_box;
use std::sync::Arc;

struct Ball(Vec<Position>);

impl Poses for Ball {
    fn pose(&self, owner: ModelId) -> Pose {
        Pose::new(self.0[owner.index()], Attitude::IDENTITY)
    }

    fn position(&self, owner: ModelId) -> Position {
        self.0[owner.index()]
    }
}

/// Moves evenly from where it was.
struct Field {
    start: Vec<[Position; 2]>,
    seconds: f64,
}

impl Poses for Field {
    fn pose(&self, owner: ModelId) -> Pose {
        let [p, v] = self.start[owner.index()].map(|p| p.si());
        Pose::new(Position::from_si(p + v * self.seconds), Attitude::IDENTITY)
    }

    fn odometer(&self) -> Option<Length> {
        Some(Length::from_metres(3.0 * self.seconds))
    }
}

fn field(n: usize) -> (SimpleMedium, Field) {
    let mut stream = Stream::new(1, "bench", "field");
    let side_m = 10.0 * (n as f64).sqrt();
    let start = (0..n).map(|_| {
        let [x, y] = [(); 2].map(|()| stream.uniform_in(0.0..side_m));
        let v = Position::from_si(stream.in_ball(3.0));
        [Position::from_xyz(x, y, 5.0), v]
    });
    let start = start.collect();
    (
        medium(n),
        Field {
            start,
            seconds: 0.0,
        },
    )
}

fn ball(n: usize) -> (SimpleMedium, Ball) {
    let mut stream = Stream::new(1, "bench", "ball");
    let places = (0..n).map(|_| Position::from_si(stream.in_ball(20.0)));
    (medium(n), Ball(places.collect()))
}

fn medium(n: usize) -> SimpleMedium {
    let config = SimpleConfig {
        range_limit: Length::from_metres(30.0),
        ..SimpleConfig::default()
    };
    let mut medium = SimpleMedium::new(config).expect("the settings make sense");
    for bee in 0..n {
        let spec = cc2420::spec(11, 31).expect("channel and level exist");
        let key = path_key(&format!("bee-{bee}/radio"));
        medium
            .add(RadioSpec {
                owner: ModelId(bee as u32),
                key,
                ..spec
            })
            .expect("keys differ");
    }
    medium
}

fn sparse(c: &mut Criterion) {
    let payload: Arc<[u8]> = Arc::from([1, 2, 3, 4]);
    let mut group = c.benchmark_group("sparse");
    group.sample_size(20);
    for n in [10_000, 100_000] {
        let (mut medium, mut poses) = field(n);
        let (mut owners, mut scratch) = (Vec::new(), Scratch::new());
        let mut now = SimTime::ZERO;
        group.throughput(Throughput::Elements(n as u64));
        for collects in [false, true] {
            let name = if collects { "aligned" } else { "aligned-open" };
            group.bench_function(BenchmarkId::new(name, n), |b| {
                b.iter(|| {
                    now = now.saturating_add_nanos(1_000_000_000);
                    for radio in 0..n as u32 {
                        medium.submit(
                            now,
                            Request::broadcast(RadioId(radio), Arc::clone(&payload)),
                        );
                    }
                    medium.open(now, &poses, &mut owners);
                    let heard = owners.iter().filter(|_| collects);
                    heard.fold(0, |hash, o| {
                        hash ^ medium.collect(RadioId(o.0), &poses, &mut scratch).digest()
                    })
                });
            });
        }
        group.throughput(Throughput::Elements(1));
        let (mut rounds, mut sender) = (0_u64, 0);
        group.bench_function(BenchmarkId::new("random", n), |b| {
            b.iter(|| {
                rounds += 1;
                poses.seconds = rounds as f64 / n as f64;
                now = now.saturating_add_nanos(1_000_000_000 / n as u64);
                sender = (sender + 7919) % n as u32;
                medium.submit(
                    now,
                    Request::broadcast(RadioId(sender), Arc::clone(&payload)),
                );
                medium.open(now, &poses, &mut owners);
                owners.iter().fold(0, |hash, o| {
                    hash ^ medium.collect(RadioId(o.0), &poses, &mut scratch).digest()
                })
            });
        });
    }
    group.finish();
}

fn dense(c: &mut Criterion) {
    let payload: Arc<[u8]> = Arc::from([1, 2, 3, 4]);
    for n in [550, 2000, 8192] {
        let (mut medium, poses) = ball(n);
        let (mut owners, mut scratch) = (Vec::new(), Scratch::new());
        let mut now = SimTime::ZERO;
        let mut group = c.benchmark_group("dense");
        group
            .sample_size(10)
            .throughput(Throughput::Elements((n * (n - 1)) as u64));

        let mut round = |medium: &mut SimpleMedium| {
            now = now.saturating_add_nanos(1_000_000_000);
            for radio in 0..n {
                let radio = RadioId(radio as u32);
                medium.submit(now, Request::broadcast(radio, Arc::clone(&payload)));
            }
            medium.open(now, &poses, &mut owners);
            owners.len()
        };
        group.bench_function(BenchmarkId::new("open", n), |b| {
            b.iter(|| round(&mut medium))
        });
        group.bench_function(BenchmarkId::new("open-collect", n), |b| {
            b.iter(|| {
                round(&mut medium);
                let received =
                    (0..n as u32).map(|r| medium.collect(RadioId(r), &poses, &mut scratch).len());
                received.sum::<usize>()
            });
        });
        group.bench_function(BenchmarkId::new("open-collect-digest", n), |b| {
            b.iter(|| {
                round(&mut medium);
                (0..n as u32).fold(0, |hash, r| {
                    hash ^ medium.collect(RadioId(r), &poses, &mut scratch).digest()
                })
            });
        });
        group.bench_function(BenchmarkId::new("open-collect-listen", n), |b| {
            b.iter(|| {
                round(&mut medium);
                let mut bytes = 0;
                for radio in 0..n as u32 {
                    for packet in medium.collect(RadioId(radio), &poses, &mut scratch) {
                        bytes += black_box(packet).payload().len();
                    }
                }
                bytes
            });
        });
        group.finish();
    }
}

fn by_frame(c: &mut Criterion) {
    let payload: Arc<[u8]> = Arc::from([1, 2, 3, 4]);
    let mut group = c.benchmark_group("by-frame");
    for n in [550, 2000, 8192] {
        let (mut medium, poses) = ball(n);
        let (mut owners, mut scratch) = (Vec::new(), Scratch::new());
        let mut now = SimTime::ZERO;
        let mut sender = 0;
        group.throughput(Throughput::Elements(n as u64 - 1));
        group.bench_function(BenchmarkId::new("open-collect", n), |b| {
            b.iter(|| {
                now = now.saturating_add_nanos(1_000_000);
                sender = (sender + 1) % n as u32;
                medium.submit(
                    now,
                    Request::broadcast(RadioId(sender), Arc::clone(&payload)),
                );
                medium.open(now, &poses, &mut owners);
                let heard = owners
                    .iter()
                    .map(|o| medium.collect(RadioId(o.0), &poses, &mut scratch).len());
                heard.sum::<usize>()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, dense, by_frame, sparse);
criterion_main!(benches);
