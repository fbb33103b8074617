//! What the colour of a vehicle says.

use super::RenderError;
use super::motion::Instant;
use super::scales::{self, Scale};
use simbeeotic_record::{Recording, Vehicle};
use simbeeotic_units::did_you_mean;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::RangeInclusive;

/// What vehicles have their colour from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum ColourBy {
    /// Their kind.
    #[default]
    Kind,
    /// Their body, as the world sees it; their kind where that was not recorded.
    Body,
    /// How fast they fly.
    Speed,
    /// How high they fly.
    Height,
    /// A number that was recorded for each of them: `pollen`, `battery/soc`.
    Metric(String),
}

impl ColourBy {
    /// Reads `kind`, `body`, `speed`, `height`, `battery` or the name of a metric.
    pub fn named(name: &str) -> Self {
        match name {
            "kind" => Self::Kind,
            "body" => Self::Body,
            "speed" => Self::Speed,
            "height" => Self::Height,
            "battery" => Self::Metric(BATTERY.to_owned()),
            other => Self::Metric(other.to_owned()),
        }
    }
}

/// What batteries record: how full they are.
const BATTERY: &str = "battery/soc";
/// Kinds that the key names.
const NAMES_MAX: usize = 12;

/// The colours that the run gave its vehicles, as far as they tell kinds apart: the first kind of a colour keeps it, the
/// others get one that can be told from those. As on the page.
fn of_kinds(vehicles: &[Vehicle]) -> Vec<[u8; 3]> {
    let own = |vehicle: &Vehicle| match vehicle.color {
        [_, _, _, 0] => [148; 3],
        [r, g, b, _] => [r, g, b],
    };
    // Kinds in their order, each with its colours.
    let mut kinds: Vec<(&str, BTreeSet<[u8; 3]>)> = Vec::new();
    let mut places: BTreeMap<&str, usize> = BTreeMap::new();
    for vehicle in vehicles {
        let place = *places.entry(&vehicle.kind).or_insert_with(|| {
            kinds.push((&vehicle.kind, BTreeSet::new()));
            kinds.len() - 1
        });
        kinds[place].1.insert(own(vehicle));
    }
    let mut taken: Vec<[u8; 3]> = Vec::new();
    let mut others: Vec<&str> = Vec::new();
    for (kind, colours) in &kinds {
        match colours.iter().any(|colour| taken.contains(colour)) {
            true => others.push(kind),
            false => taken.extend(colours),
        }
    }
    let mut palette: BTreeMap<&str, [u8; 3]> = BTreeMap::new();
    for kind in others {
        let colour = scales::kind(&taken, palette.len());
        taken.push(colour);
        palette.insert(kind, colour);
    }
    let colour = |vehicle: &Vehicle| match palette.get(vehicle.kind.as_str()) {
        Some(colour) => *colour,
        None => own(vehicle),
    };
    vehicles.iter().map(colour).collect()
}

/// Colours of a recording's vehicles, at any time of it.
pub(super) struct Colours {
    by: ColourBy,
    own: Vec<[u8; 3]>,
    /// Recorded numbers of each vehicle, the earliest first: time and value.
    series: Vec<Vec<(u64, f64)>>,
    pub(super) key: Key,
}

/// What the colours mean.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Key {
    #[default]
    None,
    Names(Vec<(String, [u8; 3])>),
    Scale {
        title: String,
        low: f64,
        high: f64,
        scale: Scale,
    },
}

/// What a survey of the ticks found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extremes {
    pub(super) speed_m_s: f64,
    pub(super) height_m: [f64; 2],
}

