//! Changing the channel on the simple medium: what goes out where, and who hears it, hangs on nobody else.

use crate::support::{Still, bee, broadcast, config, medium, pairs, quiet, round, secs};
use simbeeotic_kernel::Stream;
use simbeeotic_radio::{
    Channel, Command, Counters, Loss, Medium, Patch, RadioId, RadioSpec, SimpleConfig, SimpleMedium,
};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::{Attitude, Mount, Offset, Yaw};
use std::sync::Arc;

const ORDERS: [[u32; 3]; 6] = [
    [0, 1, 2],
    [0, 2, 1],
    [1, 0, 2],
    [1, 2, 0],
    [2, 0, 1],
    [2, 1, 0],
];

fn channel(number: u8) -> Channel {
    Channel::ieee802154(number).unwrap()
}

fn tune(medium: &mut SimpleMedium, second: u64, radio: u32, number: u8) {
    let command = Command::Tune(channel(number));
    medium
        .command(secs(second), RadioId(radio), command)
        .unwrap();
}

/// All ways of working a round.
fn ways(config: &SimpleConfig) -> Vec<SimpleConfig> {
    let all = [
        (1, 0.0),
        (1000, 0.0),
        (1, f64::INFINITY),
        (1000, f64::INFINITY),
    ];
    let way = |(by_receiver_from, grid_below)| SimpleConfig {
        by_receiver_from,
        grid_below,
        ..config.clone()
    };
    all.into_iter().map(way).collect()
}

/// Bees 0 to 2 on channel 11, a listener on 11, one on 12, and somebody 10 km away.
fn three_and_listeners() -> (Vec<RadioSpec>, Still) {
    let channels = [11, 11, 11, 11, 12, 11];
    let specs = channels.iter().enumerate().map(|(i, &number)| RadioSpec {
        channel: channel(number),
        ..bee(i)
    });
    let places = [0.0, 2.0, 4.0, 6.0, 8.0, 1e4].map(|x| [x, 0.0, 0.0]);
    (specs.collect(), Still::at(places))
}

#[test]
fn who_tunes_and_sends_sends_on_the_new_channel_in_whatever_order_bees_come() {
    for (order, far_first, config) in cases() {
        let (specs, poses) = three_and_listeners();
        let mut m = medium(config, specs);
        if far_first {
            m.submit(secs(1), broadcast(5, b"far"));
        }
        for radio in order {
            m.submit(secs(1), broadcast(radio, b"old"));
            tune(&mut m, 1, radio, 12);
            m.submit(secs(1), broadcast(radio, b"new"));
        }
        let mut heard = round(&mut m, secs(1), &poses);
        heard.sort_unstable();
        // Each new frame at the two others and at the listener of 12; the old ones at that of 11 alone.
        let mut expected = Vec::new();
        for sender in 0..3 {
            expected.push((3, sender, Some(b'o')));
            let listeners = [0, 1, 2, 4].into_iter().filter(|radio| *radio != sender);
            expected.extend(listeners.map(|radio| (radio, sender, Some(b'n'))));
        }
        expected.sort_unstable();
        let heard: Vec<_> = heard
            .iter()
            .map(|&(rx, tx, first, _)| (rx, tx, first))
            .collect();
        assert_eq!(heard, expected, "{order:?}, far first: {far_first}");

        let mut begun = Vec::new();
        m.begun(&mut |frame, on| {
            if frame.radio().0 < 3 {
                begun.push((frame.payload()[0], on.centre.get()));
            }
        });
        begun.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let [old, new] = [11, 12].map(|number| channel(number).centre.get());
        assert_eq!(begun, [[(b'n', new); 3], [(b'o', old); 3]].concat());
        for radio in (0..3).map(RadioId) {
            let counters = m.counters(radio);
            assert_eq!(
                (counters.sent, counters.received, counters.missed()),
                (2, 2, 0)
            );
        }
        // In the next round nobody is left where he sent before.
        m.submit(secs(2), broadcast(3, b"still on 11"));
        assert_eq!(pairs(&round(&mut m, secs(2), &poses)), []);
        m.submit(secs(3), broadcast(1, b"on 12"));
        assert_eq!(
            pairs(&round(&mut m, secs(3), &poses)),
            [(0, 1), (2, 1), (4, 1)]
        );
    }
}

fn cases() -> impl Iterator<Item = ([u32; 3], bool, SimpleConfig)> {
    ORDERS.into_iter().flat_map(|order| {
        let both = [false, true].into_iter();
        both.flat_map(move |far| ways(&quiet()).into_iter().map(move |way| (order, far, way)))
    })
}

