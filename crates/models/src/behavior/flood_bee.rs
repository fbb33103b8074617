//! A bee that spreads messages through a swarm.

use super::walk::Walk;
use crate::net::{Flood, FloodParams, Heard};
use simbeeotic_model::check::{at_least_zero, in_range};
use simbeeotic_model::kernel::SimTime;
use simbeeotic_model::radio::Packet;
use simbeeotic_model::units::{Speed, Time};
use simbeeotic_model::{
    Bee, Behavior, BuildError, Kit, RadioHandle, TimerHandle, behavior, params,
};

/// Bytes that tell when a message began.
const STAMP: usize = 8;

/// A bee that wanders, says something once a period, and sends on what it hears from others, so that it
/// reaches everybody: see [`Flood`].
///
/// For each message that reaches it, it publishes the metrics `latency`, the time since the origin sent
/// it, and `hops`, how often it was sent until it came here.
#[behavior("flood-bee")]
pub struct FloodBee {
    walk: Walk,
    radio: RadioHandle,
    flood: Flood,
    timer: TimerHandle,
    message: Vec<u8>,
}

/// Parameters of [`FloodBee`].
#[params]
pub struct FloodBeeParams {
    /// Top speed of its walk. Zero: it stays where it is.
    pub max_speed: Speed,
    /// Time between messages of its own. Zero: it has none, and only sends on.
    pub period: Time,
    /// When it has its first.
    pub first: Time,
    /// Bytes of its messages, 8 to 65,535; the first 8 are the time.
    pub bytes: u16,
    /// How messages are sent on.
    pub flood: FloodParams,
}

impl Default for FloodBeeParams {
    fn default() -> Self {
        Self {
            max_speed: Speed::si(1.0),
            period: Time::ZERO,
            first: Time::ZERO,
            bytes: 20,
            flood: FloodParams::default(),
        }
    }
}

impl Behavior for FloodBee {
    type Params = FloodBeeParams;

    fn build(params: FloodBeeParams, kit: &mut Kit<Self>) -> Result<Self, BuildError> {
        at_least_zero("max_speed", params.max_speed)?;
        at_least_zero("period", params.period)?;
        at_least_zero("first", params.first)?;
        in_range("bytes", params.bytes, STAMP as u16..=u16::MAX)?;
        if params.period > Time::ZERO {
            kit.every_from(params.first, params.period, Self::speak);
        }
        Ok(Self {
            walk: Walk::up_to(params.max_speed),
            radio: kit.radio()?,
            timer: kit.timer(Self::send_on),
            flood: Flood::new(params.flood, kit.stream("flood"))?,
            message: vec![0; usize::from(params.bytes)],
        })
    }

    fn on_control(&mut self, bee: &mut Bee<'_>) {
        self.walk.step(bee);
    }

    fn on_packet(&mut self, packet: &Packet<'_>, bee: &mut Bee<'_>) {
        if let Some(new) = self.flood.hear(bee.id(), Heard::from(packet)) {
            if let Some(stamp) = new.message.first_chunk::<STAMP>() {
                let sent = SimTime::from_nanos(u64::from_le_bytes(*stamp));
                let latency = bee.now() - sent;
                bee.metric("latency", latency.secs(), "s");
            }
            bee.metric("hops", f64::from(new.hops), "1");
            self.wait(bee);
        }
    }

    fn on_finish(&mut self, bee: &mut Bee<'_>) {
        let all = self.flood.counters();
        bee.log(format!(
            "{} of its own, {} of others and {} copies of them; {} sent on, {} suppressed",
            all.originated, all.delivered, all.duplicates, all.forwarded, all.suppressed
        ));
    }
}

impl FloodBee {
    fn speak(&mut self, bee: &mut Bee<'_>) {
        let stamp = bee.now().nanos().to_le_bytes();
        self.message[..STAMP].copy_from_slice(&stamp);
        let packet = self.flood.originate(bee.id(), &self.message);
        bee.send(self.radio, &packet);
    }

    fn send_on(&mut self, bee: &mut Bee<'_>) {
        while let Some(packet) = self.flood.take_due(bee.now()) {
            bee.send(self.radio, &packet);
        }
        self.wait(bee);
    }

    /// Has the timer fire when the next message is due.
    fn wait(&mut self, bee: &mut Bee<'_>) {
        if let Some(wait) = self.flood.next(bee.now()) {
            bee.arm(self.timer, wait);
        }
    }
}
