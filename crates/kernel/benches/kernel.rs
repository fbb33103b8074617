//! What the kernel costs: a pop and a push of each queue, an event of an otherwise empty engine.
//!
//! `cargo bench -p simbeeotic-kernel`. Times are for reading, nothing asserts them.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use simbeeotic_kernel::{
    Committing, Domain, Engine, Event, Heap, ModelId, Opening, Outbox, PendingEvents, QueueKind,
    Settings, SimTime, Stream, Timers, Visit, Wake, Wheel,
};
use std::hint::black_box;

const PERIOD_NS: u64 = 100_000_000;

/// When each of `n` models wakes for the first time: all at once, or anywhere in the period.
fn phases(n: u32, aligned: bool) -> Vec<SimTime> {
    let mut stream = Stream::new(1, "bench", "phases");
    let mut draw = || if aligned { 0 } else { stream.below(PERIOD_NS) };
    (0..n).map(|_| SimTime::from_nanos(draw())).collect()
}

/// A queue in steady state: what is popped is pushed again, one period later.
struct Hold<Q> {
    queue: Q,
    batch: Vec<Event>,
    seq: u64,
}

impl<Q: PendingEvents + Default> Hold<Q> {
    fn new(n: u32, aligned: bool) -> Self {
        let mut queue = Q::default();
        for (id, time) in (0..n).map(ModelId).zip(phases(n, aligned)) {
            queue.push(Event {
                time,
                receiver: id,
                sender: id,
                seq: 0,
                wake: Wake::default(),
            });
        }
        let mut hold = Self {
            queue,
            batch: Vec::new(),
            seq: 1,
        };
        hold.run(10 * u64::from(n));
        hold
    }

    fn run(&mut self, events: u64) {
        let mut done = 0;
        while done < events {
            self.batch.clear();
            let now = self
                .queue
                .pop_instant(&mut self.batch)
                .expect("events are put back");
            for event in &self.batch {
                let time = now.saturating_add_nanos(PERIOD_NS);
                self.queue.push(Event {
                    time,
                    seq: self.seq,
                    ..*event
                });
                self.seq += 1;
            }
            black_box(self.queue.next_time());
            done += self.batch.len() as u64;
        }
    }
}

fn queues(c: &mut Criterion) {
    let mut group = c.benchmark_group("queue: pop and push");
    group.throughput(Throughput::Elements(1));
    for n in [1_000, 100_000] {
        for (phase, aligned) in [("random", false), ("aligned", true)] {
            let name = format!("{n} {phase}");
            let mut wheel = Hold::<Wheel>::new(n, aligned);
            group.bench_function(BenchmarkId::new("wheel", &name), |b| {
                b.iter_custom(|events| timed(|| wheel.run(events)))
            });
            let mut heap = Hold::<Heap>::new(n, aligned);
            group.bench_function(BenchmarkId::new("heap", &name), |b| {
                b.iter_custom(|events| timed(|| heap.run(events)))
            });
        }
    }
}

/// A world without anything shared: each agent's timer fires ten times a second.
struct Empty;

impl Domain for Empty {
    type Agent = (Timers, u64);
    type Effect = ();
    fn key(&self, id: ModelId) -> u64 {
        u64::from(id.0)
    }
    fn path(&self, id: ModelId) -> String {
        id.to_string()
    }
    fn next_time(&mut self) -> Option<SimTime> {
        None
    }
    fn open(&mut self, _: &mut Opening<'_>) {}
    fn run(&self, (timers, count): &mut Self::Agent, visit: &Visit<'_>, out: &mut Outbox<()>) {
        for event in visit.events {
            let Some(fired) = timers.fired(event.wake) else {
                continue;
            };
            *count += 1;
            if let Some((at, wake)) = timers.rearm(fired) {
                out.schedule(at, visit.id, wake);
            }
        }
    }
    fn warm(&self, _: ModelId, (timers, count): &Self::Agent) -> u64 {
        count ^ timers.next_firing(0).map_or(0, SimTime::nanos)
    }
    fn commit(&mut self, _: ModelId, (): (), _: &mut Committing<'_>) {}
    fn close(&mut self, _: SimTime) -> bool {
        false
    }
}

fn engine(n: u32, aligned: bool, threads: usize, queue: QueueKind) -> Engine<Empty> {
    let mut wakes = Vec::new();
    let agents = phases(n, aligned)
        .into_iter()
        .map(|phase| {
            let mut timers = Timers::new();
            let timer = timers.add(0);
            wakes.push((phase, timers.arm(timer, phase, Some(PERIOD_NS))));
            (timers, 0)
        })
        .collect();
    let settings = Settings {
        threads,
        queue,
        ..Settings::default()
    };
    let mut engine = Engine::new(Empty, agents, settings).expect("threads");
    for (id, (time, wake)) in wakes.into_iter().enumerate() {
        engine
            .schedule_initial(time, ModelId(id as u32), wake)
            .expect("in the future");
    }
    engine
        .run_until(SimTime::from_secs(2))
        .expect("nothing fails");
    engine
}

fn engines(c: &mut Criterion) {
    let mut group = c.benchmark_group("engine: one event");
    group.throughput(Throughput::Elements(1));
    let n = 10_000;
    for (phase, aligned) in [("random", false), ("aligned", true)] {
        for (name, threads, queue) in [
            ("wheel, 1 thread", 1, QueueKind::Wheel),
            ("heap, 1 thread", 1, QueueKind::Heap),
            ("wheel, 2 threads", 2, QueueKind::Wheel),
        ] {
            let mut engine = engine(n, aligned, threads, queue);
            group.bench_function(BenchmarkId::new(name, format!("{n} {phase}")), |b| {
                b.iter_custom(|events| {
                    // Whole periods of all agents, scaled to the number asked for.
                    let periods = events.div_ceil(u64::from(n));
                    let until = engine.now().saturating_add_nanos(periods * PERIOD_NS);
                    let time = timed(|| drop(engine.run_until(until).expect("nothing fails")));
                    time.mul_f64(events as f64 / (periods * u64::from(n)) as f64)
                })
            });
        }
    }
}

fn draws(c: &mut Criterion) {
    let mut stream = Stream::new(1, "bench", "draws");
    c.bench_function("stream: 64 bits", |b| b.iter(|| stream.next_u64()));
    c.bench_function("stream: normal", |b| b.iter(|| stream.normal()));
    let mut frame = 0;
    c.bench_function("draw_u32: 1000 receivers", |b| {
        b.iter(|| {
            frame += 1;
            let key = simbeeotic_kernel::rng::draw_u64(1, frame, 0);
            (0..1000)
                .filter(|&a| simbeeotic_kernel::rng::draw_u32(key, a) < 1 << 30)
                .count()
        })
    });
}

fn timed(run: impl FnOnce()) -> std::time::Duration {
    #[expect(clippy::disallowed_methods, reason = "a bench measures wall time")]
    let start = std::time::Instant::now();
    run();
    start.elapsed()
}

criterion_group!(benches, queues, engines, draws);
criterion_main!(benches);
