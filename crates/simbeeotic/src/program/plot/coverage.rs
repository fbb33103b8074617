//! Coverage: what of an area was seen, as a map of cells, or as a share over time.

use super::super::{Failure, remark};
use super::arguments::{BandKind, CoverageKind, CoverageOptions};
use super::axes::{Axis, Panel, nice};
use super::band::{means, times};
use super::flights::Flights;
use super::ground::Ground;
use super::map::{Column, LEGEND, map, north, scale_bar};
use super::palette::{ramp, series};
use super::quantity::Curve;
use super::sheet::{FAINT, HEAD, Ink, Sheet, WHITE};
use super::source::{Source, Sources};
use super::sweep::groups;
use simbeeotic_units::Length;

/// About so many cells in a row, unless their side is said.
const CELLS: f64 = 100.0;
/// No more cells than these.
const CELLS_MAX: f64 = 4e6;
/// The share seen is noted at no more times than these.
const TIMES: usize = 400;

/// An area in cells, from its south-west corner.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Grid {
    /// West and south, m.
    corner_m: [f64; 2],
    cell_m: f64,
    columns: usize,
    rows: usize,
}

/// What became of the cells in one run, from the south-west, row by row.
#[derive(Clone, Debug, Default)]
struct Seen {
    visits: Vec<u32>,
    dwell_s: Vec<f64>,
    /// NaN where nobody was.
    last_s: Vec<f64>,
    /// The share of cells that were seen, over time.
    share: Curve,
}

/// The picture.
pub(super) fn coverage(sources: &Sources, options: &CoverageOptions) -> Result<Sheet, Failure> {
    let mut runs: Vec<(&Source, Flights)> = Vec::new();
    for source in sources.all() {
        let mut flights = Flights::read(source, &options.models)?;
        // Who stays where it is covers nothing, unless it is asked for.
        if options.models.is_empty() && flights.flights.iter().any(|f| !f.is_still()) {
            flights.flights.retain(|flight| !flight.is_still());
        }
        runs.push((source, flights));
    }
    let (grid, reach_m) = grid(&runs, options)?;
    let seen: Vec<Seen> = runs.iter().map(|(_, f)| grid.seen(f, reach_m)).collect();
    let times_ns = runs.iter().map(|(_, flights)| flights.times_ns());
    let first = times_ns.clone().map(|t| t[0]).min().unwrap_or(0);
    let last = times_ns.map(|t| t[1]).max().unwrap_or(0);
    let ends: Vec<f64> = seen.iter().map(Seen::share).collect();
    let share = 100.0 * ends.iter().sum::<f64>() / ends.len() as f64;
    let what = format!(
        "{share:.1} % of {:.6} m² seen{}, cells of {:.4} m, reach {:.4} m",
        Rounded(grid.area_m2()),
        if seen.len() > 1 { " in the mean" } else { "" },
        Rounded(grid.cell_m),
        Rounded(reach_m)
    );
    let [width, height] = options.plot.size();
    let title = match options.over_time {
        true => "Coverage over time",
        false => "Coverage",
    };
    let caption = sources.caption(first, last, &what);
    let mut sheet = Sheet::titled(width, height, options.plot.title(title), &caption);
    match options.over_time {
        true => over_time(&mut sheet, sources, &seen, options)?,
        false => {
            let stage = sources.first().stage()?;
            let ground = stage.map(|stage| Ground::of(&stage, &[]));
            cells(&mut sheet, &grid, &seen, options.show, ground.as_ref());
        }
    }
    Ok(sheet)
}

/// A number without digits that say nothing.
struct Rounded(f64);

impl std::fmt::Display for Rounded {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let decimals = f.precision().unwrap_or(3);
        let whole = self.0.abs().max(1.0).to_string();
        let digits = whole.find('.').unwrap_or(whole.len());
        let text = format!("{:.*}", decimals.saturating_sub(digits), self.0);
        match text.contains('.') {
            true => f.write_str(text.trim_end_matches('0').trim_end_matches('.')),
            false => f.write_str(&text),
        }
    }
}

fn length(option: &str, text: &str) -> Result<f64, Failure> {
    let length: Length = text
        .parse()
        .map_err(|error| Failure::input(format!("{option}: {error}")))?;
    match length.metres() {
        metres if metres > 0.0 && metres.is_finite() => Ok(metres),
        _ => Err(Failure::input(format!(
            "{option} {length}: it must be more than zero"
        ))),
    }
}

