//! Where the smell was lost, and when that says where the leak is.

use simbeeotic::units::glam::DVec2;

/// The last detection points of one vehicle: each place where it smelled something for the last time
/// before it lost the plume.
///
/// Downwind of the leak they are anywhere, as the plume breaks off anywhere. Flying on upwind past the
/// leak the plume ends for good, time and again at the same place: `needed` points within `radius` of
/// the one that is farthest upwind are the leak, and it is declared at their mean.
#[derive(Clone, Debug)]
pub(super) struct Trail {
    pub(super) needed: usize,
    pub(super) radius_m: f64,
    points: Vec<DVec2>,
}

impl Trail {
    pub(super) fn new(needed: usize, radius_m: f64) -> Self {
        Self {
            needed,
            radius_m,
            points: Vec::new(),
        }
    }

    /// Adds a point; the leak's place if the points now tell it. `upwind` is of unit length.
    pub(super) fn lost_at(&mut self, place: DVec2, upwind: DVec2) -> Option<DVec2> {
        self.points.push(place);
        let along = |p: &DVec2| p.dot(upwind);
        let points = self.points.iter().copied();
        let first = points.max_by(|a, b| along(a).total_cmp(&along(b)))?;
        let near = |p: &&DVec2| p.distance(first) <= self.radius_m;
        let zone: Vec<DVec2> = self.points.iter().filter(near).copied().collect();
        let mean = zone.iter().sum::<DVec2>() / zone.len() as f64;
        (zone.len() >= self.needed).then_some(mean)
    }
}

#[cfg(test)]
mod test {
    use super::*;

    #[test]
    fn points_along_the_plume_declare_nothing_and_points_at_its_head_do() {
        let mut trail = Trail::new(3, 2.0);
        for x in [40.0, 30.0, 20.0, 10.0, 0.5, 0.0] {
            assert_eq!(trail.lost_at(DVec2::new(x, 0.0), DVec2::NEG_X), None);
        }
        let place = trail.lost_at(DVec2::new(-0.5, 0.0), DVec2::NEG_X);
        assert_eq!(place, Some(DVec2::ZERO));
    }
}
