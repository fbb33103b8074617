//! What the recorder makes of the air: packets from marks, counters by period, links by pair.

use crate::air::{Link, Links, Packet, Received, Tallies, Traffic};
use crate::recorder::{RecordError, Recorder};
use crate::selection::selects;
use simbeeotic_model::kernel::ModelId;
use simbeeotic_model::packets::LINKED_RADIOS_MAX;
use simbeeotic_model::radio::{Channel, Counters, Loss, RadioId};
use simbeeotic_model::units::Position;
use simbeeotic_model::{ComponentError, OnAir, Reception, Transmission, View};
use std::collections::BTreeMap;

/// Swarms of more radios have their packets recorded only if it is said whose.
pub(crate) const ALL_RADIOS_MAX: usize = 256;

/// Whether the frames of a radio are recorded: those that the patterns say, else all of a small swarm.
pub(crate) fn wants(packets: Option<&[String]>, radio: &str, among: usize) -> bool {
    match packets {
        Some(patterns) => patterns.iter().any(|pattern| selects(pattern, radio)),
        None => among <= ALL_RADIOS_MAX,
    }
}

/// The air of a run, as far as it is recorded.
pub(crate) struct Air {
    /// Path of each radio, by id.
    paths: Vec<String>,
    /// Whose counters are recorded by themselves, and what they were at the last period's end.
    counted: Vec<(RadioId, Counters)>,
    all: Counters,
    /// The end of the last period, ns; `None` before the first.
    last_ns: Option<u64>,
    /// Packets whose end has not come, in the order of their starts.
    open: Vec<Open>,
    /// Where each stands in `open`, by the frame's key.
    places: BTreeMap<u64, usize>,
    /// By id: whether the radio's packets are recorded. Other components may have asked for more.
    wanted: Vec<bool>,
    links: Pairs,
    /// Receptions of packets that were closed already.
    late: u64,
}

/// A packet that may still be received.
struct Open {
    key: u64,
    end_ns: u64,
    radio: RadioId,
    packet: Packet,
    /// Receivers, in the order of `packet.receptions`.
    receivers: Vec<RadioId>,
    /// Who could listen, and from how far, m.
    listeners: Vec<(RadioId, f32)>,
}

impl Air {
    /// Looks at who there is. Patterns that match no radio are mistakes, if there are radios.
    pub(crate) fn start(
        view: &View<'_>,
        packets: Option<&[String]>,
        radios: &[String],
    ) -> Result<Option<Self>, ComponentError> {
        let paths = view.radios();
        if paths.is_empty() {
            return Ok(None);
        }
        check("packets", packets.unwrap_or_default(), &paths)?;
        check("radios", radios, &paths)?;
        let ids = || (0..paths.len() as u32).map(RadioId);
        let path = |id: &RadioId| paths[id.index()].as_str();
        let counted = ids().filter(|id| radios.iter().any(|pattern| selects(pattern, path(id))));
        let counted = counted.map(|id| (id, Counters::default())).collect();
        let wanted: Vec<bool> = ids()
            .map(|id| wants(packets, path(&id), paths.len()))
            .collect();
        let watched: Vec<RadioId> = ids().filter(|id| wanted[id.index()]).collect();
        Ok(Some(Self {
            wanted,
            links: Pairs::new(&watched, paths.len()),
            counted,
            all: Counters::default(),
            last_ns: None,
            open: Vec::new(),
            places: BTreeMap::new(),
            late: 0,
            paths,
        }))
    }

    /// Takes the frames that began.
    pub(crate) fn begun(&mut self, view: &View<'_>, air: &OnAir) {
        for sent in &air.frames {
            if !self.wants(sent.frame.radio()) {
                continue;
            }
            let packet = self.packet(view, sent);
            let radio = sent.frame.radio();
            let to = sent.frame.destination();
            let hears = air.listeners.iter().filter(|listener| {
                let for_it = |to| view.radio_owner(listener.radio) == Some(to);
                self.wants(listener.radio)
                    && listener.radio != radio
                    && listener.channel == sent.channel
                    && to.is_none_or(for_it)
            });
            let listeners = hears.map(|l| (l.radio, distance_m(l.position, sent.position)));
            let listeners = listeners.collect();
            self.places.insert(sent.frame.key(), self.open.len());
            self.open.push(Open {
                key: sent.frame.key(),
                end_ns: packet.time_ns.saturating_add(packet.airtime_ns),
                radio,
                packet,
                receivers: Vec::new(),
                listeners,
            });
        }
    }

