//! Frames of a recording: which there are, and the few that are kept.

use crate::wire::{Columns, seconds};
use simbeeotic_record::{Recording, Tick};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Bytes of frames that are kept.
const KEPT_BYTES: usize = 48 << 20;

/// Ticks that are read in one go: several share a chunk of the file.
const AHEAD: usize = 8;

/// The ticks of a recording.
pub(super) struct Film {
    times_ns: Vec<u64>,
    kept: Mutex<Kept>,
}

#[derive(Default)]
struct Kept {
    /// By time; with when each was wanted last.
    frames: BTreeMap<u64, (u64, Arc<Columns>)>,
    bytes: usize,
    clock: u64,
}

impl Kept {
    fn get(&mut self, time_ns: u64) -> Option<Arc<Columns>> {
        self.clock += 1;
        let clock = self.clock;
        let (wanted, frame) = self.frames.get_mut(&time_ns)?;
        *wanted = clock;
        Some(Arc::clone(frame))
    }

    fn put(&mut self, time_ns: u64, frame: Arc<Columns>) {
        self.clock += 1;
        self.bytes += bytes_of(&frame);
        if let Some((_, old)) = self.frames.insert(time_ns, (self.clock, frame)) {
            self.bytes -= bytes_of(&old);
        }
        while self.bytes > KEPT_BYTES && self.frames.len() > 1 {
            let oldest = self.frames.iter().min_by_key(|(_, (wanted, _))| *wanted);
            let Some(time_ns) = oldest.map(|(time_ns, _)| *time_ns) else {
                return;
            };
            if let Some((_, old)) = self.frames.remove(&time_ns) {
                self.bytes -= bytes_of(&old);
            }
        }
    }
}

fn bytes_of(frame: &Columns) -> usize {
    frame.len() * 32 + 64
}

impl Film {
    pub(super) fn new(mut times_ns: Vec<u64>) -> Self {
        times_ns.sort_unstable();
        times_ns.dedup();
        Self {
            times_ns,
            kept: Mutex::default(),
        }
    }

    /// The times of all ticks, ns.
    pub(super) fn times_ns(&self) -> &[u64] {
        &self.times_ns
    }

    /// The least time between two ticks, s; 0 if there are less than two.
    pub(super) fn period_s(&self) -> f64 {
        let pairs = self.times_ns.windows(2).map(|pair| pair[1] - pair[0]);
        pairs.min().map_or(0.0, seconds)
    }

    /// The ticks of a span of time: from the one at or before its start; one each `step_ns`, and the last.
    pub(super) fn wanted(&self, from_ns: u64, to_ns: u64, step_ns: u64) -> Vec<u64> {
        let times = &self.times_ns;
        let first = times
            .partition_point(|time| *time <= from_ns)
            .saturating_sub(1);
        let end = times.partition_point(|time| *time <= to_ns);
        let Some(range) = times.get(first..end.max(first)) else {
            return Vec::new();
        };
        if step_ns == 0 {
            return range.to_vec();
        }
        let mut wanted: Vec<u64> = Vec::new();
        let mut due = 0;
        for time in range {
            if *time >= due {
                wanted.push(*time);
                due = time.saturating_add(step_ns);
            }
        }
        if let Some(last) = range.last().filter(|last| wanted.last() != Some(*last)) {
            wanted.push(*last);
        }
        wanted
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The frame at the first of these times; those that come next may be read with it. `None`: that part
    /// of the file is damaged.
    pub(super) fn frame(&self, recording: &Recording, times_ns: &[u64]) -> Option<Arc<Columns>> {
        let first = *times_ns.first()?;
        if let Some(frame) = self.kept().get(first) {
            return Some(frame);
        }
        // Those that stand side by side in the file.
        let from = self.times_ns.partition_point(|time| *time < first);
        let next = self.times_ns[from..].iter().zip(times_ns);
        let together = next.take(AHEAD).take_while(|(a, b)| a == b);
        let last = together.last().map_or(first, |(time, _)| *time);
        let mut found = None;
        for tick in recording.ticks_in(first..=last).flatten() {
            let frame = Arc::new(columns(&tick));
            if tick.time_ns == first {
                found = Some(Arc::clone(&frame));
            }
            self.kept().put(tick.time_ns, frame);
        }
        found
    }
}

fn columns(tick: &Tick) -> Columns {
    let single = |v: [f64; 3]| v.map(|part| part as f32);
    let samples = &tick.samples;
    let known = samples.iter().all(|s| s.velocity_m_s[0].is_finite());
    let moving = samples.iter().filter(|_| known);
    Columns {
        time_s: seconds(tick.time_ns),
        positions: samples.iter().map(|s| single(s.position_m)).collect(),
        velocities: moving.map(|s| single(s.velocity_m_s)).collect(),
        attitudes: (samples.iter())
            .map(|s| Columns::attitude(s.world_from_body))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_span_begins_with_the_tick_before_it() {
        let film = Film::new(vec![0, 10, 20, 30, 40, 50]);
        assert_eq!(film.wanted(12, 30, 0), [10, 20, 30]);
        assert_eq!(film.wanted(10, 10, 0), [10]);
        assert_eq!(film.wanted(0, 50, 20), [0, 20, 40, 50]);
        assert_eq!(film.wanted(60, 70, 0), [50]);
        assert_eq!(film.wanted(30, 10, 0), [0; 0]);
        assert_eq!(Film::new(Vec::new()).wanted(0, 10, 0), [0; 0]);
        assert_eq!(film.period_s(), 1e-8);
    }

    #[test]
    fn few_frames_are_kept_and_the_oldest_go() {
        let mut kept = Kept::default();
        let frame = Arc::new(Columns {
            positions: vec![[0.0; 3]; 100_000],
            ..Columns::default()
        });
        for time_ns in 0..100 {
            kept.put(time_ns, Arc::clone(&frame));
            assert!(kept.get(0).is_some(), "it is wanted again and again");
        }
        assert!(kept.bytes <= KEPT_BYTES, "{}", kept.bytes);
        assert!(kept.get(50).is_none());
        assert!(kept.get(99).is_some());
    }
}
