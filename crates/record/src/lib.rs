//! The log of a run: written while it flies, read back afterwards, turned into tables.
//!
//! # The file
//!
//! A recording is an [MCAP](https://mcap.dev) file with protobuf messages. Foxglove and Rerun
//! open it as it is, `mcap` libraries exist for many languages, and every message is described
//! in the file itself. All times are virtual, in ns since the start of the run. The world frame,
//! `world`, is ENU (east, north, up); body frames are FLU (forward, left, up).
//!
//! | channel | schema | when |
//! |---|---|---|
//! | `/vehicles` | `simbeeotic.Vehicles` | once, first: paths, kinds, radii, looks; their order is the order of all ticks |
//! | `/world` | [`foxglove.SceneUpdate`](https://docs.foxglove.dev/docs/visualization/message-schemas/scene-update) | once: what stands in the world |
//! | `/world/points` | [`foxglove.PointCloud`](https://docs.foxglove.dev/docs/visualization/message-schemas/point-cloud) | once: points on its surfaces |
//! | `/robot_description` | `std_msgs/msg/String` | solids of the world as a URDF, in CDR: all that Rerun draws of it |
//! | `/models` | `simbeeotic.About` | once for all models that are alike: parts, sensors, radios |
//! | `/poses` | [`foxglove.PosesInFrame`](https://docs.foxglove.dev/docs/visualization/message-schemas/poses-in-frame) | every tick: all vehicles |
//! | `/poses/points` | [`foxglove.PointCloud`](https://docs.foxglove.dev/docs/visualization/message-schemas/point-cloud) | where they are, in their colours |
//! | `/twists` | `simbeeotic.Twists` | every tick, after its poses |
//! | `/log` | [`foxglove.Log`](https://docs.foxglove.dev/docs/visualization/message-schemas/log) | what models say |
//! | `/events` | `simbeeotic.Event` | contacts and other marks |
//! | `/metrics` | `simbeeotic.Metrics` | numbers that models publish |
//! | `/readings` | `simbeeotic.Reading` | what sensors read, and the truth beside it |
//! | `/packets` | `simbeeotic.Packet` | a transmission, and who received it |
//! | `/radio` | `simbeeotic.Radio` | how many frames were sent, received and lost in a period |
//! | `/links` | `simbeeotic.Links` | how well each radio heard each other in a period |
//! | `/wind` | `simbeeotic.Wind` | the air around the swarm, on a coarse grid; not where it is calm |
//! | `/images/PATH` | [`foxglove.RawImage`](https://docs.foxglove.dev/docs/visualization/message-schemas/raw-image) | what the camera at this path saw |
//!
//! ```text
//! message Vehicles { repeated string paths = 1; repeated string kinds = 2; repeated double radius_m = 3;
//!                    repeated string roles = 4; repeated fixed32 colors_rgba = 5;
//!                    repeated int32 look = 6; repeated foxglove.SceneEntity looks = 7; }  // look: place in looks, or -1
//! message About    { repeated string models = 1; repeated AboutPart parts = 2;
//!                    repeated AboutSensor sensors = 3; repeated string radios = 4; }
//! message AboutPart   { string place = 1; string name = 2; repeated foxglove.KeyValuePair parameters = 3; }
//! message AboutSensor { string name = 1; foxglove.Pose mount = 2; AboutBeams beams = 3; }
//! message AboutBeams  { string kind = 1; double range_m = 2; repeated double directions = 3;
//!                       double half_angle_rad = 4; double horizontal_rad = 5; double vertical_rad = 6; }
//! message Twists   { google.protobuf.Timestamp timestamp = 1;
//!                    repeated float linear_enu_m_s = 2;        // x y z of the first vehicle, of the second, ...
//!                    repeated float angular_flu_rad_s = 3; }
//! message Event    { google.protobuf.Timestamp timestamp = 1; string kind = 2; repeated string paths = 3; string text = 4; }
//! message Metrics  { google.protobuf.Timestamp timestamp = 1;
//!                    repeated string names = 2; repeated string units = 3; repeated double values = 4; }
//! message Reading  { google.protobuf.Timestamp timestamp = 1; string sensor = 2;
//!                    repeated string names = 3; repeated string units = 4;   // one row
//!                    repeated double truth = 5; repeated double reading = 6; } // whole rows
//! message Packet   { google.protobuf.Timestamp timestamp = 1; string sender = 2; string radio = 3; int32 channel = 4;
//!                    double frequency_hz = 5; string destination = 6; int32 bytes = 7; int32 payload_bytes = 8;
//!                    int64 airtime_ns = 9; double power_dbm = 10; foxglove.Vector3 position = 11;
//!                    repeated string receivers = 12; repeated float rssi_dbm = 13; repeated float snr_db = 14;
//!                    repeated int32 lqi = 15; repeated int64 delay_ns = 16; }
//! message Radio    { google.protobuf.Timestamp timestamp = 1; double period_s = 2; string radio = 3;
//!                    int64 sent = 4; int64 received = 5; int64 overheard = 6;          // in the period
//!                    repeated string reasons = 7; repeated int64 lost = 8;
//!                    int64 sent_total = 9; int64 received_total = 10; int64 overheard_total = 11;
//!                    repeated int64 lost_total = 12; }                                 // since the start
//! message Links    { google.protobuf.Timestamp timestamp = 1; double period_s = 2; repeated string radios = 3;
//!                    repeated int32 from = 4; repeated int32 to = 5;                   // places in radios
//!                    repeated int32 sent = 6; repeated int32 received = 7;
//!                    repeated float rssi_dbm = 8; repeated float distance_m = 9; }
//! message Wind     { google.protobuf.Timestamp timestamp = 1;
//!                    repeated float position_enu_m = 2;        // x y z of the first point, of the second, ...
//!                    repeated float velocity_enu_m_s = 3; }
//! ```
//!
//! The metadata record `run` holds `version`, `seed`, `scenario` and `precision`, the metadata
//! record `summary`, written at the end, the summary as `json`. The files of the run are attached.
//!
//! # What it costs
//!
//! | bytes a vehicle and tick | [`Precision::Fine`] | [`Precision::Full`] |
//! |---|---|---|
//! | poses, points and twists | 58 | 92 |
//! | poses and twists | 49 | 83 |
//! | poses only | 30 | 60 |
//!
//! What is said once: the world, 10 to 50 bytes a primitive and up to 160 kB of points; 10 bytes a solid of the URDF; of each vehicle some 50 bytes
//! before compression.
//!
//! 10,000 bees once a second make 35 MB a minute; 1,000 bees at 10 Hz make 2.1 GB an hour. The
//! run's thread copies 104 B a vehicle and tick, some 35 ns; encoding and compression take some
//! 400 ns on another thread. How often a tick is recorded is the caller's choice.
//! `cargo run --release -p simbeeotic-record --example throughput` measures it.
//!
//! # What survives
//!
//! Chunks are closed and handed to the operating system every 0.4 s of wall time at the latest,
//! in whole records. After a `kill -9` or a full disk the file ends there; it reads like any other
//! and says that it is [truncated](Recording::truncated). (A power cut may take more: nothing is
//! forced to the disk before the end.)
//!
//! Reading trusts nothing: a damaged file gives errors that name the byte, and its other chunks.
//!
//! # Where to read on
//!
//! [`Recorder`] and [`Header`] to write; [`Recording`] and [`Tick`] to read; [`export_csv_file`],
//! [`export_parquet`] and [`Selection`] for tables of a recording; [`write_table`] for any other
//! table; [`publish`] for files that appear whole or not at all. Inside: `recorder` (the run's
//! side), `writer` (the thread, and when a chunk is closed), `encoder` (samples to messages),
//! `sink` (the file); then `frame` (bytes to records), `index` (where things are), `messages`,
//! `ticks`.

