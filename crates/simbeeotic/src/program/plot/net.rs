//! Who hears whom, from the links of one recording, or of several with the same radios.

use super::super::{Failure, input, remark};
use super::band::{half_width, mean, units};
use super::source::Source;
use simbeeotic_kernel::SimTime;
use simbeeotic_record::Links;
use std::collections::BTreeMap;

/// More lines make a picture darker, not clearer: so many in all, or for each radio.
const LINES_MAX: usize = 600;
const LINES_EACH: usize = 6;
/// A share of the size of a map: radios that are farther apart from run to run have no place on it.
const APART: f64 = 0.1;

/// Frames from one radio to another in one run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sum {
    sent: u64,
    received: u64,
    /// Sum of RSSI over the frames received, dBm.
    rssi_sum: f64,
}

/// What became of the frames from one radio to another; of several runs, in the mean over them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Way {
    /// Received over sent; 0 if none was sent.
    pub(super) ratio: f64,
    /// Half of its 95 % interval; `None` of one run.
    pub(super) half: Option<f64>,
    /// Of what was received; NaN if nothing was.
    pub(super) rssi_dbm: f64,
    pub(super) heard: bool,
}

impl Way {
    /// Of the sums of runs with these seeds.
    fn of(runs: &[(Option<u64>, Sum)]) -> Self {
        let sent = runs.iter().filter(|(_, sum)| sum.sent > 0);
        let ratios = sent.map(|(seed, sum)| (*seed, sum.received as f64 / sum.sent as f64));
        let ratios = units(&ratios.collect::<Vec<_>>());
        let heard = runs.iter().filter(|(_, sum)| sum.received > 0);
        let levels = heard.map(|(seed, sum)| (*seed, sum.rssi_sum / sum.received as f64));
        let levels = units(&levels.collect::<Vec<_>>());
        Self {
            ratio: mean(&ratios).unwrap_or(0.0),
            half: half_width(&ratios),
            rssi_dbm: mean(&levels).unwrap_or(f64::NAN),
            heard: !levels.is_empty(),
        }
    }
}

/// Both ways between two radios: from the first to the second, and back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair {
    pub(super) ends: [usize; 2],
    pub(super) ways: [Way; 2],
}

impl Pair {
    pub(super) fn ratio(&self) -> f64 {
        0.5 * (self.ways[0].ratio + self.ways[1].ratio)
    }

    /// Mean over the ways on which anything was received.
    pub(super) fn rssi_dbm(&self) -> f64 {
        let heard = self.ways.iter().filter(|way| way.heard);
        let levels: Vec<f64> = heard.map(|way| way.rssi_dbm).collect();
        mean(&levels).unwrap_or(f64::NEG_INFINITY)
    }
}

/// Radios, where they are, and how well each hears each other.
pub(super) struct Net {
    pub(super) radios: Vec<String>,
    /// East and north, m.
    pub(super) places_m: Vec<[f64; 2]>,
    pub(super) pairs: Vec<Pair>,
    /// The times that it is of, ns.
    pub(super) times_ns: [u64; 2],
}

impl Net {
    /// Reads it. `time` is when the radios are where they are drawn; if there is none, in the mean.
    pub(super) fn read(runs: &[&Source], time: Option<&str>) -> Result<Self, Failure> {
        let mut radios: Vec<String> = Vec::new();
        let mut places_m: Vec<Vec<(Option<u64>, [f64; 2])>> = Vec::new();
        let mut ways: BTreeMap<[usize; 2], Vec<[Sum; 2]>> = BTreeMap::new();
        let mut times_ns = [u64::MAX, 0];
        let seeds: Vec<Option<u64>> = runs.iter().map(|run| run.recording.seed()).collect();
        for (at, source) in runs.iter().enumerate() {
            let periods = source.links()?;
            for links in &periods {
                let length_ns = (links.period_s * 1e9).round() as u64;
                let [first, last] = times_ns;
                times_ns = [
                    first.min(links.time_ns.saturating_sub(length_ns)),
                    last.max(links.time_ns),
                ];
            }
            let (own, sums) = sums(&periods);
            let own_places = places(source, time, &own)?;
            if at == 0 {
                radios = own.clone();
                places_m = vec![Vec::new(); radios.len()];
            }
            let numbers = same_radios(&radios, &own, [runs[0], source])?;
            for (place, radio) in own_places.into_iter().zip(&numbers) {
                places_m[*radio].push((seeds[at], place));
            }
            for (ends, [there, back]) in sums {
                let ends = ends.map(|end| numbers[end]);
                let turned = ends[0] > ends[1];
                let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
                let of_runs = ways
                    .entry(ends)
                    .or_insert_with(|| vec![<[Sum; 2]>::default(); runs.len()]);
                of_runs[at] = if turned { [back, there] } else { [there, back] };
            }
        }
        let pairs = ways.into_iter().map(|(ends, of_runs)| Pair {
            ends,
            ways: [0, 1].map(|k| {
                let sums = of_runs.iter().map(|both| both[k]);
                Way::of(&seeds.iter().copied().zip(sums).collect::<Vec<_>>())
            }),
        });
        Ok(Self {
            pairs: pairs.collect(),
            places_m: middle(&places_m),
            radios,
            times_ns,
        })
    }
}

