//! Working through time: what is predicted, when, and what happens when it comes.
//!
//! One thing is due at a time: two meet, a body stops sliding, a body may leave the ball of its
//! neighbour list. Whatever changes a body's segment bumps its stamp, which voids all that was predicted
//! of it, and predicts anew. Predictions reach to a *horizon*; there all lists are made anew, and all is
//! predicted to the next horizon. While nothing moves that could touch anything, there is no horizon.

use crate::body::{BodyId, Contacts};
use crate::contact::Contact;
use crate::limits;
use crate::motion::Motion;
use crate::physics::{Physics, duty};
use crate::predict::{self, Passage};
use crate::queue::{Due, GROUND, Kind};
use crate::response::{self, Impact};
use crate::support::Support;
use simbeeotic_kernel::SimTime;

impl Physics {
    /// The earliest instant at which [`advance`](Self::advance) has something to do; `None` if nothing is
    /// ever going to happen by itself.
    pub fn next_time(&mut self) -> Option<SimTime> {
        self.settle_if_dirty();
        let due = self
            .queue
            .peek(&self.motions)
            .map_or(SimTime::MAX, |due| due.time);
        let next = due.min(self.horizon);
        self.quiet_until = next;
        (next < SimTime::MAX).then_some(next)
    }

    /// Predicts the contacts of all bodies that have changed, as of `now`.
    pub fn settle(&mut self, now: SimTime) {
        self.clock = self.clock.max(now);
        self.quiet_until = SimTime::ZERO;
        let now = self.clock;
        if self.grown {
            self.classify();
            self.horizon = now;
        }
        if now >= self.horizon || self.horizon == SimTime::MAX && self.wakes() {
            self.renew(now);
        } else {
            let dirty = std::mem::take(&mut self.dirty);
            for &id in &dirty {
                self.predict(id, now);
            }
            for &id in &dirty {
                self.duties[id as usize] &= !duty::DIRTY;
            }
            self.dirty = dirty;
            self.dirty.clear();
        }
    }

    pub(crate) fn settle_if_dirty(&mut self) {
        if !self.dirty.is_empty() {
            self.settle(self.clock);
        }
    }

    /// Whether a changed body ends the rest of a world in which nothing moved.
    fn wakes(&self) -> bool {
        self.dirty.iter().any(|&id| {
            let motion = &self.motions[id as usize];
            self.watches(id) && (!motion.stands() || self.lists.displaced(id, motion))
        })
    }

    pub(crate) fn run_until(&mut self, now: SimTime, contacts: &mut Vec<Contact>) {
        loop {
            match self.queue.peek(&self.motions) {
                Some(due) if due.time <= now && due.time <= self.horizon => {
                    self.queue.pop();
                    self.happen(due, contacts);
                }
                _ if self.horizon < now => self.renew(self.horizon),
                _ => break,
            }
        }
    }

    /// Lists all bodies anew at `t`, and predicts to the next horizon.
    fn renew(&mut self, t: SimTime) {
        let moves = |id: usize, motion: &Motion| self.watches(id as u32) && !motion.stands();
        let moving = self
            .motions
            .iter()
            .enumerate()
            .any(|(id, motion)| moves(id, motion));
        let horizon = t.saturating_add_nanos(self.list_period_ns);
        let (duties, filters) = (&self.duties, &self.filters);
        self.lists.build(
            &self.motions,
            |id| duties[id as usize] & duty::LISTED != 0,
            |a, b| filters[a as usize].agrees(filters[b as usize]),
            t,
            horizon,
        );
        self.tally.listings += 1;
        self.queue.forget_predictions();
        let motions = &self.motions;
        self.encounters.prune(t, |pair| origin(motions, pair));
        self.horizon = if moving { horizon } else { SimTime::MAX };

        for id in std::mem::take(&mut self.dirty) {
            self.duties[id as usize] &= !duty::DIRTY;
            self.review_later(id);
        }
        if !moving {
            return;
        }
        if self.ground.is_some() {
            for id in 0..self.motions.len() as u32 {
                self.predict_ground(id, t);
            }
        }
        for place in 0..self.lists.pairs().len() {
            let (a, b) = self.lists.pairs()[place];
            self.predict_pair(a, b, t);
        }
    }

    /// Predicts everything about one body, as of `now`. Of two dirty bodies the first predicts the pair.
    fn predict(&mut self, id: u32, now: SimTime) {
        self.review_later(id);
        if self.horizon == SimTime::MAX {
            return;
        }
        self.predict_ground(id, now);
        let duties = self.duties[id as usize];
        if duties & duty::LISTED != 0 {
            self.predict_leave(id, now);
        }
        if duties & duty::MEETS != 0 {
            for place in self.lists.range(id) {
                self.predict_neighbour(id, self.lists.neighbour(place), now);
            }
            for place in 0..self.lists.extra(id).len() {
                self.predict_neighbour(id, self.lists.extra(id)[place], now);
            }
        }
    }

