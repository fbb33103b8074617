//! That the spread falls as bees turn more, at either pace; that their number hardly changes it; what the sweep
//! is, and that it repeats.

use super::spread_m;
use crate::example;
use simbeeotic::scenario::{Loaded, Request, load_file};

/// The mean spread of several runs at their end, and the half width of its 95 % interval, about.
fn spread(turn: &str, pace: u32, count: u32) -> (f64, f64) {
    let swarm = example("looping/scenario.toml")
        .set("model.bee.params.heading_sigma", turn)
        .set("variables.pace", pace)
        .set("model.bee.count", count);
    let runs = swarm.seeds(1..9).expect("they run");
    let all: Vec<f64> = runs.iter().map(|run| run.total("spread")).collect();
    let mean = all.iter().sum::<f64>() / all.len() as f64;
    let squares = all.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    // t(7) = 2.36, over the root of eight.
    (mean, 2.36 * (squares / 7.0).sqrt() / 8.0_f64.sqrt())
}

#[test]
fn who_turns_more_stays_nearer_at_either_pace() {
    for pace in [1, 2] {
        let all = ["0.05 rad", "0.2 rad", "0.8 rad"].map(|turn| spread(turn, pace, 40));
        for pair in all.windows(2) {
            let [(wide, above), (narrow, below)] = [pair[0], pair[1]];
            assert!(wide - above > narrow + below, "at {pace} m/s: {all:?}");
        }
    }
}

#[test]
fn twice_the_pace_spreads_wider_and_more_bees_do_not() {
    let [(slow, a), (fast, b)] = [1, 2].map(|pace| spread("0.05 rad", pace, 60));
    assert!(fast - b > slow + a, "{slow} and {fast} m");
    let [(few, a), (many, b)] = [20, 60].map(|count| spread("0.2 rad", 1, count));
    assert!((few - many).abs() < a + b, "{few} and {many} m");
}

fn scenario() -> Loaded {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/looping/scenario.toml");
    match load_file(path.as_ref(), &Request::default()) {
        Ok(loaded) => loaded,
        Err(rejected) => panic!("{rejected:?}"),
    }
}

#[test]
fn the_sweep_has_every_combination_with_every_seed() {
    let loaded = scenario();
    let sweep = loaded.sweep().expect("it has one");
    assert_eq!(sweep.len(), 6 * 3 * 2 * 5);
    assert!(sweep.check().is_ok(), "every value is a good one");
    let last = sweep.values(sweep.len() - 1);
    assert_eq!(last, ["1.6 rad", "60", "2"]);
    assert_eq!(sweep.seed(sweep.len() - 1), Some(5));
    // `run` flies what stands in the file.
    assert_eq!(loaded.setup().expect("good").models.len(), 21);
}

#[test]
fn the_ruler_measures_known_swarms() {
    let corners = [
        [1.0, 0.0, 5.0],
        [-1.0, 0.0, 3.0],
        [0.0, 1.0, 5.0],
        [0.0, -1.0, 5.0],
    ];
    assert_eq!(spread_m(&corners), (4.0_f64 / 3.0).sqrt());
    assert_eq!(spread_m(&[[3.0, 4.0, 5.0], [3.0, 4.0, 9.0]]), 0.0);
    assert!(spread_m(&[[3.0, 4.0, 5.0]]).is_nan());
    assert!(spread_m(&[]).is_nan());
}

#[test]
fn the_spread_hangs_on_no_number_of_bees() {
    // Of all pairs of places the mean square is that of the whole: exact for `n - 1`, wrong by half for `n`.
    let all: Vec<[f64; 3]> = (0..20_u32)
        .map(|i| [f64::from(i * i % 17), f64::from(i * 7 % 19), 1.0])
        .collect();
    let square = |x: f64| x * x;
    let mut squares = Vec::new();
    for (at, a) in all.iter().enumerate() {
        squares.extend(all[..at].iter().map(|b| square(spread_m(&[*a, *b]))));
    }
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    let whole = square(spread_m(&all));
    assert!((mean - whole).abs() < 1e-9 * whole, "{mean} and {whole}");
}

#[test]
fn a_run_repeats_on_any_number_of_threads() {
    let swarm = example("looping/scenario.toml").set("run.end_time", "10 s");
    let hash = |threads| {
        let run = swarm.clone().threads(threads).run().expect("it runs");
        run.trace_hash.clone()
    };
    assert_eq!(hash(1), hash(2));
}
