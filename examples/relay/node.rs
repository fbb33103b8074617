//! One station of the chain: whom it hears, where it is among them, and how packets go on.

use super::trail::Trail;
use super::wire::{Hello, Message, Report};
use simbeeotic::models::net::{Beacons, BeaconsParams, Heard};
use simbeeotic::prelude::*;
use std::collections::{BTreeMap, VecDeque};

/// Crumbs told in one hello.
const CRUMBS: usize = 12;
/// A neighbour that did not acknowledge is left alone for so long, s.
const SHUN_S: f64 = 1.0;
/// Reports that wait for a way, at most.
const WAITING: usize = 120;
/// Reports remembered, not to be sent on twice.
const SEEN: usize = 64;

/// How the stations of a chain find each other: a quarter of a second between beacons, and two seconds
/// until one that is silent is forgotten.
pub(super) fn beacons() -> BeaconsParams {
    BeaconsParams {
        period: Time::from_millis(250.0),
        window: 8,
        expiry: 8,
        listed: 10,
        ..BeaconsParams::default()
    }
}

/// What a neighbour says of itself.
struct Peer {
    s_m: Option<f64>,
    cost: Option<f64>,
    torn: bool,
    known: u8,
    shunned: SimTime,
}

/// The next one on the trail, on one side.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    pub(super) s_m: f64,
    /// How strong it is.
    pub(super) rssi_dbm: f64,
    /// When it was heard last.
    pub(super) heard: SimTime,
    /// Whether it says that the chain is torn ahead of it.
    pub(super) torn: bool,
}

/// A station.
pub(super) struct Node {
    radio: RadioHandle,
    beacons: Beacons,
    peers: BTreeMap<ModelId, Peer>,
    pub(super) trail: Trail,
    /// Its place on the trail, m; `None` until it has one.
    pub(super) s_m: Option<f64>,
    is_base: bool,
    /// Whether the chain is torn ahead of it: nobody is heard there, or not by those who are.
    pub(super) torn: bool,
    /// Whom the last report came from: there words go.
    back: Option<ModelId>,
    waiting: VecDeque<Report>,
    under_way: BTreeMap<Ticket, (ModelId, Report)>,
    seen: VecDeque<u16>,
}

impl Node {
    pub(super) fn new(
        radio: RadioHandle,
        beacons: BeaconsParams,
        rng: Stream,
    ) -> Result<Self, BuildError> {
        Ok(Self {
            radio,
            beacons: Beacons::new(beacons, rng)?,
            peers: BTreeMap::new(),
            trail: Trail::default(),
            s_m: None,
            is_base: false,
            torn: false,
            back: None,
            waiting: VecDeque::new(),
            under_way: BTreeMap::new(),
            seen: VecDeque::new(),
        })
    }

    /// The one at the beginning of the trail, to which all reports go.
    pub(super) fn base(self) -> Self {
        Self {
            is_base: true,
            s_m: Some(0.0),
            ..self
        }
    }

    /// When to beat first.
    pub(super) fn first(&mut self) -> Time {
        self.beacons.first()
    }

    /// Tells the neighbours what they should know, and sends what has waited. When to do so again.
    pub(super) fn beat(&mut self, platform: &mut Platform<'_>) -> Time {
        let beacon = self.beacons.beacon(platform.now());
        let Self { beacons, peers, .. } = self;
        peers.retain(|id, _| beacons.neighbor(*id).is_some());
        platform.send(self.radio, &beacon);
        let known = self.trail.known();
        let first = self
            .peers
            .values()
            .map(|peer| peer.known)
            .fold(known, u8::min);
        let hello = Message::Hello(Hello {
            s_m: self.s_m,
            cost: self.cost(platform.now()),
            torn: self.torn,
            known,
            first,
            crumbs: self.trail.some(first, CRUMBS).to_vec(),
        });
        platform.send(self.radio, &hello.encode());
        for _ in 0..self.waiting.len() {
            if let Some(report) = self.waiting.pop_front() {
                self.forward(report, platform);
            }
        }
        self.beacons.pause()
    }

