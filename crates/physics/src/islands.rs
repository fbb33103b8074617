//! Bodies in lasting contact, stepped together.
//!
//! An impact is an instant, and is answered by an impulse. Contact that lasts is not a row of instants:
//! bodies that press upon one another, or that roll, topple and stack, form an *island*, which advances
//! in steps of its own, `Config::island_step` long. Everything else goes on without steps, and an island
//! at rest costs nothing.
//!
//! - **Trajectories stay the truth.** A step from `t` to `t + dt` is computed at `t`, and each member gets
//!   a segment from `t` on that leads to the pose found, at constant velocity and body rate. So its place
//!   is known, and continuous, at any time. The wrench that was set waits in the segment and goes on
//!   acting ([`Support::Island`](crate::Support::Island)).
//! - **Commands act with the next step.** A member whose segment somebody has changed is taken over as it
//!   then is. A change of course that would carry it noticeably astray until then cuts the step short.
//! - **Join and leave.** Whoever touches a member lastingly joins; two islands become one. A member that
//!   has touched nothing for four steps flies on freely.
//! - **Rest.** A group that touch one another and have all been still for half a second are put to rest:
//!   their segments stand, their island has no next step, and no world. It wakes when one of them
//!   moves, or is joined, or when what acts on them becomes more than the points they rest on can bear
//!   (`rest`): a gust that moves nothing wakes nobody.
//! - **Nothing but its own history** goes into an island: the order of its members is that of their ids,
//!   and it shares no state with another.
//!
//! For the queue: [`Islands::take_due`] hands out `(time, key)` of steps to come; an entry is void unless
//! [`Islands::due`] says so when it comes. After [`Physics::step_island`] the bodies in `changed` follow
//! new segments.

use crate::body::Mobility;
use crate::contact::Contact;
use crate::duties::duty;
use crate::island::{Sweep, World};
use crate::motion::{Motion, seconds_between};
use crate::physics::Physics;
use crate::queue::GROUND;
use crate::rest::{self, Bearing, Rester};
use crate::rotation;
use crate::shape::form::Place;
use crate::stepping::STILL_S;
use glam::DVec3;
use rapier3d_f64::dynamics::RigidBodyHandle;
use simbeeotic_kernel::SimTime;

/// A change of course that takes a member farther than this share of its radius from where it was to be
/// at the end of the step cuts the step short.
const ASTRAY: f64 = 0.02;
/// No slot: the body is in no island.
const NOWHERE: u32 = u32::MAX;

/// What an island knows of a segment that it has written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Led {
    /// The segment, as written.
    pub(crate) motion: Motion,
    /// The step: from when to when, and how fast at its ends.
    pub(crate) span: [SimTime; 2],
    pub(crate) sweeps: [Sweep; 2],
}

/// A body in an island.
#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) id: u32,
    /// Its body in the island's world; `None` until the next step takes it in.
    pub(crate) body: Option<RigidBodyHandle>,
    pub(crate) led: Option<Led>,
    /// Where the world has it.
    pub(crate) at: Place,
    /// Fixed bodies within are in the world.
    pub(crate) scope: [DVec3; 2],
    /// For how long it has been still, s.
    pub(crate) still_s: f64,
    /// Where it has been since, but for a swaying that is no farther than one who is still may get,
    pub(crate) anchor: Place,
    /// and for how long, s.
    pub(crate) stay_s: f64,
    /// Its segment stands.
    pub(crate) resting: bool,
    /// Steps since it touched something.
    pub(crate) alone: u32,
}

impl Member {
    fn new(id: u32) -> Self {
        Self {
            id,
            body: None,
            led: None,
            at: Place {
                p: DVec3::ZERO,
                q: glam::DQuat::IDENTITY,
            },
            scope: [DVec3::INFINITY, DVec3::NEG_INFINITY],
            still_s: 0.0,
            anchor: Place {
                p: DVec3::ZERO,
                q: glam::DQuat::IDENTITY,
            },
            stay_s: 0.0,
            resting: false,
            alone: 0,
        }
    }

