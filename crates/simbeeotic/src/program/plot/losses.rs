//! Why frames were lost, over time.

use super::super::Failure;
use super::arguments::LossOptions;
use super::axes::{Axis, Panel, grouped, number};
use super::palette::series;
use super::sheet::{Anchor, FAINT, HEAD, Ink, SMALL, Sheet, TEXT};
use super::source::Sources;
use simbeeotic_record::{Tallies, Traffic};
use simbeeotic_view::render::words;

/// Narrower bars are not told apart: periods are put together.
const BARS_MAX: usize = 200;
/// Beyond the range that the medium looks at: no radio would call it a loss.
const OUT_OF_RANGE: &str = "out-of-range";

/// Some periods, one after the other.
struct Bar {
    /// 0: an instant.
    length_s: f64,
    end_s: f64,
    sent: u64,
    received: u64,
    lost: Vec<u64>,
}

/// Losses by reason, stacked, and below the frames sent.
pub(super) fn losses(sources: &Sources, options: &LossOptions) -> Result<Sheet, Failure> {
    let periods = periods(sources, options.radio.as_deref())?;
    let total = sum(&periods);
    let drawn = |reason: &str| options.all || reason != OUT_OF_RANGE;
    let mut reasons: Vec<(String, u64)> = total
        .lost
        .iter()
        .filter(|(reason, n)| *n > 0 && drawn(reason))
        .cloned()
        .collect();
    // The most frequent lies below.
    reasons.sort_by(|a, b| b.1.cmp(&a.1).then_with(|| a.0.cmp(&b.0)));
    let (bars, period_s) = bars(&periods, &reasons);

    let [width, height] = options.plot.size();
    let whose = options.radio.as_deref().unwrap_or("all radios");
    let title = options.plot.title("Frames lost, by reason");
    let mut more = format!(
        "{whose}, {} sent, {} received",
        grouped(&total.sent.to_string()),
        grouped(&total.received.to_string())
    );
    let beyond = total.lost(OUT_OF_RANGE);
    if !options.all && beyond > 0 {
        more += &format!(
            ", {} out of range (not drawn)",
            grouped(&beyond.to_string())
        );
    }
    let last = periods.last().map_or(0, |t| t.time_ns);
    let first = periods.first().map_or(0, |t| {
        t.time_ns.saturating_sub((t.period_s * 1e9).round() as u64)
    });
    let mut sheet = Sheet::titled(width, height, title, &sources.caption(first, last, &more));
    draw(&mut sheet, &bars, period_s, &reasons);
    Ok(sheet)
}

fn draw(sheet: &mut Sheet, bars: &[Bar], period_s: f64, reasons: &[(String, u64)]) {
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let (left, bottom) = (96.0, height - 62.0);
    let entries: Vec<(Ink, String)> = (reasons.iter().enumerate())
        .map(|(at, (reason, n))| {
            let words = format!("{}: {}", reason.replace('-', " "), grouped(&n.to_string()));
            (series(at), words)
        })
        .collect();
    let widest = entries.iter().map(|(_, words)| words::width(words, SMALL));
    let legend = widest.fold(0.0, f64::max);
    let right = width - 52.0 - legend.max(60.0);
    let top = HEAD + 12.0;
    let split = top + 0.68 * (bottom - top);
    // A bar is of the time before its end; that of an instant is narrow.
    let start = |bar: &Bar| bar.end_s - bar.length_s.max(0.1 * period_s);
    let low = bars.first().map_or(0.0, start);
    let high = bars.last().map_or(period_s, |bar| bar.end_s);
    let x = Axis::exact("time, s", low, high, 10.0);
    let most = |part: fn(&Bar) -> u64| bars.iter().map(part).max().unwrap_or(0).max(1) as f64;
    let every = number(period_s, period_s / 1000.0);
    let every = every.trim_end_matches('0').trim_end_matches('.').to_owned();
    let y = Axis::stretched(
        format!("lost in {every} s"),
        0.0,
        most(|bar| bar.lost.iter().sum()),
        6.0,
    );
    let upper = Panel {
        edges: [left, top, right, split],
        x: x.clone(),
        y,
    };
    let sent = Axis::stretched(format!("sent in {every} s"), 0.0, most(|bar| bar.sent), 2.0);
    let lower = Panel {
        edges: [left, split + 22.0, right, bottom],
        x,
        y: sent,
    };
    upper.draw(sheet, false);
    lower.draw(sheet, true);
    let gap = 0.05 * period_s;
    for bar in bars {
        let (from, to) = (start(bar) + gap, bar.end_s - gap);
        let mut below = 0;
        for (at, lost) in bar.lost.iter().enumerate().filter(|(_, lost)| **lost > 0) {
            let low = upper.place(from, below as f64);
            below += lost;
            sheet.rectangle(low, upper.place(to, below as f64), series(at));
        }
        let (low, high) = (lower.place(from, 0.0), lower.place(to, bar.sent as f64));
        sheet.rectangle(low, high, FAINT.thin(0.6));
    }
    if reasons.is_empty() {
        let [left, top, right, bottom] = upper.edges;
        let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
        sheet.words(middle, "nothing was lost", SMALL, Anchor::Middle, FAINT);
    }
    // From the top down, as they are stacked.
    for (row, (ink, words)) in entries.into_iter().rev().enumerate() {
        let y = top + 24.0 * row as f64;
        sheet.rectangle([right + 18.0, y], [right + 32.0, y + 14.0], ink);
        sheet.words([right + 40.0, y + 12.0], words, SMALL, Anchor::Start, TEXT);
    }
}

