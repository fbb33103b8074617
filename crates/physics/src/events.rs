//! Working through time: what is predicted, when, and what happens when it comes.
//!
//! One thing is due at a time: two meet, a body stops sliding, an island takes a step, a body may leave
//! the ball of its neighbour list. Whatever changes a body's segment bumps its stamp, which voids all
//! that was predicted of it, and predicts anew. Predictions reach to a *horizon*; there all lists are
//! made anew, and all is predicted to the next horizon. While nothing moves that could touch anything,
//! there is no horizon.

use crate::body::{BodyId, Contacts};
use crate::contact::Contact;
use crate::duties::duty;
use crate::foresee::review_due;
use crate::limits;
use crate::motion::Motion;
use crate::physics::Physics;
use crate::predict::Passage;
use crate::queue::{Due, GROUND, Kind};
use crate::response::{self, Impact, Spot};
use crate::support::Support;
use crate::walls::Walls;
use simbeeotic_kernel::SimTime;

impl Physics {
    /// The earliest instant at which [`advance`](Self::advance) has something to do; `None` if nothing is
    /// ever going to happen by itself.
    pub fn next_time(&mut self) -> Option<SimTime> {
        if self.horizon <= self.clock {
            // Who advances to the horizon and does not settle would be sent there for ever.
            self.settle(self.clock);
        }
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
        if *self.asked.get_mut() && !self.list_all {
            (self.list_all, self.grown) = (true, true);
        }
        if self.grown {
            self.classify();
            self.horizon = now;
        }
        if now >= self.horizon || self.horizon == SimTime::MAX && self.wakes() {
            self.renew(now);
        } else {
            let mut dirty = std::mem::take(&mut self.dirty);
            self.tell_islands(&dirty, now);
            self.foresee_all(&dirty, |this, id, found| this.foresee(id, now, found));
            self.clean(&mut dirty);
        }
    }

    /// What was changed has been looked at.
    fn clean(&mut self, dirty: &mut Vec<u32>) {
        for id in dirty.drain(..) {
            self.duties[id as usize] &= !duty::DIRTY;
        }
        std::mem::swap(&mut self.dirty, dirty);
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
        while self.happens_by(now, contacts) {}
    }

    /// The next thing that is due until `now` happens, if there is one.
    fn happens_by(&mut self, now: SimTime, contacts: &mut Vec<Contact>) -> bool {
        match self.queue.peek(&self.motions) {
            Some(due) if due.time <= now && due.time <= self.horizon => {
                self.queue.pop();
                self.happen(due, contacts);
            }
            _ if self.horizon < now => self.renew(self.horizon),
            _ => return false,
        }
        true
    }

    /// Lists all bodies anew at `t`, and predicts to the next horizon.
    fn renew(&mut self, t: SimTime) {
        let watched = |id: &u32| self.watches(*id) && !self.motions[*id as usize].stands();
        let moving = self.movers.iter().any(watched);
        let horizon = t.saturating_add_nanos(self.list_period_ns);
        let filters = &self.filters;
        self.lists.build(
            &self.motions,
            &self.listed,
            |a, b| filters[a as usize].agrees(filters[b as usize]),
            (t, horizon),
            self.pool.as_deref(),
        );
        self.cover_walls();
        self.tally.listings += 1;
        self.queue.forget_predictions();
        let motions = &self.motions;
        self.encounters.prune(t, |pair| origin(motions, pair));
        self.horizon = if moving { horizon } else { SimTime::MAX };

        let mut dirty = std::mem::take(&mut self.dirty);
        self.tell_islands(&dirty, t);
        self.foresee_all(&dirty, |this, id, found| this.foresee_review(id, found));
        self.clean(&mut dirty);
        if !moving {
            return;
        }
        if self.ground.is_some() || self.has_walls {
            let movers = std::mem::take(&mut self.movers);
            self.foresee_all(&movers, |this, id, found| this.foresee_still(id, t, found));
            self.movers = movers;
        }
        let pairs = self.lists.take_pairs();
        self.foresee_all(&pairs, |this, pair, found| {
            this.foresee_pair(pair, t, found)
        });
        self.lists.give_pairs(pairs);
    }

