//! The loop over instants and rounds.

use super::{
    Engine, RunError, Status,
    domain::{Committing, Domain, Opening},
    error::{Failure, What},
    outbox::Outbox,
    round::{CHUNK, Round, list_calls, message},
};
use crate::{
    Event, ModelId, PendingEvents, SimTime,
    pace::Gate,
    queue::Queue,
    stats::{Watch, is_big},
};
use std::{
    hint::black_box,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::Arc,
};

/// Who is to blame for a panic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    Open,
    Run,
    Commit(ModelId),
    Close,
}

/// Agents whose memory is fetched together.
const WARM: usize = 16;
/// Fewer agents than this stay in the caches by themselves.
const COLD_FROM: usize = 4096;
/// How many of the models in a loop are named.
const NAMED: usize = 16;
/// The last rounds before the limit are watched for who is awake.
const WATCHED: u32 = 64;

impl<D: Domain> Engine<D> {
    /// Runs everything up to and including `until`, or [`Limits::end`](super::Limits::end) if that is
    /// earlier.
    ///
    /// Can be called again with a later time: a run in pieces is the same run. With pacing, returns when
    /// the wall clock says so.
    ///
    /// # Errors
    ///
    /// See [`RunError`]. After an error the engine is over, and gives the same error again.
    pub fn run_until(&mut self, until: SimTime) -> Result<Status, RunError> {
        if let Some(error) = &self.failed {
            return Err(error.clone());
        }
        let until = until.min(self.settings.limits.end).max(self.now);
        let result = match self.pool.as_ref().map(Arc::clone) {
            // The loop itself runs on a thread of the pool: handing out a round is then a push to a
            // local queue instead of a message between threads.
            Some(pool) => pool.install(|| self.run_caught(until)),
            None => self.run_caught(until),
        };
        if let Err(error) = &result {
            self.failed = Some(error.clone());
        }
        result
    }

    fn run_caught(&mut self, until: SimTime) -> Result<Status, RunError> {
        match catch_unwind(AssertUnwindSafe(|| self.drive(until))) {
            Ok(result) => result,
            Err(payload) => {
                let message = message(&*payload);
                let id = match self.phase {
                    Phase::Run => self.boxes[0].id,
                    Phase::Commit(id) => id,
                    Phase::Open | Phase::Close => {
                        let (time, seed) = (self.now, self.settings.seed);
                        return Err(RunError::SharedPanic {
                            time,
                            seed,
                            message,
                        });
                    }
                };
                Err(self.explain(Failure {
                    id,
                    what: What::Panic(message),
                }))
            }
        }
    }

    fn drive(&mut self, until: SimTime) -> Result<Status, RunError> {
        loop {
            let queued = self.queue.next_time();
            let next = if self.again {
                Some(self.now)
            } else {
                match (queued, self.domain.next_time()) {
                    (Some(queued), Some(shared)) => Some(queued.min(shared).max(self.now)),
                    (Some(time), None) | (None, Some(time)) => Some(time.max(self.now)),
                    (None, None) => None,
                }
            };
            match next {
                Some(next) if self.instant == Some(next) => {
                    self.round += 1;
                    self.check_rounds()?;
                }
                Some(next) if next <= until => {
                    if self.reached != Some(next)
                        && let Some(status) = self.pass(next, false)
                    {
                        return Ok(status);
                    }
                    self.begin(next);
                }
                _ => return Ok(self.rest(until, next.is_none())),
            }
            self.one_round(queued == next)?;
        }
    }

    /// Lets time come to `target`; a status if the run has to stop before.
    fn pass(&mut self, target: SimTime, idle: bool) -> Option<Status> {
        if let Some(reason) = &self.stopped {
            return Some(Status::Stopped(reason.clone()));
        }
        loop {
            match self.pacer.gate(target, idle, self.settings.limits.wall) {
                Gate::Go => {
                    self.come(target);
                    return None;
                }
                Gate::Come(time) => {
                    self.come(time);
                    self.progress.set(time, self.stats.events);
                }
                Gate::Held => return Some(Status::Held),
                Gate::Stop(reason) => {
                    self.stopped = Some(reason.clone());
                    return Some(Status::Stopped(reason));
                }
                Gate::WallTime => return Some(Status::WallTime),
            }
        }
    }

