//! Turns what is recorded into MCAP records.

use crate::air::{Links, Packet, Traffic};
use crate::data::{Event, LogEntry, Metrics, Picture, Reading, Sample, Vehicle};
use crate::message::{self, Timestamp};
use crate::recorder::{Header, Precision};
use crate::scene;
use crate::sink::{Progress, Sink};
use crate::topic::Topic;
use crate::wind::Wind;
use mcap::records::{MessageHeader, Metadata};
use mcap::{McapError, McapResult, WriteOptions, Writer};
use prost::Message;
use std::collections::BTreeMap;
use std::fs::File;
use std::io;
use std::sync::Arc;

/// Name of the frame that all poses are given in: east, north, up.
pub(crate) const WORLD_FRAME: &str = "world";

/// zstd's second level. On poses of 2,000 wandering bees, one core: level 1 takes 200 ns and
/// 55.3 B a vehicle and tick, level 2 230 ns and 52.5 B, level 3 320 ns and 53.4 B, lz4 135 ns
/// and 60.1 B. Level 2 is smaller *and* faster than the default, 3, and needs no second library.
const ZSTD_LEVEL: u32 = 2;

/// Writes the records of one file.
pub(crate) struct Encoder {
    writer: Writer<Sink>,
    progress: Arc<Progress>,
    channels: [u16; Topic::ALL.len()],
    /// The channel of each sensor that has taken a picture.
    cameras: BTreeMap<String, u16>,
    /// The channel of the wind, once there is any.
    wind: Option<u16>,
    precision: Precision,
    with_twists: bool,
    /// Bytes of messages that no closed chunk holds.
    in_chunk: usize,
    /// Messages that go into a chunk of their own, see [`stands_aside`]: topic, time, and where they end in the bytes
    /// below.
    aside: Vec<(Topic, u64, usize)>,
    aside_bytes: Vec<u8>,
    last_tick_ns: Option<u64>,
    poses: message::PosesInFrame,
    /// `None`: there are to be no points.
    cloud: Option<message::PointCloud>,
    twists: message::Twists,
    bytes: Vec<u8>,
}

impl Encoder {
    /// Writes everything that is known before the run starts and flushes it.
    pub(crate) fn create(
        file: File,
        header: &Header,
        progress: Arc<Progress>,
    ) -> McapResult<Encoder> {
        let mut writer = WriteOptions::new()
            .library(concat!("simbeeotic-record/", env!("CARGO_PKG_VERSION")))
            .compression(Some(mcap::Compression::Zstd))
            .compression_level(ZSTD_LEVEL)
            // Its own threads would take the cores of the run.
            .compression_threads(0)
            // Chunks are closed by the clock and by size, between ticks: see `writer`.
            .chunk_size(None)
            // A chunk goes to the file when it is whole, not as a hole to be filled later.
            .disable_seeking(true)
            .create(Sink::new(file, Arc::clone(&progress)))?;

        writer.write_metadata(&Metadata {
            name: "run".into(),
            metadata: header.metadata(),
        })?;
        for file in &header.files {
            writer.attach(&mcap::Attachment {
                log_time: 0,
                create_time: 0,
                name: file.name.clone(),
                media_type: file.media_type.clone(),
                data: file.bytes.as_slice().into(),
            })?;
        }

        let solids = header.stage.as_ref().and_then(scene::solids_of);
        let mut channels = [0; Topic::ALL.len()];
        for topic in Topic::ALL {
            let used = match topic {
                Topic::Twists => header.twists,
                Topic::World | Topic::Points => header.stage.is_some(),
                Topic::Solids => solids.is_some(),
                Topic::Cloud => header.points,
                Topic::Models => !header.models.is_empty(),
                // Made when they are needed.
                Topic::Wind | Topic::Images => false,
                _ => true,
            };
            if !used {
                continue;
            }
            channels[topic as usize] = declare(&mut writer, topic, topic.name())?;
        }

        let mut encoder = Encoder {
            writer,
            progress,
            channels,
            cameras: BTreeMap::new(),
            wind: None,
            precision: header.precision,
            with_twists: header.twists,
            in_chunk: 0,
            aside: Vec::new(),
            aside_bytes: Vec::new(),
            last_tick_ns: None,
            poses: message::PosesInFrame {
                frame_id: WORLD_FRAME.into(),
                ..Default::default()
            },
            cloud: (header.points).then(|| scene::cloud_of_vehicles(&header.vehicles)),
            twists: message::Twists::default(),
            bytes: Vec::new(),
        };
        encoder.vehicles(&header.vehicles)?;
        if let Some(stage) = &header.stage {
            encoder.apart(Topic::World, &scene::scene_of(stage, header.precision))?;
            if let Some(cloud) = scene::cloud_of(stage) {
                encoder.apart(Topic::Points, &cloud)?;
            }
        }
        if let Some(solids) = &solids {
            let channel = encoder.channels[Topic::Solids as usize];
            encoder.bytes_on(channel, 0, solids)?;
        }
        for (models, about) in &header.models {
            encoder.apart(Topic::Models, &scene::pack_about(models, about))?;
        }
        encoder.flush()?;

        Ok(encoder)
    }

