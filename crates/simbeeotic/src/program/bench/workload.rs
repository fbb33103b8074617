//! The workload of the paper's section 5.1, and what one run of it costs: a random walk in steps of
//! 0.1 s, a compass read once a second; for figure 8, a broadcast of four bytes once a second, which
//! everybody listens to.

use super::{Failure, input, process};
use serde::{Deserialize, Serialize};
use simbeeotic_model::world::World;
use simbeeotic_model::{Setup, Simulation};
use simbeeotic_scenario::{Loaded, Request, load_text};
use std::sync::Arc;
use std::time::Duration;

/// Edge of the cube that the paper's bees start in, m.
pub(super) const PAPER_EDGE_M: f64 = 20.0;

/// The bees' greatest speed, m/s.
pub(super) const MAX_SPEED_M_S: f64 = 2.0;

/// Master seed of all runs.
pub(super) const SEED: u64 = 111_982;

/// A swarm at the paper's work.
pub(super) struct Workload<'a> {
    pub(super) bees: u32,
    /// Virtual time, s.
    pub(super) duration_s: f64,
    /// They start in a box with these edges and one corner in the origin, m.
    pub(super) edges_m: [f64; 3],
    /// `aligned` or `random`.
    pub(super) phase: &'a str,
    pub(super) contacts: bool,
    /// What `[channel]` says, if they carry radios.
    pub(super) channel: Option<&'a str>,
}

impl Workload<'_> {
    /// As a checked scenario.
    pub(super) fn load(&self) -> Result<Loaded, Failure> {
        let Self {
            bees,
            duration_s,
            edges_m: [east, north, up],
            phase,
            contacts,
            channel,
        } = self;
        let mode = if *contacts { "respond" } else { "none" };
        let channel = channel.map_or_else(String::new, |said| {
            format!("[model.radio]\nuse = \"cc2420\"\n\n[channel]\n{said}\n")
        });
        let text = format!(
            r#"
[run]
seed = {SEED}
end_time = "{duration_s} s"

[[model]]
use = "instrument-bee"
name = "bee"
count = {bees}
start = {{ box = ["{east} m", "{north} m", "{up} m"] }}

[model.params]
max_speed = "{MAX_SPEED_M_S} m/s"
phase = "{phase}"

[model.vehicle]
use = "simple-bee"
phase = "{phase}"
contacts = "{mode}"
bee_collisions = {contacts}

[model.sensor.compass]
use = "compass"

{channel}"#
        );
        load_text("bench", &text, &Request::default())
            .map_err(|rejected| Failure::run(input::text_of(&rejected)))
    }
}

/// What a run costs. Seconds are wall time, unless they are the processor's.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Cost {
    pub(super) events_s: f64,
    pub(super) physics_s: f64,
    pub(super) radio_s: f64,
    pub(super) other_s: f64,
    pub(super) wall_s: f64,
    /// Virtual seconds in a second of wall time.
    pub(super) speed: f64,
    /// Processor time of all threads, in user and in system mode.
    pub(super) cpu_s: Option<f64>,
    /// Processor time of the thread that used most: with a processor for each thread, a run cannot
    /// take less.
    pub(super) busiest_thread_s: Option<f64>,
    pub(super) virtual_s: f64,
    pub(super) events: u64,
    pub(super) touches: u64,
    /// Packets put on the air, and packets received, counted at each receiver.
    #[serde(skip)]
    pub(super) packets: [u64; 2],
    pub(super) trace_hash: String,
}

