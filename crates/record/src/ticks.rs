//! Puts poses and twists together again.

use crate::data::{Sample, Tick};
use crate::index;
use crate::message;
use crate::messages::Messages;
use crate::recording::{ReadError, Recording};
use crate::topic::Topic;
use std::ops::RangeInclusive;

/// The ticks of a recording. See [`Recording::ticks`].
///
/// An error stands for one damaged part of the file; the iterator goes on behind it.
#[derive(Debug)]
pub struct Ticks<'a> {
    messages: Messages<'a>,
    vehicles: usize,
    with_twists: bool,
    /// Poses whose twists may follow.
    waiting: Option<Tick>,
}

impl Recording {
    /// The times of all ticks, ns, without reading what is in them.
    ///
    /// # Errors
    /// When the file cannot be read at all; parts that are damaged are left out.
    pub fn tick_times(&self) -> Result<Vec<u64>, ReadError> {
        let mut messages = Messages::new(self, &[Topic::Poses], 0..=u64::MAX);
        let mut times = Vec::new();
        while let Some(found) = messages.next() {
            match found {
                Ok(found) => times.push(found.time_ns),
                Err(error @ ReadError::Io { .. }) => return Err(error),
                Err(_) => {}
            }
        }
        Ok(times)
    }

    /// The times of all ticks, ns, as the indexes of the file have them: no chunk is unpacked, which is a hundred
    /// times as fast as [`tick_times`](Self::tick_times). Ticks of damaged parts may be among them. Of a file that
    /// was cut off, or of another program's, what has no index is unpacked.
    ///
    /// # Errors
    /// When the file cannot be read at all.
    pub fn indexed_tick_times(&self) -> Result<Vec<u64>, ReadError> {
        let poses = self.index.channels.iter();
        let mut poses = poses.filter(|(_, topic)| **topic == Topic::Poses);
        let (Some((channel, _)), None) = (poses.next(), poses.next()) else {
            return self.tick_times();
        };
        let mut times: Vec<u64> = Vec::new();
        for chunk in &self.index.chunks {
            let Some(channels) = &chunk.channels else {
                // The last one of a file that was cut off.
                let from_ns = times.last().map_or(0, |last| last + 1);
                let span_ns = from_ns.max(chunk.start_ns)..=chunk.end_ns;
                let mut messages = Messages::new(self, &[Topic::Poses], span_ns);
                while let Some(found) = messages.next() {
                    times.extend(found.map(|found| found.time_ns));
                }
                continue;
            };
            let Some((_, offset)) = channels.iter().find(|(id, _)| id == channel) else {
                continue;
            };
            match index::message_times(&self.source, *offset, *channel) {
                Ok(Some(list)) => times.extend(list),
                Ok(None) => return self.tick_times(),
                Err(error) => return Err(self.io_error(error)),
            }
        }
        Ok(times)
    }
}

impl<'a> Ticks<'a> {
    pub(crate) fn new(recording: &'a Recording, times_ns: RangeInclusive<u64>) -> Self {
        Ticks {
            messages: Messages::new(recording, &[Topic::Poses, Topic::Twists], times_ns),
            vehicles: recording.vehicles().len(),
            with_twists: recording.has_twists(),
            waiting: None,
        }
    }

    fn poses(&self, time_ns: u64, poses: message::PosesInFrame) -> Result<Tick, ReadError> {
        if poses.poses.len() != self.vehicles {
            return Err(self.messages.damaged(format!(
                "a tick of {} poses for {} vehicles",
                poses.poses.len(),
                self.vehicles
            )));
        }
        let samples = poses.poses.iter().map(|pose| {
            let position = pose.position.unwrap_or_default();
            let attitude = pose.orientation.unwrap_or_default();
            Sample {
                position_m: [position.x, position.y, position.z],
                world_from_body: [attitude.w, attitude.x, attitude.y, attitude.z],
                velocity_m_s: [f64::NAN; 3],
                rate_rad_s: [f64::NAN; 3],
            }
        });
        Ok(Tick {
            time_ns,
            samples: samples.collect(),
        })
    }

    /// Adds the twists to the waiting poses and returns both, if they belong together.
    fn twists(
        &mut self,
        time_ns: u64,
        twists: &message::Twists,
    ) -> Result<Option<Tick>, ReadError> {
        let Some(mut tick) = self.waiting.take() else {
            return Ok(None);
        };
        let (linear, linear_rest) = twists.linear_enu_m_s.as_chunks::<3>();
        let (angular, angular_rest) = twists.angular_flu_rad_s.as_chunks::<3>();
        let fits = linear.len() == self.vehicles
            && angular.len() == self.vehicles
            && linear_rest.is_empty()
            && angular_rest.is_empty()
            && tick.time_ns == time_ns;
        if !fits {
            let what = format!("twists at {time_ns} ns do not fit the poses before them");
            self.waiting = Some(tick);
            return Err(self.messages.damaged(what));
        }
        for ((sample, v), w) in tick.samples.iter_mut().zip(linear).zip(angular) {
            sample.velocity_m_s = v.map(f64::from);
            sample.rate_rad_s = w.map(f64::from);
        }
        Ok(Some(tick))
    }
}

impl Iterator for Ticks<'_> {
    type Item = Result<Tick, ReadError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let found = match self.messages.next() {
                Some(Ok(found)) => found,
                Some(Err(error)) => return Some(Err(error)),
                None => return self.waiting.take().map(Ok),
            };
            let step = match found.topic {
                Topic::Twists => (self.messages.decode(&found))
                    .and_then(|twists| self.twists(found.time_ns, &twists)),
                _ => (self.messages.decode(&found))
                    .and_then(|poses| self.poses(found.time_ns, poses))
                    .map(|tick| self.waiting.replace(tick)),
            };
            match step {
                Err(error) => return Some(Err(error)),
                Ok(Some(tick)) => return Some(Ok(tick)),
                Ok(None) if self.with_twists => {}
                Ok(None) => {
                    if let Some(tick) = self.waiting.take() {
                        return Some(Ok(tick));
                    }
                }
            }
        }
    }
}
