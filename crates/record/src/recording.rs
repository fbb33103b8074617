//! Reading a recording back.

use crate::chunk::ChunkError;
use crate::data::{
    Attachment, Event, LogEntry, LogLevel, Metric, Metrics, Picture, Reading, Vehicle,
};
use crate::frame::{Fields, op};
use crate::index::{self, Extent, Index};
use crate::message;
use crate::messages::Messages;
use crate::recorder::Precision;
use crate::scene;
use crate::source::Source;
use crate::stage::{Piece, Stage};
use crate::ticks::Ticks;
use crate::topic::Topic;
use prost::Message;
use simbeeotic_model::About;
use std::collections::BTreeMap;
use std::io;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};
use thiserror::Error;

/// Why a recording cannot be read.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadError {
    /// The file cannot be opened or read.
    #[error("reading {path}: {source}", path = .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The file does not begin like an MCAP file.
    #[error("{path} is not an MCAP file", path = .path.display())]
    NotMcap {
        /// The file.
        path: PathBuf,
    },
    /// The file is an MCAP file, but has no list of vehicles.
    #[error(
        "{path} was not recorded by simbeeotic: it has no channel {topic}",
        path = .path.display(),
        topic = Topic::Vehicles.name()
    )]
    NotOurs {
        /// The file.
        path: PathBuf,
    },
    /// A part of the file is not what it claims to be. Other parts may be readable: the iterator
    /// that returned this goes on behind it.
    #[error("{path} is damaged at byte {offset}: {what}", path = .path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// Where the damaged record begins, in bytes from the start of the file.
        offset: u64,
        /// What is wrong.
        what: String,
    },
    /// The file was compressed by another program in a way that this one does not know.
    #[error("{path} is compressed with {name}; only zstd can be read here", path = .path.display())]
    Compression {
        /// The file.
        path: PathBuf,
        /// The compression.
        name: String,
    },
}

/// A recording, open for reading.
///
/// Holds the index and the list of vehicles in memory, and one chunk (about a megabyte) for each
/// iterator; the size of the file does not matter.
///
/// A recording that was cut short (`kill -9`, a full disk) is read as far as it goes; see
/// [`Recording::truncated`].
#[derive(Debug)]
pub struct Recording {
    path: PathBuf,
    pub(crate) source: Source,
    pub(crate) index: Index,
    vehicles: Vec<Vehicle>,
    metadata: BTreeMap<String, BTreeMap<String, String>>,
    /// What each model is, by its path; read when somebody asks.
    abouts: OnceLock<BTreeMap<String, Arc<About>>>,
}

impl Recording {
    /// Opens a recording.
    ///
    /// # Errors
    /// When the file cannot be read, is no MCAP file, or has no list of vehicles. A file cut off
    /// before the list of vehicles opens, with none in it.
    pub fn open(path: impl AsRef<Path>) -> Result<Recording, ReadError> {
        let path = path.as_ref().to_path_buf();
        let io = |source| ReadError::Io {
            path: path.clone(),
            source,
        };
        let source = Source::open(&path).map_err(io)?;
        let Some(index) = index::index(&source).map_err(io)? else {
            return Err(ReadError::NotMcap { path });
        };

        let mut recording = Recording {
            path,
            source,
            index,
            vehicles: Vec::new(),
            metadata: BTreeMap::new(),
            abouts: OnceLock::new(),
        };
        recording.read_metadata()?;
        recording.read_vehicles()?;
        Ok(recording)
    }

    /// The file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Who flies. Their order is the order of every tick.
    pub fn vehicles(&self) -> &[Vehicle] {
        &self.vehicles
    }

    /// What stands in the world; `None` if that was not recorded, or was cut off.
    ///
    /// It is read from the file at each call. Positions have the precision of the recording; the pieces of a
    /// prop come by form: boxes, spheres, cylinders, meshes, capsules.
    ///
    /// # Errors
    /// When the file cannot be read or this part of it is damaged.
    pub fn stage(&self) -> Result<Option<Stage>, ReadError> {
        let mut messages = Messages::new(self, topic_list(Topic::World), 0..=0);
        let Some(found) = messages.next() else {
            return Ok(None);
        };
        let scene: message::SceneUpdate = messages.decode(&found?)?;
        Ok(Some(scene::stage_of(&scene)))
    }

