//! Each run in a process of its own, so that its memory is its own, too, and a run leaves nothing to the
//! next one.
//!
//! The program calls itself with the same arguments, and with one more that says which run is wanted; it
//! gets the answer as JSON.

use super::arguments::Clock;
use super::measure::Stopwatch;
use super::workload::Cost;
use super::{Failure, paper, process, say};
use crate::program::run::at_interrupt;
use serde::{Deserialize, Serialize};
use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// One run that can be asked for: a size, on one of an experiment's curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Case {
    pub(super) line: usize,
    pub(super) size: u32,
}

/// A run, and what it held.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Run {
    pub(super) cost: Cost,
    packets: [u64; 2],
    /// Growth of the process's greatest memory by this run, bytes.
    pub(super) memory_bytes: Option<f64>,
    /// How long it took with all that comes before and after, such as making the world; wall time, s.
    #[serde(default)]
    pub(super) whole_s: f64,
    /// How many threads wanted a processor in the minute before it, in the mean.
    #[serde(default)]
    pub(super) load: Option<f64>,
}

impl Run {
    /// What 100 virtual seconds take by this clock, over 100 s: at most 1 in real time.
    pub(super) fn ratio(&self, clock: Clock) -> f64 {
        clock.stretched(&self.cost) / paper::DURATION_S
    }

    /// One that was kept as JSON.
    pub(super) fn again(mut self) -> Self {
        self.cost.packets = self.packets;
        self
    }

    /// One that took so long, for tests.
    #[cfg(test)]
    pub(super) fn of(cost: Cost) -> Self {
        Self {
            packets: cost.packets,
            cost,
            memory_bytes: Some(2048.0),
            whole_s: 0.0,
            load: None,
        }
    }
}

/// What the hidden argument says.
pub(super) struct Order {
    pub(super) case: Case,
    pub(super) wall: Option<Duration>,
}

impl Order {
    pub(super) fn parse(text: &str) -> Result<Self, Failure> {
        let parts: Vec<&str> = text.split(':').collect();
        let order = || {
            let (line, size, wall) = match parts[..] {
                [line, size] => (line, size, None),
                [line, size, wall] => (line, size, Some(wall)),
                _ => return None,
            };
            let wall = wall.map(|wall| Duration::try_from_secs_f64(wall.parse().ok()?).ok());
            Some(Self {
                case: Case {
                    line: line.parse().ok()?,
                    size: size.parse().ok()?,
                },
                wall: match wall {
                    None => None,
                    Some(wall) => Some(wall?),
                },
            })
        };
        order()
            .ok_or_else(|| Failure::input(format!("--alone {text}: LINE:SIZE or LINE:SIZE:WALL_S")))
    }
}

/// In the called process: makes the run after whatever warms up, and tells it.
pub(super) fn tell(
    warm_up: impl FnOnce() -> Result<(), Failure>,
    run: impl FnOnce() -> Result<Cost, Failure>,
) -> Result<(), Failure> {
    warm_up()?;
    let before = process::peak_bytes();
    let cost = run()?;
    let memory = process::peak_bytes().zip(before);
    let run = Run {
        packets: cost.packets,
        cost,
        memory_bytes: memory.map(|(after, before)| after - before),
        whole_s: 0.0,
        load: None,
    };
    say(serde_json::to_string(&run).map_err(Failure::run)?)
}

/// In the calling process: has runs made, one after the other, until the user interrupts.
pub(super) struct Runner {
    /// The process that makes a run now.
    child: Arc<Mutex<Option<Child>>>,
    interrupted: Arc<AtomicBool>,
}

impl Runner {
    /// From now on the first Ctrl-C or SIGTERM ends the run that is being made, and there are no others.
    pub(super) fn start() -> Self {
        let child: Arc<Mutex<Option<Child>>> = Arc::default();
        let going = Arc::clone(&child);
        let interrupted = at_interrupt(move || {
            if let Some(child) = lock(&going).as_mut() {
                // One that is at its end already is not there to be killed.
                let _ = child.kill();
            }
        });
        Self { child, interrupted }
    }

