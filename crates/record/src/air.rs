//! Packets, counters and links: what they are, and how they stand on the wire.

use crate::message::{self, Timestamp};
use crate::messages::Messages;
use crate::recording::{ReadError, Recording, topic_list};
use crate::topic::Topic;
use simbeeotic_model::radio::Loss;
use std::ops::RangeInclusive;

/// One transmission, and who received it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Packet {
    /// Virtual time at which the transmission began, ns since the start of the run.
    pub time_ns: u64,
    /// Path of the model that sent it: `bee-17`.
    pub sender: String,
    /// Path of the radio that sent it: `bee-17/radio`.
    pub radio: String,
    /// Number of the channel, if it is one of IEEE 802.15.4 (11 to 26), else 0.
    pub channel: u8,
    /// Middle of the channel, Hz.
    pub frequency_hz: f64,
    /// Path of the model that it is for; empty: for everybody.
    pub destination: String,
    /// Its length on the air, headers and all.
    pub bytes: u32,
    /// The length of what the model sent.
    pub payload_bytes: u32,
    /// How long it is on the air, ns.
    pub airtime_ns: u64,
    /// Power fed into the antenna, dBm.
    pub power_dbm: f64,
    /// Where the sender's platform was when it began (east, north, up), m.
    pub position_m: [f64; 3],
    /// The radios that handed it to their owners.
    pub receptions: Vec<Received>,
}

/// A packet as one radio received it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Received {
    /// Path of the radio: `bee-3/radio`.
    pub radio: String,
    /// Virtual time at which it was handed to the owner, ns.
    pub time_ns: u64,
    /// Received signal strength, dBm.
    pub rssi_dbm: f32,
    /// The same above the radio's mean noise, dB.
    pub snr_db: f32,
    /// Link quality, 0 to 255.
    pub lqi: u8,
}

/// What became of the frames of one radio, or of all, in one period and since the start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Traffic {
    /// Virtual time of the period's end, ns. The period is open at its start and closed at its end.
    pub time_ns: u64,
    /// Length of the period, s; 0 for the instant at which the run starts.
    pub period_s: f64,
    /// Path of the radio; empty: all radios together.
    pub radio: String,
    /// In this period.
    pub period: Tallies,
    /// Since the start of the run.
    pub total: Tallies,
}

/// Numbers of frames.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tallies {
    /// Put on the air.
    pub sent: u64,
    /// Received and handed to the owner.
    pub received: u64,
    /// Received, and for somebody else.
    pub overheard: u64,
    /// Lost, by reason ([`Loss::name`](simbeeotic_model::radio::Loss::name)); each reason once.
    pub lost: Vec<(String, u64)>,
}

impl Tallies {
    /// Frames that a radio in reach of their sender did not receive, for any reason; those that were never sent are
    /// not among them.
    #[must_use]
    pub fn missed_in_reach(&self) -> u64 {
        let in_reach = |why: &Loss| why.is_at_receiver() && *why != Loss::OutOfRange;
        let reasons = Loss::ALL.into_iter().filter(in_reach);
        reasons.map(|why| self.lost(why.name())).sum()
    }

    /// Frames lost for one reason.
    pub fn lost(&self, reason: &str) -> u64 {
        let mut lost = self.lost.iter();
        lost.find(|(name, _)| name == reason).map_or(0, |(_, n)| *n)
    }
}

/// How well recorded radios heard each other in one period.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Links {
    /// Virtual time of the period's end, ns.
    pub time_ns: u64,
    /// Length of the period, s.
    pub period_s: f64,
    /// Paths of the radios.
    pub radios: Vec<String>,
    /// The ordered pairs between which there was a frame.
    pub links: Vec<Link>,
}

/// One ordered pair of radios.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The sender's place in [`Links::radios`].
    pub from: u32,
    /// The receiver's.
    pub to: u32,
    /// Frames of the sender for this receiver or for everybody that ended in this period, and began
    /// while the receiver was awake and on their channel.
    pub sent: u32,
    /// Those of them that it received.
    pub received: u32,
    /// Mean RSSI of those, in decibels, dBm; NaN if there were none.
    pub rssi_dbm: f32,
    /// Mean distance between the two platforms as the frames began, m.
    pub distance_m: f32,
}

