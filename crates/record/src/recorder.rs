//! Writing a recording while a run goes on.

use crate::air::{Links, Packet, Traffic};
use crate::data::{Attachment, Event, LogEntry, Metrics, Picture, Reading, Sample, Vehicle};
use crate::encoder::{Encoder, io_error};
use crate::sink::Progress;
use crate::stage::Stage;
use crate::wind::Wind;
use crate::writer::{self, Job};
use simbeeotic_model::About;
use std::collections::BTreeMap;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, SyncSender, TrySendError};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};
use thiserror::Error;

/// What is known before the run starts.
#[derive(Clone, Debug)]
pub struct Header {
    /// Version of the program that runs.
    pub version: String,
    /// Seed of the run.
    pub seed: u64,
    /// The scenario that runs, as text: after overrides, with all defaults that were filled in.
    pub scenario: String,
    /// More about the run, kept in the metadata record `run` beside `version`, `seed`,
    /// `scenario` and `precision`, which these keys cannot replace.
    pub notes: BTreeMap<String, String>,
    /// The files of the run as they were written.
    pub files: Vec<Attachment>,
    /// Who flies, in the order of every tick.
    pub vehicles: Vec<Vehicle>,
    /// What stands in the world; `None` if that is not to be recorded.
    pub stage: Option<Stage>,
    /// What models are made of: paths of those that are alike, and what they are.
    pub models: Vec<(Vec<String>, About)>,
    /// Whether ticks carry velocities and rates (24 B a vehicle before compression) or poses only.
    pub twists: bool,
    /// Whether ticks carry the positions once more, to 1 mm, as a cloud of points in the vehicles' colours
    /// (16 B a vehicle before compression): viewers that know nothing of vehicles draw that.
    pub points: bool,
    /// How many digits are kept.
    pub precision: Precision,
}

impl Default for Header {
    /// No vehicles, nothing known about the run; twists and points are recorded.
    fn default() -> Self {
        Header {
            version: String::new(),
            seed: 0,
            scenario: String::new(),
            notes: BTreeMap::new(),
            files: Vec::new(),
            vehicles: Vec::new(),
            stage: None,
            models: Vec::new(),
            twists: true,
            points: true,
            precision: Precision::default(),
        }
    }
}

impl Header {
    /// The metadata record `run`.
    pub(crate) fn metadata(&self) -> BTreeMap<String, String> {
        let mut map = self.notes.clone();
        map.insert("version".into(), self.version.clone());
        map.insert("seed".into(), self.seed.to_string());
        map.insert("scenario".into(), self.scenario.clone());
        map.insert("precision".into(), self.precision.name().into());
        map
    }
}

/// How many digits of a sample are kept. Noise does not compress: this decides the size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// Positions to 2⁻²⁰ m (about 1 µm), attitude components to 2⁻²⁴ (about 0.1 µrad),
    /// velocities and rates to 2⁻²⁰ m/s and rad/s. Takes half the space of `Full`, or less.
    #[default]
    Fine,
    /// Every bit of positions and attitudes; velocities and rates as `f32`.
    Full,
}

impl Precision {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Precision::Fine => "fine",
            Precision::Full => "full",
        }
    }

    pub(crate) fn position(self, metres: f64) -> f64 {
        self.round(metres, (1_u32 << 20).into())
    }

    pub(crate) fn attitude(self, component: f64) -> f64 {
        self.round(component, (1_u32 << 24).into())
    }

    pub(crate) fn motion(self, value: f64) -> f32 {
        self.round(value, (1_u32 << 20).into()) as f32
    }

    /// To the nearest multiple of `1 / grid`. NaN, infinities, and numbers so large that they
    /// have no digits to drop, stay.
    fn round(self, value: f64, grid: f64) -> f64 {
        /// From 2⁵² on every `f64` is a whole number.
        const WHOLE: f64 = (1_u64 << 52) as f64;
        let scaled = value * grid;
        match self {
            Precision::Fine if scaled.abs() < WHOLE => scaled.round() / grid,
            _ => value,
        }
    }
}