    fn come(&mut self, time: SimTime) {
        self.now = time;
        self.reached = Some(time);
    }

    /// Begins an instant: its first round follows.
    fn begin(&mut self, now: SimTime) {
        self.instant = Some(now);
        self.round = 0;
        self.instant_events = 0;
        self.awake.clear();
        self.stats.instants += 1;
        self.trace.begin(now);
    }

    /// Nothing more happens up to `until`: the clock goes there, unless that is the end of time.
    fn rest(&mut self, until: SimTime, exhausted: bool) -> Status {
        if let Some(reason) = &self.stopped {
            return Status::Stopped(reason.clone());
        }
        if until != SimTime::MAX
            && self.reached != Some(until)
            && let Some(status) = self.pass(until, true)
        {
            return status;
        }
        if exhausted {
            Status::Exhausted
        } else {
            Status::Reached
        }
    }

    /// One round of the instant: the order of work that the module's page shows.
    fn one_round(&mut self, events_due: bool) -> Result<(), RunError> {
        let mut watch = Watch::start(self.stats.rounds, self.last_big);
        self.batch.clear();
        if events_due {
            self.queue.pop_instant(&mut self.batch);
        }
        self.warm_upcoming();
        watch.size(self.batch.len());
        watch.lap(&mut self.stats.wall.queue_s);

        self.phase = Phase::Open;
        let mut failure = None;
        self.domain.open(&mut Opening {
            now: self.now,
            round: self.round,
            events: &self.batch,
            visits: &mut self.extra,
            trace: &mut self.trace,
            failure: &mut failure,
        });
        list_calls(&self.batch, &mut self.extra, &mut self.calls);
        // The domain may have called up many agents without any event.
        watch.size(self.calls.len());
        watch.lap(&mut self.stats.wall.open_s);

        self.stats.rounds += 1;
        self.stats.visits += self.calls.len() as u64;
        self.stats.events += self.batch.len() as u64;
        self.instant_events += self.batch.len() as u64;
        self.progress.set(self.now, self.stats.events);
        self.last_big = is_big(self.calls.len());
        if self.last_big {
            self.pacer.check_wall_soon();
        }
        if let Some(failure) = failure {
            return Err(self.explain(failure));
        }
        self.check_events()?;

        self.phase = Phase::Run;
        let used = self.run_agents();
        watch.lap(&mut self.stats.wall.run_s);

        self.commit(used)?;
        watch.lap(&mut self.stats.wall.commit_s);

        self.flush(used)?;
        watch.lap(&mut self.stats.wall.queue_s);

        self.phase = Phase::Close;
        self.again = self.domain.close(self.now);
        watch.lap(&mut self.stats.wall.close_s);
        Ok(())
    }

    /// Has the memory of the agents fetched that will run next, a group at a time.
    #[inline]
    fn warm_upcoming(&mut self) {
        if self.warmed > self.batch.len() {
            self.warmed -= self.batch.len();
        } else if self.agents.len() >= COLD_FROM {
            self.warm_group();
        }
    }

    fn warm_group(&mut self) {
        let next = self.queue.upcoming();
        let next = &next[..next.len().min(WARM)];
        let mut word = 0;
        for event in next {
            let index = event.receiver.index();
            word ^= self.books[index].seq ^ self.domain.warm(event.receiver, &self.agents[index]);
        }
        black_box(word);
        self.warmed = next.len();
    }

    /// Runs the agents of the round; returns how many outboxes hold what they asked for.
    fn run_agents(&mut self) -> usize {
        let round = Round {
            domain: &self.domain,
            now: self.now,
            round: self.round,
            events: &self.batch,
            keys: &self.keys,
        };
        let chunks = self.calls.len().div_ceil(CHUNK).max(1);
        let agents = self.keys.len() as u32;
        if self.boxes.len() < chunks {
            self.boxes.resize_with(chunks, || Outbox::new(agents));
        }
        let boxes = &mut self.boxes[..chunks];
        if self.pool.is_some() && self.calls.len() >= self.settings.parallel_from && chunks > 1 {
            round.run_parallel(&self.calls, 0, &mut self.agents, &mut self.books, boxes);
        } else if let [out] = boxes {
            round.run(&self.calls, 0, &mut self.agents, &mut self.books, out);
        } else {
            for (calls, out) in self.calls.chunks(CHUNK).zip(boxes) {
                round.run_caught(calls, 0, &mut self.agents, &mut self.books, out);
                if out.failure.is_some() {
                    break;
                }
            }
        }
        chunks
    }

