//! A map of cells: one of several, of one scale and with the same colours.

use super::arguments::{CoverageKind, CoverageOptions};
use super::axes::Panel;
use super::band::{half_width, mean, quantile, units};
use super::coverage::Run;
use super::grid::Grid;
use super::ground::Ground;
use super::map::{Column, axes, heading, maps, north, scale_bar};
use super::palette::ramp;
use super::sheet::{FAINT, Ink, Sheet, WHITE};
use super::stats::wilson_of_share;
use simbeeotic_record::Stage;

/// What is drawn of some runs.
pub(super) struct Cells {
    name: String,
    runs: usize,
    /// Of each cell; NaN where nobody was.
    means: Vec<f64>,
    /// Half of the 95 % interval, if it is asked for; NaN where it is not known.
    halves: Option<Vec<f64>>,
    ground: Option<Ground>,
}

impl Cells {
    pub(super) fn of(
        name: &str,
        runs: &[&Run],
        stage: Option<Stage>,
        options: &CoverageOptions,
    ) -> Self {
        let count = runs.first().map_or(0, |run| run.cells.len());
        let both = (0..count).map(|cell| estimate(runs, cell, options.show));
        let (means, halves): (Vec<f64>, Vec<f64>) = both.unzip();
        Self {
            name: name.to_owned(),
            runs: runs.len(),
            means,
            halves: options.confidence.then_some(halves),
            ground: stage.map(|stage| Ground::of(&stage, &[])),
        }
    }
}

/// The mean of a cell over runs, and half of its 95 % interval. Both are of seeds: see [`units`].
fn estimate(runs: &[&Run], cell: usize, kind: CoverageKind) -> (f64, f64) {
    let mine = runs
        .iter()
        .map(|run| (run.seed, f64::from(run.cells[cell])));
    let known = mine.clone().filter(|(_, value)| value.is_finite()).count();
    if known == 0 {
        return (f64::NAN, f64::NAN);
    }
    let values: Vec<(Option<u64>, f64)> = match kind {
        // Who was never there has no last time.
        CoverageKind::Last => mine.filter(|(_, value)| value.is_finite()).collect(),
        CoverageKind::Runs => mine
            .map(|(seed, v)| (seed, f64::from(v.is_finite())))
            .collect(),
        _ => mine
            .map(|(seed, v)| (seed, if v.is_finite() { v } else { 0.0 }))
            .collect(),
    };
    let units = units(&values);
    let middle = mean(&units).unwrap_or(f64::NAN);
    if kind == CoverageKind::Runs {
        let [low, high] = wilson_of_share(middle, units.len() as f64);
        return (100.0 * middle, 50.0 * (high - low));
    }
    (middle, half_width(&units).unwrap_or(f64::NAN))
}

/// From which value to which the colours go, and whether some lie above.
#[derive(Clone, Copy, Debug)]
struct Range {
    low: f64,
    high: f64,
    more: bool,
}

impl Range {
    fn of(values: impl Iterator<Item = f64>, from_zero: bool) -> Self {
        let mut known: Vec<f64> = values.filter(|value| value.is_finite()).collect();
        known.sort_by(f64::total_cmp);
        let most = known.last().copied().unwrap_or(1.0);
        // One cell that all rest in must not take the colours from the others.
        let high = match from_zero {
            true => quantile(&known, 0.99),
            false => most,
        };
        let high = if high > 0.0 { high } else { 1.0 };
        let low = match from_zero {
            true => 0.0,
            false => known.first().copied().unwrap_or(0.0).min(high),
        };
        Self {
            low,
            high: if high > low { high } else { low + 1.0 },
            more: most > 1.001 * high,
        }
    }

    fn share(self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }
}

