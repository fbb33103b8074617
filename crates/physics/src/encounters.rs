//! What has to be remembered of pairs: who touches whom unanswered, and who meets too often.
//!
//! Most pairs need no memory: after a bounce both segments are new, and say all. Exceptions:
//!
//! - A pair that only *detects* passes through itself on unchanged segments. From its meeting on it is
//!   *inside*, until it has parted.
//! - A body squeezed between two others that nothing can push away (a ghost pressing it to the ground)
//!   would bounce infinitely often within a nanosecond. A pair of bodies that has met [`BURST_MAX`]
//!   times, each within [`BURST_NS`] of the last, is *held*: it does not meet again for [`HOLD_NS`], and
//!   overlaps meanwhile. With the ground it takes [`BURST_MAX_GROUND`] times in one instant: whoever is
//!   pressed into it is pressed by other bodies, and it is enough to hold those pairs.
//! - Who meets *in vain*, so that nothing comes of it, would meet again in the same instant, for ever. Such
//!   a pair is held at once, the ground too. It happens where two overlap or touch in several places: one
//!   piece of a compound closes in while another is deeper and comes out, and an impact is that of the
//!   deepest.
//!
//! Memory of the last impact serves once more: a pair that has met within [`LASTING_S`] has not been
//! apart, and meeting anew is no news (see [`Contact`](crate::Contact)).
//!
//! The ground is [`GROUND`](crate::queue::GROUND), always as the second of a pair.

use crate::limits::LASTING_S;
use crate::predict::Passage;
use crate::queue::GROUND;
use simbeeotic_kernel::SimTime;
use std::collections::BTreeMap;

/// Meetings of one pair in close succession, after which it is held.
const BURST_MAX: u32 = 16;
/// Meetings with the ground at one instant, after which it is held: more than a dozen neighbours that are
/// held in turn can cause.
const BURST_MAX_GROUND: u32 = 256;
/// Meetings this close in time belong to one burst.
const BURST_NS: u64 = 5_000_000;
/// For how long a pair is held.
const HOLD_NS: u64 = 1_000_000;
/// [`LASTING_S`] in nanoseconds.
const LASTING_NS: u64 = (LASTING_S * 1e9) as u64;

type Pair = (u32, u32);

#[derive(Clone, Copy, Debug)]
struct Touch {
    since: SimTime,
    inside: bool,
}

#[derive(Clone, Copy, Debug)]
struct Burst {
    last: SimTime,
    /// Meetings in close succession.
    count: u32,
    /// Meetings since the two were last apart.
    lasting: u32,
}

impl Burst {
    fn at(last: SimTime) -> Self {
        Self {
            last,
            count: 0,
            lasting: 0,
        }
    }
}

/// The memory of pairs, almost always almost empty.
#[derive(Debug, Default)]
pub(crate) struct Encounters {
    touches: BTreeMap<Pair, Touch>,
    holds: BTreeMap<Pair, SimTime>,
    bursts: BTreeMap<Pair, Burst>,
}

impl Encounters {
    /// From when on, and for which passage, a pair whose segments hold since `origin` is searched.
    #[inline]
    pub(crate) fn search_from(&self, pair: Pair, origin: SimTime) -> (SimTime, Passage) {
        if self.touches.is_empty() && self.holds.is_empty() {
            return (origin, Passage::In);
        }
        let origin = self
            .holds
            .get(&pair)
            .map_or(origin, |until| origin.max(*until));
        match self.touches.get(&pair) {
            Some(touch) if touch.inside => (origin.max(touch.since), Passage::Out),
            Some(touch) => (origin.max(touch.since), Passage::In),
            None => (origin, Passage::In),
        }
    }

    /// Since when a pair that is inside has been there.
    pub(crate) fn inside_since(&self, pair: Pair) -> Option<SimTime> {
        self.touches
            .get(&pair)
            .filter(|touch| touch.inside)
            .map(|touch| touch.since)
    }

    /// A pair that only detects has met or parted.
    pub(crate) fn passed(&mut self, pair: Pair, passage: Passage, t: SimTime) {
        self.touches.insert(
            pair,
            Touch {
                since: t,
                inside: passage == Passage::In,
            },
        );
    }

    /// A pair has bounced; holds it if it does so all the time. Tells whether it had been apart.
    pub(crate) fn bounced(&mut self, pair: Pair, t: SimTime) -> bool {
        let apart = self
            .bursts
            .get(&pair)
            .is_none_or(|burst| t.nanos() - burst.last.nanos() >= LASTING_NS);
        let burst = self.bursts.entry(pair).or_insert(Burst::at(t));
        let (most, within_ns) = if pair.1 == GROUND {
            (BURST_MAX_GROUND, 0)
        } else {
            (BURST_MAX, BURST_NS)
        };
        let close = t.nanos() - burst.last.nanos() <= within_ns;
        let more = |count: u32, goes_on: bool| if goes_on { count.saturating_add(1) } else { 1 };
        *burst = Burst {
            last: t,
            count: more(burst.count, close),
            lasting: more(burst.lasting, !apart),
        };
        if burst.count > most {
            self.holds.insert(pair, t.saturating_add_nanos(HOLD_NS));
        }
        apart
    }

    /// A pair has met at `t`, and nothing came of it: holds it.
    pub(crate) fn met_in_vain(&mut self, pair: Pair, t: SimTime) {
        self.holds.insert(pair, t.saturating_add_nanos(HOLD_NS));
    }

    /// How often a pair has bounced since it was last apart.
    pub(crate) fn bounces(&self, pair: Pair) -> u32 {
        self.bursts.get(&pair).map_or(0, |burst| burst.lasting)
    }

    /// The ground has carried a body until now.
    pub(crate) fn carried(&mut self, id: u32, t: SimTime) {
        self.bursts.entry((id, GROUND)).or_insert(Burst::at(t)).last = t;
    }

    /// Forgets what can have no effect any more at `t`; `origin` tells since when a pair's segments hold.
    pub(crate) fn prune(&mut self, t: SimTime, origin: impl Fn(Pair) -> SimTime) {
        self.bursts
            .retain(|_, burst| t.nanos() - burst.last.nanos() < LASTING_NS);
        self.holds.retain(|pair, until| origin(*pair) < *until);
        self.touches
            .retain(|pair, touch| touch.inside || origin(*pair) <= touch.since);
    }
}
