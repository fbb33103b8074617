//! Why frames were lost, over time: of one run, or in the mean over several.

mod bars;

use super::super::Failure;
use super::arguments::LossOptions;
use super::axes::{Axis, Panel, grouped, number};
use super::map::{Column, heading};
use super::palette::series;
use super::sheet::{Anchor, FAINT, HEAD, SMALL, Sheet, TEXT, WHITE};
use super::source::{Source, Sources};
use super::sweep::groups;
use bars::{Amount, Bar, Run, Slots, Totals, length_ns};

/// Beyond the range that the medium looks at: no radio would call it a loss.
const OUT_OF_RANGE: &str = "out-of-range";
/// More of them beside each other are too narrow to be read.
const BESIDE_MAX: usize = 6;
/// Of narrower bars the intervals are areas, pixels.
const WHISKER_LEAST: f64 = 5.0;
/// Between two that are beside each other, and above them for their names, pixels.
const GAP: f64 = 32.0;
const NAME: f64 = 22.0;

/// Runs that were made alike, and what they came to.
struct Part {
    /// Empty of the only one.
    name: String,
    bars: Vec<Bar>,
    totals: Totals,
}

/// Losses by reason, stacked, and below the frames sent.
pub(super) fn losses(sources: &Sources, options: &LossOptions) -> Result<Sheet, Failure> {
    let groups = groups(sources, options.by.as_deref())?;
    if groups.len() > BESIDE_MAX {
        return Err(Failure::input(format!(
            "--by {}: it has {} values; {BESIDE_MAX} are the most beside each other",
            options.by.as_deref().unwrap_or_default(),
            groups.len()
        )));
    }
    let read = |source: &Source| run(source, options.radio.as_deref());
    let runs: Vec<Run> = sources.all().iter().map(read).collect::<Result<_, _>>()?;
    of_one_period(sources, &runs)?;
    let mine = |places: &[usize]| places.iter().map(|at| &runs[*at]).collect::<Vec<_>>();
    let totals: Vec<Totals> = (groups.iter())
        .map(|group| Totals::of(&mine(&group.places)))
        .collect();
    let reasons = reasons(&totals, options.all);
    let slots = Slots::of(runs.iter());
    let parts: Vec<Part> = (groups.iter().zip(totals))
        .map(|(group, totals)| Part {
            name: group.name.clone(),
            bars: slots.bars(&mine(&group.places), &reasons),
            totals,
        })
        .collect();

    let several = groups.iter().any(|group| group.runs.len() > 1);
    let what = said(&parts, options, several);
    let times = || runs.iter().flat_map(|run| &run.periods);
    let first = times().map(|t| t.time_ns.saturating_sub(length_ns(t)));
    let last = times().map(|t| t.time_ns).max().unwrap_or(0);
    let caption = sources.caption(first.min().unwrap_or(0), last, &what);
    let [width, height] = options.plot.size();
    let title = options.plot.title("Frames lost, by reason");
    let mut sheet = Sheet::titled(width, height, title, &caption);
    draw(&mut sheet, &parts, slots, &reasons);
    Ok(sheet)
}

