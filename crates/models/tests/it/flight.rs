//! How a bee flies.

use crate::swarm::{bee, run, run_in, vehicle, with_radio, with_sensor};
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::units::{Angle, Enu, Heading, Position, Time, Velocity};
use simbeeotic_model::world::{Calm, Weather};
use simbeeotic_model::{
    Bee, Behavior, BuildError, Consumer, Handle, Kit, Thing, Touch, behavior, params,
};
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
    let mut run = run(
        vec![bee(
            "bee",
            "inert-bee",
            &[("hover", "true")],
            [1.0, 2.0, 3.0],
        )],
        2,
    );
    assert!(run.run().error.is_none());
    let at = run.pose("bee").expect("a body").position.si();
    assert!((at.z - 3.05).abs() < 1e-9, "{at}");
    // The original billed 21 periods of 0.1 s for 2 s: 1050 mA s.
    let drawn = run
        .accounts("bee")
        .expect("accounts")
        .drawn(Consumer::Hover);
    assert!(
        (drawn.milliampere_seconds() - 1000.0).abs() < 1e-9,
        "{drawn}"
    );
}

#[test]
fn the_same_seed_gives_the_same_trace_on_any_number_of_threads() {
    let swarm = |threads| {
        let bees = (0..600).map(|i| {
            let at = [
                f64::from(i % 10) * 3.0,
                f64::from(i / 10 % 10) * 3.0,
                f64::from(i / 100) * 3.0 + 2.0,
            ];
            let walk = bee(&format!("bee-{i}"), "instrument-bee", &[], at);
            with_radio(with_sensor(walk, "compass", "compass"))
        });
        let mut run = run_in(bees.collect(), 3, Arc::new(Calm), threads);
        let outcome = run.run();
        assert!(outcome.error.is_none(), "{:?}", outcome.error);
        assert!(
            outcome.summary.packets.received > 100_000,
            "{:?}",
            outcome.summary.packets
        );
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
    let plan = vehicle(
        "bee",
        "inert-bee",
        &[("hover", "true")],
        &gear,
        [0.0, 0.0, 50.0],
    );
    let mut run = run_in(vec![plan], 600, Arc::new(EastWind), 1);
    run.run_until(SimTime::from_secs(600)).expect("it runs");
    let speed = run
        .twist("bee")
        .expect("a body")
        .linear
        .east()
        .metres_per_second();
    assert!(
        (1.0..3.0).contains(&speed),
        "it drifts with the wind and never faster: {speed} m/s"
    );
}

/// Flies due forward at 1 m/s from the start and publishes nothing.
#[behavior("test-forward")]
struct Forward;

/// None.
#[params]
#[derive(Default)]
struct NoParams {}

impl Behavior for Forward {
    type Params = NoParams;

    fn build(_params: NoParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        Ok(Self)
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        bee.fly(Velocity::from_xyz(1.0, 0.0, 0.0));
    }
}

#[test]
fn the_velocity_answers_a_step_by_one_minus_nine_tenths_to_the_n() {
    let mut run = run(vec![bee("bee", "test-forward", &[], [0.0, 0.0, 10.0])], 10);
    let mut missing = 1.0;
    for n in 1..=50_u64 {
        missing *= 0.9;
        // Just before step n: n steps have acted for 0.1 s each.
        run.run_until(SimTime::from_millis(100 * n - 1))
            .expect("it runs");
        let before = run
            .twist("bee")
            .expect("a body")
            .linear
            .east()
            .metres_per_second();
        run.run_until(SimTime::from_millis(100 * n))
            .expect("it runs");
        let speed = run
            .twist("bee")
            .expect("a body")
            .linear
            .east()
            .metres_per_second();
        assert!((speed - (1.0 - missing)).abs() < 1e-12, "step {n}: {speed}");
        assert!(before < speed);
    }
}

/// What a bee found out about turns and sensors.
#[behavior("test-turner")]
struct Turner {
    compass: Handle<Heading>,
}

impl Behavior for Turner {
    type Params = NoParams;

    fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.once(Time::from_secs(1.0), Self::turn);
        Ok(Self {
            compass: kit.sensor("compass")?,
        })
    }
}

impl Turner {
    fn turn(&mut self, bee: &mut Bee<'_>) {
        let off = |a: Heading, degrees: f64| {
            (a - Heading::new(Angle::from_degrees(degrees)))
                .degrees()
                .abs()
        };
        // Every bee starts with its nose to the east.
        assert!(
            off(bee.read(self.compass), 90.0) < 0.1,
            "east is 90 degrees from north"
        );
        bee.turn(Angle::from_degrees(90.0));
        let now = bee.read(self.compass);
        assert!(
            off(now, 0.0) < 0.1,
            "a left turn from east ends north, in the same call: {now}"
        );
        bee.turn_toward(bee.position() + Position::from_xyz(0.0, -5.0, 5.0));
        assert!(off(bee.read(self.compass), 180.0) < 0.1);
        assert!(
            (bee.attitude().pitch().degrees() + 45.0).abs() < 1e-9,
            "nose up is a negative pitch"
        );
    }
}

#[test]
fn turns_take_effect_at_once_and_show_in_the_compass() {
    let plan = with_sensor(
        bee("bee", "test-turner", &[], [0.0, 0.0, 10.0]),
        "compass",
        "compass",
    );
    let outcome = run(vec![plan], 2).run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
}

/// Told of its touches.
#[behavior("test-faller")]
struct Faller {
    touches: u32,
}

impl Behavior for Faller {
    type Params = NoParams;

    fn build(_params: NoParams, _kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        Ok(Self { touches: 0 })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        bee.hover(false);
    }

    fn on_contact(&mut self, touch: &Touch, bee: &mut Bee<'_>) {
        self.touches += 1;
        if self.touches == 1 {
            // Falls 4 m less nothing: the body's lowest point starts 4 m up.
            let expected = (2.0 * 4.0 / 9.80665_f64).sqrt();
            let late = touch.time.as_secs_f64() - expected;
            assert!(
                late.abs() < 1e-6,
                "the original was up to 0.1 s late; this is {late} s"
            );
            assert_eq!(bee.now(), touch.time);
            assert_eq!(touch.other, Thing::Ground);
            assert!(touch.normal[2] < -0.999, "the ground is below");
            assert!(
                bee.position().up().metres() > 0.05 - 1e-6,
                "and it is not inside the ground"
            );
        }
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        assert!(self.touches >= 1);
        assert!(
            (bee.position().up().metres() - 0.05).abs() < 1e-6,
            "it lies on the ground"
        );
    }
}

#[test]
fn a_fall_ends_at_the_computed_time_of_impact() {
    let outcome = run(vec![bee("bee", "test-faller", &[], [0.0, 0.0, 4.0])], 5).run();
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert!(outcome.summary.touches >= 1);
}

#[test]
fn what_a_model_gets_wrong_ends_the_run_with_its_name() {
    #[behavior("test-nan")]
    struct Nan;

    impl Behavior for Nan {
        type Params = NoParams;

        fn build(_params: NoParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
            kit.once(Time::from_secs(1.0), |_, bee| {
                bee.set_force(simbeeotic_model::units::ForceVec::from_xyz(
                    f64::NAN,
                    0.0,
                    0.0,
                ));
            });
            Ok(Self)
        }
    }

    let outcome = run(vec![bee("bad", "test-nan", &[], [0.0, 0.0, 4.0])], 5).run();
    let error = outcome
        .error
        .expect("a force that is no number ends the run")
        .to_string();
    assert!(
        error.contains("bad") && error.contains("not finite"),
        "{error}"
    );
}
