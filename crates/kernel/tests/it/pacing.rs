//! Pace, pause, step and stop, by a clock that tests move.

use crate::script::{Script, act, engine, every};
use simbeeotic_kernel::{
    Engine, Limits, Settings, SimTime, Status,
    pace::{Clock, Control, FakeClock},
};
use std::{
    sync::{Arc, Mutex},
    time::Duration,
};

const fn ms(millis: u64) -> SimTime {
    SimTime::from_millis(millis)
}

const fn wall(millis: u64) -> Duration {
    Duration::from_millis(millis)
}

/// One agent that wakes every 100 ms from 0 on, and a clock that stands.
fn paced(factor: Option<f64>) -> (Engine<Script>, FakeClock) {
    let mut engine = engine(
        Script::default(),
        vec![(Some(0), every(100))],
        Settings::default(),
    );
    let clock = FakeClock::new();
    engine.set_clock(clock.clone());
    engine.control().set_factor(factor).unwrap();
    (engine, clock)
}

#[test]
fn a_factor_of_two_means_at_most_twice_as_fast_as_the_wall_clock() {
    for (factor, took) in [(2.0, 500), (1.0, 1000), (0.5, 2000)] {
        let (mut engine, clock) = paced(Some(factor));
        engine.run_until(ms(1000)).unwrap();
        assert_eq!(clock.now(), wall(took), "factor {factor}");
        assert_eq!(
            (engine.lateness().late, engine.lateness().max),
            (0, Duration::ZERO)
        );
        assert_eq!(engine.lateness().instants, 11);
    }
}

#[test]
fn without_a_factor_nothing_waits() {
    let (mut engine, clock) = paced(None);
    engine.run_until(ms(1_000_000)).unwrap();
    assert_eq!(clock.now(), Duration::ZERO);
    assert_eq!(engine.lateness().instants, 0);
}

#[test]
fn time_passes_between_instants_and_after_the_last_one() {
    let (mut engine, clock) = paced(Some(1.0));
    engine.run_until(ms(250)).unwrap();
    assert_eq!(clock.now(), wall(250));
    engine.run_until(ms(250)).unwrap();
    assert_eq!(clock.now(), wall(250));
}

#[test]
fn a_late_run_catches_up_and_says_so() {
    let clock = FakeClock::new();
    let busy = clock.clone();
    let mut firings = 0;
    // The first handler takes 350 ms, the others none.
    let slow = act(move |visit, out| {
        if firings == 0 {
            busy.advance(wall(350));
        }
        firings += 1;
        out.schedule(
            visit.now.saturating_add_nanos(100_000_000),
            visit.id,
            Default::default(),
        );
    });
    let mut engine = engine(
        Script::default(),
        vec![(Some(0), slow)],
        Settings::default(),
    );
    engine.set_clock(clock.clone());
    engine.control().set_factor(Some(1.0)).unwrap();
    engine.run_until(ms(300)).unwrap();
    assert_eq!(clock.now(), wall(350));
    assert_eq!(
        (engine.lateness().late, engine.lateness().max),
        (3, wall(250))
    );
    engine.run_until(ms(1000)).unwrap();
    assert_eq!(clock.now(), wall(1000), "back in step");
    assert_eq!(engine.lateness().late, 3);
    assert_eq!(
        engine.lateness().histogram.iter().sum::<u64>(),
        engine.lateness().instants
    );
}

#[test]
fn no_race_follows_a_pause() {
    let (mut engine, clock) = paced(Some(1.0));
    clock.at(wall(250), |control| control.pause());
    clock.at(wall(5250), |control| control.resume());
    engine.run_until(ms(300)).unwrap();
    // Fifty milliseconds were left when it was paused.
    assert_eq!(clock.now(), wall(5300));
    engine.run_until(ms(1000)).unwrap();
    assert_eq!(clock.now(), wall(6000));
    assert_eq!(engine.lateness().late, 0);
}

#[test]
fn a_run_that_was_late_when_it_was_paused_has_nothing_to_catch_up() {
    let (mut engine, clock) = paced(Some(1.0));
    engine.run_until(ms(200)).unwrap();
    clock.advance(wall(10_000));
    engine.control().pause();
    clock.at(wall(20_000), |control| control.resume());
    engine.run_until(ms(1000)).unwrap();
    // Due at 300 ms already; from there on by the clock.
    assert_eq!(clock.now(), wall(20_700));
    assert_eq!(engine.lateness().late, 0);
}

#[test]
fn a_pause_holds_the_first_instant_too() {
    let (mut engine, clock) = paced(None);
    engine.control().pause();
    clock.at(wall(70), |control| {
        assert!(control.is_paused());
        control.resume();
    });
    engine.run_until(ms(0)).unwrap();
    assert_eq!((clock.now(), engine.stats().instants), (wall(70), 1));
}

