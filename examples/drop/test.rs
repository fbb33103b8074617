//! Impacts against the closed formulas of `mod.rs`.

use crate::example;
use simbeeotic::units::{Density, math};
use simbeeotic::{Experiment, Run};
use std::f64::consts::PI;

const G: f64 = 9.80665;
const HEIGHT_M: f64 = 20.0;

fn scenario() -> Experiment {
    example("drop/scenario.toml")
}

/// What one bee has published last; NaN if nothing.
fn told(run: &Run, bee: &str, metric: &str) -> f64 {
    run.metric_of(bee, metric)
        .map_or(f64::NAN, |tally| tally.last)
}

fn near(value: f64, wanted: f64, relative: f64) -> bool {
    (value / wanted - 1.0).abs() < relative
}

#[test]
fn without_drag_time_speed_and_bounce_are_those_of_the_textbook_whatever_it_weighs() {
    let run = scenario().run().expect("it runs");
    let (time, speed) = ((2.0 * HEIGHT_M / G).sqrt(), (2.0 * G * HEIGHT_M).sqrt());
    for (bee, kept) in [
        ("dead", 0.0),
        ("lively", 0.5),
        ("elastic", 1.0),
        ("heavy", 1.0),
    ] {
        // To the nanosecond of the clock: no step of anything lies between a fall and its end.
        let error = (told(&run, bee, "impact-time") - time).abs();
        assert!(error < 2e-9, "{bee}: {error} s off");
        assert!(near(told(&run, bee, "impact-speed"), speed, 1e-8), "{bee}");
        if kept > 0.0 {
            let height = told(&run, bee, "bounce-height");
            assert!(near(height, kept * HEIGHT_M, 1e-6), "{bee}: {height} m");
        }
    }
    // The control: the dead one does not bounce, and lies on the ground, not in it.
    assert_eq!(told(&run, "dead", "impacts"), 1.0);
    let lies = run.pose("dead").expect("a body").position.si().z;
    assert!((lies - 0.05).abs() < 1e-6, "its middle is at {lies} m");
}

#[test]
fn with_drag_it_comes_down_at_the_speed_of_the_closed_formula() {
    let still = scenario().run().expect("it runs");
    let free = scenario()
        .set("model.golf.vehicle.use_wind", false)
        .set("model.ping-pong.vehicle.use_wind", false)
        .run()
        .expect("it runs");
    let rho = Density::si(1.224).get(); // ISO 2533, 10 m above the sea
    for (bee, mass, diameter, drag) in [
        ("golf", 0.0459, 0.0427, 0.25),
        ("ping-pong", 0.0027, 0.04, 0.47),
    ] {
        let area = 0.25 * PI * diameter * diameter;
        let terminal = (2.0 * mass * G / (rho * drag * area)).sqrt();
        let fallen = 2.0 * G * HEIGHT_M / (terminal * terminal);
        let speed = terminal * (1.0 - math::exp(-fallen)).sqrt();
        let hit = told(&still, bee, "impact-speed");
        assert!(near(hit, speed, 3e-3), "{bee}: {hit}, {speed} m/s");
        // The control: without drag it is another number.
        assert!(
            !near(told(&free, bee, "impact-speed"), speed, 3e-2),
            "{bee}"
        );
    }
}

#[test]
fn from_higher_up_a_light_one_hits_no_harder() {
    let hit = |height: &str, bee: &str| {
        let start = format!("model.{bee}.start");
        let place = format!(r#"["0 m", "0 m", "{height}"]"#);
        let run = scenario()
            .set("run.end_time", "15 s")
            .set(&start, place)
            .run();
        told(&run.expect("it runs"), bee, "impact-speed")
    };
    let (low, high) = (hit("40 m", "ping-pong"), hit("80 m", "ping-pong"));
    assert!(near(high, low, 0.01), "{low}, {high} m/s: terminal speed");
    assert!(near(
        hit("80 m", "elastic"),
        2.0_f64.sqrt() * hit("40 m", "elastic"),
        1e-6
    ));
}

/// A roof at the angle `a` throws what falls on it off at `2 a` from the vertical, if it is smooth and elastic.
#[test]
fn off_a_roof_it_leaves_at_the_mirrored_angle() {
    let leaves = |degrees: f64, friction: f64| {
        let mut run = scenario()
            .set("world.obstacle.0.attitude.pitch", format!("{degrees} deg"))
            .set("world.obstacle.0.friction", friction)
            .set("model.roof-bee.vehicle.friction", friction)
            .simulation()
            .expect("it is right");
        let before = run.pose("roof-bee").expect("a body").position.si().z;
        let mut last = before;
        // Until it has bounced, millisecond by millisecond.
        for step in 2000..2100 {
            run.run_until(simbeeotic::kernel::SimTime::from_millis(step))
                .expect("it runs");
            let now = run.pose("roof-bee").expect("a body").position.si().z;
            let v = run.twist("roof-bee").expect("a body").linear.si();
            if v.x.abs() > 0.1 || now > last {
                return (math::atan2(v.x, v.z).to_degrees(), v.length());
            }
            last = now;
        }
        panic!("it has not bounced off the roof")
    };
    for degrees in [10.0, 20.0, 30.0] {
        let (angle, speed) = leaves(degrees, 0.0);
        assert!(
            (angle - 2.0 * degrees).abs() < 0.1,
            "{angle} degrees off {degrees}"
        );
        assert!((19.6..19.9).contains(&speed), "{speed} m/s");
    }
    // The control: a rough roof takes some of the speed along it.
    let (angle, _) = leaves(20.0, 0.5);
    assert!((angle - 40.0).abs() > 2.0, "{angle} degrees");
}

#[test]
fn a_run_repeats_on_any_number_of_threads() {
    let hash = |threads| {
        scenario()
            .threads(threads)
            .run()
            .expect("it runs")
            .trace_hash
            .clone()
    };
    assert_eq!(hash(1), hash(2));
}
