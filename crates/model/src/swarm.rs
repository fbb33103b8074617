//! The shared state of a run: bodies, air, weather, population; and what happens to it.
//!
//! [`Swarm`] is the kernel's domain. In one round of an instant:
//!
//! 1. *open*: bodies that touch now are resolved, frames that are due go through the medium;
//!    whoever was touched or may hear something is woken too;
//! 2. *run*: models run in parallel and see the swarm as it is after 1;
//! 3. *commit*: what they did is applied in the order of their ids;
//! 4. *close*: contacts of the bodies that changed are predicted anew.

use crate::component::Component;
use crate::energy::{Accounts, BatteryState, Books, Consumer, Drawn, Onboard};
use crate::fold;
use crate::host::Cx;
use crate::instance::GearPlan;
use crate::message::{Message, Thing, Touch};
use crate::metrics::Metrics;
use crate::model::{Model, Wake as ModelWake};
use crate::packets::{OnAir, PacketWatch, Reception};
use crate::population::Population;
use crate::scene::Look;
use crate::sensor::Taken;
use crate::timer::TimerHandle;
use simbeeotic_kernel::{
    Committing, Domain, Event, ModelId, Opening, Outbox, SimTime, Stream, Timers, Visit, Wake,
};
use simbeeotic_physics::{BodyId, Contact, Motion, Physics};
use simbeeotic_radio::{Command, Medium, Poses, RadioId, RadioState, Request, Scratch};
use simbeeotic_units::{
    Acceleration, Attitude, Decibels, Frequency, Length, Pose, Position, Rate, Twist, Velocity,
};
use simbeeotic_world::{Gases, Weather, World};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Tags of wake-ups that are not timers.
pub(crate) mod wake {
    /// The model's start.
    pub(crate) const START: u32 = 1;
    /// A message; the argument is its place in the mail room.
    pub(crate) const TELL: u32 = 2;
    /// The model's end.
    pub(crate) const FINISH: u32 = 3;
}

/// One receiver in so many is timed, for all: reading the clock costs as much as a reception.
const TIMED_RECEIVERS: u32 = 16;

/// One model and what belongs to it alone.
#[repr(C, align(64))]
pub struct Agent {
    pub(crate) model: Box<dyn Model>,
    pub(crate) core: Core,
}

/// What every model has, whatever it is. What a timer's wake-up needs comes first: it lies in the
/// first two of the [`Agent`]'s three cache lines.
#[repr(C)]
pub(crate) struct Core {
    pub(crate) id: ModelId,
    pub(crate) body: Option<BodyId>,
    /// Messages sent so far.
    pub(crate) told: u32,
    pub(crate) rng: Stream,
    /// Each timer's label is the [`Call`](crate::Call) it makes.
    pub(crate) timers: Timers,
    pub(crate) drawn: Drawn,
    pub(crate) radios: Box<[RadioId]>,
    /// Batteries and the like; most models have none.
    pub(crate) onboard: Option<Box<Onboard>>,
}

const _: () = assert!(size_of::<Agent>() == 192);

/// A body's motion as its model has changed it in one call.
#[derive(Clone, Copy)]
pub struct Own {
    pub(crate) motion: Motion,
    /// Whether it was put elsewhere, and did not only get there by moving.
    pub(crate) jumped: bool,
}

/// What a model does to others. Nearly all effects are motions: a box each would cost more.
pub enum Effect {
    /// Its own body moves differently from now on.
    Motion(Motion),
    /// Its own body was put elsewhere, and did not only get there by moving.
    Jump,
    /// A packet goes on the air.
    Transmit(Request),
    /// A radio sleeps, wakes, tunes.
    Command(RadioId, Command),
    /// A message to another model.
    Tell {
        /// To whom.
        receiver: ModelId,
        /// When it arrives.
        at: SimTime,
        /// How many messages the sender had sent before.
        number: u32,
        /// What.
        message: Message,
    },
    /// A line for the log.
    Log(String),
    /// A number for the record.
    Metric {
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it is counted in.
        unit: &'static str,
    },
    /// A sensor has measured; noted for recorders only.
    Sensed(u16, Box<Taken>),
    /// Packets were received; noted for recorders only.
    Heard(Box<[Reception]>),
    /// A message has been read: whose, and which.
    Read(ModelId, u32),
}

// In an aligned round all effects of a swarm wait in line: 20 MB of them at 100,000.
const _: () = assert!(size_of::<Effect>() == size_of::<Motion>());

