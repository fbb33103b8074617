//! The air, as pages show it: packets with who received them, and links between radios.

use super::viewer::Cast;
use crate::wire::{Link, Packet, PacketDetails, best};
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::radio::RadioId;
use simbeeotic_model::{OnAir, Reception, View};
use simbeeotic_record::{Aloft, Flight, Pairs};
use std::collections::{BTreeMap, VecDeque};

/// Packets on the air at a time that are followed.
const OPEN_MAX: usize = 20_000;

/// Packets of a selected vehicle that are remembered.
const REMEMBERED: usize = 20;

/// How long links are averaged over at least, virtual time, ns.
const PERIOD_NS: u64 = 1_000_000_000;

/// What is under way.
pub(super) struct Traffic {
    /// The vehicle that carries each radio, by id; `None`: what carries it has no body.
    owners: Vec<Option<u32>>,
    aloft: Aloft<Packet>,
    pairs: Pairs,
    period_from_ns: u64,
    pub(super) remembered: BTreeMap<u32, VecDeque<PacketDetails>>,
}

impl Traffic {
    /// `None`: there are no radios.
    pub(super) fn new(view: &View<'_>, cast: &Cast) -> Option<Self> {
        let radios = view.radios().len() as u32;
        let ids: Vec<RadioId> = (0..radios).map(RadioId).collect();
        let owner = |id: &RadioId| cast.vehicle(view.radio_owner(*id)?);
        let owners: Vec<Option<u32>> = ids.iter().map(owner).collect();
        let wanted = owners.iter().map(Option::is_some).collect();
        (!owners.is_empty()).then(|| Self {
            aloft: Aloft::new(wanted, OPEN_MAX),
            pairs: Pairs::new(&ids, ids.len()),
            owners,
            period_from_ns: 0,
            remembered: BTreeMap::new(),
        })
    }

    fn owner(&self, radio: RadioId) -> Option<u32> {
        self.owners.get(radio.index()).copied().flatten()
    }

    /// Takes the frames that began.
    pub(super) fn begun(&mut self, view: &View<'_>, air: &OnAir) {
        let owners = &self.owners;
        self.aloft.begun(view, air, |sent| Packet {
            t: sent.frame.sent().as_secs_f64(),
            from: owners[sent.frame.radio().index()].unwrap_or_default(),
            bytes: u32::try_from(sent.frame.bytes()).unwrap_or(u32::MAX),
            to: Vec::new(),
        });
    }

    /// Takes what a radio received.
    pub(super) fn heard(&mut self, time: SimTime, receptions: &[Reception]) {
        self.aloft.heard(time.nanos(), receptions);
    }

    /// The packets whose end has come.
    pub(super) fn ended(&mut self, now_ns: u64) -> Vec<Packet> {
        let flights = self.aloft.ended(now_ns, false).into_iter();
        flights.map(|flight| self.land(flight)).collect()
    }

    fn land(&mut self, flight: Flight<Packet>) -> Packet {
        self.pairs.add(&flight);
        let mut packet = flight.packet;
        for (_, reception) in &flight.receptions {
            if let Some(owner) = self.owner(reception.radio) {
                packet.to.push((owner, reception.rssi.dbm() as f32));
            }
        }
        for (vehicle, list) in &mut self.remembered {
            if let Some(seen) = seen_by(&packet, *vehicle) {
                list.push_front(seen);
                list.truncate(REMEMBERED);
            }
        }
        packet
    }

    /// Remembers the packets of these vehicles; `known` are older ones, the newest first.
    pub(super) fn select<'a>(
        &mut self,
        vehicles: impl IntoIterator<Item = u32>,
        known: impl Iterator<Item = &'a Packet> + Clone,
    ) {
        let old = std::mem::take(&mut self.remembered);
        for vehicle in vehicles {
            let list = old.get(&vehicle).cloned().unwrap_or_else(|| {
                let seen = known.clone().filter_map(|packet| seen_by(packet, vehicle));
                seen.take(REMEMBERED).collect()
            });
            self.remembered.insert(vehicle, list);
        }
    }

    /// Who heard whom, at the end of each period: its length in s, and the links.
    pub(super) fn links(&mut self, now_ns: u64) -> Option<(f64, Vec<Link>)> {
        let passed_ns = now_ns.saturating_sub(self.period_from_ns);
        if passed_ns < PERIOD_NS || self.pairs.radios().is_empty() {
            return None;
        }
        self.period_from_ns = now_ns;
        let links = self.pairs.take();
        let radios = self.pairs.radios();
        let vehicle = |place: u32| self.owner(*radios.get(place as usize)?);
        let heard = links.iter().filter(|link| link.received > 0);
        let links = heard.filter_map(|link| {
            let ends = (vehicle(link.from)?, vehicle(link.to)?);
            Some((ends.0, ends.1, link.rssi_dbm, link.share()))
        });
        Some((passed_ns as f64 * 1e-9, best(links.collect())))
    }

    /// Forgets what is under way: nobody looks any more.
    pub(super) fn forget(&mut self) {
        self.aloft.clear();
        self.pairs.take();
    }
}

/// A packet as one vehicle saw it.
fn seen_by(packet: &Packet, vehicle: u32) -> Option<PacketDetails> {
    let details = |sent, other, rssi_dbm| PacketDetails {
        t: packet.t,
        sent,
        other,
        bytes: packet.bytes,
        rssi_dbm,
    };
    if packet.from == vehicle {
        let only = match packet.to.as_slice() {
            [(to, _)] => Some(*to),
            _ => None,
        };
        return Some(details(true, only, None));
    }
    let (_, rssi_dbm) = packet.to.iter().find(|(to, _)| *to == vehicle)?;
    Some(details(false, Some(packet.from), Some(*rssi_dbm)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_packet_is_told_from_the_side_of_the_selected_vehicle() {
        let packet = Packet {
            t: 1.5,
            from: 3,
            bytes: 24,
            to: vec![(5, -71.5), (9, -80.0)],
        };
        let sent = seen_by(&packet, 3).expect("it sent it");
        assert_eq!((sent.sent, sent.other, sent.rssi_dbm), (true, None, None));
        let heard = seen_by(&packet, 9).expect("it heard it");
        assert_eq!((heard.sent, heard.other), (false, Some(3)));
        assert_eq!(heard.rssi_dbm, Some(-80.0));
        assert_eq!(seen_by(&packet, 4), None);
    }
}
