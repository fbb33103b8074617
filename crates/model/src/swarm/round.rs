//! One round of an instant: who touches and who may hear, what models do then, and what comes of it.

use super::effect::{Effect, Mark};
use super::{Agent, Swarm, wake};
use crate::fold;
use crate::host::Cx;
use crate::message::{Thing, Touch};
use crate::model::{Model, Wake as ModelWake};
use crate::timer::TimerHandle;
use simbeeotic_kernel::{
    Committing, Domain, Event, ModelId, Opening, Outbox, SimTime, Visit, Wake,
};
use simbeeotic_physics::Contact;
use simbeeotic_radio::{Poses, Scratch};
use simbeeotic_units::{Decibels, Frequency, Length, Pose, Position, Velocity};
use std::cell::RefCell;
use std::sync::atomic::Ordering;

/// One receiver in so many is timed, for all: reading the clock costs as much as a reception.
const TIMED_RECEIVERS: u32 = 16;

thread_local! {
    /// Room for the packets of one receiver at a time.
    static SCRATCH: RefCell<Scratch> = RefCell::new(Scratch::default());
}

impl Domain for Swarm {
    type Agent = Agent;
    type Effect = Effect;

    fn key(&self, id: ModelId) -> u64 {
        self.keys[id.index()]
    }

    fn path(&self, id: ModelId) -> String {
        self.population.path(id).to_owned()
    }

    fn next_time(&mut self) -> Option<SimTime> {
        let medium = self.medium.as_ref().and_then(|m| m.next_time());
        match (self.physics.next_time(), medium) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        }
    }

    fn open(&mut self, round: &mut Opening<'_>) {
        self.open_contacts(round);
        self.open_medium(round);
    }

    fn run(&self, agent: &mut Agent, visit: &Visit<'_>, out: &mut Outbox<Effect>) {
        let Agent { model, core } = agent;
        let mut own = None;
        let mut cx = Cx {
            now: visit.now,
            swarm: self,
            core,
            own: &mut own,
            out,
        };

        if !self.touches.is_empty() {
            let first = self.touches.partition_point(|(id, _)| *id < visit.id);
            for (_, touch) in self.touches[first..]
                .iter()
                .take_while(|(id, _)| *id == visit.id)
            {
                model.wake(ModelWake::Touch(touch), &mut cx);
            }
        }
        if !self.listeners.is_empty() && self.listeners.binary_search(&visit.id).is_ok() {
            self.hear(&mut **model, &mut cx);
        }
        for event in visit.events {
            self.deliver(&mut **model, event, &mut cx);
        }
        if let Some(own) = own {
            out.fold(fold::motion(&own.motion));
            if own.jumped {
                out.effect(Effect::Jump);
            }
            out.effect(Effect::Motion(own.motion));
        }
    }

    /// A word of each cache line that a wake-up is going to need, as far as they are known here.
    fn warm(&self, id: ModelId, agent: &Agent) -> u64 {
        let Agent { model, core } = agent;
        let body = self.body_of(id).map_or(0, |body| self.physics.warm(body));
        core.timers.touch() ^ core.drawn.touch() ^ body ^ model.touch()
    }

    fn commit(&mut self, id: ModelId, effect: Effect, cx: &mut Committing<'_>) {
        match effect {
            Effect::Motion(motion) => {
                if let Some(body) = self.body_of(id) {
                    self.physics.commit(body, cx.now(), motion);
                }
            }
            Effect::Jump => self.jumps += 1,
            Effect::Transmit(request) => {
                fold::bytes(&request.payload, cx);
                let key = request.destination.and_then(|to| self.keys.get(to.index()));
                cx.fold(key.copied().unwrap_or(0));
                if let Some(medium) = &mut self.medium {
                    medium.submit(cx.now(), request);
                }
            }
            Effect::Command(radio, command) => {
                cx.fold(fold::command(&command));
                let result = self
                    .medium
                    .as_mut()
                    .map(|m| m.command(cx.now(), radio, command));
                if let Some(Err(error)) = result {
                    cx.fault(error.to_string());
                }
            }
            Effect::Tell {
                receiver,
                at,
                number,
                message,
            } => {
                self.mail.0.insert((id, number), message);
                cx.schedule_for(id, receiver, at, Wake::new(wake::TELL, number));
            }
            Effect::Log(text) => {
                fold::bytes(text.as_bytes(), cx);
                let time = cx.now();
                self.mark(|| Mark::Log {
                    time,
                    model: id,
                    text,
                });
            }
            Effect::Metric { name, value, unit } => {
                fold::bytes(name.as_bytes(), cx);
                cx.fold(value.to_bits());
                self.metrics.add(id, name, value, unit);
                let time = cx.now();
                self.mark(|| Mark::Metric {
                    time,
                    model: id,
                    name,
                    value,
                    unit,
                });
            }
            Effect::Sensed(sensor, taken) => {
                let time = cx.now();
                self.mark(|| Mark::Sensed {
                    time,
                    model: id,
                    sensor,
                    taken,
                });
            }
            Effect::Heard(receptions) => {
                let time = cx.now();
                self.mark(|| Mark::Heard { time, receptions });
            }
            Effect::Read(sender, number) => {
                self.mail.0.remove(&(sender, number));
            }
        }
    }

    fn close(&mut self, now: SimTime) -> bool {
        self.physics.settle(now);
        self.next_time().is_some_and(|next| next <= now)
    }
}