impl Colours {
    pub(super) fn new(
        by: &ColourBy,
        recording: &Recording,
        shown: &[bool],
        times_ns: &RangeInclusive<u64>,
        extremes: Extremes,
    ) -> Result<Self, RenderError> {
        let vehicles = recording.vehicles();
        let kinds = of_kinds(vehicles);
        let own = |(vehicle, kind): (&Vehicle, &[u8; 3])| match (by, vehicle.color) {
            (ColourBy::Body, [r, g, b, alpha]) if alpha > 0 => [r, g, b],
            _ => *kind,
        };
        let scale = |title: &str, [low, high]: [f64; 2]| Key::Scale {
            title: title.to_owned(),
            low,
            high,
            scale: match by {
                ColourBy::Speed => Scale::Speed,
                ColourBy::Metric(name) if name == BATTERY => Scale::Battery,
                _ => Scale::Value,
            },
        };
        let mut series = Vec::new();
        let key = match by {
            ColourBy::Kind => {
                let mut names: Vec<(String, [u8; 3])> = Vec::new();
                let drawn = vehicles.iter().zip(&kinds).zip(shown);
                for ((vehicle, rgb), _) in drawn.filter(|(_, shown)| **shown) {
                    let known =
                        |(kind, colour): &(String, _)| *kind == vehicle.kind && colour == rgb;
                    if names.len() < NAMES_MAX && !names.iter().any(known) {
                        names.push((vehicle.kind.clone(), *rgb));
                    }
                }
                match names.len() {
                    0 | 1 => Key::None,
                    _ => Key::Names(names),
                }
            }
            ColourBy::Body => Key::None,
            ColourBy::Speed => scale("speed, m/s", [0.0, round_up(extremes.speed_m_s)]),
            ColourBy::Height => {
                let [low, high] = extremes.height_m;
                let step = round_up((high - low).max(1e-3)) / 10.0;
                scale(
                    "height, m",
                    [(low / step).floor() * step, (high / step).ceil() * step],
                )
            }
            ColourBy::Metric(name) => {
                let (found, unit) = metric(recording, name)?;
                series = found;
                let drawn = || {
                    let lists = series.iter().zip(shown).filter(|(_, shown)| **shown);
                    lists.flat_map(|(list, _)| list)
                };
                let now: Vec<f64> = (drawn().filter(|(t, _)| times_ns.contains(t)))
                    .map(|(_, value)| *value)
                    .collect();
                let values = match now.is_empty() {
                    true => drawn().map(|(_, value)| *value).collect(),
                    false => now,
                };
                let low = values.iter().copied().fold(f64::INFINITY, f64::min);
                let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let range = match (name.as_str(), low, high) {
                    (BATTERY, ..) => [0.0, 1.0],
                    (_, low, high) if low >= 0.0 => [0.0, round_up(high)],
                    (_, low, high) => {
                        let step = round_up(high - low) / 10.0;
                        [(low / step).floor() * step, (high / step).ceil() * step]
                    }
                };
                let title = match (name.as_str(), unit.as_str()) {
                    (BATTERY, _) => "state of charge".to_owned(),
                    (name, "" | "1") => name.to_owned(),
                    (name, unit) => format!("{name}, {unit}"),
                };
                scale(&title, range)
            }
        };
        Ok(Self {
            by: by.clone(),
            own: vehicles.iter().zip(&kinds).map(own).collect(),
            series,
            key,
        })
    }

    /// The colour of each.
    pub(super) fn at(&self, instant: &Instant, time_ns: u64) -> Vec<[u8; 3]> {
        let Key::Scale {
            low, high, scale, ..
        } = self.key
        else {
            return self.own.clone();
        };
        let share = |value: f64| (value - low) / (high - low).max(1e-12);
        let value = |at: usize| match &self.by {
            ColourBy::Speed => instant.speeds_m_s.get(at).copied(),
            ColourBy::Height => instant.places_m.get(at).map(|place| place.z),
            _ => self.series.get(at).and_then(|list| {
                let known = list.partition_point(|(t, _)| *t <= time_ns);
                known.checked_sub(1).map(|last| list[last].1)
            }),
        };
        (0..self.own.len())
            .map(|at| scale.colour(share(value(at).unwrap_or(f64::NAN))))
            .collect()
    }
}

/// Finds vehicles by the beginning of a path below them: `bee-3/battery/soc`.
pub(super) struct Places<'a>(BTreeMap<&'a str, usize>);

impl<'a> Places<'a> {
    pub(super) fn of(recording: &'a Recording) -> Self {
        let paths = recording.vehicles().iter().enumerate();
        Self(paths.map(|(at, v)| (v.path.as_str(), at)).collect())
    }

