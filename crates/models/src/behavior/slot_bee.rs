//! A bee that sends in a time slot of its own.

use super::walk::Walk;
use crate::net::{Slots, SlotsParams};
use simbeeotic_model::check::{at_least_zero, in_range, positive};
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::radio::{Loss, Outcome, Packet};
use simbeeotic_model::units::{Speed, Time};
use simbeeotic_model::{
    Bee, Behavior, BuildError, Kit, RadioHandle, TimerHandle, behavior, choice, params,
};

/// Bytes that tell when a packet was made.
const STAMP: usize = 8;

/// A bee that has something to tell once a period, all bees at once, and broadcasts it at once or in a
/// time slot of its own: see [`Slots`].
///
/// For each packet that reaches it, it publishes the metric `latency`, the time since the packet was
/// made.
#[behavior("slot-bee")]
pub struct SlotBee {
    access: Access,
    walk: Walk,
    radio: RadioHandle,
    slots: Slots<Vec<u8>>,
    timer: TimerHandle,
    bytes: usize,
    made: u64,
    heard: u64,
    sent: u64,
    busy: u64,
}

/// When it sends.
#[choice]
pub enum Access {
    /// In its own time slot.
    Slots,
    /// At once: the medium has the last word.
    AtOnce,
}

/// Parameters of [`SlotBee`].
#[params]
pub struct SlotBeeParams {
    /// Top speed of its walk. Zero: it stays where it is.
    pub max_speed: Speed,
    /// Time between packets.
    pub period: Time,
    /// Bytes of a packet, 8 to 65,535; the first 8 are the time.
    pub bytes: u16,
    /// When it sends.
    pub access: Access,
    /// The time slots.
    pub slots: SlotsParams,
}

impl Default for SlotBeeParams {
    fn default() -> Self {
        Self {
            max_speed: Speed::si(1.0),
            period: Time::si(1.0),
            bytes: 20,
            access: Access::Slots,
            slots: SlotsParams::default(),
        }
    }
}

impl Behavior for SlotBee {
    type Params = SlotBeeParams;

    fn build(params: SlotBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("max_speed", params.max_speed)?;
        positive("period", params.period)?;
        in_range("bytes", params.bytes, STAMP as u16..=u16::MAX)?;
        kit.every(params.period, Self::tell);
        kit.on_sent(Self::note);
        Ok(Self {
            access: params.access,
            walk: Walk::up_to(params.max_speed),
            radio: kit.radio()?,
            slots: Slots::new(params.slots, kit.id(), kit.path())?,
            timer: kit.timer(Self::send),
            bytes: usize::from(params.bytes),
            made: 0,
            heard: 0,
            sent: 0,
            busy: 0,
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        self.walk.step(bee);
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        if let Some(stamp) = packet.payload().first_chunk::<STAMP>() {
            let made = SimTime::from_nanos(u64::from_le_bytes(*stamp));
            let latency = bee.now() - made;
            bee.metric("latency", latency.secs(), "s");
            self.heard += 1;
        }
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        bee.log(format!(
            "made {} packets: {} sent, {} gave up at a busy channel, {} refused, {} wait; heard {}",
            self.made,
            self.sent,
            self.busy,
            self.slots.counters().refused,
            self.slots.waiting(),
            self.heard,
        ));
    }
}

impl SlotBee {
    fn tell(&mut self, bee: &mut Bee<'_>) {
        self.made += 1;
        let mut packet = vec![0; self.bytes];
        packet[..STAMP].copy_from_slice(&bee.now().nanos().to_le_bytes());
        match self.access {
            Access::AtOnce => _ = bee.send(self.radio, &packet),
            Access::Slots => {
                self.slots.push(packet);
                self.wait(bee);
            }
        }
    }

    /// Its slot has come.
    fn send(&mut self, bee: &mut Bee<'_>) {
        if let Some(packet) = self.slots.pop(bee.now()) {
            bee.send(self.radio, &packet);
        }
        if self.slots.waiting() > 0 {
            self.wait(bee);
        }
    }

    fn wait(&mut self, bee: &mut Bee<'_>) {
        if bee.next_firing(self.timer).is_none() {
            let wait = self.slots.wait(bee.now());
            bee.arm(self.timer, wait);
        }
    }

    /// What became of a packet.
    fn note(&mut self, outcome: &Outcome, _bee: &mut Bee<'_>) {
        match outcome.result {
            Ok(()) => self.sent += 1,
            Err(Loss::ChannelBusy) => self.busy += 1,
            Err(_) => {}
        }
    }
}
