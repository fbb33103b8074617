//! An antenna from a table: measured in a chamber, or from a field solver.
//!
//! The table is text, one direction a line, with a header that names its columns in any order:
//!
//! ```text
//! # 2.45 GHz chip antenna on the board, battery fitted; lines that start with # are skipped
//! azimuth, elevation, gain
//! 0, 0, 1.2
//! 10, 0, 0.9
//! ```
//!
//! `azimuth` is counted from the boresight (x) to the left (y), `elevation` from the xy plane up (z),
//! both in degrees; `gain` is in dBi, losses included. Instead of these two, `phi` and `theta` may be
//! given, as chambers and solvers have them: `phi` is the azimuth, `theta` the angle from z, 0 above
//! and 180 below.
//!
//! The directions are a grid: all combinations of some azimuths and some elevations, each once, in any
//! order, not necessarily equally far apart. Azimuths go round: between the last and the first is
//! interpolated as well, and a direction that stands twice (0 and 360 degrees) must have the same gain
//! twice. Above the highest elevation and below the lowest the gain is that of the edge. One azimuth
//! alone is a pattern that is the same all round, one elevation alone one that is the same at all
//! heights.
//!
//! Between directions the gain is interpolated bilinearly in dB.

use super::Antenna;
use crate::fast;
use crate::table::{TableFault, cells, lines};
use glam::{DVec3, Vec3};
use simbeeotic_units::{Decibels, did_you_mean, math};
use std::f64::consts::FRAC_PI_2;

/// A gain for each direction of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    azimuths: Axis,
    elevations: Axis,
    /// dBi; by elevation, then azimuth.
    gains_db: Vec<f64>,
    loss_db: f64,
}

/// One coordinate of a grid: rising values in degrees.
#[derive(Clone, Debug, PartialEq)]
struct Axis {
    values: Vec<f64>,
    /// Values a degree, if they are equally far apart.
    density: Option<f64>,
}

/// The most directions that a table may have.
const DIRECTIONS_MAX: usize = 4_000_000;

/// Directions closer than this are the same, degrees.
const SAME_DEG: f64 = 1e-6;

impl Pattern {
    /// The pattern of a table, see the [module](self), less `loss` for what the table leaves out.
    ///
    /// # Errors
    /// All that is wrong with the text.
    pub fn read(text: &str, loss: Decibels) -> Result<Self, Vec<TableFault>> {
        let mut faults = Vec::new();
        let rows = rows(text, &mut faults);
        if !faults.is_empty() {
            return Err(faults);
        }
        let azimuths = distinct(rows.iter().map(|row| row.azimuth_deg));
        let elevations = distinct(rows.iter().map(|row| row.elevation_deg));
        let gains_db = fill(&rows, &azimuths, &elevations)?;
        Ok(Self {
            azimuths: Axis::new(azimuths),
            elevations: Axis::new(elevations),
            gains_db,
            loss_db: loss.db(),
        })
    }

    /// How many azimuths and elevations it has.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.azimuths.values.len(), self.elevations.values.len())
    }

    /// The gain at an azimuth (-180 to 360 degrees) and an elevation.
    fn gain_db(&self, azimuth_deg: f64, elevation_deg: f64) -> f64 {
        let (left, right, east) = self.azimuths.around(azimuth_deg);
        let (below, above, up) = self.elevations.between(elevation_deg);
        let row = |at: usize| {
            let first = at * self.azimuths.values.len();
            let (a, b) = (self.gains_db[first + left], self.gains_db[first + right]);
            a + east * (b - a)
        };
        let (low, high) = (row(below), row(above));
        low + up * (high - low) - self.loss_db
    }
}

impl Antenna for Pattern {
    fn gain(&self, direction: DVec3) -> Decibels {
        let level = math::hypot(direction.x, direction.y);
        let azimuth = if level > 0.0 {
            math::atan2(direction.y, direction.x)
        } else {
            0.0
        };
        let elevation = if level > 0.0 {
            math::atan2(direction.z, level)
        } else {
            FRAC_PI_2.copysign(direction.z)
        };
        Decibels::from_db(self.gain_db(azimuth.to_degrees(), elevation.to_degrees()))
    }