impl Swarm {
    fn mark(&mut self, mark: impl FnOnce() -> Mark) {
        if self.keep_marks {
            self.marks.push(mark());
        }
    }

    /// Resolves the contacts that are due.
    fn open_contacts(&mut self, round: &mut Opening<'_>) {
        let now = round.now();
        self.touches.clear();
        if self.physics.next_time().is_none_or(|next| next > now) {
            return;
        }
        let start = crate::watch::now();
        self.contacts.clear();
        self.physics.advance(now, &mut self.contacts);
        for at in 0..self.contacts.len() {
            let contact = self.contacts[at];
            // Objects come after all models and do not touch each other: `a` is a model.
            let Thing::Model(a) = self.owners[contact.a.index()] else {
                continue;
            };
            let b = contact.b.map_or(Thing::Ground, |b| self.owners[b.index()]);
            round.fold(self.keys[a.index()]);
            round.fold(match b {
                Thing::Ground => 0,
                Thing::Model(b) => self.keys[b.index()],
                Thing::Object(b) => b.key(),
            });
            round.fold(fold::vector(contact.impulse_enu));
            self.touch_count += 1;
            self.mark(|| Mark::Touch { time: now, a, b });
            self.touches.push((a, touch(&contact, now, b, 1.0)));
            round.visit(a);
            if let Thing::Model(b) = b {
                let seen = touch(&contact, now, Thing::Model(a), -1.0);
                self.touches.push((b, seen));
                round.visit(b);
            }
        }
        self.touches.sort_by_key(|(id, _)| *id);
        self.contact_nanos += crate::watch::nanos_since(start);
    }

    /// Puts the frames that are due through the medium.
    fn open_medium(&mut self, round: &mut Opening<'_>) {
        self.listeners.clear();
        let Some(mut medium) = self.medium.take() else {
            return;
        };
        let now = round.now();
        let due = medium.next_time().is_some_and(|next| next <= now);
        let start = due.then(crate::watch::now);
        let mut listeners = std::mem::take(&mut self.listeners);
        medium.open(now, &Still { swarm: self, now }, &mut listeners);
        for id in &listeners {
            round.visit(*id);
        }
        self.listeners = listeners;
        self.physics.survey(now);
        self.medium_nanos += start.map_or(0, crate::watch::nanos_since);
        if let (true, Some(watch)) = (due, &self.packet_watch) {
            let still = Still { swarm: self, now };
            let air = watch.look(medium.as_ref(), |owner| still.position(owner), now);
            self.marks.extend(air);
        }
        self.medium = Some(medium);
    }

