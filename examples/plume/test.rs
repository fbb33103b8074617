//! The outcome: the leak is found, and why.

use simbeeotic::{Experiment, Run};
use std::sync::LazyLock;

fn plume() -> Experiment {
    crate::example("plume/scenario.toml")
}

fn twenty(experiment: &Experiment) -> Vec<Came> {
    let runs = experiment.seeds(1..21).unwrap_or_else(|e| panic!("{e}"));
    runs.iter().map(came).collect()
}

/// What came of a run.
#[derive(Clone, Copy, Debug)]
struct Came {
    first_s: Option<f64>,
    found_s: Option<f64>,
    error_m: Option<f64>,
}

fn came(run: &Run) -> Came {
    let number = |name| run.metric(name).map(|line| line.sum);
    Came {
        first_s: number("time-to-first"),
        found_s: number("time-to-found"),
        error_m: number("source-error"),
    }
}

/// The example as it stands, seeds 1 to 20.
static AS_IT_STANDS: LazyLock<Vec<Came>> = LazyLock::new(|| twenty(&plume()));

/// In how many runs the base says within 3 m where the leak is.
fn found(runs: &[Came]) -> usize {
    let near = |run: &&Came| run.error_m.is_some_and(|error| error < 3.0);
    runs.iter().filter(near).count()
}

#[test]
fn the_leak_is_found_within_three_metres_whatever_the_seed() {
    let runs = &*AS_IT_STANDS;
    assert!(found(runs) >= 19, "{}", found(runs));
    let first = runs.iter().filter_map(|run| run.first_s);
    let mean = first.sum::<f64>() / 20.0;
    assert!((60.0..150.0).contains(&mean), "{mean} s");
}

/// The control of the nose: it is there, and too dull for what is in the air.
#[test]
fn without_a_smell_nobody_declares_anything() {
    let dull = plume().set("model.bee.sensor.smell.threshold", "\"1 kg/m^3\"");
    for run in dull.seeds(1..4).unwrap_or_else(|e| panic!("{e}")) {
        assert_eq!(run.total("hits"), 0.0);
        assert!(run.metric("declarations").is_none());
    }
}

/// The control of the wind: who believes a forecast loses the plume that turns, and who believes a wrong
/// one never finds its head.
#[test]
fn who_believes_a_forecast_and_not_the_wind_misses_the_leak() {
    let forecast = plume().set("model.bee.params.measure_wind", false);
    let right_at_first = found(&twenty(&forecast));
    assert!(right_at_first <= 9, "{right_at_first}");
    let wrong = forecast.set("model.bee.params.forecast", "\"45 deg\"");
    let wrong = wrong.seeds(1..6).unwrap_or_else(|e| panic!("{e}"));
    let wrong: Vec<Came> = wrong.iter().map(came).collect();
    assert_eq!(found(&wrong), 0);
}

/// Paired by seed: the same places, the same wind. The first declaration does not come sooner (the mean
/// says so); the third does.
#[test]
fn with_calls_three_agree_sooner_than_without() {
    let alone = twenty(&plume().set("model.bee.params.cooperate", false));
    let end = |run: &Came| run.found_s.unwrap_or(300.0);
    let saved = AS_IT_STANDS
        .iter()
        .zip(&alone)
        .map(|(a, b)| end(b) - end(a));
    let saved: Vec<f64> = saved.collect();
    let mean = saved.iter().sum::<f64>() / 20.0;
    let sooner = saved.iter().filter(|s| **s > 0.0).count();
    // By chance alone 15 or more of 20 come in one run of fifty.
    assert!(mean > 5.0 && sooner >= 15, "{sooner}: {saved:?}");
}

#[test]
fn a_run_repeats_on_one_thread_and_on_two() {
    let hash = |threads| {
        let run = plume()
            .set("run.end_time", "\"60 s\"")
            .threads(threads)
            .run();
        run.unwrap_or_else(|e| panic!("{e}")).trace_hash.clone()
    };
    assert_eq!(hash(1), hash(2));
    let other = plume().set("run.end_time", "\"60 s\"").seed(1).run();
    assert_ne!(hash(1), other.unwrap_or_else(|e| panic!("{e}")).trace_hash);
}
