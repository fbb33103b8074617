//! What every model sees: time, chance, timers, the population, messages.

use crate::message::Message;
use crate::population::Population;
use crate::swarm::{Core, Effect, Own, Swarm};
use crate::timer::{Call, TimerHandle};
use simbeeotic_kernel::Stream;
use simbeeotic_kernel::{ModelId, Outbox, SimTime};
use simbeeotic_units::Time;
use std::any::Any;
use std::fmt::Display;

/// What a model may see and do during one call.
///
/// It sees the world as it was when this round of the instant began (contacts and frames that are due
/// are done by then), plus its own effects at once. What it does to others (messages, packets, forces
/// that lead to touches) takes effect when the round ends.
pub struct Cx<'a> {
    pub(crate) now: SimTime,
    pub(crate) swarm: &'a Swarm,
    pub(crate) core: &'a mut Core,
    /// The own body's motion as changed in this call; `None` while it is not.
    pub(crate) own: &'a mut Option<Own>,
    pub(crate) out: &'a mut Outbox<Effect>,
}

impl<'a> Cx<'a> {
    /// The same context for a shorter time.
    #[inline]
    pub fn reborrow(&mut self) -> Cx<'_> {
        let Self {
            now,
            swarm,
            core,
            own,
            out,
        } = self;
        Cx {
            now: *now,
            swarm,
            core,
            own,
            out,
        }
    }

    /// The present instant.
    #[inline]
    pub fn now(&self) -> SimTime {
        self.now
    }

    /// The id of this model.
    pub fn id(&self) -> ModelId {
        self.core.id
    }

    /// The path of this model: `bee-17`.
    pub fn path(&self) -> &'a str {
        self.swarm.population.path(self.core.id)
    }

    /// This model's own random stream.
    #[inline]
    pub fn rng(&mut self) -> &mut Stream {
        &mut self.core.rng
    }

    /// A draw from `[0, 1)` of this model's own stream.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        self.core.rng.uniform()
    }

    /// A draw from N(0, 1) of this model's own stream.
    #[inline]
    pub fn gauss(&mut self) -> f64 {
        self.core.rng.normal()
    }

    /// All models of the run.
    pub fn population(&self) -> &'a Population {
        &self.swarm.population
    }

    /// The model at `path`, if there is one.
    pub fn find(&self, path: &str) -> Option<ModelId> {
        self.swarm.population.find(path)
    }

    /// The path of a model; empty for an id that is not one.
    pub fn path_of(&self, id: ModelId) -> &'a str {
        self.swarm.population.path(id)
    }

    /// Sends `payload` to another model; it arrives in the next round of this instant.
    pub fn tell(&mut self, receiver: ModelId, payload: impl Any + Send + Sync) {
        self.tell_after(Time::ZERO, receiver, payload);
    }

    /// Sends `payload` to a model (this one is allowed); it arrives after `delay`.
    ///
    /// A receiver that is not there, or a delay below zero, ends the run with an error that names
    /// this model.
    pub fn tell_after(&mut self, delay: Time, receiver: ModelId, payload: impl Any + Send + Sync) {
        let Some(at) = self.in_future("a message", delay) else {
            return;
        };
        if self.swarm.population.get(receiver).is_none() {
            return self.fault(format!(
                "sent a message to model {receiver}, which does not exist"
            ));
        }
        let message = Message {
            sender: self.core.id,
            payload: Box::new(payload),
        };
        let number = self.core.told;
        self.core.told = number.wrapping_add(1);
        self.out.effect(Effect::Tell {
            receiver,
            at,
            number,
            message,
        });
    }

    /// Writes a line into the log of the run: it is recorded, and `run --log` prints it.
    pub fn log(&mut self, text: impl Display) {
        self.out.effect(Effect::Log(text.to_string()));
    }

    /// Publishes a named number. `unit` is what it is counted in: `"m"`, `"1"` for counts.
    pub fn metric(&mut self, name: &'static str, value: f64, unit: &'static str) {
        self.out.effect(Effect::Metric { name, value, unit });
    }

    /// Ends the run after this instant, as if its end time had come.
    pub fn end_run(&mut self, reason: impl Display) {
        self.out.stop(reason.to_string());
    }

    /// Ends the run with an error that names this model.
    pub fn fault(&mut self, message: impl Display) {
        self.out.fault(message.to_string());
    }

    /// Lets `timer` fire once, after `delay`. What it was armed for before is forgotten.
    pub fn arm(&mut self, timer: TimerHandle, delay: Time) {
        let Some(at) = self.in_future("a timer", delay) else {
            return;
        };
        let event = self.core.timers.arm(timer.index(), at, None);
        self.out.schedule(at, self.core.id, event);
    }

    /// Lets `timer` fire after `delay` and then every `period`. What it was armed for before is
    /// forgotten, also from within its own call.
    pub fn arm_every(&mut self, timer: TimerHandle, delay: Time, period: Time) {
        let Some(at) = self.in_future("a timer", delay) else {
            return;
        };
        let Some(period) = self.span("a timer's period", period).filter(|p| *p > 0) else {
            return self.fault(format!(
                "a timer's period of {period}: it must be more than zero"
            ));
        };
        let event = self.core.timers.arm(timer.index(), at, Some(period));
        self.out.schedule(at, self.core.id, event);
    }

    /// Keeps `timer` from firing until it is armed again.
    pub fn cancel(&mut self, timer: TimerHandle) {
        self.core.timers.cancel(timer.index());
    }

    /// When `timer` fires next; `None` if it is not armed.
    pub fn next_firing(&self, timer: TimerHandle) -> Option<SimTime> {
        self.core.timers.next_firing(timer.index())
    }

    /// A new timer that calls `call` once, after `delay`.
    pub fn after(&mut self, delay: Time, call: Call) -> TimerHandle {
        self.create_timer(call, Some(delay), None)
    }

    /// A new timer that calls `call` after `first` and then every `period`.
    pub fn every(&mut self, first: Time, period: Time, call: Call) -> TimerHandle {
        self.create_timer(call, Some(first), Some(period))
    }

    pub(crate) fn create_timer(
        &mut self,
        call: Call,
        first: Option<Time>,
        period: Option<Time>,
    ) -> TimerHandle {
        let timer = TimerHandle::new(self.core.timers.add(call.0));
        match (first, period) {
            (Some(first), Some(period)) => self.arm_every(timer, first, period),
            (Some(first), None) => self.arm(timer, first),
            (None, _) => {}
        }
        timer
    }

    pub(crate) fn call_of(&self, timer: TimerHandle) -> Call {
        Call(self.core.timers.label(timer.index()))
    }

    fn in_future(&mut self, what: &str, delay: Time) -> Option<SimTime> {
        let span = self.span(what, delay)?;
        self.now.checked_add_nanos(span)
    }

    /// A time as whole nanoseconds; a fault if it is no time to wait.
    fn span(&mut self, what: &str, delay: Time) -> Option<u64> {
        match SimTime::from_time(delay) {
            Ok(span) => Some(span.nanos()),
            Err(_) => {
                self.fault(format!("asked for {what} after {delay}"));
                None
            }
        }
    }
}