    fn hear(&self, model: &mut dyn Model, cx: &mut Cx<'_>) {
        let Some(medium) = &self.medium else { return };
        let still = Still {
            swarm: self,
            now: cx.now,
        };
        SCRATCH.with_borrow_mut(|scratch| {
            for at in 0..cx.core.radios.len() {
                let timed = cx.core.id.0.is_multiple_of(TIMED_RECEIVERS);
                let start = timed.then(crate::watch::now);
                let inbox = medium.collect(cx.core.radios[at], &still, scratch);
                if let Some(start) = start {
                    let nanos = crate::watch::nanos_since(start) * u64::from(TIMED_RECEIVERS);
                    self.radio_nanos.fetch_add(nanos, Ordering::Relaxed);
                }
                if !inbox.is_empty() || !inbox.outcomes().is_empty() {
                    cx.out.fold(inbox.digest());
                    if let Some(watch) = &self.packet_watch {
                        let receptions = watch.receptions(&inbox);
                        if !receptions.is_empty() {
                            cx.out.effect(Effect::Heard(receptions));
                        }
                    }
                    model.wake(ModelWake::Packets(inbox), cx);
                }
            }
        });
    }

    fn deliver(&self, model: &mut dyn Model, event: &Event, cx: &mut Cx<'_>) {
        let wake = event.wake;
        if wake.tag & Wake::TIMER != 0 {
            let Some(fired) = cx.core.timers.fired(wake) else {
                return cx.out.voided();
            };
            model.wake(ModelWake::Timer(TimerHandle::new(fired.timer)), cx);
            if let Some((at, wake)) = cx.core.timers.rearm(fired) {
                cx.out.schedule(at, cx.core.id, wake);
            }
        } else if wake.tag == wake::START {
            model.start(cx);
        } else if wake.tag == wake::FINISH {
            model.finish(cx);
        } else if let Some(message) = self.mail.0.get(&(event.sender, wake.arg)) {
            model.wake(ModelWake::Message(message), cx);
            cx.out.effect(Effect::Read(event.sender, wake.arg));
        }
    }
}

/// A contact as one of its two bodies sees it; `side` is 1 for body a, -1 for body b.
fn touch(contact: &Contact, time: SimTime, other: Thing, side: f64) -> Touch {
    Touch {
        time,
        other,
        point: Position::from_si(contact.point_enu),
        normal: (contact.normal_enu * side).to_array(),
        relative_velocity: Velocity::from_si(contact.relative_velocity_enu * side),
        impulse: simbeeotic_units::ImpulseVec::from_si(contact.impulse_enu * side),
    }
}

/// The swarm at one instant, for the medium.
struct Still<'a> {
    swarm: &'a Swarm,
    now: SimTime,
}

impl Poses for Still<'_> {
    fn pose(&self, owner: ModelId) -> Pose {
        self.swarm.pose_of(owner, self.now).unwrap_or_default()
    }

    fn position(&self, owner: ModelId) -> Position {
        let body = self.swarm.body_of(owner);
        body.map_or(Position::ZERO, |b| {
            Position::from_si(self.swarm.physics.motion(b).position(self.now))
        })
    }

    fn positions(&self, owners: &[ModelId], positions: &mut Vec<Position>) {
        let (bodies, physics) = (&self.swarm.bodies[..], &self.swarm.physics);
        positions.extend(owners.iter().map(|owner| {
            bodies[owner.index()].map_or(Position::ZERO, |body| {
                Position::from_si(physics.motion(body).position(self.now))
            })
        }));
    }

    fn odometer(&self) -> Option<Length> {
        self.swarm.physics.odometer(self.now).map(Length::si)
    }

    fn obstruction(&self, ends: [(ModelId, Position); 2], frequency: Frequency) -> Decibels {
        self.swarm.obstruction(ends, frequency, self.now)
    }

    fn generation(&self) -> u64 {
        self.swarm.jumps
    }
}
