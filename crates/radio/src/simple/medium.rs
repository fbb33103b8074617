//! The simple medium at work.

use super::SimpleConfig;
use super::band::{Band, Mode};
use super::chance::Chances;
use super::party::Party;
use super::radio::{Heard, Radio};
use super::success::{Curve, Noise};
use crate::channel::Channel;
use crate::counters::{Counters, Loss};
use crate::frame::{Frame, Outcome, Request};
use crate::inbox::{Inbox, Qualities};
use crate::ledger::Usage;
use crate::medium::{Command, Medium, Poses};
use crate::radio::{RadioError, RadioId, RadioSpec, RadioState};
use crate::scratch::Scratch;
use simbeeotic_kernel::rng::{draw_u64, path_key};
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::PowerLevel;
use std::collections::BTreeSet;
use std::sync::Arc;

/// The medium of the paper: see the [module](crate::simple).
#[derive(Debug)]
pub struct SimpleMedium {
    pub(super) config: SimpleConfig,
    /// The seed of this medium's draws.
    luck: u64,
    specs: Vec<RadioSpec>,
    pub(super) radios: Vec<Radio>,
    keys: BTreeSet<u64>,
    pub(super) bands: Vec<Band>,
    /// If chance goes by distance.
    pub(super) chances: Option<Chances>,
    pub(super) curves: Vec<Curve>,
    /// Lengths of frames that came up, bytes on the air.
    lengths: Vec<usize>,
    /// Frames for the next round, and outcomes.
    waiting: Vec<Frame>,
    reports: Vec<(RadioId, Outcome)>,
    due: Option<SimTime>,
    /// Changes of channel that wait for the frames sent before them.
    tunings: Vec<(RadioId, Channel)>,
    /// The present round and its outcomes, by radio.
    pub(super) now: SimTime,
    pub(super) round: u64,
    reported: Vec<RadioId>,
    outcomes: Vec<Outcome>,
    pub(super) scratch: Scratch,
    pub(super) party: Party,
}

impl SimpleMedium {
    /// A medium without radios.
    ///
    /// # Errors
    /// Noise or range that make no sense.
    pub fn new(config: SimpleConfig) -> Result<Self, RadioError> {
        config.check()?;
        let links = draw_u64(config.seed, path_key("radio"), path_key("links"));
        Ok(Self {
            luck: draw_u64(config.seed, path_key("radio"), path_key("simple")),
            chances: Chances::new(&config.delivery, links),
            config,
            specs: Vec::new(),
            radios: Vec::new(),
            keys: BTreeSet::new(),
            bands: Vec::new(),
            curves: Vec::new(),
            lengths: Vec::new(),
            waiting: Vec::new(),
            reports: Vec::new(),
            due: None,
            tunings: Vec::new(),
            now: SimTime::ZERO,
            round: 0,
            reported: Vec::new(),
            outcomes: Vec::new(),
            scratch: Scratch::new(),
            party: Party::default(),
        })
    }

    fn noise(&self, spec: &RadioSpec) -> Noise {
        Noise {
            mean: self.config.noise_floor + spec.noise_figure,
            sigma: self.config.noise_sigma,
        }
    }

    /// Tunes a radio in; returns band and row.
    fn join(&mut self, radio: RadioId, spec: &RadioSpec, awake: bool) -> (u32, u32) {
        let noise = self.noise(spec);
        let curve = index_of(
            &mut self.curves,
            |curve| curve.is(&spec.error, noise),
            || Curve::new(Arc::clone(&spec.error), noise),
        );
        let band = index_of(
            &mut self.bands,
            |band| band.channel == spec.channel,
            || Band::new(spec.channel),
        );
        let salt = draw_u64(self.luck, spec.key, u64::MAX) as u32;
        let row = self.bands[band as usize].join(radio.0, spec, curve, salt, awake);
        (band, row)
    }

    /// Does the changes of channel whose time has come.
    fn retune(&mut self) {
        if self.waiting.is_empty() {
            for (id, channel) in std::mem::take(&mut self.tunings) {
                self.move_to(id, channel);
            }
        }
    }

