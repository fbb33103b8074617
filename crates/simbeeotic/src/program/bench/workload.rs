//! The workload of the paper's section 5.1, and what one run of it costs: a random walk in steps of
//! 0.1 s, a compass read once a second; for figure 8, a broadcast of four bytes once a second, which
//! everybody listens to.

use super::measure::Stopwatch;
use super::{Failure, input, paper, process};
use serde::{Deserialize, Serialize};
use simbeeotic_kernel::SimTime;
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

/// Until then a run starts: what it makes once, and the first control step, reading and packet of each bee.
/// Behind it there are as many of them in each second.
const START: SimTime = SimTime::from_millis(50);

/// What a run may take, by either clock.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Most {
    pub(super) wall: Option<Duration>,
    /// Processor time of its busiest thread, s.
    pub(super) busiest_s: Option<f64>,
}

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

/// What a run costs. Seconds are wall time, unless they are the processor's; start, events, physics, radio and the
/// rest are all of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Cost {
    /// The start: the first twentieth of a second of virtual time, in which a run makes what it makes once.
    pub(super) start_s: f64,
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
    /// The same of the start alone.
    pub(super) start_busiest_s: Option<f64>,
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
        keep(&mut self.start_s, other.start_s);
        keep(&mut self.events_s, other.events_s);
        keep(&mut self.physics_s, other.physics_s);
        keep(&mut self.radio_s, other.radio_s);
        keep(&mut self.other_s, other.other_s);
        keep(&mut self.wall_s, other.wall_s);
        self.speed = self.speed.max(other.speed);
        for (mine, theirs) in [
            (&mut self.cpu_s, other.cpu_s),
            (&mut self.busiest_thread_s, other.busiest_thread_s),
            (&mut self.start_busiest_s, other.start_busiest_s),
        ] {
            if let (Some(mine), Some(theirs)) = (mine, theirs) {
                keep(mine, theirs);
            }
        }
    }
}

/// What the paper's 100 virtual seconds take, s, if `virtual_s` of them took `whole` and began with `start`: the start
/// once, and the rest as often as it fits.
pub(super) fn stretched(start: f64, whole: f64, virtual_s: f64) -> f64 {
    match virtual_s > START.as_secs_f64() {
        true => start + (whole - start).max(0.0) * paper::DURATION_S / virtual_s,
        // Cut off in its start, or shorter than it.
        false if start > 0.0 => f64::INFINITY,
        false => whole * paper::DURATION_S / virtual_s,
    }
}

/// Runs a scenario once, with `world` in place of its own if there is one; it ends when it has taken the most that it
/// may.
pub(super) fn run(
    loaded: &Loaded,
    threads: usize,
    world: Option<&Arc<World>>,
    most: Most,
) -> Result<Cost, Failure> {
    let mut setup = input::setup(loaded)?;
    setup.limits.wall = most.wall;
    let world = world.map_or_else(|| Arc::clone(&setup.world), Arc::clone);
    let setup = Setup {
        threads,
        world,
        ..setup
    };
    let mut simulation = Simulation::new(setup).map_err(|e| input::setup_failure(loaded, e))?;
    if let Some(busiest_s) = most.busiest_s {
        stop_after(busiest_s, &simulation);
    }
    let (begun, threads_begun) = (process::cpu_s(), process::Threads::now());
    let watch = Stopwatch::start();
    // What is shorter than its start twice is all rest.
    let starts = simulation.end() >= START.saturating_add_nanos(START.nanos());
    if starts {
        simulation.run_until(START).map_err(Failure::run)?;
    }
    let start_s = if starts { watch.elapsed_s() } else { 0.0 };
    let start_busiest_s = match starts {
        true => threads_begun.busiest_s(),
        false => Some(0.0),
    };
    let start = simulation.shares(start_s);
    let outcome = simulation.run();
    let wall_s = watch.elapsed_s();
    let cpu_s = process::cpu_s().zip(begun).map(|(now, begun)| now - begun);
    let busiest_thread_s = threads_begun.busiest_s();
    if let Some(error) = outcome.error {
        return Err(Failure::run(error));
    }
    let (summary, whole) = (outcome.summary, simulation.shares(wall_s));
    let [events_s, physics_s, radio_s] = within(
        [
            whole.events_s - start.events_s,
            whole.physics_s - start.physics_s,
            whole.radio_s - start.radio_s,
        ],
        wall_s - start_s,
    );
    Ok(Cost {
        start_s,
        events_s,
        physics_s,
        radio_s,
        other_s: (wall_s - start_s - events_s - physics_s - radio_s).max(0.0),
        wall_s,
        speed: summary.virtual_s / wall_s.max(1e-9),
        cpu_s,
        busiest_thread_s,
        start_busiest_s,
        virtual_s: summary.virtual_s,
        events: summary.events,
        touches: summary.touches,
        packets: [summary.packets.sent, summary.packets.received],
        trace_hash: summary.trace_hash,
    })
}

/// Ends a run when its busiest thread has taken so much processor time, s; looks now and then.
fn stop_after(busiest_s: f64, simulation: &Simulation) {
    let (control, progress) = (simulation.control(), simulation.progress());
    let begun = process::Threads::now();
    std::thread::spawn(move || {
        while Arc::strong_count(&progress) > 1 {
            std::thread::sleep(LOOKED);
            if begun.busiest_s().is_some_and(|used| used > busiest_s) {
                return control.stop("processor time");
            }
        }
    });
}

/// From look to look at the processor's clock.
const LOOKED: Duration = Duration::from_millis(50);

/// Parts of a whole. They are measured at some instants and taken for all of them: on a machine that is busy with other
/// things they may be more than there is. Then each has its share.
fn within(parts_s: [f64; 3], whole_s: f64) -> [f64; 3] {
    let parts_s = parts_s.map(|part| part.max(0.0));
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
            start_s: 0.0,
            events_s: 0.25 * wall_s,
            physics_s: 0.5 * wall_s,
            radio_s: 0.0,
            other_s: 0.25 * wall_s,
            wall_s,
            speed: 10.0 / wall_s,
            cpu_s: Some(0.75 * wall_s),
            busiest_thread_s: None,
            start_busiest_s: None,
            virtual_s: 10.0,
            events: 7,
            touches: 0,
            packets: [0; 2],
            trace_hash: trace_hash.to_owned(),
        }
    }

    #[test]
    fn the_parts_of_a_run_are_never_more_than_the_whole() {
        assert_eq!(within([1.0, 2.0, 0.5], 4.0), [1.0, 2.0, 0.5]);
        assert_eq!(within([1.0, 6.0, 1.0], 4.0), [0.5, 3.0, 0.5]);
        assert_eq!(within([-1.0, 2.0, 1.0], 4.0), [0.0, 2.0, 1.0]);
    }

    #[test]
    fn the_start_counts_once_whatever_the_rest_is_drawn_for() {
        // Of 3 s for 5 virtual seconds, 1 s is the start.
        assert_eq!(stretched(1.0, 3.0, 5.0), 41.0);
        assert_eq!(stretched(1.0, 3.0, 100.0), 3.0);
        assert_eq!(stretched(0.0, 3.0, 5.0), 60.0);
        // Whoever was stopped in the start has not kept real time.
        assert_eq!(stretched(7.0, 7.0, 0.04), f64::INFINITY);
        assert_eq!(stretched(0.0, 1.0, 0.04), 2500.0);
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