#[test]
fn who_tunes_hears_all_of_the_new_channel_from_that_instant_on_and_nothing_of_the_old_one() {
    // Deeds: bee 0 tunes from 11 to 12; bee 1 speaks on 11; the listener of 12 speaks there.
    for (order, far_first, config) in cases() {
        let (specs, poses) = three_and_listeners();
        let mut m = medium(config, specs);
        if far_first {
            m.submit(secs(1), broadcast(5, b"far"));
        }
        for deed in order {
            match deed {
                0 => tune(&mut m, 1, 0, 12),
                1 => m.submit(secs(1), broadcast(1, b"on 11")),
                _ => m.submit(secs(1), broadcast(4, b"on 12")),
            }
        }
        let mut heard = pairs(&round(&mut m, secs(1), &poses));
        heard.sort_unstable();
        assert_eq!(
            heard,
            [(0, 4), (2, 1), (3, 1)],
            "{order:?}, far first: {far_first}"
        );
        let counters = m.counters(RadioId(0));
        assert_eq!((counters.received, counters.missed()), (1, 0));
    }
}

#[test]
fn who_tunes_there_and_back_has_heard_all_and_sent_there() {
    for config in ways(&quiet()) {
        let (specs, poses) = three_and_listeners();
        let mut m = medium(config, specs);
        m.submit(secs(1), broadcast(1, b"on 11"));
        tune(&mut m, 1, 0, 12);
        m.submit(secs(1), broadcast(0, b"on 12"));
        tune(&mut m, 1, 0, 13);
        m.submit(secs(1), broadcast(0, b"on 13"));
        tune(&mut m, 1, 0, 11);
        m.submit(secs(1), broadcast(0, b"on 11"));
        let mut heard = pairs(&round(&mut m, secs(1), &poses));
        heard.sort_unstable();
        assert_eq!(
            heard,
            [(0, 1), (1, 0), (2, 0), (2, 1), (3, 0), (3, 1), (4, 0)]
        );
        let counters = m.counters(RadioId(0));
        assert_eq!(
            (counters.sent, counters.received, counters.missed()),
            (3, 1, 0)
        );
    }
}

#[test]
fn a_frame_is_as_strong_if_its_sender_leaves_as_if_it_stays() {
    // With a direction, off centre, through a wall.
    let patch = RadioSpec {
        antenna: Arc::new(Patch::default()),
        mount: Mount::new(
            Offset::from_xyz(0.1, 0.2, -0.1),
            Attitude::from_yaw(Yaw::si(0.5)),
        ),
        ..bee(0)
    };
    let walls = SimpleConfig {
        walls: true,
        ..quiet()
    };
    for config in ways(&walls) {
        let heard = [false, true].map(|leaves| {
            let mut m = medium(config.clone(), [patch.clone(), bee(1), bee(2)]);
            let poses = Still::at([[0.0, 1.0, 0.0], [5.0, 3.0, 1.0], [5.0, -3.0, 2.0]]);
            m.submit(secs(1), broadcast(0, b"x"));
            if leaves {
                tune(&mut m, 1, 0, 20);
            }
            round(&mut m, secs(1), &poses)
        });
        assert_eq!(heard[0].len(), 2);
        assert_eq!(heard[0], heard[1]);
    }
}

/// What a bee does at an instant, by its own script.
#[derive(Clone, Copy)]
enum Deed {
    Send,
    Tune(u8),
    Sleep,
    Wake,
}

/// Receptions of each round, by (receiver, sender, payload, power), and all counters.
type Seen = (Vec<Vec<(u32, u32, Option<u8>, u64)>>, Vec<Counters>);

