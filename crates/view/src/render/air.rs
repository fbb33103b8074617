//! What goes through the air: links between radios, packets on their way.

use super::RenderError;
use super::choices::Choices;
use super::colours::Places;
use simbeeotic_record::Recording;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// How long a packet is seen, s of the film.
const SEEN_S: f64 = 0.4;
/// Packets that a picture shows at most, counted at their receivers.
const PULSES_MAX: usize = 4000;
/// A link is shown for so long after its period, periods.
const STALE: f64 = 1.5;

/// What is drawn as no signal and as a full one, dBm.
const WEAK_DBM: f32 = -95.0;
const STRONG_DBM: f32 = -45.0;

/// Two that heard each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Link {
    /// Their places among the vehicles.
    pub(super) ends: [usize; 2],
    /// How strong the signal is, from 0, the weakest, to 1.
    pub(super) strong: f32,
    /// The share of frames that were received, 0 to 1.
    pub(super) share: f32,
}

/// Links and packets of a range of time.
#[derive(Default)]
pub(super) struct Air {
    /// When a period ended, ns, how long it was, s, and who heard whom.
    links: Vec<(u64, f64, Vec<Link>)>,
    /// When a packet was sent, ns, by whom and to whom.
    packets: Vec<(u64, usize, Vec<usize>)>,
    seen_ns: u64,
}

impl Air {
    pub(super) fn read(
        recording: &Recording,
        choices: &Choices,
        times_ns: &RangeInclusive<u64>,
    ) -> Result<Self, RenderError> {
        let places = Places::of(recording);
        let seen_ns = (SEEN_S * choices.speed * 1e9).clamp(0.0, 1e15) as u64;
        let mut air = Self {
            seen_ns,
            ..Self::default()
        };
        let (from, to) = (*times_ns.start(), *times_ns.end());
        if choices.links {
            let mut any = false;
            for period in recording.links_in(0..=u64::MAX) {
                let period = period?;
                any = true;
                let length_ns = (period.period_s.max(0.0) * 1e9) as u64;
                if period.time_ns.saturating_add(2 * length_ns) < from {
                    continue;
                }
                if period.time_ns.saturating_sub(length_ns) > to {
                    break;
                }
                let owner = |radio: u32| {
                    let path = period.radios.get(radio as usize)?;
                    Some(places.split(path)?.0)
                };
                let mut best: BTreeMap<[usize; 2], Link> = BTreeMap::new();
                for link in period.links.iter().filter(|link| link.received > 0) {
                    if let (Some(a), Some(b)) = (owner(link.from), owner(link.to))
                        && a != b
                    {
                        let ends = [a.min(b), a.max(b)];
                        let (strong, share) = (strength(link.rssi_dbm), link.share());
                        // Of both directions the better one.
                        best.entry(ends)
                            .and_modify(|known| {
                                known.strong = known.strong.max(strong);
                                known.share = known.share.max(share);
                            })
                            .or_insert(Link {
                                ends,
                                strong,
                                share,
                            });
                    }
                }
                let list = best.into_values().collect();
                air.links.push((period.time_ns, period.period_s, list));
            }
            // None at these times is an answer; none at all was not recorded.
            if !any {
                return Err(RenderError::Nothing("links"));
            }
        }
        if choices.packets {
            for packet in recording.packets_in(from.saturating_sub(seen_ns)..=to) {
                let packet = packet?;
                let Some((sender, _)) = places.split(&packet.sender) else {
                    continue;
                };
                let heard = packet.receptions.iter();
                let heard = heard.filter_map(|r| Some(places.split(&r.radio)?.0));
                air.packets.push((packet.time_ns, sender, heard.collect()));
            }
            let any = || recording.packets_in(0..=u64::MAX).next().transpose();
            if air.packets.is_empty() && any()?.is_none() {
                return Err(RenderError::Nothing("packets"));
            }
            air.packets.sort_by_key(|(time_ns, ..)| *time_ns);
        }
        Ok(air)
    }

    /// Who hears whom at a time, and how well.
    pub(super) fn links(&self, time_ns: u64) -> &[Link] {
        let at = self.links.partition_point(|(end_ns, ..)| *end_ns < time_ns);
        let found = self.links.get(at).or(self.links.last());
        match found {
            Some((end_ns, period_s, list))
                if time_ns <= end_ns.saturating_add((STALE * period_s * 1e9) as u64) =>
            {
                list
            }
            _ => &[],
        }
    }

    /// The packets on their way at a time: from, to, and how far they are.
    pub(super) fn pulses(&self, time_ns: u64) -> Vec<(usize, usize, f32)> {
        let first = time_ns.saturating_sub(self.seen_ns);
        let from = self
            .packets
            .partition_point(|(sent_ns, ..)| *sent_ns < first);
        let to = self
            .packets
            .partition_point(|(sent_ns, ..)| *sent_ns <= time_ns);
        let mut pulses = Vec::new();
        for (sent_ns, sender, heard) in &self.packets[from..to] {
            let share = (time_ns - sent_ns) as f32 / self.seen_ns.max(1) as f32;
            for receiver in heard {
                if pulses.len() < PULSES_MAX && receiver != sender {
                    pulses.push((*sender, *receiver, share.min(1.0)));
                }
            }
        }
        pulses
    }
}

/// A signal, from 0, the weakest that is told apart, to 1; in between where it is not known.
fn strength(rssi_dbm: f32) -> f32 {
    match rssi_dbm.is_finite() {
        true => ((rssi_dbm - WEAK_DBM) / (STRONG_DBM - WEAK_DBM)).clamp(0.0, 1.0),
        false => 0.5,
    }
}
