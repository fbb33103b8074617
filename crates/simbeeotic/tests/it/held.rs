//! Components that hold a run, step it, look at it meanwhile and change their minds: none of it shows.

use crate::program::Program;
use simbeeotic::prelude::{SimTime, Time};
use simbeeotic::scenario::{Request, load_text};
use simbeeotic_model::kernel::Progress;
use simbeeotic_model::kernel::pace::{Clock, Control, FakeClock};
use simbeeotic_model::{Component, ComponentError, Mark, Note, Outcome, Simulation, Summary, View};
use simbeeotic_record::{Links, Packet, Recording};
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// What a watcher is called for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Call {
    Start,
    Observe,
    Held,
}

/// What a watcher wants to be noted.
#[derive(Clone, Default)]
struct Wants {
    version: u64,
    readings: bool,
    packets: bool,
}

type Script = dyn FnMut(Call, &View<'_>, &Control, &mut Wants) + Send;

/// Does at each call what its script says.
struct Watcher {
    period: Time,
    control: Option<Arc<Control>>,
    wants: Wants,
    script: Box<Script>,
}

impl Watcher {
    fn new(
        period_ms: f64,
        script: impl FnMut(Call, &View<'_>, &Control, &mut Wants) + Send + 'static,
    ) -> Self {
        Self {
            period: Time::from_millis(period_ms),
            control: None,
            wants: Wants::default(),
            script: Box::new(script),
        }
    }

    fn call(&mut self, call: Call, view: &View<'_>) {
        let control = self.control.as_ref().expect("attached before any call");
        (self.script)(call, view, control, &mut self.wants);
    }
}

impl Component for Watcher {
    fn period(&self) -> Option<Time> {
        Some(self.period)
    }

    fn wants_reading(&self, _: &str) -> bool {
        self.wants.readings
    }

    fn wants_packets(&self, _: &str, _: usize) -> bool {
        self.wants.packets
    }

    fn interest(&self) -> u64 {
        self.wants.version
    }

    fn attach(&mut self, control: &Arc<Control>, _: &Arc<Progress>) {
        self.control = Some(Arc::clone(control));
    }

    fn held(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.call(Call::Held, view);
        Ok(())
    }

    fn start(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.call(Call::Start, view);
        Ok(())
    }

    fn observe(&mut self, view: &View<'_>) -> Result<(), ComponentError> {
        self.call(Call::Observe, view);
        Ok(())
    }

    fn finish(&mut self, view: &View<'_>, _: &Summary) -> Result<Vec<Note>, ComponentError> {
        self.call(Call::Observe, view);
        Ok(Vec::new())
    }
}

/// Twelve bees that bump into each other, read compasses and talk.
const BEES: &str = r#"
    [run]
    seed = 5
    end_time = "3 s"
    [channel]
    use = "free-space"
    range_limit = "30 m"
    [[model]]
    use = "instrument-bee"
    name = "bee"
    count = 12
    start = { box = ["1 m", "1 m", "1 m"] }
    vehicle = { use = "simple-bee", bee_collisions = true }
    sensor.compass = { use = "compass" }
    radio = { use = "cc2420" }
"#;

fn run(text: &str, components: Vec<Watcher>) -> (Outcome, FakeClock) {
    let loaded = load_text("bees", text, &Request::default()).expect("a good scenario");
    let mut setup = loaded.setup().expect("a good scenario");
    for component in components {
        let named = ("watcher".to_owned(), Box::new(component) as _);
        setup.components.push(named);
    }
    let mut run = Simulation::new(setup).expect("a good scenario");
    let clock = FakeClock::new();
    run.set_clock(clock.clone());
    (run.run(), clock)
}

fn hash(components: Vec<Watcher>) -> String {
    let (outcome, _) = run(BEES, components);
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    assert_eq!(outcome.summary.ended, "end time");
    outcome.summary.trace_hash
}

/// A list that a script writes and a test reads.
type List<T> = Arc<Mutex<Vec<T>>>;

fn list<T>() -> (List<T>, List<T>) {
    let list = List::default();
    (Arc::clone(&list), list)
}

fn taken<T>(list: &List<T>) -> Vec<T> {
    std::mem::take(&mut list.lock().expect("one thread at a time"))
}

/// What tells marks apart.
fn said(view: &View<'_>) -> Vec<String> {
    view.marks()
        .iter()
        .map(|mark| format!("{mark:?}"))
        .collect()
}

#[test]
fn pauses_steps_and_looks_do_not_show() {
    let alone = hash(Vec::new());
    assert_eq!(alone, hash(vec![Watcher::new(100.0, |_, _, _, _| {})]));
    let mut looks = 0;
    let busy = Watcher::new(130.0, move |call, view, control, wants| {
        looks += 1;
        *wants = Wants {
            version: looks / 3,
            readings: looks % 2 == 0,
            packets: looks % 5 < 3,
        };
        for id in view.bodies() {
            assert!(
                view.pose(id)
                    .is_some_and(|pose| pose.position.si().is_finite())
            );
        }
        match (call, looks % 7) {
            (Call::Start, _) => control.pause(),
            (Call::Held, 0) => control.resume(),
            (Call::Held, 1) => control.step(3),
            (Call::Held, 2) => control.step_by(7_300_000),
            (Call::Held, 3) => control.set_factor(Some(2.0)).expect("a pace"),
            (Call::Held, 4) => control.set_factor(None).expect("no pace"),
            (Call::Held, 5) => control.step_to(SimTime::from_nanos(view.now().nanos() + 1)),
            (Call::Observe, 2 | 4) => control.pause(),
            _ => {}
        }
    });
    assert_eq!(alone, hash(vec![busy, Watcher::new(70.0, |_, _, _, _| {})]));
}

#[test]
fn a_run_that_starts_paused_is_shown_and_waits() {
    let (writes, calls) = list();
    let watcher = Watcher::new(500.0, move |call, view, control, _| {
        if call == Call::Start {
            control.pause();
        }
        let all = view.bodies().count();
        let mut calls = writes.lock().expect("one thread at a time");
        calls.push((call, view.now(), all));
        // Three seconds of looks at every twentieth of a second.
        if calls.len() == 62 {
            control.stop("seen enough");
        }
    });
    let (outcome, clock) = run(BEES, vec![watcher]);
    assert!(outcome.error.is_none());
    assert_eq!(outcome.summary.ended, "seen enough");
    assert_eq!((outcome.summary.events, outcome.summary.instants), (0, 0));
    let calls = taken(&calls);
    assert_eq!(calls[0], (Call::Start, SimTime::ZERO, 12));
    let held = calls
        .iter()
        .filter(|call| **call == (Call::Held, SimTime::ZERO, 12));
    assert_eq!(held.count(), 61);
    assert_eq!(clock.now(), Duration::from_secs(3));
}

#[test]
fn a_held_run_is_shown_where_it_stands() {
    let (writes, calls) = list();
    let mut held = 0;
    let watcher = Watcher::new(1000.0, move |call, view, control, _| {
        let id = view.bodies().next().expect("a bee");
        let at = view.pose(id).expect("a bee").position;
        let now = view.now();
        let mut calls = writes.lock().expect("one thread at a time");
        calls.push((call, now.as_secs_f64(), at));
        if call == Call::Observe && now == SimTime::from_secs(1) {
            control.pause();
        }
        if call == Call::Held {
            held += 1;
            match held {
                1 => control.step_by(250_000_000),
                // Across an observation.
                2 => control.step_to(SimTime::from_millis(2100)),
                3 => control.set_factor(Some(10.0)).expect("a pace"),
                4 => {}
                _ => control.resume(),
            }
        }
    });
    let (outcome, clock) = run(BEES, vec![watcher]);
    assert_eq!(outcome.summary.ended, "end time");
    let calls = taken(&calls);
    let order: Vec<(Call, f64)> = calls.iter().map(|(call, at, _)| (*call, *at)).collect();
    let expected = [
        (Call::Start, 0.0),
        (Call::Observe, 0.0),
        (Call::Observe, 1.0),
        (Call::Held, 1.0),
        (Call::Held, 1.25),
        (Call::Observe, 2.0),
        (Call::Held, 2.1),
        (Call::Held, 2.1),
        (Call::Held, 2.1),
        (Call::Observe, 3.0),
        // At the end.
        (Call::Observe, 3.0),
    ];
    assert_eq!(order, expected);
    // What stands does not move; what is stepped does.
    assert_eq!(calls[2].2, calls[3].2);
    assert_ne!(calls[3].2, calls[4].2);
    assert_eq!(calls[6].2, calls[8].2);
    // A look that nobody interrupts takes a twentieth of a second; the rest of the run a tenth of its
    // virtual time.
    assert_eq!(clock.now(), Duration::from_millis(50 + 90));
}

#[test]
fn marks_are_shown_once_and_kept_for_those_who_do_not_look() {
    let all = |when: fn(&SimTime) -> bool| {
        let (writes, marks) = list();
        let (writes_too, others) = list();
        let looks = Watcher::new(300.0, move |call, view, control, wants| {
            *wants = Wants {
                version: 1,
                readings: true,
                packets: true,
            };
            let marks = said(view);
            writes.lock().expect("one thread at a time").extend(marks);
            match call {
                Call::Held => control.step_by(40_000_000),
                _ if when(&view.now()) => control.pause(),
                _ => {}
            }
            if view.now() > SimTime::from_millis(2500) {
                control.resume();
            }
        });
        // This one does not look while the run is held.
        let waits = Watcher::new(500.0, move |call, view, _, _| {
            if call == Call::Observe {
                writes_too
                    .lock()
                    .expect("one thread at a time")
                    .extend(said(view));
            }
        });
        assert!(!hash(vec![looks, waits]).is_empty());
        (taken(&marks), taken(&others))
    };
    let (marks, others) = all(|_| false);
    let kinds: BTreeSet<&str> = marks.iter().filter_map(|m| m.split(' ').next()).collect();
    assert!(
        kinds.contains("OnAir") && kinds.contains("Heard"),
        "{kinds:?}"
    );
    assert!(
        kinds.contains("Sensed") && kinds.contains("Touch"),
        "{kinds:?}"
    );
    assert_eq!(marks, others);
    let (held, others) = all(|now| now.nanos() > 0);
    assert_eq!(held, marks, "by the one who looks");
    assert_eq!(others, marks, "by the one who does not");
}

#[test]
fn readings_and_packets_are_noted_from_when_they_are_wanted() {
    let (writes, seen) = list();
    let watcher = Watcher::new(100.0, move |_, view, _, wants| {
        let second = view.now().nanos() / 1_000_000_000;
        *wants = Wants {
            version: second + 1,
            readings: second == 1,
            packets: second != 1,
        };
        for mark in view.marks() {
            let seen = match mark {
                Mark::Sensed { time, .. } => ("sensed", *time),
                Mark::OnAir { time, .. } => ("on air", *time),
                _ => continue,
            };
            writes.lock().expect("one thread at a time").push(seen);
        }
    });
    assert_eq!(hash(vec![watcher]), hash(Vec::new()));
    let seen = taken(&seen);
    let within = |what: &str, from_s: u64, to_s: u64| {
        let times = seen
            .iter()
            .filter(|(kind, _)| *kind == what)
            .map(|(_, at)| at);
        let [from, to] = [from_s, to_s].map(SimTime::from_secs);
        // What is chosen at an observation counts from the next instant on.
        times.filter(|at| **at > from && **at <= to).count()
    };
    assert_eq!(within("sensed", 0, 1), 0);
    assert!(within("sensed", 1, 2) >= 12, "each bee once");
    assert_eq!(within("sensed", 2, 3), 0);
    assert!(within("on air", 0, 1) > 0);
    assert_eq!(within("on air", 1, 2), 0);
    assert!(within("on air", 2, 3) > 0);
}

/// Packets and links that a recorder has written beside other components.
fn recorded(others: Vec<Watcher>) -> (Vec<Packet>, Vec<Links>) {
    let program = Program::new();
    let path = program.path("run.mcap");
    let recorder = format!("[[component]]\nuse = \"recorder\"\npath = {path:?}\n");
    let text = format!("{BEES}{recorder}packets = [\"bee-0/*\", \"bee-1/*\"]\n");
    let (outcome, _) = run(&text, others);
    assert!(outcome.error.is_none(), "{:?}", outcome.error);
    let recording = Recording::open(&path).expect("a good recording");
    let packets = recording
        .packets_in(0..=u64::MAX)
        .map(|p| p.expect("a packet"));
    let links = recording.links_in(0..=u64::MAX).map(|l| l.expect("links"));
    (packets.collect(), links.collect())
}

#[test]
fn a_recorder_keeps_what_it_was_asked_for_whatever_others_want() {
    let alone = recorded(Vec::new());
    assert!(alone.0.len() >= 6 && !alone.1.is_empty(), "{alone:?}");
    // This one wants all packets for a while, and changes its mind while frames are on the air.
    let watcher = Watcher::new(2.0, move |_, view, _, wants| {
        let tick = view.now().nanos() / 2_000_000;
        wants.version = tick;
        wants.packets = tick % 3 > 0;
    });
    assert_eq!(recorded(vec![watcher]), alone);
}
