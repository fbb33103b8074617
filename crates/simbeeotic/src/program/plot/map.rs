//! What maps from above have in common: one scale in both directions, a bar of it, where north is, names that
//! keep out of each other's way, and the columns at the right.

use super::axes::{Axis, Panel, nice, number};
use super::column::{Bar, Entry, NARROW};
use super::sheet::{Anchor, FAINT, HEAD, Ink, NORMAL, SMALL, Sheet, TEXT};
use simbeeotic_view::render::words;

/// The width of the column at the right.
pub(super) const LEGEND: f64 = 196.0;
/// How much wider a map is than what is on it.
const MARGIN: f64 = 1.12;

/// More maps beside each other are too small to be read.
pub(super) const MAPS_MAX: usize = 16;
/// Between two maps, and above each of several for its name, pixels.
const GAP: f64 = 16.0;
const NAME: f64 = 24.0;

/// A panel of one scale in both directions that shows all between the bounds: west, south, east, north, m.
pub(super) fn map(sheet: &Sheet, bounds: [f64; 4]) -> Panel {
    panel(room(sheet), bounds)
}

/// Several of them of one scale and with the same bounds, row by row, in as many columns as make them largest.
pub(super) fn maps(sheet: &Sheet, bounds: [f64; 4], count: usize) -> Vec<Panel> {
    if count < 2 {
        return vec![map(sheet, bounds)];
    }
    let [left, top, right, bottom] = room(sheet);
    let size = |columns: usize| {
        let rows = count.div_ceil(columns);
        let along = |long: f64, parts: usize| (long + GAP) / parts as f64 - GAP;
        [
            along(right - left, columns),
            along(bottom - top, rows) - NAME,
        ]
    };
    let scale = |columns: usize| {
        let [wide, tall] = size(columns);
        let [west, south, east, north] = bounds;
        (wide / (east - west).max(1e-9)).min(tall / (north - south).max(1e-9))
    };
    let best = (1..=count).max_by(|a, b| scale(*a).total_cmp(&scale(*b)));
    let columns = best.unwrap_or(1);
    let [wide, tall] = size(columns);
    (0..count)
        .map(|at| {
            let left = left + (at % columns) as f64 * (wide + GAP);
            let top = top + (at / columns) as f64 * (tall + NAME + GAP) + NAME;
            panel([left, top, left + wide, top + tall], bounds)
        })
        .collect()
}

/// Draws the axes of one of several maps, with numbers and names where no other map is below it or left of it.
pub(super) fn axes(sheet: &mut Sheet, panels: &[Panel], at: usize) {
    let mine = panels[at].edges;
    let below = |other: &Panel| other.edges[1] > mine[3] && other.edges[0] == mine[0];
    let lowest = !panels.iter().any(below);
    let leftmost = panels.iter().all(|other| other.edges[0] >= mine[0]);
    panels[at].draw_with(sheet, [leftmost, lowest]);
}

/// The name of one of several maps, above it.
pub(super) fn heading(sheet: &mut Sheet, panel: &Panel, name: &str) {
    let [left, top, right, _] = panel.edges;
    let size = (NORMAL * (right - left) / words::width(name, NORMAL).max(1.0)).clamp(9.0, SMALL);
    sheet.words([left, top - 7.0], name, size, Anchor::Start, TEXT);
}

/// Where maps go: left, top, right, bottom.
fn room(sheet: &Sheet) -> [f64; 4] {
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    [
        96.0,
        HEAD + 8.0,
        width - sheet.key_room() - 20.0,
        height - 62.0,
    ]
}