    /// The vehicle and what follows its path.
    pub(super) fn split<'t>(&self, path: &'t str) -> Option<(usize, &'t str)> {
        if let Some(at) = self.0.get(path) {
            return Some((*at, ""));
        }
        let cuts: Vec<usize> = path.match_indices('/').map(|(at, _)| at).collect();
        cuts.into_iter().rev().find_map(|cut| {
            let at = self.0.get(&path[..cut])?;
            Some((*at, &path[cut + 1..]))
        })
    }
}

type Series = Vec<Vec<(u64, f64)>>;

/// The values of a metric, and its unit.
fn metric(recording: &Recording, name: &str) -> Result<(Series, String), RenderError> {
    let places = Places::of(recording);
    let mut series = vec![Vec::new(); recording.vehicles().len()];
    let mut unit = String::new();
    let mut others = BTreeSet::new();
    for metrics in recording.metrics() {
        let metrics = metrics?;
        for value in metrics.values {
            match places.split(&value.name) {
                Some((at, own)) if own == name && value.value.is_finite() => {
                    series[at].push((metrics.time_ns, value.value));
                    unit = value.unit;
                }
                Some((_, own)) if others.len() < 1000 && !others.contains(own) => {
                    others.insert(own.to_owned());
                }
                _ => {}
            }
        }
    }
    if series.iter().any(|list| !list.is_empty()) {
        return Ok((series, unit));
    }
    let known = ["kind", "body", "speed", "height"];
    let all = known.into_iter().chain(others.iter().map(String::as_str));
    let help = match did_you_mean(name, all.clone()) {
        Some(guess) => format!("did you mean `{guess}`?"),
        None => format!("known here: {}", all.collect::<Vec<_>>().join(", ")),
    };
    Err(RenderError::UnknownMetric {
        name: match name {
            BATTERY => "battery".to_owned(),
            other => other.to_owned(),
        },
        help,
    })
}

/// The next of 1, 2, 3, 5 times a power of ten.
fn round_up(value: f64) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let mut power = 1e-12;
    while power * 10.0 <= value && power < 1e12 {
        power *= 10.0;
    }
    let steps = [1.0, 2.0, 3.0, 5.0, 10.0].map(|digit| digit * power);
    let found = steps.into_iter().find(|step| *step >= value * (1.0 - 1e-3));
    found.unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use simbeeotic_record::stage::{Form, Piece};
    use simbeeotic_record::{Header, Recorder};

    #[test]
    fn the_key_has_the_colours_that_are_drawn() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("run.mcap");
        let hive = Vehicle {
            path: "hive".to_owned(),
            kind: "charging-hive".to_owned(),
            role: "station".to_owned(),
            color: [200, 120, 40, 255],
            pieces: vec![Piece::at_origin(Form::Sphere { radius_m: 1.0 })].into(),
            ..Vehicle::default()
        };
        let bee = |kind: &str| Vehicle {
            path: kind.to_owned(),
            kind: kind.to_owned(),
            color: [250, 200, 60, 255],
            ..Vehicle::default()
        };
        let header = Header {
            vehicles: vec![hive, bee("worker"), bee("scout")],
            ..Header::default()
        };
        let recorder = Recorder::create(&path, header).expect("created");
        recorder.finish(&serde_json::json!({})).expect("finished");
        let recording = Recording::open(&path).expect("opens");
        let extremes = Extremes {
            speed_m_s: 1.0,
            height_m: [0.0, 1.0],
        };
        let colours = Colours::new(&ColourBy::Kind, &recording, &[true; 3], &(0..=0), extremes);
        // The first of a colour keeps it.
        let wanted = [
            ("charging-hive", [200, 120, 40]),
            ("worker", [250, 200, 60]),
            ("scout", scales::kind(&[[200, 120, 40], [250, 200, 60]], 0)),
        ];
        let wanted = wanted.map(|(kind, rgb)| (kind.to_owned(), rgb));
        assert_eq!(colours.expect("colours").key, Key::Names(wanted.into()));
    }

    #[test]
    fn scales_end_at_round_numbers() {
        for (value, end) in [
            (1.7, 2.0),
            (2.0, 2.0),
            (2.2, 3.0),
            (0.037, 0.05),
            (61.0, 100.0),
        ] {
            assert!((round_up(value) - end).abs() < 1e-9 * end, "{value}");
        }
        assert_eq!(round_up(f64::NAN), 1.0);
        assert_eq!(round_up(0.0), 1.0);
    }
}
