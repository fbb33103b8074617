//! What the engine runs: the interface between the kernel and a simulated world.

use super::{
    Book,
    error::{Failure, What},
    outbox::Outbox,
};
use crate::{Event, ModelId, SimTime, TraceLog, Wake};

/// A simulated world: shared state, and what agents do to it.
///
/// The engine calls these in the order that the page [`engine`](crate::engine) shows. All methods but
/// [`run`](Domain::run) are called on one thread at a time, in an order that depends on nothing but the
/// run itself; `run` sees the shared state read-only and its own agent, so calls of one round may
/// happen at the same time, in any order, and must not be able to tell.
pub trait Domain: Send + Sync {
    /// What is woken: one for each [`ModelId`], at that index.
    type Agent: Send;
    /// A change of the shared state that an agent asks for while it runs.
    type Effect: Send;

    /// The 64-bit key of an agent's path: its identity in traces and draws, whatever its number.
    /// Asked once for each agent, when the engine is made. See [`path_key`](crate::rng::path_key).
    fn key(&self, id: ModelId) -> u64;

    /// The agent's path, for errors.
    fn path(&self, id: ModelId) -> String;

    /// The earliest instant at which the shared state has something to do by itself: a contact, the
    /// end of a frame. Asked before each round; a time that is over counts as now.
    fn next_time(&mut self) -> Option<SimTime>;

    /// Opens a round: brings the shared state to now, does what is due, and may wake more agents.
    fn open(&mut self, round: &mut Opening<'_>);

    /// Runs one agent with its events of this round. `self` is as it was after [`open`](Domain::open).
    fn run(&self, agent: &mut Self::Agent, visit: &Visit<'_>, out: &mut Outbox<Self::Effect>);

    /// Reads a little of what [`run`](Domain::run) will need of an agent: a word of its own memory, of
    /// its body. Called for a group of agents just before they are run, so that the memory of all of
    /// them is fetched at once instead of one after the other; with 100,000 agents, most of the time of
    /// an event is waiting for memory. Returns any mix of the words read, so that the compiler keeps
    /// the reads; what it is does not matter.
    fn warm(&self, id: ModelId, agent: &Self::Agent) -> u64 {
        let _ = (id, agent);
        0
    }

    /// Applies one effect. Effects come in the order of agents, and of each agent in the order in
    /// which it asked for them.
    fn commit(&mut self, id: ModelId, effect: Self::Effect, cx: &mut Committing<'_>);

    /// Closes a round, after its last effect: predicts contacts, starts frames. Returns whether the
    /// shared state wants another round at this same instant.
    fn close(&mut self, now: SimTime) -> bool;
}

/// One agent's turn in a round.
#[derive(Clone, Copy, Debug)]
pub struct Visit<'a> {
    /// The instant.
    pub now: SimTime,
    /// The round within the instant, from 0.
    pub round: u32,
    /// The agent that is run.
    pub id: ModelId,
    /// Its events, in order; none if the domain asked for the visit.
    pub events: &'a [Event],
}

/// What [`Domain::open`] may see and do.
#[derive(Debug)]
pub struct Opening<'a> {
    pub(super) now: SimTime,
    pub(super) round: u32,
    pub(super) events: &'a [Event],
    pub(super) visits: &'a mut Vec<ModelId>,
    pub(super) trace: &'a mut TraceLog,
    pub(super) failure: &'a mut Option<Failure>,
}

impl<'a> Opening<'a> {
    /// The instant.
    #[must_use]
    pub fn now(&self) -> SimTime {
        self.now
    }

    /// The round within the instant, from 0.
    #[must_use]
    pub fn round(&self) -> u32 {
        self.round
    }

    /// The events of this round, in order; their receivers are visited in any case.
    #[must_use]
    pub fn events(&self) -> &'a [Event] {
        self.events
    }

    /// Has an agent run in this round, with or without events. Asking twice is asking once.
    pub fn visit(&mut self, id: ModelId) {
        self.visits.push(id);
    }

    /// Folds a word into the trace of the run: what the shared state did by itself.
    pub fn fold(&mut self, word: u64) {
        self.trace.fold(word);
    }

    /// Ends the run with an error, laid at this agent's door. The first one counts.
    pub fn fault(&mut self, id: ModelId, message: impl Into<String>) {
        self.failure.get_or_insert_with(|| Failure {
            id,
            what: What::Fault(message.into()),
        });
    }
}

/// What [`Domain::commit`] may see and do beside its own state.
#[derive(Debug)]
pub struct Committing<'a> {
    pub(super) now: SimTime,
    pub(super) id: ModelId,
    pub(super) books: &'a mut [Book],
    pub(super) events: &'a mut Vec<Event>,
    pub(super) trace: &'a mut TraceLog,
    pub(super) failure: &'a mut Option<Failure>,
    pub(super) stop: &'a mut Option<String>,
}

impl Committing<'_> {
    /// The instant.
    #[must_use]
    pub fn now(&self) -> SimTime {
        self.now
    }

    /// Schedules an event in the name of `sender`. Now means the next round of this instant.
    ///
    /// A time that is over, or a sender or receiver that does not exist, ends the run with an error.
    pub fn schedule_for(&mut self, sender: ModelId, receiver: ModelId, time: SimTime, wake: Wake) {
        let known = |id: ModelId| id.index() < self.books.len();
        let wrong = if time < self.now {
            What::Past(time)
        } else if !known(receiver) {
            What::Unknown(receiver)
        } else if !known(sender) {
            What::Unknown(sender)
        } else {
            let seq = self.books[sender.index()].take_number();
            return self.events.push(Event {
                time,
                receiver,
                sender,
                seq,
                wake,
            });
        };
        self.failure.get_or_insert(Failure {
            id: self.id,
            what: wrong,
        });
    }

    /// Folds a word of this effect into the trace of the run and of the agent.
    #[inline]
    pub fn fold(&mut self, word: u64) {
        self.trace.fold(word);
        self.books[self.id.index()].trace.fold(word);
    }

    /// Ends the run with an error that names the agent whose effect this is. The first one counts.
    pub fn fault(&mut self, message: impl Into<String>) {
        let id = self.id;
        self.failure.get_or_insert_with(|| Failure {
            id,
            what: What::Fault(message.into()),
        });
    }

    /// Ends the run well, when this instant is done. The first reason counts.
    pub fn stop(&mut self, reason: impl Into<String>) {
        self.stop.get_or_insert_with(|| reason.into());
    }
}
