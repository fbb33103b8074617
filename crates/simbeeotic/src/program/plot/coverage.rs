//! Coverage: what of an area was seen, as a map of cells, or as a share over time.

use super::super::Failure;
use super::arguments::{BandKind, CoverageKind, CoverageOptions};
use super::axes::{Axis, Panel, nice};
use super::band::{half_width, mean, means, of_seeds, times, units};
use super::cells::{Cells, cells};
use super::flights::Flights;
use super::grid::{Grid, Seen};
use super::map::Column;
use super::palette::{dashes, series};
use super::quantity::{Curve, without};
use super::sheet::{HEAD, Sheet};
use super::source::{Source, Sources};
use super::sweep::{Group, map_groups};
use simbeeotic_units::Length;

/// About so many cells in a row, unless their side is said.
const CELLS: f64 = 100.0;
/// Of more groups the shares have no room below the title.
const SHARES_SAID: usize = 4;

/// What a run came to.
pub(super) struct Run {
    pub(super) seed: Option<u64>,
    /// What is shown of each cell; NaN where nobody was.
    pub(super) cells: Vec<f32>,
    /// The share of the area that was seen, over time and at the end.
    share: Curve,
    end: f64,
}

#[cfg(test)]
impl Run {
    /// A run with one cell, for tests.
    pub(super) fn of_one_cell(seed: u64, value: f32) -> Self {
        Self {
            seed: Some(seed),
            cells: vec![value],
            share: Curve::default(),
            end: 0.0,
        }
    }
}

/// The picture.
pub(super) fn coverage(sources: &Sources, options: &CoverageOptions) -> Result<Sheet, Failure> {
    let groups = map_groups(sources, options.by.as_deref())?;
    let mut left_out = Vec::new();
    let mut read = |source: &Source| -> Result<Flights, Failure> {
        let mut flights = Flights::read(source, &options.models)?;
        if options.models.is_empty() {
            for path in flights.vehicles_only() {
                if !left_out.contains(&path) {
                    left_out.push(path);
                }
            }
        }
        Ok(flights)
    };
    // Of many runs the flights would not fit into memory: they are read once for the area, once for the cells.
    let mut only = match sources.all() {
        [one] => Some(read(one)?),
        _ => None,
    };
    let mut bounds: Option<[f64; 4]> = None;
    if options.area.is_none() {
        for source in sources.all() {
            let again;
            let flights = match &only {
                Some(flights) => flights,
                None => {
                    again = read(source)?;
                    &again
                }
            };
            let Some(([west, east], [south, north])) = flights.span(0).zip(flights.span(1)) else {
                return Err(source.nothing(false, "positions", "all of them are NaN"));
            };
            let own = [west, south, east, north];
            bounds = Some(bounds.map_or(own, |b| {
                [
                    b[0].min(own[0]),
                    b[1].min(own[1]),
                    b[2].max(own[2]),
                    b[3].max(own[3]),
                ]
            }));
        }
    }
    let (grid, reach_m) = grid(bounds, options)?;
    let (mut first, mut last) = (u64::MAX, 0);
    let mut runs = Vec::new();
    for source in sources.all() {
        let flights = match only.take() {
            Some(flights) => flights,
            None => read(source)?,
        };
        let [begin, end] = flights.times_ns();
        (first, last) = (first.min(begin), last.max(end));
        let seen = grid.seen(&flights, reach_m);
        runs.push(Run {
            seed: source.recording.seed(),
            end: seen.share(),
            cells: shown(&seen, options.show),
            share: seen.share,
        });
    }
    let seen: Vec<_> = (groups.iter())
        .map(|group| {
            let mine = group.places.iter().map(|at| &runs[*at]);
            (group.name.as_str(), mine.collect())
        })
        .collect();
    let what = said(&seen, &grid, reach_m) + &without(&left_out);
    let [width, height] = options.plot.size();
    let title = match options.over_time {
        true => "Coverage over time",
        false => "Coverage",
    };
    let caption = sources.caption(first, last, &what);
    let mut sheet = Sheet::titled(width, height, options.plot.title(title), &caption);
    match options.over_time {
        true => over_time(&mut sheet, &groups, &runs),
        false => maps_of(&mut sheet, &grid, &groups, &runs, options)?,
    }
    Ok(sheet)
}

/// What is shown of each cell of a run.
fn shown(seen: &Seen, kind: CoverageKind) -> Vec<f32> {
    let visits = seen.visits.iter();
    let value = |(cell, visits): (usize, &u32)| match kind {
        _ if *visits == 0 => f32::NAN,
        CoverageKind::Visits => *visits as f32,
        CoverageKind::Dwell => seen.dwell_s[cell] as f32,
        CoverageKind::Last => seen.last_s[cell] as f32,
        CoverageKind::Runs => 1.0,
    };
    visits.enumerate().map(value).collect()
}

