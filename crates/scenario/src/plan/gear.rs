//! What a model carries: sensors and radios, and where they sit.

use super::section::{Section, read, table_help};
use super::shared::choice;
use super::{Choice, Context, part};
use crate::limit::{MOUNT_M_MAX, QUEUE_FRAMES_MAX};
use simbeeotic_model::config::{Fault, Node, Table, Value};
use simbeeotic_model::instance::{GearPlan, RadioPlan, SensorPlan};
use simbeeotic_model::radio::{Antenna, Isotropic};
use simbeeotic_model::registry::{Kind, Make, Site};
use simbeeotic_model::{BuildError, PlannedPart, SamplePhase, Sampling, Supply};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{Angle, Attitude, Current, Frequency, Mount, Offset, Time, Yaw, math};
use std::path::Path;
use std::sync::Arc;

/// Keys of every sensor, besides its part's own.
const SENSOR_KEYS: [&str; 6] = ["rate", "phase", "delay", "dropout", "current", "on_time"];

/// What a radio is called that stands alone.
const RADIO: &str = "radio";

/// Reads the keys `sensor`, `radio` and `battery` of a model.
pub(super) fn gear(section: &mut Section<'_>, cx: &mut Context<'_>) -> GearPlan {
    let (faults, folder) = (&mut cx.faults, cx.folder.as_path());
    let mut gear = GearPlan::default();
    let (mut parts, mut radios) = (Vec::new(), Vec::new());
    if let Some(node) = section.get("sensor") {
        for (name, node) in named_tables(node, "sensor", Kind::Sensor, faults) {
            gear.sensors.extend(sensor(name, node, &mut parts, faults));
        }
    }
    if let Some(node) = section.get("radio") {
        let single = node
            .as_table()
            .is_some_and(|t| t.get("use").is_some() || only_values(t));
        if node.as_str().is_some() {
            // The name of its part alone.
            let node = &keyed("use", node);
            gear.radios
                .extend(radio(RADIO, node, folder, &mut radios, faults));
        } else if single {
            gear.radios
                .extend(radio(RADIO, node, folder, &mut radios, faults));
        } else {
            for (name, node) in named_tables(node, "radio", Kind::Radio, faults) {
                gear.radios
                    .extend(radio(name, node, folder, &mut radios, faults));
            }
        }
    }
    if let Some(node) = section.get("battery") {
        gear.supply = supply(node, &mut gear.parts, faults);
    }
    gear.parts.append(&mut radios);
    gear.parts.append(&mut parts);
    gear
}

/// `[model.battery]`; a text in its place is the preset.
fn supply(
    node: &Node,
    parts: &mut Vec<PlannedPart>,
    faults: &mut Vec<Fault>,
) -> Option<Arc<Supply>> {
    let table = match node.as_str() {
        Some(_) => keyed("preset", node),
        None => node.clone(),
    };
    parts.push(PlannedPart::battery(&table));
    let supply = Supply::read(&table).map_err(|found| faults.extend(found));
    supply.ok().map(Arc::new)
}

/// A table of one entry.
fn keyed(key: &str, node: &Node) -> Node {
    let mut table = Table::default();
    table.set(key, node.clone());
    Node::new(node.span, Value::Table(table))
}

/// Whether a table has entries, and none that is a table itself.
fn only_values(table: &Table) -> bool {
    !table.is_empty()
        && table
            .entries
            .iter()
            .all(|(_, node)| node.as_table().is_none())
}

/// The tables in a table, each with its name.
fn named_tables<'n>(
    node: &'n Node,
    what: &str,
    kind: Kind,
    faults: &mut Vec<Fault>,
) -> Vec<(&'n str, &'n Node)> {
    let Some(table) = node.as_table() else {
        let message = format!(
            "{} where a table `[model.{what}.NAME]` is wanted",
            node.value.kind()
        );
        let mut fault = Fault::error(node.span, message);
        let key = format!("{what}.{}", node.as_str().unwrap_or("NAME"));
        fault.help = table_help(node, &key, kind);
        faults.push(fault);
        return Vec::new();
    };
    let mut all = Vec::new();
    for (key, inner) in &table.entries {
        if inner.as_table().is_some() {
            if good_name(&key.text) {
                all.push((key.text.as_str(), inner));
            } else {
                faults.push(Fault::error(key.span, format!("`{}` is no name", key.text)));
            }
        } else if let Some(help) = table_help(inner, &format!("{what}.{}", key.text), kind) {
            let message = format!("text where a {what} is wanted, which is a table");
            faults.push(Fault::error(inner.span, message).help(help));
        } else {
            let message = format!("a {what} needs a name: [model.{what}.NAME]");
            faults.push(Fault::error(key.span, message));
        }
    }
    all
}

