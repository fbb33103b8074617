//! Packets with air time, medium access and interference, against ns-3 and against closed forms.

use crate::support::{Still, secs};

use simbeeotic_kernel::rng::path_key;
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
        propagation: Arc::new(LogDistance {
            reference_loss: Some(Decibels::from_db(46.6777)),
            ..LogDistance::default()
        }),
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
        let mut owners = Vec::new();
        self.medium.open(now, &self.poses, &mut owners);
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
