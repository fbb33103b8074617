//! `plot sweep`: what runs come to over what was varied, from a table of runs.

use super::super::Failure;
use super::arguments::{BandKind, SweepPlotOptions};
use super::axes::{Axis, Panel};
use super::band::{band, mean};
use super::chart::{Curve, Marker, curve_band, curve_line, curve_mark, curve_spread};
use super::palette::series;
use super::runs::{Column, Runs, Values};
use super::series::value_axis;
use super::sheet::{Anchor, HEAD, SMALL, Sheet, TEXT};
use super::sweep::short;
use simbeeotic_view::render::words;

/// As many colours are told apart.
const COLOURS: usize = 7;
const MARKERS: [Marker; 3] = [Marker::Disc, Marker::Square, Marker::Diamond];
/// So much of the room of a category has bars in it.
const FILLED: f64 = 0.7;
/// Most values of `--x` that are categories.
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
        let mut seeds: Vec<(&str, Vec<f64>)> = Vec::new();
        for (seed, number) in runs {
            match seeds.iter_mut().find(|(other, _)| other == seed) {
                Some((_, numbers)) => numbers.push(*number),
                None => seeds.push((seed, vec![*number])),
            }
        }
        let runs: Vec<f64> = runs.iter().map(|(_, number)| *number).collect();
        let units = match seeds.len() {
            1 => runs.clone(),
            _ => seeds
                .iter()
                .filter_map(|(_, numbers)| mean(numbers))
                .collect(),
        };
        Self { runs, units }
    }
}

/// Metrics of one unit.
struct Part {
    label: String,
    lines: Vec<Line>,
}

