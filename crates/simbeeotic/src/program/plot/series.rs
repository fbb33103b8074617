//! Numbers over time: a line each, or their mean with a band, of one run or of several.

use super::super::{Failure, remark};
use super::arguments::{BandKind, SeriesOptions};
use super::axes::{Axis, Panel};
use super::band::{Mean, averaged, means, of_seeds, times};
use super::limits::Limits;
use super::lines::simplified;
use super::map::Column;
use super::palette::{dashes, series};
use super::quantity::{Curve, Quantity, read};
use super::sheet::{HEAD, Ink, Sheet, TEXT};
use super::source::Sources;
use super::sweep::{Group, groups};
use super::traces::COLOURS;

/// More lines than these are drawn as a band, unless all are asked for.
const LINES_MAX: usize = COLOURS;

/// Dash and gap of what was true, pixels.
const TRUTH: [f64; 2] = [5.0, 4.0];

/// A line of the picture, or a mean with its band.
struct Drawn {
    name: String,
    ink: Ink,
    alpha: f64,
    width: f64,
    dash: Option<[f64; 2]>,
    holds: bool,
    means: Vec<Mean>,
    /// Which quantity it is of.
    quantity: usize,
}

/// The picture.
pub(super) fn series_plot(sources: &Sources, options: &SeriesOptions) -> Result<Sheet, Failure> {
    let (heads, drawn, what) = match sources.all() {
        [_] => one(sources, options)?,
        _ => several(sources, options)?,
    };
    let spans = drawn.iter().flat_map(|line| &line.means).map(|m| m.time_s);
    let first = spans.clone().fold(f64::INFINITY, f64::min);
    let last = spans.fold(f64::NEG_INFINITY, f64::max);
    let nanos = |time_s: f64| (time_s.max(0.0) * 1e9).round() as u64;
    let [width, height] = options.plot.size();
    let title = match heads.as_slice() {
        [one] => capital(&one.name),
        _ => "Over time".to_owned(),
    };
    let caption = sources.caption(nanos(first), nanos(last), &what);
    let mut sheet = Sheet::titled(width, height, options.plot.title(&title), &caption);
    draw(&mut sheet, &heads, &drawn, [first, last]);
    Ok(sheet)
}

/// A sentence begins with a capital.
pub(super) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    match letters.next() {
        Some(first) if !text.contains(['/', ':', '*']) => {
            first.to_uppercase().chain(letters).collect()
        }
        _ => text.to_owned(),
    }
}

type Lines = (Vec<Quantity>, Vec<Drawn>, String);

