//! Charts: curves with markers and spreads, dashed lines for what is to be held against them, a key beside
//! them, notes below.

use super::axes::{Axis, Panel};
use super::sheet::{Anchor, FAINT, HEAD, Ink, SMALL, Sheet, TEXT};
use simbeeotic_view::render::words;

/// What stands at the points of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Marker {
    Disc,
    Square,
    Diamond,
    /// A triangle, its tip up.
    Up,
    /// A triangle, its tip down.
    Down,
    Plus,
    Cross,
}

/// Forms in the order of use, so that curves are told apart without colours, too.
pub(crate) const MARKERS: [Marker; 7] = [
    Marker::Disc,
    Marker::Square,
    Marker::Diamond,
    Marker::Up,
    Marker::Down,
    Marker::Plus,
    Marker::Cross,
];

/// Points, and the line through them.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) ink: Ink,
    pub(crate) marker: Marker,
    pub(crate) points: Vec<[f64; 2]>,
    /// Beside the points: from where to where on the y axis they were found, if that is known; may be empty.
    pub(crate) spread: Vec<Option<[f64; 2]>>,
    /// Width of the line, pixels; none: points alone.
    pub(crate) line: Option<f64>,
}

/// A dashed line across the chart.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    pub(crate) across: Across,
    pub(crate) label: String,
    pub(crate) ink: Ink,
}

/// Where a [`Rule`] is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Across {
    /// Upright, at this place of the x axis.
    X(f64),
    /// Level, at this place of the y axis.
    Y(f64),
}

/// A chart, before it is drawn.
#[derive(Clone, Debug)]
pub(crate) struct Chart {
    pub(crate) title: String,
    pub(crate) caption: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) curves: Vec<Curve>,
    pub(crate) rules: Vec<Rule>,
    /// Lines of small words below.
    pub(crate) notes: Vec<String>,
}

/// Dash and gap of a [`Rule`], pixels.
const DASH: [f64; 2] = [9.0, 6.0];
/// From line to line of small words, pixels.
const LINE: f64 = 21.0;

impl Chart {
    /// Draws it, so many pixels wide and high.
    pub(crate) fn draw(&self, width: u32, height: u32) -> Sheet {
        let mut sheet = Sheet::titled(width, height, &self.title, &self.caption);
        let names = self
            .curves
            .iter()
            .map(|curve| words::width(&curve.name, SMALL));
        let key = names.fold(0.0, f64::max) + 62.0;
        // Labels of upright rules stand above the panel, one row each.
        let upright = |rule: &&Rule| matches!(rule.across, Across::X(_));
        let labels = self.rules.iter().filter(upright).count() as f64;
        let foot = 66.0 + LINE * self.notes.len() as f64;
        let panel = Panel {
            edges: [
                96.0,
                HEAD + 14.0 + LINE * labels,
                f64::from(width) - key - 24.0,
                f64::from(height) - foot,
            ],
            x: self.x.clone(),
            y: self.y.clone(),
        };
        panel.draw(&mut sheet, true);
        self.rules(&mut sheet, &panel);
        for curve in &self.curves {
            curve_spread(&mut sheet, &panel, curve);
        }
        for curve in &self.curves {
            curve_line(&mut sheet, &panel, curve);
        }
        self.key(&mut sheet, &panel);
        for (at, note) in self.notes.iter().enumerate() {
            let up = LINE * (self.notes.len() - at) as f64;
            let room = f64::from(width) - 48.0;
            let size = SMALL.min(SMALL * room / words::width(note, SMALL).max(1.0));
            let place = [24.0, f64::from(height) + 7.0 - up];
            sheet.words(place, note.as_str(), size, Anchor::Start, FAINT);
        }
        sheet
    }

