//! Flooding: a message to everybody, hop by hop.

use super::Heard;
use super::wire::Bytes;
use simbeeotic_model::check::{at_least_zero, in_range};
use simbeeotic_model::kernel::{ModelId, SimTime, Stream};
use simbeeotic_model::units::Time;
use simbeeotic_model::{BuildError, params};
use std::collections::BTreeMap;

/// What a flooded packet starts with.
const KIND: u8 = 0xf1;
/// Bytes before the message.
const HEADER: usize = 9;
/// How many sequence numbers of an origin are remembered.
const WINDOW: u32 = 128;
/// Origins remembered; of more, the one that was quiet longest is forgotten.
const ORIGINS: usize = 4096;

/// Brings messages to everybody: who hears one for the first time sends it on, once.
///
/// A message is named by its origin and a sequence number. Whoever hears a new one hands it up, waits
/// for a random delay, and broadcasts it again with one more hop, until it has made the hops that its
/// origin allows. Copies are recognised and dropped: the last 128 numbers of each origin are
/// remembered, and older ones count as known.
///
/// In a dense swarm most of that is in vain, and collides. Two remedies of S.-Y. Ni, Y.-C. Tseng,
/// Y.-S. Chen and J.-P. Sheu, "The broadcast storm problem in a mobile ad hoc network", MobiCom 1999:
/// send on with a [`probability`](FloodParams::probability) only, or not at all if so many
/// [`copies`](FloodParams::copies) were heard during the delay.
#[derive(Clone, Debug)]
pub struct Flood {
    params: FloodParams,
    rng: Stream,
    sequence: u16,
    seen: BTreeMap<ModelId, Seen>,
    /// What waits to be sent on.
    pending: Vec<Pending>,
    counters: FloodCounters,
}

/// Parameters of [`Flood`].
#[params]
pub struct FloodParams {
    /// How many times one's own messages are sent at most, the first time included. 1 to 255.
    pub hops: u8,
    /// Longest delay before a message is sent on; each is drawn uniformly up to here.
    pub delay: Time,
    /// With what probability a message is sent on. 0 to 1.
    pub probability: f64,
    /// A message is not sent on if so many copies of it were heard by the end of the delay, the first
    /// included. 0: it always is.
    pub copies: u16,
}

impl Default for FloodParams {
    fn default() -> Self {
        Self {
            hops: 16,
            delay: Time::from_millis(50.0),
            probability: 1.0,
            copies: 0,
        }
    }
}

/// What became of messages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FloodCounters {
    /// Messages of one's own.
    pub originated: u64,
    /// Messages of others, each once.
    pub delivered: u64,
    /// Copies of messages that were known.
    pub duplicates: u64,
    /// Messages sent on.
    pub forwarded: u64,
    /// Messages not sent on: they had made all their hops.
    pub spent: u64,
    /// Messages not sent on by chance, or since enough copies were heard.
    pub suppressed: u64,
}

/// A message of somebody, heard for the first time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Delivery<'a> {
    /// Whose it is.
    pub origin: ModelId,
    /// Its number among the origin's.
    pub sequence: u16,
    /// How often it was sent until it came here: 1 straight from the origin.
    pub hops: u8,
    /// The message.
    pub message: &'a [u8],
}

/// Which of an origin's messages are known.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// The highest number.
    latest: u16,
    /// Bit k: the number `latest - k`.
    bits: u128,
    last: SimTime,
}

/// A message that waits to be sent on.
#[derive(Clone, Debug)]
struct Pending {
    due: SimTime,
    origin: ModelId,
    sequence: u16,
    copies: u16,
    bytes: Vec<u8>,
}