impl Part {
    /// What its numbers are never below: counts, times and shares know no less than zero.
    fn least(&self) -> f64 {
        let points = self.lines.iter().flat_map(|line| &line.points);
        let mut runs = points.flat_map(|(_, numbers)| &numbers.runs);
        match runs.all(|run| *run >= 0.0) {
            true => 0.0,
            false => f64::NEG_INFINITY,
        }
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
            let rows = runs.good().filter(|row| match &by {
                Some(column) => row[column.place] == *group,
                None => true,
            });
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
        let part = parts.iter_mut().find(|part| part.label == unit);
        let part = match part {
            Some(part) => part,
            None => {
                parts.push(Part {
                    label: unit.to_owned(),
                    lines: Vec::new(),
                });
                let last = parts.len() - 1;
                &mut parts[last]
            }
        };
        let before = part.lines.len() / groups.len();
        part.lines
            .extend(lines.into_iter().map(|(at, name, points)| Line {
                name,
                colour: if by.is_some() { at } else { before },
                marker: before,
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
            (_, unit) => unit.to_owned(),
        };
        if part.lines.iter().all(|line| line.points.is_empty()) {
            return Err(Failure::input(format!(
                "{}: no run has a number for `{}`",
                options.table.display(),
                alone.first().map_or("", |m| m.base())
            )));
        }
    }
    Ok(draw(options, &runs, &x, &by, &values, &parts))
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
        let place = values.place(&row[x.place]);
        let number = row[metric.place].parse::<f64>().ok();
        let (Some(place), Some(number)) = (place, number.filter(|n| n.is_finite())) else {
            continue;
        };
        let run = (runs.seed(row), number);
        match points.iter_mut().find(|(other, _)| *other == place) {
            Some((_, numbers)) => numbers.push(run),
            None => points.push((place, vec![run])),
        }
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let numbers = points
        .iter()
        .map(|(place, runs)| (*place, Numbers::of(runs)));
    numbers.collect()
}

fn x_axis(x: &Column, values: &Values) -> Axis {
    match values {
        Values::Numbers { low, high, unit } => {
            let label = match unit.as_str() {
                "" => short(&x.name).to_owned(),
                unit => format!("{}, {unit}", short(&x.name)),
            };
            let margin = 0.03 * (high - low);
            Axis::exact(label, low - margin, high + margin, 10.0)
        }
        Values::Words(names) => Axis::named(short(&x.name), names.clone()),
    }
}

fn y_axis(part: &Part, bars: bool) -> Axis {
    let all = || part.lines.iter().flat_map(|line| &line.points);
    let ends = all().flat_map(|(_, numbers)| {
        let [_, ends] = estimate(&numbers.units, part.least());
        numbers.runs.iter().copied().chain(ends).collect::<Vec<_>>()
    });
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for end in ends {
        (low, high) = (low.min(end), high.max(end));
    }
    if bars {
        (low, high) = (low.min(0.0), high.max(0.0));
    }
    value_axis(part.label.clone(), low, high, 6.0)
}

/// The mean and the ends of its 95 % interval, which holds nothing below `least`; of one number that number.
fn estimate(numbers: &[f64], least: f64) -> [[f64; 2]; 2] {
    let middle = mean(numbers).unwrap_or(f64::NAN);
    let ends = band(&mut numbers.to_vec(), BandKind::Confidence);
    let [low, high] = ends.unwrap_or([middle; 2]);
    [[middle; 2], [low.max(least), high]]
}

fn draw(
    options: &SweepPlotOptions,
    runs: &Runs,
    x: &Column,
    by: &Option<Column>,
    values: &Values,
    parts: &[Part],
) -> Sheet {
    let (width, height) = (options.width, options.height);
    let names: Vec<&str> = options.metric.iter().map(String::as_str).collect();
    let title = format!("{} over {}", names.join(", "), short(&x.name));
    let title = options.title.as_deref().unwrap_or(&title);
    let mut sheet = Sheet::titled(width, height, title, &caption(runs, x, by, parts));
    let keyed = parts.iter().any(|part| part.lines.len() > 1);
    let key_width = parts
        .iter()
        .flat_map(|part| &part.lines)
        .map(|line| words::width(&line.name, SMALL) + 54.0);
    let room = match keyed {
        true => key_width.fold(0.0, f64::max).min(0.4 * f64::from(width)),
        false => 0.0,
    };
    let (left, right) = (96.0, f64::from(width) - 28.0 - room);
    let (top, bottom) = (HEAD + 6.0, f64::from(height) - 62.0);
    let gap = 24.0;
    let each = (bottom - top - gap * (parts.len() - 1) as f64) / parts.len() as f64;
    let bars = matches!(values, Values::Words(_));
    for (at, part) in parts.iter().enumerate() {
        let up = top + (each + gap) * at as f64;
        let panel = Panel {
            edges: [left, up, right, up + each],
            x: x_axis(x, values),
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

fn lines(sheet: &mut Sheet, panel: &Panel, part: &Part, bars: bool) {
    let count = part.lines.len() as f64;
    let curves: Vec<(Curve, &Line)> = (part.lines.iter().enumerate())
        .map(|(at, line)| {
            // Beside each other where there are bars.
            let shift = if bars {
                FILLED * ((at as f64 + 0.5) / count - 0.5)
            } else {
                0.0
            };
            let estimates = line
                .points
                .iter()
                .map(|(_, numbers)| estimate(&numbers.units, part.least()));
            let (means, spread): (Vec<_>, Vec<_>) = estimates.map(|[m, ends]| (m[0], ends)).unzip();
            let places = line.points.iter().map(|(x, _)| x + shift);
            let curve = Curve {
                name: line.name.clone(),
                ink: series(line.colour),
                marker: MARKERS[line.marker.min(MARKERS.len() - 1)],
                points: places.zip(means).map(|(x, y)| [x, y]).collect(),
                spread,
                line: (!bars).then_some(2.2),
            };
            (curve, line)
        })
        .collect();
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
    for (curve, line) in &curves {
        for ([x, _], (_, numbers)) in curve.points.iter().zip(&line.points) {
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
        let ink = series(line.colour);
        sheet.line(vec![[x, y], [x + 26.0, y]], ink, 2.2);
        curve_mark(sheet, MARKERS[line.marker.min(2)], ink, [x + 13.0, y]);
        let place = [x + 36.0, y + 5.0];
        sheet.words(place, line.name.as_str(), SMALL, Anchor::Start, TEXT);
    }
}

/// How many runs there are, and what the band is.
fn caption(runs: &Runs, x: &Column, by: &Option<Column>, parts: &[Part]) -> String {
    let points = || {
        let lines = parts.iter().flat_map(|part| &part.lines);
        lines.flat_map(|line| &line.points)
    };
    let counts = || points().map(|(_, numbers)| numbers.units.len());
    let (least, most) = (counts().min().unwrap_or(0), counts().max().unwrap_or(0));
    let mut text = format!("{} runs", runs.good().count());
    let each = match least == most {
        true => most.to_string(),
        false => format!("{least} to {most}"),
    };
    match most {
        0 | 1 => text.push_str("; one at each place, so nothing is known of their spread"),
        _ => {
            let mut pooled = runs.pooled(x, by.as_ref());
            let seeds = pooled.iter().position(|key| *key == "seed");
            let of = match seeds {
                Some(at) => {
                    pooled.remove(at);
                    "seeds"
                }
                None => "runs",
            };
            let over = match (pooled.as_slice(), seeds) {
                ([], _) => String::new(),
                (keys, Some(_)) => format!(", averaged over {}", keys.join(", ")),
                (keys, None) => format!(", over {}", keys.join(", ")),
            };
            let band = "mean, and where it is with 95 % confidence";
            text.push_str(&format!(
                "; {each} {of} at each place{over}: {band}; dots: the runs"
            ));
        }
    }
    if runs.failed() > 0 {
        text.push_str(&format!("; {} failed and are left out", runs.failed()));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_one_seed_count_once_in_an_interval() {
        let four = Numbers::of(&[("1", 1.0), ("2", 5.0), ("1", 3.0), ("2", 7.0)]);
        assert_eq!(four.runs, [1.0, 5.0, 3.0, 7.0]);
        assert_eq!(four.units, [2.0, 6.0]);
        let one = Numbers::of(&[("1", 1.0), ("1", 3.0)]);
        assert_eq!(
            one.units,
            [1.0, 3.0],
            "nothing else is known of their chance"
        );
        // s = 2.828, t(1) = 12.706, over the root of two.
        let [[middle, _], [low, high]] = estimate(&four.units, f64::NEG_INFINITY);
        assert_eq!(middle, 4.0);
        assert!((high - low - 2.0 * 25.41).abs() < 0.01, "{low} to {high}");
    }

    #[test]
    fn the_interval_of_what_is_never_below_zero_ends_there() {
        let part = |runs: &[(&str, f64)]| Part {
            label: String::new(),
            lines: vec![Line {
                name: String::new(),
                colour: 0,
                marker: 0,
                points: vec![(1.0, Numbers::of(runs))],
            }],
        };
        let trips = part(&[("1", 0.0), ("2", 0.0), ("3", 1.0)]);
        let climb = part(&[("1", 0.0), ("2", -0.1), ("3", 1.0)]);
        let low = |part: &Part| estimate(&part.lines[0].points[0].1.units, part.least())[1][0];
        assert_eq!(low(&trips), 0.0);
        assert!(low(&climb) < -0.5);
    }
}