/// What a recording has cost so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RecordStats {
    /// Bytes in the file. They lag behind by what waits to be written.
    pub bytes: u64,
    /// Messages written, over all channels.
    pub messages: u64,
    /// Ticks taken.
    pub ticks: u64,
    /// Time for which the run stood still because the writer could not keep up. The last wait,
    /// for the file to be completed in [`Recorder::finish`], is not counted.
    pub blocked: Duration,
    /// Virtual time of the last tick that is in the file and would survive a `kill -9` now, ns.
    pub safe_until_ns: Option<u64>,
}

/// Why recording failed.
///
/// The run can go on without its recording; the caller decides. Every later call repeats the
/// first error.
#[derive(Clone, Debug, Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The file could not be made, or the thread that writes it.
    #[error("{path} cannot be recorded to: {source}", path = .path.display())]
    Create {
        /// The file.
        path: PathBuf,
        /// Why.
        source: Arc<io::Error>,
    },
    /// The file could not be written on, for example because the disk is full.
    #[error(
        "recording {path}: {source}; {bytes} bytes are written and can be read",
        path = .path.display()
    )]
    Write {
        /// The file.
        path: PathBuf,
        /// Bytes in the file: whole records.
        bytes: u64,
        /// Why.
        source: Arc<io::Error>,
    },
    /// A tick does not fit the list of vehicles. It was not recorded.
    #[error(
        "recording {path}: a tick at {time_ns} ns has {found} samples for {expected} vehicles",
        path = .path.display()
    )]
    Samples {
        /// The file.
        path: PathBuf,
        /// Virtual time of the tick, ns.
        time_ns: u64,
        /// Samples in the tick.
        found: usize,
        /// Vehicles in the header.
        expected: usize,
    },
}

/// Writes one recording.
///
/// The run's thread only copies samples into a buffer; another thread rounds, encodes, compresses
/// and writes. Between them stands a queue of bounded length. When it is full the caller waits,
/// and the wait is counted in [`RecordStats::blocked`].
///
/// A recorder that is dropped closes its file properly, without a summary and without a way to
/// report an error; [`Recorder::finish`] does both.
///
/// ```
/// use simbeeotic_record::{Header, Recorder, Recording, Sample, Vehicle};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let folder = tempfile::tempdir()?;
/// # let path = folder.path().join("run.mcap");
/// let bee = Vehicle { path: "bee-0".into(), kind: "inert-bee".into(), radius_m: 0.01, ..Vehicle::default() };
/// let header = Header { seed: 7, vehicles: vec![bee], ..Header::default() };
/// let mut recorder = Recorder::create(&path, header)?;
/// recorder.tick(100_000_000, [Sample { position_m: [1.0, 2.0, 3.0], ..Sample::default() }])?;
/// recorder.finish(&serde_json::json!({ "events": 1 }))?;
///
/// let recording = Recording::open(&path)?;
/// let tick = recording.ticks().next().expect("one tick was written")?;
/// assert_eq!(tick.samples[0].position_m, [1.0, 2.0, 3.0]);
/// # Ok(())
/// # }
/// ```
#[derive(Debug)]
pub struct Recorder {
    path: PathBuf,
    vehicles: usize,
    jobs: Option<SyncSender<Job>>,
    /// Buffers to use again. Behind a lock that is never taken: it makes the recorder [`Sync`].
    spare: Mutex<Receiver<Vec<Sample>>>,
    thread: Option<JoinHandle<()>>,
    progress: Arc<Progress>,
    ticks: u64,
    blocked: Duration,
}

