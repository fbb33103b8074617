//! Delivery and RSSI over distance.

use super::super::Failure;
use super::arguments::DistanceOptions;
use super::axes::{Axis, Panel, grouped, nice};
use super::band::{half_width, mean, units};
use super::chart::{Curve, MARKERS, curve_band, curve_line, curve_mark, curve_whiskers};
use super::map::Column;
use super::palette::{dashes, series};
use super::sheet::{HEAD, Sheet};
use super::source::{Source, Sources};
use super::stats::{BINS_MAX, Bin, Bins, quantile, wilson};
use super::sweep::groups;
use simbeeotic_record::{Link, Links};
use simbeeotic_units::Length;

/// About so many bins, unless their width is said.
const BINS: f64 = 30.0;
/// RSSI falls steeply within a bin: narrow ones spread less.
const BINS_RSSI: f64 = 60.0;
/// How far beyond the farthest reception delivery is drawn.
const MARGIN: f64 = 1.2;
/// Of more dots a picture is not clearer.
const DOTS_MAX: usize = 4000;

/// The frames of some runs by distance.
struct Runs {
    /// Of each run its seed and its frames.
    each: Vec<(Option<u64>, Bins)>,
    all: Bins,
    /// Of links and periods their distance and RSSI.
    dots: Vec<[f64; 2]>,
}

/// Delivery ratio over distance, and below how many frames it is the ratio of.
pub(super) fn delivery(sources: &Sources, options: &DistanceOptions) -> Result<Sheet, Failure> {
    let groups = groups(sources, options.by.as_deref())?;
    let (runs, caption) = binned(sources, options, BINS, MARGIN)?;
    let [width, height] = options.plot.size();
    let title = options.plot.title("Delivery over distance");
    let mut sheet = Sheet::titled(width, height, title, &caption);
    let (upper, lower) = panels(
        &sheet,
        &runs.all,
        Axis::exact("delivery ratio", 0.0, 1.0, 5.0),
        most(&runs.all, |bin| bin.sent),
        groups.len() > 1,
    );
    upper.draw(&mut sheet, false);
    lower.draw(&mut sheet, true);
    counts(&mut sheet, &lower, &runs.all, |bin| bin.sent);

    let mut column = Column::beside(&upper);
    let curves: Vec<Curve> = (groups.iter().enumerate())
        .map(|(place, group)| {
            let mine: Vec<_> = group.places.iter().map(|at| &runs.each[*at]).collect();
            curve(&mine, place, &group.name)
        })
        .collect();
    for (curve, group) in curves.iter().zip(&groups) {
        match group.runs.len() {
            0 | 1 => curve_whiskers(&mut sheet, &upper, curve),
            _ => curve_band(&mut sheet, &upper, curve),
        }
    }
    for curve in &curves {
        curve_line(&mut sheet, &upper, curve);
        if groups.len() > 1 {
            column.mark(&mut sheet, &curve.name, |sheet, [x, y]| {
                sheet.line(vec![[x - 12.0, y], [x + 12.0, y]], curve.ink, 1.8);
                curve_mark(sheet, curve.marker, curve.ink, [x, y]);
            });
        }
    }
    said(
        &mut sheet,
        &upper,
        spreads(groups.iter().map(|group| group.runs.len())),
    );
    Ok(sheet)
}

/// What the bands and bars are, of groups of so many runs.
fn spreads(groups: impl Iterator<Item = usize>) -> &'static str {
    let (one, several): (Vec<_>, Vec<_>) = groups.partition(|runs| *runs < 2);
    match (one.is_empty(), several.is_empty()) {
        (true, _) => "mean over runs, and where it is with 95 % confidence",
        (false, true) => {
            "received over sent; bars: Wilson's 95 % interval, if frames are independent"
        }
        (false, false) => {
            "mean over runs, and where it is with 95 % confidence; bars, of one run: Wilson's interval"
        }
    }
}

/// The delivery ratios of some runs.
fn curve(runs: &[&(Option<u64>, Bins)], place: usize, name: &str) -> Curve {
    let count = runs
        .iter()
        .map(|(_, bins)| bins.bins.len())
        .max()
        .unwrap_or(0);
    let known = (0..count).filter_map(|bin| {
        let (middle, ends) = ratio(runs, bin)?;
        Some(([runs[0].1.middle_m(bin), middle], ends))
    });
    let (points, spread) = known.unzip();
    Curve {
        name: name.to_owned(),
        ink: series(place),
        marker: MARKERS[place % MARKERS.len()],
        points,
        spread,
        line: Some(1.8),
    }
}

