//! The flowers that a MAV has seen in its cell: sightings with errors, put together.

use simbeeotic::units::glam::{DVec2, DVec3};

/// A flower, as far as it was seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Find {
    /// Where its head is.
    pub(crate) at: DVec3,
    looks: u32,
    pub(crate) served: bool,
}

/// A map of them.
#[derive(Debug, Default)]
pub(crate) struct Finds {
    all: Vec<Find>,
}

/// A sighting counts as at most this many earlier ones: later looks are from nearer.
const LOOKS_MAX: u32 = 5;

impl Finds {
    /// Those that the hive tells of: `height_m` is how high heads are, as a rule.
    pub(crate) fn told(places: &[DVec2], height_m: f64) -> Self {
        let find = |place: &DVec2| Find {
            at: place.extend(height_m),
            looks: 1,
            served: false,
        };
        Self {
            all: places.iter().map(find).collect(),
        }
    }

    /// Takes a sighting in: of a flower that is within `gate_m` of one that is known, or of a new one.
    pub(crate) fn sight(&mut self, at: DVec3, gate_m: f64) -> usize {
        if let Some(which) = self.nearest(at.truncate(), gate_m) {
            let find = &mut self.all[which];
            find.looks = (find.looks + 1).min(LOOKS_MAX);
            find.at += (at - find.at) / f64::from(find.looks);
            return which;
        }
        self.all.push(Find {
            at,
            looks: 1,
            served: false,
        });
        self.all.len() - 1
    }

    /// Which is the nearest within `reach_m`.
    pub(crate) fn nearest(&self, at: DVec2, reach_m: f64) -> Option<usize> {
        let far = |find: &Find| find.at.truncate().distance_squared(at);
        let all = self.all.iter().enumerate();
        let (which, find) = all.min_by(|a, b| far(a.1).total_cmp(&far(b.1)))?;
        (far(find) <= reach_m * reach_m).then_some(which)
    }

    pub(crate) fn get(&self, which: usize) -> Option<Find> {
        self.all.get(which).copied()
    }

    pub(crate) fn serve(&mut self, which: usize) {
        if let Some(find) = self.all.get_mut(which) {
            find.served = true;
        }
    }

    /// Those that are not served, in a short order from `from`: always on to the nearest.
    pub(crate) fn round(&self, from: DVec2) -> Vec<usize> {
        let open = |which: &usize| !self.all[*which].served;
        let mut left: Vec<usize> = (0..self.all.len()).filter(open).collect();
        let (mut at, mut round) = (from, Vec::with_capacity(left.len()));
        while !left.is_empty() {
            let far = |which: usize| self.all[which].at.truncate().distance_squared(at);
            let best = (0..left.len()).min_by(|a, b| far(left[*a]).total_cmp(&far(left[*b])));
            let next = left.swap_remove(best.unwrap_or(0));
            at = self.all[next].at.truncate();
            round.push(next);
        }
        round
    }

    /// Where those are that are not served.
    pub(crate) fn left(&self) -> Vec<DVec2> {
        let open = self.all.iter().filter(|find| !find.served);
        open.map(|find| find.at.truncate()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sightings_of_one_flower_are_one_and_their_mean_is_its_place() {
        let mut finds = Finds::default();
        for (x, y) in [(0.0, 0.1), (0.2, 0.0), (0.1, -0.1), (0.1, 0.0), (3.0, 0.0)] {
            finds.sight(DVec3::new(x, y, 0.5), 0.5);
        }
        let left = finds.left();
        assert_eq!(left.len(), 2);
        assert!((left[0] - DVec2::new(0.1, 0.0)).length() < 1e-9, "{left:?}");
    }

    #[test]
    fn a_round_visits_each_that_is_left_once_the_nearest_first() {
        let places = [4.0, 1.0, 9.0, 2.0].map(|x| DVec2::new(x, 0.0));
        let mut finds = Finds::told(&places, 0.5);
        finds.serve(3);
        assert_eq!(finds.round(DVec2::ZERO), [1, 0, 2]);
        assert_eq!(finds.left().len(), 3);
    }
}
