//! One radio: its queue, where it stands with the frame at its front, and its books.

use super::air::Tally;
use crate::channel::Channel;
use crate::counters::{Counters, Loss};
use crate::frame::{Frame, Ticket};
use crate::ledger::Ledger;
use crate::phy::{Access, CcaMode, Phy};
use crate::radio::RadioSpec;
use simbeeotic_kernel::ModelId;
use simbeeotic_units::Time;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// A radio's numbers in nanoseconds and milliwatts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Timing {
    pub(super) cca_ns: u64,
    pub(super) cca_mode: CcaMode,
    pub(super) busy_mw: f64,
    pub(super) noise_mw: f64,
    pub(super) turnaround_ns: u64,
    /// `None`: it sends at once.
    pub(super) csma: Option<CsmaTiming>,
    pub(super) acks: Option<AckTiming>,
    spacing_short_ns: u64,
    spacing_long_ns: u64,
    short_bytes_max: usize,
    pub(super) queue_frames: usize,
}

/// Unslotted CSMA/CA in nanoseconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct CsmaTiming {
    pub(super) unit_ns: u64,
    pub(super) min_be: u8,
    pub(super) max_be: u8,
    pub(super) max_backoffs: u8,
}

/// Acknowledgements in nanoseconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct AckTiming {
    pub(super) bytes: usize,
    pub(super) delay_ns: u64,
    pub(super) wait_ns: u64,
    pub(super) retries: u8,
}

impl Timing {
    pub(super) fn new(phy: &Phy, queue_frames: usize) -> Self {
        let csma = match phy.access {
            Access::Csma(csma) => Some(CsmaTiming {
                unit_ns: nanos(csma.unit_backoff),
                min_be: csma.min_be,
                max_be: csma.max_be,
                max_backoffs: csma.max_backoffs,
            }),
            Access::Aloha => None,
        };
        Self {
            cca_ns: nanos(phy.cca.time),
            cca_mode: phy.cca.mode,
            busy_mw: phy.cca.threshold.milliwatts(),
            noise_mw: phy.noise.milliwatts(),
            turnaround_ns: nanos(phy.turnaround),
            csma,
            acks: phy.acks.map(|acks| AckTiming {
                bytes: acks.bytes,
                delay_ns: nanos(acks.delay),
                wait_ns: nanos(acks.wait),
                retries: acks.retries,
            }),
            spacing_short_ns: nanos(phy.spacing.short),
            spacing_long_ns: nanos(phy.spacing.long),
            short_bytes_max: phy.spacing.short_bytes_max + phy.header_bytes,
            queue_frames,
        }
    }

    /// The pause after a frame of this length on the air.
    pub(super) fn spacing_ns(&self, bytes: usize) -> u64 {
        match bytes <= self.short_bytes_max {
            true => self.spacing_short_ns,
            false => self.spacing_long_ns,
        }
    }
}

/// A span in whole nanoseconds.
pub(super) fn nanos(time: Time) -> u64 {
    (time.secs() * 1e9).round() as u64
}

/// The longest frame: 73 minutes.
pub(super) const AIRTIME_NS_MAX: u64 = 1 << 42;

/// How long so many bytes are on the air, ns.
pub(super) fn airtime_ns(spec: &RadioSpec, bytes: usize) -> u64 {
    nanos(spec.frame_airtime(bytes))
}

/// A request on its way.
#[derive(Clone, Debug)]
pub(super) struct Job {
    pub(super) payload: Arc<[u8]>,
    pub(super) destination: Option<ModelId>,
    pub(super) ticket: Option<Ticket>,
    pub(super) submitted_ns: u64,
    /// Counts the requests of this radio: tells repetitions from new frames.
    pub(super) sequence: u64,
}

/// Where a radio stands with the job at the front of its queue.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Phase {
    /// There is none.
    #[default]
    Free,
    /// Waits at random, or for the assessment to begin.
    Backoff,
    /// Assesses the channel.
    Sensing,
    /// Would send at once, but an acknowledgement of its own comes first.
    Held,
    /// Turns around to send.
    Turning,
    /// Sends.
    Sending,
    /// Waits for the acknowledgement.
    AwaitingAck,
}

