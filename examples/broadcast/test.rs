//! Who hears whom, against the closed formulas of `mod.rs`.

use crate::example;
use simbeeotic::Experiment;
use simbeeotic::prelude::*;
use simbeeotic::units::math;
use std::f64::consts::PI;

/// Nobody moves.
fn still() -> Experiment {
    example("broadcast/scenario.toml").set("model.bee.params.drift_sigma", "0 m/s")
}

/// Two bees so far apart.
fn pair(distance_m: f64) -> Experiment {
    let start = format!(
        r#"{{ grid = [2, 1, 1], spacing = "{distance_m} m", from = ["0 m", "0 m", "10 m"] }}"#
    );
    still()
        .set("model.bee.count", 2)
        .set("model.bee.start", start)
}

/// Equation 1, dB.
fn path_loss_db(distance_m: f64) -> f64 {
    20.0 * math::log10(4.0 * PI * distance_m * 2.4425e9 / 299_792_458.0)
}

/// Equation 2 with the scenario's numbers.
fn prr(distance_m: f64, power_dbm: f64) -> f64 {
    let above_db = power_dbm - path_loss_db(distance_m) - 7.0 + 85.0;
    0.5 * math::erfc(-above_db / (4.0 * 2.0_f64.sqrt()))
}

/// The share of the frames of two bees that came through, and of how many.
fn delivered(experiment: &Experiment) -> (f64, f64) {
    let runs = experiment.seeds(1..9).expect("they run");
    let sent: u64 = runs.iter().map(|run| run.packets.sent).sum();
    let received: u64 = runs.iter().map(|run| run.packets.received).sum();
    (received as f64 / sent as f64, sent as f64)
}

#[test]
fn the_share_that_comes_through_over_a_distance_is_that_of_the_closed_formula() {
    for distance in [40.0, 60.0, 78.0, 100.0, 130.0] {
        let ((is, frames), wanted) = (delivered(&pair(distance)), prr(distance, 0.0));
        let sigma = (wanted * (1.0 - wanted) / frames).sqrt();
        let text = format!("{distance} m: {is}, {wanted}, of {frames}");
        assert!((is - wanted).abs() < 4.0 * sigma, "{text}");
        // The control: with the original's wavelength, ten times too short, hardly any would.
        let (lost, _) = delivered(&pair(distance).set("model.bee.radio.tx_power", "-20 dBm"));
        assert!(
            wanted > 0.1 && lost < 0.003,
            "{text}, {lost} with 20 dB less"
        );
    }
}

#[test]
fn six_decibels_less_are_half_the_distance() {
    let (far, frames) = delivered(&pair(80.0));
    let less = format!("{} dBm", -20.0 * math::log10(2.0));
    let (near, _) = delivered(&pair(40.0).set("model.bee.radio.tx_power", less));
    assert!(
        (far - near).abs() < 5.0 * (0.5 / frames).sqrt(),
        "{far}, {near}"
    );
}

#[test]
fn a_bee_that_counts_knows_the_share_that_comes_through() {
    let patient = pair(80.0).set("model.bee.params.memory", "1 min");
    let runs = patient.set("run.end_time", "5 min").seeds(1..5);
    for run in runs.expect("they run") {
        let told = run.metric("delivery").expect("they hear each other").mean;
        let wanted = prr(80.0, 0.0);
        // Two bees and three hundred frames each.
        assert!(
            (told - wanted).abs() < 4.0 * (0.25_f64 / 600.0).sqrt(),
            "{told}, {wanted}"
        );
    }
}

#[test]
fn without_a_spread_of_the_noise_each_frame_is_heard_by_all_in_reach_and_nobody_else() {
    let quiet = still().set("channel.noise_floor.sigma", "0 dB");
    let far = math::pow(10.0, (78.0 - path_loss_db(1.0)) / 20.0);
    for (power, reach) in [("0 dBm", far), ("-6.0206 dBm", 0.5 * far)] {
        let run = quiet.clone().set("model.bee.radio.tx_power", power).run();
        let run = run.expect("it runs");
        let place = |bee| run.pose(&format!("bee-{bee}")).expect("forty").position;
        for bee in 0..40 {
            let others = (0..40).filter(|other| *other != bee);
            let near = others.filter(|other| place(bee).distance(place(*other)).get() < reach);
            let path = format!("bee-{bee}");
            let told = run.metric_of(&path, "neighbours").map(|tally| tally.last);
            assert_eq!(told, Some(near.count() as f64), "{path}, {power}");
        }
    }
}

#[test]
fn who_falls_silent_is_forgotten() {
    // One frame each is all there is in the run; after the memory has passed nobody has a neighbour.
    let run = pair(10.0)
        .set("model.bee.params.period", "30 s")
        .set("model.bee.params.memory", "100 ms")
        .run()
        .expect("it runs");
    assert_eq!(run.total("packets-heard"), 4.0);
    assert_eq!(run.total("neighbours"), 0.0);
}

#[test]
fn more_than_the_air_can_take_is_lost_and_the_run_goes_on() {
    let run = still()
        .set("channel.medium", "ieee802154")
        .set("model.bee.params.period", "2 ms")
        .set("run.end_time", "1 s")
        .run()
        .expect("it runs");
    let full = run.packets.lost.get("queue-full").copied();
    assert!(full > Some(1000), "{:?}", run.packets);
}

/// Somebody with another protocol on the same channel.
#[behavior("test-foreign-bee")]
struct ForeignBee {
    radio: RadioHandle,
}

/// It has none.
#[params]
#[derive(Default)]
struct ForeignBeeParams {}

impl Behavior for ForeignBee {
    type Params = ForeignBeeParams;

    fn build(_: ForeignBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        kit.every(Time::si(1.0), |me: &mut Self, bee| {
            _ = bee.send(me.radio, b"\xff\xfe\0")
        });
        Ok(Self {
            radio: kit.radio()?,
        })
    }
}

#[test]
fn a_frame_that_is_no_name_is_ignored() {
    let heard = simbeeotic::run_text(
        r#"
        [run]
        end_time = "10 s"

        [channel]
        medium = "simple"

        [[model]]
        use = "test-foreign-bee"
        start = ["1 m", "0 m", "5 m"]
        radio = { use = "default-radio" }

        [[model]]
        use = "calling-bee"
        start = ["0 m", "0 m", "5 m"]
        radio = { use = "default-radio" }
        "#,
    );
    let run = heard.unwrap_or_else(|error| panic!("{error}"));
    assert!(run.packets.received > 10, "{:?}", run.packets);
    assert_eq!(run.total("packets-heard") + run.total("neighbours"), 0.0);
}

#[test]
fn a_run_repeats_on_any_number_of_threads() {
    let hash = |threads| {
        still()
            .threads(threads)
            .run()
            .expect("it runs")
            .trace_hash
            .clone()
    };
    assert_eq!(hash(1), hash(2));
}