    /// Takes it out of its world.
    pub(crate) fn detach(&mut self) {
        self.body = None;
        self.scope = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        self.still_s = 0.0;
        self.stay_s = 0.0;
        self.resting = false;
        self.alone = 0;
    }

    /// Whether it may be at rest: it has been still, or swayed about one place and is still now.
    pub(crate) fn stays(&self) -> bool {
        self.resting || self.stay_s >= STILL_S && self.still_s > 0.0
    }

    /// Whether somebody else has begun a new segment.
    pub(crate) fn changed(&self, motion: &Motion) -> bool {
        self.led.is_none_or(|led| led.motion.stamp != motion.stamp)
    }

    /// Whether somebody else has moved it, or changed how it moves.
    pub(crate) fn moved(&self, motion: &Motion) -> bool {
        self.changed(motion) && !self.led.is_some_and(|led| follows(&led.motion, motion))
    }

    /// Whether somebody else lets something else act on it: a control law may say again what held already.
    pub(crate) fn pushed(&self, motion: &Motion) -> bool {
        self.changed(motion) && !self.led.is_some_and(|led| alike(&led.motion, motion))
    }

    /// How it moves at `t`: as the world says, and as its segment was changed since.
    pub(crate) fn sweep(&self, motion: &Motion, t: SimTime) -> Sweep {
        let state = motion.at(t);
        let turning = |w_flu: DVec3| state.world_from_body * w_flu;
        let Some(led) = &self.led else {
            return Sweep {
                v: state.v_enu,
                w: turning(state.w_flu),
            };
        };
        let [from, to] = led.span;
        let whole = seconds_between(from, to);
        let part = if whole > 0.0 {
            (seconds_between(from, t) / whole).clamp(0.0, 1.0)
        } else {
            1.0
        };
        let [before, after] = led.sweeps;
        let mut sweep = Sweep {
            v: before.v.lerp(after.v, part),
            w: before.w.lerp(after.w, part),
        };
        if led.motion.stamp != motion.stamp {
            sweep.v += state.v_enu - led.motion.velocity(t);
            sweep.w += turning(state.w_flu - led.motion.rate(t));
        }
        sweep
    }
}

/// Bodies that are stepped together.
#[derive(Debug, Default)]
pub(crate) struct Island {
    pub(crate) world: Option<Box<World>>,
    /// By id.
    pub(crate) members: Vec<Member>,
    /// Fixed bodies in the world, ascending.
    pub(crate) fixed: Vec<u32>,
    /// Who pressed upon whom in the last step, ascending.
    pub(crate) touches: Vec<(u32, u32)>,
    /// When the next step is due; `None` at rest.
    pub(crate) next: Option<SimTime>,
    /// The present step was cut short: all members are taken over as they are.
    pub(crate) cut: bool,
    /// Somebody has come to rest since it was last asked who rests together.
    pub(crate) settling: bool,
    /// At rest: the points that its members rest on.
    pub(crate) bearings: Vec<Bearing>,
    /// At rest: something else acts on a member, and whether the points bear it is to be asked.
    asked: bool,
    /// Whether somebody can rest under what acts on it is not asked again before.
    pub(crate) doubtful_until: SimTime,
}

impl Island {
    /// An island of these, which are sorted by id.
    pub(crate) fn of(members: impl Iterator<Item = Member>) -> Self {
        Self {
            members: members.collect(),
            ..Self::default()
        }
    }

    /// The member by which the island is known: that with the lowest id.
    pub(crate) fn key(&self) -> u32 {
        self.members.first().map_or(NOWHERE, |member| member.id)
    }

    pub(crate) fn position(&self, id: u32) -> Option<usize> {
        self.members
            .binary_search_by_key(&id, |member| member.id)
            .ok()
    }

    /// Whether the points that its members rest on bear what acts on them.
    pub(crate) fn bears(&mut self, motions: &[Motion], upright: impl Fn(u32) -> bool) -> bool {
        let rester = |member: &Member| {
            let motion = &motions[member.id as usize];
            let turns = !upright(member.id);
            Rester {
                inverse_mass: motion.inverse_mass,
                inverse_inertia: if turns {
                    motion.inverse_inertia()
                } else {
                    DVec3::ZERO
                },
                attitude: motion.q,
                linear: motion.a,
                torque: motion.torque(),
            }
        };
        let resters: Vec<Rester> = self.members.iter().map(rester).collect();
        rest::bears(&mut self.bearings, &resters)
    }