#[test]
fn a_step_is_one_instant() {
    let (mut engine, clock) = paced(Some(1.0));
    let control = engine.control();
    control.pause();
    clock.at(wall(10), |control| control.step(1));
    clock.at(wall(20), |control| control.step(2));
    clock.at(wall(30), |control| control.stop("seen enough"));
    let status = engine.run_until(ms(1000));
    assert_eq!(status, Ok(Status::Stopped("seen enough".into())));
    assert_eq!((engine.stats().instants, engine.now()), (3, ms(200)));
    assert_eq!(
        (clock.now(), control.stop_reason().as_deref()),
        (wall(30), Some("seen enough"))
    );
}

#[test]
fn steps_are_for_instants_and_not_for_the_ends_of_calls() {
    let (mut engine, clock) = paced(None);
    engine.control().step(3);
    clock.at(wall(10), |control| control.stop("held"));
    for until in (10..).step_by(10).map(ms) {
        if engine.run_until(until).unwrap() != Status::Reached {
            break;
        }
    }
    assert_eq!(engine.stats().instants, 3);
}

#[test]
fn after_steps_a_run_goes_on_at_its_pace() {
    let (mut engine, clock) = paced(Some(1.0));
    engine.control().step(5);
    clock.at(wall(1_000), |control| control.resume());
    engine.run_until(ms(600)).unwrap();
    // Instants 0 to 400 ms at once; 500 and 600 by the clock.
    assert_eq!(clock.now(), wall(1_200));
}

#[test]
fn a_step_of_time_runs_what_is_due_and_stands_where_it_ends() {
    let (mut engine, clock) = paced(None);
    let control = engine.control();
    let (progress, seen) = (engine.progress(), Arc::new(Mutex::new(Vec::new())));
    let look = |then: fn(&Control)| {
        let (progress, seen) = (Arc::clone(&progress), Arc::clone(&seen));
        move |control: &Control| {
            let at = (progress.now(), progress.events());
            seen.lock().unwrap().push(at);
            then(control);
        }
    };
    control.step_to(ms(0));
    clock.at(wall(10), look(|control| control.step_by(50_000_000)));
    clock.at(wall(20), look(|control| control.step_by(50_000_000)));
    clock.at(wall(30), look(|control| control.step_to(ms(350))));
    // Over: it only stands.
    clock.at(wall(40), look(|control| control.step_to(ms(20))));
    clock.at(wall(50), look(|control| control.step(1)));
    clock.at(wall(60), look(|control| control.stop("seen")));
    assert_eq!(
        engine.run_until(ms(1000)),
        Ok(Status::Stopped("seen".into()))
    );
    let expected = [(0, 1), (50, 1), (100, 2), (350, 4), (350, 4), (400, 5)];
    assert_eq!(
        *seen.lock().unwrap(),
        expected.map(|(at, events)| (ms(at), events))
    );
}

#[test]
fn two_short_steps_of_time_are_a_long_one() {
    let (mut engine, clock) = paced(None);
    engine.hand_back_when_held(true);
    let control = engine.control();
    control.step_by(70_000_000);
    control.step_by(80_000_000);
    assert_eq!(engine.run_until(ms(1000)), Ok(Status::Held));
    assert_eq!((engine.now(), engine.stats().instants), (ms(150), 2));
    // An instant asked for is one instant, whatever was left of other steps.
    control.step_by(500_000_000);
    control.step(1);
    assert_eq!(engine.run_until(ms(1000)), Ok(Status::Held));
    assert_eq!((engine.now(), engine.stats().instants), (ms(200), 3));
    assert_eq!(clock.now(), Duration::ZERO);
}

#[test]
fn a_held_run_is_handed_back_if_asked_for() {
    let (mut engine, clock) = paced(Some(1.0));
    engine.hand_back_when_held(true);
    let control = engine.control();
    control.pause();
    // Before the first instant, as often as one likes.
    for _ in 0..3 {
        assert_eq!(engine.run_until(ms(0)), Ok(Status::Held));
        assert_eq!((engine.now(), engine.stats().instants), (ms(0), 0));
    }
    control.resume();
    clock.at(wall(250), |control| control.pause());
    assert_eq!(engine.run_until(ms(1000)), Ok(Status::Held));
    assert_eq!((engine.now(), clock.now()), (ms(200), wall(250)));

    // It waits outside, by the same clock, and until the control is used.
    engine.wait_while_held(wall(50));
    assert_eq!(clock.now(), wall(300));
    assert_eq!(engine.run_until(ms(1000)), Ok(Status::Held));
    clock.at(wall(310), |control| control.resume());
    engine.wait_while_held(wall(50));
    assert_eq!(clock.now(), wall(310));

    // Fifty milliseconds were left of the way to the next instant.
    assert_eq!(engine.run_until(ms(300)), Ok(Status::Reached));
    assert_eq!((clock.now(), engine.lateness().late), (wall(360), 0));
    control.pause();
    control.stop("enough");
    let stopped = Ok(Status::Stopped("enough".into()));
    assert_eq!(engine.run_until(ms(1000)), stopped);
}