/// Whether a word can be part of a path: not empty, no `/`, no control characters, no blanks at its
/// ends.
pub(super) fn good_name(name: &str) -> bool {
    !name.is_empty()
        && name.trim() == name
        && !name.chars().any(|c| c == '/' || c.is_control())
        && name.len() <= 200
}

fn sensor(
    name: &str,
    node: &Node,
    parts: &mut Vec<PlannedPart>,
    faults: &mut Vec<Fault>,
) -> Option<SensorPlan> {
    let mut section = Section::open(node, "a sensor", faults)?;
    let part = part(&mut section, Kind::Sensor, faults);
    let mount = mount(&mut section, faults);
    let sampling = sampling(&mut section, faults);
    let current: Option<Current> = section.read("current", faults);
    if let (Some(current), Some(node)) = (current, section.get("current"))
        && current < Current::ZERO
    {
        let message = format!("`current` must be zero or more, and is {current}");
        faults.push(Fault::error(node.span, message));
    }
    let on_time = on_time(&mut section, faults);
    let part = part?;
    let around = section.entries(&SENSOR_KEYS);
    let params = section.rest(part, faults);
    let Make::Sensor(make) = part.make else {
        return None;
    };
    parts.push(PlannedPart::new(format!("sensor.{name}"), part, &params).with(around));
    let factory = make(&params).map_err(|found| faults.extend(found)).ok()?;
    Some(SensorPlan {
        name: name.to_owned(),
        factory,
        mount: mount?,
        sampling: sampling?,
        current,
        on_time,
    })
}

