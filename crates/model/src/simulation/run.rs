//! Running: instants, observations, the end.

use super::setup::{Setup, SetupError, assemble};
use crate::component::{Component, ComponentError};
use crate::energy::{Accounts, BatteryState, Books, Condition, Consumer};
use crate::metrics::ModelMetric;
use crate::population::Population;
use crate::scene::Scene;
use crate::summary::{Batteries, ChargeLine, Lateness, Packets, Summary, TimeShares};
use crate::swarm::{Mark, Swarm, wake};
use crate::view::{Origin, View};
use crate::watch;
use simbeeotic_kernel::pace::{Clock, Control};
use simbeeotic_kernel::{
    Engine, ModelId, Progress, RunError, Settings, SimTime, Status, TraceLog, Wake,
};
use simbeeotic_radio::Loss;
use simbeeotic_units::{Pose, Twist};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// A run, ready to start.
pub struct Simulation {
    engine: Engine<Swarm>,
    origin: Origin,
    observers: Vec<Observer>,
    init_s: f64,
}

/// A component and its clock.
struct Observer {
    component: Box<dyn Component>,
    /// When it observes next.
    clock: Option<SimTime>,
    /// Marks that it has seen.
    seen: usize,
    /// Its [`Component::interest`] when it was last asked what it wants.
    interest: u64,
}

/// Wall time between two looks of the components at a held run.
const HELD_EVERY: Duration = Duration::from_millis(50);

/// How a run ended.
#[derive(Debug)]
pub struct Outcome {
    /// The numbers, as far as it came.
    pub summary: Summary,
    /// What ended it before its time.
    pub error: Option<SimulationError>,
}

/// What ends a run before its time.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SimulationError {
    /// A model, or the loop that it made.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A component: the recording cannot be written, say.
    #[error(transparent)]
    Component(#[from] ComponentError),
}

impl Simulation {
    /// Puts a run together.
    ///
    /// # Errors
    /// A model cannot be built, or there are no threads to be had.
    pub fn new(mut setup: Setup) -> Result<Self, SetupError> {
        let started = watch::now();
        let components = std::mem::take(&mut setup.components);
        let (swarm, agents) = assemble(&mut setup)?;
        let seed = setup.origin.seed;
        let settings = Settings {
            threads: setup.threads,
            seed,
            limits: setup.limits,
            ..Settings::default()
        };
        let mut engine = Engine::new(swarm, agents, settings)?;
        engine.control().set_factor(setup.pace)?;
        // A pool of its own would be woken twice an instant, while the engine's lies idle.
        if let Some(pool) = engine.pool() {
            engine.domain_mut().physics.share_threads(pool);
        }
        for id in 0..engine.agents().len() {
            // Nothing has happened yet, and every id is known: this cannot fail.
            let _ = engine.schedule_initial(
                SimTime::ZERO,
                ModelId(id as u32),
                Wake::new(wake::START, 0),
            );
        }
        let (control, progress) = (engine.control(), engine.progress());
        let observers = components
            .into_iter()
            .map(|(_, mut component)| {
                component.attach(&control, &progress);
                Observer::new(component)
            })
            .collect::<Vec<_>>();
        engine.domain_mut().keep_marks = !observers.is_empty();
        let mut simulation = Self {
            engine,
            origin: setup.origin,
            observers,
            init_s: 0.0,
        };
        simulation.choose_marks();
        simulation.init_s = started.elapsed().as_secs_f64();
        Ok(simulation)
    }

    /// Adds seconds spent before [`Simulation::new`] to what the summary calls `init`.
    pub fn add_init_time(&mut self, seconds: f64) {
        self.init_s += seconds;
    }

    /// How far the run has come, for another thread.
    pub fn progress(&self) -> Arc<Progress> {
        self.engine.progress()
    }

    /// Pace, pause, step and stop, for another thread.
    pub fn control(&self) -> Arc<Control> {
        self.engine.control()
    }

    /// Paces by another clock than the wall's: in tests, a
    /// [`FakeClock`](simbeeotic_kernel::pace::FakeClock).
    pub fn set_clock(&mut self, clock: impl Clock + 'static) {
        self.engine.set_clock(clock);
    }

    /// When the run ends by itself.
    pub fn end(&self) -> SimTime {
        self.engine.settings().limits.end
    }

    /// How far the run has come.
    pub fn now(&self) -> SimTime {
        self.engine.now()
    }