    #[inline]
    fn predict_neighbour(&mut self, id: u32, other: u32, now: SimTime) {
        if other > id || self.duties[other as usize] & duty::DIRTY == 0 {
            self.predict_pair(id, other, now);
        }
    }

    fn predict_pair(&mut self, i: u32, j: u32, now: SimTime) {
        let pair @ (a, b) = (i.min(j), i.max(j));
        let (motion_a, motion_b) = (&self.motions[a as usize], &self.motions[b as usize]);
        let origin = motion_a.t0.max(motion_b.t0);
        let (from, passage) = self.encounters.search_from(pair, origin);
        self.tally.searches += 1;
        let jumped = self
            .encounters
            .inside_since(pair)
            .is_some_and(|since| since < origin)
            && predict::pair_apart(motion_a, motion_b, origin);
        let time = if jumped {
            Some(now)
        } else {
            predict::pair_passage(motion_a, motion_b, passage, from, now, self.horizon)
        };
        if let Some(time) = time {
            let stamps = [motion_a.stamp, motion_b.stamp];
            self.queue.push(Due {
                time,
                kind: kind(passage),
                a,
                b,
                stamps,
            });
        }
    }

    #[inline]
    fn predict_ground(&mut self, id: u32, now: SimTime) {
        let motion = &self.motions[id as usize];
        if self.duties[id as usize] & duty::GROUND == 0 || motion.support != Support::None {
            return;
        }
        let pair = (id, GROUND);
        let (from, passage) = self.encounters.search_from(pair, motion.t0);
        let jumped = self
            .encounters
            .inside_since(pair)
            .is_some_and(|since| since < motion.t0)
            && predict::ground_apart(motion, motion.t0);
        let time = if jumped {
            Some(now)
        } else {
            predict::ground_passage(motion, passage, from, now, self.horizon)
        };
        if let Some(time) = time {
            self.queue.push(Due {
                time,
                kind: kind(passage),
                a: id,
                b: GROUND,
                stamps: [motion.stamp, 0],
            });
        }
    }

    fn predict_leave(&mut self, id: u32, now: SimTime) {
        let motion = &self.motions[id as usize];
        let time = self.lists.leaves(id, motion, now);
        if time < self.horizon {
            self.queue.push(Due {
                time,
                kind: Kind::Leave,
                a: id,
                b: id,
                stamps: [motion.stamp; 2],
            });
        }
    }

    /// Sees to it that a body which slides or tumbles is looked at when its segment ends. One entry a
    /// body stays in the queue: one that comes too early finds out, and asks for the right time.
    fn review_later(&mut self, id: u32) {
        let motion = &self.motions[id as usize];
        let Some(time) = review_due(motion) else {
            return;
        };
        let queued = &mut self.reviews[id as usize];
        if time < *queued {
            *queued = time;
            self.queue.push(Due {
                time,
                kind: Kind::Review,
                a: id,
                b: id,
                stamps: [0; 2],
            });
        }
    }

    /// One thing happens.
    fn happen(&mut self, due: Due, contacts: &mut Vec<Contact>) {
        match due.kind {
            Kind::Leave => self.relist(due.a, due.time),
            Kind::Review => self.review(due.a, due.time),
            Kind::Meet => self.meet(due, contacts),
            Kind::Part => self.part((due.a, due.b), due.time),
        }
    }

    fn relist(&mut self, id: u32, t: SimTime) {
        if self.lists.crowded() {
            self.renew(t);
            return;
        }
        let filters = &self.filters;
        let agree = |a: u32, b: u32| filters[a as usize].agrees(filters[b as usize]);
        self.lists.relist(id, &self.motions, agree, t, self.horizon);
        self.tally.relistings += 1;
        self.predict(id, t);
    }

    fn review(&mut self, id: u32, t: SimTime) {
        // An earlier review may have been asked for after this one.
        if self.reviews[id as usize] != t {
            return;
        }
        self.reviews[id as usize] = SimTime::MAX;
        let motion = &mut self.motions[id as usize];
        if review_due(motion).is_some_and(|due| due <= t) {
            if motion.support == Support::Sliding {
                motion.slide(t);
            } else {
                motion.carry(t);
            }
            motion.stamp = motion.stamp.wrapping_add(1);
            self.tally.reviews += 1;
            self.predict(id, t);
        } else {
            self.review_later(id);
        }
    }

