//! What a scanning range sensor reads: distances over azimuth and elevation.

use simbeeotic_model::check::in_range;
use simbeeotic_model::kernel::Stream;
use simbeeotic_model::units::{Angle, Length, Offset, math};
use simbeeotic_model::{Beams, BuildError, Column, Reading, SeesWhat, Truth};
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use super::echo::{RAYS_MAX, Ranger, some};
use glam::DVec3;

/// The directions of a scan: a grid of elevations (rows) and azimuths (columns), in the sensor's frame.
///
/// ```text
/// d = (cos e cos a, cos e sin a, sin e)      azimuth a counter-clockwise from forward, elevation e up
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct ScanGrid {
    azimuths: Box<[Spoke]>,
    elevations: Box<[Spoke]>,
}

/// An angle with its sine and cosine.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spoke {
    angle: Angle,
    sin: f64,
    cos: f64,
}

impl Spoke {
    fn new(angle: f64) -> Self {
        let (sin, cos) = math::sin_cos(angle);
        Self {
            angle: Angle::si(angle),
            sin,
            cos,
        }
    }
}

/// `count` angles evenly from one to another, both included; of a full turn the last is left out, as it
/// is the first again.
fn spokes(from: f64, to: f64, count: u32) -> Box<[Spoke]> {
    let full = (to - from).abs() >= TAU * (1.0 - 1e-12);
    let steps = if full { count } else { count - 1 };
    let step = (to - from) / f64::from(steps.max(1));
    let angles = (0..count).map(|at| Spoke::new(from + f64::from(at) * step));
    angles.collect()
}

impl ScanGrid {
    /// Azimuths and elevations from one to another, and how many.
    pub(super) fn new(
        (start, end, columns): (Angle, Angle, u32),
        (lowest, highest, rows): (Angle, Angle, u32),
    ) -> Result<Arc<Self>, BuildError> {
        let (turn, level) = (Angle::si(TAU), Angle::si(FRAC_PI_2));
        in_range("rays", columns, 1..=RAYS_MAX)?;
        in_range("start", start, -turn..=turn)?;
        in_range("end", end, start..=start + turn)?;
        in_range("rows", rows, 1..=RAYS_MAX / columns)?;
        in_range("lowest", lowest, -level..=level)?;
        in_range("highest", highest, lowest..=level)?;
        Ok(Arc::new(Self {
            azimuths: spokes(start.get(), end.get(), columns),
            elevations: spokes(lowest.get(), highest.get(), rows),
        }))
    }

    /// Its directions, row by row, in the sensor's frame, unit.
    fn directions(&self) -> impl Iterator<Item = DVec3> {
        self.elevations.iter().flat_map(|e| {
            self.azimuths
                .iter()
                .map(|a| DVec3::new(e.cos * a.cos, e.cos * a.sin, e.sin))
        })
    }

    fn angles(&self) -> impl Iterator<Item = (Angle, Angle)> {
        self.elevations
            .iter()
            .flat_map(|e| self.azimuths.iter().map(|a| (a.angle, e.angle)))
    }

    fn len(&self) -> usize {
        self.elevations.len() * self.azimuths.len()
    }
}

/// One scan: how far the next thing is in each direction of a grid. Every scanning sensor reads one, with
/// one row or many.
///
/// All rays are those of one instant: that a real scanner turns while it measures is not modelled.
/// A recording has one row for each direction: azimuth, elevation, distance, NaN where nothing is in range.
#[derive(Clone, Debug)]
pub struct Scan {
    grid: Arc<ScanGrid>,
    /// Metres, row by row; NaN: nothing in range.
    distances_m: Box<[f64]>,
}

/// One echo of a [`Scan`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScanEcho {
    /// Counter-clockwise from the sensor's forward axis, seen from above.
    pub azimuth: Angle,
    /// Above the sensor's horizontal plane.
    pub elevation: Angle,
    /// How far it is.
    pub distance: Length,
}

impl Scan {
    /// How many directions one row has.
    pub fn columns(&self) -> usize {
        self.grid.azimuths.len()
    }

    /// How many rows there are: 1 for a scanner in a plane.
    pub fn rows(&self) -> usize {
        self.grid.elevations.len()
    }