impl Link {
    /// The share of frames that were received, 0 to 1; NaN if there were none.
    pub fn share(&self) -> f32 {
        self.received as f32 / self.sent.max(self.received) as f32
    }
}

impl Packet {
    pub(crate) fn pack(self) -> message::Packet {
        let [x, y, z] = self.position_m;
        let mut packed = message::Packet {
            timestamp: Some(Timestamp::from_ns(self.time_ns)),
            sender: self.sender,
            radio: self.radio,
            channel: self.channel.into(),
            frequency_hz: self.frequency_hz,
            destination: self.destination,
            bytes: self.bytes.cast_signed(),
            payload_bytes: self.payload_bytes.cast_signed(),
            airtime_ns: self.airtime_ns.cast_signed(),
            power_dbm: self.power_dbm,
            position: Some(message::Vector3 { x, y, z }),
            ..Default::default()
        };
        for received in self.receptions {
            packed.receivers.push(received.radio);
            packed.rssi_dbm.push(received.rssi_dbm);
            packed.snr_db.push(received.snr_db);
            packed.lqi.push(received.lqi.into());
            let delay = received.time_ns.saturating_sub(self.time_ns);
            packed.delay_ns.push(delay.cast_signed());
        }
        packed
    }

    fn unpack(time_ns: u64, packed: message::Packet) -> Option<Self> {
        let count = packed.receivers.len();
        let fits = [
            packed.rssi_dbm.len(),
            packed.snr_db.len(),
            packed.lqi.len(),
            packed.delay_ns.len(),
        ];
        if fits != [count; 4] {
            return None;
        }
        let position = packed.position.unwrap_or_default();
        let receptions = packed
            .receivers
            .into_iter()
            .enumerate()
            .map(|(at, radio)| Received {
                radio,
                time_ns: time_ns.saturating_add_signed(packed.delay_ns[at]),
                rssi_dbm: packed.rssi_dbm[at],
                snr_db: packed.snr_db[at],
                lqi: packed.lqi[at].clamp(0, 255) as u8,
            });
        Some(Self {
            time_ns,
            sender: packed.sender,
            radio: packed.radio,
            channel: packed.channel.clamp(0, 255) as u8,
            frequency_hz: packed.frequency_hz,
            destination: packed.destination,
            bytes: packed.bytes.cast_unsigned(),
            payload_bytes: packed.payload_bytes.cast_unsigned(),
            airtime_ns: packed.airtime_ns.cast_unsigned(),
            power_dbm: packed.power_dbm,
            position_m: [position.x, position.y, position.z],
            receptions: receptions.collect(),
        })
    }
}

impl Traffic {
    pub(crate) fn pack(self) -> message::Radio {
        let count = |n: u64| n.cast_signed();
        let (period, total) = (&self.period, &self.total);
        let reasons: Vec<String> = total.lost.iter().map(|(name, _)| name.clone()).collect();
        message::Radio {
            timestamp: Some(Timestamp::from_ns(self.time_ns)),
            period_s: self.period_s,
            sent: count(period.sent),
            received: count(period.received),
            overheard: count(period.overheard),
            lost: reasons
                .iter()
                .map(|reason| count(period.lost(reason)))
                .collect(),
            reasons,
            sent_total: count(total.sent),
            received_total: count(total.received),
            overheard_total: count(total.overheard),
            lost_total: total.lost.iter().map(|(_, n)| count(*n)).collect(),
            radio: self.radio,
        }
    }

