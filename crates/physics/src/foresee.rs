//! What is going to happen to a body: read from the bodies as they are, changing nothing.
//!
//! All of it takes `&self`, so that many bodies are foreseen by many threads at once. What they find is
//! put into the queue in the order of the bodies, whoever found it: and the queue would sort it anyway.

use crate::approach::Side;
use crate::duties::duty;
use crate::motion::Motion;
use crate::physics::Physics;
use crate::predict::{self, Passage, Search};
use crate::queue::{Due, GROUND, Kind};
use crate::support::Support;
use rayon::prelude::*;
use simbeeotic_kernel::SimTime;

/// Fewer bodies or pairs than this are foreseen by one thread.
const PARALLEL_MIN: usize = 1024;
/// Bodies or pairs that one thread takes at a time.
const CHUNK: usize = 512;

/// What has been foreseen.
#[derive(Debug, Default)]
pub(crate) struct Foreseen {
    pub(crate) dues: Vec<Due>,
    pub(crate) searches: u64,
}

impl Physics {
    /// Calls `foresee` for each of `items`, in parallel if there are many, and queues what it finds.
    pub(crate) fn foresee_all<T: Copy + Send + Sync>(
        &mut self,
        items: &[T],
        foresee: impl Fn(&Self, T, &mut Foreseen) + Sync,
    ) {
        let mut found = std::mem::take(&mut self.foreseen);
        if let Some(pool) = self.pool.as_ref().filter(|_| items.len() >= PARALLEL_MIN) {
            let this = &*self;
            let chunk = |items: &[T]| {
                let mut found = Foreseen::default();
                items
                    .iter()
                    .for_each(|item| foresee(this, *item, &mut found));
                found
            };
            let chunks: Vec<Foreseen> =
                pool.install(|| items.par_chunks(CHUNK).map(chunk).collect());
            for mut chunk in chunks {
                self.expect(&mut chunk);
            }
        } else {
            items
                .iter()
                .for_each(|item| foresee(self, *item, &mut found));
            self.expect(&mut found);
        }
        self.foreseen = found;
    }

    /// Puts what has been foreseen into the queue.
    fn expect(&mut self, found: &mut Foreseen) {
        self.tally.searches += std::mem::take(&mut found.searches);
        for due in found.dues.drain(..) {
            if due.kind == Kind::Review {
                let queued = &mut self.reviews[due.a as usize];
                if due.time >= *queued {
                    continue;
                }
                *queued = due.time;
            }
            if due.kind == Kind::Leave && due.time <= self.clock {
                self.lists.strays_from_now(due.a);
            }
            self.queue.push(due);
        }
    }

    /// Everything about one body, as of `now`. Of two dirty bodies the first foresees the pair.
    pub(crate) fn foresee(&self, id: u32, now: SimTime, found: &mut Foreseen) {
        self.foresee_review(id, found);
        if self.horizon == SimTime::MAX {
            return;
        }
        self.foresee_ground(id, now, found);
        self.foresee_walls(id, now, found);
        let duties = self.duties[id as usize];
        if duties & duty::LISTED != 0 {
            self.foresee_leave(id, now, found);
        }
        if duties & duty::MEETS != 0 {
            let listed = self
                .lists
                .range(id)
                .map(|place| self.lists.neighbour(place));
            for other in listed.chain(self.lists.extra(id).iter().copied()) {
                if other > id || self.duties[other as usize] & duty::DIRTY == 0 {
                    self.foresee_pair((id, other), now, found);
                }
            }
        }
    }

    /// What a body may meet that does not move: at a listing, where pairs are foreseen apart.
    pub(crate) fn foresee_still(&self, id: u32, now: SimTime, found: &mut Foreseen) {
        self.foresee_ground(id, now, found);
        self.foresee_walls(id, now, found);
    }

    /// Sees to it that a body which slides or tumbles is looked at when its segment ends. One entry a
    /// body stays in the queue: one that comes too early finds out, and asks for the right time.
    pub(crate) fn foresee_review(&self, id: u32, found: &mut Foreseen) {
        let motion = &self.motions[id as usize];
        if let Some(time) = review_due(motion)
            && time < self.reviews[id as usize]
        {
            found.dues.push(Due {
                time,
                kind: Kind::Review,
                a: id,
                b: id,
                stamps: [0; 2],
            });
        }
    }