/// One run: each line, or a band over all that match.
fn one(sources: &Sources, options: &SeriesOptions) -> Result<Lines, Failure> {
    let numbers = &options.numbers;
    if numbers.by.is_some() {
        remark("note: --by sets several recordings apart, and there is one");
    }
    let quantities = read(sources.first(), &numbers.metric, &numbers.models)?;
    let mut drawn = Vec::new();
    let mut what = Vec::new();
    let all: usize = quantities.iter().map(|q| q.curves.len()).sum();
    for (at, quantity) in quantities.iter().enumerate() {
        let count = quantity.curves.len();
        let banded = options.band.is_some() || (!options.each && all > LINES_MAX && count > 1);
        if banded {
            let kind = options.band.unwrap_or(BandKind::Quantile);
            let ink = series(at);
            let unit = &quantity.unit;
            let alone = quantities.iter().filter(|q| q.unit == *unit).count() == 1;
            let mut cut = [false; 2];
            let mut add = |curves: &[Curve], dashed: bool, kind: BandKind| {
                let means = means(curves, &times(curves.iter()), kind);
                drawn.push(Drawn {
                    name: match dashed {
                        true => "truth".to_owned(),
                        false if alone => format!("mean of {count}"),
                        false => format!("{}, mean of {count}", quantity.name),
                    },
                    ink: if dashed { TEXT } else { ink },
                    alpha: 1.0,
                    width: if dashed { 1.2 } else { 2.2 },
                    dash: dashed.then_some(TRUTH),
                    holds: false,
                    means: within(means, quantity.limits(), &mut cut),
                    quantity: at,
                });
            };
            add(&quantity.curves, false, kind);
            if options.truth && !quantity.truth.is_empty() {
                add(&quantity.truth, true, BandKind::None);
            }
            what.push(format!(
                "mean of {count}{}{}{}",
                quantity.without(),
                said(kind),
                quantity.limits().said(cut)
            ));
            continue;
        }
        // A line alone among many others is seen as well as a mean.
        let many = all > LINES_MAX && count > 1;
        let before: usize = quantities[..at].iter().map(|q| q.curves.len()).sum();
        for (line, curve) in quantity.curves.iter().enumerate() {
            let place = match all > LINES_MAX {
                true => at,
                false => before + line,
            };
            let name = match (many, line, quantities.len()) {
                (true, 0, _) => format!("{} ({count})", quantity.name),
                (true, ..) => String::new(),
                (false, _, 1) => curve.who.clone(),
                (false, ..) if count == 1 && curve.who == "all radios" => quantity.name.clone(),
                _ => line_name(&quantity.name, &curve.who),
            };
            let ink = series(place);
            let (width, alpha) = if many {
                (1.0, (12.0 / count as f64).clamp(0.12, 0.8))
            } else {
                (1.8, 1.0)
            };
            drawn.push(line_of(curve, at, name, ink, alpha, width, false));
            let truth = quantity.truth.iter().find(|truth| truth.who == curve.who);
            if let Some(truth) = truth.filter(|_| options.truth) {
                let name = match line {
                    0 => "truth".to_owned(),
                    _ => String::new(),
                };
                drawn.push(line_of(truth, at, name, TEXT, alpha, 1.1, true));
            }
        }
        what.push(match count {
            1 => quantity.curves[0].who.clone(),
            n => format!("{n} lines{}", quantity.without()),
        });
    }
    if options.truth && quantities.iter().all(|q| q.truth.is_empty()) {
        remark("note: --truth is of what sensors read; nothing of this is");
    }
    what.dedup();
    Ok((quantities, drawn, what.join("; ")))
}

/// A line among those of other quantities: `drift of bee-1`. What has a path of its own, `bee-1/drift`, is
/// called by that of its owner.
fn line_name(quantity: &str, who: &str) -> String {
    let ending = quantity.rsplit_once(':').map_or(quantity, |(name, _)| name);
    match who.strip_suffix(ending) {
        Some("") => quantity.to_owned(),
        Some(above) if above.ends_with('/') => {
            format!("{quantity} of {}", above.trim_end_matches('/'))
        }
        _ => format!("{quantity} of {who}"),
    }
}

fn line_of(
    curve: &Curve,
    quantity: usize,
    name: String,
    ink: Ink,
    alpha: f64,
    width: f64,
    dashed: bool,
) -> Drawn {
    let mean = |[time_s, mean]: &[f64; 2]| Mean {
        time_s: *time_s,
        mean: *mean,
        band: None,
    };
    Drawn {
        name,
        ink,
        alpha,
        width,
        dash: dashed.then_some(TRUTH),
        holds: curve.holds,
        means: curve.points.iter().map(mean).collect(),
        quantity,
    }
}

/// Means whose bands stay within what there can be; notes at which ends they were cut.
fn within(mut means: Vec<Mean>, limits: Limits, cut: &mut [bool; 2]) -> Vec<Mean> {
    for mean in &mut means {
        let Some(band) = mean.band else { continue };
        let (kept, _) = limits.cut(band);
        cut[0] |= kept[0] != band[0];
        cut[1] |= kept[1] != band[1];
        mean.band = Some(kept);
    }
    means
}

