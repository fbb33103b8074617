//! What a round hands out: packets and outcomes, sorted by radio.

use super::air::Reception;
use crate::frame::{Frame, Outcome};
use crate::inbox::{Hit, Quality};
use crate::radio::RadioId;

/// The packets and outcomes of one round.
#[derive(Debug, Default)]
pub(super) struct Mail {
    /// Frames that ended in this round, in the order of (time, sender).
    pub(super) frames: Vec<Frame>,
    /// Who received each packet, and how.
    receivers: Vec<u32>,
    hits: Vec<Hit>,
    qualities: Vec<Quality>,
    /// First and number of the packets of each radio.
    spans: Vec<(u32, u32)>,
    reported: Vec<RadioId>,
    outcomes: Vec<Outcome>,
}

impl Mail {
    /// Room for one more radio.
    pub(super) fn grow(&mut self) {
        self.spans.push((0, 0));
    }

    /// Forgets the last round.
    pub(super) fn clear(&mut self) {
        for radio in self.receivers.drain(..) {
            self.spans[radio as usize] = (0, 0);
        }
        self.frames.clear();
        self.hits.clear();
        self.qualities.clear();
        self.reported.clear();
        self.outcomes.clear();
    }

    /// The last of `frames` was received by this radio.
    #[inline]
    pub(super) fn note(&mut self, radio: u32, reception: &Reception) {
        self.receivers.push(radio);
        self.hits.push(Hit {
            frame: self.frames.len() as u32 - 1,
            power_mw: reception.power_mw,
        });
        self.qualities.push(Quality {
            ln_success: reception.ln_success,
            sinr: reception.sinr,
        });
    }

    /// Sorts the packets by radio; those of a radio stay in the order of their frames.
    fn sort(&mut self) {
        let mut order: Vec<u32> = (0..self.receivers.len() as u32).collect();
        order.sort_by_key(|&at| self.receivers[at as usize]);
        self.hits = order.iter().map(|&at| self.hits[at as usize]).collect();
        let qualities = order.iter().map(|&at| self.qualities[at as usize]);
        self.qualities = qualities.collect();
        self.receivers.sort_unstable();
    }

    /// Sorts everything, and visits each radio that finds something, at least once.
    pub(super) fn seal(
        &mut self,
        reports: &mut Vec<(RadioId, Outcome)>,
        mut visit: impl FnMut(RadioId),
    ) {
        if !self.receivers.is_sorted() {
            self.sort();
        }
        for (at, &radio) in (0..).zip(&self.receivers) {
            let span = &mut self.spans[radio as usize];
            if span.1 == 0 {
                span.0 = at;
                visit(RadioId(radio));
            }
            span.1 += 1;
        }
        reports.sort_by_key(|&(radio, _)| radio);
        for (radio, outcome) in reports.drain(..) {
            visit(radio);
            self.reported.push(radio);
            self.outcomes.push(outcome);
        }
    }

    /// The packets of a radio.
    pub(super) fn packets(&self, radio: RadioId) -> (&[Hit], &[Quality]) {
        let (first, count) = self.spans[radio.index()];
        let span = first as usize..(first + count) as usize;
        (&self.hits[span.clone()], &self.qualities[span])
    }

    /// The outcomes of a radio's requests.
    pub(super) fn outcomes(&self, radio: RadioId) -> &[Outcome] {
        let first = self.reported.partition_point(|&r| r < radio);
        let count = self.reported[first..].partition_point(|&r| r == radio);
        &self.outcomes[first..first + count]
    }
}