    /// What there is to be seen now, for a picture of it.
    pub fn scene(&self) -> Scene<'_> {
        Scene {
            now: self.engine.now(),
            swarm: self.engine.domain(),
            but: None,
        }
    }

    /// All models.
    pub fn population(&self) -> &Population {
        &self.engine.domain().population
    }

    /// The pose of the body of the model at `path`, now.
    pub fn pose(&self, path: &str) -> Option<Pose> {
        self.engine
            .domain()
            .pose_of(self.population().find(path)?, self.now())
    }

    /// The twist of the body of the model at `path`, now.
    pub fn twist(&self, path: &str) -> Option<Twist> {
        self.engine
            .domain()
            .twist_of(self.population().find(path)?, self.now())
    }

    /// The charge that the model at `path` has drawn, its radios' states settled up to now.
    pub fn accounts(&self, path: &str) -> Option<Accounts> {
        let id = self.population().find(path)?;
        Some(self.accounts_of(id))
    }

    /// The battery of the model at `path`, now, and its books; `None` if it has none.
    pub fn battery(&self, path: &str) -> Option<(BatteryState, Books)> {
        let id = self.population().find(path)?;
        let core = &self.engine.agents()[id.index()].core;
        self.engine.domain().battery(core, self.now())
    }

    /// What each model has published so far, by name, then by model.
    pub fn metrics(&self) -> Vec<ModelMetric> {
        self.engine.domain().metrics.by_model()
    }

    /// The trace so far.
    pub fn trace(&self) -> &TraceLog {
        self.engine.trace()
    }

    /// The hash of everything that the model at `path` did and met. It does not change when models
    /// are added that this one never meets.
    pub fn model_trace(&self, path: &str) -> Option<u64> {
        self.engine.agent_trace(self.population().find(path)?)
    }

    /// Runs up to and including `until`, without components, and may be called again.
    ///
    /// # Errors
    /// See [`RunError`]; the run is over then.
    pub fn run_until(&mut self, until: SimTime) -> Result<Status, RunError> {
        self.engine.run_until(until)
    }

    /// Where the wall time of the run so far has gone, which was `wall_s` in all, s.
    pub fn shares(&self, wall_s: f64) -> TimeShares {
        let (engine, swarm) = (&self.engine, self.engine.domain());
        let wall = &engine.stats().wall;
        // Receptions are worked out while models run, on all threads.
        let collect_s =
            swarm.radio_nanos.load(Ordering::Relaxed) as f64 * 1e-9 / engine.threads() as f64;
        let radio_s = collect_s + swarm.medium_nanos as f64 * 1e-9;
        let events_s = (wall.run_s - collect_s).max(0.0);
        let physics_s = wall.close_s + swarm.contact_nanos as f64 * 1e-9;
        TimeShares {
            init_s: self.init_s,
            events_s,
            physics_s,
            radio_s,
            other_s: (wall_s - events_s - physics_s - radio_s).max(0.0),
        }
    }

    /// Runs to the end, lets components watch, and closes them whatever happens.
    pub fn run(&mut self) -> Outcome {
        let start = watch::now();
        let result = self.watched();
        let (ended, mut error) = match result {
            Ok(reason) => (reason, None),
            Err(error) => (error.to_string(), Some(error)),
        };
        if error.is_none()
            && let Err(e) = self.finish_models()
        {
            error = Some(e.into());
        }
        let mut summary = self.summary(start, &ended);
        if let Err(e) = self.close_observers(&mut summary) {
            error.get_or_insert(e.into());
        }
        Outcome { summary, error }
    }

    /// Runs from observation to observation; says why it ended well.
    fn watched(&mut self) -> Result<String, SimulationError> {
        // A run that nobody watches waits where it is held.
        self.engine.hand_back_when_held(!self.observers.is_empty());
        for at in 0..self.observers.len() {
            let shown = AtomicBool::new(false);
            let view = view(&self.engine, &self.origin, SimTime::ZERO, &[], &shown);
            self.observers[at].component.start(&view)?;
        }
        self.choose_if_changed();
        loop {
            let next = self.observers.iter().filter_map(|o| o.clock).min();
            let target = next.unwrap_or(SimTime::MAX).min(self.end());
            let status = self.engine.run_until(target)?;
            match status {
                Status::Stopped(reason) => return Ok(reason),
                Status::WallTime => return Ok("wall time".to_owned()),
                Status::Held => {
                    self.show_held()?;
                    self.engine.wait_while_held(HELD_EVERY);
                    continue;
                }
                Status::Exhausted if self.end() == SimTime::MAX => {
                    return Ok("nothing left to do".to_owned());
                }
                // Bodies fly on without events; there is more to see until the end.
                Status::Exhausted | _ => {}
            }
            self.observe(target)?;
            if target >= self.end() {
                return Ok("end time".to_owned());
            }
        }
    }

    fn observe(&mut self, now: SimTime) -> Result<(), ComponentError> {
        let (engine, origin) = (&self.engine, &self.origin);
        let marks = &engine.domain().marks;
        for observer in &mut self.observers {
            if observer.clock == Some(now) {
                let shown = AtomicBool::new(false);
                let view = view(engine, origin, now, &marks[observer.seen..], &shown);
                observer.component.observe(&view)?;
                observer.seen = marks.len();
                let next = observer.component.next_observation(now);
                observer.clock = next.filter(|next| *next > now);
            }
        }
        self.choose_if_changed();
        self.forget_marks();
        Ok(())
    }

    /// Shows the components a run that stands: while it is held, and after its end as often as the program likes, so
    /// that they can tell of it what somebody asks then ([`Component::held`](crate::Component::held)). Marks that one
    /// of them looks at are not shown to it again; those that it leaves are there at its next observation.
    ///
    /// # Errors
    /// What a component says.
    pub fn show_held(&mut self) -> Result<(), ComponentError> {
        let (engine, origin) = (&self.engine, &self.origin);
        let marks = &engine.domain().marks;
        for observer in &mut self.observers {
            let shown = AtomicBool::new(false);
            let new = &marks[observer.seen..];
            let view = view(engine, origin, engine.now(), new, &shown);
            observer.component.held(&view)?;
            if shown.into_inner() {
                observer.seen = marks.len();
            }
        }
        self.choose_if_changed();
        Ok(())
    }

    /// Asks the components anew what they want to be noted, if one has changed its mind.
    fn choose_if_changed(&mut self) {
        let changed = |o: &Observer| o.component.interest() != o.interest;
        if self.observers.iter().any(changed) {
            self.choose_marks();
        }
    }

    /// Asks the components whose readings and packets they want to be noted.
    fn choose_marks(&mut self) {
        for observer in &mut self.observers {
            observer.interest = observer.component.interest();
        }
        let components = self.observers.iter().map(|o| &*o.component);
        let components: Vec<&dyn Component> = components.collect();
        let swarm = self.engine.domain_mut();
        swarm.choose_readings(&components);
        swarm.choose_packets(&components);
    }

    /// Drops the marks that every component has seen.
    fn forget_marks(&mut self) {
        let seen = self
            .observers
            .iter()
            .filter(|o| o.clock.is_some())
            .map(|o| o.seen)
            .min();
        let all = self.engine.domain().marks.len();
        let drop = seen.unwrap_or(all);
        self.engine.domain_mut().marks.drain(..drop);
        for observer in &mut self.observers {
            observer.seen = observer.seen.saturating_sub(drop);
        }
    }

    /// Wakes every model once more, at the time the run has come to.
    fn finish_models(&mut self) -> Result<(), RunError> {
        self.engine.limits_mut().wall = None;
        let now = self.engine.now();
        for id in 0..self.engine.agents().len() {
            self.engine
                .schedule_initial(now, ModelId(id as u32), Wake::new(wake::FINISH, 0))?;
        }
        self.engine.run_until(now).map(drop)
    }

    /// Closes all components, also after one of them has failed.
    fn close_observers(&mut self, summary: &mut Summary) -> Result<(), ComponentError> {
        let (engine, origin) = (&self.engine, &self.origin);
        let marks = &engine.domain().marks;
        let mut notes = Vec::new();
        let mut failed = None;
        for observer in &mut self.observers {
            let shown = AtomicBool::new(false);
            let new = &marks[observer.seen..];
            let view = view(engine, origin, engine.now(), new, &shown);
            match observer.component.finish(&view, summary) {
                Ok(lines) => notes.extend(lines),
                Err(error) => {
                    failed.get_or_insert(error);
                }
            }
        }
        summary.notes = notes;
        failed.map_or(Ok(()), Err)
    }

    fn accounts_of(&self, id: ModelId) -> Accounts {
        let core = &self.engine.agents()[id.index()].core;
        self.engine.domain().accounts(core, self.engine.now())
    }

    /// All batteries, if there are any, and the energy that they gave each consumer, J.
    fn batteries(&self) -> (Option<Batteries>, [f64; Consumer::ALL.len()]) {
        let (swarm, now) = (self.engine.domain(), self.engine.now());
        let mut all = Batteries {
            soc_min: 1.0,
            ..Batteries::default()
        };
        let mut joules = [0.0; Consumer::ALL.len()];
        for agent in self.engine.agents() {
            let Some((state, books)) = swarm.battery(&agent.core, now) else {
                continue;
            };
            all.count += 1;
            all.soc_min = all.soc_min.min(state.soc);
            all.soc_mean += state.soc;
            all.out_of_power += usize::from(state.condition != Condition::Fit);
            all.emptied += u64::from(books.empties);
            all.charged += u64::from(books.fills);
            all.spent_j += (books.start - books.stored).get();
            all.charged_j += books.charged.get();
            all.heat_j += books.heat.get();
            for (sum, consumer) in joules.iter_mut().zip(Consumer::ALL) {
                *sum += books.used(consumer).get();
            }
        }
        all.soc_mean /= all.count.max(1) as f64;
        ((all.count > 0).then_some(all), joules)
    }

    fn summary(&self, start: Instant, ended: &str) -> Summary {
        let (engine, swarm) = (&self.engine, self.engine.domain());
        let stats = engine.stats();
        let wall_s = start.elapsed().as_secs_f64();
        let virtual_s = engine.now().as_secs_f64();
        let mut total = Accounts::default();
        for id in 0..engine.agents().len() {
            total.add(&self.accounts_of(ModelId(id as u32)));
        }
        let (batteries, joules) = self.batteries();
        let lateness = engine.lateness();
        Summary {
            scenario: self.origin.name.clone(),
            seed: self.origin.seed,
            models: swarm.population.len(),
            bodies: swarm.bodies.iter().flatten().count(),
            radios: engine.agents().iter().map(|a| a.core.radios.len()).sum(),
            threads: engine.threads(),
            ended: ended.to_owned(),
            virtual_s,
            wall_s,
            speed: virtual_s / wall_s.max(1e-9),
            time: self.shares(wall_s),
            events: stats.events,
            instants: stats.instants,
            touches: swarm.touch_count,
            packets: packets(swarm),
            charge: Consumer::ALL
                .into_iter()
                .map(|consumer| {
                    let milliampere_seconds = total.drawn(consumer).get() * 1e3;
                    let line = ChargeLine {
                        milliampere_seconds,
                        joules: batteries.map(|_| joules[consumer as usize]),
                    };
                    (consumer.name().to_owned(), line)
                })
                .collect(),
            batteries,
            metrics: swarm.metrics.lines(),
            lateness: engine.control().factor().map(|_| Lateness {
                late: lateness.late,
                max_ms: lateness.max.as_secs_f64() * 1e3,
            }),
            trace_hash: format!("{:016x}", engine.trace().total()),
            trace_seconds: trace_seconds(engine.trace()),
            notes: Vec::new(),
        }
    }
}