    /// Folds the visits and commits their effects, in the order of agents.
    fn commit(&mut self, used: usize) -> Result<(), RunError> {
        let boxes = &mut self.boxes[..used];
        if let Some(failure) = boxes.iter_mut().find_map(|out| out.failure.take()) {
            return Err(self.explain(failure));
        }
        for out in &mut *boxes {
            if let Some(reason) = out.stop.take() {
                self.stopped.get_or_insert(reason);
            }
            self.stats.voided += std::mem::take(&mut out.voided);
        }

        let mut failure = None;
        'boxes: for out in boxes {
            let mut effects = out.effects.drain(..);
            let mut done = 0;
            for record in out.records.drain(..) {
                self.trace.fold(record.digest);
                if done == record.effects {
                    continue;
                }
                self.phase = Phase::Commit(record.id);
                let mut cx = Committing {
                    now: self.now,
                    id: record.id,
                    books: &mut self.books,
                    events: &mut self.committed,
                    trace: &mut self.trace,
                    failure: &mut failure,
                    stop: &mut self.stopped,
                };
                for effect in effects.by_ref().take((record.effects - done) as usize) {
                    self.domain.commit(record.id, effect, &mut cx);
                    if cx.failure.is_some() {
                        break 'boxes;
                    }
                }
                done = record.effects;
            }
        }
        failure.map_or(Ok(()), |failure| Err(self.explain(failure)))
    }

    /// Puts the events of the round into the queue. Their order does not matter: they have a total one.
    fn flush(&mut self, used: usize) -> Result<(), RunError> {
        let mut last = None;
        for out in &mut self.boxes[..used] {
            last = drain_into(&mut self.queue, &mut out.events).or(last);
        }
        last = drain_into(&mut self.queue, &mut self.committed).or(last);

        let (pending, limit) = (self.queue.len(), self.settings.limits.queue);
        match last {
            Some(last) if pending > limit => {
                let (path, time) = (self.domain.path(last), self.now);
                Err(RunError::QueueFull {
                    path,
                    time,
                    pending,
                    limit,
                })
            }
            _ => Ok(()),
        }
    }

    /// Whether one more round of this instant is allowed; `calls` still holds those of the last one.
    #[inline]
    fn check_rounds(&mut self) -> Result<(), RunError> {
        let limit = self.settings.limits.rounds_per_instant;
        if self.round.saturating_add(WATCHED) < limit {
            Ok(())
        } else {
            self.watch_rounds(limit)
        }
    }

    #[cold]
    fn watch_rounds(&mut self, limit: u32) -> Result<(), RunError> {
        for call in &self.calls {
            if self.awake.len() < NAMED && !self.awake.contains(&call.id) {
                self.awake.push(call.id);
            }
        }
        if self.round < limit {
            return Ok(());
        }
        self.awake.sort_unstable();
        let paths = self.awake.iter().map(|&id| self.domain.path(id)).collect();
        Err(RunError::ZeroDelayLoop {
            paths,
            time: self.now,
            rounds: self.round,
        })
    }

    #[inline]
    fn check_events(&self) -> Result<(), RunError> {
        let (events, limit) = (self.instant_events, self.settings.limits.events_per_instant);
        match self.batch.last() {
            Some(last) if events > limit => {
                let (path, time) = (self.domain.path(last.receiver), self.now);
                Err(RunError::TooManyEvents {
                    path,
                    time,
                    events,
                    limit,
                })
            }
            _ => Ok(()),
        }
    }
}

/// Moves events into the queue; returns who sent the last of them.
#[inline]
fn drain_into(queue: &mut Queue, events: &mut Vec<Event>) -> Option<ModelId> {
    let last = events.last()?.sender;
    for event in &*events {
        queue.push(*event);
    }
    events.clear();
    Some(last)
}
