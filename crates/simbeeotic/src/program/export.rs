//! `export`: a recording as a table.

use super::arguments::{BESIDE, ExportOptions};
use super::{Failure, input, remark, same_file, show};
use simbeeotic_kernel::SimTime;
use simbeeotic_record::{
    AirTable, ExportError, Exported, Recording, Selection, export_air, export_air_file, export_csv,
    export_csv_file, export_parquet, export_readings, export_readings_file,
};
use std::collections::{BTreeMap, BTreeSet};
use std::io::{BufWriter, ErrorKind, StdoutLock, Write, stdout};
use std::num::NonZeroU64;
use std::path::Path;

/// Writes the table.
pub(super) fn export(options: &ExportOptions) -> Result<(), Failure> {
    let recording = Recording::open(&options.recording).map_err(Failure::input)?;
    if recording.truncated() {
        remark(format!(
            "note: {} was cut off; it reads up to {}",
            options.recording.display(),
            SimTime::from_nanos(recording.end_ns())
        ));
    }
    let selection = selection(options)?;
    if let Some(folder) = &options.images {
        return images(&recording, &selection, folder);
    }
    if let Some((table, path)) = air(options) {
        return export_table(options, path, &recording, &selection, table);
    }
    type ToFile = fn(&Recording, &Selection, &Path) -> Result<Exported, ExportError>;
    let to_file: ToFile = match (&options.readings, &options.csv) {
        (Some(_), _) => {
            |recording, selection, path| export_readings_file(recording, selection, path)
        }
        (None, Some(_)) => |recording, selection, path| export_csv_file(recording, selection, path),
        (None, None) => |recording, selection, path| export_parquet(recording, selection, path),
    };
    let target = match options.readings.as_ref().or(options.csv.as_ref()) {
        Some(path) if path == Path::new("-") => {
            return to_stdout(|out| match options.readings {
                Some(_) => export_readings(&recording, &selection, out),
                None => export_csv(&recording, &selection, out),
            });
        }
        Some(path) => path.clone(),
        None => {
            let named = options.parquet.clone().filter(|p| p != Path::new(BESIDE));
            named.unwrap_or_else(|| options.recording.with_extension("parquet"))
        }
    };
    keep_recording(options, &target)?;
    let exported = to_file(&recording, &selection, &target).map_err(failed)?;
    report(&exported, &target);
    Ok(())
}

/// Which table of the air is wanted, and where.
fn air(options: &ExportOptions) -> Option<(AirTable, &Path)> {
    [
        (AirTable::Packets, &options.packets),
        (AirTable::Links, &options.links),
        (AirTable::Radio, &options.radio),
    ]
    .into_iter()
    .find_map(|(table, path)| Some((table, path.as_deref()?)))
}

fn export_table(
    options: &ExportOptions,
    path: &Path,
    recording: &Recording,
    selection: &Selection,
    table: AirTable,
) -> Result<(), Failure> {
    if path == Path::new("-") {
        return to_stdout(|out| export_air(table, recording, selection, out));
    }
    keep_recording(options, path)?;
    let exported = export_air_file(table, recording, selection, path).map_err(failed)?;
    report(&exported, path);
    Ok(())
}

/// Writes a table to where its reader waits.
fn to_stdout(
    write: impl FnOnce(&mut BufWriter<StdoutLock<'static>>) -> Result<Exported, ExportError>,
) -> Result<(), Failure> {
    let mut out = BufWriter::new(stdout().lock());
    match write(&mut out) {
        // A reader that has gone away (`| head`) has what it wanted.
        Err(ExportError::Csv(source)) if source.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(failed(error)),
        Ok(_) => match out.flush() {
            Err(e) if e.kind() != ErrorKind::BrokenPipe => Err(Failure::run(e)),
            _ => Ok(()),
        },
    }
}

/// Writes the pictures, each named by its path and its time in microseconds, so that names sort as times do.
fn images(recording: &Recording, selection: &Selection, folder: &Path) -> Result<(), Failure> {
    let mut counts: BTreeMap<String, u64> = BTreeMap::new();
    let mut written = 0_u64;
    let mut others = BTreeSet::new();
    for picture in recording.pictures_in(selection.times_ns.clone()) {
        let picture = picture.map_err(Failure::run)?;
        if !selection.takes(&picture.path) {
            others.insert(picture.path);
            continue;
        }
        let count = counts.entry(picture.path.clone()).or_default();
        *count += 1;
        if !(*count - 1).is_multiple_of(selection.every.get()) {
            continue;
        }
        // A path comes from a file: nothing leads out of the folder.
        let parts = picture.path.split('/').filter(|part| !part.is_empty());
        let mut path = folder.to_path_buf();
        path.extend(parts.map(|part| part.replace(['\\', ':'], "_").replace("..", "_")));
        path.as_mut_os_string()
            .push(format!("-{:012}us.png", picture.time_ns / 1000));
        let file = picture.image.to_png().map_err(Failure::run)?;
        let made = path.parent().map_or(Ok(()), std::fs::create_dir_all);
        made.and_then(|()| std::fs::write(&path, file))
            .map_err(|error| Failure::run(format!("cannot write {}: {error}", path.display())))?;
        written += 1;
    }
    if written == 0 {
        return Err(Failure::run(
            match (selection.models.first(), others.first()) {
                (Some(pattern), Some(other)) => format!(
                    "no camera matches {pattern:?}; the recording has pictures of {}, {other:?} among them",
                    others.len()
                ),
                _ => {
                    "the recording has no pictures at these times: name cameras in the recorder's \
                  `readings`, and give them a `rate` if no behaviour reads them"
                        .to_owned()
                }
            },
        ));
    }
    remark(format!("wrote {written} pictures to {}", folder.display()));
    Ok(())
}

/// A table must not replace the recording that it comes from.
fn keep_recording(options: &ExportOptions, target: &Path) -> Result<(), Failure> {
    if same_file(&options.recording, target) {
        return Err(Failure::input(format!(
            "{} is the recording itself; choose another name for the table",
            target.display()
        )));
    }
    Ok(())
}

fn report(exported: &Exported, target: &Path) {
    let bytes = std::fs::metadata(target).map(|m| m.len()).unwrap_or(0);
    remark(format!(
        "wrote {}: {} rows, {}",
        target.display(),
        exported.rows,
        show::bytes(bytes)
    ));
}

fn failed(error: ExportError) -> Failure {
    Failure::run(error)
}

fn selection(options: &ExportOptions) -> Result<Selection, Failure> {
    let every = NonZeroU64::new(options.every)
        .ok_or_else(|| Failure::input("--every 0: it must be one or more"))?;
    let from = input::nanos("--from", options.from.as_deref())?.unwrap_or(0);
    let to = input::nanos("--to", options.to.as_deref())?.unwrap_or(u64::MAX);
    input::in_order(from, to, true)?;
    Ok(Selection {
        every,
        models: options.model.iter().cloned().collect(),
        times_ns: from..=to,
    })
}