/// What a band is, in words.
pub(super) fn said(kind: BandKind) -> &'static str {
    match kind {
        BandKind::MinMax => ", band: least to greatest",
        BandKind::Quantile => ", band: 5 % to 95 %",
        BandKind::Confidence => ", band: 95 % confidence of the mean",
        BandKind::None => "",
    }
}

/// Several runs: of each the mean over all that match, and over the runs of a group their mean.
fn several(sources: &Sources, options: &SeriesOptions) -> Result<Lines, Failure> {
    let numbers = &options.numbers;
    let kind = options.band.unwrap_or(BandKind::Confidence);
    let mut heads: Vec<Quantity> = Vec::new();
    let mut drawn = Vec::new();
    let groups = groups(sources, numbers.by.as_deref())?;
    let mut bounds: Vec<Option<Limits>> = vec![None; numbers.metric.len()];
    let mut cut = vec![[false; 2]; numbers.metric.len()];
    let mut later = Vec::new();
    for (place, group) in groups.iter().enumerate() {
        let mut runs: Vec<Vec<(Option<u64>, Curve)>> = vec![Vec::new(); numbers.metric.len()];
        for source in &group.runs {
            let quantities = read(source, &numbers.metric, &numbers.models)?;
            for (at, mut quantity) in quantities.into_iter().enumerate() {
                let curves = std::mem::take(&mut quantity.curves);
                match heads.get(at) {
                    Some(head) if head.unit != quantity.unit => {
                        return Err(Failure::input(format!(
                            "{} is in {:?} in {}, and in {:?} elsewhere",
                            quantity.name,
                            quantity.unit,
                            source.file(),
                            head.unit
                        )));
                    }
                    Some(_) => {}
                    None => heads.push(quantity),
                }
                let run = averaged(&curves, &times(curves.iter()));
                let limits = Limits::of(&heads[at].name, &heads[at].unit, values(&run));
                bounds[at] = Some(bounds[at].map_or(limits, |other: Limits| other.or(limits)));
                runs[at].push((source.recording.seed(), run));
            }
        }
        let ends = group.runs.iter().map(|run| run.recording.end_ns());
        let end_s = ends.clone().min().unwrap_or(u64::MAX) as f64 * 1e-9;
        if !options.each && ends.max().unwrap_or(0) as f64 * 1e-9 > end_s + 1e-9 {
            remark(format!(
                "note: these runs are of different length; their mean ends with the shortest, at {end_s} s"
            ));
        }
        for (at, runs) in runs.into_iter().enumerate() {
            let n = runs.len();
            // Where a panel has one quantity, its axis names it.
            let unit = &heads[at].unit;
            let alone = heads.iter().filter(|head| head.unit == *unit).count() == 1;
            let name = match (group.name.as_str(), alone) {
                ("", true) => String::new(),
                ("", false) => format!("{}, {n} runs", heads[at].name),
                (name, true) => name.to_owned(),
                (name, false) => format!("{}, {name}", heads[at].name),
            };
            let ink = match alone {
                true => series(place),
                false => series(place * heads.len() + at),
            };
            if options.each {
                for (run, (_, curve)) in runs.iter().enumerate() {
                    let name = if run == 0 {
                        name.clone()
                    } else {
                        String::new()
                    };
                    drawn.push(line_of(curve, at, name, ink, 0.7, 1.2, false));
                }
                continue;
            }
            let runs = of_seeds(runs);
            let mut times = times(runs.iter());
            // Behind the end of the shortest run the mean would be of others.
            times.retain(|time_s| *time_s <= end_s + 1e-9);
            drawn.push(Drawn {
                name,
                ink,
                alpha: 1.0,
                width: 2.2,
                dash: dashes(if alone {
                    place
                } else {
                    place * heads.len() + at
                }),
                holds: false,
                means: means(&runs, &times, kind),
                quantity: at,
            });
            later.push(drawn.len() - 1);
        }
    }
    // What there can be is known when all runs are.
    for line in later {
        let at = drawn[line].quantity;
        let means = std::mem::take(&mut drawn[line].means);
        drawn[line].means = within(means, bounds[at].unwrap_or(Limits::NONE), &mut cut[at]);
    }
    let cuts: Vec<String> = (bounds.iter().zip(&cut))
        .map(|(limits, cut)| limits.unwrap_or(Limits::NONE).said(*cut))
        .filter(|text| !text.is_empty())
        .collect();
    let lone = groups.iter().filter(|group| group.runs.len() == 1).count();
    let mut what = match options.each {
        true => "mean of each run".to_owned(),
        false => format!(
            "mean over {}{}{}{}",
            match groups.iter().find_map(Group::seeds) {
                Some(_) => "seeds, of each that over its runs",
                None => "runs",
            },
            heads.first().map_or(String::new(), Quantity::without),
            said(kind),
            cuts.first().map_or("", String::as_str)
        ),
    };
    if lone > 0 && !options.each && kind != BandKind::None {
        what += "; of one run alone there is no band";
    }
    Ok((heads, drawn, what))
}

