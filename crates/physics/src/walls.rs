//! What stands near each body that moves.
//!
//! Fixed bodies are in no neighbour list: there may be a hundred thousand of them, and they never move.
//! Instead each mover keeps the few that touch a ball about it, with room to spare, and asks the tree of
//! fixed bodies again only when it leaves that ball. A body in the open asks about once a second,
//! whatever stands elsewhere.

use crate::statics::Statics;
use glam::DVec3;

/// Room to spare about what a body needs until the next listing, m.
const ROOM_M: f64 = 1.0;

/// The fixed bodies near one mover.
#[derive(Clone, Debug, Default)]
pub(crate) struct Walls {
    centre: DVec3,
    /// Whatever touches the ball of this radius is in `near`; below zero before the first question.
    radius: f64,
    near: Box<[u32]>,
}

impl Walls {
    pub(crate) fn unknown() -> Self {
        Self {
            radius: -1.0,
            ..Self::default()
        }
    }

    /// Sees to it that all fixed bodies that touch the ball are known. `agree` says which of them matter.
    pub(crate) fn cover(
        &mut self,
        statics: &Statics,
        centre: DVec3,
        radius: f64,
        agree: impl Fn(u32) -> bool,
        room: &mut Vec<u32>,
    ) {
        if self.radius >= 0.0 && self.centre.distance(centre) + radius <= self.radius {
            return;
        }
        (self.centre, self.radius) = (centre, radius + ROOM_M);
        room.clear();
        statics.near([centre - self.radius, centre + self.radius], room);
        room.retain(|id| agree(*id));
        room.sort_unstable();
        if **room != *self.near {
            self.near = room.as_slice().into();
        }
    }

    /// The fixed bodies, by id.
    pub(crate) fn near(&self) -> &[u32] {
        &self.near
    }
}