/// What a radio is sending.
#[derive(Clone, Debug)]
pub(super) struct Flight {
    /// Its number on the air.
    pub(super) id: u32,
    pub(super) what: Sent,
}

/// What kind of frame it is.
#[derive(Clone, Debug)]
pub(super) enum Sent {
    /// A packet.
    Data {
        frame: Frame,
        sequence: u64,
        /// How it wants to be acknowledged.
        acks: Option<AckTiming>,
    },
    /// An acknowledgement of the frame with this key.
    Ack { of: u64 },
}

/// Whether a radio hears.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Ear {
    Listening,
    /// It sends or turns around.
    Deaf,
    /// Also before it has joined a channel.
    #[default]
    Asleep,
}

/// How many frames of others began on the radio's channel, by what it was doing then.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Presence {
    pub(super) listening: u64,
    pub(super) deaf: u64,
    pub(super) asleep: u64,
    /// The band's count when the present state began.
    since: u64,
    /// Own frames since.
    pub(super) own: u64,
}

impl Presence {
    /// Closes the present state; the next one begins when its band has carried `next` frames.
    pub(super) fn closed(mut self, ear: Ear, started: u64, next: u64) -> Self {
        let others = started - self.since - self.own;
        match ear {
            Ear::Listening => self.listening += others,
            Ear::Deaf => self.deaf += others,
            Ear::Asleep => self.asleep += others,
        }
        Self {
            since: next,
            own: 0,
            ..self
        }
    }

    /// Begins to count in a band that has carried so many frames.
    pub(super) fn begin(&mut self, started: u64) {
        (self.since, self.own) = (started, 0);
    }
}

/// An assessment under way.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Assessment {
    /// Power times time up to `from_ns`, mW ns.
    energy: f64,
    /// The power from `from_ns` to `until_ns`, milliwatts.
    level_mw: f64,
    from_ns: u64,
    until_ns: u64,
    /// The highest power seen when a frame began, milliwatts.
    pub(super) peak_mw: f64,
}

impl Assessment {
    pub(super) fn begin(now_ns: u64) -> Self {
        Self {
            from_ns: now_ns,
            until_ns: now_ns,
            ..Self::default()
        }
    }

    fn energy(&self) -> f64 {
        self.energy + self.level_mw * (self.until_ns - self.from_ns) as f64
    }

    /// The power was this up to now. Looking without a change of power changes no bit.
    pub(super) fn see(&mut self, now_ns: u64, total_mw: f64) {
        if total_mw != self.level_mw {
            self.energy = self.energy();
            (self.level_mw, self.from_ns) = (total_mw, self.until_ns);
        }
        self.until_ns = now_ns;
    }

    /// The mean power since it began, `length_ns` ago, milliwatts; `now_mw` if it took no time.
    pub(super) fn mean_mw(&self, length_ns: u64, now_mw: f64) -> f64 {
        match length_ns {
            0 => now_mw,
            _ => self.energy() / length_ns as f64,
        }
    }
}

/// One radio.
#[derive(Debug)]
pub(super) struct Radio {
    pub(super) band: u32,
    pub(super) row: u32,
    pub(super) modulation: u32,
    pub(super) timing: Timing,
    pub(super) ear: Ear,
    /// Falls asleep when its frame has ended.
    pub(super) drowsy: bool,

    pub(super) jobs: VecDeque<Job>,
    /// Channels to change to, each when the requests before this number are done with.
    pub(super) tunings: VecDeque<(u64, Channel)>,
    pub(super) phase: Phase,
    /// Events with another token are void: that of the job at the front, and that of turning to listen.
    pub(super) token: u32,
    pub(super) ear_token: u32,
    /// Busy channels found for this frame, and the exponent of the next backoff.
    pub(super) busy: u8,
    pub(super) exponent: u8,
    /// How often this frame was sent again.
    pub(super) retries: u8,
    pub(super) assessment: Assessment,
    pub(super) flight: Option<Box<Flight>>,
    /// Key of the frame that waits for its acknowledgement, and its length on the air.
    pub(super) awaited: (u64, usize),
    /// The acknowledgement it is about to send: of which frame, and its length.
    pub(super) acking: Option<(u64, usize)>,
    /// The next frame must not begin its backoff before.
    pub(super) free_ns: u64,
    /// Last sequence number received from each radio, by its key.
    pub(super) last_from: BTreeMap<u64, u64>,

