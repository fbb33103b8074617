//! An area in cells, and what flights saw of it.

use super::super::Failure;
use super::flights::Flights;
use super::quantity::Curve;

/// No more cells than these.
const CELLS_MAX: f64 = 4e6;
/// The share seen is noted at no more times than these.
const TIMES: usize = 400;

/// An area in cells, from its south-west corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grid {
    /// West and south, m.
    corner_m: [f64; 2],
    pub(super) cell_m: f64,
    pub(super) columns: usize,
    pub(super) rows: usize,
}

/// What became of the cells in one run, from the south-west, row by row.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    pub(super) visits: Vec<u32>,
    pub(super) dwell_s: Vec<f64>,
    /// NaN where nobody was.
    pub(super) last_s: Vec<f64>,
    /// The share of cells that were seen, over time.
    pub(super) share: Curve,
}

impl Grid {
    /// Cells of a side over an area (west, south, east, north, m).
    pub(super) fn over([west, south, east, north]: [f64; 4], cell_m: f64) -> Result<Self, Failure> {
        let (wide, tall) = (east - west, north - south);
        let (columns, rows) = ((wide / cell_m - 1e-9).ceil(), (tall / cell_m - 1e-9).ceil());
        if columns.max(1.0) * rows.max(1.0) > CELLS_MAX {
            return Err(Failure::input(format!(
                "--cell {cell_m} m: {columns} x {rows} cells are too many for an area of {wide:.1} x \
                 {tall:.1} m; take larger ones, or a smaller --area"
            )));
        }
        Ok(Self {
            corner_m: [west, south],
            cell_m,
            columns: (columns as usize).max(1),
            rows: (rows as usize).max(1),
        })
    }

    pub(super) fn area_m2(&self) -> f64 {
        (self.columns * self.rows) as f64 * self.cell_m * self.cell_m
    }

    pub(super) fn edges_m(&self) -> [f64; 4] {
        let [west, south] = self.corner_m;
        let along = |count: usize| count as f64 * self.cell_m;
        [
            west,
            south,
            west + along(self.columns),
            south + along(self.rows),
        ]
    }

    /// Cells whose middle lies within a box around two points: columns and rows.
    fn near(&self, a: [f64; 2], b: [f64; 2], reach_m: f64) -> [std::ops::Range<usize>; 2] {
        let counts = [self.columns, self.rows];
        [0, 1].map(|k| {
            let cell = |x: f64| (x - self.corner_m[k]) / self.cell_m - 0.5;
            let low = cell(a[k].min(b[k]) - reach_m).ceil().max(0.0);
            let high = (cell(a[k].max(b[k]) + reach_m).floor() + 1.0).max(0.0);
            low.min(counts[k] as f64) as usize..high.min(counts[k] as f64) as usize
        })
    }

    /// What flights saw within a reach of them.
    pub(super) fn seen(&self, flights: &Flights, reach_m: f64) -> Seen {
        let count = self.columns * self.rows;
        let mut seen = Seen {
            visits: vec![0; count],
            dwell_s: vec![0.0; count],
            last_s: vec![f64::NAN; count],
            share: Curve::default(),
        };
        // Of each cell the time at which it was first seen.
        let mut first_s = vec![f64::INFINITY; count];
        // Until when the last one who came has been in a cell, and who that is.
        let mut until_s = vec![f64::NEG_INFINITY; count];
        let mut whose = vec![usize::MAX; count];
        for (who, flight) in flights.flights.iter().enumerate() {
            let points: Vec<_> = (flight.known())
                .map(|(at, [x, y, _])| (flights.times_s[at], [x, y]))
                .collect();
            let alone = [(points.first().copied()), (points.first().copied())];
            let steps = points.windows(2).map(|two| (two[0], two[1]));
            let single = match (points.len(), alone) {
                (1, [Some(a), Some(b)]) => Some((a, b)),
                _ => None,
            };
            for ((t0, a), (t1, b)) in steps.chain(single) {
                let [columns, rows] = self.near(a, b, reach_m);
                for row in rows {
                    for column in columns.clone() {
                        let middle = [
                            self.corner_m[0] + (column as f64 + 0.5) * self.cell_m,
                            self.corner_m[1] + (row as f64 + 0.5) * self.cell_m,
                        ];
                        let Some([from, to]) = chord(a, b, middle, reach_m) else {
                            continue;
                        };
                        let (from_s, to_s) = (t0 + from * (t1 - t0), t0 + to * (t1 - t0));
                        let cell = row * self.columns + column;
                        if whose[cell] != who || from_s > until_s[cell] + 1e-9 {
                            seen.visits[cell] += 1;
                        }
                        (whose[cell], until_s[cell]) = (who, to_s);
                        seen.dwell_s[cell] += to_s - from_s;
                        seen.last_s[cell] = to_s.max(seen.last_s[cell]);
                        first_s[cell] = first_s[cell].min(from_s);
                    }
                }
            }
        }
        seen.share = share_curve(&mut first_s, &flights.times_s);
        seen
    }
}

