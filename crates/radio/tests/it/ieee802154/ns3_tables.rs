//! What comes out, against tables of ns-3: bit errors, access, delivery, capture.

use super::{Trial, at_once, ns3_config};
use crate::support::secs;
use simbeeotic_kernel::SimTime;
use simbeeotic_radio::{Arithmetic, BitErrors, Ieee802154Config, Loss, OqpskDsss, Phy};
use simbeeotic_units::{Decibels, PowerLevel};
use std::sync::Arc;

/// Rows of one of ns-3's tables: fields by comma, comments and the head left out.
fn table(text: &str) -> impl Iterator<Item = Vec<&str>> {
    let lines = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    lines.map(|line| line.split(',').collect())
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

#[test]
fn bit_errors_agree_with_ns3() {
    let mut rows = 0;
    for row in table(include_str!("../../ns3/errmodel.csv")) {
        let (snr_db, bits, expected) = (number(row[0]), number(row[2]), number(row[3]));
        let success = OqpskDsss.success(Decibels::from_db(snr_db).ratio(), bits);
        assert!((success - expected).abs() < 1e-9, "{row:?}: {success}");
        rows += 1;
    }
    assert!(rows > 100);
}

#[test]
fn access_to_an_idle_channel_takes_what_ns3_says_and_so_does_the_frame() {
    for bytes in [0, 4, 20] {
        let mut trial = Trial::line(ns3_config(bytes as u64), &[0.0, 1.0]);
        for k in 0..4000 {
            trial.broadcast(SimTime::from_millis(10 * k), 0, bytes);
        }
        trial.run(secs(41));
        assert_eq!(trial.got.len(), 4000);
        let mut histogram = [0u32; 8];
        for (k, got) in trial.got.iter().enumerate() {
            assert_eq!(got.time_ns - got.sent_ns, (17 + bytes as u64) * 32_000);
            let delay_ns = got.sent_ns - 10_000_000 * k as u64;
            assert_eq!(delay_ns % 320_000, 0);
            histogram[(delay_ns / 320_000 - 1) as usize] += 1;
        }
        // ns-3's own values and air times are the same to the nanosecond.
        let text = include_str!("../../ns3/access.csv");
        let length = bytes.to_string();
        let mut seen = 0;
        for row in table(text).filter(|row| row[1] == length) {
            let value_ns: u64 = row[3].parse().unwrap();
            match row[0] {
                "air" => assert_eq!(value_ns, (17 + bytes as u64) * 32_000),
                _ => assert!(histogram[(value_ns / 320_000 - 1) as usize] > 0),
            }
            seen += 1;
        }
        assert_eq!(seen, 9);
        // Chi-squared with 7 degrees of freedom: 24.3 in one of a thousand.
        let chi: f64 = histogram
            .iter()
            .map(|&count| (f64::from(count) - 500.0) * (f64::from(count) - 500.0) / 500.0)
            .sum();
        assert!(chi < 24.3, "{histogram:?}");
    }
}

/// Whether a count of `n` trials is within 4.5 standard deviations of its chance; a count more for
/// chances near 0 and 1.
fn within_luck(count: usize, n: usize, chance: f64) -> bool {
    let (n, count) = (n as f64, count as f64);
    (count - n * chance).abs() <= 1.5 + 4.5 * (n * chance * (1.0 - chance)).sqrt()
}

#[test]
fn delivery_over_distance_is_that_of_ns3() {
    let (mut rows, mut between) = (0, 0);
    for row in table(include_str!("../../ns3/prr_distance.csv")) {
        let (bytes, east_m) = (row[2].parse().unwrap(), number(row[4]));
        let noise = PowerLevel::from_dbm(-106.986_585 + number(row[1]));
        let (rx_dbm, snr_db) = (number(row[5]), number(row[6]));
        let (received, analytic, lqi) = (row[9].parse().unwrap(), number(row[11]), number(row[12]));
        let mut config = ns3_config(rows);
        if row[0] == "friis" {
            config.propagation = Arc::new(simbeeotic_radio::FreeSpace);
        }
        config.noise = Some(noise);
        let mut trial = Trial::line(config, &[0.0, east_m]);
        for k in 0..1000 {
            trial.broadcast(SimTime::from_millis(100 * k), 0, bytes);
        }
        trial.run(secs(101));
        let got = trial.got.len();
        assert!(within_luck(got, 1000, analytic), "{row:?}: {got}");
        assert!(
            within_luck(received, 1000, analytic),
            "ns-3 itself: {row:?}"
        );
        for got in &trial.got {
            assert!((got.rssi_dbm - rx_dbm).abs() < 2e-3, "{row:?} {got:?}");
            assert!((got.snr_db - snr_db).abs() < 2e-3, "{row:?} {got:?}");
            // ns-3 cuts off; the file has whole numbers.
            assert!((f64::from(got.lqi) - lqi).abs() <= 1.0, "{row:?} {got:?}");
        }
        let counters = trial.counters(1);
        assert_eq!(counters.received, got as u64);
        assert_eq!(counters.lost(Loss::Noise), 1000 - got as u64);
        rows += 1;
        between += usize::from(analytic > 0.01 && analytic < 0.99);
    }
    assert!(rows > 200 && between > 40, "{rows} {between}");
}

/// The settings of ns-3 with each radio's own access.
fn ns3_at_once(seed: u64) -> Ieee802154Config {
    Ieee802154Config {
        phy: None,
        ..ns3_config(seed)
    }
}

/// How far from a 0 dBm sender the power is this, metres: ns-3's log-distance loss.
fn reach_m(dbm: f64) -> f64 {
    simbeeotic_units::math::pow(10.0, (-46.6777 - dbm) / 30.0)
}

#[test]
fn capture_is_that_of_ns3() {
    // Two frames of 37 bytes at one instant, the weaker at -70 dBm: what comes through of the
    // first, in percent, by its lead in dB.
    for (lead_db, percent) in [
        (-3.0, 0.6),
        (-2.0, 19.7),
        (-1.0, 73.4),
        (0.0, 95.4),
        (1.0, 99.7),
    ] {
        let (a_m, b_m) = (reach_m(-70.0 + lead_db), reach_m(-70.0));
        let specs = (0..3).map(|bee| at_once(bee, Phy::ns3())).collect();
        let places = vec![[a_m, 0.0, 0.0], [-b_m, 0.0, 0.0], [0.0; 3]];
        let mut trial = Trial::new(ns3_at_once(3), specs, places);
        for k in 0..2000 {
            // A nanosecond ahead, so that the first one locks whatever its power.
            trial.broadcast(SimTime::from_nanos(10_000_000 * k), 0, 20);
            trial.broadcast(SimTime::from_nanos(10_000_000 * k + 1), 1, 20);
        }
        trial.run(secs(21));
        let of = |sender| {
            let got = trial.got.iter();
            got.filter(|g| g.receiver == 2 && g.sender == sender)
                .count()
        };
        // ns-3's own share is known to a tenth, from a thousand frames.
        let share = of(0) as f64 / 20.0;
        assert!((share - percent).abs() < 4.5, "{lead_db} dB: {share} %");
        assert_eq!(of(1), 0, "a frame that comes second is never received");
    }
}

#[test]
fn of_frames_that_begin_together_each_interferes_to_the_end_in_ns3_too() {
    // One at -70 dBm, two at -72 dBm, all 37 bytes at one instant: a ratio of -1.01 dB. Whoever's
    // end is done first, nobody's interference may be forgotten as that of a frame inside another.
    let chance = OqpskDsss.success(0.5 * Decibels::from_db(2.0).ratio(), 8.0 * 37.0);
    for arithmetic in [Arithmetic::Fast, Arithmetic::Exact] {
        for strongest in 0..3 {
            let specs = (0..4).map(|bee| at_once(bee, Phy::ns3())).collect();
            let (near_m, far_m) = (reach_m(-70.0), reach_m(-72.0));
            let mut places = vec![[far_m, 0.0, 0.0], [-far_m, 0.0, 0.0], [0.0, far_m, 0.0]];
            places[strongest] = [0.0, -near_m, 0.0];
            places.push([0.0; 3]);
            let config = Ieee802154Config {
                arithmetic,
                ..ns3_at_once(4)
            };
            let mut trial = Trial::new(config, specs, places);
            for k in 0..1000 {
                for radio in 0..3 {
                    trial.broadcast(SimTime::from_millis(10 * k), radio, 20);
                }
            }
            trial.run(secs(11));
            let at_3 = trial.got.iter().filter(|got| got.receiver == 3);
            assert!(at_3.clone().all(|got| got.sender == strongest as u32));
            assert!(within_luck(at_3.count(), 1000, chance), "{chance}");
        }
    }
}

#[test]
fn a_frame_inside_another_spoils_it_but_not_in_ns3() {
    // B, 20 dB stronger, begins and ends while A is on the air.
    for (quirky, expected) in [(true, 1000), (false, 0)] {
        let specs = (0..3).map(|bee| at_once(bee, Phy::ns3())).collect();
        let places = vec![
            [reach_m(-80.0), 0.0, 0.0],
            [-reach_m(-60.0), 0.0, 0.0],
            [0.0; 3],
        ];
        let mut config = ns3_at_once(3);
        if !quirky {
            config.quirks = simbeeotic_radio::Quirks::None;
        }
        let mut trial = Trial::new(config, specs, places);
        for k in 0..1000 {
            trial.broadcast(SimTime::from_millis(20 * k), 0, 100);
            trial.broadcast(SimTime::from_nanos(20_000_000 * k + 1_000_000), 1, 4);
        }
        trial.run(secs(21));
        let of_a = trial
            .got
            .iter()
            .filter(|g| g.receiver == 2 && g.sender == 0);
        assert_eq!(of_a.clone().count(), expected, "quirks: {quirky}");
        assert!(of_a.clone().all(|got| got.lqi == 255));
        let lost = trial.counters(2).lost(Loss::Collision);
        assert_eq!(lost, 2000 - expected as u64);
    }
}