    /// Sees to it that each body knows what stands within its ball of the lists.
    fn cover_walls(&mut self) {
        if !self.has_walls {
            return;
        }
        self.walls.resize_with(self.motions.len(), Walls::unknown);
        let mut room = Vec::new();
        for at in 0..self.movers.len() {
            self.cover_walls_of(self.movers[at], &mut room);
        }
    }

    fn cover_walls_of(&mut self, id: u32, room: &mut Vec<u32>) {
        if self.duties[id as usize] & duty::WALLS == 0 {
            return;
        }
        let (centre, allowance) = self.lists.ball(id);
        let radius = allowance + self.motions[id as usize].radius_m();
        let filters = &self.filters;
        let own = filters[id as usize];
        let agree = |wall: u32| own.agrees(filters[wall as usize]);
        self.walls[id as usize].cover(&self.statics, centre, radius, agree, room);
    }

    /// One thing happens.
    fn happen(&mut self, due: Due, contacts: &mut Vec<Contact>) {
        match due.kind {
            Kind::Leave => self.relist(due.a, due.time),
            Kind::Review => self.review(due.a, due.time),
            Kind::Step => self.step(due.a, due.time, contacts),
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
        if self.has_walls {
            self.cover_walls_of(id, &mut Vec::new());
        }
        self.tally.relistings += 1;
        self.predict_again(&[id], t);
    }

    fn review(&mut self, id: u32, t: SimTime) {
        // An earlier review may have been asked for after this one.
        if self.reviews[id as usize] != t {
            return;
        }
        self.reviews[id as usize] = SimTime::MAX;
        let motion = &mut self.motions[id as usize];
        if review_due(motion).is_some_and(|due| due <= t) {
            let from = motion.position(t);
            if motion.support == Support::Sliding {
                motion.slide(t);
            } else {
                motion.carry(t);
            }
            motion.stamp = motion.stamp.wrapping_add(1);
            self.odometer.changed(from, motion, t);
            self.tally.reviews += 1;
            self.predict_again(&[id], t);
        } else {
            self.foresee_all(&[id], |this, id, found| this.foresee_review(id, found));
        }
    }

    /// Two meet.
    fn meet(&mut self, due: Due, contacts: &mut Vec<Contact>) {
        let Due { time, a, b, .. } = due;
        let pair = (a, b);
        let spot = match b {
            GROUND => Spot::on_ground(self.side(a), time),
            _ if self.goes_first(a, b) => Spot::between(self.side(a), self.side(b), time),
            _ => Spot::between(self.side(b), self.side(a), time).flipped(),
        };
        if self.contact_of(a, b) != Contacts::Respond {
            // What only detects keeps its stamp, so the same meeting may have been predicted twice.
            if self.encounters.inside_since(pair).is_some() {
                return;
            }
            self.encounters.passed(pair, Passage::In, time);
            self.predict_passage(pair, time);
            let other = (b != GROUND).then(|| &self.motions[b as usize]);
            let impact = response::observe(&self.motions[a as usize], other, &spot, time);
            self.tally.contacts += 1;
            contacts.push(report(due, &impact));
            return;
        }
        let apart = self.encounters.bounced(pair, time);
        let impact = if b == GROUND {
            self.bounce_off_ground(a, &spot, time)
        } else {
            self.bounce(a, b, &spot, time)
        };
        if impact.in_vain {
            self.encounters.met_in_vain(pair, time);
        }
        self.tally.contacts += 1;
        if apart || impact.closing_speed() > limits::NEWS_SPEED_M_S {
            contacts.push(report(due, &impact));
        }
        if impact.lasts && self.lasts(pair) {
            self.join(a, b, time);
        }
        self.tell_islands(&[a, b], time);
        self.predict_again(&[a, b], time);
    }

    /// An island takes a step.
    fn step(&mut self, key: u32, t: SimTime, contacts: &mut Vec<Contact>) {
        let mut changed = std::mem::take(&mut self.stepped);
        changed.clear();
        let first = contacts.len();
        self.step_island(key, t, contacts, &mut changed);
        self.tally.contacts += (contacts.len() - first) as u64;
        self.tally.steps += 1;
        self.queue_steps();
        let sets_out = |id: &u32| !self.motions[*id as usize].stands();
        if self.horizon == SimTime::MAX && changed.iter().any(sets_out) {
            self.renew(t);
        } else {
            self.predict_again(&changed, t);
        }
        self.stepped = changed;
    }

    /// Bodies were changed: those in islands wake them. [`GROUND`] is passed over.
    fn tell_islands(&mut self, ids: &[u32], t: SimTime) {
        for &id in ids {
            if self.islands.is_member(id) {
                self.member_changed(id, t);
            }
        }
        self.wake_overloaded(t);
        self.queue_steps();
    }

    fn queue_steps(&mut self) {
        for (time, key) in self.islands.take_due() {
            self.queue.push(Due {
                time,
                kind: Kind::Step,
                a: key,
                b: key,
                stamps: [0; 2],
            });
        }
    }

    /// Whether a pair that does not come apart is to be handed to an island: at once if one of the two is
    /// in one, or turns when it is pushed; two balls, or a ball and a wall, after a few small bounces,
    /// which cost less than the island if someone pulls them apart soon.
    fn lasts(&self, pair @ (a, b): (u32, u32)) -> bool {
        let ball = |id: u32| id == GROUND || self.form(id).ball().is_some();
        let member = |id: u32| id != GROUND && self.motions[id as usize].support == Support::Island;
        let fixed = |id: u32| id == GROUND || self.duties[id as usize] & duty::FIXED != 0;
        let turns = |id: u32| !ball(id) && !fixed(id);
        turns(a)
            || turns(b)
            || member(a)
            || member(b)
            || self.uses_islands && self.encounters.bounces(pair) >= limits::BOUNCES_OF_BALLS
    }

    /// Two that only detect each other part.
    fn part(&mut self, pair: (u32, u32), t: SimTime) {
        if self.encounters.inside_since(pair).is_some() {
            self.encounters.passed(pair, Passage::Out, t);
            self.predict_passage(pair, t);
        }
    }

    fn predict_passage(&mut self, pair: (u32, u32), t: SimTime) {
        self.foresee_all(&[pair], |this, pair, found| {
            this.foresee_passage(pair, t, found)
        });
    }

    fn bounce(&mut self, a: u32, b: u32, spot: &Spot, t: SimTime) -> Impact {
        let material = self.material(a).against(&self.material(b));
        for id in [a, b] {
            if matches!(
                self.motions[id as usize].support,
                Support::Sliding | Support::Resting
            ) {
                self.encounters.carried(id, t);
            }
        }
        // The first of a pair has the lower index.
        let (before, from_b) = self.motions.split_at_mut(b as usize);
        let (motion_a, motion_b) = (&mut before[a as usize], &mut from_b[0]);
        let from = [motion_a.position(t), motion_b.position(t)];
        let impact = response::collide(motion_a, motion_b, spot, material, t);
        for (motion, from) in [motion_a, motion_b].into_iter().zip(from) {
            if motion.inverse_mass > 0.0 {
                motion.stamp = motion.stamp.wrapping_add(1);
            }
            self.odometer.changed(from, motion, t);
        }
        impact
    }

    fn bounce_off_ground(&mut self, a: u32, spot: &Spot, t: SimTime) -> Impact {
        let ground = self.ground.unwrap_or_default();
        let material = ground.against(&self.material(a));
        let stands = self.form(a).ball().is_some() && self.duties[a as usize] & duty::ROLLS == 0;
        let motion = &mut self.motions[a as usize];
        let from = motion.position(t);
        let impact = response::collide_ground(motion, spot, material, stands, t);
        motion.stamp = motion.stamp.wrapping_add(1);
        self.odometer.changed(from, motion, t);
        impact
    }

    /// Predicts everything about bodies that something has happened to; [`GROUND`] and what is fixed are
    /// passed over.
    pub(crate) fn predict_again(&mut self, ids: &[u32], t: SimTime) {
        let moves =
            |this: &Self, id: u32| id != GROUND && this.duties[id as usize] & duty::FIXED == 0;
        for &id in ids {
            if moves(self, id) {
                self.duties[id as usize] |= duty::DIRTY;
            }
        }
        self.foresee_all(ids, |this, id, found| {
            if moves(this, id) {
                this.foresee(id, t, found);
            }
        });
        for &id in ids {
            if moves(self, id) {
                self.duties[id as usize] &= !duty::DIRTY;
            }
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

pub(crate) fn report(due: Due, impact: &Impact) -> Contact {
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

#[cfg(test)]
mod tests;