    fn vehicles(&mut self, vehicles: &[Vehicle]) -> McapResult<()> {
        let mut list = message::Vehicles::default();
        // Whose look was written where: vehicles that look alike share their pieces.
        let mut places: BTreeMap<usize, i32> = BTreeMap::new();
        for vehicle in vehicles {
            list.paths.push(vehicle.path.clone());
            list.kinds.push(vehicle.kind.clone());
            list.radius_m.push(vehicle.radius_m);
            list.roles.push(vehicle.role.clone());
            list.colors_rgba.push(u32::from_be_bytes(vehicle.color));
            let key = vehicle.pieces.as_ptr().addr();
            let place = match (vehicle.pieces.is_empty(), places.get(&key)) {
                (true, _) => -1,
                (false, Some(place)) => *place,
                (false, None) => {
                    let place = i32::try_from(list.looks.len()).unwrap_or(-1);
                    (list.looks).push(scene::look_of(&vehicle.pieces, self.precision));
                    places.insert(key, place);
                    place
                }
            };
            list.look.push(place);
        }
        self.message(Topic::Vehicles, 0, &list)
    }

    /// Writes a message of the beginning: a large one into a chunk of its own, so that readers of others
    /// need not unpack it.
    fn apart(&mut self, topic: Topic, message: &impl Message) -> McapResult<()> {
        const LARGE: usize = 1 << 18;
        if self.in_chunk > 0 && self.in_chunk + message.encoded_len() > LARGE {
            self.flush()?;
        }
        self.message(topic, 0, message)
    }

    pub(crate) fn tick(&mut self, time_ns: u64, samples: &[Sample]) -> McapResult<()> {
        let timestamp = Some(Timestamp::from_ns(time_ns));
        let precision = self.precision;

        let mut poses = std::mem::take(&mut self.poses);
        poses.timestamp = timestamp;
        poses.poses.clear();
        poses
            .poses
            .extend(samples.iter().map(|sample| pose(sample, precision)));
        let written = self.message(Topic::Poses, time_ns, &poses);
        self.poses = poses;
        written?;

        if let Some(mut cloud) = self.cloud.take() {
            cloud.timestamp = timestamp;
            scene::move_cloud(&mut cloud, samples);
            let written = self.message(Topic::Cloud, time_ns, &cloud);
            self.cloud = Some(cloud);
            written?;
        }

        if self.with_twists {
            let mut twists = std::mem::take(&mut self.twists);
            twists.timestamp = timestamp;
            twists.linear_enu_m_s.clear();
            twists.angular_flu_rad_s.clear();
            for sample in samples {
                let linear = sample.velocity_m_s.map(|v| precision.motion(v));
                let angular = sample.rate_rad_s.map(|w| precision.motion(w));
                twists.linear_enu_m_s.extend(linear);
                twists.angular_flu_rad_s.extend(angular);
            }
            let written = self.message(Topic::Twists, time_ns, &twists);
            self.twists = twists;
            written?;
        }

        self.last_tick_ns = Some(time_ns);
        Ok(())
    }

    pub(crate) fn event(&mut self, event: Event) -> McapResult<()> {
        let time_ns = event.time_ns;
        let event = message::Event {
            timestamp: Some(Timestamp::from_ns(time_ns)),
            kind: event.kind,
            paths: event.paths,
            text: event.text,
        };
        self.message(Topic::Events, time_ns, &event)
    }

