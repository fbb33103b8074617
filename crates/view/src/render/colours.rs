//! What the colour of a vehicle says.

use super::RenderError;
use super::light;
use super::motion::Instant;
use super::swarm::body_colour;
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
            "battery" => Self::Metric("battery/soc".to_owned()),
            other => Self::Metric(other.to_owned()),
        }
    }
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
        times_ns: &RangeInclusive<u64>,
        extremes: Extremes,
    ) -> Result<Self, RenderError> {
        let vehicles = recording.vehicles();
        // Those that are drawn as their body keep its colour, whatever the others say.
        let flyers = || vehicles.iter().filter(|v| body_colour(v).is_none());
        let mut kinds: Vec<&str> = Vec::new();
        for vehicle in flyers() {
            if !kinds.contains(&vehicle.kind.as_str()) {
                kinds.push(&vehicle.kind);
            }
        }
        // The largest kind comes first, in the colour of bees.
        kinds.sort_by_key(|kind| std::cmp::Reverse(flyers().filter(|v| v.kind == *kind).count()));
        let kind_of = |vehicle: &Vehicle| {
            let place = kinds.iter().position(|kind| *kind == vehicle.kind);
            light::kind(place.unwrap_or(0))
        };
        let own = |vehicle: &Vehicle| match (by, vehicle.color) {
            (ColourBy::Body, [r, g, b, alpha]) if alpha > 0 => [r, g, b],
            _ => kind_of(vehicle),
        };
        let scale = |title: &str, [low, high]: [f64; 2]| Key::Scale {
            title: title.to_owned(),
            low,
            high,
        };
        let mut series = Vec::new();
        let key = match by {
            ColourBy::Kind => {
                let flying = kinds.iter().enumerate();
                let mut names: Vec<(String, [u8; 3])> = flying
                    .map(|(place, kind)| ((*kind).to_owned(), light::kind(place)))
                    .collect();
                let mut known = BTreeSet::new();
                for vehicle in vehicles {
                    if let Some([r, g, b, _]) = body_colour(vehicle)
                        && known.insert((vehicle.kind.as_str(), [r, g, b]))
                    {
                        names.push((vehicle.kind.clone(), [r, g, b]));
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
                let shown = series
                    .iter()
                    .flatten()
                    .filter(|(t, _)| times_ns.contains(t));
                let values: Vec<f64> = match shown.clone().next() {
                    Some(_) => shown.map(|(_, value)| *value).collect(),
                    None => series.iter().flatten().map(|(_, value)| *value).collect(),
                };
                let low = values.iter().copied().fold(f64::INFINITY, f64::min);
                let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let range = match (name.as_str(), low, high) {
                    ("battery/soc", ..) => [0.0, 1.0],
                    (_, low, high) if low >= 0.0 => [0.0, round_up(high)],
                    (_, low, high) => {
                        let step = round_up(high - low) / 10.0;
                        [(low / step).floor() * step, (high / step).ceil() * step]
                    }
                };
                let title = match (name.as_str(), unit.as_str()) {
                    ("battery/soc", _) => "state of charge".to_owned(),
                    (name, "" | "1") => name.to_owned(),
                    (name, unit) => format!("{name}, {unit}"),
                };
                scale(&title, range)
            }
        };
        Ok(Self {
            by: by.clone(),
            own: vehicles.iter().map(own).collect(),
            series,
            key,
        })
    }

    /// The colour of each.
    pub(super) fn at(&self, instant: &Instant, time_ns: u64) -> Vec<[u8; 3]> {
        let (low, high) = match &self.key {
            Key::Scale { low, high, .. } => (*low, *high),
            _ => return self.own.clone(),
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
            .map(|at| light::ramp(share(value(at).unwrap_or(f64::NAN))))
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
            "battery/soc" => "battery".to_owned(),
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
        let colours = Colours::new(&ColourBy::Kind, &recording, &(0..=0), extremes);
        let wanted = [
            ("worker", light::kind(0)),
            ("scout", light::kind(1)),
            ("charging-hive", [200, 120, 40]),
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