    fn gain_linear(&self, direction: Vec3) -> f32 {
        let Vec3 { x, y, z } = direction;
        let level = (x * x + y * y).sqrt();
        let azimuth = f64::from(fast::atan2(y, x)).to_degrees();
        let elevation = f64::from(fast::atan2(z, level)).to_degrees();
        fast::ratio(self.gain_db(azimuth, elevation) as f32)
    }
}

impl Axis {
    fn new(values: Vec<f64>) -> Self {
        let steps = values.len() - 1;
        let span = values[steps] - values[0];
        let step = span / steps.max(1) as f64;
        let even = steps > 0
            && (values.iter().enumerate())
                .all(|(i, value)| (values[0] + step * i as f64 - value).abs() < SAME_DEG);
        Self {
            values,
            density: even.then(|| steps as f64 / span),
        }
    }

    /// The values on both sides, and how far `at` is from the first to the second; the end twice beyond
    /// an end.
    fn between(&self, at: f64) -> (usize, usize, f64) {
        let last = self.values.len() - 1;
        if at.is_nan() || at <= self.values[0] {
            return (0, 0, 0.0);
        }
        if at >= self.values[last] {
            return (last, last, 0.0);
        }
        let low = match self.density {
            Some(density) => (((at - self.values[0]) * density) as usize).min(last - 1),
            None => self.values.partition_point(|&value| value <= at) - 1,
        };
        let (a, b) = (self.values[low], self.values[low + 1]);
        (low, low + 1, ((at - a) / (b - a)).clamp(0.0, 1.0))
    }

    /// The same on a circle, with values from 0 to below 360.
    fn around(&self, at: f64) -> (usize, usize, f64) {
        let (first, last) = (self.values[0], self.values.len() - 1);
        let mut at = at;
        while at < first {
            at += 360.0;
        }
        while at >= first + 360.0 {
            at -= 360.0;
        }
        let end = self.values[last];
        if at <= end {
            return self.between(at);
        }
        (
            last,
            0,
            ((at - end) / (first + 360.0 - end)).clamp(0.0, 1.0),
        )
    }
}

/// One line of the table.
struct Row {
    line: usize,
    /// Where its gain stands.
    column: usize,
    /// 0 to below 360.
    azimuth_deg: f64,
    elevation_deg: f64,
    gain_db: f64,
}

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Column {
    Azimuth,
    Elevation,
    Theta,
    Gain,
}

const NAMES: [(&str, Column); 5] = [
    ("azimuth", Column::Azimuth),
    ("elevation", Column::Elevation),
    ("phi", Column::Azimuth),
    ("theta", Column::Theta),
    ("gain", Column::Gain),
];

fn header(number: usize, line: &str, faults: &mut Vec<TableFault>) -> Vec<Column> {
    let mut columns: Vec<(Column, &str)> = Vec::new();
    let before = faults.len();
    for (column, name) in cells(line) {
        let fault = |message| TableFault::new(number, column, message);
        match NAMES.iter().find(|(known, _)| *known == name) {
            Some((_, kind)) => {
                let height = |c| matches!(c, Column::Elevation | Column::Theta);
                let same =
                    |(other, _): &&(Column, &str)| other == kind || height(*other) && height(*kind);
                match columns.iter().find(same) {
                    Some((_, other)) if *other == name => {
                        faults.push(fault(format!("a second `{name}`")));
                    }
                    Some((_, other)) => {
                        let message = format!("`{name}` and `{other}` say the same: one will do");
                        faults.push(fault(message));
                    }
                    None => columns.push((*kind, name)),
                }
            }
            None => {
                let guess = did_you_mean(name, NAMES.iter().map(|(known, _)| *known));
                let help = match guess {
                    Some(guess) => format!("did you mean `{guess}`?"),
                    None => "there are azimuth, elevation (or phi, theta) and gain".to_owned(),
                };
                faults.push(fault(format!("unknown column `{name}`; {help}")));
            }
        }
    }
    if faults.len() == before {
        let has = |wanted: &[Column]| columns.iter().any(|(c, _)| wanted.contains(c));
        for (wanted, names) in [
            (&[Column::Azimuth][..], "`azimuth` (or `phi`)"),
            (
                &[Column::Elevation, Column::Theta],
                "`elevation` (or `theta`)",
            ),
            (&[Column::Gain], "`gain`"),
        ] {
            if !has(wanted) {
                faults.push(TableFault::new(
                    number,
                    1,
                    format!("there is no column {names}"),
                ));
            }
        }
    }
    columns.into_iter().map(|(column, _)| column).collect()
}

