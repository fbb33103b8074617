//! Packets, links and counters as tables, CSV or Parquet.
//!
//! Packets: one row for each reception; a packet that nobody received has one row, without a receiver.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `time_s`, `time_ns` | s, ns | virtual time at which the transmission began |
//! | `sender`, `radio` | | path of the model that sent, and of its radio |
//! | `channel`, `frequency_hz` | 1, Hz | number of the IEEE 802.15.4 channel (0: another), and its middle |
//! | `destination` | | path of the model that it is for; empty: everybody |
//! | `bytes`, `payload_bytes` | B | length on the air, and of what was sent |
//! | `airtime_s` | s | how long it is on the air |
//! | `power_dbm` | dBm | power fed into the antenna |
//! | `x_m`, `y_m`, `z_m` | m | where the sender was: east, north, up |
//! | `receiver` | | path of the radio that received it |
//! | `received_s` | s | virtual time at which it was handed over |
//! | `rssi_dbm`, `snr_db`, `lqi` | dBm, dB, 1 | how well it was received |
//!
//! Links: one row for each ordered pair and period.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `time_s`, `time_ns`, `period_s` | s, ns, s | end and length of the period |
//! | `from`, `to` | | paths of the two radios |
//! | `sent`, `received` | 1 | frames that the second could have received, and those that it did |
//! | `rssi_dbm` | dBm | mean in decibels of those |
//! | `distance_m` | m | mean distance |
//!
//! Counters: one row for each period, and for each radio that is counted by itself.
//!
//! | column | unit | what |
//! |---|---|---|
//! | `time_s`, `time_ns`, `period_s` | s, ns, s | end and length of the period |
//! | `radio` | | path of the radio; empty: all together |
//! | `sent`, `received`, `overheard` | 1 | frames in this period |
//! | `lost_...` | 1 | frames lost for this reason, a column for each |
//!
//! A number that there is none of is `NaN`.

use super::csv::{quoted, write_file};
use super::{ExportError, Exported, decimal, seconds};
use crate::recording::Recording;
use crate::selection::Selection;
use crate::table::{Column, Values, write_table};
use simbeeotic_model::radio::Loss;
use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::io::Write;
use std::path::Path;

/// A table of what went over the air.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AirTable {
    /// One row for each packet and receiver. Selected by the sender's radio.
    Packets,
    /// One row for each ordered pair of radios and period. Selected by the sender's radio.
    Links,
    /// One row for each period, and for each radio that is counted by itself. Selected by it.
    Radio,
}

/// What stands in a field.
enum Cell<'a> {
    Text(&'a str),
    Whole(u64),
    /// As short as the `f32` that it was recorded as.
    Single(f32),
    Number(f64),
}

use Cell::{Number, Single, Text, Whole};

type TakeRow<'a> = &'a mut dyn FnMut(&[Cell<'_>]) -> Result<(), ExportError>;

impl AirTable {
    fn columns(self) -> Vec<String> {
        let names = match self {
            Self::Packets => {
                "time_s time_ns sender radio channel frequency_hz destination bytes payload_bytes \
                 airtime_s power_dbm x_m y_m z_m receiver received_s rssi_dbm snr_db lqi"
            }
            Self::Links => "time_s time_ns period_s from to sent received rssi_dbm distance_m",
            Self::Radio => "time_s time_ns period_s radio sent received overheard",
        };
        let names = names.split_whitespace().map(str::to_owned);
        let reasons = Loss::ALL.iter().filter(|_| self == Self::Radio);
        let reasons = reasons.map(|why| format!("lost_{}", why.name().replace('-', "_")));
        names.chain(reasons).collect()
    }

    /// What to do if there is nothing.
    fn missing(self) -> &'static str {
        match self {
            Self::Packets => {
                "the recording has no packets: nobody sent, or the recorder had `packets = []`, or there were \
                 more than 256 radios, of which it must say whose, as in `packets = [\"bee-1*\"]`, or `[\"*\"]` \
                 for all"
            }
            Self::Links => {
                "the recording has no links: they are recorded if the packets of 2 to 256 radios are, as \
                 in the recorder's `packets = [\"bee-1*\"]`"
            }
            Self::Radio => "the recording has no counters of radios: there were none on the air",
        }
    }

    /// Whether the recording has any of it, at whatever time.
    fn exists(self, recording: &Recording) -> bool {
        let always = 0..=u64::MAX;
        match self {
            Self::Packets => recording.packets_in(always).next().is_some(),
            Self::Links => recording.links_in(always).next().is_some(),
            Self::Radio => recording.traffic_in(always).next().is_some(),
        }
    }

    fn rows(
        self,
        recording: &Recording,
        pick: &mut Pick<'_>,
        row: TakeRow<'_>,
    ) -> Result<(), ExportError> {
        match self {
            Self::Packets => packets(recording, pick, row),
            Self::Links => links(recording, pick, row),
            Self::Radio => radio(recording, pick, row),
        }
    }
}

/// What of a table is selected, and what was found.
struct Pick<'a> {
    selection: &'a Selection,
    /// Places of the patterns that matched something.
    used: BTreeSet<usize>,
    seen: BTreeSet<String>,
    exported: Exported,
}

