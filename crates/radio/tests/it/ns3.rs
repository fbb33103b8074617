//! What gets through on one channel, held against the real ns-3 3.37: the topologies and tables that
//! `compare/ns3` has made. Balls, where everybody hears everybody, and lines, planes and clusters, where
//! some are hidden from others.

use crate::ieee802154::ns3_config;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{Ieee802154Config, Ieee802154Medium, Medium, RadioSpec, cc2420, drive};
use simbeeotic_units::Position;
use simbeeotic_units::glam::DVec3;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/ns3/topologies")
}

/// The rows of a table of ours: no comments, no header.
fn rows(file: &str) -> Vec<Vec<String>> {
    let text = std::fs::read_to_string(folder().join(file)).unwrap();
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(|row| row.split(',').map(str::to_owned).collect())
        .collect()
}

/// Where nodes are, and when in each second they ask for a broadcast, ns.
struct Topology {
    places: Vec<Position>,
    phases_ns: Vec<u64>,
}

impl Topology {
    fn read(name: &str) -> Self {
        let numbers: Vec<Vec<f64>> = rows(&format!("{name}.csv"))
            .iter()
            .map(|row| row.iter().map(|cell| cell.parse().unwrap()).collect())
            .collect();
        Self {
            places: numbers
                .iter()
                .map(|row| Position::from_si(DVec3::new(row[1], row[2], row[3])))
                .collect(),
            phases_ns: numbers
                .iter()
                .map(|row| (row[4] * 1e9).round() as u64)
                .collect(),
        }
    }
}

/// What became of the broadcasts.
#[derive(Clone, Copy, Debug, Default)]
struct Fate {
    runs: f64,
    /// Delivered over transmitted times the number of the others.
    ratio: f64,
    /// Share of the requests that were given up.
    failures: f64,
    delay_ms: f64,
}

impl Fate {
    fn mean(self) -> Self {
        Self {
            runs: 1.0,
            ratio: self.ratio / self.runs,
            failures: self.failures / self.runs,
            delay_ms: self.delay_ms / self.runs,
        }
    }
}

/// One run of ours.
fn run(topology: &Topology, payload: usize, synchronous: bool, seconds: u64) -> Fate {
    let n = topology.places.len();
    let mut medium = Ieee802154Medium::new(Ieee802154Config {
        queue_frames: Some(usize::MAX),
        ..ns3_config(7)
    })
    .unwrap();
    for node in 0..n {
        let spec = RadioSpec {
            owner: ModelId(node as u32),
            key: path_key(&format!("node-{node}/radio")),
            ..cc2420::spec(11, 31).unwrap()
        };
        medium.add(spec).unwrap();
    }
    let phases_ns = match synchronous {
        true => vec![0; n],
        false => topology.phases_ns.clone(),
    };
    let poses = drive::Still::at(topology.places.iter().copied());
    let payload = Arc::from(vec![0; payload]);
    let requests = drive::each_second(&phases_ns, payload, SimTime::from_secs(seconds));
    let delivered = drive::drive(&mut medium, &poses, requests);
    let access = medium.access_statistics();
    assert_eq!(access.requests, seconds * n as u64);
    assert_eq!(access.failures + access.transmitted, access.requests);
    let transmitted = access.transmitted as f64;
    Fate {
        runs: 1.0,
        ratio: delivered as f64 / (transmitted * (n as f64 - 1.0)),
        failures: access.failures as f64 / access.requests as f64,
        delay_ms: access.delay.secs() * 1e3 / transmitted,
    }
}

/// Runs what ns-3 has run with these phases, and compares with the mean of its runs.
fn agrees(phases: &str) {
    // By topology, payload and seconds.
    let mut theirs: BTreeMap<(String, usize, u64), Fate> = BTreeMap::new();
    for row in rows("results.csv").iter().filter(|row| row[3] == phases) {
        let number = |column: usize| row[column].parse::<f64>().unwrap();
        let case = (row[0].clone(), number(2) as usize, number(4) as u64);
        let sum = theirs.entry(case).or_default();
        sum.runs += 1.0;
        sum.ratio += number(11);
        sum.failures += number(7) / number(6);
        sum.delay_ms += number(12);
    }
    assert!(theirs.len() > 20, "{}", theirs.len());
    let mut wrong = Vec::new();
    for ((name, payload, seconds), sum) in theirs {
        let (topology, theirs) = (Topology::read(&name), sum.mean());
        let ours = run(&topology, payload, phases == "synchronous", seconds);
        let line = format!("{name} {payload} B: ns-3 {theirs:.4?}, ours {ours:.4?}");
        let ratio = if topology.places.len() < 500 {
            0.01
        } else {
            0.02
        };
        let near = (ours.ratio - theirs.ratio).abs() <= ratio
            && (ours.failures - theirs.failures).abs() <= 0.015
            && (ours.delay_ms - theirs.delay_ms).abs() <= 0.03 * theirs.delay_ms;
        if !near {
            wrong.push(line);
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn in_random_phases_as_much_gets_through_as_in_ns3() {
    agrees("random");
}

#[test]
fn in_synchronous_phases_as_much_gets_through_as_in_ns3() {
    agrees("synchronous");
}