impl Seen {
    /// Notes a number; whether it is new.
    fn note(&mut self, sequence: u16) -> bool {
        let ahead = sequence.wrapping_sub(self.latest);
        if ahead != 0 && ahead < 0x8000 {
            let bits = self.bits.checked_shl(u32::from(ahead)).unwrap_or(0);
            (self.latest, self.bits) = (sequence, bits | 1);
            return true;
        }
        let behind = u32::from(self.latest.wrapping_sub(sequence));
        let bit = 1_u128.checked_shl(behind).unwrap_or(0);
        let new = behind < WINDOW && self.bits & bit == 0;
        self.bits |= bit;
        new
    }
}

impl Flood {
    /// Bytes that a message may have, in a radio whose longest payload is this.
    #[must_use]
    pub const fn message_bytes_max(payload_bytes_max: usize) -> usize {
        payload_bytes_max.saturating_sub(HEADER)
    }

    /// Knows no message yet. `rng` is for delays and chance: a stream of its own
    /// ([`Kit::stream`](simbeeotic_model::Kit::stream)).
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn new(params: FloodParams, rng: Stream) -> Result<Self, BuildError> {
        in_range("hops", params.hops, 1..=u8::MAX)?;
        at_least_zero("delay", params.delay)?;
        in_range("delay", params.delay, Time::ZERO..=Time::si(3600.0))?;
        in_range("probability", params.probability, 0.0..=1.0)?;
        Ok(Self {
            params,
            rng,
            sequence: 0,
            seen: BTreeMap::new(),
            pending: Vec::new(),
            counters: FloodCounters::default(),
        })
    }

    /// The bytes to broadcast for a message of one's own; `me` is one's own address. A message that
    /// is too long for the radio is lost there.
    pub fn originate(&mut self, me: ModelId, message: &[u8]) -> Vec<u8> {
        let sequence = self.sequence;
        self.sequence = sequence.wrapping_add(1);
        self.counters.originated += 1;
        packet(me, sequence, [1, self.params.hops], message)
    }

    /// Takes note of a packet, heard by the platform with the address `me`. `Some` for a message that
    /// is new; other packets are left alone.
    ///
    /// Afterwards [`next`](Self::next) tells when there is something to send on.
    pub fn hear<'a>(&mut self, me: ModelId, heard: Heard<'a>) -> Option<Delivery<'a>> {
        let (delivery, limit) = read(heard.payload)?;
        let Delivery {
            origin, sequence, ..
        } = delivery;
        if origin == me || !self.note(origin, sequence, heard.time) {
            self.counters.duplicates += 1;
            let same = |p: &&mut Pending| p.origin == origin && p.sequence == sequence;
            if let Some(pending) = self.pending.iter_mut().find(same) {
                pending.copies = pending.copies.saturating_add(1);
            }
            return None;
        }
        self.counters.delivered += 1;
        if delivery.hops >= limit {
            self.counters.spent += 1;
        } else if !self.rng.bernoulli(self.params.probability) {
            self.counters.suppressed += 1;
        } else {
            let delay = self.params.delay * self.rng.uniform();
            let hops = [delivery.hops + 1, limit];
            self.pending.push(Pending {
                due: heard.time.after(delay).unwrap_or(heard.time),
                origin,
                sequence,
                copies: 1,
                bytes: packet(origin, sequence, hops, delivery.message),
            });
        }
        Some(delivery)
    }

    /// How long from `now` until there is something to send on; `None` if nothing waits. Arm a timer
    /// with it after each [`hear`](Self::hear) and each [`take_due`](Self::take_due).
    pub fn next(&self, now: SimTime) -> Option<Time> {
        let due = self.pending.iter().map(|pending| pending.due).min()?;
        Some(if due > now { due - now } else { Time::ZERO })
    }

    /// The bytes to broadcast now, one packet at a time, the longest due first; `None` when there is
    /// nothing left. Messages of which enough copies were heard are dropped here.
    pub fn take_due(&mut self, now: SimTime) -> Option<Vec<u8>> {
        loop {
            let due = self.pending.iter().enumerate();
            let due = due.filter(|(_, pending)| pending.due <= now);
            let (first, _) = due.min_by_key(|(at, pending)| (pending.due, *at))?;
            let pending = self.pending.remove(first);
            if self.params.copies > 0 && pending.copies >= self.params.copies {
                self.counters.suppressed += 1;
                continue;
            }
            self.counters.forwarded += 1;
            return Some(pending.bytes);
        }
    }

    /// What became of messages so far.
    pub fn counters(&self) -> FloodCounters {
        self.counters
    }

    /// Notes a message; whether it is new.
    fn note(&mut self, origin: ModelId, sequence: u16, now: SimTime) -> bool {
        if let Some(seen) = self.seen.get_mut(&origin) {
            seen.last = now;
            return seen.note(sequence);
        }
        if self.seen.len() >= ORIGINS {
            let quietest = self.seen.iter().min_by_key(|(_, seen)| seen.last);
            if let Some(quietest) = quietest.map(|(origin, _)| *origin) {
                self.seen.remove(&quietest);
            }
        }
        let seen = Seen {
            latest: sequence,
            bits: 1,
            last: now,
        };
        self.seen.insert(origin, seen);
        true
    }
}