fn periods(sources: &Sources, radio: Option<&str>) -> Result<Vec<Traffic>, Failure> {
    let wanted = radio.unwrap_or("");
    let mut radios = Vec::new();
    let mut periods: Vec<Traffic> = Vec::new();
    for (run, source) in sources.all().iter().enumerate() {
        let mut read = Vec::new();
        for traffic in source.recording.traffic_in(source.times_ns.clone()) {
            let traffic = traffic.map_err(Failure::run)?;
            if traffic.radio == wanted {
                read.push(traffic);
            } else if !traffic.radio.is_empty() && !radios.contains(&traffic.radio) {
                radios.push(traffic.radio);
            }
        }
        match run {
            0 => periods = read,
            _ => add(&mut periods, read),
        }
    }
    if !periods.is_empty() {
        return Ok(periods);
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
            sources.first().file()
        )));
    }
    let source = sources.first();
    let elsewhere = source.recording.traffic_in(0..=u64::MAX).next().is_some();
    Err(source.nothing(
        elsewhere,
        "counters of radios",
        "there was no radio on the air, or it was recorded by an older version",
    ))
}

/// Adds the periods of another run to those that end at the same times.
fn add(periods: &mut Vec<Traffic>, more: Vec<Traffic>) {
    for traffic in more {
        match periods.binary_search_by_key(&traffic.time_ns, |known| known.time_ns) {
            Ok(at) => periods[at].period = sum(&[periods[at].clone(), traffic]),
            Err(at) => periods.insert(at, traffic),
        }
    }
}

fn sum(periods: &[Traffic]) -> Tallies {
    let mut sum = Tallies::default();
    for Traffic { period, .. } in periods {
        sum.sent += period.sent;
        sum.received += period.received;
        for (reason, n) in &period.lost {
            match sum.lost.iter_mut().find(|(known, _)| known == reason) {
                Some((_, total)) => *total += n,
                None => sum.lost.push((reason.clone(), *n)),
            }
        }
    }
    sum
}

/// Periods put together until they are few, and how long each bar is, s.
fn bars(periods: &[Traffic], reasons: &[(String, u64)]) -> (Vec<Bar>, f64) {
    let lengths = periods.iter().map(|t| t.period_s);
    let period_s = lengths.fold(0.0, f64::max);
    let period_s = if period_s > 0.0 { period_s } else { 1.0 };
    let together = periods.len().div_ceil(BARS_MAX).max(1);
    // The first may be the instant at which the run starts, a bar of its own.
    let instant = usize::from(together > 1 && periods.first().is_some_and(|t| t.period_s == 0.0));
    let (start, rest) = periods.split_at(instant);
    let groups = start.chunks(1).chain(rest.chunks(together));
    let bars = groups.map(|group| {
        let total = sum(group);
        Bar {
            length_s: group.iter().map(|t| t.period_s).sum(),
            end_s: group.last().map_or(0.0, |t| t.time_ns as f64 * 1e-9),
            sent: total.sent,
            received: total.received,
            lost: reasons.iter().map(|(why, _)| total.lost(why)).collect(),
        }
    });
    let bars: Vec<Bar> = bars
        .filter(|bar| bar.end_s > 0.0 || bar.sent + bar.received + bar.lost.iter().sum::<u64>() > 0)
        .collect();
    (bars, period_s * together as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn second(end: u64, period_s: f64, sent: u64, noise: u64) -> Traffic {
        Traffic {
            time_ns: end * 1_000_000_000,
            period_s,
            period: Tallies {
                sent,
                lost: vec![("noise".to_owned(), noise)],
                ..Tallies::default()
            },
            ..Traffic::default()
        }
    }

    #[test]
    fn many_periods_become_few_bars_and_nothing_is_lost_of_them() {
        let reasons = [("noise".to_owned(), 0)];
        let mut periods = vec![second(0, 0.0, 7, 1)];
        periods.extend((1..=1000).map(|end| second(end, 1.0, 2, 3)));
        let (bars, period_s) = bars(&periods, &reasons);
        assert_eq!((bars.len(), period_s), (168, 6.0));
        assert_eq!((bars[0].sent, bars[0].lost[0]), (7, 1), "the start alone");
        assert_eq!([bars[0].length_s, bars[1].length_s], [0.0, 6.0]);
        assert_eq!(bars[167].length_s, 4.0, "the rest");
        assert_eq!(
            (bars[1].end_s, bars[1].sent, bars[1].lost[0]),
            (6.0, 12, 18)
        );
        assert_eq!(bars.iter().map(|b| b.sent).sum::<u64>(), 2007);
        assert_eq!(bars.iter().map(|b| b.lost[0]).sum::<u64>(), 3001);
    }

    #[test]
    fn a_start_at_which_nothing_happens_has_no_bar() {
        let reasons = [("noise".to_owned(), 0)];
        let (bars, period_s) = bars(&[second(0, 0.0, 0, 0), second(1, 1.0, 2, 0)], &reasons);
        assert_eq!((bars.len(), period_s, bars[0].end_s), (1, 1.0, 1.0));
    }
}
