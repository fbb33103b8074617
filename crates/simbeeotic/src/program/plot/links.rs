//! The map of links: who hears whom, and how well, from above.

use super::super::{Failure, input};
use super::arguments::LinkOptions;
use super::axes::{Panel, grouped, nice, number};
use super::ground::Ground;
use super::map::{Names, map, scale_bar};
use super::palette::ramp;
use super::sheet::{Anchor, FAINT, GRID, Ink, SMALL, Sheet, TEXT};
use super::source::Source;
use simbeeotic_kernel::SimTime;
use simbeeotic_record::Links;
use std::collections::BTreeMap;

/// More lines make a picture darker, not clearer: so many in all, or for each radio.
const LINES_MAX: usize = 600;
const LINES_EACH: usize = 6;
/// More names hide what is below.
const NAMES_MAX: usize = 60;
/// In less, names and legend find no room, pixels.
const WIDTH_MIN: u32 = 600;
const HEIGHT_MIN: u32 = 400;
const NODE: Ink = Ink::new([0x26, 0x2b, 0x33]);

/// Frames from one radio to another.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Way {
    sent: u64,
    received: u64,
    /// Sum of RSSI over the frames received, dBm.
    rssi_sum: f64,
}

impl Way {
    fn ratio(&self) -> f64 {
        match self.sent {
            0 => 0.0,
            sent => self.received as f64 / sent as f64,
        }
    }

    fn rssi_dbm(&self) -> f64 {
        self.rssi_sum / self.received as f64
    }
}

/// Both ways between two radios: from the first to the second, and back.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    ends: [usize; 2],
    ways: [Way; 2],
}

impl Pair {
    fn ratio(&self) -> f64 {
        0.5 * (self.ways[0].ratio() + self.ways[1].ratio())
    }

    /// Mean over both ways of what was received.
    fn rssi_dbm(&self) -> f64 {
        let received = self.ways[0].received + self.ways[1].received;
        (self.ways[0].rssi_sum + self.ways[1].rssi_sum) / received as f64
    }
}

/// The map.
pub(super) fn links(source: &Source, options: &LinkOptions) -> Result<Sheet, Failure> {
    let least = options.least;
    if !(0.0..=1.0).contains(&least) {
        return Err(Failure::input(format!(
            "--least {least}: a delivery ratio lies between 0 and 1"
        )));
    }
    if options.per_radio == Some(0) {
        return Err(Failure::input("--per-radio 0: it must be one or more"));
    }
    let [width, height] = options.plot.size();
    if width < WIDTH_MIN || height < HEIGHT_MIN {
        return Err(Failure::input(format!(
            "--width {width} --height {height}: a map of links needs at least {WIDTH_MIN} x {HEIGHT_MIN} \
             pixels"
        )));
    }
    let periods = source.links()?;
    let (radios, pairs) = pairs(&periods);
    let places = places(source, options.time.as_deref(), &radios)?;
    let heard = |pair: &Pair| {
        pair.ways
            .iter()
            .any(|way| way.received > 0 && way.ratio() >= least)
    };
    let pairs: Vec<Pair> = pairs.into_iter().filter(heard).collect();
    let all = pairs.len();
    let (pairs, best) = strongest(pairs, radios.len(), options.per_radio.map(|n| n as usize));

    let what = match best {
        Some(best) => format!(
            "{} radios, {} of each ({} of {})",
            radios.len(),
            match best {
                1 => "the best link".to_owned(),
                best => format!("the {best} best links"),
            },
            pairs.len(),
            grouped(&all.to_string())
        ),
        None => format!(
            "{} radios, {} links",
            radios.len(),
            grouped(&all.to_string())
        ),
    };
    let last = periods.last().map_or(0, |l| l.time_ns);
    let first = periods.first().map_or(0, |l| {
        l.time_ns.saturating_sub((l.period_s * 1e9).round() as u64)
    });
    let title = options.plot.title("Links");
    let mut sheet = Sheet::titled(width, height, title, &source.caption(first, last, &what));
    let ground = source.stage()?.map(|stage| Ground::of(&stage, &[]));
    draw(&mut sheet, &radios, &places, pairs, least, ground.as_ref());
    Ok(sheet)
}

