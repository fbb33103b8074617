//! Tables out of recordings: CSV and Parquet.
//!
//! One row a vehicle and tick, ordered by tick, then by vehicle. The columns:
//!
//! | column | type | unit | what |
//! |---|---|---|---|
//! | `time_s` | double | s | virtual time since the start of the run |
//! | `time_ns` | int64 | ns | the same, exactly |
//! | `model` | text | | path of the model |
//! | `x_m`, `y_m`, `z_m` | double | m | position: east, north, up |
//! | `vx_m_s`, `vy_m_s`, `vz_m_s` | float | m/s | linear velocity: east, north, up |
//! | `qw`, `qx`, `qy`, `qz` | double | 1 | attitude: the quaternion that turns body vectors into world vectors |
//! | `wx_rad_s`, `wy_rad_s`, `wz_rad_s` | float | rad/s | angular velocity about the body's forward, left and up axes |
//!
//! A recording without twists has no `v…` and `w…` columns. Numbers of a recording of
//! [`Precision::Fine`](crate::Precision::Fine) are rounded to the decimals that it stands for, with
//! no digits after them: 1e-6 m, m/s and rad/s, 1e-7 for attitudes. Those of `Full` are as
//! recorded. CSV holds the shortest decimals that give these numbers back; a number that is not one
//! is `NaN` or `inf`.

mod air;
mod csv;
mod parquet;
mod readings;

pub use air::{AirTable, export_air, export_air_file};
pub use csv::{export_csv, export_csv_file};
pub use parquet::export_parquet;
pub use readings::{export_readings, export_readings_file};

use crate::data::{Sample, Tick};
use crate::recording::{ReadError, Recording};
use crate::selection::Selection;
use crate::ticks::Ticks;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// What an export has written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Exported {
    /// Rows.
    pub rows: u64,
    /// Ticks.
    pub ticks: u64,
    /// Models in each of them.
    pub models: usize,
}

/// Why an export failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExportError {
    /// The recording cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The CSV writer failed.
    #[error("writing CSV: {0}")]
    Csv(io::Error),
    /// The file could not be written; nothing was published.
    #[error("writing {path}: {source}", path = .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Why.
        source: io::Error,
    },
    /// The columns make no table; nothing was written.
    #[error("writing {path}: {what}", path = .path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        what: String,
    },
    /// There is nothing of the kind at the selected times; nothing was written.
    #[error("{0}")]
    NoReadings(String),
    /// A pattern of the [`Selection`] matches no model.
    #[error("no recorded model matches {pattern:?}; {known}")]
    NoModel {
        /// The pattern.
        pattern: String,
        /// What there is.
        known: String,
    },
}

/// The selected part of a recording, tick by tick.
struct Rows<'a> {
    /// Places of the selected vehicles.
    places: Vec<usize>,
    ticks: Ticks<'a>,
    every: u64,
    /// Ticks to skip before the next one that counts.
    skip: u64,
    /// Whether numbers stand for decimals.
    fine: bool,
    exported: Exported,
}

impl<'a> Rows<'a> {
    fn new(recording: &'a Recording, selection: &Selection) -> Result<Self, ExportError> {
        let vehicles = recording.vehicles();
        let places = selection.vehicles(vehicles).map_err(|pattern| {
            let known = match vehicles {
                [] => "the recording has no models".to_string(),
                [only] => format!("the recording has one, {:?}", only.path),
                [first, .., last] => format!(
                    "the recording has {}, from {:?} to {:?}",
                    vehicles.len(),
                    first.path,
                    last.path
                ),
            };
            ExportError::NoModel {
                pattern: pattern.to_string(),
                known,
            }
        })?;
        let exported = Exported {
            models: places.len(),
            ..Exported::default()
        };
        Ok(Rows {
            places,
            ticks: recording.ticks_in(selection.times_ns.clone()),
            every: selection.every.get(),
            skip: 0,
            fine: recording.is_fine(),
            exported,
        })
    }

    /// The next selected tick, with all of its samples.
    fn next_tick(&mut self) -> Result<Option<Tick>, ReadError> {
        for tick in self.ticks.by_ref() {
            let mut tick = tick?;
            if self.skip > 0 {
                self.skip -= 1;
                continue;
            }
            self.skip = self.every - 1;
            if self.fine {
                for &place in &self.places {
                    round(&mut tick.samples[place]);
                }
            }
            self.exported.ticks += 1;
            self.exported.rows += self.places.len() as u64;
            return Ok(Some(tick));
        }
        Ok(None)
    }
}

/// Replaces the numbers of the recording's grid (2⁻²⁰, 2⁻²⁴ for attitudes) by the decimals that
/// they stand for: 0.05000019073486328 by 0.05.
fn round(sample: &mut Sample) {
    const MOTION: f64 = 1e6;
    const ATTITUDE: f64 = 1e7;
    let Sample {
        position_m,
        world_from_body,
        velocity_m_s,
        rate_rad_s,
    } = sample;
    for number in position_m.iter_mut().chain(velocity_m_s).chain(rate_rad_s) {
        *number = decimal(*number, MOTION);
    }
    for number in world_from_body {
        *number = decimal(*number, ATTITUDE);
    }
}

/// To the nearest multiple of `1 / grid`. What has no such digits stays.
fn decimal(number: f64, grid: f64) -> f64 {
    /// From 2⁵² on every `f64` is a whole number.
    const WHOLE: f64 = (1_u64 << 52) as f64;
    let scaled = number * grid;
    if scaled.abs() < WHOLE {
        // Without a negative zero, which would be printed.
        scaled.round() / grid + 0.0
    } else {
        number
    }
}

/// Virtual time in seconds, to the nearest `f64`.
fn seconds(time_ns: u64) -> f64 {
    time_ns as f64 / 1e9
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn false_digits_go_and_numbers_that_are_none_stay() {
        assert_eq!(decimal(0.050_000_190_734_863_28, 1e6).to_string(), "0.05");
        assert_eq!(decimal(-1e-9, 1e6).to_string(), "0");
        assert_eq!(decimal(1e300, 1e6), 1e300);
        assert_eq!(decimal(f64::INFINITY, 1e6), f64::INFINITY);
        assert!(decimal(f64::NAN, 1e6).is_nan());
    }
}
