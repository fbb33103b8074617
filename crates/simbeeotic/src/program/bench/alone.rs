//! Each run in a process of its own, so that its memory is its own, too, and a run leaves nothing to the
//! next one.
//!
//! The program calls itself with the same arguments, and with one more that says which run is wanted; it
//! gets the answer as JSON.

use super::arguments::Clock;
use super::measure::Stopwatch;
use super::workload::Cost;
use super::{Failure, process, say};
use serde::{Deserialize, Serialize};
use std::process::{Command, Stdio};
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
}

impl Run {
    /// Time by this clock over virtual time: at most 1 in real time.
    pub(super) fn ratio(&self, clock: Clock) -> f64 {
        clock.of(&self.cost) / self.cost.virtual_s
    }

    /// One that took so long, for tests.
    #[cfg(test)]
    pub(super) fn of(cost: Cost) -> Self {
        Self {
            packets: cost.packets,
            cost,
            memory_bytes: Some(2048.0),
            whole_s: 0.0,
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
    };
    say(serde_json::to_string(&run).map_err(Failure::run)?)
}

/// In the calling process: has a run made, which ends when it has taken so much wall time, s.
pub(super) fn run(case: Case, wall_s: Option<f64>) -> Result<Run, Failure> {
    let failed = |what: String| Failure::run(format!("cannot run one size by itself: {what}"));
    let program = std::env::current_exe().map_err(|e| failed(e.to_string()))?;
    let Case { line, size } = case;
    let order = match wall_s {
        None => format!("{line}:{size}"),
        Some(wall_s) => format!("{line}:{size}:{wall_s}"),
    };
    let begun = Stopwatch::start();
    let output = Command::new(program)
        .args(std::env::args_os().skip(1))
        .args(["--alone", &order])
        .stdin(Stdio::null())
        .output()
        .map_err(|e| failed(e.to_string()))?;
    if !output.status.success() {
        let words = String::from_utf8_lossy(&output.stderr);
        let words = words.trim().trim_start_matches("error: ");
        return Err(match (words, output.status.code()) {
            ("", _) => failed(output.status.to_string()),
            (words, Some(2)) => Failure::input(words),
            (words, _) => Failure::run(words),
        });
    }
    let mut run: Run = serde_json::from_slice(&output.stdout).map_err(|e| failed(e.to_string()))?;
    run.cost.packets = run.packets;
    run.whole_s = begun.elapsed_s();
    Ok(run)
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
