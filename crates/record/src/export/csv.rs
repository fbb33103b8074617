//! Recordings as text.

use super::{ExportError, Exported, Rows, seconds};
use crate::data::Sample;
use crate::publish::publish;
use crate::recording::Recording;
use crate::selection::Selection;
use std::fmt::Write as _;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes the selected part of a recording as CSV (comma, header line, `\n`). The columns are
/// those of the [module](crate::export).
///
/// # Errors
/// When a pattern matches no model, when the recording is damaged, or when `out` fails. Rows
/// before the error are written.
pub fn export_csv(
    recording: &Recording,
    selection: &Selection,
    out: &mut dyn Write,
) -> Result<Exported, ExportError> {
    let mut rows = Rows::new(recording, selection)?;
    let twists = recording.has_twists();
    let names: Vec<String> = recording
        .vehicles()
        .iter()
        .map(|v| quoted(&v.path))
        .collect();

    let mut text = String::from(if twists {
        "time_s,time_ns,model,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,qw,qx,qy,qz,\
         wx_rad_s,wy_rad_s,wz_rad_s\n"
    } else {
        "time_s,time_ns,model,x_m,y_m,z_m,qw,qx,qy,qz\n"
    });
    while let Some(tick) = rows.next_tick()? {
        let time = format!("{},{}", seconds(tick.time_ns), tick.time_ns);
        for &place in &rows.places {
            let (model, sample) = (&names[place], &tick.samples[place]);
            let _ = write!(text, "{time},{model}");
            numbers(&mut text, sample, twists);
            text.push('\n');
            if text.len() > 1 << 16 {
                out.write_all(text.as_bytes()).map_err(ExportError::Csv)?;
                text.clear();
            }
        }
    }
    out.write_all(text.as_bytes()).map_err(ExportError::Csv)?;
    out.flush().map_err(ExportError::Csv)?;
    Ok(rows.exported)
}

/// Writes the selected part of a recording as a CSV file, published by [`crate::publish`]: never
/// torn. See [`export_csv`].
///
/// # Errors
/// When a pattern matches no model, when the recording is damaged, or when the file cannot be
/// written. Nothing is published then.
pub fn export_csv_file(
    recording: &Recording,
    selection: &Selection,
    path: impl AsRef<Path>,
) -> Result<Exported, ExportError> {
    write_file(path.as_ref(), |out| export_csv(recording, selection, out))
}

/// Publishes what `export` writes.
pub(super) fn write_file(
    path: &Path,
    export: impl FnOnce(&mut dyn Write) -> Result<Exported, ExportError>,
) -> Result<Exported, ExportError> {
    let written = publish(path, |file| {
        export(&mut BufWriter::new(file)).map_err(Error)
    });
    written.map_err(|Error(error)| match error {
        ExportError::Csv(source) => ExportError::Write {
            path: path.to_path_buf(),
            source,
        },
        error => error,
    })
}

/// An error of the export, or of the file around it.
struct Error(ExportError);

impl From<io::Error> for Error {
    fn from(error: io::Error) -> Self {
        Self(ExportError::Csv(error))
    }
}

/// Appends the numbers of one row. Writing to a text cannot fail.
fn numbers(text: &mut String, sample: &Sample, twists: bool) {
    for number in sample.position_m {
        let _ = write!(text, ",{number}");
    }
    // Velocities and rates were recorded as `f32`; printed as one they have half the digits.
    for number in sample.velocity_m_s.iter().filter(|_| twists) {
        let _ = write!(text, ",{}", *number as f32);
    }
    for number in sample.world_from_body {
        let _ = write!(text, ",{number}");
    }
    for number in sample.rate_rad_s.iter().filter(|_| twists) {
        let _ = write!(text, ",{}", *number as f32);
    }
}

/// A text as a CSV field.
pub(super) fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_are_quoted_where_they_must_be() {
        assert_eq!(quoted("bee-1"), "bee-1");
        assert_eq!(quoted("a,b"), "\"a,b\"");
        assert_eq!(quoted("say \"hi\""), "\"say \"\"hi\"\"\"");
    }
}
