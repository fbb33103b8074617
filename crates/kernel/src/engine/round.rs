//! Running the agents of one round, on one thread or many.
//!
//! Visits are sorted by agent, so a cut through the list of visits is a cut through the slice of
//! agents: halves are handed to two threads with `split_at_mut`, and again, down to chunks of a fixed
//! number of visits. Each chunk has an outbox of its own, also on one thread, where a single one would
//! hold half as much again whenever it grows; they are committed in the order of chunks.
//! Nothing is moved, locked or allocated.

use super::{
    Book,
    domain::{Domain, Visit},
    error::{Failure, What},
    outbox::Outbox,
};
use crate::{Event, ModelId, SimTime};
use std::{
    any::Any,
    panic::{AssertUnwindSafe, catch_unwind},
};

/// Visits in a chunk: enough to be worth a thread's attention, few enough to share out evenly.
pub(super) const CHUNK: usize = 64;

/// An agent and its events, as a range of the round's batch.
#[derive(Clone, Copy, Debug)]
pub(super) struct Call {
    pub(super) id: ModelId,
    pub(super) from: u32,
    pub(super) to: u32,
}

/// What all visits of a round share.
pub(super) struct Round<'a, D: Domain> {
    pub(super) domain: &'a D,
    pub(super) now: SimTime,
    pub(super) round: u32,
    pub(super) events: &'a [Event],
    pub(super) keys: &'a [u64],
}

impl<D: Domain> Round<'_, D> {
    /// Runs visits one after the other, up to the first failure. `base` is the id of `agents[0]`.
    #[inline]
    pub(super) fn run(
        &self,
        calls: &[Call],
        base: usize,
        agents: &mut [D::Agent],
        books: &mut [Book],
        out: &mut Outbox<D::Effect>,
    ) {
        out.expect(calls.len());
        for call in calls {
            let visit = Visit {
                now: self.now,
                round: self.round,
                id: call.id,
                events: &self.events[call.from as usize..call.to as usize],
            };
            let index = call.id.index() - base;
            out.begin(&visit, &books[index], self.keys);
            self.domain.run(&mut agents[index], &visit, out);
            out.end(&mut books[index]);
            if out.failure.is_some() {
                break;
            }
        }
    }

    /// The same; a panic becomes the failure of the agent that was running.
    pub(super) fn run_caught(
        &self,
        calls: &[Call],
        base: usize,
        agents: &mut [D::Agent],
        books: &mut [Book],
        out: &mut Outbox<D::Effect>,
    ) {
        let run = || self.run(calls, base, agents, books, out);
        if let Err(payload) = catch_unwind(AssertUnwindSafe(run)) {
            out.failure = Some(Failure {
                id: out.id,
                what: What::Panic(message(&*payload)),
            });
        }
    }

    /// Runs visits on all threads, one outbox a chunk.
    pub(super) fn run_parallel(
        &self,
        calls: &[Call],
        base: usize,
        agents: &mut [D::Agent],
        books: &mut [Book],
        outs: &mut [Outbox<D::Effect>],
    ) {
        if let [out] = outs {
            return self.run_caught(calls, base, agents, books, out);
        }
        let half = outs.len() / 2;
        let (calls, more_calls) = calls.split_at(half * CHUNK);
        let cut = more_calls[0].id.index();
        let (agents, more_agents) = agents.split_at_mut(cut - base);
        let (books, more_books) = books.split_at_mut(cut - base);
        let (outs, more_outs) = outs.split_at_mut(half);
        rayon::join(
            || self.run_parallel(calls, base, agents, books, outs),
            || self.run_parallel(more_calls, cut, more_agents, more_books, more_outs),
        );
    }
}

/// What a panic said.
pub(super) fn message(payload: &(dyn Any + Send)) -> String {
    if let Some(text) = payload.downcast_ref::<&str>() {
        (*text).to_owned()
    } else if let Some(text) = payload.downcast_ref::<String>() {
        text.clone()
    } else {
        "a panic without a message".to_owned()
    }
}

/// Lists who is visited in a round: the receivers of `events` (sorted) and `extra`, each once, by id.
#[inline]
pub(super) fn list_calls(events: &[Event], extra: &mut Vec<ModelId>, calls: &mut Vec<Call>) {
    calls.clear();
    match (events, &extra[..]) {
        ([event], []) => calls.push(Call {
            id: event.receiver,
            from: 0,
            to: 1,
        }),
        _ => merge_calls(events, extra, calls),
    }
}

fn merge_calls(events: &[Event], extra: &mut Vec<ModelId>, calls: &mut Vec<Call>) {
    extra.sort_unstable();
    extra.dedup();
    calls.reserve_exact(events.len() + extra.len());
    let mut extra = extra.drain(..).peekable();
    let mut from = 0;
    while let Some(event) = events.get(from) {
        let id = event.receiver;
        while let Some(id) = extra.next_if(|extra| *extra < id) {
            calls.push(Call { id, from: 0, to: 0 });
        }
        extra.next_if_eq(&id);
        let count = events[from..]
            .iter()
            .take_while(|event| event.receiver == id)
            .count();
        calls.push(Call {
            id,
            from: from as u32,
            to: (from + count) as u32,
        });
        from += count;
    }
    calls.extend(extra.map(|id| Call { id, from: 0, to: 0 }));
}