    /// What a vehicle is made of, by its place in [`vehicles`](Self::vehicles): parts with their parameters, sensors,
    /// radios (without numbers). `None` if that was not recorded.
    ///
    /// The first call reads what is known of all; the rest is quick.
    ///
    /// # Errors
    /// When the file cannot be read or this part of it is damaged.
    pub fn about(&self, vehicle: usize) -> Result<Option<Arc<About>>, ReadError> {
        let abouts = match self.abouts.get() {
            Some(abouts) => abouts,
            None => {
                let read = self.read_abouts()?;
                self.abouts.get_or_init(|| read)
            }
        };
        let path = self.vehicles.get(vehicle).map(|vehicle| &vehicle.path);
        Ok(path.and_then(|path| abouts.get(path)).cloned())
    }

    fn read_abouts(&self) -> Result<BTreeMap<String, Arc<About>>, ReadError> {
        let mut all = BTreeMap::new();
        let mut messages = Messages::new(self, topic_list(Topic::Models), 0..=0);
        while let Some(found) = messages.next() {
            let (models, about) = scene::unpack_about(messages.decode(&found?)?);
            let about = Arc::new(about);
            all.extend(models.into_iter().map(|model| (model, Arc::clone(&about))));
        }
        Ok(all)
    }

    /// Whether the file was cut short, so that the end of the run may be missing.
    pub fn truncated(&self) -> bool {
        !self.index.whole
    }

    /// Whether ticks have velocities and rates.
    pub fn has_twists(&self) -> bool {
        let mut topics = self.index.channels.values();
        topics.any(|topic| *topic == Topic::Twists)
    }

    /// Virtual time of the last message, ns since the start of the run; 0 if there is none.
    pub fn end_ns(&self) -> u64 {
        let ends = self.index.chunks.iter().map(|chunk| chunk.end_ns);
        ends.max().unwrap_or(0)
    }

    /// A metadata record by its name: `run` and `summary` are ours.
    pub fn metadata(&self, name: &str) -> Option<&BTreeMap<String, String>> {
        self.metadata.get(name)
    }

    /// Version of the program that ran.
    pub fn version(&self) -> Option<&str> {
        self.run("version")
    }

    /// Seed of the run.
    pub fn seed(&self) -> Option<u64> {
        self.run("seed")?.parse().ok()
    }

    /// The scenario that ran, as text.
    pub fn scenario(&self) -> Option<&str> {
        self.run("scenario")
    }

    /// Whether its numbers lie on the grid of [`Precision::Fine`].
    pub(crate) fn is_fine(&self) -> bool {
        self.run("precision") == Some(Precision::Fine.name())
    }

    fn run(&self, key: &str) -> Option<&str> {
        Some(self.metadata.get("run")?.get(key)?.as_str())
    }

    /// The summary written at the end of the run; `None` if the run did not come to its end.
    pub fn summary(&self) -> Option<serde_json::Value> {
        serde_json::from_str(self.metadata.get("summary")?.get("json")?).ok()
    }

    /// The files kept with the run.
    ///
    /// # Errors
    /// When the file cannot be read or an attachment is damaged.
    pub fn attachments(&self) -> Result<Vec<Attachment>, ReadError> {
        let extents = self.index.attachments.iter();
        extents
            .map(|extent| {
                let record = self.record(*extent)?;
                attachment(&record).ok_or_else(|| self.damaged(extent.offset, "bad attachment"))
            })
            .collect()
    }

