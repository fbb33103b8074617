//! Numbers over time: which ones a recording has, found by what the user calls them.

use super::super::Failure;
use super::flights::{is_vehicle, selected, selection};
use super::limits::Limits;
use super::names::{PACKETS, STATES, means, unknown};
use super::source::Source;
use simbeeotic_record::Traffic;
use simbeeotic_units::did_you_mean;
use std::collections::{BTreeMap, BTreeSet};

/// One number of one thing over time.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Curve {
    /// Whose it is.
    pub(super) who: String,
    /// Time, s, and value, in order of time.
    pub(super) points: Vec<[f64; 2]>,
    /// Whether a value lasts until the next: published or counted ones do.
    pub(super) holds: bool,
}

impl Curve {
    /// The value at a time, if it is known then.
    pub(super) fn at(&self, time_s: f64) -> Option<f64> {
        let behind = self.points.partition_point(|[t, _]| *t <= time_s + 1e-9);
        let [t0, before] = *self.points.get(behind.checked_sub(1)?)?;
        match self.points.get(behind) {
            _ if self.holds || (time_s - t0).abs() <= 1e-9 => Some(before),
            Some([t1, after]) => Some(before + (after - before) * (time_s - t0) / (t1 - t0)),
            None => None,
        }
    }
}

/// One of the numbers that were asked for, of all that have it.
#[derive(Clone, Debug, Default)]
pub(super) struct Quantity {
    pub(super) name: String,
    /// Empty for a plain number.
    pub(super) unit: String,
    pub(super) curves: Vec<Curve>,
    /// What was true, of what sensors read.
    pub(super) truth: Vec<Curve>,
    /// Stations that are not counted, since nobody named them.
    pub(super) left_out: Vec<String>,
}

impl Quantity {
    /// The name without the models that it is of: of `bee-*/battery/soc` it is `battery/soc`.
    pub(super) fn short(&self) -> &str {
        let mut rest = self.name.as_str();
        while let Some((model, name)) = rest.split_once('/')
            && model.contains(['*', '?'])
        {
            rest = name;
        }
        rest
    }

    /// What stands beside an axis.
    pub(super) fn label(&self) -> String {
        match self.unit.as_str() {
            "" => self.short().to_owned(),
            unit => format!("{}, {unit}", self.short()),
        }
    }

    /// Who is not counted, to stand behind what is.
    pub(super) fn without(&self) -> String {
        without(&self.left_out)
    }

    /// The ends of what it can be.
    pub(super) fn limits(&self) -> Limits {
        let points = self.curves.iter().flat_map(|curve| &curve.points);
        Limits::of(&self.name, &self.unit, points.map(|[_, value]| *value))
    }
}

/// Who is not counted: `, without hive`.
pub(super) fn without(left_out: &[String]) -> String {
    match left_out {
        [] => String::new(),
        few if few.len() <= 3 => format!(", without {}", few.join(", ")),
        many => format!(", without {} stations", many.len()),
    }
}

/// Reads what is asked for, in the order asked for.
pub(super) fn read(
    source: &Source,
    names: &[String],
    models: &[String],
) -> Result<Vec<Quantity>, Failure> {
    names
        .iter()
        .map(|name| {
            let quantity = if STATES.contains(&name.as_str()) || name.starts_with("distance:") {
                states(source, name, models)?
            } else if let Some(what) = name.strip_prefix("packets/") {
                packets(source, name, what, models)?
            } else {
                match published(source, name, models)? {
                    Some(quantity) => quantity,
                    None => match readings(source, name, models)? {
                        Some(quantity) => quantity,
                        None => return Err(unknown(source, name)?),
                    },
                }
            };
            Ok(quantity)
        })
        .collect()
}

/// From where a distance is.
enum From {
    Model(usize),
    Place([f64; 3]),
}

