//! Two ways to the same answer: frame by frame, receiver by receiver; and what must not matter.

use crate::support::{self, Still, broadcast, medium, pairs, round, secs};
use proptest::prelude::*;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_kernel::{ModelId, SimTime, Stream};
use simbeeotic_radio::{
    Antenna, Channel, Command, Delivery, DeliveryCurve, ErrorModel, GilbertElliott, Isotropic,
    Medium, Poses, RadioId, RadioSpec, Request, Scratch, SimpleConfig, SimpleMedium, cc2420,
};
use simbeeotic_units::glam::DVec3;
use simbeeotic_units::math::pow;
use simbeeotic_units::{
    Angle, Attitude, Decibels, Length, Mount, Offset, Pose, Position, PowerLevel, Time, Yaw,
};
use std::sync::Arc;

/// Looks forward: 6 dB there, -6 dB behind.
#[derive(Debug)]
struct Patch;

impl Antenna for Patch {
    fn gain(&self, direction: DVec3) -> Decibels {
        Decibels::from_db(6.0 * direction.x)
    }
}

/// Long frames die sooner.
#[derive(Debug)]
struct ByLength;

impl ErrorModel for ByLength {
    fn packet_success(&self, snr: Decibels, frame_bytes: usize) -> f64 {
        let good = 1.0 - 1.0 / (1.0 + snr.ratio());
        pow(good, frame_bytes as f64)
    }
}

/// By noise, by distance, by distance and state.
fn delivery(kind: usize) -> Delivery {
    let metres = Length::from_metres;
    let falling = DeliveryCurve::new(&[(metres(5.0), 1.0), (metres(28.0), 0.1)]).unwrap();
    match kind {
        0 => Delivery::Noise,
        1 => Delivery::Chance(falling),
        _ => Delivery::Switching(GilbertElliott {
            good_for: Time::from_secs(2.0),
            bad_for: Time::from_secs(1.0),
            good: falling,
            bad: DeliveryCurve::level(0.05).unwrap(),
            symmetric: false,
        }),
    }
}

/// Platforms that are elsewhere at each instant.
struct Moving {
    still: Still,
    /// Whether it is known how far they may have come.
    counted: bool,
    odometer_m: f64,
}

impl Poses for Moving {
    fn pose(&self, owner: ModelId) -> Pose {
        self.still.pose(owner)
    }

    fn odometer(&self) -> Option<Length> {
        self.counted.then(|| Length::from_metres(self.odometer_m))
    }
}

/// Noise with less scatter, whose tables are sooner made.
fn config() -> SimpleConfig {
    SimpleConfig {
        noise_sigma: Decibels::from_db(2.0),
        ..support::config()
    }
}

/// A random population with every feature that a pair can have.
fn population(seed: u64, n: usize) -> (Vec<RadioSpec>, Still) {
    let mut rng = Stream::new(seed, "population", "test");
    let errors: [Arc<dyn ErrorModel>; 2] =
        [cc2420::spec(11, 31).unwrap().error, Arc::new(ByLength)];
    let mut poses = Vec::new();
    let specs = (0..n).map(|i| {
        let p = rng.in_ball(40.0);
        let yaw = Yaw::new(Angle::from_radians(rng.uniform_in(-3.0..3.0)));
        poses.push(Pose::new(Position::from_si(p), Attitude::from_yaw(yaw)));
        let offset = if rng.bernoulli(0.3) {
            Offset::from_xyz(0.1, 0.0, -0.2)
        } else {
            Offset::ZERO
        };
        let gain = Decibels::from_db(rng.uniform_in(-3.0..3.0));
        let antenna: Arc<dyn Antenna> = if rng.bernoulli(0.3) {
            Arc::new(Patch)
        } else {
            Arc::new(Isotropic { gain })
        };
        RadioSpec {
            owner: ModelId(i as u32),
            key: path_key(&format!("bee-{i}/radio")),
            error: Arc::clone(&errors[rng.below(2) as usize]),
            sensitivity: PowerLevel::from_dbm(rng.uniform_in(-95.0..-65.0)),
            antenna,
            mount: Mount::new(offset, Attitude::IDENTITY),
            ..cc2420::spec(11 + rng.below(2) as u8, 3 + rng.below(29) as u8).unwrap()
        }
    });
    let specs = specs.collect();
    (specs, Still(poses))
}