    /// Gives up the world; the next step makes a new one.
    pub(crate) fn detach(&mut self) {
        self.world = None;
        self.fixed.clear();
        for member in &mut self.members {
            member.detach();
        }
    }

    /// Takes the members of another over.
    fn absorb(&mut self, mut other: Self) {
        other.detach();
        self.members.append(&mut other.members);
        self.members.sort_by_key(|member| member.id);
        self.touches.append(&mut other.touches);
        self.touches.sort_unstable();
        self.bearings.clear();
    }
}

/// All islands.
#[derive(Debug)]
pub(crate) struct Islands {
    slots: Vec<Island>,
    vacant: Vec<u32>,
    /// The slot of each body's island.
    places: Vec<u32>,
    due: Vec<(SimTime, u32)>,
    /// Islands at rest on whose members something else acts.
    asked: Vec<u32>,
    pub(crate) step_ns: u64,
    pub(crate) solver_iterations: usize,
}

impl Islands {
    /// No island yet.
    pub(crate) fn new(step_ns: u64, solver_iterations: usize) -> Self {
        Self {
            slots: Vec::new(),
            vacant: Vec::new(),
            places: Vec::new(),
            due: Vec::new(),
            asked: Vec::new(),
            step_ns,
            solver_iterations,
        }
    }

    fn slot(&self, id: u32) -> Option<u32> {
        self.places
            .get(id as usize)
            .copied()
            .filter(|slot| *slot != NOWHERE)
    }

    fn island(&self, id: u32) -> Option<&Island> {
        self.slot(id).map(|slot| &self.slots[slot as usize])
    }

    /// How the velocity [ENU] and the rate of turn [ENU] of a member changed in its island's last step, per
    /// second. 0 at rest, and before its first step.
    pub(crate) fn change(&self, id: u32) -> Sweep {
        let still = Sweep {
            v: DVec3::ZERO,
            w: DVec3::ZERO,
        };
        let Some(island) = self.island(id) else {
            return still;
        };
        let member = island.position(id).map(|at| &island.members[at]);
        let Some(led) = member.filter(|m| !m.resting).and_then(|m| m.led) else {
            return still;
        };
        let [from, to] = led.span;
        let span = seconds_between(from, to);
        if span <= 0.0 {
            return still;
        }
        let [before, after] = led.sweeps;
        Sweep {
            v: (after.v - before.v) / span,
            w: (after.w - before.w) / span,
        }
    }

    /// Whether a body is in an island.
    pub(crate) fn is_member(&self, id: u32) -> bool {
        self.slot(id).is_some()
    }

    /// Whether two bodies are in one island, which then sees to their contact.
    pub(crate) fn together(&self, a: u32, b: u32) -> bool {
        self.slot(a).is_some_and(|slot| self.slot(b) == Some(slot))
    }

    /// When a body begins a new segment because its island takes a step; never, if it is in none.
    pub(crate) fn until(&self, id: u32) -> SimTime {
        self.island(id)
            .and_then(|island| island.next)
            .unwrap_or(SimTime::MAX)
    }

    /// Whether a step of the island known by `key` is due at `time`: else, the entry is void.
    pub(crate) fn due(&self, key: u32, time: SimTime) -> bool {
        self.island(key)
            .is_some_and(|island| island.key() == key && island.next == Some(time))
    }