    #[inline]
    fn foresee_ground(&self, id: u32, now: SimTime, found: &mut Foreseen) {
        let motion = &self.motions[id as usize];
        if self.duties[id as usize] & duty::GROUND != 0 && motion.support == Support::None {
            self.foresee_passage((id, GROUND), now, found);
        }
    }

    #[inline]
    fn foresee_walls(&self, id: u32, now: SimTime, found: &mut Foreseen) {
        if self.duties[id as usize] & duty::WALLS == 0
            || self.motions[id as usize].support == Support::Island
        {
            return;
        }
        for wall in self.walls[id as usize].near() {
            self.foresee_passage((id, *wall), now, found);
        }
    }

    fn foresee_leave(&self, id: u32, now: SimTime, found: &mut Foreseen) {
        let motion = &self.motions[id as usize];
        let time = self.lists.leaves(id, motion, now);
        if time < self.horizon {
            found.dues.push(Due {
                time,
                kind: Kind::Leave,
                a: id,
                b: id,
                stamps: [motion.stamp; 2],
            });
        }
    }

    /// When two bodies meet, unless an island sees to it.
    #[inline]
    pub(crate) fn foresee_pair(&self, pair: (u32, u32), now: SimTime, found: &mut Foreseen) {
        if !self.islands.together(pair.0, pair.1) {
            self.foresee_passage(pair, now, found);
        }
    }

    /// When two meet, or part.
    #[inline]
    pub(crate) fn foresee_passage(&self, (i, j): (u32, u32), now: SimTime, found: &mut Foreseen) {
        let pair @ (a, b) = (i.min(j), i.max(j));
        let side_a = self.side(a);
        let side_b = (b != GROUND).then(|| self.side(b));
        let origin = side_b.map_or(side_a.motion.t0, |b| side_a.motion.t0.max(b.motion.t0));
        let (from, passage) = self.encounters.search_from(pair, origin);
        found.searches += 1;
        let jumped = passage == Passage::Out
            && self
                .encounters
                .inside_since(pair)
                .is_some_and(|since| since < origin)
            && predict::apart(side_a, side_b, origin);
        // Beyond the end of a segment nothing has to be known.
        let ends = |motion: &Motion| review_due(motion).unwrap_or(SimTime::MAX);
        let until = self
            .islands
            .until(a)
            .min(self.islands.until(b))
            .min(ends(side_a.motion))
            .min(side_b.map_or(SimTime::MAX, |b| ends(b.motion)));
        let search = Search {
            passage,
            origin: from,
            now,
            horizon: self.horizon.min(until),
            until,
        };
        let time = match side_b {
            _ if jumped => Some(now),
            Some(side_b) if self.goes_first(a, b) => predict::pair_passage(side_a, side_b, &search),
            Some(side_b) => predict::pair_passage(side_b, side_a, &search),
            None => predict::ground_passage(side_a, &search),
        };
        if let Some(time) = time {
            let stamp_b = side_b.map_or(0, |b| b.motion.stamp);
            found.dues.push(Due {
                time,
                kind: match passage {
                    Passage::In => Kind::Meet,
                    Passage::Out => Kind::Part,
                },
                a,
                b,
                stamps: [side_a.motion.stamp, stamp_b],
            });
        }
    }

    /// Whether of two bodies `a` is the one that is seen from.
    #[inline]
    pub(crate) fn goes_first(&self, a: u32, b: u32) -> bool {
        self.rank(a) < self.rank(b)
    }

    /// Decides who of several comes first where that shows in the last bits of a result: not their numbers,
    /// which depend on who was added first, but where they began.
    #[inline]
    pub(crate) fn rank(&self, id: u32) -> (u64, u32) {
        (self.origins[id as usize], id)
    }

    /// A body as a search sees it.
    #[inline]
    pub(crate) fn side(&self, id: u32) -> Side<'_> {
        Side {
            motion: &self.motions[id as usize],
            form: self.form(id),
        }
    }
}

/// When the segment of a body that slides or tumbles ends.
pub(crate) fn review_due(motion: &Motion) -> Option<SimTime> {
    match (motion.slide_due(), motion.respin_due()) {
        (Some(slide), Some(respin)) => Some(slide.min(respin)),
        (slide, respin) => slide.or(respin),
    }
}