/// The values of a curve.
fn values(curve: &Curve) -> impl Iterator<Item = f64> {
    curve.points.iter().map(|[_, value]| *value)
}

/// A panel for each unit, one below the other.
fn draw(sheet: &mut Sheet, heads: &[Quantity], drawn: &[Drawn], [first, last]: [f64; 2]) {
    let mut units: Vec<&str> = Vec::new();
    for head in heads {
        if !units.contains(&head.unit.as_str()) {
            units.push(&head.unit);
        }
    }
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let named = drawn.iter().filter(|line| !line.name.is_empty()).count();
    let legend = if named > 1 { sheet.key_room() } else { 8.0 };
    let (top, bottom) = (HEAD + 10.0, height - 62.0);
    let each = (bottom - top + 22.0) / units.len() as f64;
    let x = Axis::exact("time, s", first, last, (width - legend) / 90.0);
    for (row, unit) in units.iter().enumerate() {
        let mine = |line: &&Drawn| heads[line.quantity].unit == **unit;
        let values = || {
            let lines = drawn.iter().filter(mine).flat_map(|line| &line.means);
            lines.flat_map(|m| {
                [
                    m.mean,
                    m.band.map_or(m.mean, |b| b[0]),
                    m.band.map_or(m.mean, |b| b[1]),
                ]
            })
        };
        let low = values().fold(f64::INFINITY, f64::min);
        let high = values().fold(f64::NEG_INFINITY, f64::max);
        let of: Vec<&Quantity> = heads.iter().filter(|head| head.unit == **unit).collect();
        let limits = of
            .iter()
            .map(|head| Limits::of(&head.name, &head.unit, values()));
        let limits = limits.reduce(Limits::or).unwrap_or(Limits::NONE);
        let label = match of.as_slice() {
            [one] => one.label(),
            several => {
                let mut names: Vec<&str> = several.iter().map(|q| q.short()).collect();
                names.dedup();
                match *unit {
                    "" => names.join(", "),
                    unit => format!("{}, {unit}", names.join(", ")),
                }
            }
        };
        let top = top + row as f64 * each;
        let panel = Panel {
            edges: [96.0, top, width - legend - 24.0, top + each - 22.0],
            x: x.clone(),
            y: value_axis(label, [low, high], (each / 70.0).max(2.0), limits),
        };
        panel.draw(sheet, row + 1 == units.len());
        for line in drawn.iter().filter(mine) {
            line.draw(sheet, &panel);
        }
        if named > 1 {
            let mut column = Column::beside(&panel);
            let names = drawn
                .iter()
                .filter(mine)
                .filter(|line| !line.name.is_empty());
            for line in names {
                if column.room() == 0 {
                    column.say(sheet, "...", TEXT);
                    break;
                }
                let width = if line.dash == Some(TRUTH) { 1.3 } else { 2.4 };
                column.line_with(sheet, line.ink, width, line.dash, &line.name);
            }
        }
    }
}

