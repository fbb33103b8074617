//! Neighbour discovery: beacons, and what they tell about links.

use super::Heard;
use super::wire::Bytes;
use simbeeotic_model::check::{in_range, positive};
use simbeeotic_model::kernel::{ModelId, SimTime, Stream};
use simbeeotic_model::units::{PowerLevel, Time};
use simbeeotic_model::{BuildError, params};
use std::collections::BTreeMap;

/// What a beacon starts with.
const KIND: u8 = 0xb1;
/// Bytes before the list.
const HEADER: usize = 4;
/// Bytes of each neighbour listed.
const ENTRY: usize = 5;
/// A step back of the sequence number by less than this is an old beacon, else the sender began anew.
const OLD: u16 = 64;
/// Weight of the newest packet in the mean signal strength.
const RSSI_WEIGHT: f64 = 0.125;

/// Who is around, and how good the links to them are, by beacons.
///
/// Everybody broadcasts a beacon once a period, with some jitter, a sequence number, and a list of the
/// neighbours it knows. From the gaps between sequence numbers follows how many beacons of a neighbour
/// are received; that one's list says how it is the other way round. A link on which both hear each
/// other is [bidirectional](Neighbor::is_bidirectional).
///
/// The share of beacons received is a windowed mean with exponentially weighted moving average
/// (WMEWMA): of each window of beacons expected the share received, `r`, moves the estimate `q` to
/// `alpha q + (1 - alpha) r`. Until the first window is full, `q` is the share so far.
///
/// Source: A. Woo, T. Tong and D. Culler, "Taming the underlying challenges of reliable multihop
/// routing in sensor networks", SenSys 2003, section 3.
#[derive(Clone, Debug)]
pub struct Beacons {
    params: BeaconsParams,
    rng: Stream,
    sequence: u16,
    known: BTreeMap<ModelId, Neighbor>,
    /// The neighbour before the first of the next list, where one beacon does not hold all.
    listed: Option<ModelId>,
}

/// Parameters of [`Beacons`].
#[params]
pub struct BeaconsParams {
    /// Time between two beacons, without the jitter. Above 0.
    pub period: Time,
    /// How much longer or shorter a pause is at most, as a share of the period. 0 to 0.9.
    pub jitter: f64,
    /// How many beacons are expected in a window of the estimate. 1 to 1,000.
    pub window: u16,
    /// Weight of the past in the estimate. 0 to 1: 1 keeps what the first window said.
    pub alpha: f64,
    /// A neighbour that was not heard for so many periods is forgotten. 1 to 1,000.
    pub expiry: u16,
    /// How many neighbours one beacon lists; more than these take turns. 0 to 22, which fill a frame
    /// of IEEE 802.15.4.
    pub listed: u8,
}

impl Default for BeaconsParams {
    /// A beacon a second; window and weight for links that change in seconds (Woo et al. take 30 and
    /// 0.6 for motes that lie still).
    fn default() -> Self {
        Self {
            period: Time::si(1.0),
            jitter: 0.1,
            window: 10,
            alpha: 0.6,
            expiry: 5,
            listed: 16,
        }
    }
}

/// What is known of one neighbour.
#[derive(Clone, Debug)]
pub struct Neighbor {
    address: ModelId,
    first_heard: SimTime,
    last_heard: SimTime,
    sequence: u16,
    beacons: u64,
    rssi_dbm: f64,
    /// The window that is being filled.
    received: u32,
    expected: u32,
    inbound: Option<f64>,
    /// What it said last of how it hears us, and when.
    outbound: Option<(f64, SimTime)>,
}

impl Neighbor {
    /// Its address.
    pub fn address(&self) -> ModelId {
        self.address
    }

    /// When it was heard first since it was forgotten last.
    pub fn first_heard(&self) -> SimTime {
        self.first_heard
    }

    /// When it was heard last.
    pub fn last_heard(&self) -> SimTime {
        self.last_heard
    }

    /// How many of its beacons were received.
    pub fn beacons(&self) -> u64 {
        self.beacons
    }

    /// Mean signal strength of its beacons: of the levels in dBm, the newest with a weight of 1/8.
    pub fn rssi(&self) -> PowerLevel {
        PowerLevel::from_dbm(self.rssi_dbm)
    }

    /// Estimated share of its beacons that are received here, 0 to 1.
    pub fn inbound(&self) -> f64 {
        let so_far = f64::from(self.received) / f64::from(self.expected.max(1));
        self.inbound.unwrap_or(so_far)
    }

