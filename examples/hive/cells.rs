//! The squares that a hive divides its field into.

use simbeeotic::units::glam::DVec2;

/// A square field, cut into square cells. Cell 0 is in the south-west; they are counted along east first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cells {
    south_west: DVec2,
    /// Cells along one edge.
    side: u32,
    size_m: f64,
}

/// More cells have no number: a field has at most 255 by 255.
const SIDE_MAX: f64 = 255.0;

impl Cells {
    /// Those that fill a square of `field_m` around `middle`; at least one.
    pub(crate) fn around(middle: DVec2, field_m: f64, size_m: f64) -> Self {
        let side = (field_m / size_m).round().clamp(1.0, SIDE_MAX);
        Self {
            south_west: middle - DVec2::splat(0.5 * side * size_m),
            side: side as u32,
            size_m,
        }
    }

    /// The same field in cells that are `parts` times as small. They have no numbers of two bytes, only
    /// an index.
    pub(crate) fn finer(&self, parts: u32) -> Self {
        Self {
            side: self.side * parts,
            size_m: self.size_m / f64::from(parts),
            ..*self
        }
    }

    pub(crate) fn len(&self) -> u16 {
        (self.side * self.side) as u16
    }

    pub(crate) fn count(&self) -> usize {
        (self.side * self.side) as usize
    }

    /// The length of a cell's edge.
    pub(crate) fn size_m(&self) -> f64 {
        self.size_m
    }

    /// The cell that a place is in; `None` outside of the field.
    pub(crate) fn at(&self, place: DVec2) -> Option<u16> {
        self.index_at(place).map(|index| index as u16)
    }

    /// The same as an index.
    pub(crate) fn index_at(&self, place: DVec2) -> Option<usize> {
        let steps = ((place - self.south_west) / self.size_m).floor();
        let inside = |step: f64| step >= 0.0 && step < f64::from(self.side);
        let index = || steps.y as usize * self.side as usize + steps.x as usize;
        (inside(steps.x) && inside(steps.y)).then(index)
    }

    pub(crate) fn middle(&self, cell: u16) -> DVec2 {
        self.middle_of(usize::from(cell))
    }

    /// The same, by index.
    pub(crate) fn middle_of(&self, index: usize) -> DVec2 {
        let (side, index) = (self.side, index as u32);
        let step = DVec2::new(f64::from(index % side), f64::from(index / side));
        self.south_west + (step + 0.5) * self.size_m
    }

    /// Whether a place lies in a cell, or no more than `margin_m` beside it.
    pub(crate) fn holds(&self, cell: u16, place: DVec2, margin_m: f64) -> bool {
        let off = (place - self.middle(cell)).abs();
        off.max_element() <= 0.5 * self.size_m + margin_m
    }

    /// The up to eight cells around one.
    pub(crate) fn neighbors(&self, cell: u16) -> impl Iterator<Item = u16> {
        let (side, cell) = (self.side as i32, i32::from(cell));
        let (x, y) = (cell % side, cell / side);
        let steps = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
        steps.filter_map(move |(dx, dy)| {
            let inside = |at: i32| (0..side).contains(&at);
            let beside = (dx, dy) != (0, 0) && inside(x + dx) && inside(y + dy);
            beside.then(|| ((y + dy) * side + x + dx) as u16)
        })
    }

    /// The way through a cell in lanes along north, at most `lane_m` apart, from the corner next to
    /// `from`: whoever flies it has been within half of that of each of its points.
    pub(crate) fn lanes(&self, cell: u16, lane_m: f64, from: DVec2) -> Vec<DVec2> {
        let count = (self.size_m / lane_m).ceil().max(1.0);
        let step = self.size_m / count;
        let middle = self.middle(cell);
        let side = |toward: f64| if toward < 0.0 { -1.0 } else { 1.0 };
        let (east, north) = (side(from.x - middle.x), side(from.y - middle.y));
        let reach = 0.5 * (self.size_m - step);
        let mut way = Vec::new();
        for lane in 0..count as u32 {
            let x = middle.x + east * (reach - f64::from(lane) * step);
            let turn = if lane % 2 == 0 { north } else { -north };
            way.push(DVec2::new(x, middle.y + turn * reach));
            way.push(DVec2::new(x, middle.y - turn * reach));
        }
        way
    }

    /// The cells in the order of their direction from the field's middle, for shares that are wedges.
    pub(crate) fn by_direction(&self) -> Vec<u16> {
        let middle = self.south_west + DVec2::splat(0.5 * f64::from(self.side) * self.size_m);
        let mut all: Vec<u16> = (0..self.len()).collect();
        let turn = |cell: &u16| {
            let way = self.middle(*cell) - middle;
            simbeeotic::units::math::atan2(way.y, way.x)
        };
        all.sort_by(|a, b| turn(a).total_cmp(&turn(b)).then(a.cmp(b)));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIELD: DVec2 = DVec2::new(100.0, -50.0);

    #[test]
    fn each_cell_holds_its_middle_and_no_other() {
        let cells = Cells::around(FIELD, 40.0, 10.0);
        assert_eq!(cells.len(), 16);
        for cell in 0..cells.len() {
            assert_eq!(cells.at(cells.middle(cell)), Some(cell));
        }
        assert_eq!(cells.middle(0), FIELD - 15.0);
        assert_eq!(cells.at(FIELD + DVec2::new(20.1, 0.0)), None);
        assert_eq!(cells.at(FIELD - DVec2::new(0.0, 20.1)), None);
    }

    #[test]
    fn corners_have_three_neighbors_and_the_middle_has_eight() {
        let cells = Cells::around(FIELD, 40.0, 10.0);
        assert_eq!(cells.neighbors(0).collect::<Vec<_>>(), [1, 4, 5]);
        assert_eq!(cells.neighbors(5).count(), 8);
        assert_eq!(cells.neighbors(15).count(), 3);
    }

    #[test]
    fn lanes_begin_near_and_pass_every_point_of_the_cell() {
        let cells = Cells::around(DVec2::ZERO, 10.0, 10.0);
        for from in [DVec2::new(-9.0, 9.0), DVec2::new(3.0, -20.0)] {
            let way = cells.lanes(0, 5.0, from);
            assert_eq!(way[0], from.signum() * 2.5);
            for at in
                (0..400).map(|n| DVec2::new(f64::from(n % 20), f64::from(n / 20)) * 0.5 - 4.75)
            {
                let near = way.windows(2).any(|leg| {
                    let (along, off) = (leg[1] - leg[0], at - leg[0]);
                    let share = (off.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                    (off - along * share).abs().max_element() <= 2.5
                });
                assert!(near, "{at} is not passed on {way:?}");
            }
        }
    }

    #[test]
    fn cells_by_direction_are_all_cells_in_a_turn() {
        let cells = Cells::around(FIELD, 40.0, 10.0);
        let mut all = cells.by_direction();
        assert_eq!(
            all[..2]
                .iter()
                .filter(|c| cells.middle(**c).x < FIELD.x)
                .count(),
            2
        );
        all.sort_unstable();
        assert_eq!(all, (0..16).collect::<Vec<_>>());
    }
}
