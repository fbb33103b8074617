//! What radios do until they send: take a place in a channel, wait for it, assess it. See `exchange` for the rest.

use super::agenda::{Event, Kind};
use super::air::{Air, Modulation, Receiver};
use super::exact::ExactAir;
use super::fast::FastAir;
use super::mac::{Assessment, Ear, Phase};
use super::medium::Ieee802154Medium;
use super::members::{Members, Space};
use super::{Arithmetic, Ieee802154Config, Quirks};
use crate::channel::Channel;
use crate::counters::Loss;
use crate::medium::Poses;
use crate::phy::CcaMode;
use crate::radio::RadioId;
use simbeeotic_kernel::SimTime;
use simbeeotic_kernel::rng::draw_u64;
use std::sync::Arc;

/// One channel: its radios, and what is on the air.
#[derive(Debug)]
pub(super) struct Band {
    channel: Channel,
    pub(super) members: Members,
    pub(super) air: Box<dyn Air>,
    /// Frames that ever began here; acknowledgements do not count.
    pub(super) started: u64,
    /// Radios that assess the channel.
    pub(super) sensing: Vec<u32>,
    /// Modulations that the air knows.
    known: usize,
}

impl Band {
    fn new(channel: Channel, config: &Ieee802154Config) -> Self {
        let air: Box<dyn Air> = match config.arithmetic {
            Arithmetic::Fast => Box::new(FastAir::new(config.quirks)),
            Arithmetic::Exact => Box::new(ExactAir::new(config.quirks)),
        };
        Self {
            channel,
            members: Members::default(),
            air,
            started: 0,
            sensing: Vec::new(),
            known: 0,
        }
    }

    fn stop_sensing(&mut self, radio: u32) {
        self.sensing.retain(|&r| r != radio);
    }
}

/// What decides how strong a frame arrives in a band.
pub(super) fn space<'a>(config: &'a Ieee802154Config, band: &Band) -> Space<'a> {
    let range_m = config.range_limit.map_or(f64::INFINITY, |r| r.metres()) as f32;
    Space {
        propagation: config.propagation.as_ref(),
        frequency: band.channel.centre,
        range_squared_m2: range_m * range_m,
        walls: config.walls,
    }
}

// Places in the band.
impl Ieee802154Medium {
    /// Puts a radio on its channel; it does not listen yet.
    pub(super) fn join(&mut self, id: RadioId) {
        let spec = &self.specs[id.index()];
        let modulation = Modulation {
            errors: Arc::clone(&spec.phy.bits),
            ns_per_bit: 1e9 / spec.data_rate.get(),
        };
        let known = self.modulations.iter().position(|m| m.is(&modulation));
        let modulation = known.unwrap_or_else(|| {
            self.modulations.push(modulation);
            self.modulations.len() - 1
        });
        let band = self.bands.iter().position(|b| b.channel == spec.channel);
        let at = band.unwrap_or_else(|| {
            self.bands.push(Band::new(spec.channel, &self.config));
            self.bands.len() - 1
        });
        let band = &mut self.bands[at];
        for modulation in &self.modulations[band.known..] {
            band.air.learn(modulation);
        }
        band.known = self.modulations.len();
        let row = band.members.join(id.0, spec);
        let sensitivity_mw = spec.phy.sensitivity.map_or(0.0, |s| s.milliwatts());
        let receiver = Receiver {
            noise_mw: spec.phy.noise.milliwatts() as f32,
            sensitivity_mw: sensitivity_mw as f32,
            lock: spec.phy.lock.ratio() as f32,
            modulation: modulation as u32,
            co_channel: spec.phy.co_channel.ratio() as f32,
            salt: draw_u64(self.luck, spec.key, u64::MAX) as u32,
        };
        band.air.join(row, receiver);
        let radio = &mut self.radios[id.index()];
        (radio.band, radio.row) = (at as u32, row as u32);
        radio.modulation = modulation as u32;
        radio.ear = Ear::Asleep;
        radio.presence.begin(band.started);
    }

    /// Does the changes of channel whose time has come, and begins with what waited for them.
    pub(super) fn retune(&mut self, now: SimTime, poses: &dyn Poses) {
        if self.tunings.is_empty() {
            return;
        }
        let mut waiting = std::mem::take(&mut self.tunings);
        waiting.retain(|&id| {
            let mut tuned = false;
            while let radio = &mut self.radios[id.index()]
                && radio.flight.is_none()
                && radio.tunes_next()
                && let Some((_, channel)) = radio.tunings.pop_front()
            {
                tuned = true;
                if self.specs[id.index()].channel != channel {
                    self.move_to(id, channel, now, poses);
                }
            }
            let radio = &self.radios[id.index()];
            if tuned && radio.phase == Phase::Free && !radio.jobs.is_empty() {
                self.begin(id.0, now.nanos());
            }
            !self.radios[id.index()].tunings.is_empty()
        });
        self.tunings = waiting;
    }

