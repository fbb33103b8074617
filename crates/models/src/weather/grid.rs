//! A wind that was measured or computed elsewhere: values on a grid, from a file.
//!
//! The file is text, one point a line, with a header that names the columns in any order:
//!
//! ```text
//! # wind behind a barn; lines that start with # and empty lines are skipped
//! x, y, z, t, u, v, w
//! 0, 0, 0, 0, 3.1, 0.2, 0.0
//! ```
//! `x y z` is the place in metres (east, north, up), `t` the time in seconds, `u v w` the wind there
//! in m/s. The points are a grid: all combinations of some `x`, some `y`, some `z` and some `t`, each
//! once, in any order, not necessarily equally far apart. Leaving out `x`, `y`, `z` or `t` means that
//! the wind does not change along it. Between the points the wind is interpolated, linear in each of
//! the four.

use crate::table::listed;
use glam::DVec3;
use simbeeotic_model::schemars::JsonSchema;
use simbeeotic_model::serde::{Deserialize, Serialize};
use simbeeotic_model::units::did_you_mean;
use simbeeotic_model::{BuildError, Site, choice};
use std::cmp::Ordering;

/// A recorded wind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(crate = "simbeeotic_model::serde", deny_unknown_fields)]
#[schemars(crate = "simbeeotic_model::schemars")]
pub struct GridParams {
    /// The file, beside the scenario: text with the columns x, y, z, t (metres, seconds), u, v, w
    /// (m/s).
    pub file: String,
    /// What it adds to the wind beyond the grid's edges in space.
    #[serde(default)]
    pub outside: Outside,
    /// Whether the recording begins again after its last time. Otherwise its last wind stays.
    #[serde(default)]
    pub repeat: bool,
}

/// What a recorded wind is beyond the edges of its grid.
#[choice]
#[derive(Default)]
pub enum Outside {
    /// That of the nearest point of the edge.
    #[default]
    Hold,
    /// None.
    Calm,
}

/// A recorded wind, read.
#[derive(Debug)]
pub(super) struct Grid {
    /// x, y, z, t: rising.
    axes: [Vec<f64>; 4],
    /// By t, then z, then y, then x.
    wind: Vec<DVec3>,
    outside: Outside,
    repeat: bool,
}

const COLUMNS: [&str; 7] = ["x", "y", "z", "t", "u", "v", "w"];
/// Faults shown of one file.
const SHOWN: usize = 5;

impl Grid {
    pub(super) fn new(params: &GridParams, site: &Site<'_>) -> Result<Self, BuildError> {
        let path = site.file(&params.file);
        let name = path.display();
        let text = std::fs::read_to_string(&path).map_err(|error| {
            BuildError::parameter("grid", format!("cannot read {name}: {error}"))
        })?;
        let (axes, wind) = parse(&text).map_err(|faults| {
            let faults = listed(faults.into_iter(), SHOWN);
            BuildError::parameter("grid", format!("cannot use {name}: {faults}"))
        })?;
        Ok(Self {
            axes,
            wind,
            outside: params.outside,
            repeat: params.repeat,
        })
    }

    pub(super) fn at(&self, place: DVec3, t_s: f64) -> DVec3 {
        let inside = |axis: usize| {
            let values = &self.axes[axis];
            // A single value stands for all.
            values.len() == 1 || (values[0]..=values[values.len() - 1]).contains(&place[axis])
        };
        if self.outside == Outside::Calm && !(0..3).all(inside) {
            return DVec3::ZERO;
        }
        let times = &self.axes[3];
        let (first, last) = (times[0], times[times.len() - 1]);
        let t_s = if self.repeat && last > first && t_s >= first {
            let span = last - first;
            let over = t_s - first;
            first + (over - span * (over / span).floor())
        } else {
            t_s
        };
        let [x, y, z, t] = [
            cell(&self.axes[0], place.x),
            cell(&self.axes[1], place.y),
            cell(&self.axes[2], place.z),
            cell(&self.axes[3], t_s),
        ];
        let mut sum = DVec3::ZERO;
        for (it, wt) in t {
            for (iz, wz) in z {
                for (iy, wy) in y {
                    for (ix, wx) in x {
                        let weight = wt * wz * wy * wx;
                        if weight != 0.0 {
                            sum += self.wind[self.index([ix, iy, iz, it])] * weight;
                        }
                    }
                }
            }
        }
        sum
    }

