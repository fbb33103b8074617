//! Cutting rectangular holes out of a rectangle, so that rectangles are left.
//!
//! The rectangle is parted into strips at the sides of all holes. A strip that no hole reaches stays
//! whole; of the others what the holes leave free stays. No two pieces overlap, together they are the
//! rectangle without its holes, and none is thinner than [`THINNEST_M`].

/// Thinner pieces than this are left out, in metres: physics wants half extents of 1 nm.
pub(crate) const THINNEST_M: f64 = 2e-9;

/// A rectangle: from `low` to `high` along two axes, in metres. Strips run along the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rectangle {
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

impl Rectangle {
    /// A rectangle from its corner with the least coordinates, and its size.
    pub(crate) fn new(low: [f64; 2], size: [f64; 2]) -> Self {
        Self {
            low,
            high: [low[0] + size[0], low[1] + size[1]],
        }
    }

    /// Whether it overlaps another one by more than a hair, for sums of decimal fractions.
    pub(crate) fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|i| self.low[i].max(other.low[i]) + THINNEST_M < self.high[i].min(other.high[i]))
    }

    fn is_thick(&self) -> bool {
        (0..2).all(|i| self.high[i] - self.low[i] > THINNEST_M)
    }

    /// The same within `whole`.
    fn within(&self, whole: &Self) -> Self {
        let clamp = |x: [f64; 2]| [0, 1].map(|i| x[i].clamp(whole.low[i], whole.high[i]));
        Self {
            low: clamp(self.low),
            high: clamp(self.high),
        }
    }
}

/// What holes leave of the rectangle from the origin to `size`: first the strips that are whole, then
/// the rest, each in the order of their coordinates.
pub(crate) fn cut(size: [f64; 2], holes: &[Rectangle]) -> Vec<Rectangle> {
    let whole = Rectangle::new([0.0; 2], size);
    let mut holes: Vec<Rectangle> = holes.iter().map(|hole| hole.within(&whole)).collect();
    holes.retain(Rectangle::is_thick);
    holes.sort_by(|a, b| a.low[1].total_cmp(&b.low[1]));
    let mut sides: Vec<f64> = vec![whole.low[0], whole.high[0]];
    sides.extend(holes.iter().flat_map(|hole| [hole.low[0], hole.high[0]]));
    sides.sort_by(f64::total_cmp);
    let (mut strips, mut rest) = (Vec::new(), Vec::new());
    let mut from = whole.low[0];
    for &to in &sides {
        if to - from <= THINNEST_M {
            continue;
        }
        let middle = 0.5 * (from + to);
        let reached = |hole: &&Rectangle| hole.low[0] < middle && middle < hole.high[0];
        let mut across = holes.iter().filter(reached).peekable();
        let pieces = match across.peek() {
            None => &mut strips,
            Some(_) => &mut rest,
        };
        let mut at = whole.low[1];
        let piece = |low: f64, high: f64| Rectangle {
            low: [from, low],
            high: [to, high],
        };
        for hole in across {
            pieces.push(piece(at, hole.low[1]));
            at = at.max(hole.high[1]);
        }
        pieces.push(piece(at, whole.high[1]));
        from = to;
    }
    strips.extend(rest);
    strips.retain(Rectangle::is_thick);
    strips
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(pieces: &[Rectangle]) -> f64 {
        let one = |r: &Rectangle| (r.high[0] - r.low[0]) * (r.high[1] - r.low[1]);
        pieces.iter().map(one).sum()
    }

    #[test]
    fn one_hole_in_the_middle_leaves_two_strips_and_two_pieces() {
        let pieces = cut([6.0, 4.0], &[Rectangle::new([1.0, 2.0], [3.0, 0.5])]);
        assert_eq!(
            pieces,
            [
                Rectangle::new([0.0, 0.0], [1.0, 4.0]),
                Rectangle::new([4.0, 0.0], [2.0, 4.0]),
                Rectangle::new([1.0, 0.0], [3.0, 2.0]),
                Rectangle::new([1.0, 2.5], [3.0, 1.5]),
            ]
        );
    }

    #[test]
    fn a_hole_past_the_edge_is_cut_off_there_and_one_outside_does_nothing() {
        let corner = Rectangle::new([-1.0, -1.0], [2.0, 2.0]);
        assert!((area(&cut([2.0, 2.0], &[corner])) - 3.0).abs() < 1e-12);
        let outside = Rectangle::new([5.0, 5.0], [2.0, 2.0]);
        assert_eq!(cut([2.0, 2.0], &[outside]).len(), 1);
        let all = Rectangle::new([-1.0, -1.0], [9.0, 9.0]);
        assert!(cut([2.0, 2.0], &[all]).is_empty());
    }

    #[test]
    fn holes_that_overlap_are_cut_once() {
        let holes = [
            Rectangle::new([1.0, 1.0], [2.0, 2.0]),
            Rectangle::new([2.0, 1.5], [2.0, 1.0]),
        ];
        assert!(holes[0].overlaps(&holes[1]));
        assert!((area(&cut([10.0, 5.0], &holes)) - (50.0 - 5.0)).abs() < 1e-12);
    }
}