/// The same few rounds on a medium: sends, sleeps, wakes, tunes. Everything that can be seen.
fn play(mut m: SimpleMedium, poses: &Still, seed: u64, sends: usize) -> String {
    let mut rng = Stream::new(seed, "play", "test");
    let n = m.radios() as u64;
    let mut seen = String::new();
    for second in 1..=4 {
        for _ in 0..sends {
            let destination = rng.bernoulli(0.2).then(|| ModelId(rng.below(n) as u32));
            let payload = vec![rng.below(256) as u8; 1 + rng.below(5) as usize];
            let radio = rng.below(n) as u32;
            m.submit(
                secs(second),
                Request {
                    destination,
                    ..broadcast(radio, &payload)
                },
            );
        }
        seen += &format!("{:?}\n", round(&mut m, secs(second), poses));
        for _ in 0..n / 5 {
            let command = match rng.below(3) {
                0 => Command::Sleep,
                1 => Command::Wake,
                _ => Command::Tune(Channel::ieee802154(11 + rng.below(2) as u8).unwrap()),
            };
            m.command(secs(second), RadioId(rng.below(n) as u32), command)
                .unwrap();
        }
    }
    for radio in (0..n as u32).map(RadioId) {
        seen += &format!("{:?} {:?}\n", m.counters(radio), m.usage(radio, secs(9)));
    }
    seen
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn by_frame_and_by_receiver_agree_to_the_bit_with_a_grid_and_without(
        seed: u64, n in 2..90usize, sends in 1..300usize, walls: bool, kind in 0..3usize,
    ) {
        let (specs, poses) = population(seed, n);
        let delivery = delivery(kind);
        let way = |by_receiver_from, grid_below| {
            let delivery = delivery.clone();
            let config =
                SimpleConfig { seed, by_receiver_from, grid_below, walls, delivery, ..config() };
            play(medium(config, specs.clone()), &poses, seed, sends)
        };
        let plain = way(1, 0.0);
        prop_assert_eq!(&way(usize::MAX, 0.0), &plain);
        prop_assert_eq!(&way(1, f64::INFINITY), &plain);
        prop_assert_eq!(&way(usize::MAX, f64::INFINITY), &plain);
    }

    #[test]
    fn a_grid_of_an_earlier_instant_misses_nobody(
        seed: u64, n in 2..150usize, counted: bool, step_m in 0.0..30.0f64, range_m in 1.0..60.0f64,
    ) {
        let (specs, poses) = population(seed, n);
        let way = |grid_below| {
            let range_limit = Length::from_metres(range_m);
            let config = SimpleConfig { seed, range_limit, grid_below, ..config() };
            let mut rng = Stream::new(seed, "way", "test");
            let mut poses = Moving { still: Still(poses.0.clone()), counted, odometer_m: 0.0 };
            let mut m = medium(config, specs.clone());
            let mut seen = Vec::new();
            for instant in 0..60 {
                // Some stand, some drift, one is put far away.
                let jump = rng.below(n as u64) as usize;
                let mut most: f64 = 0.0;
                for (bee, pose) in poses.still.0.iter_mut().enumerate() {
                    let far = if bee == jump && instant % 10 == 9 { 500.0 } else { step_m };
                    let step = far * rng.uniform() * rng.in_ball(1.0);
                    pose.position = Position::from_si(pose.position.si() + step);
                    let turn = Yaw::new(Angle::from_radians(rng.uniform_in(-3.0..3.0)));
                    pose.attitude = Attitude::from_yaw(turn);
                    most = most.max(step.length());
                }
                poses.odometer_m += most * (1.0 + 1e-12);
                let now = SimTime::from_millis(7 * instant as u64);
                let frames = if rng.bernoulli(0.1) { 20 } else { 1 };
                for _ in 0..frames {
                    m.submit(now, broadcast(rng.below(n as u64) as u32, b"x"));
                }
                seen.push(round(&mut m, now, &poses));
                if rng.bernoulli(0.2) {
                    let command = if rng.bernoulli(0.5) { Command::Sleep } else { Command::Wake };
                    m.command(now, RadioId(rng.below(n as u64) as u32), command).unwrap();
                }
            }
            let counters: Vec<_> = (0..n as u32).map(|radio| m.counters(RadioId(radio))).collect();
            (seen, counters)
        };
        prop_assert_eq!(way(f64::INFINITY), way(0.0));
    }

    #[test]
    fn the_order_of_adding_does_not_matter(seed: u64, n in 2..60usize, sends in 1..80usize) {
        let (specs, poses) = population(seed, n);
        let mut order: Vec<usize> = (0..n).collect();
        Stream::new(seed, "order", "test").shuffle(&mut order);
        let heard = |order: &[usize]| {
            let mut m = medium(SimpleConfig { seed, ..config() }, order.iter().map(|&i| specs[i].clone()));
            let radio = |i| order.iter().position(|&j| j == i).unwrap() as u32;
            (0..sends).for_each(|k| m.submit(secs(1), broadcast(radio(k % n), &[k as u8])));
            let heard = round(&mut m, secs(1), &poses);
            // Receivers by platform instead of by number.
            let by_owner = heard.iter().map(|&(rx, tx, first, power)| (order[rx as usize], tx, first, power));
            let mut by_owner: Vec<_> = by_owner.collect();
            by_owner.sort_unstable();
            by_owner
        };
        let sorted: Vec<usize> = (0..n).collect();
        prop_assert_eq!(heard(&order), heard(&sorted));
    }
}

