//! The wheel gives what the heap gives.

use proptest::prelude::*;
use simbeeotic_kernel::{Event, Heap, ModelId, PendingEvents, SimTime, Wake, Wheel};

/// What is done to both queues.
#[derive(Clone, Debug)]
enum Step {
    /// An event this many nanoseconds after the instant popped last.
    Push {
        after: u64,
        receiver: u32,
    },
    /// An event at an absolute time, or at the instant popped last if that is over.
    PushAt {
        time: u64,
    },
    /// Many events of one time.
    PushSame {
        after: u64,
        count: u32,
    },
    Peek,
    Pop,
}

fn step() -> impl Strategy<Value = Step> {
    let after = prop_oneof![
        Just(0),
        1..10u64,
        1..1u64 << 16,
        1..1u64 << 22,
        1..1u64 << 30,
        1..1u64 << 50,
        any::<u64>(),
    ];
    prop_oneof![
        4 => (after.clone(), 0..4u32).prop_map(|(after, receiver)| Step::Push { after, receiver }),
        1 => prop_oneof![any::<u64>(), Just(u64::MAX), Just(0)].prop_map(|time| Step::PushAt { time }),
        1 => (after, 1..40u32).prop_map(|(after, count)| Step::PushSame { after, count }),
        2 => Just(Step::Peek),
        4 => Just(Step::Pop),
    ]
}

/// Both queues, and what goes into them.
#[derive(Default)]
struct Pair {
    wheel: Wheel,
    heap: Heap,
    now: SimTime,
    seq: u64,
}

impl Pair {
    fn push(&mut self, time: SimTime, receiver: u32) {
        let (receiver, sender) = (ModelId(receiver), ModelId((self.seq % 3) as u32));
        let event = Event {
            time,
            receiver,
            sender,
            seq: self.seq,
            wake: Wake::default(),
        };
        self.seq += 1;
        self.wheel.push(event);
        self.heap.push(event);
    }

    fn pop(&mut self) -> bool {
        let (mut a, mut b) = (vec![], vec![]);
        let time = self.heap.pop_instant(&mut b);
        assert_eq!(self.wheel.pop_instant(&mut a), time);
        assert_eq!(a, b);
        assert!(a.is_sorted());
        self.now = time.unwrap_or(self.now);
        time.is_some()
    }

    fn step(&mut self, step: &Step) {
        match *step {
            Step::Push { after, receiver } => {
                self.push(self.now.saturating_add_nanos(after), receiver);
            }
            Step::PushAt { time } => self.push(SimTime::from_nanos(time).max(self.now), 0),
            Step::PushSame { after, count } => {
                let time = self.now.saturating_add_nanos(after);
                (0..count).for_each(|i| self.push(time, i * 7 % 5));
            }
            Step::Peek => assert_eq!(self.wheel.next_time(), self.heap.next_time()),
            Step::Pop => {
                self.pop();
            }
        }
        assert_eq!(self.wheel.len(), self.heap.len());
        assert_eq!(self.wheel.is_empty(), self.heap.is_empty());
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]
    #[test]
    fn wheel_and_heap_agree(steps in prop::collection::vec(step(), 1..300)) {
        let mut pair = Pair::default();
        steps.iter().for_each(|step| pair.step(step));
        while pair.pop() {}
        prop_assert!(pair.wheel.is_empty() && pair.heap.is_empty());
    }
}

#[test]
fn a_popped_batch_is_appended() {
    let mut pair = Pair::default();
    (0..3).for_each(|i| pair.push(SimTime::from_millis(i), 0));
    let mut batch = vec![];
    while pair.wheel.pop_instant(&mut batch).is_some() {}
    assert_eq!(batch.len(), 3);
    assert!(batch.is_sorted());
}

#[test]
fn an_empty_queue_has_no_next_time() {
    let mut pair = Pair::default();
    assert_eq!(
        (pair.wheel.next_time(), pair.heap.next_time()),
        (None, None)
    );
    pair.push(SimTime::MAX, 0);
    assert_eq!(pair.wheel.next_time(), Some(SimTime::MAX));
    assert!(pair.pop());
    // The end of time can come again, like any instant.
    pair.push(SimTime::MAX, 1);
    assert!(pair.pop());
    assert!(!pair.pop());
}

#[test]
fn a_long_run_agrees_over_every_level_of_the_wheel() {
    let mut pair = Pair::default();
    let mut stream = simbeeotic_kernel::Stream::new(1, "queues", "long");
    for i in 0..200 {
        pair.push(SimTime::from_nanos(i), i as u32);
    }
    for _ in 0..20_000 {
        assert!(pair.pop());
        // Now and then a step of days; most of the time milliseconds.
        let bits = if stream.bernoulli(0.01) { 50 } else { 25 };
        while pair.heap.len() < 200 {
            let after = stream.next_u64() >> (64 - bits);
            pair.push(pair.now.saturating_add_nanos(after), stream.below(9) as u32);
        }
    }
}