    /// Takes in a packet. A report that has come to the base and a word are for the caller; all else is
    /// done with.
    pub(super) fn hear(
        &mut self,
        packet: &Packet<'_>,
        platform: &mut Platform<'_>,
    ) -> Option<Message> {
        if self.beacons.hear(platform.id(), Heard::from(packet)) {
            return None;
        }
        match Message::decode(packet.payload())? {
            Message::Hello(hello) => self.note(packet.sender(), &hello),
            Message::Report(report) => {
                self.back = Some(packet.sender());
                if self.is_base {
                    return Some(Message::Report(report));
                }
                if !self.seen.contains(&report.number) {
                    self.seen.push_back(report.number);
                    if self.seen.len() > SEEN {
                        self.seen.pop_front();
                    }
                    self.forward(report, platform);
                }
            }
            word @ Message::Word(_) => return Some(word),
        }
        None
    }

    /// Sends a report on towards the base; it waits if there is no way.
    pub(super) fn forward(&mut self, report: Report, platform: &mut Platform<'_>) {
        if let Some((parent, _)) = self.parent(platform.now()) {
            let next = Report {
                hops: report.hops.saturating_add(1),
                ..report
            };
            let bytes = Message::Report(next).encode();
            let ticket = platform.send_to(self.radio, parent, &bytes);
            self.under_way.insert(ticket, (parent, report));
        } else {
            self.waiting.push_back(report);
            if self.waiting.len() > WAITING {
                self.waiting.pop_front();
            }
        }
    }

    /// Sends a word of the base on, the way that the last report came.
    pub(super) fn answer(&mut self, number: u16, platform: &mut Platform<'_>) {
        if let Some(back) = self.back {
            platform.send_to(self.radio, back, &Message::Word(number).encode());
        }
    }

    /// What became of a packet. A report that was not acknowledged tries another way.
    pub(super) fn sent(&mut self, outcome: &Outcome, platform: &mut Platform<'_>) {
        let Some((parent, report)) = self.under_way.remove(&outcome.ticket) else {
            return;
        };
        if outcome.result.is_err() {
            let until = platform.now() + Time::from_secs(SHUN_S);
            if let Some(peer) = self.peers.get_mut(&parent) {
                peer.shunned = until;
            }
            self.forward(report, platform);
        }
    }

    /// The next one towards the base, of those that are heard.
    pub(super) fn behind(&self) -> Option<Side> {
        let here_m = self.s_m?;
        let sides = self.sides();
        let behind = sides.filter(|side| side.s_m < here_m);
        behind.max_by(|a, b| a.s_m.total_cmp(&b.s_m))
    }

    /// The next one away from the base, of those that are heard.
    pub(super) fn ahead(&self) -> Option<Side> {
        let here_m = self.s_m?;
        let sides = self.sides();
        let ahead = sides.filter(|side| side.s_m > here_m);
        ahead.min_by(|a, b| a.s_m.total_cmp(&b.s_m))
    }

    fn sides(&self) -> impl Iterator<Item = Side> {
        self.peers.iter().filter_map(|(id, peer)| {
            let link = self.beacons.neighbor(*id)?;
            Some(Side {
                s_m: peer.s_m?,
                rssi_dbm: link.rssi().dbm(),
                heard: link.last_heard(),
                torn: peer.torn,
            })
        })
    }

    /// Expected transmissions to the base. `None` without a way.
    fn cost(&self, now: SimTime) -> Option<f64> {
        if self.is_base {
            return Some(0.0);
        }
        Some(self.parent(now)?.1)
    }

    /// Whom to send reports to, and the expected transmissions to the base that way.
    fn parent(&self, now: SimTime) -> Option<(ModelId, f64)> {
        let here_m = self.s_m?;
        let ways = self.peers.iter().filter_map(|(id, peer)| {
            let link = self.beacons.neighbor(*id)?;
            let usable = peer.s_m? < here_m && now >= peer.shunned;
            Some((*id, link.etx()? + peer.cost?)).filter(|_| usable)
        });
        ways.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn note(&mut self, sender: ModelId, hello: &Hello) {
        self.trail.extend(hello.first, &hello.crumbs);
        let shunned = self
            .peers
            .get(&sender)
            .map_or(SimTime::ZERO, |peer| peer.shunned);
        let peer = Peer {
            s_m: hello.s_m,
            cost: hello.cost,
            torn: hello.torn,
            known: hello.known,
            shunned,
        };
        self.peers.insert(sender, peer);
    }
}