    fn rules(&self, sheet: &mut Sheet, panel: &Panel) {
        let [left, top, right, bottom] = panel.edges;
        let mut row = 0.0;
        for rule in &self.rules {
            let label = rule.label.as_str();
            match rule.across {
                Across::X(x) => {
                    let [x, _] = panel.place(x, panel.y.low);
                    let above = top - 6.0 - LINE * row;
                    row += 1.0;
                    let ends = vec![[x, above + 3.0], [x, bottom]];
                    sheet.dashed(ends, rule.ink, 1.8, DASH);
                    // On the side where there is room.
                    let half = 0.5 * words::width(label, SMALL);
                    let middle = x.max(left + half).min(f64::from(sheet.width) - 24.0 - half);
                    sheet.words(
                        [middle, above - 2.0],
                        label,
                        SMALL,
                        Anchor::Middle,
                        rule.ink,
                    );
                }
                Across::Y(y) => {
                    let [_, y] = panel.place(panel.x.low, y);
                    sheet.dashed(vec![[left, y], [right, y]], rule.ink, 1.4, DASH);
                    let (x, anchor) = match self.is_free_on_the_left(panel, label, y) {
                        true => (left + 8.0, Anchor::Start),
                        false => (right - 8.0, Anchor::End),
                    };
                    sheet.words_apart([x, y - 6.0], label, SMALL, anchor);
                }
            }
        }
    }

    /// Whether a label at the left end of a level rule stands on no upright one and on no curve; or else it does so
    /// at the right end, too.
    fn is_free_on_the_left(&self, panel: &Panel, label: &str, y: f64) -> bool {
        let [left, _, right, _] = panel.edges;
        let wide = words::width(label, SMALL) + 16.0;
        let stands_on = |from: f64, to: f64| {
            let within = |x: f64| (from..=to).contains(&x);
            let upright = self.rules.iter().any(|rule| match rule.across {
                Across::X(x) => within(panel.place(x, panel.y.low)[0]),
                Across::Y(_) => false,
            });
            let mut points = self.curves.iter().flat_map(|curve| &curve.points);
            let near = |[x, other]: [f64; 2]| within(x) && (y - 24.0..=y + 4.0).contains(&other);
            upright || points.any(|[x, y]| near(panel.place(*x, *y)))
        };
        !stands_on(left, left + wide) || stands_on(right - wide, right)
    }

    fn key(&self, sheet: &mut Sheet, panel: &Panel) {
        let [_, top, right, _] = panel.edges;
        for (at, curve) in self.curves.iter().enumerate() {
            let [x, y] = [right + 14.0, top + 8.0 + 23.0 * at as f64];
            if let Some(line) = curve.line {
                sheet.line(vec![[x, y], [x + 26.0, y]], curve.ink, line);
            }
            curve_mark(sheet, curve.marker, curve.ink, [x + 13.0, y]);
            sheet.words(
                [x + 36.0, y + 5.0],
                curve.name.as_str(),
                SMALL,
                Anchor::Start,
                TEXT,
            );
        }
    }
}

/// The lower and the upper end of what a curve's points were found in, of neighbours for which it is known.
fn ends(panel: &Panel, curve: &Curve) -> Vec<Vec<[[f64; 2]; 2]>> {
    let points: Vec<_> = curve.points.iter().zip(&curve.spread).collect();
    let pieces = points.chunk_by(|(_, a), (_, b)| a.is_some() && b.is_some());
    let ends = pieces.map(|piece| {
        let known = piece
            .iter()
            .filter_map(|([x, _], ends)| Some((x, (**ends)?)));
        known
            .map(|(x, ends)| ends.map(|y| panel.place(*x, y)))
            .collect()
    });
    ends.filter(|piece: &Vec<_>| !piece.is_empty()).collect()
}

/// The bands between neighbours for which it is known in what they were found.
fn areas(sheet: &mut Sheet, panel: &Panel, curve: &Curve) {
    for piece in ends(panel, curve).iter().filter(|piece| piece.len() > 1) {
        let lower = piece.iter().map(|[low, _]| *low);
        let upper = piece.iter().rev().map(|[_, high]| *high);
        sheet.area(lower.chain(upper).collect(), curve.ink.thin(0.15));
    }
}

