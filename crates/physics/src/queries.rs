//! Who is near, and what a ray meets.

use crate::body::BodyId;
use crate::physics::Physics;
use glam::DVec3;
use simbeeotic_kernel::SimTime;

impl Physics {
    /// Appends every body whose centre of mass lies within `radius_m` of `p_enu` at `t`, by id.
    ///
    /// Quick for bodies that can touch others, and for all if `list_all` is set; the rest are looked at
    /// one by one. `t` is the present; asking for another time is right, too, but slow.
    pub fn near(&self, p_enu: DVec3, radius_m: f64, t: SimTime, found: &mut Vec<BodyId>) {
        let mut candidates = Vec::new();
        // Until then, every body is where the lists assume.
        let until = self.clock.max(self.quiet_until).min(self.horizon);
        let listed = self.dirty.is_empty() && !self.grown;
        if listed && self.lists.built() <= t && t <= until {
            self.lists.around(p_enu, radius_m, &mut candidates);
            candidates.extend_from_slice(&self.unlisted);
            self.statics
                .near([p_enu - radius_m, p_enu + radius_m], &mut candidates);
        } else {
            candidates.extend(0..self.motions.len() as u32);
        }
        let within = |id: &u32| self.motions[*id as usize].position(t).distance(p_enu) <= radius_m;
        candidates.retain(within);
        candidates.sort_unstable();
        candidates.dedup();
        found.extend(candidates.into_iter().map(BodyId));
    }
}
