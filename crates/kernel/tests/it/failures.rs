//! How runs end before their time: what the error says, and that it is the same on every thread.

use crate::script::{Act, Script, act, engine, every, idle};
use simbeeotic_kernel::{Engine, Limits, ModelId, RunError, Settings, SimTime, Status, Wake};

const fn ms(millis: u64) -> SimTime {
    SimTime::from_millis(millis)
}

/// Two hundred agents that wake at 1 ms; one or more of them do something special.
fn crowd(threads: usize, special: impl Fn(u32) -> Option<Act>) -> Engine<Script> {
    let agents = (0..200)
        .map(|id| (Some(1), special(id).unwrap_or_else(idle)))
        .collect();
    let settings = Settings {
        threads,
        seed: 42,
        parallel_from: 1,
        ..Settings::default()
    };
    engine(Script::default(), agents, settings)
}

/// Runs on one and on three threads, twice; the error must be the same each time.
fn error_of(special: impl Fn(u32) -> Option<Act>) -> RunError {
    let [one, three] = [1, 3].map(|threads| {
        let mut engine = crowd(threads, &special);
        let error = engine.run_until(ms(5)).unwrap_err();
        assert_eq!(
            engine.run_until(ms(9)).unwrap_err(),
            error,
            "an engine that failed stays so"
        );
        assert_eq!(error.time(), ms(1));
        error
    });
    assert_eq!(one, three);
    one
}

#[test]
fn a_panic_names_the_model_the_time_and_the_seed() {
    let error =
        error_of(|id| (id == 150 || id == 199).then(|| act(|_, _| panic!("no wings left"))));
    assert_eq!(
        error.to_string(),
        "hive/bee-150 panicked at 0.001 s (seed 42): no wings left"
    );
    let error = error_of(|id| (id == 3).then(|| act(|_, _| std::panic::panic_any(17))));
    assert_eq!(
        error.to_string(),
        "hive/bee-3 panicked at 0.001 s (seed 42): a panic without a message"
    );
}

#[test]
fn a_panic_in_an_effect_names_its_model() {
    let error = error_of(|id| {
        (id == 77)
            .then(|| act(|_, out| out.effect(Box::new(|_, _| panic!("inertia is {}", f64::NAN)))))
    });
    assert_eq!(
        error.to_string(),
        "hive/bee-77 panicked at 0.001 s (seed 42): inertia is NaN"
    );
}

#[test]
fn a_panic_of_the_shared_state_says_so() {
    let script = Script {
        panic_at: Some(ms(1)),
        ..Script::default()
    };
    let mut engine = engine(script, vec![(Some(1), idle())], Settings::default());
    let error = engine.run_until(ms(5)).unwrap_err();
    assert!(matches!(error, RunError::SharedPanic { .. }));
    assert!(error.to_string().contains("the table is torn"), "{error}");
}

#[test]
fn the_first_fault_in_the_order_of_models_counts() {
    let fault = |id: u32| act(move |_, out| out.fault(format!("force of bee {id} is NaN")));
    let error = error_of(|id| [70, 71, 130, 199].contains(&id).then(|| fault(id)));
    assert_eq!(
        error.to_string(),
        "hive/bee-70, at 0.001 s: force of bee 70 is NaN"
    );
}

#[test]
fn faults_of_effects_and_of_the_shared_state_name_a_model() {
    let error = error_of(|id| {
        (id == 9).then(|| act(|_, out| out.effect(Box::new(|_, cx| cx.fault("mass is 0")))))
    });
    assert_eq!(error.to_string(), "hive/bee-9, at 0.001 s: mass is 0");

    let script = Script {
        fault_at: Some((ms(1), ModelId(0))),
        ..Script::default()
    };
    let mut engine = engine(script, vec![(Some(1), idle())], Settings::default());
    let error = engine.run_until(ms(5)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "hive/bee-0, at 0.001 s: its body is gone"
    );
}