impl Observer {
    fn new(component: Box<dyn Component>) -> Self {
        let period = component.period().and_then(|p| SimTime::from_time(p).ok());
        let clock = period
            .filter(|period| *period > SimTime::ZERO)
            .map(|_| SimTime::ZERO);
        Self {
            component,
            clock,
            seen: 0,
            interest: 0,
        }
    }
}

fn view<'a>(
    engine: &'a Engine<Swarm>,
    origin: &'a Origin,
    now: SimTime,
    marks: &'a [Mark],
    shown: &'a AtomicBool,
) -> View<'a> {
    View {
        now,
        end: engine.settings().limits.end,
        swarm: engine.domain(),
        agents: engine.agents(),
        marks,
        shown,
        origin,
    }
}

/// The hash at the end of each virtual second, those in which nothing happened included.
fn trace_seconds(trace: &TraceLog) -> Vec<String> {
    let mut seconds = Vec::new();
    let mut last = simbeeotic_kernel::Trace::START.hash();
    for mark in trace.marks() {
        while (seconds.len() as u64) < mark.second {
            seconds.push(format!("{last:016x}"));
        }
        last = mark.hash;
        seconds.push(format!("{last:016x}"));
    }
    seconds
}

fn packets(swarm: &Swarm) -> Packets {
    let Some(medium) = &swarm.medium else {
        return Packets::default();
    };
    let counters = medium.totals();
    let lost = Loss::ALL
        .into_iter()
        .map(|why| (why.name().to_owned(), counters.lost(why)));
    Packets {
        sent: counters.sent,
        received: counters.received,
        lost: lost.filter(|(_, n)| *n > 0).collect(),
    }
}
