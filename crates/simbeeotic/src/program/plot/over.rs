//! `plot sweep`: what runs come to over what was varied, from a table of runs.

mod said;

use super::super::Failure;
use super::arguments::SweepPlotOptions;
use super::axes::{Axis, Panel};
use super::band::{half_width, mean, units};
use super::chart::{Curve, MARKERS, curve_band, curve_line, curve_mark, curve_spread};
use super::column::Entry;
use super::limits::Limits;
use super::palette::series;
use super::runs::{Column, Runs, Values};
use super::series::value_axis;
use super::sheet::{Anchor, HEAD, SMALL, Sheet, TEXT};
use super::sweep::short;
use said::caption;
use simbeeotic_view::render::words;

/// As many colours are told apart.
const COLOURS: usize = MARKERS.len();
/// So much of the room of a category has bars in it.
const FILLED: f64 = 0.7;
/// Most values of `--x` that are categories: more are no picture, but a table.
const CATEGORIES: usize = 40;

/// One curve: a metric, of the runs of one value of `--by`.
struct Line {
    name: String,
    colour: usize,
    marker: usize,
    /// Place on the x axis, and what the runs there came to.
    points: Vec<(f64, Numbers)>,
}

/// What runs at one place came to.
struct Numbers {
    /// Each run.
    runs: Vec<f64>,
    /// What their mean is of: the mean of each seed, since runs of one seed have their chance in common; of
    /// one seed its runs.
    units: Vec<f64>,
}

impl Numbers {
    fn of(runs: &[(&str, f64)]) -> Self {
        Self {
            runs: runs.iter().map(|(_, number)| *number).collect(),
            units: units(runs),
        }
    }

    /// The mean and the ends of its 95 % interval, as far as there can be such numbers; of one number no ends, since
    /// it says nothing of its spread.
    fn estimate(&self, limits: Limits) -> (f64, Option<[f64; 2]>, [bool; 2]) {
        let middle = mean(&self.units).unwrap_or(f64::NAN);
        let Some(half) = half_width(&self.units) else {
            return (middle, None, [false; 2]);
        };
        let ends = [middle - half, middle + half];
        let (kept, _) = limits.cut(ends);
        (middle, Some(kept), [kept[0] != ends[0], kept[1] != ends[1]])
    }
}

/// Metrics of one unit.
struct Part {
    label: String,
    /// What its numbers can be.
    limits: Limits,
    lines: Vec<Line>,
}

impl Part {
    fn numbers(&self) -> impl Iterator<Item = &Numbers> {
        let points = self.lines.iter().flat_map(|line| &line.points);
        points
            .map(|(_, numbers)| numbers)
            .filter(|numbers| !numbers.runs.is_empty())
    }
}