/// A swarm around the origin, and `more` radios that stand somewhere else.
fn swarm_with(more: usize, at: DVec3, sends: usize) -> Vec<(u32, u32)> {
    let mut rng = Stream::new(3, "swarm", "test");
    let places: Vec<DVec3> = (0..50)
        .map(|_| rng.in_ball(20.0))
        .chain((0..more).map(|_| at))
        .collect();
    let mut m = medium(support::config(), (0..50 + more).map(support::bee));
    for k in 0..sends {
        m.submit(secs(1), broadcast((k % 50) as u32, b"x"));
    }
    (50..50 + more).for_each(|radio| m.submit(secs(1), broadcast(radio as u32, b"far")));
    pairs(&round(&mut m, secs(1), &Still::at(places)))
}

#[test]
fn parts_of_a_swarm_that_share_buckets_of_the_grid_are_kept_apart() {
    let mut rng = Stream::new(5, "parts", "test");
    // Neighbours in number are neighbours of nobody: four parts, whole numbers of cubes away.
    let place = |i: u32| rng.in_ball(25.0) + DVec3::new(15_360.0, 30_720.0, 0.0) * f64::from(i % 4);
    let places: Vec<DVec3> = (0..400).map(place).collect();
    let heard = |grid_below| {
        let config = SimpleConfig {
            grid_below,
            by_receiver_from: 1,
            ..config()
        };
        let mut m = medium(config, (0..400).map(support::bee));
        (0..400).for_each(|radio| m.submit(secs(1), broadcast(radio, b"x")));
        pairs(&round(&mut m, secs(1), &Still::at(places.clone())))
    };
    let plain = heard(0.0);
    assert!(plain.len() > 4 * 100 * 20, "{}", plain.len());
    assert_eq!(heard(f64::INFINITY), plain);
}

#[test]
fn radios_out_of_reach_change_nothing() {
    // 15: one more frame turns a round by frame into a round by receiver.
    for sends in [1, 14, 15, 16, 50] {
        let alone = swarm_with(0, DVec3::ZERO, sends);
        assert!(alone.len() > 10);
        assert_eq!(
            swarm_with(1, DVec3::X * 1e4, sends),
            alone,
            "{sends} frames"
        );
        let crowd = swarm_with(100, DVec3::X * 1e4, sends);
        let near: Vec<_> = crowd.into_iter().filter(|&(rx, _)| rx < 50).collect();
        assert_eq!(near, alone, "{sends} frames and 100 far away");
    }
}

#[test]
fn another_seed_is_another_world() {
    let run = |seed| {
        let (specs, poses) = population(1, 40);
        let m = medium(SimpleConfig { seed, ..config() }, specs);
        play(m, &poses, 1, 40)
    };
    assert_eq!(run(1), run(1));
    assert_ne!(run(1), run(2));
}

#[test]
fn threads_do_not_matter() {
    let (specs, poses) = population(8, 60);
    let inboxes = |threads: usize| {
        let mut m = medium(config(), specs.clone());
        (0..200).for_each(|k| m.submit(secs(1), broadcast(k % 60, &[k as u8])));
        m.open(secs(1), &poses, &mut Vec::new());
        let collect = |first: usize| {
            let mut scratch = Scratch::new();
            let mine = (0..60).skip(first).step_by(threads);
            let digest = |radio| {
                (
                    radio,
                    m.collect(RadioId(radio), &poses, &mut scratch).digest(),
                )
            };
            mine.map(digest).collect::<Vec<_>>()
        };
        let mut digests: Vec<(u32, u64)> = std::thread::scope(|scope| {
            let collect = &collect;
            let spawn = |first| scope.spawn(move || collect(first));
            let running: Vec<_> = (0..threads).map(spawn).collect();
            running
                .into_iter()
                .flat_map(|thread| thread.join().unwrap())
                .collect()
        });
        digests.sort_unstable();
        (digests, m.totals())
    };
    let alone = inboxes(1);
    assert!(alone.1.received > 100);
    assert_eq!(inboxes(3), alone);
    assert_eq!(inboxes(8), alone);
}

#[test]
fn directed_antennas_turn_with_their_platform() {
    let facing = |yaw_deg: f64| {
        let yaw = Yaw::new(Angle::from_degrees(yaw_deg));
        let at = |east_m, yaw| {
            Pose::new(
                Position::from_xyz(east_m, 0.0, 0.0),
                Attitude::from_yaw(yaw),
            )
        };
        let poses = Still(vec![at(0.0, yaw), at(10.0, Yaw::new(Angle::ZERO))]);
        let patch = RadioSpec {
            antenna: Arc::new(Patch),
            ..support::bee(0)
        };
        let mut m = medium(support::quiet(), [patch, support::bee(1)]);
        m.submit(secs(1), broadcast(0, b"x"));
        f64::from_bits(round(&mut m, secs(1), &poses)[0].3)
    };
    for (yaw_deg, gain_db) in [(0.0, 6.0), (90.0, 0.0), (180.0, -6.0), (60.0, 3.0)] {
        assert!(
            (facing(yaw_deg) - (-60.070_085 + gain_db)).abs() < 1e-4,
            "{yaw_deg} degrees"
        );
    }
}
