//! What must hold of a flight through the corridor.

use crate::example;
use simbeeotic::Experiment;

const BEES: f64 = 6.0;
/// The narrow part is 1.2 m wide, the wide one 2.5 m.
const WIDTHS: f64 = 1.2 / 2.5;

fn corridor() -> Experiment {
    example("corridor/scenario.toml")
}

#[test]
fn all_get_through_in_the_middle_and_hardly_touch_anything() {
    let runs = corridor().seeds(1..5).expect("it runs");
    let mut touches = 0.0;
    for run in &runs {
        assert_eq!(run.total("through"), BEES);
        assert_eq!(run.total("out"), BEES, "each has noticed that it is out");
        assert!(run.total("deviation") < 0.1, "{}", run.total("deviation"));
        touches += run.total("touches");
    }
    // In 24 flights of 80 m past four pillars.
    assert!(touches <= 4.0, "{touches}");
}

#[test]
fn speed_is_in_proportion_to_the_width_as_with_honeybees() {
    let ratio = |gain: f64| {
        let short = corridor().set("run.end_time", "45 s");
        let run = short.set("model.bee.params.speed_gain", gain).run();
        let run = run.expect("it runs");
        run.total("speed-narrow") / run.total("speed-wide")
    };
    assert!((ratio(1.5) - WIDTHS).abs() < 0.07, "{}", ratio(1.5));
    // Control: who does not regulate the flow flies as fast everywhere.
    assert!((ratio(0.0) - 1.0).abs() < 0.1, "{}", ratio(0.0));
}

#[test]
fn without_the_centring_response_nobody_keeps_to_the_middle() {
    for run in corridor()
        .set("model.bee.params.balance", 0)
        .seeds(1..3)
        .expect("it runs")
    {
        assert!(run.total("deviation") > 0.2, "{}", run.total("deviation"));
    }
}

#[test]
fn whoever_makes_nothing_of_the_flow_hits_the_walls_and_does_not_get_through() {
    let blind = corridor()
        .set("model.bee.params.balance", 0)
        .set("model.bee.params.align", 0)
        .set("model.bee.params.saccade", "0 deg");
    for run in blind.seeds(1..3).expect("it runs") {
        assert_eq!(run.total("through"), 0.0);
        assert!(run.touches > 0);
    }
}

/// The original kept its state where all bees shared it, so that only one could fly.
#[test]
fn a_bee_flies_the_same_to_the_last_bit_whoever_else_flies() {
    let six = corridor().set("run.end_time", "40 s");
    let starts = r#"{ list = [["-3 m", "0.5 m", "1.5 m"], ["-1.5 m", "-0.5 m", "1.6 m"]] }"#;
    let two = six
        .clone()
        .set("model.bee.count", 2)
        .set("model.bee.start", starts);
    let [six, two] = [six, two].map(|run| run.run().expect("it runs"));
    for bee in ["bee-0", "bee-1"] {
        assert!(
            two.pose(bee)
                .is_some_and(|pose| six.pose(bee) == Some(pose))
        );
    }
    assert!(two.pose("bee-0") != two.pose("bee-1"));
}

#[test]
fn a_flight_repeats_on_any_number_of_threads() {
    let hash = |threads| {
        let run = corridor()
            .set("run.end_time", "30 s")
            .threads(threads)
            .run();
        run.expect("it runs").trace_hash.clone()
    };
    assert_eq!(hash(1), hash(2));
}