/// A swarm that hops: scripts of each second and bee, done bee by bee in an order of `shuffle`, with a
/// crowd far away that speaks and hops first.
fn hop(config: &SimpleConfig, scripts: &[Vec<Vec<Deed>>], shuffle: u64, far: u32) -> Seen {
    let bees = scripts[0].len() as u32;
    let mut rng = Stream::new(9, "places", "test");
    let near = (0..bees).map(|_| rng.in_ball(10.0));
    let places: Vec<DVec3> = near.chain((0..far).map(|_| DVec3::X * 1e4)).collect();
    let poses = Still::at(places);
    let mut m = medium(config.clone(), (0..(bees + far) as usize).map(bee));
    let mut rounds = Vec::new();
    let mut stream = Stream::new(shuffle, "order", "test");
    for (second, script) in (1..).zip(scripts) {
        for radio in bees..bees + far {
            m.submit(secs(second), broadcast(radio, b"far"));
            tune(&mut m, second, radio, 11 + (second % 3) as u8);
        }
        let mut order: Vec<u32> = (0..bees).collect();
        stream.shuffle(&mut order);
        for radio in order {
            for (at, deed) in (0..).zip(&script[radio as usize]) {
                match *deed {
                    Deed::Send => m.submit(secs(second), broadcast(radio, &[at])),
                    Deed::Tune(number) => tune(&mut m, second, radio, number),
                    Deed::Sleep => m
                        .command(secs(second), RadioId(radio), Command::Sleep)
                        .unwrap(),
                    Deed::Wake => m
                        .command(secs(second), RadioId(radio), Command::Wake)
                        .unwrap(),
                }
            }
        }
        let mut heard = round(&mut m, secs(second), &poses);
        heard.retain(|(receiver, ..)| *receiver < bees);
        heard.sort_unstable();
        rounds.push(heard);
    }
    let counters = (0..bees).map(|radio| m.counters(RadioId(radio))).collect();
    (rounds, counters)
}

fn scripts(bees: usize, seconds: usize) -> Vec<Vec<Vec<Deed>>> {
    let mut rng = Stream::new(4, "scripts", "test");
    let mut script = || {
        let count = rng.below(5);
        let deed = |_| match rng.below(10) {
            0..5 => Deed::Send,
            5..8 => Deed::Tune(11 + rng.below(3) as u8),
            8 => Deed::Sleep,
            _ => Deed::Wake,
        };
        (0..count).map(deed).collect::<Vec<_>>()
    };
    let mut all = || (0..bees).map(|_| script()).collect::<Vec<_>>();
    (0..seconds).map(|_| all()).collect()
}

#[test]
fn a_swarm_that_hops_hears_what_the_rule_says() {
    let scripts = scripts(14, 25);
    // By hand: where each frame goes out, and who is there at the end of the commit.
    let (mut channels, mut awake) = ([11u8; 14], [true; 14]);
    let mut expected = Vec::new();
    let mut sent = 0;
    for script in &scripts {
        let mut frames = Vec::new();
        for (bee, deeds) in script.iter().enumerate() {
            for (at, deed) in (0u8..).zip(deeds) {
                match *deed {
                    Deed::Send if awake[bee] => frames.push((bee, at, channels[bee])),
                    Deed::Send => {}
                    Deed::Tune(number) => channels[bee] = number,
                    Deed::Sleep => awake[bee] = false,
                    Deed::Wake => awake[bee] = true,
                }
            }
        }
        sent += frames.len();
        let mut heard = Vec::new();
        for (sender, at, on) in frames {
            let there = (0..14).filter(|&bee| awake[bee] && channels[bee] == on && bee != sender);
            heard.extend(there.map(|bee| (bee as u32, sender as u32, Some(at))));
        }
        heard.sort_unstable();
        expected.push(heard);
    }
    assert!(sent > 200 && expected.iter().flatten().count() > 500);
    for config in ways(&quiet()) {
        let (rounds, counters) = hop(&config, &scripts, 1, 0);
        for (heard, expected) in rounds.iter().zip(&expected) {
            let heard: Vec<_> = heard.iter().map(|&(rx, tx, at, _)| (rx, tx, at)).collect();
            assert_eq!(&heard, expected);
        }
        for (bee, counters) in (0..).zip(counters) {
            let received = expected
                .iter()
                .flatten()
                .filter(|(rx, ..)| *rx == bee)
                .count();
            assert_eq!(counters.received, received as u64);
            assert_eq!(counters.missed(), counters.lost(Loss::Asleep));
        }
    }
}

#[test]
fn neither_the_order_of_bees_nor_who_is_far_matters_to_a_swarm_that_hops() {
    // Noise, and a range that cuts: chance and all books too.
    let scripts = scripts(14, 25);
    let config = SimpleConfig {
        seed: 8,
        ..config()
    };
    let alone = hop(&config, &scripts, 1, 0);
    for config in ways(&config) {
        for shuffle in 2..6 {
            assert_eq!(hop(&config, &scripts, shuffle, 0), alone);
        }
        let (rounds, counters) = hop(&config, &scripts, 3, 30);
        assert_eq!(rounds, alone.0);
        // Those far away are counted as out of range, or slept through, and change nothing else.
        for (with, alone) in counters.iter().zip(&alone.1) {
            assert_eq!((with.sent, with.received), (alone.sent, alone.received));
            for loss in [Loss::BelowSensitivity, Loss::Noise, Loss::SenderAsleep] {
                assert_eq!(with.lost(loss), alone.lost(loss));
            }
        }
    }
}