/// The maps.
pub(super) fn cells(sheet: &mut Sheet, grid: &Grid, all: &[Cells], options: &CoverageOptions) {
    let show = options.show;
    let range = match show {
        CoverageKind::Runs => Range {
            low: 0.0,
            high: 100.0,
            more: false,
        },
        _ => Range::of(
            all.iter().flat_map(|c| c.means.iter().copied()),
            show != CoverageKind::Last,
        ),
    };
    let halves = all.iter().filter_map(|cells| cells.halves.as_ref());
    let unsure = Range::of(halves.flatten().copied(), true);
    let each = if options.confidence { 2 } else { 1 };
    let panels = maps(sheet, grid.edges_m(), each * all.len());
    for (at, panel) in panels.iter().enumerate() {
        let cells = &all[at / each];
        let (values, range) = match &cells.halves {
            Some(halves) if at % each == 1 => (halves, unsure),
            _ => (&cells.means, range),
        };
        axes(sheet, &panels, at);
        one(sheet, panel, grid, values, range, cells.ground.as_ref());
        if panels.len() > 1 {
            let what = match (each, at % each) {
                (1, _) => "",
                (_, 0) => "mean",
                _ => "\u{b1}, with 95 % confidence",
            };
            let parts = [cells.name.as_str(), what];
            let parts: Vec<&str> = parts.into_iter().filter(|part| !part.is_empty()).collect();
            heading(sheet, panel, &parts.join(": "));
        }
    }
    north(sheet, &panels[0]);
    if let [panel] = panels.as_slice() {
        scale_bar(sheet, panel);
    }
    let several = all.iter().any(|cells| cells.runs > 1);
    let label = match (show, several) {
        (CoverageKind::Visits, false) => "visits",
        (CoverageKind::Visits, true) => "visits in each run",
        (CoverageKind::Dwell, false) => "stay of all, s",
        (CoverageKind::Dwell, true) => "stay in each run, s",
        (CoverageKind::Last, false) => "last seen, s",
        (CoverageKind::Last, true) => "last seen, mean, s",
        (CoverageKind::Runs, _) => "seen in runs, %",
    };
    let [_, top, ..] = panels[0].edges;
    let mut column = Column::at(
        f64::from(sheet.width),
        top + 12.0,
        f64::from(sheet.height) - 60.0,
    );
    let whole = show == CoverageKind::Visits && !several;
    bar(
        sheet,
        &mut column,
        label,
        range,
        if whole { 1.0 } else { 0.0 },
    );
    if options.confidence {
        bar(
            sheet,
            &mut column,
            "\u{b1}, with 95 % confidence",
            unsure,
            0.0,
        );
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

fn bar(sheet: &mut Sheet, column: &mut Column, label: &str, range: Range, step: f64) {
    column.colours_in_steps(sheet, label, [range.low, range.high], step, ramp);
    if range.more {
        column.note(sheet, &["1 % of the cells have", "more than that."]);
        column.gap();
    }
}

/// One map.
fn one(
    sheet: &mut Sheet,
    panel: &Panel,
    grid: &Grid,
    values: &[f64],
    range: Range,
    ground: Option<&Ground>,
) {
    if let Some(ground) = ground {
        ground.outlines(sheet, panel);
    }
    let mut inks: Vec<Ink> = Vec::with_capacity(values.len());
    for row in (0..grid.rows).rev() {
        for value in &values[row * grid.columns..(row + 1) * grid.columns] {
            inks.push(match value.is_finite() {
                true => ramp(range.share(*value)).thin(0.88),
                false => WHITE.thin(0.0),
            });
        }
    }
    let [west, south, east, north] = grid.edges_m();
    let ([left, bottom], [right, top]) = (panel.place(west, south), panel.place(east, north));
    sheet.cells([left, top, right, bottom], grid.columns as u32, inks);
    let frame = [
        [left, bottom],
        [right, bottom],
        [right, top],
        [left, top],
        [left, bottom],
    ];
    sheet.dashed(frame.to_vec(), FAINT, 1.0, [6.0, 4.0]);
    if let Some(ground) = ground {
        ground.rims(sheet, panel);
        ground.marks(sheet, panel);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(seed: u64, value: f32) -> Run {
        Run::of_one_cell(seed, value)
    }

    #[test]
    fn a_run_that_never_saw_a_cell_counts_as_none() {
        let runs = [run(1, 4.0), run(2, 8.0), run(3, f32::NAN)];
        let runs: Vec<&Run> = runs.iter().collect();
        // 4, 8 and 0: mean 4, deviation 4, t(2) = 4.3027.
        let (middle, half) = estimate(&runs, 0, CoverageKind::Visits);
        assert_eq!(middle, 4.0);
        assert!(
            (half - 4.3027 * 4.0 / 3.0_f64.sqrt()).abs() < 1e-3,
            "{half}"
        );
        let (share, half) = estimate(&runs, 0, CoverageKind::Runs);
        assert!(
            (share - 200.0 / 3.0).abs() < 1e-9 && half > 20.0,
            "{share} {half}"
        );
        assert_eq!(
            estimate(&runs, 0, CoverageKind::Last).0,
            6.0,
            "only of those that saw it"
        );
        let (none, half) = estimate(&runs[2..], 0, CoverageKind::Dwell);
        assert!(none.is_nan() && half.is_nan());
    }

    #[test]
    fn runs_of_one_seed_are_no_surer_of_a_cell_than_one_of_them() {
        let once = [run(1, 1.0), run(2, f32::NAN)];
        let once: Vec<&Run> = once.iter().collect();
        let often: Vec<&Run> = once.iter().copied().cycle().take(20).collect();
        let estimate = |runs| estimate(runs, 0, CoverageKind::Runs);
        assert_eq!(estimate(&often), estimate(&once));
        // Of one seed its runs are all there is.
        let (share, half) = estimate(&[once[0]; 20]);
        let [low, high] = super::super::stats::wilson(20, 20);
        assert_eq!((share, half), (100.0, 50.0 * (high - low)));
    }

    #[test]
    fn colours_leave_the_top_hundredth_out() {
        let values = (0..1000).map(|n| if n == 999 { 1e6 } else { f64::from(n) });
        let range = Range::of(values, true);
        assert!(
            range.more && range.high < 1000.0 && range.low == 0.0,
            "{range:?}"
        );
        let none = Range::of([f64::NAN].into_iter(), true);
        assert!(none.high > none.low);
    }
}
