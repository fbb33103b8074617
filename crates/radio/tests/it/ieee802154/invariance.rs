//! What changes nothing: the order of adding, the arithmetic, who is out of reach.

use super::{Got, Trial, assert_time_is_whole, node, ns3_config};
use crate::support::secs;
use simbeeotic_kernel::rng::Stream;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{Arithmetic, Ieee802154Config, Medium, Phy, RadioSpec};
use simbeeotic_units::Length;

/// Nodes in a ball of 20 m, each with a phase of its own.
fn ball(n: usize, seed: u64) -> (Vec<[f64; 3]>, Vec<u64>) {
    let mut stream = Stream::new(seed, "test", "ball");
    let places = (0..n).map(|_| stream.in_ball(20.0).to_array()).collect();
    let phases = (0..n).map(|_| (stream.uniform() * 2e8) as u64).collect();
    (places, phases)
}

/// Plays broadcasts, five a second each, and returns what was received, sorted: (sent, sender,
/// receiver, bits of the power, quality).
fn played(
    config: &Ieee802154Config,
    order: &[usize],
    places: &[[f64; 3]],
    phases: &[u64],
) -> Vec<(u64, u32, u32, u64, u8)> {
    let specs = order.iter().map(|&bee| RadioSpec {
        // Poses are told by order of adding; keys and names stay.
        owner: ModelId(order.iter().position(|&b| b == bee).unwrap() as u32),
        ..node(bee)
    });
    let mut trial = Trial::new(
        config.clone(),
        specs.collect(),
        order.iter().map(|&bee| places[bee]).collect(),
    );
    let mut requests: Vec<(u64, u32)> = (0..5)
        .flat_map(|k| (0..order.len()).map(move |r| (k, r)))
        .map(|(k, r)| (k * 200_000_000 + phases[order[r]], r as u32))
        .collect();
    requests.sort_unstable();
    for (at, radio) in requests {
        trial.broadcast(SimTime::from_nanos(at), radio, 20);
    }
    trial.run(secs(2));
    assert_time_is_whole(&trial, secs(2));
    for radio in 0..order.len() as u32 {
        // Each frame of the others met some fate here.
        let (counters, sent) = (trial.counters(radio), trial.medium.totals().sent);
        let fates = counters.received + counters.missed();
        assert_eq!(fates, sent - counters.sent, "{counters:?}");
    }
    let mut got: Vec<_> = trial
        .got
        .iter()
        .map(|g| {
            let bee = |r: u32| order[r as usize] as u32;
            (
                g.sent_ns,
                bee(g.sender),
                bee(g.receiver),
                g.rssi_dbm.to_bits(),
                g.lqi,
            )
        })
        .collect();
    got.sort_unstable();
    got
}

#[test]
fn the_order_of_adding_and_the_arithmetic_change_nothing() {
    let (places, mut phases) = ball(40, 3);
    // Many speak at one instant.
    phases[..20].fill(1_000_000);
    let forward: Vec<usize> = (0..40).collect();
    let shuffled: Vec<usize> = (0..40).map(|i| (i * 17 + 5) % 40).collect();
    for quirks in [
        simbeeotic_radio::Quirks::None,
        simbeeotic_radio::Quirks::Ns3,
    ] {
        let config = Ieee802154Config {
            quirks,
            ..ns3_config(11)
        };
        let one = played(&config, &forward, &places, &phases);
        assert!(one.len() > 2000, "{}", one.len());
        assert_eq!(one, played(&config, &shuffled, &places, &phases));
        let exact = Ieee802154Config {
            arithmetic: Arithmetic::Exact,
            ..config.clone()
        };
        let exact = played(&exact, &forward, &places, &phases);
        // Link quality is cut off, and may differ by one.
        let bare = |list: &[(u64, u32, u32, u64, u8)]| -> Vec<(u64, u32, u32, u64)> {
            list.iter().map(|g| (g.0, g.1, g.2, g.3)).collect()
        };
        assert_eq!(bare(&one), bare(&exact));
        let other_seed = Ieee802154Config { seed: 12, ..config };
        assert_ne!(one, played(&other_seed, &forward, &places, &phases));
    }
}

/// What `played`, with each packet's signal to noise: sent, sender, receiver, SNR, link quality.
fn heard_by_the_near(
    config: &Ieee802154Config,
    places: &[[f64; 3]],
) -> Vec<(u64, u32, u32, u64, u8)> {
    let specs = (0..places.len()).map(|bee| {
        let mut spec = node(bee);
        // The chance of each frame, as far as 8 bits tell it.
        spec.phy = Phy {
            quality: simbeeotic_radio::LinkQuality::Success,
            ..Phy::ieee802154()
        };
        spec
    });
    let mut trial = Trial::new(config.clone(), specs.collect(), places.to_vec());
    for k in 0..400u64 {
        for bee in 0..places.len() as u64 {
            // Five frames a second of 1.2 ms each, at times that drift past each other.
            let at = k * 20_000_000 + (bee * 1_700_003 + k * bee * 13_331) % 20_000_000;
            if (k + bee) % 4 == 0 {
                trial.broadcast(
                    SimTime::from_nanos(at.max(trial.now.nanos())),
                    bee as u32,
                    20,
                );
            }
        }
    }
    trial.run(secs(10));
    let near = trial.got.iter().filter(|got| got.receiver < 12);
    let told = |g: &Got| (g.sent_ns, g.sender, g.receiver, g.snr_db.to_bits(), g.lqi);
    near.map(told).collect()
}

#[test]
fn nobody_out_of_reach_changes_anything() {
    // Noise of -101 dBm: 0 dB at 65 m. Most links of this ring lie between -2 and 3 dB.
    let mut places: Vec<[f64; 3]> = (0..12u8)
        .map(|k| {
            let angle = f64::from(k) * std::f64::consts::TAU / 12.0;
            let radius_m = 34.0 + 0.3 * f64::from(k);
            let (sin, cos) = simbeeotic_units::math::sin_cos(angle);
            [radius_m * cos, radius_m * sin, 0.0]
        })
        .collect();
    for arithmetic in [Arithmetic::Fast, Arithmetic::Exact] {
        let config = Ieee802154Config {
            range_limit: Some(Length::from_metres(200.0)),
            arithmetic,
            phy: None,
            quirks: simbeeotic_radio::Quirks::None,
            ..ns3_config(2)
        };
        places.truncate(12);
        let alone = heard_by_the_near(&config, &places);
        let open = alone.iter().filter(|got| (5..250).contains(&got.4)).count();
        assert!(
            open > 300,
            "{open} of {} frames hang on chance",
            alone.len()
        );
        places.extend((0..10).map(|k| [5000.0 + 3.0 * f64::from(k), 0.0, 0.0]));
        let among = heard_by_the_near(&config, &places);
        assert!(
            alone == among,
            "{arithmetic:?}: {} and {} packets",
            alone.len(),
            among.len()
        );
    }
}
