//! What gets through on one IEEE 802.15.4 channel: nodes that stand still, each of which asks for one
//! broadcast a second; unslotted CSMA/CA, log-distance loss with ns-3's defaults.
//!
//! The medium is driven by itself, without vehicles, as the engine would drive it. What it lets
//! through can then be held against other simulators on the same topology; what `compare/ns3` made
//! of ours lies beside the tests of `crates/radio`.

mod drive;
mod topology;

use super::{Failure, input, remark, say, table};
use clap::Args;
use drive::Tally;
use serde::Serialize;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Ieee802154Config, Ieee802154Medium, LogDistance, Medium, Phy, RadioSpec, cc2420,
};
use simbeeotic_units::Decibels;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use topology::Node;

/// Arguments of `bench radio`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// Where the nodes are: CSV with the columns node,x_m,y_m,z_m,phase_s; may be given many times
    #[arg(long, value_name = "FILE", required = true, num_args = 1..)]
    topology: Vec<PathBuf>,
    /// Noise floor, threshold of the clear channel, and how close to ns-3: ns3 (3.37, with its quirks)
    /// or cc2420 (the datasheet's)
    #[arg(long, default_value = "ns3", value_parser = ["ns3", "cc2420"])]
    preset: String,
    /// Bytes of each broadcast, 0 to 116
    #[arg(
        long,
        default_value_t = 20,
        value_name = "BYTES",
        value_parser = payload,
        allow_negative_numbers = true
    )]
    payload: usize,
    /// How long they ask for broadcasts, virtual
    #[arg(
        long,
        default_value = "100 s",
        value_name = "TIME",
        allow_hyphen_values = true
    )]
    duration: String,
    /// All ask at the full second, whatever the topology's phases
    #[arg(long)]
    synchronous: bool,
    /// Master seed, a whole number: another seed, other backoffs
    #[arg(long, default_value_t = 1, allow_negative_numbers = true)]
    seed: i64,
    /// Print an object as JSON; an array of them for several topologies
    #[arg(long)]
    json: bool,
}

fn payload(text: &str) -> Result<usize, String> {
    let most = cc2420::PAYLOAD_BYTES_MAX;
    match text.parse() {
        Ok(bytes) if bytes <= most => Ok(bytes),
        _ => Err(format!("a frame takes between 0 and {most} bytes")),
    }
}

/// One row of the table.
#[derive(Serialize)]
struct Row {
    /// The file, without its folder and ending.
    topology: String,
    nodes: usize,
    #[serde(flatten)]
    tally: Tally,
}

pub(super) fn radio(options: &Options) -> Result<(), Failure> {
    let duration = input::time("--duration", &options.duration)?;
    let until = SimTime::from_time(duration)
        .map_err(|e| Failure::input(format!("--duration {duration}: {e}")))?;
    let rows = read(options)?
        .into_iter()
        .map(|(topology, nodes)| {
            let mut medium = medium(&options.preset, options.seed as u64, &nodes)?;
            Ok(Row {
                topology,
                nodes: nodes.len(),
                tally: drive::drive(&mut medium, &nodes, options.payload, until),
            })
        })
        .collect::<Result<Vec<Row>, Failure>>()?;
    match rows.as_slice() {
        [row] if options.json => say(serde_json::to_string_pretty(row).map_err(Failure::run)?),
        rows if options.json => table::json(rows),
        rows => print(options, rows),
    }
}

/// All topologies, with their names.
fn read(options: &Options) -> Result<Vec<(String, Vec<Node>)>, Failure> {
    let (mut topologies, mut faults) = (Vec::new(), Vec::new());
    for path in &options.topology {
        match topology::read(path, !options.synchronous) {
            Ok(nodes) => topologies.push((name(path), nodes)),
            Err(fault) => faults.push(fault),
        }
    }
    match faults.is_empty() {
        true => Ok(topologies),
        false => Err(Failure::input(faults.join("\n"))),
    }
}

fn name(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    stem.to_string_lossy().into_owned()
}

/// A channel with a radio for each node.
fn medium(preset: &str, seed: u64, nodes: &[Node]) -> Result<Ieee802154Medium, Failure> {
    let config = match preset {
        "cc2420" => Ieee802154Config {
            phy: Some(Phy::cc2420()),
            ..Ieee802154Config::default()
        },
        _ => Ieee802154Config::ns3(),
    };
    let mut medium = Ieee802154Medium::new(Ieee802154Config {
        seed,
        propagation: Arc::new(ns3_log_distance()),
        // Frames wait as long as it takes, as in ns-3.
        queue_frames: Some(usize::MAX),
        ..config
    })
    .map_err(Failure::run)?;
    let spec = cc2420::spec(11, 31).ok_or_else(|| Failure::run("no channel 11, or level 31"))?;
    for (owner, node) in (0..).map(ModelId).zip(nodes) {
        let key = path_key(&format!("node-{}/radio", node.number));
        let spec = spec.clone();
        medium
            .add(RadioSpec { owner, key, ..spec })
            .map_err(Failure::run)?;
    }
    Ok(medium)
}

/// The loss that ns-3 takes unless told otherwise: exponent 3, 46.6777 dB at 1 m.
fn ns3_log_distance() -> LogDistance {
    LogDistance {
        reference_loss: Some(Decibels::from_db(46.6777)),
        ..LogDistance::default()
    }
}

fn print(options: &Options, rows: &[Row]) -> Result<(), Failure> {
    remark(format!(
        "{} bytes each second for {}, {} phases, preset {}",
        options.payload,
        options.duration,
        if options.synchronous {
            "synchronous"
        } else {
            "the topology's"
        },
        options.preset,
    ));
    let width = rows.iter().map(|row| row.topology.chars().count()).max();
    let width = width.unwrap_or(0).max("topology".len());
    let cells = |name: &str, rest: [&str; 7]| {
        let rest: String = rest.iter().map(|cell| format!(" {cell:>11}")).collect();
        say(format!("{name:<width$}{rest}"))
    };
    cells(
        "topology",
        [
            "nodes",
            "requests",
            "failures",
            "transmitted",
            "delivered",
            "ratio",
            "delay ms",
        ],
    )?;
    for Row {
        topology,
        nodes,
        tally,
    } in rows
    {
        let figures = [
            nodes.to_string(),
            tally.requests.to_string(),
            tally.access_failures.to_string(),
            tally.transmitted.to_string(),
            tally.delivered.to_string(),
            table::figure(tally.ratio, 4),
            table::figure(tally.mean_access_delay_ms, 3),
        ];
        cells(topology, figures.each_ref().map(String::as_str))?;
    }
    remark(
        "failures: given up since the channel stayed busy; ratio: delivered / (transmitted x (nodes - 1)); \
         delay: from the request to the first bit, of the transmitted",
    );
    Ok(())
}
