//! The spread against the closed formula of `mod.rs`; that nobody lies around, and nobody gets out.

use crate::example;
use simbeeotic::Experiment;
use simbeeotic::kernel::SimTime;
use simbeeotic::units::math;

/// Equation 2 for steps of 1 m and 1 s.
fn msd(steps: f64, turn_sigma: f64) -> f64 {
    let c = math::exp(-0.5 * turn_sigma * turn_sigma);
    let forgotten = 2.0 * c * (1.0 - math::pow(c, steps)) / ((1.0 - c) * (1.0 - c));
    steps * (1.0 + c) / (1.0 - c) - forgotten
}

/// The mean squared displacement of six hundred bees after each of these seconds.
fn measured(turn: &str, seconds: [u32; 2]) -> [f64; 2] {
    const SEEDS: u64 = 3;
    let mut sums = [0.0; 2];
    for seed in 1..=SEEDS {
        // Three turns a second are enough for a vehicle that meets nothing.
        let mut run = example("random_walk/free.toml")
            .set("model.bee.params.turn_sigma", turn)
            .set("model.bee.vehicle.control_period", "300 ms")
            .seed(seed)
            .simulation()
            .expect("it is right");
        for (sum, second) in sums.iter_mut().zip(seconds) {
            run.run_until(SimTime::from_secs(second.into()))
                .expect("it runs");
            let metrics = run.metrics();
            let msd = metrics.iter().find(|m| m.name == "msd");
            *sum += msd.expect("it is published").values.last;
        }
    }
    sums.map(|sum| sum / SEEDS as f64)
}

#[test]
fn a_free_walk_spreads_as_the_closed_formula_says_the_less_the_more_it_turns() {
    // The squared distance of a bee has about the standard deviation of its mean: of six hundred, 4 %.
    for degrees in [30.0_f64, 45.0, 90.0] {
        let seconds = [30, 120];
        let spread = measured(&format!("{degrees} deg"), seconds);
        for (second, is) in seconds.into_iter().zip(spread) {
            let wanted = msd(second.into(), degrees.to_radians());
            let text = format!("{degrees} degrees, {second} s: {is}, {wanted} m^2");
            assert!((is / wanted - 1.0).abs() < 0.12, "{text}");
        }
    }
}

#[test]
fn once_the_direction_is_forgotten_it_grows_with_the_time_and_not_with_its_square() {
    let [early, late] = measured("60 deg", [40, 80]);
    let turning = late / early;
    assert!(
        (turning - 2.0).abs() < 0.35,
        "{turning} times in twice the time"
    );
    // The control: a bee that does not turn flies straight.
    let [early, late] = measured("0 deg", [40, 80]);
    let straight = late / early;
    assert!(
        (straight - 4.0).abs() < 0.1,
        "{straight} times in twice the time"
    );
}

/// Of all looks at all bees, one each second after the first five: the share that lie on the ground, and how
/// far from the middle the farthest one is, east or north.
fn looks(yard: &Experiment) -> (f64, f64) {
    let (mut all, mut low, mut farthest) = (0_u32, 0_u32, 0.0_f64);
    for seed in 1..4 {
        let mut run = yard.clone().seed(seed).simulation().expect("it is right");
        for second in 5..=60 {
            run.run_until(SimTime::from_secs(second)).expect("it runs");
            for bee in 0..20 {
                let p = run
                    .pose(&format!("bee-{bee}"))
                    .expect("twenty")
                    .position
                    .si();
                all += 1;
                low += u32::from(p.z < 0.1);
                farthest = farthest.max(p.x.abs()).max(p.y.abs());
            }
        }
    }
    (f64::from(low) / f64::from(all), farthest)
}

#[test]
fn nobody_stays_on_the_ground_and_nobody_leaves_the_yard() {
    let yard = example("random_walk/scenario.toml");
    let (low, farthest) = looks(&yard);
    assert_eq!(low, 0.0);
    assert!(farthest < 8.0, "{farthest} m");
    // The control: who heeds neither range finder nor switch lies on the ground at times.
    let blind = yard
        .set("model.bee.params.floor", "0 m")
        .set("model.bee.params.rise", "0 s");
    let (low, _) = looks(&blind);
    assert!(low > 0.02, "{low}");
}

#[test]
fn who_looks_ahead_hardly_touches_a_wall_and_without_walls_all_are_gone() {
    let yard = example("random_walk/scenario.toml").set("run.end_time", "60 s");
    let touches = |yard: &Experiment| -> u64 {
        let runs = yard.seeds(1..4).expect("they run");
        runs.iter().map(|run| run.touches).sum()
    };
    let (sees, blind) = (
        touches(&yard),
        touches(&yard.clone().set("model.bee.params.margin", "0 m")),
    );
    assert!(4 * sees < blind, "{sees} and {blind} touches");
    let start = r#"{ box = ["14 m", "14 m", "0 m"], from = ["-7 m", "-7 m", "1.5 m"], heading = "random" }"#;
    let plain = example("random_walk/free.toml").set("model.bee.count", 20);
    let (_, farthest) = looks(&plain.set("model.bee.start", start));
    assert!(farthest > 20.0, "{farthest} m");
}

#[test]
fn a_run_repeats_on_any_number_of_threads() {
    let yard = example("random_walk/scenario.toml").set("run.end_time", "20 s");
    let hash = |threads| {
        yard.clone()
            .threads(threads)
            .run()
            .expect("it runs")
            .trace_hash
            .clone()
    };
    assert_eq!(hash(1), hash(2));
}
