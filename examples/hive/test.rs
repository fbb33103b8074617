//! What must hold of a search.

use super::cells::Cells;
use super::landing::Report;
use super::planner::Finding;
use super::wire::Task;
use crate::example;
use simbeeotic::prelude::*;
use simbeeotic::{Experiment, Run};

/// Fifty MAVs for eight minutes, unless more is said.
fn search() -> Experiment {
    example("hive/scenario.toml").set("run.end_time", "8 min")
}

fn run(experiment: &Experiment) -> Run {
    experiment.run().unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn the_hive_finds_the_flowers_serves_them_and_loses_nobody() {
    let run = run(&search());
    assert!(run.total("coverage") > 0.3, "{}", run.total("coverage"));
    assert!(
        run.total("flowers/seen") > 200.0,
        "{}",
        run.total("flowers/seen")
    );
    assert!(
        run.total("flowers/served") > 150.0,
        "{}",
        run.total("flowers/served")
    );
    assert_eq!(run.total("lost"), 0.0);
    // What the hive knows is what was searched, as far as it has been told.
    assert!((run.total("known") - run.total("coverage")).abs() < 0.1);
}

#[test]
fn planning_serves_more_flowers_than_fixed_shares_on_each_seed() {
    let served = |scheme: &str| {
        let runs = search().set("variables.scheme", scheme).seeds(1..4);
        let runs = runs.unwrap_or_else(|e| panic!("{e}"));
        runs.iter()
            .map(|run| run.total("flowers/served"))
            .collect::<Vec<_>>()
    };
    let (central, fixed) = (served("central"), served("static"));
    for (planned, fixed) in central.iter().zip(&fixed) {
        assert!(planned > fixed, "{planned} with a planner, {fixed} without");
    }
}

#[test]
fn without_a_reserve_a_head_wind_costs_mavs_and_with_one_few_or_none() {
    let windy = search()
        .set("run.end_time", "6 min")
        .set("variables.wind", "5 m/s");
    let safe = run(&windy);
    assert!(safe.total("lost") <= 2.0, "{}", safe.total("lost"));
    let bold = run(&windy.set("variables.reserve", 0));
    assert!(bold.total("lost") >= 10.0, "{}", bold.total("lost"));
}

#[test]
fn without_radio_the_planner_sends_each_mav_to_one_cell_a_flight_and_the_field_is_left() {
    let deaf = run(&search().set("channel.medium", "off"));
    let heard = run(&search());
    let per = |run: &Run| run.total("dispatches");
    assert!(
        per(&deaf) < 0.5 * per(&heard),
        "{} {}",
        per(&deaf),
        per(&heard)
    );
    assert!(deaf.total("coverage") < 0.7 * heard.total("coverage"));
    // What is said on the pads still passes.
    assert!(deaf.total("known") > 0.05, "{}", deaf.total("known"));
}

#[test]
fn trails_alone_find_flowers_too_and_need_the_beacons() {
    let emergent = search()
        .set("variables.scheme", "emergent")
        .set("run.end_time", "5 min");
    let guided = run(&emergent);
    assert!(
        guided.total("flowers/served") > 30.0,
        "{}",
        guided.total("flowers/served")
    );
    assert_eq!(guided.total("dispatches"), 0.0);
    let lost = run(&emergent.set("channel.medium", "off"));
    assert_eq!(lost.total("flowers/served"), 0.0);
}

#[test]
fn a_search_repeats_on_any_number_of_threads() {
    let short = search().set("run.end_time", "90 s");
    let trace = |threads: usize| run(&short.clone().threads(threads)).trace_hash.clone();
    assert_eq!(trace(1), trace(2));
    assert_ne!(trace(1), run(&short.clone().seed(2)).trace_hash);
}

/// Says once a second that it has searched cell 3, wherever it is.
#[behavior("test-search-liar")]
struct Liar {
    hive: Option<ModelId>,
    lies: bool,
}

/// Parameters of [`Liar`].
#[params]
#[derive(Default)]
struct LiarParams {
    /// Whether it lies down, motors off.
    lies: bool,
}

impl Behavior for Liar {
    type Params = LiarParams;

    fn build(params: LiarParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.every(Time::si(1.0), Self::boast);
        Ok(Self {
            hive: None,
            lies: params.lies,
        })
    }
}

impl Liar {
    fn boast(&mut self, bee: &mut Bee<'_>) {
        if self.lies {
            bee.hover(false);
            bee.fly(Velocity::ZERO);
        }
        self.hive = self.hive.or_else(|| bee.find("hive"));
        let finding = Finding {
            ticket: 1,
            task: Task::Search,
            cell: 3,
            complete: true,
            count: 0,
            places: Vec::new(),
        };
        if let Some(hive) = self.hive {
            bee.tell(hive, Report(vec![finding]));
        }
    }
}

#[test]
fn the_hive_takes_reports_of_those_alone_who_rest_on_its_pads() {
    let told = |up: f64, east: f64| {
        let text = format!(
            r#"
            [run]
            end_time = "21 s"
            [[model]]
            use = "search-hive"
            name = "hive"
            [[model]]
            use = "test-search-liar"
            start = ["{east} m", "0 m", "{up} m"]
            params = {{ lies = {} }}
            "#,
            up == 0.0
        );
        let run = simbeeotic::run_text(&text).unwrap_or_else(|e| panic!("{e}"));
        (run.total("known") > 0.0, run.total("refused"))
    };
    let (known, refused) = told(0.0, 1.5);
    assert!(known && refused <= 2.0, "{refused}");
    // Over a pad, and lying far from it.
    assert_eq!(told(2.0, 1.5), (false, 20.0));
    assert_eq!(told(0.0, 20.0), (false, 20.0));
}

#[test]
fn more_mavs_than_pads_have_room_for_is_an_error_that_says_what_to_raise() {
    let many = search()
        .set("model.hive.model.mav.count", 295)
        .set("run.end_time", "2 s");
    let error = many.run().map(|_| ()).expect_err("no room").to_string();
    for word in ["hive", "300 MAVs", "raise dock.pad_radius"] {
        assert!(error.contains(word), "{error}");
    }
    run(&many.set("model.hive.params.dock.pad_radius", "7 m"));
}

#[test]
fn searching_beside_finds_first_does_not_cost_flowers() {
    for seed in 1..4 {
        let served = |beside: f64| {
            let key = "model.hive.params.planner.belief_beside";
            run(&search().seed(seed).set(key, beside)).total("flowers/served")
        };
        // 0: it never raises a belief.
        let (with, without) = (
            run(&search().seed(seed)).total("flowers/served"),
            served(0.0),
        );
        assert!(
            with >= 0.97 * without,
            "seed {seed}: {with} with, {without} without"
        );
    }
}

#[test]
fn five_thousand_set_out_in_the_dream() {
    let dream = run(&example("hive/dream.toml").set("run.end_time", "11 s"));
    assert_eq!(dream.models, 25 * 201 + 1);
    assert_eq!(dream.total("dispatches"), 5000.0);
}

#[test]
fn cells_of_the_scenario_have_numbers() {
    let cells = Cells::around(simbeeotic::units::glam::DVec2::ZERO, 300.0, 10.0);
    assert_eq!(cells.len(), 900);
}

/// A ghost that draws what the others draw on the mean.
const GHOST: &str =
    r#"{ use = "ghost", length = "12 cm", max_acceleration = "4 m/s^2", hover_current = "2 A" }"#;

#[test]
fn ghosts_search_with_the_others_land_without_contacts_and_set_out_again() {
    let run = run(&search().set("model.hive.model.heli.vehicle", GHOST));
    for heli in 0..5 {
        let trips = run.metric_of(&format!("hive/heli-{heli}"), "trips");
        assert!(
            trips.is_some_and(|trips| trips.last >= 1.0),
            "heli-{heli}: {trips:?}"
        );
    }
    assert_eq!(run.total("lost"), 0.0);
}
