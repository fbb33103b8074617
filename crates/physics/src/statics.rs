//! Bodies that stay where they are: one tree over all of them, built when the last was added.

use crate::limits;
use crate::tree::{Beam, Bounds, Tree, Way};

/// What reaches farther than any bounded body can has no bounds, m.
const ENDLESS_M: f64 = 2.0 * (limits::POSITION_M_MAX + limits::EXTENT_M_MAX);

/// All fixed bodies.
#[derive(Debug, Default)]
pub(crate) struct Statics {
    tree: Tree,
    /// Those without bounds: planes.
    endless: Vec<u32>,
}

impl Statics {
    /// The fixed bodies, by id, each with its bounds.
    pub(crate) fn new(bodies: impl Iterator<Item = (u32, Bounds)>) -> Self {
        let mut endless = Vec::new();
        let tree = Tree::new(bodies.filter(|(id, [low, high])| {
            let bounded = low.abs().max(high.abs()).max_element() < ENDLESS_M;
            if !bounded {
                endless.push(*id);
            }
            bounded
        }));
        Self { tree, endless }
    }

    /// Appends the fixed bodies whose bounds overlap `bounds`, by id, each once; some that miss by a
    /// micrometre are among them.
    pub(crate) fn near(&self, bounds: Bounds, found: &mut Vec<u32>) {
        let first = found.len();
        self.overlapping(bounds, |id| found.push(id));
        found[first..].sort_unstable();
    }

    /// Calls `visit` for each fixed body whose bounds `way` meets within `range`, as [`Tree::along`].
    #[inline]
    pub(crate) fn along(
        &self,
        way: &Way,
        mut range: f64,
        mut visit: impl FnMut(u32, f64) -> f64,
    ) -> f64 {
        for &id in &self.endless {
            range = visit(id, range);
        }
        self.tree.along(way, range, visit)
    }

    /// Calls `visit` for each fixed body whose bounds a ray of the beam may meet, as [`Tree::across`].
    pub(crate) fn across(&self, beam: &Beam, range: f64, mut visit: impl FnMut(u32, f64)) {
        self.endless.iter().for_each(|id| visit(*id, 0.0));
        self.tree.across(beam, range, visit);
    }

    /// Calls `visit` for each fixed body whose bounds overlap `bounds`.
    pub(crate) fn overlapping(&self, bounds: Bounds, mut visit: impl FnMut(u32)) {
        self.endless.iter().copied().for_each(&mut visit);
        self.tree.overlapping(bounds, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn bodies_near_come_by_id_and_planes_are_near_everywhere() {
        let cube = |x: f64| [DVec3::new(x, 0.0, 0.0), DVec3::new(x + 1.0, 1.0, 1.0)];
        let half_space = [
            DVec3::NEG_INFINITY,
            DVec3::new(f64::INFINITY, f64::INFINITY, 0.0),
        ];
        let bodies = [
            (7, cube(4.0)),
            (3, half_space),
            (2, cube(0.0)),
            (5, cube(2.5)),
        ];
        let statics = Statics::new(bodies.into_iter());
        let mut found = vec![9];
        statics.near([DVec3::splat(0.5), DVec3::new(3.0, 0.6, 0.6)], &mut found);
        assert_eq!(found, [9, 2, 3, 5]);
    }
}