/// The reasons that are drawn; the most frequent lies below.
fn reasons(totals: &[Totals], all: bool) -> Vec<String> {
    let mut known: Vec<(String, f64)> = Vec::new();
    for reason in totals.iter().flat_map(Totals::reasons) {
        if (all || reason != OUT_OF_RANGE) && !known.iter().any(|(other, _)| other == reason) {
            let sum = |part: &Totals| part.amount(|sum| sum.lost(reason)).mean;
            known.push((reason.to_owned(), totals.iter().map(sum).sum()));
        }
    }
    known.sort_by(|a, b| b.1.total_cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    known.into_iter().map(|(reason, _)| reason).collect()
}

/// The line below the title.
fn said(parts: &[Part], options: &LossOptions, several: bool) -> String {
    let mut what = options.radio.as_deref().unwrap_or("all radios").to_owned();
    if let [part] = parts {
        let (sent, received) = (
            part.totals.amount(|sum| sum.sent),
            part.totals.amount(|sum| sum.received),
        );
        what += &format!(", {} sent, {} received", told(sent), told(received));
        let beyond = part.totals.amount(|sum| sum.lost(OUT_OF_RANGE));
        if !options.all && beyond.mean > 0.0 {
            what += &format!(", {} out of range (not drawn)", told(beyond));
        }
    }
    if several {
        what += "; means over runs, and where those of all reasons are with 95 % confidence";
    }
    what
}

/// A number of frames as text.
fn told(amount: Amount) -> String {
    let decimals = match amount.half {
        Some(_) if amount.mean < 99.5 => 1,
        _ => 0,
    };
    let plain = |value: f64| {
        let text = format!("{value:.decimals$}");
        match text.split_once('.') {
            Some((whole, rest)) => format!("{}.{rest}", grouped(whole)),
            None => grouped(&text),
        }
    };
    match amount.half {
        Some(half) => format!("{} \u{b1} {}", plain(amount.mean), plain(half)),
        None => plain(amount.mean),
    }
}

fn draw(sheet: &mut Sheet, parts: &[Part], slots: Slots, reasons: &[String]) {
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let (left, bottom) = (96.0, height - 62.0);
    let right = width - sheet.key_room() - 20.0;
    let name = if parts.len() > 1 { NAME } else { 0.0 };
    let top = HEAD + 12.0 + name;
    let split = top + 0.68 * (bottom - top);

    let width_s = slots.width_s();
    let bars = || parts.iter().flat_map(|part| &part.bars);
    let low = bars()
        .map(|bar| start(bar, width_s))
        .fold(f64::INFINITY, f64::min);
    let high = bars().map(|bar| bar.end_s).fold(low, f64::max);
    let [low, high] = if low < high {
        [low, high]
    } else {
        [0.0, width_s]
    };
    let most = |part: fn(&Bar) -> Amount| bars().map(|bar| part(bar).top()).fold(1.0, f64::max);
    let every = number(width_s, width_s / 1000.0);
    let every = every.trim_end_matches('0').trim_end_matches('.').to_owned();
    let count = parts.len() as f64;
    let wide = (right - left + GAP) / count - GAP;
    let x = Axis::exact("time, s", low, high, (wide / 85.0).max(2.0));
    let lost = Axis::stretched(
        format!("lost in {every} s"),
        0.0,
        most(|bar| bar.total),
        6.0,
    );
    let sent = Axis::stretched(format!("sent in {every} s"), 0.0, most(|bar| bar.sent), 2.0);

    for (at, part) in parts.iter().enumerate() {
        let from = left + at as f64 * (wide + GAP);
        let upper = Panel {
            edges: [from, top, from + wide, split],
            x: x.clone(),
            y: lost.clone(),
        };
        let lower = Panel {
            edges: [from, split + 22.0, from + wide, bottom],
            x: x.clone(),
            y: sent.clone(),
        };
        upper.draw_with(sheet, [at == 0, false]);
        lower.draw_with(sheet, [at == 0, true]);
        if parts.len() > 1 {
            heading(sheet, &upper, &part.name);
        }
        stacks(sheet, &upper, &lower, &part.bars, width_s);
    }
    let mut column = Column::at(width, top + 12.0, bottom);
    // From the top down, as they are stacked.
    for (at, reason) in reasons.iter().enumerate().rev() {
        let mut words = reason.replace('-', " ");
        if let [part] = parts {
            let lost = part.totals.amount(|sum| sum.lost(reason));
            words += &format!(": {}", told(lost));
        }
        column.mark(sheet, &words, |sheet, [x, y]| {
            sheet.rectangle([x - 7.0, y - 7.0], [x + 7.0, y + 7.0], series(at));
        });
    }
}

/// A bar is of the time before its end; that of an instant is narrow.
fn start(bar: &Bar, width_s: f64) -> f64 {
    bar.end_s - bar.length_s.max(0.1 * width_s)
}

fn stacks(sheet: &mut Sheet, upper: &Panel, lower: &Panel, bars: &[Bar], width_s: f64) {
    let gap = 0.05 * width_s;
    for bar in bars {
        let (from, to) = (start(bar, width_s) + gap, bar.end_s - gap);
        let mut below = 0.0;
        for (at, lost) in bar
            .lost
            .iter()
            .enumerate()
            .filter(|(_, lost)| lost.mean > 0.0)
        {
            let low = upper.place(from, below);
            let under = below > 0.0;
            below += lost.mean;
            sheet.rectangle(low, upper.place(to, below), series(at));
            if under {
                // Colours of one lightness are told apart in print, too.
                let end = [upper.place(to, 0.0)[0], low[1]];
                sheet.line(vec![low, end], WHITE, 0.8);
            }
        }
        let (low, high) = (lower.place(from, 0.0), lower.place(to, bar.sent.mean));
        sheet.rectangle(low, high, FAINT.thin(0.6));
    }
    for (panel, of) in [
        (upper, (|bar| bar.total) as fn(&Bar) -> Amount),
        (lower, |bar| bar.sent),
    ] {
        for bar in bars {
            let (from, to) = (start(bar, width_s) + gap, bar.end_s - gap);
            let Some([low, high]) = of(bar).ends().filter(|[low, high]| high > low) else {
                continue;
            };
            let (a, b) = (panel.place(from, low), panel.place(to, high));
            if b[0] - a[0] < WHISKER_LEAST {
                sheet.rectangle(a, b, TEXT.thin(0.3));
                continue;
            }
            let middle = 0.5 * (a[0] + b[0]);
            sheet.line(vec![[middle, a[1]], [middle, b[1]]], TEXT.thin(0.85), 1.3);
        }
    }
    if bars.iter().all(|bar| bar.total.mean == 0.0) {
        let [left, top, right, bottom] = upper.edges;
        let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
        sheet.words(middle, "nothing was lost", SMALL, Anchor::Middle, FAINT);
    }
}

/// The counters of a run: of one of its radios, or of all together.
fn run(source: &Source, radio: Option<&str>) -> Result<Run, Failure> {
    let wanted = radio.unwrap_or("");
    let mut radios = Vec::new();
    let mut periods = Vec::new();
    for traffic in source.recording.traffic_in(source.times_ns.clone()) {
        let traffic = traffic.map_err(Failure::run)?;
        if traffic.radio == wanted {
            periods.push(traffic);
        } else if !traffic.radio.is_empty() && !radios.contains(&traffic.radio) {
            radios.push(traffic.radio);
        }
    }
    if !periods.is_empty() {
        return Ok(Run {
            seed: source.recording.seed(),
            periods,
        });
    }
    if let Some(radio) = radio {
        let known = match radios.first() {
            Some(first) => format!(
                "it has those of {} radios, {first:?} among them",
                radios.len()
            ),
            None => "name it in the recorder's `radios`".to_owned(),
        };
        return Err(Failure::input(format!(
            "{} has no counters of {radio:?} by itself: {known}",
            source.file()
        )));
    }
    let elsewhere = source.recording.traffic_in(0..=u64::MAX).next().is_some();
    Err(source.nothing(
        elsewhere,
        "counters of radios",
        "there was no radio on the air, or it was recorded by an older version",
    ))
}

/// Runs whose frames are counted in other periods have no mean.
fn of_one_period(sources: &Sources, runs: &[Run]) -> Result<(), Failure> {
    let mut known: Option<(u64, &Source)> = None;
    for (run, source) in runs.iter().zip(sources.all()) {
        let lengths = run.periods.iter().map(length_ns).filter(|ns| *ns > 0);
        // One alone may have been cut off by the end of the run.
        let Some(own) = lengths.clone().max().filter(|_| lengths.count() > 1) else {
            continue;
        };
        match known {
            None => known = Some((own, source)),
            Some((other, _)) if other == own => {}
            Some((other, first)) => {
                let seconds = |ns: u64| ns as f64 * 1e-9;
                return Err(Failure::input(format!(
                    "{} counts frames every {} s and {} every {} s: they have no mean; draw them apart",
                    first.file(),
                    seconds(other),
                    source.file(),
                    seconds(own)
                )));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_frames_have_a_digit_more_where_they_are_means_of_few() {
        let amount = |mean: f64, half: Option<f64>| told(Amount { mean, half });
        assert_eq!(amount(12_345.0, None), "12,345");
        assert_eq!(amount(12_345.4, Some(1_234.5)), "12,345 \u{b1} 1,234");
        assert_eq!(amount(5.25, Some(1_234.56)), "5.2 \u{b1} 1,234.6");
    }
}