fn packet(origin: ModelId, sequence: u16, hops: [u8; 2], message: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(HEADER + message.len());
    bytes.push(KIND);
    bytes.extend(origin.0.to_le_bytes());
    bytes.extend(sequence.to_le_bytes());
    bytes.extend(hops);
    bytes.extend(message);
    bytes
}

/// A flooded packet and its limit of hops.
fn read(payload: &[u8]) -> Option<(Delivery<'_>, u8)> {
    let mut bytes = Bytes(payload);
    let kind = bytes.u8()?;
    let (origin, sequence) = (ModelId(bytes.u32()?), bytes.u16()?);
    let (hops, limit) = (bytes.u8()?, bytes.u8()?);
    let delivery = Delivery {
        origin,
        sequence,
        hops,
        message: bytes.rest(),
    };
    (kind == KIND && (1..=limit).contains(&hops)).then_some((delivery, limit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use simbeeotic_model::units::PowerLevel;

    fn flood(params: FloodParams) -> Flood {
        Flood::new(params, Stream::new(1, "bee", "flood")).expect("good parameters")
    }

    fn heard(payload: &[u8], millis: u64) -> Heard<'_> {
        Heard {
            sender: ModelId(8),
            payload,
            rssi: PowerLevel::from_dbm(-70.0),
            time: SimTime::from_millis(millis),
        }
    }

    const ME: ModelId = ModelId(0);

    #[test]
    fn bytes_are_as_documented() {
        let mut origin = flood(FloodParams::default());
        origin.originate(ModelId(0x0102_0304), b"");
        let bytes = origin.originate(ModelId(0x0102_0304), b"hi");
        assert_eq!(bytes, [0xf1, 4, 3, 2, 1, 1, 0, 1, 16, b'h', b'i']);
    }

    #[test]
    fn a_message_is_handed_up_once_and_sent_on_once_with_one_more_hop() {
        let bytes = flood(FloodParams::default()).originate(ModelId(7), b"fire");
        let mut relay = flood(FloodParams::default());
        let delivery = relay.hear(ME, heard(&bytes, 100)).expect("it is new");
        assert_eq!((delivery.origin, delivery.hops), (ModelId(7), 1));
        assert_eq!(delivery.message, b"fire");
        assert!(relay.hear(ME, heard(&bytes, 101)).is_none());

        let now = SimTime::from_millis(100);
        let wait = relay.next(now).expect("it waits");
        assert!(wait >= Time::ZERO && wait <= Time::from_millis(50.0));
        assert!(relay.take_due(now).is_none() || wait == Time::ZERO);
        let on = relay
            .take_due(SimTime::from_millis(150))
            .expect("it is due");
        assert_eq!((on[7], &on[..7], &on[9..]), (2, &bytes[..7], &bytes[9..]));
        assert!(relay.take_due(SimTime::from_secs(9)).is_none() && relay.next(now).is_none());
        let expected = FloodCounters {
            delivered: 1,
            duplicates: 1,
            forwarded: 1,
            ..FloodCounters::default()
        };
        assert_eq!(relay.counters(), expected);
    }

    #[test]
    fn nobody_sends_on_what_has_made_all_its_hops_or_is_its_own() {
        let params = FloodParams {
            hops: 1,
            ..FloodParams::default()
        };
        let bytes = flood(params).originate(ModelId(7), b"fire");
        let mut relay = flood(FloodParams::default());
        assert!(relay.hear(ME, heard(&bytes, 0)).is_some());
        assert!(relay.next(SimTime::ZERO).is_none());
        assert_eq!(relay.counters().spent, 1);

        let mut origin = flood(FloodParams::default());
        let bytes = origin.originate(ME, b"fire");
        assert!(origin.hear(ME, heard(&bytes, 0)).is_none());
        assert!(origin.next(SimTime::ZERO).is_none());
    }

    #[test]
    fn enough_copies_keep_a_message_from_being_sent_on() {
        let params = FloodParams {
            copies: 3,
            ..FloodParams::default()
        };
        for (copies, forwarded) in [(2, 1), (3, 0), (4, 0)] {
            let bytes = flood(FloodParams::default()).originate(ModelId(7), b"fire");
            let mut relay = flood(params.clone());
            for _ in 0..copies {
                relay.hear(ME, heard(&bytes, 0));
            }
            let sent = std::iter::from_fn(|| relay.take_due(SimTime::from_secs(1)));
            assert_eq!(sent.count(), forwarded, "{copies} copies");
        }
    }

    #[test]
    fn a_share_of_messages_is_sent_on_by_chance() {
        let params = FloodParams {
            probability: 0.6,
            ..FloodParams::default()
        };
        let (mut origin, mut relay) = (flood(FloodParams::default()), flood(params));
        for _ in 0..10_000 {
            let bytes = origin.originate(ModelId(7), b"");
            relay.hear(ME, heard(&bytes, 0));
            while relay.take_due(SimTime::from_secs(1)).is_some() {}
        }
        // Four standard errors of 10,000 draws.
        let forwarded = relay.counters().forwarded as f64 / 1e4;
        assert!((forwarded - 0.6).abs() < 0.02, "{forwarded}");
        assert_eq!(relay.counters().delivered, 10_000);
    }

    #[test]
    fn messages_out_of_order_are_new_within_the_window_and_old_beyond() {
        let mut seen = Seen {
            latest: 5,
            bits: 1,
            last: SimTime::ZERO,
        };
        let new: Vec<bool> = [5, 7, 6, 6, 5, 65_535, 300, 173, 172, 301]
            .map(|sequence| seen.note(sequence))
            .to_vec();
        assert_eq!(
            new,
            [
                false, true, true, false, false, true, true, true, false, true
            ]
        );
    }

    proptest! {
        #[test]
        fn no_bytes_whatsoever_do_any_harm_and_nothing_is_delivered_twice(
            packets in proptest::collection::vec(
                (proptest::collection::vec(any::<u8>(), 0..20), any::<bool>()), 0..60)
        ) {
            let mut relay = flood(FloodParams::default());
            let mut delivered = Vec::new();
            for (mut payload, kind) in packets {
                if let (true, Some(first)) = (kind, payload.first_mut()) {
                    *first = KIND;
                    // Few origins, so that they meet again.
                    payload.iter_mut().skip(1).take(6).for_each(|byte| *byte &= 1);
                }
                if let Some(new) = relay.hear(ME, heard(&payload, 0)) {
                    prop_assert!(!delivered.contains(&(new.origin, new.sequence)));
                    delivered.push((new.origin, new.sequence));
                }
                while let Some(bytes) = relay.take_due(SimTime::from_secs(1)) {
                    prop_assert!(read(&bytes).is_some());
                }
            }
        }
    }
}
