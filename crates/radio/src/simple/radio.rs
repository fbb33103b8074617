//! One radio and its books.

use super::band::{Air, Members};
use super::pair::Reach;
use crate::counters::{Counters, Loss};
use crate::inbox::Hit;
use crate::ledger::{Ledger, Tally};
use crate::radio::RadioSpec;
use simbeeotic_kernel::{ModelId, SimTime};

/// A radio of the simple medium.
#[derive(Debug)]
pub(super) struct Radio {
    pub(super) spec: RadioSpec,
    pub(super) band: u32,
    pub(super) row: u32,
    /// Frames sent, ever.
    pub(super) sent: u64,
    /// Requests that did not become frames.
    pub(super) refused: Counters,
    pub(super) ledger: Ledger,
    pub(super) presence: Presence,
    received: Tally,
    overheard: Tally,
    /// Frames within range and above the sensitivity, but for those counted in the band's columns.
    pub(super) in_range: Tally,
    pub(super) audible: Tally,
    /// The last round that was booked here.
    booked: Tally,
}

/// How many frames of others went over the radio's channel while it listened, and while it slept.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Presence {
    awake: u64,
    asleep: u64,
    /// The band's count when the present state began.
    since: u64,
    /// Own frames since.
    pub(super) own: u64,
}

/// What one receiver found among the frames of a round.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Heard {
    pub(super) reach: Reach,
    pub(super) received: u64,
    pub(super) overheard: u64,
    /// The longest air time among the frames received or overheard.
    pub(super) airtime_ns: u64,
}

impl Radio {
    pub(super) fn new(spec: RadioSpec, band: u32, row: u32, band_sent: u64) -> Self {
        Self {
            spec,
            band,
            row,
            sent: 0,
            refused: Counters::default(),
            ledger: Ledger::default(),
            presence: Presence {
                since: band_sent,
                ..Presence::default()
            },
            received: Tally::default(),
            overheard: Tally::default(),
            in_range: Tally::default(),
            audible: Tally::default(),
            booked: Tally::default(),
        }
    }

    /// Books what was heard in a round, once.
    pub(super) fn book(&self, round: u64, now: SimTime, heard: &Heard) {
        if self.booked.get() == round {
            return;
        }
        self.booked.set(round);
        self.in_range.add(u64::from(heard.reach.in_range));
        self.audible.add(u64::from(heard.reach.audible));
        self.received.add(heard.received);
        self.overheard.add(heard.overheard);
        if heard.airtime_ns > 0 {
            self.ledger.receive(now, heard.airtime_ns);
        }
    }

    /// Ends the present state; the next one begins when its band has carried `next_sent` frames.
    pub(super) fn turn_over(&mut self, band_sent: u64, next_sent: u64) {
        let asleep = self.ledger.asleep();
        self.presence = self.presence.closed(band_sent, asleep);
        self.presence.since = next_sent;
    }

    pub(super) fn counters(&self, band_sent: u64, members: &Members) -> Counters {
        let presence = self.presence.closed(band_sent, self.ledger.asleep());
        let row = self.row as usize;
        let in_range = self.in_range.get() + members.in_range[row];
        let audible = self.audible.get() + members.audible[row];
        let (received, overheard) = (self.received.get(), self.overheard.get());
        let mut counters = self.refused;
        (counters.sent, counters.received, counters.overheard) = (self.sent, received, overheard);
        // Saturating: in the middle of a round not all are booked.
        counters.lose(Loss::OutOfRange, presence.awake.saturating_sub(in_range));
        counters.lose(Loss::BelowSensitivity, in_range.saturating_sub(audible));
        counters.lose(Loss::Noise, audible.saturating_sub(received + overheard));
        counters.lose(Loss::Asleep, presence.asleep);
        counters
    }
}

impl Presence {
    fn closed(mut self, band_sent: u64, asleep: bool) -> Self {
        let others = band_sent - self.since - self.own;
        *(if asleep {
            &mut self.asleep
        } else {
            &mut self.awake
        }) += others;
        Self {
            since: band_sent,
            own: 0,
            ..self
        }
    }
}

impl Heard {
    /// Takes stock of `hits`, all that came through, and keeps those that are for `owner`.
    pub(super) fn sort_out(&mut self, air: &Air, owner: ModelId, hits: &mut Vec<Hit>, from: usize) {
        let frame = |hit: &Hit| &air.frames[hit.frame as usize];
        if air.alike {
            if hits.len() > from {
                self.airtime_ns = air.frames[0].airtime_ns;
            }
        } else {
            let longest = hits[from..].iter().map(|hit| frame(hit).airtime_ns).max();
            self.airtime_ns = self.airtime_ns.max(longest.unwrap_or(0));
        }
        if air.addressed {
            let mut kept = from;
            for index in from..hits.len() {
                let hit = hits[index];
                if frame(&hit)
                    .destination
                    .is_none_or(|destination| destination == owner)
                {
                    hits[kept] = hit;
                    kept += 1;
                }
            }
            self.overheard += (hits.len() - kept) as u64;
            hits.truncate(kept);
        }
        self.received += (hits.len() - from) as u64;
    }
}