impl Recorder {
    /// Creates the file, replacing an older one, and writes the header.
    ///
    /// When this returns, the file can be read, with no ticks in it.
    ///
    /// # Errors
    /// When the file cannot be made or the header cannot be written.
    pub fn create(path: impl AsRef<Path>, header: Header) -> Result<Recorder, RecordError> {
        let path = path.as_ref().to_path_buf();
        let progress = Arc::new(Progress::default());
        let cannot_start = |source: io::Error| RecordError::Create {
            path: path.clone(),
            source: Arc::new(source),
        };

        let file = File::create(&path).map_err(cannot_start)?;
        let encoder = match Encoder::create(file, &header, Arc::clone(&progress)) {
            Ok(encoder) => encoder,
            Err(error) => {
                progress.fail(io_error(error));
                return Err(failure(&path, &progress));
            }
        };

        let (jobs, queue) = mpsc::sync_channel(queue_length(header.vehicles.len()));
        let (give_back, spare) = mpsc::channel();
        let shared = Arc::clone(&progress);
        let thread = thread::Builder::new()
            .name("recorder".into())
            .spawn(move || writer::write_all(encoder, &queue, &give_back, &shared))
            .map_err(cannot_start)?;

        Ok(Recorder {
            vehicles: header.vehicles.len(),
            path,
            jobs: Some(jobs),
            spare: Mutex::new(spare),
            thread: Some(thread),
            progress,
            ticks: 0,
            blocked: Duration::ZERO,
        })
    }

    /// Records all vehicles at one instant, one sample each, in the header's order.
    ///
    /// Ticks are expected in order of time; readers show them in the order written.
    ///
    /// # Errors
    /// When the number of samples is wrong, or when writing has failed.
    pub fn tick(
        &mut self,
        time_ns: u64,
        samples: impl IntoIterator<Item = Sample>,
    ) -> Result<(), RecordError> {
        let spare = self.spare.get_mut().unwrap_or_else(PoisonError::into_inner);
        let mut buffer = spare.try_recv().unwrap_or_default();
        buffer.clear();
        buffer.extend(samples);
        if buffer.len() != self.vehicles {
            return Err(RecordError::Samples {
                path: self.path.clone(),
                time_ns,
                found: buffer.len(),
                expected: self.vehicles,
            });
        }
        self.send(Job::Tick {
            time_ns,
            samples: buffer,
        })?;
        self.ticks += 1;
        Ok(())
    }

    /// Records a mark on the time line.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn event(&mut self, event: Event) -> Result<(), RecordError> {
        self.send(Job::Event(event))
    }

    /// Records a line of the log.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn log(&mut self, entry: LogEntry) -> Result<(), RecordError> {
        self.send(Job::Log(entry))
    }

    /// Records named numbers.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn metrics(&mut self, metrics: Metrics) -> Result<(), RecordError> {
        self.send(Job::Metrics(metrics))
    }

    /// Records what a sensor read.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn reading(&mut self, reading: Reading) -> Result<(), RecordError> {
        self.send(Job::Reading(reading))
    }

    /// Records a picture. Each path has a channel of its own: `/images/bee-17/camera`.
    ///
    /// # Errors
    /// When writing has failed, for example because there are more than 65,000 such paths.
    pub fn picture(&mut self, picture: Picture) -> Result<(), RecordError> {
        self.send(Job::Picture(picture))
    }

    /// Records a transmission and its receptions.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn packet(&mut self, packet: Packet) -> Result<(), RecordError> {
        self.send(Job::Packet(Box::new(packet)))
    }

    /// Records how many frames were sent, received and lost.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn traffic(&mut self, traffic: Traffic) -> Result<(), RecordError> {
        self.send(Job::Traffic(Box::new(traffic)))
    }

    /// Records how well radios heard each other.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn links(&mut self, links: Links) -> Result<(), RecordError> {
        self.send(Job::Links(links))
    }

    /// Records the wind around the swarm.
    ///
    /// # Errors
    /// When writing has failed.
    pub fn wind(&mut self, wind: Wind) -> Result<(), RecordError> {
        self.send(Job::Wind(wind))
    }

    /// What the recording has cost so far.
    pub fn stats(&self) -> RecordStats {
        RecordStats {
            bytes: self.progress.bytes(),
            messages: self.progress.messages(),
            ticks: self.ticks,
            blocked: self.blocked,
            safe_until_ns: self.progress.safe_until_ns(),
        }
    }

    /// Writes what waits, then `summary` (kept as JSON in the metadata record `summary`), then
    /// the index, and closes the file.
    ///
    /// # Errors
    /// When anything could not be written, now or earlier.
    pub fn finish(mut self, summary: &serde_json::Value) -> Result<RecordStats, RecordError> {
        self.send(Job::Finish(Some(summary.to_string())))?;
        self.join();
        match self.progress.failure() {
            Some(_) => Err(failure(&self.path, &self.progress)),
            None => Ok(self.stats()),
        }
    }

    fn send(&mut self, job: Job) -> Result<(), RecordError> {
        let Some(jobs) = &self.jobs else {
            return Err(failure(&self.path, &self.progress));
        };
        let sent = match jobs.try_send(job) {
            Ok(()) => true,
            Err(TrySendError::Disconnected(_)) => false,
            Err(TrySendError::Full(job)) => {
                let since = now();
                let sent = jobs.send(job).is_ok();
                self.blocked += since.elapsed();
                sent
            }
        };
        if sent {
            return Ok(());
        }
        // The writer hangs up only after an error, which `join` waits to be told.
        self.join();
        Err(failure(&self.path, &self.progress))
    }

    /// Hangs up and waits for the writer. A panic there is a broken invariant and goes on here.
    fn join(&mut self) {
        self.jobs = None;
        if let Some(Err(panic)) = self.thread.take().map(JoinHandle::join)
            && !thread::panicking()
        {
            std::panic::resume_unwind(panic);
        }
    }
}

