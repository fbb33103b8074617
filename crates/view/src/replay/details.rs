//! What a recording knows of one vehicle at a time.

use super::Shown;
use crate::live::details::{beams, mount};
use crate::series::History;
use crate::wire::{
    BatteryDetails, Details, PacketDetails, Part, RadioDetails, SensorDetails, seconds,
};
use simbeeotic_record::{Packet, Reading};
use std::collections::{BTreeMap, BTreeSet};

/// How far back readings and packets are looked for, ns: first near, then far.
const BACK: [u64; 2] = [2_000_000_000, 60_000_000_000];

/// Packets that are told.
const PACKETS: usize = 20;

/// When a radio sent and received, ns, in order: where its counters were not recorded, but packets were.
#[derive(Default)]
pub(super) struct Counted {
    sent_ns: Vec<u64>,
    received_ns: Vec<u64>,
    /// Whether the packets of all radios were recorded. If not, those of this one were if there are any.
    all: bool,
}

/// What the radios of a vehicle sent and received, by their names on board, as far as the packets tell; nothing of radios
/// whose counters were recorded.
pub(super) fn count(shown: &Shown, vehicle: u32) -> BTreeMap<String, Counted> {
    let mut all: BTreeMap<String, Counted> = BTreeMap::new();
    let recording = &shown.recording;
    let mut packets = recording.packets_in(0..=u64::MAX).flatten().peekable();
    if packets.peek().is_none() {
        return all;
    }
    let path = &recording.vehicles()[vehicle as usize].path;
    let about = recording.about(vehicle as usize).ok().flatten();
    for radio in about.iter().flat_map(|about| &about.radios) {
        all.insert(radio.name.clone(), Counted::default());
    }
    let on_board = |radio: &str| {
        let name = radio.strip_prefix(path.as_str())?.strip_prefix('/')?;
        (!name.contains('/')).then(|| name.to_owned())
    };
    let (mut counters, mut total) = (BTreeSet::new(), [(0, 0); 2]);
    for traffic in recording.traffic_in(0..=u64::MAX).flatten() {
        match traffic.radio.as_str() {
            "" => total = [total[1], (traffic.time_ns, traffic.total.sent)],
            radio => counters.extend(on_board(radio)),
        }
    }
    // Of a file that was cut off the last packets may be missing, not those of the period before.
    let (until_ns, sent) = total[usize::from(!recording.truncated())];
    let mut found = 0;
    for packet in packets {
        found += u64::from(packet.time_ns <= until_ns);
        if let Some(name) = on_board(&packet.radio) {
            all.entry(name).or_default().sent_ns.push(packet.time_ns);
        }
        for received in &packet.receptions {
            if let Some(name) = on_board(&received.radio) {
                let times = &mut all.entry(name).or_default().received_ns;
                times.push(received.time_ns);
            }
        }
    }
    all.retain(|name, _| !counters.contains(name));
    for counted in all.values_mut() {
        counted.all = found >= sent;
        counted.sent_ns.sort_unstable();
        counted.received_ns.sort_unstable();
    }
    all
}

/// All there is to tell. `numbers`: what the vehicle published; `counted`: what its radios did, if that is known
/// from packets only.
pub(super) fn tell(
    shown: &Shown,
    vehicle: u32,
    time_ns: u64,
    numbers: &BTreeMap<String, History>,
    counted: &BTreeMap<String, Counted>,
) -> Details {
    let time_s = seconds(time_ns);
    let path = &shown.recording.vehicles()[vehicle as usize].path;
    let mut details = Details {
        vehicle,
        t: time_s,
        ..Details::default()
    };
    let about = shown.recording.about(vehicle as usize).ok().flatten();
    if let Some(about) = about {
        details.parts = (about.parts.iter())
            .map(|part| Part {
                place: part.place.clone(),
                name: part.name.clone(),
                parameters: part.parameters.clone(),
            })
            .collect();
        details.sensors = (about.sensors.iter())
            .map(|sensor| SensorDetails {
                name: sensor.name.clone(),
                mount: mount(&sensor.mount),
                beams: sensor.beams.as_ref().map(beams),
                ..SensorDetails::default()
            })
            .collect();
        details.radios = (about.radios.iter())
            .map(|radio| RadioDetails {
                name: radio.name.clone(),
                ..RadioDetails::default()
            })
            .collect();
    }
    add_readings(shown, &mut details, path, time_ns);
    add_radios(shown, &mut details, path, time_ns);
    let known: BTreeSet<&String> = details.radios.iter().map(|radio| &radio.name).collect();
    let new = counted.keys().filter(|name| !known.contains(name));
    let new: Vec<RadioDetails> = new
        .map(|name| RadioDetails {
            name: name.clone(),
            ..RadioDetails::default()
        })
        .collect();
    details.radios.extend(new);
    for radio in &mut details.radios {
        let Some(counted) = counted.get(&radio.name) else {
            continue;
        };
        let until = |list: &[u64]| list.partition_point(|&at_ns| at_ns <= time_ns) as u64;
        let own = counted.all || !counted.sent_ns.is_empty();
        radio.sent = own.then(|| until(&counted.sent_ns));
        radio.received = counted.all.then(|| until(&counted.received_ns));
    }
    let number = |name: &str| numbers.get(name).map(|history| history.at(time_s));
    details.battery = number("battery/soc").map(|soc| BatteryDetails {
        soc,
        voltage_v: number("battery/voltage").unwrap_or(f64::NAN),
        current_a: number("battery/current").unwrap_or(f64::NAN),
        condition: String::new(),
    });
    details
}