fn rows(text: &str, faults: &mut Vec<TableFault>) -> Vec<Row> {
    let mut lines = lines(text);
    let Some((number, first)) = lines.next() else {
        faults.push(TableFault::new(
            1,
            1,
            "the table is empty: it begins with a line such as `azimuth, elevation, gain`",
        ));
        return Vec::new();
    };
    let columns = header(number, first, faults);
    if !faults.is_empty() {
        return Vec::new();
    }
    let mut rows = Vec::new();
    let mut end = number;
    for (number, line) in lines {
        end = number;
        if let Some(row) = row(number, line, &columns, faults) {
            rows.push(row);
        }
        if rows.len() > DIRECTIONS_MAX {
            faults.push(TableFault::new(
                number,
                1,
                format!("more than {DIRECTIONS_MAX} directions"),
            ));
            break;
        }
    }
    if rows.is_empty() && faults.is_empty() {
        faults.push(TableFault::new(
            end,
            1,
            "there is no direction below the header",
        ));
    }
    rows
}

fn row(line: usize, text: &str, columns: &[Column], faults: &mut Vec<TableFault>) -> Option<Row> {
    let before = faults.len();
    let found = cells(text).count();
    if found != columns.len() {
        faults.push(TableFault::new(
            line,
            1,
            format!("{found} numbers where the header has {}", columns.len()),
        ));
        return None;
    }
    let mut row = Row {
        line,
        column: 1,
        azimuth_deg: 0.0,
        elevation_deg: 0.0,
        gain_db: 0.0,
    };
    for ((column, cell), kind) in cells(text).zip(columns) {
        let mut fault = |message| {
            faults.push(TableFault::new(line, column, message));
        };
        let Some(value) = cell.parse::<f64>().ok().filter(|v| v.is_finite()) else {
            fault(format!("`{cell}` is no number"));
            continue;
        };
        let (what, least, most) = match kind {
            Column::Azimuth => ("an azimuth", -360.0, 360.0),
            Column::Elevation => ("an elevation", -90.0, 90.0),
            Column::Theta => ("a theta", 0.0, 180.0),
            Column::Gain => ("a gain", -200.0, 60.0),
        };
        if !(least..=most).contains(&value) {
            fault(format!("{what} of {value}: expected {least} to {most}"));
            continue;
        }
        match kind {
            Column::Azimuth => row.azimuth_deg = on_circle(value),
            Column::Elevation => row.elevation_deg = value,
            Column::Theta => row.elevation_deg = 90.0 - value,
            Column::Gain => (row.gain_db, row.column) = (value, column),
        }
    }
    (faults.len() == before).then_some(row)
}

/// An angle from -360 to 360 degrees as one from 0 to below 360.
fn on_circle(degrees: f64) -> f64 {
    let turned = if degrees < 0.0 {
        degrees + 360.0
    } else {
        degrees
    };
    if turned >= 360.0 - SAME_DEG {
        0.0
    } else {
        turned
    }
}

