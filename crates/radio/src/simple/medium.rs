//! The simple medium at work.
//!
//! # Changing the channel
//!
//! Sending and receiving are settled apart. A frame goes out on the channel that its radio was last tuned
//! to when it was asked for, whatever the radio is told later. What a radio hears is decided when the
//! round opens: from the round of the instant of its `Tune` on it hears all frames of its new channel and
//! none of its old one, also those that others asked for before. Both hang on the radio's own commands and
//! on the frame alone, not on who else was asked before or after.
//!
//! So a radio may have frames to send on a channel that it has left. For their round it has a second row
//! there, as a guest who hears nothing.

use super::SimpleConfig;
use super::band::{Band, Mode};
use super::chance::Chances;
use super::pair::Reach;
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
    /// Frames for the next round, with the bands they go out on, and outcomes.
    waiting: Vec<(u32, Frame)>,
    reports: Vec<(RadioId, Outcome)>,
    due: Option<SimTime>,
    /// Radios that were tuned, and hear on their new channels from the next round on.
    tuned: Vec<RadioId>,
    /// Band and row of radios that send in this round where they do not listen, in the order of joining.
    guests: Vec<(u32, u32)>,
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
            tuned: Vec::new(),
            guests: Vec::new(),
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

    /// The band of a channel, after making it if it is new.
    fn band_of(&mut self, channel: Channel) -> u32 {
        index_of(
            &mut self.bands,
            |band| band.channel == channel,
            || Band::new(channel),
        )
    }

    /// Gives a radio a row in a band.
    fn join(&mut self, radio: RadioId, spec: &RadioSpec, band: u32, awake: bool) -> u32 {
        let noise = self.noise(spec);
        let curve = index_of(
            &mut self.curves,
            |curve| curve.is(&spec.error, noise),
            || Curve::new(Arc::clone(&spec.error), noise),
        );
        let salt = draw_u64(self.luck, spec.key, u64::MAX) as u32;
        self.bands[band as usize].join(radio.0, spec, curve, salt, awake)
    }

    /// Takes a row away, and tells the radio that has it now.
    fn leave(&mut self, band: u32, row: u32) -> Reach {
        let (follower, reach) = self.bands[band as usize].leave(row);
        if let Some(follower) = follower {
            self.radios[follower as usize].row = row;
        }
        reach
    }

    /// Brings those who were tuned to where they hear from now on.
    fn retune(&mut self) {
        // The last to come is the first to go: no guest is on the row of another.
        while let Some((band, row)) = self.guests.pop() {
            self.leave(band, row);
        }
        for id in std::mem::take(&mut self.tuned) {
            self.move_to(id, self.radios[id.index()].sends_on);
        }
    }

    /// Moves a radio to another band.
    fn move_to(&mut self, id: RadioId, band: u32) {
        let radio = &self.radios[id.index()];
        let (old, row, awake) = (radio.band, radio.row, !radio.ledger.asleep());
        if old == band {
            return;
        }
        let reach = self.leave(old, row);
        let spec = self.specs[id.index()].clone();
        let row = self.join(id, &spec, band, awake);
        let sent = [old, band].map(|band| self.bands[band as usize].sent);
        let radio = &mut self.radios[id.index()];
        radio.book_reach(reach);
        radio.turn_over(sent[0], sent[1]);
        (radio.band, radio.row) = (band, row);
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
        let mut waiting = std::mem::take(&mut self.waiting);
        for (band, frame) in waiting.drain(..) {
            let length = index_of(
                &mut self.lengths,
                |&bytes| bytes == frame.bytes,
                || frame.bytes,
            );
            let radio = &mut self.radios[frame.radio.index()];
            let row = if radio.band == band {
                radio.presence.own += 1;
                radio.row
            } else {
                self.guest_row(frame.radio, band)
            };
            self.bands[band as usize].send(frame, row, length);
        }
        self.waiting = waiting;
        for curve in &mut self.curves {
            curve.prepare(&self.lengths);
        }
    }

    /// The row of a radio that sends where it does not listen.
    fn guest_row(&mut self, id: RadioId, band: u32) -> u32 {
        // A radio's frames mostly come one after the other. A second row would do no harm.
        if let Some(&(last_band, row)) = self.guests.last()
            && last_band == band
            && self.bands[band as usize].members.columns.radios[row as usize] == id.0
        {
            return row;
        }
        let spec = self.specs[id.index()].clone();
        let row = self.join(id, &spec, band, false);
        self.guests.push((band, row));
        row
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
        let band = self.band_of(spec.channel);
        let row = self.join(id, &spec, band, true);
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
        self.waiting.push((radio.sends_on, frame));
        self.report(now, &request, Ok(()));
    }

    fn command(
        &mut self,
        now: SimTime,
        radio: RadioId,
        command: Command,
    ) -> Result<(), RadioError> {
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
                let spec = RadioSpec { channel, ..spec };
                spec.check()?;
                self.specs[id.index()] = spec;
                let band = self.band_of(channel);
                self.radios[id.index()].sends_on = band;
                self.tuned.push(id);
            }
            Command::Power { level, current } => {
                let before = self.specs[id.index()].set_power(level, current)?;
                radio.ledger.settle(before);
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

    fn begun(&self, visit: &mut dyn FnMut(&Frame, Channel)) {
        for band in &self.bands {
            for frame in &band.air.frames {
                visit(frame, band.channel);
            }
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