/// The delivery ratio in a bin, and its 95 % interval: of one run by Wilson, of several of their mean, by Student,
/// unless only one of them sent there. `None` if nothing was sent.
fn ratio(runs: &[&(Option<u64>, Bins)], bin: usize) -> Option<(f64, Option<[f64; 2]>)> {
    let bins = runs
        .iter()
        .filter_map(|(seed, bins)| Some((*seed, bins.bins.get(bin)?)));
    let sent: Vec<_> = bins.filter(|(_, bin)| bin.sent > 0).collect();
    let share = |bin: &Bin| bin.received as f64 / bin.sent as f64;
    if let ([(_, bin)], 1) = (sent.as_slice(), runs.len()) {
        return Some((share(bin), Some(wilson(bin.received, bin.sent))));
    }
    let shares: Vec<_> = sent.iter().map(|(seed, bin)| (*seed, share(bin))).collect();
    let shares = units(&shares);
    let middle = mean(&shares)?;
    let ends = half_width(&shares).map(|half| [(middle - half).max(0.0), (middle + half).min(1.0)]);
    Some((middle, ends))
}

/// RSSI of what was received over distance.
pub(super) fn rssi(sources: &Sources, options: &DistanceOptions) -> Result<Sheet, Failure> {
    let groups = groups(sources, options.by.as_deref())?;
    let (runs, caption) = binned(sources, options, BINS_RSSI, 1.0)?;
    if runs.dots.is_empty() {
        return Err(Failure::input(format!(
            "{} has links, but nothing was received at these times: there is no RSSI",
            sources.first().file()
        )));
    }
    let [width, height] = options.plot.size();
    let title = options.plot.title("RSSI over distance");
    let mut sheet = Sheet::titled(width, height, title, &caption);
    let levels = || runs.dots.iter().map(|dot| dot[1]);
    let low = levels().fold(f64::INFINITY, f64::min);
    let high = levels().fold(f64::NEG_INFINITY, f64::max);
    let (upper, lower) = panels(
        &sheet,
        &runs.all,
        Axis::stretched("RSSI, dBm", low - 1.0, high + 1.0, 6.0),
        most(&runs.all, |bin| bin.received),
        groups.len() > 1,
    );
    upper.draw(&mut sheet, false);
    lower.draw(&mut sheet, true);
    counts(&mut sheet, &lower, &runs.all, |bin| bin.received);
    if groups.len() > 1 {
        let mut column = Column::beside(&upper);
        for (place, group) in groups.iter().enumerate() {
            let levels = Levels::of(group.places.iter().map(|at| &runs.each[*at].1), &upper);
            let ink = series(place);
            let band = levels.low.iter().chain(levels.high.iter().rev());
            sheet.area(band.copied().collect(), ink.thin(0.15));
            sheet.line_with(levels.middle, ink, 2.4, dashes(place));
            column.line_with(&mut sheet, ink, 2.4, dashes(place), &group.name);
        }
        said(
            &mut sheet,
            &upper,
            "median, and 5 % to 95 % of what was received",
        );
        return Ok(sheet);
    }
    let (blue, orange) = (series(0), series(3));
    for [distance, level] in thinned(&runs.dots) {
        sheet.disc(upper.place(distance, level), 2.2, blue.thin(0.25), 0.0);
    }
    let levels = Levels::of(runs.each.iter().map(|(_, bins)| bins), &upper);
    for line in [levels.low, levels.high] {
        sheet.line(line, orange.thin(0.7), 1.2);
    }
    sheet.line(levels.middle, orange, 2.4);
    said(
        &mut sheet,
        &upper,
        "dots: a link's mean in a period; lines: median, 5 % and 95 % of what was received",
    );
    Ok(sheet)
}

/// Quantiles of RSSI over distance, pixels.
struct Levels {
    low: Vec<[f64; 2]>,
    middle: Vec<[f64; 2]>,
    high: Vec<[f64; 2]>,
}