    fn move_to(&mut self, id: RadioId, channel: Channel, now: SimTime, poses: &dyn Poses) {
        let now_ns = now.nanos();
        let radio = &mut self.radios[id.index()];
        let mut ear = radio.ear;
        if radio.acking.take().is_some() {
            // The acknowledgement belonged to the old channel.
            radio.ear_token = radio.ear_token.wrapping_add(1);
            ear = Ear::Listening;
        }
        let (row, old) = (radio.row as usize, radio.band as usize);
        self.hear(id.0, now_ns, Ear::Asleep);
        let band = &mut self.bands[old];
        band.stop_sensing(id.0);
        let (tally, beyond) = (band.air.tally(row), band.members.beyond[row]);
        band.members.leave(row);
        let radio = &mut self.radios[id.index()];
        radio.presence = radio.presence.closed(Ear::Asleep, band.started, 0);
        radio.keep(tally, beyond);
        self.specs[id.index()].channel = channel;
        self.join(id);

        // What is on the air there already reaches it.
        let radio = &self.radios[id.index()];
        let row = radio.row as usize;
        let band = &mut self.bands[radio.band as usize];
        let space = space(&self.config, band);
        if !band.air.frames().is_empty() {
            band.members.place(now, poses);
        }
        for frame in 0..band.air.frames().len() {
            let source = band.air.frames()[frame].source.clone();
            let mut power = [0.0];
            let rows = row..row + 1;
            band.members
                .powers(&source, rows, &space, poses, false, &mut power);
            band.air.reveal(row, frame, power[0]);
        }
        self.hear(id.0, now_ns, ear);
    }

    /// Changes whether a radio hears; it gives up the frame that it is taking in.
    pub(super) fn hear(&mut self, id: u32, now_ns: u64, ear: Ear) {
        let radio = &mut self.radios[id as usize];
        if radio.ear == ear {
            return;
        }
        let band = &mut self.bands[radio.band as usize];
        radio.presence = radio.presence.closed(radio.ear, band.started, band.started);
        let heard = (radio.ear == Ear::Listening, ear == Ear::Listening);
        radio.ear = ear;
        if heard.0 != heard.1 {
            band.members.listening[radio.row as usize] = heard.1;
            let dropped = band.air.listen(radio.row as usize, now_ns, heard.1);
            let counted = dropped.is_some_and(|taking| taking.counted);
            radio.dropped_asleep += u64::from(counted && ear == Ear::Asleep);
        }
    }

    /// Falls asleep: whatever it was about to send is given up.
    pub(super) fn fall_asleep(&mut self, id: u32, now_ns: u64) {
        let radio = &mut self.radios[id as usize];
        radio.void();
        radio.ear_token = radio.ear_token.wrapping_add(1);
        radio.acking = None;
        radio.drowsy = false;
        let phase = std::mem::take(&mut radio.phase);
        let jobs = std::mem::take(&mut radio.jobs);
        self.bands[radio.band as usize].stop_sensing(id);
        for (at, job) in jobs.iter().enumerate() {
            let loss = match phase {
                Phase::AwaitingAck if at == 0 => Loss::NoAcknowledgement,
                _ => Loss::SenderAsleep,
            };
            self.radios[id as usize].books.lose(loss, 1);
            self.report(id, job, Err(loss));
        }
        self.hear(id, now_ns, Ear::Asleep);
        let radio = &mut self.radios[id as usize];
        radio.ledger.sleep(SimTime::from_nanos(now_ns));
    }
}

// The way to the channel.
impl Ieee802154Medium {
    pub(super) fn push(&mut self, time_ns: u64, kind: Kind, id: u32, token: u32, prompt: bool) {
        let key = self.specs[id as usize].key;
        let event = Event {
            time_ns,
            kind,
            key,
            radio: id,
            token,
        };
        self.agenda.push(event, prompt);
    }

    /// Does what an event says, unless it is void.
    pub(super) fn act(&mut self, event: Event, poses: &dyn Poses) {
        let (id, now_ns) = (event.radio, event.time_ns);
        let radio = &self.radios[id as usize];
        let token = match event.kind {
            Kind::RxOn | Kind::TxEnd | Kind::AckStart => radio.ear_token,
            _ => radio.token,
        };
        if event.token != token {
            return;
        }
        match event.kind {
            Kind::TxEnd => self.land(id, now_ns),
            Kind::RxOn => self.turn_to_listen(id, now_ns),
            Kind::Timeout => self.miss_ack(id, now_ns),
            Kind::CcaStart => self.begin_sensing(id, now_ns),
            Kind::CcaEnd => self.decide(id, now_ns),
            Kind::AckStart => self.send_ack(id, now_ns, poses),
            Kind::TxStart => self.send(id, now_ns, poses),
        }
    }

    /// Begins with the job at the front of the queue.
    pub(super) fn begin(&mut self, id: u32, now_ns: u64) {
        let radio = &mut self.radios[id as usize];
        radio.retries = 0;
        let from_ns = now_ns.max(radio.free_ns);
        self.access(id, now_ns, from_ns);
    }

