//! What an agent asks for while it runs.

use super::{
    Book,
    domain::Visit,
    error::{Failure, What},
};
use crate::{Event, ModelId, SimTime, Trace, Wake};

/// Takes what an agent does to others while it runs: effects, events, words of its trace.
///
/// Nothing of it happens before every agent of the round has run. Boxes are reused from round to
/// round, one for each chunk of agents that runs on one thread.
#[derive(Debug)]
pub struct Outbox<E> {
    pub(super) effects: Vec<E>,
    pub(super) events: Vec<Event>,
    pub(super) records: Vec<Record>,
    pub(super) failure: Option<Failure>,
    pub(super) stop: Option<String>,
    pub(super) voided: u64,

    /// The visit under way.
    pub(super) id: ModelId,
    now: SimTime,
    seq: u64,
    digest: Trace,
    agents: u32,
}

/// What is left of a visit when it is over.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record {
    pub(super) id: ModelId,
    /// How many effects the box held when the visit was over.
    pub(super) effects: u32,
    pub(super) digest: u64,
}

impl<E> Outbox<E> {
    pub(super) fn new(agents: u32) -> Self {
        Self {
            effects: Vec::new(),
            events: Vec::new(),
            records: Vec::new(),
            failure: None,
            stop: None,
            voided: 0,
            id: ModelId(0),
            now: SimTime::ZERO,
            seq: 0,
            digest: Trace::START,
            agents,
        }
    }

    /// Makes room for so many visits, with an effect and an event each; for one alone there will be.
    #[inline]
    pub(super) fn expect(&mut self, visits: usize) {
        if visits > 1 {
            self.effects.reserve_exact(visits);
            self.events.reserve_exact(visits);
            self.records.reserve_exact(visits);
        }
    }

    /// Begins a visit. `keys` are those of all agents.
    #[inline]
    pub(super) fn begin(&mut self, visit: &Visit<'_>, book: &Book, keys: &[u64]) {
        self.id = visit.id;
        self.now = visit.now;
        self.seq = book.seq;
        // Keys are well mixed: a key and a small number in one word collide as rarely as two keys.
        let mut digest = Trace::START;
        digest.fold(book.key ^ visit.now.nanos());
        for event in visit.events {
            let sender = if event.sender == visit.id {
                book.key
            } else {
                keys[event.sender.index()]
            };
            digest.fold(sender ^ event.seq);
            digest.fold(u64::from(event.wake.tag) << 32 | u64::from(event.wake.arg));
        }
        self.digest = digest;
    }

    /// Ends the visit.
    #[inline]
    pub(super) fn end(&mut self, book: &mut Book) {
        let digest = self.digest.hash();
        book.seq = self.seq;
        book.trace.fold(digest);
        self.records.push(Record {
            id: self.id,
            effects: self.effects.len() as u32,
            digest,
        });
    }

    /// The agent that is running.
    #[must_use]
    pub fn id(&self) -> ModelId {
        self.id
    }

    /// The instant.
    #[must_use]
    pub fn now(&self) -> SimTime {
        self.now
    }

    /// Asks for a change of the shared state; the domain commits it when the round has run.
    #[inline]
    pub fn effect(&mut self, effect: E) {
        self.effects.push(effect);
    }

    /// Wakes `receiver` (itself or another) at `time`. Now means the next round of this instant.
    ///
    /// A time that is over, or a receiver that does not exist, ends the run with an error.
    #[inline]
    pub fn schedule(&mut self, time: SimTime, receiver: ModelId, wake: Wake) {
        if time < self.now || receiver.0 >= self.agents {
            return self.refuse(time, receiver);
        }
        self.events.push(Event {
            time,
            receiver,
            sender: self.id,
            seq: self.seq,
            wake,
        });
        self.seq += 1;
    }

    #[cold]
    fn refuse(&mut self, time: SimTime, receiver: ModelId) {
        let what = if time < self.now {
            What::Past(time)
        } else {
            What::Unknown(receiver)
        };
        self.failure.get_or_insert(Failure { id: self.id, what });
    }

    /// Folds a word of what the agent did into its trace.
    #[inline]
    pub fn fold(&mut self, word: u64) {
        self.digest.fold(word);
    }

    /// Ends the run with an error that names this agent. The first fault of a round, in the order of
    /// agents, counts; the round has no effect.
    #[cold]
    pub fn fault(&mut self, message: impl Into<String>) {
        let id = self.id;
        self.failure.get_or_insert_with(|| Failure {
            id,
            what: What::Fault(message.into()),
        });
    }

    /// Ends the run well, when this instant is done. The first reason of a round counts.
    #[cold]
    pub fn stop(&mut self, reason: impl Into<String>) {
        self.stop.get_or_insert_with(|| reason.into());
    }

    /// Counts an event that the agent no longer wanted, for the statistics.
    #[inline]
    pub fn voided(&mut self) {
        self.voided += 1;
    }
}