fn origin(source: &Source, text: &str) -> Result<From, Failure> {
    let vehicles = source.recording.vehicles();
    if let Some(at) = vehicles.iter().position(|vehicle| vehicle.path == text) {
        return Ok(From::Model(at));
    }
    let numbers: Vec<f64> = text
        .split(',')
        .filter_map(|x| x.trim().parse().ok())
        .collect();
    let parts = text.split(',').count();
    if parts > 1 && parts == numbers.len() && parts != 3 {
        return Err(Failure::input(format!(
            "distance:{text}: a place has three numbers, east,north,up in metres, and these are {parts}: \
             distance:0,0,5"
        )));
    }
    if let [x, y, z] = numbers[..]
        && numbers.iter().all(|x| x.is_finite())
        && text.split(',').count() == 3
    {
        return Ok(From::Place([x, y, z]));
    }
    let paths = vehicles.iter().map(|vehicle| vehicle.path.as_str());
    let guess = did_you_mean(text, paths).map_or(".".to_owned(), |guess| {
        format!("; did you mean distance:{guess}?")
    });
    Err(Failure::input(format!(
        "distance:{text}: {} has no model of this path{guess} A place is east,north,up in metres: \
         distance:0,0,5",
        source.file()
    )))
}

fn states(source: &Source, name: &str, models: &[String]) -> Result<Quantity, Failure> {
    let places = selected(source, models)?;
    let origin = name.strip_prefix("distance:").map(|t| origin(source, t));
    let origin = origin.transpose()?;
    let vehicles = source.recording.vehicles();
    let mut curves: Vec<Curve> = (places.iter())
        .map(|at| Curve {
            who: vehicles[*at].path.clone(),
            ..Curve::default()
        })
        .collect();
    let mut last: Vec<Option<(f64, [f64; 3])>> = vec![None; places.len()];
    let mut starts: Vec<Option<[f64; 3]>> = vec![None; places.len()];
    let mut moved = vec![false; places.len()];
    for tick in source.recording.ticks_in(source.times_ns.clone()) {
        let tick = tick.map_err(Failure::run)?;
        let time_s = tick.time_ns as f64 * 1e-9;
        let lines = curves.iter_mut().zip(&places).zip(&mut last);
        for (line, ((curve, at), last)) in lines.enumerate() {
            let sample = &tick.samples[*at];
            let place = sample.position_m;
            if place.iter().all(|x| x.is_finite()) {
                let start = *starts[line].get_or_insert(place);
                moved[line] |= long([0, 1, 2].map(|k| place[k] - start[k])) > STILL_M;
            }
            // Without recorded velocities: from the last tick to this one.
            let before = last.replace((time_s, place));
            let mut v = sample.velocity_m_s;
            if let Some((t, p)) = before
                && v.iter().any(|v| v.is_nan())
                && time_s > t
            {
                v = [0, 1, 2].map(|k| (place[k] - p[k]) / (time_s - t));
            }
            let value = match (name, &origin) {
                ("speed", _) => long(v),
                ("climb", _) => v[2],
                ("x", _) => place[0],
                ("y", _) => place[1],
                ("z" | "altitude", _) => place[2],
                (_, Some(From::Place(from))) => long([0, 1, 2].map(|k| place[k] - from[k])),
                (_, Some(From::Model(from))) => {
                    let from = tick.samples[*from].position_m;
                    long([0, 1, 2].map(|k| place[k] - from[k]))
                }
                _ => f64::NAN,
            };
            if value.is_finite() {
                curve.points.push([time_s, value]);
            }
        }
    }
    let unit = if matches!(name, "speed" | "climb") {
        "m/s"
    } else {
        "m"
    };
    let shown = match name.strip_prefix("distance:") {
        Some(from) => format!("distance from {from}"),
        None => name.to_owned(),
    };
    let roles = places.iter().map(|at| vehicles[*at].role.as_str());
    let counts: Vec<bool> = (roles.zip(&moved))
        .map(|(role, moved)| !models.is_empty() || is_vehicle(role, *moved))
        .collect();
    let mut left_out = Vec::new();
    if counts.contains(&true) {
        let mut counts = counts.iter();
        curves.retain(|curve| {
            let counts = counts.next() == Some(&true);
            if !counts {
                left_out.push(curve.who.clone());
            }
            counts
        });
    }
    let quantity = Quantity {
        name: shown,
        unit: unit.to_owned(),
        curves,
        truth: Vec::new(),
        left_out,
    };
    filled(source, quantity)
}