    fn packet(&self, view: &View<'_>, sent: &Transmission) -> Packet {
        let model = |id: ModelId| view.population().path(id).to_owned();
        let frame = &sent.frame;
        Packet {
            time_ns: frame.sent().nanos(),
            sender: model(frame.sender()),
            radio: self.path(frame.radio()),
            channel: number(&sent.channel),
            frequency_hz: sent.channel.centre.get(),
            destination: frame.destination().map(model).unwrap_or_default(),
            bytes: u32::try_from(frame.bytes()).unwrap_or(u32::MAX),
            payload_bytes: u32::try_from(frame.payload().len()).unwrap_or(u32::MAX),
            airtime_ns: frame.airtime_nanos(),
            power_dbm: frame.power().dbm(),
            position_m: sent.position.si().to_array(),
            receptions: Vec::new(),
        }
    }

    fn wants(&self, radio: RadioId) -> bool {
        self.wanted.get(radio.index()).copied().unwrap_or(false)
    }

    fn path(&self, radio: RadioId) -> String {
        self.paths.get(radio.index()).cloned().unwrap_or_default()
    }

    /// Takes what a radio received at a time.
    pub(crate) fn heard(&mut self, time_ns: u64, receptions: &[Reception]) {
        for reception in receptions {
            if !self.wants(reception.sender) {
                continue;
            }
            let Some(&place) = self.places.get(&reception.frame) else {
                self.late += 1;
                continue;
            };
            let radio = self.path(reception.radio);
            let open = &mut self.open[place];
            open.receivers.push(reception.radio);
            open.packet.receptions.push(Received {
                radio,
                time_ns,
                rssi_dbm: reception.rssi.dbm() as f32,
                snr_db: reception.snr.db() as f32,
                lqi: reception.lqi,
            });
        }
    }

    /// Writes the packets whose end has come; all of them if there is no more to come.
    pub(crate) fn write_packets(
        &mut self,
        recorder: &mut Recorder,
        now_ns: u64,
        all: bool,
    ) -> Result<(), RecordError> {
        let ended = |open: &Open| all || open.end_ns <= now_ns;
        if !self.open.iter().any(ended) {
            return Ok(());
        }
        self.places.clear();
        for open in std::mem::take(&mut self.open) {
            if ended(&open) {
                self.links.add(&open);
                recorder.packet(open.packet)?;
            } else {
                self.places.insert(open.key, self.open.len());
                self.open.push(open);
            }
        }
        Ok(())
    }

    /// Closes a period.
    pub(crate) fn write_period(
        &mut self,
        recorder: &mut Recorder,
        view: &View<'_>,
    ) -> Result<(), RecordError> {
        let time_ns = view.now().nanos();
        let links = self.links.take();
        let counters = view.radio_counters(None);
        // The end of the run may be that of a period too, with nothing between the two.
        if self.last_ns == Some(time_ns) && counters == self.all && links.is_empty() {
            return Ok(());
        }
        let period_s = (time_ns - self.last_ns.unwrap_or(time_ns)) as f64 * 1e-9;
        self.last_ns = Some(time_ns);
        let mut write = |radio: String, last: &mut Counters, counters: Counters| {
            let traffic = Traffic {
                time_ns,
                period_s,
                radio,
                period: tallies(&counters, last),
                total: tallies(&counters, &Counters::default()),
            };
            *last = counters;
            recorder.traffic(traffic)
        };
        write(String::new(), &mut self.all, counters)?;
        for (id, last) in &mut self.counted {
            let path = self.paths[id.index()].clone();
            write(path, last, view.radio_counters(Some(*id)))?;
        }
        if links.is_empty() {
            return Ok(());
        }
        recorder.links(Links {
            time_ns,
            period_s,
            radios: self.links.radios.iter().map(|id| self.path(*id)).collect(),
            links,
        })
    }

    /// What the user should know at the end.
    pub(crate) fn notes(&self, said: bool) -> Vec<String> {
        let mut notes = Vec::new();
        let radios = self.links.watched;
        if radios > LINKED_RADIOS_MAX {
            notes.push(format!(
                "packets of {radios} radios, but no links: those of more than {LINKED_RADIOS_MAX} radios \
                 are not recorded; name fewer in the recorder's `packets`"
            ));
        } else if radios == 0 && !said {
            notes.push(format!(
                "counters only: there are {} radios, and the packets of more than {ALL_RADIOS_MAX} are \
                 recorded if the recorder's `packets` names them",
                self.paths.len()
            ));
        }
        if self.late > 0 {
            notes.push(format!(
                "{} receptions came later than their frames ended, and are not in the packets",
                self.late
            ));
        }
        notes
    }
}

