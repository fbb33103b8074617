//! A domain whose agents and effects are closures, for tests of one thing at a time.

use simbeeotic_kernel::{
    Committing, Domain, Engine, ModelId, Opening, Outbox, Settings, SimTime, Visit, Wake,
};

/// What an agent does when it is run.
pub(crate) type Act = Box<dyn FnMut(&Visit<'_>, &mut Outbox<Effect>) + Send>;
/// What an effect does to the log and the rest of the run.
pub(crate) type Effect = Box<dyn FnOnce(&mut Vec<String>, &mut Committing<'_>) + Send>;

/// The shared state: a log, and what is to happen by itself.
#[derive(Default)]
pub(crate) struct Script {
    pub(crate) log: Vec<String>,
    /// When `open` has something to do, and whom it visits then; earliest first.
    pub(crate) due: Vec<(SimTime, Vec<ModelId>)>,
    /// `close` asks for this many rounds more.
    pub(crate) more_rounds: u32,
    /// `open` panics at this time.
    pub(crate) panic_at: Option<SimTime>,
    /// `open` lays a fault at this model's door.
    pub(crate) fault_at: Option<(SimTime, ModelId)>,
}

impl Domain for Script {
    type Agent = Act;
    type Effect = Effect;

    fn key(&self, id: ModelId) -> u64 {
        u64::from(id.0)
    }

    fn path(&self, id: ModelId) -> String {
        format!("hive/bee-{}", id.0)
    }

    fn next_time(&mut self) -> Option<SimTime> {
        self.due.first().map(|(time, _)| *time)
    }

    fn open(&mut self, round: &mut Opening<'_>) {
        let now = round.now();
        assert_ne!(self.panic_at, Some(now), "the table is torn");
        if let Some((_, id)) = self.fault_at.filter(|(time, _)| *time == now) {
            round.fault(id, "its body is gone");
        }
        let (number, events) = (round.round(), round.events().len());
        self.log
            .push(format!("open {now} round {number}, {events} events"));
        while self.due.first().is_some_and(|(time, _)| *time <= now) {
            for id in self.due.remove(0).1 {
                round.visit(id);
            }
        }
    }

    fn run(&self, act: &mut Act, visit: &Visit<'_>, out: &mut Outbox<Effect>) {
        act(visit, out);
    }

    fn commit(&mut self, id: ModelId, effect: Effect, cx: &mut Committing<'_>) {
        self.log.push(format!("commit {}", id.0));
        effect(&mut self.log, cx);
    }

    fn close(&mut self, _: SimTime) -> bool {
        self.log.push("close".into());
        let more = self.more_rounds > 0;
        self.more_rounds = self.more_rounds.saturating_sub(1);
        more
    }
}

/// An agent that does nothing.
pub(crate) fn idle() -> Act {
    Box::new(|_, _| {})
}

/// An agent that does this.
pub(crate) fn act(act: impl FnMut(&Visit<'_>, &mut Outbox<Effect>) + Send + 'static) -> Act {
    Box::new(act)
}

/// An agent that wakes itself every so many milliseconds.
pub(crate) fn every(millis: u64) -> Act {
    act(move |visit, out| {
        let at = visit.now.saturating_add_nanos(millis * 1_000_000);
        out.schedule(at, visit.id, Wake::default());
    })
}

/// An engine over a script; agents with a time are woken then.
pub(crate) fn engine(
    script: Script,
    agents: Vec<(Option<u64>, Act)>,
    settings: Settings,
) -> Engine<Script> {
    let (wakes, acts): (Vec<_>, Vec<_>) = agents.into_iter().unzip();
    let mut engine = Engine::new(script, acts, settings).unwrap();
    for (id, millis) in wakes.into_iter().enumerate() {
        if let Some(millis) = millis {
            let time = SimTime::from_millis(millis);
            engine
                .schedule_initial(time, ModelId(id as u32), Wake::default())
                .unwrap();
        }
    }
    engine
}