#[test]
fn the_past_and_strangers_cannot_be_scheduled() {
    let past = || act(|_, out| out.schedule(SimTime::ZERO, ModelId(0), Wake::default()));
    assert_eq!(
        error_of(|id| (id == 5).then(past)).to_string(),
        "hive/bee-5 scheduled an event for 0 s, but it is 0.001 s already"
    );
    let stranger = || {
        act(|_, out| {
            out.effect(Box::new(|_, cx| {
                cx.schedule_for(ModelId(5), ModelId(200), ms(2), Wake::default());
            }));
        })
    };
    assert_eq!(
        error_of(|id| (id == 5).then(stranger)).to_string(),
        "hive/bee-5, at 0.001 s, scheduled an event for model #200, which does not exist"
    );
}

#[test]
fn a_loop_without_delay_names_the_models_in_it() {
    let pass_on =
        |to: u32| act(move |visit, out| out.schedule(visit.now, ModelId(to), Wake::default()));
    let agents = vec![
        (Some(1), idle()),
        (Some(1), pass_on(2)),
        (None, pass_on(3)),
        (None, pass_on(1)),
        (Some(2), idle()),
    ];
    let mut engine = engine(Script::default(), agents, Settings::default());
    let error = engine.run_until(ms(5)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "time stands still at 0.001 s: after 10000 rounds these wake each other without delay: \
         hive/bee-1, hive/bee-2, hive/bee-3"
    );
}

#[test]
fn a_loop_of_the_shared_state_ends_too() {
    let script = Script {
        more_rounds: u32::MAX,
        ..Script::default()
    };
    let settings = Settings {
        limits: Limits {
            rounds_per_instant: 50,
            ..Limits::default()
        },
        ..Settings::default()
    };
    let mut engine = engine(script, vec![(Some(1), idle())], settings);
    let error = engine.run_until(ms(5)).unwrap_err().to_string();
    // The bee that was awake in the first of the rounds is the only one to be named.
    assert!(error.contains("after 50 rounds"), "{error}");
}

#[test]
fn rounds_up_to_the_limit_are_fine() {
    let mut left = 49;
    let countdown = act(move |visit, out| {
        if left > 0 {
            left -= 1;
            out.schedule(visit.now, visit.id, Wake::default());
        }
    });
    let settings = Settings {
        limits: Limits {
            rounds_per_instant: 50,
            ..Limits::default()
        },
        ..Settings::default()
    };
    let mut engine = engine(Script::default(), vec![(Some(1), countdown)], settings);
    assert_eq!(engine.run_until(ms(5)), Ok(Status::Exhausted));
    assert_eq!(engine.stats().rounds, 50);
}

#[test]
fn too_many_events_end_the_run() {
    let flood = |count: u64| {
        act(move |visit, out| {
            (0..count).for_each(|_| out.schedule(visit.now, visit.id, Wake::default()));
        })
    };
    let limits = Limits {
        events_per_instant: 500,
        queue: 300,
        ..Limits::default()
    };
    let run = |count| {
        let settings = Settings {
            limits: limits.clone(),
            ..Settings::default()
        };
        let mut engine = engine(Script::default(), vec![(Some(1), flood(count))], settings);
        engine.run_until(ms(5)).unwrap_err()
    };
    assert_eq!(
        run(301).to_string(),
        "301 events are pending at 0.001 s, the limit is 300; hive/bee-0 scheduled the last of them"
    );
    let two = Settings {
        limits: Limits {
            queue: 1 << 20,
            ..limits.clone()
        },
        ..Settings::default()
    };
    let mut engine = engine(Script::default(), vec![(Some(1), flood(22))], two);
    assert_eq!(
        engine.run_until(ms(5)).unwrap_err().to_string(),
        "507 events at 0.001 s, the limit is 500; the last went to hive/bee-0"
    );
}

#[test]
fn a_panic_leaves_the_others_readable() {
    let mut engine = engine(
        Script::default(),
        vec![(Some(0), every(1)), (Some(3), act(|_, _| panic!("stung")))],
        Settings::default(),
    );
    assert!(engine.run_until(ms(9)).is_err());
    assert_eq!(engine.now(), ms(3));
    assert_eq!(engine.trace().marks().count(), 1);
    let (script, agents) = engine.into_parts();
    assert_eq!(agents.len(), 2);
    assert!(!script.log.is_empty());
}
