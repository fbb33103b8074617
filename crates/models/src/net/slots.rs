//! Time slots: a medium access of one's own.

use simbeeotic_model::check::{at_least_zero, in_range, positive};
use simbeeotic_model::kernel::{ModelId, SimTime, rng::path_key};
use simbeeotic_model::units::Time;
use simbeeotic_model::{BuildError, choice, params};
use std::collections::VecDeque;

/// Sends only in a slot of one's own: time division multiple access (TDMA).
///
/// Time is cut into rounds of `count` slots. Each platform owns one slot of each round, queues what it
/// has to say, and sends one packet in each slot that is its own, `guard` after the slot begins. Where
/// no two platforms that can hear or disturb each other share a slot, nothing collides.
///
/// All count from the start of the run: clocks are perfect here. To see what a real clock does, add its
/// error to the time that the methods are told, and give the slots a guard that holds it.
///
/// A slot must hold the guard, twice the clocks' error, the medium's own access (with CSMA/CA of IEEE
/// 802.15.4 on a free channel at most 2.56 ms: 7 units of backoff, the assessment, the turnaround) and
/// the frame (32 us a byte, 17 bytes of it overhead), and the acknowledgement if there is one.
#[derive(Clone, Debug)]
pub struct Slots<P> {
    params: SlotsParams,
    slot_ns: u64,
    guard_ns: u64,
    own: u64,
    queue: VecDeque<P>,
    counters: SlotsCounters,
}

/// Parameters of [`Slots`].
#[params]
pub struct SlotsParams {
    /// How long a slot is. 1 us to 1 s.
    pub slot: Time,
    /// How many slots make a round. At least 1.
    pub count: u32,
    /// How long after the beginning of its slot a platform sends. Shorter than the slot.
    pub guard: Time,
    /// Who owns which slot.
    pub assignment: Assignment,
    /// How many packets may wait. At least 1.
    pub queue: u32,
}

impl Default for SlotsParams {
    /// Slots of 5 ms, that hold a frame of 127 bytes after the longest backoff; 200 of them a second.
    fn default() -> Self {
        Self {
            slot: Time::from_millis(5.0),
            count: 200,
            guard: Time::from_micros(100.0),
            assignment: Assignment::Index,
            queue: 16,
        }
    }
}

/// Who owns which slot.
#[choice]
pub enum Assignment {
    /// By the address: platforms whose addresses follow each other own slots that follow each other. No
    /// two share a slot as long as there are no more platforms than slots.
    Index,
    /// By a hash of the path: needs no numbering, and does not change when others come or go. Two of
    /// n platforms share one of c slots with a probability of about `1 - exp(-n^2 / 2c)`.
    Hash,
}

/// What became of packets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SlotsCounters {
    /// Packets taken into the queue.
    pub queued: u64,
    /// Packets refused: the queue was full.
    pub refused: u64,
    /// Packets handed out in a slot.
    pub sent: u64,
}

