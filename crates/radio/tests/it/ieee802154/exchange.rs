//! Access to the channel, acknowledgements, and what becomes of a packet without one.

use super::{Trial, assert_time_is_whole, at_once, micros, node, results, state_us, unicast};
use crate::support::secs;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{Ieee802154Config, Loss, Medium, Phy, RadioSpec, RadioState};
use simbeeotic_units::{PowerLevel, Time};

#[test]
fn a_packet_to_somebody_is_acknowledged_and_told_so() {
    let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0, 10.0]);
    trial.submit(micros(100), unicast(0, 1, 20, 7));
    trial.run(secs(1));
    assert_eq!(results(&trial), [(0, 7, Ok(()))]);
    assert_eq!(trial.got.len(), 1);
    assert_eq!((trial.got[0].receiver, trial.got[0].sender), (1, 0));
    let counters = [0, 1, 2].map(|radio| trial.counters(radio));
    assert_eq!(
        counters.map(|c| c.sent),
        [1, 0, 0],
        "an acknowledgement is no packet"
    );
    assert_eq!(counters.map(|c| c.received), [0, 1, 0]);
    assert_eq!(counters.map(|c| c.overheard), [0, 0, 1]);
    assert_eq!(counters.map(|c| c.missed()), [0, 0, 0]);
    // 37 bytes one way, 11 bytes back.
    let sent = [0, 1, 2].map(|r| state_us(&trial, r, RadioState::Transmit, secs(1)));
    assert_eq!(sent, [1184.0, 352.0, 0.0]);
    let heard = [0, 1, 2].map(|r| state_us(&trial, r, RadioState::Receive, secs(1)));
    assert_eq!(heard, [352.0, 1184.0, 1536.0]);
    assert_time_is_whole(&trial, secs(1));
}

#[test]
fn a_packet_that_nobody_acknowledges_is_sent_four_times() {
    let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0]);
    trial.submit(micros(0), unicast(0, 9, 4, 1));
    trial.submit(micros(1), unicast(0, 1, 4, 2));
    trial.run(secs(1));
    let expected = [(0, 1, Err(Loss::NoAcknowledgement)), (0, 2, Ok(()))];
    assert_eq!(results(&trial), expected);
    let counters = trial.counters(0);
    assert_eq!(
        (counters.sent, counters.lost(Loss::NoAcknowledgement)),
        (5, 1)
    );
    assert_eq!(trial.counters(1).overheard, 4);
}

#[test]
fn what_comes_twice_is_handed_over_once() {
    // The acknowledgement is lost: the receiver's power is too low to come back.
    let weak = RadioSpec {
        tx_power: PowerLevel::from_dbm(-60.0),
        ..node(1)
    };
    let places = vec![[0.0; 3], [20.0, 0.0, 0.0]];
    let mut trial = Trial::new(Ieee802154Config::default(), vec![node(0), weak], places);
    for k in 0..3 {
        trial.submit(SimTime::from_millis(100 * k), unicast(0, 1, 4, k as u32));
    }
    trial.run(secs(1));
    assert_eq!(trial.got.len(), 3);
    let counters = trial.counters(1);
    assert_eq!((counters.received, counters.repeated), (3, 9));
    assert!(
        results(&trial)
            .iter()
            .all(|r| r.2 == Err(Loss::NoAcknowledgement))
    );
}

#[test]
fn of_two_radios_of_one_platform_both_hand_over_and_one_acknowledges() {
    for keys in [[1, 2], [2, 1]] {
        let mut specs: Vec<RadioSpec> = (0..3).map(node).collect();
        for (spec, key) in specs[1..].iter_mut().zip(keys) {
            (spec.owner, spec.key) = (ModelId(1), path_key(&format!("radio-{key}")));
        }
        let places = vec![[0.0; 3], [5.0, 0.0, 0.0]];
        let mut trial = Trial::new(Ieee802154Config::default(), specs, places);
        trial.submit(micros(100), unicast(0, 1, 20, 7));
        trial.run(secs(1));
        assert_eq!(results(&trial), [(0, 7, Ok(()))]);
        assert_eq!(trial.counters(0).sent, 1);
        let mut receivers: Vec<u32> = trial.got.iter().map(|got| got.receiver).collect();
        receivers.sort_unstable();
        assert_eq!(receivers, [1, 2]);
        let sent = [1, 2].map(|r| state_us(&trial, r, RadioState::Transmit, secs(1)));
        let first = if path_key("radio-1") < path_key("radio-2") {
            1
        } else {
            2
        };
        let answers = if keys[0] == first {
            [352.0, 0.0]
        } else {
            [0.0, 352.0]
        };
        assert_eq!(sent, answers, "{keys:?}");
    }
}