/// An axis that holds values, and zero if that is near, and nothing that cannot be.
pub(super) fn value_axis(label: String, ends: [f64; 2], ticks: f64, limits: Limits) -> Axis {
    let [low, high] = match ends[0] <= ends[1] {
        true => ends,
        false => [0.0, 1.0],
    };
    let near = high - low;
    let low = if low >= 0.0 && low <= near { 0.0 } else { low };
    let high = if high <= 0.0 && -high <= near {
        0.0
    } else {
        high
    };
    let (low, high) = match high - low > 1e-12 * (low.abs() + high.abs()) {
        true => (low, high),
        // All are the same.
        false => (
            low - 0.5 * low.abs().max(1.0),
            low + 0.5 * low.abs().max(1.0),
        ),
    };
    let (low, high) = (low.max(limits.least), high.min(limits.most));
    let mut axis = Axis::stretched(label, low, high, ticks);
    axis.high = axis.high.min(limits.most);
    axis
}

impl Drawn {
    fn draw(&self, sheet: &mut Sheet, panel: &Panel) {
        // Where a band is known without a break.
        for part in self
            .means
            .chunk_by(|a, b| a.band.is_some() == b.band.is_some())
        {
            let edge = |end: usize| {
                let points = part
                    .iter()
                    .filter_map(move |m| Some((m.time_s, m.band?[end])));
                let points: Vec<_> = points.map(|(t, value)| panel.place(t, value)).collect();
                simplified(&points, 0.25)
            };
            let (low, mut high) = (edge(0), edge(1));
            if low.len() >= 2 {
                high.reverse();
                sheet.area([low, high].concat(), self.ink.thin(0.2));
            }
        }
        let mut points: Vec<[f64; 2]> = Vec::with_capacity(self.means.len());
        for mean in &self.means {
            let next = panel.place(mean.time_s, mean.mean);
            if self.holds
                && let Some(last) = points.last()
            {
                points.push([next[0], last[1]]);
            }
            points.push(next);
        }
        let points = simplified(&points, 0.25);
        let ink = self.ink.thin(self.alpha);
        match points.as_slice() {
            [one] => sheet.disc(*one, 3.5, ink, 0.0),
            _ => sheet.line_with(points, ink, self.width, self.dash),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_goes_nowhere_where_nothing_can_be() {
        let share = Limits::of("delivery", "", [1.0].into_iter());
        let axis = value_axis(String::new(), [1.0, 1.0], 5.0, share);
        assert_eq!((axis.low, axis.high), (0.5, 1.0));
        let axis = value_axis(String::new(), [0.93, 0.999], 5.0, share);
        assert_eq!(axis.high, 1.0);
        let count = Limits::of("trips", "", [1.0].into_iter());
        let axis = value_axis(String::new(), [0.0, 0.0], 5.0, count);
        assert!(axis.low == 0.0 && axis.high > 0.0, "{axis:?}");
    }

    #[test]
    fn a_line_says_once_what_it_is_of_and_whose() {
        for (quantity, who, name) in [
            ("drift", "p-bee/drift", "drift of p-bee"),
            (
                "work/drift",
                "hive/p-bee/work/drift",
                "work/drift of hive/p-bee",
            ),
            ("p-bee/drift", "p-bee/drift", "p-bee/drift"),
            ("drift", "drift", "drift"),
            ("compass:heading", "bee/compass", "compass:heading of bee"),
            ("speed", "bee-1", "speed of bee-1"),
            ("bee", "wild-bee", "bee of wild-bee"),
            ("*/drift", "p-bee/drift", "*/drift of p-bee/drift"),
        ] {
            assert_eq!(line_name(quantity, who), name);
        }
    }
}