/// Draws it.
pub(super) fn over(options: &SweepPlotOptions) -> Result<Sheet, Failure> {
    let runs = Runs::open(&options.table)?;
    let x = runs.key("--x", &options.x)?;
    let by = options.by.as_deref().map(|by| runs.key("--by", by));
    let by = by.transpose()?;
    let mut metrics: Vec<Column> = Vec::new();
    for name in &options.metric {
        let column = runs.number(name)?;
        if metrics.iter().any(|other| other.name == column.name) {
            return Err(Failure::input(format!(
                "--metric {name}: it is drawn already"
            )));
        }
        metrics.push(column);
    }
    let groups = match &by {
        Some(column) => runs.distinct(column),
        None => vec![String::new()],
    };
    if groups.len() > COLOURS {
        return Err(Failure::input(format!(
            "--by {}: it has {} values; {COLOURS} colours are the most that are told apart",
            options.by.as_deref().unwrap_or_default(),
            groups.len()
        )));
    }
    let values = runs.values(&x);
    if let Values::Words(names) = &values
        && names.len() > CATEGORIES
    {
        return Err(Failure::input(format!(
            "--x {}: it has {} values that are no numbers of one unit; {CATEGORIES} are the most",
            options.x,
            names.len()
        )));
    }
    let mut parts: Vec<Part> = Vec::new();
    for metric in &metrics {
        let lines = groups.iter().enumerate().map(|(at, group)| {
            let rows = rows_of(&runs, by.as_ref(), group);
            let name = match (&by, metrics.len()) {
                (Some(column), 1) => format!("{} = {group}", short(&column.name)),
                (Some(column), _) => {
                    format!("{}, {} = {group}", metric.base(), short(&column.name))
                }
                (None, _) => metric.base().to_owned(),
            };
            (at, name, points(rows, &runs, &x, &values, metric))
        });
        let lines: Vec<_> = lines.collect();
        let unit = metric.unit();
        let all =
            (lines.iter()).flat_map(|(.., points)| points.iter().flat_map(|(_, n)| n.runs.iter()));
        let limits = Limits::of(metric.base(), unit, all.copied());
        let place = parts.iter().position(|part| part.label == unit);
        let place = place.unwrap_or_else(|| {
            parts.push(Part {
                label: unit.to_owned(),
                limits,
                lines: Vec::new(),
            });
            parts.len() - 1
        });
        let part = &mut parts[place];
        part.limits = part.limits.or(limits);
        let before = part.lines.len() / groups.len();
        part.lines
            .extend(lines.into_iter().map(|(at, name, points)| Line {
                name,
                colour: if by.is_some() { at } else { before },
                marker: if metrics.len() > 1 { before } else { at },
                points,
            }));
    }
    for part in &mut parts {
        let unit = part.label.clone();
        let alone = metrics
            .iter()
            .filter(|m| m.unit() == unit)
            .collect::<Vec<_>>();
        part.label = match (alone.as_slice(), unit.as_str()) {
            ([one], "") => one.base().to_owned(),
            ([one], unit) => format!("{}, {unit}", one.base()),
            (several, unit) => {
                let names = several.iter().map(|metric| metric.base());
                let parts = names.chain(Some(unit)).filter(|part| !part.is_empty());
                parts.collect::<Vec<_>>().join(", ")
            }
        };
        if part.numbers().next().is_none() {
            return Err(Failure::input(format!(
                "{}: no run has a number for `{}`",
                options.table.display(),
                alone.first().map_or("", |m| m.base())
            )));
        }
    }
    // A curve without a point needs no place in the key.
    for part in &mut parts {
        let has_any = |line: &Line| line.points.iter().any(|(_, n)| !n.runs.is_empty());
        part.lines.retain(has_any);
    }
    let missing = metrics.iter().flat_map(|metric| {
        let empty = |row: &&Vec<String>| number(row, metric).is_none();
        runs.good().filter(empty)
    });
    let missing = missing.count();
    let caption = caption(&runs, &x, &by, &parts, missing);
    Ok(draw(options, &caption, &x, &values, &parts))
}

/// The runs of one value of `--by`.
fn rows_of<'r>(
    runs: &'r Runs,
    by: Option<&Column>,
    group: &str,
) -> impl Iterator<Item = &'r Vec<String>> {
    let place = by.map(|column| column.place);
    runs.good()
        .filter(move |row| place.is_none_or(|place| row[place] == group))
}

/// What a run came to, if it came to anything.
fn number(row: &[String], metric: &Column) -> Option<f64> {
    let number = row[metric.place].parse::<f64>().ok();
    number.filter(|number| number.is_finite())
}

