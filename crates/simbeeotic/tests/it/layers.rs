//! The layers on the packet interface, in runs: beacons, flooding, time slots.

use crate::operator::play_text;
use crate::program::shipped;
use simbeeotic::run_text;
use std::collections::BTreeMap;

/// The last value of a metric, by path.
fn last(metric: &str, said: &[String]) -> BTreeMap<String, f64> {
    let words = said.iter().map(|line| line.split(' ').collect::<Vec<_>>());
    let named = words.filter(|words| words.len() == 5 && words[3] == metric);
    named
        .map(|words| (words[2].to_owned(), words[4].parse().expect("a number")))
        .collect()
}

#[test]
fn in_slots_nothing_is_lost_where_medium_access_alone_loses_most() {
    let scenario = std::fs::read_to_string(shipped("scenarios/slots.toml")).expect("it is shipped");
    let (scenario, _recorder) = scenario.split_once("[[component]]").expect("a recorder");
    let slots = run_text(scenario).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(
        (slots.packets.sent, slots.packets.received),
        (550, 550 * 49)
    );
    assert!(slots.packets.lost.is_empty(), "{:?}", slots.packets.lost);

    let at_once = scenario.replace("access = \"slots\"", "access = \"at-once\"");
    let at_once = run_text(&at_once).unwrap_or_else(|e| panic!("{e}"));
    let share = at_once.packets.received as f64 / slots.packets.received as f64;
    assert!((0.05..0.4).contains(&share), "{share}");
    assert!(at_once.packets.lost["collision"] > 10_000);
}

#[test]
fn bees_that_share_a_slot_collide() {
    let scenario = std::fs::read_to_string(shipped("scenarios/slots.toml")).expect("it is shipped");
    let (scenario, _recorder) = scenario.split_once("[[component]]").expect("a recorder");
    let few = scenario.replace("count = 50 } }", "count = 10 } }");
    assert_ne!(few, scenario);
    let run = run_text(&few).unwrap_or_else(|e| panic!("{e}"));
    assert!(run.packets.lost["collision"] > 0, "{:?}", run.packets.lost);
}

#[test]
fn a_flood_makes_one_hop_a_bee_along_a_line_and_everybody_sends_once() {
    let said = play_text(
        r#"
        [run]
        seed = 1
        end_time = "3 s"
        [channel]
        medium = "simple"
        range_limit = "12 m"
        noise_floor = { mean = "-100 dBm", sigma = "0 dB" }
        [[model]]
        use = "flood-bee"
        name = "source"
        start = ["0 m", "0 m", "5 m"]
        params = { max_speed = "0 m/s", period = "10 s", first = "1 s", flood = { hops = 8 } }
        radio = { use = "cc2420" }
        [[model]]
        use = "flood-bee"
        name = "relay"
        start = { grid = [9, 1, 1], spacing = "10 m", from = ["10 m", "0 m", "5 m"] }
        params = { max_speed = "0 m/s" }
        radio = { use = "cc2420" }
        "#,
    );
    let said = said.unwrap_or_else(|e| panic!("{e}"));
    // The ninth would be nine hops away: one more than the source allows.
    let hops: Vec<f64> = last("hops", &said).into_values().collect();
    assert_eq!(hops, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]);
    let latency = last("latency", &said);
    let latency: Vec<f64> = latency.into_values().collect();
    assert!(
        latency.is_sorted() && latency[7] < 8.0 * 0.05,
        "{latency:?}"
    );
    assert_eq!(
        said.iter()
            .filter(|line| line.contains(" 1 sent on"))
            .count(),
        7
    );
}

#[test]
fn beacons_tell_links_of_one_direction_from_those_of_two() {
    let said = play_text(
        r#"
        [run]
        seed = 1
        end_time = "10 s"
        [channel]
        medium = "ieee802154"
        [[model]]
        use = "beacon-bee"
        name = "strong"
        start = ["0 m", "0 m", "50 m"]
        params = { max_speed = "0 m/s" }
        radio = { use = "cc2420" }
        [[model]]
        use = "beacon-bee"
        name = "weak"
        start = { grid = [2, 1, 1], spacing = "5 m", from = ["100 m", "0 m", "50 m"] }
        params = { max_speed = "0 m/s" }
        radio = { use = "cc2420", tx_level = 3 }
        "#,
    );
    let said = said.unwrap_or_else(|e| panic!("{e}"));
    // At -25 dBm the weak reach 31 m, and the strong 560 m.
    let known = |metric| last(metric, &said).into_values().collect::<Vec<_>>();
    assert_eq!(known("neighbors"), [0.0, 2.0, 2.0]);
    assert_eq!(known("bidirectional"), [0.0, 1.0, 1.0]);
    let lossless = "hears weak-1 best: 1.00, 1.00 back";
    assert!(said.iter().any(|line| line.contains(lossless)), "{said:#?}");
}