    /// All ticks, in the order recorded.
    pub fn ticks(&self) -> Ticks<'_> {
        self.ticks_in(0..=u64::MAX)
    }

    /// The ticks at these virtual times, ns. Skips the rest of the file without reading it.
    pub fn ticks_in(&self, times_ns: RangeInclusive<u64>) -> Ticks<'_> {
        Ticks::new(self, times_ns)
    }

    /// All marks on the time line, in the order recorded.
    pub fn events(&self) -> impl Iterator<Item = Result<Event, ReadError>> + '_ {
        self.decoded(Topic::Events, |time_ns, event: message::Event| Event {
            time_ns,
            kind: event.kind,
            paths: event.paths,
            text: event.text,
        })
    }

    /// The log, in the order recorded.
    pub fn log(&self) -> impl Iterator<Item = Result<LogEntry, ReadError>> + '_ {
        self.decoded(Topic::Log, |time_ns, log: message::Log| LogEntry {
            time_ns,
            level: LogLevel::from_number(log.level),
            path: log.name,
            text: log.message,
        })
    }

    /// All metrics, in the order recorded.
    pub fn metrics(&self) -> impl Iterator<Item = Result<Metrics, ReadError>> + '_ {
        self.decoded(Topic::Metrics, |time_ns, list: message::Metrics| {
            let units = list
                .units
                .into_iter()
                .chain(std::iter::repeat(String::new()));
            let named = list.names.into_iter().zip(units).zip(list.values);
            let values = named
                .map(|((name, unit), value)| Metric { name, unit, value })
                .collect();
            Metrics { time_ns, values }
        })
    }

    /// What sensors read, in the order recorded.
    pub fn readings(&self) -> impl Iterator<Item = Result<Reading, ReadError>> + '_ {
        self.readings_in(0..=u64::MAX)
    }

    /// What sensors read at these virtual times, ns.
    pub fn readings_in(
        &self,
        times_ns: RangeInclusive<u64>,
    ) -> impl Iterator<Item = Result<Reading, ReadError>> + '_ {
        let mut messages = Messages::new(self, topic_list(Topic::Readings), times_ns);
        std::iter::from_fn(move || {
            Some(messages.next()?.and_then(|found| {
                let found_reading: message::Reading = messages.decode(&found)?;
                let reading = Reading {
                    time_ns: found.time_ns,
                    sensor: found_reading.sensor,
                    names: found_reading.names,
                    units: found_reading.units,
                    truth: found_reading.truth,
                    reading: found_reading.reading,
                    lost: found_reading.lost,
                    unpaired: found_reading.unpaired,
                };
                let columns = reading.names.len().max(1);
                let whole = |numbers: &[f64]| numbers.len().is_multiple_of(columns);
                if !whole(&reading.reading) || !whole(&reading.truth) {
                    return Err(messages.damaged("a reading that is not whole rows"));
                }
                Ok(reading)
            }))
        })
    }

    /// The pictures that sensors took at these virtual times, ns, in the order recorded.
    pub fn pictures_in(
        &self,
        times_ns: RangeInclusive<u64>,
    ) -> impl Iterator<Item = Result<Picture, ReadError>> + '_ {
        let mut messages = Messages::new(self, topic_list(Topic::Images), times_ns);
        std::iter::from_fn(move || {
            Some(messages.next()?.and_then(|found| {
                let raw = messages.decode(&found)?;
                crate::picture::unpack(found.time_ns, raw).map_err(|what| messages.damaged(what))
            }))
        })
    }

    fn decoded<M: Message + Default, T>(
        &self,
        topic: Topic,
        convert: impl Fn(u64, M) -> T,
    ) -> impl Iterator<Item = Result<T, ReadError>> {
        let mut messages = Messages::new(self, topic_list(topic), 0..=u64::MAX);
        std::iter::from_fn(move || {
            Some(messages.next()?.and_then(|found| {
                let message = messages.decode(&found)?;
                Ok(convert(found.time_ns, message))
            }))
        })
    }

    fn read_metadata(&mut self) -> Result<(), ReadError> {
        for extent in &self.index.metadata {
            let record = self.record(*extent)?;
            let (name, map) =
                metadata(&record).ok_or_else(|| self.damaged(extent.offset, "bad metadata"))?;
            self.metadata.insert(name, map);
        }
        Ok(())
    }

    fn read_vehicles(&mut self) -> Result<(), ReadError> {
        let mut messages = Messages::new(self, &[Topic::Vehicles], 0..=u64::MAX);
        let list = match messages.next() {
            Some(found) => Some(messages.decode::<message::Vehicles>(&found?)?),
            None => None,
        };
        // In a file without summary the channels are known only now.
        self.index.channels = messages.into_channels();
        index::learn_channels(&self.source, &mut self.index);

        let list = match list {
            Some(list) => list,
            None if self.truncated() => return Ok(()),
            None => {
                return Err(ReadError::NotOurs {
                    path: self.path.clone(),
                });
            }
        };
        // Of older recordings the lists behind the paths are shorter, or not there.
        let looks: Vec<Arc<[Piece]>> = list.looks.iter().map(scene::pieces_of_look).collect();
        let look = |place: Option<&i32>| {
            let place = usize::try_from(*place?).ok()?;
            looks.get(place).cloned()
        };
        let vehicle = |(at, path): (usize, String)| Vehicle {
            path,
            kind: list.kinds.get(at).cloned().unwrap_or_default(),
            radius_m: list.radius_m.get(at).copied().unwrap_or_default(),
            role: list.roles.get(at).cloned().unwrap_or_default(),
            color: list
                .colors_rgba
                .get(at)
                .map_or([0; 4], |rgba| rgba.to_be_bytes()),
            pieces: look(list.look.get(at)).unwrap_or_default(),
        };
        self.vehicles = list.paths.into_iter().enumerate().map(vehicle).collect();
        Ok(())
    }

    /// The bytes of a record, with its opcode and length.
    fn record(&self, extent: Extent) -> Result<Vec<u8>, ReadError> {
        let mut bytes = Vec::new();
        match self.source.read(extent.offset, extent.length, &mut bytes) {
            Ok(true) => Ok(bytes),
            Ok(false) => Err(self.damaged(extent.offset, "the file became shorter")),
            Err(source) => Err(self.io_error(source)),
        }
    }

    pub(crate) fn io_error(&self, source: io::Error) -> ReadError {
        ReadError::Io {
            path: self.path.clone(),
            source,
        }
    }

    pub(crate) fn damaged(&self, offset: u64, what: impl ToString) -> ReadError {
        ReadError::Damaged {
            path: self.path.clone(),
            offset,
            what: what.to_string(),
        }
    }

    pub(crate) fn chunk_error(&self, offset: u64, error: ChunkError) -> ReadError {
        match error {
            ChunkError::Io(source) => self.io_error(source),
            ChunkError::Damaged(what) => self.damaged(offset, what),
            ChunkError::Compression(name) => ReadError::Compression {
                path: self.path.clone(),
                name,
            },
        }
    }
}

/// A list of one, that lives as long as the program.
pub(crate) fn topic_list(topic: Topic) -> &'static [Topic] {
    let place = topic as usize;
    &Topic::ALL.as_slice()[place..=place]
}

fn metadata(record: &[u8]) -> Option<(String, BTreeMap<String, String>)> {
    let Some((op::METADATA, body)) = Fields(record).record() else {
        return None;
    };
    let mut fields = Fields(body);
    Some((fields.text()?.to_string(), fields.texts_by_name()?))
}

fn attachment(record: &[u8]) -> Option<Attachment> {
    let Some((op::ATTACHMENT, body)) = Fields(record).record() else {
        return None;
    };
    let mut fields = Fields(body);
    let _log_time = fields.u64()?;
    let _create_time = fields.u64()?;
    let name = fields.text()?.to_string();
    let media_type = fields.text()?.to_string();
    let length = fields.u64()?;
    let bytes = fields.bytes(length)?.to_vec();

    let covered = body.len() - fields.0.len();
    let crc = fields.u32()?;
    let intact = crc == 0 || crc32fast::hash(&body[..covered]) == crc;
    intact.then_some(Attachment {
        name,
        media_type,
        bytes,
    })
}
