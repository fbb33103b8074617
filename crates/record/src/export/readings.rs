//! What sensors read, as text.
//!
//! One row for each number: tidy, as statistics programs like it.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `time_s`, `time_ns` | s, ns | virtual time of the measurement |
//! | `sensor` | | path of the sensor: `bee-17/imu` |
//! | `row` | 1 | the row of a reading that has several: the beam of a scan, from 0 |
//! | `quantity` | | the column of the reading: `forward`; empty for a single number |
//! | `unit` | | its SI unit; `1` for counts |
//! | `truth` | as said | what a perfect sensor would have read; empty in a row of the reading alone |
//! | `reading` | as said | what it read; `NaN` where there was nothing to read; empty in a row of the truth alone |
//! | `lost` | 1 | 1 if this measurement was lost by drop-out, else 0 |
//!
//! Of a list of things that were found (neighbours, flowers, ranges to anchors) no row of the reading is
//! about the same as the row of the truth with its number. Such readings have rows of the truth first, each
//! without a reading, then rows of the reading, each without a truth.
//!
//! A lost measurement has no reading; of a sensor that is read on demand it has the last one again, which is
//! what the behaviour got.

use super::csv::{quoted, write_file};
use super::{ExportError, Exported, seconds};
use crate::data::Reading;
use crate::recording::Recording;
use crate::selection::Selection;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

/// Writes the selected readings of a recording as CSV (comma, header line, `\n`): those of sensors
/// whose path matches, of each sensor every n-th.
///
/// # Errors
/// When there are no readings at these times, when a pattern matches no sensor that has one, when the recording is damaged, or when `out`
/// fails. Rows before the error are written.
pub fn export_readings(
    recording: &Recording,
    selection: &Selection,
    out: &mut dyn Write,
) -> Result<Exported, ExportError> {
    let mut exported = Exported::default();
    let mut seen: BTreeMap<String, u64> = BTreeMap::new();
    let mut used = BTreeSet::new();
    let mut text = String::from("time_s,time_ns,sensor,row,quantity,unit,truth,reading,lost\n");
    for reading in recording.readings_in(selection.times_ns.clone()) {
        let reading = reading?;
        let count = seen.entry(reading.sensor.clone()).or_default();
        *count += 1;
        let nth = (*count - 1) % selection.every.get();
        let matching = selection.matching(&reading.sensor);
        used.extend(matching.iter().copied());
        if nth != 0 || matching.is_empty() && !selection.models.is_empty() {
            continue;
        }
        exported.ticks += 1;
        exported.rows += rows(&mut text, &reading);
        if text.len() > 1 << 16 {
            out.write_all(text.as_bytes()).map_err(ExportError::Csv)?;
            text.clear();
        }
    }
    out.write_all(text.as_bytes()).map_err(ExportError::Csv)?;
    out.flush().map_err(ExportError::Csv)?;
    exported.models = seen.len();
    if seen.is_empty() && selection.models.is_empty() {
        return Err(ExportError::NoReadings(match recording.readings().next() {
            None => "the recording has no readings: name sensors in the recorder's `readings`, and give \
                     them a `rate` if no behaviour reads them"
                .to_owned(),
            Some(_) => "the recording has no readings between these times".to_owned(),
        }));
    }
    let mut patterns = 0..selection.models.len();
    if let Some(useless) = patterns.find(|at| !used.contains(at)) {
        return Err(ExportError::NoModel {
            pattern: selection.models[useless].clone(),
            known: match seen.keys().next() {
                None => "the recording has no readings".to_owned(),
                Some(first) => format!(
                    "the recording has readings of {} sensors, {first:?} among them",
                    seen.len()
                ),
            },
        });
    }
    Ok(exported)
}

/// Appends a reading, a line for each number; how many. Writing to a text cannot fail.
fn rows(text: &mut String, reading: &Reading) -> u64 {
    let start = format!(
        "{},{},{}",
        seconds(reading.time_ns),
        reading.time_ns,
        quoted(&reading.sensor)
    );
    let columns = reading.names.len().max(1);
    let mut list = |truth: &[f64], read: &[f64]| {
        let count = read.len().max(truth.len());
        for at in 0..count {
            let (row, column) = (at / columns, at % columns);
            let word = |words: &[String]| words.get(column).map_or(String::new(), |w| quoted(w));
            let number = |numbers: &[f64]| numbers.get(at).map_or(String::new(), f64::to_string);
            let _ = writeln!(
                text,
                "{start},{row},{},{},{},{},{}",
                word(&reading.names),
                word(&reading.units),
                number(truth),
                number(read),
                u8::from(reading.lost)
            );
        }
        count as u64
    };
    if reading.unpaired {
        list(&reading.truth, &[]) + list(&[], &reading.reading)
    } else {
        list(&reading.truth, &reading.reading)
    }
}

/// Writes the selected readings as a CSV file, published by [`crate::publish`]: never torn. See
/// [`export_readings`].
///
/// # Errors
/// As [`export_readings`]. Nothing is published then.
pub fn export_readings_file(
    recording: &Recording,
    selection: &Selection,
    path: impl AsRef<Path>,
) -> Result<Exported, ExportError> {
    let write = |out: &mut dyn Write| export_readings(recording, selection, out);
    write_file(path.as_ref(), write)
}