/// All radios of the recording's links, and the sums over all periods of each two.
fn pairs(periods: &[Links]) -> (Vec<String>, Vec<Pair>) {
    let mut radios: Vec<String> = Vec::new();
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut pairs: BTreeMap<[usize; 2], [Way; 2]> = BTreeMap::new();
    for links in periods {
        let known: Vec<usize> = (links.radios.iter())
            .map(|radio| {
                *numbers.entry(radio.clone()).or_insert_with(|| {
                    radios.push(radio.clone());
                    radios.len() - 1
                })
            })
            .collect();
        for link in &links.links {
            let [from, to] = [link.from, link.to].map(|place| known[place as usize]);
            let back = usize::from(from > to);
            let way = &mut pairs.entry([from.min(to), from.max(to)]).or_default()[back];
            way.sent += u64::from(link.sent);
            way.received += u64::from(link.received);
            if link.received > 0 {
                way.rssi_sum += f64::from(link.rssi_dbm) * f64::from(link.received);
            }
        }
    }
    let pairs = pairs.into_iter().map(|(ends, ways)| Pair { ends, ways });
    (radios, pairs.collect())
}

/// Of each radio the `wanted` best links, by delivery, then by RSSI; if nothing is wanted, all, or as many
/// as are not too many. Tells how many of each, if not all.
fn strongest(
    mut pairs: Vec<Pair>,
    radios: usize,
    wanted: Option<usize>,
) -> (Vec<Pair>, Option<usize>) {
    let most = (LINES_EACH * radios).min(LINES_MAX);
    if wanted.is_none() && pairs.len() <= most {
        return (pairs, None);
    }
    let key = |pair: &Pair| (pair.ratio(), pair.rssi_dbm());
    pairs.sort_by(|a, b| {
        let ((a, a_dbm), (b, b_dbm)) = (key(a), key(b));
        b.total_cmp(&a).then(b_dbm.total_cmp(&a_dbm))
    });
    // The rank of a pair among those of its ends: the better of the two.
    let mut seen = vec![0_usize; radios];
    let ranks: Vec<usize> = (pairs.iter())
        .map(|pair| {
            let rank = pair.ends.map(|end| seen[end]);
            pair.ends.iter().for_each(|end| seen[*end] += 1);
            rank[0].min(rank[1])
        })
        .collect();
    let count = |best: usize| ranks.iter().filter(|rank| **rank < best).count();
    let best = wanted.unwrap_or_else(|| {
        let few = (2..radios.max(3)).take_while(|best| count(*best) <= most);
        few.last().unwrap_or(1)
    });
    let kept = pairs
        .into_iter()
        .zip(&ranks)
        .filter(|(_, rank)| **rank < best);
    (kept.map(|(pair, _)| pair).collect(), Some(best))
}

/// Where each radio is, east and north, m: in the mean, or at a time.
fn places(
    source: &Source,
    time: Option<&str>,
    radios: &[String],
) -> Result<Vec<[f64; 2]>, Failure> {
    let owner = |radio: &String| {
        radio
            .rsplit_once('/')
            .map_or(radio.clone(), |(owner, _)| owner.to_owned())
    };
    let vehicles = source.recording.vehicles();
    let bodies: Vec<Option<usize>> = (radios.iter().map(owner))
        .map(|owner| vehicles.iter().position(|vehicle| vehicle.path == owner))
        .collect();
    let times = match time {
        None => source.times_ns.clone(),
        Some(text) => {
            let time = SimTime::from_time(input::span("--time", text)?)
                .map_err(|error| Failure::input(format!("--time: {error}")))?;
            0..=time.nanos()
        }
    };
    let mut sums = vec![[0.0; 3]; radios.len()];
    for tick in source.recording.ticks_in(times) {
        let tick = tick.map_err(Failure::run)?;
        for (sum, body) in sums.iter_mut().zip(&bodies) {
            let Some(body) = *body else { continue };
            let [x, y, _] = tick.samples[body].position_m;
            if time.is_some() {
                *sum = [x, y, 1.0];
            } else {
                *sum = [sum[0] + x, sum[1] + y, sum[2] + 1.0];
            }
        }
    }
    if sums.iter().any(|sum| sum[2] == 0.0) {
        // Radios without a body, or no tick at these times: where they sent from.
        let numbers: BTreeMap<&str, usize> = radios.iter().map(String::as_str).zip(0..).collect();
        let without: Vec<bool> = sums.iter().map(|sum| sum[2] == 0.0).collect();
        for packet in source.recording.packets_in(source.times_ns.clone()) {
            let packet = packet.map_err(Failure::run)?;
            if let Some(&at) = numbers.get(packet.radio.as_str())
                && without[at]
            {
                let [x, y, _] = packet.position_m;
                let sum = &mut sums[at];
                *sum = [sum[0] + x, sum[1] + y, sum[2] + 1.0];
            }
        }
    }
    match sums.iter().position(|sum| sum[2] == 0.0) {
        Some(nowhere) => Err(Failure::input(format!(
            "{}: it is not recorded where {} is at these times: choose a longer time, or a shorter \
             `period` of the recorder",
            source.recording.path().display(),
            radios[nowhere]
        ))),
        None => Ok(sums.iter().map(|[x, y, n]| [x / n, y / n]).collect()),
    }
}

