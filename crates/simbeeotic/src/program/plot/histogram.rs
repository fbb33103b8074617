//! How often which values occur: over all times and vehicles, at one time, or the last ones.

use super::super::{Failure, input};
use super::arguments::{BandKind, HistogramOptions};
use super::axes::{Axis, Panel, grouped, nice, number};
use super::band::{band, mean, quantile, units};
use super::map::Column;
use super::palette::series;
use super::quantity::{Quantity, read};
use super::series::capital;
use super::sheet::{HEAD, Ink, Sheet, TEXT};
use super::source::Sources;
use super::sweep::groups;
use simbeeotic_units::math;

/// No more bins than these, unless their width is said.
const BINS_MAX: usize = 60;
/// No more than these whatever is said.
const BINS_EVER: f64 = 2000.0;

/// The values of one quantity in runs that were made alike.
struct Pool {
    name: String,
    ink: Ink,
    /// Of each run its seed and its values.
    runs: Vec<(Option<u64>, Vec<f64>)>,
}

/// Where bins begin, and how wide they are.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Bins {
    low: f64,
    width: f64,
    count: usize,
}

/// The picture.
pub(super) fn histogram(sources: &Sources, options: &HistogramOptions) -> Result<Sheet, Failure> {
    let numbers = &options.numbers;
    let at_s = input::nanos("--at", options.at.as_deref())?.map(|ns| ns as f64 * 1e-9);
    let groups = groups(sources, numbers.by.as_deref())?;
    let mut heads: Vec<Quantity> = Vec::new();
    let mut pools: Vec<Pool> = Vec::new();
    let mut times = [f64::INFINITY, f64::NEG_INFINITY];
    for group in &groups {
        let first = pools.len();
        for source in &group.runs {
            for (k, mut quantity) in read(source, &numbers.metric, &numbers.models)?
                .into_iter()
                .enumerate()
            {
                let curves = std::mem::take(&mut quantity.curves);
                let all = || curves.iter().flat_map(|curve| &curve.points);
                times[0] = all().map(|p| p[0]).fold(times[0], f64::min);
                times[1] = all().map(|p| p[0]).fold(times[1], f64::max);
                let values: Vec<f64> = match at_s {
                    Some(at_s) => curves.iter().filter_map(|c| c.at(at_s)).collect(),
                    None if options.last => {
                        let last = |c: &super::quantity::Curve| Some(c.points.last()?[1]);
                        curves.iter().filter_map(last).collect()
                    }
                    None => all().map(|p| p[1]).collect(),
                };
                if heads.len() <= k {
                    heads.push(quantity);
                }
                if pools.len() <= first + k {
                    pools.push(Pool {
                        name: match (group.name.as_str(), numbers.metric.len()) {
                            ("", _) => heads[k].name.clone(),
                            (name, 1) => name.to_owned(),
                            (name, _) => format!("{}, {name}", heads[k].name),
                        },
                        ink: series(first + k),
                        runs: Vec::new(),
                    });
                }
                let seed = source.recording.seed();
                pools[first + k].runs.push((seed, values));
            }
        }
    }
    if let Some(other) = heads.iter().find(|head| head.unit != heads[0].unit) {
        return Err(Failure::input(format!(
            "{} and {} have different units: draw a histogram of each",
            heads[0].label(),
            other.label()
        )));
    }
    let mut all: Vec<f64> = pools
        .iter()
        .flat_map(|p| p.runs.iter().flat_map(|(_, values)| values))
        .copied()
        .collect();
    if all.is_empty() {
        return Err(Failure::input(format!(
            "--at {}: nobody has a value of {} then; they are known from {} s to {} s",
            options.at.as_deref().unwrap_or(""),
            heads[0].name,
            number(times[0], 1e-3),
            number(times[1], 1e-3)
        )));
    }
    all.sort_by(f64::total_cmp);
    let bins = Bins::of(&all, options.bin)?;
    let when = match at_s {
        Some(_) => format!("at {}", options.at.as_deref().unwrap_or("")),
        None if options.last => "the last of each".to_owned(),
        None => "of all times".to_owned(),
    };
    let runs = pools.iter().map(|p| p.runs.len()).max().unwrap_or(1);
    let what = format!(
        "{} values{}, {when}, bins of {}{}",
        grouped(&all.len().to_string()),
        heads[0].without(),
        trimmed(bins.width),
        if runs > 1 {
            "; bars: mean over runs, 95 % confidence"
        } else {
            ""
        }
    );
    let [width, height] = options.plot.size();
    let title = match heads.as_slice() {
        [one] => format!("{}: how often", capital(&one.name)),
        _ => "How often".to_owned(),
    };
    let span = times.map(|time_s| (time_s.max(0.0) * 1e9).round() as u64);
    let caption = sources.caption(span[0], span[1], &what);
    let mut sheet = Sheet::titled(width, height, options.plot.title(&title), &caption);
    let mut names: Vec<&str> = heads.iter().map(Quantity::short).collect();
    names.dedup();
    let label = match heads[0].unit.as_str() {
        "" => names.join(", "),
        unit => format!("{}, {unit}", names.join(", ")),
    };
    draw(&mut sheet, &pools, bins, label);
    Ok(sheet)
}

