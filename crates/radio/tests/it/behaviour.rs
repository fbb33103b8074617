//! What the simple medium does, one rule at a time; among them what the original got wrong.

use crate::support::{Still, bee, broadcast, config, medium, pairs, quiet, round, secs};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Channel, Command, Isotropic, Loss, Medium, Outcome, RadioError, RadioId, RadioSpec, RadioState,
    Request, Scratch, SimpleConfig, SimpleMedium, Ticket,
};
use simbeeotic_units::{Decibels, Length, PowerLevel};
use std::sync::Arc;

fn line(n: usize, spacing_m: f64) -> Still {
    Still::at((0..n).map(|i| [i as f64 * spacing_m, 0.0, 0.0]))
}

#[test]
fn a_sender_never_hears_itself() {
    let mut m = medium(quiet(), (0..2).map(bee));
    m.submit(secs(1), broadcast(0, b"x"));
    assert_eq!(m.next_time(), Some(secs(1)));
    let heard = round(&mut m, secs(1), &line(2, 5.0));
    assert_eq!(pairs(&heard), [(1, 0)]);
    assert_eq!(m.next_time(), None);
    assert!(
        round(&mut m, secs(1), &line(2, 5.0)).is_empty(),
        "a frame is heard once"
    );
}

#[test]
fn free_space_at_10_metres_is_minus_60_dbm() {
    // The original got -80.07: its wavelength was ten times too short.
    let mut m = medium(quiet(), (0..2).map(bee));
    m.submit(secs(1), broadcast(0, b"x"));
    let heard = round(&mut m, secs(1), &line(2, 10.0));
    assert!((f64::from_bits(heard[0].3) + 60.070_085).abs() < 1e-4);
}

#[test]
fn touching_radios_hear_no_more_than_was_sent() {
    // The original amplified below 1 cm.
    for distance_m in [0.0, 1e-6, 0.003, 0.009] {
        let mut m = medium(quiet(), (0..2).map(bee));
        m.submit(secs(1), broadcast(0, b"x"));
        let heard = round(&mut m, secs(1), &line(2, distance_m));
        assert!((f64::from_bits(heard[0].3)).abs() < 1e-6, "{distance_m} m");
    }
}

#[test]
fn only_the_same_channel_hears() {
    // The original never compared channels.
    let channel = Channel::ieee802154(12).unwrap();
    let mut m = medium(quiet(), [bee(0), RadioSpec { channel, ..bee(1) }, bee(2)]);
    m.submit(secs(1), broadcast(0, b"x"));
    assert_eq!(pairs(&round(&mut m, secs(1), &line(3, 5.0))), [(2, 0)]);
    m.command(secs(1), RadioId(2), Command::Tune(channel))
        .unwrap();
    m.submit(secs(2), broadcast(1, b"x"));
    assert_eq!(pairs(&round(&mut m, secs(2), &line(3, 5.0))), [(2, 1)]);
}

#[test]
fn a_frame_goes_out_on_the_channel_it_was_submitted_on() {
    let channel = Channel::ieee802154(12).unwrap();
    let mut m = medium(quiet(), [bee(0), bee(1), RadioSpec { channel, ..bee(2) }]);
    m.submit(secs(1), broadcast(0, b"old"));
    m.command(secs(1), RadioId(0), Command::Tune(channel))
        .unwrap();
    assert_eq!(pairs(&round(&mut m, secs(1), &line(3, 5.0))), [(1, 0)]);
    m.submit(secs(2), broadcast(0, b"new"));
    assert_eq!(pairs(&round(&mut m, secs(2), &line(3, 5.0))), [(2, 0)]);
    assert_eq!(m.spec(RadioId(0)).channel, channel);
}

#[test]
fn range_limit_and_sensitivity_cut() {
    let far = SimpleConfig {
        range_limit: Length::from_metres(f64::INFINITY),
        ..quiet()
    };
    // Free space at 0 dBm reaches the CC2420's -90 dBm at 313.7 m.
    for (config, spacing_m, received, reason) in [
        (quiet(), 29.999, 1, None),
        (quiet(), 30.001, 0, Some(Loss::OutOfRange)),
        (far.clone(), 313.0, 1, None),
        (far, 315.0, 0, Some(Loss::BelowSensitivity)),
    ] {
        let mut m = medium(config, (0..2).map(bee));
        m.submit(secs(1), broadcast(0, b"x"));
        round(&mut m, secs(1), &line(2, spacing_m));
        let counters = m.counters(RadioId(1));
        assert_eq!(counters.received, received, "{spacing_m} m");
        for loss in Loss::ALL {
            assert_eq!(
                counters.lost(loss),
                u64::from(Some(loss) == reason),
                "{spacing_m} m"
            );
        }
        let sender = m.counters(RadioId(0));
        assert_eq!(
            (sender.sent, sender.missed()),
            (1, 0),
            "own frames are not missed"
        );
    }
}