impl Pick<'_> {
    fn takes(&mut self, path: &str) -> bool {
        if !self.seen.contains(path) {
            self.seen.insert(path.to_owned());
            self.used.extend(self.selection.matching(path));
        }
        self.selection.takes(path)
    }

    /// Whether the next message is one of every n.
    fn next(&mut self) -> bool {
        self.exported.ticks += 1;
        (self.exported.ticks - 1).is_multiple_of(self.selection.every.get())
    }

    fn check(self, table: AirTable, recording: &Recording) -> Result<Exported, ExportError> {
        if self.seen.is_empty() {
            let what = match table.exists(recording) {
                true => "the recording has nothing of it between these times",
                false => table.missing(),
            };
            return Err(ExportError::NoReadings(what.to_owned()));
        }
        let mut patterns = self.selection.models.iter().enumerate();
        match patterns.find(|(place, _)| !self.used.contains(place)) {
            None => Ok(Exported {
                models: self.seen.len(),
                ..self.exported
            }),
            Some((_, pattern)) => Err(ExportError::NoModel {
                pattern: pattern.clone(),
                known: format!(
                    "the recording has {} radios here, {:?} among them",
                    self.seen.len(),
                    self.seen.last().map_or("", String::as_str)
                ),
            }),
        }
    }
}

fn packets(
    recording: &Recording,
    pick: &mut Pick<'_>,
    row: TakeRow<'_>,
) -> Result<(), ExportError> {
    let fine = recording.is_fine();
    for packet in recording.packets_in(pick.selection.times_ns.clone()) {
        let packet = packet?;
        if !pick.takes(&packet.radio) || !pick.next() {
            continue;
        }
        let place = packet.position_m;
        let [x, y, z] = if fine {
            place.map(|p| decimal(p, 1e6))
        } else {
            place
        };
        let mut write = |receiver: &str, received_s: f64, [rssi, snr, lqi]: [f32; 3]| {
            pick.exported.rows += 1;
            row(&[
                Number(seconds(packet.time_ns)),
                Whole(packet.time_ns),
                Text(&packet.sender),
                Text(&packet.radio),
                Whole(packet.channel.into()),
                Number(packet.frequency_hz),
                Text(&packet.destination),
                Whole(packet.bytes.into()),
                Whole(packet.payload_bytes.into()),
                Number(seconds(packet.airtime_ns)),
                Single(packet.power_dbm as f32),
                Number(x),
                Number(y),
                Number(z),
                Text(receiver),
                Number(received_s),
                Single(rssi),
                Single(snr),
                Single(lqi),
            ])
        };
        for r in &packet.receptions {
            let how = [r.rssi_dbm, r.snr_db, r.lqi.into()];
            write(&r.radio, seconds(r.time_ns), how)?;
        }
        if packet.receptions.is_empty() {
            write("", f64::NAN, [f32::NAN; 3])?;
        }
    }
    Ok(())
}

fn links(recording: &Recording, pick: &mut Pick<'_>, row: TakeRow<'_>) -> Result<(), ExportError> {
    for links in recording.links_in(pick.selection.times_ns.clone()) {
        let links = links?;
        if !pick.next() {
            continue;
        }
        for link in &links.links {
            let [from, to] = [link.from, link.to].map(|place| &links.radios[place as usize]);
            if !pick.takes(from) {
                continue;
            }
            pick.exported.rows += 1;
            row(&[
                Number(seconds(links.time_ns)),
                Whole(links.time_ns),
                Number(links.period_s),
                Text(from),
                Text(to),
                Whole(link.sent.into()),
                Whole(link.received.into()),
                Single(link.rssi_dbm),
                Single(link.distance_m),
            ])?;
        }
    }
    Ok(())
}

