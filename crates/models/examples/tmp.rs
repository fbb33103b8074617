//! tmp
#[path = "../tests/it/swarm.rs"]
mod swarm;
use swarm::*;
use std::sync::Arc;
use simbeeotic_model::world::Calm;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let n: usize = a[1].parse().unwrap();
    let secs: u64 = a[2].parse().unwrap();
    let radio = a[3] == "radio";
    let phase = a[4].as_str();
    let threads: usize = a[5].parse().unwrap();
    let mut rng = simbeeotic_model::kernel::Stream::new(1, "x", "y");
    let t = std::time::Instant::now();
    let bees = (0..n).map(|i| {
        let at = [rng.uniform() * 20.0, rng.uniform() * 20.0, rng.uniform() * 20.0];
        let b = vehicle(&format!("bee-{i}"), "instrument-bee", &[("phase", phase)], &[("bee_collisions", "true"), ("phase", phase)], at);
        let b = with_sensor(b, "compass", "compass");
        if radio { with_radio(b) } else { b }
    }).collect();
    let mut run = run_in(bees, secs, Arc::new(Calm), threads);
    println!("build {:?}", t.elapsed());
    let t = std::time::Instant::now();
    let o = run.run();
    println!("wall {:?} for {secs} s", t.elapsed());
    println!("{:?} {:?}", o.error, o.summary.time);
    println!("events {} instants {} touches {} packets {:?} hash {}", o.summary.events, o.summary.instants, o.summary.touches, o.summary.packets, o.summary.trace_hash);
}
