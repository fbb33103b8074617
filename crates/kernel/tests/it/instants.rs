//! What happens in an instant, and in which order.

use crate::script::{Script, act, engine, every, idle};
use simbeeotic_kernel::{Limits, ModelId, RunError, Settings, SimTime, Status, Wake};
use std::sync::{Arc, Mutex};

const fn ms(millis: u64) -> SimTime {
    SimTime::from_millis(millis)
}

#[test]
fn a_round_opens_runs_commits_in_order_and_closes() {
    let note = |text: &'static str| {
        act(move |_, out| {
            out.effect(Box::new(move |log, _| log.push(format!("{text} 1"))));
            out.effect(Box::new(move |log, _| log.push(format!("{text} 2"))));
        })
    };
    // Scheduled in another order than that of the models.
    let agents = vec![(Some(1), note("a")), (Some(1), note("b")), (None, idle())];
    let mut engine = engine(Script::default(), agents, Settings::default());
    assert_eq!(engine.run_until(ms(1)), Ok(Status::Exhausted));
    assert_eq!(
        engine.domain().log,
        [
            "open 0.001 s round 0, 2 events",
            "commit 0",
            "a 1",
            "commit 0",
            "a 2",
            "commit 1",
            "b 1",
            "commit 1",
            "b 2",
            "close",
        ]
    );
}

#[test]
fn an_event_without_delay_is_the_next_round_of_the_instant() {
    let agents = vec![
        (
            Some(1),
            act(|visit, out| out.schedule(visit.now, ModelId(1), Wake::default())),
        ),
        (
            None,
            act(|_, out| {
                out.effect(Box::new(|_, cx| {
                    cx.schedule_for(ModelId(1), ModelId(2), cx.now(), Wake::default());
                }));
            }),
        ),
        (None, idle()),
    ];
    let mut engine = engine(Script::default(), agents, Settings::default());
    engine.run_until(ms(5)).unwrap();
    let opened: Vec<_> = engine
        .domain()
        .log
        .iter()
        .filter(|l| l.starts_with("open"))
        .collect();
    assert_eq!(
        opened,
        [
            "open 0.001 s round 0, 1 events",
            "open 0.001 s round 1, 1 events",
            "open 0.001 s round 2, 1 events",
        ]
    );
    assert_eq!((engine.stats().instants, engine.stats().rounds), (1, 3));
}

#[test]
fn shared_state_makes_instants_rounds_and_visits() {
    let seen = Arc::new(Mutex::new(vec![]));
    let watch = |seen: &Arc<Mutex<Vec<_>>>| {
        let seen = Arc::clone(seen);
        act(move |visit, _| {
            seen.lock()
                .unwrap()
                .push((visit.now, visit.round, visit.id.0, visit.events.len()));
        })
    };
    let script = Script {
        // Asked for twice, out of order, and with an event of its own.
        due: vec![
            (ms(2), vec![ModelId(2), ModelId(0), ModelId(2)]),
            (ms(3), vec![ModelId(0), ModelId(1)]),
        ],
        more_rounds: 1,
        ..Script::default()
    };
    let agents = vec![
        (None, watch(&seen)),
        (Some(3), watch(&seen)),
        (None, watch(&seen)),
    ];
    let mut engine = engine(script, agents, Settings::default());
    assert_eq!(engine.run_until(ms(10)), Ok(Status::Exhausted));
    assert_eq!(
        *seen.lock().unwrap(),
        [
            (ms(2), 0, 0, 0),
            (ms(2), 0, 2, 0),
            (ms(3), 0, 0, 0),
            (ms(3), 0, 1, 1)
        ]
    );
    // One round at 2 ms because the script asked for it, with nobody in it.
    assert_eq!((engine.stats().instants, engine.stats().rounds), (2, 3));
}

#[test]
fn shared_state_that_is_late_is_due_now() {
    let script = Script {
        due: vec![(ms(1), vec![])],
        ..Script::default()
    };
    let mut engine = engine(script, vec![(Some(2), idle())], Settings::default());
    engine.run_until(ms(2)).unwrap();
    engine.domain_mut().due.push((ms(1), vec![ModelId(0)]));
    engine.run_until(ms(4)).unwrap();
    let last = engine
        .domain()
        .log
        .iter()
        .rfind(|l| l.starts_with("open"))
        .unwrap();
    assert_eq!(last, "open 0.002 s round 1, 0 events");
}

