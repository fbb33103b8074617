//! What must hold of the flock, and what must not without its radio.

use simbeeotic::{Experiment, Run};

/// Ninety seconds of it: half of them to form.
fn flock() -> Experiment {
    crate::example("flocking/scenario.toml")
        .set("run.end_time", "90 s")
        .set("model.referee.params.settled", "45 s")
}

fn three(experiment: Experiment) -> Vec<Run> {
    experiment.seeds(1..4).unwrap_or_else(|e| panic!("{e}"))
}

fn orders(runs: &[Run]) -> Vec<f64> {
    runs.iter().map(|run| run.total("mean_order")).collect()
}

#[test]
fn it_flies_as_one_and_nobody_touches_anybody() {
    let runs = three(flock());
    let orders = orders(&runs);
    assert!(orders.iter().all(|order| *order > 0.9), "{orders:?}");
    for run in &runs {
        assert_eq!(run.touches, 0);
        assert!(run.total("least_distance") > 1.0);
        // Losses are real.
        assert!(run.packets.sent > 20_000);
        assert!((run.packets.received as f64) < 0.8 * 63.0 * run.packets.sent as f64);
    }
}

#[test]
fn without_a_radio_each_flies_alone_and_they_touch() {
    let runs = three(flock().set("channel.medium", "off"));
    let orders = orders(&runs);
    assert!(orders.iter().all(|order| *order < 0.4), "{orders:?}");
    assert!(runs.iter().all(|run| run.touches > 0));
}

#[test]
fn packets_that_are_too_rare_lose_the_order_and_the_distance() {
    let runs = three(flock().set("model.bee.params.period", "12 s"));
    let orders = orders(&runs);
    assert!(orders.iter().all(|order| *order < 0.8), "{orders:?}");
    assert!(runs.iter().all(|run| run.touches > 0));
}

#[test]
fn it_repeats_on_any_number_of_threads() {
    let brief = flock().set("run.end_time", "10 s");
    let hash = |threads| {
        let run = brief.clone().threads(threads).run();
        run.unwrap_or_else(|e| panic!("{e}")).trace_hash.clone()
    };
    assert_eq!(hash(1), hash(2));
    let other = brief
        .clone()
        .seed(2)
        .run()
        .unwrap_or_else(|e| panic!("{e}"));
    assert_ne!(hash(1), other.trace_hash);
}
