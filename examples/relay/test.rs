//! What must hold of the chain, and what must not of relays that stay where they began.

use simbeeotic::{Experiment, Run};

fn chain(end_time: &str) -> Experiment {
    crate::example("relay/scenario.toml").set("run.end_time", end_time)
}

fn relays(experiment: Experiment, key: &str, value: &str) -> Experiment {
    let of = |model| format!("model.{model}.params.{key}");
    experiment.set(&of("relay"), value).set(&of("weak"), value)
}

fn two(experiment: Experiment) -> Vec<Run> {
    experiment.seeds(1..3).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn reports_come_from_behind_three_corners() {
    for run in two(chain("420 s")) {
        assert!(run.total("reach") > 350.0, "{}", run.total("reach"));
        assert!(run.total("delivered") > 0.9, "{}", run.total("delivered"));
        let share = run.total("received") / run.total("reports");
        assert!(share > 0.9, "{share}");
        let words = run.total("words") / run.total("reports");
        assert!(words > 0.8, "{words}");
    }
}

#[test]
fn relays_that_stay_behind_bring_nothing_from_there() {
    // The explorer flies on whether it is heard or not.
    let far = relays(chain("420 s"), "speed", "0 m/s").set("model.explorer.params.leash", "1 h");
    for run in two(far) {
        assert!(run.total("delivered") < 0.05, "{}", run.total("delivered"));
        assert!(run.total("reach") < 200.0, "{}", run.total("reach"));
    }
}

/// The battery of `weak` is empty after 293 s. Of the reports made from 308 s to 328 s ...
#[test]
fn a_relay_that_falls_silent_is_bridged_by_the_others_within_a_quarter_of_a_minute() {
    for run in two(chain("333 s")) {
        assert_eq!(run.batteries.as_ref().map(|b| b.out_of_power), Some(1));
        assert!(run.total("delivered") > 0.9, "{}", run.total("delivered"));
    }
    for run in two(relays(chain("333 s"), "stays_from", "290 s")) {
        assert!(run.total("delivered") < 0.1, "{}", run.total("delivered"));
    }
}

#[test]
fn it_repeats_on_any_number_of_threads() {
    let hash = |seed, threads| {
        let run = chain("60 s").seed(seed).threads(threads).run();
        run.unwrap_or_else(|e| panic!("{e}")).trace_hash.clone()
    };
    assert_eq!(hash(1, 1), hash(1, 2));
    assert_ne!(hash(1, 1), hash(2, 1));
}