/// The range that a curve's points were found in, as a band; a bar at a point none of whose neighbours has one.
pub(crate) fn curve_band(sheet: &mut Sheet, panel: &Panel, curve: &Curve) {
    areas(sheet, panel, curve);
    for piece in ends(panel, curve) {
        if let [alone] = piece.as_slice() {
            whisker(sheet, curve, *alone);
        }
    }
}

/// The range that a curve's points were found in, as a band, or as bars where there is no line.
pub(crate) fn curve_spread(sheet: &mut Sheet, panel: &Panel, curve: &Curve) {
    if curve.line.is_some() {
        areas(sheet, panel, curve);
    }
    curve_whiskers(sheet, panel, curve);
}

/// The range that a curve's points were found in, as bars.
pub(crate) fn curve_whiskers(sheet: &mut Sheet, panel: &Panel, curve: &Curve) {
    for ends in ends(panel, curve).concat() {
        whisker(sheet, curve, ends);
    }
}

fn whisker(sheet: &mut Sheet, curve: &Curve, [low, high]: [[f64; 2]; 2]) {
    if (low[1] - high[1]).abs() < 1.0 {
        return;
    }
    sheet.line(vec![low, high], curve.ink.thin(0.8 * curve.ink.alpha), 1.2);
    for [x, y] in [low, high] {
        sheet.line(vec![[x - 3.5, y], [x + 3.5, y]], curve.ink, 1.2);
    }
}

/// A curve's points, and the line through them.
pub(crate) fn curve_line(sheet: &mut Sheet, panel: &Panel, curve: &Curve) {
    let places: Vec<_> = (curve.points.iter())
        .map(|[x, y]| panel.place(*x, *y))
        .collect();
    if let (Some(line), true) = (curve.line, places.len() > 1) {
        sheet.line(places.clone(), curve.ink, line);
    }
    for place in places {
        curve_mark(sheet, curve.marker, curve.ink, place);
    }
}

