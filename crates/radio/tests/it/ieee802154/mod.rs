//! Packets with air time, medium access and interference, against ns-3 and against closed forms.

mod exchange;
mod invariance;
mod modulations;
mod ns3_tables;
mod states;

use crate::support::Still;
use simbeeotic_kernel::rng::path_key;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_radio::{
    Access, Counters, Ieee802154Config, Ieee802154Medium, LogDistance, Loss, Medium, Outcome, Phy,
    RadioId, RadioSpec, RadioState, Request, Scratch, Ticket, cc2420,
};
use simbeeotic_units::Time;
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

/// Sends at once, so that tests say when frames begin.
fn at_once(bee: usize, phy: Phy) -> RadioSpec {
    let phy = Phy {
        access: Access::Aloha,
        turnaround: Time::ZERO,
        ..phy
    };
    RadioSpec { phy, ..node(bee) }
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
