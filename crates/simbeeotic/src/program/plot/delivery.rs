//! Delivery and RSSI over distance.

use super::super::Failure;
use super::arguments::DistanceOptions;
use super::axes::{Axis, Panel, grouped, nice};
use super::palette::series;
use super::sheet::{Anchor, FAINT, HEAD, SMALL, Sheet};
use super::source::Sources;
use super::stats::{BINS_MAX, Bins, quantile, wilson};
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

/// Delivery ratio over distance, and below how many frames it is the ratio of.
pub(super) fn delivery(sources: &Sources, options: &DistanceOptions) -> Result<Sheet, Failure> {
    let (bins, caption) = binned(sources, options, BINS, MARGIN)?;
    let [width, height] = options.plot.size();
    let title = options.plot.title("Delivery over distance");
    let mut sheet = Sheet::titled(width, height, title, &caption);
    let (upper, lower) = panels(
        &sheet,
        &bins,
        Axis::exact("delivery ratio", 0.0, 1.0, 5.0),
        most(&bins, |bin| bin.sent),
    );
    upper.draw(&mut sheet, false);
    lower.draw(&mut sheet, true);
    counts(&mut sheet, &lower, &bins, |bin| bin.sent);

    let blue = series(0);
    let seen = || bins.bins.iter().enumerate().filter(|(_, bin)| bin.sent > 0);
    let share = |place: usize| bins.bins[place].received as f64 / bins.bins[place].sent as f64;
    let curve = seen().map(|(place, _)| upper.place(bins.middle_m(place), share(place)));
    sheet.line(curve.collect(), blue.thin(0.35), 1.8);
    for (place, bin) in seen() {
        let middle = bins.middle_m(place);
        let [low, high] = wilson(bin.received, bin.sent);
        let [low, high] = [low, high].map(|share| upper.place(middle, share));
        sheet.line(vec![low, high], blue, 1.4);
        for [x, y] in [low, high] {
            sheet.line(vec![[x - 4.0, y], [x + 4.0, y]], blue, 1.4);
        }
        sheet.disc(upper.place(middle, share(place)), 4.2, blue, 1.0);
    }
    let [_, top, right, _] = upper.edges;
    let key = "received over sent; bars: Wilson's 95 % interval, if frames are independent";
    sheet.words([right, top - 9.0], key, SMALL, Anchor::End, FAINT);
    Ok(sheet)
}

/// RSSI of what was received over distance.
pub(super) fn rssi(sources: &Sources, options: &DistanceOptions) -> Result<Sheet, Failure> {
    let (mut bins, caption) = binned(sources, options, BINS_RSSI, 1.0)?;
    let dots = scattered(sources)?;
    if dots.is_empty() {
        return Err(Failure::input(format!(
            "{} has links, but nothing was received at these times: there is no RSSI",
            sources.first().file()
        )));
    }
    for bin in &mut bins.bins {
        bin.rssi_dbm.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let [width, height] = options.plot.size();
    let title = options.plot.title("RSSI over distance");
    let mut sheet = Sheet::titled(width, height, title, &caption);
    let levels = || dots.iter().map(|dot| dot[1]);
    let low = levels().fold(f64::INFINITY, f64::min);
    let high = levels().fold(f64::NEG_INFINITY, f64::max);
    let (upper, lower) = panels(
        &sheet,
        &bins,
        Axis::stretched("RSSI, dBm", low - 1.0, high + 1.0, 6.0),
        most(&bins, |bin| bin.received),
    );
    upper.draw(&mut sheet, false);
    lower.draw(&mut sheet, true);
    counts(&mut sheet, &lower, &bins, |bin| bin.received);

    let (blue, orange) = (series(0), series(3));
    for [distance, level] in &dots {
        sheet.disc(upper.place(*distance, *level), 2.2, blue.thin(0.25), 0.0);
    }
    let at = |share: f64| -> Vec<[f64; 2]> {
        let places = bins.bins.iter().enumerate();
        let levels = places.filter_map(|(place, bin)| {
            let level = quantile(&bin.rssi_dbm, share)?;
            Some(upper.place(bins.middle_m(place), level))
        });
        levels.collect()
    };
    for share in [0.05, 0.95] {
        sheet.line(at(share), orange.thin(0.7), 1.2);
    }
    sheet.line(at(0.5), orange, 2.4);
    let [_, top, right, _] = upper.edges;
    let key = "dots: a link's mean in a period; lines: median, 5 % and 95 % of what was received";
    sheet.words([right, top - 9.0], key, SMALL, Anchor::End, FAINT);
    Ok(sheet)
}

/// The links by distance, and what the picture is of.
fn binned(
    sources: &Sources,
    options: &DistanceOptions,
    count: f64,
    margin: f64,
) -> Result<(Bins, String), Failure> {
    let links = sources.links()?;
    let all = || links.iter().flat_map(|l| &l.links);
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
    let mut bins = Bins::new(width_m, reach_m);
    links.iter().for_each(|links| bins.add(links));
    let caption = caption(sources, &links, &bins);
    Ok((bins, caption))
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

fn caption(sources: &Sources, links: &[Links], bins: &Bins) -> String {
    let last = links.last().map_or(0, |l| l.time_ns);
    let first = links.first().map_or(0, |l| {
        l.time_ns.saturating_sub((l.period_s * 1e9).round() as u64)
    });
    let radios = links.iter().map(|l| l.radios.len()).max().unwrap_or(0);
    let sum = |part: fn(&super::stats::Bin) -> u64| -> String {
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

/// The mean RSSI of links and periods over their distance; every n-th if there are too many.
fn scattered(sources: &Sources) -> Result<Vec<[f64; 2]>, Failure> {
    let links = sources.links()?;
    let heard = links.iter().flat_map(|l| &l.links);
    let heard = heard.filter(|link| link.received > 0 && link.rssi_dbm.is_finite());
    let dots: Vec<[f64; 2]> = heard
        .map(|link| [f64::from(link.distance_m), f64::from(link.rssi_dbm)])
        .collect();
    let step = dots.len().div_ceil(DOTS_MAX).max(1);
    Ok(dots.into_iter().step_by(step).collect())
}

fn most(bins: &Bins, part: fn(&super::stats::Bin) -> u64) -> u64 {
    bins.bins.iter().map(part).max().unwrap_or(0)
}

/// The large panel, and the small one with the numbers of frames below it.
fn panels(sheet: &Sheet, bins: &Bins, y: Axis, most: u64) -> (Panel, Panel) {
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let (left, right, bottom) = (96.0, width - 28.0, height - 62.0);
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
fn counts(sheet: &mut Sheet, panel: &Panel, bins: &Bins, part: fn(&super::stats::Bin) -> u64) {
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