/// What stands at a point.
pub(crate) fn curve_mark(sheet: &mut Sheet, marker: Marker, ink: Ink, [x, y]: [f64; 2]) {
    match marker {
        Marker::Disc => sheet.disc([x, y], 4.4, ink, 1.0),
        Marker::Square => sheet.rectangle([x - 4.0, y - 4.0], [x + 4.0, y + 4.0], ink),
        Marker::Diamond => {
            let r = 7.5;
            let corners = vec![[x - r, y], [x, y - r], [x + r, y], [x, y + r]];
            sheet.area(corners, ink);
        }
        Marker::Up => sheet.area(
            vec![[x - 5.5, y + 4.2], [x, y - 5.8], [x + 5.5, y + 4.2]],
            ink,
        ),
        Marker::Down => sheet.area(
            vec![[x - 5.5, y - 4.2], [x, y + 5.8], [x + 5.5, y - 4.2]],
            ink,
        ),
        Marker::Plus => {
            sheet.line(vec![[x - 5.5, y], [x + 5.5, y]], ink, 2.6);
            sheet.line(vec![[x, y - 5.5], [x, y + 5.5]], ink, 2.6);
        }
        Marker::Cross => {
            sheet.line(vec![[x - 4.4, y - 4.4], [x + 4.4, y + 4.4]], ink, 2.6);
            sheet.line(vec![[x - 4.4, y + 4.4], [x + 4.4, y - 4.4]], ink, 2.6);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::palette::series;
    use super::super::png::png;
    use super::super::svg::svg;
    use super::*;

    fn chart(rules: Vec<Rule>) -> Chart {
        Chart {
            title: "Cost".to_owned(),
            caption: "of ever more".to_owned(),
            x: Axis::log("how many", [10.0, 900.0], false),
            y: Axis::log("s", [0.02, 30.0], false),
            curves: vec![Curve {
                name: "all".to_owned(),
                ink: series(0),
                marker: Marker::Disc,
                points: vec![[10.0, 0.02], [100.0, 1.0], [900.0, 20.0]],
                spread: vec![Some([0.02, 0.02]), Some([0.9, 2.0]), Some([20.0, 30.0])],
                line: Some(2.0),
            }],
            rules,
            notes: vec!["a note".to_owned()],
        }
    }

    fn rule(across: Across) -> Rule {
        Rule {
            across,
            label: "limit: 300".to_owned(),
            ink: series(3),
        }
    }

    #[test]
    fn a_rule_is_dashed_and_stands_at_its_place() {
        let sheet = chart(vec![rule(Across::X(300.0)), rule(Across::Y(1.0))]).draw(900, 600);
        let text = svg(&sheet);
        assert_eq!(text.matches("stroke-dasharray=\"9 6\"").count(), 2);
        assert_eq!(text.matches(">limit: 300</text>").count(), 2);
        assert!(text.contains(">a note</text>") && text.contains(">all</text>"));
        assert!(!svg(&chart(Vec::new()).draw(900, 600)).contains("dasharray"));
    }

    #[test]
    fn the_label_of_a_level_rule_stands_where_no_upright_one_runs_through_it() {
        let anchor = |rules: Vec<Rule>| {
            let sheet = chart(rules).draw(900, 600);
            let label = sheet.shapes.iter().find_map(|shape| match shape {
                super::super::sheet::Shape::Words(words) if words.text == "level" => {
                    Some(words.anchor)
                }
                _ => None,
            });
            label.expect("the label")
        };
        let level = || Rule {
            label: "level".to_owned(),
            ..rule(Across::Y(10.0))
        };
        let [low, high] = [11.0, 890.0].map(|x| rule(Across::X(x)));
        assert_eq!(anchor(vec![level()]), Anchor::Start);
        assert_eq!(anchor(vec![level(), low.clone()]), Anchor::End);
        assert_eq!(anchor(vec![level(), low, high]), Anchor::Start);
    }

    #[test]
    fn a_band_breaks_where_nothing_is_known_of_the_spread() {
        let mut chart = chart(Vec::new());
        let mut curve = chart.curves.remove(0);
        curve.points = [10.0, 20.0, 50.0, 100.0, 900.0].map(|x| [x, 1.0]).to_vec();
        let known = Some([0.5, 2.0]);
        let panel = Panel {
            edges: [0.0, 0.0, 500.0, 500.0],
            x: chart.x.clone(),
            y: chart.y.clone(),
        };
        let mut drawn = |spread: [Option<[f64; 2]>; 5]| {
            curve.spread = spread.to_vec();
            let mut sheet = Sheet::titled(600, 600, "", "");
            let before = sheet.shapes.len();
            curve_band(&mut sheet, &panel, &curve);
            let shapes = &sheet.shapes[before..];
            let areas = shapes
                .iter()
                .filter(|shape| matches!(shape, super::super::sheet::Shape::Area { .. }));
            let areas = areas.count();
            (areas, shapes.len() - areas)
        };
        assert_eq!(drawn([known; 5]), (1, 0));
        assert_eq!(drawn([known, known, None, known, known]), (2, 0));
        // A bar and its two ends, where a band has no width.
        assert_eq!(drawn([known, None, None, known, known]), (1, 3));
        assert_eq!(drawn([None; 5]), (0, 0));
    }

    #[test]
    fn the_dashes_are_in_the_pixels_too() {
        let without = png(&chart(Vec::new()).draw(900, 600)).expect("pixels");
        let with = png(&chart(vec![rule(Across::Y(5.0))]).draw(900, 600)).expect("pixels");
        let mut chart = chart(vec![rule(Across::Y(5.0))]);
        let mut sheet = chart.draw(900, 600);
        for shape in &mut sheet.shapes {
            if let super::super::sheet::Shape::Line { dash, .. } = shape {
                *dash = None;
            }
        }
        let solid = png(&sheet).expect("pixels");
        assert!(without != with && with != solid);
        chart.notes.clear();
        assert_ne!(png(&chart.draw(900, 600)).expect("pixels"), with);
    }
}
