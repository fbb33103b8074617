//! What a frame costs with air time, medium access and interference, per pair of sender and receiver.
//!
//! The paper's broadcast experiment on one real channel: everybody in a ball of 20 m, each broadcasts 4
//! bytes once a second at a time of its own; from some 500 nodes on the channel is full. One
//! iteration is one virtual second. Elements are frames sent times possible receivers, about.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::rng::{Stream, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Ieee802154Config, Ieee802154Medium, LogDistance, Medium, Poses, RadioId, RadioSpec, Request,
    Scratch, cc2420,
};
use simbeeotic_units::{Attitude, Pose, Position, PowerLevel};
use std::sync::Arc;

struct Ball(Vec<Position>);

impl Poses for Ball {
    fn pose(&self, owner: ModelId) -> Pose {
        Pose::new(self.0[owner.index()], Attitude::IDENTITY)
    }

    fn positions(&self, _: &[ModelId], positions: &mut Vec<Position>) {
        positions.extend_from_slice(&self.0);
    }
}

struct Swarm {
    medium: Ieee802154Medium,
    poses: Ball,
    /// When each node speaks in a second, ns, ascending.
    phases: Vec<(u64, u32)>,
    second: u64,
    received: u64,
    rounds: u64,
}

impl Swarm {
    fn new(n: usize) -> Self {
        let mut stream = Stream::new(1, "bench", "ball");
        let places = (0..n).map(|_| Position::from_si(stream.in_ball(20.0)));
        let poses = Ball(places.collect());
        let config = Ieee802154Config {
            propagation: Arc::new(LogDistance::ns3()),
            noise: Some(PowerLevel::from_dbm(-98.0)),
            ..Ieee802154Config::ns3()
        };
        let mut medium = Ieee802154Medium::new(config).expect("the settings make sense");
        for bee in 0..n {
            let spec = cc2420::spec(11, 31).expect("channel and level exist");
            let key = path_key(&format!("bee-{bee}/radio"));
            let owner = ModelId(bee as u32);
            let spec = RadioSpec { owner, key, ..spec };
            medium.add(spec).expect("keys differ");
        }
        let mut phases: Vec<(u64, u32)> = (0..n as u32)
            .map(|bee| ((stream.uniform() * 1e9) as u64, bee))
            .collect();
        phases.sort_unstable();
        Self {
            medium,
            poses,
            phases,
            second: 0,
            received: 0,
            rounds: 0,
        }
    }

    fn open(&mut self, now: SimTime, owners: &mut Vec<ModelId>, scratch: &mut Scratch) {
        self.rounds += 1;
        self.medium.open(now, &self.poses, owners);
        for owner in owners {
            let inbox = self.medium.collect(RadioId(owner.0), &self.poses, scratch);
            self.received += inbox.len() as u64;
        }
    }

    /// One second of broadcasts.
    fn second(&mut self) {
        let (mut owners, mut scratch) = (Vec::new(), Scratch::new());
        let payload: Arc<[u8]> = Arc::from([1, 2, 3, 4]);
        for at in 0..self.phases.len() {
            let (phase, bee) = self.phases[at];
            let now = SimTime::from_nanos(self.second * 1_000_000_000 + phase);
            while let Some(next) = self.medium.next_time().filter(|&next| next <= now) {
                self.open(next, &mut owners, &mut scratch);
            }
            self.open(now, &mut owners, &mut scratch);
            let request = Request::broadcast(RadioId(bee), Arc::clone(&payload));
            self.medium.submit(now, request);
        }
        self.second += 1;
    }
}

/// Time that this process has had on a processor, ns; 0 where the system does not tell.
fn on_cpu_ns() -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    let first = text.split(' ').next();
    first.and_then(|ns| ns.parse().ok()).unwrap_or(0.0)
}

#[expect(clippy::print_stdout, reason = "a bench talks to whoever runs it")]
fn saturated(c: &mut Criterion) {
    let mut group = c.benchmark_group("ieee802154");
    group.sample_size(10);
    for n in [500, 2000, 8192] {
        let mut swarm = Swarm::new(n);
        let before_ns = on_cpu_ns();
        for _ in 0..3 {
            swarm.second();
        }
        let cpu_ns = on_cpu_ns() - before_ns;
        let totals = swarm.medium.totals();
        let pairs = totals.sent * (n as u64 - 1);
        println!(
            "{n} nodes: {:.0} frames a second, {:.4} delivered, {} rounds, {:.1} CPU ns per pair",
            totals.sent as f64 / 3.0,
            swarm.received as f64 / pairs as f64,
            swarm.rounds,
            cpu_ns / pairs as f64
        );
        group.throughput(Throughput::Elements(pairs / 3));
        group.bench_function(BenchmarkId::new("saturated", n), |b| {
            b.iter(|| swarm.second());
        });
    }
    group.finish();
}

criterion_group!(benches, saturated);
criterion_main!(benches);