impl Levels {
    /// Of all frames of some runs together.
    fn of<'b>(runs: impl Iterator<Item = &'b Bins>, panel: &Panel) -> Self {
        let runs: Vec<&Bins> = runs.collect();
        let count = runs.iter().map(|bins| bins.bins.len()).max().unwrap_or(0);
        let mut levels = Self {
            low: Vec::new(),
            middle: Vec::new(),
            high: Vec::new(),
        };
        for bin in 0..count {
            let all = runs.iter().filter_map(|bins| bins.bins.get(bin));
            let mut all: Vec<(f32, u32)> = all.flat_map(|bin| &bin.rssi_dbm).copied().collect();
            all.sort_by(|a, b| a.0.total_cmp(&b.0));
            for (line, share) in [
                (&mut levels.low, 0.05),
                (&mut levels.middle, 0.5),
                (&mut levels.high, 0.95),
            ] {
                let level = quantile(&all, share);
                line.extend(level.map(|level| panel.place(runs[0].middle_m(bin), level)));
            }
        }
        levels
    }
}

/// What is drawn, above a panel at its right.
fn said(sheet: &mut Sheet, panel: &Panel, text: &str) {
    let [_, top, right, _] = panel.edges;
    sheet.note([right, top - 9.0], text);
}

/// The links by distance, and what the picture is of.
fn binned(
    sources: &Sources,
    options: &DistanceOptions,
    count: f64,
    margin: f64,
) -> Result<(Runs, String), Failure> {
    let links = sources.all().iter().map(Source::links);
    let links: Vec<Vec<Links>> = links.collect::<Result<_, _>>()?;
    let all = || links.iter().flatten().flat_map(|l| &l.links);
    let farthest = |m: f64, link: &Link| m.max(f64::from(link.distance_m));
    let farthest_m = all().fold(0.0, farthest);
    let heard_m = all().filter(|link| link.received > 0).fold(0.0, farthest);
    let reach_m = match heard_m > 0.0 {
        true => farthest_m.min(heard_m * margin),
        false => farthest_m,
    };
    let width_m = match &options.bin {
        None => nice((reach_m / count).max(1e-3)),
        Some(text) => bin_width(text, reach_m)?,
    };
    let none = || Bins::new(width_m, reach_m);
    let each = (sources.all().iter().zip(&links))
        .map(|(source, links)| (source.recording.seed(), filled(none(), links.iter())))
        .collect();
    let pooled = filled(none(), links.iter().flatten());
    let heard = all().filter(|link| link.received > 0 && link.rssi_dbm.is_finite());
    let dots = heard.map(|link| [f64::from(link.distance_m), f64::from(link.rssi_dbm)]);
    let caption = caption(sources, &links, &pooled);
    let runs = Runs {
        each,
        dots: dots.collect(),
        all: pooled,
    };
    Ok((runs, caption))
}

/// Bins with the frames of some periods.
fn filled<'l>(mut bins: Bins, links: impl Iterator<Item = &'l Links>) -> Bins {
    links.for_each(|links| bins.add(links));
    bins
}

fn bin_width(text: &str, reach_m: f64) -> Result<f64, Failure> {
    let width: Length = text
        .parse()
        .map_err(|error| Failure::input(format!("--bin: {error}")))?;
    let width_m = width.metres();
    if width_m > 0.0 && reach_m / width_m < BINS_MAX as f64 {
        return Ok(width_m);
    }
    Err(Failure::input(format!(
        "--bin {width}: it must be more than zero, and at most {BINS_MAX} of them reach as far as the \
         receptions, {reach_m:.1} m"
    )))
}

/// From when to when there are links: the earliest and the latest of all runs, ns.
fn times_ns(runs: &[Vec<Links>]) -> [u64; 2] {
    let all = || runs.iter().flatten();
    let begins = all().map(|l| (l.time_ns).saturating_sub((l.period_s * 1e9).round() as u64));
    let ends = all().map(|l| l.time_ns);
    [begins.min().unwrap_or(0), ends.max().unwrap_or(0)]
}

fn caption(sources: &Sources, runs: &[Vec<Links>], bins: &Bins) -> String {
    let [first, last] = times_ns(runs);
    let radios = runs.iter().flatten().map(|l| l.radios.len());
    let radios = radios.max().unwrap_or(0);
    let sum = |part: fn(&Bin) -> u64| -> String {
        grouped(&bins.bins.iter().map(part).sum::<u64>().to_string())
    };
    let mut more = format!(
        "{radios} radios, {} of {} possible receptions",
        sum(|bin| bin.received),
        sum(|bin| bin.sent)
    );
    if bins.beyond > 0 {
        more += &format!(
            "; none of {} farther away",
            grouped(&bins.beyond.to_string())
        );
    }
    sources.caption(first, last, &more)
}

/// Every n-th of too many.
fn thinned(dots: &[[f64; 2]]) -> impl Iterator<Item = [f64; 2]> {
    let step = dots.len().div_ceil(DOTS_MAX).max(1);
    dots.iter().copied().step_by(step)
}

