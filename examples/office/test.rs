//! The outcome: rooms are visited, people found, bees come home; and what of the swarm does it.

use simbeeotic::{Experiment, Run};
use std::sync::LazyLock;

fn office() -> Experiment {
    crate::example("office/scenario.toml")
}

/// What came of a run.
#[derive(Clone, Copy, Debug)]
struct Came {
    rooms: f64,
    found: f64,
    returned: f64,
}

fn came(run: &Run) -> Came {
    Came {
        rooms: run.total("rooms"),
        found: run.total("found"),
        returned: run.total("returned"),
    }
}

fn three(experiment: &Experiment) -> Vec<Came> {
    let runs = experiment.seeds(1..4).unwrap_or_else(|e| panic!("{e}"));
    runs.iter().map(came).collect()
}

/// The example as it stands.
static AS_IT_STANDS: LazyLock<Vec<Came>> = LazyLock::new(|| three(&office()));

/// Until they would turn home.
fn outbound() -> Experiment {
    office().set("run.end_time", "\"300 s\"")
}

#[test]
fn the_swarm_visits_three_quarters_of_the_rooms_and_finds_the_people() {
    for run in &*AS_IT_STANDS {
        assert!((18.0..=24.0).contains(&run.rooms), "{run:?}");
        assert!((6.0..=9.0).contains(&run.found), "{run:?}");
    }
}

#[test]
fn about_half_come_home_by_the_beacon_and_no_one_by_a_beacon_that_nobody_hears() {
    let home: Vec<f64> = AS_IT_STANDS.iter().map(|run| run.returned).collect();
    assert!(home.iter().sum::<f64>() >= 15.0, "{home:?}");
    let early = office()
        .set("model.bee.params.turn_home", "\"60 s\"")
        .set("run.end_time", "\"150 s\"");
    let heard = came(&early.run().unwrap_or_else(|e| panic!("{e}")));
    let deaf = early.set("channel.range_limit", "\"1 m\"").run();
    let deaf = deaf.unwrap_or_else(|e| panic!("{e}"));
    let deaf = came(&deaf);
    assert!(deaf.returned == 0.0 && deaf.found == 0.0, "{deaf:?}");
    assert!(heard.returned > 0.0 && heard.found > 0.0, "{heard:?}");
}

#[test]
fn one_alone_visits_few_rooms() {
    for run in three(&outbound().set("model.bee.count", 1)) {
        assert!(run.rooms <= 6.0, "{run:?}");
    }
}

#[test]
fn a_swarm_that_prefers_one_direction_visits_half_as_many_rooms() {
    let same = three(&outbound().set("model.bee.params.fan", "\"0 deg\""));
    for (same, fan) in same.iter().zip(&*AS_IT_STANDS) {
        assert!(
            same.rooms <= 12.0 && same.rooms < 0.6 * fan.rooms,
            "{same:?}, {fan:?}"
        );
    }
}

#[test]
fn a_run_repeats_on_one_thread_and_on_two() {
    let hash = |threads, seed| {
        let short = office().set("run.end_time", "\"60 s\"").seed(seed);
        let run = short.threads(threads).run();
        run.unwrap_or_else(|e| panic!("{e}")).trace_hash.clone()
    };
    assert_eq!(hash(1, 1), hash(2, 1));
    assert_ne!(hash(1, 1), hash(1, 2));
}