/// The cells, and how far a vehicle sees, m.
fn grid(runs: &[(&Source, Flights)], options: &CoverageOptions) -> Result<(Grid, f64), Failure> {
    let spans = |k: usize| {
        let spans = runs.iter().filter_map(|(_, flights)| flights.span(k));
        spans.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    };
    let cell = (options.cell.as_deref()).map(|text| length("--cell", text));
    let reach = (options.reach.as_deref()).map(|text| length("--reach", text));
    let (cell, reach) = (cell.transpose()?, reach.transpose()?);
    let [west, south, east, north] = match &options.area {
        Some(text) => area(text)?,
        None => {
            let Some(([west, east], [south, north])) = spans(0).zip(spans(1)) else {
                return Err(runs[0].0.nothing(false, "positions", "all of them are NaN"));
            };
            let around = reach.or(cell).unwrap_or(0.0).max(1e-3);
            [west - around, south - around, east + around, north + around]
        }
    };
    let (wide, tall) = (east - west, north - south);
    let cell_m = cell.unwrap_or_else(|| nice(wide.max(tall) / CELLS));
    let (columns, rows) = ((wide / cell_m - 1e-9).ceil(), (tall / cell_m - 1e-9).ceil());
    if columns * rows > CELLS_MAX {
        return Err(Failure::input(format!(
            "--cell {cell_m} m: {columns} x {rows} cells are too many for an area of {wide:.1} x {tall:.1} m; \
             take larger ones, or a smaller --area"
        )));
    }
    let grid = Grid {
        corner_m: [west, south],
        cell_m,
        columns: (columns as usize).max(1),
        rows: (rows as usize).max(1),
    };
    Ok((grid, reach.unwrap_or(0.5 * cell_m)))
}

fn area(text: &str) -> Result<[f64; 4], Failure> {
    let numbers: Vec<Option<f64>> = text.split(',').map(|x| x.trim().parse().ok()).collect();
    match numbers[..] {
        [Some(west), Some(south), Some(east), Some(north)]
            if west < east && south < north && (north - south + east - west).is_finite() =>
        {
            Ok([west, south, east, north])
        }
        _ => Err(Failure::input(format!(
            "--area {text}: it is west,south,east,north in metres: --area=-20,-20,20,20"
        ))),
    }
}

impl Grid {
    fn area_m2(&self) -> f64 {
        (self.columns * self.rows) as f64 * self.cell_m * self.cell_m
    }