#[test]
fn antenna_gains_of_both_ends_add() {
    let antenna = |db| {
        Arc::new(Isotropic {
            gain: Decibels::from_db(db),
        })
    };
    let specs = [
        RadioSpec {
            antenna: antenna(3.0),
            ..bee(0)
        },
        RadioSpec {
            antenna: antenna(-5.0),
            ..bee(1)
        },
    ];
    let mut m = medium(quiet(), specs);
    m.submit(secs(1), broadcast(0, b"x"));
    let heard = round(&mut m, secs(1), &line(2, 10.0));
    assert!((f64::from_bits(heard[0].3) + 62.070_085).abs() < 1e-4);
}

#[test]
fn sleepers_neither_hear_nor_send() {
    let mut m = medium(quiet(), (0..3).map(bee));
    let poses = line(3, 5.0);
    m.command(secs(1), RadioId(1), Command::Sleep).unwrap();
    m.submit(secs(1), broadcast(0, b"x"));
    m.submit(
        secs(1),
        Request {
            ticket: Some(Ticket(9)),
            ..broadcast(1, b"y")
        },
    );
    assert_eq!(pairs(&round(&mut m, secs(1), &poses)), [(2, 0)]);
    let mut scratch = Scratch::new();
    let refused = Outcome {
        ticket: Ticket(9),
        result: Err(Loss::SenderAsleep),
    };
    assert_eq!(
        m.collect(RadioId(1), &poses, &mut scratch).outcomes(),
        [refused]
    );
    assert_eq!(m.state(RadioId(1), secs(2)), RadioState::Sleep);

    m.command(secs(2), RadioId(1), Command::Wake).unwrap();
    m.submit(secs(2), broadcast(0, b"x"));
    assert_eq!(pairs(&round(&mut m, secs(2), &poses)), [(1, 0), (2, 0)]);
    let counters = m.counters(RadioId(1));
    assert_eq!(
        (
            counters.lost(Loss::Asleep),
            counters.lost(Loss::SenderAsleep)
        ),
        (1, 1)
    );
    assert_eq!((counters.received, counters.missed()), (1, 1));
    assert_eq!(
        m.usage(RadioId(1), secs(3)).time(RadioState::Sleep).secs(),
        1.0
    );
}

#[test]
fn a_frame_under_way_outlives_its_senders_sleep() {
    let mut m = medium(quiet(), (0..2).map(bee));
    m.submit(secs(1), broadcast(0, b"x"));
    m.command(secs(1), RadioId(0), Command::Sleep).unwrap();
    assert_eq!(pairs(&round(&mut m, secs(1), &line(2, 5.0))), [(1, 0)]);
}

#[test]
fn addressed_packets_go_to_their_address_only() {
    for by_receiver_from in [1, 1000] {
        let mut m = medium(
            SimpleConfig {
                by_receiver_from,
                ..quiet()
            },
            (0..4).map(bee),
        );
        let request = Request {
            destination: Some(ModelId(2)),
            ..broadcast(0, b"x")
        };
        m.submit(secs(1), request);
        assert_eq!(pairs(&round(&mut m, secs(1), &line(4, 5.0))), [(2, 0)]);
        let by_stander = m.counters(RadioId(1));
        assert_eq!(
            (
                by_stander.received,
                by_stander.overheard,
                by_stander.missed()
            ),
            (0, 1, 0)
        );
        let receiving = m.usage(RadioId(1), secs(2)).time(RadioState::Receive);
        assert!(receiving.secs() > 0.0, "overhearing costs power");
    }
}

