//! Radios of other kinds on the same medium: LoRa, GFSK, a noisy receiver.

use super::{Trial, assert_time_is_whole, at_once, micros};
use crate::support::secs;
use simbeeotic_kernel::ModelId;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_radio::{Arithmetic, BitErrors, Ieee802154Config, OqpskDsss, Phy, RadioSpec};
use simbeeotic_units::{Decibels, PowerLevel};
use std::sync::Arc;

/// A LoRa radio at 868.1 MHz with 125 kHz and 14 dBm.
fn lora(bee: usize, spreading_factor: u8) -> RadioSpec {
    use simbeeotic_radio::sx127x::{Lora, spec};
    let lora = Lora {
        spreading_factor,
        ..Lora::default()
    };
    let centre = simbeeotic_units::Frequency::si(868.1e6);
    RadioSpec {
        owner: ModelId(bee as u32),
        key: path_key(&format!("node-{bee}/radio")),
        ..spec(centre, PowerLevel::from_dbm(14.0), lora).unwrap()
    }
}

#[test]
fn the_longest_frame_of_lora_is_received_nine_seconds_later() {
    let specs = vec![lora(0, 12), lora(1, 12)];
    let airtime = specs[0].airtime(255).secs();
    assert!((8.9..9.2).contains(&airtime), "{airtime} s");
    for arithmetic in [Arithmetic::Fast, Arithmetic::Exact] {
        let config = Ieee802154Config {
            arithmetic,
            ..Ieee802154Config::default()
        };
        let places = vec![[0.0; 3], [1000.0, 0.0, 0.0]];
        let mut trial = Trial::new(config, specs.clone(), places);
        trial.broadcast(micros(1000), 0, 255);
        trial.run(secs(20));
        let times: Vec<f64> = trial.got.iter().map(|got| got.time_ns as f64).collect();
        assert_eq!(times.len(), 1);
        assert!((times[0] * 1e-9 - trial.got[0].sent_ns as f64 * 1e-9 - airtime).abs() < 1e-6);
        assert_time_is_whole(&trial, secs(20));
    }
}

#[test]
fn a_frame_of_lora_must_be_six_decibels_above_others_of_its_spreading_factor() {
    // Received at 1 km from the first sender; the second speaks in the middle of the first's frame.
    let received = |factor: u8, db: f64, arithmetic| {
        let far_m = 1000.0 * simbeeotic_units::math::pow(10.0, db / 20.0);
        let config = Ieee802154Config {
            arithmetic,
            ..Ieee802154Config::default()
        };
        let specs = vec![lora(0, 7), lora(1, factor), lora(2, 7)];
        let places = vec![[-1000.0, 0.0, 0.0], [far_m, 0.0, 0.0], [0.0; 3]];
        let mut trial = Trial::new(config, specs, places);
        trial.broadcast(micros(1000), 0, 20);
        trial.broadcast(micros(20_000), 1, 20);
        trial.run(secs(1));
        let at_2 = trial.got.iter().filter(|got| got.receiver == 2);
        at_2.map(|got| got.sender).collect::<Vec<u32>>()
    };
    for arithmetic in [Arithmetic::Fast, Arithmetic::Exact] {
        // Of its own factor: how much the first is stronger.
        for (db, first) in [(-6.0, false), (0.0, false), (5.5, false), (6.5, true)] {
            let expected: &[u32] = if first { &[0] } else { &[] };
            assert_eq!(received(7, db, arithmetic), expected, "{db} dB");
        }
        // Of another, like noise: least ratio of -7.5 dB.
        for (db, first) in [(-8.0, false), (-7.0, true), (0.0, true)] {
            let expected: &[u32] = if first { &[0] } else { &[] };
            assert_eq!(received(9, db, arithmetic), expected, "SF 9, {db} dB");
        }
    }
}

#[test]
fn radios_with_equal_modulations_made_apart_understand_each_other() {
    use simbeeotic_radio::{Gfsk, Step};
    let received = |one: Arc<dyn BitErrors>, other: Arc<dyn BitErrors>| {
        let with = |bee, bits| {
            at_once(
                bee,
                Phy {
                    bits,
                    ..Phy::default()
                },
            )
        };
        let specs = vec![with(0, one), with(1, other)];
        let places = vec![[0.0; 3], [5.0, 0.0, 0.0]];
        let mut trial = Trial::new(Ieee802154Config::default(), specs, places);
        trial.broadcast(micros(1000), 0, 20);
        trial.run(secs(1));
        trial.got.len()
    };
    let gfsk = |bandwidth_over_rate| -> Arc<dyn BitErrors> {
        Arc::new(Gfsk {
            bandwidth_over_rate,
        })
    };
    let step = Step {
        margin: Decibels::from_db(1.0),
    };
    assert_eq!(received(Arc::new(OqpskDsss), Arc::new(OqpskDsss)), 1);
    assert_eq!(received(gfsk(1.3), gfsk(1.3)), 1);
    assert_eq!(received(gfsk(1.3), gfsk(1.4)), 0);
    assert_eq!(received(gfsk(1.3), Arc::new(step)), 0);
}

#[test]
fn a_sender_with_a_noisy_receiver_of_its_own_is_heard_through_walls_as_others_are() {
    let rssi_dbm = |walls: bool| {
        // Received with about -85 dBm: far below the sender's noise, far above the receiver's.
        let loud = Phy {
            noise: PowerLevel::from_dbm(-50.0),
            ..Phy::default()
        };
        let specs = vec![at_once(0, loud), at_once(1, Phy::default())];
        let config = Ieee802154Config {
            walls,
            ..Ieee802154Config::default()
        };
        let places = vec![[0.0, -80.0, 0.0], [0.0, 80.0, 0.0]];
        let mut trial = Trial::new(config, specs, places);
        trial.broadcast(micros(1000), 0, 20);
        trial.run(secs(1));
        assert_eq!(trial.got.len(), 1);
        trial.got[0].rssi_dbm
    };
    let [without, with] = [rssi_dbm(false), rssi_dbm(true)];
    assert!(without < -80.0, "{without} dBm");
    assert!((without - with - 6.0).abs() < 1e-3, "{without} {with}");
}