    fn index(&self, [ix, iy, iz, it]: [usize; 4]) -> usize {
        let [x, y, z, _] = &self.axes;
        ((it * z.len() + iz) * y.len() + iy) * x.len() + ix
    }
}

/// The two neighbours of a value on an axis, and their weights; the end twice beyond an end.
fn cell(axis: &[f64], value: f64) -> [(usize, f64); 2] {
    let last = axis.len() - 1;
    if last == 0 || value <= axis[0] || value.is_nan() {
        return [(0, 1.0), (0, 0.0)];
    }
    if value >= axis[last] {
        return [(last, 1.0), (last, 0.0)];
    }
    let right = axis.partition_point(|edge| *edge <= value);
    let (a, b) = (axis[right - 1], axis[right]);
    let share = (value - a) / (b - a);
    [(right - 1, 1.0 - share), (right, share)]
}

type Points = ([Vec<f64>; 4], Vec<DVec3>);

/// The grid in a text, or what is wrong with it, line by line.
fn parse(text: &str) -> Result<Points, Vec<String>> {
    let text = text.trim_start_matches('\u{feff}');
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let Some((number, header)) = lines.next() else {
        return Err(vec!["it has no header; write: x, y, z, t, u, v, w".into()]);
    };
    let columns = header_of(number, header)?;
    let mut faults = Vec::new();
    let mut rows: Vec<(usize, [f64; 7])> = Vec::new();
    for (number, line) in lines {
        match row(line, &columns) {
            Ok(row) => rows.push((number, row)),
            Err(message) => faults.push(format!("line {number}: {message}")),
        }
    }
    if !faults.is_empty() {
        return Err(faults);
    }
    if rows.is_empty() {
        return Err(vec!["it has a header and no points".into()]);
    }
    place(&rows)
}

fn header_of(number: usize, header: &str) -> Result<Vec<usize>, Vec<String>> {
    let mut columns = Vec::new();
    let mut faults = Vec::new();
    for name in header.split(',').map(str::trim) {
        match COLUMNS.iter().position(|known| *known == name) {
            Some(column) if columns.contains(&column) => {
                faults.push(format!("line {number}: two columns are called `{name}`"));
            }
            Some(column) => columns.push(column),
            None => {
                let guess = did_you_mean(name, COLUMNS)
                    .map_or(String::new(), |g| format!(", perhaps `{g}`"));
                faults.push(format!(
                    "line {number}: there is no column `{name}`{guess}; columns are {}",
                    COLUMNS.join(", ")
                ));
            }
        }
    }
    if faults.is_empty() {
        let missing = (4..7).filter(|wind| !columns.contains(wind));
        faults.extend(missing.map(|wind| {
            let name = COLUMNS[wind];
            format!("line {number}: the column `{name}` is missing")
        }));
    }
    if faults.is_empty() {
        Ok(columns)
    } else {
        Err(faults)
    }
}

fn row(line: &str, columns: &[usize]) -> Result<[f64; 7], String> {
    let cells: Vec<&str> = line.split(',').map(str::trim).collect();
    if cells.len() != columns.len() {
        let (found, wanted) = (cells.len(), columns.len());
        return Err(format!(
            "{found} values, where the header has {wanted} columns"
        ));
    }
    let mut row = [0.0; 7];
    for (cell, column) in cells.iter().zip(columns) {
        row[*column] = match cell.parse::<f64>() {
            // No negative zero, which would be a coordinate of its own.
            Ok(value) if value.is_finite() => value + 0.0,
            _ => return Err(format!("`{cell}` is no number")),
        };
    }
    Ok(row)
}