    /// The share of our beacons that it receives, as it says itself, in steps of 1/255; `None` if it
    /// does not hear us, as far as known.
    pub fn outbound(&self) -> Option<f64> {
        self.outbound.map(|(quality, _)| quality)
    }

    /// Whether both hear each other, as far as known.
    pub fn is_bidirectional(&self) -> bool {
        self.outbound.is_some()
    }

    /// The expected number of transmissions until a packet is there and its acknowledgement back, if
    /// each is lost as beacons are: `1 / (inbound outbound)`; `None` for a link of one direction.
    ///
    /// Source: D. De Couto et al., "A high-throughput path metric for multi-hop wireless routing",
    /// MobiCom 2003 (ETX).
    pub fn etx(&self) -> Option<f64> {
        let both = self.inbound() * self.outbound()?;
        (both > 0.0).then(|| 1.0 / both)
    }

    fn new(heard: &Heard<'_>, sequence: u16) -> Self {
        Self {
            address: heard.sender,
            first_heard: heard.time,
            last_heard: heard.time,
            sequence,
            beacons: 1,
            rssi_dbm: heard.rssi.dbm(),
            received: 1,
            expected: 1,
            inbound: None,
            outbound: None,
        }
    }

    /// Notes another beacon; whether it is a new one.
    fn note(&mut self, heard: &Heard<'_>, sequence: u16, params: &BeaconsParams) -> bool {
        let gap = sequence.wrapping_sub(self.sequence);
        if gap == 0 || gap.wrapping_neg() < OLD {
            return false;
        }
        if gap >= u16::MAX / 2 {
            *self = Self {
                first_heard: self.first_heard,
                ..Self::new(heard, sequence)
            };
            return true;
        }
        self.sequence = sequence;
        self.beacons += 1;
        self.last_heard = heard.time;
        self.rssi_dbm += RSSI_WEIGHT * (heard.rssi.dbm() - self.rssi_dbm);
        self.received += 1;
        self.expected += u32::from(gap);
        if self.expected >= u32::from(params.window) {
            let share = f64::from(self.received) / f64::from(self.expected);
            let past = self.inbound.unwrap_or(share);
            self.inbound = Some(params.alpha * past + (1.0 - params.alpha) * share);
            (self.received, self.expected) = (0, 0);
        }
        true
    }
}

impl Beacons {
    /// Knows nobody yet. `rng` is for the jitter: a stream of its own
    /// ([`Kit::stream`](simbeeotic_model::Kit::stream)).
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn new(params: BeaconsParams, rng: Stream) -> Result<Self, BuildError> {
        positive("period", params.period)?;
        in_range("jitter", params.jitter, 0.0..=0.9)?;
        in_range("window", params.window, 1..=1000)?;
        in_range("alpha", params.alpha, 0.0..=1.0)?;
        in_range("expiry", params.expiry, 1..=1000)?;
        in_range("listed", params.listed, 0..=22)?;
        Ok(Self {
            params,
            rng,
            sequence: 0,
            known: BTreeMap::new(),
            listed: None,
        })
    }

    /// When to send the first beacon: at a random time of the first period.
    pub fn first(&mut self) -> Time {
        self.params.period * self.rng.uniform()
    }

    /// How long to wait after a beacon: a period and some jitter.
    pub fn pause(&mut self) -> Time {
        let jitter = self.params.jitter * (2.0 * self.rng.uniform() - 1.0);
        self.params.period * (1.0 + jitter)
    }

    /// The bytes to broadcast now. Forgets those who were silent for too long.
    pub fn beacon(&mut self, now: SimTime) -> Vec<u8> {
        self.forget(now);
        let mut bytes = Vec::with_capacity(HEADER + ENTRY * usize::from(self.params.listed));
        bytes.push(KIND);
        bytes.extend(self.sequence.to_le_bytes());
        bytes.push(u8::try_from(self.known.len()).unwrap_or(u8::MAX));
        self.sequence = self.sequence.wrapping_add(1);

        let after = self.listed.map_or(0, |last| last.0.wrapping_add(1));
        let (first, rest) = (
            self.known.range(ModelId(after)..),
            self.known.range(..ModelId(after)),
        );
        let mut last = None;
        for (address, neighbor) in first.chain(rest).take(usize::from(self.params.listed)) {
            bytes.extend(address.0.to_le_bytes());
            bytes.push((neighbor.inbound() * 255.0).round() as u8);
            last = Some(*address);
        }
        self.listed = last;
        bytes
    }