    pub(crate) fn log(&mut self, entry: LogEntry) -> McapResult<()> {
        let time_ns = entry.time_ns;
        let entry = message::Log {
            timestamp: Some(Timestamp::from_ns(time_ns)),
            level: entry.level.number(),
            message: entry.text,
            name: entry.path,
            file: String::new(),
            line: 0,
        };
        self.message(Topic::Log, time_ns, &entry)
    }

    pub(crate) fn metrics(&mut self, metrics: Metrics) -> McapResult<()> {
        let time_ns = metrics.time_ns;
        let mut list = message::Metrics {
            timestamp: Some(Timestamp::from_ns(time_ns)),
            ..Default::default()
        };
        for metric in metrics.values {
            list.names.push(metric.name);
            list.units.push(metric.unit);
            list.values.push(metric.value);
        }
        self.message(Topic::Metrics, time_ns, &list)
    }

    pub(crate) fn reading(&mut self, reading: Reading) -> McapResult<()> {
        let time_ns = reading.time_ns;
        let message = message::Reading {
            timestamp: Some(Timestamp::from_ns(time_ns)),
            sensor: reading.sensor,
            names: reading.names,
            units: reading.units,
            truth: reading.truth,
            reading: reading.reading,
            lost: reading.lost,
            unpaired: reading.unpaired,
        };
        self.message(Topic::Readings, time_ns, &message)
    }

    pub(crate) fn packet(&mut self, mut packet: Packet) -> McapResult<()> {
        let precision = self.precision;
        packet.position_m = packet.position_m.map(|p| precision.position(p));
        self.message(Topic::Packets, packet.time_ns, &packet.pack())
    }

    pub(crate) fn traffic(&mut self, traffic: Traffic) -> McapResult<()> {
        self.message(Topic::Radio, traffic.time_ns, &traffic.pack())
    }

    pub(crate) fn links(&mut self, links: Links) -> McapResult<()> {
        self.message(Topic::Links, links.time_ns, &links.pack())
    }

    pub(crate) fn wind(&mut self, wind: &Wind) -> McapResult<()> {
        self.message(Topic::Wind, wind.time_ns, &wind.pack(self.precision))
    }

    pub(crate) fn picture(&mut self, picture: &Picture) -> McapResult<()> {
        let channel = match self.cameras.get(&picture.path) {
            Some(channel) => *channel,
            None => {
                let name = format!("{}/{}", Topic::Images.name(), picture.path);
                let channel = declare(&mut self.writer, Topic::Images, &name)?;
                self.cameras.insert(picture.path.clone(), channel);
                channel
            }
        };
        self.message_on(channel, picture.time_ns, &crate::picture::pack(picture))
    }

    fn message(&mut self, topic: Topic, time_ns: u64, message: &impl Message) -> McapResult<()> {
        match stands_aside(topic) {
            true => self.put_aside(topic, time_ns, message),
            false => self.message_on(self.channels[topic as usize], time_ns, message),
        }
    }

    fn put_aside(&mut self, topic: Topic, time_ns: u64, message: &impl Message) -> McapResult<()> {
        let before = self.aside_bytes.len();
        // Cannot fail: a vector grows.
        let written = message.encode(&mut self.aside_bytes);
        written.map_err(io::Error::other)?;
        let end = self.aside_bytes.len();
        self.aside.push((topic, time_ns, end));
        self.in_chunk += end - before;
        self.progress.count_message();
        Ok(())
    }

    /// Writes what was put aside into a chunk, which stays open. A channel that is made here stands in the chunk of its
    /// first message: who passes over other chunks finds it there.
    fn write_aside(&mut self) -> McapResult<()> {
        let mut from = 0;
        for (topic, time_ns, end) in self.aside.drain(..) {
            let channel = match (topic, self.wind) {
                (Topic::Wind, Some(channel)) => channel,
                (Topic::Wind, None) => {
                    *(self.wind).insert(declare(&mut self.writer, topic, topic.name())?)
                }
                _ => self.channels[topic as usize],
            };
            let header = header(channel, time_ns);
            let bytes = &self.aside_bytes[from..end];
            self.writer.write_to_known_channel(&header, bytes)?;
            from = end;
        }
        self.aside_bytes.clear();
        Ok(())
    }