#[test]
fn a_channel_that_stays_busy_is_given_up() {
    // One radio sends without pause, at once and for as long as a frame may be.
    let config = Ieee802154Config::default();
    let mut chatty = at_once(0, Phy::cc2420());
    (chatty.phy.spacing.short, chatty.phy.spacing.long) = (Time::ZERO, Time::ZERO);
    let mut trial = Trial::new(
        config,
        vec![chatty, node(1)],
        vec![[0.0; 3], [1.0, 0.0, 0.0]],
    );
    for _ in 0..60 {
        trial.broadcast(micros(0), 0, 116);
    }
    trial.submit(micros(2000), unicast(1, 0, 4, 3));
    trial.run(secs(2));
    assert_eq!(results(&trial), [(1, 3, Err(Loss::ChannelBusy))]);
    let counters = trial.counters(1);
    assert_eq!((counters.sent, counters.lost(Loss::ChannelBusy)), (0, 1));
    // After five busy assessments: 0 to 7, 15, 31, 31, 31 units of backoff.
    assert_eq!(trial.medium.access_statistics().failures, 1);
    assert_eq!(trial.got.len(), 60, "{:?}", trial.counters(1));
}

#[test]
fn energy_below_the_threshold_leaves_the_channel_free() {
    // A CC2420 at 0 dBm: -77 dBm at about 70 m in free space. Beyond, but above the noise, a frame that
    // is taken in still makes the channel busy.
    use simbeeotic_radio::CcaMode;
    for (mode, east_m, waits) in [
        (CcaMode::Energy, 60.0, true),
        (CcaMode::Energy, 80.0, false),
        (CcaMode::Carrier, 80.0, true),
        (CcaMode::Both, 80.0, true),
    ] {
        let mut late = node(1);
        late.phy.cca.mode = mode;
        let mut trial = Trial::new(
            Ieee802154Config::default(),
            vec![at_once(0, Phy::cc2420()), late],
            vec![[0.0; 3], [east_m, 0.0, 0.0]],
        );
        // On the air for 4.2 ms, from 1 ms on.
        trial.broadcast(micros(1000), 0, 115);
        trial.broadcast(micros(1100), 1, 4);
        trial.run(secs(1));
        let sent_us = trial.begun_us(1);
        assert_eq!(
            sent_us > 5000,
            waits,
            "{mode:?} at {east_m} m: {sent_us} us"
        );
    }
}

#[test]
fn frames_that_do_not_fit_or_have_to_wait_too_long_are_refused() {
    let specs = vec![
        RadioSpec {
            queue_frames: 2,
            ..node(0)
        },
        node(1),
    ];
    let places = vec![[0.0; 3], [1.0, 0.0, 0.0]];
    let mut trial = Trial::new(Ieee802154Config::default(), specs, places);
    trial.run(micros(0));
    for ticket in 0..5 {
        trial.medium.submit(micros(0), unicast(0, 1, 4, ticket));
    }
    trial.medium.submit(micros(0), unicast(0, 1, 117, 9));
    trial.run(secs(1));
    let full = Err(Loss::QueueFull);
    let expected = [
        (0, 3, full),
        (0, 4, full),
        (0, 9, Err(Loss::TooLong)),
        (0, 0, Ok(())),
    ];
    assert_eq!(results(&trial)[..4], expected);
    assert_eq!(trial.got.len(), 3);
    let counters = trial.counters(0);
    assert_eq!(
        (counters.lost(Loss::QueueFull), counters.lost(Loss::TooLong)),
        (2, 1)
    );
}

#[test]
fn frames_of_one_radio_keep_their_distance() {
    // Long ones 640 us, short ones (18 bytes of MPDU) 192 us, and the way to the channel: 320 us or more.
    for (bytes, least_us) in [(20, 640 + 320), (4, 192 + 320)] {
        let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0]);
        for _ in 0..50 {
            trial.broadcast(micros(0), 0, bytes);
        }
        trial.run(secs(1));
        assert_eq!(trial.got.len(), 50);
        let pauses = trial.got.windows(2).map(|w| w[1].sent_ns - w[0].time_ns);
        assert_eq!(pauses.min(), Some(least_us * 1000));
    }
}
