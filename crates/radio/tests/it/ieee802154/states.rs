//! Radios that send, sleep, idle and change their channel.

use super::{Trial, assert_time_is_whole, at_once, micros, results, state_us, unicast};
use crate::support::secs;
use simbeeotic_radio::{
    Command, Ieee802154Config, Loss, Medium, Phy, RadioId, RadioState, Request,
};
use simbeeotic_units::Time;

#[test]
fn nobody_hears_while_sending() {
    let config = Ieee802154Config::default();
    let specs = (0..3).map(|bee| at_once(bee, Phy::cc2420())).collect();
    let places = vec![[0.0; 3], [1.0, 0.0, 0.0], [10.0, 0.0, 0.0]];
    let mut trial = Trial::new(config, specs, places);
    trial.broadcast(micros(1000), 0, 20);
    trial.broadcast(micros(1500), 1, 20);
    trial.run(secs(1));
    // 1 gives up the frame of 0 to send, 0 is sending; 2 is spoilt by the other, 10 times as near.
    assert!(
        trial.got.iter().all(|got| got.receiver == 2),
        "{:?}",
        trial.got
    );
    let halves = [0, 1].map(|radio| trial.counters(radio).lost(Loss::HalfDuplex));
    assert_eq!(halves, [1, 1]);
    assert_eq!(state_us(&trial, 1, RadioState::Receive, secs(1)), 500.0);
    assert_time_is_whole(&trial, secs(1));
}

#[test]
fn sleepers_hear_nothing_finish_what_they_send_and_refuse_more() {
    let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0, 10.0]);
    let (sleep, wake) = (Command::Sleep, Command::Wake);
    trial.broadcast(micros(0), 0, 20);
    // Until it is on the air: 2 falls asleep in the middle of it, 0 while sending.
    while trial.medium.state(RadioId(0), trial.now) != RadioState::Transmit {
        let next = trial.medium.next_time().unwrap();
        trial.open(next);
    }
    let start = trial.now;
    let middle = start.saturating_add_nanos(500_000);
    trial.run(middle);
    assert_eq!(trial.medium.state(RadioId(2), middle), RadioState::Receive);
    for radio in [0, 2] {
        trial.medium.command(middle, RadioId(radio), sleep).unwrap();
    }
    assert_eq!(trial.medium.state(RadioId(0), middle), RadioState::Transmit);
    assert_eq!(trial.medium.state(RadioId(2), middle), RadioState::Sleep);
    trial.medium.submit(middle, unicast(0, 1, 4, 5));
    trial.run(secs(1));
    assert_eq!(results(&trial), [(0, 5, Err(Loss::SenderAsleep))]);
    assert_eq!(trial.got.len(), 1, "1 has it, and it is whole");
    assert_eq!(trial.got[0].time_ns - trial.got[0].sent_ns, 1_184_000);
    assert_eq!(trial.counters(2).lost(Loss::Asleep), 1);
    assert_eq!(trial.medium.state(RadioId(0), secs(1)), RadioState::Sleep);
    assert_eq!(state_us(&trial, 0, RadioState::Transmit, secs(1)), 1184.0);
    assert_eq!(state_us(&trial, 2, RadioState::Receive, secs(1)), 500.0);

    trial.broadcast(secs(1), 1, 4);
    trial.run(secs(2));
    assert_eq!([0, 2].map(|r| trial.counters(r).lost(Loss::Asleep)), [1, 2]);
    for radio in [0, 2] {
        trial.medium.command(secs(2), RadioId(radio), wake).unwrap();
    }
    trial.broadcast(secs(2), 1, 4);
    trial.run(secs(3));
    assert_eq!(trial.got.len(), 3);
    assert_time_is_whole(&trial, secs(3));
}

#[test]
fn an_idle_radio_asks_for_no_round_and_draws_what_listening_draws() {
    let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0]);
    assert_eq!(trial.medium.next_time(), None);
    trial.run(secs(100));
    assert_eq!((trial.medium.next_time(), trial.rounds), (None, 1));
    let usage = trial.medium.usage(RadioId(1), secs(100));
    assert_eq!(usage.time(RadioState::Listen), Time::from_secs(100.0));
    assert!((usage.total().coulombs() - 1.88).abs() < 1e-9, "18.8 mA");
    // A broadcast: its beginning and its end, and no more than a look or two at the channel.
    trial.broadcast(secs(100), 0, 4);
    let before = trial.rounds;
    trial.run(secs(101));
    assert!(trial.rounds - before <= 4, "{}", trial.rounds - before);
    assert_eq!(trial.medium.next_time(), None);
}