impl<P> Slots<P> {
    /// The slots of the platform with this address and path. `P` is what waits: bytes, or bytes and
    /// whom they are for.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn new(params: SlotsParams, me: ModelId, path: &str) -> Result<Self, BuildError> {
        positive("slot", params.slot)?;
        in_range("slot", params.slot, Time::from_micros(1.0)..=Time::si(1.0))?;
        in_range("count", params.count, 1..=u32::MAX)?;
        at_least_zero("guard", params.guard)?;
        in_range("queue", params.queue, 1..=u32::MAX)?;
        if params.guard >= params.slot {
            return Err(BuildError::parameter(
                "guard",
                "must be shorter than `slot`",
            ));
        }
        let count = u64::from(params.count);
        let own = match params.assignment {
            Assignment::Index => u64::from(me.0) % count,
            Assignment::Hash => path_key(path) % count,
        };
        let nanos = |time: Time| SimTime::from_time(time).map_or(0, SimTime::nanos);
        Ok(Self {
            slot_ns: nanos(params.slot),
            guard_ns: nanos(params.guard),
            own,
            queue: VecDeque::new(),
            counters: SlotsCounters::default(),
            params,
        })
    }

    /// One's own slot, counted from 0.
    pub fn own(&self) -> u32 {
        self.own as u32
    }

    /// How long a round is: the time between two slots of one's own.
    pub fn round(&self) -> Time {
        Time::from_nanos(self.round_ns() as f64)
    }

    /// How long from `now` until the next sending in one's own slot; more than zero.
    pub fn wait(&self, now: SimTime) -> Time {
        let phase = self.own * self.slot_ns + self.guard_ns;
        let round = self.round_ns();
        let since = (now.nanos() % round + round - phase % round) % round;
        Time::from_nanos((round - since) as f64)
    }

    /// Puts a packet into the queue; whether there was room.
    pub fn push(&mut self, packet: P) -> bool {
        let room = self.queue.len() < self.params.queue as usize;
        if room {
            self.queue.push_back(packet);
            self.counters.queued += 1;
        } else {
            self.counters.refused += 1;
        }
        room
    }

    /// The packet to send now; `None` if there is none, or if this is not one's own slot.
    pub fn pop(&mut self, now: SimTime) -> Option<P> {
        if now.nanos() / self.slot_ns % u64::from(self.params.count) != self.own {
            return None;
        }
        let packet = self.queue.pop_front()?;
        self.counters.sent += 1;
        Some(packet)
    }

    /// How many packets wait.
    pub fn waiting(&self) -> usize {
        self.queue.len()
    }

    /// What became of packets so far.
    pub fn counters(&self) -> SlotsCounters {
        self.counters
    }

    fn round_ns(&self) -> u64 {
        self.slot_ns.saturating_mul(u64::from(self.params.count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slots(me: u32, params: SlotsParams) -> Slots<u32> {
        Slots::new(params, ModelId(me), &format!("bee-{me}")).expect("good parameters")
    }

    fn at(micros: u64) -> SimTime {
        SimTime::from_nanos(micros * 1000)
    }

    #[test]
    fn everybody_sends_in_a_slot_of_its_own_after_the_guard() {
        // Slots of 5 ms, a round of 200.
        for (me, first_us) in [(0, 100), (3, 15_100), (199, 995_100), (200, 100)] {
            let slots = slots(me, SlotsParams::default());
            let wait = slots.wait(SimTime::ZERO);
            assert!((wait.secs() * 1e6 - first_us as f64).abs() < 1e-6, "{wait}");
            let again = slots.wait(at(first_us));
            assert_eq!(again, Time::from_secs(1.0), "a round later, not at once");
            let late = slots.wait(at(first_us + 400_000));
            assert!((late.secs() - 0.6).abs() < 1e-12);
        }
    }

    #[test]
    fn a_packet_leaves_in_its_own_slot_only_and_in_order() {
        let mut slots = slots(3, SlotsParams::default());
        assert!(slots.push(1) && slots.push(2));
        assert_eq!(slots.pop(at(14_999)), None);
        assert_eq!(slots.pop(at(15_100)), Some(1));
        assert_eq!(slots.pop(at(20_000)), None);
        assert_eq!(slots.pop(at(1_015_100)), Some(2));
        assert_eq!(slots.pop(at(2_015_100)), None);
    }

    #[test]
    fn a_full_queue_refuses_and_counts() {
        let params = SlotsParams {
            queue: 2,
            ..SlotsParams::default()
        };
        let mut slots = slots(0, params);
        assert_eq!(
            [1, 2, 3].map(|packet| slots.push(packet)),
            [true, true, false]
        );
        let expected = SlotsCounters {
            queued: 2,
            refused: 1,
            sent: 0,
        };
        assert_eq!((slots.counters(), slots.waiting()), (expected, 2));
    }

    #[test]
    fn hashed_slots_are_spread_and_hang_on_the_path_alone() {
        let params = SlotsParams {
            assignment: Assignment::Hash,
            ..SlotsParams::default()
        };
        let own = |me: u32, path: &str| {
            let slots = Slots::<u32>::new(params.clone(), ModelId(me), path);
            slots.expect("good parameters").own()
        };
        assert_eq!(own(1, "bee"), own(77, "bee"));
        let mut taken = [0_u32; 200];
        for bee in 0..20_000 {
            taken[own(0, &format!("bee-{bee}")) as usize] += 1;
        }
        // 100 each; five standard deviations.
        assert!(taken.iter().all(|t| (50..=150).contains(t)), "{taken:?}");
    }

    #[test]
    fn parameters_that_make_no_sense_are_refused_by_name() {
        let wrong = [
            (
                SlotsParams {
                    slot: Time::ZERO,
                    ..SlotsParams::default()
                },
                "slot",
            ),
            (
                SlotsParams {
                    count: 0,
                    ..SlotsParams::default()
                },
                "count",
            ),
            (
                SlotsParams {
                    queue: 0,
                    ..SlotsParams::default()
                },
                "queue",
            ),
            (
                SlotsParams {
                    guard: Time::from_millis(5.0),
                    ..SlotsParams::default()
                },
                "guard",
            ),
        ];
        for (params, key) in wrong {
            let fault = Slots::<u32>::new(params, ModelId(0), "bee").expect_err("no sense");
            assert!(fault.to_string().contains(key), "{fault}");
        }
    }
}