#[test]
fn outcomes_come_back_with_their_tickets() {
    let mut m = medium(quiet(), (0..2).map(bee));
    let ticket = |number| Some(Ticket(number));
    m.submit(
        secs(1),
        Request {
            ticket: ticket(1),
            ..broadcast(0, b"x")
        },
    );
    m.submit(secs(1), broadcast(0, b"no receipt"));
    m.submit(
        secs(1),
        Request {
            ticket: ticket(2),
            ..broadcast(0, &[0; 117])
        },
    );
    let heard = round(&mut m, secs(1), &line(2, 5.0));
    assert_eq!(
        heard.len(),
        2,
        "a payload of 117 bytes does not fit into a frame"
    );
    let mut scratch = Scratch::new();
    let inbox = m.collect(RadioId(0), &line(2, 5.0), &mut scratch);
    assert_eq!(
        inbox.outcomes(),
        [
            Outcome {
                ticket: Ticket(1),
                result: Ok(())
            },
            Outcome {
                ticket: Ticket(2),
                result: Err(Loss::TooLong)
            }
        ]
    );
    assert_eq!(m.totals().sent, 2);
    assert_eq!(m.totals().lost(Loss::TooLong), 1);
}

#[test]
fn packets_come_in_the_order_of_their_requests() {
    for by_receiver_from in [1, 1000] {
        let mut m = medium(
            SimpleConfig {
                by_receiver_from,
                ..quiet()
            },
            (0..3).map(bee),
        );
        for (radio, payload) in [(2, b"a"), (0, b"b"), (2, b"c")] {
            m.submit(secs(1), broadcast(radio, payload));
        }
        let heard = round(&mut m, secs(1), &line(3, 5.0));
        let heard: Vec<_> = heard
            .iter()
            .map(|&(rx, _, first, _)| (rx, first.unwrap()))
            .collect();
        let expected = [
            (0, b'a'),
            (0, b'c'),
            (1, b'a'),
            (1, b'b'),
            (1, b'c'),
            (2, b'b'),
        ];
        assert_eq!(heard, expected);
    }
}

#[test]
fn payloads_are_shared_and_not_copied() {
    let mut m = medium(quiet(), (0..3).map(bee));
    let payload: Arc<[u8]> = Arc::from(*b"shared");
    m.submit(
        secs(1),
        Request::broadcast(RadioId(0), Arc::clone(&payload)),
    );
    round(&mut m, secs(1), &line(3, 5.0));
    let mut scratch = Scratch::new();
    let packet = m
        .collect(RadioId(2), &line(3, 5.0), &mut scratch)
        .into_iter()
        .next()
        .unwrap();
    assert!(Arc::ptr_eq(&packet.shared_payload(), &payload));
    assert_eq!(packet.time(), secs(1));
}

#[test]
fn charge_is_current_times_time_for_each_state() {
    let mut m = medium(quiet(), (0..2).map(bee));
    for second in 1..=10 {
        m.submit(secs(second), broadcast(0, &[1, 2, 3, 4]));
        round(&mut m, secs(second), &line(2, 5.0));
    }
    // 4 bytes of payload are 21 on the air: 672 us each. (The original's mA s were mA ms here and
    // bytes there.)
    let (sender, receiver) = (m.usage(RadioId(0), secs(20)), m.usage(RadioId(1), secs(20)));
    let close =
        |got: f64, expected: f64| assert!((got - expected).abs() < 1e-9, "{got} {expected}");
    let airtime_s = 10.0 * 672e-6;
    close(
        sender.charge(RadioState::Transmit).milliampere_seconds(),
        17.4 * airtime_s,
    );
    close(
        sender.charge(RadioState::Idle).milliampere_seconds(),
        0.426 * (20.0 - airtime_s),
    );
    close(
        receiver.charge(RadioState::Receive).milliampere_seconds(),
        18.8 * airtime_s,
    );
    close(
        receiver.charge(RadioState::Transmit).milliampere_seconds(),
        0.0,
    );
    close(
        receiver.time(RadioState::Idle).secs() + receiver.time(RadioState::Receive).secs(),
        20.0,
    );
}

#[test]
fn a_new_power_level_is_heard_and_paid_for() {
    let mut m = medium(quiet(), (0..2).map(bee));
    let (level, current) = simbeeotic_radio::cc2420::pa_level(11).unwrap();
    m.command(secs(1), RadioId(0), Command::Power { level, current })
        .unwrap();
    m.submit(secs(1), broadcast(0, &[0; 4]));
    let heard = round(&mut m, secs(1), &line(2, 10.0));
    assert!((f64::from_bits(heard[0].3) + 70.070_085).abs() < 1e-4);
    let drawn = m.usage(RadioId(0), secs(2)).charge(RadioState::Transmit);
    assert!((drawn.milliampere_seconds() - 11.0 * 672e-6).abs() < 1e-12);
    let nonsense = Command::Power {
        level: PowerLevel::from_dbm(f64::NAN),
        current,
    };
    assert!(m.command(secs(2), RadioId(0), nonsense).is_err());
    assert_eq!(
        m.spec(RadioId(0)).tx_power,
        level,
        "refused commands change nothing"
    );
}