    /// Takes note of a packet, heard by the platform with the address `me`. Whether it was a beacon;
    /// other packets, and beacons that are broken, are left alone.
    pub fn hear(&mut self, me: ModelId, heard: Heard<'_>) -> bool {
        let Some(beacon) = Beacon::read(heard.payload) else {
            return false;
        };
        let neighbor = self.known.entry(heard.sender).or_insert_with(|| {
            let before = beacon.sequence.wrapping_sub(1);
            // Counted when its first beacon is noted, below.
            Neighbor {
                beacons: 0,
                received: 0,
                expected: 0,
                ..Neighbor::new(&heard, before)
            }
        });
        if !neighbor.note(&heard, beacon.sequence, &self.params) {
            return true;
        }
        let entries = beacon.list.chunks_exact(ENTRY);
        let mine = entries.clone().find_map(|entry| {
            let mut bytes = Bytes(entry);
            (bytes.u32()? == me.0).then(|| bytes.u8()).flatten()
        });
        if let Some(quality) = mine {
            neighbor.outbound = Some((f64::from(quality) / 255.0, heard.time));
        } else if entries.len() >= usize::from(beacon.known) {
            // It listed all it knows.
            neighbor.outbound = None;
        }
        true
    }

    /// The neighbours known, by address. Those who were silent for too long are among them until the
    /// next beacon is sent, or until they are [forgotten](Self::forget).
    pub fn neighbors(&self) -> impl ExactSizeIterator<Item = &Neighbor> {
        self.known.values()
    }

    /// What is known of one neighbour.
    pub fn neighbor(&self, address: ModelId) -> Option<&Neighbor> {
        self.known.get(&address)
    }

    /// Forgets those who were silent for too long, and what the others said of us too long ago.
    pub fn forget(&mut self, now: SimTime) {
        let silence = self.params.period * f64::from(self.params.expiry);
        let fresh = |then: SimTime| now - then <= silence;
        self.known.retain(|_, neighbor| fresh(neighbor.last_heard));
        // Where lists take turns, ours comes round after so many beacons.
        for neighbor in self.known.values_mut() {
            neighbor.outbound = neighbor.outbound.filter(|(_, said)| fresh(*said));
        }
    }
}

/// A beacon as it came in.
struct Beacon<'a> {
    sequence: u16,
    known: u8,
    list: &'a [u8],
}