/// Sorts the rows into their grid.
fn place(rows: &[(usize, [f64; 7])]) -> Result<Points, Vec<String>> {
    let mut rows: Vec<&(usize, [f64; 7])> = rows.iter().collect();
    let slowest_first = [3, 2, 1, 0];
    rows.sort_by(|(_, a), (_, b)| {
        let by = |column: usize| a[column].total_cmp(&b[column]);
        slowest_first
            .map(by)
            .into_iter()
            .fold(Ordering::Equal, Ordering::then)
    });
    let same = |a: &[f64; 7], b: &[f64; 7]| a[..4] == b[..4];
    let twice: Vec<String> = rows
        .windows(2)
        .filter(|pair| same(&pair[0].1, &pair[1].1))
        .map(|pair| format!("line {}: the same point as line {}", pair[1].0, pair[0].0))
        .collect();
    if !twice.is_empty() {
        return Err(twice);
    }
    let axis = |column: usize| {
        let mut values: Vec<f64> = rows.iter().map(|(_, row)| row[column]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup();
        values
    };
    let axes = [axis(0), axis(1), axis(2), axis(3)];
    let wanted = axes.iter().map(|a| a.len() as u128).product::<u128>();
    if wanted != rows.len() as u128 {
        let [x, y, z, t] = &axes;
        let point = |i: usize| {
            let (ix, rest) = (i % x.len(), i / x.len());
            let (iy, rest) = (rest % y.len(), rest / y.len());
            [x[ix], y[iy], z[rest % z.len()], t[rest / z.len()]]
        };
        let is_there = |i: &usize| rows.get(*i).is_some_and(|(_, row)| row[..4] == point(*i));
        let missing = (0..=rows.len()).find(|i| !is_there(i)).unwrap_or(0);
        let [px, py, pz, pt] = point(missing);
        return Err(vec![format!(
            "a grid of {} x, {} y, {} z and {} t has {wanted} points, and there are {}; there is none at x {px}, y {py}, z {pz}, t {pt}",
            x.len(),
            y.len(),
            z.len(),
            t.len(),
            rows.len()
        )]);
    }
    let wind = rows
        .iter()
        .map(|(_, row)| DVec3::new(row[4], row[5], row[6]));
    Ok((axes, wind.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(text: &str, outside: Outside, repeat: bool) -> Grid {
        let (axes, wind) = parse(text).expect("a good grid");
        Grid {
            axes,
            wind,
            outside,
            repeat,
        }
    }

    /// A wind that is linear in x, y, z and t on 3 x 2 x 2 x 2 points, shuffled.
    fn linear() -> String {
        let mut lines = Vec::new();
        for t in [0.0, 10.0] {
            for z in [0.0, 4.0] {
                for y in [-1.0, 1.0] {
                    for x in [0.0, 1.0, 5.0] {
                        let (u, v, w) = (x + 2.0 * y, z - t, 0.5 * x);
                        lines.push(format!("{t}, {w}, {x}, {v}, {y}, {u}, {z}"));
                    }
                }
            }
        }
        lines.reverse();
        lines.swap(3, 17);
        format!(
            "\u{feff}# made by hand\n\n t, w, x, v, y, u, z\n{}\n",
            lines.join("\n")
        )
    }

    #[test]
    fn what_is_linear_comes_back_exactly() {
        let grid = grid(&linear(), Outside::Hold, false);
        for (p, t) in [
            (DVec3::new(0.0, -1.0, 0.0), 0.0),
            (DVec3::new(0.3, 0.1, 2.2), 3.0),
            (DVec3::new(4.0, 1.0, 4.0), 10.0),
            (DVec3::new(1.0, 0.9, 1.0), 9.9),
        ] {
            let wanted = DVec3::new(p.x + 2.0 * p.y, p.z - t, 0.5 * p.x);
            let found = grid.at(p, t);
            assert!((found - wanted).length() < 1e-12, "{p} at {t}: {found}");
        }
    }

    #[test]
    fn outside_the_edge_holds_or_there_is_none_and_the_last_time_stays_or_it_repeats() {
        let hold = grid(&linear(), Outside::Hold, false);
        let (far, edge) = (DVec3::new(50.0, 0.0, -9.0), DVec3::new(5.0, 0.0, 0.0));
        assert_eq!(hold.at(far, 5.0), hold.at(edge, 5.0));
        assert_eq!(hold.at(edge, 25.0), hold.at(edge, 10.0));
        let calm = grid(&linear(), Outside::Calm, true);
        assert_eq!(calm.at(far, 5.0), DVec3::ZERO);
        assert_eq!(calm.at(edge, 25.0), hold.at(edge, 5.0));
    }

    #[test]
    fn a_column_left_out_is_a_wind_that_does_not_change_along_it() {
        let grid = grid("z,u,v,w\n0,1,0,0\n10,3,0,0\n", Outside::Calm, false);
        let found = grid.at(DVec3::new(1e3, -1e3, 5.0), 77.0);
        assert!((found.x - 2.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn each_wrong_line_is_named() {
        let faults = |text: &str| parse(text).expect_err("it is wrong").join("\n");
        let header = "x,y,z,t,u,v,w\n";
        assert!(faults("").contains("no header"));
        assert!(faults(header).contains("no points"));
        assert!(faults("x,y,z,t,u,v\n").contains("line 1: the column `w` is missing"));
        assert!(faults("x,y,z,time,u,v,w\n").contains("no column `time`"));
        assert!(faults("x,x,u,v,w\n").contains("two columns are called `x`"));
        let found = faults(&format!(
            "{header}0,0,0,0,1,2\n# well\n0,0,0,0,1,2,fast\n0,0,0,0,1,2,NaN\n"
        ));
        assert!(
            found.contains("line 2: 6 values, where the header has 7 columns"),
            "{found}"
        );
        assert!(found.contains("line 4: `fast` is no number"), "{found}");
        assert!(found.contains("line 5: `NaN` is no number"), "{found}");
        let found = faults(&format!(
            "{header}0,0,0,0,1,2,3\n1,0,0,0,1,2,3\n0,1,0,0,1,2,3\n"
        ));
        assert!(
            found.contains("2 x, 2 y, 1 z and 1 t has 4 points, and there are 3"),
            "{found}"
        );
        assert!(
            found.contains("there is none at x 1, y 1, z 0, t 0"),
            "{found}"
        );
        let found = faults(&format!("{header}0,0,0,0,1,2,3\n0,0,0,0,1,2,4\n"));
        assert!(
            found.contains("line 3: the same point as line 2"),
            "{found}"
        );
    }

    #[test]
    fn a_file_is_looked_for_beside_the_scenario() {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        std::fs::write(folder.join("w.csv"), "u,v,w\n1,2,3\n").expect("a file");
        let site = Site { seed: 0, folder };
        let params = |file: &str| GridParams {
            file: file.into(),
            outside: Outside::Hold,
            repeat: false,
        };
        let grid = Grid::new(&params("w.csv"), &site).expect("it is there");
        assert_eq!(grid.at(DVec3::ZERO, 0.0), DVec3::new(1.0, 2.0, 3.0));
        let missing = Grid::new(&params("none.csv"), &site).expect_err("it is not there");
        assert!(missing.to_string().contains("cannot read"), "{missing}");
        std::fs::write(folder.join("w.csv"), "u,v,w\n1,2\n").expect("a file");
        let wrong = Grid::new(&params("w.csv"), &site).expect_err("it is wrong");
        assert!(wrong.to_string().contains("w.csv: line 2"), "{wrong}");
    }
}