    /// How far the next thing is in one direction; `None` if nothing is in range, or if there is no such
    /// direction.
    pub fn distance(&self, row: usize, column: usize) -> Option<Length> {
        if column >= self.columns() {
            return None;
        }
        let at = row.checked_mul(self.columns())?.checked_add(column)?;
        some(*self.distances_m.get(at)?)
    }

    /// All distances, row by row, each row by azimuth.
    pub fn distances(&self) -> impl Iterator<Item = Option<Length>> {
        self.distances_m.iter().copied().map(some)
    }

    /// The directions: azimuth and elevation, in the same order.
    pub fn directions(&self) -> impl Iterator<Item = (Angle, Angle)> {
        self.grid.angles()
    }

    /// Everything in range, in the same order.
    pub fn echoes(&self) -> impl Iterator<Item = ScanEcho> {
        let all = self.directions().zip(self.distances());
        all.filter_map(|((azimuth, elevation), distance)| {
            Some(ScanEcho {
                azimuth,
                elevation,
                distance: distance?,
            })
        })
    }

    /// The nearest echo; of several as near, the first.
    pub fn nearest(&self) -> Option<ScanEcho> {
        let nearer = |best: ScanEcho, echo: ScanEcho| {
            if echo.distance < best.distance {
                echo
            } else {
                best
            }
        };
        self.echoes().reduce(nearer)
    }

    /// Where everything in range is, in the sensor's own frame, in the same order.
    pub fn points(&self) -> impl Iterator<Item = Offset> {
        let all = self.grid.directions().zip(&self.distances_m);
        all.filter(|(_, distance_m)| !distance_m.is_nan())
            .map(|(direction, distance_m)| Offset::from_si(direction * *distance_m))
    }
}

impl Reading for Scan {
    const COLUMNS: &'static [Column] = &[
        Column::new("azimuth", "rad"),
        Column::new("elevation", "rad"),
        Column::new("distance", "m"),
    ];

    fn numbers(&self, to: &mut Vec<f64>) {
        let all = self.directions().zip(&self.distances_m);
        to.extend(all.flat_map(|((a, e), distance_m)| [a.get(), e.get(), *distance_m]));
    }
}

/// What all scanning sensors do.
#[derive(Clone, Debug)]
pub(super) struct Scanner {
    pub(super) grid: Arc<ScanGrid>,
    pub(super) ranger: Ranger,
    pub(super) sees: SeesWhat,
}

impl Scanner {
    /// Where it looks: single rays, or what they fill if they are many.
    pub(super) fn beams(&self) -> Beams {
        let range = self.ranger.max_range();
        if self.grid.len() <= Beams::RAYS_MAX {
            return Beams::Rays {
                directions: self.grid.directions().map(|d| d.to_array()).collect(),
                range_m: range.get(),
            };
        }
        // A picture is about the line of sight: as wide as the ray that is farthest from it.
        let widest = |spokes: &[Spoke]| {
            let angles = spokes.iter().map(|spoke| spoke.angle.abs());
            angles.fold(Angle::ZERO, Angle::max) * 2.0
        };
        Beams::window(
            widest(&self.grid.azimuths),
            widest(&self.grid.elevations),
            range,
        )
    }

    /// The true distances. Apart from the reading nothing is allocated.
    pub(super) fn ideal(&self, truth: &Truth<'_>) -> Scan {
        let mut distances_m = vec![f64::NAN; self.grid.len()].into_boxed_slice();
        let (directions, range) = (self.grid.directions(), self.ranger.max_range());
        truth.look(directions, range, self.sees, |at, echo| {
            if let Some(echo) = echo {
                distances_m[at] = echo.distance.get();
            }
        });
        Scan {
            grid: self.grid.clone(),
            distances_m,
        }
    }

    /// The same with the sensor's errors.
    pub(super) fn measure(&mut self, mut scan: Scan, truth: &Truth<'_>, rng: &mut Stream) -> Scan {
        let air = self.ranger.clarity(truth);
        for distance_m in &mut scan.distances_m {
            *distance_m = self.ranger.measure(*distance_m, &air, rng);
        }
        scan
    }
}

/// A full turn about the forward axis.
pub(super) const FULL_TURN: (Angle, Angle) = (Angle::ZERO, Angle::si(2.0 * PI));