    fn message_on(
        &mut self,
        channel_id: u16,
        time_ns: u64,
        message: &impl Message,
    ) -> McapResult<()> {
        let mut bytes = std::mem::take(&mut self.bytes);
        bytes.clear();
        // Cannot fail: a vector grows.
        message.encode(&mut bytes).map_err(io::Error::other)?;
        let written = self.bytes_on(channel_id, time_ns, &bytes);
        self.bytes = bytes;
        written
    }

    fn bytes_on(&mut self, channel_id: u16, time_ns: u64, bytes: &[u8]) -> McapResult<()> {
        let header = header(channel_id, time_ns);
        self.writer.write_to_known_channel(&header, bytes)?;
        self.in_chunk += bytes.len();
        self.progress.count_message();
        Ok(())
    }

    /// Bytes that a `kill -9` would lose now, before compression.
    pub(crate) fn unsaved(&self) -> usize {
        self.in_chunk
    }

    /// Closes the chunk, puts what stands aside into one of its own, and hands both to the file.
    pub(crate) fn flush(&mut self) -> McapResult<()> {
        self.writer.flush()?;
        if !self.aside.is_empty() {
            self.write_aside()?;
            self.writer.flush()?;
        }
        self.in_chunk = 0;
        if let Some(time_ns) = self.last_tick_ns {
            self.progress.mark_safe(time_ns);
        }
        Ok(())
    }

    /// Writes the summary and the index. Nothing may be written afterwards.
    pub(crate) fn finish(mut self, summary: Option<String>) -> McapResult<()> {
        self.flush()?;
        if let Some(json) = summary {
            self.writer.write_metadata(&Metadata {
                name: "summary".into(),
                metadata: BTreeMap::from([("json".to_string(), json)]),
            })?;
        }
        self.writer.finish()?;
        if let Some(time_ns) = self.last_tick_ns {
            self.progress.mark_safe(time_ns);
        }
        Ok(())
    }
}

/// Whether messages of a topic stand aside from the bodies' poses, in chunks of their own: what is read for itself, and
/// is small beside them. Then a reader of numbers and marks need not unpack all poses.
fn stands_aside(topic: Topic) -> bool {
    match topic {
        Topic::Log
        | Topic::Events
        | Topic::Metrics
        | Topic::Readings
        | Topic::Packets
        | Topic::Radio
        | Topic::Links
        | Topic::Wind => true,
        Topic::Vehicles
        | Topic::World
        | Topic::Points
        | Topic::Solids
        | Topic::Models
        | Topic::Poses
        | Topic::Cloud
        | Topic::Twists
        | Topic::Images => false,
    }
}

fn header(channel_id: u16, time_ns: u64) -> MessageHeader {
    MessageHeader {
        channel_id,
        sequence: 0,
        log_time: time_ns,
        publish_time: time_ns,
    }
}

/// A new channel for messages of a topic.
fn declare(writer: &mut Writer<Sink>, topic: Topic, name: &str) -> McapResult<u16> {
    let (schema, encoding) = match topic.schema() {
        Some(ty) => {
            let set = ty.descriptor_set();
            (
                writer.add_schema(&ty.full_name(), "protobuf", &set)?,
                "protobuf",
            )
        }
        None => {
            let fields = scene::STRING_FIELDS;
            (writer.add_schema(scene::STRING, "ros2msg", fields)?, "cdr")
        }
    };
    writer.add_channel(schema, name, encoding, &BTreeMap::new())
}

fn pose(sample: &Sample, precision: Precision) -> message::Pose {
    let [x, y, z] = sample.position_m.map(|p| precision.position(p));
    let position = Some(message::Vector3 { x, y, z });
    let [w, x, y, z] = sample.world_from_body.map(|q| precision.attitude(q));
    let orientation = Some(message::Quaternion { x, y, z, w });
    message::Pose {
        position,
        orientation,
    }
}

/// The I/O error inside an MCAP error, or the MCAP error as one.
pub(crate) fn io_error(error: McapError) -> io::Error {
    match error {
        McapError::Io(error) => error,
        other => io::Error::other(other),
    }
}
