//! On the air: what radios send, receive and acknowledge.

use super::act::space;
use super::agenda::Kind;
use super::air::{OnAir, Reception};
use super::mac::{AckTiming, Ear, Flight, Phase, Sent, airtime_ns};
use super::medium::Ieee802154Medium;
use crate::counters::Loss;
use crate::frame::Frame;
use crate::medium::Poses;
use crate::radio::RadioId;
use simbeeotic_kernel::rng::draw_u64;
use simbeeotic_kernel::{ModelId, SimTime};
use simbeeotic_units::Time;
use std::sync::Arc;

impl Ieee802154Medium {
    pub(super) fn send(&mut self, id: u32, now_ns: u64, poses: &dyn Poses) {
        let (spec, radio) = (&self.specs[id as usize], &mut self.radios[id as usize]);
        let Some(job) = radio.jobs.front() else {
            return;
        };
        let bytes = spec.frame_bytes(job.payload.len());
        let frame = Frame {
            payload: Arc::clone(&job.payload),
            sender: spec.owner,
            radio: RadioId(id),
            destination: job.destination,
            key: draw_u64(self.luck, spec.key, radio.books.sent),
            sent: SimTime::from_nanos(now_ns),
            bytes,
            airtime_ns: airtime_ns(spec, bytes),
            power_mw: spec.tx_power.milliwatts() as f32,
        };
        if radio.retries == 0 {
            self.statistics.transmitted += 1;
            self.statistics.delay += Time::si((now_ns - job.submitted_ns) as f64 * 1e-9);
        }
        radio.books.sent += 1;
        radio.phase = Phase::Sending;
        radio.awaited = (frame.key, bytes);
        let acks = radio.timing.acks.filter(|_| frame.destination.is_some());
        let (key, airtime_ns, sequence) = (frame.key, frame.airtime_ns, job.sequence);
        self.begun.push(frame.clone());
        let what = Sent::Data {
            frame,
            sequence,
            acks,
        };
        self.launch(id, now_ns, key, airtime_ns, what, poses);
    }

    pub(super) fn send_ack(&mut self, id: u32, now_ns: u64, poses: &dyn Poses) {
        let (spec, radio) = (&self.specs[id as usize], &mut self.radios[id as usize]);
        let Some((of, bytes)) = radio.acking else {
            return;
        };
        let airtime_ns = airtime_ns(spec, bytes);
        // Named by the frame and the radio that answers.
        let key = draw_u64(of, spec.key, 1);
        self.launch(id, now_ns, key, airtime_ns, Sent::Ack { of }, poses);
    }

    /// Puts a frame on the air.
    fn launch(
        &mut self,
        id: u32,
        now_ns: u64,
        key: u64,
        airtime_ns: u64,
        what: Sent,
        poses: &dyn Poses,
    ) {
        self.hear(id, now_ns, Ear::Deaf);
        self.next_id = self.next_id.wrapping_add(1).max(1);
        let (now, counted) = (
            SimTime::from_nanos(now_ns),
            matches!(what, Sent::Data { .. }),
        );
        let (spec, radio) = (&self.specs[id as usize], &mut self.radios[id as usize]);
        radio.ledger.transmit(now, airtime_ns);
        radio.ear_token = radio.ear_token.wrapping_add(1);
        radio.flight = Some(Box::new(Flight {
            id: self.next_id,
            what,
        }));
        let (token, row) = (radio.ear_token, radio.row as usize);
        let at = radio.band as usize;
        if counted {
            radio.presence.own += 1;
            self.bands[at].started += 1;
        }
        let band = &mut self.bands[at];
        band.members.place(now, poses);
        let power_mw = spec.tx_power.milliwatts() as f32;
        let source = band.members.source(row, key, power_mw, now);
        let mut powers_mw = self.spare.pop().unwrap_or_default();
        powers_mw.clear();
        powers_mw.resize(band.members.radios.len(), 0.0);
        let space = space(&self.config, band);
        let rows = 0..powers_mw.len();
        band.members
            .powers(&source, rows, &space, poses, counted, &mut powers_mw);
        let frame = OnAir {
            id: self.next_id,
            key,
            modulation: self.radios[id as usize].modulation,
            start_ns: now_ns,
            counted,
            source,
            powers_mw,
        };
        self.look(at, now_ns, false);
        self.bands[at].air.start(frame);
        self.look(at, now_ns, true);
        self.push(now_ns + airtime_ns, Kind::TxEnd, id, token, false);
    }

    /// Those who assess a channel see its power before or after it changes.
    fn look(&mut self, band: usize, now_ns: u64, changed: bool) {
        let band = &self.bands[band];
        for &id in &band.sensing {
            let radio = &mut self.radios[id as usize];
            let total_mw = band.air.total_mw(radio.row as usize);
            match changed {
                false => radio.assessment.see(now_ns, total_mw),
                true => radio.assessment.peak_mw = radio.assessment.peak_mw.max(total_mw),
            }
        }
    }

