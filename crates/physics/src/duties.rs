//! Whom a body may touch, and what therefore has to be looked at when it changes.

use crate::body::{BodySpec, Contacts, Mobility, group};
use crate::physics::Physics;
use crate::queue::GROUND;
use crate::statics::Statics;
use crate::tree::Bounds;
use simbeeotic_kernel::SimTime;

/// What has to be looked at when a body changes: bits of one byte.
pub(crate) mod duty {
    /// It may meet the ground.
    pub(crate) const GROUND: u8 = 1;
    /// It may meet another body.
    pub(crate) const MEETS: u8 = 2;
    /// It has a place in the lists.
    pub(crate) const LISTED: u8 = 4;
    /// It bounces.
    pub(crate) const RESPONDS: u8 = 8;
    /// It has changed, and its contacts are not predicted yet.
    pub(crate) const DIRTY: u8 = 16;
    /// It may meet something fixed.
    pub(crate) const WALLS: u8 = 32;
    /// It never moves.
    pub(crate) const FIXED: u8 = 64;
    /// It rolls on what it lies on.
    pub(crate) const ROLLS: u8 = 128;
    /// What stays as it is when it is worked out anew who may meet whom.
    pub(crate) const OWN: u8 = RESPONDS | DIRTY | FIXED | ROLLS;
}

/// Whom a body may touch; all that two bodies ask of each other when they are listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Filter {
    group: u16,
    mask: u16,
    fixed: bool,
    none: bool,
}

impl Filter {
    pub(crate) fn new(spec: &BodySpec) -> Self {
        Self {
            group: spec.group,
            mask: spec.mask,
            fixed: spec.mobility == Mobility::Fixed,
            none: spec.contacts == Contacts::None,
        }
    }

    pub(crate) fn agrees(self, other: Self) -> bool {
        self.group & other.mask != 0
            && other.group & self.mask != 0
            && !(self.fixed && other.fixed)
            && !(self.none || other.none)
    }

    /// The groups it is in, and those it collides with.
    pub(crate) fn groups(self) -> [u16; 2] {
        [self.group, self.mask]
    }

    fn meets_ground(self) -> bool {
        self.mask & group::TERRAIN != 0 && !self.fixed && !self.none
    }
}

impl Physics {
    /// Works out which bodies can meet at all. Bodies of the same filter form a class.
    pub(crate) fn classify(&mut self) {
        let mut classes: Vec<(Filter, bool)> = Vec::new();
        for filter in &self.filters {
            match classes.iter_mut().find(|(class, _)| class == filter) {
                Some((_, several)) => *several = true,
                None => classes.push((*filter, false)),
            }
        }
        let meets = |filter: Filter, fixed: bool| {
            classes.iter().any(|(class, several)| {
                class.fixed == fixed && filter.agrees(*class) && (*class != filter || *several)
            })
        };
        let has_ground = self.ground.is_some();
        let bit = |holds: bool, bit: u8| if holds { bit } else { 0 };
        for list in [&mut self.unlisted, &mut self.movers, &mut self.listed] {
            list.clear();
        }
        self.has_walls = false;
        for (id, filter) in self.filters.iter().enumerate() {
            let duty = &mut self.duties[id];
            *duty &= duty::OWN;
            if filter.fixed {
                continue;
            }
            let (meets, walls) = (meets(*filter, false), meets(*filter, true));
            *duty |= bit(has_ground && filter.meets_ground(), duty::GROUND)
                | bit(meets, duty::MEETS)
                | bit(walls, duty::WALLS)
                | bit(meets || walls || self.list_all, duty::LISTED);
            self.has_walls |= walls;
            self.movers.push(id as u32);
            if *duty & duty::LISTED == 0 {
                self.unlisted.push(id as u32);
            } else {
                self.listed.push(id as u32);
            }
        }
        self.walls.clear();
        self.statics = Statics::new(self.fixed());
        self.grown = false;
    }

    /// The fixed bodies and their bounds.
    fn fixed(&self) -> impl Iterator<Item = (u32, Bounds)> {
        let bodies = self.motions.iter().zip(0..);
        bodies
            .filter(|(motion, _)| motion.mobility == Mobility::Fixed)
            .map(|(motion, id)| (id, self.form(id).bounds(motion.place(SimTime::ZERO))))
    }

    /// Whether anything about a body has to be foreseen.
    pub(crate) fn watches(&self, id: u32) -> bool {
        self.duties[id as usize] & (duty::GROUND | duty::LISTED) != 0
    }

    /// What happens if two bodies meet, or a body and the ground.
    pub(crate) fn contact_of(&self, a: u32, b: u32) -> Contacts {
        let inverse_mass = |id: u32| self.motions[id as usize].inverse_mass;
        let (both, movable) = if b == GROUND {
            (self.duties[a as usize], inverse_mass(a) > 0.0)
        } else {
            (
                self.duties[a as usize] & self.duties[b as usize],
                inverse_mass(a) + inverse_mass(b) > 0.0,
            )
        };
        if both & duty::RESPONDS != 0 && movable {
            Contacts::Respond
        } else {
            Contacts::Detect
        }
    }
}