    /// Moves a radio to another band.
    fn move_to(&mut self, id: RadioId, channel: Channel) {
        let spec = RadioSpec {
            channel,
            ..self.spec(id).clone()
        };
        let radio = &self.radios[id.index()];
        let (old, awake) = (radio.band as usize, !radio.ledger.asleep());
        let left_sent = self.bands[old].sent;
        let (follower, reach) = self.bands[old].leave(radio.row);
        radio.book_reach(reach);
        let row = radio.row;
        if let Some(follower) = follower {
            self.radios[follower as usize].row = row;
        }
        let (band, row) = self.join(id, &spec, awake);
        let joined_sent = self.bands[band as usize].sent;
        let radio = &mut self.radios[id.index()];
        radio.turn_over(left_sent, joined_sent);
        (radio.band, radio.row) = (band, row);
        self.specs[id.index()] = spec;
    }

    /// Notes the outcome of a request, if its sender wants to know.
    fn report(&mut self, now: SimTime, request: &Request, result: Result<(), Loss>) {
        if let Some(ticket) = request.ticket {
            self.due = Some(now);
            self.reports
                .push((request.radio, Outcome { ticket, result }));
        }
    }

    /// Puts the waiting frames on the air.
    fn send_waiting(&mut self) {
        for frame in self.waiting.drain(..) {
            let radio = &mut self.radios[frame.radio.index()];
            let length = index_of(
                &mut self.lengths,
                |&bytes| bytes == frame.bytes,
                || frame.bytes,
            );
            radio.presence.own += 1;
            self.bands[radio.band as usize].send(frame, radio.row, length);
        }
        for curve in &mut self.curves {
            curve.prepare(&self.lengths);
        }
    }

    /// Moves the outcomes of the last commit to where inboxes find them.
    fn publish_reports(&mut self, owners: &mut Vec<ModelId>) {
        self.reported.clear();
        self.outcomes.clear();
        // Stable: the outcomes of a radio stay in the order of its requests.
        self.reports.sort_by_key(|&(radio, _)| radio);
        for (radio, outcome) in self.reports.drain(..) {
            owners.push(self.specs[radio.index()].owner);
            self.reported.push(radio);
            self.outcomes.push(outcome);
        }
    }

    fn outcomes(&self, radio: RadioId) -> &[Outcome] {
        let first = self.reported.partition_point(|&r| r < radio);
        let count = self.reported[first..].partition_point(|&r| r == radio);
        &self.outcomes[first..first + count]
    }
}

/// The index of the item that is wanted, after adding it if it is not there.
fn index_of<T>(items: &mut Vec<T>, wanted: impl Fn(&T) -> bool, make: impl FnOnce() -> T) -> u32 {
    let known = items.iter().position(wanted);
    known.unwrap_or_else(|| {
        items.push(make());
        items.len() - 1
    }) as u32
}

impl Medium for SimpleMedium {
    fn add(&mut self, spec: RadioSpec) -> Result<RadioId, RadioError> {
        spec.check()?;
        if !self.keys.insert(spec.key) {
            return Err(RadioError::DuplicateKey { key: spec.key });
        }
        let id = RadioId(self.radios.len() as u32);
        let (band, row) = self.join(id, &spec, true);
        let band_sent = self.bands[band as usize].sent;
        self.radios.push(Radio::new(band, row, band_sent));
        self.specs.push(spec);
        Ok(id)
    }

    fn radios(&self) -> usize {
        self.radios.len()
    }

    fn spec(&self, radio: RadioId) -> &RadioSpec {
        &self.specs[radio.index()]
    }

    fn submit(&mut self, now: SimTime, request: Request) {
        self.retune();
        let spec = &self.specs[request.radio.index()];
        let radio = &mut self.radios[request.radio.index()];
        let bytes = spec.frame_bytes(request.payload.len());
        if radio.ledger.asleep() {
            radio.sent_asleep += 1;
            return self.report(now, &request, Err(Loss::SenderAsleep));
        }
        if request.payload.len() > spec.payload_bytes_max {
            radio.too_long += 1;
            return self.report(now, &request, Err(Loss::TooLong));
        }
        let airtime_ns = (spec.frame_airtime(bytes).secs() * 1e9).round() as u64;
        radio.ledger.transmit(now, airtime_ns);
        let frame = Frame {
            payload: Arc::clone(&request.payload),
            sender: spec.owner,
            radio: request.radio,
            destination: request.destination,
            key: draw_u64(self.luck, spec.key, radio.sent),
            sent: now,
            bytes,
            airtime_ns,
            power_mw: spec.tx_power.milliwatts() as f32,
        };
        radio.sent += 1;
        self.due = Some(now);
        self.waiting.push(frame);
        self.report(now, &request, Ok(()));
    }

