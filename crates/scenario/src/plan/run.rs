//! `[run]`: seed, end, threads, pace, limits.

use super::section::{self, Section};
use simbeeotic_model::config::{Fault, Node};
use simbeeotic_model::kernel::{Limits, SimTime};
use simbeeotic_units::Time;
use std::time::Duration;

/// How long a scenario runs, and how.
#[derive(Clone, Debug)]
pub struct Run {
    /// The master seed. All draws of a run hang on it.
    pub seed: u64,
    /// When it ends, and what else ends it.
    pub limits: Limits,
    /// Threads that run models; the trace is the same for any number.
    pub threads: usize,
    /// How many times faster than the wall clock it may run; `None`: as fast as it can.
    pub pace: Pace,
    /// The time of day at its start, from midnight; 8 h unless the scenario says otherwise.
    pub epoch: Time,
}

/// How many times faster than the wall clock a run may be; `None`: as fast as it can.
pub type Pace = Option<f64>;

/// The seed of a scenario that names none.
const SEED: u64 = 1;
/// The time of day at the start of a scenario that names none, in seconds: 8 h.
const EPOCH_S: f64 = 28_800.0;
/// More threads than this are a slip of the keyboard.
const THREADS_MAX: u64 = 4096;

/// Reads the section `[run]` of a scenario.
pub(super) fn read_run(node: &Node, faults: &mut Vec<Fault>) -> Option<Run> {
    let mut section = Section::open(node, "`[run]`", faults)?;
    // Seeds have a sign, as in the original: of a negative one the same 64 bits count.
    let seed: Option<i64> = section.read("seed", faults);
    let end = section.required("end_time", "end_time = \"60 s\"", faults);
    let end = end.and_then(|node| instant(node, faults));
    let wall = section.get("wall_time").map(|node| duration(node, faults));
    let threads: Option<u64> = section.get("threads").and_then(|node| {
        let threads = section::read(node, faults)?;
        if !(1..=THREADS_MAX).contains(&threads) {
            let message = format!("threads lie between 1 and {THREADS_MAX}");
            faults.push(Fault::error(node.span, message));
        }
        Some(threads)
    });
    let pace = section.get("real_time_factor").and_then(|node| {
        let factor: f64 = section::read(node, faults)?;
        if factor <= 0.0 {
            let fault = Fault::error(node.span, "a real-time factor is more than zero");
            faults.push(fault.help("2.0: at most twice as fast as the wall clock"));
        }
        Some(factor)
    });
    let epoch: Option<Time> = section.read("epoch", faults);
    if let (Some(_), Some(node)) = (epoch, section.get("epoch")) {
        faults.push(Fault::warning(
            node.span,
            "`epoch` is read and not acted on yet",
        ));
    }
    let mut limits = Limits {
        end: end.unwrap_or(SimTime::MAX),
        ..Limits::default()
    };
    limits.wall = wall.flatten();
    if let Some(rounds) = positive(&mut section, "rounds_per_instant", faults) {
        limits.rounds_per_instant = u32::try_from(rounds).unwrap_or(u32::MAX);
    }
    if let Some(events) = positive(&mut section, "events_per_instant", faults) {
        limits.events_per_instant = events;
    }
    if let Some(events) = positive(&mut section, "pending_events", faults) {
        limits.queue = usize::try_from(events).unwrap_or(usize::MAX);
    }
    section.finish(faults);
    Some(Run {
        seed: seed.map_or(SEED, |seed| seed as u64),
        limits,
        threads: threads
            .and_then(|n| usize::try_from(n).ok())
            .unwrap_or_else(cores),
        pace,
        epoch: epoch.unwrap_or(Time::si(EPOCH_S)),
    })
}

/// Reads the section `[run]`, which must be there.
pub(super) fn read(root: &mut Section<'_>, faults: &mut Vec<Fault>) -> Option<Run> {
    match root.get("run") {
        Some(node) => read_run(node, faults),
        None => {
            let fault = Fault::error(
                root.node.span,
                "there is no `[run]`, which says when to end",
            );
            faults.push(fault.help("add: [run]  end_time = \"60 s\""));
            None
        }
    }
}

fn instant(node: &Node, faults: &mut Vec<Fault>) -> Option<SimTime> {
    let time: Time = section::read(node, faults)?;
    match SimTime::from_time(time) {
        Ok(SimTime::ZERO) if time != Time::ZERO => {
            let message = format!("{time} is less than a nanosecond, the step of virtual time");
            faults.push(Fault::error(node.span, message));
            None
        }
        Ok(instant) => Some(instant),
        Err(error) => {
            faults.push(Fault::error(node.span, error.to_string()));
            None
        }
    }
}

fn duration(node: &Node, faults: &mut Vec<Fault>) -> Option<Duration> {
    let time: Time = section::read(node, faults)?;
    match Duration::try_from_secs_f64(time.get()) {
        Ok(duration) if !duration.is_zero() => Some(duration),
        _ => {
            let message = "a limit of wall time is at least a nanosecond, and no eternity";
            faults.push(Fault::error(node.span, message));
            None
        }
    }
}

fn positive(section: &mut Section<'_>, key: &'static str, faults: &mut Vec<Fault>) -> Option<u64> {
    let node = section.get(key)?;
    let number: u64 = section::read(node, faults)?;
    if number == 0 {
        faults.push(Fault::error(
            node.span,
            format!("`{key}` is more than zero"),
        ));
    }
    Some(number)
}

/// One thread for each core.
fn cores() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}
