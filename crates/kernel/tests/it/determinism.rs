//! The contract: one world and one seed give one trace, whatever runs it.

use crate::toy::{Board, engine, engine_of, paths, settings};
use simbeeotic_kernel::{Engine, ModelId, QueueKind, SimTime, Status, TraceLog};
use std::sync::atomic::AtomicU64;

const END: SimTime = SimTime::from_secs(3);

fn run(mut engine: Engine<Board>) -> Engine<Board> {
    assert_eq!(engine.run_until(END), Ok(Status::Reached));
    engine
}

fn reference() -> TraceLog {
    run(engine(settings(1, QueueKind::Heap))).trace().clone()
}

fn assert_same(run: &Engine<Board>, reference: &TraceLog, what: &str) {
    assert_eq!(
        run.trace().first_difference(reference),
        None,
        "{what}: first differing second"
    );
    assert_eq!(run.trace().total(), reference.total(), "{what}");
}

#[test]
fn every_queue_gives_the_same_trace() {
    assert_same(
        &run(engine(settings(1, QueueKind::Wheel))),
        &reference(),
        "wheel",
    );
}

#[test]
fn thread_count_does_not_show() {
    let reference = reference();
    for threads in [1, 2, 3, 8] {
        let engine = run(engine(settings(threads, QueueKind::Wheel)));
        assert_eq!(engine.threads(), threads);
        assert_same(&engine, &reference, &format!("{threads} threads"));
    }
}

#[test]
fn a_large_population_whose_memory_is_fetched_early_runs_the_same() {
    let run = |threads, queue| {
        let board = Board::new(paths(5000), 50);
        let mut engine = engine_of(board, 7, settings(threads, queue));
        engine.run_until(SimTime::from_millis(250)).unwrap();
        engine.trace().total()
    };
    let reference = run(1, QueueKind::Heap);
    assert_eq!(run(1, QueueKind::Wheel), reference);
    assert_eq!(run(3, QueueKind::Wheel), reference);
}

#[test]
fn a_run_can_be_split() {
    let reference = reference();
    let mut split = engine(settings(2, QueueKind::Wheel));
    // Pieces that end on instants, between them, and where nothing happens.
    let pieces = [0, 1, 99, 100, 100, 137, 1000, 1000, 1001, 2500, 3000].map(SimTime::from_millis);
    for until in pieces {
        assert_eq!(split.run_until(until), Ok(Status::Reached));
        assert_eq!(split.now(), until);
    }
    assert_same(&split, &reference, "split");
}

#[test]
fn the_trace_is_the_same_on_every_machine_and_in_every_build() {
    // Also checked with --release. A change here changes every golden trace there is.
    assert_eq!(format!("{:016x}", reference().total()), "343ecc294613251a");
}

#[test]
fn the_seed_shows() {
    let other = run(engine_of(
        Board::new(paths(500), 500),
        8,
        settings(1, QueueKind::Wheel),
    ));
    assert_eq!(other.trace().first_difference(&reference()), Some(0));
}

/// If this fails, the tests above prove nothing.
#[test]
fn a_domain_that_leaks_the_order_of_running_is_caught() {
    let leaky = |threads| {
        let mut board = Board::new(paths(500), 500);
        board.leak = Some(AtomicU64::new(0));
        board.leak_waits = threads > 1;
        let mut engine = engine_of(board, 7, settings(threads, QueueKind::Wheel));
        engine.run_until(SimTime::ZERO).unwrap();
        engine.trace().total()
    };
    assert_eq!(leaky(1), leaky(1));
    assert_ne!(leaky(1), leaky(2));
}

#[test]
fn a_stranger_changes_no_other_models_trace() {
    let alone = run(engine_of(
        Board::new(paths(40), 4),
        7,
        settings(1, QueueKind::Wheel),
    ));

    // Four models more, once behind all others and once before them, so that every id moves.
    let strangers = ["a", "b", "c", "d"].map(String::from);
    let behind = [paths(40), strangers.to_vec()].concat();
    let behind = run(engine_of(
        Board::new(behind, 4),
        7,
        settings(1, QueueKind::Wheel),
    ));
    let before = [strangers.to_vec(), paths(40)].concat();
    let before = run(engine_of(
        Board::new(before, 4),
        7,
        settings(2, QueueKind::Wheel),
    ));

    for id in 0..40 {
        let want = alone.agent_trace(ModelId(id));
        assert_eq!(
            behind.agent_trace(ModelId(id)),
            want,
            "bee-{id}, strangers behind"
        );
        assert_eq!(
            before.agent_trace(ModelId(id + 4)),
            want,
            "bee-{id}, strangers before"
        );
    }
    assert_ne!(alone.trace().total(), behind.trace().total());
    assert_eq!(alone.agent_trace(ModelId(40)), None);
}

#[test]
fn statistics_agree_where_they_are_no_times() {
    let counts = |engine: &Engine<Board>| {
        let s = engine.stats();
        (s.events, s.visits, s.instants, s.rounds, s.voided)
    };
    let one = run(engine(settings(1, QueueKind::Heap)));
    let two = run(engine(settings(3, QueueKind::Wheel)));
    assert_eq!(counts(&one), counts(&two));
    assert!(counts(&one).4 > 0, "some events were voided");
    assert_eq!(one.progress().events(), one.stats().events);
    assert!(one.agents().iter().map(|a| a.count).sum::<u64>() == one.stats().visits);
}