/// A panel in edges, with one scale in both directions, that shows all between the bounds.
fn panel(edges: [f64; 4], [west, south, east, north]: [f64; 4]) -> Panel {
    let (wide, tall) = (edges[2] - edges[0], edges[3] - edges[1]);
    let metre = (MARGIN * (east - west) / wide).max(MARGIN * (north - south) / tall);
    let metre = if metre > 0.0 && metre.is_finite() {
        metre
    } else {
        1.0 / wide
    };
    let axis = |label: &str, low: f64, high: f64, pixels: f64| {
        let (middle, half) = (0.5 * (low + high), 0.5 * pixels * metre);
        let middle = if middle.is_finite() { middle } else { 0.0 };
        Axis::exact(
            label,
            middle - half,
            middle + half,
            (pixels / 90.0).max(4.0),
        )
    };
    let mut panel = Panel {
        edges,
        x: axis("east, m", west, east, wide),
        y: axis("north, m", south, north, tall),
    };
    let (fine, coarse) = (
        panel.x.step.min(panel.y.step),
        panel.x.step.max(panel.y.step),
    );
    let few = |axis: &Axis| axis.high - axis.low < 2.5 * coarse;
    let step = if few(&panel.x) || few(&panel.y) {
        fine
    } else {
        coarse
    };
    (panel.x.step, panel.y.step) = (step, step);
    panel
}

/// How many pixels a metre has on a map.
pub(super) fn pixels_each_m(panel: &Panel) -> f64 {
    let [left, _, right, _] = panel.edges;
    (right - left) / (panel.x.high - panel.x.low)
}

/// A length of 1, 2 or 5 times a power of ten, below the map at the right.
pub(super) fn scale_bar(sheet: &mut Sheet, panel: &Panel) {
    let [left, _, right, bottom] = panel.edges;
    let metre = pixels_each_m(panel);
    let length_m = nice(0.09 * (right - left) / metre);
    let (end, y) = (right, bottom + 46.0);
    let start = end - length_m * metre;
    let bar = vec![[start, y - 5.0], [start, y], [end, y], [end, y - 5.0]];
    sheet.line(bar, TEXT, 1.6);
    let text = format!("{} m", number(length_m, length_m));
    sheet.words([start - 8.0, y], text, SMALL, Anchor::End, TEXT);
}

/// An arrow that points north, in the upper right corner of the map.
pub(super) fn north(sheet: &mut Sheet, panel: &Panel) {
    let [_, top, right, _] = panel.edges;
    let (x, y) = (right - 20.0, top + 12.0);
    sheet.area(
        vec![
            [x, y],
            [x + 6.0, y + 22.0],
            [x, y + 17.0],
            [x - 6.0, y + 22.0],
        ],
        TEXT,
    );
    sheet.words_apart([x, y + 37.0], "N", SMALL, Anchor::Middle);
}

/// Names on a map, each where it hides least.
pub(super) struct Names {
    frame: [f64; 4],
    taken: Vec<[f64; 4]>,
}

impl Names {
    /// In a frame (left, top, right, bottom), with discs that must not be hidden.
    pub(super) fn around(frame: [f64; 4], discs: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let around = |[x, y]: [f64; 2]| [x - 6.0, y - 6.0, x + 6.0, y + 6.0];
        Self {
            frame,
            taken: discs.into_iter().map(around).collect(),
        }
    }

    /// Writes one beside a place. `crowd` says how crowded it is in a direction.
    pub(super) fn write(
        &mut self,
        sheet: &mut Sheet,
        [x, y]: [f64; 2],
        text: &str,
        size: f64,
        crowd: impl Fn(f64, f64) -> f64,
    ) {
        let wide = words::width(text, size);
        let mut best = (f64::INFINITY, [0.0; 4]);
        for (dx, dy) in [
            (1.0, 0.0),
            (0.7, -0.7),
            (0.7, 0.7),
            (0.0, -1.0),
            (0.0, 1.0),
            (-0.7, -0.7),
            (-0.7, 0.7),
            (-1.0, 0.0),
        ] {
            let middle = [
                x + dx * (9.0 + 0.5 * wide) * if dx == 0.0 { 0.0 } else { 1.0 },
                y + dy * 16.0,
            ];
            let half = [0.5 * wide, 0.42 * size];
            let field = [
                middle[0] - half[0],
                middle[1] - half[1],
                middle[0] + half[0],
                middle[1] + half[1],
            ];
            let hidden: f64 = self.taken.iter().map(|other| overlap(field, *other)).sum();
            let outside = overlap(field, self.frame) < 0.999 * 4.0 * half[0] * half[1];
            let cost = hidden + 20.0 * crowd(dx, dy) + if outside { 1e4 } else { 0.0 };
            if cost < best.0 {
                best = (cost, field);
            }
        }
        let [left, _, right, bottom] = best.1;
        sheet.words_apart([0.5 * (left + right), bottom], text, size, Anchor::Middle);
        self.taken.push(best.1);
    }
}