/// Something that happened, for recorders and viewers.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum Mark {
    /// A body touched something.
    Touch {
        /// When.
        time: SimTime,
        /// Who.
        a: ModelId,
        /// What.
        b: Thing,
    },
    /// A model wrote a line.
    Log {
        /// When.
        time: SimTime,
        /// Who.
        model: ModelId,
        /// What.
        text: String,
    },
    /// A sensor measured.
    Sensed {
        /// When.
        time: SimTime,
        /// Who carries it.
        model: ModelId,
        /// Which of its sensors, in the scenario's order.
        sensor: u16,
        /// What it read, and what was true.
        taken: Box<Taken>,
    },
    /// Frames began to be sent.
    OnAir {
        /// When.
        time: SimTime,
        /// Which, and who could listen.
        air: Box<OnAir>,
    },
    /// A radio handed packets to its owner.
    Heard {
        /// When.
        time: SimTime,
        /// Which, and how well.
        receptions: Box<[Reception]>,
    },
    /// A model published a number.
    Metric {
        /// When.
        time: SimTime,
        /// Who.
        model: ModelId,
        /// Its name.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it is counted in.
        unit: &'static str,
    },
}

/// The shared state of a run.
pub struct Swarm {
    pub(crate) physics: Physics,
    pub(crate) gravity: Acceleration,
    pub(crate) medium: Option<Box<dyn Medium>>,
    pub(crate) weather: Arc<dyn Weather>,
    /// The world's gases in this weather.
    pub(crate) gases: Gases,
    pub(crate) world: Arc<World>,
    pub(crate) population: Population,
    /// Identity of each model in traces and draws.
    pub(crate) keys: Vec<u64>,
    /// Each model's body.
    pub(crate) bodies: Vec<Option<BodyId>>,
    /// What each body is: first those of models, then the objects of the world.
    pub(crate) owners: Vec<Thing>,
    /// How the bodies of the world's objects look: the last of all bodies, in their order.
    pub(crate) looks: Vec<Look>,
    /// Messages under way.
    pub(crate) mail: MailRoom,
    /// Contacts resolved in this round.
    pub(crate) contacts: Vec<Contact>,
    /// The same as each touched model sees them, by model.
    pub(crate) touches: Vec<(ModelId, Touch)>,
    /// Who may hear something in this round.
    pub(crate) listeners: Vec<ModelId>,
    pub(crate) touch_count: u64,
    /// How often a body was put elsewhere.
    pub(crate) jumps: u64,
    pub(crate) marks: Vec<Mark>,
    /// Whether anybody looks at the marks.
    pub(crate) keep_marks: bool,
    /// Of each model, the sensors whose measurements somebody looks at, a bit each; empty if nobody
    /// looks at any. The last bit stands for all sensors from the 64th on.
    pub(crate) watched: Vec<u64>,
    /// The radios whose frames somebody looks at, if there are any.
    pub(crate) packet_watch: Option<Box<PacketWatch>>,
    /// What models have published, summed up.
    pub(crate) metrics: Metrics,
    /// The names of each model's sensors: those of one section share them.
    pub(crate) gear: Vec<Arc<GearPlan>>,
    /// Wall-clock time of collecting packets, which runs inside the models' parallel phase.
    pub(crate) radio_nanos: AtomicU64,
    pub(crate) medium_nanos: u64,
    pub(crate) contact_nanos: u64,
}

/// Messages under way, by sender and the sender's own count: names that do not depend on what other
/// models send.
#[derive(Default)]
pub(crate) struct MailRoom(BTreeMap<(ModelId, u32), Message>);

impl Swarm {
    /// The model's body, if it has one.
    #[inline]
    pub(crate) fn body_of(&self, id: ModelId) -> Option<BodyId> {
        self.bodies.get(id.index()).copied().flatten()
    }

    pub(crate) fn pose_of(&self, id: ModelId, now: SimTime) -> Option<Pose> {
        let motion = self.physics.motion(self.body_of(id)?);
        Some(Pose {
            position: Position::from_si(motion.position(now)),
            attitude: Attitude::from_unit_quat(motion.attitude(now)),
        })
    }

    pub(crate) fn twist_of(&self, id: ModelId, now: SimTime) -> Option<Twist> {
        let motion = self.physics.motion(self.body_of(id)?);
        Some(Twist {
            linear: Velocity::from_si(motion.velocity(now)),
            angular: Rate::from_si(motion.rate(now)),
        })
    }

    pub(crate) fn radius_of(&self, id: ModelId) -> Option<Length> {
        Some(Length::si(
            self.physics.motion(self.body_of(id)?).radius_m(),
        ))
    }

    pub(crate) fn gravity(&self) -> Acceleration {
        self.gravity
    }