    fn unpack(time_ns: u64, packed: message::Radio) -> Option<Self> {
        let count = packed.reasons.len();
        if packed.lost.len() != count || packed.lost_total.len() != count {
            return None;
        }
        let lost = |numbers: &[i64]| {
            let numbers = numbers.iter().map(|n| n.cast_unsigned());
            packed.reasons.iter().cloned().zip(numbers).collect()
        };
        let n = i64::cast_unsigned;
        Some(Self {
            time_ns,
            period_s: packed.period_s,
            period: Tallies {
                sent: n(packed.sent),
                received: n(packed.received),
                overheard: n(packed.overheard),
                lost: lost(&packed.lost),
            },
            total: Tallies {
                sent: n(packed.sent_total),
                received: n(packed.received_total),
                overheard: n(packed.overheard_total),
                lost: lost(&packed.lost_total),
            },
            radio: packed.radio,
        })
    }
}

impl Links {
    pub(crate) fn pack(self) -> message::Links {
        let links = &self.links;
        let whole = |part: fn(&Link) -> u32| links.iter().map(|l| part(l).cast_signed()).collect();
        message::Links {
            timestamp: Some(Timestamp::from_ns(self.time_ns)),
            period_s: self.period_s,
            from: whole(|link| link.from),
            to: whole(|link| link.to),
            sent: whole(|link| link.sent),
            received: whole(|link| link.received),
            rssi_dbm: links.iter().map(|link| link.rssi_dbm).collect(),
            distance_m: links.iter().map(|link| link.distance_m).collect(),
            radios: self.radios,
        }
    }

    fn unpack(time_ns: u64, packed: message::Links) -> Option<Self> {
        let count = packed.from.len();
        let fits = [
            packed.to.len(),
            packed.sent.len(),
            packed.received.len(),
            packed.rssi_dbm.len(),
            packed.distance_m.len(),
        ];
        let radios = packed.radios.len();
        let known = |place: &i32| usize::try_from(*place).is_ok_and(|place| place < radios);
        if fits != [count; 5] || !packed.from.iter().chain(&packed.to).all(known) {
            return None;
        }
        let links = (0..count).map(|at| Link {
            from: packed.from[at].cast_unsigned(),
            to: packed.to[at].cast_unsigned(),
            sent: packed.sent[at].cast_unsigned(),
            received: packed.received[at].cast_unsigned(),
            rssi_dbm: packed.rssi_dbm[at],
            distance_m: packed.distance_m[at],
        });
        Some(Self {
            time_ns,
            period_s: packed.period_s,
            links: links.collect(),
            radios: packed.radios,
        })
    }
}

impl Recording {
    /// The packets whose transmission began at these virtual times, ns, in order of their ends.
    pub fn packets_in(
        &self,
        times_ns: RangeInclusive<u64>,
    ) -> impl Iterator<Item = Result<Packet, ReadError>> + '_ {
        self.unpacked(Topic::Packets, times_ns, Packet::unpack)
    }

    /// The counters of radios, of the periods that ended at these virtual times, ns.
    pub fn traffic_in(
        &self,
        times_ns: RangeInclusive<u64>,
    ) -> impl Iterator<Item = Result<Traffic, ReadError>> + '_ {
        self.unpacked(Topic::Radio, times_ns, Traffic::unpack)
    }

    /// How well radios heard each other, in the periods that ended at these virtual times, ns.
    pub fn links_in(
        &self,
        times_ns: RangeInclusive<u64>,
    ) -> impl Iterator<Item = Result<Links, ReadError>> + '_ {
        self.unpacked(Topic::Links, times_ns, Links::unpack)
    }

    /// The messages of a topic at these virtual times, ns, as `unpack` makes them.
    pub(crate) fn unpacked<M: prost::Message + Default, T>(
        &self,
        topic: Topic,
        times_ns: RangeInclusive<u64>,
        unpack: fn(u64, M) -> Option<T>,
    ) -> impl Iterator<Item = Result<T, ReadError>> {
        let mut messages = Messages::new(self, topic_list(topic), times_ns);
        std::iter::from_fn(move || {
            Some(messages.next()?.and_then(|found| {
                let message = messages.decode(&found)?;
                unpack(found.time_ns, message).ok_or_else(|| {
                    messages.damaged(format!("a message of {} in disorder", topic.name()))
                })
            }))
        })
    }
}