#[test]
fn the_clock_stands_at_the_asked_time_or_at_the_last_instant() {
    let mut engine = engine(
        Script::default(),
        vec![(Some(1), idle())],
        Settings::default(),
    );
    assert_eq!(engine.run_until(SimTime::ZERO), Ok(Status::Reached));
    assert_eq!(engine.run_until(SimTime::MAX), Ok(Status::Exhausted));
    assert_eq!(engine.now(), ms(1));
    assert_eq!(engine.run_until(ms(7)), Ok(Status::Exhausted));
    assert_eq!(engine.now(), ms(7));
    // Time does not go back.
    assert_eq!(engine.run_until(ms(3)), Ok(Status::Exhausted));
    assert_eq!(engine.now(), ms(7));
}

#[test]
fn inputs_come_between_two_calls_at_any_time_that_is_not_over() {
    let mut engine = engine(
        Script::default(),
        vec![(Some(1), idle())],
        Settings::default(),
    );
    engine.run_until(ms(5)).unwrap();
    let wake = Wake::default();
    assert!(matches!(
        engine.schedule_initial(ms(4), ModelId(0), wake),
        Err(RunError::PastEvent { .. })
    ));
    assert!(matches!(
        engine.schedule_initial(ms(6), ModelId(1), wake),
        Err(RunError::UnknownReceiver { .. })
    ));
    engine.schedule_initial(ms(5), ModelId(0), wake).unwrap();
    assert_eq!(engine.pending(), 1);
    assert_eq!(engine.run_until(ms(5)), Ok(Status::Exhausted));
    assert_eq!(engine.stats().events, 2);
}

#[test]
fn the_end_is_included_and_holds() {
    let settings = Settings {
        limits: Limits {
            end: ms(100),
            ..Limits::default()
        },
        ..Settings::default()
    };
    let mut engine = engine(Script::default(), vec![(Some(0), every(10))], settings);
    assert_eq!(engine.run_until(SimTime::MAX), Ok(Status::Reached));
    assert_eq!((engine.now(), engine.stats().events), (ms(100), 11));
}

#[test]
fn a_model_ends_the_run_when_the_instant_is_done() {
    let agents = vec![
        (
            Some(2),
            act(|visit, out| {
                out.stop("honey is full");
                out.schedule(visit.now, ModelId(1), Wake::default());
                out.schedule(ms(9), ModelId(0), Wake::default());
            }),
        ),
        (None, act(|_, out| out.stop("too late to count"))),
    ];
    let mut engine = engine(Script::default(), agents, Settings::default());
    let stopped = Ok(Status::Stopped("honey is full".into()));
    assert_eq!(engine.run_until(ms(20)), stopped);
    assert_eq!((engine.now(), engine.stats().rounds), (ms(2), 2));
    assert_eq!(engine.run_until(ms(30)), stopped);
    // Last words are heard.
    engine
        .schedule_initial(ms(2), ModelId(1), Wake::default())
        .unwrap();
    assert_eq!(engine.run_until(ms(2)), stopped);
    assert_eq!(
        (engine.now(), engine.stats().rounds, engine.pending()),
        (ms(2), 3, 1)
    );
}

#[test]
fn last_words_are_heard_between_instants_too() {
    let mut engine = engine(
        Script::default(),
        vec![(Some(0), every(10))],
        Settings::default(),
    );
    engine.run_until(ms(15)).unwrap();
    engine.control().stop("interrupted");
    assert_eq!(
        engine.run_until(ms(50)),
        Ok(Status::Stopped("interrupted".into()))
    );
    assert_eq!(engine.now(), ms(15));
    engine
        .schedule_initial(ms(15), ModelId(0), Wake::default())
        .unwrap();
    engine.run_until(ms(15)).unwrap();
    assert_eq!(engine.stats().events, 3);
}

#[test]
fn an_engine_without_agents_runs() {
    let mut engine = engine(
        Script::default(),
        vec![],
        Settings {
            threads: 0,
            ..Settings::default()
        },
    );
    assert_eq!(engine.run_until(SimTime::MAX), Ok(Status::Exhausted));
    assert!(engine.threads() >= 1);
}