#[test]
fn channels_are_apart_and_a_radio_may_change_its_own() {
    let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0, 10.0]);
    let other = simbeeotic_radio::Channel::ieee802154(20).unwrap();
    trial.run(micros(10));
    trial
        .medium
        .command(micros(10), RadioId(2), Command::Tune(other))
        .unwrap();
    trial.broadcast(micros(20), 0, 4);
    trial.run(secs(1));
    assert_eq!(trial.got.len(), 1);
    assert_eq!(
        trial.counters(2).missed(),
        0,
        "nothing passed on its channel"
    );
    trial
        .medium
        .command(secs(1), RadioId(0), Command::Tune(other))
        .unwrap();
    trial.broadcast(secs(1).saturating_add_nanos(1), 0, 4);
    trial.run(secs(2));
    assert_eq!(trial.got.len(), 2);
    assert_eq!(trial.got[1].receiver, 2);
    // What is on the air reaches who tunes in: it is felt, not received.
    trial.broadcast(secs(2), 0, 100);
    while trial.medium.state(RadioId(0), trial.now) != RadioState::Transmit {
        let next = trial.medium.next_time().unwrap();
        trial.open(next);
    }
    let now = trial.now;
    let silence = trial.medium.ambient(RadioId(1)).dbm();
    trial
        .medium
        .command(now, RadioId(1), Command::Tune(other))
        .unwrap();
    trial.open(now);
    let felt = trial.medium.ambient(RadioId(1)).dbm();
    assert!(
        (silence + 95.5).abs() < 1e-9 && (felt + 54.21).abs() < 0.01,
        "{silence} {felt}"
    );
    trial.run(secs(3));
    assert_eq!(trial.got.len(), 3, "only 2 has it");
    assert_time_is_whole(&trial, secs(3));
}

#[test]
fn a_change_of_channel_takes_effect_at_once_whoever_else_has_something_to_do() {
    let other = simbeeotic_radio::Channel::ieee802154(20).unwrap();
    let begun = |busy: bool| {
        let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0, 10.0]);
        trial.run(micros(1000));
        for radio in [0, 1] {
            let tune = Command::Tune(other);
            trial
                .medium
                .command(micros(1000), RadioId(radio), tune)
                .unwrap();
        }
        for _ in 0..3 {
            let request = Request::broadcast(RadioId(0), vec![0; 30].into());
            trial.medium.submit(micros(1000), request);
        }
        if busy {
            // Somebody's timer.
            (1001..9000).for_each(|us| trial.run(micros(us)));
        }
        trial.run(secs(1));
        assert_eq!(trial.got.len(), 3);
        assert!(
            trial.got.iter().all(|got| got.receiver == 1),
            "on the new one"
        );
        trial.begun
    };
    assert_eq!(begun(true), begun(false));
}

#[test]
fn what_was_asked_to_be_sent_before_a_change_of_channel_goes_out_on_the_old_one() {
    let [second, third] = [20, 25].map(|n| simbeeotic_radio::Channel::ieee802154(n).unwrap());
    let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0, 10.0, 15.0]);
    trial.run(micros(10));
    for (radio, channel) in [(2, second), (3, third)] {
        let tune = Command::Tune(channel);
        trial
            .medium
            .command(micros(10), RadioId(radio), tune)
            .unwrap();
    }
    trial.run(micros(20));
    let send = |trial: &mut Trial, bytes: usize| {
        let request = Request::broadcast(RadioId(0), vec![0; bytes].into());
        trial.medium.submit(micros(20), request);
    };
    for channel in [second, third] {
        send(&mut trial, 30);
        send(&mut trial, 40);
        let tune = Command::Tune(channel);
        trial.medium.command(micros(20), RadioId(0), tune).unwrap();
    }
    send(&mut trial, 30);
    trial.run(secs(1));
    let receivers: Vec<u32> = trial.got.iter().map(|got| got.receiver).collect();
    assert_eq!(receivers, [1, 1, 2, 2, 3]);
    assert_eq!(trial.medium.spec(RadioId(0)).channel, third);
    assert_time_is_whole(&trial, secs(1));
}

#[test]
fn who_changes_channel_before_its_acknowledgement_does_not_acknowledge() {
    let other = simbeeotic_radio::Channel::ieee802154(20).unwrap();
    let mut trial = Trial::line(Ieee802154Config::default(), &[0.0, 5.0, 10.0]);
    trial.run(micros(10));
    let tune = Command::Tune(other);
    trial.medium.command(micros(10), RadioId(2), tune).unwrap();
    let request = unicast(0, 1, 4, 7);
    trial.submit(micros(20), request);
    while trial.got.is_empty() {
        let next = trial.medium.next_time().unwrap();
        trial.open(next);
    }
    // Its acknowledgement is 192 us away.
    let now = trial.now;
    trial.medium.command(now, RadioId(1), tune).unwrap();
    trial.run(now.saturating_add_nanos(1_000));
    assert_eq!(
        trial.medium.state(RadioId(1), trial.now),
        RadioState::Listen
    );
    trial.run(secs(1));
    assert_eq!(state_us(&trial, 1, RadioState::Transmit, secs(1)), 0.0);
    assert_eq!(state_us(&trial, 2, RadioState::Receive, secs(1)), 0.0);
    assert_eq!(trial.counters(0).lost(Loss::NoAcknowledgement), 1);
    // It hears on its new channel.
    let request = Request::broadcast(RadioId(1), vec![0; 4].into());
    trial.submit(secs(1), request);
    trial.run(secs(2));
    assert_eq!((trial.got.len(), trial.got[1].receiver), (2, 2));
}