    /// Steps to be put into the queue since the last call: when, and of which island.
    pub(crate) fn take_due(&mut self) -> std::vec::Drain<'_, (SimTime, u32)> {
        self.due.drain(..)
    }

    /// Puts the next step of an island up for the queue.
    fn announce(&mut self, slot: u32) {
        let island = &self.slots[slot as usize];
        if let Some(next) = island.next {
            self.due.push((next, island.key()));
        }
    }

    /// Lends out the island in `slot`; [`give_back`](Self::give_back) it.
    fn lend(&mut self, slot: u32) -> Island {
        std::mem::take(&mut self.slots[slot as usize])
    }

    fn give_back(&mut self, slot: u32, island: Island) {
        if island.members.is_empty() {
            self.vacant.push(slot);
            return;
        }
        self.slots[slot as usize] = island;
        self.announce(slot);
    }

    /// The slot of a body's island: a new one, if it is in none.
    fn slot_of(&mut self, id: u32) -> u32 {
        self.slot(id).unwrap_or_else(|| {
            let mut island = Island::default();
            island.members.push(Member::new(id));
            self.settle(island)
        })
    }

    /// Finds a slot for a new island.
    fn settle(&mut self, island: Island) -> u32 {
        let slot = self.vacant.pop().unwrap_or_else(|| {
            self.slots.push(Island::default());
            self.slots.len() as u32 - 1
        });
        for member in &island.members {
            self.house(member.id, slot);
        }
        self.give_back(slot, island);
        slot
    }

    fn house(&mut self, id: u32, slot: u32) {
        let needed = id as usize + 1;
        if self.places.len() < needed {
            self.places.resize(needed, NOWHERE);
        }
        self.places[id as usize] = slot;
    }

    /// A body is in no island any more.
    fn evict(&mut self, id: u32) {
        self.places[id as usize] = NOWHERE;
    }

    /// The island in `slot` has its next step at `t`.
    fn wake(&mut self, slot: u32, t: SimTime) {
        let island = &mut self.slots[slot as usize];
        island.next = Some(t);
        island.bearings.clear();
        self.announce(slot);
    }

    /// Something else acts on a member of an island at rest.
    fn ask(&mut self, slot: u32) {
        let island = &mut self.slots[slot as usize];
        if !std::mem::replace(&mut island.asked, true) {
            self.asked.push(slot);
        }
    }

    /// Two islands become one: the one without a world, else the smaller, else that of the least
    /// origin goes into the other, whose slot is returned. The next step of the two is the earlier one: nobody
    /// is led on beyond the step that was computed.
    fn merge(&mut self, a: u32, b: u32, origins: &[u64]) -> u32 {
        let rank = |slot: u32| {
            let island = &self.slots[slot as usize];
            let size = island.members.len();
            let began = island.members.iter().map(|m| origins[m.id as usize]);
            (island.world.is_some(), size, began.max(), slot)
        };
        let (stays, goes) = if rank(a) > rank(b) { (a, b) } else { (b, a) };
        let other = self.lend(goes);
        self.vacant.push(goes);
        for member in &other.members {
            self.places[member.id as usize] = stays;
        }
        let island = &mut self.slots[stays as usize];
        if let (Some(next), Some(earlier)) = (island.next, other.next)
            && earlier < next
        {
            island.next = Some(earlier);
            island.cut = true;
        }
        island.absorb(other);
        stays
    }
}

impl Physics {
    /// Whether contact can keep a body in an island.
    fn joins(&self, id: u32) -> bool {
        id != GROUND
            && self.motions[id as usize].mobility() != Mobility::Fixed
            && self.duties[id as usize] & duty::RESPONDS != 0
    }

    /// `a` and `b` touch lastingly from `t` on; either may be fixed, or [`GROUND`]. Their contact is seen
    /// to with a step at `t`, or, if they join an island that is under way, from its next step on: until
    /// then both keep their segments.
    pub(crate) fn join(&mut self, a: u32, b: u32, t: SimTime) {
        let free = |id: u32| self.joins(id) && self.motions[id as usize].inverse_mass > 0.0;
        if !free(a) && !free(b) {
            return;
        }
        let mut common = None;
        for id in [a, b] {
            if !self.joins(id) {
                continue;
            }
            let slot = self.islands.slot_of(id);
            common = match common {
                Some(other) if other != slot => {
                    Some(self.islands.merge(other, slot, &self.origins))
                }
                _ => Some(slot),
            };
        }
        if let Some(slot) = common {
            let next = self.islands.slots[slot as usize].next;
            self.islands.wake(slot, next.unwrap_or(t));
        }
    }

