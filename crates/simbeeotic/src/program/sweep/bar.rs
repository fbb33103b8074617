//! How far a sweep is, on a terminal.

use super::runs::Going;
use crate::program::show::span;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Steps of the bar: more than a terminal has columns.
const STEPS: u64 = 1000;
/// How often it is looked at.
const PERIOD: Duration = Duration::from_millis(200);

/// A bar on standard error that follows all runs from a thread of its own, those that are going on by how far they
/// are. Draws nothing if standard error is no terminal.
pub(super) struct Bar {
    bar: ProgressBar,
    over: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

/// How many runs there are.
pub(super) struct Counts {
    pub(super) all: usize,
    /// Those that were done before this sweep went on.
    pub(super) before: usize,
    /// Those that are done by now.
    pub(super) done: Arc<AtomicUsize>,
}

impl Bar {
    #[allow(
        clippy::disallowed_methods,
        reason = "shows the user how long it will take"
    )]
    pub(super) fn start(counts: Counts, going: Arc<Mutex<Option<Vec<Going>>>>) -> Self {
        let bar =
            ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::stderr_with_hz(10));
        if let Ok(style) = ProgressStyle::with_template("{bar:32} {percent:>3}%  {msg}") {
            bar.set_style(style.progress_chars("=> "));
        }
        let over = Arc::new(AtomicBool::new(false));
        let (flag, drawn, start) = (Arc::clone(&over), bar.clone(), Instant::now());
        let thread = std::thread::spawn(move || {
            while !flag.load(Ordering::Relaxed) {
                let shares: Vec<f64> = {
                    let going = going.lock().unwrap_or_else(PoisonError::into_inner);
                    going.iter().flatten().map(Going::share).collect()
                };
                let done = counts.done.load(Ordering::Relaxed);
                let flown = (done - counts.before) as f64 + shares.iter().sum::<f64>();
                let whole = (counts.before as f64 + flown) / counts.all as f64;
                drawn.set_position((whole * STEPS as f64) as u64);
                let left = left_s(
                    start.elapsed().as_secs_f64(),
                    flown,
                    (counts.all - counts.before) as f64,
                );
                drawn.set_message(format!(
                    "{done} of {} runs, {} on the way   {} left",
                    counts.all,
                    shares.len(),
                    left.map_or("?".to_owned(), span)
                ));
                std::thread::park_timeout(PERIOD);
            }
        });
        Self {
            bar,
            over,
            thread: Some(thread),
        }
    }

    /// Does something that prints, with the bar out of the way.
    pub(super) fn aside(&self, act: impl FnOnce()) {
        self.bar.suspend(act);
    }
}

impl Drop for Bar {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

/// Seconds until all runs are flown, if the rest is like what was; `None` before there was anything.
fn left_s(elapsed_s: f64, flown: f64, all: f64) -> Option<f64> {
    (flown > 0.0).then(|| elapsed_s * (all - flown).max(0.0) / flown)
}

#[cfg(test)]
mod tests {
    use super::left_s;

    #[test]
    fn the_time_left_counts_pieces_of_runs() {
        assert_eq!(left_s(10.0, 0.0, 8.0), None);
        // Two and a half of eight in ten seconds.
        assert_eq!(left_s(10.0, 2.5, 8.0), Some(22.0));
        assert_eq!(left_s(10.0, 8.0, 8.0), Some(0.0));
    }
}