    /// What a model has drawn up to `now`, its radios' states settled.
    pub(crate) fn accounts(&self, core: &Core, now: SimTime) -> Accounts {
        let mut accounts = core.drawn.at(now);
        let onboard = core.onboard.as_deref();
        match onboard.and_then(|onboard| onboard.off.as_ref()) {
            Some((radios, _)) => accounts.add(radios),
            None => accounts.add(&self.radio_accounts(core, now)),
        }
        if let Some(onboard) = onboard {
            accounts.subtract(&onboard.lapsed);
        }
        accounts
    }

    /// What the books of a model's radios say.
    pub(crate) fn radio_accounts(&self, core: &Core, now: SimTime) -> Accounts {
        let mut accounts = Accounts::default();
        let Some(medium) = &self.medium else {
            return accounts;
        };
        let original = core.onboard.as_deref().and_then(|o| o.original.as_ref());
        let states = [
            (RadioState::Transmit, Consumer::RadioTx),
            (RadioState::Receive, Consumer::RadioRx),
            (RadioState::Listen, Consumer::RadioRx),
            (RadioState::Idle, Consumer::RadioIdle),
            (RadioState::Sleep, Consumer::RadioSleep),
        ];
        for (at, radio) in core.radios.iter().enumerate() {
            if let Some(original) = original {
                original.add(at, medium.spec(*radio), now, &mut accounts);
                continue;
            }
            let usage = medium.usage(*radio, now);
            for (state, consumer) in states {
                accounts.draw(consumer, usage.charge(state));
            }
        }
        accounts
    }

    /// What a model draws now, A.
    pub(crate) fn load_a(&self, core: &Core, now: SimTime) -> f64 {
        let off = core.onboard.as_deref().is_some_and(|o| o.off.is_some());
        let radios = core.radios.iter().filter(|_| !off);
        let radios_a = radios.filter_map(|radio| {
            let medium = self.medium.as_ref()?;
            let currents = &medium.spec(*radio).currents;
            let current = match medium.state(*radio, now) {
                RadioState::Sleep => currents.sleep,
                RadioState::Idle => currents.idle,
                RadioState::Listen | RadioState::Receive => currents.rx,
                RadioState::Transmit => currents.tx,
            };
            Some(current.get())
        });
        core.drawn.current_a() + radios_a.sum::<f64>()
    }

    /// A model's battery as it is at `now`, whenever it was settled last.
    pub(crate) fn battery(&self, core: &Core, now: SimTime) -> Option<(BatteryState, Books)> {
        let mut power = core.onboard.as_deref()?.power.clone()?;
        power.settle(now, &self.accounts(core, now));
        Some((power.state(self.load_a(core, now)), power.books()))
    }

    /// Models with a body whose centre is within `radius` of `at`, but for `but`, by id.
    pub(crate) fn neighbors(
        &self,
        at: Position,
        radius: Length,
        now: SimTime,
        but: ModelId,
    ) -> Vec<ModelId> {
        let mut bodies = Vec::new();
        self.physics.near(at.si(), radius.get(), now, &mut bodies);
        let owners = bodies
            .iter()
            .filter_map(|body| self.owners[body.index()].model());
        let mut models: Vec<_> = owners.filter(|id| *id != but).collect();
        models.sort_unstable();
        models
    }

    /// Frames sent, and receptions handed out by the medium.
    pub(crate) fn packets(&self) -> (u64, u64) {
        let totals = self.medium.as_ref().map(|m| m.totals()).unwrap_or_default();
        (totals.sent, totals.received)
    }

    /// Notes which sensors' measurements are kept: those that one of the components wants.
    pub(crate) fn choose_readings(&mut self, components: &[&dyn Component]) {
        let wants = |sensor: &str| components.iter().any(|c| c.wants_reading(sensor));
        let watched = self.gear.iter().enumerate().map(|(model, gear)| {
            let path = self.population.path(ModelId(model as u32));
            let sensors = gear.sensors.iter().enumerate();
            let wanted = sensors.filter(|(_, s)| wants(&format!("{path}/{}", s.name)));
            wanted.fold(0, |bits, (at, _)| bits | 1 << at.min(63))
        });
        let watched: Vec<u64> = match components {
            [] => Vec::new(),
            _ => watched.collect(),
        };
        let any = watched.iter().any(|bits| *bits != 0);
        self.watched = if any { watched } else { Vec::new() };
    }

    /// Whether somebody looks at what a sensor measures.
    pub(crate) fn watches(&self, model: ModelId, sensor: u16) -> bool {
        let bits = self.watched.get(model.index()).copied().unwrap_or(0);
        bits >> sensor.min(63) & 1 != 0
    }

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