impl<'a> Beacon<'a> {
    fn read(payload: &'a [u8]) -> Option<Self> {
        let mut bytes = Bytes(payload);
        let kind = bytes.u8()?;
        let (sequence, known) = (bytes.u16()?, bytes.u8()?);
        let list = bytes.rest();
        let whole = list.len().is_multiple_of(ENTRY) && list.len() / ENTRY <= usize::from(known);
        (kind == KIND && whole).then_some(Self {
            sequence,
            known,
            list,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn beacons(listed: u8) -> Beacons {
        let params = BeaconsParams {
            listed,
            ..BeaconsParams::default()
        };
        Beacons::new(params, Stream::new(1, "bee", "beacons")).expect("good parameters")
    }

    fn at(millis: u64) -> SimTime {
        SimTime::from_millis(millis)
    }

    fn heard(sender: u32, payload: &[u8], millis: u64) -> Heard<'_> {
        Heard {
            sender: ModelId(sender),
            payload,
            rssi: PowerLevel::from_dbm(-70.0),
            time: at(millis),
        }
    }

    /// A beacon without a list.
    fn bare(sequence: u16) -> Vec<u8> {
        let [low, high] = sequence.to_le_bytes();
        vec![KIND, low, high, 0]
    }

    /// The estimate of a link that receives the beacons which `passes` lets through.
    fn estimate(count: u16, passes: impl Fn(u16) -> bool) -> f64 {
        let mut mine = beacons(16);
        for sequence in (0..count).filter(|s| passes(*s)) {
            let millis = u64::from(sequence) * 1000;
            assert!(mine.hear(ModelId(0), heard(1, &bare(sequence), millis)));
        }
        mine.neighbor(ModelId(1)).expect("it was heard").inbound()
    }

    #[test]
    fn bytes_are_as_documented() {
        let mut mine = beacons(16);
        assert_eq!(mine.beacon(at(0)), [0xb1, 0, 0, 0]);
        mine.hear(ModelId(0), heard(0x0102_0304, &bare(7), 100));
        assert_eq!(mine.beacon(at(200)), [0xb1, 1, 0, 1, 4, 3, 2, 1, 255]);
    }

    #[test]
    fn the_estimate_is_the_share_received() {
        assert_eq!(estimate(100, |_| true), 1.0);
        // Every other one: 1 of the first window of 10 is the first beacon itself.
        assert!((estimate(200, |s| s % 2 == 0) - 0.5).abs() < 0.02);
        assert!((estimate(200, |s| s % 5 != 0) - 0.8).abs() < 0.02);
    }

    #[test]
    fn the_estimate_moves_to_a_new_share_by_one_minus_alpha_a_window() {
        // 10 of 10, then a window in which 5 of 10 come: 0.6 x 1 + 0.4 x 0.5.
        let found = estimate(21, |s| s < 10 || s % 2 == 1);
        assert!((found - 0.8).abs() < 1e-12, "{found}");
    }

    #[test]
    fn sequence_numbers_wrap_and_repeats_do_not_count() {
        let mut mine = beacons(16);
        for sequence in [u16::MAX - 1, u16::MAX, 0, 0, u16::MAX, 1] {
            mine.hear(ModelId(0), heard(1, &bare(sequence), 0));
        }
        let link = mine.neighbor(ModelId(1)).expect("it was heard");
        assert_eq!((link.beacons(), link.inbound()), (4, 1.0));
    }

    #[test]
    fn two_that_hear_each_other_know_it_and_one_that_is_not_heard_does_not() {
        let (mut ann, mut bob) = (beacons(16), beacons(16));
        for round in 0..3 {
            let (a, b) = (ann.beacon(at(round * 1000)), bob.beacon(at(round * 1000)));
            bob.hear(ModelId(1), heard(0, &a, round * 1000));
            ann.hear(ModelId(0), heard(1, &b, round * 1000));
        }
        let link = ann.neighbor(ModelId(1)).expect("it was heard");
        assert!(link.is_bidirectional() && link.etx() == Some(1.0));

        // Bob goes deaf: after five seconds his list says so.
        for round in 3..10 {
            let b = bob.beacon(at(round * 1000));
            ann.hear(ModelId(0), heard(1, &b, round * 1000));
        }
        let link = ann.neighbor(ModelId(1)).expect("it was heard");
        assert!(!link.is_bidirectional() && link.etx().is_none() && link.inbound() == 1.0);
    }

    #[test]
    fn whoever_is_silent_is_forgotten_after_five_periods() {
        let mut mine = beacons(16);
        mine.hear(ModelId(0), heard(3, &bare(0), 0));
        mine.hear(ModelId(0), heard(2, &bare(0), 1000));
        let addresses = |b: &Beacons| b.neighbors().map(|n| n.address().0).collect::<Vec<_>>();
        mine.forget(at(5000));
        assert_eq!(addresses(&mine), [2, 3], "by address");
        mine.forget(at(5001));
        assert_eq!(addresses(&mine), [2]);
    }

    #[test]
    fn more_neighbours_than_fit_take_turns() {
        let mut mine = beacons(2);
        for sender in 1..=5 {
            mine.hear(ModelId(0), heard(sender, &bare(0), 0));
        }
        let lists: Vec<Vec<u8>> = (0..5)
            .map(|_| {
                let beacon = mine.beacon(at(1));
                assert_eq!(beacon[3], 5);
                beacon[4..].chunks(ENTRY).map(|entry| entry[0]).collect()
            })
            .collect();
        assert_eq!(
            lists,
            [vec![1, 2], vec![3, 4], vec![5, 1], vec![2, 3], vec![4, 5]]
        );
    }

    #[test]
    fn pauses_stay_within_the_jitter_and_differ() {
        let mut mine = beacons(16);
        let pauses: Vec<f64> = (0..100).map(|_| mine.pause().secs()).collect();
        assert!(pauses.iter().all(|p| (0.9..=1.1).contains(p)));
        let mean = pauses.iter().sum::<f64>() / 100.0;
        assert!(
            (mean - 1.0).abs() < 0.025 && pauses[0] != pauses[1],
            "{mean}"
        );
    }

    proptest! {
        #[test]
        fn no_bytes_whatsoever_do_any_harm(
            packets in proptest::collection::vec(
                (0_u32..4, proptest::collection::vec(any::<u8>(), 0..130), any::<bool>()), 0..40)
        ) {
            let mut mine = beacons(22);
            for (index, (sender, mut payload, kind)) in packets.into_iter().enumerate() {
                if let (true, Some(first)) = (kind, payload.first_mut()) {
                    *first = KIND;
                }
                mine.hear(ModelId(0), heard(sender, &payload, index as u64 * 100));
                let beacon = mine.beacon(at(index as u64 * 100));
                prop_assert!(beacon.len() <= 116);
                prop_assert!(Beacon::read(&beacon).is_some());
                for neighbor in mine.neighbors() {
                    prop_assert!((0.0..=1.0).contains(&neighbor.inbound()));
                }
            }
        }
    }
}