fn most(bins: &Bins, part: fn(&Bin) -> u64) -> u64 {
    bins.bins.iter().map(part).max().unwrap_or(0)
}

/// The large panel, and the small one with the numbers of frames below it.
fn panels(sheet: &Sheet, bins: &Bins, y: Axis, most: u64, keyed: bool) -> (Panel, Panel) {
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let key = if keyed { sheet.key_room() } else { 4.0 };
    let (left, right, bottom) = (96.0, width - 24.0 - key, height - 62.0);
    let top = HEAD + 24.0;
    let split = top + 0.72 * (bottom - top);
    let x = Axis::exact("distance, m", 0.0, bins.end_m(), 10.0);
    let upper = Panel {
        edges: [left, top, right, split],
        x: x.clone(),
        y,
    };
    let lower = Panel {
        edges: [left, split + 22.0, right, bottom],
        x,
        y: Axis::stretched("frames", 0.0, most.max(1) as f64, 2.0),
    };
    (upper, lower)
}

/// How many frames there are in each bin.
fn counts(sheet: &mut Sheet, panel: &Panel, bins: &Bins, part: fn(&Bin) -> u64) {
    let gap = 0.06 * bins.width_m;
    for (place, bin) in bins.bins.iter().enumerate() {
        let (from, count) = (place as f64 * bins.width_m, part(bin) as f64);
        let low = panel.place(from + gap, 0.0);
        let high = panel.place(from + bins.width_m - gap, count);
        if count > 0.0 {
            sheet.rectangle(low, high, series(0).thin(0.55));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(seed: u64, received: u64, sent: u64) -> (Option<u64>, Bins) {
        let bin = Bin {
            sent,
            received,
            ..Bin::default()
        };
        let mut bins = Bins::new(1.0, 1.0);
        bins.bins = vec![bin];
        (Some(seed), bins)
    }

    #[test]
    fn of_one_run_the_interval_is_of_its_frames_and_of_several_of_their_mean() {
        let runs = [
            run(1, 30, 100),
            run(2, 5, 10),
            run(3, 70, 100),
            run(4, 0, 0),
        ];
        let runs: Vec<_> = runs.iter().collect();
        assert_eq!(ratio(&runs[..1], 0), Some((0.3, Some(wilson(30, 100)))));
        // s = 0.2, t(2) = 4.3027; the last sent nothing.
        let (middle, ends) = ratio(&runs, 0).expect("a ratio");
        let [low, high] = ends.expect("three runs");
        let half = 4.3027 * 0.2 / 3.0_f64.sqrt();
        assert!(
            (middle - 0.5).abs() < 1e-12 && (low - 0.5 + half).abs() < 1e-4,
            "{low}"
        );
        assert!((high - 0.5 - half).abs() < 1e-4, "{high}");
        assert_eq!(ratio(&runs[3..], 0), None);
        assert_eq!(ratio(&runs, 1), None);
    }

    #[test]
    fn where_one_of_several_runs_sent_nothing_is_known_of_the_spread() {
        let runs = [run(1, 5, 10), run(2, 0, 0), run(3, 0, 0)];
        let runs: Vec<_> = runs.iter().collect();
        assert_eq!(ratio(&runs, 0), Some((0.5, None)));
    }

    #[test]
    fn what_is_drawn_of_one_run_is_said_apart_from_what_is_drawn_of_several() {
        let said = |groups: &[usize]| spreads(groups.iter().copied());
        assert!(said(&[3, 2]).starts_with("mean") && !said(&[3, 2]).contains("bars"));
        assert!(said(&[1, 1]).starts_with("received over sent; bars"));
        assert!(said(&[3, 1]).starts_with("mean") && said(&[3, 1]).contains("bars, of one run"));
    }

    #[test]
    fn the_times_are_the_first_and_the_last_of_all_runs() {
        let at = |times_s: &[u64]| -> Vec<Links> {
            let links = times_s.iter().map(|time_s| Links {
                time_ns: time_s * 1_000_000_000,
                period_s: 1.0,
                ..Links::default()
            });
            links.collect()
        };
        // The first run begins late, the last ends early.
        let runs = [at(&[5, 9]), Vec::new(), at(&[2, 6])];
        assert_eq!(times_ns(&runs), [1_000_000_000, 9_000_000_000]);
        assert_eq!(times_ns(&[]), [0, 0]);
    }
}
