//! What the recorder makes of the air: packets from marks (`aloft`), counters by period, links by pair (`pairs`).

mod aloft;
mod pairs;

pub use aloft::{Aloft, Flight};
pub use pairs::Pairs;

use crate::air::{Links, Packet, Received, Tallies, Traffic};
use crate::recorder::{RecordError, Recorder};
use crate::selection::selects;
use simbeeotic_model::kernel::ModelId;
use simbeeotic_model::packets::LINKED_RADIOS_MAX;
use simbeeotic_model::radio::{Channel, Counters, Loss, RadioId};
use simbeeotic_model::{ComponentError, OnAir, Reception, Transmission, View};

/// Swarms of more radios have their packets recorded only if it is said whose.
pub const ALL_RADIOS_MAX: usize = 256;

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
    /// Frames of the radios whose packets are recorded. Other components may have asked for more.
    aloft: Aloft<Packet>,
    links: Pairs,
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
            aloft: Aloft::new(wanted, usize::MAX),
            links: Pairs::new(&watched, paths.len()),
            counted,
            all: Counters::default(),
            last_ns: None,
            paths,
        }))
    }

    /// Takes the frames that began.
    pub(crate) fn begun(&mut self, view: &View<'_>, air: &OnAir) {
        let paths = &self.paths;
        self.aloft
            .begun(view, air, |sent| packet(view, paths, sent));
    }

    fn path(&self, radio: RadioId) -> String {
        self.paths.get(radio.index()).cloned().unwrap_or_default()
    }

    /// Takes what a radio received at a time.
    pub(crate) fn heard(&mut self, time_ns: u64, receptions: &[Reception]) {
        self.aloft.heard(time_ns, receptions);
    }

    /// Writes the packets whose end has come; all of them if there is no more to come.
    pub(crate) fn write_packets(
        &mut self,
        recorder: &mut Recorder,
        now_ns: u64,
        all: bool,
    ) -> Result<(), RecordError> {
        for flight in self.aloft.ended(now_ns, all) {
            self.links.add(&flight);
            let receptions = flight.receptions.iter();
            let receptions = receptions.map(|(time_ns, reception)| Received {
                radio: self.path(reception.radio),
                time_ns: *time_ns,
                rssi_dbm: reception.rssi.dbm() as f32,
                snr_db: reception.snr.db() as f32,
                lqi: reception.lqi,
            });
            let receptions = receptions.collect();
            recorder.packet(Packet {
                receptions,
                ..flight.packet
            })?;
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
        let mut links = self.links.take();
        links.retain(|link| link.sent > 0);
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
            radios: self
                .links
                .radios()
                .iter()
                .map(|id| self.path(*id))
                .collect(),
            links,
        })
    }

    /// What the user should know at the end.
    pub(crate) fn notes(&self, said: bool) -> Vec<String> {
        let mut notes = Vec::new();
        let radios = self.links.followed();
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
        let late = self.aloft.late();
        if late > 0 {
            notes.push(format!(
                "{late} receptions came later than their frames ended, and are not in the packets"
            ));
        }
        notes
    }
}

/// A packet that nobody has received yet.
fn packet(view: &View<'_>, paths: &[String], sent: &Transmission) -> Packet {
    let model = |id: ModelId| view.population().path(id).to_owned();
    let frame = &sent.frame;
    Packet {
        time_ns: frame.sent().nanos(),
        sender: model(frame.sender()),
        radio: paths
            .get(frame.radio().index())
            .cloned()
            .unwrap_or_default(),
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