    pub(super) backoffs: u64,
    pub(super) requests: u64,
    pub(super) ledger: Ledger,
    pub(super) presence: Presence,
    /// What air and band had booked for it on channels it has left.
    pub(super) left: Tally,
    pub(super) left_beyond: u64,
    pub(super) dropped_asleep: u64,
    pub(super) books: Counters,
}

impl Radio {
    pub(super) fn new(timing: Timing) -> Self {
        Self {
            band: 0,
            row: 0,
            modulation: 0,
            timing,
            ear: Ear::default(),
            drowsy: false,
            jobs: VecDeque::new(),
            tunings: VecDeque::new(),
            phase: Phase::Free,
            token: 0,
            ear_token: 0,
            busy: 0,
            exponent: 0,
            retries: 0,
            assessment: Assessment::default(),
            flight: None,
            awaited: (0, 0),
            acking: None,
            free_ns: 0,
            last_from: BTreeMap::new(),
            backoffs: 0,
            requests: 0,
            ledger: Ledger::default(),
            presence: Presence::default(),
            left: Tally::default(),
            left_beyond: 0,
            dropped_asleep: 0,
            books: Counters::default(),
        }
    }

    /// Whether it is to change its channel before it does anything else.
    pub(super) fn tunes_next(&self) -> bool {
        let front = self.jobs.front();
        let next = self.tunings.front();
        next.is_some_and(|&(before, _)| front.is_none_or(|job| job.sequence >= before))
    }

    /// Voids the events of the job at the front.
    pub(super) fn void(&mut self) -> u32 {
        self.token = self.token.wrapping_add(1);
        self.token
    }

    /// Counters, from what the air has booked and how many frames its band has carried. `taking`: it is
    /// in the middle of a frame that counts. `weak`: why frames too weak to be taken up are lost.
    pub(super) fn counters(
        &self,
        tally: Tally,
        beyond: u64,
        started: u64,
        taking: bool,
        weak: Loss,
    ) -> Counters {
        let mut counters = self.books;
        let presence = self.presence.closed(self.ear, started, started);
        let heard = self.left.heard + tally.heard;
        let noise = self.left.noise + tally.noise;
        let dropped = self.left.dropped + tally.dropped;
        let got = self.left.got + tally.got;
        let beyond = self.left_beyond + beyond;
        let faint = presence.listening.saturating_sub(heard + beyond);
        let settled = got + noise + dropped + u64::from(taking);
        counters.received = got - counters.overheard - counters.repeated;
        counters.lose(Loss::OutOfRange, beyond);
        counters.lose(weak, faint);
        counters.lose(Loss::Noise, noise);
        counters.lose(Loss::Collision, heard.saturating_sub(settled));
        let sending = dropped - self.dropped_asleep.min(dropped);
        counters.lose(Loss::HalfDuplex, presence.deaf + sending);
        counters.lose(Loss::Asleep, presence.asleep + self.dropped_asleep);
        counters
    }

    /// Time spent in frames, but for the one under way, ns.
    pub(super) fn rx_ns(&self, tally: Tally) -> u64 {
        self.left.rx_ns + tally.rx_ns
    }

    /// Keeps what was booked on a channel that it leaves.
    pub(super) fn keep(&mut self, tally: Tally, beyond: u64) {
        self.left.heard += tally.heard;
        self.left.got += tally.got;
        self.left.noise += tally.noise;
        self.left.dropped += tally.dropped;
        self.left.rx_ns += tally.rx_ns;
        self.left_beyond += beyond;
    }
}