fn radio(recording: &Recording, pick: &mut Pick<'_>, row: TakeRow<'_>) -> Result<(), ExportError> {
    let mut last_ns = None;
    let mut wanted = false;
    for traffic in recording.traffic_in(pick.selection.times_ns.clone()) {
        let traffic = traffic?;
        if last_ns != Some(traffic.time_ns) {
            last_ns = Some(traffic.time_ns);
            wanted = pick.next();
        }
        if !pick.takes(&traffic.radio) || !wanted {
            continue;
        }
        pick.exported.rows += 1;
        let period = &traffic.period;
        let mut cells = vec![
            Number(seconds(traffic.time_ns)),
            Whole(traffic.time_ns),
            Number(traffic.period_s),
            Text(&traffic.radio),
            Whole(period.sent),
            Whole(period.received),
            Whole(period.overheard),
        ];
        let lost = Loss::ALL.iter().map(|why| Whole(period.lost(why.name())));
        cells.extend(lost);
        row(&cells)?;
    }
    Ok(())
}

/// Writes a table of what went over the air as CSV (comma, header line, `\n`).
///
/// # Errors
/// When there is nothing of it at these times, when a pattern matches no radio that is in it, when the
/// recording is damaged, or when `out` fails. Rows before the error are written.
pub fn export_air(
    table: AirTable,
    recording: &Recording,
    selection: &Selection,
    out: &mut dyn Write,
) -> Result<Exported, ExportError> {
    let mut text = table.columns().join(",");
    text.push('\n');
    let exported = picked(table, recording, selection, &mut |cells| {
        for (at, cell) in cells.iter().enumerate() {
            let comma = if at == 0 { "" } else { "," };
            // Writing to a text cannot fail.
            let _ = match cell {
                Text(word) => write!(text, "{comma}{}", quoted(word)),
                Whole(number) => write!(text, "{comma}{number}"),
                Single(number) => write!(text, "{comma}{number}"),
                Number(number) => write!(text, "{comma}{number}"),
            };
        }
        text.push('\n');
        if text.len() > 1 << 16 {
            out.write_all(text.as_bytes()).map_err(ExportError::Csv)?;
            text.clear();
        }
        Ok(())
    })?;
    out.write_all(text.as_bytes()).map_err(ExportError::Csv)?;
    out.flush().map_err(ExportError::Csv)?;
    Ok(exported)
}

/// Writes a table of what went over the air as a file, published by [`crate::publish`]: Parquet if its
/// name ends in `.parquet`, else CSV. A Parquet table is held in memory until it is whole.
///
/// # Errors
/// As [`export_air`]. Nothing is published then.
pub fn export_air_file(
    table: AirTable,
    recording: &Recording,
    selection: &Selection,
    path: impl AsRef<Path>,
) -> Result<Exported, ExportError> {
    let path = path.as_ref();
    if path.extension().is_none_or(|ending| ending != "parquet") {
        return write_file(path, |out| export_air(table, recording, selection, out));
    }
    let mut columns: Vec<Column> = Vec::new();
    let exported = picked(table, recording, selection, &mut |cells| {
        if columns.is_empty() {
            let empty = |cell: &Cell<'_>| match cell {
                Text(_) => Values::Text(Vec::new()),
                Whole(_) => Values::Integer(Vec::new()),
                Single(_) | Number(_) => Values::Float(Vec::new()),
            };
            let values = cells.iter().map(empty);
            let named = table.columns().into_iter().zip(values);
            columns = named
                .map(|(name, values)| Column { name, values })
                .collect();
        }
        for (column, cell) in columns.iter_mut().zip(cells) {
            match (&mut column.values, cell) {
                (Values::Text(column), Text(word)) => column.push((*word).to_owned()),
                (Values::Integer(column), Whole(number)) => column.push(number.cast_signed()),
                (Values::Float(column), Number(number)) => column.push(*number),
                (Values::Float(column), Single(number)) => column.push((*number).into()),
                // A column has one kind of cell.
                _ => {}
            }
        }
        Ok(())
    })?;
    write_table(path, &columns)?;
    Ok(exported)
}

fn picked(
    table: AirTable,
    recording: &Recording,
    selection: &Selection,
    row: TakeRow<'_>,
) -> Result<Exported, ExportError> {
    let mut pick = Pick {
        selection,
        used: BTreeSet::new(),
        seen: BTreeSet::new(),
        exported: Exported::default(),
    };
    table.rows(recording, &mut pick, row)?;
    pick.check(table, recording)
}
