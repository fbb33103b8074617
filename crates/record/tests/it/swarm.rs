//! A swarm to record: made-up numbers that are different for every vehicle, tick and axis.

use simbeeotic_record::{
    Attachment, Event, Header, LogEntry, LogLevel, Metric, Metrics, Precision, RecordStats,
    Recorder, Sample, Vehicle,
};
use std::collections::BTreeMap;
use std::path::Path;

pub(crate) const TICK_NS: u64 = 100_000_000;

pub(crate) fn vehicles(count: usize) -> Vec<Vehicle> {
    let vehicle = |number: usize| Vehicle {
        path: format!("bee-{number}"),
        kind: "instrument-bee".into(),
        radius_m: 0.01 + number as f64,
        ..Vehicle::default()
    };
    (0..count).map(vehicle).collect()
}

pub(crate) fn header(count: usize) -> Header {
    let scenario = "[run]\nseed = 111982\n";
    Header {
        version: "0.1.0".into(),
        seed: 111_982,
        scenario: scenario.into(),
        notes: BTreeMap::from([("host".into(), "wüste".into())]),
        files: vec![Attachment {
            name: "scenario.toml".into(),
            media_type: "application/toml".into(),
            bytes: scenario.as_bytes().to_vec(),
        }],
        vehicles: vehicles(count),
        precision: Precision::Full,
        ..Header::default()
    }
}

/// Velocities and rates are numbers that an `f32` holds exactly, as they are recorded as such.
pub(crate) fn sample(tick: u64, vehicle: usize) -> Sample {
    let number = |axis: u64| (tick * 1000 + vehicle as u64 * 16 + axis) as f64;
    Sample {
        position_m: [number(0) / 7.0, -number(1) / 7.0, number(2) / 7.0],
        world_from_body: [0.6, 0.0, number(3) / 1e7, -0.8],
        velocity_m_s: [number(4) / 8.0, 0.0, -number(5) / 8.0],
        rate_rad_s: [number(6) / 8.0, -number(7) / 8.0, 0.5],
    }
}

pub(crate) fn samples(tick: u64, count: usize) -> impl Iterator<Item = Sample> {
    (0..count).map(move |vehicle| sample(tick, vehicle))
}

pub(crate) fn event(tick: u64) -> Event {
    Event {
        time_ns: tick * TICK_NS,
        kind: "contact".into(),
        paths: vec!["bee-0".into(), "bee-1".into()],
        text: format!("contact {tick}"),
    }
}

pub(crate) fn log(tick: u64) -> LogEntry {
    LogEntry {
        time_ns: tick * TICK_NS,
        level: LogLevel::Warning,
        path: "bee-0".into(),
        text: format!("line {tick}"),
    }
}

pub(crate) fn metrics(tick: u64) -> Metrics {
    Metrics {
        time_ns: tick * TICK_NS,
        values: vec![Metric {
            name: "pollen".into(),
            unit: "g".into(),
            value: tick as f64 / 3.0,
        }],
    }
}

/// Records a swarm with something on every channel.
pub(crate) fn record(path: &Path, header: Header, ticks: u64) -> RecordStats {
    let count = header.vehicles.len();
    let mut recorder = Recorder::create(path, header).expect("created");
    for tick in 0..ticks {
        recorder
            .tick(tick * TICK_NS, samples(tick, count))
            .expect("recorded");
        if tick % 10 == 3 {
            recorder.event(event(tick)).expect("recorded");
            recorder.log(log(tick)).expect("recorded");
            recorder.metrics(metrics(tick)).expect("recorded");
        }
    }
    recorder
        .finish(&serde_json::json!({ "events": 17, "trace": "0123" }))
        .expect("finished")
}
