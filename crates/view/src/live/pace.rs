//! When to look next: often enough by the wall clock, whatever the speed of the run.
//!
//! The run asks for a virtual time, and gets there sooner or later than it seemed. So it looks more often
//! than it takes frames, which costs next to nothing, and never asks for more than some milliseconds.

use std::time::{Duration, Instant};

/// Wall time between two looks, s, while a page is there, and while none is.
const WATCHED_S: f64 = 0.002;
const ALONE_S: f64 = 0.01;

/// The speed from which on looks come more often: a run that fast can become slow by much.
const FAST: f64 = 10.0;

/// The least wall time between two looks, s.
const LEAST_S: f64 = 0.000_2;

/// Wall time over which the speed is measured.
const WINDOW: Duration = Duration::from_millis(50);

/// The clock of a viewer.
pub(super) struct Pace {
    begun: Instant,
    /// Virtual and wall time at the start of the window.
    window: Option<(u64, Duration)>,
    /// Virtual seconds a second, in the last window.
    speed: f64,
    step_ns: u64,
}

impl Pace {
    #[allow(
        clippy::disallowed_methods,
        reason = "frames come by the wall clock, and nothing of it reaches the run"
    )]
    pub(super) fn new() -> Self {
        Self {
            begun: Instant::now(),
            window: None,
            speed: 0.0,
            step_ns: 1_000_000,
        }
    }

    /// Wall time since it was made.
    pub(super) fn wall(&self) -> Duration {
        self.begun.elapsed()
    }

    /// Virtual time until the next look, ns.
    pub(super) fn step_ns(&self) -> u64 {
        self.step_ns
    }

    /// The run stood still: nothing can be learnt from the time before.
    pub(super) fn stood(&mut self) {
        self.window = None;
    }

    /// Chooses the next step, after a look.
    pub(super) fn looked(&mut self, now_ns: u64, wall: Duration, watched: bool) {
        let (from_ns, from) = *self.window.get_or_insert((now_ns, wall));
        let passed = wall.saturating_sub(from);
        let young = self.speed == 0.0 && passed >= Duration::from_millis(1);
        if passed >= WINDOW || young {
            self.speed = now_ns.saturating_sub(from_ns) as f64 * 1e-9 / passed.as_secs_f64();
        }
        if passed >= WINDOW {
            self.window = Some((now_ns, wall));
        }
        if self.speed > 0.0 {
            let most_s = if watched { WATCHED_S } else { ALONE_S };
            let wall_s = (most_s * FAST / self.speed).clamp(LEAST_S, most_s);
            let wanted = self.speed * wall_s * 1e9;
            let most = self.step_ns.saturating_mul(4) as f64;
            self.step_ns = wanted.min(most).max(1000.0) as u64;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Runs a second of wall time at a speed; returns the wall times between looks, s.
    fn run(pace: &mut Pace, from: (f64, f64), speed: f64, watched: bool) -> Vec<f64> {
        let (mut now_s, mut wall_s) = from;
        let mut gaps = Vec::new();
        while wall_s < from.1 + 1.0 {
            let step_s = pace.step_ns() as f64 * 1e-9;
            now_s += step_s;
            wall_s += step_s / speed;
            gaps.push(step_s / speed);
            pace.looked(
                (now_s * 1e9) as u64,
                Duration::from_secs_f64(wall_s),
                watched,
            );
        }
        gaps
    }

    #[test]
    fn looks_come_in_time_at_any_speed() {
        for speed in [0.01, 1.0, 10.0, 1000.0, 10_000.0] {
            let mut pace = Pace::new();
            // The speed is not known at first.
            run(&mut pace, (0.0, 0.0), speed, true);
            let gaps = run(&mut pace, (speed, 1.0), speed, true);
            let late = gaps.iter().copied().fold(0.0, f64::max);
            assert!(late < 0.003, "{speed}: {late}");
            assert!(gaps.len() < 6000, "{speed}: {} looks a second", gaps.len());
        }
    }

    #[test]
    fn a_run_that_slows_down_is_not_lost_sight_of() {
        let mut pace = Pace::new();
        run(&mut pace, (0.0, 0.0), 10_000.0, true);
        let step_s = pace.step_ns() as f64 * 1e-9;
        // The last step of the fast run, at the new pace.
        assert!(step_s / 1.0 < 2.5, "{step_s} s");
        let gaps = run(&mut pace, (10_000.0, 1.0), 1.0, true);
        let late = gaps.iter().skip(20).copied().fold(0.0, f64::max);
        assert!(late < 0.003, "{late}");
    }

    #[test]
    fn nobody_looks_seldom() {
        let mut pace = Pace::new();
        let gaps = run(&mut pace, (0.0, 0.0), 1.0, false);
        assert!(gaps.len() < 150, "{} looks a second", gaps.len());
    }
}