    /// Two meet.
    fn meet(&mut self, due: Due, contacts: &mut Vec<Contact>) {
        let Due { time, a, b, .. } = due;
        let pair = (a, b);
        let respond = if b == GROUND {
            self.duties[a as usize] & duty::RESPONDS != 0
                && self.motions[a as usize].inverse_mass > 0.0
        } else {
            self.contact_of(a, b) == Contacts::Respond
        };
        let impact = if respond {
            let apart = self.encounters.bounced(pair, time);
            let impact = if b == GROUND {
                self.bounce_off_ground(a, time)
            } else {
                self.bounce(a, b, time)
            };
            self.predict_again(&[a, b], time);
            if !apart && impact.closing_speed() <= limits::NEWS_SPEED_M_S {
                self.tally.contacts += 1;
                return;
            }
            impact
        } else {
            // What only detects keeps its stamp, so the same meeting may have been predicted twice.
            if self.encounters.inside_since(pair).is_some() {
                return;
            }
            self.encounters.passed(pair, Passage::In, time);
            self.predict_passage(pair, time);
            let motion_a = &self.motions[a as usize];
            if b == GROUND {
                response::observe_ground(motion_a, time)
            } else {
                response::observe_pair(motion_a, &self.motions[b as usize], time)
            }
        };
        self.tally.contacts += 1;
        contacts.push(report(due, &impact));
    }

    /// Two that only detect each other part.
    fn part(&mut self, pair: (u32, u32), t: SimTime) {
        if self.encounters.inside_since(pair).is_some() {
            self.encounters.passed(pair, Passage::Out, t);
            self.predict_passage(pair, t);
        }
    }

    fn predict_passage(&mut self, (a, b): (u32, u32), t: SimTime) {
        if b == GROUND {
            self.predict_ground(a, t)
        } else {
            self.predict_pair(a, b, t)
        }
    }

    fn bounce(&mut self, a: u32, b: u32, t: SimTime) -> Impact {
        let material = self.materials[a as usize].against(&self.materials[b as usize]);
        for id in [a, b] {
            if self.motions[id as usize].support != Support::None {
                self.encounters.carried(id, t);
            }
        }
        // The first of a pair has the lower index.
        let (before, from_b) = self.motions.split_at_mut(b as usize);
        let (motion_a, motion_b) = (&mut before[a as usize], &mut from_b[0]);
        let impact = response::collide_pair(motion_a, motion_b, material, t);
        for motion in [motion_a, motion_b] {
            if motion.inverse_mass > 0.0 {
                motion.stamp = motion.stamp.wrapping_add(1);
            }
        }
        impact
    }

    fn bounce_off_ground(&mut self, a: u32, t: SimTime) -> Impact {
        let ground = self.ground.unwrap_or_default();
        let material = ground.against(&self.materials[a as usize]);
        let motion = &mut self.motions[a as usize];
        let impact = response::collide_ground(motion, material, t);
        motion.stamp = motion.stamp.wrapping_add(1);
        impact
    }

    /// Predicts everything about bodies that something has happened to; [`GROUND`] is passed over.
    fn predict_again(&mut self, ids: &[u32], t: SimTime) {
        let bodies = || ids.iter().copied().filter(|id| *id != GROUND);
        for id in bodies() {
            self.duties[id as usize] |= duty::DIRTY;
        }
        for id in bodies() {
            self.predict(id, t);
        }
        for id in bodies() {
            self.duties[id as usize] &= !duty::DIRTY;
        }
    }
}

/// Since when the segments of a pair hold.
fn origin(motions: &[Motion], (a, b): (u32, u32)) -> SimTime {
    let first = motions[a as usize].t0;
    if b == GROUND {
        first
    } else {
        first.max(motions[b as usize].t0)
    }
}

/// When the segment of a body that slides or tumbles ends.
fn review_due(motion: &Motion) -> Option<SimTime> {
    match (motion.slide_due(), motion.respin_due()) {
        (Some(slide), Some(respin)) => Some(slide.min(respin)),
        (slide, respin) => slide.or(respin),
    }
}

fn kind(passage: Passage) -> Kind {
    match passage {
        Passage::In => Kind::Meet,
        Passage::Out => Kind::Part,
    }
}

fn report(due: Due, impact: &Impact) -> Contact {
    Contact {
        time: due.time,
        a: BodyId(due.a),
        b: (due.b != GROUND).then_some(BodyId(due.b)),
        point_enu: impact.point,
        normal_enu: impact.normal,
        relative_velocity_enu: impact.relative_velocity,
        impulse_enu: impact.impulse,
    }
}
