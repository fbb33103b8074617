//! Who leaves an island, and who comes to rest in it: asked after each step.

use crate::island::Sweep;
use crate::islands::{Island, Led, Member};
use crate::physics::Physics;
use crate::rest;
use crate::stepping::{driven, stands};
use glam::DVec3;
use simbeeotic_kernel::SimTime;
use std::collections::BTreeMap;

/// A member that has touched nothing for so many steps leaves.
const ALONE_STEPS: u32 = 4;
/// Who could not be shown to rest under what acts on it is not looked at again for so long.
const DOUBT_NS: u64 = 500_000_000;

impl Physics {
    /// Lets members go that touch nothing any more; tells whom. An island that nothing free is left in
    /// lets all go.
    pub(crate) fn let_go(&mut self, island: &mut Island, t: SimTime) -> Vec<u32> {
        let motions = &mut self.motions;
        let deserted = island
            .members
            .iter()
            .all(|member| driven(&motions[member.id as usize]) || member.alone >= ALONE_STEPS);
        let mut gone = Vec::new();
        let world = &mut island.world;
        island.members.retain(|member| {
            if !deserted && member.alone < ALONE_STEPS {
                return true;
            }
            let motion = &mut motions[member.id as usize];
            if !driven(motion) {
                let sweep = member.sweep(motion, t);
                let from = motion.position(t);
                motion.release(t, sweep.v, sweep.w);
                self.odometer.changed(from, motion, t);
                motion.stamp = motion.stamp.wrapping_add(1);
            }
            if let (Some(world), Some(body)) = (world.as_mut(), member.body) {
                world.remove(body);
            }
            gone.push(member.id);
            false
        });
        if !gone.is_empty() {
            let stays = |id: u32| gone.binary_search(&id).is_err();
            island.touches.retain(|(a, b)| stays(*a) && stays(*b));
        }
        gone
    }

    /// Takes groups out of an island that touch one another and all rest: islands of their own, asleep.
    pub(crate) fn settled(&mut self, island: &mut Island, t: SimTime) -> Vec<Island> {
        if !std::mem::take(&mut island.settling) || island.cut {
            return Vec::new();
        }
        let mut groups = Groups::new(island.members.len());
        for &(a, b) in &island.touches {
            if let (Some(a), Some(b)) = (island.position(a), island.position(b)) {
                groups.unite(a, b);
            }
        }
        let stays = |member: &Member| {
            let motion = &self.motions[member.id as usize];
            member.stays()
                && if driven(motion) {
                    stands(motion)
                } else {
                    !member.moved(motion)
                }
        };
        // Who has been still while the same acted on it rests, who has not gone anywhere if that is borne.
        let even = |member: &Member| {
            let motion = &self.motions[member.id as usize];
            member.resting && (driven(motion) || !member.pushed(motion))
        };
        let mut rests = vec![true; island.members.len()];
        let mut evens = vec![true; island.members.len()];
        for (place, member) in island.members.iter().enumerate() {
            let root = groups.root(place);
            rests[root] &= stays(member);
            evens[root] &= even(member);
        }
        let mut resters = BTreeMap::<usize, Vec<usize>>::new();
        for place in 0..island.members.len() {
            let root = groups.root(place);
            if rests[root] && (evens[root] || t >= island.doubtful_until) {
                resters.entry(root).or_default().push(place);
            }
        }
        if resters.is_empty() {
            return Vec::new();
        }
        let points = island
            .world
            .as_ref()
            .map_or_else(Vec::new, |world| world.loaded_points());
        let mut sleepers = BTreeMap::<usize, Island>::new();
        for (root, places) in resters {
            let bearings = rest::bearings(island, &points, &places);
            let mut sleeper = Island::of(places.iter().map(|place| island.members[*place].clone()));
            sleeper.bearings = bearings;
            if evens[root] || sleeper.bears(&self.motions, |id| self.upright(id)) {
                sleeper.members.clear();
                sleepers.insert(root, sleeper);
            } else {
                island.doubtful_until = t.saturating_add_nanos(DOUBT_NS);
            }
        }
        let members = std::mem::take(&mut island.members);
        for (place, mut member) in members.into_iter().enumerate() {
            let Some(sleeper) = sleepers.get_mut(&groups.root(place)) else {
                island.members.push(member);
                continue;
            };
            if let (Some(world), Some(body)) = (&mut island.world, member.body) {
                world.remove(body);
            }
            let motion = &mut self.motions[member.id as usize];
            if !member.resting && !driven(motion) {
                let from = motion.position(t);
                motion.lead(t, DVec3::ZERO, DVec3::ZERO);
                motion.stamp = motion.stamp.wrapping_add(1);
                self.odometer.changed(from, motion, t);
            }
            member.detach();
            member.led = Some(Led {
                motion: *motion,
                span: [t; 2],
                sweeps: [Sweep::default(); 2],
            });
            sleeper.members.push(member);
        }
        if !sleepers.is_empty() {
            let island = &mut *island;
            let awake = |id: u32| island.members.binary_search_by_key(&id, |m| m.id).is_ok();
            island.touches.retain(|(a, b)| awake(*a) || awake(*b));
        }
        sleepers.into_values().collect()
    }
}

/// Members that hang together: a forest of places.
struct Groups {
    parents: Vec<usize>,
}

impl Groups {
    fn new(count: usize) -> Self {
        Self {
            parents: (0..count).collect(),
        }
    }

    fn root(&mut self, mut place: usize) -> usize {
        while self.parents[place] != place {
            self.parents[place] = self.parents[self.parents[place]];
            place = self.parents[place];
        }
        place
    }

    /// The lower root stays.
    fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b)] = a.min(b);
    }
}