pub mod component;
pub mod export;

mod air;
mod chunk;
mod data;
mod encoder;
mod frame;
mod index;
mod message;
mod messages;
mod picture;
mod publish;
mod radio;
mod recorder;
mod recording;
mod roster;
mod scene;
mod schema;
mod selection;
mod sink;
mod source;
pub mod stage;
mod table;
mod table_read;
mod ticks;
mod topic;
mod wind;
mod writer;

pub use air::{Link, Links, Packet, Received, Tallies, Traffic};
pub use data::{
    Attachment, Event, LogEntry, LogLevel, Metric, Metrics, Picture, Reading, Sample, Tick, Vehicle,
};
pub use export::{
    AirTable, ExportError, Exported, export_air, export_air_file, export_csv, export_csv_file,
    export_parquet, export_readings, export_readings_file,
};
pub use publish::{publish, publishable};
pub use radio::{ALL_RADIOS_MAX, Aloft, Flight, Pairs};
pub use recorder::{Header, Precision, RecordError, RecordStats, Recorder};
pub use recording::{ReadError, Recording};
pub use roster::vehicles_of;
pub use selection::Selection;
pub use stage::Stage;
pub use table::{Column, Values, write_table};
pub use table_read::{TableReadError, read_table};
pub use ticks::Ticks;
pub use wind::Wind;
