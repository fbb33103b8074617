//! What is left of a recording whose program was killed.

#![cfg(unix)]
#![expect(clippy::print_stdout, reason = "the child speaks to its parent")]
#![expect(
    clippy::disallowed_methods,
    reason = "the subject is what is lost by the wall clock"
)]

use crate::{child, swarm};
use simbeeotic_record::{Recorder, Recording};
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::time::{Duration, Instant};

const VEHICLES: usize = 20;

/// Records the time by the wall clock until it is killed, and says what it does.
#[test]
fn recording_child() {
    let Some(path) = child::file() else { return };
    let mut recorder = Recorder::create(path, swarm::header(VEHICLES)).expect("created");
    let start = Instant::now();
    for tick in 0.. {
        let time_ns = u64::try_from(start.elapsed().as_nanos()).expect("short");
        recorder
            .tick(time_ns, swarm::samples(tick, VEHICLES))
            .expect("recorded");
        let safe_ns = recorder.stats().safe_until_ns.unwrap_or(0);
        let mut out = std::io::stdout();
        if writeln!(out, "tick {time_ns} {safe_ns}")
            .and_then(|()| out.flush())
            .is_err()
        {
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Kills a recording process after a while; returns the time that is lost, ns.
fn loss_by_kill(path: &Path) -> u64 {
    let mut child = child::start("killed::recording_child", path, "");
    let mut lines = BufReader::new(child.stdout.take().expect("a pipe")).lines();
    let (mut said_ns, mut safe_ns) = (0, 0);
    let mut listen = |until_ns: u64| {
        while said_ns < until_ns {
            let Some(Ok(line)) = lines.next() else { break };
            // The test program talks too, and the last line may be torn.
            let Some(("tick", numbers)) = line.split_once(' ') else {
                continue;
            };
            let Some((said, safe)) = numbers.split_once(' ') else {
                continue;
            };
            said_ns = said.parse().unwrap_or(said_ns);
            safe_ns = safe.parse().unwrap_or(safe_ns);
        }
        (said_ns, safe_ns)
    };
    listen(1_300_000_000);
    child.kill().expect("alive until now");
    child.wait().expect("dead");
    let (said_ns, safe_ns) = listen(u64::MAX);

    let recording = Recording::open(path).expect("opens");
    assert!(recording.truncated());
    assert_eq!(recording.vehicles(), swarm::vehicles(VEHICLES));
    assert_eq!(recording.seed(), Some(111_982));
    let mut last_ns = 0;
    for (number, tick) in (0..).zip(recording.ticks()) {
        let tick = tick.expect("readable");
        assert!(
            tick.samples
                .iter()
                .copied()
                .eq(swarm::samples(number, VEHICLES))
        );
        last_ns = tick.time_ns;
    }
    assert!(
        last_ns >= safe_ns,
        "{last_ns} ns read, {safe_ns} ns said to be safe"
    );
    said_ns.saturating_sub(last_ns)
}

/// What was said to be safe is there in every try. That less than a second is lost depends on
/// the machine as well: a starved one gets further tries.
#[test]
fn a_killed_process_leaves_all_but_the_last_second() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("run.mcap");
    let tries = std::iter::repeat_with(|| loss_by_kill(&path)).take(5);
    let mut losses = Vec::new();
    for loss_ns in tries {
        losses.push(loss_ns);
        if loss_ns < 1_000_000_000 {
            println!("lost {loss_ns} ns");
            return;
        }
    }
    panic!("lost a second or more every time: {losses:?} ns");
}