#[test]
fn wall_time_runs_out_while_a_run_is_held() {
    let (mut engine, _) = paced(None);
    engine.hand_back_when_held(true);
    engine.limits_mut().wall = Some(wall(200));
    engine.control().pause();
    for _ in 0..4 {
        assert_eq!(engine.run_until(ms(0)), Ok(Status::Held));
        engine.wait_while_held(wall(50));
    }
    assert_eq!(engine.run_until(ms(0)), Ok(Status::WallTime));
}

#[test]
fn a_run_in_steps_is_the_same_run() {
    let hash = |drive: &dyn Fn(&mut Engine<Script>)| {
        let agents = (1..=5).map(|n| (Some(n), every(7 * n))).collect();
        let mut engine = engine(Script::default(), agents, Settings::default());
        engine.hand_back_when_held(true);
        drive(&mut engine);
        assert_eq!(engine.now(), ms(1000));
        (engine.trace().total(), engine.stats().instants)
    };
    let whole = hash(&|engine| _ = engine.run_until(ms(1000)).unwrap());
    let stepped = hash(&|engine| {
        engine.control().pause();
        for round in 0.. {
            match engine.run_until(ms(1000)).unwrap() {
                Status::Held if round % 3 == 0 => engine.control().step(2),
                Status::Held => engine.control().step_by(13_000_000),
                _ => break,
            }
        }
    });
    assert_eq!(whole, stepped);
    let shorter = hash(&|engine| {
        _ = engine.run_until(ms(900)).unwrap();
        engine.control().step_to(ms(1000));
        _ = engine.run_until(ms(2000)).unwrap();
    });
    assert_eq!(whole, shorter);
}

#[test]
fn a_change_of_pace_counts_from_where_the_run_is() {
    let (mut engine, clock) = paced(Some(1.0));
    clock.at(wall(150), |control| control.set_factor(Some(0.5)).unwrap());
    clock.at(wall(450), |control| control.set_factor(None).unwrap());
    engine.run_until(ms(300)).unwrap();
    assert_eq!(clock.now(), wall(450), "150 ms at 1, 150 ms at 0.5");
    engine.run_until(ms(10_000)).unwrap();
    assert_eq!(clock.now(), wall(450));
    engine.control().set_factor(Some(4.0)).unwrap();
    engine.run_until(ms(10_400)).unwrap();
    assert_eq!(clock.now(), wall(550));
}

#[test]
fn a_pace_that_is_none_is_refused() {
    let (engine, _) = paced(Some(3.0));
    for wrong in [0.0, -1.0, f64::NAN, f64::NEG_INFINITY] {
        assert!(engine.control().set_factor(Some(wrong)).is_err());
    }
    assert_eq!(engine.control().factor(), Some(3.0));
    engine.control().set_factor(Some(f64::INFINITY)).unwrap();
    assert_eq!(engine.control().factor(), None);
}

#[test]
fn wall_time_ends_a_run_that_may_go_on() {
    let clock = FakeClock::new();
    let busy = clock.clone();
    let slow = act(move |visit, out| {
        busy.advance(wall(10));
        out.schedule(
            visit.now.saturating_add_nanos(1),
            visit.id,
            Default::default(),
        );
    });
    let limits = Limits {
        wall: Some(wall(2_000)),
        ..Limits::default()
    };
    let settings = Settings {
        limits,
        ..Settings::default()
    };
    let mut engine = engine(Script::default(), vec![(Some(0), slow)], settings);
    engine.set_clock(clock.clone());
    assert_eq!(engine.run_until(ms(1)), Ok(Status::WallTime));
    assert!(
        clock.now() >= wall(2_000) && clock.now() < wall(2_200),
        "{:?}",
        clock.now()
    );
    assert_eq!(engine.run_until(ms(1)), Ok(Status::WallTime));
    engine.limits_mut().wall = None;
    let before = engine.stats().events;
    engine
        .run_until(engine.now().saturating_add_nanos(10))
        .unwrap();
    assert_eq!(engine.stats().events, before + 10);
}

#[test]
fn another_thread_can_pause_and_resume_by_the_wall_clock() {
    let mut engine = engine(
        Script::default(),
        vec![(Some(0), every(100))],
        Settings::default(),
    );
    let (control, progress) = (engine.control(), engine.progress());
    control.pause();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            std::thread::yield_now();
            assert_eq!(progress.events(), 0);
            control.resume();
        });
        engine.run_until(ms(1000)).unwrap();
    });
    assert_eq!(engine.progress().now(), ms(1000));
    assert_eq!(engine.progress().events(), 11);
}
