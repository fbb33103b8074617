//! Whether bees travel, by both paths, near them; and when they do not.

use crate::example;
use simbeeotic::{Experiment, Run};

fn gradient() -> Experiment {
    example("gradient/scenario.toml").set("run.end_time", "6 min")
}

fn three(experiment: &Experiment) -> Vec<Run> {
    experiment.seeds(1..4).expect("they run")
}

fn mean(runs: &[Run], metric: &str) -> f64 {
    runs.iter().map(|run| run.total(metric)).sum::<f64>() / runs.len() as f64
}

#[test]
fn bees_travel_by_both_paths_and_stay_near_them() {
    let led = three(&gradient());
    let trips: Vec<f64> = led.iter().map(|run| run.total("trips")).collect();
    assert!(trips.iter().all(|trips| *trips >= 2.0), "{trips:?}");
    assert!(mean(&led, "trips") >= 3.0, "{trips:?}");
    let least = mean(&led, "trips/least");
    assert!(least >= 1.0, "{least}");
    let off_m = mean(&led, "deviation");
    assert!(off_m < 7.5, "{off_m}");
    let lost = mean(&led, "lost");
    assert!(lost < 0.08, "{lost}");
    // What they take for a trip mostly is one.
    let claimed = mean(&led, "claimed");
    assert!(mean(&led, "trips") > 0.6 * claimed, "{claimed}, {trips:?}");
}

#[test]
fn without_bias_they_scatter_and_make_no_trips() {
    let blind = three(&gradient().set("model.bee.params.walk.bias", 0));
    assert!(mean(&blind, "trips") < 0.5);
    let off_m = mean(&blind, "deviation");
    assert!(off_m > 10.0, "{off_m}");
}

#[test]
fn without_signal_strength_they_make_fewer_trips_and_fly_farther_off() {
    let led = three(&gradient());
    let alike = three(&gradient().set("model.bee.params.sharpness", 0));
    let trips = [mean(&led, "trips"), mean(&alike, "trips")];
    assert!(trips[0] > 1.5 * trips[1], "{trips:?}");
    let off_m = [mean(&led, "deviation"), mean(&alike, "deviation")];
    assert!(off_m[1] > 1.25 * off_m[0], "{off_m:?}");
}

#[test]
fn beacons_that_are_too_far_apart_or_signals_too_uncertain_guide_nobody() {
    for (key, value) in [("variables.spacing", "40 m"), ("variables.noise", "12 dB")] {
        let trips = mean(&three(&gradient().set(key, value)), "trips");
        assert!(trips < 1.0, "{key} {value}: {trips}");
    }
}

#[test]
fn numbers_out_of_range_are_refused_by_name() {
    for (key, value, word) in [
        ("model.bee.params.height", "-5 m", "`height`"),
        ("model.beacon.params.period", "1 ns", "`period`"),
        (
            "variables.path_2",
            "1 m, 0 m; 50 m, 0 m",
            "different places",
        ),
        ("world.generate.scatter", "1e9 m", "`scatter`"),
    ] {
        let error = gradient().set(key, value).run().err();
        let error = error.map(|error| error.to_string()).unwrap_or_default();
        assert!(error.contains(word), "{key}: {error}");
    }
}

#[test]
fn a_run_repeats_on_any_number_of_threads() {
    let short = gradient().set("run.end_time", "20 s");
    let hash = |seed, threads| {
        let run = short.clone().seed(seed).threads(threads).run();
        run.expect("it runs").trace_hash.clone()
    };
    assert_eq!(hash(1, 1), hash(1, 2));
    assert_ne!(hash(1, 1), hash(2, 1));
}