fn draw(
    sheet: &mut Sheet,
    radios: &[String],
    places: &[[f64; 2]],
    mut pairs: Vec<Pair>,
    least: f64,
    ground: Option<&Ground>,
) {
    let panel = map(sheet, bounds(places));
    panel.draw(sheet, true);
    if let Some(ground) = ground {
        ground.outlines(sheet, &panel);
    }
    let levels = || {
        pairs
            .iter()
            .flat_map(|pair| pair.ways)
            .filter(|way| way.received > 0)
    };
    let low = levels()
        .map(|way| way.rssi_dbm())
        .fold(f64::INFINITY, f64::min);
    let high = levels()
        .map(|way| way.rssi_dbm())
        .fold(f64::NEG_INFINITY, f64::max);
    let step = nice(((high - low) / 4.0).max(1.0));
    let (low, high) = ((low / step).floor() * step, (high / step).ceil() * step);
    let thickness = |dbm: f64| 1.0 + 4.5 * ((dbm - low) / (high - low).max(step)).clamp(0.0, 1.0);
    let alpha = if pairs.len() > 150 { 0.8 } else { 0.95 };

    pairs.sort_by(|a, b| {
        let way = |pair: &Pair| (pair.ratio(), pair.rssi_dbm());
        let ((a, a_dbm), (b, b_dbm)) = (way(a), way(b));
        a.total_cmp(&b).then(a_dbm.total_cmp(&b_dbm))
    });
    for pair in &pairs {
        let [a, b] = pair
            .ends
            .map(|end| panel.place(places[end][0], places[end][1]));
        let middle = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        for (from, way) in [a, b].into_iter().zip(&pair.ways) {
            if way.received > 0 && way.ratio() >= least {
                let ink = ramp(way.ratio()).thin(alpha);
                sheet.line(vec![from, middle], ink, thickness(way.rssi_dbm()));
            } else {
                sheet.line(vec![from, middle], GRID, 1.0);
            }
        }
    }
    let radius = if places.len() > 100 { 4.0 } else { 5.5 };
    for [x, y] in places {
        sheet.disc(panel.place(*x, *y), radius, NODE, 1.5);
    }
    if radios.len() <= NAMES_MAX {
        names(sheet, &panel, radios, places, &pairs);
    }
    scale_bar(sheet, &panel);
    if pairs.is_empty() {
        let [left, top, ..] = panel.edges;
        sheet.words(
            [left + 14.0, top + 24.0],
            "nobody heard anybody",
            SMALL,
            Anchor::Start,
            FAINT,
        );
    }
    legend(
        sheet,
        &panel,
        (low, high, step),
        thickness,
        !pairs.is_empty(),
    );
}

/// West, south, east, north of all radios, m.
fn bounds(places: &[[f64; 2]]) -> [f64; 4] {
    let ends = |k: usize| {
        let along = || places.iter().map(|place| place[k]);
        let low = along().fold(f64::INFINITY, f64::min);
        [low, along().fold(f64::NEG_INFINITY, f64::max)]
    };
    let [[west, east], [south, north]] = [ends(0), ends(1)];
    [west, south, east, north]
}

/// Names of the radios, each where it hides least.
fn names(sheet: &mut Sheet, panel: &Panel, radios: &[String], places: &[[f64; 2]], pairs: &[Pair]) {
    let owner = |radio: &str| {
        radio
            .rsplit_once('/')
            .map_or(radio, |(owner, _)| owner)
            .to_owned()
    };
    let owners: Vec<String> = radios.iter().map(|radio| owner(radio)).collect();
    let size = if radios.len() > 30 { 12.0 } else { SMALL };
    let dots: Vec<[f64; 2]> = places.iter().map(|[x, y]| panel.place(*x, *y)).collect();
    let mut names = Names::around(panel.edges, dots.iter().copied());
    for (at, [x, y]) in dots.iter().enumerate() {
        let alone = owners.iter().filter(|other| **other == owners[at]).count() == 1;
        let text = if alone { &owners[at] } else { &radios[at] };
        // Where other links come from is crowded.
        let crowd = |dx: f64, dy: f64| -> f64 {
            let mine = pairs.iter().filter(|pair| pair.ends.contains(&at));
            let towards = mine.map(|pair| {
                let other = dots[pair.ends[usize::from(pair.ends[0] == at)]];
                let (ex, ey) = (other[0] - x, other[1] - y);
                let cosine = (ex * dx + ey * dy) / ((ex * ex + ey * ey).sqrt() + 1e-9);
                (cosine - 0.5).max(0.0)
            });
            towards.sum()
        };
        names.write(sheet, [*x, *y], text, size, crowd);
    }
}

