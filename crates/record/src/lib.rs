//! Simbeeotic: the log of a run: MCAP recording, CSV and Parquet export.

pub mod export;

mod chunk;
mod data;
mod encoder;
mod frame;
mod index;
mod message;
mod messages;
mod publish;
mod recorder;
mod recording;
mod schema;
mod selection;
mod sink;
mod source;
mod table;
mod ticks;
mod topic;
mod writer;

pub use data::{Attachment, Event, LogEntry, LogLevel, Metric, Metrics, Sample, Tick, Vehicle};
pub use export::{ExportError, Exported, export_csv, export_parquet};
pub use publish::publish;
pub use recorder::{Header, Precision, RecordError, RecordStats, Recorder};
pub use recording::{ReadError, Recording};
pub use selection::Selection;
pub use table::{Column, Values, write_table};
pub use ticks::Ticks;
