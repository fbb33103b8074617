//! How a bee flies.

use crate::swarm::{bee, run, run_in, vehicle, with_radio, with_sensor};
use simbeeotic_model::Consumer;
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::units::{Enu, Position, Velocity};
use simbeeotic_model::world::{Calm, Weather};
use std::sync::Arc;

#[test]
fn a_bee_that_is_not_hovering_falls_freely() {
    let mut run = run(vec![bee("bee", "inert-bee", &[], [0.0, 0.0, 100.0])], 2);
    run.run_until(SimTime::from_secs(2)).expect("it runs");
    let z = run.pose("bee").expect("a body").position.up().metres();
    assert!((z - (100.05 - 0.5 * 9.80665 * 4.0)).abs() < 1e-9, "{z}");
}

#[test]
fn a_hovering_bee_keeps_its_place_and_draws_its_hover_current() {
    let mut run = run(vec![bee("bee", "inert-bee", &[("hover", "true")], [1.0, 2.0, 3.0])], 2);
    assert!(run.run().error.is_none());
    let at = run.pose("bee").expect("a body").position.si();
    assert!((at.z - 3.05).abs() < 1e-9, "{at}");
    // The original billed 21 periods of 0.1 s for 2 s: 1050 mA s.
    let drawn = run.accounts("bee").expect("accounts").drawn(Consumer::Hover);
    assert!((drawn.milliampere_seconds() - 1000.0).abs() < 1e-9, "{drawn}");
}

#[test]
fn the_same_seed_gives_the_same_trace_on_any_number_of_threads() {
    let swarm = |threads| {
        let bees = (0..600).map(|i| {
            let at = [f64::from(i % 10) * 3.0, f64::from(i / 10 % 10) * 3.0, f64::from(i / 100) * 3.0 + 2.0];
            let walk = bee(&format!("bee-{i}"), "instrument-bee", &[], at);
            with_radio(with_sensor(walk, "compass", "compass"))
        });
        let mut run = run_in(bees.collect(), 3, Arc::new(Calm), threads);
        let outcome = run.run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        assert!(outcome.summary.packets.received > 100_000, "{:?}", outcome.summary.packets);
        outcome.summary.trace_seconds
    };
    let one = swarm(1);
    assert_eq!(one, swarm(2));
    assert_eq!(one, swarm(3));
}

/// Three metres a second to the east.
#[derive(Debug)]
struct EastWind;

impl Weather for EastWind {
    fn wind(&self, _at: Position, _time: SimTime) -> Velocity<Enu> {
        Velocity::from_xyz(3.0, 0.0, 0.0)
    }
}

#[test]
fn wind_carries_what_cannot_push_back() {
    let gear = [("use_wind", "true"), ("max_acceleration", "0.001 m/s^2")];
    let plan = vehicle("bee", "inert-bee", &[("hover", "true")], &gear, [0.0, 0.0, 50.0]);
    let mut run = run_in(vec![plan], 600, Arc::new(EastWind), 1);
    run.run_until(SimTime::from_secs(600)).expect("it runs");
    let speed = run.twist("bee").expect("a body").linear.east().get();
    assert!((1.0..3.0).contains(&speed), "it drifts with the wind and never faster: {speed} m/s");
}