/// A number without digits that say nothing.
fn trimmed(value: f64) -> String {
    let text = number(value, value / 1000.0);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

impl Bins {
    /// For sorted values; `width` as said, or by the rule of D. Freedman and P. Diaconis (1981).
    fn of(sorted: &[f64], width: Option<f64>) -> Result<Self, Failure> {
        let (low, high) = (sorted[0], sorted[sorted.len() - 1]);
        let span = high - low;
        let width = match width {
            Some(width) if width > 0.0 && span / width < BINS_EVER => width,
            Some(width) if width > 0.0 => {
                let digits = |end: f64| number(end, 1e-3 * span);
                return Err(Failure::input(format!(
                    "--bin {width}: {} bins would reach from {} to {}; {BINS_EVER} are the most",
                    grouped(&(span / width).ceil().to_string()),
                    digits(low),
                    digits(high)
                )));
            }
            Some(width) => {
                return Err(Failure::input(format!(
                    "--bin {width}: it must be more than zero"
                )));
            }
            None => {
                let quartiles = [0.25, 0.75].map(|share| quantile(sorted, share));
                let root = math::exp(math::ln(sorted.len() as f64) / 3.0);
                let width = 2.0 * (quartiles[1] - quartiles[0]) / root;
                let least = span / BINS_MAX as f64;
                match width.max(least) {
                    width if width > 1e-12 * low.abs().max(high.abs()) => nice(width),
                    _ => 0.1 * nice(low.abs().max(1e-3)),
                }
            }
        };
        let from = (low / width + 1e-9).floor();
        let to = (high / width + 1e-9).floor();
        Ok(Self {
            low: from * width,
            width,
            count: (to - from) as usize + 1,
        })
    }

    /// The share of values in each bin; its lower end belongs to it.
    fn shares(&self, values: &[f64]) -> Vec<f64> {
        let mut shares = vec![0.0; self.count];
        for value in values {
            let place = ((value - self.low) / self.width + 1e-9).floor();
            let place = place.clamp(0.0, (self.count - 1) as f64) as usize;
            shares[place] += 1.0 / values.len() as f64;
        }
        shares
    }

    fn end(&self, place: usize) -> f64 {
        self.low + place as f64 * self.width
    }
}

fn draw(sheet: &mut Sheet, pools: &[Pool], bins: Bins, label: String) {
    let shares: Vec<Vec<(Option<u64>, Vec<f64>)>> = (pools.iter())
        .map(|pool| {
            let known = pool.runs.iter().filter(|(_, run)| !run.is_empty());
            known.map(|(seed, run)| (*seed, bins.shares(run))).collect()
        })
        .collect();
    // Of each pool and bin the mean over runs and its band, %.
    let bars: Vec<Vec<(f64, Option<[f64; 2]>)>> = (shares.iter())
        .map(|runs| {
            (0..bins.count)
                .map(|bin| {
                    let values = runs.iter().map(|(seed, run)| (*seed, 100.0 * run[bin]));
                    let mut values = units(&values.collect::<Vec<_>>());
                    let middle = mean(&values).unwrap_or(0.0);
                    let ends = band(&mut values, BandKind::Confidence);
                    (
                        middle,
                        ends.map(|[low, high]| [low.max(0.0), high.min(100.0)]),
                    )
                })
                .collect()
        })
        .collect();
    let tops = bars
        .iter()
        .flatten()
        .map(|(bar, ends)| ends.map_or(*bar, |e| e[1]));
    let most = tops.fold(0.0, f64::max);
    let (width, height) = (f64::from(sheet.width), f64::from(sheet.height));
    let panel = Panel {
        edges: [
            96.0,
            HEAD + 10.0,
            width - sheet.key_room() - 24.0,
            height - 62.0,
        ],
        x: Axis::exact(label, bins.low, bins.end(bins.count), 8.0),
        y: Axis::stretched("share of the values, %", 0.0, most, 6.0),
    };
    panel.draw(sheet, true);
    let [left, _, right, _] = panel.edges;
    let gap = (0.06 * (right - left) / bins.count as f64).min(1.5);
    for (pool, bars) in pools.iter().zip(&bars) {
        if pools.len() == 1 {
            for (bin, (bar, _)) in bars.iter().enumerate() {
                let [x0, y0] = panel.place(bins.end(bin), 0.0);
                let [x1, y1] = panel.place(bins.end(bin + 1), *bar);
                if *bar > 0.0 {
                    sheet.rectangle([x0 + gap, y0], [x1 - gap, y1], pool.ink.thin(0.65));
                }
            }
        } else {
            let mut steps = vec![panel.place(bins.low, 0.0)];
            for (bin, (bar, _)) in bars.iter().enumerate() {
                steps.push(panel.place(bins.end(bin), *bar));
                steps.push(panel.place(bins.end(bin + 1), *bar));
            }
            steps.push(panel.place(bins.end(bins.count), 0.0));
            sheet.area(steps.clone(), pool.ink.thin(0.1));
            sheet.line(steps, pool.ink, 1.8);
        }
    }
    for (at, (pool, bars)) in pools.iter().zip(&bars).enumerate() {
        let share = (at as f64 + 1.0) / (pools.len() as f64 + 1.0);
        for (bin, (_, ends)) in bars.iter().enumerate() {
            let Some(ends) = ends.filter(|[low, high]| high > low) else {
                continue;
            };
            let middle = bins.end(bin) + share * bins.width;
            let ends = ends.map(|end| panel.place(middle, end));
            let ink = match pools.len() {
                1 => TEXT,
                _ => pool.ink,
            };
            sheet.line(ends.to_vec(), ink.thin(0.8), 1.2);
        }
    }
    let mut column = Column::beside(&panel);
    for (at, pool) in pools.iter().enumerate() {
        let mut values: Vec<f64> = pool.runs.iter().flat_map(|(_, v)| v).copied().collect();
        values.sort_by(f64::total_cmp);
        let Some(middle) = mean(&values) else {
            continue;
        };
        let median = quantile(&values, 0.5);
        if pools.len() > 1 {
            column.line(sheet, pool.ink, 2.4, &pool.name);
        } else {
            let [x, bottom] = panel.place(middle, 0.0);
            sheet.dashed(
                vec![[x, bottom], [x, panel.edges[1]]],
                TEXT,
                1.3,
                [6.0, 4.0],
            );
            column.dashes(sheet, TEXT, &format!("mean {}", digits(middle, bins.width)));
        }
        if column.room() < 5 && at + 1 < pools.len() {
            continue;
        }
        if pools.len() > 1 {
            column.note(sheet, &[&format!("mean {}", digits(middle, bins.width))]);
        }
        column.note(
            sheet,
            &[
                &format!("median {}", digits(median, bins.width)),
                &format!(
                    "from {} to {}",
                    digits(quantile(&values, 0.0), bins.width),
                    digits(quantile(&values, 1.0), bins.width)
                ),
            ],
        );
        column.gap();
    }
}

/// A value with a digit more than bins have.
fn digits(value: f64, width: f64) -> String {
    number(value, 0.1 * width)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bins_are_as_wide_as_freedman_and_diaconis_propose() {
        // 1000 even values from 0 to 10: quartiles 5 apart, cube root 10: 1 wide.
        let values: Vec<f64> = (0..1000).map(|k| f64::from(k) * 10.0 / 999.0).collect();
        let bins = Bins::of(&values, None).unwrap_or_else(|_| panic!("bins"));
        assert_eq!((bins.low, bins.width, bins.count), (0.0, 1.0, 11));
    }

    #[test]
    fn shares_add_up_to_all_and_lower_ends_belong_to_their_bins() {
        let bins = Bins {
            low: 0.0,
            width: 0.5,
            count: 4,
        };
        let shares = bins.shares(&[0.0, 0.49, 0.5, 1.0, 1.99]);
        let wanted = [0.4, 0.2, 0.2, 0.2];
        for (share, wanted) in shares.iter().zip(wanted) {
            assert!((share - wanted).abs() < 1e-12, "{shares:?}");
        }
    }

    #[test]
    fn values_that_are_all_the_same_have_one_bin() {
        for value in [0.0, 3.0, -1e6] {
            let bins = Bins::of(&[value; 5], None).unwrap_or_else(|_| panic!("bins"));
            assert_eq!(bins.count, 1, "{value}: {bins:?}");
            assert!(bins.low <= value && value < bins.low + bins.width);
        }
    }

    #[test]
    fn a_width_that_cannot_be_says_why_in_few_digits() {
        let values = [0.0, 1.924_833_829_192_960_8];
        let said = |width: f64| match Bins::of(&values, Some(width)) {
            Ok(bins) => format!("{bins:?}"),
            Err(failure) => failure.message,
        };
        assert_eq!(said(0.0), "--bin 0: it must be more than zero");
        assert_eq!(said(f64::NAN), "--bin NaN: it must be more than zero");
        assert_eq!(
            said(0.0001),
            "--bin 0.0001: 19,249 bins would reach from 0.000 to 1.925; 2000 are the most"
        );
    }
}