impl Drop for Recorder {
    fn drop(&mut self) {
        self.join();
    }
}

#[expect(
    clippy::disallowed_methods,
    reason = "tells how long the run waited; no result depends on it"
)]
fn now() -> Instant {
    Instant::now()
}

fn failure(path: &Path, progress: &Progress) -> RecordError {
    let unknown = || Arc::new(io::Error::other("the writer has stopped"));
    RecordError::Write {
        path: path.to_path_buf(),
        bytes: progress.bytes(),
        source: progress.failure().unwrap_or_else(unknown),
    }
}

/// Jobs that may wait: 64 MiB of ticks, but 4 ticks at least and 256 at most.
fn queue_length(vehicles: usize) -> usize {
    let tick_bytes = (vehicles * size_of::<Sample>()).max(1);
    ((64 << 20) / tick_bytes).clamp(4, 256)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_queue_holds_tens_of_megabytes_whatever_the_swarm() {
        assert_eq!(queue_length(0), 256);
        assert_eq!(queue_length(10_000), 64);
        assert_eq!(queue_length(10_000_000), 4);
    }

    #[test]
    fn fine_precision_is_a_micrometre() {
        let fine = Precision::Fine;
        assert!((fine.position(123.456_789_012_3) - 123.456_789_012_3).abs() < 0.5e-6);
        assert!((fine.attitude(0.123_456_789) - 0.123_456_789).abs() < 0.5e-7);
        assert_eq!(Precision::Full.position(0.1).to_bits(), 0.1_f64.to_bits());
    }

    #[test]
    fn rounding_keeps_what_is_not_a_number() {
        assert!(Precision::Fine.position(f64::NAN).is_nan());
        assert_eq!(Precision::Fine.position(f64::INFINITY), f64::INFINITY);
        assert_eq!(Precision::Fine.position(1e308), 1e308);
    }

    #[test]
    fn a_recorder_can_live_anywhere_in_a_run() {
        fn shared<T: Send + Sync>() {}
        shared::<Recorder>();
        shared::<crate::Recording>();
    }

    #[test]
    fn notes_cannot_replace_the_seed() {
        let notes = BTreeMap::from([("seed".to_string(), "no".to_string())]);
        let header = Header {
            seed: 5,
            notes,
            ..Header::default()
        };
        assert_eq!(header.metadata()["seed"], "5");
    }
}
