//! What is to happen when: the events of a medium with air time, in one total order.
//!
//! Most of what a radio does between frames touches nobody but itself. Such events wait until the air
//! changes next, and are then done in their place: the engine is asked for a round only where a frame
//! begins or ends, or an owner must be told something.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

/// What happens. At one instant, in this order: signals that end or begin now have not arrived yet at
/// those whose assessment ends now; and what ends is gone before anything begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    /// An assessment of the channel ends.
    CcaEnd,
    /// A frame leaves the air.
    TxEnd,
    /// A radio has turned from sending to listening.
    RxOn,
    /// No acknowledgement came.
    Timeout,
    /// An acknowledgement goes on the air.
    AckStart,
    /// A frame goes on the air.
    TxStart,
    /// An assessment of the channel begins.
    CcaStart,
}

/// One event of one radio.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Event {
    pub(super) time_ns: u64,
    pub(super) kind: Kind,
    /// The radio's identity: orders what happens at one instant independently of numbering.
    pub(super) key: u64,
    pub(super) radio: u32,
    /// Void unless it is still the radio's own.
    pub(super) token: u32,
}

impl Ord for Event {
    fn cmp(&self, other: &Self) -> Ordering {
        let rank = |e: &Self| (e.time_ns, e.kind, e.key, e.token);
        rank(self).cmp(&rank(other))
    }
}

impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// The events to come.
#[derive(Debug, Default)]
pub(super) struct Agenda {
    /// Events that need a round at their time.
    due: BinaryHeap<Reverse<Event>>,
    /// Ends of assessments: what comes of them is seen no earlier than `lead_ns` later.
    assessments: BinaryHeap<Reverse<Event>>,
    /// Events that nobody sees.
    quiet: BinaryHeap<Reverse<Event>>,
    lead_ns: Option<u64>,
}

impl Agenda {
    /// From the end of an assessment to the start of the frame it takes at least so long, here too.
    pub(super) fn lead(&mut self, lead_ns: u64) {
        self.lead_ns = Some(self.lead_ns.map_or(lead_ns, |least| least.min(lead_ns)));
    }

    /// Adds an event. `prompt`: it needs a round at its time, whatever its kind.
    pub(super) fn push(&mut self, event: Event, prompt: bool) {
        let heap = match event.kind {
            _ if prompt => &mut self.due,
            Kind::TxEnd | Kind::Timeout | Kind::AckStart | Kind::TxStart => &mut self.due,
            Kind::CcaEnd => &mut self.assessments,
            Kind::RxOn | Kind::CcaStart => &mut self.quiet,
        };
        heap.push(Reverse(event));
    }

    /// When a round is needed.
    pub(super) fn next_ns(&self) -> Option<u64> {
        let due = self.due.peek().map(|e| e.0.time_ns);
        let lead_ns = self.lead_ns.unwrap_or(0);
        let assessed = self.assessments.peek();
        let assessed = assessed.map(|e| e.0.time_ns.saturating_add(lead_ns));
        match (due, assessed) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    /// Takes the first event that is due at `now_ns`.
    pub(super) fn pop(&mut self, now_ns: u64) -> Option<Event> {
        let heaps = [&mut self.due, &mut self.assessments, &mut self.quiet];
        let first = heaps
            .into_iter()
            .filter(|heap| heap.peek().is_some_and(|e| e.0.time_ns <= now_ns))
            .max_by_key(|heap| *heap.peek().expect("filtered by what it holds"))?;
        first.pop().map(|e| e.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(time_ns: u64, kind: Kind, key: u64) -> Event {
        Event {
            time_ns,
            kind,
            key,
            radio: 0,
            token: 0,
        }
    }

    #[test]
    fn events_come_by_time_then_kind_then_key() {
        let mut agenda = Agenda::default();
        let sorted = [
            event(5, Kind::CcaStart, 9),
            event(7, Kind::CcaEnd, 2),
            event(7, Kind::CcaEnd, 4),
            event(7, Kind::TxEnd, 3),
            event(7, Kind::RxOn, 1),
            event(7, Kind::TxStart, 1),
            event(7, Kind::CcaStart, 0),
            event(8, Kind::TxEnd, 0),
        ];
        for index in [3, 0, 7, 5, 1, 6, 2, 4] {
            agenda.push(sorted[index], false);
        }
        assert_eq!(agenda.pop(4), None);
        for expected in sorted {
            assert_eq!(agenda.pop(8), Some(expected));
        }
        assert_eq!(agenda.pop(u64::MAX), None);
    }

    #[test]
    fn what_nobody_sees_asks_for_no_round() {
        let mut agenda = Agenda::default();
        agenda.lead(192);
        agenda.push(event(5, Kind::CcaStart, 0), false);
        agenda.push(event(6, Kind::RxOn, 0), false);
        assert_eq!(agenda.next_ns(), None);
        agenda.push(event(10, Kind::CcaEnd, 0), false);
        assert_eq!(agenda.next_ns(), Some(202));
        agenda.push(event(50, Kind::CcaEnd, 1), true);
        assert_eq!(agenda.next_ns(), Some(50));
    }
}