/// How much of the area was seen, by each group if they are few, and of what cells that is.
fn said(groups: &[(&str, Vec<&Run>)], grid: &Grid, reach_m: f64) -> String {
    let share = |(name, runs): &(&str, Vec<&Run>)| {
        let ends: Vec<_> = runs.iter().map(|run| (run.seed, 100.0 * run.end)).collect();
        let ends = units(&ends);
        let spread = match half_width(&ends) {
            Some(half) => format!(" \u{b1} {half:.1}"),
            None => String::new(),
        };
        let share = format!("{:.1}{spread} %", mean(&ends).unwrap_or(0.0));
        match groups.len() {
            1 => share,
            _ => format!("{name}: {share}"),
        }
    };
    let area = format!("{:.6} m\u{b2}", Rounded(grid.area_m2()));
    let several = groups.iter().any(|(_, runs)| runs.len() > 1);
    let seen = match groups.len() {
        1..=SHARES_SAID => {
            let shares: Vec<String> = groups.iter().map(share).collect();
            let of_mean = if several { " in the mean" } else { "" };
            format!("{} of {area} seen{of_mean}", shares.join(", "))
        }
        _ => area,
    };
    format!(
        "{seen}, cells of {:.4} m, reach {:.4} m",
        Rounded(grid.cell_m),
        Rounded(reach_m)
    )
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
fn grid(flown: Option<[f64; 4]>, options: &CoverageOptions) -> Result<(Grid, f64), Failure> {
    let cell = (options.cell.as_deref()).map(|text| length("--cell", text));
    let reach = (options.reach.as_deref()).map(|text| length("--reach", text));
    let (cell, reach) = (cell.transpose()?, reach.transpose()?);
    let bounds = match (&options.area, flown) {
        (Some(text), _) => area(text)?,
        (None, flown) => {
            let [west, south, east, north] = flown.unwrap_or_default();
            let around = reach.or(cell).unwrap_or(0.0).max(1e-3);
            [west - around, south - around, east + around, north + around]
        }
    };
    let [west, south, east, north] = bounds;
    let cell_m = cell.unwrap_or_else(|| nice((east - west).max(north - south) / CELLS));
    let grid = Grid::over(bounds, cell_m)?;
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

/// A map for each group; beside each where its mean is not sure, if that is asked for.
fn maps_of(
    sheet: &mut Sheet,
    grid: &Grid,
    groups: &[Group],
    runs: &[Run],
    options: &CoverageOptions,
) -> Result<(), Failure> {
    let mut all = Vec::new();
    for group in groups {
        let (stage, _) = Source::common_stage(&group.runs)?;
        let mine: Vec<&Run> = group.places.iter().map(|at| &runs[*at]).collect();
        if options.confidence && mine.len() < 2 {
            return Err(Failure::input(format!(
                "--confidence: of one run alone{} nothing is known of it; give more recordings",
                match group.name.as_str() {
                    "" => String::new(),
                    name => format!(" ({name})"),
                }
            )));
        }
        all.push(Cells::of(&group.name, &mine, stage, options));
    }
    cells(sheet, grid, &all, options);
    Ok(())
}

/// The share seen over time; of several runs their mean, and where it is with 95 % confidence.
fn over_time(sheet: &mut Sheet, groups: &[Group], runs: &[Run]) {
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let all = times(runs.iter().map(|run| &run.share));
    let ends = [all.first(), all.last()].map(|t| t.copied().unwrap_or(0.0));
    let legend = match groups.len() {
        1 => 8.0,
        _ => sheet.key_room(),
    };
    let lines: Vec<_> = (groups.iter())
        .map(|group| {
            let mine = group.places.iter().map(|at| &runs[*at]);
            let curves = mine.map(|run| (run.seed, run.share.clone())).collect();
            let curves = of_seeds(curves);
            means(&curves, &times(curves.iter()), BandKind::Confidence)
        })
        .collect();
    let tops = (lines.iter().flatten()).map(|m| m.band.map_or(m.mean, |[_, high]| high));
    let top = 100.0 * tops.fold(0.01, f64::max).min(1.0);
    let panel = Panel {
        edges: [96.0, HEAD + 10.0, width - legend - 24.0, height - 62.0],
        x: Axis::exact("time, s", ends[0], ends[1], 9.0),
        y: Axis::stretched("seen, % of the area", 0.0, top, 5.0),
    };
    panel.draw(sheet, true);
    let mut column = Column::beside(&panel);
    for (place, (group, means)) in groups.iter().zip(&lines).enumerate() {
        let ink = series(place);
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
            _ => sheet.line_with(line, ink, 2.2, dashes(place)),
        }
        if groups.len() > 1 {
            let name = match group.runs.len() {
                1 => group.name.clone(),
                n => format!("{} ({n})", group.name),
            };
            column.line_with(sheet, ink, 2.4, dashes(place), &name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_group_says_how_much_it_saw() {
        let run = |seed: u64, end: f64| Run {
            end,
            ..Run::of_one_cell(seed, 1.0)
        };
        let runs = [run(1, 0.42), run(2, 0.44), run(1, 0.76), run(2, 0.78)];
        let grid = Grid::over([0.0, 0.0, 20.0, 20.0], 1.0)
            .ok()
            .expect("a grid");
        let few = ("n = 10", vec![&runs[0], &runs[1]]);
        let many = ("n = 40", vec![&runs[2], &runs[3]]);
        let cells = "cells of 1 m, reach 0.5 m";
        // s = 1.414, t(1) = 12.706, over the root of two.
        assert_eq!(
            said(&[few.clone(), many.clone()], &grid, 0.5),
            format!(
                "n = 10: 43.0 \u{b1} 12.7 %, n = 40: 77.0 \u{b1} 12.7 % of 400 m\u{b2} seen in the mean, {cells}"
            )
        );
        assert_eq!(
            said(&[("", vec![&runs[0]])], &grid, 0.5),
            format!("42.0 % of 400 m\u{b2} seen, {cells}")
        );
        let lots = vec![few; SHARES_SAID + 1];
        assert_eq!(said(&lots, &grid, 0.5), format!("400 m\u{b2}, {cells}"));
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