/// Who stayed within this distance of the start stood still, m.
const STILL_M: f64 = 0.05;

fn long(v: [f64; 3]) -> f64 {
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

/// Only those who have values; an error if nobody does.
fn filled(source: &Source, mut quantity: Quantity) -> Result<Quantity, Failure> {
    quantity.curves.retain(|curve| !curve.points.is_empty());
    quantity.truth.retain(|curve| !curve.points.is_empty());
    if quantity.curves.is_empty() {
        return Err(Failure::input(format!(
            "{} has no values of {} between these times",
            source.file(),
            quantity.name
        )));
    }
    Ok(quantity)
}

fn packets(
    source: &Source,
    name: &str,
    what: &str,
    models: &[String],
) -> Result<Quantity, Failure> {
    let reason = what.strip_prefix("lost/");
    if reason.is_none() && !PACKETS.contains(&what) {
        let guess = did_you_mean(what, PACKETS).map_or(String::new(), |guess| {
            format!("did you mean packets/{guess}? ")
        });
        return Err(Failure::input(format!(
            "--metric {name}: {guess}packets have {}, lost/REASON",
            PACKETS.join(", ")
        )));
    }
    let wanted = selection(models);
    let mut curves: BTreeMap<String, Curve> = BTreeMap::new();
    let mut reasons = BTreeSet::new();
    let mut any = false;
    for traffic in source.recording.traffic_in(source.times_ns.clone()) {
        let traffic = traffic.map_err(Failure::run)?;
        any = true;
        reasons.extend(traffic.period.lost.iter().map(|(name, _)| name.clone()));
        let mine = match models {
            [] => traffic.radio.is_empty(),
            _ => !traffic.radio.is_empty() && wanted.takes(&traffic.radio),
        };
        if !mine || traffic.period_s <= 0.0 {
            continue;
        }
        let who = match traffic.radio.as_str() {
            "" => "all radios",
            radio => radio,
        };
        let curve = curves.entry(who.to_owned()).or_insert_with(|| Curve {
            who: who.to_owned(),
            holds: true,
            ..Curve::default()
        });
        let value = counted(&traffic, what);
        if value.is_finite() {
            curve.points.push([traffic.time_ns as f64 * 1e-9, value]);
        }
    }
    if !any {
        let elsewhere = source.recording.traffic_in(0..=u64::MAX).next().is_some();
        return Err(source.nothing(
            elsewhere,
            "counters of radios",
            "there was no radio on the air, or it was recorded by an older version",
        ));
    }
    if curves.is_empty() && !models.is_empty() {
        return Err(Failure::input(format!(
            "{} has no counters of radios that match {}: name them in the recorder's `radios`",
            source.file(),
            models.join(", ")
        )));
    }
    if let Some(reason) = reason
        && !reasons.contains(reason)
    {
        let reasons: Vec<&str> = reasons.iter().map(String::as_str).collect();
        return Err(Failure::input(format!(
            "--metric {name}: nothing was lost for this reason; reasons are {}",
            reasons.join(", ")
        )));
    }
    let quantity = Quantity {
        name: match what {
            "delivery" => "delivery in range".to_owned(),
            what => format!("frames {}", what.replace('/', ": ").replace('-', " ")),
        },
        unit: if what == "delivery" { "" } else { "1/s" }.to_owned(),
        curves: curves.into_values().collect(),
        truth: Vec::new(),
        left_out: Vec::new(),
    };
    filled(source, quantity)
}

/// A number of a period: frames for each second, or a share.
fn counted(traffic: &Traffic, what: &str) -> f64 {
    let period = &traffic.period;
    let lost = |beyond: bool| -> u64 {
        let lost = period.lost.iter();
        lost.filter(|(reason, _)| beyond || reason != "out-of-range")
            .map(|(_, n)| n)
            .sum()
    };
    let count = match what {
        "sent" => period.sent,
        "received" => period.received,
        "overheard" => period.overheard,
        "lost" => lost(true),
        "delivery" => {
            let received = (period.received + period.overheard) as f64;
            return received / (received + lost(false) as f64);
        }
        other => period.lost(other.strip_prefix("lost/").unwrap_or(other)),
    };
    count as f64 / traffic.period_s
}

fn published(source: &Source, name: &str, models: &[String]) -> Result<Option<Quantity>, Failure> {
    let wanted = selection(models);
    let mut curves: BTreeMap<String, Curve> = BTreeMap::new();
    let mut units = BTreeSet::new();
    let mut elsewhere = false;
    for metrics in source.recording.metrics() {
        let metrics = metrics.map_err(Failure::run)?;
        let inside = source.times_ns.contains(&metrics.time_ns);
        for metric in metrics.values {
            if !means(name, &metric.name) {
                continue;
            }
            elsewhere = true;
            if !inside || !wanted.takes(&metric.name) || !metric.value.is_finite() {
                continue;
            }
            let point = [metrics.time_ns as f64 * 1e-9, metric.value];
            match curves.get_mut(&metric.name) {
                Some(curve) => curve.points.push(point),
                None => {
                    units.insert(metric.unit);
                    let curve = Curve {
                        who: metric.name.clone(),
                        points: vec![point],
                        holds: true,
                    };
                    curves.insert(metric.name, curve);
                }
            }
        }
    }
    if !elsewhere {
        return Ok(None);
    }
    let unit = one_unit(name, units)?;
    let quantity = Quantity {
        name: name.to_owned(),
        unit,
        curves: curves.into_values().collect(),
        truth: Vec::new(),
        left_out: Vec::new(),
    };
    filled(source, quantity).map(Some)
}

/// The unit of all that a pattern matches.
fn one_unit(name: &str, units: BTreeSet<String>) -> Result<String, Failure> {
    let units: BTreeSet<String> = (units.into_iter())
        .map(|unit| if unit == "1" { String::new() } else { unit })
        .collect();
    if units.len() > 1 {
        let units: Vec<String> = (units.into_iter())
            .map(|unit| {
                if unit.is_empty() {
                    "none".to_owned()
                } else {
                    unit
                }
            })
            .collect();
        return Err(Failure::input(format!(
            "--metric {name}: it matches numbers of different units ({}); choose fewer",
            units.join(", ")
        )));
    }
    Ok(units.into_iter().next().unwrap_or_default())
}

fn readings(source: &Source, name: &str, models: &[String]) -> Result<Option<Quantity>, Failure> {
    let (sensor, column) = match name.rsplit_once(':') {
        Some((sensor, column)) => (sensor, Some(column)),
        None => (name, None),
    };
    let wanted = selection(models);
    let mut known: BTreeMap<String, (Curve, Curve)> = BTreeMap::new();
    let mut units = BTreeSet::new();
    let mut elsewhere = false;
    for reading in source.recording.readings_in(0..=u64::MAX) {
        let reading = reading.map_err(Failure::run)?;
        if !means(sensor, &reading.sensor) {
            continue;
        }
        elsewhere = true;
        let place = match column {
            None if reading.names.len() <= 1 => 0,
            Some(column) if reading.names.iter().any(|name| name == column) => {
                reading.names.iter().position(|n| n == column).unwrap_or(0)
            }
            _ => {
                let columns = reading.names.join(", ");
                let first = reading.names.first().map_or("", String::as_str);
                return Err(Failure::input(match column {
                    Some(column) => {
                        let names = reading.names.iter().map(String::as_str);
                        let guess = did_you_mean(column, names)
                            .map_or(String::new(), |g| format!("; did you mean {g}?"));
                        format!("--metric {name}: {} reads {columns}{guess}", reading.sensor)
                    }
                    None => format!(
                        "--metric {name}: {} reads {columns}; say which: {sensor}:{first}",
                        reading.sensor
                    ),
                }));
            }
        };
        if !source.times_ns.contains(&reading.time_ns) || !wanted.takes(&reading.sensor) {
            continue;
        }
        let time_s = reading.time_ns as f64 * 1e-9;
        units.insert(reading.units.get(place).cloned().unwrap_or_default());
        let columns = reading.names.len().max(1);
        // Of several rows, the mean.
        let mean = |values: &[f64]| {
            let column = values.iter().skip(place).step_by(columns);
            let known: Vec<f64> = column.copied().filter(|x| x.is_finite()).collect();
            let count = known.len() as f64;
            (count > 0.0).then(|| known.iter().sum::<f64>() / count)
        };
        let (read, truth) = known.entry(reading.sensor.clone()).or_insert_with(|| {
            let curve = Curve {
                who: reading.sensor.clone(),
                ..Curve::default()
            };
            (curve.clone(), curve)
        });
        if let Some(value) = mean(&reading.reading).filter(|_| !reading.lost) {
            read.points.push([time_s, value]);
        }
        if let Some(value) = mean(&reading.truth) {
            truth.points.push([time_s, value]);
        }
    }
    if !elsewhere {
        return Ok(None);
    }
    let unit = one_unit(name, units)?;
    let (curves, truth) = known.into_values().unzip();
    let quantity = Quantity {
        name: name.to_owned(),
        unit,
        curves,
        truth,
        left_out: Vec::new(),
    };
    filled(source, quantity).map(Some)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_says_the_number_and_not_the_pattern() {
        let label = |name: &str, unit: &str| {
            let (name, unit) = (name.to_owned(), unit.to_owned());
            let quantity = Quantity {
                name,
                unit,
                ..Quantity::default()
            };
            quantity.label()
        };
        assert_eq!(label("*/battery/soc", ""), "battery/soc");
        assert_eq!(label("hive-*/bee-?/imu:fx", "m/s^2"), "imu:fx, m/s^2");
        assert_eq!(label("bee-1/battery/soc", ""), "bee-1/battery/soc");
        assert_eq!(label("packets/delivery", ""), "packets/delivery");
        assert_eq!(label("bee-*", "mg"), "bee-*, mg");
    }

    #[test]
    fn a_curve_is_straight_between_its_points_and_a_held_one_is_steps() {
        let mut curve = Curve {
            points: vec![[1.0, 10.0], [3.0, 20.0]],
            ..Curve::default()
        };
        assert_eq!(
            [0.5, 1.0, 2.0, 3.0, 3.5].map(|t| curve.at(t)),
            [None, Some(10.0), Some(15.0), Some(20.0), None]
        );
        curve.holds = true;
        assert_eq!(
            [0.5, 2.0, 3.5].map(|t| curve.at(t)),
            [None, Some(10.0), Some(20.0)]
        );
    }

    #[test]
    fn delivery_leaves_out_who_was_out_of_range() {
        let mut traffic = Traffic {
            period_s: 2.0,
            ..Traffic::default()
        };
        traffic.period.received = 30;
        traffic.period.lost = vec![("noise".to_owned(), 10), ("out-of-range".to_owned(), 99)];
        assert_eq!(counted(&traffic, "delivery"), 0.75);
        assert_eq!(counted(&traffic, "received"), 15.0);
        assert_eq!(counted(&traffic, "lost/noise"), 5.0);
    }
}