/// `on_time = "20 ms"`: how long it is on for each sample.
fn on_time(section: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<Time> {
    let on_time: Time = section.read("on_time", faults)?;
    let node = section.get("on_time")?;
    if on_time < Time::ZERO {
        let message = format!("`on_time` must be zero or more, and is {on_time}");
        faults.push(Fault::error(node.span, message));
    } else if section.get("rate").is_none() {
        let message = "`on_time` is the time of one sample, and needs a `rate`";
        faults.push(Fault::error(node.span, message));
    }
    Some(on_time)
}

/// `rate = "50 Hz"`, `phase = "aligned"`, `"random"` or a time, `delay = "20 ms"`, `dropout = 0.01`.
fn sampling(section: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<Sampling> {
    let before = faults.len();
    let rate: Option<Frequency> = section.read("rate", faults);
    let delay: Option<Time> = section.read("delay", faults);
    let dropout: Option<f64> = section.read("dropout", faults);
    let phase = section.get("phase").and_then(|node| match node.as_str() {
        Some("aligned") => Some(SamplePhase::Aligned),
        Some("random") => Some(SamplePhase::Random),
        _ => match read::<Time>(node, &mut Vec::new()) {
            Some(at) => Some(SamplePhase::At(at)),
            None => {
                let message = "a phase is `aligned`, `random`, or a time such as \"3 ms\"";
                faults.push(Fault::error(node.span, message));
                None
            }
        },
    });
    let sampling = Sampling {
        period: rate.map(|rate| Time::from_secs(1.0 / rate.get())),
        phase: phase.unwrap_or_default(),
        delay: delay.unwrap_or(Time::ZERO),
        dropout: dropout.unwrap_or(0.0),
    };
    if faults.len() > before {
        return None;
    }
    match sampling.check() {
        Ok(()) => Some(sampling),
        Err(BuildError::Parameter { key, message }) => {
            let place = section.get(key).map_or(section.node.span, |node| node.span);
            faults.push(Fault::error(place, format!("`{key}` {message}")));
            None
        }
        Err(other) => {
            faults.push(Fault::error(section.node.span, other.to_string()));
            None
        }
    }
}

fn radio(
    name: &str,
    node: &Node,
    folder: &Path,
    parts: &mut Vec<PlannedPart>,
    faults: &mut Vec<Fault>,
) -> Option<RadioPlan> {
    let mut section = Section::open(node, "a radio", faults)?;
    let part = part(&mut section, Kind::Radio, faults);
    let mount = mount(&mut section, faults);
    let place = match name {
        RADIO => RADIO.to_owned(),
        name => format!("{RADIO}.{name}"),
    };
    let mut chosen = None;
    let antenna = match section.get("antenna") {
        Some(node) => choice(node, Kind::Antenna, faults).and_then(|c| {
            let antenna = antenna(&c, folder, faults);
            chosen = Some(PlannedPart::new(
                format!("{place}.antenna"),
                c.part,
                &c.params,
            ));
            antenna
        }),
        None => Some(Arc::new(Isotropic::default()) as Arc<dyn Antenna>),
    };
    let queue_frames = queue_frames(&mut section, faults);
    let part = part?;
    let around = section.entries(&["queue_frames"]);
    let params = section.rest(part, faults);
    let Make::Radio(make) = part.make else {
        return None;
    };
    parts.push(PlannedPart::new(place, part, &params).with(around));
    parts.extend(chosen);
    let mut spec = make(&params).map_err(|found| faults.extend(found)).ok()?;
    if let Some(frames) = queue_frames {
        spec.queue_frames = frames;
    }
    if let Err(error) = spec.check() {
        faults.push(Fault::error(node.span, error.to_string()));
        return None;
    }
    Some(RadioPlan {
        name: name.to_owned(),
        spec,
        antenna: antenna?,
        mount: mount?,
    })
}

/// `queue_frames = 20`: how many packets may wait to be sent.
fn queue_frames(section: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<usize> {
    let frames: usize = section.read("queue_frames", faults)?;
    let node = section.get("queue_frames")?;
    if !(1..=QUEUE_FRAMES_MAX).contains(&frames) {
        let message =
            format!("`queue_frames` must lie between 1 and {QUEUE_FRAMES_MAX}, and is {frames}");
        faults.push(Fault::error(node.span, message));
    }
    Some(frames)
}

fn antenna(choice: &Choice, folder: &Path, faults: &mut Vec<Fault>) -> Option<Arc<dyn Antenna>> {
    let Make::Antenna(make) = choice.part.make else {
        return None;
    };
    // Nothing of an antenna hangs on chance.
    let site = Site { seed: 0, folder };
    make(&choice.params, &site)
        .map_err(|found| faults.extend(found))
        .ok()
}

/// `mount = { position = [...], attitude = { yaw = "90 deg" } }`, or `pointing = [x, y, z]` instead
/// of an attitude: the direction in the body's frame that the gear looks in.
fn mount(section: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<Mount> {
    let Some(node) = section.get("mount") else {
        return Some(Mount::default());
    };
    let mut section = Section::open(node, "a mount", faults)?;
    let position: Option<Offset> = section.read("position", faults);
    if let (Some(offset), Some(node)) = (position, section.get("position"))
        && offset.si().abs().max_element() > MOUNT_M_MAX
    {
        let message = format!("gear sits within {MOUNT_M_MAX} m of its body's middle");
        faults.push(Fault::error(node.span, message));
    }
    let attitude: Option<Attitude> = section.read("attitude", faults);
    let pointing = section.entry("pointing");
    let pointed = pointing.map(|(key, node)| {
        if section.get("attitude").is_some() {
            let message = "`attitude` and `pointing` say the same: one will do";
            faults.push(Fault::error(key.span, message));
        }
        let direction: DVec3 = read::<[f64; 3]>(node, faults)?.into();
        if direction == DVec3::ZERO {
            let message = "a direction is not the zero vector";
            faults.push(Fault::error(node.span, message));
            return None;
        }
        Some(looking(direction))
    });
    section.finish(faults);
    let attitude = match pointed {
        Some(pointed) => pointed?,
        None => attitude.unwrap_or(Attitude::IDENTITY),
    };
    Some(Mount::new(position.unwrap_or(Offset::ZERO), attitude))
}

/// The attitude whose forward axis is `direction`, without roll.
fn looking(direction: DVec3) -> Attitude {
    let level = math::hypot(direction.x, direction.y);
    let yaw = if level == 0.0 {
        0.0
    } else {
        math::atan2(direction.y, direction.x)
    };
    let pitch = -math::atan2(direction.z, level);
    Attitude::from_rpy(Angle::ZERO, Angle::si(pitch), Yaw::new(Angle::si(yaw)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gear_looks_where_it_points() {
        for direction in [
            DVec3::X,
            DVec3::Y,
            -DVec3::X,
            DVec3::Z,
            -DVec3::Z,
            DVec3::new(1.0, 1.0, -1.0),
            DVec3::new(-2.0, 0.5, 3.0),
        ] {
            let forward = looking(direction).forward();
            assert!(
                (forward - direction.normalize()).length() < 1e-12,
                "{direction}: {forward}"
            );
        }
    }
}