    /// A member's segment may have been changed by somebody else at `t`: wakes its island, if that
    /// matters, and cuts its step short, if it has to be.
    pub(crate) fn member_changed(&mut self, id: u32, t: SimTime) {
        let Some(slot) = self.islands.slot(id) else {
            return;
        };
        let motion = &self.motions[id as usize];
        let island = &mut self.islands.slots[slot as usize];
        let Some(place) = island.position(id) else {
            return;
        };
        let member = &mut island.members[place];
        let Some(led) = &mut member.led else {
            return;
        };
        if led.motion.stamp == motion.stamp {
            return;
        }
        if island.next.is_none() {
            if !in_place(&led.motion, motion) {
                self.islands.wake(slot, t);
            } else if alike(&led.motion, motion) {
                led.motion.stamp = motion.stamp;
            } else if island.bearings.is_empty() {
                self.islands.wake(slot, t);
            } else {
                led.motion = *motion;
                self.islands.ask(slot);
            }
        } else if astray(led, motion, t) > ASTRAY * motion.radius_m() {
            island.cut = true;
            self.islands.wake(slot, t);
        }
    }

    /// Wakes islands at rest on which more acts at `t` than they bear.
    pub(crate) fn wake_overloaded(&mut self, t: SimTime) {
        while let Some(slot) = self.islands.asked.pop() {
            let mut island = self.islands.lend(slot);
            island.asked = false;
            let sleeps = island.next.is_none() && !island.members.is_empty();
            let bears = !sleeps || island.bears(&self.motions, |id| self.upright(id));
            self.islands.slots[slot as usize] = island;
            if !bears {
                self.islands.wake(slot, t);
            }
        }
    }

    /// One step of the island known by `key`, at `t`, when it is due. Appends what has been touched, and
    /// who follows a new segment, or is in no island any more.
    pub(crate) fn step_island(
        &mut self,
        key: u32,
        t: SimTime,
        contacts: &mut Vec<Contact>,
        changed: &mut Vec<u32>,
    ) {
        if !self.islands.due(key, t) {
            return;
        }
        let Some(slot) = self.islands.slot(key) else {
            return;
        };
        let mut island = self.islands.lend(slot);
        let first = changed.len();
        for id in self.let_go(&mut island, t) {
            self.islands.evict(id);
            changed.push(id);
        }
        for sleepers in self.settled(&mut island, t) {
            changed.extend(sleepers.members.iter().map(|member| member.id));
            self.islands.settle(sleepers);
        }
        if !island.members.is_empty() {
            self.advance_island(&mut island, t, contacts, changed);
        }
        changed[first..].sort_unstable();
        self.islands.give_back(slot, island);
    }
}

/// Whether two segments of a body at rest have it in one place.
fn in_place(a: &Motion, b: &Motion) -> bool {
    (a.p, a.q, a.v, a.w) == (b.p, b.q, b.v, b.w)
}

/// Whether the same acts on a body in two segments.
fn alike(a: &Motion, b: &Motion) -> bool {
    (a.a, a.torque) == (b.a, b.torque)
}

/// Whether a later segment goes on as the one before, up to rounding: the body is where it would be.
fn follows(before: &Motion, later: &Motion) -> bool {
    const ROUNDING: f64 = 1e-9;
    let t = later.start();
    before.position(t).distance(later.p) < ROUNDING
        && before.velocity(t).distance(later.v) < ROUNDING
        && before.rate(t).distance(later.w) < ROUNDING
        && rotation::turn_between(before.attitude(t), later.q).length() < ROUNDING
}

/// How far a changed segment leads from the one written until that ends, m.
fn astray(led: &Led, motion: &Motion, t: SimTime) -> f64 {
    let end = led.span[1];
    let rest_s = seconds_between(t, end).max(0.0);
    let turn = (motion.rate(t) - led.motion.rate(t)).length() * rest_s;
    motion.position(end).distance(led.motion.position(end)) + turn * motion.radius_m()
}

#[cfg(test)]
mod tests;
