//! The medium's face: radios, requests, commands, books.

use super::act::Band;
use super::agenda::Agenda;
use super::air::{Modulation, Reception};
use super::mac::{AIRTIME_NS_MAX, Ear, Job, Radio, Timing, airtime_ns};
use super::mail::Mail;
use super::{AccessStatistics, Ieee802154Config};
use crate::channel::Channel;
use crate::counters::{Counters, Loss};
use crate::frame::{Frame, Outcome, Request};
use crate::inbox::{Inbox, Qualities, Receiver};
use crate::ledger::Usage;
use crate::medium::{Command, Medium, Poses};
use crate::phy::Phy;
use crate::radio::{RadioError, RadioId, RadioSpec, RadioState};
use crate::scratch::Scratch;
use simbeeotic_kernel::rng::{draw_u64, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::PowerLevel;
use std::collections::BTreeSet;

/// The medium with air time, medium access and interference: see the [module](crate::ieee802154).
#[derive(Debug)]
pub struct Ieee802154Medium {
    pub(super) config: Ieee802154Config,
    /// The seeds of this medium's draws.
    pub(super) luck: u64,
    pub(super) backoff_luck: u64,
    /// As the radios stand, with the [`Phy`] that counts here.
    pub(super) specs: Vec<RadioSpec>,
    pub(super) radios: Vec<Radio>,
    keys: BTreeSet<u64>,
    pub(super) bands: Vec<Band>,
    pub(super) modulations: Vec<Modulation>,
    pub(super) agenda: Agenda,
    pub(super) mail: Mail,
    /// Outcomes of this round so far, or of the commits since.
    pub(super) reports: Vec<(RadioId, Outcome)>,
    due: Option<SimTime>,
    /// Radios that are to change their channel: at once, or when what was asked before has been sent.
    pub(super) tunings: Vec<RadioId>,
    pub(super) begun: Vec<Frame>,
    pub(super) statistics: AccessStatistics,
    pub(super) next_id: u32,
    now: SimTime,
    /// Room that is used again.
    pub(super) receptions: Vec<Reception>,
    pub(super) spare: Vec<Vec<f32>>,
}

impl Ieee802154Medium {
    /// A medium without radios.
    ///
    /// # Errors
    /// Settings that make no sense.
    pub fn new(config: Ieee802154Config) -> Result<Self, RadioError> {
        config.check()?;
        let luck = draw_u64(config.seed, path_key("radio"), path_key("ieee802154"));
        Ok(Self {
            luck,
            backoff_luck: draw_u64(luck, path_key("backoff"), 0),
            config,
            specs: Vec::new(),
            radios: Vec::new(),
            keys: BTreeSet::new(),
            bands: Vec::new(),
            modulations: Vec::new(),
            agenda: Agenda::default(),
            mail: Mail::default(),
            reports: Vec::new(),
            due: None,
            tunings: Vec::new(),
            begun: Vec::new(),
            statistics: AccessStatistics::default(),
            next_id: 0,
            now: SimTime::ZERO,
            receptions: Vec::new(),
            spare: Vec::new(),
        })
    }

    /// How the requests of all radios fared on their way to the channel, up to the last round.
    #[must_use]
    pub fn access_statistics(&self) -> AccessStatistics {
        self.statistics
    }

    /// The radio as it is here: the medium's settings come before its own.
    fn adopt(&self, mut spec: RadioSpec) -> RadioSpec {
        if let Some(phy) = &self.config.phy {
            spec.phy = phy.clone();
        }
        if let Some(noise) = self.config.noise {
            spec.phy.noise = noise + spec.noise_figure;
        }
        spec
    }

    /// Notes the outcome of a request, if its sender wants to know.
    pub(super) fn report(&mut self, radio: u32, job: &Job, result: Result<(), Loss>) {
        if let Some(ticket) = job.ticket {
            self.reports
                .push((RadioId(radio), Outcome { ticket, result }));
        }
    }

    /// A request that cannot even wait.
    fn refuse(&mut self, radio: RadioId, job: &Job, reason: Loss) {
        self.radios[radio.index()].books.lose(reason, 1);
        self.report(radio.0, job, Err(reason));
    }
}

impl Medium for Ieee802154Medium {
    fn add(&mut self, spec: RadioSpec) -> Result<RadioId, RadioError> {
        spec.check()?;
        let spec = self.adopt(spec);
        spec.check()?;
        if !self.keys.insert(spec.key) {
            return Err(RadioError::DuplicateKey { key: spec.key });
        }
        let id = RadioId(self.radios.len() as u32);
        let queue = self.config.queue_frames.unwrap_or(spec.queue_frames);
        let timing = Timing::new(&spec.phy, queue);
        self.agenda.lead(timing.turnaround_ns);
        self.radios.push(Radio::new(timing));
        self.specs.push(spec);
        self.mail.grow();
        self.join(id);
        self.hear(id.0, 0, Ear::Listening);
        Ok(id)
    }

    fn radios(&self) -> usize {
        self.radios.len()
    }

    fn spec(&self, radio: RadioId) -> &RadioSpec {
        &self.specs[radio.index()]
    }

    fn submit(&mut self, now: SimTime, request: Request) {
        let (id, spec) = (request.radio, &self.specs[request.radio.index()]);
        let airtime_ns = airtime_ns(spec, spec.frame_bytes(request.payload.len()));
        let too_long =
            request.payload.len() > spec.payload_bytes_max || airtime_ns > AIRTIME_NS_MAX;
        let radio = &mut self.radios[id.index()];
        let job = Job {
            payload: request.payload,
            destination: request.destination,
            ticket: request.ticket,
            submitted_ns: now.nanos(),
            sequence: radio.requests,
        };
        if job.ticket.is_some() {
            // Its outcome may be there at once.
            self.due = Some(now);
        }
        if radio.drowsy || radio.ear == Ear::Asleep {
            return self.refuse(id, &job, Loss::SenderAsleep);
        }
        if too_long {
            return self.refuse(id, &job, Loss::TooLong);
        }
        if radio.jobs.len() > radio.timing.queue_frames {
            return self.refuse(id, &job, Loss::QueueFull);
        }
        radio.requests += 1;
        radio.jobs.push_back(job);
        // Behind a change of channel, the round begins with it.
        let first = radio.jobs.len() == 1 && radio.tunings.is_empty();
        self.statistics.requests += 1;
        if first {
            self.begin(id.0, now.nanos());
        }
    }

    fn command(
        &mut self,
        now: SimTime,
        radio: RadioId,
        command: Command,
    ) -> Result<(), RadioError> {
        let id = radio;
        let radio = &mut self.radios[id.index()];
        match command {
            Command::Sleep if radio.flight.is_some() => radio.drowsy = true,
            Command::Sleep if radio.ear != Ear::Asleep => {
                self.fall_asleep(id.0, now.nanos());
                if !self.reports.is_empty() || !self.tunings.is_empty() {
                    self.due = Some(now);
                }
            }
            Command::Sleep => {}
            Command::Wake => {
                radio.drowsy = false;
                if radio.ear == Ear::Asleep {
                    radio.ledger.wake(now);
                    self.hear(id.0, now.nanos(), Ear::Listening);
                }
            }
            Command::Tune(channel) => {
                let spec = self.specs[id.index()].clone();
                RadioSpec { channel, ..spec }.check()?;
                radio.tunings.push_back((radio.requests, channel));
                if !self.tunings.contains(&id) {
                    self.tunings.push(id);
                }
                self.due = Some(now);
            }
            Command::Power { level, current } => {
                let before = self.specs[id.index()].set_power(level, current)?;
                radio.ledger.settle(before);
            }
        }
        Ok(())
    }

    fn next_time(&self) -> Option<SimTime> {
        let next = self.agenda.next_ns().map(SimTime::from_nanos);
        match (self.due, next) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    fn open(&mut self, now: SimTime, poses: &dyn Poses, owners: &mut Vec<ModelId>) {
        owners.clear();
        self.now = now;
        self.due = None;
        self.mail.clear();
        self.begun.clear();
        self.retune(now, poses);
        while let Some(event) = self.agenda.pop(now.nanos()) {
            self.act(event, poses);
            self.retune(SimTime::from_nanos(event.time_ns), poses);
        }
        let specs = &self.specs;
        self.mail.seal(&mut self.reports, |radio| {
            owners.push(specs[radio.index()].owner);
        });
        if !owners.is_sorted() {
            owners.sort_unstable();
        }
        owners.dedup();
    }

    fn collect<'a>(&'a self, id: RadioId, _: &dyn Poses, _: &'a mut Scratch) -> Inbox<'a> {
        let spec = &self.specs[id.index()];
        let (hits, list) = self.mail.packets(id);
        Inbox {
            radio: id,
            time: self.now,
            hits,
            frames: &self.mail.frames,
            outcomes: self.mail.outcomes(id),
            receiver: Receiver {
                noise: spec.phy.noise,
                error: spec.error.as_ref(),
            },
            qualities: Qualities {
                list,
                meaning: spec.phy.quality,
            },
        }
    }

    fn begun(&self, visit: &mut dyn FnMut(&Frame, Channel)) {
        for frame in &self.begun {
            visit(frame, self.spec(frame.radio).channel);
        }
    }

    fn ambient(&self, radio: RadioId) -> PowerLevel {
        let radio = &self.radios[radio.index()];
        let total_mw = self.bands[radio.band as usize]
            .air
            .total_mw(radio.row as usize);
        PowerLevel::from_milliwatts(radio.timing.noise_mw + total_mw)
    }

    fn state(&self, radio: RadioId, _now: SimTime) -> RadioState {
        let radio = &self.radios[radio.index()];
        let air = &self.bands[radio.band as usize].air;
        match radio.ear {
            _ if radio.flight.is_some() => RadioState::Transmit,
            Ear::Asleep => RadioState::Sleep,
            _ if air.taking(radio.row as usize).is_some() => RadioState::Receive,
            _ => RadioState::Listen,
        }
    }

    fn counters(&self, radio: RadioId) -> Counters {
        let phy: &Phy = &self.specs[radio.index()].phy;
        let radio = &self.radios[radio.index()];
        let (band, row) = (&self.bands[radio.band as usize], radio.row as usize);
        let least = phy.noise + phy.lock;
        let weak = match phy.sensitivity {
            Some(sensitivity) if sensitivity >= least => Loss::BelowSensitivity,
            _ => Loss::Noise,
        };
        let taking = band.air.taking(row).is_some_and(|taking| taking.counted);
        let beyond = band.members.beyond[row];
        radio.counters(band.air.tally(row), beyond, band.started, taking, weak)
    }

    fn usage(&self, radio: RadioId, until: SimTime) -> Usage {
        let currents = &self.specs[radio.index()].currents;
        let radio = &self.radios[radio.index()];
        let (air, row) = (&self.bands[radio.band as usize].air, radio.row as usize);
        let present = air.taking(row);
        let present_ns = present.map_or(0, |taking| until.nanos() - taking.since_ns);
        let rx_ns = radio.rx_ns(air.tally(row)) + present_ns;
        radio.ledger.usage_listening(currents, until, rx_ns)
    }
}
