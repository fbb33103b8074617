//! Points at random that keep a distance from each other.
//!
//! A point is drawn evenly over the area; if another is too near, it is drawn again. Source: random
//! sequential adsorption; discs so placed jam when they cover 54.7 % of the area (Feder 1980, J.
//! Theor. Biol. 87).

use super::draft::Rect;
use glam::DVec2;
use simbeeotic_kernel::rng::Stream;

/// Discs of the distance as diameter may cover this share of the area: far enough from jamming that
/// a place for each is found quickly.
pub(super) const COVER_MAX: f64 = 0.42;
/// Draws for one point, at most.
const DRAWS_MAX: u32 = 100_000;

/// `count` points of a rectangle, `apart` from each other, where `allowed` says so. Fewer if there is
/// no place for more.
pub(super) fn scatter(
    rect: Rect,
    count: usize,
    apart: f64,
    chance: &mut Stream,
    allowed: impl Fn(DVec2) -> bool,
) -> Vec<DVec2> {
    let size = rect.size();
    // Points by cells of the distance: whoever is too near stands in a cell beside.
    let side = apart.max((size.x * size.y / count.max(1) as f64).sqrt() * 0.25);
    let cells = (size / side).floor().max(DVec2::ZERO) + 1.0;
    let (columns, rows) = (cells.x as usize, cells.y as usize);
    let mut grid: Vec<Vec<DVec2>> = vec![Vec::new(); columns * rows];
    let mut all = Vec::with_capacity(count);
    let mut draws = 0;
    while all.len() < count && draws < DRAWS_MAX {
        draws += 1;
        let share = DVec2::new(chance.uniform(), chance.uniform());
        let point = rect.low + size * share;
        if !allowed(point) {
            continue;
        }
        let cell = ((point - rect.low) / side).floor();
        let (column, row) = (cell.x as usize, cell.y as usize);
        let beside = (row.saturating_sub(1)..rows.min(row + 2)).flat_map(|r| {
            (column.saturating_sub(1)..columns.min(column + 2)).map(move |c| r * columns + c)
        });
        let near = |other: &DVec2| other.distance_squared(point) < apart * apart;
        if beside.into_iter().any(|at| grid[at].iter().any(near)) {
            continue;
        }
        grid[row * columns + column].push(point);
        all.push(point);
        draws = 0;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_keep_their_distance_and_fill_the_area_evenly() {
        let rect = Rect::new([-50.0, 50.0], [0.0, 40.0]);
        let mut chance = Stream::new(3, "scatter", "test");
        let apart = 2.0;
        let most = (COVER_MAX * 4_000.0 / (0.25 * std::f64::consts::PI * apart * apart)) as usize;
        let points = scatter(rect, most, apart, &mut chance, |_| true);
        assert_eq!(points.len(), most);
        for (i, a) in points.iter().enumerate() {
            assert!(a.cmpge(rect.low).all() && a.cmplt(rect.high).all());
            assert!(points[..i].iter().all(|b| a.distance(*b) >= apart));
        }
        let east = points.iter().filter(|p| p.x > 0.0).count() as f64;
        assert!((east / most as f64 - 0.5).abs() < 0.06, "{east} of {most}");
    }

    #[test]
    fn where_there_is_no_place_there_are_fewer() {
        let rect = Rect::new([0.0, 1.0], [0.0, 1.0]);
        let mut chance = Stream::new(3, "scatter", "test");
        assert!(scatter(rect, 5, 0.1, &mut chance, |_| false).is_empty());
        assert!(scatter(rect, 1_000, 0.5, &mut chance, |_| true).len() < 10);
    }
}