fn check(key: &str, patterns: &[String], paths: &[String]) -> Result<(), ComponentError> {
    let useless = |pattern: &&String| !paths.iter().any(|path| selects(pattern, path));
    let Some(pattern) = patterns.iter().find(useless) else {
        return Ok(());
    };
    let known = match paths {
        [only] => format!("there is one, {only:?}"),
        [first, .., last] => format!("there are {}, from {first:?} to {last:?}", paths.len()),
        [] => String::new(),
    };
    Err(ComponentError::new(format!(
        "no radio matches {pattern:?} of the recorder's `{key}`; {known}"
    )))
}

/// The channel's number in IEEE 802.15.4, or 0.
fn number(channel: &Channel) -> u8 {
    let is = |number: &u8| Channel::ieee802154(*number).as_ref() == Some(channel);
    (11..=26).find(is).unwrap_or(0)
}

fn distance_m(a: Position, b: Position) -> f32 {
    (a.si() - b.si()).length() as f32
}

/// What came to `last`, and made `now` of it. Reasons that never occurred are left out.
fn tallies(now: &Counters, last: &Counters) -> Tallies {
    let lost = Loss::ALL.into_iter().filter(|why| now.lost(*why) > 0);
    Tallies {
        sent: now.sent.saturating_sub(last.sent),
        received: now.received.saturating_sub(last.received),
        overheard: now.overheard.saturating_sub(last.overheard),
        lost: lost
            .map(|why| {
                let lost = now.lost(why).saturating_sub(last.lost(why));
                (why.name().to_owned(), lost)
            })
            .collect(),
    }
}

/// Sums over ordered pairs of radios in one period.
struct Pairs {
    /// How many radios' packets are recorded.
    watched: usize,
    /// Those among which there are links; none if they are too many.
    radios: Vec<RadioId>,
    /// The place of each radio in `radios`, by id.
    places: Vec<Option<u32>>,
    /// Row by row: a row for each sender.
    sums: Vec<Sum>,
}

#[derive(Clone, Copy, Default)]
struct Sum {
    sent: u32,
    received: u32,
    rssi_dbm: f64,
    distance_m: f64,
}

impl Pairs {
    fn new(watched: &[RadioId], all: usize) -> Self {
        let few = watched.len() <= LINKED_RADIOS_MAX;
        let radios: Vec<RadioId> = if few { watched.to_vec() } else { Vec::new() };
        let mut places = vec![None; all];
        for (place, radio) in (0..).zip(&radios) {
            places[radio.index()] = Some(place);
        }
        Self {
            watched: watched.len(),
            sums: vec![Sum::default(); radios.len() * radios.len()],
            radios,
            places,
        }
    }

    fn sum(&mut self, from: RadioId, to: RadioId) -> Option<&mut Sum> {
        let [from, to] = [from, to].map(|radio| self.places.get(radio.index()).copied().flatten());
        let place = from? as usize * self.radios.len() + to? as usize;
        self.sums.get_mut(place)
    }

    fn add(&mut self, open: &Open) {
        for (listener, distance_m) in &open.listeners {
            if let Some(sum) = self.sum(open.radio, *listener) {
                sum.sent += 1;
                sum.distance_m += f64::from(*distance_m);
            }
        }
        for (receiver, received) in open.receivers.iter().zip(&open.packet.receptions) {
            if let Some(sum) = self.sum(open.radio, *receiver) {
                sum.received += 1;
                sum.rssi_dbm += f64::from(received.rssi_dbm);
            }
        }
    }

    /// The pairs between which there was a frame; all begin anew.
    fn take(&mut self) -> Vec<Link> {
        let count = self.radios.len();
        let mut links = Vec::new();
        for (place, sum) in self.sums.iter_mut().enumerate() {
            if sum.sent == 0 {
                continue;
            }
            let Sum {
                sent,
                received,
                rssi_dbm,
                distance_m,
            } = std::mem::take(sum);
            links.push(Link {
                from: (place / count) as u32,
                to: (place % count) as u32,
                sent,
                received,
                // 0 / 0 is NaN: nothing was received.
                rssi_dbm: (rssi_dbm / f64::from(received)) as f32,
                distance_m: (distance_m / f64::from(sent)) as f32,
            });
        }
        links
    }
}
