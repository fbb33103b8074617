//! One radio's place and its books, apart from its specification: what each reception touches.

use super::band::{Air, Members};
use super::pair::Reach;
use crate::counters::{Counters, Loss};
use crate::inbox::Hit;
use crate::ledger::{Ledger, Tally};
use simbeeotic_kernel::{ModelId, SimTime};

/// A radio of the simple medium.
///
/// What each reception touches lies in the first 64 bytes, a cache line: with thousands of radios that
/// hear each frame, their books are most of the memory that goes by.
#[derive(Debug)]
#[repr(C, align(64))]
pub(super) struct Radio {
    pub(super) band: u32,
    pub(super) row: u32,
    /// The last round that was booked here.
    booked: Tally,
    received: Tally,
    pub(super) ledger: Ledger,
    overheard: Tally,
    /// Frames within range and above the sensitivity, but for those counted in the band's columns.
    in_range: Tally,
    audible: Tally,
    pub(super) presence: Presence,
    /// The band that its next frames go out on, and that it listens to from the next round on.
    pub(super) sends_on: u32,
    /// Frames sent, ever.
    pub(super) sent: u64,
    /// Requests that did not become frames.
    pub(super) sent_asleep: u64,
    pub(super) too_long: u64,
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
    pub(super) fn new(band: u32, row: u32, band_sent: u64) -> Self {
        Self {
            band,
            row,
            sends_on: band,
            sent: 0,
            sent_asleep: 0,
            too_long: 0,
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

    /// A word of the line that a reception touches.
    #[inline]
    pub(super) fn touch(&self) -> u64 {
        self.booked.get()
    }

    /// Books what was heard in a round. Once: inboxes may be asked for again.
    #[inline]
    pub(super) fn book(&self, round: u64, now: SimTime, heard: &Heard) {
        if self.booked.get() == round {
            return;
        }
        self.booked.set(round);
        self.received.add(heard.received);
        if heard.airtime_ns > 0 {
            self.ledger.receive(now, heard.airtime_ns);
        }
        if heard.overheard > 0 {
            self.overheard.add(heard.overheard);
        }
        if heard.reach != Reach::default() {
            self.book_reach(heard.reach);
        }
    }

    /// Books frames that came within range, and those above the sensitivity.
    pub(super) fn book_reach(&self, reach: Reach) {
        self.in_range.add(reach.in_range);
        self.audible.add(reach.audible);
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
        let mut counters = Counters::default();
        (counters.sent, counters.received, counters.overheard) = (self.sent, received, overheard);
        // Saturating: in the middle of a round not all are booked.
        counters.lose(Loss::OutOfRange, presence.awake.saturating_sub(in_range));
        counters.lose(Loss::BelowSensitivity, in_range.saturating_sub(audible));
        counters.lose(Loss::Noise, audible.saturating_sub(received + overheard));
        counters.lose(Loss::Asleep, presence.asleep);
        counters.lose(Loss::SenderAsleep, self.sent_asleep);
        counters.lose(Loss::TooLong, self.too_long);
        counters
    }
}

impl Presence {
    fn closed(mut self, band_sent: u64, asleep: bool) -> Self {
        let others = band_sent - self.since - self.own;
        if asleep {
            self.asleep += others;
        } else {
            self.awake += others;
        }
        Self {
            since: band_sent,
            own: 0,
            ..self
        }
    }
}

impl Heard {
    /// Takes stock of some of the frames that got through.
    #[inline]
    pub(super) fn take_stock(&mut self, air: &Air, hits: &[Hit]) {
        if hits.is_empty() {
            return;
        }
        let longest = if air.alike {
            air.frames[0].airtime_ns
        } else {
            let airtimes = hits
                .iter()
                .map(|hit| air.frames[hit.frame as usize].airtime_ns);
            airtimes.max().unwrap_or(0)
        };
        self.airtime_ns = self.airtime_ns.max(longest);
        self.received += hits.len() as u64;
    }

    /// Takes stock, and puts the hits for `owner` in front. Returns how many these are.
    #[inline]
    pub(super) fn sort_out(&mut self, air: &Air, owner: ModelId, hits: &mut [Hit]) -> usize {
        self.take_stock(air, hits);
        if !air.addressed {
            return hits.len();
        }
        let mut kept = 0;
        for index in 0..hits.len() {
            let destination = air.frames[hits[index].frame as usize].destination;
            if destination.is_none_or(|destination| destination == owner) {
                hits[kept] = hits[index];
                kept += 1;
            }
        }
        let others = (hits.len() - kept) as u64;
        self.received -= others;
        self.overheard += others;
        kept
    }
}