/// The area that two rectangles share.
fn overlap(a: [f64; 4], b: [f64; 4]) -> f64 {
    let wide = (a[2].min(b[2]) - a[0].max(b[0])).max(0.0);
    wide * (a[3].min(b[3]) - a[1].max(b[1])).max(0.0)
}

/// The column at the right of a panel: what colours and marks say, from the top down.
pub(super) struct Column {
    left: f64,
    y: f64,
    bottom: f64,
}

impl Column {
    pub(super) fn beside(panel: &Panel) -> Self {
        let [_, top, right, bottom] = panel.edges;
        Self {
            left: right + 24.0,
            y: top + 12.0,
            bottom,
        }
    }

    /// At the right of a picture of a width, from a height to another; below a narrow picture there is room for all.
    pub(super) fn at(width: f64, top: f64, bottom: f64) -> Self {
        Self {
            left: width - LEGEND + 4.0,
            y: top,
            bottom: match width < f64::from(NARROW) {
                true => f64::INFINITY,
                false => bottom,
            },
        }
    }

    /// Draws one thing of it.
    fn entry<T>(&mut self, sheet: &mut Sheet, draw: impl FnOnce(&mut Self, &mut Sheet) -> T) -> T {
        let (first, y) = (sheet.shapes.len(), self.y);
        let drawn = draw(self, sheet);
        sheet.key.push(Entry {
            shapes: first..sheet.shapes.len(),
            corner: [self.left, y - 14.0],
            height: self.y - y,
            bar: None,
            leads: false,
        });
        drawn
    }

    /// Words above what they are of.
    pub(super) fn say(&mut self, sheet: &mut Sheet, text: &str, ink: Ink) {
        self.entry(sheet, |column, sheet| column.write(sheet, text, ink));
        if let Some(entry) = sheet.key.last_mut() {
            entry.leads = true;
        }
    }

    fn write(&mut self, sheet: &mut Sheet, text: &str, ink: Ink) {
        let size = SMALL.min(SMALL * (LEGEND - 10.0) / words::width(text, SMALL).max(1.0));
        sheet.words([self.left, self.y], text, size, Anchor::Start, ink);
        self.y += 20.0;
    }

    pub(super) fn gap(&mut self) {
        self.y += 14.0;
    }

    /// How many lines there is still room for.
    pub(super) fn room(&self) -> usize {
        ((self.bottom - self.y) / 20.0).max(0.0) as usize
    }

    /// What a line's colour says.
    pub(super) fn line(&mut self, sheet: &mut Sheet, ink: Ink, width: f64, text: &str) {
        self.line_with(sheet, ink, width, None, text);
    }

    /// The same of a line that may be dashed.
    pub(super) fn line_with(
        &mut self,
        sheet: &mut Sheet,
        ink: Ink,
        width: f64,
        dash: Option<[f64; 2]>,
        text: &str,
    ) {
        self.entry(sheet, |column, sheet| {
            let [left, y] = [column.left, column.y - 5.0];
            sheet.line_with(vec![[left, y], [left + 24.0, y]], ink, width, dash);
            column.beside_mark(sheet, text);
        });
    }

    /// What a dashed line's colour says.
    pub(super) fn dashes(&mut self, sheet: &mut Sheet, ink: Ink, text: &str) {
        self.entry(sheet, |column, sheet| {
            let [left, y] = [column.left, column.y - 5.0];
            sheet.dashed(vec![[left, y], [left + 24.0, y]], ink, 1.3, [5.0, 4.0]);
            column.beside_mark(sheet, text);
        });
    }

    /// What a mark says; it is drawn around the place that it is told.
    pub(super) fn mark(
        &mut self,
        sheet: &mut Sheet,
        text: &str,
        draw: impl FnOnce(&mut Sheet, [f64; 2]),
    ) {
        self.entry(sheet, |column, sheet| {
            draw(sheet, [column.left + 12.0, column.y - 5.0]);
            column.beside_mark(sheet, text);
        });
    }

