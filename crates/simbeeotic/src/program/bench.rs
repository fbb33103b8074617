//! `bench`: the paper's experiments on this machine.

use super::arguments::BenchOptions;
use super::{Failure, input, remark, say, show};
use serde::Serialize;
use simbeeotic_model::{Simulation, Summary};
use simbeeotic_scenario::{Request, load_text};

/// One row of the table of figure 7: seconds of wall time for `virtual_s` seconds of virtual time.
#[derive(Serialize)]
struct Row {
    n: u32,
    events_s: f64,
    physics_s: f64,
    radio_s: f64,
    other_s: f64,
    wall_s: f64,
    speed: f64,
    virtual_s: f64,
    threads: usize,
    events: u64,
    touches: u64,
    trace_hash: String,
}

/// Figure 7: random walk at 10 Hz, compass at 1 Hz, no radio; the swarm grows.
pub(super) fn bench(options: &BenchOptions) -> Result<(), Failure> {
    let duration = input::time("--duration", &options.duration)?;
    let mut rows = Vec::new();
    if !options.json {
        remark(format!(
            "figure 7: {} s virtual, {}, {} start, {} timers, contacts {}",
            duration.secs(),
            show::threads(options.threads),
            options.start,
            options.phase,
            if options.no_contacts { "off" } else { "on" },
        ));
        say(format!(
            "{:>8} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9}",
            "n", "events s", "physics s", "radio s", "other s", "wall s", "speed"
        ))?;
    }
    for &n in &options.n {
        let row = measure(n, options)?;
        if !options.json {
            say(format!(
                "{:>8} {:>10.3} {:>10.3} {:>10.3} {:>10.3} {:>10.3} {:>8.1}x",
                row.n, row.events_s, row.physics_s, row.radio_s, row.other_s, row.wall_s, row.speed
            ))?;
        }
        rows.push(row);
    }
    if options.json {
        match serde_json::to_string_pretty(&rows) {
            Ok(text) => say(text)?,
            Err(e) => return Err(Failure::run(e)),
        }
    } else {
        remark(
            "the paper's soft real-time limit for this workload: 3,074 MAVs (2.2 GHz quad-core, 2011)",
        );
    }
    Ok(())
}

fn measure(n: u32, options: &BenchOptions) -> Result<Row, Failure> {
    let text = scenario(n, options);
    let loaded = load_text("figure 7", &text, &Request::default())
        .map_err(|rejected| Failure::run(input::text_of(&rejected)))?;
    let mut setup = input::setup(&loaded)?;
    setup.threads = options.threads;
    let mut simulation = Simulation::new(setup).map_err(|e| input::setup_failure(&loaded, e))?;
    let outcome = simulation.run();
    match outcome.error {
        Some(error) => Err(Failure::run(error)),
        None => Ok(row(n, outcome.summary)),
    }
}

fn row(n: u32, summary: Summary) -> Row {
    Row {
        n,
        events_s: summary.time.events_s,
        physics_s: summary.time.physics_s,
        radio_s: summary.time.radio_s,
        other_s: summary.time.other_s,
        wall_s: summary.wall_s,
        speed: summary.speed,
        virtual_s: summary.virtual_s,
        threads: summary.threads,
        events: summary.events,
        touches: summary.touches,
        trace_hash: summary.trace_hash,
    }
}

/// The paper's section 5.1: start within 20 m, or at one bee per 8 cubic metres.
fn scenario(n: u32, options: &BenchOptions) -> String {
    let edge = match options.start.as_str() {
        "density" => 2.0 * simbeeotic_units::math::pow(f64::from(n), 1.0 / 3.0),
        _ => 20.0,
    };
    let (contacts, phase) = (!options.no_contacts, &options.phase);
    let contact_mode = if contacts { "respond" } else { "none" };
    format!(
        r#"
[run]
seed = 111982
end_time = "{duration}"

[[model]]
use = "instrument-bee"
name = "bee"
count = {n}
start = {{ box = ["{edge} m", "{edge} m", "{edge} m"] }}

[model.params]
phase = "{phase}"

[model.vehicle]
use = "simple-bee"
phase = "{phase}"
contacts = "{contact_mode}"
bee_collisions = {contacts}

[model.sensor.compass]
use = "compass"
"#,
        duration = options.duration,
    )
}
