//! Packets with air time, medium access and interference, against ns-3 and against closed forms.

use crate::support::{Still, secs};

use simbeeotic_kernel::rng::{Stream, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Access, Arithmetic, BitErrors, Command, Counters, Ieee802154Config, Ieee802154Medium,
    LogDistance, Loss, Medium, OqpskDsss, Outcome, Phy, RadioId, RadioSpec, RadioState, Request,
    Scratch, Ticket, cc2420,
};
use simbeeotic_units::{Decibels, Length, PowerLevel, Time};
use std::sync::Arc;

/// ns-3's log-distance loss: exponent 3, 46.6777 dB at 1 m.
pub(crate) fn ns3_config(seed: u64) -> Ieee802154Config {
    Ieee802154Config {
        seed,
        propagation: Arc::new(LogDistance::ns3()),
        ..Ieee802154Config::ns3()
    }
}

/// Node `node` as ns-3 has it: 0 dBm on channel 11, 17 bytes of headers.
fn node(node: usize) -> RadioSpec {
    RadioSpec {
        owner: ModelId(node as u32),
        key: path_key(&format!("node-{node}/radio")),
        ..cc2420::spec(11, 31).unwrap()
    }
}

/// One packet handed over.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Got {
    receiver: u32,
    sender: u32,
    sent_ns: u64,
    time_ns: u64,
    rssi_dbm: f64,
    snr_db: f64,
    lqi: u8,
}

/// A medium, where its radios are, and all that came out of it.
struct Trial {
    medium: Ieee802154Medium,
    poses: Still,
    got: Vec<Got>,
    outcomes: Vec<(u32, Outcome)>,
    rounds: usize,
    now: SimTime,
    begun: Vec<(u32, u64)>,
    scratch: Scratch,
}

impl Trial {
    fn new(config: Ieee802154Config, specs: Vec<RadioSpec>, places: Vec<[f64; 3]>) -> Self {
        let mut medium = Ieee802154Medium::new(config).unwrap();
        for spec in specs {
            medium.add(spec).unwrap();
        }
        Self {
            medium,
            poses: Still::at(places),
            got: Vec::new(),
            outcomes: Vec::new(),
            rounds: 0,
            now: SimTime::ZERO,
            begun: Vec::new(),
            scratch: Scratch::new(),
        }
    }

    /// CC2420s on a line, at these distances from the first.
    fn line(config: Ieee802154Config, east_m: &[f64]) -> Self {
        let places = east_m.iter().map(|&x| [x, 0.0, 0.0]).collect();
        Self::new(config, (0..east_m.len()).map(node).collect(), places)
    }

    fn open(&mut self, now: SimTime) {
        self.rounds += 1;
        self.now = now;
        let mut owners = Vec::new();
        self.medium.open(now, &self.poses, &mut owners);
        let begun = &mut self.begun;
        self.medium
            .begun(&mut |frame, _| begun.push((frame.radio().0, frame.sent().nanos())));
        let mut with_mail = Vec::new();
        for radio in 0..self.medium.radios() as u32 {
            let owner = self.medium.spec(RadioId(radio)).owner;
            let inbox = self
                .medium
                .collect(RadioId(radio), &self.poses, &mut self.scratch);
            if !inbox.is_empty() || !inbox.outcomes().is_empty() {
                with_mail.push(owner);
            }
            for packet in inbox {
                self.got.push(Got {
                    receiver: radio,
                    sender: packet.sender().0,
                    sent_ns: packet.frame().sent().nanos(),
                    time_ns: packet.time().nanos(),
                    rssi_dbm: packet.rssi().dbm(),
                    snr_db: packet.snr().db(),
                    lqi: packet.lqi(),
                });
            }
            let outcomes = inbox.outcomes().iter();
            self.outcomes.extend(outcomes.map(|&o| (radio, o)));
        }
        with_mail.sort_unstable();
        with_mail.dedup();
        assert_eq!(owners, with_mail, "those listed are those with mail");
    }

    /// Does all rounds up to and at `until`.
    fn run(&mut self, until: SimTime) {
        while let Some(next) = self.medium.next_time().filter(|&next| next <= until) {
            self.open(next);
        }
        self.open(until);
    }

    fn submit(&mut self, at: SimTime, request: Request) {
        self.run(at);
        self.medium.submit(at, request);
    }

    fn broadcast(&mut self, at: SimTime, radio: u32, bytes: usize) {
        self.submit(
            at,
            Request::broadcast(RadioId(radio), vec![0; bytes].into()),
        );
    }

    /// When the first frame of a radio began, us.
    fn begun_us(&self, radio: u32) -> u64 {
        let mut mine = self.begun.iter().filter(|b| b.0 == radio);
        mine.next().map_or(0, |b| b.1 / 1000)
    }

    fn counters(&self, radio: u32) -> Counters {
        self.medium.counters(RadioId(radio))
    }
}

fn micros(micros: u64) -> SimTime {
    SimTime::from_nanos(micros * 1000)
}

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
    for row in table(include_str!("../ns3/errmodel.csv")) {
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
        let text = include_str!("../ns3/access.csv");
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
    for row in table(include_str!("../ns3/prr_distance.csv")) {
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

/// Sends at once, so that tests say when frames begin.
fn at_once(bee: usize, phy: Phy) -> RadioSpec {
    let phy = Phy {
        access: Access::Aloha,
        turnaround: Time::ZERO,
        ..phy
    };
    RadioSpec { phy, ..node(bee) }
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

/// To somebody in particular, with a ticket.
fn unicast(from: u32, to: u32, bytes: usize, ticket: u32) -> Request {
    Request {
        destination: Some(ModelId(to)),
        ticket: Some(Ticket(ticket)),
        ..Request::broadcast(RadioId(from), vec![0; bytes].into())
    }
}

fn results(trial: &Trial) -> Vec<(u32, u32, Result<(), Loss>)> {
    let outcomes = trial.outcomes.iter();
    outcomes.map(|(r, o)| (*r, o.ticket.0, o.result)).collect()
}

/// Any radio's times by state sum to the time that has passed.
fn assert_time_is_whole(trial: &Trial, until: SimTime) {
    for radio in 0..trial.medium.radios() as u32 {
        let usage = trial.medium.usage(RadioId(radio), until);
        let sum: f64 = RadioState::ALL.iter().map(|&s| usage.time(s).secs()).sum();
        assert!((sum - until.as_secs_f64()).abs() < 1e-9, "{radio}: {sum} s");
    }
}

fn state_us(trial: &Trial, radio: u32, state: RadioState, until: SimTime) -> f64 {
    let usage = trial.medium.usage(RadioId(radio), until);
    (usage.time(state).secs() * 1e9).round() / 1e3
}

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