    /// Sets out for the channel, no earlier than `from_ns`: with CSMA, or at once.
    pub(super) fn access(&mut self, id: u32, now_ns: u64, from_ns: u64) {
        let radio = &mut self.radios[id as usize];
        if let Some(csma) = radio.timing.csma {
            (radio.busy, radio.exponent) = (0, csma.min_be);
            return self.back_off(id, from_ns);
        }
        if radio.acking.is_some() {
            radio.phase = Phase::Held;
        } else if from_ns > now_ns {
            radio.phase = Phase::Backoff;
            let token = radio.void();
            self.push(from_ns, Kind::CcaStart, id, token, true);
        } else {
            let turnaround_ns = match radio.ear {
                Ear::Listening => radio.timing.turnaround_ns,
                _ => 0,
            };
            self.turn_to_send(id, now_ns, turnaround_ns);
        }
    }

    fn back_off(&mut self, id: u32, from_ns: u64) {
        let radio = &mut self.radios[id as usize];
        let Some(csma) = radio.timing.csma else {
            return;
        };
        let key = self.specs[id as usize].key;
        let draw = draw_u64(self.backoff_luck, key, radio.backoffs);
        radio.backoffs += 1;
        let units = draw & ((1 << radio.exponent) - 1);
        radio.phase = Phase::Backoff;
        let token = radio.void();
        let start_ns = from_ns + units * csma.unit_ns;
        let end_ns = start_ns + radio.timing.cca_ns;
        // Whoever waits for the outcome of the last attempt is told when it ends.
        let ticket = radio.jobs.front().is_some_and(|job| job.ticket.is_some());
        let prompt = ticket && radio.busy >= csma.max_backoffs;
        self.push(start_ns, Kind::CcaStart, id, token, false);
        self.push(end_ns, Kind::CcaEnd, id, token, prompt);
    }

    fn begin_sensing(&mut self, id: u32, now_ns: u64) {
        let radio = &mut self.radios[id as usize];
        if radio.timing.csma.is_none() {
            return self.access(id, now_ns, now_ns);
        }
        radio.phase = Phase::Sensing;
        radio.assessment = Assessment::begin(now_ns);
        self.bands[radio.band as usize].sensing.push(id);
    }

    /// Whether a radio at the end of its assessment finds the channel busy.
    fn finds_busy(&mut self, id: u32, now_ns: u64) -> bool {
        let radio = &mut self.radios[id as usize];
        let (band, row) = (&self.bands[radio.band as usize], radio.row as usize);
        let (timing, total_mw) = (radio.timing, band.air.total_mw(row));
        radio.assessment.see(now_ns, total_mw);
        let level_mw = match self.config.quirks {
            Quirks::Ns3 => radio.assessment.peak_mw.max(total_mw),
            Quirks::None => timing.noise_mw + radio.assessment.mean_mw(timing.cca_ns, total_mw),
        };
        let energy = level_mw >= timing.busy_mw;
        let carrier = band.air.taking(row).is_some();
        let busy = match timing.cca_mode {
            CcaMode::Energy => energy,
            CcaMode::Carrier => carrier,
            CcaMode::Both => energy || carrier,
        };
        busy || radio.ear != Ear::Listening
    }

    /// The end of an assessment: send, wait again or give up.
    fn decide(&mut self, id: u32, now_ns: u64) {
        let busy = self.finds_busy(id, now_ns);
        let radio = &mut self.radios[id as usize];
        self.bands[radio.band as usize].stop_sensing(id);
        let Some(csma) = radio.timing.csma else {
            return;
        };
        if !busy {
            let turnaround_ns = radio.timing.turnaround_ns;
            return self.turn_to_send(id, now_ns, turnaround_ns);
        }
        radio.busy += 1;
        radio.exponent = (radio.exponent + 1).min(csma.max_be);
        if radio.busy > csma.max_backoffs {
            self.statistics.failures += 1;
            let free_ns = radio.free_ns;
            self.finish(id, now_ns, free_ns, Err(Loss::ChannelBusy));
        } else {
            self.back_off(id, now_ns);
        }
    }

    fn turn_to_send(&mut self, id: u32, now_ns: u64, turnaround_ns: u64) {
        let radio = &mut self.radios[id as usize];
        radio.phase = Phase::Turning;
        let token = radio.void();
        if turnaround_ns > 0 {
            self.hear(id, now_ns, Ear::Deaf);
        }
        self.push(now_ns + turnaround_ns, Kind::TxStart, id, token, false);
    }

    /// The job at the front is done with.
    pub(super) fn finish(&mut self, id: u32, now_ns: u64, free_ns: u64, result: Result<(), Loss>) {
        let radio = &mut self.radios[id as usize];
        radio.phase = Phase::Free;
        radio.void();
        radio.free_ns = free_ns;
        let Some(job) = radio.jobs.pop_front() else {
            return;
        };
        if let Err(loss) = result {
            radio.books.lose(loss, 1);
        }
        let more = !radio.jobs.is_empty();
        self.report(id, &job, result);
        let radio = &self.radios[id as usize];
        if more && !radio.drowsy && !radio.tunes_next() {
            self.begin(id, now_ns);
        }
    }
}