/// The last reading of each of its sensors, not after a time.
fn add_readings(shown: &Shown, details: &mut Details, path: &str, time_ns: u64) {
    let mut last: BTreeMap<String, Reading> = BTreeMap::new();
    for back in BACK {
        let from_ns = time_ns.saturating_sub(back);
        for reading in shown.recording.readings_in(from_ns..=time_ns).flatten() {
            let name = reading.sensor.strip_prefix(path);
            let name = name.and_then(|name| name.strip_prefix('/'));
            if let Some(name) = name.filter(|name| !name.contains('/')) {
                last.insert(name.to_owned(), reading);
            }
        }
        if !last.is_empty() || from_ns == 0 {
            break;
        }
    }
    for (name, reading) in last {
        let known = details
            .sensors
            .iter()
            .position(|sensor| sensor.name == name);
        let at = known.unwrap_or_else(|| {
            details.sensors.push(SensorDetails {
                name,
                ..SensorDetails::default()
            });
            details.sensors.len() - 1
        });
        let sensor = &mut details.sensors[at];
        sensor.t = Some(seconds(reading.time_ns));
        sensor.columns = reading.names.into_iter().zip(reading.units).collect();
        sensor.reading = (!reading.reading.is_empty()).then_some(reading.reading);
        sensor.truth = Some(reading.truth);
        sensor.lost = reading.lost;
    }
}

/// Counters of its radios, where they were recorded, and its last packets.
fn add_radios(shown: &Shown, details: &mut Details, path: &str, time_ns: u64) {
    let from_ns = time_ns.saturating_sub(BACK[1]);
    for traffic in shown.recording.traffic_in(from_ns..=time_ns).flatten() {
        let name = traffic.radio.strip_prefix(path);
        let Some(name) = name.and_then(|name| name.strip_prefix('/')) else {
            continue;
        };
        let known = details.radios.iter().position(|radio| radio.name == name);
        let at = known.unwrap_or_else(|| {
            details.radios.push(RadioDetails {
                name: name.to_owned(),
                ..RadioDetails::default()
            });
            details.radios.len() - 1
        });
        let radio = &mut details.radios[at];
        radio.sent = Some(traffic.total.sent);
        radio.received = Some(traffic.total.received);
        radio.lost = traffic
            .total
            .lost
            .into_iter()
            .filter(|(_, n)| *n > 0)
            .collect();
    }
    let vehicle = details.vehicle;
    for back in BACK {
        let from_ns = time_ns.saturating_sub(back);
        let packets = shown.recording.packets_in(from_ns..=time_ns).flatten();
        let mut list: Vec<PacketDetails> = packets
            .filter_map(|packet| seen_by(shown, &packet, vehicle))
            .collect();
        list.sort_by(|a, b| b.t.total_cmp(&a.t));
        list.truncate(PACKETS);
        details.packets = list;
        if !details.packets.is_empty() || from_ns == 0 {
            return;
        }
    }
}

/// A packet as one vehicle saw it.
fn seen_by(shown: &Shown, packet: &Packet, vehicle: u32) -> Option<PacketDetails> {
    let from = shown.vehicle(&packet.sender);
    let details = |sent, other, rssi_dbm| PacketDetails {
        t: seconds(packet.time_ns),
        sent,
        other,
        bytes: packet.bytes,
        rssi_dbm,
    };
    if from == Some(vehicle) {
        let only = match packet.receptions.as_slice() {
            [one] => shown.vehicle(&one.radio),
            _ => None,
        };
        return Some(details(true, only, None));
    }
    let mut receptions = packet.receptions.iter();
    let heard = receptions.find(|received| shown.vehicle(&received.radio) == Some(vehicle))?;
    Some(details(false, from, Some(heard.rssi_dbm)))
}