#[test]
fn two_radios_on_one_platform_are_two_radios() {
    let second = RadioSpec { key: 99, ..bee(0) };
    let mut m = medium(quiet(), [bee(0), second, bee(1)]);
    m.submit(secs(1), broadcast(0, b"x"));
    assert_eq!(
        pairs(&round(&mut m, secs(1), &line(2, 5.0))),
        [(1, 0), (2, 0)]
    );
}

#[test]
fn an_idle_medium_asks_for_no_poses_and_no_rounds() {
    struct Nowhere;
    impl simbeeotic_radio::Poses for Nowhere {
        fn pose(&self, _: ModelId) -> simbeeotic_units::Pose {
            panic!("nobody speaks: who wants to know?")
        }
    }
    let mut m = medium(config(), (0..10).map(bee));
    assert!(round(&mut m, secs(1), &Nowhere).is_empty());
    assert_eq!(m.next_time(), None);
}

#[test]
fn positions_are_asked_for_once_per_instant() {
    use std::cell::Cell;
    struct Counting(Cell<u32>, Still, u64);
    impl simbeeotic_radio::Poses for Counting {
        fn pose(&self, owner: ModelId) -> simbeeotic_units::Pose {
            self.0.set(self.0.get() + 1);
            self.1.pose(owner)
        }
        fn generation(&self) -> u64 {
            self.2
        }
    }
    let mut poses = Counting(Cell::new(0), line(5, 5.0), 0);
    let mut m = medium(quiet(), (0..5).map(bee));
    for _ in 0..3 {
        m.submit(secs(1), broadcast(0, b"x"));
        round(&mut m, secs(1), &poses);
    }
    assert_eq!(poses.0.get(), 5);
    // Somebody was put elsewhere within the instant.
    poses.2 = 1;
    m.submit(secs(1), broadcast(0, b"x"));
    round(&mut m, secs(1), &poses);
    assert_eq!(poses.0.get(), 10);
    m.submit(secs(2), broadcast(0, b"x"));
    round(&mut m, secs(2), &poses);
    assert_eq!(poses.0.get(), 15);
}

#[test]
fn setups_that_make_no_sense_are_refused() {
    let mut m = medium(quiet(), [bee(0)]);
    assert!(matches!(
        m.add(bee(0)),
        Err(RadioError::DuplicateKey { .. })
    ));
    assert_eq!(m.radios(), 1);
    for bad in [
        SimpleConfig {
            range_limit: Length::from_metres(-1.0),
            ..config()
        },
        SimpleConfig {
            range_limit: Length::from_metres(f64::NAN),
            ..config()
        },
        SimpleConfig {
            noise_floor: PowerLevel::from_dbm(f64::NAN),
            ..config()
        },
        SimpleConfig {
            noise_sigma: Decibels::from_db(-1.0),
            ..config()
        },
    ] {
        assert!(SimpleMedium::new(bad).is_err());
    }
}

#[test]
fn poses_without_numbers_hear_nothing_and_break_nothing() {
    let poses = Still::at([
        [0.0; 3],
        [f64::NAN; 3],
        [f64::INFINITY, 0.0, 0.0],
        [5.0, 0.0, 0.0],
    ]);
    for by_receiver_from in [1, 1000] {
        let mut m = medium(
            SimpleConfig {
                by_receiver_from,
                ..quiet()
            },
            (0..4).map(bee),
        );
        (0..4).for_each(|radio| m.submit(secs(1), broadcast(radio, b"x")));
        assert_eq!(pairs(&round(&mut m, secs(1), &poses)), [(0, 3), (3, 0)]);
    }
}

#[test]
fn time_may_be_late() {
    let late = SimTime::MAX;
    let mut m = medium(quiet(), (0..2).map(bee));
    m.submit(late, broadcast(0, b"x"));
    assert_eq!(round(&mut m, late, &line(2, 5.0)).len(), 1);
    assert!(m.usage(RadioId(0), late).total().coulombs() > 0.0);
}
