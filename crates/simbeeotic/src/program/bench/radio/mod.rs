//! What gets through on one IEEE 802.15.4 channel: nodes that stand still, each of which asks for one
//! broadcast a second; unslotted CSMA/CA, log-distance loss with ns-3's defaults.
//!
//! The medium is driven by itself, without vehicles, as the engine would drive it. What it lets
//! through can then be held against other simulators on the same topology; what `compare/ns3` made
//! of ours lies beside the tests of `crates/radio`.
//!
//! A short run of few nodes is mostly chance, so several are made, and their mean is told ([`tally`]).

mod tally;
mod topology;

use super::{Failure, input, remark, say, table};
use clap::{Args, ValueEnum};
use serde::Serialize;
use simbeeotic_kernel::rng::{draw_u64, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Ieee802154Config, Ieee802154Medium, LogDistance, Medium, Phy, RadioSpec, cc2420, drive,
};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tally::{Sum, Tally};
use topology::Node;

/// Arguments of `bench radio`.
#[derive(Args)]
pub(in crate::program) struct Options {
    /// Where the nodes are: CSV with the columns node,x_m,y_m,z_m,phase_s; may be given many times
    #[arg(long, value_name = "FILE", required = true, num_args = 1..)]
    topology: Vec<PathBuf>,
    /// Noise floor, threshold of the clear channel, and how close to ns-3
    #[arg(long, value_enum, default_value_t = Preset::Ns3)]
    preset: Preset,
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
    /// Master seed, a whole number: another seed, other backoffs. Each run's own seed comes from
    /// this one, the topology and the run's number
    #[arg(long, default_value_t = 1, allow_negative_numbers = true)]
    seed: i64,
    /// Independent runs of each topology, 1 to 1000. Told is their mean: counts rounded, the ratio that
    /// of the sums [default: as many as make 50,000 requests in all, but 50 at most]
    #[arg(long, value_name = "N", value_parser = super::arguments::repeats, allow_negative_numbers = true)]
    repeat: Option<u32>,
    /// Print an object as JSON; an array of them for several topologies
    #[arg(long)]
    json: bool,
}

/// Whose receivers and medium access.
#[derive(Clone, Copy, ValueEnum)]
enum Preset {
    /// ns-3 3.37 with its quirks
    Ns3,
    /// The datasheet of the CC2420
    Cc2420,
    /// The radio's own numbers: here a CC2420's
    Radio,
}

impl Preset {
    fn name(self) -> &'static str {
        match self {
            Self::Ns3 => "ns3",
            Self::Cc2420 => "cc2420",
            Self::Radio => "radio",
        }
    }

    fn config(self) -> Ieee802154Config {
        match self {
            Self::Ns3 => Ieee802154Config::ns3(),
            Self::Cc2420 => Ieee802154Config {
                phy: Some(Phy::cc2420()),
                ..Ieee802154Config::default()
            },
            Self::Radio => Ieee802154Config::default(),
        }
    }
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
            Ok(Row {
                topology,
                nodes: nodes.len(),
                tally: runs(options, &nodes, until)?,
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

/// So many requests, in all runs of a topology, leave little to chance: a standard error of the ratio of
/// some 0.002 where nodes speak at once.
const REQUESTS: u64 = 50_000;
/// More runs than this there are only on demand.
const RUNS_MAX: u64 = 50;

/// The runs of one topology, in the mean.
fn runs(options: &Options, nodes: &[Node], until: SimTime) -> Result<Tally, Failure> {
    let key = key(nodes);
    let places = drive::Still::at(nodes.iter().map(|node| node.position));
    let phases_ns: Vec<u64> = nodes.iter().map(|node| node.phase_ns).collect();
    let payload: Arc<[u8]> = Arc::from(vec![0; options.payload]);
    let (mut sum, mut run) = (Sum::default(), 0);
    loop {
        let seed = draw_u64(options.seed as u64, key, run);
        let mut medium = medium(options.preset, seed, nodes)?;
        let requests = drive::each_second(&phases_ns, Arc::clone(&payload), until);
        let delivered = drive::drive(&mut medium, &places, requests);
        sum.add(&medium.access_statistics(), delivered);
        run += 1;
        let wanted = options.repeat.map_or_else(
            || REQUESTS.div_ceil(sum.requests_each().max(1)).min(RUNS_MAX),
            u64::from,
        );
        if run >= wanted {
            return Ok(sum.mean(nodes.len()));
        }
    }
}

/// What tells one topology from another: its rows, whatever their order and however they are written.
fn key(nodes: &[Node]) -> u64 {
    let row = |node: &Node| {
        let [x, y, z] = node.position.si().to_array();
        format!("{:?},{x:?},{y:?},{z:?},{}\n", node.name, node.phase_ns)
    };
    let mut rows: Vec<String> = nodes.iter().map(row).collect();
    rows.sort_unstable();
    path_key(&rows.concat())
}

/// A channel with a radio for each node.
fn medium(preset: Preset, seed: u64, nodes: &[Node]) -> Result<Ieee802154Medium, Failure> {
    let mut medium = Ieee802154Medium::new(Ieee802154Config {
        seed,
        propagation: Arc::new(LogDistance::ns3()),
        // Frames wait as long as it takes, as in ns-3.
        queue_frames: Some(usize::MAX),
        ..preset.config()
    })
    .map_err(Failure::run)?;
    let spec = cc2420::spec(11, 31).ok_or_else(|| Failure::run("no channel 11, or level 31"))?;
    for (owner, node) in (0..).map(ModelId).zip(nodes) {
        let key = path_key(&format!("{}/radio", node.name));
        let spec = spec.clone();
        medium
            .add(RadioSpec { owner, key, ..spec })
            .map_err(Failure::run)?;
    }
    Ok(medium)
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
        options.preset.name(),
    ));
    let width = rows.iter().map(|row| row.topology.chars().count()).max();
    let width = width.unwrap_or(0).max("topology".len());
    let cells = |name: &str, rest: [&str; 8]| {
        let rest: String = rest.iter().map(|cell| format!(" {cell:>11}")).collect();
        say(format!("{name:<width$}{rest}"))
    };
    cells(
        "topology",
        [
            "nodes",
            "runs",
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
            tally.runs.to_string(),
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
        "counts: mean of the runs, rounded; failures: given up since the channel stayed busy; ratio: delivered / \
         (transmitted x (nodes - 1)), summed over the runs; delay: from the request to the first bit, of the \
         transmitted",
    );
    Ok(())
}