    fn command(
        &mut self,
        now: SimTime,
        radio: RadioId,
        command: Command,
    ) -> Result<(), RadioError> {
        self.retune();
        let id = radio;
        let radio = &mut self.radios[id.index()];
        let band = &mut self.bands[radio.band as usize];
        match command {
            Command::Sleep | Command::Wake => {
                let awake = command == Command::Wake;
                if awake == radio.ledger.asleep() {
                    radio.turn_over(band.sent, band.sent);
                    band.set_awake(radio.row, awake);
                    if awake {
                        radio.ledger.wake(now);
                    } else {
                        radio.ledger.sleep(now);
                    }
                }
            }
            Command::Tune(channel) => {
                let spec = self.specs[id.index()].clone();
                RadioSpec { channel, ..spec }.check()?;
                self.tunings.push((id, channel));
            }
            Command::Power { level, current } => {
                let mut spec = self.specs[id.index()].clone();
                let old = std::mem::replace(&mut spec.currents.tx, current);
                spec.tx_power = level;
                spec.check()?;
                radio.ledger.settle(old);
                self.specs[id.index()] = spec;
            }
        }
        Ok(())
    }

    fn next_time(&self) -> Option<SimTime> {
        self.due
    }

    fn open(&mut self, now: SimTime, poses: &dyn Poses, owners: &mut Vec<ModelId>) {
        owners.clear();
        self.now = now;
        self.round += 1;
        self.due = None;
        self.retune();
        self.bands.iter_mut().for_each(Band::clear);
        self.publish_reports(owners);
        if !self.waiting.is_empty() {
            self.send_waiting();
            for index in 0..self.bands.len() {
                let band = &mut self.bands[index];
                let frames = band.air.frames.len();
                if frames == 0 {
                    continue;
                }
                let (range_m, share) = (self.config.range_limit.metres(), self.config.grid_below);
                if frames < band.by_receiver_from(self.config.by_receiver_from) {
                    band.mode = Mode::Delivered;
                    band.place_by_frame(now, poses, range_m, share);
                    self.deliver_by_frame(index, poses, owners);
                } else {
                    band.mode = Mode::ByReceiver;
                    band.place_by_receiver(now, poses, range_m, share);
                    if !band.air.order.is_empty() && self.deliver_by_grid(index, poses, owners) {
                        self.bands[index].mode = Mode::Delivered;
                    } else {
                        self.find_receivers(index, poses, owners);
                    }
                }
            }
        }
        if !owners.is_sorted() {
            owners.sort_unstable();
        }
        owners.dedup();
    }

    fn collect<'a>(
        &'a self,
        id: RadioId,
        poses: &dyn Poses,
        scratch: &'a mut Scratch,
    ) -> Inbox<'a> {
        let radio = &self.radios[id.index()];
        let band = &self.bands[radio.band as usize];
        let hits = match band.mode {
            Mode::Quiet => &[],
            Mode::Delivered => {
                let hits = band.delivered.hits(radio.row);
                let mut heard = Heard::default();
                heard.take_stock(&band.air, hits);
                radio.book(self.round, self.now, &heard);
                hits
            }
            Mode::ByReceiver => {
                let heard = self.hear(radio, poses, scratch, false);
                radio.book(self.round, self.now, &heard);
                &scratch.hits
            }
        };
        Inbox {
            radio: id,
            time: self.now,
            hits,
            frames: &band.air.frames,
            outcomes: self.outcomes(id),
            receiver: self.curves[band.members.curves[radio.row as usize] as usize].receiver(),
            qualities: Qualities::default(),
        }
    }

    fn begun(&self, visit: &mut dyn FnMut(&Frame)) {
        for band in &self.bands {
            band.air.frames.iter().for_each(&mut *visit);
        }
    }

    fn ambient(&self, radio: RadioId) -> PowerLevel {
        self.noise(&self.specs[radio.index()]).mean
    }

    fn state(&self, radio: RadioId, now: SimTime) -> RadioState {
        self.radios[radio.index()].ledger.state(now)
    }

    fn counters(&self, radio: RadioId) -> Counters {
        let radio = &self.radios[radio.index()];
        let band = &self.bands[radio.band as usize];
        radio.counters(band.sent, &band.members)
    }

    fn usage(&self, radio: RadioId, until: SimTime) -> Usage {
        let currents = &self.specs[radio.index()].currents;
        self.radios[radio.index()].ledger.usage(currents, until)
    }
}