    fn beside_mark(&mut self, sheet: &mut Sheet, text: &str) {
        let size = (SMALL * (LEGEND - 44.0) / words::width(text, SMALL).max(1.0)).clamp(9.0, SMALL);
        let at = [self.left + 33.0, self.y];
        sheet.words(at, text, size, Anchor::Start, TEXT);
        self.y += 20.0;
    }

    /// A bar of colours, from `low` at its foot to `high`.
    pub(super) fn colours(
        &mut self,
        sheet: &mut Sheet,
        label: &str,
        ends: [f64; 2],
        ink: impl Fn(f64) -> Ink,
    ) {
        self.colours_in_steps(sheet, label, ends, 0.0, ink);
    }

    /// The same with numbers that are no closer than a step: of counts one.
    pub(super) fn colours_in_steps(
        &mut self,
        sheet: &mut Sheet,
        label: &str,
        [low, high]: [f64; 2],
        step: f64,
        ink: impl Fn(f64) -> Ink,
    ) {
        let bar = self.entry(sheet, |column, sheet| {
            column.bar(sheet, label, [low, high], step, ink)
        });
        if let Some(entry) = sheet.key.last_mut() {
            entry.bar = Some(bar);
        }
    }

    fn bar(
        &mut self,
        sheet: &mut Sheet,
        label: &str,
        [low, high]: [f64; 2],
        step: f64,
        ink: impl Fn(f64) -> Ink,
    ) -> Bar {
        self.write(sheet, label, TEXT);
        self.y -= 6.0;
        let (left, y) = (self.left, self.y);
        let (wide, tall) = (18.0, 180.0_f64.min(self.bottom - self.y).max(40.0));
        let parts = 60_u32;
        let share = |part: u32| (f64::from(part) + 0.5) / f64::from(parts);
        let inks: Vec<Ink> = (0..parts).map(|part| ink(share(part))).collect();
        let upwards = inks.iter().rev().copied().collect();
        sheet.cells([left, y, left + wide, y + tall], 1, upwards);
        let mut axis = Axis::exact("", low, high, 4.0);
        axis.step = axis.step.max(step);
        let ticks = axis.ticks().into_iter();
        let ticks = ticks.map(|(value, text)| ((value - axis.low) / (axis.high - axis.low), text));
        let ticks: Vec<(f64, String)> = ticks.collect();
        for (share, text) in &ticks {
            let at = y + tall * (1.0 - share);
            sheet.line(vec![[left + wide, at], [left + wide + 5.0, at]], TEXT, 1.0);
            let at = [left + wide + 10.0, at + 5.0];
            sheet.words(at, text.as_str(), SMALL, Anchor::Start, TEXT);
        }
        self.y += tall + 34.0;
        Bar {
            label: label.to_owned(),
            inks,
            ticks,
        }
    }

    /// Words of less weight, line by line.
    pub(super) fn note(&mut self, sheet: &mut Sheet, lines: &[&str]) {
        self.entry(sheet, |column, sheet| {
            for line in lines {
                column.write(sheet, line, FAINT);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_of_one_picture_have_one_scale_and_keep_apart() {
        let sheet = Sheet::titled(1000, 700, "", "");
        for (bounds, count) in [
            ([0.0, 0.0, 10.0, 10.0], 2),
            ([0.0, 0.0, 100.0, 1.0], 3),
            ([0.0, 0.0, 1.0, 100.0], 5),
            ([0.0, 0.0, 0.0, 0.0], 4),
        ] {
            let panels = maps(&sheet, bounds, count);
            assert_eq!(panels.len(), count);
            for (at, panel) in panels.iter().enumerate() {
                let scale = pixels_each_m(panel);
                assert!((scale - pixels_each_m(&panels[0])).abs() < 1e-9 * scale);
                let [left, top, right, bottom] = panel.edges;
                assert!(right - left > 40.0 && bottom - top > 40.0, "{panel:?}");
                for other in &panels[..at] {
                    assert!(
                        overlap(panel.edges, other.edges) == 0.0,
                        "{panel:?} {other:?}"
                    );
                }
            }
        }
        let wide = maps(&sheet, [0.0, 0.0, 100.0, 1.0], 3);
        assert!(
            wide.iter().all(|panel| panel.edges[0] == wide[0].edges[0]),
            "one above the other"
        );
    }
}