/// The values that occur, rising, each once.
fn distinct(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut all: Vec<f64> = values.collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|b, a| *b - *a < SAME_DEG);
    all
}

/// Where a value stands among the distinct ones.
fn place(values: &[f64], value: f64) -> usize {
    values.partition_point(|&v| v < value - SAME_DEG)
}

fn fill(rows: &[Row], azimuths: &[f64], elevations: &[f64]) -> Result<Vec<f64>, Vec<TableFault>> {
    let mut faults = Vec::new();
    let cells = azimuths.len().saturating_mul(elevations.len());
    let last = rows.last().map_or(1, |row| row.line);
    if cells > DIRECTIONS_MAX {
        let message = format!(
            "{} azimuths by {} elevations are no grid of {} directions",
            azimuths.len(),
            elevations.len(),
            rows.len()
        );
        return Err(vec![TableFault::new(last, 1, message)]);
    }
    let mut from: Vec<Option<&Row>> = vec![None; cells];
    for row in rows {
        let at = place(elevations, row.elevation_deg) * azimuths.len()
            + place(azimuths, row.azimuth_deg);
        match from[at] {
            None => from[at] = Some(row),
            Some(first) if first.gain_db == row.gain_db => {}
            Some(first) => faults.push(TableFault::new(
                row.line,
                row.column,
                format!(
                    "azimuth {} elevation {} has a gain of {} here and of {} in line {}",
                    row.azimuth_deg, row.elevation_deg, row.gain_db, first.gain_db, first.line
                ),
            )),
        }
    }
    for (at, _) in from.iter().enumerate().filter(|(_, row)| row.is_none()) {
        faults.push(TableFault::new(
            last,
            1,
            format!(
                "the grid has a hole: nothing for azimuth {} elevation {}",
                azimuths[at % azimuths.len()],
                elevations[at / azimuths.len()]
            ),
        ));
    }
    if faults.is_empty() {
        Ok(from.into_iter().flatten().map(|row| row.gain_db).collect())
    } else {
        Err(faults)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{assert_fast_is_exact, towards};
    use super::super::{HalfWaveDipole, mean_gain};
    use super::*;

    fn pattern(text: &str) -> Pattern {
        match Pattern::read(text, Decibels::ZERO) {
            Ok(pattern) => pattern,
            Err(faults) => panic!("{faults:?}"),
        }
    }

    fn faults(text: &str) -> Vec<String> {
        let found = Pattern::read(text, Decibels::ZERO).expect_err("there are faults");
        found.iter().map(ToString::to_string).collect()
    }

    /// The table of another antenna.
    fn table_of(antenna: &dyn Antenna, step_deg: usize) -> String {
        let mut text = String::from("# made of a formula\n\nphi, theta, gain\n");
        for phi in (0..=360).step_by(step_deg) {
            for theta in (0..=180).step_by(step_deg) {
                let direction = towards(phi as f64, 90.0 - theta as f64);
                // One writing for 0 and for 360 degrees.
                let gain = antenna.gain(direction).db();
                text += &format!("{phi}, {theta}, {gain:.6}\n");
            }
        }
        text
    }

    #[test]
    fn it_gives_what_stands_in_the_table_and_goes_round() {
        let table = "gain,azimuth,elevation\n\
                     0,-90,0\n 3,0,0\n 6,90,0\n 9,180,0\n\
                     1,-90,60\n 1,0,60\n 1,90,60\n 1,180,60\n";
        let antenna = pattern(table);
        assert_eq!(antenna.size(), (4, 2));
        for (azimuth, elevation, db) in [
            (0.0, 0.0, 3.0),
            (45.0, 0.0, 4.5),
            (90.0, 0.0, 6.0),
            (179.999_999, 0.0, 9.0),
            (-135.0, 0.0, 4.5),
            (225.0, 0.0, 4.5),
            (-45.0, 0.0, 1.5),
            (45.0, 30.0, 2.75),
            (45.0, 80.0, 1.0),
            (45.0, -80.0, 4.5),
        ] {
            let gain = antenna.gain(towards(azimuth, elevation)).db();
            assert!(
                (gain - db).abs() < 1e-5,
                "{azimuth} {elevation}: {gain} for {db}"
            );
        }
        let lossy = Pattern::read(table, Decibels::from_db(2.0)).unwrap();
        assert!((lossy.gain(DVec3::X).db() - 1.0).abs() < 1e-9);
        assert_fast_is_exact(&antenna, 1e-3);
    }

    #[test]
    fn straight_up_and_down_are_directions_too() {
        let antenna = pattern("azimuth,elevation,gain\n0,-90,-7\n0,0,1\n0,90,-3\n");
        assert!((antenna.gain(DVec3::Z).db() + 3.0).abs() < 1e-9);
        assert!((antenna.gain(-DVec3::Z).db() + 7.0).abs() < 1e-9);
        assert!((f64::from(antenna.gain_linear(-Vec3::Z)) - 0.199_526).abs() < 1e-5);
        assert!((antenna.gain(DVec3::Y).db() - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_table_of_a_dipole_is_a_dipole() {
        let dipole = HalfWaveDipole::default();
        let antenna = pattern(&table_of(&dipole, 5));
        assert_eq!(antenna.size(), (72, 37));
        for elevation in [0.0, 12.5, 31.0, -47.0, 62.0] {
            for azimuth in [0.0, 77.7, -123.4] {
                let direction = towards(azimuth, elevation);
                let off = (antenna.gain(direction) - dipole.gain(direction)).db();
                assert!(off.abs() < 0.05, "{azimuth} {elevation}: {off}");
            }
        }
        let mean = mean_gain(&antenna);
        assert!((mean - 1.0).abs() < 4e-3, "{mean}");
        assert_fast_is_exact(&antenna, 2e-3);
    }

    #[test]
    fn uneven_grids_are_grids() {
        let antenna = pattern(
            "azimuth,elevation,gain\n10,0,1\n20,0,2\n90,0,9\n300,0,0\n10,5,1\n20,5,2\n90,5,9\n300,5,0",
        );
        assert!((antenna.gain(towards(55.0, 2.0)).db() - 5.5).abs() < 1e-9);
        assert!((antenna.gain(towards(-25.0, 2.0)).db() - 0.5).abs() < 1e-9);
    }

    #[test]
    fn all_faults_are_told_with_line_and_column() {
        assert_eq!(
            faults("azimuth,elevation,gain\n0,0,abc\n0,95,1\n0,1\n10,0, 70\n"),
            [
                "2:5: `abc` is no number",
                "3:3: an elevation of 95: expected -90 to 90",
                "4:1: 2 numbers where the header has 3",
                "5:7: a gain of 70: expected -200 to 60",
            ]
        );
        assert_eq!(
            faults("azimut,theta, elevation,gain\n"),
            [
                "1:1: unknown column `azimut`; did you mean `azimuth`?",
                "1:15: `elevation` and `theta` say the same: one will do",
            ]
        );
        assert_eq!(
            faults("azimuth,elevation\n0,0\n"),
            ["1:1: there is no column `gain`"]
        );
        assert_eq!(
            faults("azimuth,elevation,gain\n0,0,1\n90,0,1\n0,10,1\n360,0,2\n"),
            [
                "5:7: azimuth 0 elevation 0 has a gain of 2 here and of 1 in line 2",
                "5:1: the grid has a hole: nothing for azimuth 90 elevation 10",
            ]
        );
        assert!(faults("")[0].starts_with("1:1: the table is empty"));
        assert_eq!(
            faults("# nothing\nphi,theta,gain\n"),
            ["2:1: there is no direction below the header"]
        );
        assert_eq!(
            faults("azimuth,elevation,gain\n0,0,inf\n"),
            ["2:5: `inf` is no number"]
        );
    }
}