    fn edges_m(&self) -> [f64; 4] {
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
    fn seen(&self, flights: &Flights, reach_m: f64) -> Seen {
        let count = self.columns * self.rows;
        let mut seen = Seen {
            visits: vec![0; count],
            dwell_s: vec![0.0; count],
            last_s: vec![f64::NAN; count],
            share: Curve::default(),
        };
        // Of each cell the time at which it was first seen.
        let mut first_s = vec![f64::INFINITY; count];
        for flight in &flights.flights {
            let points: Vec<_> = (flight.known())
                .map(|(at, [x, y, _])| (flights.times_s[at], [x, y]))
                .collect();
            // Until when this one has been in a cell.
            let mut until_s = vec![f64::NEG_INFINITY; count];
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
                        if from_s > until_s[cell] + 1e-9 {
                            seen.visits[cell] += 1;
                        }
                        until_s[cell] = to_s;
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
    fn share(&self) -> f64 {
        let seen = self.visits.iter().filter(|n| **n > 0).count();
        seen as f64 / self.visits.len().max(1) as f64
    }
}

/// The map.
fn cells(
    sheet: &mut Sheet,
    grid: &Grid,
    seen: &[Seen],
    kind: CoverageKind,
    ground: Option<&Ground>,
) {
    let [west, south, east, north_m] = grid.edges_m();
    let panel = map(sheet, [west, south, east, north_m]);
    panel.draw(sheet, true);
    if let Some(ground) = ground {
        ground.outlines(sheet, &panel);
    }
    let runs = seen.len() as f64;
    let value = |cell: usize| -> f64 {
        let each = seen.iter();
        match kind {
            CoverageKind::Visits => each.map(|run| f64::from(run.visits[cell])).sum::<f64>() / runs,
            CoverageKind::Dwell => each.map(|run| run.dwell_s[cell]).sum::<f64>() / runs,
            CoverageKind::Last => each.map(|run| run.last_s[cell]).fold(f64::NAN, f64::max),
        }
    };
    let visited = |cell: usize| seen.iter().any(|run| run.visits[cell] > 0);
    let count = grid.columns * grid.rows;
    let values: Vec<f64> = (0..count)
        .map(|c| if visited(c) { value(c) } else { f64::NAN })
        .collect();
    let mut known: Vec<f64> = values.iter().copied().filter(|v| v.is_finite()).collect();
    known.sort_by(f64::total_cmp);
    // One cell that all rest in must not take the colours from the others.
    let top = match kind {
        CoverageKind::Last => known.last().copied().unwrap_or(1.0),
        _ => super::band::quantile(&known, 0.99),
    };
    let top = if top > 0.0 { top } else { 1.0 };
    let low = match kind {
        CoverageKind::Last => known.first().copied().unwrap_or(0.0).min(top),
        _ => 0.0,
    };
    let span = if top > low { top - low } else { 1.0 };
    let mut inks: Vec<Ink> = Vec::with_capacity(count);
    for row in (0..grid.rows).rev() {
        for column in 0..grid.columns {
            inks.push(match values[row * grid.columns + column] {
                value if value.is_finite() => ramp((value - low) / span).thin(0.88),
                _ => WHITE.thin(0.0),
            });
        }
    }
    let ([left, bottom], [right, top_y]) = (panel.place(west, south), panel.place(east, north_m));
    sheet.cells([left, top_y, right, bottom], grid.columns as u32, inks);
    let frame = [
        [left, bottom],
        [right, bottom],
        [right, top_y],
        [left, top_y],
        [left, bottom],
    ];
    sheet.dashed(frame.to_vec(), FAINT, 1.0, [6.0, 4.0]);
    if let Some(ground) = ground {
        ground.rims(sheet, &panel);
        ground.marks(sheet, &panel);
    }
    north(sheet, &panel);
    scale_bar(sheet, &panel);
    let mut column = Column::beside(&panel);
    let label = match (kind, seen.len()) {
        (CoverageKind::Visits, 1) => "visits",
        (CoverageKind::Visits, _) => "visits in each run",
        (CoverageKind::Dwell, 1) => "stay of all, s",
        (CoverageKind::Dwell, _) => "stay in each run, s",
        (CoverageKind::Last, _) => "last seen, s",
    };
    column.colours(sheet, label, [low, low + span], ramp);
    if kind != CoverageKind::Last && known.last().is_some_and(|most| *most > 1.001 * top) {
        column.note(sheet, &["1 % of the cells have", "more than that."]);
        column.gap();
    }
    column.mark(sheet, "never seen", |sheet, [x, y]| {
        let ring = [
            [x - 7.0, y - 6.0],
            [x + 7.0, y - 6.0],
            [x + 7.0, y + 6.0],
            [x - 7.0, y + 6.0],
            [x - 7.0, y - 6.0],
        ];
        sheet.line(ring.to_vec(), FAINT, 1.0);
    });
}

/// The share seen over time; of several runs their mean, and where it is with 95 % confidence.
fn over_time(
    sheet: &mut Sheet,
    sources: &Sources,
    seen: &[Seen],
    options: &CoverageOptions,
) -> Result<(), Failure> {
    let groups = groups(sources, options.by.as_deref())?;
    if options.by.is_some() && sources.all().len() == 1 {
        remark("note: --by sets several recordings apart, and there is one");
    }
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let all = times(seen.iter().map(|run| &run.share));
    let ends = [all.first(), all.last()].map(|t| t.copied().unwrap_or(0.0));
    let legend = if groups.len() > 1 { LEGEND } else { 8.0 };
    let panel = Panel {
        edges: [96.0, HEAD + 10.0, width - legend - 24.0, height - 62.0],
        x: Axis::exact("time, s", ends[0], ends[1], 9.0),
        y: Axis::exact("seen, % of the area", 0.0, 100.0, 5.0),
    };
    panel.draw(sheet, true);
    let mut column = Column::beside(&panel);
    for (place, group) in groups.iter().enumerate() {
        let curves: Vec<Curve> = (sources.all().iter().zip(seen))
            .filter(|(source, _)| group.runs.iter().any(|run| std::ptr::eq(*run, *source)))
            .map(|(_, seen)| seen.share.clone())
            .collect();
        let ink = series(place);
        let means = means(&curves, &times(curves.iter()), BandKind::Confidence);
        let edge = |end: usize| {
            let known = means.iter().filter_map(|m| Some((m.time_s, m.band?[end])));
            known
                .map(|(t, share)| panel.place(t, (100.0 * share).clamp(0.0, 100.0)))
                .collect::<Vec<_>>()
        };
        let (low, mut high) = (edge(0), edge(1));
        if low.len() >= 2 {
            high.reverse();
            sheet.area([low, high].concat(), ink.thin(0.2));
        }
        let line = means.iter().map(|m| panel.place(m.time_s, 100.0 * m.mean));
        let line: Vec<_> = line.collect();
        match line.as_slice() {
            [one] => sheet.disc(*one, 4.0, ink, 0.0),
            _ => sheet.line(line, ink, 2.2),
        }
        if groups.len() > 1 {
            let name = format!("{} ({})", group.name, curves.len());
            column.line(sheet, ink, 2.4, &name);
        }
    }
    Ok(())
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
    fn numbers_in_captions_are_short() {
        let text = |x: f64| format!("{:.4}", Rounded(x));
        assert_eq!(
            [0.5, 2.0, 1234.56, 0.1234].map(text),
            ["0.5", "2", "1235", "0.123"]
        );
    }
}
