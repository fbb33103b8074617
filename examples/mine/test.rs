//! What must hold of a search of the mine.

use super::odometry::Plan;
use crate::example;
use simbeeotic::Experiment;
use simbeeotic::kernel::SimTime;
use simbeeotic::units::{Length, Position};
use simbeeotic::world::generate::{MineParams, Search, mine};

const BEES: f64 = 8.0;

fn search() -> Experiment {
    example("mine/scenario.toml").set("run.end_time", "170 s")
}

#[test]
fn in_mine_after_mine_the_base_learns_of_nearly_everybody_and_nearly_all_come_home() {
    for seed in 3..7 {
        let run = search().set("world.generate.seed", seed).seed(seed).run();
        let run = run.expect("it runs");
        assert!(run.total("people") >= 4.0);
        assert!(
            run.total("people-found") >= run.total("people") - 1.0,
            "mine {seed}"
        );
        assert!(run.total("people-wrong") <= 1.0, "mine {seed}");
        assert!(run.total("back") >= BEES - 1.0, "mine {seed}");
        assert!(run.total("bumps") <= 10.0, "mine {seed}");
    }
}

#[test]
fn eyes_that_notice_nobody_find_nobody() {
    let blind = search().set("model.bee.sensor.eyes.detection", 0);
    for run in blind.seeds(1..3).expect("it runs") {
        assert_eq!(run.total("people-found"), 0.0);
        assert!(run.total("cells-explored") > 90.0);
    }
}

#[test]
fn who_exchanges_charts_finds_the_last_one_sooner_with_half_of_the_flying() {
    let sums = |share: bool| {
        let runs = search()
            .set("run.end_time", "240 s")
            .set("model.bee.params.share", share);
        let runs = runs.seeds(1..4).expect("it runs");
        let sum = |name: &str| runs.iter().map(|run| run.total(name)).sum::<f64>();
        (sum("moves"), sum("time-last"))
    };
    let ((moves, last), (moves_alone, last_alone)) = (sums(true), sums(false));
    assert!(moves < 0.5 * moves_alone, "{moves} of {moves_alone}");
    assert!(last < 0.8 * last_alone, "{last} s of {last_alone} s");
}

#[test]
fn without_radio_the_base_learns_nothing() {
    let run = search()
        .set("channel.medium", "off")
        .run()
        .expect("it runs");
    assert_eq!(run.total("cells-explored") + run.total("people-found"), 0.0);
    assert!(
        run.total("cells") > 100.0,
        "they have searched all the same"
    );
}

#[test]
fn a_low_battery_brings_them_home_before_all_is_seen() {
    let run = search()
        .set("model.bee.battery.charge", 0.3)
        .run()
        .expect("it runs");
    assert_eq!(run.total("back"), BEES);
    assert!(
        run.total("cells-explored") < 95.0,
        "{}",
        run.total("cells-explored")
    );
    assert!(run.total("people-found") > 0.0);
}

#[test]
fn by_dead_reckoning_alone_they_get_lost() {
    let sums = |trust: f64| {
        let runs = search()
            .set("model.bee.params.wall_trust", trust)
            .seeds(1..5);
        let runs = runs.expect("it runs");
        let sum = |name: &str| runs.iter().map(|run| run.total(name)).sum::<f64>();
        (sum("back"), sum("bumps"))
    };
    let ((back, bumps), (back_lost, bumps_lost)) = (sums(0.3), sums(0.0));
    assert!(back_lost < back, "{back_lost} instead of {back}");
    assert!(
        bumps < 20.0 && bumps_lost > 100.0,
        "{bumps_lost} instead of {bumps}"
    );
}

/// Twice a second everybody is in a cell that can be reached from the shaft.
#[test]
fn nobody_flies_through_rock() {
    let params = MineParams {
        seed: 3,
        levels: 2,
        columns: 15,
        rows: 11,
        shaft: Length::si(2.5),
        branches: 0.25,
        openings: 0.6,
        people: 0.1,
        frames: 0.0,
        ..MineParams::default()
    };
    let corner = [1.0, -1.0].map(|sign| Position::from_xyz(-22.5 * sign, -16.5 * sign, 0.0));
    let open = Search {
        vehicle_radius: Length::si(0.3),
        cell: Length::si(0.3),
        within: Some([corner[0], corner[1] + Position::from_xyz(0.0, 0.0, 7.5)]),
        seed: 0,
    };
    let world = mine(&params).expect("it can be");
    let reach = open
        .run(&world, Position::from_xyz(0.0, 0.0, 1.4))
        .expect("it is open there");
    let plan = Plan {
        pitch_m: 3.0,
        half_m: 1.25,
        storey_m: 5.0,
        height_m: 1.4,
        trust: 0.0,
    };
    let rock = Position::from_si(plan.middle([0, 6, 4]));
    assert!(!reach.contains(rock), "there is rock");

    let mut run = search().simulation().expect("it is a good scenario");
    for half_second in 0..300 {
        run.run_until(SimTime::from_millis(500 * half_second))
            .expect("it runs");
        for bee in 0..8 {
            let pose = run.pose(&format!("bee-{bee}")).expect("there are eight");
            let at = pose.position.si();
            // In the shaft one is between the storeys, too.
            let [_, x, y] = plan.cell(at);
            let storey = if at.z < 4.0 { 0 } else { 1 };
            let middle = Position::from_si(plan.middle([storey, x, y]));
            assert!(
                reach.contains(middle),
                "bee-{bee} at {at} after {half_second} half seconds"
            );
        }
    }
}

#[test]
fn a_search_repeats_on_any_number_of_threads() {
    let hash = |threads| {
        let run = search().set("run.end_time", "40 s").threads(threads).run();
        run.expect("it runs").trace_hash.clone()
    };
    assert_eq!(hash(1), hash(2));
}