fn legend(
    sheet: &mut Sheet,
    panel: &Panel,
    (low, high, step): (f64, f64, f64),
    thickness: impl Fn(f64) -> f64,
    any: bool,
) {
    let [_, top, right, _] = panel.edges;
    let left = right + 24.0;
    let mut y = top + 12.0;
    let say = |sheet: &mut Sheet, y: f64, text: &str, ink: Ink| {
        sheet.words([left, y], text, SMALL, Anchor::Start, ink);
    };
    say(sheet, y, "delivery ratio", TEXT);
    y += 14.0;
    let (wide, tall, parts) = (18.0, 180.0, 60);
    for part in 0..parts {
        let share = (f64::from(part) + 0.5) / f64::from(parts);
        let below = y + tall * (1.0 - f64::from(part) / f64::from(parts));
        let above = below - tall / f64::from(parts) - 0.4;
        sheet.rectangle([left, above], [left + wide, below], ramp(share));
    }
    for share in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let at = y + tall * (1.0 - share);
        sheet.line(vec![[left + wide, at], [left + wide + 5.0, at]], TEXT, 1.0);
        let text = format!("{share:.2}");
        sheet.words(
            [left + wide + 10.0, at + 5.0],
            text,
            SMALL,
            Anchor::Start,
            TEXT,
        );
    }
    y += tall + 40.0;
    if any {
        say(sheet, y, "RSSI, dBm", TEXT);
        let mut level = high;
        while level >= low - 0.5 * step {
            y += 22.0;
            let at = y - 5.0;
            sheet.line(
                vec![[left, at], [left + 46.0, at]],
                ramp(0.85),
                thickness(level),
            );
            sheet.words(
                [left + 56.0, y],
                number(level, step),
                SMALL,
                Anchor::Start,
                TEXT,
            );
            level -= step;
        }
        y += 40.0;
    }
    for line in [
        "Each half of a line is",
        "of the frames from its",
        "end, as the other end",
        "receives them; grey:",
        "none of them.",
    ] {
        say(sheet, y, line, FAINT);
        y += 19.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::Link;

    fn period(links: &[(u32, u32, u32, u32, f32)]) -> Links {
        let link = |&(from, to, sent, received, rssi_dbm): &(u32, u32, u32, u32, f32)| Link {
            from,
            to,
            sent,
            received,
            rssi_dbm,
            distance_m: 1.0,
        };
        Links {
            radios: ["a", "b", "c"].map(|name| format!("{name}/radio")).to_vec(),
            links: links.iter().map(link).collect(),
            ..Links::default()
        }
    }

    #[test]
    fn both_ways_of_a_pair_are_summed_apart() {
        let (radios, pairs) = pairs(&[
            period(&[(0, 1, 10, 5, -60.0), (1, 0, 10, 0, f32::NAN)]),
            period(&[(0, 1, 10, 10, -66.0), (2, 0, 4, 4, -50.0)]),
        ]);
        assert_eq!(radios, ["a/radio", "b/radio", "c/radio"]);
        assert_eq!(pairs.len(), 2);
        let [there, back] = pairs[0].ways;
        assert_eq!((there.sent, there.received), (20, 15));
        assert_eq!(there.rssi_dbm(), -64.0, "weighted by frames");
        assert_eq!((back.sent, back.received, back.ratio()), (10, 0, 0.0));
        assert_eq!(pairs[1].ends, [0, 2]);
        assert_eq!(
            pairs[1].ways[1].ratio(),
            1.0,
            "from the second to the first"
        );
    }

    #[test]
    fn of_too_many_links_the_best_of_each_radio_stay() {
        // Three radios in a row: the long way is the worst of both of its ends.
        let (_, three) = pairs(&[period(&[
            (0, 1, 10, 10, -60.0),
            (1, 2, 10, 10, -61.0),
            (0, 2, 10, 10, -70.0),
        ])]);
        let (kept, best) = strongest(three.clone(), 3, Some(1));
        assert_eq!((kept.len(), best), (2, Some(1)));
        assert!(kept.iter().all(|pair| pair.ends != [0, 2]));
        assert_eq!(strongest(three, 3, None).0.len(), 3);
    }
}
