//! Recordings as Parquet.

use super::{ExportError, Exported, Rows, seconds};
use crate::data::Tick;
use crate::publish::publish;
use crate::recording::{ReadError, Recording};
use crate::selection::Selection;
use crate::table::{Kind, TableError, TableWriter};
use parquet::data_type::ByteArray;
use parquet::errors::ParquetError;
use std::fs::File;
use std::path::Path;

/// Rows of a row group: 25 MB in memory.
const GROUP_ROWS: usize = 1 << 18;

/// Writes the selected part of a recording as a Parquet file (zstd), published by
/// [`crate::publish`]: never torn. The columns are those of the [module](crate::export), all of
/// them required; `version`, `seed`, and the frames stand in the key-value metadata.
///
/// # Errors
/// When a pattern matches no model, when the recording is damaged, or when the file cannot be
/// written. Nothing is published then.
pub fn export_parquet(
    recording: &Recording,
    selection: &Selection,
    path: impl AsRef<Path>,
) -> Result<Exported, ExportError> {
    let path = path.as_ref();
    let rows = Rows::new(recording, selection)?;
    publish(path, |file| write(recording, rows, file)).map_err(|error| match error {
        Error::Read(error) => ExportError::Read(error),
        Error::Table(error) => error.at(path),
    })
}

fn write(recording: &Recording, mut rows: Rows<'_>, file: &File) -> Result<Exported, Error> {
    let twists = recording.has_twists();
    let seed = recording.seed().map(|seed| seed.to_string());
    let notes = [
        ("version", recording.version().unwrap_or_default()),
        ("seed", seed.as_deref().unwrap_or_default()),
        ("world_frame", "ENU"),
        ("body_frame", "FLU"),
    ];
    let mut writer = TableWriter::new(file, &columns(twists), &notes)?;

    let vehicles = recording.vehicles();
    let mut block = Block {
        models: vehicles.iter().map(|v| v.path.as_str().into()).collect(),
        ..Block::default()
    };
    while let Some(tick) = rows.next_tick()? {
        for &place in &rows.places {
            block.push(&tick, place);
            if block.places.len() == GROUP_ROWS {
                block.write(&mut writer, twists)?;
            }
        }
    }
    if !block.places.is_empty() {
        block.write(&mut writer, twists)?;
    }
    writer.close()?;
    Ok(rows.exported)
}

fn columns(twists: bool) -> Vec<(&'static str, Kind)> {
    let twist = |column: &(&str, Kind)| column.1 == Kind::Float;
    let all = [
        ("time_s", Kind::Double),
        ("time_ns", Kind::Int64),
        ("model", Kind::Text),
        ("x_m", Kind::Double),
        ("y_m", Kind::Double),
        ("z_m", Kind::Double),
        ("vx_m_s", Kind::Float),
        ("vy_m_s", Kind::Float),
        ("vz_m_s", Kind::Float),
        ("qw", Kind::Double),
        ("qx", Kind::Double),
        ("qy", Kind::Double),
        ("qz", Kind::Double),
        ("wx_rad_s", Kind::Float),
        ("wy_rad_s", Kind::Float),
        ("wz_rad_s", Kind::Float),
    ];
    all.into_iter()
        .filter(|column| twists || !twist(column))
        .collect()
}

/// Rows that wait to be written, by column.
#[derive(Default)]
struct Block {
    /// Paths of all vehicles, as Parquet takes them.
    models: Vec<ByteArray>,
    times_ns: Vec<u64>,
    places: Vec<usize>,
    position: [Vec<f64>; 3],
    velocity: [Vec<f32>; 3],
    attitude: [Vec<f64>; 4],
    rate: [Vec<f32>; 3],
}

impl Block {
    fn push(&mut self, tick: &Tick, place: usize) {
        let sample = &tick.samples[place];
        self.times_ns.push(tick.time_ns);
        self.places.push(place);
        append(&mut self.position, sample.position_m);
        append(&mut self.velocity, sample.velocity_m_s.map(|v| v as f32));
        append(&mut self.attitude, sample.world_from_body);
        append(&mut self.rate, sample.rate_rad_s.map(|w| w as f32));
    }

    /// Writes the rows as one group and forgets them.
    fn write(&mut self, writer: &mut TableWriter<&File>, twists: bool) -> Result<(), ParquetError> {
        let mut group = writer.group()?;
        let times = self.times_ns.iter();
        group.doubles(&times.clone().map(|&t| seconds(t)).collect::<Vec<_>>())?;
        group.integers(&times.map(|&t| t.cast_signed()).collect::<Vec<_>>())?;
        let models = self.places.iter().map(|&place| self.models[place].clone());
        group.texts(&models.collect::<Vec<_>>())?;
        for column in &self.position {
            group.doubles(column)?;
        }
        for column in self.velocity.iter().filter(|_| twists) {
            group.floats(column)?;
        }
        for column in &self.attitude {
            group.doubles(column)?;
        }
        for column in self.rate.iter().filter(|_| twists) {
            group.floats(column)?;
        }
        group.close()?;

        self.times_ns.clear();
        self.places.clear();
        self.position.iter_mut().for_each(Vec::clear);
        self.velocity.iter_mut().for_each(Vec::clear);
        self.attitude.iter_mut().for_each(Vec::clear);
        self.rate.iter_mut().for_each(Vec::clear);
        Ok(())
    }
}

fn append<T, const N: usize>(columns: &mut [Vec<T>; N], row: [T; N]) {
    for (column, value) in columns.iter_mut().zip(row) {
        column.push(value);
    }
}

enum Error {
    Read(ReadError),
    Table(TableError),
}

impl From<ReadError> for Error {
    fn from(error: ReadError) -> Self {
        Error::Read(error)
    }
}

impl<E: Into<TableError>> From<E> for Error {
    fn from(error: E) -> Self {
        Error::Table(error.into())
    }
}