/// The share of cells seen at each time, from when each was first seen.
fn share_curve(first_s: &mut [f64], times_s: &[f64]) -> Curve {
    first_s.sort_by(f64::total_cmp);
    let step = times_s.len().div_ceil(TIMES).max(1);
    let last = times_s.len().saturating_sub(1);
    let at = |time_s: f64| first_s.partition_point(|t| *t <= time_s + 1e-9) as f64;
    let places = (0..times_s.len()).filter(|place| place % step == 0 || *place == last);
    Curve {
        who: String::new(),
        points: places
            .map(|place| [times_s[place], at(times_s[place]) / first_s.len() as f64])
            .collect(),
        holds: false,
    }
}

/// From which to which share of a straight way a disc is reached; `None` if it is not.
fn chord(a: [f64; 2], b: [f64; 2], middle: [f64; 2], radius: f64) -> Option<[f64; 2]> {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let [ex, ey] = [a[0] - middle[0], a[1] - middle[1]];
    let square = dx * dx + dy * dy;
    let c = ex * ex + ey * ey - radius * radius;
    if square <= 0.0 {
        return (c <= 0.0).then_some([0.0, 1.0]);
    }
    let half = (ex * dx + ey * dy) / square;
    let under = half * half - c / square;
    if under < 0.0 {
        return None;
    }
    let root = under.sqrt();
    let (from, to) = ((-half - root).max(0.0), (-half + root).min(1.0));
    (from <= to).then_some([from, to])
}

impl Seen {
    /// The share of cells that were seen at the end.
    pub(super) fn share(&self) -> f64 {
        let seen = self.visits.iter().filter(|n| **n > 0).count();
        seen as f64 / self.visits.len().max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::super::flights::Flight;
    use super::*;

    fn straight() -> Flights {
        // Ten metres east in ten seconds.
        Flights {
            times_s: vec![0.0, 5.0, 10.0],
            flights: vec![Flight {
                points_m: vec![[0.0; 3], [5.0, 0.0, 1.0], [10.0, 0.0, 1.0]],
                ..Flight::default()
            }],
        }
    }

    #[test]
    fn a_straight_flight_sees_a_strip_with_round_ends() {
        let grid = Grid {
            corner_m: [-5.0, -5.0],
            cell_m: 0.05,
            columns: 400,
            rows: 200,
        };
        let seen = grid.seen(&straight(), 2.0);
        let area_m2 = seen.share() * grid.area_m2();
        let wanted = 2.0 * 2.0 * 10.0 + std::f64::consts::PI * 4.0;
        assert!(
            (area_m2 - wanted).abs() < 0.01 * wanted,
            "{area_m2} {wanted}"
        );
        // Half of the way, half of the strip.
        let middle = seen.share.at(5.0).expect("known") * grid.area_m2();
        let wanted = 2.0 * 2.0 * 5.0 + std::f64::consts::PI * 4.0;
        assert!((middle - wanted).abs() < 0.01 * wanted, "{middle} {wanted}");
    }

    #[test]
    fn a_cell_on_the_way_is_visited_once_for_as_long_as_it_is_in_reach() {
        let grid = Grid {
            corner_m: [4.5, -0.5],
            cell_m: 1.0,
            columns: 1,
            rows: 1,
        };
        // Its middle is at (5, 0), where one tick is: the visit goes on over it.
        let seen = grid.seen(&straight(), 1.5);
        assert_eq!(seen.visits, [1]);
        assert!((seen.dwell_s[0] - 3.0).abs() < 1e-9);
        assert!((seen.last_s[0] - 6.5).abs() < 1e-9);
        assert_eq!(seen.share.points, [[0.0, 0.0], [5.0, 1.0], [10.0, 1.0]]);
    }

    #[test]
    fn who_comes_back_visits_again() {
        let mut flights = straight();
        flights.flights[0].points_m[2] = [0.0, 0.0, 1.0];
        let grid = Grid {
            corner_m: [1.5, -0.5],
            cell_m: 1.0,
            columns: 1,
            rows: 1,
        };
        assert_eq!(grid.seen(&flights, 0.5).visits, [2]);
    }

    #[test]
    fn two_who_come_are_two_visits() {
        let mut flights = straight();
        flights.flights.push(flights.flights[0].clone());
        let grid = Grid {
            corner_m: [4.5, -0.5],
            cell_m: 1.0,
            columns: 1,
            rows: 1,
        };
        assert_eq!(grid.seen(&flights, 1.5).visits, [2]);
    }
}
