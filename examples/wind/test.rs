//! Drift, error and learning against the closed formulas of `mod.rs`.

use crate::example;
use simbeeotic::kernel::SimTime;
use simbeeotic::model::Simulation;
use simbeeotic::units::glam::DVec3;
use simbeeotic::{Experiment, Run};
use std::f64::consts::PI;

const WIND_M_S: f64 = 3.0;

/// Up to the gust: a constant wind.
fn steady() -> Experiment {
    example("wind/scenario.toml").set("run.end_time", "39 s")
}

/// `k` of equation 1 for the vehicle as it comes, at 10 m in the standard atmosphere, 1/m.
fn k_per_m() -> f64 {
    0.5 * 1.2238 * 0.47 * PI * 0.01 / 0.05
}

/// How far from its start a bee is, east, north and up.
fn carried(run: &Run, bee: &str) -> DVec3 {
    let north = match bee {
        "drifter" => -6.0,
        "p-bee" => -2.0,
        "pi-bee" => 2.0,
        _ => 6.0,
    };
    run.pose(bee).expect("a body").position.si() - DVec3::new(0.0, north, 10.1)
}

fn velocity(run: &Simulation, bee: &str) -> DVec3 {
    run.twist(bee).expect("a body").linear.si()
}

#[test]
fn who_does_nothing_takes_up_the_wind_with_the_time_constant_of_its_drag() {
    let mut run = steady().simulation().expect("it is right");
    let time_constant = 1.0 / (k_per_m() * WIND_M_S);
    for second in [1_u32, 2, 5, 10, 30] {
        run.run_until(SimTime::from_secs(second.into()))
            .expect("it runs");
        let wanted = WIND_M_S * (1.0 - 1.0 / (1.0 + f64::from(second) / time_constant));
        let v = velocity(&run, "drifter");
        assert!(
            (v.x - wanted).abs() < 0.005,
            "{second} s: {v}, {wanted} m/s"
        );
        assert!(v.y.abs() < 1e-9 && v.z.abs() < 1e-9, "{v}");
    }
}

#[test]
fn without_the_integral_an_error_stays_and_with_it_none_does() {
    for run in steady().seeds(1..6).expect("they run") {
        // Equation 3 at rest: w T_p = 6 m, and the first reading of home is off by centimetres.
        let hangs = carried(&run, "p-bee");
        assert!((hangs.x - 6.0).abs() < 0.3, "{hangs}");
        let stays = carried(&run, "pi-bee");
        assert!(stays.length() < 0.3, "{stays}");
        let estimate = run.metric("wind").expect("two learn").max;
        assert!((estimate - WIND_M_S).abs() < 0.1, "{estimate} m/s");
    }
    // The error is not one that more time would take away.
    let later = steady()
        .set("weather.gust", "[]")
        .set("run.end_time", "5 min")
        .run();
    let hangs = carried(&later.expect("it runs"), "p-bee");
    assert!((hangs.x - 6.0).abs() < 0.3, "{hangs}");
}

#[test]
fn twice_the_gain_halves_the_error_that_stays() {
    let run = steady()
        .set("model.p-bee.params.response_time", "1 s")
        .run();
    let hangs = carried(&run.expect("it runs"), "p-bee");
    assert!((hangs.x - 3.0).abs() < 0.2, "{hangs}");
}

#[test]
fn in_a_gust_it_gives_way_by_metres_and_comes_back() {
    let whole = example("wind/scenario.toml");
    let mut run = whole.simulation().expect("it is right");
    let mut farthest = 0.0_f64;
    for second in 30..=90 {
        run.run_until(SimTime::from_secs(second)).expect("it runs");
        let away = run.pose("pi-bee").expect("a body").position.si().x;
        farthest = farthest.max(away.abs());
        if second == 60 || second == 90 {
            assert!(away.abs() < 0.4, "{away} m off at {second} s");
        }
    }
    assert!((2.0..6.0).contains(&farthest), "{farthest} m");
}

#[test]
fn a_bee_that_is_slower_than_the_wind_is_carried_off_by_the_difference() {
    let run = steady().run().expect("it runs");
    let v = velocity(run.simulation(), "weak-bee");
    assert!((v.x - (WIND_M_S - 2.5)).abs() < 0.02, "{v}");
}

/// Routh: the three roots of the linear law are stable while `T_i > 1 / (2 k w)`, here 0.92 s.
#[test]
fn a_reset_time_below_the_time_of_the_drag_makes_it_swing() {
    let swing = |reset: &str| {
        let run = steady().set("model.pi-bee.params.reset_time", reset).run();
        let run = run.expect("it runs");
        let v = velocity(run.simulation(), "pi-bee");
        (carried(&run, "pi-bee").length(), v.length())
    };
    let (away, speed) = swing("4 s");
    assert!(away < 0.3 && speed < 0.2, "{away} m, {speed} m/s");
    let (away, speed) = swing("0.5 s");
    assert!(away > 1.0 || speed > 1.0, "{away} m, {speed} m/s");
}

#[test]
fn in_turbulence_it_stays_within_a_few_metres_while_the_drifter_is_gone() {
    let turbulence = r#"{ scale = { low_altitude = { wind_at_20ft = "6 m/s" } } }"#;
    let rough = example("wind/scenario.toml").set("weather.turbulence", turbulence);
    for run in rough.seeds(1..11).expect("they run") {
        let (stays, drifts) = (carried(&run, "pi-bee"), carried(&run, "drifter"));
        assert!(stays.length() < 8.0, "seed {}: {stays}", run.seed);
        assert!(drifts.length() > 150.0, "seed {}: {drifts}", run.seed);
    }
}

#[test]
fn a_run_repeats_on_any_number_of_threads() {
    let hash = |threads| {
        steady()
            .threads(threads)
            .run()
            .expect("it runs")
            .trace_hash
            .clone()
    };
    assert_eq!(hash(1), hash(2));
}