impl Cost {
    /// The least of each figure of the two.
    pub(super) fn least(&mut self, other: &Self) {
        let keep = |mine: &mut f64, theirs: f64| *mine = mine.min(theirs);
        keep(&mut self.events_s, other.events_s);
        keep(&mut self.physics_s, other.physics_s);
        keep(&mut self.radio_s, other.radio_s);
        keep(&mut self.other_s, other.other_s);
        keep(&mut self.wall_s, other.wall_s);
        self.speed = self.speed.max(other.speed);
        for (mine, theirs) in [
            (&mut self.cpu_s, other.cpu_s),
            (&mut self.busiest_thread_s, other.busiest_thread_s),
        ] {
            if let (Some(mine), Some(theirs)) = (mine, theirs) {
                keep(mine, theirs);
            }
        }
    }
}

/// Runs a scenario once, with `world` in place of its own if there is one; it ends after so much wall time.
pub(super) fn run(
    loaded: &Loaded,
    threads: usize,
    world: Option<&Arc<World>>,
    wall: Option<Duration>,
) -> Result<Cost, Failure> {
    let mut setup = input::setup(loaded)?;
    setup.limits.wall = wall;
    let world = world.map_or_else(|| Arc::clone(&setup.world), Arc::clone);
    let setup = Setup {
        threads,
        world,
        ..setup
    };
    let mut simulation = Simulation::new(setup).map_err(|e| input::setup_failure(loaded, e))?;
    let (begun, threads_begun) = (process::cpu_s(), process::threads_cpu_s());
    let outcome = simulation.run();
    let cpu_s = process::cpu_s().zip(begun).map(|(now, begun)| now - begun);
    let busiest_thread_s = process::busiest_since(&threads_begun);
    if let Some(error) = outcome.error {
        return Err(Failure::run(error));
    }
    let summary = outcome.summary;
    let [events_s, physics_s, radio_s, other_s] = within(
        [
            summary.time.events_s,
            summary.time.physics_s,
            summary.time.radio_s,
            summary.time.other_s,
        ],
        summary.wall_s,
    );
    Ok(Cost {
        events_s,
        physics_s,
        radio_s,
        other_s,
        wall_s: summary.wall_s,
        speed: summary.speed,
        cpu_s,
        busiest_thread_s,
        virtual_s: summary.virtual_s,
        events: summary.events,
        touches: summary.touches,
        packets: [summary.packets.sent, summary.packets.received],
        trace_hash: summary.trace_hash,
    })
}

/// Parts of a whole. They are measured at some instants and taken for all of them: on a machine that is busy with other
/// things they may be more than there is. Then each has its share.
fn within(parts_s: [f64; 4], whole_s: f64) -> [f64; 4] {
    let sum: f64 = parts_s.iter().sum();
    match sum > whole_s {
        true => parts_s.map(|part| part * whole_s / sum),
        false => parts_s,
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// Of a run of ten virtual seconds.
    pub(in crate::program::bench) fn cost(wall_s: f64, trace_hash: &str) -> Cost {
        Cost {
            events_s: 0.25 * wall_s,
            physics_s: 0.5 * wall_s,
            radio_s: 0.0,
            other_s: 0.25 * wall_s,
            wall_s,
            speed: 10.0 / wall_s,
            cpu_s: Some(0.75 * wall_s),
            busiest_thread_s: None,
            virtual_s: 10.0,
            events: 7,
            touches: 0,
            packets: [0; 2],
            trace_hash: trace_hash.to_owned(),
        }
    }

    #[test]
    fn the_parts_of_a_run_are_never_more_than_the_whole() {
        assert_eq!(within([1.0, 2.0, 0.0, 0.5], 4.0), [1.0, 2.0, 0.0, 0.5]);
        assert_eq!(within([1.0, 6.0, 0.0, 1.0], 4.0), [0.5, 3.0, 0.0, 0.5]);
    }

    #[test]
    fn the_least_is_taken_figure_by_figure() {
        let mut least = Cost {
            physics_s: 0.125,
            ..cost(2.0, "a")
        };
        least.least(&cost(1.0, "a"));
        assert_eq!((least.wall_s, least.physics_s), (1.0, 0.125));
        assert_eq!((least.cpu_s, least.speed), (Some(0.75), 10.0));
    }
}
