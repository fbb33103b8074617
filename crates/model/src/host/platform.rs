//! A body with gear: sensors, radios, energy accounts.

use super::{Cx, Entity};
use crate::behavior::BuildError;
use crate::energy::{Accounts, Consumer};
use crate::instance::Instance;
use crate::kit::RadioHandle;
use crate::sensor::{AnySensor, Handle};
use crate::swarm::Effect;
use crate::view::Truth;
use simbeeotic_kernel::ModelId;
use simbeeotic_radio::{Command, Counters, RadioId, RadioState, Request, Ticket};
use simbeeotic_units::{Charge, Mount};
use std::ops::{Deref, DerefMut};
use std::sync::Arc;

/// The sensors of one platform. Radios and accounts live with the model's core.
pub(crate) struct Gear {
    sensors: Box<[Box<dyn AnySensor>]>,
}

impl Gear {
    pub(crate) fn assemble(instance: &mut Instance<'_>) -> Result<Self, BuildError> {
        instance.add_radios()?;
        Ok(Self {
            sensors: instance.sensors()?,
        })
    }
}

/// A body with gear, as its behaviour sees it during one call.
pub struct Platform<'a> {
    entity: Entity<'a>,
    gear: &'a mut Gear,
}

impl<'a> Platform<'a> {
    #[inline]
    pub(crate) fn new(cx: Cx<'a>, gear: &'a mut Gear) -> Self {
        Self {
            entity: Entity::new(cx),
            gear,
        }
    }

    /// Takes one reading.
    pub fn read<R: 'static>(&mut self, sensor: Handle<R>) -> R {
        let mut truth = Truth {
            now: self.entity.now(),
            pose: self.entity.pose(),
            twist: self.entity.twist(),
            acceleration: self.entity.acceleration(),
            host: self.entity.id(),
            mount: Mount::IDENTITY,
            swarm: self.entity.swarm,
        };
        let mut reading: Option<R> = None;
        self.gear.sensors[usize::from(sensor.index)].read_into(&mut truth, &mut reading);
        match reading {
            Some(reading) => reading,
            None => unreachable!(
                "a handle's type is checked when it is made, and it fits its own platform"
            ),
        }
    }

    /// Broadcasts `payload`.
    pub fn send(&mut self, radio: RadioHandle, payload: &[u8]) {
        self.submit(radio, None, payload, None);
    }

    /// Sends `payload` to one receiver. It takes the time and charge of all who hear it, and is
    /// handed to this one.
    pub fn send_to(&mut self, radio: RadioHandle, receiver: ModelId, payload: &[u8]) {
        self.submit(radio, Some(receiver), payload, None);
    }

    /// Sends `payload`, and asks for an outcome: it comes back with `ticket` in the inbox of
    /// [`Behavior::on_packets`](crate::Behavior::on_packets).
    pub fn send_with_ticket(
        &mut self,
        radio: RadioHandle,
        receiver: Option<ModelId>,
        payload: &[u8],
        ticket: Ticket,
    ) {
        self.submit(radio, receiver, payload, Some(ticket));
    }

    /// Puts a radio to sleep, wakes it, tunes it, changes its power.
    ///
    /// A channel or power that makes no sense ends the run with an error that names this model.
    pub fn command(&mut self, radio: RadioHandle, command: Command) {
        if let Some(radio) = self.radio_id(radio) {
            self.entity.out.effect(Effect::Command(radio, command));
        }
    }

    /// What a radio is doing. Idle if there is no channel.
    pub fn radio_state(&self, radio: RadioHandle) -> RadioState {
        match (self.radio_id(radio), &self.entity.swarm.medium) {
            (Some(radio), Some(medium)) => medium.state(radio, self.entity.now()),
            _ => RadioState::Idle,
        }
    }

    /// What became of a radio's frames so far.
    pub fn radio_counters(&self, radio: RadioHandle) -> Counters {
        match (self.radio_id(radio), &self.entity.swarm.medium) {
            (Some(radio), Some(medium)) => medium.counters(radio),
            _ => Counters::default(),
        }
    }

    fn submit(
        &mut self,
        radio: RadioHandle,
        destination: Option<ModelId>,
        payload: &[u8],
        ticket: Option<Ticket>,
    ) {
        if let Some(radio) = self.radio_id(radio) {
            let request = Request {
                radio,
                destination,
                payload: Arc::from(payload),
                ticket,
            };
            self.entity.out.effect(Effect::Transmit(request));
        }
    }

    /// With the channel off there is no radio to find, and packets go nowhere.
    fn radio_id(&self, radio: RadioHandle) -> Option<RadioId> {
        self.entity
            .core
            .radios
            .get(usize::from(radio.index))
            .copied()
    }

    /// Books `charge` on `consumer`.
    #[inline]
    pub fn draw(&mut self, consumer: Consumer, charge: Charge) {
        self.entity.core.accounts.draw(consumer, charge);
    }

    /// What this platform has drawn up to now, its radios included.
    pub fn accounts(&self) -> Accounts {
        self.entity
            .swarm
            .accounts(self.entity.core, self.entity.now())
    }
}

impl<'a> Deref for Platform<'a> {
    type Target = Entity<'a>;
    fn deref(&self) -> &Entity<'a> {
        &self.entity
    }
}

impl DerefMut for Platform<'_> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.entity
    }
}
