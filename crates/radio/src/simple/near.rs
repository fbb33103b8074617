//! Who may hear a frame, in a band that is wide against the reach of its frames.
//!
//! Members lie in a grid by where they were when it was built, and it serves for many instants: the
//! [odometer](Poses::odometer) says how far anybody can have come since, and so much farther it looks.
//! Only of those it finds are the positions asked, as they are at the frame's own instant. The rest is
//! that of a band without a grid, pair by pair, so when the grid was built can be seen in no result.

use super::band::Members;
use super::pair::Listeners;
use crate::grid::{Grid, share_within, widths_m};
use crate::medium::Poses;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::Position;

/// Edge of a cube of the grid over the range.
const CELL: f64 = 0.5;

/// Shortest edge of a cube, m.
pub(super) const CELL_M_MIN: f64 = 0.01;

/// A grid is built anew when as many members were looked at in vain, as it is out of date, as there are
/// members times this.
const WASTE: f64 = 1.5;

/// Virtual time between two looks at how wide a band is, ns.
const REVIEW_NS: u64 = 100_000_000;

/// The edge of a cube for a range.
pub(super) fn cell_m(range_m: f64) -> f64 {
    (CELL * range_m).max(CELL_M_MIN)
}

/// How far one must look in a grid of f32, with coordinates up to `most_m`, to miss nobody within
/// `reach_m`: more by the rounding of places and distances.
pub(super) fn with_rounding(reach_m: f64, most_m: f64) -> f64 {
    reach_m * (1.0 + 1e-5) + most_m * 1e-6 + 1e-3
}

/// The greatest coordinate, as a positive number.
pub(super) fn most_m(places: &[Vec<f32>; 3]) -> f64 {
    let all = places.iter().flatten();
    all.fold(0.0f32, |most, x| most.max(x.abs())).into()
}

/// A grid of the members, and room for those that one frame may reach.
#[derive(Debug, Default)]
pub(super) struct Near {
    grid: Grid,
    built: Option<Built>,
    /// The members in the order of the grid, placed as they were when it was built.
    columns: Listeners,
    /// Candidates for one frame, placed as they are.
    pub(super) picked: Listeners,
    pub(super) rows: Vec<u32>,
    owners: Vec<ModelId>,
    positions: Vec<Position>,
    /// Whether the band is wide, and when that was looked at.
    wide: bool,
    reviewed: Option<SimTime>,
}

/// What a grid was built from.
#[derive(Clone, Copy, Debug)]
struct Built {
    /// Instant and generation.
    at: (SimTime, u64),
    odometer_m: Option<f64>,
    most_m: f64,
    /// Members looked at in vain since.
    wasted: f64,
}

impl Near {
    /// The members are others, or others are on other rows.
    pub(super) fn forget(&mut self) {
        self.built = None;
        self.reviewed = None;
    }

    /// Whether it is time to look how wide the band is.
    pub(super) fn review_due(&self, now: SimTime) -> bool {
        self.reviewed
            .is_none_or(|last| now.nanos().saturating_sub(last.nanos()) >= REVIEW_NS)
    }

    /// Looks at how wide the band is: whether a frame reaches less than `share` of it.
    pub(super) fn review(
        &mut self,
        now: SimTime,
        places: &[Vec<f32>; 3],
        range_m: f64,
        share: f64,
    ) {
        self.reviewed = Some(now);
        self.wide = range_m.is_finite() && share_within(range_m, widths_m(places)) < share;
    }

    pub(super) fn wide(&self) -> bool {
        self.wide
    }

    /// How far anybody may have come since the grid was built; `None` if it is of no use any more.
    fn travelled_m(&self, now: SimTime, poses: &dyn Poses, members: usize) -> Option<f64> {
        let built = self.built.as_ref()?;
        if built.at == (now, poses.generation()) {
            return Some(0.0);
        }
        let travelled = poses.odometer()?.metres() - built.odometer_m?;
        let fresh = built.wasted <= WASTE * members as f64;
        (fresh && travelled.is_finite()).then_some(travelled.max(0.0))
    }

    /// Whether the grid can be used as it is.
    pub(super) fn holds(&self, now: SimTime, poses: &dyn Poses, members: usize) -> bool {
        self.travelled_m(now, poses, members).is_some()
    }

    /// Sorts the members, placed as they are now, into a grid.
    pub(super) fn build(
        &mut self,
        now: SimTime,
        poses: &dyn Poses,
        members: &Members,
        range_m: f64,
    ) {
        self.built = Some(Built {
            at: (now, poses.generation()),
            odometer_m: poses.odometer().map(|count| count.metres()),
            most_m: most_m(&members.places),
            wasted: 0.0,
        });
        let places = &members.places;
        self.grid.build(places, widths_m(places), cell_m(range_m));
        self.columns.clear();
        let c = &members.columns;
        for row in self.grid.order().iter().map(|row| *row as usize) {
            let place = [places[0][row], places[1][row], places[2][row]];
            self.columns.push_copy(c, row, place);
        }
    }

    /// Picks the members that a frame sent from `from` may reach, and places them as they are now.
    pub(super) fn pick(
        &mut self,
        now: SimTime,
        poses: &dyn Poses,
        members: &mut Members,
        from: [f32; 3],
        range_m: f64,
    ) {
        let count = members.owners.len();
        let travelled = self.travelled_m(now, poses, count).unwrap_or(f64::INFINITY);
        let (picked, columns) = (&mut self.picked, &self.columns);
        picked.clear();
        self.rows.clear();
        self.owners.clear();
        let Some(built) = &mut self.built else { return };

        // Antennas turn about the centres of their platforms, whose travel it is.
        let away = range_m + travelled + 2.0 * members.offset_m;
        let reach = with_rounding(away, built.most_m + travelled);
        let reach_squared = (reach * reach) as f32;
        let [x, y, z] = &columns.enu_m;
        self.grid.around(from, reach, |run| {
            let (x, y, z) = (&x[run.clone()], &y[run.clone()], &z[run.clone()]);
            for (j, at) in run.enumerate() {
                let d = [x[j] - from[0], y[j] - from[1], z[j] - from[2]];
                let row = self.grid.order()[at];
                if d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= reach_squared
                    && members.awake[row as usize]
                {
                    self.rows.push(row);
                    self.owners.push(members.owners[row as usize]);
                    picked.push_copy(columns, at, [x[j], y[j], z[j]]);
                }
            }
        });
        built.wasted += self.rows.len() as f64 * (1.0 - (range_m / away) * (range_m / away));

        self.positions.clear();
        poses.positions(&self.owners, &mut self.positions);
        for (j, (row, position)) in self.rows.iter().zip(&self.positions).enumerate() {
            let place = members.place_row(*row as usize, *position, poses);
            (0..3).for_each(|axis| self.picked.enu_m[axis][j] = place[axis]);
        }
    }
}