/// What the runs at each place of the x axis came to.
fn points<'a>(
    rows: impl Iterator<Item = &'a Vec<String>>,
    runs: &Runs,
    x: &Column,
    values: &Values,
    metric: &Column,
) -> Vec<(f64, Numbers)> {
    let mut points: Vec<(f64, Vec<(&str, f64)>)> = Vec::new();
    for row in rows {
        let Some(place) = values.place(&row[x.place]) else {
            continue;
        };
        // A place where no run has a number stays, without any: the line breaks there.
        let run = number(row, metric).map(|number| (runs.seed(row), number));
        match points.iter_mut().find(|(other, _)| *other == place) {
            Some((_, numbers)) => numbers.extend(run),
            None => points.push((place, run.into_iter().collect())),
        }
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let numbers = points
        .iter()
        .map(|(place, runs)| (*place, Numbers::of(runs)));
    numbers.collect()
}

fn x_axis(x: &Column, values: &Values, whole: bool) -> Axis {
    match values {
        Values::Numbers { low, high, unit } => {
            let label = match unit.as_str() {
                "" => short(&x.name).to_owned(),
                unit => format!("{}, {unit}", short(&x.name)),
            };
            let margin = match high > low {
                true => 0.03 * (high - low),
                // One value: in the middle.
                false => 0.1 * low.abs().max(1.0),
            };
            let mut axis = Axis::exact(label, low - margin, high + margin, 10.0);
            // Between two counts there is none.
            axis.step = axis.step.max(if whole { 1.0 } else { 0.0 });
            axis
        }
        Values::Words(names) => Axis::named(short(&x.name), names.clone()),
    }
}

fn y_axis(part: &Part, bars: bool) -> Axis {
    let ends = part.numbers().flat_map(|numbers| {
        let (_, ends, _) = numbers.estimate(part.limits);
        let ends = ends.into_iter().flatten();
        numbers.runs.iter().copied().chain(ends).collect::<Vec<_>>()
    });
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for end in ends {
        (low, high) = (low.min(end), high.max(end));
    }
    if bars {
        (low, high) = (low.min(0.0), high.max(0.0));
    }
    value_axis(part.label.clone(), [low, high], 6.0, part.limits)
}

fn draw(
    options: &SweepPlotOptions,
    caption: &str,
    x: &Column,
    values: &Values,
    parts: &[Part],
) -> Sheet {
    let [width, height] = options.size();
    let names: Vec<&str> = options.metric.iter().map(String::as_str).collect();
    let title = format!("{} over {}", names.join(", "), short(&x.name));
    let title = options.title.as_deref().unwrap_or(&title);
    let mut sheet = Sheet::titled(width, height, title, caption);
    let keyed = parts.iter().any(|part| part.lines.len() > 1);
    let key_width = parts
        .iter()
        .flat_map(|part| &part.lines)
        .map(|line| words::width(&line.name, SMALL) + 54.0);
    let room = match keyed {
        true => key_width
            .fold(0.0, f64::max)
            .min(0.4 * f64::from(width))
            .min(sheet.key_room() * 2.0),
        false => 0.0,
    };
    let (left, right) = (96.0, f64::from(width) - 28.0 - room);
    let mut places = (parts.iter().flat_map(|part| &part.lines)).flat_map(|line| &line.points);
    let across = x_axis(x, values, places.all(|(place, _)| place.fract() == 0.0));
    let below = across.turned(right - left).unwrap_or(0.0);
    let (top, bottom) = (HEAD + 6.0, f64::from(height) - 62.0 - below);
    let gap = 24.0;
    let each = (bottom - top - gap * (parts.len() - 1) as f64) / parts.len() as f64;
    let bars = matches!(values, Values::Words(_));
    for (at, part) in parts.iter().enumerate() {
        let up = top + (each + gap) * at as f64;
        let panel = Panel {
            edges: [left, up, right, up + each],
            x: across.clone(),
            y: y_axis(part, bars),
        };
        panel.draw(&mut sheet, at + 1 == parts.len());
        lines(&mut sheet, &panel, part, bars);
        if keyed {
            key(&mut sheet, &panel, part);
        }
    }
    sheet
}

/// The pieces of a line between places where there is no number.
fn pieces(line: &Line) -> impl Iterator<Item = &[(f64, Numbers)]> {
    let known = |point: &(f64, Numbers)| !point.1.runs.is_empty();
    let pieces = line.points.chunk_by(move |a, b| known(a) == known(b));
    pieces.filter(move |piece| known(&piece[0]))
}

fn lines(sheet: &mut Sheet, panel: &Panel, part: &Part, bars: bool) {
    let count = part.lines.len() as f64;
    let mut curves: Vec<(Curve, &[(f64, Numbers)])> = Vec::new();
    for (at, line) in part.lines.iter().enumerate() {
        // Beside each other where there are bars.
        let shift = if bars {
            FILLED * ((at as f64 + 0.5) / count - 0.5)
        } else {
            0.0
        };
        for piece in pieces(line) {
            let estimates = piece
                .iter()
                .map(|(_, numbers)| numbers.estimate(part.limits));
            let (means, spread): (Vec<_>, Vec<_>) = estimates.map(|(m, ends, _)| (m, ends)).unzip();
            let places = piece.iter().map(|(x, _)| x + shift);
            let curve = Curve {
                name: line.name.clone(),
                ink: series(line.colour),
                marker: MARKERS[line.marker.min(MARKERS.len() - 1)],
                points: places.zip(means).map(|(x, y)| [x, y]).collect(),
                spread,
                line: (!bars).then_some(2.2),
            };
            curves.push((curve, piece));
        }
    }
    let half = 0.5 * FILLED / count * 0.86;
    for (curve, _) in curves.iter().filter(|_| bars) {
        for [x, y] in &curve.points {
            let (low, high) = (panel.place(x - half, 0.0), panel.place(x + half, *y));
            sheet.rectangle(low, high, curve.ink.thin(0.35));
        }
    }
    for (curve, _) in &curves {
        // A band hides no dots, as whiskers would.
        match curve.line {
            Some(_) if curve.points.len() > 1 => curve_band(sheet, panel, curve),
            _ => curve_spread(sheet, panel, curve),
        }
    }
    for (curve, piece) in &curves {
        for ([x, _], (_, numbers)) in curve.points.iter().zip(*piece) {
            for number in numbers.runs.iter().filter(|_| numbers.runs.len() > 1) {
                sheet.disc(panel.place(*x, *number), 2.4, curve.ink.thin(0.45), 0.0);
            }
        }
    }
    for (curve, _) in &curves {
        curve_line(sheet, panel, curve);
    }
}

fn key(sheet: &mut Sheet, panel: &Panel, part: &Part) {
    let [_, top, right, _] = panel.edges;
    for (at, line) in part.lines.iter().enumerate() {
        let [x, y] = [right + 14.0, top + 8.0 + 23.0 * at as f64];
        let (ink, first) = (series(line.colour), sheet.shapes.len());
        sheet.line(vec![[x, y], [x + 26.0, y]], ink, 2.2);
        curve_mark(
            sheet,
            MARKERS[line.marker.min(MARKERS.len() - 1)],
            ink,
            [x + 13.0, y],
        );
        let place = [x + 36.0, y + 5.0];
        sheet.words(place, line.name.as_str(), SMALL, Anchor::Start, TEXT);
        sheet.key.push(Entry {
            shapes: first..sheet.shapes.len(),
            corner: [x, y - 9.0],
            height: 23.0,
            bar: None,
            leads: false,
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_interval_of_what_is_never_below_zero_ends_there_and_it_is_said() {
        let estimate = |runs: &[(&str, f64)]| {
            let numbers = Numbers::of(runs);
            let limits = Limits::of("trips", "", numbers.runs.iter().copied());
            numbers.estimate(limits)
        };
        let (middle, ends, [cut, _]) = estimate(&[("1", 0.0), ("2", 0.0), ("3", 1.0)]);
        assert!(middle > 0.3 && ends.is_some_and(|[low, _]| low == 0.0) && cut);
        let (_, ends, [cut, _]) = estimate(&[("1", 0.0), ("2", -0.1), ("3", 1.0)]);
        assert!(ends.is_some_and(|[low, _]| low < -0.5) && !cut);
    }

    #[test]
    fn of_one_run_nothing_is_known_of_the_spread() {
        let (middle, ends, cut) = Numbers::of(&[("1", 3.0)]).estimate(Limits::NONE);
        assert_eq!((middle, ends, cut), (3.0, None, [false; 2]));
        let (_, ends, _) = Numbers::of(&[("1", 3.0), ("1", 3.0)]).estimate(Limits::NONE);
        assert_eq!(ends, Some([3.0; 2]), "two that are alike are another thing");
    }

    #[test]
    fn a_line_breaks_where_no_run_has_a_number() {
        let of = |numbers: &[f64]| {
            let runs: Vec<(&str, f64)> = numbers.iter().map(|n| ("1", *n)).collect();
            Numbers::of(&runs)
        };
        let line = Line {
            name: String::new(),
            colour: 0,
            marker: 0,
            points: vec![
                (10.0, of(&[1.0])),
                (20.0, of(&[])),
                (30.0, of(&[2.0])),
                (40.0, of(&[3.0])),
            ],
        };
        let places: Vec<Vec<f64>> = pieces(&line)
            .map(|piece| piece.iter().map(|(place, _)| *place).collect())
            .collect();
        assert_eq!(places, [vec![10.0], vec![30.0, 40.0]]);
    }
}
