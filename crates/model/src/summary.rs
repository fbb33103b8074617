//! What a run came to: the numbers that the program prints and `--json` gives.

use crate::component::Note;
use serde::Serialize;
use std::collections::BTreeMap;

/// The numbers of one run. Wall-clock figures differ from run to run; all else repeats.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {
    /// The scenario's name.
    pub scenario: String,
    /// The master seed. Serialised with its sign, as files have it: the same 64 bits.
    #[serde(serialize_with = "signed")]
    pub seed: u64,
    /// Number of models.
    pub models: usize,
    /// Number of bodies.
    pub bodies: usize,
    /// Number of radios.
    pub radios: usize,
    /// Threads that ran the models.
    pub threads: usize,
    /// Why it ended: `end time`, `wall time`, a model's own words, ...
    pub ended: String,
    /// Virtual seconds simulated.
    pub virtual_s: f64,
    /// Wall-clock seconds from the first event to the last.
    pub wall_s: f64,
    /// Virtual seconds per wall-clock second.
    pub speed: f64,
    /// Where the wall-clock time went.
    pub time: TimeShares,
    /// Events handled.
    pub events: u64,
    /// Instants: distinct times at which something happened.
    pub instants: u64,
    /// Touches between bodies, and between bodies and the ground.
    pub touches: u64,
    /// Radio packets.
    pub packets: Packets,
    /// Charge drawn by all platforms, by consumer (see [`Consumer::name`](crate::Consumer::name)).
    pub charge: BTreeMap<String, ChargeLine>,
    /// The batteries; absent if there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub batteries: Option<Batteries>,
    /// What models have published, by name; absent if nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub metrics: Vec<MetricLine>,
    /// How late a paced run was; absent when it ran as fast as it could.
    pub lateness: Option<Lateness>,
    /// Hash of everything that happened: equal hashes, equal runs.
    pub trace_hash: String,
    /// The same at the end of each virtual second.
    pub trace_seconds: Vec<String>,
    /// What components add: where the recording is, say.
    pub notes: Vec<Note>,
}

impl Summary {
    /// What the models have published under this name, all together. `None` if nobody has.
    pub fn metric(&self, name: &str) -> Option<&MetricLine> {
        self.metrics.iter().find(|line| line.name == name)
    }

    /// The sum of the last values that models have published under this name: the value itself, if one
    /// model has. 0 if nobody has, as for a count that never began.
    pub fn total(&self, name: &str) -> f64 {
        self.metric(name).map_or(0.0, |line| line.sum)
    }
}

/// Wall-clock seconds by kind of work. For small instants they are sampled, so they are estimates.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct TimeShares {
    /// Building the run, before its first event.
    pub init_s: f64,
    /// Behaviours, vehicles, sensors, and the kernel's calls of them.
    pub events_s: f64,
    /// Moving bodies, finding and resolving contacts.
    pub physics_s: f64,
    /// Who hears what.
    pub radio_s: f64,
    /// The rest: the event queue, commits, components, waiting.
    pub other_s: f64,
}

/// Packets by their fate. Each packet sent may be received, or lost, many times.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Packets {
    /// Frames sent.
    pub sent: u64,
    /// Receptions handed to behaviours.
    pub received: u64,
    /// Receptions lost, by reason.
    pub lost: BTreeMap<String, u64>,
}

/// Charge drawn by one kind of consumer.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct ChargeLine {
    /// Charge, mA·s.
    pub milliampere_seconds: f64,
    /// Energy, J, of those that run on a battery; absent if nobody does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joules: Option<f64>,
}

/// All batteries of a run together, at its end.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Batteries {
    /// How many there are.
    pub count: usize,
    /// The lowest state of charge, 0 to 1.
    pub soc_min: f64,
    /// The mean state of charge, 0 to 1.
    pub soc_mean: f64,
    /// How many platforms are grounded or off, or on their way down, for want of power.
    pub out_of_power: usize,
    /// How often one was empty.
    pub emptied: u64,
    /// How often one was charged until full.
    pub charged: u64,
    /// Energy that loads and resistances took out of what was stored, J; below zero if chargers
    /// gave more.
    pub spent_j: f64,
    /// Energy from chargers, J.
    pub charged_j: f64,
    /// Energy turned into heat in the batteries, J.
    pub heat_j: f64,
}

/// One metric over all models: their number, and what their last values come to.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MetricLine {
    /// Its name.
    pub name: String,
    /// What it is counted in.
    pub unit: String,
    /// How many models have published it.
    pub models: usize,
    /// How many values they have published.
    pub count: u64,
    /// The sum of the last values.
    pub sum: f64,
    /// Their mean.
    pub mean: f64,
    /// The least of them.
    pub min: f64,
    /// The greatest.
    pub max: f64,
}

/// How late a paced run was.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Lateness {
    /// Instants that ran late.
    pub late: u64,
    /// The worst.
    pub max_ms: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it")]
fn signed<S: serde::Serializer>(seed: &u64, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_i64(seed.cast_signed())
}
