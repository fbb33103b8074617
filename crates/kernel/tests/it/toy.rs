//! A small world that uses everything: counters that ping each other, write to a shared board, and are
//! woken by a clock that belongs to the board.

use simbeeotic_kernel::{
    Committing, Domain, Engine, ModelId, Opening, Outbox, QueueKind, Settings, SimTime, Stream,
    Timers, Visit, Wake, rng::path_key,
};
use std::sync::atomic::{AtomicU64, Ordering};

/// A ping that may be passed on, this many times.
const PING: u32 = 1;
/// Shared state strikes every so many nanoseconds.
const STRIKE_NS: u64 = 37_000_000;

/// The shared state.
pub(crate) struct Board {
    paths: Vec<String>,
    cells: Vec<u64>,
    /// Next strike of the board's own clock.
    strike: SimTime,
    strikes: u64,
    /// Rounds to be asked for at the end of the round under way.
    extra_rounds: u32,
    /// Who is friends with whom: pings stay among neighbours of this group size.
    group: usize,
    /// Models see how many have run before them: what no domain may do.
    pub(crate) leak: Option<AtomicU64>,
    /// The leak waits for another thread, so that it shows for certain.
    pub(crate) leak_waits: bool,
}

/// A model: counts, and draws.
pub(crate) struct Counter {
    rng: Stream,
    timers: Timers,
    pub(crate) count: u64,
}

/// What a model does to the board.
pub(crate) enum Write {
    Cell(usize, u64),
    /// Somebody is woken in the model's name, as late as the words say.
    Poke(ModelId, u64),
}

impl Board {
    pub(crate) fn new(paths: Vec<String>, group: usize) -> Self {
        let cells = vec![0; paths.len()];
        Self {
            paths,
            cells,
            strike: SimTime::from_nanos(STRIKE_NS),
            strikes: 0,
            extra_rounds: 0,
            group,
            leak: None,
            leak_waits: false,
        }
    }

    /// A model of the same group, drawn.
    fn friend(&self, id: ModelId, rng: &mut Stream) -> ModelId {
        let first = id.index() / self.group * self.group;
        let size = self.group.min(self.paths.len() - first);
        ModelId((first + rng.below(size as u64) as usize) as u32)
    }
}

impl Domain for Board {
    type Agent = Counter;
    type Effect = Write;

    fn key(&self, id: ModelId) -> u64 {
        path_key(&self.paths[id.index()])
    }

    fn path(&self, id: ModelId) -> String {
        self.paths[id.index()].clone()
    }

    fn next_time(&mut self) -> Option<SimTime> {
        Some(self.strike)
    }

    fn open(&mut self, round: &mut Opening<'_>) {
        if self.strike <= round.now() {
            self.strikes += 1;
            self.strike = round.now().saturating_add_nanos(STRIKE_NS);
            self.extra_rounds = (self.strikes % 3) as u32;
            round.fold(self.strikes);
            for group in 0..self.paths.len() / self.group {
                round.visit(ModelId((group * self.group) as u32));
            }
        }
    }

    fn run(&self, counter: &mut Counter, visit: &Visit<'_>, out: &mut Outbox<Write>) {
        let Counter { rng, timers, count } = counter;
        *count += 1;
        let me = visit.id;
        if let Some(tickets) = &self.leak {
            let ticket = tickets.fetch_add(1, Ordering::SeqCst);
            for _ in 0..1_000_000 {
                let alone = tickets.load(Ordering::SeqCst) == ticket + 1;
                if !(self.leak_waits && me.0 == 0 && alone) {
                    break;
                }
                std::thread::yield_now();
            }
            out.fold(tickets.load(Ordering::SeqCst));
        }
        if visit.events.is_empty() {
            out.effect(Write::Poke(self.friend(me, rng), rng.below(3)));
        }
        for event in visit.events {
            if let Some(fired) = timers.fired(event.wake) {
                let seen = self.cells[self.friend(me, rng).index()];
                out.fold(seen);
                out.effect(Write::Cell(self.friend(me, rng).index(), rng.next_u64()));
                let delay = [0, 1, 1_000, 50_000_000][rng.below(4) as usize];
                let friend = self.friend(me, rng);
                out.schedule(
                    visit.now.saturating_add_nanos(delay),
                    friend,
                    Wake::new(PING, rng.below(4) as u32),
                );
                if rng.bernoulli(0.1) {
                    // Another period from now on, from within the timer's own handler.
                    let at = visit.now.saturating_add_nanos(1 + rng.below(10_000_000));
                    let wake = timers.arm(fired.timer, at, Some(20_000_000));
                    out.schedule(at, me, wake);
                }
                if let Some((at, wake)) = timers.rearm(fired) {
                    out.schedule(at, me, wake);
                }
            } else if event.wake.tag == PING && event.wake.arg > 0 {
                let friend = self.friend(me, rng);
                out.schedule(visit.now, friend, Wake::new(PING, event.wake.arg - 1));
            } else {
                out.voided();
            }
        }
    }

    fn warm(&self, id: ModelId, counter: &Counter) -> u64 {
        counter.count ^ self.cells[id.index()]
    }

    fn commit(&mut self, id: ModelId, effect: Write, cx: &mut Committing<'_>) {
        match effect {
            Write::Cell(cell, word) => {
                // What is written depends on what was there: order shows.
                self.cells[cell] = self.cells[cell].rotate_left(7) ^ word;
                cx.fold(self.cells[cell]);
            }
            Write::Poke(whom, delay) => {
                let at = cx.now().saturating_add_nanos(delay);
                cx.schedule_for(id, whom, at, Wake::new(PING, 1));
            }
        }
    }

    fn close(&mut self, _: SimTime) -> bool {
        let more = self.extra_rounds > 0;
        self.extra_rounds = self.extra_rounds.saturating_sub(1);
        more
    }
}

/// Settings that run even small rounds in parallel.
pub(crate) fn settings(threads: usize, queue: QueueKind) -> Settings {
    Settings {
        threads,
        queue,
        seed: 7,
        parallel_from: 1,
        ..Settings::default()
    }
}

/// The toy's paths: `bee-0` and so on.
pub(crate) fn paths(n: usize) -> Vec<String> {
    (0..n).map(|i| format!("bee-{i}")).collect()
}

/// A board with one counter a path; every other one wakes in step with the others.
pub(crate) fn engine_of(board: Board, seed: u64, settings: Settings) -> Engine<Board> {
    let mut wakes = Vec::new();
    let mut counters = Vec::new();
    for path in &board.paths {
        let mut rng = Stream::new(seed, path, "toy");
        let mut timers = Timers::new();
        let timer = timers.add(0);
        let phase = if rng.bernoulli(0.5) {
            0
        } else {
            rng.below(100_000_000)
        };
        let at = SimTime::from_nanos(phase);
        wakes.push((at, timers.arm(timer, at, Some(100_000_000))));
        counters.push(Counter {
            rng,
            timers,
            count: 0,
        });
    }
    let mut engine = Engine::new(board, counters, settings).unwrap();
    for (id, (at, wake)) in wakes.into_iter().enumerate() {
        engine
            .schedule_initial(at, ModelId(id as u32), wake)
            .unwrap();
    }
    engine
}

/// Five hundred counters that all know each other.
pub(crate) fn engine(settings: Settings) -> Engine<Board> {
    engine_of(Board::new(paths(500), 500), 7, settings)
}
