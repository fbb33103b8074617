//! Which bodies a query has to look at.
//!
//! A listed body stays in a ball until the next listing, and an event announces that it may leave it. So
//! one tree over the boxes of these balls serves every instant until then: what it finds is looked at
//! where it is at the instant asked for, and nothing is rebuilt as bodies move. The tree is made at the
//! first query after a listing; a body that is listed anew takes its new place in it. Bodies for which
//! no ball holds (not listed, or changed since) are looked at one by one, and fixed bodies have a tree of
//! their own. None of this shows in what a query finds.

use crate::physics::Physics;
use crate::tree::{Beam, Bounds, Tree, Way};
use simbeeotic_kernel::SimTime;
use std::sync::atomic::Ordering;

/// So many bodies are looked at one by one without a loss worth a word.
const FEW: usize = 32;

/// The bodies that may move, as of one instant.
pub(crate) struct Sight<'a> {
    physics: &'a Physics,
    /// Those whose balls hold; `None` if nothing is known about the instant.
    tree: Option<&'a Tree>,
}

impl Physics {
    /// Whether the lists hold at `t`, but for [`loose`](Self::loose) bodies.
    pub(crate) fn lists_hold(&self, t: SimTime) -> bool {
        // Until then, every body is where the lists assume.
        let until = self.clock.max(self.quiet_until).min(self.horizon);
        let since = if self.dirty.is_empty() {
            self.lists.since()
        } else {
            self.clock
        };
        !self.grown && since <= t && t <= until
    }

    /// The bodies that may be elsewhere than the lists assume, some several times.
    pub(crate) fn loose(&self) -> impl Iterator<Item = u32> {
        let bodies = self.unlisted.iter().chain(&self.dirty);
        bodies.chain(self.lists.strays()).copied()
    }

    /// Asks for a place in the lists for all bodies from the next listing on, if many have none.
    pub(crate) fn ask(&self) {
        if self.unlisted.len() > FEW {
            self.asked.store(true, Ordering::Relaxed);
        }
    }

    /// What there is to be seen at `t`.
    pub(crate) fn sight(&self, t: SimTime) -> Sight<'_> {
        self.ask();
        let tree = self.lists_hold(t).then(|| self.lists.sight());
        Sight {
            physics: self,
            tree,
        }
    }
}

impl Sight<'_> {
    /// Calls `visit` for each body that `way` may meet within `range`, some several times, as
    /// [`Tree::along`].
    #[inline]
    pub(crate) fn along(&self, way: &Way, mut range: f64, mut visit: impl FnMut(u32, f64) -> f64) {
        let physics = self.physics;
        if let Some(tree) = self.tree {
            range = physics.statics.along(way, range, &mut visit);
            for id in physics.loose() {
                range = visit(id, range);
            }
            tree.along(way, range, visit);
        } else {
            for id in 0..physics.motions.len() as u32 {
                range = visit(id, range);
            }
        }
    }

    /// Calls `visit` for each body that a ray of the beam may meet within `range`, some several times, and
    /// tells how far away it begins at least.
    pub(crate) fn across(&self, beam: &Beam, range: f64, mut visit: impl FnMut(u32, f64)) {
        let physics = self.physics;
        if let Some(tree) = self.tree {
            physics.statics.across(beam, range, &mut visit);
            physics.loose().for_each(|id| visit(id, 0.0));
            tree.across(beam, range, visit);
        } else {
            (0..physics.motions.len() as u32).for_each(|id| visit(id, 0.0));
        }
    }

    /// Calls `visit` for each body that may overlap `bounds`, some several times.
    pub(crate) fn overlapping(&self, bounds: Bounds, mut visit: impl FnMut(u32)) {
        let physics = self.physics;
        if let Some(tree) = self.tree {
            physics.statics.overlapping(bounds, &mut visit);
            physics.loose().for_each(&mut visit);
            tree.overlapping(bounds, visit);
        } else {
            (0..physics.motions.len() as u32).for_each(visit);
        }
    }
}
