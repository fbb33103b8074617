//! Examples: one folder each, with a scenario, a world where it needs one, behaviours, a page that
//! says what to see and what to change first, and a test that the outcome holds.
//!
//! They are written as any author of parts writes, against `simbeeotic` alone: copy a folder into a
//! crate of your own (`simbeeotic new`), add its `mod` line, and go on from there.

/// An example's scenario, for its test: `example("hive/scenario.toml")`.
#[cfg(test)]
fn example(file: &str) -> simbeeotic::Experiment {
    simbeeotic::Experiment::file(format!("{}/{file}", env!("CARGO_MANIFEST_DIR")))
}

pub mod broadcast;
pub mod corridor;
pub mod drop;
pub mod flocking;
pub mod gradient;
pub mod hive;
pub mod looping;
pub mod mine;
pub mod office;
pub mod plume;
pub mod random_walk;
pub mod relay;
pub mod wind;
