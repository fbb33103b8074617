//! Media that deliver by chance, as a scenario chooses them.

use crate::operator::{Cast, play};

/// What Bob, `east_m` from Ann, received of 400 packets that she sent, one each 2 ms: the last line of
/// each is its counters.
fn counted(medium: &str, east_m: f64) -> Result<Vec<String>, String> {
    let channel = format!("[channel]\nmedium = {medium}\nrange_limit = \"30 m\"");
    let mut ann: Vec<String> = (0..400)
        .map(|k| format!("{} send radio x", 2 * (k + 1)))
        .collect();
    ann.push("900 count radio".to_owned());
    let ann: Vec<&str> = ann.iter().map(String::as_str).collect();
    let cast = [
        Cast::bee("ann", 0.0, &ann),
        Cast::bee("bob", east_m, &["900 count radio"]),
    ];
    play(&channel, &cast)
}

/// The share of packets that got through.
fn share(medium: &str, east_m: f64) -> f64 {
    let said = counted(medium, east_m).unwrap_or_else(|e| panic!("{e}"));
    said.iter()
        .filter(|line| line.contains("bob hears x"))
        .count() as f64
        / 400.0
}

#[test]
fn a_bernoulli_medium_delivers_its_share_and_counts_the_rest_as_lost() {
    let said = counted(r#"{ use = "bernoulli", delivery = 0.9 }"#, 10.0).unwrap();
    let heard = said
        .iter()
        .filter(|line| line.contains("bob hears"))
        .count();
    // 360 and three sigma.
    assert!((342..=378).contains(&heard), "{heard}");
    assert!(
        said.iter().any(|line| line.contains("-60.1 dBm")),
        "the RSSI is that of free space"
    );
    let counters = format!(
        "bob radio: 0 sent, {heard} received, 0 overheard, {} noise",
        400 - heard
    );
    assert!(
        said.last().unwrap().ends_with(&counters),
        "{:?}",
        said.last()
    );
}

#[test]
fn without_a_chance_all_is_delivered_up_to_the_range_limit() {
    assert_eq!(share("\"bernoulli\"", 29.9), 1.0);
    assert_eq!(share("\"bernoulli\"", 30.1), 0.0);
    assert_eq!(share(r#"{ use = "bernoulli", delivery = 0.0 }"#, 1.0), 0.0);
}

#[test]
fn chance_goes_down_along_the_curve() {
    let curve = r#"{ use = "bernoulli", curve = [["0 m", 1.0], ["10 m", 1.0], ["20 m", 0.0]] }"#;
    assert_eq!(share(curve, 5.0), 1.0);
    assert!((share(curve, 15.0) - 0.5).abs() < 0.08);
    assert_eq!(share(curve, 25.0), 0.0);
}

#[test]
fn a_gilbert_elliott_link_loses_in_bursts() {
    // Bad for 20 ms, ten packets, on average; 60 ms good: a quarter is lost.
    let medium = r#"{ use = "gilbert-elliott", good = "60 ms", bad = "20 ms" }"#;
    let said = counted(medium, 10.0).unwrap_or_else(|e| panic!("{e}"));
    let mut heard = [false; 400];
    for line in said.iter().filter(|line| line.contains("bob hears")) {
        let seconds: f64 = line.split(' ').next().unwrap().parse().unwrap();
        heard[(seconds * 500.0).round() as usize - 1] = true;
    }
    let lost = heard.iter().filter(|heard| !**heard).count();
    let bursts = heard.chunk_by(|a, b| a == b).filter(|run| !run[0]).count();
    assert!((20..220).contains(&lost), "{lost} lost");
    let mean = lost as f64 / bursts as f64;
    assert!(mean > 4.0, "bursts of {mean}; single losses would have 1.3");
}

#[test]
fn chances_and_times_that_make_no_sense_are_refused_by_their_keys() {
    for (medium, key, words) in [
        (
            r#"{ use = "bernoulli", delivery = 1.5 }"#,
            "delivery",
            "from 0 to 1",
        ),
        (
            r#"{ use = "bernoulli", delivery = 0.5, curve = [["0 m", 1.0]] }"#,
            "delivery",
            "beside",
        ),
        (
            r#"{ use = "bernoulli", curve = [] }"#,
            "curve",
            "one point or more",
        ),
        (
            r#"{ use = "bernoulli", curve = [["9 m", 1.0], ["5 m", 0.5]] }"#,
            "curve",
            "rise",
        ),
        (
            r#"{ use = "bernoulli", curve = [["9 m", -0.1]] }"#,
            "curve",
            "from 0 to 1",
        ),
        (
            r#"{ use = "bernoulli", chance = 0.5 }"#,
            "chance",
            "delivery",
        ),
        (
            r#"{ use = "gilbert-elliott", good = "0 s" }"#,
            "good",
            "1 us",
        ),
        (
            r#"{ use = "gilbert-elliott", bad_delivery = 2.0 }"#,
            "bad_delivery",
            "from 0 to 1",
        ),
    ] {
        let fault = counted(medium, 10.0).expect_err(medium);
        assert!(
            fault.contains(key) && fault.contains(words),
            "{medium}: {fault}"
        );
    }
}