    /// Has a run made, which ends when it has taken so much wall time, s.
    ///
    /// # Errors
    /// The run failed, in its words; the user interrupted.
    pub(super) fn run(&self, case: Case, wall_s: Option<f64>) -> Result<Run, Failure> {
        let is_over = || self.interrupted.load(Ordering::Relaxed);
        let run = match is_over() {
            true => Err(Failure::interrupted()),
            false => self.call(case, wall_s),
        };
        // From a terminal the called process has been interrupted, too.
        run.map_err(|failure| match is_over() {
            true => Failure::interrupted(),
            false => failure,
        })
    }

    fn call(&self, case: Case, wall_s: Option<f64>) -> Result<Run, Failure> {
        let failed = |what: String| Failure::run(format!("cannot run one size by itself: {what}"));
        let program = std::env::current_exe().map_err(|e| failed(e.to_string()))?;
        let Case { line, size } = case;
        let order = match wall_s {
            None => format!("{line}:{size}"),
            Some(wall_s) => format!("{line}:{size}:{wall_s}"),
        };
        let load = process::load();
        let begun = Stopwatch::start();
        let mut child = Command::new(program)
            .args(std::env::args_os().skip(1))
            .args(["--alone", &order])
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(|e| failed(e.to_string()))?;
        let (out, err) = (child.stdout.take(), child.stderr.take());
        *lock(&self.child) = Some(child);
        if self.interrupted.load(Ordering::Relaxed)
            && let Some(child) = lock(&self.child).as_mut()
        {
            let _ = child.kill();
        }
        let words = std::thread::spawn(move || all_of(err));
        let told = all_of(out);
        let words = words.join().unwrap_or_default();
        // Its words have ended, so it has ended, too, or does so now.
        let ended = lock(&self.child)
            .take()
            .map(|mut child| child.wait())
            .ok_or_else(|| failed("it is gone".to_owned()))?
            .map_err(|e| failed(e.to_string()))?;
        if !ended.success() {
            let words = String::from_utf8_lossy(&words);
            let words = words.trim().trim_start_matches("error: ");
            return Err(match (words, ended.code()) {
                ("", _) => failed(ended.to_string()),
                (words, Some(2)) => Failure::input(words),
                (words, Some(_)) => Failure::run(words),
                (words, None) => failed(format!("{ended}: {words}")),
            });
        }
        let mut run: Run = serde_json::from_slice(&told).map_err(|e| failed(e.to_string()))?;
        run.cost.packets = run.packets;
        run.whole_s = begun.elapsed_s();
        run.load = load;
        Ok(run)
    }
}

/// A lock that one who panicked held is as good as any: what is behind it is whole.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// All that comes, until it ends or cannot be read.
fn all_of(pipe: Option<impl Read>) -> Vec<u8> {
    let mut bytes = Vec::new();
    if let Some(mut pipe) = pipe {
        let _ = pipe.read_to_end(&mut bytes);
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_is_a_line_a_size_and_perhaps_a_wall_time() {
        let Ok(order) = Order::parse("1:41200") else {
            panic!("an order")
        };
        assert_eq!(
            order.case,
            Case {
                line: 1,
                size: 41_200
            }
        );
        assert!(order.wall.is_none());
        let Ok(order) = Order::parse("0:5:1.5") else {
            panic!("an order")
        };
        assert_eq!(order.wall, Some(Duration::from_millis(1500)));
        for wrong in [
            "", "1", "1:-4", "1:2:", "1:2:-3", "1:2:3:4", "a:2", "1:2:nan",
        ] {
            assert_eq!(
                Order::parse(wrong).err().map(|e| e.code),
                Some(2),
                "{wrong}"
            );
        }
    }
}