    /// A frame has left the antenna.
    pub(super) fn land(&mut self, id: u32, now_ns: u64) {
        let radio = &mut self.radios[id as usize];
        let Some(flight) = radio.flight.take() else {
            return;
        };
        let at = radio.band as usize;
        self.look(at, now_ns, false);
        let mut receptions = std::mem::take(&mut self.receptions);
        receptions.clear();
        let room = self.bands[at].air.end(flight.id, now_ns, &mut receptions);
        self.spare.push(room);
        match flight.what {
            Sent::Data {
                frame,
                sequence,
                acks,
            } => {
                let bytes = frame.bytes;
                self.deliver(at, now_ns, frame, sequence, acks, &receptions);
                self.done_sending(id, now_ns, bytes, acks);
            }
            Sent::Ack { of } => {
                self.radios[id as usize].acking = None;
                self.take_acks(at, now_ns, of, &receptions);
            }
        }
        self.receptions = receptions;
        let radio = &self.radios[id as usize];
        if radio.drowsy {
            self.fall_asleep(id, now_ns);
        } else {
            let (back_ns, token) = (now_ns + radio.timing.turnaround_ns, radio.ear_token);
            self.push(back_ns, Kind::RxOn, id, token, false);
        }
    }

    /// What a sender does when its frame has left.
    fn done_sending(&mut self, id: u32, now_ns: u64, bytes: usize, acks: Option<AckTiming>) {
        let radio = &mut self.radios[id as usize];
        match acks {
            Some(acks) => {
                radio.phase = Phase::AwaitingAck;
                let token = radio.void();
                self.push(now_ns + acks.wait_ns, Kind::Timeout, id, token, false);
            }
            None => {
                let free_ns = now_ns + radio.timing.spacing_ns(bytes);
                self.finish(id, now_ns, free_ns, Ok(()));
            }
        }
    }

    /// Listens again after sending.
    pub(super) fn turn_to_listen(&mut self, id: u32, now_ns: u64) {
        let radio = &self.radios[id as usize];
        if radio.flight.is_some() || radio.acking.is_some() || radio.phase == Phase::Turning {
            return;
        }
        self.hear(id, now_ns, Ear::Listening);
        if self.radios[id as usize].phase == Phase::Held {
            self.access(id, now_ns, now_ns);
        }
    }

    /// Hands a frame to those who received it.
    fn deliver(
        &mut self,
        band: usize,
        now_ns: u64,
        frame: Frame,
        sequence: u64,
        acks: Option<AckTiming>,
        receptions: &[Reception],
    ) {
        let (destination, key) = (frame.destination, frame.key);
        let sender = self.specs[frame.radio.index()].key;
        self.mail.frames.push(frame);
        let Some(destination) = destination else {
            // Touches no radio: what each received follows from the books of the air.
            let radios = &self.bands[band].members.radios;
            for reception in receptions {
                if let Some(id) = radios[reception.row as usize] {
                    self.mail.note(id, reception);
                }
            }
            return;
        };
        // Of several radios of one owner, one answers: that of the least key, whatever their order.
        let radios = &self.bands[band].members.radios;
        let ids = receptions.iter().filter_map(|r| radios[r.row as usize]);
        let own = ids.filter(|&id| self.specs[id as usize].owner == destination);
        let able = own.filter(|&id| self.radios[id as usize].timing.acks.is_some());
        let answers = able.min_by_key(|&id| self.specs[id as usize].key);
        for reception in receptions {
            let Some(id) = self.bands[band].members.radios[reception.row as usize] else {
                continue;
            };
            let acks = acks.filter(|_| answers == Some(id));
            if self.address(id, now_ns, destination, [key, sender, sequence], acks) {
                self.mail.note(id, reception);
            }
        }
    }

    /// What a radio does with a frame to somebody in particular; whether it is for its owner, and new.
    /// A frame has a key, its sender one of its own, and a sequence number.
    fn address(
        &mut self,
        id: u32,
        now_ns: u64,
        destination: ModelId,
        [key, sender, sequence]: [u64; 3],
        acks: Option<AckTiming>,
    ) -> bool {
        let radio = &mut self.radios[id as usize];
        if destination != self.specs[id as usize].owner {
            radio.books.overheard += 1;
            return false;
        }
        let again = radio.last_from.insert(sender, sequence) == Some(sequence);
        radio.books.repeated += u64::from(again);
        if let Some(acks) = acks.filter(|_| radio.timing.acks.is_some()) {
            radio.acking = Some((key, acks.bytes));
            let token = radio.ear_token;
            self.hear(id, now_ns, Ear::Deaf);
            self.push(now_ns + acks.delay_ns, Kind::AckStart, id, token, false);
        }
        !again
    }

    /// Whoever waited for this acknowledgement has it.
    fn take_acks(&mut self, band: usize, now_ns: u64, of: u64, receptions: &[Reception]) {
        for reception in receptions {
            let Some(id) = self.bands[band].members.radios[reception.row as usize] else {
                continue;
            };
            let radio = &self.radios[id as usize];
            if radio.phase == Phase::AwaitingAck && radio.awaited.0 == of {
                let free_ns = now_ns + radio.timing.spacing_ns(radio.awaited.1);
                self.finish(id, now_ns, free_ns, Ok(()));
            }
        }
    }

    pub(super) fn miss_ack(&mut self, id: u32, now_ns: u64) {
        let radio = &mut self.radios[id as usize];
        let retries = radio.timing.acks.map_or(0, |acks| acks.retries);
        if radio.retries < retries {
            radio.retries += 1;
            self.access(id, now_ns, now_ns);
        } else {
            let free_ns = radio.free_ns;
            self.finish(id, now_ns, free_ns, Err(Loss::NoAcknowledgement));
        }
    }
}
