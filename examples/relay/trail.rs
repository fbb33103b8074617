//! The explorer's trail: crumbs at even distances.

use simbeeotic::units::glam::DVec2;

/// Way between two crumbs, m.
pub(super) const STEP_M: f64 = 5.0;
/// A trail has no more crumbs than a byte can number.
const CRUMBS_MAX: usize = 255;
/// So it is no longer than this, m.
pub(super) const LONGEST_M: f64 = (CRUMBS_MAX - 1) as f64 * STEP_M;

/// A way, as far as it is known, from the base on.
#[derive(Clone, Debug, Default)]
pub(super) struct Trail {
    crumbs: Vec<DVec2>,
}

impl Trail {
    /// A way over these places, in straight lines.
    pub(super) fn over(places: &[DVec2]) -> Self {
        let mut crumbs: Vec<DVec2> = places.first().copied().into_iter().collect();
        let mut walked_m = 0.0;
        for leg in places.windows(2) {
            let (from, way) = (leg[0], leg[1] - leg[0]);
            let length_m = way.length();
            let along = way.normalize_or_zero();
            let next_m = |crumbs: &Vec<DVec2>| crumbs.len() as f64 * STEP_M - walked_m;
            while next_m(&crumbs) <= length_m && crumbs.len() < CRUMBS_MAX {
                crumbs.push(from + along * next_m(&crumbs));
            }
            walked_m += length_m;
        }
        Self { crumbs }
    }

    /// How many crumbs there are.
    pub(super) fn known(&self) -> u8 {
        u8::try_from(self.crumbs.len()).unwrap_or(u8::MAX)
    }

    /// How far it goes, m.
    pub(super) fn end_m(&self) -> f64 {
        self.crumbs.len().saturating_sub(1) as f64 * STEP_M
    }

    /// Some crumbs, from the one with the number `first` on.
    pub(super) fn some(&self, first: u8, most: usize) -> &[DVec2] {
        let rest = self.crumbs.get(usize::from(first)..).unwrap_or(&[]);
        &rest[..rest.len().min(most)]
    }

    /// Adds what is new of some crumbs, if it follows what is known.
    pub(super) fn extend(&mut self, first: u8, crumbs: &[DVec2]) {
        let have = self.crumbs.len();
        if let Some(skip) = have.checked_sub(usize::from(first)) {
            let new = crumbs.iter().skip(skip).take(CRUMBS_MAX - have);
            self.crumbs.extend(new);
        }
    }

    /// The place that is `s_m` along it; its end for more. `None` for no trail.
    pub(super) fn at(&self, s_m: f64) -> Option<DVec2> {
        let last = self.crumbs.len().checked_sub(1)?;
        let steps = (s_m / STEP_M).clamp(0.0, last as f64);
        let before = (steps.floor() as usize).min(last);
        let after = (before + 1).min(last);
        let part = steps - before as f64;
        Some(self.crumbs[before].lerp(self.crumbs[after], part))
    }

    /// How far along it the crumb is that is nearest to a place, m. `None` for no trail.
    pub(super) fn nearest_m(&self, place: DVec2) -> Option<f64> {
        let squares = self.crumbs.iter().map(|c| c.distance_squared(place));
        let nearest = squares.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(nearest.0 as f64 * STEP_M)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corner() -> Trail {
        Trail::over(&[DVec2::ZERO, DVec2::X * 12.0, DVec2::new(12.0, 10.0)])
    }

    #[test]
    fn crumbs_lie_at_even_distances_around_corners() {
        let trail = corner();
        assert_eq!(trail.end_m(), 20.0);
        let places = [0.0, 10.0, 15.0, 20.0].map(|s| trail.at(s).expect("a trail"));
        let at = DVec2::new;
        assert_eq!(
            places,
            [at(0.0, 0.0), at(10.0, 0.0), at(12.0, 3.0), at(12.0, 8.0)]
        );
        assert_eq!(trail.nearest_m(DVec2::new(13.0, 4.0)), Some(15.0));
    }

    #[test]
    fn what_is_told_of_it_grows_it_without_gaps() {
        let (whole, mut mine) = (corner(), Trail::default());
        mine.extend(2, whole.some(2, 2));
        assert_eq!(mine.known(), 0, "the beginning is missing");
        mine.extend(0, whole.some(0, 3));
        mine.extend(1, whole.some(1, 9));
        mine.extend(1, whole.some(1, 9));
        assert_eq!(mine.crumbs, whole.crumbs);
    }
}
