//! The air, as pages show it: packets with who received them, and links between radios.

use crate::replay::best;
use crate::wire::{Link, Packet, PacketDetails};
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::packets::LINKED_RADIOS_MAX;
use simbeeotic_model::radio::RadioId;
use simbeeotic_model::{OnAir, Reception, View};
use std::collections::{BTreeMap, VecDeque};

/// Swarms of more radios have packets of selected vehicles only.
pub(super) const ALL_RADIOS_MAX: usize = 256;

/// Packets on the air at a time that are kept an eye on.
const OPEN_MAX: usize = 20_000;

/// Packets of a selected vehicle that are remembered.
const REMEMBERED: usize = 20;

/// How long links are averaged over, virtual time, ns.
const PERIOD_NS: u64 = 1_000_000_000;

/// A packet that may still be received.
struct Open {
    end_ns: u64,
    packet: Packet,
    from: RadioId,
    receivers: Vec<RadioId>,
    listeners: Vec<RadioId>,
}

#[derive(Clone, Copy, Default)]
struct Sum {
    sent: u32,
    received: u32,
    rssi_dbm: f64,
}

/// What is under way.
pub(super) struct Traffic {
    /// The vehicle that carries each radio, by id; `None`: what carries it has no body.
    owners: Vec<Option<u32>>,
    open: BTreeMap<u64, Open>,
    /// Keys of `open` by their ends.
    ends: VecDeque<(u64, u64)>,
    pairs: BTreeMap<(u32, u32), Sum>,
    period_from_ns: u64,
    pub(super) remembered: BTreeMap<u32, VecDeque<PacketDetails>>,
}

impl Traffic {
    /// `None`: there are no radios.
    pub(super) fn new(view: &View<'_>, vehicle: impl Fn(usize) -> Option<u32>) -> Option<Self> {
        let radios = view.radios().len() as u32;
        let owner = |id: u32| view.radio_owner(RadioId(id)).map(|owner| owner.index());
        let owners: Vec<_> = (0..radios).map(|id| owner(id).and_then(&vehicle)).collect();
        (!owners.is_empty()).then(|| Self {
            owners,
            open: BTreeMap::new(),
            ends: VecDeque::new(),
            pairs: BTreeMap::new(),
            period_from_ns: 0,
            remembered: BTreeMap::new(),
        })
    }

    fn owner(&self, radio: RadioId) -> Option<u32> {
        self.owners.get(radio.index()).copied().flatten()
    }

    /// Takes the frames that began.
    pub(super) fn begun(&mut self, view: &View<'_>, air: &OnAir) {
        for sent in &air.frames {
            let (frame, radio) = (&sent.frame, sent.frame.radio());
            let Some(from) = self.owner(radio) else {
                continue;
            };
            if self.open.len() >= OPEN_MAX {
                return;
            }
            let to = frame.destination();
            let hears = air.listeners.iter().filter(|listener| {
                let for_it = |to| view.radio_owner(listener.radio) == Some(to);
                listener.radio != radio && listener.channel == sent.channel && to.is_none_or(for_it)
            });
            let begun_ns = frame.sent().nanos();
            let end_ns = begun_ns.saturating_add(frame.airtime_nanos());
            self.ends.push_back((end_ns, frame.key()));
            let open = Open {
                end_ns,
                from: radio,
                packet: Packet {
                    t: SimTime::from_nanos(begun_ns).as_secs_f64(),
                    from,
                    bytes: u32::try_from(frame.bytes()).unwrap_or(u32::MAX),
                    to: Vec::new(),
                },
                receivers: Vec::new(),
                listeners: hears.map(|listener| listener.radio).collect(),
            };
            self.open.insert(frame.key(), open);
        }
    }

    /// Takes what a radio received.
    pub(super) fn heard(&mut self, receptions: &[Reception]) {
        for reception in receptions {
            let owner = self.owner(reception.radio);
            if let (Some(open), Some(owner)) = (self.open.get_mut(&reception.frame), owner) {
                open.receivers.push(reception.radio);
                open.packet.to.push((owner, reception.rssi.dbm() as f32));
            }
        }
    }

    /// The packets whose end has come.
    pub(super) fn ended(&mut self, now_ns: u64) -> Vec<Packet> {
        let mut list = Vec::new();
        let mut waiting = VecDeque::new();
        for (end_ns, key) in std::mem::take(&mut self.ends) {
            if end_ns > now_ns {
                waiting.push_back((end_ns, key));
                continue;
            }
            let Some(open) = self.open.remove(&key) else {
                continue;
            };
            debug_assert!(open.end_ns <= now_ns, "a key is used once");
            self.count(&open);
            self.remember(&open.packet);
            list.push(open.packet);
        }
        self.ends = waiting;
        list
    }

    fn count(&mut self, open: &Open) {
        if self.owners.len() > LINKED_RADIOS_MAX {
            return;
        }
        for listener in &open.listeners {
            self.pairs
                .entry((open.from.0, listener.0))
                .or_default()
                .sent += 1;
        }
        for (receiver, (_, rssi_dbm)) in open.receivers.iter().zip(&open.packet.to) {
            let sum = self.pairs.entry((open.from.0, receiver.0)).or_default();
            sum.received += 1;
            sum.rssi_dbm += f64::from(*rssi_dbm);
        }
    }

    fn remember(&mut self, packet: &Packet) {
        for (vehicle, list) in &mut self.remembered {
            if let Some(seen) = seen_by(packet, *vehicle) {
                list.push_front(seen);
                list.truncate(REMEMBERED);
            }
        }
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
        if passed_ns < PERIOD_NS || self.owners.len() > LINKED_RADIOS_MAX {
            return None;
        }
        self.period_from_ns = now_ns;
        let links = std::mem::take(&mut self.pairs).into_iter();
        let links = links.filter(|(_, sum)| sum.received > 0);
        let links = links.filter_map(|((from, to), sum)| {
            let rssi_dbm = sum.rssi_dbm / f64::from(sum.received);
            // What was heard may have begun before it was known who listened.
            let share = (sum.received as f32 / sum.sent.max(sum.received) as f32).min(1.0);
            let [from, to] = [from, to].map(|radio| self.owner(RadioId(radio)));
            Some((from?, to?, rssi_dbm as f32, share))
        });
        Some((passed_ns as f64 * 1e-9, best(links.collect())))
    }

    /// Forgets what is under way: nobody looks any more.
    pub(super) fn forget(&mut self) {
        self.open.clear();
        self.ends.clear();
        self.pairs.clear();
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
