//! What a platform does with its radios.

use super::Platform;
use crate::kit::RadioHandle;
use crate::swarm::Effect;
use simbeeotic_kernel::ModelId;

use simbeeotic_radio::{
    CcaMode, Channel, Command, Counters, Loss, Outcome, RadioId, RadioSpec, RadioState, Request,
    Ticket,
};
use simbeeotic_units::{Current, PowerLevel};
use std::sync::Arc;

/// A request that no medium took, on its way back to who made it.
pub(crate) struct Unsent(pub(crate) Outcome);

/// # Radios
///
/// What is asked of a radio happens when the round ends, in the order of asking; what it knows is as
/// the round began. Where the scenario has no channel, or one that is off, radios do nothing.
impl Platform<'_> {
    /// Broadcasts `payload`. The medium queues it; what became of it is told with this ticket to the
    /// handler of [`Kit::on_sent`](crate::Kit::on_sent), if there is one.
    ///
    /// A payload that does not fit into a frame is not sent: [`Loss::TooLong`].
    pub fn send(&mut self, radio: RadioHandle, payload: &[u8]) -> Ticket {
        self.request(radio, None, payload)
    }

    /// Sends `payload` to one receiver, by its id ([`Cx::find`](super::Cx::find) knows the ids of
    /// paths). It takes the time and charge of all who hear it, and is handed to this one: to each of
    /// its radios that hears it. One of them acknowledges.
    ///
    /// A receiver that is not in the population ends the run with an error that names this model.
    pub fn send_to(&mut self, radio: RadioHandle, receiver: ModelId, payload: &[u8]) -> Ticket {
        self.request(radio, Some(receiver), payload)
    }

    /// Sends `payload`, and asks for an outcome, handler or not: it comes back with a ticket of one's
    /// own choice in the inbox of [`Behavior::on_packets`](crate::Behavior::on_packets), and to the
    /// handler if there is one.
    pub fn send_with_ticket(
        &mut self,
        radio: RadioHandle,
        receiver: Option<ModelId>,
        payload: &[u8],
        ticket: Ticket,
    ) {
        self.submit(radio, receiver, payload, Some(ticket));
    }

    /// Puts a radio to sleep, wakes it, tunes it, changes its power: the general form of the methods
    /// below.
    ///
    /// A channel or power that makes no sense ends the run with an error that names this model.
    pub fn command(&mut self, radio: RadioHandle, command: Command) {
        if let Some(radio) = self.radio_id(radio) {
            self.entity.out.effect(Effect::Command(radio, command));
        }
    }

    /// Switches a radio off: it hears nothing, and what it is asked to send is lost
    /// ([`Loss::SenderAsleep`]). A frame under way is finished first.
    pub fn sleep_radio(&mut self, radio: RadioHandle) {
        self.command(radio, Command::Sleep);
    }

    /// Switches a radio on.
    pub fn wake_radio(&mut self, radio: RadioHandle) {
        self.command(radio, Command::Wake);
    }

    /// Tunes a radio to another channel.
    ///
    /// What is asked to be sent from then on goes out on the new one, what was asked before on the old
    /// one. Where frames wait (`ieee802154`), the radio stays on the old one until they are done with;
    /// a frame that it was about to acknowledge it does not. Else the radio hears all that is sent on the
    /// new channel at this instant, and nothing more on the old one, whoever else is asked first.
    ///
    /// A channel that makes no sense ends the run with an error that names this model.
    pub fn tune_radio(&mut self, radio: RadioHandle, channel: Channel) {
        self.command(radio, Command::Tune(channel));
    }

    /// Changes the power at a radio's antenna, and what it draws while it sends. Datasheets list both by
    /// level: [`cc2420::pa_level`](simbeeotic_radio::cc2420::pa_level) for a CC2420; of another radio
    /// take `tx_power` and `currents.tx` of its [`RadioSpec`] at the level.
    ///
    /// Numbers that make no sense end the run with an error that names this model.
    pub fn set_power(&mut self, radio: RadioHandle, level: PowerLevel, current: Current) {
        self.command(radio, Command::Power { level, current });
    }

    /// What a radio is doing. Idle if there is no channel.
    pub fn radio_state(&self, radio: RadioHandle) -> RadioState {
        match (self.radio_id(radio), &self.entity.swarm.medium) {
            (Some(radio), Some(medium)) => medium.state(radio, self.entity.now()),
            _ => RadioState::Idle,
        }
    }

    /// What became of a radio's frames so far, and why packets were lost.
    pub fn radio_counters(&self, radio: RadioHandle) -> Counters {
        match (self.radio_id(radio), &self.entity.swarm.medium) {
            (Some(radio), Some(medium)) => medium.counters(radio),
            _ => Counters::default(),
        }
    }

    /// What a radio is, as it stands: channel, power, longest payload. `None` if there is no channel.
    pub fn radio_spec(&self, radio: RadioHandle) -> Option<&RadioSpec> {
        let medium = self.entity.swarm.medium.as_ref()?;
        Some(medium.spec(self.radio_id(radio)?))
    }

    /// The power on a radio's channel, noise included: what clear channel assessment measures.
    ///
    /// `None` if the radio cannot listen: it sleeps, it is sending, there is no channel.
    pub fn sense(&self, radio: RadioHandle) -> Option<PowerLevel> {
        let medium = self.entity.swarm.medium.as_ref()?;
        let id = self.radio_id(radio)?;
        match medium.state(id, self.entity.now()) {
            RadioState::Sleep | RadioState::Transmit => None,
            _ => Some(medium.ambient(id)),
        }
    }

    /// Whether a radio's clear channel assessment finds its channel free now: by the energy on it, by
    /// whether a frame is being taken in, or by both, as the radio has it ([`Cca`](simbeeotic_radio::Cca)).
    ///
    /// `None` if the radio cannot listen, as for [`sense`](Self::sense). Media do their own assessment
    /// before they send; this is for those who write their own medium access.
    pub fn channel_clear(&self, radio: RadioHandle) -> Option<bool> {
        let power = self.sense(radio)?;
        let cca = self.radio_spec(radio)?.phy.cca;
        let silent = power < cca.threshold;
        let free = self.radio_state(radio) != RadioState::Receive;
        Some(match cca.mode {
            CcaMode::Energy => silent,
            CcaMode::Carrier => free,
            CcaMode::Both => silent && free,
        })
    }

    /// Asks for an outcome if the behaviour has a handler for it: each wakes the model once more.
    fn request(
        &mut self,
        radio: RadioHandle,
        destination: Option<ModelId>,
        payload: &[u8],
    ) -> Ticket {
        let ticket = self.gear.ticket;
        self.gear.ticket = Ticket(ticket.0.wrapping_add(1));
        let wanted = self.gear.receipts.then_some(ticket);
        self.submit(radio, destination, payload, wanted);
        ticket
    }

    fn submit(
        &mut self,
        radio: RadioHandle,
        destination: Option<ModelId>,
        payload: &[u8],
        ticket: Option<Ticket>,
    ) {
        let cx = &mut *self.entity;
        if let Some(receiver) = destination
            && cx.swarm.population.get(receiver).is_none()
        {
            return cx.fault(format!(
                "sent a packet to model {receiver}, which does not exist"
            ));
        }
        let at = usize::from(radio.index);
        let (Some(radio), Some(medium)) = (cx.core.radios.get(at).copied(), &cx.swarm.medium)
        else {
            if let Some(ticket) = ticket {
                let result = Err(Loss::NoChannel);
                cx.tell(cx.id(), Unsent(Outcome { ticket, result }));
            }
            return;
        };
        let onboard = cx.core.onboard.as_deref_mut();
        if let Some(original) = onboard.and_then(|onboard| onboard.original.as_mut()) {
            original.frames(at, medium.spec(radio), true, payload.len(), cx.now);
        }
        cx.out.effect(Effect::Transmit(Request {
            radio,
            destination,
            payload: Arc::from(payload),
            ticket,
        }));
    }

    /// With the channel off there is no radio to find, and packets go nowhere.
    fn radio_id(&self, radio: RadioHandle) -> Option<RadioId> {
        let radios = &self.entity.core.radios;
        radios.get(usize::from(radio.index)).copied()
    }
}
