//! What a round hands out: packets and outcomes, sorted by radio.

use crate::frame::{Frame, Outcome};
use crate::inbox::{Hit, Quality};
use crate::radio::RadioId;

/// The packets and outcomes of one round.
#[derive(Debug, Default)]
pub(super) struct Mail {
    /// Frames that ended in this round, in the order of (time, sender).
    pub(super) frames: Vec<Frame>,
    notes: Vec<(u32, Hit, Quality)>,
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
        for (radio, ..) in self.notes.drain(..) {
            self.spans[radio as usize] = (0, 0);
        }
        self.frames.clear();
        self.hits.clear();
        self.qualities.clear();
        self.reported.clear();
        self.outcomes.clear();
    }

    /// The last of `frames` is for this radio.
    pub(super) fn note(&mut self, radio: u32, power_mw: f32, quality: Quality) {
        let frame = self.frames.len() as u32 - 1;
        self.notes.push((radio, Hit { frame, power_mw }, quality));
    }

    /// Sorts everything, and visits each radio that finds something, at least once.
    pub(super) fn seal(
        &mut self,
        reports: &mut Vec<(RadioId, Outcome)>,
        mut visit: impl FnMut(RadioId),
    ) {
        if !self.notes.is_sorted_by_key(|note| note.0) {
            // Stable: the packets of a radio stay in the order of their frames.
            self.notes.sort_by_key(|note| note.0);
        }
        for (at, &(radio, hit, quality)) in (0..).zip(&self.notes) {
            self.hits.push(hit);
            self.qualities.push(quality);
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