/// The places of one run's radios among those of the first; an error if they are others.
fn same_radios(all: &[String], own: &[String], of: [&Source; 2]) -> Result<Vec<usize>, Failure> {
    let numbers = own
        .iter()
        .map(|radio| all.iter().position(|other| other == radio));
    let numbers: Option<Vec<usize>> = numbers.collect();
    let missing = all.iter().find(|radio| !own.contains(radio));
    match (numbers, missing) {
        (Some(numbers), None) => Ok(numbers),
        (_, missing) => {
            let [first, other] = of.map(Source::file);
            let strange = own.iter().find(|radio| !all.contains(radio));
            let example = match (strange, missing) {
                (Some(radio), _) => format!("{radio} is in {other} only"),
                (None, Some(radio)) => format!("{radio} is in {first} only"),
                (None, None) => String::new(),
            };
            Err(Failure::input(format!(
                "{first} has links of {} radios and {other} of {}; {example}. Means are over runs with the same \
                 radios; --by, such as --by model.bee.count, draws a map for each value",
                all.len(),
                own.len()
            )))
        }
    }
}

/// The middle of each radio's places over runs. Says so if they are far apart.
fn middle(places_m: &[Vec<(Option<u64>, [f64; 2])>]) -> Vec<[f64; 2]> {
    let along = |runs: &[(Option<u64>, [f64; 2])], k: usize| {
        let places: Vec<_> = runs.iter().map(|(seed, place)| (*seed, place[k])).collect();
        mean(&units(&places)).unwrap_or(0.0)
    };
    let middles: Vec<[f64; 2]> = (places_m.iter())
        .map(|runs| [along(runs, 0), along(runs, 1)])
        .collect();
    let all = places_m.iter().flatten().map(|(_, place)| *place);
    let size = |k: usize| {
        let ends = all.clone().map(|place| place[k]);
        let low = ends.clone().fold(f64::INFINITY, f64::min);
        ends.fold(f64::NEG_INFINITY, f64::max) - low
    };
    let squares = places_m.iter().zip(&middles).flat_map(|(runs, middle)| {
        runs.iter().map(|(_, place)| {
            let [dx, dy] = [place[0] - middle[0], place[1] - middle[1]];
            dx * dx + dy * dy
        })
    });
    let squares: Vec<f64> = squares.collect();
    let apart_m = mean(&squares).unwrap_or(0.0).sqrt();
    if apart_m > APART * size(0).max(size(1)) {
        remark(format!(
            "note: the radios are elsewhere in each run, {apart_m:.1} m from the middle of their places, where \
             they are drawn"
        ));
    }
    middles
}

/// All radios of a recording's links, and the sums over all periods of each two: there and back.
fn sums(periods: &[Links]) -> (Vec<String>, BTreeMap<[usize; 2], [Sum; 2]>) {
    let mut radios: Vec<String> = Vec::new();
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut pairs: BTreeMap<[usize; 2], [Sum; 2]> = BTreeMap::new();
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
            let sum = &mut pairs.entry([from.min(to), from.max(to)]).or_default()[back];
            sum.sent += u64::from(link.sent);
            sum.received += u64::from(link.received);
            if link.received > 0 {
                sum.rssi_sum += f64::from(link.rssi_dbm) * f64::from(link.received);
            }
        }
    }
    (radios, pairs)
}

/// Of each radio the `wanted` best links, by delivery, then by RSSI; if nothing is wanted, all, or as many
/// as are not too many. Tells how many of each, if not all.
pub(super) fn strongest(
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

    /// The pairs of one run.
    fn pairs(periods: &[Links]) -> Vec<Pair> {
        let (_, sums) = sums(periods);
        let pairs = sums.into_iter().map(|(ends, both)| Pair {
            ends,
            ways: both.map(|sum| Way::of(&[(Some(1), sum)])),
        });
        pairs.collect()
    }

    #[test]
    fn both_ways_of_a_pair_are_summed_apart() {
        let periods = [
            period(&[(0, 1, 10, 5, -60.0), (1, 0, 10, 0, f32::NAN)]),
            period(&[(0, 1, 10, 10, -66.0), (2, 0, 4, 4, -50.0)]),
        ];
        let (radios, sums) = sums(&periods);
        assert_eq!(radios, ["a/radio", "b/radio", "c/radio"]);
        let [there, back] = sums[&[0, 1]];
        assert_eq!((there.sent, there.received), (20, 15));
        assert_eq!((back.sent, back.received), (10, 0));
        let pairs = pairs(&periods);
        assert_eq!(pairs.len(), 2);
        let [there, back] = pairs[0].ways;
        assert_eq!(there.rssi_dbm, -64.0, "weighted by frames");
        assert_eq!(
            (there.ratio, there.half),
            (0.75, None),
            "one run says nothing of others"
        );
        assert_eq!((back.ratio, back.heard), (0.0, false));
        assert_eq!(pairs[1].ends, [0, 2]);
        assert_eq!(pairs[1].ways[1].ratio, 1.0, "from the second to the first");
    }

    #[test]
    fn over_runs_each_run_counts_as_much_as_the_others() {
        let sum = |sent, received, rssi_dbm: f64| Sum {
            sent,
            received,
            rssi_sum: rssi_dbm * received as f64,
        };
        let way = Way::of(&[
            (Some(1), sum(1000, 200, -60.0)),
            (Some(2), sum(10, 4, -70.0)),
            (Some(3), sum(10, 6, -80.0)),
            (Some(4), sum(0, 0, 0.0)),
        ]);
        assert!((way.ratio - 0.4).abs() < 1e-12, "nobody sent in the last");
        assert!((way.rssi_dbm + 70.0).abs() < 1e-12);
        // s = 0.2, t(2) = 4.3027.
        let half = way.half.expect("three runs");
        assert!(
            (half - 4.3027 * 0.2 / 3.0_f64.sqrt()).abs() < 1e-4,
            "{half}"
        );
    }

    #[test]
    fn of_too_many_links_the_best_of_each_radio_stay() {
        // Three radios in a row: the long way is the worst of both of its ends.
        let three = pairs(&[period(&[
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
