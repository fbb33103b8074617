//! The thread that writes: encodes, compresses and saves while the run goes on.

use crate::air::{Links, Packet, Traffic};
use crate::data::{Event, LogEntry, Metrics, Picture, Reading, Sample};
use crate::encoder::{Encoder, io_error};
use crate::sink::Progress;
use crate::wind::Wind;
use mcap::McapResult;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

/// What the run's thread sends.
#[derive(Debug)]
pub(crate) enum Job {
    Tick { time_ns: u64, samples: Vec<Sample> },
    Event(Event),
    Log(LogEntry),
    Metrics(Metrics),
    Reading(Reading),
    Picture(Picture),
    Packet(Box<Packet>),
    Traffic(Box<Traffic>),
    Links(Links),
    Wind(Wind),
    Finish(Option<String>),
}

/// Writes until told to finish, or until all senders are gone. The first error ends it and
/// stands in `progress`; a sender sees that nobody listens any more.
pub(crate) fn write_all(
    mut encoder: Encoder,
    jobs: &Receiver<Job>,
    spare: &Sender<Vec<Sample>>,
    progress: &Progress,
) {
    let mut policy = ChunkPolicy::default();
    let result = loop {
        let job = match policy.wait(now()) {
            None => jobs.recv().map_err(|_| RecvTimeoutError::Disconnected),
            Some(wait) => jobs.recv_timeout(wait),
        };
        let written = match job {
            Ok(Job::Finish(summary)) => break encoder.finish(summary),
            Ok(job) => write(&mut encoder, job, spare),
            Err(RecvTimeoutError::Timeout) => Ok(()),
            Err(RecvTimeoutError::Disconnected) => break encoder.finish(None),
        };
        if let Err(error) = written.and_then(|()| close_if_due(&mut encoder, &mut policy)) {
            break Err(error);
        }
    };
    if let Err(error) = result {
        progress.fail(io_error(error));
    }
}

fn write(encoder: &mut Encoder, job: Job, spare: &Sender<Vec<Sample>>) -> McapResult<()> {
    match job {
        Job::Tick { time_ns, samples } => {
            let written = encoder.tick(time_ns, &samples);
            // The run may be over; then nobody needs the buffer.
            let _ = spare.send(samples);
            written
        }
        Job::Event(event) => encoder.event(event),
        Job::Log(entry) => encoder.log(entry),
        Job::Metrics(metrics) => encoder.metrics(metrics),
        Job::Reading(reading) => encoder.reading(reading),
        Job::Picture(picture) => encoder.picture(&picture),
        Job::Packet(packet) => encoder.packet(*packet),
        Job::Traffic(traffic) => encoder.traffic(*traffic),
        Job::Links(links) => encoder.links(links),
        Job::Wind(wind) => encoder.wind(&wind),
        Job::Finish(_) => Ok(()),
    }
}

fn close_if_due(encoder: &mut Encoder, policy: &mut ChunkPolicy) -> McapResult<()> {
    if policy.due(encoder.unsaved(), now()) {
        encoder.flush()?;
        policy.closed();
    }
    Ok(())
}

#[expect(
    clippy::disallowed_methods,
    reason = "chunks are closed by the wall clock; no result depends on it"
)]
fn now() -> Instant {
    Instant::now()
}

/// When a chunk is closed: it is a trade of size against loss.
///
/// Larger chunks compress better, up to about 1 MiB. What is in an open chunk is lost when the
/// process is killed.
#[derive(Debug, Default)]
struct ChunkPolicy {
    /// When the first message of the open chunk was written.
    opened: Option<Instant>,
}

impl ChunkPolicy {
    /// An open chunk is closed after this time.
    const AGE_MAX: Duration = Duration::from_millis(400);
    /// A chunk is closed when its messages reach this size.
    const SIZE_MAX: usize = 1 << 20;

    /// Whether a chunk that holds `size` bytes is to be closed.
    fn due(&mut self, size: usize, now: Instant) -> bool {
        if size == 0 {
            return false;
        }
        let opened = *self.opened.get_or_insert(now);
        size >= Self::SIZE_MAX || now.saturating_duration_since(opened) >= Self::AGE_MAX
    }

    /// How long the writer may sleep; for ever (`None`) while no chunk is open.
    fn wait(&self, now: Instant) -> Option<Duration> {
        let opened = self.opened?;
        Some(Self::AGE_MAX.saturating_sub(now.saturating_duration_since(opened)))
    }

    fn closed(&mut self) {
        self.opened = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chunk_is_closed_by_age_even_if_nothing_more_comes() {
        let mut policy = ChunkPolicy::default();
        let start = now();
        assert_eq!(policy.wait(start), None, "nothing to save");
        assert!(!policy.due(0, start));

        assert!(!policy.due(100, start));
        assert_eq!(policy.wait(start), Some(ChunkPolicy::AGE_MAX));

        let later = start + ChunkPolicy::AGE_MAX / 2;
        assert!(!policy.due(200, later));
        assert_eq!(policy.wait(later), Some(ChunkPolicy::AGE_MAX / 2));

        let due = start + ChunkPolicy::AGE_MAX;
        assert_eq!(policy.wait(due), Some(Duration::ZERO));
        assert!(policy.due(200, due));

        policy.closed();
        assert_eq!(policy.wait(due), None);
        assert!(!policy.due(100, due), "a new chunk has its own age");
    }

    #[test]
    fn a_chunk_is_closed_when_it_is_large() {
        let mut policy = ChunkPolicy::default();
        assert!(policy.due(ChunkPolicy::SIZE_MAX, now()));
    }

    #[test]
    fn no_chunk_stays_open_for_half_a_second() {
        assert!(ChunkPolicy::AGE_MAX < Duration::from_millis(500));
    }
}
